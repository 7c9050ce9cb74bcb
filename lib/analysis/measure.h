/* measure.h - what the measures share: memory, differences, small least squares. */
#ifndef DAL_MEASURE_INTERNAL_H
#define DAL_MEASURE_INTERNAL_H

#include "core/arguments.h"
#include "dalembert_analysis.h"
#include <stdint.h>

/* rows*columns zeroed doubles, or NULL (also when the product overflows); freed with free. */
double *dal__numbers(size_t rows, size_t columns);

/* The increment of differences to begin with, relative to what a quantity is measured by: the
 * error of order 8 at a function whose nearest singularity is 0.3 away, 576 (2e-3/0.3)^8 / 0.3 =
 * 7e-15, stays below the rounding 2.2e-16/2e-3 = 1e-13.  A coordinate is measured by 1, or by the
 * way h |v| of a step, never by |q|, which only says how far it has travelled; velocities,
 * multipliers and momenta by their own size. */
#define DAL__INCREMENT 2e-3

double dal__increment(double rate);                  /* DAL__INCREMENT * max(1, |rate|) */
double dal__greatest(const double *x, size_t count); /* max |x|; NaN if one is */
/* max_i |a - b| / max(1, |a|); NaN if one is. */
double dal__distance(const double *a, const double *b, size_t count);

/* A curve x(s) in count numbers, and its derivative at s = 0:
 *     x' = sum_(k=1..4) c_k (x(k d) - x(-k d)) / d,   c = 4/5, -1/5, 4/105, -1/280.
 * d is shortened where order 6, from the same values, does not agree, or where the curve has no
 * value. scratch[3*count].  Errors: that of the curve, when it has no values for any d. */
typedef dal_status dal__curve(void *user, double s, double *out);
dal_status dal__differentiate(dal__curve *curve, void *user, double d, int count, double *scratch,
                              double *out);

/* Row j of rows[.. * width] loses its parts along the orthonormal rows before it and becomes a unit
 * vector; its length then. */
double dal__straighten(double *rows, int j, int width);

/* The derivatives by (q, v, g), differences[rows * (n + nw)], of the first rows values of a
 * callback at a point. [alloc] */
dal_status dal__gradients(dal_evaluator *evaluator, dal_callback *callback, int rows,
                          const dal_point *at, double *differences);

/* Modified Gram-Schmidt with column pivoting on a[rows*columns] (destroyed).  Columns shorter
 * than tolerance times the longest count as dependent; the rank is returned, and in *pivot (when
 * not NULL) the shortest over the longest of all that were met, 0 when rank < columns.
 * When right is not NULL it loses its part in the span (what stays is the least residue), and
 * x[columns] is the solution of a x = right with the dependent columns' x at 0. */
int dal__least_squares(int rows, int columns, double *a, double *right, double *x, double tolerance,
                       double *pivot, double *work /* [columns*(columns+2)] */);

/* A public function requires a point with q and v. */
#define DAL_REQUIRE_POINT(at)                                                                      \
    do {                                                                                           \
        DAL_REQUIRE(at, NULL);                                                                     \
        DAL_REQUIRE((at)->q, NULL);                                                                \
        DAL_REQUIRE((at)->v, NULL);                                                                \
    } while (0)

/* A small deterministic generator, uniform on [-1, 1). */
typedef struct dal__random {
    uint64_t state;
} dal__random;
double dal__uniform(dal__random *random);

/* D, A, W^-1 A^T in one block out[m + m*n + n*m], and G = A W^-1 A^T [m*m] from it. */
dal_status dal__constraint_at(dal_evaluator *evaluator, double t, const double *q, const double *v,
                              double *out);
void dal__gram(const dal_system *system, const double *block, double *gram);

/* Dirac's algebra with any 4n+1 functions phi(user, z, a) on 6n+2 for its constraints, the first
 * 2n+1 the primary ones; user is the dal__dirac_space.  dal_check_dirac takes those of the
 * theory, a test a wrong one. */
typedef struct dal__dirac_space {
    dal_evaluator *evaluator;
    int n;
    double t;
    double (*phi)(void *user, const double *z, int a);
    int a;         /* the constraint under differentiation */
    double *field; /* [n] */
} dal__dirac_space;
double dal__dirac_constraint(void *user, const double *z, int a);
dal_status dal__dirac(dal_evaluator *evaluator, const dal_point *at, double e,
                      double (*phi)(void *user, const double *z, int a), dal_dirac *out);

#endif
