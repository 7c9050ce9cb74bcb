/* native.c - runs and batches with compiled steps: generate, compile, load.
 *
 * An object holds steps only, or observables only.  The observables have one of their own, since
 * they are evaluated for as many states at a time as a register has lanes, whatever the steps do,
 * and are the same for all methods.
 *
 * The compiled function works on the persistent state of a run, or of a group of lanes, with the
 * same bits as the interpreter, so that it can be installed at any time; the interpreter explains
 * failures. */
#include "codegen/emit_callbacks.h"
#include "codegen/generate.h"
#include "codegen/interface.h"
#include "codegen/parts.h"
#include "jit/cache.h"
#include "run/batch.h"
#include "run/run.h"
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 1024 };

#define PREFIX "dal_native"

/* ---- texts ---- */

/* Loops over components are unrolled up to this size of a state. */
enum { MAX_UNROLLED = 64 };

/* Declarations instead of headers, which take a compiler longer. */
static void write_declarations(dal__generation *g)
{
    dal__buffer_append(
        &g->text, "typedef __INT64_TYPE__ int64_t;\ntypedef __UINT64_TYPE__ uint64_t;\ntypedef "
                  "__SIZE_TYPE__ size_t;\n"
                  "#define INT64_MAX __INT64_MAX__\n#define INT64_MIN (-__INT64_MAX__ - 1)\n"
                  "#define NULL ((void *)0)\n#define INFINITY __builtin_inf()\n"
                  "#define NAN __builtin_nan(\"\")\n"
                  "void *memcpy(void *, const void *, size_t);\n"
                  "double sin(double), cos(double), tan(double), asin(double), acos(double);\n"
                  "double atan(double), sinh(double), cosh(double), tanh(double), asinh(double);\n"
                  "double exp(double), log(double), sqrt(double), fabs(double);\n"
                  "double atan2(double, double), pow(double, double);\n");
}

/* A register full of lanes; the parameters are those of one lane. */
static const char lanes_text[] =
    "#define DAL_SPECIALISED 1\n"
    "#if defined __AVX512F__\n#define DAL_LANES 8\n"
    "#elif defined __AVX__\n#define DAL_LANES 4\n"
    "#else\n#define DAL_LANES 2\n#endif\n"
    "#define DAL_WORK(place) dal_num(((const double *)w)[place])\n"
    "typedef enum dal_callback_code { DAL_EVAL_FIELD, DAL_EVAL_GAUGE } "
    "dal_callback_code;\n";

static void write_sizes(dal__generation *g)
{
    const dal__layout *k = &g->layout;
    const bool small = k->dim <= MAX_UNROLLED;
    dal__buffer_append(&g->text, small ? "#define DAL_UNROLL _Pragma(\"GCC unroll 64\")\n"
                                       : "#define DAL_UNROLL\n");
    dal__buffer_print(&g->text,
                      "enum { DAL_FIXED_N = %d, DAL_FIXED_NW = %d, DAL_FIXED_DIM = %d, "
                      "DAL_FIXED_LIFTED = %d, DAL__OBSERVABLES = %d };\n",
                      k->n, k->nw, k->dim, k->lifted, dal_run_observables(g->run));
}

/* ---- objects ---- */

static void release(void *handle) { dlclose(handle); }

/* Of the functions in dal__native_code an object has one, named after the product.  ISO C has no
 * conversion from what dlsym finds. */
static dal_status load(const char *path, dal__product product, dal__native_code *native,
                       dal_error *error)
{
    static const char *const symbols[] = {[DAL__LANES] = PREFIX "_lanes",
                                          [DAL__TRACE] = PREFIX "_traced",
                                          [DAL__OBSERVE] = PREFIX "_observables"};
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    void *found = handle ? dlsym(handle, symbols[product]) : NULL;
    if (!found) {
        if (handle) dlclose(handle);
        dal__cache_forget(path);
        return dal__fail(error, DAL_IO, "'%.200s' cannot be loaded", path);
    }
    if (product == DAL__LANES) memcpy(&native->steps, &found, sizeof found);
    if (product == DAL__TRACE) memcpy(&native->traced, &found, sizeof found);
    if (product == DAL__OBSERVE) memcpy(&native->observables, &found, sizeof found);
    native->handle = handle;
    native->release = release;
    return DAL_OK;
}

/* Compiles and loads a text; an object that cannot be loaded is compiled again. */
static dal_status compile(dal__generation *g, const dal_native_options *options,
                          dal__native_code *native, dal_error *error)
{
    char path[PATH_SIZE], *text;
    dal_status status = DAL_IO;
    DAL_TRY(dal__generation_finish(g, &text, error));
    for (int attempt = 0; attempt < 2 && status != DAL_OK; attempt++) {
        status = dal__cache_object(options, text, path, sizeof path, error);
        if (status != DAL_OK) break;
        status = load(path, g->product, native, error);
    }
    free(text);
    return status;
}

/* The steps alone, DAL__LANES or DAL__TRACE: the function PREFIX_lanes or PREFIX_traced. */
static dal_status compile_steps(const dal__layout *layout, dal__product product, int lanes,
                                const dal_native_options *options, dal__native_code *native,
                                dal_error *error)
{
    const dal_run_spec spec = {
        .system = layout->system, .method = layout->method, .options = layout->options};
    dal__generation g = {.spec = &spec, .lanes = lanes, .product = product};
    DAL_TRY(dal__generation_check(&g, PREFIX, error));
    write_declarations(&g);
    dal__write_template(&g, product == DAL__TRACE
                                ? "long long PREFIX_traced(double *, const double *, double, long "
                                  "long, unsigned *, int *, double *, long long);\n"
                                : "long long PREFIX_lanes(double *, const double *, double, long "
                                  "long, unsigned, unsigned *, int *);\n");
    dal__write_steps(&g);
    return compile(&g, options, native, error);
}

/* The observables of a run, wherever it stands: the function PREFIX_observables. */
static dal_status compile_observables(const dal_run *run, const dal_native_options *options,
                                      dal__native_code *native, dal_error *error)
{
    dal__generation g = {.run = run, .layout = run->layout, .lanes = 8, .product = DAL__OBSERVE};
    if (g.layout.options.precision != DAL_DOUBLE)
        return dal__fail(error, DAL_UNSUPPORTED, "observables in quad precision are not generated");
    DAL_TRY(dal__generation_check(&g, PREFIX, error));
    write_declarations(&g);
    dal__write_template(
        &g, "void PREFIX_observables(const double *, long long, long long, const double *, "
            "double *);\n");
    dal__write_compiler(&g);
    dal__buffer_append(&g.text, lanes_text);
    write_sizes(&g);
    dal__decide_conditions(&g);
    dal__write_source(&g, "num.h");
    dal__write_source(&g, "elementary.h");
    dal__emit_callbacks(&g);
    dal__write_source(&g, "observables.h");
    dal__write_observe(&g);
    dal__write_source(&g, "observables.inc");
    return compile(&g, options, native, error);
}

/* ---- runs ---- */

dal_status dal_run_native(dal_run *run, const dal_native_options *options, dal_error *error)
{
    DAL_REQUIRE(run, error);
    if (dal_run_is_native(run)) return DAL_OK;
    return compile_steps(&run->layout, DAL__TRACE, 1, options, &run->native, error);
}

int dal_run_is_native(const dal_run *run) { return run && run->native.traced != NULL; }

enum { REGISTER = 8 }; /* numbers in the widest; as many as a line of the cache has */

/* Zeros at first: a register is read as a whole, and none of them lies across two lines. */
static dal_status allocate_observations(dal__observations *observations, int dimension,
                                        int observables, dal_error *error)
{
    /* Observations at a time: whole registers of any machine.  Many of them, since a processor
     * takes about a microsecond to wake the upper halves of its widest registers, and no more than
     * a second-level cache holds. */
    enum { MAX = 992, NEAR = (1 << 18) / sizeof(double) };
    const int numbers = dimension + 1 + observables, most = NEAR / numbers / REGISTER * REGISTER;
    const int capacity = most > MAX ? MAX : most < REGISTER ? REGISTER : most;
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
    if (run->observations.states || dal_run_observables(run) == 0) return DAL_OK;
    DAL_TRY(compile_observables(run, options, &code, error));
    const dal_status status =
        allocate_observations(&run->observations, run->layout.dim, dal_run_observables(run), error);
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
    DAL_TRY(compile_steps(dal__batch_layout(batch), DAL__LANES, lanes, options, &native, error));
    const dal_status status = dal__batch_install(batch, lanes, &native, error);
    if (status != DAL_OK) dal__native_free(&native);
    return status;
}
