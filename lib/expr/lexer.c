/* lexer.c - formulas to tokens. */
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

/* An error at the place of a token. */
#define SYNTAX_ERROR(p, at, ...)                                                                   \
    dal__fail_at((p)->error, DAL_STATUS_SYNTAX, (at)->line, (at)->column, __VA_ARGS__)

int dal__token_shown(const dal__token *t)
{
    size_t length = t->length + t->prime;
    return length < 60 ? (int)length : 60;
}

static dal_status read_number(dal__lexer *l, dal__token *t)
{
    t->kind = DAL__TOKEN_NUMBER;
    t->length = dal__read_decimal(t->text, (size_t)(l->end - t->text), &t->value);
    l->at += t->length;
    if (t->length == 0) return SYNTAX_ERROR(l, t, "unexpected '.'");
    if (!isfinite(t->value))
        return SYNTAX_ERROR(l, t, "the number %.*s is too large", dal__token_shown(t), t->text);
    return DAL_STATUS_OK;
}

static dal_status read_name(dal__lexer *l, dal__token *t)
{
    t->kind = DAL__TOKEN_NAME;
    t->length = dal__name_length(t->text, (size_t)(l->end - t->text));
    const char *c = t->text + t->length;
    t->prime = c < l->end && *c == '\'';
    l->at = c + t->prime;
    if (!t->prime || l->at == l->end || *l->at != '\'') return DAL_STATUS_OK;
    if (l->has_second_derivatives) {
        t->length++;
        l->at++;
        return DAL_STATUS_OK;
    }
    const int column = (int)(l->at - l->line_start) + 1;
    t->prime = false; /* it belongs to the message */
    return dal__fail_at(l->error, DAL_STATUS_SYNTAX, l->line, column,
                        "%.*s'' is a second derivative; a formula knows only %.*s and %.*s'",
                        dal__token_shown(t), t->text, dal__token_shown(t), t->text,
                        dal__token_shown(t), t->text);
}

/* <=, >=, ==, !=; false for another one. */
static bool read_comparison(dal__lexer *l, dal__token *t)
{
    static const char first[] = "<>=!";
    static const char kinds[] = {DAL__TOKEN_LESS_EQUAL, DAL__TOKEN_GREATER_EQUAL, DAL__TOKEN_EQUAL,
                                 DAL__TOKEN_UNEQUAL};
    const char *c = *t->text ? strchr(first, *t->text) : NULL;
    if (!c || l->at + 1 >= l->end || l->at[1] != '=') return false;
    t->kind = kinds[c - first];
    t->length = 2;
    l->at += 2;
    return true;
}

static dal_status read_other(dal__lexer *l, dal__token *t)
{
    unsigned char c = (unsigned char)*t->text;
    if (read_comparison(l, t)) return DAL_STATUS_OK;
    t->kind = (char)c;
    t->length = 1;
    l->at++;
    if (c == '*' && l->at < l->end && *l->at == '*')
        return SYNTAX_ERROR(l, t, "a power is written ^, not **");
    if (c && strchr("+-*/^(),<>[]", c)) return DAL_STATUS_OK;
    if (c == '=') return SYNTAX_ERROR(l, t, "unexpected '='; a comparison is written ==");
    if (c == '\'') {
        return SYNTAX_ERROR(l, t, "unexpected '; a prime follows a name without a blank, as in x'");
    }
    if (c < 0x20 || c > 0x7e)
        return SYNTAX_ERROR(l, t, "unexpected byte 0x%02x; a formula is plain ASCII", c);
    return SYNTAX_ERROR(l, t, "unexpected '%c'", c);
}

dal_status dal__next_token(dal__lexer *l, dal__token *t)
{
    for (; l->at < l->end && strchr(" \t\r\n", *l->at) && *l->at; l->at++)
        if (*l->at == '\n') l->line++, l->line_start = l->at + 1;
    *t = (dal__token){.kind = DAL__TOKEN_END,
                      .line = l->line,
                      .column = (int)(l->at - l->line_start) + 1,
                      .text = l->at};
    if (l->at == l->end) return DAL_STATUS_OK;
    char c = *l->at;
    if (is_digit(c) || c == '.') return read_number(l, t);
    return is_letter(c) ? read_name(l, t) : read_other(l, t);
}
