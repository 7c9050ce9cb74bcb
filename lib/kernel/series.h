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

/* A compiled single run forms the interiors of all products of an order together.  Their operands
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

#ifndef DAL_MINIMAL /* has no compiled steps */
/* Keeps compilers from reading it from memory once more, which is what limits sums. */
#if DAL_SCALAR
#define DAL__WIDTH DAL__TERMS
#else
#define DAL__WIDTH DAL_LANES
#endif
#if defined __AVX512F__ && DAL__WIDTH == 8
#define DAL__IN_REGISTER(x) __asm__("" : "+v"(x))
#elif defined __FMA__ && DAL__WIDTH == 4
#define DAL__IN_REGISTER(x) __asm__("" : "+x"(x))
#else
#define DAL__IN_REGISTER(x) (void)0
#endif

/* Steps with many sums form the interiors of two orders at once, k and k + 1, which need the same
 * coefficients: the sums of a_j b_(k-j) and of a_j b_(k+1-j) read each factor once.  With a few the
 * processor waits for the recurrences, and needs work in each order.
 *
 * a, b: numbers a_2 and b_(k-2), the coefficients `step` apart; terms: of order k; further:
 * whether order k + 1 has one more. */
static inline DAL_UNUSED __attribute__((always_inline)) void
dal__two_interiors(const num *a, const num *b, int step, int terms, bool further, dal__terms *now,
                   dal__terms *next)
{
    dal__terms s0 = {0}, s1 = {0}, s2 = {0}, s3 = {0}, t0 = {0}, t1 = {0}, t2 = {0}, t3 = {0};
    dal__terms x, y, before = *(const dal__terms *)(b + step);
#define DAL__READ(i)                                                                               \
    x = *(const dal__terms *)(a + (i)*step);                                                       \
    DAL__IN_REGISTER(x)
#define DAL__ADD_LAST(i) t##i = DAL__FUSE_TERMS(x, before, t##i)
#define DAL__ADD_TWO(i)                                                                            \
    DAL__READ(i);                                                                                  \
    DAL__ADD_LAST(i);                                                                              \
    y = *(const dal__terms *)(b - (i)*step);                                                       \
    DAL__IN_REGISTER(y);                                                                           \
    s##i = DAL__FUSE_TERMS(x, y, s##i);                                                            \
    before = y
    for (; terms > 3; terms -= 4, a += 4 * step, b -= 4 * step) {
        DAL__ADD_TWO(0);
        DAL__ADD_TWO(1);
        DAL__ADD_TWO(2);
        DAL__ADD_TWO(3);
    }
    if (terms > 0) {
        DAL__ADD_TWO(0);
    }
    if (terms > 1) {
        DAL__ADD_TWO(1);
    }
    if (terms > 2) {
        DAL__ADD_TWO(2);
    }
    if (further) {
        DAL__READ(terms);
        if (terms == 0) DAL__ADD_LAST(0);
        if (terms == 1) DAL__ADD_LAST(1);
        if (terms == 2) DAL__ADD_LAST(2);
        if (terms == 3) DAL__ADD_LAST(3);
    }
#undef DAL__ADD_TWO
#undef DAL__ADD_LAST
#undef DAL__READ
    *now = (s0 + s2) + (s1 + s3);
    *next = (t0 + t2) + (t1 + t3);
}

/* The interiors of orders k and k + 1, k >= 3, of the product of a and b. */
DAL_INLINE void dal__two_products(const num *a, const num *b, int step, int k, num *now, num *next)
{
    dal__two_interiors(a + 2 * step, b + (k - 2) * step, step, k - 3, true, (dal__terms *)now,
                       (dal__terms *)next);
}

/* The same of the square of a; only one of the orders has a square in the middle. */
DAL_INLINE void dal__two_squares(const num *a, int step, int k, num *now, num *next)
{
    const dal__terms middle = *(const dal__terms *)(a + (k + 1) / 2 * step);
    dal__terms half, half_next;
    dal__two_interiors(a + 2 * step, a + (k - 2) * step, step, (k - 1) / 2 - 1, k % 2 == 0, &half,
                       &half_next);
    half += half;
    half_next += half_next;
    if (k % 2)
        half_next = DAL__FUSE_TERMS(middle, middle, half_next);
    else
        half = DAL__FUSE_TERMS(middle, middle, half);
    *(dal__terms *)now = half;
    *(dal__terms *)next = half_next;
}

/* The interior of order k <= 3, which has no terms: a_1 b_1, the whole sum, for k = 2. */
DAL_INLINE num dal__no_interior(const num *a, const num *b, int k)
{
    return k == 2 ? dal_fma(a[1], b[1], dal_num(0.0)) : dal_num(0.0);
}

/* Whether order k begins or ends a pair; the last pair is order - 2 and order - 1.  The interiors
 * of order 3 are 0, as in order 1. */
DAL_INLINE bool dal__begins_pair(int k, int order) { return k > 2 && (order - k) % 2 == 0; }
DAL_INLINE bool dal__ends_pair(int k, int order) { return k > 2 && (order - k) % 2 != 0; }

/* The interiors of order k of many products and squares, in kept[2][products + squares] from number
 * k % 2 * (products + squares) on; of order k + 1, too, where k begins a pair. */
DAL_INLINE void dal_pair_packs(const num *l, const num *r, int products, const num *q, int squares,
                               int k, int order, num *DAL_RESTRICT kept)
{
    const int count = products + squares;
    num *const now = kept + k % 2 * count, *const next = kept + (k + 1) % 2 * count;
    if (dal__ends_pair(k, order)) return;
    if (!dal__begins_pair(k, order)) {
        dal_product_interiors(l, r, products, k, now);
        dal_square_interiors(q, squares, k, now + products);
        return;
    }
    for (int i = 0; i < products; i += DAL__TERMS)
        dal__two_products(l + i, r + i, products, k, now + i, next + i);
    for (int i = 0; i < squares; i += DAL__TERMS)
        dal__two_squares(q + i, squares, k, now + products + i, next + products + i);
}

/* The same of lanes, whose operands are in c[][order + 1]: slot[2*products + squares]. */
DAL_INLINE void dal_pair_lanes(const num *c, const int *slot, int products, int squares, int k,
                               int order, num *DAL_RESTRICT kept)
{
    const int count = products + squares, stride = order + 1;
    const int *const square = slot + 2 * products;
    num *const now = kept + k % 2 * count, *const next = kept + (k + 1) % 2 * count;
    if (dal__ends_pair(k, order)) return;
    if (!dal__begins_pair(k, order)) {
        for (int i = 0; i < products; i++)
            now[i] = dal__no_interior(c + slot[2 * i] * stride, c + slot[2 * i + 1] * stride, k);
        for (int i = 0; i < squares; i++)
            now[products + i] = dal__no_interior(c + square[i] * stride, c + square[i] * stride, k);
        return;
    }
    for (int i = 0; i < products; i++)
        dal__two_products(c + slot[2 * i] * stride, c + slot[2 * i + 1] * stride, 1, k, now + i,
                          next + i);
    for (int i = 0; i < squares; i++)
        dal__two_squares(c + square[i] * stride, 1, k, now + products + i, next + products + i);
}
#endif

#endif
