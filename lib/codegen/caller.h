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

static void dal__observe(const dal_stored *work, dal_time t, const num *y, num *out);

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
