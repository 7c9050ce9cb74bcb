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
#include "codegen/preprocessor.h"
#include "jit/cache.h"
#include "run/batch.h"
#include "run/run.h"
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#define PREFIX "dal_native"

/* ---- texts ---- */

/* Declarations instead of headers, which take a compiler longer. */
static void write_declarations(dal__generation *g)
{
    dal__buffer_append(
        &g->text, "typedef __INT64_TYPE__ int64_t;\ntypedef __UINT64_TYPE__ uint64_t;\ntypedef "
                  "__SIZE_TYPE__ size_t;\n"
                  "#define INT64_MAX __INT64_MAX__\n#define INT64_MIN (-__INT64_MAX__ - 1)\n"
                  "#define bool _Bool\n#define true 1\n#define false 0\n"
                  "#define NULL ((void *)0)\n#define INFINITY __builtin_inf()\n"
                  "#define NAN __builtin_nan(\"\")\n"
                  "void *memcpy(void *, const void *, size_t);\n"
                  "double sin(double), cos(double), tan(double), asin(double), acos(double);\n"
                  "double atan(double), sinh(double), cosh(double), tanh(double), asinh(double);\n"
                  "double exp(double), log(double), sqrt(double), fabs(double);\n"
                  "double atan2(double, double), pow(double, double);\n");
}

/* A register full of lanes; the parameters are one lane's. */
static const char lanes_text[] =
    "#define DAL_SPECIALISED 1\n"
    "#if defined __AVX512F__\n#define DAL_LANES 8\n"
    "#elif defined __AVX__\n#define DAL_LANES 4\n"
    "#else\n#define DAL_LANES 2\n#endif\n"
    "#define DAL_WORK(place) dal_num(((const double *)w)[place])\n"
    "typedef enum dal_callback_code { DAL_EVAL_FIELD, DAL_EVAL_GAUGE, DAL_EVAL_HOLONOMIC, "
    "DAL_EVAL_EFFORT } dal_callback_code;\n";

static void write_sizes(dal__generation *g)
{
    const dal__layout *k = &g->layout;
    dal__write_unrolling(g);
    dal__buffer_print(&g->text,
                      "enum { DAL_FIXED_N = %d, DAL_FIXED_NW = %d, DAL_FIXED_M = %d, "
                      "DAL_FIXED_DIM = %d, DAL_FIXED_LIFTED = %d, DAL__OBSERVABLES = %d };\n",
                      k->n, k->nw, k->m, k->dim, k->lifted, dal_run_observables(g->run));
}

/* ---- objects ---- */

struct dal_native {
    dal__product product;
    dal__layout layout; /* of the runs it is for */
    int lanes;
    bool exact; /* whether the observables have the error */
    char *text; /* until the object is loaded */
    dal__compilation compilation;
    bool again; /* the object could not be loaded once */
    dal_native_state state;
    dal_error error; /* why it failed */
    dal__native_code code;
};

static void release(void *handle) { dlclose(handle); }

/* Of the functions in dal__native_code an object has one, named after the product.  ISO C has no
 * conversion from what dlsym finds. */
static bool load(dal_native *native)
{
    static const char *const symbols[] = {[DAL__PRODUCT_LANES] = PREFIX "_lanes",
                                          [DAL__PRODUCT_TRACE] = PREFIX "_traced",
                                          [DAL__PRODUCT_OBSERVE] = PREFIX "_observables"};
    dal__native_code *code = &native->code;
    void *handle = dal__compilation_load(&native->compilation);
    void *found = handle ? dlsym(handle, symbols[native->product]) : NULL;
    if (!found) {
        if (handle) dlclose(handle);
        return false;
    }
    if (native->product == DAL__PRODUCT_LANES) memcpy(&code->steps, &found, sizeof found);
    if (native->product == DAL__PRODUCT_TRACE) memcpy(&code->traced, &found, sizeof found);
    if (native->product == DAL__PRODUCT_OBSERVE) memcpy(&code->observables, &found, sizeof found);
    code->handle = handle;
    code->release = release;
    return true;
}

/* Loads the object once it is there; one that cannot be loaded is compiled again. */
static dal_status advance(dal_native *native, dal_error *error)
{
    dal__compilation *c = &native->compilation;
    DAL_TRY(dal__compilation_poll(c, error));
    if (c->process) return DAL_STATUS_OK;
    if (load(native)) {
        native->state = DAL_NATIVE_READY;
        return DAL_STATUS_OK;
    }
    if (native->again) {
        dal__compilation_forget(c);
        return dal__fail(error, DAL_STATUS_IO, "'%.200s' cannot be loaded", c->path);
    }
    native->again = true;
    return dal__compilation_repeat(c, native->text, error);
}

dal_native_state dal_native_poll(dal_native *native, dal_error *error)
{
    if (!native) return dal__missing(error, __func__, "native"), DAL_NATIVE_FAILED;
    if (native->state == DAL_NATIVE_PENDING && advance(native, &native->error) != DAL_STATUS_OK)
        native->state = DAL_NATIVE_FAILED;
    if (native->state != DAL_NATIVE_PENDING) {
        free(native->text);
        native->text = NULL;
    }
    if (native->state == DAL_NATIVE_FAILED && error) *error = native->error;
    return native->state;
}

void dal_native_free(dal_native *native)
{
    if (!native) return;
    dal__compilation_end(&native->compilation);
    dal__compiled_free(&native->code);
    free(native->text);
    free(native);
}

/* What is waited for, until its end or until the caller stops it. */
static dal_status wait_for(dal_native *native, const dal_native_options *options, dal_error *error)
{
    while (dal_native_poll(native, error) == DAL_NATIVE_PENDING) {
        if (options->stop && options->stop(options->user))
            return dal__fail(error, DAL_STATUS_INTERRUPTED, "the compiler '%.200s' was stopped",
                             native->compilation.compiler);
        dal__compilation_pause();
    }
    return native->state == DAL_NATIVE_READY ? DAL_STATUS_OK : native->error.status;
}

/* ---- texts of objects ---- */

/* The steps alone, DAL__PRODUCT_LANES or DAL__PRODUCT_TRACE: the function PREFIX_lanes or
 * PREFIX_traced. */
static dal_status write_steps(dal_native *native, dal_error *error)
{
    const dal__layout *k = &native->layout;
    const dal_run_spec spec = {.system = k->system, .method = k->method, .options = k->options};
    dal__generation g = {.spec = &spec, .lanes = native->lanes, .product = native->product};
    DAL_TRY(dal__generation_check(&g, PREFIX, error));
    write_declarations(&g);
    dal__write_template(&g, g.product == DAL__PRODUCT_TRACE
                                ? "long long PREFIX_traced(double *, const double *, double, long "
                                  "long, unsigned *, int *, double *, long long);\n"
                                : "long long PREFIX_lanes(double *, const double *, double, long "
                                  "long, unsigned, unsigned *, int *);\n");
    dal__write_steps(&g);
    return dal__generation_finish(&g, &native->text, error);
}

/* The observables of a run, wherever it is: the function PREFIX_observables. */
static dal_status write_observables(dal_native *native, const dal_run *run, dal_error *error)
{
    dal__generation g = {
        .run = run, .layout = run->layout, .lanes = 8, .product = DAL__PRODUCT_OBSERVE};
    if (g.layout.options.precision != DAL_DOUBLE)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "observables in quad precision are not generated");
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
    return dal__generation_finish(&g, &native->text, error);
}

static uint64_t add_name(uint64_t key, const char *name)
{
    return name ? dal__hash(key, name, strlen(name) + 1) : key;
}

/* A number that differs where texts differ in most cases, at once: the text of a large system takes
 * a second. */
static uint64_t key_of(const dal_native *native)
{
    const dal__layout *k = &native->layout;
    const dal_system *s = k->system;
    const int numbers[] = {(int)native->product,
                           native->lanes,
                           native->exact,
                           k->n,
                           k->m,
                           k->nw,
                           k->lifted,
                           s->parameters,
                           s->field_operations,
                           s->jacobian_operations};
    uint64_t key = dal__hash(0, numbers, sizeof numbers);
    for (int i = 0; native->product != DAL__PRODUCT_OBSERVE && i < k->depth; i++)
        key = add_name(key, k->method.layer[i]->name);
    for (int i = 0; s->coordinate && i < k->n; i++) key = add_name(key, s->coordinate[i]);
    return add_name(key, s->name);
}

/* Writes the text of a product for a layout, of observables for a run, and begins to compile it. */
static dal_status begin(dal_native **native, dal__product product, int lanes,
                        const dal__layout *layout, const dal_run *run,
                        const dal_native_options *options, dal_error *error)
{
    dal_native *made = calloc(1, sizeof *made);
    *native = NULL;
    if (!made) return dal__fail(error, DAL_STATUS_MEMORY, "no memory for compiled steps");
    made->product = product;
    made->layout = *layout;
    made->lanes = lanes;
    made->exact = run && run->exact;
    const uint64_t key = key_of(made);
    dal_status status = DAL_STATUS_OK;
    if (options && options->only_cached && !dal__compilation_is_likely(options, key))
        status = dal__fail(error, DAL_STATUS_UNSUPPORTED, "the cache has no such code");
    if (status == DAL_STATUS_OK)
        status = product == DAL__PRODUCT_OBSERVE ? write_observables(made, run, error)
                                                 : write_steps(made, error);
    if (status == DAL_STATUS_OK)
        status = dal__compilation_begin(&made->compilation, options, key, made->text, error);
    if (status == DAL_STATUS_OK)
        *native = made;
    else
        dal_native_free(made);
    return status;
}

dal_status dal_native_begin(dal_native **native, const dal_run *run,
                            const dal_native_options *options, dal_error *error)
{
    DAL_REQUIRE(native, error);
    *native = NULL;
    DAL_REQUIRE(run, error);
    return begin(native, DAL__PRODUCT_TRACE, 1, &run->layout, NULL, options, error);
}

dal_status dal_native_begin_observables(dal_native **native, const dal_run *run,
                                        const dal_native_options *options, dal_error *error)
{
    DAL_REQUIRE(native, error);
    *native = NULL;
    DAL_REQUIRE(run, error);
    return begin(native, DAL__PRODUCT_OBSERVE, 8, &run->layout, run, options, error);
}

dal_status dal_native_begin_batch(dal_native **native, const dal_batch *batch,
                                  const dal_native_options *options, dal_error *error)
{
    DAL_REQUIRE(native, error);
    *native = NULL;
    DAL_REQUIRE(batch, error);
    return begin(native, DAL__PRODUCT_LANES, dal__batch_native_lanes(batch),
                 dal__batch_layout(batch), NULL, options, error);
}

/* ---- which runs it is for ---- */

/* Whether steps of the same text are taken, of whatever size. */
static bool has_same_steps(const dal__layout *a, const dal__layout *b)
{
    const dal_options *x = &a->options, *y = &b->options;
    bool same = a->system == b->system && a->depth == b->depth;
    for (int i = 0; same && i < a->depth; i++) same = a->method.layer[i] == b->method.layer[i];
#define OPTION(type, name, word, ...) same &= x->name == y->name || strcmp(word, "step") == 0;
    DAL_OPTION_LIST(OPTION)
#undef OPTION
    return same;
}

static bool has_same_observables(const dal_native *native, const dal_run *run)
{
    return native->layout.system == run->layout.system &&
           native->layout.lifted == run->layout.lifted && native->exact == run->exact &&
           native->layout.options.reactions == run->layout.options.reactions;
}

bool dal_native_fits(const dal_native *native, const dal_run *run)
{
    if (!native || !run || native->product == DAL__PRODUCT_LANES) return false;
    return native->product == DAL__PRODUCT_OBSERVE ? has_same_observables(native, run)
                                                   : has_same_steps(&native->layout, &run->layout);
}

static dal_status check_use(const dal_native *native, bool fits, dal_error *error)
{
    if (native->state != DAL_NATIVE_READY)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the compiled code is not ready");
    if (!fits) return dal__fail(error, DAL_STATUS_ARGUMENT, "the compiled code is for other steps");
    return DAL_STATUS_OK;
}

/* ---- runs ---- */

bool dal_run_is_native(const dal_run *run) { return run && run->native.traced != NULL; }

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
    if (!memory)
        return dal__fail(error, DAL_STATUS_MEMORY, "no memory for %d observations", capacity);
    memset(memory, 0, bytes);
    observations->capacity = capacity;
    observations->states = memory;
    observations->times = memory + (size_t)dimension * (size_t)capacity;
    observations->values = observations->times + capacity;
    return DAL_STATUS_OK;
}

/* The code without its handle, which stays with its owner. */
static dal__native_code borrow(const dal_native *native)
{
    dal__native_code code = native->code;
    code.release = NULL;
    return code;
}

static dal_status use_in_run(dal_run *run, const dal_native *native, dal__native_code code,
                             dal_error *error)
{
    const int observables = dal_run_observables(run);
    DAL_TRY(check_use(native, dal_native_fits(native, run), error));
    if (native->product == DAL__PRODUCT_TRACE) {
        if (!dal_run_is_native(run)) run->native = code;
    } else if (!run->observations.states && observables > 0) {
        DAL_TRY(allocate_observations(&run->observations, run->layout.dim, observables, error));
        run->observations.code = code;
    }
    return DAL_STATUS_OK;
}

dal_status dal_run_use_native(dal_run *run, const dal_native *native, dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(native, error);
    return use_in_run(run, native, borrow(native), error);
}

/* ---- batches ---- */

static dal_status use_in_batch(dal_batch *batch, const dal_native *native, dal__native_code code,
                               dal_error *error)
{
    const int lanes = dal__batch_native_lanes(batch);
    const bool fits = native->product == DAL__PRODUCT_LANES && native->lanes == lanes &&
                      has_same_steps(&native->layout, dal__batch_layout(batch));
    DAL_TRY(check_use(native, fits, error));
    return dal_batch_is_native(batch) ? DAL_STATUS_OK
                                      : dal__batch_install(batch, lanes, &code, error);
}

dal_status dal_batch_use_native(dal_batch *batch, const dal_native *native, dal_error *error)
{
    DAL_REQUIRE(batch, error);
    DAL_REQUIRE(native, error);
    return use_in_batch(batch, native, borrow(native), error);
}

/* ---- at once ---- */

/* Waits for code that was begun, and gives it to a run or to a batch, which own it then. */
static dal_status wait_and_give(dal_native *native, const dal_native_options *options, dal_run *run,
                                dal_batch *batch, dal_error *error)
{
    dal_status status = wait_for(native, options, error);
    if (status == DAL_STATUS_OK)
        status = run ? use_in_run(run, native, native->code, error)
                     : use_in_batch(batch, native, native->code, error);
    if (status == DAL_STATUS_OK) native->code.release = NULL;
    dal_native_free(native);
    return status;
}

dal_status dal_run_native(dal_run *run, const dal_native_options *options, dal_error *error)
{
    dal_native *native;
    DAL_REQUIRE(run, error);
    if (dal_run_is_native(run)) return DAL_STATUS_OK;
    DAL_TRY(dal_native_begin(&native, run, options, error));
    return wait_and_give(native, options, run, NULL, error);
}

dal_status dal_run_native_observables(dal_run *run, const dal_native_options *options,
                                      dal_error *error)
{
    dal_native *native;
    DAL_REQUIRE(run, error);
    if (run->observations.states || dal_run_observables(run) == 0) return DAL_STATUS_OK;
    DAL_TRY(dal_native_begin_observables(&native, run, options, error));
    return wait_and_give(native, options, run, NULL, error);
}

dal_status dal_batch_native(dal_batch *batch, const dal_native_options *options, dal_error *error)
{
    dal_native *native;
    DAL_REQUIRE(batch, error);
    if (dal_batch_is_native(batch)) return DAL_STATUS_OK;
    DAL_TRY(dal_native_begin_batch(&native, batch, options, error));
    return wait_and_give(native, options, NULL, batch, error);
}
