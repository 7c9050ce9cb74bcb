/* check_start.c - the start, the constraints and the reversal of a system. */
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The library's own limit for a start. */
static const double consistent = 1e-10;
/* A value by differences counts as zero below this. */
static const double zero = 1e-9;

/* ---- the start ---- */

/* max |D| relative to sum |A| |v|; NaN where D, or what it is relative to, is not finite. */
static double start_defect(check *c)
{
    const dal_system *s = c->system;
    double *block = c->values, size = 1.0, defect = 0.0;
    if (dal_probe_call(c->probe, s->call.constraint, 0.0, c->start, c->start + c->n, NULL, block))
        return NAN;
    for (int a = 0; a < c->m; a++) {
        double sum = 0.0;
        for (int i = 0; i < c->n; i++) sum += fabs(block[c->m + a * c->n + i] * c->start[c->n + i]);
        if (!isfinite(sum) || !isfinite(block[a])) return NAN;
        size = fmax(size, sum);
        defect = fmax(defect, fabs(block[a]));
    }
    return defect / size;
}

static void start_constraints(check *c)
{
    if (c->system->call.constraint == NULL) return;
    const double defect = start_defect(c);
    if (isnan(defect))
        check_unmeasured(c, "|D| at the start", "D or its derivative is not finite");
    else
        check_bound(c, "|D| at the start", defect, consistent);
}

static void start_rank(check *c)
{
    int rank = 0;
    double pivot = 0.0;
    dal_status status = dal_measure_rank(c->probe, &c->origin, &rank, &pivot);
    if (status == DAL_UNSUPPORTED) return;
    if (!cli_is_ok(status))
        check_item(c, CHECK_FAIL, "rank of G at the start", "not to be had: %s",
                   dal_status_text(status));
    else
        check_item(c, rank == c->m ? CHECK_OK : CHECK_FAIL, "rank of G at the start",
                   "%d of %d, least pivot %.2g", rank, c->m, pivot);
}

void check_start(check *c)
{
    const double e = c->start[c->size];
    check_item(c, c->regular ? CHECK_OK : CHECK_FAIL, "F at the start", "%s",
               c->regular ? "finite" : "not finite: the motion is not determined");
    check_item(c, e != 0.0 && !isnan(e) ? CHECK_OK : CHECK_FAIL, "gauge variable e", "%g", e);
    if (c->m > 0) start_constraints(c);
    if (c->m > 0) start_rank(c);
    const int found = c->near_count > 0 ? CHECK_OK : CHECK_FAIL;
    if (c->m > 0)
        check_item(c, found, "points about the start", "%d, of which %d could be moved onto D = 0",
                   c->near_count, c->surface_count);
    else
        check_item(c, found, "points about the start", "%d", c->near_count);
}

/* ---- what D is ---- */

typedef struct claim {
    unsigned flag;
    const char *what;
    int found;
} claim;

/* A claim that numbers contradict is a fault; one that is not made says nothing. */
static void compare_claim(check *c, const claim *k)
{
    int claimed = (c->system->properties & k->flag) != 0;
    check_result result = claimed ? (k->found ? CHECK_OK : CHECK_FAIL) : CHECK_INFO;
    check_item(c, result, k->what, "%s%s", k->found ? "yes" : "no",
               claimed == k->found ? ""
               : claimed           ? ", though the system claims it"
                                   : ", though its form does not show it");
}

static void say_degree(check *c, const dal_degree *d, const double *degree)
{
    char text[64] = "not homogeneous";
    int written = 0;
    for (int a = 0; d->homogeneous && a < c->m && written < 48; a++)
        written += snprintf(text + written, sizeof text - (size_t)written, "%sD%d: %.4g",
                            a > 0 ? ", " : "homogeneous of degree ", a + 1, degree[a] + 0.0);
    check_item(c, CHECK_INFO, "degree of D in v", "%s%s", text, d->linear ? "; affine" : "");
}

/* Whether `run` accepts a method: it is asked to make the run. */
static int accepts(check *c, const char *method, dal_error *error)
{
    cli_job *job = c->job;
    dal_run_spec spec;
    dal_run *run = NULL;
    job->options = dal_options_default();
    job->options.step = 0.01;
    if (dal_method_parse(&job->method, method, error) != DAL_OK) return 0;
    if (job_spec(job, &spec) != CLI_DONE) return 0;
    const int accepted = cli_is_ok(dal_run_create(&run, &spec, error));
    dal_run_free(run);
    return accepted;
}

/* A modifier is accepted when it is around some method. */
static int accepts_integrator(check *c, const dal_integrator *integrator)
{
    dal_error error;
    if (!(integrator->claims & DAL_MODIFIER)) return accepts(c, integrator->name, &error);
    for (int i = 0; dal_integrator_at(i) != NULL; i++) {
        char name[128];
        if (dal_integrator_at(i)->claims & DAL_MODIFIER) continue;
        snprintf(name, sizeof name, "%.60s+%.60s", dal_integrator_at(i)->name, integrator->name);
        if (accepts(c, name, &error)) return 1;
    }
    return 0;
}

enum { LINE = 72 };

/* The names of the methods that claim any of these and that `run` accepts, on lines of their own.
 */
static void list_keepers(check *c, unsigned claims)
{
    char text[LINE + 1] = "";
    const char *head = "D is kept by";
    dal_error error = {.message = ""};
    for (int i = 0; dal_integrator_at(i) != NULL; i++) {
        const dal_integrator *integrator = dal_integrator_at(i);
        size_t used = strlen(text);
        if ((integrator->claims & claims) == 0) continue;
        if (!accepts_integrator(c, integrator)) continue;
        if (used + strlen(integrator->name) + 3 > LINE - 20) {
            if (head != NULL) check_item(c, CHECK_INFO, head, "%s", text);
            if (head == NULL) check_note("%s", text);
            head = NULL;
            used = 0;
        }
        snprintf(text + used, sizeof text - used, "%s%s%.40s", used > 0 ? " " : "",
                 integrator->claims & DAL_MODIFIER ? "+" : "", integrator->name);
    }
    if (head != NULL && text[0] == '\0')
        check_item(c, CHECK_INFO, head, "no method%s%s", accepts(c, "rk4", &error) ? "" : ": ",
                   error.message);
    else if (head != NULL)
        check_item(c, CHECK_INFO, head, "%s", text);
    else
        check_note("%s", text);
}

/* D with constant coefficients: every method that acts on the system. */
static void list_every_keeper(check *c)
{
    dal_error error = {0};
    if (accepts(c, "rk4", &error))
        check_item(c, CHECK_INFO, "D is kept by", "every method that acts on the system");
    else
        check_item(c, CHECK_INFO, "D is kept by", "no method: %s", error.message);
}

static void say_kind(check *c, const dal_degree *d)
{
    const claim claims[] = {
        {DAL_D_LINEAR, "D affine in v", d->linear},
        {DAL_D_CONSTANT, "D linear, constant coefficients", d->constant},
        {DAL_D_BILINEAR, "D bilinear in (q,v)", d->bilinear},
        {DAL_D_QUADRATIC, "D quadratic in (q,v)", d->quadratic},
    };
    for (size_t k = 0; k < sizeof claims / sizeof claims[0]; k++) compare_claim(c, &claims[k]);
    unsigned keep = DAL_KEEPS_D;
    if (d->bilinear) keep |= DAL_KEEPS_BILINEAR;
    if (d->quadratic) keep |= DAL_KEEPS_QUADRATIC;
    if (d->constant)
        list_every_keeper(c);
    else
        list_keepers(c, keep);
}

void check_constraints(check *c)
{
    dal_degree d;
    dal_callback *D = c->system->constraints;
    if (c->m == 0) return;
    const check_rate on = check_measure_rate(c, D, c->m, -1, c->surface, c->surface_count);
    const check_rate off = check_measure_rate(c, D, c->m, -1, c->near, c->near_count);
    check_rate_bound(c, "dD/dt along F, on D = 0", &on, zero);
    check_rate_bound(c, "dD/dt along F, off D = 0", &off, zero);
    double *degree = cli_calloc((size_t)c->m + 1, sizeof *degree);
    const dal_status status = dal_measure_degree(c->probe, &c->origin, &d, degree);
    if (cli_is_ok(status)) {
        say_degree(c, &d, degree);
        say_kind(c, &d);
    } else {
        check_unmeasured(c, "what D is", "%s", dal_status_text(status));
    }
    free(degree);
}

/* ---- reversal ---- */

void check_reversal(check *c)
{
    static const char *const parity[] = {"D(q,-v) = -D(q,v)", "neither even nor odd in v",
                                         "D(q,-v) = +D(q,v)"};
    static const char what[] = "F(q,-v,-t) = F(q,v,t)";
    dal_degree d;
    const dal_status status = dal_measure_degree(c->probe, &c->origin, &d, NULL);
    if (!cli_is_ok(status) || isnan(d.force_defect)) {
        check_unmeasured(c, what, "%s",
                         dal_status_text(cli_is_ok(status) ? DAL_NOT_FINITE : status));
        return;
    }
    check_item(c, CHECK_INFO, what, "%s, greatest difference %.2g",
               d.reversible ? "yes: reversible" : "no: not reversible under v -> -v",
               d.force_defect);
    if (c->m > 0) check_item(c, CHECK_INFO, "D under v -> -v", "%s", parity[d.parity + 1]);
}
