/* file.h - files and directories, and the numbers and texts of CSV. */
#ifndef DAL_CLI_FILE_H
#define DAL_CLI_FILE_H

#include "ui/options.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* The bytes of a file and a NUL, allocated; NULL after a message. */
char *file_read(const char *path, size_t *length);
bool file_exists(const char *path);
/* Whether a file has exactly these bytes, or those of another. */
bool file_equals(const char *path, const void *bytes, size_t length);
bool file_is_copy(const char *path, const char *other);
/* Whether two paths lead to one file or directory. */
bool file_is_same(const char *path, const char *other);
/* Writes a file; renames one.  With sync they wait until that is on the disk, so that it outlives
 * a power cut and not only the process. */
int file_write(const char *path, const void *bytes, size_t length, int sync);
int file_rename(const char *from, const char *to, int sync);
/* Writes a file that is not there yet.  Returns CLI_DONE, or prints and returns CLI_USAGE or
 * CLI_IO. */
int file_create(const char *path, const void *bytes, size_t length);
/* Writes PATH.new and renames it, so that PATH is never half written.  Return CLI_DONE or print and
 * return CLI_IO. */
int file_replace(const char *path, const void *bytes, size_t length, int sync);
int file_copy(const char *from, const char *to, int sync);
/* Removes a file that may be absent. */
int file_remove(const char *path);

/* FNV-1a, 64 bits, going on from hash. */
#define FILE_HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t file_hash(uint64_t hash, const void *bytes, size_t length);

/* Writes x with 17 digits, as a double reads it back; minus zero as 0. */
void cli_put(FILE *out, double x);
/* The same, and nothing where x is NaN: a cell of a CSV file is empty where there is no value. */
void cli_put_known(FILE *out, double x);
/* Writes a cell of a CSV file; one with a comma or a quote in it is quoted, as RFC 4180 has it.
 * Control characters become blanks, so that a row is a line. */
void cli_put_text(FILE *out, const char *text);
int cli_ends_in(const char *text, const char *ending);
/* Makes a directory unless it is there.  Returns CLI_DONE or prints and returns CLI_IO. */
int cli_directory(const char *path);
/* The same for an output, and says on stderr that it is a directory. */
int cli_output_directory(const char *path);
/* Whether an output is a directory: not "-", no .csv or .npy, no device and no pipe. */
bool cli_is_directory(const char *output);
/* Stores the text of an option --output, whose value names what it may be: FILE, FILE.csv, DIR.
 * Another ending than .csv and .npy is an error, but for what exists and is no plain file. */
cli_parser cli_parse_output;
/* "DIR/NAME", allocated. */
char *cli_join(const char *directory, const char *name);

#endif
