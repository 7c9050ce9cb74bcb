/* composition.h - the sizes of the substeps of a symmetric composition.
 *
 *     h = c_1 h + c_2 h + ... + c_k h,     c_(k+1-i) = c_i
 *
 * Rounded sizes c_i h would not add up to h.  Here each is a multiple of the last place of h, and
 * the middle substep (or the two in the middle) takes the rest, so that the sum is h. */
#ifndef DAL_KERNEL_COMPOSITION_H
#define DAL_KERNEL_COMPOSITION_H

#include "num.h"

enum { DAL_MAX_SUBSTEPS = 35 };

/* A symmetric composition of steps of sizes c_i h. */
typedef struct dal_composition {
    int substeps;    /* at most DAL_MAX_SUBSTEPS */
    const double *c; /* [(substeps - 1)/2] |c_i| < 2, up to the middle */
} dal_composition;

/* size[substeps] for a step of size h. */
DAL_INLINE void dal_substeps(const dal_composition *k, double h, double *size)
{
    const int before = (k->substeps - 1) / 2, last = k->substeps - 1;
    const double coarse = 4.0 * h; /* rounds to a multiple of the last place of 4h */
    double sum = 0.0;
    for (int i = 0; i < before; i++) {
        size[i] = size[last - i] = (k->c[i] * h + coarse) - coarse;
        sum += 2.0 * size[i];
    }
    const double rest = h - sum;
    size[before] = size[last - before] = k->substeps % 2 ? rest : 0.5 * rest;
}

#endif
