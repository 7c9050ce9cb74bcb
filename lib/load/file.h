/* file.h - reads files on disk. */
#ifndef DAL_LOAD_FILE_H
#define DAL_LOAD_FILE_H

#include "dalembert_status.h"

/* The bytes of a file, up to one more than DAL__MAX_BYTES; NULL after an error, DAL_STATUS_IO or
 * DAL_STATUS_MEMORY. [alloc] */
char *dal__read_file(const char *path, size_t *length, dal_error *error);
/* The length of the byte order mark that a text begins with, which is no part of it; or 0. */
size_t dal__mark_length(const char *text, size_t length);

#endif
