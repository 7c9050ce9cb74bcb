/* leaf.h - the leaf of an integrable D that the start is on. */
#ifndef DAL_STEER_LEAF_H
#define DAL_STEER_LEAF_H

#include "steer/problem.h"

/* Refuses a target off the leaf of the start, and finds p->knows_leaf.  steering has the growth
 * vector of D.  [alloc]  Errors: DAL_STATUS_INCONSISTENT
 * (the target is off the leaf), DAL_STATUS_MEMORY. */
dal_status dal__leaf_check(dal__problem *p, const dal_steering *steering);

#endif
