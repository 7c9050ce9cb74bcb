/* dalembert_run.h - runs: one motion of a system by a method.
 *
 * A part of dalembert.h, which has the conventions. */
#ifndef DALEMBERT_RUN_H
#define DALEMBERT_RUN_H

#include "dalembert_method.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- runs ---------------------------------------------------------------------------------- */

/* One motion of a system by a method.  Its steps do not allocate. */
typedef struct dal_run dal_run;

/* What a run is made from.  It may be freed or changed when the run is made; the system and the
 * integrators' descriptors must outlive the run. */
typedef struct dal_run_spec {
    const dal_system *system;         /* what moves */
    dal_method method;                /* how */
    dal_options options;              /* dal_options_default(), changed at will */
    const dal_setting *parameters;    /* [parameter_count] those that differ from their default */
    const dal_setting *start;         /* [start_count] of x, x', e, p_x, pi_x, pi_e, g1; the system
                                      gives the rest; e = INFINITY: 1/e = 0, the adjoint system */
    int parameter_count, start_count; /* how many there are */
    double start_time;                /* t of the start; 0 where it is not named */
} dal_run_spec;

/* Adds +project to a method of F, which lets holonomic constraints g of the system drift, unless
 * the option bare is on; every run does so with the method of its spec.  *added, which may be NULL:
 * whether it was added.  Errors: DAL_STATUS_UNSUPPORTED (a method that enforces D alone, or has no
 * place for another modifier). */
dal_status dal_method_complete(dal_method *method, const dal_system *system,
                               const dal_options *options, bool *added, dal_error *error);

/* Bytes that a run needs; 0 when the spec cannot be used. */
size_t dal_run_size(const dal_run_spec *spec);
/* Places a run in memory[bytes] of the caller, dal_run_size bytes at least, of any alignment; it
 * need not be freed, unless dal_run_native is used.  With 16 constraints and more its start
 * allocates memory, as dal_run_set_parameter does, and frees it.  Errors: DAL_STATUS_ARGUMENT,
 * DAL_STATUS_NAME with the nearest name, DAL_STATUS_UNSUPPORTED, DAL_STATUS_INCONSISTENT (|D| or
 * |g| beyond 1e-10 relative), DAL_STATUS_RANK, DAL_STATUS_SINGULAR_MASS, DAL_STATUS_GAUGE,
 * DAL_STATUS_NOT_FINITE, DAL_STATUS_MEMORY (too few bytes, or none for a start). */
dal_status dal_run_init(dal_run **run, void *memory, size_t bytes, const dal_run_spec *spec,
                        dal_error *error);
/* Makes a run in memory of its own. [alloc]  Errors: as for dal_run_init. */
dal_status dal_run_create(dal_run **run, const dal_run_spec *spec, dal_error *error);
/* Frees what the run owns: its memory after dal_run_create, compiled code always. */
void dal_run_free(dal_run *run);

/* Takes one step, or the part of it before an event of the system, which then acts (see
 * dal_run_sample); or leaves the run unchanged to the bit.  Errors: DAL_STATUS_SINGULAR,
 * DAL_STATUS_SINGULAR_MASS, DAL_STATUS_NOT_FINITE, DAL_STATUS_NOT_CONVERGED, DAL_STATUS_GAUGE; the
 * message names the constraint and the time. */
dal_status dal_run_step(dal_run *run, dal_error *error);
/* Takes count steps, or as many as succeed before one fails.  Errors: as for a step. */
dal_status dal_run_advance(dal_run *run, long long count, dal_error *error);

/* The system of the spec, or the one that the option extend-energy selects. */
const dal_system *dal_run_system(const dal_run *run);
/* The present time, from start_time. */
double dal_run_time(const dal_run *run);
/* The step size h, in units of t; negative: backwards. */
double dal_run_step_size(const dal_run *run);
/* The tolerance under which that is divided; 0: it is not. */
double dal_run_tolerance(const dal_run *run);
/* Steps since the start, those before a restore included. */
long long dal_run_steps(const dal_run *run);
/* Evaluations of the field, or of the lifted field, since the start. */
long long dal_run_evaluations(const dal_run *run);
/* Numbers in a state: 4n + 2 on the lifted space, 2n + multipliers on the physical one. */
int dal_run_dimension(const dal_run *run);
/* The present state, [dimension]: q, v, e, p, pi, pi_e (lifted) or q, v, g (physical). */
const double *dal_run_state(const dal_run *run);
/* The parameter values of the run, [parameters]. */
const double *dal_run_parameters(const dal_run *run);
/* Replaces time and state, state[dimension], and clears all other persistent state.  The state need
 * not satisfy the constraints, and e may be infinite.  Errors: DAL_STATUS_NOT_FINITE. */
dal_status dal_run_set_state(dal_run *run, double t, const double *state, dal_error *error);
/* Writes the name of state component i, from 0, into buffer[size]: x, x', e, p_x, pi_x, pi_e, g1;
 * returns buffer, NULL past the last. */
char *dal_run_component_name(const dal_run *run, int i, char *buffer, size_t size);
/* The number of the state component with a name of dal_run_component_name; -1 where there is
 * none. */
int dal_run_component_index(const dal_run *run, const char *name);
/* Sets one parameter between two steps.  The next step is like a first one: no stages are
 * extrapolated, and +project-energy takes the energy of the present state.  The observable error is
 * NaN from then on.  DAL_STATUS_INCONSISTENT says that the parameter is set, and that a constraint
 * is thus violated (as at a start).  Errors, which change nothing: DAL_STATUS_NAME with the nearest
 * name, DAL_STATUS_NOT_FINITE, DAL_STATUS_SINGULAR_MASS, DAL_STATUS_SINGULAR, DAL_STATUS_RANK,
 * errors of prepare and field. */
dal_status dal_run_set_parameter(dal_run *run, const char *name, double value, dal_error *error);

/* The persistent state and the parameters, *count doubles: all that passes from one step to the
 * next.  A copy of it is a checkpoint. */
const double *dal_run_save(const dal_run *run, size_t *count);
/* Restores a copy, saved[count], into a run of the same spec, which then continues with the same
 * bits.  Errors, which change nothing: DAL_STATUS_ARGUMENT (a wrong count, another effort or mu_e,
 * or a number that the state cannot have, such as a counter of 1.5), DAL_STATUS_NOT_FINITE, and
 * where the system cannot be prepared with the parameters errors of prepare. */
dal_status dal_run_restore(dal_run *run, const double *saved, size_t count, dal_error *error);

/* The number of observables, in this order: D1..Dm, E (with an energy), H, |p|, |pi|, |pi_e|
 * (lifted; max norms), invariants, with the option reactions h1.., R_x.. and lambda1.. (of the
 * last step; h before), C1.. of holonomic constraints, error (max over q; with an exact solution
 * from the start). */
int dal_run_observables(const dal_run *run);
/* Writes the name of observable i into buffer[size]; returns buffer, NULL past the last. */
char *dal_run_observable_name(const dal_run *run, int i, char *buffer, size_t size);
/* Writes the observables of the present state to out.  Errors: as for the callbacks. */
dal_status dal_run_observe(dal_run *run, double *out);
/* The scales of the observables at the present state, [observables] in memory of the run until it
 * is used again; NULL where a callback fails: the largest of the terms that each is made of, see
 * dal_scale_callback, by which roundings are measured.  Where a system has no scales they are
 * sum_i |A_ai v_i| + |D_a|, sum |E_q q| + sum |E_v v| + |E| (|E| without energy_normal), |I|, |h_a|
 * and sum_a |B_ai h_a|; of H the largest |pi_i^2/2e|, |pi_i F_i|, |p_i v_i|; of error |q_i| where
 * it is largest; of the other norms their own values. */
const double *dal_run_scales(dal_run *run);

/* An event as it has just happened. */
typedef struct dal_occurrence {
    int event;            /* its number in the system, from 0 */
    long long number;     /* how often it has happened so far, this time included */
    int direction;        /* 1: its formula increased along the run, -1: it decreased */
    double t;             /* the time */
    const double *before; /* [dimension] the state before it acted; the run has that after it */
} dal_occurrence;

/* Callbacks of dal_run_sample; any may be NULL.  Any status but DAL_STATUS_OK ends the run with
 * it. */
typedef struct dal_observer {
    void *user; /* the first argument of every callback */
    /* Called for each row. */
    dal_status (*sample)(void *user, dal_run *run, long long row, double t);
    /* Called now and then between rows. */
    dal_status (*poll)(void *user, dal_run *run);
    /* Called at the start and after every `every` steps. */
    dal_status (*step)(void *user, dal_run *run);
    /* Replaces step for long runs: receives the observables of several such steps at once, number i
     * at t[k], k < count, in values[i * stride + k].  E and the invariants are without what events
     * have added (dal_run_event_jump): the rest shows whether the motion between events conserves
     * them.  The run is not yet at the next of these steps. */
    dal_status (*values)(void *user, dal_run *run, int count, const double *t, const double *values,
                         size_t stride);
    /* Called before values with the states of the same steps: component i at t[k] is
     * states[i * stride + k]. */
    dal_status (*states)(void *user, dal_run *run, int count, const double *t, const double *states,
                         size_t stride);
    /* Called with the scales of all observables, see dal_run_scales, at the first state that values
     * receives and at later ones at equal distances, which double when there are 32 of them. */
    dal_status (*scales)(void *user, dal_run *run, const double *scales);
    /* Called after each event of a system that has events. */
    dal_status (*event)(void *user, dal_run *run, const dal_occurrence *event);
    long long every; /* steps between two calls of step or values; 0: no calls */
    /* t of each row in the direction of the run, T for the last; NULL: at equal distances */
    double (*row_time)(void *user, long long row);
    /* Max steps and rows between two polls, rounded down to 992, 496, 248, 124, ... 1; 0: 992.
     * poll may change it where steps are slow. */
    long long polling;
} dal_observer;

/* Advances the run to time T and samples rows first_row..samples, T0 = start_time, at t = T0 +
 * row*(T - T0)/samples, rounded once, where T0 and T are the decimal numbers of at most 15 digits
 * that read as these doubles, where there are such: a run to 3 T with 3 samples has its first rows
 * at the same times.  The trajectory consists of steps h, which must lead to T;
 * dal_run_intermediate gives a row between two of them.  After an interruption between rows pass
 * the first row not sampled.  observer may be NULL.  A step that would pass an event of the system
 * ends at it, to rounding; the next one has size h again.  Where an event ends the run, or cannot
 * be passed, the last row is there, at the time that is reached.  Errors: as for a step;
 * DAL_STATUS_STOPPED where an event ends the run; DAL_STATUS_EVENT where one cannot be passed: it
 * happens infinitely often, as when a ball comes to rest, or leaves velocities that lead out of the
 * allowed side; DAL_STATUS_UNSUPPORTED with events on the lifted space off p = pi = 0;
 * DAL_STATUS_ARGUMENT, before anything is done, also where a row's time is not finite or before the
 * time of the row before it, or every or polling is negative; what a callback returns. */
dal_status dal_run_sample(dal_run *run, double T, long long samples, long long first_row,
                          const dal_observer *observer, dal_error *error);
/* Takes a step of size h from the present state, calls observe there, and restores the run to the
 * bit.  Under a tolerance, and with h less than the step of the run, the state is one within the
 * next step: the one of the polynomial of the substep that contains it, if the method has dense
 * output.  observe must not move the run.  Errors: as for a step, the run being unchanged;
 * DAL_STATUS_ARGUMENT; what observe returns. */
dal_status dal_run_intermediate(dal_run *run, double h,
                                dal_status (*observe)(void *user, dal_run *run), void *user,
                                dal_error *error);

/* How often an event of the system, from 0, has happened; -1 without the event. */
long long dal_run_event_count(const dal_run *run, int event);
/* The number of the event that stopped the run, from 1; 0: none did. */
int dal_run_stopped(const dal_run *run);
/* How many steps may hide events, since the run was made: steps whose intervals h, 1024 of them,
 * still have |d(when)/dt| h > pi max |when|.  The first begins at *from, NaN: there is none; from
 * may be NULL. */
long long dal_run_unresolved(const dal_run *run, double *from);
/* What events have added to an observable that is E or an invariant, all together; 0 for others. */
double dal_run_event_jump(const dal_run *run, int observable);

#ifdef __cplusplus
}
#endif
#endif
