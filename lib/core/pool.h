/* pool.h - memory that is freed all at once. */
#ifndef DAL_CORE_POOL_H
#define DAL_CORE_POOL_H

#include <stdbool.h>
#include <stddef.h>

/* Blocks of memory; begins as {0}. */
typedef struct dal__pool {
    struct dal__pool_block *blocks;
    bool out_of_memory; /* an allocation failed */
} dal__pool;

/* count*size bytes of zeros that are freed with the pool; NULL, and out_of_memory is set, when
 * there are none. [alloc] */
void *dal__pool_allocate(dal__pool *pool, size_t count, size_t size);
/* A copy of a text, of length bytes; NULL likewise. [alloc] */
char *dal__pool_text(dal__pool *pool, const char *text, size_t length);
/* Frees the blocks; the pool is as at first. */
void dal__pool_free(dal__pool *pool);

#endif
