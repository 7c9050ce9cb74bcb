/* columns.h - the columns of a run: their names, and which of them --columns selects.
 *
 * The values of a row are t, the state, all observables and the derivatives of q and v, or off
 * p = pi = 0 of the whole state, by each name of --sensitivities; the norms |p|, |pi|, |pi_e|
 * follow from other columns and are for the summary alone.  An item of --columns is the name of a
 * column, a kind or a pattern with * and ?, in this order, so that a coordinate named q is that
 * coordinate.  Columns keep the order of the whole row, and t is always the first. */
#ifndef DAL_CLI_COLUMNS_H
#define DAL_CLI_COLUMNS_H

#include "request_data.h"

typedef struct run_columns {
    int values;      /* 1 + the dimension + the number of observables + derivatives */
    int derivatives; /* by each name of --sensitivities, the first of its column */
    char **name;     /* [values] */
    int count;
    int *index; /* [count] which of the values a column is */
} run_columns;

/* Makes the columns of a run.  Returns CLI_DONE, or prints and returns CLI_USAGE
 * where an item of --columns matches none, or a plain name is another column's; free them in
 * any case. */
int columns_make(run_columns *columns, const run_simulation *simulation);
/* Whether a list of --columns has names, kinds or patterns of h1.., R_x.. or lambda1.. that are
 * not names of the system. */
bool columns_need_reactions(const dal_system *system, const char *list);
/* Replaces a name by the name of its column: with --names plain "x'" becomes "vx". */
void columns_rename(const run_request *request, char *name);
/* Whether a column is the velocity of a coordinate. */
bool columns_is_velocity(const run_request *request, const char *name, const char *coordinate);
void columns_free(run_columns *columns);
/* The two of names[count] that --axes X,Y means.  Returns CLI_DONE, or prints and returns
 * CLI_USAGE. */
int columns_find_axes(const char *axes, const char *const *names, int count, int axis[2]);

#endif
