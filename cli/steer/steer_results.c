/* steer_results.c - motions from one state to another, as a screen and as JSON. */
#include "steer_results.h"
#include "io/json.h"
#include "io/store.h"
#include "run/request_json.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME = 80, DIGITS = 6 };

/* ---- what can be reached ------------------------------------------------------------------- */

const char *steer_format_reach(char text[STEER_REACH], const steer_settings *settings,
                               const dal_steering *steering)
{
    const dal_system *system = settings->simulation.system;
    const int numbers = 2 * steering->n, on_D = numbers - system->m - system->holonomic;
    const bool is_controlled = system->effort == DAL_EFFORT_CONTROLS;
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; steering->has_growth && i < steering->growth.levels; i++)
        length +=
            (size_t)snprintf(text + length, STEER_REACH - length, "%s%d",
                             i == 0 ? "D has the growth vector (" : ", ", steering->growth.rank[i]);
    if (length > 0) length += (size_t)snprintf(text + length, STEER_REACH - length, "): ");
    if (steering->allowed < 0)
        snprintf(text + length, STEER_REACH - length,
                 "how many of the %d numbers of an end can be reached is not known", numbers);
    else
        snprintf(text + length, STEER_REACH - length,
                 is_controlled ? "controls change %d of the %d numbers of an end, about generic "
                                 "motions%s"
                               : "%d of the %d numbers of an end can be reached%s",
                 steering->allowed, numbers,
                 steering->allowed == numbers ? ""
                 : steering->allowed == on_D  ? ", all that D = 0 leaves"
                 : is_controlled              ? ", on one leaf alone"
                                              : ", on the leaf of the start alone");
    return text;
}

/* ---- as a screen --------------------------------------------------------------------------- */

/* The given value of component i of the target; NaN: it is free. */
static double find_target(const steer_results *r, const char *name, int i)
{
    const request_settings *target = &r->set->target;
    for (int k = 0; k < target->count; k++)
        if (strcmp(target->item[k].name, name) == 0) return target->item[k].value;
    return r->set->rest && i >= r->steering->n ? 0.0 : NAN;
}

static void say_best(screen *out, const steer_results *r)
{
    const run_simulation *s = &r->set->simulation;
    const dal_steering *steering = r->steering;
    char method[NAME], x[4][SCREEN_NUMBER];
    const char *name = s->request.system_name;
    dal_method_name(&s->request.method, method, sizeof method);
    if (steering->count == 0) {
        screen_say(out, 2, "%s: interrupted before there was a motion", name);
        return;
    }
    const dal_extremal *best = steering->extremal;
    screen_number(x[0], best->S, DIGITS);
    screen_number(x[1], best->distance, 2);
    screen_number(x[2], s->end, DIGITS);
    if (best->status == DAL_STATUS_OK)
        screen_say(out, 2, "%s reaches the target at t = %s for S = %s", name, x[2], x[0]);
    else if (isfinite(best->distance))
        screen_say(out, 2, "%s is %s from the target at t = %s; jumps of %s remain", name, x[1],
                   x[2], screen_number(x[3], best->residual, 2));
    else
        screen_say(out, 2, "%s is not led to t = %s: along the nearest motion a step fails", name,
                   x[2]);
    screen_say(out, 2, "By %s, h = %s%s%s", method, screen_number(x[0], s->request.options.step, 4),
               steering->inputs > 0 ? ", effort " : "",
               steering->inputs > 0 ? dal_effort_name(s->system->effort) : "");
    if (best->rank >= 0 && best->status == DAL_STATUS_OK)
        screen_say(out, 2, "Momenta change %d of the %d numbers of the end", best->rank,
                   2 * steering->n);
    if (best->conjugate_times == 0 && best->status == DAL_STATUS_OK)
        screen_say(out, 2, "No conjugate time: among near motions it is the cheapest");
    if (best->conjugate_times > 0)
        screen_say(out, 2, "%d conjugate times, the first near t = %s: near motions cost less",
                   best->conjugate_times, screen_number(x[0], best->first_conjugate, 4));
}

/* A number, or "-" where it is not known. */
static void add_number(screen_table *t, double x, int digits)
{
    char text[SCREEN_NUMBER];
    if (!isfinite(x))
        screen_add_cell(t, SCREEN_FAINT, "-");
    else
        screen_add_cell(t, SCREEN_PLAIN, "%s", screen_number(text, x, digits));
}

static void add_heads(screen_table *t, const char *const *heads)
{
    for (int i = 0; i < t->columns; i++) screen_add_cell(t, SCREEN_PLAIN, "%s", heads[i]);
}

static void add_motions(screen *out, const steer_results *r)
{
    static const char *const heads[] = {"motion",  "S",          "distance",  "residual",
                                        "max |D|", "iterations", "conjugate", "condition"};
    screen_table t = {.columns = sizeof heads / sizeof *heads, .heads = 1};
    add_heads(&t, heads);
    for (int k = 0; k < r->steering->count; k++) {
        const dal_extremal *e = &r->steering->extremal[k];
        const bool is_found = e->status == DAL_STATUS_OK;
        if (is_found)
            screen_add_cell(&t, SCREEN_PLAIN, "%d", k + 1);
        else
            screen_add_cell(&t, SCREEN_PLAIN, "not reached");
        add_number(&t, e->S, DIGITS);
        add_number(&t, e->distance, 2);
        add_number(&t, e->residual, 2);
        add_number(&t, e->max_D, 2);
        add_number(&t, e->iterations, DIGITS);
        add_number(&t, is_found && e->conjugate_times >= 0 ? e->conjugate_times : NAN, DIGITS);
        add_number(&t, e->condition > 0.0 ? e->condition : NAN, 2);
    }
    screen_add_table(out, &t, "lr", 2);
    screen_free_table(&t);
}

/* The ends of the first motion. */
static void add_ends(screen *out, const steer_results *r)
{
    const dal_steering *steering = r->steering;
    const double *start = steering->extremal->z;
    const double *end = start + (steering->rows - 1) * steering->dimension;
    static const char *const heads[] = {"", "start", "end", "target"};
    char name[NAME];
    screen_table t = {.columns = 4, .heads = 1};
    add_heads(&t, heads);
    const int shown = screen_limit(out, 2 * steering->n); /* without momenta */
    for (int i = 0; i < steering->dimension && i < shown; i++) {
        dal_run_component_name(r->set->simulation.run, i, name, sizeof name);
        screen_add_cell(&t, SCREEN_PLAIN, "%s", name);
        add_number(&t, start[i], DIGITS);
        add_number(&t, end[i], DIGITS);
        add_number(&t, i < 2 * steering->n ? find_target(r, name, i) : NAN, DIGITS);
    }
    screen_add_table(out, &t, "lr", 2);
    screen_free_table(&t);
}

int steer_print_screen(const steer_results *r, const char *again)
{
    screen out;
    screen_open(&out, stdout, r->set->format);
    say_best(&out, r);
    if (r->steering->count > 0) {
        screen_skip(&out);
        add_motions(&out, r);
        screen_skip(&out);
        add_ends(&out, r);
    }
    if (r->set->output || again) screen_skip(&out);
    if (r->set->output && r->status == CLI_DONE)
        screen_say(&out, 2, "Page:  dalembert report %s", r->set->output);
    if (again) screen_say_command(&out, "Again: ", again);
    return screen_close(&out, NULL);
}

/* ---- as JSON ------------------------------------------------------------------------------- */

/* A count that is not known is null. */
static void put_count(json_writer *w, const char *name, int count)
{
    if (count < 0)
        json_put_source(w, name, "null");
    else
        json_put_integer(w, name, count);
}

static void put_extremal(json_writer *w, const dal_steering *s, const dal_extremal *e)
{
    json_open(w, NULL, JSON_LINES);
    json_put_text(w, "status", dal_status_name(e->status));
    json_put_text(w, "message", e->message[0] ? e->message : NULL);
    json_put_number(w, "S", e->S);
    json_put_number(w, "residual", e->residual);
    json_put_number(w, "distance", e->distance);
    json_put_number(w, "max_D", e->max_D);
    json_put_number(w, "condition", e->condition);
    json_put_integer(w, "iterations", e->iterations);
    put_count(w, "rank", e->rank);
    put_count(w, "conjugate_times", e->conjugate_times);
    json_put_number(w, "first_conjugate", e->first_conjugate);
    json_put_numbers(w, "start", e->z, s->dimension);
    json_put_numbers(w, "end", e->z + (s->rows - 1) * s->dimension, s->dimension);
    json_close(w);
}

void steer_put_json(FILE *out, const steer_results *r)
{
    const dal_steering *s = r->steering;
    const run_simulation *simulation = &r->set->simulation;
    char name[NAME];
    json_writer w = json_begin_results_in(out, "steer");
    request_open_json(&w, simulation, STEER_WITHOUT);
    request_put_settings(&w, "target", &r->set->target);
    json_put_text(&w, "free", r->set->free_starts);
    json_put_bool(&w, "rest", r->set->rest);
    json_put_bool(&w, "aim", r->set->aim);
    json_put_integer(&w, "starts", r->set->starts);
    json_put_integer(&w, "seed", r->set->seed);
    json_put_integer(&w, "max_iterations", r->set->iterations);
    json_close(&w);
    json_put_text(&w, "state", store_state_words[store_end_state(r->status)]);
    json_put_number(&w, "from", simulation->request.from);
    json_put_number(&w, "to", simulation->end);
    put_count(&w, "allowed_rank", s->allowed);
    json_open_list(&w, "growth", JSON_ON_ONE_LINE);
    for (int i = 0; s->has_growth && i < s->growth.levels; i++)
        json_put_integer(&w, NULL, s->growth.rank[i]);
    json_close(&w);
    json_open_list(&w, "names", JSON_ON_ONE_LINE);
    for (int i = 0; i < s->dimension; i++)
        json_put_text(&w, NULL, dal_run_component_name(simulation->run, i, name, sizeof name));
    json_close(&w);
    json_open_list(&w, "motions", JSON_LINES);
    for (int k = 0; k < s->count; k++) put_extremal(&w, s, &s->extremal[k]);
    json_close(&w);
    json_end_results(&w);
}

int steer_print_json(const steer_results *r)
{
    steer_put_json(stdout, r);
    return cli_close(stdout, "standard output");
}
