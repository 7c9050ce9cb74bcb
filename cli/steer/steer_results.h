/* steer_results.h - motions from one state to another, as a screen and as JSON. */
#ifndef DAL_CLI_STEER_RESULTS_H
#define DAL_CLI_STEER_RESULTS_H

#include "steer_data.h"

/* What can be reached, in words; returns text. */
enum { STEER_REACH = 256 };
const char *steer_format_reach(char text[STEER_REACH], const steer_settings *settings,
                               const dal_steering *steering);
/* Print what came out.  Return CLI_DONE, or print and return CLI_IO. */
int steer_print_screen(const steer_results *results);
int steer_print_json(const steer_results *results);

#endif
