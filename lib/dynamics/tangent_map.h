/* tangent_map.h - tangent vectors and the steps of a method that move them exactly.
 *
 * A state of a tangent system has the state of a run and a tangent vector (dal_model_tangent). */
#ifndef DAL_DYNAMICS_TANGENT_MAP_H
#define DAL_DYNAMICS_TANGENT_MAP_H

#include "core/error.h"
#include "dalembert_run.h"

/* The reason why steps of this method move no tangent vector of a space by their own derivative;
 * NULL: they do. */
const char *dal__tangent_fault(const dal_run_spec *spec, dal_space space);
/* Writes state and vector, [2n + multipliers] or [4n + 2] with de = 0, of the system of a run into
 * a state of its tangent system; and the vector from it. */
void dal__tangent_scatter(const dal_system *system, dal_space space, const double *state,
                          const double *vector, double *tangent);
void dal__tangent_gather(const dal_system *system, dal_space space, const double *tangent,
                         double *vector);

/* The place in a state, or a vector, of number i of what varies at constant e: q, v, then g or
 * p, pi. */
static inline int dal__varied_place(dal_space space, int n, int i)
{
    return space == DAL_LIFTED && i >= 2 * n ? i + 1 : i;
}

#endif
