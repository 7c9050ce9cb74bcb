/* native.c - compiled steps for a run: when they pay, and where they are cached.
 *
 * The code of all runs of the program is in one list, so that runs of the same system and method
 * share it.  A compiler is started when a run has shown, by its clock, that it takes about as long
 * as compiling, and one at a time: whatever it costs, the steps go on beside it. */
#include "native.h"
#include "dalembert_codegen.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include "io/file.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>

/* Seconds of the processor: a run is measured for the first, which estimates the rest to a tenth,
 * since caches are warm by then; a compiler is started where more than the second remain, or, of
 * the cells of a study, which keep all processors busy, than the third.  Compiling takes as long as
 * 200,000 to 750,000 interpreted steps, of small systems a quarter of a second to two: where less
 * remains nothing is to be gained by it. */
static const double measured = 0.002, min_alone = 0.5, min_together = 10.0;

/* Seconds that it takes to search the cache, where it has code for such a system, measured: a text
 * is written and hashed, at a microsecond an operation of F and its Jacobian, an object read and
 * loaded.  Where the cache has none it takes some 10 microseconds. */
static const double search = 0.001, search_operation = 1e-6;
/* Twice that must remain: compiled steps take a third and less of the time. */
#define SEARCH_WORTH 2.0

/* A compiler beside a run has more time than one that is waited for.  It has a lower priority where
 * the run may end before it pays: at a lower one it may not run at all between other processes.
 * Where more than URGENT interpreted steps remain, several times what it takes, it has the same,
 * since each second that it waits the run is interpreted. */
enum { NICE = 10, PATIENCE = 600 /* seconds */ };
#define URGENT 2e6

/* Interpreted, the observables of a sample take about this time per coordinate; so much must be
 * spent on them to compile them, and so much to search for them. */
#define NS_SAMPLE 50.0
#define NS_WORTH  1e8
#define NS_SEARCH 5e6

/* ---- the code of all runs ---- */

typedef struct native_code {
    native_code_kind kind;
    dal_native *native; /* NULL: its compiler was ended with the program, or with a study */
    struct native_code *next;
} native_code;

/* The mutex guards all of it.  The program does not end for want of memory while a thread holds it,
 * since its end needs it. */
static native_code *codes;
static bool has_ended; /* no more compilers are started */
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

/* The library creates the last kind. */
char *native_cache(void)
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

static bool is_pending(const native_code *c)
{
    return c->native && dal_native_poll(c->native, NULL) == DAL_NATIVE_PENDING;
}

void native_end(void)
{
    pthread_mutex_lock(&mutex);
    for (native_code *c = codes; c; c = c->next) {
        if (!is_pending(c)) continue;
        dal_native_free(c->native);
        c->native = NULL;
    }
    pthread_mutex_unlock(&mutex);
}

static void end_program(void)
{
    pthread_mutex_lock(&mutex);
    has_ended = true;
    pthread_mutex_unlock(&mutex);
    native_end();
}

static void at_exit(void) { atexit(end_program); }

static void print_failure(native_code_kind kind, const dal_error *error)
{
    static atomic_flag printed[NATIVE_KINDS] = {ATOMIC_FLAG_INIT, ATOMIC_FLAG_INIT};
    if (error->status == DAL_STATUS_MEMORY) cli_out_of_memory();
    if (!atomic_flag_test_and_set(&printed[kind]))
        cli_note("%s are interpreted: %s", kind == NATIVE_STEPS ? "steps" : "observables",
                 error->message);
}

static native_code *find_code(const native_run *n)
{
    native_code *c = codes;
    while (c && !(c->kind == n->kind && dal_native_fits(c->native, n->run))) c = c->next;
    return c;
}

static bool compiles(void)
{
    native_code *c = codes;
    while (c && !is_pending(c)) c = c->next;
    return c;
}

/* Puts the code of the next kind into the list; NULL where it cannot be begun. */
static native_code *begin_code(const native_run *n, const dal_native_options *options,
                               native_code *memory, dal_error *error)
{
    *memory = (native_code){.kind = n->kind, .next = codes};
    if (has_ended) return codes = memory;
    if (n->kind == NATIVE_STEPS)
        dal_native_begin(&memory->native, n->run, options, error);
    else
        dal_native_begin_observables(&memory->native, n->run, options, error);
    return memory->native ? (codes = memory) : NULL;
}

/* Where code comes from: the cache alone, or else a compiler. */
typedef enum code_source { CACHE, BESIDE_THE_RUN, URGENTLY_BESIDE, BEFORE_THE_RUN } code_source;

/* Begins to compile the next code of a run, unless that is done already. */
static native_code *get_code(const native_run *n, code_source source)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    dal_error error = {.message = "no directory to keep compiled ones in"};
    native_code *const memory = cli_calloc(1, sizeof *memory);
    char *directory = native_cache();
    const dal_native_options options = {.cache = directory,
                                        .patience = source == BEFORE_THE_RUN ? 0 : PATIENCE,
                                        .nice = source == BESIDE_THE_RUN ? NICE : 0,
                                        .only_cached = source == CACHE};
    pthread_once(&once, at_exit);
    pthread_mutex_lock(&mutex);
    native_code *c = find_code(n);
    if (!c && directory) c = begin_code(n, &options, memory, &error);
    pthread_mutex_unlock(&mutex);
    if (c != memory) free(memory);
    free(directory);
    if (!c && source != CACHE) print_failure(n->kind, &error);
    return c;
}

/* ---- runs ---- */

static void begin_kind(native_run *n, native_code_kind kind)
{
    n->kind = kind;
    n->code = NULL;
    n->has_searched = false;
    n->clock = cli_thread_seconds();
    n->time = dal_run_time(n->run);
    n->steps = dal_run_steps(n->run);
}

/* Whether the code is there or failed: then the run uses it, or does without, and begins the
 * next. */
static bool use_code(native_run *n)
{
    dal_error error = {0};
    pthread_mutex_lock(&mutex);
    dal_native *const native = n->code->native;
    const dal_native_state state = native ? dal_native_poll(native, &error) : DAL_NATIVE_FAILED;
    if (state == DAL_NATIVE_READY) dal_run_use_native(n->run, native, &error);
    pthread_mutex_unlock(&mutex);
    if (state == DAL_NATIVE_PENDING) return false;
    if (error.status != DAL_STATUS_OK) print_failure(n->kind, &error);
    begin_kind(n, n->kind + 1);
    return true;
}

/* What remains of the run, and of those that take such steps, if it stays as fast as it was. */
typedef struct rest {
    double seconds, steps; /* 0 where that is not known yet */
} rest;

static rest estimate_rest(const native_run *n)
{
    const double seconds = cli_thread_seconds() - n->clock, t = dal_run_time(n->run);
    const double times = n->alike * (n->end - t) / (t - n->time);
    if (!(seconds >= measured && times > 0.0)) return (rest){0.0, 0.0};
    return (rest){times * seconds, times * (double)(dal_run_steps(n->run) - n->steps)};
}

/* Takes the next code from the cache, once, where more of the run remains than that takes. */
static native_code *search_cache(native_run *n, const rest *ahead)
{
    const dal_system *s = dal_run_system(n->run);
    const double operations = (double)s->field_operations + (double)s->jacobian_operations;
    if (n->has_searched || ahead->seconds < SEARCH_WORTH * (search + search_operation * operations))
        return NULL;
    n->has_searched = true;
    return get_code(n, CACHE);
}

/* Starts a compiler beside the run where it is worth it: so much remains.  Code that cannot be
 * compiled is left out. */
static native_code *compile_beside(native_run *n, const rest *ahead)
{
    if (n->kind == NATIVE_OBSERVABLES && !n->observes) return NULL;
    if (ahead->seconds < (n->alike > 1.0 ? min_together : min_alone)) return NULL;
    const bool is_urgent = n->alike > 1.0 || ahead->steps >= URGENT;
    native_code *const c = get_code(n, is_urgent ? URGENTLY_BESIDE : BESIDE_THE_RUN);
    if (!c) begin_kind(n, n->kind + 1);
    return c;
}

void native_poll(native_run *n)
{
    if (n->kind >= n->limit) return;
    bool is_free = false;
    if (!n->code) {
        pthread_mutex_lock(&mutex);
        n->code = find_code(n);
        is_free = !compiles();
        pthread_mutex_unlock(&mutex);
    }
    if (!n->code) {
        const rest ahead = estimate_rest(n);
        n->code = search_cache(n, &ahead);
        if (!n->code && is_free) n->code = compile_beside(n, &ahead);
    }
    if (n->code) use_code(n);
}

/* Compiles all parts; an interruption ends the wait. */
static void compile_now(native_run *n)
{
    const struct timespec pause = {0, 1000000};
    while (n->kind < n->limit && !cli_interrupted()) {
        if (!n->code && !(n->code = get_code(n, BEFORE_THE_RUN)))
            begin_kind(n, n->kind + 1);
        else if (!use_code(n))
            nanosleep(&pause, NULL);
    }
}

native_run native_begin(dal_run *run, double end, double samples, double alike, native_mode mode)
{
    const double cost = samples * NS_SAMPLE * dal_run_system(run)->n;
    const bool observes = samples > 0.0 && (mode == NATIVE_ON || cost > NS_SEARCH);
    native_run n = {.run = run, .end = end, .alike = alike, .observes = cost > NS_WORTH};
    n.limit = mode == NATIVE_OFF ? NATIVE_STEPS : observes ? NATIVE_KINDS : NATIVE_OBSERVABLES;
    begin_kind(&n, NATIVE_STEPS);
    if (mode == NATIVE_ON) compile_now(&n);
    return n;
}
