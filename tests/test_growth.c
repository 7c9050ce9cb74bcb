/* test_growth.c - growth vectors of linear constraints against those known from theory.
 *
 * Contact, Engel and Martinet distributions and rolling balls: R. Montgomery, A Tour of
 * Subriemannian Geometries, AMS 2002.  A car with trailers: F. Jean, ESAIM: COCV 1 (1996) 241,
 * DOI 10.1051/cocv:1996108: (2, 3, 4, .., n) at generic points. */
#include "fixtures.h"
#include "reference.h"
#include "steer/controlled.h"

#include <CUnit/Basic.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MAX_RANKS = 8 };

/* Compares the growth vector of a model, ranks that end with 0. */
static void check_growth(const char *name, dal_model *model, int dimension, const int *rank)
{
    dal_growth found;
    bool same = dal_model_growth(model, NULL, 0, NULL, &found, NULL) == DAL_STATUS_OK &&
                found.is_complete && found.dimension == dimension;
    int levels = 0;
    while (rank[levels]) levels++;
    same = same && found.levels == levels;
    for (int k = 0; k < levels && same; k++) same = found.rank[k] == rank[k];
    CU_ASSERT(same);
    if (same) return;
    printf("\n  %s: dimension %d:", name, found.dimension);
    for (int k = 0; k < found.levels; k++) printf(" %d", found.rank[k]);
}

#define PLANE "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
#define SPACE "coordinates: [x, y, z, w]\nlagrangian: (x'^2 + y'^2 + z'^2 + w'^2)/2\n"
#define BALL  "coordinates: [x, y, a, b, c]\nlagrangian: (x'^2 + y'^2 + a'^2 + b'^2 + c'^2)/2\n"
#define ROLLS                                                                                      \
    "start: {b: 1}\nlet: {wx: b'*cos(a) + c'*sin(b)*sin(a), wy: b'*sin(a) - c'*sin(b)*cos(a)}\n"   \
    "constraints: [x' - wy, y' + wx"

static const struct {
    const char *what, *text;
    int dimension, rank[MAX_RANKS];
} cases[] = {
    {"contact", PLANE "constraints: [z' - y*x']\n", 3, {2, 3}},
    {"Martinet, from its singular plane", PLANE "constraints: [z' - y^2*x']\n", 3, {2, 3}},
    {"a sphere", PLANE "constraints: [x*x' + y*y' + z*z']\nstart: {x: 1}\n", 3, {2}},
    {"with a factor", PLANE "constraints: [exp(x*z)*(y*x' + x*y' - z'*cos(z))]\n", 3, {2}},
    {"Engel", SPACE "constraints: [y' - z*x', z' - w*x']\n", 4, {2, 3, 4}},
    {"one of two integrable", SPACE "constraints: [z' - y*x', w' - x']\n", 4, {2, 3}},
    {"ball that does not spin", BALL ROLLS ", a' + c'*cos(b)]\n", 5, {2, 3, 5}},
    {"ball that spins", BALL ROLLS "]\n", 5, {3, 5}},
    {"d(y - t x)/dt", PLANE "constraints: [y' - t*x' - x]\n", 4, {3}},
    {"y' - t x'", PLANE "constraints: [y' - t*x']\n", 4, {3, 4}},
    {"a drift", PLANE "constraints: [z' - y]\n", 4, {3, 4}},
    {"a drift of constant speed", PLANE "constraints: [z' - 2]\n", 4, {3}},
};

static void test_texts(void)
{
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        reference b = reference_of_text(cases[k].text);
        check_growth(cases[k].what, b.model, cases[k].dimension, cases[k].rank);
        reference_free(&b);
    }
}

static void test_builtins(void)
{
    static const struct {
        const char *name;
        int dimension, rank[MAX_RANKS];
    } systems[] = {{"chaplygin-sleigh", 3, {2, 3}},
                   {"heisenberg", 3, {2, 3}},
                   {"vertical-disk", 4, {2, 3, 4}},
                   {"falling-disk", 5, {3, 4, 5}}};
    for (size_t k = 0; k < sizeof systems / sizeof *systems; k++) {
        reference b = reference_builtin(systems[k].name);
        check_growth(systems[k].name, b.model, systems[k].dimension, systems[k].rank);
        reference_free(&b);
    }
}

/* Axle i is at the angle ai and follows axle i - 1 at the distance 1: it does not slip where
 * x' sin ai - y' cos ai + sum over k = 1..i of ak' cos(ai - ak) = 0. */
static void test_trailers(void)
{
    for (int trailers = 0; trailers <= 4; trailers++) {
        char text[4096] = "coordinates: [x, y, a0";
        char *end = text + strlen(text), *const stop = text + sizeof text;
        int rank[MAX_RANKS] = {0};
#define WRITE(...) end += snprintf(end, (size_t)(stop - end), __VA_ARGS__)
        for (int i = 1; i <= trailers; i++) WRITE(", a%d", i);
        WRITE("]\nlagrangian: (x'^2 + y'^2 + a0'^2");
        for (int i = 1; i <= trailers; i++) WRITE(" + a%d'^2", i);
        WRITE(")/2\nconstraints:\n");
        for (int i = 0; i <= trailers; i++) {
            WRITE("  - x'*sin(a%d) - y'*cos(a%d)", i, i);
            for (int k = 1; k <= i; k++) WRITE(" + a%d'*cos(a%d - a%d)", k, i, k);
            WRITE("\n");
        }
#undef WRITE
        for (int k = 0; k <= trailers + 1; k++) rank[k] = k + 2;
        reference b = reference_of_text(text);
        check_growth("trailers", b.model, trailers + 3, rank);
        reference_free(&b);
    }
}

/* z' - k y x' is integrable for k = 0 alone. */
static void test_parameters(void)
{
    reference b = reference_of_text(PLANE "parameters: {k: 1}\nconstraints: [z' - k*y*x']\n");
    dal_growth found;
    for (int k = 0; k < 2; k++) {
        const dal_setting set = {"k", k};
        CU_ASSERT_EQUAL(dal_model_growth(b.model, &set, 1, NULL, &found, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(found.levels, k + 1);
    }
    CU_ASSERT_EQUAL(dal_model_growth(b.model, &(dal_setting){"l", 1.0}, 1, NULL, &found, NULL),
                    DAL_STATUS_NAME);
    reference_free(&b);
}

static void test_refused(void)
{
    dal_growth found;
    reference b =
        reference_of_text(PLANE "constraints: [x'^2 + y'^2 - z'^2]\nstart: {x': 1, z': 1}");
    CU_ASSERT_EQUAL(dal_model_growth(b.model, NULL, 0, NULL, &found, NULL), DAL_STATUS_UNSUPPORTED);
    reference_free(&b);
    b = reference_of_text(PLANE);
    CU_ASSERT_EQUAL(dal_model_growth(b.model, NULL, 0, NULL, &found, NULL), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_model_growth(NULL, NULL, 0, NULL, &found, NULL), DAL_STATUS_ARGUMENT);
    reference_free(&b);
}

/* Rows that differ by 1e-10 are dependent in units of 1, though y is so light that each holds; in
 * units of 1e10 of y they are not, and allow a straight line. */
static void test_dependent(void)
{
    reference b = reference_of_text("coordinates: [x, y, z]\n"
                                    "lagrangian: (x'^2 + 1e-20*y'^2 + z'^2)/2\n"
                                    "constraints: [x' - z', \"x' - z' + 1e-10*y'\"]\n");
    const double units[] = {1.0, 1.0, 1e10, 1.0};
    dal_error error = {0};
    dal_growth found;
    CU_ASSERT_EQUAL(dal_model_growth(b.model, NULL, 0, NULL, &found, &error), DAL_STATUS_SINGULAR);
    CU_ASSERT_STRING_EQUAL(error.message, "the constraints are dependent about the start");
    CU_ASSERT_EQUAL(dal_model_growth(b.model, NULL, 0, units, &found, NULL), DAL_STATUS_OK);
    CU_ASSERT(found.dimension == 3 && found.levels == 1 && found.rank[0] == 1);
    reference_free(&b);
}

/* Constraints by themselves: which are integrable, alone or with a factor; which only look so. */
static void test_rows(void)
{
    static const struct {
        const char *text;
        bool integrable[2];
    } systems[] = {
        {PLANE "constraints: [x*x' + y*y', z' - y*x']\nstart: {x: 1}\n", {true, false}},
        {PLANE "constraints: [z' - y*x', y']\n", {false, true}}, /* together they are */
        {PLANE "constraints: [exp(x)*(y*x' + x*y'), y*x' - x*y' + z']\nstart: {y: 1}\n",
         {true, false}},
        {PLANE "constraints: [y' - t*x' - x, z' - t*x']\n", {true, false}},
        {PLANE "holonomic: [x^2 + y^2 - 1]\nconstraints: [z' - y*x']\nstart: {x: 1}\n",
         {false, true}},
        {PLANE "constraints: [z'^2 + 1 - 2*y', x*y' + y*x' - z']\nstart: {z': 1, y': 1}\n",
         {false, true}},
    };
    for (size_t k = 0; k < sizeof systems / sizeof *systems; k++) {
        reference b = reference_of_text(systems[k].text);
        dal_growth found;
        for (int a = 0; a < 2; a++) {
            const bool is_linear =
                dal_model_growth_of(b.model, a, NULL, 0, NULL, &found, NULL) == DAL_STATUS_OK;
            CU_ASSERT_EQUAL(is_linear && found.is_complete && found.levels == 1,
                            systems[k].integrable[a]);
            CU_ASSERT_EQUAL(is_linear, k < 5 || a == 1);
        }
        CU_ASSERT_EQUAL(dal_model_growth_of(b.model, 2, NULL, 0, NULL, &found, NULL),
                        DAL_STATUS_ARGUMENT);
        reference_free(&b);
    }
}

#define TWO "coordinates: [x, y]\nlagrangian: "
#define ROBOT                                                                                      \
    "coordinates: [x, y, theta, psi]\n"                                                            \
    "lagrangian: (x'^2 + y'^2 + theta'^2 + 3*psi'^2)/2 - 10*sin(psi)\n"                            \
    "constraints: [x' - cos(theta)*psi', y' - sin(theta)*psi']\n"

/* What controls change with the drift: of linear systems by Kalman's rank of (B, AB, ..), otherwise
 * by hand. */
static void test_controls(void)
{
    static const struct {
        const char *what, *text;
        int rank;
    } systems[] = {
        {"two masses and a spring", TWO "(x'^2 + 2*y'^2 - 3*(x - y)^2)/2\ncontrols: [{x: 1}]\n", 4},
        {"a weak push of one, a heavy other",
         TWO "(x'^2 + 2e6*y'^2 - 3*(x - y)^2)/2\ncontrols: [{x: 1e-9}]\n", 4},
        {"without the spring", TWO "(x'^2 + 2*y'^2 - 3*x^2 - y^2)/2\ncontrols: [{x: 1}]\n", 2},
        {"equal ones, pushed equally",
         TWO "(x'^2 + y'^2 - x^2 - y^2 - (x - y)^2)/2\ncontrols: [{x: 1, y: 1}]\n", 2},
        {"a spring that stiffens",
         TWO "(x'^2 + 2*y'^2 - (1 + t)*(x - y)^2)/2\ncontrols: [{x: 1}]\n", 4},
        {"no force at all", TWO "(x'^2 + y'^2)/2\ncontrols: [{x: 0}]\n", 0},
        {"a pendulum in the plane",
         TWO "(x'^2 + y'^2)/2 - y\nholonomic: [x^2 + y^2 - 1]\nstart: {x: 1}\n"
             "controls: [{x: 1}]\n",
         2},
        /* linearised at rest a chain of springs, whose rank is full */
        {"a chain of 40",
         "sizes: {N: 40}\ncoordinates: [\"x[1..N]\"]\n"
         "lagrangian: sum(i, 1, N, x[i]'^2)/2 + sum(i, 1, N - 1, cos(x[i + 1] - x[i]))\n"
         "controls: [{\"x[1]\": 1}]\n",
         80},
        {"mobile robot", ROBOT "controls: [{theta: 1}, {psi: 1}]\n", 6},
        {"that turns by itself", ROBOT "controls: [{psi: 1}]\n", 4}, /* theta' stays */
        /* the speed along the blade stays */
        {"sleigh with a torque",
         "coordinates: [x, y, phi]\nlagrangian: (x'^2 + y'^2 + phi'^2)/2\n"
         "constraints: [x'*sin(phi) - y'*cos(phi)]\ncontrols: [{phi: 1}]\n",
         4},
        {"a force that is 0 on D = 0 alone",
         PLANE "forces: {y: x'*z}\nconstraints: [x']\ncontrols: [{z: 1}]\n", 2},
    };
    double units[1 + 80];
    for (int i = 0; i < 81; i++) units[i] = 1.0;
    for (size_t k = 0; k < sizeof systems / sizeof *systems; k++) {
        const dal_system *system;
        dal_model *model = fixture_model(systems[k].text);
        int rank = -2;
        CU_ASSERT_EQUAL(dal_model_set_effort(model, DAL_EFFORT_CONTROLS, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal__controlled_rank(model, NULL, 0, units, &rank, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(rank, systems[k].rank);
        if (rank != systems[k].rank) printf("\n  %s: %d", systems[k].what, rank);
        dal_model_free(model);
    }
}

/* Neither an unknown parameter nor an F that is nowhere finite has a rank. */
static void test_refused_controls(void)
{
    static const struct {
        const char *text;
        dal_setting parameter;
        dal_status status;
    } refused[] = {
        {"coordinates: [x]\nlagrangian: x'^2/2\ncontrols: [{x: 1}]\n", {"l", 1.0}, DAL_STATUS_NAME},
        {"coordinates: [x]\nparameters: {l: 1}\nlagrangian: x'^2/2\n"
         "forces: {x: sqrt(-1 - x^2)}\ncontrols: [{x: 1}]\n",
         {"l", 1.0},
         DAL_STATUS_NOT_FINITE},
    };
    const double units[] = {1.0, 1.0, 1.0};
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
        const dal_system *system;
        dal_model *model = fixture_model(refused[k].text);
        int rank = 0;
        CU_ASSERT_EQUAL(dal_model_set_effort(model, DAL_EFFORT_CONTROLS, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal__controlled_rank(model, &refused[k].parameter, 1, units, &rank, NULL),
                        refused[k].status);
        CU_ASSERT_EQUAL(rank, -1);
        dal_model_free(model);
    }
}

void suite_growth(void)
{
    CU_pSuite suite = CU_add_suite("growth vectors", NULL, NULL);
    CU_add_test(suite, "distributions of theory", test_texts);
    CU_add_test(suite, "built-in systems", test_builtins);
    CU_add_test(suite, "a car with trailers", test_trailers);
    CU_add_test(suite, "parameters", test_parameters);
    CU_add_test(suite, "constraints by themselves", test_rows);
    CU_add_test(suite, "controls with drift", test_controls);
    CU_add_test(suite, "refusals", test_refused);
    CU_add_test(suite, "dependent constraints", test_dependent);
    CU_add_test(suite, "controls that are refused", test_refused_controls);
}
