/* shooting.c - moves all pieces of a motion by the lanes of a batch, and the columns of their
 * derivatives by the lanes of a batch of the tangent system. */
#include "steer/shooting.h"
#include "core/error.h"
#include "core/vectors.h"
#include "dynamics/tangent_map.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the implicit equations of tangent lanes: Newton's method needs few digits, ranks along the
 * motion (reach.c) need nine. */
static const double coarse_tolerance = 1e-6, tangent_tolerance = 1e-12;

enum { STEPS_PER_CALL = 64 };

dal_status dal__shooting_open(dal__shooting *s, dal__problem *p, long long steps, int pieces)
{
    const size_t count = (size_t)(steps < pieces ? steps : pieces);
    const size_t unknowns = (size_t)p->unknowns, dimension = (size_t)p->dimension;
    *s = (dal__shooting){.problem = p, .steps = steps, .pieces = (int)count};
    s->h = (p->T - p->from) / (double)steps;
    if (steps == p->steps) s->h = p->h;
    s->first = calloc(count + 1, sizeof *s->first);
    s->point = dal__numbers(2 * count + 1, dimension);
    s->derivative = dal__numbers(count, unknowns * unknowns);
    s->cost = dal__numbers(count, unknowns);
    s->scratch = dal__numbers(4, 2 * dimension);
    if (!s->first || !s->point || !s->derivative || !s->cost || !s->scratch)
        return DAL_STATUS_MEMORY;
    s->end = s->point + (count + 1) * dimension;
    for (size_t k = 0; k <= count; k++)
        s->first[k] = steps / (long long)count * (long long)k +
                      steps % (long long)count * (long long)k / (long long)count;
    dal_run_spec spec = p->spec;
    spec.options.step = s->h;
    DAL_TRY(dal_batch_create(&s->plain, &spec, s->pieces, 0, p->error));
    spec.start_count = 0;
    spec.options.solver_tolerance = fmax(spec.options.solver_tolerance,
                                         steps < p->steps ? coarse_tolerance : tangent_tolerance);
    DAL_TRY(dal_model_tangent(p->model, &spec.system, p->error));
    return dal_batch_create(&s->tangent, &spec, p->unknowns, 0, p->error);
}

void dal__shooting_close(dal__shooting *s)
{
    dal_batch_free(s->plain);
    dal_batch_free(s->tangent);
    free(s->first);
    free(s->point);
    free(s->derivative);
    free(s->cost);
    free(s->scratch);
}

double dal__shooting_time(const dal__shooting *s, int k)
{
    return s->problem->from + (double)s->first[k] * s->h;
}

/* Takes the ends of the pieces with a number of steps from their lanes. */
static dal_status read_ends(dal__shooting *s, long long steps, double *end)
{
    const size_t dimension = (size_t)s->problem->dimension;
    for (int k = 0; k < s->pieces; k++) {
        if (s->first[k + 1] - s->first[k] != steps) continue;
        DAL_TRY(dal_batch_status(s->plain, k, s->problem->error));
        dal_batch_state(s->plain, k, end + (size_t)k * dimension);
    }
    return DAL_STATUS_OK;
}

/* Takes steps, between which the observer is called.  Errors: what it returned. */
static dal_status advance_observed(dal__problem *p, dal_batch *batch, long long steps)
{
    for (long long rest = steps; rest > 0; rest -= STEPS_PER_CALL) {
        if (rest < steps) DAL_TRY(dal__problem_poll(p));
        dal_batch_advance(batch, rest < STEPS_PER_CALL ? rest : STEPS_PER_CALL);
    }
    return DAL_STATUS_OK;
}

dal_status dal__shooting_move(dal__shooting *s, const double *point, double *end)
{
    dal__problem *p = s->problem;
    const size_t dimension = (size_t)p->dimension;
    const long long steps = s->steps / s->pieces;
    for (int k = 0; k < s->pieces; k++) {
        memcpy(s->scratch, point + (size_t)k * dimension, dimension * sizeof(double));
        if (p->is_lifted) s->scratch[dimension - 1] = 0.0;
        DAL_TRY(dal_batch_set_state(s->plain, k, dal__shooting_time(s, k), s->scratch, p->error));
    }
    DAL_TRY(advance_observed(p, s->plain, steps));
    DAL_TRY(read_ends(s, steps, end));
    if (s->steps % s->pieces == 0) return DAL_STATUS_OK;
    dal_batch_advance(s->plain, 1);
    return read_ends(s, steps + 1, end);
}

/* Whether a column is left out. */
static bool is_skipped(const dal__problem *p, int unknown, dal__columns columns)
{
    return columns == DAL__COLUMNS_WITHOUT_P && unknown >= 2 * p->n && unknown < 3 * p->n;
}

dal_status dal__shooting_differentiate(dal__shooting *s, dal__columns columns)
{
    dal__problem *p = s->problem;
    const int n = p->n, d = p->unknowns;
    double *vector = s->scratch, *state = s->scratch + 2 * p->dimension;
    for (int k = 0; k < s->pieces; k++) {
        const double t = dal__shooting_time(s, k), *point = s->point + k * p->dimension;
        double *out = s->derivative + (size_t)k * (size_t)(d * d);
        dal_batch_clear(s->tangent);
        for (int j = 0; j < d; j++) {
            if (is_skipped(p, j, columns)) continue;
            memset(vector, 0, (size_t)p->dimension * sizeof *vector);
            vector[dal__place_of(p, j)] = p->unit[j];
            dal__tangent_scatter(p->system, p->spec.options.space, point, vector, state);
            DAL_TRY(dal_batch_set_state(s->tangent, j, t, state, p->error));
        }
        DAL_TRY(advance_observed(p, s->tangent, s->first[k + 1] - s->first[k]));
        for (int j = 0; j < d; j++) {
            if (is_skipped(p, j, columns)) continue;
            DAL_TRY(dal_batch_status(s->tangent, j, p->error));
            dal_batch_state(s->tangent, j, state);
            dal__tangent_gather(p->system, p->spec.options.space, state, vector);
            for (int i = 0; i < d; i++) out[i * d + j] = vector[dal__place_of(p, i)] / p->unit[i];
            if (p->is_lifted) s->cost[k * d + j] = vector[4 * n + 1];
        }
    }
    return DAL_STATUS_OK;
}

void dal__shooting_jumps(const dal__shooting *s, const double *point, const double *end, int count,
                         double *out)
{
    const dal__problem *p = s->problem;
    for (int k = 0; k < s->pieces; k++)
        for (int i = 0; i < count; i++) {
            const int place = dal__place_of(p, i);
            out[k * p->unknowns + i] =
                (end[k * p->dimension + place] - point[(k + 1) * p->dimension + place]) /
                p->unit[i];
        }
}
