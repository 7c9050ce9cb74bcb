/* gauss_spark.c - Gauss methods with D enforced on the mean over the stages, and at the end; with
 * Lobatto nodes for holonomic constraints.
 *
 *     K_i = a(Q_i,V_i) + B(Q_i,V_i) L_i,   sum_j b_j c_j^r D(Q_j, V_j) = 0, r = 0..s-2,
 *     D(q1, v1) = 0
 *
 * with the Gauss coefficients for q and v alike; lib/kernel/spark.h.  Beside holonomic constraints
 * g(q,t) = 0, with G = g_q and B without their columns,
 *
 *     Q_i  = q0 + h sum_j a_ij V_j                 at c_i
 *     Q~_i = q0 + h sum_j a-_ij V_j                at the Lobatto nodes c~_i, i = 0..s
 *     V_i  = v0 + h sum_j a_ij K_j + h sum_j a~_ij R_j,    R_j = W^-1 G^T(Q~_j) Lambda_j
 *     v1 likewise with b, b~,   q1 = Q~_s
 *     g(Q~_i) = 0, i = 1..s,   D(q1, v1) = 0,   G v1 + g_t = 0 at the end,   and the means above
 *
 *     a-_ij = int_0^(c~_i) l_j,   l_j the Lagrange polynomials of the c_j
 *     a~_ij = b~_j (1 - a-_ji/b_i)
 *
 * The family is due to L. Jay, Lagrange-d'Alembert SPARK integrators (2009), and SIAM J. Numer.
 * Anal. 45 (2007) 1814; this choice of equations stood the tests of order, symmetry and reversal.
 * Order 2s, symmetric, preserve every D and g.
 *
 * With U_ji = l_i(c~_j) and n_j = P_s(2 c~_j - 1) one has a~ U = a, b~ U = b, b~ n = 0, and with
 * (n~_j) = Lambda_j for U_ji M_i + n_j E, rows of G act on M as rows of A act on L.  So a change of
 * L, M by which all conditions but one vanish to first order is, stage by stage, a solution with
 * all rows of A and G together, as in spark.h; the means of G v + g_t are what is left of g,
 * sum_i alpha_ri g(Q~_i)/h with alpha_ri = delta_is - r b~_i c~_i^(r-1).  The last condition, with
 * the row psi of numbers, is one solution with G alone: G W^-1 G^T E = -psi (g/h^2, D/h). */
#include <dalembert_kernel.h>

/* clang-format off: tables */

/* After the rows of a come the weights b. */
static const double c1[] = {0.5}, a1[] = {0.5, 1.0};
static const double one[] = {1.0};

static const double c2[] = {0.211324865405187117745, 0.788675134594812882255, 1.0};
static const double a2[] = {0.25, -0.038675134594812882255, 0.538675134594812882255, 0.25, 0.5,
                            0.5};
static const double omega2[] = {0.5, 0.5, 0.0, 0.0, 0.0, 1.0};

static const double c3[] = {0.112701665379258311482, 0.5, 0.887298334620741688518, 1.0};
static const double a3[] = {5.0 / 36.0,
                            -0.0359766675249389034564,
                            0.0097894440153083260496,
                            0.300263194980864592438,
                            2.0 / 9.0,
                            -0.0224854172030868146603,
                            0.267988333762469451728,
                            0.480421111969383347901,
                            5.0 / 36.0,
                            5.0 / 18.0,
                            4.0 / 9.0,
                            5.0 / 18.0};
static const double omega3[] = {5.0 / 18.0,
                                4.0 / 9.0,
                                5.0 / 18.0,
                                0.0,
                                0.0313060181609050865227,
                                2.0 / 9.0,
                                0.246471759616872691255,
                                0.0,
                                0.0,
                                0.0,
                                0.0,
                                1.0};
/* clang-format on */

static const dal_spark gauss1 = {1, 0, c1, a1 + 1, a1, a1, 1, one, a1 + 1, a1 + 1, one};
static const dal_spark gauss2 = {2, 0, c2, a2 + 4, a2, a2, 3, c2, a2, a2, omega2};
static const dal_spark gauss3 = {3, 0, c3, a3 + 9, a3, a3, 4, c3, a3, a3, omega3};

#if DAL_WITH(HOLONOMIC)
/* clang-format off: tables */

/* Lobatto nodes, and a- at them; a~ and the row b~; psi; the s*s inverse of the rows of numbers
 * sum_j omega_rj a_ji, and b_i: what spark.h inverts in each step. */
static const double node1[] = {0.0, 1.0}, to_node1[] = {0.0, 1.0};
static const double lobatto1[] = {0.5, 0.0, 0.5, 0.5};
static const double stages1[] = {1.0, 1.0}, legendre1[] = {-1.0, 1.0}, psi1[] = {-2.0, 1.0};

static const double node2[] = {0.0, 0.5, 1.0};
static const double to_node2[] = {0.0, 0.0, 0.466506350946109661691, 0.0334936490538903383091,
                                  0.5, 0.5};
static const double lobatto2[] = {1.0 / 6.0,
                                  0.0446581987385204510788,
                                  0.0,
                                  1.0 / 6.0,
                                  0.622008467928146215588,
                                  0.0,
                                  1.0 / 6.0,
                                  2.0 / 3.0,
                                  1.0 / 6.0};
static const double stages2[] = {1.36602540378443864676,   -0.366025403784438646764, 0.5, 0.5,
                                 -0.366025403784438646764, 1.36602540378443864676};
static const double legendre2[] = {1.0, -0.5, 1.0}, psi2[] = {16.0, -8.0, 2.0};
static const double inverse2[] = {3.46410161513775458705, -0.732050807568877293527,
                                  -3.46410161513775458705, 2.73205080756887729353};
static const double alpha2[] = {0.0, 1.0};

static const double node3[] = {0.0, 0.276393202250021030359, 0.723606797749978969641, 1.0};
static const double to_node3[] = {0.0,
                                  0.0,
                                  0.0,
                                  0.255565733887470620081,
                                  0.0234606242222409158747,
                                  -0.0026331558596905055971,
                                  0.280410933637468283375,
                                  0.420983820222203528570,
                                  0.0222120438903071576963,
                                  5.0 / 18.0,
                                  4.0 / 9.0,
                                  5.0 / 18.0};
static const double lobatto3[] = {1.0 / 12.0,
                                  0.0333180658354607365444,
                                  -0.0039497337895357583957,
                                  0.0,
                                  1.0 / 12.0,
                                  0.394672331458315808034,
                                  0.0219943352083508586326,
                                  0.0,
                                  1.0 / 12.0,
                                  0.420616400456202425062,
                                  0.383348600831205930122,
                                  0.0,
                                  1.0 / 12.0,
                                  5.0 / 12.0,
                                  5.0 / 12.0,
                                  1.0 / 12.0};
static const double stages3[] = {1.47883055770123614753,   -2.0 / 3.0, 0.187836108965430519137,
                                 0.455341801261479548921,  2.0 / 3.0,  -0.122008467928146215588,
                                 -0.122008467928146215588, 2.0 / 3.0,  0.455341801261479548921,
                                 0.187836108965430519137,  -2.0 / 3.0, 1.47883055770123614753};
static const double legendre3[] = {-1.0, 0.447213595499957939282, -0.447213595499957939282, 1.0};
static const double psi3[] = {-33.5410196624968454461, 33.5410196624968454461, -21.0, 3.0};
static const double inverse3[] = {
    16.6475800154489002622, -24.0, 0.676209992275549868892, -15.0, 30.0, -1.5,
    7.35241998455109973778, -24.0, 5.32379000772445013111};
static const double alpha3[] = {0.0, 0.0, 1.0, -5.0 / 12.0, -5.0 / 12.0, 11.0 / 12.0};
/* clang-format on */

/* The coefficients beside holonomic constraints; see above for their letters. */
typedef struct lobatto_rows {
    int stages;                   /* s */
    const double *c, *a;          /* [s], [(s + 1)*s] with the row b */
    const double *node, *to_node; /* [s + 1] c~, [(s + 1)*s] a- */
    const double *lobatto;        /* [(s + 1)*(s + 1)] a~ with the row b~ */
    const double *U, *n, *psi;    /* [(s + 1)*s], [s + 1], [s + 1] */
    const double *omega, *alpha;  /* [(s - 1)*(s + 1)] and one column more, [(s - 1)*s] */
    const double *inverse;        /* [s*s] */
} lobatto_rows;

static const lobatto_rows rows1 = {1,       c1,        a1,   node1, to_node1, lobatto1,
                                   stages1, legendre1, psi1, one,   one,      one};
static const lobatto_rows rows2 = {2,       c2,        a2,   node2,  to_node2, lobatto2,
                                   stages2, legendre2, psi2, omega2, alpha2,   inverse2};
static const lobatto_rows rows3 = {3,       c3,        a3,   node3,  to_node3, lobatto3,
                                   stages3, legendre3, psi3, omega3, alpha3,   inverse3};

typedef struct rows_step {
    const lobatto_rows *method;
    num *V, *v1;   /* [s*n], [n] stage velocities, v at the end */
    num *q;        /* [n] a point */
    num *K, *R;    /* [s*n], [(s + 1)*n] */
    num *L, *E;    /* [s*m] L and M, [holonomic]: of a lane's last iteration */
    num *l;        /* [m + 1] multipliers */
    num *missing;  /* [s*m] what the conditions miss */
    num *extra;    /* [m + 1] psi (g/h^2, D/h) times -1, at the places of c */
    num *D;        /* [m] */
    num *in, *out; /* of DAL_EVAL_ENFORCEMENT */
    num *place;    /* of DAL_EVAL_POSITION */
} rows_step;

/* sum + h sum_j weight_j x[j*n + i], of `count` terms */
DAL_INLINE num add_terms(num sum, const double *weight, int count, double h, const num *x, int n,
                         int i)
{
    num terms = weight[0] * x[i];
    for (int j = 1; j < count; j++) terms += weight[j] * x[j * n + i];
    return sum + h * terms;
}

/* The velocities of increments w. */
DAL_INLINE void place_velocities(const dal_step *s, const rows_step *k, const num *w)
{
    const int n = DAL_N(s), stages = DAL_STAGES(k->method);
    for (int i = 0; i < stages * n; i++) k->V[i] = dal_moved_v(s, i % n, w[i]);
    for (int c = 0; c < n; c++) k->v1[c] = dal_moved_v(s, c, w[stages * n + c]);
}

DAL_INLINE void place_position(const dal_step *s, const rows_step *k, const double *x)
{
    const int n = DAL_N(s), stages = DAL_STAGES(k->method);
    for (int c = 0; c < n; c++)
        k->q[c] = dal_moved_q(s, c, add_terms(dal_num(0.0), x, stages, s->h, k->V, n, c));
}

/* K and R at the last points for the last multipliers, and the increments of velocity by them. */
DAL_INLINE void react(dal_step *s, const rows_step *k, num *image)
{
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    const int holonomic = DAL_HOLONOMIC(s), first = m - holonomic;
    DAL_EACH(a, m) k->l[a] = dal_num(0.0);
    k->l[m] = dal_num(1.0);
    s->evaluations += stages;
    for (int j = 0; j < stages; j++) {
        DAL_EACH(a, first) k->l[a] = k->L[j * m + a];
        place_position(s, k, k->method->a + j * stages);
        dal_eval(s, DAL_EVAL_REACTION, s->t + k->method->c[j] * s->h, k->q, k->V + j * n, k->l,
                 k->K + j * n);
    }
    DAL_EACH(a, first) k->l[a] = dal_num(0.0);
    k->l[m] = dal_num(0.0);
    for (int j = 0; j <= stages; j++) {
        DAL_EACH(a, holonomic) {
            num sum = k->method->n[j] * k->E[a];
            for (int i = 0; i < stages; i++)
                sum += k->method->U[j * stages + i] * k->L[i * m + first + a];
            k->l[first + a] = sum;
        }
        place_position(s, k, k->method->to_node + j * stages);
        dal_eval(s, DAL_EVAL_REACTION, s->t + k->method->node[j] * s->h, k->q, s->y + n, k->l,
                 k->R + j * n);
    }
    for (int i = 0; i <= stages; i++)
        for (int c = 0; c < n; c++) {
            const num sum =
                add_terms(dal_num(0.0), k->method->a + i * stages, stages, s->h, k->K, n, c);
            image[i * n + c] =
                add_terms(sum, k->method->lobatto + i * (stages + 1), stages + 1, s->h, k->R, n, c);
        }
}

/* What the conditions on means, and on g at the nodes, miss; D at the end is in k->D. */
DAL_INLINE void miss_means(dal_step *s, const rows_step *k)
{
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    const int first = m - DAL_HOLONOMIC(s);
    const double per_h = 1.0 / s->h;
    num *const last = k->missing + (stages - 1) * m;
    for (int i = 0; i < stages * m; i++) k->missing[i] = dal_num(0.0);
    DAL_EACH(a, m) last[a] = k->D[a];
    DAL_EACH(a, m - first)
        k->extra[first + a] = (-per_h * k->method->psi[stages]) * k->D[first + a];
    for (int j = 0; j < stages && first > 0 && stages > 1; j++) {
        place_position(s, k, k->method->a + j * stages);
        dal_constraint_value(s, s->t + k->method->c[j] * s->h, k->q, k->V + j * n, k->D);
        for (int r = 0; r < stages - 1; r++)
            DAL_EACH(a, first)
                k->missing[r * m + a] += k->method->omega[r * (stages + 1) + j] * k->D[a];
    }
    for (int i = 0; i < stages; i++) {
        place_position(s, k, k->method->to_node + (i + 1) * stages);
        dal_eval(s, DAL_EVAL_HOLONOMIC, s->t + k->method->node[i + 1] * s->h, k->q, s->y + n, NULL,
                 k->D + first);
        for (int r = 0; r < stages - 1; r++)
            DAL_EACH(a, m - first)
                k->missing[r * m + first + a] +=
                    (per_h * k->method->alpha[r * stages + i]) * k->D[first + a];
        DAL_EACH(a, m - first)
            k->extra[first + a] += (-per_h * per_h * k->method->psi[i]) * k->D[first + a];
    }
}

/* Adds to the increments the change of L and M of stage j. */
DAL_INLINE void enforce_stage(dal_step *s, const rows_step *k, int j, dal_equation *eq)
{
    num *const image = eq->block[0].image;
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    const num *y = k->out, *x = k->out + n;
    for (int a = 0; a < m; a++) {
        num sum = dal_num(0.0);
        for (int e = 0; e < stages; e++)
            sum += k->method->inverse[j * stages + e] * k->missing[e * m + a];
        k->in[n + a] = sum / -s->h;
    }
    place_position(s, k, k->method->a + j * stages);
    dal_eval_enforcement(s, s->t + k->method->c[j] * s->h, k->q, k->V + j * n, k->in, k->out);
    for (int i = 0; i <= stages; i++)
        for (int c = 0; c < n; c++)
            image[i * n + c] += (s->h * k->method->a[i * stages + j]) * y[c];
    DAL_EACH(a, m)
        k->L[j * m + a] = DAL_IF_ACTIVE(eq->active, k->L[j * m + a] + x[a], k->L[j * m + a]);
}

/* The same of E, in the middle. */
DAL_INLINE void enforce_nodes(dal_step *s, const rows_step *k, dal_equation *eq)
{
    num *const image = eq->block[0].image;
    const int n = DAL_N(s), stages = DAL_STAGES(k->method), middle = stages / 2;
    const num *y = k->place, *x = k->place + n;
    place_position(s, k, k->method->a + middle * stages);
    dal_eval(s, DAL_EVAL_POSITION, s->t + k->method->c[middle] * s->h, k->q, s->y + n, k->extra,
             k->place);
    for (int i = 0; i < stages; i++) {
        double rho = 0.0; /* a~ n */
        for (int j = 0; j <= stages; j++)
            rho += k->method->lobatto[i * (stages + 1) + j] * k->method->n[j];
        for (int c = 0; c < n; c++) image[i * n + c] += (s->h * rho) * y[c];
    }
    DAL_EACH(a, DAL_HOLONOMIC(s)) k->E[a] = DAL_IF_ACTIVE(eq->active, k->E[a] + x[a], k->E[a]);
}

DAL_INLINE void rows_map(dal_step *s, dal_equation *eq)
{
    const rows_step *k = (const rows_step *)eq->context;
    const int stages = DAL_STAGES(k->method);
    num *const image = eq->block[0].image;
    place_velocities(s, k, eq->block[0].u);
    react(s, k, image);
    place_velocities(s, k, image);
    place_position(s, k, k->method->a + stages * stages);
    dal_constraint_value(s, s->t + s->h, k->q, k->v1, k->D);
    miss_means(s, k);
    for (int j = 0; j < stages; j++) enforce_stage(s, k, j, eq);
    enforce_nodes(s, k, eq);
}

/* The first guess: F in all stages, with its multipliers. */
DAL_INLINE void rows_begin(dal_step *s, const rows_step *k, dal_block *block)
{
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    dal_motion_multipliers(s, k->in, k->out);
    for (int i = 0; i < stages * m; i++) k->L[i] = k->out[n + i % m];
    for (int i = 0; i < (stages + 1) * n; i++)
        block->u[i] = s->h * (i < stages * n ? k->method->c[i / n] : 1.0) * k->in[i % n];
    DAL_EACH(i, n + m + 1) k->in[i] = dal_num(0.0);
    DAL_EACH(a, m + 1) k->extra[a] = dal_num(0.0);
    DAL_EACH(a, DAL_HOLONOMIC(s)) k->E[a] = dal_num(0.0);
}

DAL_INLINE dal_status rows_advance(dal_step *s, const lobatto_rows *method)
{
    const int n = DAL_N(s), stages = DAL_STAGES(method);
    DAL_VECTOR(s, V, DAL_STAGES(method) * DAL_N(s));
    DAL_VECTOR(s, v1, DAL_N(s));
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, K, DAL_STAGES(method) * DAL_N(s));
    DAL_VECTOR(s, R, (DAL_STAGES(method) + 1) * DAL_N(s));
    DAL_VECTOR(s, L, DAL_STAGES(method) * DAL_M(s));
    DAL_VECTOR(s, E, DAL_HOLONOMIC(s));
    DAL_VECTOR(s, l, DAL_M(s) + 1);
    DAL_VECTOR(s, missing, DAL_STAGES(method) * DAL_M(s));
    DAL_VECTOR(s, extra, DAL_M(s) + 1);
    DAL_VECTOR(s, D, DAL_M(s));
    DAL_VECTOR(s, in, DAL_N(s) + DAL_M(s) + 1);
    DAL_VECTOR(s, out, DAL_N(s) + DAL_M(s));
    DAL_VECTOR(s, place, DAL_N(s) + DAL_HOLONOMIC(s));
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_BLOCK(s, block, (DAL_STAGES(method) + 1) * DAL_N(s), 0);
    rows_step k = {method, V, v1, q, K, R, L, E, l, missing, extra, D, in, out, place};
    DAL_EQUATION(s, eq, 1, &k, block);
    dal_set_speeds(s, &eq.block[0], n);
    eq.block[0].progress->scale = dal_velocity_scale(s, s->h, 0);
    rows_begin(s, &k, &eq.block[0]);
    if (dal_failed(dal_solve(s, &eq, rows_map, NULL))) return DAL_STATUS_NOT_CONVERGED;
    place_velocities(s, &k, eq.block[0].u);
    for (int c = 0; c < n; c++) {
        d[c] = add_terms(dal_num(0.0), method->a + stages * stages, stages, s->h, V, n, c);
        d[n + c] = eq.block[0].u[stages * n + c];
    }
    return dal_update(s, s->h, d);
}
#endif

/* A step with the constraints that there are. */
#if DAL_WITH(HOLONOMIC)
#define ADVANCE(s, spark, rows)                                                                    \
    (DAL_HOLONOMIC(s) > 0 ? rows_advance(s, rows) : dal_spark_advance(s, spark))
#else
#define ADVANCE(s, spark, rows) dal_spark_advance(s, spark)
#endif
DAL_INLINE dal_status step1(dal_step *s) { return ADVANCE(s, &gauss1, &rows1); }
DAL_INLINE dal_status step2(dal_step *s) { return ADVANCE(s, &gauss2, &rows2); }
DAL_INLINE dal_status step3(dal_step *s) { return ADVANCE(s, &gauss3, &rows3); }

#define ABOUT_GAUSS_SPARK                                                                          \
    "Gauss methods with reactions at their stages, $D$ enforced on means over these and at the "   \
    "end of the step:\n"                                                                           \
    "$$K_i = a(Q_i, V_i) + B(Q_i, V_i)\\,L_i, \\qquad \\sum_{j} b_j\\,c_j^k\\,D(Q_j, V_j) = 0, "   \
    "\\quad k = 0, \\ldots, s - 2, \\qquad D(q_1, v_1) = 0.$$\n"                                   \
    "Holonomic constraints act at the $s + 1$ Lobatto nodes $\\tilde Q_j$ of the step, "           \
    "with reactions $W^{-1} g_q^T(\\tilde Q_j)\\,\\Lambda_j$, so that $g(\\tilde Q_j) = 0$ and "   \
    "$g_q v_1 + g_t = 0$. The family is due to Jay (2007, 2009). The order is $2s$ with $s$ = 1, " \
    "2 or 3 stages; the methods are symmetric, preserve every $g$ and $D$ and keep no "            \
    "multipliers from step to step."

/* The method of order_ with `s` stages. */
#define GAUSS_SPARK(s, order_, name_, summary_)                                                    \
    DAL_INTEGRATOR(gauss_spark##order_, step##s, .name = name_, .summary = summary_,               \
                   .reference = "Jay 2009", .documentation = ABOUT_GAUSS_SPARK, .order = order_,   \
                   .stages = s,                                                                    \
                   .properties = DAL_SYMMETRIC | DAL_PRESERVES_D | DAL_PRESERVES_HOLONOMIC,        \
                   .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS | DAL_NEEDS_MASS_OF_Q,              \
                   .kernel = DAL_KERNEL_SPARK)

GAUSS_SPARK(1, 2, "gauss-spark2", "implicit midpoint with D at its end");
GAUSS_SPARK(2, 4, "gauss-spark4",
            "Gauss-Legendre, 2 stages, D enforced on their mean and at the end");
GAUSS_SPARK(3, 6, "gauss-spark6",
            "Gauss-Legendre, 3 stages, D enforced on their means and at the end");
