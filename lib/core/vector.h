/* vector.h - vectors of doubles. */
#ifndef DAL_VECTOR_H
#define DAL_VECTOR_H

/* a.b in four partial sums: one order of summation, with vector registers or without. */
static inline double dal__dot_product(int n, const double *a, const double *b)
{
    double sum[4] = {0};
    int i = 0;
    for (; i + 4 <= n; i += 4)
        for (int k = 0; k < 4; k++) sum[k] += a[i + k] * b[i + k];
    for (; i < n; i++) sum[0] += a[i] * b[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

#endif
