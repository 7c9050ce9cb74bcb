/* step.h - one step as an integrator sees it.
 *
 * The state y, [dim]:   physical  q[n], v[n], g[multipliers]              dim = n + nw
 *                       lifted    q[n], v[n], e, p[n], pi[n], pi_e        dim = 4n + 2
 * with nw = n + multipliers.  The state is y + r, where r holds the rounding errors so far,
 * products with h included (compensated summation, Kahan, CACM 8 (1965) 40).  y is never -0, so
 * that the same motion has the same bits on both spaces. */
#ifndef DAL_KERNEL_STEP_H
#define DAL_KERNEL_STEP_H

#include "../../include/dalembert_method.h"
#include "lanes.h"
#include "parts.h"
#include "persistent.h"

/* One step: s->t and s->h are its start and size, s->y[DAL_DIM(s)] is the state.  What else an
 * integrator needs, the functions of the kernel give. */
typedef struct dal_step dal_step;

#ifndef DAL_SPECIALISED
typedef enum dal_callback_code {
#define CALLBACK(code, ...) DAL_EVAL_##code,
    DAL_CALLBACK_LIST(CALLBACK)
#undef CALLBACK
        DAL_EVAL_COUNT
} dal_callback_code;
#endif

#ifdef DAL_SPECIALISED

/* In a generated file dimensions are constants, memory is local. */
#define DAL_N(s)  (DAL_FIXED_N * DAL_STEP_GROUPS)
#define DAL_NW(s) (DAL_FIXED_NW * DAL_STEP_GROUPS)
#define DAL_M(s)  DAL_FIXED_M
#if DAL_WITH(HOLONOMIC)
#define DAL_HOLONOMIC(s) DAL_FIXED_HOLONOMIC
#else
#define DAL_HOLONOMIC(s) 0
#endif
#define DAL_DIM(s)    (DAL_FIXED_DIM * DAL_STEP_GROUPS)
#define DAL_LIFTED(s) DAL_FIXED_LIFTED
#define DAL_EFFORT(s) DAL_FIXED_EFFORT
#define DAL_GAUGE(s)  DAL_FIXED_GAUGE
#if DAL_WITH(SOLVE)
#define DAL_SOLVER(s)                 DAL_FIXED_SOLVER
#define DAL_ITERATIONS(s)             DAL_FIXED_ITERATIONS
#define DAL_SOLVER_TOLERANCE(s)       DAL_FIXED_SOLVER_TOLERANCE
#define DAL_EXTRA_ITERATIONS(s)       DAL_FIXED_EXTRA_ITERATIONS
#define DAL_MAY_NEWTON(s)             DAL_FIXED_NEWTON
#define DAL_FIELD_OPERATIONS(s)       DAL_FIXED_FIELD_OPERATIONS
#define DAL_JACOBIAN_OPERATIONS(s)    DAL_FIXED_JACOBIAN_OPERATIONS
#define DAL_STAGES(t)                 DAL_FIXED_STAGES
#define DAL_PROPERTIES(s)             DAL_FIXED_PROPERTIES
#define DAL_PERSISTENT_MULTIPLIERS(s) DAL_FIXED_MULTIPLIER        /* m, or 0 */
#define DAL_STAGE_DERIVATIVES(s)      DAL_FIXED_STAGE_DERIVATIVES /* size, or 0 */
#define DAL__COUNT_DERIVATIVES        DAL_FIXED_STAGE_DERIVATIVES
#else
#define DAL__COUNT_DERIVATIVES 0
#endif
#if DAL_WITH(REGULAR)
#define DAL_GUARDS(s)       DAL_FIXED_GUARDS
#define DAL_RANK_CHECKED(s) DAL_FIXED_RANK_CHECKED
#endif
#if DAL_WITH(PIVOTS)
#define DAL_PIVOTS(s) (DAL__COUNT_PIVOTS - 1)
#endif
#if DAL_WITH(CONTROL)
#define DAL_CONTROLLED(s) 1
#define DAL_TOLERANCE(s)  DAL_FIXED_TOLERANCE
#endif
#if DAL_WITH(SERIES)
#define DAL_SERIES(s)         DAL_FIXED_SERIES
#define DAL_TAYLOR_ORDER(s)   DAL_FIXED_TAYLOR_ORDER
#define DAL_TOLERANCE_ROOT(s) DAL_FIXED_TOLERANCE_ROOT
#define DAL_UNIT_OF_TIME(s)   DAL_FIXED_UNIT_OF_TIME
#endif
#define DAL_PLAIN(s)             DAL_FIXED_PLAIN
#define DAL_TANGENT(s)           DAL_FIXED_TANGENT
#define DAL__AT_LEAST_ONE(count) ((count) > 0 ? (count) : 1)
#define DAL__COUNT_ONE           1
#define DAL__COUNT_TWO           2
#define DAL__COUNT_THREE         3
#define DAL__COUNT_MULTIPLIER    DAL_FIXED_MULTIPLIER
#define DAL__COUNT_ACCELERATION  DAL_FIXED_ACCELERATION

#define DAL_VECTOR(step, name, count) num name[DAL__AT_LEAST_ONE(count)]
#define DAL__MARK(step)               (void)0
#define DAL__RELEASE(step)            (void)0

#else

#define DAL_N(s)  ((s)->n)  /* coordinates */
#define DAL_NW(s) ((s)->nw) /* velocities and vakonomic multipliers */
#define DAL_M(s)  ((s)->m)  /* constraints */
#ifdef DAL_MINIMAL
#define DAL_HOLONOMIC(s) 0
#define DAL_GAUGE(s)     0
#else
#define DAL_HOLONOMIC(s) ((s)->holonomic) /* of these, the last */
#define DAL_GAUGE(s)     ((s)->gauge)     /* mu_e is not of t alone */
#endif
#define DAL_DIM(s)                    ((s)->dim) /* numbers in the state */
#define DAL_LIFTED(s)                 ((s)->lifted)
#define DAL_EFFORT(s)                 ((s)->effort) /* K of the effort is not 1 */
#define DAL_SOLVER(s)                 ((s)->solver)
#define DAL_ITERATIONS(s)             ((s)->iterations)
#define DAL_SOLVER_TOLERANCE(s)       ((s)->solver_tolerance)
#define DAL_EXTRA_ITERATIONS(s)       ((s)->extra_iterations)
#define DAL_CONTROLLED(s)             ((s)->tolerance > 0.0)
#define DAL_TOLERANCE(s)              ((s)->tolerance)
#define DAL_PLAIN(s)                  ((s)->plain)
#define DAL_TANGENT(s)                ((s)->tangent)
#define DAL_MAY_NEWTON(s)             ((s)->has_jacobian && (s)->solver != DAL_FIXED_POINT)
#define DAL_FIELD_OPERATIONS(s)       ((s)->field_operations)
#define DAL_JACOBIAN_OPERATIONS(s)    ((s)->jacobian_operations)
#define DAL_PROPERTIES(s)             ((s)->properties)
#define DAL_GUARDS(s)                 ((s)->guards)
#define DAL_RANK_CHECKED(s)           ((s)->rank_checked)
#define DAL_PIVOTS(s)                 ((s)->pivot_count)
#define DAL_PERSISTENT_MULTIPLIERS(s) ((s)->m)
#define DAL_STAGE_DERIVATIVES(s)      ((s)->derivatives_kept)
#define DAL_STAGES(t)                 ((t)->stages) /* of a tableau */
#define DAL_SERIES(s)                 ((s)->series_count)
#define DAL_TAYLOR_ORDER(s)           ((s)->taylor_order)
#define DAL_TOLERANCE_ROOT(s)         ((s)->tolerance_root)
#define DAL_UNIT_OF_TIME(s)           ((s)->unit_of_time) /* of series: a power of two */
#define DAL_UNITS(s)                  ((s)->units)        /* [n + nw] of q, v, g; NULL: 1 */
#define DAL_SPEEDS(s)                 ((s)->speeds)       /* [nw] of v, g; NULL: all are the same */
#define DAL_LEVELS(s)                 ((s)->levels)       /* [m + 1] of D, E; NULL: likewise */

#endif

/* The state of a step: numbers of its own in a generated file, elsewhere in an engine. */
#ifdef DAL_SPECIALISED
#define DAL__NUMBERS(name, count) name[DAL__AT_LEAST_ONE(count) * DAL_STEP_GROUPS]
#else
#define DAL__NUMBERS(name, count) *name
#endif

struct dal_step {
    double t, h; /* start and size of the step; dal_update advances t */
    num DAL__NUMBERS(y, DAL_FIXED_DIM), DAL__NUMBERS(r, DAL_FIXED_DIM);
#define DAL__METHOD_NUMBERS(member, count) num DAL__NUMBERS(member, DAL__COUNT_##count);
    DAL__METHOD_STATE_LIST(DAL__METHOD_NUMBERS)

    dal_lane_set alive, unconverged; /* not failed; not solved */
#if DAL_HAS_TIMES
    bool has_times; /* callbacks are evaluated at these times, not at a common one */
    dal_times times;
#endif
#if DAL_WITH(PIVOTS)
    num DAL__NUMBERS(pivots, DAL__COUNT_PIVOTS - 1); /* of the first evaluation of F in the step */
    bool DAL_OF_GROUPS(pivots_known);                /* there was one, or they are not compared */
#endif
#ifdef DAL_SPECIALISED
    const dal_stored *work; /* parameters, and values that depend on them alone */
#else
    int n, nw, m, dim;
    int holonomic;     /* of the m constraints, the last: derivatives of g */
    bool lifted;       /* on the canonical space, */
    bool effort;       /* with the callback effort, */
    bool gauge;        /* and with gauge_gradient, there */
    bool tangent;      /* while p, pi hold a tangent vector (dq, dv) */
    num *method_state; /* [method_state_count] the numbers of the method, one after the other */
    int method_state_count;
    int derivatives_kept;
    int pivot_count; /* that the rank check compares, see acceptance.h */

    int solver;              /* dal_solver */
    int iterations;          /* max iterations */
    double solver_tolerance; /* relative change; 0: rounding level */
    int extra_iterations;    /* after convergence */
    bool plain;              /* sums without compensation, r stays 0 */
    bool has_jacobian;
    int field_operations, jacobian_operations; /* of the callbacks */
    unsigned properties;                       /* of the system */
    int guards;                                /* of the system */
    bool rank_checked, rank_by_factors;        /* whether steps are, see acceptance.h; and how */
    double tolerance;                          /* of substeps, 0: no substeps */
    const double *units, *speeds, *levels;     /* of the system; NULL as in the macros */

    num *scratch; /* bump allocator, see dal_scratch */
    size_t used, capacity;
    bool exhausted; /* more was requested, and the step fails */

    const dal_integrator *const *layer; /* innermost first */
    int depth;                          /* which of the chain is at work */

    void (*eval)(dal_step *step, dal_callback_code code, double t, const num *q, const num *v,
                 const num *pi, num *out);
    void (*series)(dal_step *step, int k, int stride, const num *in, num *memory, num *out);
    int series_count;        /* in memory */
    int taylor_order;        /* for the tolerance */
    double tolerance_root;   /* tolerance^(1/taylor_order) */
    double unit_of_time;     /* of the system */
    struct dal_dense *dense; /* where to store the polynomial of a substep; NULL: nowhere */
    void *owner;             /* of eval and series */
#endif
    long long evaluations; /* of the field or the lifted field */
};

#ifdef DAL_SPECIALISED

#if DAL_WITH(METHOD_STATE)
/* Copies the state of the method; restores it in some lanes. */
enum {
    DAL__METHOD_STATE_SIZE = 0
#define MEMBER(member, count) +DAL__COUNT_##count
    DAL__METHOD_STATE_LIST(MEMBER)
#undef MEMBER
};
#define DAL_METHOD_STATE(s) DAL__METHOD_STATE_SIZE
DAL_INLINE void dal_save_method_state(const dal_step *s, num *to)
{
#define MEMBER(member, count)                                                                      \
    DAL_EACH(i, DAL__COUNT_##count) to[i] = s->member[i];                                          \
    to += DAL__COUNT_##count;
    DAL__METHOD_STATE_LIST(MEMBER)
#undef MEMBER
}
DAL_INLINE void dal_restore_method_state(dal_step *s, dal_mask lanes, const num *from)
{
#define MEMBER(member, count)                                                                      \
    DAL_EACH(i, DAL__COUNT_##count) s->member[i] = dal_select(lanes, from[i], s->member[i]);       \
    from += DAL__COUNT_##count;
    DAL__METHOD_STATE_LIST(MEMBER)
#undef MEMBER
}
#endif

/* The system as straight-line code, further down. */
DAL_INLINE void dal_eval(dal_step *s, dal_callback_code code, double t, const num *q, const num *v,
                         const num *pi, num *out);
#if DAL_WITH(EVAL_GROUP)
/* The same for one group of lanes. */
DAL_INLINE void dal_eval_group(dal_step *s, int group, dal_callback_code code, double t,
                               const num *q, const num *v, num *out);
#endif
#if DAL_WITH(SERIES)
/* Coefficient k of F and its like from in, see dal_series. */
DAL_INLINE void dal_eval_series(dal_step *s, int k, int stride, const num *in, num *memory,
                                num *out);
#endif

#else

DAL_NOINLINE __attribute__((cold)) num *dal__exhausted(dal_step *s, int count)
{
    s->used -= (size_t)count;
    s->exhausted = true;
    return (size_t)count <= s->capacity ? s->scratch : NULL;
}

/* count numbers of scratch, valid until the step ends or DAL__RELEASE; their values are undefined.
 * The stages of the descriptor determine how many there are.  Where that is too few the step fails
 * with DAL_STATUS_MEMORY when it ends; until then numbers share their memory. */
DAL_INLINE num *dal_scratch(dal_step *s, int count)
{
    num *const vector = s->scratch + s->used;
    s->used += (size_t)count;
    return DAL_RARELY(s->used > s->capacity) ? dal__exhausted(s, count) : vector;
}

/* Declares a scratch vector.  The count must be made of constants and the macros above. */
#define DAL_VECTOR(step, name, count) num *const name = dal_scratch((step), (count))
/* DAL__RELEASE frees the vectors declared since DAL__MARK. */
#define DAL__MARK(step)               const size_t dal__mark = (step)->used
#define DAL__RELEASE(step)            (step)->used = dal__mark

/* Copies the state of the method; restores it in some lanes. */
#define DAL_METHOD_STATE(s)           ((s)->method_state_count)
DAL_INLINE void dal_save_method_state(const dal_step *s, num *to)
{
    DAL_EACH(i, s->method_state_count) to[i] = s->method_state[i];
}
DAL_INLINE void dal_restore_method_state(dal_step *s, dal_mask lanes, const num *from)
{
    DAL_EACH(i, s->method_state_count)
        s->method_state[i] = dal_select(lanes, from[i], s->method_state[i]);
}

/* Evaluates a callback of the system, DAL_EVAL_FIELD or the like, in all lanes. */
DAL_INLINE void dal_eval(dal_step *s, dal_callback_code code, double t, const num *q, const num *v,
                         const num *pi, num *out)
{
    s->eval(s, code, t, q, v, pi, out);
}
DAL_INLINE void dal_eval_group(dal_step *s, int group, dal_callback_code code, double t,
                               const num *q, const num *v, num *out)
{
    (void)group;
    dal_eval(s, code, t, q, v, NULL, out);
}
DAL_INLINE void dal_eval_series(dal_step *s, int k, int stride, const num *in, num *memory,
                                num *out)
{
    s->series(s, k, stride, in, memory, out);
}

#endif

#if DAL_WITH(PIVOTS)
/* Whether a callback solves the equations of F, and leaves their pivots. */
DAL_INLINE bool dal_leaves_pivots(dal_callback_code code)
{
#if DAL_WITH(LIFT)
    if (code == DAL_EVAL_ADJOINT) return true;
#endif
#if DAL_WITH(ENFORCEMENT)
    if (code == DAL_EVAL_ENFORCEMENT) return true;
#endif
    return code == DAL_EVAL_FIELD;
}
#endif

/* Whether a step, or a part of it, has failed in all lanes.  Without the hint a compiler takes the
 * code after several returns for cold and leaves it slow. */
DAL_INLINE bool dal_failed(dal_status status) { return DAL_RARELY(status != DAL_STATUS_OK); }

#if DAL_WITH(TANGENT)
/* Between the two dal_field moves a tangent vector stored in p and pi. */
DAL_INLINE void dal_begin_tangent(dal_step *s)
{
#ifndef DAL_SPECIALISED
    s->tangent = true;
#endif
    (void)s;
}
DAL_INLINE void dal_end_tangent(dal_step *s)
{
#ifndef DAL_SPECIALISED
    s->tangent = false;
#endif
    (void)s;
}
#endif

/* The output of DAL_EVAL_CONSTRAINT for a group: D, A, B. */
#define DAL_CONSTRAINT_SIZE(s) (DAL_M(s) + 2 * DAL_M(s) * DAL_PER_GROUP(DAL_N(s)))

/* Places of e, p, pi, pi_e in a state. */
DAL_INLINE int dal_at_e(const dal_step *s) { return 2 * DAL_N(s); }
DAL_INLINE int dal_at_p(const dal_step *s) { return 2 * DAL_N(s) + 1; }
DAL_INLINE int dal_at_pi(const dal_step *s) { return 3 * DAL_N(s) + 1; }
DAL_INLINE int dal_at_pi_e(const dal_step *s) { return 4 * DAL_N(s) + 1; }

#if DAL_WITH(PROJECTION)
/* p = pi = pi_e = 0, after a projection. */
DAL_INLINE void dal_clear_momenta(dal_step *s)
{
    const int first = dal_at_p(s);
    DAL_EACH(i, DAL_LIFTED(s) * (2 * DAL_N(s) + 1)) {
        s->y[first + i] = dal_select(s->alive, dal_num(0.0), s->y[first + i]);
        s->r[first + i] = dal_select(s->alive, dal_num(0.0), s->r[first + i]);
    }
}
#endif

/* F(q, v, t), out[nw]. */
DAL_INLINE void dal_force(dal_step *s, double t, const num *q, const num *v, num *out)
{
    s->evaluations++;
    dal_eval(s, DAL_EVAL_FIELD, t, q, v, NULL, out);
}
#if DAL_WITH(ENFORCEMENT)
/* y and l with W y = beta b + B^T l, A y = A pi + c at a point, out[n + m]; in[n + m + 1] is pi, c
 * and beta.  Counts as an evaluation of F. */
DAL_INLINE void dal_eval_enforcement(dal_step *s, double t, const num *q, const num *v,
                                     const num *in, num *out)
{
    s->evaluations++;
    dal_eval(s, DAL_EVAL_ENFORCEMENT, t, q, v, in, out);
}

/* D at a point, in D[m]. */
DAL_INLINE void dal_constraint_value(dal_step *s, double t, const num *q, const num *v, num *D)
{
    if (DAL_M(s) > 0) dal_eval(s, DAL_EVAL_CONSTRAINT_VALUE, t, q, v, NULL, D);
}
#endif
#if DAL_WITH(EFFORT)
/* Adds to F_q^T pi and F_v^T pi the derivatives of w pi.K pi/2; then K pi, out[4n]. */
DAL_INLINE void dal__add_effort(dal_step *s, double t, const num *q, const num *v, const num *pi,
                                num w, num *out)
{
    const int n = DAL_N(s);
    DAL__MARK(s);
    DAL_VECTOR(s, effort, 3 * DAL_N(s));
    dal_eval(s, DAL_EVAL_EFFORT, t, q, v, pi, effort);
    DAL_EACH(i, 2 * n) out[n + i] = dal_fma(w, effort[n + i], out[n + i]);
    DAL_EACH(i, n) out[3 * n + i] = effort[i];
    DAL__RELEASE(s);
}
#endif
#if DAL_WITH(LIFT)
/* The numbers that dal_adjoint writes. */
#define DAL_ADJOINT_SIZE(s) ((3 + DAL_EFFORT(s)) * DAL_N(s))
/* F, and the derivatives by q and v of pi.F + w pi.K pi/2, w = 1/e; where K is not 1 then K pi. */
DAL_INLINE void dal_adjoint(dal_step *s, double t, const num *q, const num *v, const num *pi, num w,
                            num *out)
{
    s->evaluations++;
    dal_eval(s, DAL_EVAL_ADJOINT, t, q, v, pi, out);
#if DAL_WITH(EFFORT)
    if (DAL_EFFORT(s)) dal__add_effort(s, t, q, v, pi, w, out);
#endif
    (void)w;
}
/* K pi [n] from what dal_adjoint wrote for pi. */
DAL_INLINE const num *dal_push(const dal_step *s, const num *adjoint, const num *pi)
{
    return DAL_EFFORT(s) ? adjoint + 3 * DAL_N(s) : pi;
}
/* mu_e at a state y; where it is of t alone, any. */
DAL_INLINE num dal_mu_e_at(dal_step *s, double t, const num *y)
{
    num mu;
    dal_eval(s, DAL_EVAL_GAUGE, t, y, y + DAL_N(s), y + dal_at_e(s), &mu);
    return mu;
}
DAL_INLINE num dal_mu_e(dal_step *s, double t) { return dal_mu_e_at(s, t, s->y); }

/* pi_e' = pi.K pi / (2e^2), with w = 1/e; K_pi may be pi itself. */
DAL_INLINE num dal_gauge_rate(const num *pi, const num *K_pi, int n, num w)
{
#if DAL_WITH(EFFORT)
    num sum = dal_num(0.0);
    if (K_pi != pi) {
        DAL_EACH(i, n) sum = dal_fma(pi[i], K_pi[i], sum);
        return 0.5 * sum * (w * w);
    }
#endif
    (void)K_pi;
    return 0.5 * dal_square(pi, n) * (w * w);
}
#endif

#if DAL_WITH(TANGENT)
#if DAL_WITH(GAUGE_GRADIENT)
/* de' for a tangent vector (dq, dv, de), stored in p, pi and pi_e. */
DAL_INLINE void dal__tangent_gauge(dal_step *s, double t, const num *y, num *dy)
{
    const int n = DAL_N(s);
    num sum = dal_num(0.0);
    DAL_VECTOR(s, gradient, 2 * DAL_N(s) + 1);
    dal_eval(s, DAL_EVAL_GAUGE_GRADIENT, t, y, y + n, y + dal_at_e(s), gradient);
    DAL_EACH(i, 2 * n + 1) sum = dal_fma(gradient[i], y[dal_at_p(s) + i], sum);
    dy[dal_at_pi_e(s)] = sum;
}
#endif

/* The field of x' = f, dx' = Df dx, with the tangent vector dx stored in p and pi. */
DAL_INLINE void dal__tangent_field(dal_step *s, double t, const num *y, num *DAL_RESTRICT dy)
{
    const int n = DAL_N(s), dq = dal_at_p(s), dv = dal_at_pi(s);
    DAL__MARK(s);
    DAL_VECTOR(s, jacobian, 2 * DAL_N(s) * DAL_N(s));
    dal_force(s, t, y, y + n, dy + n);
    dal_eval(s, DAL_EVAL_JACOBIAN, t, y, y + n, NULL, jacobian);
    DAL_EACH(i, n) {
        num sum = dal_num(0.0);
        DAL_EACH(j, n) sum = dal_fma(jacobian[i * n + j], y[dq + j], sum);
        DAL_EACH(j, n) sum = dal_fma(jacobian[(n + i) * n + j], y[dv + j], sum);
        dy[dq + i] = y[dv + i];
        dy[dv + i] = sum;
    }
    dy[dal_at_e(s)] = dal_mu_e_at(s, t, y);
    dy[dal_at_pi_e(s)] = dal_num(0.0);
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s)) dal__tangent_gauge(s, t, y, dy);
#endif
    DAL__RELEASE(s);
}
#endif

#if DAL_WITH(LIFT)
#if DAL_WITH(GAUGE_GRADIENT)
/* Adds to the rates of p, pi, pi_e the derivatives of -mu_e pi_e by q, v, e. */
DAL_INLINE void dal__add_gauge(dal_step *s, double t, const num *y, num *dy)
{
    const int n = DAL_N(s);
    DAL__MARK(s);
    DAL_VECTOR(s, gradient, 2 * DAL_N(s) + 1);
    dal_eval(s, DAL_EVAL_GAUGE_GRADIENT, t, y, y + n, y + dal_at_e(s), gradient);
    DAL_EACH(i, 2 * n + 1)
        dy[dal_at_p(s) + i] = dal_fma(-y[dal_at_pi_e(s)], gradient[i], dy[dal_at_p(s) + i]);
    DAL__RELEASE(s);
}
#endif

/* The field of the canonical variables, without q' = v. */
DAL_INLINE void dal__lifted_field(dal_step *s, double t, const num *y, num *DAL_RESTRICT dy)
{
    const int n = DAL_N(s);
    DAL__MARK(s);
    DAL_VECTOR(s, f, DAL_ADJOINT_SIZE(s));
    const num *p = y + dal_at_p(s), *pi = y + dal_at_pi(s);
    const num w = 1.0 / y[dal_at_e(s)];
    dal_adjoint(s, t, y, y + n, pi, w, f);
    const num *K_pi = dal_push(s, f, pi);
    DAL_EACH(i, n) dy[n + i] = dal_fma(K_pi[i], w, f[i]);
    DAL_EACH(i, n) dy[dal_at_p(s) + i] = -f[n + i];
    DAL_EACH(i, n) dy[dal_at_pi(s) + i] = -p[i] - f[2 * n + i];
    dy[dal_at_e(s)] = dal_mu_e_at(s, t, y);
    dy[dal_at_pi_e(s)] = dal_gauge_rate(pi, K_pi, n, w);
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s)) dal__add_gauge(s, t, y, dy);
#endif
    DAL__RELEASE(s);
}
#endif

/* The whole first-order field in the space of the run, dy[dim]:
 *     q' = v   v' = F + pi/e   e' = mu_e   p' = -F_q^T pi   pi' = -p - F_v^T pi   pi_e' = pi^2/2e^2
 * after (nh20); with an effort, by H = pi.K pi/(2e) + pi.F + p.v + mu_e pi_e. */
DAL_INLINE void dal_field(dal_step *s, double t, const num *y, num *DAL_RESTRICT dy)
{
    const int n = DAL_N(s);
    DAL_EACH(i, n) dy[i] = y[n + i];
    if (!DAL_LIFTED(s)) dal_force(s, t, y, y + n, dy + n);
#if DAL_WITH(TANGENT)
    if (DAL_LIFTED(s) && DAL_TANGENT(s)) dal__tangent_field(s, t, y, dy);
#endif
#if DAL_WITH(LIFT)
    if (DAL_LIFTED(s) && !DAL_TANGENT(s)) dal__lifted_field(s, t, y, dy);
#endif
}

/* y + r += factor*d for count components, compensated; lanes that are not alive stay unchanged.  r
 * is factor*d less the change of y: exact where |y| >= |d|, product included, else within the
 * rounding of d.  A sum is -0 only if both terms are, and y is not. */
DAL_INLINE void dal_add_lanes(dal_step *s, int first, int count, num factor, const num *d)
{
    num *const DAL_RESTRICT y = s->y + first, *const DAL_RESTRICT r = s->r + first;
    const dal_lane_set alive = s->alive;
    DAL_EACH(i, count) {
        const dal_mask lanes = DAL_LANES_AT(alive, i);
        const num a = y[i], b = d[i], before = r[i];
        const num sum = a + dal_fma(factor, b, before);
        y[i] = dal_select(lanes, sum, a);
        r[i] = dal_select(lanes, dal_fma(factor, b, a - sum) + before, before);
    }
    if (DAL_RARELY(DAL_PLAIN(s)))
        DAL_EACH(i, count) r[i] = dal_select(DAL_LANES_AT(alive, i), dal_num(0.0), r[i]);
}

/* The same with one factor for all lanes. */
DAL_INLINE void dal_add_multiple(dal_step *s, int first, int count, double factor, const num *d)
{
    dal_add_lanes(s, first, count, dal_num(factor), d);
}

/* y + r += d for count components from `first` on. */
DAL_INLINE void dal_add(dal_step *s, int first, int count, const num *d)
{
    dal_add_multiple(s, first, count, 1.0, d);
}

/* y + r += factor*d, d[dim]. */
DAL_INLINE void dal_update_lanes(dal_step *s, num factor, const num *d)
{
    dal_add_lanes(s, 0, DAL_DIM(s), factor, d);
    if (DAL_LIFTED(s)) { /* an infinite e has no rounding error */
        num *error = s->r + dal_at_e(s);
        *error = dal_select(dal_finite(*error), *error, dal_num(0.0));
    }
}

/* Ends a (sub)step of size h: y + r += factor*d, d[dim], and t += h. */
DAL_INLINE dal_status dal_update_multiple(dal_step *s, double h, double factor, const num *d)
{
    dal_update_lanes(s, dal_num(factor), d);
    s->t += h;
    return DAL_STATUS_OK;
}
/* Ends a (sub)step of size h: y + r += d, d[dim], and t += h. */
DAL_INLINE dal_status dal_update(dal_step *s, double h, const num *d)
{
    return dal_update_multiple(s, h, 1.0, d);
}

#ifndef DAL_SPECIALISED
/* A step of size h of the method inside the present modifier. */
DAL_INLINE dal_status dal_inner(dal_step *s, double h)
{
    DAL__MARK(s);
    const double outer = s->h;
    s->h = h;
    s->depth--;
    const dal_status status = s->layer[s->depth]->step(s);
    s->depth++;
    s->h = outer;
    DAL__RELEASE(s);
    return status;
}
#endif

#endif
