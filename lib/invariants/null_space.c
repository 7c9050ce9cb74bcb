/* null_space.c - the functions whose rate along the motion is 0.
 *
 *     f_k(x_i) = Q R,    w = (f_k' + power f_k tr F_v)(x_i) R^-1,    w V = U S
 *
 * Functions are made orthonormal over the points, one after the other; one that depends on those
 * before it vanishes on D = 0, or differs there by a sum of the others, and is left out.  So every
 * invariant has one form, in the first products that can express it.  Where f' = 0 is sought the
 * constant function is the first and then left out, too: means are taken off.  Columns of V whose
 * singular value is 0 to rounding are invariants; the others are some powers of ten above. */
#include "invariants/null_space.h"
#include "core/svd.h"
#include "core/vectors.h"
#include "invariants/atoms.h"
#include "invariants/points.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A function that keeps less than this fraction of its length depends on those before it; singular
 * values below this fraction of the largest are 0. */
static const double dependent = 1e-8, vanishing = 1e-10;

/* ---- samples ---- */

/* The values and the rates of all products from the atoms' and, after these, tr F_v. */
static void multiply_atoms(const dal__search *s, const dal__condition *condition,
                           const double *atom, dal__samples *out, int point)
{
    const double divergence = condition->power != 0.0 ? atom[2 * s->atoms] : 0.0;
    const size_t stride = (size_t)out->points;
    double *const value = out->value + point, *const rate = out->rate + point;
    value[0] = 1.0;
    rate[0] = 0.0;
    for (int k = 1; k < s->products; k++) {
        const size_t at = (size_t)k * stride, parent = (size_t)s->product[k].parent * stride;
        const double a = atom[s->product[k].last], da = atom[s->atoms + s->product[k].last];
        value[at] = value[parent] * a;
        rate[at] = rate[parent] * a + value[parent] * da;
    }
    for (int k = 0; k < s->products; k++)
        rate[(size_t)k * stride] += condition->power * divergence * value[(size_t)k * stride];
}

dal_status dal__search_sample(const dal__search *s, const dal__condition *condition,
                              const double *parameter, int points, dal__samples *samples)
{
    const dal__equations *e = &s->model->equations;
    const int outputs = 2 * s->atoms + 1;
    const size_t count = (size_t)points * (size_t)s->products;
    dal__node *node = malloc((size_t)outputs * sizeof *node);
    double *out = dal__numbers(1, (size_t)outputs);
    dal__points *at = NULL;
    *samples = (dal__samples){.functions = s->products, .points = points};
    samples->value = dal__numbers(2, count);
    samples->rate = samples->value + count;
    dal_status status = node && out && samples->value ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
    for (int i = 0; i < s->atoms && status == DAL_STATUS_OK; i++) {
        node[i] = s->atom[i].node;
        node[s->atoms + i] = dal__search_rate(e, s->atom[i].node);
    }
    if (status == DAL_STATUS_OK) {
        node[outputs - 1] =
            condition->power != 0.0 ? dal__search_divergence(e) : dal__number(e->graph, 0.0);
        status = dal__points_create(&at, e, &s->region, node, outputs);
    }
    if (status == DAL_STATUS_OK) dal__points_begin(at, parameter);
    for (int i = 0; i < points && status == DAL_STATUS_OK; i++) {
        status = dal__points_next(at, out);
        if (status == DAL_STATUS_OK) multiply_atoms(s, condition, out, samples, i);
    }
    dal__points_free(at);
    free(node);
    free(out);
    if (status != DAL_STATUS_OK) dal__samples_free(samples);
    return status;
}

void dal__samples_free(dal__samples *samples)
{
    free(samples->value);
    *samples = (dal__samples){.value = NULL};
}

/* ---- independent functions ---- */

/* Orthonormal functions, what they are made of, and their rates. */
typedef struct basis {
    const dal__samples *samples;
    int count, first; /* those from first on are sought in */
    int *kept;        /* [count] which function each is the last of */
    double *made_of;  /* [count*functions] */
    double *size;     /* [functions] length of each function */
} basis;

static double *column(double *x, int rows, int k) { return x + (size_t)k * (size_t)rows; }

static void subtract(int count, double factor, const double *x, double *y)
{
    for (int i = 0; i < count; i++) y[i] -= factor * x[i];
}

static double length_of(int count, const double *x) { return sqrt(dal__dot_product(count, x, x)); }

/* Moves function k to the end of the basis, if it is independent. */
static void add_function(basis *b, int k)
{
    const int points = b->samples->points, functions = b->samples->functions;
    double *const f = column(b->samples->value, points, k);
    double *const w = column(b->samples->rate, points, k);
    double *const made_of = column(b->made_of, functions, b->count);
    memset(made_of, 0, (size_t)functions * sizeof *made_of);
    made_of[k] = 1.0;
    b->size[k] = length_of(points, f);
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < b->count; i++) {
            const double *q = column(b->samples->value, points, b->kept[i]);
            const double component = dal__dot_product(points, q, f);
            subtract(points, component, q, f);
            subtract(points, component, column(b->samples->rate, points, b->kept[i]), w);
            subtract(functions, component, column(b->made_of, functions, i), made_of);
        }
    const double length = length_of(points, f);
    if (!(length > dependent * b->size[k])) return;
    for (int i = 0; i < points; i++) f[i] /= length;
    for (int i = 0; i < points; i++) w[i] /= length;
    for (int i = 0; i < functions; i++) made_of[i] /= length;
    b->kept[b->count++] = k;
}

/* ---- reduced echelon form ---- */

/* Subtracts the pivot row from all others. */
static void clear_column(double *rows, int count, int width, int row, int at)
{
    double *const pivot = column(rows, width, row), scale = pivot[at];
    for (int k = 0; k < width; k++) pivot[k] /= scale;
    for (int i = 0; i < count; i++)
        if (i != row) {
            double *const other = column(rows, width, i);
            const double factor = other[at];
            subtract(width, factor, pivot, other);
            other[at] = 0.0;
        }
}

/* Coefficients below the fraction `absent` of a row are 0. */
static void reduce(double *rows, int count, int width, double absent)
{
    const double pivot = fmax(1e-6, absent);
    int done = 0;
    for (int at = 0; at < width && done < count; at++) {
        int best = done;
        for (int i = done; i < count; i++)
            if (fabs(column(rows, width, i)[at]) > fabs(column(rows, width, best)[at])) best = i;
        const double *row = column(rows, width, best);
        if (!(fabs(row[at]) > pivot * dal__max_abs(row, (size_t)width))) continue;
        for (int k = 0; k < width && best != done; k++) {
            const double x = row[k];
            column(rows, width, best)[k] = column(rows, width, done)[k];
            column(rows, width, done)[k] = x;
        }
        clear_column(rows, count, width, done++, at);
    }
    for (int i = 0; i < count; i++) {
        double *const row = column(rows, width, i);
        const double least = absent * dal__max_abs(row, (size_t)width);
        for (int k = 0; k < width; k++)
            if (fabs(row[k]) < least) row[k] = 0.0;
    }
}

/* ---- the null space ---- */

/* The last columns of V as rows of coefficients of functions of length 1, reduced, and then of the
 * functions themselves.  Roundings of the rates turn a vector of the null space towards the others
 * by eps over the least singular value of these, which a coefficient that is 0 may then have; the
 * formulas are confirmed later, so that too large a fraction makes none of them wrong. */
static bool write_rows(const basis *b, const double *vector, int sought, dal__null_space *out)
{
    static const double least = 1e-8, most = 1e-4, roundings = 1024.0;
    const int width = b->samples->functions, zeros = out->count;
    const double fraction = roundings * DBL_EPSILON / out->least_change; /* NaN: no others remain */
    out->coefficient = dal__numbers((size_t)zeros + 1, (size_t)width);
    if (!out->coefficient) return false;
    for (int i = 0; i < zeros; i++) {
        double *const row = column(out->coefficient, width, i);
        const double *v = vector + (size_t)(sought - zeros + i) * (size_t)sought;
        for (int j = 0; j < sought; j++)
            subtract(width, -v[j], column(b->made_of, width, b->first + j), row);
        for (int k = 0; k < b->first; k++) row[k] = 0.0;
        for (int k = 0; k < width; k++) row[k] *= b->size[k];
    }
    reduce(out->coefficient, zeros, width, fraction > least ? fmin(fraction, most) : least);
    for (int i = 0; i < zeros; i++)
        for (int k = 0; k < width; k++)
            if (b->size[k] > 0.0) column(out->coefficient, width, i)[k] /= b->size[k];
    return true;
}

static bool find_zeros(const basis *b, dal__null_space *out)
{
    const int points = b->samples->points, sought = b->count - b->first;
    const size_t n = (size_t)sought, rows = (size_t)points;
    double *a = dal__numbers(n, rows + n + 1);
    if (!a) return false;
    double *vector = a + n * rows, *value = vector + n * n;
    for (size_t j = 0; j < n; j++)
        memcpy(a + j * rows, column(b->samples->rate, points, b->kept[b->first + (int)j]),
               rows * sizeof *a);
    bool made = dal__singular_values(points, sought, a, value, vector);
    for (int i = 0; made && i < sought; i++) {
        const double fraction = value[0] > 0.0 ? value[i] / value[0] : 0.0;
        if (fraction > vanishing)
            out->least_change = fraction;
        else if (out->count++ == 0)
            out->largest_zero = fraction;
    }
    made = made && write_rows(b, vector, sought, out);
    free(a);
    return made;
}

dal_status dal__find_null_space(const dal__samples *samples, const dal__condition *condition,
                                dal__null_space *out)
{
    const size_t n = (size_t)samples->functions;
    basis b = {.samples = samples, .first = condition->has_constants ? 0 : 1};
    *out = (dal__null_space){.least_change = NAN, .largest_zero = NAN};
    b.kept = calloc(n, sizeof *b.kept);
    b.made_of = dal__numbers(n + 1, n);
    b.size = dal__numbers(1, n);
    bool made = b.kept && b.made_of && b.size;
    for (int k = 0; made && k < samples->functions; k++) add_function(&b, k);
    out->functions = b.count - b.first;
    if (made && out->functions > 0) made = find_zeros(&b, out);
    free(b.kept);
    free(b.made_of);
    free(b.size);
    if (!made) dal__null_space_free(out);
    return made ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
}

void dal__null_space_free(dal__null_space *space)
{
    free(space->coefficient);
    space->coefficient = NULL;
}
