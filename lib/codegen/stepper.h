/* stepper.h - steps as transactions, behind the integrator in a generated file.
 *
 * Not compiled here: it travels as text behind the kernel, the system and the integrator, and the
 * word PREFIX becomes the prefix of the file.  Steps go in blocks from the stored state and are
 * stored at a block's end, when all lanes are solved and finite; otherwise the block is done again
 * step by step up to the one that fails.  What makes a lane fail is what lib/run/engine_wide.c
 * says, in the same order.
 *
 * A register full of lanes is a group, and number i of group g is number i * DAL_GROUPS + g of an
 * array.  All groups go forward together, so that a processor which looks ahead works on one while
 * another waits for its results: as one larger system where the method allows it (DAL_JOINED groups
 * to a dal_step), else one step of each after the other (DAL_TEAM of them). */

enum { DAL__BLOCK_STEPS = 64, DAL__ALL = DAL_GROUPS * DAL_LANES };

#define DAL__EACH_MEMBER for (int g = 0; g < DAL_TEAM; g++)

/* Where something of the clock, or the memory, is in the carried array. */
#define DAL__AT(place) (2 * DAL__DIM + (place))

typedef struct dal__clock {
    double time, error; /* compensated */
} dal__clock;

/* Lanes of the groups of one dal_step. */
typedef struct dal__lanes {
    dal_mask group[DAL_JOINED];
} dal__lanes;

/* Lanes that passed each test so far. */
typedef struct dal__verdict {
    dal_status status;
    dal__lanes solved, gauge, finite, regular;
} dal__verdict;

typedef struct dal__team {
    dal_step step[DAL_TEAM];
    dal__lanes lanes[DAL_TEAM]; /* those that go on */
    dal__verdict verdict[DAL_TEAM];
    dal__clock clock;
} dal__team;

/* ---- the stored state ---- */

DAL_INLINE void dal__load_step(dal_step *s, const dal_stored *carried)
{
    DAL_EACH(i, DAL_DIM(s)) s->y[i] = carried[i * DAL_TEAM];
    DAL_EACH(i, DAL_DIM(s)) s->r[i] = carried[DAL__DIM * DAL_GROUPS + i * DAL_TEAM];
    carried += DAL__AT(DAL__MEMORY) * DAL_GROUPS;
#define X(member, count)                                                                           \
    DAL_EACH(i, DAL__COUNT_##count * DAL_JOINED) s->member[i] = carried[i * DAL_TEAM];             \
    carried += DAL__COUNT_##count * DAL_GROUPS;
    DAL__MEMORY_LIST(X)
#undef X
    s->evaluations = 0;
}

/* Number i of those that begin at to becomes value in the lanes of its group. */
DAL_INLINE void dal__put(dal_stored *to, int i, const dal__lanes *lanes, num value)
{
    to += i * DAL_TEAM;
    *to = dal_select(lanes->group[i % DAL_JOINED], value, *to);
}

/* The clock of group j. */
DAL_INLINE void dal__store_clock(const dal_step *s, const dal__clock *clock, long long steps,
                                 const dal__lanes *lanes, int j, dal_stored *to)
{
    const int made = DAL__STEPS * DAL_JOINED + j, asked = DAL__EVALUATIONS * DAL_JOINED + j;
    dal__put(to, DAL__TIME * DAL_JOINED + j, lanes, dal_num(clock->time));
    dal__put(to, DAL__TIME_ERROR * DAL_JOINED + j, lanes, dal_num(clock->error));
    dal__put(to, made, lanes, to[made * DAL_TEAM] + (double)steps);
    dal__put(to, asked, lanes, to[asked * DAL_TEAM] + (double)s->evaluations);
}

DAL_INLINE void dal__store_step(const dal_step *s, const dal__clock *clock, long long steps,
                                const dal__lanes *lanes, dal_stored *carried)
{
    DAL_EACH(i, DAL_DIM(s)) dal__put(carried, i, lanes, s->y[i]);
    DAL_EACH(i, DAL_DIM(s)) dal__put(carried + DAL__DIM * DAL_GROUPS, i, lanes, s->r[i]);
    DAL_EACH(j, DAL_JOINED)
        dal__store_clock(s, clock, steps, lanes, j, carried + DAL__AT(0) * DAL_GROUPS);
    carried += DAL__AT(DAL__MEMORY) * DAL_GROUPS;
#define X(member, count)                                                                           \
    DAL_EACH(i, DAL__COUNT_##count * DAL_JOINED) dal__put(carried, i, lanes, s->member[i]);        \
    carried += DAL__COUNT_##count * DAL_GROUPS;
    DAL__MEMORY_LIST(X)
#undef X
}

/* ---- judging a step, group by group ---- */

/* Lanes in which every component of a group's state is finite; 1/e stands for e. */
DAL_INLINE dal_mask dal__finite_state(const dal_step *s, int group)
{
    num sum = dal_num(0.0);
    DAL_EACH(i, DAL__DIM) {
        const num y = s->y[i * DAL_JOINED + group];
        const num x = dal_choose(DAL__LIFTED && i == 2 * DAL__N, 1.0 / y, y);
        sum += x - x;
    }
    return dal_equal(sum, dal_num(0.0));
}

/* What the system says of a group, before and after the step from y0. */
DAL_INLINE void dal__eval_both_ends(const dal_step *s, int group, dal_callback_code code,
                                    const num *y0, num *before, num *after)
{
    num a[DAL__N + DAL__NW], b[DAL__N + DAL__NW];
    dal__pick(y0, group, DAL__N + DAL__NW, a);
    dal__pick(s->y, group, DAL__N + DAL__NW, b);
    dal__eval_group(s->work + group, code, s->t - s->h, a, a + DAL__N, NULL, before);
    dal__eval_group(s->work + group, code, s->t, b, b + DAL__N, NULL, after);
}

/* The guards of the constraints keep their signs. */
DAL_INLINE dal_mask dal__guards_hold(const dal_step *s, int group, const num *y0)
{
    num before[DAL__ROOM(DAL__GUARDS)], after[DAL__ROOM(DAL__GUARDS)];
    dal_mask good = dal_all();
    dal__eval_both_ends(s, group, DAL_EVAL_GUARDS, y0, before, after);
    DAL_EACH(i, DAL__GUARDS) good &= dal_less(dal_num(0.0), before[i] * after[i]);
    return good;
}

/* No normal turned by a right angle: det(A1 B0) det(A0 B0) > 0 for all leading minors. */
DAL_INLINE dal_mask dal__normals_hold(const dal_step *s, int group, const num *y0)
{
    const int m = DAL__M, n = DAL__N;
    num c0[DAL__ROOM(DAL__M + 2 * DAL__M * DAL__N)], c1[DAL__ROOM(DAL__M + 2 * DAL__M * DAL__N)];
    num g0[DAL__ROOM(DAL__M * DAL__M)], g1[DAL__ROOM(DAL__M * DAL__M)];
    dal_mask good = dal_all();
    dal__eval_both_ends(s, group, DAL_EVAL_CONSTRAINT, y0, c0, c1);
    dal_gram(c0 + m, c0 + m + m * n, m, n, g0);
    dal_gram(c1 + m, c0 + m + m * n, m, n, g1);
    DAL_EACH(k, m)
        good &= dal_less(dal_num(0.0), dal_eliminate(g0, m, k) / dal_eliminate(g1, m, k));
    return good;
}

DAL_INLINE dal_mask dal__gauge_holds(const dal_step *s, int group, const num *y0)
{
    const int at_e = DAL__DIM > 2 * DAL__N ? 2 * DAL__N : 0;
    const num e0 = y0[at_e * DAL_JOINED + group], e = s->y[at_e * DAL_JOINED + group];
    return dal_less(dal_num(0.0), 1.0 / e0 * e) | ~dal_finite(e);
}

/* Whether a lane that goes on has failed, its finiteness apart. */
DAL_INLINE int dal__failed(const dal__verdict *v, const dal__lanes *lanes)
{
    dal_mask bad = ~dal_all();
    DAL_EACH(j, DAL_JOINED)
        bad |= ~(v->solved.group[j] & v->gauge.group[j] & v->regular.group[j]) & lanes->group[j];
    return v->status != DAL_OK || dal_any(bad);
}

/* ---- steps ---- */

DAL_INLINE void dal__tick(dal__clock *clock, double h)
{
    const double a = clock->time, b = h + clock->error, sum = a + b, c = sum - a;
    clock->error = (a - (sum - c)) + (b - c);
    clock->time = sum;
}

/* A step of one member from a time that all share. */
DAL_INLINE void dal__one_step(dal_step *s, double t, double h, const dal__lanes *lanes,
                              dal__verdict *so_far)
{
    num y0[DAL__DIM * DAL_JOINED];
    DAL_EACH(i, DAL_DIM(s)) y0[i] = s->y[i];
    s->t = t;
    s->h = h;
    DAL_EACH(j, DAL_JOINED) s->alive[j] = DAL__EXPLICIT ? dal_all() : lanes->group[j];
    DAL_EACH(j, DAL_JOINED) s->unconverged[j] = ~dal_all();
    const dal_status status = dal__method(s);
    if (status != DAL_OK && status != DAL_NOT_CONVERGED) so_far->status = status;
    DAL_EACH(j, DAL_JOINED) {
        so_far->solved.group[j] &= ~s->unconverged[j];
        if (DAL__LIFTED && DAL__GAUGE) so_far->gauge.group[j] &= dal__gauge_holds(s, j, y0);
        if (DAL__GUARDS) so_far->regular.group[j] &= dal__guards_hold(s, j, y0);
        if (DAL__WATCHED) so_far->regular.group[j] &= dal__normals_hold(s, j, y0);
    }
}

/* Where the state after each step goes, of a single lane: number i of step k to to[i * stride + k],
 * the time as the number behind the last; NULL: nowhere. */
typedef struct dal__trace {
    double *to;
    long long stride;
} dal__trace;

DAL_INLINE void dal__leave_trace(const dal__team *team, const dal__trace *trace, long long k)
{
    const num *y = team->step[0].y;
    DAL_EACH(i, DAL__DIM) trace->to[i * trace->stride + k] = dal_lane(y[i], 0);
    trace->to[DAL__DIM * trace->stride + k] = team->clock.time;
}

/* Up to count steps, until one lane fails; the number that all lanes made. */
DAL_INLINE long long dal__block(dal__team *team, double h, long long count, const dal__trace *trace)
{
    for (long long k = 0; k < count; k++) {
        int failed = 0;
        DAL__EACH_MEMBER
        {
            dal__verdict *verdict = &team->verdict[g];
            dal__one_step(&team->step[g], team->clock.time, h, &team->lanes[g], verdict);
            failed |= dal__failed(verdict, &team->lanes[g]);
        }
        dal__tick(&team->clock, h);
        if (failed) return k;
        if (DAL__TRACED && trace->to) dal__leave_trace(team, trace, k);
    }
    return count;
}

/* ---- blocks of steps ---- */

DAL_INLINE dal_mask dal__mask_of(unsigned lanes)
{
    dal_mask mask = ~dal_all();
    for (int i = 0; i < DAL_LANES; i++)
        if (lanes >> i & 1) mask |= dal_lane_mask(i);
    return mask;
}

/* Those of member g. */
DAL_INLINE dal__lanes dal__lanes_of(unsigned lanes, int g)
{
    dal__lanes these;
    DAL_EACH(j, DAL_JOINED) these.group[j] = dal__mask_of(lanes >> ((g + j) * DAL_LANES));
    return these;
}

DAL_INLINE void dal__load_team(dal__team *team, const dal_stored *carried, const double *work,
                               unsigned lanes)
{
    const dal__lanes all = dal__lanes_of(~0u, 0);
    const dal__verdict good = {DAL_OK, all, all, all, all};
    const double *const number = (const double *)carried;
    int first = 0;
    while (first < DAL__ALL - 1 && !(lanes >> first & 1)) first++;
    team->clock.time = number[DAL__AT(DAL__TIME) * DAL__ALL + first];
    team->clock.error = number[DAL__AT(DAL__TIME_ERROR) * DAL__ALL + first];
    DAL__EACH_MEMBER
    {
        team->step[g].work = (const dal_stored *)work + g;
        team->lanes[g] = dal__lanes_of(lanes, g);
        team->verdict[g] = good;
        dal__load_step(&team->step[g], carried + g);
    }
}

DAL_INLINE void dal__store_team(const dal__team *team, long long steps, unsigned lanes,
                                dal_stored *carried)
{
    DAL__EACH_MEMBER
    {
        const dal__lanes these = dal__lanes_of(lanes, g);
        dal__store_step(&team->step[g], &team->clock, steps, &these, carried + g);
    }
}

/* Whether a lane that goes on is not finite. */
DAL_INLINE int dal__look_at_states(dal__team *team)
{
    dal_mask bad = ~dal_all();
    DAL__EACH_MEMBER
    DAL_EACH(j, DAL_JOINED) {
        const dal_mask finite = dal__finite_state(&team->step[g], j);
        team->verdict[g].finite.group[j] = finite;
        bad |= ~finite & team->lanes[g].group[j];
    }
    return dal_any(bad);
}

/* Why each failing lane failed; the mask of those that did. */
DAL_COLD unsigned dal__judge(const dal__team *team, unsigned lanes, int *why)
{
    unsigned failed = 0;
    for (int i = 0; i < DAL__ALL; i++) {
        const int group = i / DAL_LANES, lane = i % DAL_LANES, j = group % DAL_JOINED;
        const dal__verdict *verdict = &team->verdict[group / DAL_JOINED];
        int status = DAL_OK;
        if (!dal_mask_lane(verdict->regular.group[j], lane)) status = DAL_SINGULAR;
        if (!dal_mask_lane(verdict->finite.group[j], lane)) status = DAL_NOT_FINITE;
        if (!dal_mask_lane(verdict->gauge.group[j], lane)) status = DAL_GAUGE;
        if (!dal_mask_lane(verdict->solved.group[j], lane)) status = DAL_NOT_CONVERGED;
        if (verdict->status != DAL_OK) status = verdict->status;
        if (status == DAL_OK || !(lanes >> i & 1)) continue;
        failed |= 1u << i;
        why[i] = status;
    }
    return failed;
}

DAL_INLINE long long dal__take_steps(double *carried_, const double *work, double h,
                                     long long count, unsigned lanes, unsigned *failed, int *why,
                                     dal__trace trace)
{
    dal_stored *const carried = (dal_stored *)carried_;
    long long done = 0, most = DAL__BLOCK_STEPS;
    *failed = 0;
    while (done < count && lanes) {
        const long long block = count - done < most ? count - done : most;
        dal__team team;
        dal__load_team(&team, carried, work, lanes);
        const long long made = dal__block(&team, h, block, &trace);
        const int unsound = dal__look_at_states(&team);
        if (made == block && !unsound) {
            dal__store_team(&team, block, lanes, carried);
            done += block;
            if (trace.to) trace.to += block;
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

#if DAL__TRACED
long long PREFIX_traced(double *carried, const double *work, double h, long long count,
                        unsigned *failed, int *why, double *to, long long stride)
{
    const dal__trace trace = {to, stride};
    return dal__take_steps(carried, work, h, count, 1u, failed, why, trace);
}
#else
long long PREFIX_lanes(double *carried, const double *work, double h, long long count,
                       unsigned lanes, unsigned *failed, int *why)
{
    const dal__trace nowhere = {0, 0};
    return dal__take_steps(carried, work, h, count, lanes, failed, why, nowhere);
}
#endif
