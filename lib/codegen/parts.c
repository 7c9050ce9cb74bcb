/* parts.c - which parts of the kernel a generated file has, and their text. */
#include "codegen/parts.h"
#include "codegen/preprocessor.h"
#include <string.h>

/* ---- sources ---- */

/* The text of a source, which is one of the list. */
static const char *source_text(const char *name)
{
    const dal__source *k = dal__sources;
    while (strcmp(k->name, name) != 0) k++;
    return k->text;
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
    {"lanes.h", ALWAYS, 0},
    {"step.h", ALWAYS, 0},
    {"algebra.h", DAL_KERNEL_ALGEBRA, 0},
    {"acceptance.h", ALWAYS, 0},
    {"adaptive.h", DAL_KERNEL_CONTROL, 0},
    {"series.h", DAL_KERNEL_SERIES, DAL_KERNEL_FUNCTIONS},
    {"taylor.h", DAL_KERNEL_SERIES, 0},
    {"eigensystem.h", DAL_KERNEL_SOLVE, DAL_KERNEL_ALGEBRA},
    {"choice.h", DAL_KERNEL_SOLVE, 0},
    {"solve.h", DAL_KERNEL_SOLVE, DAL_KERNEL_ALGEBRA},
    {"tableau.h", DAL_KERNEL_COLLOCATION | DAL_KERNEL_EULER, 0},
    {"gauge.h", DAL_KERNEL_COLLOCATION | DAL_KERNEL_EULER, 0},
    {"symplectic_euler.h", DAL_KERNEL_EULER, DAL_KERNEL_SOLVE},
    {"collocation.h", DAL_KERNEL_COLLOCATION, DAL_KERNEL_SOLVE},
    {"composition.h", DAL_KERNEL_COMPOSITION, 0},
    {"blocks.h", DAL_KERNEL_BLOCKS, 0},
    {"constrained.h", DAL_KERNEL_ENFORCE, DAL_KERNEL_BLOCKS | DAL_KERNEL_SOLVE},
    {"spark.h", DAL_KERNEL_SPARK,
     DAL_KERNEL_ENFORCE | DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_REACTION},
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

void dal__write_source(dal__generation *g, const char *name)
{
    dal__preprocess(g, source_text(name));
}

void dal__write_kernel(dal__generation *g)
{
    for (int i = 0; i < PARTS; i++)
        if (parts[i].part == ALWAYS || g->kernel & parts[i].part)
            dal__write_source(g, parts[i].file);
}
