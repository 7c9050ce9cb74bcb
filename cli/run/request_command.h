/* request_command.h - the command line of a command for the run of a request. */
#ifndef DAL_CLI_REQUEST_COMMAND_H
#define DAL_CLI_REQUEST_COMMAND_H

#include "request.h"

/* "dalembert explain SYSTEM --integrator rk4 --step 0.1 --set m=2" as a shell reads it, without
 * the options REQUEST_OPTION(name) | ..; allocated. */
char *request_format_command(const run_request *request, const char *command, const char *system,
                             unsigned without);

#endif
