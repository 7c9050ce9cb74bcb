/* scales.c - the sizes of the terms that observables are made of, S(f) of expr/terms.c.
 *
 * A system made of formulas has S of D, E, invariants and reactions.  What a system written in C
 * gives instead is the largest that its callbacks show:
 *
 *     D_a   sum_i |A_ai v_i| + |D_a|              E    sum |E_q q| + sum |E_v v| + |E|
 *     I     |I|                                   h_a  |h_a|,   R_i   sum_a |B_ai h_a|
 *     g_j   sum_i |g_q q| + |g_j|
 *
 * H is the sum of pi_i (K pi)_i/(2e), pi_i F_i and p_i v_i, of which the largest counts; it is 0,
 * and H exactly 0, where p = pi = 0. */
#include "run/scales.h"
#include <math.h>
#include <string.h>

/* Where a run keeps its scales: the results [observables]; the scales of D, E, invariants, g; of h,
 * R; of H and the norms of the lift [4]; a state [dimension]; F, the exact solution or K pi; memory
 * of the system. */
typedef struct places {
    double *out, *formulas, *reactions, *lift, *state, *vector, *memory;
} places;

enum { POINTS = 32 }; /* between these and half as many, at equal distances */

static size_t take(size_t *used, size_t count)
{
    const size_t at = *used;
    *used += count;
    return at;
}

/* Places from `memory` on, or none where that is NULL; how many numbers they are. */
static size_t lay_out(const dal__layout *k, double *memory, places *p)
{
    const dal_system *s = k->system;
    size_t used = 0;
    const size_t at[] = {take(&used, (size_t)dal__max_observables(k)),
                         take(&used, (size_t)(s->m + 1 + s->invariants + s->holonomic)),
                         take(&used, (size_t)(s->m + s->n)),
                         take(&used, 4),
                         take(&used, (size_t)k->dim),
                         take(&used, (size_t)(3 * s->n + s->multipliers)),
                         take(&used, s->scale_memory)};
    if (p)
        *p = (places){memory + at[0], memory + at[1], memory + at[2], memory + at[3],
                      memory + at[4], memory + at[5], memory + at[6]};
    return used;
}

size_t dal__scale_numbers(const dal__layout *k) { return lay_out(k, NULL, NULL); }

/* They are due at multiples of the least power of 2 of which at most POINTS reach that far. */
long long dal__scales_due(long long observations)
{
    long long distance = 1;
    while (observations >= POINTS * distance) distance *= 2;
    return (observations / distance + 1) * distance;
}

static double sum_of_products(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += fabs(a[i] * b[i]);
    return sum;
}

/* ---- systems without scales ---- */

static dal_status estimate_formulas(const dal_run *run, const dal_point *at, double *out)
{
    const dal_system *s = run->layout.system;
    const double *const block = run->scratch; /* D, A; then E, E_q, E_v */
    if (s->constraints && !s->call.constraint) DAL_TRY(s->constraints(s, at, out));
    if (s->constraints && s->call.constraint) {
        DAL_TRY(s->call.constraint(s, at, run->scratch));
        for (int a = 0; a < s->m; a++)
            out[a] = fabs(block[a]) + sum_of_products(s->n, block + s->m + a * s->n, at->v);
    }
    if (s->energy && !s->call.energy_normal) DAL_TRY(s->energy(s, at, out + s->m));
    if (s->energy && s->call.energy_normal) {
        DAL_TRY(s->call.energy_normal(s, at, run->scratch));
        out[s->m] = fabs(block[0]) + sum_of_products(s->n, block + 1, at->q) +
                    sum_of_products(s->n, block + 1 + s->n, at->v);
    }
    if (s->invariant_values) DAL_TRY(s->invariant_values(s, at, out + s->m + 1));
    if (s->holonomic == 0) return DAL_STATUS_OK;
    double *const g = out + s->m + 1 + s->invariants;
    DAL_TRY(s->call.holonomic(s, at, g));
    DAL_TRY(s->call.constraint(s, at, run->scratch));
    for (int j = 0; j < s->holonomic; j++)
        g[j] = fabs(g[j]) +
               sum_of_products(s->n, block + s->m + (s->m - s->holonomic + j) * s->n, at->q);
    return DAL_STATUS_OK;
}

static dal_status estimate_reactions(const dal_run *run, const dal_point *at, double *out)
{
    const dal_system *s = run->layout.system;
    const double *h = run->scratch, *B = h + s->m;
    DAL_TRY(s->reactions(s, at, run->scratch));
    for (int a = 0; a < s->m; a++) out[a] = h[a];
    for (int i = 0; i < s->n; i++) {
        out[s->m + i] = 0.0;
        for (int a = 0; a < s->m; a++) out[s->m + i] += fabs(B[a * s->n + i] * h[a]);
    }
    return DAL_STATUS_OK;
}

/* ---- one kind of observables ---- */

/* H, |p|, |pi|, |pi_e|, out[4]; vector[3n] is scratch. */
static dal_status scale_lift(const dal_run *run, const dal_point *at, double *vector, double *out)
{
    const dal_system *s = run->layout.system;
    const int n = run->layout.n;
    const double *y = at->q, *e = y + 2 * n, *p = e + 1, *pi = p + n, *K_pi = pi;
    dal_point lifted = *at;
    lifted.pi = pi;
    if (s->call.effort) {
        DAL_TRY(s->call.effort(s, &lifted, vector));
        K_pi = vector;
    }
    memset(out, 0, 4 * sizeof *out);
    for (int i = 0; i < n; i++) {
        out[1] = fmax(out[1], fabs(p[i]));
        out[2] = fmax(out[2], fabs(pi[i]));
        out[0] = fmax(out[0], fmax(fabs(p[i] * at->v[i]), 0.5 * fabs(pi[i] * K_pi[i] / *e)));
    }
    out[3] = fabs(y[4 * n + 1]);
    if (out[2] == 0.0) return DAL_STATUS_OK;
    DAL_TRY(s->call.field(s, at, vector));
    for (int i = 0; i < n; i++) out[0] = fmax(out[0], fabs(pi[i] * vector[i]));
    return DAL_STATUS_OK;
}

/* ---- all of them ---- */

/* Where the scales of a kind are, after the scales of the formulas were made. */
static const double *kind_scales(const dal_run *run, const places *p, const dal_point *at,
                                 dal__observable_kind kind, dal_status *status)
{
    const dal_system *s = run->layout.system;
    int largest = 0;
    switch (kind) {
    case DAL__OBSERVE_D:
        return p->formulas;
    case DAL__OBSERVE_E:
        return p->formulas + s->m;
    case DAL__OBSERVE_INVARIANTS:
        return p->formulas + s->m + 1;
    case DAL__OBSERVE_HOLONOMIC:
        return p->formulas + s->m + 1 + s->invariants;
    case DAL__OBSERVE_LIFT:
        *status = scale_lift(run, at, p->vector, p->lift);
        return p->lift;
    case DAL__OBSERVE_ERROR: /* of the coordinate where the error is largest */
        *status = s->exact(s, at, p->vector);
        for (int i = 1; i < s->n && *status == DAL_STATUS_OK; i++)
            if (fabs(p->vector[i] - at->q[i]) > fabs(p->vector[largest] - at->q[largest]))
                largest = i;
        return p->vector + largest;
    default: /* the multipliers of a method are nearly F's */
        return p->reactions;
    }
}

static const double *scales_at(const dal_run *run, const places *p, double t, const double *state,
                               dal_status *status)
{
    const dal_point at = {.t = t, .q = state, .v = state + run->layout.n, .work = run->work};
    double *out = p->out;
    const dal_system *s = run->layout.system;
    *status = s->scales ? s->scales(s, &at, p->memory, p->formulas)
                        : estimate_formulas(run, &at, p->formulas);
    if (*status == DAL_STATUS_OK && run->layout.options.reactions)
        *status = s->reaction_scales ? s->reaction_scales(s, &at, p->memory, p->reactions)
                                     : estimate_reactions(run, &at, p->reactions);
    for (int kind = 0; kind < DAL__OBSERVABLE_KINDS && *status == DAL_STATUS_OK; kind++) {
        const int count = dal__observable_count(&run->layout, kind, run->exact);
        const double *scales = count > 0 ? kind_scales(run, p, &at, kind, status) : NULL;
        for (int i = 0; i < count; i++) *out++ = fabs(scales[i]);
    }
    return *status == DAL_STATUS_OK ? p->out : NULL;
}

const double *dal__scales_observed(dal_run *run, int i, dal_status *status)
{
    const dal__observations *o = &run->observations;
    places p;
    lay_out(&run->layout, run->scales, &p);
    if (!o->states) return scales_at(run, &p, o->times[i], run->persistent, status);
    for (int c = 0; c < run->layout.dim; c++)
        p.state[c] = o->states[(size_t)c * (size_t)o->capacity + (size_t)i];
    return scales_at(run, &p, o->times[i], p.state, status);
}

const double *dal_run_scales(dal_run *run)
{
    dal_status status;
    places p;
    if (!run) return NULL;
    lay_out(&run->layout, run->scales, &p);
    return scales_at(run, &p, dal_run_time(run), run->persistent, &status);
}

const double *dal__constraint_scales(dal_run *run)
{
    const dal_system *s = run->layout.system;
    const dal_point at = dal__here(run);
    places p;
    lay_out(&run->layout, run->scales, &p);
    return s->scales && s->scales(s, &at, p.memory, p.formulas) == DAL_STATUS_OK ? p.formulas
                                                                                 : NULL;
}
