/* pool.c - memory that is freed all at once. */
#include "core/pool.h"
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct dal__pool_block {
    struct dal__pool_block *next;
    max_align_t memory[];
};

void *dal__pool_allocate(dal__pool *pool, size_t count, size_t size)
{
    struct dal__pool_block *block = NULL;
    const size_t max = SIZE_MAX - sizeof *block;
    if (size == 0 || count <= max / size) block = calloc(1, sizeof *block + count * size);
    if (!block) {
        pool->out_of_memory = true;
        return NULL;
    }
    block->next = pool->blocks;
    pool->blocks = block;
    return block->memory;
}

char *dal__pool_text(dal__pool *pool, const char *text, size_t length)
{
    char *copy = length < SIZE_MAX ? dal__pool_allocate(pool, length + 1, 1) : NULL;
    if (copy && length > 0) memcpy(copy, text, length);
    return copy;
}

void dal__pool_free(dal__pool *pool)
{
    for (struct dal__pool_block *block = pool->blocks, *next; block; block = next) {
        next = block->next;
        free(block);
    }
    *pool = (dal__pool){.blocks = NULL};
}
