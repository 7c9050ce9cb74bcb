/* taylor_emit.c - series programs as C over num: the recurrences, written out.
 *
 * Coefficient k of series i is c[i][k], inner sum i is s<i>.  There are two bodies, for order 0 and
 * for any order k from 1 on, so that the length of the text does not depend on the order. */
#include "expr/taylor_emit.h"
#include "expr/arithmetic.h"
#include "expr/emit.h"
#include <string.h>

/* The body that is written: which order, as it is called there. */
typedef struct writer {
    const dal__taylor *taylor;
    const dal__tapes *tapes;
    const dal__taylor_operation *operation;
    const char *order; /* "0" or "k" */
    dal__buffer *text;
    int lanes;
    bool has_interiors; /* the sums of an order */
    int interior[2];    /* number of the next one of products, of squares */
    int sums;           /* written so far */
} writer;

/* Whether coefficient k of a slot is a variable c<i>, since no later order needs it. */
static bool is_variable(const writer *w, uint32_t slot, const char *order)
{
    return strcmp(order, "k") == 0 && !w->taylor->kept[slot];
}

static void write_coefficient(const writer *w, uint32_t a, const char *order)
{
    if (!dal__is_constant(a))
        dal__buffer_print(w->text, is_variable(w, a, order) ? "c%u" : "c[%u][%s]", a, order);
    else if (*order == '0')
        dal__constant_write(w->tapes, a & ~DAL__TAYLOR_CONSTANT, DAL__AS_NUM, w->text);
    else
        dal__buffer_append(w->text, "dal_num(0.0)");
}

/* ---- formulas ---- */

static const struct formulas {
    const char *u, *w, *w_0, *divisor; /* NULL: none */
} recurrences[DAL__RECURRENCES] = {
#define PLAIN(code, sums, u)                    [DAL__##code] = {#u, NULL, NULL, NULL},
#define QUOTIENT(code, sums, divisor, u)        [DAL__##code] = {#u, NULL, NULL, #divisor},
#define PAIR(code, sums, second, u, w)          [DAL__##code] = {#u, #w, #second, NULL},
#define PAIR_QUOTIENT(code, sums, second, u, w) [DAL__##code] = {#u, #w, #second, "w_0"},
    DAL__RECURRENCE_LIST(PLAIN, QUOTIENT, PAIR, PAIR_QUOTIENT)
#undef PLAIN
#undef QUOTIENT
#undef PAIR
#undef PAIR_QUOTIENT
};

static const char *const convolutions[] = {
#define FORM(name, expression) [DAL__##name] = #expression,
    DAL__CONVOLUTION_LIST(FORM)
#undef FORM
};

static bool is_name(const char *name, size_t length, const char *known)
{
    return strlen(known) == length && memcmp(name, known, length) == 0;
}

/* The operand of that letter. */
static uint32_t operand(const dal__taylor_operation *i, char letter)
{
    const char letters[] = "abcuw";
    const uint32_t operands[] = {i->a, i->b, i->c, i->u, i->w};
    return operands[strchr(letters, letter) - letters];
}

static void write_formula(const writer *w, const char *formula);

/* PRODUCT or INTEGRAL of the arguments "a, b, j". */
static void write_convolution(const writer *w, const char *arguments, bool is_product)
{
    dal__taylor_operation pair = *w->operation;
    writer of_pair = *w;
    pair.a = operand(w->operation, arguments[0]);
    pair.b = operand(w->operation, arguments[3]);
    pair.sum[0] = w->operation->sum[arguments[6] - '0'];
    of_pair.operation = &pair;
    write_formula(&of_pair, convolutions[is_product ? dal__product_form(pair.a, pair.b)
                                                    : dal__integral_form(pair.a, pair.b)]);
}

/* What a name of recurrences.h means. */
static const char *write_name(const void *user, const char *name, size_t length)
{
    const writer *w = user;
    const dal__taylor_operation *i = w->operation;
    const bool is_product = is_name(name, length, "PRODUCT");
    if (is_product || is_name(name, length, "INTEGRAL")) {
        write_convolution(w, name + length + 1, is_product);
        return strchr(name, ')') + 1;
    }
    if (is_name(name, length, "INNER")) {
        dal__buffer_print(w->text, "s%u", i->sum[name[length + 1] - '0']);
        return strchr(name, ')') + 1;
    }
    if (is_name(name, length, "SUM"))
        dal__buffer_print(w->text, "s%u", *i->sum);
    else if (is_name(name, length, "reciprocal"))
        write_coefficient(w, i->reciprocal, "0");
    else if (!strchr("abcuw", *name))
        return NULL;
    else if (length == 1)
        write_coefficient(w, operand(i, *name), w->order);
    else if (is_name(name + 1, length - 1, "_0"))
        write_coefficient(w, operand(i, *name), "0");
    else if (is_name(name + 1, length - 1, "_before"))
        write_coefficient(w, operand(i, *name), "k - 1");
    else
        return NULL;
    return name + length;
}

static void write_formula(const writer *w, const char *formula)
{
    dal__expression_write(formula, write_name, w, w->text);
}

static void write_statement(const writer *w, uint32_t slot, const char *order, const char *before,
                            const char *formula)
{
    dal__buffer_append(w->text, is_variable(w, slot, order) ? "    const num " : "    ");
    write_coefficient(w, slot, order);
    dal__buffer_print(w->text, " = %s", before);
    write_formula(w, formula);
    dal__buffer_append(w->text, ";\n");
}

static void write_first(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    const struct formulas *row = &recurrences[i->recurrence];
    const bool is_slope = i->op == DAL__SLOPE;
    if (i->op == DAL__SINCOS) {
        dal__buffer_append(w->text, "    dal_sincos(");
        write_coefficient(w, i->a, "0");
        dal__buffer_print(w->text, ", &c[%u][0], &c[%u][0]);\n", i->u, i->w);
        return;
    }
    write_statement(w, i->u, "0", "", is_slope ? "dal_num(0.0)" : dal__operation_expression(i->op));
    if (row->w_0) write_statement(w, i->w, "0", "", row->w_0);
    if (row->divisor) write_statement(w, i->reciprocal, "0", "1.0 / ", row->divisor);
}

static void write_next(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    const struct formulas *row = &recurrences[i->recurrence];
    if (i->once) return;
    write_statement(w, i->u, "k", "", row->u ? row->u : "dal_num(NAN)"); /* refused */
    if (row->w) write_statement(w, i->w, "k", "", row->w);
}

/* ---- inner sums ---- */

static bool is_square(const dal__taylor_sum *sum) { return sum->a == sum->b; }

typedef enum sum_kind { PRODUCTS, SQUARES } sum_kind;

/* The sums of a kind that are needed. */
static int count_sums(const dal__taylor *taylor, sum_kind kind)
{
    int count = 0;
    for (int k = 0; k < taylor->sums; k++)
        count += taylor->sum[k].needed && is_square(&taylor->sum[k]) == (kind == SQUARES);
    return count;
}

/* One lane forms its sums in packs. */
static bool is_packed(int lanes) { return lanes == 1; }

/* The same, rounded up to whole packs where there are any. */
static int count_places(const dal__taylor *taylor, sum_kind kind, int lanes)
{
    const int pack = is_packed(lanes) ? DAL__PACK : 1;
    return (count_sums(taylor, kind) + pack - 1) / pack * pack;
}

/* Steps with more sums form interiors in pairs of orders (kernel/series.h). */
enum { FEW_SUMS = 8 };

static bool has_few_sums(const dal__taylor *taylor)
{
    return count_sums(taylor, PRODUCTS) + count_sums(taylor, SQUARES) <= FEW_SUMS;
}

int dal__taylor_extra(const dal__taylor *taylor, int lanes, int order)
{
    const int products = count_places(taylor, PRODUCTS, lanes);
    const int squares = count_places(taylor, SQUARES, lanes);
    const int kept = has_few_sums(taylor) ? 0 : (2 * (products + squares) + order) / (order + 1);
    return (is_packed(lanes) ? 2 * products + squares : 0) + kept;
}

/* The slots of the operands of sums of a kind. */
static void write_slots(const writer *w, sum_kind kind)
{
    for (int k = 0; k < w->taylor->sums; k++) {
        const dal__taylor_sum *sum = &w->taylor->sum[k];
        if (!sum->needed || is_square(sum) != (kind == SQUARES)) continue;
        dal__buffer_print(w->text, kind == SQUARES ? "%u, " : "%u, %u, ", sum->a, sum->b);
    }
}

/* sum[products + squares]: the interiors of all sums. */
static void write_interiors(const writer *w)
{
    const bool packed = is_packed(w->lanes);
    if (packed)
        dal__buffer_append(w->text,
                           "    num *const r = l + products * (DAL_FIXED_TAYLOR_ORDER + 1),\n"
                           "        *const q = r + products * (DAL_FIXED_TAYLOR_ORDER + 1);\n");
    if (packed && has_few_sums(w->taylor)) {
        dal__buffer_append(w->text, "    num sum[products + squares + 1];\n"
                                    "    (void)r, (void)q;\n"
                                    "    dal_product_interiors(l, r, products, k, sum);\n"
                                    "    dal_square_interiors(q, squares, k, sum + products);\n");
        return;
    }
    if (packed) {
        dal__buffer_append(w->text,
                           "    num *const kept = q + squares * (DAL_FIXED_TAYLOR_ORDER + 1);\n"
                           "    dal_pair_packs(l, r, products, q, squares, k, "
                           "DAL_FIXED_TAYLOR_ORDER, kept);\n");
    } else {
        dal__buffer_append(w->text, "    num *const kept = l;\n"
                                    "    static const int slot[] = {");
        write_slots(w, PRODUCTS);
        write_slots(w, SQUARES);
        dal__buffer_append(w->text, "0};\n"
                                    "    dal_pair_lanes(c[0], slot, products, squares, k, "
                                    "DAL_FIXED_TAYLOR_ORDER, kept);\n");
    }
    dal__buffer_append(w->text,
                       "    const num *const sum = kept + k % 2 * (products + squares);\n");
}

/* What precedes the sums of an order.  Packs, and many sums, have interiors; for k <= 2 there are
 * none of the terms with order p = k - 1 that are added to them, and p is the column of zeros. */
static void begin_sums(writer *w)
{
    const dal__taylor *taylor = w->taylor;
    const int products = count_places(taylor, PRODUCTS, w->lanes);
    const int squares = count_places(taylor, SQUARES, w->lanes);
    w->has_interiors = is_packed(w->lanes) || !has_few_sums(taylor);
    w->interior[SQUARES] = products;
    if (!w->has_interiors) return;
    dal__buffer_print(w->text, "    enum { products = %d, squares = %d };\n", products, squares);
    write_interiors(w);
    dal__buffer_append(w->text, "    const int p = k > 2 ? k - 1 : DAL_FIXED_TAYLOR_ORDER;\n"
                                "    (void)sum, (void)p;\n");
}

static void write_sum(writer *w, int k)
{
    const dal__taylor_sum *sum = &w->taylor->sum[k];
    const sum_kind kind = is_square(sum) ? SQUARES : PRODUCTS;
    const uint32_t a = sum->a, b = sum->b;
    dal__buffer_print(w->text, "    const num s%d = ", k);
    if (!w->has_interiors && kind == SQUARES)
        dal__buffer_print(w->text, "dal_sum_squares(c[%u], k);\n", a);
    else if (!w->has_interiors)
        dal__buffer_print(w->text, "dal_sum_products(c[%u], c[%u], k);\n", a, b);
    else if (kind == SQUARES)
        dal__buffer_print(w->text, "dal_fma(c[%u][1] + c[%u][1], c[%u][p], sum[%d]);\n", a, a, a,
                          w->interior[kind]++);
    else
        dal__buffer_print(w->text,
                          "dal_fma(c[%u][p], c[%u][1], dal_fma(c[%u][1], c[%u][p], sum[%d]));\n", a,
                          b, a, b, w->interior[kind]++);
}

/* The sums before number `end` that are not yet written. */
static void write_sums_before(writer *w, int end)
{
    for (; w->sums < end; w->sums++)
        if (w->taylor->sum[w->sums].needed) write_sum(w, w->sums);
}

/* The sums that an operation is the first to use; the list has them in the order of operations. */
static void write_sums_of(writer *w, const dal__taylor_operation *i)
{
    for (int j = 0; j < i->sums; j++)
        if (!dal__is_constant(i->sum[j])) write_sums_before(w, (int)i->sum[j] + 1);
}

/* Stores the operands of sums side by side, and fills the last pack with 0, since memory may hold
 * subnormal numbers, which are slow. */
static void write_operands(const writer *w)
{
    int next[2] = {0, 0};
    for (int k = 0; k < w->taylor->sums; k++) {
        const dal__taylor_sum *sum = &w->taylor->sum[k];
        if (!sum->needed) continue;
        if (is_square(sum)) {
            dal__buffer_print(w->text, "    q[k * squares + %d] = c[%u][k];\n", next[1]++, sum->a);
            continue;
        }
        dal__buffer_print(w->text, "    l[k * products + %d] = c[%u][k];\n", next[0], sum->a);
        dal__buffer_print(w->text, "    r[k * products + %d] = c[%u][k];\n", next[0]++, sum->b);
    }
    dal__buffer_print(w->text,
                      "    for (int i = %d; i < products; i++)\n"
                      "        l[k * products + i] = r[k * products + i] = dal_num(0.0);\n"
                      "    for (int i = %d; i < squares; i++) q[k * squares + i] = dal_num(0.0);\n",
                      next[0], next[1]);
}

/* The terms of orders 1 and 2 that are not there. */
static void clear_columns(const writer *w)
{
    dal__buffer_append(w->text, "    static const int operand[] = {");
    write_slots(w, PRODUCTS);
    write_slots(w, SQUARES);
    dal__buffer_print(
        w->text,
        "0};\n    for (int i = 0; i < %d; i++)\n"
        "        c[operand[i]][1] = c[operand[i]][DAL_FIXED_TAYLOR_ORDER] = dal_num(0.0);\n",
        2 * count_sums(w->taylor, PRODUCTS) + count_sums(w->taylor, SQUARES));
}

void dal__taylor_write(const dal__taylor *taylor, const dal__tapes *tapes, dal__coefficient which,
                       int lanes, dal__buffer *text)
{
    const bool packed = is_packed(lanes);
    writer w = {.taylor = taylor,
                .tapes = tapes,
                .order = which == DAL__FIRST ? "0" : "k",
                .text = text,
                .lanes = lanes};
    if (which == DAL__NEXT) {
        dal__buffer_append(text, "    const num inverse = dal_inverse(k);\n"
                                 "    const num unit_inverse = DAL_FIXED_UNIT_OF_TIME * inverse;\n"
                                 "    (void)inverse, (void)unit_inverse;\n");
        begin_sums(&w);
        /* Many of lanes are each where it is used: there are not as many registers. */
        if (packed || has_few_sums(taylor)) write_sums_before(&w, taylor->sums);
    }
    for (int n = 0; n < taylor->length; n++) {
        w.operation = &taylor->code[n];
        if (which == DAL__FIRST) {
            write_first(&w);
        } else {
            write_sums_of(&w, w.operation);
            write_next(&w);
        }
    }
    if ((packed || !has_few_sums(taylor)) && which == DAL__FIRST)
        clear_columns(&w);
    else if (packed)
        write_operands(&w);
}

void dal__taylor_write_output(const dal__taylor *taylor, const dal__tapes *tapes, int output,
                              dal__coefficient which, dal__buffer *text)
{
    const writer w = {
        .taylor = taylor, .tapes = tapes, .order = which == DAL__FIRST ? "0" : "k", .text = text};
    write_coefficient(&w, taylor->output[output], w.order);
}
