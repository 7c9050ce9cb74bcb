/* scaled.c - a system in units of its own, in which the numbers of its motion are near 1.
 *
 *     q_i = l_i Q_i,   t = tau T,   v_i = u_i V_i,   u_i = l_i/tau,   L = c L',   D_a = d_a D'_a
 *
 *     F'_i = tau^2/l_i F_i     A'_ai = u_i/d_a A_ai     W'_ij = u_i u_j/c W_ij
 *     dF'_i/dQ_j = tau^2 l_j/l_i dF_i/dq_j              dF'_i/dV_j = tau l_j/l_i dF_i/dv_j
 *     h'_a = tau d_a/c h_a     E' = E/c     I'_k = I_k/g_k     multipliers g'_a = d_a/c g_a
 *
 * All units are powers of two, so that no digit changes, and change with the units of the user as
 * the quantities do: whatever is found of the scaled system does not depend on those.
 *
 * tau and l_i are the time and the lengths of the motion near the start (core/sizes.h); d_a, c and
 * g_k the largest scales of D_a, E and I_k at points l_i, u_i about the start. */
#include "analysis/scaled.h"
#include "analysis/evaluator.h"
#include "core/error.h"
#include "core/sizes.h"
#include "core/vectors.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

struct dal_scaled {
    dal_system system;       /* the scaled one; its data is this */
    const dal_system *plain; /* in the units of the user */
    int n, nw, m;
    double time, energy;
    double *length, *speed;                          /* [n], [nw] of v and g */
    double *field;                                   /* [nw] what F and dg/dt are multiplied by */
    double *constraint;                              /* [m] */
    double *invariant;                               /* [invariants] */
    double *per_length, *per_speed, *per_constraint; /* their inverses: [n], [nw], [m] */
    double *enforced; /* [n + m + 1] of what enforcement reads, [m + 1] of what reaction reads */
    double *start;    /* [n + nw + 1] q, v, g, e, scaled */
    double numbers[];
};

void dal_scaled_free(dal_scaled *s) { free(s); }

const dal_system *dal_scaled_system(const dal_scaled *s) { return s ? &s->system : NULL; }
const double *dal_scaled_units(const dal_scaled *s) { return s ? s->numbers : NULL; }

void dal__scaled_from_user(const dal_scaled *s, const double *state, double *out)
{
    for (int i = 0; i < s->n; i++) out[i] = state[i] * s->per_length[i];
    for (int i = 0; i < s->nw; i++) out[s->n + i] = state[s->n + i] * s->per_speed[i];
}

void dal__scaled_to_user(const dal_scaled *s, const double *state, double *out)
{
    for (int i = 0; i < s->n; i++) out[i] = state[i] * s->length[i];
    for (int i = 0; i < s->nw; i++) out[s->n + i] = state[s->n + i] * s->speed[i];
}

/* ---- callbacks ---- */

/* out[i*columns + j] times by, row[i] and column[j], where they are given; the place after them. */
static double *multiply(double *out, double by, int rows, const double *row, int columns,
                        const double *column)
{
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            out[i * columns + j] *= by * (row ? row[i] : 1.0) * (column ? column[j] : 1.0);
    return out + (size_t)rows * (size_t)columns;
}

static const double *in_units(const double *x, const double *unit, int count, double *to)
{
    for (int i = 0; x && i < count; i++) to[i] = x[i] * unit[i];
    return x ? to : NULL;
}

/* The point in the units of the user; pi, of count numbers, has the units given. */
static dal_point to_user(const dal_scaled *s, const dal_point *at, const double *pi_units,
                         int count)
{
    double *q = at->work + s->plain->workspace, *v = q + s->n, *pi = v + s->nw;
    return (dal_point){.t = s->time * at->t,
                       .q = in_units(at->q, s->length, s->n, q),
                       .v = in_units(at->v, s->speed, s->nw, v),
                       .pi = pi_units ? in_units(at->pi, pi_units, count, pi) : at->pi,
                       .work = at->work};
}

static void scale_field(const dal_scaled *s, double *out)
{
    multiply(out, 1.0, 1, NULL, s->nw, s->field);
}

static void scale_adjoint(const dal_scaled *s, double *out)
{
    out = multiply(out, 1.0, 1, NULL, s->n, s->field);
    out = multiply(out, 1.0, 1, NULL, s->n, s->length);
    multiply(out, 1.0, 1, NULL, s->n, s->speed);
}

static void scale_jacobian(const dal_scaled *s, double *out)
{
    out = multiply(out, 1.0, s->nw, s->field, s->n, s->length);
    multiply(out, 1.0, s->nw, s->field, s->nw, s->speed);
}

/* D, A, and W^-1 A^T or W^-1 B^T. */
static void scale_three_blocks(const dal_scaled *s, double *out)
{
    out = multiply(out, 1.0, 1, NULL, s->m, s->per_constraint);
    out = multiply(out, 1.0, s->m, s->per_constraint, s->n, s->speed);
    multiply(out, s->energy, s->n, s->per_speed, s->m, s->per_constraint);
}

static void scale_blocks(const dal_scaled *s, double *out)
{
    scale_three_blocks(s, out);
    out = multiply(out + s->m * (1 + 2 * s->n), 1.0, 1, NULL, s->n, s->field);
    multiply(out, s->time, 1, NULL, s->m, s->per_constraint);
}

static void scale_energy_normal(const dal_scaled *s, double *out)
{
    const double per_energy = 1.0 / s->energy;
    out = multiply(out, per_energy, 1, NULL, 1, NULL);
    out = multiply(out, per_energy, 1, NULL, s->n, s->length);
    out = multiply(out, per_energy, 1, NULL, s->n, s->speed);
    multiply(out, s->time, 1, NULL, s->n, s->per_speed);
}

static void scale_gauge(const dal_scaled *s, double *out) { *out *= s->time; }

static void scale_gauge_gradient(const dal_scaled *s, double *out)
{
    out = multiply(out, s->time, 1, NULL, s->n, s->length);
    out = multiply(out, s->time, 1, NULL, s->n, s->speed);
    *out *= s->time;
}

static void scale_potential(const dal_scaled *s, double *out)
{
    const double per_energy = 1.0 / s->energy;
    out = multiply(out, per_energy, 1, NULL, s->n, NULL);
    out = multiply(out, per_energy * s->time, 1, NULL, s->n, NULL);
    multiply(out, per_energy, 1, NULL, s->n, NULL);
}

static void scale_constraints(const dal_scaled *s, double *out)
{
    multiply(out, 1.0, 1, NULL, s->m, s->per_constraint);
}

static void scale_energy(const dal_scaled *s, double *out) { *out /= s->energy; }

static void scale_invariants(const dal_scaled *s, double *out)
{
    for (int k = 0; k < s->system.invariants; k++) out[k] /= s->invariant[k];
}

static void scale_reactions(const dal_scaled *s, double *out)
{
    out = multiply(out, s->time / s->energy, 1, NULL, s->m, s->constraint);
    multiply(out, 1.0, s->m, s->per_constraint, s->n, s->speed);
}

static void scale_correction(const dal_scaled *s, double *out)
{
    multiply(out, 1.0, 1, NULL, s->n, s->per_speed);
}

/* y and pi are accelerations, c is a rate of D, l are multipliers: with beta = 0 all are smaller by
 * one unit of time. */
static void scale_enforcement(const dal_scaled *s, double *out)
{
    out = multiply(out, 1.0, 1, NULL, s->n, s->field);
    multiply(out, s->time / s->energy, 1, NULL, s->m, s->constraint);
}

static void scale_reaction(const dal_scaled *s, double *out)
{
    multiply(out, 1.0, 1, NULL, s->n, s->field);
}

/* The rows D_g are the time derivatives of g. */
static void scale_holonomic(const dal_scaled *s, double *out)
{
    const double *unit = s->per_constraint + s->m - s->system.holonomic;
    multiply(out, 1.0 / s->time, 1, NULL, s->system.holonomic, unit);
}

/* As of enforcement, of g alone. */
static void scale_position(const dal_scaled *s, double *out)
{
    const int first = s->m - s->system.holonomic;
    out = multiply(out, 1.0, 1, NULL, s->n, s->field);
    multiply(out, s->time / s->energy, 1, NULL, s->system.holonomic, s->constraint + first);
}

static void scale_exact(const dal_scaled *s, double *out)
{
    out = multiply(out, 1.0, 1, NULL, s->n, s->per_length);
    multiply(out, 1.0, 1, NULL, s->n, s->per_speed);
}

/* Signs of guards and numbers of constraints have no unit. */
static void keep(const dal_scaled *s, double *out) { (void)s, (void)out; }

/* A callback of the scaled system, member of the plain one, units of pi and how many numbers it
 * has, what scales its output. */
#define SCALED_LIST(SCALED)                                                                        \
    SCALED(field, call.field, NULL, 0, scale_field)                                                \
    SCALED(adjoint, call.adjoint, s->field, s->n, scale_adjoint)                                   \
    SCALED(effort, call.effort, s->field, s->n, scale_adjoint)                                     \
    SCALED(jacobian, call.jacobian, NULL, 0, scale_jacobian)                                       \
    SCALED(constraint, call.constraint, NULL, 0, scale_three_blocks)                               \
    SCALED(energy_normal, call.energy_normal, NULL, 0, scale_energy_normal)                        \
    SCALED(gauge, call.gauge, NULL, 0, scale_gauge)                                                \
    SCALED(gauge_gradient, call.gauge_gradient, NULL, 0, scale_gauge_gradient)                     \
    SCALED(guards, call.guards, NULL, 0, keep)                                                     \
    SCALED(blocks, call.blocks, NULL, 0, scale_blocks)                                             \
    SCALED(potential, call.potential, NULL, 0, scale_potential)                                    \
    SCALED(correction, call.correction, NULL, 0, scale_correction)                                 \
    SCALED(enforcement, call.enforcement, s->enforced, s->n + s->m + 1, scale_enforcement)         \
    SCALED(reaction, call.reaction, s->enforced + s->n + s->m + 1, s->m + 1, scale_reaction)       \
    SCALED(constraint_value, call.constraint_value, NULL, 0, scale_constraints)                    \
    SCALED(holonomic, call.holonomic, NULL, 0, scale_holonomic)                                    \
    SCALED(position, call.position, s->enforced + s->n, s->m + 1, scale_position)                  \
    SCALED(constraints, constraints, NULL, 0, scale_constraints)                                   \
    SCALED(energy, energy, NULL, 0, scale_energy)                                                  \
    SCALED(invariant_values, invariant_values, NULL, 0, scale_invariants)                          \
    SCALED(reactions, reactions, NULL, 0, scale_reactions)                                         \
    SCALED(projection, projection, s->speed, s->n, scale_three_blocks)                             \
    SCALED(exact, exact, NULL, 0, scale_exact)                                                     \
    SCALED(diagnose, diagnose, NULL, 0, keep)

#define CALLBACK(name, member, pi_units, pi_count, scale)                                          \
    static dal_status name(const dal_system *system, const dal_point *at, double *out)             \
    {                                                                                              \
        const dal_scaled *s = system->data;                                                        \
        const dal_point point = to_user(s, at, pi_units, pi_count);                                \
        const dal_status status = s->plain->member(s->plain, &point, out);                         \
        if (status == DAL_STATUS_OK) scale(s, out);                                                \
        return status;                                                                             \
    }
SCALED_LIST(CALLBACK)
#undef CALLBACK

/* The start of the spec: start values are in the units of the user. */
static dal_status start(const dal_system *system, const dal_point *at, double *out)
{
    const dal_scaled *s = system->data;
    (void)at;
    memcpy(out, s->start, (size_t)(s->n + s->nw + 1) * sizeof *out);
    return DAL_STATUS_OK;
}

static dal_status prepare_plain(const dal_system *system, const dal_point *at, double *out)
{
    const dal_scaled *s = system->data;
    return s->plain->prepare(s->plain, at, out);
}

static void make_system(dal_scaled *s)
{
    const dal_system *p = s->plain;
    s->system = *p;
    s->system.data = s;
    s->system.workspace = p->workspace + (size_t)(2 * s->n + s->nw + s->m + 1);
    s->system.pivots = 0; /* they are at the end of the plain work */
    s->system.wide4 = s->system.wide8 = NULL;
    s->system.extended = s->system.quad = NULL;
    s->system.series = NULL;
    s->system.branches = NULL;
    s->system.picture = NULL;
    s->system.units = NULL;
    s->system.events = 0;
    s->system.solved_coordinates = s->system.solved_velocities = 0;
    s->system.start = start;
    s->system.scales = s->system.reaction_scales = NULL;
    s->system.equation_values = NULL;
    s->system.equations = 0;
    s->system.prepare = p->prepare ? prepare_plain : NULL;
#define SET(name, member, ...) s->system.member = p->member ? name : NULL;
    SCALED_LIST(SET)
#undef SET
}

/* ---- the units ---- */

typedef struct survey {
    dal_scaled *s;
    dal_evaluator *evaluator; /* of the plain system */
    dal__sizes sizes;         /* of the motion there */
    double t, *x;             /* [n + nw + 1] the state */
    double *work;             /* for a point and the scales of formulas */
} survey;

/* The units of D, E and invariants, from points about the start; unit[m + 1 + invariants]. */
static void find_formula_units(survey *w, double *unit)
{
    enum { POINTS = 12 };
    static const double neighbourhood = 0.3;
    const dal_scaled *s = w->s;
    const dal_system *p = s->plain;
    const int count = p->m + 1 + p->invariants;
    double *x = w->work, *scale = x + s->n + s->nw;
    dal__random random = {5};
    for (int k = 0; k < POINTS; k++) {
        for (int i = 0; i < s->n + s->nw; i++) {
            const double size = i < s->n ? s->length[i] : i < 2 * s->n ? s->speed[i - s->n] : 0.0;
            x[i] = w->x[i] + neighbourhood * size * dal__uniform(&random);
        }
        const double t = w->t + s->time * dal__uniform(&random);
        if (dal_evaluator_scales(w->evaluator, t, x, x + s->n, scale) != DAL_STATUS_OK) continue;
        for (int i = 0; i < count; i++)
            if (isfinite(scale[i])) unit[i] = fmax(unit[i], scale[i]);
    }
    for (int i = 0; i < count; i++) {
        unit[i] = dal__near_power_of_two(unit[i]);
        if (unit[i] == 0.0) unit[i] = 1.0;
    }
}

static void find_units(survey *w)
{
    dal_scaled *s = w->s;
    const int n = s->n, m = s->m;
    s->time = w->sizes.time;
    for (int i = 0; i < n; i++) {
        s->length[i] = w->sizes.length[i];
        s->speed[i] = s->length[i] / s->time;
    }
    find_formula_units(w, s->constraint); /* then energy and invariants */
    s->energy = s->constraint[m];
    for (int a = 0; a < s->nw - n; a++) s->speed[n + a] = s->energy / s->constraint[a];
    for (int i = 0; i < n; i++) s->per_length[i] = 1.0 / s->length[i];
    for (int i = 0; i < s->nw; i++) s->per_speed[i] = 1.0 / s->speed[i];
    for (int i = 0; i < s->nw; i++) s->field[i] = s->time * s->per_speed[i];
    for (int a = 0; a < m; a++) s->per_constraint[a] = 1.0 / s->constraint[a];
    double *const of_l = s->enforced + n + m + 1;
    for (int i = 0; i < n; i++) s->enforced[i] = s->speed[i] / s->time;
    for (int a = 0; a < m; a++) s->enforced[n + a] = s->constraint[a] / s->time;
    for (int a = 0; a < m; a++) of_l[a] = s->energy / s->time * s->per_constraint[a];
    s->enforced[n + m] = of_l[m] = 1.0; /* beta */
    for (int i = 0; i < n; i++) s->start[i] = w->x[i] * s->per_length[i];
    for (int i = 0; i < s->nw; i++) s->start[n + i] = w->x[n + i] * s->per_speed[i];
    s->start[n + s->nw] = w->x[n + s->nw]; /* e has no unit */
}

/* Finds the units from (q, v, g, e) in w->x. */
static dal_status make_scaled(dal_scaled **scaled, const dal_system *p, survey *w, dal_error *error)
{
    const size_t n = (size_t)p->n, nw = n + (size_t)p->multipliers, m = (size_t)p->m;
    const size_t formulas = m + 1 + (size_t)(p->invariants + p->holonomic);
    const size_t enforced = n + m + 1 + m + 1;
    const size_t numbers = 1 + n + nw + nw + formulas + n + nw + m + enforced + n + nw + 1;
    const size_t sizes = dal__sizes_memory(p);
    double *block = dal__numbers(1, sizes + n + nw + formulas);
    dal_scaled *s = calloc(1, sizeof *s + numbers * sizeof(double));
    if (!s || !block) {
        free(block);
        free(s);
        return dal__memory_error(error);
    }
    s->plain = p;
    s->n = p->n, s->nw = (int)nw, s->m = p->m;
    s->length = s->numbers + 1; /* after the unit of time */
    s->speed = s->length + n;
    s->field = s->speed + nw;
    s->constraint = s->field + nw;
    s->invariant = s->constraint + m + 1;
    s->per_length = s->constraint + formulas;
    s->per_speed = s->per_length + n;
    s->per_constraint = s->per_speed + nw;
    s->enforced = s->per_constraint + m;
    s->start = s->enforced + enforced;
    w->s = s;
    w->sizes.system = p;
    w->sizes.work = dal__evaluator_work(w->evaluator);
    w->sizes.t = w->t;
    w->sizes.x = w->x;
    w->work = block + sizes;
    dal__find_sizes(&w->sizes, block);
    find_units(w);
    free(block);
    s->numbers[0] = s->time;
    make_system(s);
    *scaled = s;
    return DAL_STATUS_OK;
}

dal_status dal_scaled_create(dal_scaled **scaled, const dal_run_spec *spec, dal_error *error)
{
    DAL_REQUIRE(scaled, error);
    *scaled = NULL;
    DAL_REQUIRE(spec, error);
    const dal_system *p = spec->system;
    DAL_REQUIRE(p, error);
    survey w = {.sizes.step = spec->options.step, .t = spec->start_time};
    DAL_TRY(dal_evaluator_create(&w.evaluator, p, spec->parameters, spec->parameter_count, error));
    w.x = dal__numbers(1, (size_t)(2 * p->n + p->multipliers + 1));
    dal_status status = w.x ? DAL_STATUS_OK : dal__memory_error(error);
    if (status == DAL_STATUS_OK)
        status =
            dal_evaluator_start_at(w.evaluator, w.t, spec->start, spec->start_count, w.x, error);
    if (status == DAL_STATUS_OK) status = make_scaled(scaled, p, &w, error);
    free(w.x);
    dal_evaluator_free(w.evaluator);
    return status;
}

/* ---- of a run ---- */

static dal_status evaluator_of_run(dal_evaluator **evaluator, const dal_system *system,
                                   const dal_run *run, dal_error *error)
{
    const double *value = dal_run_parameters(run);
    dal_setting *settings = calloc((size_t)system->parameters + 1, sizeof *settings);
    if (!settings) return dal__memory_error(error);
    for (int i = 0; i < system->parameters; i++)
        settings[i] = (dal_setting){system->parameter[i], value[i]};
    const dal_status status =
        dal_evaluator_create(evaluator, system, settings, system->parameters, error);
    free(settings);
    return status;
}

dal_status dal__evaluator_of_run(dal_evaluator **evaluator, const dal_scaled *scaled,
                                 const dal_run *run, dal_error *error)
{
    return evaluator_of_run(evaluator, scaled ? &scaled->system : dal_run_system(run), run, error);
}

dal_status dal_scaled_create_at(dal_scaled **scaled, const dal_run *run, dal_error *error)
{
    DAL_REQUIRE(scaled, error);
    *scaled = NULL;
    DAL_REQUIRE(run, error);
    const dal_system *p = dal_run_system(run);
    const size_t x = (size_t)(2 * p->n + p->multipliers);
    survey w = {.sizes.step = dal_run_step_size(run), .t = dal_run_time(run)};
    DAL_TRY(evaluator_of_run(&w.evaluator, p, run, error));
    w.x = dal__numbers(1, (size_t)(2 * p->n + p->multipliers + 1));
    dal_status status = w.x ? DAL_STATUS_OK : dal__memory_error(error);
    if (status == DAL_STATUS_OK) {
        memcpy(w.x, dal_run_state(run), x * sizeof *w.x);
        status = make_scaled(scaled, p, &w, error);
    }
    free(w.x);
    dal_evaluator_free(w.evaluator);
    return status;
}
