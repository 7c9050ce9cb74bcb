/* steer.h - the search for the cheapest motion from one state to another. */
#ifndef DAL_CLI_STEER_H
#define DAL_CLI_STEER_H

#include "steer_data.h"

/* Stores NAME=VALUE,.. given for --to. */
cli_parser steer_parse_target;
/* Searches, and prints a screen or JSON.  Returns CLI_DONE, CLI_FAILED where no motion hits the
 * target, or prints and returns another exit status. */
int steer_run(steer_settings *settings);

#endif
