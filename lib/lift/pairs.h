/* pairs.h - regular pairs of an antisymmetric matrix. */
#ifndef DAL_LIFT_PAIRS_H
#define DAL_LIFT_PAIRS_H

#include <stdbool.h>

/* Chooses rows of an antisymmetric matrix, entry[n*n], by elimination of pairs, until no entry
 * remains: is_chosen[n] of them form a regular matrix of the same rank.  Rows with is_favoured[n]
 * come first, then large entries.  entry and terms[n*n] are destroyed. */
void dal__choose_pairs(int n, double *entry, double *terms, const bool *is_favoured,
                       bool *is_chosen);

#endif
