/* dalembert_method.h - integrators, and methods made of them; a part of dalembert.h, never included
 * by itself. */
#ifndef DALEMBERT_METHOD_H
#define DALEMBERT_METHOD_H

/* What a descriptor properties; the conformance suite verifies it. */
enum {
    DAL_SYMMETRIC = 1 << 0,
    DAL_SYMPLECTIC = 1 << 1,         /* on the canonical lift; says nothing about D or the energy */
    DAL_PRESERVES_BILINEAR = 1 << 2, /* D bilinear in (q,v) */
    DAL_PRESERVES_QUADRATIC = 1 << 3,  /* D quadratic in (q,v) */
    DAL_PRESERVES_D = 1 << 4,          /* every D */
    DAL_EXPLICIT = 1 << 5,             /* on the physical space */
    DAL_MODIFIER = 1 << 6,             /* works on another integrator: NAME+this */
    DAL_COMPONENTWISE = 1 << 7,        /* on (q,v) only adds multiples of v and F */
    DAL_PRESERVES_D_MIDPOINT = 1 << 8, /* D((q0 + q1)/2, (q1 - q0)/h, t + h/2) = 0 in every step */
    DAL_PRESERVES_ENERGY = 1 << 9,     /* E, where the motion keeps it */
    DAL_PERSISTENT_MULTIPLIER = 1 << 10, /* a map of (q, v, multipliers), which a run carries along;
                                         symmetric and reversible in them */
    DAL_ADAPTIVE = 1 << 11, /* divides a step h by itself where the option tolerance is not 0 */
    DAL_EXTRAPOLATES_STAGES =
        1 << 12 /* keeps the slopes of a step, for the first guess in the next */
};

/* What it needs of the system or, a modifier, of the method inside. */
enum {
    DAL_NEEDS_FIELD = 1 << 0,
    DAL_NEEDS_CONSTRAINT = 1 << 1,
    DAL_NEEDS_SYMMETRIC = 1 << 2,  /* a symmetric method */
    DAL_NEEDS_ORDER_2 = 1 << 3,    /* a method of order 2 */
    DAL_NEEDS_BLOCKS = 1 << 4,     /* the parts of F; there is no such method off p = pi = 0 */
    DAL_NEEDS_POTENTIAL = 1 << 5,  /* U, and a constant W */
    DAL_NEEDS_ISOKINETIC = 1 << 6, /* DAL_D_ISOKINETIC */
    DAL_NEEDS_ENERGY = 1 << 7,     /* an energy that is conserved, and its normal */
    DAL_NEEDS_JACOBIAN = 1 << 8,   /* F_q and F_v, on the lifted space */
    DAL_NEEDS_RUNGE_KUTTA = 1 << 9 /* an explicit method that calls dal_field alone */
};

struct dal_step; /* dalembert_kernel.h */
typedef dal_status dal_step_function(struct dal_step *step);

/* A constant descriptor; its file in integrators/ holds the mathematics. */
typedef struct dal_integrator {
    const char *name, *alias; /* alias: another name, or NULL */
    const char *summary, *reference;
    int order; /* 0 for a modifier: that of the inner method */
    int stages; /* stages solved together or kept at once; sizes scratch and, with DAL_EXTRAPOLATES_STAGES,
                   carried memory */
    unsigned properties, needs;
    unsigned inherits; /* a modifier: properties of the method inside that still hold around it */
    dal_step_function *step;
} dal_integrator;

enum { DAL_LAYERS = 4 };

/* An integrator and the modifiers around it, innermost first; unused places are NULL.
 * An integrator outside the tree is used by its address: {{&my_integrator}}. */
typedef struct dal_method {
    const dal_integrator *layer[DAL_LAYERS];
} dal_method;

/* Built-in integrator or modifier number i, NULL past the last. */
const dal_integrator *dal_integrator_at(int i);

/* "rk4", "gauss8+project".  Errors: DAL_NAME with the nearest name. */
dal_status dal_method_parse(dal_method *method, const char *name, dal_error *error);
/* Writes the full name, at most size bytes with its NUL; returns buffer. */
char *dal_method_name(const dal_method *method, char *buffer, size_t size);
int dal_method_order(const dal_method *method);
unsigned dal_method_properties(const dal_method *method); /* of the whole chain */
unsigned dal_method_needs(const dal_method *method);      /* of any of its links */

#endif
