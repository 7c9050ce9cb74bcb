/* stepper.h - steps as transactions, behind the integrator in a generated file.
 *
 * Not compiled here: it travels as text behind the kernel, the system and the integrator, and the
 * word PREFIX becomes the prefix of the file.  Steps go in blocks from the stored state and are
 * stored at a block's end, when all lanes are solved and finite; otherwise the block is done again
 * step by step up to the one that fails.  What makes a lane fail is what lib/run/engine_wide.c
 * says, in the same order.
 *
 * More lanes than a register holds go group by group within each step: a processor that looks ahead
 * then works on one group while the other waits for its results.  Number i of group g is number
 * i * DAL_GROUPS + g of an array. */

enum { DAL__BLOCK_STEPS = 64 };

#define DAL__EACH_GROUP for (int g = 0; g < DAL_GROUPS; g++)

/* Where something of the clock, or the memory, is in the carried array. */
#define DAL__AT(place) (2 * DAL__DIM + (place))

typedef struct dal__clock {
    double time, error; /* compensated */
} dal__clock;

/* Lanes that passed each test so far. */
typedef struct dal__verdict {
    dal_status status;
    dal_mask solved, gauge, finite, regular;
} dal__verdict;

/* The steps of all groups. */
typedef struct dal__team {
    dal_step step[DAL_GROUPS];
    dal_mask lanes[DAL_GROUPS]; /* those that go on */
    dal__verdict verdict[DAL_GROUPS];
    dal__clock clock;
} dal__team;

DAL_INLINE void dal__load_step(dal_step *s, const dal_stored *carried)
{
    DAL_EACH(i, DAL__DIM) s->y[i] = carried[i * DAL_GROUPS];
    DAL_EACH(i, DAL__DIM) s->r[i] = carried[(DAL__DIM + i) * DAL_GROUPS];
    carried += DAL__AT(DAL__MEMORY) * DAL_GROUPS;
#define X(member, count)                                                                           \
    DAL_EACH(i, DAL__COUNT_##count) s->member[i] = carried[i * DAL_GROUPS];                        \
    carried += DAL__COUNT_##count * DAL_GROUPS;
    DAL__MEMORY_LIST(X)
#undef X
    s->evaluations = 0;
}

DAL_INLINE void dal__put(dal_stored *to, dal_mask lanes, num value)
{
    *to = dal_select(lanes, value, *to);
}

DAL_INLINE void dal__store_step(const dal_step *s, const dal__clock *clock, long long steps,
                                dal_mask lanes, dal_stored *carried)
{
    dal_stored *rest = carried + DAL__AT(0) * DAL_GROUPS;
    dal_stored *const counted = rest + DAL__STEPS * DAL_GROUPS;
    dal_stored *const asked = rest + DAL__EVALUATIONS * DAL_GROUPS;
    DAL_EACH(i, DAL__DIM) dal__put(carried + i * DAL_GROUPS, lanes, s->y[i]);
    DAL_EACH(i, DAL__DIM) dal__put(carried + (DAL__DIM + i) * DAL_GROUPS, lanes, s->r[i]);
    dal__put(rest + DAL__TIME * DAL_GROUPS, lanes, dal_num(clock->time));
    dal__put(rest + DAL__TIME_ERROR * DAL_GROUPS, lanes, dal_num(clock->error));
    dal__put(counted, lanes, *counted + (double)steps);
    dal__put(asked, lanes, *asked + (double)s->evaluations);
    rest += DAL__MEMORY * DAL_GROUPS;
#define X(member, count)                                                                           \
    DAL_EACH(i, DAL__COUNT_##count) dal__put(rest + i * DAL_GROUPS, lanes, s->member[i]);          \
    rest += DAL__COUNT_##count * DAL_GROUPS;
    DAL__MEMORY_LIST(X)
#undef X
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

DAL_INLINE dal_mask dal__mask_of(unsigned lanes)
{
    dal_mask mask = ~dal_all();
    for (int i = 0; i < DAL_LANES; i++)
        if (lanes >> i & 1) mask |= dal_lane_mask(i);
    return mask;
}

/* A step of one group from a time that all share. */
DAL_INLINE void dal__one_step(dal_step *s, double t, double h, dal_mask lanes, dal__verdict *so_far)
{
    num y0[DAL__DIM];
    DAL_EACH(i, DAL__DIM) y0[i] = s->y[i];
    s->t = t;
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
}

/* Whether a lane that goes on has failed, its finiteness apart. */
DAL_INLINE int dal__failed(const dal__verdict *v, dal_mask lanes)
{
    return v->status != DAL_OK || dal_any(~(v->solved & v->gauge & v->regular) & lanes);
}

/* Up to count steps, until one lane fails; the number that all lanes made. */
DAL_INLINE long long dal__block(dal__team *team, double h, long long count)
{
    for (long long k = 0; k < count; k++) {
        int failed = 0;
        DAL__EACH_GROUP
        {
            dal__verdict *verdict = &team->verdict[g];
            dal__one_step(&team->step[g], team->clock.time, h, team->lanes[g], verdict);
            failed |= dal__failed(verdict, team->lanes[g]);
        }
        dal__tick(&team->clock, h);
        if (failed) return k;
    }
    return count;
}

/* The state of all groups, before the next block. */
DAL_INLINE void dal__load_team(dal__team *team, const dal_stored *carried, const double *work,
                               unsigned lanes)
{
    const dal__verdict good = {DAL_OK, dal_all(), dal_all(), dal_all(), dal_all()};
    const double *const number = (const double *)carried;
    int first = 0;
    while (first < PREFIX_LANES - 1 && !(lanes >> first & 1)) first++;
    team->clock.time = number[DAL__AT(DAL__TIME) * PREFIX_LANES + first];
    team->clock.error = number[DAL__AT(DAL__TIME_ERROR) * PREFIX_LANES + first];
    DAL__EACH_GROUP
    {
        team->step[g].work = (const dal_stored *)work + g;
        team->lanes[g] = dal__mask_of(lanes >> (g * DAL_LANES));
        team->verdict[g] = good;
        dal__load_step(&team->step[g], carried + g);
    }
}

/* Whether a lane that goes on is not finite. */
DAL_INLINE int dal__look_at_states(dal__team *team)
{
    int failed = 0;
    DAL__EACH_GROUP
    {
        team->verdict[g].finite = dal__finite_state(&team->step[g]);
        failed |= dal_any(~team->verdict[g].finite & team->lanes[g]);
    }
    return failed;
}

DAL_INLINE void dal__store_team(const dal__team *team, long long steps, unsigned lanes,
                                dal_stored *carried)
{
    DAL__EACH_GROUP
    dal__store_step(&team->step[g], &team->clock, steps, dal__mask_of(lanes >> (g * DAL_LANES)),
                    carried + g);
}

/* Why each failing lane failed; the mask of those that did. */
DAL_COLD unsigned dal__judge(const dal__team *team, unsigned lanes, int *why)
{
    unsigned failed = 0;
    for (int i = 0; i < PREFIX_LANES; i++) {
        const dal__verdict *verdict = &team->verdict[i / DAL_LANES];
        const int lane = i % DAL_LANES;
        int status = DAL_OK;
        if (!dal_mask_lane(verdict->regular, lane)) status = DAL_SINGULAR;
        if (!dal_mask_lane(verdict->finite, lane)) status = DAL_NOT_FINITE;
        if (!dal_mask_lane(verdict->gauge, lane)) status = DAL_GAUGE;
        if (!dal_mask_lane(verdict->solved, lane)) status = DAL_NOT_CONVERGED;
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
    long long done = 0, most = DAL__BLOCK_STEPS;
    *failed = 0;
    while (done < count && lanes) {
        const long long block = count - done < most ? count - done : most;
        dal__team team;
        dal__load_team(&team, carried, work, lanes);
        const long long made = dal__block(&team, h, block);
        const int unsound = dal__look_at_states(&team);
        if (made == block && !unsound) {
            dal__store_team(&team, block, lanes, carried);
            done += block;
        } else if (block > 1) {
            most = 1;
        } else {
            *failed = dal__judge(&team, lanes, why);
            dal__store_team(&team, 1, lanes & ~*failed, carried);
            return done + 1;
        }
    }
    return done;
}
