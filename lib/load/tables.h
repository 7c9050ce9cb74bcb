/* tables.h - the tables of a system file, and their own files. */
#ifndef DAL_LOAD_TABLES_H
#define DAL_LOAD_TABLES_H

#include "model/model.h"

/* A system file as text. */
typedef struct dal__system_text {
    const char *name;      /* of the model */
    const char *directory; /* where files of tables are, with the / at its end; NULL: in the text */
    const char *text;
    size_t length;
} dal__system_text;

/* The keys of a table, KEY(code, name). */
#define DAL__TABLE_KEY_LIST(KEY)                                                                   \
    KEY(FILE, "file")                                                                              \
    KEY(AT, "at")                                                                                  \
    KEY(VALUE, "value")                                                                            \
    KEY(INTERPOLATION, "interpolation")                                                            \
    KEY(EXTEND, "extend")
enum {
#define CODE(code, name) DAL__TABLE_##code,
    DAL__TABLE_KEY_LIST(CODE)
#undef CODE
        DAL__TABLE_KEYS
};
extern const char *const dal__table_keys[DAL__TABLE_KEYS];

/* A table as its file gives it: the place of the whole, and the texts of its keys, with places. */
typedef struct dal__table_request {
    dal__entry entry;
    dal__entry key[DAL__TABLE_KEYS]; /* text NULL: not given */
    struct dal__table_request *next;
} dal__table_request;

/* Adds the tables to a model, and sets its source: the text with the files put into it at the
 * offset where its mapping begins (in a flow mapping, after the bracket).  Errors:
 * DAL_STATUS_SYNTAX, DAL_STATUS_NAME, DAL_STATUS_MODEL, DAL_STATUS_TOO_LARGE, DAL_STATUS_MEMORY. */
dal_status dal__load_tables(dal_model *model, const dal__table_request *first,
                            const dal__system_text *system, size_t offset, dal_error *error);

#endif
