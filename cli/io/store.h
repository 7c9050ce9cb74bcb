/* store.h - what the directories of runs, studies and ensembles have in common: files, locks,
 * shards, manifests. */
#ifndef DAL_CLI_STORE_H
#define DAL_CLI_STORE_H

#include "file.h"
#include "json.h"
#include "ui/options.h"

#include <stdbool.h>
#include <stdint.h>

/* ---- files --------------------------------------------------------------------------------- */

/* The paths of the files that LIST(FILE) names by FILE(member, name): members of a struct, and all
 * of them as file[]. */
#define STORE_PATHS(LIST)                                                                          \
    union {                                                                                        \
        struct {                                                                                   \
            LIST(STORE_PATH)                                                                       \
        };                                                                                         \
        char *file[0 LIST(STORE_ONE)];                                                             \
    }
#define STORE_PATH(member, name) char *member;
#define STORE_ONE(member, name)  +1
/* Allocates them and frees them. */
#define STORE_MAKE_PATHS(dir, LIST)                                                                \
    store_make_paths((dir)->path, (const char *const[]){LIST(STORE_NAME)}, (dir)->file,            \
                     0 LIST(STORE_ONE))
#define STORE_NAME(member, name) name,
void store_make_paths(const char *directory, const char *const *names, char **file, int count);
void store_free_paths(char **file, int count);
/* Removes a file, or a directory with what is in it, down to that depth; either may be absent.
 * Returns CLI_DONE, or prints and returns CLI_IO. */
int store_remove(const char *path, int depth);

/* ---- locks --------------------------------------------------------------------------------- */

/* Both return CLI_DONE, also where a network file system has no locks, so that the user must take
 * care; or print and return an exit status. */

/* Locks a file for this process alone, CLI_USAGE where another one has it.  The lock is lost where
 * the process closes any descriptor of the file. */
int store_lock(int descriptor, const char *path);
/* Waits for the file DIR/lock, and locks it until *descriptor is closed; -1: it was not opened. */
int store_wait(const char *directory, int *descriptor);
/* Before something new is written: makes the directory, which without force must be the program's
 * or empty, and waits as above. */
int store_begin(const char *directory, bool force, int *descriptor);

/* ---- shards -------------------------------------------------------------------------------- */

/* Items k - 1, k - 1 + n, k - 1 + 2n, .. of n shards; count 0: all. */
typedef struct store_shard {
    long long number, count;
} store_shard;

/* What a reader is that runs none of the items: all the shards of a directory. */
#define STORE_ALL_SHARDS ((store_shard){0, -1})

bool store_shard_has(store_shard shard, int item);
/* The option --shard K/N, which stores a store_shard. */
cli_parser store_parse_shard;
#define STORE_SHARD_OPTION(settings, help)                                                         \
    {                                                                                              \
        "shard", "K/N", NULL, help, CLI_ROW(store_parse_shard, settings, shard)                    \
    }

/* The file that a shard has in its directory: whole, or STEM-K-of-N and an ending. */
typedef struct store_shard_file {
    const char *whole, *stem, *ending;
} store_shard_file;

/* Its path, allocated. */
char *store_shard_path(const char *directory, store_shard_file file, store_shard shard);
/* The shards that have their files there, allocated, in no order; or prints and returns CLI_IO. */
int store_find_shards(const char *directory, store_shard_file file, store_shard **shards,
                      int *count);
/* Removes their files. */
int store_remove_shards(const char *directory, store_shard_file file);

/* ---- marks --------------------------------------------------------------------------------- */

/* Which items are done: a file for each shard with a word of 64 bits, the fingerprint of what they
 * belong to, and a byte for each item, 1 where what it has made is on the disk, 0 where it is to be
 * made again. */
typedef struct store_marks {
    const char *what, *directory; /* what has the items, for messages, and where it is */
    store_shard_file file;
    store_shard shard; /* whose file is written */
    int count;
    uint64_t fingerprint;
    unsigned char *done; /* [count] of all shards */
    char *path;          /* of the file that is written; */
    int descriptor;      /* locked */
} store_marks;

/* Reads what all shards have done and takes the file of one for this process alone; of
 * STORE_ALL_SHARDS nothing can be saved.  All return CLI_DONE, or print and return an exit status;
 * a closed one may be closed again. */
int store_open_marks(store_marks *marks);
/* Reads what other processes have done by now; whether that is all. */
int store_update_marks(store_marks *marks, bool *is_complete);
int store_save_marks(const store_marks *marks);
void store_close_marks(store_marks *marks);

/* ---- manifests ----------------------------------------------------------------------------- */

/* A manifest that is written: an object that begins with the version of the program. */
typedef struct store_manifest {
    json_writer json;
    char *text;
    size_t length;
} store_manifest;

/* Ends and frees what it began, and replaces the file as a whole.  Returns CLI_DONE, or prints and
 * returns CLI_IO. */
void store_begin_manifest(store_manifest *manifest);
int store_end_manifest(store_manifest *manifest, const char *path, file_sync sync);
/* Reads one, *bytes being its text; both are to be freed after a failure, too.  Returns CLI_DONE,
 * or prints and returns an exit status. */
int store_read_manifest(const char *path, document **manifest, char **bytes);
void store_free_manifest(document *manifest);
/* Continues a hash by the text of a system, the library's unless that is NULL, or a copy's. */
int store_hash_system(uint64_t *hash, const char *builtin, const char *copy);

/* ---- states -------------------------------------------------------------------------------- */

/* How far something is: code, what its manifest says. */
#define STORE_STATE_LIST(STATE)                                                                    \
    STATE(RUNNING, "running")                                                                      \
    STATE(INTERRUPTED, "interrupted")                                                              \
    STATE(FAILED, "failed")                                                                        \
    STATE(UNMET, "unmet") /* done, and not as it was expected */                                   \
    STATE(DONE, "done")
typedef enum store_state {
#define STORE_STATE(code, word) STORE_##code,
    STORE_STATE_LIST(STORE_STATE)
#undef STORE_STATE
        STORE_STATES
} store_state;

extern const char *const store_state_words[STORE_STATES];
/* What an exit status leaves. */
store_state store_end_state(int exit_status);
/* What a manifest says, STORE_STATES: nothing, and why: a text of its own, NULL: nothing; the state
 * of one that is a file. */
store_state store_stated(const document *manifest, const char **message);
int store_read_state(const char *path, store_state *state);
/* Says how an interrupted directory is resumed; returns CLI_SIGNAL. */
int store_interrupt(const char *directory);

#endif
