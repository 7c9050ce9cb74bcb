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

static double sign(series *s) { return series_next(&s->random) & 1 ? 1.0 : -1.0; }
static double uniform(series *s, double a, double b) { return series_between(&s->random, a, b); }
static double log_uniform(series *s, double a, double b)
{
    return series_log_between(&s->random, a, b);
}
static double parameter(series *s) { return uniform(s, s->from, s->to); }
static double place(const series *s, int k) { return (double)k / (s->count - 1); }

/* ---- parts of a series ---- */

static void add_white(series *s, double size)
{
    for (int k = 0; k < s->count; k++) s->x[k] += size * series_normal(&s->random);
}

/* Noise of variance 1 and memory m T, times size. */
static void add_memory(series *s, double memory, double size)
{
    const double keep = exp(-1.0 / (memory * s->count)), fresh = sqrt(1.0 - keep * keep);
    double a = series_normal(&s->random);
    for (int k = 0; k < s->count; k++) {
        s->x[k] += size * a;
        a = keep * a + fresh * series_normal(&s->random);
    }
}

static void add_walk(series *s, double size)
{
    double a = 0.0;
    for (int k = 0; k < s->count; k++) {
        s->x[k] += size * a;
        a += series_normal(&s->random);
    }
}

static void add_line(series *s, double drift)
{
    s->drift += drift;
    for (int k = 0; k < s->count; k++) s->x[k] += drift * place(s, k);
}

static void add_tone(series *s, double size, double periods, double phase)
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
static void add_tones(series *s, double size, double periods)
{
    const int tones = 1 + (int)(series_next(&s->random) % 3);
    for (int i = 0; i < tones; i++)
        add_tone(s, size * (i ? uniform(s, 0.1, 1.0) : 1.0),
                 log_uniform(s, periods, 0.2 * s->count), uniform(s, 0.0, two_pi));
}

static double deviation(const series *s)
{
    double mean = 0.0, square = 0.0;
    for (int k = 0; k < s->count; k++) mean += s->x[k] / s->count;
    for (int k = 0; k < s->count; k++) square += (s->x[k] - mean) * (s->x[k] - mean) / s->count;
    return sqrt(square);
}

/* ---- no trend ---- */

static void white(series *s) { add_white(s, 1.0); }
static void memory(series *s) { add_memory(s, parameter(s), 1.0); }

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
    add_tones(s, 1.0, s->from);
    add_white(s, log_uniform(s, 1e-4, 0.3));
}

static void clean_tone(series *s)
{
    add_tone(s, 1.0, log_uniform(s, s->from, fmin(s->to, 0.2 * s->count)), uniform(s, 0.0, two_pi));
}

static void clean_cosine(series *s)
{
    add_tone(s, -1.0, log_uniform(s, s->from, fmin(s->to, 0.2 * s->count)), 0.0);
}

static void quasi_periodic(series *s)
{
    const double periods = uniform(s, s->from, s->to);
    add_tone(s, 1.0, periods, uniform(s, 0.0, two_pi));
    add_tone(s, uniform(s, 0.2, 1.0), periods * 1.618033988749895, uniform(s, 0.0, two_pi));
    add_tone(s, uniform(s, 0.2, 1.0), periods * 1.4142135623730951, uniform(s, 0.0, two_pi));
    add_tone(s, uniform(s, 0.2, 1.0), periods * 7.38905609893065, uniform(s, 0.0, two_pi));
}

static void sawtooth(series *s)
{
    const double periods = parameter(s), phase = uniform(s, 0.0, 1.0);
    for (int k = 0; k < s->count; k++) s->x[k] = fmod(periods * place(s, k) + phase, 1.0);
    add_white(s, log_uniform(s, 1e-4, 0.1));
}

/* Two states of exponential durations of mean (from..to) T. */
static void switches(series *s)
{
    const double rate = 1.0 / (parameter(s) * s->count);
    double state = sign(s);
    for (int k = 0; k < s->count; k++) {
        if (uniform(s, 0.0, 1.0) < rate) state = -state;
        s->x[k] = state;
    }
    add_white(s, log_uniform(s, 1e-3, 0.5));
}

/* Bursts: noise that is large in a tenth of the time. */
static void intermittent(series *s)
{
    const double rate = 1.0 / (parameter(s) * s->count), calm_size = uniform(s, 0.01, 0.3);
    int bursts = 0;
    for (int k = 0; k < s->count; k++) {
        if (uniform(s, 0.0, 1.0) < (bursts ? 5.0 : 1.0) * rate) bursts = !bursts;
        s->x[k] = (bursts ? 1.0 : calm_size) * series_normal(&s->random);
    }
}

/* Pomeau and Manneville: z -> z + z^a mod 1. */
static void laminar(series *s)
{
    const double power = parameter(s);
    double z = uniform(s, 0.1, 0.9);
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
        const double a = parameter(s);
        double z = uniform(s, 0.1, 0.9);
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
    double u[] = {uniform(s, -5.0, 5.0), uniform(s, -5.0, 5.0), uniform(s, 15.0, 30.0)};
    const int which = (int)(series_next(&s->random) % 3);
    for (int k = -2000; k < s->count; k++) {
        lorenz_step(u, 0.01);
        if (k >= 0) s->x[k] = u[which];
    }
}

/* Slower than can be recognised: from..to periods. */
static void slow_wave(series *s)
{
    add_tone(s, 1.0, parameter(s), uniform(s, 0.0, two_pi));
    add_white(s, log_uniform(s, 1e-3, 0.1));
}

/* Two tones whose beat lasts longer than the series. */
static void beat(series *s)
{
    const double periods = log_uniform(s, 20.0, 0.1 * s->count), b = parameter(s);
    add_tone(s, 1.0, periods, uniform(s, 0.0, two_pi));
    add_tone(s, uniform(s, 0.7, 1.0), periods + b, uniform(s, 0.0, two_pi));
    add_white(s, log_uniform(s, 1e-3, 0.03));
}

static void dying(series *s)
{
    const double rate = parameter(s), phase = uniform(s, 0.0, two_pi);
    const double periods = log_uniform(s, 10.0, 0.1 * s->count);
    for (int k = 0; k < s->count; k++)
        s->x[k] = exp(-rate * place(s, k)) * cos(two_pi * periods * place(s, k) + phase);
    add_white(s, log_uniform(s, 1e-4, 1e-2));
}

/* ---- changes that settle ---- */

static void add_step(series *s)
{
    const double c = parameter(s), height = sign(s);
    const double w = fmin(log_uniform(s, 1e-4, 0.08), 0.6 * (1.0 - c));
    for (int k = 0; k < s->count; k++)
        s->x[k] += 0.5 * height * (1.0 + tanh((place(s, k) - c) / w));
}

static void step_clean(series *s) { add_step(s); }

static void step_noise(series *s)
{
    add_step(s);
    add_white(s, log_uniform(s, 1e-3, 0.2));
}

static void step_tones(series *s)
{
    add_step(s);
    add_tones(s, uniform(s, 0.02, 0.4), 10.0);
    add_white(s, log_uniform(s, 1e-4, 0.05));
}

/* By from..to e-folds. */
static void decay(series *s)
{
    const double rate = parameter(s), height = sign(s);
    for (int k = 0; k < s->count; k++) s->x[k] = height * exp(-rate * place(s, k));
    add_white(s, log_uniform(s, 1e-4, 0.1));
}

static void relaxation_tones(series *s)
{
    decay(s);
    add_tones(s, uniform(s, 0.02, 0.3), 10.0);
}

/* Grows exponentially, then saturates near s = from..to. */
static void saturating(series *s)
{
    const double c = parameter(s), rate = uniform(s, 20.0, 80.0), sharp = uniform(s, 0.5, 2.0);
    for (int k = 0; k < s->count; k++) s->x[k] = pow(1.0 + exp(-rate * (place(s, k) - c)), -sharp);
    add_white(s, log_uniform(s, 1e-4, 0.05));
}

/* ---- walks ---- */

static void walk(series *s) { add_walk(s, 1.0); }

/* Of roundings of numbers near 1: steps on the grid of doubles. */
static void rounding_walk(series *s)
{
    const double size = parameter(s);
    double a = 1.0;
    for (int k = 0; k < s->count; k++) {
        s->x[k] = a;
        a += size * 0x1p-52 * series_normal(&s->random);
    }
}

static void walk_noise(series *s)
{
    add_walk(s, 1.0 / sqrt(s->count));
    add_white(s, parameter(s));
}

static void walk_tones(series *s)
{
    add_walk(s, 1.0 / sqrt(s->count));
    add_tones(s, parameter(s), 10.0);
}

/* A truncation error that relaxes smoothly, among roundings of numbers near 1. */
static void truncation(series *s)
{
    const double size = sign(s) * log_uniform(s, 5e-12, 5e-10), rate = uniform(s, 4.0, 30.0);
    for (int k = 0; k < s->count; k++)
        s->x[k] = 1.0 + size * (1.0 - exp(-rate * place(s, k))) +
                  0.5 * 0x1p-52 * series_normal(&s->random);
}

/* ---- lines ---- */

/* SNR = drift / (2 deviations of the rest) = from..to. */
static void line_tones(series *s)
{
    add_tones(s, 1.0, 3.0);
    add_white(s, log_uniform(s, 1e-4, 0.3));
    add_line(s, sign(s) * 2.0 * deviation(s) * parameter(s));
}

static void line_white(series *s)
{
    add_white(s, 1.0);
    add_line(s, sign(s) * 2.0 * parameter(s));
}

static void line_memory(series *s)
{
    add_memory(s, log_uniform(s, 0.001, 0.1), 1.0);
    add_line(s, sign(s) * 2.0 * parameter(s));
}

/* Biased rounding: a walk of eps with a mean step of from..to eps. */
static void line_rounding(series *s)
{
    const double bias = sign(s) * parameter(s) * 0x1p-52;
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
    s->exponent = parameter(s);
    const double height = sign(s);
    for (int k = 0; k < s->count; k++) s->x[k] = height * pow(place(s, k), s->exponent);
    add_white(s, log_uniform(s, 1e-4, 0.05));
}

static void power_tones(series *s)
{
    s->exponent = parameter(s);
    add_tones(s, uniform(s, 0.01, 0.2), 10.0);
    for (int k = 0; k < s->count; k++) s->x[k] += pow(place(s, k), s->exponent);
}

static void logarithm(series *s)
{
    const double height = sign(s), scale = log(s->count);
    for (int k = 0; k < s->count; k++) s->x[k] = height * log(1.0 + k) / scale;
    add_white(s, log_uniform(s, 1e-4, 0.02));
}

static void exponential(series *s)
{
    const double rate = parameter(s), height = sign(s);
    for (int k = 0; k < s->count; k++) s->x[k] = height * exp(rate * (place(s, k) - 1.0));
    add_white(s, log_uniform(s, 1e-4, 0.05));
}

static void exponential_in_proportion(series *s)
{
    const double rate = parameter(s), height = sign(s), noise = log_uniform(s, 1e-4, 0.3);
    for (int k = 0; k < s->count; k++)
        s->x[k] =
            height * exp(rate * (place(s, k) - 1.0)) * (1.0 + noise * series_normal(&s->random));
}

/* ---- oscillations that grow ---- */

static void modulate_noise(series *s) { add_white(s, log_uniform(s, 1e-4, 1e-2)); }

static void growing_power(series *s)
{
    const double p = parameter(s), phase = uniform(s, 0.0, two_pi);
    const double periods = log_uniform(s, 15.0, 0.2 * s->count);
    for (int k = 0; k < s->count; k++)
        s->x[k] = pow(place(s, k), p) * cos(two_pi * periods * place(s, k) + phase);
    modulate_noise(s);
}

static void growing_exponential(series *s)
{
    const double rate = parameter(s), phase = uniform(s, 0.0, two_pi);
    const double periods = log_uniform(s, 15.0, 0.2 * s->count);
    for (int k = 0; k < s->count; k++)
        s->x[k] = exp(rate * (place(s, k) - 1.0)) * cos(two_pi * periods * place(s, k) + phase);
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
    {"white", white, 0, 0, FEW, MAX, N | C},
    {"white, long", white, 0, 0, MANY, MAX, N | D | C},
    {"memory T/1000", memory, 0.001, 0.001, FEW, MAX, N | C},
    {"memory T/200", memory, 0.005, 0.005, FEW, MAX, N | C},
    {"memory T/64", memory, 1.0 / 64, 1.0 / 64, FEW, MAX, N | C},
    {"memory T/50", memory, 0.02, 0.02, FEW, MAX, N | C},
    {"memory T/32", memory, 1.0 / 32, 1.0 / 32, FEW, MAX, N | C},
    {"memory T/16", memory, 1.0 / 16, 1.0 / 16, FEW, MAX, N | C},
    {"memory T/10", memory, 0.1, 0.1, FEW, MAX, N | C},
    {"memory T/8", memory, 0.125, 0.125, FEW, MAX, N},
    {"Student, 3", student, 0, 0, FEW, MAX, N},
    {"oscillation, 3 periods on", oscillation, 3, 3, FEW, MAX, N},
    {"oscillation, 10 periods on", oscillation, 10, 10, FEW, MAX, N | D},
    {"tone without noise", clean_tone, 10, 300, FEW, MAX, N | D},
    {"1 - cos without noise", clean_cosine, 10, 300, FEW, MAX, N | D},
    {"quasi-periodic", quasi_periodic, 4, 40, FEW, MAX, N},
    {"sawtooth", sawtooth, 4, 50, FEW, MAX, N},
    {"switches", switches, 0.002, 0.02, FEW, MAX, N},
    {"intermittent", intermittent, 0.005, 0.05, FEW, MAX, N},
    {"laminar phases", laminar, 1.3, 1.8, FEW, MAX, N},
    {"logistic map", logistic, 3.9, 4.0, FEW, MAX, N},
    {"Lorenz", lorenz, 0, 0, 5000, MAX, N},
    {"slow wave", slow_wave, 0.3, 2.0, FEW, MAX, N},
    {"beat longer than T", beat, 0.1, 0.95, FEW, MAX, N},
    {"dying oscillation", dying, 3, 20, FEW, MAX, N | S},
    {"step", step_clean, 0.1, 0.9, FEW, MAX, S},
    {"step under noise", step_noise, 0.1, 0.9, FEW, MAX, S},
    {"step under tones", step_tones, 0.1, 0.9, FEW, MAX, S},
    {"step, middle", step_clean, 0.3, 0.7, FEW, MAX, S | D},
    {"step, middle, noise", step_noise, 0.3, 0.7, FEW, MAX, S | D},
    {"step, middle, tones", step_tones, 0.3, 0.7, FEW, MAX, S | D},
    {"decay, 1.5-4 e-folds", decay, 1.5, 4, FEW, MAX, S},
    {"decay, 4-12 e-folds", decay, 4, 12, FEW, MAX, S},
    {"decay, 12-100 e-folds", decay, 12, 100, FEW, MAX, S},
    {"relaxation, tones", relaxation_tones, 5, 50, FEW, MAX, S},
    {"relaxing truncation", truncation, 0, 0, FEW, MAX, S | TRUNCATION},
    {"exponential, then level", saturating, 0.2, 0.8, FEW, MAX, S},
    {"walk", walk, 0, 0, FEW, MAX, W | WALKS | C},
    {"walk of roundings", rounding_walk, 0.3, 2, FEW, MAX, W | WALKS | C | ROUNDINGS},
    {"walk under noise", walk_noise, 0.01, 0.3, FEW, MAX, W | WALKS | C},
    {"walk under tones", walk_tones, 0.02, 0.2, FEW, MAX, W | WALKS | C},
    {"line, SNR 10, tones", line_tones, 9, 11, FEW, MAX, L | D | C},
    {"line, SNR 3, tones", line_tones, 2.7, 3.3, FEW, MAX, L | D | C},
    {"line, SNR 1, tones", line_tones, 1.0, 1.1, FEW, MAX, L | D | C},
    {"line, SNR 0.3, tones", line_tones, 0.27, 0.33, FEW, MAX, L | C},
    {"line, SNR 0.1, tones", line_tones, 0.1, 0.11, FEW, MAX, L | C},
    {"line, SNR 10, white", line_white, 9, 11, FEW, MAX, L | D | C},
    {"line, SNR 1, white", line_white, 1.0, 1.1, FEW, MAX, L | C},
    {"line, SNR 1, white, long", line_white, 1.0, 1.1, MANY, MAX, L | D | C},
    {"line, SNR 0.15, white", line_white, 0.14, 0.16, FEW, MAX, L | C},
    {"line, SNR 0.1, white, long", line_white, 0.1, 0.11, MANY, MAX, L | C},
    {"line, SNR 3, memory", line_memory, 2.5, 3.5, FEW, MAX, L | C},
    {"line of roundings", line_rounding, 0.03, 1, FEW, MAX, L | W | C | ROUNDINGS},
    {"t^0.3 .. t^0.8", power, 0.3, 0.8, FEW, MAX, P},
    {"t^1.5", power, 1.5, 1.5, FEW, MAX, P | D},
    {"t^2", power, 2, 2, FEW, MAX, P | D},
    {"t^1.5, tones", power_tones, 1.5, 1.5, FEW, MAX, P | D},
    {"t^2, tones", power_tones, 2, 2, FEW, MAX, P | D},
    {"t^1.25 .. t^3", power, 1.25, 3, FEW, MAX, P},
    {"t^3 .. t^6", power, 3, 6, FEW, MAX, P},
    {"log t", logarithm, 0, 0, FEW, MAX, LOG},
    {"exponential", exponential, 3, 25, FEW, MAX, E | D},
    {"exponential, noise too", exponential_in_proportion, 3, 25, FEW, MAX, E | D},
    {"grows like t", growing_power, 1, 1, FEW, MAX, G},
    {"grows like t^p", growing_power, 0.7, 3, FEW, MAX, G},
    {"grows exponentially", growing_exponential, 3, 15, FEW, MAX, G},
};
const int series_kind_count = sizeof series_kinds / sizeof series_kinds[0];

void series_draw(const series_kind *kind, uint64_t number, double *x, series *s)
{
    uint64_t seed = number * 1000003u;
    for (const char *c = kind->name; *c; c++) seed = seed * 31 + (unsigned char)*c;
    *s = (series){.random = seed, .x = x, .exponent = NAN, .from = kind->from, .to = kind->to};
    series_next(&s->random);
    s->count = (int)series_log_between(&s->random, kind->min_count, kind->max_count);
    if (series_next(&s->random) % 64 == 0)
        s->count = (int)series_log_between(&s->random, kind->max_count, SERIES_CAPACITY - 1);
    memset(x, 0, (size_t)s->count * sizeof *x);
    kind->generate(s);
}

/* ---- trends ---- */

int trend_is_consistent(const dal_trend *f)
{
    const int has_zero = f->rate_low <= 0.0 && f->rate_high >= 0.0;
    if (!(f->confidence > 0.0 && f->confidence <= 1.0)) return 0;
    if (!(f->rate_low <= f->rate && f->rate <= f->rate_high)) return 0;
    if ((f->size == DAL_SIZE_EXACT) != (f->deviation == 0.0)) return 0;
    if (f->amplitude > 1.001 * (f->deviation + f->max_drift)) return 0;
    switch (f->trend) {
    case DAL_TREND_NONE:
        return has_zero && f->exponent == 0.0;
    case DAL_TREND_SETTLES:
        return f->exponent == 0.0;
    case DAL_TREND_RANDOM_WALK:
        return has_zero && f->exponent == 0.5;
    case DAL_TREND_LINEAR:
        return !has_zero && f->exponent == 1.0;
    case DAL_TREND_POWER:
        return f->exponent >= 0.0 && f->exponent != 1.0;
    default:
        return isnan(f->exponent);
    }
}
