/* generation.c - what a generated file needs. */
#include "codegen/generation.h"

bool dal__is_controlled(const dal__generation *g) { return g->layout.options.tolerance > 0.0; }

bool dal__has_times(const dal__generation *g)
{
    return g->product == DAL__PRODUCT_OBSERVE || (g->lanes > 1 && dal__is_controlled(g));
}

bool dal__uses_newton(const dal__generation *g)
{
    const unsigned implicit = DAL_KERNEL_EULER | DAL_KERNEL_COLLOCATION | DAL_KERNEL_ENFORCE;
    return g->kernel & implicit && g->spec->options.solver != DAL_FIXED_POINT &&
           g->programs->program[DAL__PROGRAM_JACOBIAN].present;
}

bool dal__follows_tangents(const dal__generation *g)
{
    return g->layout.lifted && g->kernel & DAL_KERNEL_TANGENT;
}

/* Whether the observables need a program. */
static bool observes(const dal__generation *g, dal__program_code code)
{
    if (code == DAL__PROGRAM_FIELD || code == DAL__PROGRAM_GAUGE || code == DAL__PROGRAM_EFFORT)
        return g->layout.lifted;
    return code == DAL__PROGRAM_CONSTRAINTS || code == DAL__PROGRAM_ENERGY ||
           code == DAL__PROGRAM_INVARIANTS || code == DAL__PROGRAM_EXACT ||
           code == DAL__PROGRAM_HOLONOMIC ||
           (code == DAL__PROGRAM_REACTIONS && g->layout.options.reactions);
}

bool dal__is_status_of_step(dal_status status)
{
    return status == DAL_STATUS_OK || (status >= DAL_STATUS_SINGULAR && status <= DAL_STATUS_GAUGE);
}

bool dal__has_lift(const dal__generation *g)
{
    return g->layout.lifted ||
           g->kernel & (DAL_KERNEL_EULER | DAL_KERNEL_COLLOCATION | DAL_KERNEL_TANGENT);
}

bool dal__has_function(const dal__generation *g, dal__program_code code)
{
    const bool is_one = code == DAL__PROGRAM_FIELD || code == DAL__PROGRAM_JACOBIAN ||
                        code == DAL__PROGRAM_CONSTRAINT || code == DAL__PROGRAM_ENERGY_NORMAL;
    return g->with_field && is_one && g->programs->program[code].present;
}

bool dal__has_holonomic(const dal__generation *g)
{
    const unsigned enforce = DAL_KERNEL_CORRECTION | DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_BLOCKS;
    return g->layout.system->holonomic > 0 && g->kernel & enforce;
}

bool dal__inserts_columns(const dal__generation *g)
{
    static const dal__program_code codes[] = {DAL__PROGRAM_CONSTRAINT, DAL__PROGRAM_BLOCKS};
    bool inserts = false;
    for (int i = 0; i < 2; i++)
        inserts |= g->programs->program[codes[i]].is_by_columns && dal__wants(g, codes[i]);
    return inserts;
}

bool dal__evaluates(const dal__generation *g, dal__program_code code)
{
    const unsigned kernel = g->kernel;
    if (dal__has_function(g, code)) return true;
    if (g->product == DAL__PRODUCT_OBSERVE) return observes(g, code);
    switch (code) {
    case DAL__PROGRAM_ADJOINT:
    case DAL__PROGRAM_GAUGE:
        return dal__has_lift(g);
    case DAL__PROGRAM_EFFORT:
    case DAL__PROGRAM_GAUGE_GRADIENT:
        return g->layout.lifted && g->programs->program[code].present;
    case DAL__PROGRAM_JACOBIAN:
        return kernel & (DAL_KERNEL_SOLVE | DAL_KERNEL_TANGENT);
    case DAL__PROGRAM_CONSTRAINT:
        return kernel & DAL_KERNEL_CONSTRAINT ||
               (dal__checks_rank(g->layout.system) && !dal__checks_rank_by_factors(&g->layout));
    case DAL__PROGRAM_HOLONOMIC:
        return g->layout.system->holonomic > 0;
    case DAL__PROGRAM_POSITION:
        return dal__has_holonomic(g);
    case DAL__PROGRAM_CORRECTION:
        return kernel & DAL_KERNEL_CORRECTION;
    case DAL__PROGRAM_ENFORCEMENT:
    case DAL__PROGRAM_CONSTRAINT_VALUE:
        return kernel & DAL_KERNEL_ENFORCEMENT;
    case DAL__PROGRAM_REACTION:
        return kernel & DAL_KERNEL_REACTION || dal__inserts_columns(g);
    case DAL__PROGRAM_BLOCKS:
        return kernel & DAL_KERNEL_BLOCKS;
    case DAL__PROGRAM_POTENTIAL:
        return kernel & DAL_KERNEL_POTENTIAL;
    case DAL__PROGRAM_ENERGY_NORMAL:
        return kernel & DAL_KERNEL_ENERGY_NORMAL;
    case DAL__PROGRAM_GUARDS:
        return g->layout.system->guards > 0;
    case DAL__PROGRAM_REACTIONS:
        return g->layout.options.reactions;
    case DAL__PROGRAM_DIAGNOSE:
    case DAL__PROGRAM_PICTURE:
    case DAL__PROGRAM_PROJECTION:
    case DAL__PROGRAM_EVENT_VALUES:
    case DAL__PROGRAM_EVENT_RATES:
    case DAL__PROGRAM_EVENT_STATES:
    case DAL__PROGRAM_EVENT_NORMALS:
        return false;
    default:
        return true;
    }
}

bool dal__wants(const dal__generation *g, dal__program_code code)
{
    const bool lift = code == DAL__PROGRAM_ADJOINT || code == DAL__PROGRAM_GAUGE;
    if (!g->programs->program[code].present || !dal__evaluates(g, code)) return false;
    if (dal__has_function(g, code)) return true;
    if (code == DAL__PROGRAM_JACOBIAN) return dal__uses_newton(g) || dal__follows_tangents(g);
    return g->layout.lifted || !lift;
}
