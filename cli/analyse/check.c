/* check.c - `dalembert check SYSTEM`: what can be known of a system before a run.
 *
 * Nothing a system says of itself is taken on trust: flags, derivatives, invariants and exact
 * solutions are compared with numbers at the start and at random points about it. */
#include "check.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Points lie this far from the start, relative to max(1, |x|). */
static const double neighbourhood = 0.1;
enum { ATTEMPTS = 20 * CHECK_POINTS, NAME_COLUMNS = 34, RESULT_COLUMNS = 4 };

/* ---- the report ---- */

void check_item(check *c, check_result result, const char *what, const char *format, ...)
{
    static const char *const word[] = {
#define X(code, text) text,
        CHECK_RESULT_LIST(X)
#undef X
    };
    va_list list;
    c->items++;
    c->failed += result == CHECK_FAIL;
    c->unmeasured += result == CHECK_UNMEASURED;
    printf("  %-*s  %-*s  ", NAME_COLUMNS, what, RESULT_COLUMNS, word[result]);
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
    putchar('\n');
}

void check_bound(check *c, const char *what, double value, double limit)
{
    check_result result = value <= limit ? CHECK_OK : CHECK_FAIL;
    check_item(c, result, what, "%.2g  (at most %.0e)", value, limit);
}

void check_unmeasured(check *c, const char *what, const char *format, ...)
{
    char reason[256];
    va_list list;
    va_start(list, format);
    vsnprintf(reason, sizeof reason, format, list);
    va_end(list);
    check_item(c, CHECK_UNMEASURED, what, "%s", reason);
}

void check_note(const char *format, ...)
{
    va_list list;
    printf("  %*s  ", NAME_COLUMNS + 2 + RESULT_COLUMNS, "");
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
    putchar('\n');
}

/* ---- points about the start ---- */

static int finite(const double *x, int count)
{
    for (int i = 0; i < count; i++)
        if (!isfinite(x[i])) return 0;
    return 1;
}

static int field_is_finite(check *c, const dal_point *at)
{
    dal_callback *field = c->system->call.field;
    return dal_probe_call(c->probe, field, at->t, at->q, at->v, NULL, c->values) == DAL_OK &&
           finite(c->values, c->nw);
}

/* Uniform on [-1, 1), the same in every run of the program. */
static double uniform(unsigned long long *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

/* memory: CHECK_POINTS points of size numbers. */
static void draw_points(check *c, double *memory)
{
    unsigned long long random = 42;
    for (int k = 0; k < ATTEMPTS && c->near_count < CHECK_POINTS; k++) {
        double *x = memory + c->near_count * c->size;
        for (int i = 0; i < c->size; i++) {
            double reach = neighbourhood * fmax(1.0, fabs(c->start[i]));
            x[i] = c->start[i] + reach * uniform(&random);
        }
        c->near[c->near_count] = (dal_point){fabs(uniform(&random)), x, x + c->n};
        c->near_count += field_is_finite(c, &c->near[c->near_count]);
    }
}

static void move_points(check *c, double *memory)
{
    for (int k = 0; k < c->near_count; k++) {
        double *x = memory + c->surface_count * c->size, t = c->near[k].t;
        memcpy(x, c->near[k].q, (size_t)c->size * sizeof(double));
        if (!cli_is_ok(dal_measure_onto(c->probe, t, x, x + c->n))) continue;
        c->surface[c->surface_count] = (dal_point){t, x, x + c->n};
        c->surface_count += field_is_finite(c, &c->surface[c->surface_count]);
    }
}

check_rate check_measure_rate(check *c, dal_callback *callback, int values, int i,
                              const dal_point *points, int count)
{
    check_rate rate = {.points = count};
    for (int k = 0; k < count; k++) {
        const dal_status status =
            dal_measure_rate(c->probe, callback, values, &points[k], c->values);
        if (!cli_is_ok(status)) {
            rate.status = status;
            continue;
        }
        rate.measured++;
        for (int j = i < 0 ? 0 : i; j < (i < 0 ? values : i + 1); j++)
            rate.most = fmax(rate.most, fabs(c->values[j]));
    }
    return rate;
}

static int is_unmeasured(check *c, const char *what, const check_rate *rate)
{
    if (rate->measured > 0) return 0;
    if (rate->points == 0)
        check_unmeasured(c, what, "there is no point for it");
    else
        check_unmeasured(c, what, "at none of %d points: %s", rate->points,
                         dal_status_text(rate->status));
    return 1;
}

/* Said where it is not every point. */
static const char *extent(const check_rate *rate, char *text, size_t size)
{
    snprintf(text, size, ", at %d of %d points", rate->measured, rate->points);
    return rate->measured < rate->points ? text : "";
}

void check_rate_bound(check *c, const char *what, const check_rate *rate, double limit)
{
    char text[64];
    if (is_unmeasured(c, what, rate)) return;
    check_item(c, rate->most <= limit ? CHECK_OK : CHECK_FAIL, what, "%.2g  (at most %.0e)%s",
               rate->most, limit, extent(rate, text, sizeof text));
}

void check_rate_info(check *c, const char *what, const check_rate *rate)
{
    char text[64];
    if (is_unmeasured(c, what, rate)) return;
    check_item(c, CHECK_INFO, what, "%.2g%s", rate->most, extent(rate, text, sizeof text));
}

/* ---- the command ---- */

typedef struct section {
    const char *title;
    void (*examine)(check *c);
} section;

static const section sections[] = {
#define X(name, title) {title, check_##name},
    CHECK_SECTION_LIST(X)
#undef X
};

static int report(check *c)
{
    const dal_system *s = c->system;
    printf("%s", s->name);
    if (s->title != NULL) printf(": %s", s->title);
    printf("\n%d coordinates, %d constraints", c->n, c->m);
    if (s->multipliers > 0) printf(", %d multipliers (vakonomic)", s->multipliers);
    if (s->reference != NULL) printf("; %s", s->reference);
    putchar('\n');
    for (size_t k = 0; k < sizeof sections / sizeof sections[0]; k++) {
        int items = c->items;
        printf("\n%s\n", sections[k].title);
        sections[k].examine(c);
        if (c->items == items) check_item(c, CHECK_INFO, "-", "does not apply");
    }
    printf("\n%d items, %d failed", c->items, c->failed);
    if (c->unmeasured > 0) printf(", %d not measured", c->unmeasured);
    putchar('\n');
    int written = cli_close(stdout, "standard output");
    return written != CLI_DONE ? written : c->failed + c->unmeasured > 0 ? CLI_CHECK : CLI_DONE;
}

/* The greatest number of values a callback leaves, and a few more for pairs of them. */
static size_t values_most(const dal_system *s)
{
    size_t n = (size_t)s->n, m = (size_t)s->m, nw = n + (size_t)s->multipliers;
    return nw * (n + nw) + m * (1 + 2 * n) + 3 * n + (size_t)s->invariants + 8 * (n + nw);
}

static int prepare(check *c, const dal_setting *start, int start_count)
{
    dal_error error = {0};
    size_t size = (size_t)c->size, points = 2 * CHECK_POINTS * size;
    dal_status status =
        dal_probe_create(&c->probe, c->system, c->parameters, c->parameter_count, &error);
    if (status != DAL_OK) return cli_error(cli_input_exit(status), NULL, &error);
    c->start = cli_calloc(size + 1 + points + values_most(c->system), sizeof(double));
    double *near = c->start + size + 1;
    c->values = near + points;
    status = dal_probe_start(c->probe, start, start_count, c->start, &error);
    if (status != DAL_OK) return cli_error(cli_input_exit(status), NULL, &error);
    c->origin = (dal_point){0.0, c->start, c->start + c->n};
    c->regular = field_is_finite(c, &c->origin);
    draw_points(c, near);
    move_points(c, near + CHECK_POINTS * size);
    return CLI_DONE;
}

static int examine(cli_job *job)
{
    check c = {.job = job, .parameters = job->set.item, .parameter_count = job->set.count};
    int status = cli_load(job->system, &job->model, &c.system);
    if (status != CLI_DONE) return status;
    job->made = c.system;
    c.n = c.system->n, c.m = c.system->m;
    c.nw = c.n + c.system->multipliers, c.size = c.n + c.nw;
    status = prepare(&c, job->start.item, job->start.count);
    if (status == CLI_DONE) status = report(&c);
    free(c.start);
    dal_probe_free(c.probe);
    return status;
}

/* name, value, default, help */
#define OWN_LIST(X)                                                                                \
    X(set, "PARAMETER=V", NULL, "give a parameter another value; may be repeated")                 \
    X(start, "NAME=V", NULL, "start x, x', e or g1 at V; may be repeated")

static const cli_option options[] = {OWN_LIST(CLI_OPTION)};
static const int job_option[] = {
#define X(name, value, initial, help) JOB_##name,
    OWN_LIST(X)
#undef X
};

static const char notes[] =
    "SYSTEM is a built-in name or the path of a system file.  One line per item: 'ok' or 'FAIL'\n"
    "where something can be right or wrong, 'not measured' where it could not be found out, "
    "'info'\n"
    "where it is merely so.  Everything is found from numbers at the start and at points about it, "
    "never from what the system says of itself;\n"
    "differences are central, of order 8.  The exit status is 1 when an item failed or was\n"
    "not measured.\n";

int command_check(int argc, char **argv)
{
    enum { OPTIONS = sizeof options / sizeof options[0] };
    cli_job job = job_begin();
    cli_args args = cli_begin(argc, argv, options, OPTIONS, notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int status = CLI_DONE;
        if (k != CLI_PLAIN)
            status = job_take(&job, job_option[k], value);
        else if (job.system != NULL)
            status = cli_fail(CLI_USAGE, "more than one SYSTEM: '%s'", value);
        else
            job.system = value;
        if (status != CLI_DONE) cli_stop(&args, status);
    }
    int status = args.status;
    if (status == CLI_GO_ON)
        status = job.system ? examine(&job) : cli_fail(CLI_USAGE, "the SYSTEM is missing");
    job_free(&job);
    return status;
}
