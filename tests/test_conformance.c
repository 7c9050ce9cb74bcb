/* test_conformance.c - what modified methods claim, every modifier on every kind of method it
 * takes; that nothing is claimed that no suite verifies; and that a step that fails changes
 * nothing. Plain methods: test_integrators.c.  Lanes: test_batch.c.  Generated code:
 * test_generate_native.c.
 */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* Conservative, with a full mass matrix that depends on q, m = 2, one D nonlinear in v. */
static const char conservative[] =
    "coordinates: [x, y, z, u]\n"
    "lagrangian: >-\n"
    "  (2 + cos(y))/2*x'^2 + (3 + x^2/4)/2*y'^2 + (1.5 + 0.2*sin(x))/2*z'^2 + (2 + "
    "0.1*z^2)/2*u'^2\n"
    "  + 0.3*x'*y'*cos(z) + 0.2*z'*u'*sin(y) - (x^2 + 1.5*y^2 + z^2*y^2/2 + cos(u))\n"
    "constraints: [z' - y*x', (u'^2 - x'^2 - y'^2)/2]\n"
    "start: {x: 0, y: 0.5, z: 0.3, u: 0.2, x': 0.6, y': 0.8, z': 0.3, u': 1}\n";

/* Every claim there is, with its verification. */
static const unsigned verified =
    DAL_SYMMETRIC | DAL_SYMPLECTIC | DAL_PRESERVES_BILINEAR | DAL_PRESERVES_QUADRATIC |
    DAL_PRESERVES_D | DAL_PRESERVES_ENERGY |               /* here and in test_integrators.c */
    DAL_PRESERVES_D_MIDPOINT | DAL_PERSISTENT_MULTIPLIER | /* test_constrained.c */
    DAL_ADAPTIVE |                                         /* test_adaptive.c */
    DAL_PERSISTENT_ACCELERATION |                          /* test_enforcement.c */
    DAL_PRESERVES_HOLONOMIC |                              /* test_holonomic.c */
    DAL_EXTRAPOLATES_STAGES | /* that a checkpoint has the slopes: test_run.c */
    DAL_EXPLICIT | DAL_MODIFIER | DAL_COMPONENTWISE; /* the batches' and the generated steps */

static void test_claims_known(void)
{
    for (int i = 0; dal_integrator_at(i); i++) {
        const dal_integrator *k = dal_integrator_at(i);
        if (k->properties & ~verified) printf("\n  %s: an unknown claim\n", k->name);
        CU_ASSERT_EQUAL(k->properties & ~verified, 0);
        CU_ASSERT_EQUAL(k->inherits & ~verified, 0);
    }
}

typedef void visitor(const char *name, const dal_method *method, void *user);

static bool takes(const dal_integrator *modifier, const dal_integrator *inside)
{
    if (modifier->needs & DAL_NEEDS_SYMMETRIC && !(inside->properties & DAL_SYMMETRIC))
        return false;
    if (modifier->needs & DAL_NEEDS_RUNGE_KUTTA)
        return (inside->properties & DAL_COMPONENTWISE) && !(inside->properties & DAL_SYMPLECTIC);
    const bool turns_D =
        inside->properties & DAL_PRESERVES_D_MIDPOINT && !(inside->properties & DAL_PRESERVES_D);
    const unsigned projects = DAL_NEEDS_SYMMETRIC | DAL_NEEDS_CONSTRAINT;
    if (turns_D && (modifier->needs & projects) == projects) return false;
    return !(modifier->needs & DAL_NEEDS_ORDER_2) || inside->order == 2;
}

/* Every modifier on every method below order 8 that it takes, where the order can be seen; in a
 * quick run on one of seven. */
static void for_each_modified(visitor *visit, void *user)
{
    for (int i = 0; dal_integrator_at(i); i++) {
        for (int j = 0; dal_integrator_at(j); j++) {
            const dal_integrator *inside = dal_integrator_at(i), *modifier = dal_integrator_at(j);
            char name[96];
            dal_method method;
            if (inside->properties & DAL_MODIFIER || !(modifier->properties & DAL_MODIFIER))
                continue;
            if (inside->order > 6 || !takes(modifier, inside)) continue;
            if ((i + j) % case_stride(7) != 0) continue;
            snprintf(name, sizeof name, "%s+%s", inside->name, modifier->name);
            CU_ASSERT_EQUAL_FATAL(dal_method_parse(&method, name, NULL), DAL_STATUS_OK);
            visit(name, &method, user);
        }
    }
}

/* ---- order, where it is the inner method's (compositions: test_phase_composition.c) ----
 */

static void check_order(const char *name, const dal_method *method, void *user)
{
    const int order = dal_method_order(method);
    /* A decade of h; at order 6 what rounding leaves of it. */
    const int decade = long_run(2) == 2 ? 10 : 2;
    const int coarse = order == 1 ? 200 : order < 6 ? 40 : 24;
    const int fine = (order < 6 ? decade : 2) * coarse;
    if (method->layer[1]->order || !fixture_accepts(method, user, DAL_PHYSICAL)) return;
    const dal_run_spec spec = fixture_spec(user, name, DAL_PHYSICAL, 0.1);
    const double seen = fixture_order(spec, 1.0, coarse, fine, 0.0);
    if (!(fabs(seen - order) <= 0.1)) printf("\n  %s: observed order %.3f\n", name, seen);
    CU_ASSERT(fabs(seen - order) <= 0.1);
}

static void test_order(void)
{
    for_each_modified(check_order, (void *)fixture_system(conservative));
}

/* ---- symmetry ---- */

static void check_symmetric(const char *name, const dal_method *method, void *user)
{
    double defect = NAN;
    if (dal_method_properties(method) & DAL_PERSISTENT_MULTIPLIER) return;
    if (!fixture_accepts(method, user, DAL_PHYSICAL)) return;
    const dal_run_spec spec = fixture_spec(user, name, DAL_PHYSICAL, 0.2);
    CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, NULL, &defect, NULL), DAL_STATUS_OK);
    if (!(dal_method_properties(method) & DAL_SYMMETRIC)) return;
    if (!(defect <= 1e-14)) printf("\n  %s: defect %.3e\n", name, defect);
    CU_ASSERT(defect <= 1e-14);
}

static void test_symmetric(void)
{
    static const char *const names[] = {"contact-oscillator", "knife-edge", "appell-hamel"};
    for (int i = 0; i < 3; i++) {
        for_each_modified(check_symmetric, (void *)fixture_system(i ? names[i] : fixture_bilinear));
    }
}

/* ---- D and E ---- */

typedef struct strays {
    double D, E;
} strays;

static strays strays_of(const dal_system *system, const char *name)
{
    const dal_run_spec spec = fixture_spec(system, name, DAL_PHYSICAL, 0.02);
    dal_run *run = fixture_run(&spec);
    double first[32], now[32];
    strays max = {0.0, 0.0};
    CU_ASSERT_EQUAL(dal_run_observe(run, first), DAL_STATUS_OK);
    for (int i = 0; i < 10 * long_run(20); i++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, now), DAL_STATUS_OK);
        for (int a = 0; a < system->m; a++) max.D = fmax(max.D, fabs(now[a]));
        max.E = fmax(max.E, fabs(now[system->m] - first[system->m]));
    }
    dal_run_free(run);
    return max;
}

static void check_kept(const char *name, const dal_method *method, void *user)
{
    const unsigned properties = dal_method_properties(method);
    if (!fixture_accepts(method, user, DAL_PHYSICAL)) return;
    const strays max = strays_of(user, name);
    const bool D = !(properties & DAL_PRESERVES_D) || max.D <= 1e-14;
    const bool E = !(properties & DAL_PRESERVES_ENERGY) || max.E <= 1e-14;
    if (!D || !E) printf("\n  %s: D %.2e, E %.2e\n", name, max.D, max.E);
    CU_ASSERT(D);
    CU_ASSERT(E);
}

static void test_kept(void)
{
    for_each_modified(check_kept, (void *)fixture_system(conservative));
    const strays plain = strays_of(fixture_system(conservative), "rk4");
    const double loss = long_run(2) == 2 ? 1e-12 : 1e-15; /* that the test sees */
    CU_ASSERT(plain.D > loss);
    CU_ASSERT(plain.E > loss);
}

/* ---- lanes ---- */

enum { LANES = 9 }; /* a block of eight, and one alone */

static void check_lanes(const char *name, const dal_method *method, void *user)
{
    double state[64];
    dal_batch *batch = NULL;
    if (!fixture_accepts(method, user, DAL_PHYSICAL)) return;
    dal_run_spec spec = fixture_spec(user, name, DAL_PHYSICAL, 0.05);
    spec.start_count = 1;
    spec.start = &(dal_setting){"u", 0.0};
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, LANES, 0, NULL), DAL_STATUS_OK);
    for (int i = 0; i < LANES; i++) {
        const dal_setting start = {"u", 0.1 * i};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, NULL, 0, &start, 1, NULL), DAL_STATUS_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 10), DAL_STATUS_OK);
    for (int i = 0; i < LANES; i++) {
        spec.start = &(dal_setting){"u", 0.1 * i};
        dal_run *run = fixture_stepped(&spec, 10);
        dal_batch_state(batch, i, state);
        const size_t bytes = (size_t)dal_run_dimension(run) * sizeof *state;
        const bool same = memcmp(state, dal_run_state(run), bytes) == 0;
        if (!same) printf("\n  %s: lane %d has other bits\n", name, i);
        CU_ASSERT(same);
        dal_run_free(run);
    }
    dal_batch_free(batch);
}

static void test_lanes(void)
{
    for_each_modified(check_lanes, (void *)fixture_system(conservative));
}

/* ---- a failed step changes nothing ---- */

/* x falls through 0.3, where the potential ends. */
static const char ending[] = "coordinates: [x, y, z]\n"
                             "lagrangian: (x'^2 + y'^2 + z'^2)/2 + sqrt(x - 0.3) - z^2/2\n"
                             "constraints: [z' - y*x']\n"
                             "start: {x: 1, y: 0.3, x': -2, y': 0.5, z': -0.6}\n";

static void check_untouched(const char *name, const dal_method *method, void *user)
{
    static double before[4096];
    dal_status status = DAL_STATUS_OK;
    size_t count = 0;
    if (!fixture_accepts(method, user, DAL_PHYSICAL)) return;
    const dal_run_spec spec = fixture_spec(user, name, DAL_PHYSICAL, 0.05);
    dal_run *run = fixture_run(&spec);
    for (int i = 0; i < 100 && status == DAL_STATUS_OK; i++) {
        const double *memory = dal_run_save(run, &count);
        memcpy(before, memory, count * sizeof *memory);
        status = dal_run_step(run, NULL);
    }
    if (status == DAL_STATUS_OK) printf("\n  %s: no step failed\n", name);
    CU_ASSERT_NOT_EQUAL(status, DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(before, dal_run_save(run, &count), count * sizeof *before), 0);
    dal_run_free(run);
}

static void test_untouched(void)
{
    const dal_system *system = fixture_system(ending);
    for_each_modified(check_untouched, (void *)system);
    for (int i = 0; dal_integrator_at(i); i++) {
        const dal_method plain = {{dal_integrator_at(i)}};
        if (dal_integrator_at(i)->properties & DAL_MODIFIER) continue;
        check_untouched(dal_integrator_at(i)->name, &plain, (void *)system);
    }
}

/* ---- motions that come to rest in part ---- */

/* The sleigh ends straight on, phi' falls like exp(-t) below the roundings of x' and y': then phi'
 * alone reacts to what is left of D, and increments decrease without end. */
static void test_rest(void)
{
    static const char *const names[] = {"rk4+project",
                                        "gauss4+project",
                                        "gauss4+symmetric-project",
                                        "rk4+project-energy",
                                        "gauss-spark2",
                                        "mclachlan-perlmutter",
                                        "gauss-spark4",
                                        "dla",
                                        "spark2",
                                        "spark4",
                                        "spark6"};
    static const double lengths[] = {0.15, 0.5, 1.0};
    const long long steps = long_run(3000);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        for (int k = 0; k < 3; k++) {
            const dal_setting a = {"a", lengths[k]};
            dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh-offset"), names[i],
                                             DAL_PHYSICAL, 0.1);
            spec.parameters = &a;
            spec.parameter_count = 1;
            dal_run *run = fixture_run(&spec);
            double found[16];
            const dal_status status = dal_run_advance(run, steps, NULL);
            CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
            if (status != DAL_STATUS_OK) printf("\n  %s, a = %g\n", names[i], lengths[k]);
            dal_run_observe(run, found);
            CU_ASSERT(fabs(found[0]) < 1e-14);
            CU_ASSERT(steps < 3000 || fabs(dal_run_state(run)[5]) < 1e-14);
            dal_run_free(run);
        }
}

/* Velocities grow like exp(0.7 t), while D = 0 is a difference of their squares: 1e-16 |v|^2 of it
 * is rounding, at v = 500 a change of v by 1e-11 |v| already. */
static void test_cancellation(void)
{
    static const char *const names[] = {"gauss4+project", "gauss4+symmetric-project",
                                        "mclachlan-perlmutter", "dla", "spark4"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system("relativistic-em"), names[i], DAL_PHYSICAL, 0.1);
        dal_run *run = fixture_run(&spec);
        double found[16];
        CU_ASSERT_EQUAL(dal_run_advance(run, 100, NULL), DAL_STATUS_OK);
        dal_run_observe(run, found);
        CU_ASSERT(fabs(found[0]) < 1e-9);
        dal_run_free(run);
    }
}

/* ---- refusals ---- */

static void refused(const char *text, const char *name, dal_space space, const char *reason)
{
    const dal_run_spec spec = fixture_spec(fixture_system(text), name, space, 0.1);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, reason);
}

static void test_refused(void)
{
    static const char accelerations[] = "coordinates: [x]\naccelerations: {x: -x}\n";
    refused("contact-oscillator", "rk4+symmetric-project", DAL_PHYSICAL,
            "+symmetric-project needs a symmetric method: rk4 is not symmetric");
    refused("contact-oscillator", "gauss4+project+symmetric-project", DAL_PHYSICAL,
            "gauss4+project is not symmetric");
    refused("isokinetic", "rk4+project-energy", DAL_LIFTED,
            "rk4+project-energy cannot act on isokinetic: the motion does not conserve its energy");
    refused("chaplygin-sleigh-vakonomic", "rk4+project-energy", DAL_PHYSICAL, "vakonomic");
    refused(accelerations, "rk4+project-energy", DAL_PHYSICAL, "the system has no energy");
    refused("contact-oscillator", "gni", DAL_LIFTED, "take the physical space");
    refused("contact-oscillator", "gauss4+yoshida4", DAL_LIFTED, "needs a method of order 2");
    refused("chaplygin-sleigh-vakonomic", "rk4", DAL_LIFTED, "vakonomic");
}

void suite_conformance(void)
{
    CU_pSuite suite = CU_add_suite("conformance", NULL, NULL);
    CU_add_test(suite, "no claim without a test", test_claims_known);
    CU_add_test(suite, "modifiers: order", test_order);
    CU_add_test(suite, "modifiers: symmetric", test_symmetric);
    CU_add_test(suite, "modifiers: D and E", test_kept);
    CU_add_test(suite, "modifiers: lanes have the bits of single runs", test_lanes);
    CU_add_test(suite, "a step that fails changes nothing", test_untouched);
    CU_add_test(suite, "a motion that comes to rest in part", test_rest);
    CU_add_test(suite, "cancellation in D", test_cancellation);
    CU_add_test(suite, "refused with the reason", test_refused);
}
