/* work.h - a list of work: the cells of a study, the chunks of an ensemble. */
#ifndef DAL_CLI_WORK_H
#define DAL_CLI_WORK_H

#include <stdbool.h>

/* Called now and then while an item is run: whether to stop it. */
typedef struct work_stop {
    bool (*stop)(void *user);
    void *user;
} work_stop;

/* No result may depend on who runs an item, or when. */
typedef struct work_list {
    void *user;
    int count;
    const int *order; /* [count] the numbers of the items, the first first; NULL: 0, 1, .. */
    /* Whether an item is to be run, as all who share the list know it before they begin. */
    bool (*is_due)(void *user, int item);
    /* Runs one.  Returns CLI_DONE, CLI_SIGNAL where it was stopped, or an exit status after a
     * message.  Several threads call it. */
    int (*run)(void *user, int item, const work_stop *stop);
    /* Takes note of its end, for one thread at a time; returns the status, or another failure. */
    int (*end)(void *user, int item, int status);
    void (*show)(void *user); /* shows progress, for one thread at a time */
    bool ends_early;          /* after a failure nothing more is begun */
} work_list;

/* What runs a list.  Returns CLI_DONE, CLI_SIGNAL after an interruption, or the first failure. */
typedef int work_runner(const work_list *list, int threads);

/* On threads of this process. */
work_runner work_on_threads;

#endif
