/* study_plan.h - the plan of a study: its cases, and their cells. */
#ifndef DAL_CLI_STUDY_PLAN_H
#define DAL_CLI_STUDY_PLAN_H

#include "io/document.h"
#include "run/native.h"
#include "run/request.h"
#include "study_cell.h"

enum { STUDY_STEPS = 16 };

/* One system of a study, with one value for each of its settings.  Cases that differ in these
 * values alone are of one group: they stand together and share the model, the copy and the methods,
 * which belong to the first of them. */
typedef struct study_case {
    const char *name;  /* a built-in name or a path */
    const char *group; /* the label in the file, or the last part of the name */
    char *label;       /* name in tables and files; no two cases share one */
    int is_first;      /* of its group */
    dal_model *model;
    const dal_system *system;
    char *copy; /* of the system file, in the directory of the study; NULL: a built-in system */
    double step[STUDY_STEPS], time, displacement;
    int steps, starts; /* starts: bit STUDY_x set */
    long long samples, statistics;
    dal_options options;                 /* but step and space, and as they were given: */
    const char *option[REQUEST_OPTIONS]; /* NULL: not given */
    dal_setting *set, *start, *displace;
    int set_count, start_count, displace_count;
    char *names; /* of velocities, where start names those of a projection to D = 0 */
    dal_method *methods;
    int method_count;
    int first_cell, cells; /* its cells stand together */
    native_mode native;
} study_case;

typedef struct study_plan {
    const char *copies; /* directory with copies of system files, or NULL */
    const char *runs;   /* where the directories of the runs are */
    double interval;    /* seconds between checkpoints of a run */
    const char *title;
    document *doc; /* the parsed text, to which all names point */
    study_case *cases;
    int case_count;
    study_cell *cells;
    int cell_count;
    struct study_expectation *expectations;
    int expectation_count;
} study_plan;

/* Reads a plan and makes its systems and cells; place is the file, for messages, copies a member of
 * the plan.  Returns CLI_DONE, or prints and returns an exit status; call study_plan_free in any
 * case. */
int study_plan_read(study_plan *plan, const char *place, const char *text, size_t length,
                    const char *copies);
void study_plan_free(study_plan *plan);
/* DIRECTORY/LABEL.yaml, the copy of a system file; allocated. */
char *study_plan_copy_path(const char *directory, const study_case *item);

#endif
