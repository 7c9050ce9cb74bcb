/* progress.c - how far a run has come: a line that replaces itself on a terminal, or lines of JSON
 * on stderr for scripts.
 *
 *     t = 4310 (43 %), 35 s to go, 1.63e+07 steps/s, moved: D1 2.2e-16, E 3.1e-12
 *
 * moved is max |x - first|, of as many observables as the terminal has room for. */
#include "io/json.h"
#include "recorder.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

/* Seconds between two lines. */
static const double json_interval = 1.0, line_interval = 0.1;

enum { LINE = 256 };

int progress_parse(const char *text, cli_progress_kind *kind)
{
    static const char *const words[] = {
#define X(code, word) #word,
        PROGRESS_LIST(X)
#undef X
    };
    enum { WORDS = sizeof words / sizeof words[0] };
    for (int i = 0; i < WORDS; i++) {
        if (strcmp(words[i], text) != 0) continue;
        *kind = (cli_progress_kind)i;
        return CLI_DONE;
    }
    return cli_fail(CLI_USAGE, "--progress: '%s' is not auto, json or off", text);
}

/* The time from now to the end as the steps of this process have gone so far. */
static double remaining(const run_recorder *r, double t)
{
    const double gone = t - r->begun;
    return gone > 0.0 ? r->stretch * (r->request->time - t) / gone : INFINITY;
}

/* Appends to a line as long as there is room; a piece that does not fit is left out as a whole. */
static int append(char *line, int *length, int room, const char *format, ...)
{
    char piece[LINE];
    va_list list;
    va_start(list, format);
    const int n = vsnprintf(piece, sizeof piece, format, list);
    va_end(list);
    if (n < 0 || *length + n > room) return 0;
    memcpy(line + *length, piece, (size_t)n + 1);
    *length += n;
    return 1;
}

static void append_remaining(char *line, int *length, int room, double seconds)
{
    static const struct {
        double most, seconds;
        const char *unit;
    } unit[] = {{120, 1, "s"}, {7200, 60, "min"}, {172800, 3600, "h"}, {INFINITY, 86400, "days"}};
    int i = 0;
    if (!isfinite(seconds)) return;
    while (seconds >= unit[i].most) i++;
    append(line, length, room, ", %.0f %s to go", seconds / unit[i].seconds, unit[i].unit);
}

/* The norms of p and pi are for the summary. */
static void append_moved(char *line, int *length, int room, const run_recorder *r)
{
    const char *before = ", moved: ";
    for (int i = 0; i < r->observables; i++) {
        const char *name = recorder_observable_name(r, i);
        if (name[0] == '|') continue;
        if (!append(line, length, room, "%s%s %.2g", before, name,
                    dal_statistics_deviation(&r->statistics[i])))
            return;
        before = ", ";
    }
}

static void show_line(const run_recorder *r, double t)
{
    char line[LINE] = "";
    int length = 0;
    const int width = cli_width() - 1, room = width < LINE ? width : LINE - 1;
    const long long steps = dal_run_steps(r->request->run) - r->begun_steps;
    append(line, &length, room, "t = %.6g (%.0f %%)", t, floor(100.0 * t / r->request->time));
    append_remaining(line, &length, room, remaining(r, t));
    if (r->stretch > 0.0) append(line, &length, room, ", %.2e steps/s", (double)steps / r->stretch);
    append_moved(line, &length, room, r);
    cli_progress("%s", line);
}

static void show_json(const run_recorder *r, double t)
{
    json_number_member(stderr, "{", "t", t);
    json_number_member(stderr, ", ", "time", r->request->time);
    fprintf(stderr, ", \"steps\": %lld, \"rows\": %lld", dal_run_steps(r->request->run),
            r->position.row);
    json_number_member(stderr, ", ", "seconds", r->position.seconds);
    json_number_member(stderr, ", ", "remaining", t >= r->request->time ? 0.0 : remaining(r, t));
    fputs(", \"deviation\": {", stderr);
    for (int i = 0; i < r->observables; i++)
        json_number_member(stderr, i ? ", " : "", recorder_observable_name(r, i),
                           dal_statistics_deviation(&r->statistics[i]));
    fputs("}}\n", stderr);
}

void progress_show(run_recorder *r, double t, int at_the_end)
{
    const int json = r->progress == PROGRESS_JSON;
    const double now = cli_seconds();
    if (r->progress == PROGRESS_OFF || (!json && (r->quiet || at_the_end))) return;
    if (!at_the_end && now - r->told_progress < (json ? json_interval : line_interval)) return;
    r->told_progress = now;
    if (json)
        show_json(r, t);
    else
        show_line(r, t);
}
