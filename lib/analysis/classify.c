/* classify.c - size and trend of all observables of a run.
 *
 * E = L_v.v - L changes at the rate v.Q + sum_a h_a v.A_a - L_t, which may vanish on every level of
 * D, on D = 0 alone, or not at all; off p = pi = 0 the lift adds the force pi/e, which does work.
 * H changes at the rate pi.F_t, and nothing conserves reactions.  A quantity that the motion need
 * not conserve has no drift that is due to the method. */
#include "core/words.h"
#include "dalembert_program.h"
#include "dalembert_statistics.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Roundings of a start that was projected to D = 0, in units of the scale of D. */
static const double start_roundings = 4096 * DBL_EPSILON;

/* Places among the observables of a run; -1: it has none. */
typedef struct places {
    int constraints, energy, hamiltonian, pi;
} places;

/* The largest |pi| of a run; 0 where there is none. */
static double max_pi(const places *at, const dal_trend *trend)
{
    return at->pi >= 0 ? trend[at->pi].max_abs : 0.0;
}

static dal_conservation conservation_of_energy(const dal_run *run, const places *at,
                                               const dal_trend *trend)
{
    const dal_system *s = dal_run_system(run);
    if (!(s->properties & (DAL_E_EXACT | DAL_E_ON_D))) return DAL_NOT_CONSERVED;
    if (max_pi(at, trend) > 0.0 && isfinite(dal_run_state(run)[2 * s->n])) return DAL_MOVED_BY_PI;
    if (s->properties & DAL_E_EXACT) return DAL_CONSERVED;
    for (int a = 0; a < at->constraints; a++)
        if (trend[a].size == DAL_SIZE_LARGER ||
            !(fabs(trend[a].first) <= start_roundings * trend[a].scale))
            return DAL_OFF_SURFACE;
    return DAL_CONSERVED;
}

const char *dal_conservation_text(dal_conservation conservation)
{
    DAL__RETURN_WORD(DAL_CONSERVATION_LIST, DAL__SECOND, conservation, "?");
}

static places find_places(const dal_run *run)
{
    places at = {.energy = -1, .hamiltonian = -1, .pi = -1};
    int number;
    for (int i = 0; i < dal_run_observables(run); i++) {
        const dal__observable_kind kind = dal__run_observable_kind(run, i, &number);
        if (kind == DAL__OBSERVE_D) at.constraints++;
        if (kind == DAL__OBSERVE_E) at.energy = i;
        if (kind == DAL__OBSERVE_LIFT && number == 0) at.hamiltonian = i, at.pi = i + 2;
    }
    return at;
}

void dal_run_classify(dal_run *run, const dal_statistics *statistics, dal_status status,
                      dal_trend *trend)
{
    if (!run || !statistics || !trend) return;
    const int count = dal_run_observables(run);
    const places at = find_places(run);
    bool has_scales = false;
    for (int i = 0; i < count; i++) has_scales = has_scales || statistics[i].scale > 0.0;
    const double *present = has_scales ? NULL : dal_run_scales(run);
    for (int i = 0; i < count; i++) {
        int number;
        const dal__observable_kind kind = dal__run_observable_kind(run, i, &number);
        const bool is_norm = kind == DAL__OBSERVE_LIFT && i != at.hamiltonian;
        const double scale = is_norm   ? dal_statistics_max_abs(&statistics[i])
                             : present ? present[i]
                                       : statistics[i].scale;
        dal_statistics_classify(&statistics[i], scale, status, &trend[i]);
        if (kind == DAL__OBSERVE_REACTIONS || kind == DAL__OBSERVE_MULTIPLIERS)
            trend[i].conservation = DAL_NOT_CONSERVED;
    }
    if (at.energy >= 0) trend[at.energy].conservation = conservation_of_energy(run, &at, trend);
    if (max_pi(&at, trend) > 0.0 && !(dal_run_system(run)->properties & DAL_AUTONOMOUS))
        trend[at.hamiltonian].conservation = DAL_NOT_CONSERVED;
}
