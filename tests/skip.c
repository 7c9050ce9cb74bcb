/* skip.c - tests that cannot be made on this machine. */
#include "skip.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned skips;

void skip_test(const char *reason)
{
    printf("(skipped: %s) ", reason);
    skips++;
}

unsigned skip_failures(void)
{
    const char *ci = getenv("CI");
    const int fails = ci && strcmp(ci, "true") == 0;
    if (skips)
        printf("suite: %u times tests are skipped%s\n", skips, fails ? ", though CI is true" : "");
    return fails ? skips : 0;
}
