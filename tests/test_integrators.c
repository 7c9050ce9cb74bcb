/* test_integrators.c - conformance: what every descriptor properties, on fixtures with
 * time-dependent and velocity-dependent forces, a full q-dependent mass matrix and m = 2. */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* Every integrator that is not a modifier, or, with project, with +project after its name. */
typedef void visitor(const char *name, const dal_method *method, void *user);

static void for_each_of(int stride, bool project, visitor *visit, void *user)
{
    for (int i = 0; dal_integrator_at(i); i += stride) {
        char name[64];
        if (dal_integrator_at(i)->properties & DAL_MODIFIER) continue;
        snprintf(name, sizeof name, "%s%s", dal_integrator_at(i)->name, project ? "+project" : "");
        dal_method method;
        CU_ASSERT_EQUAL_FATAL(dal_method_parse(&method, name, NULL), DAL_STATUS_OK);
        visit(name, &method, user);
    }
}

static void for_each(bool project, visitor *visit, void *user)
{
    for_each_of(1, project, visit, user);
}

/* Each documentation has an equation, closed dollars, and cites the years of the reference. */
static void test_documentation(void)
{
    const dal_integrator *k;
    for (int i = 0; (k = dal_integrator_at(i)); i++) {
        int dollars = 0;
        CU_ASSERT_PTR_NOT_NULL_FATAL(k->documentation);
        for (const char *c = k->documentation; *c; c++) dollars += *c == '$';
        CU_ASSERT(dollars % 2 == 0 && strstr(k->documentation, "$$"));
        for (const char *c = k->reference; *c; c++) {
            char year[5];
            if (strspn(c, "0123456789") != 4) continue;
            snprintf(year, sizeof year, "%.4s", c);
            if (!strstr(k->documentation, year)) printf("\n  %s: %s", k->name, year);
            CU_ASSERT_PTR_NOT_NULL(strstr(k->documentation, year));
            c += 3;
        }
    }
}

/* ---- order: slope between two step counts in the asymptotic range of each order ---- */

typedef struct window {
    int order;
    const char *fixture;
    double T;
    int coarse, fine;
} window;

static const window windows[] = {
    {1, fixture_full, 1.0, 200, 400},   {2, fixture_full, 1.0, 40, 80},
    {4, fixture_full, 1.0, 40, 80},     {6, fixture_full, 3.0, 54, 82},
    {8, fixture_gentle, 20.0, 46, 82},  {10, fixture_gentle, 10.0, 14, 25},
    {12, fixture_gentle, 20.0, 16, 25},
};

static const window *window_of(int order)
{
    for (size_t i = 0; i < sizeof windows / sizeof *windows; i++)
        if (windows[i].order == order) return &windows[i];
    CU_FAIL_FATAL("an order without a window");
    return NULL;
}

static void check_order(const char *name, const dal_method *method, void *user)
{
    const int order = dal_method_order(method);
    const window *w = window_of(order);
    const dal_system *system = fixture_system(w->fixture);
    const bool projected = user != NULL;
    for (int space = 0; space < 2; space++) {
        /* Off the surface a projected method jumps back to it: its order is that on the surface. */
        const double displacement = space == DAL_LIFTED && !projected ? 0.02 : 0.0;
        if (!fixture_accepts(method, system, (dal_space)space)) continue;
        const dal_run_spec spec = fixture_spec(system, name, (dal_space)space, 0.1);
        const double seen = fixture_order(spec, w->T, w->coarse, w->fine, displacement);
        if (!(fabs(seen - order) <= 0.1))
            printf("\n  %s, space %d: observed order %.3f\n", name, space, seen);
        CU_ASSERT(fabs(seen - order) <= 0.1);
    }
}

/* In a quick run some: that every method takes steps without a fault the other tests see. */
static void test_order(void) { for_each_of(case_stride(12), false, check_order, NULL); }
static void test_order_projected(void)
{
    for_each_of(case_stride(13), true, check_order, (void *)windows);
}

/* ---- symplecticity and reversibility of the step map ---- */

/* A step in which a method that lacks a property shows it: an explicit one of high order comes too
 * close in the usual one. */
static double revealing_step(const dal_method *method, unsigned claim, double usual)
{
    const unsigned properties = dal_method_properties(method);
    const bool close = (properties & DAL_EXPLICIT) && dal_method_order(method) > 4;
    return close && !(properties & claim) ? 5.0 * usual : usual;
}

static void check_symplectic(const char *name, const dal_method *method, void *user)
{
    if (!fixture_accepts(method, user, DAL_LIFTED)) return;
    const double h = revealing_step(method, DAL_SYMPLECTIC, 0.1);
    const dal_run_spec spec = fixture_spec(user, name, DAL_LIFTED, h);
    const double defect = fixture_symplectic_defect(&spec);
    const bool claimed = (dal_method_properties(method) & DAL_SYMPLECTIC) != 0;
    const bool good = claimed ? defect <= 1e-9 : defect >= 1e-7;
    if (!good) printf("\n  %s: defect %.3e\n", name, defect);
    CU_ASSERT(good);
}

static void test_symplectic(void)
{
    const dal_system *system = fixture_system(fixture_full);
    for_each_of(case_stride(3), false, check_symplectic, (void *)system);
    for_each_of(case_stride(4), true, check_symplectic, (void *)system);
}

static void check_symmetric(const char *name, const dal_method *method, void *user)
{
    double defect = NAN;
    /* Carried multipliers would have to be turned round, too: see test_constrained.c. */
    if (dal_method_properties(method) & DAL_PERSISTENT_MULTIPLIER) return;
    if (!fixture_accepts(method, user, DAL_PHYSICAL)) return;
    const double h = revealing_step(method, DAL_SYMMETRIC, 0.2);
    const dal_run_spec spec = fixture_spec(user, name, DAL_PHYSICAL, h);
    CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, NULL, &defect, NULL), DAL_STATUS_OK);
    const bool claimed = (dal_method_properties(method) & DAL_SYMMETRIC) != 0;
    const bool good = claimed ? defect <= 1e-14 : defect >= 1e-7;
    if (!good) printf("\n  %s: defect %.3e\n", name, defect);
    CU_ASSERT(good);
}

static void test_symmetric(void)
{
    for_each(false, check_symmetric, (void *)fixture_system(fixture_bilinear));
}

/* ---- p.dq + pi.dv with 1/e = 0 ---- */

static void check_pairing(const char *name, const dal_method *method, void *user)
{
    const char *const text = user;
    const dal_setting start[] = {{"e", INFINITY}, {"p_x", 0.7}, {"p_z", -0.4}, {"pi_y", 1.1}};
    const double direction[] = {0.3, -0.2, 0.5, 0.1, 0.4, -0.6};
    dal_statistics pairing;
    if (!(dal_method_properties(method) & DAL_SYMPLECTIC)) return;
    const dal_system *tangent = fixture_tangent(text);
    dal_run_spec spec = fixture_spec(fixture_system(text), name, DAL_LIFTED, 0.005);
    spec.start = start;
    spec.start_count = 4;
    CU_ASSERT_EQUAL(dal_adjoint_pairing(&spec, tangent, direction, 1000, &pairing, NULL),
                    DAL_STATUS_OK);
    if (!(dal_statistics_deviation(&pairing) <=
          1e-13 * fmax(1.0, dal_statistics_max_abs(&pairing))))
        printf("\n  %s: pairing moved by %.2e\n", name, dal_statistics_deviation(&pairing));
    CU_ASSERT(dal_statistics_deviation(&pairing) <=
              1e-13 * fmax(1.0, dal_statistics_max_abs(&pairing)));
    CU_ASSERT(fabs(pairing.first) > 0.1);
}

static void test_pairing(void) { for_each(false, check_pairing, (void *)fixture_bilinear); }

/* ---- on the surface: the same bits whatever the space and the gauge; p, pi, H exactly 0 ---- */

static void surface_end(const dal_system *system, const char *name, dal_space space, double e,
                        double *qv)
{
    const dal_setting start = {"e", e};
    dal_run_spec spec = fixture_spec(system, name, space, 0.05);
    double seen[32];
    char label[32];
    spec.start = &start;
    spec.start_count = space == DAL_LIFTED;
    dal_run *run = fixture_stepped(&spec, 10 * (int)long_run(20));
    memcpy(qv, dal_run_state(run), 2 * (size_t)system->n * sizeof *qv);
    CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
    for (int i = 0; i < dal_run_observables(run); i++) {
        dal_run_observable_name(run, i, label, sizeof label);
        if (strcmp(label, "H") == 0 || label[0] == '|') CU_ASSERT_EQUAL(seen[i], 0.0);
    }
    dal_run_free(run);
}

static void check_surface(const char *name, const dal_method *method, void *user)
{
    double physical[32], lifted[32];
    const dal_system *const *systems = user;
    const size_t bytes = 2 * (size_t)systems[0]->n * sizeof(double);
    if (!fixture_accepts(method, systems[0], DAL_LIFTED)) return;
    surface_end(systems[0], name, DAL_PHYSICAL, 0.0, physical);
    for (int i = 0; i < 2; i++) { /* another mu_e(t) */
        surface_end(systems[i], name, DAL_LIFTED, 1.0, lifted);
        CU_ASSERT_EQUAL(memcmp(physical, lifted, bytes), 0);
        surface_end(systems[i], name, DAL_LIFTED, -7.0, lifted);
        CU_ASSERT_EQUAL(memcmp(physical, lifted, bytes), 0);
        surface_end(systems[i], name, DAL_LIFTED, INFINITY, lifted);
        CU_ASSERT_EQUAL(memcmp(physical, lifted, bytes), 0);
    }
}

static void test_surface(void)
{
    char other[4096];
    snprintf(other, sizeof other, "%s", fixture_full);
    char *gauge = strstr(other, "gauge:");
    CU_ASSERT_PTR_NOT_NULL_FATAL(gauge);
    strcpy(gauge, "gauge: {e: 3, mu_e: 0.05*exp(-t) - 0.01*t}\n");
    const dal_system *systems[] = {fixture_system(fixture_full), fixture_system(other)};
    for_each(false, check_surface, systems);
    for_each(true, check_surface, systems);
}

/* ---- D over 1e5 steps ---- */

typedef struct preserved {
    const char *fixture;
    unsigned claim; /* 0: every method preserves this one */
} preserved;

static double max_d(const dal_system *system, const char *name, double h, long long count)
{
    const dal_run_spec spec = fixture_spec(system, name, DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    double seen[32], max = 0.0;
    for (long long i = 0; i < count; i += 100) {
        CU_ASSERT_EQUAL_FATAL(dal_run_advance(run, 100, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
        for (int a = 0; a < system->m; a++) max = fmax(max, fabs(seen[a]));
    }
    dal_run_free(run);
    return max;
}

static void check_level(const char *name, const dal_method *method, const dal_system *system,
                        unsigned claim)
{
    const unsigned properties = dal_method_properties(method);
    const bool kept = claim == 0 || (properties & (claim | DAL_PRESERVES_D));
    const double d =
        kept ? max_d(system, name, 0.002, long_run(100000)) : max_d(system, name, 0.05, 1000);
    /* That the others lose it shows that the test sees a loss; high orders lose little. */
    const bool good = kept ? d <= 1e-13 : d > 1e-12 || dal_method_order(method) > 4;
    if (!good) printf("\n  %s: |D| %.2e\n", name, d);
    CU_ASSERT(good);
}

static void check_preserved(const char *name, const dal_method *method, void *user)
{
    const preserved *k = user;
    const dal_system *system = fixture_system(k->fixture);
    /* D at midpoints is another matter: see test_constrained.c. */
    const unsigned properties = dal_method_properties(method);
    const bool nodes = !(properties & DAL_PRESERVES_D_MIDPOINT) || properties & DAL_PRESERVES_D;
    if (nodes && fixture_accepts(method, system, DAL_PHYSICAL))
        check_level(name, method, system, k->claim);
}

static void test_preserved_constant(void)
{
    preserved k = {fixture_constant, 0};
    for_each(false, check_preserved, &k);
}
static void test_preserved_bilinear(void)
{
    preserved k = {fixture_bilinear, DAL_PRESERVES_BILINEAR | DAL_PRESERVES_QUADRATIC};
    for_each(false, check_preserved, &k);
}
static void test_preserved_quadratic(void)
{
    preserved k = {fixture_quadratic, DAL_PRESERVES_QUADRATIC};
    for_each(false, check_preserved, &k);
}
static void test_project_preserves(void)
{
    preserved k = {fixture_quadratic, DAL_PRESERVES_D};
    for_each(true, check_preserved, &k);
    k.fixture = "chaplygin-sleigh";
    for_each(true, check_preserved, &k);
}

void suite_integrators(void)
{
    CU_pSuite suite = CU_add_suite("integrators", NULL, NULL);
    CU_add_test(suite, "documentation", test_documentation);
    CU_add_test(suite, "order, lifted off the surface and physical", test_order);
    CU_add_test(suite, "order with +project", test_order_projected);
    CU_add_test(suite, "symplectic on 4n+2, or not", test_symplectic);
    CU_add_test(suite, "symmetric, or not", test_symmetric);
    CU_add_test(suite, "adjoint pairing with 1/e = 0", test_pairing);
    CU_add_test(suite, "on the surface: equal bits, zero momenta", test_surface);
    CU_add_test(suite, "D linear with constant coefficients", test_preserved_constant);
    CU_add_test(suite, "D bilinear", test_preserved_bilinear);
    CU_add_test(suite, "D quadratic", test_preserved_quadratic);
    CU_add_test(suite, "+project preserves every D", test_project_preserves);
}
