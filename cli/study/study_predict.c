/* study_predict.c - what single steps predict of the runs of a study, beside what was measured.
 *
 * A prediction is kept as the results of a cell are: a trend for each observable, of which the
 * numbers that are predicted are given, in a file of results of its own. */
#include "study_predict.h"

#include "dalembert_predict.h"
#include "study_results.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* ---- a prediction of a cell ---- */

static dal_status poll_stop(void *user, double done)
{
    const work_stop *stop = user;
    (void)done;
    return stop->stop(stop->user) ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

/* Whether what was predicted is above rounding is its size; a rate of 0 with an interval of 0 is
 * one by reversibility. */
static void take_trends(study_cell *to, const dal_prediction *of)
{
    static const double roundings = 64.0;
    for (int i = 0; i < to->observables; i++) {
        const dal_predicted *p = of->predicted, *end = p + of->observables;
        while (p < end && strcmp(p->name, to->names[i]) != 0) p++;
        if (p == end || !p->is_conserved) continue;
        const double rate = p->is_zero ? 0.0 : p->rate, margin = p->is_zero ? 0.0 : p->margin;
        const bool is_larger = p->max_change > roundings * p->rounding;
        to->trend[i] = (dal_trend){.count = of->steps,
                                   .last = p->change,
                                   .max_abs = p->max_change,
                                   .deviation = p->max_change,
                                   .rate = rate,
                                   .rate_low = rate - margin,
                                   .rate_high = rate + margin,
                                   .size = is_larger ? DAL_SIZE_LARGER : DAL_SIZE_ROUNDING};
    }
}

/* The result of a prediction to the time `end`, or of one that is refused. */
static void take_prediction(study_cell *to, const dal_prediction *of, const dal_error *error,
                            double end)
{
    to->state = of ? STUDY_FINISHED : STUDY_FAILED;
    to->time = of ? of->end : NAN;
    if (!of) {
        to->error = *error;
    } else if (of->end != end) {
        snprintf(to->error.message, sizeof to->error.message, "%s%s%.160s",
                 dal_prediction_end_text(of->reason), of->message[0] ? ": " : "", of->message);
    }
    if (of) take_trends(to, of);
}

/* ---- the exact motion of a case ---- */

/* Numbers that the motions of all cases may keep. */
static const size_t motion_bytes = (size_t)1 << 28;

struct study_motion {
    pthread_mutex_t mutex;
    bool is_made;
    dal_exact_motion *motion; /* NULL: each prediction has its own */
};

struct study_motion *study_motions_create(int cases)
{
    struct study_motion *all = cli_calloc((size_t)cases + 1, sizeof *all);
    for (int i = 0; i < cases; i++) pthread_mutex_init(&all[i].mutex, NULL);
    return all;
}

void study_motions_free(struct study_motion *all, int cases)
{
    for (int i = 0; all && i < cases; i++) {
        pthread_mutex_destroy(&all[i].mutex);
        dal_exact_motion_free(all[i].motion);
    }
    free(all);
}

/* The exact motion of the case of a cell, to the end of its run: the first cell makes it, and the
 * others read it. */
static dal_exact_motion *find_motion(const study_plan *plan, const study_cell *cell,
                                     const dal_run_spec *spec, double end,
                                     const dal_predict_observer *observer)
{
    const study_case *e = cell->of_case;
    struct study_motion *m = &plan->motions[e - plan->cases];
    if (cell->start == STUDY_DISPLACED || e->cells < 2) return NULL;
    pthread_mutex_lock(&m->mutex);
    if (!m->is_made) {
        const size_t bytes = motion_bytes / (size_t)plan->case_count;
        dal_exact_motion_create(&m->motion, spec, bytes, NULL);
        if (m->motion && dal_exact_motion_extend(m->motion, end, observer, NULL) != DAL_STATUS_OK) {
            dal_exact_motion_free(m->motion);
            m->motion = NULL;
        }
        m->is_made = true;
    }
    pthread_mutex_unlock(&m->mutex);
    return m->motion;
}

int study_predict_cell(const study_plan *plan, study_cell *cell, const dal_run_spec *spec,
                       double end, const work_stop *stop)
{
    dal_predict_settings settings = {.rows = 1}; /* what rounding hides, it hides in runs, too */
    const dal_predict_observer observer = {(void *)stop, poll_stop};
    study_results *results = plan->results[STUDY_STORED_PREDICTIONS];
    const int number = (int)(cell - plan->cells);
    study_cell *to = cell->predicted = cli_calloc(1, sizeof *to);
    dal_prediction *of = NULL;
    dal_error error = {0};
    *to = (study_cell){.of_case = cell->of_case,
                       .observables = cell->observables,
                       .names = cell->names,
                       .trend = cli_calloc((size_t)cell->observables + 1, sizeof *to->trend)};
    if (study_results_get(results, number, to)) return CLI_DONE;
    settings.motion = find_motion(plan, cell, spec, end, &observer);
    const dal_status status = dal_predict_create(&of, spec, end, &settings, &observer, &error);
    if (status == DAL_STATUS_MEMORY) cli_out_of_memory();
    if (of && of->reason == DAL_PREDICTION_INTERRUPTED) {
        dal_prediction_free(of);
        return CLI_SIGNAL;
    }
    take_prediction(to, of, &error, end);
    dal_prediction_free(of);
    return study_results_add(results, number, to, plan->interval);
}

/* ---- beside what was measured ---- */

study_quantities study_predicted_quantities(const study_cell *cell)
{
    const study_cell *p = cell->predicted;
    if (!p) return (study_quantities){0};
    const study_quantities measured = study_cell_quantities(cell);
    return (study_quantities){.D = study_cell_constraint(p),
                              .E = study_cell_trend(p, "E"),
                              .invariant = study_cell_trend(p, measured.invariant_name),
                              .invariant_name = measured.invariant_name};
}

typedef struct prediction_count {
    int sizes, within_1, within_10; /* of the runs' quantities, and in percents */
    int refused, shorter;           /* runs that are not predicted, and not to their end */
} prediction_count;

/* Both are sizes above rounding.  Off D = 0 the run states no size of E. */
static void compare_sizes(prediction_count *count, const dal_trend *predicted,
                          const dal_trend *measured)
{
    if (!predicted || !measured || predicted->count == 0 || measured->count == 0) return;
    const bool is_stated = measured->conservation == DAL_CONSERVED;
    if (predicted->size != DAL_SIZE_LARGER || (is_stated && measured->size != DAL_SIZE_LARGER))
        return;
    const double difference = fabs(predicted->deviation / measured->deviation - 1.0);
    count->sizes++;
    count->within_1 += difference <= 0.01;
    count->within_10 += difference <= 0.1;
}

static void count_cell(prediction_count *count, const study_cell *c)
{
    const study_cell *p = c->predicted;
    const study_quantities measured = study_cell_quantities(c);
    const study_quantities predicted = study_predicted_quantities(c);
    const bool is_refused = p->state != STUDY_FINISHED, is_short = p->error.message[0] != '\0';
    count->refused += is_refused;
    count->shorter += !is_refused && is_short;
    if (is_refused || is_short || c->state != STUDY_FINISHED) return;
    compare_sizes(count, predicted.D, measured.D);
    compare_sizes(count, predicted.E, measured.E);
    compare_sizes(count, predicted.invariant, measured.invariant);
}

char *study_describe_predictions(const study_plan *plan)
{
    prediction_count n = {0};
    if (!plan->has_predictions) return NULL;
    for (const study_cell *c = plan->cells; c < plan->cells + plan->cell_count; c++)
        if (c->predicted && c->start != STUDY_DISPLACED && !study_cell_physical(plan, c))
            count_cell(&n, c);
    return cli_format("Predicted sizes of D, E and invariants: %d of %d within 1 %% of the runs', "
                      "%d within 10 %%; runs predicted in part: %d, not at all: %d.",
                      n.within_1, n.sizes, n.within_10, n.shorter, n.refused);
}
