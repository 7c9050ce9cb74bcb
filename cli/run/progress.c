/* progress.c - shows the progress of a run: a line that replaces itself on a terminal, or lines of
 * JSON on stderr for scripts.
 *
 *     t = 4310 (43 %), 35 s to go, 1.63e+07 steps/s, moved: D1 2.2e-16, E 3.1e-12
 *
 * moved is max |x - first|, of as many observables as fit the terminal. */
#include "progress.h"
#include "dalembert.h"
#include "ui/clock.h"
#include "ui/message.h"

#include "io/json.h"
#include "recorder.h"
#include "ui/memory.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Seconds between two lines. */
static const double json_interval = 1.0, line_interval = 0.1;

enum { LINE = 256 };

/* A line as it is made; a piece that does not fit is left out as a whole. */
typedef struct progress_line {
    char text[LINE];
    int length, capacity;
} progress_line;

static CLI_PRINTF(2, 3) int append_piece(progress_line *line, const char *format, ...)
{
    char piece[LINE];
    va_list list;
    va_start(list, format);
    const int n = vsnprintf(piece, sizeof piece, format, list);
    va_end(list);
    if (n < 0 || line->length + n > line->capacity) return 0;
    memcpy(line->text + line->length, piece, (size_t)n + 1);
    line->length += n;
    return 1;
}

/* Seconds to the end, if the steps take the time that those of this process took so far. */
static double remaining(const run_recorder *r, double t)
{
    const double done = t - r->start_time;
    return done > 0.0 ? r->seconds * (r->request->time - t) / done : INFINITY;
}

static void append_remaining(progress_line *line, double seconds)
{
    static const struct {
        double max, seconds;
        const char *unit;
    } unit[] = {{120, 1, "s"}, {7200, 60, "min"}, {172800, 3600, "h"}, {INFINITY, 86400, "days"}};
    int i = 0;
    if (!isfinite(seconds)) return;
    while (seconds >= unit[i].max) i++;
    append_piece(line, ", %.0f %s to go", seconds / unit[i].seconds, unit[i].unit);
}

static void show_line(const run_recorder *r, double t)
{
    const int width = cli_width() - 1;
    progress_line line = {.capacity = width < LINE ? width : LINE - 1};
    const long long steps = dal_run_steps(r->request->run) - r->start_step;
    append_piece(&line, "t = %.6g (%.0f %%)", t, floor(100.0 * t / r->request->time));
    append_remaining(&line, remaining(r, t));
    if (r->seconds > 0.0) append_piece(&line, ", %.2e steps/s", (double)steps / r->seconds);
    const char *before = ", moved: ";
    for (int i = 0; i < r->observables; i++) {
        const char *name = recorder_observable_name(r, i);
        if (name[0] == '|') continue; /* the norms of p and pi are for the summary */
        if (!append_piece(&line, "%s%s %.2g", before, name,
                          dal_statistics_deviation(&r->statistics[i])))
            break;
        before = ", ";
    }
    cli_progress("%s", line.text);
}

static void show_json(const run_recorder *r, double t)
{
    json_writer w = {.out = stderr};
    json_open(&w, NULL, JSON_ON_ONE_LINE);
    json_put_number(&w, "t", t);
    json_put_number(&w, "time", r->request->time);
    json_put_integer(&w, "steps", dal_run_steps(r->request->run));
    json_put_integer(&w, "rows", r->position.row);
    json_put_number(&w, "seconds", r->position.seconds);
    json_put_number(&w, "remaining", t >= r->request->time ? 0.0 : remaining(r, t));
    json_open(&w, "deviation", JSON_ON_ONE_LINE);
    for (int i = 0; i < r->observables; i++)
        json_put_number(&w, recorder_observable_name(r, i),
                        dal_statistics_deviation(&r->statistics[i]));
    json_close(&w);
    json_close(&w);
    fputc('\n', w.out);
}

void progress_show(run_recorder *r, double t, int at_the_end)
{
    const int json = r->progress == PROGRESS_JSON;
    const double now = cli_seconds();
    if (r->progress == PROGRESS_OFF || (!json && (r->no_line || at_the_end))) return;
    if (!at_the_end && now - r->shown < (json ? json_interval : line_interval)) return;
    r->shown = now;
    if (json)
        show_json(r, t);
    else
        show_line(r, t);
}
