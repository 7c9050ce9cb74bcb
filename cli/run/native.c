/* native.c - compiled steps for a run: when they pay, and where they are cached. */
#include "native.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include "dalembert_codegen.h"
#include "io/file.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/stat.h>

/* A compiler takes some 1e8 ns for a small system.  Interpreted, a step or a sample takes about
 * this time per coordinate, compiled a third of it; compiling must save three times its cost. */
#define NS_EXPLICIT 100.0
#define NS_IMPLICIT 1000.0
#define NS_SAMPLE   50.0
#define NS_WORTH    5e8

static bool is_wanted(const dal_run *run, native_mode mode, double cost, double count)
{
    return mode == NATIVE_ON ||
           (mode == NATIVE_AUTO && count * cost * dal_run_system(run)->n > NS_WORTH);
}

/* $XDG_CACHE_HOME/dalembert or ~/.cache/dalembert, allocated; the library creates the last part. */
static char *cache_directory(void)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char *own = NULL;
    if (!cache || cache[0] != '/') {
        if (!home || home[0] != '/') return NULL;
        cache = own = cli_join(home, ".cache");
    }
    mkdir(cache, 0700); /* may exist; the library reports where it cannot be created */
    char *directory = cli_join(cache, "dalembert");
    free(own);
    return directory;
}

/* The compiler ends with the program, whatever ends that. */
static int must_stop(void *user)
{
    (void)user;
    return cli_interrupted() || cli_is_ending();
}

typedef dal_status compilation(dal_run *run, const dal_native_options *options, dal_error *error);

/* The message is printed once, however many runs and threads there are. */
static void compile(dal_run *run, compilation *compile_run, atomic_flag *printed, const char *what)
{
    dal_error error = {.message = "no directory to keep compiled ones in"};
    char *directory = cache_directory();
    dal_status status = DAL_IO;
    if (directory) {
        cli_hold_exit();
        status =
            compile_run(run, &(dal_native_options){.cache = directory, .stop = must_stop}, &error);
        cli_release_exit();
    }
    free(directory);
    if (!cli_is_ok(status) && status != DAL_INTERRUPTED && !atomic_flag_test_and_set(printed))
        cli_note("%s are interpreted: %s", what, error.message);
}

void native_compile_steps(dal_run *run, const dal_method *method, double steps, native_mode mode)
{
    static atomic_flag printed = ATOMIC_FLAG_INIT;
    const int is_explicit = (dal_method_properties(method) & DAL_EXPLICIT) != 0;
    if (is_wanted(run, mode, is_explicit ? NS_EXPLICIT : NS_IMPLICIT, steps))
        compile(run, dal_run_native, &printed, "steps");
}

void native_compile_observables(dal_run *run, double samples, native_mode mode)
{
    static atomic_flag printed = ATOMIC_FLAG_INIT;
    if (is_wanted(run, mode, NS_SAMPLE, samples))
        compile(run, dal_run_native_observables, &printed, "observables");
}
