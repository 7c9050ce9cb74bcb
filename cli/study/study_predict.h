/* study_predict.h - what single steps predict of the runs of a study, beside what was measured. */
#ifndef DAL_CLI_STUDY_PREDICT_H
#define DAL_CLI_STUDY_PREDICT_H

#include "dalembert_run.h"
#include "run/work.h"
#include "study_data.h"

#include <stdbool.h>

/* The exact motions of the cases, each of which its cells share. */
struct study_motion *study_motions_create(int cases);
void study_motions_free(struct study_motion *motions, int cases);
/* Predicts a cell that has the results of its run, up to the end of that; or reads what was
 * predicted before.  spec is the run's.  Returns CLI_DONE, CLI_SIGNAL when it was stopped, or
 * prints and returns an exit status.  Different cells may be predicted by different threads. */
int study_predict_cell(const study_plan *plan, study_cell *cell, const dal_run_spec *spec,
                       double end, const work_stop *stop);
/* The trends that tables show of what is predicted, the invariant being the one that moved farthest
 * in the run; empty without a prediction. */
study_quantities study_predicted_quantities(const study_cell *cell);
/* A sentence about predicted and measured sizes; NULL: the study predicts nothing.  Allocated. */
char *study_describe_predictions(const study_plan *plan);

#endif
