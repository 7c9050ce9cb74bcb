/* ensemble.c - an ensemble: the run that its members share, what varies, and when they are
 * observed. */
#include "ensemble.h"
#include "dalembert_order.h"
#include "io/file.h"
#include "run/columns.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NAME = 128 };

ensemble ensemble_default(void)
{
    ensemble e = {.simulation = simulation_default()};
    e.simulation.request.step_rule = REQUEST_STEP_CHOSEN;
    return e;
}

void ensemble_free(ensemble *e)
{
    dal_ensemble_free(e->first);
    for (int i = 0; i < e->variations; i++) free(e->vary_text[i]);
    for (int i = 0; i < e->columns; i++) free(e->column[i]);
    free(e->vary);
    free(e->vary_text);
    free(e->column);
    free(e->time);
    free(e->steps);
    simulation_free(&e->simulation);
    *e = ensemble_default();
}

int ensemble_parse_vary(void *user, const cli_option *option, const char *text)
{
    ensemble *e = user;
    dal_error error = {0};
    (void)option;
    const size_t count = (size_t)e->variations + 1;
    e->vary = cli_realloc(e->vary, count * sizeof *e->vary);
    if (dal_variation_parse(&e->vary[count - 1], text, &error) != DAL_STATUS_OK)
        return cli_fail(CLI_USAGE, "--vary: %s", error.message);
    for (int i = 0; i < e->variations; i++)
        if (strcmp(e->vary[i].name, e->vary[count - 1].name) == 0)
            return cli_fail(CLI_USAGE, "--vary: %s is varied twice", e->vary[i].name);
    e->vary_text = cli_realloc(e->vary_text, count * sizeof *e->vary_text);
    e->vary_text[e->variations++] = cli_strdup(text);
    return CLI_DONE;
}

int ensemble_parse_quantiles(void *user, const cli_option *option, const char *text)
{
    ensemble *e = user;
    char *list = cli_strdup(text);
    int status = CLI_DONE;
    (void)option;
    e->quantiles = 0;
    for (char *word = strtok(list, ", "); word && status == CLI_DONE; word = strtok(NULL, ", ")) {
        double p;
        status = cli_number("--quantiles", word, &p);
        if (status != CLI_DONE) break;
        if (!(p >= 0.0 && p <= 1.0))
            status = cli_fail(CLI_USAGE, "--quantiles: %s is not from 0 to 1", word);
        else if (e->quantiles == ENSEMBLE_QUANTILES)
            status = cli_fail(CLI_USAGE, "--quantiles: more than %d", ENSEMBLE_QUANTILES);
        else
            e->quantile[e->quantiles++] = p;
    }
    free(list);
    return status;
}

static const cli_option options[] = {
    {"members", "N", CLI_REQUIRED, "how many members there are",
     CLI_INTEGER(ensemble_settings, ensemble.members, 1, ENSEMBLE_MAX_MEMBERS)},
    {"seed", "S", CLI_REQUIRED, "begins the draws: the same seed draws the same members",
     CLI_INTEGER(ensemble_settings, ensemble.seed, 0, 0x1p53)},
    {"vary", "NAME=DISTRIBUTION", CLI_REQUIRED,
     "adds uniform(LOW,HIGH), normal(MEAN,DEVIATION) or lognormal(MEAN,DEVIATION) to a start value "
     "or parameter; may be repeated",
     .parse = ensemble_parse_vary},
    {"quantiles", "LIST", "0.05,0.25,0.5,0.75,0.95", "the quantiles in statistics.csv",
     .parse = ensemble_parse_quantiles},
    {"axes", "X,Y", NULL, "the plane of the clouds (the first two coordinates)",
     CLI_TEXT(ensemble_settings, ensemble.axes)},
    {"output", "DIR", CLI_REQUIRED, "writes the files there",
     CLI_ROW(cli_parse_output, ensemble_settings, output)},
    {"checkpoint", "SECONDS", "5", "marks on the disk what is done, every SECONDS",
     CLI_NUMBER(ensemble_settings, interval, 0.0, INFINITY)},
    NATIVE_OPTION(ensemble_settings),
    {"force", NULL, NULL, "overwrites the ensemble in the directory",
     CLI_FLAG(ensemble_settings, force)},
};

cli_option_set ensemble_option_set(ensemble_settings *settings)
{
    return CLI_OPTION_SET(options, settings);
}

int ensemble_chunks(const ensemble *e)
{
    return (int)((e->members + ENSEMBLE_CHUNK - 1) / ENSEMBLE_CHUNK);
}

int ensemble_chunk_members(const ensemble *e, int chunk)
{
    const long long rest = e->members - (long long)chunk * ENSEMBLE_CHUNK;
    return rest < ENSEMBLE_CHUNK ? (int)rest : ENSEMBLE_CHUNK;
}

/* Members are observed after whole steps: all lanes of a batch have one time. */
static int fill_times(ensemble *e)
{
    const run_simulation *s = &e->simulation;
    const run_request *r = &s->request;
    const double h = r->options.step;
    e->times = r->times > 0 ? (int)s->samples + 1 : 1;
    e->time = cli_calloc((size_t)e->times, sizeof *e->time);
    e->steps = cli_calloc((size_t)e->times, sizeof *e->steps);
    for (int i = 0; i < e->times; i++) {
        e->time[i] = r->times > 0 ? s->row_time[i] : s->end;
        e->steps[i] = dal_whole_steps(r->from, e->time[i], h);
        if (e->steps[i] == 0 && e->time[i] != r->from)
            return cli_fail(CLI_USAGE,
                            "--%s: %.15g is not a whole number of steps of %g from t = %g",
                            r->times > 0 ? "times" : "time", e->time[i], h, r->from);
    }
    return CLI_DONE;
}

static void name_columns(ensemble *e)
{
    char name[MAX_NAME];
    e->columns = dal_run_dimension(e->simulation.run);
    e->column = cli_calloc((size_t)e->columns, sizeof *e->column);
    for (int i = 0; i < e->columns; i++)
        e->column[i] = cli_strdup(dal_run_component_name(e->simulation.run, i, name, sizeof name));
}

int ensemble_complete(ensemble *e)
{
    dal_error error = {0};
    if (e->variations == 0) return cli_fail(CLI_USAGE, "--vary is missing: nothing would vary");
    run_request *request = &e->simulation.request;
    if (!request_has(request, REQUEST_consistent)) request->options.consistent = true;
    int status = simulation_create(&e->simulation);
    if (status == CLI_DONE) status = simulation_make_spec(&e->simulation, &e->spec);
    if (status == CLI_DONE) status = fill_times(e);
    if (status != CLI_DONE) return status;
    name_columns(e);
    e->axis[0] = 0; /* by default the first two coordinates, or the only one and its velocity */
    e->axis[1] = 1;
    if (e->axes)
        status = columns_find_axes(e->axes, (const char *const *)e->column, e->columns, e->axis);
    if (status != CLI_DONE) return status;
    const dal_status made =
        dal_ensemble_create(&e->first, &e->spec, e->vary, e->variations,
                            (unsigned long long)e->seed, ENSEMBLE_CHUNK, &error);
    if (made == DAL_STATUS_OK) return CLI_DONE;
    return cli_error(cli_input_exit(made),
                     made == DAL_STATUS_NAME ? "--vary" : request->system_name, &error);
}
