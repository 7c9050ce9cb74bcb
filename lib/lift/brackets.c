/* brackets.c - Poisson brackets of functions, by differences. */
#include "analysis/differences.h"
#include "dalembert_action.h"
#include <math.h>
#include <stddef.h>

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
