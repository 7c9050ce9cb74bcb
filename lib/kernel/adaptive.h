/* adaptive.h - a step divided into substeps under error control.
 *
 *     h_next = h / clip(r / SAFE, 1/FASTEST, SLOWEST),    accepted where r <= 1
 *
 * with r = (error / tolerance)^(1/order) from the method.  Hairer, Norsett, Wanner, Solving ODEs I
 * (1993), II.4; constants as in dop853.f.  A trial that is not finite counts as one with a large
 * error.  Substeps are whole multiples of the last place of 4h, so that they add up to h exactly;
 * where the next one would be 0 the step fails.
 *
 * Each lane has a time and a size of its own, and the substeps of a run by itself; all reach the
 * end of the step, where those that are there already wait unchanged.  A method divides its step by
 *
 *     dal_control c = dal_control_begin(s);
 *     while (dal_control_next(s, &c)) {
 *         a trial of size c.h from c.t and s->y, which stay; r in each lane
 *         dal_control_end(s, &c, r, derivative);
 *     }
 *     return dal_control_status(s, &c);
 *
 * One that knows its size beforehand stores it in c.planned, before dal_control_next, and gives an
 * r of 1.  The size planned last persists to the next step.
 *
 * Dense output: where dal_step.dense is set, by the engine of a single run, a method stores in it,
 * before dal_control_end, the polynomial of the motion within the trial.  The control then ends the
 * step after one substep, and the next call continues it.  Generated files have no dense output. */
#ifndef DAL_KERNEL_ADAPTIVE_H
#define DAL_KERNEL_ADAPTIVE_H

#include "step.h"

/* dal_field at a time of each lane. */
DAL_INLINE void dal_field_at(dal_step *s, dal_times t, const num *y, num *DAL_RESTRICT dy)
{
#if DAL_HAS_TIMES
    s->times = t;
    s->has_times = true;
    dal_field(s, s->t, y, dy);
    s->has_times = false;
#else
    dal_field(s, dal_lane(t, 0), y, dy);
#endif
}

#if DAL_WITH(CONTROL)
#define DAL__SAFE    0.9
#define DAL__FASTEST 6.0
#define DAL__SLOWEST (1.0 / 0.333)
/* The rest of the step is one substep if it is at most this times the planned size. */
#define DAL__STRETCH 1.01

enum { DAL__MAX_TRIALS = 100000 };

/* The division of a step. */
typedef struct dal_control {
    dal_times t, h;    /* where the trial begins, and its size; h = 0 in lanes at the end */
    dal_times planned; /* size of the next trial */
    dal_mask again;    /* lanes whose trial begins where the last one did */
    dal_mask active;   /* lanes that have not reached the end */
    dal_mask alive;    /* lanes that began */
    dal_times rest;    /* of the step */
    dal_times last[2]; /* of the method, from substep to substep of a step; 0 at first */
    double start;      /* t of the step */
    double whole;      /* its size, positive */
    double direction;  /* 1, or -1 backwards in t */
    int trials;        /* so far, failed ones included */
} dal_control;

#ifndef DAL_SPECIALISED
enum { DAL_DENSE_TERMS = 40 };

/* The motion within a substep of size h from t:
 *
 *     y(t + u h) = y + u h (a_1 + u (a_2 + ... + u a_terms)),     0 <= u <= 1 */
typedef struct dal_dense {
    num *y, *r;          /* [dim] at t */
    num *rate;           /* [terms*dim] a_1, a_2, ... */
    int terms;           /* at most DAL_DENSE_TERMS; 0: the method leaves none */
    double from, size;   /* |t - start of the step| and |h|; 0 before the first substep */
    dal_control control; /* of the step, after this substep */
} dal_dense;

/* The mean rate of change from t to t + u h, rate[dim]. */
DAL_INLINE void dal_dense_rate(const dal_dense *d, int dim, num u, num *DAL_RESTRICT rate)
{
    DAL_EACH(i, dim) rate[i] = dal_num(0.0);
    for (int k = d->terms - 1; k >= 0; k--)
        DAL_EACH(i, dim) rate[i] = dal_fma(u, rate[i], d->rate[k * dim + i]);
}
#endif

/* Begins to divide a step. */
DAL_INLINE dal_control dal_control_begin(const dal_step *s)
{
#ifndef DAL_SPECIALISED
    if (s->dense && s->dense->size > 0.0) return s->dense->control;
#endif
    dal_control c;
    c.start = s->t;
    c.whole = fabs(s->h);
    c.direction = s->h < 0.0 ? -1.0 : 1.0;
    const num before = *s->substep, whole = dal_num(c.whole);
    c.planned = (dal_times)dal_select(dal_less(dal_num(0.0), before), before, whole);
    c.rest = (dal_times)whole;
    c.t = c.h = c.rest;
    c.last[0] = c.last[1] = c.rest - c.rest;
    c.trials = 0;
    c.again = ~dal_all();
    c.active = c.alive = s->alive;
    return c;
}

/* Ends some lanes, which fail at the time that they have reached. */
DAL_INLINE void dal__control_fail(dal_step *s, dal_control *c, dal_mask lanes)
{
    s->unconverged |= lanes;
    c->active &= ~lanes;
}

/* Sets time and size of the next trial; false: no lane needs one. */
DAL_INLINE bool dal_control_next(dal_step *s, dal_control *c)
{
    const double coarse = 4.0 * c->whole;
    const num rest = c->rest, planned = c->planned, rounded = (c->planned + coarse) - coarse;
    const num size = dal_select(dal_less_equal(rest, DAL__STRETCH * planned), rest, rounded);
    const dal_mask stuck = c->active & ~dal_less(dal_num(0.0), size);
    if (DAL_RARELY(dal_any(stuck))) {
        *s->substep = dal_select(stuck, dal_num(0.0), *s->substep);
        dal__control_fail(s, c, stuck);
    }
    if (c->trials++ == DAL__MAX_TRIALS) dal__control_fail(s, c, c->active);
    c->h = c->direction * (dal_times)dal_select(c->active, size, dal_num(0.0));
    c->t = c->start + c->direction * (c->whole - c->rest);
    return dal_any(c->active);
}

/* The size after a trial; a ratio of NaN counts as large. */
DAL_INLINE num dal__next_size(num size, num ratio)
{
    const num slower = ratio / DAL__SAFE;
    const dal_mask much = ~dal_less(slower, dal_num(DAL__SLOWEST));
    const dal_mask little = dal_less(slower, dal_num(1.0 / DAL__FASTEST));
    const num next = dal_select(little, size * DAL__FASTEST, size / slower);
    return dal_select(much, size / DAL__SLOWEST, next);
}

/* Accepts the trial where ratio <= 1: y + r += h*derivative, derivative[dim].  The last substep of
 * a step does not shorten the plan, one after a rejected trial does not lengthen it. */
DAL_INLINE void dal_control_end(dal_step *s, dal_control *c, dal_times ratio, const num *derivative)
{
    const num size = c->direction * c->h, planned = c->planned;
    const num next = dal__next_size(size, ratio), shorter = dal_min(size, next);
    const dal_mask good = dal_less_equal(ratio, dal_num(1.0)), accepted = c->active & good;
    const dal_mask keeps = dal_less(size, planned) & dal_less(next, planned);
    const num plan = dal_select(good & ~c->again, dal_select(keeps, planned, next), shorter);
    c->planned = (dal_times)dal_select(c->active, plan, planned);
    *s->substep = dal_select(c->active, plan, *s->substep);
    c->again = c->active & ~good;
    s->alive = accepted;
    dal_update_lanes(s, c->h, derivative);
    s->alive = c->alive;
#ifndef DAL_SPECIALISED
    const double from = c->whole - dal_lane(c->rest, 0);
#endif
    c->rest = (dal_times)dal_select(accepted, c->rest - size, c->rest);
    c->active &= dal_less(dal_num(0.0), c->rest);
#ifndef DAL_SPECIALISED
    if (DAL_RARELY(s->dense != NULL) && dal_any(accepted)) {
        s->dense->from = from;
        s->dense->size = dal_lane(size, 0);
        s->dense->control = *c;
        c->active = ~dal_all(); /* of this call */
    }
#endif
}

/* Ends the step.  On failure of all lanes s->t is the time that the first has reached, s->substep
 * the size planned last, 0 if below the last place. */
DAL_INLINE dal_status dal_control_status(dal_step *s, const dal_control *c)
{
    const dal_mask failed = c->alive & s->unconverged;
    const double rest = dal_lane(c->rest, 0);
    if (dal_any(c->alive & ~failed) || !dal_any(failed)) {
        s->t = c->start + c->direction * c->whole;
        return DAL_STATUS_OK;
    }
    s->t = c->start + c->direction * (c->whole - rest);
    return DAL_STATUS_NOT_CONVERGED;
}
#endif

#endif
