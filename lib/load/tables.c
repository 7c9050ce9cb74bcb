/* tables.c - tables from files of comma-separated values.
 *
 *     t, M          names of columns
 *     0, 0.5        numbers, at least in the columns that are used
 *
 * Messages have two places: where the system file names the file, and a place in that file.
 *
 * A model keeps its text with these files in it, as
 *
 *     files: {"data.csv": "t, M\n0, 0.5\n"}
 *
 * so that a copy of the text is the whole system. */
#include "load/tables.h"
#include "core/buffer.h"
#include "load/file.h"
#include "model/functions.h"
#include "model/symbols.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const dal__table_keys[DAL__TABLE_KEYS] = {
#define NAME(code, name) name,
    DAL__TABLE_KEY_LIST(NAME)
#undef NAME
};

/* A file that was read. */
typedef struct csv_file {
    const char *name, *text;
    size_t length;
    struct csv_file *next;
} csv_file;

typedef struct loader {
    dal_model *model;
    const dal__system_text *system;
    csv_file *files;
    dal_error *error;
} loader;

/* ---- files ---- */

static dal_status read_from_disk(loader *l, const dal__entry *name, csv_file *file)
{
    dal_error reason;
    if (!l->system->directory)
        return dal__fail_at(l->error, DAL_STATUS_MODEL, DAL__AT_TEXT(name),
                            "'%.80s' is not under files, and the text has no directory",
                            name->text);
    const char *path = *name->text == '/'
                           ? name->text
                           : dal__model_print(l->model, "%s%s", l->system->directory, name->text);
    if (!path) return dal__memory_error(l->error);
    char *bytes = dal__read_file(path, &file->length, &reason);
    if (!bytes && reason.status == DAL_STATUS_MEMORY) return dal__memory_error(l->error);
    if (!bytes)
        return dal__fail_at(l->error,
                            reason.status == DAL_STATUS_IO ? DAL_STATUS_MODEL : reason.status,
                            DAL__AT_TEXT(name), "cannot read '%.160s': %s", path, reason.message);
    file->text = dal__model_copy(l->model, bytes, file->length);
    free(bytes);
    return file->text ? DAL_STATUS_OK : dal__memory_error(l->error);
}

/* The file that a table names, read once. */
static dal_status find_file(loader *l, const dal__entry *name, const csv_file **found)
{
    for (*found = l->files; *found; *found = (*found)->next)
        if (strcmp((*found)->name, name->text) == 0) return DAL_STATUS_OK;
    csv_file *file = dal__model_allocate(l->model, 1, sizeof *file);
    if (!file) return dal__memory_error(l->error);
    file->name = name->text;
    const dal__entry *entry;
    for (int i = 0; (entry = dal__model_entry(l->model, DAL_SECTION_FILES, i)) != NULL; i++)
        if (strcmp(entry->name, name->text) == 0) break;
    if (entry) {
        file->text = entry->text;
        file->length = strlen(entry->text);
    } else if (dal__model_count(l->model, DAL_SECTION_FILES) > 0) {
        return dal__fail_at(l->error, DAL_STATUS_MODEL, DAL__AT_TEXT(name),
                            "'%.80s' is not under files", name->text);
    } else {
        DAL_TRY(read_from_disk(l, name, file));
    }
    const size_t mark = dal__mark_length(file->text, file->length);
    file->text += mark, file->length -= mark;
    file->next = l->files;
    l->files = file;
    *found = file;
    return DAL_STATUS_OK;
}

/* ---- rows and columns ---- */

typedef struct cursor {
    const loader *loader;
    const dal__entry *name; /* of the file */
    const char *line, *at, *end;
    int number; /* of the line, from 1 */
} cursor;

/* An error at a place of the file of a table, and at the place that names the file. */
#define CSV_ERROR(c, place, format, ...)                                                           \
    dal__fail_at((c)->loader->error, DAL_STATUS_SYNTAX, DAL__AT_TEXT((c)->name),                   \
                 "%.80s:%d:%d: " format, (c)->name->text, (c)->number,                             \
                 (int)((place) - (c)->line) + 1, __VA_ARGS__)

static bool at_line_end(const cursor *c) { return c->at == c->end || *c->at == '\n'; }

/* The next field of a line without blanks and quotes around it, and the comma after it. */
static const char *next_field(cursor *c, size_t *length)
{
    const char *begin = c->at, *stop = c->at;
    while (stop < c->end && *stop != ',' && *stop != '\n') stop++;
    c->at = stop < c->end && *stop == ',' ? stop + 1 : stop;
    while (begin < stop && strchr(" \t\r", *begin)) begin++;
    while (begin < stop && strchr(" \t\r", stop[-1])) stop--;
    if (stop - begin >= 2 && *begin == '"' && stop[-1] == '"') begin++, stop--;
    *length = (size_t)(stop - begin);
    return begin;
}

/* Moves to the next line that is not empty; false: there is none. */
static bool next_line(cursor *c)
{
    while (c->at < c->end) {
        c->at += *c->at == '\n';
        c->number++;
        c->line = c->at;
        while (!at_line_end(c) && strchr(" \t\r", *c->at)) c->at++;
        if (!at_line_end(c)) return c->at = c->line, true;
    }
    return false;
}

/* Fields of the line, which a comma at its end makes one more. */
static int count_fields(const cursor *c)
{
    int count = 1;
    for (const char *at = c->at; at < c->end && *at != '\n'; at++) count += *at == ',';
    return count;
}

/* Each column has a head: a number without one belongs to no column that a table could name. */
static dal_status check_heads(const cursor *first, int *columns)
{
    cursor c = *first;
    *columns = count_fields(&c);
    for (int i = 0; i < *columns; i++) {
        size_t length;
        const char *name = next_field(&c, &length);
        if (length == 0) return CSV_ERROR(&c, name, "column %d has no head", i + 1);
    }
    return DAL_STATUS_OK;
}

/* The number of a column in the first line, from 0. */
static dal_status find_column(const cursor *first, const dal__entry *key, int *column)
{
    enum { MAX_NAMES = 64 };
    char names[MAX_NAMES][DAL__MAX_LETTERS + 1];
    const char *known[MAX_NAMES];
    cursor c = *first;
    int count = 0;
    *column = -1;
    for (int i = 0; !at_line_end(&c); i++) {
        size_t length;
        const char *name = next_field(&c, &length);
        if (strlen(key->text) == length && memcmp(key->text, name, length) == 0) {
            if (*column >= 0)
                return CSV_ERROR(&c, name, "another column is called '%.60s', too", key->text);
            *column = i;
        }
        if (count == MAX_NAMES) continue;
        snprintf(names[count], sizeof names[count], "%.*s", length < 100 ? (int)length : 100, name);
        known[count] = names[count];
        count++;
    }
    if (*column >= 0) return DAL_STATUS_OK;
    char what[200];
    snprintf(what, sizeof what, "column of '%.80s'", first->name->text);
    return dal__unknown_at(first->loader->error, DAL__AT_TEXT(key), what, key->text, known, count);
}

/* Reads the numbers of a line in two of the columns. */
static dal_status read_line(cursor *c, int columns, const int column[2], double *number[2])
{
    const int last = column[column[1] > column[0]], fields = count_fields(c);
    for (int i = 0; i <= last; i++) {
        size_t length;
        if (at_line_end(c) && i > 0)
            return CSV_ERROR(c, c->at, "the line has %d column%s; column %d is missing", i,
                             i == 1 ? "" : "s", last + 1);
        const char *text = next_field(c, &length);
        for (int k = 0; k < 2; k++)
            if (column[k] == i && dal__parse_number(text, length, number[k]) != DAL_STATUS_OK)
                return CSV_ERROR(c, text, "'%.*s' is not a number", length < 60 ? (int)length : 60,
                                 text);
    }
    for (int i = last + 1; i < fields; i++) {
        size_t length;
        const char *text = next_field(c, &length);
        if (i == columns) return CSV_ERROR(c, text, "column %d has no head", i + 1);
    }
    return DAL_STATUS_OK;
}

/* Fills in the points of a table. */
static dal_status read_csv(loader *l, const dal__table_request *request, const csv_file *file,
                           dal_table *table)
{
    const dal__entry *key = request->key;
    const char *end = file->text + file->length;
    cursor c = {l, &key[DAL__TABLE_FILE], file->text, file->text, end, 1};
    int columns, column[2];
    size_t lines = 2;
    for (; c.at < end; c.at++) {
        const unsigned char byte = (unsigned char)*c.at;
        if (byte > 0x7e || (byte < 0x20 && !(byte && strchr("\t\r\n", byte))))
            return CSV_ERROR(&c, c.at, "unexpected byte 0x%02x; a table is plain ASCII", byte);
        if (byte == '\n') c.number++, c.line = c.at + 1;
    }
    c.at = c.line = file->text;
    c.number = 1;
    if (file->length == 0) return CSV_ERROR(&c, c.at, "%s", "the file is empty");
    DAL_TRY(check_heads(&c, &columns));
    DAL_TRY(find_column(&c, &key[DAL__TABLE_AT], &column[0]));
    DAL_TRY(find_column(&c, &key[DAL__TABLE_VALUE], &column[1]));
    for (size_t i = 0; i < file->length; i++) lines += file->text[i] == '\n';
    double *at = dal__model_allocate(l->model, lines, sizeof *at);
    double *value = dal__model_allocate(l->model, lines, sizeof *value);
    if (!at || !value) return dal__memory_error(l->error);
    while (!at_line_end(&c)) c.at++;
    while (next_line(&c)) {
        const int i = table->points;
        double *number[2] = {at + i, value + i};
        if (i == DAL__MAX_POINTS)
            return CSV_ERROR(&c, c.line, "more than %d points", (int)DAL__MAX_POINTS);
        DAL_TRY(read_line(&c, columns, column, number));
        if (i > 0 && !(at[i] > at[i - 1]))
            return CSV_ERROR(&c, c.line, "%.17g does not ascend: %.17g comes before it", at[i],
                             at[i - 1]);
        table->points++;
    }
    if (table->points < 2)
        return CSV_ERROR(&c, c.line, "a table needs two points or more, not %d", table->points);
    table->at = at;
    table->value = value;
    return DAL_STATUS_OK;
}

/* ---- one table ---- */

/* The number of the word that a key has, which stays what it is where the key is not given. */
static dal_status read_word(const loader *l, const dal__entry *key, const char *what,
                            const char *const *words, int count, int *i)
{
    if (!key->text) return DAL_STATUS_OK;
    return dal__find_word(key->text, DAL__AT_TEXT(key), what, words, count, i, l->error);
}

static dal_status load_table(loader *l, const dal__table_request *request)
{
    static const char *const forms[] = {"linear", "cubic", "not-a-knot"};
    static const char *const extensions[] = {"none", "constant", "linear"};
    const dal__entry *key = request->key;
    dal__entry entry = request->entry;
    const csv_file *file;
    int form = DAL_LINEAR, extend = DAL_EXTEND_NONE;
    for (int i = DAL__TABLE_FILE; i <= DAL__TABLE_VALUE; i++)
        if (!key[i].text)
            return dal__fail_at(l->error, DAL_STATUS_MODEL, DAL__AT_TEXT(&entry),
                                "table %.80s has no '%s'; it needs file, at and value", entry.name,
                                dal__table_keys[i]);
    DAL_TRY(read_word(l, &key[DAL__TABLE_INTERPOLATION], "interpolation", forms, 3, &form));
    DAL_TRY(read_word(l, &key[DAL__TABLE_EXTEND], "extension", extensions, 3, &extend));
    DAL_TRY(find_file(l, &key[DAL__TABLE_FILE], &file));
    dal_table table = {.interpolation = (dal_interpolation)form, .extend = (dal_extend)extend};
    DAL_TRY(read_csv(l, request, file, &table));
    entry.text =
        dal__model_print(l->model, "%s of %s in %s, %s, extend: %s", key[DAL__TABLE_VALUE].text,
                         key[DAL__TABLE_AT].text, file->name, forms[form], extensions[extend]);
    if (!entry.text) return dal__memory_error(l->error);
    return dal__model_insert_table(l->model, entry, &table, l->error);
}

/* ---- the source ---- */

/* A text in double quotes, which YAML and JSON read alike. */
static void append_quoted(dal__buffer *to, const char *text, size_t length)
{
    dal__buffer_append(to, "\"");
    for (size_t i = 0; i < length; i++) {
        static const char special[] = "\n\r\t\"\\", letter[] = "nrt\"\\";
        const char *c = text[i] ? strchr(special, text[i]) : NULL;
        if (c)
            dal__buffer_append_bytes(to, (char[]){'\\', letter[c - special]}, 2);
        else
            dal__buffer_append_bytes(to, text + i, 1);
    }
    dal__buffer_append(to, "\"");
}

/* The text with the files put in at an offset. */
static dal_status make_source(loader *l, size_t offset)
{
    dal_model *model = l->model;
    const char *text = l->system->text;
    const bool is_flow = offset > 0 && text[offset - 1] == '{';
    size_t indent = 0;
    dal__buffer source = {0};
    while (indent < offset && text[offset - indent - 1] != '\n') indent++;
    dal__buffer_append_bytes(&source, text, offset);
    if (l->files && dal__model_count(model, DAL_SECTION_FILES) == 0) {
        dal__buffer_append(&source, "\"files\": {");
        for (const csv_file *f = l->files; f; f = f->next) {
            append_quoted(&source, f->name, strlen(f->name));
            dal__buffer_append(&source, ": ");
            append_quoted(&source, f->text, f->length);
            dal__buffer_append(&source, f->next ? ", " : is_flow ? "}, " : "}\n");
        }
        if (!is_flow) dal__buffer_append_bytes(&source, text + offset - indent, indent);
    }
    dal__buffer_append_bytes(&source, text + offset, l->system->length - offset);
    model->source = dal__model_copy(model, source.bytes, source.length);
    const bool good = model->source && !source.out_of_memory;
    model->source_length = source.length;
    dal__buffer_free(&source);
    if (!good) return dal__memory_error(l->error);
    if (model->source_length > DAL__MAX_BYTES)
        return dal__fail(l->error, DAL_STATUS_TOO_LARGE,
                         "more than %d bytes in a system file, tables included",
                         (int)DAL__MAX_BYTES);
    return DAL_STATUS_OK;
}

dal_status dal__load_tables(dal_model *model, const dal__table_request *first,
                            const dal__system_text *system, size_t offset, dal_error *error)
{
    loader l = {.model = model, .system = system, .error = error};
    for (const dal__table_request *request = first; request; request = request->next)
        DAL_TRY(load_table(&l, request));
    return make_source(&l, offset);
}

const char *dal_model_source(const dal_model *model, size_t *length)
{
    if (!model || !model->source) return NULL;
    if (length) *length = model->source_length;
    return model->source;
}
