/* test_phase_composition.c - compositions of symmetric methods, on the fixtures of the conformance
 * suite: order over a wide range of h, what they inherit, what they refuse, and that their steps
 * make up h.  Of compositions of symplectic Euler, which that suite knows, the rest.
 */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The integrators' own file, tables and all, without its descriptors. */
#include <dalembert_kernel.h>
#undef DAL_INTEGRATOR
#define DAL_INTEGRATOR(identifier, function, ...) enum { unused_##identifier }
#include "../integrators/blanes_moan.c"
#include "../integrators/composition.c"

/* Step counts between which each shows its order: a decade, or what rounding leaves of it. */
static const struct composed {
    const char *name;
    int order, substeps;
    const double *c;
    const char *fixture;
    double T;
    int coarse, fine;
} composed[] = {
    {"yoshida4", 4, 3, c_yoshida4, fixture_full, 1.0, 16, 160},
    {"suzuki4", 4, 5, c_suzuki4, fixture_full, 1.0, 16, 160},
    {"yoshida6", 6, 7, c_yoshida6, fixture_gentle, 10.0, 24, 240},
    {"kahan-li6", 6, 9, c_kahan_li6, fixture_gentle, 10.0, 16, 160},
    {"suzuki8", 8, 15, c_suzuki8, fixture_gentle, 10.0, 30, 90},
    {"kahan-li8", 8, 17, c_kahan_li8, fixture_gentle, 10.0, 24, 72},
    {"sofroniou10", 10, 35, c_sofroniou10, fixture_gentle, 10.0, 12, 24},
};
static const struct composed alternating[] = {
    {"mclachlan4", 4, 10, c_mclachlan4, fixture_full, 1.0, 16, 160},
    {"bm4", 4, 12, c_bm4, fixture_full, 1.0, 16, 160},
    {"bm6", 6, 20, c_bm6, fixture_gentle, 10.0, 16, 160},
};
enum { ALTERNATING_ONES = sizeof alternating / sizeof *alternating };
enum { COMPOSED = sizeof composed / sizeof *composed };
static const char *const bases[] = {"stormer-verlet", "implicit-midpoint"};

static const char *join(const char *base, const char *modifier, const char *more)
{
    static char name[64];
    snprintf(name, sizeof name, "%s+%s%s", base, modifier, more);
    return name;
}

static void check_order(const struct composed *k, const char *name, double displacement)
{
    for (int space = 0; space < 2; space++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(k->fixture), name, (dal_space)space, 0.1);
        CU_ASSERT_EQUAL(dal_method_order(&spec.method), k->order);
        const double seen =
            fixture_order(spec, k->T, k->coarse, k->fine, space == DAL_LIFTED ? displacement : 0.0);
        if (!(fabs(seen - k->order) <= 0.1))
            printf("\n  %s, space %d: observed order %.3f\n", name, space, seen);
        CU_ASSERT(fabs(seen - k->order) <= 0.1);
    }
}

static void test_order(void)
{
    for (int i = 0; i < COMPOSED * 2; i += case_stride(9))
        check_order(&composed[i / 2], join(bases[i % 2], composed[i / 2].name, ""), 0.02);
    for (int i = 0; i < ALTERNATING_ONES; i += case_stride(4))
        check_order(&alternating[i], alternating[i].name, 0.02);
}

/* Projected, the order is that on the surface. */
static void test_order_projected(void)
{
    check_order(&composed[0], "stormer-verlet+yoshida4+project", 0.0);
    check_order(&composed[5], "stormer-verlet+kahan-li8+project", 0.0);
}

static void test_symmetric(void)
{
    for (int i = 0; i < COMPOSED; i++) {
        for (int b = 0; b < 2; b++) {
            double defect = NAN;
            const dal_run_spec spec =
                fixture_spec(fixture_system(fixture_bilinear), join(bases[b], composed[i].name, ""),
                             DAL_PHYSICAL, 0.2);
            CU_ASSERT(dal_method_properties(&spec.method) & DAL_SYMMETRIC);
            CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, NULL, &defect, NULL),
                            DAL_STATUS_OK);
            if (!(defect <= 1e-14)) printf("\n  %s: defect %.2e\n", composed[i].name, defect);
            CU_ASSERT(defect <= 1e-14);
        }
    }
}

static void test_symplectic(void)
{
    for (int i = 0; i < COMPOSED * 2; i += case_stride(5)) {
        const char *name = composed[i / 2].name;
        const dal_run_spec spec = fixture_spec(fixture_system(fixture_full),
                                               join(bases[i % 2], name, ""), DAL_LIFTED, 0.1);
        const double defect = fixture_symplectic_defect(&spec);
        CU_ASSERT(dal_method_properties(&spec.method) & DAL_SYMPLECTIC);
        if (!(defect <= 1e-9)) printf("\n  %s: defect %.2e\n", name, defect);
        CU_ASSERT(defect <= 1e-9);
    }
    const dal_run_spec projected = fixture_spec(fixture_system(fixture_full),
                                                "stormer-verlet+yoshida4+project", DAL_LIFTED, 0.1);
    CU_ASSERT_FALSE(dal_method_properties(&projected.method) & (DAL_SYMPLECTIC | DAL_SYMMETRIC));
    CU_ASSERT(fixture_symplectic_defect(&projected) >= 1e-7);
}

/* ---- D ---- */

static double max_d(const char *fixture, const char *method, double h, long long count)
{
    const dal_run_spec spec = fixture_spec(fixture_system(fixture), method, DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    double seen[32], max = 0.0;
    for (long long i = 0; i < count; i += 10) {
        CU_ASSERT_EQUAL_FATAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
        for (int a = 0; a < spec.system->m; a++) max = fmax(max, fabs(seen[a]));
    }
    dal_run_free(run);
    return max;
}

static void test_keeps(void)
{
    const long long count = long_run(2000);
    for (int i = 0; i < COMPOSED; i++) {
        const char *name = composed[i].name;
        CU_ASSERT(max_d(fixture_bilinear, join(bases[0], name, ""), 0.02, count) <= 1e-13);
        CU_ASSERT(max_d(fixture_quadratic, join(bases[1], name, ""), 0.02, count) <= 1e-13);
    }
    CU_ASSERT(max_d(fixture_quadratic, "stormer-verlet+suzuki4+project", 0.02, count) <= 1e-13);
    /* What the method inside does not keep, its compositions do not. */
    CU_ASSERT(max_d(fixture_quadratic, "stormer-verlet+suzuki4", 0.05, count) > 1e-12);
}

/* ---- on the surface the same bits on both spaces ---- */

static void surface_end(const dal_system *system, const char *name, dal_space space, double *qv)
{
    const dal_run_spec spec = fixture_spec(system, name, space, 0.05);
    dal_run *run = fixture_stepped(&spec, 100);
    memcpy(qv, dal_run_state(run), 2 * (size_t)system->n * sizeof *qv);
    for (int i = 2 * system->n + 1; i < dal_run_dimension(run); i++)
        CU_ASSERT_EQUAL(dal_run_state(run)[i], 0.0);
    dal_run_free(run);
}

static void test_surface(void)
{
    const dal_system *system = fixture_system(fixture_full);
    for (int i = 0; i < COMPOSED * 2; i += case_stride(5)) {
        const char *name = join(bases[i % 2], composed[i / 2].name, "");
        double physical[8], lifted[8];
        surface_end(system, name, DAL_PHYSICAL, physical);
        surface_end(system, name, DAL_LIFTED, lifted);
        CU_ASSERT_EQUAL(memcmp(physical, lifted, sizeof lifted), 0);
    }
}

/* ---- the steps ---- */

/* They are the same both ways and make up h: exactly, where the middle is no longer than h. */
static void check_sum(const struct composed *k, double h)
{
    double size[DAL_MAX_SUBSTEPS], middle;
    long double sum = 0.0L;
    const dal_composition table = {k->substeps, k->c};
    dal_substeps(&table, h, size);
    for (int i = 0; i < k->substeps; i++) {
        sum += (long double)size[i];
        CU_ASSERT_EQUAL(size[i], size[k->substeps - 1 - i]);
        if (2 * i < k->substeps - 2) CU_ASSERT(fabs(size[i] - k->c[i] * h) <= 8 * DBL_EPSILON * h);
    }
    middle = fabs(size[k->substeps / 2]);
    CU_ASSERT(fabsl(sum - (long double)h) <= (middle < h ? 0.0 : DBL_EPSILON * middle));
}

static void test_sum(void)
{
    static const double h[] = {0.1, 0.01, 1.0 / 3.0, 0.9999999999999999, 1e-7, 0.7};
    for (size_t j = 0; j < sizeof h / sizeof *h; j++) {
        for (int i = 0; i < COMPOSED; i++) check_sum(&composed[i], h[j]);
        for (int i = 0; i < ALTERNATING_ONES; i++) check_sum(&alternating[i], h[j]);
    }
}

/* ---- evaluations ---- */

/* Where F depends on q and t alone, a half step (1,0) and the (0,1) after it share their one
 * evaluation, and the momenta cost none. */
static void test_evaluations(void)
{
    enum { STEPS = 10 };
    static const struct {
        const char *method;
        int evaluations;
    } counted[] = {{"stormer-verlet", 1},
                   {"stormer-verlet+yoshida4", 3},
                   {"stormer-verlet+sofroniou10", 35},
                   {"mclachlan4", 5},
                   {"bm4", 6},
                   {"bm6", 10},
                   {"symplectic-euler-10", 1},
                   {"symplectic-euler-01", 1}};
    const char *const positional = "coordinates: [x, y]\n"
                                   "lagrangian: (x'^2 + y'^2)/2 - x^2*y + x*cos(t)\n"
                                   "gauge: {e: 2, mu_e: sin(t)}\n"
                                   "start: {x: 0.3, y': 0.4}\n";
    const dal_system *system = fixture_system(positional);
    for (size_t i = 0; i < sizeof counted / sizeof *counted; i++) {
        for (int space = 0; space < 2; space++) {
            const dal_run_spec spec =
                fixture_spec(system, counted[i].method, (dal_space)space, 0.01);
            dal_run *run = fixture_run(&spec);
            if (space == DAL_LIFTED) fixture_perturb(run, 0.02);
            CU_ASSERT_EQUAL(dal_run_advance(run, STEPS, NULL), DAL_STATUS_OK);
            CU_ASSERT_EQUAL(dal_run_evaluations(run), STEPS * counted[i].evaluations);
            dal_run_free(run);
        }
    }
}

/* ---- what cannot be composed ---- */

static void refused(const dal_system *system, const char *name, const char *reason)
{
    const dal_run_spec spec = fixture_spec(system, name, DAL_LIFTED, 0.1);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, reason);
}

static void test_refused(void)
{
    const dal_system *system = fixture_system(fixture_full);
    refused(system, "rk4+yoshida4", "+yoshida4 needs a symmetric method: rk4 is not symmetric");
    refused(system, "gauss4+suzuki8", "+suzuki8 needs a method of order 2: gauss4 is of order 4");
    refused(system, "stormer-verlet+project+suzuki4",
            "+suzuki4 needs a symmetric method: stormer-verlet+project is not symmetric");
    refused(system, "stormer-verlet+yoshida4+yoshida6",
            "+yoshida6 needs a method of order 2: stormer-verlet+yoshida4 is of order 4");
}

void suite_phase_composition(void)
{
    CU_pSuite suite = CU_add_suite("compositions", NULL, NULL);
    CU_add_test(suite, "order, lifted off the surface and physical", test_order);
    CU_add_test(suite, "order with +project", test_order_projected);
    CU_add_test(suite, "symmetric", test_symmetric);
    CU_add_test(suite, "symplectic on 4n+2", test_symplectic);
    CU_add_test(suite, "D bilinear and D quadratic", test_keeps);
    CU_add_test(suite, "on the surface: equal bits", test_surface);
    CU_add_test(suite, "the steps make up h", test_sum);
    CU_add_test(suite, "one evaluation of forces without v", test_evaluations);
    CU_add_test(suite, "what is refused, and why", test_refused);
}
