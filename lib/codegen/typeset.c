/* typeset.c - nodes of a graph as formulas in LaTeX, or as in a system file.
 *
 * Operands come before the nodes that have them, so one loop gives each node its text.  A level
 * says how tightly a text holds together: an operand below the level that its place needs gets
 * brackets. */
#include "codegen/typeset.h"
#include "core/error.h"
#include "core/pi.h"
#include "dalembert_program.h"
#include "expr/table.h"
#include "expr/traversal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LENGTH = 1 << 20 };

typedef enum level {
    LEVEL_ANY,
    LEVEL_COMPARISON,
    LEVEL_SUM,
    LEVEL_NEGATIVE, /* begins with a minus: the first term of a sum, or a subtracted one */
    LEVEL_PRODUCT,
    LEVEL_FACTOR, /* no base of a power: a fraction, a power, a function */
    LEVEL_ATOM
} level;

typedef struct formula {
    char *text; /* NULL: not reached */
    level level;
    bool is_named; /* the text is a name: of what is shared, or the caller's */
} formula;

typedef struct meaning {
    const formula *name;
    char *text;
} meaning;

struct dal__typesetter {
    dal__graph *graph;
    formula *formula; /* [last + 1] */
    dal__node last;
    meaning *shared; /* [shared_count] */
    int shared_count;
    int numbered; /* the last number of a name */
    dal_status status;
    dal__typeset_options options;
};

/* ---- numbers and names --------------------------------------------------------------------- */

/* Appends p/q where that is x, q being small and p/q no short decimal number. */
static bool typeset_fraction(double x, const char *factor, dal__buffer *text)
{
    enum { MAX_DENOMINATOR = 64, MAX_NUMERATOR = 9999 };
    for (int q = 1; q <= MAX_DENOMINATOR; q++) {
        const double p = nearbyint(x * q);
        if ((q % 5 == 0 && !*factor) || !(p >= 1.0 && p <= MAX_NUMERATOR) || p / q != x) continue;
        if (q > 1) dal__buffer_append(text, "\\tfrac{");
        if (p > 1.0 || !*factor) dal__buffer_print(text, "%d", (int)p);
        dal__buffer_append(text, factor);
        if (q > 1) dal__buffer_print(text, "}{%d}", q);
        return true;
    }
    return false;
}

/* The fewest digits that mean x > 0: x = 0.d1d2.. 10^exponent. */
static int find_digits(double x, char digit[DAL__NUMBER_SIZE], int *exponent)
{
    char number[DAL__NUMBER_SIZE], rounded[2 * DAL__NUMBER_SIZE];
    int count = 0;
    dal__format_number(number, x);
    const char *e = strchr(number, 'e'), *point = NULL;
    *exponent = 0;
    for (const char *c = e ? e + 2 : ""; *c; c++) *exponent = 10 * *exponent + (*c - '0');
    if (e && e[1] == '-') *exponent = -*exponent;
    for (const char *c = number; *c && c != e; c++) {
        if (*c == '.')
            point = c;
        else if (count > 0 || *c != '0')
            digit[count++] = *c;
        if (*c != '.' && count > 0) *exponent += !point;
        if (*c == '0' && count == 0) *exponent -= point != NULL;
    }
    for (int keep = 1; keep < count; keep++) {
        char copy[DAL__NUMBER_SIZE + 1] = "0";
        memcpy(copy + 1, digit, (size_t)keep);
        copy[keep + 1] = '\0';
        int i = keep;
        if (digit[keep] >= '5')
            while (copy[i] == '9') copy[i--] = '0';
        copy[i] = (char)(copy[i] + (digit[keep] >= '5'));
        snprintf(rounded, sizeof rounded, "%c.%se%d", copy[0], copy + 1, *exponent);
        double value;
        if (dal__parse_number(rounded, strlen(rounded), &value) != DAL_STATUS_OK || value != x)
            continue;
        const int carry = copy[0] != '0';
        *exponent += carry;
        for (count = keep + carry; count > 1 && copy[count - carry] == '0';) count--;
        memmove(digit, copy + 1 - carry, (size_t)count);
        break;
    }
    return count;
}

static void put_number(double x, bool is_plain, dal__buffer *text)
{
    enum { MAX_WHOLE = 7, MAX_ZEROS = 3 };
    char digit[DAL__NUMBER_SIZE];
    int exponent;
    if (x < 0.0) dal__buffer_append(text, "-");
    if (x == 0.0 || isnan(x) || isinf(x)) {
        const char *nan = is_plain ? "nan" : "\\mathrm{NaN}";
        dal__buffer_append(text, isnan(x) ? nan : x == 0.0 ? "0" : is_plain ? "inf" : "\\infty");
        return;
    }
    if (!is_plain &&
        (typeset_fraction(fabs(x), "", text) || typeset_fraction(fabs(x) / DAL__PI, "\\pi", text)))
        return;
    const int count = find_digits(fabs(x), digit, &exponent);
    const bool is_short = exponent > -MAX_ZEROS && exponent <= MAX_WHOLE;
    const int whole = is_short ? exponent : 1;
    if (whole <= 0) dal__buffer_append(text, "0.");
    for (int i = whole; i < 0; i++) dal__buffer_append(text, "0");
    for (int i = 0; i < count || i < whole; i++) {
        if (i == whole && i > 0) dal__buffer_append(text, ".");
        dal__buffer_append_bytes(text, i < count ? digit + i : "0", 1);
    }
    if (!is_short) dal__buffer_print(text, is_plain ? "e%d" : " \\cdot 10^{%d}", exponent - 1);
}

int dal__greek_letter(const char *name, size_t length)
{
    static const struct {
        const char *name;
        int code;
    } letters[] = {{"alpha", 0x3B1},   {"beta", 0x3B2},  {"gamma", 0x3B3},   {"delta", 0x3B4},
                   {"epsilon", 0x3B5}, {"zeta", 0x3B6},  {"eta", 0x3B7},     {"theta", 0x3B8},
                   {"iota", 0x3B9},    {"kappa", 0x3BA}, {"lambda", 0x3BB},  {"mu", 0x3BC},
                   {"nu", 0x3BD},      {"xi", 0x3BE},    {"pi", 0x3C0},      {"rho", 0x3C1},
                   {"sigma", 0x3C3},   {"tau", 0x3C4},   {"upsilon", 0x3C5}, {"phi", 0x3C6},
                   {"chi", 0x3C7},     {"psi", 0x3C8},   {"omega", 0x3C9},   {"Gamma", 0x393},
                   {"Delta", 0x394},   {"Theta", 0x398}, {"Lambda", 0x39B},  {"Xi", 0x39E},
                   {"Sigma", 0x3A3},   {"Phi", 0x3A6},   {"Psi", 0x3A8},     {"Omega", 0x3A9}};
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
        if (strlen(letters[i].name) == length && memcmp(letters[i].name, name, length) == 0)
            return letters[i].code;
    return 0;
}

void dal__typeset_name(const char *name, const char *accent, dal__buffer *text)
{
    const size_t length = strcspn(name, "_0123456789");
    const char *subscript = name + length + (name[length] == '_' && name[length + 1]);
    if (accent) dal__buffer_print(text, "%s{", accent);
    if (dal__greek_letter(name, length)) {
        const bool is_phi = length == 3 && memcmp(name, "phi", 3) == 0;
        dal__buffer_print(text, "\\%s%.*s", is_phi ? "var" : "", (int)length, name);
    } else {
        dal__buffer_print(text, length > 1 ? "\\mathrm{%.*s}" : "%.*s", (int)length, name);
    }
    if (accent) dal__buffer_append(text, "}");
    if (!*subscript) return;
    dal__buffer_append(text, "_{");
    if (dal__greek_letter(subscript, strlen(subscript))) {
        dal__typeset_name(subscript, NULL, text);
    } else {
        const bool is_word = strspn(subscript, "0123456789") < strlen(subscript) && subscript[1];
        if (is_word) dal__buffer_append(text, "\\mathrm{");
        for (const char *c = subscript; *c; c++)
            dal__buffer_print(text, *c == '_' ? "\\_" : "%c", *c);
        if (is_word) dal__buffer_append(text, "}");
    }
    dal__buffer_append(text, "}");
}

/* ---- operations ---------------------------------------------------------------------------- */

/* How an operation is written, sums, products and tables excepted: #1, #2, #3 are its operands,
 * which get brackets where their level is below the given one. */
typedef struct style {
    const char *text;
    level level, least[3];
} style;

#define FUNCTION(name)                                                                             \
    {                                                                                              \
        name "(#1)", LEVEL_FACTOR, { LEVEL_ANY }                                                   \
    }
#define OF_TWO(name)                                                                               \
    {                                                                                              \
        "\\operatorname{" name "}\\left(#1, #2\\right)", LEVEL_FACTOR, { LEVEL_ANY }               \
    }
#define COMPARISON(sign)                                                                           \
    {                                                                                              \
        "#1 " sign " #2", LEVEL_COMPARISON, { LEVEL_SUM, LEVEL_SUM }                               \
    }

static const style styles[DAL__OP_COUNT] = {
    [DAL__SUB] = {"#1 - #2", LEVEL_SUM, {LEVEL_SUM, LEVEL_PRODUCT}},
    [DAL__DIV] = {"\\frac{#1}{#2}", LEVEL_FACTOR, {LEVEL_ANY, LEVEL_ANY}},
    [DAL__NEG] = {"-#1", LEVEL_NEGATIVE, {LEVEL_PRODUCT}},
    [DAL__POW] = {"#1^{#2}", LEVEL_FACTOR, {LEVEL_ATOM, LEVEL_ANY}},
    [DAL__SQRT] = {"\\sqrt{#1}", LEVEL_FACTOR, {LEVEL_ANY}},
    [DAL__EXP] = FUNCTION("\\exp"),
    [DAL__LOG] = FUNCTION("\\ln"),
    [DAL__SIN] = FUNCTION("\\sin"),
    [DAL__COS] = FUNCTION("\\cos"),
    [DAL__TAN] = FUNCTION("\\tan"),
    [DAL__ASIN] = FUNCTION("\\arcsin"),
    [DAL__ACOS] = FUNCTION("\\arccos"),
    [DAL__ATAN] = FUNCTION("\\arctan"),
    [DAL__ATAN2] = OF_TWO("atan2"),
    [DAL__SINH] = FUNCTION("\\sinh"),
    [DAL__COSH] = FUNCTION("\\cosh"),
    [DAL__TANH] = FUNCTION("\\tanh"),
    [DAL__ASINH] = FUNCTION("\\operatorname{arsinh}"),
    [DAL__ABS] = {"\\left|#1\\right|", LEVEL_ATOM, {LEVEL_ANY}},
    [DAL__SIGN] = FUNCTION("\\operatorname{sign}"),
    [DAL__FLOOR] = {"\\left\\lfloor #1\\right\\rfloor", LEVEL_ATOM, {LEVEL_ANY}},
    [DAL__MIN] = OF_TWO("min"),
    [DAL__MAX] = OF_TWO("max"),
    [DAL__HYPOT] = {"\\sqrt{#1^{2} + #2^{2}}", LEVEL_FACTOR, {LEVEL_ATOM, LEVEL_ATOM}},
    [DAL__LESS] = COMPARISON("<"),
    [DAL__LESS_EQUAL] = COMPARISON("\\le"),
    [DAL__EQUAL] = COMPARISON("="),
    [DAL__IF] = {"\\begin{cases} #2 & \\text{if } #1 \\\\ #3 & \\text{else} \\end{cases}",
                 LEVEL_PRODUCT,
                 {LEVEL_ANY, LEVEL_ANY, LEVEL_ANY}},
};

/* The same in the language of formulas, where a power binds tighter than a sign. */
static const style plain_styles[DAL__OP_COUNT] = {
    [DAL__SUB] = {"#1 - #2", LEVEL_SUM, {LEVEL_SUM, LEVEL_PRODUCT}},
    [DAL__DIV] = {"#1/#2", LEVEL_PRODUCT, {LEVEL_PRODUCT, LEVEL_FACTOR}},
    [DAL__NEG] = {"-#1", LEVEL_NEGATIVE, {LEVEL_PRODUCT}},
    [DAL__POW] = {"#1^#2", LEVEL_FACTOR, {LEVEL_ATOM, LEVEL_ATOM}},
    [DAL__LESS] = COMPARISON("<"),
    [DAL__LESS_EQUAL] = COMPARISON("<="),
    [DAL__EQUAL] = COMPARISON("=="),
};

/* The name of an operation in formulas, for a call; NULL: it is written with a sign. */
static const char *const plain_names[DAL__OP_COUNT] = {
#define NAME(code, arity, name) [DAL__##code] = name,
    DAL__OP_LIST(NAME)
#undef NAME
};

/* Appends an operand, in brackets where it is below a level. */
static void put_operand(const dal__typesetter *t, const formula *f, level least, dal__buffer *text)
{
    const bool in_brackets = f->level < least, is_plain = t->options.is_plain;
    if (in_brackets) dal__buffer_append(text, is_plain ? "(" : "\\left(");
    dal__buffer_append(text, f->text);
    if (in_brackets) dal__buffer_append(text, is_plain ? ")" : "\\right)");
}

enum { MAX_FACTORS = 32 };
typedef struct factors {
    dal__node base[MAX_FACTORS];
    int power[MAX_FACTORS], count;
} factors;

/* Adds the factors of a node, equal ones as a power; false: there are too many. */
static bool add_factors(const dal__typesetter *t, dal__node node, factors *f)
{
    dal__node waiting[MAX_FACTORS];
    int n = 0;
    waiting[n++] = node;
    while (n > 0) {
        const dal__node i = waiting[--n];
        const dal__record r = dal__inspect(t->graph, i);
        if (r.op == DAL__MUL && (i == node || !t->formula[i].is_named)) {
            if (n + 2 > MAX_FACTORS) return false;
            waiting[n++] = r.b;
            waiting[n++] = r.a;
            continue;
        }
        int k = 0;
        while (k < f->count && f->base[k] != i) k++;
        if (k == MAX_FACTORS) return false;
        if (k == f->count) {
            f->base[f->count] = i;
            f->power[f->count++] = 0;
        }
        f->power[k]++;
    }
    return true;
}

/* x^k, and sin^k(x) of a function. */
static void put_power(const dal__typesetter *t, dal__node base, int power, level least,
                      dal__buffer *text)
{
    const formula *f = &t->formula[base];
    const int op = dal__inspect(t->graph, base).op;
    if (power == 1) {
        put_operand(t, f, least, text);
    } else if (!t->options.is_plain && (op == DAL__SIN || op == DAL__COS)) {
        const size_t name = strcspn(f->text, "(");
        dal__buffer_append_bytes(text, f->text, name);
        dal__buffer_print(text, "^{%d}", power);
        dal__buffer_append(text, f->text + name);
    } else {
        const bool is_call = t->options.is_plain && plain_names[op];
        put_operand(t, f, is_call ? LEVEL_FACTOR : LEVEL_ATOM, text);
        dal__buffer_print(text, t->options.is_plain ? "^%d" : "^{%d}", power);
    }
}

/* A product, numbers first, then what begins with a minus. */
static void put_product(const dal__typesetter *t, dal__node node, formula *f, dal__buffer *text)
{
    factors all = {.count = 0};
    if (!add_factors(t, node, &all)) {
        const dal__record r = dal__inspect(t->graph, node);
        all = (factors){.base = {r.a, r.b}, .power = {1, 1}, .count = 2};
    }
    f->level = all.count == 1 ? LEVEL_FACTOR : LEVEL_PRODUCT;
    int written = 0;
    for (int pass = 0; pass < 3; pass++)
        for (int k = 0; k < all.count; k++) {
            const formula *factor = &t->formula[all.base[k]];
            const bool is_number = dal__inspect(t->graph, all.base[k]).op == DAL__NUMBER;
            if (pass != (is_number ? 0 : factor->level == LEVEL_NEGATIVE ? 1 : 2)) continue;
            const bool has_digit =
                factor->level >= LEVEL_PRODUCT && factor->text[0] >= '0' && factor->text[0] <= '9';
            if (written > 0)
                dal__buffer_append(text, t->options.is_plain ? "*"
                                         : has_digit         ? " \\cdot "
                                                             : "\\,");
            if (written == 0 && factor->level == LEVEL_NEGATIVE && all.power[k] == 1)
                f->level = LEVEL_NEGATIVE;
            put_power(t, all.base[k], all.power[k], written > 0 ? LEVEL_PRODUCT : LEVEL_NEGATIVE,
                      text);
            written++;
        }
}

/* A sum; a negative term after another one is subtracted, and does not come first. */
static void put_sum(const dal__typesetter *t, const dal__record *r, formula *f, dal__buffer *text)
{
    const formula *a = &t->formula[r->a], *b = &t->formula[r->b];
    const bool is_swapped = a->text[0] == '-' && b->text[0] != '-' && b->level >= LEVEL_SUM;
    const formula *first = is_swapped ? b : a, *second = is_swapped ? a : b;
    put_operand(t, first, LEVEL_SUM, text);
    if (second->level < LEVEL_SUM || second->text[0] != '-') {
        dal__buffer_append(text, " + ");
        put_operand(t, second, LEVEL_SUM, text);
    } else {
        dal__buffer_append(text, " - ");
        dal__buffer_append(text, second->text + 1);
    }
    f->level = LEVEL_SUM;
}

static void put_styled(const dal__typesetter *t, const dal__record *r, formula *f,
                       dal__buffer *text)
{
    const style *s = &(t->options.is_plain ? plain_styles : styles)[r->op];
    const dal__node operand[] = {r->a, r->b, r->c};
    if (!s->text) { /* name(a, b) */
        dal__buffer_append(text, plain_names[r->op]);
        for (int i = 0; i < 3 && operand[i]; i++) {
            dal__buffer_append(text, i == 0 ? "(" : ", ");
            dal__buffer_append(text, t->formula[operand[i]].text);
        }
        dal__buffer_append(text, ")");
        f->level = LEVEL_FACTOR;
        return;
    }
    for (const char *c = s->text; *c; c++) {
        if (*c != '#') {
            dal__buffer_append_bytes(text, c, 1);
            continue;
        }
        const int i = *++c - '1';
        put_operand(t, &t->formula[operand[i]], s->least[i], text);
    }
    f->level = s->level;
}

/* name(x), with a prime for each derivative. */
static void put_table(const dal__typesetter *t, const dal__record *r, formula *f, dal__buffer *text)
{
    t->options.table(t->options.user, r->symbol / DAL__TABLE_ORDERS, text);
    for (int k = r->symbol % DAL__TABLE_ORDERS; k > 0; k--) dal__buffer_append(text, "'");
    dal__buffer_append(text, t->options.is_plain ? "(" : "\\left(");
    dal__buffer_append(text, t->formula[r->a].text);
    dal__buffer_append(text, t->options.is_plain ? ")" : "\\right)");
    f->level = LEVEL_FACTOR;
}

/* The text of a node whose operands have theirs. */
static void typeset_node(const dal__typesetter *t, dal__node i, formula *f, dal__buffer *text)
{
    const dal__record r = dal__inspect(t->graph, i);
    if (r.op == DAL__NUMBER) {
        put_number(r.value, t->options.is_plain, text);
        const bool is_long = text->bytes && (strchr(text->bytes, ' ') || strchr(text->bytes, '\\'));
        f->level = r.value < 0.0 ? LEVEL_NEGATIVE : is_long ? LEVEL_FACTOR : LEVEL_ATOM;
    } else if (r.op == DAL__SYMBOL) {
        t->options.symbol(t->options.user, r.symbol, text);
        f->level = LEVEL_ATOM;
    } else if (r.op == DAL__MUL) {
        put_product(t, i, f, text);
    } else if (r.op == DAL__ADD) {
        put_sum(t, &r, f, text);
    } else if (r.op == DAL__TABLE) {
        put_table(t, &r, f, text);
    } else {
        put_styled(t, &r, f, text);
    }
}

/* ---- all nodes ----------------------------------------------------------------------------- */

/* The name that a node had before; NULL: none. */
static const char *name_before(const dal__typesetter *t, dal__node i)
{
    const dal__typesetter *before = t->options.before;
    return before && i <= before->last && before->formula[i].is_named ? before->formula[i].text
                                                                      : NULL;
}

/* The text becomes the meaning of a name. */
static void share(dal__typesetter *t, formula *f, dal__buffer *name)
{
    if (name->out_of_memory) t->status = DAL_STATUS_MEMORY;
    if (t->status != DAL_STATUS_OK) return;
    t->shared[t->shared_count++] = (meaning){f, f->text};
    *f = (formula){name->bytes, LEVEL_ATOM, true};
}

static void typeset_all(dal__typesetter *t, const uint8_t *reached, const int *uses)
{
    for (dal__node i = 1; i <= t->last && t->status == DAL_STATUS_OK; i++) {
        if (!reached[i]) continue;
        dal__buffer text = {0}, name = {0};
        formula *f = &t->formula[i];
        const char *before = name_before(t, i);
        if (before) {
            dal__buffer_append(&text, before);
            if (text.out_of_memory) t->status = DAL_STATUS_MEMORY;
            *f = (formula){text.bytes, LEVEL_ATOM, true};
            continue;
        }
        typeset_node(t, i, f, &text);
        f->text = text.bytes;
        if (text.length > MAX_LENGTH) t->status = DAL_STATUS_TOO_LARGE;
        if (text.out_of_memory) t->status = DAL_STATUS_MEMORY;
        const bool is_named = t->options.name && t->options.name(t->options.user, i, &name);
        if (!is_named && uses[i] > 1 && text.length > t->options.shared_length)
            dal__buffer_print(&name, "%s_{%d}", t->options.letter, ++t->numbered);
        if (name.length > 0 || name.out_of_memory) share(t, f, &name);
    }
}

/* How many operands, and wanted nodes, each node is. */
static void count_uses(dal__typesetter *t, const dal__node *nodes, int count,
                       const uint8_t *reached, int *uses)
{
    for (dal__node i = 1; i <= t->last; i++) {
        if (!reached[i] || name_before(t, i)) continue;
        const dal__record r = dal__inspect(t->graph, i);
        uses[r.a]++;
        if (r.b != r.a) uses[r.b]++;
        uses[r.c]++;
    }
    for (int k = 0; k < count; k++) uses[nodes[k]] += nodes[k] != 0;
}

dal_status dal__typesetter_create(dal__typesetter **typesetter, dal__graph *graph,
                                  const dal__node *nodes, int count,
                                  const dal__typeset_options *options)
{
    const dal__node last = dal__last_of(nodes, count);
    dal__typesetter *t = calloc(1, sizeof *t);
    uint8_t *reached = dal__reach_all(graph, nodes, count);
    int *uses = calloc((size_t)last + 1, sizeof *uses);
    dal_status status = DAL_STATUS_MEMORY;
    if (t) {
        *t = (dal__typesetter){.graph = graph,
                               .last = last,
                               .numbered = options->before ? options->before->numbered : 0,
                               .options = *options};
        t->formula = calloc((size_t)last + 1, sizeof *t->formula);
        t->shared = calloc((size_t)last + 1, sizeof *t->shared);
        if (reached && uses && t->formula && t->shared) {
            count_uses(t, nodes, count, reached, uses);
            typeset_all(t, reached, uses);
            status = t->status;
        }
    }
    free(reached);
    free(uses);
    if (status != DAL_STATUS_OK) {
        dal__typesetter_free(t);
        t = NULL;
    }
    *typesetter = t;
    return status;
}

void dal__typesetter_free(dal__typesetter *t)
{
    if (!t) return;
    for (dal__node i = 0; t->formula && i <= t->last; i++) free(t->formula[i].text);
    for (int k = 0; t->shared && k < t->shared_count; k++) free(t->shared[k].text);
    free(t->formula);
    free(t->shared);
    free(t);
}

const char *dal__typeset(const dal__typesetter *t, dal__node node)
{
    return node > 0 && node <= t->last ? t->formula[node].text : NULL;
}

const char *dal__typeset_shared(const dal__typesetter *t, int i, const char **name)
{
    if (i >= t->shared_count) return NULL;
    *name = t->shared[i].name->text;
    return t->shared[i].text;
}
