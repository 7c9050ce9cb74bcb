/* ensemble_growth.c - an ensemble of a directory that gets more members, or a later end. */
#include "ensemble_growth.h"
#include "ensemble_directory.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdlib.h>

typedef struct larger_ensemble {
    ensemble before, after;
    ensemble_directory from, to;
} larger_ensemble;

/* Reads what is there; its shards must be done, since the larger ensemble has none. */
static int read_before(larger_ensemble *g)
{
    store_shard *shards = NULL;
    bool is_complete;
    int count = 0, status = ensemble_directory_read(&g->from, &g->before);
    if (status == CLI_DONE) status = ensemble_directory_end_growth(&g->from, &g->before);
    if (status == CLI_DONE) status = ensemble_directory_shards(&g->from, &shards, &count);
    bool has_shards = false;
    for (int i = 0; i < count; i++) has_shards |= shards[i].count > 0;
    free(shards);
    if (status != CLI_DONE) return status;
    status = ensemble_directory_attach(&g->from, &g->before, STORE_ALL_SHARDS);
    if (status == CLI_DONE) status = store_update_marks(&g->from.marks, &is_complete);
    if (status != CLI_DONE) return status;
    if (has_shards && !is_complete)
        return cli_fail(CLI_USAGE, "'%s' cannot grow: its shards are not done", g->from.path);
    return ensemble_directory_attach(&g->from, &g->before, (store_shard){0});
}

static int extend_time(larger_ensemble *g, const run_extension *later)
{
    const run_simulation *before = &g->before.simulation;
    run_request *request = &g->after.simulation.request;
    double end;
    const int status = extension_replace_end(request, later, g->from.path, before->end, &end);
    if (status != CLI_DONE) return status;
    return request->times > 0 && end != before->end ? extension_extend_list(request, before)
                                                    : CLI_DONE;
}

static int read_after(larger_ensemble *g, const ensemble_growth *growth)
{
    ensemble *e = &g->after;
    int status = ensemble_directory_read_request(&g->to, e);
    if (status == CLI_DONE && growth->members > 0) {
        if (growth->members < e->members)
            return cli_fail(CLI_USAGE,
                            "--members: '%s' has %lld members already, and %lld are fewer",
                            g->from.path, e->members, growth->members);
        e->members = growth->members;
    }
    if (status == CLI_DONE && (growth->later.time || growth->later.steps))
        status = extend_time(g, &growth->later);
    return status == CLI_DONE ? ensemble_complete(e) : status;
}

/* Chunks that are done and get no further members are kept, except for a later end. */
static int copy_chunks(larger_ensemble *g, unsigned char *done)
{
    double *rows = ensemble_allocate_rows(&g->after);
    int status = CLI_DONE;
    const bool is_later = g->after.simulation.end != g->before.simulation.end;
    for (int i = 0; !is_later && i < ensemble_chunks(&g->before) && status == CLI_DONE; i++) {
        const bool is_same =
            ensemble_chunk_members(&g->before, i) == ensemble_chunk_members(&g->after, i);
        if (!is_same || !g->from.marks.done[i]) continue;
        status = ensemble_directory_copy_chunk(&g->from, &g->to, &g->after, i, rows);
        done[i] = status == CLI_DONE;
    }
    free(rows);
    return status;
}

static int replace(larger_ensemble *g)
{
    unsigned char *done = cli_calloc((size_t)ensemble_chunks(&g->after), 1);
    int status = ensemble_directory_begin_growth(&g->to, &g->after);
    if (status == CLI_DONE) status = copy_chunks(g, done);
    if (status == CLI_DONE) status = ensemble_directory_commit_growth(&g->to, &g->after, done);
    free(done);
    return status;
}

int ensemble_grow(const char *path, const ensemble_growth *growth)
{
    larger_ensemble g = {.before = ensemble_default(), .after = ensemble_default()};
    ensemble_directory_open(&g.from, path);
    ensemble_directory_open(&g.to, path);
    int status = read_before(&g);
    if (status == CLI_DONE) status = read_after(&g, growth);
    if (status == CLI_DONE &&
        (g.before.members != g.after.members || g.before.simulation.end != g.after.simulation.end))
        status = replace(&g);
    ensemble_directory_close(&g.from);
    ensemble_directory_close(&g.to);
    ensemble_free(&g.before);
    ensemble_free(&g.after);
    return status;
}
