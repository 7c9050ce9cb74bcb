/* names.c - the names of state components: x, x', e, p_x, pi_x, pi_e, g1. */
#include "run/run.h"
#include <stdio.h>

/* prefix, name of coordinate i (q1, q2, ... when it has none), suffix */
static char *compose(const dal_system *system, const char *prefix, int i, const char *suffix,
                     char *buffer, size_t size)
{
    if (system->coordinate)
        snprintf(buffer, size, "%s%s%s", prefix, system->coordinate[i], suffix);
    else
        snprintf(buffer, size, "%sq%d%s", prefix, i + 1, suffix);
    return buffer;
}

char *dal__state_name(const dal_system *system, bool lifted, int i, char *buffer, size_t size)
{
    const int n = system->n;
    if (i < 0) return NULL;
    if (i < n) return compose(system, "", i, "", buffer, size);
    if (i < 2 * n) return compose(system, "", i - n, "'", buffer, size);
    if (!lifted) {
        if (i >= 2 * n + system->multipliers) return NULL;
        snprintf(buffer, size, "g%d", i - 2 * n + 1);
        return buffer;
    }
    if (i == 2 * n || i == 4 * n + 1) {
        snprintf(buffer, size, "%s", i == 2 * n ? "e" : "pi_e");
        return buffer;
    }
    if (i < 3 * n + 1) return compose(system, "p_", i - 2 * n - 1, "", buffer, size);
    if (i < 4 * n + 1) return compose(system, "pi_", i - 3 * n - 1, "", buffer, size);
    return NULL;
}

char *dal_run_name(const dal_run *run, int i, char *buffer, size_t size)
{
    if (!run || !buffer) return NULL;
    return dal__state_name(run->layout.system, run->layout.lifted, i, buffer, size);
}
