/* odeint.cpp - Boost.odeint, runge_kutta4 on std::array with its array algebra.
 *
 *     odeint rk4 A|B3       state of doubles
 *     odeint rk4x8 A|B3     state of 8-lane vectors, eight trajectories at once; the sine and
 *                           cosine over lanes are this project's, odeint having none
 *     odeint rk4x16 A|B3    of 16-lane vectors, which the compiler splits into two of 8 */
#define _POSIX_C_SOURCE 200809L
#define DAL_LANES       8
#include "bench.h"
#include "kernel/elementary.h"
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

namespace odeint = boost::numeric::odeint;

namespace scalar
{
#include "real.inc"

#include "fields.inc"
} // namespace scalar

namespace wide
{
typedef num real;
static inline void real_sincos(real x, real *s, real *c) { dal_sincos(x, s, c); }
#include "fields.inc"
} // namespace wide

namespace wider
{
typedef double real __attribute__((vector_size(16 * sizeof(double))));
static inline void real_sincos(real x, real *s, real *c)
{
    num half[2], sine[2], cosine[2];
    memcpy(half, &x, sizeof x);
    for (int i = 0; i < 2; i++) dal_sincos(half[i], &sine[i], &cosine[i]);
    memcpy(s, sine, sizeof x);
    memcpy(c, cosine, sizeof x);
}
#include "fields.inc"
} // namespace wider

constexpr int DIM = scalar::SMALL_DIM, STEPS = 1000;

template <class Real, void (*field)(const Real *, Real *)> int integrate(void *self, double *end)
{
    using state = std::array<Real, DIM>;
    odeint::runge_kutta4<state, double, state, double, odeint::array_algebra> stepper;
    const double *start = static_cast<const double *>(self), h = BENCH_H_STEP;
    state y;
    /* Lanes have states of their own, as in gen.c. */
    for (int i = 0; i < DIM; i++) y[i] = start[i] - Real{};
    for (size_t lane = 1; lane < sizeof(Real) / sizeof(double); lane++)
        reinterpret_cast<double *>(&y[DIM - 1])[lane] += 1e-2 * static_cast<double>(lane);
    const auto system = [](const state &x, state &dx, double) { field(x.data(), dx.data()); };
    for (int i = 0; i < STEPS; i++) stepper.do_step(system, y, i * h, h);
    for (int i = 0; i < DIM; i++) end[i] = reinterpret_cast<double *>(&y[i])[0];
    return 0;
}

int main(int argc, char **argv)
{
    void *A = const_cast<double *>(scalar::sleigh_y), *B3 = const_cast<double *>(scalar::chain3_y);
    const struct {
        const char *name;
        bench_contender timed;
    } contender[] = {
        {"rk4 A", {STEPS, DIM, integrate<double, scalar::sleigh_field>, A}},
        {"rk4 B3", {STEPS, DIM, integrate<double, scalar::chain3_field>, B3}},
        {"rk4x8 A", {8.0 * STEPS, DIM, integrate<num, wide::sleigh_field>, A}},
        {"rk4x8 B3", {8.0 * STEPS, DIM, integrate<num, wide::chain3_field>, B3}},
        {"rk4x16 A", {16.0 * STEPS, DIM, integrate<wider::real, wider::sleigh_field>, A}},
        {"rk4x16 B3", {16.0 * STEPS, DIM, integrate<wider::real, wider::chain3_field>, B3}},
    };
    for (const auto &c : contender)
        if (bench_is(argc, argv, c.name)) return bench_measure(&c.timed);
    return bench_unknown(argc, argv);
}
