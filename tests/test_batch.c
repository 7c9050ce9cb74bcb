/* test_batch.c - batches: lane by lane the bits of a single run, at every width, whatever the
 * neighbours do. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LANES = 11, STEPS = 40 };

/* Lane i has its own parameter and start. */
static dal_setting lane_parameter(int i) { return (dal_setting){"a", 0.3 + 0.01 * i}; }
static dal_setting lane_start(int i) { return (dal_setting){"u", 0.2 - 0.03 * i}; }

static void single_end(dal_run_spec spec, int lane, double *state)
{
    const dal_setting parameter = lane_parameter(lane), start = lane_start(lane);
    spec.parameters = &parameter;
    spec.start = &start;
    spec.parameter_count = spec.start_count = 1;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_advance(run, STEPS, NULL), DAL_OK);
    memcpy(state, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *state);
    dal_run_free(run);
}

static void same_bits(const dal_run_spec *spec, int width, int dimension)
{
    dal_batch *batch = NULL;
    double single[64], lane[64];
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, spec, LANES, width, NULL), DAL_OK);
    for (int i = 0; i < LANES; i++) {
        const dal_setting parameter = lane_parameter(i), start = lane_start(i);
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &parameter, 1, &start, 1, NULL), DAL_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, STEPS / 2), DAL_OK);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, STEPS / 2), DAL_OK);
    for (int i = 0; i < LANES; i++) {
        single_end(*spec, i, single);
        dal_batch_state(batch, i, lane);
        CU_ASSERT_EQUAL(dal_batch_status(batch, i, NULL), DAL_OK);
        CU_ASSERT_EQUAL(memcmp(single, lane, (size_t)dimension * sizeof *lane), 0);
    }
    dal_batch_free(batch);
}

static void test_same_bits(void)
{
    static const int widths[] = {1, 4, 8};
    dal_model *model = fixture_model(fixture_full);
    const dal_system *system = fixture_system(model);
    for (int i = 0; dal_integrator_at(i); i++) {
        if (dal_integrator_at(i)->claims & DAL_MODIFIER) continue;
        for (int kind = 0; kind < 4; kind++) {
            char name[64];
            snprintf(name, sizeof name, "%s%s", dal_integrator_at(i)->name,
                     kind & 2 ? "+project" : "");
            const dal_space space = kind & 1 ? DAL_PHYSICAL : DAL_LIFTED;
            const dal_run_spec spec = fixture_spec(system, name, space, 0.02);
            const int dimension = space == DAL_LIFTED ? 4 * system->n + 2 : 2 * system->n;
            for (int w = 0; w < 3; w++) same_bits(&spec, widths[w], dimension);
        }
    }
    dal_model_free(model);
}

/* Some lanes need Newton, some do not; the others must not notice. */
static void test_mixed_stiffness(void)
{
    dal_model *model = fixture_model("chaplygin-sleigh-friction");
    const dal_run_spec spec = fixture_spec(fixture_system(model), "gauss6", DAL_LIFTED, 0.02);
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 8, 8, NULL), DAL_OK);
    dal_setting k[8];
    for (int i = 0; i < 8; i++) {
        k[i] = (dal_setting){"k", i % 2 ? 10.0 + i : 3000.0 * i + 10.0};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &k[i], 1, NULL, 0, NULL), DAL_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 50), DAL_OK);
    for (int i = 0; i < 8; i++) {
        double lane[64];
        dal_run_spec one = spec;
        one.parameters = &k[i];
        one.parameter_count = 1;
        dal_run *run = fixture_run(&one);
        CU_ASSERT_EQUAL(dal_run_advance(run, 50, NULL), DAL_OK);
        dal_batch_state(batch, i, lane);
        CU_ASSERT_EQUAL(memcmp(lane, dal_run_state(run), 14 * sizeof *lane), 0);
        dal_run_free(run);
    }
    dal_batch_free(batch);
    dal_model_free(model);
}

/* A lane that fails stops, says why, keeps its last state; the others go on. */
static void test_failing_lane(void)
{
    const char *text = "coordinates: [x]\nparameters: {s: 1}\nlagrangian: x'^2/2\n"
                       "forces: {x: -s*sqrt(x)}\nstart: {x: 1}\n";
    dal_model *model = fixture_model(text);
    const dal_run_spec spec = fixture_spec(fixture_system(model), "rk4", DAL_PHYSICAL, 0.01);
    const dal_setting fast = {"s", 100.0}, none = {"s", 0.0};
    dal_batch *batch = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 6, 4, NULL), DAL_OK);
    for (int i = 0; i < 6; i++)
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, i == 2 ? &fast : &none, 1, NULL, 0, NULL),
                        DAL_OK);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 100), DAL_OK);
    for (int i = 0; i < 6; i++) {
        double state[2];
        dal_batch_state(batch, i, state);
        CU_ASSERT_EQUAL(dal_batch_status(batch, i, &error), i == 2 ? DAL_NOT_FINITE : DAL_OK);
        if (i != 2) CU_ASSERT_EQUAL(state[0], 1.0);
        if (i != 2) CU_ASSERT_DOUBLE_EQUAL(dal_batch_time(batch, i), 1.0, 1e-15);
        if (i == 2) CU_ASSERT(state[0] > 0.0 && dal_batch_time(batch, i) < 0.5);
        if (i == 2) CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "not finite"));
    }
    dal_batch_free(batch);
    dal_model_free(model);
}

static void test_arguments(void)
{
    dal_model *model = fixture_model("chaplygin-sleigh");
    const dal_run_spec spec = fixture_spec(fixture_system(model), "rk4", DAL_LIFTED, 0.1);
    dal_batch *batch = NULL;
    dal_error error;
    CU_ASSERT_EQUAL(dal_batch_create(&batch, &spec, 0, 0, &error), DAL_ARGUMENT);
    CU_ASSERT_EQUAL(dal_batch_create(&batch, &spec, 3, 5, &error), DAL_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 3, 0, &error), DAL_OK);
    CU_ASSERT_EQUAL(dal_batch_count(batch), 3);
    CU_ASSERT_EQUAL(dal_batch_start(batch, 3, NULL, 0, NULL, 0, &error), DAL_ARGUMENT);
    CU_ASSERT_EQUAL(dal_batch_status(batch, -1, &error), DAL_ARGUMENT);
    const dal_setting bad = {"y2'", 1.0};
    CU_ASSERT_EQUAL(dal_batch_start(batch, 1, NULL, 0, &bad, 1, &error), DAL_INCONSISTENT);
    dal_batch_free(batch);
    dal_model_free(model);
}

void suite_batch(void)
{
    CU_pSuite suite = CU_add_suite("batch", NULL, NULL);
    CU_add_test(suite, "the bits of single runs, widths 1, 4, 8", test_same_bits);
    CU_add_test(suite, "stiff and easy lanes side by side", test_mixed_stiffness);
    CU_add_test(suite, "a failing lane", test_failing_lane);
    CU_add_test(suite, "arguments", test_arguments);
}
