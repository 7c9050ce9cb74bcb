/* programs_wide.c - the callbacks of a model's system, over num: they load the inputs of a
 * tape, run it, and leave NaN in the lanes where a checked pivot has vanished. */
#include "core/sizes.h"
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

/* Lanes where every pivot exceeds its fraction of the size; a NaN exceeds nothing. */
static dal_mask pivots_hold(const num *checked, int pivots)
{
    dal_mask ok = dal_all();
    for (int k = 0; k < pivots; k++) {
        const num pivot = checked[2 * k], size = checked[2 * k + 1];
        ok &= dal_less(DAL__PIVOT_LEAST * size, dal_abs(pivot));
    }
    return ok;
}

/* Leaves pivots for the rank check; they are after those that were checked. */
static void save_pivots(const dal__programs *p, const dal__program *program, const num *checked,
                        double *work)
{
    const num *saved = checked + 2 * program->checked;
    num *pivots = (num *)(work + p->saved_pivots * WIDTH);
    for (int i = 0; i < program->saved; i++) pivots[i] = saved[i];
}

/* Leaves NaN in the lanes where a pivot has vanished, and pivots for the rank check. */
static void run_tape(const dal__programs *p, const dal__program *program, double *work, double *out)
{
    const int outputs = program->outputs, pivots = 2 * program->checked + program->saved;
    num *const checked = (num *)(work + p->scratch * WIDTH), *const to = (num *)out;
    DAL_WIDE(dal__tape_execute)(p->tapes, program->tape, work);
    DAL_WIDE(dal__tape_read)(p->tapes, program->tape, 0, outputs, work, out);
    if (pivots == 0) return;
    DAL_WIDE(dal__tape_read)
    (p->tapes, program->tape, outputs, pivots, work, (double *)checked);
    const dal_mask ok = pivots_hold(checked, program->checked);
    for (int i = 0; i < outputs; i++) to[i] = dal_select(ok, to[i], dal_num(NAN));
    save_pivots(p, program, checked, work);
}

/* Inserts R = W^-1 B^T after D and A: column a is the reaction of a unit multiplier. */
static void insert_columns(const dal__programs *p, const dal__program *program, double *work,
                           num *out)
{
    const int n = p->n, m = p->equations->m, first = m + m * n;
    num *const l = (num *)(work + (size_t)p->pi * WIDTH);
    num *const column = (num *)(work + p->column * WIDTH);
    for (int i = program->outputs; i-- > first;) out[m * n + i] = out[i];
    for (int a = 0; a <= m; a++) l[a] = dal_num(0.0);
    for (int a = 0; a < m; a++) {
        l[a] = dal_num(1.0);
        run_tape(p, &p->program[DAL__PROGRAM_REACTION], work, (double *)column);
        for (int i = 0; i < n; i++) out[first + i * m + a] = column[i];
        l[a] = dal_num(0.0);
    }
}

static dal_status run_program(const dal_system *system, const dal_point *at, double *out,
                              dal__program_code code, int reads)
{
    const dal__programs *p = system->data;
    const dal__program *program = &p->program[code];
    num *t = (num *)(at->work + (size_t)p->t * WIDTH);
    if (reads >= DAL__READS_t) *t = at->times ? *(const num *)at->times : dal_num(at->t);
    if (reads >= DAL__READS_tqv) {
        load_lanes(at->work, p->q, at->q, p->n);
        load_lanes(at->work, p->v, at->v, p->n);
        load_lanes(at->work, p->g, at->v + p->n * WIDTH, p->multipliers);
    }
    load_lanes(at->work, p->pi, at->pi, dal__momenta_read(reads, p->n, p->equations->m));
    if (reads == DAL__READS_tqve && at->pi) load_lanes(at->work, p->e, at->pi, 1);
    run_tape(p, program, at->work, out);
    if (program->is_by_columns) insert_columns(p, program, at->work, (num *)out);
    return DAL_STATUS_OK;
}

#define CALLBACK(code, name, reads, numbers)                                                       \
    static dal_status name(const dal_system *system, const dal_point *at, double *out)             \
    {                                                                                              \
        return run_program(system, at, out, DAL__PROGRAM_##code, DAL__READS_##reads);              \
    }
DAL_CALLBACK_LIST(CALLBACK)
#undef CALLBACK

/* Coefficient k of F and its like; at order 0 also what run_program leaves. */
dal_status DAL_WIDE(dal__call_series)(const dal_system *system, int lifted, int k, int stride,
                                      const double *in, double *work, double *memory, double *out)
{
    const dal__programs *p = system->data;
    const dal__taylor *taylor = p->taylor[lifted];
    const dal__program *program = &p->program[lifted ? DAL__PROGRAM_ADJOINT : DAL__PROGRAM_FIELD];
    const int outputs = program->outputs, checked = 2 * program->checked;
    const int further = outputs + checked + program->saved; /* place of mu_e */
    double *scratch = work + p->scratch * WIDTH;
    num *to = (num *)out;
    DAL_WIDE(dal__taylor_run)(taylor, dal__unit_of_time(system), k, stride, in, work, memory);
    DAL_WIDE(dal__taylor_read)(taylor, 0, outputs, k, stride, work, memory, out);
    const int gauge = p->program[DAL__PROGRAM_GAUGE].present, after = further + gauge;
    if (lifted && gauge) DAL_WIDE(dal__taylor_read)
    (taylor, further, 1, k, stride, work, memory, (double *)(to + outputs));
    if (lifted && !gauge) to[outputs] = dal_num(0.0);
    if (lifted && taylor->outputs > after) DAL_WIDE(dal__taylor_read)
    (taylor, after, taylor->outputs - after, k, stride, work, memory, (double *)(to + outputs + 1));
    if (k > 0 || further == outputs) return DAL_STATUS_OK;
    DAL_WIDE(dal__taylor_read)
    (taylor, outputs, further - outputs, k, stride, work, memory, scratch);
    save_pivots(p, program, (const num *)scratch, work);
    const dal_mask ok = pivots_hold((const num *)scratch, program->checked);
    for (int i = 0; i < outputs; i++) to[i] = dal_select(ok, to[i], dal_num(NAN));
    return DAL_STATUS_OK;
}

dal__run_program *DAL_WIDE(dal__fill_callbacks)(const dal__programs *programs, dal_callbacks *call)
{
#define SET(code, name, ...)                                                                       \
    call->name = programs->program[DAL__PROGRAM_##code].present ? name : NULL;
    DAL_CALLBACK_LIST(SET)
#undef SET
    return run_program;
}
