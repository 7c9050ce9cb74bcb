/* quad.c - a run in quad precision: an engine of the variant x1_QUAD that a run in double holds.
 *
 * The run in double makes the start, explains failures and shows the state; after every step it
 * receives time, state and all other persistent state rounded.  The engine computes observables in
 * quad precision and rounds them then, so that a D of 1e-30 shows as such.  dal__layout_init
 * ensures that system and method exist in quad precision. */
#define DAL_NUM_QUAD
#include "run/quad.h"
#include <dalembert_kernel.h>

enum { MORE_ITERATIONS = 3 }; /* for more digits */

static const dal__engine_kind *kind(void) { return &dal__engine_kinds[DAL__VARIANT_x1_QUAD]; }

size_t dal__quad_width(void) { return sizeof(num) / sizeof(double); }

/* ---- memory ---- */

static dal__layout layout_of(const dal__layout *k)
{
    dal__layout quad = *k;
    quad.system = k->system->quad;
    quad.options.iterations *= MORE_ITERATIONS;
    return quad;
}

size_t dal__quad_bytes(const dal__layout *k)
{
    const dal__layout quad = layout_of(k);
    return dal__align(kind()->engine->bytes(&quad));
}

void dal__quad_place(dal__quad_run *run, const dal__layout *layout, char *memory)
{
    run->layout = layout_of(layout);
    run->engine = kind()->engine->place(&run->layout, memory, &run->persistent, &run->work, NULL);
}

/* ---- to and from double ---- */

double dal__quad_rounded(const double *memory, size_t i)
{
    num x;
    memcpy(&x, memory + i * dal__quad_width(), sizeof x);
    return (double)x;
}

void dal__quad_push(const dal__quad_run *run, const double *persistent, size_t first)
{
    num *to = (num *)(void *)run->persistent;
    for (size_t i = first; i < dal__saved_count(&run->layout); i++) to[i] = persistent[i];
}

void dal__quad_set(const dal__quad_run *run, const double *persistent, size_t i)
{
    ((num *)(void *)run->persistent)[i] = persistent[i];
}

void dal__quad_pull(const dal__quad_run *run, double *persistent)
{
    for (size_t i = 0; i < dal__saved_count(&run->layout); i++)
        persistent[i] = dal__quad_rounded(run->persistent, i);
}

/* ---- the engine ---- */

dal_status dal__quad_prepare(const dal__quad_run *run, double t)
{
    const dal_system *system = run->layout.system;
    const size_t at_v = (size_t)run->layout.n * dal__quad_width();
    const dal_point at = {
        .t = t, .q = run->persistent, .v = run->persistent + at_v, .work = run->work};
    return system->prepare ? system->prepare(system, &at, NULL) : DAL_STATUS_OK;
}

void dal__quad_hold(const dal__quad_run *run, const double *point)
{
    kind()->engine->hold(run->engine, point);
}

dal_status dal__quad_step(const dal__quad_run *run, double h)
{
    dal_status reason = DAL_STATUS_OK;
    return kind()->engine->step(run->engine, h, 1u, &reason) ? reason : DAL_STATUS_OK;
}

dal_status dal__quad_step_intermediate(const dal__quad_run *run, double h, double size)
{
    dal_status reason = DAL_STATUS_OK;
    return kind()->engine->step_intermediate(run->engine, h, size, &reason) ? reason
                                                                            : DAL_STATUS_OK;
}

dal_status dal__quad_observe(const dal__quad_run *run, bool exact_known, double *out)
{
    return kind()->engine->observe(run->engine, exact_known, out);
}

/* Writes D, E and the invariants; *count of them. */
static dal_status conserved_values(const dal__quad_run *run, num *out, int *count)
{
    const dal_system *s = run->layout.system;
    const num *y = (const num *)(const void *)run->persistent;
    const dal_point at = {.t = (double)y[dal__at(&run->layout, DAL__TIME)],
                          .q = (const double *)(const void *)y,
                          .v = (const double *)(const void *)(y + run->layout.n),
                          .work = run->work};
    dal_callback *const formulas[] = {s->constraints, s->energy, s->invariant_values};
    const int counts[] = {s->m, 1, s->invariants};
    *count = 0;
    for (int i = 0; i < 3; i++) {
        if (!formulas[i] || counts[i] == 0) continue;
        DAL_TRY(formulas[i](s, &at, (double *)(void *)(out + *count)));
        *count += counts[i];
    }
    return DAL_STATUS_OK;
}

dal_status dal__quad_change(const dal__quad_run *run, double h, double *memory, double *out)
{
    num *before = (num *)(void *)memory;
    int count = 0;
    DAL_TRY(conserved_values(run, before, &count));
    num *after = before + count;
    DAL_TRY(dal__quad_step(run, h));
    DAL_TRY(conserved_values(run, after, &count));
    for (int i = 0; i < count; i++) out[i] = (double)(after[i] - before[i]);
    return DAL_STATUS_OK;
}
