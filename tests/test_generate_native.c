/* test_generate_native.c - native mode: runs and batches stepped by compiled code have the bits of
 * their tapes, and whatever goes wrong with compiler or cache leaves them stepping by the tape. */
#include "allocation.h"
#include "compiler.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "folder.h"
#include <CUnit/CUnit.h>
#include <dirent.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* Tests run in a directory of their own; paths in it need not be absolute. */
static char place[] = "/tmp/dal-native-XXXXXX";
static int before; /* the directory that was */
static bool compiles;
static const dal_native_options options = {.cache = "cache"};

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
    CU_ASSERT_EQUAL(dal_run_advance(tape, 300, &error), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(native, 100, &error), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_native(native, &options, &error), compiles ? DAL_OK : DAL_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_run_is_native(native), compiles);
    CU_ASSERT_EQUAL(dal_run_advance(native, 135, &error), DAL_OK);
    const double *memory = dal_run_save(native, &count);
    CU_ASSERT_EQUAL(dal_run_restore(loaded, memory, count, &error), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(native, 65, &error), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(loaded, 65, &error), DAL_OK);
    same_memory(native, tape);
    same_memory(loaded, tape);
    dal_run_free(tape);
    dal_run_free(native);
    dal_run_free(loaded);
}

/* The same steps by the tape and compiled, without optimisation, which takes less time. */
static void same_steps(const dal_system *system, const char *method)
{
    const dal_native_options plain = {.cache = "cache", .compiler = "./fake"};
    dal_run_spec spec = fixture_spec(system, method, DAL_LIFTED, 0.01);
    spec.options.solver = DAL_NEWTON;
    dal_run *const tape = fixture_run(&spec), *const native = fixture_run(&spec);
    compiler_fake("exec cc \"$@\" -O0");
    CU_ASSERT_EQUAL(dal_run_native(native, &plain, NULL), compiles ? DAL_OK : DAL_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_run_advance(tape, 10, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(native, 10, NULL), DAL_OK);
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
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_OK);
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
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, spec, count, 0, NULL), DAL_OK);
    for (int i = 0; i < count; i++) {
        const dal_setting s = {"s", i == 0 ? 40.0 : i == 8 ? 4.0 : 0.01 * i};
        const dal_setting start = {"y'", 0.1 * i};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &s, 1, &start, 1, NULL), DAL_OK);
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
                    compiles ? DAL_OK : DAL_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_batch_is_native(native), compiles);
    dal_batch_advance(native, 1000 - first);
    CU_ASSERT_EQUAL(dal_batch_advance(native, 1000), dal_batch_advance(tape, 1000));
    for (int lane = 0; lane < count; lane++) same_lane(tape, native, lane);
    CU_ASSERT_NOT_EQUAL(dal_batch_status(native, 0, NULL), DAL_OK);
    dal_batch_free(tape);
    dal_batch_free(native);
}

static void test_batches(void)
{
    static const int counts[] = {1, 3, 4, 8, MAX_LANES};
    const dal_system *falls = fixture_system(falling);
    const dal_run_spec simple = fixture_spec(falls, "rk4", DAL_PHYSICAL, 0.001);
    const dal_run_spec lifted = fixture_spec(falls, "implicit-midpoint", DAL_LIFTED, 0.001);
    for (int i = 0; i < 5; i++) same_batch(&simple, counts[i], 0);
    same_batch(&simple, MAX_LANES, 700);
    same_batch(&lifted, MAX_LANES, 700);
}

/* A batch that is native already may still be given its starts, and is not compiled again. */
static void test_batch_start(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(falling), "rk4", DAL_PHYSICAL, 0.001);
    const dal_setting start = {"y", 2.0};
    dal_batch *const tape = lanes_of(&spec, 5), *const native = lanes_of(&spec, 5);
    if (compiles) CU_ASSERT_EQUAL(dal_batch_native(native, &options, NULL), DAL_OK);
    const dal_native_options nothing = {.cache = "/nowhere/at/all"};
    if (compiles) CU_ASSERT_EQUAL(dal_batch_native(native, &nothing, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_batch_start(tape, 4, NULL, 0, &start, 1, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_batch_start(native, 4, NULL, 0, &start, 1, NULL), DAL_OK);
    dal_batch_advance(tape, 100);
    dal_batch_advance(native, 100);
    for (int lane = 0; lane < 5; lane++) same_lane(tape, native, lane);
    dal_batch_free(tape);
    dal_batch_free(native);
}

/* ---- what goes wrong ---- */

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
        CU_ASSERT_EQUAL(dal_run_is_native(run), one == DAL_OK);
        CU_ASSERT_EQUAL(dal_batch_is_native(batch), many == DAL_OK);
        CU_ASSERT_EQUAL(dal_batch_advance(batch, 10), DAL_OK);
        CU_ASSERT_EQUAL(dal_batch_advance(tape, 10), DAL_OK);
    }
    allocation_fail_after(-1);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_OK);
    for (int lane = 0; lane < 5; lane++) same_lane(tape, batch, lane);
    dal_run_free(run);
    dal_batch_free(batch);
    dal_batch_free(tape);
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
    CU_ASSERT_EQUAL(dal_run_observe(run, &first), DAL_OK);
    for (long n = 0;; n++) {
        allocation_fail_after(n);
        const dal_status status = dal_run_native_observables(run, &options, &error);
        if (!allocation_failed()) break;
        CU_ASSERT_NOT_EQUAL(status, DAL_OK);
        refused += strstr(error.message, " observations") != NULL;
        CU_ASSERT_EQUAL(dal_run_observe(run, &again), DAL_OK);
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
    CU_ASSERT_EQUAL(dal_run_step(run, &error), DAL_OK);
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
    refused(NULL, DAL_ARGUMENT, "no directory");
    refused_cache(NULL, DAL_ARGUMENT, "no directory");
    refused_cache("", DAL_ARGUMENT, "no directory");
    refused_cache(long_name, DAL_ARGUMENT, "too long");
    refused_cache("/dev/null", DAL_IO, "/dev/null");
    refused_cache("/nowhere/at/all", DAL_IO, "/nowhere/at/all");
    CU_ASSERT_EQUAL_FATAL(mkdir("open", 0700), 0);
    for (int mode = 0701; mode < 0730; mode += 007) { /* others search; the group reads; writes */
        CU_ASSERT_EQUAL(chmod("open", (mode_t)mode), 0);
        refused_cache("open", DAL_IO, "of this user alone");
    }
    CU_ASSERT_EQUAL(chmod("open", 0700), 0);
    CU_ASSERT_EQUAL(symlink("open", "link"), 0);
    refused_cache("link", DAL_IO, "of this user alone");
    if (chown("open", 12345, (gid_t)-1) == 0) /* only root may give a directory away */
        refused_cache("open", DAL_IO, "of this user alone");
    CU_ASSERT_EQUAL(folder_files("open"), 0);
    unlink("link");
    folder_remove("open");
}

/* Names that a compiler could take for options, or a shell for commands. */
static void test_cache_names(void)
{
    static const char *const names[] = {"-fplugin=x", "@list", "$(touch evil)", "; touch evil",
                                        "-o"};
    for (int i = 0; i < 3 && compiles; i++) {
        dal_run *run = new_run(falling);
        CU_ASSERT_EQUAL(dal_run_native(run, &(dal_native_options){.cache = names[i]}, NULL),
                        DAL_OK);
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
    refused(&(dal_native_options){.cache = "cache", .compiler = "./none"}, DAL_UNSUPPORTED,
            "no compiler './none'");
    compiler_fake("exit 1");
    refused(&fake, DAL_UNSUPPORTED, "the compiler './fake' failed");
    compiler_fake("kill -SEGV $$");
    refused(&fake, DAL_UNSUPPORTED, "the compiler './fake' failed");
    compiler_fake("exit 0"); /* and makes nothing */
    refused(&fake, DAL_IO, "cannot seal");
    compiler_fake("while [ $# -gt 2 ]; do shift; done; echo 'no object' >\"$1\"");
    refused(&fake, DAL_IO, "cannot be loaded");
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
    refused(&fake, DAL_UNSUPPORTED, "the compiler './fake' was ended after 1 seconds");
    assert_ended(pipe);
}

static int stop_after(void *user)
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
    refused(&fake, DAL_INTERRUPTED, "the compiler './fake' was stopped");
    assert_ended(pipe);
    CU_ASSERT_EQUAL(folder_files("cache"), kept);
}

/* An object without the function, as another version might have left it, is made once again. */
static void test_foreign_object(void)
{
    const dal_native_options fake = {.cache = "cache", .compiler = "./fake"};
    dal_run *run = new_run(falling);
    compiler_fake("if [ -e seen ]; then exec cc \"$@\"; fi; : >seen\n"
                  "echo 'int other;' >other.c; while [ $# -gt 2 ]; do shift; done\n"
                  "exec cc -shared -fPIC other.c -o \"$1\"");
    if (compiles) {
        CU_ASSERT_EQUAL(dal_run_native(run, &fake, NULL), DAL_OK);
        CU_ASSERT_EQUAL(access("other.c", F_OK), 0);
        CU_ASSERT_TRUE(dal_run_is_native(run));
    }
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_OK);
    dal_run_free(run);
}

/* ---- an object is taken from the cache while it is as it was written ---- */

static const char kept[] = "kept"; /* a cache with one object, the only file in it */

static char *only_object(char *path, size_t size)
{
    DIR *folder = opendir(kept);
    CU_ASSERT_PTR_NOT_NULL_FATAL(folder);
    path[0] = '\0';
    for (const struct dirent *entry; (entry = readdir(folder));)
        if (entry->d_name[0] != '.') snprintf(path, size, "%s/%s", kept, entry->d_name);
    closedir(folder);
    return path;
}

/* The folders in a cache: compilations that are under way, or were killed. */
static int folders_in(const char *path)
{
    struct stat s;
    char name[512];
    int count = 0;
    DIR *folder = opendir(path);
    CU_ASSERT_PTR_NOT_NULL_FATAL(folder);
    for (const struct dirent *entry; (entry = readdir(folder));) {
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        count += entry->d_name[0] != '.' && lstat(name, &s) == 0 && S_ISDIR(s.st_mode);
    }
    closedir(folder);
    return count;
}

static char *content(const char *path, long *length)
{
    FILE *file = fopen(path, "rb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    fseek(file, 0, SEEK_END);
    *length = ftell(file);
    rewind(file);
    char *bytes = malloc((size_t)*length);
    CU_ASSERT_EQUAL(fread(bytes, 1, (size_t)*length, file), (size_t)*length);
    fclose(file);
    return bytes;
}

static void put_content(const char *path, const char *bytes, long length)
{
    FILE *file = fopen(path, "wb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    CU_ASSERT_EQUAL(fwrite(bytes, 1, (size_t)length, file), (size_t)length);
    fclose(file);
}

/* How often the compiler has been called, which leaves a letter each time. */
static long compilations(void)
{
    struct stat s;
    return stat("called", &s) == 0 ? (long)s.st_size : 0;
}

static void use_cache(const char *model)
{
    dal_run *run = new_run(model);
    const dal_native_options counted = {.cache = kept, .compiler = "./fake"};
    CU_ASSERT_EQUAL(dal_run_native(run, &counted, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_OK);
    dal_run_free(run);
    CU_ASSERT_EQUAL(folder_files(kept), 1);
}

/* Any byte of it, of what the loader never reads too; cut short, or longer, or empty. */
static void test_changed_object(void)
{
    const char *const model = falling;
    char path[512];
    long length, again;
    compiler_fake("printf x >>called; exec cc \"$@\"");
    use_cache(model);
    use_cache(model);
    CU_ASSERT_EQUAL(compilations(), 1);
    char *bytes = content(only_object(path, sizeof path), &length);
    for (int damage = 0; damage < 6; damage++) {
        const long at[] = {length - 1, length - 8, length - 9, 4};
        char *other = malloc((size_t)length + 1);
        memcpy(other, bytes, (size_t)length);
        other[length] = 'x';
        if (damage < 4) other[at[damage]] ^= 1;
        put_content(path, other, damage < 4 ? length : damage == 4 ? length + 1 : length - 1);
        free(other);
        use_cache(model);
        CU_ASSERT_EQUAL(compilations(), damage + 2);
        other = content(path, &again);
        CU_ASSERT(again == length && memcmp(other, bytes, (size_t)length) == 0);
        free(other);
    }
    put_content(path, "", 0);
    use_cache(model);
    CU_ASSERT_EQUAL(compilations(), 8);
    free(bytes);
    unlink("called");
    unlink("fake");
    folder_remove(kept);
}

/* An object that others may write, or that is another user's, or no file, is made again. */
static void test_object_of_others(void)
{
    static const mode_t modes[] = {0720, 0702, 0777};
    char path[512];
    struct stat s;
    compiler_fake("printf x >>called; umask 0; exec cc \"$@\"");
    use_cache(falling);
    only_object(path, sizeof path);
    for (int i = 0; i < 5; i++) {
        bool is_bad = true;
        if (i < 3) CU_ASSERT_EQUAL(chmod(path, modes[i]), 0);
        if (i == 3) is_bad = chown(path, 12345, (gid_t)-1) == 0; /* only root may give it away */
        if (i == 4) {
            CU_ASSERT_EQUAL(rename(path, "moved"), 0);
            CU_ASSERT_EQUAL(symlink("../moved", path), 0);
        }
        const long made = compilations();
        use_cache(falling);
        CU_ASSERT_EQUAL(compilations(), made + is_bad);
        CU_ASSERT_EQUAL_FATAL(lstat(path, &s), 0);
        CU_ASSERT(S_ISREG(s.st_mode) && s.st_uid == geteuid() && (s.st_mode & 077) == 0);
    }
    unlink("moved");
    unlink("called");
    unlink("fake");
    folder_remove(kept);
}

/* The next compilation removes the folders of those that were killed, not that of one that lives:
 * a compiler that waits for a pipe, as a run does that was killed while it runs. */
static void test_abandoned(void)
{
    enum { HASH = 32 };
    const dal_native_options waiting = {.cache = kept, .compiler = "./fake", .patience = 600};
    char folder[64], file[80];
    dal_native *native = NULL;
    int status = 0;
    dal_run *run = new_run(falling);
    CU_ASSERT_EQUAL_FATAL(mkfifo("held", 0600), 0);
    const int pipe = open("held", O_RDWR);
    compiler_fake("read line <held; exec cc \"$@\"");
    const pid_t killed = fork();
    if (killed == 0) {
        dal_native_begin(&native, run, &waiting, NULL);
        _exit(0); /* and leaves its folder to the compiler, which lives */
    }
    CU_ASSERT_EQUAL(waitpid(killed, &status, 0), killed);
    snprintf(folder, sizeof folder, "%s/%0*d.so.killed", kept, HASH, 0);
    CU_ASSERT_EQUAL(mkdir(folder, 0700), 0);
    for (int i = 0; i < 3; i++) {
        snprintf(file, sizeof file, "%s/%s", folder, i == 0 ? "code.c" : i == 1 ? "code.so" : "x");
        put_content(file, "int x;", 6);
    }
    CU_ASSERT_EQUAL(folders_in(kept), 2);
    dal_run *other = new_run("vertical-disk");
    CU_ASSERT_EQUAL(dal_run_native(other, &(dal_native_options){.cache = kept}, NULL), DAL_OK);
    CU_ASSERT_NOT_EQUAL(access(folder, F_OK), 0);
    CU_ASSERT_EQUAL(folders_in(kept), 1);
    CU_ASSERT_EQUAL(write(pipe, "\n", 1), 1); /* the compiler goes on, and ends */
    for (int i = 0; i < 600 && folders_in(kept) > 0; i++) {
        nanosleep(&(struct timespec){0, 100000000}, NULL);
        dal_run *next = new_run("vertical-disk");
        CU_ASSERT_EQUAL(dal_run_native(next, &(dal_native_options){.cache = kept}, NULL), DAL_OK);
        dal_run_free(next);
    }
    CU_ASSERT_EQUAL(folders_in(kept), 0);
    dal_run_free(run);
    dal_run_free(other);
    close(pipe);
    unlink("held");
    unlink("fake");
    folder_remove(kept);
}

/* Another text, and another command, has an object of its own. */
static void test_objects_apart(void)
{
    const char *const compilers[] = {"./fake", "./same"};
    compiler_fake("exec cc \"$@\"");
    CU_ASSERT_EQUAL(symlink("fake", "same"), 0);
    for (int i = 0; i < 4; i++) {
        const dal_native_options with = {.cache = kept, .compiler = compilers[i % 2]};
        const dal_run_spec spec = fixture_spec(fixture_system(falling),
                                               i < 2 ? "rk4" : "stormer-verlet", DAL_PHYSICAL, 0.1);
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_native(run, &with, NULL), DAL_OK);
        CU_ASSERT_EQUAL(folder_files(kept), i + 1);
        dal_run_free(run);
    }
    unlink("fake");
    unlink("same");
    folder_remove(kept);
}

void suite_generate_native(void);
void suite_generate_native(void)
{
    CU_pSuite suite = CU_add_suite("generate_native", set_up, tear_down);
    CU_add_test(suite, "runs: same bits", test_runs);
    CU_add_test(suite, "The solver auto, changing over", test_solver);
    CU_add_test(suite, "programs of many functions", test_long);
    CU_add_test(suite, "matrices of zeros", test_sparse);
    CU_add_test(suite, "batches: same bits, same failures", test_batches);
    CU_add_test(suite, "batches: starts after the change", test_batch_start);
    CU_add_test(suite, "memory runs out", test_memory);
    CU_add_test(suite, "memory for samples runs out", test_memory_for_samples);
    CU_add_test(suite, "directories that cannot be used", test_cache_refused);
    CU_add_test(suite, "directories with unusual names", test_cache_names);
    CU_add_test(suite, "compilers that fail", test_compilers_refused);
    CU_add_test(suite, "a compiler that hangs", test_compiler_hangs);
    CU_add_test(suite, "a compiler that is stopped", test_compiler_stopped);
    CU_add_test(suite, "an object of somebody else's", test_foreign_object);
    if (system("cc --version >/dev/null 2>&1") != 0) return;
    CU_add_test(suite, "an object that was changed", test_changed_object);
    CU_add_test(suite, "objects of other texts and commands", test_objects_apart);
    CU_add_test(suite, "objects that others may write", test_object_of_others);
    CU_add_test(suite, "folders of compilers that were killed", test_abandoned);
}
