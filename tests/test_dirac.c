/* test_dirac.c - Dirac's procedure: chains of known theories, of the lift, and of wrong ones. */
#include "allocation.h"
#include "codegen/typeset.h"
#include "expr/parser.h"
#include "fixtures.h"
#include "formula.h"
#include "lift/classes.h"
#include "lift/dirac.h"
#include "quick.h"

#include <CUnit/CUnit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- theories made by hand ----------------------------------------------------------------- */

enum { MAX_PAIRS = 8, T = 2 * MAX_PAIRS, MADE_SYMBOLS = T + 1 + DAL__GENERATOR_ORDERS + 1 + 8 };

/* A theory of variables X, "x y g", and P, "p q r", with a Hamiltonian and primary constraints. */
typedef struct made {
    const char *names[2 * MAX_PAIRS];
    int pairs;
    const char *H, *primary[6];
} made;

static dal__node find_name(void *user, const char *name, size_t length, bool prime,
                           dal_error *error)
{
    const struct {
        const made *m;
        dal__graph *graph;
    } *w = user;
    if (length == 1 && *name == 't') return dal__symbol(w->graph, T);
    for (int i = 0; i < 2 * w->m->pairs; i++)
        if (!prime && strlen(w->m->names[i]) == length && memcmp(w->m->names[i], name, length) == 0)
            return dal__symbol(w->graph, i);
    error->status = DAL_STATUS_NAME;
    return 0;
}

static dal__node parse(const made *m, dal__graph *graph, const char *text)
{
    struct {
        const made *m;
        dal__graph *graph;
    } w = {m, graph};
    const dal__names names = {.resolve = find_name, .user = &w};
    dal__node node = 0;
    dal_error error = {0};
    CU_ASSERT_EQUAL_FATAL(dal__parse(graph, text, strlen(text), &names, &node, &error),
                          DAL_STATUS_OK);
    return node;
}

static dal_status make_theory(const made *m, dal__graph *graph, dal__pool *pool, dal__theory *out)
{
    static const char *const others[] = {"t",  "a",  "a1", "a2", "a3", "a4", "m1",
                                         "m2", "m3", "m4", "m5", "m6", "m7", "m8"};
    *out = (dal__theory){.graph = graph, .pairs = m->pairs, .symbols = MADE_SYMBOLS};
    out->t = T, out->alpha = T + 1, out->mu = T + 2 + DAL__GENERATOR_ORDERS;
    out->observables = m->pairs;
    while (m->primary[out->primaries]) out->primaries++;
    dal__theory_allocate(out, pool);
    if (pool->out_of_memory) return DAL_STATUS_MEMORY;
    for (int i = 0; i < 2 * m->pairs; i++) {
        out->variable[i] = i;
        out->text[i] = out->latex[i] = m->names[i];
        out->centre[i] = 0.7 + 0.1 * i;
        out->reach[i] = 0.5;
    }
    for (int i = T; i < MADE_SYMBOLS; i++) out->text[i] = out->latex[i] = others[i - T];
    out->H = out->shown = parse(m, graph, m->H);
    for (int b = 0; b < out->primaries; b++) out->primary[b] = parse(m, graph, m->primary[b]);
    return graph->status;
}

static dal_dirac *run_made(const made *m)
{
    dal__graph *graph = dal__graph_create(0);
    dal__pool pool = {.blocks = NULL};
    dal__theory theory;
    dal_dirac *d = NULL;
    CU_ASSERT_EQUAL_FATAL(make_theory(m, graph, &pool, &theory), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal__dirac_run(&d, &theory, &pool), DAL_STATUS_OK);
    dal__pool_free(&pool);
    dal__graph_free(graph);
    return d;
}

/* Whether a constraint of the chain has this text. */
static bool has(const dal_dirac *d, const char *phi, int stage)
{
    for (int a = 0; a < d->constraints; a++)
        if (d->constraint[a].stage == stage && strcmp(d->constraint[a].phi.text, phi) == 0)
            return true;
    return false;
}

/* L = (q' - g)^2/2: p_g and p, first class, gauge q -> q + alpha, g -> g + alpha'. */
static void test_gauge_theory(void)
{
    dal_dirac *d = run_made(
        &(made){.names = {"q", "g", "p", "r"}, .pairs = 2, .H = "p^2/2 + g*p", .primary = {"r"}});
    CU_ASSERT(d->is_complete);
    CU_ASSERT_EQUAL(d->constraints, 2);
    CU_ASSERT(has(d, "r", 0) && has(d, "p", 1));
    CU_ASSERT_EQUAL(d->first_class, 2);
    CU_ASSERT_EQUAL(d->second_class, 0);
    CU_ASSERT_EQUAL(d->dimension, 0);
    CU_ASSERT_EQUAL_FATAL(d->generators, 1);
    const dal_dirac_generator *g = &d->generator[0];
    CU_ASSERT_EQUAL(g->derivatives, 1);
    CU_ASSERT_STRING_EQUAL(g->of_multiplier.text, "a2"); /* of g' = mu: alpha'' */
    CU_ASSERT_EQUAL_FATAL(g->changes, 2);
    CU_ASSERT_STRING_EQUAL(g->changed[0].text, "q");
    CU_ASSERT_STRING_EQUAL(g->change[0].text, "a");
    CU_ASSERT_STRING_EQUAL(g->changed[1].text, "g");
    CU_ASSERT_STRING_EQUAL(g->change[1].text, "a1");
    dal_dirac_free(d);
}

/* A particle on a circle by a multiplier g: four second-class constraints, and
 * {x_i, p_j} = delta_ij - x_i x_j, {p, q} = y p - x q on the circle. */
static const made circle = {.names = {"x", "y", "g", "p", "q", "r"},
                            .pairs = 3,
                            .H = "(p^2 + q^2)/2 + g*(x^2 + y^2 - 1)/2",
                            .primary = {"r"}};

static void test_circle(void)
{
    dal_dirac *d = run_made(&circle);
    CU_ASSERT(d->is_complete);
    CU_ASSERT_EQUAL(d->constraints, 4);
    CU_ASSERT_EQUAL(d->second_class, 4);
    CU_ASSERT_EQUAL(d->free_multipliers, 0);
    CU_ASSERT_EQUAL(d->dimension, 2);
    CU_ASSERT_EQUAL(d->stages, 4);
    dal_dirac_free(d);
}

static void test_circle_brackets(void)
{
    dal__graph *graph = dal__graph_create(0);
    dal__pool pool = {.blocks = NULL};
    dal__theory theory;
    dal__chain chain;
    dal__classes k;
    CU_ASSERT_EQUAL_FATAL(make_theory(&circle, graph, &pool, &theory), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal__chain_run(&chain, &theory, &pool), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal__classes_find(&k, &chain), DAL_STATUS_OK);
    double value[DAL__SURFACE_POINTS * 18];
    CU_ASSERT_FATAL(dal__surface_values(&chain.surface, 18, k.bracket, value));
    for (int i = 0; i < DAL__SURFACE_POINTS; i++) {
        const double *z = chain.surface.point + (size_t)i * MADE_SYMBOLS;
        const double *bracket = value + 18 * i; /* rows x, y, g; columns x, y, g, p, q, r */
        CU_ASSERT_DOUBLE_EQUAL(z[0] * z[0] + z[1] * z[1], 1.0, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(bracket[0 * 6 + 3], 1.0 - z[0] * z[0], 1e-9);
        CU_ASSERT_DOUBLE_EQUAL(bracket[0 * 6 + 4], -z[0] * z[1], 1e-9);
        CU_ASSERT_DOUBLE_EQUAL(bracket[1 * 6 + 4], 1.0 - z[1] * z[1], 1e-9);
        CU_ASSERT_DOUBLE_EQUAL(bracket[0 * 6 + 1], 0.0, 1e-9);
        CU_ASSERT_DOUBLE_EQUAL(bracket[0 * 6 + 5], 0.0, 1e-9); /* r is 0 */
    }
    dal__pool_free(&pool);
    dal__graph_free(graph);
}

/* The outcome of the last step of a chain. */
static dal_dirac_outcome last_outcome(const made *m, int *constraints)
{
    dal_dirac *d = run_made(m);
    const dal_dirac_outcome outcome = d->step[d->steps - 1].outcome;
    CU_ASSERT_EQUAL(d->is_complete, outcome < DAL_DIRAC_CONTRADICTS);
    if (constraints) *constraints = d->constraints;
    dal_dirac_free(d);
    return outcome;
}

static void test_ends(void)
{
    made m = {.names = {"x", "g", "p", "r"}, .pairs = 2, .primary = {"r"}};
    m.H = "p^2/2 + g"; /* {r, H} = -1 */
    CU_ASSERT_EQUAL(last_outcome(&m, NULL), DAL_DIRAC_CONTRADICTS);
    m.H = "g*(x - sin(t))"; /* x = sin t, and x does not change */
    CU_ASSERT_EQUAL(last_outcome(&m, NULL), DAL_DIRAC_CONTRADICTS);
    m.H = "p^2/2 + g*x^3"; /* its gradient vanishes with it, and it is no square */
    CU_ASSERT_EQUAL(last_outcome(&m, NULL), DAL_DIRAC_STOPS);
    m.H = "p^2/2 + g*(1 + x^2)"; /* no points */
    CU_ASSERT_EQUAL(last_outcome(&m, NULL), DAL_DIRAC_STOPS);
}

/* Squares: (x^2 + y^2 - 1)^2 = 0 is the circle, with x p + y q = 0; then p^2 + q^2 = 0, a form of
 * rank 1 on that, is p = q = 0. */
static void test_squares(void)
{
    made m = circle;
    m.H = "(p^2 + q^2)/2 + g*(x^2 + y^2 - 1)^2";
    dal_dirac *d = run_made(&m);
    CU_ASSERT(d->is_complete);
    CU_ASSERT_EQUAL(d->step[0].outcome, DAL_DIRAC_IRREGULAR);
    CU_ASSERT_EQUAL(d->constraints, 4);
    CU_ASSERT(has(d, "p", 3) || has(d, "q", 3));
    CU_ASSERT_EQUAL(d->dimension, 1);
    CU_ASSERT_EQUAL(d->free_multipliers, 1);
    dal_dirac_free(d);
    m.H = "(p^2 + q^2)/2 + g*(2*x^2 + 3*(y - 1)^2)";
    d = run_made(&m);
    CU_ASSERT_EQUAL(d->step[0].outcome, DAL_DIRAC_IRREGULAR);
    CU_ASSERT(has(d, "x", 1) && has(d, "y - 1", 1));
    dal_dirac_free(d);
    m.H = "(p^2 + q^2)/2 + g*(x^2 - y^2)"; /* not of one sign: a regular condition */
    d = run_made(&m);
    CU_ASSERT_EQUAL(d->step[0].outcome, DAL_DIRAC_ADDS);
    dal_dirac_free(d);
}

/* The lift of x'' = -x by hand, X = (x, v, l, e), and what becomes of it with a wrong H. */
static made lift_of(const char *H)
{
    return (made){.names = {"x", "v", "l", "e", "p", "s", "k", "h"},
                  .pairs = 4,
                  .H = H,
                  .primary = {"h", "k", "p - l"}};
}

static void test_wrong_hamiltonians(void)
{
    made m = lift_of("s^2/(2*e) - s*x + l*v");
    dal_dirac *d = run_made(&m);
    CU_ASSERT_EQUAL(d->constraints, 5);
    CU_ASSERT(has(d, "s", 1) && has(d, "l", 2));
    CU_ASSERT_EQUAL(d->second_class, 2);
    CU_ASSERT_EQUAL(d->free_multipliers, 1);
    CU_ASSERT_STRING_EQUAL(d->multiplier[2].value.text, "v");
    CU_ASSERT_EQUAL(d->dimension, 2);
    dal_dirac_free(d);

    m = lift_of("s^2/(2*e) - s*x"); /* without l v: x does not move, l is not fixed to be 0 */
    d = run_made(&m);
    CU_ASSERT_EQUAL(d->constraints, 4);
    CU_ASSERT_STRING_EQUAL(d->multiplier[2].value.text, "0");
    CU_ASSERT_EQUAL(d->second_class, 2);
    CU_ASSERT_EQUAL(d->first_class, 2);
    dal_dirac_free(d);

    m = lift_of("l*v - s*x"); /* without s^2/2e: nothing but the primary constraints */
    d = run_made(&m);
    CU_ASSERT_EQUAL(d->constraints, 3);
    CU_ASSERT_EQUAL(d->stages, 1);
    CU_ASSERT_STRING_EQUAL(d->multiplier[1].value.text, "s");
    dal_dirac_free(d);

    m = lift_of("(s^2 + 1)/(2*e) - s*x + l*v"); /* s^2 + 1 = 0 */
    CU_ASSERT_EQUAL(last_outcome(&m, NULL), DAL_DIRAC_STOPS);
    m = lift_of("s/e - s*x + l*v"); /* s = 0 is regular here, and x'' has another law */
    d = run_made(&m);
    CU_ASSERT_EQUAL(d->step[0].outcome, DAL_DIRAC_ADDS);
    CU_ASSERT_EQUAL(d->free_multipliers, 1); /* its generator has coefficients of e */
    CU_ASSERT_EQUAL(d->generators, 0);
    CU_ASSERT_EQUAL(d->dimension, -1);
    dal_dirac_free(d);
}

/* ---- models -------------------------------------------------------------------------------- */

static dal_status dirac_of(const char *text, dal_effort effort, dal_dirac **d, int *n)
{
    dal_model *model = fixture_model(text);
    const dal_system *system = NULL;
    dal_status status = dal_model_set_effort(model, effort, NULL);
    *d = NULL;
    if (status == DAL_STATUS_OK) status = dal_model_system(model, &system, NULL);
    if (status == DAL_STATUS_OK) {
        const dal_run_spec spec = {.system = system, .options = dal_options_default()};
        status = dal_dirac_create(d, model, &spec, NULL);
        if (n) *n = system->n;
    }
    dal_model_free(model);
    return status;
}

/* (nh15)-(nh19), for the efforts whose K is regular. */
static void test_lifts(void)
{
    const char *const texts[] = {fixture_full,    "chaplygin-sleigh", "damped-oscillator",
                                 "vertical-disk", "appell-hamel",     "rocket",
                                 "falling-disk"};
    for (size_t k = 0; k < 2 * sizeof texts / sizeof *texts; k += (size_t)case_stride(3)) {
        dal_dirac *d;
        int n = 0;
        CU_ASSERT_EQUAL_FATAL(
            dirac_of(texts[k / 2], k % 2 ? DAL_EFFORT_MASS : DAL_EFFORT_IDENTITY, &d, &n),
            DAL_STATUS_OK);
        CU_ASSERT(d->is_complete);
        CU_ASSERT_EQUAL(d->stages, 3);
        CU_ASSERT_EQUAL(2 * d->pairs, 6 * n + 2);
        CU_ASSERT_EQUAL(d->constraints, 4 * n + 1);
        CU_ASSERT_EQUAL(d->second_class, 2 * n);
        CU_ASSERT_EQUAL(d->first_class, 2 * n + 1);
        CU_ASSERT_EQUAL(d->free_multipliers, 1);
        CU_ASSERT_EQUAL(d->dimension, 2 * n);
        CU_ASSERT_STRING_EQUAL(d->on_surface.text, "0");
        CU_ASSERT_EQUAL(d->step[0].outcome, DAL_DIRAC_IRREGULAR);
        CU_ASSERT(d->multiplier[0].is_free);
        for (int b = 1; b <= n; b++) CU_ASSERT_STRING_EQUAL(d->multiplier[b].value.text, "0");
        CU_ASSERT_EQUAL(d->brackets, 2 * n);
        for (int i = 0; i < d->brackets; i++) CU_ASSERT_STRING_EQUAL(d->bracket[i].value.text, "1");
        CU_ASSERT_EQUAL_FATAL(d->generators, 1);
        CU_ASSERT_EQUAL_FATAL(d->generator[0].changes, 1);
        CU_ASSERT_STRING_EQUAL(d->generator[0].changed[0].text, "e");
        CU_ASSERT_STRING_EQUAL(d->generator[0].change[0].text, "alpha");
        CU_ASSERT_STRING_EQUAL(d->generator[0].of_multiplier.text, "alpha'");
        CU_ASSERT_STRING_EQUAL(d->generator[0].of_multiplier.latex, "\\dot{\\alpha}");
        dal_dirac_free(d);
    }
}

static void test_the_sleigh(void)
{
    dal_dirac *d;
    CU_ASSERT_EQUAL_FATAL(dirac_of("chaplygin-sleigh", DAL_EFFORT_IDENTITY, &d, NULL),
                          DAL_STATUS_OK);
    CU_ASSERT(has(d, "pi_e", 0) && has(d, "pi_lambda_phi", 0) && has(d, "p_y1 - lambda_y1", 0));
    CU_ASSERT(has(d, "pi_y2", 1) && has(d, "lambda_phi", 2));
    CU_ASSERT_STRING_EQUAL(d->multiplier[4].name.text, "mu_y1");
    CU_ASSERT_STRING_EQUAL(d->multiplier[4].value.text, "y1'");
    CU_ASSERT_STRING_EQUAL(d->constraint[4].form.text, "p_y1");
    CU_ASSERT(d->constraint[4].first_class);
    CU_ASSERT_STRING_EQUAL(d->constraint[7].phi.latex, "\\pi_{y_{1}}");
    dal_dirac_free(d);
}

/* With `constraint` D is an integral of the lift for all (p, pi): (p, pi) = s grad D is left, so
 * there are m constraints less; an integrable D counts twice, m = n leaves no K at all. */
static void test_constraint_effort(void)
{
    static const struct {
        const char *text;
        int first_class;
    } cases[] = {
        {"chaplygin-sleigh", 6 - 1 + 1},
        {"vertical-disk", 8 - 2 + 1},
        {"nonholonomic-particle", 6 - 1 + 1},
        {"turntable-ball", 10 - 2 + 1},
        {"isokinetic", 4 - 1 + 1},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [x' - y']\n", 4 - 2 + 1},
        {"pursuit", 1},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        dal_dirac *d;
        int n = 0;
        CU_ASSERT_EQUAL_FATAL(dirac_of(cases[k].text, DAL_EFFORT_CONSTRAINT, &d, &n),
                              DAL_STATUS_OK);
        CU_ASSERT(d->is_complete);
        CU_ASSERT_EQUAL(d->first_class, cases[k].first_class);
        CU_ASSERT_EQUAL(d->second_class, 2 * n);
        CU_ASSERT_EQUAL(d->free_multipliers, 1);
        dal_dirac_free(d);
    }
}

/* Vakonomic motion: D and its multiplier are second class with everything else, as pi_g, pi,
 * p - lambda and lambda - L_v + g D_v; the brackets of q and v are M^-1 on ker D_v. */
static void test_vakonomic(void)
{
    dal_dirac *d;
    CU_ASSERT_EQUAL_FATAL(dirac_of("chaplygin-sleigh-vakonomic", DAL_EFFORT_IDENTITY, &d, NULL),
                          DAL_STATUS_OK);
    CU_ASSERT(d->is_complete);
    CU_ASSERT_EQUAL(2 * d->pairs, 20);
    CU_ASSERT_EQUAL(d->constraints, 14);
    CU_ASSERT_EQUAL(d->second_class, 14);
    CU_ASSERT_EQUAL(d->free_multipliers, 0);
    CU_ASSERT_EQUAL(d->dimension, 6);
    CU_ASSERT_EQUAL(d->generators, 0);
    bool found = false;
    for (int i = 0; i < d->brackets; i++) {
        const dal_dirac_bracket *b = &d->bracket[i];
        if (strcmp(b->left.text, "phi") != 0 || strcmp(b->right.text, "phi'") != 0) continue;
        found = true;
        CU_ASSERT_STRING_EQUAL(b->value.text, "1/I");
    }
    CU_ASSERT(found);
    dal_dirac_free(d);
    static const char forced[] =
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nforces: {x: -x'}\n"
        "constraints: [y' - x*x']\nmechanics: vakonomic\n";
    CU_ASSERT_EQUAL(dirac_of(forced, DAL_EFFORT_IDENTITY, &d, NULL), DAL_STATUS_UNSUPPORTED);
}

static void test_refusals(void)
{
    dal_model *model = NULL;
    dal_error error = {0};
    dal_dirac *d;
    const dal_run_spec spec = {.system = fixture_system("chaplygin-sleigh"),
                               .options = dal_options_default()};
    CU_ASSERT_EQUAL_FATAL(dal_model_builtin(&model, "chaplygin-sleigh", NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_dirac_create(&d, model, &spec, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT(d == NULL && strstr(error.message, "not the model's"));
    dal_model_free(model);
    CU_ASSERT_STRING_EQUAL(dal_dirac_outcome_name(DAL_DIRAC_IRREGULAR), "irregular");
    CU_ASSERT_STRING_EQUAL(dal_dirac_outcome_name(DAL_DIRAC_OUTCOME_COUNT), "?");
}

static void let_memory_fail(const char *text, dal_effort effort)
{
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        const dal_system *system = NULL;
        dal_error error = {.status = DAL_STATUS_OK};
        dal_dirac *d = NULL;
        dal_model *model = fixture_model(text);
        CU_ASSERT_EQUAL(dal_model_set_effort(model, effort, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
        const dal_run_spec spec = {.system = system, .options = dal_options_default()};
        allocation_start(&trial);
        if (allocation_end(&trial, dal_dirac_create(&d, model, &spec, &error)))
            CU_ASSERT(error.status == DAL_STATUS_MEMORY && d == NULL);
        dal_dirac_free(d);
        dal_model_free(model);
    }
    CU_ASSERT(trial.failures > 0);
}

static void test_no_memory(void)
{
    static const char wheel[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^2/2\n"
                                "constraints: [x' - y'/2]\nstart: {x: 1}\n";
    let_memory_fail("damped-oscillator", DAL_EFFORT_IDENTITY);
    let_memory_fail(wheel, DAL_EFFORT_CONSTRAINT);
}

/* ---- formulas as text ---------------------------------------------------------------------- */

static void write_name(const void *user, int symbol, dal__buffer *text)
{
    static const char *const names[SYMBOLS] = {"a", "b", "x", "y", "z", "x'", "y'", "z'"};
    (void)user;
    dal__buffer_append(text, names[symbol]);
}

/* What is written is read as the same formula. */
static void test_plain_formulas(void)
{
    static const char *const formulas[] = {
        "x - (y - z)",
        "x/(y*z)",
        "x/y/z",
        "(x + y)^2*(x + y)",
        "-(x^2)",
        "(-x)^2",
        "(x^y)^z",
        "2^-x",
        "sin(x)^2*cos(y)",
        "x*(y/z)^3",
        "-x*-y",
        "atan2(y, -x)/hypot(x, y)",
        "if(x < y, x, -y)",
        "min(x, y) - a*b*x",
        "0.1*x - 1e-9*y",
        "1.5e12/(x - y)",
        "abs(x - 2*y)",
        "exp(-x)/(1 + x)",
        "x*y - (z - a)*b",
        "(x*x')^2 - y'*z'/3",
    };
    const double values[SYMBOLS] = {1.3, -0.7, 0.9, 1.7, 2.3, -0.4, 0.6, 1.1};
    const dal__typeset_options options = {
        .symbol = write_name, .letter = "s", .shared_length = SIZE_MAX, .is_plain = true};
    for (size_t k = 0; k < sizeof formulas / sizeof *formulas; k++) {
        dal__graph *graph = formula_graph();
        const dal__node node = formula_node(graph, formulas[k]);
        dal__typesetter *t = NULL;
        CU_ASSERT_EQUAL_FATAL(dal__typesetter_create(&t, graph, &node, 1, &options), DAL_STATUS_OK);
        const dal__node again = formula_node(graph, dal__typeset(t, node));
        const double x = dal__evaluate(graph, node, values),
                     y = dal__evaluate(graph, again, values);
        CU_ASSERT_DOUBLE_EQUAL(x, y, 1e-14 * fabs(x));
        dal__typesetter_free(t);
        dal__graph_free(graph);
    }
}

void suite_dirac(void)
{
    CU_pSuite suite = CU_add_suite("Dirac's procedure", NULL, NULL);
    CU_add_test(suite, "a gauge theory", test_gauge_theory);
    CU_add_test(suite, "a particle on a circle", test_circle);
    CU_add_test(suite, "its Dirac brackets", test_circle_brackets);
    CU_add_test(suite, "contradictions, and where it stops", test_ends);
    CU_add_test(suite, "squares", test_squares);
    CU_add_test(suite, "wrong Hamiltonians of the lift", test_wrong_hamiltonians);
    CU_add_test(suite, "lifts of systems", test_lifts);
    CU_add_test(suite, "the chain of the sleigh", test_the_sleigh);
    CU_add_test(suite, "efforts along the constraints", test_constraint_effort);
    CU_add_test(suite, "vakonomic motion", test_vakonomic);
    CU_add_test(suite, "refusals", test_refusals);
    CU_add_test(suite, "out of memory", test_no_memory);
    CU_add_test(suite, "formulas as text", test_plain_formulas);
}
