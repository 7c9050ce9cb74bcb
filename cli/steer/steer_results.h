/* steer_results.h - motions from one state to another, as a screen and as JSON. */
#ifndef DAL_CLI_STEER_RESULTS_H
#define DAL_CLI_STEER_RESULTS_H

#include "steer_data.h"

/* What can be reached, in words; returns text. */
enum { STEER_REACH = 640 }; /* with the longest growth vector */
const char *steer_format_reach(char text[STEER_REACH], const steer_settings *settings,
                               const dal_steering *steering);
/* Print what came out; again: a command for the same motion, or NULL.  Return CLI_DONE, or print
 * and return CLI_IO. */
int steer_print_screen(const steer_results *results, const char *again);
int steer_print_json(const steer_results *results);
/* The same to a file. */
void steer_put_json(FILE *out, const steer_results *results);

#endif
