/* tables.h - tables of a model. */
#ifndef DAL_MODEL_TABLES_H
#define DAL_MODEL_TABLES_H

#include "model/model.h"

/* Adds a copy of an entry of tables, with its points.  Errors: those of dal_model_add_table. */
dal_status dal__model_insert_table(dal_model *model, dal__entry entry, const dal_table *table,
                                   dal_error *error);

#endif
