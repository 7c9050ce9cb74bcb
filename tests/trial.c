/* trial.c - a function of the library on a system whose callbacks fail, or without memory. */
#include "trial.h"
#include "allocation.h"
#include "failing.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>

enum { MAX_TRIALS = 600 };
#define CALLS case_stride(3)
/* Calls that fail in a row: differences fail where all of their 24 attempts do; with fewer they
 * are less accurate. */
static const long in_a_row[] = {1, 24, LONG_MAX};
#define OF_OTHER_DIFFERENCES 1e-3

void trial_add(trial *t, const double *numbers, int count)
{
    for (int i = 0; i < count && t->count < TRIAL_NUMBERS; i++) t->out[t->count++] = numbers[i];
}

void trial_add_number(trial *t, double number) { trial_add(t, &number, 1); }

void trial_add_run(trial *t, const dal_run *run)
{
    trial_add(t, dal_run_state(run), dal_run_dimension(run));
}

static bool are_close(const trial *a, const trial *b, double tolerance)
{
    if (isinf(tolerance)) return true;
    bool is_close = a->count == b->count && tolerance >= 0.0;
    for (int i = 0; is_close && i < a->count; i++) {
        const double x = a->out[i], y = b->out[i], size = fmax(fabs(x), 1.0);
        is_close = x == y || isnan(y) || fabs(x - y) <= tolerance * size;
    }
    return is_close;
}

/* Whether the failure of count calls from number k on is seen, or does not matter. */
static bool is_noticed(const trial *well, long k, long count, trial_work *work)
{
    trial other = {.spec = well->spec, .model = well->model};
    const bool has_differences = count > 1 && well->tolerance > 0.0;
    const double tolerance =
        has_differences ? fmax(well->tolerance, OF_OTHER_DIFFERENCES) : well->tolerance;
    failing_begin(k, count < LONG_MAX ? k + count - 1 : LONG_MAX);
    const dal_status seen = work(&other);
    const bool is_seen = seen == DAL_STATUS_IO || seen == DAL_STATUS_NOT_FINITE ||
                         seen == DAL_STATUS_NOT_CONVERGED || seen == DAL_STATUS_EVENT;
    CU_ASSERT(!is_seen || other.error.status == seen);
    if (is_seen || (seen == DAL_STATUS_OK && are_close(well, &other, tolerance))) return true;
    for (int i = 0; i < well->count; i++)
        if (well->out[i] != other.out[i]) printf("   [%d] %g %g\n", i, well->out[i], other.out[i]);
    printf("%s: ", dal_status_name(seen));
    return false;
}

static void each_call(const char *text, const char *method, trial *well, int stride,
                      trial_work *work)
{
    failing_begin(0, 0);
    const dal_status status = work(well);
    const long total = failing_calls(), by = (total / MAX_TRIALS + 1) * stride;
    CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
    CU_ASSERT(total > 0);
    if (status != DAL_STATUS_OK)
        printf("\n%.20s, %s: %s: %s\n", text, method, dal_status_name(status), well->error.message);
    for (long k = 1; k <= total; k += by) {
        for (size_t i = 0; i < sizeof in_a_row / sizeof *in_a_row; i++) {
            if (is_noticed(well, k, in_a_row[i], work)) continue;
            CU_FAIL("calls that fail unseen");
            printf("%.20s, %s: call %ld of %ld, %s, and %ld after it\n", text, method, k, total,
                   failing_name(), in_a_row[i] - 1);
        }
    }
    failing_begin(0, 0);
}

void trial_each_call(const char *text, const char *method, dal_space space, double tolerance,
                     trial_work *work)
{
    const dal_system system = failing_system(fixture_system(text), NULL);
    trial well = {.spec = fixture_spec(&system, method, space, TRIAL_STEP), .tolerance = tolerance};
    each_call(text, method, &well, CALLS, work);
}

void trial_each_call_of(const char *const *names, const char *text, const char *method,
                        double tolerance, trial_work *work)
{
    const dal_system system = failing_system(fixture_system(text), names);
    trial well = {.spec = fixture_spec(&system, method, DAL_PHYSICAL, TRIAL_STEP),
                  .tolerance = tolerance};
    each_call(text, method, &well, 1, work);
}

void trial_each_lifted_call(const char *text, dal_effort effort, const char *method,
                            double tolerance, trial_work *work)
{
    dal_model *model = fixture_model(text);
    const dal_system *system;
    CU_ASSERT_EQUAL(dal_model_set_effort(model, effort, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    const dal_system failing = failing_system(system, NULL);
    trial well = {.spec = fixture_spec(&failing, method, DAL_LIFTED, TRIAL_STEP),
                  .tolerance = tolerance};
    char name[64];
    const dal_setting start = {name, 0.3}; /* K is not seen where pi = 0 */
    snprintf(name, sizeof name, "pi_%s", system->coordinate[0]);
    well.spec.start = &start;
    well.spec.start_count = 1;
    each_call(text, method, &well, CALLS, work);
    dal_model_free(model);
}

void trial_each_callback(const char *text, dal_effort effort, const char *method, dal_space space,
                         trial_work *work)
{
    dal_model *model = fixture_model(text);
    const dal_system *system;
    int made = 0;
    CU_ASSERT_EQUAL(dal_model_set_effort(model, effort, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    for (const char *const *name = failing_callbacks; *name; name++) {
        const char *const one[] = {*name, NULL};
        const dal_system failing = failing_system(system, one);
        trial t = {.spec = fixture_spec(&failing, method, space, TRIAL_STEP)};
        failing_begin(1, LONG_MAX);
        const dal_status status = work(&t);
        if (failing_calls() == 0) continue;
        made++;
        CU_ASSERT_EQUAL(status, DAL_STATUS_IO);
        if (status != DAL_STATUS_IO)
            printf("\n%.20s, %s: %s: %s\n", text, method, *name, dal_status_name(status));
    }
    CU_ASSERT(made > 0);
    failing_begin(0, 0);
    dal_model_free(model);
}

void trial_each_tangent_call(const char *text, const char *method, dal_space space,
                             double tolerance, trial_work *work, const dal_system **tangent)
{
    const dal_system failing = failing_system(fixture_tangent(text), NULL);
    trial well = {.spec = fixture_spec(fixture_system(text), method, space, TRIAL_STEP),
                  .tolerance = tolerance};
    *tangent = &failing;
    each_call(text, method, &well, CALLS, work);
    *tangent = NULL;
}

void trial_each_model_call(const char *text, const char *method, dal_space space, double tolerance,
                           trial_work *work)
{
    dal_model *model = fixture_model(text);
    const dal_system *system;
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    trial well = {.spec = fixture_spec(system, method, space, TRIAL_STEP),
                  .model = model,
                  .tolerance = tolerance};
    /* It is the model's, which a caller cannot change. */
    *(dal_system *)(void *)(size_t)(const void *)system = failing_system(system, NULL);
    each_call(text, method, &well, CALLS, work);
    dal_model_free(model);
}

void trial_each_allocation(const char *text, const char *method, dal_space space, trial_work *work)
{
    const dal_system *system = fixture_system(text);
    allocation_trial allocations = {0};
    while (allocation_next(&allocations)) {
        trial t = {.spec = fixture_spec(system, method, space, TRIAL_STEP)};
        allocation_start(&allocations);
        allocation_end(&allocations, work(&t));
    }
    CU_ASSERT(allocations.failures > 0);
}
