/* test_stepmap.c - measures of a method: order, symplecticity, reversibility, pairing. */
#include "allocation.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <string.h>

/* ---- order ---- */

static void test_order(void)
{
    const struct {
        const char *method;
        double step, order;
    } cases[] = {{"symplectic-euler-10", 0.005, 1.0},
                 {"stormer-verlet", 0.025, 2.0},
                 {"rk4", 0.025, 4.0},
                 {"gauss4", 0.05, 4.0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const dal_run_spec spec = fixture_spec(fixture_system(fixture_full), cases[k].method,
                                               DAL_PHYSICAL, cases[k].step);
        dal_order order;
        CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 1.0, 3, NULL, NULL, NULL, NULL),
                        DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(order.order, cases[k].order, 0.1);
        CU_ASSERT_EQUAL(order.step[2], cases[k].step / 4.0);
        CU_ASSERT(order.error[0] > order.error[1] && order.error[1] > order.error[2]);
    }
}

/* Against the closed form; and nothing is claimed where rounding is all there is. */
static void test_order_of_reference(void)
{
    const double x[] = {sin(1.0), 1.0 - cos(1.0), 1.0, cos(1.0), sin(1.0), 1.0};
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "gauss6", DAL_PHYSICAL, 0.25);
    dal_order order;
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 1.0, 3, NULL, x, NULL, NULL), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(order.order, 6.0, 0.1);
    spec = fixture_spec(fixture_system("chaplygin-sleigh"), "gauss12", DAL_PHYSICAL, 0.0625);
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 1.0, 2, NULL, x, NULL, NULL), DAL_STATUS_OK);
    CU_ASSERT(isnan(order.order));
}

/* Slopes of errors h^3 and their noise; rk4 evaluates F four times a step. */
static void test_order_slopes(void)
{
    dal_order order = {.levels = 4,
                       .step = {1.0, 0.5, 0.1, 0.01},
                       .error = {8e-3, 1e-3, 8e-6, 8e-9},
                       .slope = {1.0}};
    dal_order_slopes(&order, 0.0);
    CU_ASSERT(isnan(order.slope[0]));
    for (int i = 1; i < 4; i++) CU_ASSERT_DOUBLE_EQUAL(order.slope[i], 3.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(order.order, 3.0, 1e-14);
    dal_order_slopes(&order, 1e-7); /* 8e-6 is above ten times that, 8e-9 is not */
    CU_ASSERT_EQUAL(order.order, order.slope[2]);
    dal_order_slopes(&order, 1e-6); /* two errors are left */
    CU_ASSERT(isnan(order.order));
}

static double order_of(int levels, double step, const double *error)
{
    dal_order order = {.levels = levels};
    for (int i = 0; i < levels; i++) {
        order.step[i] = ldexp(step, -i);
        order.error[i] = error[i];
    }
    dal_order_slopes(&order, 0.0);
    return order.order;
}

/* No order where the errors show none: one slope alone, slopes that do not agree, errors of the
 * size of the solution, of rounding, and none. */
static void test_no_order(void)
{
    const double inf = INFINITY;
    const double two[] = {1e-2, 1e-3}, jump[] = {0.3, 0.2, 5e-6}, bend[] = {0.4, 0.2, 0.07, 0.02};
    const double saturated[] = {1.7, 1.4, 0.49, 0.171}, flat[] = {0.9, 0.8, 0.71, 0.63};
    const double rounding[] = {1e-5, 1e-9, 1e-13, 2e-16}, failed[] = {NAN, NAN, 0.02, 0.01};
    const double infinite[] = {inf, inf, 0.02, 0.01}, zero[] = {1e-3, 1e-4, 0.0, 0.0};
    const double apart[] = {1e-2, 1e-3, 3e-3, 1e-3, 8e-4};
    CU_ASSERT(isnan(order_of(2, 0.1, two)));
    CU_ASSERT(isnan(order_of(3, 0.1, jump)));
    CU_ASSERT(isnan(order_of(4, 0.1, bend)));
    CU_ASSERT(isnan(order_of(4, 0.1, saturated)));
    CU_ASSERT(isnan(order_of(4, 0.1, flat)));
    CU_ASSERT(isnan(order_of(4, 0.1, rounding)));
    CU_ASSERT(isnan(order_of(4, 0.1, failed)));
    CU_ASSERT(isnan(order_of(4, 0.1, infinite)));
    CU_ASSERT(isnan(order_of(4, 0.1, zero)));
    CU_ASSERT(isnan(order_of(5, 0.1, apart)));
}

/* e = C h^p (1 + a h): the order is found for small a and not for large ones, and where it is found
 * it is p to about 0.1, whatever the ratios of the steps. */
static void test_order_and_the_next_term(void)
{
    static const double steps[][3] = {{0.1, 0.05, 0.025}, {0.1, 0.07, 0.02}, {0.1, 0.01, 0.008}};
    int found = 0;
    for (int k = 0; k < 3 * 8 * 61; k++) {
        const double *h = steps[k % 3], p = 1 + k / 3 % 8, a = 0.3 * (k / 24 - 30);
        dal_order order = {.levels = 3};
        for (int i = 0; i < 3; i++) {
            order.step[i] = h[i];
            order.error[i] = 0.1 * pow(h[i] / h[0], p) * (1.0 + a * h[i]);
        }
        dal_order_slopes(&order, 0.0);
        const double off = order.slope[2] - p;
        if (fabs(off) < 0.05) CU_ASSERT(order.order == order.slope[2]);
        if (fabs(off) > 0.15) CU_ASSERT(isnan(order.order));
        found += !isnan(order.order);
    }
    CU_ASSERT(found > 200 && found < 1400);
}

static void test_whole_steps(void)
{
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, 1.0, 0.1), 10);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, 1.0, 0.3), 0);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, -1.0, -0.25), 4);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, 1.0, -0.25), 0);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, 0.1, 1.0), 0);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, 1.0, 0.0), 0);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, 0x1p53, 1.0), 0);
    CU_ASSERT_EQUAL(dal_whole_steps(0.0, 0x1p53 - 1.0, 1.0), (1LL << 53) - 1);
    /* Between times, relative to the later one. */
    CU_ASSERT_EQUAL(dal_whole_steps(1e6, 1e6 + 1.0 + 0.9e-3, 0.25), 4);
    CU_ASSERT_EQUAL(dal_whole_steps(1e6, 1e6 + 1.0 + 1.1e-3, 0.25), 0);
}

/* T is a whole number of steps to 1e-9 of itself. */
static void test_order_whole_steps(void)
{
    static const double off[] = {0.9e-9, -0.9e-9, 1.1e-9, -1.1e-9};
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_PHYSICAL, 0.25);
    for (int i = 0; i < 4; i++) {
        dal_order order;
        CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 1.0 + off[i], 2, NULL, NULL, NULL, NULL),
                        i < 2 ? DAL_STATUS_OK : DAL_STATUS_ARGUMENT);
    }
}

/* x'' = x^3 from x = 100 leaves all numbers: a run that fails is not compared. */
static dal_status go_on(void *user, dal_run *run)
{
    (void)user, (void)run;
    return DAL_STATUS_OK;
}

static void test_order_fails(void)
{
    static const char text[] = "coordinates: [x]\naccelerations: {x: x^3}\nstart: {x: 100}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.125);
    const dal_observer observers[] = {{.poll = NULL}, {.poll = go_on}};
    const double x[] = {0.0, 0.0};
    for (int i = 0; i < 2; i++) {
        dal_order order;
        dal_error error = {0};
        CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 4.0, 2, NULL, x, &observers[i], &error),
                        DAL_STATUS_NOT_FINITE);
        CU_ASSERT_EQUAL(error.status, DAL_STATUS_NOT_FINITE);
    }
}

static void test_order_work(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_PHYSICAL, 0.25);
    dal_order order;
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 1.0, 3, NULL, NULL, NULL, NULL),
                    DAL_STATUS_OK);
    for (int i = 0; i < 3; i++) CU_ASSERT_EQUAL(order.evaluations[i], 16LL << i);
}

static void test_order_refuses(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_LIFTED, 0.3);
    dal_order order;
    dal_error error;
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 1.0, 3, NULL, NULL, NULL, &error),
                    DAL_STATUS_ARGUMENT);
    CU_ASSERT(strstr(error.message, "whole number of steps") != NULL);
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 0.9, 1, NULL, NULL, NULL, &error),
                    DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_order_measure(&order, &spec, 0.9, 9, NULL, NULL, NULL, &error),
                    DAL_STATUS_ARGUMENT);
}

/* ---- symplecticity ---- */

static const char oscillator[] = "coordinates: [x]\naccelerations: {x: -x}\nstart: {x: 0.7}\n";

/* On p = pi = 0 the lifted oscillator is linear with the matrix B on (q, v, p, pi),
 *     q' = v, v' = -q + pi/e, p' = pi, pi' = -p;
 * rk4 steps by R(hB), R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24, and because B is Hamiltonian
 *     R(hB)^T Omega R(hB) - Omega = Omega (R(-hB) R(hB) - 1). */
static void multiply(double a[4][4], double b[4][4], double out[4][4])
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            out[i][j] = 0.0;
            for (int k = 0; k < 4; k++) out[i][j] += a[i][k] * b[k][j];
        }
}

static void stability(double B[4][4], double h, double out[4][4])
{
    double term[4][4], next[4][4];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) out[i][j] = term[i][j] = i == j;
    for (int k = 1; k <= 4; k++) {
        multiply(term, B, next);
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++) out[i][j] += term[i][j] = next[i][j] * h / k;
    }
}

/* For x and v in a unit, p and pi in its reciprocal. */
static double expected_rk4_defect(double h, double unit)
{
    double B[4][4] = {{0, 1, 0, 0}, {-1, 0, 0, 1.0 / (unit * unit)}, {0, 0, 0, 1}, {0, 0, -1, 0}};
    double forward[4][4], backward[4][4], both[4][4], max = 0.0;
    stability(B, h, forward);
    stability(B, -h, backward);
    multiply(backward, forward, both);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) max = fmax(max, fabs(both[i][j] - (i == j)));
    return max;
}

static void test_symplecticity_closed_form(void)
{
    const double h = 0.4;
    dal_run_spec spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_LIFTED, h);
    double defect;
    CU_ASSERT_EQUAL(dal_check_symplecticity(&spec, 0.0, NULL, 0.0, &defect, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(spec.system->units[0], spec.system->units[1]);
    CU_ASSERT_DOUBLE_EQUAL(defect, expected_rk4_defect(h, spec.system->units[0]), 1e-11);
    CU_ASSERT(defect > 1e-5);
}

static void test_symplecticity(void)
{
    const struct {
        const char *method;
        int symplectic;
    } cases[] = {{"symplectic-euler-00", 1},
                 {"symplectic-euler-10", 1},
                 {"stormer-verlet", 1},
                 {"implicit-midpoint", 1},
                 {"gauss4", 1},
                 {"rk4", 0},
                 {"gauss4+project", 0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(fixture_full), cases[k].method, DAL_LIFTED, 0.1);
        dal_run *run = fixture_run(&spec);
        double defect;
        fixture_perturb(run, 0.5);
        CU_ASSERT_EQUAL(dal_check_symplecticity(&spec, 0.3, dal_run_state(run), 0.0, &defect, NULL),
                        DAL_STATUS_OK);
        CU_ASSERT(cases[k].symplectic ? defect < 1e-10 : defect > 1e-8);
        dal_run_free(run);
    }
}

/* The angle of a pendulum that has gone round 16000 times. */
static void test_symplecticity_far(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("coordinates: [phi]\n"
                                                          "accelerations: {phi: -sin(phi)}\n"
                                                          "start: {phi: 1e5, phi': 1}\n"),
                                           "stormer-verlet", DAL_LIFTED, 0.1);
    dal_run *run = fixture_run(&spec);
    double defect;
    fixture_perturb(run, 0.5);
    CU_ASSERT_EQUAL(dal_check_symplecticity(&spec, 0.0, dal_run_state(run), 0.0, &defect, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT(defect < 1e-6);
    dal_run_free(run);
}

static void test_symplecticity_place(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(fixture_full), "rk4", DAL_LIFTED, 0.1);
    dal_run *run = fixture_run(&spec);
    double early, late;
    fixture_perturb(run, 0.5);
    const double *state = dal_run_state(run);
    CU_ASSERT_EQUAL(dal_check_symplecticity(&spec, 0.0, state, 0.0, &early, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_check_symplecticity(&spec, 0.9, state, 0.0, &late, NULL), DAL_STATUS_OK);
    CU_ASSERT(fabs(early - late) > 1e-3 * early);
    spec.options.space = DAL_PHYSICAL;
    CU_ASSERT_EQUAL(dal_check_symplecticity(&spec, 0.0, NULL, 0.0, &early, NULL),
                    DAL_STATUS_UNSUPPORTED);
    dal_run_free(run);
}

/* ---- reversibility ---- */

/* Explicit Euler on x'' = -x: rho Phi rho Phi = (1 - hA)(1 + hA) = 1 + h^2.  x = 0.7 is larger than
 * its unit. */
static void test_reversibility_closed_form(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(oscillator), "symplectic-euler-00", DAL_PHYSICAL, 0.1);
    double defect;
    CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, NULL, &defect, NULL), DAL_STATUS_OK);
    CU_ASSERT(spec.system->units[0] < 0.7);
    CU_ASSERT_DOUBLE_EQUAL(defect, 0.1 * 0.1, 1e-15);
}

/* Off p = pi = 0 as well, where rho turns p and pi_e but not pi. */
static void test_reversibility(void)
{
    const char *const systems[] = {"contact-oscillator", "chaplygin-sleigh", "appell-hamel"};
    for (size_t k = 0; k < sizeof systems / sizeof *systems; k++) {
        const char *const methods[] = {"implicit-midpoint", "gauss8", "stormer-verlet", "rk4"};
        for (int i = 0; i < 4; i++) {
            const dal_run_spec spec =
                fixture_spec(fixture_system(systems[k]), methods[i], DAL_LIFTED, 0.2);
            dal_run *run = fixture_run(&spec);
            double defect;
            fixture_perturb(run, 0.5);
            CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, dal_run_state(run), &defect, NULL),
                            DAL_STATUS_OK);
            CU_ASSERT(i < 3 ? defect < 1e-14 : defect > 1e-10);
            dal_run_free(run);
        }
    }
}

/* F(q,-v,-t) = F(q,v,t) where time enters by cos(t): the second step begins at minus the time. */
static void test_reversibility_in_time(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\naccelerations: {x: -x*(1 + cos(t)/2)}\n"),
                     "gauss4", DAL_PHYSICAL, 0.1);
    const double state[] = {0.7, 0.4};
    double defect;
    CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.8, state, &defect, NULL), DAL_STATUS_OK);
    CU_ASSERT(defect < 1e-15);
}

/* A motion that friction makes irreversible is so with a symmetric method, too; a vakonomic one
 * turns round when g changes its sign with v. */
static void test_irreversible_and_vakonomic(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh-friction");
    dal_run_spec spec = fixture_spec(system, "gauss8", DAL_PHYSICAL, 0.1);
    const double state[] = {0.1, 0.2, 0.3, 1.0, 0.5, 1.0};
    double defect;
    CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, state, &defect, NULL), DAL_STATUS_OK);
    CU_ASSERT(defect > 0.01);
    system = fixture_system("chaplygin-sleigh-vakonomic");
    spec = fixture_spec(system, "gauss8", DAL_PHYSICAL, 0.1);
    CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, NULL, &defect, NULL), DAL_STATUS_OK);
    CU_ASSERT(defect < 1e-14);
}

/* ---- pairing ---- */

static double pairing_of(const char *text, const char *method, long long steps)
{
    const double direction[] = {0.3, -0.2, 0.5, 0.1, 0.4, -0.6};
    const dal_setting start[] = {{"p_x", 0.7}, {"p_z", -0.4}, {"pi_y", 0.5}, {"e", 2.0}};
    dal_statistics pairing;
    const dal_system *tangent = fixture_tangent(text);
    dal_run_spec spec = fixture_spec(fixture_system(text), method, DAL_LIFTED, 0.05);
    spec.start = start;
    spec.start_count = 4;
    CU_ASSERT_EQUAL(dal_adjoint_pairing(&spec, tangent, direction, steps, &pairing, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(pairing.count, steps + 1);
    /* p.dq + pi.dv at the start */
    CU_ASSERT_DOUBLE_EQUAL(pairing.first, 0.7 * 0.3 - 0.4 * 0.5 + 0.5 * 0.4, 1e-15);
    return dal_statistics_deviation(&pairing);
}

static void test_pairing(void)
{
    const long long steps = long_run(100000) / 100;
    CU_ASSERT(pairing_of(fixture_bilinear, "implicit-midpoint", steps) < 1e-13);
    CU_ASSERT(pairing_of(fixture_bilinear, "stormer-verlet", steps) < 1e-13);
    CU_ASSERT(pairing_of(fixture_bilinear, "symplectic-euler-10", 20) < 1e-13);
    CU_ASSERT(pairing_of(fixture_bilinear, "rk4", steps) > 1e-9);
}

/* ---- memory ---- */

static dal_status all_measures(const dal_run_spec *spec, const dal_system *tangent)
{
    const double direction[6] = {1.0};
    double number;
    dal_order order;
    dal_statistics pairing;
    dal_status status = dal_order_measure(&order, spec, 0.5, 2, NULL, NULL, NULL, NULL);
    if (!status) status = dal_check_symplecticity(spec, 0.0, NULL, 0.0, &number, NULL);
    if (!status) status = dal_check_reversibility(spec, 0.0, NULL, &number, NULL);
    if (!status) status = dal_adjoint_pairing(spec, tangent, direction, 2, &pairing, NULL);
    return status;
}

static void test_out_of_memory(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(fixture_bilinear), "rk4", DAL_LIFTED, 0.25);
    const dal_system *tangent = fixture_tangent(fixture_bilinear);
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        allocation_start(&trial);
        allocation_end(&trial, all_measures(&spec, tangent));
    }
    CU_ASSERT(trial.failures >= 8);
}

/* A system without units of its own has units of 1: explicit Euler there and back takes x of an
 * oscillator to (1 + h^2) x. */
static void test_without_units(void)
{
    const dal_system hand = {.name = "hand", .n = 1, .call.field = fixture_oscillate};
    const dal_run_spec spec = fixture_spec(&hand, "symplectic-euler-00", DAL_PHYSICAL, 0.125);
    const double state[] = {0x1p-10, 0.0};
    double defect = NAN;
    CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, state, &defect, NULL), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(defect, 0x1p-16, 1e-20);
}

void suite_stepmap(void)
{
    CU_pSuite suite = CU_add_suite("measures of a method", NULL, NULL);
    CU_add_test(suite, "order", test_order);
    CU_add_test(suite, "order against a closed form", test_order_of_reference);
    CU_add_test(suite, "order: slopes", test_order_slopes);
    CU_add_test(suite, "order: none to be found", test_no_order);
    CU_add_test(suite, "order: the next term", test_order_and_the_next_term);
    CU_add_test(suite, "the order at whole steps", test_order_whole_steps);
    CU_add_test(suite, "order of runs that fail", test_order_fails);
    CU_add_test(suite, "whole steps", test_whole_steps);
    CU_add_test(suite, "order: work", test_order_work);
    CU_add_test(suite, "order: what is refused", test_order_refuses);
    CU_add_test(suite, "symplecticity of rk4, closed form", test_symplecticity_closed_form);
    CU_add_test(suite, "symplecticity", test_symplecticity);
    CU_add_test(suite, "symplecticity far away", test_symplecticity_far);
    CU_add_test(suite, "symplecticity at a time, in a space", test_symplecticity_place);
    CU_add_test(suite, "reversibility of Euler, closed form", test_reversibility_closed_form);
    CU_add_test(suite, "reversibility off p = pi = 0", test_reversibility);
    CU_add_test(suite, "reversibility where time enters", test_reversibility_in_time);
    CU_add_test(suite, "irreversible and vakonomic motion", test_irreversible_and_vakonomic);
    CU_add_test(suite, "pairing", test_pairing);
    CU_add_test(suite, "out of memory", test_out_of_memory);
    CU_add_test(suite, "reversibility without units", test_without_units);
}
