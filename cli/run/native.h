/* native.h - compiled steps for a run: when they pay, and where they are cached. */
#ifndef DAL_CLI_NATIVE_H
#define DAL_CLI_NATIVE_H

#include "dalembert.h"
#include "ui/options.h"

/* The words of --native, "auto|on|off". */
typedef enum native_mode { NATIVE_AUTO, NATIVE_ON, NATIVE_OFF } native_mode;

/* The row of --native in a table of options. */
#define NATIVE_OPTION(settings)                                                                    \
    {                                                                                              \
        "native", "auto|on|off", "auto",                                                           \
            "compiles the steps, which changes no bit; auto: where it pays",                       \
            .parse = cli_parse_word, .offset = offsetof(settings, native)                          \
    }

/* Compile the steps of a run, or its observables, where the mode is on, or is auto and that many
 * steps or samples make it worth the time.  A failure is printed once and leaves the run as it
 * is. */
void native_compile_steps(dal_run *run, const dal_method *method, double steps, native_mode mode);
void native_compile_observables(dal_run *run, double samples, native_mode mode);

#endif
