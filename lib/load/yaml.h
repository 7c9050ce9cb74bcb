/* yaml.h - reads system files. */
#ifndef DAL_LOAD_YAML_H
#define DAL_LOAD_YAML_H

#include "dalembert.h"

/* A system file as text. */
typedef struct dal__system_text {
    const char *name;      /* of the model */
    const char *directory; /* where files of tables are, with the / at its end; NULL: in the text */
    const char *text;
    size_t length;
} dal__system_text;

/* dal_model_read with a directory. */
dal_status dal__read_system(dal_model **model, const dal__system_text *system, dal_error *error);

#endif
