/* taylor_emit.c - series programs as C over num: the recurrences of taylor_wide.c, written out.
 *
 * Coefficient k of series i is c[i][k], inner sum i is s<i>.  There are two bodies, for order 0 and
 * for any order k from 1 on, so that the length of the text does not depend on the order. */
#include "expr/taylor_emit.h"
#include "expr/arithmetic.h"
#include "expr/emit.h"
#include "expr/traversal.h"

/* The body that is written: which order, as it is called there. */
typedef struct writer {
    const dal__taylor *taylor;
    const dal__tapes *tapes;
    const dal__taylor_operation *operation;
    const char *order; /* "0" or "k" */
    dal__buffer *text;
} writer;

static bool is_constant(uint32_t a) { return (a & DAL__TAYLOR_CONSTANT) != 0; }

static void write_constant(const writer *w, uint32_t a)
{
    dal__constant_write(w->tapes, a & ~DAL__TAYLOR_CONSTANT, false, w->text);
}

/* Coefficient 0, or k, of an operand. */
static void write_coefficient(const writer *w, uint32_t a)
{
    if (!is_constant(a))
        dal__buffer_print(w->text, "c[%u][%s]", a, w->order);
    else if (*w->order == '0')
        write_constant(w, a);
    else
        dal__buffer_append(w->text, "dal_num(0.0)");
}

static uint32_t operand(const dal__taylor_operation *i, int number)
{
    return number == 0 ? i->a : number == 1 ? i->b : i->c;
}

static void write_operand(const void *user, int number)
{
    const writer *w = user;
    write_coefficient(w, operand(w->operation, number));
}

/* ---- order 0 ---- */

/* The second series of a recurrence; see companion in taylor_wide.c. */
static const char *companion(uint32_t op)
{
    switch (op) {
    case DAL__SIN:
        return "dal_cos(a)";
    case DAL__COS:
        return "dal_sin(a)";
    case DAL__SINH:
        return "dal_cosh(a)";
    case DAL__COSH:
        return "dal_sinh(a)";
    case DAL__ASIN:
    case DAL__ACOS:
        return "dal_sqrt((1.0 - a) * (1.0 + a))";
    case DAL__ASINH:
        return "dal_sqrt(dal_fma(a, a, dal_num(1.0)))";
    case DAL__ATAN:
        return "dal_fma(a, a, dal_num(1.0))";
    case DAL__ATAN2:
        return "dal_fma(a, a, b * b)";
    default: /* of tan and tanh */
        return "u * u";
    }
}

static void write_companion(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    dal__buffer_append(w->text, "    {\n        const num a = ");
    write_coefficient(w, i->a);
    dal__buffer_append(w->text, ", b = ");
    write_coefficient(w, i->op == DAL__ATAN2 ? i->b : i->a);
    dal__buffer_print(w->text, ", u = c[%u][0];\n        (void)a, (void)b, (void)u;\n", i->d);
    dal__buffer_print(w->text, "        c[%u][0] = %s;\n    }\n", i->e, companion(i->op));
}

/* What the recurrence divides by; see divisor in taylor_wide.c. */
static void write_reciprocal(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    const uint32_t of_operation = i->op == DAL__DIV                           ? i->b
                                  : i->op == DAL__POW || i->op == DAL__LOG    ? i->a
                                  : i->op == DAL__SQRT || i->op == DAL__HYPOT ? i->d
                                                                              : i->e;
    dal__buffer_print(w->text, "    c[%u][0] = 1.0 / ", i->reciprocal);
    if (i->op == DAL__SQRT || i->op == DAL__HYPOT) dal__buffer_append(w->text, "(2.0 * ");
    write_coefficient(w, of_operation);
    dal__buffer_append(w->text, i->op == DAL__SQRT || i->op == DAL__HYPOT ? ");\n" : ";\n");
}

static void write_first(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    if (i->op == DAL__SINCOS) {
        dal__buffer_append(w->text, "    dal_sincos(");
        write_coefficient(w, i->a);
        dal__buffer_print(w->text, ", &c[%u][0], &c[%u][0]);\n", i->d, i->e);
        return;
    }
    dal__buffer_print(w->text, "    c[%u][0] = ", i->d);
    if (i->op == DAL__SLOPE)
        dal__buffer_append(w->text, "dal_num(0.0)");
    else
        dal__expression_write(i->op == DAL__POW_MOVING ? DAL__POW : (int)i->op, write_operand, w,
                              w->text);
    dal__buffer_append(w->text, ";\n");
    if (i->e != i->d) write_companion(w);
    if (i->reciprocal != i->d) write_reciprocal(w);
}

/* ---- order k ---- */

/* Inner sum j of the operation. */
static void write_inner(const writer *w, int j)
{
    dal__buffer_print(w->text, "s%u", w->operation->sum[j]);
}

/* (a b)_k, by inner sum j. */
static void write_product(const writer *w, int j, uint32_t a, uint32_t b)
{
    if (is_constant(a) || is_constant(b)) {
        const uint32_t constant = is_constant(b) ? b : a;
        write_coefficient(w, is_constant(b) ? a : b);
        dal__buffer_append(w->text, " * ");
        write_constant(w, constant);
        return;
    }
    if (a == b)
        dal__buffer_print(w->text, "dal_fma(c[%u][0] + c[%u][0], c[%u][k], ", a, a, a);
    else
        dal__buffer_print(w->text, "dal_fma(c[%u][k], c[%u][0], dal_fma(c[%u][k], c[%u][0], ", b, a,
                          a, b);
    write_inner(w, j);
    dal__buffer_append(w->text, a == b ? ")" : "))");
}

/* [a, g]_k, by inner sum j; `inverse` is 1/k. */
static void write_integral(const writer *w, int j, uint32_t a, uint32_t g)
{
    if (is_constant(a)) {
        dal__buffer_append(w->text, "dal_num(0.0)");
    } else if (is_constant(g)) {
        write_product(w, j, a, g);
    } else {
        dal__buffer_print(w->text, "inverse * dal_fma((double)k * c[%u][k], c[%u][0], ", a, g);
        write_inner(w, j);
        dal__buffer_append(w->text, ")");
    }
}

/* Sine and cosine, by their slots. */
static void write_rotation(const writer *w, uint32_t sine, uint32_t cosine, const char *sign)
{
    const dal__taylor_operation *i = w->operation;
    const int of_sine = sine == i->d ? 0 : 1;
    dal__buffer_print(w->text, "    c[%u][k] = ", sine);
    if (i->turns)
        dal__buffer_print(w->text, "inverse * c[%u][k - 1]", i->b);
    else
        write_integral(w, 1 - of_sine, i->a, cosine);
    dal__buffer_print(w->text, ";\n    c[%u][k] = %s", cosine, sign);
    if (i->turns)
        dal__buffer_print(w->text, "(inverse * c[%u][k - 1])", i->c);
    else
        write_integral(w, of_sine, i->a, sine);
    dal__buffer_append(w->text, ";\n");
}

/* The right side of u' w = g'. */
static void write_right_side(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    if (i->op != DAL__ATAN2) {
        dal__buffer_append(w->text, i->op == DAL__ACOS ? "-" : "");
        write_coefficient(w, i->a);
        return;
    }
    write_integral(w, 3, i->a, i->b);
    dal__buffer_append(w->text, " - ");
    write_integral(w, 4, i->b, i->a);
}

/* u_k where u' w = g'. */
static void write_quotient(const writer *w)
{
    dal__buffer_append(w->text, "(");
    write_right_side(w);
    dal__buffer_append(w->text, " - inverse * ");
    write_inner(w, 0);
    dal__buffer_print(w->text, ") * c[%u][0]", w->operation->reciprocal);
}

/* The functions with u' w = g', and w. */
static void write_inverse(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    dal__buffer_print(w->text, "    c[%u][k] = ", i->d);
    write_quotient(w);
    dal__buffer_print(w->text, ";\n    c[%u][k] = ", i->e);
    if (i->op == DAL__ATAN || i->op == DAL__ATAN2) {
        write_product(w, 1, i->a, i->a);
    } else {
        dal__buffer_append(w->text, i->op == DAL__ASIN ? "-(" : "(");
        write_integral(w, 1, i->d, i->a);
        dal__buffer_append(w->text, ")");
    }
    if (i->op == DAL__ATAN2) {
        dal__buffer_append(w->text, " + ");
        write_product(w, 2, i->b, i->b);
    }
    dal__buffer_append(w->text, ";\n");
}

static void write_pair(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    switch (i->op) {
    case DAL__SIN:
    case DAL__SINCOS:
        write_rotation(w, i->d, i->e, "-1.0 * ");
        return;
    case DAL__COS:
        write_rotation(w, i->e, i->d, "-1.0 * ");
        return;
    case DAL__SINH:
        write_rotation(w, i->d, i->e, "");
        return;
    case DAL__COSH:
        write_rotation(w, i->e, i->d, "");
        return;
    case DAL__TAN:
    case DAL__TANH:
        dal__buffer_print(w->text, "    c[%u][k] = ", i->d);
        write_coefficient(w, i->a);
        dal__buffer_append(w->text, i->op == DAL__TAN ? " + " : " - ");
        write_integral(w, 0, i->a, i->e);
        dal__buffer_print(w->text, ";\n    c[%u][k] = ", i->e);
        write_product(w, 1, i->d, i->d);
        dal__buffer_append(w->text, ";\n");
        return;
    default:
        write_inverse(w);
    }
}

/* Sums with a product in them. */
static void write_fused(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    if (i->op == DAL__SUB_MUL) {
        write_coefficient(w, i->c);
        dal__buffer_append(w->text, " - ");
    }
    write_product(w, 0, i->a, i->b);
    if (i->op == DAL__SUB_MUL) return;
    dal__buffer_append(w->text, i->op == DAL__MUL_ADD ? " + " : " - ");
    write_coefficient(w, i->c);
}

/* A right side, less an inner sum, by a reciprocal. */
static void write_division(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    if (i->op == DAL__DIV && is_constant(i->b)) {
        write_coefficient(w, i->a);
    } else {
        dal__buffer_append(w->text, "(");
        if (i->op == DAL__HYPOT) {
            write_product(w, 1, i->a, i->a);
            dal__buffer_append(w->text, " + ");
            write_product(w, 2, i->b, i->b);
        } else {
            write_coefficient(w, i->a);
        }
        dal__buffer_append(w->text, " - ");
        if (i->op == DAL__DIV)
            dal__buffer_print(w->text, "dal_fma(c[%u][k], c[%u][0], ", i->b, i->d);
        write_inner(w, 0);
        dal__buffer_append(w->text, i->op == DAL__DIV ? "))" : ")");
    }
    dal__buffer_print(w->text, " * c[%u][0]", i->reciprocal);
}

static void write_power(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    dal__buffer_append(w->text, "(");
    write_constant(w, i->b);
    dal__buffer_print(w->text, " * dal_fma((double)k * c[%u][k], c[%u][0], ", i->a, i->d);
    write_inner(w, 0);
    dal__buffer_append(w->text, ") - ");
    write_inner(w, 1);
    dal__buffer_print(w->text, ") * inverse * c[%u][0]", i->reciprocal);
}

/* The choice of a constant condition. */
static void write_choice(const writer *w)
{
    dal__buffer_append(w->text, "dal_if(");
    write_constant(w, w->operation->a);
    dal__buffer_append(w->text, ", ");
    write_coefficient(w, w->operation->b);
    dal__buffer_append(w->text, ", ");
    write_coefficient(w, w->operation->c);
    dal__buffer_append(w->text, ")");
}

/* The coefficient of an operation with one series. */
static void write_recurrence(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    switch (i->op) {
    case DAL__SLOPE:
        dal__buffer_print(w->text, "(double)k * c[%u][k]", i->a);
        return;
    case DAL__MUL:
        write_product(w, 0, i->a, i->b);
        return;
    case DAL__MUL_ADD:
    case DAL__MUL_SUB:
    case DAL__SUB_MUL:
        write_fused(w);
        return;
    case DAL__EXP:
        write_integral(w, 0, i->a, i->d);
        return;
    case DAL__POW_MOVING:
        write_integral(w, 0, i->c, i->d);
        return;
    case DAL__POW:
        write_power(w);
        return;
    case DAL__DIV:
    case DAL__SQRT:
    case DAL__HYPOT:
        write_division(w);
        return;
    case DAL__LOG:
        if (is_constant(i->a))
            dal__buffer_append(w->text, "dal_num(0.0)");
        else
            write_quotient(w);
        return;
    case DAL__IF:
        write_choice(w);
        return;
    default: /* a sum, a negative */
        dal__expression_write((int)i->op, write_operand, w, w->text);
    }
}

static void write_next(const writer *w)
{
    const dal__taylor_operation *i = w->operation;
    if (i->once) return;
    if (i->e != i->d) {
        write_pair(w);
        return;
    }
    dal__buffer_print(w->text, "    c[%u][k] = ", i->d);
    write_recurrence(w);
    dal__buffer_append(w->text, ";\n");
}

/* ---- inner sums ---- */

static bool is_square(const dal__taylor_sum *sum) { return sum->a == sum->b; }

/* Sums of products, or of squares, that are needed. */
static int count_sums(const dal__taylor *taylor, bool squares)
{
    int count = 0;
    for (int k = 0; k < taylor->sums; k++)
        count += taylor->sum[k].needed && is_square(&taylor->sum[k]) == squares;
    return count;
}

/* The same, rounded up to whole packs. */
static int count_packed(const dal__taylor *taylor, bool squares)
{
    return (count_sums(taylor, squares) + DAL__PACK - 1) / DAL__PACK * DAL__PACK;
}

int dal__taylor_packed(const dal__taylor *taylor)
{
    return 2 * count_packed(taylor, false) + count_packed(taylor, true);
}

/* Sums of lanes, each by itself. */
static void write_sums(const writer *w)
{
    for (int k = 0; k < w->taylor->sums; k++) {
        const dal__taylor_sum *sum = &w->taylor->sum[k];
        if (!sum->needed) continue;
        dal__buffer_print(w->text, "    const num s%d = dal_sum_%s(c[%u], ", k,
                          is_square(sum) ? "squares" : "products", sum->a);
        if (!is_square(sum)) dal__buffer_print(w->text, "c[%u], ", sum->b);
        dal__buffer_append(w->text, "k);\n");
    }
}

/* Sums of a single run, all interiors together.  To these the terms with order p = k - 1 are added;
 * for k <= 2 there are none, and p is the column of zeros. */
static void write_packed_sums(const writer *w)
{
    const int products = count_packed(w->taylor, false), squares = count_packed(w->taylor, true);
    int next[2] = {0, products};
    dal__buffer_print(w->text,
                      "    enum { products = %d, squares = %d };\n"
                      "    num sum[products + squares + 1];\n"
                      "    num *const r = l + products * (DAL_FIXED_TAYLOR_ORDER + 1),\n"
                      "        *const q = r + products * (DAL_FIXED_TAYLOR_ORDER + 1);\n"
                      "    const int p = k > 2 ? k - 1 : DAL_FIXED_TAYLOR_ORDER;\n"
                      "    (void)r, (void)q, (void)p;\n"
                      "    dal_product_interiors(l, r, products, k, sum);\n"
                      "    dal_square_interiors(q, squares, k, sum + products);\n",
                      products, squares);
    for (int k = 0; k < w->taylor->sums; k++) {
        const dal__taylor_sum *sum = &w->taylor->sum[k];
        const uint32_t a = sum->a, b = sum->b;
        if (!sum->needed) continue;
        if (is_square(sum))
            dal__buffer_print(w->text,
                              "    const num s%d = dal_fma(c[%u][1] + c[%u][1], c[%u][p], "
                              "sum[%d]);\n",
                              k, a, a, a, next[1]++);
        else
            dal__buffer_print(w->text,
                              "    const num s%d = dal_fma(c[%u][p], c[%u][1], dal_fma(c[%u][1], "
                              "c[%u][p], sum[%d]));\n",
                              k, a, b, a, b, next[0]++);
    }
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

void dal__taylor_write(const dal__taylor *taylor, const dal__tapes *tapes, bool first, bool packed,
                       dal__buffer *text)
{
    writer w = {.taylor = taylor, .tapes = tapes, .order = first ? "0" : "k", .text = text};
    if (!first) {
        dal__buffer_append(text, "    const num inverse = dal_inverse(k);\n"
                                 "    (void)inverse;\n");
        if (packed)
            write_packed_sums(&w);
        else
            write_sums(&w);
    }
    for (int n = 0; n < taylor->length; n++) {
        w.operation = &taylor->code[n];
        if (first)
            write_first(&w);
        else
            write_next(&w);
    }
    if (packed && first)
        dal__buffer_print(text,
                          "    for (int i = 0; i < %d; i++)\n"
                          "        c[i][1] = c[i][DAL_FIXED_TAYLOR_ORDER] = dal_num(0.0);\n",
                          taylor->slots);
    else if (packed)
        write_operands(&w);
}

void dal__taylor_write_output(const dal__taylor *taylor, const dal__tapes *tapes, int output,
                              bool first, dal__buffer *text)
{
    const writer w = {.tapes = tapes, .order = first ? "0" : "k", .text = text};
    write_coefficient(&w, taylor->output[output]);
}
