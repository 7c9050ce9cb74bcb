/* error_shares.h - between the runs of an error budget (error_budget.c) and its shares. */
#ifndef DAL_ERROR_SHARES_H
#define DAL_ERROR_SHARES_H

#include "dalembert_budget.h"

/* Series of every observable: of the whole run, of the comparisons, and of the beginning. */
typedef enum dal__series_of_run {
    DAL__WHOLE_RUN,
    DAL__FIRST_RUN = DAL_COMPARISONS + 1,
    DAL__FIRST_ROUNDING,
    DAL__FIRST_SOLVER,
    DAL__FIRST_SOLVER_AND_ROUNDING,
    DAL__FIRST_MOTION,
    DAL__FIRST_ERROR,
    DAL__FIRST_ERROR_HALVED,
    DAL__COMPARED_SERIES
} dal__series_of_run;

/* Finds the shares from the trends of all these series and from is_conserved; rate[1 +
 * DAL_COMPARISONS]: of least squares, of the whole run and of the comparisons. */
void dal__find_shares(const dal_error_budget *budget, dal_shares *shares, const double *rate);

/* Whether F has branches (if, abs, min, ...). */
bool dal__has_branches(const dal_system *system);

#endif
