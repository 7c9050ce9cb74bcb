/* report_rows.c - columns of a run as curves over t.
 *
 * Rows are read once, and may be many: they are put into bins, and when all bins are full, each two
 * neighbours become one.  Of a bin its least and its greatest value are drawn, in their order.
 *
 * Of many more steps than rows the rows show what happens to be at them: then a band has the least
 * and the greatest value of all steps, and another figure the last steps themselves. */
#include "report_rows.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A curve that turns oftener than this is a block, and drawn as a band.  A line shows a turn with
 * that many rows at least, and a band has that many turns in each of its pieces. */
enum { MAX_TURNS = 80, TURN_ROWS = 4, BAND_TURNS = 4 };

/* ---- bins ---------------------------------------------------------------------------------- */

static void join_bins(row_bin *bin, const row_bin *next)
{
    bin->rows += next->rows;
    if (next->low[1] < bin->low[1]) memcpy(bin->low, next->low, sizeof bin->low);
    if (next->high[1] > bin->high[1]) memcpy(bin->high, next->high, sizeof bin->high);
}

static void halve_bins(row_series *s)
{
    for (int i = 0; i < ROW_BINS / 2; i++) {
        s->bin[i] = s->bin[2 * i];
        join_bins(&s->bin[i], &s->bin[2 * i + 1]);
    }
    s->bins = ROW_BINS / 2;
    s->rows_of_bin *= 2;
}

void row_series_add(row_series *s, double t, double x)
{
    if (!isfinite(t) || !isfinite(x)) return;
    const double change = x - s->last;
    if (s->rows > 0 && change != 0.0) {
        s->turns += change * s->rise < 0.0;
        s->rise = copysign(1.0, change);
    }
    s->last = x;
    s->end = t;
    s->rows++;
    if (s->rows_of_bin == 0) s->rows_of_bin = 1;
    const row_bin row = {1, t, {t, x}, {t, x}};
    if (s->bins > 0 && s->bin[s->bins - 1].rows < s->rows_of_bin) {
        join_bins(&s->bin[s->bins - 1], &row);
        return;
    }
    if (s->bins == ROW_BINS) halve_bins(s);
    s->bin[s->bins++] = row;
}

/* ---- curves -------------------------------------------------------------------------------- */

/* The pieces of a band hold several turns each; it ends where the rows end. */
static void draw_band(const row_series *s, const report_plot *plot, plot_curve *curve)
{
    const int pieces = (int)fmax(1.0, fmin(s->bins, (double)s->turns / BAND_TURNS));
    curve->is_band = true;
    for (int i = 0; i < pieces; i++) {
        const int first = i * s->bins / pieces, next = (i + 1) * s->bins / pieces;
        const double end = next < s->bins ? s->bin[next].begin : s->end;
        row_bin piece = s->bin[first];
        for (int k = first + 1; k < next; k++) join_bins(&piece, &s->bin[k]);
        if (i == 0) report_band(plot, curve, piece.begin, piece.low[1], piece.high[1]);
        report_band(plot, curve, 0.5 * (piece.begin + end), piece.low[1], piece.high[1]);
        if (i == pieces - 1) report_band(plot, curve, end, piece.low[1], piece.high[1]);
    }
}

void row_series_draw(const row_series *s, const report_plot *plot, plot_curve *curve,
                     bool is_sparse)
{
    if (s->turns > MAX_TURNS && s->rows > ROW_BINS) {
        draw_band(s, plot, curve);
        return;
    }
    curve->has_dots = is_sparse || row_series_is_aliased(s);
    for (int i = 0; i < s->bins; i++) {
        const row_bin *bin = &s->bin[i];
        const bool falls = bin->high[0] < bin->low[0];
        const double *first = falls ? bin->high : bin->low, *second = falls ? bin->low : bin->high;
        report_point(plot, curve, first[0], first[1]);
        if (second[0] > first[0]) report_point(plot, curve, second[0], second[1]);
    }
}

bool row_series_is_aliased(const row_series *s) { return TURN_ROWS * s->turns > s->rows; }

/* ---- all steps ----------------------------------------------------------------------------- */

int row_steps_read(row_steps *s, const run_directory *dir, int coordinates, int observables)
{
    bool found = false;
    *s = (row_steps){.record = record_of(coordinates, 2 * coordinates, observables)};
    if (observables < 1) return CLI_DONE;
    s->statistics = cli_calloc((size_t)observables, sizeof *s->statistics);
    const observed_steps observed = {s->statistics, observables, &s->record, NULL};
    const int status = checkpoint_read_observed(dir, &observed, &found);
    if (!found) row_steps_free(s);
    return status;
}

void row_steps_free(row_steps *s)
{
    free(s->statistics);
    s->statistics = NULL;
    record_free(&s->record);
}

static void note_steps(plot_curve *curve, long long steps)
{
    curve->is_band = true;
    snprintf(curve->note, sizeof curve->note, " (%.3g steps)", (double)steps);
}

bool row_steps_draw_coordinate(const row_steps *s, int coordinate, const report_plot *plot,
                               plot_curve *curve)
{
    const step_record *r = &s->record;
    const int blocks = r->number ? record_blocks(r) : 0;
    if (blocks < 2) return false;
    /* The last block is not full, and drawn with the one before it. */
    const double last = record_value(r, 0, record_last_steps(r) - 1);
    const step_block open = record_block(r, blocks - 1);
    for (int b = 0; b < blocks - 1; b++) {
        const step_block at = record_block(r, b);
        const bool is_last = b == blocks - 2;
        const double end = is_last ? last : record_block(r, b + 1).from;
        double low = at.low[coordinate], high = at.high[coordinate];
        if (is_last) low = fmin(low, open.low[coordinate]);
        if (is_last) high = fmax(high, open.high[coordinate]);
        if (!isfinite(low) || !isfinite(high)) continue;
        if (b == 0) report_band(plot, curve, at.from, low, high);
        report_band(plot, curve, 0.5 * (at.from + end), low, high);
        if (is_last) report_band(plot, curve, end, low, high);
    }
    note_steps(curve, record_steps_added(r));
    return true;
}

bool row_steps_draw_observable(const row_steps *s, int observable, double less, long long rows,
                               const report_plot *plot, plot_curve *curve)
{
    const dal_statistics *x = s->statistics ? &s->statistics[observable] : NULL;
    if (!x || x->blocks < 2 || x->count <= 4 * rows) return false;
    for (long long k = 0; k < x->blocks; k++) {
        const double low = x->block[k].min - less, high = x->block[k].max - less;
        if (k == 0) report_band(plot, curve, x->from, low, high);
        report_band(plot, curve, x->block[k].t, low, high);
        if (k == x->blocks - 1) report_band(plot, curve, x->to, low, high);
    }
    note_steps(curve, x->count);
    return true;
}

double row_steps_draw_drift(const row_steps *s, int observable, const report_plot *plot,
                            plot_curve *curve)
{
    const dal_statistics *x = s->statistics ? &s->statistics[observable] : NULL;
    const double end = x ? dal_statistics_deviation(x) : 0.0;
    double drift = 0.0;
    for (long long k = 0; x && curve && k < x->blocks; k++) {
        const dal_statistics_block *b = &x->block[k];
        drift = fmax(drift, fmax(fabs(b->min - x->first), fabs(b->max - x->first)));
        report_point(plot, curve, fabs(b->t - x->from), drift);
    }
    if (x && curve) report_point(plot, curve, fabs(x->to - x->from), end);
    return end;
}

void row_steps_draw_last(const row_steps *s, int column, double less, const report_plot *plot,
                         plot_curve *curve)
{
    const int count = record_last_steps(&s->record);
    for (int k = 0; k < count; k++)
        report_point(plot, curve, record_value(&s->record, 0, k),
                     record_value(&s->record, column, k) - less);
}

/* ---- distances ----------------------------------------------------------------------------- */

void row_distance_add(row_distance *d, double t, double q, double v)
{
    if (d->has_row) {
        d->moved += fabs(q - d->q);
        d->travelled += 0.5 * (fabs(d->v) + fabs(v)) * (t - d->t);
    }
    *d = (row_distance){true, t, q, v, d->moved, d->travelled, fmax(d->max_abs, fabs(q))};
}

/* Rows a period apart, say, seem to be at rest; roundings do not count. */
bool row_distance_is_sparse(const row_distance *d)
{
    return d->travelled > 2.0 * d->moved + 0.05 * d->max_abs;
}
