/* progress.h - shows the progress of a run. */
#ifndef DAL_CLI_PROGRESS_H
#define DAL_CLI_PROGRESS_H

/* code, word */
#define PROGRESS_LIST(MODE) MODE(AUTO, auto) MODE(JSON, json) MODE(OFF, off)

typedef enum progress_mode {
#define PROGRESS_CODE(code, word) PROGRESS_##code,
    PROGRESS_LIST(PROGRESS_CODE)
#undef PROGRESS_CODE
} progress_mode;

struct run_recorder;

/* Parses a word of the list.  Returns CLI_DONE or prints and returns CLI_USAGE. */
int progress_parse(const char *text, progress_mode *mode);
/* Shows the time that a run has reached, not too often; JSON always has the end. */
void progress_show(struct run_recorder *recorder, double t, int at_the_end);

#endif
