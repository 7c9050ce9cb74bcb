/* test_phase_lobatto.c - the Lobatto tableaus from their printed digits, by the conditions that
 * determine them, with long doubles:
 *
 *     c_i         0, 1, and P_(s-1)'(2c - 1) = 0, in rising order
 *     b_j         sum_j b_j c_j^(k-1) = 1/k, k = 1..s
 *     a (IIIA)    sum_j a_ij c_j^(k-1) = c_i^k / k, k = 1..s
 *     p (IIIB)    sum_i b_i c_i^(k-1) p_ij = b_j (1 - c_j^k) / k, k = 1..s
 *     e           sum_j e_ij c_j^k = (1 + c_i)^k, k = 0..s-1
 *
 * each a regular system, and b_i p_ij + b_j a_ji = b_i b_j, which makes the pair symplectic. */
#include <CUnit/CUnit.h>
#include <dalembert_kernel.h>
#include <float.h>
#include <stdio.h>

/* The methods' own file, tables and all, without its descriptors. */
#undef DAL_INTEGRATOR
#define DAL_INTEGRATOR(identifier, function, ...) enum { unused_##identifier }
#include "../integrators/lobatto.c"

typedef long double real;

enum { MAX = 5 };
static const dal_tableau *const tableaus[] = {&tableau3, &tableau4, &tableau5};
enum { TABLEAUS = sizeof tableaus / sizeof *tableaus };

/* A tableau with heads and tails put together; nodes to all places. */
typedef struct whole {
    int s;
    real c[MAX], b[MAX], a[MAX][MAX], p[MAX][MAX];
} whole;

/* (1 - x^2) P_n'(x) / n = P_(n-1) - x P_n and its derivative -(n + 1) P_n. */
static real newton(int n, real x)
{
    real before = 1.0L, p = x;
    for (int k = 2; k <= n; k++) {
        const real next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
    }
    return x + (before - x * p) / ((n + 1) * p);
}

static whole put_together(const dal_tableau *t)
{
    whole w = {.s = t->stages};
    for (int i = 0; i < w.s; i++) {
        real x = 2.0L * t->c[i] - 1.0L;
        for (int k = 0; k < 4 && i > 0 && i < w.s - 1; k++) x = newton(w.s - 1, x);
        w.c[i] = 0.5L + 0.5L * x;
        w.b[i] = (real)t->b[i] + t->b_tail[i];
        for (int j = 0; j < w.s; j++) {
            w.a[i][j] = (real)t->a[i * w.s + j] + t->a_tail[i * w.s + j];
            w.p[i][j] = (real)t->partner[i * w.s + j] + t->partner_tail[i * w.s + j];
        }
    }
    return w;
}

/* Ten units of long double as it is: under valgrind it has the precision of double. */
static real tolerance(void)
{
    volatile real one = 1.0L, sum = one + LDBL_EPSILON;
    return 10.0L * (sum == one ? DBL_EPSILON : LDBL_EPSILON);
}

static void close_to(const char *what, real seen, real expected)
{
    const real error = fabsl(seen - expected);
    if (!(error <= tolerance())) printf("\n  %s: off by %.2Le\n", what, error);
    CU_ASSERT(error <= tolerance());
}

static void check_nodes(const dal_tableau *t, const whole *w)
{
    CU_ASSERT_EQUAL(t->c[0], 0.0);
    CU_ASSERT_EQUAL(t->c[w->s - 1], 1.0);
    for (int i = 0; i < w->s; i++) {
        CU_ASSERT(fabsl(t->c[i] - w->c[i]) <= 0.5L * DBL_EPSILON);
        CU_ASSERT(i == 0 || t->c[i] > t->c[i - 1]);
    }
}

/* The k-th of each family of conditions. */
static void check_moments(const whole *w, int k)
{
    real weights = 0.0L;
    for (int i = 0; i < w->s; i++) {
        real row = 0.0L, column = 0.0L;
        weights += w->b[i] * powl(w->c[i], k - 1);
        for (int j = 0; j < w->s; j++) {
            row += w->a[i][j] * powl(w->c[j], k - 1);
            column += w->b[j] * powl(w->c[j], k - 1) * w->p[j][i];
        }
        close_to("a", row, powl(w->c[i], k) / k);
        close_to("p", column, w->b[i] * (1.0L - powl(w->c[i], k)) / k);
    }
    close_to("b", weights, 1.0L / k);
}

static void test_tables(void)
{
    for (int i = 0; i < TABLEAUS; i++) {
        const whole w = put_together(tableaus[i]);
        CU_ASSERT_EQUAL(w.s, i + 3);
        check_nodes(tableaus[i], &w);
        for (int k = 1; k <= w.s; k++) check_moments(&w, k);
    }
}

static void test_symplectic_condition(void)
{
    for (int t = 0; t < TABLEAUS; t++) {
        const whole w = put_together(tableaus[t]);
        for (int i = 0; i < w.s; i++)
            for (int j = 0; j < w.s; j++)
                close_to("b p + b a", w.b[i] * w.p[i][j] + w.b[j] * w.a[j][i], w.b[i] * w.b[j]);
    }
}

/* A first guess needs no more digits than a double has. */
static void check_guess(const whole *w, const double *row, real c, int k)
{
    real sum = 0.0L, size = 0.0L;
    for (int j = 0; j < w->s; j++) {
        const real term = row[j] * powl(w->c[j], k);
        sum += term;
        size += fabsl(term);
    }
    CU_ASSERT(fabsl(sum - powl(1.0L + c, k)) <= DBL_EPSILON * size);
}

static void test_extrapolation(void)
{
    for (int t = 0; t < TABLEAUS; t++) {
        const whole w = put_together(tableaus[t]);
        for (int i = 0; i < w.s * w.s; i++)
            check_guess(&w, tableaus[t]->extrapolation + i / w.s * w.s, w.c[i / w.s], i % w.s);
    }
}

/* Heads are multiples of 1/1024, tails below. */
static void check_split(const double *head, const double *tail, int count)
{
    for (int i = 0; i < count; i++) {
        CU_ASSERT_EQUAL(head[i] * 1024.0, rint(head[i] * 1024.0));
        CU_ASSERT(fabs(tail[i]) <= 0.5 / 1024.0);
    }
}

static void test_split(void)
{
    for (int t = 0; t < TABLEAUS; t++) {
        const dal_tableau *k = tableaus[t];
        check_split(k->b, k->b_tail, k->stages);
        check_split(k->a, k->a_tail, k->stages * k->stages);
        check_split(k->partner, k->partner_tail, k->stages * k->stages);
    }
}

void suite_phase_lobatto(void)
{
    CU_pSuite suite = CU_add_suite("Lobatto", NULL, NULL);
    CU_add_test(suite, "nodes, weights, coefficients", test_tables);
    CU_add_test(suite, "symplectic condition", test_symplectic_condition);
    CU_add_test(suite, "extrapolation", test_extrapolation);
    CU_add_test(suite, "heads and tails", test_split);
}
