/* fixtures.c - systems and runs the suites share. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char fixture_full[] =
    "title: full fixture\n"
    "coordinates: [x, y, z, u]\n"
    "parameters: {a: 0.3, b: 0.2}\n"
    "lagrangian: >-\n"
    "  (2 + cos(y))/2*x'^2 + (3 + x^2/4)/2*y'^2 + (1.5 + 0.2*sin(x))/2*z'^2 + (2 + "
    "0.1*z^2)/2*u'^2\n"
    "  + a*x'*y'*cos(z) + b*z'*u'*sin(y) + 0.15*x'*u' + 0.2*y*x'\n"
    "  - (x^2 + 1.5*y^2 + z^2*y^2/2 + cos(u)) + 0.3*x*sin(t)\n"
    "forces:\n"
    "  x: -0.1*x' + 0.2*sin(2*t)\n"
    "  y: 0.3*x'*z\n"
    "  u: -0.2*u'*(1 + x^2) + 0.1*t\n"
    "constraints:\n"
    "  - z' - y*x' - 0.1*sin(t)\n"
    "  - (u'^2 - x'^2 - y'^2)/2 + 0.1*x*x'\n"
    "start: {x: 0, y: 0.5, z: 0.3, u: 0.2, x': 0.6, y': 0.8, z': 0.3, u': 1}\n"
    "gauge: {e: 1.5, mu_e: 0.2*cos(t)}\n";

const char fixture_gentle[] = "coordinates: [x, y, z, u]\n"
                              "lagrangian: >-\n"
                              "  (1 + 0.002*y)/2*x'^2 + (1.2 + 0.003*x)/2*y'^2 + (1.1 + "
                              "0.002*u)/2*z'^2 + (1 + 0.001*z)/2*u'^2\n"
                              "  + 0.2*x'*y' + (0.1 + 0.002*y)*z'*u' + 0.15*x'*u'\n"
                              "  - (x^2 + 1.1*y^2 + 0.9*z^2 + u^2)/2 + 0.1*x*sin(0.7*t)\n"
                              "forces: {x: -0.01*x' + 0.05*sin(t), y: 0.02*z', u: -0.01*u'}\n"
                              "constraints:\n"
                              "  - z' - 0.3*x' - 0.01*y*x' - 0.01*sin(t)\n"
                              "  - u' - 0.5*y' + 0.003*x*y' + 0.002*x'*y'\n"
                              "start: {x: 1, y: 0.5, z: 0.3, u: 0.2}\n"
                              "gauge: {e: 1.5, mu_e: 0.02*cos(t)}\n";

const char fixture_constant[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + 2*y^2 + 3*z^2 + x^2*z^2)/2\n"
    "constraints: [x' + 2*y' - z' + 0.3*x]\n"
    "start: {x: 0.5, y: 0.3, z: -0.2, x': 0.35, y': -0.1, z': 0.3}\n";

const char fixture_bilinear[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + y^2 + z^2 + 0.3*x^2*z^2)/2\n"
    "constraints: [x' + y*z']\n"
    "start: {x: 0.8, y: 0.6, z: -0.5, x': -0.24, y': 0.7, z': 0.4}\n";

const char fixture_quadratic[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + 1.7*y^2 + 0.6*z^2)/2\n"
    "constraints: [(x'^2 + y'^2 + z'^2 + 0.1*x^2 - 1)/2]\n"
    "start: {x: 0, y: 0.3, z: 0.5, x': 0.6, y': 0, z': 0.8}\n";

/* The models that were made so far, a list. */
typedef struct fixture {
    struct fixture *next;
    dal_model *model;
    char text[];
} fixture;
static fixture *fixtures;

static void require(dal_status status, const dal_error *error)
{
    if (status != DAL_STATUS_OK)
        printf("\n  %d:%d: %s\n", error->line, error->column, error->message);
    CU_ASSERT_EQUAL_FATAL(status, DAL_STATUS_OK);
}

dal_model *fixture_model(const char *text)
{
    dal_model *model = NULL;
    dal_error error = {0};
    require(strchr(text, '\n') ? dal_model_read(&model, "fixture", text, strlen(text), &error)
                               : dal_model_builtin(&model, text, &error),
            &error);
    return model;
}

static dal_model *model_of(const char *text)
{
    for (const fixture *f = fixtures; f; f = f->next)
        if (strcmp(f->text, text) == 0) return f->model;
    const size_t length = strlen(text);
    fixture *made = calloc(1, sizeof *made + length + 1);
    CU_ASSERT_PTR_NOT_NULL_FATAL(made);
    made->model = fixture_model(text);
    memcpy(made->text, text, length);
    made->next = fixtures;
    fixtures = made;
    return made->model;
}

const dal_system *fixture_system(const char *text)
{
    const dal_system *system = NULL;
    dal_error error = {0};
    require(dal_model_system(model_of(text), &system, &error), &error);
    return system;
}

const dal_system *fixture_tangent(const char *text)
{
    const dal_system *tangent = NULL;
    dal_error error = {0};
    require(dal_model_tangent(model_of(text), &tangent, &error), &error);
    return tangent;
}

void fixture_free(void)
{
    for (fixture *f = fixtures, *next; f; f = next) {
        next = f->next;
        dal_model_free(f->model);
        free(f);
    }
    fixtures = NULL;
}

dal_run_spec fixture_spec(const dal_system *system, const char *method, dal_space space,
                          double step)
{
    dal_run_spec spec = {.system = system, .options = dal_options_default()};
    CU_ASSERT_EQUAL_FATAL(dal_method_parse(&spec.method, method, NULL), DAL_STATUS_OK);
    spec.options.space = space;
    spec.options.step = step;
    return spec;
}

bool fixture_accepts(const dal_method *method, const dal_system *system, dal_space space)
{
    const unsigned needs = dal_method_needs(method);
    if (needs & DAL_NEEDS_BLOCKS && space == DAL_LIFTED) return false;
    if (needs & DAL_NEEDS_POTENTIAL && !(system->properties & DAL_MASS_CONSTANT)) return false;
    if (needs & DAL_NEEDS_ENERGY && !(system->properties & (DAL_E_EXACT | DAL_E_ON_D)))
        return false;
    if (needs & DAL_NEEDS_SERIES && (!system->series || system->series->refused)) return false;
    if (needs & DAL_NEEDS_CONSTANT_MASS &&
        (system->properties & (DAL_MASS_CONSTANT | DAL_MASS_ON_KERNEL)) != DAL_MASS_CONSTANT)
        return false;
    return !(needs & DAL_NEEDS_ISOKINETIC) || system->properties & DAL_D_ISOKINETIC;
}

dal_run *fixture_run(const dal_run_spec *spec)
{
    dal_run *run = NULL;
    dal_error error = {0};
    require(dal_run_create(&run, spec, &error), &error);
    return run;
}

dal_status fixture_events(dal_run *run, double T,
                          dal_status (*happened)(void *user, dal_run *run,
                                                 const dal_occurrence *event),
                          void *user, dal_error *error)
{
    const dal_observer observer = {.user = user, .event = happened};
    return dal_run_sample(run, T, 1, 1, &observer, error);
}

dal_run *fixture_stepped(const dal_run_spec *spec, long long steps)
{
    dal_run *run = fixture_run(spec);
    CU_ASSERT_EQUAL(dal_run_advance(run, steps, NULL), DAL_STATUS_OK);
    return run;
}

void fixture_lanes(dal_run_spec spec, int lanes, long long steps, const char *name, double from,
                   double by)
{
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, lanes, 0, NULL), DAL_STATUS_OK);
    for (int i = 0; i < lanes; i++) {
        const dal_setting start = {name, from + i * by};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, NULL, 0, &start, 1, NULL), DAL_STATUS_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, steps), DAL_STATUS_OK);
    for (int i = 0; i < lanes; i++) {
        const dal_setting start = {name, from + i * by};
        double state[64];
        spec.start = &start;
        spec.start_count = 1;
        dal_run *run = fixture_stepped(&spec, steps);
        const size_t bytes = (size_t)dal_run_dimension(run) * sizeof *state;
        CU_ASSERT_FATAL(bytes <= sizeof state);
        dal_batch_state(batch, i, state);
        CU_ASSERT_EQUAL(memcmp(state, dal_run_state(run), bytes), 0);
        dal_run_free(run);
    }
    dal_batch_free(batch);
}

dal_status fixture_failed_step(const dal_run_spec *spec, dal_error *error)
{
    dal_run *run = fixture_run(spec);
    size_t count;
    double before[256];
    const double *memory = dal_run_save(run, &count);
    CU_ASSERT_FATAL(count <= sizeof before / sizeof *before);
    memcpy(before, memory, count * sizeof *before);
    const dal_status status = dal_run_step(run, error);
    CU_ASSERT_NOT_EQUAL(status, DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(before, memory, count * sizeof *before), 0);
    dal_run_free(run);
    return status;
}

double fixture_symplectic_defect(const dal_run_spec *spec)
{
    dal_run *run = fixture_run(spec);
    double defect = NAN;
    fixture_perturb(run, 0.3);
    CU_ASSERT_EQUAL(dal_check_symplecticity(spec, 0.0, dal_run_state(run), 0.0, &defect, NULL),
                    DAL_STATUS_OK);
    dal_run_free(run);
    return defect;
}

void fixture_keeps_H(dal_run *run, long long steps)
{
    enum { H = 2, MAX = 64 }; /* after D1 and E */
    double first[MAX], last[MAX];
    CU_ASSERT_FATAL(dal_run_observables(run) <= MAX);
    CU_ASSERT_EQUAL(dal_run_observe(run, first), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, steps, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_observe(run, last), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(first[H], last[H], 1e-13);
    CU_ASSERT(fabs(first[H]) > 0.01);
}

dal_evaluator *fixture_evaluator(const dal_system *system)
{
    dal_evaluator *evaluator = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_evaluator_create(&evaluator, system, NULL, 0, NULL), DAL_STATUS_OK);
    return evaluator;
}

dal_status fixture_oscillate(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = -at->q[0];
    return DAL_STATUS_OK;
}

void fixture_refused(const dal_run_spec *spec, dal_status status, const char *fragment)
{
    dal_run *run = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_run_create(&run, spec, &error), status);
    CU_ASSERT_EQUAL(error.status, status);
    CU_ASSERT(error.line == 0 && error.column == 0); /* it is in no text */
    CU_ASSERT_PTR_NULL(run);
    if (!strstr(error.message, fragment)) printf("\n  %s\n", error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
}

void fixture_perturb(dal_run *run, double size)
{
    const int n = dal_run_system(run)->n;
    double state[256];
    memcpy(state, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *state);
    for (int i = 0; i < 2 * n; i++) state[2 * n + 1 + i] = size * (1.0 - 0.3 * i);
    CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, state, NULL), DAL_STATUS_OK);
}

const char *fixture_method(int i, char *name, size_t size)
{
    const dal_integrator *k = dal_integrator_at(i);
    const char *inside = k->needs & DAL_NEEDS_ORDER_2       ? "stormer-verlet+"
                         : k->needs & DAL_NEEDS_RUNGE_KUTTA ? "rk4+"
                                                            : "gauss4+";
    snprintf(name, size, "%s%s", k->properties & DAL_MODIFIER ? inside : "", k->name);
    return name;
}

/* The state at T after count steps. */
static void end_state(dal_run_spec spec, double T, int count, double displacement, double *state)
{
    spec.options.step = T / count;
    dal_run *run = fixture_run(&spec);
    if (displacement != 0.0) fixture_perturb(run, displacement);
    CU_ASSERT_EQUAL(dal_run_advance(run, count, NULL), DAL_STATUS_OK);
    memcpy(state, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *state);
    dal_run_free(run);
}

double fixture_order(dal_run_spec spec, double T, int coarse, int fine, double displacement)
{
    double reference[64], state[64], error[2] = {0.0, 0.0};
    dal_run_spec accurate = spec;
    CU_ASSERT_EQUAL(dal_method_parse(&accurate.method, "gauss10", NULL), DAL_STATUS_OK);
    end_state(accurate, T, 1500, displacement, reference);
    for (int k = 0; k < 2; k++) {
        end_state(spec, T, k ? fine : coarse, displacement, state);
        for (int i = 0; i < 2 * spec.system->n; i++)
            error[k] = fmax(error[k], fabs(state[i] - reference[i]));
    }
    return log(error[0] / error[1]) / log((double)fine / coarse);
}

double fixture_exponent(const dal_lyapunov *s, int i)
{
    dal_average a;
    dal_lyapunov_exponent(s, i, &a);
    CU_ASSERT(a.low <= a.mean && a.mean <= a.high);
    return a.mean;
}

double fixture_sum(const dal_lyapunov *s)
{
    dal_average a;
    dal_lyapunov_sum(s, &a);
    return a.mean;
}

double fixture_divergence(const dal_lyapunov *s)
{
    dal_average a;
    dal_lyapunov_divergence(s, &a);
    return a.mean;
}
