/* mpi_request.c - what all processes of a job know. */
#include "mpi_request.h"
#include "ui/message.h"

#include <mpi.h>
#include <string.h>

int mpi_set_output(mpi_request *request, const char *path)
{
    if (strlen(path) >= sizeof request->output)
        return cli_fail(CLI_USAGE, "--output: the path is too long");
    memcpy(request->output, path, strlen(path) + 1);
    return CLI_DONE;
}

int mpi_max_status(int status)
{
    int max;
    MPI_Allreduce(&status, &max, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return max;
}
