/* test_restricted.c - motions whose W is regular on ker A only: closed forms by every method, and
 * the accelerations of the bordered system by two independent ways. */
#include "fixtures.h"
#include "reference.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A wheel without inertia: W = (1 0; 0 0), x = cos t, theta = 2 (cos t - 1). */
static const char wheel[] = "coordinates: [x, theta]\n"
                            "lagrangian: x'^2/2 - x^2/2\n"
                            "constraints: [x' - theta'/2]\n"
                            "start: {x: 1}\n";
/* det W = 1 - t: (1.01 - t/100) x' is constant, x = -101 log(1 - t/101), y = x/10. */
static const char slider[] = "coordinates: [x, y]\n"
                             "lagrangian: x'^2/2 + (1 - t)*y'^2/2\n"
                             "constraints: [y' - x'/10]\n"
                             "start: {x': 1, y': 0.1}\n";
/* W on ker A is 2 - t, times a positive number. */
static const char ending[] = "coordinates: [x, y]\n"
                             "lagrangian: x'^2/2 + 100*(1 - t)*y'^2/2\n"
                             "constraints: [y' - x'/10]\n"
                             "start: {x': 1, y': 0.1}\n";

static double wheel_error(const double *x, double t)
{
    const double defect[] = {x[0] - cos(t), x[1] - 2 * (cos(t) - 1), x[2] + sin(t),
                             x[3] + 2 * sin(t)};
    double max = 0.0;
    for (int i = 0; i < 4; i++) max = fmax(max, fabs(defect[i]));
    return max;
}

static double slider_error(const double *x, double t)
{
    const double q = -101 * log1p(-t / 101), v = 101 / (101 - t);
    const double defect[] = {x[0] - q, x[1] - q / 10, x[2] - v, x[3] - v / 10};
    double max = 0.0;
    for (int i = 0; i < 4; i++) max = fmax(max, fabs(defect[i]));
    return max;
}

/* ---- every method ---- */

typedef double error_function(const double *x, double t);

static double end_error(const dal_run_spec *spec, int count, double T, error_function *error)
{
    dal_run_spec again = *spec;
    again.options.step = T / count;
    dal_run *run = fixture_stepped(&again, count);
    const double found = error(dal_run_state(run), T);
    dal_run_free(run);
    return found;
}

/* The error falls by the order, or is rounding. */
static int check_methods(const char *text, double T, error_function *error)
{
    enum { COARSE = 40 };
    const double rounding = 1e-12;
    const dal_system *system = fixture_system(text);
    int accepted = 0;
    char name[128];
    CU_ASSERT(system->properties & DAL_MASS_ON_KERNEL);
    for (int i = 0; dal_integrator_at(i); i++)
        for (int space = 0; space < 2; space++) {
            dal_run_spec spec =
                fixture_spec(system, fixture_method(i, name, sizeof name), (dal_space)space, 0.1);
            if (!fixture_accepts(&spec.method, system, (dal_space)space)) {
                fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "cannot act on");
                continue;
            }
            const double first = end_error(&spec, COARSE, T, error);
            const double second = end_error(&spec, 2 * COARSE, T, error);
            const double ratio = exp2(dal_method_order(&spec.method) - 0.3);
            const bool is_right = second <= rounding || (first < 0.3 && second <= first / ratio);
            if (!is_right) printf("\n  %s: %.2g, %.2g\n", name, first, second);
            CU_ASSERT(is_right);
            accepted++;
        }
    return accepted;
}

static void test_methods(void)
{
    CU_ASSERT(check_methods(wheel, 2.0, wheel_error) > 60);
    CU_ASSERT(check_methods(slider, 2.0, slider_error) > 50); /* steps end at t = 1 */
}

/* Backwards, where det W is negative first. */
static void test_backwards(void)
{
    static const char *const methods[] = {"gauss8", "taylor", "spark6+project", "dop853"};
    const dal_setting start[] = {{"x", -101 * log1p(-2.0 / 101)},
                                 {"y", -10.1 * log1p(-2.0 / 101)},
                                 {"x'", 101.0 / 99},
                                 {"y'", 10.1 / 99}};
    for (int i = 0; i < 4; i++) {
        dal_run_spec spec = fixture_spec(fixture_system(slider), methods[i], DAL_PHYSICAL, -0.02);
        spec.start = start;
        spec.start_count = 4;
        spec.start_time = 2.0;
        dal_run *run = fixture_stepped(&spec, 100);
        CU_ASSERT(slider_error(dal_run_state(run), 0.0) < 1e-12);
        dal_run_free(run);
    }
}

/* E of the wheel is conserved, and by the methods that say so: its potential moves theta. */
static void test_energy(void)
{
    static const char pendulum[] = "coordinates: [x, theta]\n"
                                   "lagrangian: x'^2/2 + cos(theta)\n"
                                   "constraints: [x' - theta'/2]\n"
                                   "start: {x: 0.5, theta: 1}\n";
    static const char *const methods[] = {"discrete-gradient", "rk4+project-energy"};
    const dal_system *system = fixture_system(pendulum);
    for (int i = 0; i < 2; i++) {
        const dal_run_spec spec = fixture_spec(system, methods[i], DAL_PHYSICAL, 0.05);
        dal_run *run = fixture_stepped(&spec, 400);
        const double *x = dal_run_state(run);
        CU_ASSERT(fabs(x[2] * x[2] / 2 - cos(x[1]) + cos(1.0)) < 1e-13);
        CU_ASSERT(fabs(x[2] - x[3] / 2) < 1e-13);
        dal_run_free(run);
    }
}

/* Along F continued off D = 0 neither E nor D changes there. */
static void test_extension(void)
{
    const dal_system *system = fixture_system(wheel)->extended;
    const double q[] = {0.3, -0.4}, v[] = {0.9, 0.5};
    const dal_point at = {.t = 0.0, .q = q, .v = v};
    double rate = 1.0;
    CU_ASSERT_PTR_NOT_NULL_FATAL(system);
    CU_ASSERT(system != fixture_system(wheel));
    dal_evaluator *evaluator = fixture_evaluator(system);
    CU_ASSERT_EQUAL(dal_evaluator_measure_rate(evaluator, system->energy, 1, &at, &rate),
                    DAL_STATUS_OK);
    CU_ASSERT(fabs(rate) <= 1e-11);
    CU_ASSERT_EQUAL(dal_evaluator_measure_rate(evaluator, system->constraints, 1, &at, &rate),
                    DAL_STATUS_OK);
    CU_ASSERT(fabs(rate) <= 1e-11);
    dal_evaluator_free(evaluator);
}

static void test_lanes(void)
{
    static const char *const methods[] = {
        "gauss6+project", "gni", "spark4", "taylor", "mclachlan-perlmutter+yoshida4", "rk4"};
    for (int i = 0; i < 6; i++) {
        dal_run_spec spec = fixture_spec(fixture_system(wheel), methods[i], DAL_PHYSICAL, 0.1);
        fixture_lanes(spec, 11, 25, "x", 0.5, 0.1);
        spec.system = fixture_system(slider);
        fixture_lanes(spec, 11, 25, "x", 0.5, 0.1);
    }
}

/* ---- accelerations ---- */

/* Two constraints, one nonlinear, and a velocity without a mass: against elimination with row
 * pivots in the bordered system, of differences. */
#define MASSLESS                                                                                   \
    "coordinates: [x, y, z]\n"                                                                     \
    "lagrangian: x'^2/2 + (1 - t)*y'^2/2 + 0.3*x'*z' - x^2/2 - z^2/2 - x*y/5\n"                    \
    "forces: {x: -x'/10 + y'/20, y: x'*y'/5, z: -x'/10}\n"                                         \
    "constraints:\n"                                                                               \
    "  - y' - (0.3 + sin(x)/10)*x' - x'^2/5\n"                                                     \
    "  - z' - x'*cos(x) - y'*x'/10 - t/10\n"                                                       \
    "start: {x: 0.4, x': 1, solve: [y', z']}\n"

static double massless_lagrangian(int i, const double *q, const double *v, double t)
{
    (void)i;
    return v[0] * v[0] / 2 + (1 - t) * v[1] * v[1] / 2 + 0.3 * v[0] * v[2] - q[0] * q[0] / 2 -
           q[2] * q[2] / 2 - q[0] * q[1] / 5;
}

static double massless_force(int i, const double *q, const double *v, double t)
{
    (void)q, (void)t;
    return i == 0 ? -v[0] / 10 + v[1] / 20 : i == 1 ? v[0] * v[1] / 5 : -v[0] / 10;
}

static double massless_constraint(int a, const double *q, const double *v, double t)
{
    if (a == 0) return v[1] - (0.3 + sin(q[0]) / 10) * v[0] - v[0] * v[0] / 5;
    return v[2] - v[0] * cos(q[0]) - v[1] * v[0] / 10 - t / 10;
}

static void test_bordered(void)
{
    const reference_formulas formulas = {
        3, 2, massless_lagrangian, massless_force, massless_constraint, NULL};
    reference b = reference_of_text(MASSLESS);
    CU_ASSERT(b.system->properties & DAL_MASS_ON_KERNEL);
    for (int k = 0; k < 40; k++) {
        double F[3], expected[3], q[REFERENCE_MAX] = {0.0}, v[REFERENCE_MAX] = {0.0};
        const double t = 0.05 * k; /* 1 among them */
        for (int i = 0; i < 3; i++) {
            q[i] = sin(3.0 * k + i);
            v[i] = 0.8 * cos(2.0 * k + 5 * i);
        }
        reference_motion(&formulas, q, v, t, expected);
        CU_ASSERT_EQUAL(reference_call(&b, b.system->call.field, t, q, v, F), DAL_STATUS_OK);
        CU_ASSERT(reference_distance(3, F, expected) < 1e-9);
    }
    reference_free(&b);
}

/* Random W of (f, g, d) with d = r f + s sin g, singular or indefinite, and the same Lagrangian of
 * (f, g), in which d and d' are formulas. */
typedef struct family {
    double w[6], r, s; /* ff, fg, fd, gg, gd, dd */
    int turns;         /* dd is multiplied by 1 - t */
} family;

static double next_random(unsigned long long *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

static family draw(unsigned long long *state, int k)
{
    family f;
    for (int i = 0; i < 6; i++) f.w[i] = next_random(state);
    if (k % 3 == 0) f.w[2] = f.w[4] = f.w[5] = 0.0; /* d has no kinetic energy */
    if (k % 3 == 1)                                 /* rank 2 */
        f.w[5] =
            (f.w[2] * f.w[2] * f.w[3] - 2 * f.w[1] * f.w[2] * f.w[4] + f.w[4] * f.w[4] * f.w[0]) /
            (f.w[0] * f.w[3] - f.w[1] * f.w[1]);
    f.turns = k % 3 == 2;
    f.r = next_random(state);
    f.s = next_random(state);
    return f;
}

/* det W on ker A, in f' and g', over the square of its size. */
static double regularity(const family *f, const double *q, double t)
{
    const double r = f->r, s = f->s * cos(q[1]), dd = f->w[5] * (f->turns ? 1 - t : 1);
    const double a = f->w[0] + 2 * r * f->w[2] + r * r * dd;
    const double b = f->w[1] + s * f->w[2] + r * f->w[4] + r * s * dd;
    const double c = f->w[3] + 2 * s * f->w[4] + s * s * dd;
    return fabs(a * c - b * b) / fmax(1.0, a * a + 2 * b * b + c * c);
}

/* The lines of L; d and w are the names of d and d'. */
static void write_lagrangian(const family *f, const char *d, const char *w, char *out, size_t size)
{
    snprintf(out, size,
             "lagrangian: %.17g*f'^2/2 + %.17g*f'*g' + %.17g*f'*%s + %.17g*g'^2/2 + %.17g*g'*%s + "
             "%.17g*(%s)*%s^2/2 - f^2/2 - f*g*%s - cos(%s)\n",
             f->w[0], f->w[1], f->w[2], w, f->w[3], f->w[4], w, f->w[5], f->turns ? "1 - t" : "1",
             w, d, d);
}

static void compare_family(const family *f, unsigned long long *state, int *restricted, int *points)
{
    char text[1024], L[512];
    write_lagrangian(f, "d", "d'", L, sizeof L);
    snprintf(text, sizeof text,
             "coordinates: [f, g, d]\n%sconstraints: ['d'' - %.17g*f'' - "
             "%.17g*cos(g)*g''']\n",
             L, f->r, f->s);
    reference whole = reference_of_text(text);
    write_lagrangian(f, "d", "w", L, sizeof L);
    snprintf(text, sizeof text,
             "coordinates: [f, g]\nlet: {d: %.17g*f + %.17g*sin(g), w: %.17g*f' + "
             "%.17g*cos(g)*g'}\n%s",
             f->r, f->s, f->r, f->s, L);
    reference reduced = reference_of_text(text);
    *restricted += (whole.system->properties & DAL_MASS_ON_KERNEL) != 0;
    for (int k = 0; k < 8; k++) {
        double q[3], v[3], F[3], expected[2];
        const double t = 1 + next_random(state);
        for (int i = 0; i < 2; i++) {
            q[i] = next_random(state);
            v[i] = next_random(state);
        }
        q[2] = f->r * q[0] + f->s * sin(q[1]);
        v[2] = f->r * v[0] + f->s * cos(q[1]) * v[1];
        if (regularity(f, q, t) < 0.05) continue;
        reference_call(&whole, whole.system->call.field, t, q, v, F);
        reference_call(&reduced, reduced.system->call.field, t, q, v, expected);
        CU_ASSERT(reference_distance(2, F, expected) < 1e-12);
        const double along = f->r * F[0] + f->s * (cos(q[1]) * F[1] - sin(q[1]) * v[1] * v[1]);
        CU_ASSERT(fabs(F[2] - along) < 1e-12 * fmax(1.0, fabs(along)));
        ++*points;
    }
    reference_free(&whole);
    reference_free(&reduced);
}

static void test_family(void)
{
    enum { SYSTEMS = 60 };
    unsigned long long state = 27;
    int restricted = 0, points = 0;
    for (int k = 0; k < SYSTEMS; k++) {
        const family f = draw(&state, k);
        const double q[] = {0.0, 0.0};
        if (regularity(&f, q, 0.0) < 0.05) continue;
        compare_family(&f, &state, &restricted, &points);
    }
    CU_ASSERT(restricted > SYSTEMS / 3);
    CU_ASSERT(points > 2 * SYSTEMS);
}

/* The reaction on y of the slider is the rate of (1 - t) y'. */
static void test_reaction(void)
{
    reference b = reference_of_text(slider);
    for (int k = 0; k <= 4; k++) {
        const double t = 0.5 * k, q[] = {0.3, 0.03}, v[] = {1.0, 0.1}, a = 1 / (101 - t);
        double out[3];
        CU_ASSERT_EQUAL(reference_call(&b, b.system->reactions, t, q, v, out), DAL_STATUS_OK);
        CU_ASSERT(fabs(out[0] - ((1 - t) * a / 10 - 0.1)) < 1e-15);
    }
    reference_free(&b);
}

/* A wall at x = 0.5 reflects the wheel with its angle. */
static void test_impact(void)
{
    static const char text[] = "coordinates: [x, theta]\n"
                               "lagrangian: x'^2/2\n"
                               "constraints: [x' - theta'/2]\n"
                               "events: [{when: theta - 1, restitution: 0.5}]\n"
                               "start: {x': 1, theta': 2}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_stepped(&spec, 10);
    const double *x = dal_run_state(run);
    CU_ASSERT(fabs(x[2] + 0.5) < 1e-13 && fabs(x[3] + 1.0) < 1e-13);
    CU_ASSERT(dal_run_time(run) > 0.5);
    CU_ASSERT(fabs(x[0] - 0.5 + (dal_run_time(run) - 0.5) / 2) < 1e-12);
    CU_ASSERT(fabs(x[1] - 2 * x[0]) < 1e-12);
    dal_run_free(run);
}

/* ---- where the motion is not determined ---- */

static void test_ending(void)
{
    static const char *const methods[] = {"rk4", "gauss6", "gni", "taylor", "spark4+project"};
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 2; k++) {
            const double h = k ? 0.0625 : 0.07; /* a step ends at t = 2, or none does */
            const dal_run_spec spec =
                fixture_spec(fixture_system(ending), methods[i], DAL_PHYSICAL, h);
            dal_run *run = fixture_run(&spec);
            dal_error error = {0};
            const dal_status status = dal_run_advance(run, 60, &error);
            CU_ASSERT_EQUAL(status, DAL_STATUS_SINGULAR_MASS);
            CU_ASSERT(strstr(error.message, "ker A") || strstr(error.message, "constraints allow"));
            CU_ASSERT(fabs(dal_run_time(run) - 2.0) < 2 * h); /* gni fails a step before */
            dal_run_free(run);
        }
}

static void refused(const char *text, dal_status status, const char *fragment)
{
    dal_model *model = NULL;
    const dal_system *system;
    dal_error error = {0};
    CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, "text", text, strlen(text), &error),
                          DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_system(model, &system, &error), status);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
    dal_model_free(model);
}

static void test_refused(void)
{
    refused("coordinates: [x, y]\nlagrangian: x'^2/2\nconstraints: [x' - x]\n",
            DAL_STATUS_SINGULAR_MASS, "on the velocities that the constraints allow");
    refused("coordinates: [x, y, z]\nlagrangian: x'^2/2\nconstraints: [x' - y', 2*x' - 2*y']\n",
            DAL_STATUS_RANK, "is redundant, it depends on");
    refused("coordinates: [x, y]\nlagrangian: x'^2/2\n", DAL_STATUS_SINGULAR_MASS,
            "does not determine the acceleration of 'y'");
    const dal_run_spec spec = fixture_spec(fixture_system(ending), "rk4", DAL_PHYSICAL, 0.1);
    dal_run_spec late = spec;
    late.start_time = 2.0;
    fixture_refused(&late, DAL_STATUS_SINGULAR_MASS, "constraints allow, is singular at the start");
}

/* ---- ranks ---- */

static void check_ranks(const char *text, double t, double x, int constraints, int mass)
{
    reference b = reference_of_text(text);
    const double q[3] = {x, 0.2, 0.1}, v[3] = {0.3, 0.1, 0.2};
    const dal_point at = {.t = t, .q = q, .v = v};
    dal_ranks ranks = {0};
    CU_ASSERT_EQUAL(dal_model_ranks(b.model, NULL, 0, &at, NULL, &ranks, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(ranks.constraints, constraints);
    CU_ASSERT_EQUAL(ranks.mass, mass);
    CU_ASSERT((ranks.mass_pivot > 0.0) == (mass > 0));
    reference_free(&b);
}

static void test_ranks(void)
{
    check_ranks(wheel, 0.0, 0.5, 1, 1);
    check_ranks(slider, 1.0, 0.5, 1, 1);
    check_ranks(ending, 1.0, 0.5, 1, 1);
    check_ranks(ending, 2.0, 0.5, 1, 0);
    check_ranks("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [x*x']\n"
                "start: {x: 1}\n",
                0.0, 0.0, 0, -1);
    check_ranks("coordinates: [x, y]\nlagrangian: (x'^2 + 1e-12*y'^2)/2\n", 0.0, 0.0, 0, 2);
}

static void test_ranks_refused(void)
{
    const double x[2] = {0.0, 0.0};
    const dal_point at = {.q = x, .v = x};
    dal_ranks ranks;
    reference b = reference_of_text("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                    "mechanics: vakonomic\nconstraints: [x']\n");
    CU_ASSERT_EQUAL(dal_model_ranks(b.model, NULL, 0, &at, NULL, &ranks, NULL),
                    DAL_STATUS_UNSUPPORTED);
    reference_free(&b);
    b = reference_of_text("coordinates: [x, y]\nlagrangian: (x'^2/x + y'^2)/2\nstart: {x: 1}\n");
    CU_ASSERT_EQUAL(dal_model_ranks(b.model, NULL, 0, &at, NULL, &ranks, NULL),
                    DAL_STATUS_NOT_FINITE);
    const dal_setting unknown = {"k", 1.0};
    CU_ASSERT_EQUAL(dal_model_ranks(b.model, &unknown, 1, &at, NULL, &ranks, NULL),
                    DAL_STATUS_NAME);
    reference_free(&b);
}

void suite_restricted(void)
{
    CU_pSuite suite = CU_add_suite("W regular on ker A only", NULL, NULL);
    CU_add_test(suite, "closed forms by every method", test_methods);
    CU_add_test(suite, "backwards", test_backwards);
    CU_add_test(suite, "energy", test_energy);
    CU_add_test(suite, "extension", test_extension);
    CU_add_test(suite, "lanes", test_lanes);
    CU_add_test(suite, "accelerations by elimination", test_bordered);
    CU_add_test(suite, "accelerations of reduced Lagrangians", test_family);
    CU_add_test(suite, "a reaction", test_reaction);
    CU_add_test(suite, "an impact", test_impact);
    CU_add_test(suite, "W becomes singular on ker A", test_ending);
    CU_add_test(suite, "not determined anywhere", test_refused);
    CU_add_test(suite, "ranks", test_ranks);
    CU_add_test(suite, "ranks that are refused", test_ranks_refused);
}
