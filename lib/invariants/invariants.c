/* invariants.c - invariants and invariant measures of a motion.
 *
 * f is an invariant where f_q v + f_v F + f_t = 0 on D = 0, which is linear in f: of all products
 * of atoms up to a degree, at three times as many random points of D = 0, the null space of the
 * rates (null_space.c) is a basis of the invariants of that form.  Each becomes a formula
 * (forms.c), which must pass by itself (confirm.c).
 *
 * rho dq dv delta(D) is invariant where rho' + rho tr F_v = 0 on D = 0; f = rho^a of coordinates
 * alone obeys f' + a f tr F_v = 0, linear in f again (Darboux polynomials: Goriely, Integrability
 * and Nonintegrability of Dynamical Systems, World Scientific 2001, 2.5).  D needs no correction:
 * it is constant along F on every level. */
#include "core/error.h"
#include "core/pi.h"
#include "core/vectors.h"
#include "expr/traversal.h"
#include "invariants/atoms.h"
#include "invariants/confirm.h"
#include "invariants/forms.h"
#include "invariants/null_space.h"
#include "invariants/region.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MIN_POINTS = 24 };
/* How far from the start points are drawn, in units of the motion; an angle takes any value. */
static const double neighbourhood = 2.0;

dal_invariants_settings dal_invariants_settings_default(void)
{
    return (dal_invariants_settings){.degree = 2};
}

/* ---- where points are ---- */

/* A coordinate on which F and D depend through atoms that are no coordinates is an angle. */
static bool is_angle(const dal__search *s, int symbol)
{
    const dal__equations *e = &s->model->equations;
    bool occurs = false;
    for (int i = 0; i < s->atoms; i++) {
        const dal__record r = dal__inspect(e->graph, s->atom[i].node);
        if (!dal__depends(e->graph, s->atom[i].node, symbol, symbol + 1)) continue;
        if (r.op != DAL__SIN && r.op != DAL__COS) return false;
        occurs = true;
    }
    return occurs;
}

/* ---- formulas of a null space ---- */

/* What is found with one condition. */
typedef struct solutions {
    dal__null_space space;
    dal__row_form *form;       /* [count] */
    dal__candidate *candidate; /* [count] */
    int count;                 /* those that have a formula which holds, first */
} solutions;

static void free_solutions(solutions *s)
{
    for (int i = 0; s->form && i < s->space.count; i++) free(s->form[i].text);
    free(s->form);
    free(s->candidate);
    dal__null_space_free(&s->space);
    *s = (solutions){.count = 0};
}

/* Keeps what holds, the simple ones first. */
static void keep_confirmed(solutions *s)
{
    int kept = 0;
    for (int i = 0; i < s->count; i++) {
        dal__row_form form = s->form[i];
        dal__candidate candidate = s->candidate[i];
        int at = kept;
        candidate.at_any_parameters = candidate.at_any_parameters && form.may_hold_for_any;
        if (!candidate.holds) {
            free(form.text);
            s->form[i].text = NULL;
            continue;
        }
        s->form[i].text = NULL;
        for (; at > 0; at--) {
            const dal__row_form *before = &s->form[at - 1];
            const bool is_alike = form.degree == before->degree;
            if (is_alike ? form.terms >= before->terms : form.degree > before->degree) break;
            s->form[at] = *before;
            s->candidate[at] = s->candidate[at - 1];
        }
        s->form[at] = form;
        s->candidate[at] = candidate;
        kept++;
    }
    s->count = kept;
}

static dal_status solve_condition(const dal__search *search, const dal__condition *condition,
                                  solutions *s, dal_error *error)
{
    dal__samples samples;
    *s = (solutions){.count = 0};
    DAL_TRY(dal__search_sample(search, condition, search->parameter,
                               3 * search->products + MIN_POINTS, &samples));
    const dal_status found = dal__find_null_space(&samples, condition, &s->space);
    dal__samples_free(&samples);
    DAL_TRY(found);
    const size_t n = (size_t)s->space.count + 1;
    s->form = calloc(n, sizeof *s->form);
    s->candidate = calloc(n, sizeof *s->candidate);
    if (!s->form || !s->candidate) return DAL_STATUS_MEMORY;
    for (int i = 0; i < s->space.count; i++) {
        const double *row = s->space.coefficient + (size_t)i * (size_t)search->products;
        dal__row_form *form = &s->form[s->count];
        DAL_TRY(dal__write_form(search, condition, row, form));
        if (!form->text) continue;
        DAL_TRY(
            dal__search_parse(search->model, form->text, 1, &s->candidate[s->count++].node, error));
    }
    DAL_TRY(dal__confirm(search, condition, s->candidate, s->count));
    keep_confirmed(s);
    return DAL_STATUS_OK;
}

/* ---- results ---- */

/* The results own all texts and lists. */
static dal_status put_invariants(dal_invariants *out, const dal__search *search, solutions *s,
                                 const dal_invariants_settings *settings)
{
    const size_t n = (size_t)s->count + 1;
    dal_invariant *invariant = calloc(n, sizeof *invariant);
    char **atom = calloc((size_t)search->atoms + 1, sizeof *atom);
    out->invariant = invariant;
    out->atom = (const char *const *)atom;
    if (!invariant || !atom) return DAL_STATUS_MEMORY;
    out->degree = search->degree;
    out->products = search->products - 1;
    out->functions = s->space.functions;
    out->least_change = s->space.least_change;
    out->largest_zero = s->space.largest_zero;
    for (int i = 0; i < search->atoms; i++) {
        const size_t size = strlen(search->atom[i].text) + 1;
        if (!(atom[i] = malloc(size))) return DAL_STATUS_MEMORY;
        memcpy(atom[i], search->atom[i].text, size);
        out->atoms++;
    }
    for (int i = 0; i < s->count; i++) {
        const dal__candidate *k = &s->candidate[i];
        invariant[i] = (dal_invariant){
            .formula = s->form[i].text,
            .terms = s->form[i].terms,
            .independent = k->independent,
            .is_new = k->is_new,
            .exact = k->exact,
            .at_any_parameters = k->at_any_parameters,
            .constraint = -1,
            .value = dal__evaluate(search->model->equations.graph, k->node, search->region.centre)};
        s->form[i].text = NULL;
        out->independent += k->independent;
        out->count++;
        if (settings->of_coordinates)
            DAL_TRY(dal__find_constraint(search, k->node, &invariant[i].constraint));
    }
    return DAL_STATUS_OK;
}

static dal_status put_measure(dal_invariants *out, double power, solutions *s)
{
    for (int i = 0; i < s->count; i++) {
        const dal__candidate *k = &s->candidate[i];
        if (!k->has_one_sign) continue;
        const size_t size = strlen(s->form[i].text) + 4; /* -( ) */
        char *text = malloc(size);
        out->measure = calloc(1, sizeof *out->measure);
        if (!text || !out->measure) {
            free(text);
            return DAL_STATUS_MEMORY;
        }
        snprintf(text, size, k->is_negative ? "-(%s)" : "%s", s->form[i].text);
        *out->measure = (dal_invariant_measure){text, power, k->exact, k->at_any_parameters};
        out->measures = 1;
        return DAL_STATUS_OK;
    }
    return DAL_STATUS_OK;
}

void dal_invariants_free(dal_invariants *found)
{
    if (!found) return;
    for (int i = 0; i < found->count; i++) free((char *)found->invariant[i].formula);
    for (int i = 0; i < found->atoms; i++) free((char *)found->atom[i]);
    if (found->measures > 0) free((char *)found->measure->formula);
    free(found->invariant);
    free((char **)found->atom);
    free(found->measure);
    free(found);
}

/* ---- the search ---- */

static dal_status find_measure(dal_invariants *out, const dal__search *search,
                               const dal_invariants_settings *settings, dal_error *error)
{
    const dal__equations *e = &search->model->equations;
    static const double powers[] = {1.0, -1.0, 2.0, -2.0, 0.5, 4.0};
    dal__search of_q = {.model = search->model,
                        .region = search->region,
                        .parameter = search->parameter,
                        .degree = search->degree};
    DAL_TRY(dal__search_atoms(&of_q, settings, error));
    dal__search_remove(&of_q, e->v, e->symbols);
    dal__search_remove(&of_q, e->t, e->t + 1);
    DAL_TRY(dal__search_products(&of_q, error));
    for (size_t k = 0; k < sizeof powers / sizeof *powers && out->measures == 0; k++) {
        const dal__condition condition = {.power = powers[k], .has_constants = true};
        solutions s;
        dal_status status = solve_condition(&of_q, &condition, &s, error);
        if (status == DAL_STATUS_OK) status = put_measure(out, powers[k], &s);
        free_solutions(&s);
        DAL_TRY(status);
    }
    return DAL_STATUS_OK;
}

static dal_status search_all(dal_invariants *out, dal__search *search, const dal_run_spec *spec,
                             const dal_invariants_settings *settings, dal_error *error)
{
    const dal__equations *e = &search->model->equations;
    double *numbers = dal__numbers(1, 2 * (size_t)e->symbols + (size_t)e->parameters);
    if (!numbers) return dal__memory_error(error);
    double *centre = numbers, *reach = centre + e->symbols;
    search->region = (dal__region){centre, reach};
    search->parameter = centre; /* the symbols of parameters are the first */
    dal_status status = dal__search_atoms(search, settings, error);
    if (settings->of_coordinates) dal__search_remove(search, e->v, e->symbols);
    if (status == DAL_STATUS_OK) status = dal__search_products(search, error);
    if (status == DAL_STATUS_OK)
        status = dal__region_find(e, spec, neighbourhood, centre, reach, error);
    if (status == DAL_STATUS_OK) {
        for (int i = 0; i < e->n; i++)
            if (is_angle(search, e->q + i)) reach[e->q + i] = DAL__PI;
        const dal__condition condition = {.power = 0.0};
        solutions s;
        status = solve_condition(search, &condition, &s, error);
        if (status == DAL_STATUS_OK) status = dal__find_independent(search, s.candidate, s.count);
        if (status == DAL_STATUS_OK) status = put_invariants(out, search, &s, settings);
        free_solutions(&s);
        if (status == DAL_STATUS_OK && settings->measures)
            status = find_measure(out, search, settings, error);
        if (status == DAL_STATUS_NOT_FINITE)
            dal__fail(error, status, "there are no points of D = 0 near the start with a finite F");
        if (status == DAL_STATUS_MEMORY || status == DAL_STATUS_TOO_LARGE)
            dal__size_error(status, error);
    }
    free(numbers);
    return status;
}

dal_status dal_find_invariants(dal_invariants **found, dal_model *model, const dal_run_spec *spec,
                               const dal_invariants_settings *settings, dal_error *error)
{
    DAL_REQUIRE(found, error);
    *found = NULL;
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(spec, error);
    const dal_invariants_settings set = settings ? *settings : dal_invariants_settings_default();
    DAL_REQUIRE_COUNT(set.with_count, error);
    DAL_REQUIRE(set.with || set.with_count == 0, error);
    if (set.degree < 1 || set.degree > DAL__MAX_DEGREE)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "degree: %d is not in 1..%d", set.degree,
                         (int)DAL__MAX_DEGREE);
    const dal_system *system;
    DAL_TRY(dal_model_system(model, &system, error));
    if (spec->system != system)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the system of the run is not the model's");
    if (set.measures && model->equations.multipliers)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "'%.80s' has multipliers: no measure is sought", model->name);
    dal_invariants *out = calloc(1, sizeof *out);
    if (!out) return dal__memory_error(error);
    dal__search search = {.model = model, .degree = set.degree};
    model->out_of_memory = false;
    const dal_status status =
        dal__model_conclude(model, search_all(out, &search, spec, &set, error), error);
    if (status == DAL_STATUS_OK)
        *found = out;
    else
        dal_invariants_free(out);
    return status;
}
