/* series.h - sums over Taylor coefficients.
 *
 * The k-th coefficient, k >= 1, of a series follows from lower coefficients of it and of its
 * operands, by the recurrences of expr/recurrences.h.  Most of their work is inner sums of two
 * series, over what is known before order k begins:
 *
 *     sum_(j=1..k-1) a_j b_(k-j)
 *
 * One order of summation serves single runs, lanes and compiled steps.  The terms 2..k-2, the
 * interior, have four partial sums, of the terms 2 + m, 6 + m, .., m = 0..3, since one sum would
 * wait for each product.  Those with a coefficient of order k-1 come last: a processor begins with
 * the interior before it knows them.  The square of a series has each pair of equal terms once. */
#ifndef DAL_KERNEL_SERIES_H
#define DAL_KERNEL_SERIES_H

#include "num.h"

/* 1/k, divided once for all lanes. */
#ifdef DAL_NUM_QUAD
DAL_INLINE num dal_inverse(int k) { return 1.0 / dal_num(k); }
#else
DAL_INLINE num dal_inverse(int k) { return dal_num(1.0 / k); }
#endif

/* Returns the sum of some terms of the numbers x at a, a + step, .. and y at b, b - step, ..;
 * changes a, b and terms. */
#define DAL__SUM_TERMS(type, fuse, a, b, step, terms)                                              \
    type s0 = {0}, s1 = {0}, s2 = {0}, s3 = {0};                                                   \
    for (; (terms) > 3; (terms) -= 4, (a) += 4 * (step), (b) -= 4 * (step)) {                      \
        s0 = fuse(*(const type *)(a), *(const type *)(b), s0);                                     \
        s1 = fuse(*(const type *)((a) + (step)), *(const type *)((b) - (step)), s1);               \
        s2 = fuse(*(const type *)((a) + 2 * (step)), *(const type *)((b)-2 * (step)), s2);         \
        s3 = fuse(*(const type *)((a) + 3 * (step)), *(const type *)((b)-3 * (step)), s3);         \
    }                                                                                              \
    if ((terms) > 0) s0 = fuse(*(const type *)(a), *(const type *)(b), s0);                        \
    if ((terms) > 1) s1 = fuse(*(const type *)((a) + (step)), *(const type *)((b) - (step)), s1);  \
    if ((terms) > 2)                                                                               \
        s2 = fuse(*(const type *)((a) + 2 * (step)), *(const type *)((b)-2 * (step)), s2);         \
    return (s0 + s2) + (s1 + s3)

DAL_INLINE num dal__interior(const num *a, const num *b, int terms)
{
    DAL__SUM_TERMS(num, dal_fma, a, b, 1, terms);
}

/* The inner sum of a and b; the inner sum of a and a. */
DAL_INLINE num dal_sum_products(const num *a, const num *b, int k)
{
    if (k < 2) return dal_num(0.0);
    if (k == 2) return dal_fma(a[1], b[1], dal_num(0.0));
    const num interior = dal__interior(a + 2, b + k - 2, k - 3);
    return dal_fma(a[k - 1], b[1], dal_fma(a[1], b[k - 1], interior));
}
DAL_INLINE num dal_sum_squares(const num *a, int k)
{
    if (k < 2) return dal_num(0.0);
    if (k == 2) return dal_fma(a[1], a[1], dal_num(0.0));
    const num half = dal__interior(a + 2, a + k - 2, (k - 1) / 2 - 1), both = half + half;
    const num interior = k % 2 ? both : dal_fma(a[k / 2], a[k / 2], both);
    return dal_fma(a[1] + a[1], a[k - 1], interior);
}

/* As many numbers of a single run as a register holds; one number of several lanes. */
#if DAL_SCALAR
#ifndef DAL_NUM_QUAD
#if defined __AVX512F__
#define DAL__TERMS               8
#define DAL__FUSE_TERMS(a, b, c) __builtin_ia32_vfmaddpd512_mask(a, b, c, (unsigned char)-1, 4)
#elif defined __FMA__
#define DAL__TERMS               4
#define DAL__FUSE_TERMS(a, b, c) __builtin_ia32_vfmaddpd256(a, b, c)
#endif
#endif
#endif
#ifdef DAL__TERMS
typedef double dal__terms __attribute__((vector_size(8 * DAL__TERMS), aligned(8), may_alias));
#else
#define DAL__TERMS               1
#define DAL__FUSE_TERMS(a, b, c) dal_fma(a, b, c)
typedef num dal__terms;
#endif

/* A compiled single run forms the inner sums of all products of an order together.  Their operands
 * are stored side by side, coefficient j of the operand of product i at l[j*count + i]. */
DAL_INLINE dal__terms dal__interiors(const num *l, const num *r, int count, int terms)
{
    DAL__SUM_TERMS(dal__terms, DAL__FUSE_TERMS, l, r, count, terms);
}

/* sum[count] = the interiors of products; for k = 2, which has none, a_1 b_1, the whole sum. */
DAL_INLINE void dal_product_interiors(const num *l, const num *r, int count, int k,
                                      num *DAL_RESTRICT sum)
{
    const int first = k == 2 ? 1 : 2, last = k - first;
    for (int i = 0; i < count; i += DAL__TERMS)
        *(dal__terms *)(sum + i) =
            dal__interiors(l + first * count + i, r + last * count + i, count, last - first + 1);
}
/* The same of squares. */
DAL_INLINE void dal_square_interiors(const num *l, int count, int k, num *DAL_RESTRICT sum)
{
    for (int i = 0; i < count; i += DAL__TERMS) {
        const num *first = l + 2 * count + i, *last = l + (k - 2) * count + i;
        const dal__terms half = dal__interiors(first, last, count, (k - 1) / 2 - 1);
        const dal__terms middle = *(const dal__terms *)(l + k / 2 * count + i);
        dal__terms both = half + half;
        if (k % 2 == 0) both = DAL__FUSE_TERMS(middle, middle, both);
        *(dal__terms *)(sum + i) = both;
    }
}

#endif
