/* report_section.h - the page of `dalembert section --output DIR`. */
#ifndef DAL_CLI_REPORT_SECTION_H
#define DAL_CLI_REPORT_SECTION_H

#include "report_page.h"

/* Returns CLI_DONE or prints and returns an exit status. */
int report_section(report *r);

#endif
