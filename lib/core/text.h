/* text.h - a text that grows, for what writes C. */
#ifndef DAL_TEXT_H
#define DAL_TEXT_H

#include "core/error.h"
#include <stdbool.h>
#include <stddef.h>

/* Begins as {0}; bytes always ends in a NUL once something was added.  When memory is out it
 * remembers that, and whatever is added later is lost. */
typedef struct dal__text {
    char *bytes;
    size_t length, capacity;
    bool out_of_memory;
} dal__text;

void dal__text_free(dal__text *text);
void dal__text_add(dal__text *text, const char *bytes, size_t length);
void dal__text_put(dal__text *text, const char *string);
/* No floating point: that would follow the locale. */
void dal__text_print(dal__text *text, const char *format, ...) DAL__PRINTF(2, 3);
/* x as a C constant with the same bits: an integer as a decimal one, others in hexadecimal; not
 * finite: INFINITY, -INFINITY, NAN.  Negative ones in parentheses. */
void dal__text_number(dal__text *text, double x);

#endif
