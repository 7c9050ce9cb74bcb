/* hand.c - the loop somebody would write by hand for one system: the mark that all others are held
 * against.
 *
 *     hand rk4 A|B3|B101       classical Runge-Kutta, libm's sin and cos, plain sums
 *     hand-own rk4 A           the same with this project's sine and cosine (HAND_OWN_SINCOS)
 *     hand midpoint A          implicit midpoint, k <- f(y + h/2 k) until k stagnates
 *     hand leapfrog HH|four_bodies
 *                              half a step of q, a step of v, half a step of q */
#define _POSIX_C_SOURCE 200809L
#include "../examples/contact_chain.h"
#include "bench.h"
#include "real.inc"

#include "fields.inc"

enum { SMALL_STEPS = 1000, LARGE_STEPS = 200, LARGE_DIM = 2 * CHAIN_N };

static inline void chain101_field(const double *y, double *dy)
{
    memcpy(dy, y + CHAIN_N, CHAIN_N * sizeof *dy);
    chain_force(CHAIN_EPS, y, y + CHAIN_N, dy + CHAIN_N);
}

/* STEPS steps of rk4 from start; the state stays in registers where it has room. */
#define RK4(name, DIM, STEPS, field)                                                               \
    static int name(void *start, double *end)                                                      \
    {                                                                                              \
        const double h = BENCH_H_STEP;                                                             \
        double y[DIM], z[DIM], k1[DIM], k2[DIM], k3[DIM], k4[DIM];                                 \
        memcpy(y, start, sizeof y);                                                                \
        for (int step = 0; step < STEPS; step++) {                                                 \
            field(y, k1);                                                                          \
            for (int i = 0; i < DIM; i++) z[i] = y[i] + 0.5 * h * k1[i];                           \
            field(z, k2);                                                                          \
            for (int i = 0; i < DIM; i++) z[i] = y[i] + 0.5 * h * k2[i];                           \
            field(z, k3);                                                                          \
            for (int i = 0; i < DIM; i++) z[i] = y[i] + h * k3[i];                                 \
            field(z, k4);                                                                          \
            for (int i = 0; i < DIM; i++)                                                          \
                y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);                         \
        }                                                                                          \
        memcpy(end, y, sizeof y);                                                                  \
        return 0;                                                                                  \
    }
RK4(rk4_sleigh, SMALL_DIM, SMALL_STEPS, sleigh_field)
RK4(rk4_chain3, SMALL_DIM, SMALL_STEPS, chain3_field)
RK4(rk4_chain101, LARGE_DIM, LARGE_STEPS, chain101_field)

/* One sweep; the largest change of k. */
static inline double sweep(const double *y, double *k)
{
    const double h = BENCH_H_STEP;
    double z[SMALL_DIM], next[SMALL_DIM], change = 0.0;
    for (int i = 0; i < SMALL_DIM; i++) z[i] = y[i] + 0.5 * h * k[i];
    sleigh_field(z, next);
    for (int i = 0; i < SMALL_DIM; i++) {
        change = fmax(change, fabs(next[i] - k[i]));
        k[i] = next[i];
    }
    return change;
}

/* k of the last step is the first guess; it ends when the change does not decrease any more. */
static int midpoint_sleigh(void *start, double *end)
{
    double y[SMALL_DIM], k[SMALL_DIM];
    memcpy(y, start, sizeof y);
    sleigh_field(y, k);
    for (int step = 0; step < SMALL_STEPS; step++) {
        double before = INFINITY, now = sweep(y, k);
        while (now > 0.0 && now < before) {
            before = now;
            now = sweep(y, k);
        }
        for (int i = 0; i < SMALL_DIM; i++) y[i] += BENCH_H_STEP * k[i];
    }
    memcpy(end, y, sizeof y);
    return 0;
}

/* ---- leapfrog ---- */

enum { HH_N = 2, BODIES = 4, BODIES_N = 3 * BODIES };

/* Henon-Heiles, U = (x^2 + y^2)/2 + x^2 y - y^3/3. */
static inline void henon_heiles_force(const double *q, double *f)
{
    f[0] = -q[0] - 2.0 * q[0] * q[1];
    f[1] = -q[1] - q[0] * q[0] + q[1] * q[1];
}

/* Accelerations of bodies that attract each other, G = 1. */
static inline void bodies_force(const double *q, double *f)
{
    static const double mass[BODIES] = {1, 0.02, 0.015, 0.01};
    for (int i = 0; i < BODIES_N; i++) f[i] = 0.0;
    for (int a = 0; a < BODIES; a++)
        for (int b = a + 1; b < BODIES; b++) {
            double d[3], square = 0.0;
            for (int i = 0; i < 3; i++) d[i] = q[3 * b + i] - q[3 * a + i];
            for (int i = 0; i < 3; i++) square += d[i] * d[i];
            const double w = 1.0 / (square * sqrt(square));
            for (int i = 0; i < 3; i++) f[3 * a + i] += mass[b] * w * d[i];
            for (int i = 0; i < 3; i++) f[3 * b + i] -= mass[a] * w * d[i];
        }
}

#define LEAPFROG(name, N, force)                                                                   \
    static int name(void *start, double *end)                                                      \
    {                                                                                              \
        const double h = BENCH_H_STEP;                                                             \
        double q[N], v[N], f[N];                                                                   \
        memcpy(q, start, sizeof q);                                                                \
        memcpy(v, (double *)start + (N), sizeof v);                                                \
        for (int step = 0; step < SMALL_STEPS; step++) {                                           \
            for (int i = 0; i < (N); i++) q[i] += 0.5 * h * v[i];                                  \
            force(q, f);                                                                           \
            for (int i = 0; i < (N); i++) v[i] += h * f[i];                                        \
            for (int i = 0; i < (N); i++) q[i] += 0.5 * h * v[i];                                  \
        }                                                                                          \
        memcpy(end, q, sizeof q);                                                                  \
        memcpy(end + (N), v, sizeof v);                                                            \
        return 0;                                                                                  \
    }
LEAPFROG(leapfrog_henon_heiles, HH_N, henon_heiles_force)
LEAPFROG(leapfrog_bodies, BODIES_N, bodies_force)

/* As in bench/systems. */
static double henon_heiles_y[2 * HH_N] = {0.1, -0.2, 0.3, 0.1};
static double bodies_y[2 * BODIES_N] = {
    0, 0, 0, 0.267499,  0.963558, 0.10, -1.456711, 0.876352,  0.20, -1.887424, -1.788192, 0.30,
    0, 0, 0, -0.963558, 0.267499, 0.05, -0.395372, -0.657204, 0.10, 0.426534,  -0.450204, 0.15};

int main(int argc, char **argv)
{
    static double chain[LARGE_DIM + 1], sleigh[SMALL_DIM], chain3[SMALL_DIM];
    const struct {
        const char *name;
        bench_contender timed;
    } contender[] = {
        {"rk4 A", {SMALL_STEPS, SMALL_DIM, rk4_sleigh, sleigh}},
        {"rk4 B3", {SMALL_STEPS, SMALL_DIM, rk4_chain3, chain3}},
        {"rk4 B101", {LARGE_STEPS, LARGE_DIM, rk4_chain101, chain}},
        {"midpoint A", {SMALL_STEPS, SMALL_DIM, midpoint_sleigh, sleigh}},
        {"leapfrog HH", {SMALL_STEPS, 2 * HH_N, leapfrog_henon_heiles, henon_heiles_y}},
        {"leapfrog four_bodies", {SMALL_STEPS, 2 * BODIES_N, leapfrog_bodies, bodies_y}}};
    memcpy(sleigh, sleigh_y, sizeof sleigh);
    memcpy(chain3, chain3_y, sizeof chain3);
    chain_start(&chain_system, NULL, chain);
    for (size_t i = 0; i < sizeof contender / sizeof *contender; i++)
        if (bench_is(argc, argv, contender[i].name)) return bench_measure(&contender[i].timed);
    return bench_unknown(argc, argv);
}
