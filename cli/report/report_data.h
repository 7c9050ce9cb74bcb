/* report_data.h - what report.js reads on a page: texts and numbers as JSON.
 *
 * Each system of a study has an element <script type="application/json" class="data"> with its
 * envelopes and motions, and the page of a run has one with its motion; see docs/formats.md. */
#ifndef DAL_CLI_REPORT_DATA_H
#define DAL_CLI_REPORT_DATA_H

#include "report_cells.h"
#include "report_motion.h"

#include <stdio.h>

/* Begins and ends the element. */
json_writer data_begin(FILE *page);
void data_end(json_writer *data);
/* Members: some motions; those without frames are left out. */
void data_write_motions(json_writer *data, const motion *motions, int count);
/* Of a label, with series/LABEL.csv, the steps, the times and the cells. */
void data_write_envelopes(json_writer *data, const study_page *s, const char *label,
                          const csv_words *steps, const csv_table *series);

/* The element of the page of a run, with its motion and the exact one; nothing where there is none.
 * Returns CLI_DONE, or prints and returns an exit status. */
int data_write_run(report *r);

#endif
