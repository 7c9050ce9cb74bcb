/* dal.c - this library.
 *
 *     dal ENGINE METHOD SPACE SYSTEM
 *
 *     ENGINE   tape: formulas, interpreted; unchecked: without the rank check; native: compiled, in
 *              the cache build/bench/cache; callback: the field as a C callback, written by hand;
 *              batchN: formulas, N trajectories at once; compiledN: the same, compiled
 *              made: no steps, but the system is made from its formulas; steer: no steps, but
 *              100 of them from rest to rest elsewhere are found, n = 3; memory: no steps, but the
 *              bytes that a run of them has allocated
 *     METHOD   as dal_method_parse reads it          SPACE   physical, lifted
 *     SYSTEM   a built-in one, or A, B3, ... (bench/systems), B101, C (examples); C0: the fluid
 *              without pair forces, all that is left of C being the integrator and the thermostat;
 *              RN: N coordinates, N/4 constraints whose Jacobian varies; LN: N coordinates, N/2
 *              constraints (links.inc); TN: N coordinates, a tridiagonal mass matrix of q,
 *              N/2 - 1 constraints, each of which shares coordinates with the next; rods: 100
 *              rods, 200 coordinates (examples) */
#define _POSIX_C_SOURCE 200809L
#include "../examples/contact_chain.h"
#include "../examples/isokinetic_fluid.h"
#include "bench.h"
#include "model.h"
#include <dalembert_codegen.h>
#include <dalembert_steer.h>
#include <malloc.h>

#include "real.inc"

#include "fields.inc"

#define FLUID_STEP 0.002
#define RODS       "examples/chain-of-100-links.yaml"
#define RODS_STEP  0.0005
#define CACHE      "build/bench/cache"

enum { MAX_COMPILE_SECONDS = 120 };

typedef struct contender {
    dal_run_spec spec;
    dal_run *run;
    dal_batch *batch;
    double start[BENCH_MAX_SIZE * 2 + 2];
    int steps, shown; /* a round; components of q and v */
} contender;

/* The accelerations of sleigh_field, from q and v where they are. */
static dal_status sleigh_callback(const dal_system *system, const dal_point *at, double *out)
{
    const double *v = at->v;
    double s, c;
    (void)system;
    real_sincos(at->q[2], &s, &c);
    const double h = SLEIGH_G * s - (v[0] * c + v[1] * s) * v[2];
    out[0] = h * s - SLEIGH_G;
    out[1] = -(h * c);
    out[2] = -SLEIGH_K * s;
    return DAL_STATUS_OK;
}

static dal_status sleigh_start(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)at;
    memcpy(out, sleigh_y, sizeof sleigh_y);
    out[SMALL_DIM] = 1.0;
    return DAL_STATUS_OK;
}

static dal_status sleigh_constraints(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = at->v[0] * sin(at->q[2]) - at->v[1] * cos(at->q[2]);
    return DAL_STATUS_OK;
}

static dal_status no_forces(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    memset(out, 0, FLUID_N * sizeof *out);
    fluid_thermostat(at->v, out);
    return DAL_STATUS_OK;
}

static const dal_system sleigh_by_hand = {.name = "sleigh",
                                          .n = 3,
                                          .m = 1,
                                          .call = {.field = sleigh_callback},
                                          .start = sleigh_start,
                                          .constraints = sleigh_constraints};

/* Writes a chain of n springs up to its constraints; returns the end. */
static char *write_springs(char *text, int n)
{
    char *end = text;
    end += sprintf(end, "coordinates: [x0");
    for (int i = 1; i < n; i++) end += sprintf(end, ", x%d", i);
    end += sprintf(end, "]\nlagrangian: (x0'^2");
    for (int i = 1; i < n; i++) end += sprintf(end, " + x%d'^2 - (x%d - x%d)^2", i, i, i - 1);
    end += sprintf(end, ")/2\nconstraints:\n");
    return end;
}

/* A chain of n springs, four velocities of which each constraint couples. */
static dal_status make_chain(dal_model **model, int n, dal_error *error)
{
    static char text[1 << 18];
    char *end = write_springs(text, n);
    for (int i = 0; i < n; i += 4)
        end += sprintf(end, "  - x%d'*cos(x%d) + x%d'*sin(x%d) - x%d'*x%d\n", i, i + 2, i + 1,
                       i + 2, (i + 4) % n, i + 3);
    end += sprintf(end, "start: {x0: 0.1");
    for (int i = 1; i < n; i++) end += sprintf(end, ", x%d: %g", i, 0.1 * cos(i));
    end += sprintf(end, "}\n");
    return dal_model_read(model, "chain", text, (size_t)(end - text), error);
}

/* The chain of links.inc. */
static dal_status make_links(dal_model **model, int n, dal_error *error)
{
    static char text[1 << 18];
    char *end = write_springs(text, n);
    for (int k = 0; k < n; k += 2)
        end += sprintf(end, "  - x%d' - x%d*x%d'\n", k, (k + 2) % n, k + 1);
    end += sprintf(end, "start: {x0: 0.1");
    for (int i = 1; i < n; i++) end += sprintf(end, ", x%d: 0.1*cos(%d)", i, i);
    for (int k = 0; k < n; k += 2)
        end += sprintf(end, ", x%d': 0.5*cos(%d), x%d': 0.05*cos(%d)*cos(%d)", k + 1, k, k,
                       (k + 2) % n, k);
    end += sprintf(end, "}\n");
    return dal_model_read(model, "links", text, (size_t)(end - text), error);
}

/* A chain whose mass matrix and constraints couple each coordinate with the next ones. */
static dal_status make_coupled(dal_model **model, int n, dal_error *error)
{
    static char text[1 << 18];
    char *end = text;
    end += sprintf(end, "coordinates: [x0");
    for (int i = 1; i < n; i++) end += sprintf(end, ", x%d", i);
    end += sprintf(end, "]\nlagrangian: (x0'^2 - x0^2");
    for (int i = 1; i < n; i++)
        end += sprintf(end, " + x%d'^2 + x%d'*x%d'*cos(x%d)/4 - (x%d - x%d)^2", i, i - 1, i, i, i,
                       i - 1);
    end += sprintf(end, ")/2\nconstraints:\n");
    for (int i = 0; i + 2 < n; i += 2)
        end += sprintf(end, "  - x%d'*cos(x%d) + x%d' + x%d'*sin(x%d)/2\n", i, i + 2, i + 1, i + 2,
                       i + 1);
    end += sprintf(end, "start: {x0: 0.1");
    for (int i = 1; i < n; i++) end += sprintf(end, ", x%d: %g", i, 0.1 * cos(i));
    end += sprintf(end, "}\n");
    return dal_model_read(model, "coupled", text, (size_t)(end - text), error);
}

/* A model by its formulas: of a chain, or by its name. */
static dal_status make_model(dal_model **model, const char *name, dal_error *error)
{
    if (name[0] == 'R') return make_chain(model, atoi(name + 1), error);
    if (name[0] == 'L') return make_links(model, atoi(name + 1), error);
    if (name[0] == 'T') return make_coupled(model, atoi(name + 1), error);
    if (strcmp(name, "rods") == 0) return dal_model_read_file(model, RODS, error);
    return bench_model(model, name, error);
}

static const dal_system *find_system(const char *engine, const char *name, dal_error *error)
{
    static dal_system fluid, unchecked;
    const dal_system *system = NULL;
    dal_model *model;
    fluid = fluid_system;
    if (strcmp(name, "C0") == 0) fluid.call.field = no_forces;
    if (strcmp(name, "C") == 0 || strcmp(name, "C0") == 0) return &fluid;
    if (strcmp(name, "B101") == 0) return &chain_system;
    if (strcmp(engine, "callback") == 0) return strcmp(name, "A") == 0 ? &sleigh_by_hand : NULL;
    if (make_model(&model, name, error) == DAL_STATUS_OK) dal_model_system(model, &system, error);
    if (!system || strcmp(engine, "unchecked") != 0) return system;
    unchecked = *system;
    unchecked.properties &= ~(unsigned)DAL_D_RANK_CHECKED;
    return &unchecked;
}

/* From the start again, unless this is the first time. */
static int work_run(void *self, double *end)
{
    contender *j = self;
    if (dal_run_set_state(j->run, 0.0, j->start, NULL)) return 1;
    if (dal_run_advance(j->run, j->steps, NULL)) return 1;
    memcpy(end, dal_run_state(j->run), (size_t)j->shown * sizeof *end);
    return 0;
}

/* A batch goes on where it was; the harness keeps what the first call shows, from lane 0. */
static int work_batch(void *self, double *end)
{
    contender *j = self;
    double state[BENCH_MAX_SIZE];
    if (dal_batch_advance(j->batch, j->steps)) return 1;
    dal_batch_state(j->batch, 0, state);
    memcpy(end, state, (size_t)j->shown * sizeof *end);
    return 0;
}

/* Makes the system of this name. */
static int work_make(void *name, double *end)
{
    const dal_system *system = NULL;
    dal_model *model = NULL;
    if (make_model(&model, name, NULL) == DAL_STATUS_OK) dal_model_system(model, &system, NULL);
    end[0] = system ? system->n : 0;
    dal_model_free(model);
    return !system;
}

typedef struct steered {
    dal_model *model;
    dal_run_spec spec;
} steered;

/* Finds the cheapest motion, within D = 0, from rest at 0 to rest elsewhere. */
static int work_steer(void *self, double *end)
{
    const steered *j = self;
    const double place[] = {1.0, 0.5, 0.7};
    dal_setting target[3];
    dal_steer_settings settings = dal_steer_settings_default();
    dal_steering *found = NULL;
    for (int i = 0; i < 3; i++) target[i] = (dal_setting){j->spec.system->coordinate[i], place[i]};
    settings.target = target;
    settings.targets = 3;
    settings.rest = true;
    if (dal_steer_create(&found, j->model, &j->spec, 100 * BENCH_H_STEP, &settings, NULL, NULL))
        return 1;
    const int failed = found->extremal[0].status != DAL_STATUS_OK;
    end[0] = found->extremal[0].S;
    dal_steer_free(found);
    return failed;
}

static int make_steered(steered *j, char **argv, dal_error *error)
{
    j->spec.options = dal_options_default();
    j->spec.options.step = BENCH_H_STEP;
    return make_model(&j->model, argv[4], error) ||
           dal_model_set_effort(j->model, DAL_EFFORT_CONSTRAINT, error) ||
           dal_model_system(j->model, &j->spec.system, error) || j->spec.system->n != 3 ||
           dal_options_set(&j->spec.options, "space", argv[3], error) ||
           dal_method_parse(&j->spec.method, argv[2], error);
}

/* Lanes have states of their own, as in gen.c. */
static int make_batch(contender *j, int lanes, dal_error *error)
{
    const int last = j->spec.system->n - 1;
    char name[32];
    snprintf(name, sizeof name, "%.30s'", j->spec.system->coordinate[last]);
    if (dal_batch_create(&j->batch, &j->spec, lanes, 0, error)) return 1;
    for (int i = 0; i < lanes; i++) {
        const dal_setting start = {name, j->start[j->shown - 1] + 1e-2 * i};
        if (dal_batch_start(j->batch, i, NULL, 0, &start, 1, error)) return 1;
    }
    return 0;
}

/* Prints the bytes that a run has allocated, and n. */
static int measure_memory(char **argv, dal_error *error)
{
    dal_run_spec spec = {.options = dal_options_default()};
    dal_run *run = NULL;
    spec.system = find_system(argv[1], argv[4], error);
    if (!spec.system || dal_options_set(&spec.options, "space", argv[3], error) ||
        dal_method_parse(&spec.method, argv[2], error))
        return 1;
    struct mallinfo2 before = mallinfo2(), after;
    if (dal_run_create(&run, &spec, error)) return 1;
    after = mallinfo2();
    printf("%.5g %d\n",
           (double)(after.uordblks + after.hblkhd) - (double)(before.uordblks + before.hblkhd),
           spec.system->n);
    dal_run_free(run);
    return 0;
}

static int fail(const dal_error *error)
{
    fprintf(stderr, "dal: %s\n", error->message);
    return 1;
}

static double step_of(const char *system)
{
    if (strcmp(system, "rods") == 0) return RODS_STEP;
    return system[0] == 'C' ? FLUID_STEP : BENCH_H_STEP;
}

static int make(contender *j, char **argv, dal_error *error)
{
    dal_options *o = &j->spec.options;
    j->spec.system = find_system(argv[1], argv[4], error);
    if (!j->spec.system) return 1;
    *o = dal_options_default();
    o->step = step_of(argv[4]);
    j->steps = argv[4][0] == 'C' ? 20 : j->spec.system->n > 3 ? 200 : 1000;
    j->shown = 2 * j->spec.system->n;
    if (dal_options_set(o, "space", argv[3], error)) return 1;
    if (dal_method_parse(&j->spec.method, argv[2], error)) return 1;
    if (dal_run_create(&j->run, &j->spec, error)) return 1;
    memcpy(j->start, dal_run_state(j->run), (size_t)dal_run_dimension(j->run) * sizeof *j->start);
    const dal_native_options native = {.cache = CACHE, .patience = MAX_COMPILE_SECONDS};
    if (strcmp(argv[1], "native") == 0)
        return dal_run_native(j->run, &native, error) != DAL_STATUS_OK;
    if (strncmp(argv[1], "batch", 5) == 0) return make_batch(j, atoi(argv[1] + 5), error);
    if (strncmp(argv[1], "compiled", 8) != 0) return 0;
    return make_batch(j, atoi(argv[1] + 8), error) || dal_batch_native(j->batch, &native, error);
}

int main(int argc, char **argv)
{
    static contender j;
    dal_error error = {0};
    if (argc != 5) return bench_unknown(argc, argv);
    if (strcmp(argv[1], "made") == 0)
        return bench_measure(&(bench_contender){1.0, 1, work_make, argv[4]});
    if (strcmp(argv[1], "steer") == 0) {
        static steered found;
        if (make_steered(&found, argv, &error)) return fail(&error);
        return bench_measure(&(bench_contender){1.0, 1, work_steer, &found});
    }
    if (strcmp(argv[1], "memory") == 0) return measure_memory(argv, &error) ? fail(&error) : 0;
    if (make(&j, argv, &error)) return fail(&error);
    const int lanes = j.batch ? dal_batch_count(j.batch) : 1;
    const bench_contender measured = {(double)j.steps * lanes, j.shown,
                                      j.batch ? work_batch : work_run, &j};
    return bench_measure(&measured);
}
