/* dalembert_method.h - integrators, methods and options.
 *
 * A part of dalembert.h, which has the conventions. */
#ifndef DALEMBERT_METHOD_H
#define DALEMBERT_METHOD_H

#include "dalembert_system.h"

#ifdef __cplusplus
extern "C" {
#endif

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
    DAL_EXTRAPOLATES_STAGES = 1 << 12,   /* the first guess of a step is made from the last step */
    DAL_PERSISTENT_ACCELERATION = 1 << 13, /* begins with what the last step ended with */
    DAL_PRESERVES_HOLONOMIC = 1 << 14      /* every holonomic constraint g, with its D */
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
    DAL_NEEDS_SERIES = 1 << 10,     /* Taylor coefficients of F, of a model with smooth formulas */
    DAL_NEEDS_CONSTANT_MASS = 1 << 11, /* W depends on parameters alone and has an inverse */
    DAL_NEEDS_MASS_OF_Q = 1 << 12 /* with holonomic constraints: W does not depend on v, likewise */
};

struct dal_step;
/* One step; see dalembert_kernel.h. */
typedef dal_status dal_step_function(struct dal_step *step);

/* A constant descriptor; its file in integrators/ holds the mathematics. */
typedef struct dal_integrator {
    const char *name;      /* lower case, "rk4"; of a modifier the part after the + */
    const char *alias;     /* another name, or NULL */
    const char *summary;   /* what it is, in a few words */
    const char *reference; /* where it is from */
    const char
        *documentation;      /* a paragraph of Markdown about its family: equations as LaTeX between
                                  dollars, order, source, what is preserved; or NULL */
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
           "moves the start to g = 0 and D = 0, by the least change in the mass metric")           \
    OPTION(bool, bare, "bare", false, 0, 1, "off|on",                                              \
           "leaves a method that holonomic constraints drift with as it is, without +project")     \
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

#ifdef __cplusplus
}
#endif
#endif
