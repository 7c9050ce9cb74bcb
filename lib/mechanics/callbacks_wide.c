/* callbacks_wide.c - the callbacks of a model's system, one, four and eight lanes wide: inputs into
 * the work of the tape, the tape, and NaN in the lanes where a watched pivot has vanished. */
#include "kernel/num.h"
#include "mechanics/mechanics.h"

#define run_program DAL_WIDE(dal__run_program)

dal_status run_program(const dal_system *system, const dal_at *at, double *out,
                       dal__program_code code, unsigned reads);

static void load(num *to, const double *from, int count)
{
    const num *lanes = (const num *)from;
    for (int i = 0; i < count; i++) to[i] = lanes[i];
}

static void load_inputs(const dal__programs *p, const dal_at *at, unsigned reads)
{
    num *work = (num *)at->work;
    if (reads & DAL__T) work[p->t] = dal_num(at->t);
    if (reads & DAL__QV) {
        load(work + p->q, at->q, p->n);
        load(work + p->v, at->v, p->n);
        load(work + p->g, at->v + p->n * DAL_LANES, p->multipliers);
    }
    if (reads & DAL__PI) load(work + p->pi, at->pi, p->n);
}

/* Lanes where every pivot exceeds its part of the size; a NaN exceeds nothing. */
static dal_mask sound(const num *watched, int pivots)
{
    dal_mask ok = dal_all();
    for (int k = 0; k < pivots; k++)
        ok &= dal_less(DAL__PIVOT_LEAST * watched[2 * k + 1], dal_abs(watched[2 * k]));
    return ok;
}

dal_status run_program(const dal_system *system, const dal_at *at, double *out,
                       dal__program_code code, unsigned reads)
{
    const dal__programs *p = system->data;
    const dal__program *program = &p->program[code];
    load_inputs(p, at, reads);
    if (program->watched == 0) {
        DAL_WIDE(dal__tape_run)(p->tapes, program->tape, at->work, out);
        return DAL_OK;
    }
    double *scratch = at->work + p->scratch * DAL_LANES;
    DAL_WIDE(dal__tape_run)(p->tapes, program->tape, at->work, scratch);
    const num *all = (const num *)scratch;
    num *to = (num *)out, poison = dal_num(NAN);
    dal_mask ok = sound(all + program->outputs, program->watched);
    for (int i = 0; i < program->outputs; i++) to[i] = dal_select(ok, all[i], poison);
    return DAL_OK;
}

#define X(code, name, reads)                                                                       \
    static dal_status name(const dal_system *system, const dal_at *at, double *out)                \
    {                                                                                              \
        return run_program(system, at, out, DAL__PROGRAM_##code, reads);                           \
    }
DAL__WIDE_LIST(X)
#undef X

void DAL_WIDE(dal__callbacks)(const dal__programs *programs, dal_callbacks *call)
{
#define X(code, name, reads)                                                                       \
    call->name = programs->program[DAL__PROGRAM_##code].present ? name : NULL;
    DAL__WIDE_LIST(X)
#undef X
}
