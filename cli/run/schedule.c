/* schedule.c - when the rows of a run are taken.
 *
 *     linear   t_k = k T/N                                     k = 0..N (nothing is made for it)
 *     log      t_0 = 0, t_k = h round((T/h)^((k-1)/(N-1)))     steps that fall together are one row
 *     steps    t_k = h round(k N/S)                            k = 0..S, N = round(T/h), T = h N
 *     times    as they were given, and T behind them when it is later */
#include "io/file.h"
#include "job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- logarithmic --------------------------------------------------------------------------- */

static int schedule_log(cli_job *job)
{
    const double h = job->options.step, T = job->time, steps = floor(T / h * (1.0 + 1e-12));
    const long long rows = job->samples;
    double before = 0.0;
    if (rows > SCHEDULE_MOST)
        return cli_fail(CLI_USAGE, "--samples: %lld are too many for --sampling log", rows);
    job->row_time = cli_malloc(((size_t)rows + 2) * sizeof *job->row_time);
    job->samples = 0;
    job->row_time[0] = 0.0;
    for (long long k = 1; k <= rows; k++) {
        const double part = rows > 1 ? (double)(k - 1) / (double)(rows - 1) : 1.0;
        const double step = fmin(floor(exp(part * log(steps)) + 0.5), steps);
        if (step > before && step * h < T) job->row_time[++job->samples] = step * h;
        before = fmax(before, step);
    }
    double *last = &job->row_time[job->samples];
    if (*last < T * (1.0 - 1e-9) || job->samples == 0) last = &job->row_time[++job->samples];
    *last = T;
    return CLI_DONE;
}

/* ---- on whole steps ------------------------------------------------------------------------ */

static int schedule_steps(cli_job *job)
{
    const double h = job->options.step;
    const long long steps = llround(job->time / h);
    if (job->samples > steps) job->samples = steps;
    if (job->samples > SCHEDULE_MOST)
        return cli_fail(CLI_USAGE, "--samples: %lld are too many for --sampling steps",
                        job->samples);
    job->row_time = cli_malloc(((size_t)job->samples + 1) * sizeof *job->row_time);
    for (long long k = 0; k <= job->samples; k++) {
        const double part = (double)k / (double)job->samples;
        job->row_time[k] = (double)llround(part * (double)steps) * h;
    }
    job->time = job->row_time[job->samples];
    return CLI_DONE;
}

/* ---- given --------------------------------------------------------------------------------- */

static int add_time(cli_job *job, const char *text)
{
    double t;
    if (cli_number("--times", text, &t) != CLI_DONE) return CLI_USAGE;
    const long long count = job->times;
    if (t < 0.0) return cli_fail(CLI_USAGE, "--times: %s is negative", text);
    if (count > 0 && !(t > job->row_time[count - 1]))
        return cli_fail(CLI_USAGE, "--times: %s does not come after the time before", text);
    if (count == SCHEDULE_MOST) return cli_fail(CLI_USAGE, "--times: too many");
    job->row_time = cli_realloc(job->row_time, ((size_t)count + 2) * sizeof *job->row_time);
    job->row_time[job->times++] = t;
    return CLI_DONE;
}

static int is_file(const char *text)
{
    struct stat status;
    return stat(text, &status) == 0 && S_ISREG(status.st_mode);
}

/* Times between commas and white space; a line of a file may end in a remark behind #. */
static int read_times(cli_job *job, char *text)
{
    int status = CLI_DONE;
    for (char *remark = text; (remark = strchr(remark, '#'));)
        while (*remark && *remark != '\n') *remark++ = ' ';
    for (char *word = strtok(text, ", \t\r\n"); word && status == CLI_DONE;
         word = strtok(NULL, ", \t\r\n"))
        status = add_time(job, word);
    if (status == CLI_DONE && job->times == 0) return cli_fail(CLI_USAGE, "--times: there is none");
    return status;
}

/* What was read, as a list that needs no file. */
static void write_list(cli_job *job)
{
    size_t length;
    FILE *out = cli_memstream_open(&job->list, &length);
    for (long long i = 0; i < job->times; i++) {
        if (i) fputc(',', out);
        cli_put(out, job->row_time[i]);
    }
    cli_memstream_close(out);
    job->text[JOB_times] = job->list;
}

int job_take_times(cli_job *job, const char *given)
{
    size_t length;
    char *text = is_file(given) ? file_read(given, &length) : cli_strdup(given);
    if (!text) return CLI_IO;
    free(job->row_time);
    free(job->list);
    job->row_time = NULL;
    job->list = NULL;
    job->times = 0;
    const int status = read_times(job, text);
    free(text);
    if (status == CLI_DONE) write_list(job);
    return status;
}

static int schedule_times(cli_job *job)
{
    const double last = job->row_time[job->times - 1];
    if (job->text[JOB_samples] || job->text[JOB_sampling])
        return cli_fail(CLI_USAGE, "--times: neither --samples nor --sampling goes with it");
    if (!job->text[JOB_time]) job->time = last;
    if (!(job->time > 0.0) || job->time < last)
        return cli_fail(CLI_USAGE, "--times: %.17g is no time up to T = %g", last, job->time);
    job->samples = job->times - 1;
    if (job->time > last) job->row_time[++job->samples] = job->time;
    if (job->samples > 0) return CLI_DONE;
    /* A run has two rows at least: the start is the other. */
    job->row_time[1] = job->row_time[0];
    job->row_time[0] = 0.0;
    job->samples = 1;
    return CLI_DONE;
}

int job_take_sampling(cli_job *job, const char *word)
{
    static const char *const words[] = {
#define X(code, word) #word,
        JOB_SAMPLING_LIST(X)
#undef X
    };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcmp(words[i], word) != 0) continue;
        job->sampling = (job_sampling)i;
        return CLI_DONE;
    }
    return cli_fail(CLI_USAGE, "--sampling: '%s' is not linear, log or steps", word);
}

const char *schedule_fault(double step, double time, char text[SCHEDULE_TEXT])
{
    if (step > time)
        snprintf(text, SCHEDULE_TEXT, "%.15g is larger than the time %g", step, time);
    else if (time / step > 0x1p53)
        snprintf(text, SCHEDULE_TEXT,
                 "%.15g is too small: %g steps of %g are more than can be counted", step,
                 time / step, step);
    else
        return NULL;
    return text;
}

int job_check_step(const cli_job *job, double time)
{
    char text[SCHEDULE_TEXT];
    const char *fault = schedule_fault(job->options.step, time, text);
    return fault ? cli_fail(CLI_USAGE, "--step: %s", fault) : CLI_DONE;
}

int job_schedule(cli_job *job)
{
    int status = job->times > 0 ? schedule_times(job) : CLI_DONE;
    if (status == CLI_DONE) status = job_check_step(job, job->time);
    if (status != CLI_DONE || job->times > 0) return status;
    switch (job->sampling) {
    case JOB_SAMPLING_LOG:
        return schedule_log(job);
    case JOB_SAMPLING_STEPS:
        return schedule_steps(job);
    default:
        return CLI_DONE;
    }
}
