/* lyapunov_results.c - Lyapunov exponents, or the rate of the volume, in words and as JSON. */
#include "lyapunov_results.h"
#include "analysis.h"
#include "io/json.h"
#include "io/store.h"
#include "run/request_json.h"
#include "ui/screen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- the results --------------------------------------------------------------------------- */

/* What cannot be distinguished from 0 after this time: exponents of regular motion are about
 * log(1 + T/tau)/T. */
static double resolution(const lyapunov_results *r)
{
    const double tau = dal_lyapunov_time_unit(r->spectrum);
    const double T = fmax((dal_run_time(dal_lyapunov_run(r->spectrum)) - r->begin) / tau, 1.0);
    return log(T + 1.0) / T / tau;
}

static const char *exponent_word(const lyapunov_results *r, const dal_average *a)
{
    if (a->low > resolution(r)) return "positive";
    return a->high < -resolution(r) ? "negative" : "may be 0";
}

/* A mean divergence is decided by its interval alone: it is a mean of known values, and log(T)/T is
 * for exponents. */
static const char *volume_word(const lyapunov_results *r, const dal_average *a)
{
    const double rounding = 1e-11 / dal_lyapunov_time_unit(r->spectrum);
    if (fabs(a->low) <= rounding && fabs(a->high) <= rounding) return "preserved at every step";
    if (a->low > 0.0) return "grows";
    return a->high < 0.0 ? "shrinks" : "may be 0";
}

static bool is_lifted(const lyapunov_results *r)
{
    return r->simulation->request.options.space == DAL_LIFTED;
}

static const char *space_word(const lyapunov_results *r) { return is_lifted(r) ? ", lifted" : ""; }

/* The directions of the space, on which e and pi_e are not varied. */
static int dimension_of(const lyapunov_results *r)
{
    return dal_run_dimension(dal_lyapunov_run(r->spectrum)) - (is_lifted(r) ? 2 : 0);
}

static const char *divergence_head(const lyapunov_results *r)
{
    return is_lifted(r) ? "divergence" : "divergence of F";
}

/* ---- all of them ----------------------------------------------------------------------------- */

static void print_mean(const char *name, const dal_average *a, const char *word)
{
    printf("%-15s %12.6g %12.5g %12.5g  %s\n", name, a->mean, a->low, a->high, word);
}

static void print_exponents(const lyapunov_results *r)
{
    dal_average a;
    for (int i = 0; i < dal_lyapunov_count(r->spectrum); i++) {
        char name[32];
        snprintf(name, sizeof name, "exponent %d", i + 1);
        dal_lyapunov_exponent(r->spectrum, i, &a);
        print_mean(name, &a, exponent_word(r, &a));
    }
    dal_lyapunov_sum(r->spectrum, &a);
    print_mean("their sum", &a, dal_lyapunov_is_whole(r->spectrum) ? "all" : "not all");
    dal_lyapunov_divergence(r->spectrum, &a);
    print_mean(divergence_head(r), &a, "exact, at every step");
    printf("\nexponents of regular motion may reach about log(1 + T/tau)/T = %.2g\n",
           resolution(r));
}

static void print_volume(const lyapunov_results *r)
{
    dal_average motion, step;
    dal_lyapunov_divergence(r->spectrum, &motion);
    dal_lyapunov_sum(r->spectrum, &step);
    print_mean(divergence_head(r), &motion, volume_word(r, &motion));
    print_mean("log|det J|/h", &step, volume_word(r, &step));
    printf("\n%d of %d directions; step less motion: %.2g\n", dal_lyapunov_count(r->spectrum),
           dimension_of(r), step.mean - motion.mean);
}

static void print_balance(const lyapunov_results *r)
{
    if (r->reason[0]) {
        printf("sum less divergence: not compared: %s\n", r->reason);
        return;
    }
    printf("sum less divergence: %.2g; the error of the method is at most about %.2g\n",
           r->balance.difference, r->balance.margin);
    if (r->balance.surface != 0.0)
        printf("(the surface that the method enforces accounts for %.2g more)\n",
               r->balance.surface);
}

void lyapunov_print(const lyapunov_results *r)
{
    char method[128];
    const dal_run *run = dal_lyapunov_run(r->spectrum);
    dal_method_name(&r->simulation->request.method, method, sizeof method);
    printf("%s, %s%s, h = %g: means over t = %g .. %g\n", r->simulation->request.system_name,
           method, space_word(r), r->simulation->request.options.step, r->begin, dal_run_time(run));
    printf("the derivative of the step %s\n\n", dal_lyapunov_is_exact(r->spectrum)
                                                    ? "exact, by the tangent system"
                                                    : "by differences of order 8");
    printf("%-15s %12s %25s\n", "", "mean", "95 % interval");
    (r->is_volume ? print_volume : print_exponents)(r);
    print_balance(r);
}

/* ---- as JSON ------------------------------------------------------------------------------- */

static void put_mean(json_writer *w, const char *name, const dal_average *a, const char *word)
{
    json_open(w, name, JSON_ON_ONE_LINE);
    json_put_number(w, "mean", a->mean);
    json_put_number(w, "low", a->low);
    json_put_number(w, "high", a->high);
    if (word) json_put_text(w, "result", word);
    json_close(w);
}

static void put_exponents(json_writer *w, const lyapunov_results *r)
{
    dal_average a;
    json_open_list(w, "exponents", JSON_LINES);
    for (int i = 0; i < dal_lyapunov_count(r->spectrum); i++) {
        dal_lyapunov_exponent(r->spectrum, i, &a);
        put_mean(w, NULL, &a, exponent_word(r, &a));
    }
    json_close(w);
    dal_lyapunov_sum(r->spectrum, &a);
    put_mean(w, "sum", &a, NULL);
    json_put_bool(w, "sum_is_of_all", dal_lyapunov_is_whole(r->spectrum));
    dal_lyapunov_divergence(r->spectrum, &a);
    put_mean(w, "divergence", &a, NULL);
}

static void put_volume(json_writer *w, const lyapunov_results *r)
{
    dal_average motion, step;
    dal_lyapunov_divergence(r->spectrum, &motion);
    dal_lyapunov_sum(r->spectrum, &step);
    put_mean(w, "divergence", &motion, volume_word(r, &motion));
    put_mean(w, "step", &step, volume_word(r, &step));
    json_put_integer(w, "directions", dal_lyapunov_count(r->spectrum));
    json_put_integer(w, "dimension", dimension_of(r));
}

static void put_balance(json_writer *w, const lyapunov_results *r)
{
    const bool is_compared = !r->reason[0];
    json_open(w, "balance", JSON_LINES);
    json_put_number(w, "difference", is_compared ? r->balance.difference : NAN);
    json_put_number(w, "margin", is_compared ? r->balance.margin : NAN);
    json_put_number(w, "surface", is_compared ? r->balance.surface : NAN);
    json_put_text(w, "reason", is_compared ? NULL : r->reason);
    json_close(w);
}

void lyapunov_put(const lyapunov_results *r)
{
    json_writer w = json_begin_results(r->is_volume ? "volume" : "lyapunov");
    request_open_json(&w, r->simulation, LYAPUNOV_WITHOUT);
    json_put_number(&w, "transient", r->transient);
    json_close(&w);
    json_put_text(&w, "state", store_state_words[store_end_state(r->status)]);
    json_put_number(&w, "from", r->begin);
    json_put_number(&w, "to", dal_run_time(dal_lyapunov_run(r->spectrum)));
    json_put_text(&w, "derivative", dal_lyapunov_is_exact(r->spectrum) ? "exact" : "differences");
    json_put_number(&w, "resolution", r->is_volume ? NAN : resolution(r));
    (r->is_volume ? put_volume : put_exponents)(&w, r);
    put_balance(&w, r);
    json_end_results(&w);
}

/* ---- on a terminal ------------------------------------------------------------------------- */

enum { ROWS = 12 };

static void add_mean(screen_table *t, const char *name, const dal_average *a, const char *word)
{
    char x[SCREEN_NUMBER];
    screen_add_cell(t, SCREEN_PLAIN, "%s", name);
    screen_add_cell(t, SCREEN_PLAIN, "%s", screen_number(x, a->mean, 2));
    screen_add_cell(t, SCREEN_FAINT, "%s", screen_number(x, a->low, 2));
    screen_add_cell(t, SCREEN_FAINT, "%s", screen_number(x, a->high, 2));
    screen_add_cell(t, SCREEN_PLAIN, "%s", word);
}

static void add_heads(screen_table *t)
{
    static const char *const heads[] = {"", "mean", "from", "to", "95 % interval"};
    for (int i = 0; i < t->columns; i++) screen_add_cell(t, SCREEN_PLAIN, "%s", heads[i]);
}

static void say_exponents(screen *out, const lyapunov_results *r)
{
    static const char *const words[] = {"positive", "may be 0", "negative"};
    enum { KINDS = sizeof words / sizeof words[0] };
    const int count = dal_lyapunov_count(r->spectrum);
    int of_kind[KINDS] = {0};
    char x[3][SCREEN_NUMBER];
    dal_average largest, a;
    dal_lyapunov_exponent(r->spectrum, 0, &largest);
    for (int i = 0; i < count; i++) {
        dal_lyapunov_exponent(r->spectrum, i, &a);
        for (int k = 0; k < KINDS; k++) of_kind[k] += strcmp(exponent_word(r, &a), words[k]) == 0;
    }
    screen_say(out, 2, "The largest exponent is %s per unit of t (%s to %s)",
               screen_number(x[0], largest.mean, 2), screen_number(x[1], largest.low, 2),
               screen_number(x[2], largest.high, 2));
    if (of_kind[0] > 0)
        screen_say(out, 2, "It is positive: the motion is chaotic if it is bounded");
    else
        screen_say(out, 2, "It is not found positive: in this time regular motion may reach %s",
                   screen_number(x[0], resolution(r), 2));
    screen_say(out, 2, "%d exponents: %d positive, %d may be 0, %d negative", count, of_kind[0],
               of_kind[1], of_kind[2]);
}

static void add_exponents(screen *out, const lyapunov_results *r)
{
    const int count = dal_lyapunov_count(r->spectrum), shown = screen_limit(out, ROWS);
    screen_table t = {.columns = 5, .heads = 1};
    dal_average a;
    add_heads(&t);
    for (int i = 0; i < count && i < shown; i++) {
        char name[32];
        snprintf(name, sizeof name, "exponent %d", i + 1);
        dal_lyapunov_exponent(r->spectrum, i, &a);
        add_mean(&t, name, &a, exponent_word(r, &a));
    }
    dal_lyapunov_sum(r->spectrum, &a);
    add_mean(&t, "their sum", &a, dal_lyapunov_is_whole(r->spectrum) ? "all" : "not all");
    dal_lyapunov_divergence(r->spectrum, &a);
    add_mean(&t, divergence_head(r), &a, "");
    screen_add_table(out, &t, "lrrrl", 0);
    screen_free_table(&t);
    if (count > shown) screen_say(out, 2, "... and %d more (--details)", count - shown);
}

static void say_volume(screen *out, const lyapunov_results *r)
{
    dal_average motion, step;
    dal_lyapunov_divergence(r->spectrum, &motion);
    dal_lyapunov_sum(r->spectrum, &step);
    screen_say(out, 2, "The volume of (%s) in the motion: %s; in the method's steps: %s",
               is_lifted(r) ? "q, v, p, pi" : "q, v", volume_word(r, &motion),
               volume_word(r, &step));
}

static void add_volume(screen *out, const lyapunov_results *r)
{
    screen_table t = {.columns = 5, .heads = 1};
    dal_average a;
    add_heads(&t);
    dal_lyapunov_divergence(r->spectrum, &a);
    add_mean(&t, divergence_head(r), &a, volume_word(r, &a));
    dal_lyapunov_sum(r->spectrum, &a);
    add_mean(&t, "log|det J|/h", &a, volume_word(r, &a));
    screen_add_table(out, &t, "lrrrl", 0);
    screen_free_table(&t);
}

static void say_balance(screen *out, const lyapunov_results *r)
{
    char x[2][SCREEN_NUMBER];
    if (r->reason[0]) {
        screen_say(out, 2, "The sum is not compared with the divergence: %s", r->reason);
        return;
    }
    screen_say(out, 2,
               "The sum %s the divergence: they differ by %s, the method's error is at "
               "most about %s",
               r->balance.holds ? "agrees with" : "contradicts",
               screen_number(x[0], r->balance.difference, 2),
               screen_number(x[1], r->balance.margin, 2));
}

int lyapunov_print_screen(const lyapunov_results *r, screen_format format)
{
    const dal_run *run = dal_lyapunov_run(r->spectrum);
    char method[128], x[3][SCREEN_NUMBER];
    screen out;
    screen_open(&out, stdout, format);
    dal_method_name(&r->simulation->request.method, method, sizeof method);
    screen_say(&out, 2, "%s by %s%s, h = %s, t = %s .. %s", r->simulation->request.system_name,
               method, space_word(r), screen_number(x[0], r->simulation->request.options.step, 4),
               screen_number(x[1], r->begin, 4), screen_number(x[2], dal_run_time(run), 4));
    (r->is_volume ? say_volume : say_exponents)(&out, r);
    screen_skip(&out);
    (r->is_volume ? add_volume : add_exponents)(&out, r);
    screen_skip(&out);
    say_balance(&out, r);
    return screen_close(&out, "--details");
}
