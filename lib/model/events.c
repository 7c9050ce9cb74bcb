/* events.c - the events of a model: when they happen and what they do.
 *
 * For each event with the formula f(q,v,t) of `when`: f itself, its rate f_t + f_q v + f_v F, the
 * state (q, v) that `set` gives, which is the present one where it says nothing, and for an impact
 * the restitution c, the normal f_q and W^-1 f_q. */
#include "model/events.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/motion.h"
#include "model/symbols.h"
#include <math.h>
#include <string.h>

enum { IN_MESSAGES = 60 /* characters of a formula */ };

#define KEY_LIST(KEY)                                                                              \
    KEY(WHEN, "when")                                                                              \
    KEY(DIRECTION, "direction")                                                                    \
    KEY(SET, "set") KEY(RESTITUTION, "restitution") KEY(STOP, "stop") KEY(FOR, "for")
enum {
#define CODE(code, word) KEY_##code,
    KEY_LIST(CODE) KEYS
#undef CODE
};

/* What the formulas of events may contain. */
static dal__scope everything(const dal__equations *e)
{
    return dal__scope_of(e, DAL__MAY_T | DAL__MAY_STATE | DAL__MAY_REACTIONS);
}

static dal_status parse_entry(dal_model *model, const dal__entry *entry, unsigned *seen,
                              dal_error *error)
{
#define WORD(code, word) word,
    static const char *const keys[] = {KEY_LIST(WORD)};
#undef WORD
    static const char *const directions[] = {"down", "both", "up"}, *const truths[] = {"false",
                                                                                       "true"};
    dal__equations *e = &model->equations;
    const int number = entry->item - 1;
    dal_event *event = &e->event[number];
    int key = KEY_SET, i = 0;
    const char *const name = dal__set_name(entry);
    if (!name)
        DAL_TRY(dal__find_word(entry->name, DAL__AT_NAME(entry), "key of an event", keys, KEYS,
                               &key, error));
    seen[number] |= 1u << key;
    switch (key) {
    case KEY_WHEN:
        return dal__parse_entry(model, entry, everything(e), &e->event_value[number], error);
    case KEY_DIRECTION:
        DAL_TRY(dal__find_word(entry->text, DAL__AT_TEXT(entry), "direction", directions, 3, &i,
                               error));
        event->direction = i - 1;
        return DAL_STATUS_OK;
    case KEY_RESTITUTION:
        event->actions |= DAL_EVENT_IMPACT;
        return dal__parse_entry(model, entry, everything(e),
                                &e->event_normal[number * (1 + 2 * e->n)], error);
    case KEY_STOP:
        DAL_TRY(dal__find_word(entry->text, DAL__AT_TEXT(entry), "value of stop", truths, 2, &i,
                               error));
        if (i) event->actions |= DAL_EVENT_STOPS;
        return DAL_STATUS_OK;
    case KEY_FOR: /* expand.c has made the events of it */
        return DAL_STATUS_OK;
    default:
        if (!name)
            return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_NAME(entry),
                                "set is given by coordinate, as %d.set.x", entry->item);
        const size_t length = strlen(name);
        const bool velocity = length > 0 && name[length - 1] == '\'';
        i = dal__index_of(name, length - velocity, e->coordinate, e->n);
        if (i < 0)
            return dal__unknown_at(error, DAL__AT_NAME(entry), "coordinate in set", name,
                                   e->coordinate, e->n);
        event->actions |= DAL_EVENT_SETS | (velocity ? DAL_EVENT_TURNS : 0u);
        return dal__parse_entry(model, entry, everything(e),
                                &e->event_state[(2 * number + velocity) * e->n + i], error);
    }
}

/* ---- all ---- */

/* The entry of an event with a name; any of it where the name is NULL. */
static const dal__entry *find_entry(const dal_model *model, int item, const char *name)
{
    const dal__entry *entry;
    for (int k = 0; (entry = dal__model_entry(model, DAL_SECTION_EVENTS, k)) != NULL; k++)
        if (entry->item == item && (!name || strcmp(entry->name, name) == 0)) return entry;
    return NULL;
}

/* Checks an event and makes its name, "event 1 (y - r)", on one line. */
static dal_status check_event(dal_model *model, int number, unsigned seen, dal_error *error)
{
    const dal__equations *e = &model->equations;
    const dal__entry *when = find_entry(model, number + 1, "when");
    const dal__entry *any = find_entry(model, number + 1, NULL);
    const int line = any ? any->name_line : 0, column = any ? any->name_column : 0;
    if (!when)
        return dal__fail_at(error, DAL_STATUS_MODEL, line, column, "event %d has no 'when'",
                            number + 1);
    if (seen & 1u << KEY_SET && seen & 1u << KEY_RESTITUTION)
        return dal__fail_at(error, DAL_STATUS_MODEL, line, column,
                            "event %d has both 'set' and 'restitution'", number + 1);
    const char *dots = strlen(when->text) > IN_MESSAGES ? "..." : "";
    char *name = when->index
                     ? dal__model_print(model, "event %d (%.*s%s, %s = %d)", number + 1,
                                        (int)IN_MESSAGES, when->text, dots, when->index, when->at)
                     : dal__model_print(model, "event %d (%.*s%s)", number + 1, (int)IN_MESSAGES,
                                        when->text, dots);
    if (!name) return DAL_STATUS_OK;
    for (char *c = name; *c; c++)
        if ((unsigned char)*c < ' ') *c = ' ';
    e->event[number].name = name;
    return DAL_STATUS_OK;
}

dal_status dal__parse_events(dal_model *model, dal_error *error)
{
    unsigned seen[DAL__MAX_EVENTS] = {0};
    dal__equations *e = &model->equations;
    const dal__entry *entry;
    e->events = 0;
    for (int k = 0; (entry = dal__model_entry(model, DAL_SECTION_EVENTS, k)) != NULL; k++)
        if (entry->item > e->events) e->events = entry->item;
    if (e->events > DAL__MAX_EVENTS)
        return dal__fail(error, DAL_STATUS_TOO_LARGE, "%d events; at most %d are possible",
                         e->events, (int)DAL__MAX_EVENTS);
    const dal__node zero = dal__number(e->graph, 0.0);
    e->event = dal__model_allocate(model, (size_t)e->events, sizeof *e->event);
    e->event_value = dal__model_nodes(model, e->events, zero);
    e->event_rate = dal__model_nodes(model, e->events, zero);
    e->event_state = dal__model_nodes(model, 2 * e->n * e->events, zero);
    e->event_normal = dal__model_nodes(model, (1 + 2 * e->n) * e->events, zero);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < 2 * e->n * e->events; i++) {
        const int j = i % (2 * e->n);
        e->event_state[i] = dal__symbol(e->graph, j < e->n ? e->q + j : e->v + j - e->n);
    }
    for (int k = 0; (entry = dal__model_entry(model, DAL_SECTION_EVENTS, k)) != NULL; k++)
        DAL_TRY(parse_entry(model, entry, seen, error));
    for (int i = 0; i < e->events; i++) DAL_TRY(check_event(model, i, seen[i], error));
    return DAL_STATUS_OK;
}

/* ---- derived ---- */

dal_status dal__derive_events(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    for (int k = 0; k < e->events; k++) {
        const dal__node f = e->event_value[k];
        const dal__entry *entry = find_entry(model, k + 1, "when");
        if (!dal__depends(e->graph, f, e->parameters, e->symbols))
            return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(entry),
                                "event %d, when: it does not change along a run", k + 1);
        dal__node *normal = e->event_normal + (size_t)k * (1 + 2 * (size_t)e->n) + 1;
        dal__node rate = dal__time_derivative(e, f);
        const dal__node along = dal__tangent(e->graph, f, e->symbol + e->v, e->n, e->F);
        e->event_rate[k] = dal__node_add(e->graph, rate, along);
        dal__gradient(e->graph, f, e->symbol + e->q, e->n, normal);
        if (!(e->event[k].actions & DAL_EVENT_IMPACT)) continue;
        entry = find_entry(model, k + 1, "restitution");
        bool moves = false, is_steady = true;
        for (int i = 0; i < e->n; i++)
            moves = moves || dal__depends(e->graph, f, e->q + i, e->q + i + 1);
        for (int i = 0; i < e->n * e->n; i++)
            is_steady = is_steady && !dal__depends(e->graph, e->W[i], e->v, e->v + e->n);
        const bool has_v = dal__depends(e->graph, f, e->v, e->v + e->n);
        const char *reason = e->vakonomic ? "vakonomic motion has no impacts"
                             : e->servo   ? "an actuator (reactions) has no impulses"
                             : has_v      ? "its 'when' contains velocities"
                             : !moves     ? "its 'when' contains no coordinates"
                             : !is_steady ? "the mass matrix contains velocities"
                                          : NULL;
        if (reason)
            return dal__fail_at(error, DAL_STATUS_UNSUPPORTED, DAL__AT_NAME(entry),
                                "event %d cannot have a restitution: %s", k + 1, reason);
        const bool varies = dal__depends(e->graph, normal[-1], e->parameters, e->symbols);
        const double c = varies ? 0.0 : dal__evaluate(e->graph, normal[-1], e->value);
        if (!isfinite(c)) return dal__not_finite(model, entry, error);
        if (c < 0.0)
            return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(entry),
                                "event %d: the restitution %g is negative", k + 1, c);
        dal__solve_force(model, normal, normal + e->n);
    }
    return DAL_STATUS_OK;
}
