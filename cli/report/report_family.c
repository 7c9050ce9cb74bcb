/* report_family.c - families of methods, by what their integrators declare.
 *
 * A projection makes a method projected, whatever it is; other modifiers leave the family as it
 * is.  Symplectic ones that preserve quadratic invariants are the Gauss methods. */
#include "report_family.h"
#include "dalembert_method.h"

#include <string.h>

const char *const method_family_name[METHOD_FAMILIES] = {
#define FAMILY_NAME(code, name, member) name,
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

/* A member among some methods; NULL: there is none. */
static const char *find_member(method_family family, const csv_words *methods)
{
    static const char *const known[METHOD_FAMILIES] = {
#define FAMILY_MEMBER(code, name, member) member,
        METHOD_FAMILY_LIST(FAMILY_MEMBER)
#undef FAMILY_MEMBER
    };
    const char *first = NULL;
    for (int i = 0; i < methods->count; i++) {
        if (method_family_of(methods->word[i]) != family) continue;
        if (strcmp(methods->word[i], known[family]) == 0) return methods->word[i];
        if (!first) first = methods->word[i];
    }
    return first;
}

void method_family_members(const csv_words *all, const csv_words *preferred, csv_words *members)
{
    for (int family = 0; family < METHOD_FAMILIES; family++) {
        const char *member = find_member((method_family)family, preferred);
        if (!member) member = find_member((method_family)family, all);
        if (member) csv_add_word(members, member);
    }
}
