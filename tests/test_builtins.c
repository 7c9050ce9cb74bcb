/* test_builtins.c - every built-in system: its tags against its formulas, its exact solution
 * against a run, on (q,v) and on the lift. */
#include "motion.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static bool tagged(const dal_system *s, const char *tag)
{
    for (int i = 0; i < s->tags; i++)
        if (strcmp(s->tag[i], tag) == 0) return true;
    return false;
}

/* Says which system it was. */
static void expect(const dal_system *s, bool truth, const char *what)
{
    if (!truth) fprintf(stderr, "  %s: %s\n", s->name, what);
    CU_ASSERT(truth);
}

static void expect_tag(const dal_system *s, const char *tag, bool truth)
{
    expect(s, tagged(s, tag) == truth, tag);
}

static void each(void (*check)(const reference *b))
{
    for (int i = 0; dal_builtin_name(i); i++) {
        reference b = reference_builtin(dal_builtin_name(i));
        check(&b);
        reference_free(&b);
    }
}

/* ---- tags that the formulas decide ---- */

static void check_energy(const reference *b)
{
    expect(b->system, !b->system->call.potential || b->system->properties & DAL_MASS_CONSTANT,
           "a potential beside a W that is not constant");
    const dal_system *s = b->system;
    bool exact = s->properties & DAL_E_EXACT, weak = s->properties & DAL_E_ON_D;
    expect_tag(s, "energy-exact", exact);
    expect_tag(s, "energy-weak", weak);
    expect_tag(s, "energy-not-conserved", s->energy && !exact && !weak);
}

static bool moves_with_time(const reference *b)
{
    double q[REFERENCE_MAX] = {0.3, -0.4, 0.7, 0.2, -0.6, 0.5, 0.8, -0.1}, D[2][REFERENCE_MAX];
    double v[2 * REFERENCE_MAX] = {0.5, 0.9, -0.3, 0.6, 0.4, -0.7, 0.2, 1.1};
    if (!b->system->m) return false;
    for (int k = 0; k < 2; k++) reference_call(b, b->system->constraints, 0.4 * k, q, v, D[k]);
    return reference_distance(b->system->m, D[0], D[1]) > 0.0;
}

/* Whether D is a polynomial of q of degree 6 at most: its seventh differences along lines vanish,
 * to rounding; sines have some 1e-3. */
static bool is_polynomial(const reference *b)
{
    static const double weight[] = {1, -7, 21, -35, 35, -21, 7, -1};
    double q[REFERENCE_MAX], D[REFERENCE_MAX], sum[REFERENCE_MAX] = {0.0};
    double v[2 * REFERENCE_MAX] = {0.5, 0.9, -0.3, 0.6, 0.4, -0.7, 0.2, 1.1};
    for (int k = 0; k < 8; k++) {
        for (int i = 0; i < REFERENCE_MAX; i++) q[i] = 0.3 + (0.5 - 0.03 * i) * (k - 3.5);
        reference_call(b, b->system->constraints, 0.0, q, v, D);
        for (int a = 0; a < b->system->m; a++) sum[a] += weight[k] * D[a];
    }
    for (int a = 0; a < b->system->m; a++)
        if (fabs(sum[a]) > 1e-11) return false;
    return true;
}

static void check_constraint(const reference *b)
{
    const dal_system *s = b->system;
    unsigned p = s->properties;
    bool some = s->m > 0, moving = moves_with_time(b);
    bool low = p & (DAL_D_CONSTANT | DAL_D_BILINEAR | DAL_D_QUADRATIC);
    bool higher = some && (p & DAL_D_LINEAR) && !low && !moving;
    expect_tag(s, "linear", p & DAL_D_CONSTANT);
    expect_tag(s, "bilinear", (p & DAL_D_BILINEAR) && !(p & DAL_D_CONSTANT));
    expect_tag(s, "quadratic", (p & DAL_D_QUADRATIC) && !(p & DAL_D_BILINEAR));
    expect_tag(s, "polynomial", higher && is_polynomial(b));
    expect_tag(s, "trigonometric", higher && !is_polynomial(b));
    expect_tag(s, "nonlinear", some && !(p & DAL_D_LINEAR));
    expect_tag(s, "time-dependent", moving || !(p & DAL_AUTONOMOUS));
    expect_tag(s, "servo", p & DAL_SERVO);
}

/* Exactly one of the two first words, at most one of each later pair, and no word unknown. */
static void check_words(const reference *b)
{
    static const char *const words[] = {
        "reversible", "non-reversible", "integrable",    "chaotic",   "measure-preserving",
        "attractor",  "energy-exact",   "energy-weak",   "linear",    "energy-not-conserved",
        "bilinear",   "quadratic",      "trigonometric", "nonlinear", "time-dependent",
        "servo",      "singular",       "dissipative",   "paper",     "polynomial"};
    const dal_system *s = b->system;
    expect(s, tagged(s, words[0]) != tagged(s, words[1]), "reversible or not");
    expect(s, !tagged(s, words[2]) || !tagged(s, words[3]), "integrable or chaotic");
    expect(s, !tagged(s, words[4]) || !tagged(s, words[5]), "measure or attractor");
    for (int i = 0; i < s->tags; i++) {
        size_t k = 0, count = sizeof words / sizeof *words;
        while (k < count && strcmp(s->tag[i], words[k]) != 0) k++;
        expect(s, k < count, s->tag[i]);
    }
}

static void test_energy(void) { each(check_energy); }
static void test_constraint(void) { each(check_constraint); }
static void test_words(void) { each(check_words); }

/* ---- reversal and volume along the motion ---- */

/* Whether (q, -v, -g, -t) moves as (q, v, g, t) does and stays on D = 0; x is at time t. */
static double irreversibility(const reference *b, double t, const double *x)
{
    int n = b->system->n, nw = n + b->system->multipliers;
    double back[2 * REFERENCE_MAX], F[2][2 * REFERENCE_MAX], D[REFERENCE_MAX],
        zero[REFERENCE_MAX] = {0.0};
    for (int i = 0; i < nw; i++) back[i] = -x[n + i];
    reference_call(b, b->system->call.field, t, x, x + n, F[0]);
    reference_call(b, b->system->call.field, -t, x, back, F[1]);
    if (b->system->m) reference_call(b, b->system->constraints, -t, x, back, D);
    return fmax(reference_distance(nw, F[1], F[0]),
                b->system->m ? reference_distance(b->system->m, D, zero) : 0.0);
}

static void check_reversal(const reference *b)
{
    motion z = motion_default(b->system->name, 0.02);
    double max_error = 0.0;
    for (int k = 1; k <= 5; k++) {
        motion_advance(&z, 0.2 * k);
        max_error = fmax(max_error, irreversibility(b, 0.2 * k, z.x));
    }
    expect(b->system, max_error < 1e-12 || max_error > 1e-3, "reversal in doubt");
    expect_tag(b->system, "reversible", max_error < 1e-12);
    motion_close(&z);
}

static void test_reversal(void) { each(check_reversal); }

/* ---- what the motion keeps ---- */

/* The trace of the derivative of (v, F, g') by (q, v, g). */
static double divergence(const reference *b, double t, const double *x)
{
    int n = b->system->n, nw = n + b->system->multipliers;
    double out[REFERENCE_OUT], sum = 0.0;
    reference_call(b, b->system->call.jacobian, t, x, x + n, out);
    for (int i = 0; i < nw; i++) sum += out[nw * n + i * nw + i];
    return sum;
}

/* The logarithm of the volume follows an invariant density's, which may grow like log(t); on
 * the way to an attractor it falls like t.  Its change from t = 10 to 20, by the trapezoidal rule.
 */
static void check_volume(const reference *b)
{
    const dal_system *s = b->system;
    const double step = 0.02;
    double change = 0.0;
    if (!tagged(s, "measure-preserving") && !tagged(s, "attractor")) return;
    motion z = motion_default(s->name, step);
    for (int k = 0; k <= 1000; k++) {
        double weight = k < 500 ? 0.0 : k == 500 || k == 1000 ? step / 2 : step;
        change += weight * divergence(b, k * step, z.x);
        if (k < 1000) motion_advance(&z, (k + 1) * step);
    }
    expect(s, fabs(change) < 1.0 || change < -2.0, "volume in doubt");
    expect_tag(s, "measure-preserving", fabs(change) < 1.0);
    motion_close(&z);
}

/* The rate of E by differences on the line x + s dx/dt. */
static double energy_rate(const reference *b, double t, const double *x)
{
    static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280}, step = 0.005;
    int n = b->system->n, nw = n + b->system->multipliers;
    double y[3 * REFERENCE_MAX], slope[3 * REFERENCE_MAX], sum = 0.0, E;
    memcpy(slope, x + n, (size_t)n * sizeof *slope);
    reference_call(b, b->system->call.field, t, x, x + n, slope + n);
    for (int k = -4; k <= 4; k++) {
        if (k == 0) continue;
        for (int i = 0; i < n + nw; i++) y[i] = x[i] + k * step * slope[i];
        reference_call(b, b->system->energy, t + k * step, y, y + n, &E);
        sum += (k > 0 ? weight[k - 1] : -weight[-k - 1]) * E / step;
    }
    return sum;
}

/* E, as the properties say, on D = 0 and off it; and all invariants. */
static void check_kept(const reference *b)
{
    const dal_system *s = b->system;
    bool exact = s->properties & DAL_E_EXACT, weak = s->properties & DAL_E_ON_D;
    motion z = motion_default(s->name, 0.01);
    double E = s->energy ? motion_energy(&z) : 0.0, before[REFERENCE_MAX], x[3 * REFERENCE_MAX];
    for (int i = 0; i < s->invariants; i++) before[i] = motion_invariant(&z, i);
    motion_advance(&z, 1.0);
    for (int i = 0; i < s->invariants; i++) {
        double now = motion_invariant(&z, i);
        expect(s, reference_distance(1, &now, &before[i]) < 1e-12, s->invariant[i]);
    }
    double now = s->energy ? motion_energy(&z) : 0.0;
    if (s->energy)
        expect(s, (reference_distance(1, &now, &E) < 1e-12) == (exact || weak), "E on D = 0");
    for (int i = 0; i < 2 * s->n + s->multipliers; i++) x[i] = z.x[i] + 0.01 * (i + 1);
    if (s->energy) expect(s, (fabs(energy_rate(b, 1.0, x)) < 1e-9) == exact, "E off D = 0");
    motion_close(&z);
}

static void test_volume(void) { each(check_volume); }
static void test_kept(void) { each(check_kept); }

/* ---- exact solutions ---- */

static void check_run(const reference *b, dal_space space)
{
    int n = b->system->n;
    double exact[2 * REFERENCE_MAX], zero[2 * REFERENCE_MAX] = {0.0};
    motion z =
        motion_open(b->system->name, space, 1.0 / 128, (motion_settings){0}, (motion_settings){0});
    for (int k = 1; k <= 4; k++) {
        motion_advance(&z, 0.25 * k);
        reference_call(b, b->system->exact, 0.25 * k, NULL, NULL, exact);
        expect(b->system, reference_distance(2 * n, z.x, exact) < 1e-12, "exact solution");
        if (space == DAL_LIFTED)
            expect(b->system, reference_distance(2 * n, z.x + 2 * n + 1, zero) == 0.0,
                   "p = pi = 0");
    }
    motion_close(&z);
}

static void check_exact(const reference *b)
{
    if (!b->system->exact) return;
    check_run(b, DAL_PHYSICAL);
    if (b->system->call.adjoint) check_run(b, DAL_LIFTED);
}

static void test_exact(void) { each(check_exact); }

void suite_builtins(void)
{
    CU_pSuite suite = CU_add_suite("built-in systems", NULL, NULL);
    CU_add_test(suite, "tags of the energy", test_energy);
    CU_add_test(suite, "tags of the constraints", test_constraint);
    CU_add_test(suite, "vocabulary of tags", test_words);
    CU_add_test(suite, "tags of reversal", test_reversal);
    CU_add_test(suite, "tags of the volume", test_volume);
    CU_add_test(suite, "energy and invariants by gauss8", test_kept);
    CU_add_test(suite, "exact solutions by gauss8", test_exact);
}
