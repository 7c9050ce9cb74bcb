/* native.c - compiled steps for a run: when, and where they are kept. */
#include "native.h"
#include "dalembert_codegen.h"
#include "io/output.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A compiler takes some 1e8 ns for a small system.  The tape needs about so many for a step or a
 * look, by coordinate, and compiled code a third of them or less; three times what must be saved is
 * asked for. */
#define NS_EXPLICIT 100.0
#define NS_IMPLICIT 1000.0
#define NS_LOOK     50.0
#define WORTH_WHILE 5e8

int native_parse(const char *text, native_mode *native)
{
    static const char *const words[] = {
#define X(code, word) #word,
        NATIVE_LIST(X)
#undef X
    };
    enum { WORDS = sizeof words / sizeof words[0] };
    for (int i = 0; i < WORDS; i++) {
        if (strcmp(words[i], text) != 0) continue;
        *native = (native_mode)i;
        return CLI_DONE;
    }
    return cli_fail(CLI_USAGE, "--native: '%s' is not auto, on or off", text);
}

static int pays(const dal_run *run, double cost, double times)
{
    return times * cost * dal_run_system(run)->n > WORTH_WHILE;
}

/* $XDG_CACHE_HOME/dalembert or ~/.cache/dalembert, allocated; the library makes the last part. */
static char *cache_directory(void)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char *own = NULL;
    if (!cache || cache[0] != '/') {
        if (!home || home[0] != '/') return NULL;
        cache = own = cli_join(home, ".cache");
    }
    mkdir(cache, 0700); /* may be there; if it cannot be made, the library will say so */
    char *directory = cli_join(cache, "dalembert");
    free(own);
    return directory;
}

/* Each once, though the runs may be many and on several threads. */
static void tell(atomic_flag *told, const char *what, const char *why)
{
    if (!atomic_flag_test_and_set(told)) cli_fail(CLI_DONE, "%s are interpreted: %s", what, why);
}

/* The compiler ends with the program, whatever ends that. */
static int stops(void *user)
{
    (void)user;
    return cli_interrupted() || cli_is_ending();
}

typedef dal_status compilation(dal_run *run, const dal_native_options *options, dal_error *error);

static void compile(dal_run *run, compilation *of, atomic_flag *told, const char *what)
{
    dal_error error = {0};
    char *directory = cache_directory();
    if (!directory) {
        tell(told, what, "no directory to keep compiled ones in");
        return;
    }
    cli_hold_exit();
    const dal_status status =
        of(run, &(dal_native_options){.cache = directory, .stop = stops}, &error);
    cli_release_exit();
    free(directory);
    if (!cli_is_ok(status) && status != DAL_INTERRUPTED) tell(told, what, error.message);
}

void native_compile_steps(dal_run *run, const dal_method *method, double steps, native_mode native)
{
    static atomic_flag told = ATOMIC_FLAG_INIT;
    const int is_explicit = (dal_method_claims(method) & DAL_EXPLICIT) != 0;
    const int wanted =
        native == NATIVE_ON ||
        (native == NATIVE_AUTO && pays(run, is_explicit ? NS_EXPLICIT : NS_IMPLICIT, steps));
    if (wanted) compile(run, dal_run_native, &told, "steps");
}

void native_compile_observables(dal_run *run, double looks, native_mode native)
{
    static atomic_flag told = ATOMIC_FLAG_INIT;
    const int wanted = native == NATIVE_ON || (native == NATIVE_AUTO && pays(run, NS_LOOK, looks));
    if (wanted) compile(run, dal_run_native_observables, &told, "observables");
}
