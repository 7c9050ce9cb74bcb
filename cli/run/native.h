/* native.h - compiled steps for a run: when they pay, and where they are cached.
 *
 * Where --native is auto a run is interpreted at once, and changes over to compiled steps between
 * two steps when it finds them in the cache, or when a compiler beside it has made them.  No bit
 * depends on where that is. */
#ifndef DAL_CLI_NATIVE_H
#define DAL_CLI_NATIVE_H

#include "dalembert_run.h"
#include "ui/options.h"
#include <stdbool.h>

/* The words of --native, "auto|on|off". */
typedef enum native_mode { NATIVE_AUTO, NATIVE_ON, NATIVE_OFF } native_mode;

/* The row of --native in a table of options. */
#define NATIVE_OPTION(settings)                                                                    \
    {                                                                                              \
        "native", "auto|on|off", "auto",                                                           \
            "compiles the steps, which changes no bit; auto: beside the run; on: before it, in "   \
            "at most 60 s; off: never",                                                            \
            .parse = cli_parse_word, .offset = offsetof(settings, native)                          \
    }

/* What of a run is compiled. */
typedef enum native_code_kind { NATIVE_STEPS, NATIVE_OBSERVABLES, NATIVE_KINDS } native_code_kind;

/* A run on its way to compiled code. */
typedef struct native_run {
    dal_run *run;
    double end;               /* of its time */
    double alike;             /* how many runs of a study take such steps, this one included */
    native_code_kind kind;    /* the next, NATIVE_KINDS: there is none */
    native_code_kind limit;   /* where it ends */
    double clock, time;       /* when the last code was there: of the thread, and of the run */
    long long steps;          /* of the run, then */
    bool has_searched;        /* the cache, for the kind */
    bool observes;            /* enough to compile its observables */
    struct native_code *code; /* of the kind, or NULL */
} native_run;

/* Where compiled code is cached, $XDG_CACHE_HOME/dalembert or ~/.cache/dalembert, allocated; NULL
 * where there is no such place. */
char *native_cache(void);
/* Begins for a run to some time, whose observables are evaluated that often (0: by other means).
 * `on` compiles now, off never. */
native_run native_begin(dal_run *run, double end, double samples, double alike, native_mode mode);
/* Called between steps, ten times a second or more: compiles what is worth it, and uses what is
 * there.  A failure is printed once and leaves the run as it is. */
void native_poll(native_run *n);
/* Ends the compilers that run.  The end of the program does the same. */
void native_end(void);

#endif
