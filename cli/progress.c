/* progress.c - how far a run has come: a line that replaces itself on a terminal, or lines of JSON
 * on stderr for scripts. */
#include "json.h"
#include "record.h"

#include <math.h>
#include <string.h>

static const double json_interval = 1.0; /* seconds between two lines of JSON */

int progress_read(const char *text, cli_progress_kind *kind)
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
static double remaining(const cli_record *r, double t)
{
    const double gone = t - r->begun;
    return gone > 0.0 ? r->stretch * (r->job->time - t) / gone : INFINITY;
}

static void show_line(const cli_record *r, double t)
{
    const double rate =
        r->stretch > 0.0 ? (double)(dal_run_steps(r->job->run) - r->begun_steps) / r->stretch : 0.0;
    if (r->observables == 0) {
        cli_progress("t = %.6g of %.6g, %.3g steps/s, %.0f s to go", t, r->job->time, rate,
                     remaining(r, t));
        return;
    }
    cli_progress("t = %.6g of %.6g, %.3g steps/s, %.0f s to go, %s moved by %.1e", t, r->job->time,
                 rate, remaining(r, t), record_observable(r, 0),
                 dal_statistics_deviation(&r->statistics[0]));
}

static void show_json(const cli_record *r, double t)
{
    json_number_member(stderr, "{", "t", t);
    json_number_member(stderr, ", ", "time", r->job->time);
    fprintf(stderr, ", \"steps\": %lld, \"rows\": %lld", dal_run_steps(r->job->run), r->mark.row);
    json_number_member(stderr, ", ", "seconds", r->mark.seconds);
    json_number_member(stderr, ", ", "remaining", t >= r->job->time ? 0.0 : remaining(r, t));
    fputs(", \"deviation\": {", stderr);
    for (int i = 0; i < r->observables; i++)
        json_number_member(stderr, i ? ", " : "", record_observable(r, i),
                           dal_statistics_deviation(&r->statistics[i]));
    fputs("}}\n", stderr);
}

void progress_show(cli_record *r, double t, int at_the_end)
{
    const double now = cli_seconds();
    if (r->progress == PROGRESS_AUTO && !r->quiet && !at_the_end) show_line(r, t);
    if (r->progress != PROGRESS_JSON || (!at_the_end && now - r->told_progress < json_interval))
        return;
    r->told_progress = now;
    show_json(r, t);
}
