/* test_checkpoints.c - the state that a run saves and restores, and memory of the caller. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <stdlib.h>
#include <string.h>

static void test_checkpoint(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(fixture_full), "gauss8", DAL_LIFTED, 0.02);
    dal_run *whole = fixture_run(&spec), *first = fixture_run(&spec), *second = fixture_run(&spec);
    size_t count;
    CU_ASSERT_EQUAL(dal_run_advance(whole, 80, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(first, 37, NULL), DAL_OK);
    const double *memory = dal_run_save(first, &count);
    CU_ASSERT_EQUAL(dal_run_restore(second, memory, count, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(second, 43, NULL), DAL_OK);
    CU_ASSERT_EQUAL(
        memcmp(dal_run_save(whole, &count), dal_run_save(second, &count), count * sizeof(double)),
        0);
    CU_ASSERT_EQUAL(dal_run_restore(second, memory, count - 1, NULL), DAL_ARGUMENT);
    dal_run_free(whole);
    dal_run_free(first);
    dal_run_free(second);
}

static void test_own_memory(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("vertical-disk"), "gauss4+project", DAL_LIFTED, 0.1);
    const size_t bytes = dal_run_size(&spec);
    CU_ASSERT_FATAL(bytes > 0);
    char *memory = malloc(bytes + 7);
    dal_run *run = NULL, *other = fixture_run(&spec);
    dal_error error;
    CU_ASSERT_EQUAL(dal_run_init(&run, memory + 7, bytes - 1, &spec, &error), DAL_MEMORY);
    CU_ASSERT_EQUAL_FATAL(dal_run_init(&run, memory + 7, bytes, &spec, &error), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 20, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(other, 20, NULL), DAL_OK);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(run), dal_run_state(other),
                           sizeof(double) * (size_t)dal_run_dimension(run)),
                    0);
    dal_run_free(run); /* frees nothing */
    dal_run_free(other);
    free(memory);
}

void suite_checkpoints(void)
{
    CU_pSuite suite = CU_add_suite("checkpoints", NULL, NULL);
    CU_add_test(suite, "checkpoint", test_checkpoint);
    CU_add_test(suite, "the caller's memory", test_own_memory);
}
