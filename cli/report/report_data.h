/* report_data.h - what report.js reads on a page: texts and numbers as JSON.
 *
 * Each system of a study has an element <script type="application/json" class="data"> with its
 * envelopes and motions, and the page of a run has one with its motion; see docs/formats.md. */
#ifndef DAL_CLI_REPORT_DATA_H
#define DAL_CLI_REPORT_DATA_H

#include "report_cells.h"
#include "report_motion.h"

#include <stdint.h>
#include <stdio.h>

/* A string of JSON that may stand in HTML. */
void data_write_string(FILE *page, const char *text);
/* A number of JSON; null where it is not finite. */
void data_write_number(FILE *page, double x);
/* A string of JSON with integers of 16 bits, little-endian, in base64. */
void data_write_levels(FILE *page, const uint16_t *level, int count);
/* Begins and ends the element. */
void data_begin(FILE *page);
void data_end(FILE *page);
/* A member of it, with a comma: some motions; those without frames are left out. */
void data_write_motions(FILE *page, const motion *motions, int count);
/* The first members: of a label, with series/LABEL.csv, the steps, the times and the cells. */
void data_write_envelopes(const study_page *s, const char *label, const report_words *steps,
                          const report_csv *series);

/* The element of the page of a run, with its motion; nothing where there is none.  Returns
 * CLI_DONE, or prints and returns an exit status. */
int data_write_run(report *r);

#endif
