/* lyapunov.c - `dalembert lyapunov`: the Lyapunov exponents of a motion. */
#include "analyse/lyapunov.h"
#include "report/report_section.h"
#include "ui/commands.h"

static int make_lyapunov_page(const char *directory, int status)
{
    return report_after(directory, status, report_lyapunov);
}

static int lyapunov(int argc, char **argv)
{
    return lyapunov_measure(&command_lyapunov, argc, argv, make_lyapunov_page);
}

const cli_command command_lyapunov = {
    .name = "lyapunov",
    .synopsis = "dalembert lyapunov SYSTEM [OPTION]...",
    .about = "computes the Lyapunov exponents of a motion",
    .notes =
        "The derivative of each step moves tangent vectors on (q,v), which then are made "
        "orthonormal again.  The exponents, per unit of t, are the means of the logarithms of the "
        "lengths that this takes away; they belong to the motion of the method.  The derivative "
        "is exact for Runge-Kutta, partitioned symplectic and composed methods, and by "
        "differences for the others.\n"
        "\n"
        "--space lifted is of (q,v,p,pi) at constant e, for methods with an exact derivative: the "
        "lift is Hamiltonian, so that its 4n exponents are in pairs L and -L; on p = pi = 0 they "
        "are the exponents of (q,v) and their negatives.\n"
        "\n"
        "The means cover --time, after the transient.  Their intervals come from means of blocks "
        "and do not cover a slow approach to a limit: exponents of regular motion fall like "
        "log(t)/t, and what is smaller than that is not distinguished from 0.  Every constraint "
        "adds an exponent 0, since D is constant on each level; a method that enforces D = 0 has "
        "no direction for it, nor for holonomic constraints.  The sum of all exponents is the "
        "mean divergence of the motion, plus, where the method enforces D = 0, the mean growth "
        "of log |grad D|.  The exit status is 3 when the two differ by more than the error of "
        "the method: then the derivative of the steps is not reliable.\n"
        "\n"
        "FILE and DIR/lyapunov.csv get rows t, lambda1, .., divergence: the means so far.\n",
    .run = lyapunov,
};
