/* interface.c - what the caller of a generated file sees: usage, declarations, names. */
#include "codegen/interface.h"
#include "codegen/parts.h"
#include "codegen/preprocessor.h"
#include "dalembert.h"
#include <stdio.h>
#include <string.h>

/* A text of the user in a comment: one line that does not end the comment. */
static void write_comment(dal__buffer *text, const char *words)
{
    for (char before = '\0'; words && *words; before = *words++) {
        const bool ends = (before == '*' && *words == '/') || (before == '/' && *words == '*');
        const bool plain = (unsigned char)*words >= ' ' && *words != '\\' && *words != '?' && !ends;
        dal__buffer_append_bytes(text, plain ? words : " ", 1);
    }
}

/* Words that cannot name a member: keywords of C and C++, and macros of the headers. */
static const char *const reserved[] = {
    "alignas",     "alignof",    "and",          "and_eq",
    "asm",         "auto",       "bitand",       "bitor",
    "bool",        "break",      "case",         "catch",
    "char",        "class",      "compl",        "concept",
    "const",       "continue",   "decltype",     "default",
    "delete",      "do",         "double",       "else",
    "enum",        "explicit",   "export",       "extern",
    "false",       "float",      "for",          "friend",
    "goto",        "if",         "inline",       "int",
    "long",        "mutable",    "namespace",    "new",
    "noexcept",    "not",        "not_eq",       "nullptr",
    "operator",    "or",         "or_eq",        "private",
    "protected",   "public",     "register",     "requires",
    "restrict",    "return",     "short",        "signed",
    "sizeof",      "static",     "struct",       "switch",
    "template",    "this",       "throw",        "true",
    "try",         "typedef",    "typeid",       "typename",
    "typeof",      "union",      "unsigned",     "using",
    "virtual",     "void",       "volatile",     "while",
    "xor",         "xor_eq",     "constexpr",    "linux",
    "unix",        "i386",       "errno",        "near",
    "far",         "step",       "dal_inner",    "NULL",
    "NAN",         "INFINITY",   "OVERFLOW",     "UNDERFLOW",
    "DOMAIN",      "SING",       "PLOSS",        "TLOSS",
    "HUGE",        "assert",     "thread_local", "static_assert",
    "static_cast", "const_cast", "dynamic_cast", "reinterpret_cast",
    "wchar_t",     "char16_t",   "char32_t",     "co_await",
    "co_return",   "co_yield",
};
static const char *const reserved_beginnings[] = {"DAL_",   "M_",    "FP_",      "HUGE_", "INT",
                                                  "UINT",   "SIZE_", "PTRDIFF_", "MATH_", "math_",
                                                  "WCHAR_", "WINT_", "SIG_"};

static bool is_reserved(const char *name)
{
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++)
        if (strcmp(name, reserved[i]) == 0) return true;
    for (size_t i = 0; i < sizeof reserved_beginnings / sizeof *reserved_beginnings; i++)
        if (strncmp(name, reserved_beginnings[i], strlen(reserved_beginnings[i])) == 0) return true;
    return false;
}

/* The member for parameter i; "_parameter_" and its number follow a reserved name. */
static void write_member(dal__generation *g, int i)
{
    const char *name = g->layout.system->parameter[i];
    dal__buffer_append(&g->text, name);
    if (is_reserved(name)) dal__buffer_print(&g->text, "_parameter_%d", i + 1);
}

static const char usage[] =
    " *\n"
    " *     PREFIX_state state;                    a plain struct, no pointers in it\n"
    " *     PREFIX_parameters p = PREFIX_defaults();\n"
    " *     PREFIX_start(&state, &p);              at its time; NULL: the defaults\n"
    " *     if (PREFIX_advance(&state, h, 1000))   1000 steps of size h\n"
    " *         puts(PREFIX_text(state.status[0]));\n"
    " *     double out[PREFIX_OBSERVABLES * PREFIX_LANES];\n"
    " *     PREFIX_observe(&state, out);           named by PREFIX_observable[]\n"
    " *\n"
    " * state.y begins with the state, PREFIX_DIMENSION numbers named by PREFIX_component[]; "
    "number\n"
    " * i of a lane is y[i * PREFIX_LANES + lane], and so with all arrays.  A copy of the struct "
    "is\n"
    " * a checkpoint.  A step succeeds or leaves its lane as it was and returns a status; a lane\n"
    " * with a status does not move until started again (with one lane: until the next call).\n"
    " * Change y only before the first step; PREFIX_set sets parameters, and begins the method "
    "again.\n"
    " *\n"
    " *     cc -O3 -march=native -fno-math-errno -c FILE.c    as C11 or C++17; needs libm alone\n"
    " *\n"
    " * Without -march=native, or -mfma, a fused multiply-add on x86-64 is a slow call of libm.\n"
    " * From another file: #define PREFIX_HEADER, then #include this one: declarations only.\n"
    " * The bits are dalembert's own, whatever the compiler and its options; -ffast-math\n"
    " * is refused. */\n";

static void write_head(dal__generation *g)
{
    const dal_system *system = g->layout.system;
    char method[128];
    dal__buffer *text = &g->text;
    dal__write_template(g, "/* PREFIX - ");
    write_comment(text, system->title ? system->title : system->name);
    dal__buffer_print(text,
                      "\n *\n * %s, %s space, %d lane%s; generated by dalembert " DAL_VERSION ".\n",
                      dal_method_name(&g->layout.method, method, sizeof method),
                      g->layout.lifted ? "lifted" : "physical", g->lanes, g->lanes > 1 ? "s" : "");
    if (system->reference) {
        dal__buffer_append(text, " * ");
        write_comment(text, system->reference);
        dal__buffer_append(text, "\n");
    }
    dal__write_template(g, usage);
}

static void write_sizes(dal__generation *g)
{
    const dal__layout *k = &g->layout;
    dal__write_template(g, "#ifndef PREFIX_DECLARED\n#define PREFIX_DECLARED\nenum {\n   ");
    const struct {
        const char *name;
        int value;
    } list[] = {
        {"LANES", g->lanes},
        {"COORDINATES", k->n},
        {"DIMENSION", k->dim},
        {"PARAMETERS", k->system->parameters},
        {"OBSERVABLES", dal_run_observables(g->run)},
        {"PERSISTENT", (int)k->persistent},
        {"WORK", (int)g->programs->tapes->first_input},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        char item[DAL__PREFIX_SIZE + 32];
        snprintf(item, sizeof item, "%s_%s = %d,", g->prefix, list[i].name, list[i].value);
        dal__write_item(g, item);
    }
    dal__buffer_append(&g->text, "\n};\n");
}

/* The functions of a point; by the parameters of a state, which they do not move. */
static void write_point_functions(dal__generation *g)
{
    static const struct {
        dal__program_code code;
        const char *name, *comment;
    } list[] = {
        {DAL__PROGRAM_FIELD, "field", "F of dv/dt = F(q, v, t)"},
        {DAL__PROGRAM_JACOBIAN, "jacobian", "F_q, then F_v, row by row"},
        {DAL__PROGRAM_CONSTRAINT, "constraint", "D, A = D_v [m*n], W^-1 A^T [n*m]"},
        {DAL__PROGRAM_ENERGY_NORMAL, "energy", "E, E_q, E_v, W^-1 E_q"},
    };
    if (g->with_field)
        dal__buffer_append(&g->text, "/* Of a point, with the parameters of the state; 0, or a "
                                     "status where a number is not finite. */\n");
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        if (dal__has_function(g, list[i].code)) {
            dal__write_template(g, "int PREFIX_");
            dal__buffer_append(&g->text, list[i].name);
            dal__write_template(g, "(const PREFIX_state *state, double t, const double *q, const "
                                   "double *v,\n    double *out); ");
            dal__buffer_print(&g->text, "/* %s */\n", list[i].comment);
        }
}

static void write_structs(dal__generation *g)
{
    dal__write_template(g, "typedef struct PREFIX_parameters {\n");
    for (int i = 0; i < g->layout.system->parameters; i++) {
        dal__buffer_append(&g->text, "    double ");
        write_member(g, i);
        dal__buffer_append(&g->text, ";\n");
    }
    if (g->layout.system->parameters == 0) dal__buffer_append(&g->text, "    double none;\n");
    dal__write_template(
        g, "} PREFIX_parameters;\n"
           "typedef struct PREFIX_state {\n"
           "    double y[PREFIX_PERSISTENT * PREFIX_LANES]; /* the state, then what a step carries "
           "*/\n"
           "    double work[(PREFIX_WORK > 0 ? PREFIX_WORK : 1) * PREFIX_LANES]; /* parameters */\n"
           "    int status[PREFIX_LANES]; /* 0: goes on */\n"
           "} PREFIX_state;\n"
           "#ifdef __cplusplus\nextern \"C\" {\n#endif\n"
           "extern const char *const PREFIX_component[PREFIX_DIMENSION];\n"
           "extern const char *const PREFIX_parameter[PREFIX_PARAMETERS + 1];\n"
           "extern const char *const PREFIX_observable[PREFIX_OBSERVABLES + 1];\n"
           "const char *PREFIX_text(int status);\n"
           "PREFIX_parameters PREFIX_defaults(void);\n"
           "int PREFIX_start(PREFIX_state *state, const PREFIX_parameters *parameters);\n"
           "int PREFIX_start_lane(PREFIX_state *state, int lane, const PREFIX_parameters "
           "*parameters);\n"
           "void PREFIX_set(PREFIX_state *state, int lane, const PREFIX_parameters *parameters);\n"
           "int PREFIX_step(PREFIX_state *state, double h);\n"
           "int PREFIX_advance(PREFIX_state *state, double h, long long count);\n"
           "double PREFIX_time(const PREFIX_state *state, int lane);\n"
           "void PREFIX_observe(const PREFIX_state *state, double *out);\n");
    write_point_functions(g);
    dal__write_template(
        g, "/* The inside of PREFIX_advance: up to count steps of the lanes in the mask, until one "
           "fails;\n"
           " * the number of steps tried.  The lanes in *failed did not make the last one; "
           "reason[lane]. "
           "*/\n"
           "long long PREFIX_lanes(double *y, const double *work, double h, long long count,\n"
           "                       unsigned lanes, unsigned *failed, int *reason);\n"
           "#ifdef __cplusplus\n}\n#endif\n#endif\n\n");
}

void dal__write_interface(dal__generation *g)
{
    write_head(g);
    write_sizes(g);
    write_structs(g);
}

/* ---- the prefix of public names ---- */

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* Whether a name could be one of the kernel. */
static bool is_kernels(const char *prefix)
{
    static const char *const names[] = {"dal", "DAL"};
    for (int i = 0; i < 2; i++)
        if (strncmp(prefix, names[i], 3) == 0 && (prefix[3] == '_' || !prefix[3])) return true;
    return false;
}

static bool is_letter(char c) { return is_word(c) && c != '_' && !(c >= '0' && c <= '9'); }

/* SYSTEM_METHOD, whatever the system is called. */
static void default_prefix(dal__generation *g)
{
    char method[DAL__PREFIX_SIZE];
    const char *name = g->layout.system->name ? g->layout.system->name : "system";
    const bool odd = !is_letter(name[0]) || is_kernels(name);
    snprintf(g->prefix, sizeof g->prefix, "%s%.25s_%.30s", odd ? "of_" : "", name,
             dal_method_name(&g->layout.method, method, sizeof method));
    for (char *c = g->prefix; *c; c++)
        if (!is_word(*c)) *c = '_';
}

dal_status dal__choose_prefix(dal__generation *g, const char *prefix, dal_error *error)
{
    const char *fault = NULL;
    if (!prefix) {
        default_prefix(g);
        return DAL_STATUS_OK;
    }
    if (strlen(prefix) >= sizeof g->prefix)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "prefix '%.60s...' is too long", prefix);
    for (const char *c = prefix; *c; c++)
        if (!is_word(*c)) fault = "is not a C name";
    if (!fault && !is_letter(prefix[0])) fault = "does not begin with a letter";
    if (is_kernels(prefix) && g->product == DAL__PRODUCT_FILE) fault = "is the kernel's own";
    if (fault) return dal__fail(error, DAL_STATUS_ARGUMENT, "prefix '%s' %s", prefix, fault);
    snprintf(g->prefix, sizeof g->prefix, "%s", prefix);
    return DAL_STATUS_OK;
}

/* ---- names and values, at the end ---- */

typedef char *name_function(const dal_run *run, int i, char *buffer, size_t size);

static char *parameter_name(const dal_run *run, int i, char *buffer, size_t size)
{
    const dal_system *system = dal_run_system(run);
    if (i >= system->parameters) return NULL;
    snprintf(buffer, size, "%s", system->parameter[i]);
    return buffer;
}

static void write_list(dal__generation *g, const char *declaration, name_function *name)
{
    char buffer[160];
    dal__write_template(g, declaration);
    dal__buffer_append(&g->text, " = {\n   ");
    for (int i = 0; name(g->run, i, buffer, sizeof buffer); i++) {
        char item[sizeof buffer + 4];
        snprintf(item, sizeof item, "\"%s\",", buffer);
        dal__write_item(g, item);
    }
    if (name != dal_run_component_name) dal__write_item(g, "0,");
    dal__buffer_append(&g->text, "\n};\n");
}

static void write_text_function(dal__generation *g)
{
    dal__write_template(g, "const char *PREFIX_text(int status)\n{\n    switch (status) {\n");
#define STATUS(code, words)                                                                        \
    if (dal__is_status_of_step(DAL_STATUS_##code))                                                 \
        dal__buffer_append(&g->text, "    case DAL_STATUS_" #code ": return \"" words "\";\n");
    DAL_STATUS_LIST(STATUS)
#undef STATUS
    dal__buffer_append(&g->text, "    default: return \"unknown status\";\n    }\n}\n");
}

static void write_defaults(dal__generation *g)
{
    const double *value = dal_run_parameters(g->run);
    const int count = g->layout.system->parameters;
    dal__write_template(g, "PREFIX_parameters PREFIX_defaults(void)\n{\n"
                           "    PREFIX_parameters p;\n");
    for (int i = 0; i < count; i++) {
        dal__buffer_append(&g->text, "    p.");
        write_member(g, i);
        dal__buffer_append(&g->text, " = ");
        dal__buffer_number(&g->text, value[i]);
        dal__buffer_append(&g->text, ";\n");
    }
    if (count == 0) dal__buffer_append(&g->text, "    p.none = 0.0;\n");
    dal__buffer_append(&g->text, "    return p;\n}\n");
}

void dal__write_names(dal__generation *g)
{
    write_list(g, "const char *const PREFIX_component[PREFIX_DIMENSION]", dal_run_component_name);
    write_list(g, "const char *const PREFIX_parameter[PREFIX_PARAMETERS + 1]", parameter_name);
    write_list(g, "const char *const PREFIX_observable[PREFIX_OBSERVABLES + 1]",
               dal_run_observable_name);
    write_text_function(g);
    write_defaults(g);
}
