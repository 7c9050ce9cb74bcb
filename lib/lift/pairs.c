/* pairs.c - regular pairs of an antisymmetric matrix. */
#include "lift/pairs.h"
#include <math.h>

/* Entries below this fraction of what they are a sum of are 0. */
static const double rank_tolerance = 1e-9;

void dal__choose_pairs(int n, double *entry, double *terms, const bool *is_favoured,
                       bool *is_chosen)
{
    for (int i = 0; i < n * n; i++) terms[i] = fabs(entry[i]);
    for (;;) {
        int best_rank = -1, a = 0, b = 0;
        double best = 0.0;
        for (int ij = 0; ij < n * n; ij++) {
            const int i = ij / n, j = ij % n, rank = is_favoured[i] + is_favoured[j];
            const double x = fabs(entry[ij]);
            if (j <= i || x == 0.0 || rank < best_rank || (rank == best_rank && x <= best))
                continue;
            best = x, best_rank = rank, a = i, b = j;
        }
        if (best_rank < 0) return;
        const double pivot = entry[a * n + b];
        for (int ij = 0; ij < n * n; ij++) {
            const int i = ij / n, j = ij % n;
            if (i == a || i == b || j == a || j == b) continue;
            const double by_a = entry[i * n + a] * (entry[b * n + j] / pivot);
            const double by_b = entry[i * n + b] * (entry[a * n + j] / pivot);
            if (by_a == 0.0 && by_b == 0.0) continue;
            entry[ij] -= by_b - by_a;
            terms[ij] = fmax(terms[ij], fmax(fabs(by_a), fabs(by_b)));
            if (fabs(entry[ij]) <= rank_tolerance * terms[ij]) entry[ij] = 0.0;
        }
        for (int i = 0; i < n; i++)
            entry[i * n + a] = entry[a * n + i] = entry[i * n + b] = entry[b * n + i] = 0.0;
        is_chosen[a] = is_chosen[b] = true;
    }
}
