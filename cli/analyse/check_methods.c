/* check_methods.c - which integrators `run` accepts for a system, and what they preserve of it. */
#include "check_methods.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdio.h>

/* Whether `run` accepts a method: the run is created. */
static bool is_accepted(check *c, const char *method, dal_error *error)
{
    run_request *request = c->request;
    dal_run_spec spec;
    dal_run *run = NULL;
    request->options = dal_options_default();
    request->options.step = 0.01;
    if (dal_method_parse(&request->method, method, error) != DAL_OK) return false;
    if (request_make_spec(request, &spec) != CLI_DONE) return false;
    const bool accepted = cli_is_ok(dal_run_create(&run, &spec, error));
    dal_run_free(run);
    return accepted;
}

/* A modifier is accepted when it is so around some method. */
static bool is_integrator_accepted(check *c, const dal_integrator *integrator)
{
    dal_error error;
    const dal_integrator *base;
    if (!(integrator->properties & DAL_MODIFIER)) return is_accepted(c, integrator->name, &error);
    for (int i = 0; (base = dal_integrator_at(i)); i++) {
        char name[128];
        if (base->properties & DAL_MODIFIER) continue;
        snprintf(name, sizeof name, "%.60s+%.60s", base->name, integrator->name);
        if (is_accepted(c, name, &error)) return true;
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
    if (!is_constant) c->preservers = 0;
    for (int i = 0; !is_constant && (k = dal_integrator_at(i)); i++) {
        if (!(k->properties & properties) || !is_integrator_accepted(c, k)) continue;
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
