/* sizes.c - the unit of time and the lengths of a system's motion near a state. */
#include "core/sizes.h"
#include "core/vectors.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

double dal__near_power_of_two(double x)
{
    static const double off_centre = 1.23;
    int exponent;
    if (!isfinite(x)) return 1.0;
    frexp(off_centre * x, &exponent);
    return x > 0.0 ? ldexp(0.5, exponent < -500 ? -500 : exponent > 500 ? 500 : exponent) : 0.0;
}

static int velocities(const dal_system *system) { return system->n + system->multipliers; }

/* Whether a callback succeeds at (q, v, g) = (x, v). */
static bool call(const dal__sizes *w, dal_callback *callback, double t, const double *x,
                 const double *v, double *out)
{
    const dal_point at = {.t = t, .q = x, .v = v, .work = w->work};
    return callback && callback(w->system, &at, out) == DAL_STATUS_OK;
}

static bool field_at(const dal__sizes *w, double t, const double *x, double *f)
{
    const dal_system *s = w->system;
    return call(w, s->call.field, t, x, x + s->n, f) &&
           isfinite(dal__max_abs(f, (size_t)velocities(s)));
}

/* W_ii = (E(u) + E(-u) - 2 E(0))/u^2 for a velocity u of one coordinate; 0 where the kinetic energy
 * does not prevail, or E is not finite. */
static double mass_by_velocity(const dal__sizes *w, int i, double u)
{
    const dal_system *s = w->system;
    double *v = w->scratch, E[3];
    for (int k = 0; k < 3; k++) {
        memset(v, 0, (size_t)velocities(s) * sizeof *v);
        v[i] = (k - 1) * u;
        if (!call(w, s->energy, w->t, w->x, v, &E[k])) return 0.0;
    }
    const double mass = (E[0] - E[1]) + (E[2] - E[1]);
    return isfinite(mass) && fabs(mass) > 0x1p20 * fabs(E[1]) ? fabs(mass / u / u) : 0.0;
}

/* W_ii by the first velocity that is so large that the kinetic energy prevails; *u is the one of
 * another coordinate, most often the same, and becomes this one's. */
static double kinetic_mass(const dal__sizes *w, int i, double *u)
{
    static const double first = 0x1p-400, end = 0x1p400, factor = 0x1p10;
    double mass = 0.0;
    if (!w->system->energy) return 0.0;
    if (*u > first && *u < end && mass_by_velocity(w, i, *u / factor) == 0.0)
        mass = mass_by_velocity(w, i, *u);
    if (mass > 0.0) return mass;
    for (*u = first; *u < end; *u *= factor) {
        mass = mass_by_velocity(w, i, *u);
        if (mass > 0.0) return mass;
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
        for (int j = 0; j < size; j++) {
            J[i * size + j] *= factor;
            J[j * size + i] /= factor;
        }
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

/* Beyond this size of a system J costs more than it is worth. */
enum { MAX_JACOBIAN = 200 };

static bool has_jacobian(const dal_system *s)
{
    return s->call.jacobian != NULL && s->n <= MAX_JACOBIAN;
}

/* F_q, F_(v,g), J, and two vectors. */
static size_t jacobian_memory(const dal_system *s)
{
    const size_t n = (size_t)s->n, nw = (size_t)velocities(s);
    return has_jacobian(s) ? nw * (n + nw) + 4 * n * n + 4 * n : 0;
}

/* 0 where the system has no jacobian, or J is nilpotent. */
static double rate_of_jacobian(const dal__sizes *w)
{
    const dal_system *s = w->system;
    const int n = s->n, nw = velocities(s), size = 2 * n;
    double *F_q = w->jacobian, *F_v = F_q + nw * n, *J = F_v + nw * nw, *x = J + size * size;
    if (!has_jacobian(s) || !call(w, s->call.jacobian, w->t, w->x, w->x + n, F_q)) return 0.0;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < size; j++) J[i * size + j] = j == n + i;
        memcpy(J + (n + i) * size, F_q + i * n, (size_t)n * sizeof *J);
        memcpy(J + (n + i) * size + n, F_v + i * nw, (size_t)n * sizeof *J);
    }
    balance(J, size);
    return spectral_radius(J, size, x, x + size);
}

/* A spectral radius so far below the rate of the motion consists of roundings; near rest the rate
 * of the motion is no measure of time. */
static const double negligible = 1e-6, near_rest = 4.0;

static double time_unit(const dal__sizes *w, double radius)
{
    const int n = w->system->n;
    double F = 0.0, v = 0.0; /* squares in the metric of the kinetic energy */
    for (int i = 0; i < n; i++) {
        F += w->mass[i] * w->field[i] * w->field[i];
        v += w->mass[i] * w->x[n + i] * w->x[n + i];
    }
    const double motion = v > 0.0 ? sqrt(F / v) : 0.0;
    const double rate =
        radius > negligible * motion ? fmax(radius, fmin(motion, near_rest * radius)) : motion;
    const double time = rate > 0.0 ? 1.0 / rate : 10.0 * fabs(w->step);
    return time > 0.0 ? dal__near_power_of_two(time) : 1.0;
}

/* length[n]: the largest tau |v_i| and tau^2 |F_i| in the beginning of the motion, by the explicit
 * midpoint rule, at the same times for every division of its steps; where F fails it ends.  With a
 * division the motion begins some roundings beside x. */
static void follow_motion(const dal__sizes *w, int division, double *length)
{
    enum { STEPS = 4, TO_UNIT = 16 }; /* a quarter: it may become singular soon */
    static const double roundings = 0x1p-44;
    const int n = w->system->n, nw = velocities(w->system);
    const double tau = w->time, h = copysign(tau / (TO_UNIT * division), w->step);
    double *x = w->scratch, *middle = x + n + nw, *f = middle + n + nw;
    for (int i = 0; i < n; i++) length[i] = 0.0;
    for (int i = 0; i < n + nw; i++) x[i] = w->x[i] * (1.0 + (division - 1) * (i + 1) * roundings);
    for (int k = 0; k < STEPS * division && field_at(w, w->t + k * h, x, f); k++) {
        for (int i = 0; i < n; i++) {
            const double size = tau * fmax(fabs(x[n + i]), tau * fabs(f[i]));
            if (k % division == 0) length[i] = fmax(length[i], size);
            middle[i] = x[i] + 0.5 * h * x[n + i];
        }
        for (int i = 0; i < nw; i++) middle[n + i] = x[n + i] + 0.5 * h * f[i];
        if (!field_at(w, w->t + (k + 0.5) * h, middle, f)) break;
        for (int i = 0; i < n; i++) x[i] += h * middle[n + i];
        for (int i = 0; i < nw; i++) x[n + i] += h * f[i];
    }
}

/* What differs by half between two divisions is an error of the rule or of F: such a coordinate
 * does not move. */
static void find_motion(dal__sizes *w)
{
    double *length = w->length, *other = w->other;
    follow_motion(w, 1, length);
    follow_motion(w, 2, other);
    for (int i = 0; i < w->system->n; i++)
        if (fabs(length[i] - other[i]) > 0.5 * length[i]) length[i] = 0.0;
}

static void find_lengths(dal__sizes *w)
{
    static const double rounding = 1e-10; /* fractions of a length of equal energy */
    const int n = w->system->n;
    double energy = 0.0, *length = w->length;
    for (int i = 0; i < n; i++)
        if (isfinite(length[i])) energy = fmax(energy, w->mass[i] * length[i] * length[i]);
    for (int i = 0; i < n; i++) {
        const double likewise = w->mass[i] > 0.0 ? sqrt(energy / w->mass[i]) : 0.0;
        double size = length[i];
        if (size <= rounding * likewise) size = likewise; /* forces that cancel */
        if (size == 0.0) size = fabs(w->x[i]);
        if (size == 0.0) size = 1.0;
        length[i] = dal__near_power_of_two(size);
    }
}

size_t dal__sizes_memory(const dal_system *system)
{
    const size_t n = (size_t)system->n, nw = (size_t)velocities(system);
    return 3 * n + nw + 2 * (n + nw) + nw + jacobian_memory(system);
}

void dal__find_sizes(dal__sizes *w, double *memory)
{
    const int n = w->system->n, nw = velocities(w->system);
    double u = 0.0;
    w->length = memory;
    w->mass = w->length + n;
    w->field = w->mass + n;
    w->other = w->field + nw;
    w->scratch = w->other + n;
    w->jacobian = w->scratch + 2 * (n + nw) + nw;
    for (int i = 0; i < n; i++) w->mass[i] = kinetic_mass(w, i, &u);
    w->time = field_at(w, w->t, w->x, w->field) ? time_unit(w, rate_of_jacobian(w)) : 1.0;
    find_motion(w);
    find_lengths(w);
}
