/* reversal.c - reversals of a motion, and whether they map it to itself.
 *
 * A reversal R: q_i -> s_i (q_i - c_i) + c_i, v_i -> -s_i v_i with signs s_i turns the motion of F
 * round if F_i(R x) = s_i F_i(x); c_i is 0, a multiple of pi where F has the period 2 pi in q_i, or
 * anything where F does not depend on q_i.  A motion that meets the fixed set of R,
 *
 *     v_i = 0 where s_i = 1,     q_i = c_i where s_i = -1,
 *
 * is mapped to itself.  If also R S_h R = S_(-h) = S_h^-1 of a step, S_h R S_h = R, the local
 * changes of an I with I(R x) = I(x) at x and at the state that R S_h maps x to are opposite, and
 * their means along the motion for t > 0 and t < 0 are opposite, too (Hairer, Lubich, Wanner 2006,
 * XI).  Motion that comes back has one mean, and it is 0; of motion that goes away for ever, as
 * bodies that fall, neither need be (predict_steps.c).  The meeting is a root in t, found to MEETS;
 * F, I and the step are compared at points of the motion. */
#include "dynamics/reversal.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/pi.h"
#include "core/vectors.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COORDINATES = 8, MAX_KNOWN = 32, TRIALS = 8, POINTS = 4 };
/* Of a meeting in units; of F and I relative to their sizes; of two steps, in roundings. */
static const double meets = 1e-10, agrees = 1e-10, roundings = 1e3, away = 0.3;

/* How F depends on a coordinate. */
typedef enum dependence { GENERAL, PERIODIC, CYCLIC } dependence;

struct dal__reversals {
    dal__local *local;
    dal_run *run;        /* of the method */
    dependence *depends; /* [n] */
    int n, known;        /* reversals of F, */
    unsigned *sign;      /* [known] bit i: s_i = -1 */
    bool *refused;       /* [known] by the method */
    bool *same;          /* [count] */
    double *centre;      /* [n] c of one reversal */
    double *scratch;     /* [16 n + 4 count] */
};

void dal__reversals_free(dal__reversals *r)
{
    if (!r) return;
    dal_run_free(r->run);
    free(r->depends);
    free(r->sign);
    free(r->refused);
    free(r->same);
    free(r->scratch);
    free(r);
}

static bool is_turned(unsigned sign, int i) { return sign >> i & 1; }

bool dal__reversals_depend(const dal__reversals *r, int i) { return r->depends[i] == GENERAL; }

/* R x for the centres of r. */
static void apply_reversal(const dal__reversals *r, unsigned sign, const double *x, double *out)
{
    for (int i = 0; i < r->n; i++) {
        const bool turned = is_turned(sign, i);
        out[i] = turned ? 2.0 * r->centre[i] - x[i] : x[i];
        out[r->n + i] = turned ? x[r->n + i] : -x[r->n + i];
    }
}

static double unit_of(const dal__reversals *r, int i) { return r->local->unit[1 + i]; }

static dal_status field(const dal__reversals *r, double t, const double *x, double *F)
{
    return dal_evaluator_call(r->local->evaluator, r->local->system->call.field, t, x, x + r->n,
                              NULL, F);
}

/* max_i |a_i - s_i b_i| over max |a_i| in units, with signs where is_reversed. */
static double difference(const dal__reversals *r, const double *a, const double *b, unsigned sign)
{
    double max = 0.0, size = 0.0;
    for (int i = 0; i < r->n; i++) {
        const double unit = unit_of(r, r->n + i) / r->local->unit[0];
        const double s = is_turned(sign, i) ? -1.0 : 1.0;
        max = fmax(max, fabs(a[i] - s * b[i]) / unit);
        size = fmax(size, fabs(a[i]) / unit);
    }
    return max / fmax(size, 1.0);
}

/* How F depends on q_i, by points about x. */
static dependence find_dependence(dal__reversals *r, int i, double t, const double *x)
{
    double *at = r->scratch, *F = at + 2 * r->n, *other = F + r->n;
    dal__random random = {7};
    bool is_cyclic = true, is_periodic = true;
    for (int k = 0; k < POINTS; k++) {
        for (int j = 0; j < 2 * r->n; j++)
            at[j] = x[j] + away * unit_of(r, j) * dal__uniform(&random);
        if (field(r, t, at, F) != DAL_STATUS_OK) return GENERAL;
        const double q = at[i];
        at[i] = q + unit_of(r, i) * dal__uniform(&random);
        is_cyclic &=
            field(r, t, at, other) == DAL_STATUS_OK && difference(r, F, other, 0) <= agrees;
        at[i] = q + 2.0 * DAL__PI;
        is_periodic &=
            field(r, t, at, other) == DAL_STATUS_OK && difference(r, F, other, 0) <= agrees;
    }
    return is_cyclic ? CYCLIC : is_periodic ? PERIODIC : GENERAL;
}

/* Whether R turns F round at points about x. */
static bool reverses_field(dal__reversals *r, unsigned sign, double t, const double *x)
{
    double *at = r->scratch, *F = at + 2 * r->n, *turned = F + r->n, *other = turned + 2 * r->n;
    dal__random random = {11};
    for (int k = 0; k < POINTS; k++) {
        for (int j = 0; j < 2 * r->n; j++)
            at[j] = x[j] + away * unit_of(r, j) * dal__uniform(&random);
        apply_reversal(r, sign, at, turned);
        if (field(r, t, at, F) != DAL_STATUS_OK) return false;
        if (field(r, t, turned, other) != DAL_STATUS_OK) return false;
        if (!(difference(r, F, other, sign) <= agrees)) return false;
    }
    return true;
}

dal_status dal__reversals_create(dal__reversals **made, dal__local *local, const dal_run_spec *spec,
                                 double t, const double *x, dal_error *error)
{
    const size_t n = (size_t)local->n;
    *made = NULL;
    if (n > MAX_COORDINATES || !(local->system->properties & DAL_AUTONOMOUS) ||
        !(dal_method_properties(&spec->method) & DAL_SYMMETRIC))
        return DAL_STATUS_OK;
    dal__reversals *r = calloc(1, sizeof *r);
    if (!r) return dal__memory_error(error);
    *r = (dal__reversals){.local = local, .n = local->n};
    r->depends = calloc(n, sizeof *r->depends);
    r->sign = calloc(MAX_KNOWN, sizeof *r->sign);
    r->refused = calloc(MAX_KNOWN, sizeof *r->refused);
    r->same = calloc((size_t)local->count + 1, sizeof *r->same);
    r->scratch = dal__numbers(1, 17 * n + 4 * (size_t)local->count);
    dal_status status = r->depends && r->sign && r->refused && r->same && r->scratch
                            ? dal_run_create(&r->run, spec, error)
                            : dal__memory_error(error);
    if (status != DAL_STATUS_OK) {
        dal__reversals_free(r);
        return status;
    }
    r->centre = r->scratch + 16 * n + 4 * (size_t)local->count;
    for (int i = 0; i < r->n; i++) r->depends[i] = find_dependence(r, i, t, x);
    for (unsigned sign = 0; sign < 1u << r->n && r->known < MAX_KNOWN; sign++)
        if (reverses_field(r, sign, t, x)) r->sign[r->known++] = sign;
    *made = r;
    return DAL_STATUS_OK;
}

/* ---- the fixed set ---- */

/* How far x is from the fixed set, w[n] in units, and the rate of that for F, rate[n]. */
static void find_distances(const dal__reversals *r, unsigned sign, const double *x, const double *F,
                           double *w, double *rate)
{
    const int n = r->n;
    for (int i = 0; i < n; i++) {
        w[i] = rate[i] = 0.0;
        if (!is_turned(sign, i)) {
            w[i] = x[n + i] / unit_of(r, n + i);
            rate[i] = F[i] / unit_of(r, n + i);
        } else if (r->depends[i] == GENERAL) {
            w[i] = x[i] / unit_of(r, i);
            rate[i] = x[n + i] / unit_of(r, i);
        } else if (r->depends[i] == PERIODIC) {
            w[i] = sin(x[i]);
            rate[i] = cos(x[i]) * x[n + i];
        }
    }
}

/* Goes to the fixed set by Gauss-Newton in t from a state x near it, as far as a step; false: the
 * motion does not meet it there. */
static bool find_meeting(dal__reversals *r, unsigned sign, dal__orbit *orbit, long long k, double t,
                         double *x)
{
    const int n = r->n;
    double *F = r->scratch + 2 * n, *w = F + n, *rate = w + n, fraction = 0.0;
    for (int trial = 0; trial < TRIALS; trial++) {
        if (field(r, t + fraction * r->local->step, x, F) != DAL_STATUS_OK) return false;
        find_distances(r, sign, x, F, w, rate);
        if (dal__max_abs(w, (size_t)n) <= meets) return true;
        const double square = dal__dot_product(n, rate, rate);
        fraction -= dal__dot_product(n, w, rate) / (square * r->local->step);
        if (!(fraction >= 0.0 && fraction <= 1.0)) return false;
        if (dal__orbit_state(orbit, k, fraction, x, NULL) != DAL_STATUS_OK) return false;
    }
    return false;
}

/* Whether the step S of the method has R S R S = 1 at x, to rounding. */
static bool preserves_reversal(dal__reversals *r, unsigned sign, double t, const double *x)
{
    const int n = r->n;
    double *turned = r->scratch + 4 * n, *back = turned + 2 * n;
    if (dal_run_set_state(r->run, t, x, NULL) != DAL_STATUS_OK) return false;
    if (dal_run_step(r->run, NULL) != DAL_STATUS_OK) return false;
    apply_reversal(r, sign, dal_run_state(r->run), turned);
    if (dal_run_set_state(r->run, t, turned, NULL) != DAL_STATUS_OK) return false;
    if (dal_run_step(r->run, NULL) != DAL_STATUS_OK) return false;
    apply_reversal(r, sign, dal_run_state(r->run), back);
    for (int i = 0; i < 2 * n; i++) {
        const double size = fmax(fabs(x[i]), unit_of(r, i));
        if (!(fabs(back[i] - x[i]) <= roundings * DBL_EPSILON * size)) return false;
    }
    return true;
}

/* Compares step and observables at four states about one on the fixed set. */
static void try_reversal(dal__reversals *r, int which, dal__orbit *orbit, long long k, double t,
                         const double *meeting, bool *even)
{
    const unsigned sign = r->sign[which];
    const int n = r->n, count = r->local->count;
    double *x = r->scratch + 8 * n, *turned = x + 2 * n, *a = turned + 2 * n, *b = a + count;
    double *scale = b + count;
    for (int i = 0; i < n; i++) {
        const bool moves = is_turned(sign, i) && r->depends[i] != GENERAL;
        r->centre[i] = !moves                    ? 0.0
                       : r->depends[i] == CYCLIC ? meeting[i]
                                                 : DAL__PI * nearbyint(meeting[i] / DAL__PI);
    }
    for (int i = 0; i < count; i++) r->same[i] = true;
    for (int p = 0; p < POINTS && !r->refused[which]; p++) {
        const double fraction = (double)p / (double)(POINTS - 1),
                     at = t + fraction * r->local->step;
        r->refused[which] = dal__orbit_state(orbit, k, fraction, x, NULL) != DAL_STATUS_OK ||
                            !preserves_reversal(r, sign, at, x);
        apply_reversal(r, sign, x, turned);
        const bool is_known = dal__local_observe(r->local, at, x, a) == DAL_STATUS_OK &&
                              dal__local_observe(r->local, at, turned, b) == DAL_STATUS_OK &&
                              dal__local_scales(r->local, at, x, scale) == DAL_STATUS_OK;
        for (int i = 0; i < count; i++)
            r->same[i] = r->same[i] && is_known && fabs(a[i] - b[i]) <= agrees * scale[i];
    }
    for (int i = 0; i < count && !r->refused[which]; i++) even[i] |= r->same[i];
}

bool dal__reversals_meet(dal__reversals *r, dal__orbit *orbit, long long k, double t,
                         const double *x, bool *even)
{
    const int n = r->n;
    double *at = r->scratch, *F = at + 2 * n, *w = F + n, *rate = w + n;
    bool is_done = true;
    for (int i = r->local->m; i < r->local->count; i++) is_done &= even[i];
    for (int which = 0; which < r->known && !is_done; which++) {
        if (r->refused[which] || field(r, t, x, F) != DAL_STATUS_OK) continue;
        find_distances(r, r->sign[which], x, F, w, rate);
        bool is_near = true;
        for (int i = 0; i < n; i++)
            is_near &= fabs(w[i]) <= 2.0 * fabs(r->local->step * rate[i]) + 1e2 * meets;
        if (!is_near) continue;
        memcpy(at, x, 2 * (size_t)n * sizeof *at);
        if (find_meeting(r, r->sign[which], orbit, k, t, at))
            try_reversal(r, which, orbit, k, t, at, even);
    }
    return is_done;
}
