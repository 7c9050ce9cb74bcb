/* programs.c - the programs of a system: which nodes each computes, which pivots it checks.
 *
 * A program's outputs are followed by the pivots it divides by, each with its size; the callbacks
 * check them lane by lane and leave NaN where one has vanished.  Field, adjoint and enforcement
 * leave the pivots of A W^-1 B^T at the end of work, for the rank check. */
#include "model/programs.h"
#include "expr/collect.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "kernel/quad.h"
#include "model/motion.h"
#include <math.h>
#include <string.h>

void dal__programs_free(dal__programs *programs)
{
    dal__tapes_free(programs->tapes);
    dal__taylor_free(programs->taylor[0]);
    dal__taylor_free(programs->taylor[1]);
}

void dal__programs_begin(dal_model *model, dal__programs *programs, int n, int multipliers)
{
    const dal__equations *e = &model->equations;
    dal__programs_free(programs);
    *programs = (dal__programs){.equations = e, .n = n, .multipliers = multipliers};
    programs->tapes = dal__tapes_create(e->graph, e->parameters, e->symbols - e->parameters);
    model->out_of_memory |= !programs->tapes;
}

/* Whether a pivot of A W^-1 B^T varies along a run. */
static bool is_saved(const dal__equations *e, const dal__pivot *p)
{
    return p->constraint > 0 && dal__depends(e->graph, p->pivot, e->parameters, e->symbols);
}

/* Distances in the metric W^-1 say something of the constraints where W is positive definite, which
 * it remains as long as det W, a guard, keeps its sign. */
void dal__programs_save_pivots(const dal__equations *e, dal__programs *programs)
{
    if (!(e->properties & DAL_D_RANK_CHECKED) || e->vakonomic || !e->mass_positive) return;
    for (int k = 0; k < e->pivots; k++) programs->pivots += is_saved(e, &e->pivot[k]);
}

void dal__programs_add_lists(dal_model *model, dal__programs *programs, dal__program_code code,
                             const dal__nodes *lists, int count)
{
    const dal__equations *e = &model->equations;
    dal__program *program = &programs->program[code];
    int total = 3 * e->pivots;
    for (int k = 0; k < count; k++) total += lists[k].count;
    dal__node *all = dal__model_nodes(model, total, 0);
    if (model->out_of_memory) return;
    total = 0;
    for (int k = 0; k < count; k++)
        for (int i = 0; i < lists[k].count; i++) all[total++] = lists[k].list[i];
    program->outputs = total;
    const bool leaves = code == DAL__PROGRAM_FIELD || code == DAL__PROGRAM_ADJOINT ||
                        code == DAL__PROGRAM_ENFORCEMENT;
    const bool motion = leaves || code == DAL__PROGRAM_JACOBIAN;
    const bool inverts_mass = code == DAL__PROGRAM_CONSTRAINT || code == DAL__PROGRAM_BLOCKS ||
                              code == DAL__PROGRAM_ENERGY_NORMAL || code == DAL__PROGRAM_REACTION ||
                              code == DAL__PROGRAM_POSITION;
    for (int k = 0; k < e->pivots; k++) {
        const dal__pivot *p = &e->pivot[k];
        const bool divides = (motion && p->divides & DAL__DIVIDES_MOTION) ||
                             (inverts_mass && p->divides & DAL__DIVIDES_MASS);
        if (!p->checked || !divides) continue;
        all[total++] = p->pivot;
        all[total++] = p->size;
        program->checked++;
    }
    for (int k = 0; k < e->pivots && leaves && programs->pivots > 0; k++) {
        if (!is_saved(e, &e->pivot[k])) continue;
        all[total++] = e->pivot[k].pivot;
        program->saved++;
    }
    program->tape = dal__tapes_add(programs->tapes, all, total);
    program->present = program->tape >= 0;
    model->out_of_memory |= !program->present;
}

void dal__programs_add(dal_model *model, dal__programs *programs, dal__program_code code,
                       const dal__node *outputs, int count)
{
    dal__programs_add_lists(model, programs, code, &(dal__nodes){outputs, count}, 1);
}

/* ---- where the motion fails ---- */

/* The nodes that read tables, each after its argument, into out[2*lookups], and the tables, where
 * not NULL. */
static int list_lookups(const dal__graph *graph, dal__node *out, int *table)
{
    int count = 0;
    for (dal__node i = 1; i <= graph->count; i++) {
        const dal__record r = dal__inspect(graph, i);
        if (r.op != DAL__TABLE || r.symbol % DAL__TABLE_ORDERS) continue;
        if (out) {
            out[2 * count] = r.a;
            out[2 * count + 1] = i;
            table[count] = r.symbol / DAL__TABLE_ORDERS;
        }
        count++;
    }
    return count;
}

void dal__programs_add_diagnosis(dal_model *model, dal__programs *programs)
{
    dal__equations *e = &model->equations;
    const int lookups = list_lookups(e->graph, NULL, NULL), first = 2 * e->pivots + e->m;
    dal__node *out = dal__model_nodes(model, first + 2 * lookups, 0);
    programs->lookup = dal__model_allocate(model, (size_t)lookups + 1, sizeof *programs->lookup);
    programs->lookups = lookups;
    if (model->out_of_memory) return;
    list_lookups(e->graph, out + first, programs->lookup);
    for (int k = 0; k < e->pivots; k++) {
        out[2 * k] = e->pivot[k].pivot;
        out[2 * k + 1] = e->pivot[k].size;
    }
    for (int a = 0; a < e->m; a++) {
        dal__node sum = dal__node_add(e->graph, e->constraint[a], e->c[a]);
        for (int i = 0; i < e->n; i++) sum = dal__node_add(e->graph, sum, e->A[a * e->n + i]);
        out[2 * e->pivots + a] = sum;
    }
    dal__programs_add(model, programs, DAL__PROGRAM_DIAGNOSE, out, first + 2 * lookups);
}

/* ---- derivatives of the motion ---- */

/* Derivatives of e->F follow from its equations; derivatives of another F, by sweeps over F.  Where
 * F is small both are made and the cheaper ones taken. */
enum { MAX_SWEPT = 1000, MAX_COUPLED = 64 };

static bool has_equations(const dal__equations *e, const dal__node *F)
{
    return F == e->F && dal__motion_is_symmetric(e);
}

static bool is_swept(const dal__equations *e, const dal__node *F, int count)
{
    return !has_equations(e, F) || dal__cost(e->graph, F, count) <= MAX_SWEPT;
}

/* The cheaper of two lists where both have been made. */
static const dal__node *cheaper(const dal__equations *e, int count, const dal__node *x,
                                const dal__node *y)
{
    if (!x || !y) return x ? x : y;
    return dal__cost(e->graph, x, count) <= dal__cost(e->graph, y, count) ? x : y;
}

/* F, F_q^T pi and F_v^T pi; by sweeps they are the gradient of pi.F. */
static void add_adjoint(dal_model *model, dal__programs *programs, const dal__node *F)
{
    const dal__equations *e = &model->equations;
    const int n = programs->n;
    dal__node *swept = is_swept(e, F, n) ? dal__model_nodes(model, 3 * n, 0) : NULL;
    dal__node *solved = has_equations(e, F) ? dal__model_nodes(model, 3 * n, 0) : NULL;
    if (model->out_of_memory) return;
    dal__node product = dal__number(e->graph, 0.0);
    for (int i = 0; i < n; i++) {
        dal__node pi = dal__symbol(e->graph, e->pi + i);
        product = dal__node_add(e->graph, product, dal__node_mul(e->graph, pi, F[i]));
        if (swept) swept[i] = F[i];
        if (solved) solved[i] = F[i];
    }
    if (swept) {
        dal__gradient(e->graph, product, e->symbol + e->q, n, swept + n);
        dal__gradient(e->graph, product, e->symbol + e->v, n, swept + 2 * n);
    }
    if (solved) dal__motion_adjoint(model, solved + n, solved + 2 * n);
    const dal__node *out = cheaper(e, 3 * n, swept, solved);
    dal__programs_add(model, programs, DAL__PROGRAM_ADJOINT, out, 3 * n);
}

/* The derivatives by q of all, then those by v and the multipliers of all, row by row; not where
 * these are many and F couples them all, as one continued off D = 0 does. */
static void add_jacobian(dal_model *model, dal__programs *programs, const dal__node *F)
{
    const dal__equations *e = &model->equations;
    const int n = programs->n, nw = n + programs->multipliers, count = nw * (n + nw);
    if (F == e->extended && n > MAX_COUPLED) return;
    dal__node *swept = is_swept(e, F, nw) ? dal__model_nodes(model, count, 0) : NULL;
    dal__node *solved = has_equations(e, F) ? dal__model_nodes(model, count, 0) : NULL;
    if (model->out_of_memory) return;
    for (int i = 0; swept && i < nw; i++) {
        dal__node *by_q = swept + i * n, *by_v = swept + nw * n + i * nw;
        dal__gradient(e->graph, F[i], e->symbol + e->q, n, by_q);
        dal__gradient(e->graph, F[i], e->symbol + e->v, n, by_v);
        dal__gradient(e->graph, F[i], e->symbol + e->g, nw - n, by_v + n);
    }
    if (solved && !dal__motion_jacobian(model, solved, solved + n * n)) solved = NULL;
    const dal__node *out = cheaper(e, count, swept, solved);
    if (out) dal__programs_add(model, programs, DAL__PROGRAM_JACOBIAN, out, count);
}

void dal__programs_add_motion(dal_model *model, dal__programs *programs, const dal__node *F)
{
    int nw = programs->n + programs->multipliers;
    dal__programs_add(model, programs, DAL__PROGRAM_FIELD, F, nw);
    add_jacobian(model, programs, F);
    if (!programs->multipliers) add_adjoint(model, programs, F);
}

/* ---- callbacks of one lane only ---- */

#define CALLBACK(code, name, reads)                                                                \
    static dal_status name(const dal_system *system, const dal_point *at, double *out)             \
    {                                                                                              \
        const dal__programs *p = system->data;                                                     \
        return p->run(system, at, out, DAL__PROGRAM_##code, DAL__READS_##reads);                   \
    }
DAL__SINGLE_LIST(CALLBACK)
CALLBACK(PICTURE, picture, tqv)
CALLBACK(BRANCH_VALUES, branch_values, tqv)
CALLBACK(BRANCH_RATES, branch_rates, tqv)
#undef CALLBACK

/* ---- branches ---- */

/* The values between which branch k at a point stays. */
static void bounds(const dal_system *system, int k, double point, double *lower, double *upper)
{
    const dal__programs *p = system->data;
    const dal__switch_point *branch = &p->branch[k];
    if (branch->table == DAL__BRANCH_AT_ZERO) {
        *lower = point < 0.0 ? -INFINITY : 0.0;
        *upper = point < 0.0 ? 0.0 : INFINITY;
    } else if (branch->table == DAL__BRANCH_AT_INTEGERS) {
        *lower = floor(point);
        *upper = *lower + 1.0;
    } else {
        const dal__tape_table *table = &p->tapes->tables[branch->table];
        int first = 0, last = table->knots; /* of the knots from which the next one is chosen */
        while (first < last) {
            const int middle = first + (last - first) / 2;
            if (dal__table_piece(table, middle + 1)[0] <= point)
                first = middle + 1;
            else
                last = middle;
        }
        *lower = first > 0 ? dal__table_piece(table, first)[0] : -INFINITY;
        *upper = first < table->knots ? dal__table_piece(table, first + 1)[0] : INFINITY;
    }
}

static void hold(const dal_system *system, const double *point, double *work)
{
    const dal__programs *p = system->data;
    dal__tapes_hold_x1(p->tapes, point, work);
}

/* ---- sizes of terms ---- */

/* memory: the values of the symbols as the graph numbers them, then memory of the terms. */
static dal_status scale(const dal_system *system, const dal__terms *terms, const dal_point *at,
                        double *memory, double *out)
{
    const dal__programs *p = system->data;
    const dal__equations *e = p->equations;
    memcpy(memory, at->work, (size_t)e->parameters * sizeof *memory);
    memory[e->t] = at->t;
    memcpy(memory + e->q, at->q, (size_t)e->n * sizeof *memory);
    memcpy(memory + e->v, at->v, (size_t)e->n * sizeof *memory);
    memcpy(memory + e->g, at->v + e->n, (size_t)e->multipliers * sizeof *memory);
    dal__terms_scales(terms, memory, memory + e->symbols, out);
    return DAL_STATUS_OK;
}

static dal_status scales(const dal_system *system, const dal_point *at, double *memory, double *out)
{
    const dal__programs *p = system->data;
    return scale(system, p->terms, at, memory, out);
}

static dal_status reaction_scales(const dal_system *system, const dal_point *at, double *memory,
                                  double *out)
{
    const dal__programs *p = system->data;
    return scale(system, p->reaction_terms, at, memory, out);
}

static void point_to_scales(const dal__programs *programs, dal_system *system)
{
    const dal__terms *terms = programs->terms, *reactions = programs->reaction_terms;
    if (!terms) return;
    const size_t size = dal__terms_memory(terms),
                 other = reactions ? dal__terms_memory(reactions) : 0;
    system->scales = scales;
    system->reaction_scales = reactions ? reaction_scales : NULL;
    system->scale_memory = (size_t)programs->equations->symbols + (size > other ? size : other);
}

/* ---- where a program divides ---- */

static bool vanished(const double *pivot)
{
    return !(fabs(pivot[0]) > DAL__PIVOT_LEAST * pivot[1]) || !isfinite(pivot[0]);
}

/* The program's outputs are all pivots with their sizes, then one number for each constraint that
 * is finite if its derivatives are, then the argument and the value of each table.  They are
 * checked in the order in which they are computed:
 * mass, constraints, elimination of the constraints. */
static dal_status diagnose(const dal_system *system, const dal_point *at, double *out)
{
    const dal__programs *p = system->data;
    const dal__equations *e = p->equations;
    double *value = at->work + p->scratch;
    DAL_TRY(p->run(system, at, value, DAL__PROGRAM_DIAGNOSE, DAL__READS_tqv));
    out[0] = 0.0;
    for (int k = 0; k < e->pivots && !e->restricted; k++)
        if (e->pivot[k].constraint == 0 && vanished(value + 2 * k)) return DAL_STATUS_SINGULAR_MASS;
    for (int a = 0; a < e->m; a++) {
        out[0] = a + 1;
        if (!isfinite(value[2 * e->pivots + a])) return DAL_STATUS_SINGULAR;
    }
    for (int k = 0; k < e->pivots; k++) {
        out[0] = e->pivot[k].constraint;
        if (e->pivot[k].constraint && vanished(value + 2 * k)) return DAL_STATUS_SINGULAR;
    }
    for (int k = 0; k < e->pivots && e->restricted; k++) /* whose other pivots need A's */
        if (e->pivot[k].constraint == 0 && vanished(value + 2 * k)) return DAL_STATUS_SINGULAR_MASS;
    const double *lookup = value + 2 * e->pivots + e->m; /* argument, value */
    for (int k = 0; k < p->lookups; k++) {
        out[0] = p->lookup[k] + 1;
        if (isfinite(lookup[2 * k]) && !isfinite(lookup[2 * k + 1])) return DAL_STATUS_NOT_FINITE;
    }
    out[0] = 0.0;
    return DAL_STATUS_OK;
}

/* ---- Taylor coefficients ---- */

/* Adds a program to the series of the physical or the lifted space; places as dal__taylor_add. */
static dal_status add_series(dal__programs *programs, int lifted, dal__program_code code,
                             const uint32_t *places)
{
    const dal__program *program = &programs->program[code];
    if (!program->present) return DAL_STATUS_OK;
    return dal__taylor_add(programs->taylor[lifted], programs->tapes, program->tape,
                           program->outputs, places);
}

/* Series of F, and of its lift where there is one; inputs are t, q, v, g, pi, and e where mu_e is
 * not of t alone. */
static dal_status make_series(dal_model *model, dal__programs *programs)
{
    const int n = programs->n, inputs = 1 + 2 * n + programs->multipliers;
    const bool has_e = programs->program[DAL__PROGRAM_GAUGE_GRADIENT].present;
    uint32_t *places = dal__model_allocate(model, (size_t)(inputs + n + 1), sizeof *places);
    if (!places) return DAL_STATUS_MEMORY;
    places[0] = (uint32_t)programs->t;
    for (int i = 0; i < n; i++) {
        places[1 + i] = (uint32_t)(programs->q + i);
        places[1 + n + i] = (uint32_t)(programs->v + i);
        places[inputs + i] = (uint32_t)(programs->pi + i);
    }
    for (int i = 0; i < programs->multipliers; i++)
        places[1 + 2 * n + i] = (uint32_t)(programs->g + i);
    places[inputs + n] = (uint32_t)programs->e;
    for (int lifted = 0; lifted < 2; lifted++) {
        programs->taylor[lifted] = dal__taylor_create(inputs + lifted * (n + has_e), n);
        if (!programs->taylor[lifted]) return DAL_STATUS_MEMORY;
    }
    DAL_TRY(add_series(programs, 0, DAL__PROGRAM_FIELD, places));
    DAL_TRY(add_series(programs, 1, DAL__PROGRAM_ADJOINT, places));
    DAL_TRY(add_series(programs, 1, DAL__PROGRAM_GAUGE, places));
    DAL_TRY(add_series(programs, 1, DAL__PROGRAM_GAUGE_GRADIENT, places));
    return add_series(programs, 1, DAL__PROGRAM_EFFORT, places);
}

static void point_to_series(dal__programs *programs)
{
    dal_series *series = &programs->series;
    *series = (dal_series){.call = dal__call_series_x1};
    for (int lifted = 0; lifted < 2; lifted++) {
        const dal__taylor *taylor = programs->taylor[lifted];
        series->size[lifted] = (size_t)taylor->slots;
        if (!series->refused) series->refused = taylor->refused;
    }
#define CALLBACK(name, variant, lanes, set)                                                        \
    if (dal__machine_has(DAL__##set)) *at[lanes == 4 ? 1 : lanes == 8 ? 2 : 0] = name##_##variant;
    dal_series_callback **const at[] = {&series->call, &series->wide4, &series->wide8};
    (void)at; /* without lanes the list is empty */
    DAL__VARIANT_LIST(CALLBACK, dal__call_series)
#undef CALLBACK
}

/* ---- the whole ---- */

/* Numbers after scratch: the most pivots of a program, or what the diagnosis writes. */
static size_t scratch_size(const dal__programs *programs)
{
    size_t max = (size_t)programs->program[DAL__PROGRAM_DIAGNOSE].outputs;
    for (int code = 0; code < DAL__PROGRAM_COUNT; code++) {
        const dal__program *program = &programs->program[code];
        const size_t pivots = 2 * (size_t)program->checked + (size_t)program->saved;
        if (pivots > max) max = pivots;
    }
    return max;
}

static dal_status prepare(const dal_system *system, const dal_point *at, double *out)
{
    const dal__programs *programs = system->data;
    (void)out;
    dal__tapes_prepare_x1(programs->tapes, at->work);
    return DAL_STATUS_OK;
}

#if DAL__HAS_QUAD
static void hold_quad(const dal_system *system, const double *point, double *work)
{
    const dal__programs *p = system->data;
    dal__tapes_hold_x1_QUAD(p->tapes, point, work);
}

static dal_status prepare_quad(const dal_system *system, const dal_point *at, double *out)
{
    const dal__programs *programs = system->data;
    (void)out;
    dal__tapes_prepare_x1_QUAD(programs->tapes, at->work);
    return DAL_STATUS_OK;
}

/* The same programs in quad precision, as a system of its own. */
static dal_status make_quad(dal_model *model, const dal__programs *programs, dal_system *system)
{
    if (DAL_QUAD_DIGITS <= DBL_MANT_DIG) return DAL_STATUS_OK;
    dal__quad_system *k = dal__model_allocate(model, 1, sizeof *k);
    if (!k) return DAL_STATUS_MEMORY;
    k->programs = *programs;
    k->programs.run = dal__fill_callbacks_x1_QUAD(&k->programs, &k->programs.wide1);
    k->programs.series.call = dal__call_series_x1_QUAD;
    k->system = *system;
    k->system.data = &k->programs;
    k->system.series = &k->programs.series;
    k->programs.branches.hold = hold_quad;
    if (system->branches) k->system.branches = &k->programs.branches;
    k->system.prepare = prepare_quad;
    k->system.call = k->programs.wide1;
    k->system.wide4 = k->system.wide8 = NULL;
    system->quad = &k->system;
    return DAL_STATUS_OK;
}
#endif

const dal__programs *dal__programs_of(const dal_system *system)
{
    return system->prepare == prepare ? system->data : NULL;
}

/* Operations of a program; 0 where there is none. */
static int operations(const dal__programs *programs, dal__program_code code)
{
    const dal__program *program = &programs->program[code];
    return program->present ? dal__tape_operations(&programs->tapes->tape[program->tape]) : 0;
}

/* The callbacks, if this machine has a variant of that width. */
static const dal_callbacks *if_filled(const dal_callbacks *wide)
{
    return wide->field ? wide : NULL;
}

dal_status dal__programs_finish(dal_model *model, dal__programs *programs, dal_system *system)
{
    if (model->out_of_memory) return DAL_STATUS_MEMORY;
    DAL_TRY(dal__tapes_finish(programs->tapes));
    const dal__equations *e = programs->equations;
    const int inputs = (int)programs->tapes->first_input - e->parameters;
    const bool is_by_columns = programs->program[DAL__PROGRAM_BLOCKS].is_by_columns;
    programs->t = inputs + e->t;
    programs->q = inputs + e->q;
    programs->v = inputs + e->v;
    programs->pi = inputs + e->pi;
    programs->g = inputs + e->g;
    programs->e = inputs + e->e;
    programs->scratch = programs->tapes->workspace;
    system->data = programs;
    programs->saved_pivots = programs->scratch + scratch_size(programs);
    system->pivots = programs->pivots;
    programs->column = programs->saved_pivots + (size_t)programs->pivots;
    system->workspace = programs->column + (is_by_columns ? (size_t)programs->n : 0);
    system->prepare = prepare;
    programs->run = dal__fill_callbacks_x1(programs, &programs->wide1);
#define CALLBACKS(name, variant, lanes, set)                                                       \
    if (dal__machine_has(DAL__##set)) {                                                            \
        dal__run_program *run = name##_##variant(programs, &programs->wide##lanes);                \
        if (lanes == 1) programs->run = run;                                                       \
    }
    DAL__VARIANT_LIST(CALLBACKS, dal__fill_callbacks)
#undef CALLBACKS
    system->call = programs->wide1;
    system->field_operations = operations(programs, DAL__PROGRAM_FIELD);
    system->jacobian_operations = operations(programs, DAL__PROGRAM_JACOBIAN);
#define SET(code, name, reads)                                                                     \
    system->name = programs->program[DAL__PROGRAM_##code].present ? name : NULL;
    DAL__SINGLE_LIST(SET)
#undef SET
    programs->picture = (dal_picture){picture, e->body};
    system->picture = programs->program[DAL__PROGRAM_PICTURE].present ? &programs->picture : NULL;
    system->diagnose = programs->program[DAL__PROGRAM_DIAGNOSE].present ? diagnose : NULL;
    point_to_scales(programs, system);
    const int branches = programs->branches.count;
    programs->branches = (dal_branches){branches, branch_values, branch_rates, bounds, hold};
    system->branches = branches > 0 ? &programs->branches : NULL;
    system->properties |= DAL_WIDE_TIMES;
    DAL_TRY(make_series(model, programs));
    point_to_series(programs);
    system->series = &programs->series;
    system->wide4 = if_filled(&programs->wide4);
    system->wide8 = if_filled(&programs->wide8);
#if DAL__HAS_QUAD
    DAL_TRY(make_quad(model, programs, system));
#endif
    return DAL_STATUS_OK;
}
