/* run_screen.c - the result of a run on a terminal. */
#include "run_screen.h"
#include "io/verdict.h"
#include "request_command.h"
#include "ui/memory.h"
#include "ui/screen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STATE_LINES = 3, OBSERVABLES = 11 };

/* Whether two quantities share a line: they have the same verdict, without numbers. */
static bool are_alike(const run_quantities *q, int i, int k)
{
    const verdict a = verdict_of(&q->trend[i]), b = verdict_of(&q->trend[k]);
    return !a.text[0] && !b.text[0] && strcmp(a.word, b.word) == 0;
}

int run_add_verdicts(screen_table *t, const run_quantities *q, int *left_out)
{
    const int n = q->count;
    const char **alike = cli_calloc((size_t)n + 1, sizeof *alike);
    int moving = -1;
    *left_out = 0;
    for (int k = 0; k < 2 * n; k++) {
        const int i = k % n;
        const dal_trend *trend = &q->trend[i];
        const verdict v = verdict_of(trend);
        const bool is_exact = strcmp(v.word, dal_size_text(DAL_SIZE_EXACT)) == 0;
        int count = 0, first = 0;
        while (first < i && !are_alike(q, first, i)) first++;
        if (is_exact != (k >= n) || first < i) continue;
        if (moving < 0 && trend->conservation == DAL_CONSERVED && trend->size == DAL_SIZE_LARGER)
            moving = i;
        if (t->cells / t->columns == q->max_rows) {
            ++*left_out;
            continue;
        }
        for (int j = i; j < n; j++)
            if (j == i || are_alike(q, i, j)) alike[count++] = q->names[j];
        char *names = screen_list_names(alike, count, q->columns);
        screen_add_cell(t, SCREEN_PLAIN, "%s", names);
        screen_add_cell(t, v.colour, "%s", v.word);
        screen_add_cell(t, SCREEN_PLAIN, "%s", v.text);
        free(names);
    }
    free(alike);
    return moving;
}

/* Returns the first quantity that moves; -1: none. */
static int say_verdicts(screen *s, const run_results *r)
{
    static const char *const heads[] = {"quantity", "trend", ""};
    const run_quantities quantities = {r->trend, r->names, r->observables,
                                       screen_limit(s, OBSERVABLES), 3 * s->width / 8};
    screen_table t = {.columns = 3, .heads = s->format != SCREEN_TEXT};
    int left_out;
    for (int i = 0; i < t.heads * t.columns; i++) screen_add_cell(&t, SCREEN_PLAIN, "%s", heads[i]);
    const int moving = run_add_verdicts(&t, &quantities, &left_out);
    screen_add_table(s, &t, "llw", 2);
    if (left_out > 0) screen_say(s, 2, "  ... and %d more (--details)", left_out);
    screen_free_table(&t);
    return moving;
}

int run_screen_print(FILE *to, const run_recorder *r, const char *output, screen_format format)
{
    const run_request *request = &r->simulation->request;
    const dal_run *run = r->simulation->run;
    const long long steps = dal_run_steps(run);
    const char *path = r->dir ? r->dir->rows : output;
    char method[128], h[SCREEN_NUMBER], count[SCREEN_NUMBER], seconds[SCREEN_NUMBER], space[64];
    screen s;
    screen_open(&s, to, format);
    snprintf(space, sizeof space, "in (q, v)");
    if (request->options.space == DAL_LIFTED)
        snprintf(space, sizeof space, "on the lift (%d variables)", r->dimension);
    screen_say(&s, 2, "%s by %s %s, h = %s, t = %.6g .. %.6g", request->system_name,
               dal_method_name(&request->method, method, sizeof method), space,
               screen_number(h, request->options.step, 4), request->from, dal_run_time(run));
    screen_say(&s, 2, "%s step%s in %s%s", screen_count(count, steps), steps == 1 ? "" : "s",
               screen_seconds(seconds, r->results.position.seconds),
               dal_run_stopped(run) > 0  ? "; an event ended the run"
               : recorder_is_finished(r) ? ""
                                         : "; the run did not reach its end");
    screen_skip(&s);
    /* The coordinates and velocities, as many as fit a few lines. */
    const int values = 2 * r->simulation->system->n;
    char **items = cli_calloc((size_t)values + 1, sizeof *items);
    for (int i = 0; i < values; i++)
        items[i] = cli_format("%s = %s", r->columns.name[1 + i],
                              screen_number(count, dal_run_state(run)[i], 4));
    screen_say_items(&s, (const char *const *)items, values, STATE_LINES, "-o");
    for (int i = 0; i < values; i++) free(items[i]);
    free(items);
    screen_skip(&s);
    const int moving = say_verdicts(&s, &r->results);
    screen_skip(&s);
    if (format != SCREEN_TEXT) return screen_close(&s, NULL);
    if (!path)
        screen_say(&s, 7, "Rows:  -o FILE.csv, or a pipe");
    else if (strcmp(path, "-") != 0)
        screen_say(&s, 7, "Rows:  %lld in %s", r->results.position.row, path);
    if (r->dir)
        screen_say(&s, 7, "Page:  dalembert report %s", r->dir->path);
    else
        screen_say(&s, 7, "Page:  -o DIR, then dalembert report DIR");
    if (moving >= 0) {
        char *command =
            request_format_command(request, "explain", request->system_name, REQUEST_ROW_OPTIONS);
        char *head = cli_format("Why %s moves:", r->results.names[moving]);
        screen_say_command(&s, head, command);
        free(command);
        free(head);
    }
    return screen_close(&s, NULL);
}
