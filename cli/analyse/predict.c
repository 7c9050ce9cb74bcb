/* predict.c - the drift of D, E and invariants by several methods, predicted before a run. */
#include "predict.h"
#include "analysis.h"
#include "dalembert_predict.h"
#include "io/csv_cells.h"
#include "io/file_output.h"
#include "run/request_json.h"
#include "ui/memory.h"
#include "ui/signals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ITEMS = 64, NAME = 128, DIGITS = 3 };

/* A method with a step, and what is predicted of it; or why nothing is. */
typedef struct prediction {
    dal_method method;
    double step;
    dal_prediction *of;
    dal_error error;
} prediction;

typedef struct predictions {
    const predict_settings *set;
    dal_run_spec spec;
    prediction *item;
    int count, now; /* which is made now */
    bool interrupted;
} predictions;

/* ---- the lists ----------------------------------------------------------------------------- */

/* Copies item number i of a list between commas; false past the last. */
static bool copy_item(const char *list, int i, char item[NAME])
{
    for (; i > 0; i--) {
        list = strchr(list, ',');
        if (!list) return false;
        list++;
    }
    snprintf(item, NAME, "%.*s", (int)strcspn(list, ","), list);
    return true;
}

static int add_steps(predictions *p, const dal_method *method)
{
    char item[NAME];
    const char *list = p->set->steps ? p->set->steps : "";
    const double single = p->spec.options.step;
    for (int i = 0; copy_item(list, i, item); i++) {
        double step = single;
        if (p->count == MAX_ITEMS)
            return cli_fail(CLI_USAGE, "more than %d methods and steps", MAX_ITEMS);
        if (p->set->steps && cli_number("--step", item, &step) != CLI_DONE) return CLI_USAGE;
        p->item[p->count++] = (prediction){.method = *method, .step = step};
    }
    return CLI_DONE;
}

static int list_methods(predictions *p)
{
    char item[NAME];
    const char *list = p->set->integrators ? p->set->integrators : "";
    int status = CLI_DONE;
    for (int i = 0; status == CLI_DONE && copy_item(list, i, item); i++) {
        dal_method method = p->spec.method;
        dal_error error = {0};
        if (p->set->integrators && dal_method_parse(&method, item, &error) != DAL_STATUS_OK)
            return cli_error(CLI_USAGE, NULL, &error);
        status = add_steps(p, &method);
    }
    return status;
}

/* Whether every start value is a coordinate's or a velocity's. */
static bool is_on_motion(const run_simulation *s)
{
    const request_settings *start = &s->request.start;
    for (int i = 0; i < start->count; i++) {
        const char *name = start->item[i].name;
        const size_t length = strcspn(name, "'");
        bool known = false;
        for (int k = 0; k < s->system->n; k++)
            known |= strlen(s->system->coordinate[k]) == length &&
                     strncmp(s->system->coordinate[k], name, length) == 0;
        if (!known) return false;
    }
    return true;
}

/* ---- predictions --------------------------------------------------------------------------- */

static dal_status report_done(void *user, double done)
{
    const predictions *p = user;
    char method[NAME];
    dal_method_name(&p->item[p->now].method, method, sizeof method);
    cli_progress("%s, h = %g: %.0f %%", method, p->item[p->now].step, 100.0 * done);
    return cli_interrupted() ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

/* Makes all; the exit status is 2 where none can be made, 130 where a signal ends them. */
static int predict_all(predictions *p)
{
    dal_predict_settings settings = {
        .pieces = p->set->pieces, .rows = p->set->samples, .quad_steps = p->set->quad_steps};
    const dal_predict_observer observer = {p, report_done};
    int made = 0;
    if (p->count > 1) { /* without it, predictions say the reason */
        dal_run_spec spec = p->spec;
        spec.options.step = p->item[0].step;
        dal_exact_motion_create(&settings.motion, &spec, 0, NULL);
    }
    for (p->now = 0; p->now < p->count && !cli_interrupted(); p->now++) {
        prediction *item = &p->item[p->now];
        dal_run_spec spec = p->spec;
        spec.method = item->method;
        spec.options.step = item->step;
        const dal_status status = dal_predict_create(&item->of, &spec, p->set->simulation.end,
                                                     &settings, &observer, &item->error);
        if (status == DAL_STATUS_MEMORY) cli_out_of_memory();
        made += status == DAL_STATUS_OK;
    }
    dal_exact_motion_free(settings.motion);
    cli_progress_end();
    p->interrupted = cli_interrupted();
    p->count = p->now;
    if (made > 0 || p->interrupted) return CLI_DONE;
    return cli_error(CLI_USAGE, p->set->simulation.request.system_name, &p->item[0].error);
}

/* ---- as a screen --------------------------------------------------------------------------- */

static void add_number(screen_table *t, double x)
{
    char text[SCREEN_NUMBER];
    if (isnan(x))
        screen_add_cell(t, SCREEN_FAINT, "-");
    else
        screen_add_cell(t, SCREEN_PLAIN, "%s", screen_number(text, x, DIGITS));
}

static void add_rate(screen_table *t, const dal_predicted *q)
{
    char x[2][SCREEN_NUMBER];
    screen_number(x[0], q->rate, DIGITS);
    screen_number(x[1], q->margin, 2);
    if (!q->is_conserved)
        screen_add_cell(t, SCREEN_FAINT, "the motion changes it");
    else if (q->is_zero)
        screen_add_cell(t, SCREEN_ROUNDING, "0 by reversibility");
    else if (isnan(q->rate))
        screen_add_cell(t, SCREEN_FAINT, "-");
    else if (fabs(q->rate) <= q->margin)
        screen_add_cell(t, SCREEN_PLAIN, "0 within %s", x[1]);
    else
        screen_add_cell(t, SCREEN_PLAIN, "%s +- %s", x[0], x[1]);
}

static void add_walk(screen_table *t, const dal_predicted *q)
{
    char x[2][SCREEN_NUMBER];
    if (isnan(q->walk))
        screen_add_cell(t, SCREEN_FAINT, "-");
    else
        screen_add_cell(t, SCREEN_PLAIN, "%s +- %s", screen_number(x[0], q->walk, DIGITS),
                        screen_number(x[1], q->walk_margin, 2));
}

static void add_quantities(screen *out, const dal_prediction *of)
{
    static const char *const heads[] = {"quantity", "at the end", "max", "per unit of t", "walk"};
    screen_table t = {.columns = of->pieces > 1 ? 5 : 4, .heads = 1};
    for (int i = 0; i < t.columns; i++) screen_add_cell(&t, SCREEN_PLAIN, "%s", heads[i]);
    for (const dal_predicted *q = of->predicted; q < of->predicted + of->observables; q++) {
        screen_add_cell(&t, SCREEN_PLAIN, "%s", q->name);
        add_number(&t, q->change);
        add_number(&t, q->max_change);
        add_rate(&t, q);
        if (t.columns == 5) add_walk(&t, q);
    }
    screen_add_table(out, &t, "lrrl", 2);
    screen_free_table(&t);
}

static void say_prediction(screen *out, const prediction *item)
{
    const dal_prediction *of = item->of;
    char method[NAME], x[4][SCREEN_NUMBER];
    dal_method_name(&item->method, method, sizeof method);
    if (!of) {
        screen_say(out, 2, "%s, h = %s: %s", method, screen_number(x[0], item->step, 4),
                   item->error.message);
        return;
    }
    screen_say(out, 2, "%s, h = %s: %s%s", method, screen_number(x[0], item->step, 4),
               of->leaves_D ? "leaves D = 0" : "steps end on D = 0",
               of->is_quad ? "; single steps in quad precision, each tens of times as long" : "");
    if (of->reason != DAL_PREDICTION_TIME)
        screen_say(out, 2, "The curve ends at t = %s: %s%s%s", screen_number(x[1], of->end, 4),
                   dal_prediction_end_text(of->reason), of->message[0] ? ": " : "", of->message);
    if (!isnan(of->in_phase))
        screen_say(out, 2, "What oscillates is in phase with the run, within 1 %%, to t = %s",
                   screen_number(x[1], of->in_phase, 4));
    if (of->pieces > 1)
        screen_say(out, 2, "Rates and walks are of %s pieces, walks within %s %% or more",
                   screen_count(x[2], of->pieces),
                   screen_number(x[3], 100.0 * sqrt(5.0 / (double)of->pieces), 2));
    add_quantities(out, of);
}

static int print_predictions(const predictions *p)
{
    const run_simulation *s = &p->set->simulation;
    const char *more = p->set->details ? NULL : "--details";
    char x[2][SCREEN_NUMBER];
    screen out;
    screen_open(&out, stdout, p->set->format);
    screen_say(&out, 2,
               "%s: changes predicted from t = %s to %s, by single steps on the exact motion",
               s->request.system_name, screen_number(x[0], s->request.from, 4),
               screen_number(x[1], s->end, 6));
    for (int i = 0; i < p->count; i++) {
        screen_skip(&out);
        say_prediction(&out, &p->item[i]);
    }
    return screen_close(&out, screen_has_reader() ? more : NULL);
}

/* ---- as JSON and CSV ----------------------------------------------------------------------- */

static void put_observable(json_writer *w, const dal_prediction *of, int i)
{
    const dal_predicted *q = &of->predicted[i];
    json_open(w, NULL, JSON_ON_ONE_LINE);
    json_put_text(w, "name", q->name);
    json_put_bool(w, "conserved", q->is_conserved);
    json_put_bool(w, "zero_by_reversibility", q->is_zero);
    json_put_number(w, "change", q->change);
    json_put_number(w, "max_change", q->max_change);
    json_put_number(w, "rate", q->rate);
    json_put_number(w, "margin", q->margin);
    json_put_number(w, "walk", q->walk);
    json_put_number(w, "walk_margin", q->walk_margin);
    json_open_list(w, "curve", JSON_ON_ONE_LINE);
    for (long long r = 0; r < of->rows; r++)
        json_put_number(w, NULL, of->change[r * of->observables + i]);
    json_close(w);
    json_close(w);
}

static void put_prediction(json_writer *w, const prediction *item)
{
    const dal_prediction *of = item->of;
    char method[NAME];
    json_open(w, NULL, JSON_LINES);
    json_put_text(w, "integrator", dal_method_name(&item->method, method, sizeof method));
    json_put_number(w, "step", item->step);
    json_put_text(w, "refused", of ? NULL : item->error.message);
    if (of) {
        json_put_number(w, "end", of->end);
        json_put_text(w, "end_reason", dal_prediction_end_name(of->reason));
        json_put_text(w, "message", of->message[0] ? of->message : NULL);
        json_put_number(w, "in_phase", of->in_phase);
        json_put_bool(w, "leaves_D", of->leaves_D);
        json_put_text(w, "precision", of->is_quad ? "quad" : "double");
        json_put_text(w, "exact_motion", of->has_series ? "taylor" : "dop853");
        json_put_number(w, "unit_of_time", of->unit_of_time);
        json_put_integer(w, "steps", of->steps);
        json_put_integer(w, "pieces", of->pieces);
        json_put_numbers(w, "t", of->t, of->rows);
        json_open_list(w, "observables", JSON_LINES);
        for (int i = 0; i < of->observables; i++) put_observable(w, of, i);
        json_close(w);
    }
    json_close(w);
}

static int print_json(const predictions *p)
{
    json_writer w = json_begin_results("predict");
    request_open_json(&w, &p->set->simulation, PREDICT_WITHOUT);
    json_put_integer(&w, "pieces", p->set->pieces);
    json_put_integer(&w, "quad_steps", p->set->quad_steps);
    json_close(&w);
    json_put_number(&w, "from", p->set->simulation.request.from);
    json_put_number(&w, "to", p->set->simulation.end);
    json_open_list(&w, "predictions", JSON_LINES);
    for (int i = 0; i < p->count; i++) put_prediction(&w, &p->item[i]);
    json_close(&w);
    json_end_results(&w);
    return cli_close(stdout, "standard output");
}

/* The curves, rows integrator,step,t and a change for each observable. */
static int write_curves(const predictions *p)
{
    file_output output;
    bool has_head = false;
    const int status = file_output_open(&output, p->set->output);
    if (status != CLI_DONE) return status;
    for (int i = 0; i < p->count; i++) {
        const dal_prediction *of = p->item[i].of;
        char method[NAME];
        if (!of) continue;
        dal_method_name(&p->item[i].method, method, sizeof method);
        if (!has_head) fprintf(output.stream, "integrator,step,t");
        for (int k = 0; k < of->observables && !has_head; k++)
            fprintf(output.stream, ",predicted_%s", of->predicted[k].name);
        if (!has_head) fputc('\n', output.stream);
        has_head = true;
        for (long long r = 0; r < of->rows; r++) {
            fprintf(output.stream, "%s,%.15g,%.15g", method, p->item[i].step, of->t[r]);
            csv_put_cells(output.stream, of->change + r * of->observables, of->observables);
            fputc('\n', output.stream);
        }
    }
    return file_output_close(&output, CLI_DONE);
}

/* ---- all ----------------------------------------------------------------------------------- */

static int report_all(const predictions *p)
{
    const predict_settings *set = p->set;
    int status = set->output ? write_curves(p) : CLI_DONE;
    const bool is_printed = !set->output || strcmp(set->output, "-") != 0;
    if (status == CLI_DONE && is_printed) status = (set->json ? print_json : print_predictions)(p);
    if (status != CLI_DONE || !p->interrupted) return status;
    return cli_fail(CLI_SIGNAL, "interrupted; the curves so far are kept");
}

int predict_run(predict_settings *settings)
{
    run_simulation *s = &settings->simulation;
    predictions p = {.set = settings};
    int status = analysis_check_output(settings->output, settings->json);
    if (status == CLI_DONE)
        status = screen_check_format(settings->format, "--json", settings->json);
    if (status == CLI_DONE)
        status = screen_check_format(settings->format, "--details", settings->details);
    if (status == CLI_DONE) status = simulation_complete(s, &p.spec);
    if (status != CLI_DONE) return status;
    p.spec.options.space = is_on_motion(s) ? DAL_PHYSICAL : DAL_LIFTED;
    p.item = cli_calloc(MAX_ITEMS, sizeof *p.item);
    status = list_methods(&p);
    cli_catch_signals();
    if (status == CLI_DONE) status = predict_all(&p);
    if (status == CLI_DONE) status = report_all(&p);
    for (int i = 0; i < p.count; i++) dal_prediction_free(p.item[i].of);
    free(p.item);
    return status;
}
