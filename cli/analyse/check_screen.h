/* check_screen.h - the report of `check` on a terminal. */
#ifndef DAL_CLI_CHECK_SCREEN_H
#define DAL_CLI_CHECK_SCREEN_H

#include "check_items.h"

/* Prints what failed, with its likely cause, then what the system conserves and which methods keep
 * it.  Returns CLI_DONE, or prints and returns CLI_IO. */
int check_print_screen(const check *c);

#endif
