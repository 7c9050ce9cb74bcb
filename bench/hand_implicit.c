/* hand_implicit.c - implicit midpoint and Gauss' methods of order 4 and 8 as somebody would write
 * them by hand for one system, with what the library does for speed: the unknowns are the
 * accelerations of the stages, the first guess is extrapolated from the last steps, and the
 * iteration ends by the same rule (lib/kernel/collocation.h, solve.h).
 *
 *     hand-implicit midpoint|gauss4 A|B3       with libm's sine and cosine, and plain sums
 *     hand-implicit-own midpoint|gauss4 A      with this project's (HAND_OWN_SINCOS)
 *     hand-implicit-compensated midpoint|gauss4 A|B3
 *                                              also with its arithmetic (HAND_COMPENSATED):
 *                                              compensated sums, coefficients of more than 53 bits,
 *                                              and no contraction by the compiler
 *     hand-links-N gauss4|gauss8+project LN    a chain of N coordinates (HAND_LINKS) of links.inc;
 *                                              the projection is a loop over its constraints;
 *     hand-links-compensated-N                 with this project's arithmetic, except for gauss8's
 *                                              coefficients
 *
 *     V_i = v + h sum a_ij K_j     Q_i = q + h sum a_ij V_j     K_i = F(Q_i, V_i) */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include "real.inc"

#ifdef HAND_LINKS
#include "links.inc"
enum { DIM = LINKS_DIM, MAX_STAGES = 4, STEPS = 200 };
#else
#include "fields.inc"
enum { DIM = SMALL_DIM, MAX_STAGES = 2, STEPS = 1000 };
#endif

enum { N = DIM / 2, DIFFERENCES = 4, MAX_ITERATIONS = 50 };

/* Rounding of an increment, and one that is too small for divergence, relative to the state. */
static const double ROUNDING = 1.4e-14, SMALL = 1e-12;

#ifdef HAND_COMPENSATED
enum { COMPENSATED = 1 };
#else
enum { COMPENSATED = 0 };
#endif

/* a = high + low, where high has few bits; extrapolation: the Lagrange polynomials on the nodes c_j
 * at 1 + c_i. */
typedef double square[MAX_STAGES][MAX_STAGES];
typedef struct tableau {
    square a, high, low, extrapolation;
    double b[MAX_STAGES];
} tableau;

#define ROOT3 1.7320508075688772
#define LOW   3.87365405187117745426e-4 /* 1/4 - sqrt(3)/6 + 5/128 */
#ifndef HAND_LINKS
static const tableau midpoint = {
    .a = {{0.5}}, .high = {{0.5}}, .b = {1.0}, .extrapolation = {{1.0}}};
#endif
static const tableau gauss4 = {.a = {{0.25, 0.25 - ROOT3 / 6.0}, {0.25 + ROOT3 / 6.0, 0.25}},
                               .high = {{0.25, -5.0 / 128.0}, {69.0 / 128.0, 0.25}},
                               .low = {{0.0, LOW}, {-LOW, 0.0}},
                               .b = {0.5, 0.5},
                               .extrapolation = {{1.0 - ROOT3, ROOT3}, {-ROOT3, 1.0 + ROOT3}}};
#ifdef HAND_LINKS
/* On the zeros of the Legendre polynomial P4(2x - 1). */
#define GAUSS8_A                                                                                   \
    {                                                                                              \
        {0.086963711284363464343, -0.026604180084998793313, 0.012627462689404724515,               \
         -0.0035551496857956831569},                                                               \
            {0.18811811749986807165, 0.16303628871563653566, -0.027880428602470895224,             \
             0.0067355005945381555154},                                                            \
            {0.16719192197418877317, 0.35395300603374396654, 0.16303628871563653566,               \
             -0.014190694931141142964},                                                            \
        {                                                                                          \
            0.17748257225452261184, 0.3134451147418683468, 0.35267675751627186463,                 \
                0.086963711284363464343                                                            \
        }                                                                                          \
    }
static const tableau gauss8 = {.a = GAUSS8_A,
                               .high = GAUSS8_A,
                               .b = {0.17392742256872692869, 0.32607257743127307131,
                                     0.32607257743127307131, 0.17392742256872692869},
                               .extrapolation = {{-0.30434753228963353155, 1.0425440204501055979,
                                                  -1.9298963902970090161, 2.1916999021365369498},
                                                 {-1.9563426110812630434, 6.2464276146547676179,
                                                  -9.4640124407666893484, 6.1739274371931847739},
                                                 {-7.352359801851610409, 22.244205449220565329,
                                                  -29.806813631562519579, 15.914967984193564659},
                                                 {-14.97189291059041293, 44.096131818793828184,
                                                  -55.988972457400800747, 27.864733549197385493}}};
#endif

#define INLINE static inline __attribute__((always_inline))
typedef void field(const real *y, real *dy);
typedef double stages[MAX_STAGES][N];

/* The state, and what its sums have lost, which is 0 where they are plain. */
typedef struct state {
    double y[DIM], lost[DIM];
} state;

/* sum a_ij x_j in component c */
INLINE double combine(const tableau *m, int s, int i, stages x, int c)
{
    double sum = 0.0, high = m->high[i][0] * x[0][c], low = m->low[i][0] * x[0][c];
    if (COMPENSATED) {
        for (int j = 1; j < s; j++) high = fma(m->high[i][j], x[j][c], high);
        for (int j = 1; j < s; j++) low = fma(m->low[i][j], x[j][c], low);
        return s > 1 ? high + low : high;
    }
    for (int j = 0; j < s; j++) sum += m->a[i][j] * x[j][c];
    return sum;
}

/* out_i = base + h sum a_ij x_j, base = y from its component `first` on */
INLINE void stage_values(const tableau *m, int s, const state *base, int first, stages x,
                         stages out)
{
    for (int i = 0; i < s; i++)
        for (int c = 0; c < N; c++) {
            const double sum = combine(m, s, i, x, c), y = base->y[first + c];
            out[i][c] = COMPENSATED ? y + fma(BENCH_H_STEP, sum, base->lost[first + c])
                                    : y + BENCH_H_STEP * sum;
        }
}

/* y_c += h sum b_i x_i */
INLINE void add_increment(const tableau *m, int s, stages x, state *z, int first)
{
    for (int c = 0; c < N; c++) {
        double sum = 0.0, *y = &z->y[first + c], *lost = &z->lost[first + c];
        const double old = *y;
        for (int i = 0; i < s; i++) sum += m->b[i] * x[i][c];
        *y = COMPENSATED ? old + fma(BENCH_H_STEP, sum, *lost) : old + BENCH_H_STEP * sum;
        if (COMPENSATED) *lost += fma(BENCH_H_STEP, sum, old - *y);
    }
}

/* As fmax, but compiled to one instruction. */
INLINE double larger(double a, double b) { return a < b ? b : a; }

INLINE double max_norm(const double *x)
{
    double norm = 0.0;
    for (int c = 0; c < N; c++) norm = larger(norm, fabs(x[c]));
    return norm;
}

/* One iteration; h times the largest change of K. */
INLINE double iterate(const tableau *m, int s, field *f, const state *z, stages K)
{
    stages Q, V;
    double change = 0.0;
    stage_values(m, s, z, N, K, V);
    stage_values(m, s, z, 0, V, Q);
    for (int i = 0; i < s; i++) {
        double at[DIM], image[DIM];
        memcpy(at, Q[i], sizeof Q[i]);
        memcpy(at + N, V[i], sizeof V[i]);
        f(at, image);
        for (int c = 0; c < N; c++) {
            change = larger(change, fabs(image[N + c] - K[i][c]));
            K[i][c] = image[N + c];
        }
    }
    return BENCH_H_STEP * change;
}

/* Iterates until the change is 0, or stagnates at rounding level, or twice while it is small. */
INLINE int solve(const tableau *m, int s, field *f, const state *z, stages K)
{
    double before = INFINITY;
    for (int k = 0, stagnations = 0; k < MAX_ITERATIONS; k++) {
        const double now = iterate(m, s, f, z, K);
        stagnations = before <= now ? stagnations + 1 : 0;
        before = now;
        if (now == 0.0) return 0;
        if (stagnations == 0) continue;
        double size = max_norm(z->y + N) + max_norm(z->y) / BENCH_H_STEP;
        for (int i = 0; i < s; i++) size = fmax(size, BENCH_H_STEP * max_norm(K[i]));
        if (now <= (stagnations > 1 ? SMALL : ROUNDING) * size) return 0;
    }
    return 1;
}

/* The polynomial through the last K at the nodes of this step. */
INLINE void extrapolate(const tableau *m, int s, stages K, stages out)
{
    for (int i = 0; i < s; i++)
        for (int c = 0; c < N; c++) {
            out[i][c] = 0.0;
            for (int j = 0; j < s; j++) out[i][c] += m->extrapolation[i][j] * K[j][c];
        }
}

/* The error of a polynomial, and its differences over the steps. */
INLINE void record_error(double e, double error[DIFFERENCES])
{
    for (int d = 0; d < DIFFERENCES; d++) {
        const double kept = error[d];
        error[d] = e;
        e -= kept;
    }
}

/* project, where it is not NULL, ends a step. */
INLINE int integrate(const tableau *m, int s, field *f, void (*project)(double *y),
                     const double *start, double *end)
{
    double dy[DIM], error[MAX_STAGES][N][DIFFERENCES] = {{{0.0}}};
    state z = {.lost = {0.0}};
    stages K, polynomial, V;
    memcpy(z.y, start, sizeof z.y);
    f(z.y, dy);
    for (int i = 0; i < s; i++) memcpy(K[i], dy + N, sizeof K[i]);
    for (int step = 0; step < STEPS; step++) {
        extrapolate(m, s, K, polynomial);
        for (int i = 0; i < s; i++)
            for (int c = 0; c < N; c++) {
                const double *e = error[i][c];
                K[i][c] = polynomial[i][c] + e[0] + e[1] + e[2] + e[3];
            }
        if (solve(m, s, f, &z, K)) return 1;
        for (int i = 0; i < s; i++)
            for (int c = 0; c < N; c++)
                record_error(step ? K[i][c] - polynomial[i][c] : 0.0, error[i][c]);
        stage_values(m, s, &z, N, K, V);
        add_increment(m, s, V, &z, 0);
        add_increment(m, s, K, &z, N);
        if (project) project(z.y);
    }
    memcpy(end, z.y, sizeof z.y);
    return 0;
}

#ifdef HAND_LINKS
static int gauss4_links(void *start, double *end)
{
    return integrate(&gauss4, 2, links_field, NULL, start, end);
}
static int gauss8_project_links(void *start, double *end)
{
    return integrate(&gauss8, 4, links_field, links_project, start, end);
}

int main(int argc, char **argv)
{
    static double y[DIM];
    const bench_contender four = {STEPS, DIM, gauss4_links, y},
                          eight = {STEPS, DIM, gauss8_project_links, y};
    links_start(y);
    if (bench_is(argc, argv, "gauss4 L" LINKS_TEXT)) return bench_measure(&four);
    if (bench_is(argc, argv, "gauss8+project L" LINKS_TEXT)) return bench_measure(&eight);
    return bench_unknown(argc, argv);
}
#else
static int midpoint_sleigh(void *start, double *end)
{
    return integrate(&midpoint, 1, sleigh_field, NULL, start, end);
}
static int midpoint_chain3(void *start, double *end)
{
    return integrate(&midpoint, 1, chain3_field, NULL, start, end);
}
static int gauss4_sleigh(void *start, double *end)
{
    return integrate(&gauss4, 2, sleigh_field, NULL, start, end);
}
static int gauss4_chain3(void *start, double *end)
{
    return integrate(&gauss4, 2, chain3_field, NULL, start, end);
}

int main(int argc, char **argv)
{
    static double sleigh[DIM], chain3[DIM];
    const struct {
        const char *name;
        bench_contender timed;
    } contender[] = {{"midpoint A", {STEPS, DIM, midpoint_sleigh, sleigh}},
                     {"midpoint B3", {STEPS, DIM, midpoint_chain3, chain3}},
                     {"gauss4 A", {STEPS, DIM, gauss4_sleigh, sleigh}},
                     {"gauss4 B3", {STEPS, DIM, gauss4_chain3, chain3}}};
    memcpy(sleigh, sleigh_y, sizeof sleigh);
    memcpy(chain3, chain3_y, sizeof chain3);
    for (size_t i = 0; i < sizeof contender / sizeof *contender; i++)
        if (bench_is(argc, argv, contender[i].name)) return bench_measure(&contender[i].timed);
    return bench_unknown(argc, argv);
}
#endif
