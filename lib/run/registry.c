/* registry.c - the integrators of the library, and methods by name: BASE+MODIFIER+... */
#include "run/registry.h"

#include "core/settings.h"
#include "dalembert_run.h"

#include <string.h>

#define DECLARE(name, variant, lanes, set) extern const dal_integrator dal__wide_##name##_##variant;
#define INTEGRATOR(name, file)                                                                     \
    extern const dal_integrator dal_integrator_##name;                                             \
    DAL__VARIANT_LIST(DECLARE, name)
#include "integrators.def"
#undef INTEGRATOR

#define ADDRESS(name, variant, lanes, set) &dal__wide_##name##_##variant,
static const dal_integrator *const entries[][DAL__VARIANTS] = {
#define INTEGRATOR(name, file) {&dal_integrator_##name, DAL__VARIANT_LIST(ADDRESS, name)},
#include "integrators.def"
#undef INTEGRATOR
};

enum { COUNT = sizeof entries / sizeof *entries };

const dal_integrator *dal_integrator_at(int i)
{
    return i >= 0 && i < COUNT ? entries[i][DAL__VARIANT_x1] : NULL;
}

const dal_integrator *dal__integrator_wide(const dal_integrator *integrator, dal__variant variant)
{
    if (variant == DAL__VARIANT_x1 || DAL__VARIANTS == 1) return integrator;
    for (int i = 0; i < COUNT; i++)
        if (entries[i][DAL__VARIANT_x1] == integrator) return entries[i][variant];
    return NULL;
}

/* Finds an integrator, or a modifier, by name or alias. */
typedef enum layer_kind { INNERMOST, MODIFIER } layer_kind;

static dal_status find(const char *name, layer_kind kind, const dal_integrator **found,
                       dal_error *error)
{
    const char *names[2 * COUNT];
    for (int i = 0; i < COUNT; i++) {
        const dal_integrator *k = entries[i][DAL__VARIANT_x1];
        const bool fits = !(k->properties & DAL_MODIFIER) == (kind == INNERMOST);
        names[2 * i] = fits ? k->name : NULL;
        names[2 * i + 1] = fits ? k->alias : NULL;
        for (int j = 2 * i; j < 2 * i + 2; j++) {
            if (!names[j] || strcmp(names[j], name) != 0) continue;
            *found = k;
            return DAL_STATUS_OK;
        }
    }
    return dal__unknown(error, kind == MODIFIER ? "modifier" : "integrator", name, names,
                        2 * COUNT);
}

enum { NAME_SIZE = 64 };

/* Copies the name of a layer from *name up to the next '+' and moves past it; false: it is too
 * long. */
static bool next_layer(const char **name, char *word)
{
    const size_t length = strcspn(*name, "+");
    if (length >= NAME_SIZE) return false;
    memcpy(word, *name, length);
    word[length] = '\0';
    *name += length;
    return true;
}

dal_status dal_method_parse(dal_method *method, const char *name, dal_error *error)
{
    DAL_REQUIRE(method, error);
    DAL_REQUIRE(name, error);
    char word[NAME_SIZE];
    const char *rest = name;
    *method = (dal_method){{NULL}};
    for (int i = 0;; i++) {
        if (i == DAL_LAYERS)
            return dal__fail(error, DAL_STATUS_ARGUMENT, "integrator '%.60s': at most %d modifiers",
                             name, DAL_LAYERS - 1);
        if (!next_layer(&rest, word))
            return dal__fail(error, DAL_STATUS_NAME, "integrator name '%.60s...' is too long",
                             name);
        DAL_TRY(find(word, i > 0 ? MODIFIER : INNERMOST, &method->layer[i], error));
        for (int k = 1; k < i; k++)
            if (method->layer[k] == method->layer[i])
                return dal__fail(error, DAL_STATUS_ARGUMENT, "integrator '%.60s': +%s comes twice",
                                 name, method->layer[i]->name);
        if (*rest == '\0') return DAL_STATUS_OK;
        rest++;
    }
}

char *dal_method_name(const dal_method *method, char *buffer, size_t size)
{
    size_t used = 0;
    if (!method || !buffer) return NULL;
    if (size > 0) buffer[0] = '\0';
    for (int i = 0; i < DAL_LAYERS && method->layer[i]; i++) {
        const char *pieces[] = {i ? "+" : "",
                                method->layer[i]->name ? method->layer[i]->name : "?"};
        for (int j = 0; j < 2; j++) {
            const size_t length = strlen(pieces[j]);
            if (used + length + 1 > size) return buffer;
            memcpy(buffer + used, pieces[j], length + 1);
            used += length;
        }
    }
    return buffer;
}

int dal_method_order(const dal_method *method)
{
    int order = 0;
    for (int i = 0; method && i < DAL_LAYERS && method->layer[i]; i++)
        if (method->layer[i]->order > 0) order = method->layer[i]->order;
    return order;
}

const char *dal__mass_fault(const dal_system *s, unsigned needs)
{
    const bool inverts = !(s->properties & DAL_MASS_ON_KERNEL);
    if (needs & DAL_NEEDS_CONSTANT_MASS && !(inverts && s->properties & DAL_MASS_CONSTANT))
        return inverts ? "the mass matrix is not constant; take gauss-spark2"
                       : "the mass matrix need not have an inverse; take gauss-spark2";
    if (needs & DAL_NEEDS_POTENTIAL && !(s->properties & DAL_MASS_CONSTANT))
        return "the system has no constant mass matrix";
    if (DAL__HOLONOMIC_COUNT(s) == 0 || !(needs & DAL_NEEDS_MASS_OF_Q)) return NULL;
    if (s->projection)
        return "the mass matrix depends on velocities beside holonomic constraints; take "
               "gauss4+project";
    return inverts ? NULL
                   : "the mass matrix need not have an inverse beside holonomic constraints; take "
                     "gauss4+project";
}

/* The reason why holonomic constraints would drift with a method, projected or not; NULL: none. */
static const char *holonomic_fault(const dal_method *method)
{
    const dal_integrator *inner = method->layer[0];
    if (inner && inner->needs & DAL_NEEDS_BLOCKS && !(inner->properties & DAL_PRESERVES_HOLONOMIC))
        return "the method enforces D alone, and its holonomic constraints would drift";
    if (dal_method_needs(method) & DAL_NEEDS_ENERGY)
        return "+project-energy moves q without regard to its holonomic constraints";
    return NULL;
}

dal_status dal_method_complete(dal_method *method, const dal_system *system,
                               const dal_options *options, bool *added, dal_error *error)
{
    char name[128];
    int layers = 0;
    if (added) *added = false;
    DAL_REQUIRE(method, error);
    DAL_REQUIRE(system, error);
    DAL_REQUIRE(options, error);
    if (DAL__HOLONOMIC_COUNT(system) == 0) return DAL_STATUS_OK;
    const char *const fault = holonomic_fault(method);
    if (fault)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "%s cannot act on %s: %s; take rattle, gauss-spark4 or gauss4+project",
                         dal_method_name(method, name, sizeof name),
                         system->name ? system->name : "this system", fault);
    while (layers < DAL_LAYERS && method->layer[layers]) layers++;
    if (dal_method_properties(method) & DAL_PRESERVES_HOLONOMIC || options->bare || layers == 0)
        return DAL_STATUS_OK;
    if (layers == DAL_LAYERS)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "%s has %d modifiers, and +project, which holonomic constraints need, has "
                         "no place after them",
                         dal_method_name(method, name, sizeof name), layers - 1);
    if (added) *added = true;
    return find("project", MODIFIER, &method->layer[layers], error);
}

unsigned dal_method_needs(const dal_method *method)
{
    unsigned needs = 0;
    for (int i = 0; method && i < DAL_LAYERS && method->layer[i]; i++)
        needs |= method->layer[i]->needs;
    return needs;
}

unsigned dal_method_properties(const dal_method *method)
{
    unsigned properties = 0;
    for (int i = 0; method && i < DAL_LAYERS && method->layer[i]; i++) {
        const dal_integrator *k = method->layer[i];
        properties = (properties & (k->inherits | DAL_PERSISTENT_MULTIPLIER)) |
                     (k->properties & ~(unsigned)DAL_MODIFIER);
    }
    return properties;
}
