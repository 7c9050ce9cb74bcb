/* test_null.c - NULL, nameless settings and negative counts, given to systems, methods, runs and
 * batches. */
#include "dalembert_program.h"
#include "null.h"
#include <stdlib.h>
#include <string.h>

/* What dalembert.h includes. */
#define FUNCTIONS_OF_RUNS(X)                                                                       \
    FUNCTIONS_dalembert_status(X) FUNCTIONS_dalembert_system(X) FUNCTIONS_dalembert_model(X)       \
        FUNCTIONS_dalembert_method(X) FUNCTIONS_dalembert_run(X) FUNCTIONS_dalembert_batch(X)
FUNCTIONS_OF_RUNS(DECLARE_NULL_TEST)

/* ---- what the functions are given where they are given anything ---- */

static dal_model *model;
static dal_run_spec spec;
static dal_run *run;
static dal_batch *batch;
static dal_method method;
static char buffer[64];
static double numbers[64];

static int open_objects(void)
{
    const int failed = open_runs(&model, &spec, &run, &batch);
    method = spec.method;
    return failed;
}

static int close_objects(void) { return close_runs(model, run, batch); }

/* ---- statuses and numbers ---- */

static void null_dal_status_name(void) { CU_ASSERT_PTR_NOT_NULL(dal_status_name((dal_status)-1)); }
static void null_dal_status_text(void) { CU_ASSERT_PTR_NOT_NULL(dal_status_text((dal_status)-1)); }

static void null_dal_options_default(void) { CU_ASSERT(dal_options_default().step > 0.0); }

static void null_dal_min_tolerance(void) { CU_ASSERT(isnan(dal_min_tolerance(NULL))); }
static void null_dal_options_set(void)
{
    dal_options options = dal_options_default();
    REFUSED(dal_options_set(NULL, "step", "1", error));
    REFUSED(dal_options_set(&options, NULL, "1", error));
    REFUSED(dal_options_set(&options, "step", NULL, error));
}

/* ---- runs ---- */

static void null_dal_run_size(void)
{
    CU_ASSERT(dal_run_size(&spec) > 0);
    for (int i = 0; i < BAD_SPECS; i++) CU_ASSERT_EQUAL(dal_run_size(spoil_spec(&spec, i)), 0);
}

static void null_dal_run_init(void)
{
    const size_t bytes = dal_run_size(&spec);
    void *memory = malloc(bytes);
    dal_run *made = run;
    REFUSED(dal_run_init(NULL, memory, bytes, &spec, error));
    REFUSED(dal_run_init(&made, NULL, bytes, &spec, error));
    CU_ASSERT_PTR_NULL(made);
    for (int i = 0; i < BAD_SPECS; i++)
        REFUSED(dal_run_init(&made, memory, bytes, spoil_spec(&spec, i), error));
    free(memory);
}

static void null_dal_run_create(void)
{
    dal_run *made = run;
    REFUSED(dal_run_create(NULL, &spec, error));
    for (int i = 0; i < BAD_SPECS; i++) REFUSED(dal_run_create(&made, spoil_spec(&spec, i), error));
    CU_ASSERT_PTR_NULL(made);
}

static void null_dal_run_free(void) { dal_run_free(NULL); }
static void null_dal_run_step(void) { REFUSED(dal_run_step(NULL, error)); }

static void null_dal_run_advance(void)
{
    REFUSED(dal_run_advance(NULL, 1, error));
    REFUSED(dal_run_advance(run, -1, error));
    CU_ASSERT_EQUAL(dal_run_advance(run, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_steps(run), 0);
}

static void null_dal_run_system(void) { CU_ASSERT_PTR_NULL(dal_run_system(NULL)); }
static void null_dal_run_time(void) { CU_ASSERT(isnan(dal_run_time(NULL))); }
static void null_dal_run_step_size(void) { CU_ASSERT(isnan(dal_run_step_size(NULL))); }
static void null_dal_run_tolerance(void) { CU_ASSERT(isnan(dal_run_tolerance(NULL))); }
static void null_dal_run_steps(void) { CU_ASSERT_EQUAL(dal_run_steps(NULL), 0); }
static void null_dal_run_evaluations(void) { CU_ASSERT_EQUAL(dal_run_evaluations(NULL), 0); }
static void null_dal_run_dimension(void) { CU_ASSERT_EQUAL(dal_run_dimension(NULL), 0); }
static void null_dal_run_state(void) { CU_ASSERT_PTR_NULL(dal_run_state(NULL)); }
static void null_dal_run_parameters(void) { CU_ASSERT_PTR_NULL(dal_run_parameters(NULL)); }

static void null_dal_run_set_state(void)
{
    REFUSED(dal_run_set_state(NULL, 0.0, numbers, error));
    REFUSED(dal_run_set_state(run, 0.0, NULL, error));
}

static void null_dal_run_component_name(void)
{
    CU_ASSERT_PTR_NULL(dal_run_component_name(NULL, 0, buffer, sizeof buffer));
    CU_ASSERT_PTR_NULL(dal_run_component_name(run, 0, NULL, sizeof buffer));
    CU_ASSERT_PTR_NULL(dal_run_component_name(run, -1, buffer, sizeof buffer));
}

static void null_dal_run_component_index(void)
{
    CU_ASSERT_EQUAL(dal_run_component_index(NULL, "phi"), -1);
    CU_ASSERT_EQUAL(dal_run_component_index(run, NULL), -1);
}

static void null_dal_run_set_parameter(void)
{
    REFUSED(dal_run_set_parameter(NULL, "m", 1.0, error));
    REFUSED(dal_run_set_parameter(run, NULL, 1.0, error));
}

static void null_dal_run_save(void)
{
    size_t count = 7;
    CU_ASSERT_PTR_NULL(dal_run_save(NULL, &count));
    CU_ASSERT_EQUAL(count, 0);
    CU_ASSERT_PTR_NULL(dal_run_save(run, NULL));
}

static void null_dal_run_restore(void)
{
    size_t count;
    const double *memory = dal_run_save(run, &count);
    REFUSED(dal_run_restore(NULL, memory, count, error));
    REFUSED(dal_run_restore(run, NULL, count, error));
}

static void null_dal_run_observables(void) { CU_ASSERT_EQUAL(dal_run_observables(NULL), 0); }

static void null_dal_run_observable_name(void)
{
    CU_ASSERT_PTR_NULL(dal_run_observable_name(NULL, 0, buffer, sizeof buffer));
    CU_ASSERT_PTR_NULL(dal_run_observable_name(run, 0, NULL, sizeof buffer));
    CU_ASSERT_PTR_NULL(dal_run_observable_name(run, -1, buffer, sizeof buffer));
}

static void null_dal_run_observe(void)
{
    REFUSED_STATUS(dal_run_observe(NULL, numbers));
    REFUSED_STATUS(dal_run_observe(run, NULL));
}

static void null_dal_run_scales(void) { CU_ASSERT_PTR_NULL(dal_run_scales(NULL)); }

static void null_dal_run_sample(void)
{
    REFUSED(dal_run_sample(NULL, 1.0, 1, 0, NULL, error));
    REFUSED(dal_run_sample(run, 1.0, -1, 0, NULL, error));
    REFUSED(dal_run_sample(run, 1.0, 1, -1, NULL, error));
    CU_ASSERT_EQUAL(dal_run_sample(run, 1.0, 1, 0, NULL, NULL), DAL_STATUS_OK);
    REFUSED(dal_run_sample(run, 2.0, 1, 1, &(dal_observer){.every = -1}, error));
    REFUSED(dal_run_sample(run, 2.0, 1, 1, &(dal_observer){.polling = -1}, error));
}

static dal_status see(void *user, dal_run *seen)
{
    return user || !seen ? DAL_STATUS_IO : DAL_STATUS_OK;
}

static void null_dal_run_intermediate(void)
{
    REFUSED(dal_run_intermediate(NULL, 0.1, see, NULL, error));
    REFUSED(dal_run_intermediate(run, 0.1, NULL, NULL, error));
    CU_ASSERT_EQUAL(dal_run_intermediate(run, 0.1, see, NULL, NULL), DAL_STATUS_OK);
}

static void null_dal_run_event_count(void)
{
    CU_ASSERT_EQUAL(dal_run_event_count(NULL, 0), -1);
    CU_ASSERT_EQUAL(dal_run_event_count(run, 0), -1);
}

static void null_dal_run_stopped(void)
{
    CU_ASSERT_EQUAL(dal_run_stopped(NULL), 0);
    CU_ASSERT_EQUAL(dal_run_stopped(run), 0);
}

static void null_dal_run_event_jump(void)
{
    CU_ASSERT_EQUAL(dal_run_event_jump(NULL, 0), 0.0);
    CU_ASSERT_EQUAL(dal_run_event_jump(run, -1), 0.0);
}

static void null_dal_run_unresolved(void)
{
    double from = 0.0;
    CU_ASSERT_EQUAL(dal_run_unresolved(NULL, &from), 0);
    CU_ASSERT(isnan(from));
    CU_ASSERT_EQUAL(dal_run_unresolved(run, NULL), 0);
}

/* ---- batches ---- */

static void null_dal_batch_create(void)
{
    dal_batch *made = batch;
    REFUSED(dal_batch_create(NULL, &spec, 3, 0, error));
    for (int i = 0; i < BAD_SPECS; i++)
        REFUSED(dal_batch_create(&made, spoil_spec(&spec, i), 3, 0, error));
    REFUSED(dal_batch_create(&made, &spec, -1, 0, error));
    REFUSED(dal_batch_create(&made, &spec, 3, -1, error));
    CU_ASSERT_PTR_NULL(made);
}

static void null_dal_batch_free(void) { dal_batch_free(NULL); }

static void null_dal_batch_start(void)
{
    REFUSED(dal_batch_start(NULL, 0, NULL, 0, NULL, 0, error));
    REFUSED(dal_batch_start(batch, -1, NULL, 0, NULL, 0, error));
    REFUSED(dal_batch_start(batch, 0, COUNT_NEGATIVE, NULL, 0, error));
    REFUSED(dal_batch_start(batch, 0, SETTINGS_MISSING, NULL, 0, error));
    REFUSED(dal_batch_start(batch, 0, NAME_MISSING, NULL, 0, error));
    REFUSED(dal_batch_start(batch, 0, NULL, 0, COUNT_NEGATIVE, error));
    REFUSED(dal_batch_start(batch, 0, NULL, 0, SETTINGS_MISSING, error));
    REFUSED(dal_batch_start(batch, 0, NULL, 0, NAME_MISSING, error));
}

/* A batch refused to go backwards has not been stepped: its lanes may still be started. */
static void null_dal_batch_set_parameter(void)
{
    REFUSED(dal_batch_set_parameter(NULL, 0, "m", 1.0, error));
    REFUSED(dal_batch_set_parameter(batch, -1, "m", 1.0, error));
    REFUSED(dal_batch_set_parameter(batch, 0, NULL, 1.0, error));
}

static void null_dal_batch_advance(void)
{
    REFUSED_STATUS(dal_batch_advance(NULL, 1));
    REFUSED_STATUS(dal_batch_advance(batch, -1));
    CU_ASSERT_EQUAL(dal_batch_start(batch, 0, NULL, 0, NULL, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_time(batch, 0), 0.0);
}

static void null_dal_batch_count(void) { CU_ASSERT_EQUAL(dal_batch_count(NULL), 0); }

static void null_dal_batch_status(void)
{
    REFUSED(dal_batch_status(NULL, 0, error));
    REFUSED(dal_batch_status(batch, -1, error));
}

static void null_dal_batch_time(void)
{
    CU_ASSERT(isnan(dal_batch_time(NULL, 0)));
    CU_ASSERT(isnan(dal_batch_time(batch, -1)));
}

static void null_dal_batch_state(void)
{
    numbers[0] = 7.0;
    dal_batch_state(NULL, 0, numbers);
    dal_batch_state(batch, -1, numbers);
    dal_batch_state(batch, 0, NULL);
    CU_ASSERT_EQUAL(numbers[0], 7.0);
}

static void null_dal_variation_parse(void)
{
    dal_variation v;
    REFUSED(dal_variation_parse(NULL, "x=normal(0,1)", error));
    REFUSED(dal_variation_parse(&v, NULL, error));
}
static void null_dal_variation_draw(void) { CU_ASSERT(isnan(dal_variation_draw(NULL, 1, 1))); }
static void null_dal_ensemble_create(void)
{
    dal_ensemble *made;
    REFUSED(dal_ensemble_create(NULL, &spec, NULL, 0, 1, 8, error));
    REFUSED(dal_ensemble_create(&made, NULL, NULL, 0, 1, 8, error));
    REFUSED(dal_ensemble_create(&made, &spec, NULL, 1, 1, 8, error));
    REFUSED(dal_ensemble_create(&made, &spec, NULL, -1, 1, 8, error));
}
static void null_dal_ensemble_free(void) { dal_ensemble_free(NULL); }
static void null_dal_ensemble_start(void)
{
    CU_ASSERT_EQUAL(dal_ensemble_start(NULL, 0, 1), DAL_STATUS_ARGUMENT);
}
static void null_dal_ensemble_batch(void) { CU_ASSERT_PTR_NULL(dal_ensemble_batch(NULL)); }
static void null_dal_ensemble_draws(void) { dal_ensemble_draws(NULL, numbers); }
static void null_dal_ensemble_states(void) { dal_ensemble_states(NULL, numbers); }

static void null_dal_spread_measure(void)
{
    dal_spread spread;
    dal_spread_measure(&spread, NULL, 1);
    CU_ASSERT(spread.count == 0 && isnan(spread.mean));
    dal_spread_measure(&spread, numbers, -1);
    CU_ASSERT(spread.count == 0 && isnan(spread.max));
    dal_spread_measure(NULL, numbers, 1);
}

static void null_dal_measure_quantiles(void)
{
    double q = 0.0;
    dal_measure_quantiles(NULL, 1, numbers, 1, &q);
    CU_ASSERT(isnan(q));
    dal_measure_quantiles(numbers, 1, NULL, 1, &q);
    dal_measure_quantiles(numbers, 1, numbers, 1, NULL);
}

static void null_dal_batch_clear(void)
{
    CU_ASSERT_EQUAL(dal_batch_clear(NULL), DAL_STATUS_ARGUMENT);
}
static void null_dal_batch_set_state(void)
{
    REFUSED(dal_batch_set_state(NULL, 0, 0.0, numbers, error));
    REFUSED(dal_batch_set_state(batch, 0, 0.0, NULL, error));
}
static void null_dal_batch_states(void)
{
    numbers[0] = 7.0;
    dal_batch_states(NULL, numbers);
    dal_batch_states(batch, NULL);
    CU_ASSERT_EQUAL(numbers[0], 7.0);
}

/* ---- methods ---- */

static void null_dal_integrator_at(void) { CU_ASSERT_PTR_NULL(dal_integrator_at(-1)); }

static void null_dal_method_parse(void)
{
    dal_method parsed;
    REFUSED(dal_method_parse(NULL, "rk4", error));
    REFUSED(dal_method_parse(&parsed, NULL, error));
}

static void null_dal_method_name(void)
{
    CU_ASSERT_PTR_NULL(dal_method_name(NULL, buffer, sizeof buffer));
    CU_ASSERT_PTR_NULL(dal_method_name(&method, NULL, sizeof buffer));
}

static void null_dal_method_complete(void)
{
    const dal_options options = dal_options_default();
    const dal_system system = {.n = 1};
    dal_method none = {{NULL}};
    CU_ASSERT_EQUAL(dal_method_complete(NULL, &system, &options, NULL, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_method_complete(&none, NULL, &options, NULL, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_method_complete(&none, &system, NULL, NULL, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_method_complete(&none, &system, &options, NULL, NULL), DAL_STATUS_OK);
}
static void null_dal_method_order(void) { CU_ASSERT_EQUAL(dal_method_order(NULL), 0); }
static void null_dal_method_properties(void) { CU_ASSERT_EQUAL(dal_method_properties(NULL), 0); }
static void null_dal_method_needs(void) { CU_ASSERT_EQUAL(dal_method_needs(NULL), 0); }

/* ---- models ---- */

static void null_dal_model_create(void)
{
    dal_model *nobody = dal_model_create(NULL);
    CU_ASSERT_PTR_NOT_NULL(nobody);
    dal_model_free(nobody);
}

static void null_dal_model_free(void) { dal_model_free(NULL); }

static void null_dal_model_add(void)
{
    dal_model *made = dal_model_create("made");
    REFUSED(dal_model_add(NULL, DAL_SECTION_TITLE, NULL, "text", 0, 0, error));
    REFUSED(dal_model_add(made, DAL_SECTION_TITLE, NULL, NULL, 0, 0, error));
    REFUSED(dal_model_add(made, DAL_SECTION_START, NULL, "1", 0, 0, error));
    REFUSED(dal_model_add(made, DAL_SECTION_START, "x", NULL, 0, 0, error));
    REFUSED(dal_model_add(made, DAL_SECTION_REACTIONS, NULL, "1", 0, 0, error));
    REFUSED(dal_model_add(made, (dal_section)-1, "x", "1", 0, 0, error));
    dal_model_free(made);
}

static void null_dal_model_add_table(void)
{
    static const double at[] = {0.0, 1.0}, value[] = {2.0, 3.0};
    dal_table table = {.at = at, .value = value, .points = 2};
    dal_model *made = dal_model_create("made");
    REFUSED(dal_model_add_table(NULL, "f", &table, 0, 0, error));
    REFUSED(dal_model_add_table(made, NULL, &table, 0, 0, error));
    REFUSED(dal_model_add_table(made, "f", NULL, 0, 0, error));
    REFUSED(dal_model_add(made, DAL_SECTION_TABLES, "f", "1", 0, 0, error));
    CU_ASSERT_EQUAL(dal_model_add_table(made, "f", &table, 0, 0, NULL), DAL_STATUS_OK);
    table.at = NULL;
    REFUSED(dal_model_add_table(made, "g", &table, 0, 0, error));
    table.points = 0;
    CU_ASSERT_EQUAL(dal_model_add_table(made, "g", &table, 0, 0, NULL), DAL_STATUS_MODEL);
    dal_model_free(made);
}

static void null_dal_effort_name(void)
{
    CU_ASSERT_STRING_EQUAL(dal_effort_name(DAL_EFFORT_CONTROLS), "controls");
    CU_ASSERT_STRING_EQUAL(dal_effort_name((dal_effort)-1), "?");
    CU_ASSERT_STRING_EQUAL(dal_effort_name(DAL_EFFORT_COUNT), "?");
}

static void null_dal_model_set_mechanics(void)
{
    dal_model *made = dal_model_create("made");
    REFUSED(dal_model_set_mechanics(NULL, DAL_MECHANICS_VAKONOMIC, error));
    REFUSED(dal_model_set_mechanics(made, DAL_MECHANICS_COUNT, error));
    REFUSED(dal_model_set_mechanics(made, (dal_mechanics)-1, error));
    dal_model_free(made);
}

static void null_dal_model_set_effort(void)
{
    dal_model *made = dal_model_create("made");
    REFUSED(dal_model_set_effort(NULL, DAL_EFFORT_MASS, error));
    REFUSED(dal_model_set_effort(made, DAL_EFFORT_COUNT, error));
    REFUSED(dal_model_set_effort(made, (dal_effort)-1, error));
    dal_model_free(made);
}

static void null_dal_model_set_gauge(void)
{
    dal_model *made = dal_model_create("made");
    REFUSED(dal_model_set_gauge(NULL, "e = 1", error));
    REFUSED(dal_model_set_gauge(made, NULL, error));
    dal_model_free(made);
}

static void null_dal_model_observe(void)
{
    static const char *const bad[] = {"x", "x'", " x+1", "x\n+1", "x+\"1\"", ""};
    dal_model *made = dal_model_create("made");
    REFUSED(dal_model_observe(NULL, "x + 1", 0, 0, error));
    REFUSED(dal_model_observe(made, NULL, 0, 0, error));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        CU_ASSERT_NOT_EQUAL(dal_model_observe(made, bad[i], 0, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_observe(made, "x + 1", 0, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_observe(made, "x + 1", 0, 0, NULL), DAL_STATUS_MODEL);
    REFUSED(dal_model_add(made, DAL_SECTION_COORDINATES, NULL, "x", 0, 0, error));
    dal_model_free(made);
}

static void null_dal_model_source(void)
{
    static const char text[] = "coordinates: [x]\n";
    size_t length = 0;
    dal_model *made = dal_model_create("made");
    CU_ASSERT_PTR_NULL(dal_model_source(NULL, &length));
    CU_ASSERT_PTR_NULL(dal_model_source(made, &length));
    dal_model_free(made);
    CU_ASSERT_EQUAL(dal_model_read(&made, "made", text, strlen(text), NULL), DAL_STATUS_OK);
    CU_ASSERT_STRING_EQUAL(dal_model_source(made, &length), text);
    CU_ASSERT_EQUAL(length, strlen(text));
    CU_ASSERT_STRING_EQUAL(dal_model_source(made, NULL), text);
    dal_model_free(made);
}

static void null_dal_model_text(void)
{
    dal_model *made = dal_model_create("made");
    const char *name = NULL;
    int line = 0, column = 0;
    CU_ASSERT_EQUAL(dal_model_add(made, DAL_SECTION_START, "x", "1", 2, 9, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_add(made, DAL_SECTION_START, "y", "2*k", 3, 7, NULL), DAL_STATUS_OK);
    CU_ASSERT_PTR_NULL(dal_model_text(NULL, DAL_SECTION_START, 0, &name, &line, &column));
    CU_ASSERT_PTR_NULL(dal_model_text(made, DAL_SECTION_START, -1, &name, &line, &column));
    CU_ASSERT_PTR_NULL(dal_model_text(made, DAL_SECTION_START, 2, &name, &line, &column));
    CU_ASSERT_PTR_NULL(dal_model_text(made, (dal_section)-1, 0, &name, &line, &column));
    CU_ASSERT_PTR_NULL(name);
    CU_ASSERT_STRING_EQUAL(dal_model_text(made, DAL_SECTION_START, 1, NULL, NULL, NULL), "2*k");
    dal_model_text(made, DAL_SECTION_START, 1, &name, &line, &column);
    CU_ASSERT_STRING_EQUAL(name, "y");
    CU_ASSERT(line == 3 && column == 7);
    dal_model_free(made);
}

static void null_dal_model_warning(void)
{
    static const char text[] = "coordinates: [x, max]\nparameters: {if: 2}\n"
                               "lagrangian: (x'^2 + max'^2)/2 - if*max\n";
    dal_model *made = NULL;
    const dal_system *made_system = NULL;
    int line = 0, column = 0;
    CU_ASSERT_EQUAL(dal_model_read(&made, "made", text, strlen(text), NULL), DAL_STATUS_OK);
    CU_ASSERT_PTR_NULL(dal_model_warning(made, 0, &line, &column)); /* there is no system yet */
    CU_ASSERT_EQUAL(dal_model_system(made, &made_system, NULL), DAL_STATUS_OK);
    CU_ASSERT_STRING_EQUAL(dal_model_warning(made, 0, NULL, NULL),
                           "coordinate 'max' hides the function of this name");
    CU_ASSERT_PTR_NOT_NULL(dal_model_warning(made, 1, &line, &column));
    CU_ASSERT(line == 2 && column == 14);
    CU_ASSERT_PTR_NULL(dal_model_warning(made, 2, &line, &column));
    CU_ASSERT_PTR_NULL(dal_model_warning(made, -1, &line, &column));
    CU_ASSERT_PTR_NULL(dal_model_warning(NULL, 0, &line, &column));
    dal_model_free(made);
}

static void null_dal_model_read(void)
{
    dal_model *made = model;
    REFUSED(dal_model_read(NULL, "name", "coordinates: [x]", 16, error));
    REFUSED(dal_model_read(&made, "name", NULL, 16, error));
    CU_ASSERT_PTR_NULL(made);
    CU_ASSERT_EQUAL(dal_model_read(&made, NULL, "coordinates: [x]", 16, NULL), DAL_STATUS_OK);
    dal_model_free(made);
}

static void null_dal_model_read_file(void)
{
    dal_model *made = model;
    REFUSED(dal_model_read_file(NULL, "systems/contact-oscillator.yaml", error));
    REFUSED(dal_model_read_file(&made, NULL, error));
    CU_ASSERT_PTR_NULL(made);
}

static void null_dal_model_builtin(void)
{
    dal_model *made = model;
    REFUSED(dal_model_builtin(NULL, "chaplygin-sleigh", error));
    REFUSED(dal_model_builtin(&made, NULL, error));
    CU_ASSERT_PTR_NULL(made);
}

static void null_dal_builtin_name(void) { CU_ASSERT_PTR_NULL(dal_builtin_name(-1)); }
static void null_dal_builtin_text(void) { CU_ASSERT_PTR_NULL(dal_builtin_text(NULL)); }

static void null_dal_model_system(void)
{
    const dal_system *system = spec.system;
    REFUSED(dal_model_system(model, NULL, error));
    REFUSED(dal_model_system(NULL, &system, error));
    CU_ASSERT_PTR_NULL(system);
}

static void null_dal_model_tangent(void)
{
    const dal_system *system = spec.system;
    REFUSED(dal_model_tangent(model, NULL, error));
    REFUSED(dal_model_tangent(NULL, &system, error));
    CU_ASSERT_PTR_NULL(system);
}
static void null_dal_model_tangent_by(void)
{
    const dal_system *system;
    REFUSED(dal_model_tangent_by(model, "m", NULL, error));
    REFUSED(dal_model_tangent_by(model, NULL, &system, error));
    REFUSED(dal_model_tangent_by(NULL, "m", &system, error));
}
static void null_dal_model_growth(void)
{
    dal_growth growth;
    REFUSED(dal_model_growth(NULL, NULL, 0, NULL, &growth, error));
    REFUSED(dal_model_growth(model, NULL, 0, NULL, NULL, error));
    REFUSED(dal_model_growth(model, NULL, 1, NULL, &growth, error));
    REFUSED(dal_model_growth(model, NULL, -1, NULL, &growth, error));
    REFUSED(dal_model_growth(model, &(dal_setting){NULL, 1.0}, 1, NULL, &growth, error));
}

static void null_dal_model_growth_of(void)
{
    dal_growth growth;
    REFUSED(dal_model_growth_of(NULL, 0, NULL, 0, NULL, &growth, error));
    REFUSED(dal_model_growth_of(model, 0, NULL, 0, NULL, NULL, error));
    REFUSED(dal_model_growth_of(model, 0, NULL, 1, NULL, &growth, error));
    REFUSED(dal_model_growth_of(model, -1, NULL, 0, NULL, &growth, error));
}

static void null_dal_model_ranks(void)
{
    const double x[8] = {0};
    const dal_point at = {.q = x, .v = x};
    dal_ranks ranks;
    REFUSED(dal_model_ranks(NULL, NULL, 0, &at, NULL, &ranks, error));
    REFUSED(dal_model_ranks(model, NULL, 0, &at, NULL, NULL, error));
    REFUSED(dal_model_ranks(model, NULL, 0, NULL, NULL, &ranks, error));
    REFUSED(dal_model_ranks(model, NULL, 0, &(dal_point){.q = x}, NULL, &ranks, error));
    REFUSED(dal_model_ranks(model, NULL, 1, &at, NULL, &ranks, error));
    REFUSED(dal_model_ranks(model, &(dal_setting){NULL, 1.0}, 1, &at, NULL, &ranks, error));
}

void suite_null(void)
{
    CU_pSuite suite = CU_add_suite("NULL and negative counts", open_objects, close_objects);
    FUNCTIONS_OF_RUNS(ADD_NULL_TEST)
}
