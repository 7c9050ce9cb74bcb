/* layout.c - the dimensions and sizes of a run, and whether system, method and options fit. */
#include "run/layout.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/solved.h"
#include "dalembert_program.h"
#include "kernel/quad.h"
#include "run/registry.h"
#include <dalembert_kernel.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Of scratch or of a workspace, so that sizes in bytes do not overflow. */
enum { MAX_NUMBERS = 1000000000 };

/* The reason why the motion conserves no energy; NULL: it does. */
static const char *energy_fault(const dal_system *system)
{
    if (system->properties & DAL_VAKONOMIC)
        return "vakonomic motion does not conserve the energy of L";
    if (!system->energy) return "the system has no energy";
    if (!(system->properties & (DAL_E_EXACT | DAL_E_ON_D)))
        return "the motion does not conserve its energy";
    return NULL;
}

/* Takes the system with exact energy for extend-energy. */
static dal_status choose_system(dal__layout *k, dal_error *error)
{
    const char *fault = energy_fault(k->system), *name = k->system->name;
    if (!k->options.extend_energy) return DAL_STATUS_OK;
    if (!fault && !k->system->extended) fault = "the system has no such extension";
    if (fault)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "extend-energy cannot act on %s: %s",
                         name ? name : "this system", fault);
    k->system = k->system->extended;
    return DAL_STATUS_OK;
}

/* The reason why method, space or solver cannot act on the system; NULL: they can. */
static const char *misfit(const dal__layout *k)
{
    const dal_system *s = k->system;
    const dal_callbacks *call = &s->call;
    const unsigned needs = dal_method_needs(&k->method);
    if (!call->field) return "the system has no field";
    if (k->lifted && s->multipliers)
        return "the system has no lifted space, being vakonomic; take the physical space";
    if (k->lifted && !call->adjoint) return "the system has no lifted space: no adjoint";
    if (needs & (DAL_NEEDS_CONSTRAINT | DAL_NEEDS_BLOCKS) && k->m > 0 && !call->constraint)
        return "the system has no constraint callback";
    if (needs & DAL_NEEDS_ENERGY && energy_fault(s)) return energy_fault(s);
    if (needs & DAL_NEEDS_ENERGY && !call->energy_normal) return "the system has no energy_normal";
    if (needs & DAL_NEEDS_JACOBIAN && k->lifted && !call->jacobian)
        return "the system has no jacobian";
    if (needs & DAL_NEEDS_JACOBIAN && k->lifted && s->properties & DAL_EFFORT_OF_V)
        return "K of the effort depends on v, and pi.K pi/(2e) has no flow in closed form";
    if (!DAL__TAKES_GAUGE_OF_STATE && k->lifted && call->gauge_gradient)
        return "a small library takes a mu_e of t alone";
    if (k->options.solver == DAL_NEWTON && !call->jacobian)
        return "the system has no jacobian, which the solver newton needs";
    if (needs & DAL_NEEDS_BLOCKS && k->lifted)
        return "the method enforces D on (q,v) and has no lifted form; take the physical space";
    if (needs & DAL_NEEDS_BLOCKS && (!call->blocks || s->multipliers))
        return "the system has no blocks a, B of F = a + B h";
    const char *const mass = dal__mass_fault(s, needs);
    if (mass) return mass;
    if (needs & DAL_NEEDS_POTENTIAL && !call->potential)
        return "the system has no potential (its accelerations are given, not a Lagrangian)";
    if (needs & DAL_NEEDS_SERIES && !s->series)
        return "the system has no Taylor series, not being made from a model";
    if (needs & DAL_NEEDS_ISOKINETIC && !(s->properties & DAL_D_ISOKINETIC))
        return "the system has no isokinetic constraint v.Wv/2 - K with constant W and forces of q "
               "and t";
    return NULL;
}

static dal_status check_needs(const dal__layout *k, dal_error *error)
{
    const char *fault = misfit(k), *name = k->system->name;
    char method[128];
    if (!fault) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED, "%s cannot act on %s: %s",
                     dal_method_name(&k->method, method, sizeof method),
                     name ? name : "this system", fault);
}

static dal_status check_system_sizes(const dal_system *system, dal_error *error)
{
    if (system->n < 1)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "a system needs coordinates; n is %d",
                         system->n);
    if (system->m < 0 || system->parameters < 0 || system->guards < 0 || system->invariants < 0 ||
        system->pivots < 0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "a dimension of the system is negative");
    if (system->holonomic < 0 || system->holonomic > system->m ||
        (system->holonomic > 0 && !(system->call.holonomic && system->call.constraint)))
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%d holonomic constraints among %d need the callbacks holonomic and "
                         "constraint",
                         system->holonomic, system->m);
    if (system->holonomic != DAL__HOLONOMIC_COUNT(system))
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "a small library takes no holonomic constraints");
    if (system->m != 0 && system->multipliers != 0 && system->multipliers != system->m)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "%d multipliers for %d constraints",
                         system->multipliers, system->m);
    if (system->workspace && system->workspace < (size_t)system->parameters)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "%d parameters in a workspace of %zu numbers",
                         system->parameters, system->workspace);
    if (system->workspace < (size_t)system->pivots)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "%d pivots in a workspace of %zu numbers",
                         system->pivots, system->workspace);
    return DAL_STATUS_OK;
}

static dal_status check_options(const dal_options *o, dal_error *error)
{
    if (o->step == 0.0 || !isfinite(o->step))
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the step must be finite and not 0; it is %g",
                         o->step);
#define OPTION(type, name, word, initial, min, max, value, help)                                   \
    if (!((double)o->name >= min && (double)o->name <= max))                                       \
        return dal__fail(error, DAL_STATUS_ARGUMENT, "option %s: %g is not from %g to %g", word,   \
                         (double)o->name, (double)min, (double)max);
    DAL_OPTION_LIST(OPTION)
#undef OPTION
    if (o->tolerance == 0.0 || o->tolerance >= dal_min_tolerance(o)) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_ARGUMENT,
                     "option tolerance: %g is below %.2g, the smallest in %s precision; 0: none",
                     o->tolerance, dal_min_tolerance(o),
                     o->precision == DAL_QUAD ? "quad" : "double");
}

/* A modifier must suit the method inside it, layers 0..depth-1. */
static dal_status check_inside(const dal_method *method, int depth, dal_error *error)
{
    const dal_integrator *outer = method->layer[depth];
    dal_method inside = *method;
    char name[128];
    for (int i = depth; i < DAL_LAYERS; i++) inside.layer[i] = NULL;
    dal_method_name(&inside, name, sizeof name);
    const int order = dal_method_order(&inside);
    if ((outer->needs & DAL_NEEDS_SYMMETRIC) && !(dal_method_properties(&inside) & DAL_SYMMETRIC))
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "+%s needs a symmetric method: %s is not symmetric", outer->name, name);
    if ((outer->needs & DAL_NEEDS_SYMMETRIC) && (outer->needs & DAL_NEEDS_CONSTRAINT) &&
        (dal_method_properties(&inside) & (DAL_PRESERVES_D | DAL_PRESERVES_D_MIDPOINT)) ==
            DAL_PRESERVES_D_MIDPOINT)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "+%s has no solution around %s, which turns D into -D in every step",
                         outer->name, name);
    if ((outer->needs & DAL_NEEDS_ORDER_2) && order != 2)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "+%s needs a method of order 2: %s is of order %d", outer->name, name,
                         order);
    /* Symplectic methods treat p and pi unlike q and v. */
    const unsigned explicit_rk = DAL_EXPLICIT | DAL_COMPONENTWISE;
    if ((outer->needs & DAL_NEEDS_RUNGE_KUTTA) &&
        (dal_method_properties(&inside) & (explicit_rk | DAL_SYMPLECTIC)) != explicit_rk)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "+%s needs an explicit Runge-Kutta method that is not symplectic by "
                         "itself: %s is not one",
                         outer->name, name);
    return DAL_STATUS_OK;
}

static dal_status check_layers(dal__layout *k, dal_error *error)
{
    const dal_method *method = &k->method;
    while (k->depth < DAL_LAYERS && method->layer[k->depth]) {
        const dal_integrator *layer = method->layer[k->depth];
        const bool modifier = layer->properties & DAL_MODIFIER;
        if (!layer->step || layer->stages < 0 || modifier != (k->depth > 0))
            return dal__fail(error, DAL_STATUS_ARGUMENT,
                             "'%s' is not usable as layer %d of a method",
                             layer->name ? layer->name : "?", k->depth + 1);
        if (modifier) DAL_TRY(check_inside(method, k->depth, error));
        if (layer->stages > k->stages) k->stages = layer->stages;
        k->depth++;
    }
    for (int i = k->depth + 1; i < DAL_LAYERS; i++)
        if (method->layer[i])
            return dal__fail(error, DAL_STATUS_ARGUMENT,
                             "layer %d of the method is missing: layer %d is '%s'", k->depth + 1,
                             i + 1, method->layer[i]->name ? method->layer[i]->name : "?");
    if (k->depth == 0) return dal__fail(error, DAL_STATUS_ARGUMENT, "a run needs an integrator");
    return DAL_STATUS_OK;
}

static dal_status check_control(const dal__layout *k, dal_error *error)
{
    char name[128];
    if (k->options.tolerance == 0.0 || dal_method_properties(&k->method) & DAL_ADAPTIVE)
        return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                     "%s has no control of its step size: the tolerance must be 0",
                     dal_method_name(&k->method, name, sizeof name));
}

/* Numbers in the output of a callback. */
int dal__eval_size(const dal__layout *k, int code)
{
    const int n = k->n, nw = k->nw, m = k->m, guards = k->system->guards;
    const int holonomic = DAL__HOLONOMIC_COUNT(k->system);
    switch (code) {
#define SIZE(code, member, reads, numbers)                                                         \
    case DAL_EVAL_##code:                                                                          \
        return numbers;
        DAL_CALLBACK_LIST(SIZE)
#undef SIZE
    default:
        return 0;
    }
}

int dal__observable_count(const dal__layout *k, dal__observable_kind kind, bool exact_known)
{
    const dal_system *system = k->system;
    switch (kind) {
    case DAL__OBSERVE_D:
        return system->constraints ? system->m : 0;
    case DAL__OBSERVE_E:
        return system->energy != NULL;
    case DAL__OBSERVE_LIFT:
        return k->lifted ? 4 : 0;
    case DAL__OBSERVE_INVARIANTS:
        return system->invariant_values ? system->invariants : 0;
    case DAL__OBSERVE_REACTIONS:
        return k->options.reactions ? k->m + k->n : 0;
    case DAL__OBSERVE_MULTIPLIERS:
        /* On ker A alone a method carries rates A v', not multipliers (lib/model/restricted.c). */
        return k->options.reactions && !(system->properties & DAL_MASS_ON_KERNEL) ? k->multiplier
                                                                                  : 0;
    case DAL__OBSERVE_HOLONOMIC:
        return system->call.holonomic ? system->holonomic : 0;
    case DAL__OBSERVE_ERROR:
        return exact_known;
    default:
        return 0;
    }
}

/* h1, .., hm, R_x, ..; lambda1, .. */
void dal__reaction_name(const dal_system *system, dal__observable_kind kind, int i, char *buffer,
                        size_t size)
{
    const bool is_of_F = kind == DAL__OBSERVE_REACTIONS;
    const int k = i - system->m;
    if (!is_of_F || k < 0)
        snprintf(buffer, size, "%s%d", is_of_F ? "h" : "lambda", i + 1);
    else if (system->coordinate)
        snprintf(buffer, size, "R_%s", system->coordinate[k]);
    else
        snprintf(buffer, size, "R_q%d", k + 1);
}

static bool is_reaction(const dal_system *system, const char *name)
{
    char other[128];
    for (int kind = DAL__OBSERVE_REACTIONS; kind <= DAL__OBSERVE_MULTIPLIERS; kind++)
        for (int i = 0; i < system->m + system->n; i++) {
            dal__reaction_name(system, kind, i, other, sizeof other);
            if (strcmp(other, name) == 0) return true;
        }
    return false;
}

/* A column has one meaning: names of the system do not name reactions. */
static dal_status check_reactions(const dal__layout *k, dal_error *error)
{
    const dal_system *s = k->system;
    const char *const system = s->name ? s->name : "this system";
    const char *const *const names[] = {s->coordinate, s->invariant};
    const int count[] = {k->n, s->invariants};
    const char *const fault = s->m == 0 ? "the system has no constraints"
                              : s->properties & DAL_VAKONOMIC
                                  ? "vakonomic motion has none; its multipliers are g1, g2, .."
                              : s->reactions ? NULL
                              : k->options.extend_energy
                                  ? "F continued off D = 0 is not made of them"
                                  : "the system has no callback for them";
    if (!k->options.reactions) return DAL_STATUS_OK;
    if (fault)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the reactions of %s cannot be observed: %s", system, fault);
    for (int j = 0; j < 2; j++)
        for (int i = 0; names[j] && i < count[j]; i++)
            if (is_reaction(s, names[j][i]))
                return dal__fail(error, DAL_STATUS_NAME,
                                 "the reactions of %s cannot be observed: '%.80s' is also the name "
                                 "of %s",
                                 system, names[j][i], j == 0 ? "a coordinate" : "an invariant");
    return DAL_STATUS_OK;
}

int dal__max_observables(const dal__layout *k)
{
    const bool is_exact_known = true;
    int count = 0;
    for (int kind = 0; kind < DAL__OBSERVABLE_KINDS; kind++)
        count += dal__observable_count(k, kind, is_exact_known);
    return count;
}

/* Functions without a Taylor series are refused by name. */
static dal_status check_series(const dal__layout *k, dal_error *error)
{
    const dal_series *series = k->system->series;
    const char *name = k->system->name;
    char method[128];
    if (!(dal_method_needs(&k->method) & DAL_NEEDS_SERIES) || !series->refused)
        return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                     "%s cannot act on %s: the equations contain %s, which has no Taylor series at "
                     "its jump or kink",
                     dal_method_name(&k->method, method, sizeof method),
                     name ? name : "this system", series->refused);
}

/* Whether a run can be in quad precision. */
#if DAL__HAS_QUAD
static dal_status check_quad(const dal__layout *k, dal_error *error)
{
    if (DAL_QUAD_DIGITS < 113)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "quad precision: this machine has no type of 113 binary digits");
    if (!k->system->quad)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "quad precision: %.80s has no form in it, not being made from a model",
                         k->system->name ? k->system->name : "this system");
    for (int i = 0; i < k->depth; i++)
        if (!dal__integrator_wide(k->method.layer[i], DAL__VARIANT_x1_QUAD))
            return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                             "quad precision: '%.80s' has no form in it, not being the library's",
                             k->method.layer[i]->name ? k->method.layer[i]->name : "?");
    return DAL_STATUS_OK;
}
#else
static dal_status check_quad(const dal__layout *k, dal_error *error)
{
    (void)k;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                     "quad precision: this library is built without it");
}
#endif

/* Blanks of a gauge do not count; a hash is cut to 53 bits. */
double dal__lift_number(const dal_system *system, int i)
{
    if (i == DAL__LIFT_EFFORT) return system->effort;
    if (!system->call.gauge) return 0.0;
    uint64_t hash = DAL__HASH_START;
    for (const char *c = system->gauge ? system->gauge : ""; *c; c++)
        if (*c != ' ') hash = dal__hash(hash, c, 1);
    return (double)(hash >> 11);
}

/* Whether steps may be solved by Newton's method. */
static bool may_solve_by_newton(const dal__layout *k)
{
    const unsigned properties = dal_method_properties(&k->method);
    const bool runge_kutta =
        (properties & (DAL_COMPONENTWISE | DAL_SYMPLECTIC)) == DAL_COMPONENTWISE;
    if (dal_method_needs(&k->method) & DAL_NEEDS_JACOBIAN) return true;
    return k->options.solver != DAL_FIXED_POINT &&
           !(properties & DAL_EXPLICIT && (runge_kutta || !k->lifted));
}

/* Matrices of all stages, Newton's and its inverse: one of these for v and in the lifted space one
 * for pi; or the two of a lift, with 2n columns, and what the method inside it needs. */
static int newton_matrices(const dal__layout *k)
{
    unsigned kernel = 0;
    for (int i = 0; i < k->depth; i++) kernel |= k->method.layer[i]->kernel;
    return kernel & DAL_KERNEL_TANGENT ? 6 : k->lifted ? 3 : 2;
}

/* Whether a layer evaluates one of some callbacks, rather than the parts of the kernel that use the
 * factors of F where constraints are many. */
static bool has_matrices(const dal__layout *k, unsigned needs, unsigned by_factors)
{
    bool has = false;
    for (int i = 0; i < k->depth; i++)
        has |= k->method.layer[i]->needs & needs &&
               !(k->m >= DAL__SPARSE && k->method.layer[i]->kernel & by_factors);
    return has;
}

#ifndef DAL_MINIMAL
bool dal__checks_rank_by_factors(const dal__layout *k)
{
    const dal_system *system = k->system;
    const dal_callbacks *further[] = {system->wide4, system->wide8,
                                      system->quad ? &system->quad->call : NULL};
    const unsigned others = DAL_SERVO | DAL_VAKONOMIC;
    bool has_factors = system->call.enforcement != NULL;
    for (int i = 0; i < 3; i++) has_factors &= !further[i] || further[i]->enforcement;
    return has_factors && dal__checks_rank(system) && system->m >= DAL__SPARSE &&
           system->pivots > 0 && DAL__HOLONOMIC_COUNT(system) == 0 &&
           !(system->properties & others) && !(k->options.tolerance > 0.0);
}
#endif

/* Numbers of a start: D, A, B of all constraints and a condition, G, what the callback writes, and
 * vectors; or of the equations of velocities that it solves. */
static size_t start_matrices(const dal_system *system)
{
    const size_t n = (size_t)system->n, m = (size_t)system->m, rows = m + 1;
    const size_t numbers = rows * (2 * n + rows + 2) + 2 * n + m + 2 * m * n + 1;
    const size_t solved = dal__solve_size(system);
    return numbers > solved ? numbers : solved;
}

/* Numbers of matrices of all constraints: of methods, of the rank check at both ends of a step, of
 * events, of what has no sizes of its terms, of Newton's matrix, and of what the engine makes where
 * the system lacks it. */
static double matrices(const dal__layout *k, bool inverts)
{
    const unsigned needs = DAL_NEEDS_BLOCKS | DAL_NEEDS_CONSTRAINT,
                   kernel = DAL_KERNEL_CORRECTION | DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_SPARK;
    const double n = k->n, m = k->m, point = m + 2 * m * n, blocks = point + n + m;
    const dal_system *system = k->system;
    const dal_callbacks *call = &system->call;
    const bool compares_minors = dal__checks_rank(system) && !dal__checks_rank_by_factors(k);
    if (m < DAL__SPARSE || system->holonomic > 0 || has_matrices(k, needs, kernel))
        return 4 * point + 8 * m * m;
    double count = 2 * (n + m) + 1;
    if (DAL__STARTS_IN_SCRATCH || compares_minors || system->events > 0 || !system->scales)
        count = 2 * point + 2 * m * (m + 2);
    if (!DAL__STARTS_IN_SCRATCH && k->options.reactions) count += (m + 1) * (n + 1) + 2 * m;
    if (inverts && dal_method_needs(&k->method) & DAL_NEEDS_BLOCKS)
        count += blocks + 4 * m * (m + 1);
    if (!call->correction || !call->enforcement || !call->reaction || !call->constraint_value)
        count += blocks + 2 * m * (m + 1);
    return count;
}

/* In floating point first, so that nothing overflows. */
static dal_status measure(dal__layout *k, dal_error *error)
{
    const double dim = k->dim, n = k->n, nw = k->nw, m = k->m, stages = k->stages;
    const bool inverts = k->system->call.jacobian && may_solve_by_newton(k);
    const double square = (stages * nw) * (stages * nw);
    const double matrix = inverts ? newton_matrices(k) * square + 2 * nw * (n + nw) : 0;
    const double constraint = matrices(k, inverts);
    const unsigned by_factors = DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_SPARK;
    const double equations = (stages + 1) * m;
    const double blocks =
        has_matrices(k, DAL_NEEDS_BLOCKS, by_factors)
            ? 2 * (stages + 2) * (n + 2 * m + 2 * m * n) + 4 * equations * equations
            : 0;
    const bool expands = dal_method_needs(&k->method) & DAL_NEEDS_SERIES;
    k->taylor_order = dal_taylor_order(k->options.tolerance);
    k->tolerance_root = pow(k->options.tolerance, 1.0 / k->taylor_order);
    const double series =
        expands ? (1 + k->taylor_order) * ((double)k->system->series->size[k->lifted] + 3 * dim + 4)
                : 0;
    const double scratch = (20 * stages + 16) * dim + matrix + constraint + blocks +
                           2.0 * k->system->guards + k->system->invariants + 16 * n + 64 + series;
    if (scratch > MAX_NUMBERS || k->stages > 1000)
        return dal__fail(error, DAL_STATUS_TOO_LARGE, "a run with n = %d, m = %d needs %g numbers",
                         k->n, k->m, scratch);
    k->scratch = (size_t)scratch;
    k->matrices = DAL__STARTS_IN_SCRATCH ? 0 : start_matrices(k->system);
    k->workspace = k->system->workspace ? k->system->workspace : (size_t)k->system->parameters;
    if (k->workspace > MAX_NUMBERS)
        return dal__fail(error, DAL_STATUS_TOO_LARGE, "a workspace of %zu numbers", k->workspace);
    const bool remembers = k->method.layer[0]->properties & DAL_EXTRAPOLATES_STAGES;
    k->derivatives = remembers ? (1 + DAL__DIFFERENCES) * k->stages * (k->nw + k->n) : 0;
    k->multiplier = dal_method_properties(&k->method) & DAL_PERSISTENT_MULTIPLIER ? k->m : 0;
    k->acceleration =
        k->method.layer[0]->properties & DAL_PERSISTENT_ACCELERATION ? 1 + 3 * k->n : 0;
    k->pivots = dal__checks_rank(k->system) ? k->system->pivots : 0;
    k->persistent = dal__at(k, DAL__CLOCK_SIZE) + 1; /* changed */
#define MEMBER(member, count) k->persistent += (size_t)DAL__COUNT_##count(k);
    DAL__METHOD_STATE_LIST(MEMBER)
#undef MEMBER
    const size_t events = (size_t)k->system->events;
    k->event_memory =
        events > 0 ? 2 * events + 2 + (size_t)dal__max_observables(k) : 0; /* events.h */
    const bool is_default = !k->lifted || (!k->system->call.effort && !k->system->call.gauge);
    k->lift_memory = is_default ? 0 : DAL__LIFT_SIZE;
    k->persistent += k->event_memory + k->lift_memory;
    return DAL_STATUS_OK;
}

const double *dal__units(const dal__layout *k, dal__unit_list list)
{
    const double *const units = k->system->units;
    const int first = list == DAL__UNITS_OF_STATE    ? 0
                      : list == DAL__UNITS_OF_SPEEDS ? k->n
                                                     : k->n + k->nw;
    const int end = list == DAL__UNITS_OF_LEVELS ? k->n + k->nw + k->m + 1 : k->n + k->nw;
    for (int i = first; units && i < end; i++)
        if (units[i] != (list == DAL__UNITS_OF_STATE ? 1.0 : units[first])) return units + first;
    return NULL;
}

/* Operations of callbacks that say nothing of them: F has some ten a component. */
static void guess_operations(dal__layout *k)
{
    const double field = 10.0 * k->nw, jacobian = field * k->nw, most = 1e9;
    k->field_operations = k->system->field_operations;
    k->jacobian_operations = k->system->jacobian_operations;
    if (k->field_operations <= 0) k->field_operations = (int)field;
    if (k->jacobian_operations <= 0) k->jacobian_operations = (int)fmin(jacobian, most);
}

dal_status dal__layout_init(dal__layout *k, const dal_run_spec *spec, dal_error *error)
{
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(check_system_sizes(spec->system, error));
    DAL_TRY(check_options(&spec->options, error));
    if (!isfinite(spec->start_time))
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "the time of the start must be finite; it is %g", spec->start_time);
    *k = (dal__layout){.system = spec->system,
                       .method = spec->method,
                       .options = spec->options,
                       .start_time = spec->start_time + 0.0};
    DAL_TRY(choose_system(k, error));
    k->n = spec->system->n;
    k->m = spec->system->m;
    k->nw = k->n + spec->system->multipliers;
    k->lifted = spec->options.space == DAL_LIFTED;
    if (k->n > 100000 || k->m > k->n)
        return dal__fail(error, DAL_STATUS_TOO_LARGE, "%d coordinates, %d constraints", k->n, k->m);
    k->dim = k->lifted ? 4 * k->n + 2 : k->n + k->nw;
    guess_operations(k);
    DAL_TRY(dal_method_complete(&k->method, k->system, &k->options, NULL, error));
    DAL_TRY(check_layers(k, error));
    DAL_TRY(check_control(k, error));
    DAL_TRY(check_needs(k, error));
    DAL_TRY(check_series(k, error));
    DAL_TRY(check_reactions(k, error));
    if (k->options.precision == DAL_QUAD) DAL_TRY(check_quad(k, error));
    return measure(k, error);
}

double dal_min_tolerance(const dal_options *options)
{
    const double ulps = 0x1p-12;
    if (!options) return NAN;
    return ulps * DBL_EPSILON * (options->precision == DAL_QUAD ? DAL_QUAD_ULP_RATIO : 1.0);
}
