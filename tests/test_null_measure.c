/* test_null_measure.c - NULL, nameless settings and negative counts, given to measures. */
#include "dalembert_analysis.h"
#include "null.h"

/* What dalembert_analysis.h includes, without invariants (test_null_action.c). */
#define FUNCTIONS_OF_MEASURES(X)                                                                   \
    FUNCTIONS_dalembert_statistics(X) FUNCTIONS_dalembert_evaluator(X)                             \
        FUNCTIONS_dalembert_order(X) FUNCTIONS_dalembert_dirac(X) FUNCTIONS_dalembert_budget(X)    \
            FUNCTIONS_dalembert_dynamics(X)
FUNCTIONS_OF_MEASURES(DECLARE_NULL_TEST)

/* ---- what the functions are given where they are given anything ---- */

static dal_model *model;
static const dal_system *system, *tangent;
static dal_run_spec spec, no_system, bad_count;
static dal_run *run;
static dal_evaluator *evaluator;
static dal_lyapunov *lyapunov;
static dal_error_budget *budget;
static dal_point at;
static double numbers[256];

static int open_objects(void)
{
    if (open_spec(&model, &spec) != DAL_STATUS_OK) return 1;
    system = spec.system;
    no_system = bad_count = spec;
    no_system.system = NULL;
    bad_count.parameter_count = -1;
    at = (dal_point){.t = 0.0, .q = numbers, .v = numbers + system->n};
    return dal_run_create(&run, &spec, NULL) != DAL_STATUS_OK ||
           dal_evaluator_create(&evaluator, system, NULL, 0, NULL) != DAL_STATUS_OK ||
           dal_model_tangent(model, &tangent, NULL) != DAL_STATUS_OK ||
           dal_lyapunov_create(&lyapunov, &spec, NULL, 1, NULL) != DAL_STATUS_OK ||
           dal_error_budget_create(&budget, &spec, 10, 0, NULL, NULL) != DAL_STATUS_OK;
}

static int close_objects(void)
{
    dal_error_budget_free(budget);
    dal_lyapunov_free(lyapunov);
    dal_evaluator_free(evaluator);
    dal_run_free(run);
    dal_model_free(model);
    return 0;
}

/* A call with a spec in every bad form. */
#define REFUSED_SPECS(bad, call)                                                                   \
    do {                                                                                           \
        const dal_run_spec *const bad_specs[] = {NULL, &no_system, &bad_count};                    \
        for (int bad_number = 0; bad_number < 3; bad_number++) {                                   \
            const dal_run_spec *bad = bad_specs[bad_number];                                       \
            REFUSED(call);                                                                         \
        }                                                                                          \
    } while (0)

/* A call with a point in every bad form. */
#define REFUSED_POINTS(bad, call)                                                                  \
    do {                                                                                           \
        const dal_point no_q = {.t = 0.0, .q = NULL, .v = at.v},                                   \
                        no_v = {.t = 0.0, .q = at.q, .v = NULL};                                   \
        const dal_point *const bad_points[] = {NULL, &no_q, &no_v};                                \
        for (int bad_number = 0; bad_number < 3; bad_number++) {                                   \
            const dal_point *bad = bad_points[bad_number];                                         \
            REFUSED_STATUS(call);                                                                  \
        }                                                                                          \
    } while (0)

/* ---- evaluators ---- */

static void null_dal_model_branches(void)
{
    dal_model *made = dal_model_create("made");
    dal_branch branch;
    int count;
    REFUSED_STATUS(dal_model_branches(NULL, &branch, 1, &count));
    REFUSED_STATUS(dal_model_branches(made, &branch, 1, &count)); /* it has no system yet */
    REFUSED_STATUS(dal_model_branches(model, NULL, 1, &count));
    REFUSED_STATUS(dal_model_branches(model, &branch, 1, NULL));
    dal_model_free(made);
}

static void null_dal_jumps_create(void)
{
    dal_model *made = dal_model_create("made");
    dal_jumps *jumps;
    REFUSED_STATUS(dal_jumps_create(NULL, model));
    REFUSED_STATUS(dal_jumps_create(&jumps, NULL));
    REFUSED_STATUS(dal_jumps_create(&jumps, made)); /* it has no system yet */
    dal_model_free(made);
}

static void null_dal_jumps_free(void) { dal_jumps_free(NULL); }

static void null_dal_jumps_count(void) { CU_ASSERT_EQUAL(dal_jumps_count(NULL), 0); }

static void null_dal_jumps_passed(void)
{
    dal_jumps *jumps = NULL;
    CU_ASSERT_EQUAL(dal_jumps_create(&jumps, model), DAL_STATUS_OK);
    CU_ASSERT_PTR_NULL(dal_jumps_passed(NULL, run));
    CU_ASSERT_PTR_NULL(dal_jumps_passed(jumps, NULL));
    dal_jumps_free(jumps);
}

static void null_dal_evaluator_create(void)
{
    dal_evaluator *made = evaluator;
    REFUSED(dal_evaluator_create(NULL, system, NULL, 0, error));
    REFUSED(dal_evaluator_create(&made, NULL, NULL, 0, error));
    REFUSED(dal_evaluator_create(&made, system, COUNT_NEGATIVE, error));
    REFUSED(dal_evaluator_create(&made, system, SETTINGS_MISSING, error));
    REFUSED(dal_evaluator_create(&made, system, NAME_MISSING, error));
    CU_ASSERT_PTR_NULL(made);
}

static void null_dal_evaluator_free(void) { dal_evaluator_free(NULL); }
static void null_dal_evaluator_system(void) { CU_ASSERT_PTR_NULL(dal_evaluator_system(NULL)); }

static void null_dal_evaluator_call(void)
{
    dal_callback *field = system->call.field, *adjoint = system->call.adjoint;
    REFUSED_STATUS(dal_evaluator_call(NULL, field, 0.0, at.q, at.v, NULL, numbers));
    REFUSED_STATUS(dal_evaluator_call(evaluator, field, 0.0, NULL, at.v, NULL, numbers));
    REFUSED_STATUS(dal_evaluator_call(evaluator, field, 0.0, at.q, NULL, NULL, numbers));
    REFUSED_STATUS(dal_evaluator_call(evaluator, field, 0.0, at.q, at.v, NULL, NULL));
    REFUSED_STATUS(dal_evaluator_call(evaluator, adjoint, 0.0, at.q, at.v, NULL, numbers));
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, NULL, 0.0, at.q, at.v, NULL, numbers),
                    DAL_STATUS_UNSUPPORTED);
}

static void null_dal_evaluator_start(void)
{
    REFUSED(dal_evaluator_start(NULL, NULL, 0, numbers, error));
    REFUSED(dal_evaluator_start(evaluator, NULL, 0, NULL, error));
    REFUSED(dal_evaluator_start(evaluator, COUNT_NEGATIVE, numbers, error));
    REFUSED(dal_evaluator_start(evaluator, SETTINGS_MISSING, numbers, error));
    REFUSED(dal_evaluator_start(evaluator, NAME_MISSING, numbers, error));
}

static void null_dal_evaluator_start_at(void)
{
    REFUSED(dal_evaluator_start_at(NULL, 0.0, NULL, 0, numbers, error));
    REFUSED(dal_evaluator_start_at(evaluator, 0.0, NULL, 0, NULL, error));
    REFUSED(dal_evaluator_start_at(evaluator, 0.0, COUNT_NEGATIVE, numbers, error));
    REFUSED(dal_evaluator_start_at(evaluator, 0.0, SETTINGS_MISSING, numbers, error));
    REFUSED(dal_evaluator_start_at(evaluator, 0.0, NAME_MISSING, numbers, error));
}

/* ---- measures of a system ---- */

static void null_dal_evaluator_measure_rate(void)
{
    dal_callback *field = system->call.field;
    REFUSED_STATUS(dal_evaluator_measure_rate(NULL, field, 1, &at, numbers));
    REFUSED_STATUS(dal_evaluator_measure_rate(evaluator, field, -1, &at, numbers));
    REFUSED_POINTS(bad, dal_evaluator_measure_rate(evaluator, field, 1, bad, numbers));
    REFUSED_STATUS(dal_evaluator_measure_rate(evaluator, field, 1, &at, NULL));
}

static void null_dal_evaluator_check_derivatives(void)
{
    dal_derivatives out;
    REFUSED_STATUS(dal_evaluator_check_derivatives(NULL, &at, &out));
    REFUSED_POINTS(bad, dal_evaluator_check_derivatives(evaluator, bad, &out));
    REFUSED_STATUS(dal_evaluator_check_derivatives(evaluator, &at, NULL));
}

static void null_dal_evaluator_measure_rank(void)
{
    int rank;
    double pivot;
    REFUSED_STATUS(dal_evaluator_measure_rank(NULL, &at, &rank, &pivot));
    REFUSED_POINTS(bad, dal_evaluator_measure_rank(evaluator, bad, &rank, &pivot));
    REFUSED_STATUS(dal_evaluator_measure_rank(evaluator, &at, NULL, &pivot));
    REFUSED_STATUS(dal_evaluator_measure_rank(evaluator, &at, &rank, NULL));
}

static void null_dal_evaluator_project_position(void)
{
    REFUSED_STATUS(dal_evaluator_project_position(NULL, 0.0, numbers, numbers + 8));
    REFUSED_STATUS(dal_evaluator_project_position(evaluator, 0.0, NULL, numbers + 8));
    REFUSED_STATUS(dal_evaluator_project_position(evaluator, 0.0, numbers, NULL));
}

static void null_dal_evaluator_project_velocity(void)
{
    REFUSED_STATUS(dal_evaluator_project_velocity(NULL, 0.0, numbers, numbers + 8));
    REFUSED_STATUS(dal_evaluator_project_velocity(evaluator, 0.0, NULL, numbers + 8));
    REFUSED_STATUS(dal_evaluator_project_velocity(evaluator, 0.0, numbers, NULL));
}

static void null_dal_evaluator_classify_constraints(void)
{
    dal_constraint_class out;
    REFUSED_STATUS(dal_evaluator_classify_constraints(NULL, &at, &out, NULL));
    REFUSED_POINTS(bad, dal_evaluator_classify_constraints(evaluator, bad, &out, NULL));
    REFUSED_STATUS(dal_evaluator_classify_constraints(evaluator, &at, NULL, NULL));
    CU_ASSERT_EQUAL(dal_evaluator_classify_constraints(evaluator, &at, &out, NULL), DAL_STATUS_OK);
}

/* ---- measures of a method ---- */

static void null_dal_order_slopes(void) { dal_order_slopes(NULL, 0.0); }
static void null_dal_whole_steps(void)
{
    CU_ASSERT_EQUAL(dal_whole_steps(NAN, 1.0, 0.1), 0);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, NAN, 0.1), 0);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, 1.0, NAN), 0);
}

static dal_status interrupts(void *user, dal_run *stepped)
{
    return dal_run_steps(stepped) > 0 && ++*(int *)user > 2 ? DAL_STATUS_INTERRUPTED
                                                            : DAL_STATUS_OK;
}

static void null_dal_order_measure(void)
{
    dal_order order;
    int polls = 0;
    const dal_observer observer = {.user = &polls, .poll = interrupts}, nobody = {.poll = NULL};
    REFUSED_SPECS(bad, dal_order_measure(&order, bad, 1.0, 2, NULL, NULL, &nobody, error));
    REFUSED(dal_order_measure(NULL, &spec, 1.0, 2, NULL, NULL, &nobody, error));
    REFUSED(dal_order_measure(&order, &spec, 1.0, -1, NULL, NULL, NULL, error));
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 1.0, 2, NULL, NULL, NULL, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 1.0, 2, NULL, NULL, &nobody, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 100.0, 2, NULL, NULL, &observer, NULL),
                    DAL_STATUS_INTERRUPTED);
    CU_ASSERT_EQUAL(polls, 3);
}

static void null_dal_check_symplecticity(void)
{
    double defect;
    REFUSED_SPECS(bad, dal_check_symplecticity(bad, 0.0, NULL, 0.0, &defect, error));
    REFUSED(dal_check_symplecticity(&spec, 0.0, NULL, 0.0, NULL, error));
}

static void null_dal_check_reversibility(void)
{
    double defect;
    REFUSED_SPECS(bad, dal_check_reversibility(bad, 0.0, NULL, &defect, error));
    REFUSED(dal_check_reversibility(&spec, 0.0, NULL, NULL, error));
}

static void null_dal_adjoint_pairing(void)
{
    dal_statistics s;
    REFUSED_SPECS(bad, dal_adjoint_pairing(bad, tangent, numbers, 1, &s, error));
    REFUSED(dal_adjoint_pairing(&spec, NULL, numbers, 1, &s, error));
    REFUSED(dal_adjoint_pairing(&spec, system, numbers, 1, &s, error)); /* not of 2n coordinates */
    REFUSED(dal_adjoint_pairing(&spec, tangent, NULL, 1, &s, error));
    REFUSED(dal_adjoint_pairing(&spec, tangent, numbers, -1, &s, error));
    REFUSED(dal_adjoint_pairing(&spec, tangent, numbers, 1, NULL, error));
    const double none[] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    CU_ASSERT_EQUAL(dal_adjoint_pairing(&spec, tangent, none, 1, &s, NULL), DAL_STATUS_NOT_FINITE);
}

/* ---- Dirac's procedure ---- */

static void null_dal_dirac_free(void) { dal_dirac_free(NULL); }
static void null_dal_dirac_outcome_name(void) { CU_ASSERT(*dal_dirac_outcome_name(-1) == '?'); }
static void null_dal_dirac_create(void)
{
    dal_dirac *dirac;
    REFUSED(dal_dirac_create(NULL, model, &spec, error));
    REFUSED(dal_dirac_create(&dirac, NULL, &spec, error));
    REFUSED(dal_dirac_create(&dirac, model, NULL, error));
}

/* ---- what a drift comes from ---- */

static void null_dal_comparison_name(void)
{
    CU_ASSERT_STRING_EQUAL(dal_comparison_name((dal_comparison_run)-1), "?");
}
static void null_dal_comparison_text(void)
{
    CU_ASSERT_STRING_EQUAL(dal_comparison_text((dal_comparison_run)-1), "?");
}

static void null_dal_error_source_name(void)
{
    CU_ASSERT_STRING_EQUAL(dal_error_source_name((dal_error_source)-1), "?");
}

static void null_dal_error_budget_create(void)
{
    dal_error_budget *made = budget;
    REFUSED_SPECS(bad, dal_error_budget_create(&made, bad, 10, 0, NULL, error));
    CU_ASSERT_PTR_NULL(made);
    REFUSED(dal_error_budget_create(&made, &spec, -1, 0, NULL, error));
    REFUSED(dal_error_budget_create(&made, &spec, 10, -1, NULL, error));
    REFUSED(dal_error_budget_create(NULL, &spec, 10, 0, NULL, error));
}

static void null_dal_error_budget_free(void) { dal_error_budget_free(NULL); }

static void null_dal_error_budget_summarise(void)
{
    char buffer[64] = "as before";
    const int count = budget->observables;
    CU_ASSERT_PTR_NULL(dal_error_budget_summarise(NULL, 0, buffer, sizeof buffer));
    CU_ASSERT_PTR_NULL(dal_error_budget_summarise(budget, 0, NULL, sizeof buffer));
    CU_ASSERT_PTR_NULL(dal_error_budget_summarise(budget, -1, buffer, sizeof buffer));
    CU_ASSERT_PTR_NULL(dal_error_budget_summarise(budget, count, buffer, sizeof buffer));
    CU_ASSERT_STRING_EQUAL(buffer, "as before");
}

static void null_dal_error_budget_describe(void)
{
    char buffer[DAL_MESSAGE_SIZE];
    const int count = budget->observables;
    CU_ASSERT_PTR_NULL(
        dal_error_budget_describe(NULL, 0, DAL_SOURCE_SOLVER, buffer, sizeof buffer));
    CU_ASSERT_PTR_NULL(
        dal_error_budget_describe(budget, 0, DAL_SOURCE_SOLVER, NULL, sizeof buffer));
    CU_ASSERT_PTR_NULL(
        dal_error_budget_describe(budget, -1, DAL_SOURCE_SOLVER, buffer, sizeof buffer));
    CU_ASSERT_PTR_NULL(
        dal_error_budget_describe(budget, count, DAL_SOURCE_SOLVER, buffer, sizeof buffer));
}

/* ---- trends ---- */

static void null_dal_statistics_rate_range(void)
{
    CU_ASSERT(isnan(dal_statistics_rate_range(NULL)));
}

static void null_dal_statistics_max_abs(void) { CU_ASSERT(isnan(dal_statistics_max_abs(NULL))); }

static void null_dal_statistics_deviation(void)
{
    CU_ASSERT(isnan(dal_statistics_deviation(NULL)));
}

static void null_dal_statistics_start(void)
{
    dal_statistics s = {.count = -7};
    dal_statistics_start(NULL, 1);
    dal_statistics_start(&s, -1);
    CU_ASSERT_EQUAL(s.count, -7);
}

static void null_dal_statistics_classify(void)
{
    dal_statistics s;
    dal_trend trend = {.count = -7};
    dal_statistics_start(&s, 1);
    dal_statistics_classify(NULL, 1.0, DAL_STATUS_OK, &trend);
    dal_statistics_classify(&s, 1.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL(trend.count, -7);
}

static void null_dal_statistics_add(void)
{
    dal_statistics s;
    const double x = 1.0;
    dal_statistics_start(&s, 1);
    dal_statistics_add(NULL, 1, 0.0, &x);
    dal_statistics_add(&s, 1, 0.0, NULL);
    dal_statistics_add(&s, -1, 0.0, &x);
    CU_ASSERT_EQUAL(s.count, 0);
}

static void null_dal_statistics_add_many(void)
{
    dal_statistics s;
    const double t[2] = {0.0, 1.0}, x[2] = {1.0, 2.0};
    dal_statistics_start(&s, 1);
    dal_statistics_add_many(NULL, 1, 2, t, x, 2);
    dal_statistics_add_many(&s, 1, 2, NULL, x, 2);
    dal_statistics_add_many(&s, 1, 2, t, NULL, 2);
    dal_statistics_add_many(&s, -1, 2, t, x, 2);
    dal_statistics_add_many(&s, 1, -2, t, x, 2);
    CU_ASSERT_EQUAL(s.count, 0);
}

static void null_dal_size_text(void)
{
    CU_ASSERT_STRING_EQUAL(dal_size_text((dal_size_class)-1), "?");
}

static void null_dal_trend_text(void)
{
    CU_ASSERT_STRING_EQUAL(dal_trend_text((dal_trend_class)-1), "?");
}

static void null_dal_conservation_text(void)
{
    CU_ASSERT_STRING_EQUAL(dal_conservation_text((dal_conservation)-1), "?");
}

static void null_dal_statistics_add_scales(void)
{
    dal_statistics s;
    const double scale = 2.0;
    dal_statistics_start(&s, 1);
    dal_statistics_add_scales(NULL, 1, &scale);
    dal_statistics_add_scales(&s, 1, NULL);
    dal_statistics_add_scales(&s, -1, &scale);
    CU_ASSERT_EQUAL(s.scale, 0.0);
}

static void null_dal_evaluator_scales(void)
{
    const double x[8] = {0.0};
    double out[8];
    CU_ASSERT_EQUAL(dal_evaluator_scales(NULL, 0.0, x, x, out), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_evaluator_scales(evaluator, 0.0, NULL, x, out), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_evaluator_scales(evaluator, 0.0, x, NULL, out), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_evaluator_scales(evaluator, 0.0, x, x, NULL), DAL_STATUS_ARGUMENT);
}

static void null_dal_scaled_create(void)
{
    dal_scaled *scaled;
    CU_ASSERT_EQUAL(dal_scaled_create(NULL, &(dal_run_spec){0}, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_scaled_create(&scaled, NULL, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_scaled_create(&scaled, &(dal_run_spec){0}, NULL), DAL_STATUS_ARGUMENT);
}

static void null_dal_scaled_create_at(void)
{
    dal_scaled *scaled;
    CU_ASSERT_EQUAL(dal_scaled_create_at(NULL, run, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_scaled_create_at(&scaled, NULL, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NULL(scaled);
}

static void null_dal_scaled_free(void) { dal_scaled_free(NULL); }
static void null_dal_scaled_system(void) { CU_ASSERT_PTR_NULL(dal_scaled_system(NULL)); }
static void null_dal_scaled_units(void) { CU_ASSERT_PTR_NULL(dal_scaled_units(NULL)); }

static void null_dal_run_classify(void)
{
    dal_statistics statistics[16];
    dal_trend trend[16] = {{.count = -7}};
    dal_statistics_start(statistics, 16);
    dal_run_classify(NULL, statistics, DAL_STATUS_OK, trend);
    dal_run_classify(run, NULL, DAL_STATUS_OK, trend);
    dal_run_classify(run, statistics, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL(trend[0].count, -7);
}

/* ---- motions ---- */

static int is_nan(const dal_average *a)
{
    return isnan(a->mean) && isnan(a->low) && isnan(a->high);
}

static void null_dal_statistics_mean(void)
{
    dal_average average = {0.0, 0.0, 0.0};
    dal_statistics_mean(NULL, &average);
    CU_ASSERT(is_nan(&average));
    dal_statistics_mean(&(dal_statistics){0}, NULL);
}

static void null_dal_lyapunov_create(void)
{
    dal_lyapunov *made = lyapunov;
    REFUSED_SPECS(bad, dal_lyapunov_create(&made, bad, NULL, 0, error));
    CU_ASSERT_PTR_NULL(made);
    REFUSED(dal_lyapunov_create(NULL, &spec, NULL, 0, error));
    REFUSED(dal_lyapunov_create(&made, &spec, NULL, -1, error));
    REFUSED(dal_lyapunov_create(&made, &spec, system, 0, error)); /* not of 2n coordinates */
}

static void null_dal_lyapunov_create_lifted(void)
{
    dal_lyapunov *made = lyapunov;
    REFUSED_SPECS(bad, dal_lyapunov_create_lifted(&made, bad, NULL, 0, error));
    CU_ASSERT_PTR_NULL(made);
    REFUSED(dal_lyapunov_create_lifted(NULL, &spec, NULL, 0, error));
    REFUSED(dal_lyapunov_create_lifted(&made, &spec, NULL, -1, error));
    REFUSED(dal_lyapunov_create_lifted(&made, &spec, system, 0, error)); /* not of 2n */
}

static void null_dal_lyapunov_free(void) { dal_lyapunov_free(NULL); }

static void null_dal_lyapunov_advance(void)
{
    REFUSED(dal_lyapunov_advance(NULL, 1, error));
    REFUSED(dal_lyapunov_advance(lyapunov, -1, error));
}

static void null_dal_lyapunov_discard_transient(void) { dal_lyapunov_discard_transient(NULL); }
static void null_dal_lyapunov_run(void) { CU_ASSERT_PTR_NULL(dal_lyapunov_run(NULL)); }
static void null_dal_lyapunov_count(void) { CU_ASSERT_EQUAL(dal_lyapunov_count(NULL), 0); }
static void null_dal_lyapunov_is_exact(void) { CU_ASSERT_EQUAL(dal_lyapunov_is_exact(NULL), 0); }
static void null_dal_lyapunov_is_whole(void) { CU_ASSERT_EQUAL(dal_lyapunov_is_whole(NULL), 0); }

static void null_dal_lyapunov_time_unit(void)
{
    CU_ASSERT(isnan(dal_lyapunov_time_unit(NULL)));
    CU_ASSERT(dal_lyapunov_time_unit(lyapunov) > 0.0);
}

static void null_dal_lyapunov_exponent(void)
{
    for (int k = 0; k < 3; k++) {
        dal_average average = {0.0, 0.0, 0.0};
        dal_lyapunov_exponent(k ? lyapunov : NULL, k == 1 ? -1 : k == 2 ? 1 : 0, &average);
        CU_ASSERT(is_nan(&average));
    }
    dal_lyapunov_exponent(lyapunov, 0, NULL);
}

static void null_dal_lyapunov_sum(void)
{
    dal_average average = {0.0, 0.0, 0.0};
    dal_lyapunov_sum(NULL, &average);
    CU_ASSERT(is_nan(&average));
    dal_lyapunov_sum(lyapunov, NULL);
}

static void null_dal_lyapunov_balance(void)
{
    dal_balance balance;
    REFUSED(dal_lyapunov_balance(NULL, &balance, error));
    REFUSED(dal_lyapunov_balance(lyapunov, NULL, error));
}

static void null_dal_lyapunov_divergence(void)
{
    dal_average average = {0.0, 0.0, 0.0};
    dal_lyapunov_divergence(NULL, &average);
    CU_ASSERT(is_nan(&average));
    dal_lyapunov_divergence(lyapunov, NULL);
}

static void null_dal_run_crossings(void)
{
    dal_crossings found;
    dal_poincare section = {.callback = system->energy, .count = 1};
    REFUSED(dal_run_crossings(NULL, 1.0, &section, &found, error));
    REFUSED(dal_run_crossings(run, 1.0, NULL, &found, error));
    REFUSED(dal_run_crossings(run, 1.0, &section, NULL, error));
    section.index = -1;
    REFUSED(dal_run_crossings(run, 1.0, &section, &found, error));
    section = (dal_poincare){.callback = system->energy, .count = -1};
    REFUSED(dal_run_crossings(run, 1.0, &section, &found, error));
    section = (dal_poincare){.count = 1};
    REFUSED(dal_run_crossings(run, 1.0, &section, &found, error));
}

void suite_null_measure(void)
{
    CU_pSuite suite =
        CU_add_suite("NULL and negative counts: measures", open_objects, close_objects);
    FUNCTIONS_OF_MEASURES(ADD_NULL_TEST)
}
