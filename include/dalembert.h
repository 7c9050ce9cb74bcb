/* dalembert.h - methods, options, runs and batches; with dalembert_system.h, which it includes.
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
 * Nothing here prints, reads the environment or has global state.  Different objects may be used in
 * different threads. */
#ifndef DALEMBERT_H
#define DALEMBERT_H

#include "dalembert_system.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- version ------------------------------------------------------------------------------- */

#define DAL_VERSION_MAJOR 0 /* before 1.0 a new minor version may change the interface */
#define DAL_VERSION_MINOR 5 /* a part of the soname, libdalembert.so.MAJOR.MINOR, before 1.0 */
#define DAL_VERSION_PATCH 0 /* leaves the interface as it is */
/* The version as a text, "0.5.0". */
#define DAL_VERSION DAL__VERSION_OF(DAL_VERSION_MAJOR, DAL_VERSION_MINOR, DAL_VERSION_PATCH)

#define DAL__VERSION_OF(major, minor, patch)   DAL__VERSION_TEXT(major, minor, patch)
#define DAL__VERSION_TEXT(major, minor, patch) #major "." #minor "." #patch

/* ---- integrators and methods --------------------------------------------------------------- */

/* Declared properties of an integrator; the conformance suite verifies them. */
enum {
    DAL_SYMMETRIC = 1 << 0,              /* a step h, then a step -h, is the identity */
    DAL_SYMPLECTIC = 1 << 1,             /* on the lifted space; says nothing about D or E */
    DAL_PRESERVES_BILINEAR = 1 << 2,     /* every D bilinear in (q,v) */
    DAL_PRESERVES_QUADRATIC = 1 << 3,    /* every D quadratic in (q,v) */
    DAL_PRESERVES_D = 1 << 4,            /* every D */
    DAL_EXPLICIT = 1 << 5,               /* on the physical space */
    DAL_MODIFIER = 1 << 6,               /* acts on another integrator: NAME+this */
    DAL_COMPONENTWISE = 1 << 7,          /* on (q,v) only adds multiples of v and F */
    DAL_PRESERVES_D_MIDPOINT = 1 << 8,   /* D((q0 + q1)/2, (q1 - q0)/h, t + h/2) = 0 in each step */
    DAL_PRESERVES_ENERGY = 1 << 9,       /* E, where the motion conserves it; with D at midpoints,
                                            where also every D is homogeneous in v */
    DAL_PERSISTENT_MULTIPLIER = 1 << 10, /* a reversible map of (q, v, last multipliers) */
    DAL_ADAPTIVE = 1 << 11,              /* divides a step h where the option tolerance is not 0 */
    DAL_EXTRAPOLATES_STAGES = 1 << 12    /* the first guess of a step is made from the last step */
};

/* What an integrator needs of the system or, a modifier, of the method inside. */
enum {
    DAL_NEEDS_FIELD = 1 << 0,       /* F, on the lifted space with its adjoint */
    DAL_NEEDS_CONSTRAINT = 1 << 1,  /* D, A, W^-1 A^T */
    DAL_NEEDS_SYMMETRIC = 1 << 2,   /* a symmetric method inside */
    DAL_NEEDS_ORDER_2 = 1 << 3,     /* a method of order 2 inside */
    DAL_NEEDS_BLOCKS = 1 << 4,      /* D, A, R, a, c; acts on p = pi = 0 only */
    DAL_NEEDS_POTENTIAL = 1 << 5,   /* U, and a constant W */
    DAL_NEEDS_ISOKINETIC = 1 << 6,  /* DAL_D_ISOKINETIC */
    DAL_NEEDS_ENERGY = 1 << 7,      /* an energy that is conserved, and its gradient */
    DAL_NEEDS_JACOBIAN = 1 << 8,    /* F_q and F_v, on the lifted space */
    DAL_NEEDS_RUNGE_KUTTA = 1 << 9, /* an explicit method that calls dal_field alone */
    DAL_NEEDS_SERIES = 1 << 10      /* Taylor coefficients of F, of a model with smooth formulas */
};

struct dal_step;
/* One step; see dalembert_kernel.h. */
typedef dal_status dal_step_function(struct dal_step *step);

/* A constant descriptor; its file in integrators/ holds the mathematics. */
typedef struct dal_integrator {
    const char *name;        /* lower case, "rk4"; of a modifier the part after the + */
    const char *alias;       /* another name, or NULL */
    const char *summary;     /* what it is, in a few words */
    const char *reference;   /* where it is from */
    int order;               /* 0 for a modifier: the inner method's */
    int stages;              /* solved together or stored at once; determines scratch and, with
                                DAL_EXTRAPOLATES_STAGES, persistent state */
    unsigned properties;     /* DAL_SYMMETRIC | ... */
    unsigned needs;          /* DAL_NEEDS_FIELD | ... */
    unsigned kernel;         /* DAL_KERNEL_SOLVE | ..., see dalembert_kernel.h */
    unsigned inherits;       /* a modifier: properties of the method inside that it preserves */
    dal_step_function *step; /* takes one step */
} dal_integrator;

enum { DAL_LAYERS = 4 /* max integrators in a method: one, and modifiers */ };

/* An integrator and the modifiers around it.  An integrator that is not in the library is used by
 * its address: {{&my_integrator}}. */
typedef struct dal_method {
    const dal_integrator *layer[DAL_LAYERS]; /* innermost first; the rest is NULL */
} dal_method;

/* Integrator or modifier number i of the library, from 0; NULL past the last. */
const dal_integrator *dal_integrator_at(int i);
/* Finds a method of the library by name: "rk4", "gauss8+project".  Errors: DAL_STATUS_NAME with the
 * nearest name. */
dal_status dal_method_parse(dal_method *method, const char *name, dal_error *error);
/* Writes the full name into buffer[size], cut where it does not fit; returns buffer. */
char *dal_method_name(const dal_method *method, char *buffer, size_t size);
/* The stated order. */
int dal_method_order(const dal_method *method);
/* Properties of all layers together, DAL_SYMMETRIC | ... */
unsigned dal_method_properties(const dal_method *method);
/* Needs of any layer, DAL_NEEDS_FIELD | ... */
unsigned dal_method_needs(const dal_method *method);

/* ---- options ------------------------------------------------------------------------------- */

/* The variables of a run. */
typedef enum dal_space {
    DAL_LIFTED,  /* (q, v, e, p, pi, pi_e), the canonical lift (nh20) */
    DAL_PHYSICAL /* (q, v), and g of a vakonomic system */
} dal_space;
/* How implicit equations are solved. */
typedef enum dal_solver {
    DAL_SOLVER_AUTO, /* fixed point; Newton where it costs less and there is a jacobian */
    DAL_FIXED_POINT, /* fixed-point iteration */
    DAL_NEWTON       /* simplified Newton iteration */
} dal_solver;
/* The arithmetic of a run. */
typedef enum dal_precision {
    DAL_DOUBLE, /* 53 binary digits */
    DAL_QUAD    /* 113 binary digits */
} dal_precision;
/* How steps are added to the state. */
typedef enum dal_sums {
    DAL_SUMS_COMPENSATED, /* what a sum rounds off is added to the next one (Kahan 1965) */
    DAL_SUMS_PLAIN        /* plain sums */
} dal_sums;

/* All options: OPTION(type, member, name in texts, default, min, max, the words of the values of an
 * enumeration or bool or a placeholder for the number, help). */
#define DAL_OPTION_LIST(OPTION)                                                                    \
    OPTION(double, step, "step", 0.01, -1e300, 1e300, "H", "step size h; negative: backwards")     \
    OPTION(dal_space, space, "space", DAL_LIFTED, 0, 1, "lifted|physical",                         \
           "variables: the 4n+2 of the lift, or (q,v); vakonomic systems have (q,v) alone")        \
    OPTION(dal_solver, solver, "solver", DAL_SOLVER_AUTO, 0, 2, "auto|fixed-point|newton",         \
           "how implicit equations are solved; to rounding level without solver-tolerance")        \
    OPTION(int, iterations, "iterations", 100, 1, 100000, "N",                                     \
           "maximum number of iterations of an implicit equation")                                 \
    OPTION(bool, extend_energy, "extend-energy", false, 0, 1, "off|on",                            \
           "continues F off D = 0 so that E is conserved there too")                               \
    OPTION(bool, reactions, "reactions", false, 0, 1, "off|on",                                    \
           "observes multipliers h1.., reactions R_x.. of F, and a method's own lambda1..")        \
    OPTION(bool, consistent, "consistent", false, 0, 1, "off|on",                                  \
           "moves the velocities of the start to D = 0, by the least change in the mass metric")   \
    OPTION(double, tolerance, "tolerance", 0, 0.0, 1.0, "TOLERANCE",                               \
           "estimated error, absolute and relative, of substeps, dop853 and taylor; 0: none")      \
    OPTION(double, solver_tolerance, "solver-tolerance", 0, 0.0, 1.0, "CHANGE",                    \
           "relative change at which an implicit equation counts as solved; 0: rounding level")    \
    OPTION(int, extra_iterations, "extra-iterations", 0, 0, 1000, "N",                             \
           "iterations after an implicit equation is solved")                                      \
    OPTION(dal_sums, sums, "sums", DAL_SUMS_COMPENSATED, 0, 1, "compensated|plain",                \
           "how steps are added to the state")                                                     \
    OPTION(                                                                                        \
        dal_precision, precision, "precision", DAL_DOUBLE, 0, 1, "double|quad",                    \
        "arithmetic of the run; quad has 113 binary digits and takes some hundred times longer")

/* How a method takes its steps. */
typedef struct dal_options {
#define OPTION(type, name, word, initial, min, max, value, help) type name;
    DAL_OPTION_LIST(OPTION)
#undef OPTION
} dal_options;

/* The default of every option. */
dal_options dal_options_default(void);
/* Sets the option with a name from a text, "newton" or "0.01".  Errors: DAL_STATUS_NAME with the
 * nearest name, DAL_STATUS_ARGUMENT (out of range), DAL_STATUS_SYNTAX. */
dal_status dal_options_set(dal_options *options, const char *name, const char *text,
                           dal_error *error);

/* The smallest tolerance other than 0: 2^-12 units in the last place of 1 in the precision of the
 * options, 5.4e-20 in double and 4.7e-38 in quad.  Compensated sums gain no more than these digits,
 * since F is rounded.  NaN without options. */
double dal_min_tolerance(const dal_options *options);

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

/* Bytes that a run needs; 0 when the spec cannot be used. */
size_t dal_run_size(const dal_run_spec *spec);
/* Places a run in memory[bytes] of the caller, dal_run_size bytes at least, of any alignment; it
 * need not be freed, unless dal_run_native is used.  Errors: DAL_STATUS_ARGUMENT, DAL_STATUS_NAME
 * with the nearest name, DAL_STATUS_UNSUPPORTED, DAL_STATUS_INCONSISTENT (|D| beyond 1e-10
 * relative), DAL_STATUS_RANK, DAL_STATUS_SINGULAR_MASS, DAL_STATUS_GAUGE, DAL_STATUS_NOT_FINITE,
 * DAL_STATUS_MEMORY (too few bytes). */
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
 * bits.  Errors, which change nothing: DAL_STATUS_ARGUMENT (a wrong count, or a number that the
 * state cannot have, such as a counter of 1.5), DAL_STATUS_NOT_FINITE, and where the system cannot
 * be prepared with the parameters errors of prepare. */
dal_status dal_run_restore(dal_run *run, const double *saved, size_t count, dal_error *error);

/* The number of observables, in this order: D1..Dm, E (with an energy), H, |p|, |pi|, |pi_e|
 * (lifted; max norms), invariants, with the option reactions h1.., R_x.. and lambda1.. (of the
 * last step; h before), error (max over q; with an exact solution from the start). */
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
 * row*(T - T0)/samples, the last at T exactly.  The trajectory consists of steps h, which must lead
 * to T; dal_run_intermediate gives a row between two of them.  After an interruption between rows
 * pass the first row not sampled.  observer may be NULL.  A step that would pass an event of the
 * system ends at it, to rounding; the next one has size h again.  Where an event ends the run, or
 * cannot be passed, the last row is there, at the time that is reached.  Errors: as for a step;
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
/* How many steps may hide events, since the run was made: steps h whose parts, 1024 of them, still
 * have |d(when)/dt| h > pi max |when|.  The first begins at *from, NaN: there is none; from may be
 * NULL. */
long long dal_run_unresolved(const dal_run *run, double *from);
/* What events have added to an observable that is E or an invariant, all together; 0 for others. */
double dal_run_event_jump(const dal_run *run, int observable);

/* ---- batches ------------------------------------------------------------------------------- */

/* Many runs of one system and method, called lanes, that differ in parameters and start. */
typedef struct dal_batch dal_batch;
/* Makes count runs of one spec that are stepped several at a time, each with the bits of a single
 * run.  width: max lanes at a time, 1, 4 or 8; 0: the fastest.  [alloc]  Errors: as for
 * dal_run_init, DAL_STATUS_ARGUMENT (count, width), DAL_STATUS_UNSUPPORTED (quad precision). */
dal_status dal_batch_create(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                            dal_error *error);
/* Frees a batch. */
void dal_batch_free(dal_batch *batch);
/* Sets parameters[parameter_count] and start[start_count] of one lane, which replace the spec's, at
 * its start.  Errors: as for dal_run_init; DAL_STATUS_ARGUMENT (lane, or after a step, unless
 * dal_batch_clear was called). */
dal_status dal_batch_start(dal_batch *batch, int lane, const dal_setting *parameters,
                           int parameter_count, const dal_setting *start, int start_count,
                           dal_error *error);
/* Takes all lanes out of the batch, which keeps its memory and its compiled steps: only lanes that
 * dal_batch_start starts again, from the start_time, are then stepped. */
dal_status dal_batch_clear(dal_batch *batch);
/* dal_run_set_parameter for one lane.  Errors: also DAL_STATUS_ARGUMENT (lane), the status of a
 * lane that has failed. */
dal_status dal_batch_set_parameter(dal_batch *batch, int lane, const char *name, double value,
                                   dal_error *error);
/* Takes count steps in every lane that has not failed.  A lane that fails keeps the state before
 * the failing step and does not slow down the others.  Returns DAL_STATUS_OK while a lane is
 * left. */
dal_status dal_batch_advance(dal_batch *batch, long long count);
/* The number of lanes. */
int dal_batch_count(const dal_batch *batch);
/* The status of a lane: DAL_STATUS_OK, or why its step failed; DAL_STATUS_ARGUMENT without the
 * lane. */
dal_status dal_batch_status(const dal_batch *batch, int lane, dal_error *error);
/* The present time of a lane; NaN without the lane. */
double dal_batch_time(const dal_batch *batch, int lane);
/* Copies the state of a lane to state[dimension], ordered as dal_run_state. */
void dal_batch_state(const dal_batch *batch, int lane, double *state);
/* Copies the states of all lanes, one after the other, to states[count*dimension]. */
void dal_batch_states(const dal_batch *batch, double *states);

/* ---- ensembles ----------------------------------------------------------------------------- */

/* Distributions: DISTRIBUTION(code, word).  uniform(low, high); normal(mean, standard deviation);
 * lognormal: exp of a normal one of that mean and deviation. */
#define DAL_DISTRIBUTION_LIST(DISTRIBUTION)                                                        \
    DISTRIBUTION(UNIFORM, "uniform")                                                               \
    DISTRIBUTION(NORMAL, "normal")                                                                 \
    DISTRIBUTION(LOGNORMAL, "lognormal")

/* A distribution of two numbers. */
typedef enum dal_distribution {
#define DISTRIBUTION_CODE(code, word) DAL_##code,
    DAL_DISTRIBUTION_LIST(DISTRIBUTION_CODE)
#undef DISTRIBUTION_CODE
} dal_distribution;

enum { DAL_VARIATION_NAME = 64 /* bytes of the name of a variation */ };

/* What is added to a number of the start, x, x', e, p_x, .., or to a parameter of each member of an
 * ensemble. */
typedef struct dal_variation {
    char name[DAL_VARIATION_NAME]; /* of what it is added to */
    dal_distribution distribution; /* of the numbers that are drawn */
    double first, second;          /* the two numbers of the distribution */
} dal_variation;

/* Parses "x'=normal(0,0.1)".  Errors: DAL_STATUS_SYNTAX, DAL_STATUS_NAME (of a distribution, with
 * the nearest), DAL_STATUS_ARGUMENT (low not below high, a negative deviation),
 * DAL_STATUS_TOO_LARGE. */
dal_status dal_variation_parse(dal_variation *variation, const char *text, dal_error *error);
/* What a member, from 0, draws: a function of distribution, name, seed and member alone; see
 * lib/run/ensemble.c. */
double dal_variation_draw(const dal_variation *variation, unsigned long long seed,
                          unsigned long long member);
/* Members of an ensemble, any number of which are stepped by one batch, one chunk after the other:
 *
 *     for (first = 0; first < members; first += lanes) {
 *         dal_ensemble_start(ensemble, first, lanes);
 *         dal_batch_advance(dal_ensemble_batch(ensemble), steps);
 *         dal_ensemble_states(ensemble, states);
 *     } */
typedef struct dal_ensemble dal_ensemble;
/* Makes an ensemble of a spec, whose numbers vary by variations[count], with a batch of that number
 * of lanes.  [alloc]  Errors: as for dal_batch_create; DAL_STATUS_NAME (nothing has that name, with
 * the nearest), DAL_STATUS_ARGUMENT (a name twice, or as dal_variation_parse). */
dal_status dal_ensemble_create(dal_ensemble **ensemble, const dal_run_spec *spec,
                               const dal_variation *variations, int count, unsigned long long seed,
                               int lanes, dal_error *error);
/* Frees an ensemble and its batch. */
void dal_ensemble_free(dal_ensemble *ensemble);
/* Starts members first, .., first + count - 1 in the first lanes.  With the option consistent their
 * velocities are moved to D = 0.  A lane without a start is not stepped; dal_batch_status has the
 * reason.  Errors: DAL_STATUS_ARGUMENT (count). */
dal_status dal_ensemble_start(dal_ensemble *ensemble, unsigned long long first, int count);
/* The batch of an ensemble, to be stepped and compiled. */
dal_batch *dal_ensemble_batch(dal_ensemble *ensemble);
/* What the members in the lanes have drawn, draws[started*variations], one member after the
 * other. */
void dal_ensemble_draws(const dal_ensemble *ensemble, double *draws);
/* Their present states, states[started*dimension]; NaN of those that have failed. */
void dal_ensemble_states(const dal_ensemble *ensemble, double *states);

/* The values of one quantity in the members of an ensemble. */
typedef struct dal_spread {
    long long count;        /* how many there are */
    double mean, deviation; /* the mean; the standard deviation, of count - 1 degrees of freedom */
    double min, max;        /* the extreme values */
} dal_spread;

/* The spread of values[count], finite ones; NaN where too few are there. */
void dal_spread_measure(dal_spread *spread, const double *values, long long count);
/* Quantiles of values[count], which are reordered: quantile[i] for p[i] in 0..1, i < quantiles.
 * Between two values it is linear (Hyndman, Fan 1996, type 7, DOI 10.1080/00031305.1996.10473566).
 * NaN without values. */
void dal_measure_quantiles(double *values, long long count, const double *p, int quantiles,
                           double *quantile);
#ifdef __cplusplus
}
#endif
#endif
