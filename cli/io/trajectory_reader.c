/* trajectory_reader.c - the rows in the directory of a run, read one by one. */
#include "trajectory_reader.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "output.h"

#include <errno.h>
#include <stdlib.h>

int reader_open(trajectory_reader *reader, const char *directory)
{
    static const char name[] = "trajectory.npy";
    *reader = (trajectory_reader){.path = cli_join(directory, name)};
    reader->file = fopen(reader->path, "rb");
    int status = CLI_DONE;
    if (reader->file)
        status = npy_read_header(&reader->npy, reader->file, reader->path);
    else if (errno == ENOENT || errno == ENOTDIR)
        status = cli_fail(CLI_USAGE, "'%s' holds no run: there is no %s", directory, name);
    else
        status = cli_io("read", reader->path);
    if (status != CLI_DONE) {
        reader_close(reader);
        return status;
    }
    reader->columns = reader->npy.columns;
    reader->name = reader->npy.names;
    reader->count = reader->npy.rows;
    reader->bytes = cli_calloc((size_t)reader->columns, sizeof(double));
    reader->row = cli_calloc((size_t)reader->columns, sizeof(double));
    return CLI_DONE;
}

int reader_next(trajectory_reader *reader)
{
    const size_t length = (size_t)reader->columns * sizeof(double);
    if (reader->next >= reader->count) return 0;
    reader->next++;
    errno = EIO; /* of a file that was cut since its header was read */
    if (fread(reader->bytes, 1, length, reader->file) != length) {
        cli_io("read", reader->path);
        return -1;
    }
    npy_decode(reader->bytes, reader->row, reader->columns);
    return 1;
}

int reader_seek(trajectory_reader *reader, long long k)
{
    const long long bytes = k * reader->columns * (long long)sizeof(double);
    if (fseeko(reader->file, (off_t)reader->npy.offset + (off_t)bytes, SEEK_SET) != 0)
        return cli_io("read", reader->path);
    reader->next = k;
    return CLI_DONE;
}

void reader_close(trajectory_reader *reader)
{
    if (reader->file) fclose(reader->file);
    npy_free_columns(&reader->npy);
    free(reader->row);
    free(reader->bytes);
    free(reader->path);
    *reader = (trajectory_reader){0};
}
