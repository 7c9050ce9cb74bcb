/* programs.h - makes the programs of a system: which nodes each computes, which pivots it
 * checks. */
#ifndef DAL_MODEL_PROGRAMS_H
#define DAL_MODEL_PROGRAMS_H

#include "model/model.h"

/* Frees tapes and series. */
void dal__programs_free(dal__programs *programs);
/* Begins the programs of a system whose coordinates and velocities have n symbols each; pivots are
 * saved for the rank check once dal__programs_save_pivots was called.  This and what adds programs
 * leave model->out_of_memory, which dal__programs_finish returns. */
void dal__programs_begin(dal_model *model, dal__programs *programs, int n, int multipliers);
void dal__programs_save_pivots(const dal__equations *e, dal__programs *programs);
/* Adds a program: the nodes of some lists, followed by the pivots it checks; or of one list. */
typedef struct dal__nodes {
    const dal__node *list;
    int count;
} dal__nodes;
void dal__programs_add_lists(dal_model *model, dal__programs *programs, dal__program_code code,
                             const dal__nodes *lists, int count);
void dal__programs_add(dal_model *model, dal__programs *programs, dal__program_code code,
                       const dal__node *outputs, int count);
/* Adds field, adjoint and jacobian of dx/dt = F: nw nodes, the first n of them accelerations. */
void dal__programs_add_motion(dal_model *model, dal__programs *programs, const dal__node *F);
/* Adds what names the pivot, the constraint or the table where a motion fails. */
void dal__programs_add_diagnosis(dal_model *model, dal__programs *programs);
/* The programs of a model's system; NULL for another. */
const dal__programs *dal__programs_of(const dal_system *system);
/* Finishes the tapes and points the system to its callbacks, and to itself in quad precision. */
dal_status dal__programs_finish(dal_model *model, dal__programs *programs, dal_system *system);

/* Sets *call to the callbacks of a variant; what runs its programs. */
#define DAL__CALLBACKS(name, variant, lanes, set)                                                  \
    dal__run_program *name##_##variant(const dal__programs *programs, dal_callbacks *call);
#define DAL__DECLARE_SERIES(name, variant, lanes, set) extern dal_series_callback name##_##variant;
DAL__CALLBACKS(dal__fill_callbacks, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__CALLBACKS, dal__fill_callbacks)
DAL__DECLARE_SERIES(dal__call_series, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__DECLARE_SERIES, dal__call_series)

#endif
