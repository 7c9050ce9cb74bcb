/* spark.h - partitioned Runge-Kutta steps with multipliers at the stages and D among the equations.
 *
 *     V_i = v + h sum_j ahat_ij K_j    Q_i = q + h sum_j a_ij V_j
 *     K_i = a(Q_i, V_i) + B(Q_i, V_i) L_i
 *     sum_p omega_ep D(q_p, v_p, t + c_p h) = 0
 *     v_p = v + h sum_j y_pj K_j       q_p = q + h sum_j x_pj V_j
 *     v1  = v + h sum_j b_j K_j        q1  = q + h sum_j b_j V_j
 *
 * with as many equations e as unknown multipliers L_i: all, or all but L_1, which is then L_s of
 * the last step.  The K_i are iterated.  The next K_j are those with
 *
 *     K_j = a_j + B_j L_j,   A_j K_j = A_j (K_j of before) + T_j,
 *     h sum_j (sum_p omega_ep y_pj) T_j = - sum_p omega_ep D_p
 *
 * for which the equations hold to first order, with A_j for A_p, which changes like h from stage
 * to stage: the iteration contracts like h in any case.  Each K_j with its L_j is then one solution
 * by the factors of F, and the matrix of the T_j is one of numbers.  K_1 and L_1 that is known come
 * first, and the points have the new K_1.
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
    const double *omega;                 /* [(s - L1_known)*points] */
} dal_spark;

#define dal_spark_advance DAL_WIDE(dal_spark_advance)
DAL_SHARED dal_status dal_spark_advance(dal_step *s, const dal_spark *method);

#ifndef DAL_LINKED
typedef struct dal_spark_step {
    dal_stage_matrix newton; /* first, for dal_constrained_matrix */
    const dal_spark *method;
    num *V;         /* [s*n] */
    num *q, *v, *D; /* a point, and D there */
    num *given,
        *last;     /* [m + 1] L_1 where it is known, and 1; [m] L_s of a lane's last iteration */
    num *weights;  /* [s*s] -1/h times the inverse of sum_p omega_ep y_pj */
    num *missing;  /* [s*m] sum_p omega_ep D_p */
    num *in, *out; /* of DAL_EVAL_ENFORCEMENT */
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

/* K_1 = a_1 + B_1 L_1, where L_1 is known. */
DAL_INLINE void dal__spark_first(dal_step *s, const dal_spark_step *k, num *K1)
{
    dal__spark_position(s, k, k->method->a);
    s->evaluations++;
    dal_eval(s, DAL_EVAL_REACTION, s->t + k->method->c[0] * s->h, k->q, k->V, k->given, K1);
}

/* What the equations miss, for these K. */
DAL_INLINE void dal__spark_missing(dal_step *s, const dal_spark_step *k, const num *K)
{
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    const int points = k->method->points, count = stages - k->method->L1_known;
    for (int i = 0; i < count * m; i++) k->missing[i] = dal_num(0.0);
    for (int p = 0; p < points; p++) {
        const double *y = k->method->to_v + p * stages;
        dal__spark_position(s, k, k->method->to_q + p * stages);
        for (int c = 0; c < n; c++)
            k->v[c] = dal_moved_v(s, c, dal__stage_sum(y, stages, s->h, K, n, c));
        dal_constraint_value(s, s->t + k->method->point_c[p] * s->h, k->q, k->v, k->D);
        for (int e = 0; e < count; e++)
            for (int a = 0; a < m; a++)
                k->missing[e * m + a] += k->method->omega[e * points + p] * k->D[a];
    }
}

/* The next K_j from the last one, in place; L_j in k->out. */
DAL_INLINE void dal__spark_stage(dal_step *s, const dal_spark_step *k, int j, num *K)
{
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    const int first = k->method->L1_known, count = stages - first;
    for (int c = 0; c < n; c++) k->in[c] = K[c];
    for (int a = 0; a < m; a++) {
        num sum = dal_num(0.0);
        for (int e = 0; e < count; e++)
            sum = dal_fma(k->weights[(j - first) * count + e], k->missing[e * m + a], sum);
        k->in[n + a] = sum;
    }
    k->in[n + m] = dal_num(1.0);
    dal__spark_position(s, k, k->method->a + j * stages);
    dal_eval_enforcement(s, s->t + k->method->c[j] * s->h, k->q, k->V + j * n, k->in, k->out);
    for (int c = 0; c < n; c++) K[c] = k->out[c];
}

DAL_INLINE void dal__spark_map(dal_step *s, dal_equation *eq)
{
    const dal_spark_step *k = (const dal_spark_step *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s), stages = DAL_STAGES(k->method);
    num *const image = eq->block[0].image;
    dal__spark_velocities(s, k, eq->block[0].u);
    for (int i = 0; i < stages * n; i++) image[i] = eq->block[0].u[i];
    if (k->method->L1_known) dal__spark_first(s, k, image);
    if (m > 0) dal__spark_missing(s, k, image);
    for (int j = k->method->L1_known; j < stages; j++) dal__spark_stage(s, k, j, image + j * n);
    for (int a = 0; a < m; a++) k->last[a] = DAL_IF_ACTIVE(eq->active, k->out[n + a], k->last[a]);
}

/* -1/h times the inverse of the matrix of the T_j. */
DAL_INLINE void dal__spark_weights(dal_step *s, const dal_spark *method, num *weights)
{
    const int stages = DAL_STAGES(method), first = method->L1_known, count = stages - first;
    DAL__MARK(s);
    DAL_VECTOR(s, matrix, DAL_STAGES(method) * DAL_STAGES(method));
    for (int e = 0; e < count; e++)
        for (int j = 0; j < count; j++) {
            double sum = 0.0;
            for (int p = 0; p < method->points; p++)
                sum += method->omega[e * method->points + p] * method->to_v[p * stages + j + first];
            matrix[e * count + j] = dal_num(-s->h * sum);
        }
    dal_invert(matrix, weights, count);
    DAL__RELEASE(s);
}

/* The multipliers of the last step, or F's at the present state where there are none. */
DAL_INLINE void dal__restore_multipliers(dal_step *s, num *h)
{
    const int n = DAL_N(s), m = DAL_M(s);
    const dal_mask known = dal_known_multipliers(s);
    DAL_EACH(i, m) h[i] = dal_num(0.0);
    if (dal_any(~known)) {
        DAL_VECTOR(s, in, DAL_N(s) + DAL_M(s) + 1);
        DAL_VECTOR(s, out, DAL_N(s) + DAL_M(s));
        dal_motion_multipliers(s, in, out);
        DAL_EACH(i, m) h[i] = out[n + i];
    }
    DAL_EACH(i, DAL_PERSISTENT_MULTIPLIERS(s)) h[i] = dal_select(known, s->multiplier[i], h[i]);
}

/* L_1, where it is known, and the first guess: F at the present state for every K. */
DAL_INLINE void dal__spark_begin(dal_step *s, const dal_spark_step *k, dal_equation *eq)
{
    const int n = DAL_N(s), m = DAL_M(s);
    DAL_VECTOR(s, now, DAL_N(s));
    dal_force(s, s->t, s->y, s->y + n, now);
    for (int i = 0; i < eq->block[0].size; i++) eq->block[0].u[i] = now[i % n];
    for (int a = 0; a < m; a++) k->last[a] = dal_num(0.0);
    dal__spark_weights(s, k->method, k->weights);
    if (!k->method->L1_known) return;
    dal__restore_multipliers(s, k->given);
    k->given[m] = dal_num(1.0);
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
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, v, DAL_N(s));
    DAL_VECTOR(s, D, DAL_M(s));
    DAL_VECTOR(s, given, DAL_M(s) + 1);
    DAL_VECTOR(s, last, DAL_M(s));
    DAL_VECTOR(s, weights, DAL_STAGES(method) * DAL_STAGES(method));
    DAL_VECTOR(s, missing, DAL_STAGES(method) * DAL_M(s));
    DAL_VECTOR(s, in, DAL_N(s) + DAL_M(s) + 1);
    DAL_VECTOR(s, out, DAL_N(s) + DAL_M(s));
    DAL_BLOCK(s, block, DAL_STAGES(method) * DAL_N(s), DAL_MAY_NEWTON(s));
    dal_spark_step k = {{DAL_STAGES(method), s->h, method->ahat, product, false, NULL},
                        method,
                        V,
                        q,
                        v,
                        D,
                        given,
                        last,
                        weights,
                        missing,
                        in,
                        out};
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
