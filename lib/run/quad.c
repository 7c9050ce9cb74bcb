/* quad.c - a run in quad precision: an engine of the variant x1_QUAD behind a run in double.
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

dal_status dal__quad_check(const dal__layout *k, dal_error *error)
{
    if (DAL_QUAD_DIGITS < 113)
        return dal__fail(error, DAL_UNSUPPORTED,
                         "quad precision: this machine has no type of 113 binary digits");
    if (!k->system->quad)
        return dal__fail(error, DAL_UNSUPPORTED,
                         "quad precision: %.80s has no form in it, not being made from a model",
                         k->system->name ? k->system->name : "this system");
    for (int i = 0; i < k->depth; i++)
        if (!dal__integrator_wide(k->method.layer[i], DAL__VARIANT_x1_QUAD))
            return dal__fail(error, DAL_UNSUPPORTED,
                             "quad precision: '%.80s' has no form in it, not being the library's",
                             k->method.layer[i]->name ? k->method.layer[i]->name : "?");
    return DAL_OK;
}

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

void dal__quad_place(dal_run *run, char *memory)
{
    dal__quad_run *k = &run->quad;
    k->layout = layout_of(&run->layout);
    k->engine = kind()->engine->place(&k->layout, memory, &k->persistent, &k->work, NULL);
    run->storage = k->persistent;
}

/* ---- to and from double ---- */

double dal__quad_rounded(const double *memory, size_t i)
{
    num x;
    memcpy(&x, memory + i * dal__quad_width(), sizeof x);
    return (double)x;
}

void dal__quad_push(dal_run *run, size_t first)
{
    num *to = (num *)(void *)run->quad.persistent;
    for (size_t i = first; i < dal__saved_count(&run->layout); i++) to[i] = run->persistent[i];
}

void dal__quad_set(dal_run *run, size_t i)
{
    ((num *)(void *)run->quad.persistent)[i] = run->persistent[i];
}

void dal__quad_pull(dal_run *run)
{
    for (size_t i = 0; i < dal__saved_count(&run->layout); i++)
        run->persistent[i] = dal__quad_rounded(run->quad.persistent, i);
}

dal_status dal__quad_prepare(dal_run *run)
{
    const dal__quad_run *k = &run->quad;
    const dal_system *system = k->layout.system;
    const size_t at_v = (size_t)run->layout.n * dal__quad_width();
    const dal_point at = {
        .t = dal_run_time(run), .q = k->persistent, .v = k->persistent + at_v, .work = k->work};
    return system->prepare ? system->prepare(system, &at, NULL) : DAL_OK;
}

void dal__quad_hold(dal_run *run, const double *point)
{
    kind()->engine->hold(run->quad.engine, point);
}

dal_status dal__quad_step(dal_run *run, double h)
{
    dal_status reason = DAL_OK;
    return kind()->engine->step(run->quad.engine, h, 1u, &reason) ? reason : DAL_OK;
}

dal_status dal__quad_step_part(dal_run *run, double h, double part)
{
    dal_status reason = DAL_OK;
    return kind()->engine->step_part(run->quad.engine, h, part, &reason) ? reason : DAL_OK;
}

dal_status dal__quad_observe(dal_run *run, double *out)
{
    return kind()->engine->observe(run->quad.engine, run->exact, out);
}
