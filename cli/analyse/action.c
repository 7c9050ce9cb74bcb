/* action.c - the actions of the theory on a curve in a file. */
#include "action.h"
#include "dalembert_action.h"
#include "dalembert_program.h"
#include "io/csv_table.h"
#include "io/json.h"
#include "run/request_json.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_METHODS = 32, METHOD_NAME = 128, SCREEN_METHODS = 9 };

/* A curve with a memory of its own, and what was found. */
typedef struct results {
    action_settings *settings;
    const dal_system *system;
    dal_evaluator *evaluator;
    csv_table csv;
    double *numbers; /* of the curve */
    dal_curve curve;
    double max_constraint, step;       /* step: 0: rows at different distances */
    dal_action action[2][DAL_ACTIONS]; /* of the curve, and of the perturbed one */
    int methods;
    char method[MAX_METHODS][METHOD_NAME];
    dal_discrete_action discrete[MAX_METHODS];
} results;

/* ---- the file ------------------------------------------------------------------------------ */

static int find_head(const csv_table *csv, const char *name, const char *plain)
{
    for (int i = 0; i < csv->columns; i++)
        if (strcmp(csv->cell[i], name) == 0 || (plain && strcmp(csv->cell[i], plain) == 0))
            return i;
    return -1;
}

/* Reads a column to out, out + stride, ... */
static int read_column(const results *r, int column, double *out, int stride)
{
    const csv_table *csv = &r->csv;
    for (int row = 1; row < csv->rows; row++) {
        const char *text = csv->cell[row * csv->columns + column];
        const char *first = text + strspn(text, " \t");
        const size_t length = strcspn(first, " \t\r");
        double x;
        if (dal__parse_number(first, length, &x) != DAL_STATUS_OK ||
            first[length + strspn(first + length, " \t\r")])
            return cli_fail(CLI_USAGE, "%s:%d: column %s: '%.40s' is not a finite number",
                            r->settings->curve, row + 1, csv->cell[column], text);
        out[(row - 1) * stride] = x;
    }
    return CLI_DONE;
}

/* The kinds of columns, one for each coordinate: what is before and after its name, what is before
 * it with --names plain, and the member of dal_curve. */
typedef struct column_kind {
    const char *before, *after, *plain;
    size_t member;
} column_kind;
static const column_kind kinds[] = {{"", "", NULL, offsetof(dal_curve, q)},
                                    {"", "'", "v", offsetof(dal_curve, v)},
                                    {"lambda_", "", NULL, offsetof(dal_curve, lambda)},
                                    {"p_", "", NULL, offsetof(dal_curve, p)},
                                    {"pi_", "", NULL, offsetof(dal_curve, pi)}};

/* Reads the columns of one kind, all or none of them; without them the curve keeps NULL. */
static int read_kind(results *r, const column_kind *kind, double **memory)
{
    const int n = r->system->n;
    int found = 0, status = CLI_DONE, column = -1;
    const char *missing = NULL;
    for (int i = 0; i < n && status == CLI_DONE; i++) {
        const char *coordinate = r->system->coordinate[i];
        char *own = cli_format("%s%s%s", kind->before, coordinate, kind->after);
        char *other = kind->plain ? cli_format("%s%s", kind->plain, coordinate) : NULL;
        column = find_head(&r->csv, own, other);
        found += column >= 0;
        if (column < 0 && !missing) missing = coordinate;
        if (column >= 0) status = read_column(r, column, *memory + i, n);
        free(own);
        free(other);
    }
    if (status != CLI_DONE) return status;
    if (found > 0 && missing)
        return cli_fail(CLI_USAGE, "%s: of the columns %s%s%s there is none of the coordinate %s",
                        r->settings->curve, kind->before, "x", kind->after, missing);
    if (!found) return CLI_DONE;
    *(const double **)((char *)&r->curve + kind->member) = *memory;
    *memory += (size_t)n * (size_t)(r->csv.rows - 1);
    return CLI_DONE;
}

static int read_curve(results *r)
{
    const char *path = r->settings->curve;
    dal_curve *c = &r->curve;
    int status = csv_table_read(&r->csv, path);
    if (status != CLI_DONE) return status;
    c->rows = r->csv.rows - 1;
    if (c->rows < DAL_CURVE_ROWS)
        return cli_fail(CLI_USAGE, "%s: a curve has %d rows or more, not %d", path,
                        (int)DAL_CURVE_ROWS, c->rows);
    const size_t rows = (size_t)c->rows;
    double *next = r->numbers = cli_calloc(rows * (5 * (size_t)r->system->n + 3), sizeof *next);
    static const struct {
        const char *name;
        size_t member;
    } singles[] = {{"t", offsetof(dal_curve, t)},
                   {"e", offsetof(dal_curve, e)},
                   {"pi_e", offsetof(dal_curve, pi_e)}};
    for (size_t k = 0; k < sizeof singles / sizeof *singles && status == CLI_DONE; k++) {
        const int column = find_head(&r->csv, singles[k].name, NULL);
        if (k == 0 && column < 0) return cli_fail(CLI_USAGE, "%s: the column t is missing", path);
        if (column < 0) continue;
        *(const double **)((char *)c + singles[k].member) = next;
        status = read_column(r, column, next, 1);
        next += rows;
    }
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds && status == CLI_DONE; k++)
        status = read_kind(r, &kinds[k], &next);
    if (status == CLI_DONE && !c->q)
        return cli_fail(CLI_USAGE,
                        "%s: the column %s is missing: a curve has t and the coordinates", path,
                        r->system->coordinate[0]);
    for (int k = 1; k < c->rows && status == CLI_DONE; k++)
        if (!(c->t[k] > c->t[k - 1]))
            status = cli_fail(CLI_USAGE, "%s:%d: t = %.15g does not come after %.15g", path, k + 2,
                              c->t[k], c->t[k - 1]);
    if (status == CLI_DONE && !c->e && (c->pi || c->pi_e))
        cli_note("%s: there is no column e: e = 1", path);
    return status;
}

/* ---- evaluation ---------------------------------------------------------------------------- */

/* (nh8) is of systems with equations alone. */
static int first_form(const results *r)
{
    return r->system->equations > 0 ? DAL_ACTION_EQUATIONS : DAL_ACTION_SECOND_ORDER;
}

static int integrate(results *r, const dal_curve *curve, dal_action action[DAL_ACTIONS])
{
    dal_error error = {0};
    for (int form = first_form(r); form < DAL_ACTIONS; form++) {
        const dal_status status = dal_evaluator_integrate_action(
            r->evaluator, curve, (dal_action_form)form, &action[form], &error);
        if (!cli_is_ok(status))
            return cli_error(cli_input_exit(status), r->settings->curve, &error);
    }
    return CLI_DONE;
}

/* The same with A sin^4(pi s) on every coordinate, s from 0 to 1, which leaves the ends and the
 * first three derivatives there as they are. */
static int integrate_perturbed(results *r)
{
    const int n = r->system->n;
    dal_curve c = r->curve;
    const double pi = acos(-1.0), length = c.t[c.rows - 1] - c.t[0];
    double *q = cli_calloc(2 * (size_t)c.rows * (size_t)n, sizeof *q), *v = q + c.rows * n;
    for (int k = 0; k < c.rows; k++) {
        const double s = pi * (c.t[k] - c.t[0]) / length, a = r->settings->perturb;
        const double bump = a * pow(sin(s), 4.0);
        const double rate = a * 4.0 * pow(sin(s), 3.0) * cos(s) * pi / length;
        for (int i = 0; i < n; i++) {
            q[k * n + i] = c.q[k * n + i] + bump;
            if (c.v) v[k * n + i] = c.v[k * n + i] + rate;
        }
    }
    c.q = q;
    if (c.v) c.v = v;
    const int status = integrate(r, &c, r->action[1]);
    free(q);
    return status;
}

/* The discrete action of a method by name. */
static dal_status check_method(results *r, const char *name, dal_error *error)
{
    const request_settings *set = &r->settings->simulation.request.set;
    dal_run_spec spec = {.system = r->system,
                         .options = dal_options_default(),
                         .parameters = set->item,
                         .parameter_count = set->count,
                         .start_time = r->curve.t[0]};
    spec.options.step = r->step;
    const dal_status parsed = dal_method_parse(&spec.method, name, error);
    if (parsed != DAL_STATUS_OK) return parsed;
    dal_method_name(&spec.method, r->method[r->methods], METHOD_NAME);
    return dal_check_discrete_action(&spec, &r->curve, &r->discrete[r->methods++], error);
}

static int evaluate_curve(results *r)
{
    dal_error error = {0};
    dal_curve *c = &r->curve;
    const request_settings *set = &r->settings->simulation.request.set;
    const char *path = r->settings->curve;
    int status = read_curve(r);
    if (status != CLI_DONE) return status;
    dal_status made = dal_evaluator_create(&r->evaluator, r->system, set->item, set->count, &error);
    if (!cli_is_ok(made)) return cli_error(cli_input_exit(made), NULL, &error);
    made = dal_evaluator_measure_curve(r->evaluator, &r->curve, &r->max_constraint, &error);
    if (!cli_is_ok(made)) return cli_error(cli_input_exit(made), path, &error);
    r->step = dal_curve_step(c);
    status = integrate(r, c, r->action[0]);
    if (status == CLI_DONE && r->settings->perturb != 0.0) status = integrate_perturbed(r);
    const char *end = c->v && r->step > 0.0 ? r->settings->methods : "";
    for (const char *at = end; *at && status == CLI_DONE; at = *end ? end + 1 : end) {
        at += strspn(at, " ");
        end = at + strcspn(at, ",");
        char *name = cli_strndup(at, (size_t)(end - at));
        made = r->methods < MAX_METHODS ? check_method(r, name, &error) : DAL_STATUS_TOO_LARGE;
        if (!cli_is_ok(made)) status = cli_error(cli_input_exit(made), "--methods", &error);
        free(name);
    }
    return status;
}

/* ---- output -------------------------------------------------------------------------------- */

#define LABEL(code, label, text) label,
#define TEXT(code, label, text)  text,
static const char *const labels[] = {DAL_ACTION_LIST(LABEL)};
static const char *const texts[] = {DAL_ACTION_LIST(TEXT)};
#undef LABEL
#undef TEXT

static int put_json(const results *r)
{
    const action_settings *s = r->settings;
    json_writer w = json_begin_results("action");
    request_open_json(&w, &s->simulation, ~ACTION_OPTIONS);
    json_put_text(&w, "curve", s->curve);
    json_put_text(&w, "methods", s->methods);
    json_put_number(&w, "perturb", s->perturb);
    json_close(&w);
    json_put_integer(&w, "rows", r->curve.rows);
    json_put_number(&w, "from", r->curve.t[0]);
    json_put_number(&w, "to", r->curve.t[r->curve.rows - 1]);
    json_put_number(&w, "step", r->step > 0.0 ? r->step : NAN);
    json_put_number(&w, "max_constraint", r->max_constraint);
    json_open_list(&w, "actions", JSON_LINES);
    for (int form = first_form(r); form < DAL_ACTIONS; form++) {
        json_open(&w, NULL, JSON_ON_ONE_LINE);
        json_put_text(&w, "equation", labels[form]);
        json_put_number(&w, "value", r->action[0][form].value);
        json_put_number(&w, "error", r->action[0][form].error);
        json_put_number(&w, "perturbed", s->perturb != 0.0 ? r->action[1][form].value : NAN);
        json_close(&w);
    }
    json_close(&w);
    json_open_list(&w, "discrete_actions", JSON_LINES);
    for (int k = 0; k < r->methods; k++) {
        json_open(&w, NULL, JSON_ON_ONE_LINE);
        json_put_text(&w, "integrator", r->method[k]);
        json_put_number(&w, "value", r->discrete[k].value);
        json_put_number(&w, "defect", r->discrete[k].defect);
        json_put_bool(&w, "stationary", r->discrete[k].is_stationary);
        json_close(&w);
    }
    json_close(&w);
    json_end_results(&w);
    return cli_close(stdout, "standard output");
}

/* The reason why no discrete action was tried. */
static const char *reason_of_none(const results *r)
{
    return !r->curve.v              ? "the file has no velocities"
           : !*r->settings->methods ? "--methods names none"
                                    : "the rows are at different distances";
}

static int print_text(const results *r)
{
    const action_settings *s = r->settings;
    const dal_curve *c = &r->curve;
    printf("%s on %s: %d rows, t = %g to %g", s->simulation.request.system_name, s->curve, c->rows,
           c->t[0], c->t[c->rows - 1]);
    printf(r->step > 0.0 ? ", h = %g\n" : "\n", r->step);
    if (r->system->m > 0) printf("max |D(q, q')| on the curve: %.2g\n", r->max_constraint);
    printf("\n%-50s%11s%9s%10s\n", "action", "value", "error",
           s->perturb != 0.0 ? "perturbed" : "");
    for (int form = first_form(r); form < DAL_ACTIONS; form++) {
        printf("(%s) %-*s%11.3g%9.1g", labels[form], 47 - (int)strlen(labels[form]), texts[form],
               r->action[0][form].value, r->action[0][form].error);
        if (s->perturb != 0.0) printf("%10.3g", r->action[1][form].value);
        putchar('\n');
    }
    if (r->methods > 0) printf("\n%-24s%14s%14s\n", "discrete action", "value", "|dS_d|/h");
    for (int k = 0; k < r->methods; k++) {
        printf("%-24s", r->method[k]);
        if (isnan(r->discrete[k].value))
            printf("%14s", "-");
        else
            printf("%14.6g", r->discrete[k].value);
        printf("%14.2g  %s\n", r->discrete[k].defect,
               r->discrete[k].is_stationary ? "stationary" : "not stationary");
    }
    if (r->methods == 0) printf("\nNo discrete actions: %s.\n", reason_of_none(r));
    return cli_close(stdout, "standard output");
}

/* The lines above the tables: the curve, and whether it is a motion; a motion's action is below its
 * error, which is the action with every second row. */
static void say_result(screen *out, const results *r)
{
    const action_settings *s = r->settings;
    const dal_curve *c = &r->curve;
    const dal_action *a = &r->action[0][DAL_ACTION_SECOND_ORDER];
    char x[SCREEN_NUMBER], y[SCREEN_NUMBER];
    screen_say(out, 2, "%s on %s: %d rows, t = %g to %g%s%s", s->simulation.request.system_name,
               s->curve, c->rows, c->t[0], c->t[c->rows - 1], r->step > 0.0 ? ", h = " : "",
               r->step > 0.0 ? screen_number(x, r->step, 6) : "");
    screen_say(out, 2, "%s: the action (nh10) is %s, with an error of %s",
               a->value <= a->error ? "A motion of the system, as far as these rows show"
                                    : "Not a motion of the system",
               screen_number(x, a->value, 2), screen_number(y, a->error, 1));
    if (r->system->m > 0)
        screen_say(out, 2, "max |D(q, q')| on the curve: %s",
                   screen_number(x, r->max_constraint, 2));
    screen_skip(out);
}

static int print_action_screen(const results *r)
{
    const bool is_perturbed = r->settings->perturb != 0.0;
    char x[SCREEN_NUMBER];
    screen_table actions = {.columns = 4 + is_perturbed, .heads = 1, .gap = 2};
    screen_table discrete = {.columns = 4, .heads = 1, .gap = 2};
    static const char *const heads[] = {"", "action", "value", "error", "perturbed"};
    static const char *const discrete_heads[] = {"discrete action", "value", "|dS_d|/h", ""};
    screen out;
    screen_open(&out, stdout, SCREEN_TEXT);
    say_result(&out, r);
    for (int i = 0; i < actions.columns; i++)
        screen_add_cell(&actions, SCREEN_PLAIN, "%s", heads[i]);
    for (int form = first_form(r); form < DAL_ACTIONS; form++) {
        const dal_action *a = &r->action[0][form];
        screen_add_cell(&actions, SCREEN_PLAIN, "%s", labels[form]);
        screen_add_cell(&actions, SCREEN_PLAIN, "%s", texts[form]);
        screen_add_cell(&actions, SCREEN_PLAIN, "%s", screen_number(x, a->value, 3));
        screen_add_cell(&actions, SCREEN_PLAIN, "%s", screen_number(x, a->error, 1));
        if (is_perturbed)
            screen_add_cell(&actions, SCREEN_PLAIN, "%s",
                            screen_number(x, r->action[1][form].value, 3));
    }
    screen_add_table(&out, &actions, "llr", 0);
    screen_free_table(&actions);
    screen_skip(&out);
    for (int i = 0; i < 4; i++) screen_add_cell(&discrete, SCREEN_PLAIN, "%s", discrete_heads[i]);
    for (int k = 0; k < r->methods && k < screen_limit(&out, SCREEN_METHODS); k++) {
        const dal_discrete_action *d = &r->discrete[k];
        screen_add_cell(&discrete, SCREEN_PLAIN, "%s", r->method[k]);
        screen_add_cell(&discrete, SCREEN_PLAIN, "%s",
                        isnan(d->value) ? "-" : screen_number(x, d->value, 3));
        screen_add_cell(&discrete, SCREEN_PLAIN, "%s", screen_number(x, d->defect, 2));
        screen_add_cell(&discrete, SCREEN_PLAIN, "%s",
                        d->is_stationary ? "stationary" : "not stationary");
    }
    if (r->methods > 0) screen_add_table(&out, &discrete, "lrrl", 0);
    screen_free_table(&discrete);
    if (r->methods > screen_limit(&out, SCREEN_METHODS))
        screen_say(&out, 2, "... and %d more methods (--details)",
                   r->methods - screen_limit(&out, SCREEN_METHODS));
    if (r->methods == 0) screen_say(&out, 2, "No discrete actions: %s.", reason_of_none(r));
    return screen_close(&out, "--details");
}

int action_evaluate(action_settings *settings)
{
    results r = {.settings = settings, .system = settings->simulation.system};
    int status = evaluate_curve(&r);
    const bool is_screen = screen_is_wanted(SCREEN_TEXT, settings->json || settings->details);
    if (status == CLI_DONE)
        status = settings->json ? put_json(&r)
                 : is_screen    ? print_action_screen(&r)
                                : print_text(&r);
    dal_evaluator_free(r.evaluator);
    csv_table_free(&r.csv);
    free(r.numbers);
    return status;
}
