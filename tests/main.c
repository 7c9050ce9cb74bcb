/* main.c - runs the CUnit suites: all, or those named; --list names them, --quick cuts long runs;
 * --bits PART/PARTS compares generated code instead, see bits.h; --trends [SERIES [KIND]] prints
 * how often trends are right, see trend_matrix.h. */
#include "bits.h"
#include "fixtures.h"
#include "quick.h"
#include "skip.h"
#include "trend_matrix.h"

#include <CUnit/Basic.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    void (*add)(void);
} suites[] = {
#define X(name) {#name, suite_##name},
    SUITE_LIST(X)
#undef X
};

enum { SUITES = sizeof suites / sizeof suites[0] };

static int quick;

long long long_run(long long count) { return quick ? (count + 99) / 100 : count; }

int large_size(int size) { return quick ? (size + 7) / 8 : size; }

int case_stride(int stride) { return quick ? stride : 1; }

static int add(const char *name)
{
    for (int i = 0; i < SUITES; i++)
        if (strcmp(suites[i].name, name) == 0) return suites[i].add(), 1;
    fprintf(stderr, "no suite '%s'; try --list\n", name);
    return 0;
}

static int list(void)
{
    for (int i = 0; i < SUITES; i++) puts(suites[i].name);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--list") == 0) return list();
    if (argc == 3 && strcmp(argv[1], "--bits") == 0) return bits_part(argv[2]);
    if (argc > 1 && strcmp(argv[1], "--trends") == 0) return trend_matrix_print(argc - 2, argv + 2);
    if (argc > 1 && strcmp(argv[1], "--quick") == 0) quick = 1, argc--, argv++;
    if (CU_initialize_registry() != CUE_SUCCESS) return 2;
    for (int i = 1; i < argc; i++)
        if (!add(argv[i])) return 2;
    for (int i = 0; argc == 1 && i < SUITES; i++) suites[i].add();
    CU_basic_set_mode(CU_BRM_NORMAL);
    int broken = CU_basic_run_tests() != CUE_SUCCESS;
    unsigned failures = CU_get_number_of_failure_records() + skip_failures();
    CU_cleanup_registry();
    fixture_free();
    return broken || failures > 0;
}
