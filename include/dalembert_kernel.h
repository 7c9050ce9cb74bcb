/* dalembert_kernel.h - all that the source of an integrator may use.
 *
 * An integrator advances a state y in place by one step h.  It is written once, in plain C over the
 * type num (one double, or several lanes), and is compiled at each width.  It must not branch on
 * the value of one lane, store anything outside *step, or call the system except through the
 * functions below.  No function returns unseen by the author.  Five macros serve every
 * integrator:
 *
 *     DAL_INLINE                            before each function
 *     DAL_DIM(s)                            numbers in the state; DAL_N, DAL_NW, DAL_M likewise
 *     DAL_VECTOR(s, name, count)            num name[count], scratch until the step ends
 *     DAL_EACH(i, count)                    for i = 0 .. count - 1
 *     DAL_INTEGRATOR(name, step, ...)       the descriptor, at the end of the file
 *
 * and the functions, all declared in lib/kernel, are:
 *
 *     num.h               num dal_mask dal_num dal_all dal_select dal_any dal_less dal_equal
 *                         dal_max dal_min dal_abs dal_sqrt dal_fma dal_max_norm
 *     lanes.h             dal_lane_set DAL_LANES_AT
 *     elementary.h        dal_sin dal_cos
 *     step.h              dal_step dal_failed dal_field dal_force dal_eval
 *                         dal_add dal_add_multiple dal_update dal_update_multiple
 *                         dal_update_lanes dal_inner dal_clear_momenta
 *     algebra.h           dal_scalar_product dal_multiply dal_gram dal_invert dal_invert_in_units
 *     eigensystem.h       dal_eigensystem
 *     solve.h             dal_block DAL_BLOCK dal_equation dal_iteration_map dal_matrix dal_solve
 *     symplectic_euler.h  dal_polarisation dal_symplectic_euler
 *     tableau.h           dal_tableau
 *     collocation.h       dal_collocation
 *     composition.h       dal_composition dal_substeps
 *     adaptive.h          dal_control dal_control_begin dal_control_next dal_control_end
 *                         dal_control_status dal_dense dal_dense_rate dal_field_at
 *     taylor.h            dal_taylor_order dal_expand_first dal_expand_rest
 *                         dal_evaluate_polynomial
 *     blocks.h            dal_eval_blocks
 *     constrained.h       dal_positional dal_velocity_equation dal_enforce dal_enforce_once
 *                         dal_motion_multipliers
 *     spark.h             dal_spark dal_spark_advance
 *
 * A file ends with one DAL_INTEGRATOR for each method in it, whose member kernel names what the
 * file uses of these (parts.h); one line in integrators.def (or, outside the tree, the descriptor's
 * address in a dal_method) makes it known. */
#ifndef DALEMBERT_KERNEL_H
#define DALEMBERT_KERNEL_H

#include "../lib/kernel/adaptive.h"
#include "../lib/kernel/algebra.h"
#include "../lib/kernel/blocks.h"
#include "../lib/kernel/choice.h"
#include "../lib/kernel/collocation.h"
#include "../lib/kernel/composition.h"
#include "../lib/kernel/constrained.h"
#include "../lib/kernel/eigensystem.h"
#include "../lib/kernel/elementary.h"
#include "../lib/kernel/gauge.h"
#include "../lib/kernel/lanes.h"
#include "../lib/kernel/num.h"
#include "../lib/kernel/parts.h"
#include "../lib/kernel/solve.h"
#include "../lib/kernel/spark.h"
#include "../lib/kernel/step.h"
#include "../lib/kernel/symplectic_euler.h"
#include "../lib/kernel/tableau.h"
#include "../lib/kernel/taylor.h"
#include "dalembert_method.h"

/* A small library leaves the documentation of methods out; their own functions are not shared. */
#ifdef DAL_MINIMAL
#undef DAL_INLINE
#define DAL_INLINE   static inline DAL_UNUSED
#define DAL__NO_TEXT , .documentation = 0
#else
#define DAL__NO_TEXT
#endif

#ifndef DAL_VARIANT_NAME
/* DAL_INTEGRATOR(NAME, step function, the descriptor's other members) defines the constant
 * descriptor dal_integrator_NAME.  Other variants have names of their own for the library's
 * registry. */
#define DAL_INTEGRATOR(identifier, function, ...)                                                  \
    extern const dal_integrator dal_integrator_##identifier;                                       \
    const dal_integrator dal_integrator_##identifier = {.step = (function),                        \
                                                        __VA_ARGS__ DAL__NO_TEXT}
#else
#define DAL_INTEGRATOR(identifier, function, ...)                                                  \
    extern const dal_integrator DAL_WIDE(dal__wide_##identifier);                                  \
    const dal_integrator DAL_WIDE(dal__wide_##identifier) = {.step = (function),                   \
                                                             __VA_ARGS__ DAL__NO_TEXT}
#endif

#endif
