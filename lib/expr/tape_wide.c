/* tape_wide.c - runs a program, over num.
 *
 * An instruction acts on all groups of a block before the next one is read, so all lanes share the
 * cost of decoding it. */
#include "kernel/groups.h"

#include "expr/arithmetic.h"
#include "expr/tape.h"
#include "expr/traversal.h"

#define AT(place)  w[(size_t)(place)*DAL_GROUPS + g]
#define EACH_GROUP for (size_t g = 0; g < DAL_GROUPS; g++)

static __attribute__((flatten, noinline)) void execute(const dal__tape *tape, double *work)
{
    num *w = (num *)work;
    for (int k = 0; k < tape->length; k++) {
        const dal__instruction i = tape->code[k]; /* a copy, which no write to w can change */
        switch (i.op) {
#define CASE(code, expression)                                                                     \
    case DAL__##code:                                                                              \
        EACH_GROUP                                                                                 \
        {                                                                                          \
            const num a = AT(i.a), b = AT(i.b), c = AT(i.c);                                       \
            AT(i.d) = expression;                                                                  \
            (void)b, (void)c;                                                                      \
        }                                                                                          \
        break;
            DAL__UNARY_LIST(CASE)
            DAL__BINARY_LIST(CASE)
            DAL__FUSED_LIST(CASE)
#undef CASE
        case DAL__SINCOS:
            EACH_GROUP dal_sincos(AT(i.a), &AT(i.d), &AT(i.b));
            break;
        }
    }
}

void DAL_WIDE(dal__tape_run)(const dal__tapes *tapes, int program, double *work, double *out)
{
    const dal__tape *tape = &tapes->tape[program];
    execute(tape, work);
    const num *w = (const num *)work;
    num *o = (num *)out;
    for (int k = 0; k < tape->outputs; k++) {
        const uint32_t place = tape->place[k];
        EACH_GROUP o[(size_t)k * DAL_GROUPS + g] = AT(place);
    }
}

#if defined DAL_NUM_QUAD || !defined DAL_VARIANT /* x1 */
void DAL_WIDE(dal__tapes_prepare)(const dal__tapes *tapes, double *work)
{
    num *numbers = (num *)work + tapes->parameters;
    for (int i = 0; i < tapes->numbers; i++) numbers[i] = dal_num(tapes->number[i]);
    execute(&tapes->hoisted, work);
}
#endif
