/* dalembert_analysis.h - statistics, trends, checks, order, error budgets, predictions, Lyapunov
 * exponents, sections, invariants, actions, Dirac's procedure and steering, each in a header of its
 * own.
 *
 * The conventions of dalembert.h hold here.  All of it is made of the public functions of
 * dalembert.h. */
#ifndef DALEMBERT_ANALYSIS_H
#define DALEMBERT_ANALYSIS_H

#include "dalembert.h"
#include "dalembert_action.h"
#include "dalembert_budget.h"
#include "dalembert_dirac.h"
#include "dalembert_dynamics.h"
#include "dalembert_evaluator.h"
#include "dalembert_invariants.h"
#include "dalembert_order.h"
#include "dalembert_predict.h"
#include "dalembert_sensitivity.h"
#include "dalembert_statistics.h"
#include "dalembert_steer.h"

#endif
