/* dalembert_kernel.h - all that the source of an integrator may use.
 *
 * An integrator advances a state y in place by one step h.  It is written once, in plain C over the
 * type num (one double, or several lanes), and is compiled at each width.  It must not branch on
 * the value of one lane, store anything outside *step, or call the system except through the
 * functions below.  No function returns behind the author's back.  Five macros serve every
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
 *     num, dal_select, dal_less, ...        num.h                lanes
 *     dal_sin, dal_cos, dal_exp, ...        elementary.h         elementary functions
 *     dal_step, dal_field, dal_update, ...  step.h               one step: state, system
 *     dal_invert, dal_multiply              algebra.h            small dense matrices
 *     dal_solve                             solve.h              fixed point, Newton
 *     dal_symplectic_euler                  symplectic_euler.h   partitioned symplectic Euler
 *     dal_tableau                           tableau.h            coefficients, weighted sums
 *     dal_collocation                       collocation.h        implicit Runge-Kutta steps
 *     dal_substeps                          composition.h        compositions of steps
 *     dal_control                           adaptive.h           steps under error control
 *     dal_eval_blocks                       blocks.h             a, A, B, c of constrained motion
 *     dal_enforce                           constrained.h        steps that enforce D
 *     dal_spark_advance                     spark.h              the same with stages
 *
 * A file ends with one DAL_INTEGRATOR for each method in it, whose member kernel names what the
 * file uses of these (parts.h); one line in integrators.def (or,
 * outside the tree, the descriptor's address in a dal_method) makes it known. */
#ifndef DALEMBERT_KERNEL_H
#define DALEMBERT_KERNEL_H

#include "../lib/kernel/adaptive.h"
#include "../lib/kernel/algebra.h"
#include "../lib/kernel/blocks.h"
#include "../lib/kernel/collocation.h"
#include "../lib/kernel/composition.h"
#include "../lib/kernel/constrained.h"
#include "../lib/kernel/elementary.h"
#include "../lib/kernel/num.h"
#include "../lib/kernel/parts.h"
#include "../lib/kernel/solve.h"
#include "../lib/kernel/spark.h"
#include "../lib/kernel/step.h"
#include "../lib/kernel/symplectic_euler.h"
#include "../lib/kernel/tableau.h"
#include "dalembert.h"

/* DAL_INTEGRATOR(NAME, step function, the descriptor's other members) defines the constant
 * descriptor dal_integrator_NAME.  Other variants have names of their own for the library's
 * registry. */
#ifndef DAL_VARIANT_NAME
#define DAL_INTEGRATOR(identifier, function, ...)                                                  \
    extern const dal_integrator dal_integrator_##identifier;                                       \
    const dal_integrator dal_integrator_##identifier = {.step = (function), __VA_ARGS__}
#else
#define DAL_INTEGRATOR(identifier, function, ...)                                                  \
    extern const dal_integrator DAL_WIDE(dal__wide_##identifier);                                  \
    const dal_integrator DAL_WIDE(dal__wide_##identifier) = {.step = (function), __VA_ARGS__}
#endif

#endif
