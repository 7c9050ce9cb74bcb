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

enum { RANGE_from, RANGE_to, RANGE_count, RANGE_by, RANGE_PARTS };

typedef struct range {
    double part[RANGE_PARTS];
    int has[RANGE_PARTS];
    study_values *values;
} range;

static int take_part(range *r, int part, const char *name, const document *doc, yaml_node_t *value)
{
    r->has[part] = 1;
    return document_number(doc, value, name, &r->part[part]);
}

#define TAKE(name)                                                                                 \
    static int take_##name(void *user, const document *doc, yaml_node_t *value)                    \
    {                                                                                              \
        return take_part(user, RANGE_##name, #name, doc, value);                                   \
    }
TAKE(from)
TAKE(to)
TAKE(count)
TAKE(by)

static int take_between(void *user, const document *doc, yaml_node_t *value)
{
    study_values *v = ((range *)user)->values;
    if (value->type != YAML_SEQUENCE_NODE || document_count(value) != 2)
        return document_fail(doc, value, "between: two numbers are wanted, [LOW, HIGH]");
    int status = document_number(doc, document_item(doc, value, 0), "between", &v->low);
    if (status == CLI_DONE)
        status = document_number(doc, document_item(doc, value, 1), "between", &v->high);
    if (status == CLI_DONE && !(v->low < v->high))
        return document_fail(doc, value, "between: %g is not below %g", v->low, v->high);
    v->is_drawn = 1;
    return status;
}

static const document_key range_keys[] = {{"from", take_from},
                                          {"to", take_to},
                                          {"count", take_count},
                                          {"by", take_by},
                                          {"between", take_between}};

static void make_room(study_values *v, int count)
{
    v->value = cli_calloc((size_t)count, sizeof *v->value);
    v->count = count;
}

/* How many values there are; 0 when the parts do not make a range. */
static int range_count(const range *r)
{
    const double distance = r->part[RANGE_to] - r->part[RANGE_from];
    const double count = r->has[RANGE_by] ? floor(distance / r->part[RANGE_by] + beyond) + 1.0
                                          : r->part[RANGE_count];
    if (!(count >= 1.0 && count <= STUDY_VALUES_MOST) || count != floor(count)) return 0;
    return count == 1.0 && !r->has[RANGE_by] && distance != 0.0 ? 0 : (int)count;
}

static int make_range(const range *r, const document *doc, const yaml_node_t *node,
                      const char *what)
{
    study_values *v = r->values;
    const double a = r->part[RANGE_from], b = r->part[RANGE_to];
    if (!r->has[RANGE_from] || !r->has[RANGE_to] || r->has[RANGE_count] == r->has[RANGE_by])
        return document_fail(doc, node, "%s: a range is {from:, to:, count:} or {from:, to:, by:}",
                             what);
    const int count = range_count(r);
    if (count == 0)
        return document_fail(doc, node, "%s: this range does not have 1..%d values", what,
                             STUDY_VALUES_MOST);
    make_room(v, count);
    for (int k = 0; k < count; k++)
        v->value[k] = r->has[RANGE_by] ? a + k * r->part[RANGE_by]
                      : k == count - 1 ? b
                                       : a + k * (b - a) / (count - 1);
    return CLI_DONE;
}

static int read_range(study_values *v, const document *doc, yaml_node_t *node, const char *what)
{
    range r = {.values = v};
    const int count = sizeof range_keys / sizeof range_keys[0];
    int status = document_read_mapping(doc, node, what, range_keys, count, &r);
    if (status != CLI_DONE) return status;
    const int parts = r.has[RANGE_from] + r.has[RANGE_to] + r.has[RANGE_count] + r.has[RANGE_by];
    if (!v->is_drawn) return make_range(&r, doc, node, what);
    if (parts == 0) return CLI_DONE;
    return document_fail(doc, node, "%s: between goes with nothing else", what);
}

/* ---- the whole ---- */

int study_values_read(study_values *v, const document *doc, yaml_node_t *node, const char *what)
{
    *v = (study_values){0};
    if (node->type == YAML_MAPPING_NODE) return read_range(v, doc, node, what);
    const int count = document_count(node);
    if (count == 0) return document_fail(doc, node, "%s: the list is empty", what);
    if (count > STUDY_VALUES_MOST)
        return document_fail(doc, node, "%s: %d values, not 1..%d", what, count, STUDY_VALUES_MOST);
    int status = CLI_DONE;
    make_room(v, count);
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
