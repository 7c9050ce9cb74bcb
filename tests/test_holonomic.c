/* test_holonomic.c - holonomic constraints g(q,t) = 0: their rows of D, starts, projections, and
 * what is refused. */
#include "fixtures.h"
#include "holonomic.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char in_angles[] = PENDULUM_IN_ANGLES("g: 2", "a: atan(0.75)");
/* A bead on a hoop that turns by w; and its angle from below. */
static const char hoop[] = "coordinates: [x, y, z]\n"
                           "parameters: {w: 1.5, g: 1}\n"
                           "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g*z\n"
                           "holonomic: [x^2 + y^2 + z^2 - 1, y*cos(w*t) - x*sin(w*t)]\n"
                           "start: {x: 0.6, z: -0.8, x': 0.4, z': 0.3, y': 0.9}\n";
static const char hoop_angle[] = "coordinates: [a]\n"
                                 "parameters: {w: 1.5, g: 1}\n"
                                 "lagrangian: (a'^2 + w^2*sin(a)^2)/2 + g*cos(a)\n"
                                 "start: {a: atan(0.75), a': 0.5}\n";
/* The largest observable whose name has a letter and a number. */
static double largest(dal_run *run, char letter)
{
    double values[64], max = 0.0;
    char name[64];
    CU_ASSERT_FATAL(dal_run_observables(run) <= 64);
    CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
    for (int i = 0; dal_run_observable_name(run, i, name, sizeof name); i++)
        if (name[0] == letter && name[1] >= '1' && name[1] <= '9') max = fmax(max, fabs(values[i]));
    return max;
}

static dal_run *run_to(const char *text, const char *method, dal_space space, double step,
                       long long steps)
{
    const dal_run_spec spec = fixture_spec(fixture_system(text), method, space, step);
    return fixture_stepped(&spec, steps);
}

/* ---- the motion ---- */

static void test_pendulum(void)
{
    dal_run *run = run_to(pendulum, "gauss8", DAL_PHYSICAL, 1.0 / 64, 192);
    dal_run *angles = run_to(in_angles, "gauss12", DAL_PHYSICAL, 1.0 / 64, 192);
    compare_pendulums(run, angles);
}

static void test_hoop(void)
{
    dal_run *run = run_to(hoop, "gauss8", DAL_PHYSICAL, 1.0 / 64, 192);
    dal_run *angle = run_to(hoop_angle, "gauss12", DAL_PHYSICAL, 1.0 / 64, 192);
    const double *q = dal_run_state(run), a = dal_run_state(angle)[0];
    CU_ASSERT_DOUBLE_EQUAL(q[0], sin(a) * cos(1.5 * 3), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(q[1], sin(a) * sin(1.5 * 3), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(q[2], -cos(a), 1e-12);
    dal_run_free(run);
    dal_run_free(angle);
}

/* r.r'' + v^2 = 0 and r'' = 2 h r - g e_z: h = (g z - v^2)/(2 l^2). */
static void test_reaction(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(pendulum), "rk4", DAL_PHYSICAL, 0.01);
    spec.options.reactions = true;
    dal_run *run = fixture_run(&spec);
    const double h = (2.0 * -1.0 - 1.5 * 1.5) / (2.0 * 1.25 * 1.25);
    double values[16];
    char name[16];
    CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
    for (int i = 0; dal_run_observable_name(run, i, name, sizeof name); i++) {
        if (strcmp(name, "h1") == 0) CU_ASSERT_DOUBLE_EQUAL(values[i], h, 1e-15);
        if (strcmp(name, "R_z") == 0) CU_ASSERT_DOUBLE_EQUAL(values[i], -2.0 * h, 1e-15);
    }
    CU_ASSERT_STRING_EQUAL(name, "C1"); /* the last of all */
    dal_run_free(run);
}

/* ---- what methods preserve ---- */

static const char *const keeping[] = {"rk4",
                                      "symplectic-euler-10",
                                      "dop853",
                                      "taylor",
                                      "gauss6+project",
                                      "gauss4+symmetric-project",
                                      "implicit-midpoint+symmetric-project+suzuki4",
                                      "implicit-midpoint+suzuki4",
                                      "rk4+lift",
                                      "rattle",
                                      "rattle+suzuki4",
                                      "gauss-spark2",
                                      "gauss-spark4",
                                      "gauss-spark6"};
enum { METHODS = sizeof keeping / sizeof *keeping };

/* |g|, |D| of all rows: some roundings of terms of size 1, of the hoop of size w t. */
static void test_levels(void)
{
    static const char *const systems[] = {pendulum, hoop, skate, general, steady};
    enum { SYSTEMS = sizeof systems / sizeof *systems };
    for (int k = 0; k < METHODS * SYSTEMS; k += case_stride(5)) {
        const char *const method = keeping[k % METHODS], *const system = systems[k / METHODS];
        const bool is_lift = strstr(method, "+lift") != NULL;
        const bool enforces = strstr(method, "rattle") || strstr(method, "spark");
        const double rounding = system == hoop ? 40.0 * 1.5 * 2e-16 : 2e-15;
        if (is_lift && system == general) continue; /* it needs K that does not depend on v */
        if (strstr(method, "rattle") && system == general) continue; /* W must be constant */
        const dal_space space = !enforces && (k % 2 || is_lift) ? DAL_LIFTED : DAL_PHYSICAL;
        dal_run *run = run_to(system, method, space, 0.02, long_run(2000));
        const double g = largest(run, 'C'), D = largest(run, 'D');
        if (!(g <= rounding && D <= rounding)) printf("\n  %s: %.2g, %.2g\n", method, g, D);
        CU_ASSERT(g <= rounding);
        CU_ASSERT(D <= rounding);
        dal_run_free(run);
    }
}

/* Every method of the library keeps g, or refuses the system with a reason. */
static void test_all_methods(void)
{
    const dal_system *system = fixture_system(skate);
    char name[96];
    int kept = 0;
    for (int i = 0; dal_integrator_at(i); i++) {
        dal_run_spec spec =
            fixture_spec(system, fixture_method(i, name, sizeof name), DAL_LIFTED, 0.05);
        dal_error error = {0};
        dal_run *run = NULL;
        if (dal_method_needs(&spec.method) & DAL_NEEDS_BLOCKS) spec.options.space = DAL_PHYSICAL;
        if (dal_run_create(&run, &spec, &error) != DAL_STATUS_OK) {
            CU_ASSERT_EQUAL(error.status, DAL_STATUS_UNSUPPORTED);
            CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "holonomic constraints"));
            continue;
        }
        CU_ASSERT_EQUAL(dal_run_advance(run, 20, NULL), DAL_STATUS_OK);
        if (!(largest(run, 'C') <= 2e-15)) printf("\n  %s: %.2g\n", name, largest(run, 'C'));
        CU_ASSERT(largest(run, 'C') <= 2e-15);
        CU_ASSERT(largest(run, 'D') <= 2e-15);
        kept++;
        dal_run_free(run);
    }
    CU_ASSERT(kept > 20);
}

/* Without a projection D_g stays, being an integral, and g drifts. */
static void test_bare(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(skate), "gauss4", DAL_PHYSICAL, 0.05);
    spec.options.bare = true;
    dal_run *run = fixture_stepped(&spec, 4000);
    CU_ASSERT(largest(run, 'C') > 1e-8);
    CU_ASSERT(largest(run, 'D') < 1e-5);
    dal_run_free(run);
}

/* On p = pi = 0 the two spaces have the same bits; lanes have the bits of a run. */
static void test_bits(void)
{
    dal_run *lifted = run_to(skate, "gauss4", DAL_LIFTED, 0.05, 50);
    dal_run *physical = run_to(skate, "gauss4", DAL_PHYSICAL, 0.05, 50);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(lifted), dal_run_state(physical), 12 * sizeof(double)), 0);
    dal_run_free(lifted);
    dal_run_free(physical);
    fixture_lanes(fixture_spec(fixture_system(skate), "gauss4", DAL_LIFTED, 0.05), 5, 20, "c'", 0.5,
                  0.1);
    fixture_lanes(
        fixture_spec(fixture_system(skate), "gauss4+symmetric-project", DAL_PHYSICAL, 0.05), 5, 20,
        "c'", 0.5, 0.1);
    fixture_lanes(fixture_spec(fixture_system(skate), "rattle+suzuki4", DAL_PHYSICAL, 0.05), 5, 20,
                  "c'", 0.5, 0.1);
    fixture_lanes(fixture_spec(fixture_system(skate), "gauss-spark6", DAL_PHYSICAL, 0.05), 5, 20,
                  "c'", 0.5, 0.1);
}

/* ---- order and symmetry ---- */

static void test_order(void)
{
    static const struct {
        const char *method;
        double order;
    } cases[] = {{"gauss4", 4.0},
                 {"gauss4+symmetric-project", 4.0},
                 {"implicit-midpoint+symmetric-project", 2.0},
                 {"implicit-midpoint+symmetric-project+suzuki4", 4.0},
                 {"rk4", 4.0},
                 {"rattle", 2.0},
                 {"rattle+suzuki4", 4.0},
                 {"gauss-spark2", 2.0},
                 {"gauss-spark4", 4.0}};
    enum { CASES = sizeof cases / sizeof *cases };
    static const char *const systems[] = {skate, general, steady};
    for (int k = 0; k < 3 * CASES; k += case_stride(3)) {
        const char *const method = cases[k / 3].method, *const system = systems[k % 3];
        if (strstr(method, "rattle") && system == general) continue;
        const dal_run_spec spec = fixture_spec(fixture_system(system), method, DAL_PHYSICAL, 0.1);
        const double order = fixture_order(spec, 1.0, 20, 40, 0.0);
        if (!(fabs(order - cases[k / 3].order) < 0.15))
            printf("\n  %s: order %.2f\n", method, order);
        CU_ASSERT(fabs(order - cases[k / 3].order) < 0.15);
    }
}

/* How far a step of h and one of -h lead from the start. */
static double reversal_defect(const char *text, const char *method)
{
    const dal_system *system = fixture_system(text);
    const dal_run_spec forth = fixture_spec(system, method, DAL_PHYSICAL, 0.1);
    const dal_run_spec back = fixture_spec(system, method, DAL_PHYSICAL, -0.1);
    dal_run *run = fixture_run(&forth), *other = fixture_run(&back);
    double start[32], defect = 0.0;
    memcpy(start, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *start);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_set_state(other, 0.1, dal_run_state(run), NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(other, NULL), DAL_STATUS_OK);
    for (int i = 0; i < dal_run_dimension(run); i++)
        defect = fmax(defect, fabs(dal_run_state(other)[i] - start[i]));
    dal_run_free(run);
    dal_run_free(other);
    return defect;
}

static void test_symmetry(void)
{
    CU_ASSERT(reversal_defect(skate, "gauss4+symmetric-project") < 4e-15);
    CU_ASSERT(reversal_defect(general, "gauss4+symmetric-project") < 4e-15);
    CU_ASSERT(reversal_defect(skate, "gauss4+project") > 1e-11); /* the projection costs it */
    CU_ASSERT(reversal_defect(skate, "rattle") < 4e-15);
    CU_ASSERT(reversal_defect(steady, "rattle") < 4e-15);
    for (int order = 2; order <= 6; order += 2) {
        char method[16];
        snprintf(method, sizeof method, "gauss-spark%d", order);
        CU_ASSERT(reversal_defect(skate, method) < 4e-15);
        CU_ASSERT(reversal_defect(general, method) < 4e-15);
        CU_ASSERT(reversal_defect(steady, method) < 4e-15);
    }
}

/* ---- starts ---- */

static void test_solved(void)
{
    static const char text[] = "coordinates: [x, y, z]\n"
                               "lagrangian: (x'^2 + y'^2 + z'^2)/2 - z\n"
                               "holonomic: [x^2 + y^2 + z^2 - 1]\n"
                               "start: {x: 0.6, z: -2, x': 0.4, solve: [z', z]}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[2], -0.8, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[5], 0.3, 1e-15); /* x x' + z z' = 0 */
    dal_run_free(run);
}

/* The nearest point of a sphere is along the radius; in the metric of masses where q' W q' = 0. */
static void test_consistent(void)
{
    const dal_setting start[] = {{"x", 3.0}, {"z", -4.0}, {"x'", 1.0}};
    dal_run_spec spec = fixture_spec(fixture_system(pendulum), "rk4", DAL_PHYSICAL, 0.1);
    spec.start = start;
    spec.start_count = 3;
    fixture_refused(&spec, DAL_STATUS_INCONSISTENT,
                    "the start violates holonomic constraint 1: C1 = 23.4375; the option "
                    "consistent moves its coordinates to g = 0");
    spec.options.consistent = true;
    dal_run *run = fixture_run(&spec);
    const double *x = dal_run_state(run), expected[] = {0.75, 0.0, -1.0, 0.64, 1.5, 0.48};
    for (int i = 0; i < 6; i++) CU_ASSERT_DOUBLE_EQUAL(x[i], expected[i], 4e-16);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "l", 1.0, NULL), DAL_STATUS_INCONSISTENT);
    dal_run_free(run);
}

/* Beside a constraint of velocities, whose row is the first: (3, 4) moves along the radius, and y
 * is solved for. */
static void test_rows_of_g(void)
{
    static const char text[] = "coordinates: [x, y, z]\n"
                               "lagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                               "constraints: [z' - 2*x']\n"
                               "holonomic: [x^2 + y^2 - 1]\n"
                               "start: {x: 0.6, y: 2, solve: [y]}\n";
    const dal_setting start[] = {{"x", 3.0}, {"y", 4.0}, {"z", 5.0}};
    dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], 0.8, 1e-15);
    dal_run_free(run);
    static const char moved[] = "coordinates: [x, y, z]\n"
                                "lagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                                "constraints: [z' - 2*x']\n"
                                "holonomic: [x^2 + y^2 - 1]\n";
    spec = fixture_spec(fixture_system(moved), "rk4", DAL_PHYSICAL, 0.1);
    spec.start = start;
    spec.start_count = 3;
    spec.options.consistent = true;
    run = fixture_run(&spec);
    const double *q = dal_run_state(run), expected[] = {0.6, 0.8, 5.0};
    for (int i = 0; i < 3; i++) CU_ASSERT_DOUBLE_EQUAL(q[i], expected[i], 1e-15);
    dal_run_free(run);
}

/* An event that sets q off g = 0 leaves the nearest q on it. */
static void test_event(void)
{
    static const char text[] = "coordinates: [x, y]\n"
                               "lagrangian: (x'^2 + y'^2)/2\n"
                               "holonomic: [x^2 + y^2 - 1]\n"
                               "start: {x: 1, y': 1}\n"
                               "events: [{when: y - 0.6, set: {x: 3, y: 4}}]\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.125);
    dal_run *run = fixture_run(&spec);
    while (dal_run_event_count(run, 0) == 0)
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], 0.6, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], 0.8, 1e-15);
    CU_ASSERT(largest(run, 'D') <= 1e-15);
    dal_run_free(run);
}

static dal_status compare_q(void *user, dal_run *run, const dal_occurrence *event)
{
    CU_ASSERT(largest(run, 'C') > 1e-10);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(run), event->before, 2 * sizeof(double)), 0);
    ++*(int *)user;
    return DAL_STATUS_OK;
}

/* An impact changes velocities alone, also where g is not 0. */
static void test_impact(void)
{
    static const char text[] = "coordinates: [x, y]\n"
                               "lagrangian: (x'^2 + y'^2)/2\n"
                               "holonomic: [x^2 + y^2 - 1]\n"
                               "start: {x: 1, y': 1}\n"
                               "events: [{when: y - 0.6, restitution: 1}]\n";
    dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.125);
    int impacts = 0;
    spec.options.bare = true;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(fixture_events(run, 1.0, compare_q, &impacts, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(impacts, 1);
    dal_run_free(run);
}

/* ---- what is refused ---- */

/* rattle wants a constant W, gauss-spark one that does not depend on v. */
static void test_masses_refused(void)
{
    static const char of_v[] = "coordinates: [x, y]\n"
                               "lagrangian: (x'^2 + y'^2)/2 + x'^4/12\n"
                               "holonomic: [x^2 + y^2 - 1]\n"
                               "start: {x: 1, y': 1}\n";
    dal_run_spec spec = fixture_spec(fixture_system(general), "rattle", DAL_PHYSICAL, 0.1);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "the mass matrix is not constant");
    spec = fixture_spec(fixture_system(of_v), "gauss-spark4", DAL_PHYSICAL, 0.1);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "the mass matrix depends on velocities beside");
    dal_run_free(run_to(of_v, "gauss4", DAL_PHYSICAL, 0.1, 10));
}

static void test_methods_refused(void)
{
    static const struct {
        const char *method, *message;
    } cases[] = {{"mclachlan-perlmutter", "mclachlan-perlmutter cannot act on fixture: the method "
                                          "enforces D alone"},
                 {"gni", "enforces D alone"},
                 {"spark4+project", "enforces D alone"},
                 {"gauss4+project-energy", "+project-energy moves q without regard"},
                 {"implicit-midpoint+yoshida4+project-energy", "moves q without regard"}};
    const dal_system *system = fixture_system(skate);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        dal_run_spec spec = fixture_spec(system, cases[k].method, DAL_PHYSICAL, 0.1);
        fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, cases[k].message);
        spec.options.bare = true;
        fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, cases[k].message);
    }
}

static void test_completed(void)
{
    const dal_system *system = fixture_system(skate);
    dal_options options = dal_options_default();
    dal_method method;
    char name[64];
    bool added = false;
    CU_ASSERT_EQUAL(dal_method_parse(&method, "rk4", NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_method_complete(&method, system, &options, &added, NULL), DAL_STATUS_OK);
    CU_ASSERT(added);
    CU_ASSERT_STRING_EQUAL(dal_method_name(&method, name, sizeof name), "rk4+project");
    CU_ASSERT_EQUAL(dal_method_complete(&method, system, &options, &added, NULL), DAL_STATUS_OK);
    CU_ASSERT(!added);
    CU_ASSERT_EQUAL(dal_method_parse(&method, "rk4", NULL), DAL_STATUS_OK);
    options.bare = true;
    CU_ASSERT_EQUAL(dal_method_complete(&method, system, &options, &added, NULL), DAL_STATUS_OK);
    CU_ASSERT(!added);
    options.bare = false;
    CU_ASSERT_EQUAL(dal_method_complete(&method, fixture_system(in_angles), &options, NULL, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_STRING_EQUAL(dal_method_name(&method, name, sizeof name), "rk4");
    for (int i = 1; i < DAL_LAYERS; i++) method.layer[i] = dal_integrator_at(0);
    CU_ASSERT_EQUAL(dal_method_complete(&method, system, &options, NULL, NULL),
                    DAL_STATUS_UNSUPPORTED);
}

static void test_momenta(void)
{
    const dal_setting start = {"pi_x", 0.1};
    dal_run_spec spec = fixture_spec(fixture_system(pendulum), "gauss4", DAL_LIFTED, 0.05);
    spec.start = &start;
    spec.start_count = 1;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "would clear them: take the option bare");
    spec.options.bare = true;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "K of effort identity would push");
}

/* With K of `constraint`, pi/e is along the constraints: D_g stays to rounding where pi does not
 * vanish, and g to the error of the method. */
static void test_effort(void)
{
    const dal_setting start[] = {{"pi_x", 0.1}, {"pi_y", -0.05}};
    dal_model *model = NULL;
    const dal_system *system = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, "pendulum", pendulum, strlen(pendulum), NULL),
                          DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_set_effort(model, DAL_EFFORT_CONSTRAINT, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    dal_run_spec spec = fixture_spec(system, "gauss12", DAL_LIFTED, 0.05);
    spec.options.bare = true;
    spec.start = start;
    spec.start_count = 2;
    dal_run *run = fixture_stepped(&spec, 20);
    CU_ASSERT(largest(run, 'D') <= 1e-13);
    CU_ASSERT(largest(run, 'C') <= 1e-13);
    dal_run_free(run);
    dal_model_free(model);
}

static void test_model_errors(void)
{
    static const struct {
        const char *sections, *message;
    } cases[] = {
        {"holonomic: [x*x' - 1]\n",
         "holonomic constraint 1 depends on velocities: it belongs under constraints"},
        {"holonomic: [t - 1]\n", "holonomic constraint 1 does not depend on the coordinates"},
        {"constraints: [x - 1]\n", "belongs under holonomic"},
        {"holonomic: [x - 1, y - 2, x + y - 3]\n",
         "holonomic constraint 3 is redundant, it depends on holonomic constraint 1, holonomic "
         "constraint 2"},
        {"constraints: [y']\nholonomic: [y - 2]\n",
         "holonomic constraint 1 is redundant, it depends on constraint 1"},
        {"holonomic: [x, y, z, x - y]\n", "4 constraints on 3 coordinates"},
        {"holonomic: [x - y]\nmechanics: vakonomic\n",
         "vakonomic mechanics takes no holonomic constraints"},
        {"holonomic: [x - y]\nstart: {solve: [x, y]}\n",
         "the start cannot be solved for y: there is 1 holonomic constraint, and as many "
         "coordinates before it"},
        {"holonomic: [x - y]\nstart: {solve: [w]}\n", "unknown coordinate or velocity in solve"},
        {"holonomic: [x - y]\ninvariants: {C1: x}\n", "reserved for a column"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[512];
        dal_model *model = NULL;
        const dal_system *system = NULL;
        dal_error error = {0};
        snprintf(text, sizeof text,
                 "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n%s",
                 cases[k].sections);
        CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, "case", text, strlen(text), &error),
                              DAL_STATUS_OK);
        CU_ASSERT_NOT_EQUAL(dal_model_system(model, &system, &error), DAL_STATUS_OK);
        if (!strstr(error.message, cases[k].message)) printf("\n  %s\n", error.message);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, cases[k].message));
        CU_ASSERT(error.line >= 3);
        dal_model_free(model);
    }
}

/* A redundant row where only g = 0 makes it one: bars of a closed parallelogram. */
static void test_redundant(void)
{
    static const char text[] =
        "coordinates: [x, y, u, v]\n"
        "lagrangian: (x'^2 + y'^2 + u'^2 + v'^2)/2\n"
        "holonomic: [x^2 + y^2 - 1, (u - x)^2 + (v - y)^2 - 4, (u - 2)^2 + v^2 - 1, v - y]\n"
        "start: {y: 1, u: 2, v: 1, x': 1, u': 1}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    fixture_refused(&spec, DAL_STATUS_RANK,
                    "holonomic constraint 4 restricts, except for rounding, only velocities that "
                    "holonomic constraint 1, holonomic constraint 3 restrict at the start");
}

void suite_holonomic(void)
{
    CU_pSuite suite = CU_add_suite("holonomic", NULL, NULL);
    CU_add_test(suite, "a pendulum, against its angles", test_pendulum);
    CU_add_test(suite, "g of t: a bead on a turning hoop, against its angle", test_hoop);
    CU_add_test(suite, "the reaction of a pendulum", test_reaction);
    CU_add_test(suite, "g and D at rounding level", test_levels);
    CU_add_test(suite, "every method keeps g or refuses", test_all_methods);
    CU_add_test(suite, "the option bare: g drifts", test_bare);
    CU_add_test(suite, "both spaces and lanes have the same bits", test_bits);
    CU_add_test(suite, "orders", test_order);
    CU_add_test(suite, "symmetry", test_symmetry);
    CU_add_test(suite, "coordinates and velocities that a start solves", test_solved);
    CU_add_test(suite, "the option consistent", test_consistent);
    CU_add_test(suite, "rows of g beside rows of D", test_rows_of_g);
    CU_add_test(suite, "an event sets q", test_event);
    CU_add_test(suite, "an impact leaves q", test_impact);
    CU_add_test(suite, "methods that are refused", test_methods_refused);
    CU_add_test(suite, "mass matrices that are refused", test_masses_refused);
    CU_add_test(suite, "methods that are completed", test_completed);
    CU_add_test(suite, "momenta that are refused", test_momenta);
    CU_add_test(suite, "effort constraint", test_effort);
    CU_add_test(suite, "errors of models", test_model_errors);
    CU_add_test(suite, "a row that depends on others where g = 0", test_redundant);
}
