/* sizes.h - the unit of time and the lengths of a system's motion near a state. */
#ifndef DAL_CORE_SIZES_H
#define DAL_CORE_SIZES_H

#include "core/error.h"
#include "dalembert_system.h"

/* A state, and what is found there. */
typedef struct dal__sizes {
    const dal_system *system;
    double *work;    /* [workspace] of the system, prepared */
    double t, step;  /* step: the unit of time, divided by 10, where nothing else says it; or 0 */
    const double *x; /* [n + nw] (q, v, g) */
    double time, *length, *mass, *field; /* found: [n], [n]; [nw] F at x */
    double *other, *scratch, *jacobian;
} dal__sizes;

/* Numbers of memory that dal__find_sizes needs. */
size_t dal__sizes_memory(const dal_system *system);

/* Finds time, length, mass and field, which then lie in memory.  1/time is the spectral radius of
 * J = (0 1; F_q F_v) there, by power iteration after balancing (Osborne 1960, DOI
 * 10.1145/321043.321048), or the rate of the motion; length_i the largest time |v_i| or time^2
 * |F_i| at the beginning of the motion, 0 where that is no more than roundings or the error of a
 * step; or the length of equal kinetic energy, |q_i|, 1, the first that is not 0; mass_i is W_ii,
 * or 0 where it is not known.  Time and lengths are powers of two, which change with the units of
 * the user as t and q do. */
void dal__find_sizes(dal__sizes *sizes, double *memory);

/* The unit of time of a system, a power of two: the unit of a coordinate over its velocity's. */
static inline double dal__unit_of_time(const dal_system *system)
{
    return system->units ? system->units[0] / system->units[system->n] : 1.0;
}

/* A power of two near x; 0, or 1 for what is not finite.  Numbers that are usual, as 1, sqrt(2) and
 * 2, are far from where it changes. */
double dal__near_power_of_two(double x);

#endif
