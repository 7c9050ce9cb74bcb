/* trend_matrix.c - how often trends are right, wrong and sure of what is wrong.
 *
 * Each cell of the matrix has series of one kind, of one length, under one noise: right, wrong and
 * sure and wrong (a confidence of 0.9 and more), in percent; the rest is undecided.  Processes
 * share the cells. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "trend_matrix.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { LENGTHS = 4, CELLS = LENGTHS * SERIES_NOISES, MAX_KINDS = 160 };

static const int lengths[LENGTHS] = {300, 3000, 20000, 100000};
static const double sure = 0.9;

/* ---- what a trend is worth ---- */

int series_accepts(const series_kind *kind, const series *s, const dal_trend *f)
{
    static const int bit[] = {ACCEPT_NONE,  ACCEPT_SETTLES,     ACCEPT_WALK,   ACCEPT_LINEAR,
                              ACCEPT_POWER, ACCEPT_EXPONENTIAL, ACCEPT_GROWING};
    if (f->trend == DAL_TREND_UNDECIDED) return 1;
    if (f->trend >= DAL_TREND_UNDECIDED) return 0;
    if (f->trend == DAL_TREND_POWER && kind->accepts & ACCEPT_LOGARITHM) return f->exponent < 0.2;
    if (f->trend == DAL_TREND_POWER && !(fabs(f->exponent - s->exponent) <= 0.15)) return 0;
    if (f->trend == DAL_TREND_NONE && kind->accepts & ACCEPT_LINEAR)
        return f->confidence < 0.9 && fabs(s->drift) <= f->max_drift;
    return (kind->accepts & bit[f->trend]) != 0;
}

int trend_is_consistent(const dal_trend *f)
{
    const int has_zero = f->rate_low <= 0.0 && f->rate_high >= 0.0;
    const int states = f->trend < DAL_TREND_UNDECIDED;
    if (states ? !(f->confidence > 0.0 && f->confidence <= 1.0) : !isnan(f->confidence)) return 0;
    if (!(f->rate_low <= f->rate && f->rate <= f->rate_high)) return 0;
    if ((f->size == DAL_SIZE_EXACT) != (f->deviation == 0.0)) return 0;
    if (f->amplitude > 1.001 * (f->deviation + f->max_drift)) return 0;
    switch (f->trend) {
    case DAL_TREND_NONE:
    case DAL_TREND_SETTLES:
        return has_zero && f->exponent == 0.0;
    case DAL_TREND_RANDOM_WALK:
        return has_zero && f->exponent == 0.5;
    case DAL_TREND_LINEAR:
        return !has_zero && f->exponent == 1.0;
    case DAL_TREND_POWER:
        return f->exponent >= 0.0 && f->exponent != 1.0;
    default:
        return isnan(f->exponent);
    }
}

/* The width of a 95 % interval of least squares of a line under white noise. */
static double least_squares_width(const double *x, const double *t, int n)
{
    double mx = 0.0, mt = 0.0, tt = 0.0, tx = 0.0, xx = 0.0;
    for (int k = 0; k < n; k++) {
        mx += x[k] / n;
        mt += t[k] / n;
    }
    for (int k = 0; k < n; k++) {
        tt += (t[k] - mt) * (t[k] - mt);
        tx += (t[k] - mt) * (x[k] - mx);
        xx += (x[k] - mx) * (x[k] - mx);
    }
    return 2.0 * 1.96 * sqrt((xx - tx * tx / tt) / (n - 2) / tt);
}

static void count_one(trend_cell *cell, const series_kind *kind, const series *s,
                      const dal_trend *f, const double *t)
{
    const int accepted = series_accepts(kind, s, f);
    const int undecided = f->trend == DAL_TREND_UNDECIDED;
    const double rate = s->drift / (t[1] * (s->count - 1));
    const int has_zero = f->rate_low <= 0.0 && f->rate_high >= 0.0;
    const int is_level = f->trend == DAL_TREND_NONE || f->trend == DAL_TREND_SETTLES;
    cell->count++;
    cell->right += undecided ? (kind->accepts & ACCEPT_UNDECIDED) != 0 : accepted;
    cell->wrong += !accepted;
    cell->sure += !accepted && f->confidence >= sure;
    cell->outside += is_level && !has_zero;
    cell->covered += f->rate_low <= rate && rate <= f->rate_high;
    cell->said[f->trend]++;
    if (kind->accepts & COVERS)
        cell->width += (f->rate_high - f->rate_low) / least_squares_width(s->x, t, s->count);
}

void trend_cell_fill(trend_cell *cell, const series_kind *kind, int count, int values, double noise,
                     double *x, const double *t)
{
    for (int k = 0; k < count; k++) {
        series s;
        dal_statistics statistics;
        dal_trend f;
        series_draw_values(kind, (uint64_t)k, values, noise, x, &s);
        const int is_rounding = kind->accepts & (ROUNDINGS | TRUNCATION);
        dal_statistics_start(&statistics, 1);
        dal_statistics_add_many(&statistics, 1, s.count, t, x, (size_t)s.count);
        const clock_t before = clock();
        dal_statistics_classify(&statistics, is_rounding ? 1.0 : 1e-9, DAL_STATUS_OK, &f);
        cell->seconds += (double)(clock() - before) / CLOCKS_PER_SEC;
        count_one(cell, kind, &s, &f, t);
    }
}

/* ---- the matrix ---- */

static const series_kind *kind_of(int i)
{
    return i < series_kind_count ? &series_kinds[i] : &shape_kinds[i - series_kind_count];
}

static int has_noise(const series_kind *kind, int noise)
{
    return kind->noises ? kind->noises >> noise & 1 : noise == 0;
}

/* Every jobs-th kind. */
static void fill_share(trend_cell (*cell)[CELLS], int job, int jobs, int count, const char *name)
{
    static double x[SERIES_CAPACITY], t[SERIES_CAPACITY];
    for (int k = 0; k < SERIES_CAPACITY; k++) t[k] = 0.01 * k;
    for (int i = job; i < series_kind_count + shape_kind_count; i += jobs)
        for (int k = 0; k < CELLS; k++)
            if (has_noise(kind_of(i), k / LENGTHS) && strstr(kind_of(i)->name, name))
                trend_cell_fill(&cell[i][k], kind_of(i), count, lengths[k % LENGTHS],
                                series_noise[k / LENGTHS], x, t);
}

static void print_cell(const series_kind *kind, const trend_cell *c)
{
    const double percent = 100.0 / c->count;
    char text[64];
    snprintf(text, sizeof text, "%.3g/%.3g/%.2g%s", percent * c->right, percent * c->wrong,
             percent * c->sure, c->outside ? "!" : "");
    printf(" %14s", text);
    if (kind->accepts & COVERS)
        printf(" (%3.0f, %3.1f)", percent * c->covered, c->width / c->count);
}

static void print_words(const trend_cell *c)
{
    static const char letters[] = "nsrlpegua";
    printf("  ");
    for (int i = 0; i < DAL_TREND_COUNT; i++)
        if (c->said[i]) printf(" %c%.0f", letters[i], 100.0 * c->said[i] / c->count);
}

static void print_rows(const series_kind *kind, const trend_cell *cell)
{
    for (int noise = 0; noise < SERIES_NOISES; noise++) {
        const trend_cell *const c = cell + noise * LENGTHS;
        if (!c->count) continue;
        printf("%-26s %4.3g", kind->name, series_noise[noise]);
        for (int k = 0; k < LENGTHS; k++) print_cell(kind, &c[k]);
        print_words(&c[LENGTHS - 2]);
        printf("\n");
    }
}

/* Kinds with a cell of more than 1 % sure errors, and the time of a classification. */
static void print_summary(trend_cell (*cell)[CELLS])
{
    int kinds = 0, outside = 0, missed = 0;
    double seconds = 0.0, count = 0.0, slowest = 0.0;
    for (int i = 0; i < series_kind_count + shape_kind_count; i++) {
        int unsure = 0, present = 0;
        for (int k = 0; k < CELLS; k++) {
            const trend_cell *const c = &cell[i][k];
            unsure |= 100 * c->sure > c->count;
            present |= c->count > 0;
            outside += c->outside;
            seconds += c->seconds;
            count += c->count;
            if (c->count) slowest = fmax(slowest, c->seconds / c->count);
        }
        kinds += present;
        missed += unsure;
        if (unsure) printf("more than 1 %% sure errors: %s\n", kind_of(i)->name);
    }
    printf("%d of %d kinds with more than 1 %% sure errors; %d levels beside a rate; "
           "%.0f us for a classification, %.0f in the slowest cell\n",
           missed, kinds, outside, 1e6 * seconds / count, 1e6 * slowest);
}

int trend_matrix_print(int argc, char **argv)
{
    const int count = argc > 0 ? atoi(argv[0]) : 200;
    const char *const name = argc > 1 ? argv[1] : "";
    const long jobs = argc > 2 ? atol(argv[2]) : sysconf(_SC_NPROCESSORS_ONLN);
    trend_cell(*cell)[CELLS] = mmap(NULL, MAX_KINDS * sizeof *cell, PROT_READ | PROT_WRITE,
                                    MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (cell == MAP_FAILED || count < 1) return 2;
    for (int job = 0; job < (int)jobs; job++)
        if (fork() == 0) {
            fill_share(cell, job, (int)jobs, count, name);
            _exit(0);
        }
    int status, failed = 0;
    while (wait(&status) > 0) failed |= status;
    printf("%-26s %4s", "right/wrong/sure, %", "");
    for (int k = 0; k < LENGTHS; k++) printf(" %14d", lengths[k]);
    printf("\n");
    for (int i = 0; i < series_kind_count + shape_kind_count; i++) print_rows(kind_of(i), cell[i]);
    print_summary(cell);
    return failed != 0;
}
