/* tangent_map.c - tangent vectors and the steps of a method that move them exactly. */
#include "dynamics/tangent_map.h"
#include <string.h>

const char *dal__tangent_fault(const dal_run_spec *spec, dal_space space)
{
    /* A step that is made of values, or Taylor coefficients, of F alone moves a tangent vector by
     * its own derivative. */
    const unsigned of_field =
        DAL_NEEDS_FIELD | DAL_NEEDS_SERIES | DAL_NEEDS_SYMMETRIC | DAL_NEEDS_ORDER_2;
    const unsigned persistent = DAL_PERSISTENT_MULTIPLIER | DAL_PERSISTENT_ACCELERATION;
    if (spec->options.tolerance > 0.0)
        return "a tolerance divides its step, which is then no smooth map";
    if (spec->options.extend_energy) return "F continued off D = 0 has no tangent system";
    if (dal_method_properties(&spec->method) & persistent)
        return "its steps pass multipliers or accelerations on: they are no map of the state";
    if (dal_method_needs(&spec->method) & ~of_field)
        return "its step uses more of the system than F, and has no exact tangent";
    if (space == DAL_LIFTED && spec->system->call.gauge_gradient)
        return "mu_e of the gauge is not of t alone";
    return NULL;
}

/* The halves of a state of the tangent system, (q, dq, v, dv), then (g, dg) of vakonomic motion or,
 * after e, (dp, p, dpi, pi). */
typedef struct half {
    int place; /* in the tangent system */
    int at;    /* in a state, or a vector */
    int count;
    bool is_vector;
} half;

enum { MAX_HALVES = 8 };

static int find_halves(int n, int multipliers, dal_space space, half *out)
{
    const int m = multipliers, p = 2 * n + 1, pi = 3 * n + 1, P = 4 * n + 1, Pi = 6 * n + 1;
    const half physical[] = {{0, 0, n, false},         {n, 0, n, true},
                             {2 * n, n, n, false},     {3 * n, n, n, true},
                             {4 * n, 2 * n, m, false}, {4 * n + m, 2 * n, m, true}};
    const half momenta[] = {
        {P, p, n, true}, {P + n, p, n, false}, {Pi, pi, n, true}, {Pi + n, pi, n, false}};
    memcpy(out, physical, sizeof physical);
    if (space != DAL_LIFTED) return 6;
    memcpy(out + 4, momenta, sizeof momenta);
    return MAX_HALVES;
}

void dal__tangent_scatter(const dal_system *system, dal_space space, const double *state,
                          const double *vector, double *tangent)
{
    const int n = system->n;
    half halves[MAX_HALVES];
    const int count = find_halves(n, system->multipliers, space, halves);
    for (int k = 0; k < count; k++)
        memcpy(tangent + halves[k].place, (halves[k].is_vector ? vector : state) + halves[k].at,
               (size_t)halves[k].count * sizeof *tangent);
    if (space != DAL_LIFTED) return;
    tangent[4 * n] = state[2 * n];
    tangent[8 * n + 1] = vector[4 * n + 1];
}

void dal__tangent_gather(const dal_system *system, dal_space space, const double *tangent,
                         double *vector)
{
    const int n = system->n;
    half halves[MAX_HALVES];
    const int count = find_halves(n, system->multipliers, space, halves);
    for (int k = 0; k < count; k++)
        if (halves[k].is_vector)
            memcpy(vector + halves[k].at, tangent + halves[k].place,
                   (size_t)halves[k].count * sizeof *vector);
    if (space != DAL_LIFTED) return;
    vector[2 * n] = 0.0;
    vector[4 * n + 1] = tangent[8 * n + 1];
}
