/* study_matrix.h - which integrators and systems of a study its screens show, and what becomes of D
 * and E under each integrator. */
#ifndef DAL_CLI_STUDY_MATRIX_H
#define DAL_CLI_STUDY_MATRIX_H

#include "study_data.h"
#include "study_fate.h"

enum { STUDY_COLUMNS = 12 };

/* An integrator, its name, and how many of its runs have which fate; in how many a quantity is at
 * rounding, or bounded and kept to that fraction. */
typedef struct study_method {
    char name[STUDY_NAME];
    int count[QUANTITIES][FATES], kept[QUANTITIES];
} study_method;

typedef struct study_matrix {
    const study_plan *plan;
    study_method *methods; /* all of the study */
    int method_count;
    study_method **of_cell;    /* [cells of the plan] */
    const study_method **row;  /* [rows] */
    const study_case **column; /* [columns] */
    int rows, columns;
    const study_cell **cell; /* [rows*columns], see study_matrix_cell */
} study_matrix;

/* Which integrators and systems: some for a screen, or all of the study. */
typedef enum study_scope { STUDY_SOME, STUDY_ALL } study_scope;

/* Chooses rows, columns and cells, and counts the runs; free it. */
void study_matrix_make(study_matrix *matrix, const study_plan *plan, study_scope scope);
void study_matrix_free(study_matrix *matrix);
/* A cell; NULL: the study has none. */
static inline const study_cell *study_matrix_cell(const study_matrix *m, int row, int column)
{
    return m->cell[row * m->columns + column];
}
/* What becomes of a quantity in all runs of an integrator: AT_ROUNDING where each keeps it, else
 * what is first said against that; FATES where it has no run.  E is to be kept on D = 0 alone. */
fate study_method_fate(const study_method *m, study_quantity quantity);

#endif
