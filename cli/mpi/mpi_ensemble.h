/* mpi_ensemble.h - an ensemble on the processes of a cluster. */
#ifndef DAL_CLI_MPI_ENSEMBLE_H
#define DAL_CLI_MPI_ENSEMBLE_H

#include "mpi_work.h"

/* On rank 0: reads the arguments, begins the ensemble in its directory and fills the request.
 * Returns CLI_GO_ON, or an exit status after --help or a message. */
int mpi_ensemble_begin(mpi_request *request, int argc, char **argv);
/* On all ranks: runs the ensemble of the directory; rank 0 finishes it.  Returns an exit status,
 * which is the job's on rank 0. */
int mpi_ensemble_run(const mpi_request *request);

#endif
