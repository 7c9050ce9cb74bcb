/* machine.c - the instruction sets of this machine. */
#include "core/machine.h"

bool dal__machine_has(dal__instructions set)
{
    switch (set) {
    case DAL__BASE:
        return true;
#if defined(__x86_64__)
    case DAL__AVX2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case DAL__AVX512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma");
#endif
    default:
        return false;
    }
}

dal__instructions dal__machine_best(void)
{
    int set = DAL__INSTRUCTION_SETS - 1;
    while (!dal__machine_has((dal__instructions)set)) set--;
    return (dal__instructions)set;
}
