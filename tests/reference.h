/* reference.h - a system made from text, and its equations by an independent way: finite
 * differences of Lagrangian, forces and constraints written in C. */
#ifndef REFERENCE_H
#define REFERENCE_H

#include <dalembert.h>

enum { REFERENCE_MAX = 8, REFERENCE_OUT = 4 * REFERENCE_MAX * REFERENCE_MAX };

typedef struct reference {
    dal_model *model;
    const dal_system *system;
    double *work; /* room for 64 lanes, aligned to 8 */
} reference;

/* Both end the test program with a message when the text is no system. */
reference reference_of_text(const char *yaml);
reference reference_builtin(const char *name);
/* The tangent system of another one, which keeps the model. */
reference reference_tangent(const reference *of);
void reference_free(reference *b);
/* Sets a parameter and prepares the work again. */
void reference_set(reference *b, const char *parameter, double value);

/* Calls a callback at one point. */
dal_status reference_call(const reference *b, dal_callback *call, double t, const double *q,
                          const double *v, double *out);
dal_status reference_pull(const reference *b, double t, const double *q, const double *v,
                          const double *pi, double *out);

/* count numbers into lanes interleaved, lane l moved by l/16; and one lane of them back. */
void reference_scatter(int lanes, int count, const double *x, double *wide);
void reference_gather(int lanes, int lane, int count, const double *wide, double *x);

/* ---- the independent way ---- */

typedef double reference_function(int index, const double *q, const double *v, double t);

typedef struct reference_formulas {
    int n, m;
    reference_function *lagrangian; /* index unused */
    reference_function *force;      /* of coordinate index; NULL: none */
    reference_function *constraint; /* number index */
    reference_function *reaction;   /* B, index a*n + i; NULL: A, by Chetaev's rule */
} reference_formulas;

/* First derivative of f at x[i], x one of q, v (n each) or t, by the central difference of order 8
 * with steps of 0.02: truncation about 1e-16 of the ninth derivative, rounding 1e-14. */
double reference_by_q(reference_function *f, int index, int i, const double *q, const double *v,
                      double t);
double reference_by_v(reference_function *f, int index, int i, const double *q, const double *v,
                      double t);
double reference_by_t(reference_function *f, int index, const double *q, const double *v, double t);
/* Second derivatives of L by v_i and then v_j, q_j or t: rounding about 1e-12. */
double reference_mass(const reference_formulas *f, int i, int j, const double *q, const double *v,
                      double t);
/* b = L_q - L_vq v - L_vt + Q, and c = D_q v + D_t. */
double reference_load(const reference_formulas *f, int i, const double *q, const double *v,
                      double t);
double reference_drift(const reference_formulas *f, int a, const double *q, const double *v,
                       double t);
/* Solves the n equations in a[n*(n+1)] by elimination with row pivots; the last column becomes the
 * solution. */
void reference_solve(int n, double *a);
/* F from W F - B^T h = b, A F = -c. */
void reference_motion(const reference_formulas *f, const double *q, const double *v, double t,
                      double *F);

/* max |a - b| over max(1, max |b|). */
double reference_distance(int count, const double *a, const double *b);

/* Three coordinates with a full mass matrix, forces and time: the keys of its file, and the same by
 * hand. */
#define REFERENCE_FULL                                                                             \
    "coordinates: [x, y, z]\n"                                                                     \
    "lagrangian: (1 + x^2)*x'^2/2 + x'*y'*cos(z)/3 + y'^2 + z'^2/2 + x*z'*t - x*y*z\n"             \
    "forces: {y: -x'/4, z: sin(t)}\n"
reference_function reference_full_lagrangian, reference_full_force;

#endif
