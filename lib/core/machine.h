/* machine.h - the variants of the sources over num, and which of them this machine can run.
 *
 * A source over num is compiled once for each variant: a number of lanes and an instruction set.
 * All variants give the same bits.  The Makefile has the list and writes it to variants.h:
 *
 *     DAL__VARIANT_LIST(VARIANT, name):  VARIANT(name, x4, 4, BASE, x4) VARIANT(name, x8, ...) ...
 *     DAL__INSTRUCTIONS_LIST(SET):       SET(BASE, NULL) SET(AVX2, "-mavx2", "-mfma", NULL) ...
 *
 * with a name for macros, the variant (its suffix), its lanes, its instruction set, and the variant
 * whose integrators it uses, one per group of lanes (kernel/groups.h).  Of two variants with the
 * same lanes the better one comes later.  The list lacks x1, which every machine has.  An
 * instruction set comes with its compiler options.  QUAD is no instruction set of a machine:
 * x1_QUAD computes in quad precision (kernel/quad.h) and is requested by name. */
#ifndef DAL_MACHINE_H
#define DAL_MACHINE_H

#include "variants.h"
#include <stdbool.h>

/* A later one is better. */
typedef enum dal__instructions {
#define SET(set, ...) DAL__##set,
    DAL__INSTRUCTIONS_LIST(SET)
#undef SET
        DAL__INSTRUCTION_SETS
} dal__instructions;

enum { DAL__BLOCK = 64 }; /* max lanes of a variant */

/* Whether this machine has an instruction set; BASE is what the whole library is compiled for. */
bool dal__machine_has(dal__instructions set);
dal__instructions dal__machine_best(void);

#endif
