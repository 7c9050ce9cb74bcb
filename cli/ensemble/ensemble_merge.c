/* ensemble_merge.c - the shards of an ensemble, from wherever they were run, made one.
 *
 * Each chunk must be done in one of the directories.  Its rows are copied, and the ensemble is then
 * finished as if it had been run in one piece. */
#include "ensemble_merge.h"
#include "ensemble_directory.h"
#include "ensemble_statistics.h"
#include "io/file.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdlib.h>

typedef struct merge {
    ensemble e;
    ensemble_directory *source; /* [sources] */
    int sources;
    ensemble_directory target;
    double *rows; /* of one chunk */
} merge;

/* Begins the target, or continues one that is among the sources. */
static int begin_target(merge *m, bool force)
{
    const store_shard whole = {0};
    for (int i = 0; i < m->sources; i++)
        if (file_is_same(m->source[i].path, m->target.path))
            return ensemble_directory_attach(&m->target, &m->e, whole);
    return ensemble_directory_begin(&m->target, &m->e, whole, force);
}

static int merge_chunk(merge *m, int chunk)
{
    int i = 0;
    if (m->target.marks.done[chunk]) return CLI_DONE;
    while (i < m->sources && !m->source[i].marks.done[chunk]) i++;
    if (i == m->sources)
        return cli_fail(CLI_USAGE,
                        "member %lld is done in none of the directories: a shard is missing or "
                        "not finished",
                        (long long)chunk * ENSEMBLE_CHUNK);
    const int status =
        ensemble_directory_copy_chunk(&m->source[i], &m->target, &m->e, chunk, m->rows);
    m->target.marks.done[chunk] = status == CLI_DONE;
    return status;
}

static int merge_all(merge *m, int threads, bool force)
{
    int status = ensemble_directory_read(&m->source[0], &m->e);
    for (int i = 0; i < m->sources && status == CLI_DONE; i++)
        status = ensemble_directory_attach(&m->source[i], &m->e, STORE_ALL_SHARDS);
    if (status == CLI_DONE) status = begin_target(m, force);
    if (status != CLI_DONE) return status;
    m->rows = ensemble_allocate_rows(&m->e);
    for (int i = 0; i < ensemble_chunks(&m->e) && status == CLI_DONE; i++)
        status = merge_chunk(m, i);
    if (status == CLI_DONE) status = ensemble_directory_save(&m->target);
    return status == CLI_DONE ? ensemble_finish(&m->e, &m->target, threads) : status;
}

int ensemble_merge(const char *const *sources, int count, const char *output, int threads,
                   bool force)
{
    merge m = {.e = ensemble_default(), .sources = count};
    m.source = cli_calloc((size_t)count, sizeof *m.source);
    for (int i = 0; i < count; i++) ensemble_directory_open(&m.source[i], sources[i]);
    ensemble_directory_open(&m.target, output);
    const int status = merge_all(&m, threads, force);
    for (int i = 0; i < count; i++) ensemble_directory_close(&m.source[i]);
    ensemble_directory_close(&m.target);
    ensemble_free(&m.e);
    free(m.source);
    free(m.rows);
    return status;
}
