/* explain.c - the error sources of the drift of a run, in words, as CSV and as JSON. */
#include "explain.h"
#include "analysis.h"
#include "dalembert_budget.h"
#include "dalembert_predict.h"
#include "io/csv_cells.h"
#include "io/file_output.h"
#include "io/text.h"
#include "io/trend.h"
#include "run/request_json.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"
#include "ui/wrap.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- while it runs ---- */

typedef struct explanation {
    const explain_settings *settings;
    native_run native; /* the last run that was begun */
} explanation;

static dal_status show_progress(void *user, double done)
{
    explanation *e = user; /* NULL: no run is compiled */
    if (e) native_poll(&e->native);
    cli_progress("%.0f %%", 100.0 * done);
    return cli_interrupted() ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

static void compile_run(void *user, dal_run *run, long long steps)
{
    explanation *e = user;
    const double end = (double)steps * dal_run_step_size(run);
    e->native = native_begin(run, end, 0.0, 1.0, e->settings->native);
}

/* ---- sentences and shares ---- */

/* Observables that are listed without --details: with the rest some 24 lines. */
enum { MAX_PREDICTED = 1000000 /* steps; more take long */ };
enum { MAX_LISTED = 6, NAME_WIDTH = 12, CELL_SIZE = 16, MIN_COLUMN = 7, LINE = 80 };

static bool is_changed(const dal_error_budget *e, int i)
{
    return !(e->shares[i].whole.deviation == 0.0);
}

/* The length of the longest name that has at most `limit` characters. */
static int width_of_names(const dal_error_budget *e, const int *list, int count, int limit)
{
    int width = 0;
    for (int k = 0; k < count; k++) {
        const int length = (int)strlen(e->shares[list[k]].name);
        if (length > width && length <= limit) width = length;
    }
    return width;
}

static void print_sentences(const dal_error_budget *e, const int *list, int count)
{
    const int width = width_of_names(e, list, count, NAME_WIDTH);
    for (int k = 0; k < count; k++) {
        char words[512];
        const int column = printf("%-*s ", width, e->shares[list[k]].name);
        char *text = cli_format("%s.", dal_error_budget_summarise(e, list[k], words, sizeof words));
        cli_wrap(stdout, text, column, width + 1);
        free(text);
    }
}

/* A share in percent: -: none, ?: unknown. */
static const char *share_text(double share, char *buffer)
{
    if (isnan(share)) return "?";
    if (share == 0.0) return "-";
    if (share < 0.001) return "< 0.1 %";
    snprintf(buffer, CELL_SIZE, "%.2g %%", share < 0.995 ? 100.0 * share : 100.0);
    return share < 0.995 ? buffer : "100 %";
}

/* A drift with, or without, projection, over the drift of the run. */
static double projected_ratio(const dal_shares *a)
{
    const dal_trend *other = &a->comparison[DAL_COMPARISON_PROJECTION], *whole = &a->whole;
    if (!(a->share[DAL_SOURCE_PROJECTION] == 0.0)) return 1.0 - a->share[DAL_SOURCE_PROJECTION];
    return a->whole_by_rate ? fabs(other->rate / whole->rate) : other->deviation / whole->deviation;
}

static const char *ratio_text(double ratio, char *buffer)
{
    if (isnan(ratio)) return "-";
    snprintf(buffer, CELL_SIZE, "%.1g", ratio);
    return buffer;
}

/* Prints a sentence that lists items, and frees them; nothing without items. */
static void print_items(const char *head, char *items, const char *end)
{
    char *text = cli_format("%s %s%s", head, items ? items : "", end);
    if (items) cli_wrap(stdout, text, 0, 4);
    free(text);
    free(items);
}

/* What +project makes of the drifts that it removes. */
static void print_projection(const dal_error_budget *e, const int *list, int count)
{
    char *items = NULL;
    if (!e->ran[DAL_COMPARISON_PROJECTION] || e->has_projection) count = 0;
    for (int k = 0; k < count; k++) {
        const dal_shares *a = &e->shares[list[k]];
        char cell[CELL_SIZE];
        if (a->whole.size != DAL_SIZE_LARGER || !(a->share[DAL_SOURCE_PROJECTION] >= 0.5)) continue;
        const bool is_rounding =
            a->is_conserved && a->comparison[DAL_COMPARISON_PROJECTION].size != DAL_SIZE_LARGER;
        char *item = is_rounding ? cli_format("%s at rounding", a->name)
                                 : cli_format("%s at %s of this", a->name,
                                              ratio_text(projected_ratio(a), cell));
        items = text_append_item(items, ", ", item);
        free(item);
    }
    print_items("With +project:", items, ".");
}

/* What `predict` says of a quantity; NULL: nothing. */
static const dal_predicted *find_predicted(const dal_prediction *from, const char *name)
{
    for (int i = 0; from && i < from->observables; i++)
        if (strcmp(from->predicted[i].name, name) == 0 && from->predicted[i].is_conserved)
            return &from->predicted[i];
    return NULL;
}

/* The changes predicted from single steps, beside the run's. */
static void print_predicted(const dal_error_budget *e, const dal_prediction *from, const int *list,
                            int count)
{
    char *items = NULL;
    for (int k = 0; k < count; k++) {
        const dal_shares *a = &e->shares[list[k]];
        const dal_predicted *q = find_predicted(from, a->name);
        if (!q || a->whole.size != DAL_SIZE_LARGER) continue;
        char *item =
            cli_format("%s %.3g (run %.3g)", a->name, q->change, a->whole.last - a->whole.first);
        items = text_append_item(items, ", ", item);
        free(item);
    }
    print_items("Predicted by single steps:", items, ".");
}

/* Whether a source has a column: truncation and rounding always, others where they have a part. */
static bool has_column(const dal_error_budget *e, const int *list, int count,
                       dal_error_source source)
{
    bool found = source == DAL_SOURCE_TRUNCATION || source == DAL_SOURCE_ROUNDING;
    for (int k = 0; k < count && !found; k++) {
        const double share = e->shares[list[k]].share[source];
        found = source == DAL_SOURCE_PROJECTION ? !isnan(share) : share != 0.0;
    }
    return found && !(source == DAL_SOURCE_PROJECTION && !e->ran[DAL_COMPARISON_PROJECTION]);
}

static const char *head_of(const dal_error_budget *e, dal_error_source source)
{
    if (source != DAL_SOURCE_PROJECTION) return dal_error_source_name(source);
    return e->has_projection ? "unprojected" : "+project";
}

static int width_of(const dal_error_budget *e, dal_error_source source)
{
    const int width = (int)strlen(head_of(e, source));
    return width > MIN_COLUMN ? width : MIN_COLUMN;
}

static const char *cell_text(const dal_shares *a, dal_error_source source, char cell[CELL_SIZE])
{
    return source == DAL_SOURCE_PROJECTION ? ratio_text(projected_ratio(a), cell)
                                           : share_text(a->share[source], cell);
}

static void print_shares(const dal_error_budget *e, const int *list, int count)
{
    dal_error_source shown[DAL_ERROR_SOURCES];
    int columns = 0, rest = LINE - 2;
    for (dal_error_source s = 0; s < DAL_ERROR_SOURCES; s++) {
        if (!has_column(e, list, count, s)) continue;
        shown[columns++] = s;
        rest -= 2 + width_of(e, s);
    }
    const int width = 2 + width_of_names(e, list, count, rest);
    printf("%*s", width, "");
    for (int c = 0; c < columns; c++) printf("  %*s", width_of(e, shown[c]), head_of(e, shown[c]));
    putchar('\n');
    for (int k = 0; k < count; k++) {
        const dal_shares *a = &e->shares[list[k]];
        if (printf("  %-*s", width - 2, a->name) > width) printf("\n%*s", width, "");
        for (int c = 0; c < columns; c++) {
            char cell[CELL_SIZE];
            printf("  %*s", width_of(e, shown[c]), cell_text(a, shown[c], cell));
        }
        putchar('\n');
    }
}

/* The names of what never changed. */
static void print_exact(const dal_error_budget *e)
{
    char *items = NULL;
    for (int i = 0; i < e->observables; i++)
        if (!is_changed(e, i)) items = text_append_item(items, ", ", e->shares[i].name);
    print_items("exact:", items, "");
}

/* ---- the details ---- */

/* A row of the table of runs, 80 columns wide; a long label has a line of its own. */
enum { RATE_COLUMN = 30, WORDS_COLUMN = 35 };

static void print_run(const char *label, const dal_trend *f, double whole)
{
    int column = printf("%s", label);
    if (column > RATE_COLUMN - 1) {
        putchar('\n');
        column = 0;
    }
    printf("%*s%+10.2e (%+.1e %+.1e) %8.2e", RATE_COLUMN - column, "", f->rate, f->rate_low,
           f->rate_high, f->deviation);
    if (whole > 0.0 && isfinite(whole)) printf(" x %.3g", f->deviation / whole);
    putchar('\n');
}

static const char *comparison_text(const dal_error_budget *e, dal_comparison_run comparison)
{
    if (comparison == DAL_COMPARISON_HALVED && e->spec.options.tolerance > 0.0)
        return "substeps half as long";
    if (comparison == DAL_COMPARISON_PROJECTION)
        return e->has_projection ? "without projection" : "with +project";
    if (comparison != DAL_COMPARISON_SUMS) return dal_comparison_text(comparison);
    return e->spec.options.sums == DAL_SUMS_PLAIN ? "compensated sums" : "plain sums";
}

static void print_observable(const dal_error_budget *e, int i)
{
    const dal_shares *a = &e->shares[i];
    char text[128];
    cli_trend_text(&a->whole, text, sizeof text);
    const bool is_stated = a->whole.conservation == DAL_CONSERVED;
    char *head = cli_format("%s: %s%s%s%s", a->name, is_stated ? "size " : "",
                            is_stated ? dal_size_text(a->whole.size) : "",
                            is_stated ? ", trend " : "", text);
    putchar('\n');
    cli_wrap(stdout, head, 0, 4);
    free(head);
    for (dal_error_source k = 0; k < DAL_ERROR_SOURCES; k++) {
        char words[512], number[64] = "?";
        int length = 0;
        if (!isnan(a->share[k]))
            length = snprintf(number, sizeof number, "%.3g %%", 100.0 * a->share[k]);
        if (length > 0 && !isnan(a->margin[k]))
            snprintf(number + length, sizeof number - (size_t)length, " +- %.1g",
                     100.0 * a->margin[k]);
        const int column = printf("  %-13s %-17s  ", dal_error_source_name(k), number);
        cli_wrap(stdout, dal_error_budget_describe(e, i, k, words, sizeof words), column,
                 WORDS_COLUMN);
    }
    printf("%*s %-29s %9s\n", RATE_COLUMN, "", "rate, 95 % interval", "deviation");
    snprintf(text, sizeof text, "  all %lld", e->steps);
    print_run(text, &a->whole, 0.0);
    for (dal_comparison_run k = 0; k < DAL_COMPARISONS; k++) {
        if (k == DAL_COMPARISON_QUAD && e->quad_steps > 0) {
            snprintf(text, sizeof text, "  the first %lld", e->quad_steps);
            print_run(text, &a->beginning, 0.0);
        }
        if (!e->ran[k]) continue;
        snprintf(text, sizeof text, "    %s", comparison_text(e, k));
        print_run(text, &a->comparison[k],
                  k < DAL_COMPARISON_QUAD ? a->whole.deviation : a->beginning.deviation);
    }
}

/* What was run, and where the exact motion comes from, or why it is estimated. */
static void print_runs(const explain_settings *s, const dal_error_budget *e)
{
    char method[128], tolerance[32] = "", quad[64] = "";
    const run_request *request = &s->simulation.request;
    if (request->options.tolerance > 0.0)
        snprintf(tolerance, sizeof tolerance, ", tolerance %g", request->options.tolerance);
    if (e->quad_steps > 0)
        snprintf(quad, sizeof quad, ", the first %lld in quad precision too", e->quad_steps);
    char *text = cli_format("%s, %s, %s, h = %g%s: %lld steps%s; %s%s%s", request->system_name,
                            dal_method_name(&request->method, method, sizeof method),
                            request->options.space == DAL_LIFTED ? "lifted" : "physical",
                            request->options.step, tolerance, e->steps, quad,
                            e->ran[DAL_COMPARISON_EXACT] ? "reference: dop853 to 1e-16"
                                                         : "no exact motion: ",
                            e->ran[DAL_COMPARISON_EXACT] ? "" : e->reason[DAL_COMPARISON_EXACT],
                            s->details ? "" : ".  The runs compared: --details");
    cli_wrap(stdout, text, 0, 4);
    free(text);
}

/* The sentences and the shares for a document. */
static int print_document(const explain_settings *s, const dal_error_budget *e)
{
    screen out;
    screen_table t = {.columns = 1, .heads = 1};
    int *list = cli_calloc((size_t)e->observables + 1, sizeof *list), count = 0;
    for (int i = 0; i < e->observables; i++)
        if (is_changed(e, i)) list[count++] = i;
    screen_open(&out, stdout, s->format);
    screen_add_cell(&t, SCREEN_PLAIN, "quantity");
    for (dal_error_source k = 0; k < DAL_ERROR_SOURCES; k++) {
        if (!has_column(e, list, count, k)) continue;
        screen_add_cell(&t, SCREEN_PLAIN, "%s", head_of(e, k));
        t.columns++;
    }
    for (int i = 0; i < count; i++) {
        const dal_shares *a = &e->shares[list[i]];
        char words[512], cell[CELL_SIZE];
        screen_say(&out, 0, "%s %s.", a->name,
                   dal_error_budget_summarise(e, list[i], words, sizeof words));
        screen_add_cell(&t, SCREEN_PLAIN, "%s", a->name);
        for (dal_error_source k = 0; k < DAL_ERROR_SOURCES; k++)
            if (has_column(e, list, count, k))
                screen_add_cell(&t, SCREEN_PLAIN, "%s", cell_text(a, k, cell));
    }
    screen_add_table(&out, &t, "lr", 0);
    screen_free_table(&t);
    free(list);
    return screen_close(&out, NULL);
}

static void print_budget(const explain_settings *s, const dal_error_budget *e)
{
    int *list = cli_calloc((size_t)e->observables + 1, sizeof *list);
    int all = 0;
    for (int i = 0; i < e->observables; i++)
        if (is_changed(e, i)) list[all++] = i;
    const int count = s->details || all < MAX_LISTED ? all : MAX_LISTED;
    print_sentences(e, list, count);
    if (all > count) printf("... and %d more: --details\n", all - count);
    print_projection(e, list, count);
    print_predicted(e, s->predicted, list, count);
    if (count > 0) {
        putchar('\n');
        print_shares(e, list, count);
    }
    print_exact(e);
    print_runs(s, e);
    for (int k = 0; s->details && k < all; k++) print_observable(e, list[k]);
    for (dal_comparison_run k = 0; s->details && k < DAL_COMPARISONS; k++) {
        if (e->ran[k] || !*e->reason[k]) continue;
        char *text = cli_format("not run: %s: %s", comparison_text(e, k), e->reason[k]);
        cli_wrap(stdout, text, 0, 4);
        free(text);
    }
    free(list);
}

/* ---- as CSV ---- */

/* The steps that a comparison and a share are about. */
static long long steps_of_run(const dal_error_budget *e, dal_comparison_run comparison)
{
    return comparison < DAL_COMPARISON_QUAD ? e->steps : e->quad_steps;
}

static long long steps_of_share(const dal_error_budget *e, dal_error_source source)
{
    return source == DAL_SOURCE_PROJECTION || e->quad_steps == 0 ? e->steps : e->quad_steps;
}

static void write_run(FILE *out, const char *observable, const char *name, long long steps,
                      const dal_trend *f)
{
    const double numbers[] = {f->rate, f->rate_low, f->rate_high, f->deviation};
    csv_put_text(out, observable);
    fprintf(out, ",run,%s,%lld,,", name, steps);
    csv_put_cells(out, numbers, 4);
    fprintf(out, ",%s,%s,", cli_size_word(f), cli_trend_word(f));
    if (f->conservation == DAL_CONSERVED) csv_put_known(out, f->confidence);
    fputs(",\n", out);
}

static void write_observable(FILE *out, const dal_error_budget *e, int i)
{
    const dal_shares *a = &e->shares[i];
    char words[512];
    write_run(out, a->name, "all", e->steps, &a->whole);
    if (e->quad_steps > 0) write_run(out, a->name, "first-steps", e->quad_steps, &a->beginning);
    for (dal_comparison_run k = 0; k < DAL_COMPARISONS; k++)
        if (e->ran[k])
            write_run(out, a->name, dal_comparison_name(k), steps_of_run(e, k), &a->comparison[k]);
    for (dal_error_source k = 0; k < DAL_ERROR_SOURCES; k++) {
        const double numbers[] = {a->share[k], a->margin[k]};
        csv_put_text(out, a->name);
        fprintf(out, ",source,%s,%lld", dal_error_source_name(k), steps_of_share(e, k));
        csv_put_cells(out, numbers, 2);
        fputs(",,,,,,,,", out);
        csv_put_text(out, dal_error_budget_describe(e, i, k, words, sizeof words));
        fputc('\n', out);
    }
}

static int write_budget(const char *path, const dal_error_budget *e)
{
    file_output output;
    const int status = file_output_open(&output, path);
    if (status != CLI_DONE) return status;
    FILE *out = output.stream;
    fputs("observable,kind,name,steps,share,margin,rate,rate_low,rate_high,deviation,size,trend,"
          "confidence,words\n",
          out);
    for (int i = 0; i < e->observables; i++) write_observable(out, e, i);
    return file_output_close(&output, CLI_DONE);
}

/* ---- as JSON ---- */

static void put_run(json_writer *w, const char *name, long long steps, const dal_trend *f)
{
    json_open(w, NULL, JSON_ON_ONE_LINE);
    json_put_text(w, "name", name);
    json_put_integer(w, "steps", steps);
    json_put_number(w, "deviation", f->deviation);
    cli_put_trend(w, f);
    json_close(w);
}

static void put_source(json_writer *w, const dal_error_budget *e, int i, dal_error_source source)
{
    char words[512];
    const dal_shares *a = &e->shares[i];
    json_open(w, NULL, JSON_ON_ONE_LINE);
    json_put_text(w, "name", dal_error_source_name(source));
    json_put_integer(w, "steps", steps_of_share(e, source));
    json_put_number(w, "share", a->share[source]);
    json_put_number(w, "margin", a->margin[source]);
    json_put_text(w, "words", dal_error_budget_describe(e, i, source, words, sizeof words));
    json_close(w);
}

static void put_observable(json_writer *w, const dal_error_budget *e, int i,
                           const dal_predicted *predicted)
{
    const dal_shares *a = &e->shares[i];
    json_open(w, NULL, JSON_LINES);
    char words[512];
    json_put_text(w, "name", a->name);
    json_put_text(w, "sentence", dal_error_budget_summarise(e, i, words, sizeof words));
    json_put_bool(w, "is_conserved", a->is_conserved != 0);
    json_put_number(w, "order", a->order);
    json_open_list(w, "runs", JSON_LINES);
    put_run(w, "all", e->steps, &a->whole);
    if (e->quad_steps > 0) put_run(w, "first-steps", e->quad_steps, &a->beginning);
    for (dal_comparison_run k = 0; k < DAL_COMPARISONS; k++)
        if (e->ran[k]) put_run(w, dal_comparison_name(k), steps_of_run(e, k), &a->comparison[k]);
    json_close(w);
    json_open_list(w, "sources", JSON_LINES);
    for (dal_error_source k = 0; k < DAL_ERROR_SOURCES; k++) put_source(w, e, i, k);
    json_close(w);
    json_put_number(w, "predicted", predicted ? predicted->change : NAN);
    json_close(w);
}

static void put_budget(const explain_settings *s, const dal_error_budget *e)
{
    json_writer w = json_begin_results("explain");
    request_open_json(&w, &s->simulation, EXPLAIN_WITHOUT);
    json_close(&w);
    json_put_integer(&w, "steps", e->steps);
    json_put_integer(&w, "quad_steps", e->quad_steps);
    json_open_list(&w, "observables", JSON_LINES);
    for (int i = 0; i < e->observables; i++)
        put_observable(&w, e, i, find_predicted(s->predicted, e->shares[i].name));
    json_close(&w);
    json_open_list(&w, "not_run", JSON_LINES);
    for (dal_comparison_run k = 0; k < DAL_COMPARISONS; k++) {
        if (e->ran[k] || !*e->reason[k]) continue;
        json_open(&w, NULL, JSON_ON_ONE_LINE);
        json_put_text(&w, "name", dal_comparison_name(k));
        json_put_text(&w, "reason", e->reason[k]);
        json_close(&w);
    }
    json_close(&w);
    json_end_results(&w);
}

/* ---- all ---- */

int explain_run(explain_settings *s)
{
    dal_run_spec spec;
    dal_error_budget *e = NULL;
    dal_error error = {0};
    int status = analysis_check_output(s->output, s->json);
    if (status == CLI_DONE) status = screen_check_format(s->format, "--json", s->json);
    if (status == CLI_DONE) status = screen_check_format(s->format, "--details", s->details);
    if (status == CLI_DONE) status = request_check_forward(&s->simulation.request);
    if (status == CLI_DONE) status = simulation_create(&s->simulation);
    if (status == CLI_DONE) status = simulation_make_spec(&s->simulation, &spec);
    if (status != CLI_DONE) return status;
    const double steps = nearbyint((s->simulation.end - s->simulation.request.from) /
                                   s->simulation.request.options.step);
    if (!(steps <= EXPLAIN_MAX_STEPS))
        return cli_fail(CLI_USAGE, "%.3g steps: explain takes at most %d", steps,
                        EXPLAIN_MAX_STEPS);
    explanation explained = {.settings = s};
    const dal_error_budget_observer observer = {&explained, show_progress, compile_run};
    cli_catch_signals();
    const dal_status done =
        dal_error_budget_create(&e, &spec, (long long)steps, s->quad_steps, &observer, &error);
    const dal_predict_observer ahead = {NULL, show_progress};
    if (done == DAL_STATUS_OK && steps <= MAX_PREDICTED &&
        cli_is_ok(
            dal_predict_create(&s->predicted, &spec, s->simulation.end, NULL, &ahead, NULL)) &&
        s->predicted->reason != DAL_PREDICTION_TIME) {
        dal_prediction_free(s->predicted); /* it does not reach the end of the run */
        s->predicted = NULL;
    }
    cli_progress_end();
    if (done != DAL_STATUS_OK)
        return cli_error(cli_exit(done), s->simulation.request.system_name, &error);
    status = s->output ? write_budget(s->output, e) : CLI_DONE;
    if (status == CLI_DONE && s->format != SCREEN_TEXT) {
        status = print_document(s, e);
    } else if (status == CLI_DONE && (s->json || !s->output)) {
        (s->json ? put_budget : print_budget)(s, e);
        status = cli_close(stdout, "standard output");
    }
    dal_prediction_free(s->predicted);
    s->predicted = NULL;
    dal_error_budget_free(e);
    return status;
}
