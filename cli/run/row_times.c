/* row_times.c - when the rows of a run are taken.
 *
 *     linear   t_k = k T/N                                     k = 0..N (nothing is made for it)
 *     log      t_0 = 0, t_k = h round((T/h)^((k-1)/(N-1)))     steps that fall together are one row
 *     steps    t_k = h round(k N/S)                            k = 0..S, N = round(T/h), T = h N
 *     times    as they were given, and T behind them when it is later */
#include "io/file.h"
#include "io/output.h"
#include "request.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- logarithmic --------------------------------------------------------------------------- */

static int schedule_log(run_request *request)
{
    const double h = request->options.step, T = request->time, steps = floor(T / h * (1.0 + 1e-12));
    const long long rows = request->samples;
    double before = 0.0;
    if (rows > ROW_TIMES_MAX)
        return cli_fail(CLI_USAGE, "--samples: %lld are too many for --sampling log", rows);
    request->row_time = cli_malloc(((size_t)rows + 2) * sizeof *request->row_time);
    request->samples = 0;
    request->row_time[0] = 0.0;
    for (long long k = 1; k <= rows; k++) {
        const double part = rows > 1 ? (double)(k - 1) / (double)(rows - 1) : 1.0;
        const double step = fmin(floor(exp(part * log(steps)) + 0.5), steps);
        if (step > before && step * h < T) request->row_time[++request->samples] = step * h;
        before = fmax(before, step);
    }
    double *last = &request->row_time[request->samples];
    if (*last < T * (1.0 - 1e-9) || request->samples == 0)
        last = &request->row_time[++request->samples];
    *last = T;
    return CLI_DONE;
}

/* ---- on whole steps ------------------------------------------------------------------------ */

static int schedule_steps(run_request *request)
{
    const double h = request->options.step;
    const long long steps = llround(request->time / h);
    if (request->samples > steps) request->samples = steps;
    if (request->samples > ROW_TIMES_MAX)
        return cli_fail(CLI_USAGE, "--samples: %lld are too many for --sampling steps",
                        request->samples);
    request->row_time = cli_malloc(((size_t)request->samples + 1) * sizeof *request->row_time);
    for (long long k = 0; k <= request->samples; k++) {
        const double part = (double)k / (double)request->samples;
        request->row_time[k] = (double)llround(part * (double)steps) * h;
    }
    request->time = request->row_time[request->samples];
    return CLI_DONE;
}

/* ---- given --------------------------------------------------------------------------------- */

static int add_time(run_request *request, const char *text)
{
    double t;
    if (cli_number("--times", text, &t) != CLI_DONE) return CLI_USAGE;
    const long long count = request->times;
    if (t < 0.0) return cli_fail(CLI_USAGE, "--times: %s is negative", text);
    if (count > 0 && !(t > request->row_time[count - 1]))
        return cli_fail(CLI_USAGE, "--times: %s does not come after the time before", text);
    if (count == ROW_TIMES_MAX) return cli_fail(CLI_USAGE, "--times: too many");
    request->row_time =
        cli_realloc(request->row_time, ((size_t)count + 2) * sizeof *request->row_time);
    request->row_time[request->times++] = t;
    return CLI_DONE;
}

static int is_file(const char *text)
{
    struct stat status;
    return stat(text, &status) == 0 && S_ISREG(status.st_mode);
}

/* Times between commas and white space; a line of a file may end in a remark behind #. */
static int read_times(run_request *request, char *text)
{
    int status = CLI_DONE;
    for (char *remark = text; (remark = strchr(remark, '#'));)
        while (*remark && *remark != '\n') *remark++ = ' ';
    for (char *word = strtok(text, ", \t\r\n"); word && status == CLI_DONE;
         word = strtok(NULL, ", \t\r\n"))
        status = add_time(request, word);
    if (status == CLI_DONE && request->times == 0)
        return cli_fail(CLI_USAGE, "--times: there is none");
    return status;
}

/* What was read, as a list that needs no file. */
static void write_list(run_request *request)
{
    size_t length;
    FILE *out = cli_memstream_open(&request->list, &length);
    for (long long i = 0; i < request->times; i++) {
        if (i) fputc(',', out);
        cli_put(out, request->row_time[i]);
    }
    cli_memstream_close(out);
    request->text[REQUEST_times] = request->list;
}

int request_parse_times(run_request *request, const char *given)
{
    size_t length;
    char *text = is_file(given) ? file_read(given, &length) : cli_strdup(given);
    if (!text) return CLI_IO;
    free(request->row_time);
    free(request->list);
    request->row_time = NULL;
    request->list = NULL;
    request->times = 0;
    const int status = read_times(request, text);
    free(text);
    if (status == CLI_DONE) write_list(request);
    return status;
}

static int schedule_times(run_request *request)
{
    const double last = request->row_time[request->times - 1];
    if (request->text[REQUEST_samples] || request->text[REQUEST_sampling])
        return cli_fail(CLI_USAGE, "--times: neither --samples nor --sampling goes with it");
    if (!request->text[REQUEST_time]) request->time = last;
    if (!(request->time > 0.0) || request->time < last)
        return cli_fail(CLI_USAGE, "--times: %.17g is no time up to T = %g", last, request->time);
    request->samples = request->times - 1;
    if (request->time > last) request->row_time[++request->samples] = request->time;
    if (request->samples > 0) return CLI_DONE;
    /* A run has two rows at least: the start is the other. */
    request->row_time[1] = request->row_time[0];
    request->row_time[0] = 0.0;
    request->samples = 1;
    return CLI_DONE;
}

int request_parse_sampling(run_request *request, const char *word)
{
    static const char *const words[] = {
#define X(code, word) #word,
        REQUEST_SAMPLING_LIST(X)
#undef X
    };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcmp(words[i], word) != 0) continue;
        request->sampling = (request_sampling)i;
        return CLI_DONE;
    }
    return cli_fail(CLI_USAGE, "--sampling: '%s' is not linear, log or steps", word);
}

const char *request_step_error(double step, double time, char text[REQUEST_STEP_TEXT])
{
    if (step > time)
        snprintf(text, REQUEST_STEP_TEXT, "%.15g is larger than the time %g", step, time);
    else if (time / step > 0x1p53)
        snprintf(text, REQUEST_STEP_TEXT,
                 "%.15g is too small: %g steps of %g are more than can be counted", step,
                 time / step, step);
    else
        return NULL;
    return text;
}

int request_check_step(const run_request *request, double time)
{
    char text[REQUEST_STEP_TEXT];
    const char *fault = request_step_error(request->options.step, time, text);
    return fault ? cli_fail(CLI_USAGE, "--step: %s", fault) : CLI_DONE;
}

int request_set_row_times(run_request *request)
{
    int status = request->times > 0 ? schedule_times(request) : CLI_DONE;
    if (status == CLI_DONE) status = request_check_step(request, request->time);
    if (status != CLI_DONE || request->times > 0) return status;
    switch (request->sampling) {
    case REQUEST_SAMPLING_LOG:
        return schedule_log(request);
    case REQUEST_SAMPLING_STEPS:
        return schedule_steps(request);
    default:
        return CLI_DONE;
    }
}
