/* causes.h - between the twins' runs (twins.c) and what they tell (causes.c). */
#ifndef DAL_CAUSES_H
#define DAL_CAUSES_H

#include "dalembert_analysis.h"

/* Series that are followed of every observable: of the whole run and its twins, and early. */
typedef enum dal__series_of_run {
    DAL__WHOLE_RUN,
    DAL__FIRST_RUN = DAL_COMPARISONS + 1,
    DAL__FIRST_ROUNDING,
    DAL__FIRST_SOLVER,
    DAL__FIRST_SOLVER_AND_ROUNDING,
    DAL__SERIES
} dal__series_of_run;

/* The findings of an attribution are made; says what they tell of the causes. */
void dal__find_shares(const dal_error_budget *budget, dal_shares *of);

#endif
