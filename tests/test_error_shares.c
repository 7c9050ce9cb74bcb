/* test_error_shares.c - the shares of a drift, from made-up runs: every part has the rate or the
 * deviation of its case, so that the shares are known. */
#include "analysis/error_shares.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A run of 1000 steps of 0.01 by gauss4 that deviates by 1 in T = 10, drifting at the rate 0.1. */
typedef struct made_up {
    dal_error_budget e;
    dal_shares a;
    dal_system with_branches;
    dal_series refused;
} made_up;

static dal_trend drift(double rate, double deviation, double margin)
{
    return (dal_trend){.count = 1001,
                       .rate = rate,
                       .deviation = deviation,
                       .scale = 1.0,
                       .max_abs = deviation,
                       .rate_low = rate - margin,
                       .rate_high = rate + margin};
}

static made_up make(const dal_system *system, const char *method)
{
    made_up m = {.e = {.steps = 1000, .quad_steps = 1000, .observables = 1}};
    m.e.spec = fixture_spec(system, method, DAL_PHYSICAL, 0.01);
    for (int k = 0; k < DAL_COMPARISONS; k++) {
        m.e.ran[k] = 1;
        m.a.comparison[k] = drift(0.1, 1.0, 0.001);
    }
    m.a.whole = m.a.beginning = drift(0.1, 1.0, 0.001);
    m.a.comparison[DAL_COMPARISON_QUAD] = drift(0.08, 0.8, 0.002);
    m.a.comparison[DAL_COMPARISON_QUAD_HALVED] = drift(0.08 / 16.0, 0.05, 0.001);
    m.a.comparison[DAL_COMPARISON_PROJECTION] = drift(0.025, 0.3, 0.001);
    m.a.comparison[DAL_COMPARISON_EXACT] = drift(0.0, 1e-15, 1e-16);
    m.a.rounding = drift(0.02, 0.2, 0.004);
    m.a.solver_and_rounding = drift(0.02, 0.2, 0.004);
    m.a.solver = drift(0.0, 0.0, 0.0);
    return m;
}

/* Rates of least squares are the trends' own. */
static const dal_shares *shares_of(made_up *m)
{
    double rate[1 + DAL_COMPARISONS] = {m->a.whole.rate};
    for (int k = 0; k < DAL_COMPARISONS; k++) rate[1 + k] = m->a.comparison[k].rate;
    dal__find_shares(&m->e, &m->a, rate);
    return &m->a;
}

/* The same system, but its equations contain abs. */
static void give_branches(made_up *m)
{
    m->with_branches = *m->e.spec.system;
    m->refused = (dal_series){.refused = "abs"};
    m->with_branches.series = &m->refused;
    m->e.spec.system = &m->with_branches;
}

#define IS(x, expected) CU_ASSERT_DOUBLE_EQUAL(x, expected, 1e-14)

/* 0.08 of 0.1 in quad precision, falling by 2^4; 0.02 of rounding; a quarter without projection. */
static void test_rates(void)
{
    made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    const dal_shares *a = shares_of(&m);
    CU_ASSERT(a->by_rate && a->whole_by_rate && !a->vanishes_in_quad && !a->is_motion &&
              !a->solver_is_significant);
    IS(a->share[DAL_SOURCE_TRUNCATION], 0.8);
    IS(a->share[DAL_SOURCE_ROUNDING], 0.2);
    IS(a->share[DAL_SOURCE_PROJECTION], 0.75);
    CU_ASSERT(a->share[DAL_SOURCE_COEFFICIENTS] == 0.0 && a->share[DAL_SOURCE_SOLVER] == 0.0);
    IS(a->margin[DAL_SOURCE_TRUNCATION], 0.02);
    IS(a->margin[DAL_SOURCE_ROUNDING], 0.04);
    IS(a->order, 4.0);
}

/* A rate counts where it is beyond its interval and T times it is half of the deviation. */
static void test_by_rate(void)
{
    static const struct {
        double rate, deviation, margin;
        int by_rate;
    } cases[] = {{0.1, 1.99, 0.01, 1}, {0.1, 2.01, 0.01, 0},   {0.1, 1.0, 0.0999, 1},
                 {0.1, 1.0, 0.1, 0},   {-0.1, 1.99, 0.01, 1},  {-0.1, 2.01, 0.01, 0},
                 {0.1, 1.0, 0.2, 0},   {-0.1, 1.0, 0.0999, 1}, {0.0, 0.0, 0.0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
        m.a.whole = drift(cases[i].rate, cases[i].deviation, cases[i].margin);
        CU_ASSERT_EQUAL(shares_of(&m)->whole_by_rate, cases[i].by_rate);
        CU_ASSERT(m.a.by_rate);
        m = make(fixture_system("chaplygin-sleigh"), "gauss4");
        m.a.beginning = drift(cases[i].rate, cases[i].deviation, cases[i].margin);
        CU_ASSERT_EQUAL(shares_of(&m)->by_rate, cases[i].by_rate);
    }
    /* The early part is shorter than the run: its own time counts. */
    made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    m.e.quad_steps = 100;
    CU_ASSERT(shares_of(&m)->by_rate == 0 && m.a.whole_by_rate == 1);
    IS(m.a.share[DAL_SOURCE_TRUNCATION], 0.8); /* of deviations */
    CU_ASSERT(isnan(m.a.margin[DAL_SOURCE_TRUNCATION]));
}

/* The solver is significant where it deviates by four times what rounding does, or its rate is
 * beyond twice half its interval; and does nothing below a tenth of the drift. */
static void test_solver(void)
{
    static const struct {
        double rate, deviation, margin;
        int is_significant;
        double share; /* NAN: unknown */
    } cases[] = {{0.0, 0.81, 1.0, 1, 0.0},    {0.0, 0.79, 1.0, 0, NAN},
                 {0.0, 0.09, 1.0, 0, 0.0},    {0.0, 0.11, 1.0, 0, NAN},
                 {0.021, 0.2, 0.01, 1, 0.21}, {0.019, 0.2, 0.01, 0, NAN},
                 {-0.021, 0.2, 0.01, 1, 0.21}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
        m.a.solver = drift(cases[i].rate, cases[i].deviation, cases[i].margin);
        m.a.solver_and_rounding = drift(0.03, 0.3, 0.006);
        CU_ASSERT_EQUAL(shares_of(&m)->solver_is_significant, cases[i].is_significant);
        /* Sizes are 0.08 in quad precision, 0.02 or 0.03 of rounding, and the solver's rate. */
        const double sum = cases[i].is_significant ? 0.1 + fabs(cases[i].rate) : 0.11;
        IS(m.a.share[DAL_SOURCE_ROUNDING], (cases[i].is_significant ? 0.02 : 0.03) / sum);
        if (isnan(cases[i].share))
            CU_ASSERT(isnan(m.a.share[DAL_SOURCE_SOLVER]))
        else
            IS(m.a.share[DAL_SOURCE_SOLVER], cases[i].share * 0.1 / sum);
        if (cases[i].is_significant) IS(m.a.margin[DAL_SOURCE_SOLVER], cases[i].margin / sum);
    }
    /* With nothing to solve there is no share of it. */
    made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    m.a.solver = drift(0.0, 0.5, 1.0);
    m.e.ran[DAL_COMPARISON_TIGHTER] = 0;
    CU_ASSERT(shares_of(&m)->share[DAL_SOURCE_SOLVER] == 0.0);
}

/* The same in units in which the quantity is 2^40 times larger. */
static void make_larger(made_up *m)
{
    dal_trend *const trends[] = {&m->a.beginning, &m->a.solver_and_rounding,
                                 &m->a.comparison[DAL_COMPARISON_QUAD],
                                 &m->a.comparison[DAL_COMPARISON_QUAD_HALVED]};
    for (size_t i = 0; i < sizeof trends / sizeof *trends; i++) {
        double *const numbers[] = {&trends[i]->rate,      &trends[i]->rate_low,
                                   &trends[i]->rate_high, &trends[i]->deviation,
                                   &trends[i]->max_abs,   &trends[i]->scale};
        for (int k = 0; k < 6; k++) *numbers[k] *= 0x1p40;
    }
}

/* What quad precision leaves: nothing, the motion, or coefficients as doubles. */
static void test_quad_precision(void)
{
    const double steps = 1000.0, rounding = 16.0 * DBL_EPSILON * steps;
    const dal_system *system = fixture_system("chaplygin-sleigh");
    /* 1e-12 of the drift is nothing. */
    for (int k = 0; k < 2; k++) {
        made_up m = make(system, "gauss4");
        m.a.comparison[DAL_COMPARISON_QUAD] = drift(k ? 1.1e-13 : 0.9e-13, 1e-9, 0.0);
        CU_ASSERT_EQUAL(shares_of(&m)->vanishes_in_quad, !k);
        CU_ASSERT_EQUAL(isnan(m.a.order), !k);
    }
    /* So are two roundings of its size. */
    for (int k = 0; k < 2; k++) {
        made_up m = make(system, "gauss4");
        m.a.beginning.max_abs = 1e6;
        m.a.comparison[DAL_COMPARISON_QUAD].deviation = (k ? 2.1 : 1.9) * DBL_EPSILON * 1e6;
        CU_ASSERT_EQUAL(shares_of(&m)->vanishes_in_quad, !k);
    }
    /* Without the exact motion what falls by less than 2^(1/2) is the motion's own. */
    for (int k = 0; k < 2; k++) {
        made_up m = make(system, "gauss4");
        m.e.ran[DAL_COMPARISON_EXACT] = 0;
        m.a.comparison[DAL_COMPARISON_QUAD_HALVED].rate = 0.08 / exp2(k ? 0.51 : 0.49);
        CU_ASSERT_EQUAL(shares_of(&m)->is_motion, !k);
        CU_ASSERT_EQUAL(isnan(m.a.share[DAL_SOURCE_TRUNCATION]), !k);
        CU_ASSERT_EQUAL(isnan(m.a.margin[DAL_SOURCE_TRUNCATION]), !k);
        IS(m.a.share[k ? DAL_SOURCE_TRUNCATION : DAL_SOURCE_MOTION], 0.8);
        IS(m.a.order, k ? 0.51 : 0.49);
        /* But what is conserved is not the motion's, however it falls. */
        m.a.is_conserved = 1;
        CU_ASSERT_EQUAL(shares_of(&m)->is_motion, 0);
        IS(m.a.share[DAL_SOURCE_TRUNCATION], 0.8);
        CU_ASSERT(m.a.share[DAL_SOURCE_MOTION] == 0.0);
    }
    /* Small, and falling by less than 2^(4 - 1/2): coefficients. */
    for (int k = 0; k < 4; k++) {
        made_up m = make(system, "gauss4");
        m.a.beginning = drift(1e-12, 1e-11, 1e-14);
        m.a.solver_and_rounding = drift(5e-13, 5e-12, 1e-14);
        m.a.comparison[DAL_COMPARISON_QUAD] = drift(5e-13, (k & 1 ? 1.01 : 0.99) * rounding, 1e-14);
        m.a.comparison[DAL_COMPARISON_QUAD_HALVED].rate = 5e-13 / exp2(k & 2 ? 3.51 : 3.49);
        const int coefficients = k == 0;
        const dal_error_source source =
            coefficients ? DAL_SOURCE_COEFFICIENTS : DAL_SOURCE_TRUNCATION;
        const dal_error_source other =
            coefficients ? DAL_SOURCE_TRUNCATION : DAL_SOURCE_COEFFICIENTS;
        CU_ASSERT_DOUBLE_EQUAL(shares_of(&m)->share[source], 0.5, 1e-12);
        CU_ASSERT(m.a.share[other] == 0.0 && !m.a.is_motion);
        make_larger(&m);
        CU_ASSERT_DOUBLE_EQUAL(shares_of(&m)->share[source], 0.5, 1e-12);
        CU_ASSERT(m.a.share[other] == 0.0);
    }
}

/* What quad precision leaves and does not fall as the order says is truncation at branches, where
 * there are some. */
static void test_branches(void)
{
    for (int k = 0; k < 4; k++) {
        made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
        if (k & 1) give_branches(&m);
        m.a.is_conserved = 1;
        m.a.comparison[DAL_COMPARISON_QUAD_HALVED].rate = 0.08 / exp2(k & 2 ? 3.51 : 3.49);
        const int at_branches = k == 1;
        IS(shares_of(&m)->share[at_branches ? DAL_SOURCE_BRANCHES : DAL_SOURCE_TRUNCATION], 0.8);
        CU_ASSERT(m.a.share[at_branches ? DAL_SOURCE_TRUNCATION : DAL_SOURCE_BRANCHES] == 0.0);
        CU_ASSERT(m.a.share[DAL_SOURCE_COEFFICIENTS] == 0.0);
        /* By halving alone: all of it, if it falls. */
        m.e.quad_steps = 0;
        m.a.comparison[DAL_COMPARISON_HALVED] = drift(0.1 / exp2(k & 2 ? 0.49 : 0.51), 1.0, 0.0);
        if (k == 1)
            IS(shares_of(&m)->share[DAL_SOURCE_BRANCHES], 1.0)
        else
            CU_ASSERT(!(shares_of(&m)->share[DAL_SOURCE_BRANCHES] > 0.0));
        CU_ASSERT(m.a.share[DAL_SOURCE_MOTION] == 0.0);
    }
}

/* Friction takes 0.06 of the 0.1, truncation 0.03, and rounding 0.01; without quad precision the
 * errors of the run and of its half, less the errors of the motion, are 0.032 and 0.002. */
static void test_split(void)
{
    made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    m.a.comparison[DAL_COMPARISON_EXACT] = m.a.motion = drift(-0.06, 0.6, 0.001);
    m.a.comparison[DAL_COMPARISON_QUAD] = drift(-0.03, 0.3, 0.001);
    m.a.error = drift(0.03, 0.3, 0.001);
    m.a.error_halved = drift(0.03 / 16.0, 0.02, 0.001);
    m.a.solver_and_rounding = drift(0.01, 0.1, 0.001);
    const dal_shares *a = shares_of(&m);
    CU_ASSERT(a->by_rate && a->is_motion && !a->is_conserved);
    IS(a->share[DAL_SOURCE_MOTION], 0.6);
    IS(a->share[DAL_SOURCE_TRUNCATION], 0.3);
    IS(a->share[DAL_SOURCE_ROUNDING], 0.1);
    IS(a->order, 4.0);
    /* An error that does not drift is measured by deviations, as the motion then is. */
    m.a.error.rate = 0.001;
    m.a.motion.deviation = 1.6;
    CU_ASSERT(shares_of(&m)->by_rate == 0);
    IS(m.a.share[DAL_SOURCE_MOTION], 0.8);
    IS(m.a.share[DAL_SOURCE_TRUNCATION], 0.15);
    IS(m.a.order, log2(15.0));
    /* What the exact motion changes within its roundings is conserved. */
    m.a.comparison[DAL_COMPARISON_EXACT] = drift(1e-13, 15.9 * 1000.0 * DBL_EPSILON, 1e-16);
    CU_ASSERT(shares_of(&m)->is_conserved == 1 && m.a.share[DAL_SOURCE_MOTION] == 0.0);
    m.a.is_conserved = 0;
    m.a.comparison[DAL_COMPARISON_EXACT].deviation = 16.1 * 1000.0 * DBL_EPSILON;
    CU_ASSERT(shares_of(&m)->is_conserved == 0);
    m.e.exact_steps = 1100; /* it takes more substeps */
    CU_ASSERT(shares_of(&m)->is_conserved == 1);

    m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    m.e.quad_steps = 0;
    m.a.whole = drift(-0.068, 0.68, 0.001);
    m.a.comparison[DAL_COMPARISON_EXACT] = drift(-0.1, 1.0, 0.001);
    m.a.comparison[DAL_COMPARISON_HALVED] = drift(-0.098, 1.0, 0.001);
    m.a.comparison[DAL_COMPARISON_PROJECTION] = drift(-0.092, 1.0, 0.001);
    CU_ASSERT_DOUBLE_EQUAL(shares_of(&m)->share[DAL_SOURCE_MOTION], 100.0 / 132.0, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(m.a.share[DAL_SOURCE_TRUNCATION], 32.0 / 132.0, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(m.a.share[DAL_SOURCE_PROJECTION], 0.75, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(m.a.order, 4.0, 1e-12);
}

/* The motion's is at least half of the change. */
static void test_motion_of(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh");
    for (int k = 0; k < 2; k++) {
        made_up m = make(system, "gauss4");
        m.e.quad_steps = 0;
        m.a.comparison[DAL_COMPARISON_HALVED] = drift(0.1, 1.0, 0.001);
        m.a.comparison[DAL_COMPARISON_EXACT] = drift(k ? 0.051 : -0.099, 1.0, 0.001);
        CU_ASSERT_EQUAL(shares_of(&m)->is_motion, k);
    }
    /* Where quad precision leaves less than a tenth, rounding errors have grown in both. */
    for (int k = 0; k < 2; k++) {
        made_up m = make(system, "gauss4");
        m.a.comparison[DAL_COMPARISON_EXACT] = m.a.motion = m.a.whole;
        m.a.comparison[DAL_COMPARISON_QUAD] = drift(k ? 0.0101 : 0.0099, 0.1, 0.0);
        CU_ASSERT_EQUAL(shares_of(&m)->is_motion, k);
        CU_ASSERT_EQUAL(m.a.share[DAL_SOURCE_MOTION] > 0.0, k);
    }
    for (int k = 0; k < 3; k++) {
        made_up m = make(system, "gauss4");
        m.a.comparison[DAL_COMPARISON_QUAD_HALVED] = m.a.comparison[DAL_COMPARISON_QUAD];
        m.e.ran[DAL_COMPARISON_EXACT] = k < 2;
        m.a.is_conserved = k == 1;
        CU_ASSERT_EQUAL(shares_of(&m)->is_motion, k == 2);
    }
}

/* Halving alone: of T + R + T/2^p, which the whole run has and the half one, T 2^p/(2^p - 1) is the
 * difference, where the drift falls as it should within half an order. */
static void test_halving(void)
{
    for (int k = 0; k < 4; k++) {
        static const double order[] = {3.51, 3.49, 4.49, 4.51};
        made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
        const double rest = exp2(-order[k]), falls_by = k == 3 ? 32.0 : 16.0;
        m.e.quad_steps = 0;
        m.a.comparison[DAL_COMPARISON_HALVED] = drift(0.1 * rest, 1.0, 0.0);
        const double share = shares_of(&m)->share[DAL_SOURCE_TRUNCATION];
        CU_ASSERT_DOUBLE_EQUAL(m.a.order, order[k], 1e-12);
        if (k == 1)
            CU_ASSERT(isnan(share))
        else /* an observable may have a higher order than the method */
            CU_ASSERT_DOUBLE_EQUAL(share, fmin((1.0 - rest) * falls_by / (falls_by - 1.0), 1.0),
                                   1e-12);
        CU_ASSERT(isnan(m.a.share[DAL_SOURCE_ROUNDING]) && isnan(m.a.share[DAL_SOURCE_SOLVER]));
        IS(m.a.share[DAL_SOURCE_PROJECTION], 0.75);
    }
    made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    m.e.quad_steps = 0;
    m.e.ran[DAL_COMPARISON_HALVED] = m.e.ran[DAL_COMPARISON_PROJECTION] = 0;
    CU_ASSERT(isnan(shares_of(&m)->share[DAL_SOURCE_TRUNCATION]) && isnan(m.a.order));
    CU_ASSERT(isnan(m.a.share[DAL_SOURCE_PROJECTION]));
}

static int says(made_up *m, dal_error_source source, const char *fragment)
{
    char words[DAL_MESSAGE_SIZE];
    shares_of(m);
    m->e.shares = &m->a;
    dal_error_budget_describe(&m->e, 0, source, words, sizeof words);
    return strstr(words, fragment) != NULL;
}

static void test_words(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh");
    made_up m = make(system, "gauss4");
    CU_ASSERT(says(&m, DAL_SOURCE_TRUNCATION, "in quad precision the rate falls by 16 = 2^4.00"));
    CU_ASSERT(says(&m, DAL_SOURCE_COEFFICIENTS, "leaves is truncation, or nothing"));
    m.a.comparison[DAL_COMPARISON_QUAD_HALVED] = drift(0.32, 3.2, 0.0);
    CU_ASSERT(says(&m, DAL_SOURCE_TRUNCATION, "in quad precision the rate grows by 4 = 2^2.00"));
    CU_ASSERT(says(&m, DAL_SOURCE_MOTION, "along the exact motion it does not change"));
    CU_ASSERT(says(&m, DAL_SOURCE_BRANCHES, "the equations have no branches"));
    m.a.is_conserved = 0;
    m.a.comparison[DAL_COMPARISON_EXACT] = m.a.motion = m.a.whole;
    m.a.error = drift(0.08, 0.8, 0.0);
    m.a.error_halved = drift(0.005, 0.05, 0.0);
    CU_ASSERT(says(&m, DAL_SOURCE_MOTION, "along the exact motion the drift is 1 times this"));
    CU_ASSERT(says(&m, DAL_SOURCE_TRUNCATION, "less the exact motion, the rate falls by 16 = 2^4"));
    CU_ASSERT(says(&m, DAL_SOURCE_COEFFICIENTS, "leaves is the motion itself, or truncation"));
    m.e.quad_steps = 0;
    m.a.comparison[DAL_COMPARISON_EXACT] = drift(0.0, 0.0, 0.0);
    m.e.ran[DAL_COMPARISON_HALVED] = 0;
    strcpy(m.e.reason[DAL_COMPARISON_HALVED], "it left the domain");
    CU_ASSERT(says(&m, DAL_SOURCE_TRUNCATION, "with half the step: it left the domain"));
}

/* The whole text, without shares found before it. */
static int describes(made_up *m, dal_error_source source, const char *expected)
{
    char words[DAL_MESSAGE_SIZE];
    m->e.shares = &m->a;
    dal_error_budget_describe(&m->e, 0, source, words, sizeof words);
    const int same = strcmp(words, expected) == 0;
    if (!same) printf("\n  '%s' is not '%s'\n", words, expected);
    return same;
}
#define DESCRIBES(source, text) CU_ASSERT(describes(&m, DAL_SOURCE_##source, text))

static made_up with_reasons(void)
{
    made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    for (int k = 0; k < DAL_COMPARISONS; k++) snprintf(m.e.reason[k], 32, "reason %d", k);
    snprintf(m.e.reason[DAL_COMPARISON_EXACT], 32, "none is given");
    snprintf(m.e.reason[DAL_COMPARISON_QUAD], 32, "no type for it");
    snprintf(m.e.reason[DAL_COMPARISON_HALVED], 32, "it left the domain");
    snprintf(m.e.reason[DAL_COMPARISON_TIGHTER], 32, "nothing is solved");
    snprintf(m.e.reason[DAL_COMPARISON_PROJECTION], 32, "D has none");
    shares_of(&m);
    return m;
}

/* Each text of each source. */
static void test_descriptions(void)
{
    made_up m = with_reasons();
    DESCRIBES(TRUNCATION,
              "in quad precision the rate falls by 16 = 2^4.00 when the step is halved");
    DESCRIBES(ROUNDING,
              "this part vanishes in quad precision; with plain sums the drift is 1 times "
              "this");
    m.e.spec.options.sums = DAL_SUMS_PLAIN;
    DESCRIBES(ROUNDING,
              "this part vanishes in quad precision; with compensated sums the drift is 1 "
              "times this");
    DESCRIBES(SOLVER, "two more iterations change no more than roundings do");
    DESCRIBES(BRANCHES, "the equations have no branches");
    DESCRIBES(PROJECTION, "with +project the drift is 0.25 times this");
    m.e.ran[DAL_COMPARISON_SUMS] = m.e.ran[DAL_COMPARISON_PROJECTION] = 0;
    m.a.solver_is_significant = 1;
    DESCRIBES(ROUNDING, "this part vanishes in quad precision");
    DESCRIBES(SOLVER, "this part vanishes when the equations are solved to rounding and iterated "
                      "twice more");
    DESCRIBES(PROJECTION, "D has none");
    m.e.ran[DAL_COMPARISON_TIGHTER] = 0;
    DESCRIBES(SOLVER, "nothing is solved");
    m.a.order = 1.0;
    m.a.share[DAL_SOURCE_COEFFICIENTS] = 0.5;
    DESCRIBES(COEFFICIENTS,
              "what quad precision leaves falls by 2 = 2^1.00 when the step is halved, "
              "not by 2^4: coefficients are doubles");
    DESCRIBES(TRUNCATION,
              "what quad precision leaves does not fall by 2^4 when the step is halved");
    m.a.share[DAL_SOURCE_COEFFICIENTS] = 0.0;
    m.a.order = NAN;
    DESCRIBES(TRUNCATION, "in quad precision nothing of it remains when the step is halved");
    m.a.vanishes_in_quad = 1;
    DESCRIBES(TRUNCATION, "in quad precision nothing of it remains");
    give_branches(&m);
    DESCRIBES(BRANCHES, "truncation falls as in smooth equations");
    m.a.order = 1.0, m.a.share[DAL_SOURCE_BRANCHES] = 0.5;
    DESCRIBES(BRANCHES, "the equations contain abs: in quad precision the rate falls by 2 = 2^1.00 "
                        "when the step is halved, not by 2^4");
}

static void test_descriptions_of_motion(void)
{
    made_up m = with_reasons();
    m.e.ran[DAL_COMPARISON_EXACT] = 0;
    m.a.is_conserved = 1;
    DESCRIBES(MOTION, "the motion conserves it");
    m.a.is_conserved = 0;
    m.a.is_motion = 1;
    DESCRIBES(MOTION, "what quad precision leaves does not fall when the step is halved");
    m.a.is_motion = 0;
    DESCRIBES(MOTION, "no exact motion: none is given");
    m.e.ran[DAL_COMPARISON_EXACT] = 1;
    m.a.share[DAL_SOURCE_MOTION] = 0.0;
    DESCRIBES(MOTION, "quad precision leaves next to nothing: rounding errors grow");
}

static void test_descriptions_without_quad(void)
{
    made_up m = with_reasons();
    m.e.quad_steps = m.a.is_conserved = 0;
    m.a.order = 1.0;
    m.e.has_projection = 1;
    m.a.share[DAL_SOURCE_PROJECTION] = 0.875;
    DESCRIBES(ROUNDING, "no quad precision: no type for it");
    DESCRIBES(COEFFICIENTS, "without quad precision they cannot be distinguished from truncation");
    DESCRIBES(SOLVER, "solved further the drift is 1 times this");
    DESCRIBES(PROJECTION, "without projection the error is 0.125 times this");
    m.a.whole_by_rate = 0;
    m.a.share[DAL_SOURCE_TRUNCATION] = NAN;
    DESCRIBES(TRUNCATION, "halving alone, without quad precision, is not conclusive: the deviation "
                          "falls by 2 = 2^1.00 when the step is halved");
    m.a.share[DAL_SOURCE_TRUNCATION] = 0.5, m.a.order = -1.0;
    DESCRIBES(TRUNCATION, "by halving alone: the deviation grows by 2 = 2^1.00 when the step is "
                          "halved");
    m.a.share[DAL_SOURCE_BRANCHES] = 0.5;
    DESCRIBES(TRUNCATION, "what there is does not fall by 2^4 when the step is halved");
    m.a.share[DAL_SOURCE_BRANCHES] = 0.0;
    m.e.ran[DAL_COMPARISON_HALVED] = 0;
    DESCRIBES(TRUNCATION,
              "neither quad precision nor a run with half the step: it left the domain");
    m.a.whole.deviation = 0.0;
    DESCRIBES(TRUNCATION, "it never changes");
    m.a.whole.deviation = NAN;
    DESCRIBES(TRUNCATION, "it is not finite");
    m.a.whole.deviation = 1.0, m.e.quad_steps = 1000, m.a.beginning.deviation = 0.0;
    DESCRIBES(TRUNCATION, "it does not change in the first 1000 steps");
}

static int sums_up(made_up *m, const char *expected)
{
    char words[DAL_MESSAGE_SIZE];
    shares_of(m);
    m->e.shares = &m->a;
    const int same =
        strcmp(dal_error_budget_summarise(&m->e, 0, words, sizeof words), expected) == 0;
    if (!same) printf("\n  '%s' is not '%s'\n", words, expected);
    return same;
}

static void test_sentences(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh");
    made_up m = make(system, "gauss4");
    m.a.whole.size = DAL_SIZE_LARGER;
    CU_ASSERT(sums_up(&m, "drifts by truncation (80 %) and rounding (20 %): halve the step and "
                          "truncation falls by 16"));
    m.a.solver_and_rounding = m.a.rounding = drift(0.0, 1e-9, 0.0);
    CU_ASSERT(sums_up(&m, "drifts by truncation (100 %): halve the step and it falls by 16"));
    m.a.whole.conservation = DAL_OFF_SURFACE;
    CU_ASSERT(sums_up(&m, "drifts by truncation (100 %), because D does: halve the step and it "
                          "falls by 16"));
    m.a.whole.conservation = DAL_CONSERVED;
    m.e.spec.options.tolerance = 1e-6;
    CU_ASSERT(sums_up(&m, "drifts by truncation (100 %): divide the tolerance by 16 and it falls "
                          "by 16"));
    m.e.spec.options.tolerance = 0.0;
    m.a.comparison[DAL_COMPARISON_QUAD_HALVED] = m.a.comparison[DAL_COMPARISON_QUAD];
    CU_ASSERT(sums_up(&m, "drifts by truncation (100 %): halve the step and it does not fall"));
    give_branches(&m);
    m.a.comparison[DAL_COMPARISON_QUAD_HALVED].rate = 0.02;
    CU_ASSERT(sums_up(&m, "drifts by truncation at branches (100 %): halve the step and it falls "
                          "by 4"));
    m.e.spec.system = system;
    m.a.comparison[DAL_COMPARISON_QUAD] = drift(0.0, 0.0, 0.0);
    m.a.solver = drift(0.1, 1.0, 0.001);
    CU_ASSERT(sums_up(&m, "drifts by the solver (100 %): solve the equations further"));

    /* Friction, and a little truncation. */
    m = make(system, "gauss4");
    m.a.comparison[DAL_COMPARISON_EXACT] = m.a.motion = drift(0.1, 1.0, 0.001);
    m.a.error = drift(1e-4, 1e-3, 1e-6);
    m.a.error_halved = drift(1e-4 / 16.0, 1e-3 / 16.0, 1e-6);
    m.a.solver_and_rounding = drift(0.0, 1e-9, 0.0);
    m.a.whole.size = DAL_SIZE_LARGER;
    CU_ASSERT(sums_up(&m, "changes by the motion itself (100 %); truncation is 0.1 %: halve the "
                          "step and it falls by 16"));
    /* Rounding, and nothing. */
    m = make(system, "gauss4");
    m.a.whole.size = DAL_SIZE_ROUNDING;
    CU_ASSERT(sums_up(&m, "stays at rounding"));
    m.a.whole = m.a.beginning = drift(0.0, 0.0, 0.0);
    CU_ASSERT(sums_up(&m, "never changes"));
    m.a.whole.deviation = INFINITY;
    CU_ASSERT(sums_up(&m, "is not finite"));
}

static void test_buffers(void)
{
    made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    char words[100];
    shares_of(&m);
    for (int k = 0; k < DAL_ERROR_SOURCES; k++)
        m.a.share[k] = k == DAL_SOURCE_COEFFICIENTS ? 1.0 : 0.0;
    m.e.shares = &m.a;
    dal_error_budget_summarise(&m.e, 0, words, sizeof words);
    CU_ASSERT_STRING_EQUAL(words, "drifts by rounding of coefficients (100 %)");
    CU_ASSERT_PTR_EQUAL(
        dal_error_budget_describe(&m.e, 0, DAL_SOURCE_ROUNDING, words, sizeof words), words);
    /* A buffer of any length ends in NUL. */
    for (size_t size = 1; size <= 16; size++) {
        memset(words, 'x', sizeof words);
        dal_error_budget_summarise(&m.e, 0, words, size);
        CU_ASSERT_EQUAL(strlen(words), size - 1);
    }
}

/* Projection: what goes without it, never less than nothing; nothing of what never moved. */
static void test_projection(void)
{
    made_up m = make(fixture_system("chaplygin-sleigh"), "gauss4");
    m.a.comparison[DAL_COMPARISON_PROJECTION] = drift(0.3, 1.0, 0.0);
    CU_ASSERT(shares_of(&m)->share[DAL_SOURCE_PROJECTION] == 0.0);
    m.a.whole = drift(0.0, 0.5, 0.0); /* by deviations */
    m.a.comparison[DAL_COMPARISON_PROJECTION] = drift(7.0, 0.125, 0.0);
    IS(shares_of(&m)->share[DAL_SOURCE_PROJECTION], 0.75);
    m.a.whole = m.a.beginning = drift(0.0, 0.0, 0.0);
    shares_of(&m);
    for (int k = 0; k < DAL_ERROR_SOURCES; k++)
        CU_ASSERT(isnan(m.a.share[k]) && isnan(m.a.margin[k]));
    CU_ASSERT(isnan(m.a.order));
}

void suite_error_shares(void)
{
    CU_pSuite suite = CU_add_suite("shares of a drift", NULL, NULL);
    CU_add_test(suite, "shares of a rate", test_rates);
    CU_add_test(suite, "rates or deviations", test_by_rate);
    CU_add_test(suite, "the solver", test_solver);
    CU_add_test(suite, "what quad precision leaves", test_quad_precision);
    CU_add_test(suite, "the motion itself", test_motion_of);
    CU_add_test(suite, "truncation at branches", test_branches);
    CU_add_test(suite, "friction and truncation", test_split);
    CU_add_test(suite, "halving alone", test_halving);
    CU_add_test(suite, "projection", test_projection);
    CU_add_test(suite, "in words", test_words);
    CU_add_test(suite, "every description", test_descriptions);
    CU_add_test(suite, "descriptions of the motion", test_descriptions_of_motion);
    CU_add_test(suite, "descriptions without quad precision", test_descriptions_without_quad);
    CU_add_test(suite, "in a sentence", test_sentences);
    CU_add_test(suite, "buffers of words", test_buffers);
}
