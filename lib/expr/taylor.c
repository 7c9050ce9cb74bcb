/* taylor.c - series programs from tapes: every result of a tape becomes a series of its own. */
#include "expr/taylor.h"
#include "expr/operations.h"
#include "expr/traversal.h"
#include <stdlib.h>
#include <string.h>

/* What one operation of a tape adds at most. */
enum { MAX_OPERATIONS = 5, MAX_SLOTS = 8, MAX_SUMS = 5 };

dal__taylor *dal__taylor_create(int inputs, int coordinates)
{
    dal__taylor *taylor = calloc(1, sizeof *taylor);
    if (!taylor) return NULL;
    taylor->inputs = taylor->slots = inputs;
    taylor->coordinates = coordinates;
    taylor->kept = malloc((size_t)inputs * sizeof *taylor->kept);
    if (!taylor->kept) {
        free(taylor);
        return NULL;
    }
    for (int i = 0; i < inputs; i++) taylor->kept[i] = true;
    return taylor;
}

void dal__taylor_free(dal__taylor *taylor)
{
    if (!taylor) return;
    free(taylor->code);
    free(taylor->sum);
    free(taylor->output);
    free(taylor->kept);
    free(taylor);
}

/* The name in a formula of an operation that has no Taylor series where it jumps or has a kink;
 * else NULL.  (hypot has none at 0 alone, where coefficients are not finite; if has one where its
 * condition is constant along a run.) */
static const char *refused_name(const dal__taylor_operation *i)
{
    const uint32_t op = i->op;
    int arity;
    if (op == DAL__LESS || op == DAL__LESS_EQUAL || op == DAL__EQUAL) return "a comparison";
    if (op == DAL__IF && dal__is_constant(i->a)) return NULL;
    if (op == DAL__TABLE) return "a table";
    if (op == DAL__HYPOT || op >= DAL__OP_COUNT) return NULL;
    if (!((DAL__ROUGH) >> op & 1)) return NULL;
    return dal__function_name((dal__op)op, &arity);
}

/* Series of an operation: operands and results, or their slopes. */
enum { NONE, A, B, C, U, W, SLOPES, SLOPE_A = SLOPES + A, SLOPE_B, SLOPE_C, SLOPE_U };

/* What the recurrences need: pairs of series for inner sums, a second series, a reciprocal. */
static const struct {
    uint8_t pair[DAL__TAYLOR_SUMS][2];
    bool has_pair, divides;
} recurrences[DAL__RECURRENCES] = {
#define SUMS(...)                                                                                  \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }
#define NO_SUMS                                 SUMS({NONE, NONE})
#define PLAIN(code, sums, u)                    [DAL__##code] = {sums, false, false},
#define QUOTIENT(code, sums, divisor, u)        [DAL__##code] = {sums, false, true},
#define PAIR(code, sums, second, u, w)          [DAL__##code] = {sums, true, false},
#define PAIR_QUOTIENT(code, sums, second, u, w) [DAL__##code] = {sums, true, true},
    DAL__RECURRENCE_LIST(PLAIN, QUOTIENT, PAIR, PAIR_QUOTIENT)
#undef SUMS
#undef NO_SUMS
#undef PLAIN
#undef QUOTIENT
#undef PAIR
#undef PAIR_QUOTIENT
};

/* What is known while a tape is converted. */
typedef struct conversion {
    dal__taylor *taylor;
    int first;        /* number of the first operation of this tape */
    uint32_t *slot;   /* [workspace] the operand that is in a place of work now */
    uint32_t *depth;  /* [slots] operations of the same order that must precede the series' own */
    uint32_t *latest; /* [slots] 1 + number of the last sum of it with an earlier slot, or 0 */
    uint32_t *turn;   /* [slots] of a coordinate's sine or cosine: 1 + number of its operation */
} conversion;

static dal__taylor_operation *append_operation(const conversion *c, dal__taylor_operation own)
{
    dal__taylor *taylor = c->taylor;
    const uint32_t operand[] = {own.a, own.b, own.c};
    uint32_t depth = 0;
    own.u = own.w = own.reciprocal = (uint32_t)taylor->slots++;
    if (recurrences[own.recurrence].has_pair) own.w = (uint32_t)taylor->slots++;
    if (recurrences[own.recurrence].divides) own.reciprocal = (uint32_t)taylor->slots++;
    for (int i = 0; i < 3; i++)
        if (!dal__is_constant(operand[i]) && c->depth[operand[i]] >= depth)
            depth = c->depth[operand[i]] + 1;
    c->depth[own.u] = c->depth[own.w] = depth;
    taylor->code[taylor->length] = own;
    return &taylor->code[taylor->length++];
}

/* An operation of order 0 and its recurrence. */
static dal__taylor_operation make_operation(uint32_t op, uint32_t a, uint32_t b)
{
    const uint32_t recurrence = op == DAL__LOG && dal__is_constant(a)   ? DAL__LOG_CONSTANT
                                : op == DAL__DIV && dal__is_constant(b) ? DAL__DIV_CONSTANT
                                                                        : op;
    return (dal__taylor_operation){.op = op, .recurrence = recurrence, .a = a, .b = b};
}

/* The slot of j a_j. */
static uint32_t slope(const conversion *c, uint32_t a)
{
    const dal__taylor *taylor = c->taylor;
    for (int k = c->first; k < taylor->length; k++)
        if (taylor->code[k].op == DAL__SLOPE && taylor->code[k].a == a) return taylor->code[k].u;
    return append_operation(c, make_operation(DAL__SLOPE, a, a))->u;
}

/* The number of the inner sum of a and b; DAL__TAYLOR_CONSTANT where one of them is constant along
 * a run, so that no sum is needed. */
static uint32_t find_sum(const conversion *c, uint32_t a, uint32_t b)
{
    dal__taylor *taylor = c->taylor;
    if (dal__is_constant(a) || dal__is_constant(b)) return DAL__TAYLOR_CONSTANT;
    uint32_t *const latest = &c->latest[a > b ? a : b];
    for (uint32_t k = *latest; k > 0; k = taylor->sum[k - 1].next) {
        const dal__taylor_sum *sum = &taylor->sum[k - 1];
        if ((sum->a == a && sum->b == b) || (sum->a == b && sum->b == a)) return k - 1;
    }
    taylor->sum[taylor->sums] = (dal__taylor_sum){.a = a, .b = b, .next = *latest};
    *latest = (uint32_t)++taylor->sums;
    return *latest - 1;
}

/* One of the series of an operation, or a constant: for NONE, and for the slope of a constant. */
static uint32_t series_of(const conversion *c, const dal__taylor_operation *i, int which)
{
    const uint32_t of[] = {DAL__TAYLOR_CONSTANT, i->a, i->b, i->c, i->u, i->w};
    const uint32_t slot = of[which % SLOPES];
    return which < SLOPES || dal__is_constant(slot) ? slot : slope(c, slot);
}

/* Appends an operation and the sums that it needs; slopes of operands come before it, slopes of its
 * results after it. */
static dal__taylor_operation *append_recurrence(const conversion *c, dal__taylor_operation own)
{
    const uint8_t(*pair)[2] = recurrences[own.recurrence].pair;
    for (int j = 0; j < DAL__TAYLOR_SUMS; j++)
        if (pair[j][0] < SLOPE_U) series_of(c, &own, pair[j][0]);
    dal__taylor_operation *i = append_operation(c, own);
    for (int j = 0; j < DAL__TAYLOR_SUMS && pair[j][0]; j++)
        i->sum[i->sums++] = find_sum(c, series_of(c, i, pair[j][0]), series_of(c, i, pair[j][1]));
    return i;
}

/* Sine and cosine of a coordinate, whose derivative is an input: s' = c a', c' = -s a'. */
static dal__taylor_operation *append_turn(const conversion *c, dal__taylor_operation own)
{
    const uint32_t rate = own.a + (uint32_t)c->taylor->coordinates;
    own.recurrence = own.op == DAL__SIN   ? DAL__SIN_TURN
                     : own.op == DAL__COS ? DAL__COS_TURN
                                          : DAL__SINCOS_TURN;
    dal__taylor_operation *i = append_operation(c, own);
    const uint32_t sine = i->op == DAL__COS ? i->w : i->u, cosine = i->op == DAL__COS ? i->u : i->w;
    c->depth[sine] = c->depth[cosine] = 0;
    c->turn[sine] = c->turn[cosine] = (uint32_t)c->taylor->length;
    i->b = append_recurrence(c, make_operation(DAL__MUL, rate, cosine))->u;
    i->c = append_recurrence(c, make_operation(DAL__MUL, rate, sine))->u;
    return i;
}

/* Whether append_turn has made a b, a sine or cosine of a coordinate times its derivative; *product
 * is the slot. */
static bool find_turn(const conversion *c, uint32_t a, uint32_t b, uint32_t *product)
{
    const uint32_t turn = dal__is_constant(a) ? 0 : c->turn[a];
    if (turn == 0) return false;
    const dal__taylor_operation *i = &c->taylor->code[turn - 1];
    if (b != i->a + (uint32_t)c->taylor->coordinates) return false;
    *product = (a == i->u) == (i->op == DAL__COS) ? i->b : i->c;
    return true;
}

/* Whether if(a, b, ..) is a derivative of r = hypot, as if(r == 0, 0, x/r), of which x/r has a
 * series where r has. */
static bool is_slope_of_hypot(const conversion *c, uint32_t a, uint32_t b)
{
    const dal__taylor_operation *code = c->taylor->code, *equal = NULL;
    bool root = false, divides = false;
    for (int k = c->first; k < c->taylor->length; k++)
        if (code[k].op == DAL__EQUAL && code[k].u == a) equal = &code[k];
    for (int k = c->first; k < c->taylor->length && equal; k++) {
        const uint32_t r = code[k].op == DAL__HYPOT ? code[k].u : code[k].b;
        if (r != equal->a && r != equal->b) continue;
        root = root || code[k].op == DAL__HYPOT;
        divides = divides || code[k].op == DAL__DIV;
    }
    return dal__is_constant(b) && root && divides;
}

/* a^b = exp(b log a), of an exponent that moves. */
static dal__taylor_operation make_moving_power(const conversion *c, dal__taylor_operation own)
{
    const uint32_t log = append_recurrence(c, make_operation(DAL__LOG, own.a, own.a))->u;
    own.c = append_recurrence(c, make_operation(DAL__MUL, own.b, log))->u;
    own.recurrence = DAL__POW_MOVING;
    return own;
}

/* The operation whose result is a slot; NULL: it is an input, or of another tape. */
static const dal__taylor_operation *operation_of(const conversion *c, uint32_t slot)
{
    const dal__taylor_operation *code = c->taylor->code;
    for (int k = c->taylor->length - 1; k >= c->first && !dal__is_constant(slot); k--)
        if (code[k].u == slot) return &code[k];
    return NULL;
}

/* Makes a/(x sqrt x) with a constant a, in order 0 as it is, the power -3/2 of x in others: one
 * recurrence of two sums for three. */
static void make_power(const conversion *c, dal__taylor_operation *own)
{
    if (!dal__is_constant(own->a)) return;
    const dal__taylor_operation *product = operation_of(c, own->b);
    if (!product || product->op != DAL__MUL) return;
    const uint32_t factor[] = {product->a, product->b};
    for (int i = 0; i < 2; i++) {
        const dal__taylor_operation *root = operation_of(c, factor[i]);
        if (!root || root->op != DAL__SQRT || root->a != factor[1 - i]) continue;
        own->recurrence = DAL__OVER_ROOT_CUBED;
        own->c = factor[1 - i];
    }
}

/* Converts one instruction.  That operand of a product which is known later becomes the second,
 * whose coefficient k the recurrence uses last. */
static void convert(const conversion *c, const dal__instruction *i)
{
    uint32_t *slot = c->slot, a = slot[i->a], b = slot[i->b];
    dal__taylor_operation own = make_operation(i->op, a, b);
    own.c = slot[i->c];
    const bool product = i->op == DAL__MUL || i->op == DAL__MUL_ADD || i->op == DAL__MUL_SUB ||
                         i->op == DAL__SUB_MUL;
    const bool angle = i->op == DAL__SIN || i->op == DAL__COS || i->op == DAL__SINCOS;
    if (i->op == DAL__MUL && (find_turn(c, a, b, &slot[i->d]) || find_turn(c, b, a, &slot[i->d])))
        return;
    if (i->op == DAL__IF && is_slope_of_hypot(c, a, b)) {
        slot[i->d] = own.c;
        return;
    }
    if (product && !dal__is_constant(a) && !dal__is_constant(b) && c->depth[a] > c->depth[b])
        own.a = b, own.b = a;
    if (i->op == DAL__POW && !dal__is_constant(b)) own = make_moving_power(c, own);
    if (i->op == DAL__DIV) make_power(c, &own);
    if (i->op == DAL__SINCOS) own.b = a; /* where the tape has the place of the cosine */
    const bool turns = angle && a >= 1 && a <= (uint32_t)c->taylor->coordinates;
    const dal__taylor_operation *last = turns ? append_turn(c, own) : append_recurrence(c, own);
    slot[i->d] = last->u;
    if (i->op == DAL__SINCOS) slot[i->b] = last->w;
}

/* Finds whether an operation is needed beyond order 0, and with it operands and sums;
 * needed[slots]. */
static void find_orders(dal__taylor *taylor, dal__taylor_operation *i, bool *needed)
{
    const bool cubed = i->recurrence == DAL__OVER_ROOT_CUBED; /* of which b is of order 0 alone */
    const uint32_t operand[] = {i->a, cubed ? i->c : i->b, i->c};
    i->once = !needed[i->u] && !needed[i->w];
    if (i->once) return;
    const char *name = refused_name(i);
    if (name && !taylor->refused) taylor->refused = name;
    for (int j = 0; j < 3; j++)
        if (!dal__is_constant(operand[j])) needed[operand[j]] = true;
    for (int j = 0; j < i->sums; j++) {
        if (dal__is_constant(i->sum[j])) continue;
        dal__taylor_sum *sum = &taylor->sum[i->sum[j]];
        sum->needed = needed[sum->a] = needed[sum->b] = true;
        taylor->kept[sum->a] = taylor->kept[sum->b] = true;
    }
    if (i->recurrence >= DAL__SIN_TURN) taylor->kept[i->b] = taylor->kept[i->c] = true;
}

/* slots: as many as there may be. */
static bool reserve(dal__taylor *taylor, const dal__tape *tape, size_t slots)
{
    const size_t operations = MAX_OPERATIONS * (size_t)tape->length + 1;
    const size_t outputs = (size_t)taylor->outputs + (size_t)tape->outputs + 1;
    dal__taylor_operation *code =
        realloc(taylor->code, ((size_t)taylor->length + operations) * sizeof *code);
    if (code) taylor->code = code;
    dal__taylor_sum *sum = realloc(
        taylor->sum, ((size_t)taylor->sums + MAX_SUMS * (size_t)tape->length + 1) * sizeof *sum);
    if (sum) taylor->sum = sum;
    uint32_t *output = realloc(taylor->output, outputs * sizeof *output);
    if (output) taylor->output = output;
    bool *kept = realloc(taylor->kept, slots * sizeof *kept);
    if (kept) taylor->kept = kept;
    if (kept) memset(kept + taylor->slots, 0, (slots - (size_t)taylor->slots) * sizeof *kept);
    return code && sum && output && kept;
}

/* Converts a tape; needed[slots] is false everywhere. */
static void convert_tape(const conversion *c, const dal__tape *tape, int count, bool *needed)
{
    dal__taylor *taylor = c->taylor;
    for (int k = 0; k < tape->length; k++) convert(c, &tape->code[k]);
    for (int k = 0; k < tape->outputs; k++) {
        const uint32_t output = c->slot[tape->place[k]];
        if (k < count && !dal__is_constant(output)) needed[output] = true;
        taylor->output[taylor->outputs++] = output;
    }
    /* Some operations need slopes or products that come after them, found in the second pass. */
    for (int pass = 0; pass < 2; pass++)
        for (int k = taylor->length - 1; k >= c->first; k--)
            find_orders(taylor, &taylor->code[k], needed);
}

dal_status dal__taylor_add(dal__taylor *taylor, const dal__tapes *tapes, int program, int count,
                           const uint32_t *places)
{
    const dal__tape *tape = &tapes->tape[program];
    const size_t slots = (size_t)taylor->slots + MAX_SLOTS * (size_t)tape->length + 1;
    const conversion c = {.taylor = taylor,
                          .first = taylor->length,
                          .slot = calloc(tapes->workspace + 1, sizeof *c.slot),
                          .depth = calloc(slots, sizeof *c.depth),
                          .latest = calloc(slots, sizeof *c.latest),
                          .turn = calloc(slots, sizeof *c.turn)};
    bool *needed = calloc(slots, sizeof *needed);
    const bool good =
        c.slot && c.depth && c.latest && c.turn && needed && reserve(taylor, tape, slots);
    if (good) {
        for (size_t i = 0; i < tapes->first_input; i++)
            c.slot[i] = DAL__TAYLOR_CONSTANT | (uint32_t)i;
        for (int k = 0; k < taylor->sums; k++) {
            const dal__taylor_sum *sum = &taylor->sum[k];
            c.latest[sum->a > sum->b ? sum->a : sum->b] = (uint32_t)k + 1;
        }
        for (int i = 0; i < taylor->inputs; i++) c.slot[places[i]] = (uint32_t)i;
        convert_tape(&c, tape, count, needed);
    }
    free(c.slot);
    free(c.depth);
    free(c.latest);
    free(c.turn);
    free(needed);
    return good ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
}
