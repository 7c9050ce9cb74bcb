/* test_algebra.c - products and eliminations that skip zeros: the bits of those that do not. */
#include "core/machine.h"
#include "core/sizes.h"
#include "core/vectors.h"
#include "kernel/algebra.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

enum { M = 20, N = 40 };

static uint64_t state;

static double uniform(void)
{
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return (double)(state >> 11) * 0x1p-52 - 1.0;
}

/* Of the entries, one in `every` is not 0. */
static void fill(double *x, int count, int every)
{
    for (int i = 0; i < count; i++)
        x[i] = (int)(state % 97) % every == 0 ? uniform() : (uniform(), 0.0);
}

static void plain_gram(const double *a, const double *b, int m, int n, double *g)
{
    for (int i = 0; i < m * m; i++) {
        g[i] = 0.0;
        for (int j = 0; j < n; j++) g[i] = fma(a[i / m * n + j], b[j * m + i % m], g[i]);
    }
}

static double plain_eliminate(double *g, int m, int k)
{
    for (int i = k + 1; i < m; i++) {
        const double factor = g[i * m + k] / g[k * m + k];
        for (int j = k; j < m; j++) g[i * m + j] -= factor * g[k * m + j];
    }
    return g[k * m + k];
}

/* The same bits, or NaN in both. */
static int same(const double *a, const double *b, int count)
{
    for (int i = 0; i < count; i++)
        if (memcmp(&a[i], &b[i], sizeof *a) != 0 && !(isnan(a[i]) && isnan(b[i]))) return 0;
    return 1;
}

static void test_gram(void)
{
    static const int every[] = {1, 3, 30, 1000};
    double a[M * N], b[N * M], g[M * M], plain[M * M];
    state = 1;
    for (int i = 0; i < 4; i++)
        for (int n = 1; n <= N; n += 13) {
            fill(a, M * n, every[i]);
            fill(b, n * M, every[i]);
            dal_gram(a, b, M, n, g);
            plain_gram(a, b, M, n, plain);
            CU_ASSERT(same(g, plain, M * M));
        }
}

/* A pivot that is 0 or not finite leaves what it does to the rows below it. */
static void test_eliminate(void)
{
    static const double pivots[] = {0.5, 0.0, INFINITY, NAN};
    double g[M * M], plain[M * M];
    state = 1;
    for (int i = 0; i < 20; i++) {
        fill(g, M * M, i % 5 + 1);
        g[7 * (M + 1)] = pivots[i % 4];
        for (int j = 0; i % 2 && j < 7; j++) g[7 * M + j] = 0.0;
        memcpy(plain, g, sizeof g);
        for (int k = 0; k < M; k++) {
            const double x = dal_eliminate(g, M, k), y = plain_eliminate(plain, M, k);
            CU_ASSERT(same(&x, &y, 1));
            CU_ASSERT(same(g, plain, M * M));
        }
    }
}

/* m x = y for x = m^-1 y, to rounding, whatever the zeros; the same bits in other units of rows. */
static void test_solve(void)
{
    double m[M * M], kept[M * M], x[M], other[M], y[M], unit[M];
    state = 1;
    for (int i = 0; i < M; i++) unit[i] = ldexp(1.0, i % 7 - 3);
    for (int k = 0; k < 40; k++) {
        fill(m, M * M, k % 8 + 1);
        for (int i = 0; i < M; i++) m[i * M + (i + 1) % M] += 4.0; /* no pivot on the diagonal */
        fill(y, M, 1);
        memcpy(kept, m, sizeof m);
        memcpy(x, y, sizeof x);
        dal_eliminate_in_units(m, x, M, NULL, 1);
        for (int i = 0; i < M; i++) {
            double rest = -y[i], size = fabs(y[i]);
            for (int j = 0; j < M; j++) {
                rest += kept[i * M + j] * x[j];
                size += fabs(kept[i * M + j] * x[j]);
            }
            CU_ASSERT(fabs(rest) <= 1e-13 * size);
        }
        for (int i = 0; i < M; i++) {
            other[i] = unit[i] * y[i];
            for (int j = 0; j < M; j++) m[i * M + j] = unit[i] * kept[i * M + j];
        }
        dal_eliminate_in_units(m, other, M, unit, M);
        CU_ASSERT(same(x, other, M));
    }
}

/* ---- sizes ---- */

/* Where the largest number is: the first of equal ones, and the first that is none. */
static void test_largest(void)
{
    static const struct {
        double x[4];
        int at;
        double max;
    } cases[] = {
        {{1.0, -3.0, 2.0, 3.0}, 1, 3.0},          {{0.0, 0.0, 0.0, 0.0}, 0, 0.0},
        {{1.0, 2.0, -4.0, 3.0}, 2, 4.0},          {{-0.0, 0.0, 0.0, 0x1p-1074}, 3, 0x1p-1074},
        {{1.0, NAN, INFINITY, 2.0}, 1, INFINITY}, {{1.0, 2.0, -INFINITY, 3.0}, 2, INFINITY},
        {{NAN, 2.0, 3.0, NAN}, 0, INFINITY}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        CU_ASSERT_EQUAL(dal__find_max_abs(cases[i].x, 4), cases[i].at);
        CU_ASSERT_EQUAL(dal__max_abs(cases[i].x, 4), cases[i].max);
    }
}

/* The power of 2 from x 1.23/2 on, of an exponent of at most 500; 1 for what is no number. */
static void test_power_of_two(void)
{
    static const double cases[][2] = {{1.0, 1.0},         {1.6, 1.0},       {1.63, 2.0},
                                      {0.8, 0.5},         {0.82, 1.0},      {3e6, 0x1p21},
                                      {1e-300, 0x1p-501}, {1e300, 0x1p499}, {0x1p-1074, 0x1p-501},
                                      {0.0, 0.0},         {-2.0, 0.0},      {NAN, 1.0},
                                      {INFINITY, 1.0},    {-INFINITY, 1.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        CU_ASSERT_EQUAL(dal__near_power_of_two(cases[i][0]), cases[i][1]);
}

/* The best instruction set is the last that the machine has; every machine has the first. */
static void test_machine(void)
{
    const int best = (int)dal__machine_best();
    CU_ASSERT(dal__machine_has(DAL__BASE));
    CU_ASSERT(dal__machine_has((dal__instructions)best));
    for (int set = best + 1; set < DAL__INSTRUCTION_SETS; set++)
        CU_ASSERT_FALSE(dal__machine_has((dal__instructions)set));
}

void suite_algebra(void);
void suite_algebra(void)
{
    CU_pSuite suite = CU_add_suite("algebra", NULL, NULL);
    CU_add_test(suite, "A B with zeros", test_gram);
    CU_add_test(suite, "eliminations with zeros", test_eliminate);
    CU_add_test(suite, "solutions with zeros", test_solve);
    CU_add_test(suite, "the largest number", test_largest);
    CU_add_test(suite, "powers of 2", test_power_of_two);
    CU_add_test(suite, "instruction sets", test_machine);
}
