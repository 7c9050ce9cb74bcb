/* callbacks_wide.c - the callbacks of a model's system, over num: inputs into the work of the tape,
 * the tape, and NaN in the lanes where a watched pivot has vanished. */
#include "kernel/groups.h"

#include "kernel/num.h"
#include "model/mechanics.h"

/* Doubles that a number takes: one for each lane, or more for a longer one. */
enum { WIDTH = DAL_GROUPS * (int)(sizeof(num) / sizeof(double)) };

static void load(double *work, int place, const double *from, int count)
{
    num *to = (num *)(work + (size_t)place * WIDTH);
    const num *lanes = (const num *)from;
    for (int i = 0; i < count * DAL_GROUPS; i++) to[i] = lanes[i];
}

static void load_time(double *work, int place, double t)
{
    num *to = (num *)(work + (size_t)place * WIDTH);
    for (int g = 0; g < DAL_GROUPS; g++) to[g] = dal_num(t);
}

static void load_inputs(const dal__programs *p, const dal_at *at, unsigned reads)
{
    if (reads & DAL__T) load_time(at->work, p->t, at->t);
    if (reads & DAL__QV) {
        load(at->work, p->q, at->q, p->n);
        load(at->work, p->v, at->v, p->n);
        load(at->work, p->g, at->v + p->n * WIDTH, p->multipliers);
    }
    if (reads & DAL__PI) load(at->work, p->pi, at->pi, p->n);
}

/* Lanes where every pivot exceeds its part of the size; a NaN exceeds nothing. */
static dal_mask sound(const num *watched, int pivots)
{
    dal_mask ok = dal_all();
    for (int k = 0; k < pivots; k++) {
        const num pivot = watched[2 * k * DAL_GROUPS], size = watched[(2 * k + 1) * DAL_GROUPS];
        ok &= dal_less(DAL__PIVOT_LEAST * size, dal_abs(pivot));
    }
    return ok;
}

/* The outputs of one group of lanes, NaN where a pivot has vanished. */
static void hand_over(const dal__program *program, const num *all, num *out)
{
    const num poison = dal_num(NAN);
    const dal_mask ok = sound(all + program->outputs * DAL_GROUPS, program->watched);
    for (int i = 0; i < program->outputs * DAL_GROUPS; i += DAL_GROUPS)
        out[i] = dal_select(ok, all[i], poison);
}

static dal_status run_program(const dal_system *system, const dal_at *at, double *out,
                              dal__program_code code, unsigned reads)
{
    const dal__programs *p = system->data;
    const dal__program *program = &p->program[code];
    load_inputs(p, at, reads);
    if (program->watched == 0) {
        DAL_WIDE(dal__tape_run)(p->tapes, program->tape, at->work, out);
        return DAL_OK;
    }
    double *scratch = at->work + p->scratch * WIDTH;
    DAL_WIDE(dal__tape_run)(p->tapes, program->tape, at->work, scratch);
    for (int g = 0; g < DAL_GROUPS; g++)
        hand_over(program, (const num *)scratch + g, (num *)out + g);
    return DAL_OK;
}

#define X(code, name, reads)                                                                       \
    static dal_status name(const dal_system *system, const dal_at *at, double *out)                \
    {                                                                                              \
        return run_program(system, at, out, DAL__PROGRAM_##code, reads);                           \
    }
DAL__WIDE_LIST(X)
#undef X

dal__run_program *DAL_WIDE(dal__callbacks)(const dal__programs *programs, dal_callbacks *call)
{
#define X(code, name, reads)                                                                       \
    call->name = programs->program[DAL__PROGRAM_##code].present ? name : NULL;
    DAL__WIDE_LIST(X)
#undef X
    return run_program;
}
