/* test_natural.c - shipped systems in natural coordinates, against the same motions in angles
 * without holonomic constraints, a quadrature, and a steady motion in closed form. */
#include "dalembert.h"
#include "fixtures.h"
#include "holonomic.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

typedef struct setting_list {
    int count;
    const dal_setting *start;
} setting_list;

/* By gauss12, projected where there are holonomic constraints, to T in `steps` steps. */
static dal_run *run_to(const char *system, setting_list start, double T, int steps)
{
    dal_run_spec spec = fixture_spec(fixture_system(system), "gauss12", DAL_PHYSICAL, T / steps);
    spec.start = start.start;
    spec.start_count = start.count;
    return fixture_stepped(&spec, steps);
}

/* ---- the spherical pendulum ---- */

static void test_pendulum(void)
{
    dal_run *run = run_to("spherical-pendulum", (setting_list){0}, 2.0, 200);
    dal_run *angles = run_to(PENDULUM_IN_ANGLES("g: 9.81", "a: 0.8"), (setting_list){0}, 2.0, 200);
    compare_pendulums(run, angles);
}

/* ---- frames on the inside of a sphere ---- */

enum { THETA, PHI, CHI, LEAN, PSI };

/* r: the outward radius at theta from below and phi about the vertical; along: the tangent at chi
 * from the meridian; across, with along x across = -r. */
typedef struct frame {
    double r[3], along[3], across[3];
} frame;

static frame frame_at(const double *q)
{
    const double s = sin(q[THETA]), c = cos(q[THETA]), sp = sin(q[PHI]), cp = cos(q[PHI]);
    const double meridian[3] = {c * cp, c * sp, s}, parallel[3] = {-sp, cp, 0.0};
    frame f = {.r = {s * cp, s * sp, -c}};
    for (int i = 0; i < 3; i++) {
        f.along[i] = cos(q[CHI]) * meridian[i] + sin(q[CHI]) * parallel[i];
        f.across[i] = -sin(q[CHI]) * meridian[i] + cos(q[CHI]) * parallel[i];
    }
    return f;
}

/* ---- a skate on a sphere ---- */

/* r = R frame.r, u = frame.along; w is the rate of u about r. */
static const char skate_angles[] =
    "coordinates: [theta, phi, chi]\n"
    "parameters: {m: 1, J: 0.4, R: 1, g: 0.7}\n"
    "let: {s: \"R*(cos(chi)*theta' + sin(chi)*sin(theta)*phi')\", w: \"chi' + cos(theta)*phi'\"}\n"
    "lagrangian: m*R^2/2*(theta'^2 + sin(theta)^2*phi'^2) + J/2*(s^2/R^2 + w^2) "
    "+ m*g*R*cos(theta)\n"
    "constraints: [\"-sin(chi)*theta' + cos(chi)*sin(theta)*phi'\"]\n"
    "start: {theta: pi/2, chi: \"pi/2 - 0.7\", theta': \"0.8*sin(0.7)\", phi': \"0.8*cos(0.7)\",\n"
    "        chi': -0.9}\n";

static void test_skate(void)
{
    dal_run *run = run_to("skate-on-sphere", (setting_list){0}, 2.0, 100);
    dal_run *angles = run_to(skate_angles, (setting_list){0}, 2.0, 100);
    const double *q = dal_run_state(run);
    const frame f = frame_at(dal_run_state(angles));
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_DOUBLE_EQUAL(q[i], f.r[i], 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(q[3 + i], f.along[i], 1e-12);
    }
    dal_run_free(run);
    dal_run_free(angles);
}

/* ---- a wheel inside a sphere ---- */

/* The wheel leans by LEAN about frame.along; psi is the angle by which it has rolled.  k = -r is
 * the inward normal, (along, across, k) turns with the rates (wa, wb, wk), and the wheel's frame,
 * turned by LEAN, with (P, Q, S). */
static const char wheel_angles[] =
    "coordinates: [theta, phi, chi, beta, psi]\n"
    "parameters: {m: 1, a: 0.4, R: 1.5, g: 9.81, Id: 0.04, Ia: 0.08}\n"
    "let:\n"
    "  wb: \"-cos(chi)*theta' - sin(chi)*sin(theta)*phi'\"\n"
    "  wa: \"-sin(chi)*theta' + cos(chi)*sin(theta)*phi'\"\n"
    "  wk: \"chi' + cos(theta)*phi'\"\n"
    "  P: \"wa + beta'\"\n"
    "  Q: \"cos(beta)*wb + sin(beta)*wk\"\n"
    "  S: \"cos(beta)*wk - sin(beta)*wb\"\n"
    "  height: \"a*(cos(beta)*cos(theta) + sin(beta)*sin(chi)*sin(theta)) - R*cos(theta)\"\n"
    "lagrangian: >\n"
    "  m/2*((a*Q - R*wb)^2 + (R*wa*cos(beta) - a*P)^2 + (R*wa*sin(beta))^2)\n"
    "  + Id/2*(P^2 + S^2) + Ia/2*(psi' - Q)^2 - m*g*height\n"
    "constraints: [a*psi' - R*wb, wa]\n";

/* Where the wheel is and moves, out[14] = (c, u, s, c', u', s'); s itself is left 0. */
static void place_wheel(const double *q, double *out)
{
    static const double a = 0.4, R = 1.5;
    const double *v = q + 5, cb = cos(q[LEAN]), sb = sin(q[LEAN]), st = sin(q[THETA]);
    const frame f = frame_at(q);
    const double wb = -cos(q[CHI]) * v[THETA] - sin(q[CHI]) * st * v[PHI];
    const double wa = -sin(q[CHI]) * v[THETA] + cos(q[CHI]) * st * v[PHI];
    const double wk = v[CHI] + cos(q[THETA]) * v[PHI];
    const double P = wa + v[LEAN], Q = cb * wb + sb * wk, S = cb * wk - sb * wb;
    for (int i = 0; i < 3; i++) {
        const double k = -f.r[i], e = sb * f.across[i] - cb * k, u = -cb * f.across[i] - sb * k;
        out[i] = -R * k - a * e;
        out[3 + i] = u;
        out[7 + i] = (a * Q - R * wb) * f.along[i] - (R * wa * cb - a * P) * u + R * wa * sb * e;
        out[10 + i] = P * e + S * f.along[i];
    }
    out[6] = 0.0;
    out[13] = v[PSI] - Q;
}

static void test_wheel(void)
{
    static const char *const names[] = {"x",  "y",  "z",  "ux",  "uy",  "uz",  "s",
                                        "x'", "y'", "z'", "ux'", "uy'", "uz'", "s'"};
    /* rolling by psi' = 6: R (theta', sin(theta) phi') = -0.4 psi' (cos chi, sin chi) */
    const double q[10] = {
        0.8, 0.3,  1.1, 0.4, 0.0, -0.4 * 6 / 1.5 * cos(1.1), -0.4 * 6 / 1.5 * sin(1.1) / sin(0.8),
        0.7, -0.5, 6.0};
    dal_setting in_angles[] = {{"theta", q[0]}, {"phi", q[1]},    {"chi", q[2]},
                               {"beta", q[3]},  {"theta'", q[5]}, {"phi'", q[6]},
                               {"chi'", q[7]},  {"beta'", q[8]},  {"psi'", q[9]}};
    dal_setting natural[14];
    double x[14];
    place_wheel(q, x);
    for (int i = 0; i < 14; i++) natural[i] = (dal_setting){names[i], x[i]};
    dal_run *run = run_to("wheel-in-sphere", (setting_list){14, natural}, 1.0, 200);
    dal_run *angles = run_to(wheel_angles, (setting_list){9, in_angles}, 1.0, 200);
    place_wheel(dal_run_state(angles), x);
    for (int i = 0; i < 14; i++)
        if (i != 6) CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[i], x[i], 1e-11);
    dal_run_free(run);
    dal_run_free(angles);
}

/* The moment of the contact's force about the centre turns the angular momentum with the rate. */
static void test_steady_wheel(void)
{
    const double place = 0.9, lean = 0.5, a = 0.4, Id = 0.04, Ia = 0.08, T = 2.0;
    const double circle = 1.5 * sin(place) - a * cos(lean);
    const double rate =
        sqrt(a * a * 9.81 / (tan(lean) * ((a * a + Ia) * circle + Id * a * cos(lean))));
    const dal_setting start[] = {
        {"y'", rate * circle}, {"uy'", rate * sin(lean)}, {"s'", -rate * circle / a}};
    dal_run *run = run_to("wheel-in-sphere", (setting_list){3, start}, T, 200);
    const double *q = dal_run_state(run), turned = rate * T;
    const double expected[7] = {
        circle * cos(turned),    circle * sin(turned),    a * sin(lean) - 1.5 * cos(place),
        sin(lean) * cos(turned), sin(lean) * sin(turned), cos(lean),
        -rate * circle / a * T};
    for (int i = 0; i < 7; i++) CU_ASSERT_DOUBLE_EQUAL(q[i], expected[i], 1e-11);
    dal_run_free(run);
}

/* ---- the four-bar linkage ---- */

/* Of the crank's angle f: the inertia I with 2 T = I f'^2, and the potential V. */
static void linkage_at(double f, double *I, double *V)
{
    static const double a = 1, b = 2.5, c = 2, d = 2.4, ma = 1, mb = 2.5, mc = 2, g = 1;
    const double x = d - a * cos(f), y = -a * sin(f), far = hypot(x, y);
    const double coupler = atan2(y, x) + acos((b * b + far * far - c * c) / (2 * b * far));
    const double jx = a * cos(f) + b * cos(coupler), jy = a * sin(f) + b * sin(coupler);
    const double rocker = atan2(jy, jx - d);
    const double of_rocker = a * sin(f - coupler) / (c * sin(rocker - coupler));
    const double of_coupler = -a * sin(f - rocker) / (b * sin(coupler - rocker));
    /* the middle of the coupler, relative to f' */
    const double mx = -a * sin(f) - b / 2 * sin(coupler) * of_coupler;
    const double my = a * cos(f) + b / 2 * cos(coupler) * of_coupler;
    *I = ma * a * a / 3 + mc * c * c / 3 * of_rocker * of_rocker +
         mb * (mx * mx + my * my + b * b / 12 * of_coupler * of_coupler);
    *V = g / 2 * (ma * a * sin(f) + mb * (a * sin(f) + jy) + mc * jy);
}

/* The time from one angle to another, int sqrt(I/(2 (E - V))) df, by Simpson's rule. */
static double linkage_time(double from, double to, double rate)
{
    enum { PANELS = 2000 };
    double I, V, sum = 0.0;
    linkage_at(from, &I, &V);
    const double E = I / 2 * rate * rate + V;
    for (int i = 0; i <= PANELS; i++) {
        linkage_at(from + (to - from) * i / PANELS, &I, &V);
        const double slowness = sqrt(I / (2 * (E - V)));
        sum += slowness * (i == 0 || i == PANELS ? 1 : i % 2 ? 4 : 2);
    }
    return sum * (to - from) / (3 * PANELS);
}

/* Three quarters of a turn and more than one. */
static void test_linkage(void)
{
    for (int k = 1; k <= 2; k++) {
        const double T = 1.5 * k;
        dal_run *run = run_to("four-bar-linkage", (setting_list){0}, T, 200 * k);
        const double *q = dal_run_state(run);
        double f = atan2(q[1], q[0]);
        while (f < 1.0 || linkage_time(1.0, f, 3.0) < T - 0.5) f += 2 * PI;
        CU_ASSERT_DOUBLE_EQUAL(linkage_time(1.0, f, 3.0), T, 1e-10);
        dal_run_free(run);
    }
}

/* ---- the chain ---- */

/* examples/chain-of-100-links.yaml with three links. */
static char *read_chain(void)
{
    static const char full[] = "N: 100", *const path = "examples/chain-of-100-links.yaml";
    dal_model *model = NULL;
    size_t length;
    CU_ASSERT_EQUAL_FATAL(dal_model_read_file(&model, path, NULL), DAL_STATUS_OK);
    char *text = strdup(dal_model_source(model, &length));
    char *const N = strstr(text, full);
    CU_ASSERT_PTR_NOT_NULL_FATAL(N);
    memcpy(N, "N:   3", strlen(full));
    dal_model_free(model);
    return text;
}

static void test_chain(void)
{
    /* the angles from below; the same starts */
    static const char in_angles[] =
        "sizes: {N: 3}\ncoordinates: [\"f[1..N]\"]\nparameters: {g: 9.81, b: 0.6}\n"
        "let:\n"
        "  \"x[i]\": {for: i = 1..N, is: \"sum(k, 1, i, cos(f[k])*f[k]')/N\"}\n"
        "  \"y[i]\": {for: i = 1..N, is: \"sum(k, 1, i, sin(f[k])*f[k]')/N\"}\n"
        "lagrangian: \"sum(i, 1, N, (x[i]^2 + y[i]^2)/2)/N + g/N^2*sum(i, 1, N, sum(k, 1, i, "
        "cos(f[k])))\"\n"
        "start: {\"f[i]\": {for: i = 1..N, is: \"b*cos(pi*(i - 1)/N)\"}}\n";
    char *text = read_chain();
    dal_run *run = run_to(text, (setting_list){0}, 1.0, 200);
    dal_run *angles = run_to(in_angles, (setting_list){0}, 1.0, 200);
    const double *q = dal_run_state(run), *f = dal_run_state(angles);
    double x = 0.0, y = 0.0;
    for (int i = 0; i < 3; i++) {
        x += sin(f[i]) / 3, y -= cos(f[i]) / 3;
        CU_ASSERT_DOUBLE_EQUAL(q[i], x, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(q[3 + i], y, 1e-12);
    }
    dal_run_free(run);
    dal_run_free(angles);
    free(text);
}

void suite_natural(void)
{
    CU_pSuite suite = CU_add_suite("systems in natural coordinates", NULL, NULL);
    CU_add_test(suite, "a spherical pendulum", test_pendulum);
    CU_add_test(suite, "a skate on a sphere", test_skate);
    CU_add_test(suite, "a wheel inside a sphere", test_wheel);
    CU_add_test(suite, "a wheel that rolls along a circle", test_steady_wheel);
    CU_add_test(suite, "a four-bar linkage, by quadrature", test_linkage);
    CU_add_test(suite, "a chain of links", test_chain);
}
