/* study_finish.c - what is left of a study in its directory, and told, when cells have been run. */
#include "dalembert.h"
#include "io/file.h"
#include "io/json.h"
#include "run/manifest.h"
#include "study_directory.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the manifest ---- */

static int count_cells(const study_plan *plan, study_shard shard, study_state state)
{
    int count = 0;
    for (int i = 0; i < plan->cell_count; i++)
        count += study_shard_has(shard, i) && plan->cells[i].state == state;
    return count;
}

static double count_seconds(const study_plan *plan, study_shard shard)
{
    double seconds = 0.0;
    for (int i = 0; i < plan->cell_count; i++)
        if (study_shard_has(shard, i)) seconds += plan->cells[i].seconds;
    return seconds;
}

static void put_manifest(FILE *out, const study_plan *plan, study_shard shard, const char *state)
{
    json_text_member(out, "{\n  ", "dalembert", DAL_VERSION);
    json_text_member(out, ",\n  ", "study", plan->title);
    manifest_put_machine(out);
    json_text_member(out, ",\n  ", "status", state);
    fputs(",\n  \"cells\": {", out);
    const char *before = "";
#define X(code, word)                                                                              \
    fprintf(out, "%s\"%s\": %d", before, word, count_cells(plan, shard, STUDY_##code));            \
    before = ", ";
    STUDY_STATE_LIST(X)
#undef X
    fputs("}", out);
    json_number_member(out, ",\n  ", "seconds", count_seconds(plan, shard));
    fputs("\n}\n", out);
}

typedef struct telling {
    const study_plan *plan;
    const char *state;
} telling;

static int tell_shard(const study_directory *dir, study_shard shard, void *user)
{
    const telling *t = user;
    char *text, *path = study_directory_manifest(dir, shard);
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    put_manifest(out, t->plan, shard, t->state);
    cli_memstream_close(out);
    const int status = file_replace(path, text, length, 1);
    free(text);
    free(path);
    return status;
}

int study_directory_write_manifest(const study_directory *dir, const study_plan *plan,
                                   const char *state)
{
    telling t = {plan, state};
    if (dir->shard.count != STUDY_ALL_SHARDS) return tell_shard(dir, dir->shard, &t);
    return study_directory_each_shard(dir, tell_shard, &t);
}

/* ---- tables ---- */

static int has_cells(const study_plan *plan, const study_case *e)
{
    for (int i = e->first_cell; i < e->first_cell + e->cells; i++)
        if (!plan->cells[i].elsewhere) return 1;
    return 0;
}

static void print_tables(FILE *out, const study_plan *plan)
{
    fprintf(out, "%s\n", plan->title);
    for (int i = 0; i < plan->case_count; i++)
        if (has_cells(plan, &plan->cases[i])) study_print_case(out, plan, &plan->cases[i]);
    study_print_note(out, plan);
    study_print_expectations(out, plan);
}

static int keep_tables(const char *path, const study_plan *plan)
{
    FILE *file = fopen(path, "w");
    if (!file) return cli_io("write", path);
    print_tables(file, plan);
    return cli_close(file, path);
}

static int keep_cells(const char *directory, const study_plan *plan)
{
    study_output *output = NULL;
    int status = study_output_open(&output, directory);
    for (int i = 0; i < plan->cell_count && status == CLI_DONE; i++)
        if (plan->cells[i].state != STUDY_WAITING)
            status = study_output_cell(output, plan, &plan->cells[i]);
    int closed = study_output_close(output);
    return status != CLI_DONE ? status : closed;
}

static int keep_files(const study_directory *dir, const study_plan *plan)
{
    int status = keep_cells(dir->directory, plan);
    if (status == CLI_DONE) status = study_write_expectations(plan, dir->expectations);
    return status == CLI_DONE ? keep_tables(dir->tables, plan) : status;
}

/* ---- the end ---- */

static int any_failed(const study_plan *plan)
{
    for (int i = 0; i < plan->cell_count; i++)
        if (plan->cells[i].state == STUDY_FAILED &&
            !study_failure_is_expected(plan, &plan->cells[i]))
            return 1;
    return 0;
}

static int conclude(const study_plan *plan, int status)
{
    if (status != CLI_DONE) return status;
    if (any_failed(plan)) return CLI_FAILED;
    return study_count_unmet(plan) > 0 ? CLI_CHECK : CLI_DONE;
}

static const char *state_word(int status)
{
    switch (status) {
    case CLI_DONE:
    case CLI_FAILED:
        return "done";
    case CLI_CHECK:
        return "unmet";
    case CLI_SIGNAL:
        return "interrupted";
    default:
        return "failed";
    }
}

int study_directory_finish(const study_directory *dir, const study_plan *plan, int status)
{
    const int result = conclude(plan, status), is_whole = dir->shard.count == 0;
    int kept = is_whole ? keep_files(dir, plan) : CLI_DONE;
    if (kept == CLI_DONE) kept = study_directory_write_manifest(dir, plan, state_word(result));
    if (status != CLI_DONE && status != CLI_SIGNAL) return status;
    print_tables(stdout, plan);
    const int told = cli_close(stdout, "standard output");
    if (status == CLI_SIGNAL)
        return cli_fail(status, "interrupted; resume with: dalembert resume %s", dir->directory);
    return kept != CLI_DONE ? kept : told != CLI_DONE ? told : result;
}
