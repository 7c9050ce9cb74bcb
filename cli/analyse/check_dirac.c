/* check_dirac.c - what Dirac's procedure finds for the lift of a system. */
#include "check_dirac.h"
#include "dalembert_dirac.h"
#include "run/simulation.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <string.h>

void check_dirac(check *c)
{
    dal_dirac *d = NULL;
    dal_error error = {0};
    const int n = c->n;
    const double e = c->start[c->size];
    if (e == 0.0 || isinf(e) || c->system->multipliers > 0) return;
    const dal_run_spec spec = simulation_spec(c->simulation);
    const dal_status status = dal_dirac_create(&d, c->simulation->model, &spec, &error);
    if (!cli_is_ok(status) || !d->is_complete) {
        const bool stops = cli_is_ok(status);
        check_item(c, stops ? CHECK_INFO : CHECK_UNMEASURED, "brackets", "%s",
                   stops ? "the procedure stops, see 'dalembert dirac'" : error.message);
        dal_dirac_free(d);
        return;
    }
    /* What it finds; for a regular K that is known in advance. */
    const dal_effort effort = c->simulation->request.choices.effort;
    const bool is_regular = effort == DAL_EFFORT_IDENTITY || effort == DAL_EFFORT_MASS;
    const int first = 2 * n + 1;
    check_number(c, d->second_class == 2 * n ? CHECK_OK : CHECK_FAIL, "second-class constraints",
                 d->second_class, 2 * n, 2 * n, "rank %d of %d x %d brackets, 2n = %d",
                 d->second_class, d->constraints, d->constraints, 2 * n);
    if (is_regular)
        check_number(c, d->first_class == first ? CHECK_OK : CHECK_FAIL, "first-class constraints",
                     d->first_class, first, first, "%d, 2n+1 = %d", d->first_class, first);
    else
        check_item(c, CHECK_INFO, "first-class constraints", "%d", d->first_class);
    check_number(c, d->free_multipliers == 1 ? CHECK_OK : CHECK_FAIL, "free multipliers",
                 d->free_multipliers, 1, 1, "%d (mu_e, the gauge)", d->free_multipliers);
    if (is_regular) {
        int others = !d->multiplier[0].is_free; /* (nh15)-(nh17): mu_e is */
        for (int b = 1; b < d->primaries; b++) {
            const char *value = d->multiplier[b].value.text;
            const char *name = b > n ? c->system->coordinate[b - n - 1] : "0";
            const size_t length = strlen(name);
            others += strncmp(value, name, length) != 0 ||
                      strcmp(value + length, b > n ? "'" : "") != 0 || d->multiplier[b].is_free;
        }
        check_number(c, others == 0 ? CHECK_OK : CHECK_FAIL, "mu_q = v, mu_lambda = 0", others, 0,
                     0, "%d of %d are others", others, d->primaries);
    }
    const bool vanishes = strcmp(d->on_surface.text, "0") == 0;
    check_item(c,
               vanishes     ? CHECK_OK
               : is_regular ? CHECK_FAIL
                            : CHECK_INFO,
               "H on the surface", "%.100s", d->on_surface.text);
    dal_dirac_free(d);
}
