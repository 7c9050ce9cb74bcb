/* report_ensemble.h - the page of `dalembert ensemble --output DIR`: histograms, clouds, bands. */
#ifndef DAL_CLI_REPORT_ENSEMBLE_H
#define DAL_CLI_REPORT_ENSEMBLE_H

#include "report_page.h"

/* Writes the page of r->directory; returns CLI_DONE, or prints and returns an exit status. */
int report_ensemble(report *r);
/* The page after a command that ended with this exit status; none where members are not done. */
int report_after_ensemble(const char *directory, int status);

#endif
