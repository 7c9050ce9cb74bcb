/* emit_callbacks.c - the programs of a system as C: dal_eval, the start, the observables. */
#include "codegen/emit_callbacks.h"
#include "expr/taylor_emit.h"
#include "run/run.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A longer program is a function that is not inlined; implicit methods evaluate one at many
 * places.  A compiler takes more than twice as long for a function of twice the length: one longer
 * still is split into functions of CHUNK operations. */
enum { MAX_INLINED = 600, MAX_INLINED_IMPLICIT = 120, MAX_WHOLE = 1000, CHUNK = 500 };

/* ---- inputs ---- */

static void name_inputs(dal__generation *g)
{
    const dal__programs *p = g->programs;
    const dal__equations *e = p->equations;
    const int first = (int)p->tapes->first_input, count = e->symbols - e->parameters;
    g->input = calloc((size_t)count + 1, sizeof *g->input);
    g->text.out_of_memory |= !g->input;
    if (!g->input) return;
    snprintf(g->input[p->t - first].text, sizeof g->input->text, "DAL_NUM_TIME(t)");
    for (int i = 0; i < p->n; i++) {
        snprintf(g->input[p->q - first + i].text, sizeof g->input->text, "q[%d]", i);
        snprintf(g->input[p->v - first + i].text, sizeof g->input->text, "v[%d]", i);
    }
    for (int i = 0; i < dal__momenta_read(DAL__READS_tqv_pi_c, p->n, e->m); i++)
        snprintf(g->input[p->pi - first + i].text, sizeof g->input->text, "pi[%d]", i);
    for (int i = 0; i < p->multipliers; i++)
        snprintf(g->input[p->g - first + i].text, sizeof g->input->text, "v[%d]", p->n + i);
    snprintf(g->input[p->e - first].text, sizeof g->input->text, "pi[0]");
}

/* ---- programs ---- */

static bool is_inlined(const dal__generation *g, dal__program_code code)
{
    const int length = g->programs->tapes->tape[g->programs->program[code].tape].length;
    const int max = g->kernel & DAL_KERNEL_SOLVE ? MAX_INLINED_IMPLICIT : MAX_INLINED;
    return code != DAL__PROGRAM_JACOBIAN && length <= max;
}

/* Ordering the operations of a long straight line takes a compiler too much time. */
static const char unordered[] = "#ifndef __clang__\n"
                                "__attribute__((optimize(\"no-schedule-insns\")))\n"
                                "#endif\n";

static void write_program(dal__generation *g, dal__program_code code, const char *name)
{
    if (!dal__wants(g, code)) return;
    const bool is_cold = code == DAL__PROGRAM_JACOBIAN;
    const int length = g->programs->tapes->tape[g->programs->program[code].tape].length;
    const char *const kind = is_inlined(g, code) ? "DAL_INLINE"
                             : is_cold           ? "DAL_COLD"
                                                 : "static DAL_UNUSED __attribute__((noinline))";
    const int tape = g->programs->program[code].tape;
    const int most = length > MAX_WHOLE ? CHUNK : MAX_WHOLE;
    dal__tape_writer *writer =
        dal__tape_writer_create(g->programs->tapes, tape, g->input, &g->text);
    int chunks = 0;
    for (bool more = writer; more;) {
        if (is_cold && length > MAX_INLINED) dal__buffer_append(&g->text, unordered);
        if (length > most)
            dal__buffer_print(&g->text, "%s void dal__%s_%d(DAL__ARGUMENTS, num *passed)\n{\n",
                              kind, name, ++chunks);
        else
            dal__buffer_print(&g->text, "%s void dal__%s(DAL__ARGUMENTS)\n{\n", kind, name);
        more = dal__tape_write_chunk(writer, most);
        dal__buffer_append(&g->text, "}\n");
    }
    dal__tape_writer_free(writer);
    if (chunks == 0) return;
    dal__buffer_print(&g->text, "%s void dal__%s(DAL__ARGUMENTS)\n{\n    num passed[%d];\n", kind,
                      name, dal__tapes_passed(g->programs->tapes));
    for (int i = 1; i <= chunks; i++)
        dal__buffer_print(&g->text, "    dal__%s_%d(w, t, q, v, pi, out, passed);\n", name, i);
    dal__buffer_append(&g->text, "}\n");
}

/* Whether a program writes its outputs where they belong: no pivots follow them. */
static bool is_direct(const dal__generation *g, dal__program_code code)
{
    const dal__program *p = &g->programs->program[code];
    return is_inlined(g, code) && p->checked + p->saved == 0 && !p->is_by_columns;
}

/* The case of one callback.  A function that is not inlined gets copies, so that the state itself
 * can stay in registers. */
static void write_case(dal__generation *g, dal__program_code code, int reads, const char *callback,
                       const char *name)
{
    const dal__program *p = &g->programs->program[code];
    const int outputs = p->outputs, pivots = outputs + 2 * p->checked, all = pivots + p->saved;
    if (!dal__wants(g, code)) return;
    if (is_direct(g, code)) {
        dal__buffer_print(&g->text, "    case DAL_EVAL_%s: dal__%s(w, t, q, v, pi, out); break;\n",
                          callback, name);
        return;
    }
    dal__buffer_print(&g->text, "    case DAL_EVAL_%s: {\n        num all[%d];\n", callback,
                      all > 0 ? all : 1);
    if (is_inlined(g, code)) {
        dal__buffer_print(&g->text, "        dal__%s(w, t, q, v, pi, all);\n", name);
    } else {
        const int momenta =
            reads == DAL__READS_tqve ? 1 : dal__momenta_read(reads, g->layout.n, g->layout.m);
        dal__buffer_print(&g->text,
                          "        num q_[DAL_FIXED_N], v_[DAL_FIXED_NW], pi_[%d];\n"
                          "        DAL_EACH(i, DAL_FIXED_N) q_[i] = q[i];\n"
                          "        DAL_EACH(i, DAL_FIXED_NW) v_[i] = v[i];\n"
                          "        DAL_EACH(i, %d) pi_[i] = %s;\n",
                          momenta > 0 ? momenta : g->layout.n, momenta > 0 ? momenta : g->layout.n,
                          momenta > 0 ? "pi[i]" : "dal_num(0.0)");
        dal__buffer_print(&g->text, "        dal__%s(w, t, q_, v_, pi_, all);\n", name);
    }
    dal__buffer_print(&g->text, "        dal__mask_singular(all, %d, %d, out);\n", outputs,
                      p->checked);
    if (p->saved > 0 && g->layout.pivots > 0 && g->product != DAL__PRODUCT_OBSERVE)
        dal__buffer_print(&g->text,
                          "        if (pivots)\n            DAL_EACH(i, %d) "
                          "pivots[i * DAL_STEP_GROUPS] = all[%d + i];\n",
                          p->saved, pivots);
    if (p->is_by_columns)
        dal__buffer_print(&g->text, "        dal__insert_columns(w, t, q, v, %d, out);\n", outputs);
    dal__buffer_append(&g->text, "        break;\n    }\n");
}

/* What insert_columns in model/programs_wide.c does. */
static void write_columns(dal__generation *g)
{
    const dal__program *p = &g->programs->program[DAL__PROGRAM_REACTION];
    const int n = g->layout.n, m = g->layout.m, first = m + m * n;
    if (!dal__inserts_columns(g)) return;
    dal__buffer_append(
        &g->text,
        "/* Inserts W^-1 B^T after D and A: column a is the reaction of a unit multiplier. */\n"
        "static DAL_UNUSED __attribute__((noinline)) void dal__insert_columns(const dal_stored "
        "*w,\n"
        "    dal_time t, const num *q, const num *v, int outputs, num *out)\n{\n");
    dal__buffer_print(
        &g->text,
        "    num l[%d], all[%d], column[%d];\n"
        "    for (int i = outputs; i-- > %d;) out[%d + i] = out[i];\n"
        "    DAL_EACH(a, %d) l[a] = dal_num(0.0);\n    for (int a = 0; a < %d; a++) {\n",
        m + 1, n + 2 * p->checked + p->saved, n, first, m * n, m + 1, m);
    dal__buffer_print(&g->text,
                      "        l[a] = dal_num(1.0);\n        dal__reaction(w, t, q, v, l, all);\n"
                      "        dal__mask_singular(all, %d, %d, column);\n"
                      "        DAL_EACH(i, %d) out[%d + i * %d + a] = column[i];\n"
                      "        l[a] = dal_num(0.0);\n    }\n}\n",
                      n, p->checked, n, first, m);
}

static void write_mask(dal__generation *g)
{
    dal__buffer_append(
        &g->text,
        "/* Copies the outputs; NaN in the lanes where one of the pivots after them, each\n"
        " * followed by its size, has vanished. */\n"
        "DAL_INLINE void dal__mask_singular(const num *all, int outputs, int pivots, "
        "num *out)\n{\n"
        "    dal_mask ok = dal_all();\n"
        "    DAL_EACH(k, pivots)\n    ok &= dal_less(");
    dal__buffer_number(&g->text, DAL__PIVOT_LEAST);
    dal__buffer_append(&g->text, " * all[outputs + 2 * k + 1], dal_abs(all[outputs + 2 * k]));\n"
                                 "    DAL_EACH(i, outputs) out[i] = dal_select(ok, all[i], "
                                 "dal_num(NAN));\n}\n");
}

static void write_dispatch(dal__generation *g)
{
    bool direct = true;
#define PROGRAM(code, name, ...)                                                                   \
    if (dal__wants(g, DAL__PROGRAM_##code)) direct &= is_direct(g, DAL__PROGRAM_##code);
    DAL_CALLBACK_LIST(PROGRAM)
#undef PROGRAM
    if (!direct) write_mask(g);
    write_columns(g);
    dal__buffer_append(
        &g->text, "/* Evaluates a callback for one group of lanes; leaves the pivots of F. */\n"
                  "DAL_INLINE void dal__eval_program(const dal_stored *w, dal_callback_code "
                  "code, dal_time t, const num *q,\n    const num *v, const num *pi, num *out, "
                  "num *pivots)\n{\n    switch (code) {\n");
#define PROGRAM(code, name, reads, numbers)                                                        \
    write_case(g, DAL__PROGRAM_##code, DAL__READS_##reads, #code, #name);
    DAL_CALLBACK_LIST(PROGRAM)
#undef PROGRAM
    if (dal__evaluates(g, DAL__PROGRAM_GAUGE) && !dal__wants(g, DAL__PROGRAM_GAUGE))
        dal__buffer_append(&g->text, "    case DAL_EVAL_GAUGE: out[0] = dal_num(0.0); break;\n");
    dal__buffer_append(&g->text, "    default: break;\n    }\n}\n");
}

/* ---- Taylor series ---- */

/* The body of the recurrences for order 0, with all outputs, or for an order k, without those that
 * are needed by their values alone: pivots.  That for k is inlined into the loop over orders; for 0
 * it would take compilers more time than it saves. */
static void write_orders(dal__generation *g, dal__coefficient which, int outputs, int end)
{
    const dal__taylor *taylor = g->programs->taylor[g->layout.lifted];
    dal__buffer *text = &g->text;
    dal__buffer_print(text,
                      "%s void dal__series_%s(const dal_stored *w, int k,\n    num "
                      "(*DAL_RESTRICT c)[DAL_FIXED_TAYLOR_ORDER + 1], num *DAL_RESTRICT l, num "
                      "*out)\n{\n",
                      which == DAL__FIRST ? "static DAL_UNUSED __attribute__((noinline))"
                                          : "DAL_INLINE",
                      which == DAL__FIRST ? "first" : "next");
    dal__taylor_write(taylor, g->programs->tapes, which, g->lanes, text);
    for (int i = 0; i < taylor->outputs; i++) {
        if (which == DAL__NEXT && i >= outputs && i < end) continue;
        dal__buffer_print(text, "    out[%d] = ", i);
        dal__taylor_write_output(taylor, g->programs->tapes, i, which, text);
        dal__buffer_append(text, ";\n");
    }
    dal__buffer_append(text, "}\n");
}

/* dal_eval_series; what dal__call_series in model/programs_wide.c does. */
static void write_series(dal__generation *g)
{
    if (!(g->kernel & DAL_KERNEL_SERIES)) return;
    const bool lifted = g->layout.lifted;
    const dal__taylor *taylor = g->programs->taylor[lifted];
    const dal__program *p =
        &g->programs->program[lifted ? DAL__PROGRAM_ADJOINT : DAL__PROGRAM_FIELD];
    const int outputs = p->outputs, pivots = outputs + 2 * p->checked, end = pivots + p->saved;
    dal__buffer *text = &g->text;
    write_orders(g, DAL__FIRST, outputs, end);
    write_orders(g, DAL__NEXT, outputs, end);
    dal__buffer_print(text,
                      "DAL_INLINE void dal_eval_series(dal_step *s, int k, int stride, const num "
                      "*in, num *memory, num *out)\n{\n"
                      "    num (*const c)[DAL_FIXED_TAYLOR_ORDER + 1] =\n        (num "
                      "(*)[DAL_FIXED_TAYLOR_ORDER + 1])memory;\n"
                      "    num *const packed = (num *)(((size_t)(c + %d) + 63) / 64 * 64);\n"
                      "    num all[%d];\n    DAL_EACH(i, %d) c[i][k] = in[i];\n"
                      "    if (k == 0) dal__series_first(s->work, k, c, packed, all);\n"
                      "    else dal__series_next(s->work, k, c, packed, all);\n"
                      "    DAL_EACH(i, %d) out[i] = all[i];\n",
                      taylor->slots, taylor->outputs, taylor->inputs, outputs);
    const int gauge = g->programs->program[DAL__PROGRAM_GAUGE].present, after = end + gauge;
    if (lifted && gauge)
        dal__buffer_print(text, "    out[%d] = all[%d];\n", outputs, end);
    else if (lifted)
        dal__buffer_print(text, "    out[%d] = dal_num(0.0);\n", outputs);
    if (lifted && taylor->outputs > after)
        dal__buffer_print(text, "    DAL_EACH(i, %d) out[%d + i] = all[%d + i];\n",
                          taylor->outputs - after, outputs + 1, after);
    if (p->checked > 0)
        dal__buffer_print(text, "    if (k == 0) dal__mask_singular(all, %d, %d, out);\n", outputs,
                          p->checked);
    if (p->saved > 0 && g->layout.pivots > 0)
        dal__buffer_print(text,
                          "    if (k == 0 && !s->pivots_known[0]) {\n"
                          "        DAL_EACH(i, %d) s->pivots[i] = all[%d + i];\n"
                          "        s->pivots_known[0] = true;\n    }\n",
                          p->saved, pivots);
    dal__buffer_append(text, "}\n");
}

/* ---- parameters and start ---- */

void dal__write_start(dal__generation *g)
{
    const dal__layout *k = &g->layout;
    const int first = k->n + k->nw;
    bool is_written[DAL__PROGRAM_COUNT] = {0}; /* tapes */
    for (int code = 0; code < DAL__PROGRAM_COUNT; code++)
        if (dal__wants(g, (dal__program_code)code))
            is_written[g->programs->program[code].tape] = true;
    dal__buffer_append(&g->text, "/* What is made of the parameters alone. */\n"
                                 "static void dal__hoist(dal_stored *w)\n{\n    (void)w;\n");
    dal__tapes_write_hoisted(g->programs->tapes, is_written, &g->text);
    dal__buffer_append(&g->text, "}\nstatic const double dal__start_time = ");
    dal__buffer_number(&g->text, k->start_time);
    dal__buffer_print(
        &g->text,
        ";\n"
        "static void dal__start(const dal_stored *work, num *y)\n{\n"
        "    num out[%d];\n"
        "    dal__start_values(work, DAL_TIMES(dal__start_time), NULL, NULL, NULL, out);\n"
        "    for (int i = 0; i < DAL_FIXED_DIM; i++) y[i] = i < %d ? out[i] : "
        "dal_num(0.0);\n",
        first + 1, first + (k->lifted ? 1 : 0));
    for (int i = 0; i < g->spec->start_count; i++) {
        dal__buffer_print(&g->text, "    y[%d] = dal_num(",
                          dal_run_component_index(g->run, g->spec->start[i].name));
        dal__buffer_number(&g->text, g->spec->start[i].value);
        dal__buffer_append(&g->text, ");\n");
    }
    const bool is_moved = k->options.consistent || k->system->solved_velocities > 0 ||
                          k->system->solved_coordinates > 0;
    for (int i = k->system->holonomic > 0 ? 0 : k->n; is_moved && i < 2 * k->n; i++) {
        dal__buffer_print(&g->text, "    y[%d] = dal_num(", i);
        dal__buffer_number(&g->text, dal_run_state(g->run)[i]);
        dal__buffer_append(&g->text, ");\n");
    }
    dal__buffer_append(&g->text, "}\n");
}

void dal__emit_callbacks(dal__generation *g)
{
    name_inputs(g);
    if (!g->input) return;
    dal__buffer_append(&g->text,
                       dal__has_times(g)
                           ? "/* Each lane has its time. */\n"
                             "typedef num dal_time;\n#define DAL_NUM_TIME(t) (t)\n"
                             "#define DAL_TIMES(t) dal_num(t)\n"
                           : "/* All lanes have one time. */\n"
                             "typedef double dal_time;\n#define DAL_NUM_TIME(t) dal_num(t)\n"
                             "#define DAL_TIMES(t) (t)\n");
    dal__buffer_append(&g->text, "/* ---- the system ---- */\n"
                                 "#define DAL__ARGUMENTS const dal_stored *w, dal_time t, const "
                                 "num *q, const num *v, \\\n    const num *pi, num *out\n");
    dal__tapes_write_tables(g->programs->tapes, &g->text);
#define PROGRAM(code, name, ...) write_program(g, DAL__PROGRAM_##code, #name);
    DAL_CALLBACK_LIST(PROGRAM)
#undef PROGRAM
    if (g->product == DAL__PRODUCT_FILE) write_program(g, DAL__PROGRAM_START, "start_values");
    if (g->product == DAL__PRODUCT_FILE || g->product == DAL__PRODUCT_OBSERVE) {
        write_program(g, DAL__PROGRAM_CONSTRAINTS, "constraints");
        write_program(g, DAL__PROGRAM_ENERGY, "energy");
        write_program(g, DAL__PROGRAM_INVARIANTS, "invariant_values");
        write_program(g, DAL__PROGRAM_REACTIONS, "reactions");
        write_program(g, DAL__PROGRAM_EXACT, "exact");
    }
    free(g->input);
    write_dispatch(g);
    write_series(g);
}

/* ---- observables ---- */

/* What writes a kind of observables; %d is the number of its first. */
static const char *const observed[DAL__OBSERVABLE_KINDS] = {
    [DAL__OBSERVE_D] = "    dal__constraints(w, t, q, v, NULL, out + %d);\n",
    [DAL__OBSERVE_E] = "    dal__energy(w, t, q, v, NULL, out + %d);\n",
    [DAL__OBSERVE_LIFT] =
        "    num f[DAL_FIXED_NW], mu;\n"
        "    dal__eval_program(w, DAL_EVAL_FIELD, t, q, v, NULL, f, NULL);\n"
        "    dal__eval_program(w, DAL_EVAL_GAUGE, t, q, v, y + 2 * DAL_FIXED_N, &mu, "
        "NULL);\n"
        "    dal_lift_observables(y, DAL_FIXED_N, f, K_pi, mu, out + %d);\n",
    [DAL__OBSERVE_INVARIANTS] = "    dal__invariant_values(w, t, q, v, NULL, out + %d);\n",
    [DAL__OBSERVE_REACTIONS] =
        "    num reactions[DAL_FIXED_M + DAL_FIXED_M * DAL_FIXED_N];\n"
        "    dal__reactions(w, t, q, v, NULL, reactions);\n"
        "    dal_reaction_observables(reactions, DAL_FIXED_M, DAL_FIXED_N, out + %d);\n",
    [DAL__OBSERVE_HOLONOMIC] =
        "    dal__eval_program(w, DAL_EVAL_HOLONOMIC, t, q, v, NULL, out + %d, NULL);\n",
    [DAL__OBSERVE_ERROR] = "    num exact[2 * DAL_FIXED_N];\n"
                           "    dal__exact(w, t, q, v, NULL, exact);\n"
                           "    out[%d] = dal_max_distance(exact, q, DAL_FIXED_N);\n",
};

void dal__write_observe(dal__generation *g)
{
    int next = 0;
    dal__buffer_append(
        &g->text,
        "static void dal__observe(const dal_stored *w, dal_time t, const num *y, num *out)\n{\n"
        "    const num *q = y, *v = y + DAL_FIXED_N;\n"
        "    (void)q, (void)v, (void)w, (void)t, (void)out;\n");
    if (dal__wants(g, DAL__PROGRAM_EFFORT))
        dal__buffer_append(
            &g->text, "    num K_pi[3 * DAL_FIXED_N];\n"
                      "    dal__eval_program(w, DAL_EVAL_EFFORT, t, q, v, y + 3 * DAL_FIXED_N + 1, "
                      "K_pi, NULL);\n");
    else if (g->layout.lifted)
        dal__buffer_append(&g->text, "    const num *const K_pi = y + 3 * DAL_FIXED_N + 1;\n");
    for (int kind = 0; kind < DAL__OBSERVABLE_KINDS; kind++) {
        const int count = dal__observable_count(&g->layout, kind, g->run->exact);
        if (count > 0 && observed[kind]) dal__buffer_print(&g->text, observed[kind], next);
        next += count;
    }
    dal__buffer_append(&g->text, "}\n");
}
