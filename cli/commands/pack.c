/* pack.c - `dalembert pack DIR`: an archive of the request and the tables of a result. */
#include "dalembert.h"
#include "io/file.h"
#include "io/file_output.h"
#include "io/tar.h"
#include "run/manifest.h"
#include "run/request_command.h"
#include "run/system.h"
#include "study/study_directory.h"
#include "study/study_plan.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct settings {
    const char *directory, *output;
    bool all, force;
} settings;

static const cli_option options[] = {
    {"all", NULL, NULL, "packs rows, checkpoints and the page, too", CLI_FLAG(settings, all)},
    {"output", "FILE.tar|-", NULL, "writes the archive there (DIR.tar)",
     CLI_TEXT(settings, output)},
    {"force", NULL, NULL, "overwrites the file", CLI_FLAG(settings, force)},
    {NULL, "DIR", CLI_REQUIRED,
     "what 'run', 'study', 'ensemble', 'order' or another command wrote with --output DIR",
     CLI_TEXT(settings, directory)},
};

/* The archive while it is made. */
typedef struct pack {
    const settings *set;
    const char *name; /* of the directory in the archive */
    FILE *out;
    char *list; /* the names, for README.txt */
    size_t list_length;
    FILE *names;
    int files;
} pack;

/* ---- the files ----------------------------------------------------------------------------- */

enum { DEPTH = 4 };

/* Inputs, manifests and tables; all else with --all, except locks. */
static bool is_wanted(const pack *p, const char *name)
{
    static const char *const endings[] = {".json", ".yaml", ".csv", ".txt"};
    if (strcmp(name, "lock") == 0 || name[0] == '.') return false;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (cli_ends_in(name, endings[i])) return true;
    return p->set->all;
}

/* Adds a file under a name inside the directory. */
static int add_file(pack *p, const char *inside, const char *from)
{
    struct stat state;
    char *packed = cli_format("%s/%s", p->name, inside);
    const int status =
        stat(from, &state) == 0 ? tar_add_file(p->out, packed, from) : cli_io("read", from);
    free(packed);
    if (status == CLI_DONE) fprintf(p->names, "    %10lld  %s\n", (long long)state.st_size, inside);
    return status;
}

static int add_directory(pack *p, const char *path, const char *inside, int depth);

static int add_entry(pack *p, const char *path, const char *inside, const char *name, int depth)
{
    struct stat status;
    char *from = cli_join(path, name), *to = cli_format("%s%s", inside, name);
    int done = CLI_DONE;
    if (lstat(from, &status) != 0) {
        done = errno == ENOENT ? CLI_DONE : cli_io("read", from);
    } else if (S_ISDIR(status.st_mode) && depth < DEPTH) {
        char *below = cli_format("%s/", to);
        const bool is_page = strcmp(name, "report") == 0 && !p->set->all;
        if (!is_page) done = add_directory(p, from, below, depth + 1);
        free(below);
    } else if (S_ISREG(status.st_mode) && is_wanted(p, name)) {
        done = add_file(p, to, from);
        p->files++;
    }
    free(from);
    free(to);
    return done;
}

static int add_directory(pack *p, const char *path, const char *inside, int depth)
{
    file_names names;
    int status = file_list(path, &names);
    for (int i = 0; i < names.count && status == CLI_DONE; i++)
        status = add_entry(p, path, inside, names.name[i], depth);
    file_free_names(&names);
    return status;
}

/* ---- what it was made by ------------------------------------------------------------------- */

static const char made_by[] = "To make it again, in this directory:\n\n"
                              "    %s --output again\n\n";

/* Adds a text under a name inside the directory. */
static int add_text(pack *p, const char *inside, const char *text, size_t length)
{
    char *packed = cli_format("%s/%s", p->name, inside);
    const int status = tar_add(p->out, packed, text, length);
    fprintf(p->names, "    %10zu  %s\n", length, inside);
    free(packed);
    return status;
}

/* The file of a built-in system. */
static int add_builtin(pack *p, const char *name)
{
    dal_model *model = NULL;
    size_t length = 0;
    int status = CLI_DONE;
    if (dal_model_builtin(&model, name, NULL) != DAL_STATUS_OK) return CLI_DONE;
    const char *source = dal_model_source(model, &length);
    char *inside = cli_format("builtin/%s.yaml", name);
    if (source) status = add_text(p, inside, source, length);
    free(inside);
    dal_model_free(model);
    return status;
}

static int describe_run(pack *p, FILE *readme)
{
    run_directory dir;
    run_request request = request_default();
    run_directory_open(&dir, p->set->directory);
    int status = manifest_read(&dir, &request);
    if (status == CLI_DONE) {
        const bool is_file = cli_is_path(request.system_name);
        const char *name = is_file ? "system.yaml" : request.system_name;
        char *command = request_format_command(&request, "run", name, 0);
        fprintf(readme, made_by, command);
        free(command);
        if (!is_file) status = add_builtin(p, name);
    }
    request_free(&request);
    run_directory_close(&dir);
    return status;
}

/* A system file of a study, at the place that the study names. */
static int add_system(pack *p, FILE *readme, const study_case *e)
{
    const char *name = e->name;
    while (strncmp(name, "./", 2) == 0) name += 2;
    if (name[0] == '/' || strstr(name, "..")) {
        fprintf(readme, "The study names '%s': that is systems/%s.yaml.\n\n", e->name, e->label);
        return CLI_DONE;
    }
    return add_file(p, name, e->copy);
}

static int describe_study(pack *p, FILE *readme)
{
    study_directory dir;
    study_plan plan = {0};
    study_directory_open(&dir, p->set->directory);
    int status = study_directory_read(&dir, &plan);
    fprintf(readme, made_by, "dalembert study study.yaml");
    for (int i = 0; i < plan.case_count && status == CLI_DONE; i++) {
        const study_case *e = &plan.cases[i];
        int first = 0;
        while (strcmp(plan.cases[first].name, e->name) != 0) first++;
        if (first == i) status = e->copy ? add_system(p, readme, e) : add_builtin(p, e->name);
    }
    study_plan_free(&plan);
    study_directory_close(&dir);
    return status;
}

static int describe(pack *p, FILE *readme)
{
    const char *directory = p->set->directory;
    int status = CLI_DONE;
    fprintf(readme, "%s, packed by dalembert %s.\n\n", p->name, DAL_VERSION);
    if (file_is_in(directory, "study.yaml"))
        status = describe_study(p, readme);
    else if (file_is_in(directory, "manifest.json") && file_is_in(directory, "trajectory.npy"))
        status = describe_run(p, readme);
    else
        fputs("The request is in a file of this directory that ends in .json.\n\n", readme);
    fputs(
        "The version that made it, the compiler and the machine are in manifest.json, where there "
        "is one.\n\nBytes and names of the files:\n\n",
        readme);
    return status;
}

/* Adds README.txt where the files before it were added; ends the list of them anyway. */
static int add_readme(pack *p, int status)
{
    char *text, *name = cli_format("%s/README.txt", p->name);
    size_t length;
    FILE *readme = cli_memstream_open(&text, &length);
    if (status == CLI_DONE) status = describe(p, readme);
    cli_memstream_close(p->names);
    fputs(p->list, readme);
    cli_memstream_close(readme);
    if (status == CLI_DONE) status = tar_add(p->out, name, text, length);
    free(name);
    free(text);
    free(p->list);
    return status;
}

/* ---- all ----------------------------------------------------------------------------------- */

/* The last part of a path, allocated. */
static char *name_of(const char *path)
{
    size_t end = strlen(path);
    while (end > 1 && path[end - 1] == '/') end--;
    size_t begin = end;
    while (begin > 0 && path[begin - 1] != '/') begin--;
    const bool is_place = end - begin <= 2 && strncmp(path + begin, "..", end - begin) == 0;
    return is_place ? cli_strdup("results") : cli_strndup(path + begin, end - begin);
}

static int check_input(const settings *s)
{
    file_names names = {0};
    int status = file_find_directory(s->directory);
    if (status == CLI_DONE) status = file_list(s->directory, &names);
    if (status == CLI_DONE && (names.count == 0 || !file_owns_directory(s->directory)))
        status = cli_fail(CLI_USAGE, "'%s' holds no results of dalembert", s->directory);
    file_free_names(&names);
    return status;
}

static int write_archive(const settings *s, const char *output, const char *name)
{
    pack p = {.set = s, .name = name};
    file_output file;
    if (!s->force && strcmp(output, "-") != 0 && file_exists(output) && cli_ends_in(output, ".tar"))
        return cli_fail(CLI_USAGE, "'%s' exists; --force overwrites it", output);
    int status = file_output_open(&file, output);
    if (status != CLI_DONE) return status;
    p.out = file.stream;
    p.names = cli_memstream_open(&p.list, &p.list_length);
    status = add_readme(&p, add_directory(&p, s->directory, "", 0));
    tar_end(p.out);
    status = file_output_close(&file, status);
    if (status == CLI_DONE && strcmp(output, "-") != 0)
        cli_note("packed %d files into '%s'", p.files, output);
    return status;
}

static int pack_command(int argc, char **argv)
{
    settings s = {0};
    const cli_option_set set = CLI_OPTION_SET(options, &s);
    int status = cli_read_arguments(&command_pack, argc, argv, &set, 1);
    if (status != CLI_GO_ON) return status;
    status = check_input(&s);
    if (status != CLI_DONE) return status;
    char *name = name_of(s.directory), *beside = cli_format("%s.tar", name);
    status = write_archive(&s, s.output ? s.output : beside, name);
    free(name);
    free(beside);
    return status;
}

const cli_command command_pack = {
    .name = "pack",
    .synopsis = "dalembert pack DIR [OPTION]...",
    .about = "packs inputs and tables of a result into one archive",
    .notes =
        "The archive has the requests and system files, the manifests with version, compiler and "
        "machine, all tables, and README.txt, which says by which command they were made; of a run "
        "of a built-in system also its file, in builtin/.  Rows, checkpoints and the page are "
        "packed with --all.  It is a tar file without compression (ustar); equal files make equal "
        "archives.\n",
    .run = pack_command,
};
