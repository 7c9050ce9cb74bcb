/* chart_library.c - finds and reads the library of charts. */
#include "chart_library.h"

#include "file.h"
#include "file_output.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const char script_name[] = "uPlot.iife.min.js", style_name[] = "uPlot.min.css",
                  licence_name[] = "LICENSE";

/* ---- where it is --------------------------------------------------------------------------- */

static bool holds_library(const char *directory)
{
    return file_is_in(directory, script_name) && file_is_in(directory, style_name) &&
           file_is_in(directory, licence_name);
}

/* A directory of the library below one of data, or NULL; base may be NULL or empty. */
static char *find_below(const char *base, const char *data)
{
    if (!base || !base[0]) return NULL;
    char *directory = cli_format("%s%s/dalembert/uplot", base, data);
    if (holds_library(directory)) return directory;
    free(directory);
    return NULL;
}

/* ---- what it is ---------------------------------------------------------------------------- */

static int read_library_file(const char *directory, const char *name, char **text)
{
    size_t length;
    char *path = cli_join(directory, name);
    int status = CLI_DONE;
    *text = file_read(path, &length);
    if (!*text)
        status = CLI_IO;
    else if (strlen(*text) < length || strstr(*text, "</") ||
             (name == licence_name && strstr(*text, "*/")))
        status = cli_fail(CLI_USAGE, "'%s' is not a part of " CHART_LIBRARY, path);
    free(path);
    return status;
}

/* None of its parts may end the element or the comment that it becomes. */
int chart_library_read(chart_library *library)
{
    const char *own = getenv("DALEMBERT_UPLOT"), *user = getenv("XDG_DATA_HOME");
    const bool has_own = own && own[0], has_user = user && user[0];
    char *directory = NULL;
    *library = (chart_library){.script = NULL};
    if (has_own && holds_library(own)) directory = cli_strdup(own);
    if (!has_own)
        directory = find_below(has_user ? user : getenv("HOME"), has_user ? "" : "/.local/share");
    if (!has_own && !directory) directory = find_below("/usr/local/share", "");
    if (!has_own && !directory) directory = find_below("/usr/share", "");
    if (!directory) return CLI_DONE;
    int status = read_library_file(directory, script_name, &library->script);
    if (status == CLI_DONE) status = read_library_file(directory, style_name, &library->style);
    if (status == CLI_DONE) status = read_library_file(directory, licence_name, &library->licence);
    free(directory);
    return status;
}

void chart_library_free(chart_library *library)
{
    free(library->script);
    free(library->style);
    free(library->licence);
    *library = (chart_library){.script = NULL};
}
