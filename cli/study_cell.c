/* study_cell.c - one cell of a study: a run, its statistics and its tracks.
 *
 * Rows are taken after whole numbers of steps, round(k N/S) of N steps for row k of S, so that the
 * trajectory is that of the steps alone. */
#include "study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Steps between two looks at the flag of interruption. */
enum { CHUNK = 1000 };

typedef struct walk {
    study_cell *cell;
    dal_run *run;
    int (*stop)(void);
    int n, m;
    int energy, hamiltonian, momenta, invariants, error; /* places among the observables, or -1 */
    double *values, *first;                              /* [observables] */
    dal_statistics *statistics;                          /* [observables] */
    long long total, samples;                            /* steps and rows behind the first */
} walk;

/* ---- making the run ---- */

/* p_i = d, -d/2, d/3, ... and pi_i = d/2, -d/3, ...: no two alike, and not along the motion. */
static void displace(int n, double size, double *state)
{
    for (int i = 0; i < n; i++) {
        double sign = i % 2 ? -1.0 : 1.0;
        state[2 * n + 1 + i] = sign * size / (i + 1);
        state[3 * n + 1 + i] = sign * size / (i + 2);
    }
}

static dal_status displace_run(walk *w)
{
    const study_cell *c = w->cell;
    size_t size = (size_t)dal_run_dimension(w->run) * sizeof(double);
    if (c->start != STUDY_DISPLACED || c->entry->displace_count > 0) return DAL_OK;
    double *state = malloc(size);
    if (!state) return DAL_MEMORY;
    memcpy(state, dal_run_state(w->run), size);
    displace(w->n, c->entry->displacement, state);
    dal_status status = dal_run_set_state(w->run, 0.0, state, &w->cell->error);
    free(state);
    return status;
}

/* The start of the entry and, where it is displaced, the momenta by name; NULL: out of memory. */
static dal_setting *start_settings(const study_cell *c, int *count)
{
    const study_entry *e = c->entry;
    int displaced = c->start == STUDY_DISPLACED ? e->displace_count : 0;
    dal_setting *list = calloc((size_t)e->start_count + (size_t)displaced + 1, sizeof *list);
    *count = 0;
    for (int i = 0; list && i < e->start_count; i++) list[(*count)++] = e->start[i];
    for (int i = 0; list && i < displaced; i++)
        list[(*count)++] =
            (dal_setting){e->displace[i].name, e->displace[i].value * e->displacement};
    return list;
}

static dal_options options_of(const study_entry *e)
{
    dal_options options = dal_options_default();
    for (int i = 0; i < STUDY_OPTIONS; i++)
        if (e->option[i]) dal_options_set(&options, study_option_word(i), e->option[i], NULL);
    return options;
}

static dal_status make_run(walk *w)
{
    static const dal_space space[] = {
#define X(code, word, kind, about) kind,
        STUDY_START_LIST(X)
#undef X
    };
    const study_entry *e = w->cell->entry;
    dal_run_spec spec = {.system = e->system,
                         .method = *w->cell->method,
                         .options = options_of(e),
                         .parameters = e->set,
                         .parameter_count = e->set_count};
    dal_setting *start = start_settings(w->cell, &spec.start_count);
    if (!start) return DAL_MEMORY;
    spec.start = start;
    spec.options.step = w->cell->step;
    spec.options.space = space[w->cell->start];
    dal_status status = dal_run_create(&w->run, &spec, &w->cell->error);
    free(start);
    if (status == DAL_OK) native_use(w->run, w->cell->method, e->time / w->cell->step, e->native);
    return status == DAL_OK ? displace_run(w) : status;
}

/* ---- memory and places ---- */

static int find(const study_cell *c, const char *name)
{
    for (int i = 0; i < c->observables; i++)
        if (strcmp(c->names[i], name) == 0) return i;
    return -1;
}

static dal_status make_memory(walk *w)
{
    study_cell *c = w->cell;
    size_t count = (size_t)(c->observables = dal_run_observables(w->run));
    c->finding = calloc(count + 1, sizeof *c->finding);
    w->statistics = calloc(count + 1, sizeof *w->statistics);
    c->names = calloc(count + 1, sizeof *c->names);
    c->windows = calloc(STUDY_WINDOWS, sizeof *c->windows);
    w->values = calloc(2 * count + 1, sizeof *w->values);
    if (!c->finding || !w->statistics || !c->names || !c->windows || !w->values) return DAL_MEMORY;
    w->first = w->values + count;
    for (int i = 0; i < c->observables; i++)
        dal_run_observable_name(w->run, i, c->names[i], sizeof c->names[i]);
    w->energy = find(c, "E");
    w->hamiltonian = find(c, "H");
    w->momenta = find(c, "|p|");
    w->error = find(c, "error");
    w->invariants = c->observables - c->entry->system->invariants - (w->error >= 0);
    return DAL_OK;
}

/* ---- rows ---- */

static void raise_to(double *most, double x)
{
    if (!(x <= *most)) *most = isnan(x) ? INFINITY : x;
}

static void track(const walk *w, double *most)
{
    const double *x = w->values, *first = w->first;
    for (int a = 0; a < w->m; a++) raise_to(&most[STUDY_TRACK_D], fabs(x[a]));
    if (w->energy >= 0) raise_to(&most[STUDY_TRACK_E], fabs(x[w->energy] - first[w->energy]));
    if (w->hamiltonian >= 0)
        raise_to(&most[STUDY_TRACK_H], fabs(x[w->hamiltonian] - first[w->hamiltonian]));
    if (w->momenta >= 0) {
        raise_to(&most[STUDY_TRACK_P], x[w->momenta]);
        raise_to(&most[STUDY_TRACK_PI], x[w->momenta + 1]);
    }
    for (int i = w->invariants; i < w->invariants + w->cell->entry->system->invariants; i++)
        raise_to(&most[STUDY_TRACK_INVARIANTS], fabs(x[i] - first[i]) / fmax(1.0, fabs(first[i])));
    if (w->error >= 0) raise_to(&most[STUDY_TRACK_ERROR], x[w->error]);
}

/* FNV-1a over the bytes of (q,v). */
static void hash_state(walk *w)
{
    const unsigned char *bytes = (const unsigned char *)dal_run_state(w->run);
    size_t count = 2 * (size_t)w->n * sizeof(double);
    for (size_t i = 0; i < count; i++)
        w->cell->bits = (w->cell->bits ^ bytes[i]) * UINT64_C(0x100000001b3);
}

static dal_status take_row(walk *w, long long row)
{
    study_cell *c = w->cell;
    dal_status status = dal_run_observe(w->run, w->values);
    if (status != DAL_OK) return status;
    if (row == 0) memcpy(w->first, w->values, (size_t)c->observables * sizeof(double));
    dal_statistics_add(w->statistics, c->observables, dal_run_time(w->run), w->values);
    int window = (int)((double)row / (double)(w->samples + 1) * STUDY_WINDOWS);
    track(w, c->windows[window]);
    c->window_count = window + 1;
    hash_state(w);
    return DAL_OK;
}

static double thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static dal_status advance_to(walk *w, long long step)
{
    while (dal_run_steps(w->run) < step) {
        long long count = step - dal_run_steps(w->run);
        if (w->stop()) return DAL_INTERRUPTED;
        double before = thread_seconds();
        dal_status status = dal_run_advance(w->run, count < CHUNK ? count : CHUNK, &w->cell->error);
        w->cell->seconds += thread_seconds() - before;
        if (status != DAL_OK) return status;
    }
    return DAL_OK;
}

static dal_status go(walk *w)
{
    study_cell *c = w->cell;
    dal_statistics_start(w->statistics, c->observables);
    dal_status status = DAL_OK;
    for (long long row = 0; row <= w->samples && status == DAL_OK; row++) {
        long long step = llround((double)row / (double)w->samples * (double)w->total);
        status = advance_to(w, step);
        if (status == DAL_OK) status = take_row(w, row);
    }
    for (int i = 0; i < c->observables; i++)
        cli_judge(c->names[i], &w->statistics[i], status != DAL_OK, &c->finding[i]);
    c->time = dal_run_time(w->run);
    c->steps = dal_run_steps(w->run);
    c->evaluations = dal_run_evaluations(w->run);
    return status;
}

static void conclude(study_cell *c, int made, dal_status status)
{
    if (status == DAL_INTERRUPTED || status == DAL_MEMORY) {
        study_cell_free(c);
        return;
    }
    if (status != DAL_OK && !c->error.message[0])
        snprintf(c->error.message, sizeof c->error.message, "%s", dal_status_text(status));
    c->error.status = status;
    c->state = status == DAL_OK ? STUDY_FINISHED : made ? STUDY_FAILED : STUDY_REFUSED;
    if (!made && status != DAL_UNSUPPORTED) c->state = STUDY_FAILED;
}

dal_status study_cell_run(study_cell *cell, int (*stop)(void))
{
    walk w = {.cell = cell, .stop = stop, .n = cell->entry->system->n, .m = cell->entry->system->m};
    cell->bits = UINT64_C(0xcbf29ce484222325);
    w.total = llround(cell->entry->time / cell->step);
    w.samples = cell->entry->samples < w.total ? cell->entry->samples : w.total;
    dal_status status = make_run(&w);
    int made = status == DAL_OK;
    if (made) status = make_memory(&w);
    if (status == DAL_OK) status = go(&w);
    conclude(cell, made, status);
    free(w.values);
    free(w.statistics);
    dal_run_free(w.run);
    return status == DAL_INTERRUPTED || status == DAL_MEMORY ? status : DAL_OK;
}

void study_cell_free(study_cell *cell)
{
    free(cell->finding);
    free(cell->names);
    free(cell->windows);
    *cell = (study_cell){
        .entry = cell->entry, .method = cell->method, .step = cell->step, .start = cell->start};
}

/* ---- what is asked of a finished cell ---- */

const char *study_track_column(int track)
{
    static const char *const column[] = {
#define X(code, name) name,
        STUDY_TRACK_LIST(X)
#undef X
    };
    return column[track];
}

const char *study_state_word(study_state state)
{
    static const char *const words[] = {
#define X(code, word) word,
        STUDY_STATE_LIST(X)
#undef X
    };
    return words[state];
}

const dal_finding *study_finding(const study_cell *cell, const char *name)
{
    int i = find(cell, name);
    return i < 0 ? NULL : &cell->finding[i];
}

const dal_finding *study_worst_constraint(const study_cell *cell)
{
    const dal_finding *worst = NULL;
    int m = cell->entry->system->m;
    for (int a = 0; a < m && a < cell->observables; a++)
        if (!worst || cell->finding[a].greatest > worst->greatest) worst = &cell->finding[a];
    return worst;
}

const dal_finding *study_worst_invariant(const study_cell *cell, const char **name)
{
    const dal_finding *worst = NULL;
    const dal_system *s = cell->entry->system;
    for (int i = 0; i < s->invariants; i++) {
        const dal_finding *finding = study_finding(cell, s->invariant[i]);
        if (!finding || (worst && finding->deviation <= worst->deviation)) continue;
        worst = finding;
        if (name) *name = s->invariant[i];
    }
    return worst;
}

const char *study_verdict(const study_cell *cell, const dal_finding *finding)
{
    int conserved = (cell->entry->system->properties & (DAL_E_EXACT | DAL_E_WEAK)) != 0;
    if (finding == study_finding(cell, "E") && !conserved) return "-";
    return dal_verdict_text(finding->verdict);
}

const study_cell *study_physical_twin(const study_plan *plan, const study_cell *cell)
{
    const study_entry *e = cell->entry;
    for (int i = e->first_cell; i < e->first_cell + e->cells; i++) {
        const study_cell *c = &plan->cells[i];
        if (c->method == cell->method && c->step == cell->step && c->start == STUDY_PHYSICAL)
            return c;
    }
    return NULL;
}
