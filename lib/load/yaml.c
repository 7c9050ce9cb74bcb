/* yaml.c - reads a system file: a mapping of the sections of DAL_SECTION_LIST, read event by event
 * with libyaml.  Nothing nests deeper than a section, so no recursion is needed.
 *
 * A formula is a verbatim piece of the file, with its line breaks, so that line and column inside
 * the formula count in the file, too.  In single quotes '' becomes "' ", which means the same to a
 * formula and is as long.  Only double quotes with escapes and texts that are no formulas are used
 * as libyaml unfolds them. */
#include "load/file.h"
#include "load/tables.h"
#include "model/model.h"
#include "model/symbols.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

typedef struct reader {
    yaml_parser_t parser;
    yaml_event_t event; /* the present one */
    bool holding;       /* event is to be deleted */
    const char *text;
    size_t length;
    size_t first; /* where the mapping begins */
    dal__table_request *tables, **last_table;
    dal_model *model;
    size_t byte, character; /* the same place, counted both ways */
    unsigned seen;          /* sections, a bit each */
    dal_error *error;
} reader;

/* ---- events ---- */

static int line_of(yaml_mark_t mark) { return (int)mark.line + 1; }
static int column_of(yaml_mark_t mark) { return (int)mark.column + 1; }

/* Line and column of a byte, from 1. */
static void find_place(const char *text, size_t offset, int *line, int *column)
{
    *line = *column = 1;
    for (size_t i = 0; i < offset; i++) {
        *column = text[i] == '\n' ? 1 : *column + 1;
        *line += text[i] == '\n';
    }
}

static dal_status parser_error(reader *r)
{
    const yaml_parser_t *p = &r->parser;
    const char *problem = p->problem ? p->problem : "malformed";
    if (p->error == YAML_MEMORY_ERROR) return dal__memory_error(r->error);
    if (p->error != YAML_READER_ERROR)
        return dal__fail_at(r->error, DAL_STATUS_SYNTAX, line_of(p->problem_mark),
                            column_of(p->problem_mark), "malformed YAML: %s", problem);
    int line, column;
    find_place(r->text, p->problem_offset < r->length ? p->problem_offset : r->length, &line,
               &column);
    return dal__fail_at(r->error, DAL_STATUS_SYNTAX, line, column, "malformed YAML: %s", problem);
}

/* An error at the present event. */
#define HERE(r, status, ...)                                                                       \
    dal__fail_at((r)->error, status, line_of((r)->event.start_mark),                               \
                 column_of((r)->event.start_mark), __VA_ARGS__)

/* An anchor is the first member of all events that may have one. */
static bool has_anchor(const yaml_event_t *event)
{
    const bool may_have = event->type == YAML_ALIAS_EVENT || event->type == YAML_SCALAR_EVENT ||
                          event->type == YAML_SEQUENCE_START_EVENT ||
                          event->type == YAML_MAPPING_START_EVENT;
    return may_have && event->data.scalar.anchor != NULL;
}

static dal_status next(reader *r)
{
    if (r->holding) yaml_event_delete(&r->event);
    r->holding = yaml_parser_parse(&r->parser, &r->event);
    if (!r->holding) return parser_error(r);
    if (has_anchor(&r->event))
        return HERE(r, DAL_STATUS_SYNTAX, "anchors and aliases are not supported");
    return DAL_STATUS_OK;
}

/* ---- scalars ---- */

/* Byte offset of a mark: libyaml counts characters.  Marks come in order, so it counts on from the
 * last one. */
static size_t offset_of(reader *r, yaml_mark_t mark)
{
    while (r->byte < r->length && r->character < mark.index) {
        r->byte++;
        const bool end = r->byte == r->length;
        r->character += end || ((unsigned char)r->text[r->byte] & 0xC0) != 0x80; /* UTF-8 */
    }
    return r->byte;
}

/* Controls but line ends and tabs, U+0000..001F, 007F..009F, which change the state of a terminal:
 * formulas have no use for them, and texts are shown. */
static dal_status check_characters(reader *r)
{
    const unsigned char *text = r->event.data.scalar.value;
    const size_t length = r->event.data.scalar.length;
    for (size_t i = 0; i < length; i++) {
        const bool is_c1 = text[i] == 0xc2 && i + 1 < length && text[i + 1] < 0xa0; /* UTF-8 */
        const unsigned code = is_c1 ? text[i + 1] : text[i];
        if (code == 0) return HERE(r, DAL_STATUS_SYNTAX, "a text holds a NUL character");
        if (is_c1 || code == 0x7f || (code < ' ' && !strchr("\t\n\r", (int)code)))
            return HERE(r, DAL_STATUS_SYNTAX, "a text holds the control character U+%04X", code);
    }
    return DAL_STATUS_OK;
}

/* Text and place of the present scalar. */
static dal_status read_scalar(reader *r, dal__entry *entry)
{
    const yaml_event_t *event = &r->event;
    const char *value = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    yaml_scalar_style_t style = event->data.scalar.style;
    size_t begin = offset_of(r, event->start_mark), end = offset_of(r, event->end_mark);
    const bool prose = dal__sections[entry->section].label == NULL;
    bool single = style == YAML_SINGLE_QUOTED_SCALAR_STYLE;
    bool quoted = single || style == YAML_DOUBLE_QUOTED_SCALAR_STYLE;
    entry->line = line_of(event->start_mark);
    entry->column = column_of(event->start_mark) + quoted;
    DAL_TRY(check_characters(r));
    bool escaped = quoted && !single && memchr(r->text + begin, '\\', end - begin);
    if (prose || escaped || end < begin + 2 * (size_t)quoted) {
        entry->text = dal__model_copy(r->model, value, length);
    } else {
        if (style == YAML_LITERAL_SCALAR_STYLE || style == YAML_FOLDED_SCALAR_STYLE) {
            /* A block scalar begins below its indicator, at the first column. */
            while (begin < end && r->text[begin] != '\n') ++begin;
            if (begin < end) ++begin;
            entry->line++;
            entry->column = 1;
        }
        const size_t inside = end - begin - 2 * (size_t)quoted;
        char *text = dal__model_copy(r->model, r->text + begin + quoted, inside);
        for (char *c = text; c && single && (c = strstr(c, "''")) != NULL; c += 2) c[1] = ' ';
        entry->text = text;
    }
    return entry->text ? DAL_STATUS_OK : dal__memory_error(r->error);
}

static dal_status read_key(reader *r, dal__entry *entry)
{
    const char *value = (const char *)r->event.data.scalar.value;
    size_t length = r->event.data.scalar.length;
    if (r->event.type != YAML_SCALAR_EVENT)
        return HERE(r, DAL_STATUS_SYNTAX, "a name is expected here");
    DAL_TRY(check_characters(r));
    entry->name = dal__model_copy(r->model, value, length);
    entry->name_line = line_of(r->event.start_mark);
    entry->name_column = column_of(r->event.start_mark);
    return entry->name ? DAL_STATUS_OK : dal__memory_error(r->error);
}

/* ---- sections ---- */

static dal_status wrong_form(reader *r, dal_section section)
{
    static const char *const forms[] = {[DAL__FORM_SCALAR] = "one text",
                                        [DAL__FORM_LIST] = "a list",
                                        [DAL__FORM_MAPPING] = "a mapping of names",
                                        [DAL__FORM_MAPPINGS] = "a list of mappings"};
    return HERE(r, DAL_STATUS_SYNTAX, "%s must be %s", dal__section_name(section),
                forms[dal__sections[section].form]);
}

/* A mapping {for: i = 1..N, is: formula}, which becomes the text "for i = 1..N: formula". */
static dal_status read_range(reader *r, dal__entry entry)
{
    const int line = line_of(r->event.start_mark), column = column_of(r->event.start_mark);
    dal__entry range = {.section = entry.section};
    entry.text = NULL;
    for (;;) {
        dal__entry key = {.section = entry.section};
        DAL_TRY(next(r));
        if (r->event.type == YAML_MAPPING_END_EVENT) break;
        DAL_TRY(read_key(r, &key));
        const bool is_formula = strcmp(key.name, "is") == 0;
        if (!is_formula && strcmp(key.name, "for") != 0) break;
        if ((is_formula ? &entry : &range)->text)
            return dal__fail_at(r->error, DAL_STATUS_MODEL, DAL__AT_NAME(&key),
                                "duplicate key '%s'", key.name);
        DAL_TRY(next(r));
        if (r->event.type != YAML_SCALAR_EVENT) break;
        DAL_TRY(read_scalar(r, is_formula ? &entry : &range));
    }
    if (r->event.type != YAML_MAPPING_END_EVENT || !entry.text || !range.text)
        return dal__fail_at(r->error, DAL_STATUS_SYNTAX, line, column,
                            "a text is expected in %s, or {for: i = 1..N, is: \"formula in i\"}",
                            dal__section_name(entry.section));
    entry.text = dal__model_print(r->model, "for %s: %s", range.text, entry.text);
    if (!entry.text) return dal__memory_error(r->error);
    entry.apart = true;
    if (!entry.name) {
        entry.name_line = range.line;
        entry.name_column = range.column;
    }
    return dal__model_insert(r->model, entry, r->error);
}

/* A mapping {file: data.csv, at: t, value: M}. */
static dal_status read_table(reader *r, dal__entry entry)
{
    dal__table_request *table = dal__model_allocate(r->model, 1, sizeof *table);
    if (!table) return dal__memory_error(r->error);
    entry.line = line_of(r->event.start_mark);
    entry.column = column_of(r->event.start_mark);
    table->entry = entry;
    *r->last_table = table;
    r->last_table = &table->next;
    for (;;) {
        dal__entry key = {.section = entry.section};
        DAL_TRY(next(r));
        if (r->event.type == YAML_MAPPING_END_EVENT) return DAL_STATUS_OK;
        DAL_TRY(read_key(r, &key));
        int i;
        DAL_TRY(dal__find_word(key.name, DAL__AT_NAME(&key), "key of a table", dal__table_keys,
                               DAL__TABLE_KEYS, &i, r->error));
        if (table->key[i].text)
            return dal__fail_at(r->error, DAL_STATUS_MODEL, DAL__AT_NAME(&key),
                                "duplicate key '%s'", key.name);
        DAL_TRY(next(r));
        if (r->event.type != YAML_SCALAR_EVENT)
            return HERE(r, DAL_STATUS_SYNTAX, "a text is expected for '%s' of a table",
                        dal__table_keys[i]);
        DAL_TRY(read_scalar(r, &key));
        table->key[i] = key;
    }
}

/* The present event must be a scalar, or a formula with a range: the text of the entry. */
static dal_status read_entry(reader *r, dal__entry entry)
{
    const dal__model_section *section = &dal__sections[entry.section];
    const bool may_range =
        section->label && (section->form == DAL__FORM_LIST || section->form == DAL__FORM_MAPPING ||
                           dal__set_name(&entry));
    if (r->event.type == YAML_MAPPING_START_EVENT && may_range) return read_range(r, entry);
    const bool is_table = entry.section == DAL_SECTION_TABLES;
    if (is_table && r->event.type == YAML_MAPPING_START_EVENT) return read_table(r, entry);
    if (is_table)
        return HERE(r, DAL_STATUS_SYNTAX, "a table is {file: data.csv, at: column, value: column}");
    if (r->event.type != YAML_SCALAR_EVENT)
        return HERE(r, DAL_STATUS_SYNTAX, "a text is expected in %s",
                    dal__section_name(entry.section));
    DAL_TRY(read_scalar(r, &entry));
    if (!entry.name) {
        entry.name_line = entry.line;
        entry.name_column = entry.column;
    }
    return dal__model_insert(r->model, entry, r->error);
}

/* What a start solves is a list within its mapping: names that get a prefix, without texts. */
static dal_status read_list(reader *r, dal_section section, const char *prefix)
{
    if (r->event.type != YAML_SEQUENCE_START_EVENT && *prefix)
        return HERE(r, DAL_STATUS_SYNTAX, "solve must be a list of velocities, as [x', y']");
    if (r->event.type != YAML_SEQUENCE_START_EVENT) return wrong_form(r, section);
    for (;;) {
        dal__entry entry = {.section = section, .text = ""};
        DAL_TRY(next(r));
        if (r->event.type == YAML_SEQUENCE_END_EVENT) return DAL_STATUS_OK;
        if (!*prefix) {
            DAL_TRY(read_entry(r, entry));
            continue;
        }
        DAL_TRY(read_key(r, &entry));
        entry.name = dal__model_print(r->model, "%s%s", prefix, entry.name);
        if (!entry.name) return dal__memory_error(r->error);
        DAL_TRY(dal__model_insert(r->model, entry, r->error));
    }
}

/* What an event sets is a mapping within its mapping, the names of which get a prefix. */
static dal_status read_mapping(reader *r, dal_section section, int item, const char *prefix)
{
    if (r->event.type != YAML_MAPPING_START_EVENT && *prefix)
        return HERE(r, DAL_STATUS_SYNTAX, "set must be a mapping of names, as {x': -x'}");
    if (r->event.type != YAML_MAPPING_START_EVENT) return wrong_form(r, section);
    for (int count = 0;; count++) {
        dal__entry entry = {.section = section, .item = item};
        DAL_TRY(next(r));
        if (r->event.type == YAML_MAPPING_END_EVENT && item && count == 0)
            return HERE(r, DAL_STATUS_SYNTAX, "this mapping is empty");
        if (r->event.type == YAML_MAPPING_END_EVENT) return DAL_STATUS_OK;
        DAL_TRY(read_key(r, &entry));
        const bool is_set = section == DAL_SECTION_EVENTS && strcmp(entry.name, "set") == 0;
        const bool is_solve = section == DAL_SECTION_START && strcmp(entry.name, "solve") == 0;
        if (*prefix) entry.name = dal__model_print(r->model, "%s%s", prefix, entry.name);
        if (!entry.name) return dal__memory_error(r->error);
        DAL_TRY(next(r));
        if (is_set && !*prefix)
            DAL_TRY(read_mapping(r, section, item, dal__set_prefix));
        else if (is_solve && r->event.type != YAML_SCALAR_EVENT)
            DAL_TRY(read_list(r, section, dal__solve_prefix));
        else
            DAL_TRY(read_entry(r, entry));
    }
}

static dal_status read_mappings(reader *r, dal_section section)
{
    if (r->event.type != YAML_SEQUENCE_START_EVENT) return wrong_form(r, section);
    for (int item = 1;; item++) {
        DAL_TRY(next(r));
        if (r->event.type == YAML_SEQUENCE_END_EVENT && item == 1)
            return HERE(r, DAL_STATUS_SYNTAX, "this list is empty");
        if (r->event.type == YAML_SEQUENCE_END_EVENT) return DAL_STATUS_OK;
        DAL_TRY(read_mapping(r, section, item, ""));
    }
}

static dal_status read_section(reader *r, dal_section section)
{
    switch (dal__sections[section].form) {
    case DAL__FORM_LIST:
        return read_list(r, section, "");
    case DAL__FORM_MAPPING:
        return read_mapping(r, section, 0, "");
    case DAL__FORM_MAPPINGS:
        return read_mappings(r, section);
    default:
        if (r->event.type != YAML_SCALAR_EVENT) return wrong_form(r, section);
        return read_entry(r, (dal__entry){.section = section});
    }
}

static dal_status find_section(reader *r, const dal__entry *key, dal_section *section)
{
    const char *names[DAL_SECTION_COUNT];
    for (int i = 0; i < DAL_SECTION_COUNT; i++) names[i] = dal__section_name((dal_section)i);
    int i;
    DAL_TRY(dal__find_word(key->name, DAL__AT_NAME(key), "key", names, DAL_SECTION_COUNT, &i,
                           r->error));
    if (r->seen & 1u << i)
        return dal__fail_at(r->error, DAL_STATUS_MODEL, DAL__AT_NAME(key), "duplicate key '%s'",
                            key->name);
    r->seen |= 1u << i;
    *section = (dal_section)i;
    return DAL_STATUS_OK;
}

static dal_status read_sections(reader *r)
{
    for (;;) {
        dal__entry key = {.name = NULL};
        dal_section section = DAL_SECTION_TITLE;
        DAL_TRY(next(r));
        if (r->event.type == YAML_MAPPING_END_EVENT) return DAL_STATUS_OK;
        DAL_TRY(read_key(r, &key));
        DAL_TRY(find_section(r, &key, &section));
        DAL_TRY(next(r));
        DAL_TRY(read_section(r, section));
    }
}

/* ---- the file ---- */

static dal_status read_document(reader *r)
{
    DAL_TRY(next(r)); /* the stream */
    DAL_TRY(next(r));
    if (r->event.type == YAML_STREAM_END_EVENT)
        return HERE(r, DAL_STATUS_SYNTAX, "the file is empty");
    DAL_TRY(next(r));
    if (r->event.type != YAML_MAPPING_START_EVENT)
        return HERE(r, DAL_STATUS_SYNTAX, "a system file is a mapping, as 'coordinates: [x, y]'");
    const bool is_flow = r->event.data.mapping_start.style == YAML_FLOW_MAPPING_STYLE;
    r->first = offset_of(r, r->event.start_mark) + is_flow;
    DAL_TRY(read_sections(r));
    DAL_TRY(next(r)); /* the end of the document */
    DAL_TRY(next(r));
    if (r->event.type == YAML_STREAM_END_EVENT) return DAL_STATUS_OK;
    return HERE(r, DAL_STATUS_SYNTAX, "a second document begins here: a system file has one");
}

static dal_status check_text(const char *text, size_t length, dal_error *error)
{
    if (length > DAL__MAX_BYTES)
        return dal__fail(error, DAL_STATUS_TOO_LARGE, "more than %d bytes in a system file",
                         (int)DAL__MAX_BYTES);
    const char *nul = memchr(text, 0, length);
    if (!nul) return DAL_STATUS_OK;
    int line, column;
    find_place(text, (size_t)(nul - text), &line, &column);
    return dal__fail_at(error, DAL_STATUS_SYNTAX, line, column, "the file holds a NUL byte");
}

static dal_status read_text(dal_model *model, const dal__system_text *system, size_t mark,
                            dal_error *error)
{
    reader r = {.model = model,
                .text = system->text + mark,
                .length = system->length - mark,
                .error = error};
    r.last_table = &r.tables;
    if (!yaml_parser_initialize(&r.parser)) return dal__memory_error(error);
    yaml_parser_set_encoding(&r.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&r.parser, (const unsigned char *)r.text, r.length);
    dal_status status = read_document(&r);
    if (r.holding) yaml_event_delete(&r.event);
    yaml_parser_delete(&r.parser);
    if (status != DAL_STATUS_OK) return status;
    return dal__load_tables(model, r.tables, system, mark + r.first, error);
}

/* dal_model_read with a directory. */
static dal_status read_system(dal_model **model, const dal__system_text *system, dal_error *error)
{
    const size_t skip = dal__mark_length(system->text, system->length);
    DAL_TRY(check_text(system->text + skip, system->length - skip, error));
    dal_model *made = dal_model_create(system->name);
    if (!made) return dal__memory_error(error);
    dal_status status = read_text(made, system, skip, error);
    if (status == DAL_STATUS_OK)
        *model = made;
    else
        dal_model_free(made);
    return status;
}

dal_status dal_model_read(dal_model **model, const char *name, const char *text, size_t length,
                          dal_error *error)
{
    DAL_REQUIRE(model, error);
    *model = NULL;
    if (!text) return dal__fail(error, DAL_STATUS_ARGUMENT, "there is no text to read");
    return read_system(model, &(dal__system_text){name, NULL, text, length}, error);
}

/* The name of the file without directories and ".yaml"; at most size bytes with the NUL. */
static void name_of(const char *path, char *name, size_t size)
{
    static const char ending[] = ".yaml";
    const char *slash = strrchr(path, '/'), *begin = slash ? slash + 1 : path;
    size_t length = strlen(begin), ending_length = sizeof ending - 1;
    if (length > ending_length && strcmp(begin + length - ending_length, ending) == 0)
        length -= ending_length;
    snprintf(name, size, "%.*s", (int)(length < size ? length : size - 1), begin);
}

dal_status dal_model_read_file(dal_model **model, const char *path, dal_error *error)
{
    DAL_REQUIRE(model, error);
    char name[256];
    dal_error reason;
    *model = NULL;
    DAL_REQUIRE(path, error);
    name_of(path, name, sizeof name);
    dal__system_text system = {.name = name};
    char *text = dal__read_file(path, &system.length, &reason);
    if (!text) return dal__fail(error, reason.status, "%s", reason.message);
    const char *slash = strrchr(path, '/');
    const size_t folders = slash ? (size_t)(slash - path) + 1 : 0;
    char *directory = malloc(folders + 1);
    if (directory) {
        memcpy(directory, path, folders);
        directory[folders] = 0;
    }
    system.text = text;
    system.directory = directory;
    const dal_status status =
        directory ? read_system(model, &system, error) : dal__memory_error(error);
    free(directory);
    free(text);
    return status;
}
