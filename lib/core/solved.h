/* solved.h - coordinates and velocities of a start that are solved from g = 0 and D = 0. */
#ifndef DAL_CORE_SOLVED_H
#define DAL_CORE_SOLVED_H

#include "core/error.h"
#include "dalembert_system.h"

/* Whether a number is among the ones of a list. */
bool dal__is_solved(const dal_solved *solved, int count, int number);
/* Numbers of memory that the functions below need. */
size_t dal__solve_size(const dal_system *system);

/* Replaces those velocities in v[n], and after them multipliers, that the start of the system
 * solves from D(q,v,t) = 0; their values are the first guess.  Constraints that these velocities
 * cannot satisfy may remain.  Errors, with the place of the velocity in the file, and then v is not
 * defined: DAL_STATUS_ARGUMENT (more velocities than constraints, or one that is none),
 * DAL_STATUS_RANK (D does not determine it), DAL_STATUS_INCONSISTENT (no root is found),
 * DAL_STATUS_NOT_FINITE, DAL_STATUS_UNSUPPORTED (W has no inverse), errors of the constraints. */
dal_status dal__solve_velocities(const dal_system *system, double t, const double *q, double *v,
                                 double *work, double *memory, dal_error *error);
/* The same of the coordinates q[n] that the start solves from g(q,t) = 0; v[n] is read. */
dal_status dal__solve_coordinates(const dal_system *system, double t, double *q, const double *v,
                                  double *work, double *memory, dal_error *error);
/* Both, one after the other, in state[n + nw]: q, v and multipliers. */
dal_status dal__solve_start(const dal_system *system, double t, double *state, double *work,
                            double *memory, dal_error *error);

#endif
