/* parser.c - formulas to nodes by binding powers (V. R. Pratt, Top down operator precedence, 1973).
 *
 *     < > <= >= == !=  1      + -  2      * /  3      unary -  4      ^  5, from the right
 *
 * so that -x^2 = -(x^2), 2^-3 = 1/8 and a/b/c = (a/b)/c.  What still needs its right operand lies
 * on an explicit stack, so memory alone limits how deep a formula is nested. */
#include "expr/parser.h"
#include "core/error.h"
#include "expr/lexer.h"
#include "expr/simplify.h"
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An error at the place of a token or frame. */
#define SYNTAX_ERROR(p, at, ...)                                                                   \
    dal__fail_at((p)->error, DAL_SYNTAX, (at)->line, (at)->column, __VA_ARGS__)

/* ---- what the parser holds ---- */

/* Something that needs the value right of it; kind: that of an operator, '~' unary minus, '(' a
 * bracket, 'f' the arguments of a function, 0 the formula itself. */
typedef struct frame {
    char kind;
    dal__op function; /* or 0: */
    int own;          /* the number of one of the user */
    size_t first;     /* of the arguments so far */
    dal__node left;
    int line, column;
} frame;

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
} parser;

static const struct function {
    const char *name;
    int arity;
} functions[] = {
#define FUNCTION(code, arity, name) {name, arity},
    DAL__OP_LIST(FUNCTION)
#undef FUNCTION
};

/* The operation a name calls, or 0. */
static dal__op function_named(const char *name, size_t length)
{
    for (int op = 0; op < DAL__OP_COUNT; op++) {
        const char *known = functions[op].name;
        if (known && strlen(known) == length && memcmp(known, name, length) == 0)
            return (dal__op)op;
    }
    return (dal__op)0;
}

/* Whether the name of a function may be that of something else, too, which then wins. */
static bool is_young(dal__op function) { return function >= DAL__SIGN; }

bool dal__is_function(const char *name, size_t length)
{
    const dal__op function = function_named(name, length);
    return function && !is_young(function);
}

bool dal__hides_function(const char *name) { return is_young(function_named(name, strlen(name))); }

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
                        status == DAL_MEMORY ? "out of memory" : "the formula is too large");
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
    struct function called = functions[f->function];
    if (!f->function) called.name = p->names->function(p->names->user, f->own, &called.arity);
    return SYNTAX_ERROR(p, f, "%s takes %d%s argument%s, not %d", called.name, called.arity,
                        is_chained(f->function) ? " or more" : "", called.arity == 1 ? "" : "s",
                        given);
}

/* A name that is no function stands before a bracket. */
static dal_status unknown_function(const parser *p)
{
    const dal__token *t = &p->token;
    enum { OWN = 64 }; /* of the user's functions, as many as may be meant */
    const char *names[DAL__OP_COUNT + OWN];
    char name[64];
    int count = DAL__OP_COUNT;
    dal_error ignored = {.status = DAL_OK};
    if (resolve(p, t, &ignored)) {
        return SYNTAX_ERROR(p, t, "%.*s is not a function: write %.*s*(...) for a product",
                            dal__token_shown(t), t->text, dal__token_shown(t), t->text);
    }
    for (int op = 0; op < DAL__OP_COUNT; op++) names[op] = functions[op].name;
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
        if (!stack) return dal__fail(p->error, DAL_MEMORY, "out of memory");
        p->stack = stack;
        p->capacity = capacity;
    }
    p->stack[p->depth++] = (frame){.kind = kind,
                                   .first = p->arguments,
                                   .left = left,
                                   .line = p->token.line,
                                   .column = p->token.column};
    return DAL_OK;
}

static dal_status push_argument(parser *p, dal__node value)
{
    if (p->arguments == p->argument_capacity) {
        size_t capacity = p->argument_capacity ? 2 * p->argument_capacity : 16;
        dal__node *argument = realloc(p->argument, capacity * sizeof *argument);
        if (!argument) return dal__fail(p->error, DAL_MEMORY, "out of memory");
        p->argument = argument;
        p->argument_capacity = capacity;
    }
    p->argument[p->arguments++] = value;
    return DAL_OK;
}

static dal_status next(parser *p) { return dal__next_token(&p->lexer, &p->token); }

/* Whether a op b divides by a literal zero. */
static bool divides_by_zero(const dal__graph *graph, const frame *f, dal__node right)
{
    dal__record r = dal__inspect(graph, right);
    if (f->kind == '/') return dal__is_number(graph, right, 0.0);
    return f->kind == '^' && dal__is_number(graph, f->left, 0.0) && r.op == DAL__NUMBER &&
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
        if (!top || top->power < power) return DAL_OK;
        p->depth--;
        if (divides_by_zero(p->graph, f, *value)) return SYNTAX_ERROR(p, f, "division by zero");
        *value = operate(p->graph, top, f->left, *value);
        if (!*value) return graph_fault(p);
    }
}

/* ---- the grammar ---- */

static dal_status symbol(parser *p, dal__node *value)
{
    const dal__token *t = &p->token;
    if (t->length == 2 && memcmp(t->text, "pi", 2) == 0 && !t->prime) {
        *value = dal__number(p->graph, 3.14159265358979323846);
        return *value ? DAL_OK : graph_fault(p);
    }
    const dal__op function = t->prime ? (dal__op)0 : function_named(t->text, t->length);
    dal_error fault = {.status = DAL_OK};
    if (is_young(function)) *value = resolve(p, t, &fault);
    if (is_young(function) && *value) return DAL_OK;
    if (function || own_function(p) >= 0) {
        return SYNTAX_ERROR(p, t, "%.*s is a function: write %.*s(...)", dal__token_shown(t),
                            t->text, dal__token_shown(t), t->text);
    }
    *value = resolve(p, t, &fault);
    if (*value) return DAL_OK;
    if (fault.status == DAL_OK) return graph_fault(p);
    return dal__fail_at(p->error, fault.status, t->line, t->column, "%s", fault.message);
}

/* Whether the present name, that of a function, has another meaning. */
static bool is_hidden(const parser *p, dal__op function)
{
    dal_error ignored;
    return is_young(function) && resolve(p, &p->token, &ignored);
}

/* A name: a function with its bracket, which opens a frame, or a value. */
static dal_status name(parser *p, dal__node *value)
{
    dal__lexer ahead = p->lexer;
    dal__token bracket;
    ahead.error = NULL;
    bool call = dal__next_token(&ahead, &bracket) == DAL_OK && bracket.kind == '(';
    if (!call) return symbol(p, value);
    const int own = own_function(p);
    dal__op function = own < 0 ? function_named(p->token.text, p->token.length) : (dal__op)0;
    if (own < 0 && (!function || p->token.prime || is_hidden(p, function)))
        return unknown_function(p);
    DAL_TRY(push(p, 'f', 0));
    p->stack[p->depth - 1].function = function;
    p->stack[p->depth - 1].own = own;
    ahead.error = p->error;
    p->lexer = ahead;
    return DAL_OK;
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
        DAL_TRY(*value ? DAL_OK : next(p));
    }
    return DAL_OK;
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
    int arity = functions[f->function].arity;
    if (!f->function) names->function(names->user, f->own, &arity);
    if (given < arity || (given > arity && !is_chained(f->function)))
        return wrong_arguments(p, f, given);
    dal_error fault = {.status = DAL_OK};
    *value = f->function ? apply(p, f->function, argument, given)
                         : names->call(names->user, f->own, argument, &fault);
    p->arguments = f->first;
    if (*value) return DAL_OK;
    if (fault.status == DAL_OK) return graph_fault(p);
    return dal__fail_at(p->error, fault.status, f->line, f->column, "%s", fault.message);
}

/* The closing bracket: of a bracket or of a function's arguments. */
static dal_status close(parser *p, dal__node *value)
{
    DAL_TRY(reduce(p, 1, value));
    const frame f = p->stack[p->depth - 1];
    if (f.kind == 0) return SYNTAX_ERROR(p, &p->token, "')' closes no '('");
    p->depth--;
    if (f.kind == '(') return DAL_OK;
    DAL_TRY(push_argument(p, *value));
    return call(p, &f, value);
}

/* What follows a value, up to where another one is expected (*more) or the formula ends. */
static dal_status read_operators(parser *p, dal__node *value, bool *more)
{
    for (*more = true;;) {
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
            if (f->kind != 'f')
                return SYNTAX_ERROR(p, &p->token, "',' stands outside the arguments of a function");
            DAL_TRY(push_argument(p, *value));
            return next(p);
        }
        if (kind == DAL__TOKEN_END) {
            *more = false;
            DAL_TRY(reduce(p, 1, value));
            const frame *f = &p->stack[p->depth - 1];
            return f->kind ? SYNTAX_ERROR(p, f, "a '(' is never closed") : DAL_OK;
        }
        if (kind != ')') return operator_missing(p, &previous);
        DAL_TRY(close(p, value));
    }
}

static dal_status parse(parser *p, dal__node *value)
{
    DAL_TRY(push(p, 0, 0));
    DAL_TRY(next(p));
    if (p->token.kind == DAL__TOKEN_END)
        return dal__fail_at(p->error, DAL_SYNTAX, 1, 1, "the formula is empty");
    for (bool more = true; more;) {
        DAL_TRY(read_operand(p, value));
        DAL_TRY(read_operators(p, value, &more));
    }
    return DAL_OK;
}

dal_status dal__parse(dal__graph *graph, const char *text, size_t length, const dal__names *names,
                      dal__node *node, dal_error *error)
{
    parser p = {.graph = graph,
                .lexer = {text, text + length, 1, text, error},
                .names = names,
                .error = error};
    if (length >= INT_MAX)
        return dal__fail_at(error, DAL_TOO_LARGE, 1, 1, "the formula is too long");
    dal_status status = parse(&p, node);
    free(p.stack);
    free(p.argument);
    if (status != DAL_OK) *node = 0;
    return status;
}
