/* fail_place.h - the places from which a program that is started with LD_PRELOAD makes its calls: a
 * place is the FAIL_DEPTH nearest returns into the program itself. */
#ifndef DALEMBERT_FAIL_PLACE_H
#define DALEMBERT_FAIL_PLACE_H
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* dl_iterate_phdr */
#endif
#include <execinfo.h>
#include <link.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>

#ifndef FAIL_DEPTH
#define FAIL_DEPTH 3
#endif
enum { FAIL_FRAMES = 24, FAIL_PLACES = 4096 };

static uintptr_t program_begin, program_end; /* its code */
static struct {
    uint64_t place;
    long call; /* the first one from there */
} fail_place[FAIL_PLACES];
static int fail_places;
static pthread_mutex_t fail_lock = PTHREAD_MUTEX_INITIALIZER;
static __thread int is_noting; /* calls do not count meanwhile */

static int find_code(struct dl_phdr_info *info, size_t size, void *user)
{
    (void)size, (void)user;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *part = info->dlpi_phdr + i;
        if (part->p_type != PT_LOAD || !(part->p_flags & PF_X)) continue;
        program_begin = info->dlpi_addr + part->p_vaddr;
        program_end = program_begin + part->p_memsz;
    }
    return 1; /* the program comes first */
}

/* Before any call is noted: backtrace loads what it needs. */
static void fail_places_begin(void)
{
    void *frame[1];
    backtrace(frame, 1);
    dl_iterate_phdr(find_code, NULL);
}

/* Notes a call of this number, if it is the first one from its place. */
static void fail_places_note(long call)
{
    void *frame[FAIL_FRAMES];
    uint64_t place = 0;
    is_noting = 1;
    const int frames = backtrace(frame, FAIL_FRAMES);
    for (int i = 0, depth = 0; i < frames && depth < FAIL_DEPTH; i++) {
        const uintptr_t at = (uintptr_t)frame[i];
        if (at < program_begin || at >= program_end) continue;
        place = place * 0x100000001b3u ^ (at - program_begin);
        depth++;
    }
    pthread_mutex_lock(&fail_lock);
    int i = 0;
    while (i < fail_places && fail_place[i].place != place) i++;
    if (i == fail_places && i < FAIL_PLACES) {
        fail_place[i].place = place;
        fail_place[i].call = call;
        fail_places++;
    }
    pthread_mutex_unlock(&fail_lock);
    is_noting = 0;
}

/* A line for each place: the number of the call, and the place. */
static void fail_places_print(FILE *log)
{
    for (int i = 0; i < fail_places; i++)
        fprintf(log, "%ld %llx\n", fail_place[i].call, (unsigned long long)fail_place[i].place);
}

#endif
