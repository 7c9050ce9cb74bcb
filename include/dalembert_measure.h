/* dalembert_measure.h - measures; a part of dalembert.h, never included by itself.
 *
 * A measure looks at a system or at a run from outside, through the same calls a user has, and
 * never trusts what they say about themselves: derivatives are compared with differences, claims
 * with numbers.  Differences are central, of order 8, so that their noise is near 1e-12.
 *
 * Symplecticity on the lifted space says nothing about D or the energy of the motion itself: on
 * p = pi = 0 every one-step method whose step on (q,v) is locally invertible, explicit Euler
 * included, is the restriction of a symplectic map. */
#ifndef DALEMBERT_MEASURE_H
#define DALEMBERT_MEASURE_H

/* ---- what becomes of a quantity along a run ------------------------------------------------ */

enum { DAL_STATISTICS_BLOCKS = 64, DAL_PARTIAL_SUMS = 8 };

/* Another number whenever the members of dal_statistics or their meaning change: who keeps them in
 * a file knows by it what they are.  Each member is of 64 bits and none points anywhere. */
enum { DAL_STATISTICS_LAYOUT = 3 };

/* A block of successive values: its middle, and the mean, min and max of x. */
typedef struct dal_statistics_block {
    double t, x, min, max;
} dal_statistics_block;

/* One quantity x followed value by value in constant memory, over 1e10 steps or more: plain
 * numbers, to be copied or kept as one likes.  blocks[] hold the means of length values each. */
typedef struct dal_statistics {
    long long count;      /* finite values so far */
    long long length;     /* values in a block; doubles when all blocks are full */
    long long blocks;     /* full blocks */
    long long open_count; /* values in the open one */
    long long lost;       /* 1 once a value was not finite */
    double first, last;   /* x at the first and at the last value */
    double min, max;      /* of all full blocks */
    double from, to;      /* t at the first and at the last value */
    /* Of the open block: t at its first value, min, max, and the sum of x less first, in
     * parts: value k of the block belongs to part k modulo DAL_PARTIAL_SUMS. */
    double open_t, open_min, open_max, open_sum[DAL_PARTIAL_SUMS];
    /* Sums and means are of `factor` times x less first: 1, or less once a value came near the
     * largest double. */
    double factor;
    /* The squares of differences, in units of rough_unit, a power of two (0: no value was other
     * than 0): of successive values as long as blocks are short, then of values DAL_PARTIAL_SUMS
     * apart in every fourth pair of packs, by part; and the pack before, from which the next ones
     * count. */
    double rough_unit, rough_steps, rough[DAL_PARTIAL_SUMS], held[DAL_PARTIAL_SUMS];
    /* x: factor times the mean less first; min and max are plain. */
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
} dal_statistics;

/* Begins the statistics of count quantities; adds one value of each, at increasing and about
 * equally distant t.  A value that is not finite is left out and remembered as lost. */
void dal_statistics_start(dal_statistics *statistics, int count);
void dal_statistics_add(dal_statistics *statistics, int count, double t, const double *values);
/* Adds `looks` values of each of count quantities, that of quantity i at t[k] being
 * values[i * stride + k]: the same, bit by bit, as adding them one by one, and many times faster.
 */
void dal_statistics_add_many(dal_statistics *statistics, int count, int looks, const double *t,
                             const double *values, size_t stride);

/* max |x| and max |x - first|; infinite when a value was lost. */
double dal_statistics_max_abs(const dal_statistics *statistics);
double dal_statistics_deviation(const dal_statistics *statistics);

/* Whether the deviation of a quantity is what roundings make.  code, word
 *   EXACT     the quantity never changed
 *   ROUNDING  its deviation is what roundings of so many steps make
 *   LARGER    its deviation is larger */
#define DAL_SIZE_LIST(SIZE) SIZE(EXACT, "exact") SIZE(ROUNDING, "rounding") SIZE(LARGER, "larger")

typedef enum dal_size_class {
#define SIZE_CODE(code, word) DAL_SIZE_##code,
    DAL_SIZE_LIST(SIZE_CODE)
#undef SIZE_CODE
        DAL_SIZE_COUNT
} dal_size_class;

/* What a quantity does in the long run.  code, word
 *   NONE         it stays about one value
 *   SETTLES      it changes once and then stays about one value
 *   RANDOM_WALK  its steps are independent: it grows like sqrt(t)
 *   LINEAR       it drifts at one rate, whatever oscillates about the line
 *   POWER        it grows like another power of t
 *   EXPONENTIAL  it grows by equal factors in equal times
 *   GROWING      it oscillates about one value, with a growing amplitude
 *   UNDECIDED    too few values, or too slow an oscillation, to tell these apart
 *   ABORTED      a value was not finite, or the run ended before its time */
#define DAL_TREND_LIST(TREND)                                                                      \
    TREND(NONE, "none")                                                                            \
    TREND(SETTLES, "settles")                                                                      \
    TREND(RANDOM_WALK, "random walk")                                                              \
    TREND(LINEAR, "linear")                                                                        \
    TREND(POWER, "power law")                                                                      \
    TREND(EXPONENTIAL, "exponential")                                                              \
    TREND(GROWING, "growing oscillation")                                                          \
    TREND(UNDECIDED, "undecided")                                                                  \
    TREND(ABORTED, "aborted")

typedef enum dal_trend_class {
#define TREND_CODE(code, word) DAL_TREND_##code,
    DAL_TREND_LIST(TREND_CODE)
#undef TREND_CODE
        DAL_TREND_COUNT
} dal_trend_class;

/* Whether the motion of a run conserves a quantity.  code, text
 *   CONSERVED      it does, or should
 *   NOT_CONSERVED  it need not: forces that depend on time, affine constraints, ...
 *   OFF_SURFACE    it does on D = 0 only, which the run has left by more than roundings
 *   MOVED_BY_PI    pi/e moves (q,v), which is lifted and off pi = 0 */
#define DAL_CONSERVATION_LIST(CONSERVATION)                                                        \
    CONSERVATION(CONSERVED, "conserved")                                                           \
    CONSERVATION(NOT_CONSERVED, "not conserved by the motion")                                     \
    CONSERVATION(OFF_SURFACE, "conserved on D = 0 only, and D is not 0")                           \
    CONSERVATION(MOVED_BY_PI, "not conserved where pi is not 0")

typedef enum dal_conservation {
#define CONSERVATION_CODE(code, text) DAL_##code,
    DAL_CONSERVATION_LIST(CONSERVATION_CODE)
#undef CONSERVATION_CODE
} dal_conservation;

const char *dal_size_text(dal_size_class size);    /* "rounding" */
const char *dal_trend_text(dal_trend_class trend); /* "random walk" */
const char *dal_conservation_text(dal_conservation conservation);

/* Size and trend of a quantity x, and the numbers of the one description behind both. */
typedef struct dal_trend {
    long long count;            /* values */
    double first, last;         /* x at the first and at the last */
    double max_abs, deviation;  /* max |x|, max |x - first| */
    double amplitude;           /* half the range of x about the fitted line */
    double rate;                /* slope of the line, per unit of t */
    double rate_low, rate_high; /* its 95 % interval */
    double max_drift; /* the largest |drift| over the whole series that this interval admits */
    double exponent; /* of t: 1 linear, 1/2 random walk, 0 none and settles, fitted for a power law;
                         NaN where none can be stated */
    dal_size_class size;
    dal_trend_class trend;
    double confidence;             /* 0..1, of the trend */
    dal_conservation conservation; /* unless DAL_CONSERVED, exponent, size, trend and confidence
                                      state nothing; see dal_run_classify */
} dal_trend;

/* Classifies a quantity by a scale (its natural size, in its unit; roundings are measured by it).
 * aborted: the run ended before its time.  More values may be added afterwards. */
void dal_statistics_classify(const dal_statistics *statistics, double scale, int aborted,
                             dal_trend *trend);

/* Classifies all observables of a run: statistics[count] and trend[count] in the order of
 * dal_run_observe.  The scale of H is its own size, which the start sets; that of all others is
 * max(1, max |x|).  E is DAL_CONSERVED where the motion conserves it on every level of D, or on
 * D = 0 while max |D| is rounding-sized, and not where pi/e acts; H where F does not depend on t or
 * pi is 0; all else always is. */
void dal_run_classify(const dal_run *run, const dal_statistics *statistics, int aborted,
                      dal_trend *trend);

/* ---- a system under the hand --------------------------------------------------------------- */

/* A system with parameter values in force and memory to evaluate it in, for one thread. */
typedef struct dal_evaluator dal_evaluator;

/* parameters by name, the rest as the system has them.  The system must outlive it. [alloc]
 * Errors: DAL_NAME (nearest name), DAL_NOT_FINITE, DAL_MEMORY, those of prepare. */
dal_status dal_evaluator_create(dal_evaluator **evaluator, const dal_system *system,
                                const dal_setting *parameters, int parameter_count,
                                dal_error *error);
void dal_evaluator_free(dal_evaluator *evaluator);
const dal_system *dal_evaluator_system(const dal_evaluator *evaluator);
/* Calls any callback of the system; pi may be NULL but for the adjoint.  DAL_UNSUPPORTED when
 * the callback is NULL. */
dal_status dal_evaluator_call(dal_evaluator *evaluator, dal_callback *callback, double t,
                              const double *q, const double *v, const double *pi, double *out);
/* The start: out[2n + multipliers + 1] = q, v, g, e, with x, x', g1 and e replaced as named.
 * Nothing is asked of the constraints.  Errors: DAL_NAME, those of the system. */
dal_status dal_evaluator_start(dal_evaluator *evaluator, const dal_setting *start, int start_count,
                               double *out, dal_error *error);

/* A point of a system: v carries the multipliers g behind the velocities. */
typedef struct dal_point {
    double t;
    const double *q, *v; /* [n], [n + multipliers] */
} dal_point;

/* d/dt of the count values of a callback along the motion, that is the derivative along
 * (v, F, dg/dt, 1): out[count].  For D it must vanish on every level of D. [alloc]
 * Errors: DAL_UNSUPPORTED, DAL_NOT_FINITE, DAL_MEMORY. */
dal_status dal_measure_rate(dal_evaluator *evaluator, dal_callback *callback, int count,
                            const dal_point *at, double *out);

/* What the callbacks give as derivatives against differences of the values: the greatest
 * |given - difference| / max(1, |given|); NaN where there is nothing to compare.  [alloc]
 * Errors: those of the callbacks, DAL_NOT_FINITE: the differences are not finite, DAL_MEMORY. */
typedef struct dal_derivatives {
    double jacobian; /* F_q, F_(v,g) */
    double adjoint;  /* F_q^T pi, F_v^T pi, and its F against field */
    double normal;   /* A = dD/dv */
    double gram;     /* asymmetry of G = A W^-1 A^T, relative to its size */
} dal_derivatives;
dal_status dal_check_derivatives(dal_evaluator *evaluator, const dal_point *at,
                                 dal_derivatives *out);

/* The numerical rank of G = A W^-1 A^T, and its smallest pivot relative to the largest entry of
 * G scaled to a unit diagonal (0 where G is singular). [alloc] */
dal_status dal_measure_rank(dal_evaluator *evaluator, const dal_point *at, int *rank,
                            double *pivot);

/* Moves v[n] along W^-1 A^T until D = 0 (Newton, to stagnation).  DAL_NOT_CONVERGED when it does
 * not; v is then as before. [alloc] */
dal_status dal_project_velocity(dal_evaluator *evaluator, double t, const double *q, double *v);

/* What D is as a function, by differences at points around *at: each is a necessary condition,
 * met to rounding at every point tried. [alloc] */
typedef struct dal_constraint_class {
    int linear;          /* affine in v */
    int constant;        /* affine in (q,v) jointly */
    int bilinear;        /* affine in v, and affine in q */
    int quadratic;       /* of degree <= 2 in (q,v) jointly */
    int parity;          /* D(q,-v,-t) = +D: 1, -D: -1, neither: 0; that of the first
                            constraint, 0 when one has none */
    int homogeneous;     /* v.D_v = k D with one k per constraint */
    int reversible;      /* F(q,-v,-t) = F(q,v,t) */
    double force_defect; /* greatest |F(q,-v,-t) - F(q,v,t)| met, relative to max(1, |F|); NaN where
                            F has no values */
} dal_constraint_class;
/* degree[m], when not NULL, receives the k of each constraint.  Errors: DAL_UNSUPPORTED,
 * DAL_NOT_FINITE: D has no values about the point, DAL_MEMORY. */
dal_status dal_classify_constraints(dal_evaluator *evaluator, const dal_point *at,
                                    dal_constraint_class *out, double *degree);

/* ---- measures of a method ------------------------------------------------------------------ */

enum { DAL_ORDER_LEVELS = 8 };

/* Errors at time T for falling steps (step, step/2, step/4, ... where dal_measure_order made them),
 * what they cost, and the slopes between them. */
typedef struct dal_order {
    int levels;
    double step[DAL_ORDER_LEVELS], error[DAL_ORDER_LEVELS];
    long long evaluations[DAL_ORDER_LEVELS]; /* of the field */
    double slope[DAL_ORDER_LEVELS]; /* slope[i] between levels i-1 and i; slope[0] is NaN */
    double order;                   /* NaN: none can be stated */
} dal_order;

/* Fills in slope and order from levels, step and error.  Of the last three errors that are above
 * rounding (2e-13, and ten times noise, the error of the reference they were taken against) and
 * below half the solution, the order is the second slope, where the two slopes agree so far that
 * the next term of the error moves it by 0.1 at most.  Else it is NaN: the steps are not in the
 * asymptotic range, or fewer than three errors tell of the method. */
void dal_order_slopes(dal_order *order, double noise);

/* The observed order: max norm of the whole state at T against reference[dimension], or, when it
 * is NULL, against gauss12 (or *reference_method) with half the smallest step. [alloc]
 * T must hold a whole number of the steps.  Errors: those of the runs, DAL_ARGUMENT. */
dal_status dal_measure_order(const dal_run_spec *spec, double T, int levels,
                             const dal_method *reference_method, const double *reference,
                             dal_order *order, dal_error *error);

/* Greatest entry of |J^T Omega J - Omega|, J the derivative of one step from the run's start (or
 * from state[4n+2] at time t) by differences; pairs (q,p), (v,pi), (e,pi_e).  Lifted space only:
 * DAL_UNSUPPORTED; e must be finite.  increment, to begin with, relative to max(1, h |v|) of a
 * coordinate and max(1, |x|) of all else; 0: 2e-3. [alloc] */
dal_status dal_check_symplecticity(const dal_run_spec *spec, double t, const double *state,
                                   double increment, double *defect, dal_error *error);

/* rho step rho step = id: greatest difference from the identity, relative to max(1, |x|), over
 * one step from the start (or from state at time t).  rho turns time round, t -> -t, with
 *     (q, v) -> (q, -v),      (q, v, e, p, pi, pi_e) -> (q, -v, e, -p, pi, -pi_e),
 * the antisymplectic lift that leaves H = pi.pi/(2e) + pi.F + p.v alone when mu_e is odd in t and
 * F(q,-v,-t) = F(q,v,t); vakonomic g goes to -g where D is odd in v.  [alloc] */
dal_status dal_check_reversibility(const dal_run_spec *spec, double t, const double *state,
                                   double *defect, dal_error *error);

/* p.dq + pi.dv along steps of spec->method with 1/e = 0: (q,p,v,pi) from a lifted run with the
 * start of spec (its p_x, pi_x name the covector), (dq,dv) from the tangent system of the same
 * model (dal_model_tangent) in the physical space, beginning with direction[2n].  Constant for
 * symplectic methods.  The statistics cover every step. [alloc] */
dal_status dal_adjoint_pairing(const dal_run_spec *spec, const dal_system *tangent,
                               const double *direction, long long steps, dal_statistics *statistics,
                               dal_error *error);

/* ---- the action and Dirac's algebra -------------------------------------------------------- */

/* S = int e/2 |q'' - F(q,q',t)|^2 dt (nh10) with constant e on the curve q[count*n] given at t0,
 * t0 + h, ...: derivatives by differences of order 8, so the four points at either end only lend
 * support; count >= 10. [alloc]  0 on solutions up to discretisation and rounding (about
 * (2e-15/h^2)^2 and h^16), positive off them. */
dal_status dal_measure_action(dal_evaluator *evaluator, double t0, double h, long long count,
                              const double *q, double e, double *action);

/* How far the discrete first-order action (nh23)
 *     S = sum_k P_k.(X_(k+1) - X_k) - h H((X_k + X_(k+1))/2, P_k)
 * is from stationary on a path: X_k [2n+1] = q, v, e at the count nodes, P_k [2n+1] = p, pi, pi_e
 * the mean over each of the count-1 intervals, states[count*(4n+2)] the rows of a lifted run.
 * The greatest |dS/dX_k| over inner nodes and |dS/dP_k|, divided by h: zero to rounding for
 * implicit-midpoint, of the order of the error for others. [alloc] */
dal_status dal_check_stationarity(dal_evaluator *evaluator, double t0, double h, long long count,
                                  const double *states, double *defect);

/* A function on a phase space of 2N numbers z = (X, P). */
typedef double dal_observable_function(void *user, const double *z);

/* gradient[count] of f at z by differences, increments 2e-3 or, where f changes faster, less.  z is
 * used and put back. */
void dal_measure_gradient(dal_observable_function *f, void *user, int count, double *z,
                          double *gradient);
/* {f,g} = sum f_X g_P - f_P g_X from two gradients [2*pairs]. */
double dal_poisson(const double *f, const double *g, int pairs);

/* Dirac's algebra of (nh14) in 6n+2: X = (q, v, lambda, e), P = (p, pi, pi_lambda, pi_e), with
 * constraints pi_e, pi_lambda, p - lambda (primary), pi, lambda (secondary), all brackets by
 * differences of the functions themselves.  Conservation asks, on the surface, for multipliers
 * mu of the primary constraints with {phi, H_c} = 0 for every phi. */
typedef struct dal_dirac {
    int constraints;      /* 4n + 1 */
    int second_class;     /* rank of the matrix of brackets on the surface; 2n */
    int first_class;      /* the rest; 2n + 1 */
    int free_multipliers; /* not determined by conservation; 1, the gauge mu_e */
    double conservation;  /* least |{phi, H_c}| on the surface over all mu; 0 */
    double multipliers;   /* distance of those mu from mu_q = v, mu_lambda = 0; 0 */
    double secondary;     /* the same least |{phi, H_c}| of the primary ones where pi and lambda
                             are not 0: positive, so that the secondary constraints are needed */
    double hamiltonian;   /* |H_c| on the surface; 0 */
} dal_dirac;
/* Errors: DAL_UNSUPPORTED (vakonomic), DAL_NOT_FINITE, DAL_MEMORY. [alloc] */
dal_status dal_check_dirac(dal_evaluator *evaluator, const dal_point *at, double e, dal_dirac *out);

#endif
