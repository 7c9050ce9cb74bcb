/* explain.c - `dalembert explain`: what the drift of a run comes from. */
#include "run/native.h"
#include "run/request.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* name, value, default, help */
#define OWN_LIST(X)                                                                                \
    X("long-steps", "N", "10000", "spend long numbers on the first N steps; 0: on none")           \
    X("output", "FILE.csv|-", NULL, "write a CSV file, or CSV to standard output")                 \
    X("native", "auto|on|off", "auto", "step runs in doubles by compiled code")

enum { OWN_LONG_STEPS = REQUEST_OPTIONS, OWN_OUTPUT, OWN_NATIVE, OPTIONS, MOST_STEPS = 2000000000 };

static const char notes[] =
    "Runs the system once more in several ways that differ in one thing each: half the step,\n"
    "equations solved less far and further, plain sums, long numbers (113 binary digits where the\n"
    "machine has them), with and without projection.  Of every observable's drift it says how\n"
    "much is truncation, rounding of coefficients, the solver, rounding, and what projection "
    "does,\n"
    "and how that was found; '?' is what these runs cannot tell apart.\n"
    "\n"
    "The shares of the first four add up to 1 where rates are compared.  They hold for the first\n"
    "--long-steps steps, long numbers being a hundred times slower.\n";

typedef struct wishes {
    long long early;
    const char *output;
    native_mode native;
    const run_request *request;
} wishes;

/* ---- while it goes ---- */

static dal_status step(void *user, double done)
{
    (void)user;
    cli_progress("%.0f %%", 100.0 * done);
    return cli_interrupted() ? DAL_INTERRUPTED : DAL_OK;
}

static void begin(void *user, dal_run *run, long long steps)
{
    const wishes *w = user;
    native_compile_steps(run, &w->request->method, (double)steps, w->native);
}

/* ---- in words ---- */

static void print_rate(const dal_trend *f, double whole)
{
    printf("%+10.2e (%+.1e %+.1e)  %9.2e", f->rate, f->rate_low, f->rate_high, f->deviation);
    if (whole > 0.0 && isfinite(whole)) printf("  x %.3g", f->deviation / whole);
    putchar('\n');
}

static const char *text_of(const dal_explanation *e, int twin)
{
    if (twin == DAL_TWIN_PROJECTION) return e->projects ? "without projection" : "with +project";
    if (twin != DAL_TWIN_SUMS) return dal_twin_text((dal_twin)twin);
    return e->spec.options.sums == DAL_SUMS_PLAIN ? "compensated sums" : "plain sums";
}

static void print_twins(const dal_explanation *e, const dal_attribution *a)
{
    for (int k = 0; k < DAL_TWINS; k++) {
        if (k == DAL_TWIN_LONG && e->early > 0) {
            printf("    the first %-38lld ", e->early);
            print_rate(&a->early, 0.0);
        }
        if (!e->ran[k]) continue;
        printf("      %-46s ", text_of(e, k));
        print_rate(&a->twin[k], k < DAL_TWIN_LONG ? a->all.deviation : a->early.deviation);
    }
}

static void print_cause(const dal_explanation *e, int i, dal_cause cause)
{
    const double share = e->of[i].share[cause], margin = e->of[i].margin[cause];
    char words[512], number[64];
    if (isnan(share))
        snprintf(number, sizeof number, "?");
    else if (isnan(margin))
        snprintf(number, sizeof number, "%.3g", share);
    else
        snprintf(number, sizeof number, "%.3g +- %.1g", share, margin);
    printf("    %-13s %-17s  %s\n", dal_cause_name(cause), number,
           dal_cause_words(e, i, cause, words, sizeof words));
}

static void print_one(const dal_explanation *e, int i)
{
    const dal_attribution *a = &e->of[i];
    char text[128];
    cli_trend_text(&a->all, text, sizeof text);
    if (a->all.conservation == DAL_CONSERVED)
        printf("%s: size %s, trend %s\n", a->name, dal_size_text(a->all.size), text);
    else
        printf("%s: %s\n", a->name, text);
    for (int k = 0; k < DAL_CAUSES; k++) print_cause(e, i, (dal_cause)k);
    printf("    %-48s %-31s %10s\n", "", "rate", "deviation");
    printf("    all %-44lld ", e->steps);
    print_rate(&a->all, 0.0);
    print_twins(e, a);
    putchar('\n');
}

static void print_exact(const dal_explanation *e)
{
    const char *before = "exact: ";
    for (int i = 0; i < e->observables; i++) {
        if (e->of[i].all.deviation > 0.0) continue;
        printf("%s%s", before, e->of[i].name);
        before = ", ";
    }
    if (*before == ',') putchar('\n');
}

static int print_all(const run_request *request, const dal_explanation *e)
{
    char method[128];
    printf("%s, %s, %s, h = %g: %lld steps", request->system_name,
           dal_method_name(&request->method, method, sizeof method),
           request->options.space == DAL_LIFTED ? "lifted" : "physical", request->options.step,
           e->steps);
    if (e->early > 0) printf(", the first %lld in long numbers too", e->early);
    fputs("\n\n", stdout);
    for (int i = 0; i < e->observables; i++)
        if (e->of[i].all.deviation > 0.0) print_one(e, i);
    print_exact(e);
    for (int k = 0; k < DAL_TWINS; k++)
        if (!e->ran[k] && *e->why[k]) printf("not run: %s: %s\n", text_of(e, k), e->why[k]);
    return cli_close(stdout, "standard output");
}

/* ---- as CSV ---- */

static void put_numbers(FILE *out, const double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        fputc(',', out);
        if (!isnan(numbers[i])) cli_put(out, numbers[i]);
    }
}

static void put_run(FILE *out, const char *observable, const char *name, long long steps,
                    const dal_trend *f)
{
    const double numbers[] = {f->rate, f->rate_low, f->rate_high, f->deviation};
    cli_put_text(out, observable);
    fprintf(out, ",run,%s,%lld,,", name, steps);
    put_numbers(out, numbers, 4);
    fprintf(out, ",%s,%s,", cli_size_word(f), cli_trend_word(f));
    if (f->conservation == DAL_CONSERVED) cli_put(out, f->confidence);
    fputs(",\n", out);
}

static void put_cause(FILE *out, const dal_explanation *e, int i, dal_cause cause)
{
    const dal_attribution *a = &e->of[i];
    const double numbers[] = {a->share[cause], a->margin[cause]};
    char words[512];
    cli_put_text(out, a->name);
    fprintf(out, ",cause,%s,%lld", dal_cause_name(cause),
            cause == DAL_CAUSE_PROJECTION || e->early == 0 ? e->steps : e->early);
    put_numbers(out, numbers, 2);
    fputs(",,,,,,,,", out);
    cli_put_text(out, dal_cause_words(e, i, cause, words, sizeof words));
    fputc('\n', out);
}

static void put_all(FILE *out, const dal_explanation *e)
{
    fputs("observable,kind,name,steps,share,margin,rate,rate_low,rate_high,deviation,size,trend,"
          "confidence,words\n",
          out);
    for (int i = 0; i < e->observables; i++) {
        const dal_attribution *a = &e->of[i];
        put_run(out, a->name, "all", e->steps, &a->all);
        if (e->early > 0) put_run(out, a->name, "early", e->early, &a->early);
        for (int k = 0; k < DAL_TWINS; k++)
            if (e->ran[k])
                put_run(out, a->name, dal_twin_name((dal_twin)k),
                        k < DAL_TWIN_LONG ? e->steps : e->early, &a->twin[k]);
        for (int k = 0; k < DAL_CAUSES; k++) put_cause(out, e, i, (dal_cause)k);
    }
}

static int write_csv(const char *path, const dal_explanation *e)
{
    const int is_stdout = strcmp(path, "-") == 0;
    FILE *out = is_stdout ? stdout : fopen(path, "w");
    if (!out) return cli_io("create", path);
    put_all(out, e);
    return cli_close(out, is_stdout ? "standard output" : path);
}

/* ---- the command ---- */

static int explain(run_request *request, wishes *w)
{
    dal_run_spec spec;
    dal_explanation *e = NULL;
    dal_error error = {0};
    int status = request_make_spec(request, &spec);
    if (status != CLI_DONE) return status;
    const double steps = nearbyint(request->time / request->options.step);
    if (!(steps <= MOST_STEPS))
        return cli_fail(CLI_USAGE, "%.3g steps: at most %d are explained", steps, MOST_STEPS);
    const dal_explain_observer observer = {w, step, begin};
    cli_catch_signals();
    const dal_status done = dal_explain(&spec, (long long)steps, w->early, &observer, &e, &error);
    cli_progress_end();
    if (done != DAL_OK) return cli_error(cli_exit(done), request->system_name, &error);
    status = w->output ? write_csv(w->output, e) : print_all(request, e);
    dal_explanation_free(e);
    return status;
}

static int take(run_request *request, wishes *w, int option, const char *value)
{
    switch (option) {
    case CLI_PLAIN:
        if (request->system_name)
            return cli_fail(CLI_USAGE, "explain: one SYSTEM only, not also '%s'", value);
        request->system_name = value;
        return CLI_DONE;
    case OWN_LONG_STEPS:
        return cli_integer("--long-steps", value, 0, MOST_STEPS, &w->early);
    case OWN_OUTPUT:
        if (strcmp(value, "-") != 0 && !cli_ends_in(value, ".csv"))
            return cli_fail(CLI_USAGE, "--output: '%s' does not end in .csv", value);
        w->output = value;
        return CLI_DONE;
    case OWN_NATIVE:
        return native_parse(value, &w->native);
    default:
        return request_parse_option(request, option, value);
    }
}

/* There are no rows, and the twins differ in precision themselves. */
static int is_of_rows(int option)
{
    switch (option) {
    case REQUEST_samples:
    case REQUEST_sampling:
    case REQUEST_times:
    case REQUEST_statistics:
    case REQUEST_precision:
        return 1;
    default:
        return 0;
    }
}

int command_explain(int argc, char **argv)
{
    static const cli_option own[] = {
#define X(name, value, initial, help) {name, value, help, initial},
        OWN_LIST(X)
#undef X
    };
    cli_option all[OPTIONS], options[OPTIONS];
    int option[OPTIONS], count = 0;
    request_list_options(all);
    memcpy(all + REQUEST_OPTIONS, own, sizeof own);
    for (int k = 0; k < OPTIONS; k++) {
        if (is_of_rows(k)) continue;
        options[count] = all[k];
        option[count++] = k;
    }
    cli_args args = cli_begin(argc, argv, options, count, notes);
    run_request request = request_default();
    wishes w = {.early = 10000, .request = &request};
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        const int taken = take(&request, &w, k == CLI_PLAIN ? k : option[k], value);
        if (taken != CLI_DONE) cli_stop(&args, taken);
    }
    int status = args.status;
    if (status == CLI_GO_ON) status = request_create_run(&request);
    if (args.status == CLI_GO_ON && status == CLI_DONE) status = explain(&request, &w);
    request_free(&request);
    return status;
}
