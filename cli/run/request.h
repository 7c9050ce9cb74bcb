/* request.h - the options of a run as rows. */
#ifndef DAL_CLI_REQUEST_H
#define DAL_CLI_REQUEST_H

#include "request_data.h"
#include "ui/options.h"

#include <stdbool.h>

/* An empty request; release it with request_free. */
run_request request_default(void);
void request_free(run_request *request);
extern const cli_option request_options[REQUEST_OPTIONS];
/* Whether --integrator, --step or --time is missing; --times and --steps give the end, too. */
bool request_lacks(const run_request *request, int option);
/* Whether the step is positive and the end after the start, where they were given.  Returns
 * CLI_DONE, or prints and returns CLI_USAGE. */
int request_check_forward(const run_request *request);
/* Whether an option has a number as its value. */
bool request_option_is_number(int option);
/* The number of an option by its name, -1 for none. */
int request_find_option(const char *name);

/* All below return CLI_DONE, or print and return an exit status. */

/* Parses the value of one option; request points to the text. */
int request_parse_option(run_request *request, int option, const char *text);
/* The same of an allocated text, which the request then owns. */
int request_give(run_request *request, int option, char *text);
/* Parses NAME=VALUE, given for an option, and adds it; a name that is there already is an error. */
int request_parse_named(request_settings *settings, const cli_option *option, const char *text);
/* Parses the value of a setting, a number or a formula of numbers, e = inf being the one infinite
 * value, and adds it; what names it in a message. */
int request_parse_setting(request_settings *settings, const char *what, const char *name,
                          const char *text);

#endif
