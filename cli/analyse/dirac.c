/* dirac.c - Dirac's procedure for the action of a system, printed. */
#include "dirac.h"
#include "dalembert_dirac.h"
#include "io/json.h"
#include "io/text.h"
#include "run/request.h"
#include "run/request_json.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- text ---------------------------------------------------------------------------------- */

/* Where lines go: to a screen, which wraps them and shortens formulas, or as they are. */
typedef struct printer {
    screen screen;
    bool is_screen;
} printer;

static void say(printer *p, const char *format, ...) CLI_PRINTF(2, 3);
static void say(printer *p, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *line = cli_format_list(format, arguments);
    va_end(arguments);
    if (p->is_screen)
        screen_say(&p->screen, 4, "%s", line);
    else
        puts(line);
    free(line);
}

static void skip(printer *p)
{
    if (p->is_screen)
        screen_skip(&p->screen);
    else
        putchar('\n');
}

/* A formula, shortened on a screen; allocated. */
static char *formula_of(const printer *p, const dal_formula *f)
{
    enum { MAX_LENGTH = 200 };
    if (!p->is_screen || strlen(f->text) <= MAX_LENGTH) return cli_strdup(f->text);
    return cli_format("%.*s...", MAX_LENGTH, f->text);
}

static void say_step(printer *p, const dal_dirac *d, const dal_dirac_step *s)
{
    char *condition = formula_of(p, &s->condition), *added = NULL;
    for (int i = s->first; i < s->first + s->count; i++) {
        char *formula = formula_of(p, &d->constraint[i].phi);
        added = text_append_item(added, ", ", formula);
        free(formula);
    }
    char *name = formula_of(p, &d->constraint[s->constraint].phi);
    switch (s->outcome) {
    case DAL_DIRAC_HOLDS:
        say(p, "  %s = 0: is conserved", name);
        break;
    case DAL_DIRAC_FIXES:
        say(p, "  %s = 0: fixes %s = %s", name, d->multiplier[s->multiplier].name.text, condition);
        break;
    case DAL_DIRAC_ADDS:
        say(p, "  %s = 0: requires %s = 0", name, added);
        break;
    case DAL_DIRAC_IRREGULAR:
        say(p, "  %s = 0: requires %s = 0, irregular; replaced by %s = 0", name, condition, added);
        break;
    case DAL_DIRAC_CONTRADICTS:
        say(p, "  %s = 0: requires %s = 0, a contradiction", name, condition);
        break;
    default:
        say(p, "  %s = 0: requires %s = 0, which has no regular points near the start", name,
            condition);
    }
    free(name);
    free(condition);
    free(added);
}

typedef enum constraint_kind { FIRST_CLASS, SECOND_CLASS } constraint_kind;

static void say_class(printer *p, const dal_dirac *d, constraint_kind kind, int count)
{
    char *list = NULL;
    for (int a = 0; a < d->constraints; a++) {
        if (d->constraint[a].first_class != (kind == FIRST_CLASS)) continue;
        char *formula = formula_of(p, &d->constraint[a].form);
        list = text_append_item(list, ", ", formula);
        free(formula);
    }
    say(p, "%s class, %d: %s", kind == FIRST_CLASS ? "First" : "Second", count,
        list ? list : "none");
    free(list);
}

static void say_results(printer *p, const dal_dirac *d)
{
    char *fixed = NULL, *is_free = NULL;
    say_class(p, d, FIRST_CLASS, d->first_class);
    say_class(p, d, SECOND_CLASS, d->second_class);
    for (int b = 0; b < d->primaries; b++) {
        const dal_dirac_multiplier *mu = &d->multiplier[b];
        if (mu->is_free) {
            is_free = text_append_item(is_free, ", ", mu->name.text);
            continue;
        }
        char *value = formula_of(p, &mu->value);
        char *item = cli_format("%s = %s", mu->name.text, value);
        fixed = text_append_item(fixed, ", ", item);
        free(item);
        free(value);
    }
    say(p, "Multipliers fixed: %s", fixed ? fixed : "none");
    say(p, "Multipliers free, %d: %s", d->free_multipliers, is_free ? is_free : "none");
    free(fixed);
    free(is_free);
    char *H = formula_of(p, &d->on_surface);
    say(p, "H on the surface: %s", H);
    free(H);
    for (const dal_dirac_generator *g = d->generator; g < d->generator + d->generators; g++) {
        const char *mu = d->multiplier[g->multiplier].name.text;
        char *G = formula_of(p, &g->generator);
        say(p, "Gauge generator G = %s: delta %s = %s", G, mu, g->of_multiplier.text);
        for (int i = 0; i < g->changes; i++) {
            char *change = formula_of(p, &g->change[i]);
            say(p, "  delta %s = %s", g->changed[i].text, change);
            free(change);
        }
        free(G);
    }
    if (d->dimension >= 0)
        say(p, "Motion: %d dimensions, %d of phase space less %d constraints and %d of gauge",
            d->dimension, 2 * d->pairs, d->constraints,
            2 * d->pairs - d->constraints - d->dimension);
    skip(p);
    say(p, "Dirac brackets of q and v that are not 0");
    for (int i = 0; i < d->brackets; i++) {
        char *value = formula_of(p, &d->bracket[i].value);
        say(p, "  {%s, %s} = %s", d->bracket[i].left.text, d->bracket[i].right.text, value);
        free(value);
    }
    if (d->brackets == 0) say(p, "  none");
}

static int print_text(const dirac_settings *settings, const dal_dirac *d)
{
    const run_simulation *s = &settings->simulation;
    printer p = {.is_screen = !settings->details && screen_has_reader()};
    if (p.is_screen) screen_open(&p.screen, stdout, SCREEN_TEXT);
    say(&p, "%s: Dirac's procedure in %d dimensions, %d stage%s, %d constraints", s->system->name,
        2 * d->pairs, d->stages, d->stages == 1 ? "" : "s", d->constraints);
    char *H = formula_of(&p, &d->hamiltonian);
    say(&p, "H = %s + multipliers * primary constraints", H);
    free(H);
    skip(&p);
    say(&p, "Primary constraints");
    for (int a = 0; a < d->primaries; a++)
        say(&p, "  %s = 0, multiplier %s", d->constraint[a].phi.text, d->multiplier[a].name.text);
    for (int i = 0; i < d->steps; i++) {
        if (i == 0 || d->step[i].stage != d->step[i - 1].stage) {
            skip(&p);
            say(&p, "Stage %d, conservation", d->step[i].stage);
        }
        say_step(&p, d, &d->step[i]);
    }
    skip(&p);
    if (d->is_complete)
        say_results(&p, d);
    else
        say(&p, "The procedure stops here.");
    return p.is_screen ? screen_close(&p.screen, "--details")
                       : cli_close(stdout, "standard output");
}

/* ---- LaTeX --------------------------------------------------------------------------------- */

static int print_latex(const dal_dirac *d)
{
    printf("\\begin{align*}\n  H_{0} &= %s \\\\\n", d->hamiltonian.latex);
    for (int a = 0; a < d->primaries; a++)
        printf("  \\phi_{%d} &= %s \\\\\n", a + 1, d->constraint[a].phi.latex);
    for (const dal_dirac_step *s = d->step; s < d->step + d->steps; s++) {
        const bool fixes = s->outcome == DAL_DIRAC_FIXES;
        printf("  \\dot{\\phi}_{%d} = 0 &:\\quad %s%s%s", s->constraint + 1,
               fixes ? d->multiplier[s->multiplier].name.latex : s->condition.latex,
               fixes ? " = " : "", fixes ? s->condition.latex : " = 0");
        for (int k = s->first; k < s->first + s->count; k++)
            printf(" \\\\\n  \\phi_{%d} &= %s", k + 1, d->constraint[k].phi.latex);
        puts(" \\\\");
    }
    for (int i = 0; i < d->brackets; i++)
        printf("  \\{%s, %s\\}_{\\mathrm{D}} &= %s \\\\\n", d->bracket[i].left.latex,
               d->bracket[i].right.latex, d->bracket[i].value.latex);
    for (int i = 0; i < d->generators; i++) {
        const dal_dirac_generator *g = &d->generator[i];
        printf("  G &= %s \\\\\n", g->generator.latex);
        for (int k = 0; k < g->changes; k++)
            printf("  \\delta %s &= %s \\\\\n", g->changed[k].latex, g->change[k].latex);
        printf("  \\delta %s &= %s \\\\\n", d->multiplier[g->multiplier].name.latex,
               g->of_multiplier.latex);
    }
    printf("  H|_{\\phi = 0} &= %s\n\\end{align*}\n", d->on_surface.latex);
    return cli_close(stdout, "standard output");
}

/* ---- JSON ---------------------------------------------------------------------------------- */

static void put_gauge(json_writer *w, const dal_dirac *d)
{
    json_open_list(w, "multipliers", JSON_LINES);
    for (int b = 0; b < d->primaries; b++) {
        const dal_dirac_multiplier *mu = &d->multiplier[b];
        json_open(w, NULL, JSON_ON_ONE_LINE);
        json_put_text(w, "name", mu->name.text);
        json_put_bool(w, "free", mu->is_free);
        json_put_text(w, "value", mu->is_free || !d->is_complete ? NULL : mu->value.text);
        json_close(w);
    }
    json_close(w);
    json_open_list(w, "brackets", JSON_LINES);
    for (int i = 0; i < d->brackets; i++) {
        json_open_list(w, NULL, JSON_ON_ONE_LINE);
        json_put_text(w, NULL, d->bracket[i].left.text);
        json_put_text(w, NULL, d->bracket[i].right.text);
        json_put_text(w, NULL, d->bracket[i].value.text);
        json_close(w);
    }
    json_close(w);
    json_open_list(w, "generators", JSON_LINES);
    for (int i = 0; i < d->generators; i++) {
        const dal_dirac_generator *g = &d->generator[i];
        json_open(w, NULL, JSON_ON_ONE_LINE);
        json_put_text(w, "multiplier", d->multiplier[g->multiplier].name.text);
        json_put_text(w, "generator", g->generator.text);
        json_open(w, "changes", JSON_ON_ONE_LINE);
        for (int k = 0; k < g->changes; k++)
            json_put_text(w, g->changed[k].text, g->change[k].text);
        json_put_text(w, d->multiplier[g->multiplier].name.text, g->of_multiplier.text);
        json_close(w);
        json_close(w);
    }
    json_close(w);
}

static int print_json(const dirac_settings *settings, const dal_dirac *d)
{
    const run_simulation *s = &settings->simulation;
    json_writer w = json_begin_results("dirac");
    request_open_json(&w, s, ~UINT64_C(0));
    json_close(&w);
    json_put_text(&w, "effort", dal_effort_name(s->request.choices.effort));
    json_put_bool(&w, "complete", d->is_complete);
    json_put_integer(&w, "phase_space", 2 * d->pairs);
    json_put_integer(&w, "stages", d->stages);
    json_put_integer(&w, "primary", d->primaries);
    json_put_integer(&w, "first_class", d->first_class);
    json_put_integer(&w, "second_class", d->second_class);
    json_put_integer(&w, "free_multipliers", d->free_multipliers);
    json_put_number(&w, "dimension", d->dimension < 0 ? NAN : d->dimension);
    json_put_text(&w, "hamiltonian", d->hamiltonian.text);
    json_put_text(&w, "on_surface", d->is_complete ? d->on_surface.text : NULL);
    json_open_list(&w, "constraints", JSON_LINES);
    for (int a = 0; a < d->constraints; a++) {
        const dal_dirac_constraint *phi = &d->constraint[a];
        json_open(&w, NULL, JSON_ON_ONE_LINE);
        json_put_text(&w, "formula", phi->phi.text);
        json_put_integer(&w, "stage", phi->stage);
        json_put_text(&w, "from", phi->source < 0 ? NULL : d->constraint[phi->source].phi.text);
        json_put_text(&w, "class", !d->is_complete ? NULL : phi->first_class ? "first" : "second");
        json_put_text(&w, "form", phi->form.text);
        json_close(&w);
    }
    json_close(&w);
    json_open_list(&w, "steps", JSON_LINES);
    for (int i = 0; i < d->steps; i++) {
        const dal_dirac_step *step = &d->step[i];
        json_open(&w, NULL, JSON_ON_ONE_LINE);
        json_put_integer(&w, "stage", step->stage);
        json_put_text(&w, "constraint", d->constraint[step->constraint].phi.text);
        json_put_text(&w, "outcome", dal_dirac_outcome_name(step->outcome));
        json_put_text(&w, "condition", step->condition.text);
        json_put_text(&w, "multiplier",
                      step->multiplier < 0 ? NULL : d->multiplier[step->multiplier].name.text);
        json_open_list(&w, "adds", JSON_ON_ONE_LINE);
        for (int k = step->first; k < step->first + step->count; k++)
            json_put_text(&w, NULL, d->constraint[k].phi.text);
        json_close(&w);
        json_close(&w);
    }
    json_close(&w);
    put_gauge(&w, d);
    json_end_results(&w);
    return cli_close(stdout, "standard output");
}

/* ---- all ----------------------------------------------------------------------------------- */

int dirac_analyse(const dirac_settings *settings)
{
    const run_simulation *s = &settings->simulation;
    if (settings->latex && (settings->json || settings->details))
        return cli_fail(CLI_USAGE, "dirac: --latex excludes --json and --details");
    const dal_run_spec spec = simulation_spec(s);
    dal_dirac *d = NULL;
    dal_error error = {0};
    const dal_status found = dal_dirac_create(&d, s->model, &spec, &error);
    if (!cli_is_ok(found)) return cli_error(cli_input_exit(found), s->request.system_name, &error);
    int status = settings->latex  ? print_latex(d)
                 : settings->json ? print_json(settings, d)
                                  : print_text(settings, d);
    if (status == CLI_DONE && !d->is_complete) status = CLI_CHECK;
    dal_dirac_free(d);
    return status;
}
