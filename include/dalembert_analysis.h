/* dalembert_analysis.h - statistics, trends, checks, order, error budgets, Lyapunov exponents.
 *
 * The conventions of dalembert.h hold here.  Everything here uses its public functions only.
 * Derivatives are compared with central differences of order 8, whose noise is near 1e-12.
 *
 * Symplecticity on the lifted space says nothing about D or the energy of the motion itself: on
 * p = pi = 0 every one-step method whose step on (q,v) is locally invertible, explicit Euler
 * included, is the restriction of a symplectic map. */
#ifndef DALEMBERT_ANALYSIS_H
#define DALEMBERT_ANALYSIS_H

#include "dalembert_evaluator.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- statistics of a quantity along a run -------------------------------------------------- */

enum { DAL_STATISTICS_BLOCKS = 64 /* max blocks of values */ };
enum { DAL_PARTIAL_SUMS = 8 /* sums that a block is added up in */ };

/* The version of dal_statistics: it changes whenever the members or their meaning do, and is saved
 * with them in files.  Each member has 64 bits and none is a pointer. */
enum { DAL_STATISTICS_LAYOUT = 4 };

/* A block of successive values of x. */
typedef struct dal_statistics_block {
    double t;        /* the middle of its times */
    double x;        /* the mean */
    double rms;      /* the root mean square of x less the mean */
    double min, max; /* the extreme values */
} dal_statistics_block;

/* The statistics of one quantity x over any number of values, in constant memory.  They are plain
 * numbers and may be copied and saved.  block[] holds the means of length values each. */
typedef struct dal_statistics {
    long long count;      /* finite values so far */
    long long length;     /* values in a block; doubles when all blocks are full */
    long long blocks;     /* full blocks */
    long long open_count; /* values in the open block */
    long long lost;       /* 1 after a value that was not finite */
    double first, last;   /* x at the first and at the last value */
    double min, max;      /* of all full blocks */
    double from, to;      /* t at the first and at the last value */
    /* Of the open block: t at its first value, min, max, and the partial sums of x - first: value
     * k of the block belongs to sum k modulo DAL_PARTIAL_SUMS. */
    double open_t, open_min, open_max, open_sum[DAL_PARTIAL_SUMS];
    double open_from, open_square[DAL_PARTIAL_SUMS]; /* its first x; ((x - it)/rough_unit)^2 */
    /* Sums and means are of factor * (x - first): 1, or less after a value near the largest
     * double. */
    double factor;
    double scale; /* the largest by dal_statistics_add_scales; 0: none */
    /* Sums of squared differences, in units of rough_unit, a power of two (0: all values were 0):
     * rough_steps of successive values while blocks are short; then rough[] of values
     * DAL_PARTIAL_SUMS apart, one pair in four, by partial sum; held[] is the first of a pair. */
    double rough_unit, rough_steps, rough[DAL_PARTIAL_SUMS], held[DAL_PARTIAL_SUMS];
    /* x: factor * (mean - first), rms: times factor; min and max are of x itself. */
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
} dal_statistics;

/* Begins the statistics of count quantities, statistics[count], which belong to the caller. */
void dal_statistics_start(dal_statistics *statistics, int count);
/* Adds one value of each quantity, values[count], at time t, which increases in nearly equal steps.
 * A value that is not finite is left out and sets lost. */
void dal_statistics_add(dal_statistics *statistics, int count, double t, const double *values);
/* Adds the values of each quantity at t[samples]; the value of quantity i at t[k] is
 * values[i * stride + k].  The result has the bits of adding them one by one; it is many times
 * faster. */
void dal_statistics_add_many(dal_statistics *statistics, int count, int samples, const double *t,
                             const double *values, size_t stride);

/* Adds the scales of the quantities where they have just been observed, scales[count]: the largest
 * so far is the scale of dal_run_classify.  An observer's scales are such. */
void dal_statistics_add_scales(dal_statistics *statistics, int count, const double *scales);

/* max |x|; infinite when a value was lost. */
double dal_statistics_max_abs(const dal_statistics *statistics);
/* max |x - first|; infinite when a value was lost. */
double dal_statistics_deviation(const dal_statistics *statistics);

/* A mean and its 95 % confidence interval, from the means of blocks and the correlation of
 * neighbours (Flyvbjerg, Petersen 1989, DOI 10.1063/1.457480).  The interval covers
 * variation from block to block; it covers neither a slow approach to a limit nor the error of the
 * method. */
typedef struct dal_average {
    double mean;      /* the mean */
    double low, high; /* ends of the interval */
} dal_average;

/* The mean of x; NaN without values; an infinite interval with fewer than 3 blocks. */
void dal_statistics_mean(const dal_statistics *statistics, dal_average *average);

/* How the slope of x varies: the largest less the smallest of the rates of least squares of the
 * four quarters of the values; NaN with fewer than 16 blocks.  A line that bends on as it does here
 * may have, in a run k times as long, a rate within k - 1 such ranges of its own: of 280 rates of
 * shipped systems 93 % did for k = 50.  It is no confidence interval. */
double dal_statistics_rate_range(const dal_statistics *statistics);

/* Sizes: SIZE(code, word). */
#define DAL_SIZE_LIST(SIZE)                                                                        \
    SIZE(EXACT, "exact")       /* the quantity never changed */                                    \
    SIZE(ROUNDING, "rounding") /* no more than the roundings of that many steps cause */           \
    SIZE(LARGER, "larger")     /* more */

/* The size of a quantity's deviation. */
typedef enum dal_size_class {
#define SIZE_CODE(code, word) DAL_SIZE_##code,
    DAL_SIZE_LIST(SIZE_CODE)
#undef SIZE_CODE
        DAL_SIZE_COUNT
} dal_size_class;

/* Trends: TREND(code, word). */
#define DAL_TREND_LIST(TREND)                                                                      \
    TREND(NONE, "none")                   /* it stays about one value */                           \
    TREND(SETTLES, "settles")             /* it changes once and then stays about one value */     \
    TREND(RANDOM_WALK, "random walk")     /* its steps are independent: it grows like sqrt(t) */   \
    TREND(LINEAR, "linear")               /* it drifts at one rate, and may oscillate */           \
    TREND(POWER, "power law")             /* it grows like another power of t */                   \
    TREND(EXPONENTIAL, "exponential")     /* it grows by equal factors in equal times */           \
    TREND(GROWING, "growing oscillation") /* about one value, with a growing amplitude */          \
    TREND(UNDECIDED, "undecided")         /* several of these, or none, explain the values */      \
    TREND(ABORTED, "aborted")             /* a value was not finite, or the run ended early */

/* The trend of a quantity over a long time. */
typedef enum dal_trend_class {
#define TREND_CODE(code, word) DAL_TREND_##code,
    DAL_TREND_LIST(TREND_CODE)
#undef TREND_CODE
        DAL_TREND_COUNT
} dal_trend_class;

/* Kinds of conservation: CONSERVATION(code, text). */
#define DAL_CONSERVATION_LIST(CONSERVATION)                                                        \
    CONSERVATION(CONSERVED, "conserved")                                                           \
    CONSERVATION(NOT_CONSERVED, "not conserved by the motion")                                     \
    CONSERVATION(OFF_SURFACE, "conserved on D = 0 only, and D is not 0")                           \
    CONSERVATION(MOVED_BY_PI, "not conserved where pi is not 0")

/* Whether the motion of a run conserves a quantity. */
typedef enum dal_conservation {
#define CONSERVATION_CODE(code, text) DAL_##code,
    DAL_CONSERVATION_LIST(CONSERVATION_CODE)
#undef CONSERVATION_CODE
} dal_conservation;

const char *dal_size_text(dal_size_class size);    /* the word, "rounding" */
const char *dal_trend_text(dal_trend_class trend); /* the word, "random walk" */
/* The text, "conserved". */
const char *dal_conservation_text(dal_conservation conservation);

/* Size and trend of a quantity x, with the numbers both are decided by. */
typedef struct dal_trend {
    long long count;           /* values */
    double first, last;        /* x at the first and at the last */
    double scale;              /* of the terms that x is made of, see dal_run_classify */
    double max_abs, deviation; /* max |x|, max |x - first| */
    double amplitude;          /* half the range of x about the fitted line */
    double rate;               /* slope of the line, per unit of time passed, |t - first t|; where x
                                   settles, after the change */
    double rate_low, rate_high; /* its 95 % interval, of this run and not of a longer one */
    double max_drift;           /* max |drift| over the whole series in this interval */
    double exponent; /* of t: 1 linear, 1/2 random walk, 0 none and settles, fitted for a power law;
                         NaN where none can be stated */
    dal_size_class size;           /* of the deviation */
    dal_trend_class trend;         /* of x */
    double confidence;             /* 0..1, of the trend; NaN where it is undecided or aborted */
    dal_trend_class likeliest;     /* where undecided: what has half of the evidence; else trend */
    dal_conservation conservation; /* unless DAL_CONSERVED, exponent, size, trend and confidence
                                      state nothing; see dal_run_classify */
} dal_trend;

/* Classifies a quantity by the evidence for each shape (Kass, Raftery 1995, DOI
 * 10.1080/01621459.1995.10476572).  scale is the size of the terms that it is made of, in its unit,
 * by which roundings are measured; where it or a value is not finite, no change is a rounding.
 * aborted: the run ended before its time.  More values may be added afterwards. */
void dal_statistics_classify(const dal_statistics *statistics, double scale, bool aborted,
                             dal_trend *trend);

/* Classifies all observables of a run: statistics[count] and trend[count] in the order of
 * dal_run_observe.  Their scales are those that dal_statistics_add_scales has added, or, where it
 * has added none, of the present state; of norms (|p|, |pi|, |pi_e|) the largest value.  E is
 * DAL_CONSERVED where the motion conserves it on every level of D, or on
 * D = 0 while max |D| is rounding-sized, and not where pi/e acts; H where F does not depend on t or
 * pi is 0; all else always is. */
void dal_run_classify(dal_run *run, const dal_statistics *statistics, bool aborted,
                      dal_trend *trend);

/* ---- order and structure of a method ------------------------------------------------------- */

enum { DAL_ORDER_LEVELS = 8 /* max step sizes of dal_order */ };

/* Whether an order is found, or why not: OUTCOME(code, word). */
#define DAL_ORDER_OUTCOME_LIST(OUTCOME)                                                            \
    OUTCOME(FOUND, "found")                                                                        \
    OUTCOME(COARSE, "coarse")     /* steps too large: slopes differ, or half the solution */       \
    OUTCOME(ROUNDING, "rounding") /* fewer than three errors above rounding or the reference */    \
    OUTCOME(FEW, "few")           /* fewer than three step sizes */
/* Whether an order was found, and why not. */
typedef enum dal_order_outcome {
#define ORDER_OUTCOME_CODE(code, word) DAL_ORDER_##code,
    DAL_ORDER_OUTCOME_LIST(ORDER_OUTCOME_CODE)
#undef ORDER_OUTCOME_CODE
} dal_order_outcome;

/* Errors at time T for decreasing steps (step, step/2, step/4, ... in dal_order_measure), their
 * cost, and the slopes between them. */
typedef struct dal_order {
    int levels;                              /* step sizes, at most DAL_ORDER_LEVELS */
    double step[DAL_ORDER_LEVELS];           /* step sizes, decreasing */
    double error[DAL_ORDER_LEVELS];          /* of (q, v, g) at T: the largest part of a component,
                                                or of its unit (dal_scaled) where that is larger */
    long long evaluations[DAL_ORDER_LEVELS]; /* of the field */
    double slope[DAL_ORDER_LEVELS]; /* slope[i] between levels i-1 and i; slope[0] is NaN */
    double order;                   /* NaN: none can be stated */
    dal_order_outcome outcome;      /* why it is stated, or not */
} dal_order;

/* Computes slope and order from levels, step and error.  The order is the second slope of the last
 * three errors that are above rounding (2e-13, and ten times noise, the error of the reference) and
 * below half the solution, if the two slopes agree so well that the next term of the error changes
 * it by at most 0.1.  Otherwise it is NaN: the steps are not in the asymptotic range, or fewer than
 * three errors are the method's own. */
void dal_order_slopes(dal_order *order, double noise);

/* The number of steps between two times: n with |n step - (to - from)| <= 1e-9 |to|, 1 <= n < 2^53;
 * 0 where there is none. */
long long dal_whole_steps(double from, double to, double step);

/* Measures the order with 2 to DAL_ORDER_LEVELS step sizes: the state at T, a whole number of the
 * steps, against reference[dimension], or, when that is NULL, against gauss12 (or
 * *reference_method) with half the smallest step.  The observer, which may be NULL, has its poll
 * called every few hundred steps of a run. [alloc]  Errors: as for the runs,
 * DAL_STATUS_ARGUMENT. */
dal_status dal_order_measure(dal_order *order, const dal_run_spec *spec, double T, int levels,
                             const dal_method *reference_method, const double *reference,
                             const dal_observer *observer, dal_error *error);

/* The maximum entry of |J^T Omega J - Omega|, J the derivative of one step from the run's start (or
 * from state[4n+2] at time t) by differences; pairs (q,p), (v,pi), (e,pi_e), in the units of the
 * system for q and v, and their reciprocals for the momenta.  Lifted space only:
 * DAL_STATUS_UNSUPPORTED; e must be finite.  increment, to begin with, relative to max(unit, h |v|)
 * of a coordinate and max(unit, |x|) of all else; 0: 2e-3. [alloc]  Errors: as for a step. */
dal_status dal_check_symplecticity(const dal_run_spec *spec, double t, const double *state,
                                   double increment, double *defect, dal_error *error);

/* rho step rho step = id: the maximum difference from the identity, relative to max(unit, |x|),
 * over one step from the start (or from state at time t).  rho reverses time, t -> -t, with
 *     (q, v) -> (q, -v),      (q, v, e, p, pi, pi_e) -> (q, -v, e, -p, pi, -pi_e),
 * the antisymplectic lift that leaves H = pi.pi/(2e) + pi.F + p.v alone when mu_e is odd in t and
 * F(q,-v,-t) = F(q,v,t); vakonomic g goes to -g where D is odd in v.  [alloc]
 * Errors: as for a step. */
dal_status dal_check_reversibility(const dal_run_spec *spec, double t, const double *state,
                                   double *defect, dal_error *error);

/* p.dq + pi.dv along steps of spec->method with 1/e = 0: (q,p,v,pi) from a lifted run with the
 * start of spec (its p_x, pi_x name the covector), (dq,dv) from the tangent system of the same
 * model (dal_model_tangent) in the physical space, beginning with direction[2n].  Constant for
 * symplectic methods.  The statistics cover every step. [alloc]  Errors: as for the runs. */
dal_status dal_adjoint_pairing(const dal_run_spec *spec, const dal_system *tangent,
                               const double *direction, long long steps, dal_statistics *statistics,
                               dal_error *error);

/* ---- the action and Dirac's algebra -------------------------------------------------------- */

/* S = int e/2 |q'' - F(q,q',t)|^2 dt (nh10) with constant e on the curve q[count*n] given at t0,
 * t0 + h, ...: derivatives by differences of order 8, so the four points at either end serve for
 * differences only; count >= 10. [alloc]  0 on solutions up to discretisation and rounding (about
 * (2e-15/h^2)^2 and h^16), positive off them. */
dal_status dal_evaluator_measure_action(dal_evaluator *evaluator, double t0, double h,
                                        long long count, const double *q, double e, double *action);

/* How far the discrete first-order action (nh23) is from stationary on a path.
 *     S = sum_k P_k.(X_(k+1) - X_k) - h H((X_k + X_(k+1))/2, P_k)
 * with X_k [2n+1] = q, v, e at the count >= 3 nodes, P_k [2n+1] = p, pi, pi_e the mean over each of
 * the count-1 intervals, states[count*(4n+2)] the rows of a lifted run.  The maximum of |dS/dX_k|
 * over inner nodes and |dS/dP_k|, divided by h: zero to rounding for implicit-midpoint, of the
 * order of the error for others. [alloc]  Errors: DAL_STATUS_ARGUMENT, errors of the callbacks. */
dal_status dal_evaluator_check_stationarity(dal_evaluator *evaluator, double t0, double h,
                                            long long count, const double *states, double *defect);

/* A function on a phase space of 2N numbers z = (X, P). */
typedef double dal_observable_function(void *user, const double *z);

/* gradient[count] of f at z by differences with increments of 2e-3, or less where f changes faster.
 * z is changed meanwhile and restored. */
void dal_measure_gradient(dal_observable_function *f, void *user, int count, double *z,
                          double *gradient);
/* {f,g} = sum f_X g_P - f_P g_X from two gradients [2*pairs]. */
double dal_poisson(const double *f, const double *g, int pairs);

/* Dirac's algebra (nh12)-(nh19) in 6n+2: X = (q, v, lambda, e), P = (p, pi, pi_lambda, pi_e), with
 * constraints pi_e, pi_lambda, p - lambda (primary), pi, lambda (secondary), all brackets by
 * differences of the functions themselves.  Conservation requires, on the surface, multipliers
 * mu of the primary constraints with {phi, H_c} = 0 for every phi. */
typedef struct dal_dirac {
    int constraints;      /* 4n + 1 */
    int second_class;     /* rank of the matrix of brackets on the surface; 2n */
    int first_class;      /* the rest; 2n + 1 */
    int free_multipliers; /* not determined by conservation; 1, the gauge mu_e */
    double conservation;  /* min |{phi, H_c}| on the surface over all mu; 0 */
    double multipliers;   /* distance of those mu from mu_q = v, mu_lambda = 0; 0 */
    double secondary;     /* the same minimum for the primary ones where pi and lambda
                             are not 0: positive, so that the secondary constraints are needed */
    double hamiltonian;   /* |H_c| on the surface; 0 */
} dal_dirac;
/* Performs Dirac's algorithm at a point, with a value of e.  [alloc]  Errors:
 * DAL_STATUS_UNSUPPORTED (vakonomic), DAL_STATUS_NOT_FINITE. */
dal_status dal_evaluator_check_dirac(dal_evaluator *evaluator, const dal_point *at, double e,
                                     dal_dirac *out);

/* ---- error budgets ------------------------------------------------------------------------- */

/* How much of a drift is truncation, rounding of coefficients, the solver, rounding, projection.
 *
 * A run is compared with runs that differ from it in one thing each.  Quad precision leaves nothing
 * of the rounding of doubles, and further iterations leave nothing of the solver's error, so that
 * over the first steps, for which both are affordable,
 *
 *     x(run) = x(quad, solved further)                     truncation, or coefficients
 *            + x(solved further) - x(quad, solved further) rounding
 *            + x(run) - x(solved further)                  solver
 *
 * at every moment, and so for the rates of lines of least squares.  Coefficients of a method stay
 * doubles in quad precision; their part does not fall with the step as truncation does.  Nor does
 * truncation in steps across branches (if, abs, min, ...), a source of its own.  The effect of
 * projection is the effect of leaving it out, or of adding it; it is no part of the sum.
 *
 * A change along the exact motion is no error.  What is known to be conserved from this start has
 * none: D; E by an identity; H, |p|, |pi| and |pi_e| on p = pi = 0; invariants whose rate vanishes
 * at points about the start.  Of all else the exact motion, found by dop853 with a tolerance of
 * 1e-16 in units of the system's own, says how it changes,
 *
 *     x(quad, solved further) = x(exact motion) + error,
 *
 * and motion and error are sources beside each other; a change within roundings is none.  Without
 * that motion, what quad precision leaves counts as motion if it does not fall with the step.
 * Under a tolerance, half the step is the tolerance divided by 2^p, p being the order of the
 * method.
 *
 * A share is the size of a part, the absolute value of its rate or its max deviation, over the sum
 * of the sizes of all: between 0 and 1, and 1 in all. */

/* Comparison runs: RUN(code, word, text).  Those in quad precision cover the first quad_steps
 * steps, the others all. */
#define DAL_COMPARISON_LIST(RUN)                                                                   \
    RUN(HALVED, "half-step", "half the step")                                                      \
    RUN(LOOSER, "looser", "equations solved less far")                                             \
    RUN(TIGHTER, "tighter", "equations solved further, by two iterations")                         \
    RUN(SUMS, "sums", "plain sums, or compensated ones")                                           \
    RUN(PROJECTION, "projection", "with +project, or without")                                     \
    RUN(EXACT, "exact-motion", "the exact motion, by dop853")                                      \
    RUN(QUAD, "quad", "quad precision, solved further")                                            \
    RUN(QUAD_HALVED, "quad-half-step", "quad precision, solved further, half the step")

/* The runs that a run is compared with. */
typedef enum dal_comparison_run {
#define RUN_CODE(code, word, text) DAL_COMPARISON_##code,
    DAL_COMPARISON_LIST(RUN_CODE)
#undef RUN_CODE
        DAL_COMPARISONS
} dal_comparison_run;

/* Error sources: SOURCE(code, word). */
#define DAL_ERROR_SOURCE_LIST(SOURCE)                                                              \
    SOURCE(MOTION, "motion")         /* the exact motion changes it */                             \
    SOURCE(TRUNCATION, "truncation") /* of smooth equations: falls as the order says */            \
    SOURCE(BRANCHES, "branches")     /* truncation in steps across branches */                     \
    SOURCE(COEFFICIENTS, "coefficients")                                                           \
    SOURCE(SOLVER, "solver")                                                                       \
    SOURCE(ROUNDING, "rounding")                                                                   \
    SOURCE(PROJECTION, "projection")

/* The sources of a drift. */
typedef enum dal_error_source {
#define SOURCE_CODE(code, word) DAL_SOURCE_##code,
    DAL_ERROR_SOURCE_LIST(SOURCE_CODE)
#undef SOURCE_CODE
        DAL_ERROR_SOURCES
} dal_error_source;

const char *dal_comparison_name(dal_comparison_run comparison); /* the word, "half-step" */
const char *dal_comparison_text(dal_comparison_run comparison); /* the text, "half the step" */
const char *dal_error_source_name(dal_error_source source);     /* the word, "truncation" */

/* The behaviour of one observable, and the shares of its drift.  "Beginning": the first
 * quad_steps steps of the run. */
typedef struct dal_shares {
    char name[64];                         /* of the observable */
    dal_trend whole;                       /* along the whole run */
    dal_trend beginning;                   /* of the run, along the beginning */
    dal_trend comparison[DAL_COMPARISONS]; /* of those that ran */
    dal_trend rounding, solver;            /* the differences above, along the beginning */
    dal_trend solver_and_rounding;         /* their sum */
    dal_trend motion;                      /* of the exact motion, along the beginning */
    dal_trend error, error_halved;         /* in quad precision less the exact motion, or less the
                                              start where that conserves it; with half the step */
    bool by_rate;       /* whether the beginning is measured by rates, where the run clearly drifts,
                          or else by max deviations */
    bool whole_by_rate; /* the same for the whole run */
    bool vanishes_in_quad;      /* quad precision leaves nothing of the drift */
    bool is_conserved;          /* the exact motion from this start conserves it */
    bool is_motion;             /* the exact motion makes at least half of the change */
    bool solver_is_significant; /* whether the solver's part is well above rounding */
    double order; /* log2 of what halving the step divides the error by: in quad precision, or
                     without it along the whole run; NaN: nothing to divide */
    /* share: of the change, 0..1; the share of PROJECTION vanishes without it, or with it; NaN: not
     * known.  margin: half the 95 % interval of a share of rates; NaN: none. */
    double share[DAL_ERROR_SOURCES], margin[DAL_ERROR_SOURCES];
} dal_shares;

/* A run, the runs it was compared with, and the shares of every observable's drift. */
typedef struct dal_error_budget {
    dal_run_spec spec;         /* of the run */
    long long steps;           /* of the run */
    long long quad_steps;      /* of those also in quad precision; 0: none */
    long long exact_steps;     /* substeps of the exact motion, all along */
    bool has_projection;       /* the method projects: DAL_COMPARISON_PROJECTION does not */
    bool ran[DAL_COMPARISONS]; /* whether each ran to its end */
    char reason[DAL_COMPARISONS][DAL_MESSAGE_SIZE]; /* and if not, the reason */
    int observables;                                /* of the run */
    dal_shares *shares;                             /* [observables] */
} dal_error_budget;

/* Callbacks of dal_error_budget_create; any may be NULL. */
typedef struct dal_error_budget_observer {
    void *user; /* the first argument of every callback */
    /* Called now and then with the share of the work that is done, 0..1; any status but
     * DAL_STATUS_OK ends it. */
    dal_status (*step)(void *user, double done);
    /* Called with every new run in doubles; may replace its steps by compiled code.  The last such
     * run exists whenever step is called. */
    void (*begin)(void *user, dal_run *run, long long steps);
} dal_error_budget_observer;

/* Runs a spec for a number of steps, and the runs it is compared with, and finds the shares of
 * every observable's drift.  observer may be NULL.  A comparison that is not possible is left out,
 * with a reason.  [alloc]  Errors: as for the run itself, DAL_STATUS_ARGUMENT. */
dal_status dal_error_budget_create(dal_error_budget **budget, const dal_run_spec *spec,
                                   long long steps, long long quad_steps,
                                   const dal_error_budget_observer *observer, dal_error *error);
/* Frees a budget. */
void dal_error_budget_free(dal_error_budget *budget);

/* Says in a sentence what an observable does and by which sources, "drifts by truncation (100 %):
 * halve the step and it falls by 16", in buffer[size]; returns buffer, NULL where there is no such
 * observable. */
char *dal_error_budget_summarise(const dal_error_budget *budget, int observable, char *buffer,
                                 size_t size);
/* Describes in words how a share was found, in buffer[size]; returns buffer, NULL where there is no
 * such observable. */
char *dal_error_budget_describe(const dal_error_budget *budget, int observable,
                                dal_error_source source, char *buffer, size_t size);

/* ---- Lyapunov exponents and phase volume --------------------------------------------------- */

/* A run on (q, v, g) with tangent vectors.  J, the derivative of each of its steps, moves them, and
 * Gram-Schmidt makes them orthonormal again in the units of dal_scaled (Benettin, Galgani,
 * Giorgilli, Strelcyn 1980, DOI 10.1007/BF02128236).
 *     J V = V' R,    exponent i = mean of log(R_ii)/h,    mean of log|det J|/h = their sum
 * The mean divergence of the motion, the mean trace of F_(v,g), is their sum, too.  Over a long
 * time it holds for every density of the phase space, and on D = 0, provided that the logarithms of
 * the density and of |grad D| grow slower than t: they contribute total derivatives only. */
typedef struct dal_lyapunov dal_lyapunov;

/* Makes count tangent vectors; 0: one for each direction of the step map, that is 2n + multipliers,
 * less m where the method enforces D = 0, less one where it enforces E.  tangent is
 * dal_model_tangent of the same model, or NULL.  With it and a Runge-Kutta method, partitioned
 * symplectic Euler, or a composition, J is the derivative of the formulas of the step, to rounding
 * and to the error of its solver; otherwise it is found by differences of the step, of order 8,
 * with increments that do not depend on how far the coordinates have travelled.  The space of the
 * spec is ignored. [alloc]  Errors: as for a run; DAL_STATUS_ARGUMENT (count);
 * DAL_STATUS_UNSUPPORTED: the step is no smooth map of (q, v, g) alone: it has a multiplier as
 * persistent state, or a tolerance. */
dal_status dal_lyapunov_create(dal_lyapunov **lyapunov, const dal_run_spec *spec,
                               const dal_system *tangent, int count, dal_error *error);
/* Frees the vectors and their run. */
void dal_lyapunov_free(dal_lyapunov *lyapunov);
/* Takes steps of the run and its vectors; the run has the bits of dal_run_advance.  Errors: as
 * for a step; DAL_STATUS_SINGULAR when J takes a vector to 0. */
dal_status dal_lyapunov_advance(dal_lyapunov *lyapunov, long long steps, dal_error *error);
/* Begins all means at the present time, after a transient; the vectors stay. */
void dal_lyapunov_discard_transient(dal_lyapunov *lyapunov);

/* The sum of all exponents against the divergence.  For the flow, over any time,
 *     sum = mean divergence + surface,    surface = (1/T) [log |grad D|] between both ends
 * where the method enforces D = 0 (and E: |grad| is then the volume spanned by the gradients with
 * respect to (q, v, g)), else surface = 0: an enforced direction has no exponent, where the flow
 * has an exponent 0. */
typedef struct dal_balance {
    double surface;    /* [log |grad D|] between both ends, over the time, or 0 */
    double difference; /* sum - mean divergence - surface */
    double margin;     /* a bound of the errors of the method, the mean of
                          dimension r x^order / (1 - x) with x = h r and
                          r = max(|F_q|^(1/2), |F_(v,g)|), of the quadrature and of J; it has no
                          statistical part: both are means of one trajectory */
    bool holds;        /* |difference| <= margin; if not, J is wrong */
} dal_balance;

/* Compares the sum of all exponents so far with the divergence.  [alloc]  Errors:
 * DAL_STATUS_UNSUPPORTED: not all exponents, no jacobian, directions lost that neither D nor E
 * explains, a method that maps D to -D in every step, or x >= 1 in some step. */
dal_status dal_lyapunov_balance(dal_lyapunov *lyapunov, dal_balance *balance, dal_error *error);

/* The run, at its present state. */
const dal_run *dal_lyapunov_run(const dal_lyapunov *lyapunov);
/* The number of vectors, and of exponents. */
int dal_lyapunov_count(const dal_lyapunov *lyapunov);
/* Whether J is by the tangent system, not by differences. */
bool dal_lyapunov_is_exact(const dal_lyapunov *lyapunov);
/* Whether the vectors span the space, so that their sum is log|det J|/h. */
bool dal_lyapunov_is_whole(const dal_lyapunov *lyapunov);

/* The unit of time of the system, tau of dal_scaled; NaN for NULL.  Exponents of regular motion may
 * reach about log(1 + T/tau)/T after a time T. */
double dal_lyapunov_time_unit(const dal_lyapunov *lyapunov);
/* Exponent i, from 0 (NaN past the last); their order is decreasing after a transient. */
void dal_lyapunov_exponent(const dal_lyapunov *lyapunov, int i, dal_average *average);
/* The sum of the exponents. */
void dal_lyapunov_sum(const dal_lyapunov *lyapunov, dal_average *average);
/* The divergence: for each step the mean of both ends; NaN when the system has no jacobian. */
void dal_lyapunov_divergence(const dal_lyapunov *lyapunov, dal_average *average);

/* ---- Poincare sections --------------------------------------------------------------------- */

/* One crossing of g = 0. */
typedef struct dal_crossing {
    long long number; /* from 1, of those reported */
    double t;         /* its time */
    int direction;    /* 1: upwards, -1: downwards */
} dal_crossing;

/* A Poincare section, the surface g = 0.  cross and poll may be NULL and must not move the run; any
 * status but DAL_STATUS_OK ends the run with that status. */
typedef struct dal_poincare {
    dal_callback *callback; /* of the run's system; invariant_values for an invariant */
    int count;              /* its values */
    int index;              /* the index of g, from 0 */
    int direction;          /* 1: from g < 0 to g > 0, -1: the other way, 0: both */
    void *user;             /* the first argument of both callbacks */
    /* Called with the run at the crossing. */
    dal_status (*cross)(void *user, dal_run *run, const dal_crossing *crossing);
    /* Called about every 1000 steps. */
    dal_status (*poll)(void *user, dal_run *run);
} dal_poincare;

/* The numbers of crossings, reported or not. */
typedef struct dal_crossings {
    long long up, down;      /* by direction */
    long long touches;       /* minima of |g| below 1e-12 max |g| that are no crossings */
    long long unresolved;    /* steps that may hide crossings, */
    double first_unresolved; /* and the begin of the first of them; NaN: there is none */
} dal_crossings;

/* Advances the run to time T, a whole number of its steps, and reports the crossings that its steps
 * show: the state, found by dal_run_intermediate, with g = 0 to rounding; the trajectory does not
 * change.  A part h of a step is halved, up to 10 times, where |g'| h > pi max |g| or g changes by
 * more than its rates g' at both ends explain.  A start with g = 0 is no crossing. [alloc]
 * Errors: as for the steps and of the callback; DAL_STATUS_ARGUMENT. */
dal_status dal_run_crossings(dal_run *run, double T, const dal_poincare *section,
                             dal_crossings *found, dal_error *error);

#ifdef __cplusplus
}
#endif
#endif
