/* builtin.h - the texts of systems/, made by the Makefile. */
#ifndef DAL_LOAD_BUILTIN_H
#define DAL_LOAD_BUILTIN_H

typedef struct dal__builtin {
    const char *name, *text;
} dal__builtin;
extern const dal__builtin dal__builtins[]; /* the last name is NULL */

#endif
