/* adaptive.h - a step made of substeps whose sizes follow an estimate of their error.
 *
 *     h_next = h / clip(r / SAFE, 1/FASTEST, SLOWEST),    accepted where r <= 1
 *
 * with r = (error / tolerance)^(1/order), which the method says of each trial.  Hairer, Norsett,
 * Wanner, Solving ODEs I (1993), II.4; constants and their use as in dop853.f.  A trial that is
 * not finite counts as one of great error.  The substeps are whole multiples of the last place of
 * 4h, so that they make up h exactly; one that would be less than that is none, and the step fails.
 *
 * What is planned is persistent to the next step.  A branch on the error of one lane is allowed
 * here alone: steps under control have one lane, and only the variants of one lane have this. */
#ifndef DAL_KERNEL_ADAPTIVE_H
#define DAL_KERNEL_ADAPTIVE_H

#if DAL_LANES == 1 && !defined DAL_SPECIALISED
#define DAL_CONTROLLED(s) ((s)->tolerance > 0.0)

#define DAL__SAFE    0.9
#define DAL__FASTEST 6.0
#define DAL__SLOWEST (1.0 / 0.333)
/* What is left is one substep when it is no longer than the plan by more than this. */
#define DAL__STRETCH 1.01

enum { DAL__MOST_TRIALS = 100000 };

typedef struct dal_trial {
    double h;         /* its size */
    int again;        /* 1: it begins where the last one did */
    num *derivatives; /* [stages*dim] of the method, from trial to trial */
    num *derivative;  /* [dim] of the whole substep */
    double ratio;     /* r: by how much h is too large */
} dal_trial;

/* Tries a substep of size trial->h from s->t, s->y, which stay as they are. */
typedef dal_status dal_attempt(dal_step *s, dal_trial *trial);

DAL_INLINE double dal__substep(double whole, double left, double planned)
{
    const double coarse = 4.0 * whole;
    return left <= DAL__STRETCH * planned ? left : (planned + coarse) - coarse;
}

/* The size after a trial of the given size; NaN is slow. */
DAL_INLINE double dal__next_size(double size, double ratio)
{
    const double slower = ratio / DAL__SAFE;
    if (!(slower < DAL__SLOWEST)) return size / DAL__SLOWEST;
    return slower < 1.0 / DAL__FASTEST ? size * DAL__FASTEST : size / slower;
}

/* The plan after a trial of the given size.  A substep that was short because there was no more
 * left says nothing against a longer one, and one behind a rejected trial nothing for it. */
DAL_INLINE double dal__plan(const dal_trial *trial, double size, double planned)
{
    const double next = dal__next_size(size, trial->ratio);
    if (!(trial->ratio <= 1.0) || trial->again) return next < size ? next : size;
    return size < planned && next < planned ? planned : next;
}

/* s->h from the state as it is.  Where no size will do, s->t has the time that was reached and
 * s->substep the last plan, which is 0 when it is below all that can be distinguished. */
DAL_INLINE dal_status dal_control(dal_step *s, dal_attempt *attempt, dal_trial *trial)
{
    const double t = s->t, whole = fabs(s->h), direction = s->h < 0.0 ? -1.0 : 1.0;
    double left = whole, planned = dal_lane(*s->substep, 0);
    if (!(planned > 0.0)) planned = whole;
    trial->again = 0;
    for (int count = 0; count < DAL__MOST_TRIALS; count++) {
        const double size = dal__substep(whole, left, planned);
        if (!(size > 0.0)) {
            *s->substep = dal_num(0.0);
            break;
        }
        trial->h = direction * size;
        DAL_TRY(attempt(s, trial));
        planned = dal__plan(trial, size, planned);
        *s->substep = dal_num(planned);
        trial->again = !(trial->ratio <= 1.0);
        if (trial->again) continue;
        DAL_TRY(dal_update_multiple(s, trial->h, trial->h, trial->derivative));
        left -= size;
        s->t = t + direction * (whole - left);
        if (left == 0.0) return DAL_OK;
    }
    s->unconverged[0] = dal_all();
    return DAL_NOT_CONVERGED;
}

#endif

#endif
