/* registry.h - the integrators of the library by variant. */
#ifndef DAL_REGISTRY_H
#define DAL_REGISTRY_H

#include "core/error.h"
#include "core/machine.h"
#include "dalembert_method.h"

typedef enum dal__variant {
    DAL__VARIANT_x1,
#define VARIANT(name, variant, lanes, set) name##_##variant,
    DAL__VARIANT_LIST(VARIANT, DAL__VARIANT)
#undef VARIANT
        DAL__VARIANTS
} dal__variant;

/* The descriptor of an integrator of the library for a variant; NULL: none. */
const dal_integrator *dal__integrator_wide(const dal_integrator *integrator, dal__variant variant);

/* The reason why methods with these needs cannot act with the mass matrix of a system; or NULL. */
const char *dal__mass_fault(const dal_system *system, unsigned needs);

#endif
