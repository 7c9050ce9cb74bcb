/* dalembert_steer.h - boundary values: the cheapest way from a state to another.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_STEER_H
#define DALEMBERT_STEER_H

#include "dalembert_model.h"
#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The lift's motions are the extremals of the cost
 *
 *     S = int e/2 |u|^2 dt = int pi.K pi/(2e) dt,    dv/dt = F + K pi/e,    K = N N^T, e u = N^T pi
 *
 * of steering q'' = F + N u (the paper's action where K = 1).  Steering finds one with given
 * components of (q, v) at both ends; where a component is not given its momentum is 0, and the cost
 * is least with respect to it.  With K of the efforts constraint and controls, A K = 0 and D is an
 * integral of the lift for all p and pi: a target must lie on D = 0, and momenta are determined up
 * to the gradients of D, at both ends; those orthogonal to them at the start are chosen.
 *
 * Vakonomic motion has no lift: its motions (q, v, g) are the extremals of S = int L dt with D = 0
 * and q given at the ends; where a coordinate is free, its momentum L_v - g.A is 0.  Multipliers g
 * of the start are a first guess. */

/* What is to be found: dal_steer_settings_default has the values. */
typedef struct dal_steer_settings {
    const dal_setting *target; /* [targets] values of x, x' at the end; the others are free there */
    int targets;               /* how many there are */
    const char *const *free_starts; /* [frees] components x, x' of the start that are free; their
                                       values are the first guess */
    int frees;                      /* how many there are */
    bool rest;  /* velocities that neither the spec nor the target names are 0, at both ends */
    bool aim;   /* p = pi = 0 and S = 0: natural motions whose velocities on D = 0 at the start are
                   free and hit the target */
    int starts; /* first guesses: the straight line and randomly bent ones; 1.  Where none of
                   them leads to the target up to 8 more are made, and then the end of a motion to
                   another one is moved to it. */
    unsigned long long seed; /* of these; 1 */
    int iterations;          /* max for each guess; 200 */
    double tolerance;        /* max residual, relative to how large the components are; 1e-11 */
} dal_steer_settings;
/* The default settings. */
dal_steer_settings dal_steer_settings_default(void);

/* A motion that was found, or the nearest to one. */
typedef struct dal_extremal {
    dal_status status;              /* DAL_STATUS_OK: it is an extremal, and ends at the target */
    char message[DAL_MESSAGE_SIZE]; /* why not; else "" */
    double S;         /* the action, e (pi_e(T) - pi_e(0)); int L dt of vakonomic motion */
    double residual;  /* the largest jump between its pieces and distance from the ends, relative
                            to how large the components are */
    double distance;  /* of its end from the target: max over the given components; where a step
                            fails before it infinite, as residual is, with S and max_D NaN */
    double max_D;     /* max |D_a| along it */
    double condition; /* of the bordered matrix of Newton's method: max over min singular value */
    int iterations;   /* that were taken */
    int rank;         /* of d(q, v)(T)/d(p, pi)(0); with aim, and of vakonomic motion, -1 */
    int conjugate_times;    /* how many there are before T: with none S is a local minimum;
                            -1: not known, where an end has free components, with aim, and of
                            vakonomic motion */
    double first_conjugate; /* near the first of them; NaN: none */
    double *z;              /* [rows*dimension] states, as dal_run_state orders them; NaN after
                               a step that fails, and u */
    double *u;              /* [rows*inputs] the inputs along it */
} dal_extremal;

/* What came out.  Motions that could not be completed come after those that were, these in the
 * order of S. */
typedef struct dal_steering {
    int n, dimension;  /* coordinates; numbers of a state, 4n + 2; 2n with aim; 2n + m of
                              vakonomic motion */
    int inputs;        /* numbers of u: with the effort controls its columns; none with aim and of
                              vakonomic motion; else n, and u is the acceleration K pi/e */
    long long rows;    /* of a motion: the start and each step */
    double *t;         /* [rows] */
    int allowed;       /* the rank that d(q, v)(T)/d(p, pi)(0) can have: r + n - m, where r is the
                              rank of the brackets of what D allows; with the effort controls the
                              rank of the brackets of controls and drift (v, F), at generic points
                              near the start on D = 0; -1: not known */
    bool has_growth;   /* whether D has a growth vector */
    dal_growth growth; /* of the velocities that D allows, on the space of q */
    int count;         /* motions: distinct ones, at most one for each first guess */
    dal_extremal *extremal; /* [count] */
} dal_steering;

/* Callbacks of dal_steer_create; each may be NULL.  Any status but DAL_STATUS_OK ends the search,
 * with what it has. */
typedef struct dal_steer_observer {
    void *user; /* the first argument of the callbacks */
    /* Called once before the search, with what can be reached: allowed and growth; there are no
     * motions yet. */
    dal_status (*reach)(void *user, const dal_steering *steering);
    /* Called before each iteration with the first guess, from 0, that it is of, and the residual of
     * the last one; -1 in its place where the end of a motion is moved to the target.  While a
     * motion of many steps is moved it is called again and again with the same numbers; where it
     * ends the search there this motion is left out. */
    dal_status (*step)(void *user, int guess, int iteration, double residual);
} dal_steer_observer;

/* Finds motions of the model's system from the start of spec to the target at time T, a whole
 * number of steps after start_time: by Gauss-Newton on a coarse grid with u constant in its pieces,
 * then by Newton's method on multiple shooting of the steps themselves, so that jumps between
 * pieces are at rounding and S has the order of the method.  settings->target must be given;
 * observer may be NULL.  The result is there, too, where no motion hits the target: its status says
 * so.  [alloc]  Errors: errors of the start; DAL_STATUS_NAME (of a component), DAL_STATUS_ARGUMENT
 * (T, settings, a system of another model), DAL_STATUS_INCONSISTENT (a target off D = 0 or g = 0,
 * or off the leaf of the start where D is integrable and what it conserves is found);
 * DAL_STATUS_UNSUPPORTED, and the message says the reason: as for dal_sensitivity_create off
 * p = pi = 0, mu_e that is not 0, 1/e = 0; rest, aim and velocities of vakonomic motion. */
dal_status dal_steer_create(dal_steering **steering, dal_model *model, const dal_run_spec *spec,
                            double T, const dal_steer_settings *settings,
                            const dal_steer_observer *observer, dal_error *error);
/* Frees it; NULL is allowed. */
void dal_steer_free(dal_steering *steering);

#ifdef __cplusplus
}
#endif
#endif
