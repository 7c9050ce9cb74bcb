/* events.h - the events of a model: when they happen and what they do. */
#ifndef DAL_MODEL_EVENTS_H
#define DAL_MODEL_EVENTS_H

#include "dalembert_model.h"

/* Parses the section events, after all other formulas.  Errors: DAL_STATUS_SYNTAX, DAL_STATUS_NAME,
 * DAL_STATUS_MODEL, DAL_STATUS_TOO_LARGE. */
dal_status dal__parse_events(dal_model *model, dal_error *error);
/* After the equations: the rates and the normals of events.  Errors: DAL_STATUS_MODEL,
 * DAL_STATUS_UNSUPPORTED. */
dal_status dal__derive_events(dal_model *model, dal_error *error);

#endif
