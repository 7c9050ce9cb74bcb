/* stepper.h - the end of a generated file: steps as transactions, start and observables.
 *
 * Not compiled here: it travels as text behind the kernel, the system and the integrator, and the
 * word PREFIX becomes the prefix of the file.  Steps go in blocks from the stored state and are
 * stored at a block's end, when all lanes are solved and finite; otherwise the block is done again
 * step by step up to the one that fails.  What makes a lane fail is what lib/run/engine_wide.c
 * says, in the same order. */

enum { DAL__BLOCK_STEPS = 64 };

/* Numbers behind y and r in what a step carries along. */
enum {
    DAL__TIME,
    DAL__TIME_ERROR,
    DAL__STEPS,
    DAL__EVALUATIONS,
    DAL__STIFF,
    DAL__SLOPES_H,
    DAL__FIRST_SLOPE
};
#define DAL__AT(place) (2 * DAL__DIM + (place))

typedef struct dal__clock {
    double time, error; /* compensated */
} dal__clock;

/* Lanes that passed each test so far. */
typedef struct dal__verdict {
    dal_status status;
    dal_mask solved, gauge, regular;
} dal__verdict;

DAL_INLINE void dal__load_step(dal_step *s, const dal_stored *carried)
{
    DAL_EACH(i, DAL__DIM) s->y[i] = carried[i];
    DAL_EACH(i, DAL__DIM) s->r[i] = carried[DAL__DIM + i];
    DAL_EACH(i, DAL__SLOPES) s->slopes[i] = carried[DAL__AT(DAL__FIRST_SLOPE) + i];
    s->stiff[0] = carried[DAL__AT(DAL__STIFF)];
    s->slopes_h[0] = carried[DAL__AT(DAL__SLOPES_H)];
    s->evaluations = 0;
}

DAL_INLINE void dal__put(dal_stored *to, dal_mask lanes, num value)
{
    *to = dal_select(lanes, value, *to);
}

DAL_INLINE void dal__store_step(const dal_step *s, const dal__clock *clock, long long steps,
                                dal_mask lanes, dal_stored *carried)
{
    dal_stored *rest = carried + DAL__AT(0);
    DAL_EACH(i, DAL__DIM) dal__put(carried + i, lanes, s->y[i]);
    DAL_EACH(i, DAL__DIM) dal__put(carried + DAL__DIM + i, lanes, s->r[i]);
    DAL_EACH(i, DAL__SLOPES) dal__put(rest + DAL__FIRST_SLOPE + i, lanes, s->slopes[i]);
    dal__put(rest + DAL__STIFF, lanes, s->stiff[0]);
    dal__put(rest + DAL__SLOPES_H, lanes, s->slopes_h[0]);
    dal__put(rest + DAL__TIME, lanes, dal_num(clock->time));
    dal__put(rest + DAL__TIME_ERROR, lanes, dal_num(clock->error));
    dal__put(rest + DAL__STEPS, lanes, rest[DAL__STEPS] + (double)steps);
    dal__put(rest + DAL__EVALUATIONS, lanes, rest[DAL__EVALUATIONS] + (double)s->evaluations);
}

/* Lanes in which every component of the state is finite; 1/e stands for e. */
DAL_INLINE dal_mask dal__finite_state(const dal_step *s)
{
    num sum = dal_num(0.0);
    DAL_EACH(i, DAL__DIM) {
        const num x = dal_choose(DAL__LIFTED && i == 2 * DAL__N, 1.0 / s->y[i], s->y[i]);
        sum += x - x;
    }
    return dal_equal(sum, dal_num(0.0));
}

/* The guards of the constraints keep their signs over the step from y0. */
DAL_INLINE dal_mask dal__guards_hold(dal_step *s, const num *y0)
{
    num before[DAL__ROOM(DAL__GUARDS)], after[DAL__ROOM(DAL__GUARDS)];
    dal_mask good = dal_all();
    dal_ask(s, DAL_ASK_GUARDS, s->t - s->h, y0, y0 + DAL__N, NULL, before);
    dal_ask(s, DAL_ASK_GUARDS, s->t, s->y, s->y + DAL__N, NULL, after);
    DAL_EACH(i, DAL__GUARDS) good &= dal_less(dal_num(0.0), before[i] * after[i]);
    return good;
}

/* No normal turned by a right angle: det(A1 B0) det(A0 B0) > 0 for all leading minors. */
DAL_INLINE dal_mask dal__normals_hold(dal_step *s, const num *y0)
{
    const int m = DAL__M, n = DAL__N;
    num c0[DAL__ROOM(DAL__M + 2 * DAL__M * DAL__N)], c1[DAL__ROOM(DAL__M + 2 * DAL__M * DAL__N)];
    num g0[DAL__ROOM(DAL__M * DAL__M)], g1[DAL__ROOM(DAL__M * DAL__M)];
    dal_mask good = dal_all();
    dal_ask(s, DAL_ASK_CONSTRAINT, s->t - s->h, y0, y0 + n, NULL, c0);
    dal_ask(s, DAL_ASK_CONSTRAINT, s->t, s->y, s->y + n, NULL, c1);
    dal_gram(c0 + m, c0 + m + m * n, m, n, g0);
    dal_gram(c1 + m, c0 + m + m * n, m, n, g1);
    DAL_EACH(k, m)
        good &= dal_less(dal_num(0.0), dal_eliminate(g0, m, k) / dal_eliminate(g1, m, k));
    return good;
}

DAL_INLINE void dal__tick(dal__clock *clock, double h)
{
    const double a = clock->time, b = h + clock->error, sum = a + b, c = sum - a;
    clock->error = (a - (sum - c)) + (b - c);
    clock->time = sum;
}

DAL_INLINE void dal__one_step(dal_step *s, dal__clock *clock, double h, dal_mask lanes,
                              dal__verdict *so_far)
{
    num y0[DAL__DIM];
    DAL_EACH(i, DAL__DIM) y0[i] = s->y[i];
    s->t = clock->time;
    s->h = h;
    s->alive = DAL__EXPLICIT ? dal_all() : lanes;
    s->unconverged = ~dal_all();
    const dal_status status = dal__method(s);
    if (status != DAL_OK && status != DAL_NOT_CONVERGED) so_far->status = status;
    so_far->solved &= ~s->unconverged;
    if (DAL__LIFTED && DAL__GAUGE) {
        const num e = s->y[DAL__DIM > 2 * DAL__N ? 2 * DAL__N : 0];
        const num e0 = y0[DAL__DIM > 2 * DAL__N ? 2 * DAL__N : 0];
        so_far->gauge &= dal_less(dal_num(0.0), 1.0 / e0 * e) | ~dal_finite(e);
    }
    if (DAL__GUARDS) so_far->regular &= dal__guards_hold(s, y0);
    if (DAL__WATCHED) so_far->regular &= dal__normals_hold(s, y0);
    dal__tick(clock, h);
}

DAL_INLINE dal_mask dal__mask_of(unsigned lanes)
{
    dal_mask mask = ~dal_all();
    for (int i = 0; i < DAL_LANES; i++)
        if (lanes >> i & 1) mask |= dal_lane_mask(i);
    return mask;
}

/* Up to count steps, until one lane fails; the number that all lanes made. */
DAL_INLINE long long dal__block(dal_step *s, dal__clock *clock, double h, long long count,
                                dal_mask lanes, dal__verdict *verdict)
{
    const dal__verdict good = {DAL_OK, dal_all(), dal_all(), dal_all()};
    *verdict = good;
    for (long long k = 0; k < count; k++) {
        dal__one_step(s, clock, h, lanes, verdict);
        const dal_mask bad = ~(verdict->solved & verdict->gauge & verdict->regular);
        if (verdict->status != DAL_OK || dal_any(bad & lanes)) return k;
    }
    return count;
}

/* Why each failing lane failed; the mask of those that did. */
DAL_COLD unsigned dal__judge(const dal__verdict *verdict, dal_mask finite, unsigned lanes, int *why)
{
    unsigned failed = 0;
    for (int i = 0; i < DAL_LANES; i++) {
        int status = DAL_OK;
        if (!dal_mask_lane(verdict->regular, i)) status = DAL_SINGULAR;
        if (!dal_mask_lane(finite, i)) status = DAL_NOT_FINITE;
        if (!dal_mask_lane(verdict->gauge, i)) status = DAL_GAUGE;
        if (!dal_mask_lane(verdict->solved, i)) status = DAL_NOT_CONVERGED;
        if (verdict->status != DAL_OK) status = verdict->status;
        if (status == DAL_OK || !(lanes >> i & 1)) continue;
        failed |= 1u << i;
        why[i] = status;
    }
    return failed;
}

long long PREFIX_lanes(double *carried_, const double *work, double h, long long count,
                       unsigned lanes, unsigned *failed, int *why)
{
    dal_stored *const carried = (dal_stored *)carried_;
    const dal_mask alive = dal__mask_of(lanes);
    long long done = 0, most = DAL__BLOCK_STEPS;
    int first = 0;
    while (first < DAL_LANES - 1 && !(lanes >> first & 1)) first++;
    *failed = 0;
    while (done < count && lanes) {
        const long long block = count - done < most ? count - done : most;
        dal_step s;
        dal__verdict verdict;
        dal__clock clock = {dal_lane(carried[DAL__AT(DAL__TIME)], first),
                            dal_lane(carried[DAL__AT(DAL__TIME_ERROR)], first)};
        s.work = (const dal_stored *)work;
        dal__load_step(&s, carried);
        const long long made = dal__block(&s, &clock, h, block, alive, &verdict);
        const dal_mask finite = dal__finite_state(&s);
        if (made == block && !dal_any(~finite & alive)) {
            dal__store_step(&s, &clock, block, alive, carried);
            done += block;
        } else if (block > 1) {
            most = 1;
        } else {
            *failed = dal__judge(&verdict, finite, lanes, why);
            dal__store_step(&s, &clock, 1, dal__mask_of(lanes & ~*failed), carried);
            return done + 1;
        }
    }
    return done;
}

/* ---- what a caller sees -------------------------------------------------------------------- */

int PREFIX_advance(PREFIX_state *state, double h, long long count)
{
    unsigned lanes = 0, failed = 0;
    int status = DAL_OK;
    for (int i = 0; i < PREFIX_LANES; i++) {
        if (PREFIX_LANES == 1) state->status[i] = DAL_OK;
        if (state->status[i] == DAL_OK) lanes |= 1u << i;
    }
    while (count > 0 && lanes) {
        count -= PREFIX_lanes(state->y, state->work, h, count, lanes, &failed, state->status);
        lanes &= ~failed;
    }
    for (int i = 0; i < PREFIX_LANES; i++)
        if (state->status[i] != DAL_OK) status = state->status[i];
    return lanes ? DAL_OK : status;
}

int PREFIX_step(PREFIX_state *state, double h) { return PREFIX_advance(state, h, 1); }

double PREFIX_time(const PREFIX_state *state, int lane)
{
    return state->y[DAL__AT(DAL__TIME) * PREFIX_LANES + lane];
}

void PREFIX_set(PREFIX_state *state, int lane, const PREFIX_parameters *parameters)
{
    const double *value = (const double *)parameters;
    for (int i = 0; i < PREFIX_PARAMETERS; i++) state->work[i * PREFIX_LANES + lane] = value[i];
    dal__hoist((dal_stored *)state->work);
}

int PREFIX_start_lane(PREFIX_state *state, int lane, const PREFIX_parameters *parameters)
{
    num y[DAL__DIM];
    PREFIX_set(state, lane, parameters);
    dal__start((const dal_stored *)state->work, y);
    for (int i = 0; i < PREFIX_CARRIED; i++) state->y[i * PREFIX_LANES + lane] = 0.0;
    state->status[lane] = DAL_OK;
    for (int i = 0; i < DAL__DIM; i++) {
        const double x = dal_lane(y[i], lane);
        const int is_e = DAL__LIFTED && i == 2 * DAL__N;
        if (x != x || (!is_e && x - x != 0.0)) state->status[lane] = DAL_NOT_FINITE;
        state->y[i * PREFIX_LANES + lane] = x + 0.0;
    }
    return state->status[lane];
}

int PREFIX_start(PREFIX_state *state, const PREFIX_parameters *parameters)
{
    const PREFIX_parameters used = parameters ? *parameters : PREFIX_defaults();
    int status = DAL_OK;
    for (int i = 0; i < PREFIX_WORK * PREFIX_LANES; i++) state->work[i] = 0.0;
    for (int i = 0; i < PREFIX_LANES; i++) PREFIX_set(state, i, &used);
    for (int i = 0; i < PREFIX_LANES; i++) {
        const int one = PREFIX_start_lane(state, i, &used);
        if (one != DAL_OK) status = one;
    }
    return status;
}

/* H = pi.pi/(2e) + pi.F + p.v + mu_e pi_e */
DAL_INLINE num dal__hamiltonian(const dal_step *s, const num *f, num mu)
{
    const int n = DAL__N, e = DAL__LIFTED ? 2 * n : 0;
    const num *v = s->y + n, *p = s->y + e + DAL__LIFTED, *pi = p + DAL__LIFTED * n;
    num sum = dal_num(0.0);
    for (int i = 0; i < n; i++) sum += pi[i] * pi[i] * (0.5 / s->y[e]) + pi[i] * f[i] + p[i] * v[i];
    return sum + mu * s->y[DAL__DIM - 1];
}

/* H and the max norms of p, pi, pi_e. */
DAL_INLINE void dal__observe_lift(dal_step *s, double t, num *out)
{
    const int n = DAL__N, e = DAL__LIFTED ? 2 * n : 0;
    num f[DAL__NW], mu;
    dal_ask(s, DAL_ASK_FIELD, t, s->y, s->y + n, NULL, f);
    dal_ask(s, DAL_ASK_GAUGE, t, s->y, s->y + n, NULL, &mu);
    out[0] = dal__hamiltonian(s, f, mu);
    out[1] = out[2] = dal_num(0.0);
    for (int i = 0; i < n; i++) {
        out[1] = dal_max(out[1], dal_abs(s->y[e + DAL__LIFTED + i]));
        out[2] = dal_max(out[2], dal_abs(s->y[e + DAL__LIFTED * (n + 1) + i]));
    }
    out[3] = dal_abs(s->y[DAL__DIM - 1]);
}

static void dal__observe(dal_step *s, double t, num *out);

void PREFIX_observe(const PREFIX_state *state, double *out)
{
    dal_step s;
    num value[DAL__ROOM(PREFIX_OBSERVABLES)];
    const double t = PREFIX_time(state, 0);
    s.work = (const dal_stored *)state->work;
    dal__load_step(&s, (const dal_stored *)state->y);
    dal__observe(&s, t, value);
    for (int i = 0; i < PREFIX_OBSERVABLES; i++)
        for (int lane = 0; lane < PREFIX_LANES; lane++)
            out[i * PREFIX_LANES + lane] = dal_lane(value[i], lane) + 0.0;
}
