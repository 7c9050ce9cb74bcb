/* layout.h - the dimensions and sizes of a run. */
#ifndef DAL_LAYOUT_H
#define DAL_LAYOUT_H

#include "core/error.h"
#include "dalembert_program.h"
#include "dalembert_run.h"
#include "kernel/persistent.h"
#include <math.h>

/* A run without its values.  derivatives, multiplier and acceleration count numbers of the method's
 * state; pivots those that the rank check compares. */
typedef struct dal__layout {
    const dal_system *system;
    dal_method method;
    dal_options options;
    double start_time;
    bool lifted;
    int n, nw, m, dim, depth, stages, derivatives, multiplier, acceleration, pivots;
    int field_operations, jacobian_operations; /* as of the system, or guessed */
    int taylor_order;                          /* of Taylor series, for the tolerance */
    double tolerance_root;                     /* tolerance^(1/taylor_order) */
    size_t workspace, persistent, scratch;     /* numbers */
    size_t matrices;     /* numbers of a start, in scratch where it has as many */
    size_t event_memory; /* numbers of the persistent state that events need, see events.h */
    size_t lift_memory;  /* numbers of the persistent state that name the lift, see saved.c */
} dal__layout;

/* Sizes for DAL__METHOD_STATE_LIST. */
#define DAL__COUNT_ONE(layout)          1
#define DAL__COUNT_TWO(layout)          2
#define DAL__COUNT_THREE(layout)        3
#define DAL__COUNT_DERIVATIVES(layout)  ((layout)->derivatives)
#define DAL__COUNT_MULTIPLIER(layout)   ((layout)->multiplier)
#define DAL__COUNT_ACCELERATION(layout) ((layout)->acceleration)
#define DAL__COUNT_PIVOTS(layout)       ((layout)->pivots > 0 ? 1 + (layout)->pivots : 0)

/* The place of an item of the clock, or of the method's state, in the persistent state. */
static inline size_t dal__at(const dal__layout *layout, int place)
{
    return 2 * (size_t)layout->dim + (size_t)place;
}

/* The place of the memory of events. */
static inline size_t dal__at_events(const dal__layout *layout)
{
    return layout->persistent - layout->event_memory - layout->lift_memory;
}
/* The place of what names the lift, the last of the persistent state: where it is another one than
 * the paper's, the effort and the gauge. */
enum { DAL__LIFT_EFFORT, DAL__LIFT_GAUGE, DAL__LIFT_SIZE };
static inline size_t dal__at_lift(const dal__layout *layout)
{
    return layout->persistent - layout->lift_memory;
}
double dal__lift_number(const dal_system *system, int i);
/* The place, before events, of what says whether a parameter was changed between steps. */
static inline size_t dal__at_changed(const dal__layout *layout)
{
    return dal__at_events(layout) - 1;
}

/* Whether steps are subject to the rank check. */
static inline bool dal__checks_rank(const dal_system *system)
{
    return system->m > 0 && system->properties & DAL_D_RANK_CHECKED && system->call.constraint;
}

/* Whether that uses the factors of F in place of matrices of all constraints.  These are some ten
 * times faster where pivots warn, as they often do in the large steps that a tolerance divides. */
#ifdef DAL_MINIMAL
#define dal__checks_rank_by_factors(layout) false
#else
bool dal__checks_rank_by_factors(const dal__layout *layout);
#endif

/* Numbers that a checkpoint holds: the persistent state and the parameters. */
static inline size_t dal__saved_count(const dal__layout *layout)
{
    return layout->persistent + (size_t)layout->system->parameters;
}

/* Whether x can be number i of the persistent state: finite, or an infinite e. */
static inline bool dal__is_possible(const dal__layout *k, size_t i, double x)
{
    return isfinite(x) || (k->lifted && i == 2 * (size_t)k->n && isinf(x));
}

/* The units of a system: of q, v and g, where one is not 1; of v and g, and of D and E, where they
 * differ among each other.  Else NULL. */
typedef enum dal__unit_list {
    DAL__UNITS_OF_STATE,
    DAL__UNITS_OF_SPEEDS,
    DAL__UNITS_OF_LEVELS
} dal__unit_list;
const double *dal__units(const dal__layout *layout, dal__unit_list list);

/* Checks a spec and computes its layout; errors as dal_run_init. */
dal_status dal__layout_init(dal__layout *layout, const dal_run_spec *spec, dal_error *error);

/* Writes the name of an observable of REACTIONS or MULTIPLIERS. */
void dal__reaction_name(const dal_system *system, dal__observable_kind kind, int i, char *buffer,
                        size_t size);

/* Observables in a kind. */
int dal__observable_count(const dal__layout *layout, dal__observable_kind kind, bool exact_known);

/* The most observables that a run can have. */
int dal__max_observables(const dal__layout *layout);

/* Numbers in the output of a callback, a dal_callback_code. */
int dal__eval_size(const dal__layout *layout, int code);

#endif
