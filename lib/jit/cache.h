/* cache.h - compiled code in a private directory. */
#ifndef DAL_GENERATE_CACHE_H
#define DAL_GENERATE_CACHE_H

#include "core/error.h"
#include "dalembert_codegen.h"

/* The path of a shared object compiled from the text for this machine, in path[size]: one that the
 * cache already holds, or made now.  Errors: DAL_ARGUMENT, DAL_IO (cache), DAL_UNSUPPORTED (no
 * compiler, it failed or hung), DAL_MEMORY. */
dal_status dal__cache_object(const dal_native_options *options, const char *text, char *path,
                             size_t size, dal_error *error);
/* Removes an object that could not be loaded. */
void dal__cache_forget(const char *path);

#endif
