/* adaptive.h - a step divided into substeps under error control.
 *
 *     h_next = h / clip(r / SAFE, 1/FASTEST, SLOWEST),    accepted where r <= 1
 *
 * with r = (error / tolerance)^(1/order) from the method.  Hairer, Norsett, Wanner, Solving ODEs I
 * (1993), II.4; constants as in dop853.f.  A trial that is not finite counts as one with a large
 * error.  Substeps are whole multiples of the last place of 4h, so that they add up to h exactly;
 * where the next one would be 0 the step fails.
 *
 * The size planned last persists to the next step.  Here alone the code branches on the error of a
 * lane: steps under control have one lane, and only variants of one lane compile this. */
#ifndef DAL_KERNEL_ADAPTIVE_H
#define DAL_KERNEL_ADAPTIVE_H

#include "step.h"

#if DAL_LANES == 1 && !defined DAL_SPECIALISED
#define DAL_CONTROLLED(s) ((s)->tolerance > 0.0)

#define DAL__SAFE    0.9
#define DAL__FASTEST 6.0
#define DAL__SLOWEST (1.0 / 0.333)
/* The rest of the step is one substep if it is at most this times the planned size. */
#define DAL__STRETCH 1.01

enum { DAL__MAX_TRIALS = 100000 };

/* A substep that is tried. */
typedef struct dal_trial {
    double h;         /* its size */
    int again;        /* 1: it begins where the last one did */
    num *derivatives; /* [stages*dim] of the method, from trial to trial */
    num *derivative;  /* [dim] of the whole substep */
    double ratio;     /* r: by how much h is too large */
} dal_trial;

/* Tries a substep of size trial->h from s->t, s->y, which stay as they are. */
typedef void dal_attempt(dal_step *s, dal_trial *trial);

DAL_INLINE double dal__substep(double whole, double left, double planned)
{
    const double coarse = 4.0 * whole;
    return left <= DAL__STRETCH * planned ? left : (planned + coarse) - coarse;
}

/* The size after a trial; a ratio of NaN counts as large. */
DAL_INLINE double dal__next_size(double size, double ratio)
{
    const double slower = ratio / DAL__SAFE;
    if (!(slower < DAL__SLOWEST)) return size / DAL__SLOWEST;
    return slower < 1.0 / DAL__FASTEST ? size * DAL__FASTEST : size / slower;
}

/* The size planned after a trial.  The last substep of a step does not shorten the plan, one after
 * a rejected trial does not lengthen it. */
DAL_INLINE double dal__plan(const dal_trial *trial, double size, double planned)
{
    const double next = dal__next_size(size, trial->ratio);
    if (!(trial->ratio <= 1.0) || trial->again) return next < size ? next : size;
    return size < planned && next < planned ? planned : next;
}

/* Steps by s->h.  On failure s->t is the time reached, s->substep the size planned last, 0 if below
 * the last place. */
DAL_INLINE dal_status dal_control(dal_step *s, dal_attempt *attempt, dal_trial *trial)
{
    const double t = s->t, whole = fabs(s->h), direction = s->h < 0.0 ? -1.0 : 1.0;
    double left = whole, planned = dal_lane(*s->substep, 0);
    if (!(planned > 0.0)) planned = whole;
    trial->again = 0;
    for (int count = 0; count < DAL__MAX_TRIALS; count++) {
        const double size = dal__substep(whole, left, planned);
        if (!(size > 0.0)) {
            *s->substep = dal_num(0.0);
            break;
        }
        trial->h = direction * size;
        DAL__MARK(s);
        attempt(s, trial);
        DAL__RELEASE(s);
        planned = dal__plan(trial, size, planned);
        *s->substep = dal_num(planned);
        trial->again = !(trial->ratio <= 1.0);
        if (trial->again) continue;
        dal_update_multiple(s, trial->h, trial->h, trial->derivative);
        left -= size;
        s->t = t + direction * (whole - left);
        if (left == 0.0) return DAL_OK;
    }
    s->unconverged[0] = dal_all();
    return DAL_NOT_CONVERGED;
}

#endif

#endif
