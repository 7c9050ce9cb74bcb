/* contact_chain.h - a chain of oscillators in contact: a system with many coordinates, given as C
 * callbacks.
 *
 *     coordinates  z_0, z_1 .. z_k, y_1 .. y_k,   n = 1 + 2k      (z_0 is the x of the paper)
 *     L = |v|^2/2 - U,   U = (|q|^2 + eps sum_i z_(i-1)^2 z_i^2)/2,   i = 1..k
 *     D = z_0' + sum_i y_i z_i'
 *
 * k = 1 is the contact oscillator of McLachlan and Perlmutter 2006, 5.2.  With b = -U_q,
 * A = (1, y, 0) and G = 1 + |y|^2
 *
 *     h = -(sum y_i' z_i' + b_0 + sum y_i b_i)/G
 *     F_z0 = b_0 + h       F_zi = b_i + y_i h       F_yi = -y_i
 *
 * Adjoint, without a Jacobian, with beta = A pi/G and alpha = pi - A^T beta:
 *
 *     F_q^T pi = b_q alpha + (0, 0, h alpha_zi - beta F_zi)        F_v^T pi = -beta (0, y', z')
 *
 * A field costs O(n) operations and so does an adjoint. */
#ifndef CONTACT_CHAIN_H
#define CONTACT_CHAIN_H

#include <dalembert.h>
#include <math.h>

#ifndef CHAIN_LINKS
#define CHAIN_LINKS 50
#endif
enum { CHAIN_K = CHAIN_LINKS, CHAIN_Y = CHAIN_K + 1, CHAIN_N = 1 + 2 * CHAIN_K, CHAIN_PARTS = 8 };

/* sum of a_i b_i over the links in eight partial sums: they fit a vector register, and the order of
 * summation is the same whether the compiler uses one or not. */
static inline double chain_dot(const double *a, const double *b)
{
    double sum[CHAIN_PARTS] = {0};
    int i = 0;
    for (; i + CHAIN_PARTS <= CHAIN_K; i += CHAIN_PARTS)
        for (int j = 0; j < CHAIN_PARTS; j++) sum[j] += a[i + j] * b[i + j];
    for (int j = 0; i + j < CHAIN_K; j++) sum[j] += a[i + j] * b[i + j];
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

/* The spring of z_i: 1 + eps (z_(i-1)^2 + z_(i+1)^2), with what is there of the neighbours. */
static inline double chain_spring(double eps, const double *z, int i)
{
    const double left = i > 0 ? z[i - 1] : 0.0, right = i < CHAIN_K ? z[i + 1] : 0.0;
    return 1.0 + eps * (left * left + right * right);
}

/* F and, as the result, the multiplier h. */
static inline double chain_force(double eps, const double *q, const double *v, double *F)
{
    const double *z = q, *y = q + CHAIN_Y, *vz = v, *vy = v + CHAIN_Y;
    F[0] = -z[0] * chain_spring(eps, z, 0);
    for (int i = 1; i < CHAIN_K; i++) F[i] = -z[i] * chain_spring(eps, z, i);
    F[CHAIN_K] = -z[CHAIN_K] * chain_spring(eps, z, CHAIN_K);
    const double Ab = F[0] + chain_dot(y, F + 1), c = chain_dot(vy, vz + 1);
    const double h = -(c + Ab) / (1.0 + chain_dot(y, y));
    F[0] += h;
    for (int i = 0; i < CHAIN_K; i++) F[1 + i] += y[i] * h;
    for (int i = 0; i < CHAIN_K; i++) F[CHAIN_Y + i] = -y[i];
    return h;
}

static inline dal_status chain_field(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    chain_force(at->work[0], at->q, at->v, out);
    return DAL_STATUS_OK;
}

/* b_q alpha for z_i, alpha = (pi_0 - beta, pi_zi - beta y_i, pi_yi). */
static inline double chain_hessian(double eps, const double *z, const double *alpha, int i)
{
    const double left = i > 0 ? z[i - 1] * alpha[i - 1] : 0.0;
    const double right = i < CHAIN_K ? z[i + 1] * alpha[i + 1] : 0.0;
    return -chain_spring(eps, z, i) * alpha[i] - 2.0 * eps * z[i] * (left + right);
}

static inline dal_status chain_adjoint(const dal_system *system, const dal_point *at, double *out)
{
    const double *y = at->q + CHAIN_Y, *vz = at->v + 1, *vy = at->v + CHAIN_Y, *pi = at->pi;
    double *F = out, *Fq = out + CHAIN_N, *Fv = out + 2 * CHAIN_N, alpha[CHAIN_N];
    const double eps = at->work[0], h = chain_force(eps, at->q, at->v, F);
    const double beta = (pi[0] + chain_dot(y, pi + 1)) / (1.0 + chain_dot(y, y));
    (void)system;
    alpha[0] = pi[0] - beta;
    for (int i = 0; i < CHAIN_K; i++) alpha[1 + i] = pi[1 + i] - beta * y[i];
    for (int i = CHAIN_Y; i < CHAIN_N; i++) alpha[i] = pi[i];
    Fq[0] = chain_hessian(eps, at->q, alpha, 0);
    for (int i = 1; i < CHAIN_K; i++) Fq[i] = chain_hessian(eps, at->q, alpha, i);
    Fq[CHAIN_K] = chain_hessian(eps, at->q, alpha, CHAIN_K);
    for (int i = 0; i < CHAIN_K; i++)
        Fq[CHAIN_Y + i] = h * alpha[1 + i] - beta * F[1 + i] - alpha[CHAIN_Y + i];
    Fv[0] = 0.0;
    for (int i = 0; i < CHAIN_K; i++) Fv[1 + i] = -beta * vy[i];
    for (int i = 0; i < CHAIN_K; i++) Fv[CHAIN_Y + i] = -beta * vz[i];
    return DAL_STATUS_OK;
}

static inline dal_status chain_constraints(const dal_system *system, const dal_point *at,
                                           double *out)
{
    (void)system;
    out[0] = at->v[0] + chain_dot(at->q + CHAIN_Y, at->v + 1);
    return DAL_STATUS_OK;
}

/* D, A and W^-1 A^T, which with unit masses is A again. */
static inline dal_status chain_constraint(const dal_system *system, const dal_point *at,
                                          double *out)
{
    double *A = out + 1, *B = out + 1 + CHAIN_N;
    for (int i = 0; i < CHAIN_N; i++) A[i] = i == 0 ? 1.0 : 0.0;
    for (int i = 0; i < CHAIN_K; i++) A[1 + i] = at->q[CHAIN_Y + i];
    for (int i = 0; i < CHAIN_N; i++) B[i] = A[i];
    return chain_constraints(system, at, out);
}

static inline dal_status chain_energy(const dal_system *system, const dal_point *at, double *out)
{
    const double *q = at->q, *v = at->v, eps = at->work[0];
    double twice = 0.0;
    (void)system;
    for (int i = 0; i < CHAIN_N; i++) twice += v[i] * v[i] + q[i] * q[i];
    for (int i = 1; i <= CHAIN_K; i++) twice += eps * (q[i - 1] * q[i - 1]) * (q[i] * q[i]);
    out[0] = 0.5 * twice;
    return DAL_STATUS_OK;
}

/* q, v, e at t = 0, with z_0' from D = 0; k = 1 is a start with a known solution. */
static inline dal_status chain_start(const dal_system *system, const dal_point *at, double *out)
{
    double *q = out, *v = out + CHAIN_N;
    (void)system, (void)at;
    q[0] = 0.8;
    for (int i = 0; i < CHAIN_K; i++) {
        q[1 + i] = -0.5 * cos(2.0 * i);
        q[CHAIN_Y + i] = 0.6 * cos(i);
        v[1 + i] = 0.4 * cos(3.0 * i);
        v[CHAIN_Y + i] = 0.7 * cos(0.5 * i);
    }
    v[0] = -chain_dot(q + CHAIN_Y, v + 1);
    v[CHAIN_N] = 1.0;
    return DAL_STATUS_OK;
}

static const char *const chain_parameter[] = {"eps"};
static const double chain_value[] = {0.3};

static const dal_system chain_system = {
    .name = "contact chain",
    .n = CHAIN_N,
    .m = 1,
    .parameters = 1,
    .properties = DAL_D_LINEAR | DAL_D_BILINEAR | DAL_E_ON_D | DAL_AUTONOMOUS | DAL_MASS_CONSTANT,
    .parameter = chain_parameter,
    .value = chain_value,
    .call = {.field = chain_field, .adjoint = chain_adjoint, .constraint = chain_constraint},
    .start = chain_start,
    .constraints = chain_constraints,
    .energy = chain_energy};

#endif
