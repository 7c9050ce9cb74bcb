/* trend_change.c - the line after a change, and the bend of a whole series.
 *
 * The likeliest change f of those that settle is fitted to the means y_m of the bins beside a line,
 *
 *     y = a + r s + b f(s; p),    f = tanh((s - c)/w), or -e^(-s/tau), or two of the latter,
 *
 * with p by golden sections.  The late segment begins where f is within 1e-3 of its end, at c + 4 w
 * or 7 tau, half a bin later.  Its line by least squares, or, where it is short, r beside f and its
 * derivatives in p, is the rate of the series after the change, with the interval
 *
 *     r -+ t(n/i - k) sqrt((S + n e^2)/(n - k)/S_ss i),
 *
 * i the inflation of residues that are correlated, e the error of the means or 3e-4 b.
 *
 *     level         0 lies in the interval, the drift that it admits in the late segment is at most
 *                   half of b, and the change is visible beside what else the values do
 *     beside line   0 lies outside, the late segment is long and straight, and the line is there
 *                   before the change, too */
#include "statistics/trend_change.h"
#include "statistics/statistics.h"
#include <math.h>
#include <string.h>

enum { BINS = DAL__BINS, MAX_COLUMNS = 6, MIN_LATE = 6, LONG_LATE = 12, MIN_EARLY = 4, GOLDEN = 9 };
enum { START = 2 }; /* blocks that may contain more than a relaxation */

static const double step_widths = 4.0, time_constants = 7.0;
static const double shape_misfit = 3e-4; /* of b */
static const double admitted = 0.5, surely_admitted = 0.04, min_late = 0.2;
/* Of what the change shows: ranges of residues outside of it, of any bin. */
static const double outside_residue = 0.5, any_residue = 0.3;
/* Deviations within blocks before and after the change that make it no level. */
static const double other_noise = 1.7, min_after = 0.07, min_before = 0.25;
static const double excursion = 0.5, per_median = 3.0;
/* Of the rate of a line beside a change. */
static const double line_margin = 0.3, line_bend = 0.2, line_residue = 0.1, line_before = 0.15,
                    line_share = 0.02, line_opposite = 0.3;

typedef double column[BINS];

typedef struct change_shape {
    enum { STEP, RELAXATION, TWO_RELAXATIONS } kind;
    double p[2]; /* c, w; tau; both tau */
} change_shape;

static double place(int m) { return (m + 0.5) / BINS; }

/* ---- least squares ---- */

typedef struct fit {
    int bins, columns;
    column residue;
    double square, product; /* of residues, of neighbouring ones */
    double last, squares;   /* of the last column: its size, its square beside the others */
} fit;

static double product_from(const double *a, const double *b, int from, int to)
{
    double sum = 0.0;
    for (int m = from; m < to; m++) sum += a[m] * b[m];
    return sum;
}

/* Fits the columns, which are overwritten, to y in bins from .. to - 1, by Gram and Schmidt. */
static fit fit_columns(const double *y, column *c, int columns, int from, int to)
{
    fit f = {.bins = to - from, .columns = columns};
    memcpy(f.residue, y, sizeof f.residue);
    for (int k = 0; k < columns; k++) {
        const double whole = product_from(c[k], c[k], from, to);
        for (int l = 0; l < 2 * k; l++) { /* twice is enough */
            const double *const q = c[l % k];
            const double component = product_from(c[k], q, from, to);
            for (int m = from; m < to; m++) c[k][m] -= component * q[m];
        }
        f.squares = product_from(c[k], c[k], from, to);
        f.last = 0.0;
        if (!(f.squares > 1e-20 * whole)) { /* nothing new */
            memset(c[k], 0, sizeof c[k]);
            continue;
        }
        f.last = product_from(c[k], f.residue, from, to) / f.squares;
        const double size = 1.0 / sqrt(f.squares);
        for (int m = from; m < to; m++) {
            f.residue[m] -= f.last * c[k][m];
            c[k][m] *= size;
        }
    }
    f.square = product_from(f.residue, f.residue, from, to);
    f.product = product_from(f.residue, f.residue + 1, from, to - 1);
    return f;
}

/* How many times fewer independent values the residues are worth. */
static double inflation_of(const fit *f)
{
    return f->square > 0.0 ? dal__inflation(f->square, f->product, f->bins) : 1.0;
}

/* Half the width of the interval of the last column; error: of the means of bins. */
static double margin_of(const fit *f, double error, double i)
{
    const int n = f->bins, free = n - f->columns;
    if (free < 1 || !(f->squares > 0.0)) return INFINITY;
    return dal__student(n / i - f->columns) *
           sqrt((f->square + n * error * error) / free / f->squares * i);
}

static void fill_powers(column *c, int count)
{
    for (int m = 0; m < BINS; m++)
        for (int k = 0; k < count; k++) c[k][m] = k ? c[k - 1][m] * place(m) : 1.0;
}

static fit fit_line(const double *y, int from, int to)
{
    column c[2];
    fill_powers(c, 2);
    return fit_columns(y, c, 2, from, to);
}

/* From a bin to the last. */
static fit fit_parabola(const double *y, int from)
{
    column c[3];
    fill_powers(c, 3);
    return fit_columns(y, c, 3, from, BINS);
}

dal__interval dal__trend_bend(const dal__bins *b)
{
    const fit f = fit_parabola(b->mean, 0);
    const double bend = 2.0 * f.last,
                 margin = 2.0 * margin_of(&f, fmax(b->error, b->rounding), inflation_of(&f));
    return (dal__interval){bend - margin, bend, bend + margin};
}

dal__interval dal__trend_second_half(const dal__bins *b)
{
    const fit f = fit_line(b->mean, BINS / 2, BINS);
    const double margin = margin_of(&f, fmax(b->error, b->rounding), inflation_of(&f));
    return (dal__interval){f.last - margin, f.last, f.last + margin};
}

/* ---- the shape of a change ---- */

static double log_cosh(double x) { return fabs(x) + log1p(exp(-2.0 * fabs(x))); }

/* The means over bins. */
static void fill_step(double c, double w, double *f)
{
    double before = log_cosh(-c / w);
    for (int m = 0; m < BINS; m++) {
        const double now = log_cosh(((m + 1.0) / BINS - c) / w);
        f[m] = w * BINS * (now - before);
        before = now;
    }
}

static void fill_relaxation(double tau, double *f)
{
    const double ratio = exp(-1.0 / (BINS * tau));
    double now = -tau * BINS * (1.0 - ratio);
    for (int m = 0; m < BINS; m++, now *= ratio) f[m] = now;
}

/* One column, or two. */
static int fill_shape(const change_shape *s, column *f)
{
    if (s->kind == STEP) {
        fill_step(s->p[0], s->p[1], f[0]);
        return 1;
    }
    fill_relaxation(s->p[0], f[0]);
    if (s->kind == RELAXATION) return 1;
    fill_relaxation(s->p[1], f[1]);
    return 2;
}

static double square_of(const double *y, const change_shape *s)
{
    column c[4];
    fill_powers(c, 2);
    return fit_columns(y, c, 2 + fill_shape(s, c + 2), 0, BINS).square;
}

/* The place of least squares of one parameter. */
static void refine(const double *y, change_shape *s, int which, double low, double high)
{
    const double golden = 0.6180339887498949;
    double *const p = &s->p[which];
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = (*p = a, square_of(y, s)), at_b = (*p = b, square_of(y, s));
    for (int i = 0; i < GOLDEN; i++) {
        const bool is_lower = at_a < at_b;
        if (is_lower) {
            high = b, b = a, at_b = at_a;
            a = *p = high - golden * (high - low);
        } else {
            low = a, a = b, at_a = at_b;
            b = *p = low + golden * (high - low);
        }
        *(is_lower ? &at_a : &at_b) = square_of(y, s);
    }
    *p = 0.5 * (low + high);
}

/* The likeliest of the changes that settle. */
static change_shape likeliest(const dal__evidence *e)
{
    int best = -1, pair = -1;
    for (int i = 0; i < DAL__PLAIN_SHAPES; i++)
        if (dal__shape_list[i].meaning == DAL__MEANS_SETTLES &&
            (best < 0 || e->shape[i] > e->shape[best]))
            best = i;
    for (int i = 0; i < DAL__PAIRS; i++)
        if (dal__pair_list[i].meaning == DAL__MEANS_SETTLES &&
            (pair < 0 || e->pair[i] > e->pair[pair]))
            pair = i;
    const dal__shape *const s = &dal__shape_list[best];
    if (e->pair[pair] > e->shape[best]) {
        const dal__pair *const two = &dal__pair_list[pair];
        const double tau = dal__shape_list[two->first].parameter;
        if (two->second == DAL__LINEAR_SHAPE) return (change_shape){RELAXATION, {tau, 0.0}};
        return (change_shape){TWO_RELAXATIONS, {tau, dal__shape_list[two->second].parameter}};
    }
    return s->width > 0.0 ? (change_shape){STEP, {s->parameter, s->width}}
                          : (change_shape){RELAXATION, {s->parameter, 0.0}};
}

/* ---- the line after it ---- */

typedef struct outcome {
    const dal__trend_series *series;
    const double *y;
    change_shape shape;
    double size, shown; /* b; the range of b f over bins */
    double begins, ends;
    int early, late;  /* bins before and from where nothing of the change is seen */
    column residue;   /* of all bins, */
    double inflation; /* and what they are worth */
    double rate, margin;
} outcome;

static void measure_size(outcome *o)
{
    column c[4], f[2];
    const int shapes = fill_shape(&o->shape, f);
    fill_powers(c, 2);
    memcpy(c + 2, f, sizeof f);
    const fit whole = fit_columns(o->y, c, 2 + shapes, 0, BINS);
    double low = INFINITY, high = -INFINITY, first = 0.0;
    if (shapes == 2) { /* the size of the first, beside the second */
        fill_powers(c, 2);
        memcpy(c[2], f[1], sizeof f[1]);
        memcpy(c[3], f[0], sizeof f[0]);
        first = fit_columns(o->y, c, 4, 0, BINS).last;
    }
    memcpy(o->residue, whole.residue, sizeof o->residue);
    o->inflation = inflation_of(&whole);
    for (int m = 0; m < BINS; m++) {
        const double x = whole.last * f[shapes - 1][m] + first * f[0][m];
        low = fmin(low, x);
        high = fmax(high, x);
    }
    o->size = whole.last + first;
    o->shown = high - low;
}

/* The columns of the change and of its derivatives, then the line. */
static fit fit_beside_change(const outcome *o)
{
    column c[MAX_COLUMNS], up[2], down[2];
    const double step = 1e-3;
    const int parameters = o->shape.kind == RELAXATION ? 1 : 2;
    int n = 1;
    fill_powers(c, 1);
    n += fill_shape(&o->shape, c + 1);
    for (int i = 0; i < parameters; i++, n++) {
        change_shape high = o->shape, low = o->shape;
        high.p[i] *= 1.0 + step;
        low.p[i] *= 1.0 - step;
        fill_shape(&high, up);
        fill_shape(&low, down);
        const int which = o->shape.kind == TWO_RELAXATIONS ? i : 0;
        for (int m = 0; m < BINS; m++) c[n][m] = (up[which][m] - down[which][m]) / (2.0 * step);
    }
    for (int m = 0; m < BINS; m++) c[n][m] = place(m);
    return fit_columns(o->y, c, n + 1, 0, BINS);
}

static void measure_rate(outcome *o, const dal__bins *b)
{
    const double error = fmax(fmax(b->error, b->rounding), shape_misfit * fabs(o->size));
    const fit f = BINS - o->late >= MIN_LATE ? fit_line(o->y, o->late, BINS) : fit_beside_change(o);
    o->rate = f.last;
    /* All bins know the correlation better than the late ones, where the shape fits. */
    o->margin = margin_of(&f, error, fmin(inflation_of(&f), o->inflation));
}

/* ---- what it is ---- */

/* Of x, which is sorted. */
static double median(double *x, int n)
{
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && x[k] < x[k - 1]; k--) {
            const double low = x[k];
            x[k] = x[k - 1];
            x[k - 1] = low;
        }
    return n > 0 ? 0.5 * (x[(n - 1) / 2] + x[n / 2]) : 0.0;
}

static bool residues_are_small(const outcome *o)
{
    double low = INFINITY, high = -INFINITY;
    for (int m = 0; m < BINS; m++) {
        if (fabs(o->residue[m]) > any_residue * o->shown) return false;
        if (m >= o->early && m < o->late) continue;
        low = fmin(low, o->residue[m]);
        high = fmax(high, o->residue[m]);
    }
    return high - low <= outside_residue * o->shown;
}

/* Within blocks, before and after the change, or during a relaxation and after it: the deviation is
 * about the same, and no values are far outside all others. */
static bool blocks_are_alike(const outcome *o)
{
    const dal__trend_series *const s = o->series;
    double own[2][DAL_STATISTICS_BLOCKS], far[DAL_STATISTICS_BLOCKS], farthest = 0.0;
    int count[2] = {0}, all = 0;
    for (int i = 0; i < s->count; i++) {
        const double from = (double)i / s->count, to = (i + 1.0) / s->count;
        if (o->shape.kind != STEP && i >= START && from < o->ends) own[0][count[0]++] = s->own[i];
        if (to > o->begins && from < o->ends) continue;
        const int after = from >= o->ends;
        own[after][count[after]++] = s->own[i];
        far[all] = fmax(s->max[i] - s->mean[i], s->mean[i] - s->min[i]);
        farthest = fmax(farthest, far[all++]);
    }
    if (farthest > excursion * o->shown && farthest > per_median * median(far, all)) return false;
    const double before = median(own[0], count[0]), after = median(own[1], count[1]);
    if (count[0] < 3 || count[1] < 3) return true;
    if (after > other_noise * before && after > min_after * o->shown) return false;
    return !(before > other_noise * after && before > min_before * o->shown);
}

/* The drift that the interval admits in the late segment, in units of the change. */
static double admitted_drift(const outcome *o)
{
    return (fabs(o->rate) + o->margin) * fmax(1.0 - o->ends, min_late) / o->shown;
}

static bool is_beside_line(const outcome *o)
{
    const int late = BINS - o->late;
    const double r = fabs(o->rate);
    if (late < LONG_LATE || o->margin > line_margin * r || r < line_share * fabs(o->size))
        return false;
    const fit parabola = fit_parabola(o->y, o->late), line = fit_line(o->y, o->late, BINS);
    const double bend = 2.0 * fabs(parabola.last) * late / BINS;
    if (bend > line_bend * r || sqrt(line.square / late) > line_residue * r) return false;
    if (o->size * o->rate < 0.0 && fabs(o->size) > line_opposite * r) return false;
    if (o->early < MIN_EARLY) return true;
    return fabs(fit_line(o->y, 0, o->early).last - o->rate) < line_before * r;
}

dal__change dal__trend_change(const dal__trend_series *s, const dal__bins *b,
                              const dal__evidence *e)
{
    outcome o = {.series = s, .y = b->mean, .shape = likeliest(e)};
    const double *const p = o.shape.p;
    const bool is_step = o.shape.kind == STEP;
    for (int i = 0; i < 2; i++) {
        const double at = p[0], second = p[1];
        refine(o.y, &o.shape, 0, is_step ? at - 0.03 : 0.6 * at, is_step ? at + 0.03 : 1.7 * at);
        if (o.shape.kind == RELAXATION) continue;
        refine(o.y, &o.shape, 1, (is_step ? 0.4 : 0.6) * second, (is_step ? 2.0 : 1.7) * second);
    }
    o.begins = is_step ? p[0] - step_widths * p[1] : 0.0;
    o.ends = is_step ? p[0] + step_widths * p[1] : time_constants * fmax(p[0], p[1]);
    o.early = (int)fmax(floor(o.begins * BINS - 0.5), 0.0);
    o.late = (int)fmin(ceil(o.ends * BINS + 0.5), BINS);
    measure_size(&o);
    measure_rate(&o, b);
    dal__change change = {.rate = {o.rate - o.margin, o.rate, o.rate + o.margin}};
    if (fabs(o.rate) <= o.margin && admitted_drift(&o) <= admitted && residues_are_small(&o) &&
        blocks_are_alike(&o))
        change.result = DAL__CHANGE_TO_LEVEL;
    else if (is_beside_line(&o))
        change.result = DAL__CHANGE_BESIDE_LINE;
    change.is_sure = BINS - o.late >= MIN_LATE && admitted_drift(&o) <= surely_admitted;
    return change;
}
