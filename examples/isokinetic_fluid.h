/* isokinetic_fluid.h - 256 soft spheres at constant kinetic energy, a molecular-dynamics system as
 * C callbacks.
 *
 *     coordinates  x_1 .. x_N, y_1 .. y_N, z_1 .. z_N     unit masses, not wrapped into the box
 *     U = sum over pairs of u(r),   r from the nearest image in a periodic cube of side L
 *     D = (|v|^2 - 2K)/2            K = 3N/2: unit temperature
 *     F = f - v (v.f)/(v.v),        f = -U_q                         (Gauss' isokinetic thermostat)
 *
 * The pair energy is r^-12 brought to zero at the cut-off R with two continuous derivatives,
 *
 *     u(r)  = r^-12 + 48 R^-14 r^2 - 21 R^-16 r^4 - 28 R^-12
 *     -u'/r = 12 r^-14 - 96 R^-14 + 84 R^-16 r^2
 *
 * Dettmann and Morriss, Phys. Rev. E 54 (1996) 2495; Evans and Morriss, Statistical Mechanics of
 * Nonequilibrium Liquids (2008), 5.2.
 *
 * A list of the pairs within R + SKIN is part of the work array of the run.  It is built again when
 * a sphere has moved by SKIN/2.  Pairs are ordered by their numbers and those beyond R add nothing,
 * so the sum has the same bits whenever the list was built: a callback must be a function of its
 * point, and this one is.  There are no wide callbacks: a batch evaluates lane by lane. */
#ifndef ISOKINETIC_FLUID_H
#define ISOKINETIC_FLUID_H

#include <dalembert.h>
#include <math.h>
#include <string.h>

enum { FLUID_SPHERES = 256, FLUID_N = 3 * FLUID_SPHERES, FLUID_CELLS = 4, FLUID_PARTS = 8 };
enum { FLUID_MAX_PAIRS = 50 * FLUID_SPHERES };

#define FLUID_CUT  2.0
#define FLUID_SKIN 0.3

/* What work holds after the parameters, for this system alone. */
typedef struct fluid_list {
    double valid; /* 1: built */
    double origin[FLUID_N];
    int begin[FLUID_SPHERES + 1];          /* sphere i's partners are other[begin[i]] ... */
    unsigned short other[FLUID_MAX_PAIRS]; /* ... below begin[i + 1], ascending, all above i */
} fluid_list;

enum { FLUID_KINETIC, FLUID_SIDE, FLUID_PARAMETERS }; /* the parameters K and L, first in work */

static inline fluid_list *fluid_list_of(const dal_point *at)
{
    return (fluid_list *)(at->work + FLUID_PARAMETERS);
}

static inline double fluid_nearest(double distance, double side)
{
    return distance - side * rint(distance * (1.0 / side));
}

static inline double fluid_square(const double *q, double side, int i, int j, double *d)
{
    for (int a = 0; a < 3; a++)
        d[a] = fluid_nearest(q[a * FLUID_SPHERES + i] - q[a * FLUID_SPHERES + j], side);
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

/* Whether no sphere has moved by SKIN/2 since the list was built. */
static inline int fluid_list_holds(const fluid_list *list, const double *q)
{
    const double max_square = 0.25 * FLUID_SKIN * FLUID_SKIN;
    int far = list->valid != 1.0;
    for (int i = 0; i < FLUID_SPHERES; i++) {
        double square = 0.0;
        for (int c = i; c < FLUID_N; c += FLUID_SPHERES)
            square += (q[c] - list->origin[c]) * (q[c] - list->origin[c]);
        far |= !(square < max_square);
    }
    return !far;
}

static inline dal_status fluid_list_make(fluid_list *list, const double *q, double side)
{
    const double reach = (FLUID_CUT + FLUID_SKIN) * (FLUID_CUT + FLUID_SKIN);
    int count = 0;
    double d[3];
    for (int i = 0; i < FLUID_SPHERES; i++) {
        list->begin[i] = count;
        if (count + FLUID_SPHERES > FLUID_MAX_PAIRS) return DAL_STATUS_TOO_LARGE;
        for (int j = i + 1; j < FLUID_SPHERES; j++) {
            list->other[count] = (unsigned short)j;
            count += fluid_square(q, side, i, j, d) < reach;
        }
    }
    list->begin[FLUID_SPHERES] = count;
    memcpy(list->origin, q, sizeof list->origin);
    list->valid = 1.0;
    return DAL_STATUS_OK;
}

/* -u'/r as a function of r^2, and u. */
static inline double fluid_pull(double square)
{
    const double R2 = FLUID_CUT * FLUID_CUT, R14 = R2 * R2 * R2 * R2 * R2 * R2 * R2;
    const double i = 1.0 / square, i2 = i * i, i4 = i2 * i2;
    return 12.0 * (i4 * i2 * i) - (96.0 / R14 - 84.0 / (R14 * R2) * square);
}
static inline double fluid_pair_energy(double square)
{
    const double R2 = FLUID_CUT * FLUID_CUT, R12 = R2 * R2 * R2 * R2 * R2 * R2;
    const double i = 1.0 / square, i3 = i * i * i;
    return i3 * i3 + square / (R12 * R2) * (48.0 - 21.0 / R2 * square) - 28.0 / R12;
}

/* f = -U_q. */
static inline dal_status fluid_forces(const dal_point *at, double *f)
{
    fluid_list *list = fluid_list_of(at);
    const double *q = at->q, side = at->work[FLUID_SIDE];
    double d[3];
    if (!fluid_list_holds(list, q)) {
        const dal_status status = fluid_list_make(list, q, side);
        if (status != DAL_STATUS_OK) return status;
    }
    for (int c = 0; c < FLUID_N; c++) f[c] = 0.0;
    for (int i = 0; i < FLUID_SPHERES; i++) {
        for (int k = list->begin[i]; k < list->begin[i + 1]; k++) {
            const int j = list->other[k];
            const double square = fluid_square(q, side, i, j, d);
            if (square >= FLUID_CUT * FLUID_CUT) continue;
            const double pull = fluid_pull(square);
            for (int a = 0; a < 3; a++) {
                f[a * FLUID_SPHERES + i] += pull * d[a];
                f[a * FLUID_SPHERES + j] -= pull * d[a];
            }
        }
    }
    return DAL_STATUS_OK;
}

/* a.b in eight partial sums: one order of summation, with vector registers or without. */
static inline double fluid_dot(const double *a, const double *b)
{
    double sum[FLUID_PARTS] = {0};
    for (int i = 0; i < FLUID_N; i += FLUID_PARTS)
        for (int j = 0; j < FLUID_PARTS; j++) sum[j] += a[i + j] * b[i + j];
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

/* F from f, in place. */
static inline void fluid_thermostat(const double *v, double *f)
{
    const double h = -fluid_dot(v, f) / fluid_dot(v, v);
    for (int c = 0; c < FLUID_N; c++) f[c] += h * v[c];
}

static inline dal_status fluid_field(const dal_system *system, const dal_point *at, double *out)
{
    const dal_status status = fluid_forces(at, out);
    (void)system;
    if (status == DAL_STATUS_OK) fluid_thermostat(at->v, out);
    return status;
}

static inline dal_status fluid_constraints(const dal_system *system, const dal_point *at,
                                           double *out)
{
    (void)system;
    out[0] = 0.5 * fluid_dot(at->v, at->v) - at->work[FLUID_KINETIC];
    return DAL_STATUS_OK;
}

/* D, A = v and W^-1 A^T = v. */
static inline dal_status fluid_constraint(const dal_system *system, const dal_point *at,
                                          double *out)
{
    memcpy(out + 1, at->v, FLUID_N * sizeof *out);
    memcpy(out + 1 + FLUID_N, at->v, FLUID_N * sizeof *out);
    return fluid_constraints(system, at, out);
}

/* v^2/2 + U; not conserved: the thermostat does work. */
static inline dal_status fluid_energy(const dal_system *system, const dal_point *at, double *out)
{
    double sum = 0.5 * fluid_dot(at->v, at->v), d[3];
    (void)system;
    for (int i = 0; i < FLUID_SPHERES; i++)
        for (int j = i + 1; j < FLUID_SPHERES; j++) {
            const double square = fluid_square(at->q, at->work[FLUID_SIDE], i, j, d);
            if (square < FLUID_CUT * FLUID_CUT) sum += fluid_pair_energy(square);
        }
    out[0] = sum;
    return DAL_STATUS_OK;
}

static inline dal_status fluid_prepare(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)out;
    fluid_list_of(at)->valid = 0.0;
    return DAL_STATUS_OK;
}

/* Velocities without a mean, of kinetic energy K. */
static inline void fluid_start_velocities(double K, double *v)
{
    for (int a = 0; a < 3; a++) {
        double *va = v + a * FLUID_SPHERES, mean = 0.0;
        for (int i = 0; i < FLUID_SPHERES; i++)
            va[i] = sin(1.0 + 17.0 * i * (a + 1.0) + 0.1 * i * i);
        for (int i = 0; i < FLUID_SPHERES; i++) mean += va[i] / FLUID_SPHERES;
        for (int i = 0; i < FLUID_SPHERES; i++) va[i] -= mean;
    }
    const double scale = sqrt(2.0 * K / fluid_dot(v, v));
    for (int c = 0; c < FLUID_N; c++) v[c] *= scale;
}

/* A face-centred cubic lattice, 4 spheres a cell; e = 1. */
static inline dal_status fluid_start(const dal_system *system, const dal_point *at, double *out)
{
    static const double base[4][3] = {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}};
    const double cell = at->work[FLUID_SIDE] / FLUID_CELLS;
    (void)system;
    for (int i = 0; i < FLUID_SPHERES; i++) {
        const int place[3] = {i / 4 % FLUID_CELLS, i / 16 % FLUID_CELLS, i / 64};
        for (int a = 0; a < 3; a++) out[a * FLUID_SPHERES + i] = cell * (place[a] + base[i % 4][a]);
    }
    fluid_start_velocities(at->work[FLUID_KINETIC], out + FLUID_N);
    out[2 * FLUID_N] = 1.0;
    return DAL_STATUS_OK;
}

static const char *const fluid_parameter[] = {"K", "L"};
/* L = (256/0.8)^(1/3) */
static const double fluid_value[] = {1.5 * FLUID_SPHERES, 6.8399037867067877};

static const dal_system fluid_system = {
    .name = "isokinetic fluid",
    .n = FLUID_N,
    .m = 1,
    .parameters = FLUID_PARAMETERS,
    .properties = DAL_D_QUADRATIC | DAL_AUTONOMOUS | DAL_MASS_CONSTANT,
    .parameter = fluid_parameter,
    .value = fluid_value,
    .workspace = FLUID_PARAMETERS + sizeof(fluid_list) / sizeof(double) + 1,
    .call = {.field = fluid_field, .constraint = fluid_constraint},
    .prepare = fluid_prepare,
    .start = fluid_start,
    .constraints = fluid_constraints,
    .energy = fluid_energy};

#endif
