/* memory.c - the memory of the program.
 *
 * Only this file of the program allocates; where memory runs out, the program ends (message.h). */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* fopencookie */
#endif
#include "memory.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

bool cli_is_ok(dal_status status)
{
    if (status == DAL_STATUS_MEMORY) cli_out_of_memory();
    return status == DAL_STATUS_OK;
}

static void *checked(void *memory)
{
    if (!memory) cli_out_of_memory();
    return memory;
}

void *cli_malloc(size_t size) { return checked(malloc(size ? size : 1)); }

void *cli_calloc(size_t count, size_t size)
{
    return checked(calloc(count ? count : 1, size ? size : 1));
}

void *cli_realloc(void *memory, size_t size) { return checked(realloc(memory, size ? size : 1)); }

char *cli_strdup(const char *text) { return checked(strdup(text)); }

char *cli_strndup(const char *text, size_t length) { return checked(strndup(text, length)); }

char *cli_format_list(const char *format, va_list list)
{
    va_list again;
    va_copy(again, list);
    const int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    if (length < 0) cli_out_of_memory();
    char *text = cli_malloc((size_t)length + 1);
    vsnprintf(text, (size_t)length + 1, format, list);
    return text;
}

char *cli_format(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    char *text = cli_format_list(format, list);
    va_end(list);
    return text;
}

/* ---- texts that are written as files ------------------------------------------------------- */

/* open_memstream of the C library loses text without an error where memory runs out. */
typedef struct memstream {
    char **text;
    size_t *length, capacity;
    bool failed;
} memstream;

static bool reserve(memstream *m, size_t capacity)
{
    if (capacity <= m->capacity) return true;
    if (capacity < 2 * m->capacity) capacity = 2 * m->capacity;
    char *text = realloc(*m->text, capacity);
    if (!text) return false;
    *m->text = text;
    m->capacity = capacity;
    return true;
}

/* The program cannot end within a function of stdio: exit would write to the file again. */
static ssize_t append(void *cookie, const char *bytes, size_t length)
{
    memstream *m = cookie;
    if (m->failed || !reserve(m, *m->length + length + 1)) {
        m->failed = true;
        errno = ENOMEM;
        return 0;
    }
    memcpy(*m->text + *m->length, bytes, length);
    *m->length += length;
    (*m->text)[*m->length] = '\0';
    return (ssize_t)length;
}

static int release(void *cookie)
{
    const bool failed = ((memstream *)cookie)->failed;
    free(cookie);
    return failed ? EOF : 0;
}

FILE *cli_memstream_open(char **text, size_t *length)
{
    memstream *m = cli_malloc(sizeof *m);
    *text = cli_calloc(1, 1);
    *length = 0;
    *m = (memstream){.text = text, .length = length, .capacity = 1};
    return checked(fopencookie(m, "w", (cookie_io_functions_t){.write = append, .close = release}));
}

void cli_memstream_close(FILE *out)
{
    if (fclose(out) != 0) cli_out_of_memory();
}
