/* dalembert_codegen.h - steps compiled for one system and method: as a C file, or within a run.
 *
 * The conventions are those of dalembert.h. */
#ifndef DALEMBERT_CODEGEN_H
#define DALEMBERT_CODEGEN_H

#include "dalembert.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes one self-contained C file that steps this system by this method on this space, lanes (1,
 * 2, 4, 8 or 16) at a time: *text, to be freed with free(); its first comment says how to call it.
 * The bits are those of a run of the same spec.  The system must be that of a model, the
 * integrators those of the library.  Parameters and start of the spec are the defaults of the file;
 * solver and iterations are fixed in it, the step is not.  prefix begins every public name (NULL:
 * SYSTEM_METHOD). [alloc]  Errors: as dal_run_create, DAL_ARGUMENT (lanes, prefix),
 * DAL_UNSUPPORTED, DAL_TOO_LARGE (for straight-line code). */
dal_status dal_generate(const dal_run_spec *spec, int lanes, const char *prefix, char **text,
                        dal_error *error);

/* How steps are compiled and where they are kept; what is 0 or NULL is as said here. */
typedef struct dal_native_options {
    const char *cache;    /* a directory; made if it is missing; must be of this user alone */
    const char *compiler; /* found along PATH, or a path; NULL: cc */
    int patience;         /* seconds after which a compiler is ended; 0: 60 */
    int (*stop)(void *);  /* called often while a compiler runs: not 0 ends it; NULL: never */
    void *user;           /* the argument of stop */
} dal_native_options;

/* Lets a run step by compiled code from now on: its steps are generated, compiled for this machine
 * and loaded, or taken from the cache.  Bits, checkpoints and errors stay the same; so on failure
 * the run just goes on as before.  Starts a process and writes files, which nothing else here does;
 * frees its code with the run, which must then be freed even when it was placed by dal_run_init.
 * [alloc]  Errors: DAL_UNSUPPORTED (no compiler, it failed or hung; or as dal_generate), DAL_IO
 * (cache), DAL_ARGUMENT (no cache named), DAL_TOO_LARGE, DAL_MEMORY, DAL_INTERRUPTED (by stop). */
dal_status dal_run_native(dal_run *run, const dal_native_options *options, dal_error *error);
int dal_run_is_native(const dal_run *run);

/* Compiles the observables too, for dal_observer.values: many looks at a time, with the same bits.
 * They are another object than the steps, which may be compiled or not.  [alloc]  Errors: as above,
 * DAL_TOO_LARGE where straight-line code would be too long. */
dal_status dal_run_native_observables(dal_run *run, const dal_native_options *options,
                                      dal_error *error);

/* Steps for a batch: all its lanes, as many at a time as suit the machine. */
dal_status dal_batch_native(dal_batch *batch, const dal_native_options *options, dal_error *error);
int dal_batch_is_native(const dal_batch *batch);

#ifdef __cplusplus
}
#endif
#endif
