/* check_lift.c - Dirac's algebra and the actions of a system.
 *
 *     S = int e/2 |q'' - F|^2 dt (nh10): 0 on a solution, positive off it
 *     S_H = int P.X' - H (nh23): stationary on a trajectory; discretised at midpoints it is so on
 *     one of implicit-midpoint to rounding, and on none of another method */
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- algebra ---- */

void check_algebra(check *c)
{
    static const double zero = 1e-9;
    dal_dirac d;
    int n = c->n;
    const dal_point *at = c->surface_count > 0 ? &c->surface[0] : &c->origin;
    const double e = c->start[c->size];
    if (e == 0.0 || isinf(e)) return;
    const dal_status status = dal_measure_dirac(c->probe, at, e, &d);
    if (status == DAL_UNSUPPORTED) return;
    if (!cli_is_ok(status)) {
        check_unmeasured(c, "brackets", "%s", dal_status_text(status));
        return;
    }
    check_item(c, d.second_class == 2 * n ? CHECK_OK : CHECK_FAIL, "second-class constraints",
               "rank %d of %d brackets' matrix, 2n = %d", d.second_class, d.constraints, 2 * n);
    check_item(c, d.first_class == 2 * n + 1 ? CHECK_OK : CHECK_FAIL, "first-class constraints",
               "%d, 2n+1 = %d", d.first_class, 2 * n + 1);
    check_bound(c, "{phi, H} on the surface", d.conservation, zero);
    check_bound(c, "mu_q = v, mu_lambda = 0", d.multipliers, zero);
    check_item(c, d.free_multipliers == 1 ? CHECK_OK : CHECK_FAIL, "multipliers left free",
               "%d (mu_e, the gauge)", d.free_multipliers);
    check_item(c, d.secondary > 1e-3 ? CHECK_OK : CHECK_FAIL, "{primary phi, H} off pi = 0",
               "%.2g: pi = 0, lambda = 0 are needed", d.secondary);
    check_bound(c, "H on the surface", d.hamiltonian, zero);
}

/* ---- actions ---- */

enum { NODES = 61, LIFTED_NODES = 21, REFINEMENTS = 6 };

typedef struct track {
    check *c;
    dal_run *run;
    double h, *row; /* the rows of states */
    int width;      /* numbers kept of each state */
} track;

/* A run from the start in the given space with the method named. */
static int open_track(track *w, const char *method, dal_space space)
{
    check *c = w->c;
    dal_run_spec spec = {.system = c->system,
                         .options = dal_options_default(),
                         .parameters = c->parameters,
                         .parameter_count = c->parameter_count};
    spec.options.step = w->h;
    spec.options.space = space;
    return dal_method_parse(&spec.method, method, NULL) == DAL_OK &&
           cli_is_ok(dal_run_create(&w->run, &spec, NULL));
}

static int follow(track *w, int nodes)
{
    for (int k = 0; k < nodes; k++) {
        if (k > 0 && dal_run_step(w->run, NULL) != DAL_OK) return 0;
        memcpy(w->row + (size_t)k * (size_t)w->width, dal_run_state(w->run),
               (size_t)w->width * sizeof(double));
    }
    return 1;
}

/* Adds a smooth bump of the given height to every coordinate. */
static void perturb(track *w, double height)
{
    double pi = acos(-1.0);
    for (int k = 0; k < NODES; k++) {
        double s = sin(pi * k / (NODES - 1));
        for (int i = 0; i < w->width; i++) w->row[k * w->width + i] += height * s * s * s * s;
    }
}

static int actions(track *w, double *computed, double *perturbed)
{
    check *c = w->c;
    double e = c->start[c->size];
    int done = open_track(w, "gauss8", DAL_PHYSICAL) &&
               dal_run_set_state(w->run, 0.0, c->start, NULL) == DAL_OK && follow(w, NODES) &&
               cli_is_ok(dal_measure_action(c->probe, 0.0, w->h, NODES, w->row, e, computed));
    if (done) {
        perturb(w, 1e-3);
        done = cli_is_ok(dal_measure_action(c->probe, 0.0, w->h, NODES, w->row, e, perturbed));
    }
    dal_run_free(w->run);
    w->run = NULL;
    return done;
}

/* With a smaller step when the motion is too fast for the differences. */
static void check_second_order(check *c)
{
    track w = {.c = c, .h = 0.01, .width = c->n};
    double computed = INFINITY, perturbed = 0.0;
    int done = 0;
    w.row = cli_calloc((size_t)NODES * (size_t)c->n, sizeof(double));
    for (int k = 0; k < REFINEMENTS && !(computed < 1e-9 * perturbed); k++) {
        done |= actions(&w, &computed, &perturbed);
        w.h *= 0.25;
    }
    free(w.row);
    if (!done)
        check_unmeasured(c, "action (nh10)",
                         "gauss8 makes no trajectory, or F is not finite on it");
    if (!done) return;
    check_item(c, computed < 1e-9 * perturbed ? CHECK_OK : CHECK_FAIL, "action (nh10)",
               "%.2g on a trajectory, %.2g on a perturbed one", computed, perturbed);
}

/* Off the surface, so that p, pi, pi_e move: p = 0.1, -0.1, ..; pi likewise. */
static void displace(const check *c, double *state)
{
    for (int i = 2 * c->n + 1; i < 4 * c->n + 1; i++) state[i] = i % 2 ? 0.1 : -0.1;
}

static int stationarity(check *c, const char *method, double *defect)
{
    track w = {.c = c, .h = 0.01, .width = 4 * c->n + 2};
    size_t width = (size_t)w.width;
    w.row = cli_calloc((LIFTED_NODES + 1) * width, sizeof(double));
    int done = open_track(&w, method, DAL_LIFTED);
    if (done) {
        double *state = w.row + LIFTED_NODES * width;
        memcpy(state, c->start, (size_t)(c->size + 1) * sizeof(double));
        displace(c, state);
        done = dal_run_set_state(w.run, 0.0, state, NULL) == DAL_OK && follow(&w, LIFTED_NODES) &&
               cli_is_ok(dal_measure_stationarity(c->probe, 0.0, w.h, LIFTED_NODES, w.row, defect));
    }
    dal_run_free(w.run);
    free(w.row);
    return done;
}

void check_action(check *c)
{
    double midpoint, other;
    const double e = c->start[c->size];
    if (c->system->multipliers > 0 || e == 0.0 || isinf(e)) return;
    check_second_order(c);
    if (c->system->call.adjoint == NULL) return;
    if (stationarity(c, "implicit-midpoint", &midpoint))
        check_bound(c, "d action (nh23), implicit-midpoint", midpoint, 1e-8);
    else
        check_unmeasured(c, "d action (nh23), implicit-midpoint", "there is no trajectory");
    if (stationarity(c, "rk4", &other))
        check_item(c, CHECK_INFO, "d action (nh23), rk4", "%.2g", other);
    else
        check_unmeasured(c, "d action (nh23), rk4", "there is no trajectory");
}
