/* tape_wide.c - runs a program, over num. */
#include "expr/arithmetic.h"
#include "expr/operations.h"
#include "expr/table.h"
#include "expr/tape.h"

static __attribute__((flatten, noinline)) void execute(const dal__instruction *code, int length,
                                                       const dal__tape_table *tables, double *work)
{
    num *w = (num *)work;
    for (int k = 0; k < length; k++) {
        const dal__instruction i = code[k]; /* a copy, which no write to w can change */
        switch (i.op) {
#define CASE(code, expression)                                                                     \
    case DAL__##code: {                                                                            \
        const num a = w[i.a], b = w[i.b], c = w[i.c];                                              \
        w[i.d] = expression;                                                                       \
        (void)b, (void)c;                                                                          \
    } break;
            DAL__OPERATION_LIST(CASE)
#undef CASE
        case DAL__SINCOS:
            dal_sincos(w[i.a], &w[i.d], &w[i.b]);
            break;
        case DAL__TABLE: {
            const dal__tape_table *t = &tables[i.b / DAL__TABLE_ORDERS];
            w[i.d] = dal_piecewise(w[i.a], t->data, t->knots, (int)(i.b % DAL__TABLE_ORDERS));
        } break;
        case DAL__PIECE: {
            const dal__tape_table *t = &tables[i.b / DAL__TABLE_ORDERS];
            const int order = (int)(i.b % DAL__TABLE_ORDERS);
            w[i.d] = dal_piece_at(w[i.c], w[i.a], t->data, t->knots, order);
        } break;
        }
    }
}

void DAL_WIDE(dal__tape_execute)(const dal__tapes *tapes, int program, double *work)
{
    const dal__tape *tape = &tapes->tape[program];
    const bool is_held = tape->held && dal_lane(((const num *)work)[tapes->held], 0) != 0.0;
    execute(is_held ? tape->held : tape->code, tape->length, tapes->tables, work);
}

void DAL_WIDE(dal__tape_read)(const dal__tapes *tapes, int program, int first, int count,
                              const double *work, double *out)
{
    const uint32_t *place = tapes->tape[program].place + first;
    const num *w = (const num *)work;
    num *o = (num *)out;
    for (int k = 0; k < count; k++) o[k] = w[place[k]];
}

void DAL_WIDE(dal__tape_run)(const dal__tapes *tapes, int program, double *work, double *out)
{
    DAL_WIDE(dal__tape_execute)(tapes, program, work);
    DAL_WIDE(dal__tape_read)(tapes, program, 0, tapes->tape[program].outputs, work, out);
}

#if defined DAL_NUM_QUAD || !defined DAL_VARIANT_NAME /* x1 */
void DAL_WIDE(dal__tapes_prepare)(const dal__tapes *tapes, double *work)
{
    num *numbers = (num *)work + tapes->parameters;
    for (int i = 0; i < tapes->numbers; i++) numbers[i] = dal_num(tapes->number[i]);
    execute(tapes->hoisted.code, tapes->hoisted.length, tapes->tables, work);
    DAL_WIDE(dal__tapes_hold)(tapes, NULL, work);
}

void DAL_WIDE(dal__tapes_hold)(const dal__tapes *tapes, const double *point, double *work)
{
    num *held = (num *)work + tapes->held;
    if (tapes->points > 0) *held++ = dal_num(point != NULL);
    for (int k = 0; point && k < tapes->points; k++, held += DAL__HELD_NUMBERS) {
        const double p = point[k], sign = (p > 0.0) - (p < 0.0);
        const double numbers[DAL__HELD_NUMBERS] = {p, sign, -sign, p<0.0, p> 0.0};
        for (int i = 0; i < DAL__HELD_NUMBERS; i++) held[i] = dal_num(numbers[i]);
    }
}
#endif
