/* test_tableaus.c - the Gauss tableaus from their printed digits, against other formulas for them,
 * computed again with long doubles: xi_i = 2 c_i - 1 the roots of P_s by Newton,
 *
 *     b_j = 1 / ((1 - xi_j^2) P_s'(xi_j)^2)
 *     l_j(x) = b_j sum_(k<s) (2k + 1) P_k(xi_j) P_k(2x - 1)
 *     a_ij = b_j sum_(k<s) (2k + 1) P_k(xi_j) I_k(c_i)
 *     I_k(c) = integral of P_k(2x - 1) from 0 to c
 *
 * with I_0 = c and (4k + 2) I_k = P_(k+1) - P_(k-1): sums without cancellation.  A coefficient in
 * double alone would be off by up to 5e-17; head and tail together must be right to 1e-18. */
#include <CUnit/CUnit.h>
#include <dalembert_kernel.h>
#include <float.h>
#include <stdio.h>

/* The methods' own file, tables and all, without its descriptors. */
#undef DAL_INTEGRATOR
#define DAL_INTEGRATOR(identifier, function, ...) enum { unused_##identifier }
#include "../integrators/gauss.c"

typedef long double real;

enum { MAX = 6 };

static const dal_tableau *const tableaus[] = {&tableau2, &tableau3, &tableau4, &tableau5,
                                              &tableau6};

/* P_0..P_count at x. */
static void legendre(int count, real x, real *p)
{
    p[0] = 1.0L;
    p[1] = x;
    for (int k = 2; k <= count; k++) p[k] = ((2 * k - 1) * x * p[k - 1] - (k - 1) * p[k - 2]) / k;
}

/* P_s'(x). */
static real slope(int s, real x)
{
    real p[MAX + 2];
    legendre(s, x, p);
    return s * (x * p[s] - p[s - 1]) / (x * x - 1.0L);
}

/* Root i of P_s from 0, in rising order. */
static real root(int s, int i)
{
    real x = -cosl(3.14159265358979323846264L * (i + 0.75L) / (s + 0.5L)), p[MAX + 2];
    for (int k = 0; k < 50; k++) {
        legendre(s, x, p);
        x -= p[s] / slope(s, x);
    }
    return x;
}

/* sum_(k<s) (2k + 1) P_k(xi) f_k */
static real expansion(int s, real xi, const real *f)
{
    real p[MAX + 2], sum = 0.0L;
    legendre(s, xi, p);
    for (int k = 0; k < s; k++) sum += (2 * k + 1) * p[k] * f[k];
    return sum;
}

/* I_0..I_(s-1) at xi. */
static void integrals(int s, real xi, real *f)
{
    real p[MAX + 2];
    legendre(s, xi, p);
    f[0] = 0.5L + 0.5L * xi;
    for (int k = 1; k < s; k++) f[k] = (p[k + 1] - p[k - 1]) / (4 * k + 2);
}

/* Ten units of long double as it is: 1e-18, but under valgrind it has the precision of double. */
static real tolerance(void)
{
    volatile real one = 1.0L, sum = one + LDBL_EPSILON;
    return 10.0L * (sum == one ? DBL_EPSILON : LDBL_EPSILON);
}

static void close_to(int s, const char *what, real seen, real expected, real tolerance)
{
    const real error = fabsl(seen - expected);
    if (!(error <= tolerance)) printf("\n  s = %d, %s: off by %.2Le\n", s, what, error);
    CU_ASSERT(error <= tolerance);
}

/* heads are multiples of 1/1024 */
static void check_head(double head) { CU_ASSERT_EQUAL(head * 1024.0, rint(head * 1024.0)); }

/* Column j of every table. */
static void check_column(const dal_tableau *t, const real *xi, int j)
{
    const int s = t->stages;
    const real d = slope(s, xi[j]), b = 1.0L / ((1.0L - xi[j] * xi[j]) * d * d);
    real f[MAX + 2];
    close_to(s, "b", (real)t->b[j] + t->b_tail[j], b, tolerance());
    check_head(t->b[j]);
    for (int i = 0; i < s; i++) {
        const int k = i * s + j;
        integrals(s, xi[i], f);
        close_to(s, "a", (real)t->a[k] + t->a_tail[k], b * expansion(s, xi[j], f), tolerance());
        check_head(t->a[k]);
        CU_ASSERT(fabs(t->a_tail[k]) <= 0.5 / 1024.0);
        /* Beyond the interval P_k grows to 1e4; a first guess needs no more digits than this. */
        legendre(s, xi[i] + 2.0L, f);
        const real basis = b * expansion(s, xi[j], f);
        close_to(s, "extrapolation", t->extrapolation[k], basis,
                 (DBL_EPSILON + 1e4L * tolerance()) * fabsl(basis));
    }
}

static void test_gauss(void)
{
    for (int k = 0; k < 5; k++) {
        const dal_tableau *t = tableaus[k];
        real xi[MAX];
        CU_ASSERT_EQUAL(t->stages, k + 2);
        for (int i = 0; i < t->stages; i++) {
            xi[i] = root(t->stages, i);
            close_to(t->stages, "c", t->c[i], 0.5L + 0.5L * xi[i],
                     0.5L * DBL_EPSILON + tolerance());
        }
        for (int j = 0; j < t->stages; j++) check_column(t, xi, j);
    }
}

/* b_i a_ij + b_j a_ji = b_i b_j: what makes the methods keep quadratic invariants. */
static void test_symplectic_condition(void)
{
    for (int k = 0; k < 5; k++) {
        const dal_tableau *t = tableaus[k];
        const int s = t->stages;
        for (int i = 0; i < s * s; i++) {
            const int r = i / s, c = i % s;
            const real br = (real)t->b[r] + t->b_tail[r], bc = (real)t->b[c] + t->b_tail[c];
            const real rc = (real)t->a[r * s + c] + t->a_tail[r * s + c];
            const real cr = (real)t->a[c * s + r] + t->a_tail[c * s + r];
            close_to(s, "b a + b a - b b", br * rc + bc * cr, br * bc, tolerance());
        }
    }
}

/* A w = lambda w for each eigenvalue of the upper half plane, l^T w = 1 and l^T w' = 0 for the
 * others (l_i = b_i w_(s+1-i)), so that they make up A. */
static void check_eigenvector(const dal_tableau *t, int e)
{
    const int s = t->stages;
    const double *value = t->eigensystem->value + 2 * e, *vector = t->eigensystem->vector;
    const double *re = vector + 2 * e * s, *im = re + s;
    for (int i = 0; i < s; i++) {
        real x = value[1] * (real)im[i] - value[0] * (real)re[i];
        real y = -value[0] * (real)im[i] - value[1] * (real)re[i];
        for (int j = 0; j < s; j++) {
            x += ((real)t->a[i * s + j] + t->a_tail[i * s + j]) * re[j];
            y += ((real)t->a[i * s + j] + t->a_tail[i * s + j]) * im[j];
        }
        close_to(s, "A w, real", x, 0.0L, 32.0L * DBL_EPSILON);
        close_to(s, "A w, imaginary", y, 0.0L, 32.0L * DBL_EPSILON);
    }
    CU_ASSERT(value[1] > 0.0 || (s % 2 == 1 && e == s / 2));
    for (int f = 0; f <= e; f++) {
        const double *other = vector + 2 * f * s, *other_im = other + s;
        real x = 0.0L, y = 0.0L;
        for (int i = 0; i < s; i++) {
            const real b = (real)t->b[i] + t->b_tail[i];
            x += b * ((real)re[i] * other[s - 1 - i] - (real)im[i] * other_im[s - 1 - i]);
            y += b * ((real)re[i] * other_im[s - 1 - i] + (real)im[i] * other[s - 1 - i]);
        }
        close_to(s, "l w, real", x, f == e, 1024.0L * DBL_EPSILON);
        close_to(s, "l w, imaginary", y, 0.0L, 1024.0L * DBL_EPSILON);
    }
}

static void test_eigensystems(void)
{
    for (int k = 0; k < 5; k++)
        for (int e = 0; e < (tableaus[k]->stages + 1) / 2; e++) check_eigenvector(tableaus[k], e);
}

void suite_tableaus(void)
{
    CU_pSuite suite = CU_add_suite("tableaus", NULL, NULL);
    CU_add_test(suite, "Gauss: nodes, weights, coefficients", test_gauss);
    CU_add_test(suite, "Gauss: symplectic condition", test_symplectic_condition);
    CU_add_test(suite, "Gauss: eigenvectors", test_eigensystems);
}
