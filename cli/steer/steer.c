/* steer.c - the search for the cheapest motion from one state to another. */
#include "steer.h"
#include "io/text.h"
#include "run/run.h"
#include "steer_output.h"
#include "steer_results.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- options ------------------------------------------------------------------------------- */

int steer_parse_target(void *user, const cli_option *option, const char *text)
{
    steer_settings *s = user;
    int status = CLI_DONE;
    for (const char *end; text && status == CLI_DONE; text = *end ? end + 1 : NULL) {
        end = text_find_comma(text);
        char *item = cli_strndup(text, (size_t)(end - text));
        status = request_parse_named(&s->target, option, item);
        free(item);
    }
    return status;
}

/* ---- the search ---------------------------------------------------------------------------- */

static dal_status report_reach(void *user, const dal_steering *steering)
{
    const steer_settings *s = user;
    char text[STEER_REACH];
    if (steering->inputs > 0) cli_note("%s", steer_format_reach(text, s, steering));
    return cli_interrupted() ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

static dal_status report_iteration(void *user, int guess, int iteration, double residual)
{
    const steer_settings *s = user;
    char size[SCREEN_NUMBER];
    const bool is_known = isfinite(residual) && residual > 0.0;
    char name[64];
    if (guess < 0)
        snprintf(name, sizeof name, "moving the end of a motion to the target");
    else if (guess < s->starts)
        snprintf(name, sizeof name, "guess %d of %lld", guess + 1, s->starts);
    else /* none of these leads to the target */
        snprintf(name, sizeof name, "further guess %lld", guess + 1 - s->starts);
    cli_progress("%s, iteration %d%s%s", name, iteration, is_known ? ": residual " : "",
                 is_known ? screen_number(size, residual, 2) : "");
    return cli_interrupted() ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

/* Searches; what was found is there after an interruption, too. */
static int search_motions(const steer_settings *s, dal_steering **steering)
{
    const dal_steer_observer observer = {(void *)s, report_reach, report_iteration};
    dal_steer_settings settings = dal_steer_settings_default();
    dal_run_spec spec;
    dal_error error = {0};
    const char **names;
    run_simulation simulation = s->simulation;
    const int status = simulation_make_spec(&simulation, &spec);
    if (status != CLI_DONE) return status;
    settings.target = s->target.item;
    settings.targets = s->target.count;
    settings.rest = s->rest;
    settings.aim = s->aim;
    settings.starts = (int)s->starts;
    settings.seed = (unsigned long long)s->seed;
    settings.iterations = (int)s->iterations;
    char *text = cli_strdup(s->free_starts ? s->free_starts : "");
    settings.frees = text_split(text, &names);
    settings.free_starts = names;
    const dal_status made = dal_steer_create(steering, simulation.model, &spec, simulation.end,
                                             &settings, &observer, &error);
    cli_progress_end();
    free(names);
    free(text);
    if (made != DAL_STATUS_OK)
        return cli_error(cli_input_exit(made), simulation.request.system_name, &error);
    if (cli_interrupted()) return CLI_SIGNAL;
    return (*steering)->extremal->status == DAL_STATUS_OK ? CLI_DONE : CLI_FAILED;
}

int steer_run(steer_settings *settings)
{
    run_simulation *s = &settings->simulation;
    dal_steering *steering = NULL;
    int status = screen_check_format(settings->format, "--json", settings->json);
    if (status == CLI_DONE && settings->output && !settings->force)
        status = run_check_directory(settings->output);
    if (status == CLI_DONE && settings->aim)
        status = request_give(&s->request, REQUEST_space, cli_strdup("physical"));
    if (status == CLI_DONE) status = simulation_create(s);
    if (status != CLI_DONE) return status;
    cli_catch_signals();
    status = search_motions(settings, &steering);
    if (!steering) return status;
    const steer_results r = {settings, steering, status};
    char *again = NULL;
    const int written = settings->output ? steer_write(&r, &again) : CLI_DONE;
    const int printed = settings->json ? steer_print_json(&r) : steer_print_screen(&r, again);
    free(again);
    if (status == CLI_FAILED)
        cli_fail(status, "%s: %s", s->request.system_name, steering->extremal->message);
    if (status == CLI_SIGNAL)
        cli_fail(status, "interrupted; %s",
                 steering->count > 0 ? "the motions so far, or the nearest one, are printed"
                                     : "there is no motion yet");
    dal_steer_free(steering);
    if (written != CLI_DONE) status = written;
    return printed == CLI_DONE ? status : printed;
}
