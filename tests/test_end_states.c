/* test_end_states.c - end states known to 13 digits, the offset sleigh from rest to rest, rolling
 * disks, vehicles with wheels. */
#include "motion.h"

#include <CUnit/Basic.h>
#include <math.h>

#define PI 3.14159265358979323846
/* Two independent integrations agree to 6e-14, the digits printed to 5e-14; as much for this one.
 */
#define THIRTEEN_DIGITS 2e-13
/* gauss8 in some hundred steps to the unit of time. */
#define BY_GAUSS8 1e-12

static const motion_settings none = {0};

/* ---- end states ---- */

static void check_end(const char *name, motion_settings start, double T, const double *expected)
{
    for (int space = 0; space < 2; space++) {
        motion z = motion_open(name, space ? DAL_LIFTED : DAL_PHYSICAL, 0.01, none, start);
        motion_advance(&z, T);
        CU_ASSERT(reference_distance(2 * z.n, z.x, expected) < THIRTEEN_DIGITS);
        motion_close(&z);
    }
}

static void test_contact(void)
{
    const motion_settings start = {
        6, {{"x", 0.8}, {"y", 0.6}, {"z", -0.5}, {"x'", -0.24}, {"y'", 0.7}, {"z'", 0.4}}};
    check_end("contact-oscillator", start, 1.0,
              (double[]){0.2697845407561, 0.9132110728864, 0.1292207494387, -0.6961539931339,
                         -0.1266709767770, 0.7623144460279});
    check_end("contact-oscillator", start, 10.0,
              (double[]){0.0023416305916, -0.8842576950684, -0.1547264214258, 0.7046811164488,
                         -0.2609374038199, 0.7969182743660});
    motion z = motion_open("contact-oscillator", DAL_PHYSICAL, 0.01, none, start);
    CU_ASSERT(fabs(motion_energy(&z) - 1.0028) < 1e-15);
    motion_close(&z);
}

static void test_incline(void)
{
    check_end("chaplygin-sleigh-incline", none, 1.0,
              (double[]){1.2303173219572, 1.3259998066095, 0.9477957970084, 0.1327768526135,
                         0.9333477376258, 0.4367524563532});
    check_end("chaplygin-sleigh-incline", none, 5.0,
              (double[]){0.8966762690773, 1.4683575456213, 1.7336135677658, -0.0628236813976,
                         -0.9418771886772, 0.2146699968446});
}

static void test_appell_hamel(void)
{
    check_end("appell-hamel-harmonic", none, 1.0,
              (double[]){0.9408992146138, 0.3536347529745, 1.4660252969470, 0.1246609633716,
                         0.5302439477038, 0.6089940474516});
    motion z = motion_default("appell-hamel-harmonic", 0.01);
    CU_ASSERT(fabs(motion_energy(&z) - 1.5275) < 1e-15);
    motion_close(&z);
}

/* ---- the offset sleigh ---- */

typedef struct sleigh {
    double m, I, a;
} sleigh;

static motion open_sleigh(const sleigh *s, double v, double w)
{
    const motion_settings set = {
        6, {{"m", s->m}, {"I", s->I}, {"a", s->a}, {"v0", v}, {"omega0", w}, {"phi0", 0.0}}};
    return motion_open("chaplygin-sleigh-offset", DAL_PHYSICAL, 0.05, set, none);
}

/* From v = -V, all but at rest in phi, to v = +V: pi sqrt(1 + I/(m a^2)), whatever the energy. */
static void test_turning(void)
{
    static const sleigh sleighs[] = {{1.3, 0.7, 0.6}, {1.0, 1.0, 1.0}, {0.8, 2.0, 1.1}};
    for (int i = 0; i < 3; i++) {
        const sleigh *s = &sleighs[i];
        double J = s->I + s->m * s->a * s->a, V = 1.0 + 0.1 * i, rate = s->a * s->m * V / J;
        motion z = open_sleigh(s, -V, 1e-12);
        motion_advance(&z, 0.05 * ceil(60.0 / rate / 0.05));
        CU_ASSERT(fabs(z.x[2] - PI * sqrt(1 + s->I / (s->m * s->a * s->a))) < 1e-11);
        CU_ASSERT(fabs(z.x[3] * cos(z.x[2]) + z.x[4] * sin(z.x[2]) - V) < 1e-11);
        CU_ASSERT(fabs(z.x[5]) < 1e-11);
        motion_close(&z);
    }
}

/* Near v = +V phi' falls by exp(-rate), rate = a m V/J, in the unit of time. */
static void test_attractor(void)
{
    const sleigh s = {1.3, 0.7, 0.6};
    double J = s.I + s.m * s.a * s.a, V = 1.2, w[2];
    motion z = open_sleigh(&s, V, 1e-6);
    for (int k = 0; k < 2; k++) {
        w[k] = z.x[5];
        motion_advance(&z, 1.0);
    }
    w[1] = z.x[5];
    CU_ASSERT(fabs(log(w[0] / w[1]) - s.a * s.m * V / J) < 1e-9);
    motion_close(&z);
}

/* ---- disks ---- */

static void test_disk_reduced(void)
{
    motion full = motion_default("falling-disk", 0.01),
           reduced = motion_default("falling-disk-reduced", 0.01);
    for (int k = 1; k <= 4; k++) {
        motion_advance(&full, 0.5 * k);
        motion_advance(&reduced, 0.5 * k);
        CU_ASSERT(reference_distance(3, full.x + 2, reduced.x) < BY_GAUSS8);
        CU_ASSERT(reference_distance(3, full.x + 7, reduced.x + 3) < BY_GAUSS8);
    }
    motion_close(&full);
    motion_close(&reduced);
}

/* Steady rolling on a circle: A cot q^2 - (C + m r^2) q s = m g r cos(theta), p = 0. */
static void test_disk_circle(void)
{
    double m = 1.2, g = 0.9, r = 0.8, A = 0.3, C = 0.5, theta = 1.1, q = -0.7;
    double cot = cos(theta) / sin(theta);
    double s = (A * cot * q * q - m * g * r * cos(theta)) / ((C + m * r * r) * q);
    double turn = q / sin(theta), spin = s - turn * cos(theta);
    const motion_settings set = {9,
                                 {{"m", m},
                                  {"g", g},
                                  {"r", r},
                                  {"A", A},
                                  {"C", C},
                                  {"theta0", theta},
                                  {"p0", 0.0},
                                  {"q0", q},
                                  {"s0", s}}};
    motion z = motion_open("falling-disk", DAL_LIFTED, 0.01, set, none);
    for (double t = 0.5; t <= 2.0; t += 0.5) {
        motion_advance(&z, t);
        double R = r * s / turn;
        double expected[] = {-R * sin(turn * t), -R * (1 - cos(turn * t)), theta, turn * t,
                             spin * t};
        CU_ASSERT(reference_distance(5, z.x, expected) < BY_GAUSS8);
    }
    motion_close(&z);
}

/* The disk's axis and its integrals against the rates of q and s by theta, which are linear:
 * dq/dtheta = -cot q + C/A s, ds/dtheta = m r^2/(C + m r^2) q. */
static void test_disk_rates(void)
{
    motion z = motion_default("falling-disk", 0.01);
    double F[5], m = 1, r = 1, A = 0.25, C = 0.5;
    for (int k = 0; k < 4; k++) {
        double theta = z.x[2], p = z.x[7], phi = z.x[8], c = cos(theta), s = sin(theta);
        double q = phi * s, spin = z.x[9] + phi * c;
        motion_field(&z, F);
        double dq = F[3] * s + phi * p * c, ds = F[4] + F[3] * c - phi * p * s;
        CU_ASSERT(fabs(dq - p * (-c / s * q + C / A * spin)) < BY_GAUSS8);
        CU_ASSERT(fabs(ds - p * m * r * r / (C + m * r * r) * q) < BY_GAUSS8);
        motion_advance(&z, 0.4 * (k + 1));
    }
    motion_close(&z);
}

/* ---- wheels ---- */

static void check_kept(const char *name, double T)
{
    motion z = motion_default(name, 0.01);
    double E = motion_energy(&z), before[REFERENCE_MAX];
    for (int i = 0; i < z.b.system->invariants; i++) before[i] = motion_invariant(&z, i);
    motion_advance(&z, T);
    CU_ASSERT(fabs(motion_energy(&z) - E) < BY_GAUSS8);
    for (int i = 0; i < z.b.system->invariants; i++)
        CU_ASSERT(fabs(motion_invariant(&z, i) - before[i]) < BY_GAUSS8);
    motion_close(&z);
}

static void test_snakeboard(void) { check_kept("snakeboard", 10.0); }

/* The arm comes to rest, and the racer goes round in a circle for ever. */
static void test_roller_racer(void)
{
    check_kept("roller-racer", 5.0);
    motion z = motion_default("roller-racer", 0.05);
    double E = motion_energy(&z);
    motion_advance(&z, 100.0);
    double v = hypot(z.x[4], z.x[5]), phi = z.x[3], turn = z.x[6];
    CU_ASSERT(fabs(z.x[7]) < BY_GAUSS8);
    CU_ASSERT(fabs((v * v + 1.5 * turn * turn) / 2 - E) < BY_GAUSS8);
    CU_ASSERT(fabs(turn * (cos(phi) + 0.4) - v * sin(phi)) < BY_GAUSS8);
    motion_close(&z);
}

/* psi'' = -V cos(psi)/(3 Jw + m R^2) on its own, by RK4; theta = turn t. */
static void test_mobile_robot(void)
{
    motion z = motion_default("mobile-robot", 0.01);
    double psi = 0.0, w = 1.0, h = 2.5e-4;
    for (int i = 0; i < 8000; i++) {
        double k1 = -2.5 * cos(psi), k2 = -2.5 * cos(psi + h / 2 * w);
        double k3 = -2.5 * cos(psi + h / 2 * (w + h / 2 * k1));
        double k4 = -2.5 * cos(psi + h * (w + h / 2 * k2));
        psi += h * w + h * h / 6 * (k1 + k2 + k3);
        w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    motion_advance(&z, 2.0);
    CU_ASSERT(fabs(z.x[2] - 1.0) < BY_GAUSS8);
    CU_ASSERT(fabs(z.x[3] - psi) < BY_GAUSS8 && fabs(z.x[7] - w) < BY_GAUSS8);
    CU_ASSERT(fabs(z.x[4] - cos(1.0) * w) < BY_GAUSS8);
    motion_close(&z);
}

void suite_end_states(void)
{
    CU_pSuite suite = CU_add_suite("end states: sleighs, disks, wheels", NULL, NULL);
    CU_add_test(suite, "end states: contact oscillator", test_contact);
    CU_add_test(suite, "end states: sleigh on an incline", test_incline);
    CU_add_test(suite, "end state: Appell-Hamel in a well", test_appell_hamel);
    CU_add_test(suite, "offset sleigh: total turning angle", test_turning);
    CU_add_test(suite, "offset sleigh: rate of the attractor", test_attractor);
    CU_add_test(suite, "falling disk: reduced equations", test_disk_reduced);
    CU_add_test(suite, "falling disk: steady circles", test_disk_circle);
    CU_add_test(suite, "falling disk: linear rates", test_disk_rates);
    CU_add_test(suite, "snakeboard", test_snakeboard);
    CU_add_test(suite, "roller racer", test_roller_racer);
    CU_add_test(suite, "mobile robot", test_mobile_robot);
}
