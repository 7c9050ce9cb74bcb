/* dalembert_system.h - systems: what moves, as a plain struct.
 *
 * A part of dalembert.h, which has the conventions. */
#ifndef DALEMBERT_SYSTEM_H
#define DALEMBERT_SYSTEM_H

#include "dalembert_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- systems ------------------------------------------------------------------------------- */

typedef struct dal_system dal_system;

/* The symmetric K of the lift's H = pi.K pi/(2e) + pi.F + p.v + mu_e pi_e: EFFORT(code, name).  Its
 * trajectories are the extremals of the cost int e/2 |u|^2 dt of steering by dv/dt = F + N u, where
 * K = N N^T.  On p = pi = 0 the motion has the same bits for every K. */
#define DAL_EFFORT_LIST(EFFORT)                                                                    \
    EFFORT(IDENTITY, "identity")     /* 1: the action (nh10) */                                    \
    EFFORT(MASS, "mass")             /* W^-1: the force, in the mass metric */                     \
    EFFORT(CONSTRAINT, "constraint") /* P W^-1 P^T, P = 1 - R (A R)^-1 A, R = W^-1 B^T: A K = 0 */ \
    EFFORT(CONTROLS, "controls")     /* P W^-1 C C^T W^-1 P^T, C[n*k] of the section controls */
/* The number of an effort. */
typedef enum dal_effort {
#define CODE(code, name) DAL_EFFORT_##code,
    DAL_EFFORT_LIST(CODE)
#undef CODE
        DAL_EFFORT_COUNT
} dal_effort;
/* The name of an effort, "mass"; "?" for another number. */
const char *dal_effort_name(dal_effort effort);

/* Where a system is evaluated.  work begins with the parameter values, [system->parameters]; the
 * rest of its system->workspace doubles are the system's own (filled by prepare) and scratch.
 * Functions with a memory of their own, as a dal_evaluator has, read t, q and v alone. */
typedef struct dal_point {
    double t;            /* time */
    const double *q;     /* [n] coordinates */
    const double *v;     /* [n] velocities, then [multipliers] vakonomic multipliers g */
    const double *pi;    /* [n] momenta of the velocities, of adjoint; of projection, velocities; of
                            enforcement pi[n], c[m] and beta, of reaction and position l[m] and
                            beta */
    double *work;        /* [workspace] */
    const double *times; /* [lanes] the times in a wide set, where they differ; else NULL */
} dal_point;

/* A formula of a system: a pure function of *at (work beyond the parameters is scratch) that writes
 * out; the member that points to it says what.  In the wide sets each array is interleaved,
 * x[component*lanes + lane], and aligned to its lanes; t is common unless there are times.  A
 * callback that fails returns a status, or leaves NaN in the lanes that failed. */
typedef dal_status dal_callback(const dal_system *system, const dal_point *at, double *out);

/* The scale of each of some formulas f at a point: the largest |df/dx x| over its variables x and
 * the terms that it is made of, |f| among them.  eps times it is what one rounding can do; it
 * changes with the units as f does, and is 0 only where every term is.  memory[scale_memory]
 * belongs to the caller. */
typedef dal_status dal_scale_callback(const dal_system *system, const dal_point *at, double *memory,
                                      double *out);

/* The callbacks of a step: code, member, what each reads of its point, the numbers of its output,
 * with nw = n + multipliers, and what they are.  All but field may be NULL, which excludes what is
 * in parentheses.  guards keep their signs; blocks is of F = a + R h, B = A by Chetaev's rule;
 * potential is of L = v.Wv/2 + g.v - U, W constant, for each coordinate those that U and W couple
 * it with, and the first two are 0 where that U is quadratic.
 * With DAL_MASS_ON_KERNEL W need not have an inverse: W^-1 A^T and R are the X with A X = 1 and
 * W X = A^T Z for some Z, W^-1 b is the a with A a = 0 and W a = b + A^T z for some z, and so with
 * W^-1 E_q. */
/* clang-format off */
#define DAL_CALLBACK_LIST(CALLBACK) \
    CALLBACK(FIELD, field, tqv, nw) /* F, then dg/dt */ \
    CALLBACK(ADJOINT, adjoint, tqvpi, 3 * n) /* F, F_q^T pi, F_v^T pi (lifted space) */ \
    CALLBACK(EFFORT, effort, tqvpi, 3 * n) /* K pi, (pi.K pi)_q/2, (pi.K pi)_v/2; NULL: K = 1 */ \
    CALLBACK(JACOBIAN, jacobian, tqv, nw * (n + nw)) /* F_q, F_(v,g) (Newton) */ \
    CALLBACK(CONSTRAINT, constraint, tqv, m + 2 * m * n) /* D, A, W^-1 A^T (+project) */ \
    CALLBACK(ENERGY_NORMAL, energy_normal, tqv, 1 + 3 * n) /* E, E_q, E_v, W^-1 E_q */ \
    CALLBACK(GAUGE, gauge, tqve, 1) /* mu_e, with e at pi; NULL: 0 */ \
    CALLBACK(GAUGE_GRADIENT, gauge_gradient, tqve, 2 * n + 1) /* of mu_e by q, v, e; NULL: 0 */ \
    CALLBACK(GUARDS, guards, tqv, guards) /* denominators; NULL: none */ \
    CALLBACK(BLOCKS, blocks, tqv, 2 * (m + m * n) + n) /* D, A, R = W^-1 B^T, a = W^-1 b, */ \
        /* c = D_q v + D_t (methods that enforce D) */ \
    CALLBACK(POTENTIAL, potential, tqv, 3 * n) /* U, U_q.v, v.Wv (discrete-gradient) */ \
    CALLBACK(CORRECTION, correction, tqv, n) /* x, W x = A^T l, A x = -D; NULL: by constraint */ \
    CALLBACK(ENFORCEMENT, enforcement, tqv_pi_c, n + m) /* y, l: W y = beta b + B^T l, */ \
        /* A y = A pi + c; NULL: by blocks, or by constraint with beta = 0 */ \
    CALLBACK(REACTION, reaction, tqv_l, n) /* y, W y = beta b + B^T l; NULL: likewise */ \
    CALLBACK(CONSTRAINT_VALUE, constraint_value, tqv, m) /* D; NULL: by constraint */ \
    CALLBACK(HOLONOMIC, holonomic, tqv, holonomic) /* g(q,t); NULL: there are none */ \
    CALLBACK(POSITION, position, tqv_l, n + holonomic) /* y, l: W y = G^T l, G y = c, G = g_q, */ \
        /* with c where reaction has its last l; NULL: by constraint */
/* clang-format on */
typedef struct dal_callbacks {
#define MEMBER(code, member, ...) dal_callback *member;
    DAL_CALLBACK_LIST(MEMBER)
#undef MEMBER
} dal_callbacks;

/* Taylor coefficients of F along a motion, for integrators with DAL_NEEDS_SERIES; made by a model.
 * From coefficient k of
 *     in[1 + 2n + multipliers]       t, q, v, g; on the lifted space then pi[n]
 * and the lower ones in memory[size[lifted]*stride], k < stride, follows coefficient k of
 *     out[n + multipliers]           F, dg/dt
 *     out[3n + 1]                    F, F_q^T pi, F_v^T pi, mu_e, on the lifted space,
 *     out[3n]                        and what the callback effort gives, where there is one
 * of the powers of time in the system's own unit, units[0]/units[n].  All arrays are interleaved by
 * lanes as for a callback; work is as in dal_point. */
typedef dal_status dal_series_callback(const dal_system *system, int lifted, int k, int stride,
                                       const double *in, double *work, double *memory, double *out);
/* Those callbacks of a system. */
typedef struct dal_series {
    const char *refused;        /* what in F has no Taylor series, "abs"; NULL: nothing */
    size_t size[2];             /* series in memory, on the physical and on the lifted space */
    dal_series_callback *call;  /* one lane */
    dal_series_callback *wide4; /* of 4 lanes; may be NULL */
    dal_series_callback *wide8; /* of 8 lanes; may be NULL */
} dal_series;

/* What is known of the constraints and of the energy; set by a model, or by hand. */
enum {
    DAL_D_LINEAR = 1 << 0,       /* every D linear or affine in v */
    DAL_D_CONSTANT = 1 << 1,     /* every D linear in (q,v) with constant coefficients */
    DAL_D_BILINEAR = 1 << 2,     /* every D bilinear: c.v + q^T B v + d.q */
    DAL_D_QUADRATIC = 1 << 3,    /* every D a polynomial of degree <= 2 in (q,v) */
    DAL_D_RANK_CHECKED = 1 << 4, /* det A W^-1 A^T can vanish along a run: it is checked in steps */
    DAL_E_EXACT = 1 << 5,        /* dE/dt = 0 for every level of D */
    DAL_E_ON_D = 1 << 6,         /* dE/dt = 0 on D = 0 only */
    DAL_AUTONOMOUS = 1 << 7,     /* F does not depend on t */
    DAL_MASS_CONSTANT = 1 << 8,  /* W depends on parameters alone */
    DAL_VAKONOMIC = 1 << 9,      /* vakonomic equations, with multipliers g */
    DAL_SERVO = 1 << 10,         /* reactions along directions B of their own, not along A^T */
    DAL_BLOCKS_POSITIONAL = 1 << 11, /* every D linear, W^-1 b and A without v */
    DAL_D_ISOKINETIC = 1 << 12,      /* one D = k (v.Wv/2 - K), W constant, W^-1 b without v */
    DAL_WIDE_TIMES = 1 << 13,        /* the wide sets read dal_point.times, or no time at all */
    DAL_MASS_ON_KERNEL = 1 << 14,    /* W need be regular on ker A only, see dal_callbacks */
    DAL_F_POSITIONAL = 1 << 15,      /* F, and K of the effort, depend on neither v nor g */
    DAL_EFFORT_OF_V = 1 << 16        /* K of the effort depends on v */
};

/* ---- events -------------------------------------------------------------------------------- */

/* What an event does; without any of these it is counted and reported only. */
enum {
    DAL_EVENT_SETS = 1 << 0,   /* sets q and v; v is then moved to D = 0 */
    DAL_EVENT_TURNS = 1 << 1,  /* sets a velocity: d(when)/dt must lead back to the allowed side */
    DAL_EVENT_IMPACT = 1 << 2, /* restitution */
    DAL_EVENT_STOPS = 1 << 3   /* ends the run */
};
/* An event happens where its formula `when` passes through 0 along a run. */
typedef struct dal_event {
    const char *name; /* "event 1 (y - r)", for messages */
    int direction;    /* 1: when increases along the run, -1: decreases, 0: both */
    unsigned actions; /* DAL_EVENT_SETS | ... */
} dal_event;

/* The branches of F where sign, abs, min, max, floor, a comparison or a table switches from one
 * formula to another as an argument s passes certain values.  A run with events repeats a step in
 * which s may do so with the branches held as at its begin, so that F is smooth in it, and an event
 * there is found as exactly as anywhere else; see docs/events.md.  Made by a model.  A system
 * written in C has none: its events have, where F jumps, the error of a step across the jump. */
typedef struct dal_branches {
    int count;            /* how many there are */
    dal_callback *values; /* out[2*count]: s of each, then the size of which eps is its rounding */
    dal_callback *rates;  /* out[count]: ds/dt along the motion */
    /* The values, infinite ones among them, between which branch k of s = point stays. */
    void (*bounds)(const dal_system *system, int k, double point, double *lower, double *upper);
    /* Until the next call the callbacks of a step, the rates of events and these two decide as for
     * s = point[count]; NULL: as s is.  work: as in the points where they are evaluated. */
    void (*hold)(const dal_system *system, const double *point, double *work);
} dal_branches;

/* A coordinate that a start solves from g = 0, or a velocity from D = 0, and where a file names it,
 * for messages. */
typedef struct dal_solved {
    int number;       /* of the coordinate or velocity, from 0 */
    int line, column; /* from 1, or 0 */
} dal_solved;

/* A second-order system with constraints, as a plain struct: filled by a model or by hand with
 * designated initialisers; what is not named may stay zero. */
struct dal_system {
    const char *name;              /* for messages and files; may be NULL, as the next two */
    const char *title, *reference; /* a line for people; where the system is from */
    int n;                         /* coordinates, >= 1 */
    int m;                         /* constraints D */
    int holonomic;   /* of these, the last: D = g_q v + g_t of holonomic constraints g(q,t) = 0 */
    int multipliers; /* first-order variables beside v (vakonomic g); 0 or m, any where m = 0 */
    int parameters, invariants, guards, tags, tables; /* how many there are */
    int observed; /* of the invariants, the last: formulas that dal_model_observe has added */
    unsigned properties;           /* DAL_D_LINEAR | ...: what is known of D and E */
    const char *const *coordinate; /* [n] names; NULL: q1, q2, ... */
    const char *const *parameter;  /* [parameters] names */
    const double *value;           /* [parameters] default values */
    const char *const *invariant;  /* [invariants] names */
    const char *const *guard;      /* [guards] "constraint 1: y1'" for messages */
    dal_effort effort;             /* of the lift: which K call.effort is of */
    const char *gauge;             /* of the lift: the formula of mu_e; NULL: 0, or not known */
    int mass_guard;                /* which guard, from 1, is det W; 0: none */
    const char *const *tag;        /* [tags] words that classify the system */
    const char *const *table;      /* [tables] names, for messages */
    size_t workspace;              /* doubles in dal_point.work; 0 means parameters */
    int pivots; /* numbers that field and adjoint leave at the end of work: pivots of the equations
                   they solve; the rank check is spared where these are steady; 0: none */
    dal_callbacks call;                 /* one lane */
    const dal_callbacks *wide4, *wide8; /* of 4 and of 8 lanes, interleaved; may be NULL */
    dal_callback *prepare;  /* completes work after a change of parameters; out unused */
    dal_callback *start;    /* out[2n + multipliers + 1]: q, v, g, e at the start; NULL: 0, e = 1 */
    int solved_coordinates; /* how many a start solves from g = 0, then */
    int solved_velocities;  /* how many from D = 0, the others being kept; `start` has first
                                guesses.  Needs call.constraint */
    const dal_solved *solved;  /* [solved_coordinates + solved_velocities], in this order */
    dal_callback *constraints; /* out[m]: D alone; NULL: D is not observed */
    dal_callback
        *energy; /* out[1]: E = L_v.v - L, of L - g.D where multipliers are g; NULL: unknown */
    dal_callback *invariant_values; /* out[invariants]; NULL: no invariants */
    dal_callback *reactions;        /* out[m + m*n]: h, B of the force B^T h in F; NULL: unknown */
    dal_scale_callback *scales;     /* out[m + 1 + invariants + holonomic]: of D, E, the invariants
                                   and g; NULL: estimated, see dal_run_scales */
    dal_scale_callback *reaction_scales; /* out[m + n]: of h and R = B^T h; NULL: likewise */
    size_t scale_memory;                 /* doubles that these two need */
    const double *units; /* [n + nw + m + 1] how large each q, v, g, D and E is, powers of two: a
                            tolerance is relative to |x| plus the unit of q and v, equations are
                            solved and pivots chosen in units of v, D and E; NULL: all are 1 */
    dal_callback *projection; /* out[m + 2*m*n]: D, A, W(q,u)^-1 A^T, u being at->pi; NULL: W does
                                 not depend on v, call.constraint gives the same */
    int equations;            /* how many the section equations has */
    dal_callback *equation_values; /* out[equations]: S(q, v, q''), q'' being at->pi; NULL: none */
    dal_callback *exact;           /* out[2n]: q, v of the exact solution at at->t; NULL: unknown */
    int events;                    /* how many there are, in the order in which they act */
    const dal_event *event;        /* [events] */
    dal_callback *event_values;    /* out[events]: when; this and the next three need events */
    dal_callback *event_rates;     /* out[events]: d(when)/dt along the motion */
    dal_callback *event_states;    /* out[2n*events]: q, v as each sets them; NULL: none does */
    dal_callback *event_normals;   /* out[(1 + 2n)*events]: restitution, when_q, W^-1 when_q */
    dal_callback
        *diagnose; /* out[1]: why field is not finite here: returns DAL_STATUS_SINGULAR with the
                               number of the constraint (from 1), DAL_STATUS_SINGULAR_MASS,
                               DAL_STATUS_NOT_FINITE with the one of a table read outside its
                               points, or DAL_STATUS_OK */
    const dal_system *extended;   /* F continued off D = 0 so that E is exact, for extend-energy */
    const dal_system *quad;       /* work in quad precision, for precision; these two may be NULL */
    const dal_series *series;     /* Taylor coefficients of F; NULL: none */
    const dal_branches *branches; /* of F where there are events; NULL: none, or not known */
    const struct dal_picture *picture;         /* how it is drawn; NULL: not at all */
    void *data;                                /* of the owner, for callbacks */
    int field_operations, jacobian_operations; /* arithmetic operations of these callbacks, which
                                                  the solver auto weighs; 0: unknown */
};

/* A value for a name. */
typedef struct dal_setting {
    const char *name; /* of a parameter or of a component of the state */
    double value;     /* finite, except e = INFINITY */
} dal_setting;

#ifdef __cplusplus
}
#endif
#endif
