/* test_observables.c - observables of many steps at a time: the bits of dal_run_observe after each
 * step, whether steps and observables are compiled or not, and however a run is divided. */
#include "compiler.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SAMPLES = 1200, MAX_OBSERVABLES = 16, MAX_STATE = 32, STEPS = 701 };

/* ---- systems ---- */

static const char vakonomic[] = "coordinates: [x, y]\nmechanics: vakonomic\n"
                                "lagrangian: (x'^2 + y'^2)/2 - x^2*y/5\n"
                                "constraints: [x' - cos(x)*y']\n"
                                "start: {x: 0.3, y': 0.4, x': 0.4*cos(0.3)}\n";

/* Falls into the ground at x = 0, where its force ends to be a number. */
static const char falling[] = "coordinates: [x, y]\n"
                              "lagrangian: (x'^2 + y'^2)/2 - y^2/2\n"
                              "forces: {x: -sqrt(x)}\nstart: {x: 1, y: 1}\n";

typedef struct subject {
    const char *system, *method;
    dal_space space;
    int starts;
} subject;

/* p and pi away from 0, so that H and the norms say something. */
static const dal_setting away[] = {{"p_x", 0.1}, {"pi_y", -0.2}, {"pi_e", 0.3}};

static const subject subjects[] = {{"chaplygin-sleigh", "rk4", DAL_PHYSICAL, 0},
                                   {"chaplygin-sleigh", "gauss4", DAL_LIFTED, 0},
                                   {fixture_full, "rk4", DAL_LIFTED, 3},
                                   {vakonomic, "rk4", DAL_PHYSICAL, 0}};

static dal_run *run_of(const subject *s, const dal_system *system)
{
    dal_run_spec spec = fixture_spec(system, s->method, s->space, 0.01);
    spec.start = away;
    spec.start_count = s->starts;
    return fixture_run(&spec);
}

/* ---- samples ---- */

typedef struct series {
    int samples, observables, dimension, max_at_once, refuse;
    double t[MAX_SAMPLES], x[MAX_OBSERVABLES][MAX_SAMPLES], state[MAX_STATE][MAX_SAMPLES];
    dal_statistics statistics[MAX_OBSERVABLES];
} series;

static void begin(series *s, const dal_run *run)
{
    memset(s, 0, sizeof *s);
    s->refuse = MAX_SAMPLES;
    s->observables = dal_run_observables(run);
    s->dimension = dal_run_dimension(run);
    CU_ASSERT_FATAL(s->dimension <= MAX_STATE);
    dal_statistics_start(s->statistics, s->observables);
}

static dal_status take_one(void *user, dal_run *run)
{
    series *s = user;
    double x[MAX_OBSERVABLES];
    const dal_status status = dal_run_observe(run, x);
    s->t[s->samples] = dal_run_time(run);
    for (int i = 0; i < s->observables; i++) s->x[i][s->samples] = x[i];
    for (int i = 0; i < s->dimension; i++) s->state[i][s->samples] = dal_run_state(run)[i];
    dal_statistics_add(s->statistics, s->observables, dal_run_time(run), x);
    s->samples++;
    return status;
}

static dal_status take_states(void *user, dal_run *run, int samples, const double *t,
                              const double *x, size_t stride)
{
    series *s = user;
    (void)run, (void)t;
    CU_ASSERT_FATAL(s->samples + samples <= MAX_SAMPLES && samples > 0);
    for (int i = 0; i < s->dimension; i++)
        memcpy(s->state[i] + s->samples, x + (size_t)i * stride, (size_t)samples * sizeof *x);
    return DAL_STATUS_OK;
}

static dal_status take_many(void *user, dal_run *run, int samples, const double *t, const double *x,
                            size_t stride)
{
    series *s = user;
    CU_ASSERT_FATAL(s->samples + samples <= MAX_SAMPLES && samples > 0);
    CU_ASSERT(t[samples - 1] <= dal_run_time(run));
    memcpy(s->t + s->samples, t, (size_t)samples * sizeof *t);
    for (int i = 0; i < s->observables; i++)
        memcpy(s->x[i] + s->samples, x + (size_t)i * stride, (size_t)samples * sizeof *x);
    dal_statistics_add_many(s->statistics, s->observables, samples, t, x, stride);
    s->samples += samples;
    if (samples > s->max_at_once) s->max_at_once = samples;
    return s->samples > s->refuse ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

/* A row on every step or between two of them, or only at the end. */
static dal_status sample(dal_run *run, series *s, bool many, long long every, long long rows,
                         long long first_row, long long last_row)
{
    const dal_observer observer = {.user = s,
                                   .step = many ? NULL : take_one,
                                   .values = many ? take_many : NULL,
                                   .states = many ? take_states : NULL,
                                   .every = every};
    const double T = 0.01 * STEPS * (double)last_row / (double)rows;
    return dal_run_sample(run, T, last_row, first_row, &observer, NULL);
}

static void compile(dal_run *run, bool steps, bool observables)
{
    if (steps && compiler_works)
        CU_ASSERT_EQUAL(dal_run_native(run, &compiler_options, NULL), DAL_STATUS_OK);
    if (observables && compiler_works)
        CU_ASSERT_EQUAL(dal_run_native_observables(run, &compiler_options, NULL), DAL_STATUS_OK);
}

/* ---- the same bits ---- */

static void same_series(const subject *of, const dal_system *system, int way)
{
    static series one, many;
    const long long every = way & 4 ? 3 : 1, rows = way & 8 ? 40 : 1;
    dal_run *const plain = run_of(of, system), *const run = run_of(of, system);
    begin(&one, plain);
    begin(&many, run);
    compile(run, way & 1, way & 2);
    CU_ASSERT_EQUAL(sample(plain, &one, false, every, rows, 0, rows), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(sample(run, &many, true, every, rows, 0, rows), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(one.samples, 1 + STEPS / every);
    CU_ASSERT(one.observables > 0 && one.x[0][0] == one.x[0][0]);
    CU_ASSERT_EQUAL(memcmp(one.t, many.t, sizeof one.t), 0);
    CU_ASSERT_EQUAL(memcmp(one.x, many.x, sizeof one.x), 0);
    CU_ASSERT_EQUAL(memcmp(one.state, many.state, sizeof one.state), 0);
    CU_ASSERT_EQUAL(memcmp(one.statistics, many.statistics, sizeof one.statistics), 0);
    if (compiler_works && way == 3) CU_ASSERT(many.max_at_once > 100);
    dal_run_free(plain);
    dal_run_free(run);
}

static void test_bits(void)
{
    for (size_t i = 0; i < sizeof subjects / sizeof subjects[0]; i++) {
        for (int way = 0; way < 16; way += case_stride(3))
            same_series(&subjects[i], fixture_system(subjects[i].system), way);
    }
}

/* ---- scales ---- */

typedef struct scale_series {
    int count;
    double x[MAX_OBSERVABLES * 64];
} scale_series;

static dal_status pass_over(void *user, dal_run *run, int samples, const double *t, const double *x,
                            size_t stride)
{
    (void)user, (void)run, (void)samples, (void)t, (void)x, (void)stride;
    return DAL_STATUS_OK;
}

static dal_status take_scales(void *user, dal_run *run, const double *scales)
{
    scale_series *s = user;
    const int count = dal_run_observables(run);
    CU_ASSERT_FATAL(s->count + count <= MAX_OBSERVABLES * 64);
    for (int i = 0; i < count; i++) s->x[s->count++] = scales[i];
    return DAL_STATUS_OK;
}

/* Scales of states that were stored are the scales of the run there. */
static void test_scales(void)
{
    for (size_t i = 0; i < sizeof subjects / sizeof subjects[0]; i++) {
        static scale_series s[2];
        for (int compiled = 0; compiled <= 1; compiled++) {
            const dal_observer observer = {
                .user = &s[compiled], .values = pass_over, .scales = take_scales, .every = 1};
            dal_run *run = run_of(&subjects[i], fixture_system(subjects[i].system));
            s[compiled].count = 0;
            compile(run, compiled, compiled);
            CU_ASSERT_EQUAL(dal_run_sample(run, 0.01 * STEPS, 1, 0, &observer, NULL),
                            DAL_STATUS_OK);
            dal_run_free(run);
        }
        CU_ASSERT(s[0].count > 0);
        CU_ASSERT_EQUAL_FATAL(s[0].count, s[1].count);
        CU_ASSERT_EQUAL(memcmp(s[0].x, s[1].x, (size_t)s[0].count * sizeof s[0].x[0]), 0);
    }
}

/* H has K of the effort, and mu_e of the state. */
static void test_effort(void)
{
    const subject lifted = {fixture_full, "rk4", DAL_LIFTED, 3};
    const dal_system *system;
    dal_model *model;
    CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, "test", fixture_full, strlen(fixture_full), NULL),
                          DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_set_effort(model, DAL_EFFORT_CONSTRAINT, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_set_gauge(model, "mu_e = 0.1*e*sin(x)", NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    for (int way = 0; way < 4; way++) same_series(&lifted, system, way);
    dal_model_free(model);
}

/* Interrupted after every row, and continued by another run, compiled or not. */
static void test_pieces(void)
{
    static series whole, pieces;
    enum { ROWS = 23 };
    const dal_system *system = fixture_system(subjects[0].system);
    dal_run *run = run_of(&subjects[0], system), *other = run_of(&subjects[0], system);
    size_t count;
    begin(&whole, run);
    begin(&pieces, run);
    compile(run, true, true);
    CU_ASSERT_EQUAL(sample(run, &whole, true, 1, ROWS, 0, ROWS), DAL_STATUS_OK);
    for (int row = 0; row < ROWS; row++) {
        CU_ASSERT_EQUAL(sample(other, &pieces, true, 1, ROWS, row + (row > 0), row + 1),
                        DAL_STATUS_OK);
        const double *memory = dal_run_save(other, &count);
        dal_run *const next = run_of(&subjects[0], system);
        compile(next, row % 3, row % 2);
        CU_ASSERT_EQUAL(dal_run_restore(next, memory, count, NULL), DAL_STATUS_OK);
        dal_run_free(other);
        other = next;
    }
    CU_ASSERT_EQUAL(memcmp(whole.x, pieces.x, sizeof whole.x), 0);
    CU_ASSERT_EQUAL(memcmp(whole.statistics, pieces.statistics, sizeof whole.statistics), 0);
    dal_run_free(run);
    dal_run_free(other);
}

/* ---- ends before their time ---- */

/* All samples before the step that fails are delivered. */
static void test_failure(void)
{
    static series one, many;
    const subject fall = {falling, "rk4", DAL_PHYSICAL, 0};
    dal_run *plain = run_of(&fall, fixture_system(falling));
    for (int way = 0; way < 4; way++) {
        dal_run *run = run_of(&fall, fixture_system(falling));
        begin(&one, run);
        begin(&many, run);
        compile(run, way & 1, way & 2);
        if (way == 0)
            CU_ASSERT_EQUAL(sample(plain, &one, false, 1, 1, 0, 1), DAL_STATUS_NOT_FINITE);
        CU_ASSERT_EQUAL(sample(run, &many, true, 1, 1, 0, 1), DAL_STATUS_NOT_FINITE);
        CU_ASSERT_EQUAL(many.samples, 1 + dal_run_steps(run));
        CU_ASSERT_EQUAL(dal_run_steps(run), dal_run_steps(plain));
        CU_ASSERT_EQUAL(many.t[many.samples - 1], dal_run_time(plain));
        double x[MAX_OBSERVABLES];
        CU_ASSERT_EQUAL(dal_run_observe(plain, x), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(many.x[0][many.samples - 1], x[0]);
        dal_run_free(run);
    }
    dal_run_free(plain);
}

/* An observer that wants no more ends the run where it is. */
static void test_refusal(void)
{
    static series s;
    for (int way = 0; way < 4; way++) {
        dal_run *run = run_of(&subjects[0], fixture_system(subjects[0].system));
        begin(&s, run);
        s.refuse = 300;
        compile(run, way & 1, way & 2);
        CU_ASSERT_EQUAL(sample(run, &s, true, 1, 1, 0, 1), DAL_STATUS_INTERRUPTED);
        CU_ASSERT(s.samples > 300 && dal_run_steps(run) == s.samples - 1);
        dal_run_free(run);
    }
}

/* H = pi.pi/(2e) + pi.F + p.v + mu_e pi_e of numbers that are sums of few powers of 2: no rounding,
 * F = (-x, -2 y x'). */
static void test_lift(void)
{
    static const char model[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                "forces: {x: -x, y: -2*y*x'}\ngauge: {e: 2, mu_e: 0.25}\n";
    static const dal_setting start[] = {{"x", 0.5},    {"y", 0.25},     {"x'", 0.75},
                                        {"y'", -0.5},  {"p_x", 0.125},  {"p_y", -1},
                                        {"pi_x", 0.5}, {"pi_y", -0.25}, {"pi_e", -0.375}};
    const double lift[] = {(0.25 + 0.0625) / 4 + (-0.25 + 0.09375) + (0.09375 + 0.5) - 0.09375, 1.0,
                           0.5, 0.375};
    for (dal_precision precision = DAL_DOUBLE; precision <= DAL_QUAD; precision++) {
        dal_run_spec spec = fixture_spec(fixture_system(model), "rk4", DAL_LIFTED, 0.01);
        double out[MAX_OBSERVABLES];
        spec.options.precision = precision;
        spec.start = start;
        spec.start_count = sizeof start / sizeof *start;
        dal_run *run = fixture_run(&spec);
        const int first = dal_run_observables(run) - 4;
        CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_STATUS_OK);
        for (int i = 0; i < 4; i++) CU_ASSERT_EQUAL(out[first + i], lift[i]);
        dal_run_free(run);
    }
}

/* A formula of the exact solution has no value after t = 3.5: nor has the error, whichever
 * coordinate it is of. */
static void test_exact_ends(void)
{
    static const char *const models[] = {"coordinates: [x, y]\naccelerations: {x: 0, y: 0}\nstart: "
                                         "{x': 1, y: sqrt(3.5), y': -0.5/sqrt(3.5)}\n"
                                         "exact: {x: t, y: sqrt(3.5 - t)}\n",
                                         "coordinates: [x, y]\naccelerations: {x: 0, y: 0}\nstart: "
                                         "{x: sqrt(3.5), x': -0.5/sqrt(3.5), y': 1}\n"
                                         "exact: {x: sqrt(3.5 - t), y: t}\n"};
    static series s;
    const subject of = {NULL, "rk4", DAL_PHYSICAL, 0};
    const double root = sqrt(3.5);
    for (int way = 0; way < 8; way++) {
        dal_run *run = run_of(&of, fixture_system(models[way % 2]));
        begin(&s, run);
        compile(run, way & 2, way & 2);
        CU_ASSERT_EQUAL(sample(run, &s, way & 4, 1, 1, 0, 1), DAL_STATUS_OK);
        const double *error = s.x[s.observables - 1];
        for (int k = 0; k < s.samples; k++)
            if (s.t[k] <= 3.5) {
                CU_ASSERT_DOUBLE_EQUAL(error[k], root - 0.5 * s.t[k] / root - sqrt(3.5 - s.t[k]),
                                       1e-13);
            } else {
                CU_ASSERT(isnan(error[k]));
            }
        dal_run_free(run);
    }
}

void suite_observables(void)
{
    CU_pSuite suite =
        CU_add_suite("observables of many steps", compiler_set_up, compiler_tear_down);
    CU_add_test(suite, "the same bits", test_bits);
    CU_add_test(suite, "with an effort and a gauge", test_effort);
    CU_add_test(suite, "scales of stored states", test_scales);
    CU_add_test(suite, "in pieces", test_pieces);
    CU_add_test(suite, "a step fails", test_failure);
    CU_add_test(suite, "an observer ends it", test_refusal);
    CU_add_test(suite, "H and the norms", test_lift);
    CU_add_test(suite, "an exact solution ends", test_exact_ends);
}
