/* file.c - system files on disk. */
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
    char *text = malloc(DAL__MAX_BYTES + 1);
    /* One byte more than allowed is read, so that dal_model_read sees an overlong file. */
    if (text) length = fread(text, 1, DAL__MAX_BYTES + 1, file);
    dal_status status = !text ? dal__memory_error(error) : ferror(file) ? io_error(error) : DAL_OK;
    fclose(file);
    name_of(path, name, sizeof name);
    if (status == DAL_OK) status = dal_model_read(model, name, text, length, error);
    free(text);
    return status;
}
