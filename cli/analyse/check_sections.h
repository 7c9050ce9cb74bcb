/* check_sections.h - the sections of the report of `dalembert check`. */
#ifndef DAL_CLI_CHECK_SECTIONS_H
#define DAL_CLI_CHECK_SECTIONS_H

#include "check_items.h"

/* In their order.  Each prints items, or none where it does not apply to the system. */
enum { CHECK_SECTIONS = 9 };
extern const struct check_section {
    const char *title;
    void (*examine)(check *c);
} check_sections[CHECK_SECTIONS];

#endif
