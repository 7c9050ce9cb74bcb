/* machine.h - the variants of the sources over num, and which of them this machine can run.
 *
 * A source over num is compiled once for each variant: a number of lanes and an instruction set.
 * All give the same bits.  The Makefile holds the list and writes it to variants.h:
 *
 *     DAL__VARIANT_LIST(X, name):   X(name, x4_AVX2, 4, AVX2) X(name, x8_AVX512, 8, AVX512) ...
 *     DAL__INSTRUCTIONS_LIST(X):    X(BASE, NULL) X(AVX2, "-mavx2", "-mfma", NULL) ...
 *
 * with the name of the function, the variant (its suffix), its lanes and its instruction set; of
 * two variants with the same lanes the better one comes later.  x1, which every machine has and an
 * integrator from outside may have alone, is not in it.  An instruction set comes with the options
 * that a compiler needs for it.  QUAD is no instruction set of a machine: x1_QUAD computes in quad
 * precision (kernel/quad.h) and is selected by name. */
#ifndef DAL_MACHINE_H
#define DAL_MACHINE_H

#include "variants.h"
#include <stdbool.h>

/* The better the later. */
typedef enum dal__instructions {
#define SET(set, ...) DAL__##set,
    DAL__INSTRUCTIONS_LIST(SET)
#undef SET
        DAL__INSTRUCTION_SETS
} dal__instructions;

enum { DAL__MAX_LANES = 8 };

/* Whether this machine has an instruction set; BASE is what the whole library is compiled for. */
bool dal__machine_has(dal__instructions set);
dal__instructions dal__machine_best(void);

#endif
