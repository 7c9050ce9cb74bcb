/* lexer.h - formulas to tokens.
 *
 *     number   digits [. digits] [e [+-] digits], or . digits ...
 *     name     [A-Za-z_][A-Za-z0-9_]*, with ' right after it for a velocity
 *     other    + - * / ^ ( ) [ ] , < > <= >= == !=
 *
 * Blanks, tabs and line ends separate.  Columns count bytes from 1. */
#ifndef DAL_EXPR_LEXER_H
#define DAL_EXPR_LEXER_H

#include "dalembert_status.h"
#include <stdbool.h>

typedef struct dal__token {
    char kind; /* a character of + - * / ^ ( ) [ ] , < > or one of DAL__TOKEN_* */
    bool prime;
    int line, column;
    const char *text; /* in the formula */
    size_t length;    /* without the prime */
    double value;     /* of a number */
} dal__token;

enum {
    DAL__TOKEN_END = 0,
    DAL__TOKEN_NUMBER = '0',
    DAL__TOKEN_NAME = 'a',
    DAL__TOKEN_LESS_EQUAL = 'l',
    DAL__TOKEN_GREATER_EQUAL = 'g',
    DAL__TOKEN_EQUAL = '=',
    DAL__TOKEN_UNEQUAL = '!'
};

typedef struct dal__lexer {
    const char *at, *end;
    int line;
    const char *line_start;
    dal_error *error;
    bool has_second_derivatives; /* x'' is the name x' with a prime */
} dal__lexer;

/* The next token.  Errors: DAL_STATUS_SYNTAX. */
dal_status dal__next_token(dal__lexer *lexer, dal__token *token);
/* How many characters of a token messages show, with its prime. */
int dal__token_shown(const dal__token *token);
/* The length of the name that text begins with: a letter, then letters, digits, _; 0: none. */
size_t dal__name_length(const char *text, size_t length);

#endif
