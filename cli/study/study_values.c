/* study_values.c - one value, a list, a range, a draw.
 *
 * Value k of a range {from: a, to: b, count: n} is a + k (b - a)/(n - 1), the last exactly b; of
 * {from: a, to: b, by: d} it is a + k d, as long as that is not beyond b by more than d/1e9.
 *
 * A draw needs no state: SplitMix64 (Steele, Lea, Flood 2014, doi 10.1145/2660193.2660195) mixes
 *     z = FNV-1a(name) + seed 0x9e3779b97f4a7c15    (mod 2^64)
 * and the upper 53 bits u of the result give low + (high - low) u/2^53.  So what is drawn for one
 * name does not depend on what else is drawn. */
#include "study_values.h"

#include "io/file.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double beyond = 1e-9; /* parts of a step by which a range may miss its end */

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
    v->is_drawn = 1;
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
    const int has_by = !isnan(r->by);
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
    return document_fail(doc, node, "%s: between goes with nothing else", what);
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

double study_draw(const char *name, uint64_t seed, double low, double high)
{
    uint64_t z = file_hash(FILE_HASH_START, name, strlen(name));
    z += seed * UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    z ^= z >> 31;
    return low + (high - low) * ((double)(z >> 11) * 0x1p-53);
}
