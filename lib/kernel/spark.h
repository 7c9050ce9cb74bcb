/* spark.h - partitioned Runge-Kutta steps with multipliers at the stages and D among the equations.
 *
 *     V_i = v + h sum_j ahat_ij K_j    Q_i = q + h sum_j a_ij V_j
 *     K_i = a(Q_i, V_i) + B(Q_i, V_i) L_i
 *     sum_p omega_ep D(q_p, v_p, t + c_p h) = 0
 *     v_p = v + h sum_j y_pj K_j       q_p = q + h sum_j x_pj V_j
 *     v1  = v + h sum_j b_j K_j        q1  = q + h sum_j b_j V_j
 *
 * with as many equations e as unknown multipliers L_i: all, or all but L_1, which is then L_s of
 * the last step.  The K_i are iterated; each iteration takes the L_i for which the equations hold
 * to first order, as in constrained.h:
 *
 *     sum_j (h sum_p omega_ep y_pj A_p B_j) L_j
 *         = - sum_p omega_ep (D_p + A_p h sum_j y_pj (a_j - K_j))
 *
 * L. Jay, Math. Comp. 75 (2006) 641; R. Sato Martin de Almagro, D. Martin de Diego,
 * arXiv:1810.10926. */
#ifndef DAL_KERNEL_SPARK_H
#define DAL_KERNEL_SPARK_H

#include "constrained.h"

/* The coefficients of a method; see above for their letters. */
typedef struct dal_spark {
    int stages;                          /* s */
    int L1_known;                        /* 1: L_1 is known */
    const double *c, *b, *a, *ahat;      /* [s], [s], [s*s], [s*s] */
    int points;                          /* at most s + 1 */
    const double *point_c, *to_q, *to_v; /* [points] c_p, [points*s] x, [points*s] y */
    const double *omega;                 /* [(s - persistent)*points] */
} dal_spark;

#define dal_spark_advance DAL_WIDE(dal_spark_advance)
DAL_SHARED dal_status dal_spark_advance(dal_step *s, const dal_spark *method);

#ifndef DAL_LINKED
typedef struct dal_spark_step {
    dal_stage_matrix newton; /* first, for dal_constrained_matrix */
    const dal_spark *method;
    num *V, *blocks;         /* [s*n], [s] blocks */
    num *q, *v, *constraint; /* a point, and D, A, B there */
    num *given, *last;       /* [m] L_1 where it is known; L_s of a lane's last iteration */
    num *shift;              /* [n] h sum y (a_j - K_j) */
    num *matrix, *inverse;   /* [(s*m)^2] */
    num *rhs, *L;            /* [s*m] */
} dal_spark_step;

/* h sum_j weight_j x[j*n + i] */
DAL_INLINE num dal__stage_sum(const double *weight, int stages, double h, const num *x, int n,
                              int i)
{
    num sum = weight[0] * x[i];
    for (int j = 1; j < stages; j++) sum += weight[j] * x[j * n + i];
    return h * sum;
}

/* Stage velocities for the accelerations K, all of them before any position. */
DAL_INLINE void dal__spark_velocities(const dal_step *s, const dal_spark_step *k, const num *K)
{
    const int n = DAL_N(s), stages = DAL_STAGES(k->method);
    for (int i = 0; i < stages; i++)
        for (int c = 0; c < n; c++)
            k->V[i * n + c] = dal_moved_v(
                s, c, dal__stage_sum(k->method->ahat + i * stages, stages, s->h, K, n, c));
}

DAL_INLINE void dal__spark_position(const dal_step *s, const dal_spark_step *k, const double *x)
{
    const int n = DAL_N(s), stages = DAL_STAGES(k->method);
    for (int c = 0; c < n; c++)
        k->q[c] = dal_moved_q(s, c, dal__stage_sum(x, stages, s->h, k->V, n, c));
}

/* free_i = a_i, with B_1 L_1 where L_1 is known. */
DAL_INLINE void dal__spark_stages(dal_step *s, const dal_spark_step *k, num *free)
{
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    for (int i = 0; i < stages; i++) {
        num *blocks = k->blocks + i * DAL_BLOCKS_SIZE(s);
        dal__spark_position(s, k, k->method->a + i * stages);
        dal_eval_blocks(s, s->t + k->method->c[i] * s->h, k->q, k->V + i * n, blocks);
        for (int c = 0; c < n; c++) free[i * n + c] = blocks[dal_blocks_a(s) + c];
    }
    if (!k->method->L1_known) return;
    const num *B = k->blocks + dal_blocks_B(s);
    for (int c = 0; c < n; c++)
        for (int a = 0; a < m; a++) free[c] += B[c * m + a] * k->given[a];
}

/* The point p, D there, and the change of its velocity by the free accelerations. */
DAL_INLINE void dal__spark_point(dal_step *s, const dal_spark_step *k, int p, const num *K,
                                 const num *free)
{
    const int n = DAL_N(s), stages = DAL_STAGES(k->method);
    const double *y = k->method->to_v + p * stages;
    dal__spark_position(s, k, k->method->to_q + p * stages);
    for (int c = 0; c < n; c++) {
        const num now = dal__stage_sum(y, stages, s->h, K, n, c);
        k->v[c] = dal_moved_v(s, c, now);
        k->shift[c] = dal__stage_sum(y, stages, s->h, free, n, c) - now;
    }
    dal_constraint(s, s->t + k->method->point_c[p] * s->h, k->q, k->v, k->constraint);
}

/* Adds to a row of the matrix the derivative of a constraint with gradient A with respect to the
 * multipliers of stage j; weight: omega times the coefficient of B L_j in the velocity. */
DAL_INLINE void dal__spark_entries(const dal_step *s, const dal_spark_step *k, const num *A, int j,
                                   double weight, num *row)
{
    const int n = DAL_N(s), m = DAL_M(s);
    const num *B = k->blocks + j * DAL_BLOCKS_SIZE(s) + dal_blocks_B(s);
    for (int c = 0; n >= DAL__SPARSE && weight != 0.0 && c < n; c++) {
        const num x = weight * A[c];
        if (dal__is_zero(x)) continue;
        for (int b = 0; b < m; b++) row[b] = dal_fma(x, B[c * m + b], row[b]);
    }
    for (int b = 0; n < DAL__SPARSE && b < m; b++) {
        num entry = A[0] * B[b];
        for (int c = 1; c < n; c++) entry += A[c] * B[c * m + b];
        row[b] += weight * entry;
    }
}

/* Adds the constraints at point p, with weight w, to equation e. */
DAL_INLINE void dal__spark_add(const dal_step *s, const dal_spark_step *k, int p, int e, double w)
{
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    const int first = k->method->L1_known, size = (stages - first) * m;
    const double *y = k->method->to_v + p * stages;
    for (int a = 0; a < m; a++) {
        const num *A = k->constraint + dal_blocks_A(s) + a * n;
        num *row = k->matrix + (e * m + a) * size, sum = k->constraint[a];
        for (int c = 0; c < n; c++) sum += A[c] * k->shift[c];
        k->rhs[e * m + a] -= w * sum;
        for (int j = first; j < stages; j++)
            dal__spark_entries(s, k, A, j, w * s->h * y[j], row + (j - first) * m);
    }
}

DAL_INLINE void dal__spark_equations(dal_step *s, const dal_spark_step *k, const num *K,
                                     const num *free)
{
    const int m = DAL_M(s), points = k->method->points;
    const int count = DAL_STAGES(k->method) - k->method->L1_known, size = count * m;
    for (int i = 0; i < size; i++) k->rhs[i] = dal_num(0.0);
    for (int i = 0; i < size * size; i++) k->matrix[i] = dal_num(0.0);
    for (int p = 0; p < points; p++) {
        dal__spark_point(s, k, p, K, free);
        for (int e = 0; e < count; e++)
            dal__spark_add(s, k, p, e, k->method->omega[e * points + p]);
    }
}

DAL_INLINE void dal__spark_map(dal_step *s, dal_equation *eq)
{
    const dal_spark_step *k = (const dal_spark_step *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s), first = k->method->L1_known;
    const int count = DAL_STAGES(k->method) - first;
    num *const image = eq->block[0].image;
    const num *K = eq->block[0].u;
    dal__spark_velocities(s, k, K);
    dal__spark_stages(s, k, image);
    if (m == 0) return;
    dal__spark_equations(s, k, K, image);
    dal_solve_small(s, k->matrix, k->inverse, count * m, k->rhs, k->L);
    for (int i = 0; i < count; i++) {
        const num *B = k->blocks + (i + first) * DAL_BLOCKS_SIZE(s) + dal_blocks_B(s);
        for (int c = 0; c < n; c++)
            for (int a = 0; a < m; a++)
                image[(i + first) * n + c] += B[c * m + a] * k->L[i * m + a];
    }
    for (int a = 0; a < m; a++)
        k->last[a] = DAL_IF_ACTIVE(eq->active, k->L[(count - 1) * m + a], k->last[a]);
}

/* L_1, where it is known, and the first guess: F at the present state for every K. */
DAL_INLINE void dal__spark_begin(dal_step *s, const dal_spark_step *k, dal_equation *eq)
{
    const int n = DAL_N(s), m = DAL_M(s);
    DAL_VECTOR(s, now, DAL_N(s));
    dal_force(s, s->t, s->y, s->y + n, now);
    for (int i = 0; i < eq->block[0].size; i++) eq->block[0].u[i] = now[i % n];
    for (int a = 0; a < m; a++) k->last[a] = k->given[a] = dal_num(0.0);
    if (!k->method->L1_known) return;
    dal_eval_blocks(s, s->t, s->y, s->y + n, k->blocks);
    dal_restore_multipliers(s, k->blocks, k->given);
}

DAL_INLINE dal_status dal__spark_end(dal_step *s, const dal_spark_step *k, const num *K)
{
    const int n = DAL_N(s), stages = DAL_STAGES(k->method);
    DAL_VECTOR(s, d, DAL_DIM(s));
    dal__spark_velocities(s, k, K);
    for (int c = 0; c < n; c++) {
        d[c] = dal__stage_sum(k->method->b, stages, s->h, k->V, n, c);
        d[n + c] = dal__stage_sum(k->method->b, stages, s->h, K, n, c);
    }
    if (k->method->L1_known) dal_save_multipliers(s, k->last);
    return dal_update(s, s->h, d);
}

/* One step of size s->h. */
DAL_SHARED dal_status dal_spark_advance(dal_step *s, const dal_spark *method)
{
    double product[DAL_MAX_STAGES * DAL_MAX_STAGES];
    DAL_VECTOR(s, V, DAL_STAGES(method) * DAL_N(s));
    DAL_VECTOR(s, blocks, DAL_STAGES(method) * DAL_BLOCKS_SIZE(s));
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, v, DAL_N(s));
    DAL_VECTOR(s, constraint, DAL_CONSTRAINT_SIZE(s));
    DAL_VECTOR(s, given, DAL_M(s));
    DAL_VECTOR(s, last, DAL_M(s));
    DAL_VECTOR(s, shift, DAL_N(s));
    DAL_VECTOR(s, matrix, DAL_STAGES(method) * DAL_M(s) * DAL_STAGES(method) * DAL_M(s));
    DAL_VECTOR(s, inverse, DAL_STAGES(method) * DAL_M(s) * DAL_STAGES(method) * DAL_M(s));
    DAL_VECTOR(s, rhs, DAL_STAGES(method) * DAL_M(s));
    DAL_VECTOR(s, L, DAL_STAGES(method) * DAL_M(s));
    DAL_BLOCK(s, block, DAL_STAGES(method) * DAL_N(s), DAL_MAY_NEWTON(s));
    dal_spark_step k = {{DAL_STAGES(method), s->h, method->ahat, product, 0, NULL},
                        method,
                        V,
                        blocks,
                        q,
                        v,
                        constraint,
                        given,
                        last,
                        shift,
                        matrix,
                        inverse,
                        rhs,
                        L};
    DAL_EQUATION(s, eq, 1, &k, block);
    eq.cost = dal_cost_of_newton(s, DAL_STAGES(method), DAL_N(s), NULL);
    eq.block[0].weight = fabs(s->h);
    dal_set_speeds(s, &eq.block[0], DAL_N(s));
    eq.block[0].progress->scale = dal_velocity_scale(s, s->h, 0);
    dal__product(DAL_STAGES(method), method->a, method->ahat, product);
    dal__spark_begin(s, &k, &eq);
    if (dal_failed(dal_solve(s, &eq, dal__spark_map, dal_constrained_matrix)))
        return DAL_STATUS_NOT_CONVERGED;
    return dal__spark_end(s, &k, eq.block[0].u);
}
#endif

#endif
