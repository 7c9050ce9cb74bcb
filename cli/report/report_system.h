/* report_system.h - what moves, and how, as a list on a page. */
#ifndef DAL_CLI_REPORT_SYSTEM_H
#define DAL_CLI_REPORT_SYSTEM_H

#include "report_page.h"
#include "run/request.h"

#include <stdbool.h>
#include <stdio.h>

/* The title of a model, or another text where it has none. */
const char *report_model_title(const dal_model *model, const char *otherwise);
/* The equations of a model as MathML, below a summary that shows them. */
void report_folded_equations(FILE *page, dal_model *model);
/* A list between REPORT_FACTS and REPORT_FACTS_END: the equations of a model, other formulas as
 * they were given, parameters and start as a request changes them, its method and its options. */
#define REPORT_FACTS     "<dl class=\"facts\">\n"
#define REPORT_FACTS_END "</dl>\n"
void report_system(FILE *page, dal_model *model, const run_request *request);
void report_method(FILE *page, const run_request *request);
/* One more item. */
void report_fact(FILE *page, const char *name, const char *text);
/* Whether a coordinate is an angle: it has the name of one, theta or phi1, or is in a sine,
 * cosine or tangent. */
bool report_is_angle(const dal_model *model, const char *coordinate);
/* A section of the page with the command that makes a run. */
void report_command(report *r, const run_request *request);

#endif
