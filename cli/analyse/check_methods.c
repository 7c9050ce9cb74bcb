/* check_methods.c - which integrators `run` accepts for a system, and what they preserve of it. */
#include "check_methods.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whether `run` accepts a method: the run is created. */
static bool is_accepted(check *c, const char *method, dal_error *error)
{
    run_request *request = &c->simulation->request;
    dal_run_spec spec;
    dal_run *run = NULL;
    request->options = dal_options_default();
    request->options.step = 0.01;
    if (dal_method_parse(&request->method, method, error) != DAL_STATUS_OK) return false;
    if (simulation_make_spec(c->simulation, &spec) != CLI_DONE) return false;
    const bool accepted = cli_is_ok(dal_run_create(&run, &spec, error));
    dal_run_free(run);
    return accepted;
}

/* A modifier is accepted when it is so around some method. */
static bool is_integrator_accepted(check *c, const dal_integrator *integrator, dal_error *error)
{
    const dal_integrator *base;
    if (!(integrator->properties & DAL_MODIFIER)) return is_accepted(c, integrator->name, error);
    for (int i = 0; (base = dal_integrator_at(i)); i++) {
        char name[128];
        if (base->properties & DAL_MODIFIER) continue;
        snprintf(name, sizeof name, "%.60s+%.60s", base->name, integrator->name);
        if (is_accepted(c, name, error)) return true;
    }
    return false;
}

static char *add_preserving(check *c, const dal_integrator *k)
{
    const size_t count = (size_t)c->preservers + 1;
    c->preserving = cli_realloc(c->preserving, count * sizeof *c->preserving);
    char *name = cli_format("%s%s", k->properties & DAL_MODIFIER ? "+" : "", k->name);
    return c->preserving[c->preservers++] = name;
}

void check_preserving(check *c, bool is_constant, unsigned properties)
{
    static const char what[] = "D is preserved by";
    char text[4096] = "";
    size_t length = 0;
    dal_error error = {.message = ""};
    const dal_integrator *k;
    c->preserving_D = properties;
    c->is_D_constant = is_constant;
    if (!is_constant) c->preservers = 0;
    for (int i = 0; !is_constant && (k = dal_integrator_at(i)); i++) {
        if (!(k->properties & properties) || !is_integrator_accepted(c, k, &error)) continue;
        char *name = add_preserving(c, k);
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%.40s",
                                   length > 0 ? " " : "", name);
    }
    const bool is_any = length > 0 || is_accepted(c, "rk4", &error);
    if (is_constant && is_any)
        check_item(c, CHECK_INFO, what, "every method that applies");
    else
        check_item(c, CHECK_INFO, what, "%s%s%s", length > 0 ? text : "no method",
                   is_any ? "" : ": ", is_any ? "" : error.message);
}

/* ---- every integrator ---- */

/* What an integrator that is accepted preserves, by its properties and the system's. */
static unsigned what_is_preserved(const check *c, const dal_integrator *k,
                                  const dal_constraint_class *d)
{
    const unsigned p = k->properties, system = c->system->properties;
    const bool is_energy = system & (DAL_E_EXACT | DAL_E_ON_D) && p & DAL_PRESERVES_ENERGY;
    /* With D = 0 at midpoints h_a v.A_a vanishes there for D homogeneous in v alone. */
    const bool does_work = c->m > 0 && !d->homogeneous && p & DAL_PRESERVES_D_MIDPOINT;
    const bool is_reversal = p & DAL_SYMMETRIC && !(p & DAL_PERSISTENT_MULTIPLIER);
    const bool has_lift = c->system->call.adjoint && !(k->needs & DAL_NEEDS_BLOCKS);
    const bool is[CHECK_PRESERVED] = {
        [CHECK_PRESERVES_D] = c->m > 0 && (c->is_D_constant || p & c->preserving_D),
        [CHECK_PRESERVES_E] = is_energy && !does_work,
        [CHECK_PRESERVES_FORM] = p & DAL_SYMPLECTIC && has_lift,
        [CHECK_PRESERVES_REVERSAL] = d->reversible && is_reversal,
    };
    unsigned bits = 0;
    for (int i = 0; i < CHECK_PRESERVED; i++) bits |= (unsigned)is[i] << i;
    return bits;
}

static void examine_methods(check *c)
{
    dal_constraint_class d;
    const dal_integrator *k;
    if (!cli_is_ok(dal_evaluator_classify_constraints(c->evaluator, &c->origin, &d, NULL)))
        d = (dal_constraint_class){.linear = false};
    while ((k = dal_integrator_at(c->methods))) {
        dal_error error = {.message = ""};
        const bool is_accepted_here = is_integrator_accepted(c, k, &error);
        const char *reason = strstr(error.message, ": ");
        c->method = cli_realloc(c->method, (size_t)(c->methods + 1) * sizeof *c->method);
        c->method[c->methods++] = (check_method){
            .name = cli_format("%s%s", k->properties & DAL_MODIFIER ? "+" : "", k->name),
            .reason = is_accepted_here ? NULL : cli_strdup(reason ? reason + 2 : error.message),
            .preserved = is_accepted_here ? what_is_preserved(c, k, &d) : 0};
    }
}

/* The names of the methods with a reason (NULL: accepted) that preserve something (0: any). */
static void list_methods(check *c, const char *what, const char *reason, unsigned preserved)
{
    char text[4096] = "";
    size_t length = 0;
    for (const check_method *k = c->method; k < c->method + c->methods; k++) {
        const bool is_same =
            reason && k->reason ? strcmp(reason, k->reason) == 0 : reason == k->reason;
        if (!is_same || (k->preserved & preserved) != preserved) continue;
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%.40s",
                                   length > 0 ? " " : "", k->name);
    }
    check_item(c, CHECK_INFO, what, "%s%s%s", length > 0 ? text : "no method", reason ? ": " : "",
               reason ? reason : "");
}

void check_methods(check *c)
{
    examine_methods(c);
    list_methods(c, "accepted", NULL, 0);
    for (int i = 0; i < c->methods; i++) {
        const char *reason = c->method[i].reason;
        int first = 0;
        while (reason && (!c->method[first].reason || strcmp(c->method[first].reason, reason) != 0))
            first++;
        if (reason && first == i) list_methods(c, "refused", reason, 0);
    }
    list_methods(c, "E is preserved by", NULL, 1u << CHECK_PRESERVES_E);
    list_methods(c, "the lift's form is preserved by", NULL, 1u << CHECK_PRESERVES_FORM);
    list_methods(c, "reversal is preserved by", NULL, 1u << CHECK_PRESERVES_REVERSAL);
}
