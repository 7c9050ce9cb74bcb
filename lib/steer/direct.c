/* direct.c - minimises the cost of pieces that begin with p = 0 and any pi.
 *
 *     min sum_k S_k(x_k, pi_k),    x_(k+1) = X_k(x_k, pi_k),    x = (q, v) given at the ends
 *
 * With pi_k = C_k u_k, C_k C_k^T = e/H (K in its range)^-1 and S_k = |u_k|^2/2 to leading order an
 * iteration is, with A_k, B_k = X_x, X_pi C_k and jumps r_k,
 *
 *     min sum_k S_k + S_x dx_k + S_u du_k + |du_k|^2/2,    dx_(k+1) = A_k dx_k + B_k du_k + r_k
 *
 *     du_k = B_k^T lambda_(k+1) - S_u,    lambda_k = A_k^T lambda_(k+1) - S_x
 *
 * where the multiplier at the end follows from the Gramian sum Phi B B^T Phi^T (with a slack along
 * the integrals, and a part of its trace added where targets are not reached to first order).  The
 * multipliers are then the momenta of an extremal. */
#include "steer/direct.h"
#include "core/error.h"
#include "core/svd.h"
#include "core/vectors.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double range_tolerance = 1e-9, free_start_size = 4.0;

dal_status dal__direct_open(dal__direct *d, dal__shooting *s)
{
    const dal__problem *p = s->problem;
    const size_t n = (size_t)p->n, pieces = (size_t)s->pieces, unknowns = (size_t)p->unknowns;
    const size_t numbers = (pieces + 1) * (size_t)p->dimension;
    *d = (dal__direct){.s = s, .damping = 1e-6};
    d->memory =
        dal__numbers(pieces + 2, 11 * n * n + unknowns + 17 * n + 2 * (size_t)p->dimension + 64);
    if (!d->memory) return DAL_STATUS_MEMORY;
    d->control = d->memory;
    d->jumps = d->control + pieces * n * n;
    d->costate = d->jumps + pieces * unknowns;
    d->change_x = d->costate + (pieces + 1) * 2 * n;
    d->change_pi = d->change_x + (pieces + 1) * 2 * n;
    d->point = d->change_pi + pieces * n;
    d->end = d->point + numbers;
    d->gramian = d->end + numbers;
    for (size_t k = 0; k <= pieces; k++) {
        double *z = s->point + k * (size_t)p->dimension;
        memset(z + 2 * n + 1, 0, n * sizeof *z);
        if (k == pieces) memset(z + 3 * n + 1, 0, n * sizeof *z);
        z[4 * n + 1] = 0.0;
    }
    return DAL_STATUS_OK;
}

void dal__direct_close(dal__direct *d) { free(d->memory); }

/* C of a piece, by the singular values of K, and pi without what K does not act on. */
static dal_status find_control(dal__direct *d, int k)
{
    dal__shooting *s = d->s;
    dal__problem *p = s->problem;
    const int n = p->n;
    double *z = s->point + k * p->dimension, *C = d->control + k * n * n;
    double *K = d->gramian, *value = K + n * n, *vector = value + n, *pi = vector + n * n;
    const double H = fabs((double)(s->first[k + 1] - s->first[k]) * s->h);
    DAL_TRY(dal__problem_effort(p, dal__shooting_time(s, k), z, K));
    if (!isfinite(dal__max_abs(K, (size_t)(n * n)))) return DAL_STATUS_NOT_FINITE;
    if (!dal__singular_values(n, n, K, value, vector)) return DAL_STATUS_MEMORY;
    memset(C, 0, (size_t)(n * n) * sizeof *C);
    memset(pi, 0, (size_t)n * sizeof *pi);
    for (int j = 0; j < n && value[j] > range_tolerance * value[0]; j++) {
        const double *v = vector + j * n;
        double along = 0.0;
        for (int i = 0; i < n; i++) along += v[i] * z[3 * n + 1 + i] / p->unit[3 * n + i];
        for (int i = 0; i < n; i++) {
            pi[i] += along * v[i];
            /* pi = C u in units; K is in units of v, whose product with units of pi is the scale */
            C[i * n + j] =
                v[i] * sqrt(p->e / (H * value[j])) / (p->unit[3 * n + i] * p->unit[n + i]);
        }
    }
    for (int i = 0; i < n; i++) z[3 * n + 1 + i] = pi[i] * p->unit[3 * n + i];
    return DAL_STATUS_OK;
}

/* The entry of the derivative of the end of a piece by an unknown. */
static double derivative_at(const dal__direct *d, int k, int row, int column)
{
    const int size = d->s->problem->unknowns;
    return d->s
        ->derivative[((size_t)k * (size_t)size + (size_t)row) * (size_t)size + (size_t)column];
}

/* Change of the cost of a piece by an unknown. */
static double cost_at(const dal__direct *d, int k, int unknown)
{
    const dal__problem *p = d->s->problem;
    return p->e * d->s->cost[k * p->unknowns + unknown];
}

/* du of a piece by the multipliers of its end, u[n]. */
static void find_change_of_control(const dal__direct *d, int k, const double *costate, double *u)
{
    const int n = d->s->problem->n;
    const double *C = d->control + k * n * n;
    memset(u, 0, (size_t)n * sizeof *u);
    for (int i = 0; i < n; i++) {
        double rate = -cost_at(d, k, 3 * n + i);
        for (int j = 0; j < 2 * n; j++) rate += derivative_at(d, k, j, 3 * n + i) * costate[j];
        for (int c = 0; c < n; c++) u[c] += C[i * n + c] * rate;
    }
}

/* Multipliers of all jumps, from the last ones. */
static void sweep_back(dal__direct *d)
{
    const int n = d->s->problem->n;
    for (int k = d->s->pieces; k-- > 0;) {
        const double *next = d->costate + (k + 1) * 2 * n;
        for (int i = 0; i < 2 * n; i++) {
            double sum = -cost_at(d, k, i);
            for (int j = 0; j < 2 * n; j++) sum += derivative_at(d, k, j, i) * next[j];
            d->costate[k * 2 * n + i] = sum;
        }
    }
}

/* Changes by these multipliers. */
static void sweep_forward(dal__direct *d, double *u)
{
    const dal__problem *p = d->s->problem;
    const int n = p->n;
    for (int i = 0; i < 2 * n; i++)
        d->change_x[i] = p->is_free[0][i] ? free_start_size * free_start_size * d->costate[i] : 0.0;
    for (int k = 0; k < d->s->pieces; k++) {
        const double *dx = d->change_x + k * 2 * n, *C = d->control + k * n * n;
        double *dpi = d->change_pi + k * n, *next = d->change_x + (k + 1) * 2 * n;
        find_change_of_control(d, k, d->costate + (k + 1) * 2 * n, u);
        for (int i = 0; i < n; i++) dpi[i] = dal__dot_product(n, C + i * n, u);
        for (int i = 0; i < 2 * n; i++) {
            double sum = d->jumps[k * p->unknowns + i];
            for (int j = 0; j < 2 * n; j++) sum += derivative_at(d, k, i, j) * dx[j];
            for (int j = 0; j < n; j++) sum += derivative_at(d, k, i, 3 * n + j) * dpi[j];
            next[i] = sum;
        }
    }
}

/* row[count] += factor * other */
static void add_multiple(int count, double factor, const double *other, double *row)
{
    for (int i = 0; i < count; i++) row[i] += factor * other[i];
}

/* The Gramian, [2n*2n], of all pieces; scratch[8n*n]. */
static void find_gramian(const dal__direct *d, double *G, double *scratch)
{
    const dal__problem *p = d->s->problem;
    const int n = p->n, w = 2 * n;
    double *AG = scratch, *B = scratch + w * w;
    memset(G, 0, (size_t)(w * w) * sizeof *G);
    for (int i = 0; i < w; i++)
        if (p->is_free[0][i]) G[i * w + i] = free_start_size * free_start_size;
    for (int k = 0; k < d->s->pieces; k++) {
        const double *C = d->control + k * n * n;
        memset(AG, 0, (size_t)(w * w) * sizeof *AG);
        memset(B, 0, (size_t)(w * n) * sizeof *B);
        for (int i = 0; i < w * w; i++)
            add_multiple(w, derivative_at(d, k, i / w, i % w), G + i % w * w, AG + i / w * w);
        for (int i = 0; i < w * n; i++)
            add_multiple(n, derivative_at(d, k, i / n, 3 * n + i % n), C + i % n * n,
                         B + i / n * n);
        for (int i = 0; i < w * w; i++) {
            G[i] = dal__dot_product(n, B + i / w * n, B + i % w * n);
            for (int l = 0; l < w; l++) G[i] += AG[i / w * w + l] * derivative_at(d, k, i % w, l);
        }
    }
}

/* Removes from x[2n] components that are free at the end, and what integrals determine. */
static void restrict_to_target(const dal__problem *p, const double *normals, double *x)
{
    for (int i = 0; i < 2 * p->n; i++)
        if (p->is_free[1][i]) x[i] = 0.0;
    for (int a = 0; a < p->integrals; a++)
        dal__remove_component(x, normals + a * 2 * p->n, 2 * p->n);
}

/* Orthonormal gradients of the integrals at the end by components that are not free there. */
static dal_status find_end_normals(dal__direct *d, double *normals)
{
    dal__problem *p = d->s->problem;
    const int w = 2 * p->n;
    if (p->integrals == 0) return DAL_STATUS_OK;
    const double *z = d->s->point + d->s->pieces * p->dimension;
    DAL_TRY(dal__problem_gradients(p, p->T, z, normals));
    for (int a = 0; a < p->integrals; a++) {
        for (int i = 0; i < w; i++)
            if (p->is_free[1][i]) normals[a * w + i] = 0.0;
        const double length = dal__max_abs(normals + a * w, (size_t)w);
        if (length > 0.0 && dal__orthonormalise_row(normals, a, w) > 1e-9 * length) continue;
        memset(normals + a * w, 0, (size_t)w * sizeof *normals);
    }
    return DAL_STATUS_OK;
}

/* Solves (G + damping) x = right on what the target determines. */
static bool solve_target(dal__direct *d, const double *normals, double *G, double *right,
                         double *out)
{
    const dal__problem *p = d->s->problem;
    const int w = 2 * p->n;
    double *value = G + 4 * w * w, *vector = value + w, trace = 0.0;
    for (int i = 0; i < w; i++) restrict_to_target(p, normals, G + i * w);
    for (int j = 0; j < w; j++) { /* G is symmetric */
        for (int i = 0; i < w; i++) out[i] = G[i * w + j];
        restrict_to_target(p, normals, out);
        for (int i = 0; i < w; i++) G[i * w + j] = out[i];
    }
    for (int i = 0; i < w; i++) trace += G[i * w + i];
    restrict_to_target(p, normals, right);
    if (!dal__singular_values(w, w, G, value, vector)) return false;
    memset(out, 0, (size_t)w * sizeof *out);
    for (int k = 0; k < w; k++) {
        const double *v = vector + k * w, size = value[k] + d->damping * trace;
        const double part = dal__dot_product(w, v, right);
        for (int i = 0; i < w && size > 1e-14 * trace; i++) out[i] += part / size * v[i];
    }
    restrict_to_target(p, normals, out);
    return true;
}

/* The cost plus the jumps times a bound of their multipliers. */
static double find_merit(const dal__direct *d, const double *point, const double *end,
                         double weight, double *jump)
{
    const dal__shooting *s = d->s;
    const dal__problem *p = s->problem;
    double cost = 0.0, sum = 0.0;
    *jump = 0.0;
    for (int k = 0; k < s->pieces; k++) {
        cost += p->e * end[k * p->dimension + 4 * p->n + 1];
        for (int i = 0; i < 2 * p->n; i++) {
            const double x =
                fabs(end[k * p->dimension + i] - point[(k + 1) * p->dimension + i]) / p->unit[i];
            sum += x;
            *jump = fmax(*jump, x);
        }
    }
    return cost + weight * sum;
}

/* Goes a part of the changes. */
static void try_change(const dal__direct *d, double part)
{
    const dal__shooting *s = d->s;
    const dal__problem *p = s->problem;
    const int n = p->n;
    memcpy(d->point, s->point, (size_t)((s->pieces + 1) * p->dimension) * sizeof *d->point);
    for (int k = 0; k <= s->pieces; k++) {
        double *z = d->point + k * p->dimension;
        for (int i = 0; i < 2 * n; i++)
            if (k < s->pieces || p->is_free[1][i])
                z[i] += part * d->change_x[k * 2 * n + i] * p->unit[i];
        for (int i = 0; i < n && k < s->pieces; i++)
            z[3 * n + 1 + i] += part * d->change_pi[k * n + i] * p->unit[3 * n + i];
    }
}

/* Finds all changes. */
static dal_status find_changes(dal__direct *d)
{
    dal__shooting *s = d->s;
    dal__problem *p = s->problem;
    const int w = 2 * p->n, last = s->pieces * w;
    double *G = d->gramian, *scratch = G + w * w;
    double *normals = G + 6 * w * w, *right = normals + w * w, *u = right + w;
    for (int k = 0; k < s->pieces; k++) DAL_TRY(find_control(d, k));
    DAL_TRY(dal__shooting_move(s, s->point, s->end));
    dal__shooting_jumps(s, s->point, s->end, w, d->jumps);
    DAL_TRY(dal__shooting_differentiate(s, DAL__COLUMNS_WITHOUT_P));
    memset(d->costate + last, 0, (size_t)w * sizeof *u);
    sweep_back(d);
    sweep_forward(d, u);
    for (int i = 0; i < w; i++)
        right[i] = (p->target[i] - s->point[s->pieces * p->dimension + i]) / p->unit[i] -
                   d->change_x[last + i];
    DAL_TRY(find_end_normals(d, normals));
    find_gramian(d, G, scratch);
    if (!solve_target(d, normals, G, right, d->costate + last)) return DAL_STATUS_MEMORY;
    sweep_back(d);
    sweep_forward(d, u);
    return DAL_STATUS_OK;
}

dal_status dal__direct_iterate(dal__direct *d)
{
    dal__shooting *s = d->s;
    dal__problem *p = s->problem;
    const int w = 2 * p->n;
    double jump;
    DAL_TRY(dal__problem_iterate(p));
    DAL_TRY(find_changes(d));
    const double weight = 1.5 * dal__max_abs(d->costate, (size_t)((s->pieces + 1) * w));
    const double before = find_merit(d, s->point, s->end, weight, &d->jump);
    d->change = dal__max_abs(d->change_x, (size_t)(s->pieces * w));
    d->is_stuck = true;
    for (double part = 1.0; part > 1e-3 && d->is_stuck; part /= 2.0) {
        try_change(d, part);
        if (dal__shooting_move(s, d->point, d->end) != DAL_STATUS_OK) {
            DAL_TRY(p->stopped);
            continue;
        }
        const double after = find_merit(d, d->point, d->end, weight, &jump);
        if (!(after < before)) continue;
        const size_t numbers = (size_t)(s->pieces * p->dimension);
        memcpy(s->point, d->point, (numbers + (size_t)p->dimension) * sizeof *s->point);
        memcpy(s->end, d->end, numbers * sizeof *s->end);
        d->is_stuck = false;
        d->jump = jump;
        d->damping = part == 1.0 ? fmax(d->damping / 10.0, 1e-12) : d->damping;
    }
    if (d->is_stuck) d->damping = fmin(10.0 * d->damping, 1.0);
    p->residual = d->jump;
    return DAL_STATUS_OK;
}

void dal__direct_extremal(const dal__direct *d, double *out)
{
    const dal__shooting *s = d->s;
    const dal__problem *p = s->problem;
    const int w = 2 * p->n;
    memcpy(out, s->point, (size_t)((s->pieces + 1) * p->dimension) * sizeof *out);
    for (int k = 0; k <= s->pieces; k++)
        for (int i = 0; i < w; i++)
            out[k * p->dimension + w + 1 + i] = d->costate[k * w + i] / p->unit[i];
}
