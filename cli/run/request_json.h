/* request_json.h - a request, and settings of it, as JSON. */
#ifndef DAL_CLI_REQUEST_JSON_H
#define DAL_CLI_REQUEST_JSON_H

#include "io/json.h"

#include "request.h"

/* An object of names and values; the infinite e is the text "inf", since JSON has no such number.
 */
void request_put_settings(json_writer *writer, const char *name, const request_settings *settings);
/* Begins the object "request" of the results of a command: the system, the value of each parameter,
 * the start values that were given, and all options but those that the command does not take. */
void request_open_json(json_writer *writer, const run_simulation *simulation, uint64_t without);

#endif
