/* native.h - compiled steps for a run: when, and where they are kept. */
#ifndef DAL_CLI_NATIVE_H
#define DAL_CLI_NATIVE_H

#include "ui/cli.h"

/* code, word */
#define NATIVE_LIST(X) X(AUTO, auto) X(ON, on) X(OFF, off)

typedef enum native_mode {
#define X(code, word) NATIVE_##code,
    NATIVE_LIST(X)
#undef X
} native_mode;

/* Reads a word of the list.  Returns CLI_DONE or prints and returns CLI_USAGE. */
int native_parse(const char *text, native_mode *native);
/* Lets a run of about so many steps step by compiled code, if that is wanted and (auto) pays; and
 * look so many times by compiled code.  Where it cannot be had, says so in one line and leaves the
 * run as it is. */
void native_compile_observables(dal_run *run, double looks, native_mode native);
void native_compile_steps(dal_run *run, const dal_method *method, double steps, native_mode native);

#endif
