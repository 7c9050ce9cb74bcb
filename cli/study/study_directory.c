/* study_directory.c - a study in a directory: begun, read, finished. */
#include "study_directory.h"
#include "dalembert_program.h"

#include "io/file.h"
#include "io/file_output.h"
#include "io/json.h"
#include "run/manifest.h"
#include "run/system.h"
#include "study_cell.h"
#include "study_compare.h"
#include "study_overview.h"
#include "study_pool.h"
#include "study_results.h"
#include "study_screen.h"
#include "study_table.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"
#include "ui/signals.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void study_directory_open(study_directory *dir, const char *path)
{
    *dir = (study_directory){.path = path};
    STORE_MAKE_PATHS(dir, STUDY_FILE_LIST);
}

void study_directory_close(study_directory *dir)
{
    store_free_paths(dir->file, STUDY_FILES);
    free(dir->text);
    *dir = (study_directory){0};
}

bool study_directory_has_study(const study_directory *dir) { return file_exists(dir->study); }

int study_directory_read_end(const study_directory *dir, bool *has_ended)
{
    store_state state = STORE_STATES;
    const int status = file_exists(dir->study) ? store_read_state(dir->manifest, &state) : CLI_DONE;
    *has_ended = state == STORE_DONE || state == STORE_UNMET;
    return status;
}

/* ---- shards -------------------------------------------------------------------------------- */

static const store_shard_file manifest_file = {"manifest.json", "shard", ".json"};

/* ---- the manifest -------------------------------------------------------------------------- */

static int write_shard_manifest(const study_directory *dir, store_shard shard,
                                const study_plan *plan, store_state state)
{
    char *path = store_shard_path(dir->path, manifest_file, shard);
    store_manifest m;
    int count[STUDY_STATES] = {0};
    double seconds = 0.0;
    for (int i = 0; i < plan->cell_count; i++) {
        if (!store_shard_has(shard, i)) continue;
        count[plan->cells[i].state]++;
        seconds += plan->cells[i].seconds;
    }
    store_begin_manifest(&m);
    json_put_text(&m.json, "study", plan->title);
    manifest_put_machine(&m.json);
    json_put_text(&m.json, "status", store_state_words[state]);
    json_open(&m.json, "cells", JSON_ON_ONE_LINE);
    for (int i = 0; i < STUDY_STATES; i++)
        json_put_integer(&m.json, study_state_words[i], count[i]);
    json_close(&m.json);
    json_put_number(&m.json, "seconds", seconds);
    const int status = store_end_manifest(&m, path, FILE_SYNCED);
    free(path);
    return status;
}

static int write_manifest(const study_directory *dir, const study_plan *plan, store_state state)
{
    store_shard *shards;
    int count;
    if (dir->shard.count >= 0) return write_shard_manifest(dir, dir->shard, plan, state);
    int status = store_find_shards(dir->path, manifest_file, &shards, &count);
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = write_shard_manifest(dir, shards[i], plan, state);
    free(shards);
    return status;
}

/* ---- files of results --------------------------------------------------------------------- */

/* Whether cells of a case have something there. */
static bool is_stored(const study_case *e, study_stored what)
{
    return what == STUDY_STORED_RUNS ? e->rows == STUDY_ROWS_NONE : e->predict;
}

/* The keys of the cells, once for all directories of the plan. */
static int find_keys(study_plan *plan)
{
    if (plan->key) return CLI_DONE;
    uint64_t *key = cli_calloc((size_t)plan->cell_count + 1, sizeof *key);
    uint64_t system = 0;
    int status = CLI_DONE;
    for (int i = 0; i < plan->case_count && status == CLI_DONE; i++) {
        const study_case *e = &plan->cases[i];
        if (!is_stored(e, STUDY_STORED_RUNS) && !is_stored(e, STUDY_STORED_PREDICTIONS)) continue;
        if (e->is_first) {
            system = DAL__HASH_START;
            status =
                store_hash_system(&system, e->copy ? NULL : dal_builtin_text(e->name), e->copy);
        }
        for (int k = e->first_cell; k < e->first_cell + e->cells && status == CLI_DONE; k++)
            key[k] = study_cell_key(&plan->cells[k], system);
    }
    if (status == CLI_DONE)
        plan->key = key;
    else
        free(key);
    return status;
}

int study_directory_open_results(const study_directory *dir, study_plan *plan,
                                 study_results *results[STUDY_STORED])
{
    const char *const path[] = {dir->results, dir->predictions};
    char *writer = dir->shard.count > 0
                       ? cli_format("%lld-of-%lld", dir->shard.number, dir->shard.count)
                   : dir->writer > 0 ? cli_format("writer-%d", dir->writer)
                                     : cli_strdup("all");
    int status = find_keys(plan);
    for (int what = 0; what < STUDY_STORED; what++) {
        bool has_any = false;
        for (int i = 0; i < plan->case_count; i++)
            has_any |= is_stored(&plan->cases[i], (study_stored)what);
        study_results_free(results[what]);
        results[what] = NULL;
        if (has_any && status == CLI_DONE)
            status =
                study_results_open(&results[what], path[what], writer, plan->key, plan->cell_count);
    }
    free(writer);
    return status;
}

int study_directory_save_results(const study_plan *plan)
{
    int status = CLI_DONE;
    for (int what = 0; what < STUDY_STORED; what++) {
        const int saved = plan->results[what] ? study_results_save(plan->results[what]) : CLI_DONE;
        if (status == CLI_DONE) status = saved;
    }
    return status;
}

/* ---- beginning ----------------------------------------------------------------------------- */

/* Removes the study that is there, study.yaml first. */
static int clear(const study_directory *dir)
{
    int status = CLI_DONE;
    for (int i = 0; i < STUDY_FILES && status == CLI_DONE; i++)
        status = store_remove(dir->file[i], 2);
    return status == CLI_DONE ? store_remove_shards(dir->path, manifest_file) : status;
}

/* A copy that is there already, of a study that the shard joins, must be the same. */
static int copy_system(const study_directory *dir, study_case *e)
{
    size_t length;
    const char *source = dal_model_source(e->model, &length);
    if (!e->copy && !e->path) return CLI_DONE;
    char *path = study_plan_copy_path(dir->systems, e);
    bool is_same;
    int status = CLI_DONE;
    if (!file_exists(path))
        status = cli_copy_system(e->path, e->model, path, FILE_SYNCED);
    else if ((status = file_equals(path, source, length, &is_same)) == CLI_DONE && !is_same)
        status = cli_fail(CLI_USAGE, "'%s' is of another study: '%s' differs", dir->path, path);
    free(e->copy);
    e->copy = path;
    return status;
}

static int copy_systems(const study_directory *dir, study_plan *plan)
{
    int status = file_make_directory(dir->systems);
    for (int i = 0; i < plan->case_count && status == CLI_DONE; i++)
        if (plan->cases[i].is_first)
            status = copy_system(dir, &plan->cases[i]);
        else
            plan->cases[i].copy = plan->cases[i - 1].copy;
    return status;
}

/* Whether a new study may be written there. */
static int check_is_free(const study_directory *dir)
{
    const char *held = file_exists(dir->study) ? dir->study : dir->manifest;
    if (!file_exists(held)) return CLI_DONE;
    return cli_fail(CLI_USAGE,
                    "'%s' exists already: 'dalembert resume %s' resumes it, --force writes over "
                    "it",
                    held, dir->path);
}

/* Whether one more shard of this study may be written there. */
static int check_shares(const study_directory *dir, const char *text, size_t length)
{
    if (!file_exists(dir->study) || file_exists(dir->manifest)) return check_is_free(dir);
    bool is_same;
    const int status = file_equals(dir->study, text, length, &is_same);
    if (status != CLI_DONE || is_same) return status;
    return cli_fail(CLI_USAGE, "'%s' is another study; --force writes over it", dir->study);
}

/* Whether the study was killed while it was begun or written over: nothing of it can be resumed. */
static int find_incomplete(const study_directory *dir, bool *is_incomplete)
{
    char *title = NULL;
    const int status =
        file_exists(dir->study) ? CLI_DONE : json_file_text(dir->manifest, "study", &title);
    *is_incomplete = title != NULL;
    free(title);
    return status;
}

int study_directory_begin(study_directory *dir, study_plan *plan, const char *text, size_t length,
                          store_shard shard, bool force)
{
    const bool is_own = file_owns_directory(dir->path);
    /* Shards that begin in one directory at the same time come one after the other. */
    int descriptor, status = store_begin(dir->path, force, &descriptor);
    if (status != CLI_DONE) return status;
    plan->runs = dir->runs;
    dir->shard = shard;
    for (int i = 0; i < plan->cell_count; i++)
        plan->cells[i].other_shard = !store_shard_has(shard, i);
    bool is_incomplete;
    status = find_incomplete(dir, &is_incomplete);
    if (status == CLI_DONE && (is_incomplete || (force && is_own)))
        status = clear(dir);
    else if (status == CLI_DONE && !force)
        status = shard.count > 0 ? check_shares(dir, text, length) : check_is_free(dir);
    if (status == CLI_DONE) status = file_make_directory(dir->runs);
    if (status == CLI_DONE) status = copy_systems(dir, plan);
    if (status == CLI_DONE) status = write_manifest(dir, plan, STORE_RUNNING);
    if (status == CLI_DONE) status = file_replace(dir->study, text, length, FILE_SYNCED);
    if (status == CLI_DONE) status = study_directory_open_results(dir, plan, plan->results);
    close(descriptor);
    return status;
}

/* ---- reading and running ------------------------------------------------------------------- */

int study_directory_find_cells(const study_directory *dir, int cells, bool *has)
{
    store_shard *shards = NULL;
    int count = 0, status = CLI_DONE;
    const bool is_whole = file_exists(dir->manifest);
    if (!is_whole) status = store_find_shards(dir->path, manifest_file, &shards, &count);
    for (int i = 0; i < cells; i++) {
        has[i] = is_whole;
        for (int k = 0; k < count; k++) has[i] |= store_shard_has(shards[k], i);
    }
    free(shards);
    return status;
}

int study_directory_read(study_directory *dir, study_plan *plan)
{
    if (!file_exists(dir->study))
        return cli_fail(CLI_USAGE, "'%s' holds no study: there is no %s", dir->path, dir->study);
    dir->text = file_read(dir->study, &dir->length);
    if (!dir->text) return CLI_IO;
    int status = study_plan_read(plan, dir->study, dir->text, dir->length, dir->systems);
    plan->runs = dir->runs;
    if (status == CLI_DONE) status = study_directory_open_results(dir, plan, plan->results);
    if (status != CLI_DONE || file_exists(dir->manifest)) return status;
    dir->shard = STORE_ALL_SHARDS;
    bool *has = cli_calloc((size_t)plan->cell_count + 1, sizeof *has);
    status = study_directory_find_cells(dir, plan->cell_count, has);
    for (int i = 0; i < plan->cell_count; i++) plan->cells[i].other_shard = !has[i];
    free(has);
    return status;
}

int study_directory_run(const study_directory *dir, study_plan *plan,
                        const study_run_options *options)
{
    cli_catch_signals();
    plan->interval = options->interval;
    plan->native = options->native;
    plan->shows_tables = options->shows_tables;
    plan->shows_matrices = options->shows_matrices;
    plan->format = options->format;
    return study_directory_finish(dir, plan,
                                  study_pool_run(plan, work_on_threads, options->threads));
}

int study_resume(const char *path, const study_run_options *options)
{
    study_plan plan = {0};
    study_directory dir;
    study_directory_open(&dir, path);
    int status = study_directory_read(&dir, &plan);
    if (status == CLI_DONE) status = study_directory_run(&dir, &plan, options);
    study_plan_free(&plan);
    study_directory_close(&dir);
    return status;
}

/* ---- the end ------------------------------------------------------------------------------- */

static void print_tables(FILE *out, const study_plan *plan)
{
    fprintf(out, "%s\n", plan->title);
    for (int i = 0; i < plan->case_count; i++) {
        const study_case *e = &plan->cases[i];
        bool has_cells = false;
        for (int k = e->first_cell; k < e->first_cell + e->cells; k++)
            has_cells |= !plan->cells[k].other_shard;
        if (has_cells) study_print_case(out, plan, e);
    }
    study_print_note(out, plan);
    study_print_expectations(out, plan);
}

static int write_files(const study_directory *dir, const study_plan *plan)
{
    int status = study_write_csv(plan, dir->path);
    if (status == CLI_DONE) status = study_write_expectations(plan, dir->expectations);
    if (status != CLI_DONE) return status;
    file_output tables;
    status = file_output_open(&tables, dir->tables);
    if (status != CLI_DONE) return status;
    print_tables(tables.stream, plan);
    return file_output_close(&tables, CLI_DONE);
}

/* The screen, in colour on a terminal, or the tables. */
static int print_results(const study_directory *dir, const study_plan *plan)
{
    const char *tables = dir->shard.count == 0 ? dir->tables : NULL;
    if (screen_is_wanted(plan->format, plan->shows_tables || plan->shows_matrices))
        return study_print_overview(stdout, plan, tables, plan->format);
    if (plan->shows_tables)
        print_tables(stdout, plan);
    else
        study_print_screen(stdout, plan, tables, screen_is_in_colour(stdout));
    return cli_close(stdout, "standard output");
}

/* The exit status of a study whose cells were all run. */
static int result_status(const study_plan *plan)
{
    for (int i = 0; i < plan->cell_count; i++) {
        const study_cell *cell = &plan->cells[i];
        if (cell->state == STUDY_FAILED && !study_failure_is_expected(plan, cell))
            return CLI_FAILED;
    }
    return study_count_unmet(plan) > 0 ? CLI_CHECK : CLI_DONE;
}

int study_directory_finish(const study_directory *dir, const study_plan *plan, int status)
{
    const int saved = study_directory_save_results(plan);
    if (status == CLI_DONE) status = saved;
    const int result = status == CLI_DONE ? result_status(plan) : status;
    const bool is_whole = dir->shard.count == 0;
    const store_state state = result == CLI_FAILED ? STORE_DONE : store_end_state(result);
    int written = is_whole ? write_files(dir, plan) : CLI_DONE;
    if (written == CLI_DONE) written = write_manifest(dir, plan, state);
    if (status != CLI_DONE && status != CLI_SIGNAL) return status;
    const int printed = print_results(dir, plan);
    if (status == CLI_SIGNAL) return store_interrupt(dir->path);
    return written != CLI_DONE ? written : printed != CLI_DONE ? printed : result;
}
