/* ensemble_run.c - the members of an ensemble, run.
 *
 * A chunk of members is one item of work: a batch is started with them, stepped to each time, and
 * its states are written.  Each thread uses one batch again and again, so that memory does not grow
 * with the number of members. */
#include "ensemble_run.h"
#include "dalembert_codegen.h"
#include "ensemble_statistics.h"
#include "io/json.h"
#include "run/native.h"
#include "run/pool.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <stdlib.h>
#include <time.h>

/* Steps of a batch between two checks whether to stop; seconds between two lines of progress. */
enum { SLICE = 64 };
static const double line_interval = 0.2, json_interval = 1.0;

/* Stages times coordinates, of all steps, from which on steps are compiled: interpreted, each takes
 * some 10 ns, and all together about as long as a compiler. */
static const double worth_compiling = 1e8;

/* What a thread needs for a chunk. */
typedef struct worker {
    dal_ensemble *ensemble;
    double *rows; /* see ensemble_allocate_rows */
    struct worker *next;
} worker;

typedef struct pool_state {
    const ensemble *e;
    ensemble_directory *dir;
    dal_native *native; /* NULL: interpreted */
    worker *idle;
    long long done, members; /* members of this shard that are done, and all of them */
    long long begun;         /* those that were done before */
    double start, shown, saved, interval;
    progress_mode progress;
} pool_state;

/* ---- workers ---- */

static worker *make_worker(const ensemble *e, dal_ensemble *lanes)
{
    worker *w = cli_calloc(1, sizeof *w);
    w->ensemble = lanes;
    w->rows = ensemble_allocate_rows(e);
    return w;
}

/* The compiled steps are used as soon as they are there; a failure is printed once. */
static void use_native(pool_state *p, worker *w)
{
    dal_error error = {0};
    dal_batch *batch = dal_ensemble_batch(w->ensemble);
    if (!p->native || dal_batch_is_native(batch)) return;
    const dal_native_state state = dal_native_poll(p->native, &error);
    if (state == DAL_NATIVE_READY) dal_batch_use_native(batch, p->native, &error);
    if (error.status == DAL_STATUS_OK) return;
    cli_note("steps are interpreted: %s", error.message);
    dal_native_free(p->native);
    p->native = NULL;
}

typedef struct worker_request {
    pool_state *pool;
    worker *worker;
    int status; /* CLI_DONE, or why there is none */
} worker_request;

static void take_worker(void *user)
{
    worker_request *r = user;
    pool_state *p = r->pool;
    dal_error error = {0};
    dal_ensemble *made;
    if (p->idle) {
        r->worker = p->idle;
        p->idle = r->worker->next;
    } else if (cli_is_ok(dal_ensemble_create(&made, &p->e->spec, p->e->vary, p->e->variations,
                                             (unsigned long long)p->e->seed, ENSEMBLE_CHUNK,
                                             &error))) {
        r->worker = make_worker(p->e, made);
    } else {
        r->status = cli_error(CLI_USAGE, p->e->simulation.request.system_name, &error);
        return;
    }
    use_native(p, r->worker);
}

static void write_json_progress(const pool_state *p, double seconds)
{
    const double rest = (double)(p->members - p->done);
    json_writer w = {.out = stderr};
    json_open(&w, NULL, JSON_ON_ONE_LINE);
    json_put_integer(&w, "done", p->done);
    json_put_integer(&w, "members", p->members);
    json_put_number(&w, "seconds", seconds);
    json_put_number(&w, "remaining",
                    rest > 0 ? seconds * rest / (double)(p->done - p->begun) : 0.0);
    json_close(&w);
    fputc('\n', w.out);
}

/* The line of a terminal, or JSON for scripts. */
static void show_members(void *user)
{
    pool_state *p = user;
    const bool is_json = p->progress == PROGRESS_JSON;
    const double now = cli_seconds();
    if (p->progress == PROGRESS_OFF) return;
    if (now - p->shown <= (is_json ? json_interval : line_interval)) return;
    p->shown = now;
    if (is_json)
        write_json_progress(p, now - p->start);
    else
        cli_progress("ensemble: %lld of %lld members, %.0f s", p->done, p->members, now - p->start);
}

static void return_worker(void *user)
{
    const worker_request *r = user;
    r->worker->next = r->pool->idle;
    r->pool->idle = r->worker;
}

static int end_chunk(void *user, int chunk, int status)
{
    pool_state *p = user;
    if (status != CLI_DONE) return status;
    p->dir->marks.done[chunk] = 1;
    p->done += ensemble_chunk_members(p->e, chunk);
    show_members(p);
    if (cli_seconds() - p->saved < p->interval) return CLI_DONE;
    status = ensemble_directory_save(p->dir);
    p->saved = cli_seconds();
    return status;
}

/* ---- chunks ---- */

static int advance(dal_batch *batch, long long steps, const work_stop *stop)
{
    for (; steps > 0; steps -= SLICE) {
        if (stop->stop(stop->user)) return CLI_SIGNAL;
        dal_batch_advance(batch, steps < SLICE ? steps : SLICE);
    }
    return CLI_DONE;
}

/* Writes status, t and what was drawn; started[count]: whether a member had a start. */
static int write_members(const pool_state *p, const worker *w, const bool *started, long long first,
                         int count)
{
    const int drawn = p->e->variations, columns = ensemble_member_columns(p->e);
    dal_batch *batch = dal_ensemble_batch(w->ensemble);
    double *draws = cli_calloc((size_t)(count * drawn), sizeof *draws);
    dal_ensemble_draws(w->ensemble, draws);
    for (int i = 0; i < count; i++) {
        double *row = w->rows + i * columns;
        row[MEMBER_STATUS] = dal_batch_status(batch, i, NULL);
        row[MEMBER_TIME] = started[i] ? dal_batch_time(batch, i) : p->e->spec.start_time;
        for (int k = 0; k < drawn; k++) row[MEMBER_DRAWN + k] = draws[i * drawn + k];
    }
    free(draws);
    return npy_table_write(&p->dir->members, first, count, w->rows);
}

/* Why members failed, where any did. */
static int write_messages(const pool_state *p, const worker *w, int chunk, int count)
{
    dal_batch *batch = dal_ensemble_batch(w->ensemble);
    dal_error error = {0};
    char *text;
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    for (int i = 0; i < count; i++)
        if (dal_batch_status(batch, i, &error) != DAL_STATUS_OK)
            fprintf(out, "%s\n", error.message);
    cli_memstream_close(out);
    const int status =
        length > 0 ? ensemble_directory_write_messages(p->dir, chunk, text) : CLI_DONE;
    free(text);
    return status;
}

static int step_chunk(const pool_state *p, const worker *w, int chunk, const work_stop *stop)
{
    const ensemble *e = p->e;
    const long long first = (long long)chunk * ENSEMBLE_CHUNK;
    const int count = ensemble_chunk_members(e, chunk);
    dal_batch *batch = dal_ensemble_batch(w->ensemble);
    bool started[ENSEMBLE_CHUNK];
    long long step = 0;
    int status = CLI_DONE;
    dal_ensemble_start(w->ensemble, (unsigned long long)first, count);
    for (int i = 0; i < count; i++) started[i] = dal_batch_status(batch, i, NULL) == DAL_STATUS_OK;
    for (int t = 0; t < e->times && status == CLI_DONE; t++) {
        status = advance(batch, e->steps[t] - step, stop);
        step = e->steps[t];
        dal_ensemble_states(w->ensemble, w->rows);
        if (status == CLI_DONE && p->dir->has_rows)
            status = npy_table_write(&p->dir->rows, t * e->members + first, count, w->rows);
    }
    if (status == CLI_DONE) status = npy_table_write(&p->dir->final, first, count, w->rows);
    if (status == CLI_DONE) status = write_members(p, w, started, first, count);
    return status == CLI_DONE ? write_messages(p, w, chunk, count) : status;
}

static bool is_due(void *user, int chunk)
{
    const ensemble_directory *dir = ((pool_state *)user)->dir;
    return store_shard_has(dir->marks.shard, chunk) && !dir->marks.done[chunk];
}

static int run_chunk(void *user, int chunk, const work_stop *stop)
{
    worker_request request = {.pool = user};
    pool_exclude(take_worker, &request);
    if (!request.worker) return request.status;
    const int status = step_chunk(user, request.worker, chunk, stop);
    pool_exclude(return_worker, &request);
    return status;
}

/* ---- all ---- */

/* Begins to compile the steps, and with NATIVE_ON waits for them. */
static void begin_native(pool_state *p, const ensemble_run_options *options)
{
    const ensemble *e = p->e;
    const native_mode mode = options->native;
    const struct timespec pause = {0, 1000000};
    dal_error error = {0};
    const dal_integrator *inner = e->simulation.request.method.layer[0];
    const double stages = inner->stages > 0 ? inner->stages : 1;
    const double cost = (double)(p->members - p->done) / options->processes *
                        (double)e->steps[e->times - 1] * stages * e->spec.system->n;
    if (mode == NATIVE_OFF || (mode == NATIVE_AUTO && cost < worth_compiling)) return;
    char *cache = native_cache();
    const dal_native_options cached = {.cache = cache};
    if (dal_native_begin_batch(&p->native, dal_ensemble_batch(e->first), &cached, &error) !=
        DAL_STATUS_OK) {
        p->native = NULL;
        cli_note("steps are interpreted: %s", error.message);
    }
    free(cache);
    while (mode == NATIVE_ON && p->native && !cli_interrupted() &&
           dal_native_poll(p->native, NULL) == DAL_NATIVE_PENDING)
        nanosleep(&pause, NULL);
}

static void count_members(pool_state *p)
{
    for (int i = 0; i < ensemble_chunks(p->e); i++) {
        if (!store_shard_has(p->dir->marks.shard, i)) continue;
        p->members += ensemble_chunk_members(p->e, i);
        if (p->dir->marks.done[i]) p->done += ensemble_chunk_members(p->e, i);
    }
    p->begun = p->done;
}

static void free_workers(pool_state *p)
{
    while (p->idle) {
        worker *w = p->idle;
        p->idle = w->next;
        dal_ensemble_free(w->ensemble);
        free(w->rows);
        free(w);
    }
    dal_native_free(p->native);
}

int ensemble_run(ensemble *e, ensemble_directory *dir, const ensemble_run_options *options)
{
    pool_state p = {.e = e,
                    .dir = dir,
                    .start = cli_seconds(),
                    .saved = cli_seconds(),
                    .interval = options->interval,
                    .progress = options->progress};
    const work_list list = {.user = &p,
                            .count = ensemble_chunks(e),
                            .is_due = is_due,
                            .run = run_chunk,
                            .end = end_chunk,
                            .show = show_members,
                            .ends_early = true};
    int status = CLI_DONE;
    cli_catch_signals();
    count_members(&p);
    if (p.done < p.members) {
        begin_native(&p, options);
        p.idle = make_worker(e, e->first);
        e->first = NULL;
        status = options->runner(&list, options->threads);
    }
    cli_progress_end();
    if (p.progress == PROGRESS_JSON) /* scripts always get the end */
        write_json_progress(&p, cli_seconds() - p.start);
    free_workers(&p);
    const int saved = ensemble_directory_save(dir);
    if (status != CLI_DONE && status != CLI_SIGNAL) return status;
    return saved == CLI_DONE ? status : saved;
}

int ensemble_end(const ensemble *e, ensemble_directory *dir, int status, int threads)
{
    bool is_complete;
    if (status == CLI_SIGNAL) {
        ensemble_directory_write_manifest(dir, e, STORE_INTERRUPTED);
        return store_interrupt(dir->path);
    }
    /* Of shards that end together one after the other finds all done and writes the same bytes. */
    if (status == CLI_DONE) status = ensemble_directory_lock(dir);
    if (status == CLI_DONE) status = store_update_marks(&dir->marks, &is_complete);
    if (status != CLI_DONE) return status;
    if (is_complete) return ensemble_finish(e, dir, threads);
    cli_note(
        "'%s': other shards are not done; 'dalembert merge' joins shards of several directories",
        dir->path);
    return CLI_DONE;
}

/* Runs what remains of a shard. */
static int resume_shard(ensemble *e, ensemble_directory *dir, store_shard shard,
                        const ensemble_run_options *options)
{
    const char *path = dir->path;
    int status = CLI_DONE;
    if (!e->first) { /* the run of another shard has used it */
        ensemble_free(e);
        ensemble_directory_close(dir);
        ensemble_directory_open(dir, path);
        status = ensemble_directory_read(dir, e);
    }
    if (status == CLI_DONE) status = ensemble_directory_attach(dir, e, shard);
    return status == CLI_DONE ? ensemble_run(e, dir, options) : status;
}

int ensemble_resume(const char *path, const ensemble_run_options *options)
{
    ensemble e = ensemble_default();
    ensemble_directory dir;
    store_shard *shards = NULL;
    int count = 0;
    ensemble_directory_open(&dir, path);
    int status = ensemble_directory_read(&dir, &e);
    if (status == CLI_DONE) status = ensemble_directory_end_growth(&dir, &e);
    if (status == CLI_DONE) status = ensemble_directory_shards(&dir, &shards, &count);
    /* One that was killed before its first mark has no shard. */
    if (status == CLI_DONE && count == 0)
        status = resume_shard(&e, &dir, (store_shard){0}, options);
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = resume_shard(&e, &dir, shards[i], options);
    status = ensemble_end(&e, &dir, status, options->threads);
    free(shards);
    ensemble_free(&e);
    ensemble_directory_close(&dir);
    return status;
}
