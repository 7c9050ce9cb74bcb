/* fuzz_yaml.c - any bytes as a system file: read, made a system, evaluated once. */
#include <dalembert.h>

#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void evaluate(const dal_system *system)
{
    size_t n = (size_t)system->n, w = n + (size_t)system->multipliers;
    double *work = calloc(system->workspace, sizeof *work);
    double *x = calloc(n + w + 1, sizeof *x), *F = calloc(w + 1, sizeof *F);
    if (work && x && F) {
        for (int i = 0; i < system->parameters; i++) work[i] = system->value[i];
        dal_point at = {.q = x, .v = x + n, .work = work};
        system->prepare(system, &at, NULL);
        system->start(system, &at, x);
        system->call.field(system, &at, F);
        system->diagnose(system, &at, F);
    }
    free(work);
    free(x);
    free(F);
}

/* Files beyond a few hundred bytes only cost time: every rule fits into them. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    dal_model *model;
    const dal_system *system;
    dal_error error;
    if (size > 1024) return 0;
    if (dal_model_read(&model, "fuzz", (const char *)data, size, &error) == DAL_STATUS_OK) {
        if (dal_model_system(model, &system, &error) == DAL_STATUS_OK) evaluate(system);
        dal_model_free(model);
    }
    return 0;
}
