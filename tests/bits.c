/* bits.c - one motion computed in every way there is, bit by bit; see bits.h.
 *
 * WIDE lanes, each with a start of its own where the constraints let it, go STEPS steps: as runs,
 * stepped by the tape; as batches of every width; and by generated files of one and of WIDE lanes,
 * compiled as shared objects.  State, clock, counters and status must agree. */
#include "bits.h"
#include "dalembert_codegen.h"
#include "model/programs.h"
#include "run/run.h"
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDE = 8, STEPS = 1000, NAME = 96 };

/* ---- what there is ---- */

static const char *const compilers[] = {"gcc", "clang"};
static const char *const levels[] = {"-O1", "-O2", "-O3"};
static const char *const machines[] = {"", "-march=native"};
enum { COMPILERS = 2, LEVELS = 3, MACHINES = 2, BUILDS = COMPILERS * LEVELS * MACHINES };

/* With every second system, adaptive methods divide steps several times as long. */
static const double TOLERANCE = 1e-13, FACTOR = 16.0;

/* What modifiers are tried on. */
static const char *const inner[] = {"rk4", "stormer-verlet", "gauss4"};
enum { INNER = sizeof inner / sizeof *inner };

static int systems(void)
{
    int count = 0;
    while (dal_builtin_name(count)) count++;
    return count;
}

/* Each integrator has INNER numbers: a modifier around one after the other, others the first. */
static int methods(void)
{
    int count = 0;
    while (dal_integrator_at(count)) count++;
    return count * INNER;
}

static bool method_name(int number, char *name)
{
    const dal_integrator *k = dal_integrator_at(number / INNER);
    const char *around = inner[number % INNER];
    const bool modifier = k->properties & DAL_MODIFIER;
    snprintf(name, NAME, "%s%s%s", modifier ? around : "", modifier ? "+" : "", k->name);
    return modifier || number % INNER == 0;
}

/* ---- a case, and its motion by the tape ---- */

typedef struct motion {
    char method[NAME];
    dal_model *model;
    dal_run_spec spec;
    dal_setting start[WIDE];
    dal_run *run[WIDE];
    double *begin[WIDE];     /* [persistent] */
    dal_status status[WIDE]; /* as a step says, which dal__failure_reason may know better */
    size_t persistent;
    int inputs, wrong;
} motion;

static bool begin_lane(motion *m, int lane)
{
    dal_error error;
    size_t count;
    m->start[lane].name = m->spec.system->coordinate[0];
    if (lane > 0) m->start[lane].value = m->begin[0][0] + 1e-3 * lane;
    dal_run_spec spec = m->spec;
    spec.start = &m->start[lane];
    spec.start_count = lane > 0;
    if (dal_run_create(&m->run[lane], &spec, &error) == DAL_STATUS_INCONSISTENT && lane > 0) {
        m->start[lane].value = m->begin[0][0];
        spec.start_count = 0;
        dal_run_create(&m->run[lane], &spec, &error);
    }
    if (!m->run[lane]) return false;
    const double *memory = dal_run_save(m->run[lane], &count);
    m->begin[lane] = malloc(count * sizeof *memory);
    memcpy(m->begin[lane], memory, count * sizeof *memory);
    m->persistent = m->run[lane]->layout.persistent;
    return true;
}

static void end_motion(motion *m)
{
    for (int lane = 0; lane < WIDE; lane++) {
        dal_run_free(m->run[lane]);
        free(m->begin[lane]);
    }
    dal_model_free(m->model);
}

/* False: the method does not go with the system on this space. */
static bool begin_motion(motion *m, int system, int method, dal_space space)
{
    *m = (motion){.spec = {.options = dal_options_default()}};
    m->spec.options.space = space;
    bool can = method_name(method, m->method) &&
               dal_model_builtin(&m->model, dal_builtin_name(system), NULL) == DAL_STATUS_OK &&
               dal_model_system(m->model, &m->spec.system, NULL) == DAL_STATUS_OK &&
               dal_method_parse(&m->spec.method, m->method, NULL) == DAL_STATUS_OK;
    if (can && system % 2 == 1 && dal_method_properties(&m->spec.method) & DAL_ADAPTIVE) {
        m->spec.options.tolerance = TOLERANCE;
        m->spec.options.step *= FACTOR;
    }
    for (int lane = 0; lane < WIDE && can; lane++) can = begin_lane(m, lane);
    if (!can) {
        end_motion(m);
        return false;
    }
    m->inputs = (int)dal__programs_of(m->spec.system)->tapes->first_input;
    for (int lane = 0; lane < WIDE; lane++)
        m->status[lane] = dal__step_run(m->run[lane], m->spec.options.step, STEPS);
    return true;
}

static void differs(motion *m, const char *way, const char *what)
{
    m->wrong++;
    printf("\n  %s, %s, %s: %s: %s\n", m->spec.system->name, m->method,
           m->spec.options.space == DAL_LIFTED ? "lifted" : "physical", way, what);
}

/* ---- batches ---- */

static void compare_batch(motion *m, int width)
{
    const size_t bytes = (size_t)m->run[0]->layout.dim * sizeof(double);
    double *state = malloc(bytes);
    char way[NAME];
    int other = 0;
    dal_batch *batch;
    snprintf(way, sizeof way, "batch of width %d", width);
    if (!state || dal_batch_create(&batch, &m->spec, WIDE, width, NULL) != DAL_STATUS_OK) {
        differs(m, way, "not made");
        free(state);
        return;
    }
    for (int i = 1; i < WIDE; i++) dal_batch_start(batch, i, NULL, 0, &m->start[i], 1, NULL);
    dal_batch_advance(batch, STEPS / 3);
    dal_batch_advance(batch, STEPS - STEPS / 3);
    for (int i = 0; i < WIDE; i++) {
        dal_batch_state(batch, i, state);
        other +=
            memcmp(state, dal_run_state(m->run[i]), bytes) != 0 ||
            (dal_batch_status(batch, i, NULL) == DAL_STATUS_OK) != (m->status[i] == DAL_STATUS_OK);
    }
    if (other) differs(m, way, "other bits");
    dal_batch_free(batch);
    free(state);
}

static void compare_batches(motion *m)
{
    static const int widths[] = {1, 4, 8};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) compare_batch(m, widths[i]);
}

/* ---- generated files ---- */

/* The struct of a generated file, number by number. */
typedef struct copies {
    int lanes;
    double *y, *work;
    int *status;
} copies;

typedef struct object {
    int (*start)(void *state, const void *parameters);
    int (*advance)(void *state, double h, long long count);
} object;

/* Lanes that go together share the count of evaluations of their system. */
static bool same_lane(const motion *m, const copies *p, int lane, const double *memory)
{
    const size_t evaluations = dal__at(&m->run[0]->layout, DAL__EVALUATIONS);
    for (size_t i = 0; i < m->persistent; i++)
        if ((i != evaluations || p->lanes == 1) &&
            memcmp(&p->y[i * (size_t)p->lanes + (size_t)lane], &memory[i], sizeof *memory) != 0)
            return false;
    return true;
}

static bool same_start(const motion *m, const copies *p)
{
    for (int lane = 0; lane < p->lanes; lane++) {
        if (!same_lane(m, p, lane, m->begin[0])) return false;
        for (int i = 0; i < m->spec.system->parameters; i++)
            if (p->work[i * p->lanes + lane] != m->run[0]->work[i]) return false;
    }
    return true;
}

static void compare_steps(motion *m, const object *o, copies *p, const char *way)
{
    const double h = m->spec.options.step;
    size_t count;
    if (o->start(p->y, NULL) != 0 || !same_start(m, p)) differs(m, way, "another start");
    for (int lane = 0; lane < p->lanes; lane++)
        for (size_t i = 0; i < m->persistent; i++)
            p->y[i * (size_t)p->lanes + (size_t)lane] = m->begin[lane][i];
    o->advance(p->y, h, 1);
    o->advance(p->y, h, STEPS / 3);
    o->advance(p->y, h, STEPS - STEPS / 3 - 1);
    for (int lane = 0; lane < p->lanes; lane++) {
        if (same_lane(m, p, lane, dal_run_save(m->run[lane], &count)) &&
            p->status[lane] == (int)m->status[lane])
            continue;
        differs(m, way, "other bits");
        return;
    }
}

static void compare_loaded(motion *m, int lanes, void *handle, const char *way)
{
    const size_t wide = (size_t)lanes, inputs = m->inputs ? (size_t)m->inputs : 1;
    double *memory = calloc((m->persistent + inputs + 1) * wide, sizeof *memory);
    copies p = {lanes, memory, memory + m->persistent * wide, NULL};
    object o;
    void *start = dlsym(handle, "bits_start"), *advance = dlsym(handle, "bits_advance");
    p.status = (int *)(void *)(p.work + inputs * wide);
    memcpy(&o.start, &start, sizeof start);
    memcpy(&o.advance, &advance, sizeof advance);
    if (memory && start && advance)
        compare_steps(m, &o, &p, way);
    else
        differs(m, way, "not loaded");
    free(memory);
}

/* Writes a text, compiles it by the build and loads the object. */
static void *load(const char *text, const char *folder, const char *build)
{
    static int number;
    char source[NAME], path[NAME], command[8 * NAME];
    snprintf(source, sizeof source, "%s/g.c", folder);
    snprintf(path, sizeof path, "%s/g%d.so", folder, number++);
    snprintf(command, sizeof command,
             "%s -std=c11 -Wall -Wextra -Wpedantic -Wno-psabi -Werror -shared -fPIC -o %s %s -lm",
             build, path, source);
    FILE *file = fopen(source, "w");
    if (!file) return NULL;
    fputs(text, file);
    fclose(file);
    void *handle = system(command) == 0 ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
    unlink(source);
    unlink(path);
    return handle;
}

static void build_name(int build, char *name)
{
    snprintf(name, NAME, "%s %s %s", compilers[build % COMPILERS],
             levels[build / COMPILERS % LEVELS], machines[build / COMPILERS / LEVELS]);
}

static bool there_is(int build)
{
    static int known[COMPILERS];
    const int c = build % COMPILERS;
    char command[NAME];
    snprintf(command, sizeof command, "%s --version >/dev/null 2>&1", compilers[c]);
    if (!known[c]) known[c] = system(command) == 0 ? 1 : -1;
    return known[c] > 0;
}

static void compare_generated(motion *m, int lanes, int build)
{
    char folder[] = "/tmp/dal-bits-XXXXXX", name[NAME], way[2 * NAME], *text = NULL;
    dal_error error = {0};
    build_name(build, name);
    snprintf(way, sizeof way, "generated, %d lanes, %s", lanes, name);
    if (!there_is(build) || !mkdtemp(folder)) return;
    const dal_generate_options options = {.lanes = lanes, .prefix = "bits"};
    const dal_status status = dal_generate(&m->spec, &options, &text, &error);
    void *handle = status == DAL_STATUS_OK ? load(text, folder, name) : NULL;
    if (handle) {
        compare_loaded(m, lanes, handle, way);
        dlclose(handle);
    } else {
        differs(m, way, status == DAL_STATUS_OK ? "does not compile" : error.message);
    }
    free(text);
    rmdir(folder);
}

/* ---- all of it, and a part that covers it ---- */

static int compare_builds(motion *m, int first, int builds)
{
    compare_batches(m);
    for (int i = 0; i < builds; i++) {
        compare_generated(m, 1, (first + i) % BUILDS);
        compare_generated(m, WIDE, (first + i) % BUILDS);
    }
    end_motion(m);
    return m->wrong;
}

int bits_part(const char *part)
{
    int which, count, builds = BUILDS, wrong = 0, compared = 0;
    motion m;
    if (sscanf(part, "%d/%d/%d", &which, &count, &builds) < 2 || count < 1) return 2;
    for (int number = which % count; number < systems() * methods() * 2; number += count) {
        const int system = number / 2 % systems(), method = number / 2 / systems();
        if (!begin_motion(&m, system, method, number % 2 ? DAL_PHYSICAL : DAL_LIFTED)) continue;
        wrong += compare_builds(&m, which + compared++, builds);
    }
    printf("bits: part %s: %d cases, %d builds of each: %d differ\n", part, compared, builds,
           wrong);
    return wrong > 0;
}

/* The integrator, around something if it is a modifier, with the first system from this one on that
 * it goes with. */
static bool begin_some(motion *m, int integrator, int *system, dal_space space)
{
    const dal_space other = space == DAL_LIFTED ? DAL_PHYSICAL : DAL_LIFTED;
    for (int i = 0; i < systems(); i++, *system = (*system + 1) % systems())
        for (int method = integrator * INNER; method < (integrator + 1) * INNER; method++)
            if (begin_motion(m, *system, method, space) || begin_motion(m, *system, method, other))
                return true;
    return false;
}

/* Each build once, with one lane or several; then what takes a compiler least time. */
static int compare_some(motion *m, int number)
{
    const bool first = number < BUILDS;
    const int quick = number % COMPILERS + (number & 2 ? COMPILERS * LEVELS : 0);
    compare_batches(m);
    compare_generated(m, first && number / 2 % 2 ? WIDE : 1, first ? number : quick);
    end_motion(m);
    return m->wrong;
}

int bits_cover(void)
{
    const int integrators = methods() / INNER;
    bool seen[256] = {false};
    int wrong = 0, number = 0, next = 0;
    motion m;
    while (number < integrators || next < systems()) {
        int system = next % systems();
        if (begin_some(&m, number % integrators, &system, number & 2 ? DAL_PHYSICAL : DAL_LIFTED)) {
            wrong += compare_some(&m, number);
            seen[system] = true;
        }
        number++;
        while (next < systems() && seen[next]) next++;
    }
    return wrong;
}
