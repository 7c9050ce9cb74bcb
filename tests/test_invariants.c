/* test_invariants.c - invariants and measures of motions for which they are known. */
#include "allocation.h"
#include "core/svd.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- singular values ---- */

static double product(int count, const double *x, const double *y)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) sum += x[i] * y[i];
    return sum;
}

static void test_hilbert(void)
{
    /* eigenvalues of the Hilbert matrix of order 3, roots of 2160 z^3 - 3312 z^2 + 381 z - 1 */
    double a[9], value[3], vector[9];
    for (int i = 0; i < 9; i++) a[i] = 1.0 / (1 + i / 3 + i % 3);
    CU_ASSERT_FATAL(dal__singular_values(3, 3, a, value, vector));
    for (int i = 0; i < 3; i++) {
        const double z = value[i];
        CU_ASSERT(fabs(((2160.0 * z - 3312.0) * z + 381.0) * z - 1.0) < 1e-12);
        CU_ASSERT(i == 0 || value[i] < value[i - 1]);
        for (int j = 0; j < 3; j++)
            CU_ASSERT(fabs(product(3, vector + 3 * i, vector + 3 * j) - (i == j)) < 1e-14);
    }
}

/* Columns (1, e, 0) and (1, 0, e): sqrt(2 + e^2) with (1, 1), e with (1, -1) (Laeuchli 1961). */
static void test_nearly_dependent(void)
{
    const double e = 1e-9;
    double a[] = {1.0, e, 0.0, 1.0, 0.0, e}, value[2], vector[4];
    CU_ASSERT_FATAL(dal__singular_values(3, 2, a, value, vector));
    CU_ASSERT(fabs(value[0] - sqrt(2.0)) < 1e-15);
    CU_ASSERT(fabs(value[1] - e) < 1e-15);
    CU_ASSERT(fabs(vector[2] + vector[3]) < 1e-6);
}

/* ---- what is found ---- */

/* A model with its system, from YAML text or a built-in name. */
static dal_model *open_model(const char *text, dal_run_spec *spec)
{
    dal_model *model = fixture_model(text);
    dal_error error = {0};
    *spec = (dal_run_spec){.options = dal_options_default()};
    const dal_status status = dal_model_system(model, &spec->system, &error);
    if (status != DAL_STATUS_OK) printf("\n  %s\n", error.message);
    CU_ASSERT_EQUAL_FATAL(status, DAL_STATUS_OK);
    return model;
}

static dal_invariants *find(const char *text, const dal_invariants_settings *settings,
                            const dal_setting *parameter)
{
    dal_run_spec spec;
    dal_model *model = open_model(text, &spec);
    dal_invariants *found = NULL;
    dal_error error = {0};
    spec.parameters = parameter;
    spec.parameter_count = parameter != NULL;
    const dal_status status = dal_find_invariants(&found, model, &spec, settings, &error);
    if (status != DAL_STATUS_OK) printf("\n  %s\n", error.message);
    CU_ASSERT_EQUAL_FATAL(status, DAL_STATUS_OK);
    dal_model_free(model); /* what was found is independent of it */
    return found;
}

/* The invariant with this formula; NULL, and a failed test, where there is none. */
static const dal_invariant *with_formula(const dal_invariants *found, const char *formula)
{
    for (int i = 0; i < found->count; i++)
        if (strcmp(found->invariant[i].formula, formula) == 0) return &found->invariant[i];
    printf("\n  no %s, but", formula);
    for (int i = 0; i < found->count; i++) printf("  %s", found->invariant[i].formula);
    CU_FAIL("an invariant is not found");
    return NULL;
}

/* It is there, exact and for any parameters. */
static void has(const dal_invariants *found, const char *formula)
{
    const dal_invariant *i = with_formula(found, formula);
    CU_ASSERT(i && i->exact && i->at_any_parameters);
}

static void has_size(const dal_invariants *found, int count, int independent)
{
    CU_ASSERT_EQUAL(found->count, count);
    CU_ASSERT_EQUAL(found->independent, independent);
    CU_ASSERT(isnan(found->largest_zero) == (count == 0));
    CU_ASSERT(count == 0 || found->largest_zero < 1e-12);
    CU_ASSERT(isnan(found->least_change) || found->least_change > 1e-7);
}

/* On g = 0 the square of the length is no invariant, and r.r' = 0 is another relation. */
static void test_holonomic(void)
{
    dal_invariants *found = find("coordinates: [x, y, z]\nparameters: {l: 1.25, g: 2}\n"
                                 "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g*z\n"
                                 "holonomic: [x^2 + y^2 + z^2 - l^2]\n"
                                 "start: {x: 0.75, z: -1, y': 1.5}\n",
                                 NULL, NULL);
    has_size(found, 2, 2);
    has(found, "x*y' - y*x'");
    has(found, "2*g*z + x'^2 + y'^2 + z'^2");
    CU_ASSERT_EQUAL(found->products - found->functions, 2);
    dal_invariants_free(found);
}

/* f, f^2 and cos f are nearly dependent near the start; g'' = -sin g whatever f does. */
static void test_nearly_dependent_factors(void)
{
    dal_invariants *found = find("coordinates: [f, g]\n"
                                 "lagrangian: (f'^2 + g'^2)/2 + cos(f) + cos(g) - f^4\n"
                                 "start: {f: 0.3, g: 0.4, f': 0.1, g': 0.5}\n",
                                 NULL, NULL);
    CU_ASSERT_EQUAL(found->count, 1);
    has(found, "2*cos(g) - g'^2");
    dal_invariants_free(found);
}

static void test_published(void)
{
    dal_invariants *found = find("nonholonomic-particle", NULL, NULL);
    has_size(found, 2, 2);
    has(found, "kappa*y^2 + y'^2");
    has(found, "kappa*x^2 + x'^2 + z'^2");
    CU_ASSERT_EQUAL(found->atoms, 5);
    CU_ASSERT_STRING_EQUAL(found->atom[0], "x");
    CU_ASSERT_EQUAL(found->products, 20);
    CU_ASSERT_EQUAL(found->functions, 19); /* D = z' - y x', or the like, is one relation */
    dal_invariants_free(found);
    /* zeta'' = i kappa zeta' with kappa = omega I/(I + m a^2): zeta' - i kappa zeta */
    found = find("turntable-ball", NULL, NULL);
    has(found, "I*omega*x - (I + m*a^2)*y'");
    has(found, "I*omega*y + (I + m*a^2)*x'");
    has(found, "x'^2 + y'^2");
    has(found, "s3'");
    CU_ASSERT_EQUAL(found->independent, 4);
    dal_invariants_free(found);
    /* The horizontal gauge momentum of the snakeboard, Balseiro and Sansonetto 2021: its square is
     * m v^2 - (m l^2 - Jr) psi' (2 theta' + psi') less a multiple of (theta' + psi')^2. */
    found = find("snakeboard", NULL, NULL);
    has(found, "m*x'^2 + m*y'^2 + (2*Jr - 2*m*l^2)*theta'*psi' + (Jr - m*l^2)*psi'^2");
    CU_ASSERT_EQUAL(found->independent, 3);
    dal_invariants_free(found);
}

static void test_degree(void)
{
    dal_invariants_settings settings = dal_invariants_settings_default();
    dal_invariants *found = find("contact-oscillator", &settings, NULL);
    has_size(found, 1, 1);
    has(found, "y^2 + y'^2");
    dal_invariants_free(found);
    settings.degree = 4; /* with the square of it, and with E, which has x^2 z^2 */
    found = find("contact-oscillator", &settings, NULL);
    has_size(found, 3, 2);
    has(found, "x^2 + z^2 + x'^2 + z'^2 + eps*x^2*z^2");
    dal_invariants_free(found);
}

/* Two oscillators have further invariants where their frequencies are one. */
static const char two_oscillators[] =
    "coordinates: [x, y]\nparameters: {m: 2, k: 3, c: 3}\n"
    "lagrangian: m/2*(x'^2 + y'^2) - k/2*x^2 - c/2*y^2\nstart: {x: 1, y': 1}\n";

static void test_resonance(void)
{
    dal_invariants *found = find(two_oscillators, NULL, NULL);
    has_size(found, 4, 3);
    has(found, "k*x^2 + m*x'^2");
    const dal_invariant *i = with_formula(found, "x*y' - y*x'");
    CU_ASSERT(i && i->exact && !i->at_any_parameters);
    dal_invariants_free(found);
    found = find(two_oscillators, NULL, &(dal_setting){"c", 3.5});
    has_size(found, 2, 2);
    has(found, "k*x^2 + m*x'^2");
    has(found, "c*y^2 + m*y'^2");
    CU_ASSERT(found->invariant[0].is_new && !found->invariant[1].is_new); /* E is their sum */
    dal_invariants_free(found);
}

/* A parameter that is 0 may take the invariant away. */
static void test_without_damping(void)
{
    static const char text[] = "coordinates: [x]\nparameters: {c: 0}\n"
                               "accelerations: {x: -x - c*x'}\nstart: {x: 1}\n";
    dal_invariants *found = find(text, NULL, NULL);
    has_size(found, 1, 1);
    const dal_invariant *i = with_formula(found, "x^2 + x'^2");
    CU_ASSERT(i && i->exact && i->is_new && !i->at_any_parameters);
    dal_invariants_free(found);
    found = find(text, NULL, &(dal_setting){"c", 0.5});
    has_size(found, 0, 0);
    dal_invariants_free(found);
}

/* What constraints conserve whatever the forces, and which of them does. */
static void test_of_coordinates(void)
{
#define MASSES "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - z\n"
    static const struct {
        const char *text, *formula;
        int degree, constraint;
        double value;
    } cases[] = {
        {MASSES "constraints: [x*x' + y*y' + z*z']\nstart: {x: 1, z: 2}\n", "x^2 + y^2 + z^2", 2, 0,
         5.0},
        {MASSES "constraints: [z' - y*x', exp(x)*(x*x' + y*y')]\nstart: {x: 1, y: 2}\n",
         "x^2 + y^2", 2, 1, 5.0},
        {MASSES "constraints: [y' - t*x' - x]\nstart: {y: 3}\n", "y - x*t", 2, 0, 3.0},
        {MASSES "constraints: [z' - cos(x)*x']\nstart: {z: -1}\n", "z - sin(x)", 1, 0, -1.0},
        {MASSES "constraints: [z' - 2*x' - y', y' - z*x' - x*z']\nstart: {z: -1}\n", "y - x*z", 2,
         1, 0.0},
        {MASSES "constraints: [z' - y*x', y' - z*x']\nstart: {y: 2}\n", "y^2 - z^2", 2, -1, 4.0},
        {MASSES "holonomic: [x^2 + y^2 - 1]\nconstraints: [z' - 2*x']\nstart: {x: 1}\n", "2*x - z",
         2, 0, 2.0},
        /* One product, whose rate is rounding alone. */
        {MASSES "constraints: [2*y*z*x' + x*z*y' + x*y*z']\nstart: {x: 1, y: 2, z: 1}\n", "x^2*y*z",
         4, 0, 2.0},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const dal_invariants_settings settings = {.degree = cases[k].degree,
                                                  .of_coordinates = true};
        dal_invariants *found = find(cases[k].text, &settings, NULL);
        const dal_invariant *i = with_formula(found, cases[k].formula);
        CU_ASSERT(i && i->constraint == cases[k].constraint);
        if (i) CU_ASSERT_DOUBLE_EQUAL(i->value, cases[k].value, 1e-15);
        dal_invariants_free(found);
    }
    const dal_invariants_settings all = {.degree = 4, .of_coordinates = true};
    dal_invariants *found = find(MASSES "constraints: [z' - y*x']\n", &all, NULL);
    has_size(found, 0, 0);
    dal_invariants_free(found);
#undef MASSES
}

/* Where F is finite nowhere with another k nothing is known of other parameters. */
static void test_one_parameter(void)
{
    dal_invariants *found =
        find("coordinates: [x, y]\nparameters: {k: 1}\nlet: {s: sqrt(1.1 - k^2)}\n"
             "accelerations: {x: -x*s, y: -y*s}\nstart: {x: 1}\n",
             NULL, NULL);
    const dal_invariant *i = with_formula(found, "x*y' - y*x'");
    CU_ASSERT(i && i->exact && !i->at_any_parameters);
    dal_invariants_free(found);
}

/* Kepler's problem: E needs 1/r, which is no coordinate. */
static void test_further_atoms(void)
{
    static const char text[] = "coordinates: [x, y]\nparameters: {mu: 1.5}\n"
                               "lagrangian: (x'^2 + y'^2)/2 + mu/hypot(x, y)\n"
                               "start: {x: 1, y': 1}\n";
    const char *const with[] = {"1/hypot(x, y)"};
    dal_invariants_settings settings = dal_invariants_settings_default();
    dal_invariants *found = find(text, &settings, NULL);
    has_size(found, 1, 1);
    has(found, "x*y' - y*x'");
    dal_invariants_free(found);
    settings.with = with;
    settings.with_count = 1;
    found = find(text, &settings, NULL);
    has_size(found, 2, 2);
    has(found, "2*mu*(1/hypot(x, y)) - x'^2 - y'^2");
    dal_invariants_free(found);
    const char *const names[] = {"hypot(x, y)", "1/x", "sin(x)*cos(y)", "(x + y)^3"};
    const char *const atoms[] = {"hypot(x, y)", "(1/x)", "(sin(x)*cos(y))", "((x + y)^3)"};
    settings = (dal_invariants_settings){.degree = 1, .with = names, .with_count = 4};
    found = find(text, &settings, NULL);
    CU_ASSERT_EQUAL_FATAL(found->atoms, 4 + 4);
    for (int i = 0; i < 4; i++) CU_ASSERT_STRING_EQUAL(found->atom[4 + i], atoms[i]);
    dal_invariants_free(found);
}

/* x = A cos 2t + free motion, A = -a/3; cos 2t and sin 2t are atoms. */
static void test_of_time(void)
{
    dal_invariants *found =
        find("coordinates: [x]\nparameters: {a: 3}\naccelerations: {x: -x + a*cos(2*t)}\n"
             "start: {x: 1}\n",
             NULL, NULL);
    has_size(found, 1, 1);
    CU_ASSERT(found->invariant[0].exact && found->invariant[0].at_any_parameters);
    CU_ASSERT_PTR_NOT_NULL(strstr(found->invariant[0].formula, "*x*cos(2*t)"));
    dal_invariants_free(found);
}

/* An atom of 1.67e-27 kg with 500 N/m, in metres and seconds. */
static void test_units(void)
{
    dal_invariants *found =
        find("coordinates: [x, y]\nparameters: {m: 1.67e-27, k: 500}\n"
             "lagrangian: m/2*(x'^2 + y'^2) - k/2*(x^2 + 2*y^2)\nstart: {x: 1e-11, y: 1e-11}\n",
             NULL, NULL);
    has_size(found, 2, 2);
    has(found, "k*x^2 + m*x'^2");
    has(found, "2*k*y^2 + m*y'^2");
    dal_invariants_free(found);
}

/* ---- none is invented ---- */

static double draw(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / (1 << 24) - 0.5;
}

/* Forces without potential, and a constraint, with random coefficients: no polynomial of degree 2
 * is conserved. */
static void test_random_systems(void)
{
    unsigned state = 1;
    for (int k = 0; k < long_run(100); k++) {
        char text[1024];
        double c[16];
        for (int i = 0; i < 16; i++) c[i] = draw(&state);
        snprintf(text, sizeof text,
                 "coordinates: [x, y, z]\n"
                 "lagrangian: (x'^2 + y'^2 + z'^2)/2 - x^2 - y^2 - z^2 + %.3f*x*y^2 + %.3f*z^4\n"
                 "forces: {x: %.3f*y + %.3f*z*x', y: %.3f*z + %.3f*x*z', z: %.3f*x + %.3f*y*x'}\n"
                 "constraints: [x'*(1 + %.3f*y) + %.3f*y' + z'*(%.3f + %.3f*x^2)]\n"
                 "start: {x: 1, y: 0.5}\n",
                 c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10], c[11]);
        dal_invariants *found = find(text, NULL, NULL);
        has_size(found, 0, 0);
        dal_invariants_free(found);
    }
}

/* ---- measures ---- */

static void test_measures(void)
{
    dal_invariants_settings settings = dal_invariants_settings_default();
    settings.measures = true;
    static const struct {
        const char *system, *formula;
        double power;
    } known[] = {{"nonholonomic-particle", "1 + y^2", 2.0},
                 {"contact-oscillator", "1 + y^2", 2.0},
                 {"vertical-disk", "1", 1.0}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        dal_invariants *found = find(known[i].system, &settings, NULL);
        CU_ASSERT_FATAL(found->measures == 1);
        CU_ASSERT_STRING_EQUAL(found->measure->formula, known[i].formula);
        CU_ASSERT_EQUAL(found->measure->power, known[i].power);
        CU_ASSERT(found->measure->exact && found->measure->at_any_parameters);
        dal_invariants_free(found);
    }
    /* Friction shrinks every volume. */
    dal_invariants *found = find("damped-oscillator", &settings, NULL);
    CU_ASSERT_EQUAL(found->measures, 0);
    dal_invariants_free(found);
}

/* ---- what is refused ---- */

static void refused(const char *text, const dal_invariants_settings *settings, dal_status status,
                    const char *fragment)
{
    dal_run_spec spec;
    dal_model *model = open_model(text, &spec);
    dal_invariants *found = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_find_invariants(&found, model, &spec, settings, &error), status);
    if (!strstr(error.message, fragment)) printf("\n  %s\n", error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
    CU_ASSERT_PTR_NULL(found);
    dal_model_free(model);
}

static void test_refused(void)
{
    dal_invariants_settings settings = {.degree = 0};
    refused("knife-edge", &settings, DAL_STATUS_ARGUMENT, "degree: 0 is not in 1..8");
    settings.degree = 9;
    refused("knife-edge", &settings, DAL_STATUS_ARGUMENT, "degree: 9");
}

/* F is finite, but not k x^2 + m x'^2, or what the system declares as conserved. */
static void test_not_finite(void)
{
    refused("coordinates: [x]\nparameters: {m: 1e304, k: 1e304}\n"
            "lagrangian: m/2*x'^2 - k/2*x^2\nstart: {x: 1000}\n",
            NULL, DAL_STATUS_NOT_FINITE, "there are no points of D = 0 near the start");
    refused("coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n"
            "invariants: {c: sqrt(-1 - x^2)}\n",
            NULL, DAL_STATUS_NOT_FINITE, "there are no points of D = 0 near the start");
}

/* A model without a system: its mass matrix is singular. */
static void test_no_system(void)
{
    dal_model *model = fixture_model("coordinates: [x, y]\nlagrangian: x'^2/2\n");
    const dal_run_spec spec = {.system = fixture_system("knife-edge")};
    dal_invariants *found = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_find_invariants(&found, model, &spec, NULL, &error),
                    DAL_STATUS_SINGULAR_MASS);
    CU_ASSERT_PTR_NULL(found);
    dal_model_free(model);
}

static void test_bad_atoms(void)
{
    dal_run_spec spec;
    dal_model *model = open_model("knife-edge", &spec);
    dal_invariants *found = NULL;
    dal_error error = {0};
    const char *const unknown[] = {"x", "2*width"}, *const broken[] = {"x +"};
    dal_invariants_settings settings = dal_invariants_settings_default();
    settings.with = unknown;
    settings.with_count = 2;
    CU_ASSERT_EQUAL(dal_find_invariants(&found, model, &spec, &settings, &error), DAL_STATUS_NAME);
    CU_ASSERT(error.line == 2 && error.column == 3 && strstr(error.message, "'width'"));
    settings.with = broken;
    settings.with_count = 1;
    CU_ASSERT_EQUAL(dal_find_invariants(&found, model, &spec, &settings, &error),
                    DAL_STATUS_SYNTAX);
    settings.with_count = 0;
    CU_ASSERT_EQUAL(dal_find_invariants(&found, model, &spec, &settings, &error), DAL_STATUS_OK);
    dal_invariants_free(found);
    dal_model_free(model);
}

static void test_too_large(void)
{
    dal_invariants_settings settings = dal_invariants_settings_default();
    settings.degree = 5;
    dal_run_spec spec;
    dal_model *model = open_model("chaotic-oscillators", &spec);
    dal_invariants *found = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_find_invariants(&found, model, &spec, &settings, &error),
                    DAL_STATUS_TOO_LARGE);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "14 atoms"));
    dal_model_free(model);
    model = open_model("coordinates: [x]\naccelerations: {x: sqrt(-1 - x^2)}\n", &spec);
    CU_ASSERT_EQUAL(dal_find_invariants(&found, model, &spec, NULL, &error), DAL_STATUS_NOT_FINITE);
    dal_model_free(model);
    settings = dal_invariants_settings_default();
    settings.measures = true;
    model = open_model("chaplygin-sleigh-vakonomic", &spec);
    CU_ASSERT_EQUAL(dal_find_invariants(&found, model, &spec, &settings, &error),
                    DAL_STATUS_UNSUPPORTED);
    dal_model_free(model);
}

static const char on_a_line[] = "coordinates: [x, y]\nparameters: {k: 2}\n"
                                "lagrangian: (x'^2 + y'^2 - k*y^2)/2\n"
                                "constraints: [\"y' - k*x'\"]\nstart: {y: 1}\n";
/* With multipliers, and angles of a sum. */
static const char vakonomic[] = "coordinates: [x, y]\nmechanics: vakonomic\n"
                                "lagrangian: (x'^2 + y'^2)/2 + cos(x - y)\n"
                                "constraints: [y' - x']\nstart: {x': 1, y': 1}\n";

static void fail_allocations(const char *text, const dal_invariants_settings *settings, int least)
{
    allocation_trial trial = {0};
    int found_last = 0;
    while (allocation_next(&trial)) {
        dal_run_spec spec;
        dal_model *model = open_model(text, &spec);
        dal_invariants *found = NULL;
        allocation_start(&trial);
        allocation_end(&trial, dal_find_invariants(&found, model, &spec, settings, NULL));
        found_last = found ? found->count : 0;
        dal_invariants_free(found);
        dal_model_free(model);
    }
    CU_ASSERT(trial.failures >= 30);
    CU_ASSERT(found_last >= least);
}

/* With nothing found, with y - k x, and with its constraint; with multipliers; with a further
 * atom. */
static void test_out_of_memory(void)
{
    fail_allocations(on_a_line, &(dal_invariants_settings){.degree = 1, .measures = true}, 0);
    fail_allocations(on_a_line, &(dal_invariants_settings){.degree = 2}, 1);
    fail_allocations(on_a_line, &(dal_invariants_settings){.degree = 1, .of_coordinates = true}, 1);
    fail_allocations(vakonomic, &(dal_invariants_settings){.degree = 1}, 0);
    static const char *const with[] = {"x*y"};
    fail_allocations(on_a_line,
                     &(dal_invariants_settings){.degree = 1, .with = with, .with_count = 1}, 0);
}

void suite_invariants(void)
{
    CU_pSuite suite = CU_add_suite("invariants", NULL, NULL);
    CU_add_test(suite, "singular values: Hilbert's matrix", test_hilbert);
    CU_add_test(suite, "singular values: nearly dependent columns", test_nearly_dependent);
    CU_add_test(suite, "published invariants", test_published);
    CU_add_test(suite, "invariants on g = 0", test_holonomic);
    CU_add_test(suite, "factors that are nearly dependent", test_nearly_dependent_factors);
    CU_add_test(suite, "degree 4", test_degree);
    CU_add_test(suite, "equal frequencies", test_resonance);
    CU_add_test(suite, "a parameter that is 0", test_without_damping);
    CU_add_test(suite, "parameters with no other values", test_one_parameter);
    CU_add_test(suite, "further atoms", test_further_atoms);
    CU_add_test(suite, "functions of coordinates", test_of_coordinates);
    CU_add_test(suite, "invariants of time", test_of_time);
    CU_add_test(suite, "atomic units", test_units);
    CU_add_test(suite, "none of 100 random systems", test_random_systems);
    CU_add_test(suite, "measures", test_measures);
    CU_add_test(suite, "degrees that are refused", test_refused);
    CU_add_test(suite, "formulas that are not finite", test_not_finite);
    CU_add_test(suite, "a model without a system", test_no_system);
    CU_add_test(suite, "atoms that are refused", test_bad_atoms);
    CU_add_test(suite, "too large, not finite, unsupported", test_too_large);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
