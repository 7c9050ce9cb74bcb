/* buffer.h - a string buffer, for what writes C. */
#ifndef DAL_BUFFER_H
#define DAL_BUFFER_H

#include "core/error.h"
#include <stdbool.h>
#include <stddef.h>

/* Begins as {0}; bytes always ends in a NUL once something was added.  When memory is out,
 * out_of_memory is set and further additions are ignored. */
typedef struct dal__buffer {
    char *bytes;
    size_t length, capacity;
    bool out_of_memory;
} dal__buffer;

/* Frees the bytes; the buffer is as at first. */
void dal__buffer_free(dal__buffer *buffer);
/* Appends bytes; a string. [alloc] */
void dal__buffer_append_bytes(dal__buffer *buffer, const char *bytes, size_t length);
void dal__buffer_append(dal__buffer *buffer, const char *string);
/* No floating point: that would follow the locale. */
void dal__buffer_print(dal__buffer *buffer, const char *format, ...) DAL__PRINTF(2, 3);
/* x as a C constant with the same bits: an integer as a decimal one, others in hexadecimal; not
 * finite: INFINITY, -INFINITY, NAN.  Negative ones in parentheses. */
void dal__buffer_number(dal__buffer *buffer, double x);

#endif
