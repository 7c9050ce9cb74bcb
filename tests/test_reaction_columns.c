/* test_reaction_columns.c - the option reactions: h1.., R_x.. of F and lambda1.. of a method as
 * observables, and h, R in invariants, against closed forms. */
#include "motion.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define SMALL          1e-12
#define BY_DIFFERENCES 1e-10

enum { MAX_OBSERVABLES = 32, MAX_SETTINGS = 5 };

/* ---- a run that observes its reactions ---- */

typedef struct observed {
    reference b;
    dal_run *run;
    const double *x;
    double value[MAX_OBSERVABLES];
} observed;

static dal_run_spec spec_of(const dal_system *system, const char *method, dal_space space)
{
    dal_run_spec spec = {.system = system, .options = dal_options_default()};
    spec.options.space = space;
    spec.options.step = 0.05;
    spec.options.reactions = 1;
    CU_ASSERT_FATAL(dal_method_parse(&spec.method, method, NULL) == DAL_STATUS_OK);
    return spec;
}

static void observe(observed *o)
{
    CU_ASSERT_FATAL(dal_run_observables(o->run) <= MAX_OBSERVABLES);
    CU_ASSERT_FATAL(dal_run_observe(o->run, o->value) == DAL_STATUS_OK);
    o->x = dal_run_state(o->run);
}

static observed open_run(reference b, dal_run_spec spec)
{
    observed o = {.b = b};
    CU_ASSERT_FATAL(dal_run_create(&o.run, &spec, NULL) == DAL_STATUS_OK);
    observe(&o);
    return o;
}

static void close_run(observed *o)
{
    dal_run_free(o->run);
    reference_free(&o->b);
}

static void advance(observed *o, long long steps)
{
    CU_ASSERT_FATAL(dal_run_advance(o->run, steps, NULL) == DAL_STATUS_OK);
    observe(o);
}

/* The present value of an observable by its name. */
static double get(const observed *o, const char *name)
{
    char other[64];
    for (int i = 0; dal_run_observable_name(o->run, i, other, sizeof other); i++)
        if (strcmp(other, name) == 0) return o->value[i];
    CU_FAIL("no such observable");
    return NAN;
}

static bool near(double a, double b) { return fabs(a - b) < SMALL * fmax(1.0, fabs(b)); }

/* ---- closed forms ---- */

/* The sleigh on its circle: the blade is pushed across by m v omega, towards the centre. */
static void test_sleigh(void)
{
    const dal_setting set[] = {{"m", 2.5}, {"v0", 0.8}, {"omega", 1.3}};
    const double force = 2.5 * 0.8 * 1.3;
    for (int space = 0; space < 2; space++) {
        reference b = reference_builtin("chaplygin-sleigh");
        dal_run_spec spec = spec_of(b.system, "gauss8", space ? DAL_LIFTED : DAL_PHYSICAL);
        spec.parameters = set;
        spec.parameter_count = 3;
        observed o = open_run(b, spec);
        for (int k = 0; k < 5; k++, advance(&o, 20)) {
            const double phi = o.x[2];
            CU_ASSERT(near(get(&o, "R_y1"), -force * sin(phi)));
            CU_ASSERT(near(get(&o, "R_y2"), force * cos(phi)));
            CU_ASSERT(near(get(&o, "R_phi"), 0.0));
            CU_ASSERT(near(get(&o, "h1"), -force));
        }
        close_run(&o);
    }
}

/* The disk in steady motion: theta, s and phi' constant, and the centre moves on a circle.  With
 * p = theta' = 0, q = phi' sin theta:   0 = A q^2 cot theta - (C + m r^2) q s - m g r cos theta. */
static void test_disk(void)
{
    const double A = 0.25, C = 0.5, theta = 1.2, q = 0.4, rate = q / sin(theta);
    const double s = (A * q * q / tan(theta) - cos(theta)) / ((C + 1) * q);
    const dal_setting set[] = {{"theta0", theta}, {"p0", 0.0}, {"q0", q}, {"s0", s}};
    reference b = reference_builtin("falling-disk");
    dal_run_spec spec = spec_of(b.system, "gauss8", DAL_PHYSICAL);
    spec.parameters = set;
    spec.parameter_count = 4;
    observed o = open_run(b, spec);
    for (int k = 0; k < 5; k++, advance(&o, 10)) {
        const double phi = o.x[3];
        CU_ASSERT(near(o.x[2], theta));
        CU_ASSERT(near(get(&o, "R_X"), s * rate * sin(phi)));
        CU_ASSERT(near(get(&o, "R_Y"), -s * rate * cos(phi)));
        CU_ASSERT(near(get(&o, "h1"), get(&o, "R_X")) && near(get(&o, "h2"), get(&o, "R_Y")));
    }
    close_run(&o);
}

/* The blade on a slope: its exact solution gives u; formulas with h1, R_x are invariants. */
static void test_knife_edge(void)
{
    reference b = reference_builtin("knife-edge-reaction");
    const double slope = sin(0.5), m = 2.0;
    observed o = open_run(b, spec_of(b.system, "gauss8", DAL_PHYSICAL));
    for (int k = 0; k < 5; k++, advance(&o, 20)) {
        const double t = dal_run_time(o.run), phi = 0.2 + t;
        const double u = 0.3 + slope * (sin(phi) - sin(0.2));
        CU_ASSERT(near(get(&o, "h1"), -m * (u + slope * sin(phi))));
        CU_ASSERT(near(get(&o, "hold"), -m * (0.3 - slope * sin(0.2))));
        CU_ASSERT(near(get(&o, "along"), 0.0));
        CU_ASSERT(near(get(&o, "R_x"), get(&o, "h1") * sin(phi)));
    }
    close_run(&o);
}

/* The motor holds the cart: it acts on x alone, and gives what moves cart and pendulum. */
static void test_servo(void)
{
    reference b = reference_builtin("servo-pendulum");
    const double M = 2.0, m = 1.0;
    observed o = open_run(b, spec_of(b.system, "gauss8", DAL_PHYSICAL));
    for (int k = 0; k < 5; k++, advance(&o, 20)) {
        double F[2];
        const double theta = o.x[1], omega = o.x[3];
        reference_call(&b, b.system->call.field, 0.0, o.x, o.x + 2, F);
        const double pushed = (M + m) * F[0] + m * (F[1] * cos(theta) - omega * omega * sin(theta));
        CU_ASSERT(near(get(&o, "R_x"), pushed));
        CU_ASSERT(get(&o, "h1") == get(&o, "R_x") && get(&o, "R_theta") == 0.0);
    }
    close_run(&o);
}

/* ---- by differences: R = W F - b, where b has the forces, so that R has none ---- */

static const char *const full_text =
    REFERENCE_FULL "constraints: [3*(x' + y*z' - t), x'*y' + z'^2/2 - x]\n"
                   "invariants: {first: h1, push: R_x + 2*R_z, product: h2*R_y}\n";

static double full_constraint(int a, const double *q, const double *v, double t)
{
    return a ? v[0] * v[1] + v[2] * v[2] / 2 - q[0] : 3 * (v[0] + q[1] * v[2] - t);
}

static void test_differences(void)
{
    static const reference_formulas full = {
        3, 2, reference_full_lagrangian, reference_full_force, full_constraint, NULL};
    static const double q[REFERENCE_MAX] = {0.3, -0.4, 0.7}, v[REFERENCE_MAX] = {0.5, 0.9, -0.3};
    static const double t = 0.35;
    reference b = reference_of_text(full_text);
    double F[3], R[3], out[2 + 6], sum[3], invariant[3];
    reference_motion(&full, q, v, t, F);
    for (int i = 0; i < 3; i++) {
        R[i] = -reference_load(&full, i, q, v, t);
        for (int j = 0; j < 3; j++) R[i] += reference_mass(&full, i, j, q, v, t) * F[j];
    }
    CU_ASSERT_FATAL(reference_call(&b, b.system->reactions, t, q, v, out) == DAL_STATUS_OK);
    for (int i = 0; i < 3; i++) sum[i] = out[0] * out[2 + i] + out[1] * out[5 + i];
    CU_ASSERT(reference_distance(3, sum, R) < BY_DIFFERENCES);
    CU_ASSERT(fabs(out[2] - 3.0) < SMALL); /* D as written */
    CU_ASSERT(reference_call(&b, b.system->invariant_values, t, q, v, invariant) == DAL_STATUS_OK);
    const double expected[] = {out[0], R[0] + 2 * R[2], out[1] * R[1]};
    CU_ASSERT(reference_distance(3, invariant, expected) < BY_DIFFERENCES);
    reference_free(&b);
}

/* ---- multipliers of a method ---- */

/* The last multiplier of RATTLE: v1 = vh + h/2 lambda A^T with vh = (q1 - q0)/h, for the sleigh
 * with unit masses, where A A^T = 1; not F's multiplier. */
static void test_rattle(void)
{
    reference b = reference_builtin("chaplygin-sleigh");
    observed o = open_run(b, spec_of(b.system, "gni", DAL_PHYSICAL));
    const double h = 0.05;
    CU_ASSERT(get(&o, "lambda1") == get(&o, "h1"));
    for (int k = 0; k < 20; k++) {
        const double x = o.x[0], y = o.x[1];
        advance(&o, 1);
        const double wx = o.x[3] - (o.x[0] - x) / h, wy = o.x[4] - (o.x[1] - y) / h;
        const double expected = 2 / h * (wx * sin(o.x[2]) - wy * cos(o.x[2]));
        CU_ASSERT(fabs(get(&o, "lambda1") - expected) < SMALL / h);
        CU_ASSERT(fabs(get(&o, "lambda1") - get(&o, "h1")) < h * h);
        CU_ASSERT(k > 0 || get(&o, "lambda1") != get(&o, "h1"));
    }
    close_run(&o);
}

/* A restored run has the same reactions and multipliers. */
static void test_restored(void)
{
    reference b = reference_builtin("knife-edge-reaction");
    dal_run_spec spec = spec_of(b.system, "lobatto-nonholonomic4", DAL_PHYSICAL);
    observed o = open_run(b, spec);
    dal_run *other;
    double value[MAX_OBSERVABLES];
    size_t count;
    advance(&o, 7);
    CU_ASSERT_FATAL(dal_run_create(&other, &spec, NULL) == DAL_STATUS_OK);
    const double *saved = dal_run_save(o.run, &count);
    CU_ASSERT(dal_run_restore(other, saved, count, NULL) == DAL_STATUS_OK);
    CU_ASSERT(dal_run_observe(other, value) == DAL_STATUS_OK);
    const size_t bytes = (size_t)dal_run_observables(other) * sizeof *value;
    CU_ASSERT(memcmp(value, o.value, bytes) == 0);
    dal_run_free(other);
    close_run(&o);
}

/* In quad precision h1 follows from the same formula: roundings apart. */
static void test_quad(void)
{
    reference b = reference_builtin("knife-edge-reaction");
    dal_run_spec spec = spec_of(b.system, "gauss8", DAL_PHYSICAL);
    spec.options.precision = DAL_QUAD;
    dal_run *run;
    double value[MAX_OBSERVABLES];
    if (!b.system->quad) {
        reference_free(&b);
        return;
    }
    observed o = open_run(b, spec_of(b.system, "gauss8", DAL_PHYSICAL));
    CU_ASSERT_FATAL(dal_run_create(&run, &spec, NULL) == DAL_STATUS_OK);
    advance(&o, 20);
    CU_ASSERT(dal_run_advance(run, 20, NULL) == DAL_STATUS_OK);
    CU_ASSERT(dal_run_observe(run, value) == DAL_STATUS_OK);
    CU_ASSERT(reference_distance(dal_run_observables(run), o.value, value) < SMALL);
    dal_run_free(run);
    close_run(&o);
}

/* ---- refusals ---- */

static void check_refused(reference b, dal_run_spec spec, dal_status status, const char *message)
{
    dal_error error = {0};
    dal_run *run;
    CU_ASSERT(dal_run_create(&run, &spec, &error) == status);
    CU_ASSERT(strstr(error.message, message) != NULL);
    if (!strstr(error.message, message)) printf("    %s\n", error.message);
    dal_run_free(run);
    reference_free(&b);
}

static void test_refused(void)
{
    reference b = reference_builtin("damped-oscillator");
    check_refused(b, spec_of(b.system, "rk4", DAL_PHYSICAL), DAL_STATUS_UNSUPPORTED,
                  "the system has no constraints");
    b = reference_builtin("chaplygin-sleigh-vakonomic");
    check_refused(b, spec_of(b.system, "rk4", DAL_PHYSICAL), DAL_STATUS_UNSUPPORTED, "g1, g2");
    b = reference_builtin("contact-oscillator");
    dal_run_spec spec = spec_of(b.system, "rk4", DAL_PHYSICAL);
    spec.options.extend_energy = 1;
    check_refused(b, spec, DAL_STATUS_UNSUPPORTED, "F continued off D = 0");
    b = reference_of_text("coordinates: [x, h1]\nlagrangian: x'^2 + h1'^2\n"
                          "constraints: [x' - h1']\n");
    check_refused(b, spec_of(b.system, "rk4", DAL_PHYSICAL), DAL_STATUS_NAME,
                  "'h1' is also the name of a coordinate");
    b = reference_builtin("chaplygin-sleigh");
    dal_system plain = *b.system;
    plain.reactions = NULL;
    check_refused(b, spec_of(&plain, "rk4", DAL_PHYSICAL), DAL_STATUS_UNSUPPORTED, "no callback");
}

void suite_reaction_columns(void)
{
    CU_pSuite suite = CU_add_suite("reactions as observables", NULL, NULL);
    CU_add_test(suite, "sleigh: m v omega", test_sleigh);
    CU_add_test(suite, "falling disk in steady motion", test_disk);
    CU_add_test(suite, "knife edge on a slope", test_knife_edge);
    CU_add_test(suite, "pendulum on a cart: along the given direction", test_servo);
    CU_add_test(suite, "W F - b, and formulas", test_differences);
    CU_add_test(suite, "multipliers of RATTLE", test_rattle);
    CU_add_test(suite, "restored", test_restored);
    CU_add_test(suite, "quad precision", test_quad);
    CU_add_test(suite, "refusals", test_refused);
}
