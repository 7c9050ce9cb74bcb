/* study_sentences.h - cells and sentences of the screen of a study on a terminal. */
#ifndef DAL_CLI_STUDY_SENTENCES_H
#define DAL_CLI_STUDY_SENTENCES_H

#include "study_matrix.h"
#include "ui/screen.h"

/* The most letters of a short name; its bytes, as many of UTF-8 as they may take, and a zero. */
enum { STUDY_SHORT_LETTERS = 12, STUDY_SHORT_NAME = 4 * STUDY_SHORT_LETTERS + 1 };

/* A short name for each column, of some letters at most: the first piece of its label that no other
 * label has, one that need not be cut if there is any; else the last piece, with a number where
 * another column has that. */
void study_name_columns(const study_matrix *m, int letters, char (*name)[STUDY_SHORT_NAME]);
/* "ok" at rounding, or a size with a mark of its growth, or a state; cell may be NULL.  The mark:
 * "/" like t, "^" faster, "~" slower, "?" undecided, "x" aborted, or none.  Returns its
 * colour.  The same as a cell of a table. */
enum { STUDY_SIZE_TEXT = SCREEN_NUMBER + 4 };
screen_colour study_describe_size(const study_cell *c, study_quantity quantity,
                                  char text[STUDY_SIZE_TEXT]);
void study_add_size(screen_table *t, const study_cell *c, study_quantity quantity);
/* In how many of its runs a method keeps a quantity at rounding: "8/9". */
void study_add_count(screen_table *t, const study_method *m, study_quantity quantity);
/* What integrators are to keep in all of their runs: D, E, or both. */
typedef enum study_aim { STUDY_AIM_D, STUDY_AIM_E, STUDY_AIM_BOTH, STUDY_AIMS } study_aim;
/* Those that do, by patterns, in a text of some columns; NULL where none has it to keep.  *kept and
 * *all, unless NULL: how many do, of how many.  Allocated. */
char *study_list_keepers(const study_matrix *m, study_aim aim, int columns, int *kept, int *all);
/* The command that explains the first drift of D in some columns of the matrix; NULL: none drifts.
 * Allocated. */
char *study_format_explain(const study_matrix *m, int columns);
/* "until t = 100, h = 0.02", or the least and the largest; allocated. */
char *study_describe_range(const study_plan *plan);
/* The first expectations that are not met, and how many are. */
void study_say_expectations(screen *s, const study_plan *plan);

#endif
