/* test_parameter_bits.c - parameters changed between steps: the same bits interpreted, compiled,
 * generated and in lanes. */
#include "compiler.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "model/programs.h"
#include "run/run.h"
#include <CUnit/CUnit.h>
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char driven[] = "coordinates: [x, y, phi]\n"
                             "parameters: {m: 1, I: 0.5, k: 2, u: 0.1}\n"
                             "lagrangian: m/2*(x'^2 + y'^2) + I/2*phi'^2 - k^2/2*x^2\n"
                             "forces: {phi: u*cos(t)/(m + sin(k))}\n"
                             "constraints: [x'*sin(phi) - y'*cos(phi)]\n"
                             "start: {x: 0.3, x': 1, phi': 0.5}\n";
enum { STEPS = 100, LANES = 8 };

/* What lane i does, i steps later. */
static const struct {
    int step;
    const char *name;
    double value;
} changes[] = {{30, "k", 3.5}, {31, "u", -0.4}, {60, "m", 2.0}, {60, "k", 1.0}};
enum { CHANGES = sizeof changes / sizeof *changes };

static dal_setting start_of(int lane) { return (dal_setting){"x", 0.3 + 0.01 * lane}; }

static dal_run *run_of(dal_run_spec spec, int lane)
{
    const dal_setting start = start_of(lane);
    spec.start = &start;
    spec.start_count = 1;
    return fixture_run(&spec);
}

static void drive_run(dal_run *run, int lane)
{
    for (int i = 0; i < CHANGES; i++) {
        const long long left = changes[i].step + lane - dal_run_steps(run);
        CU_ASSERT_EQUAL(dal_run_advance(run, left, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_set_parameter(run, changes[i].name, changes[i].value, NULL),
                        DAL_STATUS_OK);
    }
    CU_ASSERT_EQUAL(dal_run_advance(run, STEPS - dal_run_steps(run), NULL), DAL_STATUS_OK);
}

static void drive_batch(dal_batch *batch)
{
    for (int step = 0; step < STEPS; step++) {
        for (int i = 0; i < CHANGES * LANES; i++)
            if (changes[i % CHANGES].step + i / CHANGES == step)
                CU_ASSERT_EQUAL(dal_batch_set_parameter(batch, i / CHANGES,
                                                        changes[i % CHANGES].name,
                                                        changes[i % CHANGES].value, NULL),
                                DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_advance(batch, 1), DAL_STATUS_OK);
    }
}

static void same_batch(const dal_run_spec *spec, int width, bool native, dal_run *const *run)
{
    double state[32];
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, spec, LANES, width, NULL), DAL_STATUS_OK);
    for (int lane = 0; lane < LANES; lane++) {
        const dal_setting start = start_of(lane);
        CU_ASSERT_EQUAL(dal_batch_start(batch, lane, NULL, 0, &start, 1, NULL), DAL_STATUS_OK);
    }
    if (native) CU_ASSERT_EQUAL(dal_batch_native(batch, &compiler_options, NULL), DAL_STATUS_OK);
    drive_batch(batch);
    for (int lane = 0; lane < LANES; lane++) {
        dal_batch_state(batch, lane, state);
        CU_ASSERT_EQUAL(memcmp(state, dal_run_state(run[lane]),
                               (size_t)dal_run_dimension(run[lane]) * sizeof *state),
                        0);
    }
    dal_batch_free(batch);
}

static void same_native(const dal_run_spec *spec, const dal_run *run)
{
    dal_run *native = run_of(*spec, 0);
    size_t m, n;
    CU_ASSERT_EQUAL(dal_run_native(native, &compiler_options, NULL), DAL_STATUS_OK);
    drive_run(native, 0);
    const double *x = dal_run_save(native, &m), *y = dal_run_save(run, &n);
    CU_ASSERT_EQUAL_FATAL(m, n);
    CU_ASSERT_EQUAL(memcmp(x, y, n * sizeof *x), 0);
    dal_run_free(native);
}

/* A generated file as a shared object, followed by its state. */
typedef struct object {
    int lanes;
    void *handle;
    int (*start)(void *state, const void *parameters);
    void (*set)(void *state, int lane, const void *parameters);
    int (*advance)(void *state, double h, long long count);
    void (*observe)(const void *state, double *out);
    double *y; /* [persistent*lanes], then parameters */
} object;

static void *find(void *handle, const char *name)
{
    void *found = dlsym(handle, name);
    CU_ASSERT_PTR_NOT_NULL_FATAL(found);
    return found;
}

static object load(const dal_run_spec *spec, const dal_run *run, int lanes)
{
    object o = {.lanes = lanes};
    char source[64], path[64], command[256], *text = NULL;
    snprintf(source, sizeof source, "%s/g.c", compiler_folder);
    snprintf(path, sizeof path, "%s/g%d.so", compiler_folder, lanes);
    snprintf(command, sizeof command,
             "cc -std=c11 -O0 -Wall -Wextra -Wno-psabi -Werror -shared -fPIC -o %s %s -lm", path,
             source);
    const dal_generate_options options = {.lanes = lanes, .prefix = "g"};
    CU_ASSERT_EQUAL_FATAL(dal_generate(spec, &options, &text, NULL), DAL_STATUS_OK);
    FILE *file = fopen(source, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    fputs(text, file);
    fclose(file);
    free(text);
    CU_ASSERT_EQUAL_FATAL(system(command), 0);
    o.handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    CU_ASSERT_PTR_NOT_NULL_FATAL(o.handle);
    unlink(path);
    void *functions[] = {find(o.handle, "g_start"), find(o.handle, "g_set"),
                         find(o.handle, "g_advance"), find(o.handle, "g_observe")};
    memcpy(&o.start, &functions[0], sizeof o.start);
    memcpy(&o.set, &functions[1], sizeof o.set);
    memcpy(&o.advance, &functions[2], sizeof o.advance);
    memcpy(&o.observe, &functions[3], sizeof o.observe);
    const size_t work = dal__programs_of(spec->system)->tapes->first_input;
    o.y = calloc((run->layout.persistent + work + 2) * (size_t)lanes, sizeof *o.y);
    CU_ASSERT_EQUAL(o.start(o.y, NULL), 0);
    return o;
}

static void unload(object *o)
{
    dlclose(o->handle);
    free(o->y);
}

/* Sets one of the parameters that the file has for a lane. */
static void set_generated(object *o, const dal_run *run, int lane, const char *name, double value)
{
    const dal_system *system = run->layout.system;
    const double *work = o->y + run->layout.persistent * (size_t)o->lanes;
    double parameters[8];
    for (int i = 0; i < system->parameters; i++)
        parameters[i] = strcmp(system->parameter[i], name) == 0 ? value : work[i * o->lanes + lane];
    o->set(o->y, lane, parameters);
}

static void drive_generated(object *o, const dal_run *run, double h)
{
    for (int step = 0; step < STEPS; step++) {
        for (int i = 0; i < CHANGES * o->lanes; i++)
            if (changes[i % CHANGES].step + i / CHANGES == step)
                set_generated(o, run, i / CHANGES, changes[i % CHANGES].name,
                              changes[i % CHANGES].value);
        CU_ASSERT_EQUAL(o->advance(o->y, h, 1), 0);
    }
}

/* Lanes that are stepped together share the count of evaluations. */
static void same_generated(const dal_run_spec *spec, int lanes, dal_run *const *run)
{
    const dal__layout *k = &run[0]->layout;
    object o = load(spec, run[0], lanes);
    for (int lane = 0; lane < lanes; lane++) o.y[lane] = start_of(lane).value;
    drive_generated(&o, run[0], spec->options.step);
    for (int lane = 0; lane < lanes; lane++)
        for (size_t i = 0; i < dal__saved_count(k); i++)
            CU_ASSERT(o.y[i * (size_t)lanes + (size_t)lane] == run[lane]->persistent[i] ||
                      (lanes > 1 && i == dal__at(k, DAL__EVALUATIONS)));
    unload(&o);
}

static void every_way(const char *method, dal_space space, bool compiled)
{
    const dal_run_spec spec = fixture_spec(fixture_system(driven), method, space, 0.02);
    dal_run *run[LANES];
    for (int lane = 0; lane < LANES; lane++) {
        run[lane] = run_of(spec, lane);
        drive_run(run[lane], lane);
    }
    same_batch(&spec, 1, false, run);
    same_batch(&spec, 4, false, run);
    same_batch(&spec, 8, false, run);
    if (compiled) {
        same_batch(&spec, 0, true, run);
        same_native(&spec, run[0]);
        same_generated(&spec, 1, run);
        same_generated(&spec, LANES, run);
    }
    for (int lane = 0; lane < LANES; lane++) dal_run_free(run[lane]);
}

static void test_bits(void)
{
    every_way("rk4", DAL_LIFTED, compiler_works);
    every_way("gauss4+project", DAL_PHYSICAL, compiler_works);
    every_way("gauss6", DAL_LIFTED, false);
    every_way("implicit-midpoint+symmetric-project", DAL_PHYSICAL, false);
    every_way("dla", DAL_PHYSICAL, false);
}

/* ---- the observable error ---- */

static const char oscillator[] = "coordinates: [x]\nparameters: {k: 4}\n"
                                 "lagrangian: x'^2/2 - k/2*x^2\nstart: {x: 1}\n"
                                 "exact: {x: cos(sqrt(k)*t)}\n";

/* NaN in the changed lane alone. */
static void test_generated_error(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_PHYSICAL, 0.01);
    dal_run *run = fixture_run(&spec);
    double seen[2 * 2];
    if (compiler_works) {
        object o = load(&spec, run, 2);
        o.advance(o.y, 0.01, 10);
        set_generated(&o, run, 1, "k", 4.0);
        o.advance(o.y, 0.01, 10);
        o.observe(o.y, seen);
        CU_ASSERT(seen[2] < 1e-9 && isnan(seen[3]));
        CU_ASSERT(seen[0] == seen[1]);
        CU_ASSERT_EQUAL(o.start(o.y, NULL), 0);
        o.observe(o.y, seen);
        CU_ASSERT(seen[2] == 0.0 && seen[3] == 0.0);
        unload(&o);
    }
    dal_run_free(run);
}

void suite_parameter_bits(void);
void suite_parameter_bits(void)
{
    CU_pSuite suite = CU_add_suite("parameter bits", compiler_set_up, compiler_tear_down);
    CU_add_test(suite, "the same bits in every way", test_bits);
    CU_add_test(suite, "no exact solution in a generated file", test_generated_error);
}
