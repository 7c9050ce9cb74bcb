/* allocation.c - malloc, calloc, realloc, aligned_alloc and free of the tests, linked with --wrap,
 * and the functions of libyaml that allocate: a call of these counts as one allocation. */
#include "allocation.h"
#include "quick.h"

#include <CUnit/CUnit.h>
#include <stdatomic.h>
#include <stddef.h>
#include <yaml.h>

static _Thread_local long left = -1;
static _Thread_local int failed;
static _Thread_local bool fails_once; /* and the allocations after it succeed */
static atomic_long blocks;            /* allocated and not yet freed, of all threads */

void allocation_fail_after(long count)
{
    left = count;
    failed = 0;
    fails_once = false;
}

int allocation_failed(void) { return failed; }

static int refuse(void)
{
    if (left < 0) return 0;
    if (left > 0) return left--, 0;
    if (fails_once) left = -1;
    return failed = 1;
}

/* Counts the block that a successful call made. */
static void *counted(void *memory)
{
    if (memory) blocks++;
    return memory;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *memory);

void *__wrap_malloc(size_t size) { return refuse() ? NULL : counted(__real_malloc(size)); }

void *__wrap_calloc(size_t count, size_t size)
{
    return refuse() ? NULL : counted(__real_calloc(count, size));
}

void *__wrap_realloc(void *memory, size_t size)
{
    if (refuse()) return NULL;
    return memory ? __real_realloc(memory, size) : counted(__real_realloc(NULL, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return refuse() ? NULL : counted(__real_aligned_alloc(alignment, size));
}

void __wrap_free(void *memory)
{
    if (memory) blocks--;
    __real_free(memory);
}

int __real_yaml_parser_initialize(yaml_parser_t *parser);
int __real_yaml_parser_parse(yaml_parser_t *parser, yaml_event_t *event);
int __wrap_yaml_parser_initialize(yaml_parser_t *parser);
int __wrap_yaml_parser_parse(yaml_parser_t *parser, yaml_event_t *event);

int __wrap_yaml_parser_initialize(yaml_parser_t *parser)
{
    return refuse() ? 0 : __real_yaml_parser_initialize(parser);
}

int __wrap_yaml_parser_parse(yaml_parser_t *parser, yaml_event_t *event)
{
    if (!refuse()) return __real_yaml_parser_parse(parser, event);
    parser->error = YAML_MEMORY_ERROR; /* which stays */
    return 0;
}

/* ---- trials ---- */

bool allocation_next(allocation_trial *trial)
{
    if (trial->failures == 0 && !trial->is_single && !trial->passed) trial->blocks = blocks;
    CU_ASSERT_EQUAL(blocks, trial->blocks);
    return !trial->passed;
}

void allocation_start(const allocation_trial *trial)
{
    allocation_fail_after(trial->failures);
    fails_once = trial->is_single;
}

bool allocation_end(allocation_trial *trial, dal_status status)
{
    CU_ASSERT_EQUAL(status, failed ? DAL_STATUS_MEMORY : DAL_STATUS_OK);
    left = -1;
    trial->passed = !failed;
    if (failed && trial->is_single) trial->failures += case_stride(2);
    trial->is_single = !trial->is_single;
    return failed;
}
