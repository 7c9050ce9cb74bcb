/* formulas.c - from the texts of a model to nodes of one graph.
 *
 * Symbols are numbered
 *     parameters | t | q, dq | v, dv | pi, dpi | g | h, R
 * where dq, dv, dpi have a meaning in the tangent system only, and h, R, the reactions, until their
 * formulas are known (derive.c). */
#include "model/formulas.h"
#include "core/settings.h"
#include "core/solved.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/events.h"
#include "model/expand.h"
#include "model/functions.h"
#include "model/model.h"
#include "model/symbols.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    MAY_ALL = DAL__MAY_T | DAL__MAY_STATE,
    OF_INVARIANTS = DAL__MAY_MULTIPLIERS | DAL__MAY_REACTIONS
};

/* ---- sections of coordinates ---- */

/* Adds the formulas of a section to out[i] of their coordinates; in a list of mappings each item
 * has its row. */
static dal_status by_coordinate(dal_model *model, dal_section section, dal__scope scope,
                                dal__node *out, dal_error *error)
{
    for (int k = 0; k < model->count; k++) {
        const dal__entry *entry = &model->entries[k];
        const dal__equations *e = &model->equations;
        char what[64];
        dal__node node;
        int i;
        if (entry->section != section) continue;
        snprintf(what, sizeof what, "coordinate in %s", dal__section_name(section));
        DAL_TRY(
            dal__find_word(entry->name, DAL__AT_NAME(entry), what, e->coordinate, e->n, &i, error));
        DAL_TRY(dal__parse_entry(model, entry, scope, &node, error));
        if (entry->item) i += (entry->item - 1) * e->n;
        out[i] = dal__node_add(e->graph, out[i], node);
    }
    return DAL_STATUS_OK;
}

/* ---- sections in order ---- */

/* A default may be a formula in the defaults before it: it is evaluated here, once, and does not
 * change when those are set later.  What must change with them belongs under let. */
static dal_status parse_parameters(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    for (int i = 0; i < e->parameters; i++) {
        const dal__entry *entry = dal__model_entry(model, DAL_SECTION_PARAMETERS, i);
        dal__node node;
        DAL_TRY(dal__parse_entry(model, entry, (dal__scope){.parameters = i}, &node, error));
        e->value[i] = dal__evaluate(e->graph, node, e->value);
        if (!isfinite(e->value[i])) return dal__not_finite(model, entry, error);
    }
    return DAL_STATUS_OK;
}

/* Tables come first.  A function knows parameters, tables, the functions before it and its
 * arguments, whose symbols are after all others. */
static dal_status parse_functions(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    int symbol = e->symbols;
    const int tables = model->tables;
    for (int i = 0; i < tables; i++) {
        e->table_name[i] = dal__model_entry(model, DAL_SECTION_TABLES, i)->name;
        e->function[i] = (dal__function){.name = e->table_name[i], .arity = 1, .table = i + 1};
    }
    for (int i = tables; i < e->functions; i++) {
        const dal__entry *entry = dal__model_entry(model, DAL_SECTION_FUNCTIONS, i - tables);
        dal__function *f = &e->function[i];
        DAL_TRY(dal__read_signature(model, entry, f, error));
        for (int k = 0; k < f->arity; k++) f->symbol[k] = symbol++;
        const dal__scope scope = {.parameters = e->parameters, .functions = i, .inside = f};
        DAL_TRY(dal__parse_entry(model, entry, scope, &f->body, error));
    }
    return DAL_STATUS_OK;
}

static dal_status parse_each(dal_model *model, dal_section section, dal__scope scope, int count,
                             dal__node *out, dal_error *error)
{
    for (int i = 0; i < count; i++)
        DAL_TRY(
            dal__parse_entry(model, dal__model_entry(model, section, i), scope, &out[i], error));
    return DAL_STATUS_OK;
}

/* g(q,t) of the holonomic constraints. */
static dal_status parse_positions(dal_model *model, dal__scope scope, dal_error *error)
{
    const dal__equations *e = &model->equations;
    DAL_TRY(parse_each(model, DAL_SECTION_HOLONOMIC, scope, DAL__HOLONOMIC_COUNT(e), e->position,
                       error));
    for (int j = 0; j < DAL__HOLONOMIC_COUNT(e); j++) {
        const bool has_v = dal__depends(e->graph, e->position[j], e->v, e->v + e->n);
        if (has_v)
            return dal__fail_at(error, DAL_STATUS_MODEL,
                                DAL__AT_TEXT(dal__model_entry(model, DAL_SECTION_HOLONOMIC, j)),
                                "holonomic constraint %d depends on velocities: it belongs under "
                                "constraints",
                                j + 1);
    }
    return DAL_STATUS_OK;
}

static dal_status parse_dynamics(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    dal__scope all = dal__scope_of(e, MAY_ALL);
    for (all.lets = 0; all.lets < e->lets; all.lets++) { /* a let may contain those before it */
        const dal__entry *entry = dal__model_entry(model, DAL_SECTION_LET, all.lets);
        DAL_TRY(dal__parse_entry(model, entry, all, &e->let[all.lets], error));
    }
    DAL_TRY(
        parse_each(model, DAL_SECTION_LAGRANGIAN, all, !e->accelerations, &e->lagrangian, error));
    DAL_TRY(by_coordinate(model, DAL_SECTION_ACCELERATIONS, all, e->force, error));
    DAL_TRY(by_coordinate(model, DAL_SECTION_FORCES, all, e->force, error));
    DAL_TRY(parse_each(model, DAL_SECTION_CONSTRAINTS, all, e->m - DAL__HOLONOMIC_COUNT(e),
                       e->constraint, error));
    DAL_TRY(parse_positions(model, all, error));
    DAL_TRY(by_coordinate(model, DAL_SECTION_REACTIONS, all, e->B, error));
    DAL_TRY(by_coordinate(model, DAL_SECTION_CONTROLS, all, e->control, error));
    all.may |= OF_INVARIANTS;
    return parse_each(model, DAL_SECTION_INVARIANTS, all, e->invariants - e->observed, e->invariant,
                      error);
}

dal_status dal__parse_observed(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    const dal__scope scope = dal__scope_of(e, MAY_ALL | OF_INVARIANTS);
    for (int i = e->invariants - e->observed; i < e->invariants; i++)
        DAL_TRY(dal__parse_entry(model, dal__model_entry(model, DAL_SECTION_INVARIANTS, i), scope,
                                 &e->invariant[i], error));
    return DAL_STATUS_OK;
}

dal_status dal__parse_motion_equations(dal_model *model, dal__node *out, dal_error *error)
{
    const dal__scope scope = dal__scope_of(&model->equations, MAY_ALL | DAL__MAY_ACCELERATIONS);
    return parse_each(model, DAL_SECTION_EQUATIONS, scope,
                      dal__model_count(model, DAL_SECTION_EQUATIONS), out, error);
}

/* ---- gauge, start, exact ---- */

static dal_status parse_gauge(dal_model *model, dal_error *error)
{
    static const char *const names[] = {"e", "mu_e"};
    dal__equations *e = &model->equations;
    dal__node *out[] = {&e->start[2 * e->n + e->multipliers], &e->mu};
    for (int i = 0; i < dal__model_count(model, DAL_SECTION_GAUGE); i++) {
        const dal__entry *entry = dal__model_entry(model, DAL_SECTION_GAUGE, i);
        int k;
        DAL_TRY(dal__find_word(entry->name, DAL__AT_NAME(entry), "entry of gauge", names, 2, &k,
                               error));
        const unsigned may = k == 1 ? MAY_ALL | DAL__MAY_GAUGE : 0;
        DAL_TRY(dal__parse_entry(model, entry, dal__scope_of(e, may), out[k], error));
        if (k == 1) e->gauge = entry->text;
        const double start = k == 0 ? dal__evaluate(e->graph, *out[k], e->value) : 1.0;
        if (!isfinite(start)) return dal__not_finite(model, entry, error);
        if (model->has_other_gauge && !(start > 0.0))
            return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(entry),
                                "gauge e: %g is not above 0", start);
    }
    const int n = e->n;
    const bool is_of_state = e->mu && (dal__depends(e->graph, e->mu, e->q, e->v + n) ||
                                       dal__depends(e->graph, e->mu, e->e, e->e + 1));
    if (!is_of_state) return DAL_STATUS_OK;
    if (!DAL__TAKES_GAUGE_OF_STATE)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "a small library takes a mu_e of t alone, not '%.80s'", e->gauge);
    e->mu_gradient = dal__model_nodes(model, 2 * n + 1, 0);
    if (model->out_of_memory) return DAL_STATUS_OK;
    dal__gradient(e->graph, e->mu, e->symbol + e->q, n, e->mu_gradient);
    dal__gradient(e->graph, e->mu, e->symbol + e->v, n, e->mu_gradient + n);
    dal__gradient(e->graph, e->mu, e->symbol + e->e, 1, e->mu_gradient + 2 * n);
    return DAL_STATUS_OK;
}

/* What the start is solved for. */
typedef enum solved_kind { COORDINATES, VELOCITIES } solved_kind;

/* Adds what an entry of a start names to the coordinates or velocities that are solved, unless it
 * names none; the first and second half of names[2n].  All coordinates are added before. */
static dal_status add_solved(dal_model *model, const dal__entry *entry, const char *const *names,
                             solved_kind kind, dal_error *error)
{
    const bool velocities = kind == VELOCITIES;
    dal__equations *e = &model->equations;
    const char *name = dal__solved_name(entry);
    const int first = DAL__HOLONOMIC_COUNT(e) > 0 ? 0 : e->n,
              max = velocities ? e->m : DAL__HOLONOMIC_COUNT(e);
    int *const count = velocities ? &e->solved_velocities : &e->solved_coordinates, i;
    if (!name) return DAL_STATUS_OK;
    DAL_TRY(dal__find_word(name, DAL__AT_NAME(entry),
                           first == 0 ? "coordinate or velocity in solve" : "velocity in solve",
                           names + first, 2 * e->n - first, &i, error));
    i += first;
    if ((i >= e->n) != velocities) return DAL_STATUS_OK;
    if (*count == max)
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(entry),
                            "the start cannot be solved for %s: there %s %d %sconstraint%s, and as "
                            "many %s before it",
                            name, max == 1 ? "is" : "are", max, velocities ? "" : "holonomic ",
                            max == 1 ? "" : "s", velocities ? "velocities" : "coordinates");
    e->solved[e->solved_coordinates + e->solved_velocities] =
        (dal_solved){velocities ? i - e->n : i, entry->name_line, entry->name_column};
    ++*count;
    return DAL_STATUS_OK;
}

static dal_status add_all_solved(dal_model *model, const char *const *names, dal_error *error)
{
    dal__equations *e = &model->equations;
    const dal__entry *entry;
    e->solved =
        dal__model_allocate(model, (size_t)(DAL__HOLONOMIC_COUNT(e) + e->m), sizeof *e->solved);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int k = 0; (entry = dal__model_entry(model, DAL_SECTION_START, k)) != NULL; k++)
        DAL_TRY(add_solved(model, entry, names, COORDINATES, error));
    for (int k = 0; (entry = dal__model_entry(model, DAL_SECTION_START, k)) != NULL; k++)
        DAL_TRY(add_solved(model, entry, names, VELOCITIES, error));
    return DAL_STATUS_OK;
}

static dal_status parse_start(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    const int count = 2 * e->n + e->multipliers;
    const char **names = dal__model_allocate(model, (size_t)count, sizeof *names);
    dal__node *given = dal__model_nodes(model, count, 0);
    dal__scope scope = dal__scope_of(e, DAL__MAY_T);
    const dal__entry *entry;
    const bool lacks_multipliers = model->has_other_mechanics && !e->vakonomic;
    scope.given = given;
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < e->n; i++) {
        names[i] = e->coordinate[i];
        names[e->n + i] = dal__model_print(model, "%s'", e->coordinate[i]);
    }
    for (int i = 2 * e->n; i < count; i++)
        names[i] = dal__model_print(model, "g%d", i - 2 * e->n + 1);
    if (model->out_of_memory) return DAL_STATUS_OK;
    DAL_TRY(add_all_solved(model, names, error));
    for (int k = 0, i; (entry = dal__model_entry(model, DAL_SECTION_START, k)) != NULL; k++) {
        if (dal__solved_name(entry)) continue;
        const char *name = entry->name;
        if (lacks_multipliers && name[0] == 'g' && name[1] >= '1' && name[1] <= '9') continue;
        if (strcmp(entry->name, "solve") == 0 && dal__index_of("solve", 5, names, count) < 0)
            return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_TEXT(entry),
                                "solve must be a list of velocities, as [x', y']");
        if (strcmp(entry->name, "e") == 0)
            return dal__fail_at(error, DAL_STATUS_NAME, DAL__AT_NAME(entry),
                                "the start of e belongs under gauge, as 'gauge: {e: 1}'");
        DAL_TRY(dal__find_word(entry->name, DAL__AT_NAME(entry), "name in start", names, count, &i,
                               error));
        DAL_TRY(dal__parse_entry(model, entry, scope, &e->start[i], error));
        const bool is_guess = i < e->n ? dal__is_solved(e->solved, e->solved_coordinates, i)
                                       : dal__is_solved(e->solved + e->solved_coordinates,
                                                        e->solved_velocities, i - e->n);
        if (!is_guess) given[i] = e->start[i];
        if (!isfinite(dal__evaluate(e->graph, e->start[i], e->value)))
            return dal__not_finite(model, entry, error);
    }
    return DAL_STATUS_OK;
}

/* Velocities of the exact solution are derivatives by t. */
static dal_status parse_exact(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    int given = dal__model_count(model, DAL_SECTION_EXACT);
    if (given == 0 || model->has_other_mechanics) return DAL_STATUS_OK;
    for (int i = 0; i < e->n; i++) e->exact[i] = dal__number(e->graph, 0.0);
    DAL_TRY(by_coordinate(model, DAL_SECTION_EXACT, dal__scope_of(e, DAL__MAY_T), e->exact, error));
    if (given < e->n) {
        const dal__entry *entry = dal__model_entry(model, DAL_SECTION_EXACT, 0);
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(entry),
                            "exact has %d of %d coordinates: it needs a formula for each", given,
                            e->n);
    }
    dal__node one = dal__number(e->graph, 1.0);
    for (int i = 0; i < e->n; i++)
        e->exact[e->n + i] = dal__tangent(e->graph, e->exact[i], &e->t, 1, &one);
    return DAL_STATUS_OK;
}

/* ---- the picture ---- */

static dal_status parse_picture(dal_model *model, dal_error *error)
{
    enum { BODY = DAL_PICTURE_COUNT, NAMES };
#define NAME(code, name) name,
    static const char *const names[] = {DAL_PICTURE_LIST(NAME) "body"};
    static const char *const bodies[] = {DAL_BODY_LIST(NAME)};
#undef NAME
    dal__equations *e = &model->equations;
    const dal__entry *first = dal__model_entry(model, DAL_SECTION_PICTURE, 0), *entry;
    unsigned seen = 0;
    for (int k = 0, i; (entry = dal__model_entry(model, DAL_SECTION_PICTURE, k)) != NULL; k++) {
        DAL_TRY(dal__find_word(entry->name, DAL__AT_NAME(entry), "entry of picture", names, NAMES,
                               &i, error));
        seen |= 1u << i;
        if (i != BODY) {
            DAL_TRY(
                dal__parse_entry(model, entry, dal__scope_of(e, MAY_ALL), &e->picture[i], error));
            continue;
        }
        DAL_TRY(dal__find_word(entry->text, DAL__AT_TEXT(entry), "body", bodies, DAL_BODY_COUNT, &i,
                               error));
        e->body = (dal_body)i;
    }
    for (int i = DAL_PICTURE_X; first && i <= DAL_PICTURE_Y; i++)
        if (!(seen & 1u << i))
            return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(first),
                                "picture has no %s: it needs x and y", names[i]);
    return DAL_STATUS_OK;
}

/* ---- the defaults of a run ---- */

/* A number is positive; the integrator may be one that the library does not have. */
static dal_status check_defaults(const dal_model *model, dal_error *error)
{
    static const char *const names[] = {"integrator", "step", "time"};
    const dal__entry *entry;
    for (int k = 0, i; (entry = dal__model_entry(model, DAL_SECTION_DEFAULTS, k)) != NULL; k++) {
        double value = 0.0;
        DAL_TRY(dal__find_word(entry->name, DAL__AT_NAME(entry), "entry of defaults", names, 3, &i,
                               error));
        if (i > 0 &&
            (dal__parse_number(entry->text, strlen(entry->text), &value) != DAL_STATUS_OK ||
             !(value > 0.0)))
            return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_TEXT(entry),
                                "%s in defaults: '%.80s' is not a positive number", names[i],
                                entry->text);
    }
    return DAL_STATUS_OK;
}

/* ---- the whole ---- */

/* Whether reactions have directions of their own, and then one for each constraint.
 *
 *     W dv/dt = b + B^T h,   D = 0:   (A W^-1 B^T) h = -(c + A W^-1 b)
 *
 * Chetaev's rule is B = A = D_v.  A constraint that an actuator enforces (servo constraint) has a
 * direction B of its own, and A W^-1 B^T has no symmetry.
 * Marle, Rep. Math. Phys. 42 (1998) 211. */
static dal_status check_reactions(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    const dal__entry *first = dal__model_entry(model, DAL_SECTION_REACTIONS, 0), *entry;
    const int own =
        e->m - DAL__HOLONOMIC_COUNT(e); /* reactions of holonomic constraints are along g_q */
    e->servo = first != NULL;
    if (e->servo && e->vakonomic)
        return dal__fail_at(
            error, DAL_STATUS_MODEL, DAL__AT_NAME(first),
            "vakonomic mechanics has no reactions: its multipliers take their place");
    for (int i = 0; (entry = dal__model_entry(model, DAL_SECTION_REACTIONS, i)) != NULL; i++)
        if (entry->item > own)
            return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(entry),
                                "reaction %d has no constraint: there are %d", entry->item, own);
    for (int a = 1; e->servo && a <= own; a++) {
        for (int i = 0; (entry = dal__model_entry(model, DAL_SECTION_REACTIONS, i)) != NULL; i++)
            if (entry->item == a) break;
        if (!entry)
            return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(first),
                                "constraint %d has no reaction: the list needs one for each", a);
    }
    return DAL_STATUS_OK;
}

/* Counts the columns of controls. */
static dal_status count_controls(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    const dal__entry *entry;
    for (int i = 0; (entry = dal__model_entry(model, DAL_SECTION_CONTROLS, i)) != NULL; i++) {
        if (entry->item > DAL__MAX_COORDINATES)
            return dal__fail_at(error, DAL_STATUS_TOO_LARGE, DAL__AT_NAME(entry),
                                "control %d; at most %d are possible", entry->item,
                                (int)DAL__MAX_COORDINATES);
        if (entry->item > e->controls) e->controls = entry->item;
    }
    if (model->effort == DAL_EFFORT_CONTROLS && e->controls == 0)
        return dal__fail(error, DAL_STATUS_MODEL,
                         "effort controls: the system has none; they are columns of forces, as "
                         "'controls: [{x: cos(phi), y: sin(phi)}, {phi: 1}]'");
    if (model->effort != DAL_EFFORT_IDENTITY && e->vakonomic)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "effort %s: vakonomic motion has no lift",
                         dal_effort_name(model->effort));
    return DAL_STATUS_OK;
}

static dal_status check_equations(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    const dal__entry *L = dal__model_entry(model, DAL_SECTION_LAGRANGIAN, 0);
    const dal__entry *F = dal__model_entry(model, DAL_SECTION_ACCELERATIONS, 0);
    const dal__entry *S = dal__model_entry(model, DAL_SECTION_EQUATIONS, 0);
    const int equations = dal__model_count(model, DAL_SECTION_EQUATIONS);
    const dal__entry *excess = dal__constraint_entry(model, e->n);
    const dal__entry *holonomic = dal__model_entry(model, DAL_SECTION_HOLONOMIC, 0);
    if (e->n == 0) return dal__fail(error, DAL_STATUS_MODEL, "the system has no coordinates");
    if (e->n > DAL__MAX_COORDINATES)
        return dal__fail(error, DAL_STATUS_TOO_LARGE, "%d coordinates; at most %d are possible",
                         e->n, (int)DAL__MAX_COORDINATES);
    if (excess)
        return dal__fail_at(error, DAL_STATUS_RANK, DAL__AT_TEXT(excess),
                            "%d constraints on %d coordinates", e->m, e->n);
    if (!L && !F && !(S && DAL__SOLVES_EQUATIONS))
        return dal__fail(error, DAL_STATUS_MODEL,
                         "the system has neither a lagrangian nor accelerations%s",
                         DAL__SOLVES_EQUATIONS ? " nor equations" : "");
    if (!L && !F && equations != e->n)
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(S),
                            "equations has %d of %d formulas, and there is no lagrangian",
                            equations, e->n);
    if (L && F)
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(F),
                            "the system has both a lagrangian and accelerations");
    if (F && e->vakonomic)
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(F),
                            "vakonomic mechanics needs a lagrangian, not accelerations");
    if (!L && e->vakonomic)
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(S),
                            "vakonomic mechanics needs a lagrangian, not equations");
    if (e->holonomic != DAL__HOLONOMIC_COUNT(e))
        return dal__fail_at(error, DAL_STATUS_UNSUPPORTED, DAL__AT_TEXT(holonomic),
                            "a small library takes no holonomic constraints");
    if (holonomic && e->vakonomic)
        return dal__fail_at(error, DAL_STATUS_UNSUPPORTED, DAL__AT_TEXT(holonomic),
                            "vakonomic mechanics takes no holonomic constraints: write the time "
                            "derivative of each under constraints");
    e->accelerations = !L;
    e->implicit = !L && !F;
    return DAL_STATUS_OK;
}

/* Numbers the symbols and allocates all nodes. */
static void begin_equations(dal_model *model)
{
    dal__equations *e = &model->equations;
    int n = e->n, m = e->m;
    e->t = e->parameters;
    e->q = e->t + 1;
    e->v = e->q + 2 * n;
    e->pi = e->v + 2 * n;
    e->g = e->pi + 2 * n + 1;
    e->e = e->g + 2 * m;
    e->symbols = e->reaction = e->e + 1;
    e->graph = dal__graph_create(e->parameters);
    model->out_of_memory |= !e->graph;
    if (model->out_of_memory) return;
    e->graph->tables = model->table;
    e->graph->table_count = model->tables;
    dal__node zero = dal__number(e->graph, 0.0);
    e->lagrangian = zero;
    e->mu = e->energy = 0;
    e->let = dal__model_nodes(model, e->lets, zero);
    e->function = dal__model_allocate(model, (size_t)e->functions + 1, sizeof *e->function);
    e->table_name = dal__model_allocate(model, (size_t)model->tables, sizeof *e->table_name);
    e->force = dal__model_nodes(model, n, zero);
    e->constraint = dal__model_nodes(model, m, zero);
    e->position = dal__model_nodes(model, DAL__HOLONOMIC_COUNT(e), zero);
    e->start = dal__model_nodes(model, 2 * n + m + 1, zero);
    e->invariant = dal__model_nodes(model, e->invariants, zero);
    e->exact = dal__model_nodes(model, 2 * n, 0);
    e->picture = e->pictured ? dal__model_nodes(model, DAL_PICTURE_COUNT, zero) : NULL;
    e->W = dal__model_nodes(model, n * n, zero);
    e->b = dal__model_nodes(model, n, zero);
    e->momentum = dal__model_nodes(model, n, zero);
    e->A = dal__model_nodes(model, m * n, zero);
    e->B = e->servo ? dal__model_nodes(model, m * n, zero) : e->A;
    e->c = dal__model_nodes(model, m, zero);
    e->control = dal__model_nodes(model, e->controls * n, zero);
    e->U = dal__model_nodes(model, n * m, 0);
    e->R = e->servo ? dal__model_nodes(model, n * m, zero) : e->U;
    e->a = dal__model_nodes(model, n, 0);
    e->F = dal__model_nodes(model, n + m, zero);
    e->h = dal__model_nodes(model, m, zero);
    e->pivot = dal__model_allocate(model, (size_t)(2 * (n + m)), sizeof *e->pivot);
    e->value = dal__model_allocate(model, (size_t)e->symbols, sizeof *e->value);
    e->symbol = dal__model_allocate(model, (size_t)e->symbols, sizeof *e->symbol);
    e->flow = dal__model_nodes(model, 1 + n, dal__number(e->graph, 1.0));
    if (model->out_of_memory) return;
    for (int i = 0; i < e->symbols; i++) e->symbol[i] = i;
    for (int i = 0; i < n; i++) e->flow[1 + i] = dal__symbol(e->graph, e->v + i);
}

dal_status dal__parse_model(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    static const char *const words[] = {"lagrange-d'alembert", "vakonomic", "lagrange-dalembert"};
    int word = 0;
    model->warning = NULL;
    dal__graph_free(e->graph);
    *e = (dal__equations){.graph = NULL};
    DAL_TRY(dal__expand(model, error));
    const dal__entry *mechanics = dal__model_entry(model, DAL_SECTION_MECHANICS, 0);
    if (mechanics)
        DAL_TRY(dal__find_word(mechanics->text, DAL__AT_TEXT(mechanics), "mechanics", words, 3,
                               &word, error));
    const bool own = word == 1;
    e->vakonomic = model->mechanics == DAL_MECHANICS_SYSTEM
                       ? own
                       : model->mechanics == DAL_MECHANICS_VAKONOMIC;
    e->holonomic = dal__model_count(model, DAL_SECTION_HOLONOMIC);
    DAL_TRY(dal__collect_names(model, error));
    e->functions = model->tables + dal__model_count(model, DAL_SECTION_FUNCTIONS);
    e->m = dal__model_count(model, DAL_SECTION_CONSTRAINTS) + DAL__HOLONOMIC_COUNT(e);
    model->has_other_mechanics = e->vakonomic != own && e->m > 0;
    e->multipliers = e->vakonomic ? e->m : 0;
    e->pictured = dal__model_count(model, DAL_SECTION_PICTURE) > 0;
    DAL_TRY(check_equations(model, error));
    DAL_TRY(check_reactions(model, error));
    DAL_TRY(count_controls(model, error));
    begin_equations(model);
    if (model->out_of_memory) return DAL_STATUS_OK;
    e->start[2 * e->n + e->multipliers] = dal__number(e->graph, 1.0);
    DAL_TRY(parse_parameters(model, error));
    DAL_TRY(parse_functions(model, error));
    DAL_TRY(parse_dynamics(model, error));
    DAL_TRY(parse_gauge(model, error));
    DAL_TRY(parse_start(model, error));
    DAL_TRY(parse_exact(model, error));
    DAL_TRY(parse_picture(model, error));
    DAL_TRY(dal__parse_events(model, error));
    DAL_TRY(check_defaults(model, error));
    /* The default start, at which pivots are chosen and identities evaluated. */
    for (int i = 0; i < 2 * e->n; i++)
        e->value[i < e->n ? e->q + i : e->v + i - e->n] =
            dal__evaluate(e->graph, e->start[i], e->value);
    for (int a = 0; a < e->multipliers; a++)
        e->value[e->g + a] = dal__evaluate(e->graph, e->start[2 * e->n + a], e->value);
    return DAL_STATUS_OK;
}
