/* forms.c - an invariant as a formula.
 *
 * Of a row of the null space in echelon form the products with a coefficient are solved for again,
 * by least squares at points of their own, with the parameters p as they are and with others.  Then
 * one of the terms is found, by which all coefficients divided are
 *
 *     r p^e    or    r p^e + s p^f
 *
 * with fractions r, s (continued fractions) and small whole exponents.  The row is multiplied by
 * the common denominator and by the powers of parameters in it, so that numbers are whole.  Where
 * no such term is found the coefficients are numbers, for these parameters. */
#include "invariants/forms.h"
#include "core/buffer.h"
#include "core/vectors.h"
#include "invariants/null_space.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Factors by which parameters differ; instead of one that is 0. */
static const double scale = 1.25, instead_of_zero = 0.375;
/* Fractions of |c| that are roundings; and where parameters differ. */
static const double fraction_tolerance = 1e-10, fit_tolerance = 1e-9;
enum {
    MAX_DENOMINATOR = 1000,
    MAX_COMMON = 100000,
    SETS = 7,         /* of parameters, the given one first */
    MAX_EXPONENT = 2, /* of a parameter in a coefficient */
    MAX_FITTED = 4,   /* parameters in a sum, */
    MAX_SINGLE = 6,   /* or in one product */
    SUMMANDS = 2      /* in a coefficient */
};

/* A coefficient: a sum of one or two numbers times powers of parameters. */
typedef struct coefficient {
    int summands;
    double number[SUMMANDS];
    long long numerator[SUMMANDS], divisor[SUMMANDS]; /* fractions; divisor 0: the number is none */
    int *exponent[SUMMANDS];                          /* [parameters] */
} coefficient;

/* The terms of a form. */
typedef struct terms {
    const dal__search *search;
    const dal__condition *condition;
    int count, parameters;
    int *product;       /* [count] */
    double *value;      /* [SETS*count] coefficients with each set of parameters, */
    double *parameter;  /* [SETS*parameters] and these sets */
    int *relevant;      /* [fitted] parameters that change a coefficient */
    int fitted;         /* how many */
    int *exponents;     /* [SUMMANDS*count*parameters] of the coefficients */
    coefficient *whole; /* [count] */
} terms;

static dal_status make_terms(terms *t, const double *row)
{
    const int products = t->search->products;
    for (int k = 0; k < products; k++) t->count += row[k] != 0.0;
    t->parameters = t->search->model->equations.parameters;
    const size_t n = (size_t)t->count + 1, p = (size_t)t->parameters + 1;
    t->product = calloc(n, sizeof *t->product);
    t->value = dal__numbers(SETS, n + p);
    t->relevant = calloc(p, sizeof *t->relevant);
    t->exponents = calloc(SUMMANDS * n * p, sizeof *t->exponents);
    t->whole = calloc(n, sizeof *t->whole);
    if (!t->product || !t->value || !t->relevant || !t->exponents || !t->whole)
        return DAL_STATUS_MEMORY;
    t->parameter = t->value + SETS * n;
    for (int k = 0, i = 0; k < products; k++)
        if (row[k] != 0.0) t->product[i++] = k;
    for (int k = 0; k < t->count; k++)
        for (int i = 0; i < SUMMANDS; i++)
            t->whole[k].exponent[i] = t->exponents + (SUMMANDS * k + i) * t->parameters;
    return DAL_STATUS_OK;
}

/* ---- coefficients -------------------------------------------------------------------------- */

/* Rates of the terms at the points, each relative to its maximum: those but the first in a, minus
 * the first in right. */
static void fill_equations(const terms *t, const dal__samples *samples, double *a, double *right,
                           double *size)
{
    const int unknown = t->count - 1;
    for (int k = 0; k < t->count; k++) {
        const double *rate = samples->rate + (size_t)t->product[k] * (size_t)samples->points;
        const double max = dal__max_abs(rate, (size_t)samples->points);
        size[k] = max > 0.0 ? max : 1.0;
        for (int i = 0; i < samples->points; i++) {
            if (k == 0)
                right[i] = -rate[i] / size[0];
            else
                a[i * unknown + k - 1] = rate[i] / size[k];
        }
    }
}

/* Solves for the coefficients with a set of parameters, the first being 1; *found: they exist.  A
 * product alone has no other; whether it is constant dal__confirm decides. */
static dal_status solve_terms(const terms *t, const double *parameter, double *out, bool *found)
{
    static const double residue = 1e-9, rank = 1e-9;
    const int unknown = t->count - 1, points = 3 * t->count + 8;
    const size_t n = (size_t)t->count, rows = (size_t)points;
    dal__samples samples;
    out[0] = 1.0;
    *found = unknown == 0;
    if (*found) return DAL_STATUS_OK;
    DAL_TRY(dal__search_sample(t->search, t->condition, parameter, points, &samples));
    double *a = dal__numbers(1, rows * n + rows + n + n * (n + 2));
    if (a) {
        double *right = a + rows * n, *size = right + rows, *work = size + n;
        fill_equations(t, &samples, a, right, size);
        *found =
            dal__least_squares(points, unknown, a, right, out + 1, rank, NULL, work) == unknown &&
            dal__max_abs(right, rows) <= residue;
        for (int k = 1; k < t->count; k++) out[k] *= size[0] / size[k];
    }
    dal__samples_free(&samples);
    free(a);
    return a ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
}

/* The same with other parameters: where F has no values there, the coefficients do not exist. */
static dal_status solve_elsewhere(const terms *t, int set, bool *found)
{
    const dal_status status =
        solve_terms(t, t->parameter + set * t->parameters, t->value + set * t->count, found);
    return status == DAL_STATUS_NOT_FINITE ? DAL_STATUS_OK : status;
}

/* Finds which parameters change a coefficient; set 1 is scratch. *found: all are known. */
static dal_status find_relevant(terms *t, bool *found)
{
    double *const other = t->parameter + t->parameters;
    const double *given = t->value, *changed = t->value + t->count;
    *found = true;
    for (int j = 0; j < t->parameters && t->count > 1; j++) {
        bool exists, changes = false;
        if (t->search->parameter[j] == 0.0) continue;
        memcpy(other, t->search->parameter, (size_t)t->parameters * sizeof *other);
        other[j] *= scale;
        DAL_TRY(solve_elsewhere(t, 1, &exists));
        *found = *found && exists;
        for (int k = 1; k < t->count; k++)
            changes = changes || fabs(changed[k] - given[k]) > fit_tolerance * fabs(given[k]);
        if (exists && changes) t->relevant[t->fitted++] = j;
    }
    return DAL_STATUS_OK;
}

/* ---- fractions ----------------------------------------------------------------------------- */

/* x as numerator/divisor; divisor 0 where it is no fraction of small numbers. */
static void find_fraction(double x, long long *numerator, long long *divisor)
{
    long long p[2] = {0, 1}, q[2] = {1, 0};
    double rest = fabs(x);
    *numerator = *divisor = 0;
    for (int k = 0; k < 20 && rest < 1e9; k++) {
        const long long whole = (long long)floor(rest);
        const long long next[2] = {whole * p[1] + p[0], whole * q[1] + q[0]};
        p[0] = p[1], p[1] = next[0];
        q[0] = q[1], q[1] = next[1];
        if (q[1] > MAX_DENOMINATOR) return;
        if (fabs((double)p[1] / (double)q[1] - fabs(x)) <= fraction_tolerance * fabs(x)) {
            *numerator = x < 0.0 ? -p[1] : p[1];
            *divisor = q[1];
            return;
        }
        rest = 1.0 / (rest - (double)whole);
    }
}

static long long common_divisor(long long a, long long b)
{
    while (b != 0) {
        const long long rest = a % b;
        a = b;
        b = rest;
    }
    return llabs(a);
}

static void set_summand(coefficient *c, int i, double number)
{
    c->number[i] = number;
    find_fraction(number, &c->numerator[i], &c->divisor[i]);
    c->summands = i + 1;
}

/* ---- powers of parameters ------------------------------------------------------------------ */

/* All products of small powers of the parameters that matter, with each set of parameters. */
typedef struct powers {
    int count;
    double *value; /* [count*SETS] */
} powers;

/* The exponent of the i-th of these parameters in product m. */
static int exponent_of(int m, int i)
{
    while (i-- > 0) m /= 2 * MAX_EXPONENT + 1;
    return m % (2 * MAX_EXPONENT + 1) - MAX_EXPONENT;
}

static bool make_powers(const terms *t, powers *p)
{
    p->count = 1;
    for (int i = 0; i < t->fitted; i++) p->count *= 2 * MAX_EXPONENT + 1;
    p->value = dal__numbers((size_t)p->count, SETS);
    for (int m = 0; p->value && m < p->count; m++)
        for (int set = 0; set < SETS; set++) {
            double *const value = &p->value[m * SETS + set];
            *value = 1.0;
            for (int i = 0; i < t->fitted; i++)
                *value *=
                    pow(t->parameter[set * t->parameters + t->relevant[i]], exponent_of(m, i));
        }
    return p->value != NULL;
}

static void set_exponents(const terms *t, int *exponent, int m)
{
    for (int i = 0; i < t->fitted; i++) exponent[t->relevant[i]] = exponent_of(m, i);
}

/* Whether x[SETS] = r p^e. */
static bool fit_product(const terms *t, const powers *p, const double *x, coefficient *c)
{
    for (int m = 0; m < p->count; m++) {
        const double *a = p->value + m * SETS, r = x[0] / a[0];
        int set = 1;
        while (set < SETS && fabs(r * a[set] - x[set]) <= fit_tolerance * fabs(x[set])) set++;
        if (set < SETS) continue;
        set_summand(c, 0, r);
        set_exponents(t, c->exponent[0], m);
        return true;
    }
    return false;
}

/* Whether x[SETS] = r p^e + s p^f. */
static bool fit_sum(const terms *t, const powers *p, const double *x, coefficient *c)
{
    for (int m = 0; m < p->count; m++)
        for (int n = 0; n < m; n++) {
            const double *a = p->value + m * SETS, *b = p->value + n * SETS;
            const double det = a[0] * b[1] - a[1] * b[0];
            const double r = (x[0] * b[1] - x[1] * b[0]) / det;
            const double s = (a[0] * x[1] - a[1] * x[0]) / det;
            int set = 2;
            while (set < SETS &&
                   fabs(r * a[set] + s * b[set] - x[set]) <= fit_tolerance * fabs(x[set]))
                set++;
            if (set < SETS) continue;
            set_summand(c, 0, r);
            set_summand(c, 1, s);
            if (c->divisor[0] == 0 || c->divisor[1] == 0) continue;
            set_exponents(t, c->exponent[0], m);
            set_exponents(t, c->exponent[1], n);
            return true;
        }
    return false;
}

/* Whether all coefficients are so, divided by one of them. */
static bool fit_all(const terms *t, const powers *p, int by)
{
    for (int k = 0; k < t->count; k++) {
        double x[SETS];
        for (int set = 0; set < SETS; set++)
            x[set] = t->value[set * t->count + k] / t->value[set * t->count + by];
        if (!fit_product(t, p, x, &t->whole[k]) &&
            !(t->fitted <= MAX_FITTED && fit_sum(t, p, x, &t->whole[k])))
            return false;
    }
    return true;
}

/* The coefficients as formulas in the parameters; *known: they are. */
static dal_status find_powers(terms *t, bool *known)
{
    powers p = {.count = 0};
    bool fitted = false;
    DAL_TRY(find_relevant(t, known));
    if (t->fitted > 0 && t->fitted <= MAX_SINGLE) {
        dal__random random = {5};
        bool found = true;
        for (int set = 1; set < SETS && found; set++) {
            double *const other = t->parameter + set * t->parameters;
            memcpy(other, t->search->parameter, (size_t)t->parameters * sizeof *other);
            for (int i = 0; i < t->fitted; i++)
                other[t->relevant[i]] *= 1.0 + 0.4 * dal__uniform(&random);
            DAL_TRY(solve_elsewhere(t, set, &found));
        }
        if (found && !make_powers(t, &p)) return DAL_STATUS_MEMORY;
        for (int by = 0; by < t->count && found && !fitted; by++) fitted = fit_all(t, &p, by);
        free(p.value);
    }
    if (fitted) return DAL_STATUS_OK;
    *known = *known && t->fitted == 0;
    memset(t->exponents, 0,
           SUMMANDS * (size_t)t->count * (size_t)t->parameters * sizeof *t->exponents);
    for (int k = 0; k < t->count; k++) set_summand(&t->whole[k], 0, t->value[k]);
    return DAL_STATUS_OK;
}

/* Makes numbers whole and exponents positive. */
static void clear_denominators(terms *t)
{
    long long common = 1, factor = 0;
    for (int k = 0; k < SUMMANDS * t->count; k++) {
        const coefficient *c = &t->whole[k / SUMMANDS];
        const int i = k % SUMMANDS;
        if (i < c->summands && c->divisor[i] > 0 && common <= MAX_COMMON)
            common *= c->divisor[i] / common_divisor(common, c->divisor[i]);
    }
    if (common > MAX_COMMON) common = 1;
    for (int k = 0; k < SUMMANDS * t->count; k++) {
        coefficient *c = &t->whole[k / SUMMANDS];
        const int i = k % SUMMANDS;
        if (i >= c->summands) continue;
        const bool is_whole = c->divisor[i] > 0 && common % c->divisor[i] == 0;
        c->number[i] *= (double)common;
        c->numerator[i] = is_whole ? c->numerator[i] * (common / c->divisor[i]) : 0;
        c->divisor[i] = is_whole;
        factor = is_whole ? common_divisor(factor, c->numerator[i]) : 1;
    }
    for (int k = 0; k < t->count && factor > 1; k++)
        for (int i = 0; i < t->whole[k].summands; i++) t->whole[k].numerator[i] /= factor;
    for (int j = 0; j < t->parameters; j++) {
        int least = t->whole[0].exponent[0][j];
        for (int k = 0; k < t->count; k++)
            for (int i = 0; i < t->whole[k].summands; i++)
                least = t->whole[k].exponent[i][j] < least ? t->whole[k].exponent[i][j] : least;
        for (int k = 0; k < t->count; k++)
            for (int i = 0; i < t->whole[k].summands; i++) t->whole[k].exponent[i][j] -= least;
    }
}

/* ---- text ---------------------------------------------------------------------------------- */

static void put_factor(dal__buffer *out, bool *is_first, const char *name, int power)
{
    if (power == 0) return;
    dal__buffer_append(out, *is_first ? "" : "*");
    dal__buffer_append(out, name);
    if (power > 1) dal__buffer_print(out, "^%d", power);
    *is_first = false;
}

static void put_product(dal__buffer *out, const dal__search *s, int product, bool *is_first)
{
    int power[DAL__MAX_DEGREE] = {0}, factor[DAL__MAX_DEGREE], factors = 0;
    for (int k = product; k > 0; k = s->product[k].parent) {
        if (factors == 0 || factor[factors - 1] != s->product[k].last)
            factor[factors++] = s->product[k].last;
        power[factors - 1]++;
    }
    while (factors-- > 0) put_factor(out, is_first, s->atom[factor[factors]].text, power[factors]);
}

static bool is_summand_negative(const coefficient *c, int i)
{
    return c->divisor[i] == 1 ? c->numerator[i] < 0 : c->number[i] < 0.0;
}

/* A summand of a coefficient without its sign, before a product (0: before nothing); 1 is left out
 * where a factor follows. */
static void put_summand(dal__buffer *out, const terms *t, const coefficient *c, int i, int product,
                        bool *is_first)
{
    bool has_factor = product > 0;
    for (int j = 0; j < t->parameters; j++) has_factor = has_factor || c->exponent[i][j] > 0;
    if (c->divisor[i] != 1) {
        char number[DAL__NUMBER_SIZE];
        dal__format_number(number, fabs(c->number[i]));
        put_factor(out, is_first, number, 1);
    } else if (llabs(c->numerator[i]) != 1 || !has_factor) {
        dal__buffer_print(out, "%lld", llabs(c->numerator[i]));
        *is_first = false;
    }
    for (int j = 0; j < t->parameters; j++)
        put_factor(out, is_first, t->search->model->equations.parameter[j], c->exponent[i][j]);
}

static void put_term(dal__buffer *out, const terms *t, int k)
{
    const coefficient *c = &t->whole[k];
    const bool is_negative = is_summand_negative(c, 0);
    bool is_first = true;
    dal__buffer_append(out, k == 0 ? (is_negative ? "-" : "") : is_negative ? " - " : " + ");
    if (c->summands == 1) {
        put_summand(out, t, c, 0, t->product[k], &is_first);
    } else {
        bool is_first_there = true;
        dal__buffer_append(out, "(");
        put_summand(out, t, c, 0, 0, &is_first_there);
        is_first_there = true;
        dal__buffer_append(out, is_summand_negative(c, 1) == is_negative ? " + " : " - ");
        put_summand(out, t, c, 1, 0, &is_first_there);
        dal__buffer_append(out, ")");
        is_first = false;
    }
    put_product(out, t->search, t->product[k], &is_first);
}

dal_status dal__write_form(const dal__search *search, const dal__condition *condition,
                           const double *row, dal__row_form *form)
{
    terms t = {.search = search, .condition = condition};
    dal__buffer out = {0};
    bool found = false;
    *form = (dal__row_form){.text = NULL};
    dal_status status = make_terms(&t, row);
    if (status == DAL_STATUS_OK) {
        memcpy(t.parameter, search->parameter, (size_t)t.parameters * sizeof *t.parameter);
        status = solve_terms(&t, search->parameter, t.value, &found);
    }
    if (status == DAL_STATUS_OK && found) status = find_powers(&t, &form->may_hold_for_any);
    if (status == DAL_STATUS_OK && found) {
        clear_denominators(&t);
        for (int k = 0; k < t.count; k++) put_term(&out, &t, k);
        if (out.out_of_memory) status = DAL_STATUS_MEMORY;
        form->text = out.bytes;
        form->terms = t.count;
        for (int k = t.product[t.count - 1]; k > 0; k = search->product[k].parent) form->degree++;
    }
    free(t.product);
    free(t.value);
    free(t.relevant);
    free(t.exponents);
    free(t.whole);
    return status;
}

void dal__other_parameters(const dal__equations *e, const double *parameter, double *other)
{
    for (int j = 0; j < e->parameters; j++)
        other[j] =
            parameter[j] == 0.0 ? instead_of_zero : parameter[j] * (scale + 0.0625 * (j % 5));
}
