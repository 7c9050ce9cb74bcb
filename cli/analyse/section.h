/* section.h - where a motion crosses a surface g(q,v,t) = 0. */
#ifndef DAL_CLI_SECTION_H
#define DAL_CLI_SECTION_H

#include "run/native.h"
#include "run/simulation.h"

#include <stdbool.h>

typedef struct section_settings {
    run_simulation simulation;
    const char *on, *axes, *output;
    int direction; /* of crossings: -1 down, 0 both, 1 up */
    double transient;
    native_mode native;
    bool json;               /* to stdout, instead of rows */
    bool details, is_screen; /* is_screen: a terminal gets a table of the first rows */
    bool force;              /* into any directory */
} section_settings;

/* The options of a run that it does not take. */
#define SECTION_WITHOUT (REQUEST_ROW_OPTIONS & ~REQUEST_OPTION(names))

/* Writes a row for each crossing, or all as JSON, and what `report` draws it by.  Returns CLI_DONE,
 * or prints and returns an exit status. */
int section_find(section_settings *settings);

#endif
