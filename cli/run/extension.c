/* extension.c - the run of a directory, continued to a later end.
 *
 * Of N rows until T, and more until T2, at the same distance:
 *
 *     linear   N2 = N (T2 - T0)/(T - T0)
 *     steps    N2 = N n2/n of n and n2 steps
 *     times    the listed ones, and T2
 *
 * N2 must be whole, and the first N rows of the longer run at the same times to the bit. */
#include "extension.h"
#include "checkpoint.h"
#include "io/file.h"
#include "io/json.h"
#include "manifest.h"
#include "row_times.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static const double near_whole = 1e-9; /* relative */

/* What decides when the rows of a run are. */
static const int row_options[] = {REQUEST_time,    REQUEST_from,     REQUEST_steps, REQUEST_step,
                                  REQUEST_samples, REQUEST_sampling, REQUEST_times};

/* A run that failed, or that an event stopped, has no continuation. */
static int check_end(const run_directory *dir)
{
    const char *reason;
    const store_state state = store_stated(dir->doc, &reason);
    const char *end = state == STORE_FAILED           ? "the run failed"
                      : state == STORE_DONE && reason ? "an event stopped the run"
                                                      : NULL;
    if (!end) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s' cannot be extended: %s%s%s", dir->path, end,
                    reason ? ": " : "", reason ? reason : "");
}

/* Replaces --time or --steps, or takes it away. */
static int replace(run_request *request, int option, const char *text)
{
    request->text[option] = NULL;
    if (option == REQUEST_steps) request->steps = 0;
    return text ? request_give(request, option, cli_strdup(text)) : CLI_DONE;
}

int extension_replace_end(run_request *request, const run_extension *e, const char *directory,
                          double before, double *end)
{
    if (e->time && e->steps) return cli_fail(CLI_USAGE, "--steps excludes --time");
    int status = replace(request, REQUEST_steps, e->steps);
    if (status == CLI_DONE) status = replace(request, REQUEST_time, e->time);
    *end = request->steps > 0 ? step_end(request->from, request->options.step, request->steps)
                              : request->time;
    if (status != CLI_DONE || copysign(1.0, request->options.step) * (*end - before) >= 0.0)
        return status;
    return cli_fail(CLI_USAGE, "--%s: '%s' goes to t = %.15g already, and t = %.15g is not later",
                    e->time ? "time" : "steps", directory, before, *end);
}

/* How many rows there are after the first at the distance of the run until a later end; where that
 * is no whole number, says so. */
static int find_samples(const run_simulation *before, double later, const char *option,
                        long long *samples)
{
    const run_request *request = &before->request;
    const double from = request->from, length = before->end - from, rows = (double)before->samples;
    double count = (later - from) / length * rows;
    if (request->sampling == REQUEST_SAMPLING_STEPS) {
        const double h = request->options.step;
        count = rows * nearbyint((later - from) / h) / nearbyint(length / h);
    }
    *samples = count < 0x1p53 ? llround(count) : 0;
    if (*samples > 0 && fabs(count - (double)*samples) <= near_whole * count) return CLI_DONE;
    const double distance = length / rows;
    return cli_fail(
        CLI_USAGE, "--%s: the rows, %.15g apart, go on to t = %.15g or t = %.15g, not to t = %.15g",
        option, distance, from + floor(count) * distance, from + ceil(count) * distance, later);
}

int extension_extend_list(run_request *request, const run_simulation *before)
{
    const char *list = before->request.text[REQUEST_times];
    char *text = before->end == request->listed[request->times - 1]
                     ? cli_strdup(list)
                     : cli_format("%s,%.17g", list, before->end);
    return request_give(request, REQUEST_times, text);
}

static int extend_rows(run_request *request, const run_simulation *before, double end,
                       const char *option)
{
    long long samples;
    if (request->times > 0) return extension_extend_list(request, before);
    if (request->sampling == REQUEST_SAMPLING_LOG)
        return cli_fail(CLI_USAGE,
                        "--%s: the rows of --sampling log have no distance at which they could "
                        "go on",
                        option);
    const int status = find_samples(before, end, option, &samples);
    return status == CLI_DONE ? request_give(request, REQUEST_samples, cli_format("%lld", samples))
                              : status;
}

/* Whether the rows of the run before are the first ones of the longer run. */
static int compare_rows(const run_simulation *before, const run_simulation *after,
                        const char *option)
{
    for (long long k = 0; k <= before->samples; k++) {
        const double t = row_times_get(before, k), other = row_times_get(after, k);
        if (t != other)
            return cli_fail(CLI_USAGE,
                            "--%s: row %lld of a run to %.17g is at t = %.17g, and of this one at "
                            "%.17g: a multiple of the time %.17g has the same rows",
                            option, k, after->end, other, t, before->end - before->request.from);
    }
    return CLI_DONE;
}

/* Gives the request its new end. */
static int extend(run_directory *dir, run_request *request, const run_simulation *before,
                  const run_extension *e)
{
    double end;
    const int status = extension_replace_end(request, e, dir->path, before->end, &end);
    if (status != CLI_DONE) return status;
    dir->extends = end != before->end;
    return dir->extends ? extend_rows(request, before, end, e->time ? "time" : "steps") : CLI_DONE;
}

/* When the rows of the run are that was read.  A step that was chosen for its time stays. */
static int find_rows(run_request *request, run_simulation *before)
{
    run_request *r = &before->request;
    int status = CLI_DONE;
    for (size_t i = 0; i < sizeof row_options / sizeof *row_options; i++) {
        const char *text = request->text[row_options[i]];
        if (text && status == CLI_DONE) status = request_parse_option(r, row_options[i], text);
    }
    if (status == CLI_DONE && !request_has(r, REQUEST_step)) {
        const double end = request_has(r, REQUEST_time) ? r->time : r->listed[r->times - 1];
        r->options.step = (end - r->from) / REQUEST_CHOSEN_STEPS;
        status = request_give(request, REQUEST_step, cli_format("%.17g", r->options.step));
    }
    return status == CLI_DONE ? row_times_fill(before) : status;
}

/* Makes the run with the new end, which must have the rows of the one before. */
static int create_longer(run_directory *dir, run_simulation *simulation, run_simulation *before,
                         const run_extension *e)
{
    int status = check_end(dir);
    if (status == CLI_DONE) status = find_rows(&simulation->request, before);
    if (status == CLI_DONE) status = extend(dir, &simulation->request, before, e);
    if (status == CLI_DONE) status = simulation_create(simulation);
    if (status != CLI_DONE || !dir->extends) return status;
    return compare_rows(before, simulation, e->time ? "time" : "steps");
}

int extension_create(run_directory *dir, run_simulation *simulation, const run_extension *e)
{
    run_simulation before = simulation_default();
    if (!e->time && !e->steps) return simulation_create(simulation);
    const int status = create_longer(dir, simulation, &before, e);
    simulation_free(&before);
    return status;
}

/* A checkpoint of an extension that was never continued is made one of the present input first:
 * the manifest keeps one input before the present one. */
int extension_commit(run_recorder *r)
{
    run_directory *dir = r->dir;
    const dal_run *run = r->simulation->run;
    const bool has_begun = r->results.position.row > 0;
    const observed_steps observed = recorder_observed(r);
    if (dal_run_stopped(run) > 0)
        return cli_fail(CLI_USAGE, "'%s' cannot be extended: event %d stopped the run at t = %.15g",
                        dir->path, dal_run_stopped(run), dal_run_time(run));
    int status = has_begun && dir->earlier
                     ? checkpoint_save(dir, &r->results.position, run, &observed)
                     : CLI_DONE;
    if (status == CLI_DONE) status = manifest_extend(dir, r->simulation, &r->results.position);
    return status == CLI_DONE ? file_remove(dir->summary) : status;
}
