/* bits.h - one motion computed in every way there is, bit by bit.
 *
 * A case is a system, a method and a space; a build is a compiler, a level of optimisation, and
 * this machine's instructions or any machine's. */
#ifndef BITS_H
#define BITS_H

/* A part of all there is to compare, "3/8": cases whose number is 3 modulo 8, each by all builds;
 * "3/8/1": by one of the builds, the next case by the next.  Prints what differs and a summary; 1
 * when something did. */
int bits_part(const char *part);

/* Enough that each method, each system and each build is in it; the number of ways that differ. */
int bits_cover(void);

#endif
