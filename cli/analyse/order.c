/* order.c - the error of many methods against step, or tolerance, and against work.
 *
 * First a reference; then every method at every step, on threads; then a table or JSON, a CSV file
 * and two diagrams. */
#include "order.h"
#include "analysis.h"
#include "io/csv_cells.h"
#include "io/file_output.h"
#include "order_screen.h"
#include "run/pool.h"
#include "run/request_json.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"
#include "ui/signals.h"
#include "ui/wrap.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A run this short is repeated, and its shortest time counts; steps between two polls of the
 * signals. */
static const double short_time = 0.01;
enum { MAX_REPEATS = 3, CHUNK = 1000 };
/* A step to T that takes more substeps than a step may have is divided into 16 steps, then into 16
 * times as many, up to MAX_STEPS. */
enum { DIVISION = 16, MAX_STEPS = 1 << 20 };
/* The smallest error that is claimed of a reference. */
static const double rounding = 1e-16;
/* The tolerances of the two references, as fractions of the smallest one. */
static const double first_reference = 0.1, second_reference = 0.01;

static const char *const state_words[] = {
#define STATE_WORD(code, word) word,
    ORDER_STATE_LIST(STATE_WORD)
#undef STATE_WORD
};

/* ---- lists of methods and steps ------------------------------------------------------------ */

static void add_method(order_study *s, dal_method method)
{
    const size_t count = (size_t)s->method_count + 1;
    s->methods = cli_realloc(s->methods, count * sizeof *s->methods);
    order_method *added = s->methods + s->method_count++;
    *added = (order_method){.method = method};
    dal_method_name(&method, added->name, sizeof added->name);
}

/* A method by its name, or all that have no modifiers. */
static int add_methods(order_study *s, const char *name)
{
    const dal_integrator *k;
    if (strcmp(name, "all") != 0) {
        dal_method method;
        dal_error error = {0};
        if (dal_method_parse(&method, name, &error) != DAL_STATUS_OK)
            return cli_error(CLI_USAGE, NULL, &error);
        add_method(s, method);
        return CLI_DONE;
    }
    for (int i = 0; (k = dal_integrator_at(i)); i++)
        if (!(k->properties & DAL_MODIFIER) &&
            (!s->set->tolerances || k->properties & DAL_ADAPTIVE))
            add_method(s, (dal_method){{k}});
    return CLI_DONE;
}

/* The next of the numbers of an option, which fall. */
static int add_level(order_study *s, const char *option, const char *text, double *levels)
{
    double x;
    if (s->levels == DAL_ORDER_LEVELS)
        return cli_fail(CLI_USAGE, "%s: more than %d", option, DAL_ORDER_LEVELS);
    if (cli_number(option, text, &x) != CLI_DONE) return CLI_USAGE;
    if (!(x > 0.0) || (s->levels > 0 && !(x < levels[s->levels - 1])))
        return cli_fail(CLI_USAGE, "%s: %s is not positive and below the one before", option, text);
    levels[s->levels++] = x;
    return CLI_DONE;
}

static int add_step(order_study *s, const char *text)
{
    return add_level(s, "--steps", text, s->step);
}

/* The step is one and the same; where it is not given it is the whole time. */
static int add_tolerance(order_study *s, const char *text)
{
    const run_request *r = &s->simulation->request;
    s->divides = !r->text[REQUEST_step];
    const int status = add_level(s, "--tolerances", text, s->tolerance);
    if (status == CLI_DONE)
        s->step[s->levels - 1] = s->divides ? r->time - r->from : r->options.step;
    return status;
}

/* Adds each item of a list between commas. */
static int add_items(order_study *s, const char *list, const char *option,
                     int (*add)(order_study *s, const char *item))
{
    for (;;) {
        char item[ORDER_NAME];
        const size_t length = strcspn(list, ",");
        if (length == 0 || length >= sizeof item)
            return cli_fail(CLI_USAGE, "%s: '%.40s' is not a list between commas", option, list);
        memcpy(item, list, length);
        item[length] = '\0';
        const int status = add(s, item);
        if (status != CLI_DONE || !list[length]) return status;
        list += length + 1;
    }
}

static int list_steps(order_study *s)
{
    const double T = s->simulation->request.time;
    const order_settings *set = s->set;
    const char *levels = set->tolerances ? "tolerances" : "steps";
    int status = CLI_DONE;
    if (set->tolerances && (set->steps || request_has(&s->simulation->request, REQUEST_tolerance)))
        return cli_fail(CLI_USAGE, "--tolerances excludes --steps and --tolerance");
    if (set->tolerances) status = add_items(s, set->tolerances, "--tolerances", add_tolerance);
    if (set->steps) status = add_items(s, set->steps, "--steps", add_step);
    if (status != CLI_DONE) return status;
    for (int i = 0; !set->steps && !set->tolerances && i < set->level_count; i++)
        s->step[s->levels++] = ldexp(s->simulation->request.options.step, -i);
    if (!(s->step[0] > 0.0)) return cli_fail(CLI_USAGE, "--step: it must be positive");
    if (s->tolerance[0] > 1.0)
        return cli_fail(CLI_USAGE, "--tolerances: %g is larger than 1", s->tolerance[0]);
    const double min = dal_min_tolerance(&s->simulation->request.options);
    if (set->tolerances && s->levels > 0 && s->tolerance[s->levels - 1] < min)
        return cli_fail(CLI_USAGE, "--tolerances: %g is below %.2g, the smallest in this precision",
                        s->tolerance[s->levels - 1], min);
    if (s->levels < 2)
        return cli_fail(CLI_USAGE, "--%s: a slope needs two %s at least", levels, levels);
    for (int i = 0; i < s->levels; i++)
        if (dal_whole_steps(s->simulation->request.from, T, s->step[i]) == 0)
            return cli_fail(CLI_USAGE, "the time %g is not a whole number of steps of %.9g", T,
                            s->step[i]);
    return CLI_DONE;
}

/* ---- runs ---------------------------------------------------------------------------------- */

typedef struct run_cost {
    long long evaluations;
    double seconds;
} run_cost;

/* The numbers that are compared, at T. */
static dal_status run_to_end(const order_study *s, const dal_run_spec *spec, double *end,
                             run_cost *cost, dal_error *error)
{
    dal_run *run;
    dal_status status = dal_run_create(&run, spec, error);
    if (status != DAL_STATUS_OK) return status;
    const double begin = cli_thread_seconds();
    /* A step under a tolerance may take long. */
    const long long chunk = spec->options.tolerance > 0.0 ? 1 : CHUNK;
    for (long long rest = order_count_steps(s, spec->options.step);
         rest > 0 && status == DAL_STATUS_OK; rest -= chunk)
        status = cli_interrupted() ? DAL_STATUS_INTERRUPTED
                                   : dal_run_advance(run, rest < chunk ? rest : chunk, error);
    *cost = (run_cost){dal_run_evaluations(run), cli_thread_seconds() - begin};
    memcpy(end, dal_run_state(run), (size_t)s->numbers * sizeof *end);
    dal_run_free(run);
    return status;
}

/* The same; where the step is the whole time, in as few steps as the number of substeps in one
 * allows. */
static dal_status run_divided(const order_study *s, const dal_run_spec *spec, double *end,
                              run_cost *cost, dal_error *error)
{
    dal_run_spec shorter = *spec;
    dal_status status;
    for (int steps = 1;; steps *= DIVISION) {
        *error = (dal_error){.status = DAL_STATUS_OK};
        shorter.options.step = spec->options.step / steps;
        status = run_to_end(s, &shorter, end, cost, error);
        if (!s->divides || status != DAL_STATUS_NOT_CONVERGED || steps == MAX_STEPS) return status;
    }
}

/* The start of all runs: at its time, with velocities that are solved or moved to D = 0. */
static bool find_start(const order_study *s, double *start)
{
    dal_run *run;
    dal_run_spec spec = s->spec;
    spec.options.space = DAL_PHYSICAL;
    spec.options.step = s->step[0];
    if (!cli_is_ok(dal_method_parse(&spec.method, "gauss12", NULL)) ||
        !cli_is_ok(dal_run_create(&run, &spec, NULL)))
        return false;
    memcpy(start, dal_run_state(run), (size_t)s->numbers * sizeof *start);
    dal_run_free(run);
    return true;
}

/* The exact solution, where the system has one that begins at this start. */
static bool use_exact_solution(order_study *s)
{
    const dal_system *system = s->spec.system;
    const run_request *request = &s->simulation->request;
    double *start = s->reference + s->numbers;
    dal_evaluator *evaluator;
    if (!system->exact || system->multipliers || !find_start(s, start) ||
        !cli_is_ok(
            dal_evaluator_create(&evaluator, system, request->set.item, request->set.count, NULL)))
        return false;
    const bool found =
        dal_evaluator_call(evaluator, system->exact, request->from, start, start, NULL,
                           s->reference) == DAL_STATUS_OK &&
        analysis_distance(start, s->reference, s->units, s->numbers) <= 1e-10 &&
        dal_evaluator_call(evaluator, system->exact, request->time, start, start, NULL,
                           s->reference) == DAL_STATUS_OK &&
        isfinite(analysis_distance(s->reference, s->reference, s->units, s->numbers));
    dal_evaluator_free(evaluator);
    return found;
}

/* Two runs of an accurate method: the one with the smaller step, or tolerance, is the reference,
 * their distance its error. */
static dal_status use_method(order_study *s, const char *name, dal_error *error)
{
    const bool is_controlled = s->set->tolerances != NULL;
    const double h = s->step[s->levels - 1], fine = is_controlled ? h : 0.5 * h;
    const double tolerance = s->tolerance[s->levels - 1];
    double *coarse = s->reference + s->numbers;
    run_cost cost;
    dal_run_spec spec = s->spec;
    dal_status status = dal_method_parse(&spec.method, name, error);
    spec.options.space = DAL_PHYSICAL;
    spec.options.step = h;
    spec.options.tolerance =
        is_controlled ? fmax(first_reference * tolerance, dal_min_tolerance(&spec.options))
                      : s->spec.options.tolerance;
    if (status == DAL_STATUS_OK) status = run_divided(s, &spec, coarse, &cost, error);
    spec.options.step = fine;
    if (is_controlled)
        spec.options.tolerance =
            fmax(second_reference * tolerance, dal_min_tolerance(&spec.options));
    if (status == DAL_STATUS_OK) status = run_divided(s, &spec, s->reference, &cost, error);
    if (status != DAL_STATUS_OK) return status;
    s->noise = fmax(analysis_distance(coarse, s->reference, s->units, s->numbers), rounding);
    s->reference_method = name;
    s->reference_step = fine;
    s->reference_tolerance = is_controlled ? spec.options.tolerance : 0.0;
    return DAL_STATUS_OK;
}

static int make_reference(order_study *s)
{
    dal_error error = {0};
    s->numbers = 2 * s->spec.system->n + s->spec.system->multipliers;
    s->reference = cli_calloc(2 * (size_t)s->numbers + 1, sizeof *s->reference);
    dal_run_spec spec = s->spec;
    spec.options.step = s->step[0];
    dal_status status = dal_scaled_create(&s->scaled, &spec, &error);
    if (status != DAL_STATUS_OK) return cli_error(cli_exit(status), "reference", &error);
    s->units = dal_scaled_units(s->scaled) + 1;
    if (use_exact_solution(s)) return CLI_DONE;
    status = use_method(s, s->set->tolerances ? "taylor" : "gauss12", &error);
    if (status == DAL_STATUS_NOT_CONVERGED ||
        (s->set->tolerances && status == DAL_STATUS_UNSUPPORTED))
        status = use_method(s, "dop853", &error);
    if (status == DAL_STATUS_OK) return CLI_DONE;
    return status == DAL_STATUS_INTERRUPTED ? cli_fail(CLI_SIGNAL, "interrupted")
                                            : cli_error(cli_exit(status), "reference", &error);
}

/* Method i / levels at one of the steps, the smallest, which takes longest, first. */
static void run_level(void *user, int i)
{
    order_study *s = user;
    order_method *m = &s->methods[i / s->levels];
    const int level = s->levels - 1 - i % s->levels;
    dal_run_spec spec = s->spec;
    spec.method = m->method;
    spec.options.step = s->step[level];
    spec.options.space = order_space(s, m);
    if (s->set->tolerances) spec.options.tolerance = s->tolerance[level];
    double *end = cli_calloc((size_t)s->numbers + 1, sizeof *end);
    dal_error *failure = &m->failure[level];
    run_cost cost = {0};
    m->seconds[level] = INFINITY;
    failure->status = DAL_STATUS_OK;
    for (int k = 0; k < MAX_REPEATS && failure->status == DAL_STATUS_OK; k++) {
        failure->status = run_divided(s, &spec, end, &cost, failure);
        m->seconds[level] = fmin(m->seconds[level], cost.seconds);
        if (cost.seconds > short_time) break;
    }
    m->order.step[level] = s->set->tolerances ? s->tolerance[level] : s->step[level];
    m->order.evaluations[level] = cost.evaluations;
    m->order.error[level] = cli_is_ok(failure->status)
                                ? analysis_distance(end, s->reference, s->units, s->numbers)
                                : NAN;
    free(end);
}

static int run_methods(order_study *s, int threads)
{
    pool_run(s->method_count * s->levels, threads, run_level, s);
    if (cli_interrupted()) return cli_fail(CLI_SIGNAL, "interrupted");
    for (order_method *m = s->methods; m < s->methods + s->method_count; m++) {
        m->order.levels = s->levels;
        dal_order_slopes(&m->order, s->noise);
        if (s->set->tolerances) m->order.order = NAN;
        for (int i = 0; i < s->levels; i++) {
            dal_error *failure = &m->failure[i];
            if (failure->status == DAL_STATUS_OK) continue;
            if (!failure->message[0])
                snprintf(failure->message, sizeof failure->message, "%s",
                         dal_status_text(failure->status));
            m->state = failure->status == DAL_STATUS_UNSUPPORTED ? ORDER_REFUSED : ORDER_FAILED;
        }
    }
    return CLI_DONE;
}

/* ---- the table ----------------------------------------------------------------------------- */

/* " x", or " -" where there is no number. */
static void print_cell(const char *format, int width, double x)
{
    char text[32];
    snprintf(text, sizeof text, format, x);
    printf(" %*s", width, isnan(x) ? "-" : text);
}

/* What words instead of an order mean. */
static void print_outcomes(const order_study *s)
{
    static const char *const texts[] = {
        [DAL_ORDER_COARSE] = "the last two slopes do not agree, or errors are half as large as the "
                             "solution: the steps are too large",
        [DAL_ORDER_ROUNDING] = "fewer than three errors lie above rounding and ten times the error "
                               "of the reference: the steps are too small",
        [DAL_ORDER_FEW] = "there are fewer than three steps"};
    for (int k = DAL_ORDER_COARSE; k <= DAL_ORDER_FEW; k++) {
        const order_method *m = s->methods, *end = m + s->method_count;
        while (m < end && (m->state != ORDER_DONE || (int)m->order.outcome != k)) m++;
        if (m == end) continue;
        char *text = cli_format("no order found, %s: %s", order_outcome_words[k], texts[k]);
        putchar('\n');
        cli_wrap(stdout, text, 0, 0);
        free(text);
    }
}

static void print_branch(void *user, const char *what, const char *text)
{
    (void)user;
    printf("\n%s: %s", what, text);
}

static void print_orders(const order_study *s)
{
    const int last = s->levels - 1;
    const double steps = (double)order_count_steps(s, s->step[last]);
    const bool is_controlled = s->set->tolerances != NULL;
    bool any_without_order = false;
    bool is_mixed = false;
    for (int i = 0; i < s->method_count; i++)
        is_mixed |= order_space(s, &s->methods[i]) != s->spec.options.space;
    printf("%s, error of (q,v) at t = %g, %s%s\nagainst ", s->simulation->request.system_name,
           s->simulation->request.time, s->spec.options.space == DAL_LIFTED ? "lifted" : "physical",
           is_mixed ? ", physical where a method has no lift" : "");
    if (s->reference_method)
        printf("%s with %s = %g, itself within %.0e\n\n", s->reference_method,
               is_controlled ? "tolerance" : "h",
               is_controlled ? s->reference_tolerance : s->reference_step, s->noise);
    else
        fputs("the exact solution\n\n", stdout);
    printf("%-21s %13s  %-*s %15s\n", "", "order", 8 * s->levels - 1,
           is_controlled ? "error at tolerance =" : "error at h =", "cost of a step");
    printf("%-21s %6s %6s", "integrator", "stated", "found");
    for (int i = 0; i < s->levels; i++)
        print_cell("%.3g", 7, is_controlled ? s->tolerance[i] : s->step[i]);
    printf(" %7s %7s\n", "F", "us");
    for (const order_method *m = s->methods; m < s->methods + s->method_count; m++) {
        if (m->state == ORDER_REFUSED) continue;
        any_without_order |= isnan(m->order.order);
        printf("%-21s %6d", m->name, dal_method_order(&m->method));
        if (isnan(m->order.order) && m->state == ORDER_DONE && !is_controlled)
            printf(" %*s", 6, order_outcome_words[m->order.outcome]);
        else
            print_cell("%.2f", 6, m->order.order);
        for (int i = 0; i < s->levels; i++) print_cell("%.1e", 7, m->order.error[i]);
        const bool succeeded = m->failure[last].status == DAL_STATUS_OK;
        print_cell("%.1f", 7, succeeded ? (double)m->order.evaluations[last] / steps : NAN);
        print_cell("%.2f", 7, succeeded ? 1e6 * m->seconds[last] / steps : NAN);
        putchar('\n');
    }
    if (any_without_order && !is_controlled) print_outcomes(s);
    for (const order_method *m = s->methods; m < s->methods + s->method_count; m++)
        if (m->state != ORDER_DONE)
            printf("\n%s: %s: %s", m->name, state_words[m->state], order_failure_message(s, m));
    analysis_list_branches(s->simulation->model, print_branch, NULL);
    putchar('\n');
}

/* ---- JSON ---------------------------------------------------------------------------------- */

static void put_level(json_writer *w, const order_study *s, const order_method *m, int level)
{
    const bool succeeded = m->failure[level].status == DAL_STATUS_OK;
    json_open(w, NULL, JSON_ON_ONE_LINE);
    json_put_number(w, "step", s->step[level]);
    if (s->set->tolerances) json_put_number(w, "tolerance", s->tolerance[level]);
    json_put_integer(w, "steps", order_count_steps(s, s->step[level]));
    json_put_number(w, "error", m->order.error[level]);
    json_put_number(w, "slope", m->order.slope[level]);
    json_put_number(w, "evaluations", succeeded ? (double)m->order.evaluations[level] : NAN);
    json_put_number(w, "seconds", succeeded ? m->seconds[level] : NAN);
    json_put_text(w, "message", succeeded ? NULL : m->failure[level].message);
    json_close(w);
}

static void put_method(json_writer *w, const order_study *s, const order_method *m)
{
    json_open(w, NULL, JSON_LINES);
    json_put_text(w, "integrator", m->name);
    json_put_integer(w, "stated_order", dal_method_order(&m->method));
    json_put_number(w, "observed_order", m->order.order);
    const bool is_missing = m->state == ORDER_DONE && !s->set->tolerances && isnan(m->order.order);
    json_put_text(w, "no_order", is_missing ? order_outcome_words[m->order.outcome] : NULL);
    json_put_text(w, "state", state_words[m->state]);
    json_put_text(w, "message", m->state == ORDER_DONE ? NULL : order_failure_message(s, m));
    json_open_list(w, "levels", JSON_LINES);
    for (int i = 0; m->state != ORDER_REFUSED && i < s->levels; i++) put_level(w, s, m, i);
    json_close(w);
    json_close(w);
}

/* The request, and what errors are measured by. */
static void put_reference(json_writer *w, const void *results)
{
    const order_study *s = results;
    const bool is_controlled = s->set->tolerances != NULL;
    request_open_json(w, s->simulation,
                      ORDER_WITHOUT | REQUEST_OPTION(step) |
                          (is_controlled ? REQUEST_OPTION(tolerance) : 0));
    json_close(w);
    json_open(w, "reference", JSON_ON_ONE_LINE);
    json_put_text(w, "integrator", s->reference_method);
    json_put_number(w, "step", s->reference_method ? s->reference_step : NAN);
    if (is_controlled)
        json_put_number(w, "tolerance", s->reference_method ? s->reference_tolerance : NAN);
    json_put_number(w, "error", s->reference_method ? s->noise : NAN);
    json_close(w);
}

static void put_orders(const order_study *s)
{
    json_writer w = json_begin_results("order");
    put_reference(&w, s);
    json_open_list(&w, "methods", JSON_LINES);
    for (int i = 0; i < s->method_count; i++) put_method(&w, s, &s->methods[i]);
    json_close(&w);
    json_end_results(&w);
}

/* ---- CSV ----------------------------------------------------------------------------------- */

/* At a step; level < 0: a method that was refused. */
static void write_level(FILE *out, const order_study *s, const order_method *m, int level)
{
    const bool has_run = level >= 0,
               succeeded = has_run && m->failure[level].status == DAL_STATUS_OK;
    const double h = has_run ? s->step[level] : NAN;
    const double first[] = {m->order.order, h, has_run ? s->tolerance[level] : NAN};
    const double cells[] = {
        has_run ? (double)order_count_steps(s, h) : NAN, has_run ? m->order.error[level] : NAN,
        has_run ? m->order.slope[level] : NAN,
        succeeded ? (double)m->order.evaluations[level] : NAN, succeeded ? m->seconds[level] : NAN};
    csv_put_text(out, s->simulation->request.system_name);
    fputc(',', out);
    csv_put_text(out, m->name);
    fprintf(out, ",%d", dal_method_order(&m->method));
    csv_put_cells(out, first, s->set->tolerances ? 3 : 2);
    csv_put_cells(out, cells, sizeof cells / sizeof *cells);
    fprintf(out, ",%s,", state_words[succeeded ? ORDER_DONE : has_run ? ORDER_FAILED : m->state]);
    csv_put_text(out, has_run ? m->failure[level].message : order_failure_message(s, m));
    fputc('\n', out);
}

static int write_orders(const order_study *s, const char *path)
{
    file_output output;
    const int status = file_output_open(&output, path);
    if (status != CLI_DONE) return status;
    FILE *out = output.stream;
    fprintf(out,
            "label,integrator,stated_order,observed_order,step%s,steps,error,slope,evaluations,"
            "seconds,state,message\n",
            s->set->tolerances ? ",tolerance" : "");
    for (const order_method *m = s->methods; m < s->methods + s->method_count; m++) {
        if (m->state == ORDER_REFUSED) write_level(out, s, m, -1);
        for (int k = 0; m->state != ORDER_REFUSED && k < s->levels; k++) write_level(out, s, m, k);
    }
    return file_output_close(&output, CLI_DONE);
}

/* ---- all ----------------------------------------------------------------------------------- */

static int measure(order_study *s)
{
    int status = analysis_check_output(s->set->output, s->set->json);
    if (status == CLI_DONE) status = screen_check_format(s->set->format, "--json", s->set->json);
    if (status == CLI_DONE)
        status = screen_check_format(s->set->format, "--details", s->set->details);
    if (status == CLI_DONE && !s->set->force) status = analysis_check_directory(s->set->output);
    if (status == CLI_DONE) status = list_steps(s);
    if (status == CLI_DONE)
        status = add_items(s, s->set->integrators, "--integrators", add_methods);
    if (status == CLI_DONE) status = simulation_make_spec(s->simulation, &s->spec);
    if (status == CLI_DONE && s->spec.system->events > 0)
        status =
            cli_fail(CLI_USAGE, "%s has events: the order is measured on a motion without them",
                     s->simulation->request.system_name);
    if (status != CLI_DONE) return status;
    cli_catch_signals();
    status = make_reference(s);
    if (status == CLI_DONE) status = run_methods(s, (int)s->set->threads);
    if (status == CLI_DONE) {
        if (screen_is_wanted(s->set->format, s->set->json || s->set->details)) {
            status = order_print_screen(s);
        } else {
            (s->set->json ? put_orders : print_orders)(s);
            status = cli_close(stdout, "standard output");
        }
    }
    if (status == CLI_DONE && s->set->output) {
        analysis_output output;
        status = analysis_open(&output, s->set->output, "order");
        if (status == CLI_DONE) status = write_orders(s, output.table);
        s->set->is_written = status == CLI_DONE;
        if (status == CLI_DONE && output.directory)
            status = analysis_describe(&output, "order", s->simulation, put_reference, s);
        analysis_close(&output, status);
    }
    for (int i = 0; status == CLI_DONE && i < s->method_count; i++)
        if (s->methods[i].state == ORDER_FAILED) status = CLI_FAILED;
    return status;
}

int order_measure(order_settings *settings)
{
    order_study s = {.set = settings, .simulation = &settings->simulation};
    const int status = measure(&s);
    free(s.methods);
    free(s.reference);
    dal_scaled_free(s.scaled);
    return status;
}
