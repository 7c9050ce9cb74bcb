/* check_invariants.c - what the motion conserves that the system file does not say. */
#include "check_invariants.h"
#include "dalembert_invariants.h"
#include "invariants.h"
#include "ui/memory.h"

#include <stdio.h>

/* With more coordinates only sums of the factors themselves are tried, so that it takes no time. */
enum { MAX_COORDINATES = 7 };

void check_further_invariants(check *c)
{
    static const char what[] = "further invariants";
    const run_simulation *s = c->simulation;
    const dal_run_spec spec = invariants_spec(s);
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
