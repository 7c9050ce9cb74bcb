/* mpi_work.h - a list of work on the processes of a job, and what all of them know. */
#ifndef DAL_CLI_MPI_WORK_H
#define DAL_CLI_MPI_WORK_H

#include "run/native.h"
#include "run/work.h"

enum { MPI_MAX_PATH = 4096 };

typedef struct mpi_request {
    char output[MPI_MAX_PATH];
    bool is_ensemble;
    double interval; /* seconds between checkpoints */
    native_mode native;
    int rank, size; /* of this process, and how many there are */
} mpi_request;

/* Stores where the directory is.  Returns CLI_DONE, or prints and returns CLI_USAGE. */
int mpi_set_output(mpi_request *request, const char *path);
/* The largest exit status of all processes. */
int mpi_max_status(int status);
/* Runs a list, of which all processes know the same, on one thread each.  After a failure of one of
 * them the others run what remains. */
work_runner mpi_run_list;

#endif
