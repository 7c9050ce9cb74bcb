/* persistent.h - the persistent state of a step: all that passes from one step to the next.
 *
 *     y[dim] | r[dim] | clock | state of the method | changed | events | lift
 *
 * All else is scratch.  Stage derivatives, [1 + differences][stages*(nw + n)], are stored for
 * methods with DAL_EXTRAPOLATES_STAGES (collocation.h).  changed is 1 where a parameter was changed
 * between steps: the state of the method was 0 then, as before a first step.  What events need,
 * lib/run/events.h, no step changes; lift, of another effort or gauge than the paper's, says which
 * these are. */
#ifndef DAL_KERNEL_PERSISTENT_H
#define DAL_KERNEL_PERSISTENT_H

/* One number each: the time, compensated, and two counters. */
#define DAL__CLOCK_LIST(CLOCK) CLOCK(TIME) CLOCK(TIME_ERROR) CLOCK(STEPS) CLOCK(EVALUATIONS)

/* Members of dal_step and their sizes.  A user of the list defines DAL__COUNT_ONE and so on.
 *   uses_newton     1 where Newton's method was found to cost less than the fixed point
 *   derivatives_h   the step size of the derivatives, 0: none
 *   has_multiplier  1 where multiplier is set
 *   multiplier      [m] the multipliers of the last step, with DAL_PERSISTENT_MULTIPLIER
 *   acceleration    with DAL_PERSISTENT_ACCELERATION: 1 where it is set, then [n] a + B times the
 *                   multipliers at the end of the last step, and [2n] q and v there
 *   substep         the size planned for the next substep, 0: none
 *   level           the energy of the start, and 1 when it is known
 *   last_pivots     0 where the pivots of the last step are steady, and these; see acceptance.h
 *   derivatives     stage derivatives of the last step, and differences of predictor errors
 *   choice          of the solver auto, see choice.h */
#define DAL__METHOD_STATE_LIST(MEMBER)                                                             \
    MEMBER(uses_newton, ONE)                                                                       \
    MEMBER(derivatives_h, ONE)                                                                     \
    MEMBER(has_multiplier, ONE)                                                                    \
    MEMBER(multiplier, MULTIPLIER)                                                                 \
    MEMBER(acceleration, ACCELERATION)                                                             \
    MEMBER(substep, ONE)                                                                           \
    MEMBER(level, TWO)                                                                             \
    MEMBER(last_pivots, PIVOTS) MEMBER(derivatives, DERIVATIVES) MEMBER(choice, THREE)

/* Places after y and r. */
enum {
#define CLOCK(name) DAL__##name,
    DAL__CLOCK_LIST(CLOCK)
#undef CLOCK
        DAL__CLOCK_SIZE
};

#endif
