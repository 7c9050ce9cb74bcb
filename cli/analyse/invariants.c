/* invariants.c - invariants of a system's motion, found from its formulas. */
#include "invariants.h"
#include "dalembert_invariants.h"
#include "io/json.h"
#include "io/text.h"
#include "run/request.h"
#include "run/request_json.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 2 };

/* ---- --with -------------------------------------------------------------------------------- */

/* The formulas of a list with commas between them, outside of parentheses; allocated. */
typedef struct formulas {
    char **text;
    int count;
} formulas;

static formulas split_list(const char *list)
{
    formulas f = {.text = NULL};
    while (list) {
        const char *end = text_find_comma(list);
        list += strspn(list, " ");
        size_t length = end > list ? (size_t)(end - list) : 0;
        while (length > 0 && list[length - 1] == ' ') length--;
        f.text = cli_realloc(f.text, ((size_t)f.count + 1) * sizeof *f.text);
        f.text[f.count++] = cli_strndup(list, length);
        list = *end ? end + 1 : NULL;
    }
    return f;
}

/* ---- the search ---------------------------------------------------------------------------- */

/* An error of a formula of --with: the user knows its place in the list. */
static int refuse(const run_simulation *s, dal_status status, dal_error *error)
{
    static const char prefix[] = "observed: ";
    const size_t length = sizeof prefix - 1;
    if (strncmp(error->message, prefix, length) != 0)
        return cli_error(cli_input_exit(status), s->request.system_name, error);
    char *place = cli_format("--with, formula %d", error->line);
    memmove(error->message, error->message + length, strlen(error->message + length) + 1);
    error->line = 1;
    const int exit_status = cli_error(CLI_USAGE, place, error);
    free(place);
    return exit_status;
}

static int search(const invariants_settings *settings, dal_invariants **found)
{
    const run_simulation *s = &settings->simulation;
    const dal_run_spec spec = simulation_spec(s);
    formulas with = split_list(settings->with);
    dal_invariants_settings set = dal_invariants_settings_default();
    dal_error error = {0};
    set.degree = (int)settings->degree;
    set.measures = settings->measure;
    set.with = (const char *const *)with.text;
    set.with_count = with.count;
    const dal_status status = dal_find_invariants(found, s->model, &spec, &set, &error);
    for (int i = 0; i < with.count; i++) free(with.text[i]);
    free(with.text);
    return cli_is_ok(status) ? CLI_DONE : refuse(s, status, &error);
}

/* ---- words --------------------------------------------------------------------------------- */

static const char *kind_of(const dal_invariant *i)
{
    return !i->independent ? "dependent" : i->is_new ? "new" : "known";
}

static const char *digits_of(bool exact) { return exact ? "exact" : "to rounding"; }

static const char *parameters_of(bool any) { return any ? "any parameters" : "these parameters"; }

/* ---- as a block of a system file ----------------------------------------------------------- */

void invariants_next_name(const dal_system *system, int *number, char name[INVARIANTS_NAME])
{
    do snprintf(name, INVARIANTS_NAME, "I%d", ++*number);
    while (cli_has_name(system, name));
}

static void print_search(const run_simulation *s, const dal_invariants *found)
{
    char x[SCREEN_NUMBER];
    printf("# %s: %d invariant%s, %d independent\n", s->system->name, found->count,
           found->count == 1 ? "" : "s", found->independent);
    printf("# sums of %d products of degree 1 to %d of", found->products, found->degree);
    for (int i = 0; i < found->atoms; i++) printf("%s %s", i > 0 ? "," : "", found->atom[i]);
    printf("; %d functions on D = 0\n", found->functions);
    if (!isnan(found->largest_zero))
        printf("# singular values that count as 0: at most %s",
               screen_number(x, found->largest_zero, DIGITS));
    if (!isnan(found->least_change))
        printf("%s at least %s",
               isnan(found->largest_zero) ? "# singular values:" : "; the others:",
               screen_number(x, found->least_change, DIGITS));
    putchar('\n');
}

static int print_block(const invariants_settings *settings, const dal_invariants *found)
{
    const run_simulation *s = &settings->simulation;
    char name[INVARIANTS_NAME];
    int number = 0;
    print_search(s, found);
    if (found->count > 0) puts("invariants:");
    for (const dal_invariant *i = found->invariant; i < found->invariant + found->count; i++) {
        if (i->independent) invariants_next_name(s->system, &number, name);
        printf("  %s%s: %s  # %s, %s, %s\n", i->independent ? "" : "# ",
               i->independent ? name : "and", i->formula, kind_of(i), digits_of(i->exact),
               parameters_of(i->at_any_parameters));
    }
    for (int i = 0; i < found->measures; i++)
        printf("# measure: rho^(%g) = %s, %s, %s\n", found->measure[i].power,
               found->measure[i].formula, digits_of(found->measure[i].exact),
               parameters_of(found->measure[i].at_any_parameters));
    if (settings->measure && found->measures == 0) puts("# measure: none");
    return cli_close(stdout, "standard output");
}

/* ---- on a terminal ------------------------------------------------------------------------- */

static int print_screen(const invariants_settings *settings, const dal_invariants *found)
{
    enum { ROWS = 12 };
    static const char *const heads[] = {"kind", "confirmed", "for", "invariant"};
    const run_simulation *s = &settings->simulation;
    char x[SCREEN_NUMBER], y[SCREEN_NUMBER];
    char *atoms = screen_list_names(found->atom, found->atoms, 50);
    screen out;
    screen_open(&out, stdout, SCREEN_TEXT);
    screen_say(&out, 2, "%s: %d invariant%s, %d independent, of degree %d in %s", s->system->name,
               found->count, found->count == 1 ? "" : "s", found->independent, found->degree,
               atoms);
    if (!isnan(found->largest_zero) && !isnan(found->least_change))
        screen_say(&out, 2, "Singular values: %s counts as 0, the next one is %s",
                   screen_number(x, found->largest_zero, DIGITS),
                   screen_number(y, found->least_change, DIGITS));
    screen_skip(&out);
    screen_table t = {.columns = 4};
    const int rows = found->count < ROWS ? found->count : ROWS;
    for (int i = 0; i < 4; i++) screen_add_cell(&t, SCREEN_PLAIN, "%s", heads[i]);
    for (int i = 0; i < rows; i++) {
        const dal_invariant *k = &found->invariant[i];
        screen_add_cell(&t, SCREEN_PLAIN, "%s", kind_of(k));
        screen_add_cell(&t, SCREEN_PLAIN, "%s", digits_of(k->exact));
        screen_add_cell(&t, SCREEN_PLAIN, "%s", parameters_of(k->at_any_parameters));
        screen_add_cell(&t, SCREEN_PLAIN, "%s", k->formula);
    }
    if (found->count > 0) screen_add_table(&out, &t, "lllw", 0);
    screen_free_table(&t);
    if (rows < found->count)
        screen_say(&out, 2, "... and %d more (--details)", found->count - rows);
    for (int i = 0; i < found->measures; i++)
        screen_say(&out, 2, "Measure: rho^(%g) = %s", found->measure[i].power,
                   found->measure[i].formula);
    if (settings->measure && found->measures == 0) screen_say(&out, 2, "Measure: none");
    screen_skip(&out);
    screen_say(&out, 2,
               found->count > 0 ? "A block for the system file: --details, or a pipe"
                                : "More products: --degree %d, --with FORMULAS",
               found->degree + 1);
    free(atoms);
    return screen_close(&out, "--details");
}

/* ---- as JSON ------------------------------------------------------------------------------- */

static void put_confirmation(json_writer *w, bool exact, bool any)
{
    json_put_bool(w, "exact", exact);
    json_put_bool(w, "any_parameters", any);
    json_close(w);
}

static int put_invariants(const invariants_settings *settings, const dal_invariants *found)
{
    json_writer w = json_begin_results("invariants");
    request_open_json(&w, &settings->simulation, ~UINT64_C(0));
    json_close(&w);
    json_put_integer(&w, "degree", found->degree);
    json_open_list(&w, "atoms", JSON_ON_ONE_LINE);
    for (int i = 0; i < found->atoms; i++) json_put_text(&w, NULL, found->atom[i]);
    json_close(&w);
    json_put_integer(&w, "products", found->products);
    json_put_integer(&w, "functions", found->functions);
    json_put_number(&w, "least_change", found->least_change);
    json_put_number(&w, "largest_zero", found->largest_zero);
    json_put_integer(&w, "independent", found->independent);
    json_open_list(&w, "invariants", JSON_LINES);
    for (const dal_invariant *i = found->invariant; i < found->invariant + found->count; i++) {
        json_open(&w, NULL, JSON_ON_ONE_LINE);
        json_put_text(&w, "formula", i->formula);
        json_put_integer(&w, "terms", i->terms);
        json_put_bool(&w, "independent", i->independent);
        json_put_bool(&w, "new", i->is_new);
        put_confirmation(&w, i->exact, i->at_any_parameters);
    }
    json_close(&w);
    if (!settings->measure) json_put_text(&w, "measures", NULL);
    if (settings->measure) json_open_list(&w, "measures", JSON_LINES);
    for (int i = 0; i < found->measures; i++) {
        json_open(&w, NULL, JSON_ON_ONE_LINE);
        json_put_number(&w, "power", found->measure[i].power);
        json_put_text(&w, "formula", found->measure[i].formula);
        put_confirmation(&w, found->measure[i].exact, found->measure[i].at_any_parameters);
    }
    if (settings->measure) json_close(&w);
    json_end_results(&w);
    return cli_close(stdout, "standard output");
}

/* ---- of a run ------------------------------------------------------------------------------ */

int invariants_observe(run_simulation *simulation)
{
    enum { MAX_OBSERVED = 100 /* characters of a formula, as of dal_model_observe */ };
    run_request *request = &simulation->request;
    const dal_run_spec spec = simulation_spec(simulation);
    dal_invariants *found = NULL;
    dal_error error = {0};
    const dal_status status = dal_find_invariants(&found, simulation->model, &spec, NULL, &error);
    if (!cli_is_ok(status)) return cli_error(cli_input_exit(status), request->system_name, &error);
    char *list = request->observe && request->observe[0] ? cli_strdup(request->observe) : NULL,
         *added = NULL;
    for (const dal_invariant *i = found->invariant; i < found->invariant + found->count; i++) {
        /* As one of --observe, where a name alone is in parentheses. */
        char *formula = cli_format(text_is_name(i->formula) ? "(%s)" : "%s", i->formula);
        if (i->is_new && strlen(formula) <= MAX_OBSERVED && !request_observes(request, formula)) {
            list = text_append_item(list, "; ", formula);
            added = text_append_item(added, "; ", formula);
        }
        free(formula);
    }
    dal_invariants_free(found);
    cli_note("%s %s %s", request->system_name, added ? "conserves" : "has no further invariants",
             added ? added : "of degree 2");
    if (added) simulation->system = NULL; /* it is made again, with these formulas */
    const int given = added ? request_give(request, REQUEST_observe, cli_strdup(list)) : CLI_DONE;
    free(list);
    free(added);
    return given;
}

/* ---- all ----------------------------------------------------------------------------------- */

int invariants_find(invariants_settings *settings)
{
    dal_invariants *found = NULL;
    int status = search(settings, &found);
    if (status != CLI_DONE) return status;
    const bool is_screen = !settings->json && !settings->details && screen_has_reader();
    status = (settings->json ? put_invariants
              : is_screen    ? print_screen
                             : print_block)(settings, found);
    if (status == CLI_DONE && found->count == 0) status = CLI_CHECK;
    dal_invariants_free(found);
    return status;
}
