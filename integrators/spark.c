/* spark.c - Lobatto IIIA-IIIB with D enforced, in two forms: q by IIIA (a), v by IIIB (ahat).
 *
 *     spark                  sum_j a_ij D(Q_j, V_j) = 0, i = 2..s,   D(q1, v1) = 0;
 *                            all L_i unknown
 *     lobatto-nonholonomic   D(Q_i, v + h sum_j a_ij K_j) = 0, i = 2..s;
 *                            L_1 is L_s of the step before
 *
 * L. Jay, Math. Comp. 75 (2006) 641 and Lagrange-d'Alembert SPARK integrators (2009); R. Sato
 * Martin de Almagro, D. Martin de Diego, arXiv:1810.10926, whose s = 2 is gni, except with
 * forces that depend on v.  Order 2s - 2, symmetric (the second in its multipliers, too, which
 * begin with the continuous motion's: a wrong beginning costs an order), preserve every D.  An
 * error of multipliers that are persistent grows where the motion contracts, as gni's does.  The
 * equations are in lib/kernel/spark.h.
 *
 * Nodes: zeros of the (s-2)nd derivative of (x(1-x))^(s-1), then 1; a from C(s),
 * ahat_ij = b_j (1 - a_ji/b_i); after the rows of both the row of weights b.  omega: a_2 .. a_s,
 * and the end. */
#include <dalembert_kernel.h>

/* clang-format off: tables */

/* s = 2 */
static const double c2[] = {0.0, 1.0, 1.0};
static const double a2[] = {0.0, 0.0, 0.5, 0.5, 0.5, 0.5};
static const double ahat2[] = {0.5, 0.0, 0.5, 0.0, 0.5, 0.5};
static const double omega2[] = {0.5, 0.5, 0.0, 0.0, 0.0, 1.0};

/* s = 3 */
static const double c3[] = {0.0, 0.5, 1.0, 1.0};
static const double a3[] = {0.0,       0.0,       0.0,       5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0,
                            1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0,  2.0 / 3.0, 1.0 / 6.0};
static const double ahat3[] = {1.0 / 6.0, -1.0 / 6.0, 0.0, 1.0 / 6.0, 1.0 / 3.0, 0.0,
                               1.0 / 6.0, 5.0 / 6.0,  0.0, 1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};
static const double omega3[] = {5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0, 0.0, 1.0 / 6.0, 2.0 / 3.0,
                                1.0 / 6.0,  0.0,       0.0,         0.0, 0.0,       1.0};

/* s = 4 */
static const double c4[] = {0.0, 0.276393202250021030359, 0.723606797749978969641, 1.0, 1.0};
static const double a4[] = {0.0,
                            0.0,
                            0.0,
                            0.0,
                            0.110300566479164914137,
                            0.189699433520835085863,
                            -0.033907364229143883778,
                            0.010300566479164914137,
                            0.073032766854168419197,
                            0.450574030895810550444,
                            0.226967233145831580803,
                            -0.026967233145831580803,
                            1.0 / 12.0,
                            5.0 / 12.0,
                            5.0 / 12.0,
                            1.0 / 12.0,
                            1.0 / 12.0,
                            5.0 / 12.0,
                            5.0 / 12.0,
                            1.0 / 12.0};
static const double ahat4[] = {1.0 / 12.0,
                               -0.134836165729157904017,
                               0.051502832395824570684,
                               0.0,
                               1.0 / 12.0,
                               0.226967233145831580803,
                               -0.033907364229143883778,
                               0.0,
                               1.0 / 12.0,
                               0.450574030895810550444,
                               0.189699433520835085863,
                               0.0,
                               1.0 / 12.0,
                               0.365163834270842095983,
                               0.551502832395824570684,
                               0.0,
                               1.0 / 12.0,
                               5.0 / 12.0,
                               5.0 / 12.0,
                               1.0 / 12.0};
static const double omega4[] = {0.110300566479164914137,
                                0.189699433520835085863,
                                -0.033907364229143883778,
                                0.010300566479164914137,
                                0.0,
                                0.073032766854168419197,
                                0.450574030895810550444,
                                0.226967233145831580803,
                                -0.026967233145831580803,
                                0.0,
                                1.0 / 12.0,
                                5.0 / 12.0,
                                5.0 / 12.0,
                                1.0 / 12.0,
                                0.0,
                                0.0,
                                0.0,
                                0.0,
                                0.0,
                                1.0};

/* omega of the second form: the identity. */
static const double unit2[] = {1.0};
static const double unit3[] = {1.0, 0.0, 0.0, 1.0};
static const double unit4[] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
/* clang-format on */

#define ABOUT_SPARK                                                                                \
    "Lobatto IIIA-IIIB with the reactions at its stages,\n"                                        \
    "$$V_i = v_0 + h \\sum_j \\hat a_{ij}\\,K_j, \\qquad Q_i = q_0 + h \\sum_j a_{ij}\\,V_j, "     \
    "\\qquad K_i = a(Q_i, V_i) + B(Q_i, V_i)\\,L_i,$$\n"                                           \
    "in two forms. `spark2` to `spark6` solve for all multipliers $L_i$ of a step, with "          \
    "$\\sum_j a_{ij}\\,D(Q_j, V_j) = 0$ for $i \\ge 2$ and $D(q_1, v_1) = 0$ (Jay 2006). "         \
    "`lobatto-nonholonomic2` to `6` enforce $D$ at the nodes and take $L_1$ from the step "        \
    "before (Sato Martin de Almagro, Martin de Diego 2018); errors of such multipliers grow "      \
    "where the motion contracts. Both have the order $2s - 2$ with $s$ stages, are symmetric "     \
    "and preserve every $D$. Nothing is claimed about $E$."

/* Both methods with s stages. */
#define LOBATTO(s, order_, spark_, nonholonomic_)                                                  \
    static const dal_spark all##s = {                                                              \
        s, 0, c##s, a##s + (s) * (s), a##s, ahat##s, (s) + 1, c##s, a##s, ahat##s, omega##s,       \
    };                                                                                             \
    static const dal_spark next##s = {                                                             \
        s,     1,        c##s,       a##s + (s) * (s), a##s,    ahat##s,                           \
        (s)-1, c##s + 1, a##s + (s), a##s + (s),       unit##s,                                    \
    };                                                                                             \
    DAL_INLINE dal_status step_all##s(dal_step *step) { return dal_spark_advance(step, &all##s); } \
    DAL_INLINE dal_status step_next##s(dal_step *step)                                             \
    {                                                                                              \
        return dal_spark_advance(step, &next##s);                                                  \
    }                                                                                              \
    DAL_INTEGRATOR(spark##order_, step_all##s, .name = spark_,                                     \
                   .summary = "Lobatto IIIA-IIIB, " #s " stages, D enforced at them",              \
                   .reference = "Jay 2006", .documentation = ABOUT_SPARK, .order = order_,         \
                   .stages = s, .properties = DAL_SYMMETRIC | DAL_PRESERVES_D,                     \
                   .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS, .kernel = DAL_KERNEL_SPARK);       \
    DAL_INTEGRATOR(lobatto_nonholonomic##order_, step_next##s, .name = nonholonomic_,              \
                   .summary = "Lobatto IIIA-IIIB, " #s " stages, D enforced at its nodes",         \
                   .reference = "Sato Martin de Almagro, Martin de Diego 2018",                    \
                   .documentation = ABOUT_SPARK, .order = order_, .stages = s,                     \
                   .properties = DAL_SYMMETRIC | DAL_PRESERVES_D | DAL_PERSISTENT_MULTIPLIER,      \
                   .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS, .kernel = DAL_KERNEL_SPARK)

LOBATTO(2, 2, "spark2", "lobatto-nonholonomic2");
LOBATTO(3, 4, "spark4", "lobatto-nonholonomic4");
LOBATTO(4, 6, "spark6", "lobatto-nonholonomic6");
