/* two_point.h - linear boundary value problems in pieces. */
#ifndef DAL_STEER_TWO_POINT_H
#define DAL_STEER_TWO_POINT_H

#include <stdbool.h>

/* Unknowns w_0, .., w_pieces of size d, and s of size `extra`:
 *
 *     w_(k+1) - Phi_k w_k = r_k,      B (w_0, w_pieces, s) = c
 *
 * The inner unknowns are eliminated one after the other with partial pivoting between neighbours,
 * which is stable where some motions grow and others decay (Wright 1993, DOI 10.1137/0914013, of
 * such eliminations); the rest, rows of the ends, is solved by its singular values. */
typedef struct dal__two_point {
    int d, pieces, extra, rows;      /* rows: of B */
    double *border;                  /* [rows*(2d + extra)], row-major: B, set by the caller */
    double *right;                   /* [rows] c, set by the caller */
    int rank;                        /* of the bordered matrix */
    double condition;                /* max over min singular value of that rank */
    double *panel, *upper;           /* [pieces*2d*d], [pieces*d*2d] */
    int *pivot;                      /* [pieces*d] */
    double *last;                    /* [d*2d] */
    double *matrix, *value, *vector; /* of the ends, by columns */
    double *scratch;
} dal__two_point;

/* Allocates for at most these rows of B and extra unknowns.  [alloc]  false: out of memory. */
bool dal__two_point_open(dal__two_point *b, int d, int pieces, int extra, int rows);
void dal__two_point_close(dal__two_point *b);
/* Factors it for phi[pieces*d*d]; singular values below tolerance times the largest count as 0.
 * [alloc]  false: out of memory. */
bool dal__two_point_factor(dal__two_point *b, const double *phi, double tolerance);
/* Solves for r[pieces*d] and b->right: w[(pieces + 1)*d + extra], least squares of the rows of the
 * ends and, of these solutions, the one with the least w_0, w_pieces, s. */
void dal__two_point_solve(dal__two_point *b, const double *r, double *w);

#endif
