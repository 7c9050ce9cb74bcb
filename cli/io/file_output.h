/* file_output.h - outputs: one rule for what a user names and for the files of a directory.
 *
 * A regular file is written beside its place, as .NAME.new, and renamed; its symbolic links, owner
 * and permissions stay.  A device, a FIFO or a socket is opened and written, /dev/stdout and
 * /dev/fd/N are these descriptors, and a directory is an error.  The functions print what fails. */
#ifndef DAL_CLI_FILE_OUTPUT_H
#define DAL_CLI_FILE_OUTPUT_H

#include "file.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Writes all at once: a file is old or new and never half of either.  Return CLI_DONE or CLI_IO. */
int file_replace(const char *path, const void *bytes, size_t length, file_sync sync);
int file_copy(const char *from, const char *to, file_sync sync);
/* The same piece by piece, "-" being standard output. */
typedef struct file_output {
    FILE *stream;
    const char *name; /* as it was given */
    char *path;       /* what its symbolic links lead to */
    char *fresh;      /* a file beside that, to be renamed to it; NULL: it is written in place */
} file_output;
int file_output_open(file_output *output, const char *path);
/* Closes it after the status CLI_DONE; after another the file that was there stays.  Returns the
 * status, or the status of closing. */
int file_output_close(file_output *output, int status);
/* For rows, which can be read while they are written: the new, empty file has its name from the
 * beginning.  A descriptor; and a stream, "-" being stdout, NULL after a failure.  Return an exit
 * status. */
int file_open_output(const char *path, int *descriptor);
int file_stream_output(const char *path, FILE **stream);
/* Writes a file that is not there yet, or a device.  Returns CLI_DONE, CLI_USAGE or CLI_IO. */
int file_create(const char *path, const void *bytes, size_t length);

#endif
