/* native.c - a run whose steps are compiled: generate, compile, load, and step by it.
 *
 * The loaded function works on the run's own carried array with the same bits as the tape, so it
 * can be put in at any time; failures are explained by the tape. */
#include "generate/cache.h"
#include "generate/generate.h"
#include "run/run.h"
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 1024 };

static void release(void *handle) { dlclose(handle); }

static dal_status load(dal_run *run, const char *path, dal_error *error)
{
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    void *found = handle ? dlsym(handle, DAL__NATIVE_PREFIX "_lanes") : NULL;
    if (!found) {
        if (handle) dlclose(handle);
        dal__cache_forget(path);
        return dal__error(error, DAL_IO, 0, 0, "'%.200s' cannot be loaded", path);
    }
    run->native.handle = handle;
    run->native.release = release;
    memcpy(&run->native.steps, &found, sizeof found); /* ISO C has no such conversion */
    return DAL_OK;
}

dal_status dal_run_native(dal_run *run, const char *cache_directory, dal_error *error)
{
    const dal_run_spec spec = {
        .system = run->shape.system, .method = run->shape.method, .options = run->shape.options};
    char *text, path[PATH_SIZE];
    if (run->native.steps) return DAL_OK;
    DAL_TRY(dal__generate_native(&spec, 1, &text, error));
    dal_status status = dal__cache_object(cache_directory, text, path, sizeof path, error);
    free(text);
    return status == DAL_OK ? load(run, path, error) : status;
}

int dal_run_is_native(const dal_run *run) { return run->native.steps != NULL; }
