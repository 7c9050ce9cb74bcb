/* settings.h - checks of what callers give a run: parameters, start values and a system. */
#ifndef DAL_SETTINGS_H
#define DAL_SETTINGS_H

#include "dalembert_run.h"

/* Whether a point has coordinates and velocities. */
static inline bool dal__has_state(const dal_point *at) { return at && at->q && at->v; }

/* Checks that count settings are there and have names; what: how a message calls them, in the
 * plural. */
dal_status dal__check_settings(const dal_setting *settings, int count, const char *what,
                               dal_error *error);
/* Finds the number of a parameter, from 0.  Errors: DAL_STATUS_NAME with the nearest name. */
dal_status dal__find_parameter(const dal_system *system, const char *name, int *number,
                               dal_error *error);
/* Writes how messages call row a of D, from 0, of m with the last `holonomic` of holonomic
 * constraints: "constraint 2", "holonomic constraint 1"; returns name[size]. */
const char *dal__name_constraint(int m, int holonomic, int a, char *name, size_t size);
/* How many constraints of a system, or of equations, are holonomic: a small library takes none.
 * Whether mu_e may be of q, v and e, there of t alone, and whether equations are solved for q''.
 * Whether a run reserves the matrices of all constraints that its start needs, as a small one. */
#ifdef DAL_MINIMAL
#define DAL__HOLONOMIC_COUNT(of) 0
enum { DAL__TAKES_GAUGE_OF_STATE = 0, DAL__SOLVES_EQUATIONS = 0, DAL__STARTS_IN_SCRATCH = 1 };
#else
#define DAL__HOLONOMIC_COUNT(of) ((of)->holonomic)
enum { DAL__TAKES_GAUGE_OF_STATE = 1, DAL__SOLVES_EQUATIONS = 1, DAL__STARTS_IN_SCRATCH = 0 };
#endif
/* The name of row a of D of a system or of equations, in memory of the block where it is called. */
#define DAL__CONSTRAINT_NAME(of, a)                                                                \
    dal__name_constraint((of)->m, DAL__HOLONOMIC_COUNT(of), a, (char[40]){0}, 40)
/* How messages call the W that must be regular. */
const char *dal__mass_words(const dal_system *system);
/* Sets the values of all parameters: the system's, and settings over them.  Errors: DAL_STATUS_NAME
 * with the nearest name, not_finite where a value is not finite. */
dal_status dal__set_parameters(const dal_system *system, const dal_setting *settings, int count,
                               dal_status not_finite, double *value, dal_error *error);
/* Checks that a spec has a system and its settings; ignores the rest of it. */
dal_status dal__check_spec(const dal_run_spec *spec, dal_error *error);
/* Refuses a system with events, DAL_STATUS_UNSUPPORTED; what: that which does not know them, in the
 * plural. */
dal_status dal__refuse_events(const dal_system *system, const char *what, dal_error *error);

#endif
