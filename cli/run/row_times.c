/* row_times.c - when the rows of a run are taken.
 *
 * From t = 0; with --from T0 all is shifted by that, and h < 0 where the run goes backwards.
 *
 *     linear   t_k = k T/N                                     k = 0..N (needs no list)
 *     log      t_0 = 0, t_k = h round((T/h)^((k-1)/(N-1)))     equal times are one row
 *     steps    t_k = h round(k N/S)                            k = 0..S, N = round(T/h), T = h N
 *     times    as they were given, and T behind them when it is later */
#include "row_times.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/file.h"
#include "ui/options.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int allocate_times(run_request *request, const char *sampling)
{
    if (request->samples > ROW_TIMES_MAX)
        return cli_fail(CLI_USAGE, "--samples: %lld are too many for --sampling %s",
                        request->samples, sampling);
    request->row_time = cli_malloc(((size_t)request->samples + 2) * sizeof *request->row_time);
    return CLI_DONE;
}

static int fill_log(run_request *request)
{
    const double h = request->options.step, whole = request->time - request->from;
    const double steps = floor(whole / h * (1.0 + 1e-12));
    const long long rows = request->samples;
    double before = 0.0;
    if (allocate_times(request, "log") != CLI_DONE) return CLI_USAGE;
    request->samples = 0;
    request->row_time[0] = request->from;
    for (long long k = 1; k <= rows; k++) {
        const double part = rows > 1 ? (double)(k - 1) / (double)(rows - 1) : 1.0;
        const double step = fmin(floor(exp(part * log(steps)) + 0.5), steps);
        if (step > before && step < whole / h)
            request->row_time[++request->samples] = request->from + step * h;
        before = fmax(before, step);
    }
    double *last = &request->row_time[request->samples];
    if (fabs(*last - request->from) < fabs(whole) * (1.0 - 1e-9) || request->samples == 0)
        last = &request->row_time[++request->samples];
    *last = request->time;
    return CLI_DONE;
}

static int fill_steps(run_request *request)
{
    const double h = request->options.step;
    const long long steps = llround((request->time - request->from) / h);
    if (request->samples > steps) request->samples = steps;
    if (allocate_times(request, "steps") != CLI_DONE) return CLI_USAGE;
    for (long long k = 0; k <= request->samples; k++) {
        const double part = (double)k / (double)request->samples;
        request->row_time[k] = request->from + (double)llround(part * (double)steps) * h;
    }
    request->time = request->row_time[request->samples];
    return CLI_DONE;
}

/* ---- a list -------------------------------------------------------------------------------- */

static int add_time(run_request *request, const char *text)
{
    double t;
    if (cli_number("--times", text, &t) != CLI_DONE) return CLI_USAGE;
    const long long count = request->times;
    const double *before = request->row_time;
    const bool repeats = count > 0 && t == before[count - 1];
    if (repeats || (count > 1 && (t > before[count - 1]) != (before[1] > before[0])))
        return cli_fail(CLI_USAGE, "--times: %s does not come after the time before", text);
    if (count == ROW_TIMES_MAX) return cli_fail(CLI_USAGE, "--times: too many");
    request->row_time =
        cli_realloc(request->row_time, ((size_t)count + 2) * sizeof *request->row_time);
    request->row_time[request->times++] = t;
    return CLI_DONE;
}

/* Times between commas and white space; in a file a line may end in a remark behind #. */
static int parse_list(run_request *request, char *text)
{
    int status = CLI_DONE;
    for (char *remark = text; (remark = strchr(remark, '#'));)
        while (*remark && *remark != '\n') *remark++ = ' ';
    for (char *word = strtok(text, ", \t\r\n"); word && status == CLI_DONE;
         word = strtok(NULL, ", \t\r\n"))
        status = add_time(request, word);
    if (status == CLI_DONE && request->times == 0)
        return cli_fail(CLI_USAGE, "--times: the list is empty");
    return status;
}

int row_times_parse(void *user, const cli_option *option, const char *given)
{
    run_request *request = user;
    (void)option;
    size_t length;
    struct stat info;
    const int is_file = stat(given, &info) == 0 && S_ISREG(info.st_mode);
    char *text = is_file ? file_read(given, &length) : cli_strdup(given);
    if (!text) return CLI_IO;
    free(request->row_time);
    free(request->made[REQUEST_times]);
    request->row_time = NULL;
    request->made[REQUEST_times] = NULL;
    request->times = 0;
    const int status = parse_list(request, text);
    free(text);
    if (status != CLI_DONE) return status;
    /* The manifest has the times themselves, and needs no file. */
    FILE *out = cli_memstream_open(&request->made[REQUEST_times], &length);
    for (long long i = 0; i < request->times; i++) {
        if (i) fputc(',', out);
        cli_put(out, request->row_time[i]);
    }
    cli_memstream_close(out);
    request->text[REQUEST_times] = request->made[REQUEST_times];
    return CLI_DONE;
}

static int finish_list(run_request *request)
{
    const double last = request->row_time[request->times - 1], from = request->from;
    const double direction = copysign(1.0, request->options.step);
    if (request_has(request, REQUEST_samples) || request_has(request, REQUEST_sampling))
        return cli_fail(CLI_USAGE, "--times excludes --samples and --sampling");
    if (!request_has(request, REQUEST_time) && request->steps == 0) request->time = last;
    if (direction * (request->row_time[0] - from) < 0.0)
        return cli_fail(CLI_USAGE, "--times: %.17g lies before the start at t = %g",
                        request->row_time[0], from);
    if (direction * (last - request->row_time[0]) < 0.0 && !request->text[REQUEST_step])
        return cli_fail(CLI_USAGE, "--times: from t = %.17g, %.17g does not come after %.17g", from,
                        last, request->row_time[0]);
    if (direction * (last - request->row_time[0]) < 0.0)
        return cli_fail(CLI_USAGE, "--times: a step of %g does not lead from %.17g to %.17g",
                        request->options.step, request->row_time[0], last);
    if (direction * (request->time - last) < 0.0)
        return cli_fail(CLI_USAGE, "--times: %.17g is later than T = %g", last, request->time);
    request->samples = request->times - 1;
    if (request->time != last) request->row_time[++request->samples] = request->time;
    if (request->samples > 0) return CLI_DONE;
    /* A run has two rows at least: the start is the other. */
    request->row_time[1] = request->row_time[0];
    request->row_time[0] = from;
    request->samples = 1;
    return CLI_DONE;
}

/* ---- all ----------------------------------------------------------------------------------- */

const char *step_error(double step, double from, double end, char text[STEP_ERROR_SIZE])
{
    const double time = end - from;
    /* from + h is rounded, so that one step may be longer than the time by that much. */
    if (fabs(step) - fabs(time) > DBL_EPSILON * fmax(fabs(from), fabs(end)))
        snprintf(text, STEP_ERROR_SIZE, "%.15g is larger than the time %g", step, time);
    else if (time / step > 0x1p53)
        snprintf(text, STEP_ERROR_SIZE,
                 "%.15g is too small: %g steps of %g are more than can be counted", step,
                 time / step, step);
    else
        return NULL;
    return text;
}

int row_times_check_step(const run_request *request, double from, double end)
{
    char text[STEP_ERROR_SIZE];
    const char *error = step_error(request->options.step, from, end, text);
    return error ? cli_fail(CLI_USAGE, "--step: %s", error) : CLI_DONE;
}

/* --steps determines the end; the sign of the step must lead there. */
static int find_end(run_request *request)
{
    const double h = request->options.step, from = request->from;
    if (request->steps > 0 && request_has(request, REQUEST_time))
        return cli_fail(CLI_USAGE, "--steps excludes --time");
    if (request->steps > 0) request->time = from + (double)request->steps * h;
    return CLI_DONE;
}

static int check_end(const run_request *request)
{
    const double h = request->options.step, whole = request->time - request->from;
    if (copysign(1.0, h) * whole > 0.0 && isfinite(whole))
        return row_times_check_step(request, request->from, request->time);
    if (request->steps > 0)
        return cli_fail(CLI_USAGE,
                        "--steps: %lld steps of %g from t = %.15g lead to no other finite time",
                        request->steps, h, request->from);
    return cli_fail(CLI_USAGE, "--time: a step of %g does not lead from t = %.15g to t = %.15g", h,
                    request->from, request->time);
}

int row_times_fill(run_request *request)
{
    int status = find_end(request);
    if (status == CLI_DONE && request->times > 0) status = finish_list(request);
    if (status == CLI_DONE) status = check_end(request);
    if (status != CLI_DONE || request->times > 0) return status;
    if (request->sampling == REQUEST_SAMPLING_LOG) return fill_log(request);
    return request->sampling == REQUEST_SAMPLING_STEPS ? fill_steps(request) : CLI_DONE;
}
