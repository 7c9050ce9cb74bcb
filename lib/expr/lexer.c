/* lexer.c - a formula's text to tokens.
 *
 *     number   digits [. digits] [e [+-] digits], or . digits ...
 *     name     [A-Za-z_][A-Za-z0-9_]*, with ' right behind it for a velocity
 *     other    + - * / ^ ( ) ,
 *
 * Blanks, tabs and line ends separate.  Columns count bytes from 1. */
#include "expr/lexer.h"
#include "core/decimal.h"
#include "core/error.h"
#include <math.h>
#include <string.h>

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
static bool is_digit(char c) { return c >= '0' && c <= '9'; }

size_t dal__name_length(const char *text, size_t length)
{
    size_t i = 0;
    while (i < length && (is_letter(text[i]) || (i > 0 && is_digit(text[i])))) i++;
    return i;
}

dal__lexer dal__lexer_start(const char *text, size_t length)
{
    return (dal__lexer){.at = text, .end = text + length, .line = 1, .line_start = text};
}

#define SYNTAX_ERROR(at, error, ...)                                                               \
    dal__fail_at(error, DAL_SYNTAX, (at)->line, (at)->column, __VA_ARGS__)

static dal_status number(dal__lexer *lexer, dal__token *token, dal_error *error)
{
    token->kind = DAL__TOKEN_NUMBER;
    token->length =
        dal__read_decimal(token->text, (size_t)(lexer->end - token->text), &token->value);
    lexer->at += token->length;
    int shown = token->length < 60 ? (int)token->length : 60;
    if (token->length == 0) return SYNTAX_ERROR(token, error, "unexpected '.'");
    if (!isfinite(token->value))
        return SYNTAX_ERROR(token, error, "the number %.*s is too large", shown, token->text);
    return DAL_OK;
}

static dal_status name(dal__lexer *lexer, dal__token *token, dal_error *error)
{
    token->kind = DAL__TOKEN_NAME;
    token->length = dal__name_length(token->text, (size_t)(lexer->end - token->text));
    const char *c = token->text + token->length;
    token->prime = c < lexer->end && *c == '\'';
    lexer->at = c + token->prime;
    if (!token->prime || lexer->at == lexer->end || *lexer->at != '\'') return DAL_OK;
    const int column = (int)(lexer->at - lexer->line_start) + 1;
    const int shown = token->length < 60 ? (int)token->length : 60;
    return dal__fail_at(error, DAL_SYNTAX, lexer->line, column,
                        "%.*s'' is a second derivative; a formula knows only %.*s and %.*s'", shown,
                        token->text, shown, token->text, shown, token->text);
}

static dal_status other(dal__lexer *lexer, dal__token *token, dal_error *error)
{
    unsigned char c = (unsigned char)*token->text;
    token->kind = (char)c;
    token->length = 1;
    lexer->at++;
    if (c && strchr("+-*/^(),", c)) return DAL_OK;
    if (c == '\'') {
        return SYNTAX_ERROR(token, error,
                            "unexpected '; a prime stands right behind a name, as in x'");
    }
    if (c < 0x20 || c > 0x7e)
        return SYNTAX_ERROR(token, error, "unexpected byte 0x%02x; a formula is plain ASCII", c);
    return SYNTAX_ERROR(token, error, "unexpected '%c'", c);
}

dal_status dal__lexer_next(dal__lexer *lexer, dal__token *token, dal_error *error)
{
    for (; lexer->at < lexer->end && strchr(" \t\r\n", *lexer->at) && *lexer->at; lexer->at++)
        if (*lexer->at == '\n') lexer->line++, lexer->line_start = lexer->at + 1;
    *token = (dal__token){.kind = DAL__TOKEN_END,
                          .line = lexer->line,
                          .column = (int)(lexer->at - lexer->line_start) + 1,
                          .text = lexer->at};
    if (lexer->at == lexer->end) return DAL_OK;
    char c = *lexer->at;
    if (is_digit(c) || c == '.') return number(lexer, token, error);
    return is_letter(c) ? name(lexer, token, error) : other(lexer, token, error);
}
