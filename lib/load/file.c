/* file.c - system files on disk. */
#include "load/file.h"
#include "load/yaml.h"
#include "model/model.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static dal_status io_error(dal_error *error)
{
    return dal__fail(error, DAL_IO, "%s", errno ? strerror(errno) : "cannot be read");
}

/* The name of the file without directories and ".yaml"; at most size bytes with the NUL. */
static void name_of(const char *path, char *name, size_t size)
{
    static const char ending[] = ".yaml";
    const char *slash = strrchr(path, '/'), *begin = slash ? slash + 1 : path;
    size_t length = strlen(begin), ending_length = sizeof ending - 1;
    if (length > ending_length && strcmp(begin + length - ending_length, ending) == 0)
        length -= ending_length;
    snprintf(name, size, "%.*s", (int)(length < size ? length : size - 1), begin);
}

char *dal__read_file(const char *path, size_t *length, dal_error *error)
{
    *length = 0;
    errno = 0;
    FILE *file = fopen(path, "rb");
    if (!file) return io_error(error), NULL;
    char *text = malloc(DAL__MAX_BYTES + 1);
    /* One byte more than allowed is read, so that an overlong file is seen. */
    if (text) *length = fread(text, 1, DAL__MAX_BYTES + 1, file);
    const dal_status status = !text          ? dal__memory_error(error)
                              : ferror(file) ? io_error(error)
                                             : DAL_OK;
    fclose(file);
    if (status == DAL_OK) return text;
    free(text);
    return NULL;
}

dal_status dal_model_read_file(dal_model **model, const char *path, dal_error *error)
{
    DAL_REQUIRE(model, error);
    char name[256];
    dal_error reason;
    *model = NULL;
    DAL_REQUIRE(path, error);
    name_of(path, name, sizeof name);
    dal__system_text system = {.name = name};
    char *text = dal__read_file(path, &system.length, &reason);
    if (!text) return dal__fail(error, reason.status, "%s", reason.message);
    const char *slash = strrchr(path, '/');
    const size_t folders = slash ? (size_t)(slash - path) + 1 : 0;
    char *directory = malloc(folders + 1);
    if (directory) {
        memcpy(directory, path, folders);
        directory[folders] = 0;
    }
    system.text = text;
    system.directory = directory;
    const dal_status status =
        directory ? dal__read_system(model, &system, error) : dal__memory_error(error);
    free(directory);
    free(text);
    return status;
}
