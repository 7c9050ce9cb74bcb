/* check.c - examines a system before a run.
 *
 * No property that a system states is trusted: flags, derivatives, invariants and exact solutions
 * are compared with numbers at the start and at random points about it. */
#include "check.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/wrap.h"

#include "check_sections.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Points lie this far from the start, relative to max(1, |x|). */
static const double neighbourhood = 0.1;
enum { MAX_ATTEMPTS = 20 * CHECK_POINTS, VALUE_COLUMN = 44 };

void check_item(check *c, check_result result, const char *what, const char *format, ...)
{
    static const char *const words[] = {
#define RESULT_TEXT(code, text) text,
        CHECK_RESULT_LIST(RESULT_TEXT)
#undef RESULT_TEXT
    };
    va_list list;
    c->items++;
    c->failed += result == CHECK_FAIL;
    c->unmeasured += result == CHECK_UNMEASURED;
    va_start(list, format);
    char *text = cli_format_list(format, list);
    va_end(list);
    const int column = printf("  %-34s  %-4s  ", what, words[result]);
    cli_wrap(stdout, text, column, VALUE_COLUMN);
    free(text);
}

void check_bound(check *c, const char *what, double value, double limit)
{
    check_item(c, value <= limit ? CHECK_OK : CHECK_FAIL, what, "%.2g  (at most %.0e)", value,
               limit);
}

/* ---- points about the start ---- */

static bool is_field_finite(check *c, const dal_point *at)
{
    if (dal_evaluator_call(c->evaluator, c->system->call.field, at->t, at->q, at->v, NULL,
                           c->values))
        return false;
    for (int i = 0; i < c->nw; i++)
        if (!isfinite(c->values[i])) return false;
    return true;
}

/* Uniform on [-1, 1), the same in every run of the program. */
static double random_number(unsigned long long *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

/* memory: for 2 CHECK_POINTS points of size numbers. */
static void choose_points(check *c, double *memory)
{
    unsigned long long random = 42;
    for (int k = 0; k < MAX_ATTEMPTS && c->near_count < CHECK_POINTS; k++) {
        double *x = memory + c->near_count * c->size;
        for (int i = 0; i < c->size; i++) {
            const double radius = neighbourhood * fmax(1.0, fabs(c->start[i]));
            x[i] = c->start[i] + radius * random_number(&random);
        }
        c->near[c->near_count] =
            (dal_point){.t = fabs(random_number(&random)), .q = x, .v = x + c->n};
        c->near_count += is_field_finite(c, &c->near[c->near_count]);
    }
    memory += CHECK_POINTS * c->size;
    for (int k = 0; k < c->near_count; k++) {
        double *x = memory + c->surface_count * c->size, t = c->near[k].t;
        memcpy(x, c->near[k].q, (size_t)c->size * sizeof *x);
        if (!cli_is_ok(dal_project_velocity(c->evaluator, t, x, x + c->n))) continue;
        c->surface[c->surface_count] = (dal_point){.t = t, .q = x, .v = x + c->n};
        c->surface_count += is_field_finite(c, &c->surface[c->surface_count]);
    }
}

/* ---- all ---- */

static int prepare_check(check *c)
{
    const dal_system *s = c->system;
    const run_request *request = c->request;
    dal_error error = {0};
    c->n = s->n, c->m = s->m, c->nw = s->n + s->multipliers, c->size = c->n + c->nw;
    const size_t n = (size_t)c->n, m = (size_t)c->m, nw = (size_t)c->nw, size = (size_t)c->size;
    const size_t points = 2 * CHECK_POINTS * size;
    /* The largest number of values of a callback, and some more for pairs of them. */
    const size_t values = nw * size + m * (1 + 2 * n) + 3 * n + (size_t)s->invariants + 8 * size;
    dal_status status =
        dal_evaluator_create(&c->evaluator, s, request->set.item, request->set.count, &error);
    if (status != DAL_OK) return cli_error(cli_input_exit(status), NULL, &error);
    c->start = cli_calloc(size + 1 + points + values, sizeof *c->start);
    c->values = c->start + size + 1 + points;
    status = dal_evaluator_start(c->evaluator, request->start.item, request->start.count, c->start,
                                 &error);
    if (status != DAL_OK) return cli_error(cli_input_exit(status), NULL, &error);
    c->origin = (dal_point){.t = 0.0, .q = c->start, .v = c->start + n};
    c->is_regular = is_field_finite(c, &c->origin);
    choose_points(c, c->start + size + 1);
    return CLI_DONE;
}

static int print_check(check *c)
{
    const dal_system *s = c->system;
    printf("%s", s->name);
    if (s->title) printf(": %s", s->title);
    printf("\n%d coordinates, %d constraints", c->n, c->m);
    if (s->multipliers > 0) printf(", %d multipliers (vakonomic)", s->multipliers);
    if (s->reference) printf("; %s", s->reference);
    putchar('\n');
    for (int k = 0; k < CHECK_SECTIONS; k++) {
        const int items = c->items;
        printf("\n%s\n", check_sections[k].title);
        check_sections[k].examine(c);
        if (c->items == items) check_item(c, CHECK_INFO, "-", "does not apply");
    }
    printf("\n%d items, %d failed", c->items, c->failed);
    if (c->unmeasured > 0) printf(", %d not measured", c->unmeasured);
    putchar('\n');
    const int written = cli_close(stdout, "standard output");
    return written != CLI_DONE ? written : c->failed + c->unmeasured > 0 ? CLI_CHECK : CLI_DONE;
}

int check_system(run_request *request)
{
    check c = {.request = request, .system = request->system};
    int status = prepare_check(&c);
    if (status == CLI_DONE) status = print_check(&c);
    free(c.start);
    dal_evaluator_free(c.evaluator);
    return status;
}
