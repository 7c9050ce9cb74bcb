/* expand.c - entries that stand for many: sizes, indices, ranges. */
#include "model/expand.h"
#include "expr/lexer.h"
#include "expr/parser.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_EXPANDED = 1 << 16, MAX_SIZE = 1000000 };

/* A name of an index, and the numbers from first to last. */
typedef struct range {
    const char *index;
    int first, last;
} range;

/* What the whole numbers of brackets and ranges may contain. */
typedef struct scope {
    const dal_model *model;
    dal__graph *graph;
    const char *index; /* or NULL */
    int at;
} scope;

/* How many letters of a text messages show. */
static int shown(size_t length) { return length < 60 ? (int)length : 60; }

/* The name of a coordinate, or of an entry; NULL: it has none. */
static const char *indexed_name(const dal__entry *entry)
{
    return entry->section == DAL_SECTION_COORDINATES ? entry->text : entry->name;
}

/* ---- whole numbers ---- */

static dal__node resolve_size(void *user, const char *name, size_t length, bool prime,
                              dal_error *error)
{
    const scope *s = user;
    const dal__equations *e = &s->model->equations;
    if (s->index && !prime && strlen(s->index) == length && memcmp(s->index, name, length) == 0)
        return dal__number(s->graph, s->at);
    for (int i = 0; i < e->sizes && !prime; i++)
        if (strlen(e->size_name[i]) == length && memcmp(e->size_name[i], name, length) == 0)
            return dal__number(s->graph, e->size[i]);
    dal__fail(error, DAL_STATUS_NAME, "'%.*s' is no size%s", shown(length), name,
              s->index ? " and no index" : "");
    return 0;
}

/* The whole number that length letters of text give. */
static dal_status whole_number(dal_model *model, const dal__entry *entry, const range *index,
                               int at, const char *text, size_t length, int *n, dal_error *error)
{
    scope s = {.model = model, .index = index ? index->index : NULL, .at = at};
    const dal__names names = {.resolve = resolve_size, .user = &s};
    dal_error inner = {.status = DAL_STATUS_OK};
    dal__node node = 0;
    s.graph = dal__graph_create(0);
    if (!s.graph) return dal__memory_error(error);
    const dal_status status = dal__parse(s.graph, text, length, &names, &node, &inner);
    const dal__record r = dal__inspect(s.graph, node);
    dal__graph_free(s.graph);
    if (status == DAL_STATUS_MEMORY) return dal__memory_error(error);
    if (status != DAL_STATUS_OK)
        return dal__fail_at(error, status, DAL__AT_NAME(entry), "%.*s: %s", shown(length), text,
                            inner.message);
    const bool whole = r.op == DAL__NUMBER && r.value == floor(r.value) && r.value >= 0.0;
    if (!whole || r.value > MAX_SIZE)
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(entry),
                            "'%.*s' is not a whole number from 0 to %d", shown(length), text,
                            (int)MAX_SIZE);
    *n = (int)r.value;
    return DAL_STATUS_OK;
}

static dal_status read_sizes(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    const int count = dal__model_count(model, DAL_SECTION_SIZES);
    e->size_name = dal__model_allocate(model, (size_t)count + 1, sizeof *e->size_name);
    e->size = dal__model_allocate(model, (size_t)count + 1, sizeof *e->size);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < count; i++) {
        const dal__entry *entry = dal__model_entry(model, DAL_SECTION_SIZES, i);
        const size_t length = strlen(entry->text);
        DAL_TRY(whole_number(model, entry, NULL, 0, entry->text, length, &e->size[i], error));
        e->size_name[e->sizes++] = entry->name;
    }
    return DAL_STATUS_OK;
}

/* ---- ranges ---- */

/* "a..b" in length letters. */
static dal_status read_range(dal_model *model, const dal__entry *entry, const char *text,
                             size_t length, range *r, dal_error *error)
{
    const char *dots = strstr(text, "..");
    if (!dots || dots >= text + length)
        return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_NAME(entry),
                            "'%.*s' is not a range, as 1..N", shown(length), text);
    const size_t left = (size_t)(dots - text);
    DAL_TRY(whole_number(model, entry, NULL, 0, text, left, &r->first, error));
    return whole_number(model, entry, NULL, 0, dots + 2, length - left - 2, &r->last, error);
}

/* The length of "for i = 1..N:" and the blanks after it, with which a text begins; or 0. */
static size_t range_length(const char *text)
{
    static const char word[] = "for";
    const char *at = text + strspn(text, " \t\r\n");
    if (strncmp(at, word, sizeof word - 1) != 0) return 0;
    at += sizeof word - 1;
    const size_t blanks = strspn(at, " \t\r\n"),
                 name = dal__name_length(at + blanks, strlen(at) - blanks);
    const char *end = strchr(at, ':');
    if (blanks == 0 || name == 0 || !end) return 0;
    end++;
    return (size_t)(end + strspn(end, " \t\r\n") - text);
}

/* "for i = 1..N:" */
static dal_status read_for(dal_model *model, const dal__entry *entry, range *r, dal_error *error)
{
    const char *at = entry->text + strspn(entry->text, " \t\r\n") + 3;
    at += strspn(at, " \t\r\n");
    const size_t length = dal__name_length(at, strlen(at));
    r->index = dal__model_copy(model, at, length);
    if (!r->index) return DAL_STATUS_OK;
    at += length + strspn(at + length, " \t\r\n");
    if (*at != '=')
        return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_TEXT(entry),
                            "a range is written for i = 1..N");
    return read_range(model, entry, at + 1, strcspn(at + 1, ":"), r, error);
}

/* ---- entries ---- */

static dal_status append(dal_model *model, dal__entry entry, dal_error *error)
{
    if (model->expanded_count == MAX_EXPANDED)
        return dal__fail_at(error, DAL_STATUS_TOO_LARGE, DAL__AT_NAME(&entry),
                            "the indices make more than %d entries", (int)MAX_EXPANDED);
    if (model->expanded_count == model->expanded_capacity) {
        const int capacity = model->expanded_capacity ? 2 * model->expanded_capacity : 256;
        dal__entry *more = dal__model_allocate(model, (size_t)capacity, sizeof *more);
        if (!more) return DAL_STATUS_OK;
        for (int i = 0; i < model->expanded_count; i++) more[i] = model->expanded[i];
        model->expanded = more;
        model->expanded_capacity = capacity;
    }
    model->expanded[model->expanded_count++] = entry;
    return DAL_STATUS_OK;
}

/* The name of an entry, or of a coordinate, with number n for its bracket, text[length]. */
static dal_status put_name(dal_model *model, dal__entry *entry, const char *bracket, size_t length,
                           int n, dal_error *error)
{
    const bool named = entry->name != NULL;
    const char *text = named ? entry->name : entry->text;
    const char *name =
        dal__model_print(model, "%.*s%d%s", (int)(bracket - text), text, n, bracket + length);
    if (!name) return DAL_STATUS_OK;
    if (strlen(name) > DAL__MAX_LETTERS)
        return dal__fail_at(error, DAL_STATUS_TOO_LARGE, DAL__AT_NAME(entry),
                            "'%.40s...' in %s has more than %d characters", name,
                            dal__section_name(entry->section), (int)DAL__MAX_LETTERS);
    *(named ? &entry->name : &entry->text) = name;
    return DAL_STATUS_OK;
}

/* All entries that one means: of a range in its name, and of its index. */
static dal_status expand_entry(dal_model *model, const dal__entry *given, dal_error *error)
{
    const char *name = indexed_name(given), *open = name ? strchr(name, '[') : NULL;
    const size_t skip = dal__sections[given->section].label ? range_length(given->text) : 0;
    const size_t length = open ? strcspn(open, "]") + 1 : 0;
    range r = {.last = 0};
    dal__entry entry = *given;
    if (given->observed) return append(model, entry, error); /* the name is a formula */
    if (skip) DAL_TRY(read_for(model, given, &r, error));
    entry.text += skip;
    if (skip && !given->apart) entry.column += (int)skip;
    const char *const dots = open ? strstr(open, "..") : NULL;
    const bool by_name = dots && dots < open + length;
    if (by_name && skip)
        return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_NAME(given),
                            "'%.80s' has a range, and its formula another one", name);
    if (by_name) DAL_TRY(read_range(model, given, open + 1, length - 2, &r, error));
    for (int i = r.first; i <= r.last; i++) {
        int n = i;
        dal__entry made = entry;
        made.index = skip ? r.index : NULL;
        made.at = i;
        if (open && !by_name)
            DAL_TRY(
                whole_number(model, given, skip ? &r : NULL, i, open + 1, length - 2, &n, error));
        if (open) DAL_TRY(put_name(model, &made, open, length, n, error));
        DAL_TRY(append(model, made, error));
    }
    return DAL_STATUS_OK;
}

/* ---- events ---- */

/* An event as it is given: the events that it means, from number `first` on. */
typedef struct event_range {
    range r;
    bool is_many; /* it has a range */
    int first, count;
} event_range;

static bool is_event_range(const dal__entry *entry)
{
    return entry->section == DAL_SECTION_EVENTS && strcmp(entry->name, "for") == 0;
}

/* Reads the ranges of events[items]. */
static dal_status read_event_ranges(dal_model *model, event_range *events, int items,
                                    dal_error *error)
{
    int next = 1;
    for (int k = 0; k < items; k++) events[k].count = 1;
    for (int k = 0; k < model->given_count; k++) {
        dal__entry entry = model->given[k];
        event_range *event = entry.item > 0 ? &events[entry.item - 1] : NULL;
        if (!is_event_range(&entry)) continue;
        entry.text = dal__model_print(model, "for %s:", entry.text);
        if (!entry.text) return DAL_STATUS_OK;
        if (!range_length(entry.text))
            return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_TEXT(&entry),
                                "the range of an event is written i = 1..N");
        DAL_TRY(read_for(model, &entry, &event->r, error));
        event->is_many = true;
        event->count = event->r.last < event->r.first ? 0 : event->r.last - event->r.first + 1;
        if (event->count > DAL__MAX_EVENTS)
            return dal__fail_at(error, DAL_STATUS_TOO_LARGE, DAL__AT_TEXT(&entry),
                                "%d events; at most %d are possible", event->count,
                                (int)DAL__MAX_EVENTS);
    }
    for (int k = 0; k < items; k++) {
        events[k].first = next;
        next += events[k].count;
    }
    return DAL_STATUS_OK;
}

/* An entry of an event for each number of its range. */
static dal_status expand_event(dal_model *model, const dal__entry *given, const event_range *event,
                               dal_error *error)
{
    if (is_event_range(given) || model->out_of_memory) return DAL_STATUS_OK;
    if (event->is_many && range_length(given->text) > 0)
        return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_NAME(given),
                            "the event has a range, and '%.80s' another one", given->name);
    for (int i = 0; i < event->count; i++) {
        dal__entry made = *given;
        made.item = event->first + i;
        if (event->is_many) {
            made.text = dal__model_print(model, "for %s = %d..%d: %s", event->r.index,
                                         event->r.first + i, event->r.first + i, given->text);
            made.apart = true;
        }
        if (!made.text) return DAL_STATUS_OK;
        DAL_TRY(expand_entry(model, &made, error));
    }
    return DAL_STATUS_OK;
}

/* ---- all ---- */

/* Two entries of one name may come from one range each. */
static dal_status check_duplicates(const dal_model *model, dal_error *error)
{
    for (int i = 0; i < model->expanded_count; i++) {
        const dal__entry *entry = &model->expanded[i];
        const char *name = indexed_name(entry);
        for (int k = 0; name && k < i; k++) {
            const dal__entry *other = &model->expanded[k];
            if (other->section != entry->section || other->item != entry->item) continue;
            if (strcmp(indexed_name(other), name) == 0) return dal__duplicate(entry, error);
        }
    }
    return DAL_STATUS_OK;
}

/* Whether an entry means others. */
static bool is_compact(const dal__entry *entry)
{
    const bool is_formula = dal__sections[entry->section].label != NULL;
    const bool may_index = is_formula || entry->section == DAL_SECTION_COORDINATES;
    const char *name = may_index ? indexed_name(entry) : NULL;
    return (name && strchr(name, '[')) || (is_formula && range_length(entry->text) > 0) ||
           is_event_range(entry);
}

dal_status dal__expand(dal_model *model, dal_error *error)
{
    bool compact = false;
    int items = 0;
    model->entries = model->given;
    model->count = model->given_count;
    DAL_TRY(read_sizes(model, error));
    for (int i = 0; i < model->given_count; i++) {
        compact |= is_compact(&model->given[i]);
        items = items < model->given[i].item ? model->given[i].item : items;
    }
    if (!compact) return DAL_STATUS_OK;
    event_range *events = dal__model_allocate(model, (size_t)items, sizeof *events);
    if (!events) return DAL_STATUS_OK;
    DAL_TRY(read_event_ranges(model, events, items, error));
    model->expanded_count = 0;
    for (int i = 0; i < model->given_count; i++) {
        const dal__entry *given = &model->given[i];
        DAL_TRY(given->section == DAL_SECTION_EVENTS
                    ? expand_event(model, given, &events[given->item - 1], error)
                : is_compact(given) ? expand_entry(model, given, error)
                                    : append(model, *given, error));
    }
    DAL_TRY(check_duplicates(model, error));
    model->entries = model->expanded;
    model->count = model->expanded_count;
    return DAL_STATUS_OK;
}
