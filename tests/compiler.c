/* compiler.c - compilers of native mode, for the suites that compile. */
#include "compiler.h"
#include <CUnit/CUnit.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

bool compiler_there(void)
{
    const bool there = system("cc --version >/dev/null 2>&1") == 0;
    if (!there) puts("(no compiler here)");
    return there;
}

void compiler_fake(const char *script)
{
    FILE *file = fopen("fake.new", "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    fprintf(file, "#!/bin/sh\n%s\n", script);
    fclose(file);
    chmod("fake.new", 0700);
    rename("fake.new", "fake");
}
