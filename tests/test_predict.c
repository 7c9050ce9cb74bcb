/* test_predict.c - the drift predicted before a run, against closed forms, published figures and
 * runs. */
#include "allocation.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* x = cos t, E = 1/2. */
static const char oscillator[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n";

/* The prediction for a method on the physical space. */
static dal_status predict(dal_prediction **p, const char *system, const char *method, double h,
                          double T, long long pieces, dal_error *error)
{
    const dal_run_spec spec = fixture_spec(fixture_system(system), method, DAL_PHYSICAL, h);
    dal_predict_settings settings = dal_predict_settings_default();
    settings.pieces = pieces;
    return dal_predict_create(p, &spec, T, &settings, NULL, error);
}

static dal_prediction *predicted(const char *system, const char *method, double h, double T,
                                 long long pieces)
{
    dal_prediction *p = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL_FATAL(predict(&p, system, method, h, T, pieces, &error), DAL_STATUS_OK);
    return p;
}

static const dal_predicted *find(const dal_prediction *p, const char *name)
{
    for (int i = 0; i < p->observables; i++)
        if (strcmp(p->predicted[i].name, name) == 0) return &p->predicted[i];
    CU_FAIL_FATAL("no such observable");
    return NULL;
}

static void is_near(double x, double expected, double relative)
{
    CU_ASSERT_DOUBLE_EQUAL(x, expected, relative * fabs(expected));
}

/* A step of rk4 multiplies E by |R(ih)|^2 = 1 - h^6/72 + h^8/576, the same at every state; so it
 * does where F has no Taylor series by its formula. */
static void test_closed_form(void)
{
    static const char *const systems[] = {
        oscillator, "coordinates: [x]\nlagrangian: (x'^2 - abs(x)^2)/2\nstart: {x: 1}\n"};
    const double h = 0.25, T = 50.0;
    const double c = 0.5 * (-pow(h, 6) / 72.0 + pow(h, 8) / 576.0);
    for (int i = 0; i < 2; i++) {
        dal_prediction *p = predicted(systems[i], "rk4", h, T, 0);
        const dal_predicted *E = find(p, "E");
        CU_ASSERT(E->is_conserved && !E->is_zero && !p->leaves_D && !p->is_quad);
        CU_ASSERT(p->has_series == (i == 0) && p->reason == DAL_PREDICTION_TIME && p->end == T);
        is_near(E->change, 200.0 * c, 1e-8);
        is_near(E->max_change, fabs(200.0 * c), 1e-8);
        is_near(E->rate, c / h, 1e-8);
        CU_ASSERT(E->margin < 1e-8 * fabs(E->rate));
        CU_ASSERT_EQUAL(p->rows, 201);
        for (long long r = 0; r < p->rows; r++) {
            CU_ASSERT_EQUAL(p->t[r], h * (double)r);
            CU_ASSERT_DOUBLE_EQUAL(p->change[r], c * (double)r, 1e-8 * fabs(200.0 * c));
        }
        dal_prediction_free(p);
    }
}

/* Symplectic Euler changes E by h^2 (v^2/2 - v^2 - h q v ... ), with mean h^4/4 on q = cos t:
 * the curve oscillates, and the bump finds the mean of it. */
static void test_mean_rate(void)
{
    const double h = 0.1;
    dal_prediction *p = predicted(oscillator, "symplectic-euler", h, 400.0, 0);
    const dal_predicted *E = find(p, "E");
    is_near(E->rate, pow(h, 3) / 4.0, 1e-6);
    CU_ASSERT(fabs(E->rate - pow(h, 3) / 4.0) <= E->margin);
    CU_ASSERT(E->max_change > 100.0 * fabs(E->rate));
    dal_prediction_free(p);
}

/* Motion down a hill, or up one, is free at one of its ends: the mean of its whole change, hardly
 * seen by the bump, is in the interval, which is not much longer. */
static void test_transient(void)
{
    static const char *const starts[] = {"x: 0, x': 2", "x: -200, x': 2"};
    for (int i = 0; i < 2; i++) {
        char system[128];
        snprintf(system, sizeof system,
                 "coordinates: [x]\nlagrangian: x'^2/2 - exp(-x^2)\nstart: {%s}\n", starts[i]);
        dal_prediction *p = predicted(system, "rk4", 0.125, 100.0, 0);
        const dal_predicted *E = find(p, "E");
        CU_ASSERT(p->reason == DAL_PREDICTION_TIME && fabs(E->change) > 1e-6);
        CU_ASSERT(fabs(E->change / 100.0 - E->rate) <= E->margin);
        CU_ASSERT(E->margin <= 2.0 * fabs(E->change) / 100.0);
        dal_prediction_free(p);
    }
}

/* A step of taylor multiplies E by |R|^2, R the sum of (ih)^k/k! up to 10: 1 + 22 h^12/12! + ..;
 * doubles do not see that, quad precision does. */
static void test_quad(void)
{
    const double h = 0.25, T = 5.0;
    double re = 0.0, im = 0.0, term = 1.0; /* r = e^(ih) - R = sum (ih)^k/k!, k > 10 */
    for (int k = 1; k <= 30; k++) {
        term *= h / k;
        if (k <= 10) continue;
        if (k % 2 == 0) re += (k % 4 == 0 ? 1.0 : -1.0) * term;
        if (k % 2 == 1) im += (k % 4 == 1 ? 1.0 : -1.0) * term;
    }
    const double c = 0.5 * (-2.0 * (cos(h) * re + sin(h) * im) + re * re + im * im);
    dal_prediction *p = predicted(oscillator, "taylor", h, T, 0);
    CU_ASSERT(c > 0.0 && c < 1e-14);
    if (fixture_system(oscillator)->quad) {
        CU_ASSERT(p->is_quad);
        is_near(find(p, "E")->change, 20.0 * c, 1e-6);
    }
    dal_prediction_free(p);
    /* Gauss methods preserve it, and quad precision does not change that. */
    p = predicted(oscillator, "gauss4", h, T, 0);
    CU_ASSERT(!p->is_quad && find(p, "E")->max_change < 1e-14);
    dal_prediction_free(p);
}

/* Where steps in quad precision fail, those in doubles are kept to the bit. */
static dal_status fail(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)at, (void)out;
    return DAL_STATUS_IO;
}

static bool has_bits(const dal_prediction *a, const dal_prediction *b);

static void test_quad_fails(void)
{
    dal_system systems[] = {*fixture_system(oscillator), *fixture_system(oscillator)};
    dal_prediction *p[2] = {NULL, NULL};
    if (!systems[0].quad) return;
    dal_system quad = *systems[0].quad;
    quad.call.field = fail;
    systems[0].quad = &quad;
    systems[1].quad = NULL;
    for (int i = 0; i < 2; i++) {
        const dal_run_spec spec = fixture_spec(&systems[i], "rk4", DAL_PHYSICAL, 0.001);
        CU_ASSERT_EQUAL_FATAL(dal_predict_create(&p[i], &spec, 1.0, NULL, NULL, NULL),
                              DAL_STATUS_OK);
        CU_ASSERT(!p[i]->is_quad);
    }
    CU_ASSERT_TRUE(has_bits(p[0], p[1]));
    for (int i = 0; i < 2; i++) dal_prediction_free(p[i]);
}

/* max |predicted - run| of an observable at the rows of a curve, over max |change| of the run. */
static double deviation(const dal_prediction *p, const char *system, const char *method, double h,
                        const char *name, double *last)
{
    const dal_run_spec spec = fixture_spec(fixture_system(system), method, DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    double values[32], first = 0.0, size = 0.0, max = 0.0;
    char own[64];
    int i = 0, j = 0;
    while (strcmp(dal_run_observable_name(run, i, own, sizeof own), name) != 0) i++;
    while (strcmp(p->predicted[j].name, name) != 0) j++;
    CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
    first = values[i];
    for (long long r = 1; r < p->rows; r++) {
        const long long steps = llround((p->t[r] - p->from) / h) - dal_run_steps(run);
        CU_ASSERT_EQUAL(dal_run_advance(run, steps, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
        *last = values[i] - first;
        size = fmax(size, fabs(*last));
        max = fmax(max, fabs(p->change[r * p->observables + j] - *last));
    }
    dal_run_free(run);
    return max / size;
}

/* E(200) - E(0) of pendulum-cvt by rk4, h = 0.05, which leaves D = 0: run -1.36487e-5, predicted
 * -1.36639e-5 (by an independent program). */
static void test_leaves_D(void)
{
    double run = 0.0;
    dal_prediction *p = predicted("pendulum-cvt", "rk4", 0.05, 200.0, 0);
    CU_ASSERT(p->leaves_D && p->reason == DAL_PREDICTION_TIME);
    CU_ASSERT_DOUBLE_EQUAL(find(p, "E")->change, -1.36639e-5, 1e-10);
    CU_ASSERT(deviation(p, "pendulum-cvt", "rk4", 0.05, "E", &run) < 2e-3);
    CU_ASSERT_DOUBLE_EQUAL(run, -1.36487e-5, 1e-10);
    CU_ASSERT(deviation(p, "pendulum-cvt", "rk4", 0.05, "D1", &run) < 5e-3);
    dal_prediction_free(p);
}

/* The rate of ln Hf of pendulum-cvt by mclachlan-perlmutter is -7.9395e-3 h^2, by an independent
 * program, up to O(h^4). */
static void test_rate_of_pendulum(void)
{
    const double h = 0.05;
    dal_prediction *p = predicted("pendulum-cvt", "mclachlan-perlmutter", h, 400.0, 0);
    const dal_predicted *lnHf = find(p, "lnHf");
    CU_ASSERT(!p->leaves_D && find(p, "D1")->max_change < 1e-14);
    CU_ASSERT(lnHf->margin < 1e-4 * fabs(lnHf->rate));
    is_near(lnHf->rate, -7.9395e-3 * h * h, 2e-4);
    dal_prediction_free(p);
}

/* Methods that leave D = 0 and that enforce it, against runs. */
static void test_against_runs(void)
{
    static const struct {
        const char *system, *method, *name;
        double h, allowed;
    } cases[] = {
        {"contact-oscillator", "rk4+project", "E", 0.1, 0.01},
        {"heisenberg", "rk4", "E", 0.05, 0.02},
        {"falling-disk", "rk4", "E", 0.05, 0.02},
        {"vertical-disk", "rk4+project", "E", 0.05, 0.01},
        {"knife-edge", "gauss4", "drift", 0.1, 0.02},
        {"turntable-ball", "rk4", "moving", 0.05, 0.01},
        {"mobile-robot", "lobatto4", "E", 0.05, 0.02},
        {"knife-edge", "spark2", "E", 0.1, 0.01}, /* of order 2 from here on */
        {"vertical-disk", "implicit-midpoint+project", "rolling", 0.05, 0.01},
        {"snakeboard", "mclachlan-perlmutter", "E", 0.05, 0.01},
        {"snakeboard", "implicit-midpoint", "E", 0.05, 0.02},
        {"pendulum-cvt", "implicit-midpoint+project", "E", 0.025, 0.01},
    };
    const double T = case_stride(4) == 1 ? 20.0 : 5.0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double run;
        dal_prediction *p = predicted(cases[i].system, cases[i].method, cases[i].h, T, 0);
        CU_ASSERT(deviation(p, cases[i].system, cases[i].method, cases[i].h, cases[i].name, &run) <
                  cases[i].allowed);
        dal_prediction_free(p);
    }
}

/* An orbit that meets v = 0 is mapped to itself; stormer-verlet preserves the reversal, rk4 does
 * not.  From q, v != 0 the meeting is within a step. */
static void test_reversibility(void)
{
    static const char pendulum[] =
        "coordinates: [a]\nlagrangian: a'^2/2 + cos(a)\nstart: {a: 0.7, a': 0.4}\n"
        "invariants: {odd: a'*(a'^2/2 - cos(a))}\n";
    static const char rotor[] =
        "coordinates: [a]\nlagrangian: a'^2/2 + cos(a)\nstart: {a: 0.7, a': 2.5}\n";
    static const char forced[] = /* no reversal: terms odd and even in v */
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - x^2 - 2*y^2)/2 + x^2*y/10\n"
        "forces: {x: 0.3*y'*(1 + x), y: -0.3*x'*(1 + x)}\nstart: {x: 0.5, y: 0.1, x': 0.2, "
        "y': 0.4}\n";
    dal_prediction *p = predicted(pendulum, "stormer-verlet", 0.05, 20.0, 0);
    CU_ASSERT(find(p, "E")->is_zero && !find(p, "odd")->is_zero);
    dal_prediction_free(p);
    p = predicted(pendulum, "rk4", 0.05, 20.0, 0);
    CU_ASSERT_FALSE(find(p, "E")->is_zero);
    dal_prediction_free(p);
    /* It passes a = pi, or 0, with another velocity. */
    p = predicted(rotor, "stormer-verlet", 0.05, 20.0, 0);
    CU_ASSERT_TRUE(find(p, "E")->is_zero);
    dal_prediction_free(p);
    p = predicted(forced, "implicit-midpoint", 0.05, 20.0, 0);
    CU_ASSERT_FALSE(find(p, "E")->is_zero);
    dal_prediction_free(p);
}

/* max |change| of an observable in the first and the last tenth of a run. */
static void find_tenths(dal_run *run, const char *name, int steps, double *first, double *last)
{
    double values[32];
    char own[64];
    int i = 0;
    while (strcmp(dal_run_observable_name(run, i, own, sizeof own), name) != 0) i++;
    CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
    const double start = values[i];
    *first = *last = 0.0;
    for (int k = 1; k <= steps; k++) {
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
        const double change = fabs(values[i] - start);
        if (10 * k <= steps) *first = fmax(*first, change);
        if (10 * k > 9 * steps) *last = fmax(*last, change);
    }
}

/* Where a rate is 0 by reversibility a run changes E at its end by no more than at its begin. */
static void test_zeros(void)
{
    static const char *const cases[][2] = {{"contact-oscillator", "implicit-midpoint"},
                                           {"nonholonomic-particle", "mclachlan-perlmutter"},
                                           {"unequal-springs", "spark2"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double first, last;
        dal_prediction *p = predicted(cases[i][0], cases[i][1], 0.1, 40.0, 0);
        CU_ASSERT_TRUE(find(p, "E")->is_zero);
        dal_prediction_free(p);
        const dal_run_spec spec =
            fixture_spec(fixture_system(cases[i][0]), cases[i][1], DAL_PHYSICAL, 0.1);
        dal_run *run = fixture_run(&spec);
        find_tenths(run, "E", case_stride(4) == 1 ? 20000 : 4000, &first, &last);
        CU_ASSERT(first > 1e-9 && last < 1.2 * first);
        dal_run_free(run);
    }
    /* Bodies that fall for ever do not come back: reversibility says nothing of t > 0 alone. */
    dal_prediction *p = predicted("benenti", "gauss4", 0.1, 40.0, 0);
    CU_ASSERT_FALSE(find(p, "E")->is_zero);
    dal_prediction_free(p);
    /* Nor does motion that ends where a constraint is singular. */
    p = predicted("chaplygin-sleigh-nonlinear", "mclachlan-perlmutter", 0.02, 20.0, 0);
    CU_ASSERT(p->reason == DAL_PREDICTION_FAILED && !find(p, "E")->is_zero);
    dal_prediction_free(p);
}

/* x'' = -x by the midpoint rule turns by 2 atan(h/2) in a step: the run is (1 - that/h) t away from
 * the exact motion, of size 1, and reaches some part of its units there within half a turn. */
static void test_phase(void)
{
    static const char model[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n";
    const double h = 0.02, rate = 1.0 - 2.0 * atan(h / 2.0) / h;
    const dal_run_spec spec =
        fixture_spec(fixture_system(model), "implicit-midpoint", DAL_PHYSICAL, h);
    dal_scaled *scaled = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_scaled_create(&scaled, &spec, NULL), DAL_STATUS_OK);
    const double *unit = dal_scaled_units(scaled), part = 0.005 * fmin(unit[1], unit[2]);
    dal_prediction *p =
        predicted(model, "implicit-midpoint", h, h * ceil(2.0 * part / rate / h), 0);
    CU_ASSERT(p->in_phase > part / rate - 0.1 && p->in_phase < part / rate + 3.3);
    dal_prediction_free(p);
    p = predicted(model, "implicit-midpoint", h, h * ceil(0.5 * part / rate / h), 0);
    CU_ASSERT(isnan(p->in_phase));
    dal_prediction_free(p);
    dal_scaled_free(scaled);
}

/* Pieces: their mean is the rate, and where all change the same there is no walk. */
static void test_pieces(void)
{
    const double h = 0.25, c = 0.5 * (-pow(h, 6) / 72.0 + pow(h, 8) / 576.0);
    dal_prediction *p = predicted(oscillator, "rk4", h, 2.0, 50);
    const dal_predicted *E = find(p, "E");
    CU_ASSERT_EQUAL(p->pieces, 50);
    CU_ASSERT_EQUAL(p->steps, 400);
    CU_ASSERT_EQUAL(p->end, 2.0);
    is_near(E->change, 8.0 * c, 1e-8);
    is_near(E->rate, c / h, 1e-8);
    CU_ASSERT(E->margin < 1e-8 * fabs(E->rate));
    CU_ASSERT(fabs(E->walk) < 1e-15 * c * c + 1e-25);
    dal_prediction_free(p);
    /* Symplectic Euler from phase 2j: var S = b (1 - cos of T) of a piece, over 2 T; with many
     * pieces the phases are even and E changes by h (q v - q0 v0)/2 ... + O(h^2). */
    p = predicted(oscillator, "symplectic-euler", 0.01, 2.0, 4000);
    /* S = -(h/2)(q v)|: q v = -sin(2t)/2, so S(T) = (h/4)(sin(2t + 2T) - sin 2t) and
     * var S(T) = (h/4)^2 (1 - cos 2T); s^2 = 2 (var S(T) - var S(T/2))/T. */
    const double a = 0.01 / 4.0, T = 2.0;
    is_near(find(p, "E")->walk, 2.0 * a * a * (cos(T) - cos(2.0 * T)) / T, 0.05);
    const double V = a * a * (1.0 - cos(2.0 * T)), W = a * a * (1.0 - cos(T)), C = 0.5 * V - W;
    is_near(find(p, "E")->walk_margin, 2.0 / T * sqrt((V * V + W * W + C * C) / 4000.0), 0.05);
    dal_prediction_free(p);
}

/* Where D moves the motion off, the curve ends, and it is good up to there. */
static void test_ends(void)
{
    double run;
    dal_error error = {0};
    dal_prediction *p = predicted("pendulum-cvt", "implicit-midpoint", 0.05, 200.0, 0);
    CU_ASSERT(p->reason == DAL_PREDICTION_DEFECT && p->end > 10.0 && p->end < 100.0);
    CU_ASSERT(p->t[p->rows - 1] == p->end);
    CU_ASSERT(deviation(p, "pendulum-cvt", "implicit-midpoint", 0.05, "driver", &run) < 0.1);
    CU_ASSERT_STRING_EQUAL(dal_prediction_end_name(p->reason), "defect");
    dal_prediction_free(p);
    CU_ASSERT_EQUAL(predict(&p, "chaplygin-sleigh-nonlinear", "rk4", 0.02, 20.0, 0, &error),
                    DAL_STATUS_OK);
    CU_ASSERT(p->reason == DAL_PREDICTION_FAILED && p->end < 2.0 && p->message[0] != '\0');
    dal_prediction_free(p);
    CU_ASSERT_STRING_EQUAL(dal_prediction_end_text((dal_prediction_end)99), "?");
}

static bool has_bits(const dal_prediction *a, const dal_prediction *b)
{
    const size_t numbers = (size_t)(a->rows * a->observables);
    return a->rows == b->rows && a->observables == b->observables && a->end == b->end &&
           memcmp(a->t, b->t, (size_t)a->rows * sizeof(double)) == 0 &&
           memcmp(a->change, b->change, numbers * sizeof(double)) == 0;
}

/* Methods and steps that share the exact motion, be it extended before, as needed or kept in
 * part, predict the bits that they predict by themselves. */
static void test_shared_motion(void)
{
    static const char *const systems[] = {
        "heisenberg", "coordinates: [x]\nlagrangian: (x'^2 - abs(x)^2)/2\nstart: {x: 1}\n"};
    static const struct {
        const char *method;
        double h;
    } cases[] = {{"rk4", 0.05}, {"implicit-midpoint", 0.1}, {"gauss4", 0.025}};
    static const size_t bytes[] = {0, 0, 20000};
    const double T = 40.0;
    for (int i = 0; i < 6; i++) {
        dal_exact_motion *motion = NULL;
        dal_predict_settings settings = dal_predict_settings_default();
        const dal_run_spec first =
            fixture_spec(fixture_system(systems[i % 2]), "rk4", DAL_PHYSICAL, 1.0);
        CU_ASSERT_EQUAL_FATAL(dal_exact_motion_create(&motion, &first, bytes[i / 2], NULL),
                              DAL_STATUS_OK);
        settings.motion = motion;
        if (i / 2 == 1)
            CU_ASSERT_EQUAL(dal_exact_motion_extend(motion, T, NULL, NULL), DAL_STATUS_OK);
        for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
            dal_prediction *shared = NULL;
            dal_prediction *own = predicted(systems[i % 2], cases[k].method, cases[k].h, T, 0);
            const dal_run_spec spec = fixture_spec(fixture_system(systems[i % 2]), cases[k].method,
                                                   DAL_PHYSICAL, cases[k].h);
            CU_ASSERT_EQUAL_FATAL(dal_predict_create(&shared, &spec, T, &settings, NULL, NULL),
                                  DAL_STATUS_OK);
            CU_ASSERT_TRUE(has_bits(shared, own));
            dal_prediction_free(shared);
            dal_prediction_free(own);
        }
        dal_exact_motion_free(motion);
    }
}

/* A motion is of one start, in one direction, on D = 0. */
static void test_other_motions(void)
{
    const dal_setting other = {"x", 0.5};
    dal_exact_motion *motion = NULL;
    dal_prediction *p = NULL;
    dal_error error = {0};
    dal_predict_settings settings = dal_predict_settings_default();
    dal_run_spec spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_PHYSICAL, 0.25);
    CU_ASSERT_EQUAL_FATAL(dal_exact_motion_create(&motion, &spec, 0, NULL), DAL_STATUS_OK);
    settings.motion = motion;
    spec.options.step = -0.25;
    CU_ASSERT_EQUAL(dal_predict_create(&p, &spec, -1.0, &settings, NULL, &error),
                    DAL_STATUS_ARGUMENT);
    spec.options.step = 0.25;
    spec.start = &other;
    spec.start_count = 1;
    CU_ASSERT_EQUAL(dal_predict_create(&p, &spec, 1.0, &settings, NULL, &error),
                    DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "the exact motion has another start"));
    dal_exact_motion_free(motion);
    spec.start = &(dal_setting){"p_x", 0.1};
    spec.options.space = DAL_LIFTED;
    CU_ASSERT_EQUAL(dal_exact_motion_create(&motion, &spec, 0, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_PTR_NULL(motion);
}

/* Without steps in quad precision rounding limits doubles. */
static void test_quad_steps(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(oscillator), "taylor", DAL_PHYSICAL, 0.25);
    dal_predict_settings settings = dal_predict_settings_default();
    for (settings.quad_steps = 19; settings.quad_steps <= 20; settings.quad_steps++) {
        dal_prediction *p = NULL;
        CU_ASSERT_EQUAL_FATAL(dal_predict_create(&p, &spec, 5.0, &settings, NULL, NULL),
                              DAL_STATUS_OK);
        CU_ASSERT_EQUAL(p->is_quad, spec.system->quad && settings.quad_steps == 20);
        dal_prediction_free(p);
    }
}

static dal_status stop(void *user, double done)
{
    (void)done;
    return --*(int *)user > 0 ? DAL_STATUS_OK : DAL_STATUS_INTERRUPTED;
}

/* What was predicted until an interruption is kept. */
static void test_interrupted(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_PHYSICAL, 0.25);
    int calls = 2;
    const dal_predict_observer observer = {&calls, stop};
    dal_prediction *p = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_predict_create(&p, &spec, 250.0, NULL, &observer, NULL),
                          DAL_STATUS_OK);
    CU_ASSERT(p->reason == DAL_PREDICTION_INTERRUPTED && p->steps == 128 && p->end == 32.0);
    CU_ASSERT(p->t[p->rows - 1] == 32.0);
    is_near(find(p, "E")->change, 64.0 * (-pow(0.25, 6) / 72.0 + pow(0.25, 8) / 576.0), 1e-8);
    dal_prediction_free(p);
}

static void refused(const dal_run_spec *spec, double T, dal_status status, const char *fragment)
{
    dal_prediction *p = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_predict_create(&p, spec, T, NULL, NULL, &error), status);
    CU_ASSERT_PTR_NULL(p);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
}

static void test_refused(void)
{
    const dal_setting displaced = {"p_x", 0.1};
    dal_run_spec spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_LIFTED, 0.25);
    refused(&spec, 0.3, DAL_STATUS_ARGUMENT, "no whole number of steps");
    refused(&spec, -1.0, DAL_STATUS_ARGUMENT, "no whole number of steps");
    refused(&spec, NAN, DAL_STATUS_ARGUMENT, "no whole number of steps");
    spec.start = &displaced;
    spec.start_count = 1;
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "p and pi are not 0");
    spec = fixture_spec(fixture_system(oscillator), "dop853", DAL_PHYSICAL, 0.25);
    spec.options.tolerance = 1e-9;
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "a tolerance");
    spec = fixture_spec(fixture_system("heisenberg"), "gni", DAL_PHYSICAL, 0.05);
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "multipliers pass from step to step");
    spec =
        fixture_spec(fixture_system("contact-oscillator"), "discrete-gradient", DAL_PHYSICAL, 0.05);
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "at midpoints alone");
    spec = fixture_spec(fixture_system("chaplygin-sleigh-vakonomic"), "rk4", DAL_PHYSICAL, 0.05);
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "vakonomic");
    spec = fixture_spec(fixture_system("bead-on-hoop"), "rk4", DAL_PHYSICAL, 0.05);
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "holonomic constraints");
    spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_PHYSICAL, 0.25);
    dal_integrator passing = *spec.method.layer[0];
    passing.properties |= DAL_PERSISTENT_ACCELERATION;
    spec.method.layer[0] = &passing;
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "accelerations pass from step to step");
    spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_PHYSICAL, 0.25);
    spec.options.precision = DAL_QUAD;
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "quad precision");
    spec = fixture_spec(fixture_system("chaplygin-sleigh-friction"), "rk4", DAL_PHYSICAL, 0.02);
    refused(&spec, 20.0, DAL_STATUS_UNSUPPORTED, "attractor");
    spec = fixture_spec(fixture_system("coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
                                       "events: [{when: x - 1, stop: true}]\n"),
                        "rk4", DAL_PHYSICAL, 0.25);
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "events");
    dal_system bare = *fixture_system("chaplygin-sleigh");
    bare.call.constraint = NULL;
    spec = fixture_spec(&bare, "rk4", DAL_PHYSICAL, 0.05);
    refused(&spec, 1.0, DAL_STATUS_UNSUPPORTED, "no constraint callback");
    dal_prediction *p = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL(predict(&p, oscillator, "rk4", 0.25, 0.75, 10, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "must be even"));
    CU_ASSERT_EQUAL(predict(&p, oscillator, "rk4", 0.25, 1.0, 1, &error), DAL_STATUS_ARGUMENT);
}

/* Nothing leaks where an allocation fails. */
static void test_out_of_memory(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("heisenberg"), "rk4", DAL_PHYSICAL, 0.05);
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal_prediction *p = NULL;
        dal_error error = {0};
        allocation_start(&trial);
        const dal_status status = dal_predict_create(&p, &spec, 0.5, NULL, NULL, &error);
        CU_ASSERT_EQUAL(p == NULL, allocation_end(&trial, status));
        dal_prediction_free(p);
    }
    CU_ASSERT(trial.failures >= 10);
}

void suite_predict(void)
{
    CU_pSuite suite = CU_add_suite("predicted drift", NULL, NULL);
    CU_add_test(suite, "closed form", test_closed_form);
    CU_add_test(suite, "mean rate", test_mean_rate);
    CU_add_test(suite, "the mean rate of motion that ends otherwise", test_transient);
    CU_add_test(suite, "quad precision", test_quad);
    CU_add_test(suite, "quad precision that fails", test_quad_fails);
    CU_add_test(suite, "a method that leaves D = 0", test_leaves_D);
    CU_add_test(suite, "the rate of the pendulum", test_rate_of_pendulum);
    CU_add_test(suite, "against runs", test_against_runs);
    CU_add_test(suite, "0 by reversibility", test_reversibility);
    CU_add_test(suite, "in phase, closed form", test_phase);
    CU_add_test(suite, "zeros in runs", test_zeros);
    CU_add_test(suite, "pieces", test_pieces);
    CU_add_test(suite, "ends", test_ends);
    CU_add_test(suite, "a motion that predictions share", test_shared_motion);
    CU_add_test(suite, "motions of another start", test_other_motions);
    CU_add_test(suite, "steps in quad precision", test_quad_steps);
    CU_add_test(suite, "interrupted", test_interrupted);
    CU_add_test(suite, "what is refused", test_refused);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
