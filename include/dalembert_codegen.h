/* dalembert_codegen.h - steps compiled for one system and method: as a C file, or within a run.
 *
 * The conventions are those of dalembert.h. */
#ifndef DALEMBERT_CODEGEN_H
#define DALEMBERT_CODEGEN_H

#include "dalembert.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- generated C files --------------------------------------------------------------------- */

/* Writes a self-contained C file that steps this system by this method on this space, lanes (1, 2,
 * 4, 8 or 16) at a time: *text, to be freed with free(); its first comment explains its use.  The
 * bits are those of a run of the same spec.  The system must come from a model, the integrators
 * from the library.  Parameters and start of the spec are the defaults of the file; solver and
 * iterations are fixed in it, the step size is not.  prefix begins every public name (NULL:
 * SYSTEM_METHOD). [alloc]  Errors: as dal_run_create, DAL_ARGUMENT (lanes, prefix),
 * DAL_UNSUPPORTED, DAL_TOO_LARGE (for straight-line code). */
dal_status dal_generate(const dal_run_spec *spec, int lanes, const char *prefix, char **text,
                        dal_error *error);

/* ---- compiled runs and batches ------------------------------------------------------------- */

/* How steps are compiled and where compiled code is cached; 0 and NULL have the stated meaning. */
typedef struct dal_native_options {
    const char *cache;    /* a directory of this user alone (mode 0700); made if missing */
    const char *compiler; /* found along PATH, or a path; NULL: cc */
    int patience;         /* seconds after which a compiler is killed; 0: 60 */
    int (*stop)(void *);  /* called often while a compiler runs: not 0 kills it; NULL: never */
    void *user;           /* the argument of stop */
} dal_native_options;

/* Compiles the steps of a run: generates them, compiles them for this machine and loads them, or
 * takes them from the cache.  Bits, checkpoints and errors stay the same; on failure the run
 * continues without compiled code.  Only these functions of the library start a process and write
 * files.  The run must be freed by dal_run_free, which unloads the code, even after dal_run_init.
 * [alloc]  Errors: DAL_UNSUPPORTED (no compiler, it failed or timed out; or as dal_generate),
 * DAL_IO (cache), DAL_ARGUMENT (no cache named), DAL_TOO_LARGE, DAL_MEMORY, DAL_INTERRUPTED (by
 * stop). */
dal_status dal_run_native(dal_run *run, const dal_native_options *options, dal_error *error);
/* Whether the steps of a run are compiled. */
int dal_run_is_native(const dal_run *run);

/* Compiles the observables for dal_observer.values: many states at a time, with the same bits.
 * Independent of dal_run_native.  [alloc]  Errors: as there; DAL_TOO_LARGE where straight-line code
 * would be too long. */
dal_status dal_run_native_observables(dal_run *run, const dal_native_options *options,
                                      dal_error *error);

/* Compiles the steps of a batch: all its lanes, as many at a time as the machine favours.  [alloc]
 * Errors: as dal_run_native. */
dal_status dal_batch_native(dal_batch *batch, const dal_native_options *options, dal_error *error);
/* Whether the steps of a batch are compiled. */
int dal_batch_is_native(const dal_batch *batch);

#ifdef __cplusplus
}
#endif
#endif
