/* order.c - `dalembert order`: error against step and against work, for many methods at once. */
#include "order.h"
#include "run/pool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* name, value, default, help */
#define OWN_LIST(X)                                                                                \
    X(integrators, "LIST|all", "all", "integrators, with modifiers or not: rk4,gauss4+project")    \
    X(steps, "H1,H2,..", NULL, "step sizes, falling, at most 8; instead of --step and --levels")   \
    X(levels, "K", "4", "so many step sizes, each half the one before it")                         \
    X(threads, "N", NULL, "runs at a time (one per processor); no number depends on it")           \
    X(output, "DIR|FILE.csv", NULL, "the same as CSV; a directory gets the diagrams as well")

enum { OWN_LIST(CLI_OWN) OWN_OPTIONS };

static const cli_option own[OWN_OPTIONS] = {OWN_LIST(CLI_OPTION)};

static void adapt_options(cli_option *options)
{
    options[JOB_step].initial = "0.1";
    options[JOB_time].initial = "10";
    options[JOB_space].initial = "physical";
}

static const char notes[] =
    "SYSTEM is a built-in name or the path of a system file.  --step is the largest step (0.1),\n"
    "--time the time at which errors are taken (10), and the space is (q,v) unless --space lifted\n"
    "is given.\n"
    "\n"
    "The error is the greatest difference in q and v at T, relative to max(1, |x|), from the\n"
    "exact solution where the system has one that begins at this start; else from gauss12\n"
    "(dop853 where that does not converge) with half the smallest step, whose own error is told.\n"
    "The order found is the slope between the last two of three steps whose errors are above\n"
    "rounding, above ten times that error and below half the solution, where their two slopes\n"
    "agree so far that the next term of the error moves it by 0.1 at most; elsewhere none is\n"
    "found ('-').  Methods that cannot serve the system are listed with the reason; the exit\n"
    "status is 3 when one failed on its way.\n"
    "\n"
    "DIR gets order.csv, and by gnuplot order.svg (error against step) and work.svg (error "
    "against\n"
    "evaluations of F, and against processor time), with their scripts.  Only times vary from one\n"
    "run of the command to another.\n";

typedef struct wishes {
    const char *integrators, *steps, *output;
    long long levels, threads;
} wishes;

static int take(void *user, int k, const char *value)
{
    wishes *w = user;
    switch (k) {
    case OWN_integrators:
        w->integrators = value;
        return CLI_DONE;
    case OWN_steps:
        w->steps = value;
        return CLI_DONE;
    case OWN_levels:
        return cli_integer("--levels", value, 2, DAL_ORDER_LEVELS, &w->levels);
    case OWN_threads:
        return cli_integer("--threads", value, 1, POOL_MOST, &w->threads);
    default:
        w->output = value;
        return CLI_DONE;
    }
}

/* ---- the list of methods ------------------------------------------------------------------- */

static int add_method(order_study *s, const char *name)
{
    dal_error error = {0};
    dal_method method;
    if (dal_method_parse(&method, name, &error) != DAL_OK)
        return cli_error(CLI_USAGE, NULL, &error);
    const size_t count = (size_t)s->method_count + 1;
    s->methods = cli_realloc(s->methods, count * sizeof *s->methods);
    order_method *list = s->methods + s->method_count++;
    *list = (order_method){.method = method};
    dal_method_name(&method, list->name, sizeof list->name);
    return CLI_DONE;
}

static int add_all(order_study *s)
{
    const dal_integrator *k;
    int status = CLI_DONE;
    for (int i = 0; status == CLI_DONE && (k = dal_integrator_at(i)); i++)
        if (!(k->claims & DAL_MODIFIER)) status = add_method(s, k->name);
    return status;
}

/* Calls add for each piece of a list between commas. */
static int each_piece(order_study *s, const char *list, const char *what,
                      int (*add)(order_study *s, const char *piece))
{
    int status = CLI_DONE;
    while (status == CLI_DONE) {
        char piece[ORDER_NAME];
        const size_t length = strcspn(list, ",");
        if (length == 0 || length >= sizeof piece)
            return cli_fail(CLI_USAGE, "%s: '%.40s' is not a list between commas", what, list);
        memcpy(piece, list, length);
        piece[length] = '\0';
        status = add(s, piece);
        if (!list[length]) break;
        list += length + 1;
    }
    return status;
}

static int add_piece(order_study *s, const char *name)
{
    return strcmp(name, "all") == 0 ? add_all(s) : add_method(s, name);
}

/* ---- the list of steps --------------------------------------------------------------------- */

static int add_step(order_study *s, const char *text)
{
    double h;
    if (s->levels == DAL_ORDER_LEVELS)
        return cli_fail(CLI_USAGE, "--steps: more than %d", DAL_ORDER_LEVELS);
    if (cli_number("--steps", text, &h) != CLI_DONE) return CLI_USAGE;
    if (!(h > 0.0) || (s->levels > 0 && !(h < s->step[s->levels - 1])))
        return cli_fail(CLI_USAGE, "--steps: %s is not positive and below the one before", text);
    s->step[s->levels++] = h;
    return CLI_DONE;
}

static int list_steps(order_study *s, const wishes *w)
{
    if (w->steps) return each_piece(s, w->steps, "--steps", add_step);
    s->levels = (int)w->levels;
    for (int i = 0; i < s->levels; i++) s->step[i] = ldexp(s->job.options.step, -i);
    return s->step[0] > 0.0 ? CLI_DONE : cli_fail(CLI_USAGE, "--step: it must be positive");
}

static int check_steps(const order_study *s)
{
    const double T = s->job.time;
    if (s->levels < 2) return cli_fail(CLI_USAGE, "--steps: a slope needs two steps at least");
    for (int i = 0; i < s->levels; i++) {
        const double count = round(T / s->step[i]);
        if (!(count >= 1.0 && count < 0x1p53) || fabs(count * s->step[i] - T) > 1e-9 * T)
            return cli_fail(CLI_USAGE, "the time %g does not hold a whole number of steps %.9g", T,
                            s->step[i]);
    }
    return CLI_DONE;
}

/* ---- the command --------------------------------------------------------------------------- */

static int tell(const order_study *s, const char *output)
{
    analysis_output place = {0};
    order_print(stdout, s);
    int status = cli_close(stdout, "standard output");
    if (status != CLI_DONE || !output) return status;
    status = analysis_open(&place, output, "order");
    if (status == CLI_DONE) status = order_write(s, place.table);
    if (status == CLI_DONE && place.directory) status = order_draw(s, place.directory);
    free(place.table);
    return status;
}

static int any_failed(const order_study *s)
{
    for (int i = 0; i < s->method_count; i++)
        if (s->methods[i].state == ORDER_FAILED) return 1;
    return 0;
}

static int go(order_study *s, const wishes *w)
{
    dal_run_spec spec;
    if (!s->job.text[JOB_step]) s->job.options.step = 0.1;
    if (!s->job.text[JOB_time]) s->job.time = 10.0;
    int status = list_steps(s, w);
    if (status == CLI_DONE) status = check_steps(s);
    if (status == CLI_DONE) status = each_piece(s, w->integrators, "--integrators", add_piece);
    if (status == CLI_DONE) status = job_spec(&s->job, &spec);
    if (status != CLI_DONE) return status;
    if (!s->job.text[JOB_space]) s->job.options.space = DAL_PHYSICAL;
    s->threads = w->threads > 0 ? (int)w->threads : pool_threads();
    cli_catch_signals();
    status = order_reference(s);
    if (status == CLI_DONE) status = order_run(s);
    if (status == CLI_DONE) status = tell(s, w->output);
    return status == CLI_DONE && any_failed(s) ? CLI_FAILED : status;
}

int command_order(int argc, char **argv)
{
    const analysis_command command = {
        own, OWN_OPTIONS, ANALYSIS_ROWS | ANALYSIS_OPTION(integrator), notes, take, adapt_options};
    wishes w = {.integrators = "all", .levels = 4};
    order_study s = {.job = job_begin()};
    int status = analysis_read(argc, argv, &command, &s.job, &w);
    if (status == CLI_GO_ON) status = go(&s, &w);
    free(s.methods);
    free(s.reference);
    job_free(&s.job);
    return status;
}
