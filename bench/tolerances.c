/* tolerances.c - the time in which the methods with error control reach an error.
 *
 *     tolerances reference SYSTEM                     the reference of a motion, see tolerances.h
 *     tolerances find METHOD SYSTEM LANES ERROR       the largest tolerance that reaches the error,
 *                                                     as all smaller ones do
 *     tolerances errors METHOD SYSTEM LANES           the largest error of tolerances 10^(-k/4),
 *                                                     from 1e-3 to 1e-13, and their neighbours,
 *                                                     1e-6 away, in units of the tolerance
 *     tolerances time METHOD SYSTEM LANES ERROR TOLERANCE
 *                                                     nanoseconds of a trajectory, compiled, which
 *                                                     must reach the error
 *
 *     METHOD   dop853, taylor      SYSTEM   of `motions`      LANES   1, 8
 *
 * The reference is made by taylor in quad precision, which rounds nothing that counts and has no
 * coefficients.  It must agree with gauss12 in quad precision, a method that shares nothing with
 * it, to REFERENCE_ERROR; coefficients of gauss12 are doubles.  What is timed is one step that is
 * as large as the whole time, divided under error control; the start is set again outside of it.
 * Compiled and interpreted steps have the same bits, so that tolerances are found without a
 * compiler. */
#define _POSIX_C_SOURCE 200809L
#include "tolerances.h"
#include "model.h"
#include <dalembert.h>
#include <dalembert_codegen.h>

static const double REFERENCE_ERROR = 2e-15, REFERENCE_TOLERANCE = 1e-22;

/* Lanes differ in a number of the start, or in a parameter that only the start depends on. */
typedef struct motion {
    const char *name;
    double time, gauss_step;
    dal_setting number;
    int is_start; /* the number: else a parameter */
} motion;

static const motion motions[] = {
    {"A", 100.0, 0.05, {"phi'", 1.0}, 1},
    {"chaotic-oscillators", 20.0, 0.05, {"angle", 0.34906585039886592}, 0},
    {"falling-disk", 20.0, 0.05, {"p0", 0.2}, 0},
    {"knife-edge-pendulum", 10.0, 0.01, {"c'", 1.1}, 1},
    {"turntable-ball", 40.0, 0.1, {"x0", 0.5}, 0},
    {"four_bodies", 20.0, 0.02, {"x1", 0.267499}, 1}};
static const double LANE_DIFFERENCE = 1e-2;

/* One lane of a motion. */
typedef struct member {
    dal_run_spec spec;
    dal_setting number;
} member;

/* What is stepped. */
typedef struct contender {
    const motion *motion;
    const char *method;
    int lanes;
    double error, tolerance;
    bench_reference reference;
    member lane[BENCH_LANES];
    dal_run *run;
    dal_batch *batch;
    bench_states end;
} contender;

static int fail(const dal_error *error)
{
    fprintf(stderr, "tolerances: %s\n", error->message);
    return 1;
}

static int make_members(contender *j, dal_error *error)
{
    const dal_system *system = bench_system(j->motion->name, error);
    dal_method method;
    if (!system || dal_method_parse(&method, j->method, error)) return 1;
    for (int i = 0; i < BENCH_LANES; i++) {
        member *m = &j->lane[i];
        m->number = j->motion->number;
        m->number.value += LANE_DIFFERENCE * i;
        m->spec = (dal_run_spec){.system = system,
                                 .method = method,
                                 .options = dal_options_default(),
                                 .parameters = &m->number,
                                 .start = &m->number,
                                 .parameter_count = !j->motion->is_start,
                                 .start_count = j->motion->is_start};
        m->spec.options.space = DAL_PHYSICAL;
        m->spec.options.step = j->motion->time;
    }
    return 0;
}

/* The states at the start and at the end of a run. */
static int integrate(const dal_run_spec *spec, double time, double *start, double *end,
                     dal_error *error)
{
    dal_run *run;
    const size_t bytes = 2 * (size_t)spec->system->n * sizeof *end;
    if (dal_run_create(&run, spec, error)) return 1;
    if (start) memcpy(start, dal_run_state(run), bytes);
    const dal_status status = dal_run_advance(run, lround(time / spec->options.step), error);
    memcpy(end, dal_run_state(run), bytes);
    dal_run_free(run);
    return status != DAL_STATUS_OK;
}

static void print_state(const double *y, int size)
{
    for (int i = 0; i < size; i++) printf(" %.17g", y[i]);
    putchar('\n');
}

static int print_reference(contender *j, dal_error *error)
{
    const int size = 2 * j->lane[0].spec.system->n;
    dal_method gauss;
    if (dal_method_parse(&gauss, "gauss12", error)) return 1;
    printf("%d %g\n", size, j->motion->time);
    for (int i = 0; i < BENCH_LANES; i++) {
        double start[BENCH_MAX_MOTION], end[BENCH_MAX_MOTION], other[BENCH_MAX_MOTION];
        dal_run_spec spec = j->lane[i].spec;
        spec.options.precision = DAL_QUAD;
        spec.options.tolerance = REFERENCE_TOLERANCE;
        if (integrate(&spec, j->motion->time, start, end, error)) return 1;
        spec.method = gauss;
        spec.options.tolerance = 0.0;
        spec.options.step = j->motion->gauss_step;
        if (integrate(&spec, j->motion->time, NULL, other, error)) return 1;
        const double difference = bench_distance(other, end, size);
        if (!(difference <= REFERENCE_ERROR)) {
            snprintf(error->message, sizeof error->message,
                     "%s, lane %d: taylor and gauss12 in quad precision differ by %.1e",
                     j->motion->name, i, difference);
            return 1;
        }
        print_state(start, size);
        print_state(end, size);
    }
    return 0;
}

/* Of interpreted runs. */
static double error_of(void *self, double tolerance)
{
    contender *j = self;
    for (int i = 0; i < j->lanes; i++) {
        dal_run_spec spec = j->lane[i].spec;
        spec.options.tolerance = tolerance;
        if (integrate(&spec, j->motion->time, NULL, j->end[i], NULL)) return INFINITY;
    }
    return bench_error(&j->reference, j->end, j->lanes);
}

static void print_errors(contender *j)
{
    double max = 0.0;
    for (int k = 12; k <= 52; k++) {
        for (int side = -1; side <= 1; side++) {
            const double tolerance = pow(10.0, -k / 4.0) * (1.0 + side * 1e-6);
            max = fmax(max, error_of(j, tolerance) / tolerance);
        }
    }
    printf("%.3g\n", max);
}

static int start_again(void *self)
{
    contender *j = self;
    if (j->run) return dal_run_set_state(j->run, 0.0, j->reference.start[0], NULL) != DAL_STATUS_OK;
    if (dal_batch_clear(j->batch)) return 1;
    for (int i = 0; i < j->lanes; i++) {
        const dal_run_spec *spec = &j->lane[i].spec;
        if (dal_batch_start(j->batch, i, spec->parameters, spec->parameter_count, spec->start,
                            spec->start_count, NULL))
            return 1;
    }
    return 0;
}

static int work(void *self, double *end)
{
    contender *j = self;
    const size_t bytes = (size_t)j->reference.size * sizeof *end;
    const dal_status status =
        j->run ? dal_run_advance(j->run, 1, NULL) : dal_batch_advance(j->batch, 1);
    for (int i = 0; i < j->lanes; i++) {
        if (j->run) memcpy(j->end[i], dal_run_state(j->run), bytes);
        if (j->batch) dal_batch_state(j->batch, i, j->end[i]);
    }
    memcpy(end, j->end[0], bytes);
    return status != DAL_STATUS_OK;
}

static int time_steps(contender *j, dal_error *error)
{
    const dal_native_options native = {.cache = "build/bench/cache"};
    const bench_contender timed = {j->lanes, j->reference.size, work, j};
    dal_run_spec *spec = &j->lane[0].spec;
    spec->options.tolerance = j->tolerance;
    if (j->lanes == 1 ? dal_run_create(&j->run, spec, error)
                      : dal_batch_create(&j->batch, spec, j->lanes, 0, error))
        return 1;
    if (j->run ? dal_run_native(j->run, &native, error)
               : dal_batch_native(j->batch, &native, error))
        return 1;
    if (bench_measure_from(&timed, start_again)) return 1;
    const double reached = bench_error(&j->reference, j->end, j->lanes);
    if (reached <= j->error) return 0;
    snprintf(error->message, sizeof error->message, "the error is %.2e", reached);
    return 1;
}

static const motion *find_motion(const char *name)
{
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++)
        if (strcmp(name, motions[i].name) == 0) return &motions[i];
    return NULL;
}

int main(int argc, char **argv)
{
    static contender j;
    dal_error error = {0};
    const int is_reference = argc == 3 && strcmp(argv[1], "reference") == 0;
    const int finds = argc == 6 && strcmp(argv[1], "find") == 0;
    const int lists = argc == 5 && strcmp(argv[1], "errors") == 0;
    const int times = argc == 7 && strcmp(argv[1], "time") == 0;
    if (is_reference || finds || lists || times) j.motion = find_motion(argv[is_reference ? 2 : 3]);
    if (!j.motion) return bench_unknown(argc, argv);
    j.method = is_reference ? "taylor" : argv[2];
    if (make_members(&j, &error)) return fail(&error);
    if (is_reference) return print_reference(&j, &error) ? fail(&error) : 0;
    j.lanes = atoi(argv[4]);
    j.error = lists ? 0.0 : atof(argv[5]);
    if (j.lanes < 1 || j.lanes > BENCH_LANES) return bench_unknown(argc, argv);
    if (bench_read_reference(&j.reference, j.motion->name)) return 1;
    if (finds) bench_find(error_of, &j, j.error);
    if (lists) print_errors(&j);
    if (finds || lists) return 0;
    j.tolerance = atof(argv[6]);
    return time_steps(&j, &error) ? fail(&error) : 0;
}
