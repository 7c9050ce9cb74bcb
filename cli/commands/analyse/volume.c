/* volume.c - `dalembert volume`: the rate at which the volume of the phase space changes. */
#include "analyse/lyapunov.h"
#include "report/report_section.h"
#include "ui/commands.h"

static int make_volume_page(const char *directory, int status)
{
    return report_after(directory, status, report_volume);
}

static int volume(int argc, char **argv)
{
    return lyapunov_measure_volume(&command_volume, argc, argv, make_volume_page);
}

const cli_command command_volume = {
    .name = "volume",
    .synopsis = "dalembert volume SYSTEM [OPTION]...",
    .about = "computes the rate at which the volume of the phase space changes",
    .notes =
        "The command computes two rates along the run: the exact divergence of the motion in "
        "(q,v), which is the trace of the derivative of F by v, and log|det J|/h of every step, J "
        "being its derivative: what the method does to the volume.  Where the method enforces D = "
        "0, the second is that on the surface.\n"
        "\n"
        "A system with an invariant measure of bounded density has the mean 0; a negative mean "
        "shows an attractor.  The means on (q,v) and on D = 0 differ by the mean growth of log "
        "|grad D|.  The exit status is 3 when they differ by more than that and the error of the "
        "method: then the derivative of the steps is not reliable.  The means cover --time, after "
        "the transient.  FILE and DIR/volume.csv get rows t, divergence, step: the means so far.\n",
    .run = volume,
};
