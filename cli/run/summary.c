/* summary.c - size and trend of each observable over a run. */
#include "summary.h"

#include "io/trend.h"

#include <math.h>

void summary_print(FILE *out, const run_simulation *simulation, const run_results *r)
{
    const run_request *request = &simulation->request;
    const dal_run *run = simulation->run;
    const long long steps = dal_run_steps(run);
    char method[128];
    dal_method_name(&request->method, method, sizeof method);
    fprintf(out, "%s, %s, %s, h = %g: t = %g, %lld rows\n", request->system_name, method,
            request->options.space == DAL_LIFTED ? "lifted" : "physical", request->options.step,
            dal_run_time(run), r->position.row);
    fprintf(out, "%lld steps, %lld evaluations, %.1f ns per step\n", steps,
            dal_run_evaluations(run), steps > 0 ? 1e9 * r->position.seconds / (double)steps : 0.0);
    fprintf(out, "%-12s %14s %10s %10s %10s %21s %8s %9s  %s\n", "", "final", "max | |",
            "amplitude", "rate", "", "exponent", "size", "trend");
    for (int i = 0; i < r->observables; i++) {
        char text[128], exponent[32] = "-";
        const dal_trend *f = &r->trend[i];
        const bool is_stated = f->conservation == DAL_CONSERVED;
        if (is_stated && !isnan(f->exponent))
            snprintf(exponent, sizeof exponent, "%.2f", f->exponent);
        fprintf(out, "%-12s %14.7g %10.3g %10.3g %+10.2e (%+.1e %+.1e) %8s %9s  %s\n", r->names[i],
                f->last, f->max_abs, f->amplitude, f->rate, f->rate_low, f->rate_high, exponent,
                is_stated ? dal_size_text(f->size) : "-", cli_trend_text(f, text, sizeof text));
    }
}

void summary_print_details(FILE *out, const run_results *r)
{
    enum { TIMES = 50 };
    int found = 0;
    for (int i = 0; i < r->observables; i++) {
        const dal_trend *f = &r->trend[i];
        const double range = dal_statistics_rate_range(&r->statistics[i]);
        if (f->conservation != DAL_CONSERVED || f->trend != DAL_TREND_LINEAR || isnan(range))
            continue;
        if (found++ == 0)
            fprintf(out, "rates in a run %d times as long, if the line bends on as in this one:\n",
                    TIMES);
        fprintf(out, "%-12s %+.1e to %+.1e\n", r->names[i], f->rate - (TIMES - 1) * range,
                f->rate + (TIMES - 1) * range);
    }
    if (found == 0) fprintf(out, "rates in a longer run: no trend is linear\n");
}
