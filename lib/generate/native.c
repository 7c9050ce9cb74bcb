/* native.c - runs and batches whose steps are compiled: generate, compile, load, and step by it.
 *
 * The loaded function works on the carried array of a run, or of a block of lanes, with the same
 * bits as the tape, so it can be put in at any time; failures are explained by the tape. */
#include "generate/cache.h"
#include "generate/generate.h"
#include "run/batch.h"
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 1024 };

static void release(void *handle) { dlclose(handle); }

static dal_status load(const char *path, dal__native *native, dal_error *error)
{
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    void *found = handle ? dlsym(handle, DAL__NATIVE_PREFIX "_lanes") : NULL;
    if (!found) {
        if (handle) dlclose(handle);
        dal__cache_forget(path);
        return dal__error(error, DAL_IO, 0, 0, "'%.200s' cannot be loaded", path);
    }
    native->handle = handle;
    native->release = release;
    memcpy(&native->steps, &found, sizeof found); /* ISO C has no such conversion */
    return DAL_OK;
}

/* Steps of so many lanes.  An object that cannot be loaded, whoever has made it, is made anew. */
static dal_status compiled(const dal__shape *shape, int lanes, const dal_native_options *options,
                           dal__native *native, dal_error *error)
{
    const dal_run_spec spec = {
        .system = shape->system, .method = shape->method, .options = shape->options};
    char *text, path[PATH_SIZE];
    DAL_TRY(dal__generate_native(&spec, lanes, &text, error));
    dal_status status = DAL_IO;
    for (int attempt = 0; attempt < 2 && status != DAL_OK; attempt++) {
        status = dal__cache_object(options, text, path, sizeof path, error);
        if (status != DAL_OK) break;
        status = load(path, native, error);
    }
    free(text);
    return status;
}

dal_status dal_run_native(dal_run *run, const dal_native_options *options, dal_error *error)
{
    return run->native.steps ? DAL_OK : compiled(&run->shape, 1, options, &run->native, error);
}

int dal_run_is_native(const dal_run *run) { return run->native.steps != NULL; }

dal_status dal_batch_native(dal_batch *batch, const dal_native_options *options, dal_error *error)
{
    const int lanes = dal__batch_native_lanes(batch);
    dal__native native = {0};
    if (dal_batch_is_native(batch)) return DAL_OK;
    DAL_TRY(compiled(dal__batch_shape(batch), lanes, options, &native, error));
    const dal_status status = dal__batch_install(batch, lanes, &native, error);
    if (status != DAL_OK) dal__native_free(&native);
    return status;
}
