/* numbers.c - what decimal numbers cost: doubles with 17 digits, written and read.
 *
 *     numbers write | printf | read | strtod
 *
 * By the library and by the C library; nanoseconds per character, so that 4 are 250 MB/s. */
#include "bench.h"
#include "dalembert.h"
#include "dalembert_program.h"

enum { COUNT = 4096, CHECKED = 64 };

typedef struct numbers {
    double value[COUNT];
    char text[COUNT][DAL__NUMBER_SIZE];
} numbers;

static int check(const numbers *n, double *end)
{
    for (int i = 0; i < CHECKED; i++) end[i] = strtod(n->text[i], NULL) + n->value[i];
    return 0;
}

static int by_library(void *self, double *end)
{
    numbers *n = self;
    for (int i = 0; i < COUNT; i++) dal__format_number(n->text[i], n->value[i]);
    return check(n, end);
}

static int by_printf(void *self, double *end)
{
    numbers *n = self;
    for (int i = 0; i < COUNT; i++) snprintf(n->text[i], DAL__NUMBER_SIZE, "%.17g", n->value[i]);
    return check(n, end);
}

static int read_by_library(void *self, double *end)
{
    numbers *n = self;
    for (int i = 0; i < COUNT; i++)
        if (dal__parse_number(n->text[i], strlen(n->text[i]), &n->value[i]) != DAL_STATUS_OK)
            return 1;
    return check(n, end);
}

static int read_by_strtod(void *self, double *end)
{
    numbers *n = self;
    for (int i = 0; i < COUNT; i++) n->value[i] = strtod(n->text[i], NULL);
    return check(n, end);
}

int main(int argc, char **argv)
{
    static numbers n;
    static const struct {
        const char *name;
        int (*work)(void *self, double *end);
    } contenders[] = {{"write", by_library},
                      {"printf", by_printf},
                      {"read", read_by_library},
                      {"strtod", read_by_strtod}};
    double characters = 0.0;
    for (int i = 0; i < COUNT; i++) {
        n.value[i] = 10.0 * sin(i + 1.0);
        characters += dal__format_number(n.text[i], n.value[i]);
    }
    for (size_t i = 0; i < sizeof contenders / sizeof *contenders; i++)
        if (bench_is(argc, argv, contenders[i].name))
            return bench_measure(&(bench_contender){characters, CHECKED, contenders[i].work, &n});
    return bench_unknown(argc, argv);
}
