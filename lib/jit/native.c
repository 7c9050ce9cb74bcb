/* native.c - runs and batches with compiled steps: generate, compile, load.
 *
 * The compiled function works on the persistent state of a run, or of a group of lanes, with the
 * same bits as the interpreter, so that it can be installed at any time; the interpreter explains
 * failures. */
#include "jit/cache.h"
#include "jit/native_text.h"
#include "run/batch.h"
#include "run/run.h"
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 1024 };

static void release(void *handle) { dlclose(handle); }

/* Of the functions in dal__native_code an object has one, named after the product.  ISO C has no
 * conversion from what dlsym finds. */
static bool find(void *handle, dal__product product, dal__native_code *native)
{
    static const char *const symbols[] = {[DAL__LANES] = DAL__NATIVE_PREFIX "_lanes",
                                          [DAL__TRACE] = DAL__NATIVE_PREFIX "_traced",
                                          [DAL__OBSERVE] = DAL__NATIVE_PREFIX "_observables"};
    void *found = handle ? dlsym(handle, symbols[product]) : NULL;
    if (product == DAL__LANES) memcpy(&native->steps, &found, sizeof found);
    if (product == DAL__TRACE) memcpy(&native->traced, &found, sizeof found);
    if (product == DAL__OBSERVE) memcpy(&native->observables, &found, sizeof found);
    return found != NULL;
}

static dal_status load(const char *path, dal__product product, dal__native_code *native,
                       dal_error *error)
{
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!find(handle, product, native)) {
        if (handle) dlclose(handle);
        dal__cache_forget(path);
        return dal__fail(error, DAL_IO, "'%.200s' cannot be loaded", path);
    }
    native->handle = handle;
    native->release = release;
    return DAL_OK;
}

/* An object that cannot be loaded is compiled again. */
static dal_status compiled(const char *text, dal__product product,
                           const dal_native_options *options, dal__native_code *native,
                           dal_error *error)
{
    char path[PATH_SIZE];
    dal_status status = DAL_IO;
    for (int attempt = 0; attempt < 2 && status != DAL_OK; attempt++) {
        status = dal__cache_object(options, text, path, sizeof path, error);
        if (status != DAL_OK) break;
        status = load(path, product, native, error);
    }
    return status;
}

static dal_status compiled_steps(const dal__layout *layout, dal__product product, int lanes,
                                 const dal_native_options *options, dal__native_code *native,
                                 dal_error *error)
{
    const dal_run_spec spec = {
        .system = layout->system, .method = layout->method, .options = layout->options};
    char *text;
    DAL_TRY(dal__generate_native(&spec, product, lanes, &text, error));
    const dal_status status = compiled(text, product, options, native, error);
    free(text);
    return status;
}

/* ---- runs ---- */

dal_status dal_run_native(dal_run *run, const dal_native_options *options, dal_error *error)
{
    DAL_REQUIRE(run, error);
    if (dal_run_is_native(run)) return DAL_OK;
    return compiled_steps(&run->layout, DAL__TRACE, 1, options, &run->native, error);
}

int dal_run_is_native(const dal_run *run) { return run && run->native.traced != NULL; }

enum { REGISTER = 8 }; /* numbers in the widest; as many as a line of the cache has */

/* Observations at a time: whole registers of any machine.  Many of them, since a processor takes
 * about a microsecond to wake the upper halves of its widest registers, and no more than a
 * second-level cache holds. */
static int observation_capacity(int numbers)
{
    enum { MAX = 992, NEAR = (1 << 18) / sizeof(double) };
    const int capacity = NEAR / numbers / REGISTER * REGISTER;
    return capacity > MAX ? MAX : capacity < REGISTER ? REGISTER : capacity;
}

/* Zeros at first: a register is read as a whole, and none of them lies across two lines. */
static dal_status allocate_observations(dal__observations *observations, int dimension,
                                        int observables, dal_error *error)
{
    const int numbers = dimension + 1 + observables, capacity = observation_capacity(numbers);
    const size_t bytes = sizeof(double) * (size_t)numbers * (size_t)capacity;
    double *const memory = aligned_alloc(REGISTER * sizeof(double), bytes);
    if (!memory) return dal__fail(error, DAL_MEMORY, "no memory for %d observations", capacity);
    memset(memory, 0, bytes);
    observations->capacity = capacity;
    observations->states = memory;
    observations->times = memory + (size_t)dimension * (size_t)capacity;
    observations->values = observations->times + capacity;
    return DAL_OK;
}

dal_status dal_run_native_observables(dal_run *run, const dal_native_options *options,
                                      dal_error *error)
{
    DAL_REQUIRE(run, error);
    dal__native_code code = {0};
    char *text;
    if (run->observations.states || dal_run_observables(run) == 0) return DAL_OK;
    DAL_TRY(dal__generate_observables(&run->layout, run, &text, error));
    dal_status status = compiled(text, DAL__OBSERVE, options, &code, error);
    free(text);
    if (status == DAL_OK)
        status = allocate_observations(&run->observations, run->layout.dim,
                                       dal_run_observables(run), error);
    if (status == DAL_OK)
        run->observations.code = code;
    else
        dal__native_free(&code);
    return status;
}

/* ---- batches ---- */

dal_status dal_batch_native(dal_batch *batch, const dal_native_options *options, dal_error *error)
{
    DAL_REQUIRE(batch, error);
    const int lanes = dal__batch_native_lanes(batch);
    dal__native_code native = {0};
    if (dal_batch_is_native(batch)) return DAL_OK;
    DAL_TRY(compiled_steps(dal__batch_layout(batch), DAL__LANES, lanes, options, &native, error));
    const dal_status status = dal__batch_install(batch, lanes, &native, error);
    if (status != DAL_OK) dal__native_free(&native);
    return status;
}
