/* file.c - reads files on disk. */
#include "load/file.h"
#include "model/model.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static dal_status io_error(dal_error *error)
{
    return dal__fail(error, DAL_STATUS_IO, "%s", errno ? strerror(errno) : "cannot be read");
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
                                             : DAL_STATUS_OK;
    fclose(file);
    if (status == DAL_STATUS_OK) return text;
    free(text);
    return NULL;
}

size_t dal__mark_length(const char *text, size_t length)
{
    static const char mark[] = "\xEF\xBB\xBF";
    return length >= 3 && memcmp(text, mark, 3) == 0 ? 3 : 0;
}
