/* theory.c - the Hamiltonian and the primary constraints of the first-order actions.
 *
 *     (nh11)      L_1 = e/2 |v' - F|^2 + lambda.(q' - v)      pi = e (v' - F): v' = F + K pi/e
 *                 H_0 = pi.K pi/(2e) + pi.F + lambda.v        pi_e, pi_lambda, p - lambda = 0
 *     vakonomic   L_1 = L - g.D + lambda.(q' - v)
 *                 H_0 = lambda.v - L + g.D                    pi, pi_lambda, pi_g, p - lambda = 0
 *
 * K is the effort's: for K = 1 the action is the paper's. */
#include "lift/theory.h"
#include "codegen/typeset.h"
#include "core/buffer.h"
#include "core/error.h"
#include "expr/simplify.h"
#include "invariants/region.h"
#include "model/motion.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far from the start points are drawn, in units of the motion; of e and momenta. */
static const double neighbourhood = 0.5, of_e = 0.25;

void dal__theory_allocate(dal__theory *w, dal__pool *pool)
{
    const size_t symbols = (size_t)w->symbols + 1;
    w->variable = dal__pool_allocate(pool, 2 * (size_t)w->pairs, sizeof *w->variable);
    w->primary = dal__pool_nodes(pool, w->graph, (size_t)w->primaries);
    w->centre = dal__pool_allocate(pool, symbols, sizeof *w->centre);
    w->reach = dal__pool_allocate(pool, symbols, sizeof *w->reach);
    w->text = dal__pool_allocate(pool, symbols, sizeof *w->text);
    w->latex = dal__pool_allocate(pool, symbols, sizeof *w->latex);
    for (int i = 0; w->reach && i < w->symbols; i++) w->reach[i] = 1.0;
}

/* ---- names --------------------------------------------------------------------------------- */

static const char *take_text(dal__pool *pool, dal__buffer *text)
{
    const char *copy = dal__pool_text(pool, text->bytes, text->length);
    pool->out_of_memory |= text->out_of_memory;
    dal__buffer_free(text);
    return copy;
}

/* The names of a symbol: "prefix_name" and "letters_{name}"; with the prefix "'" the velocity;
 * without a prefix the name alone. */
static void name_symbol(const dal__theory *w, dal__pool *pool, int symbol, const char *prefix,
                        const char *letters, const char *name)
{
    dal__buffer text = {0}, latex = {0};
    const bool is_velocity = *prefix == '\'';
    if (is_velocity)
        dal__buffer_print(&text, "%s'", name);
    else
        dal__buffer_print(&text, "%s%s%s", prefix, *prefix && *name ? "_" : "", name);
    dal__buffer_append(&latex, letters);
    if (*letters && *name) dal__buffer_append(&latex, strchr(letters, '{') ? "\\," : "_{");
    if (*name) dal__typeset_name(name, is_velocity ? "\\dot" : NULL, &latex);
    if (*letters && *name) dal__buffer_append(&latex, "}");
    w->text[symbol] = take_text(pool, &text);
    w->latex[symbol] = take_text(pool, &latex);
}

static const char *const alpha_text[] = {"alpha", "alpha'", "alpha''", "alpha'''", "alpha''''"};
static const char *const alpha_latex[] = {"\\alpha", "\\dot{\\alpha}", "\\ddot{\\alpha}",
                                          "\\alpha^{(3)}", "\\alpha^{(4)}"};

/* ---- the theories of a model --------------------------------------------------------------- */

/* The symbols of a theory: the model's, and those after them. */
typedef struct places {
    int lambda, e, g; /* of X after q, v; e or g is used */
    int p, pi_lambda, pi_e, pi_g;
    int F; /* F_x, where H is written */
} places;

static void name_all(const dal__theory *w, dal__pool *pool, const dal__equations *e,
                     const places *k)
{
    const int n = e->n, mu_lambda = w->mu + (e->vakonomic ? 2 * n : 1);
    const int mu_q = w->mu + (e->vakonomic ? 0 : n + 1);
    for (int i = 0; i < e->parameters; i++) name_symbol(w, pool, i, "", "", e->parameter[i]);
    name_symbol(w, pool, e->t, "", "", "t");
    for (int i = 0; i < n; i++) {
        const char *name = e->coordinate[i];
        name_symbol(w, pool, e->q + i, "", "", name);
        name_symbol(w, pool, e->v + i, "'", "", name);
        name_symbol(w, pool, k->lambda + i, "lambda", "\\lambda", name);
        name_symbol(w, pool, k->p + i, "p", "p", name);
        name_symbol(w, pool, e->pi + i, "pi", "\\pi", name);
        name_symbol(w, pool, k->pi_lambda + i, "pi_lambda", "\\pi_{\\lambda", name);
        name_symbol(w, pool, mu_lambda + i, "mu_lambda", "\\mu_{\\lambda", name);
        name_symbol(w, pool, mu_q + i, "mu", "\\mu", name);
        name_symbol(w, pool, k->F + i, "F", "F", name);
        if (e->vakonomic) name_symbol(w, pool, w->mu + n + i, "mu_v", "\\mu_{v", name);
    }
    for (int a = 0; a < e->m && e->vakonomic; a++) {
        char name[16] = "g";
        int length = 1;
        for (int digits = 1000; digits > 0; digits /= 10)
            if (a + 1 >= digits) name[length++] = (char)('0' + (a + 1) / digits % 10);
        name_symbol(w, pool, k->g + a, "", "", name);
        name_symbol(w, pool, k->pi_g + a, "pi", "\\pi", name);
        name_symbol(w, pool, w->mu + 3 * n + a, "mu", "\\mu", name);
    }
    if (!e->vakonomic) {
        name_symbol(w, pool, k->e, "", "", "e");
        name_symbol(w, pool, k->pi_e, "pi", "\\pi", "e");
        name_symbol(w, pool, w->mu, "mu", "\\mu", "e");
    }
    for (int i = 0; i <= DAL__GENERATOR_ORDERS; i++)
        w->text[w->alpha + i] = alpha_text[i], w->latex[w->alpha + i] = alpha_latex[i];
}

static void set_lifted(dal__theory *w, dal_model *model, const places *k, dal__pool *pool)
{
    const dal__equations *e = &model->equations;
    dal__graph *graph = w->graph;
    const int n = e->n;
    dal__node *K_pi = dal__pool_nodes(pool, graph, 3 * (size_t)n);
    if (!K_pi) return;
    for (int i = 0; i < n; i++) K_pi[i] = dal__symbol(graph, e->pi + i);
    if (model->effort != DAL_EFFORT_IDENTITY) dal__motion_effort(model, model->effort, K_pi);
    dal__node square = dal__number(graph, 0.0), sum = square, forces = square, named = square;
    for (int i = 0; i < n; i++) {
        const dal__node pi = dal__symbol(graph, e->pi + i), F = dal__symbol(graph, k->F + i);
        const dal__node lambda = dal__symbol(graph, k->lambda + i);
        const dal__node v = dal__symbol(graph, e->v + i);
        square = dal__node_add(graph, square, dal__node_mul(graph, pi, K_pi[i]));
        sum = dal__node_add(graph, sum, dal__node_mul(graph, lambda, v));
        forces = dal__node_add(graph, forces, dal__node_mul(graph, pi, e->F[i]));
        named = dal__node_add(graph, named, dal__node_mul(graph, pi, F));
        w->primary[1 + i] = dal__symbol(graph, k->pi_lambda + i);
        w->primary[1 + n + i] = dal__node_sub(graph, dal__symbol(graph, k->p + i), lambda);
    }
    w->primary[0] = dal__symbol(graph, k->pi_e);
    const dal__node two_e = dal__node_mul(graph, dal__number(graph, 2.0), dal__symbol(graph, k->e));
    sum = dal__node_add(graph, dal__node_div(graph, square, two_e), sum);
    w->H = dal__node_add(graph, sum, forces);
    w->shown = dal__node_add(graph, sum, named);
}

static dal_status set_vakonomic(dal__theory *w, const dal_model *model, const places *k,
                                dal_error *error)
{
    const dal__equations *e = &model->equations;
    dal__graph *graph = w->graph;
    const int n = e->n;
    w->H = dal__node_neg(graph, e->lagrangian);
    for (int i = 0; i < n; i++) {
        const dal__node lambda = dal__symbol(graph, k->lambda + i);
        if (!dal__node_is_zero(graph, e->force[i]))
            return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                             "vakonomic motion with forces has no action");
        w->H =
            dal__node_add(graph, w->H, dal__node_mul(graph, lambda, dal__symbol(graph, e->v + i)));
        w->primary[i] = dal__node_sub(graph, dal__symbol(graph, k->p + i), lambda);
        w->primary[n + i] = dal__symbol(graph, e->pi + i);
        w->primary[2 * n + i] = dal__symbol(graph, k->pi_lambda + i);
    }
    for (int a = 0; a < e->m; a++) {
        const dal__node g = dal__symbol(graph, k->g + a);
        w->H = dal__node_add(graph, w->H, dal__node_mul(graph, g, e->constraint[a]));
        w->primary[3 * n + a] = dal__symbol(graph, k->pi_g + a);
    }
    w->shown = w->H;
    return DAL_STATUS_OK;
}

dal_status dal__theory_create(dal__theory *w, dal_model *model, const dal_run_spec *spec,
                              dal__pool *pool, dal_error *error)
{
    const dal__equations *e = &model->equations;
    const int n = e->n;
    *w = (dal__theory){.graph = e->graph, .table = e->table_name};
    const int more = e->vakonomic ? e->m : 1;
    places k = {.lambda = e->symbols};
    k.e = k.lambda + n, k.g = e->g;
    k.p = k.e + 1, k.pi_lambda = k.p + n, k.pi_e = k.pi_lambda + n, k.pi_g = k.pi_e;
    w->alpha = k.pi_e + more;
    w->mu = w->alpha + DAL__GENERATOR_ORDERS + 1;
    w->pairs = 3 * n + more;
    w->primaries = e->vakonomic ? 3 * n + e->m : 2 * n + 1;
    k.F = w->mu + w->primaries;
    w->symbols = k.F + n;
    w->parameters = e->parameters;
    w->t = e->t;
    w->observables = 2 * n;
    dal__theory_allocate(w, pool);
    if (pool->out_of_memory) return DAL_STATUS_OK;
    int *X = w->variable, *P = X + w->pairs;
    for (int i = 0; i < n; i++) {
        X[i] = e->q + i, X[n + i] = e->v + i, X[2 * n + i] = k.lambda + i;
        P[i] = k.p + i, P[n + i] = e->pi + i, P[2 * n + i] = k.pi_lambda + i;
    }
    for (int i = 0; i < w->pairs - 3 * n; i++) {
        X[3 * n + i] = e->vakonomic ? k.g + i : k.e;
        P[3 * n + i] = e->vakonomic ? k.pi_g + i : k.pi_e;
    }
    name_all(w, pool, e, &k);
    DAL_TRY(dal__region_find(e, spec, neighbourhood, w->centre, w->reach, error));
    if (!e->vakonomic) w->centre[k.e] = 1.0, w->reach[k.e] = of_e;
    if (e->vakonomic) return set_vakonomic(w, model, &k, error);
    set_lifted(w, model, &k, pool);
    return DAL_STATUS_OK;
}
