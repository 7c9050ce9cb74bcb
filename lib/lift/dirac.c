/* dirac.c - Poisson brackets by differences, and Dirac's algebra in 6n+2.
 *
 *     X = (q, v, lambda, e),   P = (p, pi, pi_lambda, pi_e),   {f,g} = f_X g_P - f_P g_X
 *     H_c = pi.K pi/(2e) + pi.F + lambda.v + mu_e pi_e + mu_lambda.pi_lambda + mu_q.(p - lambda)
 *                                                                                (nh12)-(nh19)
 * Conservation of phi_a on the surface, {phi_a, H_0} + sum_b mu_b {phi_a, phi_b} = 0 over the
 * primary phi_b, is solved for mu by least squares; the residue must vanish.  The rank of
 * {phi_a, phi_b} over all constraints counts the second-class ones. */
#include "lift/dirac.h"
#include "analysis/derivatives.h"
#include "analysis/evaluator.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Brackets are 0 or of order 1, with noise near 1e-12. */
static const double rank_tolerance = 1e-6;

typedef struct observable {
    dal_observable_function *f;
    void *user;
    double *z;
} observable;

static dal_status value_of(void *user, double *out)
{
    const observable *w = user;
    *out = w->f(w->user, w->z);
    return DAL_STATUS_OK;
}

void dal_measure_gradient(dal_observable_function *f, void *user, int count, double *z,
                          double *gradient)
{
    if (!f || !z || !gradient) return;
    double scratch[3];
    observable w = {f, user, z};
    for (int j = 0; j < count; j++)
        dal__differentiate_by(&z[j], value_of, &w, DAL__INCREMENT, 1, scratch, &gradient[j]);
}

double dal_poisson(const double *f, const double *g, int pairs)
{
    if (!f || !g || pairs < 0) return NAN;
    double sum = 0.0;
    for (int i = 0; i < pairs; i++) sum += f[i] * g[pairs + i] - f[pairs + i] * g[i];
    return sum;
}

/* ---- the constraints and the Hamiltonian ---- */

double dal__dirac_constraint(void *user, const double *z, int a)
{
    const dal__dirac_space *w = user;
    int n = w->n, half = 3 * n + 1, k = (a - 1) % n;
    const double *lambda = z + 2 * n, *p = z + half, *pi = p + n, *pi_lambda = p + 2 * n;
    if (a == 0) return z[2 * half - 1];
    switch ((a - 1) / n) {
    case 0:
        return pi_lambda[k];
    case 1:
        return p[k] - lambda[k];
    case 2:
        return pi[k];
    default:
        return lambda[k];
    }
}

/* H_c without its multipliers. */
static double hamiltonian(void *user, const double *z)
{
    dal__dirac_space *w = user;
    int n = w->n;
    const double *v = z + n, *lambda = z + 2 * n, *pi = z + 4 * n + 1;
    double sum = 0.0, square;
    dal_callback *field = dal_evaluator_system(w->evaluator)->call.field;
    if (dal__evaluator_square(w->evaluator, w->t, z, v, pi, w->field, &square) != DAL_STATUS_OK ||
        dal_evaluator_call(w->evaluator, field, w->t, z, v, NULL, w->field) != DAL_STATUS_OK)
        return NAN;
    for (int i = 0; i < n; i++) sum += pi[i] * w->field[i] + lambda[i] * v[i];
    return square / (2.0 * z[3 * n]) + sum;
}

static double current_constraint(void *user, const double *z)
{
    dal__dirac_space *w = user;
    return w->phi(user, z, w->a);
}

/* ---- the algebra at one point ---- */

typedef struct algebra {
    dal__dirac_space space;
    int n, pairs, count, primary;          /* 3n+1, 4n+1, 2n+1 */
    double *z;                             /* [2*pairs] */
    double *gradient;                      /* [(count+1) * 2*pairs]; H's is the last */
    double *matrix, *right, *mu, *scratch; /* [count^2], [count], [count], [count(count+2)] */
} algebra;

static const double *gradient_of(const algebra *w, int a) { return w->gradient + a * 2 * w->pairs; }

static void take_gradients(algebra *w)
{
    for (w->space.a = 0; w->space.a < w->count; w->space.a++)
        dal_measure_gradient(current_constraint, &w->space, 2 * w->pairs, w->z,
                             w->gradient + w->space.a * 2 * w->pairs);
    dal_measure_gradient(hamiltonian, &w->space, 2 * w->pairs, w->z,
                         w->gradient + w->count * 2 * w->pairs);
}

/* {phi_a, phi_b}, a < rows, b < columns.  Most pairs have no derivative of phi_a. */
static void take_brackets(algebra *w, int rows, int columns)
{
    memset(w->matrix, 0, (size_t)rows * (size_t)columns * sizeof *w->matrix);
    for (int a = 0; a < rows; a++)
        for (int i = 0; i < w->pairs; i++) {
            const double x = gradient_of(w, a)[i], p = gradient_of(w, a)[w->pairs + i];
            for (int b = 0; b < columns && (x != 0.0 || p != 0.0); b++)
                w->matrix[a * columns + b] +=
                    x * gradient_of(w, b)[w->pairs + i] - p * gradient_of(w, b)[i];
        }
}

/* Least |{phi_a, H_c}| over mu, a < rows; mu stays in w->mu.  Returns the rank. */
static int conserve(algebra *w, int rows, double *residue)
{
    take_brackets(w, rows, w->primary);
    for (int a = 0; a < rows; a++)
        w->right[a] = -dal_poisson(gradient_of(w, a), gradient_of(w, w->count), w->pairs);
    int rank = dal__least_squares(rows, w->primary, w->matrix, w->right, w->mu, rank_tolerance,
                                  NULL, w->scratch);
    *residue = dal__max_abs(w->right, (size_t)rows);
    return rank;
}

static dal_status analyse(algebra *w, dal_dirac *out)
{
    take_gradients(w);
    if (!isfinite(dal__max_abs(w->gradient, (size_t)(w->count + 1) * 2 * (size_t)w->pairs)))
        return DAL_STATUS_NOT_FINITE;
    out->constraints = w->count;
    out->free_multipliers = w->primary - conserve(w, w->count, &out->conservation);
    out->multipliers = 0.0;
    for (int i = 0; i < w->n; i++) {
        const double mu_q = w->mu[1 + w->n + i], v = w->z[w->n + i];
        out->multipliers = fmax(out->multipliers, fmax(fabs(w->mu[1 + i]), fabs(mu_q - v)));
    }
    double total = hamiltonian(&w->space, w->z);
    for (int b = 0; b < w->primary; b++) total += w->mu[b] * w->space.phi(&w->space, w->z, b);
    out->hamiltonian = fabs(total);
    take_brackets(w, w->count, w->count);
    out->second_class = dal__least_squares(w->count, w->count, w->matrix, NULL, NULL,
                                           rank_tolerance, NULL, w->scratch);
    out->first_class = w->count - out->second_class;
    /* On the primary surface, off the secondary one: p = lambda and pi of order 1. */
    dal__random random = {3};
    double *lambda = w->z + 2 * w->n, *p = w->z + w->pairs, *pi = p + w->n;
    for (int i = 0; i < w->n; i++) {
        lambda[i] = p[i] = dal__uniform(&random);
        pi[i] = 0.5 + 0.25 * dal__uniform(&random);
    }
    take_gradients(w);
    conserve(w, w->primary, &out->secondary);
    return DAL_STATUS_OK;
}

dal_status dal__dirac_algebra(dal_evaluator *evaluator, const dal_point *at, double e,
                              double (*phi)(void *user, const double *z, int a), dal_dirac *out)
{
    const dal_system *s = dal_evaluator_system(evaluator);
    if (s->multipliers > 0) return DAL_STATUS_UNSUPPORTED;
    size_t n = (size_t)s->n, size = 6 * n + 2, count = 4 * n + 1;
    size_t numbers = size + (count + 1) * size + 2 * count * count + 4 * count + 3 * n;
    double *block = dal__numbers(1, numbers);
    if (block == NULL) return DAL_STATUS_MEMORY;
    algebra w = {.n = s->n, .pairs = 3 * s->n + 1, .count = (int)count, .primary = 2 * s->n + 1};
    w.z = block, w.gradient = block + size, w.matrix = w.gradient + (count + 1) * size;
    w.right = w.matrix + count * count, w.mu = w.right + count, w.scratch = w.mu + count;
    w.space = (dal__dirac_space){.evaluator = evaluator, .n = s->n, .t = at->t, .phi = phi};
    w.space.field = block + numbers - 3 * n;
    memcpy(w.z, at->q, n * sizeof(double));
    memcpy(w.z + n, at->v, n * sizeof(double));
    w.z[3 * n] = e;
    dal_status status = analyse(&w, out);
    free(block);
    return status;
}

dal_status dal_evaluator_check_dirac(dal_evaluator *evaluator, const dal_point *at, double e,
                                     dal_dirac *out)
{
    DAL_REQUIRE(evaluator && dal__has_state(at) && out, NULL);
    return dal__dirac_algebra(evaluator, at, e, dal__dirac_constraint, out);
}
