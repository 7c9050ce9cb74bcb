/* steer_output.h - the directory of a search: runs of the motions, tables of their inputs. */
#ifndef DAL_CLI_STEER_OUTPUT_H
#define DAL_CLI_STEER_OUTPUT_H

#include "steer_data.h"

/* Of a search that has found motions, writes DIR as the directory of a run of the cheapest one and
 * DIR/motion-K of the others, each with its inputs; of another one DIR/best.csv; and steer.json.
 * *again receives the command, allocated, that runs the system with the inputs of the cheapest one
 * as given forces, or NULL.  Returns CLI_DONE, or prints and returns an exit status. */
int steer_write(const steer_results *results, char **again);

#endif
