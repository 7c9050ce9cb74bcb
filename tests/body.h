/* body.h - a system made from text for the tests, with work of its own, and an independent way to
 * its motion: finite differences of Lagrangian, forces and constraints written in C. */
#ifndef BODY_H
#define BODY_H

#include <dalembert.h>

enum { BODY_MOST = 8, BODY_OUT = 4 * BODY_MOST * BODY_MOST };

typedef struct body {
    dal_model *model;
    const dal_system *system;
    double *work; /* room for 64 lanes, aligned to 8 */
} body;

/* Both end the test program with a message when the text is no system. */
body body_of_text(const char *yaml);
body body_builtin(const char *name);
/* The tangent system of another body, which keeps the model. */
body body_tangent(const body *of);
void body_free(body *b);
/* Sets a parameter and prepares the work again. */
void body_set(body *b, const char *parameter, double value);

/* Calls a callback at one point. */
dal_status body_call(const body *b, dal_callback *call, double t, const double *q, const double *v,
                     double *out);
dal_status body_pull(const body *b, double t, const double *q, const double *v, const double *pi,
                     double *out);

/* count numbers into lanes interleaved, lane l moved by l/16; and one lane of them back. */
void body_spread(int lanes, int count, const double *x, double *wide);
void body_pick(int lanes, int lane, int count, const double *wide, double *x);

/* ---- the independent way ---- */

typedef double body_function(int index, const double *q, const double *v, double t);

typedef struct body_formulas {
    int n, m;
    body_function *lagrangian; /* index unused */
    body_function *force;      /* of coordinate index; NULL: none */
    body_function *constraint; /* number index */
    body_function *reaction;   /* B, index a*n + i; NULL: A, by Chetaev's rule */
} body_formulas;

/* First derivative of f at x[i], x one of q, v (n each) or t, by the central difference of order 8
 * with steps of 0.02: truncation about 1e-16 of the ninth derivative, rounding 1e-14. */
double body_by_q(body_function *f, int index, int i, const double *q, const double *v, double t);
double body_by_v(body_function *f, int index, int i, const double *q, const double *v, double t);
double body_by_t(body_function *f, int index, const double *q, const double *v, double t);
/* Second derivatives of L by v_i and then v_j, q_j or t: rounding about 1e-12. */
double body_mass(const body_formulas *f, int i, int j, const double *q, const double *v, double t);
/* b = L_q - L_vq v - L_vt + Q, and c = D_q v + D_t. */
double body_load(const body_formulas *f, int i, const double *q, const double *v, double t);
double body_drift(const body_formulas *f, int a, const double *q, const double *v, double t);
/* Solves the n equations in a[n*(n+1)] by elimination with row pivots; the last column becomes the
 * solution. */
void body_solve(int n, double *a);
/* F from W F - B^T h = b, A F = -c. */
void body_motion(const body_formulas *f, const double *q, const double *v, double t, double *F);

/* max |a - b| over max(1, max |b|). */
double body_distance(int count, const double *a, const double *b);

#endif
