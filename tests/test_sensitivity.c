/* test_sensitivity.c - derivatives of runs by starts and parameters, on (q, v) and on the lift,
 * against closed forms and against differences of runs in quad precision. */
#include "allocation.h"
#include "fixtures.h"
#include "kernel/quad.h"
#include "null.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- differences of runs in quad precision ---- */

/* Order 8, as in lib/analysis/differences.h: increments of 2^-10 relative leave (2^-10)^8. */
enum { POINTS = 4, MAX_DIMENSION = 64 };
static const int increment_exponent = -10;
static const double weight_over[POINTS] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};

/* One case: a method, a system with an effort, a start off p = pi = 0 or not, and a name. */
typedef struct sample {
    const char *method, *system, *name;
    dal_effort effort;
    double momenta; /* size of p and pi at the start; 0: the run is on (q, v) */
} sample;

/* The system and start of a sample, displaced by size in the name. */
typedef struct displaced {
    const sample *of;
    dal_model *model;
    dal_run_spec spec;
    int component; /* of the state; -1: a parameter */
    double value;  /* of the name without displacement */
    double *state; /* [MAX_DIMENSION] the start */
    long long steps;
} displaced;

static void add_momenta(const displaced *d, double *z)
{
    const int n = d->spec.system->n;
    for (int i = 0; i < 2 * n && d->of->momenta > 0.0; i++)
        z[2 * n + 1 + i] = d->of->momenta * cos(1.0 + 1.7 * i);
}

/* The state after some steps, in quad precision. */
static void run_displaced(const displaced *d, double size, dal_quad *out)
{
    dal_run *run = NULL;
    dal_error record = {0};
    dal_run_spec spec = d->spec;
    const dal_setting set = {d->of->name, d->value + size};
    double z[MAX_DIMENSION];
    size_t count;
    spec.options.precision = DAL_QUAD;
    if (d->component < 0) spec.parameters = &set, spec.parameter_count = 1;
    CU_ASSERT_EQUAL_FATAL(dal_run_create(&run, &spec, &record), DAL_STATUS_OK);
    const int dimension = dal_run_dimension(run);
    memcpy(z, dal_run_state(run), (size_t)dimension * sizeof *z);
    add_momenta(d, z);
    if (d->component >= 0) z[d->component] += size;
    CU_ASSERT_EQUAL_FATAL(dal_run_set_state(run, 0.0, z, &record), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, d->steps, &record), DAL_STATUS_OK);
    const dal_quad *stored = (const dal_quad *)(const void *)dal_run_save(run, &count);
    memcpy(out, stored, (size_t)dimension * sizeof *out);
    dal_run_free(run);
}

static void differentiate(const displaced *d, int dimension, double *out)
{
    dal_quad sum[MAX_DIMENSION] = {0}, z[2][MAX_DIMENSION];
    const int exponent = d->value != 0.0 ? ilogb(d->value) : 0;
    const double increment = ldexp(1.0, exponent + increment_exponent);
    for (int k = 1; k <= POINTS; k++) {
        run_displaced(d, k * increment, z[0]);
        run_displaced(d, -k * increment, z[1]);
        for (int i = 0; i < dimension; i++)
            sum[i] += (dal_quad)weight_over[k - 1] * (z[0][i] - z[1][i]);
    }
    for (int i = 0; i < dimension; i++) out[i] = (double)(sum[i] / increment);
}

/* Makes the model, the spec and the start of a sample. */
static void open_sample(displaced *d, const sample *of, dal_space space, double step)
{
    const dal_system *system;
    dal_error record = {0};
    *d = (displaced){.of = of};
    d->model = fixture_model(of->system);
    CU_ASSERT_EQUAL_FATAL(dal_model_set_effort(d->model, of->effort, &record), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(d->model, &system, &record), DAL_STATUS_OK);
    d->spec = fixture_spec(system, of->method, space, step);
}

/* Moves a column beside a run of a sample and compares it with differences; the largest difference
 * relative to the column. */
static double compare(const sample *of, double step, long long steps)
{
    displaced d;
    dal_run *run;
    dal_error record = {0};
    dal_sensitivity *s = NULL;
    char name[2 * MAX_DIMENSION][128];
    dal_setting start[MAX_DIMENSION];
    double z[MAX_DIMENSION], reference[MAX_DIMENSION], max = 0.0, distance = 0.0;
    open_sample(&d, of, of->momenta > 0.0 ? DAL_LIFTED : DAL_PHYSICAL, step);
    d.steps = steps;
    run = fixture_run(&d.spec);
    const int dimension = dal_run_dimension(run), n = d.spec.system->n;
    CU_ASSERT_FATAL(dimension <= MAX_DIMENSION);
    memcpy(z, dal_run_state(run), (size_t)dimension * sizeof *z);
    add_momenta(&d, z);
    d.component = dal_run_component_index(run, of->name);
    for (int k = 0; k < d.spec.system->parameters && d.component < 0; k++)
        if (strcmp(d.spec.system->parameter[k], of->name) == 0) d.value = d.spec.system->value[k];
    if (d.component >= 0) d.value = z[d.component];
    for (int i = 2 * n + 1; i < dimension; i++) {
        dal_run_component_name(run, i, name[i], sizeof name[i]);
        start[d.spec.start_count++] = (dal_setting){name[i], z[i]};
    }
    d.spec.start = start;
    CU_ASSERT_EQUAL_FATAL(dal_sensitivity_create(&s, d.model, &d.spec, &of->name, 1, &record),
                          DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_sensitivity_is_lifted(s), of->momenta > 0.0);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(s, (double)steps * step, &record), DAL_STATUS_OK);
    const double *column = dal_sensitivity_column(s, 0);
    d.spec.start_count = 0;
    differentiate(&d, dimension, reference);
    for (int i = 0; i < dimension; i++) {
        max = fmax(max, fabs(reference[i]));
        distance = fmax(distance, fabs(column[i] - reference[i]));
    }
    dal_sensitivity_free(s);
    dal_run_free(run);
    dal_model_free(d.model);
    return distance / max;
}

/* The steps of the comparison, and what rounding and the differences may leave. */
enum { STEPS = 12 };
static const double step_size = 0.03125, allowed = 1e-10;

/* A sleigh whose mass grows with the speed, with controls that depend on (q, v), and a gauge of t
 * alone. */
static const char controlled[] =
    "coordinates: [x, y, phi]\nparameters: {a: 0.4, I: 3}\n"
    "lagrangian: (x'^2 + y'^2)/2*(1 + a*(x'^2 + y'^2)) + I/2*phi'^2 - a*x^2*y\n"
    "constraints: [x'*sin(phi) - y'*cos(phi)]\n"
    "controls: [{x: cos(phi), y: sin(phi)}, {phi: 1 + a*phi'^2, x: y}]\n"
    "gauge: {e: 2, mu_e: 0.3*cos(t)}\n"
    "start: {x: a, y: 0.3, phi: 0.2, x': 0.5*cos(0.2), y': 0.5*sin(0.2), phi': 0.3}\n";

/* Systems and what is differentiated. */
static const sample subjects[] = {
    {NULL, "chaplygin-sleigh-offset", "phi'", DAL_EFFORT_CONSTRAINT, 0.3},
    {NULL, "chaplygin-sleigh-offset", "a", DAL_EFFORT_CONSTRAINT, 0.3},
    {NULL, "roller-racer", "I2", DAL_EFFORT_MASS, 0.2},
    {NULL, controlled, "a", DAL_EFFORT_CONTROLS, 0.4},
    {NULL, "snakeboard", "p_phi", DAL_EFFORT_CONSTRAINT, 0.4},
    {NULL, "contact-oscillator", "eps", DAL_EFFORT_IDENTITY, 0.0},
    {NULL, "rocket", "burn", DAL_EFFORT_IDENTITY, 0.0},
    {NULL, "falling-disk", "r", DAL_EFFORT_IDENTITY, 0.0},
    {NULL, "relativistic-em", "u0", DAL_EFFORT_IDENTITY, 0.1},
    {NULL, "servo-pendulum", "l", DAL_EFFORT_IDENTITY, 0.0},
    {NULL, "chaplygin-sleigh-vakonomic", "g1", DAL_EFFORT_IDENTITY, 0.0},
    {NULL, "chaplygin-sleigh-vakonomic", "m", DAL_EFFORT_IDENTITY, 0.0}};
static const char *const methods[] = {
    "rk4", "gauss4", "gauss8", "implicit-midpoint+yoshida4", "stormer-verlet", "taylor"};

static void test_differences(void)
{
    const size_t count = sizeof subjects / sizeof *subjects;
    const size_t all = count * (sizeof methods / sizeof *methods);
    for (size_t i = 0; i < all; i += (size_t)case_stride(11)) {
        sample of = subjects[i % count];
        of.method = methods[i / count];
        const double left = compare(&of, step_size, STEPS);
        if (!(left <= allowed))
            printf("%s of %.24s by %s: %g\n", of.method, of.system, of.name, left);
        CU_ASSERT(left <= allowed);
    }
}

/* ---- closed forms ---- */

/* x'' = -w^2 x by rk4, from x = a, x' = 0: (x, x'/w) turns by R(i h w) in every step, and R(z) is
 * the stability function 1 + z + z^2/2 + z^3/6 + z^4/24. */
static const char oscillator[] = "coordinates: [x]\nparameters: {w: 1.3, a: 0.8, b: 2}\n"
                                 "accelerations: {x: -w^2*x}\nstart: {x: a*b}\n";
static const double frequency = 1.3, a_of_start = 0.8, b_of_start = 2.0;

static double complex stability(double y)
{
    const double complex z = y * I;
    return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)));
}
/* Its derivative by y. */
static double complex stability_rate(double y)
{
    const double complex z = y * I;
    return I * (1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0)));
}

/* By w: x = a b Re R^N R_last, whose second factor is a step of another size, or 1. */
static double by_frequency(int steps, double h, double last)
{
    const double complex R = stability(h * frequency), L = stability(last * frequency);
    const double complex rate = steps * cpow(R, steps - 1) * h * stability_rate(h * frequency) * L +
                                cpow(R, steps) * last * stability_rate(last * frequency);
    return a_of_start * b_of_start * creal(rate);
}

static dal_sensitivity *columns_of(dal_model *model, const dal_run_spec *spec,
                                   const char *const *names, int count)
{
    dal_sensitivity *s = NULL;
    dal_error record = {0};
    CU_ASSERT_EQUAL_FATAL(dal_sensitivity_create(&s, model, spec, names, count, &record),
                          DAL_STATUS_OK);
    return s;
}

static void test_closed_form(void)
{
    enum { N = 20 };
    const double h = 0.125;
    static const char *const names[] = {"w", "x", "b", "x'"};
    sample of = {"rk4", oscillator, NULL, DAL_EFFORT_IDENTITY, 0.0};
    displaced d;
    open_sample(&d, &of, DAL_LIFTED, h);
    dal_sensitivity *s = columns_of(d.model, &d.spec, names, 4);
    const double *w = dal_sensitivity_column(s, 0), *x = dal_sensitivity_column(s, 1);
    const double *b = dal_sensitivity_column(s, 2), *v = dal_sensitivity_column(s, 3);
    CU_ASSERT_EQUAL(dal_sensitivity_count(s), 4);
    CU_ASSERT_EQUAL(dal_sensitivity_dimension(s), 6);
    CU_ASSERT_FALSE(dal_sensitivity_is_lifted(s));
    CU_ASSERT(w[0] == 0.0 && x[0] == 1.0 && b[0] == a_of_start && v[1] == 1.0);
    /* a row between two steps, which changes nothing of those that follow */
    CU_ASSERT_EQUAL(dal_sensitivity_advance(s, 3.5 * h, NULL), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(w[0], by_frequency(3, h, h / 2.0), 1e-14);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(s, N * h, NULL), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(w[0], by_frequency(N, h, 0.0), 1e-13);
    const double complex R = cpow(stability(h * frequency), N);
    CU_ASSERT_DOUBLE_EQUAL(x[0], creal(R), 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(x[1], -frequency * cimag(R), 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(b[0], a_of_start * creal(R), 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(v[1], creal(R), 1e-14);
    for (int i = 2; i < 6; i++) CU_ASSERT(w[i] == 0.0 && v[i] == 0.0);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(s, 0.0, NULL), DAL_STATUS_ARGUMENT);
    dal_sensitivity_free(s);
    /* a start that is set does not depend on b, nor on a */
    const dal_setting start = {"x", 0.5};
    d.spec.start = &start;
    d.spec.start_count = 1;
    s = columns_of(d.model, &d.spec, names + 2, 1);
    CU_ASSERT_EQUAL(dal_sensitivity_column(s, 0)[0], 0.0);
    dal_sensitivity_free(s);
    dal_model_free(d.model);
}

/* The lift of q'' = 0 with K = 1: pi = pi0 - p t, v = v0 + (pi0 t - p t^2/2)/e, and q its integral;
 * gauss4 is exact. */
static void test_lift(void)
{
    static const char *const names[] = {"p_x", "pi_x"};
    const dal_setting start[] = {{"p_x", 0.3}, {"pi_x", -0.7}, {"e", 2.0}};
    sample of = {"gauss4", "coordinates: [x]\naccelerations: {x: 0}\nstart: {x: 0}\n", NULL,
                 DAL_EFFORT_IDENTITY, 0.0};
    displaced d;
    open_sample(&d, &of, DAL_LIFTED, 0.25);
    d.spec.start = start;
    d.spec.start_count = 3;
    dal_sensitivity *s = columns_of(d.model, &d.spec, names, 2);
    const double t = 1.5, e = 2.0, p = 0.3, pi = -0.7;
    CU_ASSERT_EQUAL(dal_sensitivity_advance(s, t, NULL), DAL_STATUS_OK);
    const double *by_p = dal_sensitivity_column(s, 0), *by_pi = dal_sensitivity_column(s, 1);
    /* x, x', e, p_x, pi_x, pi_e; pi_e is the integral of (pi - p t)^2/(2 e^2) */
    const double expected[2][6] = {
        {-t * t * t / 6.0 / e, -t * t / 2.0 / e, 0.0, 1.0, -t,
         (-pi * t * t / 2.0 + p * t * t * t / 3.0) / (e * e)},
        {t * t / 2.0 / e, t / e, 0.0, 0.0, 1.0, (pi * t - p * t * t / 2.0) / (e * e)}};
    for (int i = 0; i < 6; i++) {
        CU_ASSERT_DOUBLE_EQUAL(by_p[i], expected[0][i], 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(by_pi[i], expected[1][i], 1e-14);
    }
    dal_sensitivity_free(s);
    dal_model_free(d.model);
}

/* ---- checkpoints ---- */

static void test_restore(void)
{
    static const char *const names[] = {"a", "pi_x", "phi'"};
    sample of = {"gauss8", controlled, NULL, DAL_EFFORT_CONTROLS, 0.0};
    displaced d;
    size_t count;
    open_sample(&d, &of, DAL_LIFTED, 0.0625);
    dal_sensitivity *one = columns_of(d.model, &d.spec, names, 3);
    dal_sensitivity *two = columns_of(d.model, &d.spec, names, 3);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(one, 0.5, NULL), DAL_STATUS_OK);
    const double *saved = dal_sensitivity_save(one, &count);
    CU_ASSERT_EQUAL(dal_sensitivity_restore(two, saved, count - 1, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(dal_sensitivity_restore(two, saved, count, NULL), DAL_STATUS_OK);
    const size_t size = 3 * (size_t)dal_sensitivity_dimension(one) * sizeof(double);
    const double *x = dal_sensitivity_column(one, 0), *y = dal_sensitivity_column(two, 0);
    CU_ASSERT_EQUAL(memcmp(x, y, size), 0);
    for (size_t k = 0; k < 3; k++) { /* no column may be damaged */
        double *const damaged = (double *)(size_t)saved + k * (count / 3), whole = *damaged;
        *damaged = NAN;
        CU_ASSERT_EQUAL(dal_sensitivity_restore(two, saved, count, NULL), DAL_STATUS_NOT_FINITE);
        *damaged = whole;
    }
    CU_ASSERT_EQUAL_FATAL(dal_sensitivity_restore(two, saved, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(one, 1.0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(two, 0.78, NULL), DAL_STATUS_OK);
    CU_ASSERT_NOT_EQUAL(memcmp(x, y, size), 0);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(two, 1.0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(x, y, size), 0);
    dal_sensitivity_free(one);
    dal_sensitivity_free(two);
    dal_model_free(d.model);
}

/* F ends at t = 1, in the part of a step that leads to 1.1. */
static void test_part_of_step(void)
{
    static const char *const names[] = {"x"};
    sample of = {"rk4", "coordinates: [x]\naccelerations: {x: x*sqrt(1 - t)}\nstart: {x: 1}\n",
                 NULL, DAL_EFFORT_IDENTITY, 0.0};
    displaced d;
    open_sample(&d, &of, DAL_PHYSICAL, 0.4);
    dal_sensitivity *s = columns_of(d.model, &d.spec, names, 1);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(s, 0.9, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(s, 1.1, NULL), DAL_STATUS_NOT_FINITE);
    dal_sensitivity_free(s);
    dal_model_free(d.model);
}

/* ---- what is refused ---- */

static void refused(const char *text, const char *method, const char *name, dal_status status,
                    const char *fragment)
{
    dal_error record = {0};
    dal_sensitivity *s = NULL;
    sample of = {method, text, NULL, DAL_EFFORT_IDENTITY, 0.0};
    displaced d;
    open_sample(&d, &of, DAL_LIFTED, 0.125);
    CU_ASSERT_EQUAL(dal_sensitivity_create(&s, d.model, &d.spec, &name, 1, &record), status);
    CU_ASSERT_PTR_NOT_NULL(strstr(record.message, fragment));
    if (!strstr(record.message, fragment)) printf("%s\n", record.message);
    dal_model_free(d.model);
}

static void test_refuses(void)
{
#define BEGIN "coordinates: [x]\nparameters: {k: 1}\naccelerations: {x: -k*x}\n"
    static const char free_start[] = BEGIN "start: {x: 1}\n";
    refused(free_start, "rk4", "y", DAL_STATUS_NAME, "k");
    refused(free_start, "rk4", "e", DAL_STATUS_UNSUPPORTED, "constant e");
    refused(BEGIN "gauge: {e: k}\nstart: {x: 1}\n", "rk4", "k", DAL_STATUS_UNSUPPORTED, "gauge");
    refused(BEGIN "gauge: {mu_e: k*sin(t)}\nstart: {x: 1}\n", "rk4", "k", DAL_STATUS_UNSUPPORTED,
            "gauge");
    refused(BEGIN "gauge: {mu_e: x}\nstart: {x: 1}\n", "rk4", "pi_x", DAL_STATUS_UNSUPPORTED,
            "t alone");
    refused(BEGIN "events: [{when: x, stop: true}]\nstart: {x: 1}\n", "rk4", "x",
            DAL_STATUS_UNSUPPORTED, "events");
    refused("chaplygin-sleigh", "rk4+project", "phi", DAL_STATUS_UNSUPPORTED, "no exact tangent");
    refused("unequal-springs", "gni", "y", DAL_STATUS_UNSUPPORTED, "pass multipliers");
    refused("bead-on-hoop", "dla", "r", DAL_STATUS_UNSUPPORTED, "take rattle");
#undef BEGIN
}

/* The system is another model's; F is continued off D = 0. */
static void test_refused_specs(void)
{
    const char *const names[] = {"phi"};
    const sample of = {"rk4", "chaplygin-sleigh", NULL, DAL_EFFORT_IDENTITY, 0.0};
    for (int i = 0; i < 2; i++) {
        dal_error record = {0};
        dal_sensitivity *s = NULL;
        displaced d;
        open_sample(&d, &of, DAL_PHYSICAL, 0.125);
        if (i == 0)
            d.spec.system = fixture_system("chaplygin-sleigh");
        else
            d.spec.options.extend_energy = true;
        CU_ASSERT_EQUAL(dal_sensitivity_create(&s, d.model, &d.spec, names, 1, &record),
                        i == 0 ? DAL_STATUS_ARGUMENT : DAL_STATUS_UNSUPPORTED);
        CU_ASSERT_STRING_EQUAL(record.message,
                               i == 0 ? "the system of the spec is not the model's"
                                      : "no sensitivities of rk4: F continued off D = 0 has no "
                                        "tangent system");
        CU_ASSERT_PTR_NULL(s);
        dal_model_free(d.model);
    }
}

/* x'' = x^3 from x = 100 leaves all numbers within t = 1; what is not finite ends the columns. */
static void test_fails(void)
{
    const char *const names[] = {"x"};
    const sample of = {"rk4", "coordinates: [x]\naccelerations: {x: x^3}\nstart: {x: 100}\n", NULL,
                       DAL_EFFORT_IDENTITY, 0.0};
    dal_error record = {0};
    displaced d;
    open_sample(&d, &of, DAL_PHYSICAL, 0.125);
    dal_sensitivity *s = columns_of(d.model, &d.spec, names, 1);
    CU_ASSERT_EQUAL(dal_sensitivity_advance(s, 4.0, &record), DAL_STATUS_NOT_FINITE);
    CU_ASSERT_EQUAL(record.status, DAL_STATUS_NOT_FINITE);
    dal_sensitivity_free(s);
    dal_model_free(d.model);
}

static void test_out_of_memory(void)
{
    static const char *const names[] = {"w", "pi_x"};
    sample of = {"rk4", oscillator, NULL, DAL_EFFORT_IDENTITY, 0.0};
    displaced d;
    open_sample(&d, &of, DAL_LIFTED, 0.125);
    allocation_trial trial = {0};
    dal_sensitivity_free(columns_of(d.model, &d.spec, names, 2)); /* the model keeps its systems */
    while (allocation_next(&trial)) {
        dal_sensitivity *s = NULL;
        allocation_start(&trial);
        allocation_end(&trial, dal_sensitivity_create(&s, d.model, &d.spec, names, 2, NULL));
        dal_sensitivity_free(s);
    }
    CU_ASSERT(trial.failures >= 6);
    dal_model_free(d.model);
}

/* ---- arguments ---- */

FUNCTIONS_dalembert_sensitivity(DECLARE_NULL_TEST)

    static dal_model *model;
static dal_run_spec spec;

static int open_model(void) { return open_spec(&model, &spec) != DAL_STATUS_OK; }
static int close_model(void)
{
    dal_model_free(model);
    return 0;
}

static void null_dal_sensitivity_create(void)
{
    dal_sensitivity *s = NULL;
    const char *const names[] = {"phi", NULL};
    REFUSED(dal_sensitivity_create(NULL, model, &spec, names, 1, error));
    REFUSED(dal_sensitivity_create(&s, NULL, &spec, names, 1, error));
    REFUSED(dal_sensitivity_create(&s, model, &spec, NULL, 1, error));
    REFUSED(dal_sensitivity_create(&s, model, &spec, names, -1, error));
    REFUSED(dal_sensitivity_create(&s, model, &spec, names + 1, 1, error));
    for (int i = 0; i < BAD_SPECS; i++)
        REFUSED(dal_sensitivity_create(&s, model, spoil_spec(&spec, i), names, 1, error));
    CU_ASSERT_PTR_NULL(s);
}

static void null_dal_sensitivity_restore(void)
{
    static const char *const names[] = {"phi'"};
    const double number = 0.0;
    dal_sensitivity *s = columns_of(model, &spec, names, 1);
    REFUSED(dal_sensitivity_restore(NULL, &number, 1, error));
    REFUSED(dal_sensitivity_restore(s, NULL, 1, error));
    CU_ASSERT_PTR_NULL(dal_sensitivity_save(s, NULL));
    CU_ASSERT_PTR_NULL(dal_sensitivity_column(s, -1));
    CU_ASSERT_PTR_NULL(dal_sensitivity_column(s, 1));
    REFUSED(dal_sensitivity_advance(s, NAN, error));
    dal_sensitivity_free(s);
}

static void null_dal_sensitivity_save(void)
{
    size_t count = 1;
    CU_ASSERT_PTR_NULL(dal_sensitivity_save(NULL, &count));
}

static void null_dal_sensitivity_advance(void)
{
    REFUSED(dal_sensitivity_advance(NULL, 1.0, error));
}

static void null_dal_sensitivity_free(void) { dal_sensitivity_free(NULL); }
static void null_dal_sensitivity_count(void) { CU_ASSERT_EQUAL(dal_sensitivity_count(NULL), 0); }
static void null_dal_sensitivity_dimension(void)
{
    CU_ASSERT_EQUAL(dal_sensitivity_dimension(NULL), 0);
}
static void null_dal_sensitivity_is_lifted(void)
{
    CU_ASSERT_FALSE(dal_sensitivity_is_lifted(NULL));
}
static void null_dal_sensitivity_column(void)
{
    CU_ASSERT_PTR_NULL(dal_sensitivity_column(NULL, 0));
}

void suite_sensitivity(void)
{
    CU_pSuite suite = CU_add_suite("derivatives of runs", open_model, close_model);
    CU_add_test(suite, "against differences in quad precision", test_differences);
    CU_add_test(suite, "of an oscillator, closed form", test_closed_form);
    CU_add_test(suite, "of a lift, closed form", test_lift);
    CU_add_test(suite, "saved and restored", test_restore);
    CU_add_test(suite, "a part of a step that fails", test_part_of_step);
    CU_add_test(suite, "what is refused", test_refuses);
    CU_add_test(suite, "specs that are refused", test_refused_specs);
    CU_add_test(suite, "columns that fail", test_fails);
    CU_add_test(suite, "out of memory", test_out_of_memory);
    FUNCTIONS_dalembert_sensitivity(ADD_NULL_TEST)
}
