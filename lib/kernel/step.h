/* step.h - one step as an integrator sees it.
 *
 * The state y, [dim]:   physical  q[n], v[n], g[multipliers]              dim = n + nw
 *                       lifted    q[n], v[n], e, p[n], pi[n], pi_e        dim = 4n + 2
 * with nw = n + multipliers.  A state is kept as y + r, r the rounding error of the last sum
 * (compensated summation, Kahan 1965; two-sum, Knuth, TAOCP 2, 4.2.2), and y is never -0, so that
 * the same motion has the same bits on both spaces. */
#ifndef DAL_KERNEL_STEP_H
#define DAL_KERNEL_STEP_H

#ifndef DAL_TRY
#define DAL_TRY(expression)                                                                        \
    do {                                                                                           \
        dal_status dal__s = (expression);                                                          \
        if (dal__s != DAL_OK) return dal__s;                                                       \
    } while (0)
#endif

typedef struct dal_step dal_step;

enum { DAL_MOST_STAGES = 16 };

/* What a system can be asked for; outputs as in dal_callbacks. */
typedef enum dal_question {
    DAL_ASK_FIELD,
    DAL_ASK_ADJOINT,
    DAL_ASK_JACOBIAN,
    DAL_ASK_CONSTRAINT,
    DAL_ASK_GAUGE,
    DAL_ASK_GUARDS
} dal_question;

struct dal_step {
    double t, h; /* where the step begins, and its size; dal_update moves t */
    int n, nw, m, dim;
    int lifted; /* 1 on the canonical space */
    num *y, *r; /* [dim] */

    /* Carried from step to step beside the state. */
    num *stiff;    /* [1] 1 where the fixed point was too slow and Newton took over */
    num *slopes;   /* [stages*(nw + n)] stage slopes of the last collocation step */
    num *slopes_h; /* [1] its step size, 0: none */

    dal_mask alive;       /* lanes that go on */
    dal_mask unconverged; /* lanes whose implicit equations were not solved */
    int solver;           /* dal_solver */
    int iterations;       /* most iterations */
    int has_jacobian;

    num *scratch; /* bump allocator, see dal_scratch */
    size_t used, room;

    const dal_integrator *const *chain; /* innermost first */
    int depth;                          /* which of the chain is at work */

    void (*ask)(dal_step *step, dal_question question, double t, const num *q, const num *v,
                const num *pi, num *out);
    void *owner;           /* of ask */
    long long evaluations; /* of the field or the lifted field */
};

/* count numbers of scratch, valid until the step ends or dal_release; their values are undefined.
 */
DAL_INLINE num *dal_scratch(dal_step *s, int count)
{
    num *p = s->scratch + s->used;
    s->used += (size_t)count;
    return s->used <= s->room ? p : NULL;
}

/* Declares a scratch vector. */
#define DAL_VECTOR(step, name, count)                                                              \
    num *const name = dal_scratch((step), (count));                                                \
    if (!name) return DAL_MEMORY

/* Where the parts of a state begin. */
DAL_INLINE int dal_at_v(const dal_step *s) { return s->n; }
DAL_INLINE int dal_at_e(const dal_step *s) { return 2 * s->n; }
DAL_INLINE int dal_at_p(const dal_step *s) { return 2 * s->n + 1; }
DAL_INLINE int dal_at_pi(const dal_step *s) { return 3 * s->n + 1; }
DAL_INLINE int dal_at_pi_e(const dal_step *s) { return 4 * s->n + 1; }

/* F(q, v, t), out[nw]; and F, F_q^T pi, F_v^T pi, out[3n]. */
DAL_INLINE void dal_force(dal_step *s, double t, const num *q, const num *v, num *out)
{
    s->evaluations++;
    s->ask(s, DAL_ASK_FIELD, t, q, v, NULL, out);
}
DAL_INLINE void dal_adjoint(dal_step *s, double t, const num *q, const num *v, const num *pi,
                            num *out)
{
    s->evaluations++;
    s->ask(s, DAL_ASK_ADJOINT, t, q, v, pi, out);
}
DAL_INLINE num dal_mu_e(dal_step *s, double t)
{
    num mu;
    s->ask(s, DAL_ASK_GAUGE, t, s->y, s->y + s->n, NULL, &mu);
    return mu;
}

/* |u|^2 / 2 */
DAL_INLINE num dal_half_square(const num *u, int n)
{
    num sum = dal_num(0.0);
    for (int i = 0; i < n; i++) sum += u[i] * u[i];
    return 0.5 * sum;
}

/* pi_e' = |pi/e|^2 / 2, with w = 1/e. */
DAL_INLINE num dal_gauge_rate(const num *pi, int n, num w)
{
    return dal_half_square(pi, n) * (w * w);
}

/* The whole first-order field in the space of the run (theory.md, 2), dy[dim]:
 *     q' = v   v' = F + pi/e   e' = mu_e   p' = -F_q^T pi   pi' = -p - F_v^T pi   pi_e' = pi^2/2e^2
 */
DAL_INLINE dal_status dal_field(dal_step *s, double t, const num *y, num *dy)
{
    const int n = s->n;
    memcpy(dy, y + n, (size_t)n * sizeof *dy);
    if (!s->lifted) {
        dal_force(s, t, y, y + n, dy + n);
        return DAL_OK;
    }
    const size_t mark = s->used;
    DAL_VECTOR(s, f, 3 * n);
    const num *p = y + dal_at_p(s), *pi = y + dal_at_pi(s);
    const num w = 1.0 / y[dal_at_e(s)];
    dal_adjoint(s, t, y, y + n, pi, f);
    for (int i = 0; i < n; i++) {
        dy[n + i] = f[i] + pi[i] * w;
        dy[dal_at_p(s) + i] = -f[n + i];
        dy[dal_at_pi(s) + i] = -p[i] - f[2 * n + i];
    }
    dy[dal_at_e(s)] = dal_mu_e(s, t);
    dy[dal_at_pi_e(s)] = dal_gauge_rate(pi, n, w);
    s->used = mark;
    return DAL_OK;
}

/* y + r += d for count components, compensated; lanes that are no longer alive stay as they are.
 * An infinite e swallows its increment and has no rounding error. */
DAL_INLINE void dal_add(dal_step *s, int first, int count, const num *d)
{
    for (int i = 0; i < count; i++) {
        const num a = s->y[first + i], b = d[i] + s->r[first + i];
        const num sum = a + b, c = sum - a;
        const num error = (a - (sum - c)) + (b - c);
        s->y[first + i] = dal_select(s->alive, sum + 0.0, a);
        s->r[first + i] = dal_select(s->alive & dal_finite(error), error, dal_num(0.0));
    }
}

/* Ends a (sub)step of size h: y + r += d, d[dim], and t += h. */
DAL_INLINE dal_status dal_update(dal_step *s, double h, const num *d)
{
    dal_add(s, 0, s->dim, d);
    s->t += h;
    return DAL_OK;
}

/* A step of size h of the method inside the present modifier. */
DAL_INLINE dal_status dal_inner(dal_step *s, double h)
{
    const size_t mark = s->used;
    const double outer = s->h;
    s->h = h;
    s->depth--;
    const dal_status status = s->chain[s->depth]->step(s);
    s->depth++;
    s->h = outer;
    s->used = mark;
    return status;
}

#endif
