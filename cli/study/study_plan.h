/* study_plan.h - the plan of a study, read from the keys of its file. */
#ifndef DAL_CLI_STUDY_PLAN_H
#define DAL_CLI_STUDY_PLAN_H

#include "study_data.h"

/* Reads a plan and makes its systems and cells; place is the file, for messages, copies a member of
 * the plan.  Returns CLI_DONE, or prints and returns an exit status; call study_plan_free in any
 * case. */
int study_plan_read(study_plan *plan, const char *place, const char *text, size_t length,
                    const char *copies);
void study_plan_free(study_plan *plan);
/* Adds up the steps of the methods, of the cells that are not of another shard. */
void study_plan_add_steps(study_plan *plan);
/* DIRECTORY/LABEL.yaml, the copy of a system file; allocated. */
char *study_plan_copy_path(const char *directory, const study_case *item);

/* The keys of a study file: name, where it may stand, its reader and the member it reads, help.
 * Beside `systems` a key is the default of every system.  The keys of the whole study come first,
 * then keys of both, then keys of a system. */
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
    KEY(predict, "both", read_flag, item.predict, "on: single steps predict each run (off)")       \
    KEY(statistics, "both", document_read_count, item.statistics,                                  \
        "observe the quantities after every K-th step (1)")                                        \
    KEY(seeds, "both", document_read_node, seeds,                                                  \
        "integers; one case for each where a value is random")                                     \
    KEY(options, "both", read_options, item,                                                       \
        "of the runs, except step and space: {solver: newton, extend-energy: on}")                 \
    KEY(mechanics, "both", document_read_node, mechanics,                                          \
        "lagrange-dalembert, vakonomic or both (as the system file says)")                         \
    KEY(starts, "both", read_starts, item, "list of physical, surface, displaced (all three)")     \
    KEY(displacement, "both", document_read_positive, item.displacement,                           \
        "size d of p, pi where displaced (1e-8)")                                                  \
    KEY(system, "system", document_read_text, item.name, "a built-in name or a path")              \
    KEY(label, "system", read_label, item.item_label, "another name for tables and files")         \
    KEY(set, "system", document_read_node, set, "parameter: values")                               \
    KEY(start, "system", document_read_node, start, "name: values")                                \
    KEY(displace, "system", document_read_node, displace,                                          \
        "p_x: value in units of d; without it p = d, -d/2, .., pi = d/2, -d/3, ..")

#endif
