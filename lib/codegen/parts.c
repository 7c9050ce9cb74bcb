/* parts.c - which parts of the kernel a generated file has, and their text; see parts.h. */
#include "codegen/parts.h"
#include <string.h>

/* ---- sources ---- */

static const char *source_text(const char *name)
{
    for (const dal__source *k = dal__sources; k->name; k++)
        if (strcmp(k->name, name) == 0) return k->text;
    return "";
}

#define INTEGRATOR(name, file) extern const dal_integrator dal_integrator_##name;
#include "../../integrators/integrators.def"
#undef INTEGRATOR

static const struct {
    const dal_integrator *integrator;
    const char *identifier, *file;
} integrators[] = {
#define INTEGRATOR(name, file) {&dal_integrator_##name, #name, #file ".c"},
#include "../../integrators/integrators.def"
#undef INTEGRATOR
};

bool dal__find_source(const dal_integrator *integrator, const char **identifier, const char **text)
{
    for (size_t i = 0; i < sizeof integrators / sizeof *integrators; i++) {
        if (integrators[i].integrator != integrator) continue;
        *identifier = integrators[i].identifier;
        *text = source_text(integrators[i].file);
        return true;
    }
    return false;
}

/* ---- parts ---- */

enum { ALWAYS = 0 };

/* In the order of a file; a part may use those before it. */
static const struct {
    const char *file;
    unsigned part, uses;
} parts[] = {
    {"num.h", ALWAYS, 0},
    {"elementary.h", DAL_KERNEL_FUNCTIONS, 0},
    {"persistent.h", ALWAYS, 0},
    {"step.h", ALWAYS, 0},
    {"algebra.h", DAL_KERNEL_ALGEBRA, 0},
    {"acceptance.h", ALWAYS, 0},
    {"adaptive.h", DAL_KERNEL_CONTROL, 0},
    {"series.h", DAL_KERNEL_SERIES, DAL_KERNEL_FUNCTIONS},
    {"taylor.h", DAL_KERNEL_SERIES, 0},
    {"choice.h", DAL_KERNEL_SOLVE, 0},
    {"eigensystem.h", DAL_KERNEL_SOLVE, DAL_KERNEL_ALGEBRA},
    {"solve.h", DAL_KERNEL_SOLVE, DAL_KERNEL_ALGEBRA},
    {"symplectic_euler.h", DAL_KERNEL_EULER, DAL_KERNEL_SOLVE},
    {"tableau.h", DAL_KERNEL_COLLOCATION, 0},
    {"collocation.h", DAL_KERNEL_COLLOCATION, DAL_KERNEL_SOLVE},
    {"composition.h", DAL_KERNEL_COMPOSITION, 0},
    {"blocks.h", DAL_KERNEL_BLOCKS, 0},
    {"constrained.h", DAL_KERNEL_ENFORCE, DAL_KERNEL_BLOCKS | DAL_KERNEL_SOLVE},
    {"spark.h", DAL_KERNEL_SPARK, DAL_KERNEL_ENFORCE | DAL_KERNEL_CONSTRAINT},
};
enum { PARTS = sizeof parts / sizeof *parts };

unsigned dal__kernel_closure(unsigned used)
{
    for (int i = PARTS - 1; i >= 0; i--)
        if (used & parts[i].part) used |= parts[i].uses;
    return used;
}

unsigned dal__kernel_of(const dal_method *method)
{
    unsigned used = 0;
    for (int i = 0; i < DAL_LAYERS && method->layer[i]; i++) used |= method->layer[i]->kernel;
    return dal__kernel_closure(used);
}

void dal__write_kernel(dal__generation *g)
{
    for (int i = 0; i < PARTS; i++)
        if (parts[i].part == ALWAYS || g->kernel & parts[i].part)
            dal__write_source(g, parts[i].file);
}

/* ---- conditions ---- */

enum { UNKNOWN = -1 };

/* The value of a name, 0 or 1, of the length given. */
static int value_of(const dal__generation *g, const char *name, size_t length)
{
    for (int i = 0; i < g->conditions; i++)
        if (strlen(g->condition[i].name) == length &&
            strncmp(g->condition[i].name, name, length) == 0)
            return g->condition[i].value != 0;
    return UNKNOWN;
}

/* NAME, !NAME, and several of these with && between: UNKNOWN where it is anything else. */
static int evaluate(const dal__generation *g, const char *at)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    int all = 1;
    for (;;) {
        while (*at == ' ') at++;
        const bool negated = *at == '!';
        at += negated;
        const size_t length = strspn(at, letters);
        const int value = value_of(g, at, length);
        if (value == UNKNOWN) return UNKNOWN;
        all &= value ^ negated;
        at += length;
        while (*at == ' ') at++;
        if (*at == '\n') return all;
        if (strncmp(at, "&&", 2) != 0) return UNKNOWN;
        at += 2;
    }
}

static bool begins(const char *line, const char *word)
{
    return strncmp(line, word, strlen(word)) == 0;
}

/* The value of a line #if, #ifdef, #ifndef or #elif. */
static int decide(const dal__generation *g, const char *line)
{
    const bool negated = begins(line, "#ifndef");
    const int value = evaluate(g, line + strcspn(line, " "));
    return negated && value != UNKNOWN ? !value : value;
}

/* An open #if: its value, whether the lines around it and in its present branch are written. */
typedef struct branch {
    int value;
    bool around, on;
} branch;

/* An #if or #elif of a chain of which no branch is taken yet. */
static void decide_branch(const dal__generation *g, const char *line, branch *b)
{
    b->value = decide(g, line);
    b->on = b->around && b->value != 0;
}

/* Whether the compiler has to decide a directive; keeps the open branches. */
static bool passes(const dal__generation *g, const char *line, branch *open, int *depth)
{
    branch *b = &open[*depth];
    if (begins(line, "#if")) {
        open[++*depth].around = b->on;
        decide_branch(g, line, ++b);
    } else if (begins(line, "#endif")) {
        --*depth;
    } else if (b->value == 1) {
        b->on = false;
    } else if (b->value == 0 && begins(line, "#elif")) {
        decide_branch(g, line, b);
    } else if (b->value == 0) {
        b->on = b->around;
    }
    return b->around && b->value == UNKNOWN;
}

/* Writes text up to end, with the prefix for the word PREFIX. */
static void write_until(dal__generation *g, const char *text, const char *end)
{
    static const char word[] = "PREFIX";
    for (const char *next; (next = strstr(text, word)) && next < end; text = next + strlen(word)) {
        dal__buffer_append_bytes(&g->text, text, (size_t)(next - text));
        dal__buffer_append(&g->text, g->prefix);
    }
    dal__buffer_append_bytes(&g->text, text, (size_t)(end - text));
}

void dal__write_template(dal__generation *g, const char *text)
{
    write_until(g, text, text + strlen(text));
}

void dal__write_item(dal__generation *g, const char *item)
{
    enum { WIDTH = 100 };
    size_t column = strlen(item) + 1;
    for (size_t i = g->text.length; i > 0 && g->text.bytes[i - 1] != '\n'; i--) column++;
    dal__buffer_append(&g->text, column > WIDTH ? "\n    " : " ");
    dal__buffer_append(&g->text, item);
}

void dal__write_selected(dal__generation *g, const char *text)
{
    enum { MAX_DEPTH = 16 };
    branch open[MAX_DEPTH] = {{UNKNOWN, true, true}};
    int depth = 0;
    for (size_t length; *text; text += length) {
        length = strcspn(text, "\n");
        length += text[length] == '\n';
        /* What follows branches that are dropped begins the chain. */
        const bool begins_chain = begins(text, "#elif") && open[depth].value == 0;
        const bool conditional =
            begins(text, "#if") || begins(text, "#el") || begins(text, "#endif");
        if (!(conditional ? passes(g, text, open, &depth) : open[depth].on)) continue;
        if (begins_chain) dal__buffer_append(&g->text, "#");
        write_until(g, begins_chain ? text + strlen("#el") : text, text + length);
    }
}

void dal__write_source(dal__generation *g, const char *name)
{
    dal__write_selected(g, source_text(name));
}
