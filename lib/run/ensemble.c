/* ensemble.c - members of an ensemble: drawn by seed, name and member alone, stepped as lanes.
 *
 * A draw needs no state.  With SplitMix64 (Steele, Lea, Flood 2014, doi 10.1145/2660193.2660195),
 * all modulo 2^64 and c = 0x9e3779b97f4a7c15,
 *
 *     mix(z):   z = (z ^ z>>30) 0xbf58476d1ce4e5b9,  z = (z ^ z>>27) 0x94d049bb133111eb,  z ^ z>>31
 *     key       mix(FNV-1a(name) + seed c)                         of a name and a seed
 *     u_k       (floor(mix(key + (k + 1) c) / 2^11) + 1/2) / 2^53  in (0, 1), k = 0, 1, ..
 *
 * member i of a variation draws
 *
 *     uniform(a, b)          a + (b - a) u_2i
 *     normal(mean, s)        mean + s z,   z = sqrt(-2 log u_2i) cos(2 pi u_(2i+1))   (Box, Muller)
 *     lognormal(mean, s)     exp(mean + s z)
 *
 * so that it depends neither on other members nor on other names. */
#include "core/error.h"
#include "core/pi.h"
#include "core/settings.h"
#include "dalembert_program.h"
#include "run/batch.h"
#include "run/start.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- draws ---- */

static const uint64_t increment = UINT64_C(0x9e3779b97f4a7c15);

static uint64_t mix(uint64_t z)
{
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

unsigned long long dal__random_key(const char *name, unsigned long long seed)
{
    const uint64_t hash = dal__hash(DAL__HASH_START, name, name ? strlen(name) : 0);
    return mix(hash + seed * increment);
}

static double uniform(uint64_t key, uint64_t k)
{
    return ((double)(mix(key + (k + 1) * increment) >> 11) + 0.5) * 0x1p-53;
}

static double draw(const dal_variation *v, uint64_t key, uint64_t member)
{
    const double u = uniform(key, 2 * member);
    if (v->distribution == DAL_UNIFORM) return v->first + (v->second - v->first) * u;
    const double z = sqrt(-2.0 * log(u)) * cos(2.0 * DAL__PI * uniform(key, 2 * member + 1));
    const double x = v->first + v->second * z;
    return v->distribution == DAL_NORMAL ? x : exp(x);
}

double dal_variation_draw(const dal_variation *variation, unsigned long long seed,
                          unsigned long long member)
{
    if (!variation) return NAN;
    return draw(variation, dal__random_key(variation->name, seed), member);
}

/* ---- variations as texts ---- */

static const char *const distribution_word[] = {
#define WORD(code, word) word,
    DAL_DISTRIBUTION_LIST(WORD)
#undef WORD
};
enum { DISTRIBUTIONS = sizeof distribution_word / sizeof *distribution_word };

/* A piece of the text without the blanks around it. */
typedef struct piece {
    const char *at;
    size_t length;
} piece;

static piece trim(const char *from, const char *to)
{
    while (from < to && *from == ' ') from++;
    while (to > from && to[-1] == ' ') to--;
    return (piece){from, (size_t)(to - from)};
}

static dal_status parse_number(piece text, double *x, dal_error *error)
{
    const dal_status status = dal__parse_number(text.at, text.length, x);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(error, status, "'%.*s' is not a number", (int)text.length, text.at);
}

static dal_status parse_distribution(dal_variation *v, piece word, dal_error *error)
{
    char name[32];
    snprintf(name, sizeof name, "%.*s", (int)word.length, word.at);
    for (int i = 0; i < DISTRIBUTIONS; i++) {
        v->distribution = (dal_distribution)i;
        if (strcmp(distribution_word[i], name) == 0) return DAL_STATUS_OK;
    }
#define LISTED(code, word) " " word
    return dal__fail(error, DAL_STATUS_NAME,
                     "unknown distribution '%s', not one of" DAL_DISTRIBUTION_LIST(LISTED), name);
#undef LISTED
}

static dal_status check_variation(const dal_variation *v, dal_error *error)
{
    if (!isfinite(v->first) || !isfinite(v->second))
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%s: the distribution is not one of finite numbers", v->name);
    if (v->distribution == DAL_UNIFORM && !(v->first < v->second))
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%s: uniform needs LOW < HIGH; %g is not below %g", v->name, v->first,
                         v->second);
    if (v->distribution != DAL_UNIFORM && v->second < 0.0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "%s: the standard deviation %g is negative",
                         v->name, v->second);
    return DAL_STATUS_OK;
}

dal_status dal_variation_parse(dal_variation *variation, const char *text, dal_error *error)
{
    DAL_REQUIRE(variation, error);
    DAL_REQUIRE(text, error);
    const char *const end = text + strlen(text), *const equals = strchr(text, '=');
    const char *const open = equals ? strchr(equals, '(') : NULL;
    const char *const comma = open ? strchr(open, ',') : NULL;
    const char *const close = comma ? strchr(comma, ')') : NULL;
    if (!close || trim(close + 1, end).length > 0)
        return dal__fail(error, DAL_STATUS_SYNTAX, "'%.200s' is not NAME=DISTRIBUTION(A,B)", text);
    const piece name = trim(text, equals);
    if (name.length == 0 || name.length >= sizeof variation->name)
        return dal__fail(error, DAL_STATUS_SYNTAX, "'%.200s' does not begin with a name", text);
    *variation = (dal_variation){.distribution = DAL_UNIFORM};
    memcpy(variation->name, name.at, name.length);
    DAL_TRY(parse_distribution(variation, trim(equals + 1, open), error));
    DAL_TRY(parse_number(trim(open + 1, comma), &variation->first, error));
    DAL_TRY(parse_number(trim(comma + 1, close), &variation->second, error));
    return check_variation(variation, error);
}

/* ---- ensembles ---- */

/* A variation with its place: of a parameter, or (parameter < 0) of a number of the state. */
typedef struct varied {
    dal_variation variation;
    uint64_t key;
    int parameter, state;
} varied;

struct dal_ensemble {
    dal_batch *batch;
    int lanes, variations, started;
    uint64_t first; /* the member in lane 0 */
    varied *varied; /* [variations] */
    /* Settings of the spec, with names of their own, and after the parameters those that vary. */
    dal_setting *parameters, *start;
    int spec_parameters, parameter_count, start_count;
    char *names;
    double *added; /* [dimension] to the start */
};

/* Finds what a variation varies. */
static dal_status find_varied(dal_ensemble *e, const dal_run *run, varied *v, dal_error *error)
{
    const dal_system *system = run->layout.system;
    char name[DAL__NAME_SIZE];
    v->parameter = -1;
    v->state = dal_run_component_index(run, v->variation.name);
    if (v->state >= 0) return DAL_STATUS_OK;
    if (dal__find_parameter(system, v->variation.name, &v->parameter, NULL) == DAL_STATUS_OK) {
        e->parameters[e->parameter_count++].name = system->parameter[v->parameter];
        return DAL_STATUS_OK;
    }
    const char *nearest =
        dal__nearest_name(v->variation.name, system->parameter, system->parameters);
    for (int i = 0; !nearest && dal_run_component_name(run, i, name, sizeof name); i++)
        nearest = dal__nearest_name(v->variation.name, (const char *const[]){name}, 1);
    return dal__unknown(error, "start value or parameter", v->variation.name, &nearest,
                        nearest != NULL);
}

static dal_status add_variations(dal_ensemble *e, const dal_variation *variations,
                                 unsigned long long seed, dal_error *error)
{
    for (int i = 0; i < e->variations; i++) {
        varied *v = &e->varied[i];
        v->variation = variations[i];
        v->variation.name[sizeof v->variation.name - 1] = '\0';
        DAL_TRY(check_variation(&v->variation, error));
        for (int k = 0; k < i; k++)
            if (strcmp(e->varied[k].variation.name, v->variation.name) == 0)
                return dal__fail(error, DAL_STATUS_ARGUMENT, "%s is varied twice",
                                 v->variation.name);
        DAL_TRY(find_varied(e, dal__batch_scalar(e->batch), v, error));
        v->key = dal__random_key(v->variation.name, seed);
    }
    return DAL_STATUS_OK;
}

static void copy_settings(dal_setting *to, const dal_setting *from, int count, char **names)
{
    for (int i = 0; i < count; i++) {
        const size_t bytes = strlen(from[i].name) + 1;
        to[i] = (dal_setting){memcpy(*names, from[i].name, bytes), from[i].value};
        *names += bytes;
    }
}

static size_t name_bytes(const dal_setting *settings, int count)
{
    size_t bytes = 0;
    for (int i = 0; i < count; i++) bytes += strlen(settings[i].name) + 1;
    return bytes;
}

static dal_status allocate_ensemble(dal_ensemble *e, const dal_run_spec *spec, dal_error *error)
{
    const int p = spec->parameter_count, s = spec->start_count;
    e->spec_parameters = e->parameter_count = p;
    e->start_count = s;
    e->varied = calloc((size_t)e->variations + 1, sizeof *e->varied);
    e->parameters = calloc((size_t)(p + e->variations) + 1, sizeof *e->parameters);
    e->start = calloc((size_t)s + 1, sizeof *e->start);
    e->added = calloc((size_t)dal__batch_layout(e->batch)->dim, sizeof *e->added);
    char *names = e->names =
        malloc(name_bytes(spec->parameters, p) + name_bytes(spec->start, s) + 1);
    if (!e->varied || !e->parameters || !e->start || !e->added || !e->names)
        return dal__fail(error, DAL_STATUS_MEMORY, "no memory for an ensemble");
    copy_settings(e->parameters, spec->parameters, p, &names);
    copy_settings(e->start, spec->start, s, &names);
    return DAL_STATUS_OK;
}

dal_status dal_ensemble_create(dal_ensemble **ensemble, const dal_run_spec *spec,
                               const dal_variation *variations, int count, unsigned long long seed,
                               int lanes, dal_error *error)
{
    DAL_REQUIRE(ensemble, error);
    *ensemble = NULL;
    DAL_REQUIRE_COUNT(count, error);
    DAL_REQUIRE(variations || count == 0, error);
    dal_batch *batch;
    DAL_TRY(dal_batch_create(&batch, spec, lanes, 0, error));
    dal_ensemble *made = calloc(1, sizeof *made);
    if (!made) {
        dal_batch_free(batch);
        return dal__fail(error, DAL_STATUS_MEMORY, "no memory for an ensemble");
    }
    *made = (dal_ensemble){.batch = batch, .lanes = lanes, .variations = count};
    dal_status status = allocate_ensemble(made, spec, error);
    if (status == DAL_STATUS_OK) status = add_variations(made, variations, seed, error);
    if (status == DAL_STATUS_OK)
        *ensemble = made;
    else
        dal_ensemble_free(made);
    return status;
}

void dal_ensemble_free(dal_ensemble *ensemble)
{
    if (!ensemble) return;
    dal_batch_free(ensemble->batch);
    free(ensemble->varied);
    free(ensemble->parameters);
    free(ensemble->start);
    free(ensemble->added);
    free(ensemble->names);
    free(ensemble);
}

/* The value of a parameter before something is added: the spec's, or the system's. */
static double parameter_base(const dal_ensemble *e, int parameter)
{
    const dal_system *system = dal__batch_layout(e->batch)->system;
    double base = system->value ? system->value[parameter] : 0.0;
    for (int i = 0; i < e->spec_parameters; i++)
        if (strcmp(e->parameters[i].name, system->parameter[parameter]) == 0)
            base = e->parameters[i].value;
    return base;
}

/* Starts a lane by its member's draws. */
static dal_status start_lane(dal_ensemble *e, int lane, dal_error *error)
{
    dal_setting *parameter = e->parameters + e->spec_parameters;
    for (int i = 0; i < e->variations; i++) {
        const varied *v = &e->varied[i];
        const double amount = draw(&v->variation, v->key, e->first + (uint64_t)lane);
        if (v->parameter < 0)
            e->added[v->state] = amount;
        else
            (parameter++)->value = parameter_base(e, v->parameter) + amount;
    }
    return dal__batch_start_varied(e->batch, lane, e->parameters, e->parameter_count, e->start,
                                   e->start_count, e->added, error);
}

dal_status dal_ensemble_start(dal_ensemble *ensemble, unsigned long long first, int count)
{
    DAL_REQUIRE(ensemble, NULL);
    if (count < 0 || count > ensemble->lanes) return DAL_STATUS_ARGUMENT;
    dal_batch_clear(ensemble->batch);
    ensemble->first = first;
    ensemble->started = count;
    for (int lane = 0; lane < count; lane++) {
        dal_error error = {.status = DAL_STATUS_OK};
        if (start_lane(ensemble, lane, &error) != DAL_STATUS_OK)
            dal__batch_refuse(ensemble->batch, lane, &error);
    }
    return DAL_STATUS_OK;
}

dal_batch *dal_ensemble_batch(dal_ensemble *ensemble) { return ensemble ? ensemble->batch : NULL; }

void dal_ensemble_draws(const dal_ensemble *ensemble, double *draws)
{
    for (int lane = 0; ensemble && draws && lane < ensemble->started; lane++)
        for (int i = 0; i < ensemble->variations; i++)
            *draws++ = draw(&ensemble->varied[i].variation, ensemble->varied[i].key,
                            ensemble->first + (uint64_t)lane);
}

void dal_ensemble_states(const dal_ensemble *ensemble, double *states)
{
    const int dimension = ensemble ? dal__batch_layout(ensemble->batch)->dim : 0;
    for (int lane = 0; ensemble && states && lane < ensemble->started; lane++) {
        if (dal_batch_status(ensemble->batch, lane, NULL) == DAL_STATUS_OK)
            dal_batch_state(ensemble->batch, lane, states);
        else
            for (int i = 0; i < dimension; i++) states[i] = NAN;
        states += dimension;
    }
}
