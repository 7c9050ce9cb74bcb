/* fail_allocation.c - memory that runs out, for a program that is started with LD_PRELOAD.
 *
 * From main on, allocation FAIL_AT (the first is 1) and FAIL_COUNT - 1 after it fail, all after it
 * without FAIL_COUNT; how many there were is written to FAIL_LOG.  Programs that it starts have
 * memory again. */
#include "fail_place.h"
#include <errno.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_long calls;
static long first = -1, last = -1;
static int is_on;

static long number(const char *name, long otherwise)
{
    const char *text = getenv(name);
    return text ? strtol(text, NULL, 10) : otherwise;
}

/* Runs after the beginnings of the libraries, which have no way to fail but their own. */
__attribute__((constructor)) static void begin(void)
{
    first = number("FAIL_AT", 0);
    last = first > 0 ? first + number("FAIL_COUNT", INT32_MAX) - 1 : 0;
    unsetenv("LD_PRELOAD");
    fail_places_begin();
    is_on = 1;
}

__attribute__((destructor)) static void end(void)
{
    const char *path = getenv("FAIL_LOG");
    is_on = 0;
    FILE *log = path ? fopen(path, "w") : NULL;
    if (!log) return;
    fprintf(log, "%ld\n", (long)calls);
    fail_places_print(log);
    fclose(log);
}

static int refuses(void)
{
    if (!is_on || is_noting) return 0;
    const long call = ++calls;
    if (first == 0) fail_places_note(call);
    if (call < first || call > last) return 0;
    errno = ENOMEM;
    return 1;
}

void *malloc(size_t size) { return refuses() ? NULL : __libc_malloc(size); }

void *calloc(size_t count, size_t size) { return refuses() ? NULL : __libc_calloc(count, size); }

void *realloc(void *memory, size_t size) { return refuses() ? NULL : __libc_realloc(memory, size); }

void *aligned_alloc(size_t alignment, size_t size)
{
    return refuses() ? NULL : __libc_memalign(alignment, size);
}
