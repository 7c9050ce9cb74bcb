/* invariants.h - invariants of a system's motion, found from its formulas. */
#ifndef DAL_CLI_INVARIANTS_H
#define DAL_CLI_INVARIANTS_H

#include "dalembert_run.h"
#include "run/simulation.h"

#include <stdbool.h>

typedef struct invariants_settings {
    run_simulation simulation;
    long long degree;
    const char *with; /* further atoms, with commas between them; NULL: none */
    bool measure, json, details;
} invariants_settings;

/* The next name I1, I2, .. that the system does not use, after the one of *number. */
enum { INVARIANTS_NAME = 16 };
void invariants_next_name(const dal_system *system, int *number, char name[INVARIANTS_NAME]);
/* Lets the run of a simulation, whose system is loaded, observe each new invariant of degree 2; a
 * line says which.  Returns CLI_DONE, or prints and returns an exit status. */
int invariants_observe(run_simulation *simulation);

/* Finds the invariants and prints them, as an `invariants:` block for a system file, as JSON, or on
 * a terminal as a table.  Returns CLI_DONE, CLI_CHECK where none is found, or prints and returns an
 * exit status. */
int invariants_find(invariants_settings *settings);

#endif
