/* tape_wide.c - runs a program, over num. */
#include "formula/arithmetic.h"
#include "formula/tape.h"

void DAL_WIDE(dal__execute)(const dal__tape *tape, double *work);
void DAL_WIDE(dal__execute)(const dal__tape *tape, double *work)
{
    num *w = (num *)work;
    const dal__instruction *end = tape->code + tape->length;
    for (const dal__instruction *i = tape->code; i < end; i++) {
        switch (i->op) {
#define X(code, expression)                                                                        \
    case DAL__##code: {                                                                            \
        num a = w[i->a];                                                                           \
        w[i->d] = expression;                                                                      \
        break;                                                                                     \
    }
            DAL__UNARY_LIST(X)
#undef X
#define X(code, expression)                                                                        \
    case DAL__##code: {                                                                            \
        num a = w[i->a], b = w[i->b];                                                              \
        w[i->d] = expression;                                                                      \
        break;                                                                                     \
    }
            DAL__BINARY_LIST(X)
#undef X
        case DAL__SINCOS:
            dal_sincos(w[i->a], &w[i->d], &w[i->b]);
            break;
        case DAL__MUL_ADD:
            w[i->d] = w[i->a] * w[i->b] + w[i->c];
            break;
        case DAL__MUL_SUB:
            w[i->d] = w[i->a] * w[i->b] - w[i->c];
            break;
        case DAL__SUB_MUL:
            w[i->d] = w[i->c] - w[i->a] * w[i->b];
            break;
        }
    }
}

void DAL_WIDE(dal__tape_run)(const dal__tapes *tapes, int program, double *work, double *out)
{
    const dal__tape *tape = &tapes->tape[program];
    DAL_WIDE(dal__execute)(tape, work);
    const num *w = (const num *)work;
    num *o = (num *)out;
    for (int k = 0; k < tape->outputs; k++) o[k] = w[tape->place[k]];
}
