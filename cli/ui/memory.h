/* memory.h - memory of the program: without it the program ends. */
#ifndef DAL_CLI_MEMORY_H
#define DAL_CLI_MEMORY_H

#include "message.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

/* Whether a status is DAL_STATUS_OK; ends the program where it is DAL_STATUS_MEMORY. */
bool cli_is_ok(dal_status status);

/* As in the C library, but these never return NULL, not even for 0 bytes. */
void *cli_malloc(size_t size);
void *cli_calloc(size_t count, size_t size);
void *cli_realloc(void *memory, size_t size);
char *cli_strdup(const char *text);
char *cli_strndup(const char *text, size_t length);
/* What printf would print, allocated. */
char *cli_format(const char *format, ...) CLI_PRINTF(1, 2);
char *cli_format_list(const char *format, va_list list) CLI_PRINTF(1, 0);

/* A file whose text is in memory: *text, allocated, and its *length are complete when the file is
 * closed. */
FILE *cli_memstream_open(char **text, size_t *length);
void cli_memstream_close(FILE *out);

#endif
