/* dalembert_program.h - what the program shares with the library and nobody else needs: it is not
 * installed, and its functions are not exported.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_PROGRAM_H
#define DALEMBERT_PROGRAM_H

#include "dalembert_model.h"
#include "dalembert_run.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- names and numbers --------------------------------------------------------------------- */

/* Returns the element of names[count] with the fewest edits from name, for "did you mean" (distance
 * of Damerau and Levenshtein); NULL when none has a letter in common with it and is within a third
 * of its length, or within two edits.  Elements of names may be NULL. */
const char *dal__nearest_name(const char *name, const char *const *names, int count);
/* Reads a decimal number from text[length]: sign, digits, one point, exponent, and nothing else;
 * correctly rounded, in every locale the same.  Errors: DAL_STATUS_SYNTAX, DAL_STATUS_TOO_LARGE
 * (overflow). */
dal_status dal__parse_number(const char *text, size_t length, double *value);
/* Room for the text of a number. */
#define DAL__NUMBER_SIZE 32
/* Writes x with 17 significant digits to text[DAL__NUMBER_SIZE] as %.17g of printf does, in every
 * locale the same, infinity as inf or -inf, and NaN as nan.  Returns the number of characters
 * before the NUL; dal__parse_number gives x again where it is finite. */
int dal__format_number(char *text, double x);
/* A number as the sum of its nearest double and the rest. */
typedef struct dal__decimal {
    double value; /* the nearest double */
    double rest;  /* what it lacks */
} dal__decimal;
/* The decimal number of at most 15 digits that reads as x, 0.1 where x is 0.1 + 5.6e-18; x itself
 * where there is none. */
dal__decimal dal__as_decimal(double x);
/* a - b, both as such decimals. */
dal__decimal dal__decimal_difference(double a, double b);
/* factor x, x as such a decimal. */
dal__decimal dal__decimal_multiple(double x, double factor);
/* The double nearest to from + length count/whole, to 2^-98, with from as a decimal.  That is 0.3
 * for 3 of 10 in 1, of 30 in 3, and of 300 in 30. */
double dal__add_share(double from, dal__decimal length, double count, double whole);

/* ---- models -------------------------------------------------------------------------------- */

/* Which item of a list of mappings, from 1, text number i of a section is of; 0: of none. */
int dal__model_item(const dal_model *model, dal_section section, int i);

/* ---- hashes -------------------------------------------------------------------------------- */

/* FNV-1a with 64 bits (Fowler, Noll, Vo; draft-eastlake-fnv): continues a hash by these bytes. */
#define DAL__HASH_START UINT64_C(0xcbf29ce484222325)
static inline uint64_t dal__hash(uint64_t hash, const void *bytes, size_t length)
{
    const unsigned char *byte = (const unsigned char *)bytes;
    for (size_t i = 0; i < length; i++) hash = (hash ^ byte[i]) * UINT64_C(0x100000001b3);
    return hash;
}

/* ---- observables --------------------------------------------------------------------------- */

/* The kinds of observables in their order; LIFT: H, |p|, |pi|, |pi_e|; ERROR: where the exact
 * solution is known to start as the run does; REACTIONS, of F, and MULTIPLIERS, of the method,
 * where they are observed; HOLONOMIC: g. */
typedef enum dal__observable_kind {
    DAL__OBSERVE_D,
    DAL__OBSERVE_E,
    DAL__OBSERVE_LIFT,
    DAL__OBSERVE_INVARIANTS,
    DAL__OBSERVE_REACTIONS,
    DAL__OBSERVE_MULTIPLIERS,
    DAL__OBSERVE_HOLONOMIC,
    DAL__OBSERVE_ERROR,
    DAL__OBSERVABLE_KINDS
} dal__observable_kind;
/* The kind of observable i of a run, and its number among these; DAL__OBSERVABLE_KINDS: none. */
dal__observable_kind dal__run_observable_kind(const dal_run *run, int i, int *number);

/* ---- ensembles ----------------------------------------------------------------------------- */

/* 64 random bits of a name and a seed, from which the draws are made. */
unsigned long long dal__random_key(const char *name, unsigned long long seed);
/* Adds (x_i - mean_i) (x_j - mean_j) of each row x[columns] of rows[count*columns] to
 * sums[columns*columns], which begin with 0; rows with a number that is not finite are left
 * out.  Returns how many were added. */
long long dal__add_products(int columns, const double *mean, const double *rows, long long count,
                            double *sums);

/* ---- pictures ------------------------------------------------------------------------------ */

/* The numbers of a picture, NUMBER(code, name); 0 where a system gives none. */
#define DAL_PICTURE_LIST(NUMBER)                                                                   \
    NUMBER(X, "x")         /* place on the abscissa */                                             \
    NUMBER(Y, "y")         /* place on the ordinate */                                             \
    NUMBER(ANGLE, "angle") /* heading, from x to y */                                              \
    NUMBER(STEER, "steer") /* angle of a board's front axle (minus the other's), or arm */         \
    NUMBER(WIDTH, "width") /* of a disk: breadth over length as seen */                            \
    NUMBER(SPIN, "spin")   /* of a disk: the angle that it has rolled forward about its axis */    \
    NUMBER(WX, "wx")       /* of a ball or a box: its angular velocity in space */                 \
    NUMBER(WY, "wy")                                                                               \
    NUMBER(WZ, "wz")
/* The bodies that are drawn, BODY(code, name). */
#define DAL_BODY_LIST(BODY)                                                                        \
    BODY(POINT, "point")                                                                           \
    BODY(SLEIGH, "sleigh")                                                                         \
    BODY(BLADE, "blade")                                                                           \
    BODY(DISK, "disk")                                                                             \
    BODY(BALL, "ball")                                                                             \
    BODY(ROBOT, "robot") BODY(BOARD, "board") BODY(RACER, "racer") BODY(BOX, "box")
/* Places of the numbers of a picture. */
enum {
#define CODE(code, name) DAL_PICTURE_##code,
    DAL_PICTURE_LIST(CODE) DAL_PICTURE_COUNT
#undef CODE
};
/* The body that is drawn at the place of a system. */
typedef enum dal_body {
#define CODE(code, name) DAL_BODY_##code,
    DAL_BODY_LIST(CODE) DAL_BODY_COUNT
#undef CODE
} dal_body;

/* How a system is drawn in the plane; without effect on its motion. */
typedef struct dal_picture {
    dal_callback *evaluate; /* out[DAL_PICTURE_COUNT]: the numbers of the picture */
    dal_body body;          /* what is drawn there */
} dal_picture;

#ifdef __cplusplus
}
#endif
#endif
