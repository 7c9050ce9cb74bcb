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

/* The halves of a state of the tangent system: at[k] is where the state of the run has the first of
 * n numbers of half k of (q, dq, v, dv) and, after e, of (dp, p, dpi, pi); is_vector, whether they
 * are of the vector. */
typedef struct half {
    int place; /* in the tangent system */
    int at;    /* in a state, or a vector */
    bool is_vector;
} half;

enum { PHYSICAL = 4, LIFTED = 8 };

static void find_halves(int n, half *out)
{
    const int p = 2 * n + 1, pi = 3 * n + 1, P = 4 * n + 1, Pi = 6 * n + 1;
    const half all[LIFTED] = {{0, 0, false},    {n, 0, true},       {2 * n, n, false},
                              {3 * n, n, true}, {P, p, true},       {P + n, p, false},
                              {Pi, pi, true},   {Pi + n, pi, false}};
    memcpy(out, all, sizeof all);
}

void dal__tangent_scatter(int n, dal_space space, const double *state, const double *vector,
                          double *tangent)
{
    half halves[LIFTED];
    find_halves(n, halves);
    for (int k = 0; k < (space == DAL_LIFTED ? LIFTED : PHYSICAL); k++)
        memcpy(tangent + halves[k].place, (halves[k].is_vector ? vector : state) + halves[k].at,
               (size_t)n * sizeof *tangent);
    if (space != DAL_LIFTED) return;
    tangent[4 * n] = state[2 * n];
    tangent[8 * n + 1] = vector[4 * n + 1];
}

void dal__tangent_gather(int n, dal_space space, const double *tangent, double *vector)
{
    half halves[LIFTED];
    find_halves(n, halves);
    for (int k = 0; k < (space == DAL_LIFTED ? LIFTED : PHYSICAL); k++)
        if (halves[k].is_vector)
            memcpy(vector + halves[k].at, tangent + halves[k].place, (size_t)n * sizeof *vector);
    if (space != DAL_LIFTED) return;
    vector[2 * n] = 0.0;
    vector[4 * n + 1] = tangent[8 * n + 1];
}
