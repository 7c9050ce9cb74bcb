/* native.h - compiled steps for a run: when, and where they are kept. */
#ifndef DAL_CLI_NATIVE_H
#define DAL_CLI_NATIVE_H

#include "ui/cli.h"

/* code, word */
#define NATIVE_LIST(X) X(AUTO, auto) X(ON, on) X(OFF, off)

typedef enum cli_native {
#define X(code, word) NATIVE_##code,
    NATIVE_LIST(X)
#undef X
} cli_native;

/* Reads a word of the list.  Returns CLI_DONE or prints and returns CLI_USAGE. */
int native_read(const char *text, cli_native *native);
/* Lets a run of about so many steps step by compiled code, if that is wanted and (auto) pays; and
 * look so many times by compiled code.  Where it cannot be had, says so in one line and leaves the
 * run as it is. */
void native_look(dal_run *run, double looks, cli_native native);
void native_use(dal_run *run, const dal_method *method, double steps, cli_native native);

#endif
