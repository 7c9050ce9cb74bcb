/* test_closed_forms.c - closed forms of systems whose files have none, for they need quadratures,
 * hold for some parameters only, or give a part of the motion. */
#include "motion.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#define PI 3.14159265358979323846
/* gauss8 in some hundred steps to the unit of time, RK4 and Simpson's rule in some thousand. */
#define SMALL 1e-12

static const motion_settings none = {0};

static bool near(double a, double b) { return fabs(a - b) < SMALL * fmax(1.0, fabs(b)); }

/* ---- oscillators ---- */

/* At eps = 0 and b = 1 a period of y turns (x, z, u), u = sqrt(1 + y^2) z', by 2 pi times
 * 0.4126094444926318 about an axis. */
static void period_map(double R[3][3])
{
    for (int j = 0; j < 3; j++) {
        double u = (j == 2) / sqrt(2.0);
        const motion_settings
            set = {1, {{"eps", 0.0}}},
            start = {
                6, {{"x", j == 0}, {"z", j == 1}, {"y", 1.0}, {"x'", -u}, {"y'", 0.0}, {"z'", u}}};
        motion z = motion_open("contact-oscillator", DAL_PHYSICAL, PI / 256, set, start);
        motion_advance(&z, 2 * PI);
        CU_ASSERT(near(z.x[1], 1.0) && near(z.x[4], 0.0));
        R[0][j] = z.x[0], R[1][j] = z.x[2], R[2][j] = z.x[5] * sqrt(2.0);
        motion_close(&z);
    }
}

static void test_contact(void)
{
    static const double axis[] = {0.4962995, -0.8681514, 0.0}, digits = 1e-7;
    double R[3][3];
    period_map(R);
    CU_ASSERT(near(R[0][0] + R[1][1] + R[2][2], 1 + 2 * cos(2 * PI * 0.4126094444926318)));
    for (int i = 0; i < 3; i++) {
        double turned = 0.0;
        for (int j = 0; j < 3; j++) turned += R[i][j] * axis[j];
        CU_ASSERT(fabs(turned - axis[i]) < digits);
        for (int j = 0; j < 3; j++) {
            double product = R[0][i] * R[0][j] + R[1][i] * R[1][j] + R[2][i] * R[2][j];
            CU_ASSERT(near(product, i == j));
        }
    }
}

/* The published starts: H = 1.5 and H_y = 0.5 whatever z0; and 3.06 whatever the angle. */
static void test_levels(void)
{
    for (int k = 0; k < 4; k++) {
        const motion_settings z0 = {1, {{"z0", -0.75 + 0.2 * k}}},
                              angle = {1, {{"angle", PI / 9 * k}}};
        motion contact = motion_open("contact-oscillator", DAL_PHYSICAL, 0.1, z0, none);
        motion chaos = motion_open("chaotic-oscillators", DAL_PHYSICAL, 0.1, angle, none);
        CU_ASSERT(fabs(motion_energy(&contact) - 1.5) < 1e-15);
        CU_ASSERT(fabs(motion_invariant(&contact, 0) - 0.5) < 1e-15);
        CU_ASSERT(fabs(motion_energy(&chaos) - 3.06) < 1e-14);
        motion_close(&contact);
        motion_close(&chaos);
    }
}

/* integral of f from 0 to t by Simpson's rule. */
static double simpson(double (*f)(double s, const double *p), const double *p, double t)
{
    enum { PANELS = 4000 };
    double sum = f(0.0, p) + f(t, p);
    for (int i = 1; i < PANELS; i++) sum += (i % 2 ? 4 : 2) * f(t * i / PANELS, p);
    return sum * t / (3 * PANELS);
}

static double elliptic(double s, const double *B)
{
    return 1.0 / sqrt(1.0 + *B * *B * sin(s) * sin(s));
}

/* y = B sin(t), x = X sin(sigma) with the incomplete elliptic integral sigma = F(t | -B^2). */
static void test_oscillator(void)
{
    const double X = 0.8, B = 1.3;
    const motion_settings set = {2, {{"vx", X}, {"vy", B}}};
    for (int space = 0; space < 2; space++) {
        motion z = motion_open("nonholonomic-particle", space ? DAL_LIFTED : DAL_PHYSICAL, 0.01,
                               set, none);
        for (int t = 1; t <= 4; t++) {
            motion_advance(&z, t);
            double sigma = simpson(elliptic, &B, t), y = B * sin(t);
            CU_ASSERT(near(z.x[1], y) && near(z.x[0], X * sin(sigma)));
            CU_ASSERT(near(z.x[3], X * cos(sigma) / sqrt(1 + y * y)));
        }
        motion_close(&z);
    }
}

/* A central force leaves x and y to themselves, and z' = y x' - x y' is a constant. */
static void test_heisenberg(void)
{
    const motion_settings set = {3, {{"kx", 1.0}, {"ky", 1.0}, {"kz", 0.0}}};
    motion z = motion_open("heisenberg", DAL_LIFTED, 0.01, set, none);
    motion_advance(&z, 3.0);
    CU_ASSERT(near(z.x[0], 0.8 * cos(3.0) + 0.4 * sin(3.0)));
    CU_ASSERT(near(z.x[1], -0.5 * cos(3.0) + 0.9 * sin(3.0)));
    CU_ASSERT(near(z.x[2], 3.0 * (-0.5 * 0.4 - 0.8 * 0.9)));
    motion_close(&z);
}

/* ---- the transmission ---- */

/* The pendulum by itself, by RK4; and what it cannot change. */
static double torque(double eps, double xi) { return -sin(xi) - eps * cos(2 * xi); }

static void test_cvt(void)
{
    static const double spins[] = {1.0, 2.6};
    for (int k = 0; k < 2; k++) {
        const motion_settings set = {1, {{"spin", spins[k]}}};
        double xi = 0.0, w = spins[k], h = 2.5e-4;
        motion z = motion_open("pendulum-cvt", DAL_PHYSICAL, 0.01, set, none);
        for (int i = 0; i < 8000; i++) {
            double k1 = torque(0.2, xi), k2 = torque(0.2, xi + h / 2 * w);
            double k3 = torque(0.2, xi + h / 2 * (w + h / 2 * k1));
            double k4 = torque(0.2, xi + h * (w + h / 2 * k2));
            xi += h * w + h * h / 6 * (k1 + k2 + k3);
            w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        motion_advance(&z, 2.0);
        CU_ASSERT(near(z.x[0], xi) && near(z.x[3], w));
        CU_ASSERT(near(motion_invariant(&z, 0), 0.5));
        motion_close(&z);
    }
}

/* ---- turntables ---- */

/* The energy goes up and down, the moving energy does not; on a tilted table not even that. */
static void test_turntable(void)
{
    motion z = motion_default("turntable-ball", 0.02);
    double min = motion_energy(&z), max = min, moving = motion_invariant(&z, 0);
    for (int k = 1; k <= 20; k++) {
        motion_advance(&z, k);
        min = fmin(min, motion_energy(&z)), max = fmax(max, motion_energy(&z));
        CU_ASSERT(near(motion_invariant(&z, 0), moving));
    }
    CU_ASSERT(max - min > 0.5 * min);
    motion_close(&z);
}

/* A ball started with the drift i G/kappa keeps it: along the level lines, not down. */
static void test_tilted(void)
{
    double kappa = 1.3 * 0.4 / 1.4, G = 0.2 / 1.4, beta = 0.4, T = 4.0;
    const motion_settings set = {2,
                                 {{"u0", -G * sin(beta) / kappa}, {"v0", G * cos(beta) / kappa}}};
    motion z = motion_open("turntable-ball-tilted", DAL_LIFTED, 0.02, set, none);
    motion_advance(&z, T);
    CU_ASSERT(near(z.x[0], 0.5 - T * G * sin(beta) / kappa));
    CU_ASSERT(near(z.x[1], 0.2 + T * G * cos(beta) / kappa));
    motion_close(&z);
}

/* ---- Suslov ---- */

/* (sqrt(I11) w1, sqrt(I22) w2) = rho (cos f, sin f) turns to the attractor. */
static void test_suslov(void)
{
    const double I11 = 1, I22 = 2, I13 = 0.5, I23 = 0.1;
    double al = I13 / sqrt(I11), be = I23 / sqrt(I22), d = atan2(be, al);
    double c0 = sqrt(I11) * 0.5, s0 = sqrt(I22) * 0.4, rho = hypot(c0, s0), f0 = atan2(s0, c0);
    double k = rho * hypot(al, be) / sqrt(I11 * I22);
    motion z = motion_default("suslov", 0.02);
    for (int t = 2; t <= 8; t += 2) {
        motion_advance(&z, t);
        double b = z.x[1], g = z.x[2], w1 = z.x[3] * sin(b) * sin(g) + z.x[4] * cos(g);
        double w2 = z.x[3] * sin(b) * cos(g) - z.x[4] * sin(g);
        double f = d + atan(sinh(k * t + asinh(tan(f0 - d))));
        CU_ASSERT(near(sqrt(I11) * w1, rho * cos(f)) && near(sqrt(I22) * w2, rho * sin(f)));
    }
    motion_close(&z);
}

/* ---- nonlinear constraints ---- */

static void test_benenti(void)
{
    for (int space = 0; space < 2; space++) {
        motion z = motion_open("benenti", space ? DAL_LIFTED : DAL_PHYSICAL, 0.01, none, none);
        double c = cos(0.7), across = (0.9 * 0.9 + 2 * 0.4 * 0.4) * c * c, E = motion_energy(&z);
        motion_advance(&z, 0.6);
        CU_ASSERT(near(motion_invariant(&z, 0), 0.9 - 0.4) &&
                  near(motion_invariant(&z, 1), across));
        CU_ASSERT(near(motion_energy(&z), E));
        motion_close(&z);
    }
}

/* y over x is Bouguer's curve, and the target is met at V x0/(V^2 - U^2). */
static void test_pursuit(void)
{
    const double k = 0.6, x0 = 2.0, meeting = x0 / (1 - k * k);
    motion z = motion_default("pursuit", 0.005);
    for (int i = 1; i <= 5; i++) {
        motion_advance(&z, 0.5 * i);
        double u = z.x[0] / x0, closing = hypot(z.x[0], z.x[1] - k * 0.5 * i);
        double y = x0 / 2 * (pow(u, 1 + k) / (1 + k) - pow(u, 1 - k) / (1 - k));
        CU_ASSERT(near(z.x[1], y + k * x0 / (1 - k * k)));
        CU_ASSERT(near(closing + k * (k * 0.5 * i - z.x[1]), (1 - k * k) * (meeting - 0.5 * i)));
    }
    motion_close(&z);
}

/* tan(theta/2) = tan(theta0/2) (1 + a t/s0)^(-P/a) with theta from the pull; the path is an
 * integral of that. */
static double flight_x(double t, const double *p)
{
    double theta = p[1] + 2 * atan(p[2] * pow(1 + 0.2 * t, -p[0] / 0.2));
    return (1 + 0.2 * t) * cos(theta);
}

static double flight_y(double t, const double *p)
{
    double theta = p[1] + 2 * atan(p[2] * pow(1 + 0.2 * t, -p[0] / 0.2));
    return (1 + 0.2 * t) * sin(theta);
}

static void test_rocket(void)
{
    double px = 0.45, py = -0.4, to = atan2(py, px);
    double p[] = {hypot(px, py), to, tan((1.1 - to) / 2)};
    for (int space = 0; space < 2; space++) {
        motion z = motion_open("rocket", space ? DAL_LIFTED : DAL_PHYSICAL, 0.01, none, none);
        motion_advance(&z, 3.0);
        CU_ASSERT(near(z.x[0], simpson(flight_x, p, 3.0)));
        CU_ASSERT(near(z.x[1], simpson(flight_y, p, 3.0)));
        motion_close(&z);
    }
}

/* ---- the isokinetic cluster as a Hamiltonian system ---- */

/* U of the file, and its gradient. */
static double potential(const double *q, double *gradient)
{
    static const double k[] = {1, 1, 1, 2, 1, 3}, b = 2.0;
    double U = 0.0;
    for (int i = 0; i < 6; i++) {
        U += k[i] * q[i] * q[i] / 2;
        gradient[i] = k[i] * q[i];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        double dx = q[2 * i] - q[2 * j], dy = q[2 * i + 1] - q[2 * j + 1];
        double s = 1 / (1 + dx * dx + dy * dy);
        U += b * s;
        gradient[2 * i] -= 2 * b * s * s * dx, gradient[2 * j] += 2 * b * s * s * dx;
        gradient[2 * i + 1] -= 2 * b * s * s * dy, gradient[2 * j + 1] += 2 * b * s * s * dy;
    }
    return U;
}

/* H = exp(U/2K) P^2/2 - K exp(-U/2K), K = 3/2. */
static void canonical(const double *x, double *out)
{
    double slope[6], K = 1.5, f = exp(potential(x, slope) / (2 * K)), square = 0.0;
    for (int i = 0; i < 6; i++) square += x[6 + i] * x[6 + i];
    for (int i = 0; i < 6; i++) {
        out[i] = f * x[6 + i];
        out[6 + i] = -slope[i] / (2 * K) * (f * square / 2 + K / f);
    }
}

static void canonical_step(double h, double *x)
{
    static const double node[] = {0.5, 0.5, 1.0, 0.0}, weight[] = {1, 2, 2, 1};
    double k[12], y[12], sum[12] = {0.0};
    memcpy(y, x, sizeof y);
    for (int s = 0; s < 4; s++) {
        canonical(y, k);
        for (int i = 0; i < 12; i++) {
            sum[i] += weight[s] * k[i];
            y[i] = x[i] + h * node[s] * k[i];
        }
    }
    for (int i = 0; i < 12; i++) x[i] += h / 6 * sum[i];
}

/* Dettmann and Morriss: v = exp(U/2K) P in the same time. */
static void test_cluster(void)
{
    motion z = motion_default("isokinetic-cluster", 0.01);
    double x[12], slope[6], f = exp(potential(z.x, slope) / 3);
    for (int i = 0; i < 6; i++) x[i] = z.x[i], x[6 + i] = z.x[6 + i] / f;
    for (int i = 0; i < 8000; i++) canonical_step(2.5e-4, x);
    motion_advance(&z, 2.0);
    f = exp(potential(x, slope) / 3);
    for (int i = 0; i < 6; i++) CU_ASSERT(near(z.x[i], x[i]) && near(z.x[6 + i], f * x[6 + i]));
    motion_close(&z);
}

/* ---- relativity ---- */

/* v.v = -c^2 holds by itself in the electromagnetic field: the reaction is none. */
static void test_charge(void)
{
    motion z = motion_default("relativistic-em", 0.01);
    double F[4];
    motion_advance(&z, 1.5);
    motion_field(&z, F);
    const double *v = z.x + 4;
    const double expected[] = {0.7 * v[3], 1.3 * v[2], -1.3 * v[1], 0.7 * v[0]};
    CU_ASSERT(reference_distance(4, F, expected) < 1e-14);
    CU_ASSERT(near(v[1] * v[1] + v[2] * v[2] + v[3] * v[3] - v[0] * v[0], -1.0));
    motion_close(&z);
}

/* gd(eta) reaches pi/2 in a finite proper time, and no step leads past it. */
static void test_blow_up(void)
{
    double end = (PI / 2 - atan(sinh(0.3))) / 0.5, x[4];
    motion z = motion_default("relativistic-scalar", 0.005);
    motion_advance(&z, 2.4);
    CU_ASSERT(reference_call(&z.b, z.b.system->exact, 2.4, NULL, NULL, x) == DAL_STATUS_OK);
    CU_ASSERT(reference_distance(4, z.x, x) < SMALL);
    CU_ASSERT(dal_run_advance(z.run, (long long)((end - 2.4) / 0.005) + 2, NULL) != DAL_STATUS_OK);
    CU_ASSERT(dal_run_time(z.run) < end);
    motion_close(&z);
}

void suite_closed_forms(void)
{
    CU_pSuite suite = CU_add_suite("closed forms", NULL, NULL);
    CU_add_test(suite, "contact oscillator: period map", test_contact);
    CU_add_test(suite, "published levels", test_levels);
    CU_add_test(suite, "nonholonomic oscillator", test_oscillator);
    CU_add_test(suite, "Heisenberg, central force", test_heisenberg);
    CU_add_test(suite, "transmission: the driver by itself", test_cvt);
    CU_add_test(suite, "turntable: moving energy", test_turntable);
    CU_add_test(suite, "tilted turntable: drift", test_tilted);
    CU_add_test(suite, "Suslov", test_suslov);
    CU_add_test(suite, "Benenti", test_benenti);
    CU_add_test(suite, "pursuit: Bouguer's curve", test_pursuit);
    CU_add_test(suite, "rocket", test_rocket);
    CU_add_test(suite, "isokinetic cluster: Dettmann and Morriss", test_cluster);
    CU_add_test(suite, "relativistic charge: no reaction", test_charge);
    CU_add_test(suite, "relativistic scalar field: finite time", test_blow_up);
}
