/* dalembert.h - systems, models, methods, runs and batches, each in a header of its own.
 *
 * A system says what moves, a method how.  A run joins the two in one block of memory.  A batch
 * steps many runs of one kind, several lanes at a time.
 *
 *     d/dt L_v - L_q = Q + A^T h,   D(q,v,t) = 0,   A = dD/dv            (Lagrange-d'Alembert)
 *     H = pi.pi/(2e) + pi.F(q,v,t) + p.v + mu_e pi_e                     (canonical lift, 4n+2)
 *
 * q and v are coordinates and velocities, L is the Lagrangian, Q are forces, h the multipliers of
 * the constraints (and h a step size), W = L_vv the mass matrix, E = L_v.v - L.  Equation numbers
 * (nhK) are from A. A. Deriglazov, arXiv:2510.24492.
 *
 * Statuses.  Every function that can fail returns a dal_status and, where it takes a dal_error,
 * fills it; a dal_error may be NULL.  A NULL pointer to an object, a text, numbers or a result, a
 * NULL name in a dal_setting and a negative count are errors, DAL_STATUS_ARGUMENT, unless the
 * function allows them.  A function without a status then returns 0, NaN or NULL, writes NaN to its
 * result, does nothing, or returns -1 for an index.  *_free(NULL) does nothing.
 *
 * Memory.  [alloc] marks functions that allocate, and these may also fail with DAL_STATUS_MEMORY.
 * create makes an object that free releases; init places one in memory of the caller.  A returned
 * pointer to constant data belongs to its object and is valid as long as that.
 *
 * Shapes.  [n] after a pointer is the number of its elements; matrices are row-major.  n, m and
 * multipliers are members of dal_system, dimension is dal_run_dimension.  Quantities have the units
 * of the system, which are the user's own; angles in formulas are in radians.
 *
 * The library of `make MINIMAL=1` has no quad precision, takes neither holonomic constraints nor a
 * mu_e of q, v or e (DAL_STATUS_UNSUPPORTED), and solves no section equations for q''
 * (DAL_STATUS_MODEL).  It lacks the functions of dalembert_batch.h, dalembert_analysis.h and
 * dalembert_codegen.h; of dalembert_model.h it lacks what reads YAML, built-in systems,
 * dal_model_tangent, dal_model_tangent_by, dal_model_growth and dal_model_ranks.  To call one of
 * these is an error of the linker.
 *
 * Nothing here prints, reads the environment or has global state.  Different objects may be used in
 * different threads. */
#ifndef DALEMBERT_H
#define DALEMBERT_H

#include "dalembert_batch.h"
#include "dalembert_method.h"
#include "dalembert_model.h"
#include "dalembert_run.h"
#include "dalembert_status.h"
#include "dalembert_system.h"

/* ---- version ------------------------------------------------------------------------------- */

#define DAL_VERSION_MAJOR 0 /* before 1.0 a new minor version may change the interface */
#define DAL_VERSION_MINOR 5 /* a part of the soname, libdalembert.so.MAJOR.MINOR, before 1.0 */
#define DAL_VERSION_PATCH 0 /* leaves the interface as it is */
/* The version as a text, "0.5.0". */
#define DAL_VERSION DAL__VERSION_OF(DAL_VERSION_MAJOR, DAL_VERSION_MINOR, DAL_VERSION_PATCH)

#define DAL__VERSION_OF(major, minor, patch)   DAL__VERSION_TEXT(major, minor, patch)
#define DAL__VERSION_TEXT(major, minor, patch) #major "." #minor "." #patch

#endif
