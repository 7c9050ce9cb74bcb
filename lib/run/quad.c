/* quad.c - a run in quad precision: an engine of the variant x1_QUAD behind a run in double.
 *
 * The run in double makes the start, explains failures and shows the state; after every step it
 * receives time, state and all other persistent state rounded.  Observables are computed in quad
 * precision and then rounded, so that a D of 1e-30 shows as such.  dal__layout_init ensures that
 * system and method exist in quad precision. */
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

size_t dal__quad_bytes(const dal__layout *k, size_t outputs)
{
    const dal__layout quad = layout_of(k);
    return dal__align(kind()->engine->bytes(&quad)) + dal__align(outputs * sizeof(num));
}

void dal__quad_place(dal_run *run, char *memory, size_t outputs)
{
    dal__quad_run *k = &run->quad;
    k->layout = layout_of(&run->layout);
    k->scratch = (double *)(void *)memory;
    memory += dal__align(outputs * sizeof(num));
    k->engine = kind()->engine->place(&k->layout, memory, &k->persistent, &k->work);
    run->storage = k->persistent;
}

/* ---- to and from double ---- */

static void widen(double *to, const double *from, size_t count)
{
    num *x = (num *)(void *)to;
    for (size_t i = 0; i < count; i++) x[i] = from[i];
}

static void round_all(double *to, const double *from, size_t count)
{
    const num *x = (const num *)(const void *)from;
    for (size_t i = 0; i < count; i++) to[i] = (double)x[i];
}

double dal__quad_rounded(const double *memory, size_t i)
{
    num x;
    memcpy(&x, memory + i * dal__quad_width(), sizeof x);
    return (double)x;
}

void dal__quad_push(dal_run *run)
{
    widen(run->quad.persistent, run->persistent, run->layout.persistent);
}

void dal__quad_pull(dal_run *run)
{
    round_all(run->persistent, run->quad.persistent, run->layout.persistent);
}

static dal_point here(const dal_run *run)
{
    const dal__quad_run *k = &run->quad;
    const size_t at_v = (size_t)run->layout.n * dal__quad_width();
    return (dal_point){dal_run_time(run), k->persistent, k->persistent + at_v, NULL, k->work};
}

dal_status dal__quad_begin(dal_run *run)
{
    const dal__quad_run *k = &run->quad;
    const dal_system *system = k->layout.system;
    widen(k->work, run->work, (size_t)system->parameters);
    dal__quad_push(run);
    const dal_point at = here(run);
    return system->prepare ? system->prepare(system, &at, NULL) : DAL_OK;
}

dal_status dal__quad_step(dal_run *run, double h)
{
    dal_status reason = DAL_OK;
    return kind()->engine->step(run->quad.engine, h, 1u, &reason) ? reason : DAL_OK;
}

/* ---- observables, in the order of observe.c ---- */

/* Appends the count values of a callback to *out; nothing without the callback. */
static dal_status append(const dal_run *run, dal_callback *callback, int count, double **out)
{
    const dal__quad_run *k = &run->quad;
    const dal_point at = here(run);
    if (!callback) return DAL_OK;
    DAL_TRY(callback(k->layout.system, &at, k->scratch));
    round_all(*out, k->scratch, (size_t)count);
    *out += count;
    return DAL_OK;
}

/* H = pi.pi/(2e) + pi.F + p.v + mu_e pi_e, and the norms of p, pi, pi_e. */
static dal_status append_lifted(const dal_run *run, double **out)
{
    const int n = run->layout.n;
    const dal__quad_run *k = &run->quad;
    const num *y = (const num *)(const void *)k->persistent, *v = y + n, *p = y + 2 * n + 1;
    const num *pi = y + 3 * n + 1, *f = (const num *)(const void *)k->scratch;
    const dal_callbacks *call = &k->layout.system->call;
    const dal_point at = here(run);
    num sum = 0.0;
    if (call->gauge) {
        DAL_TRY(call->gauge(k->layout.system, &at, k->scratch));
        sum = f[0] * y[4 * n + 1];
    }
    DAL_TRY(call->field(k->layout.system, &at, k->scratch));
    for (int i = 0; i < n; i++)
        sum += pi[i] * pi[i] * (0.5 / y[2 * n]) + pi[i] * f[i] + p[i] * v[i];
    *(*out)++ = (double)sum;
    *(*out)++ = (double)dal_max_norm(p, n);
    *(*out)++ = (double)dal_max_norm(pi, n);
    *(*out)++ = (double)dal_abs(y[4 * n + 1]);
    return DAL_OK;
}

static dal_status append_error(const dal_run *run, double **out)
{
    const dal__quad_run *k = &run->quad;
    const dal_point at = here(run);
    const num *y = (const num *)(const void *)k->persistent;
    num *exact = (num *)(void *)k->scratch;
    DAL_TRY(k->layout.system->exact(k->layout.system, &at, k->scratch));
    for (int i = 0; i < run->layout.n; i++) exact[i] -= y[i];
    *(*out)++ = (double)dal_max_norm(exact, run->layout.n);
    return DAL_OK;
}

dal_status dal__quad_observe(dal_run *run, double *out)
{
    const dal_system *system = run->quad.layout.system;
    double *next = out;
    DAL_TRY(append(run, system->constraints, system->m, &next));
    DAL_TRY(append(run, system->energy, 1, &next));
    if (run->layout.lifted) DAL_TRY(append_lifted(run, &next));
    DAL_TRY(append(run, system->invariant_values, system->invariants, &next));
    if (run->exact) DAL_TRY(append_error(run, &next));
    for (double *x = out; x < next; x++) *x += 0.0; /* no -0 */
    return DAL_OK;
}
