/* ensemble_statistics.c - moments, quantiles, covariance and failures of an ensemble, from what is
 * on the disk.
 *
 * One column at one time is read at once: 8 bytes for each member and thread. */
#include "ensemble_statistics.h"
#include "dalembert_program.h"
#include "io/csv_cells.h"
#include "io/file.h"
#include "io/file_output.h"
#include "run/pool.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"
#include "ui/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 40, CLOUD = 2000, ROWS = 1024 /* rows read at a time */ };

/* A component of the state at one time. */
typedef struct component {
    dal_spread spread;
    double quantile[ENSEMBLE_QUANTILES];
    long long bin[BINS];
} component;

typedef struct statistics {
    const ensemble *e;
    const ensemble_directory *dir;
    component *component; /* [times * columns] */
    double *covariance;   /* [times * columns * columns] */
    int status;
} statistics;

/* ---- reading ---- */

/* Rows of the table of a time. */
static int read_states(const statistics *s, int time, long long first, long long count,
                       double *rows)
{
    const npy_table *table = s->dir->has_rows ? &s->dir->rows : &s->dir->final;
    return npy_table_read(table, (s->dir->has_rows ? time * s->e->members : 0) + first, count,
                          rows);
}

/* Calls use(user, rows, count) for all rows of a time in their order. */
static int for_rows(const statistics *s, int time,
                    void (*use)(void *user, const double *rows, long long count), void *user)
{
    double *rows = cli_calloc(ROWS * (size_t)s->e->columns, sizeof *rows);
    int status = CLI_DONE;
    for (long long first = 0; first < s->e->members && status == CLI_DONE; first += ROWS) {
        const long long rest = s->e->members - first, count = rest < ROWS ? rest : ROWS;
        status = read_states(s, time, first, count, rows);
        if (status == CLI_DONE) use(user, rows, count);
    }
    free(rows);
    return status;
}

typedef struct column_reader {
    int column, columns;
    double *values; /* the finite ones so far */
    long long count;
} column_reader;

static void take_column(void *user, const double *rows, long long count)
{
    column_reader *r = user;
    for (long long i = 0; i < count; i++) {
        const double x = rows[i * r->columns + r->column];
        if (isfinite(x)) r->values[r->count++] = x;
    }
}

typedef struct product_reader {
    const double *mean;
    double *sums;
    int columns;
    long long count;
} product_reader;

static void take_products(void *user, const double *rows, long long count)
{
    product_reader *r = user;
    r->count += dal__add_products(r->columns, r->mean, rows, count, r->sums);
}

/* ---- one component, one covariance ---- */

static void fail_statistics(void *user) { ((statistics *)user)->status = CLI_IO; }

static void count_bins(component *c, const double *values, long long count)
{
    const double width = c->spread.max - c->spread.min;
    for (long long i = 0; i < count; i++) {
        const double place = width > 0.0 ? (values[i] - c->spread.min) / width * BINS : 0.0;
        c->bin[place < BINS ? (int)place : BINS - 1]++;
    }
}

static void measure_component(void *user, int i)
{
    statistics *s = user;
    const ensemble *e = s->e;
    component *c = &s->component[i];
    column_reader r = {i % e->columns, e->columns, cli_malloc((size_t)e->members * sizeof(double)),
                       0};
    const int status = for_rows(s, i / e->columns, take_column, &r);
    if (status == CLI_DONE) {
        dal_spread_measure(&c->spread, r.values, r.count);
        count_bins(c, r.values, r.count);
        dal_measure_quantiles(r.values, r.count, e->quantile, e->quantiles, c->quantile);
    } else {
        pool_exclude(fail_statistics, s);
    }
    free(r.values);
}

static void measure_covariance(void *user, int time)
{
    statistics *s = user;
    const int n = s->e->columns;
    double *sums = s->covariance + (size_t)time * (size_t)n * (size_t)n;
    double *mean = cli_calloc((size_t)n, sizeof *mean);
    for (int i = 0; i < n; i++) mean[i] = s->component[time * n + i].spread.mean;
    product_reader r = {mean, sums, n, 0};
    if (for_rows(s, time, take_products, &r) != CLI_DONE) pool_exclude(fail_statistics, s);
    for (int i = 0; i < n * n; i++) sums[i] = r.count > 1 ? sums[i] / (double)(r.count - 1) : NAN;
    free(mean);
}

/* ---- files ---- */

/* Writes a file with what put writes.  Both return CLI_DONE, or print and return an exit status. */
static int write_table(const statistics *s, const char *path,
                       int (*put)(FILE *out, const statistics *s))
{
    char *text;
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    const int status = put(out, s);
    cli_memstream_close(out);
    const int written = file_replace(path, text, length, FILE_UNSYNCED);
    free(text);
    return status == CLI_DONE ? written : status;
}

/* Time and column of component i. */
static void put_place(FILE *out, const ensemble *e, int i)
{
    csv_put(out, e->time[i / e->columns]);
    fprintf(out, ",%s", e->column[i % e->columns]);
}

static int put_statistics(FILE *out, const statistics *s)
{
    const ensemble *e = s->e;
    fputs("t,column,count,mean,deviation,min", out);
    for (int k = 0; k < e->quantiles; k++) fprintf(out, ",q%g", e->quantile[k]);
    fputs(",max\n", out);
    for (int i = 0; i < e->times * e->columns; i++) {
        const component *c = &s->component[i];
        put_place(out, e, i);
        fprintf(out, ",%lld", c->spread.count);
        const double spread[] = {c->spread.mean, c->spread.deviation, c->spread.min};
        csv_put_cells(out, spread, 3);
        csv_put_cells(out, c->quantile, e->quantiles);
        csv_put_cells(out, &c->spread.max, 1);
        fputc('\n', out);
    }
    return CLI_DONE;
}

static int put_covariance(FILE *out, const statistics *s)
{
    const ensemble *e = s->e;
    fputs("t,column", out);
    for (int i = 0; i < e->columns; i++) fprintf(out, ",%s", e->column[i]);
    fputc('\n', out);
    for (int i = 0; i < e->times * e->columns; i++) {
        put_place(out, e, i);
        csv_put_cells(out, s->covariance + i * e->columns, e->columns);
        fputc('\n', out);
    }
    return CLI_DONE;
}

static int put_histograms(FILE *out, const statistics *s)
{
    const ensemble *e = s->e;
    fputs("t,column,low,high,count\n", out);
    for (int i = 0; i < e->times * e->columns; i++) {
        const component *c = &s->component[i];
        const double min = c->spread.min, width = (c->spread.max - min) / BINS;
        for (int k = 0; k < BINS && c->spread.count > 0; k++) {
            if (width == 0.0 && k > 0) break;
            put_place(out, e, i);
            csv_put_cells(out, (double[]){min + k * width, min + (k + 1) * width}, 2);
            fprintf(out, ",%lld\n", c->bin[k]);
        }
    }
    return CLI_DONE;
}

/* The first members are as good a choice as any: draws do not depend on each other. */
static int put_cloud(FILE *out, const statistics *s)
{
    const ensemble *e = s->e;
    const long long count = e->members < CLOUD ? e->members : CLOUD;
    double *rows = cli_calloc((size_t)count * (size_t)e->columns, sizeof *rows);
    int status = CLI_DONE;
    fprintf(out, "t,member,%s,%s\n", e->column[e->axis[0]], e->column[e->axis[1]]);
    for (int t = 0; t < e->times && status == CLI_DONE; t++) {
        status = read_states(s, t, 0, count, rows);
        for (long long i = 0; i < count && status == CLI_DONE; i++) {
            const double *row = rows + i * e->columns;
            if (!isfinite(row[e->axis[0]])) continue;
            csv_put(out, e->time[t]);
            fprintf(out, ",%lld", i);
            for (int k = 0; k < 2; k++) {
                fputc(',', out);
                csv_put(out, row[e->axis[k]]);
            }
            fputc('\n', out);
        }
    }
    free(rows);
    return status;
}

/* ---- failures ---- */

/* A line of failures.csv; row: the member's in members.npy. */
static void put_failure(FILE *out, const ensemble *e, long long member, const double *row,
                        const char *message)
{
    fprintf(out, "%lld,", member);
    csv_put(out, row[MEMBER_TIME]);
    fputc(',', out);
    csv_put_text(out, dal_status_text((dal_status)row[MEMBER_STATUS]));
    for (int k = MEMBER_DRAWN; k < ensemble_member_columns(e); k++) {
        fputc(',', out);
        csv_put(out, row[k]);
    }
    fputc(',', out);
    csv_put_text(out, message);
    fputc('\n', out);
}

/* Writes the members of a chunk that failed, each with its line of the messages; counts them by
 * their status. */
static int write_chunk_failures(const statistics *s, int chunk, double *rows, FILE *out,
                                long long *counts)
{
    const ensemble *e = s->e;
    const int columns = ensemble_member_columns(e), count = ensemble_chunk_members(e, chunk);
    const long long first = (long long)chunk * ENSEMBLE_CHUNK;
    int status = npy_table_read(&s->dir->members, first, count, rows);
    char *messages = NULL, *message = NULL;
    for (int i = 0; i < count && status == CLI_DONE; i++) {
        const double *row = rows + i * columns, code = row[MEMBER_STATUS];
        if (!(code > 0.0 && code < DAL_STATUS_COUNT)) continue;
        counts[(int)code]++;
        if (!messages) {
            status = ensemble_directory_read_messages(s->dir, chunk, &messages);
            message = messages;
        }
        char *next = message ? strchr(message, '\n') : NULL;
        if (next) *next++ = '\0';
        put_failure(out, e, first + i, row, message ? message : "");
        message = next;
    }
    free(messages);
    return status;
}

static int write_failures(const statistics *s, long long *counts)
{
    const ensemble *e = s->e;
    file_output output;
    int status = file_output_open(&output, s->dir->failures);
    if (status != CLI_DONE) return status;
    FILE *out = output.stream;
    double *rows = ensemble_allocate_rows(e);
    fputs("member,t,reason", out);
    for (int k = 0; k < e->variations; k++) fprintf(out, ",%s", e->vary[k].name);
    fputs(",message\n", out);
    for (int i = 0; i < ensemble_chunks(e) && status == CLI_DONE; i++)
        status = write_chunk_failures(s, i, rows, out, counts);
    free(rows);
    return file_output_close(&output, status);
}

/* ---- all ---- */

/* Returns how many members failed. */
static long long print_failures(const ensemble *e, const long long *counts)
{
    long long failed = 0;
    for (int i = 0; i < DAL_STATUS_COUNT; i++) failed += counts[i];
    if (failed == 0) return 0;
    cli_note("%lld of %lld members failed:", failed, e->members);
    for (int i = 0; i < DAL_STATUS_COUNT; i++)
        if (counts[i]) cli_note("%lld: %s", counts[i], dal_status_text((dal_status)i));
    return failed;
}

/* The last time on a terminal: what differs between members as mean +- deviation, the rest as
 * values. */
static int print_screen(const statistics *s, const long long *counts)
{
    enum { ROWS_SHOWN = 12, CONSTANT_LINES = 2 };
    const ensemble *e = s->e;
    static const char *const heads[] = {"", "mean", "deviation", "from", "to"};
    screen_table t = {.columns = sizeof heads / sizeof *heads};
    char **constant = cli_calloc((size_t)e->columns + 1, sizeof *constant);
    char x[SCREEN_NUMBER], count[SCREEN_NUMBER], method[128];
    long long failed = 0;
    int constants = 0, left_out = 0;
    screen out;
    screen_open(&out, stdout, SCREEN_TEXT);
    for (int i = 0; i < t.columns; i++) screen_add_cell(&t, SCREEN_PLAIN, "%s", heads[i]);
    for (int i = 0; i < e->columns; i++) {
        const dal_spread *spread = &s->component[(e->times - 1) * e->columns + i].spread;
        const double numbers[] = {spread->mean, spread->deviation, spread->min, spread->max};
        if (spread->min == spread->max) {
            constant[constants++] =
                cli_format("%s = %s", e->column[i], screen_number(x, spread->min, 4));
        } else if (t.cells / t.columns > ROWS_SHOWN) {
            left_out++;
        } else {
            screen_add_cell(&t, SCREEN_PLAIN, "%s", e->column[i]);
            for (int k = 0; k < 4; k++)
                screen_add_cell(&t, k < 2 ? SCREEN_PLAIN : SCREEN_FAINT, "%s",
                                screen_number(x, numbers[k], k == 1 ? 2 : 4));
        }
    }
    for (int i = 0; i < DAL_STATUS_COUNT; i++) failed += counts[i];
    screen_say(&out, 2, "%s by %s, h = %s: %s members until t = %.6g",
               e->simulation.request.system_name,
               dal_method_name(&e->spec.method, method, sizeof method),
               screen_number(x, e->spec.options.step, 4), screen_count(count, e->members),
               e->time[e->times - 1]);
    if (failed == 0) screen_say(&out, 2, "All of them reached the end");
    screen_skip(&out);
    screen_add_table(&out, &t, "lr", 2);
    if (left_out > 0) screen_say(&out, 2, "  ... and %d more (statistics.csv)", left_out);
    screen_skip(&out);
    if (constants > 0) screen_say(&out, 2, "In all members:");
    screen_say_items(&out, (const char *const *)constant, constants, CONSTANT_LINES, "");
    screen_say(&out, 7, "States: %s in %s", s->dir->has_rows ? "rows.npy, final.npy" : "final.npy",
               s->dir->path);
    screen_say(&out, 7, "Page:   dalembert report %s", s->dir->path);
    for (int i = 0; i < constants; i++) free(constant[i]);
    free(constant);
    screen_free_table(&t);
    return screen_close(&out, NULL);
}

static int print_table(const statistics *s)
{
    const ensemble *e = s->e;
    cli_table table = {.text = 0};
    printf("t = %g, %lld members\n", e->time[e->times - 1], e->members);
    cli_table_append(&table, "column\tmean\tdeviation\tmin\tmax");
    for (int i = 0; i < e->columns; i++) {
        const dal_spread *x = &s->component[(e->times - 1) * e->columns + i].spread;
        cli_table_append(&table, "%s\t%.6g\t%.6g\t%.6g\t%.6g", e->column[i], x->mean, x->deviation,
                         x->min, x->max);
    }
    cli_table_print_long(&table, 0);
    cli_table_free(&table);
    return cli_close(stdout, "standard output");
}

static int write_files(const statistics *s, long long *counts)
{
    int status = write_table(s, s->dir->statistics, put_statistics);
    if (status == CLI_DONE) status = write_table(s, s->dir->covariance, put_covariance);
    if (status == CLI_DONE) status = write_table(s, s->dir->histograms, put_histograms);
    if (status == CLI_DONE) status = write_table(s, s->dir->cloud, put_cloud);
    if (status == CLI_DONE) status = write_failures(s, counts);
    if (status == CLI_DONE) status = ensemble_directory_write_manifest(s->dir, s->e, STORE_DONE);
    if (status != CLI_DONE) return status;
    return screen_has_reader() ? print_screen(s, counts) : print_table(s);
}

int ensemble_finish(const ensemble *e, const ensemble_directory *dir, int threads)
{
    const size_t n = (size_t)e->columns, times = (size_t)e->times;
    long long counts[DAL_STATUS_COUNT] = {0};
    statistics s = {.e = e,
                    .dir = dir,
                    .component = cli_calloc(times * n, sizeof(component)),
                    .covariance = cli_calloc(times * n * n, sizeof(double))};
    pool_run((int)(times * n), threads, measure_component, &s);
    pool_run((int)times, threads, measure_covariance, &s);
    int status = s.status == CLI_DONE ? write_files(&s, counts) : s.status;
    if (status == CLI_DONE && print_failures(e, counts) == e->members) status = CLI_FAILED;
    free(s.component);
    free(s.covariance);
    return status;
}
