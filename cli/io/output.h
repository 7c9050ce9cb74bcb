/* output.h - writing numbers and files. */
#ifndef DAL_CLI_OUTPUT_H
#define DAL_CLI_OUTPUT_H

#include <stdbool.h>
#include <stdio.h>

/* Writes x with 17 digits, as a double reads it back; minus zero as 0. */
void cli_put(FILE *out, double x);
/* Writes a cell of a CSV file; one with a comma or a quote in it is quoted, as RFC 4180 has it. */
void cli_put_text(FILE *out, const char *text);
int cli_ends_in(const char *text, const char *ending);
/* Makes a directory unless it is there.  Returns CLI_DONE or prints and returns CLI_IO. */
int cli_directory(const char *path);
/* Whether an output is a directory: not "-", no .csv or .npy, no device and no pipe. */
bool cli_is_directory(const char *output);
/* "DIR/NAME", allocated. */
char *cli_join(const char *directory, const char *name);

#endif
