/* gauss_spark.c - Gauss methods with D enforced on the mean over the stages, and at the end.
 *
 *     K_i = a(Q_i,V_i) + B(Q_i,V_i) L_i,   sum_j b_j c_j^k D(Q_j, V_j) = 0, k = 0..s-2,
 *     D(q1, v1) = 0
 *
 * with the Gauss coefficients for q and v alike; lib/kernel/spark.h.  The family is due to L. Jay,
 * Lagrange-d'Alembert SPARK integrators (2009); this choice of equations stood the tests of order,
 * symmetry and reversal.  Order 2s, symmetric, preserve every D. */
#include <dalembert_kernel.h>

static const double c1[] = {0.5}, a1[] = {0.5}, b1[] = {1.0};
static const double one[] = {1.0};

/* After the rows of a come the weights b. */
static const double c2[] = {0.211324865405187117745, 0.788675134594812882255, 1.0};
static const double a2[] = {0.25, -0.038675134594812882255, 0.538675134594812882255, 0.25, 0.5,
                            0.5};
static const double omega2[] = {0.5, 0.5, 0.0, 0.0, 0.0, 1.0};

static const dal_spark gauss1 = {1, 0, c1, b1, a1, a1, 1, one, b1, b1, one};
static const dal_spark gauss2 = {2, 0, c2, a2 + 4, a2, a2, 3, c2, a2, a2, omega2};

DAL_INLINE dal_status step1(dal_step *s) { return dal_spark_advance(s, &gauss1); }
DAL_INLINE dal_status step2(dal_step *s) { return dal_spark_advance(s, &gauss2); }

#define ABOUT_GAUSS_SPARK                                                                          \
    "Gauss methods with reactions at their stages, $D$ enforced on means over these and at the "   \
    "end of the step:\n"                                                                           \
    "$$K_i = a(Q_i, V_i) + B(Q_i, V_i)\\,L_i, \\qquad \\sum_{j} b_j\\,c_j^k\\,D(Q_j, V_j) = 0, "   \
    "\\quad k = 0, \\ldots, s - 2, \\qquad D(q_1, v_1) = 0.$$\n"                                   \
    "The family is due to Jay (2009). The order is $2s$ with $s$ = 1 or 2 stages; the methods "    \
    "are symmetric, preserve every $D$ and keep no multipliers from step to step."

DAL_INTEGRATOR(gauss_spark2, step1, .name = "gauss-spark2",
               .summary = "implicit midpoint with D at its end", .reference = "Jay 2009",
               .documentation = ABOUT_GAUSS_SPARK, .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_D,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS, .kernel = DAL_KERNEL_SPARK);

DAL_INTEGRATOR(gauss_spark4, step2, .name = "gauss-spark4",
               .summary = "Gauss-Legendre, 2 stages, D enforced on their mean and at the end",
               .reference = "Jay 2009", .documentation = ABOUT_GAUSS_SPARK, .order = 4, .stages = 2,
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_D,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS, .kernel = DAL_KERNEL_SPARK);
