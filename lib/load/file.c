/* file.c - system files on disk and those that travel inside the library. */
#include "model/mechanics.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- on disk ---- */

static dal_status io_error(dal_error *error)
{
    return dal__fail(error, DAL_IO, "%s", errno ? strerror(errno) : "cannot be read");
}

/* One byte more than allowed is read, so that dal_model_read sees an overlong file. */
static dal_status read_all(FILE *file, char *text, size_t *length, dal_error *error)
{
    errno = 0;
    *length = fread(text, 1, DAL__MOST_BYTES + 1, file);
    return ferror(file) ? io_error(error) : DAL_OK;
}

/* The name of the file without folders and ".yaml"; at most size bytes with the NUL. */
static void name_of(const char *path, char *name, size_t size)
{
    static const char ending[] = ".yaml";
    const char *slash = strrchr(path, '/'), *begin = slash ? slash + 1 : path;
    size_t length = strlen(begin), tail = sizeof ending - 1;
    if (length > tail && strcmp(begin + length - tail, ending) == 0) length -= tail;
    snprintf(name, size, "%.*s", (int)(length < size ? length : size - 1), begin);
}

dal_status dal_model_read_file(dal_model **model, const char *path, dal_error *error)
{
    DAL_REQUIRE(model, error);
    char name[256];
    size_t length = 0;
    *model = NULL;
    DAL_REQUIRE(path, error);
    errno = 0;
    FILE *file = fopen(path, "rb");
    if (!file) return io_error(error);
    char *text = malloc(DAL__MOST_BYTES + 1);
    dal_status status = text ? read_all(file, text, &length, error) : dal__starved(error);
    fclose(file);
    name_of(path, name, sizeof name);
    if (status == DAL_OK) status = dal_model_read(model, name, text, length, error);
    free(text);
    return status;
}

/* ---- inside ---- */

dal_status dal_model_builtin(dal_model **model, const char *name, dal_error *error)
{
    DAL_REQUIRE(model, error);
    const char *names[64], *text = dal_builtin_text(name);
    int count = 0;
    *model = NULL;
    DAL_REQUIRE(name, error);
    if (text) return dal_model_read(model, name, text, strlen(text), error);
    while (count < 64 && dal_builtin_name(count)) {
        names[count] = dal_builtin_name(count);
        count++;
    }
    return dal__unknown(error, "system", name, names, count);
}
