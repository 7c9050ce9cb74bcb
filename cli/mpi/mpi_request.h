/* mpi_request.h - what all processes of a job know; the rest they read from the directory. */
#ifndef DAL_CLI_MPI_REQUEST_H
#define DAL_CLI_MPI_REQUEST_H

#include "run/native.h"

#include <stdbool.h>

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

#endif
