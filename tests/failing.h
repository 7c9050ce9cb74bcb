/* failing.h - a system of which one call fails, as callbacks of a caller may. */
#ifndef FAILING_H
#define FAILING_H

#include <dalembert.h>

/* A copy without programs of lanes, series and extended precision, of which each callback but
 * `exact`, in double and in quad precision, may fail, or each of these names, the last of which is
 * NULL; one at a time.  It leaves a misleading number and returns DAL_STATUS_IO. */
dal_system failing_system(const dal_system *system, const char *const *names);
/* Their calls are counted from now on, and those with the numbers call to last, from 1, fail. */
void failing_begin(long call, long last);
long failing_calls(void);       /* since then */
const char *failing_name(void); /* the callback that failed */
/* The names of all callbacks, without branches; NULL ends them. */
extern const char *const failing_callbacks[];

#endif
