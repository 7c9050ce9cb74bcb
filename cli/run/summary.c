/* summary.c - what became of each quantity along a run. */
#include "io/file.h"
#include "io/output.h"
#include "io/trend.h"
#include "recorder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double nanoseconds(const run_recorder *r)
{
    long long steps = dal_run_steps(r->request->run);
    return steps > 0 ? 1e9 * r->position.seconds / (double)steps : 0.0;
}

static void print_observable(FILE *out, const char *name, const dal_trend *f)
{
    char text[128], exponent[32] = "-";
    const int is_stated = f->conservation == DAL_CONSERVED;
    if (is_stated && !isnan(f->exponent)) snprintf(exponent, sizeof exponent, "%.2f", f->exponent);
    fprintf(out, "%-12s %14.7g %10.3g %10.3g %+10.2e (%+.1e %+.1e) %8s %9s  %s\n", name, f->last,
            f->max_abs, f->amplitude, f->rate, f->rate_low, f->rate_high, exponent,
            is_stated ? dal_size_text(f->size) : "-", cli_trend_text(f, text, sizeof text));
}

void summary_print(FILE *out, const run_recorder *r)
{
    const run_request *request = r->request;
    char method[128];
    dal_method_name(&request->method, method, sizeof method);
    fprintf(out, "%s, %s, %s, h = %g: t = %g, %lld rows\n", request->system_name, method,
            request->options.space == DAL_LIFTED ? "lifted" : "physical", request->options.step,
            dal_run_time(request->run), r->position.row);
    fprintf(out, "%lld steps, %lld evaluations, %.1f ns per step\n", dal_run_steps(request->run),
            dal_run_evaluations(request->run), nanoseconds(r));
    fprintf(out, "%-12s %14s %10s %10s %10s %21s %8s %9s  %s\n", "", "final", "max | |",
            "amplitude", "rate", "", "exponent", "size", "trend");
    for (int i = 0; i < r->observables; i++)
        print_observable(out, recorder_observable_name(r, i), &r->trend[i]);
}

int summary_write(const run_recorder *r, const char *path)
{
    char *text;
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    fprintf(out, "observable,first,final,maximum,deviation,%s\n", cli_trend_heads);
    for (int i = 0; i < r->observables; i++) {
        const dal_trend *f = &r->trend[i];
        const double numbers[] = {f->first, f->last, f->max_abs, f->deviation};
        cli_put_text(out, recorder_observable_name(r, i));
        for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
            fputc(',', out);
            cli_put(out, numbers[k]);
        }
        cli_put_trend(out, f);
        fputc('\n', out);
    }
    cli_memstream_close(out);
    const int status = file_replace(path, text, length, r->dir->sync);
    free(text);
    return status;
}
