/* study_sentences.h - cells and sentences of the screen of a study on a terminal. */
#ifndef DAL_CLI_STUDY_SENTENCES_H
#define DAL_CLI_STUDY_SENTENCES_H

#include "study_matrix.h"
#include "ui/screen.h"

enum { STUDY_SHORT_NAME = 8 };

/* A short name for each column: the first part of its label that no other label has, one that need
 * not be cut if there is any; else the last part, with a number where another column has that. */
void study_name_columns(const study_matrix *m, char (*name)[STUDY_SHORT_NAME]);
/* "ok" at rounding, or a size with a mark of its growth; cell may be NULL. */
void study_add_size(screen_table *t, const study_cell *c, int quantity);
/* In how many of its runs a method keeps a quantity at rounding: "8/9". */
void study_add_count(screen_table *t, const study_method *m, int quantity);
/* "until t = 100, h = 0.02", or the least and the largest; allocated. */
char *study_describe_range(const study_plan *plan);
/* The first expectations that are not met, and how many are. */
void study_say_expectations(screen *s, const study_plan *plan);

#endif
