/* evaluator.c - a system with its parameters in force and memory to evaluate it in. */
#include "analysis/evaluator.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/solved.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct dal_evaluator {
    const dal_system *system;
    double *scale_memory; /* after work */
    double work[];
};

dal_status dal_evaluator_create(dal_evaluator **evaluator, const dal_system *system,
                                const dal_setting *parameters, int parameter_count,
                                dal_error *error)
{
    DAL_REQUIRE(evaluator, error);
    *evaluator = NULL;
    DAL_REQUIRE(system, error);
    DAL_TRY(dal__check_settings(parameters, parameter_count, "parameters", error));
    const size_t values = (size_t)system->parameters;
    const size_t size = system->workspace > values ? system->workspace : values;
    dal_evaluator *made =
        calloc(1, sizeof *made + (size + system->scale_memory) * sizeof *made->work);
    if (made == NULL) return dal__memory_error(error);
    made->system = system;
    made->scale_memory = made->work + size;
    dal_status status = dal__set_parameters(system, parameters, parameter_count,
                                            DAL_STATUS_NOT_FINITE, made->work, error);
    if (status == DAL_STATUS_OK && system->prepare != NULL) {
        status = system->prepare(system, &(dal_point){.work = made->work}, NULL);
        if (status != DAL_STATUS_OK)
            dal__fail(error, status, "%s: the parameters cannot be used: %s", system->name,
                      dal_status_text(status));
    }
    if (status == DAL_STATUS_OK)
        *evaluator = made;
    else
        free(made);
    return status;
}

void dal_evaluator_free(dal_evaluator *evaluator) { free(evaluator); }

double *dal__evaluator_work(dal_evaluator *evaluator) { return evaluator->work; }

const dal_system *dal_evaluator_system(const dal_evaluator *evaluator)
{
    return evaluator ? evaluator->system : NULL;
}

dal_status dal_evaluator_call(dal_evaluator *evaluator, dal_callback *callback, double t,
                              const double *q, const double *v, const double *pi, double *out)
{
    DAL_REQUIRE(evaluator && q && v && out, NULL);
    if (callback == NULL) return DAL_STATUS_UNSUPPORTED;
    const dal_callbacks *call = &evaluator->system->call;
    if (callback == call->adjoint || callback == call->effort) DAL_REQUIRE(pi, NULL);
    return callback(evaluator->system, &(dal_point){t, q, v, pi, evaluator->work, NULL}, out);
}

dal_status dal__evaluator_square(dal_evaluator *evaluator, double t, const double *q,
                                 const double *v, const double *pi, double *vector, double *out)
{
    const dal_system *s = evaluator->system;
    const double *K_pi = s->call.effort ? vector : pi;
    *out = 0.0;
    if (s->call.effort) DAL_TRY(dal_evaluator_call(evaluator, s->call.effort, t, q, v, pi, vector));
    for (int i = 0; i < s->n; i++) *out += pi[i] * K_pi[i];
    return DAL_STATUS_OK;
}

dal_status dal_evaluator_scales(dal_evaluator *evaluator, double t, const double *q,
                                const double *v, double *out)
{
    DAL_REQUIRE(evaluator && q && v && out, NULL);
    const dal_system *s = evaluator->system;
    const dal_point at = {.t = t, .q = q, .v = v, .work = evaluator->work};
    if (s->scales) return s->scales(s, &at, evaluator->scale_memory, out);
    const int positions = s->m + 1 + s->invariants, count = positions + s->holonomic;
    for (int i = 0; i < count; i++) out[i] = 0.0;
    if (s->constraints) DAL_TRY(s->constraints(s, &at, out));
    if (s->energy) DAL_TRY(s->energy(s, &at, out + s->m));
    if (s->invariant_values) DAL_TRY(s->invariant_values(s, &at, out + s->m + 1));
    if (s->call.holonomic) DAL_TRY(s->call.holonomic(s, &at, out + positions));
    for (int i = 0; i < count; i++) out[i] = fabs(out[i]);
    return DAL_STATUS_OK;
}

/* ---- the start ---- */

enum { NAME_SIZE = 128, NAMES_SHOWN = 64 };

/* Name of number i of the start: x, x', g1, e. */
static void start_name(const dal_system *s, int i, char *name)
{
    int j = i % s->n;
    char own[16];
    snprintf(own, sizeof own, "q%d", j + 1);
    const char *coordinate = s->coordinate != NULL ? s->coordinate[j] : own;
    if (i < 2 * s->n)
        snprintf(name, NAME_SIZE, "%s%s", coordinate, i < s->n ? "" : "'");
    else if (i < 2 * s->n + s->multipliers)
        snprintf(name, NAME_SIZE, "g%d", i - 2 * s->n + 1);
    else
        snprintf(name, NAME_SIZE, "e");
}

static dal_status set_start(const dal_system *s, const dal_setting *setting, double *out,
                            dal_error *error)
{
    char names[NAMES_SHOWN][NAME_SIZE];
    const char *shown[NAMES_SHOWN];
    int count = 2 * s->n + s->multipliers + 1, kept = 0;
    for (int i = 0; i < count; i++) {
        char *name = names[kept];
        start_name(s, i, name);
        if (strcmp(name, setting->name) == 0) {
            out[i] = setting->value;
            return DAL_STATUS_OK;
        }
        shown[kept] = name;
        if (kept < NAMES_SHOWN - 1) kept++;
    }
    return dal__unknown(error, "start value", setting->name, shown, kept);
}

dal_status dal_evaluator_start(dal_evaluator *evaluator, const dal_setting *start, int start_count,
                               double *out, dal_error *error)
{
    return dal_evaluator_start_at(evaluator, 0.0, start, start_count, out, error);
}

dal_status dal_evaluator_start_at(dal_evaluator *evaluator, double t, const dal_setting *start,
                                  int start_count, double *out, dal_error *error)
{
    DAL_REQUIRE(evaluator, error);
    DAL_REQUIRE(out, error);
    DAL_TRY(dal__check_settings(start, start_count, "start values", error));
    const dal_system *s = evaluator->system;
    int count = 2 * s->n + s->multipliers + 1;
    for (int i = 0; i < count; i++) out[i] = i == count - 1 ? 1.0 : 0.0;
    if (s->start != NULL) {
        dal_status status = s->start(s, &(dal_point){.t = t, .work = evaluator->work}, out);
        if (status != DAL_STATUS_OK)
            return dal__fail(error, status, "%s: no start: %s", s->name, dal_status_text(status));
    }
    for (int i = 0; i < start_count; i++) DAL_TRY(set_start(s, &start[i], out, error));
    double *memory = calloc(dal__solve_size(s) + 1, sizeof *memory);
    if (memory == NULL) return dal__memory_error(error);
    const dal_status solved = dal__solve_start(s, t, out, evaluator->work, memory, error);
    free(memory);
    return solved;
}
