/* study_merge.c - the shards of a study, from wherever they were run, made one.
 *
 * Each cell that can have a run must have a finished one in one of the directories whose shard it
 * is of, and in one alone; what a shard ran before it grew may be another's now.  The runs are
 * copied, unless they are already in the directory of the whole, and the study is then finished as
 * if it had been run there. */
#include "study_merge.h"

#include "io/file.h"
#include "io/file_output.h"
#include "run/manifest.h"
#include "study_cell.h"
#include "study_directory.h"
#include "study_pool.h"
#include "study_results.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct merge {
    study_directory *source; /* [sources] */
    int sources;
    study_directory target;
    study_plan plan;
    int *from;  /* [cells] which source has the run, -1: none */
    bool **has; /* [sources][cells] whether the cell is of its shards */
    study_results *(*results)[STUDY_STORED]; /* [sources] */
} merge;

/* ---- the sources ---- */

/* Compares a file of source i with the same file of the first. */
static int compare_files(const merge *m, int i, const char *path, const char *first)
{
    bool is_same;
    const int status = file_is_copy(path, first, &is_same);
    if (status != CLI_DONE || is_same) return status;
    return cli_fail(CLI_USAGE, "'%s' and '%s' are of two studies: '%s' and '%s' differ",
                    m->source[i].path, m->source[0].path, path, first);
}

static int check_source(const merge *m, int i)
{
    const study_directory *s = &m->source[i];
    if (!study_directory_has_study(s))
        return cli_fail(CLI_USAGE, "'%s' holds no study: there is no %s", s->path, s->study);
    for (int k = 0; k < i; k++)
        if (file_is_same(s->path, m->source[k].path))
            return cli_fail(CLI_USAGE, "'%s' is given twice", s->path);
    int status = compare_files(m, i, s->study, m->source[0].study);
    for (int k = 0; k < m->plan.case_count && status == CLI_DONE; k++) {
        const study_case *e = &m->plan.cases[k];
        if (!e->is_first || !e->copy) continue;
        char *path = study_plan_copy_path(s->systems, e);
        status = compare_files(m, i, path, e->copy);
        free(path);
    }
    return status;
}

/* ---- the runs ---- */

/* Notes that a source has a run, which must be in no other source. */
static int note_source(merge *m, int cell, int source, const char *name)
{
    const int before = m->from[cell];
    m->from[cell] = source;
    if (before < 0) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s' is in '%s' and in '%s'", name, m->source[before].path,
                    m->source[source].path);
}

/* A run that a source has must be finished. */
static int find_in_source(merge *m, int cell, int source, const char *name)
{
    const study_directory *s = &m->source[source];
    char *run = cli_join(s->runs, name), *manifest = cli_join(run, "manifest.json");
    int status = CLI_DONE;
    if (file_exists(manifest)) {
        bool has_ended;
        status = note_source(m, cell, source, name);
        if (status == CLI_DONE) status = manifest_read_end(manifest, &has_ended);
        if (status == CLI_DONE && !has_ended)
            status = cli_fail(CLI_USAGE, "'%s' is not finished: dalembert resume %s", run, s->path);
    }
    free(manifest);
    free(run);
    return status;
}

static int find_run(merge *m, int cell)
{
    study_cell *c = &m->plan.cells[cell];
    int status = CLI_DONE;
    m->from[cell] = -1;
    for (int i = 0; i < m->sources && status == CLI_DONE; i++)
        if (!m->has[i][cell])
            continue;
        else if (c->of_case->rows == STUDY_ROWS_KEPT)
            status = find_in_source(m, cell, i, c->name);
        else if (study_results_has(m->results[i][STUDY_STORED_RUNS], cell))
            status = note_source(m, cell, i, c->name);
    if (status == CLI_DONE && m->from[cell] < 0 && study_cell_is_runnable(c))
        status =
            cli_fail(CLI_USAGE, "'%s' is in none of the directories: a shard is missing", c->name);
    return status;
}

/* A file that is not there is not copied: of system files there are copies only where needed.  The
 * manifest comes last: with it the run is complete. */
static int copy_run(const char *source, const char *target)
{
    run_directory from, to;
    run_directory_open(&from, source);
    run_directory_open(&to, target);
    int status = file_make_directory(target);
    for (int i = 0; i < RUN_FILES && status == CLI_DONE; i++)
        if (from.file[i] != from.manifest && file_exists(from.file[i]))
            status = file_copy(from.file[i], to.file[i], FILE_UNSYNCED);
    if (status == CLI_DONE) status = file_copy(from.manifest, to.manifest, FILE_UNSYNCED);
    run_directory_close(&from);
    run_directory_close(&to);
    return status;
}

static int copy_directory(const merge *m, int from, const char *name)
{
    char *source = cli_join(m->source[from].runs, name);
    char *target = cli_join(m->target.runs, name);
    const int status = copy_run(source, target);
    free(source);
    free(target);
    return status;
}

static int copy_runs(const merge *m)
{
    int status = CLI_DONE;
    for (int i = 0; i < m->plan.cell_count && status == CLI_DONE; i++) {
        const study_cell *c = &m->plan.cells[i];
        const int from = m->from[i];
        if (from < 0 || file_is_same(m->source[from].path, m->target.path)) continue;
        if (c->of_case->rows == STUDY_ROWS_KEPT) status = copy_directory(m, from, c->name);
        for (int what = 0; what < STUDY_STORED && status == CLI_DONE; what++)
            if (m->results[from][what] && study_results_has(m->results[from][what], i))
                status = study_results_copy(m->plan.results[what], m->results[from][what], i);
    }
    return status;
}

/* ---- all ---- */

/* A target that is one of the sources is complete except for the runs of the others. */
static int begin_target(merge *m, bool force)
{
    const store_shard whole = {0};
    for (int i = 0; i < m->sources; i++) {
        if (!file_is_same(m->source[i].path, m->target.path)) continue;
        m->plan.runs = m->target.runs;
        return study_directory_open_results(&m->target, &m->plan, m->plan.results);
    }
    return study_directory_begin(&m->target, &m->plan, m->source[0].text, m->source[0].length,
                                 whole, force);
}

int study_merge(const char *const *sources, int count, const char *output, int threads, bool force)
{
    merge m = {.sources = count};
    m.source = cli_calloc((size_t)count, sizeof *m.source);
    for (int i = 0; i < count; i++) study_directory_open(&m.source[i], sources[i]);
    study_directory_open(&m.target, output);
    /* The first directory has the plan, the others must agree with it. */
    int status = study_directory_read(&m.source[0], &m.plan);
    for (int i = 1; i < count && status == CLI_DONE; i++) status = check_source(&m, i);
    m.from = cli_calloc((size_t)m.plan.cell_count + 1, sizeof *m.from);
    m.results = cli_calloc((size_t)count, sizeof *m.results);
    m.has = cli_calloc((size_t)count, sizeof *m.has);
    for (int i = 0; i < count && status == CLI_DONE; i++) {
        m.has[i] = cli_calloc((size_t)m.plan.cell_count + 1, sizeof *m.has[i]);
        status = study_directory_find_cells(&m.source[i], m.plan.cell_count, m.has[i]);
        if (status == CLI_DONE)
            status = study_directory_open_results(&m.source[i], &m.plan, m.results[i]);
    }
    for (int i = 0; i < m.plan.cell_count; i++) m.plan.cells[i].other_shard = false;
    for (int i = 0; i < m.plan.cell_count && status == CLI_DONE; i++) status = find_run(&m, i);
    if (status == CLI_DONE) status = begin_target(&m, force);
    if (status == CLI_DONE) status = copy_runs(&m);
    if (status == CLI_DONE) status = study_directory_save_results(&m.plan);
    if (status == CLI_DONE)
        status = study_directory_open_results(&m.target, &m.plan, m.plan.results);
    if (status == CLI_DONE) {
        cli_catch_signals();
        status = study_directory_finish(&m.target, &m.plan,
                                        study_pool_run(&m.plan, work_on_threads, threads));
    }
    study_directory_close(&m.target);
    study_plan_free(&m.plan);
    for (int i = 0; i < count; i++) {
        for (int what = 0; what < STUDY_STORED; what++) study_results_free(m.results[i][what]);
        free(m.has[i]);
        study_directory_close(&m.source[i]);
    }
    free(m.source);
    free(m.has);
    free(m.results);
    free(m.from);
    return status;
}
