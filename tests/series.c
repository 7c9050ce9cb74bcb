/* series.c - synthetic series of known kinds, for the tests of trends.
 *
 * Each kind draws its own parameters, off every grid that a classifier may use.  s = t/T runs from
 * 0 to 1.  The noise of memory m is autoregressive, x_k = exp(-1/(m n)) x_(k-1) + noise. */
#include "series.h"
#include <math.h>
#include <string.h>

static const double two_pi = 6.283185307179586;

/* ---- chance ---- */

/* SplitMix64 (Steele, Lea, Flood 2014, DOI 10.1145/2660193.2660195). */
uint64_t series_next(uint64_t *random)
{
    uint64_t z = *random += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

double series_between(uint64_t *random, double low, double high)
{
    return low + (high - low) * (double)(series_next(random) >> 11) * 0x1p-53;
}

double series_log_between(uint64_t *random, double low, double high)
{
    return exp(series_between(random, log(low), log(high)));
}

double series_normal(uint64_t *random)
{
    const uint64_t bits = series_next(random);
    const double sum = (double)(bits & 0xffff) + (double)(bits >> 16 & 0xffff) +
                       (double)(bits >> 32 & 0xffff) + (double)(bits >> 48);
    return (sum * 0x1p-16 - 2.0 + 0x1p-15) * 1.7320508075688772;
}

double series_sign(series *s) { return series_next(&s->random) & 1 ? 1.0 : -1.0; }
double series_uniform(series *s, double a, double b) { return series_between(&s->random, a, b); }
double series_log_uniform(series *s, double a, double b)
{
    return series_log_between(&s->random, a, b);
}
double series_parameter(series *s) { return series_uniform(s, s->from, s->to); }
double series_place(const series *s, int k) { return (double)k / (s->count - 1); }

/* ---- parts of a series ---- */

void series_add_white(series *s, double size)
{
    for (int k = 0; k < s->count; k++) s->x[k] += size * series_normal(&s->random);
}

/* Noise of variance 1 and memory m T, times size. */
void series_add_memory(series *s, double memory, double size)
{
    const double keep = exp(-1.0 / (memory * s->count)), fresh = sqrt(1.0 - keep * keep);
    double a = series_normal(&s->random);
    for (int k = 0; k < s->count; k++) {
        s->x[k] += size * a;
        a = keep * a + fresh * series_normal(&s->random);
    }
}

void series_add_walk(series *s, double size)
{
    double a = 0.0;
    for (int k = 0; k < s->count; k++) {
        s->x[k] += size * a;
        a += series_normal(&s->random);
    }
}

void series_add_line(series *s, double drift)
{
    s->drift += drift;
    for (int k = 0; k < s->count; k++) s->x[k] += drift * series_place(s, k);
}

void series_add_tone(series *s, double size, double periods, double phase)
{
    const double angle = two_pi * periods / (s->count - 1), c = cos(angle), d = sin(angle);
    double re = size * cos(phase), im = size * sin(phase);
    for (int k = 0; k < s->count; k++) {
        const double next = c * re - d * im;
        s->x[k] += re;
        im = d * re + c * im;
        re = next;
    }
}

/* One to three tones of at least `periods` periods, the largest of amplitude `size`. */
void series_add_tones(series *s, double size, double periods)
{
    const int tones = 1 + (int)(series_next(&s->random) % 3);
    for (int i = 0; i < tones; i++)
        series_add_tone(s, size * (i ? series_uniform(s, 0.1, 1.0) : 1.0),
                        series_log_uniform(s, periods, 0.2 * s->count),
                        series_uniform(s, 0.0, two_pi));
}

double series_deviation(const series *s)
{
    double mean = 0.0, square = 0.0;
    for (int k = 0; k < s->count; k++) mean += s->x[k] / s->count;
    for (int k = 0; k < s->count; k++) square += (s->x[k] - mean) * (s->x[k] - mean) / s->count;
    return sqrt(square);
}

/* ---- no trend ---- */

static void white(series *s) { series_add_white(s, 1.0); }
static void memory(series *s) { series_add_memory(s, series_parameter(s), 1.0); }

static void student(series *s)
{
    for (int k = 0; k < s->count; k++) {
        double square = 0.0;
        for (int i = 0; i < 3; i++) {
            const double a = series_normal(&s->random);
            square += a * a;
        }
        s->x[k] = series_normal(&s->random) / sqrt(square / 3.0);
    }
}

static void oscillation(series *s)
{
    series_add_tones(s, 1.0, s->from);
    series_add_white(s, series_log_uniform(s, 1e-4, 0.3));
}

static void clean_tone(series *s)
{
    series_add_tone(s, 1.0, series_log_uniform(s, s->from, fmin(s->to, 0.2 * s->count)),
                    series_uniform(s, 0.0, two_pi));
}

static void clean_cosine(series *s)
{
    series_add_tone(s, -1.0, series_log_uniform(s, s->from, fmin(s->to, 0.2 * s->count)), 0.0);
}

static void quasi_periodic(series *s)
{
    const double periods = series_uniform(s, s->from, s->to);
    series_add_tone(s, 1.0, periods, series_uniform(s, 0.0, two_pi));
    series_add_tone(s, series_uniform(s, 0.2, 1.0), periods * 1.618033988749895,
                    series_uniform(s, 0.0, two_pi));
    series_add_tone(s, series_uniform(s, 0.2, 1.0), periods * 1.4142135623730951,
                    series_uniform(s, 0.0, two_pi));
    series_add_tone(s, series_uniform(s, 0.2, 1.0), periods * 7.38905609893065,
                    series_uniform(s, 0.0, two_pi));
}

static void sawtooth(series *s)
{
    const double periods = series_parameter(s), phase = series_uniform(s, 0.0, 1.0);
    for (int k = 0; k < s->count; k++) s->x[k] = fmod(periods * series_place(s, k) + phase, 1.0);
    series_add_white(s, series_log_uniform(s, 1e-4, 0.1));
}

/* Two states of exponential durations of mean (from..to) T. */
static void switches(series *s)
{
    const double rate = 1.0 / (series_parameter(s) * s->count);
    double state = series_sign(s);
    for (int k = 0; k < s->count; k++) {
        if (series_uniform(s, 0.0, 1.0) < rate) state = -state;
        s->x[k] = state;
    }
    series_add_white(s, series_log_uniform(s, 1e-3, 0.5));
}

/* Bursts: noise that is large in a tenth of the time. */
static void intermittent(series *s)
{
    const double rate = 1.0 / (series_parameter(s) * s->count),
                 calm_size = series_uniform(s, 0.01, 0.3);
    int bursts = 0;
    for (int k = 0; k < s->count; k++) {
        if (series_uniform(s, 0.0, 1.0) < (bursts ? 5.0 : 1.0) * rate) bursts = !bursts;
        s->x[k] = (bursts ? 1.0 : calm_size) * series_normal(&s->random);
    }
}

/* Pomeau and Manneville: z -> z + z^a mod 1. */
static void laminar(series *s)
{
    const double power = series_parameter(s);
    double z = series_uniform(s, 0.1, 0.9);
    for (int k = 0; k < s->count; k++) {
        s->x[k] = z;
        z += pow(z, power);
        z -= floor(z);
    }
}

/* Chaotic where neighbours part: Lyapunov's exponent is positive.  Other values of a end in a
 * cycle, which settles, and are drawn again. */
static void logistic(series *s)
{
    double exponent = -1.0;
    while (exponent < 0.1) {
        const double a = series_parameter(s);
        double z = series_uniform(s, 0.1, 0.9);
        exponent = 0.0;
        for (int k = -100; k < s->count; k++) {
            if (k >= 0) s->x[k] = z;
            if (2 * k >= s->count) exponent += 2.0 / s->count * log(fabs(a * (1.0 - 2.0 * z)));
            z *= a * (1.0 - z);
        }
    }
}

static void lorenz_field(const double *u, double *f)
{
    f[0] = 10.0 * (u[1] - u[0]);
    f[1] = u[0] * (28.0 - u[2]) - u[1];
    f[2] = u[0] * u[1] - 8.0 / 3.0 * u[2];
}

static void lorenz_step(double *u, double h)
{
    double a[3], b[3], v[3];
    lorenz_field(u, a);
    for (int i = 0; i < 3; i++) v[i] = u[i] + 0.5 * h * a[i];
    lorenz_field(v, b);
    for (int i = 0; i < 3; i++) u[i] += h * b[i];
}

static void lorenz(series *s)
{
    double u[] = {series_uniform(s, -5.0, 5.0), series_uniform(s, -5.0, 5.0),
                  series_uniform(s, 15.0, 30.0)};
    const int which = (int)(series_next(&s->random) % 3);
    for (int k = -2000; k < s->count; k++) {
        lorenz_step(u, 0.01);
        if (k >= 0) s->x[k] = u[which];
    }
}

/* Slower than can be recognised: from..to periods. */
static void slow_wave(series *s)
{
    series_add_tone(s, 1.0, series_parameter(s), series_uniform(s, 0.0, two_pi));
    series_add_white(s, series_log_uniform(s, 1e-3, 0.1));
}

/* Two tones whose beat lasts longer than the series. */
static void beat(series *s)
{
    const double periods = series_log_uniform(s, 20.0, 0.1 * s->count), b = series_parameter(s);
    series_add_tone(s, 1.0, periods, series_uniform(s, 0.0, two_pi));
    series_add_tone(s, series_uniform(s, 0.7, 1.0), periods + b, series_uniform(s, 0.0, two_pi));
    series_add_white(s, series_log_uniform(s, 1e-3, 0.03));
}

static void dying(series *s)
{
    const double rate = series_parameter(s), phase = series_uniform(s, 0.0, two_pi);
    const double periods = series_log_uniform(s, 10.0, 0.1 * s->count);
    for (int k = 0; k < s->count; k++)
        s->x[k] =
            exp(-rate * series_place(s, k)) * cos(two_pi * periods * series_place(s, k) + phase);
    series_add_white(s, series_log_uniform(s, 1e-4, 1e-2));
}

/* ---- changes that settle ---- */

static void add_step(series *s)
{
    const double c = series_parameter(s), height = series_sign(s);
    const double w = fmin(series_log_uniform(s, 1e-4, 0.08), 0.6 * (1.0 - c));
    for (int k = 0; k < s->count; k++)
        s->x[k] += 0.5 * height * (1.0 + tanh((series_place(s, k) - c) / w));
}

static void step_clean(series *s) { add_step(s); }

static void step_noise(series *s)
{
    add_step(s);
    series_add_white(s, series_log_uniform(s, 1e-3, 0.2));
}

static void step_tones(series *s)
{
    add_step(s);
    series_add_tones(s, series_uniform(s, 0.02, 0.4), 10.0);
    series_add_white(s, series_log_uniform(s, 1e-4, 0.05));
}

/* By from..to e-folds. */
static void decay(series *s)
{
    const double rate = series_parameter(s), height = series_sign(s);
    for (int k = 0; k < s->count; k++) s->x[k] = height * exp(-rate * series_place(s, k));
    series_add_white(s, series_log_uniform(s, 1e-4, 0.1));
}

static void relaxation_tones(series *s)
{
    decay(s);
    series_add_tones(s, series_uniform(s, 0.02, 0.3), 10.0);
}

/* Grows exponentially, then saturates near s = from..to. */
static void saturating(series *s)
{
    const double c = series_parameter(s), rate = series_uniform(s, 20.0, 80.0),
                 sharp = series_uniform(s, 0.5, 2.0);
    for (int k = 0; k < s->count; k++)
        s->x[k] = pow(1.0 + exp(-rate * (series_place(s, k) - c)), -sharp);
    series_add_white(s, series_log_uniform(s, 1e-4, 0.05));
}

/* ---- walks ---- */

static void walk(series *s) { series_add_walk(s, 1.0); }

/* Of roundings of numbers near 1: steps on the grid of doubles. */
static void rounding_walk(series *s)
{
    const double size = series_parameter(s);
    double a = 1.0;
    for (int k = 0; k < s->count; k++) {
        s->x[k] = a;
        a += size * 0x1p-52 * series_normal(&s->random);
    }
}

static void walk_noise(series *s)
{
    series_add_walk(s, 1.0 / sqrt(s->count));
    series_add_white(s, series_parameter(s));
}

static void walk_tones(series *s)
{
    series_add_walk(s, 1.0 / sqrt(s->count));
    series_add_tones(s, series_parameter(s), 10.0);
}

/* A truncation error that relaxes smoothly, among roundings of numbers near 1. */
static void truncation(series *s)
{
    const double size = series_sign(s) * series_log_uniform(s, 5e-12, 5e-10),
                 rate = series_uniform(s, 4.0, 30.0);
    for (int k = 0; k < s->count; k++)
        s->x[k] = 1.0 + size * (1.0 - exp(-rate * series_place(s, k))) +
                  0.5 * 0x1p-52 * series_normal(&s->random);
}

/* ---- lines ---- */

/* SNR = drift / (2 deviations of the rest) = from..to. */
static void line_tones(series *s)
{
    series_add_tones(s, 1.0, 3.0);
    series_add_white(s, series_log_uniform(s, 1e-4, 0.3));
    series_add_line(s, series_sign(s) * 2.0 * series_deviation(s) * series_parameter(s));
}

static void line_white(series *s)
{
    series_add_white(s, 1.0);
    series_add_line(s, series_sign(s) * 2.0 * series_parameter(s));
}

static void line_memory(series *s)
{
    series_add_memory(s, series_log_uniform(s, 0.001, 0.1), 1.0);
    series_add_line(s, series_sign(s) * 2.0 * series_parameter(s));
}

/* Biased rounding: a walk of eps with a mean step of from..to eps. */
static void line_rounding(series *s)
{
    const double bias = series_sign(s) * series_parameter(s) * 0x1p-52;
    double a = 1.0;
    s->drift = bias * (s->count - 1);
    for (int k = 0; k < s->count; k++) {
        s->x[k] = a;
        a += bias + 0.5 * 0x1p-52 * series_normal(&s->random);
    }
}

/* ---- growth ---- */

static void power(series *s)
{
    s->exponent = series_parameter(s);
    const double height = series_sign(s);
    for (int k = 0; k < s->count; k++) s->x[k] = height * pow(series_place(s, k), s->exponent);
    series_add_white(s, series_log_uniform(s, 1e-4, 0.05));
}

static void power_tones(series *s)
{
    s->exponent = series_parameter(s);
    series_add_tones(s, series_uniform(s, 0.01, 0.2), 10.0);
    for (int k = 0; k < s->count; k++) s->x[k] += pow(series_place(s, k), s->exponent);
}

static void logarithm(series *s)
{
    const double height = series_sign(s), scale = log(s->count);
    for (int k = 0; k < s->count; k++) s->x[k] = height * log(1.0 + k) / scale;
    series_add_white(s, series_log_uniform(s, 1e-4, 0.02));
}

static void exponential(series *s)
{
    const double rate = series_parameter(s), height = series_sign(s);
    for (int k = 0; k < s->count; k++) s->x[k] = height * exp(rate * (series_place(s, k) - 1.0));
    series_add_white(s, series_log_uniform(s, 1e-4, 0.05));
}

static void exponential_in_proportion(series *s)
{
    const double rate = series_parameter(s), height = series_sign(s),
                 noise = series_log_uniform(s, 1e-4, 0.3);
    for (int k = 0; k < s->count; k++)
        s->x[k] = height * exp(rate * (series_place(s, k) - 1.0)) *
                  (1.0 + noise * series_normal(&s->random));
}

/* ---- oscillations that grow ---- */

static void modulate_noise(series *s) { series_add_white(s, series_log_uniform(s, 1e-4, 1e-2)); }

static void growing_power(series *s)
{
    const double p = series_parameter(s), phase = series_uniform(s, 0.0, two_pi);
    const double periods = series_log_uniform(s, 15.0, 0.2 * s->count);
    for (int k = 0; k < s->count; k++)
        s->x[k] = pow(series_place(s, k), p) * cos(two_pi * periods * series_place(s, k) + phase);
    modulate_noise(s);
}

static void growing_exponential(series *s)
{
    const double rate = series_parameter(s), phase = series_uniform(s, 0.0, two_pi);
    const double periods = series_log_uniform(s, 15.0, 0.2 * s->count);
    for (int k = 0; k < s->count; k++)
        s->x[k] = exp(rate * (series_place(s, k) - 1.0)) *
                  cos(two_pi * periods * series_place(s, k) + phase);
    modulate_noise(s);
}

/* ---- the list ---- */

enum {
    N = ACCEPT_NONE,
    S = ACCEPT_SETTLES,
    W = ACCEPT_WALK,
    L = ACCEPT_LINEAR,
    P = ACCEPT_POWER,
    E = ACCEPT_EXPONENTIAL,
    G = ACCEPT_GROWING,
    LOG = ACCEPT_LOGARITHM,
    D = DECIDES,
    C = COVERS
};
enum { FEW = 500, MANY = 10000, MAX = 20000 };

const series_kind series_kinds[] = {
    {"white", white, 0, 0, FEW, MAX, N | C, 0},
    {"white, long", white, 0, 0, MANY, MAX, N | D | C, 0},
    {"memory T/1000", memory, 0.001, 0.001, FEW, MAX, N | C, 0},
    {"memory T/200", memory, 0.005, 0.005, FEW, MAX, N | C, 0},
    {"memory T/64", memory, 1.0 / 64, 1.0 / 64, FEW, MAX, N | C, 0},
    {"memory T/50", memory, 0.02, 0.02, FEW, MAX, N | C, 0},
    {"memory T/32", memory, 1.0 / 32, 1.0 / 32, FEW, MAX, N | C, 0},
    {"memory T/16", memory, 1.0 / 16, 1.0 / 16, FEW, MAX, N | C, 0},
    {"memory T/10", memory, 0.1, 0.1, FEW, MAX, N | C, 0},
    {"memory T/8", memory, 0.125, 0.125, FEW, MAX, N, 0},
    {"Student, 3", student, 0, 0, FEW, MAX, N, 0},
    {"oscillation, 3 periods on", oscillation, 3, 3, FEW, MAX, N, 0},
    {"oscillation, 10 periods on", oscillation, 10, 10, FEW, MAX, N | D, 0},
    {"tone without noise", clean_tone, 10, 300, FEW, MAX, N | D, 0},
    {"1 - cos without noise", clean_cosine, 10, 300, FEW, MAX, N | D, 0},
    {"quasi-periodic", quasi_periodic, 4, 40, FEW, MAX, N, 0},
    {"sawtooth", sawtooth, 4, 50, FEW, MAX, N, 0},
    {"switches", switches, 0.002, 0.02, FEW, MAX, N, 0},
    {"intermittent", intermittent, 0.005, 0.05, FEW, MAX, N, 0},
    {"laminar phases", laminar, 1.3, 1.8, FEW, MAX, N, 0},
    {"logistic map", logistic, 3.9, 4.0, FEW, MAX, N, 0},
    {"Lorenz", lorenz, 0, 0, 5000, MAX, N, 0},
    {"slow wave", slow_wave, 0.3, 2.0, FEW, MAX, N, 0},
    {"beat longer than T", beat, 0.1, 0.95, FEW, MAX, N, 0},
    {"dying oscillation", dying, 3, 20, FEW, MAX, N | S, 0},
    {"step", step_clean, 0.1, 0.9, FEW, MAX, S, 0},
    {"step under noise", step_noise, 0.1, 0.9, FEW, MAX, S, 0},
    {"step under tones", step_tones, 0.1, 0.9, FEW, MAX, S, 0},
    {"step, middle", step_clean, 0.3, 0.7, FEW, MAX, S | D, 0},
    {"step, middle, noise", step_noise, 0.3, 0.7, FEW, MAX, S | D, 0},
    {"step, middle, tones", step_tones, 0.3, 0.7, FEW, MAX, S | D, 0},
    {"decay, 1.5-4 e-folds", decay, 1.5, 4, FEW, MAX, S, 0},
    {"decay, 4-12 e-folds", decay, 4, 12, FEW, MAX, S, 0},
    {"decay, 12-100 e-folds", decay, 12, 100, FEW, MAX, S, 0},
    {"relaxation, tones", relaxation_tones, 5, 50, FEW, MAX, S, 0},
    {"relaxing truncation", truncation, 0, 0, FEW, MAX, S | TRUNCATION, 0},
    {"exponential, then level", saturating, 0.2, 0.8, FEW, MAX, S, 0},
    {"walk", walk, 0, 0, FEW, MAX, W | WALKS | C, 0},
    {"walk of roundings", rounding_walk, 0.3, 2, FEW, MAX, W | WALKS | C | ROUNDINGS, 0},
    {"walk under noise", walk_noise, 0.01, 0.3, FEW, MAX, W | WALKS | C, 0},
    {"walk under tones", walk_tones, 0.02, 0.2, FEW, MAX, W | WALKS | C, 0},
    {"line, SNR 10, tones", line_tones, 9, 11, FEW, MAX, L | D | C, 0},
    {"line, SNR 3, tones", line_tones, 2.7, 3.3, FEW, MAX, L | D | C, 0},
    {"line, SNR 1, tones", line_tones, 1.0, 1.1, FEW, MAX, L | D | C, 0},
    {"line, SNR 0.3, tones", line_tones, 0.27, 0.33, FEW, MAX, L | C, 0},
    {"line, SNR 0.1, tones", line_tones, 0.1, 0.11, FEW, MAX, L | C, 0},
    {"line, SNR 10, white", line_white, 9, 11, FEW, MAX, L | D | C, 0},
    {"line, SNR 1, white", line_white, 1.0, 1.1, FEW, MAX, L | C, 0},
    {"line, SNR 1, white, long", line_white, 1.0, 1.1, MANY, MAX, L | D | C, 0},
    {"line, SNR 0.15, white", line_white, 0.14, 0.16, FEW, MAX, L | C, 0},
    {"line, SNR 0.1, white, long", line_white, 0.1, 0.11, MANY, MAX, L | C, 0},
    {"line, SNR 3, memory", line_memory, 2.5, 3.5, FEW, MAX, L | C, 0},
    {"line of roundings", line_rounding, 0.03, 1, FEW, MAX, L | W | C | ROUNDINGS, 0},
    {"t^0.3 .. t^0.8", power, 0.3, 0.8, FEW, MAX, P, 0},
    {"t^1.5", power, 1.5, 1.5, FEW, MAX, P | D, 0},
    {"t^2", power, 2, 2, FEW, MAX, P | D, 0},
    {"t^1.5, tones", power_tones, 1.5, 1.5, FEW, MAX, P | D, 0},
    {"t^2, tones", power_tones, 2, 2, FEW, MAX, P | D, 0},
    {"t^1.25 .. t^3", power, 1.25, 3, FEW, MAX, P, 0},
    {"t^3 .. t^6", power, 3, 6, FEW, MAX, P, 0},
    {"log t", logarithm, 0, 0, FEW, MAX, LOG, 0},
    {"exponential", exponential, 3, 25, FEW, MAX, E | D, 0},
    {"exponential, noise too", exponential_in_proportion, 3, 25, FEW, MAX, E | D, 0},
    {"grows like t", growing_power, 1, 1, FEW, MAX, G, 0},
    {"grows like t^p", growing_power, 0.7, 3, FEW, MAX, G, 0},
    {"grows exponentially", growing_exponential, 3, 15, FEW, MAX, G, 0},
};
const int series_kind_count = sizeof series_kinds / sizeof series_kinds[0];

const double series_noise[SERIES_NOISES] = {0.0, 0.05, 0.3};

/* Begins series number `number` of a kind. */
static void begin(const series_kind *kind, uint64_t number, double *x, series *s)
{
    uint64_t seed = number * 1000003u;
    for (const char *c = kind->name; *c; c++) seed = seed * 31 + (unsigned char)*c;
    *s = (series){.random = seed, .x = x, .exponent = NAN, .from = kind->from, .to = kind->to};
    series_next(&s->random);
}

static void generate(const series_kind *kind, series *s)
{
    memset(s->x, 0, (size_t)s->count * sizeof *s->x);
    kind->generate(s);
}

void series_draw(const series_kind *kind, uint64_t number, double *x, series *s)
{
    begin(kind, number, x, s);
    s->count = (int)series_log_between(&s->random, kind->min_count, kind->max_count);
    if (series_next(&s->random) % 64 == 0)
        s->count = (int)series_log_between(&s->random, kind->max_count, SERIES_CAPACITY - 1);
    generate(kind, s);
}

void series_draw_values(const series_kind *kind, uint64_t number, int count, double noise,
                        double *x, series *s)
{
    begin(kind, number, x, s);
    s->count = count;
    generate(kind, s);
    if (noise > 0.0) series_add_white(s, noise);
}
