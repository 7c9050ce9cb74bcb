/* trial.h - a function of the library on a system whose callbacks fail: whichever call does, its
 * status is DAL_STATUS_IO, or one that says what became of it, with a message; unless its result is
 * NaN or the one without a failure.  It fails alone, with a few calls after it, or with all. */
#ifndef TRIAL_H
#define TRIAL_H

#include <dalembert.h>

enum { TRIAL_NUMBERS = 300 };
#define TRIAL_STEP  0.1
#define TRIAL_FAILS (-1.0)

typedef struct trial {
    dal_run_spec spec;
    dal_model *model; /* of the system, for a function that wants one; else NULL */
    double tolerance; /* of a result that differences with another increment may have; INFINITY:
                       * of what the library only tries, as to hold a branch, any; TRIAL_FAILS:
                       * no failure leaves a result */
    dal_error error;
    double out[TRIAL_NUMBERS];
    int count;
} trial;
typedef dal_status trial_work(trial *t);

void trial_add(trial *t, const double *numbers, int count);
void trial_add_number(trial *t, double number);
void trial_add_run(trial *t, const dal_run *run); /* its state */

/* Every call of the work on a system fails, or 600 of them, a third in a quick run. */
void trial_each_call(const char *text, const char *method, dal_space space, double tolerance,
                     trial_work *work);
/* Likewise every call of some callbacks, NULL ends them, in a quick run, too. */
void trial_each_call_of(const char *const *names, const char *text, const char *method,
                        double tolerance, trial_work *work);
/* Likewise on the lifted space with another K than the paper's. */
void trial_each_lifted_call(const char *text, dal_effort effort, const char *method,
                            double tolerance, trial_work *work);
/* All calls of one callback fail, of each that the work calls: its status is DAL_STATUS_IO. */
void trial_each_callback(const char *text, dal_effort effort, const char *method, dal_space space,
                         trial_work *work);
/* Likewise of work with a tangent system, *tangent meanwhile, whose calls alone fail. */
void trial_each_tangent_call(const char *text, const char *method, dal_space space,
                             double tolerance, trial_work *work, const dal_system **tangent);
/* Likewise of work that makes runs of its own of a model, whose system is changed. */
void trial_each_model_call(const char *text, const char *method, dal_space space, double tolerance,
                           trial_work *work);
/* Every allocation of the work fails, with all after it and alone: its status is DAL_STATUS_MEMORY.
 * In a quick run every second one. */
void trial_each_allocation(const char *text, const char *method, dal_space space, trial_work *work);

#endif
