/* causes.h - between the twins' runs (twins.c) and what they tell (causes.c). */
#ifndef DAL_CAUSES_H
#define DAL_CAUSES_H

#include "dalembert.h"

/* Series that are followed of every observable: of the whole run and its twins, and early. */
typedef enum dal__series_of_run {
    DAL__ALL,
    DAL__EARLY_RUN = DAL_TWINS + 1,
    DAL__EARLY_ROUNDING,
    DAL__EARLY_SOLVER,
    DAL__EARLY_BOTH,
    DAL__SERIES
} dal__series_of_run;

/* The findings of an attribution are made; says what they tell of the causes. */
void dal__attribute(const dal_explanation *explanation, dal_attribution *of);

#endif
