/* tape_wide.c - runs a program, over num. */
#include "expr/arithmetic.h"
#include "expr/table.h"
#include "expr/tape.h"
#include "expr/traversal.h"

static __attribute__((flatten, noinline)) void execute(const dal__tape *tape,
                                                       const dal__table *tables, double *work)
{
    num *w = (num *)work;
    for (int k = 0; k < tape->length; k++) {
        const dal__instruction i = tape->code[k]; /* a copy, which no write to w can change */
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
            const dal__table *t = &tables[i.b / DAL__TABLE_ORDERS];
            w[i.d] = dal_piecewise(w[i.a], t->data, t->knots, (int)(i.b % DAL__TABLE_ORDERS));
        } break;
        }
    }
}

void DAL_WIDE(dal__tape_run)(const dal__tapes *tapes, int program, double *work, double *out)
{
    const dal__tape *tape = &tapes->tape[program];
    execute(tape, tapes->tables, work);
    const num *w = (const num *)work;
    num *o = (num *)out;
    for (int k = 0; k < tape->outputs; k++) o[k] = w[tape->place[k]];
}

#if defined DAL_NUM_QUAD || !defined DAL_VARIANT_NAME /* x1 */
void DAL_WIDE(dal__tapes_prepare)(const dal__tapes *tapes, double *work)
{
    num *numbers = (num *)work + tapes->parameters;
    for (int i = 0; i < tapes->numbers; i++) numbers[i] = dal_num(tapes->number[i]);
    execute(&tapes->hoisted, tapes->tables, work);
}
#endif
