/* test_generate_bits.c - tape, batches and generated files: the same bits, for each integrator,
 * each system, each compiler and level of optimisation at least once.  All of them with all others:
 * make check-bits. */
#include "bits.h"
#include "quick.h"
#include <CUnit/CUnit.h>

static void test_cover(void)
{
    if (long_run(100) == 100) CU_ASSERT_EQUAL(bits_cover(), 0); /* compilers under valgrind: no */
}

void suite_generate_bits(void);
void suite_generate_bits(void)
{
    CU_pSuite suite = CU_add_suite("generate_bits", NULL, NULL);
    CU_add_test(suite, "each integrator, system and build", test_cover);
}
