/* reactions.c - directions of the reactions given beside the constraints.
 *
 *     W dv/dt = b + B^T h,   D = 0:   (A W^-1 B^T) h = -(c + A W^-1 b)
 *
 * Chetaev's rule is B = A = D_v.  A constraint that is enforced by an actuator (servo constraint)
 * has a direction B of its own, and A W^-1 B^T has no symmetry.  Marle, Rep. Math. Phys. 42 (1998)
 * 211. */
#include "model/mechanics.h"

static const dal__entry *reaction(const dal_model *model, int i)
{
    return dal__model_entry(model, DAL_SECTION_REACTIONS, i);
}

static bool has_item(const dal_model *model, int item)
{
    const dal__entry *entry;
    for (int i = 0; (entry = reaction(model, i)) != NULL; i++)
        if (entry->item == item) return true;
    return false;
}

dal_status dal__reactions(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    const dal__entry *first = reaction(model, 0), *entry;
    e->servo = first != NULL;
    if (e->servo && e->vakonomic)
        return dal__fail_at(
            error, DAL_MODEL, first->name_line, first->name_column,
            "vakonomic mechanics has no reactions: its multipliers take their place");
    for (int i = 0; (entry = reaction(model, i)) != NULL; i++)
        if (entry->item > e->m)
            return dal__fail_at(error, DAL_MODEL, entry->name_line, entry->name_column,
                                "reaction %d has no constraint: there are %d", entry->item, e->m);
    for (int a = 1; e->servo && a <= e->m; a++)
        if (!has_item(model, a))
            return dal__fail_at(error, DAL_MODEL, first->name_line, first->name_column,
                                "constraint %d has no reaction: the list needs one for each", a);
    return DAL_OK;
}
