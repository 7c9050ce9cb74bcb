/* file.h - whole files: read, replace, recognise. */
#ifndef DAL_CLI_FILE_H
#define DAL_CLI_FILE_H

#include "cli.h"

#include <stdint.h>

/* The bytes of a file and a NUL, allocated; NULL after a message. */
char *file_read(const char *path, size_t *length);
/* Writes a file and brings it to the disk; renames one, and brings that to the disk. */
int file_write(const char *path, const void *bytes, size_t length);
int file_rename(const char *from, const char *to);
/* Writes PATH.new, brings it to the disk and renames it, so that PATH is never half written.
 * Returns CLI_DONE or prints and returns CLI_IO. */
int file_replace(const char *path, const void *bytes, size_t length);
/* Removes a file that may be absent. */
int file_remove(const char *path);

/* FNV-1a, 64 bits, going on from hash. */
#define FILE_HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t file_hash(uint64_t hash, const void *bytes, size_t length);

#endif
