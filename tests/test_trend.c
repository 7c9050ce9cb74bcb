/* test_trend.c - sizes and trends: the matrix of results on 1000 synthetic series of each kind and
 * the goals that it must meet, and series with one peculiarity each. */
#include "quick.h"
#include "trend_matrix.h"
#include <CUnit/CUnit.h>
#include <dalembert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
enum { SERIES = 100 };
#else
enum { SERIES = 1000 };
#endif

static double x[SERIES_CAPACITY], t[SERIES_CAPACITY];

/* ---- the matrix ---- */

typedef struct tally {
    int count, wrong, sure, covered, right_size, said[DAL_TREND_COUNT];
    clock_t time;
} tally;

static const series_kind *kind_named(const char *name)
{
    for (int i = 0; i < series_kind_count; i++)
        if (strcmp(series_kinds[i].name, name) == 0) return &series_kinds[i];
    for (int i = 0; i < shape_kind_count; i++)
        if (strcmp(shape_kinds[i].name, name) == 0) return &shape_kinds[i];
    return NULL;
}

/* Of any size, about any value, but where roundings matter. */
static double rescale(const series_kind *kind, series *s)
{
    const double size = series_log_between(&s->random, 1e-6, 1e3);
    const double offset = series_between(&s->random, -1.0, 1.0) * size;
    if (kind->accepts & (ROUNDINGS | TRUNCATION)) return 1.0;
    for (int k = 0; k < s->count; k++) s->x[k] = offset + size * s->x[k];
    s->drift *= size;
    return size;
}

static void draw_one(const series_kind *kind, uint64_t number, tally *all)
{
    series s;
    dal_statistics statistics;
    dal_trend f;
    series_draw(kind, number, x, &s);
    const double size = rescale(kind, &s);
    dal_statistics_start(&statistics, 1);
    dal_statistics_add_many(&statistics, 1, s.count, t, x, (size_t)s.count);
    const clock_t before = clock();
    dal_statistics_classify(&statistics, size, DAL_STATUS_OK, &f);
    all->time += clock() - before;
    CU_ASSERT(trend_is_consistent(&f));
    const int is_wrong = !series_accepts(kind, &s, &f);
    const double rate = s.drift / (t[1] * (s.count - 1));
    const dal_size_class right = kind->accepts & ROUNDINGS ? DAL_SIZE_ROUNDING : DAL_SIZE_LARGER;
    all->count++;
    all->wrong += is_wrong;
    all->sure += is_wrong && f.confidence > 0.9;
    all->covered += f.rate_low <= rate && rate <= f.rate_high;
    all->right_size += f.size == right;
    all->said[f.trend]++;
}

static double percent(int part, const tally *all) { return 100.0 * part / all->count; }

static void print_row(const series_kind *kind, const tally *all)
{
    printf("%-28s %5.1f %5.1f %5.1f", kind->name, percent(all->wrong, all), percent(all->sure, all),
           percent(all->said[DAL_TREND_UNDECIDED], all));
    if (kind->accepts & COVERS)
        printf(" %6.1f ", percent(all->covered, all));
    else
        printf("        ");
    for (dal_trend_class i = 0; i < DAL_TREND_COUNT; i++)
        if (all->said[i] > 0 && i != DAL_TREND_UNDECIDED)
            printf(" %s %.1f", dal_trend_text(i), percent(all->said[i], all));
    printf("\n");
}

/* What fewer series than a thousand may miss a goal by, in percent. */
static double margin_of(int count) { return count < 1000 ? 300.0 / sqrt(count) : 0.0; }

static void assert_goals(const series_kind *kind, const tally *all)
{
    const double few = margin_of(all->count);
    CU_ASSERT(percent(all->wrong, all) <= 5.0 + few);
    CU_ASSERT(percent(all->sure, all) <= 1.0 + few);
    if (kind->accepts & DECIDES)
        CU_ASSERT(percent(all->said[DAL_TREND_UNDECIDED], all) <= 8.0 + few);
    if (kind->accepts & WALKS)
        CU_ASSERT(percent(all->said[DAL_TREND_RANDOM_WALK], all) >= 30.0 - few);
    if (kind->accepts & COVERS) CU_ASSERT(percent(all->covered, all) >= 93.0 - few);
    CU_ASSERT(percent(all->right_size, all) >= 99.0 - few);
}

/* The percentage of a kind that is called a walk. */
static double walks_among(const series_kind *kind)
{
    tally all = {0};
    for (int k = 0; k < (int)long_run(SERIES); k++) draw_one(kind, (uint64_t)k, &all);
    return percent(all.said[DAL_TREND_RANDOM_WALK], &all);
}

/* A walk is called one nine times as often as noise whose memory of T/8 resembles one: with equal
 * odds before, such a result is right in nine of ten cases. */
static void test_walks(void)
{
    const double few = margin_of((int)long_run(SERIES));
    const double walk = walks_among(kind_named("walk")) + few;
    const double memory = walks_among(kind_named("memory T/8")) - few;
    printf("\n  walks %.1f %%, memory T/8 %.1f %%\n", walk, memory);
    CU_ASSERT(walk >= 9.0 * memory);
}

static void test_matrix(void)
{
    clock_t time = 0;
    int count = 0;
    printf("\n%-28s %5s %5s %5s %6s   results, %%\n", "", "wrong", "sure", "undec", "cover");
    for (int i = 0; i < series_kind_count; i++) {
        tally all = {0};
        for (int k = 0; k < (int)long_run(SERIES); k++)
            draw_one(&series_kinds[i], (uint64_t)k, &all);
        print_row(&series_kinds[i], &all);
        assert_goals(&series_kinds[i], &all);
        time += all.time;
        count += all.count;
    }
    printf("%.1f us for a classification\n", 1e6 * (double)time / CLOCKS_PER_SEC / count);
}

/* ---- shapes ---- */

/* Twenty series, four in a quick run, of each shape, length and noise: few, so that a sure error
 * may occur. */
static void test_shapes(void)
{
    enum { LENGTHS = 2 };
    static const int lengths[LENGTHS] = {300, 3000};
    const int drawn = 20 / case_stride(5);
    int kinds_with_errors = 0;
    for (int i = 0; i < shape_kind_count; i++) {
        const series_kind *const kind = &shape_kinds[i];
        trend_cell all = {0};
        for (int k = 0; k < LENGTHS * SERIES_NOISES; k++)
            if (kind->noises >> k / LENGTHS & 1)
                trend_cell_fill(&all, kind, drawn, lengths[k % LENGTHS], series_noise[k / LENGTHS],
                                x, t);
        CU_ASSERT_EQUAL(all.outside, 0);
        if (kind->accepts & HARD) continue;
        if (100 * all.sure > 5 * all.count)
            printf("\n  %s: %d sure errors of %d", kind->name, all.sure, all.count);
        CU_ASSERT(100 * all.sure <= 5 * all.count);
        kinds_with_errors += all.sure > 0;
    }
    CU_ASSERT(kinds_with_errors <= 5);
}

/* How often kinds that must not become undecided are right, in percent of 40 series of 3000 values,
 * of which sampling may take 15: two deviations at 50 %. */
static void test_decided(void)
{
    static const struct {
        const char *name;
        int noise, right;
    } goals[] = {
        {"relaxations T/30, T/5", 0, 100},
        {"step, .1-.8", 2, 94},
        {"decay, 3-8 e-folds", 1, 84},
        {"exponential, 4-10", 0, 89},
        {"amplitude ~ t", 1, 98},
        {"amplitude ~ t", 2, 94},
        {"amplitude exp, 4-10", 2, 81},
        {"memory T/50, again", 0, 42},
        {"white noise", 1, 94},
        {"ringing step", 0, 85},
    };
    for (size_t i = 0; i < sizeof goals / sizeof goals[0]; i++) {
        trend_cell cell = {0};
        trend_cell_fill(&cell, kind_named(goals[i].name), 40, 3000, series_noise[goals[i].noise], x,
                        t);
        const double right = 100.0 * cell.right / cell.count;
        if (right < goals[i].right - 15.0) printf("\n  %s: right in %.0f %%", goals[i].name, right);
        CU_ASSERT(right >= goals[i].right - 15.0);
    }
}

/* ---- peculiarities ---- */

typedef double signal(int k);

enum { LONG = 5000 };

static double constant(int k) { return (void)k, -7.0; }
static double few_bits(int k) { return 1.0 + 0x1p-52 * (k % 3); }
static double small_line(int k) { return 1.0 + 0x1p-52 * (k / 100); }
static double steady_drift(int k) { return 1.0 + 1e-14 * k; }
static double half_wave(int k) { return sin(3.0 * k / LONG); }
static double one_wave(int k) { return sin(6.0 * k / LONG); }
static double forty_waves(int k) { return sin(250.0 * k / LONG); }
static double spike(int k) { return k == 0 ? 1.0 : 0.0; }
static double growing(int k) { return exp(9.0 * k / LONG) * cos(2.0 * k); }
/* 450 roundings in 5000 steps, but all to one side and ever fewer: no sum of roundings. */
static double relaxing(int k) { return 1.0 - 1e-13 * exp(-8.0 * k / LONG); }
static double broken(int k) { return k < 4000 ? 1.0 : NAN; }
/* A slow trend under a large oscillation. */
static double leaning(int k) { return 1e-2 * k / LONG + 1e-2 * cos(0.7 * k); }

static dal_trend follow(signal *of, double scale, int count)
{
    dal_statistics statistics;
    dal_trend f;
    dal_statistics_start(&statistics, 1);
    for (int k = 0; k <= count; k++) {
        const double own = of(k);
        dal_statistics_add(&statistics, 1, 0.1 * k, &own);
    }
    dal_statistics_classify(&statistics, scale, DAL_STATUS_OK, &f);
    return f;
}

static void test_peculiarities(void)
{
    static const struct {
        signal *x;
        double scale;
        int count;
        dal_size_class size;
        dal_trend_class trend;
    } cases[] = {
        {constant, 1.0, LONG, DAL_SIZE_EXACT, DAL_TREND_NONE},
        {constant, 1.0, 1, DAL_SIZE_EXACT, DAL_TREND_NONE},
        {constant, 1.0, 0, DAL_SIZE_EXACT, DAL_TREND_UNDECIDED},
        {few_bits, 1.0, LONG, DAL_SIZE_ROUNDING, DAL_TREND_NONE},
        {few_bits, 1e-6, LONG, DAL_SIZE_LARGER, DAL_TREND_NONE},
        {small_line, 1.0, LONG, DAL_SIZE_ROUNDING, DAL_TREND_LINEAR},
        {steady_drift, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_LINEAR},
        {steady_drift, 1e6, LONG, DAL_SIZE_ROUNDING, DAL_TREND_LINEAR},
        {steady_drift, 1.0, 30, DAL_SIZE_LARGER, DAL_TREND_UNDECIDED},
        {half_wave, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_UNDECIDED},
        {one_wave, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_UNDECIDED},
        {forty_waves, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_NONE},
        {spike, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_SETTLES},
        {growing, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_GROWING},
        {relaxing, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_SETTLES},
        {broken, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_ABORTED},
        {leaning, 1.0, 500, DAL_SIZE_LARGER, DAL_TREND_LINEAR},
        {leaning, 1.0, 2000, DAL_SIZE_LARGER, DAL_TREND_LINEAR},
        {leaning, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_LINEAR},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const dal_trend f = follow(cases[i].x, cases[i].scale, cases[i].count);
        if (f.trend != cases[i].trend || f.size != cases[i].size)
            printf("\n  case %zu: %s, %s, %g, rate %g (%g %g)", i, dal_size_text(f.size),
                   dal_trend_text(f.trend), f.confidence, f.rate, f.rate_low, f.rate_high);
        CU_ASSERT_EQUAL(f.trend, cases[i].trend);
        if (f.trend != DAL_TREND_ABORTED) CU_ASSERT_EQUAL(f.size, cases[i].size);
    }
}

/* ---- exponents ---- */

/* The deviation of the exponent p of s^p = x - noise, for noise of deviation 1 in `count` values:
 * by Fisher's information of p beside offset and height (Seber, Wild 1989, 2.1). */
static double exponent_deviation(double p, int count)
{
    double basis[3][3] = {{0}};
    for (int k = 0; k < count; k++) {
        const double u = (k + 0.5) / count, f = pow(u, p), row[] = {1.0, f, f * log(u)};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) basis[i][j] += row[i] * row[j];
    }
    for (int i = 0; i < 2; i++) /* the Schur complement of the last */
        for (int j = i + 1; j < 3; j++)
            for (int k = 2; k >= i; k--) basis[j][k] -= basis[i][k] * basis[j][i] / basis[i][i];
    return 1.0 / sqrt(basis[2][2]);
}

/* How often in 200 series s^p with noise, from which p could be known to `deviation` at best, an
 * exponent is stated; and how often it is wrong. */
static void count_exponents(double p, double deviation, int *stated, int *wrong)
{
    enum { COUNT = 2000, DRAWS = 200 };
    const double noise = deviation / exponent_deviation(p, COUNT);
    uint64_t random = 12345;
    *stated = *wrong = 0;
    for (int i = 0; i < DRAWS; i++) {
        dal_statistics statistics;
        dal_trend f;
        for (int k = 0; k < COUNT; k++)
            x[k] = pow((k + 0.5) / COUNT, p) + noise * series_normal(&random);
        dal_statistics_start(&statistics, 1);
        dal_statistics_add_many(&statistics, 1, COUNT, t, x, COUNT);
        dal_statistics_classify(&statistics, 1.0, DAL_STATUS_OK, &f);
        *stated += f.trend == DAL_TREND_POWER;
        *wrong += f.trend == DAL_TREND_POWER && fabs(f.exponent - p) > 0.15;
    }
}

/* An exponent is stated where the data know it, and only there. */
static void test_exponents(void)
{
    static const double powers[] = {0.5, 1.5, 2.0, 2.7};
    for (size_t i = 0; i < sizeof powers / sizeof powers[0]; i += (size_t)case_stride(3)) {
        int stated, wrong, guessed, wrongly;
        count_exponents(powers[i], 0.01, &stated, &wrong);
        count_exponents(powers[i], 0.2, &guessed, &wrongly);
        printf("\n  t^%g: stated %d (%d wrong), where unknown %d", powers[i], stated, wrong,
               guessed);
        CU_ASSERT(stated >= 180);
        CU_ASSERT_EQUAL(wrong, 0);
        CU_ASSERT(guessed <= 20);
    }
    printf("\n");
}

/* ---- sizes ---- */

/* The trend of a series times factor. */
static dal_trend scaled(const char *name, uint64_t number, double factor)
{
    series s;
    dal_statistics statistics;
    dal_trend f;
    series_draw(kind_named(name), number, x, &s);
    for (int k = 0; k < s.count; k++) x[k] *= factor;
    dal_statistics_start(&statistics, 1);
    dal_statistics_add_many(&statistics, 1, s.count, t, x, (size_t)s.count);
    dal_statistics_classify(&statistics, factor, DAL_STATUS_OK, &f);
    return f;
}

/* Powers of two change nothing, from the smallest to the largest numbers. */
static void test_sizes(void)
{
    static const char *const names[] = {"line, SNR 3, tones",  "oscillation, 10 periods on",
                                        "step, middle, noise", "walk of roundings",
                                        "white, long",         "grows like t"};
    static const int exponents[] = {-990, -500, -40, 70, 500, 890, 905, 1000, 1015};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        for (size_t k = 0; k < sizeof exponents / sizeof exponents[0]; k++) {
            const dal_trend one = scaled(names[i], 3, 1.0);
            const dal_trend f = scaled(names[i], 3, ldexp(1.0, exponents[k]));
            const double back = ldexp(1.0, -exponents[k] / 2), again = exponents[k] % 2 ? 0.5 : 1.0;
            const double near = 1e-6 * (one.rate_high - one.rate_low);
            if (f.trend != one.trend || f.size != one.size)
                printf("\n  %s 2^%d: %s, %s", names[i], exponents[k], dal_size_text(f.size),
                       dal_trend_text(f.trend));
            CU_ASSERT(trend_is_consistent(&f));
            CU_ASSERT_EQUAL(f.trend, one.trend);
            CU_ASSERT_EQUAL(f.size, one.size);
            CU_ASSERT_EQUAL(isnan(f.confidence), isnan(one.confidence));
            if (!isnan(one.confidence)) CU_ASSERT_DOUBLE_EQUAL(f.confidence, one.confidence, 1e-6);
            if (exponents[k] > 0)
                CU_ASSERT_DOUBLE_EQUAL(f.rate_low * back * back * again, one.rate_low, near);
        }
}

static int fill_times(void)
{
    for (int k = 0; k < SERIES_CAPACITY; k++) t[k] = 0.01 * k;
    return 0;
}

/* A clean tone is taken out of a line to far less than its amplitude, wherever between the
 * frequencies of the first guess it lies. */
static void test_line_under_a_tone(void)
{
    enum { VALUES = 20000 };
    const double rate = 1e-3, two_pi = 2.0 * acos(-1.0);
    for (int k = 0; k < 6; k++) {
        const double periods = 5.31 + 2.17 * k;
        dal_statistics s;
        dal_trend f;
        dal_statistics_start(&s, 1);
        for (int i = 0; i <= VALUES; i++) {
            const double time = (double)i / VALUES;
            const double value = cos(two_pi * periods * time + 0.3) + rate * time;
            dal_statistics_add(&s, 1, time, &value);
        }
        dal_statistics_classify(&s, VALUES, DAL_STATUS_OK, &f);
        CU_ASSERT_DOUBLE_EQUAL(f.rate, rate, 1e-6);
    }
}

void suite_trend(void)
{
    CU_pSuite suite = CU_add_suite("trends", fill_times, NULL);
    CU_add_test(suite, "1000 series of each kind", test_matrix);
    CU_add_test(suite, "walks and memory", test_walks);
    CU_add_test(suite, "shapes", test_shapes);
    CU_add_test(suite, "decided", test_decided);
    CU_add_test(suite, "peculiarities", test_peculiarities);
    CU_add_test(suite, "exponents", test_exponents);
    CU_add_test(suite, "sizes", test_sizes);
    CU_add_test(suite, "a line under a clean tone", test_line_under_a_tone);
}
