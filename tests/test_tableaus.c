/* test_tableaus.c - the Gauss tableaus from their printed digits, against nodes and integrals
 * worked out anew in long double: roots of P_s(2c - 1) by Newton, products of Lagrange factors.
 *
 * A coefficient in double alone would be off by up to 5e-17; head and tail together must be right
 * to a few units of long double, 1e-19. */
#include <CUnit/CUnit.h>
#include <dalembert_kernel.h>
#include <float.h>
#include <stdio.h>

/* The methods' own file, tables and all, without its descriptors. */
#undef DAL_INTEGRATOR
#define DAL_INTEGRATOR(identifier, function, ...) enum { unused_##identifier }
#include "../integrators/gauss.c"

typedef long double real;

enum { MOST = 6 };

static const dal_tableau *const tableaus[] = {&tableau2, &tableau3, &tableau4, &tableau5,
                                              &tableau6};

/* P_s and its derivative at x. */
static real legendre(int s, real x, real *slope)
{
    real before = 1.0L, now = x;
    for (int k = 2; k <= s; k++) {
        const real next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = next;
    }
    *slope = s * (x * now - before) / (x * x - 1.0L);
    return now;
}

/* Node i from 0, in rising order. */
static real node(int s, int i)
{
    real x = -cosl(3.14159265358979323846264L * (i + 0.75L) / (s + 0.5L)), slope;
    for (int k = 0; k < 50; k++) {
        const real value = legendre(s, x, &slope);
        x -= value / slope;
    }
    return 0.5L + 0.5L * x;
}

/* The polynomial l_j on the nodes c, lowest power first: p[s]. */
static void lagrange(int s, const real *c, int j, real *p)
{
    int degree = 0;
    p[0] = 1.0L;
    for (int k = 0; k < s; k++) {
        if (k == j) continue;
        const real scale = 1.0L / (c[j] - c[k]);
        p[degree + 1] = 0.0L;
        for (int i = ++degree; i >= 0; i--)
            p[i] = ((i > 0 ? p[i - 1] : 0.0L) - c[k] * (i < degree ? p[i] : 0.0L)) * scale;
    }
}

static real at(int s, const real *p, real x)
{
    real sum = 0.0L;
    for (int i = s - 1; i >= 0; i--) sum = sum * x + p[i];
    return sum;
}

/* The integral of p from 0 to x. */
static real integral(int s, const real *p, real x)
{
    real sum = 0.0L;
    for (int i = s - 1; i >= 0; i--) sum = sum * x + p[i] / (i + 1);
    return sum * x;
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
static void check_column(const dal_tableau *t, const real *c, int j)
{
    const int s = t->stages;
    /* The integrals add terms up to the size of the polynomial's coefficients. */
    real p[MOST + 1], size = 1.0L;
    lagrange(s, c, j, p);
    for (int i = 0; i < s; i++) size = fmaxl(size, fabsl(p[i]));
    const real tolerance = 16.0L * LDBL_EPSILON * size;
    close_to(s, "b", (real)t->b[j] + t->b_tail[j], integral(s, p, 1.0L), tolerance);
    check_head(t->b[j]);
    for (int i = 0; i < s; i++) {
        const int k = i * s + j;
        close_to(s, "a", (real)t->a[k] + t->a_tail[k], integral(s, p, c[i]), tolerance);
        check_head(t->a[k]);
        CU_ASSERT(fabs(t->a_tail[k]) <= 0.5 / 1024.0);
        const real basis = at(s, p, 1.0L + c[i]);
        close_to(s, "extrapolation", t->extrapolation[k], basis,
                 DBL_EPSILON * fabsl(basis) + 1e3L * tolerance);
    }
}

static void test_gauss(void)
{
    for (int k = 0; k < 5; k++) {
        const dal_tableau *t = tableaus[k];
        real c[MOST];
        CU_ASSERT_EQUAL(t->stages, k + 2);
        for (int i = 0; i < t->stages; i++) {
            c[i] = node(t->stages, i);
            close_to(t->stages, "c", t->c[i], c[i], 0.5L * DBL_EPSILON);
        }
        for (int j = 0; j < t->stages; j++) check_column(t, c, j);
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
            close_to(s, "b a + b a - b b", br * rc + bc * cr, br * bc, 8.0L * LDBL_EPSILON);
        }
    }
}

void suite_tableaus(void)
{
    CU_pSuite suite = CU_add_suite("tableaus", NULL, NULL);
    CU_add_test(suite, "Gauss: nodes, weights, coefficients", test_gauss);
    CU_add_test(suite, "Gauss: symplectic condition", test_symplectic_condition);
}
