/* test_null_action.c - NULL and missing rows, given to actions, invariants and
 * predictions, and to what the program alone uses. */
#include "dalembert_analysis.h"
#include "dalembert_program.h"
#include "null.h"

FUNCTIONS_dalembert_action(DECLARE_NULL_TEST) FUNCTIONS_dalembert_predict(DECLARE_NULL_TEST)
    FUNCTIONS_dalembert_invariants(DECLARE_NULL_TEST)

        static dal_model *model;
static dal_run_spec spec;
static dal_evaluator *evaluator;
static double numbers[64];

static int open_objects(void)
{
    if (open_spec(&model, &spec) != DAL_STATUS_OK) return 1;
    return dal_evaluator_create(&evaluator, spec.system, NULL, 0, NULL) != DAL_STATUS_OK;
}

static int close_objects(void)
{
    dal_evaluator_free(evaluator);
    dal_model_free(model);
    return 0;
}

/* A curve of the evaluator's system. */
static const double curve_t[7] = {0, 1, 2, 3, 4, 5, 6};
static const dal_curve curve = {.rows = 7, .t = curve_t, .q = numbers, .v = numbers};

static void null_dal_evaluator_integrate_action(void)
{
    const dal_action_form form = DAL_ACTION_SECOND_ORDER;
    dal_action action;
    REFUSED(dal_evaluator_integrate_action(NULL, &curve, form, &action, error));
    REFUSED(dal_evaluator_integrate_action(evaluator, NULL, form, &action, error));
    REFUSED(dal_evaluator_integrate_action(evaluator, &curve, form, NULL, error));
    REFUSED(dal_evaluator_integrate_action(evaluator, &curve, DAL_ACTIONS, &action, error));
    REFUSED(
        dal_evaluator_integrate_action(evaluator, &(dal_curve){.rows = 7}, form, &action, error));
}

static void null_dal_evaluator_measure_curve(void)
{
    double D;
    REFUSED(dal_evaluator_measure_curve(NULL, &curve, &D, error));
    REFUSED(dal_evaluator_measure_curve(evaluator, NULL, &D, error));
    REFUSED(dal_evaluator_measure_curve(evaluator, &curve, NULL, error));
}

static void null_dal_curve_step(void)
{
    CU_ASSERT_EQUAL(dal_curve_step(NULL), 0.0);
    CU_ASSERT_EQUAL(dal_curve_step(&(dal_curve){.rows = 7}), 0.0);
    CU_ASSERT_EQUAL(dal_curve_step(&(dal_curve){.rows = 1, .t = curve_t}), 0.0);
    CU_ASSERT_EQUAL(dal_curve_step(&curve), 1.0);
}

static void null_dal_check_discrete_action(void)
{
    dal_discrete_action action;
    REFUSED(dal_check_discrete_action(NULL, &curve, &action, error));
    REFUSED(dal_check_discrete_action(&(dal_run_spec){.system = NULL}, &curve, &action, error));
    REFUSED(dal_check_discrete_action(&spec, NULL, &action, error));
    REFUSED(dal_check_discrete_action(&spec, &curve, NULL, error));
}

static void null_dal_evaluator_measure_action(void)
{
    double action;
    REFUSED_STATUS(dal_evaluator_measure_action(NULL, 0.0, 0.1, 10, numbers, 1.0, &action));
    REFUSED_STATUS(dal_evaluator_measure_action(evaluator, 0.0, 0.1, -1, numbers, 1.0, &action));
    REFUSED_STATUS(dal_evaluator_measure_action(evaluator, 0.0, 0.1, 10, NULL, 1.0, &action));
    REFUSED_STATUS(dal_evaluator_measure_action(evaluator, 0.0, 0.1, 10, numbers, 1.0, NULL));
}

static void null_dal_evaluator_check_stationarity(void)
{
    double defect;
    REFUSED_STATUS(dal_evaluator_check_stationarity(NULL, 0.0, 0.1, 10, numbers, &defect));
    REFUSED_STATUS(dal_evaluator_check_stationarity(evaluator, 0.0, 0.1, -1, numbers, &defect));
    REFUSED_STATUS(dal_evaluator_check_stationarity(evaluator, 0.0, 0.1, 10, NULL, &defect));
    REFUSED_STATUS(dal_evaluator_check_stationarity(evaluator, 0.0, 0.1, 10, numbers, NULL));
}

static double first(void *user, const double *z) { return user ? NAN : z[0]; }

static void null_dal_measure_gradient(void)
{
    double z = 1.0, gradient = 7.0;
    dal_measure_gradient(NULL, NULL, 1, &z, &gradient);
    dal_measure_gradient(first, NULL, 1, NULL, &gradient);
    dal_measure_gradient(first, NULL, 1, &z, NULL);
    dal_measure_gradient(first, NULL, -1, &z, &gradient);
    CU_ASSERT(z == 1.0 && gradient == 7.0);
}

static void null_dal_poisson(void)
{
    CU_ASSERT(isnan(dal_poisson(NULL, numbers, 1)) && isnan(dal_poisson(numbers, NULL, 1)));
    CU_ASSERT(isnan(dal_poisson(numbers, numbers, -1)));
}

static void null_dal_prediction_end_name(void)
{
    CU_ASSERT_STRING_EQUAL(dal_prediction_end_name((dal_prediction_end)-1), "?");
}

static void null_dal_prediction_end_text(void)
{
    CU_ASSERT_STRING_EQUAL(dal_prediction_end_text((dal_prediction_end)-1), "?");
}

static void null_dal_predict_settings_default(void)
{
    const dal_predict_settings settings = dal_predict_settings_default();
    CU_ASSERT(settings.pieces == 0 && settings.rows == 200);
}

static void null_dal_predict_create(void)
{
    dal_prediction *p = NULL;
    dal_predict_settings settings = dal_predict_settings_default();
    const double T = spec.options.step;
    REFUSED(dal_predict_create(NULL, &spec, T, NULL, NULL, error));
    REFUSED(dal_predict_create(&p, NULL, T, NULL, NULL, error));
    REFUSED(dal_predict_create(&p, &(dal_run_spec){.system = NULL}, T, NULL, NULL, error));
    settings.rows = 0;
    REFUSED(dal_predict_create(&p, &spec, T, &settings, NULL, error));
    settings = (dal_predict_settings){.pieces = -1, .rows = 1};
    REFUSED(dal_predict_create(&p, &spec, T, &settings, NULL, error));
    settings = (dal_predict_settings){.quad_steps = -1, .rows = 1};
    REFUSED(dal_predict_create(&p, &spec, T, &settings, NULL, error));
    CU_ASSERT_PTR_NULL(p);
}

static void null_dal_exact_motion_create(void)
{
    dal_exact_motion *motion = NULL;
    REFUSED(dal_exact_motion_create(NULL, &spec, 0, error));
    REFUSED(dal_exact_motion_create(&motion, NULL, 0, error));
    REFUSED(dal_exact_motion_create(&motion, &(dal_run_spec){.system = NULL}, 0, error));
    CU_ASSERT_PTR_NULL(motion);
}

static void null_dal_exact_motion_extend(void)
{
    dal_exact_motion *motion = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_exact_motion_create(&motion, &spec, 0, NULL), DAL_STATUS_OK);
    REFUSED(dal_exact_motion_extend(NULL, 1.0, NULL, error));
    REFUSED(dal_exact_motion_extend(motion, NAN, NULL, error));
    dal_exact_motion_free(motion);
}

static void null_dal_exact_motion_free(void) { dal_exact_motion_free(NULL); }

static void null_dal_prediction_free(void) { dal_prediction_free(NULL); }

/* ---- invariants ---- */

static void null_dal_invariants_settings_default(void)
{
    const dal_invariants_settings settings = dal_invariants_settings_default();
    CU_ASSERT(settings.degree == 2 && settings.with_count == 0 && !settings.measures);
}

static void null_dal_find_invariants(void)
{
    dal_invariants *found = NULL;
    dal_invariants_settings settings = dal_invariants_settings_default();
    dal_run_spec bad_count = spec;
    bad_count.parameter_count = -1;
    REFUSED(dal_find_invariants(&found, model, &bad_count, NULL, error));
    REFUSED(dal_find_invariants(&found, model, NULL, NULL, error));
    REFUSED(dal_find_invariants(&found, model, &(dal_run_spec){.system = NULL}, NULL, error));
    REFUSED(dal_find_invariants(NULL, model, &spec, NULL, error));
    REFUSED(dal_find_invariants(&found, NULL, &spec, NULL, error));
    settings.with_count = -1;
    REFUSED(dal_find_invariants(&found, model, &spec, &settings, error));
    settings.with_count = 1;
    REFUSED(dal_find_invariants(&found, model, &spec, &settings, error));
    CU_ASSERT_PTR_NULL(found);
}

static void null_dal_invariants_free(void) { dal_invariants_free(NULL); }

/* What the program alone uses. */
static void test_program(void)
{
    const char *const names[] = {"a", NULL};
    CU_ASSERT_PTR_NULL(dal__nearest_name(NULL, names, 2));
    CU_ASSERT_PTR_NULL(dal__nearest_name("a", NULL, 2));
    CU_ASSERT_PTR_NULL(dal__nearest_name("a", names, -1));
    CU_ASSERT_PTR_EQUAL(dal__nearest_name("a", names, 2), names[0]);
    REFUSED_STATUS(dal__parse_number(NULL, 1, numbers));
    REFUSED_STATUS(dal__parse_number("1", 1, NULL));
    CU_ASSERT_EQUAL(dal__format_number(NULL, 1.0), 0);
    CU_ASSERT_EQUAL(dal__random_key(NULL, 3), dal__random_key("", 3));
    CU_ASSERT_EQUAL(dal__add_products(1, NULL, numbers, 1, numbers), 0);
    CU_ASSERT_EQUAL(dal__add_products(1, numbers, NULL, 1, numbers), 0);
    CU_ASSERT_EQUAL(dal__add_products(1, numbers, numbers, 1, NULL), 0);
    CU_ASSERT_EQUAL(dal__add_products(1, numbers, numbers, -1, numbers), 0);
}

void suite_null_action(void)
{
    CU_pSuite suite = CU_add_suite("NULL and missing rows: actions", open_objects, close_objects);
    FUNCTIONS_dalembert_action(ADD_NULL_TEST) FUNCTIONS_dalembert_predict(ADD_NULL_TEST)
        FUNCTIONS_dalembert_invariants(ADD_NULL_TEST)
            CU_add_test(suite, "what the program alone uses", test_program);
}
