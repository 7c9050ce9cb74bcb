/* model.h - the systems of the bench by their names. */
#ifndef BENCH_MODEL_H
#define BENCH_MODEL_H

#include <dalembert.h>
#include <stdio.h>

/* A built-in system, or bench/systems/NAME.yaml. */
static inline dal_status bench_model(dal_model **model, const char *name, dal_error *error)
{
    char path[64];
    snprintf(path, sizeof path, "bench/systems/%.40s.yaml", name);
    if (dal_model_builtin(model, name, NULL) == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal_model_read_file(model, path, error);
}

/* Its equations; NULL where there are none. */
static inline const dal_system *bench_system(const char *name, dal_error *error)
{
    const dal_system *system = NULL;
    dal_model *model;
    if (bench_model(&model, name, error) == DAL_STATUS_OK) dal_model_system(model, &system, error);
    return system;
}

#endif
