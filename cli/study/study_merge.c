/* study_merge.c - `dalembert merge`: the shards of a study, from wherever they were run, as one.
 *
 * Each cell that can have a run must have a finished one in one of the directories, and in one
 * alone.  The runs are copied, unless they are where the whole is to be, and then the study is told
 * as by whoever ran it whole. */
#include "io/file.h"
#include "io/output.h"
#include "run/manifest.h"
#include "run/pool.h"
#include "run/run.h"
#include "study_directory.h"
#include "ui/commands.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/options.h"
#include "ui/signals.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SOURCES_MOST = 1024 };

typedef struct merge {
    study_directory source[SOURCES_MOST];
    int sources;
    study_directory target;
    study_plan plan;
    const char *output;
    long long threads;
    bool force;
    int *from; /* [cells] which source has the run, -1: none */
} merge;

/* ---- the sources ---- */

static int is_same_place(const char *a, const char *b)
{
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

static int is_same_file(const char *path, const char *other)
{
    size_t n, m;
    char *a = file_read(path, &n), *b = a ? file_read(other, &m) : NULL;
    const int same = a && b && n == m && memcmp(a, b, n) == 0;
    free(a);
    free(b);
    return same;
}

static int differs(const merge *m, int i, const char *path, const char *first)
{
    return cli_fail(CLI_USAGE, "'%s' and '%s' are of two studies: '%s' and '%s' differ",
                    m->source[i].directory, m->source[0].directory, path, first);
}

static int check_systems(const merge *m, int i)
{
    int status = CLI_DONE;
    for (int k = 0; k < m->plan.case_count && status == CLI_DONE; k++) {
        const study_case *e = &m->plan.cases[k];
        if (!e->is_first || !e->copy) continue;
        char *path = study_system_copy(m->source[i].systems, e);
        if (!is_same_file(path, e->copy)) status = differs(m, i, path, e->copy);
        free(path);
    }
    return status;
}

static int check_source(const merge *m, int i)
{
    const study_directory *s = &m->source[i];
    if (!study_directory_has_study(s))
        return cli_fail(CLI_USAGE, "'%s' holds no study: there is no %s", s->directory, s->study);
    for (int k = 0; k < i; k++)
        if (is_same_place(s->directory, m->source[k].directory))
            return cli_fail(CLI_USAGE, "'%s' is given twice", s->directory);
    if (!is_same_file(s->study, m->source[0].study))
        return differs(m, i, s->study, m->source[0].study);
    return check_systems(m, i);
}

/* The first directory gives the plan, the others must agree with it. */
static int read_sources(merge *m)
{
    study_directory *first = &m->source[0];
    int status = study_directory_read(first, &m->plan);
    for (int i = 1; i < m->sources && status == CLI_DONE; i++) status = check_source(m, i);
    for (int i = 0; i < m->plan.cell_count; i++) m->plan.cells[i].elsewhere = 0;
    return status;
}

/* ---- the runs ---- */

static int look_at(merge *m, int cell, int source, const char *name)
{
    const study_directory *s = &m->source[source];
    char *run = cli_join(s->runs, name), *manifest = cli_join(run, "manifest.json");
    int status = CLI_DONE;
    if (access(manifest, F_OK) == 0) {
        if (m->from[cell] >= 0)
            status = cli_fail(CLI_USAGE, "'%s' is in '%s' and in '%s'", name,
                              m->source[m->from[cell]].directory, s->directory);
        else if (!manifest_has_ended(manifest))
            status =
                cli_fail(CLI_USAGE, "'%s' is not finished: dalembert resume %s", run, s->directory);
        m->from[cell] = source;
    }
    free(manifest);
    free(run);
    return status;
}

static int find_run(merge *m, int cell)
{
    char *name = study_cell_name(&m->plan.cells[cell]);
    int status = CLI_DONE;
    m->from[cell] = -1;
    for (int i = 0; i < m->sources && status == CLI_DONE; i++) status = look_at(m, cell, i, name);
    if (status == CLI_DONE && m->from[cell] < 0 && study_cell_is_runnable(&m->plan.cells[cell]))
        status =
            cli_fail(CLI_USAGE, "'%s' is in none of the directories: a shard is missing", name);
    free(name);
    return status;
}

static int find_runs(merge *m)
{
    int status = CLI_DONE;
    m->from = cli_calloc((size_t)m->plan.cell_count + 1, sizeof *m->from);
    for (int i = 0; i < m->plan.cell_count && status == CLI_DONE; i++) status = find_run(m, i);
    return status;
}

/* ---- copying ---- */

static int copy_stream(FILE *from, const char *source, FILE *to)
{
    char block[1 << 16];
    for (size_t n; (n = fread(block, 1, sizeof block, from)) > 0;)
        if (fwrite(block, 1, n, to) != n) break;
    return ferror(from) ? cli_io("read", source) : CLI_DONE;
}

/* A file that is not there is not copied: of system files there are copies only where needed. */
static int copy_file(const char *source, const char *target)
{
    FILE *from = fopen(source, "rb");
    if (!from) return errno == ENOENT ? CLI_DONE : cli_io("read", source);
    FILE *to = fopen(target, "wb");
    int status = to ? copy_stream(from, source, to) : cli_io("write", target);
    if (to) {
        const int closed = cli_close(to, target);
        if (status == CLI_DONE) status = closed;
    }
    fclose(from);
    return status;
}

static int copy_files(const run_directory *from, const run_directory *to)
{
    int status = cli_directory(to->path);
#define X(name, file)                                                                              \
    if (status == CLI_DONE && from->name != from->manifest)                                        \
        status = copy_file(from->name, to->name);
    RUN_FILE_LIST(X)
#undef X
    return status == CLI_DONE ? copy_file(from->manifest, to->manifest) : status;
}

static int copy_run(const char *source, const char *target)
{
    run_directory from = {0}, to = {0};
    run_directory_open(&from, source);
    run_directory_open(&to, target);
    const int status = copy_files(&from, &to);
    run_directory_close(&from);
    run_directory_close(&to);
    return status;
}

static int copy_runs(const merge *m)
{
    int status = CLI_DONE;
    for (int i = 0; i < m->plan.cell_count && status == CLI_DONE; i++) {
        const int from = m->from[i];
        if (from < 0 || is_same_place(m->source[from].directory, m->target.directory)) continue;
        char *name = study_cell_name(&m->plan.cells[i]);
        char *source = cli_join(m->source[from].runs, name);
        char *target = cli_join(m->target.runs, name);
        status = copy_run(source, target);
        free(source);
        free(target);
        free(name);
    }
    return status;
}

/* ---- the whole ---- */

/* A directory that is one of the sources is as it must be, but for the runs of the others. */
static int prepare_target(merge *m)
{
    const study_shard whole = {0};
    for (int i = 0; i < m->sources; i++) {
        if (!is_same_place(m->source[i].directory, m->target.directory)) continue;
        m->plan.runs = m->target.runs;
        return CLI_DONE;
    }
    return study_directory_begin(&m->target, &m->plan, m->source[0].text, m->source[0].length,
                                 whole, m->force);
}

static int merge_into(merge *m, const char *output, int threads)
{
    study_directory_open(&m->target, output);
    int status = read_sources(m);
    if (status == CLI_DONE) status = find_runs(m);
    if (status == CLI_DONE) status = prepare_target(m);
    if (status == CLI_DONE) status = copy_runs(m);
    if (status != CLI_DONE) return status;
    cli_catch_signals();
    return study_directory_finish(&m->target, &m->plan, study_pool_run(&m->plan, threads));
}

static int parse_source(void *user, const cli_option *option, const char *text)
{
    merge *m = user;
    (void)option;
    if (m->sources == SOURCES_MOST)
        return cli_fail(CLI_USAGE, "merge: more than %d directories", SOURCES_MOST);
    study_directory_open(&m->source[m->sources++], text);
    return CLI_DONE;
}

static const cli_option options[] = {
    {"output", "DIR", CLI_REQUIRED,
     "writes the whole study there; may be one of those that are merged", .parse = cli_parse_text,
     .offset = offsetof(merge, output)},
    POOL_THREADS_OPTION(merge, "runs read at a time"),
    {"force", NULL, NULL, "overwrites what the directory holds, unless it is one of those",
     .parse = cli_parse_flag, .offset = offsetof(merge, force)},
    {NULL, "DIR...", CLI_REQUIRED, "what 'dalembert study --shard K/N --output DIR' wrote",
     .parse = parse_source},
};

static int merge_shards(int argc, char **argv)
{
    enum { OPTIONS = sizeof options / sizeof *options };
    merge *m = cli_calloc(1, sizeof *m);
    const cli_group group = {options, OPTIONS, .settings = m};
    m->threads = pool_threads();
    int status = cli_read_arguments(&command_merge, argc, argv, &group, 1);
    if (status == CLI_GO_ON) status = merge_into(m, m->output, (int)m->threads);
    for (int i = 0; i < m->sources; i++) study_directory_close(&m->source[i]);
    study_directory_close(&m->target);
    study_plan_free(&m->plan);
    free(m->from);
    free(m);
    return status;
}

const cli_command command_merge = {
    .name = "merge",
    .synopsis = "dalembert merge DIR... --output DIR [OPTION]...",
    .about = "joins the shards of a study",
    .notes = "Shards may share a directory.  Tables and files are, but for times, the bytes of the "
             "study that was not divided.\n",
    .run = merge_shards,
};
