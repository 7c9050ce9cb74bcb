/* summary.c - what became of each quantity along a run. */
#include "record.h"

#include <string.h>

static double nanoseconds(const cli_record *r)
{
    long long steps = dal_run_steps(r->job->run);
    return steps > 0 ? 1e9 * r->mark.seconds / (double)steps : 0.0;
}

void summary_print(FILE *out, const cli_record *r)
{
    const cli_job *job = r->job;
    char method[128];
    dal_method_name(&job->method, method, sizeof method);
    fprintf(out, "%s, %s, %s, h = %g: t = %g, %lld rows\n", job->system, method,
            job->options.space == DAL_LIFTED ? "lifted" : "physical", job->options.step,
            dal_run_time(job->run), r->mark.row);
    fprintf(out, "%lld steps, %lld evaluations, %.1f ns per step\n", dal_run_steps(job->run),
            dal_run_evaluations(job->run), nanoseconds(r));
    fprintf(out, "%-12s %16s %16s %12s %12s %12s\n", "", "first", "last", "max | |", "max change",
            "rate");
    for (int i = 0; i < r->observables; i++) {
        const dal_drift *d = &r->drift[i];
        fprintf(out, "%-12s %16.9g %16.9g %12.3g %12.3g %12.3g\n", r->names[1 + r->dimension + i],
                d->first, d->last, d->greatest, d->deviation, d->rate);
    }
}

static void put(FILE *out, const char *quantity, const char *measure, double value)
{
    fprintf(out, "%s,%s,", quantity, measure);
    cli_put(out, value);
    fputc('\n', out);
}

int summary_write(const cli_record *r, const char *path)
{
    FILE *out = fopen(path, "w");
    if (!out) return cli_io("write", path);
    fputs("quantity,measure,value\n", out);
    put(out, "run", "time", dal_run_time(r->job->run));
    put(out, "run", "rows", (double)r->mark.row);
    put(out, "run", "steps", (double)dal_run_steps(r->job->run));
    put(out, "run", "evaluations", (double)dal_run_evaluations(r->job->run));
    put(out, "run", "ns_per_step", nanoseconds(r));
    for (int i = 0; i < r->observables; i++) {
        const dal_drift *d = &r->drift[i];
        const char *name = r->names[1 + r->dimension + i];
        put(out, name, "first", d->first);
        put(out, name, "last", d->last);
        put(out, name, "max", d->greatest);
        put(out, name, "max_change", d->deviation);
        put(out, name, "rate", d->rate);
    }
    return cli_close(out, path);
}
