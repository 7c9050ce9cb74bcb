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
 * 1/tau is the spectral radius of J = (0 1; F_q F_v) at the start, by power iteration after
 * balancing (Osborne 1960, DOI 10.1145/321043.321048); l_i the largest tau |v_i| or tau^2 |F_i| at
 * the beginning of the motion, or the length of equal kinetic energy, |q_i|, 1, the first that is
 * not 0.  d_a, c and g_k are the largest scales of D_a, E and I_k at points l_i, u_i about the
 * start. */
#include "analysis/scaled.h"
#include "core/error.h"
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
    double *start;                                   /* [n + nw + 1] q, v, g, e, scaled */
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

/* The point in the units of the user; pi has the units given. */
static dal_point to_user(const dal_scaled *s, const dal_point *at, const double *pi_units)
{
    double *q = at->work + s->plain->workspace, *v = q + s->n, *pi = v + s->nw;
    return (dal_point){.t = s->time * at->t,
                       .q = in_units(at->q, s->length, s->n, q),
                       .v = in_units(at->v, s->speed, s->nw, v),
                       .pi = pi_units ? in_units(at->pi, pi_units, s->n, pi) : NULL,
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

static void scale_exact(const dal_scaled *s, double *out)
{
    out = multiply(out, 1.0, 1, NULL, s->n, s->per_length);
    multiply(out, 1.0, 1, NULL, s->n, s->per_speed);
}

/* Signs of guards and numbers of constraints have no unit. */
static void keep(const dal_scaled *s, double *out) { (void)s, (void)out; }

/* A callback of the scaled system, member of the plain one, units of pi, what scales its output. */
#define SCALED_LIST(SCALED)                                                                        \
    SCALED(field, call.field, NULL, scale_field)                                                   \
    SCALED(adjoint, call.adjoint, s->field, scale_adjoint)                                         \
    SCALED(jacobian, call.jacobian, NULL, scale_jacobian)                                          \
    SCALED(constraint, call.constraint, NULL, scale_three_blocks)                                  \
    SCALED(energy_normal, call.energy_normal, NULL, scale_energy_normal)                           \
    SCALED(gauge, call.gauge, NULL, scale_gauge)                                                   \
    SCALED(guards, call.guards, NULL, keep)                                                        \
    SCALED(blocks, call.blocks, NULL, scale_blocks)                                                \
    SCALED(potential, call.potential, NULL, scale_potential)                                       \
    SCALED(constraints, constraints, NULL, scale_constraints)                                      \
    SCALED(energy, energy, NULL, scale_energy)                                                     \
    SCALED(invariant_values, invariant_values, NULL, scale_invariants)                             \
    SCALED(reactions, reactions, NULL, scale_reactions)                                            \
    SCALED(projection, projection, s->speed, scale_three_blocks)                                   \
    SCALED(exact, exact, NULL, scale_exact)                                                        \
    SCALED(diagnose, diagnose, NULL, keep)

#define CALLBACK(name, member, pi_units, scale)                                                    \
    static dal_status name(const dal_system *system, const dal_point *at, double *out)             \
    {                                                                                              \
        const dal_scaled *s = system->data;                                                        \
        const dal_point point = to_user(s, at, pi_units);                                          \
        const dal_status status = s->plain->member(s->plain, &point, out);                         \
        if (status == DAL_OK) scale(s, out);                                                       \
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
    return DAL_OK;
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
    s->system.workspace = p->workspace + (size_t)(2 * s->n + s->nw);
    s->system.pivots = 0; /* they are at the end of the plain work */
    s->system.wide4 = s->system.wide8 = NULL;
    s->system.extended = s->system.quad = NULL;
    s->system.series = NULL;
    s->system.branches = NULL;
    s->system.picture = NULL;
    s->system.events = 0;
    s->system.solved_velocities = 0;
    s->system.start = start;
    s->system.scales = s->system.reaction_scales = NULL;
    s->system.prepare = p->prepare ? prepare_plain : NULL;
#define SET(name, member, ...) s->system.member = p->member ? name : NULL;
    SCALED_LIST(SET)
#undef SET
}

/* ---- the units ---- */

typedef struct survey {
    dal_scaled *s;
    dal_evaluator *evaluator; /* of the plain system */
    double step;
    double t, *x, *f;  /* [n + nw] the present point; [nw] F there */
    double *mass;      /* [n] diagonal of W; 0 where it is unknown */
    double *work;      /* as long as the longest output of a callback */
    dal_status status; /* DAL_MEMORY: a unit could not be found */
} survey;

/* A power of two near x; 0, or 1 for what is not finite.  Numbers that are usual, as 1, sqrt(2) and
 * 2, are far from where it changes. */
static double power_of_two(double x)
{
    static const double off_centre = 1.23;
    int exponent;
    if (!isfinite(x)) return 1.0;
    frexp(off_centre * x, &exponent);
    return x > 0.0 ? ldexp(0.5, exponent < -500 ? -500 : exponent > 500 ? 500 : exponent) : 0.0;
}

static bool field_at(const survey *w, double t, const double *x, double *f)
{
    const dal_system *p = w->s->plain;
    return dal_evaluator_call(w->evaluator, p->call.field, t, x, x + p->n, NULL, f) == DAL_OK &&
           isfinite(dal__max_abs(f, (size_t)w->s->nw));
}

/* W_ii = (E(u) + E(-u) - 2 E(0))/u^2 for a velocity u of one coordinate, so large that the kinetic
 * energy prevails. */
static double kinetic_mass(const survey *w, int i)
{
    const dal_system *p = w->s->plain;
    double *v = w->work, E[3];
    for (double u = 0x1p-400; u < 0x1p400 && p->energy; u *= 0x1p10) {
        for (int k = 0; k < 3; k++) {
            memset(v, 0, (size_t)w->s->nw * sizeof *v);
            v[i] = (k - 1) * u;
            if (dal_evaluator_call(w->evaluator, p->energy, w->t, w->x, v, NULL, &E[k])) return 0.0;
        }
        const double mass = (E[0] - E[1]) + (E[2] - E[1]);
        if (!isfinite(mass)) return 0.0;
        if (fabs(mass) > 0x1p20 * fabs(E[1]) && mass / u / u != 0.0) return fabs(mass / u / u);
    }
    return 0.0;
}

/* The sums of |J_ij| and of |J_ji| over j != i. */
static void off_diagonal_sums(const double *J, int size, int i, double *row, double *column)
{
    *row = *column = -fabs(J[i * size + i]);
    for (int j = 0; j < size; j++) {
        *row += fabs(J[i * size + j]);
        *column += fabs(J[j * size + i]);
    }
}

/* Scales J so that row i and column i are of one size, as far as they are coupled. */
static void balance(double *J, int size)
{
    enum { SWEEPS = 40 };
    for (int k = 0; k < SWEEPS * size; k++) {
        const int i = k % size;
        double row, column;
        off_diagonal_sums(J, size, i, &row, &column);
        const double factor = sqrt(column / row);
        if (!(row > 0.0 && column > 0.0) || !isfinite(factor)) continue;
        for (int j = 0; j < size; j++) J[i * size + j] *= factor;
        for (int j = 0; j < size; j++) J[j * size + i] /= factor;
    }
}

/* By power iteration: the mean growth of a vector, after it has found its directions. */
static double spectral_radius(const double *J, int size, double *x, double *y)
{
    enum { ITERATIONS = 128, FIRST = 64 };
    dal__random random = {11};
    double growth = 0.0;
    for (int i = 0; i < size; i++) x[i] = dal__uniform(&random);
    for (int k = 0; k < ITERATIONS; k++) {
        for (int i = 0; i < size; i++) y[i] = dal__dot_product(size, J + i * size, x);
        const double before = dal__max_abs(x, (size_t)size), after = dal__max_abs(y, (size_t)size);
        if (!(after > 0.0) || !isfinite(after)) return 0.0;
        if (k >= FIRST) growth += log(after / before);
        for (int i = 0; i < size; i++) x[i] = y[i] / after;
    }
    return exp(growth / (ITERATIONS - FIRST));
}

/* 0 where the system has no jacobian, or J is nilpotent. */
static double rate_of_jacobian(survey *w)
{
    const dal_system *p = w->s->plain;
    const int n = w->s->n, nw = w->s->nw, size = 2 * n;
    double *F_q = dal__numbers(1, (size_t)(nw * (n + nw)) + (size_t)(size * size + 2 * size));
    double rate = 0.0;
    if (!F_q) w->status = DAL_MEMORY;
    if (!F_q) return 0.0;
    double *F_v = F_q + nw * n, *J = F_v + nw * nw, *x = J + size * size;
    if (p->call.jacobian && dal_evaluator_call(w->evaluator, p->call.jacobian, w->t, w->x, w->x + n,
                                               NULL, F_q) == DAL_OK) {
        for (int i = 0; i < n; i++) {
            J[i * size + n + i] = 1.0;
            memcpy(J + (n + i) * size, F_q + i * n, (size_t)n * sizeof *J);
            memcpy(J + (n + i) * size + n, F_v + i * nw, (size_t)n * sizeof *J);
        }
        balance(J, size);
        rate = spectral_radius(J, size, x, x + size);
    }
    free(F_q);
    return rate;
}

/* A spectral radius so far below the rate of the motion consists of roundings; near rest the rate
 * of the motion is no measure of time. */
static const double negligible = 1e-6, near_rest = 4.0;

static double time_unit(survey *w)
{
    const double radius = rate_of_jacobian(w);
    double F = 0.0, v = 0.0; /* squares in the metric of the kinetic energy */
    for (int i = 0; i < w->s->n; i++) {
        F += w->mass[i] * w->f[i] * w->f[i];
        v += w->mass[i] * w->x[w->s->n + i] * w->x[w->s->n + i];
    }
    const double motion = v > 0.0 ? sqrt(F / v) : 0.0;
    const double rate =
        radius > negligible * motion ? fmax(radius, fmin(motion, near_rest * radius)) : motion;
    if (rate > 0.0) return power_of_two(1.0 / rate);
    const double step = fabs(w->step);
    return step > 0.0 && isfinite(step) ? power_of_two(10.0 * step) : 1.0;
}

/* Raises the lengths to what the beginning of the motion shows, by the explicit
 * midpoint rule; where F fails it ends. */
static void follow_motion(survey *w, double tau, double *length)
{
    enum { STEPS = 4, STEPS_OF_TAU = 16 }; /* a quarter: it may become singular soon */
    const int n = w->s->n, nw = w->s->nw;
    const double h = copysign(tau / STEPS_OF_TAU, w->step);
    double *x = w->work, *middle = x + n + nw, *f = middle + n + nw;
    memcpy(x, w->x, (size_t)(n + nw) * sizeof *x);
    for (int k = 0; k < STEPS && field_at(w, w->t + k * h, x, f); k++) {
        for (int i = 0; i < n; i++)
            length[i] = fmax(length[i], fmax(tau * fabs(x[n + i]), tau * tau * fabs(f[i])));
        for (int i = 0; i < n; i++) middle[i] = x[i] + 0.5 * h * x[n + i];
        for (int i = 0; i < nw; i++) middle[n + i] = x[n + i] + 0.5 * h * f[i];
        if (!field_at(w, w->t + (k + 0.5) * h, middle, f)) break;
        for (int i = 0; i < n; i++) x[i] += h * middle[n + i];
        for (int i = 0; i < nw; i++) x[n + i] += h * f[i];
    }
}

static void find_lengths(survey *w, double tau)
{
    static const double rounding = 1e-10; /* fraction of a length of equal energy */
    dal_scaled *s = w->s;
    double energy = 0.0;
    follow_motion(w, tau, s->length);
    for (int i = 0; i < s->n; i++)
        if (isfinite(s->length[i])) energy = fmax(energy, w->mass[i] * s->length[i] * s->length[i]);
    for (int i = 0; i < s->n; i++) {
        const double likewise = w->mass[i] > 0.0 ? sqrt(energy / w->mass[i]) : 0.0;
        if (s->length[i] < rounding * likewise) s->length[i] = 0.0; /* forces that cancel */
        s->length[i] = power_of_two(s->length[i]);
        if (s->length[i] == 0.0) s->length[i] = power_of_two(likewise);
        if (s->length[i] == 0.0) s->length[i] = power_of_two(fabs(w->x[i]));
        if (s->length[i] == 0.0) s->length[i] = 1.0;
        s->speed[i] = s->length[i] / tau;
    }
}

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
        if (dal_evaluator_scales(w->evaluator, t, x, x + s->n, scale) != DAL_OK) continue;
        for (int i = 0; i < count; i++)
            if (isfinite(scale[i])) unit[i] = fmax(unit[i], scale[i]);
    }
    for (int i = 0; i < count; i++) {
        unit[i] = power_of_two(unit[i]);
        if (unit[i] == 0.0) unit[i] = 1.0;
    }
}

static void find_units(survey *w)
{
    dal_scaled *s = w->s;
    const int n = s->n, m = s->m;
    for (int i = 0; i < n; i++) w->mass[i] = kinetic_mass(w, i);
    s->time = field_at(w, w->t, w->x, w->f) ? time_unit(w) : 1.0;
    find_lengths(w, s->time);
    find_formula_units(w, s->constraint); /* then energy and invariants */
    s->energy = s->constraint[m];
    for (int a = 0; a < s->nw - n; a++) s->speed[n + a] = s->energy / s->constraint[a];
    for (int i = 0; i < n; i++) s->per_length[i] = 1.0 / s->length[i];
    for (int i = 0; i < s->nw; i++) s->per_speed[i] = 1.0 / s->speed[i];
    for (int i = 0; i < s->nw; i++) s->field[i] = s->time * s->per_speed[i];
    for (int a = 0; a < m; a++) s->per_constraint[a] = 1.0 / s->constraint[a];
    for (int i = 0; i < n; i++) s->start[i] = w->x[i] * s->per_length[i];
    for (int i = 0; i < s->nw; i++) s->start[n + i] = w->x[n + i] * s->per_speed[i];
    s->start[n + s->nw] = w->x[n + s->nw]; /* e has no unit */
}

/* Finds the units from (q, v, g, e) in w->x. */
static dal_status make_scaled(dal_scaled **scaled, const dal_system *p, survey *w, dal_error *error)
{
    const size_t n = (size_t)p->n, nw = n + (size_t)p->multipliers, m = (size_t)p->m;
    const size_t formulas = m + 1 + (size_t)p->invariants;
    const size_t numbers = 1 + n + nw + nw + formulas + n + nw + m + n + nw + 1;
    double *block = dal__numbers(1, nw + n + 3 * (n + nw) + nw + formulas);
    dal_scaled *s = calloc(1, sizeof *s + numbers * sizeof(double));
    if (!s || !block) {
        free(block);
        free(s);
        return dal__fail(error, DAL_MEMORY, "out of memory");
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
    s->start = s->per_constraint + m;
    w->s = s;
    w->f = block;
    w->mass = w->f + nw;
    w->work = w->mass + n;
    find_units(w);
    free(block);
    if (w->status != DAL_OK) {
        free(s);
        return dal__fail(error, w->status, "out of memory");
    }
    s->numbers[0] = s->time;
    make_system(s);
    *scaled = s;
    return DAL_OK;
}

dal_status dal_scaled_create(dal_scaled **scaled, const dal_run_spec *spec, dal_error *error)
{
    DAL_REQUIRE(scaled, error);
    *scaled = NULL;
    DAL_REQUIRE(spec, error);
    const dal_system *p = spec->system;
    DAL_REQUIRE(p, error);
    survey w = {.step = spec->options.step, .t = spec->start_time};
    DAL_TRY(dal_evaluator_create(&w.evaluator, p, spec->parameters, spec->parameter_count, error));
    w.x = dal__numbers(1, (size_t)(2 * p->n + p->multipliers + 1));
    dal_status status = w.x ? DAL_OK : dal__fail(error, DAL_MEMORY, "out of memory");
    if (status == DAL_OK)
        status =
            dal_evaluator_start_at(w.evaluator, w.t, spec->start, spec->start_count, w.x, error);
    if (status == DAL_OK) status = make_scaled(scaled, p, &w, error);
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
    if (!settings) return dal__fail(error, DAL_MEMORY, "out of memory");
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
    survey w = {.step = dal_run_step_size(run), .t = dal_run_time(run)};
    DAL_TRY(evaluator_of_run(&w.evaluator, p, run, error));
    w.x = dal__numbers(1, (size_t)(2 * p->n + p->multipliers + 1));
    dal_status status = w.x ? DAL_OK : dal__fail(error, DAL_MEMORY, "out of memory");
    if (status == DAL_OK) {
        memcpy(w.x, dal_run_state(run), x * sizeof *w.x);
        status = make_scaled(scaled, p, &w, error);
    }
    free(w.x);
    dal_evaluator_free(w.evaluator);
    return status;
}
