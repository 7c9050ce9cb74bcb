/* report_section.h - the pages of `section`, `lyapunov` and `volume` with --output DIR. */
#ifndef DAL_CLI_REPORT_SECTION_H
#define DAL_CLI_REPORT_SECTION_H

#include "report_page.h"

/* Return CLI_DONE or print and return an exit status. */
int report_section(report *r);
int report_lyapunov(report *r);
int report_volume(report *r);

#endif
