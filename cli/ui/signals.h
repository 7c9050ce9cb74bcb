/* signals.h - SIGINT and SIGTERM as a flag, so that a run can end between two steps. */
#ifndef DAL_CLI_SIGNALS_H
#define DAL_CLI_SIGNALS_H

#include <stdbool.h>

/* From this call on SIGINT and SIGTERM set a flag, and a second one kills.  One second after the
 * first one, a read or a write that waits for another process fails with EINTR. */
void cli_catch_signals(void);
bool cli_interrupted(void);
/* From this call on a write to a pipe that nobody reads fails with EPIPE. */
void cli_catch_broken_pipe(void);

#endif
