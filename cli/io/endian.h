/* endian.h - words of 64 bits as files hold them on every machine: the lowest byte first.  Written
 * out, for compilers to see one load or store in it where that is the machine's own order. */
#ifndef DAL_CLI_ENDIAN_H
#define DAL_CLI_ENDIAN_H

#include <stdint.h>
#include <string.h>

enum { WORD = 8 };

static inline uint64_t read_le64(const unsigned char *b)
{
    return (uint64_t)b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24 |
           (uint64_t)b[4] << 32 | (uint64_t)b[5] << 40 | (uint64_t)b[6] << 48 |
           (uint64_t)b[7] << 56;
}

static inline void write_le64(unsigned char *b, uint64_t word)
{
    b[0] = (unsigned char)word;
    b[1] = (unsigned char)(word >> 8);
    b[2] = (unsigned char)(word >> 16);
    b[3] = (unsigned char)(word >> 24);
    b[4] = (unsigned char)(word >> 32);
    b[5] = (unsigned char)(word >> 40);
    b[6] = (unsigned char)(word >> 48);
    b[7] = (unsigned char)(word >> 56);
}

/* Doubles by their bits. */
static inline double read_le_double(const unsigned char *b)
{
    const uint64_t word = read_le64(b);
    double x;
    memcpy(&x, &word, sizeof x);
    return x;
}

static inline void write_le_double(unsigned char *b, double x)
{
    uint64_t word;
    memcpy(&word, &x, sizeof word);
    write_le64(b, word);
}

#endif
