/* test_full_graph.c - models whose graph is full at one node after the other: whichever derivation
 * needs the next one fails, and the message says that the formulas are too large. */
#include "fixtures.h"
#include "model/model.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <stdio.h>
#include <string.h>

/* Constraints that depend on each other about some points, events with a branch, and reactions. */
static const char many[] = "coordinates: [x, y, z]\nparameters: {k: 1}\n"
                           "lagrangian: (x'^2 + (1 + x^2)*y'^2 + z'^2)/2 - k*abs(x)\n"
                           "forces: {y: -sign(y'), z: -z'*cos(t)}\n"
                           "constraints: [\"x' - y'*z\"]\nstart: {x: 1, z': 1}\n"
                           "invariants: {c: x'*z}\n"
                           "events:\n  - {when: x - 0.5, set: {y: y + 1}}\n"
                           "  - {when: abs(x) - y, direction: up, set: {x': -x', z': -z'}}\n"
                           "reactions: [{x: 1}]\n";
static const char natural[] = "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2)/2 - y\n"
                              "holonomic: [x^2 + y^2 - 1]\nconstraints: [z' - x*y']\n"
                              "start: {x: 1}\n";
static const char implicit[] = "coordinates: [x, y]\nparameters: {k: 1}\n"
                               "equations: [\"x'' + k*x*y'' + sin(x)\", \"y'' + x''*y'\"]\n"
                               "start: {x: 1}\n";
static const char controlled[] = "coordinates: [x, y, phi]\n"
                                 "lagrangian: (x'^2 + y'^2 + phi'^2)/2\n"
                                 "constraints: [x'*sin(phi) - y'*cos(phi)]\n"
                                 "controls:\n  - {x: cos(phi), y: sin(phi)}\n  - {phi: 1}\n";
static const char integrable[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                 "constraints: [2*x*x' + y']\n";

/* The linker gives the library this one for dal__graph_create. */
static int limit_of_graphs; /* 0: their own */
dal__graph *__real_dal__graph_create(int parameters);
dal__graph *__wrap_dal__graph_create(int parameters);
dal__graph *__wrap_dal__graph_create(int parameters)
{
    dal__graph *graph = __real_dal__graph_create(parameters);
    if (graph && limit_of_graphs) graph->limit = limit_of_graphs;
    return graph;
}

typedef dal_status model_work(dal_model *model, dal_error *error);

static dal_status make_system(dal_model *model, dal_error *error)
{
    const dal_system *system;
    return dal_model_system(model, &system, error);
}

static dal_status make_tangent(dal_model *model, dal_error *error)
{
    const dal_system *system;
    return dal_model_tangent(model, &system, error);
}

static dal_status make_growth(dal_model *model, dal_error *error)
{
    dal_growth growth;
    return dal_model_growth(model, NULL, 0, NULL, &growth, error);
}

static dal_run_spec spec_of(dal_model *model)
{
    const dal_system *system;
    CU_ASSERT_EQUAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    return fixture_spec(system, "rk4", DAL_PHYSICAL, 0.1);
}

static dal_status make_dirac(dal_model *model, dal_error *error)
{
    const dal_run_spec spec = spec_of(model);
    dal_dirac *dirac = NULL;
    const dal_status status = dal_dirac_create(&dirac, model, &spec, error);
    dal_dirac_free(dirac);
    return status;
}

static dal_status find_invariants(dal_model *model, dal_error *error)
{
    const dal_run_spec spec = spec_of(model);
    const dal_invariants_settings set[] = {{.degree = 2, .measures = true},
                                           {.degree = 2, .of_coordinates = true}};
    dal_status status = DAL_STATUS_OK;
    for (int i = 0; i < 2 && status == DAL_STATUS_OK; i++) {
        dal_invariants *found = NULL;
        status = dal_find_invariants(&found, model, &spec, &set[i], error);
        dal_invariants_free(found);
    }
    return status;
}

/* A model that has a system already, for work that needs one. */
static dal_model *model_of(const char *text, dal_effort effort, bool is_made)
{
    dal_model *model = fixture_model(text);
    CU_ASSERT_EQUAL(dal_model_set_effort(model, effort, NULL), DAL_STATUS_OK);
    if (is_made) CU_ASSERT_EQUAL(make_system(model, NULL), DAL_STATUS_OK);
    return model;
}

static void fill(const char *text, dal_effort effort, model_work *work)
{
    enum { TRIALS = 60 };
    const bool is_made = work != make_system;
    dal_model *model = model_of(text, effort, is_made);
    const int first = is_made ? model->equations.graph->count + 1 : 1;
    CU_ASSERT_EQUAL_FATAL(work(model, NULL), DAL_STATUS_OK);
    const int total = model->equations.graph->count;
    dal_model_free(model);
    const int step = 1 + case_stride(3) * (total - first) / TRIALS / 3;
    CU_ASSERT(total > first);
    for (int limit = first; limit < total; limit += step) {
        dal_error error = {0};
        model = model_of(text, effort, is_made);
        if (is_made)
            model->equations.graph->limit = limit;
        else
            limit_of_graphs = limit;
        const dal_status status = work(model, &error);
        limit_of_graphs = 0;
        const bool is_right = status == DAL_STATUS_TOO_LARGE && error.status == status &&
                              strstr(error.message, "too large");
        CU_ASSERT(is_right);
        if (!is_right)
            printf("\n%.30s: %d of %d nodes: %s, %s\n", text, limit, total, dal_status_name(status),
                   error.message);
        dal_model_free(model);
    }
}

static void test_systems(void)
{
    fill(many, DAL_EFFORT_IDENTITY, make_system);
    fill(many, DAL_EFFORT_CONSTRAINT, make_system);
    fill(natural, DAL_EFFORT_IDENTITY, make_system);
    fill(implicit, DAL_EFFORT_IDENTITY, make_system);
    fill(controlled, DAL_EFFORT_CONTROLS, make_system);
    fill("chaplygin-sleigh", DAL_EFFORT_MASS, make_system);
    fill("chaplygin-sleigh-vakonomic", DAL_EFFORT_IDENTITY, make_system);
}

#define COUPLED(matrix) matrix " of 40 coordinates couples too many of them"
#define SQUARES         "coordinates: ['x[1..40]']\nlagrangian: sum(i, 1, 40, x[i]'^2)/2\n"
#define FULL                                                                                       \
    "constraints: [{for: a = 1..20, is: \"cos(x40)*x[a]' + sin(x40)*sum(i, 21, 40, x[i]')\"}]\n"

/* Matrices of 20 or more rows that are full, though their entries are few nodes: their elimination
 * alone, of 20^3/3 updates, would fill the graph. */
static const struct {
    const char *text, *message;
} coupled[] = {
    /* W at the start, and beside it. */
    {"coordinates: ['x[1..40]']\n"
     "lagrangian: (1 + x1^2)*(sum(i, 1, 40, x[i]')^2 + sum(i, 1, 40, x[i]'^2))/2\n",
     COUPLED("the mass matrix")},
    {"coordinates: ['x[1..40]']\n"
     "lagrangian: x1^2*(sum(i, 1, 40, x[i]')^2 + sum(i, 1, 40, x[i]'^2))/2\n",
     COUPLED("the mass matrix")},
    /* A A^T, of constraints that no coordinate solves. */
    {SQUARES FULL, COUPLED("A W^-1 A^T")},
    /* The bordered matrix of a W of pairs. */
    {"coordinates: ['x[1..40]']\n"
     "lagrangian: sum(i, 1, 40, x[i]'^2) + sum(i, 1, 20, cos(x[i])*x[i]'*x[i+20]')/4\n" FULL,
     COUPLED("A W^-1 A^T")},
    /* W without x1', which the constraint is solved for. */
    {SQUARES "constraints: [\"x1' - cos(x2)*sum(i, 2, 40, x[i]')\"]\n", COUPLED("A W^-1 A^T")},
    /* A A^T with a W that is singular without x40', for its inverse on ker A. */
    {"coordinates: ['x[1..40]']\nlagrangian: sum(i, 1, 39, x[i]'^2)/2\n" FULL,
     COUPLED("W on ker A")},
    /* L - g D of a quadratic D. */
    {SQUARES "mechanics: vakonomic\nconstraints: [\"x1' - sum(i, 2, 40, x[i]')^2\"]\n",
     "the equations of the system are too large"},
};

static void test_coupled(void)
{
    for (size_t i = 0; i < sizeof coupled / sizeof *coupled; i++) {
        dal_error error = {0};
        dal_model *model = fixture_model(coupled[i].text);
        limit_of_graphs = 2000;
        CU_ASSERT_EQUAL(make_system(model, &error), DAL_STATUS_TOO_LARGE);
        limit_of_graphs = 0;
        CU_ASSERT_STRING_EQUAL(error.message, coupled[i].message);
        if (strcmp(error.message, coupled[i].message) != 0)
            printf("\n%.300s: %s", coupled[i].text, error.message);
        dal_model_free(model);
    }
}

/* A W^-1 B^T is diagonal, and the motion has a formula; corrections, by A W^-1 A^T, which is full,
 * have none. */
static void test_reactions(void)
{
    enum { MANY = 36 };
    char text[1024];
    const dal_system *system = NULL;
    int length = snprintf(text, sizeof text,
                          "coordinates: ['x[0..%d]']\nlagrangian: sum(i, 0, %d, x[i]'^2)/2\n"
                          "constraints: [{for: a = 1..%d, is: \"x[a]' - sin(x0)*sum(i, %d, %d, "
                          "x[i]')\"}]\nreactions: [",
                          2 * MANY, 2 * MANY, MANY, MANY + 1, 2 * MANY);
    for (int a = 1; a <= MANY; a++)
        length += snprintf(text + length, sizeof text - (size_t)length, "{x%d: 1}%s", a,
                           a < MANY ? ", " : "]\n");
    for (int i = 0; i < 2; i++) {
        dal_model *model = fixture_model(text);
        limit_of_graphs = i == 0 ? 0 : 8000;
        CU_ASSERT_EQUAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
        limit_of_graphs = 0;
        CU_ASSERT(system && (system->call.correction != NULL) == (i == 0));
        dal_model_free(model);
    }
}

static void test_tangents(void) { fill("chaplygin-sleigh", DAL_EFFORT_CONSTRAINT, make_tangent); }

static void test_analyses(void)
{
    fill("chaplygin-sleigh", DAL_EFFORT_IDENTITY, make_growth);
    fill("chaplygin-sleigh", DAL_EFFORT_IDENTITY, make_dirac);
    fill("chaplygin-sleigh-vakonomic", DAL_EFFORT_IDENTITY, make_dirac);
    fill("chaplygin-sleigh", DAL_EFFORT_IDENTITY, find_invariants);
    fill(integrable, DAL_EFFORT_IDENTITY, find_invariants);
}

void suite_full_graph(void)
{
    CU_pSuite suite = CU_add_suite("a graph that is full", NULL, NULL);
    CU_add_test(suite, "systems", test_systems);
    CU_add_test(suite, "many coupled coordinates", test_coupled);
    CU_add_test(suite, "corrections with reactions", test_reactions);
    CU_add_test(suite, "tangent systems", test_tangents);
    CU_add_test(suite, "analyses of formulas", test_analyses);
}
