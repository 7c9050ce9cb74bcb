/* compiler.c - compilers of native mode, for the suites that compile. */
#include "compiler.h"
#include "core/machine.h"
#include "folder.h"
#include "skip.h"
#include <CUnit/CUnit.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool compiler_there(void)
{
    const bool there = system("cc --version >/dev/null 2>&1") == 0;
    if (!there) skip_test("no compiler: what compiles, in this suite");
    return there;
}

const char *compiler_machine(void)
{
    static const char *const words[][8] = {
#define SET(set, ...) {__VA_ARGS__},
        DAL__INSTRUCTIONS_LIST(SET)
#undef SET
    };
    static char options[128];
    options[0] = '\0';
    for (const char *const *word = words[dal__machine_best()]; *word; word++) {
        strcat(options, " ");
        strcat(options, *word);
    }
    return options;
}

static const char folders[] = "/tmp/dal-compiled-XXXXXX";
char compiler_folder[sizeof folders];
bool compiler_works;
/* However busy the machine is, the compiler ends. */
const dal_native_options compiler_options = {.cache = compiler_folder, .patience = 3600};

int compiler_set_up(void)
{
    compiler_works = compiler_there();
    memcpy(compiler_folder, folders, sizeof folders);
    return !mkdtemp(compiler_folder);
}

int compiler_tear_down(void)
{
    folder_remove(compiler_folder);
    return 0;
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
