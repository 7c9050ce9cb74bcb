/* engine.c - the choice of the engine that steps a run or a group of a batch. */
#include "run/engine.h"

const dal__engine_kind dal__engine_kinds[DAL__VARIANTS] = {
#define VARIANT(name, variant, lanes, set) {lanes, DAL__##set, &name##_##variant},
    VARIANT(dal__engine, x1, 1, BASE) DAL__VARIANT_LIST(VARIANT, dal__engine)
#undef VARIANT
};

bool dal__engine_can(const dal__layout *k, dal__variant variant)
{
    const int width = dal__engine_kinds[variant].width;
    const dal_system *s = k->system;
    if (variant == DAL__VARIANT_x1 || DAL__VARIANTS == 1) return true;
    const bool has_times = k->options.tolerance > 0.0; /* each lane its own */
    if (width > 1 && dal_method_needs(&k->method) & DAL_NEEDS_SERIES &&
        !(width == 4 ? s->series->wide4 : s->series->wide8))
        return false;
    if (width > 1 && !(width == 4 ? s->wide4 : s->wide8)) return false;
    if (width > 1 && has_times && !(s->properties & DAL_WIDE_TIMES)) return false;
    for (int i = 0; i < k->depth; i++)
        if (!dal__integrator_wide(k->method.layer[i], variant)) return false;
    return dal__machine_has(dal__engine_kinds[variant].set);
}

const dal__engine_kind *dal__engine_best(const dal__layout *k, int width)
{
    const dal__engine_kind *best = NULL;
    for (int v = 0; v < DAL__VARIANTS; v++) {
        const dal__engine_kind *kind = &dal__engine_kinds[v];
        if (kind->width == width && dal__engine_can(k, (dal__variant)v)) best = kind;
    }
    return best;
}
