/* caller.h - the end of a generated file: what a caller sees; travels as text like stepper.h. */

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
    dal__hoist((dal_stored *)state->work + lane / DAL_LANES);
}

int PREFIX_start_lane(PREFIX_state *state, int lane, const PREFIX_parameters *parameters)
{
    num y[DAL__DIM];
    PREFIX_set(state, lane, parameters);
    dal__start((const dal_stored *)state->work + lane / DAL_LANES, y);
    for (int i = 0; i < PREFIX_CARRIED; i++) state->y[i * PREFIX_LANES + lane] = 0.0;
    state->status[lane] = DAL_OK;
    for (int i = 0; i < DAL__DIM; i++) {
        const double x = dal_lane(y[i], lane % DAL_LANES);
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
DAL_INLINE num dal__hamiltonian(const num *y, const num *f, num mu)
{
    const int n = DAL__N, e = DAL__LIFTED ? 2 * n : 0;
    const num *v = y + n, *p = y + e + DAL__LIFTED, *pi = p + DAL__LIFTED * n;
    num sum = dal_num(0.0);
    for (int i = 0; i < n; i++) sum += pi[i] * pi[i] * (0.5 / y[e]) + pi[i] * f[i] + p[i] * v[i];
    return sum + mu * y[DAL__DIM - 1];
}

/* H and the max norms of p, pi, pi_e. */
DAL_INLINE void dal__observe_lift(const dal_stored *work, double t, const num *y, num *out)
{
    const int n = DAL__N, e = DAL__LIFTED ? 2 * n : 0;
    num f[DAL__NW], mu;
    dal__ask_group(work, DAL_ASK_FIELD, t, y, y + n, NULL, f);
    dal__ask_group(work, DAL_ASK_GAUGE, t, y, y + n, NULL, &mu);
    out[0] = dal__hamiltonian(y, f, mu);
    out[1] = out[2] = dal_num(0.0);
    for (int i = 0; i < n; i++) {
        out[1] = dal_max(out[1], dal_abs(y[e + DAL__LIFTED + i]));
        out[2] = dal_max(out[2], dal_abs(y[e + DAL__LIFTED * (n + 1) + i]));
    }
    out[3] = dal_abs(y[DAL__DIM - 1]);
}

static void dal__observe(const dal_stored *work, double t, const num *y, num *out);

void PREFIX_observe(const PREFIX_state *state, double *out)
{
    for (int g = 0; g < DAL_GROUPS; g++) {
        num y[DAL__DIM], value[DAL__ROOM(PREFIX_OBSERVABLES)];
        const dal_stored *from = (const dal_stored *)state->y + g;
        for (int i = 0; i < DAL__DIM; i++) y[i] = from[i * DAL_GROUPS];
        dal__observe((const dal_stored *)state->work + g, PREFIX_time(state, 0), y, value);
        for (int i = 0; i < PREFIX_OBSERVABLES; i++)
            for (int lane = 0; lane < DAL_LANES; lane++)
                out[i * PREFIX_LANES + g * DAL_LANES + lane] = dal_lane(value[i], lane) + 0.0;
    }
}
