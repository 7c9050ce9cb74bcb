/* dalembert_mpi.c - the program `dalembert-mpi`: studies and ensembles on the processes of a
 * cluster.
 *
 *     mpirun -n 64 dalembert-mpi STUDY.yaml --output DIR
 *     mpirun -n 64 dalembert-mpi ensemble SYSTEM ... --output DIR
 *     mpirun -n 64 dalembert-mpi --resume --output DIR
 *
 * All processes must see DIR. */
#include "ensemble/ensemble_directory.h"
#include "mpi_ensemble.h"
#include "mpi_study.h"
#include "ui/arguments.h"
#include "ui/message.h"
#include "ui/screen.h"

#include <mpi.h>
#include <string.h>

/* On rank 0: begins a study or an ensemble; what is resumed is known by its directory. */
static int begin(mpi_request *request, int argc, char **argv)
{
    int status = argc > 1 && strcmp(argv[1], "ensemble") == 0
                     ? mpi_ensemble_begin(request, argc - 1, argv + 1)
                     : mpi_study_begin(request, argc, argv);
    if (status != CLI_GO_ON) return status;
    status = ensemble_directory_find(request->output, &request->is_ensemble);
    return status == CLI_DONE ? CLI_GO_ON : status;
}

int main(int argc, char **argv)
{
    int rank, status = CLI_DONE;
    mpi_request request = {.interval = 0.0};
    MPI_Init(&argc, &argv);
    screen_ignore_terminal();
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0) status = begin(&request, argc, argv);
    MPI_Bcast(&status, 1, MPI_INT, 0, MPI_COMM_WORLD);
    MPI_Bcast(&request, sizeof request, MPI_BYTE, 0, MPI_COMM_WORLD);
    request.rank = rank;
    MPI_Comm_size(MPI_COMM_WORLD, &request.size);
    if (status == CLI_GO_ON)
        status = request.is_ensemble ? mpi_ensemble_run(&request) : mpi_study_run(&request);
    /* All ranks return the same status, so that mpirun does not blame one of them. */
    MPI_Bcast(&status, 1, MPI_INT, 0, MPI_COMM_WORLD);
    MPI_Finalize();
    return status;
}
