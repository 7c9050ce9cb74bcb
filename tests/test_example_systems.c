/* test_example_systems.c - the system files of examples/, with every method that accepts them. */
#include "dalembert.h"
#include "quick.h"

#include <CUnit/CUnit.h>
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const dal_system *open_system(dal_model **model, const char *name)
{
    const dal_system *system = NULL;
    char path[256];
    snprintf(path, sizeof path, "examples/%s", name);
    CU_ASSERT_FATAL(dal_model_read_file(model, path, NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_model_system(*model, &system, NULL) == DAL_STATUS_OK);
    return system;
}

/* A run with the integrator number i in (q,v), or NULL where it is a modifier or needs what the
 * system lacks. */
static dal_run *create_run(const dal_system *system, int i, double step)
{
    const dal_integrator *integrator = dal_integrator_at(i);
    dal_run_spec spec = {.system = system, .options = dal_options_default()};
    dal_run *run = NULL;
    if (integrator->properties & DAL_MODIFIER) return NULL;
    CU_ASSERT_EQUAL(dal_method_parse(&spec.method, integrator->name, NULL), DAL_STATUS_OK);
    spec.options.space = DAL_PHYSICAL;
    spec.options.step = step;
    spec.options.consistent = 1; /* the car with trailers begins off D = 0 */
    const dal_status status = dal_run_create(&run, &spec, NULL);
    CU_ASSERT(status == DAL_STATUS_OK || status == DAL_STATUS_UNSUPPORTED);
    return status == DAL_STATUS_OK ? run : NULL;
}

/* One step of a large system by an implicit method takes a tenth of a second, and under valgrind
 * fifty times that. */
static long long steps_of(const dal_system *system, const dal_integrator *integrator)
{
    if (system->n < 100) return 3;
    return integrator->properties & DAL_EXPLICIT ? 3 : long_run(100) / 100;
}

static void take_steps(const char *name)
{
    dal_model *model = NULL;
    const dal_system *system = open_system(&model, name);
    int accepted = 0;
    for (int i = 0; dal_integrator_at(i); i++) {
        dal_error error = {0};
        dal_run *run = create_run(system, i, 1e-3);
        if (!run) continue;
        accepted++;
        CU_ASSERT_EQUAL(dal_run_advance(run, steps_of(system, dal_integrator_at(i)), &error),
                        DAL_STATUS_OK);
        if (error.status != DAL_STATUS_OK)
            printf("%s, %s: %s\n", name, dal_integrator_at(i)->name, error.message);
        dal_run_free(run);
    }
    CU_ASSERT(accepted >= 10);
    dal_model_free(model);
}

static void test_every_file(void)
{
    int files = 0;
    DIR *directory = opendir("examples");
    CU_ASSERT_FATAL(directory != NULL);
    for (struct dirent *entry; (entry = readdir(directory));) {
        if (!strstr(entry->d_name, ".yaml")) continue;
        files++;
        take_steps(entry->d_name);
    }
    closedir(directory);
    CU_ASSERT(files >= 4);
}

/* ---- motions ---- */

/* The largest error in q that is allowed at the end, by the order of the method. */
static double allowed(int order) { return order == 1 ? 0.2 : order == 2 ? 1e-2 : 2e-5; }

/* Runs to T with every method; q[n] is where the motion is then. */
static void compare_ends(const char *name, double step, double T, const double *q)
{
    dal_model *model = NULL;
    const dal_system *system = open_system(&model, name);
    for (int i = 0; dal_integrator_at(i); i++) {
        dal_run *run = create_run(system, i, step);
        if (!run) continue;
        dal_method method = {.layer = {dal_integrator_at(i)}};
        double worst = 0.0;
        CU_ASSERT_EQUAL(dal_run_advance(run, (long long)(T / step + 0.5), NULL), DAL_STATUS_OK);
        for (int k = 0; k < system->n; k++) worst = fmax(worst, fabs(dal_run_state(run)[k] - q[k]));
        CU_ASSERT(worst <= allowed(dal_method_order(&method)));
        if (!(worst <= allowed(dal_method_order(&method))))
            printf("%s, %s: %g\n", name, dal_integrator_at(i)->name, worst);
        dal_run_free(run);
    }
    dal_model_free(model);
}

/* The contact force (-m nu^2 r, m g) and its moment turn the angular velocity (w, s) of the ball
 * about the vertical with the rate nu; the ball does not slip. */
static void test_rotating_bowl(void)
{
    static const double m = 1, a = 0.1, I = 0.004, c = 0.8, g = 9.81, Omega = 3, r = 0.5, nu = 2;
    const double root = sqrt(1 + c * c * r * r), T = 1.0;
    const double w = a * m * r * (nu * nu - c * g) / root / (I * nu);
    const double s = root * (Omega - nu) / (a * c) + Omega - w / (c * r);
    const double end[5] = {r * cos(nu * T), r * sin(nu * T), w / nu * sin(nu * T),
                           w / nu * (1 - cos(nu * T)), s * T};
    compare_ends("rotating-bowl.yaml", 0.005, T, end);
}

enum { ATOMS = 8 };
static const double initial_temperature = 0.5, heating = 0.05, beta = 0.5;

static double spring_force(double r) { return r + beta * r * r * r; }

/* Gauss's principle by hand: v' = f + (N rate/2 - f.v)/(v.v) v. */
static void evaluate_thermostat(const double *y, double *dy)
{
    const double *x = y, *v = y + ATOMS;
    double power = 0.0, square = 0.0;
    for (int i = 0; i < ATOMS; i++) {
        const double left = i > 0 ? x[i] - x[i - 1] : x[i];
        const double right = i < ATOMS - 1 ? x[i + 1] - x[i] : -x[i];
        dy[i] = v[i];
        dy[ATOMS + i] = spring_force(right) - spring_force(left);
        power += dy[ATOMS + i] * v[i];
        square += v[i] * v[i];
    }
    const double heat = (0.5 * ATOMS * heating - power) / square;
    for (int i = 0; i < ATOMS; i++) dy[ATOMS + i] += heat * v[i];
}

static void step_thermostat(double *y, double h)
{
    static const double node[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
    double at[2 * ATOMS], slope[2 * ATOMS] = {0.0}, sum[2 * ATOMS] = {0.0};
    for (int stage = 0; stage < 4; stage++) {
        for (int i = 0; i < 2 * ATOMS; i++) at[i] = y[i] + h * node[stage] * slope[i];
        evaluate_thermostat(at, slope);
        for (int i = 0; i < 2 * ATOMS; i++) sum[i] += weight[stage] * slope[i];
    }
    for (int i = 0; i < 2 * ATOMS; i++) y[i] += h / 6.0 * sum[i];
}

static void test_thermostat(void)
{
    const double T = 1.0, fine = 1e-3;
    double y[2 * ATOMS] = {0.0}, square = 0.0;
    for (int i = 0; i < ATOMS; i++)
        y[ATOMS + i] = sqrt(2 * initial_temperature) * sin(2 * acos(-1.0) * (i + 1) / ATOMS + 1);
    for (int k = 0; k < 1000; k++) step_thermostat(y, fine);
    for (int i = 0; i < ATOMS; i++) square += y[ATOMS + i] * y[ATOMS + i];
    CU_ASSERT_DOUBLE_EQUAL(square / ATOMS, initial_temperature + heating * T, 1e-12);
    compare_ends("thermostat.yaml", 0.02, T, y);
}

/* The speed of the rear axle, u = 1, gives the car and its trailers these velocities along their
 * headings and rates of turning.  Twice the kinetic energy is M u^2. */
typedef struct car_rates {
    double along[3], turn[3], M;
} car_rates;

static const double car_mass[3] = {3, 2, 1}, car_inertia[3] = {0.4, 0.2, 0.1};
static const double wheelbase = 1.2, hitch[3] = {0, 0.9, 1.1}, steering_rate = -0.25;

/* heading[3]: of the car and of the trailers. */
static car_rates find_rates(const double *heading, double steering)
{
    car_rates r = {.along = {1.0}, .turn = {tan(steering) / wheelbase}};
    for (int i = 1; i < 3; i++) {
        r.along[i] = r.along[i - 1] * cos(heading[i - 1] - heading[i]);
        r.turn[i] = r.along[i - 1] * sin(heading[i - 1] - heading[i]) / hitch[i];
    }
    for (int i = 0; i < 3; i++)
        r.M += car_mass[i] * r.along[i] * r.along[i] + car_inertia[i] * r.turn[i] * r.turn[i];
    return r;
}

/* y: x, y, headings; the energy M u^2/2 is constant. */
static void evaluate_car(const double *y, double steering, double energy, double *dy)
{
    const car_rates r = find_rates(y + 2, steering);
    const double u = sqrt(2.0 * energy / r.M);
    dy[0] = u * cos(y[2]);
    dy[1] = u * sin(y[2]);
    for (int i = 0; i < 3; i++) dy[2 + i] = u * r.turn[i];
}

/* The start has x' = 1 alone, so that v - v0 is orthogonal, in the mass metric, to the motion of
 * speed u if  u M = sum m_i along_i cos heading_i.  No force acts on the steering angle. */
static void test_car(void)
{
    enum { STEPS = 1000 };
    static const double node[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
    const double T = 2.0, h = T / STEPS;
    double y[5] = {0.0, 0.0, 0.3, -0.2, 0.5}, u = 0.0;
    const car_rates r = find_rates(y + 2, 0.4);
    for (int i = 0; i < 3; i++) u += car_mass[i] * r.along[i] * cos(y[2 + i]) / r.M;
    for (int k = 0; k < STEPS; k++) {
        double at[5], slope[5] = {0.0}, sum[5] = {0.0};
        for (int stage = 0; stage < 4; stage++) {
            const double steering = 0.4 + steering_rate * h * (k + node[stage]);
            for (int i = 0; i < 5; i++) at[i] = y[i] + h * node[stage] * slope[i];
            evaluate_car(at, steering, 0.5 * r.M * u * u, slope);
            for (int i = 0; i < 5; i++) sum[i] += weight[stage] * slope[i];
        }
        for (int i = 0; i < 5; i++) y[i] += h / 6.0 * sum[i];
    }
    const double end[6] = {y[0], y[1], y[2], 0.4 + steering_rate * T, y[3], y[4]};
    compare_ends("two-trailer-car.yaml", 0.01, T, end);
}

/* The same start with x' = 1 kept and the other velocities solved from the constraints. */
static void test_solved_car(void)
{
    static const char end[] = "f': -0.25}";
    static const double heading[3] = {0.3, -0.2, 0.5};
    const double u = 1.0 / cos(heading[0]);
    const car_rates r = find_rates(heading, 0.4);
    const double expected[6] = {1.0,           u * sin(heading[0]), u * r.turn[0],
                                steering_rate, u * r.turn[1],       u * r.turn[2]};
    char text[4096];
    dal_model *given = NULL, *model = NULL;
    const dal_system *system = open_system(&given, "two-trailer-car.yaml");
    size_t length;
    const char *source = dal_model_source(given, &length);
    const char *place = strstr(source, end);
    CU_ASSERT_FATAL(place != NULL && length + 64 < sizeof text);
    snprintf(text, sizeof text, "%.*sf': -0.25, solve: [y', a', b1', b2']}%s",
             (int)(place - source), source, place + strlen(end));
    CU_ASSERT_FATAL(dal_model_read(&model, NULL, text, strlen(text), NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_model_system(model, &system, NULL) == DAL_STATUS_OK);
    dal_run *run = create_run(system, 0, 0.01);
    CU_ASSERT_FATAL(run != NULL);
    for (int i = 0; i < 6; i++)
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[6 + i], expected[i], 1e-14);
    dal_run_free(run);
    dal_model_free(model);
    dal_model_free(given);
}

void suite_example_systems(void)
{
    CU_pSuite suite = CU_add_suite("System files of the examples", NULL, NULL);
    CU_add_test(suite, "every method takes steps", test_every_file);
    CU_add_test(suite, "a ball in a rotating bowl", test_rotating_bowl);
    CU_add_test(suite, "a chain with a thermostat", test_thermostat);
    CU_add_test(suite, "a car with two trailers", test_car);
    CU_add_test(suite, "a car with two trailers, solved", test_solved_car);
}
