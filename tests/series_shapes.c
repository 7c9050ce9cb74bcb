/* series_shapes.c - series of one shape without noise and under white noise of two sizes.
 *
 * Most have a range near 1, to which the size of the noise is relative.  Half of them are compounds
 * and shapes that the classifier has no name for: they are right where they are undecided, or where
 * the word still says what the series does. */
#include "series.h"
#include <math.h>

static const double two_pi = 6.283185307179586;

typedef double shape_value(double s, const double *a);

/* x_k = f(s; a). */
static void fill(series *s, shape_value *f, const double *a)
{
    for (int k = 0; k < s->count; k++) s->x[k] += f(series_place(s, k), a);
}

static double soft_step(double s, const double *a)
{
    return 0.5 * a[2] * (1.0 + tanh((s - a[0]) / a[1]));
}
static double relaxation(double s, const double *a) { return -a[1] * exp(-s / a[0]); }
static double exponential(double s, const double *a) { return a[1] * exp(a[0] * (s - 1.0)); }

static double carrier(double s, const double *a) { return cos(two_pi * a[0] * s + a[1]); }

/* Draws a carrier of 15 periods and more. */
static void draw_carrier(series *s, double *a)
{
    a[0] = series_log_uniform(s, 15.0, 0.2 * s->count);
    a[1] = series_uniform(s, 0.0, two_pi);
}

/* Multiplies what there is by a carrier. */
static void modulate(series *s)
{
    double a[2];
    draw_carrier(s, a);
    for (int k = 0; k < s->count; k++) s->x[k] *= carrier(series_place(s, k), a);
}

/* ---- a line and more ---- */

static void line_step(series *s)
{
    const double a[] = {series_uniform(s, 0.15, 0.85), 1e-5,
                        series_sign(s) * series_uniform(s, 0.3, 1.3)};
    fill(s, soft_step, a);
    series_add_line(s, series_sign(s));
}

static void line_soft_step(series *s)
{
    const double a[] = {series_uniform(s, 0.2, 0.8), series_uniform(s, 0.01, 0.06),
                        series_uniform(s, 0.3, 1.3)};
    fill(s, soft_step, a);
    series_add_line(s, 1.0);
}

static void line_relaxation(series *s)
{
    const double a[] = {series_log_uniform(s, 0.01, 0.1), series_uniform(s, 0.3, 1.3)};
    fill(s, relaxation, a);
    series_add_line(s, 1.0);
}

static void line_exponential(series *s)
{
    const double a[] = {series_uniform(s, 5.0, 12.0), series_uniform(s, 0.3, 1.3)};
    fill(s, exponential, a);
    series_add_line(s, 1.0);
}

static void line_growing(series *s)
{
    series_add_line(s, series_uniform(s, 0.2, 0.6));
    modulate(s);
    series_add_line(s, 1.0);
    s->drift = 1.0;
}

static double stairs_value(double s, const double *a) { return floor(a[0] * s + a[1]) / a[0]; }

static void stairs(series *s)
{
    const double a[] = {series_parameter(s), series_uniform(s, 0.0, 1.0)};
    fill(s, stairs_value, a);
    s->drift = 1.0;
}

static double kink_value(double s, const double *a)
{
    return s < a[0] ? s : a[0] + a[1] * (s - a[0]);
}

static void kink(series *s)
{
    const double a[] = {series_uniform(s, 0.3, 0.7), series_uniform(s, 2.0, 4.0)};
    fill(s, kink_value, a);
}

static void line_slow_tone(series *s)
{
    series_add_line(s, 1.0);
    series_add_tone(s, 0.3, series_uniform(s, 1.2, 2.5), series_uniform(s, 0.0, two_pi));
}

static void line_growing_noise(series *s)
{
    for (int k = 0; k < s->count; k++)
        s->x[k] += 0.3 * series_place(s, k) * series_normal(&s->random);
    series_add_line(s, 1.0);
}

/* ---- changes ---- */

static void step(series *s)
{
    const double a[] = {series_uniform(s, 0.1, 0.8), series_log_uniform(s, 1e-4, 0.03),
                        series_sign(s)};
    fill(s, soft_step, a);
}

static void relaxation_of(series *s)
{
    const double a[] = {1.0 / series_parameter(s), 1.0};
    fill(s, relaxation, a);
}

static void exponential_of(series *s)
{
    const double a[] = {series_parameter(s), 1.0};
    fill(s, exponential, a);
}

static void two_relaxations(series *s)
{
    const double a[] = {1.0 / 30.0, series_uniform(s, 0.3, 1.0)};
    const double b[] = {1.0 / 5.0, series_uniform(s, 0.3, 1.0)};
    fill(s, relaxation, a);
    fill(s, relaxation, b);
}

static void two_steps(series *s)
{
    const double a[] = {series_uniform(s, 0.15, 0.4), 1e-4, 0.5};
    const double b[] = {series_uniform(s, 0.5, 0.75), 1e-4, series_uniform(s, 0.2, 0.5)};
    fill(s, soft_step, a);
    fill(s, soft_step, b);
}

static double ring_value(double s, const double *a)
{
    return s < a[0] ? 0.0 : 1.0 - exp(-(s - a[0]) / a[1]) * cos(two_pi * (s - a[0]) / a[2]);
}

static void ring(series *s)
{
    const double tau = series_log_uniform(s, 0.01, 0.05);
    const double a[] = {series_uniform(s, 0.1, 0.5), tau, tau * series_uniform(s, 0.3, 1.5)};
    fill(s, ring_value, a);
}

static void ring_down(series *s)
{
    const double tau = series_log_uniform(s, 0.01, 0.08);
    const double a[] = {-1e-9, tau, tau * series_uniform(s, 0.3, 1.5)}, b[] = {tau, 1.0};
    fill(s, ring_value, a);
    fill(s, relaxation, b);
}

static double ramp_value(double s, const double *a)
{
    return fmin(fmax((s - a[0]) / (a[1] - a[0]), 0.0), 1.0);
}

static void ramp_then_level(series *s)
{
    const double a[] = {0.0, series_uniform(s, 0.3, 0.7)};
    fill(s, ramp_value, a);
}

static void level_then_ramp(series *s)
{
    const double a[] = {series_uniform(s, 0.3, 0.7), 1.0};
    fill(s, ramp_value, a);
}

static double overshoot_value(double s, const double *a)
{
    return 1.0 - exp(-s / a[0]) + a[2] * exp(-s / a[1]) * s / a[1];
}

static void overshoot(series *s)
{
    const double tau = series_uniform(s, 0.01, 0.03);
    const double a[] = {tau, tau * series_uniform(s, 2.0, 4.0), series_uniform(s, 0.5, 1.5)};
    fill(s, overshoot_value, a);
}

static double bump_value(double s, const double *a)
{
    const double d = (s - a[0]) / a[1];
    return exp(-0.5 * d * d);
}

static void bump(series *s)
{
    const double a[] = {series_uniform(s, 0.3, 0.7), series_uniform(s, 0.05, 0.2)};
    fill(s, bump_value, a);
}

static void pulse(series *s)
{
    const double from = series_uniform(s, 0.1, 0.6), width = series_uniform(s, 0.1, 0.3);
    const double a[] = {from, 1e-5, 1.0}, b[] = {from + width, 1e-5, -1.0};
    fill(s, soft_step, a);
    fill(s, soft_step, b);
}

static void step_louder(series *s)
{
    const double a[] = {series_uniform(s, 0.2, 0.7), 1e-5, 1.0};
    for (int k = 0; k < s->count; k++)
        s->x[k] += (series_place(s, k) < a[0] ? 0.03 : 0.06) * series_normal(&s->random);
    fill(s, soft_step, a);
}

static double logistic_value(double s, const double *a)
{
    return 1.0 / (1.0 + exp(-a[1] * (s - a[0])));
}

/* A saturation of which the last half is not there. */
static void unfinished(series *s)
{
    const double a[] = {series_uniform(s, 0.8, 0.95), series_uniform(s, 8.0, 15.0)};
    fill(s, logistic_value, a);
}

static double hyperbola(double s, const double *a) { return 1.0 / (1.0 + s / a[0]); }

static void hyperbolic(series *s)
{
    const double a[] = {series_parameter(s)};
    fill(s, hyperbola, a);
}

static double pole(double s, const double *a) { return (a[0] - 1.0) / (a[0] - s); }

static void blow_up(series *s)
{
    const double a[] = {series_uniform(s, 1.05, 1.3)};
    fill(s, pole, a);
}

static double square_root_and_line(double s, const double *a) { return sqrt(s) + a[0] * s; }

/* Near s^p, p = 1/2 .. 1. */
static void two_powers(series *s)
{
    const double a[] = {series_uniform(s, 0.5, 1.5)};
    s->exponent = 0.7;
    fill(s, square_root_and_line, a);
}

/* ---- amplitudes ---- */

static void amplitude_linear(series *s)
{
    series_add_line(s, 1.0);
    s->drift = 0.0;
    modulate(s);
}

static void amplitude_exponential(series *s)
{
    const double a[] = {series_parameter(s), 1.0};
    fill(s, exponential, a);
    modulate(s);
}

static void beat_from_node(series *s)
{
    series_add_tone(s, 1.0, 0.5 / series_parameter(s), -0.25 * two_pi);
    modulate(s);
}

static void long_beat(series *s)
{
    series_add_tone(s, 1.0, 0.5 / series_parameter(s), series_uniform(s, 0.0, two_pi));
    modulate(s);
}

static double saturation(double s, const double *a) { return tanh(s / a[0]); }

static void amplitude_saturates(series *s)
{
    const double a[] = {series_uniform(s, 0.1, 0.3)};
    fill(s, saturation, a);
    modulate(s);
}

/* s^2 (1 + cos)/2: the mean and the amplitude grow alike. */
static void one_sided(series *s)
{
    double a[2];
    draw_carrier(s, a);
    s->exponent = 2.0;
    for (int k = 0; k < s->count; k++) {
        const double place = series_place(s, k);
        s->x[k] = 0.5 * place * place * (1.0 + carrier(place, a));
    }
}

/* ---- oscillations ---- */

static void slow_triangle(series *s)
{
    const double periods = series_parameter(s), phase = series_uniform(s, 0.0, 1.0);
    for (int k = 0; k < s->count; k++)
        s->x[k] = fabs(2.0 * fmod(periods * series_place(s, k) + phase, 1.0) - 1.0);
}

static void chirp(series *s)
{
    const double from = series_uniform(s, 10.0, 20.0), to = series_uniform(s, 30.0, 60.0);
    for (int k = 0; k < s->count; k++) {
        const double place = series_place(s, k);
        s->x[k] = 0.5 * sin(two_pi * (from + 0.5 * (to - from) * place) * place);
    }
}

static void square_wave(series *s)
{
    const double a[] = {series_log_uniform(s, 8.0, 40.0), series_uniform(s, 0.0, two_pi)};
    for (int k = 0; k < s->count; k++) s->x[k] = carrier(series_place(s, k), a) > 0.0 ? 0.5 : -0.5;
}

static void pulses(series *s)
{
    const double a[] = {series_log_uniform(s, 8.0, 40.0), series_uniform(s, 0.0, two_pi)};
    for (int k = 0; k < s->count; k++) s->x[k] = exp(20.0 * (carrier(series_place(s, k), a) - 1.0));
}

/* ---- noises ---- */

static void no_signal(series *s) { (void)s; }
static void memory(series *s) { series_add_memory(s, series_parameter(s), 1.0); }

static void louder(series *s)
{
    const double at = series_uniform(s, 0.3, 0.7), factor = series_uniform(s, 1.5, 3.0);
    for (int k = 0; k < s->count; k++)
        s->x[k] = (series_place(s, k) < at ? 0.3 : 0.3 * factor) * series_normal(&s->random);
}

static void fading(series *s)
{
    const double rate = series_uniform(s, 1.0, 3.0);
    for (int k = 0; k < s->count; k++)
        s->x[k] = exp(-rate * series_place(s, k)) * series_normal(&s->random);
}

static void modulated_noise(series *s)
{
    const double a[] = {series_uniform(s, 4.0, 20.0), series_uniform(s, 0.0, two_pi)};
    for (int k = 0; k < s->count; k++)
        s->x[k] = 0.3 * (1.0 + 0.8 * carrier(series_place(s, k), a)) * series_normal(&s->random);
}

static void differences(series *s)
{
    double before = series_normal(&s->random);
    for (int k = 0; k < s->count; k++) {
        const double now = series_normal(&s->random);
        s->x[k] = 0.3 * (now - before);
        before = now;
    }
}

static void spikes(series *s)
{
    series_add_white(s, 0.1);
    for (int i = 0; i < 12; i++)
        s->x[series_next(&s->random) % (uint64_t)s->count] += series_sign(s);
}

static void skewed(series *s)
{
    for (int k = 0; k < s->count; k++) {
        const double a = series_normal(&s->random);
        s->x[k] = 0.3 * a * a;
    }
}

/* A sum of noises of memories T/512 .. T/2 with equal variances. */
static void flicker(series *s)
{
    for (double m = 1.0 / 512; m < 0.6; m *= 2.0) series_add_memory(s, m, 0.3);
}

static void walk_in_a_box(series *s)
{
    const double size = series_uniform(s, 0.05, 0.15) * sqrt(s->count);
    double a = series_uniform(s, 0.0, size);
    for (int k = 0; k < s->count; k++) {
        a = fabs(a + series_normal(&s->random));
        a = a > size ? 2.0 * size - a : a;
        s->x[k] = a / size;
    }
}

/* Steps with the tail x^-1.5. */
static void levy_walk(series *s)
{
    double a = 0.0;
    for (int k = 0; k < s->count; k++) {
        s->x[k] = a;
        a += series_sign(s) * pow(series_uniform(s, 1e-9, 1.0), -1.0 / 1.5);
    }
}

static void telegraph(series *s)
{
    const double rate = series_parameter(s) / s->count;
    double state = 0.5;
    for (int k = 0; k < s->count; k++) {
        if (series_uniform(s, 0.0, 1.0) < rate) state = -state;
        s->x[k] = state;
    }
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
    U = ACCEPT_UNDECIDED,
    X = HARD,
    CLEAN = 1,
    SOME = 2,
    MUCH = 4,
    ALL = CLEAN | SOME | MUCH
};

#define SHAPE(name, generate, from, to, accepts, noises)                                           \
    {                                                                                              \
        name, generate, from, to, 0, 0, accepts, noises                                            \
    }

const series_kind shape_kinds[] = {
    /* shapes that have names, and compounds of them */
    SHAPE("line + step", line_step, 0, 0, L | U, ALL),
    SHAPE("line + soft step", line_soft_step, 0, 0, L | U, ALL),
    SHAPE("relaxation + line", line_relaxation, 0, 0, L | U, ALL),
    SHAPE("line + exponential", line_exponential, 0, 0, U, ALL),
    SHAPE("relaxations T/30, T/5", two_relaxations, 0, 0, S, ALL),
    SHAPE("step, .1-.8", step, 0, 0, S, ALL),
    SHAPE("decay, 3-8 e-folds", relaxation_of, 3, 8, S, ALL),
    SHAPE("exponential, 4-10", exponential_of, 4, 10, E, ALL),
    SHAPE("amplitude ~ t", amplitude_linear, 0, 0, G, ALL),
    SHAPE("amplitude exp, 2-6", amplitude_exponential, 2, 6, G, ALL),
    SHAPE("amplitude exp, 4-10", amplitude_exponential, 4, 10, G, ALL),
    SHAPE("beat of 1.1-2.9 T, node", beat_from_node, 1.1, 2.9, N | X, ALL),
    SHAPE("beat of 3 T", long_beat, 3, 3, N | X, ALL),
    SHAPE("white noise", no_signal, 0, 0, N, SOME),
    SHAPE("memory T/100", memory, 0.01, 0.01, N, CLEAN),
    SHAPE("memory T/50, again", memory, 0.02, 0.02, N, CLEAN),
    SHAPE("memory T/20", memory, 0.05, 0.05, N, CLEAN),
    SHAPE("two steps", two_steps, 0, 0, S | U, ALL),
    SHAPE("ringing step", ring, 0, 0, S, ALL),
    SHAPE("ramp, then level", ramp_then_level, 0, 0, S | U, ALL),
    SHAPE("level, then ramp", level_then_ramp, 0, 0, U, ALL),
    SHAPE("overshoot", overshoot, 0, 0, S | N, ALL),
    SHAPE("bump", bump, 0, 0, U, ALL),
    SHAPE("line, growing oscillation", line_growing, 0, 0, L, ALL),
    SHAPE("walk in a box", walk_in_a_box, 0, 0, W | N | U, CLEAN),
    SHAPE("flicker", flicker, 0, 0, W | N | U, CLEAN),
    SHAPE("Levy walk", levy_walk, 0, 0, W | U | X, CLEAN),
    SHAPE("telegraph, 3/T", telegraph, 3, 3, U | X, ALL),
    /* twenty and more that nothing names */
    SHAPE("slow triangle", slow_triangle, 0.6, 1.7, U, ALL),
    SHAPE("chirp", chirp, 0, 0, N, ALL),
    SHAPE("square wave", square_wave, 0, 0, N, ALL),
    SHAPE("pulse train", pulses, 0, 0, N, ALL),
    SHAPE("stairs", stairs, 10, 40, L, ALL),
    SHAPE("kink", kink, 0, 0, U, ALL),
    SHAPE("line, slow tone", line_slow_tone, 0, 0, L | U, ALL),
    SHAPE("line, growing noise", line_growing_noise, 0, 0, L, CLEAN | SOME),
    SHAPE("root + line", two_powers, 0, 0, P | U, ALL),
    SHAPE("pulse", pulse, 0, 0, U, ALL),
    SHAPE("step, louder after it", step_louder, 0, 0, S, CLEAN),
    SHAPE("unfinished saturation", unfinished, 0, 0, U, ALL),
    SHAPE("ring-down and decay", ring_down, 0, 0, S | N, ALL),
    SHAPE("hyperbola, T/200-T/50", hyperbolic, 0.005, 0.02, S | U, ALL),
    SHAPE("hyperbola, T/10-T/3", hyperbolic, 0.1, 0.33, U, ALL),
    SHAPE("pole beyond T", blow_up, 0, 0, U, ALL),
    SHAPE("amplitude saturates", amplitude_saturates, 0, 0, N | U, ALL),
    SHAPE("one-sided, t^2", one_sided, 0, 0, P | G, ALL),
    SHAPE("louder noise", louder, 0, 0, N, CLEAN),
    SHAPE("fading noise", fading, 0, 0, N, CLEAN),
    SHAPE("modulated noise", modulated_noise, 0, 0, N, CLEAN),
    SHAPE("differences of noise", differences, 0, 0, N, CLEAN),
    SHAPE("spikes", spikes, 0, 0, N, CLEAN),
    SHAPE("skewed noise", skewed, 0, 0, N, CLEAN),
    SHAPE("telegraph, 60/T", telegraph, 60, 60, N, ALL),
};
const int shape_kind_count = sizeof shape_kinds / sizeof shape_kinds[0];
