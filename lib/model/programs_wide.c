/* programs_wide.c - the callbacks of a model's system, over num: they load the inputs of a
 * tape, run it, and leave NaN in the lanes where a checked pivot has vanished. */
#include "kernel/num.h"
#include "model/programs.h"

/* Doubles that a number takes: one for each lane, or more for a longer one. */
enum { WIDTH = sizeof(num) / sizeof(double) };

static void load_lanes(double *work, int place, const double *from, int count)
{
    num *to = (num *)(work + (size_t)place * WIDTH);
    const num *lanes = (const num *)from;
    for (int i = 0; i < count; i++) to[i] = lanes[i];
}

/* Lanes where every pivot exceeds its part of the size; a NaN exceeds nothing. */
static dal_mask pivots_hold(const num *checked, int pivots)
{
    dal_mask ok = dal_all();
    for (int k = 0; k < pivots; k++) {
        const num pivot = checked[2 * k], size = checked[2 * k + 1];
        ok &= dal_less(DAL__PIVOT_LEAST * size, dal_abs(pivot));
    }
    return ok;
}

/* Leaves NaN in the lanes where a pivot has vanished, and pivots for the rank check. */
static dal_status run_program(const dal_system *system, const dal_point *at, double *out,
                              dal__program_code code, int reads)
{
    const dal__programs *p = system->data;
    const dal__program *program = &p->program[code];
    num *t = (num *)(at->work + (size_t)p->t * WIDTH);
    if (reads >= DAL__READS_t) *t = dal_num(at->t);
    if (reads >= DAL__READS_tqv) {
        load_lanes(at->work, p->q, at->q, p->n);
        load_lanes(at->work, p->v, at->v, p->n);
        load_lanes(at->work, p->g, at->v + p->n * WIDTH, p->multipliers);
    }
    if (reads >= DAL__READS_tqvpi) load_lanes(at->work, p->pi, at->pi, p->n);
    if (program->checked + program->left == 0) {
        DAL_WIDE(dal__tape_run)(p->tapes, program->tape, at->work, out);
        return DAL_OK;
    }
    double *scratch = at->work + p->scratch * WIDTH;
    DAL_WIDE(dal__tape_run)(p->tapes, program->tape, at->work, scratch);
    const num *all = (const num *)scratch;
    num *to = (num *)out;
    const dal_mask ok = pivots_hold(all + program->outputs, program->checked);
    for (int i = 0; i < program->outputs; i++) to[i] = dal_select(ok, all[i], dal_num(NAN));
    const num *left = all + program->outputs + 2 * program->checked;
    num *pivots = (num *)(at->work + p->pivots_left * WIDTH);
    for (int i = 0; i < program->left; i++) pivots[i] = left[i];
    return DAL_OK;
}

#define CALLBACK(code, name, reads, numbers)                                                       \
    static dal_status name(const dal_system *system, const dal_point *at, double *out)             \
    {                                                                                              \
        return run_program(system, at, out, DAL__PROGRAM_##code, DAL__READS_##reads);              \
    }
DAL_CALLBACK_LIST(CALLBACK)
#undef CALLBACK

dal__run_program *DAL_WIDE(dal__fill_callbacks)(const dal__programs *programs, dal_callbacks *call)
{
#define SET(code, name, ...)                                                                       \
    call->name = programs->program[DAL__PROGRAM_##code].present ? name : NULL;
    DAL_CALLBACK_LIST(SET)
#undef SET
    return run_program;
}
