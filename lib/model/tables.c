/* tables.c - tables of a model: functions that points give. */
#include "model/tables.h"
#include "expr/table.h"
#include <math.h>
#include <string.h>

dal_status dal__model_insert_table(dal_model *model, dal__entry entry, const dal_table *table,
                                   dal_error *error)
{
    if (table->points < 2)
        return dal__fail_at(error, DAL_MODEL, DAL__AT_TEXT(&entry),
                            "table %s has %d point%s; it needs two or more", entry.name,
                            table->points, table->points == 1 ? "" : "s");
    if (table->points > DAL__MAX_POINTS)
        return dal__fail_at(error, DAL_TOO_LARGE, DAL__AT_TEXT(&entry),
                            "table %s has more than %d points", entry.name, (int)DAL__MAX_POINTS);
    for (int i = 0; i < table->points; i++) {
        if (!isfinite(table->at[i]) || !isfinite(table->value[i]))
            return dal__fail_at(error, DAL_MODEL, DAL__AT_TEXT(&entry),
                                "point %d of table %s is not finite", i + 1, entry.name);
        if (i > 0 && !(table->at[i] > table->at[i - 1]))
            return dal__fail_at(error, DAL_MODEL, DAL__AT_TEXT(&entry),
                                "point %d of table %s is not above the one before", i + 1,
                                entry.name);
    }
    double *data = dal__model_allocate(model, dal__table_size(table->points), sizeof *data);
    if (!data) return dal__memory_error(error);
    dal__table_fill(table, data);
    if (!dal__table_is_finite(table, data))
        return dal__fail_at(error, DAL_MODEL, DAL__AT_TEXT(&entry),
                            "table %s: its %s overflows: points are too large, or too close",
                            entry.name,
                            table->interpolation == DAL_CUBIC ? "cubic spline" : "slope");
    DAL_TRY(dal__model_insert(model, entry, error));
    if (model->tables == model->table_capacity) {
        const int capacity = model->tables ? 2 * model->tables : 4;
        dal__table *more = dal__model_allocate(model, (size_t)capacity, sizeof *more);
        if (!more) return dal__memory_error(error);
        if (model->tables) memcpy(more, model->table, (size_t)model->tables * sizeof *more);
        model->table = more;
        model->table_capacity = capacity;
    }
    model->table[model->tables++] = (dal__table){
        .knots = table->points, .degree = table->interpolation == DAL_CUBIC ? 3 : 1, .data = data};
    return DAL_OK;
}

dal_status dal_model_add_table(dal_model *model, const char *name, const dal_table *table, int line,
                               int column, dal_error *error)
{
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(name, error);
    DAL_REQUIRE(table, error);
    DAL_REQUIRE(table->points <= 0 || (table->at && table->value), error);
    const dal__entry entry = {
        .section = DAL_SECTION_TABLES,
        .name = name,
        .text = dal__model_print(model, "%d points, %s", table->points,
                                 table->interpolation == DAL_CUBIC ? "cubic" : "linear"),
        .line = line,
        .column = column,
        .name_line = line,
        .name_column = column};
    if (!entry.text) return dal__memory_error(error);
    return dal__model_insert_table(model, entry, table, error);
}
