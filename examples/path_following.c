/* path_following.c - a mobile robot follows a path: the torques of its two wheels are parameters,
 * set between steps by a feedback at 1 kHz.
 *
 *     cc path_following.c $(pkg-config --cflags --libs dalembert) -lm -o path_following
 *
 * The robot has the heading phi, the speed v = x' cos(phi) + y' sin(phi) and the rate w = phi'.
 * The point P at a distance l ahead of its axle has the acceleration
 *
 *     P'' = R(phi) (F/m - l w^2,  l M/I + v w),    R(phi) the rotation by phi,
 *     F = (left + right)/r,    M = (right - left) b/r
 *
 * for which the wheels are driven to give r'' + 2 k (r' - P') + k^2 (r - P), with the path r(t).
 * Then e = r - P obeys e'' + 2 k e' + k^2 e = 0, except that torques are held for a period T:
 * that changes P'' by at most T J, where J bounds the rates of r'' and P'', so that |e| <= T J/k^2.
 *
 * Prints t, x, y, |e| and |D| every second, and fails if |e| exceeds its bound. */
#include <dalembert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char robot[] = "title: Mobile robot with two driven wheels\n"
                            "coordinates: [x, y, phi]\n"
                            "parameters: {m: 10, I: 0.5, r: 0.1, b: 0.2, left: 0, right: 0}\n"
                            "lagrangian: m/2*(x'^2 + y'^2) + I/2*phi'^2\n"
                            "forces:\n"
                            "  x: (left + right)/r*cos(phi)\n"
                            "  y: (left + right)/r*sin(phi)\n"
                            "  phi: (right - left)*b/r\n"
                            "constraints: [x'*sin(phi) - y'*cos(phi)]\n";

#define MASS      10.0
#define INERTIA   0.5
#define RADIUS    0.1
#define HALF_AXLE 0.2
#define AHEAD     0.5   /* l */
#define GAIN      5.0   /* k */
#define PERIOD    0.001 /* T, and the step */
enum { SECONDS = 21, PER_SECOND = 1000 };

/* The path, a figure of eight: a (sin s, sin(2 s)/2), s = rate t; and two derivatives. */
#define SIZE 2.0
#define RATE 0.3
static void path(double t, double r[3][2])
{
    const double s = RATE * t;
    const double d[3][2] = {{sin(s), 0.5 * sin(2 * s)},
                            {RATE * cos(s), RATE * cos(2 * s)},
                            {-RATE * RATE * sin(s), -2 * RATE * RATE * sin(2 * s)}};
    for (int i = 0; i < 6; i++) r[i / 2][i % 2] = SIZE * d[i / 2][i % 2];
}

/* T J/k^2, from the largest |r'|, |r''| and |r'''|. */
static double error_bound(void)
{
    const double speed = sqrt(2.0) * SIZE * RATE, acceleration = speed * RATE * sqrt(2.5);
    const double w = speed / AHEAD, dv = acceleration + speed * w, dw = dv / AHEAD;
    const double held = w * acceleration + hypot(2 * AHEAD * w * dw, dv * w + speed * dw);
    return PERIOD * (sqrt(17.0) * SIZE * RATE * RATE * RATE + held) / (GAIN * GAIN);
}

/* Numbers of the components in the state. */
typedef struct places {
    int x, y, phi, dx, dy, dphi;
} places;

/* Sets the torques for the present state; *deviation becomes |e|. */
static dal_status control(dal_run *run, const places *at, double *deviation, dal_error *error)
{
    const double *state = dal_run_state(run);
    const double c = cos(state[at->phi]), s = sin(state[at->phi]), w = state[at->dphi];
    const double v = state[at->dx] * c + state[at->dy] * s;
    double r[3][2], wanted[2];
    path(dal_run_time(run), r);
    const double P[2][2] = {{state[at->x] + AHEAD * c, state[at->y] + AHEAD * s},
                            {v * c - AHEAD * w * s, v * s + AHEAD * w * c}};
    for (int i = 0; i < 2; i++)
        wanted[i] = r[2][i] + 2 * GAIN * (r[1][i] - P[1][i]) + GAIN * GAIN * (r[0][i] - P[0][i]);
    *deviation = hypot(r[0][0] - P[0][0], r[0][1] - P[0][1]);
    const double force = MASS * (wanted[0] * c + wanted[1] * s + AHEAD * w * w);
    const double moment = INERTIA / AHEAD * (wanted[1] * c - wanted[0] * s - v * w);
    const double sum = force * RADIUS, difference = moment * RADIUS / HALF_AXLE;
    dal_status status = dal_run_set_parameter(run, "left", 0.5 * (sum - difference), error);
    if (status == DAL_STATUS_OK)
        status = dal_run_set_parameter(run, "right", 0.5 * (sum + difference), error);
    return status;
}

static int follow(dal_run *run, dal_error *error)
{
    const places at = {dal_run_component_index(run, "x"),   dal_run_component_index(run, "y"),
                       dal_run_component_index(run, "phi"), dal_run_component_index(run, "x'"),
                       dal_run_component_index(run, "y'"),  dal_run_component_index(run, "phi'")};
    const double bound = error_bound();
    double deviation, seen[2], max = 0.0; /* seen: D, E */
    for (int step = 0; step <= SECONDS * PER_SECOND; step++) {
        if (control(run, &at, &deviation, error)) return 1;
        max = fmax(max, deviation);
        if (step % PER_SECOND == 0) {
            if (dal_run_observe(run, seen)) return 1;
            printf("%.3f %.9f %.9f %.6e %.1e\n", dal_run_time(run), dal_run_state(run)[at.x],
                   dal_run_state(run)[at.y], deviation, fabs(seen[0]));
        }
        if (dal_run_step(run, error)) return 1;
    }
    printf("max %.6e bound %.6e\n", max, bound);
    snprintf(error->message, sizeof error->message, "the error exceeds its bound");
    return !(max <= bound);
}

int main(void)
{
    const double c = sqrt(0.5), phi = atan(1.0), v = SIZE * RATE;
    const dal_setting start[] = {
        {"x", -AHEAD * c}, {"y", -AHEAD * c}, {"phi", phi}, {"x'", v}, {"y'", v}};
    dal_run_spec spec = {.options = dal_options_default(), .start = start, .start_count = 5};
    dal_model *model = NULL;
    dal_run *run = NULL;
    dal_error error = {0};
    spec.options.step = PERIOD;
    spec.options.space = DAL_PHYSICAL;
    const int failed = dal_model_read(&model, "robot", robot, strlen(robot), &error) ||
                       dal_model_system(model, &spec.system, &error) ||
                       dal_method_parse(&spec.method, "rk4+project", &error) ||
                       dal_run_create(&run, &spec, &error) || follow(run, &error);
    if (failed) fprintf(stderr, "path_following: %s\n", error.message);
    dal_run_free(run);
    dal_model_free(model);
    return failed;
}
