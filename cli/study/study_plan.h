/* study_plan.h - the plan of a study: the keys of its file, its cases and their cells. */
#ifndef DAL_CLI_STUDY_PLAN_H
#define DAL_CLI_STUDY_PLAN_H

#include "io/document.h"
#include "run/native.h"
#include "run/request.h"
#include "study_cell.h"

#include <stdbool.h>

enum { STUDY_STEPS = 16, STUDY_TOLERANCES = 16, STUDY_REPRESENTATIVES = 16 };

/* What is kept of runs: a directory with rows for each, or the results alone, for many short runs.
 */
typedef enum study_rows { STUDY_ROWS_KEPT, STUDY_ROWS_NONE } study_rows;

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
    char *observe; /* formulas that the runs of the group observe, as in --observe; NULL: none */
    char *path;    /* of the system file, from the working directory; NULL: there is a copy, or the
                      system is built in */
    char *copy;    /* of the system file, in the directory of the study; NULL: a built-in system */
    double step[STUDY_STEPS], from, time, displacement; /* time: NaN: not given, but: */
    double tolerance[STUDY_TOLERANCES]; /* positive; of the methods that control their error */
    long long run_steps;                /* steps of each run; 0: not given, but time */
    int rows;                           /* a study_rows */
    int steps, tolerances, starts;      /* tolerances: 0: the options; starts: bit STUDY_x set */
    long long samples, statistics;
    dal_options options;                   /* but step and space, and as they were given: */
    const char *option[REQUEST_OPTIONS];   /* NULL: not given */
    request_settings set, start, displace; /* displace: in units of displacement */
    dal_method *methods;
    int method_count;
    double (*method_steps)[2]; /* [method_count] that the cells of the group take, on each space */
    int first_cell, cells;     /* its cells stand together */
} study_case;

typedef struct study_plan {
    const char *copies;            /* directory with copies of system files, or NULL */
    const char *runs;              /* where the directories of the runs are */
    struct study_results *results; /* of the cells that keep no rows; NULL where all do */
    double interval;               /* seconds between checkpoints of a run */
    native_mode native;
    const char *title;
    document *doc; /* the parsed text, to which all names point */
    study_case *cases;
    int case_count;
    study_cell *cells;
    int cell_count;
    struct study_expectation *expectations;
    int expectation_count;
    dal_method representative[STUDY_REPRESENTATIVES];
    int representatives;
    double seconds;      /* that the runs have taken */
    bool has_tolerances; /* a case has the key tolerance: files have that column */
    bool shows_tables, shows_matrices;
} study_plan;

/* Reads a plan and makes its systems and cells; place is the file, for messages, copies a member of
 * the plan.  Returns CLI_DONE, or prints and returns an exit status; call study_plan_free in any
 * case. */
int study_plan_read(study_plan *plan, const char *place, const char *text, size_t length,
                    const char *copies);
void study_plan_free(study_plan *plan);
/* Adds up the steps of the methods, of the cells that are not of another shard. */
void study_plan_add_steps(study_plan *plan);
/* Where the runs of a step end, in t. */
double study_case_end(const study_case *item, double step);
/* DIRECTORY/LABEL.yaml, the copy of a system file; allocated. */
char *study_plan_copy_path(const char *directory, const study_case *item);
/* What the system of a case is read from: its copy, its file, or its name. */
const char *study_case_system(const study_case *item);

/* The keys of a study file: name, where it may stand, its reader and the member it reads, help.
 * Beside `systems` a key is the default of every system.  The keys of the whole study come first,
 * then those of both, then those of a system. */
#define STUDY_KEY_LIST(KEY)                                                                        \
    KEY(title, "study", document_read_text, title, "title of tables and pages")                    \
    KEY(systems, "study", document_read_node, systems,                                             \
        "list of names, paths, or mappings of the keys below")                                     \
    KEY(expect, "study", document_read_node, expect,                                               \
        "label: {integrator: {quantity or formula: expected result}}; see below")                  \
    KEY(representatives, "study", document_read_node, representatives,                             \
        "at most 16 of the integrators, for the screen (the first of each family)")                \
    KEY(integrators, "both", document_read_node, integrators,                                      \
        "list of names, with modifiers or not; all or all+project: every integrator")              \
    KEY(step, "both", read_step, item, "one step, or at most 16; negative: backwards")             \
    KEY(tolerance, "both", read_tolerance, item,                                                   \
        "of adaptive methods, at most 16; the step may be missing then")                           \
    KEY(time, "both", read_end, item.time, "integrate to this, in whole steps")                    \
    KEY(steps, "both", read_end, item.run_steps, "or take this number of steps; excludes time")    \
    KEY(from, "both", document_read_number, item.from, "the time of the start (0)")                \
    KEY(samples, "both", document_read_count, item.samples, "rows kept of each run (400)")         \
    KEY(rows, "both", read_rows, item.rows,                                                        \
        "kept (default), or none: many short runs leave their results, and no files each")         \
    KEY(statistics, "both", document_read_count, item.statistics,                                  \
        "observe the quantities after every K-th step (1)")                                        \
    KEY(seeds, "both", document_read_node, seeds,                                                  \
        "integers; one case for each where a value is random")                                     \
    KEY(options, "both", read_options, item,                                                       \
        "of the runs, except step and space: {solver: newton, extend-energy: on}")                 \
    KEY(starts, "both", read_starts, item, "list of physical, surface, displaced (all three)")     \
    KEY(displacement, "both", document_read_positive, item.displacement,                           \
        "size d of p, pi where displaced (1e-8)")                                                  \
    KEY(system, "system", document_read_text, item.name, "a built-in name or a path")              \
    KEY(label, "system", read_label, item.group, "another name for tables and files")              \
    KEY(set, "system", document_read_node, set, "parameter: values")                               \
    KEY(start, "system", document_read_node, start, "name: values")                                \
    KEY(displace, "system", document_read_node, displace,                                          \
        "p_x: value in units of d; without it p = d, -d/2, .., pi = d/2, -d/3, ..")

/* A case, the nodes that need its system, and what only the whole study has. */
typedef struct parsed_study {
    study_case item;
    yaml_node_t *integrators, *set, *start, *displace, *seeds;
    yaml_node_t *systems, *expect, *representatives;
    const char *title;
} parsed_study;

#endif
