/* tar.h - an archive of files, as tar reads it (POSIX ustar), without compression.
 *
 * Owners and times are left out, so that equal files make equal archives. */
#ifndef DAL_CLI_TAR_H
#define DAL_CLI_TAR_H

#include <stddef.h>
#include <stdio.h>

/* Adds a file of these bytes, or a copy of a file at path.  Return CLI_DONE, or print and return
 * CLI_USAGE where the name is too long, CLI_IO where the file cannot be read; errors of out are for
 * who closes it. */
int tar_add(FILE *out, const char *name, const void *bytes, size_t length);
int tar_add_file(FILE *out, const char *name, const char *path);
/* Ends the archive. */
void tar_end(FILE *out);

#endif
