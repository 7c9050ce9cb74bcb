/* parsed_study.h - the keys of a study file, before systems are loaded. */
#ifndef DAL_CLI_PARSED_STUDY_H
#define DAL_CLI_PARSED_STUDY_H

#include "study_plan.h"

/* The keys of a study file: name, where it may stand, its reader and the member it reads, help.
 * Beside `systems` a key is the default of every system.  The keys of the whole study come first,
 * then those of both, then those of a system. */
#define STUDY_KEY_LIST(KEY)                                                                        \
    KEY(title, "study", document_read_text, title, "title of tables and pages")                    \
    KEY(systems, "study", document_read_node, systems,                                             \
        "list of names, paths, or mappings of the keys below")                                     \
    KEY(expect, "study", document_read_node, expect,                                               \
        "label: {integrator: {quantity: expected result}}; see below")                             \
    KEY(integrators, "both", document_read_node, integrators,                                      \
        "list of names, with modifiers or not; all or all+project: every integrator")              \
    KEY(step, "both", read_steps, item, "one step, or at most 16")                                 \
    KEY(time, "both", document_read_positive, item.time,                                           \
        "integrate from 0 to this, in whole steps")                                                \
    KEY(samples, "both", document_read_count, item.samples, "rows kept of each run (400)")         \
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
    yaml_node_t *systems, *expect;
    const char *title;
} parsed_study;

/* Read the keys of a study, or of one of its systems, over the defaults in parsed.  Return
 * CLI_DONE, or print and return CLI_USAGE. */
int parsed_study_read(parsed_study *parsed, const document *doc, yaml_node_t *node);
int parsed_study_read_system(parsed_study *parsed, const document *doc, yaml_node_t *node);

#endif
