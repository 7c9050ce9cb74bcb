/* parser.c - formulas to nodes by binding powers (V. R. Pratt, Top down operator precedence, 1973).
 *
 *     < > <= >= == !=  1      + -  2      * /  3      unary -  4      ^  5, from the right
 *
 * so that -x^2 = -(x^2), 2^-3 = 1/8 and a/b/c = (a/b)/c.  What still needs its right operand lies
 * on an explicit stack, so memory alone limits how deep a formula is nested. */
#include "expr/parser.h"
#include "core/error.h"
#include "core/pi.h"
#include "expr/lexer.h"
#include "expr/operations.h"
#include "expr/simplify.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An error at the place of a token or frame. */
#define SYNTAX_ERROR(p, at, ...)                                                                   \
    dal__fail_at((p)->error, DAL_STATUS_SYNTAX, (at)->line, (at)->column, __VA_ARGS__)

/* ---- what the parser holds ---- */

/* Something that needs the value right of it; kind: the sign of an operator, '~' unary minus, '(' a
 * bracket, 'f' or 's' (sum) the arguments of a function, '[' an index, 0 the whole formula. */
typedef struct frame {
    char kind;
    dal__op function; /* or 0: */
    int own;          /* the number of one of the user */
    size_t first;     /* of the arguments so far */
    dal__node left;
    int line, column;
    const char *name; /* before an index */
    size_t length;
} frame;

enum { MAX_LOOPS = 16, MAX_INDEX = 1000000, MAX_TERMS = 4000000 };

/* A sum whose terms are being read, one by one from the same text. */
typedef struct loop {
    const char *name; /* of the index */
    size_t length;
    int at, first, end;
    dal__node total; /* of the terms before; 0: none */
    dal__lexer body; /* where a term begins */
} loop;

typedef struct parser {
    dal__graph *graph;
    dal__lexer lexer;
    dal__token token;
    const dal__names *names;
    dal_error *error;
    frame *stack;
    size_t depth, capacity;
    dal__node *argument; /* of all functions that are open */
    size_t arguments, argument_capacity;
    loop loop[MAX_LOOPS];
    int loops, terms; /* sums that are open; terms of all sums */
} parser;

enum { COMPARISON = 1 };
static const struct binding {
    char kind;
    int power;
    dal__op op;
} operators[] = {{'<', COMPARISON, DAL__LESS},
                 {'>', COMPARISON, DAL__LESS},
                 {DAL__TOKEN_LESS_EQUAL, COMPARISON, DAL__LESS_EQUAL},
                 {DAL__TOKEN_GREATER_EQUAL, COMPARISON, DAL__LESS_EQUAL},
                 {DAL__TOKEN_EQUAL, COMPARISON, DAL__EQUAL},
                 {DAL__TOKEN_UNEQUAL, COMPARISON, DAL__EQUAL},
                 {'+', 2, DAL__ADD},
                 {'-', 2, DAL__SUB},
                 {'*', 3, DAL__MUL},
                 {'/', 3, DAL__DIV},
                 {'~', 4, DAL__NEG},
                 {'^', 5, DAL__POW}};

static const struct binding *find_operator(char kind)
{
    for (size_t i = 0; i < sizeof operators / sizeof *operators; i++)
        if (operators[i].kind == kind) return &operators[i];
    return NULL;
}

static dal__node resolve(const parser *p, const dal__token *name, dal_error *error)
{
    return p->names->resolve(p->names->user, name->text, name->length, name->prime, error);
}

/* The number of the user's function of the present name; -1: there is none. */
static int own_function(const parser *p)
{
    const char *known;
    const dal__token *t = &p->token;
    for (int i = 0, arity; p->names->function && !t->prime; i++) {
        if (!(known = p->names->function(p->names->user, i, &arity))) break;
        if (strlen(known) == t->length && memcmp(known, t->text, t->length) == 0) return i;
    }
    return -1;
}

/* ---- messages ---- */

static dal_status graph_fault(const parser *p)
{
    dal_status status = p->graph->status;
    return dal__fail_at(p->error, status, p->token.line, p->token.column,
                        status == DAL_STATUS_MEMORY ? "out of memory" : "the formula is too large");
}

/* previous: the token before the present one. */
static dal_status operator_missing(const parser *p, const dal__token *previous)
{
    const dal__token *t = &p->token;
    if (previous->kind == DAL__TOKEN_NUMBER && t->kind != DAL__TOKEN_NUMBER) {
        return SYNTAX_ERROR(p, t, "an operator is missing: write %.*s*%.*s",
                            dal__token_shown(previous), previous->text, dal__token_shown(t),
                            t->text);
    }
    return SYNTAX_ERROR(p, t, "an operator is missing before '%.*s'", dal__token_shown(t), t->text);
}

/* Whether f(a, b, c) is f(f(a, b), c). */
static bool is_chained(dal__op function) { return function == DAL__MIN || function == DAL__MAX; }

static dal_status wrong_arguments(const parser *p, const frame *f, int given)
{
    int arity = 0;
    const char *name = f->function ? dal__function_name(f->function, &arity)
                                   : p->names->function(p->names->user, f->own, &arity);
    return SYNTAX_ERROR(p, f, "%s takes %d%s argument%s, not %d", name, arity,
                        is_chained(f->function) ? " or more" : "", arity == 1 ? "" : "s", given);
}

/* A name that is no function comes before a bracket. */
static dal_status unknown_function(const parser *p)
{
    const dal__token *t = &p->token;
    enum { OWN = 64 }; /* of the user's functions, as many as may be meant */
    const char *names[DAL__OP_COUNT + OWN];
    char name[64];
    int count = DAL__OP_COUNT;
    dal_error ignored = {.status = DAL_STATUS_OK};
    if (resolve(p, t, &ignored)) {
        return SYNTAX_ERROR(p, t, "%.*s is not a function: write %.*s*(...) for a product",
                            dal__token_shown(t), t->text, dal__token_shown(t), t->text);
    }
    for (int op = 0, arity; op < DAL__OP_COUNT; op++)
        names[op] = dal__function_name((dal__op)op, &arity);
    snprintf(name, sizeof name, "%.*s", dal__token_shown(t), t->text);
    for (int i = 0, arity; p->names->function && i < OWN; i++) {
        if (!(names[count] = p->names->function(p->names->user, i, &arity))) break;
        count++;
    }
    return dal__unknown_at(p->error, t->line, t->column, "function", name, names, count);
}

/* ---- the stack ---- */

static dal_status push(parser *p, char kind, dal__node left)
{
    if (p->depth == p->capacity) {
        size_t capacity = p->capacity ? 2 * p->capacity : 32;
        frame *stack = realloc(p->stack, capacity * sizeof *stack);
        if (!stack) return dal__memory_error(p->error);
        p->stack = stack;
        p->capacity = capacity;
    }
    p->stack[p->depth++] = (frame){.kind = kind,
                                   .first = p->arguments,
                                   .left = left,
                                   .line = p->token.line,
                                   .column = p->token.column};
    return DAL_STATUS_OK;
}

static dal_status push_argument(parser *p, dal__node value)
{
    if (p->arguments == p->argument_capacity) {
        size_t capacity = p->argument_capacity ? 2 * p->argument_capacity : 16;
        dal__node *argument = realloc(p->argument, capacity * sizeof *argument);
        if (!argument) return dal__memory_error(p->error);
        p->argument = argument;
        p->argument_capacity = capacity;
    }
    p->argument[p->arguments++] = value;
    return DAL_STATUS_OK;
}

static dal_status next(parser *p) { return dal__next_token(&p->lexer, &p->token); }

/* Whether a op b divides by a literal zero. */
static bool divides_by_zero(const dal__graph *graph, const frame *f, dal__node right)
{
    dal__record r = dal__inspect(graph, right);
    if (f->kind == '/') return dal__node_is_zero(graph, right);
    return f->kind == '^' && dal__node_is_zero(graph, f->left) && r.op == DAL__NUMBER &&
           r.value < 0.0;
}

static dal__node operate(dal__graph *graph, const struct binding *b, dal__node left,
                         dal__node right)
{
    switch (b->kind) {
    case '~':
        return dal__node_neg(graph, right);
    case '>':
    case DAL__TOKEN_GREATER_EQUAL:
        return dal__apply(graph, b->op, right, left);
    case DAL__TOKEN_UNEQUAL:
        return dal__node_sub(graph, dal__number(graph, 1.0), dal__apply(graph, b->op, left, right));
    default:
        return dal__apply(graph, b->op, left, right);
    }
}

/* Applies all operators on top of the stack that bind their right operand stronger than power. */
static dal_status reduce(parser *p, int power, dal__node *value)
{
    for (;;) {
        const frame *f = &p->stack[p->depth - 1];
        const struct binding *top = find_operator(f->kind);
        if (!top || top->power < power) return DAL_STATUS_OK;
        p->depth--;
        if (divides_by_zero(p->graph, f, *value)) return SYNTAX_ERROR(p, f, "division by zero");
        *value = operate(p->graph, top, f->left, *value);
        if (!*value) return graph_fault(p);
    }
}

/* ---- indices and sums ---- */

/* at: the frame that messages point to. */
static dal_status whole_number(const parser *p, const frame *at, dal__node node, int *n)
{
    const dal__record r = dal__inspect(p->graph, node);
    const bool whole = r.op == DAL__NUMBER && r.value == floor(r.value);
    if (!whole)
        return SYNTAX_ERROR(p, at, "an index is a whole number, of numbers, sizes and indices");
    if (fabs(r.value) > MAX_INDEX) return SYNTAX_ERROR(p, at, "an index is beyond %d", MAX_INDEX);
    *n = (int)r.value;
    return DAL_STATUS_OK;
}

/* The loop whose index has the present name, or NULL. */
static const loop *loop_of(const parser *p)
{
    const dal__token *t = &p->token;
    for (const loop *l = p->loop + p->loops; l-- > p->loop && !t->prime;)
        if (l->length == t->length && memcmp(l->name, t->text, l->length) == 0) return l;
    return NULL;
}

/* After the bracket of an index: x[2] is the name x2. */
static dal_status close_index(parser *p, dal__node *value)
{
    DAL_TRY(reduce(p, 1, value));
    const frame f = p->stack[p->depth - 1];
    char text[128];
    int index;
    if (f.kind != '[') return SYNTAX_ERROR(p, &p->token, "']' closes no '['");
    p->depth--;
    DAL_TRY(whole_number(p, &f, *value, &index));
    const int length = snprintf(text, sizeof text, "%.*s%d", (int)f.length, f.name, index);
    dal__token name = {.line = f.line, .column = f.column, .text = text, .length = (size_t)length};
    name.prime = p->lexer.at < p->lexer.end && *p->lexer.at == '\'';
    p->lexer.at += name.prime;
    if (length >= (int)sizeof text) return SYNTAX_ERROR(p, &f, "a name is too long");
    dal_error fault = {.status = DAL_STATUS_OK};
    *value = resolve(p, &name, &fault);
    if (*value) return DAL_STATUS_OK;
    if (fault.status == DAL_STATUS_OK) return graph_fault(p);
    return dal__fail_at(p->error, fault.status, f.line, f.column, "%s", fault.message);
}

/* After `sum`, with the lexer after its bracket: the index and a comma. */
static dal_status open_sum(parser *p, dal__lexer lexer)
{
    dal__token index, comma = {.kind = 0};
    DAL_TRY(push(p, 's', 0));
    lexer.error = p->error;
    DAL_TRY(dal__next_token(&lexer, &index));
    if (index.kind == DAL__TOKEN_NAME) DAL_TRY(dal__next_token(&lexer, &comma));
    frame *f = &p->stack[p->depth - 1];
    if (comma.kind != ',' || index.prime)
        return SYNTAX_ERROR(p, f, "a sum is written sum(i, 1, N, formula in i)");
    f->name = index.text;
    f->length = index.length;
    p->lexer = lexer;
    return DAL_STATUS_OK;
}

/* Skips to the bracket that closes a sum without terms. */
static dal_status skip_body(parser *p)
{
    const frame f = p->stack[p->depth - 1];
    for (int open = 1; open > 0;) {
        DAL_TRY(next(p));
        open += (p->token.kind == '(') - (p->token.kind == ')');
        if (p->token.kind == DAL__TOKEN_END) return SYNTAX_ERROR(p, &f, "a '(' is never closed");
    }
    return DAL_STATUS_OK;
}

static dal_status too_many_terms(const parser *p, const frame *f)
{
    return dal__fail_at(p->error, DAL_STATUS_TOO_LARGE, f->line, f->column,
                        "sums of more than %d terms in a formula", (int)MAX_TERMS);
}

/* Whether the first terms of nested sums show that all of them are too many.  The range of a sum
 * may depend on the index around it, as j = i..N: k sums then have N^k/k! terms. */
static bool has_too_many_terms(const parser *p)
{
    double terms = 1.0;
    for (int i = 0; i < p->loops; i++) {
        const loop *l = &p->loop[i];
        if (l->at > l->first) return false;
        terms *= ((double)l->end - l->first + 1.0) / (i + 1);
    }
    return terms > MAX_TERMS;
}

/* After the comma that ends the range of a sum: begins its first term.  empty: there is none, and
 * *value is the sum. */
static dal_status begin_terms(parser *p, dal__node *value, bool *empty)
{
    const frame f = p->stack[p->depth - 1];
    loop l = {.name = f.name, .length = f.length, .body = p->lexer};
    DAL_TRY(whole_number(p, &f, p->argument[f.first], &l.at));
    DAL_TRY(whole_number(p, &f, p->argument[f.first + 1], &l.end));
    *empty = l.at > l.end;
    if (*empty) {
        DAL_TRY(skip_body(p));
        p->depth--;
        p->arguments = f.first;
        *value = dal__number(p->graph, 0.0);
        return *value ? DAL_STATUS_OK : graph_fault(p);
    }
    if (p->loops == MAX_LOOPS)
        return SYNTAX_ERROR(p, &f, "sums nest deeper than %d", (int)MAX_LOOPS);
    l.first = l.at;
    p->loop[p->loops++] = l;
    return has_too_many_terms(p) ? too_many_terms(p, &f) : next(p);
}

/* After a term of a sum: goes back for the next one, or closes the sum. */
static dal_status end_term(parser *p, dal__node *value, bool *more)
{
    const frame f = p->stack[p->depth - 1];
    if (p->arguments - f.first < 2)
        return SYNTAX_ERROR(p, &f, "a sum is written sum(i, 1, N, formula in i)");
    loop *l = &p->loop[p->loops - 1];
    l->total = l->total ? dal__node_add(p->graph, l->total, *value) : *value;
    if (!l->total) return graph_fault(p);
    if (++p->terms > MAX_TERMS) return too_many_terms(p, &f);
    *more = l->at++ < l->end;
    if (*more) {
        p->lexer = l->body;
        return next(p);
    }
    *value = l->total;
    p->loops--;
    p->depth--;
    p->arguments = f.first;
    return DAL_STATUS_OK;
}

/* ---- the grammar ---- */

static dal_status symbol(parser *p, dal__node *value)
{
    const dal__token *t = &p->token;
    const loop *l = loop_of(p);
    const bool is_pi = t->length == 2 && memcmp(t->text, "pi", 2) == 0 && !t->prime;
    if (l || is_pi) {
        *value = dal__number(p->graph, l ? l->at : DAL__PI);
        return *value ? DAL_STATUS_OK : graph_fault(p);
    }
    const dal__op function = t->prime ? (dal__op)0 : dal__function_named(t->text, t->length);
    dal_error fault = {.status = DAL_STATUS_OK};
    if (dal__may_be_hidden(function)) *value = resolve(p, t, &fault);
    if (dal__may_be_hidden(function) && *value) return DAL_STATUS_OK;
    if (function || own_function(p) >= 0) {
        return SYNTAX_ERROR(p, t, "%.*s is a function: write %.*s(...)", dal__token_shown(t),
                            t->text, dal__token_shown(t), t->text);
    }
    *value = resolve(p, t, &fault);
    if (*value) return DAL_STATUS_OK;
    if (fault.status == DAL_STATUS_OK) return graph_fault(p);
    return dal__fail_at(p->error, fault.status, t->line, t->column, "%s", fault.message);
}

/* Whether the present name, a function's, has another meaning. */
static bool is_hidden(const parser *p, dal__op function)
{
    dal_error ignored;
    return dal__may_be_hidden(function) && resolve(p, &p->token, &ignored);
}

/* Whether the present name is `sum`, and no name of the system. */
static bool is_sum(const parser *p)
{
    const dal__token *t = &p->token;
    dal_error ignored;
    return t->length == 3 && memcmp(t->text, "sum", 3) == 0 && !t->prime &&
           !resolve(p, t, &ignored);
}

/* A name: a function with its bracket, which opens a frame, or a value. */
static dal_status name(parser *p, dal__node *value)
{
    dal__lexer ahead = p->lexer;
    dal__token bracket;
    ahead.error = NULL;
    const bool read = dal__next_token(&ahead, &bracket) == DAL_STATUS_OK;
    if (read && bracket.kind == '[' && !p->token.prime) {
        DAL_TRY(push(p, '[', 0));
        p->stack[p->depth - 1].name = p->token.text;
        p->stack[p->depth - 1].length = p->token.length;
        ahead.error = p->error;
        p->lexer = ahead;
        return DAL_STATUS_OK;
    }
    if (!read || bracket.kind != '(') return symbol(p, value);
    const int own = own_function(p);
    if (own < 0 && is_sum(p)) return open_sum(p, ahead);
    dal__op function = own < 0 ? dal__function_named(p->token.text, p->token.length) : (dal__op)0;
    if (own < 0 && (!function || p->token.prime || is_hidden(p, function)))
        return unknown_function(p);
    DAL_TRY(push(p, 'f', 0));
    p->stack[p->depth - 1].function = function;
    p->stack[p->depth - 1].own = own;
    ahead.error = p->error;
    p->lexer = ahead;
    return DAL_STATUS_OK;
}

/* Everything up to the next value: signs, brackets, functions, and the value. */
static dal_status read_operand(parser *p, dal__node *value)
{
    for (*value = 0; !*value;) {
        const frame *top = &p->stack[p->depth - 1];
        switch (p->token.kind) {
        case '+':
            break;
        case '-':
            DAL_TRY(push(p, '~', 0));
            break;
        case '(':
            DAL_TRY(push(p, '(', 0));
            break;
        case DAL__TOKEN_NAME:
            DAL_TRY(name(p, value));
            break;
        case DAL__TOKEN_NUMBER:
            *value = dal__number(p->graph, p->token.value);
            if (!*value) return graph_fault(p);
            break;
        default:
            if (p->token.kind == ')' && top->kind == 'f' && p->arguments == top->first)
                return wrong_arguments(p, top, 0);
            if (p->token.kind == DAL__TOKEN_END)
                return SYNTAX_ERROR(p, &p->token, "a value is missing at the end of the formula");
            return SYNTAX_ERROR(p, &p->token, "a value is missing before '%.*s'",
                                dal__token_shown(&p->token), p->token.text);
        }
        DAL_TRY(*value ? DAL_STATUS_OK : next(p));
    }
    return DAL_STATUS_OK;
}

/* The value of a function of the language with its arguments. */
static dal__node apply(const parser *p, dal__op function, const dal__node *argument, int count)
{
    dal__node value = argument[0];
    if (function == DAL__IF) return dal__node_if(p->graph, value, argument[1], argument[2]);
    if (count == 1) return dal__apply(p->graph, function, value, 0);
    for (int i = 1; i < count; i++) value = dal__apply(p->graph, function, value, argument[i]);
    return value;
}

/* The value of the function of a frame, whose arguments are complete. */
static dal_status call(parser *p, const frame *f, dal__node *value)
{
    const dal__names *names = p->names;
    const dal__node *argument = p->argument + f->first;
    const int given = (int)(p->arguments - f->first);
    int arity;
    if (f->function)
        dal__function_name(f->function, &arity);
    else
        names->function(names->user, f->own, &arity);
    if (given < arity || (given > arity && !is_chained(f->function)))
        return wrong_arguments(p, f, given);
    dal_error fault = {.status = DAL_STATUS_OK};
    *value = f->function ? apply(p, f->function, argument, given)
                         : names->call(names->user, f->own, argument, &fault);
    p->arguments = f->first;
    if (*value) return DAL_STATUS_OK;
    if (fault.status == DAL_STATUS_OK) return graph_fault(p);
    return dal__fail_at(p->error, fault.status, f->line, f->column, "%s", fault.message);
}

/* The closing bracket: of a bracket, of a function's arguments or of a term of a sum, whose next
 * term (*more) begins. */
static dal_status close(parser *p, dal__node *value, bool *more)
{
    DAL_TRY(reduce(p, 1, value));
    const frame f = p->stack[p->depth - 1];
    *more = false;
    if (f.kind == 's') return end_term(p, value, more);
    if (f.kind == '[') return SYNTAX_ERROR(p, &f, "a '[' is never closed");
    if (f.kind == 0) return SYNTAX_ERROR(p, &p->token, "')' closes no '('");
    p->depth--;
    if (f.kind == '(') return DAL_STATUS_OK;
    DAL_TRY(push_argument(p, *value));
    return call(p, &f, value);
}

/* What follows a value, up to where another one is expected (*more) or the formula ends. */
static dal_status read_operators(parser *p, dal__node *value, bool *more)
{
    bool empty;
    for (;;) {
        *more = true;
        const dal__token previous = p->token;
        DAL_TRY(next(p));
        const char kind = p->token.kind;
        const struct binding *infix = find_operator(kind);
        if (infix) {
            const int above = kind == '^' || infix->power == COMPARISON;
            DAL_TRY(reduce(p, infix->power + above, value));
            const struct binding *left = find_operator(p->stack[p->depth - 1].kind);
            if (infix->power == COMPARISON && left)
                return SYNTAX_ERROR(p, &p->token,
                                    "comparisons make no chain: write (a < b)*(b < c)");
            DAL_TRY(push(p, kind, *value));
            return next(p);
        }
        if (kind == ',') {
            DAL_TRY(reduce(p, 1, value));
            const frame *f = &p->stack[p->depth - 1];
            if (f->kind != 'f' && f->kind != 's')
                return SYNTAX_ERROR(p, &p->token, "',' outside the arguments of a function");
            DAL_TRY(push_argument(p, *value));
            const size_t given = p->arguments - p->stack[p->depth - 1].first;
            if (f->kind == 'f' || given == 1) return next(p);
            if (given > 2) return SYNTAX_ERROR(p, f, "a sum is written sum(i, 1, N, formula in i)");
            DAL_TRY(begin_terms(p, value, &empty));
            if (!empty) return DAL_STATUS_OK;
            continue;
        }
        if (kind == DAL__TOKEN_END) {
            *more = false;
            DAL_TRY(reduce(p, 1, value));
            const frame *f = &p->stack[p->depth - 1];
            return f->kind
                       ? SYNTAX_ERROR(p, f, "a '%c' is never closed", f->kind == '[' ? '[' : '(')
                       : DAL_STATUS_OK;
        }
        if (kind != ')' && kind != ']') return operator_missing(p, &previous);
        DAL_TRY(kind == ')' ? close(p, value, more) : close_index(p, value));
        if (kind == ')' && *more) return DAL_STATUS_OK;
    }
}

static dal_status parse(parser *p, dal__node *value)
{
    DAL_TRY(push(p, 0, 0));
    DAL_TRY(next(p));
    if (p->token.kind == DAL__TOKEN_END)
        return dal__fail_at(p->error, DAL_STATUS_SYNTAX, 1, 1, "the formula is empty");
    for (bool more = true; more;) {
        DAL_TRY(read_operand(p, value));
        DAL_TRY(read_operators(p, value, &more));
    }
    return DAL_STATUS_OK;
}

dal_status dal__parse(dal__graph *graph, const char *text, size_t length, const dal__names *names,
                      dal__node *node, dal_error *error)
{
    parser p = {.graph = graph,
                .lexer = {text, text + length, 1, text, error, names->has_second_derivatives},
                .names = names,
                .error = error};
    if (length >= INT_MAX)
        return dal__fail_at(error, DAL_STATUS_TOO_LARGE, 1, 1, "the formula is too long");
    dal_status status = parse(&p, node);
    free(p.stack);
    free(p.argument);
    if (status != DAL_STATUS_OK) *node = 0;
    return status;
}
