/* test_dense.c - dop853 between the ends of a substep: the conditions of order 7 at each s, and of
 * order 8 at the end, for every rooted tree; errors against a closed form.
 *
 * Trees are level sequences in the order of Beyer and Hedetniemi (1980,
 * DOI 10.1137/0209055): 1, 1, 2, 4, 9, 20, 48, 115 of orders 1 to 8. */
#include <CUnit/CUnit.h>
#include <dalembert_kernel.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* The method's own file, tables and all, without its descriptor. */
#undef DAL_INTEGRATOR
#define DAL_INTEGRATOR(identifier, function, ...) enum { unused_##identifier }
#include "../integrators/dop853.c"

typedef long double real;

enum { ALL = EXTENSION_LAST_853, MAX_ORDER = 8 };

/* Weights up to 530 with 30 digits enter sums of terms below 1. */
static const real rounding = 1e4L * LDBL_EPSILON;

static real a[ALL][ALL];

static void fill_tableau(void)
{
    memset(a, 0, sizeof a);
    for (int i = 1, at = 0; i < STAGES_853; i++)
        for (int j = 0; j < i; j++, at++) a[i][j] = (real)a853[at] + (real)a853_low[at];
    for (int j = 0; j < STAGES_853; j++) a[STAGES_853][j] = (real)b853[j] + (real)b853_low[j];
#define SET_STAGE(i, j, weight) a[(i)-1][(j)-1] = weight##L;
    EXTENSION_STAGES_853(SET_STAGE)
#undef SET_STAGE
}

/* b_j(s) with y(t + s h) = y0 + h sum b_j(s) k_j. */
static void fill_weights(real s, real *b)
{
    real d[MAX_ORDER][ALL] = {{0}};
#define SET_WEIGHT(i, j, weight) d[i][(j)-1] = weight##L;
    EXTENSION_WEIGHTS_853(SET_WEIGHT)
#undef SET_WEIGHT
    for (int j = 0; j < ALL; j++) {
        const real z = 1.0L - s, r2 = a[STAGES_853][j], r3 = (j == 0) - r2,
                   r4 = r2 - (j == STAGES_853) - r3;
        const real inner = d[5][j] + z * (d[6][j] + s * d[7][j]);
        b[j] = s * (r2 + z * (r3 + s * (r4 + z * (d[4][j] + s * inner))));
    }
}

/* ---- rooted trees ---- */

/* The next level sequence of order n; false after the last. */
static bool next_tree(int *level, int n)
{
    int p = n - 1;
    while (p > 0 && level[p] <= 2) p--;
    if (p <= 0) return false;
    int q = p - 1;
    while (level[q] != level[p] - 1) q--;
    for (int i = p; i < n; i++) level[i] = level[i - (p - q)];
    return true;
}

/* sum_j b_j Phi_j of a tree, and its density gamma. */
static real elementary_weight(const int *level, int n, const real *b, real *gamma)
{
    real phi[MAX_ORDER][ALL], sum = 0.0L;
    int size[MAX_ORDER];
    *gamma = 1.0L;
    for (int i = 0; i < n; i++) {
        size[i] = 1;
        for (int j = 0; j < ALL; j++) phi[i][j] = 1.0L;
    }
    for (int i = n - 1; i >= 0; i--) {
        int parent = i - 1;
        *gamma *= (real)size[i];
        if (i == 0) break;
        while (level[parent] != level[i] - 1) parent--;
        size[parent] += size[i];
        for (int j = 0; j < ALL; j++) {
            real inner = 0.0L;
            for (int l = 0; l < j; l++) inner += a[j][l] * phi[i][l];
            phi[parent][j] *= inner;
        }
    }
    for (int j = 0; j < ALL; j++) sum += b[j] * phi[0][j];
    return sum;
}

/* The largest defect of the conditions of order n at s. */
static real max_defect(int n, real s, int *trees)
{
    int level[MAX_ORDER];
    real b[ALL], max = 0.0L, gamma;
    fill_weights(s, b);
    for (int i = 0; i < n; i++) level[i] = i + 1;
    *trees = 0;
    do {
        const real sum = elementary_weight(level, n, b, &gamma);
        max = fmaxl(max, fabsl(sum - powl(s, n) / gamma));
        ++*trees;
    } while (next_tree(level, n));
    return max;
}

static void test_order(void)
{
    static const int counts[] = {0, 1, 1, 2, 4, 9, 20, 48, 115};
    static const real places[] = {0.0L, 0.1L, 0.3L, 0.5L, 0.77L, 1.0L};
    fill_tableau();
    for (int n = 1; n <= MAX_ORDER; n++)
        for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
            int trees;
            const real defect = max_defect(n, places[i], &trees);
            const bool is_end = places[i] == 0.0L || places[i] == 1.0L;
            CU_ASSERT(trees == counts[n]);
            CU_ASSERT((defect <= rounding) == (n < MAX_ORDER || is_end));
        }
}

/* ---- a motion ---- */

/* y' = y cos t has y = exp(sin t). */
static double rate(double t, double y) { return y * cos(t); }

/* The largest error between the ends of a step of size h. */
static double max_error(double t, double h)
{
    const double y0 = exp(sin(t));
    double k[ALL], terms[EXTENSION_TERMS_853], y, mean = 0.0, max = 0.0;
    for (int i = 0; i < STAGES_853; i++) {
        y = 0.0;
        for (int j = 0; j < i; j++) y += a853[i * (i - 1) / 2 + j] * k[j];
        k[i] = rate(t + c853[i] * h, y0 + h * y);
    }
    for (int j = 0; j < STAGES_853; j++) mean += b853[j] * k[j];
    k[STAGES_853] = rate(t + h, y0 + h * mean);
    for (int i = END_853 + 1; i <= ALL; i++) {
        extension_stage(1, i, k, &y);
        k[i - 1] = rate(t + c853_extension[i - END_853] * h, y0 + h * y);
    }
    extension_terms(1, &mean, k, terms);
    expand_extension(1, terms);
    const dal_dense dense = {.rate = terms, .terms = EXTENSION_TERMS_853};
    for (int i = 1; i <= 50; i++) {
        const double u = i / 50.0;
        dal_dense_rate(&dense, 1, u, &y);
        if (i == 50) CU_ASSERT_DOUBLE_EQUAL(y, mean, 1e-14);
        max = fmax(max, i < 50 ? fabs(y0 + u * h * y - exp(sin(t + u * h))) : 0.0);
    }
    return max;
}

/* The error of one step is C h^8 (1 + O(h)): where h is halved it falls by 2^8, to a half in the
 * exponent. */
static void test_motion(void)
{
    const double exponent = log2(max_error(0.3, 0.5) / max_error(0.3, 0.25));
    CU_ASSERT(fabs(exponent - 8.0) < 0.5);
}

void suite_dense(void)
{
    CU_pSuite suite = CU_add_suite("dense", NULL, NULL);
    CU_add_test(suite, "order 7 at each s, for all rooted trees", test_order);
    CU_add_test(suite, "errors between the ends of a step", test_motion);
}
