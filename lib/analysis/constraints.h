/* constraints.h - the constraint blocks at a point. */
#ifndef DAL_CONSTRAINTS_H
#define DAL_CONSTRAINTS_H

#include "dalembert_analysis.h"

/* G = A W^-1 A^T [m*m] from the block D, A, W^-1 A^T that a system's constraint callback gives. */
void dal__gram_matrix(const dal_system *system, const double *block, double *gram);

#endif
