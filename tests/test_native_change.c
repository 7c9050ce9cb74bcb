/* test_native_change.c - compiled code that is made while runs and batches are interpreted: they
 * change over to it between any two steps without a trace in their bits. */
#include "allocation.h"
#include "compiler.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "folder.h"
#include <CUnit/CUnit.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Tests run in a directory of their own. */
static char place[] = "/tmp/dal-change-XXXXXX";
static int before; /* the directory that was */
static const dal_native_options options = {.cache = "cache", .patience = 3600};
static const dal_native_options gated = {.cache = "gated", .compiler = "./fake", .patience = 600};

static int set_up(void)
{
    before = open(".", O_RDONLY | O_DIRECTORY);
    return before < 0 || !mkdtemp(place) || chdir(place) != 0;
}

static int tear_down(void)
{
    folder_remove("cache");
    folder_remove("gated");
    const int back = fchdir(before);
    folder_remove(place);
    return close(before) || back;
}

static void pause_shortly(void)
{
    const struct timespec shortly = {0, 2000000};
    nanosleep(&shortly, NULL);
}

/* One that waits until a file "open" is there. */
static void gated_compiler(void)
{
    unlink("open");
    compiler_fake("until [ -e open ]; do sleep 0.01; done; exec cc \"$@\"");
}

static void open_gate(void) { close(open("open", O_WRONLY | O_CREAT, 0600)); }

static dal_native_state wait_for(dal_native *native, dal_error *error)
{
    dal_native_state state;
    while ((state = dal_native_poll(native, error)) == DAL_NATIVE_PENDING) pause_shortly();
    return state;
}

typedef dal_status native_begin(dal_native **native, const dal_run *run,
                                const dal_native_options *options, dal_error *error);

static dal_native *ready(native_begin *begin, const dal_run *run)
{
    dal_native *native = NULL;
    CU_ASSERT_EQUAL_FATAL(begin(&native, run, &options, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(wait_for(native, NULL), DAL_NATIVE_READY);
    return native;
}

static const char falling[] = "coordinates: [x, y]\nparameters: {s: 0}\n"
                              "lagrangian: (x'^2 + y'^2)/2 - y^2/2\n"
                              "forces: {x: -s*sqrt(x)}\nstart: {x: 1, y: 1}\n";

static dal_run *falling_run(const char *method, double step)
{
    const dal_run_spec spec = fixture_spec(fixture_system(falling), method, DAL_PHYSICAL, step);
    return fixture_run(&spec);
}

static void same_memory(const dal_run *a, const dal_run *b)
{
    size_t m, n;
    const double *x = dal_run_save(a, &m), *y = dal_run_save(b, &n);
    CU_ASSERT_EQUAL_FATAL(m, n);
    CU_ASSERT_EQUAL(memcmp(x, y, n * sizeof *x), 0);
}

/* ---- runs ---- */

/* The compiler cannot end before the run has taken steps; another run of another step size uses the
 * same code. */
static void test_beside(void)
{
    dal_run *tape = falling_run("gauss4", 0.01), *run = falling_run("gauss4", 0.01);
    dal_run *small = falling_run("gauss4", 0.001), *other = falling_run("gauss6", 0.01);
    dal_native *native = NULL;
    dal_error error = {0};
    gated_compiler();
    CU_ASSERT_EQUAL_FATAL(dal_native_begin(&native, run, &gated, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 77, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_native_poll(native, &error), DAL_NATIVE_PENDING);
    CU_ASSERT_EQUAL(dal_run_use_native(run, native, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message, "the compiled code is not ready");
    open_gate();
    CU_ASSERT_EQUAL(wait_for(native, &error), DAL_NATIVE_READY);
    CU_ASSERT_FALSE(dal_run_is_native(run));
    CU_ASSERT_EQUAL(dal_run_use_native(run, native, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_use_native(run, native, &error), DAL_STATUS_OK);
    CU_ASSERT_TRUE(dal_run_is_native(run));
    CU_ASSERT_EQUAL(dal_run_advance(run, 123, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(tape, 200, &error), DAL_STATUS_OK);
    same_memory(run, tape);
    CU_ASSERT_EQUAL(dal_run_use_native(small, native, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_use_native(other, native, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message, "the compiled code is for other steps");
    CU_ASSERT_FALSE(dal_run_is_native(other));
    CU_ASSERT_EQUAL(folder_files("gated"), 1);
    dal_run_free(tape);
    dal_run_free(run);
    dal_run_free(small);
    dal_run_free(other);
    dal_native_free(native);
}

static void test_fits(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(falling), "gauss4", DAL_LIFTED, 0.01);
    dal_run *run = fixture_run(&spec);
    dal_native *steps = ready(dal_native_begin, run);
    dal_native *observables = ready(dal_native_begin_observables, run);
    CU_ASSERT(dal_native_fits(steps, run) && dal_native_fits(observables, run));
    const struct {
        const char *method;
        dal_space space;
        double step, solver_tolerance;
        bool steps, observables;
    } other[] = {{"gauss4", DAL_LIFTED, 0.02, 0.0, true, true},
                 {"gauss6", DAL_LIFTED, 0.01, 0.0, false, true},
                 {"gauss4+project", DAL_LIFTED, 0.01, 0.0, false, true},
                 {"gauss4", DAL_PHYSICAL, 0.01, 0.0, false, false},
                 {"gauss4", DAL_LIFTED, 0.01, 1e-9, false, true}};
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        spec = fixture_spec(spec.system, other[i].method, other[i].space, other[i].step);
        spec.options.solver_tolerance = other[i].solver_tolerance;
        dal_run *against = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_native_fits(steps, against), other[i].steps);
        CU_ASSERT_EQUAL(dal_native_fits(observables, against), other[i].observables);
        dal_run_free(against);
    }
    dal_run_free(run);
    dal_native_free(steps);
    dal_native_free(observables);
}

/* ---- while a run is sampled ---- */

enum { STEPS = 2500, MAX_OBSERVABLES = 16, FROM_POLL = 0, FROM_VALUES, FROM_ROW, PLACES };

/* What is recorded of a run, and after which call of which kind it changes over. */
typedef struct recording {
    dal_native *steps, *observables;
    int at, calls, steps_call, observables_call; /* never: -1 */
    dal_statistics statistics[MAX_OBSERVABLES];
    int samples, rows;
    double x[STEPS + 1][MAX_OBSERVABLES], row[64][MAX_OBSERVABLES];
} recording;

static void change_over(recording *r, dal_run *run, int at)
{
    if (r->at != at) return;
    const int call = r->calls++;
    if (call == r->steps_call)
        CU_ASSERT_EQUAL(dal_run_use_native(run, r->steps, NULL), DAL_STATUS_OK);
    if (call == r->observables_call)
        CU_ASSERT_EQUAL(dal_run_use_native(run, r->observables, NULL), DAL_STATUS_OK);
}

static dal_status record_poll(void *user, dal_run *run)
{
    change_over(user, run, FROM_POLL);
    return DAL_STATUS_OK;
}

static dal_status record_values(void *user, dal_run *run, int count, const double *t,
                                const double *values, size_t stride)
{
    recording *r = user;
    const int observables = dal_run_observables(run);
    dal_statistics_add_many(r->statistics, observables, count, t, values, stride);
    for (int k = 0; k < count; k++, r->samples++)
        for (int i = 0; i < observables; i++)
            r->x[r->samples][i] = values[(size_t)i * stride + (size_t)k];
    change_over(r, run, FROM_VALUES);
    return DAL_STATUS_OK;
}

static dal_status record_row(void *user, dal_run *run, long long row, double t)
{
    recording *r = user;
    (void)row, (void)t;
    CU_ASSERT_EQUAL(dal_run_observe(run, r->row[r->rows++]), DAL_STATUS_OK);
    change_over(r, run, FROM_ROW);
    return DAL_STATUS_OK;
}

static void record(recording *r, const dal_run_spec *spec)
{
    dal_run *run = fixture_run(spec);
    const dal_observer observer = {.user = r,
                                   .sample = record_row,
                                   .poll = record_poll,
                                   .values = record_values,
                                   .every = 1,
                                   .polling = 1};
    CU_ASSERT_FATAL(dal_run_observables(run) <= MAX_OBSERVABLES);
    dal_statistics_start(r->statistics, dal_run_observables(run));
    CU_ASSERT_EQUAL(dal_run_sample(run, STEPS * spec->options.step, 37, 0, &observer, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_is_native(run), r->steps_call >= 0);
    dal_run_free(run);
}

/* Rows lie between steps; steps and observables change over at calls of their own. */
static void test_sampled(void)
{
    static recording plain, changed;
    static const int calls[][2] = {{0, 0}, {0, -1}, {-1, 0}, {1, 0}, {3, 7}, {11, 2}, {30, 20}};
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "gauss4", DAL_LIFTED, 0.01);
    dal_run *run = fixture_run(&spec);
    dal_native *steps = ready(dal_native_begin, run);
    dal_native *observables = ready(dal_native_begin_observables, run);
    dal_run_free(run);
    plain = (recording){.at = PLACES, .steps_call = -1};
    record(&plain, &spec);
    for (int i = 0; i < PLACES * (int)(sizeof calls / sizeof *calls); i++) {
        changed = (recording){.steps = steps,
                              .observables = observables,
                              .at = i % PLACES,
                              .steps_call = calls[i / PLACES][0],
                              .observables_call = calls[i / PLACES][1]};
        record(&changed, &spec);
        CU_ASSERT_EQUAL(changed.samples, STEPS + 1);
        CU_ASSERT_EQUAL(memcmp(changed.x, plain.x, sizeof plain.x), 0);
        CU_ASSERT_EQUAL(memcmp(changed.row, plain.row, sizeof plain.row), 0);
        CU_ASSERT_EQUAL(memcmp(changed.statistics, plain.statistics, sizeof plain.statistics), 0);
    }
    dal_native_free(steps);
    dal_native_free(observables);
}

/* ---- batches ---- */

enum { LANES = 5 };

static dal_batch *lanes_of(const dal_run_spec *spec)
{
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, spec, LANES, 0, NULL), DAL_STATUS_OK);
    for (int i = 0; i < LANES; i++) {
        const dal_setting s = {"s", i == 0 ? 40.0 : 0.01 * i};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &s, 1, NULL, 0, NULL), DAL_STATUS_OK);
    }
    return batch;
}

static void test_batches(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(falling), "rk4", DAL_PHYSICAL, 0.001);
    dal_batch *tape = lanes_of(&spec), *batch = lanes_of(&spec);
    spec = fixture_spec(spec.system, "stormer-verlet", DAL_PHYSICAL, 0.001);
    dal_batch *other = lanes_of(&spec);
    dal_native *native = NULL;
    dal_error error = {0};
    gated_compiler();
    CU_ASSERT_EQUAL_FATAL(dal_native_begin_batch(&native, batch, &gated, &error), DAL_STATUS_OK);
    dal_batch_advance(batch, 700); /* a lane has failed */
    CU_ASSERT_EQUAL(dal_native_poll(native, &error), DAL_NATIVE_PENDING);
    CU_ASSERT_EQUAL(dal_batch_use_native(batch, native, &error), DAL_STATUS_ARGUMENT);
    open_gate();
    CU_ASSERT_EQUAL(wait_for(native, &error), DAL_NATIVE_READY);
    CU_ASSERT_EQUAL(dal_batch_use_native(other, native, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_FALSE(dal_batch_is_native(other));
    CU_ASSERT_EQUAL(dal_batch_use_native(batch, native, &error), DAL_STATUS_OK);
    CU_ASSERT_TRUE(dal_batch_is_native(batch));
    dal_batch_advance(batch, 800);
    dal_batch_advance(tape, 1500);
    for (int lane = 0; lane < LANES; lane++) {
        double x[4], y[4];
        dal_batch_state(batch, lane, x);
        dal_batch_state(tape, lane, y);
        CU_ASSERT_EQUAL(memcmp(x, y, sizeof x), 0);
        CU_ASSERT_EQUAL(dal_batch_status(batch, lane, NULL), dal_batch_status(tape, lane, NULL));
    }
    dal_batch_free(tape);
    dal_batch_free(batch);
    dal_batch_free(other);
    dal_native_free(native);
}

/* ---- what goes wrong ---- */

static void fails(const char *script, dal_status status, const char *message)
{
    dal_run *run = falling_run("rk4", 0.01);
    dal_native *native = NULL;
    dal_error error = {0};
    compiler_fake(script);
    const dal_native_options fake = {.cache = "gated", .compiler = "./fake", .patience = 1};
    const int kept = (mkdir("gated", 0700), folder_files("gated"));
    CU_ASSERT_EQUAL_FATAL(dal_native_begin(&native, run, &fake, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(wait_for(native, &error), DAL_NATIVE_FAILED);
    CU_ASSERT_EQUAL(error.status, status);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, message));
    CU_ASSERT_EQUAL(dal_native_poll(native, NULL), DAL_NATIVE_FAILED);
    CU_ASSERT_EQUAL(dal_run_use_native(run, native, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(folder_files("gated"), kept);
    dal_native_free(native);
    dal_run_free(run);
}

static void test_failures(void)
{
    dal_run *run = falling_run("rk4", 0.01);
    dal_native *native = (dal_native *)(void *)run;
    dal_error error = {0};
    const dal_native_options none = {.cache = "gated", .compiler = "./none"};
    fails("exit 1", DAL_STATUS_UNSUPPORTED, "the compiler './fake' failed");
    fails("sleep 1000", DAL_STATUS_UNSUPPORTED, "the compiler './fake' was ended after 1 seconds");
    fails("while [ $# -gt 2 ]; do shift; done; echo 'no object' >\"$1\"", DAL_STATUS_IO,
          "cannot be loaded");
    /* posix_spawn may say at once that there is no such file, or leave it to the child's status */
    if (dal_native_begin(&native, run, &none, &error) == DAL_STATUS_OK) {
        CU_ASSERT_EQUAL(wait_for(native, &error), DAL_NATIVE_FAILED);
    } else {
        CU_ASSERT_PTR_NULL(native);
    }
    CU_ASSERT_EQUAL(error.status, DAL_STATUS_UNSUPPORTED);
    dal_native_free(native);
    dal_run_free(run);
}

/* Freed, it ends the compiler with what that started, which holds a FIFO open, and leaves no file,
 * not even a temporary one of the compiler. */
static void test_ended(void)
{
    dal_run *run = falling_run("rk4", 0.02);
    dal_native *native = NULL;
    char byte, made[512] = "";
    const int kept = (mkdir("gated", 0700), folder_files("gated"));
    CU_ASSERT_EQUAL(mkfifo("held", 0600), 0);
    compiler_fake("mktemp >made; sleep 60 >held & wait");
    CU_ASSERT_EQUAL_FATAL(dal_native_begin(&native, run, &gated, NULL), DAL_STATUS_OK);
    const int held = open("held", O_RDONLY);
    CU_ASSERT_EQUAL(folder_files("gated"), kept + 1);
    FILE *const file = fopen("made", "r");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    CU_ASSERT_EQUAL(fscanf(file, "%511s", made), 1);
    fclose(file);
    CU_ASSERT_EQUAL(access(made, F_OK), 0);
    const time_t begin = time(NULL);
    dal_native_free(native);
    CU_ASSERT_NOT_EQUAL(access(made, F_OK), 0);
    CU_ASSERT_EQUAL(read(held, &byte, 1), 0);
    CU_ASSERT(difftime(time(NULL), begin) < 50.0);
    CU_ASSERT_EQUAL(folder_files("gated"), kept);
    close(held);
    unlink("held");
    unlink("made");
    dal_run_free(run);
}

/* The compiler fails where its priority is not lower by three at some time. */
static void test_priority(void)
{
    dal_run *run = falling_run("rk4", 0.02);
    const int lower = getpriority(PRIO_PROCESS, 0) + 3;
    const dal_native_options fake = {
        .cache = "gated", .compiler = "./fake", .nice = 3, .patience = 600};
    char script[200];
    snprintf(script, sizeof script,
             "for i in 1 2 3 4 5 6 7 8 9; do [ $(nice) = %d ] && exec cc \"$@\"; sleep 0.5; done; "
             "exit 1",
             lower < 19 ? lower : 19);
    compiler_fake(script);
    dal_native *native = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_native_begin(&native, run, &fake, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(wait_for(native, NULL), DAL_NATIVE_READY);
    dal_native_free(native);
    dal_run_free(run);
}

/* Whatever cannot be allocated, the run stays as it is. */
static void test_memory(void)
{
    dal_run *run = falling_run("rk4", 0.01);
    dal_native_free(ready(dal_native_begin_observables, run));
    for (long n = 0;; n++) {
        dal_native *native = NULL;
        allocation_fail_after(n);
        dal_status status = dal_native_begin_observables(&native, run, &options, NULL);
        CU_ASSERT_EQUAL(status == DAL_STATUS_OK, native != NULL);
        if (native && dal_native_poll(native, NULL) == DAL_NATIVE_READY)
            status = dal_run_use_native(run, native, NULL);
        const int failed = allocation_failed();
        allocation_fail_after(-1);
        if (!failed) CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
        if (failed) dal_native_free(native);
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        if (failed) continue;
        dal_run_free(run);
        dal_native_free(native);
        return;
    }
}

void suite_native_change(void);
void suite_native_change(void)
{
    CU_pSuite suite = CU_add_suite("native_change", set_up, tear_down);
    if (!compiler_there()) return;
    CU_add_test(suite, "runs: compiled beside their steps", test_beside);
    CU_add_test(suite, "which runs code is for", test_fits);
    CU_add_test(suite, "runs: changed over while sampled", test_sampled);
    CU_add_test(suite, "batches: compiled beside their steps", test_batches);
    CU_add_test(suite, "compilers that fail", test_failures);
    CU_add_test(suite, "a compiler is ended", test_ended);
    CU_add_test(suite, "a lower priority", test_priority);
    CU_add_test(suite, "memory runs out", test_memory);
}
