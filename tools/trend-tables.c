/* trend-tables.c - writes the tables of lib/statistics/trend_tables.h as C.
 *
 * Shapes, as functions of s = t/T, averaged over each bin (by Gauss's rule, four points on each of
 * 64 intervals) and scaled to a range of 1:
 *
 *     linear        s
 *     power         s^p; log(1 + M s), which counts as power 0
 *     exponential   e^(k (s - 1))
 *     settles       tanh((s - c)/w), 1 - e^(-s/tau), where the new level is reached and lasts
 *     other         those that do not reach it, slow waves, e^s and e^(2 s), 1/(a - s)
 *
 * Pairs of shapes beside each other: two relaxations, a line and a relaxation, which count as a
 * change that settles until its late part decides; a line and an exponential, other.
 *
 * Shapes of the logarithm of an amplitude, z = log(1 + R f^2)/2, R = 1 .. 1e8 the square of what it
 * is beside noise that does not grow:
 *
 *     growing       f = s^p, e^(k (s - 1))
 *     other         steps of z; |sin| of beats; beats from their node; 1 - e^(-s/tau) and logistic
 *                   curves
 *
 * Noises, as the variances v_j' C v_j of the cosine coefficients of bin means:
 *
 *     white         1
 *     memory m      1 + r C, C autoregressive: with b = 1/BINS, x = b/m,
 *                   C_ij = ((1 - e^-x)/x)^2 e^(-(|i - j| - 1) x), C_ii = 2 (x - 1 + e^-x)/x^2
 *     walk          1 + r C, C_ij = min(s_i, s_j), C_ii = s_i - b/6
 *     smooth        1 + r C, an integrated walk with a free slope:
 *                   C_ij = 0.3 s_i s_j + min^2 (3 max - min)/6
 *
 * with C scaled to a mean variance of 1 about its mean. */
#include "statistics/trend_tables.h"
#include "core/pi.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BINS = DAL__BINS, WAVES = DAL__WAVES, INTERVALS = 64 };

static const double pi = DAL__PI;

typedef double shape_function(double s, double a, double b);

static double linear(double s, double a, double b) { return (void)a, (void)b, s; }
static double power(double s, double p, double b) { return (void)b, pow(s, p); }
static double logarithm(double s, double m, double b) { return (void)b, log(1.0 + m * s); }
static double exponential(double s, double k, double b) { return (void)b, exp(k * (s - 1.0)); }
static double step(double s, double c, double w) { return tanh((s - c) / w); }
static double relaxation(double s, double tau, double b) { return (void)b, -exp(-s / tau); }
static double pole(double s, double a, double b) { return (void)b, 1.0 / (a - s); }
static double wave_cosine(double s, double f, double b) { return (void)b, cos(2.0 * pi * f * s); }
static double wave_sine(double s, double f, double b) { return (void)b, sin(2.0 * pi * f * s); }

static double cosine[WAVES][BINS];
static double wave[DAL__SHAPES][WAVES];
static dal__shape shapes[DAL__SHAPES];
static dal__noise noises[DAL__NOISES];
static int shape_count, noise_count;
static dal__pair pairs[DAL__PAIRS];
static double amplitude_wave[DAL__AMPLITUDES][WAVES], amplitude_weight[DAL__AMPLITUDES];
static int pair_count, amplitude_count;

static double bin_mean(shape_function *f, int bin, double a, double b)
{
    static const double node[] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                  0.93056815579702629};
    static const double weight[] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                    0.17392742256872693};
    double sum = 0.0;
    for (int i = 0; i < INTERVALS; i++)
        for (int k = 0; k < 4; k++)
            sum += weight[k] * f((bin + (i + node[k]) / INTERVALS) / BINS, a, b);
    return sum / INTERVALS;
}

static void add_shape(dal__meaning meaning, double weight, shape_function *f, double a, double b)
{
    double y[BINS], low = INFINITY, high = -INFINITY;
    assert(shape_count < DAL__SHAPES);
    for (int m = 0; m < BINS; m++) {
        y[m] = bin_mean(f, m, a, b);
        low = fmin(low, y[m]);
        high = fmax(high, y[m]);
    }
    for (int j = 0; j < WAVES; j++) {
        double sum = 0.0;
        for (int m = 0; m < BINS; m++) sum += cosine[j][m] * y[m];
        wave[shape_count][j] = sum / (high - low);
    }
    const double parameter = f == logarithm ? 0.0 : f == linear ? 1.0 : a;
    shapes[shape_count++] = (dal__shape){meaning, weight, parameter, f == step ? b : 0.0};
}

static void add_steps(void)
{
    static const double width[] = {0.004, 0.016, 0.035, 0.06, 0.1};
    const double count = 32 * 5;
    for (int i = 0; i < 32; i++)
        for (int k = 0; k < 5; k++) {
            const double c = 0.04 + 0.03 * i, w = width[k];
            const int settled = c + 1.5 * w < 0.95;
            add_shape(settled ? DAL__MEANS_SETTLES : DAL__MEANS_OTHER,
                      (settled ? 0.5 * 0.11 : 0.3 * 0.11) / count, step, c, w);
        }
}

static void add_shapes(void)
{
    static const double low[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
    static const double high[] = {1.25, 1.4, 1.5, 1.6, 1.8, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0,
                                  3.2,  3.4, 3.6, 3.8, 4.0, 4.5, 5.0, 5.6, 6.3, 7.0};
    static const double m[] = {30, 300, 3000, 30000};
    static const double rate[] = {3, 4, 5, 6, 7.5, 9, 11, 13, 16, 20, 25};
    static const double tau[] = {0.01, 0.02, 0.04, 0.07, 0.1, 0.14, 0.19, 0.25};
    static const double slow_tau[] = {0.35, 0.5, 1.0};
    static const double beyond[] = {1.08, 1.2};
    for (int i = 0; i < 8; i++) add_shape(DAL__MEANS_POWER, 0.07 * 0.8 / 29, power, low[i], 0);
    assert(shape_count == DAL__LINEAR_SHAPE);
    add_shape(DAL__MEANS_LINEAR, 0.4, linear, 0, 0);
    for (int i = 0; i < 21; i++) add_shape(DAL__MEANS_POWER, 0.07 * 0.8 / 29, power, high[i], 0);
    assert(shape_count == DAL__POWER_SHAPES);
    for (int i = 0; i < 4; i++) add_shape(DAL__MEANS_POWER, 0.07 * 0.05, logarithm, m[i], 0);
    for (int i = 0; i < 11; i++)
        add_shape(DAL__MEANS_EXPONENTIAL, 0.05 / 11, exponential, rate[i], 0);
    add_shape(DAL__MEANS_OTHER, 0.011, exponential, 1, 0);
    add_shape(DAL__MEANS_OTHER, 0.011, exponential, 2, 0);
    add_steps();
    for (int i = 0; i < 8; i++)
        add_shape(DAL__MEANS_SETTLES, 0.11 * 0.4 / 8, relaxation, tau[i], 0);
    for (int i = 0; i < 3; i++) add_shape(DAL__MEANS_OTHER, 0.011, relaxation, slow_tau[i], 0);
    for (int i = 0; i < 2; i++) add_shape(DAL__MEANS_OTHER, 0.005, pole, beyond[i], 0);
    assert(shape_count == DAL__PLAIN_SHAPES);
    for (int i = 0; i < DAL__SLOW_WAVES; i++) {
        const double f = 0.25 * (i + 1);
        const dal__meaning meaning = f < 1.9 ? DAL__MEANS_OTHER : DAL__MEANS_NONE;
        add_shape(meaning, 0.3 * 0.2 / DAL__SLOW_WAVES, wave_cosine, f, 0);
        add_shape(meaning, 0.3 * 0.2 / DAL__SLOW_WAVES, wave_sine, f, 0);
    }
    assert(shape_count <= DAL__SHAPES);
}

/* ---- pairs ---- */

static int shape_of(dal__meaning meaning, double parameter)
{
    int i = 0;
    while (shapes[i].meaning != meaning || shapes[i].parameter != parameter) i++;
    return i;
}

static void add_pairs(void)
{
    const double settles = 0.0275 / (DAL__TAUS * (DAL__TAUS - 1) / 2), other = 0.022 / 11;
    const int tau = DAL__PLAIN_SHAPES - 5 - DAL__TAUS; /* the first of the relaxations */
    const int rate = shape_of(DAL__MEANS_EXPONENTIAL, 3);
    for (int i = 0; i < DAL__TAUS; i++)
        for (int k = 0; k < i; k++)
            pairs[pair_count++] = (dal__pair){tau + k, tau + i, DAL__MEANS_SETTLES, settles};
    for (int i = 0; i < DAL__TAUS; i++)
        pairs[pair_count++] =
            (dal__pair){tau + i, DAL__LINEAR_SHAPE, DAL__MEANS_SETTLES, 0.022 / DAL__TAUS};
    for (int i = 0; i < 11; i++)
        pairs[pair_count++] = (dal__pair){DAL__LINEAR_SHAPE, rate + i, DAL__MEANS_OTHER, other};
    assert(pair_count == DAL__PAIRS && shapes[tau].parameter == 0.01);
}

/* ---- amplitudes ---- */

enum { RATIOS = 24, LINEAR_RATIOS = 72 };

/* Number i of n, from a to b in equal ratios. */
static double between(double a, double b, int i, int n) { return a * pow(b / a, i / (n - 1.0)); }

static double beat(double s, double half_period, double phase)
{
    return fabs(sin(pi * (s / half_period + phase)));
}
static double saturation(double s, double tau, double b) { return (void)b, 1.0 - exp(-s / tau); }
static double logistic(double s, double c, double w) { return 1.0 / (1.0 + exp((c - s) / w)); }
static double jump(double s, double c, double b) { return (void)b, s > c ? 1.0 : 0.0; }

static double bin_square(shape_function *f, int bin, double a, double b)
{
    double sum = 0.0;
    for (int i = 0; i < INTERVALS; i++) {
        const double x = f((bin + (i + 0.5) / INTERVALS) / BINS, a, b);
        sum += x * x / INTERVALS;
    }
    return sum;
}

/* z = log(1 + R f^2)/2. */
static void add_amplitude(double weight, shape_function *f, double a, double b, double ratio)
{
    assert(amplitude_count < DAL__AMPLITUDES);
    for (int m = 0; m < BINS; m++) {
        const double z = 0.5 * log(1.0 + ratio * bin_square(f, m, a, b));
        for (int j = 0; j < WAVES; j++) amplitude_wave[amplitude_count][j] += cosine[j][m] * z;
    }
    amplitude_weight[amplitude_count++] = weight;
}

static void add_growing(void)
{
    static const double powers[] = {0.5, 0.7, 1.4, 2.0, 2.8};
    const double weight = 0.2 / 19 / RATIOS; /* twice for s itself */
    for (int r = 0; r < LINEAR_RATIOS; r++)
        add_amplitude(2.0 * weight * RATIOS / LINEAR_RATIOS, linear, 0, 0,
                      between(1, 1e8, r, LINEAR_RATIOS));
    for (int i = 0; i < 5; i++)
        for (int r = 0; r < RATIOS; r++)
            add_amplitude(weight, power, powers[i], 0, between(1, 1e8, r, RATIOS));
    for (int i = 0; i < 12; i++)
        for (int r = 0; r < RATIOS; r++)
            add_amplitude(weight, exponential, between(0.7, 16, i, 12), 0,
                          between(1, 1e8, r, RATIOS));
}

/* Steps of z by a height of either sign. */
static void add_jumps(double weight)
{
    static const double height[] = {0.15, 0.3, 0.6, 1.2, 2.4};
    for (int i = 0; i < 9; i++)
        for (int k = 0; k < 5; k++) {
            const double up = exp(2.0 * height[k]) - 1.0, down = exp(-2.0 * height[k]) - 1.0;
            add_amplitude(weight / 90, jump, 0.1 * (i + 1), 0, up);
            add_amplitude(weight / 90, jump, 0.1 * (i + 1), 0, down);
        }
}

static void add_beats(double clean, double from_node)
{
    enum { PERIODS = 9, PHASES = 12 };
    for (int i = 0; i < PERIODS; i++)
        for (int k = 0; k < PHASES; k++) {
            const double half = between(0.3, 6, i, PERIODS), phase = (k + 0.5) / PHASES;
            add_amplitude(clean / (2 * PERIODS * PHASES), beat, half, phase, 1e6);
            add_amplitude(clean / (2 * PERIODS * PHASES), beat, half, phase, 10);
        }
    for (int i = 0; i < PERIODS; i++)
        for (int r = 0; r < RATIOS; r++)
            add_amplitude(from_node / (PERIODS * RATIOS), beat, between(1.05, 6, i, PERIODS), 0,
                          between(1, 1e8, r, RATIOS));
}

static void add_saturations(double weight)
{
    static const double tau[] = {0.05, 0.1, 0.2, 0.35, 0.6};
    static const double centre[] = {0.2, 0.35, 0.5, 0.65, 0.8}, width[] = {0.03, 0.06, 0.12};
    static const double ratio[] = {5, 100, 1e5};
    for (int r = 0; r < 3; r++) {
        for (int i = 0; i < 5; i++) add_amplitude(weight / 60, saturation, tau[i], 0, ratio[r]);
        for (int i = 0; i < 5; i++)
            for (int k = 0; k < 3; k++)
                add_amplitude(weight / 60, logistic, centre[i], width[k], ratio[r]);
    }
}

static void add_amplitudes(void)
{
    const double other = 0.12;
    add_growing();
    assert(amplitude_count == DAL__GROWING_AMPLITUDES);
    add_jumps(0.3 * other);
    add_beats(0.7 * other, 0.06 * other);
    add_saturations(0.2 * other);
    assert(amplitude_count == DAL__AMPLITUDES);
}

/* ---- noises ---- */

typedef double covariance(int i, int j, double m);

static double memory(int i, int j, double m)
{
    const double x = 1.0 / (BINS * m), d = -expm1(-x) / x;
    if (i == j) return 2.0 * (x - 1.0 + exp(-x)) / (x * x);
    return d * d * exp(-(abs(i - j) - 1) * x);
}

static double place(int i) { return (i + 0.5) / BINS; }

static double walk(int i, int j, double unused)
{
    (void)unused;
    return i == j ? place(i) - 1.0 / (6.0 * BINS) : place(i < j ? i : j);
}

static double smooth(int i, int j, double unused)
{
    (void)unused;
    const double low = place(i < j ? i : j), high = place(i < j ? j : i);
    return 0.3 * low * high + low * low * (3.0 * high - low) / 6.0;
}

typedef struct noise_source {
    dal__meaning meaning;
    covariance *of;
    double memory, ratio, weight, shape_weight, rate_weight;
} noise_source;

/* The first DAL__SHAPE_NOISES are those that shapes are tried under. */
static const noise_source sources[DAL__NOISES] = {
    {DAL__MEANS_NONE, memory, 1, 0, 2, 2, 1},
    {DAL__MEANS_NONE, memory, 1.0 / 64, 1000, 1. / 3, .5, 1},
    {DAL__MEANS_NONE, memory, 1.0 / 64, 3, 1. / 3, .5, 1},
    {DAL__MEANS_NONE, memory, 1.0 / 32, 3, 1. / 3, 1, 1},
    {DAL__MEANS_NONE, memory, 1.0 / 16, 1000, 1. / 3, 1, 1},
    {DAL__MEANS_NONE, memory, 1.0 / 16, 3, 1. / 3, .5, 1},
    {DAL__MEANS_OTHER, memory, 1.0 / 9, 1000, 1.5, 1, 2},
    {DAL__MEANS_OTHER, memory, 1.0 / 9, 3, .4, 1, 2},
    {DAL__MEANS_WALK, walk, 0, 1e4, .4, .4, 12.8},
    {DAL__MEANS_WALK, walk, 0, 50, .25, .25, 8},
    {DAL__MEANS_WALK, walk, 0, 5, .2, .2, 1},
    {DAL__MEANS_WALK, walk, 0, 0.7, .15, .15, .1},
    {DAL__MEANS_NONE, memory, 1.0 / 64, 0.4, 1. / 3, 0, 0},
    {DAL__MEANS_NONE, memory, 1.0 / 32, 1000, 1. / 3, 0, 0},
    {DAL__MEANS_NONE, memory, 1.0 / 32, 0.4, 1. / 3, 0, 0},
    {DAL__MEANS_NONE, memory, 1.0 / 16, 0.4, 1. / 3, 0, 0},
    {DAL__MEANS_OTHER, memory, 1.0 / 9, 0.4, .2, 0, 0},
    {DAL__MEANS_OTHER, memory, 0.25, 1000, .2, 0, 0},
    {DAL__MEANS_OTHER, memory, 0.25, 3, .1, 0, 0},
    {DAL__MEANS_OTHER, memory, 0.25, 0.4, .1, 0, 0},
    {DAL__MEANS_OTHER, smooth, 0, 1e6, .15, 0, 0},
    {DAL__MEANS_OTHER, smooth, 0, 1e4, .15, 0, 0},
    {DAL__MEANS_OTHER, smooth, 0, 100, .15, 0, 0},
    {DAL__MEANS_OTHER, smooth, 0, 3, .15, 0, 0},
};

/* The prior of a noise alone: the prior of its class, over its members. */
static double class_weight(const noise_source *n)
{
    const double prior = n->meaning == DAL__MEANS_NONE   ? 0.43
                         : n->meaning == DAL__MEANS_WALK ? 0.17
                                                         : 0.25;
    double sum = 0.0;
    for (int i = 0; i < DAL__NOISES; i++)
        if (sources[i].meaning == n->meaning) sum += sources[i].weight;
    return prior * n->weight / sum;
}

static void add_noise(const noise_source *n)
{
    double variance[WAVES], mean = 0.0, shape_sum = 0.0;
    dal__noise *out = &noises[noise_count++];
    for (int j = 0; j < WAVES; j++) {
        variance[j] = 0.0;
        for (int i = 0; i < BINS; i++)
            for (int k = 0; k < BINS; k++)
                variance[j] += cosine[j][i] * cosine[j][k] * n->of(i, k, n->memory);
        mean += variance[j] / WAVES;
    }
    for (int i = 0; i < DAL__NOISES; i++) shape_sum += sources[i].shape_weight;
    *out = (dal__noise){.meaning = n->meaning,
                        .weight = class_weight(n),
                        .shape_weight = n->shape_weight / shape_sum,
                        .rate_weight = n->rate_weight};
    for (int j = 0; j < WAVES; j++) {
        out->precision[j] = 1.0 / (1.0 + n->ratio * variance[j] / mean);
        out->log_determinant -= log(out->precision[j]);
        out->precision_sum += out->precision[j];
    }
}

/* ---- output ---- */

static double product(int noise, const double *a, const double *b)
{
    double sum = 0.0;
    for (int j = 0; j < WAVES; j++) sum += noises[noise].precision[j] * a[j] * b[j];
    return sum;
}

static void print_noise(const dal__noise *n)
{
    printf("{%d,%.17g,%.17g,%.17g,%.17g,%.17g,{", n->meaning, n->weight, n->shape_weight,
           n->rate_weight, n->log_determinant, n->precision_sum);
    for (int j = 0; j < WAVES; j++) printf("%.17g,", n->precision[j]);
    printf("}},\n");
}

static void print_tables(void)
{
    printf("/* Made by tools/trend-tables.c. */\n#include \"statistics/trend_tables.h\"\n");
    printf("const double dal__cosine[DAL__WAVES][DAL__BINS] = {\n");
    for (int j = 0; j < WAVES; j++) {
        putchar('{');
        for (int m = 0; m < BINS; m++) printf("%.17g,", cosine[j][m]);
        printf("},\n");
    }
    printf("};\nconst dal__shape dal__shape_list[DAL__SHAPES] = {\n");
    for (int i = 0; i < shape_count; i++)
        printf("{%d,%.17g,%.17g,%.17g},\n", shapes[i].meaning, shapes[i].weight,
               shapes[i].parameter, shapes[i].width);
    printf("};\nconst dal__noise dal__noise_list[DAL__NOISES] = {\n");
    for (int i = 0; i < DAL__NOISES; i++) print_noise(&noises[i]);
    printf("};\nconst double dal__shape_wave[DAL__WAVES][DAL__SHAPES] = {\n");
    for (int j = 0; j < WAVES; j++) {
        putchar('{');
        for (int i = 0; i < DAL__SHAPES; i++) printf("%.17g,", wave[i][j]);
        printf("},\n");
    }
    printf("};\nconst double dal__shape_square[DAL__SHAPE_NOISES][DAL__SHAPES] = {\n");
    for (int n = 0; n < DAL__SHAPE_NOISES; n++) {
        putchar('{');
        for (int i = 0; i < DAL__SHAPES; i++)
            printf("%.17g,", i < shape_count ? product(n, wave[i], wave[i]) : 1.0);
        printf("},\n");
    }
    printf("};\nconst double dal__slow_product[DAL__SHAPE_NOISES][DAL__SLOW_WAVES] = {\n");
    for (int n = 0; n < DAL__SHAPE_NOISES; n++) {
        putchar('{');
        for (int i = 0; i < DAL__SLOW_WAVES; i++)
            printf("%.17g,", product(n, wave[DAL__PLAIN_SHAPES + 2 * i],
                                     wave[DAL__PLAIN_SHAPES + 2 * i + 1]));
        printf("},\n");
    }
    printf("};\n");
}

static void print_pairs(void)
{
    printf("const dal__pair dal__pair_list[DAL__PAIRS] = {\n");
    for (int i = 0; i < DAL__PAIRS; i++)
        printf("{%d,%d,%d,%.17g},\n", pairs[i].first, pairs[i].second, pairs[i].meaning,
               pairs[i].weight);
    printf("};\nconst double dal__pair_product[DAL__SHAPE_NOISES][DAL__PAIRS] = {\n");
    for (int n = 0; n < DAL__SHAPE_NOISES; n++) {
        putchar('{');
        for (int i = 0; i < DAL__PAIRS; i++)
            printf("%.17g,", product(n, wave[pairs[i].first], wave[pairs[i].second]));
        printf("},\n");
    }
    printf("};\n");
}

static void print_amplitudes(void)
{
    printf("const double dal__amplitude_weight[DAL__AMPLITUDES] = {\n");
    for (int i = 0; i < DAL__AMPLITUDES; i++) printf("%.17g,", amplitude_weight[i]);
    printf("};\nconst double dal__amplitude_wave[DAL__WAVES][DAL__AMPLITUDES] = {\n");
    for (int j = 0; j < WAVES; j++) {
        putchar('{');
        for (int i = 0; i < DAL__AMPLITUDES; i++) printf("%.17g,", amplitude_wave[i][j]);
        printf("},\n");
    }
    printf("};\nconst double dal__amplitude_square[DAL__SHAPE_NOISES][DAL__AMPLITUDES] = {\n");
    for (int n = 0; n < DAL__SHAPE_NOISES; n++) {
        putchar('{');
        for (int i = 0; i < DAL__AMPLITUDES; i++)
            printf("%.17g,", product(n, amplitude_wave[i], amplitude_wave[i]));
        printf("},\n");
    }
    printf("};\n");
}

int main(void)
{
    for (int j = 0; j < WAVES; j++)
        for (int m = 0; m < BINS; m++)
            cosine[j][m] = sqrt(2.0 / BINS) * cos(pi * (j + 1) * (m + 0.5) / BINS);
    add_shapes();
    add_pairs();
    add_amplitudes();
    for (int i = 0; i < DAL__NOISES; i++) add_noise(&sources[i]);
    print_tables();
    print_pairs();
    print_amplitudes();
    return ferror(stdout) || fflush(stdout);
}
