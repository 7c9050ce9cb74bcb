/* dalembert_codegen.h - steps compiled for one system and method, as a C file or within a run; and
 * equations typeset.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_CODEGEN_H
#define DALEMBERT_CODEGEN_H

#include "dalembert.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- generated C files --------------------------------------------------------------------- */

/* What a generated file has; 0 and NULL have the stated meaning. */
typedef struct dal_generate_options {
    int lanes;          /* systems at a time: 1, 2, 4, 8 or 16; 0: 1 */
    const char *prefix; /* begins every public name; NULL: SYSTEM_METHOD */
    bool with_field;    /* functions of a point, too: PREFIX_field, .._jacobian, .._constraint and
                           .._energy, which fill out as the callbacks field, jacobian, constraint
                           and energy_normal of a system do */
} dal_generate_options;

/* Writes a self-contained C file that steps this system by this method on this space: *text, to be
 * freed with free(); its first comment explains its use.  It gives the bits of a run of the same
 * spec.  The system must come from a model, the integrators from the library.  Parameters and start
 * of the spec are the defaults of the file; solver and iterations are fixed in it, the step size is
 * not.  options may be NULL. [alloc]  Errors: as dal_run_create, DAL_STATUS_ARGUMENT (lanes,
 * prefix), DAL_STATUS_UNSUPPORTED, DAL_STATUS_TOO_LARGE (Newton's matrices, or a Jacobian). */
dal_status dal_generate(const dal_run_spec *spec, const dal_generate_options *options, char **text,
                        dal_error *error);

/* ---- equations typeset --------------------------------------------------------------------- */

/* Writes the equations of a model as LaTeX, one align* of amsmath: the Lagrangian L, forces Q, the
 * holonomic constraints C = 0 and all constraints D = 0, the accelerations F derived from them and
 * the multipliers h of C, what several of these share as s_1, s_2, .., and the Hamiltonian H of the
 * lift; *text, to be freed with free().  Names as theta1
 * become Greek letters with subscripts. [alloc]  Errors: as dal_model_system;
 * DAL_STATUS_TOO_LARGE where a formula is longer than a megabyte. */
dal_status dal_model_latex(dal_model *model, char **text, dal_error *error);

/* Writes the equations of dal_model_latex as MathML, a math element with a table of them, for pages
 * and for XML; *text, to be freed with free(). [alloc]  Errors: as dal_model_latex;
 * DAL_STATUS_TOO_LARGE, too, where brackets and scripts are nested more than 400 deep. */
dal_status dal_model_mathml(dal_model *model, char **text, dal_error *error);

/* ---- compiled runs and batches ------------------------------------------------------------- */

/* How steps are compiled and where compiled code is cached; 0 and NULL have the stated meaning. */
typedef struct dal_native_options {
    const char *cache;    /* a directory of this user alone (mode 0700); made if missing */
    const char *compiler; /* found along PATH, or a path; NULL: cc */
    int patience;         /* seconds after which a compiler is killed; 0: 60 */
    int nice;             /* by how much its priority is lower, 0..19 */
    bool (*stop)(void *); /* called often while a compiler runs: true kills it; NULL: never */
    void *user;           /* the argument of stop */
    bool only_cached;     /* no compiler is started: code that is not there is unsupported */
} dal_native_options;

/* Compiles the steps of a run: generates them, compiles them for this machine and loads them, or
 * takes them from the cache.  Bits, checkpoints and errors stay the same; on failure the run
 * continues without compiled code.  Only these functions of the library start a process and write
 * files.  The run must be freed by dal_run_free, which unloads the code, even after dal_run_init.
 * [alloc]  Errors: DAL_STATUS_UNSUPPORTED (no compiler, it failed or timed out; or as
 * dal_generate), DAL_STATUS_IO (cache), DAL_STATUS_ARGUMENT (no cache named), DAL_STATUS_TOO_LARGE,
 * DAL_STATUS_MEMORY, DAL_STATUS_INTERRUPTED (by stop). */
dal_status dal_run_native(dal_run *run, const dal_native_options *options, dal_error *error);
/* Whether the steps of a run are compiled. */
bool dal_run_is_native(const dal_run *run);

/* Compiles the observables for dal_observer.values: many states at a time, with the same bits.
 * Independent of dal_run_native.  [alloc]  Errors: as there. */
dal_status dal_run_native_observables(dal_run *run, const dal_native_options *options,
                                      dal_error *error);

/* Compiles the steps of a batch: all its lanes, as many at a time as the machine favours.  [alloc]
 * Errors: as dal_run_native. */
dal_status dal_batch_native(dal_batch *batch, const dal_native_options *options, dal_error *error);
/* Whether the steps of a batch are compiled. */
bool dal_batch_is_native(const dal_batch *batch);

/* ---- compiled while a run is interpreted ---------------------------------------------------- */

/* Compiled code, while a compiler makes it and when it is there.  A run that changes over to it
 * between two steps, wherever that is, keeps its bits, checkpoints and errors:
 *
 *     dal_native *native = NULL;
 *     dal_native_begin(&native, run, &options, &error);
 *     while (dal_run_time(run) < T && dal_run_advance(run, 1000, &error) == DAL_STATUS_OK)
 *         if (native && dal_native_poll(native, &error) == DAL_NATIVE_READY)
 *             dal_run_use_native(run, native, &error);
 *     dal_run_free(run);
 *     dal_native_free(native);
 *
 * Several runs may use one, which must outlive them; the system must outlive it.  It is used by one
 * thread at a time, except the steps of the runs. */
typedef struct dal_native dal_native;

/* How far it is. */
typedef enum dal_native_state {
    DAL_NATIVE_PENDING, /* a compiler runs */
    DAL_NATIVE_READY,
    DAL_NATIVE_FAILED
} dal_native_state;

/* Begins to compile the steps of a run, and returns without waiting; stop is not called.  They fit
 * all runs of the same system, method and options, the step size excepted.  [alloc]  Errors: as
 * dal_run_native, except what the compiler does. */
dal_status dal_native_begin(dal_native **native, const dal_run *run,
                            const dal_native_options *options, dal_error *error);
/* The same for dal_run_native_observables.  They fit all runs of the same system on that space. */
dal_status dal_native_begin_observables(dal_native **native, const dal_run *run,
                                        const dal_native_options *options, dal_error *error);
/* The same for dal_batch_native. */
dal_status dal_native_begin_batch(dal_native **native, const dal_batch *batch,
                                  const dal_native_options *options, dal_error *error);
/* How far it is, without waiting; loads it when the compiler has ended.  *error is set where it has
 * failed: DAL_STATUS_UNSUPPORTED (the compiler failed or timed out), DAL_STATUS_IO (cache). */
dal_native_state dal_native_poll(dal_native *native, dal_error *error);
/* Whether a run could use it, when it is ready. */
bool dal_native_fits(const dal_native *native, const dal_run *run);
/* Takes the steps, or evaluates the observables, by compiled code from now on.  May be called by
 * what observes the run.  [alloc]  Errors: DAL_STATUS_ARGUMENT (it is not ready, or does not fit),
 * DAL_STATUS_MEMORY (of observables). */
dal_status dal_run_use_native(dal_run *run, const dal_native *native, dal_error *error);
/* The same for a batch, between two calls of dal_batch_advance.  [alloc]  Errors:
 * DAL_STATUS_ARGUMENT, DAL_STATUS_MEMORY. */
dal_status dal_batch_use_native(dal_batch *batch, const dal_native *native, dal_error *error);
/* Ends the compiler, or unloads the code. */
void dal_native_free(dal_native *native);

#ifdef __cplusplus
}
#endif
#endif
