/* constants.c - the sizes and choices that are constants in a generated file; how its lanes go. */
#include "codegen/generate.h"

/* Whether the groups of lanes can be stepped as one larger system: implicit stages of two groups
 * find room in the registers where there are few of them. */
static bool steps_groups_together(const dal__generation *g)
{
    const unsigned properties = g->layout.method.layer[0]->properties;
    const bool few = properties & DAL_EXTRAPOLATES_STAGES && g->layout.method.layer[0]->stages <= 2;
    const bool can = properties & DAL_COMPONENTWISE || few;
    return g->layout.depth == 1 && !g->layout.lifted && can;
}

/* Lanes go by registers, as large as the processor has them. */
static void write_lanes(dal__generation *g)
{
    dal__buffer_print(&g->text, "#define DAL_LANES %d\n", g->lanes);
    dal__buffer_append(&g->text, "#if DAL_LANES > 8 && defined __AVX512F__\n#define DAL_GROUP 8\n"
                                 "#elif DAL_LANES > 4 && defined __AVX__ && !defined __AVX512F__\n"
                                 "#define DAL_GROUP 4\n"
                                 "#elif DAL_LANES > 2 && !defined __AVX__\n"
                                 "#define DAL_GROUP 2\n#endif\n");
    dal__buffer_append(&g->text, dal__source_text("groups.h"));
    dal__buffer_append(&g->text, "#define DAL_WORK(place) w[(place) * DAL_GROUPS]\n");
    dal__buffer_print(
        &g->text, "enum { DAL_STEP_GROUPS = %s, DAL_STEP_COUNT = DAL_GROUPS / DAL_STEP_GROUPS };\n",
        steps_groups_together(g) ? "DAL_GROUPS" : "1");
}

void dal__write_constants(dal__generation *g)
{
    const dal__layout *k = &g->layout;
    const int stages = g->spec->method.layer[0]->stages;
    const bool collocation = dal__method_uses(g, "dal_collocation");
    const bool solves = collocation || dal__method_uses(g, "dal_symplectic_euler");
    const bool is_explicit = dal_method_properties(&g->spec->method) & DAL_EXPLICIT;
    const struct {
        const char *name;
        int value;
    } list[] = {
        {"N", k->n},
        {"NW", k->nw},
        {"M", k->m},
        {"DIM", k->dim},
        {"LIFTED", k->lifted},
        {"STAGES", stages},
        {"STAGE_DERIVATIVES", k->derivatives},
        {"SOLVER", k->options.solver},
        {"ITERATIONS", k->options.iterations},
        {"EXTRA_ITERATIONS", k->options.extra_iterations},
        {"PLAIN", k->options.sums == DAL_SUMS_PLAIN},
        {"PROPERTIES", (int)k->system->properties},
        {"MULTIPLIER", k->multiplier},
        {"NEWTON", dal__uses_newton(g)},
        {"TANGENT", dal__follows_tangents(g)},
        {"EXPLICIT", is_explicit && k->depth == 1 && !(solves && k->lifted)},
        {"GUARDS", k->system->guards},
        {"RANK_CHECKED", k->m > 0 && dal__wants(g, DAL__PROGRAM_CONSTRAINT) &&
                             (k->system->properties & DAL_D_RANK_CHECKED) != 0},
        {"GAUGE", dal__wants(g, DAL__PROGRAM_GAUGE)},
        {"TRACED", g->product == DAL__TRACE},
    };
    write_lanes(g);
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        dal__buffer_print(&g->text, "#define DAL__%s %d\n", list[i].name, list[i].value);
    dal__buffer_append(&g->text, "#define DAL__SOLVER_TOLERANCE ");
    dal__buffer_number(&g->text, k->options.solver_tolerance);
    dal__buffer_append(&g->text, "\n");
}
