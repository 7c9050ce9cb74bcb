/* adjoint_pairing.c - the pairing p.dq + pi.dv of the adjoint motion and a tangent vector.
 *
 * For 1/e = 0, H = P.f(x) is linear in P = (p, pi): its flow is the motion and its adjoint, and
 * P.dx with dx from the tangent map is constant in time.  A symplectic method preserves it exactly,
 * for (dx, P) is then one tangent vector and one covector moved by the same map. */
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "dalembert_order.h"
#include "dynamics/tangent_map.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct pairing {
    dal_run *lifted, *tangent;
    int n;
} pairing;

static double pair(const pairing *w)
{
    int n = w->n;
    const double *z = dal_run_state(w->lifted), *x = dal_run_state(w->tangent);
    const double *p = z + 2 * n + 1, *pi = z + 3 * n + 1, *dq = x + n, *dv = x + 3 * n;
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += p[i] * dq[i] + pi[i] * dv[i];
    return sum;
}

static dal_status add_pairings(pairing *w, long long steps, dal_statistics *statistics,
                               dal_error *error)
{
    dal_statistics_start(statistics, 1);
    for (long long k = 0; k <= steps; k++) {
        if (k > 0) DAL_TRY(dal_run_step(w->lifted, error));
        if (k > 0) DAL_TRY(dal_run_step(w->tangent, error));
        const double value = pair(w);
        dal_statistics_add(statistics, 1, dal_run_time(w->lifted), &value);
    }
    return DAL_STATUS_OK;
}

/* The tangent run starts where the lifted one does, with direction as (dq, dv). */
static dal_status start_tangent(pairing *w, const double *direction, dal_error *error)
{
    double *x = dal__numbers(4, (size_t)w->n);
    if (x == NULL) return dal__memory_error(error);
    dal__tangent_scatter(dal_run_system(w->lifted), DAL_PHYSICAL, dal_run_state(w->lifted),
                         direction, x);
    dal_status status = dal_run_set_state(w->tangent, dal_run_time(w->lifted), x, error);
    free(x);
    return status;
}

static dal_status open_pairing(pairing *w, const dal_run_spec *spec, const dal_system *tangent,
                               dal_error *error)
{
    dal_setting *start = calloc((size_t)spec->start_count + 1, sizeof *start);
    if (start == NULL) return dal__memory_error(error);
    dal_run_spec adjoint = *spec, physical = *spec;
    /* e = infinity instead of any other e. */
    int count = 0;
    for (int i = 0; i < spec->start_count; i++)
        if (strcmp(spec->start[i].name, "e") != 0) start[count++] = spec->start[i];
    start[count++] = (dal_setting){"e", INFINITY};
    adjoint.start = start;
    adjoint.start_count = count;
    adjoint.options.space = DAL_LIFTED;
    physical.system = tangent;
    physical.options.space = DAL_PHYSICAL;
    physical.start_count = 0;
    dal_status status = dal_run_create(&w->lifted, &adjoint, error);
    if (status == DAL_STATUS_OK) status = dal_run_create(&w->tangent, &physical, error);
    free(start);
    return status;
}

dal_status dal_adjoint_pairing(const dal_run_spec *spec, const dal_system *tangent,
                               const double *direction, long long steps, dal_statistics *statistics,
                               dal_error *error)
{
    DAL_REQUIRE(tangent, error);
    DAL_REQUIRE(direction, error);
    DAL_REQUIRE(statistics, error);
    DAL_REQUIRE_COUNT(steps, error);
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(dal__refuse_events(spec->system, "adjoint pairings", error));
    if (tangent->n != 2 * spec->system->n)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "a tangent system of %d coordinates for a system of %d", tangent->n,
                         spec->system->n);
    pairing w = {.n = spec->system->n};
    dal_status status = open_pairing(&w, spec, tangent, error);
    if (status == DAL_STATUS_OK) status = start_tangent(&w, direction, error);
    if (status == DAL_STATUS_OK) status = add_pairings(&w, steps, statistics, error);
    dal_run_free(w.lifted);
    dal_run_free(w.tangent);
    return status;
}
