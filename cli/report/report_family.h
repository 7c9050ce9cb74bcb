/* report_family.h - families of methods, by what their integrators declare. */
#ifndef DAL_CLI_REPORT_FAMILY_H
#define DAL_CLI_REPORT_FAMILY_H

/* code, name on a page */
#define METHOD_FAMILY_LIST(FAMILY)                                                                 \
    FAMILY(RUNGE_KUTTA, "Runge-Kutta")                                                             \
    FAMILY(GAUSS, "Gauss")                                                                         \
    FAMILY(SYMPLECTIC, "symplectic")                                                               \
    FAMILY(CONSTRAINT, "constraint form")                                                          \
    FAMILY(PROJECTED, "projected")                                                                 \
    FAMILY(ENERGY, "energy-preserving")                                                            \
    FAMILY(OTHER, "other")

typedef enum method_family {
#define FAMILY_CODE(code, name) METHOD_FAMILY_##code,
    METHOD_FAMILY_LIST(FAMILY_CODE)
#undef FAMILY_CODE
        METHOD_FAMILIES
} method_family;

extern const char *const method_family_name[METHOD_FAMILIES];
/* Of a method with its modifiers, "rk4+project"; OTHER of a name that the library does not know. */
method_family method_family_of(const char *method);

#endif
