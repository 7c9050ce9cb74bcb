/* system.c - the dal_system of a model. */
#include "core/settings.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/derive.h"
#include "model/energy.h"
#include "model/events.h"
#include "model/formulas.h"
#include "model/held.h"
#include "model/model.h"
#include "model/motion.h"
#include "model/potential.h"
#include "model/programs.h"
#include "model/properties.h"
#include "model/units.h"

/* ---- programs ---- */

/* Whether there is W^-1 B^T, but not as formulas. */
static bool is_by_columns(const dal__equations *e)
{
    return e->m > 0 && !e->U[0] && !e->vakonomic && !e->restricted;
}

/* D, A, W^-1 A^T; nothing when W has no inverse. */
static void add_constraint(dal_model *model, dal__programs *programs)
{
    const dal__equations *e = &model->equations;
    const int m = e->m, mn = m * e->n;
    const bool by_columns = is_by_columns(e);
    const dal__nodes lists[] = {{e->constraint, m}, {e->A, mn}, {e->U, by_columns ? 0 : mn}};
    if (m == 0) return;
    dal__programs_add(model, programs, DAL__PROGRAM_CONSTRAINTS, e->constraint, m);
    if (!e->U[0] && !by_columns) return;
    programs->program[DAL__PROGRAM_CONSTRAINT].is_by_columns = by_columns;
    dal__programs_add_lists(model, programs, DAL__PROGRAM_CONSTRAINT, lists, 3);
}

/* D, A, W(q,u)^-1 A^T; nothing where W does not depend on v, or has no inverse. */
static void add_projection(dal_model *model, dal__programs *programs)
{
    const dal__equations *e = &model->equations;
    const int m = e->m, n = e->n;
    bool depends = false;
    if (m == 0 || !e->U[0]) return;
    for (int i = 0; i < n * n && !depends; i++)
        depends = dal__depends(e->graph, e->mass->given[i], e->v, e->v + n);
    if (!depends) return;
    dal__node *U = dal__model_nodes(model, m * n, 0);
    const dal__nodes lists[] = {{e->constraint, m}, {e->A, m * n}, {U, m * n}};
    dal__solve_mass_at_pi(model, U);
    dal__programs_add_lists(model, programs, DAL__PROGRAM_PROJECTION, lists, 3);
}

/* h, B; nothing for vakonomic systems. */
static void add_reactions(dal_model *model, dal__programs *programs)
{
    const dal__equations *e = &model->equations;
    const dal__nodes lists[] = {{e->h, e->m}, {e->B, e->m * e->n}};
    if (e->m == 0 || e->vakonomic) return;
    dal__programs_add_lists(model, programs, DAL__PROGRAM_REACTIONS, lists, 2);
}

/* D, A, R = W^-1 B^T, W^-1 b, c; nothing for vakonomic systems. */
static void add_blocks(dal_model *model, dal__programs *programs)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m, mn = m * n;
    const bool by_columns = is_by_columns(e);
    const dal__nodes lists[] = {
        {e->constraint, m}, {e->A, mn}, {e->R, by_columns ? 0 : mn}, {e->a, n}, {e->c, m}};
    if (e->vakonomic) return;
    programs->program[DAL__PROGRAM_BLOCKS].is_by_columns = by_columns;
    dal__programs_add_lists(model, programs, DAL__PROGRAM_BLOCKS, lists, 5);
}

static void add_if(dal_model *model, dal__programs *programs, bool present, dal__program_code code,
                   const dal__node *outputs, int count)
{
    if (present) dal__programs_add(model, programs, code, outputs, count);
}

/* All programs of a system whose accelerations are F. */
static void add_programs(dal_model *model, dal__programs *p, const dal__node *F)
{
    const dal__equations *e = &model->equations;
    int start = 2 * e->n + e->multipliers + 1;
    dal__programs_begin(model, p, e->n, e->multipliers);
    dal__programs_save_pivots(e, p);
    dal__programs_add_motion(model, p, F);
    add_constraint(model, p);
    add_projection(model, p);
    add_blocks(model, p);
    add_if(model, p, e->holonomic, DAL__PROGRAM_HOLONOMIC, e->position, e->holonomic);
    add_if(model, p, e->potential, DAL__PROGRAM_POTENTIAL, e->potential, 3 * e->n);
    dal__programs_add_diagnosis(model, p);
    add_if(model, p, e->normal, DAL__PROGRAM_ENERGY_NORMAL, e->normal, 1 + 3 * e->n);
    add_if(model, p, e->mu, DAL__PROGRAM_GAUGE, &e->mu, 1);
    add_if(model, p, e->mu_gradient, DAL__PROGRAM_GAUGE_GRADIENT, e->mu_gradient, 2 * e->n + 1);
    add_if(model, p, e->guards, DAL__PROGRAM_GUARDS, e->guard, e->guards);
    dal__programs_add(model, p, DAL__PROGRAM_START, e->start, start);
    add_if(model, p, e->energy, DAL__PROGRAM_ENERGY, &e->energy, 1);
    add_if(model, p, e->picture, DAL__PROGRAM_PICTURE, e->picture, DAL_PICTURE_COUNT);
    const int events = e->events;
    bool sets = false;
    for (int k = 0; k < events; k++) sets = sets || e->event[k].actions & DAL_EVENT_SETS;
    add_if(model, p, events, DAL__PROGRAM_EVENT_VALUES, e->event_value, events);
    add_if(model, p, events, DAL__PROGRAM_EVENT_RATES, e->event_rate, events);
    add_if(model, p, sets, DAL__PROGRAM_EVENT_STATES, e->event_state, 2 * e->n * events);
    add_if(model, p, events, DAL__PROGRAM_EVENT_NORMALS, e->event_normal, (1 + 2 * e->n) * events);
    add_if(model, p, e->exact[0], DAL__PROGRAM_EXACT, e->exact, 2 * e->n);
}

/* ---- the system ---- */

static const char *text_of(const dal_model *model, dal_section section)
{
    const dal__entry *entry = dal__model_entry(model, section, 0);
    return entry ? entry->text : NULL;
}

static void describe(dal_model *model)
{
    const dal__equations *e = &model->equations;
    const int units = 2 * e->n + e->multipliers + e->m + 1;
    model->units = dal__model_allocate(model, (size_t)units, sizeof *model->units);
    if (model->out_of_memory) return;
    for (int i = 0; i < units; i++) model->units[i] = 1.0;
    model->system = (dal_system){
        .name = model->name,
        .title = text_of(model, DAL_SECTION_TITLE),
        .reference = text_of(model, DAL_SECTION_REFERENCE),
        .n = e->n,
        .m = e->m,
        .holonomic = e->holonomic,
        .multipliers = e->multipliers,
        .parameters = e->parameters,
        .invariants = e->invariants,
        .observed = model->has_other_mechanics ? e->invariants : e->observed,
        .guards = e->guards,
        .mass_guard = e->mass_guard,
        .tags = e->tags,
        .tables = model->tables,
        .properties = e->properties,
        .coordinate = e->coordinate,
        .parameter = e->parameter,
        .value = e->value,
        .invariant = e->invariant_name,
        .guard = e->guard_name,
        .tag = e->tag,
        .solved_coordinates = e->solved_coordinates,
        .solved_velocities = e->solved_velocities,
        .solved = e->solved,
        .events = e->events,
        .event = e->event,
        .table = e->table_name,
        .units = model->units,
    };
}

/* Adds a program to the system and to the extended one. */
static void add_to_both(dal_model *model, dal__program_code code, const dal__node *outputs,
                        int count)
{
    const dal__equations *e = &model->equations;
    dal__programs *const programs[] = {&model->programs, &model->extended_programs};
    for (int k = 0; k < (e->extended ? 2 : 1); k++)
        dal__programs_add(model, programs[k], code, outputs, count);
}

/* The correction by which v returns to D = 0; nothing where W, or A W^-1 A^T, has no inverse or
 * couples too many coordinates. */
static void add_correction(dal_model *model)
{
    const dal__equations *e = &model->equations;
    dal__node *x = dal__model_nodes(model, e->n, 0);
    if (e->m == 0 || (!e->U[0] && !is_by_columns(e))) return;
    if (dal__motion_correct(model, x) == DAL_STATUS_OK)
        add_to_both(model, DAL__PROGRAM_CORRECTION, x, e->n);
}

/* K pi and its derivatives, of an effort that is not the identity.  Nodes are made after all
 * programs of F, which do not depend on it. */
static dal_status add_effort(dal_model *model, dal_error *error)
{
    const dal__equations *e = &model->equations;
    const int n = e->n;
    model->system.effort = model->effort;
    model->system.gauge = e->gauge;
    if (model->effort == DAL_EFFORT_IDENTITY) return DAL_STATUS_OK;
    if (model->effort == DAL_EFFORT_MASS && e->restricted)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "effort mass: the mass matrix is singular, or may become so; effort "
                         "constraint needs no W^-1");
    dal__node *out = dal__model_nodes(model, 3 * n, 0);
    if (model->out_of_memory) return DAL_STATUS_OK;
    dal__motion_effort(model, model->effort, out);
    for (int i = 0; i < n; i++)
        if (dal__depends(e->graph, out[i], e->v, e->v + n))
            model->system.properties |= DAL_EFFORT_OF_V;
    if (model->system.properties & DAL_EFFORT_OF_V)
        model->system.properties &= ~(unsigned)DAL_F_POSITIONAL;
    add_to_both(model, DAL__PROGRAM_EFFORT, out, 3 * n);
    return DAL_STATUS_OK;
}

/* The section equations, where q'' has the places of pi. */
static dal_status add_motion_equations(dal_model *model, dal_error *error)
{
    const int count = dal__model_count(model, DAL_SECTION_EQUATIONS);
    dal__node *out = dal__model_nodes(model, count, 0);
    model->system.equations = count;
    if (model->out_of_memory) return DAL_STATUS_OK;
    DAL_TRY(dal__parse_motion_equations(model, out, error));
    if (count > 0) add_to_both(model, DAL__PROGRAM_EQUATIONS, out, count);
    return DAL_STATUS_OK;
}

/* What enforces g alone; where W need not have an inverse it is made of the constraint. */
static void add_position(dal_model *model)
{
    const dal__equations *e = &model->equations;
    const int count = e->n + e->holonomic;
    if (DAL__HOLONOMIC_COUNT(e) == 0 || e->restricted) return;
    dal__node *out = dal__model_nodes(model, count, 0);
    if (dal__motion_place(model, out) == DAL_STATUS_OK)
        add_to_both(model, DAL__PROGRAM_POSITION, out, count);
}

/* What enforces D at a velocity; of vakonomic systems nothing where A W^-1 A^T has no inverse. */
static void add_enforcement(dal_model *model)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    dal__node *out = dal__model_nodes(model, 2 * n + m, 0), *y = out + n + m;
    if (model->out_of_memory || (e->vakonomic && (m == 0 || !e->U[0]))) return;
    if (dal__motion_enforce(model, out) != DAL_STATUS_OK) return;
    dal__motion_react(model, y);
    add_to_both(model, DAL__PROGRAM_ENFORCEMENT, out, n + m);
    add_to_both(model, DAL__PROGRAM_REACTION, y, n);
    if (m > 0) add_to_both(model, DAL__PROGRAM_CONSTRAINT_VALUE, e->constraint, m);
}

/* What the scales of D, E, invariants, g, h and R = B^T h are made from.  Nodes are made after all
 * programs, so that those do not depend on it. */
static void add_terms(dal_model *model)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m, positions = m + 1 + e->invariants;
    const int count = positions + e->holonomic;
    dal__node *formula = dal__model_nodes(model, count, dal__number(e->graph, 0.0));
    dal__node *reaction = dal__model_nodes(model, m + n, dal__number(e->graph, 0.0));
    if (model->out_of_memory) return;
    dal__terms_free(model->terms);
    dal__terms_free(model->reaction_terms);
    model->reaction_terms = NULL;
    for (int a = 0; a < m; a++) formula[a] = e->constraint[a];
    if (e->energy) formula[m] = e->energy;
    for (int i = 0; i < e->invariants; i++) formula[m + 1 + i] = e->invariant[i];
    for (int j = 0; j < e->holonomic; j++) formula[positions + j] = e->position[j];
    model->terms = dal__terms_create(e->graph, formula, count);
    model->out_of_memory |= !model->terms;
    if (m > 0 && !e->vakonomic) {
        dal__list_reactions(e, reaction);
        model->reaction_terms = dal__terms_create(e->graph, reaction, m + n);
        model->out_of_memory |= !model->reaction_terms;
    }
    model->programs.terms = model->extended_programs.terms = model->terms;
    model->programs.reaction_terms = model->extended_programs.reaction_terms =
        model->reaction_terms;
}

static dal_status finish_programs(dal_model *model, dal__programs *programs, dal_system *system)
{
    if (system->events > 0) dal__programs_add_branches(model, programs);
    return dal__programs_finish(model, programs, system);
}

/* The same system with its energy exact: itself, another one, or none. */
static dal_status make_extended(dal_model *model)
{
    const dal__equations *e = &model->equations;
    if (e->properties & DAL_E_EXACT) model->system.extended = &model->system;
    if (!e->extended) return DAL_STATUS_OK;
    model->extended = model->system;
    model->extended.properties ^= DAL_E_ON_D | DAL_E_EXACT;
    model->extended.properties &= ~(unsigned)DAL_F_POSITIONAL;
    DAL_TRY(finish_programs(model, &model->extended_programs, &model->extended));
    model->system.extended = model->extended.extended = &model->extended;
    return DAL_STATUS_OK;
}

/* Makes it; where memory runs out, or the graph is full, no status is returned for that. */
static dal_status make_system(dal_model *model, dal_error *error)
{
    const dal__equations *e = &model->equations;
    DAL_TRY(dal__parse_model(model, error));
    if (model->out_of_memory) return DAL_STATUS_OK;
    DAL_TRY(dal__equations_derive(model, error));
    DAL_TRY(dal__derive_events(model, error));
    DAL_TRY(dal__check_size(dal__guards(model), error));
    dal__properties(model);
    dal__conserved_energy(model);
    dal__potential(model);
    describe(model);
    add_programs(model, &model->programs, e->F);
    add_reactions(model, &model->programs);
    if (e->extended) add_programs(model, &model->extended_programs, e->extended);
    DAL_TRY(dal__parse_observed(model, error));
    dal__insert_reactions(model);
    if (e->invariants) add_to_both(model, DAL__PROGRAM_INVARIANTS, e->invariant, e->invariants);
    add_correction(model);
    add_enforcement(model);
    add_position(model);
    DAL_TRY(add_effort(model, error));
    DAL_TRY(add_motion_equations(model, error));
    add_terms(model);
    DAL_TRY(dal__check_size(finish_programs(model, &model->programs, &model->system), error));
    dal__system_units(model, &model->system, model->units);
    return dal__check_size(make_extended(model), error);
}

dal_status dal_model_system(dal_model *model, const dal_system **system, dal_error *error)
{
    DAL_REQUIRE(system, error);
    *system = NULL;
    DAL_REQUIRE(model, error);
    if (model->made) return *system = &model->system, DAL_STATUS_OK;
    model->out_of_memory = false;
    DAL_TRY(dal__model_conclude(model, make_system(model, error), error));
    model->made = true;
    *system = &model->system;
    return DAL_STATUS_OK;
}

void dal_model_free(dal_model *model)
{
    if (!model) return;
    dal__programs_free(&model->programs);
    for (int k = 0; model->tangent && k <= model->equations.parameters; k++)
        if (model->tangent[k]) dal__programs_free(&model->tangent[k]->programs);
    dal__programs_free(&model->extended_programs);
    dal__terms_free(model->terms);
    dal__terms_free(model->reaction_terms);
    dal__graph_free(model->equations.graph);
    dal__model_discard(model);
}
