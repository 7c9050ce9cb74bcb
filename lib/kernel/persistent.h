/* persistent.h - what is persistent from step to step: one list, for the engine and for generated
 * files.
 *
 *     persistent:  y[dim] | r[dim] | the clock | what the method remembers
 *
 * All that survives a step is this array; all else is scratch.  The derivatives are those of a
 * method that asks for them (DAL_EXTRAPOLATES_STAGES), [1 + DAL__DIFFERENCES][stages*(nw + n)]: see
 * collocation.h. */
#ifndef DAL_KERNEL_PERSISTENT_H
#define DAL_KERNEL_PERSISTENT_H

/* One number each: the time, compensated, and what is counted. */
#define DAL__CLOCK_LIST(X) X(TIME) X(TIME_ERROR) X(STEPS) X(EVALUATIONS)

/* Members of dal_step, and how many numbers each is: whoever uses the list says, by a macro
 * DAL__COUNT_ONE etc.  The derivatives come last, since most methods keep none. */
#define DAL__METHOD_STATE_LIST(X)                                                                  \
    X(uses_newton, ONE)    /* 1 where the fixed point was too slow and Newton took over */         \
    X(derivatives_h, ONE)  /* the step size behind the derivatives, 0: none */                     \
    X(has_multiplier, ONE) /* 1 where multiplier has been set */                                   \
    X(multiplier,                                                                                  \
      MULTIPLIER)   /* [m] the multipliers of the last step, of methods that carry them */         \
    X(substep, ONE) /* the size planned for the next substep, 0: there is no plan */               \
    X(level, TWO)   /* the energy of the start, and 1 when it is known */                          \
    X(derivatives,                                                                                 \
      DERIVATIVES) /* stage derivatives of the last collocation step, and differences */

/* Differences kept beside the derivatives. */
enum { DAL__DIFFERENCES = 4 };

/* Places behind y and r. */
enum {
#define X(name) DAL__##name,
    DAL__CLOCK_LIST(X)
#undef X
        DAL__METHOD_STATE
};

#endif
