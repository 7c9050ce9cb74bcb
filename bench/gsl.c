/* gsl.c - GSL odeiv2, stepped through gsl_odeiv2_step_apply with a fixed step.
 *
 *     gsl rk4 A|B3     gsl rk2imp A     gsl rk4imp A
 *     gsl driver A|B3                                rk4 by gsl_odeiv2_driver_apply_fixed_step
 *
 * Each of these takes, in one call of size 2h, one full step and two half steps of size h and keeps
 * the half steps: a call is two steps of the others, and the time printed is for one accepted
 * half step, its part of the full step included.  rk2imp is the implicit midpoint rule, rk4imp
 * Gauss' method of order 4, both by Newton's method with the exact Jacobian; they take their
 * tolerance from a control object, which therefore demands 1e-14 here and does not choose
 * steps. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "real.inc"

#include "fields.inc"

enum { STEPS = 1000 };

typedef struct solver {
    const double *start;
    gsl_odeiv2_system system;
    gsl_odeiv2_driver *driver;
} solver;

static int sleigh(double t, const double *y, double *dy, void *unused)
{
    (void)t, (void)unused;
    sleigh_field(y, dy);
    return GSL_SUCCESS;
}

static int chain3(double t, const double *y, double *dy, void *unused)
{
    (void)t, (void)unused;
    chain3_field(y, dy);
    return GSL_SUCCESS;
}

/* With u_phi = -y1' sin(phi) + y2' cos(phi): h_phi = G cos(phi) - u_phi phi', h_y1' = -cos(phi)
 * phi', h_y2' = -sin(phi) phi', h_phi' = -u. */
static int sleigh_jacobian(double t, const double *y, double *J, double *Ft, void *unused)
{
    const double s = sin(y[2]), c = cos(y[2]), u = y[3] * c + y[4] * s;
    const double u_phi = y[4] * c - y[3] * s, h = SLEIGH_G * s - u * y[5];
    const double dh[SMALL_DIM] = {0, 0, SLEIGH_G * c - u_phi * y[5], -c * y[5], -s * y[5], -u};
    (void)t, (void)unused;
    memset(J, 0, SMALL_DIM * SMALL_DIM * sizeof *J);
    memset(Ft, 0, SMALL_DIM * sizeof *Ft);
    for (int i = 0; i < 3; i++) J[i * SMALL_DIM + 3 + i] = 1.0;
    for (int j = 0; j < SMALL_DIM; j++) {
        J[3 * SMALL_DIM + j] = dh[j] * s;
        J[4 * SMALL_DIM + j] = -dh[j] * c;
    }
    J[3 * SMALL_DIM + 2] += h * c;
    J[4 * SMALL_DIM + 2] += h * s;
    J[5 * SMALL_DIM + 2] = -SLEIGH_K * c;
    return GSL_SUCCESS;
}

static int work(void *self, double *y)
{
    solver *j = self;
    double error[SMALL_DIM];
    const double h = 2.0 * BENCH_H_STEP;
    memcpy(y, j->start, SMALL_DIM * sizeof *y);
    gsl_odeiv2_step_reset(j->driver->s);
    for (int i = 0; i < STEPS / 2; i++)
        if (gsl_odeiv2_step_apply(j->driver->s, i * h, h, y, error, NULL, NULL, &j->system))
            return 1;
    return 0;
}

/* The same through the driver, which also estimates the error and compares it with a tolerance that
 * never holds a step up. */
static int work_driver(void *self, double *y)
{
    solver *j = self;
    double t = 0.0;
    memcpy(y, j->start, SMALL_DIM * sizeof *y);
    gsl_odeiv2_driver_reset(j->driver);
    return gsl_odeiv2_driver_apply_fixed_step(j->driver, &t, 2.0 * BENCH_H_STEP, STEPS / 2, y) !=
           GSL_SUCCESS;
}

int main(int argc, char **argv)
{
    static solver j;
    const struct {
        const char *name;
        const gsl_odeiv2_step_type *type;
        int (*field)(double t, const double *y, double *dy, void *unused);
        const double *start;
        double tolerance;
        int (*work)(void *self, double *end);
    } contender[] = {{"rk4 A", gsl_odeiv2_step_rk4, sleigh, sleigh_y, 1e-14, work},
                     {"rk4 B3", gsl_odeiv2_step_rk4, chain3, chain3_y, 1e-14, work},
                     {"driver A", gsl_odeiv2_step_rk4, sleigh, sleigh_y, 1.0, work_driver},
                     {"driver B3", gsl_odeiv2_step_rk4, chain3, chain3_y, 1.0, work_driver},
                     {"rk2imp A", gsl_odeiv2_step_rk2imp, sleigh, sleigh_y, 1e-14, work},
                     {"rk4imp A", gsl_odeiv2_step_rk4imp, sleigh, sleigh_y, 1e-14, work}};
    for (size_t i = 0; i < sizeof contender / sizeof *contender; i++) {
        if (!bench_is(argc, argv, contender[i].name)) continue;
        j.start = contender[i].start;
        j.system = (gsl_odeiv2_system){contender[i].field, sleigh_jacobian, SMALL_DIM, NULL};
        j.driver = gsl_odeiv2_driver_alloc_y_new(&j.system, contender[i].type, BENCH_H_STEP,
                                                 contender[i].tolerance, 0.0);
        const bench_contender measured = {STEPS, SMALL_DIM, contender[i].work, &j};
        return bench_measure(&measured);
    }
    return bench_unknown(argc, argv);
}
