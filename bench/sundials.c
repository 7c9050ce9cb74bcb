/* sundials.c - SUNDIALS ARKODE with a fixed step.
 *
 *     sundials erk A|B3         ERKStep, Zonneveld's tableau
 *     sundials midpoint A|B101  ARKStep, implicit midpoint by fixed-point iteration
 *     sundials deduced A        the same with right-hand sides deduced and a predictor
 *
 * ERKStep 6.4.1 takes classical Runge-Kutta for a first-same-as-last method and computes something
 * else; Zonneveld's tableau is the same method with a fifth stage for its error, and gives the same
 * end state.  Interpolation is reduced to the least there is. */
#define _POSIX_C_SOURCE 200809L
#include "../examples/contact_chain.h"
#include "bench.h"
#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_types.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "real.inc"

#include "fields.inc"

/* The iteration ends when the weighted norm of an increment is below 1e-4 of TOLERANCE |y|: at
 * rounding, from where the next increment would not change y. */
static const double TOLERANCE = 1e-11, COEFFICIENT = 1e-4;

typedef struct contender {
    void *memory;
    N_Vector y, start;
    int steps, dimension;
    int implicit;
} contender;

static int sleigh(realtype t, N_Vector y, N_Vector dy, void *unused)
{
    (void)t, (void)unused;
    sleigh_field(N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
}

static int chain3(realtype t, N_Vector y, N_Vector dy, void *unused)
{
    (void)t, (void)unused;
    chain3_field(N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
}

static int chain101(realtype t, N_Vector y, N_Vector dy, void *unused)
{
    const double *q = N_VGetArrayPointer(y);
    double *d = N_VGetArrayPointer(dy);
    (void)t, (void)unused;
    memcpy(d, q + CHAIN_N, CHAIN_N * sizeof *d);
    chain_force(CHAIN_EPS, q, q + CHAIN_N, d + CHAIN_N);
    return 0;
}

static int work(void *self, double *end)
{
    contender *j = self;
    const double T = j->steps * BENCH_H_STEP;
    double t;
    N_VScale(1.0, j->start, j->y);
    int status =
        j->implicit ? ARKStepReset(j->memory, 0.0, j->y) : ERKStepReset(j->memory, 0.0, j->y);
    if (status == 0)
        status = j->implicit ? ARKStepSetStopTime(j->memory, T) : ERKStepSetStopTime(j->memory, T);
    if (status == 0)
        status = j->implicit ? ARKStepEvolve(j->memory, T, j->y, &t, ARK_NORMAL)
                             : ERKStepEvolve(j->memory, T, j->y, &t, ARK_NORMAL);
    memcpy(end, N_VGetArrayPointer(j->y), (size_t)j->dimension * sizeof *end);
    return status < 0;
}

static int make_erk(contender *j, ARKRhsFn f, SUNContext context)
{
    j->memory = ERKStepCreate(f, 0.0, j->y, context);
    return !j->memory || ERKStepSetTableNum(j->memory, ARKODE_ZONNEVELD_5_3_4) ||
           ERKStepSetFixedStep(j->memory, BENCH_H_STEP) ||
           ERKStepSetInterpolantType(j->memory, ARK_INTERP_LAGRANGE) ||
           ERKStepSetInterpolantDegree(j->memory, 0) || ERKStepSetMaxNumSteps(j->memory, 1000000);
}

static int make_midpoint(contender *j, ARKRhsFn f, SUNContext context)
{
    double c = 0.5, A = 0.5, b = 1.0;
    j->implicit = 1;
    j->memory = ARKStepCreate(NULL, f, 0.0, j->y, context);
    if (!j->memory) return 1;
    ARKodeButcherTable table = ARKodeButcherTable_Create(1, 2, 0, &c, &A, &b, NULL);
    SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(j->y, 0, context);
    return ARKStepSetTables(j->memory, 2, 0, table, NULL) ||
           ARKStepSetNonlinearSolver(j->memory, solver) ||
           ARKStepSetFixedStep(j->memory, BENCH_H_STEP) ||
           ARKStepSStolerances(j->memory, TOLERANCE, TOLERANCE) ||
           ARKStepSetNonlinConvCoef(j->memory, COEFFICIENT) ||
           ARKStepSetMaxNonlinIters(j->memory, 100) ||
           ARKStepSetInterpolantType(j->memory, ARK_INTERP_LAGRANGE) ||
           ARKStepSetInterpolantDegree(j->memory, 0) || ARKStepSetMaxNumSteps(j->memory, 1000000);
}

/* The same with what makes it fastest: no right-hand side is evaluated to store what the solved
 * stage says, and a stage begins at the polynomial through the last steps. */
static int make_deduced(contender *j, ARKRhsFn f, SUNContext context)
{
    return make_midpoint(j, f, context) || ARKStepSetDeduceImplicitRhs(j->memory, 1) ||
           ARKStepSetInterpolantDegree(j->memory, 2) || ARKStepSetPredictorMethod(j->memory, 1);
}

int main(int argc, char **argv)
{
    static double chain[2 * CHAIN_N + 1], small[2][SMALL_DIM];
    static contender j;
    const struct {
        const char *name;
        int (*make)(contender *contender, ARKRhsFn f, SUNContext context);
        ARKRhsFn f;
        double *start;
        int dimension, steps;
    } contender[] = {{"erk A", make_erk, sleigh, small[0], SMALL_DIM, 1000},
                     {"erk B3", make_erk, chain3, small[1], SMALL_DIM, 1000},
                     {"midpoint A", make_midpoint, sleigh, small[0], SMALL_DIM, 1000},
                     {"deduced A", make_deduced, sleigh, small[0], SMALL_DIM, 1000},
                     {"midpoint B101", make_midpoint, chain101, chain, 2 * CHAIN_N, 200}};
    SUNContext context;
    memcpy(small[0], sleigh_y, sizeof sleigh_y);
    memcpy(small[1], chain3_y, sizeof chain3_y);
    chain_start(&chain_system, NULL, chain);
    if (SUNContext_Create(NULL, &context)) return 1;
    for (size_t i = 0; i < sizeof contender / sizeof *contender; i++) {
        if (!bench_is(argc, argv, contender[i].name)) continue;
        j.dimension = contender[i].dimension;
        j.steps = contender[i].steps;
        j.start = N_VMake_Serial(j.dimension, contender[i].start, context);
        j.y = N_VClone(j.start);
        N_VScale(1.0, j.start, j.y);
        if (contender[i].make(&j, contender[i].f, context)) return 1;
        const bench_contender measured = {j.steps, j.dimension, work, &j};
        return bench_measure(&measured);
    }
    return bench_unknown(argc, argv);
}
