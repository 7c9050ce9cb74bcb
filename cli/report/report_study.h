/* report_study.h - the page of a study. */
#ifndef DAL_CLI_REPORT_STUDY_H
#define DAL_CLI_REPORT_STUDY_H

#include "report_page.h"
#include "ui/options.h"

/* Returns CLI_DONE or prints and returns an exit status. */
int report_study(report *r);
/* The row of --no-page, a bool. */
#define REPORT_NO_PAGE_OPTION(settings)                                                            \
    {                                                                                              \
        "no-page", NULL, NULL, "writes no page of the study", CLI_FLAG(settings, no_page)          \
    }
typedef enum report_naming { REPORT_UNNAMED, REPORT_NAMED } report_naming;

/* After a study that ended with this exit status: writes its page, and says where it is if
 * it is to be named.  Returns that status, or the page's where the page failed. */
int report_after_study(const char *directory, int status, report_naming naming);

#endif
