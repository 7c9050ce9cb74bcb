/* study_variants.c - from settings with several values to cases with one each.
 *
 * A system of a study with `set: {a: [1, 2], b: {from: 0, to: 1, count: 3}}` is six cases, called
 * LABEL_a=1_b=0 and so on; where something is drawn there is one for each of the seeds, called
 * .._seed=7.  What has one value alone is not in the label. */
#include "dalembert.h"
#include "parsed_study.h"
#include "study_values.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct setting {
    const char *name;
    study_values values;
    const char *format; /* of its values in labels */
} setting;

struct study_variants {
    const document *doc;
    const yaml_node_t *start_node;
    setting *setting;
    int count, of_set; /* those of set come first */
    int drawn, start_drawn;
    setting seed;
    int combinations;
};

/* ---- reading ---- */

/* Six digits tell the values apart, or all have seventeen. */
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

/* e alone may be infinite. */
static int read_value(setting *s, const document *doc, yaml_node_t *node, const char *what)
{
    const int is_scalar = node->type == YAML_SCALAR_NODE;
    if (!is_scalar || strcmp(s->name, "e") != 0 ||
        strcmp((const char *)node->data.scalar.value, "inf") != 0)
        return study_values_read(&s->values, doc, node, what);
    s->values = (study_values){.value = cli_malloc(sizeof(double)), .count = 1};
    s->values.value[0] = INFINITY;
    return CLI_DONE;
}

static int read_settings(study_variants *v, const document *doc, yaml_node_t *node,
                         const char *what)
{
    if (!node) return CLI_DONE;
    if (node->type != YAML_MAPPING_NODE)
        return document_fail(doc, node, "%s: names and values are wanted", what);
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    for (; pair < node->data.mapping.pairs.top; pair++) {
        setting *s = &v->setting[v->count++];
        const yaml_node_t *key = document_node(doc, pair->key);
        s->name = document_scalar(doc, key, what);
        if (!s->name) return CLI_USAGE;
        for (const setting *other = s - 1; other >= v->setting + v->of_set; other--)
            if (strcmp(other->name, s->name) == 0)
                return document_fail(doc, key, "%s: '%s' comes twice", what, s->name);
        int status = read_value(s, doc, document_node(doc, pair->value), what);
        if (status != CLI_DONE) return status;
        s->format = choose_format(&s->values);
        v->drawn += s->values.is_drawn;
    }
    return CLI_DONE;
}

static int read_seeds(study_variants *v, const document *doc, const parsed_study *d)
{
    const yaml_node_t *place = d->set ? d->set : d->start;
    if (v->drawn == 0 && !d->seeds) return CLI_DONE;
    if (!d->seeds)
        return document_fail(doc, place, "what is drawn wants seeds: give a list of them");
    int status = study_values_read(&v->seed.values, doc, d->seeds, "seeds");
    if (status != CLI_DONE) return status;
    v->seed.name = "seed";
    v->seed.format = "%.17g";
    if (v->seed.values.is_drawn) return document_fail(doc, d->seeds, "seeds: not to be drawn");
    for (int i = 0; i < v->seed.values.count; i++) {
        const double seed = v->seed.values.value[i];
        if (!(seed >= 0.0 && seed <= 0x1p53) || seed != floor(seed))
            return document_fail(doc, d->seeds, "seeds: %g is not an integer in 0..2^53", seed);
    }
    return CLI_DONE;
}

static int combine(study_variants *v, const document *doc, const yaml_node_t *node)
{
    double count = v->drawn ? v->seed.values.count : 1;
    for (int i = 0; i < v->count; i++)
        if (!v->setting[i].values.is_drawn) count *= v->setting[i].values.count;
    if (count > STUDY_VALUES_MOST)
        return document_fail(doc, node, "%g combinations of values, not 1..%d", count,
                             STUDY_VALUES_MOST);
    v->combinations = (int)count;
    return CLI_DONE;
}

static size_t pairs(const yaml_node_t *node)
{
    if (!node || node->type != YAML_MAPPING_NODE) return 0;
    return (size_t)(node->data.mapping.pairs.top - node->data.mapping.pairs.start);
}

int study_variants_read(study_variants **variants, const document *doc, const parsed_study *d,
                        int *count)
{
    study_variants *v = *variants = cli_calloc(1, sizeof *v);
    v->setting = cli_calloc(pairs(d->set) + pairs(d->start) + 1, sizeof *v->setting);
    v->doc = doc;
    v->start_node = d->start;
    int status = read_settings(v, doc, d->set, "set");
    const int of_set = v->of_set = v->count, set_drawn = v->drawn;
    if (status == CLI_DONE) status = read_settings(v, doc, d->start, "start");
    v->of_set = of_set;
    v->start_drawn = v->drawn - set_drawn;
    if (status == CLI_DONE) status = read_seeds(v, doc, d);
    if (status == CLI_DONE) status = combine(v, doc, d->set ? d->set : d->start);
    *count = v->combinations;
    return status;
}

void study_variants_free(study_variants *v)
{
    if (!v) return;
    for (int i = 0; i < v->count; i++) study_values_free(&v->setting[i].values);
    study_values_free(&v->seed.values);
    free(v->setting);
    free(v);
}

/* ---- one combination ---- */

/* x' is v_x in a label, which names files. */
static void put_label(FILE *out, const setting *s, double value)
{
    const size_t length = strlen(s->name);
    const int is_velocity = length > 1 && s->name[length - 1] == '\'';
    fprintf(out, "_%s%.*s=", is_velocity ? "v_" : "", (int)(length - (size_t)is_velocity), s->name);
    fprintf(out, s->format, value);
}

/* Takes the next digit of *i, a number whose digits choose the values: the last setting's is the
 * lowest. */
static double choose(const study_values *values, int *i)
{
    const double value = values->value[*i % values->count];
    *i /= values->count;
    return value;
}

static double draw(const study_variants *v, int k, double seed)
{
    char name[256];
    const setting *s = &v->setting[k];
    snprintf(name, sizeof name, "%s:%s", k < v->of_set ? "set" : "start", s->name);
    return study_draw(name, (uint64_t)seed, s->values.low, s->values.high);
}

static void take_values(const study_variants *v, int i, dal_setting *out, double *seed)
{
    *seed = v->drawn ? choose(&v->seed.values, &i) : 0.0;
    for (int k = v->count - 1; k >= 0; k--) {
        const setting *s = &v->setting[k];
        const double value = s->values.is_drawn ? draw(v, k, *seed) : choose(&s->values, &i);
        out[k] = (dal_setting){s->name, value};
    }
}

static void make_label(const study_variants *v, const dal_setting *value, double seed,
                       study_case *e)
{
    size_t length;
    FILE *out = cli_memstream_open(&e->label, &length);
    fputs(e->group, out);
    for (int k = 0; k < v->count; k++)
        if (v->setting[k].values.count > 1) put_label(out, &v->setting[k], value[k].value);
    if (v->drawn) put_label(out, &v->seed, seed);
    cli_memstream_close(out);
}

void study_variants_apply(const study_variants *v, int i, study_case *e)
{
    double seed;
    const size_t of_set = (size_t)v->of_set, of_start = (size_t)v->count - of_set;
    e->set = cli_calloc((size_t)v->count + 1, sizeof *e->set);
    e->start = cli_calloc(of_start + 1, sizeof *e->start);
    take_values(v, i, e->set, &seed);
    memcpy(e->start, e->set + of_set, of_start * sizeof *e->start);
    e->set_count = (int)of_set;
    e->start_count = (int)of_start;
    make_label(v, e->set, seed, e);
}

/* ---- onto D = 0 ---- */

static int is_momentum(const char *name)
{
    return strncmp(name, "p_", 2) == 0 || strncmp(name, "pi_", 3) == 0;
}

/* The names x' of all velocities, one behind the other, in memory of the case. */
static const char *velocity_names(study_case *e)
{
    size_t length;
    FILE *out = cli_memstream_open(&e->names, &length);
    for (int i = 0; i < e->system->n; i++) fprintf(out, "%s'%c", e->system->coordinate[i], '\0');
    cli_memstream_close(out);
    return e->names;
}

/* All velocities become settings of the start. */
static void replace_velocities(study_case *e, const double *v)
{
    const int n = e->system->n;
    const char *name = velocity_names(e);
    dal_setting *all = cli_calloc((size_t)e->start_count + (size_t)n + 1, sizeof *all);
    memcpy(all, e->start, (size_t)e->start_count * sizeof *all);
    for (int k = 0; k < n; k++, name += strlen(name) + 1) {
        int i = 0;
        while (i < e->start_count && strcmp(all[i].name, name) != 0) i++;
        all[i] = (dal_setting){name, v[k]};
        if (i == e->start_count) e->start_count++;
    }
    free(e->start);
    e->start = all;
}

/* x[2n + ..] becomes the start with its velocities on D = 0. */
static dal_status find_velocities(const study_case *e, double *x, dal_error *error)
{
    dal_evaluator *evaluator = NULL;
    dal_setting *start = cli_calloc((size_t)e->start_count + 1, sizeof *start);
    int count = 0;
    for (int i = 0; i < e->start_count; i++)
        if (!is_momentum(e->start[i].name)) start[count++] = e->start[i];
    dal_status status = dal_evaluator_create(&evaluator, e->system, e->set, e->set_count, error);
    if (status == DAL_OK) status = dal_evaluator_start(evaluator, start, count, x, error);
    if (status == DAL_OK) status = dal_project_velocity(evaluator, 0.0, x, x + e->system->n);
    dal_evaluator_free(evaluator);
    free(start);
    return status;
}

int study_variants_project_start(const study_variants *v, study_case *e)
{
    dal_error error = {0};
    if (v->start_drawn == 0 || e->system->m == 0) return CLI_DONE;
    double *x = cli_calloc(2 * (size_t)e->system->n + (size_t)e->system->m + 1, sizeof *x);
    const dal_status found = find_velocities(e, x, &error);
    int status = CLI_DONE;
    if (!cli_is_ok(found))
        status = document_fail(v->doc, v->start_node, "%s: no start on D = 0 was found: %s",
                               e->label, error.message[0] ? error.message : dal_status_text(found));
    else
        replace_velocities(e, x + e->system->n);
    free(x);
    return status;
}
