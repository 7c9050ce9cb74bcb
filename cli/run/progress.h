/* progress.h - shows the progress of a run. */
#ifndef DAL_CLI_PROGRESS_H
#define DAL_CLI_PROGRESS_H

/* The words of --progress, "auto|json|off". */
typedef enum progress_mode { PROGRESS_AUTO, PROGRESS_JSON, PROGRESS_OFF } progress_mode;

struct run_recorder;

/* Shows the time that a run has reached, not too often; JSON always has the end. */
void progress_show(struct run_recorder *recorder, double t, int at_the_end);

#endif
