/* evaluator.c - a system with its parameters in force and memory to evaluate it in. */
#include "core/arguments.h"
#include "core/vectors.h"
#include "dalembert_analysis.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct dal_evaluator {
    const dal_system *system;
    double *work;
};

static dal_status fill(dal_evaluator *evaluator, const dal_setting *parameters, int count,
                       dal_error *error)
{
    const dal_system *s = evaluator->system;
    DAL_TRY(dal__set_parameters(s, parameters, count, DAL_NOT_FINITE, evaluator->work, error));
    if (s->prepare == NULL) return DAL_OK;
    dal_status status = s->prepare(s, &(dal_point){.work = evaluator->work}, NULL);
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(error, status, "%s: the parameters cannot be used: %s", s->name,
                     dal_status_text(status));
}

dal_status dal_evaluator_create(dal_evaluator **evaluator, const dal_system *system,
                                const dal_setting *parameters, int parameter_count,
                                dal_error *error)
{
    DAL_REQUIRE(evaluator, error);
    *evaluator = NULL;
    DAL_REQUIRE(system, error);
    DAL_TRY(dal__check_settings(parameters, parameter_count, "parameters", error));
    size_t size = system->workspace;
    if (size < (size_t)system->parameters) size = (size_t)system->parameters;
    *evaluator = calloc(1, sizeof **evaluator);
    double *work = dal__numbers(size, 1);
    if (*evaluator == NULL || work == NULL) {
        free(work);
        free(*evaluator);
        *evaluator = NULL;
        return dal__fail(error, DAL_MEMORY, "%s: out of memory", system->name);
    }
    **evaluator = (dal_evaluator){system, work};
    dal_status status = fill(*evaluator, parameters, parameter_count, error);
    if (status == DAL_OK) return DAL_OK;
    dal_evaluator_free(*evaluator);
    *evaluator = NULL;
    return status;
}

void dal_evaluator_free(dal_evaluator *evaluator)
{
    if (evaluator == NULL) return;
    free(evaluator->work);
    free(evaluator);
}

const dal_system *dal_evaluator_system(const dal_evaluator *evaluator)
{
    return evaluator ? evaluator->system : NULL;
}

dal_status dal_evaluator_call(dal_evaluator *evaluator, dal_callback *callback, double t,
                              const double *q, const double *v, const double *pi, double *out)
{
    DAL_REQUIRE(evaluator && q && v && out, NULL);
    if (callback == NULL) return DAL_UNSUPPORTED;
    if (callback == evaluator->system->call.adjoint) DAL_REQUIRE(pi, NULL);
    return callback(evaluator->system, &(dal_point){t, q, v, pi, evaluator->work}, out);
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
            return DAL_OK;
        }
        shown[kept] = name;
        if (kept < NAMES_SHOWN - 1) kept++;
    }
    return dal__unknown(error, "start value", setting->name, shown, kept);
}

dal_status dal_evaluator_start(dal_evaluator *evaluator, const dal_setting *start, int start_count,
                               double *out, dal_error *error)
{
    DAL_REQUIRE(evaluator, error);
    DAL_REQUIRE(out, error);
    DAL_TRY(dal__check_settings(start, start_count, "start values", error));
    const dal_system *s = evaluator->system;
    int count = 2 * s->n + s->multipliers + 1;
    for (int i = 0; i < count; i++) out[i] = i == count - 1 ? 1.0 : 0.0;
    if (s->start != NULL) {
        dal_status status = s->start(s, &(dal_point){.work = evaluator->work}, out);
        if (status != DAL_OK)
            return dal__fail(error, status, "%s: no start: %s", s->name, dal_status_text(status));
    }
    for (int i = 0; i < start_count; i++) DAL_TRY(set_start(s, &start[i], out, error));
    return DAL_OK;
}
