/* check.c - examines a system before a run.
 *
 * No property that a system states is trusted: flags, derivatives, invariants and exact solutions
 * are compared with numbers at the start and at random points about it. */
#include "check.h"
#include "check_screen.h"
#include "dalembert_codegen.h"
#include "io/json.h"
#include "run/request_json.h"
#include "ui/memory.h"
#include "ui/screen.h"
#include "ui/wrap.h"

#include "check_items.h"
#include "check_sections.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Points are this far from the start, in units of the system. */
static const double neighbourhood = 0.1;
enum { MAX_ATTEMPTS = 20 * CHECK_POINTS, VALUE_COLUMN = 44 };

static const char *const result_words[] = {
#define RESULT_TEXT(code, text) text,
    CHECK_RESULT_LIST(RESULT_TEXT)
#undef RESULT_TEXT
};

/* ---- points about the start ---- */

static bool is_field_finite(check *c, const dal_point *at)
{
    if (dal_evaluator_call(c->evaluator, c->system->call.field, at->t, at->q, at->v, NULL,
                           c->values))
        return false;
    for (int i = 0; i < c->nw; i++)
        if (!isfinite(c->values[i])) return false;
    return true;
}

/* Uniform on [-1, 1), the same in every run of the program. */
static double random_number(unsigned long long *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

/* memory: for 2 CHECK_POINTS points of size numbers. */
static void choose_points(check *c, double *memory)
{
    unsigned long long random = 42;
    for (int k = 0; k < MAX_ATTEMPTS && c->near_count < CHECK_POINTS; k++) {
        double *x = memory + c->near_count * c->size;
        for (int i = 0; i < c->size; i++) {
            x[i] = c->start[i] + neighbourhood * random_number(&random);
        }
        c->near[c->near_count] =
            (dal_point){.t = c->origin.t + fabs(random_number(&random)), .q = x, .v = x + c->n};
        c->near_count += is_field_finite(c, &c->near[c->near_count]);
    }
    memory += CHECK_POINTS * c->size;
    for (int k = 0; k < c->near_count; k++) {
        double *x = memory + c->surface_count * c->size, t = c->near[k].t;
        memcpy(x, c->near[k].q, (size_t)c->size * sizeof *x);
        if (!cli_is_ok(dal_evaluator_project_position(c->evaluator, t, x, x + c->n)) ||
            !cli_is_ok(dal_evaluator_project_velocity(c->evaluator, t, x, x + c->n)))
            continue;
        c->surface[c->surface_count] = (dal_point){.t = t, .q = x, .v = x + c->n};
        c->surface_count += is_field_finite(c, &c->surface[c->surface_count]);
    }
}

/* ---- all ---- */

static int scale_system(check *c)
{
    const run_request *request = &c->simulation->request;
    const dal_run_spec spec = simulation_spec(c->simulation);
    dal_error error = {0};
    const dal_status status = dal_scaled_create(&c->scaled, &spec, &error);
    c->system = dal_scaled_system(c->scaled);
    if (status == DAL_STATUS_OK) return CLI_DONE;
    return cli_error(cli_input_exit(status), error.line ? request->system_name : NULL, &error);
}

static int prepare_check(check *c)
{
    const int scaled = scale_system(c);
    if (scaled != CLI_DONE) return scaled;
    const dal_system *s = c->system;
    const run_request *request = &c->simulation->request;
    dal_error error = {0};
    c->n = s->n, c->m = s->m, c->nw = s->n + s->multipliers, c->size = c->n + c->nw;
    const size_t n = (size_t)c->n, m = (size_t)c->m, nw = (size_t)c->nw, size = (size_t)c->size;
    const size_t points = 2 * CHECK_POINTS * size;
    /* The largest number of values of a callback, and some more for pairs of them. */
    const size_t values = nw * size + m * (1 + 2 * n) + 3 * n + (size_t)s->invariants + 8 * size;
    dal_status status =
        dal_evaluator_create(&c->evaluator, s, request->set.item, request->set.count, &error);
    if (!cli_is_ok(status)) return cli_error(cli_input_exit(status), NULL, &error);
    c->start = cli_calloc(size + 1 + points + values, sizeof *c->start);
    c->values = c->start + size + 1 + points;
    cli_is_ok(dal_evaluator_start(c->evaluator, NULL, 0, c->start, &error));
    c->origin = (dal_point){
        .t = request->from / dal_scaled_units(c->scaled)[0], .q = c->start, .v = c->start + n};
    c->is_regular = is_field_finite(c, &c->origin);
    choose_points(c, c->start + size + 1);
    return CLI_DONE;
}

static void examine(check *c)
{
    for (int k = 0; k < CHECK_SECTIONS; k++) {
        const int items = c->items;
        c->section = check_sections[k].title;
        check_sections[k].examine(c);
        if (c->items == items) check_item(c, CHECK_INFO, NULL, "does not apply");
    }
}

/* ---- in words ---- */

static void print_check(const check *c)
{
    const dal_system *s = c->system;
    const char *section = NULL;
    printf("%s", s->name);
    if (s->title) printf(": %s", s->title);
    printf("\n%d coordinates, %d constraints", c->n, c->m);
    if (s->multipliers > 0) printf(", %d multipliers (vakonomic)", s->multipliers);
    if (s->reference) printf("; %s", s->reference);
    putchar('\n');
    for (const check_entry *e = c->entry; e < c->entry + c->items; e++) {
        if (e->section != section) printf("\n%s\n", e->section);
        section = e->section;
        const int column =
            printf("  %-34s  %-4s  ", e->what ? e->what : "-", result_words[e->result]);
        cli_wrap(stdout, e->text, column, VALUE_COLUMN);
    }
    printf("\n%d items, %d failed", c->items, c->failed);
    if (c->unmeasured > 0) printf(", %d not measured", c->unmeasured);
    putchar('\n');
}

/* ---- as JSON ---- */

static void put_item(json_writer *w, const check_entry *e)
{
    json_open(w, NULL, JSON_ON_ONE_LINE);
    json_put_text(w, "section", e->section);
    json_put_text(w, "item", e->what);
    json_put_text(w, "result", result_words[e->result]);
    json_put_number(w, "value", e->value);
    json_put_number(w, "at_least", e->least);
    json_put_number(w, "at_most", e->most);
    json_put_text(w, "text", e->text);
    json_close(w);
}

static void put_method(json_writer *w, const check_method *k)
{
    static const char *const words[] = {
#define PRESERVED_WORD(code, word) word,
        CHECK_PRESERVED_LIST(PRESERVED_WORD)
#undef PRESERVED_WORD
    };
    json_open(w, NULL, JSON_ON_ONE_LINE);
    json_put_text(w, "integrator", k->name);
    json_put_bool(w, "accepted", !k->reason);
    json_put_text(w, "reason", k->reason);
    json_open_list(w, "preserves", JSON_ON_ONE_LINE);
    for (int i = 0; i < CHECK_PRESERVED; i++)
        if (k->preserved >> i & 1) json_put_text(w, NULL, words[i]);
    json_close(w);
    json_close(w);
}

static void put_check(const check *c)
{
    const dal_system *s = c->system;
    json_writer w = json_begin_results("check");
    request_open_json(&w, c->simulation, ~UINT64_C(0));
    json_close(&w);
    json_put_text(&w, "title", s->title);
    json_put_text(&w, "reference", s->reference);
    json_put_integer(&w, "coordinates", c->n);
    json_put_integer(&w, "constraints", c->m);
    json_put_integer(&w, "multipliers", s->multipliers);
    json_open_list(&w, "items", JSON_LINES);
    for (int i = 0; i < c->items; i++)
        if (c->entry[i].what) put_item(&w, &c->entry[i]);
    json_close(&w);
    if (c->preservers < 0) json_put_text(&w, "preserving", NULL);
    if (c->preservers >= 0) json_open_list(&w, "preserving", JSON_ON_ONE_LINE);
    for (int i = 0; i < c->preservers; i++) json_put_text(&w, NULL, c->preserving[i]);
    if (c->preservers >= 0) json_close(&w);
    if (c->growth.levels == 0) json_put_text(&w, "growth", NULL);
    if (c->growth.levels > 0) json_open_list(&w, "growth", JSON_ON_ONE_LINE);
    for (int k = 0; k < c->growth.levels; k++) json_put_integer(&w, NULL, c->growth.rank[k]);
    if (c->growth.levels > 0) json_close(&w);
    json_put_integer(&w, "growth_dimension", c->growth.dimension);
    json_put_bool(&w, "growth_complete", c->growth.is_complete);
    json_open_list(&w, "methods", JSON_LINES);
    for (int i = 0; i < c->methods; i++) put_method(&w, &c->method[i]);
    json_close(&w);
    json_put_integer(&w, "failed", c->failed);
    json_put_integer(&w, "not_measured", c->unmeasured);
    json_end_results(&w);
}

/* ---- */

static void free_check(check *c)
{
    for (int i = 0; i < c->items; i++) {
        free(c->entry[i].what);
        free(c->entry[i].text);
    }
    for (int i = 0; i < c->preservers; i++) free(c->preserving[i]);
    for (int i = 0; i < c->methods; i++) {
        free(c->method[i].name);
        free(c->method[i].reason);
    }
    free(c->method);
    free(c->preserving);
    free(c->entry);
    free(c->start);
    dal_evaluator_free(c->evaluator);
    dal_scaled_free(c->scaled);
}

typedef dal_status equations_writer(dal_model *model, char **text, dal_error *error);

static int print_equations(const run_simulation *simulation, equations_writer *write)
{
    char *text;
    dal_error error = {0};
    const dal_status status = write(simulation->model, &text, &error);
    if (!cli_is_ok(status))
        return cli_error(cli_input_exit(status), simulation->request.system_name, &error);
    fputs(text, stdout);
    free(text);
    return cli_close(stdout, "standard output");
}

int check_system(check_settings *settings)
{
    check c = {.simulation = &settings->simulation, .preservers = -1};
    const bool is_typeset = settings->latex || settings->mathml;
    if (is_typeset && (settings->json || settings->details))
        return cli_fail(CLI_USAGE, "check: --%s excludes --json and --details",
                        settings->latex ? "latex" : "mathml");
    if (settings->latex && settings->mathml)
        return cli_fail(CLI_USAGE, "check: --latex excludes --mathml");
    if (is_typeset)
        return print_equations(c.simulation, settings->latex ? dal_model_latex : dal_model_mathml);
    int status = prepare_check(&c);
    if (status == CLI_DONE) {
        examine(&c);
        if (!settings->json && !settings->details && screen_has_reader()) {
            status = check_print_screen(&c);
        } else {
            (settings->json ? put_check : print_check)(&c);
            status = cli_close(stdout, "standard output");
        }
    }
    if (status == CLI_DONE && c.failed + c.unmeasured > 0) status = CLI_CHECK;
    free_check(&c);
    return status;
}
