/* test_generate_native.c - native mode: runs and batches stepped by compiled code have the bits of
 * their tapes, and whatever goes wrong with compiler or cache leaves them stepping by the tape. */
#include "allocation.h"
#include "compiler.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "folder.h"
#include <CUnit/CUnit.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Tests run in a directory of their own; paths in it need not be absolute. */
static char place[] = "/tmp/dal-native-XXXXXX";
static int before; /* the directory that was */
static bool compiles;
static const dal_native_options options = {.cache = "cache", .patience = 3600};

static int set_up(void)
{
    before = open(".", O_RDONLY | O_DIRECTORY);
    compiles = compiler_there();
    return before < 0 || !mkdtemp(place) || chdir(place) != 0;
}

static int tear_down(void)
{
    folder_remove("cache");
    const int back = fchdir(before);
    folder_remove(place);
    return close(before) || back;
}

/* ---- runs ---- */

static void same_memory(const dal_run *a, const dal_run *b)
{
    size_t m, n;
    const double *x = dal_run_save(a, &m), *y = dal_run_save(b, &n);
    CU_ASSERT_EQUAL_FATAL(m, n);
    CU_ASSERT_EQUAL(memcmp(x, y, n * sizeof *x), 0);
}

/* A run that changes over in the middle, one that is loaded from it, and one that never does. */
static void same_run(const dal_run_spec *of)
{
    dal_run *const tape = fixture_run(of), *const native = fixture_run(of);
    dal_run *const loaded = fixture_run(of);
    dal_error error;
    size_t count;
    CU_ASSERT_EQUAL(dal_run_advance(tape, 300, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(native, 100, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_native(native, &options, &error),
                    compiles ? DAL_STATUS_OK : DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_run_is_native(native), compiles);
    CU_ASSERT_EQUAL(dal_run_advance(native, 135, &error), DAL_STATUS_OK);
    const double *memory = dal_run_save(native, &count);
    CU_ASSERT_EQUAL(dal_run_restore(loaded, memory, count, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(native, 65, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(loaded, 65, &error), DAL_STATUS_OK);
    same_memory(native, tape);
    same_memory(loaded, tape);
    dal_run_free(tape);
    dal_run_free(native);
    dal_run_free(loaded);
}

/* The same steps by the tape and compiled, without optimisation, which takes less time. */
static void same_steps(const dal_system *system, const char *method)
{
    const dal_native_options plain = {.cache = "cache", .compiler = "./fake", .patience = 3600};
    dal_run_spec spec = fixture_spec(system, method, DAL_LIFTED, 0.01);
    spec.options.solver = DAL_NEWTON;
    dal_run *const tape = fixture_run(&spec), *const native = fixture_run(&spec);
    compiler_fake("exec cc \"$@\" -O0");
    CU_ASSERT_EQUAL(dal_run_native(native, &plain, NULL),
                    compiles ? DAL_STATUS_OK : DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_run_advance(tape, 10, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(native, 10, NULL), DAL_STATUS_OK);
    same_memory(native, tape);
    dal_run_free(tape);
    dal_run_free(native);
}

/* Programs of tens of thousands of operations, which are many functions: terms of a force, each of
 * other frequency, which later ones read, too. */
static void test_long(void)
{
    enum { TERMS = 2000, TERM_SIZE = 32 };
    static char formula[2 * TERMS * TERM_SIZE];
    char *end = formula;
    dal_model *model = dal_model_create("long");
    const dal_system *system;
    for (int i = 0; i < TERMS; i++) end += snprintf(end, TERM_SIZE, "+ sin(%d*x)", i + 2);
    for (int i = 0; i < TERMS; i++) end += snprintf(end, TERM_SIZE, "- cos(%d*x)^2/9", i + 2);
    dal_model_add(model, DAL_SECTION_COORDINATES, NULL, "x", 0, 0, NULL);
    dal_model_add(model, DAL_SECTION_LAGRANGIAN, NULL, "x'^2/2", 0, 0, NULL);
    dal_model_add(model, DAL_SECTION_FORCES, "x", formula + 1, 0, 0, NULL);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    same_steps(system, "rk4");
    dal_model_free(model);
}

/* Most of the matrix of derivatives of F is zero. */
static void test_sparse(void)
{
    same_steps(fixture_system("sizes: {N: 12}\ncoordinates: [\"x[1..N]\"]\n"
                              "lagrangian: sum(i, 1, N, x[i]'^2)/2\n"
                              "  - sum(i, 1, N - 1, sin(x[i+1] - x[i])^2)\n"
                              "start: {\"x[i]\": {for: i = 1..N, is: cos(pi*i/N)}}\n"),
               "gauss4");
}

static void test_runs(void)
{
    const dal_setting slow = {"omega", 0.25};
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "gauss4+project", DAL_LIFTED, 0.01);
    spec.parameters = &slow;
    spec.parameter_count = 1;
    same_run(&spec);
    spec = fixture_spec(spec.system, "rk4", DAL_PHYSICAL, 0.01);
    same_run(&spec);
    /* Looser, longer and plain, where nothing of it is a default. */
    spec = fixture_spec(spec.system, "gauss4+project", DAL_LIFTED, 0.01);
    spec.options.solver_tolerance = 1e-7;
    spec.options.extra_iterations = 2;
    spec.options.sums = DAL_SUMS_PLAIN;
    same_run(&spec);
}

/* A tolerance at which series add what the rounding of 1/k took from their coefficients. */
static void test_fine_series(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("chaotic-oscillators"), "taylor", DAL_PHYSICAL, 0.25);
    spec.options.tolerance = 1e-15;
    same_run(&spec);
}

/* Friction with which auto tries Newton's method and takes it. */
static void test_solver(void)
{
    const dal_setting strong = {"k", 30.0};
    dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh-friction"),
                                     "implicit-midpoint", DAL_PHYSICAL, 0.02);
    spec.parameters = &strong;
    spec.parameter_count = 1;
    same_run(&spec);
}

/* ---- batches ---- */

enum { MAX_LANES = 13, STATE = 32 };

/* Falls into the ground at x = 0, where its force ends to be a number; lane 0 soon, lane 8 later.
 */
static const char falling[] = "coordinates: [x, y]\nparameters: {s: 0}\n"
                              "lagrangian: (x'^2 + y'^2)/2 - y^2/2\n"
                              "forces: {x: -s*sqrt(x)}\nstart: {x: 1, y: 1}\n";

static dal_batch *lanes_of(const dal_run_spec *spec, int count)
{
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, spec, count, 0, NULL), DAL_STATUS_OK);
    for (int i = 0; i < count; i++) {
        const dal_setting s = {"s", i == 0 ? 40.0 : i == 8 ? 4.0 : 0.01 * i};
        const dal_setting start = {"y'", 0.1 * i};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &s, 1, &start, 1, NULL), DAL_STATUS_OK);
    }
    return batch;
}

static void same_lane(const dal_batch *a, const dal_batch *b, int lane)
{
    double x[STATE] = {0.0}, y[STATE] = {0.0};
    dal_error why_x = {0}, why_y = {0};
    dal_batch_state(a, lane, x);
    dal_batch_state(b, lane, y);
    CU_ASSERT_EQUAL(memcmp(x, y, sizeof x), 0);
    CU_ASSERT_EQUAL(dal_batch_time(a, lane), dal_batch_time(b, lane));
    CU_ASSERT_EQUAL(dal_batch_status(a, lane, &why_x), dal_batch_status(b, lane, &why_y));
    CU_ASSERT_STRING_EQUAL(why_x.message, why_y.message);
}

/* Changes over after some of 2000 steps: at the very first, or when one lane has failed already. */
static void same_batch(const dal_run_spec *spec, int count, long long first)
{
    dal_batch *const tape = lanes_of(spec, count), *const native = lanes_of(spec, count);
    dal_error error;
    dal_batch_advance(tape, 1000);
    dal_batch_advance(native, first);
    CU_ASSERT_EQUAL(dal_batch_native(native, &options, &error),
                    compiles ? DAL_STATUS_OK : DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_batch_is_native(native), compiles);
    dal_batch_advance(native, 1000 - first);
    CU_ASSERT_EQUAL(dal_batch_advance(native, 1000), dal_batch_advance(tape, 1000));
    for (int lane = 0; lane < count; lane++) same_lane(tape, native, lane);
    CU_ASSERT_NOT_EQUAL(dal_batch_status(native, 0, NULL), DAL_STATUS_OK);
    dal_batch_free(tape);
    dal_batch_free(native);
}

static void test_batches(void)
{
    static const int counts[] = {1, 3, 4, 8, MAX_LANES};
    const dal_system *falls = fixture_system(falling);
    const dal_run_spec simple = fixture_spec(falls, "rk4", DAL_PHYSICAL, 0.001);
    const dal_run_spec lifted = fixture_spec(falls, "implicit-midpoint", DAL_LIFTED, 0.001);
    const dal_run_spec implicit = fixture_spec(falls, "gauss4", DAL_PHYSICAL, 0.001);
    for (int i = 0; i < 5; i++) same_batch(&simple, counts[i], 0);
    same_batch(&simple, MAX_LANES, 700);
    same_batch(&lifted, MAX_LANES, 700);
    same_batch(&implicit, MAX_LANES, 700);
}

/* A batch that is native already may still be given its starts, and is not compiled again. */
static void test_batch_start(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(falling), "rk4", DAL_PHYSICAL, 0.001);
    const dal_setting start = {"y", 2.0};
    dal_batch *const tape = lanes_of(&spec, 5), *const native = lanes_of(&spec, 5);
    if (compiles) CU_ASSERT_EQUAL(dal_batch_native(native, &options, NULL), DAL_STATUS_OK);
    const dal_native_options nothing = {.cache = "/nowhere/at/all"};
    if (compiles) CU_ASSERT_EQUAL(dal_batch_native(native, &nothing, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_start(tape, 4, NULL, 0, &start, 1, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_start(native, 4, NULL, 0, &start, 1, NULL), DAL_STATUS_OK);
    dal_batch_advance(tape, 100);
    dal_batch_advance(native, 100);
    for (int lane = 0; lane < 5; lane++) same_lane(tape, native, lane);
    dal_batch_free(tape);
    dal_batch_free(native);
}

/* ---- what goes wrong ---- */

/* The formulas of a system that is made by hand are not known. */
static void test_hand_made(void)
{
    const dal_system hand = {.name = "spring", .n = 1, .call.field = fixture_oscillate};
    const dal_run_spec spec = fixture_spec(&hand, "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    dal_batch *batch = NULL;
    dal_native *native;
    dal_error error[3] = {{0}};
    CU_ASSERT_EQUAL(dal_batch_create(&batch, &spec, 2, 0, NULL), DAL_STATUS_OK);
    dal_native_begin(&native, run, &options, &error[0]);
    CU_ASSERT_PTR_NULL(native);
    dal_native_begin_observables(&native, run, &options, &error[1]);
    CU_ASSERT_PTR_NULL(native);
    dal_native_begin_batch(&native, batch, &options, &error[2]);
    CU_ASSERT_PTR_NULL(native);
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_EQUAL(error[i].status, DAL_STATUS_UNSUPPORTED);
        CU_ASSERT_STRING_EQUAL(error[i].message,
                               "'spring' is not made from a model: its formulas are not known");
    }
    dal_run_free(run);
    dal_batch_free(batch);
}

/* Whatever cannot be allocated, all is left stepping by its tape. */
static void test_memory(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(falling), "rk4", DAL_PHYSICAL, 0.001);
    dal_run *run = fixture_run(&spec);
    dal_batch *tape = lanes_of(&spec, 5), *batch = lanes_of(&spec, 5);
    for (long n = 0;; n++) {
        allocation_fail_after(n);
        const dal_status one = dal_run_native(run, &options, NULL);
        const dal_status many = dal_batch_native(batch, &options, NULL);
        if (!allocation_failed()) break;
        CU_ASSERT_EQUAL(dal_run_is_native(run), one == DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_is_native(batch), many == DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_advance(batch, 10), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_advance(tape, 10), DAL_STATUS_OK);
    }
    allocation_fail_after(-1);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    for (int lane = 0; lane < 5; lane++) same_lane(tape, batch, lane);
    dal_run_free(run);
    dal_batch_free(batch);
    dal_batch_free(tape);
}

/* Whatever cannot be allocated before the compiler runs, nothing is left in the cache. */
static void test_memory_to_begin(void)
{
    const dal_native_options fake = {.cache = "begun", .compiler = "./fake", .patience = 600};
    const dal_run_spec spec = fixture_spec(fixture_system(falling), "rk4", DAL_PHYSICAL, 0.001);
    dal_run *run = fixture_run(&spec);
    allocation_trial trial = {0};
    compiler_fake("exit 1");
    CU_ASSERT_EQUAL(mkdir("begun", 0700), 0);
    while (allocation_next(&trial)) {
        dal_native *native;
        allocation_start(&trial);
        const dal_status status = dal_native_begin(&native, run, &fake, NULL);
        if (allocation_end(&trial, status)) CU_ASSERT_PTR_NULL(native);
        dal_native_free(native);
        CU_ASSERT_EQUAL(rmdir("begun"), 0);
        CU_ASSERT_EQUAL(mkdir("begun", 0700), 0);
    }
    CU_ASSERT(trial.failures > 0);
    dal_run_free(run);
    unlink("fake");
    rmdir("begun");
}

/* The same of compiled observables. */
static void test_memory_for_samples(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(falling), "rk4", DAL_PHYSICAL, 0.001);
    dal_run *run = fixture_run(&spec);
    double first, again;
    dal_error error = {0};
    int refused = 0;
    CU_ASSERT_EQUAL(dal_run_observables(run), 1);
    CU_ASSERT_EQUAL(dal_run_observe(run, &first), DAL_STATUS_OK);
    for (long n = 0;; n++) {
        allocation_fail_after(n);
        const dal_status status = dal_run_native_observables(run, &options, &error);
        if (!allocation_failed()) break;
        CU_ASSERT_NOT_EQUAL(status, DAL_STATUS_OK);
        refused += strstr(error.message, " observations") != NULL;
        CU_ASSERT_EQUAL(dal_run_observe(run, &again), DAL_STATUS_OK);
        CU_ASSERT(again == first);
    }
    allocation_fail_after(-1);
    CU_ASSERT_EQUAL(refused, compiles);
    dal_run_free(run);
}

static dal_run *new_run(const char *model)
{
    const dal_run_spec spec = fixture_spec(fixture_system(model), "rk4", DAL_PHYSICAL, 0.01);
    return fixture_run(&spec);
}

/* Such options are refused for a reason, and the run goes on. */
static void refused(const dal_native_options *with, dal_status expected, const char *reason)
{
    dal_run *run = new_run(falling);
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_run_native(run, with, &error), expected);
    if (!strstr(error.message, reason)) printf("\n  '%s' lacks '%s'\n", error.message, reason);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, reason));
    CU_ASSERT(error.line == 0 && error.column == 0);
    CU_ASSERT_FALSE(dal_run_is_native(run));
    CU_ASSERT_EQUAL(dal_run_step(run, &error), DAL_STATUS_OK);
    dal_run_free(run);
}

static void refused_cache(const char *cache, dal_status expected, const char *reason)
{
    refused(&(dal_native_options){.cache = cache}, expected, reason);
}

static void test_cache_refused(void)
{
    static char long_name[2000];
    memset(long_name, 'x', sizeof long_name - 1);
    refused(NULL, DAL_STATUS_ARGUMENT, "no directory");
    refused_cache(NULL, DAL_STATUS_ARGUMENT, "no directory");
    refused_cache("", DAL_STATUS_ARGUMENT, "no directory");
    refused_cache(long_name, DAL_STATUS_ARGUMENT, "too long");
    refused_cache("/dev/null", DAL_STATUS_IO, "'/dev/null' is not a directory of this user alone");
    refused_cache("/nowhere/at/all", DAL_STATUS_IO,
                  "cannot make the directory '/nowhere/at/all': ");
    CU_ASSERT_EQUAL(symlink("nowhere", "dangling"), 0);
    refused_cache("dangling/", DAL_STATUS_IO, "'dangling/': "); /* to be made, or examined */
    unlink("dangling");
    CU_ASSERT_EQUAL_FATAL(mkdir("open", 0700), 0);
    for (int mode = 0701; mode < 0730; mode += 007) { /* others search; the group reads; writes */
        CU_ASSERT_EQUAL(chmod("open", (mode_t)mode), 0);
        refused_cache("open", DAL_STATUS_IO, "of this user alone");
    }
    CU_ASSERT_EQUAL(chmod("open", 0700), 0);
    CU_ASSERT_EQUAL(symlink("open", "link"), 0);
    refused_cache("link", DAL_STATUS_IO, "of this user alone");
    if (chown("open", 12345, (gid_t)-1) == 0) /* only root may give a directory away */
        refused_cache("open", DAL_STATUS_IO, "of this user alone");
    CU_ASSERT_EQUAL(folder_files("open"), 0);
    unlink("link");
    folder_remove("open");
}

/* Begins to compile where a process may have none of a resource. */
static void begin_without(int resource, const char *reason)
{
    struct rlimit usual, none;
    dal_run *run = new_run(falling);
    dal_native *native;
    dal_error error = {0};
    CU_ASSERT_EQUAL_FATAL(getrlimit(resource, &usual), 0);
    none = (struct rlimit){0, usual.rlim_max};
    CU_ASSERT_EQUAL_FATAL(setrlimit(resource, &none), 0);
    const dal_status status = dal_native_begin(&native, run, &options, &error);
    CU_ASSERT_EQUAL_FATAL(setrlimit(resource, &usual), 0);
    CU_ASSERT_EQUAL(status, DAL_STATUS_IO);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, reason));
    CU_ASSERT_PTR_NULL(native);
    CU_ASSERT_EQUAL(folder_files("cache"), 0);
    dal_run_free(run);
}

/* The source of a compilation cannot be made, or not be written; nothing is left of it. */
static void test_source_refused(void)
{
    folder_remove("cache");
    void (*const handler)(int) = signal(SIGXFSZ, SIG_IGN);
    begin_without(RLIMIT_NOFILE, "cannot make the directory './cache/");
    begin_without(RLIMIT_FSIZE, "cannot write './cache/");
    signal(SIGXFSZ, handler);
}

/* Names that a compiler could take for options, or a shell for commands. */
static void test_cache_names(void)
{
    static const char *const names[] = {"-fplugin=x", "@list", "$(touch evil)", "; touch evil",
                                        "-o"};
    for (int i = 0; i < 3 && compiles; i++) {
        dal_run *run = new_run(falling);
        CU_ASSERT_EQUAL(
            dal_run_native(run, &(dal_native_options){.cache = names[i], .patience = 3600}, NULL),
            DAL_STATUS_OK);
        CU_ASSERT_EQUAL(folder_files(names[i]), 1);
        dal_run_free(run);
        folder_remove(names[i]);
    }
    CU_ASSERT_NOT_EQUAL(access("evil", F_OK), 0);
}

static void test_compilers_refused(void)
{
    const dal_native_options fake = {.cache = "cache", .compiler = "./fake", .patience = 600};
    const int kept = (mkdir("cache", 0700), folder_files("cache"));
    refused(&(dal_native_options){.cache = "cache", .compiler = "./none"}, DAL_STATUS_UNSUPPORTED,
            "no compiler './none'");
    compiler_fake("exit 1");
    refused(&fake, DAL_STATUS_UNSUPPORTED, "the compiler './fake' failed");
    compiler_fake("kill -SEGV $$");
    refused(&fake, DAL_STATUS_UNSUPPORTED, "the compiler './fake' failed");
    compiler_fake("exit 0"); /* and makes nothing */
    refused(&fake, DAL_STATUS_IO, "cannot seal");
    compiler_fake("while [ $# -gt 2 ]; do shift; done; echo 'no object' >\"$1\"");
    refused(&fake, DAL_STATUS_IO, "cannot be loaded");
    CU_ASSERT_EQUAL(folder_files("cache"), kept);
    unlink("fake");
}

/* A compiler that does not end within ten minutes, and starts another process; both hold the pipe
 * `held`, whose reading end is returned. */
static int hanging_compiler(void)
{
    CU_ASSERT_EQUAL_FATAL(mkfifo("held", 0600), 0);
    compiler_fake("exec 9>held\nsleep 600 &\nsleep 600");
    return open("held", O_RDONLY | O_NONBLOCK);
}

/* All processes that held the pipe have ended, within a minute. */
static void assert_ended(int pipe)
{
    const struct timespec wait = {0, 10000000};
    ssize_t got = -1;
    char byte;
    for (int i = 0; i < 6000 && got != 0; i++) {
        got = read(pipe, &byte, 1);
        if (got != 0) nanosleep(&wait, NULL);
    }
    CU_ASSERT_EQUAL(got, 0);
    close(pipe);
    unlink("held");
    unlink("fake");
}

/* One that hangs is ended, with what it started. */
static void test_compiler_hangs(void)
{
    const dal_native_options fake = {.cache = "cache", .compiler = "./fake", .patience = 1};
    const int pipe = hanging_compiler();
    refused(&fake, DAL_STATUS_UNSUPPORTED, "the compiler './fake' was ended after 1 seconds");
    assert_ended(pipe);
}

static bool stop_after(void *user)
{
    int *calls = user;
    return (*calls)-- <= 0;
}

/* The caller ends it, with what it started. */
static void test_compiler_stopped(void)
{
    int calls = 20;
    const dal_native_options fake = {
        .cache = "cache", .compiler = "./fake", .stop = stop_after, .user = &calls};
    const int kept = folder_files("cache"), pipe = hanging_compiler();
    refused(&fake, DAL_STATUS_INTERRUPTED, "the compiler './fake' was stopped");
    assert_ended(pipe);
    CU_ASSERT_EQUAL(folder_files("cache"), kept);
}

/* An object without the function, as another version might have left it, is made once again. */
static void test_foreign_object(void)
{
    const dal_native_options fake = {.cache = "cache", .compiler = "./fake", .patience = 3600};
    dal_run *run = new_run(falling);
    compiler_fake("if [ -e seen ]; then exec cc \"$@\"; fi; : >seen\n"
                  "echo 'int other;' >other.c; while [ $# -gt 2 ]; do shift; done\n"
                  "exec cc -shared -fPIC other.c -o \"$1\"");
    if (compiles) {
        CU_ASSERT_EQUAL(dal_run_native(run, &fake, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(access("other.c", F_OK), 0);
        CU_ASSERT_TRUE(dal_run_is_native(run));
    }
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    dal_run_free(run);
}

void suite_generate_native(void);
void suite_generate_native(void)
{
    CU_pSuite suite = CU_add_suite("generate_native", set_up, tear_down);
    CU_add_test(suite, "runs: same bits", test_runs);
    CU_add_test(suite, "series at the smallest tolerances: same bits", test_fine_series);
    CU_add_test(suite, "The solver auto, changing over", test_solver);
    CU_add_test(suite, "programs of many functions", test_long);
    CU_add_test(suite, "matrices of zeros", test_sparse);
    CU_add_test(suite, "batches: same bits, same failures", test_batches);
    CU_add_test(suite, "batches: starts after the change", test_batch_start);
    CU_add_test(suite, "memory runs out", test_memory);
    CU_add_test(suite, "memory to begin runs out", test_memory_to_begin);
    CU_add_test(suite, "memory for samples runs out", test_memory_for_samples);
    CU_add_test(suite, "systems made by hand", test_hand_made);
    CU_add_test(suite, "directories that cannot be used", test_cache_refused);
    CU_add_test(suite, "sources that cannot be written", test_source_refused);
    CU_add_test(suite, "directories with unusual names", test_cache_names);
    CU_add_test(suite, "compilers that fail", test_compilers_refused);
    CU_add_test(suite, "a compiler that hangs", test_compiler_hangs);
    CU_add_test(suite, "a compiler that is stopped", test_compiler_stopped);
    CU_add_test(suite, "an object of somebody else's", test_foreign_object);
}
