/* machine.h - the variants of the sources over num, and which of them this machine can run.
 *
 * A source over num is compiled once for each variant: a number of lanes and an instruction set.
 * All variants give the same bits.  The Makefile has the list and writes it to variants.h:
 *
 *     DAL__VARIANT_LIST(VARIANT, name):  VARIANT(name, x4_AVX2, 4, AVX2) ...
 *     DAL__INSTRUCTIONS_LIST(SET):       SET(BASE, NULL) SET(AVX2, "-mavx2", "-mfma", NULL) ...
 *
 * with a name for macros, the variant (its suffix), its lanes and its instruction set.  Of two
 * variants with the same lanes the better one comes later.  The list lacks x1, which every machine
 * has and an integrator outside the library may have alone.  An
 * instruction set comes with its compiler options.  QUAD is no instruction set of a machine:
 * x1_QUAD computes in quad precision (kernel/quad.h) and is requested by name; DAL__HAS_QUAD is 0
 * where the list lacks it, too. */
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

enum { DAL__MAX_LANES = 8 }; /* of a variant */

/* Whether this machine has an instruction set; BASE is what the whole library is compiled for. */
bool dal__machine_has(dal__instructions set);
dal__instructions dal__machine_best(void);

#endif
