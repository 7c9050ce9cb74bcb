/* cache.h - compiled code in a private directory. */
#ifndef DAL_GENERATE_CACHE_H
#define DAL_GENERATE_CACHE_H

#include "core/error.h"
#include "dalembert_codegen.h"
#include <stdint.h>

enum { DAL__OBJECT_PATH = 1024 };

/* The way from a text to a shared object compiled for this machine. */
typedef struct dal__compilation {
    char path[DAL__OBJECT_PATH]; /* of the object, once no compiler runs */
    /* While a compiler runs: a folder for it alone, with source, object and temporary files. */
    char folder[DAL__OBJECT_PATH + 40];
    char source[DAL__OBJECT_PATH + 60], object[DAL__OBJECT_PATH + 60];
    char compiler[DAL__OBJECT_PATH];
    int patience, nice;
    double last;  /* when the compiler is ended, by the clock */
    int lock;     /* the source, locked until the compiler and this process let go of it */
    long process; /* the compiler; 0: none runs */
} dal__compilation;

/* Whether the cache has objects of a key, which texts that are likely the same have in common.
 * Takes less time than making a text. */
bool dal__compilation_is_likely(const dal_native_options *options, uint64_t key);
/* Finds the object in the cache, or else starts a compiler.  Errors: DAL_STATUS_ARGUMENT,
 * DAL_STATUS_IO (cache), DAL_STATUS_UNSUPPORTED (no compiler, or only_cached). */
dal_status dal__compilation_begin(dal__compilation *c, const dal_native_options *options,
                                  uint64_t key, const char *text, dal_error *error);
/* Loads the object, if it is whole, a regular file of this user, and not writable by others: a
 * handle of dlopen, or NULL. */
void *dal__compilation_load(const dal__compilation *c);
/* Removes an object that could not be loaded; repeat then starts a compiler again. */
void dal__compilation_forget(const dal__compilation *c);
dal_status dal__compilation_repeat(dal__compilation *c, const char *text, dal_error *error);
/* DAL_STATUS_OK with c->process == 0: the object is there; with another: the compiler runs.
 * Errors: DAL_STATUS_UNSUPPORTED (the compiler failed or hung), DAL_STATUS_IO (cache). */
dal_status dal__compilation_poll(dal__compilation *c, dal_error *error);
/* Ends a compiler that runs, with all that it started, and removes its folder. */
void dal__compilation_end(dal__compilation *c);
/* Waits for a millisecond. */
void dal__compilation_pause(void);

#endif
