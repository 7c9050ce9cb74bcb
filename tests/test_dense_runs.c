/* test_dense_runs.c - states within a step under a tolerance: against closed forms; which bits do
 * not depend on them; steps that fail, and methods without polynomials. */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <dalembert_kernel.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define SWING "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x': 1}\n"

enum { MAX_ROWS = 64, NUMBERS = 64 };

/* The rows of a run: their bits, and the largest observable `error` in units of 1 + |t|. */
typedef struct rows {
    int count, stop; /* stop: interrupt the run at this row, -1: at none */
    double state[MAX_ROWS][NUMBERS], error;
} rows;

static dal_status take_row(void *user, dal_run *run, long long row, double t)
{
    rows *r = user;
    double observed[32];
    if (row == r->stop) return DAL_STATUS_INTERRUPTED;
    const int last = dal_run_observables(run) - 1;
    CU_ASSERT_FATAL(row < MAX_ROWS && dal_run_dimension(run) <= NUMBERS && last < 32);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), t, 4 * DBL_EPSILON * fabs(t));
    memcpy(r->state[row], dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof(double));
    r->count++;
    if (last < 0) return DAL_STATUS_OK;
    CU_ASSERT_EQUAL(dal_run_observe(run, observed), DAL_STATUS_OK);
    r->error = fmax(r->error, observed[last] / (1.0 + fabs(t)));
    return DAL_STATUS_OK;
}

static dal_run_spec spec_of(const char *text, const char *method, dal_space space, double step,
                            double tolerance)
{
    dal_run_spec spec = fixture_spec(fixture_system(text), method, space, step);
    spec.options.tolerance = tolerance;
    return spec;
}

static rows sample(dal_run *run, double T, int samples)
{
    rows r = {.stop = -1};
    const dal_observer observer = {.user = &r, .sample = take_row};
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_run_sample(run, T, samples, 0, &observer, &error), DAL_STATUS_OK);
    if (error.status != DAL_STATUS_OK) printf("\n  %s\n", error.message);
    CU_ASSERT_EQUAL(r.count, samples + 1);
    return r;
}

/* Within one step of ten units the error of all rows follows the tolerance. */
static void test_closed_forms(void)
{
    static const char *const methods[] = {"dop853", "taylor", "dop853+project", "taylor+project"};
    static const char *const systems[] = {"knife-edge", "turntable-ball"};
    static const double tolerances[] = {1e-4, 1e-7, 1e-10, 1e-13, 1e-17};
    for (int i = 0; i < 4 * 2 * 2 * 5; i++) {
        const double tolerance = tolerances[i % 5], T = i / 5 % 2 ? 10.0 : -10.0;
        const bool is_lifted = i / 5 % 3 == 0 && i / 20 < 2;
        const dal_run_spec spec = spec_of(systems[i / 10 % 2], methods[i / 20],
                                          is_lifted ? DAL_LIFTED : DAL_PHYSICAL, T, tolerance);
        dal_run *run = fixture_run(&spec);
        const rows r = sample(run, T, 37);
        const double bound = 10.0 * tolerance + 4e-15;
        if (!(r.error <= bound)) printf("\n  case %d: error %.2g\n", i, r.error);
        CU_ASSERT(r.error <= bound);
        CU_ASSERT_EQUAL(dal_run_steps(run), 1);
        dal_run_free(run);
    }
}

static dal_status copy_state(void *user, dal_run *run)
{
    memcpy(user, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof(double));
    return DAL_STATUS_OK;
}

/* The bits of the state a fraction of a step away. */
static void state_at(dal_run *run, double size, double *state)
{
    CU_ASSERT_EQUAL(dal_run_intermediate(run, size, copy_state, state, NULL), DAL_STATUS_OK);
}

/* The trajectory has the same bits without rows; a row has the same bits whatever was evaluated
 * before it, and in a run that is continued between two rows. */
static void test_bits(void)
{
    static const char *const methods[] = {"dop853", "taylor"};
    for (int i = 0; i < 2; i++) {
        const dal_run_spec spec =
            spec_of("falling-disk", methods[i], DAL_LIFTED, 2.5, i ? 1e-9 : 1e-6);
        dal_run *run = fixture_run(&spec), *plain = fixture_stepped(&spec, 4);
        const rows r = sample(run, 10.0, 33);
        size_t count;
        const double *end = dal_run_save(run, &count);
        CU_ASSERT_EQUAL(memcmp(end, dal_run_save(plain, &count), count * sizeof *end), 0);
        dal_run_free(plain);
        dal_run_free(run);

        rows again = {.stop = 11};
        dal_observer observer = {.user = &again, .sample = take_row};
        run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_sample(run, 10.0, 33, 0, &observer, NULL), DAL_STATUS_INTERRUPTED);
        dal_run *resumed = fixture_run(&spec);
        const double *saved = dal_run_save(run, &count);
        CU_ASSERT_EQUAL(dal_run_restore(resumed, saved, count, NULL), DAL_STATUS_OK);
        again.stop = -1;
        CU_ASSERT_EQUAL(dal_run_sample(resumed, 10.0, 33, 11, &observer, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(memcmp(r.state, again.state, sizeof r.state), 0);
        dal_run_free(resumed);
        dal_run_free(run);

        run = fixture_run(&spec);
        for (int row = 8; row >= 1; row -= 2) {
            const double size = 10.0 * row / 33.0; /* rounded once */
            double state[NUMBERS] = {0};
            if (size >= 2.5) continue;
            state_at(run, size, state);
            CU_ASSERT_EQUAL(memcmp(state, r.state[row], sizeof state), 0);
        }
        dal_run_free(run);
    }
}

/* A state between steps follows from the present parameters and the present state. */
static void test_changes(void)
{
    static const char text[] = "coordinates: [x]\nparameters: {k: 1}\n"
                               "lagrangian: (x'^2 - k*x^2)/2\nstart: {x': 1}\n";
    const dal_run_spec spec = spec_of(text, "taylor", DAL_PHYSICAL, 5.0, 1e-15);
    dal_run *run = fixture_run(&spec);
    for (int k = 1; k <= 9; k++) {
        double state[2], start[] = {0.0, k};
        CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", k * k, NULL), DAL_STATUS_OK);
        state_at(run, 0.25, state);
        CU_ASSERT_DOUBLE_EQUAL(state[0], sin(0.25 * k) / k, 1e-14);
        CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, start, NULL), DAL_STATUS_OK);
        state_at(run, 0.25, state);
        CU_ASSERT_DOUBLE_EQUAL(state[0], sin(0.25 * k), 1e-14);
        CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, (double[]){0.0, 1.0}, NULL), DAL_STATUS_OK);
    }
    dal_run_free(run);
}

/* x = 1/(1 - t): a step of 2 fails, its substeps up to t = 1 do not. */
static void test_failing_step(void)
{
    static const char text[] = "coordinates: [x]\naccelerations: {x: 2*x^3}\n"
                               "start: {x: 1, x': 1}\n";
    static const char *const methods[] = {"dop853", "taylor"};
    for (int i = 0; i < 2; i += case_stride(2)) {
        const dal_run_spec spec = spec_of(text, methods[i], DAL_PHYSICAL, 2.0, 1e-12);
        dal_run *run = fixture_run(&spec);
        double state[2];
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_NOT_CONVERGED);
        for (int k = 9; k >= 1; k--) {
            const double t = 0.1 * k, x = 1.0 / (1.0 - t);
            state_at(run, t, state);
            CU_ASSERT_DOUBLE_EQUAL(state[0], x, 1e-8 * x);
        }
        CU_ASSERT_EQUAL(dal_run_intermediate(run, 1.5, copy_state, state, NULL),
                        DAL_STATUS_NOT_CONVERGED);
        CU_ASSERT_EQUAL(dal_run_time(run), 0.0);
        dal_run_free(run);
    }
}

/* Explicit Euler, divided into substeps of a tenth of a step, without a polynomial. */
DAL_INLINE dal_status step(dal_step *s)
{
    DAL_VECTOR(s, derivative, DAL_DIM(s));
    dal_control c = dal_control_begin(s);
    c.planned = (dal_times)dal_num(0.1 * c.whole);
    while (dal_control_next(s, &c)) {
        dal_field_at(s, c.t, s->y, derivative);
        dal_control_end(s, &c, (dal_times)dal_num(DAL__SAFE), derivative);
    }
    return dal_control_status(s, &c);
}
DAL_INTEGRATOR(divided_euler, step, .name = "divided-euler", .order = 1, .stages = 1,
               .properties = DAL_EXPLICIT | DAL_ADAPTIVE, .needs = DAL_NEEDS_FIELD);

/* A method without polynomials takes shorter steps. */
static void test_without_polynomials(void)
{
    dal_run_spec spec = spec_of(SWING, "dop853", DAL_PHYSICAL, 1.0, 1e-3);
    spec.method = (dal_method){{&dal_integrator_divided_euler}};
    dal_run *run = fixture_run(&spec);
    spec.options.step = 0.3;
    dal_run *shorter = fixture_stepped(&spec, 1);
    double state[2];
    state_at(run, 0.3, state);
    CU_ASSERT_EQUAL(memcmp(state, dal_run_state(shorter), sizeof state), 0);
    dal_run_free(shorter);
    dal_run_free(run);
}

/* ---- crossings and events ---- */

typedef struct crossings {
    int count;
    double t[16], x[16];
} crossings;

static dal_status note_crossing(void *user, dal_run *run, const dal_crossing *crossing)
{
    crossings *c = user;
    CU_ASSERT_FATAL(c->count < 16);
    c->t[c->count] = crossing->t;
    c->x[c->count++] = dal_run_state(run)[0];
    return DAL_STATUS_OK;
}

static dal_status note_event(void *user, dal_run *run, const dal_occurrence *event)
{
    return note_crossing(user, run, &(dal_crossing){.t = event->t});
}

/* x = sin t passes through 1/2 at pi/6 and 5 pi/6, in steps of one unit: there to rounding, at the
 * right time to the tolerance. */
static void test_crossings(void)
{
    static const char surface[] = SWING "invariants: {g: x - 1/2}\n";
    static const char event[] = SWING "events: [{when: x - 1/2}]\n";
    static const char *const methods[] = {"dop853", "taylor"};
    static const double tolerances[] = {1e-6, 1e-9, 1e-15}, pi = 3.14159265358979323846;
    for (int i = 0; i < 2 * 3 * 2; i++) {
        const double tolerance = tolerances[i / 2 % 3];
        const bool is_event = i % 2;
        const dal_run_spec spec =
            spec_of(is_event ? event : surface, methods[i / 6], DAL_PHYSICAL, 1.0, tolerance);
        dal_run *run = fixture_run(&spec);
        crossings c = {0};
        dal_crossings found;
        const dal_poincare section = {.callback = spec.system->invariant_values,
                                      .count = 1,
                                      .user = &c,
                                      .cross = note_crossing};
        const dal_status status = is_event ? fixture_events(run, 12.0, note_event, &c, NULL)
                                           : dal_run_crossings(run, 12.0, &section, &found, NULL);
        CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
        CU_ASSERT_EQUAL(c.count, 4);
        for (int k = 0; k < c.count; k++) {
            const double t = (k % 2 ? 5.0 : 1.0) * pi / 6.0 + 2.0 * pi * (k / 2);
            CU_ASSERT_DOUBLE_EQUAL(c.x[k], 0.5, 2.0 * DBL_EPSILON);
            CU_ASSERT_DOUBLE_EQUAL(c.t[k], t, 10.0 * tolerance * (1.0 + t) + 4e-15 * (1.0 + t));
        }
        dal_run_free(run);
    }
}

/* Rows of a run in quad precision, rounded. */
static void test_quad(void)
{
    dal_run_spec spec = spec_of(SWING, "taylor", DAL_PHYSICAL, 4.0, 1e-32);
    spec.options.precision = DAL_QUAD;
    dal_run *run = fixture_run(&spec);
    double state[2];
    for (int k = 1; k < 16; k++) {
        state_at(run, 0.25 * k, state);
        CU_ASSERT_DOUBLE_EQUAL(state[0], sin(0.25 * k), DBL_EPSILON);
        CU_ASSERT_DOUBLE_EQUAL(state[1], cos(0.25 * k), DBL_EPSILON);
    }
    dal_run_free(run);
}

void suite_dense_runs(void);
void suite_dense_runs(void)
{
    CU_pSuite suite = CU_add_suite("dense runs", NULL, NULL);
    CU_add_test(suite, "rows within a step, against closed forms", test_closed_forms);
    CU_add_test(suite, "bits that do not depend on rows", test_bits);
    CU_add_test(suite, "changed parameters and states", test_changes);
    CU_add_test(suite, "a step that fails after its rows", test_failing_step);
    CU_add_test(suite, "a method without polynomials", test_without_polynomials);
    CU_add_test(suite, "sections and events, against closed forms", test_crossings);
    CU_add_test(suite, "quad precision", test_quad);
}
