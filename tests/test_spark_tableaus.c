/* test_spark_tableaus.c - the coefficients of gauss-spark from their printed digits, against their
 * definitions at the head of gauss_spark.c, with long doubles: nodes by their roots, and the
 * Lagrange polynomials l_j of the Gauss nodes with their integrals as polynomials.  Each is the
 * nearest double. */
#include <CUnit/CUnit.h>
#include <dalembert_kernel.h>
#include <float.h>
#include <stdio.h>

/* The methods' own file, tables and all, without its descriptors. */
#undef DAL_INTEGRATOR
#define DAL_INTEGRATOR(identifier, function, ...) enum { unused_##identifier }
#include "../integrators/gauss_spark.c"

typedef long double real;

enum { MAX = 3 };

static const lobatto_rows *const methods[] = {&rows1, &rows2, &rows3};
/* Nodes are (1 + x)/2: the squares of x that are not 0. */
static const real gauss_square[] = {0.0L, 1.0L / 3, 3.0L / 5}, lobatto_square = 0.2L;

static real gauss_node(int s, int i)
{
    const int sign = s == 2 ? 2 * i - 1 : i - (s == 3);
    return 0.5L + sign * sqrtl(gauss_square[s - 1]) / 2;
}

static real lobatto_node(int s, int i)
{
    if (i == 0) return 0.0L;
    if (i == s) return 1.0L;
    return 0.5L + (s == 3) * (2 * i - 3) * sqrtl(lobatto_square) / 2;
}

/* The integral of l_j from 0 to x, or, without an integral, l_j(x). */
static real lagrange(int s, int j, real x, bool is_integral)
{
    real p[MAX + 1] = {1.0L}, value = 0.0L, power = is_integral ? x : 1.0L; /* p: by powers of x */
    for (int k = 0, degree = 0; k < s; k++) {
        if (k == j) continue;
        const real node = gauss_node(s, k), distance = gauss_node(s, j) - node;
        for (int i = ++degree; i >= 0; i--)
            p[i] = ((i > 0 ? p[i - 1] : 0.0L) - node * p[i]) / distance;
    }
    for (int i = 0; i < s; i++, power *= x) value += p[i] * power / (is_integral ? i + 1 : 1);
    return value;
}

static real lobatto_weight(int s, int i)
{
    static const real weights[MAX][2] = {{0.5L}, {1.0L / 6, 2.0L / 3}, {1.0L / 12, 5.0L / 12}};
    return weights[s - 1][i > 0 && i < s];
}

/* (1 - a-_ji/b_i) b~_j, and the row b~. */
static real of_lobatto(int s, int i, int j)
{
    const real part =
        i == s ? 0.0L : lagrange(s, i, lobatto_node(s, j), true) / lagrange(s, i, 1.0L, true);
    return lobatto_weight(s, j) * (1.0L - part);
}

/* What tolerances are multiplied by: under valgrind a long double is a double, and differences of
 * the expected values lose digits. */
static real coarseness(void)
{
    volatile real unit = 1.0L, sum = unit + LDBL_EPSILON;
    return sum == unit ? 2000.0L : 1.0L;
}

/* Half a unit of the last place of double, and the rounding of the expected value. */
static void close_to(int s, const char *what, int i, double seen, real expected)
{
    const real size = fabsl(expected) > 1e-3L ? fabsl(expected) : 1e-3L;
    const real limit = 0.501L * coarseness() * DBL_EPSILON * size;
    const bool is_close = fabsl((real)seen - expected) <= limit;
    if (!is_close) printf("\n  s = %d: %s, %d: %.17g, not %.17Lg", s, what, i, seen, expected);
    CU_ASSERT(is_close);
}

static void check_stages(const lobatto_rows *k)
{
    const int s = k->stages;
    for (int i = 0; i < s; i++) close_to(s, "c", i, k->c[i], gauss_node(s, i));
    for (int i = 0; i < (s + 1) * s; i++) {
        const real at = i < s * s ? gauss_node(s, i / s) : 1.0L;
        close_to(s, "a", i, k->a[i], lagrange(s, i % s, at, true));
        const real node = lobatto_node(s, i / s);
        close_to(s, "to_node", i, k->to_node[i], lagrange(s, i % s, node, true));
        close_to(s, "U", i, k->U[i], lagrange(s, i % s, node, false));
    }
}

static void check_nodes(const lobatto_rows *k)
{
    const int s = k->stages;
    for (int i = 0; i <= s; i++) {
        const real x = 2 * lobatto_node(s, i) - 1;
        const real legendre[] = {x, (3 * x * x - 1) / 2, (5 * x * x - 3) * x / 2};
        close_to(s, "node", i, k->node[i], lobatto_node(s, i));
        close_to(s, "n", i, k->n[i], legendre[s - 1]);
    }
    for (int i = 0; i < (s + 1) * (s + 1); i++)
        close_to(s, "lobatto", i, k->lobatto[i], of_lobatto(s, i / (s + 1), i % (s + 1)));
}

/* omega_rj = b_j c_j^r; alpha_ri = delta_is - r b~_i c~_i^(r-1), i = 1..s. */
static void check_means(const lobatto_rows *k, const double *omega)
{
    const int s = k->stages;
    for (int r = 0; r < s - 1; r++) {
        for (int j = 0; j < s; j++)
            close_to(s, "omega", r * (s + 1) + j, omega[r * (s + 1) + j],
                     lagrange(s, j, 1.0L, true) * powl(gauss_node(s, j), r));
        CU_ASSERT_EQUAL(omega[r * (s + 1) + s], 0.0);
        for (int i = 1; i <= s; i++)
            close_to(s, "alpha", r * s + i - 1, k->alpha[r * s + i - 1],
                     (i == s) -
                         (r ? r * lobatto_weight(s, i) * powl(lobatto_node(s, i), r - 1) : 0));
    }
    for (int j = 0; j <= s && s > 1; j++) CU_ASSERT_EQUAL(omega[(s - 1) * (s + 1) + j], j == s);
}

/* sum_j b_j c_j^r a_je for r < s - 1, and b_e. */
static real of_means(int s, int r, int e)
{
    real sum = 0.0L;
    if (r == s - 1) return lagrange(s, e, 1.0L, true);
    for (int j = 0; j < s; j++)
        sum += lagrange(s, j, 1.0L, true) * powl(gauss_node(s, j), r) *
               lagrange(s, e, gauss_node(s, j), true);
    return sum;
}

/* A sum whose terms cancel: what it must be, up to the rounding of coefficients. */
typedef struct cancelling {
    real sum, size;
} cancelling;

static void add(cancelling *c, real term)
{
    c->sum += term;
    c->size += fabsl(term);
}

static void check_sum(cancelling c, real expected)
{
    CU_ASSERT(fabsl(c.sum - expected) <= 4 * coarseness() * DBL_EPSILON * (1 + c.size));
}

static void check_inverse(const lobatto_rows *k)
{
    const int s = k->stages;
    for (int entry = 0; entry < s * s; entry++) {
        const int r = entry / s, i = entry % s;
        cancelling c = {0.0L, 0.0L};
        for (int e = 0; e < s; e++) add(&c, of_means(s, r, e) * k->inverse[e * s + i]);
        check_sum(c, r == i);
    }
}

/* What a change of M_column, or of E where column is s, adds to V_j/h. */
static real change_of_stage(const lobatto_rows *k, int j, int column)
{
    const int s = k->stages;
    real sum = 0.0L;
    if (column < s) return lagrange(s, column, gauss_node(s, j), true);
    for (int e = 0; e <= s; e++) sum += of_lobatto(s, j, e) * k->n[e];
    return sum;
}

/* The same of g at node i over h^2, and of D/h at the end where i is s + 1. */
static real change_of_node(const lobatto_rows *k, int i, int column)
{
    const int s = k->stages;
    real sum = 0.0L;
    if (i > s) return column < s ? lagrange(s, column, 1.0L, true) : 0.0L;
    for (int j = 0; j < s; j++)
        sum += lagrange(s, j, lobatto_node(s, i), true) * change_of_stage(k, j, column);
    return sum;
}

/* A change of M leaves psi (g/h^2, D/h) as it is, a change of E adds 1 to it. */
static void check_psi(const lobatto_rows *k)
{
    for (int column = 0; column <= k->stages; column++) {
        cancelling c = {0.0L, 0.0L};
        for (int i = 1; i <= k->stages + 1; i++)
            add(&c, k->psi[i - 1] * change_of_node(k, i, column));
        check_sum(c, column == k->stages);
    }
}

static void test_coefficients(void)
{
    static const double *const omegas[] = {one, omega2, omega3};
    for (int s = 1; s <= MAX; s++) {
        CU_ASSERT_EQUAL(methods[s - 1]->stages, s);
        check_stages(methods[s - 1]);
        check_nodes(methods[s - 1]);
        check_means(methods[s - 1], omegas[s - 1]);
        check_inverse(methods[s - 1]);
        check_psi(methods[s - 1]);
    }
}

void suite_spark_tableaus(void)
{
    CU_pSuite suite = CU_add_suite("coefficients of gauss-spark", NULL, NULL);
    CU_add_test(suite, "definitions of the coefficients", test_coefficients);
}
