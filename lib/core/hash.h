/* hash.h - FNV-1a with 64 bits (Fowler, Noll, Vo; draft-eastlake-fnv). */
#ifndef DAL_CORE_HASH_H
#define DAL_CORE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define DAL__HASH_START UINT64_C(0xcbf29ce484222325)

/* Continues a hash by these bytes. */
static inline uint64_t dal__hash(uint64_t hash, const void *bytes, size_t length)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < length; i++) hash = (hash ^ byte[i]) * UINT64_C(0x100000001b3);
    return hash;
}

#endif
