/* native.c - compiled steps for a run: when, and where they are kept. */
#include "native.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A compiler takes some 1e8 ns for a small system.  The tape needs about so many for a step, by
 * coordinate, and compiled code a third of them; three times what must be saved is asked for. */
#define NS_EXPLICIT 100.0
#define NS_IMPLICIT 1000.0
#define WORTH_WHILE 5e8

int native_read(const char *text, cli_native *native)
{
    static const char *const words[] = {
#define X(code, word) #word,
        NATIVE_LIST(X)
#undef X
    };
    enum { WORDS = sizeof words / sizeof words[0] };
    for (int i = 0; i < WORDS; i++) {
        if (strcmp(words[i], text) != 0) continue;
        *native = (cli_native)i;
        return CLI_DONE;
    }
    return cli_fail(CLI_USAGE, "--native: '%s' is not auto, on or off", text);
}

static int pays(const dal_run *run, const dal_method *method, double steps)
{
    const int is_explicit = (dal_method_claims(method) & DAL_EXPLICIT) != 0;
    const double cost = is_explicit ? NS_EXPLICIT : NS_IMPLICIT;
    return steps * cost * dal_run_system(run)->n > WORTH_WHILE;
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
    if (cache) mkdir(cache, 0700); /* may be there; if it cannot be made, the library will say so */
    char *directory = cache ? cli_join(cache, "dalembert") : NULL;
    free(own);
    return directory;
}

/* Once, though the runs may be many and on several threads. */
static void tell(const char *why)
{
    static atomic_flag told = ATOMIC_FLAG_INIT;
    if (!atomic_flag_test_and_set(&told)) cli_fail(CLI_DONE, "steps are interpreted: %s", why);
}

void native_use(dal_run *run, const dal_method *method, double steps, cli_native native)
{
    dal_error error = {0};
    if (native == NATIVE_OFF || (native == NATIVE_AUTO && !pays(run, method, steps))) return;
    char *directory = cache_directory();
    if (!directory)
        tell("no directory to keep compiled ones in");
    else if (dal_run_native(run, &(dal_native_options){.cache = directory}, &error) != DAL_OK)
        tell(error.message);
    free(directory);
}
