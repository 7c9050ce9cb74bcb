/* study_values.c - one value, a list, a range, a draw; and the cases that these make.
 *
 * Value k of a range {from: a, to: b, count: n} is a + k (b - a)/(n - 1), the last exactly b; of
 * {from: a, to: b, by: d} it is a + k d, as long as that is not beyond b by more than d/1e9.
 *
 * A draw needs no state: the upper 53 bits u of the key of name and seed (dal__random_key, of which
 * ensembles draw as well) give low + (high - low) u/2^53.  So what is drawn for one name does not
 * depend on what else is drawn.
 *
 * A system of a study with `set: {a: [1, 2], b: {from: 0, to: 1, count: 3}}` is six cases, called
 * LABEL_a=1_b=0 and so on; where something is drawn there is one for each of the seeds, called
 * .._seed=7.  What has one value alone is not in the label. */
#include "study_values.h"
#include "dalembert_program.h"

#include "io/file.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double beyond = 1e-9; /* fractions of a step by which a range may miss its end */

/* ---- ranges ---- */

/* What is not given is not a number. */
typedef struct range {
    double from, to, count, by;
    study_values *values;
} range;

static int read_between(void *user, const document *doc, yaml_node_t *value,
                        const document_key *key)
{
    study_values *v = ((range *)user)->values;
    if (value->type != YAML_SEQUENCE_NODE || document_count(value) != 2)
        return document_fail(doc, value, "between: two numbers are required, [LOW, HIGH]");
    int status = document_number(doc, document_item(doc, value, 0), key->name, &v->low);
    if (status == CLI_DONE)
        status = document_number(doc, document_item(doc, value, 1), key->name, &v->high);
    if (status == CLI_DONE && !(v->low < v->high))
        return document_fail(doc, value, "between: %g is not below %g", v->low, v->high);
    v->is_drawn = true;
    return status;
}

static const document_key range_keys[] = {{"from", document_read_number, offsetof(range, from)},
                                          {"to", document_read_number, offsetof(range, to)},
                                          {"count", document_read_number, offsetof(range, count)},
                                          {"by", document_read_number, offsetof(range, by)},
                                          {"between", read_between, 0}};

static void allocate_values(study_values *v, int count)
{
    v->value = cli_calloc((size_t)count, sizeof *v->value);
    v->count = count;
}

static int fill_range(const range *r, const document *doc, const yaml_node_t *node,
                      const char *what)
{
    study_values *v = r->values;
    const bool has_by = !isnan(r->by);
    const double a = r->from, b = r->to, distance = b - a;
    if (isnan(distance) || has_by == !isnan(r->count))
        return document_fail(doc, node, "%s: a range is {from:, to:, count:} or {from:, to:, by:}",
                             what);
    const double count = has_by ? floor(distance / r->by + beyond) + 1.0 : r->count;
    if (!(count >= 1.0 && count <= STUDY_VALUES_MAX) || count != floor(count) ||
        (count == 1.0 && !has_by && distance != 0.0))
        return document_fail(doc, node, "%s: this range does not have 1..%d values", what,
                             STUDY_VALUES_MAX);
    allocate_values(v, (int)count);
    for (int k = 0; k < v->count; k++)
        v->value[k] = has_by              ? a + k * r->by
                      : k == v->count - 1 ? b
                                          : a + k * (b - a) / (v->count - 1);
    return CLI_DONE;
}

static int read_range(study_values *v, const document *doc, yaml_node_t *node, const char *what)
{
    range r = {NAN, NAN, NAN, NAN, v};
    const int count = sizeof range_keys / sizeof range_keys[0];
    const int status = document_read_mapping(doc, node, what, range_keys, count, &r);
    if (status != CLI_DONE) return status;
    if (!v->is_drawn) return fill_range(&r, doc, node, what);
    if (isnan(r.from) && isnan(r.to) && isnan(r.count) && isnan(r.by)) return CLI_DONE;
    return document_fail(doc, node, "%s: between excludes all other keys", what);
}

/* ---- all ---- */

int study_values_read(study_values *v, const document *doc, yaml_node_t *node, const char *what)
{
    *v = (study_values){0};
    if (node->type == YAML_MAPPING_NODE) return read_range(v, doc, node, what);
    const int count = document_count(node);
    if (count == 0) return document_fail(doc, node, "%s: the list is empty", what);
    if (count > STUDY_VALUES_MAX)
        return document_fail(doc, node, "%s: %d values, not 1..%d", what, count, STUDY_VALUES_MAX);
    int status = CLI_DONE;
    allocate_values(v, count);
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = document_number(doc, document_item(doc, node, i), what, &v->value[i]);
    return status;
}

void study_values_free(study_values *values)
{
    free(values->value);
    *values = (study_values){0};
}

/* The draw of a name ("set:mass") for a seed, uniform in [low, high). */
static double draw(const char *name, uint64_t seed, double low, double high)
{
    return low + (high - low) * ((double)(dal__random_key(name, seed) >> 11) * 0x1p-53);
}

typedef struct variant_setting {
    const char *name;
    study_values values;
    const char *format; /* of its values in labels */
} variant_setting;

struct study_variants {
    const document *doc;
    const yaml_node_t *start_node;
    variant_setting *setting; /* settings of set come first */
    int count, of_set, drawn, start_drawn;
    variant_setting seed;
};

/* ---- several settings ---------------------------------------------------------------------- */

/* Six digits where these distinguish the values, else seventeen. */
static const char *choose_format(const study_values *values)
{
    char before[32] = "", text[32];
    for (int i = 0; i < values->count; i++) {
        snprintf(text, sizeof text, "%.6g", values->value[i]);
        if (i > 0 && strcmp(before, text) == 0) return "%.17g";
        memcpy(before, text, sizeof before);
    }
    return "%.6g";
}

static int read_setting(variant_setting *s, const document *doc, yaml_node_t *value,
                        const char *what)
{
    /* e alone may be infinite. */
    if (value->type == YAML_SCALAR_NODE && strcmp(s->name, "e") == 0 &&
        strcmp((const char *)value->data.scalar.value, "inf") == 0) {
        allocate_values(&s->values, 1);
        s->values.value[0] = INFINITY;
    } else if (study_values_read(&s->values, doc, value, what) != CLI_DONE) {
        return CLI_USAGE;
    }
    s->format = choose_format(&s->values);
    return CLI_DONE;
}

/* Whether a name is a vakonomic multiplier's, g1, g2, ... */
static bool is_multiplier(const char *name)
{
    return name[0] == 'g' && name[1] != '\0' && strspn(name + 1, "0123456789") == strlen(name + 1);
}

/* Of a system with several mechanics only the vakonomic ones have multipliers to start. */
typedef enum multiplier_use { READ_MULTIPLIERS, SKIP_MULTIPLIERS } multiplier_use;

static int read_settings(study_variants *v, yaml_node_t *node, const char *what,
                         multiplier_use multipliers)
{
    document_pair pair;
    v->of_set = v->count;
    int status = node ? document_check_mapping(v->doc, node, what, "names and values") : CLI_DONE;
    for (int i = 0; node && status == CLI_DONE && document_get_pair(v->doc, node, i, &pair); i++) {
        if (multipliers == SKIP_MULTIPLIERS && is_multiplier(pair.name)) continue;
        v->setting = cli_realloc(v->setting, ((size_t)v->count + 1) * sizeof *v->setting);
        variant_setting *s = &v->setting[v->count++];
        *s = (variant_setting){.name = pair.name};
        status = read_setting(s, v->doc, pair.value, what);
        v->drawn += s->values.is_drawn;
    }
    return status;
}

static int read_seeds(study_variants *v, const document *doc, const parsed_study *p)
{
    study_values *seeds = &v->seed.values;
    const yaml_node_t *place = p->set ? p->set : p->start;
    if (v->drawn == 0 && !p->seeds) return CLI_DONE;
    if (!p->seeds)
        return document_fail(doc, place, "random values need seeds: give a list of them");
    const int status = study_values_read(seeds, doc, p->seeds, "seeds");
    if (status != CLI_DONE) return status;
    v->seed.name = "seed";
    v->seed.format = "%.17g";
    if (seeds->is_drawn) return document_fail(doc, p->seeds, "seeds: they must not be random");
    for (int i = 0; i < seeds->count; i++) {
        const double seed = seeds->value[i];
        if (!(seed >= 0.0 && seed <= 0x1p53) || seed != floor(seed))
            return document_fail(doc, p->seeds, "seeds: %g is not an integer in 0..2^53", seed);
    }
    return CLI_DONE;
}

int study_variants_read(study_variants **variants, const document *doc, const parsed_study *p,
                        int *count)
{
    study_variants *v = *variants = cli_calloc(1, sizeof *v);
    v->doc = doc;
    v->start_node = p->start;
    int status = read_settings(v, p->set, "set", READ_MULTIPLIERS);
    const int set_drawn = v->drawn;
    const study_case *e = &p->item;
    const bool lacks_multipliers =
        e->variant && e->choices.mechanics == DAL_MECHANICS_LAGRANGE_DALEMBERT;
    if (status == CLI_DONE)
        status = read_settings(v, p->start, "start",
                               lacks_multipliers ? SKIP_MULTIPLIERS : READ_MULTIPLIERS);
    v->start_drawn = v->drawn - set_drawn;
    if (status == CLI_DONE) status = read_seeds(v, doc, p);
    if (status != CLI_DONE) return status;
    double combinations = v->drawn ? v->seed.values.count : 1;
    for (int i = 0; i < v->count; i++)
        if (!v->setting[i].values.is_drawn) combinations *= v->setting[i].values.count;
    if (combinations > STUDY_VALUES_MAX)
        return document_fail(doc, p->set ? p->set : p->start,
                             "%g combinations of values, not 1..%d", combinations,
                             STUDY_VALUES_MAX);
    *count = (int)combinations;
    return CLI_DONE;
}

void study_variants_free(study_variants *v)
{
    if (!v) return;
    for (int i = 0; i < v->count; i++) study_values_free(&v->setting[i].values);
    study_values_free(&v->seed.values);
    free(v->setting);
    free(v);
}

/* ---- one combination ----------------------------------------------------------------------- */

/* x' is v_x in a label, which names files. */
static void put_label(FILE *out, const variant_setting *s, double value)
{
    const size_t length = strlen(s->name);
    const bool is_velocity = length > 1 && s->name[length - 1] == '\'';
    fprintf(out, "_%s%.*s=", is_velocity ? "v_" : "", (int)(length - (size_t)is_velocity), s->name);
    fprintf(out, s->format, value);
}

/* The value that the lowest digit of *i chooses, which is taken off. */
static double choose(const study_values *values, int *i)
{
    const double value = values->value[*i % values->count];
    *i /= values->count;
    return value;
}

/* The digits of i choose the values; the lowest chooses the seed, the next the last
 * setting. */
void study_variants_apply(const study_variants *v, int i, study_case *e)
{
    char name[256];
    size_t length;
    double *value = cli_calloc((size_t)v->count, sizeof *value);
    const double seed = v->drawn ? choose(&v->seed.values, &i) : 0.0;
    for (int k = v->count - 1; k >= 0; k--) {
        const study_values *values = &v->setting[k].values;
        snprintf(name, sizeof name, "%s:%s", k < v->of_set ? "set" : "start", v->setting[k].name);
        value[k] = values->is_drawn ? draw(name, (uint64_t)seed, values->low, values->high)
                                    : choose(values, &i);
    }
    for (int k = 0; k < v->count; k++)
        request_add_setting(k < v->of_set ? &e->set : &e->start, v->setting[k].name, value[k]);
    FILE *out = cli_memstream_open(&e->label, &length);
    fputs(e->variant ? e->variant : e->item_label, out);
    for (int k = 0; k < v->count; k++)
        if (v->setting[k].values.count > 1) put_label(out, &v->setting[k], value[k]);
    if (v->drawn) put_label(out, &v->seed, seed);
    cli_memstream_close(out);
    free(value);
}

/* ---- projection to D = 0 ------------------------------------------------------------------- */

/* v[n] becomes the velocities of the start moved to D = 0. */
static dal_status find_velocities(const study_case *e, double *v, dal_error *error)
{
    dal_run *run = NULL;
    dal_setting *start = cli_calloc((size_t)e->start.count, sizeof *start);
    dal_run_spec spec = {.system = e->system,
                         .options = dal_options_default(),
                         .parameters = e->set.item,
                         .parameter_count = e->set.count,
                         .start = start,
                         .start_time = e->from};
    spec.options.space = DAL_PHYSICAL;
    spec.options.consistent = true;
    for (int i = 0; i < e->start.count; i++) {
        const char *name = e->start.item[i].name;
        if (strncmp(name, "p_", 2) != 0 && strncmp(name, "pi_", 3) != 0 && strcmp(name, "e") != 0)
            start[spec.start_count++] = e->start.item[i];
    }
    dal_status status = dal_method_parse(&spec.method, "rk4", error);
    if (status == DAL_STATUS_OK) status = dal_run_create(&run, &spec, error);
    const size_t n = (size_t)e->system->n;
    if (status == DAL_STATUS_OK) memcpy(v, dal_run_state(run) + n, n * sizeof *v);
    dal_run_free(run);
    free(start);
    return status;
}

int study_variants_project_start(const study_variants *v, study_case *e)
{
    dal_error error = {0};
    if (v->start_drawn == 0 || e->system->m == 0) return CLI_DONE;
    const int n = e->system->n;
    double *moved = cli_calloc((size_t)n, sizeof *moved);
    const dal_status found = find_velocities(e, moved, &error);
    int status = CLI_DONE;
    for (int i = 0; cli_is_ok(found) && i < n; i++) {
        char *name = cli_format("%s'", e->system->coordinate[i]);
        request_add_setting(&e->start, name, moved[i]);
        free(name);
    }
    if (found != DAL_STATUS_OK)
        status = document_fail(v->doc, v->start_node, "%s: no start on D = 0 was found: %s",
                               e->label, error.message[0] ? error.message : dal_status_text(found));
    free(moved);
    return status;
}
