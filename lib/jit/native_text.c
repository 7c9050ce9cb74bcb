/* native_text.c - the files compiled for runs and batches: steps only, or observables only.
 *
 * The observables have an object of their own, since they are evaluated for as many states at a
 * time as a register has lanes, whatever the steps do, and are the same for all methods. */
#include "jit/native_text.h"
#include "codegen/emit_callbacks.h"
#include "codegen/interface.h"

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

/* ---- steps ---- */

dal_status dal__generate_native(const dal_run_spec *spec, dal__product product, int lanes,
                                char **text, dal_error *error)
{
    dal__generation g = {.spec = spec, .lanes = lanes, .product = product};
    *text = NULL;
    DAL_TRY(dal__generation_check(&g, DAL__NATIVE_PREFIX, error));
    write_declarations(&g);
    dal__write_template(&g, product == DAL__TRACE
                                ? "long long PREFIX_traced(double *, const double *, double, long "
                                  "long, unsigned *, int *, double *, long long);\n"
                                : "long long PREFIX_lanes(double *, const double *, double, long "
                                  "long, unsigned, unsigned *, int *);\n");
    dal__write_steps(&g);
    return dal__generation_finish(&g, text, error);
}

/* ---- observables ---- */

/* A register full of lanes; the parameters are those of one lane. */
static const char lanes[] = "#define DAL_SPECIALISED 1\n"
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
                      "enum { DAL__N = %d, DAL__NW = %d, DAL__DIM = %d, DAL__LIFTED = %d, "
                      "DAL__OBSERVABLES = %d };\n",
                      k->n, k->nw, k->dim, k->lifted, dal_run_observables(g->run));
}

dal_status dal__generate_observables(const dal__layout *layout, const dal_run *run, char **text,
                                     dal_error *error)
{
    dal__generation g = {.run = run, .layout = *layout, .lanes = 8, .product = DAL__OBSERVE};
    *text = NULL;
    if (layout->options.precision != DAL_DOUBLE)
        return dal__fail(error, DAL_UNSUPPORTED, "observables in quad precision are not generated");
    DAL_TRY(dal__generation_check(&g, DAL__NATIVE_PREFIX, error));
    write_declarations(&g);
    dal__write_template(
        &g, "void PREFIX_observables(const double *, long long, long long, const double *, "
            "double *);\n");
    dal__write_compiler(&g);
    dal__buffer_append(&g.text, lanes);
    write_sizes(&g);
    dal__buffer_append(&g.text, dal__source_text("num.h"));
    dal__buffer_append(&g.text, dal__source_text("elementary.h"));
    dal__emit_callbacks(&g);
    if (g.layout.lifted) dal__buffer_append(&g.text, dal__source_text("observe_lift.inc"));
    dal__write_observe(&g);
    dal__write_template(&g, dal__source_text("observables.inc"));
    return dal__generation_finish(&g, text, error);
}
