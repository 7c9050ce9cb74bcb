/* merge.c - `dalembert merge`: makes the shards of a study or of an ensemble one. */
#include "ensemble/ensemble_directory.h"
#include "ensemble/ensemble_merge.h"
#include "report/report_ensemble.h"
#include "report/report_study.h"
#include "run/pool.h"
#include "study/study_merge.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

enum { MAX_SOURCES = 1024 };

typedef struct settings {
    const char *source[MAX_SOURCES];
    int sources;
    const char *output;
    long long threads;
    bool force, no_page;
} settings;

static int parse_source(void *user, const cli_option *option, const char *text)
{
    settings *s = user;
    (void)option;
    if (s->sources == MAX_SOURCES)
        return cli_fail(CLI_USAGE, "merge: more than %d directories", MAX_SOURCES);
    s->source[s->sources++] = text;
    return CLI_DONE;
}

static const cli_option options[] = {
    {"output", "DIR", CLI_REQUIRED,
     "writes the whole study there; may be one of those that are merged",
     CLI_TEXT(settings, output)},
    POOL_THREADS_OPTION(settings, "runs read at a time"),
    REPORT_NO_PAGE_OPTION(settings),
    {"force", NULL, NULL, "overwrites what the directory holds, unless it is one of those",
     CLI_FLAG(settings, force)},
    {NULL, "DIR...", CLI_REQUIRED, "what 'study' or 'ensemble' wrote with --shard K/N --output DIR",
     .parse = parse_source},
};

static int merge(int argc, char **argv)
{
    settings s = {.threads = pool_threads()};
    const cli_option_set set = CLI_OPTION_SET(options, &s);
    int status = cli_read_arguments(&command_merge, argc, argv, &set, 1);
    if (status != CLI_GO_ON) return status;
    bool is_ensemble;
    status = ensemble_directory_find(s.source[0], &is_ensemble);
    if (status != CLI_DONE) return status;
    status = is_ensemble ? ensemble_merge(s.source, s.sources, s.output, (int)s.threads, s.force)
                         : study_merge(s.source, s.sources, s.output, (int)s.threads, s.force);
    if (s.no_page) return status;
    return is_ensemble ? report_after_ensemble(s.output, status)
                       : report_after_study(s.output, status, REPORT_NAMED);
}

const cli_command command_merge = {
    .name = "merge",
    .synopsis = "dalembert merge DIR... --output DIR [OPTION]...",
    .about = "joins the shards of a study or of an ensemble",
    .notes = "Shards may share a directory.  Except for times, tables and files have the bytes of "
             "the undivided study or ensemble.\n",
    .run = merge,
};
