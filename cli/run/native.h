/* native.h - compiled steps for a run: when they pay, and where they are cached. */
#ifndef DAL_CLI_NATIVE_H
#define DAL_CLI_NATIVE_H

#include "ui/cli.h"

/* code, word */
#define NATIVE_LIST(MODE) MODE(AUTO, auto) MODE(ON, on) MODE(OFF, off)

typedef enum native_mode {
#define NATIVE_CODE(code, word) NATIVE_##code,
    NATIVE_LIST(NATIVE_CODE)
#undef NATIVE_CODE
} native_mode;

/* Parses a word of the list.  Returns CLI_DONE or prints and returns CLI_USAGE. */
int native_parse(const char *text, native_mode *mode);
/* Compile the steps of a run, or its observables, where the mode is on, or is auto and that many
 * steps or samples make it worth the time.  A failure is printed once and leaves the run as it
 * is. */
void native_compile_steps(dal_run *run, const dal_method *method, double steps, native_mode mode);
void native_compile_observables(dal_run *run, double samples, native_mode mode);

#endif
