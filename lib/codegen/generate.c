/* generate.c - one self-contained C file for one system, method and space; see generate.h. */
#include "codegen/generate.h"
#include "codegen/emit_callbacks.h"
#include "codegen/interface.h"
#include "codegen/parts.h"
#include "codegen/preprocessor.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/sizes.h"
#include "dalembert_codegen.h"
#include "expr/taylor_emit.h"
#include "run/run.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Newton's matrices, and Taylor series, are on the stack. */
enum { MAX_STACK = 1 << 22 };
/* Loops over components are unrolled up to this size of a state, and up to these products of stages
 * and components, one lane or more. */
enum { MAX_UNROLLED_DIM = 64, MAX_UNROLLED = 15, MAX_UNROLLED_LANES = 32 };

/* ---- checks ---- */

static dal_status check_method(dal__generation *g, dal_error *error)
{
    for (int i = 0; i < g->layout.depth; i++) {
        const dal_integrator *layer = g->layout.method.layer[i];
        if (!dal__find_source(layer, &g->identifier[i], &g->source[i]))
            return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                             "'%s' is not an integrator of the library: its source is not known",
                             layer->name ? layer->name : "?");
        for (int j = 0; j < i; j++)
            if (g->source[j] == g->source[i])
                return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                                 "'%s' twice in a method cannot be generated", layer->name);
    }
    return DAL_STATUS_OK;
}

/* Series in the memory of a step; one more is for the alignment of those after the slots. */
static int count_series(const dal__generation *g)
{
    const dal__taylor *taylor = g->programs->taylor[g->layout.lifted];
    if (g->product == DAL__PRODUCT_OBSERVE || !(g->kernel & DAL_KERNEL_SERIES)) return 0;
    return taylor->slots + dal__taylor_extra(taylor, g->lanes, g->layout.taylor_order) + 1;
}

static dal_status check_size(const dal__generation *g, dal_error *error)
{
    const double series = 8.0 * g->lanes * count_series(g) * (g->layout.taylor_order + 1.0);
    const double width = (double)g->layout.stages * g->layout.nw;
    const bool newton = g->product != DAL__PRODUCT_OBSERVE && dal__uses_newton(g);
    const double stack = newton ? 4.0 * 8.0 * g->lanes * width * width : 0.0;
    if (stack > MAX_STACK)
        return dal__fail(error, DAL_STATUS_TOO_LARGE,
                         "Newton's matrices of '%.80s' take %.0f bytes of stack (%d at most); "
                         "solver fixed-point needs none",
                         g->layout.system->name, stack, MAX_STACK);
    /* Twice: before and after the pivots are checked. */
    const int outputs = g->programs->program[DAL__PROGRAM_JACOBIAN].outputs;
    if (g->with_field && 2.0 * 8.0 * g->lanes * outputs > MAX_STACK)
        return dal__fail(error, DAL_STATUS_TOO_LARGE,
                         "the Jacobian of '%.80s' takes %.0f bytes of stack (%d at most)",
                         g->layout.system->name, 2.0 * 8.0 * g->lanes * outputs, MAX_STACK);
    if (series > MAX_STACK)
        return dal__fail(error, DAL_STATUS_TOO_LARGE,
                         "the Taylor series of '%.80s' take %.0f bytes of stack (%d at most)",
                         g->layout.system->name, series, MAX_STACK);
    return DAL_STATUS_OK;
}

static dal_status check_steps(dal__generation *g, dal_error *error)
{
    if (g->spec->options.precision != DAL_DOUBLE)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "steps in quad precision are not generated");
    g->kernel = dal__kernel_of(&g->layout.method);
    if (dal__checks_rank_by_factors(&g->layout)) g->kernel |= DAL_KERNEL_ENFORCEMENT;
    return check_method(g, error);
}

/* Compiled observables read the state (q, v, ..) alone. */
static dal_status check_multipliers(const dal__generation *g, dal_error *error)
{
    const bool observes = g->product == DAL__PRODUCT_FILE || g->product == DAL__PRODUCT_OBSERVE;
    const bool is_exact_known = false; /* there is none of this kind */
    char name[128];
    if (!observes ||
        dal__observable_count(&g->layout, DAL__OBSERVE_MULTIPLIERS, is_exact_known) == 0)
        return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                     "the multipliers lambda1.. of %s are not observed in generated code",
                     dal_method_name(&g->layout.method, name, sizeof name));
}

dal_status dal__generation_check(dal__generation *g, const char *prefix, dal_error *error)
{
    if (g->lanes < 1 || g->lanes > 16 || (g->lanes & (g->lanes - 1)))
        return dal__fail(error, DAL_STATUS_ARGUMENT, "%d lanes: 1, 2, 4, 8 or 16 are possible",
                         g->lanes);
    if (g->product != DAL__PRODUCT_OBSERVE) DAL_TRY(dal__layout_init(&g->layout, g->spec, error));
    g->programs = dal__programs_of(g->layout.system);
    if (!g->programs)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "'%.80s' is not made from a model: its formulas are not known",
                         g->layout.system->name ? g->layout.system->name : "this system");
    if (g->product != DAL__PRODUCT_OBSERVE) DAL_TRY(check_steps(g, error));
    DAL_TRY(check_multipliers(g, error));
    DAL_TRY(check_size(g, error));
    return dal__choose_prefix(g, prefix, error);
}

/* ---- constants and conditions ---- */

/* Whether all groups of lanes are stepped as one larger system: where registers hold what a step
 * needs of two groups. */
static bool steps_together(const dal__generation *g)
{
    const dal_integrator *method = g->layout.method.layer[0];
    const bool few_stages = method->properties & DAL_EXTRAPOLATES_STAGES && method->stages <= 2;
    return g->lanes > 1 && g->layout.depth == 1 && !g->layout.lifted && !dal__is_controlled(g) &&
           !dal__checks_rank_by_factors(&g->layout) &&
           (method->properties & DAL_COMPONENTWISE || few_stages);
}

/* Whether steps compare numbers in units of the system. */
static bool has_units(const dal__generation *g)
{
    return g->product != DAL__PRODUCT_OBSERVE &&
           (dal__is_controlled(g) || g->kernel & DAL_KERNEL_SOLVE);
}

/* Measured (bench: unroll-*): a step that couples few stages and components is fastest with all of
 * its loops unrolled; beyond, GCC's vector loops take half the time of step and compiler, and
 * norms, which are chains of maxima otherwise, are taken in packs. */
static bool has_vector_loops(const dal__generation *g)
{
    const dal__layout *k = &g->layout;
    const bool coupled = g->kernel & DAL_KERNEL_COLLOCATION;
    const bool pushes = dal__wants(g, DAL__PROGRAM_EFFORT);
    const int width = k->lifted ? (3 + pushes) * k->n : k->nw;
    const int size = coupled ? g->layout.method.layer[0]->stages * width : 0;
    return size > (g->lanes == 1 ? MAX_UNROLLED : MAX_UNROLLED_LANES);
}

/* Whether norms are taken in packs. */
static bool has_packs(const dal__generation *g) { return g->lanes == 1 && has_vector_loops(g); }

/* The kinds of elementary functions that the programs in the file call. */
static unsigned calls_of_programs(const dal__generation *g)
{
    unsigned calls = dal__tape_calls(&g->programs->tapes->hoisted);
    for (int code = 0; code < DAL__PROGRAM_COUNT; code++)
        if (dal__wants(g, (dal__program_code)code))
            calls |= dal__tape_calls(&g->programs->tapes->tape[g->programs->program[code].tape]);
    return g->kernel & DAL_KERNEL_FUNCTIONS ? ~0u : calls;
}

/* Parts whose users call dal_clear_momenta. */
enum { PROJECTS = DAL_KERNEL_CONSTRAINT | DAL_KERNEL_CORRECTION | DAL_KERNEL_ENFORCEMENT };

void dal__decide_conditions(dal__generation *g)
{
    const unsigned calls = calls_of_programs(g);
    const bool rank = dal__checks_rank(g->layout.system), guards = g->layout.system->guards > 0;
    const bool gauge = dal__wants(g, DAL__PROGRAM_GAUGE_GRADIENT);
    g->kernel |= (calls ? DAL_KERNEL_FUNCTIONS : 0) | (rank ? DAL_KERNEL_ALGEBRA : 0);
    const unsigned kernel = g->kernel;
    const dal__condition list[] = {
        {"DAL_SPECIALISED", true},
        {"DAL_NUM_QUAD", false},
        {"DAL_LINKED", false},
        {"DAL_PACKS", has_packs(g)},
        {"DAL_SCALAR", g->lanes == 1},
        {"DAL_HAS_GROUPS", steps_together(g)},
        {"DAL_HAS_TIMES", dal__has_times(g)},
        /* sine and cosine, one of them, functions of libm, sign and the like, tables */
        {"DAL_WITH(SINCOS)", calls & (DAL__CALLS_SIN | DAL__CALLS_SINCOS)},
        {"DAL_WITH(SIN)", calls & DAL__CALLS_SIN},
        {"DAL_WITH(LIBM)", calls & DAL__CALLS_LIBM},
        {"DAL_WITH(BRANCHES)", calls & DAL__CALLS_BRANCHES},
        {"DAL_WITH(TABLES)", calls & DAL__CALLS_TABLES},
        /* the canonical variables, K that is not 1, e that changes, tangent vectors for p, pi */
        {"DAL_WITH(LIFT)", dal__has_lift(g)},
        {"DAL_WITH(EFFORT)", dal__wants(g, DAL__PROGRAM_EFFORT)},
        {"DAL_WITH(GAUGE_GRADIENT)", gauge},
        {"DAL_WITH(GAUGE)", g->layout.lifted && dal__wants(g, DAL__PROGRAM_GAUGE)},
        {"DAL_WITH(TANGENT)", kernel & DAL_KERNEL_TANGENT},
        /* implicit equations, their tableaus, series, substeps, units, a state of the method */
        {"DAL_WITH(SOLVE)", kernel & DAL_KERNEL_SOLVE},
        {"DAL_WITH(TABLEAU)", kernel & DAL_KERNEL_COLLOCATION || gauge},
        {"DAL_WITH(SERIES)", kernel & DAL_KERNEL_SERIES},
        {"DAL_WITH(CONTROL)", dal__is_controlled(g)},
        {"DAL_WITH(UNITS)", has_units(g)},
        {"DAL_WITH(METHOD_STATE)", kernel & DAL_KERNEL_METHOD_STATE},
        /* the constraints, dal_clear_momenta, g, what enforces D, callbacks for one group */
        {"DAL_WITH(CONSTRAINT)", kernel & DAL_KERNEL_CONSTRAINT},
        {"DAL_WITH(PROJECTION)", kernel & PROJECTS},
        {"DAL_WITH(HOLONOMIC)", dal__has_holonomic(g)},
        {"DAL_WITH(ENFORCEMENT)", kernel & DAL_KERNEL_ENFORCEMENT},
        {"DAL_WITH(EVAL_GROUP)", guards || rank || kernel & DAL_KERNEL_SOLVE},
        /* guards, the rank check, which compares pivots first, and one of these */
        {"DAL_WITH(GUARDS)", guards},
        {"DAL_WITH(RANK)", rank},
        {"DAL_WITH(RANK_BY_FACTORS)", dal__checks_rank_by_factors(&g->layout)},
        {"DAL_WITH(RANK_BY_MINORS)", rank && !dal__checks_rank_by_factors(&g->layout)},
        {"DAL_WITH(PIVOTS)", g->layout.pivots > 0},
        {"DAL_WITH(REGULAR)", guards || rank},
        /* the error to an exact solution, reactions, a trace of the states, functions of a point */
        {"DAL_WITH(EXACT)", g->run && g->run->exact},
        {"DAL_WITH(REACTIONS)", g->layout.options.reactions},
        {"DAL_WITH(TRACE)", g->product == DAL__PRODUCT_TRACE},
        {"DAL_WITH(POINTS)", g->with_field},
        {"DAL_WITH(POINT_JACOBIAN)", dal__has_function(g, DAL__PROGRAM_JACOBIAN)},
        {"DAL_WITH(POINT_CONSTRAINT)", dal__has_function(g, DAL__PROGRAM_CONSTRAINT)},
        {"DAL_WITH(POINT_ENERGY)", dal__has_function(g, DAL__PROGRAM_ENERGY_NORMAL)},
    };
    _Static_assert(sizeof list <= sizeof g->condition, "DAL__MAX_CONDITIONS is too small");
    g->conditions = sizeof list / sizeof *list;
    memcpy(g->condition, list, sizeof list);
}

static void write_callback_codes(dal__generation *g)
{
    dal__buffer_append(&g->text, "typedef enum dal_callback_code {");
#define PROGRAM(code, name, ...)                                                                   \
    if (dal__evaluates(g, DAL__PROGRAM_##code))                                                    \
        dal__buffer_append(&g->text, " DAL_EVAL_" #code ",");
    DAL_CALLBACK_LIST(PROGRAM)
#undef PROGRAM
    dal__buffer_append(&g->text, " } dal_callback_code;\n");
}

/* A register holds the lanes of a group. */
static void write_lanes(dal__generation *g)
{
    if (g->lanes == 1) {
        dal__buffer_append(&g->text, "#define DAL_WORK(place) w[place]\n"
                                     "enum { DAL_LANES = 1, DAL_GROUPS = 1, DAL_STEP_GROUPS = 1, "
                                     "DAL_STEP_COUNT = 1 };\n");
        return;
    }
    dal__buffer_print(&g->text, "#define DAL_LANES %d\n", g->lanes);
    dal__buffer_append(&g->text, "#if DAL_LANES > 8 && defined __AVX512F__\n#define DAL_GROUP 8\n"
                                 "#elif DAL_LANES > 4 && defined __AVX__ && !defined __AVX512F__\n"
                                 "#define DAL_GROUP 4\n"
                                 "#elif DAL_LANES > 2 && !defined __AVX__\n"
                                 "#define DAL_GROUP 2\n#endif\n");
    dal__write_source(g, "groups.h");
    dal__buffer_append(&g->text, "#define DAL_WORK(place) w[(place) * DAL_GROUPS]\n");
    dal__buffer_print(
        &g->text, "enum { DAL_STEP_GROUPS = %s, DAL_STEP_COUNT = DAL_GROUPS / DAL_STEP_GROUPS };\n",
        steps_together(g) ? "DAL_GROUPS" : "1");
}

static void write_number(dal__generation *g, const char *name, double value)
{
    dal__buffer_print(&g->text, "#define %s ", name);
    dal__buffer_number(&g->text, value);
    dal__buffer_append(&g->text, "\n");
}

/* The units of the system as constants; a list that is not needed is NULL. */
static void write_units(dal__generation *g)
{
    static const struct {
        const char *name;
        dal__unit_list list;
        const char *constants;
    } lists[] = {
        {"DAL_UNITS", DAL__UNITS_OF_STATE, "dal__units"},
        {"DAL_SPEEDS", DAL__UNITS_OF_SPEEDS, "(dal__units + DAL_FIXED_N)"},
        {"DAL_LEVELS", DAL__UNITS_OF_LEVELS, "(dal__units + DAL_FIXED_N + DAL_FIXED_NW)"},
    };
    const dal__layout *k = &g->layout;
    bool is_used = false;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        const bool has = dal__units(k, lists[i].list) != NULL;
        dal__buffer_print(&g->text, "#define %s(s) %s\n", lists[i].name,
                          has ? lists[i].constants : "((const double *)0)");
        is_used |= has;
    }
    dal__buffer_print(&g->text, "#define DAL_FIXED_SPEEDS %d\n",
                      dal__units(k, DAL__UNITS_OF_SPEEDS) != NULL);
    if (!is_used) return;
    dal__buffer_append(&g->text, "static const double dal__units[] __attribute__((unused)) = {");
    for (int i = 0; i < k->n + k->nw + k->m + 1; i++) {
        dal__buffer_append(&g->text, i == 0 ? "" : ", ");
        dal__buffer_number(&g->text, k->system->units[i]);
    }
    dal__buffer_append(&g->text, "};\n");
}

/* The number of series, their order, and the unit of time of their coefficients. */
static void write_series_constants(dal__generation *g)
{
    const dal__layout *k = &g->layout;
    dal__buffer_print(&g->text, "#define DAL_FIXED_SERIES %d\n", count_series(g));
    dal__buffer_print(&g->text, "#define DAL_FIXED_TAYLOR_ORDER %d\n", k->taylor_order);
    write_number(g, "DAL_FIXED_TOLERANCE_ROOT", k->tolerance_root);
    write_number(g, "DAL_FIXED_UNIT_OF_TIME", dal__unit_of_time(k->system));
}

static void write_constants(dal__generation *g)
{
    const dal__layout *k = &g->layout;
    const bool solves = g->kernel & (DAL_KERNEL_COLLOCATION | DAL_KERNEL_EULER);
    const bool is_explicit =
        dal_method_properties(&g->layout.method) & DAL_EXPLICIT && !dal__is_controlled(g);
    /* A single lane is stepped only while it is alive; an explicit step of several may include
     * lanes that are not. */
    const bool all_alive =
        g->lanes == 1 || (is_explicit && k->depth == 1 && !(solves && k->lifted));
    const struct {
        const char *name;
        int value;
        bool solver; /* needed with implicit equations alone */
    } list[] = {
        {"N", k->n, false},
        {"NW", k->nw, false},
        {"M", k->m, false},
        {"HOLONOMIC", k->system->holonomic, false},
        {"DIM", k->dim, false},
        {"LIFTED", k->lifted, false},
        {"EFFORT", dal__wants(g, DAL__PROGRAM_EFFORT), false},
        {"GAUGE", dal__wants(g, DAL__PROGRAM_GAUGE_GRADIENT), false},
        {"PLAIN", k->options.sums == DAL_SUMS_PLAIN, false},
        {"MULTIPLIER", k->multiplier, false},
        {"ACCELERATION", k->acceleration, false},
        {"TANGENT", dal__follows_tangents(g), false},
        {"ALL_ALIVE", all_alive, false},
        {"GUARDS", k->system->guards, false},
        {"RANK_CHECKED", dal__checks_rank(g->layout.system), false},
        {"STAGES", g->layout.method.layer[0]->stages, true},
        {"STAGE_DERIVATIVES", k->derivatives, true},
        {"SOLVER", k->options.solver, true},
        {"ITERATIONS", k->options.iterations, true},
        {"EXTRA_ITERATIONS", k->options.extra_iterations, true},
        {"PROPERTIES", (int)k->system->properties, true},
        {"NEWTON", dal__uses_newton(g), true},
        {"FIELD_OPERATIONS", k->field_operations, true},
        {"JACOBIAN_OPERATIONS", k->jacobian_operations, true},
    };
    enum { COUNT = sizeof list / sizeof *list };
    write_lanes(g);
    dal__buffer_append(&g->text, "enum {\n   ");
    for (int i = 0; i < COUNT; i++) {
        char item[48];
        snprintf(item, sizeof item, "DAL_FIXED_%s = %d,", list[i].name, list[i].value);
        if (!list[i].solver) dal__write_item(g, item);
    }
    char pivots[48];
    snprintf(pivots, sizeof pivots, "DAL__COUNT_PIVOTS = %d,", DAL__COUNT_PIVOTS(k));
    dal__write_item(g, pivots);
    dal__buffer_append(&g->text, "\n};\n");
    for (int i = 0; i < COUNT; i++)
        if (list[i].solver && g->kernel & DAL_KERNEL_SOLVE)
            dal__buffer_print(&g->text, "#define DAL_FIXED_%s %d\n", list[i].name, list[i].value);
    if (dal__is_controlled(g)) write_number(g, "DAL_FIXED_TOLERANCE", k->options.tolerance);
    if (g->kernel & DAL_KERNEL_SERIES) write_series_constants(g);
    if (g->kernel & DAL_KERNEL_SOLVE)
        write_number(g, "DAL_FIXED_SOLVER_TOLERANCE", k->options.solver_tolerance);
}

/* ---- the file ---- */

/* Functions that are inlined one into the other GCC optimises at each level; that takes it twice as
 * long as inlining all of them at once, into those with the attribute flatten.  Instructions are
 * scheduled before registers are allocated; doing so again, and allocating by regions, takes a
 * tenth of the compiler's time and gains nothing. */
static const char compiler[] =
    "#ifdef __FAST_MATH__\n"
    "#error \"the bits of a trajectory are promised: compile without -ffast-math\"\n"
    "#endif\n"
    "/* No contraction, whatever the command line says. */\n"
    "#if defined(__clang__)\n"
    "#pragma STDC FP_CONTRACT OFF\n"
    "#define DAL_INLINE static inline DAL_UNUSED __attribute__((always_inline))\n"
    "#else\n"
    "#pragma GCC push_options\n"
    "#pragma GCC optimize(\"fp-contract=off\", \"no-math-errno\", \"no-tree-slp-vectorize\", \\\n"
    "    \"schedule-insns\", \"sched-pressure\", \"no-schedule-insns2\", \"ira-region=one\")\n"
    "#define DAL_INLINE static inline DAL_UNUSED\n"
    "#endif\n"
    "#pragma GCC diagnostic push\n"
    "#pragma GCC diagnostic ignored \"-Wunused-parameter\"\n";

void dal__write_compiler(dal__generation *g)
{
    dal__buffer_append(&g->text, compiler);
    if (g->lanes == 1 && !(g->kernel & DAL_KERNEL_SOLVE) && !dal__is_controlled(g)) return;
    dal__buffer_append(
        &g->text,
        "#pragma GCC diagnostic ignored \"-Wpsabi\"\n"
        "#ifndef __clang__ /* lanes one by one; stages of the last trial or iteration */\n"
        "#pragma GCC diagnostic ignored \"-Wmaybe-uninitialized\"\n");
    if (has_packs(g)) /* a copy of a loop that is not entered */
        dal__buffer_append(&g->text, "#pragma GCC diagnostic ignored \"-Warray-bounds\"\n");
    dal__buffer_append(&g->text, "#endif\n");
}

static const char end[] = "#pragma GCC diagnostic pop\n"
                          "#ifndef __clang__\n"
                          "#pragma GCC pop_options\n"
                          "#endif\n"
                          "#endif /* PREFIX_HEADER */\n";

void dal__write_unrolling(dal__generation *g)
{
    const dal__layout *k = &g->layout;
    const bool vectors = has_vector_loops(g);
    dal__buffer_append(&g->text, "#if !defined(__clang__) && !defined(__OPTIMIZE_SIZE__)\n");
    if (vectors) dal__buffer_append(&g->text, "#pragma GCC optimize(\"O3\")\n");
    dal__buffer_append(&g->text, !vectors && k->dim <= MAX_UNROLLED_DIM
                                     ? "#define DAL_UNROLL _Pragma(\"GCC unroll 64\")\n"
                                     : "#define DAL_UNROLL\n");
    dal__buffer_append(&g->text, "#else\n#define DAL_UNROLL\n#endif\n");
}

/* The types of the public header that the kernel needs. */
static void write_enums(dal__generation *g)
{
    char item[64];
    dal__buffer_append(&g->text, "typedef enum dal_status {\n   ");
#define STATUS(code, words)                                                                        \
    if (dal__is_status_of_step(DAL_STATUS_##code)) {                                               \
        snprintf(item, sizeof item, "DAL_STATUS_" #code " = %d,", DAL_STATUS_##code);              \
        dal__write_item(g, item);                                                                  \
    }
    DAL_STATUS_LIST(STATUS)
#undef STATUS
    dal__buffer_append(&g->text, "\n} dal_status;\n");
    if (!(g->kernel & DAL_KERNEL_SOLVE)) return;
    dal__buffer_append(&g->text, "enum { DAL_SOLVER_AUTO, DAL_FIXED_POINT, DAL_NEWTON };\n");
    dal__buffer_print(&g->text,
                      "enum { DAL_D_LINEAR = %d, DAL_BLOCKS_POSITIONAL = %d, "
                      "DAL_MASS_ON_KERNEL = %d,\n       DAL_F_POSITIONAL = %d };\n",
                      DAL_D_LINEAR, DAL_BLOCKS_POSITIONAL, DAL_MASS_ON_KERNEL, DAL_F_POSITIONAL);
}

static void write_method(dal__generation *g)
{
    dal__buffer *text = &g->text;
    dal__buffer_append(text, "#define DAL_INTEGRATOR(identifier, function, ...) \\\n"
                             "    DAL_INLINE dal_status dal__of_##identifier(dal_step *s) "
                             "{ return function(s); } \\\n"
                             "    typedef dal_step dal__after_##identifier\n");
    for (int i = 0; i < g->layout.depth; i++) {
        if (i > 0) {
            dal__buffer_print(text,
                              "DAL_INLINE dal_status dal__inner_%d(dal_step *s, double h)\n"
                              "{\n    const double outer = s->h;\n    s->h = h;\n"
                              "    const dal_status status = dal__of_",
                              i);
            dal__buffer_append(text, g->identifier[i - 1]);
            dal__buffer_print(text,
                              "(s);\n    s->h = outer;\n    return status;\n}\n"
                              "#undef dal_inner\n#define dal_inner dal__inner_%d\n",
                              i);
        }
        dal__buffer_print(text, "#define step dal__step_%d\n", i);
        dal__preprocess(g, g->source[i]);
        dal__buffer_append(text, "#undef step\n");
    }
    dal__buffer_append(text, "#define dal__whole_step dal__of_");
    dal__buffer_append(text, g->identifier[g->layout.depth - 1]);
    dal__buffer_append(text, "\n");
}

void dal__write_steps(dal__generation *g)
{
    dal__decide_conditions(g);
    dal__write_compiler(g);
    dal__write_unrolling(g);
    write_constants(g);
    if (has_units(g)) write_units(g);
    write_enums(g);
    write_callback_codes(g);
    dal__write_kernel(g);
    dal__emit_callbacks(g);
    dal__write_source(g, "dispatch.inc");
    write_method(g);
    dal__write_source(g, "stepper.inc");
}

static void write_file(dal__generation *g)
{
    dal__write_interface(g);
    dal__write_template(g, "#ifndef PREFIX_HEADER\n#include <math.h>\n#include <stdbool.h>\n"
                           "#include <stddef.h>\n#include <stdint.h>\n#include <string.h>\n\n");
    dal__write_steps(g);
    dal__write_start(g);
    dal__write_source(g, "observables.h");
    dal__write_observe(g);
    dal__write_source(g, "interface.inc");
    dal__write_names(g);
    dal__write_template(g, end);
}

dal_status dal__generation_finish(dal__generation *g, char **text, dal_error *error)
{
    if (g->text.out_of_memory) {
        dal__buffer_free(&g->text);
        return dal__fail(error, DAL_STATUS_MEMORY, "no memory for a generated file");
    }
    *text = g->text.bytes;
    return DAL_STATUS_OK;
}

dal_status dal_generate(const dal_run_spec *spec, const dal_generate_options *options, char **text,
                        dal_error *error)
{
    DAL_REQUIRE(text, error);
    const dal_generate_options used = options ? *options : (dal_generate_options){.lanes = 1};
    dal__generation g = {
        .spec = spec, .lanes = used.lanes == 0 ? 1 : used.lanes, .with_field = used.with_field};
    *text = NULL;
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(dal__refuse_events(spec->system, "generated steps", error));
    DAL_TRY(dal__generation_check(&g, used.prefix, error));
    dal_run *run;
    DAL_TRY(dal_run_create(&run, spec, error));
    g.run = run;
    write_file(&g);
    dal_run_free(run);
    return dal__generation_finish(&g, text, error);
}
