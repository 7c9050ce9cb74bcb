/* dalembert_kernel.h - all that an integrator source may see.
 *
 * An integrator advances a state y in place by one step h.  It is written once, in plain C over the
 * type num (one double, or several lanes), and is compiled at each width; it must not branch on the
 * value of one lane, keep anything outside *step, or call the system but through the functions
 * here.
 *
 *     num, dal_select, dal_less, ...         lib/kernel/num.h           lanes
 *     dal_sin, dal_cos, dal_exp, ...         lib/kernel/elementary.h    elementary functions
 *     dal_step, dal_field, dal_update, ...   lib/kernel/step.h          one step: state, system
 *     dal_invert, dal_multiply               lib/kernel/algebra.h       small dense algebra
 *     dal_solve                              lib/kernel/solve.h         fixed point, Newton
 *     dal_symplectic_euler   lib/kernel/symplectic_euler.h     symplectic Euler steps
 *     dal_tableau                            lib/kernel/tableau.h       coefficients, weighted sums
 *     dal_collocation                        lib/kernel/collocation.h   implicit Runge-Kutta steps
 *     dal_substeps                           lib/kernel/composition.h   steps made of steps
 *     dal_control                            lib/kernel/adaptive.h      steps under error control
 *     dal_eval_blocks, dal_enforce           lib/kernel/constrained.h   steps that enforce D
 *     dal_spark_advance                      lib/kernel/spark.h         the same with stages
 *
 * A file ends with one DAL_INTEGRATOR for each method in it; one line in integrators.def (or,
 * outside the tree, the descriptor's address in a dal_method) makes it known. */
#ifndef DALEMBERT_KERNEL_H
#define DALEMBERT_KERNEL_H

#include "dalembert.h"

#include "../lib/kernel/num.h"

#include "../lib/kernel/elementary.h"

#include "../lib/kernel/step.h"

#include "../lib/kernel/algebra.h"

#include "../lib/kernel/solve.h"

#include "../lib/kernel/symplectic_euler.h"

#include "../lib/kernel/tableau.h"

#include "../lib/kernel/collocation.h"

#include "../lib/kernel/composition.h"

#include "../lib/kernel/adaptive.h"

#include "../lib/kernel/constrained.h"

#include "../lib/kernel/spark.h"

/* DAL_INTEGRATOR(NAME, step function, the descriptor's other members): defines the constant
 * descriptor dal_integrator_NAME; the other variants are seen by the library's registry only, under
 * names of their own. */
#ifndef DAL_VARIANT
#define DAL_INTEGRATOR(identifier, function, ...)                                                  \
    extern const dal_integrator dal_integrator_##identifier;                                       \
    const dal_integrator dal_integrator_##identifier = {.step = (function), __VA_ARGS__}
#else
#define DAL_INTEGRATOR(identifier, function, ...)                                                  \
    extern const dal_integrator DAL_WIDE(dal__integrator_##identifier);                            \
    const dal_integrator DAL_WIDE(dal__integrator_##identifier) = {.step = (function), __VA_ARGS__}
#endif

#endif
