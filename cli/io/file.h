/* file.h - files and directories. */
#ifndef DAL_CLI_FILE_H
#define DAL_CLI_FILE_H

#include "ui/options.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

/* The bytes of a file and a NUL, allocated; NULL after a message. */
char *file_read(const char *path, size_t *length);
bool file_exists(const char *path);
/* Whether a directory holds something of that name. */
bool file_is_in(const char *directory, const char *name);
/* Whether a file has exactly these bytes, or the same as another. */
int file_equals(const char *path, const void *bytes, size_t length, bool *is_same);
int file_is_copy(const char *path, const char *other, bool *is_same);
/* Whether two paths lead to one file or directory. */
bool file_is_same(const char *path, const char *other);
/* Whether a function waits until what it wrote is on the disk, so that it outlives a power cut and
 * not only the process. */
typedef enum file_sync { FILE_UNSYNCED, FILE_SYNCED } file_sync;
/* Writes a file; renames one. */
int file_write(const char *path, const void *bytes, size_t length, file_sync sync);
int file_rename(const char *from, const char *to, file_sync sync);
/* The two halves: writes and closes a descriptor of the file `path`; waits for what was renamed. */
int file_write_and_close(int descriptor, const char *path, const void *bytes, size_t length,
                         file_sync sync);
void file_sync_directory(const char *path);

/* Reads or writes at a place of a file; returns how many bytes were transferred for sure, fewer
 * than length after an error or at the end of the file. */
typedef enum file_way { FILE_READ, FILE_WRITE } file_way;
size_t file_transfer(int descriptor, void *bytes, size_t length, off_t place, file_way way);

/* Removes a file that may be absent. */
int file_remove(const char *path);

bool cli_ends_in(const char *text, const char *ending);
/* Makes a directory unless it is there.  Returns CLI_DONE or prints and returns CLI_IO. */
int file_make_directory(const char *path);
/* Returns CLI_DONE where a directory is there, else prints and returns CLI_USAGE. */
int file_find_directory(const char *path);
/* What is in a directory, by name.  Returns CLI_DONE, or prints and returns an exit status; to be
 * freed in any case. */
typedef struct file_names {
    char **name; /* [count] */
    int count;
} file_names;
int file_list(const char *path, file_names *names);
void file_free_names(file_names *names);
/* Whether a directory holds results of this program, or nothing, or is not there. */
bool file_owns_directory(const char *path);
/* Returns CLI_DONE for such a directory, else prints and returns CLI_USAGE: others are written into
 * with --force alone. */
int file_check_directory(const char *path);
/* Says on stderr that results are in a directory, if a command with that exit status has left any.
 */
void file_report_directory(const char *path, int exit_status);
/* Whether an output is a directory: not "-", no .csv or .npy, no device and no pipe. */
bool cli_is_directory(const char *output);
/* Stores the text of an option --output, whose value names what it may be: FILE, FILE.csv, DIR.
 * Another ending than .csv and .npy is an error, except for what exists and is no plain file. */
cli_parser cli_parse_output;
/* "DIR/NAME", allocated. */
char *cli_join(const char *directory, const char *name);

#endif
