/* row_times.c - when the rows of a run are taken.
 *
 * From t = 0; with --from T0 all is shifted by that, and h < 0 where the run goes backwards.
 *
 *     linear   t_k = k T/N, T and h as decimals                k = 0..N (needs no list)
 *     log      t_0 = 0, t_k = h round((T/h)^((k-1)/(N-1)))     equal times are one row
 *     steps    t_k = h round(k N/S)                            k = 0..S, N = round(T/h), T = h N
 *     times    as they were given, and T after them when it is later */
#include "row_times.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/csv_cells.h"
#include "io/file.h"
#include "ui/options.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int allocate_times(run_simulation *s, const char *sampling)
{
    if (s->samples > ROW_TIMES_MAX)
        return cli_fail(CLI_USAGE, "--samples: %lld are too many for --sampling %s", s->samples,
                        sampling);
    s->row_time = cli_malloc(((size_t)s->samples + 2) * sizeof *s->row_time);
    return CLI_DONE;
}

static int fill_log(run_simulation *s)
{
    const run_request *request = &s->request;
    const double h = request->options.step, whole = s->end - request->from;
    const double steps = floor(whole / h * (1.0 + 1e-12));
    const long long rows = s->samples;
    double before = 0.0;
    if (allocate_times(s, "log") != CLI_DONE) return CLI_USAGE;
    s->samples = 0;
    s->row_time[0] = request->from;
    for (long long k = 1; k <= rows; k++) {
        const double fraction = rows > 1 ? (double)(k - 1) / (double)(rows - 1) : 1.0;
        const double step = fmin(floor(exp(fraction * log(steps)) + 0.5), steps);
        if (step > before && step < whole / h) s->row_time[++s->samples] = request->from + step * h;
        before = fmax(before, step);
    }
    double *last = &s->row_time[s->samples];
    if (fabs(*last - request->from) < fabs(whole) * (1.0 - 1e-9) || s->samples == 0)
        last = &s->row_time[++s->samples];
    *last = s->end;
    return CLI_DONE;
}

static int fill_steps(run_simulation *s)
{
    const run_request *request = &s->request;
    const double h = request->options.step;
    const long long steps = llround((s->end - request->from) / h);
    if (s->samples > steps) s->samples = steps;
    if (allocate_times(s, "steps") != CLI_DONE) return CLI_USAGE;
    for (long long k = 0; k <= s->samples; k++) {
        const dal__decimal all = {(double)steps, 0.0};
        const double step = round(dal__add_share(0.0, all, (double)k, (double)s->samples));
        s->row_time[k] = request->from + step * h;
    }
    s->end = s->row_time[s->samples];
    return CLI_DONE;
}

/* ---- a list -------------------------------------------------------------------------------- */

static int add_time(run_request *request, const char *text)
{
    double t;
    if (cli_number("--times", text, &t) != CLI_DONE) return CLI_USAGE;
    const long long count = request->times;
    const double *before = request->listed;
    const bool repeats = count > 0 && t == before[count - 1];
    if (repeats || (count > 1 && (t > before[count - 1]) != (before[1] > before[0])))
        return cli_fail(CLI_USAGE, "--times: %s does not come after the time before", text);
    if (count == ROW_TIMES_MAX) return cli_fail(CLI_USAGE, "--times: too many");
    request->listed = cli_realloc(request->listed, ((size_t)count + 1) * sizeof *request->listed);
    request->listed[request->times++] = t;
    return CLI_DONE;
}

/* Times between commas and white space; in a file a line may end in a remark after #. */
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
    const bool is_file = stat(given, &info) == 0 && S_ISREG(info.st_mode);
    char *text = is_file ? file_read(given, &length) : cli_strdup(given);
    if (!text) return CLI_IO;
    free(request->listed);
    free(request->made[REQUEST_times]);
    request->listed = NULL;
    request->made[REQUEST_times] = NULL;
    request->times = 0;
    const int status = parse_list(request, text);
    free(text);
    if (status != CLI_DONE) return status;
    /* The manifest has the times themselves, and needs no file. */
    FILE *out = cli_memstream_open(&request->made[REQUEST_times], &length);
    for (long long i = 0; i < request->times; i++) {
        if (i) fputc(',', out);
        csv_put(out, request->listed[i]);
    }
    cli_memstream_close(out);
    request->text[REQUEST_times] = request->made[REQUEST_times];
    return CLI_DONE;
}

static int finish_list(run_simulation *s)
{
    const run_request *request = &s->request;
    const double first = request->listed[0], last = request->listed[request->times - 1],
                 from = request->from;
    const double direction = copysign(1.0, request->options.step);
    if (request_has(request, REQUEST_samples) || request_has(request, REQUEST_sampling))
        return cli_fail(CLI_USAGE, "--times excludes --samples and --sampling");
    if (!request_has(request, REQUEST_time) && request->steps == 0) s->end = last;
    if (direction * (first - from) < 0.0)
        return cli_fail(CLI_USAGE, "--times: %.17g lies before the start at t = %g", first, from);
    if (direction * (last - first) < 0.0 && !request->text[REQUEST_step])
        return cli_fail(CLI_USAGE, "--times: from t = %.17g, %.17g does not come after %.17g", from,
                        last, first);
    if (direction * (last - first) < 0.0)
        return cli_fail(CLI_USAGE, "--times: a step of %g does not lead from %.17g to %.17g",
                        request->options.step, first, last);
    if (direction * (s->end - last) < 0.0)
        return cli_fail(CLI_USAGE, "--times: %.17g is later than T = %g", last, s->end);
    s->row_time = cli_malloc(((size_t)request->times + 2) * sizeof *s->row_time);
    memcpy(s->row_time, request->listed, (size_t)request->times * sizeof *s->row_time);
    s->samples = request->times - 1;
    if (s->end != last) s->row_time[++s->samples] = s->end;
    if (s->samples > 0) return CLI_DONE;
    /* A run has two rows at least: the start is the other. */
    s->row_time[1] = first;
    s->row_time[0] = from;
    s->samples = 1;
    return CLI_DONE;
}

/* ---- equal distances ------------------------------------------------------------------------ */

double step_end(double from, double step, long long steps)
{
    return dal__add_share(from, dal__decimal_multiple(step, (double)steps), 1.0, 1.0);
}

double row_times_get(const run_simulation *s, long long row)
{
    if (s->row_time) return s->row_time[row];
    if (row == s->samples) return s->end;
    return dal__add_share(s->request.from, s->length, (double)row, (double)s->samples);
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
static int find_end(run_simulation *s)
{
    const run_request *request = &s->request;
    const double h = request->options.step, from = request->from;
    if (request->steps > 0 && request_has(request, REQUEST_time))
        return cli_fail(CLI_USAGE, "--steps excludes --time");
    if (request->steps > 0) s->end = step_end(from, h, request->steps);
    s->length = request->steps > 0 ? dal__decimal_multiple(h, (double)request->steps)
                                   : dal__decimal_difference(s->end, from);
    return CLI_DONE;
}

static int check_end(const run_simulation *s)
{
    const run_request *request = &s->request;
    const double h = request->options.step, whole = s->end - request->from;
    if (copysign(1.0, h) * whole > 0.0 && isfinite(whole))
        return row_times_check_step(request, request->from, s->end);
    if (request->steps > 0)
        return cli_fail(CLI_USAGE,
                        "--steps: %lld steps of %g from t = %.15g lead to no other finite time",
                        request->steps, h, request->from);
    return cli_fail(CLI_USAGE, "--time: a step of %g does not lead from t = %.15g to t = %.15g", h,
                    request->from, s->end);
}

int row_times_fill(run_simulation *s)
{
    const run_request *request = &s->request;
    s->end = request->time;
    s->samples = request->samples;
    int status = find_end(s);
    if (status == CLI_DONE && request->times > 0) status = finish_list(s);
    if (status == CLI_DONE) status = check_end(s);
    if (status != CLI_DONE || request->times > 0) return status;
    if (request->sampling == REQUEST_SAMPLING_LOG) return fill_log(s);
    return request->sampling == REQUEST_SAMPLING_STEPS ? fill_steps(s) : CLI_DONE;
}
