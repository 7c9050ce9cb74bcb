/* allocation.c - malloc, calloc, realloc and aligned_alloc of the tests (linked with --wrap). */
#include "allocation.h"

#include <stddef.h>

static _Thread_local long asked, left = -1;
static _Thread_local int failed;

void allocation_fail_after(long count)
{
    asked = 0;
    left = count;
    failed = 0;
}

int allocation_failed(void) { return failed; }

long allocation_count(void) { return asked; }

static int refuse(void)
{
    asked++;
    if (left < 0) return 0;
    if (left > 0) return left--, 0;
    return failed = 1;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);

void *__wrap_malloc(size_t size) { return refuse() ? NULL : __real_malloc(size); }

void *__wrap_calloc(size_t count, size_t size)
{
    return refuse() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size)
{
    return refuse() ? NULL : __real_realloc(memory, size);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return refuse() ? NULL : __real_aligned_alloc(alignment, size);
}
