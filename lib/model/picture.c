/* picture.c - how a system is drawn in the plane: formulas for the place and the angles of a body,
 * and a word for the body.  The motion knows nothing of it. */
#include "model/mechanics.h"
#include <string.h>

static const char *const number_names[] = {
#define X(code, name) name,
    DAL_PICTURE_LIST(X)
#undef X
        "body"};
enum { BODY = DAL_PICTURE_COUNT, NAMES = DAL_PICTURE_COUNT + 1 };

static dal_status read_body(dal_model *model, const dal__entry *entry, dal_error *error)
{
    static const char *const words[] = {
#define X(code, name) name,
        DAL_BODY_LIST(X)
#undef X
    };
    int i = dal__index_of(entry->text, strlen(entry->text), words, DAL_BODY_COUNT);
    if (i < 0)
        return dal__unknown_at(error, entry->line, entry->column, "body", entry->text, words,
                               DAL_BODY_COUNT);
    model->equations.body = (dal_body)i;
    return DAL_OK;
}

static dal_status read_entry(dal_model *model, const dal__entry *entry, unsigned *seen,
                             dal_error *error)
{
    const dal__equations *e = &model->equations;
    dal__scope everything = {
        .may = DAL__MAY_T | DAL__MAY_STATE, .parameters = e->parameters, .lets = e->lets};
    int i = dal__index_of(entry->name, strlen(entry->name), number_names, NAMES);
    if (i < 0)
        return dal__unknown_at(error, entry->name_line, entry->name_column, "entry of picture",
                               entry->name, number_names, NAMES);
    *seen |= 1u << i;
    if (i == BODY) return read_body(model, entry, error);
    return dal__formula(model, entry, everything, &e->picture[i], error);
}

dal_status dal__picture(dal_model *model, dal_error *error)
{
    const dal__entry *first = dal__model_entry(model, DAL_SECTION_PICTURE, 0);
    unsigned seen = 0;
    if (!first) return DAL_OK;
    for (int k = 0; k < model->count; k++)
        if (model->entries[k].section == DAL_SECTION_PICTURE)
            DAL_TRY(read_entry(model, &model->entries[k], &seen, error));
    for (int i = DAL_PICTURE_X; i <= DAL_PICTURE_Y; i++)
        if (!(seen & 1u << i))
            return dal__fail_at(error, DAL_MODEL, first->name_line, first->name_column,
                                "picture has no %s: it needs x and y", number_names[i]);
    return DAL_OK;
}
