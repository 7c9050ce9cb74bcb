/* report_path.h - the path of a run in the plane. */
#ifndef DAL_CLI_REPORT_PATH_H
#define DAL_CLI_REPORT_PATH_H

#include "report_page.h"

/* Draws the path of the run in a directory, with its body, where the system has a picture; a
 * sentence about the body follows the caption.  Returns CLI_DONE or prints and returns an exit
 * status. */
int report_path(report *r, const char *run, const char *name, const char *caption);

#endif
