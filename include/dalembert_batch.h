/* dalembert_batch.h - batches and ensembles: many runs, several lanes at a time.
 *
 * A part of dalembert.h, which has the conventions. */
#ifndef DALEMBERT_BATCH_H
#define DALEMBERT_BATCH_H

#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- batches ------------------------------------------------------------------------------- */

/* Many runs of one system and method, called lanes, that differ in parameters and start. */
typedef struct dal_batch dal_batch;
/* Makes count runs of one spec that are stepped several at a time, each with the bits of a single
 * run.  width: max lanes at a time, 1, 4 or 8; 0: the fastest.  [alloc]  Errors: as for
 * dal_run_init, DAL_STATUS_ARGUMENT (count, width), DAL_STATUS_UNSUPPORTED (quad precision). */
dal_status dal_batch_create(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                            dal_error *error);
/* Frees a batch. */
void dal_batch_free(dal_batch *batch);
/* Sets parameters[parameter_count] and start[start_count] of one lane, which replace the spec's, at
 * its start.  Errors: as for dal_run_init; DAL_STATUS_ARGUMENT (lane, or after a step, unless
 * dal_batch_clear was called). */
dal_status dal_batch_start(dal_batch *batch, int lane, const dal_setting *parameters,
                           int parameter_count, const dal_setting *start, int start_count,
                           dal_error *error);
/* Replaces time and state of one lane, state[dimension], and clears all other persistent state of
 * it, as dal_run_set_state; a lane that had failed, or was taken out, is stepped again.  Lanes may
 * have times of their own: where F or the gauge depends on t, lanes of different times are stepped
 * one after the other.  Errors: DAL_STATUS_NOT_FINITE, DAL_STATUS_ARGUMENT (lane). */
dal_status dal_batch_set_state(dal_batch *batch, int lane, double t, const double *state,
                               dal_error *error);
/* Takes all lanes out of the batch, which keeps its memory and its compiled steps: only lanes that
 * dal_batch_start starts again, from the start_time, are then stepped. */
dal_status dal_batch_clear(dal_batch *batch);
/* dal_run_set_parameter for one lane.  Errors: also DAL_STATUS_ARGUMENT (lane), the status of a
 * lane that has failed. */
dal_status dal_batch_set_parameter(dal_batch *batch, int lane, const char *name, double value,
                                   dal_error *error);
/* Takes count steps in every lane that has not failed.  A lane that fails keeps the state before
 * the failing step and does not slow down the others.  Returns DAL_STATUS_OK while a lane is
 * left. */
dal_status dal_batch_advance(dal_batch *batch, long long count);
/* The number of lanes. */
int dal_batch_count(const dal_batch *batch);
/* The status of a lane: DAL_STATUS_OK, or why its step failed; DAL_STATUS_ARGUMENT without the
 * lane. */
dal_status dal_batch_status(const dal_batch *batch, int lane, dal_error *error);
/* The present time of a lane; NaN without the lane. */
double dal_batch_time(const dal_batch *batch, int lane);
/* Copies the state of a lane to state[dimension], ordered as dal_run_state. */
void dal_batch_state(const dal_batch *batch, int lane, double *state);
/* Copies the states of all lanes, one after the other, to states[count*dimension]. */
void dal_batch_states(const dal_batch *batch, double *states);

/* ---- ensembles ----------------------------------------------------------------------------- */

/* Distributions: DISTRIBUTION(code, word).  uniform(low, high); normal(mean, standard deviation);
 * lognormal: exp of a normal one of that mean and deviation. */
#define DAL_DISTRIBUTION_LIST(DISTRIBUTION)                                                        \
    DISTRIBUTION(UNIFORM, "uniform")                                                               \
    DISTRIBUTION(NORMAL, "normal")                                                                 \
    DISTRIBUTION(LOGNORMAL, "lognormal")

/* A distribution of two numbers. */
typedef enum dal_distribution {
#define DISTRIBUTION_CODE(code, word) DAL_##code,
    DAL_DISTRIBUTION_LIST(DISTRIBUTION_CODE)
#undef DISTRIBUTION_CODE
} dal_distribution;

enum { DAL_VARIATION_NAME = 64 /* bytes of the name of a variation */ };

/* What is added to a number of the start, x, x', e, p_x, .., or to a parameter of each member of an
 * ensemble. */
typedef struct dal_variation {
    char name[DAL_VARIATION_NAME]; /* of what it is added to */
    dal_distribution distribution; /* of the numbers that are drawn */
    double first, second;          /* the two numbers of the distribution */
} dal_variation;

/* Parses "x'=normal(0,0.1)".  Errors: DAL_STATUS_SYNTAX, DAL_STATUS_NAME (of a distribution, with
 * the nearest), DAL_STATUS_ARGUMENT (low not below high, a negative deviation),
 * DAL_STATUS_TOO_LARGE. */
dal_status dal_variation_parse(dal_variation *variation, const char *text, dal_error *error);
/* What a member, from 0, draws: a function of distribution, name, seed and member alone; see
 * lib/run/ensemble.c. */
double dal_variation_draw(const dal_variation *variation, unsigned long long seed,
                          unsigned long long member);
/* Members of an ensemble, any number of which are stepped by one batch, one chunk after the other:
 *
 *     for (first = 0; first < members; first += lanes) {
 *         dal_ensemble_start(ensemble, first, lanes);
 *         dal_batch_advance(dal_ensemble_batch(ensemble), steps);
 *         dal_ensemble_states(ensemble, states);
 *     } */
typedef struct dal_ensemble dal_ensemble;
/* Makes an ensemble of a spec, whose numbers vary by variations[count], with a batch of that number
 * of lanes.  [alloc]  Errors: as for dal_batch_create; DAL_STATUS_NAME (nothing has that name, with
 * the nearest), DAL_STATUS_ARGUMENT (a name twice, or as dal_variation_parse). */
dal_status dal_ensemble_create(dal_ensemble **ensemble, const dal_run_spec *spec,
                               const dal_variation *variations, int count, unsigned long long seed,
                               int lanes, dal_error *error);
/* Frees an ensemble and its batch. */
void dal_ensemble_free(dal_ensemble *ensemble);
/* Starts members first, .., first + count - 1 in the first lanes.  With the option consistent their
 * velocities are moved to D = 0.  A lane without a start is not stepped; dal_batch_status has the
 * reason.  Errors: DAL_STATUS_ARGUMENT (count). */
dal_status dal_ensemble_start(dal_ensemble *ensemble, unsigned long long first, int count);
/* The batch of an ensemble, to be stepped and compiled. */
dal_batch *dal_ensemble_batch(dal_ensemble *ensemble);
/* What the members in the lanes have drawn, draws[started*variations], one member after the
 * other. */
void dal_ensemble_draws(const dal_ensemble *ensemble, double *draws);
/* Their present states, states[started*dimension]; NaN of those that have failed. */
void dal_ensemble_states(const dal_ensemble *ensemble, double *states);

/* The values of one quantity in the members of an ensemble. */
typedef struct dal_spread {
    long long count;        /* how many there are */
    double mean, deviation; /* the mean; the standard deviation, of count - 1 degrees of freedom */
    double min, max;        /* the extreme values */
} dal_spread;

/* The spread of values[count], finite ones; NaN where too few are there. */
void dal_spread_measure(dal_spread *spread, const double *values, long long count);
/* Quantiles of values[count], which are reordered: quantile[i] for p[i] in 0..1, i < quantiles.
 * Between two values it is linear (Hyndman, Fan 1996, type 7, DOI 10.1080/00031305.1996.10473566).
 * NaN without values. */
void dal_measure_quantiles(double *values, long long count, const double *p, int quantiles,
                           double *quantile);

#ifdef __cplusplus
}
#endif
#endif
