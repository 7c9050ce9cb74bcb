/* report_study.h - the page of a study. */
#ifndef DAL_CLI_REPORT_STUDY_H
#define DAL_CLI_REPORT_STUDY_H

#include "report_page.h"

/* Returns CLI_DONE or prints and returns an exit status. */
int report_study(report *r);

#endif
