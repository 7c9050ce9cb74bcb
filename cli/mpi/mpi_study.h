/* mpi_study.h - a study on the processes of a cluster. */
#ifndef DAL_CLI_MPI_STUDY_H
#define DAL_CLI_MPI_STUDY_H

#include "mpi_work.h"

/* On rank 0: reads the arguments, begins the study in its directory, unless it is resumed, and
 * fills the request.  Returns CLI_GO_ON, or an exit status after --help or a message. */
int mpi_study_begin(mpi_request *request, int argc, char **argv);
/* On all ranks: runs the study of the directory; rank 0 finishes it.  Returns an exit status, which
 * is the job's on rank 0. */
int mpi_study_run(const mpi_request *request);

#endif
