/* by_hand.c - a system without formulas: a dal_system filled by hand, in the caller's own memory.
 *
 *     x'' = -x, y'' = -y + (y' constrained to follow x'):  D = y' - k x' = 0
 *
 * Gauss' principle gives the accelerations below; no model, no allocation, no text. */
#include <dalembert.h>
#include <stdio.h>

enum { X, Y, N };

/* F = b - W^-1 A^T G^-1 (A b + c) with W = 1, A = (-k, 1), b = (-x, -y), c = 0. */
static dal_status field(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    const double k = at->work[0];
    const double h = -((k * at->q[X] - at->q[Y]) / (1.0 + k * k));
    out[X] = -at->q[X] - k * h;
    out[Y] = -at->q[Y] + h;
    return DAL_STATUS_OK;
}

static dal_status constraints(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = at->v[Y] - at->work[0] * at->v[X];
    return DAL_STATUS_OK;
}

int main(void)
{
    static const char *const names[] = {"x", "y"}, *const parameters[] = {"k"};
    static const double values[] = {0.5};
    static const dal_setting start[] = {{"x", 1.0}, {"x'", 2.0}, {"y'", 1.0}};
    const dal_system system = {.name = "guided oscillator",
                               .n = N,
                               .m = 1,
                               .parameters = 1,
                               .coordinate = names,
                               .parameter = parameters,
                               .value = values,
                               .call = {.field = field},
                               .constraints = constraints};
    dal_run_spec spec = {.system = &system, .options = dal_options_default()};
    spec.options.space = DAL_PHYSICAL;
    spec.start = start;
    spec.start_count = 3;

    static char memory[65536];
    dal_run *run;
    dal_error error;
    double D;
    if (dal_method_parse(&spec.method, "rk4", &error) ||
        dal_run_init(&run, memory, sizeof memory, &spec, &error) ||
        dal_run_advance(run, 1000, &error)) {
        fprintf(stderr, "by_hand: %s\n", error.message);
        return 1;
    }
    dal_run_observe(run, &D);
    const double *q = dal_run_state(run);
    printf("%.17g %.17g %.17g %.3g\n", dal_run_time(run), q[X], q[Y], D);
    return 0;
}
