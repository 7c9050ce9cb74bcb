/* report_family.c - families of methods, by what their integrators declare.
 *
 * A projection makes a method projected, whatever it is; other modifiers leave the family as it
 * is.  Symplectic ones that preserve quadratic invariants are the Gauss methods. */
#include "report_family.h"
#include "dalembert.h"

const char *const method_family_name[METHOD_FAMILIES] = {
#define FAMILY_NAME(code, name) name,
    METHOD_FAMILY_LIST(FAMILY_NAME)
#undef FAMILY_NAME
};

method_family method_family_of(const char *name)
{
    dal_method method;
    dal_error error;
    if (dal_method_parse(&method, name, &error)) return METHOD_FAMILY_OTHER;
    for (int i = 1; i < DAL_LAYERS && method.layer[i]; i++)
        if (method.layer[i]->needs & DAL_NEEDS_CONSTRAINT) return METHOD_FAMILY_PROJECTED;
    const unsigned properties = method.layer[0]->properties;
    return properties & DAL_PRESERVES_ENERGY           ? METHOD_FAMILY_ENERGY
           : method.layer[0]->needs & DAL_NEEDS_BLOCKS ? METHOD_FAMILY_CONSTRAINT
           : properties & DAL_PRESERVES_QUADRATIC      ? METHOD_FAMILY_GAUSS
           : properties & DAL_SYMPLECTIC               ? METHOD_FAMILY_SYMPLECTIC
                                                       : METHOD_FAMILY_RUNGE_KUTTA;
}
