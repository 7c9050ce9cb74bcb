/* fit.c - trends and tones of a series, by orthogonal projection.
 *
 * Each new column loses its part along those before it, and the residue its part along the column;
 * what a column would save of the sum of squares is the square of that part.  Parameters that do
 * not enter linearly (frequencies, powers, rates) are sought on a grid and by golden section. */
#include "measure/fit.h"
#include <math.h>
#include <string.h>

enum {
    TONES = 3,
    ROUNDS = 2,      /* of tuning them */
    FREQUENCIES = 4, /* of the grid, to one period in all the time */
    COLUMNS = 4 + 2 * TONES,
    SECTIONS = 12, /* golden ones: 0.618^12 = 1/300 */
    NEAR = 2       /* blocks on either side that lend their range */
};

static const double price = 4.0;        /* of a number, beside log N */
static const double exactness = 1e-3;   /* of w: less is not noise but the explanation */
static const double slowest_tone = 2.5; /* periods in all the time */

static const double pi = 3.14159265358979323846;

typedef dal__series series;

/* An explanation under way: what it left, and the columns it used. */
typedef struct fit {
    const series *s;
    int columns, numbers, tones;
    double tone[TONES];     /* frequencies */
    double parameter, size; /* of the trend */
    double residue[DAL_BLOCKS], column[COLUMNS][DAL_BLOCKS];
} fit;

typedef double shape(double t, double parameter);

static double power(double t, double p) { return pow(t, p); }
/* By exp(2^k) in all the time. */
static double growth(double t, double k) { return exp(exp2(k) * (t - 1.0)); }
static double decay(double t, double k) { return exp(-exp2(k) * t); }
/* Slope 1 at the beginning and 2^r at the end. */
static double bent(double t, double r) { return t + 0.5 * (exp2(r) - 1.0) * t * t; }
static double line(double t, double unused) { return (void)unused, t; }
static double constant(double t, double unused) { return (void)t, (void)unused, 1.0; }
static double cosine(double t, double f) { return cos(2.0 * pi * f * t); }
static double sine(double t, double f) { return sin(2.0 * pi * f * t); }

/* ---- projection ---- */

static double dot(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void subtract(double *a, double part, const double *b, int n)
{
    for (int i = 0; i < n; i++) a[i] -= part * b[i];
}

/* Leaves of a column what is new to the fit and to one more column (or NULL), of length one; 0 when
 * nothing of it is. */
static int keep_new(const fit *f, const double *more, double *column)
{
    const int n = f->s->n;
    const double whole = dot(column, column, n);
    for (int k = 0; k < f->columns; k++)
        subtract(column, dot(column, f->column[k], n), f->column[k], n);
    if (more) subtract(column, dot(column, more, n), more, n);
    const double square = dot(column, column, n);
    if (!(square > 1e-12 * whole)) return 0;
    const double scale = 1.0 / sqrt(square);
    for (int i = 0; i < n; i++) column[i] *= scale;
    return 1;
}

static int fresh(const fit *f, shape *form, double parameter, double *column)
{
    const series *s = f->s;
    for (int i = 0; i < s->n; i++) column[i] = form(s->t[i], parameter) / s->w[i];
    return keep_new(f, NULL, column);
}

/* What taking a shape would save of the sum of squares. */
static double gain(const fit *f, shape *form, double parameter)
{
    double column[DAL_BLOCKS];
    if (!fresh(f, form, parameter, column)) return 0.0;
    const double part = dot(column, f->residue, f->s->n);
    return part * part;
}

static void take(fit *f, shape *form, double parameter)
{
    double *column = f->column[f->columns];
    if (!fresh(f, form, parameter, column)) return;
    subtract(f->residue, dot(column, f->residue, f->s->n), column, f->s->n);
    f->columns++;
}

/* Both columns of a tone, turned on from block to block. */
static void fill_tone(const series *s, double frequency, double *a, double *b)
{
    const double angle = 2.0 * pi * frequency, turn = angle / s->n;
    const double c = cos(turn), d = sin(turn);
    double x = cos(angle * s->t[0]), y = sin(angle * s->t[0]);
    for (int i = 0; i < s->n; i++) {
        const double next = c * x - d * y;
        a[i] = x / s->w[i];
        b[i] = y / s->w[i];
        y = d * x + c * y;
        x = next;
    }
}

static double tone_gain(const fit *f, shape *unused, double frequency)
{
    double a[DAL_BLOCKS], b[DAL_BLOCKS];
    (void)unused;
    fill_tone(f->s, frequency, a, b);
    if (!keep_new(f, NULL, a)) return 0.0;
    const double in_phase = dot(a, f->residue, f->s->n);
    if (!keep_new(f, a, b)) return in_phase * in_phase;
    const double beside = dot(b, f->residue, f->s->n);
    return in_phase * in_phase + beside * beside;
}

/* The parameter in low..high of greatest gain: on a grid, then by golden section about its best. */
static double best(const fit *f, double (*worth)(const fit *, shape *, double), shape *form,
                   double low, double high, int points)
{
    const double step = (high - low) / points, ratio = 0.5 * (sqrt(5.0) - 1.0);
    double place = low, most = -1.0;
    for (int i = 0; i <= points; i++) {
        const double value = worth(f, form, low + i * step);
        if (value > most) {
            most = value;
            place = low + i * step;
        }
    }
    double a = fmax(place - step, low), b = fmin(place + step, high);
    double c = b - ratio * (b - a), d = a + ratio * (b - a);
    double at_c = worth(f, form, c), at_d = worth(f, form, d);
    for (int i = 0; i < SECTIONS; i++) {
        if (at_c > at_d) {
            b = d, d = c, at_d = at_c;
            at_c = worth(f, form, c = b - ratio * (b - a));
        } else {
            a = c, c = d, at_c = at_d;
            at_d = worth(f, form, d = a + ratio * (b - a));
        }
    }
    const double middle = at_c > at_d ? c : d;
    return fmax(at_c, at_d) > most ? middle : place;
}

/* ---- the series ---- */

static void read_range(series *s, const dal_mean *block, int i, double least_range)
{
    double low = INFINITY, high = -INFINITY;
    const int middle = i < NEAR ? NEAR : i > s->n - 1 - NEAR ? s->n - 1 - NEAR : i;
    for (int k = middle - NEAR; k <= middle + NEAR; k++) {
        low = fmin(low, block[k].least);
        high = fmax(high, block[k].most);
    }
    s->w[i] = fmax(high - low, least_range);
    s->x[i] = block[i].x / s->w[i];
    s->logs += log(s->w[i]);
}

dal__series dal__series_of(const dal_mean *block, int n, double least_range)
{
    series s = {.n = n};
    for (int i = 0; i < n; i++) {
        s.t[i] = (i + 0.5) / n;
        read_range(&s, block, i, least_range);
    }
    return s;
}

/* ---- the weight of an explanation ---- */

double dal__criterion(const series *s, double squares, int numbers)
{
    const double n = s->n, variance = fmax(squares / n, exactness * exactness);
    return n * log(variance) + 2.0 * s->logs + numbers * (log(n) + price);
}

static double criterion_of(const fit *f)
{
    return dal__criterion(f->s, dot(f->residue, f->residue, f->s->n), f->numbers);
}

/* ---- tones ---- */

/* The frequency of the greatest Fourier coefficient of the residue, by Goertzel's recurrence; the
 * middles of the blocks lie equally apart. */
static double loudest(const fit *f)
{
    const series *s = f->s;
    double most = -1.0, place = slowest_tone;
    for (double v = slowest_tone; v < 0.5 * s->n; v += 1.0 / FREQUENCIES) {
        const double c = 2.0 * cos(2.0 * pi * v / s->n);
        double a = 0.0, b = 0.0;
        for (int i = 0; i < s->n; i++) {
            const double next = f->residue[i] / s->w[i] + c * a - b;
            b = a;
            a = next;
        }
        const double square = a * a + b * b - c * a * b;
        if (square > most) {
            most = square;
            place = v;
        }
    }
    return place;
}

static void take_tone(fit *f, double frequency)
{
    take(f, cosine, frequency);
    take(f, sine, frequency);
    f->numbers += 3;
    f->tone[f->tones++] = frequency;
}

/* base with all tones of f but the one at k. */
static fit without(const fit *base, const fit *f, int k)
{
    fit others = *base;
    for (int i = 0; i < f->tones; i++)
        if (i != k) take_tone(&others, f->tone[i]);
    return others;
}

static double tune(const fit *f, double near)
{
    const double width = 0.5 / FREQUENCIES;
    return best(f, tone_gain, cosine, near - width, near + width, 2);
}

/* Tones hide one another: each is tuned again beside the others (Li, Stoica 1996,
 * DOI 10.1109/78.485923). */
static void retune(const fit *base, fit *f)
{
    for (int i = 0; f->tones > 1 && i < ROUNDS * f->tones; i++) {
        fit others = without(base, f, 0);
        take_tone(&others, tune(&others, f->tone[0]));
        *f = others;
    }
}

/* Whether a tone near a frequency of the grid may be worth its numbers; tuning it at most doubles
 * what it saves there. */
static int is_worth_tuning(const fit *f, double frequency)
{
    const double squares = dot(f->residue, f->residue, f->s->n);
    const double saved = fmin(2.0 * tone_gain(f, cosine, frequency), squares);
    return dal__criterion(f->s, squares - saved, f->numbers + 3) < criterion_of(f);
}

/* Takes tones as long as each is worth its three numbers. */
static void take_tones(fit *f)
{
    const fit base = *f;
    for (int i = 0; i < TONES; i++) {
        const double near = loudest(f);
        if (!is_worth_tuning(f, near)) return;
        fit more = *f;
        take_tone(&more, tune(&more, near));
        retune(&base, &more);
        if (criterion_of(&more) >= criterion_of(f)) return;
        *f = more;
    }
}

/* ---- trends ---- */

static fit begin_fit(const series *s)
{
    fit f = {.s = s, .numbers = 2}; /* the constant, and the size of the noise */
    memcpy(f.residue, s->x, sizeof f.residue);
    take(&f, constant, 0.0);
    return f;
}

typedef double worth(const fit *, shape *, double);

static const struct {
    worth *worth;
    shape *form;
    double low, high;
    int points, numbers;
} trends[] = {
#define X(name, worth, form, low, high, points, numbers) {worth, form, low, high, points, numbers},
    DAL__TREND_LIST(X)
#undef X
};

/* Takes a trend and remembers its parameter and its size. */
static void take_trend(fit *f, dal__trend i)
{
    if (trends[i].points > 0)
        f->parameter = best(f, trends[i].worth, trends[i].form, trends[i].low, trends[i].high,
                            trends[i].points);
    f->size = sqrt(trends[i].worth(f, trends[i].form, f->parameter) / f->s->n);
    take(f, trends[i].form, f->parameter);
    if (i == DAL__TREND_SLOW) take(f, sine, f->parameter);
    f->numbers += trends[i].numbers;
}

/* The trend first, then the tones about it, then the trend that is best beside those tones. */
dal__explanation dal__fit_trend(const dal__series *s, dal__trend trend)
{
    fit f = begin_fit(s);
    take_trend(&f, trend);
    take_tones(&f);
    if (f.tones > 0) {
        const fit rough = f;
        f = begin_fit(s);
        for (int k = 0; k < rough.tones; k++) take_tone(&f, rough.tone[k]);
        take_trend(&f, trend);
    }
    return (dal__explanation){criterion_of(&f), f.parameter, f.size};
}
