/* study_observe.h - the formulas that the runs of a study observe for its expectations. */
#ifndef DAL_CLI_STUDY_OBSERVE_H
#define DAL_CLI_STUDY_OBSERVE_H

#include "study_data.h"

/* Makes the systems again that `expect` names formulas for, and notes these in their cases; node
 * may be NULL.  Returns CLI_DONE, or prints and returns an exit status. */
int study_observe(study_plan *plan, yaml_node_t *node);

#endif
