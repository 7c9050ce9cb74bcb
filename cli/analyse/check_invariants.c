/* check_invariants.c - what the motion conserves that the system file does not say. */
#include "check_invariants.h"
#include "dalembert_invariants.h"
#include "invariants.h"
#include "ui/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* With more coordinates only sums of the factors themselves are tried, so that it takes no time. */
enum { MAX_COORDINATES = 7 };

void check_further_invariants(check *c)
{
    static const char what[] = "further invariants";
    const run_simulation *s = c->simulation;
    const dal_run_spec spec = simulation_spec(s);
    dal_invariants_settings settings = dal_invariants_settings_default();
    dal_invariants *found = NULL;
    dal_error error = {.message = ""};
    int count = 0, number = 0;
    char name[INVARIANTS_NAME], item[64];
    if (c->n > MAX_COORDINATES) settings.degree = 1;
    if (!c->is_regular) return;
    const dal_status status = dal_find_invariants(&found, s->model, &spec, &settings, &error);
    if (!cli_is_ok(status)) {
        check_item(c, CHECK_INFO, what, "not sought: %s", error.message);
        return;
    }
    for (int i = 0; i < found->count; i++) count += found->invariant[i].is_new;
    if (count == 0)
        check_item(c, CHECK_INFO, what, "none of degree %d", settings.degree);
    else
        check_item(c, CHECK_INFO, what, "%d of degree %d; see 'dalembert invariants'", count,
                   settings.degree);
    for (int i = 0; i < found->count; i++) {
        if (!found->invariant[i].is_new) continue;
        invariants_next_name(s->system, &number, name);
        snprintf(item, sizeof item, CHECK_PROPOSED_INVARIANT "%s", name);
        check_item(c, CHECK_INFO, item, "%s%s", found->invariant[i].formula,
                   found->invariant[i].at_any_parameters ? "" : "  (with these parameters)");
    }
    dal_invariants_free(found);
}

/* ---- integrable constraints ---- */

/* Sums of products of up to MAX_DEGREE factors are tried; then, last, quotients as y/x, of two. */
enum { MAX_DEGREE = 4, QUOTIENTS = MAX_DEGREE + 1, MAX_TRIED = 24 };

/* The functions of coordinates and t of a trial, from 1, that D = 0 conserves; NULL: none are
 * known. */
static dal_invariants *find_integrals(const check *c, int trial)
{
    const dal_run_spec spec = simulation_spec(c->simulation);
    const int with_count = trial == QUOTIENTS ? c->n : 0;
    char **with = cli_calloc((size_t)with_count + 1, sizeof *with);
    for (int i = 0; i < with_count; i++) with[i] = cli_format("1/%s", c->system->coordinate[i]);
    const dal_invariants_settings settings = {.degree = trial == QUOTIENTS ? 2 : trial,
                                              .with = (const char *const *)with,
                                              .with_count = with_count,
                                              .of_coordinates = true};
    dal_invariants *found = NULL;
    dal_find_invariants(&found, c->simulation->model, &spec, &settings, NULL);
    for (int i = 0; i < with_count; i++) free(with[i]);
    free(with);
    return found;
}

static const dal_invariant *integral_of(const dal_invariants *found, int constraint)
{
    for (int i = 0; found && i < found->count; i++)
        if (found->invariant[i].constraint == constraint) return &found->invariant[i];
    return NULL;
}

static void propose_holonomic(check *c, int a, const dal_invariant *integral)
{
    char item[48], value[32];
    int digits = 1; /* as few as give the value again */
    snprintf(item, sizeof item, CHECK_INTEGRABLE "%d", a + 1);
    if (!integral) {
        check_item(c, CHECK_INFO, item,
                   "integrable, the derivative of a g(q, t) up to a factor: 'holonomic: [g]' in "
                   "its place keeps g = 0, too");
        return;
    }
    const double size = fabs(integral->value);
    do snprintf(value, sizeof value, " %c %.*g", integral->value < 0.0 ? '+' : '-', digits, size);
    while (strtod(value + 3, NULL) != size && ++digits <= 17);
    check_item(c, CHECK_INFO, item, "integrable: 'holonomic: [%s%s]' in its place keeps this 0",
               integral->formula, size == 0.0 ? "" : value);
}

void check_integrable_constraints(check *c)
{
    const request_settings *set = &c->simulation->request.set;
    const double *units = dal_scaled_units(c->scaled);
    const int rows = c->m - c->system->holonomic;
    const dal_growth *g = &c->growth;
    int last = 0; /* the trial that is in found */
    dal_invariants *found = NULL;
    const bool is_other = c->nw > c->n || c->system->properties & DAL_SERVO;
    if (is_other || (g->is_complete && g->dimension - g->rank[g->levels - 1] <= c->m - rows))
        return;
    for (int a = 0; a < rows && a < MAX_TRIED; a++) {
        dal_growth alone;
        const dal_status status = dal_model_growth_of(c->simulation->model, a, set->item,
                                                      set->count, units, &alone, NULL);
        if (!cli_is_ok(status) || !alone.is_complete || alone.levels > 1) continue;
        for (int trial = 1; trial <= QUOTIENTS && c->is_regular; trial++) {
            if (trial != last) {
                dal_invariants_free(found);
                found = find_integrals(c, trial);
                last = trial;
            }
            if (integral_of(found, a)) break;
        }
        propose_holonomic(c, a, integral_of(found, a));
    }
    dal_invariants_free(found);
}
