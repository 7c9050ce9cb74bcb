/* crossing.h - where functions of the state pass through 0 within the next step of a run. */
#ifndef DAL_RUN_CROSSING_H
#define DAL_RUN_CROSSING_H

#include "run/run.h"

/* On which side of 0 a function is; JUST: it was 0, or only rounding, when it left to that side. */
typedef enum dal__side {
    DAL__JUST_BELOW = -2,
    DAL__BELOW = -1,
    DAL__SIDE_UNKNOWN = 0,
    DAL__ABOVE = 1,
    DAL__JUST_ABOVE = 2
} dal__side;

static inline int dal__sign_of(double x) { return (x > 0.0) - (x < 0.0); }
static inline int dal__side_sign(dal__side side) { return (side > 0) - (side < 0); }
static inline bool dal__is_just(dal__side side)
{
    return side == DAL__JUST_BELOW || side == DAL__JUST_ABOVE;
}
/* The side of a sign that is just left to; DAL__SIDE_UNKNOWN for 0. */
static inline dal__side dal__just(int sign) { return (dal__side)(2 * sign); }

/* Functions of the state, evaluated at the present one of a run. */
typedef struct dal__functions {
    int count;
    void *user;
    dal_status (*values)(void *user, dal_run *run, double *out, dal_error *error);
    dal_status (*rates)(void *user, dal_run *run, double *out, dal_error *error);
    /* What is only rounding of each value and of each rate; [count] both. */
    dal_status (*roundings)(void *user, dal_run *run, double *value, double *rate,
                            dal_error *error);
    /* Which zeros of function k count: 1 upwards along the run, -1 downwards, 0 both. */
    int (*direction)(void *user, const dal_run *run, int k);
} dal__functions;

enum {
    DAL__HALVINGS = 10,                    /* of an interval of a step, at most: 1024 intervals */
    DAL__INTERVAL_ENDS = DAL__HALVINGS + 8 /* that wait to be searched */
};

/* An end of an interval: the size of the step to it, and the functions there. */
typedef struct dal__interval_end {
    double s;
    int halvings;             /* that the interval before it may still have */
    double *f, *rate, *slack; /* [count]; slack: what may be only rounding where f was just left */
} dal__interval_end;

/* A function in the interval that was searched last. */
typedef struct dal__zero {
    dal__side side; /* at the begin of the interval */
    double s;       /* |size| of the step to the zero that counts; infinite: none */
    double size;    /* max |f| at the ends so far */
} dal__zero;

/* The search of a step. */
typedef struct dal__zero_search {
    dal_run *run;
    dal_error *error;
    dal__functions functions;
    dal__zero *zero;                           /* [count] */
    double h;                                  /* the step */
    dal__interval_end begin;                   /* of the interval */
    dal__interval_end end[DAL__INTERVAL_ENDS]; /* those ahead, the nearest last */
    int ends;                                  /* how many there are */
    long long interval, intervals;             /* into which the step was divided at first */
    double *before, *after;                    /* what the run saves at the ends of the step */
    double *there;                             /* [count] the functions at an intermediate step */
    double *value_rounding, *rate_rounding;    /* [count] at the begin of the step */
    bool has_roundings;
    bool is_begun;    /* begin is already evaluated */
    bool is_searched; /* the interval has been searched, but not been left */
    bool is_kept;     /* `distance` is the result of the search of `length` from `before` */
    double length, distance;
    int k;                   /* the function whose root is sought, */
    bool by_rate;            /* or the root of its rate */
    long long touches;       /* extrema that are 0 up to rounding */
    long long unresolved;    /* steps in which |f'| times an interval is more than pi max |f| */
    double first_unresolved; /* begin of the first of them; NaN: there is none */
    bool is_unresolved;      /* whether the present step is one */
} dal__zero_search;

/* Numbers of memory for a search of `count` functions. */
size_t dal__crossing_numbers(size_t count, size_t stored);
/* Makes a search with every side unknown; the memory must outlive it. */
void dal__crossing_init(dal__zero_search *c, dal_run *run, const dal__functions *functions,
                        double *memory);

/* Begins to search a step of size h from the present state, which stays.  Sides that are known are
 * in zero[].  Errors: as for a step, and of the functions. */
dal_status dal__crossing_begin(dal__zero_search *c, double h, dal_error *error);
/* The distance of the next zero that counts, the first of all functions; infinite: none in the rest
 * of the step.  zero[].s has the zeros of the same interval. */
dal_status dal__crossing_next(dal__zero_search *c, double *distance);
/* Keeps a distance as the result of the search of a step of a length until the run changes; whether
 * a search is kept, and whether one of that length. */
void dal__crossing_keep(dal__zero_search *c, double length, double distance);
bool dal__crossing_is_kept(const dal__zero_search *c);
bool dal__crossing_has_kept(const dal__zero_search *c, double length, double *distance);
/* Takes the step, which has been searched to its end. */
void dal__crossing_take(dal__zero_search *c);

/* The side at a value f of function k that has not passed a zero that counts, slack being rounding
 * there. */
dal__side dal__side_at(const dal__zero_search *c, int k, double f, double slack);
/* What |f| of function k is at most where a zero was found, unless it jumps. */
dal_status dal__zero_accuracy(dal__zero_search *c, int k, double *accuracy, dal_error *error);
/* The least time that the clock resolves. */
double dal__crossing_resolution(const dal__zero_search *c);

#endif
