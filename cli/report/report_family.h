/* report_family.h - families of methods, by what their integrators declare. */
#ifndef DAL_CLI_REPORT_FAMILY_H
#define DAL_CLI_REPORT_FAMILY_H

#include "io/csv_table.h"

/* code, name on a page, a member that is known well */
#define METHOD_FAMILY_LIST(FAMILY)                                                                 \
    FAMILY(RUNGE_KUTTA, "Runge-Kutta", "rk4")                                                      \
    FAMILY(GAUSS, "Gauss", "gauss4")                                                               \
    FAMILY(SYMPLECTIC, "symplectic", "stormer-verlet")                                             \
    FAMILY(CONSTRAINT, "constraint form", "spark4")                                                \
    FAMILY(PROJECTED, "projected", "rk4+project")                                                  \
    FAMILY(ENERGY, "energy-preserving", "discrete-gradient")                                       \
    FAMILY(OTHER, "other", "")

typedef enum method_family {
#define FAMILY_CODE(code, name, member) METHOD_FAMILY_##code,
    METHOD_FAMILY_LIST(FAMILY_CODE)
#undef FAMILY_CODE
        METHOD_FAMILIES
} method_family;

extern const char *const method_family_name[METHOD_FAMILIES];
/* Of a method with its modifiers, "rk4+project"; OTHER of a name that the library does not know. */
method_family method_family_of(const char *method);
/* Adds one method of each family: of those that are preferred, if there are any, and else of all,
 * the one that is known well, or the first. */
void method_family_members(const csv_words *all, const csv_words *preferred, csv_words *members);

#endif
