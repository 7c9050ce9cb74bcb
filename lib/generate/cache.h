/* cache.h - compiled steps kept in a private directory; internal to lib/generate. */
#ifndef DAL_GENERATE_CACHE_H
#define DAL_GENERATE_CACHE_H

#include "error.h"

/* The path of a shared object compiled from the text by cc, in path[size]: one that the directory
 * already holds, or made now.  The directory is made if it is missing; it must belong to this user
 * alone.  Errors: DAL_IO (directory, disk), DAL_UNSUPPORTED (no compiler, or it failed),
 * DAL_MEMORY. */
dal_status dal__cache_object(const char *directory, const char *text, char *path, size_t size,
                             dal_error *error);
/* Forgets an object that could not be loaded. */
void dal__cache_forget(const char *path);

#endif
