/* test_pivots.c - what a model finds out about its formulas: pivots that vanish on the way, guards,
 * degrees of constraints, fate of the energy. */
#include "reference.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* ---- pivots ---- */

/* W = (1 cos z; cos z 1) is singular where sin z = 0; its second pivot is 1 - cos^2 z. */
static const char mass_text[] = "coordinates: [x, y, z]\n"
                                "lagrangian: (x'^2 + y'^2 + z'^2)/2 + cos(z)*x'*y'\n"
                                "start: {z: 1}\n";

/* Dependent rows of A where z = pi/4. */
static const char parallel_text[] = "coordinates: [x, y, z]\n"
                                    "lagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                                    "constraints: [x' + y', cos(z)*x' + sin(z)*y']\n"
                                    "start: {z: 0.2}\n";

static int count_nan(int count, const double *x)
{
    int nan = 0;
    for (int i = 0; i < count; i++) nan += isnan(x[i]) != 0;
    return nan;
}

static dal_status diagnosis(const reference *b, double z, double *which)
{
    double q[] = {0.1, 0.2, z}, v[] = {0.3, -0.4, 0.5};
    return reference_call(b, b->system->diagnose, 0.0, q, v, which);
}

/* 1 - cos^2 z is z^2: at 1e-8 nothing of it is left, at 1e-4 eight digits are. */
static void test_singular_mass(void)
{
    reference b = reference_of_text(mass_text);
    double v[] = {0.3, -0.4, 0.5}, out[18], which;
    double bad[] = {0.1, 0.2, 1e-8}, good[] = {0.1, 0.2, 1e-4};
    reference_call(&b, b.system->call.field, 0.0, bad, v, out);
    CU_ASSERT(count_nan(3, out) == 3);
    reference_call(&b, b.system->call.jacobian, 0.0, bad, v, out);
    CU_ASSERT(count_nan(18, out) == 18);
    reference_pull(&b, 0.0, bad, v, v, out);
    CU_ASSERT(count_nan(9, out) == 9);
    reference_call(&b, b.system->call.field, 0.0, good, v, out);
    CU_ASSERT(count_nan(3, out) == 0);
    CU_ASSERT(diagnosis(&b, 1e-8, &which) == DAL_STATUS_SINGULAR_MASS);
    CU_ASSERT(diagnosis(&b, 1e-4, &which) == DAL_STATUS_OK);
    reference_free(&b);
}

/* A parameter may take the mass away. */
static void test_massless(void)
{
    reference b = reference_builtin("chaplygin-sleigh");
    double which;
    CU_ASSERT(diagnosis(&b, 0.2, &which) == DAL_STATUS_OK);
    reference_set(&b, "I", 0.0);
    CU_ASSERT(diagnosis(&b, 0.2, &which) == DAL_STATUS_SINGULAR_MASS);
    reference_free(&b);
}

static void test_dependent_constraints(void)
{
    reference b = reference_of_text(parallel_text);
    double which = 0.0;
    CU_ASSERT(diagnosis(&b, 0.2, &which) == DAL_STATUS_OK);
    CU_ASSERT(diagnosis(&b, atan(1.0), &which) == DAL_STATUS_SINGULAR && which == 2.0);
    reference_free(&b);
}

static void test_singular_lane(void)
{
    reference b = reference_of_text(mass_text);
    _Alignas(64) double out[3 * 4];
    _Alignas(64) double q[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1e-8, 0.5, 2};
    _Alignas(64) double v[] = {1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    for (int i = (int)b.system->workspace; i-- > 0;)
        for (int lane = 4; lane-- > 0;) b.work[4 * i + lane] = b.work[i];
    if (b.system->wide4) reference_call(&b, b.system->wide4->field, 0.0, q, v, out);
    for (int i = 0; b.system->wide4 && i < 3; i++) {
        CU_ASSERT(isnan(out[4 * i + 1]));
        CU_ASSERT(isfinite(out[4 * i]) && isfinite(out[4 * i + 2]) && isfinite(out[4 * i + 3]));
    }
    reference_free(&b);
}

static void check_diagnosis(const char *system, const double *q, const double *v)
{
    reference b = reference_builtin(system);
    double which = 0.0, F[3];
    reference_call(&b, b.system->call.field, 0.0, q, v, F);
    CU_ASSERT(!isfinite(F[0]) || !isfinite(F[1]) || !isfinite(F[2]));
    CU_ASSERT(reference_call(&b, b.system->diagnose, 0.0, q, v, &which) == DAL_STATUS_SINGULAR);
    CU_ASSERT(which == 1.0);
    reference_free(&b);
}

static void test_singular_systems(void)
{
    check_diagnosis("appell-hamel", (double[]){0, 0, 0}, (double[]){0, 0, 0});
    check_diagnosis("chaplygin-sleigh-nonlinear", (double[]){1, 1, 0}, (double[]){0, 1, 1});
}

/* A is regular here, but D_q v is not: no pivot shows it. */
static void test_singular_rate(void)
{
    reference b = reference_of_text("coordinates: [x, y, z]\n"
                                    "lagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                                    "constraints: [x' + z', y' - sqrt(x)]\n"
                                    "start: {x: 1}\n");
    double q[] = {0, 0, 0}, v[] = {1, 0, -1}, which = 0.0;
    CU_ASSERT(reference_call(&b, b.system->diagnose, 0.0, q, v, &which) == DAL_STATUS_SINGULAR);
    CU_ASSERT(which == 2.0);
    reference_free(&b);
}

/* Parameters alone, or a first pivot, are not checked: no pivots after the outputs. */
static void test_start_may_be_singular(void)
{
    reference b = reference_of_text("coordinates: [x, y, z]\n"
                                    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - z\n"
                                    "constraints: [(x'^2 + y'^2 - z'^2)/2]\n");
    double q[] = {0, 0, 0}, v[] = {0.6, 0.8, -1}, F[3];
    reference_call(&b, b.system->call.field, 0.0, q, v, F);
    CU_ASSERT(fabs(F[2] + 0.5) < 1e-15); /* falls with g/(1 + nu^2) */
    reference_free(&b);
}

/* A pivot on the diagonal that vanishes at the start is not taken: W = (z 1; 1 0) at z = 0. */
static void test_pivot_order(void)
{
    reference b = reference_of_text("coordinates: [x, y, z]\n"
                                    "lagrangian: z*x'^2/2 + x'*y' + z'^2/2 - x - 2*y\n");
    double q[] = {0, 0, 0}, v[] = {0, 0, 0}, F[3];
    reference_call(&b, b.system->call.field, 0.0, q, v, F);
    CU_ASSERT(F[0] == -2.0 && F[1] == -1.0 && F[2] == 0.0);
    reference_free(&b);
}

/* ---- guards ---- */

static bool has_guard(const reference *b, const char *name)
{
    for (int i = 0; i < b->system->guards; i++)
        if (strcmp(b->system->guard[i], name) == 0) return true;
    return false;
}

static void test_guards(void)
{
    reference b = reference_of_text("coordinates: [x, y]\n"
                                    "parameters: {a: 2}\n"
                                    "lagrangian: (x'^2 + y'^2)/2 + 1/x\n"
                                    "constraints: [x'/(y'*sqrt(t)) + tan(x)/a - (1 + y)^(-65)]\n"
                                    "start: {x': 1, y': 1}\n");
    double q[] = {0.3, -0.2}, v[] = {0.5, 0.7}, out[4], sum = 0.0;
    CU_ASSERT(b.system->guards == 4);
    CU_ASSERT(has_guard(&b, "constraint 1: y'") && has_guard(&b, "constraint 1: t"));
    CU_ASSERT(has_guard(&b, "constraint 1: cos(x)"));
    CU_ASSERT(has_guard(&b, "constraint 1: a denominator"));
    CU_ASSERT(reference_call(&b, b.system->call.guards, 0.9, q, v, out) == DAL_STATUS_OK);
    for (int i = 0; i < 4; i++) sum += out[i];
    CU_ASSERT(fabs(sum - (0.7 + 0.9 + cos(0.3) + 0.8)) < 1e-15);
    reference_free(&b);
}

/* ---- properties ---- */

enum {
    OF_D = DAL_D_LINEAR | DAL_D_CONSTANT | DAL_D_BILINEAR | DAL_D_QUADRATIC | DAL_D_RANK_CHECKED,
    OF_E = DAL_E_EXACT | DAL_E_ON_D,
    STRAIGHT = DAL_D_LINEAR | DAL_D_CONSTANT | DAL_D_BILINEAR | DAL_D_QUADRATIC
};

static const struct {
    const char *constraint;
    unsigned degree, energy;
} constraints[] = {
    {"2*x' - y'", STRAIGHT, DAL_E_ON_D},
    {"2*x' - y' + x - 3", STRAIGHT, 0},
    {"x' - y*y'", DAL_D_LINEAR | DAL_D_BILINEAR | DAL_D_QUADRATIC, DAL_E_ON_D},
    {"x' - y*y' + y^2", DAL_D_LINEAR | DAL_D_QUADRATIC, 0},
    {"x' - t*y'", DAL_D_LINEAR, DAL_E_ON_D},
    {"x' - sin(y)*y'", DAL_D_LINEAR, DAL_E_ON_D},
    {"x'^2 - y'^2", DAL_D_QUADRATIC | DAL_D_RANK_CHECKED, DAL_E_ON_D},
    {"x'^2 + y'^2 - 1", DAL_D_QUADRATIC | DAL_D_RANK_CHECKED, DAL_E_EXACT}, /* free: h = 0 */
    {"x'^2 + y'^2 - 2 + x'", DAL_D_QUADRATIC | DAL_D_RANK_CHECKED, DAL_E_EXACT},
    {"x'^2 + y'^2 - x", DAL_D_QUADRATIC | DAL_D_RANK_CHECKED, 0},
    {"x'^3 - x*y'^3", DAL_D_RANK_CHECKED, DAL_E_ON_D},
    {"sqrt(x'^2 + y'^2) - exp(x)*y'", DAL_D_RANK_CHECKED, DAL_E_ON_D},
    {"atan2(x', y') - x", DAL_D_RANK_CHECKED, DAL_E_EXACT},
};

static void test_constraint_properties(void)
{
    char text[256];
    for (size_t k = 0; k < sizeof constraints / sizeof *constraints; k++) {
        strcpy(text, "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                     "start: {x': 1, y': 2}\nconstraints: [\"");
        strcat(text, constraints[k].constraint);
        strcat(text, "\"]\n");
        reference b = reference_of_text(text);
        CU_ASSERT((b.system->properties & OF_D) == constraints[k].degree);
        CU_ASSERT((b.system->properties & OF_E) == constraints[k].energy);
        reference_free(&b);
    }
}

enum { POSITIONAL = DAL_BLOCKS_POSITIONAL | DAL_F_POSITIONAL };

static const struct {
    const char *rest;
    unsigned properties;
} motions[] = {
    {"lagrangian: (x'^2 + y'^2)/2 - x*y",
     POSITIONAL | DAL_E_EXACT | DAL_AUTONOMOUS | DAL_MASS_CONSTANT},
    {"lagrangian: (x'^2 + y'^2)/2 - x*cos(t)", POSITIONAL | DAL_MASS_CONSTANT},
    {"lagrangian: (x'^2 + (1 + x^2)*y'^2)/2", DAL_E_EXACT | DAL_AUTONOMOUS},
    {"lagrangian: (x'^2 + y'^2)/2\nforces: {x: -x'}", DAL_AUTONOMOUS | DAL_MASS_CONSTANT},
    /* A magnetic force does no work; this is seen by numbers only. */
    {"lagrangian: (x'^2 + y'^2)/2\nforces: {x: exp(x)*y'/x', y: -exp(x)}",
     DAL_E_EXACT | DAL_AUTONOMOUS | DAL_MASS_CONSTANT},
    /* dE/dt = 0.01 sin(x) D: points of D = 0 are found by several steps of Newton's method. */
    {"lagrangian: (x'^2 + y'^2)/2\nforces: {x: \"0.01*sin(x)*(y'^2 + y' - 1)/x'\"}\n"
     "start: {x': 1, y': 0.618}\nconstraints: [\"y'^2 + y' - 1\"]",
     DAL_D_QUADRATIC | DAL_D_RANK_CHECKED | DAL_E_ON_D | DAL_AUTONOMOUS | DAL_MASS_CONSTANT},
    {"accelerations: {x: -x, y: -y}", POSITIONAL | DAL_AUTONOMOUS | DAL_MASS_CONSTANT},
    {"accelerations: {x: -x*t}", POSITIONAL | DAL_MASS_CONSTANT},
    /* A constant: no rate of A, which would be quadratic in v. */
    {"lagrangian: (x'^2 + y'^2)/2 - x*y\nstart: {x': 2, y': 1}\nconstraints: [\"x' - 2*y'\"]",
     DAL_D_LINEAR | DAL_D_CONSTANT | DAL_D_BILINEAR | DAL_D_QUADRATIC | POSITIONAL | DAL_E_ON_D |
         DAL_AUTONOMOUS | DAL_MASS_CONSTANT},
};

static void test_motion_properties(void)
{
    char text[256];
    for (size_t k = 0; k < sizeof motions / sizeof *motions; k++) {
        strcpy(text, "coordinates: [x, y]\n");
        strcat(text, motions[k].rest);
        reference b = reference_of_text(text);
        CU_ASSERT(b.system->properties == (motions[k].properties | DAL_WIDE_TIMES));
        const dal_system *exact = b.system->extended; /* its F has a part of D */
        CU_ASSERT(!exact || exact == b.system || !(exact->properties & DAL_F_POSITIONAL));
        reference_free(&b);
    }
}

/* ---- gauge, start ---- */

static void test_gauge_and_start(void)
{
    reference b = reference_of_text("coordinates: [x, y]\n"
                                    "parameters: {m: 2, k: m/4}\n"
                                    "let: {fast: m*sqrt(k)}\n"
                                    "accelerations: {x: -k*x}\n"
                                    "gauge: {e: 3*k, mu_e: k*cos(t)}\n"
                                    "start: {y: m, x': fast}\n");
    double out[5], expected[] = {0, 2, sqrt(0.5) * 2, 0, 1.5};
    CU_ASSERT(b.system->value[1] == 0.5);
    reference_call(&b, b.system->start, 0.0, NULL, NULL, out);
    CU_ASSERT(reference_distance(5, out, expected) < 1e-15);
    reference_call(&b, b.system->call.gauge, 0.7, expected, expected, out);
    CU_ASSERT(fabs(out[0] - 0.5 * cos(0.7)) < 1e-15);
    reference_free(&b);
}

static void test_start_of_multipliers(void)
{
    reference b = reference_of_text("coordinates: [x, y]\n"
                                    "lagrangian: (x'^2 + y'^2)/2\n"
                                    "constraints: [x' - y']\n"
                                    "mechanics: vakonomic\n"
                                    "gauge: {e: 7}\n"
                                    "start: {y: 2, x': 3, y': 3, g1: 5}\n");
    double out[6], expected[] = {0, 2, 3, 3, 5, 7};
    reference_call(&b, b.system->start, 0.0, NULL, NULL, out);
    CU_ASSERT(reference_distance(6, out, expected) == 0.0);
    reference_free(&b);
}

/* ---- models without YAML, and from a file ---- */

static void test_by_hand(void)
{
    reference sleigh = reference_builtin("chaplygin-sleigh"),
              b = {.model = dal_model_create("by hand")};
    static const struct {
        dal_section section;
        const char *name, *text;
    } entries[] = {
        {DAL_SECTION_CONSTRAINTS, NULL, "y1'*sin(phi) - y2'*cos(phi)"},
        {DAL_SECTION_LAGRANGIAN, NULL, "m/2*(y1'^2 + y2'^2) + I/2*phi'^2"},
        {DAL_SECTION_PARAMETERS, "m", "1"},
        {DAL_SECTION_PARAMETERS, "I", "1"},
        {DAL_SECTION_COORDINATES, NULL, "y1"},
        {DAL_SECTION_COORDINATES, NULL, "y2"},
        {DAL_SECTION_COORDINATES, NULL, "phi"},
    };
    double q[] = {0.1, 0.2, 0.3}, v[] = {0.4, 0.5, 0.6}, work[256] = {1, 1}, F[2][3];
    dal_point at = {.q = q, .v = v, .work = work};
    for (size_t i = 0; i < sizeof entries / sizeof *entries; i++)
        CU_ASSERT(dal_model_add(b.model, entries[i].section, entries[i].name, entries[i].text, 0, 0,
                                NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_model_system(b.model, &b.system, NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(b.system->workspace <= sizeof work / sizeof *work);
    CU_ASSERT_STRING_EQUAL(b.system->name, "by hand");
    b.system->prepare(b.system, &at, NULL);
    b.system->call.field(b.system, &at, F[0]);
    reference_call(&sleigh, sleigh.system->call.field, 0.0, q, v, F[1]);
    CU_ASSERT(memcmp(F[0], F[1], sizeof F[0]) == 0);
    reference_free(&b);
    reference_free(&sleigh);
}

static void test_from_file(void)
{
    reference b = {.work = NULL};
    CU_ASSERT_FATAL(dal_model_read_file(&b.model, "systems/knife-edge.yaml", NULL) ==
                    DAL_STATUS_OK);
    CU_ASSERT(dal_model_system(b.model, &b.system, NULL) == DAL_STATUS_OK);
    CU_ASSERT_STRING_EQUAL(b.system->name, "knife-edge");
    CU_ASSERT_STRING_EQUAL(b.system->title, "Knife edge on an inclined plane");
    CU_ASSERT_STRING_EQUAL(b.system->parameter[3], "alpha");
    CU_ASSERT(b.system->value[3] == 0.5);
    reference_free(&b);
}

void suite_pivots(void)
{
    CU_pSuite suite = CU_add_suite("pivots", NULL, NULL);
    CU_add_test(suite, "singular mass matrix", test_singular_mass);
    CU_add_test(suite, "no mass", test_massless);
    CU_add_test(suite, "dependent constraints", test_dependent_constraints);
    CU_add_test(suite, "one lane of several", test_singular_lane);
    CU_add_test(suite, "singularities of shipped systems", test_singular_systems);
    CU_add_test(suite, "singular rate of a constraint", test_singular_rate);
    CU_add_test(suite, "a start may be singular", test_start_may_be_singular);
    CU_add_test(suite, "order of pivots", test_pivot_order);
    CU_add_test(suite, "guards", test_guards);
    CU_add_test(suite, "degree of D, fate of E", test_constraint_properties);
    CU_add_test(suite, "properties of the motion", test_motion_properties);
    CU_add_test(suite, "gauge and start", test_gauge_and_start);
    CU_add_test(suite, "start of multipliers", test_start_of_multipliers);
    CU_add_test(suite, "a model by hand", test_by_hand);
    CU_add_test(suite, "a model from a file", test_from_file);
}
