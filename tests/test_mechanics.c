/* test_mechanics.c - the equations of motion made from formulas, against finite differences of the
 * same mechanics written in C, on systems with all that makes them hard: time, a full mass matrix
 * that depends on q (and one without positive diagonal), forces that depend on velocities, several
 * constraints, linear and not. */
#include "dalembert_evaluator.h"
#include "expr/simplify.h"
#include "model/model.h"
#include "model/programs.h"
#include "reference.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <string.h>

/* Differences are good to 1e-12 (reference.h); the elimination after them amplifies it. */
#define BY_DIFFERENCES 1e-10

/* ---- two hard systems ---- */

static const char hard_text[] =
    "coordinates: [a, b, c, d]\n"
    "parameters: {k: 0.3, w: 2}\n"
    "let: {tilt: cos(a - b), slip: b'*d'}\n"
    "lagrangian: >\n"
    "  ((2 + sin(a))*a'^2 + (3 + cos(b)/2)*b'^2 + (1 + c^2/5)*c'^2 + w*d'^2)/2\n"
    "  + k*tilt*a'*b' + b*c'*d'/5 + t*a'*d'/10 - a^2*b/2 - cos(c) + k*d*a'\n"
    "forces: {a: -k*a' + sin(t), b: cos(w*t)*a, c: slip/5}\n"
    "constraints:\n"
    "  - a' - d'*sin(c) + k*cos(t)*b\n"
    "  - b'*c' - 2/5*d'^2 + a*d'/10 - t/7\n";

static double hard_lagrangian(int i, const double *q, const double *v, double t)
{
    (void)i;
    return 0.5 * ((2 + sin(q[0])) * v[0] * v[0] + (3 + cos(q[1]) / 2) * v[1] * v[1] +
                  (1 + q[2] * q[2] / 5) * v[2] * v[2] + 2 * v[3] * v[3]) +
           0.3 * cos(q[0] - q[1]) * v[0] * v[1] + q[1] * v[2] * v[3] / 5 + t * v[0] * v[3] / 10 -
           q[0] * q[0] * q[1] / 2 - cos(q[2]) + 0.3 * q[3] * v[0];
}

static double hard_force(int i, const double *q, const double *v, double t)
{
    return i == 0   ? -0.3 * v[0] + sin(t)
           : i == 1 ? cos(2 * t) * q[0]
           : i == 2 ? v[1] * v[3] / 5
                    : 0.0;
}

static double hard_constraint(int a, const double *q, const double *v, double t)
{
    return a == 0 ? v[0] - v[3] * sin(q[2]) + 0.3 * cos(t) * q[1]
                  : v[1] * v[2] - 0.4 * v[3] * v[3] + q[0] * v[3] / 10 - t / 7;
}

static const reference_formulas hard = {4, 2, hard_lagrangian, hard_force, hard_constraint, NULL};

/* Indefinite, with zeros on the diagonal of the mass matrix. */
static const char null_text[] = "mechanics: lagrange-d'alembert\n"
                                "coordinates: [x, y, z, u]\n"
                                "lagrangian: x'*y'*(1 + z^2/10) + z'^2/2 - (1 + x^2/5)*u'^2/2\n"
                                "            + x'*u'*y/4 - x*y*z\n"
                                "forces: {u: -x'/3}\n"
                                "constraints: [x'*y' + z'^2/2 - u'^2/2 + 1/2 + t*x/9]\n"
                                "start: {x': 0.5, y': 0.4, z': 0.2, u': 1.3}\n";

static double null_lagrangian(int i, const double *q, const double *v, double t)
{
    (void)i, (void)t;
    return v[0] * v[1] * (1 + q[2] * q[2] / 10) + v[2] * v[2] / 2 -
           (1 + q[0] * q[0] / 5) * v[3] * v[3] / 2 + v[0] * v[3] * q[1] / 4 - q[0] * q[1] * q[2];
}

static double null_force(int i, const double *q, const double *v, double t)
{
    (void)q, (void)t;
    return i == 3 ? -v[0] / 3 : 0.0;
}

static double null_constraint(int a, const double *q, const double *v, double t)
{
    (void)a;
    return v[0] * v[1] + v[2] * v[2] / 2 - v[3] * v[3] / 2 + 0.5 + t * q[0] / 9;
}

static const reference_formulas null_mass = {4,   1, null_lagrangian, null_force, null_constraint,
                                             NULL};

static const struct {
    const char *text;
    const reference_formulas *formulas;
} systems[] = {{hard_text, &hard}, {null_text, &null_mass}};
enum { SYSTEMS = sizeof systems / sizeof *systems };

static const double q0[REFERENCE_MAX] = {0.3, -0.4, 0.7, 0.2, -0.6, 0.5, 0.8, -0.1};
static const double v0[REFERENCE_MAX] = {0.5, 0.9, -0.3, 0.6, 0.4, -0.7, 0.2, 1.1};
static const double t0 = 0.35;

/* ---- field, constraint, energy ---- */

static void test_field(void)
{
    for (int k = 0; k < SYSTEMS; k++) {
        reference b = reference_of_text(systems[k].text);
        double F[REFERENCE_MAX], expected[REFERENCE_MAX];
        CU_ASSERT(reference_call(&b, b.system->call.field, t0, q0, v0, F) == DAL_STATUS_OK);
        reference_motion(systems[k].formulas, q0, v0, t0, expected);
        CU_ASSERT(reference_distance(b.system->n, F, expected) < BY_DIFFERENCES);
        reference_free(&b);
    }
}

static void test_accelerations(void)
{
    reference b = reference_of_text("coordinates: [x, y]\n"
                                    "accelerations: {x: -y' + sin(t)}\n"
                                    "forces: {y: x*x'}\n"
                                    "constraints: [x'^2 + 2*y'^2 - 1]\n");
    double F[2], x = q0[0], vx = v0[0], vy = v0[1];
    double bx = -vy + sin(t0), by = x * vx;
    double h = -(2 * vx * bx + 4 * vy * by) / (4 * vx * vx + 16 * vy * vy);
    double expected[] = {bx + 2 * vx * h, by + 4 * vy * h};
    CU_ASSERT(reference_call(&b, b.system->call.field, t0, q0, v0, F) == DAL_STATUS_OK);
    CU_ASSERT(reference_distance(2, F, expected) < 1e-14);
    CU_ASSERT(b.system->energy == NULL);
    reference_free(&b);
}

/* Equations that are solved for q'': by Cramer's rule where their matrix is not symmetric, and with
 * a constraint where it is. */
static void test_equations(void)
{
    reference b = reference_of_text("coordinates: [x, y]\n"
                                    "equations: [2*x'' + (1 + y^2)*y'' + x*cos(t),\n"
                                    "            x'' - 3*y'' + y*x']\n"
                                    "forces: {y: x}\n");
    double F[3], c = 1.0 + q0[1] * q0[1];
    double s[] = {-q0[0] * cos(t0), q0[0] - q0[1] * v0[0]};
    double expected[] = {(3.0 * s[0] + c * s[1]) / (6.0 + c), (s[0] - 2.0 * s[1]) / (6.0 + c), 0.0};
    CU_ASSERT(reference_call(&b, b.system->call.field, t0, q0, v0, F) == DAL_STATUS_OK);
    CU_ASSERT(reference_distance(2, F, expected) < 1e-14);
    reference_free(&b);
    b = reference_of_text("coordinates: [x, y, phi]\nparameters: {m: 2, I: 0.5, k: 0.1}\n"
                          "equations: [m*x'' + k*x', m*(y'' + 1), I*phi'' + k*phi'*x]\n"
                          "constraints: [x'*sin(phi) - y'*cos(phi)]\nstart: {x': 1}\n");
    double sine = sin(q0[2]), cosine = cos(q0[2]), x = -0.05 * v0[0], y = -1.0;
    double h = cosine * y - sine * x - v0[2] * (v0[0] * cosine + v0[1] * sine);
    expected[0] = x + sine * h;
    expected[1] = y - cosine * h;
    expected[2] = -0.2 * v0[2] * q0[0];
    CU_ASSERT(reference_call(&b, b.system->call.field, t0, q0, v0, F) == DAL_STATUS_OK);
    CU_ASSERT(reference_distance(3, F, expected) < 1e-14);
    reference_free(&b);
}

/* W^-1 A^T of column a, by elimination of differences. */
static void expected_normal(const reference_formulas *f, int a, double *out)
{
    double m[REFERENCE_MAX * (REFERENCE_MAX + 1)];
    for (int i = 0; i < f->n; i++) {
        for (int j = 0; j < f->n; j++) m[i * (f->n + 1) + j] = reference_mass(f, i, j, q0, v0, t0);
        m[i * (f->n + 1) + f->n] = reference_by_v(f->constraint, a, i, q0, v0, t0);
    }
    reference_solve(f->n, m);
    for (int i = 0; i < f->n; i++) out[i * f->m + a] = m[i * (f->n + 1) + f->n];
}

/* Multiplies X with A X = 1, of a W that is used on ker A alone, by G: W^-1 A^T. */
static void scale_directions(int n, int m, const double *expected, double *out)
{
    const double *A = expected + m, *R = A + m * n;
    for (int i = 0; i < n; i++) {
        double row[REFERENCE_MAX] = {0.0}, *X = out + m + m * n + i * m;
        for (int a = 0; a < m * m; a++)
            for (int j = 0; j < n; j++)
                row[a % m] += X[a / m] * A[a / m * n + j] * R[j * m + a % m];
        memcpy(X, row, (size_t)m * sizeof *X);
    }
}

static void test_constraint(void)
{
    for (int k = 0; k < SYSTEMS; k++) {
        const reference_formulas *f = systems[k].formulas;
        int n = f->n, m = f->m;
        reference b = reference_of_text(systems[k].text);
        double out[REFERENCE_OUT], D[REFERENCE_MAX], expected[REFERENCE_OUT];
        for (int a = 0; a < m; a++) {
            expected[a] = f->constraint(a, q0, v0, t0);
            for (int i = 0; i < n; i++)
                expected[m + a * n + i] = reference_by_v(f->constraint, a, i, q0, v0, t0);
            expected_normal(f, a, expected + m + m * n);
        }
        CU_ASSERT(reference_call(&b, b.system->call.constraint, t0, q0, v0, out) == DAL_STATUS_OK);
        if (b.system->properties & DAL_MASS_ON_KERNEL) scale_directions(n, m, expected, out);
        CU_ASSERT(reference_distance(m + 2 * m * n, out, expected) < BY_DIFFERENCES);
        CU_ASSERT(reference_call(&b, b.system->constraints, t0, q0, v0, D) == DAL_STATUS_OK);
        CU_ASSERT(memcmp(D, out, (size_t)m * sizeof *D) == 0);
        reference_free(&b);
    }
}

static void test_energy(void)
{
    for (int k = 0; k < SYSTEMS; k++) {
        const reference_formulas *f = systems[k].formulas;
        reference b = reference_of_text(systems[k].text);
        double E, expected = -f->lagrangian(0, q0, v0, t0);
        for (int i = 0; i < f->n; i++)
            expected += v0[i] * reference_by_v(f->lagrangian, 0, i, q0, v0, t0);
        CU_ASSERT(reference_call(&b, b.system->energy, t0, q0, v0, &E) == DAL_STATUS_OK);
        CU_ASSERT(reference_distance(1, &E, &expected) < BY_DIFFERENCES);
        reference_free(&b);
    }
}

/* ---- derivatives of the field ---- */

/* Column i of F_q (kind 0) or F_w, w = (v,g) (kind 1), by central differences of order 8. */
static void column(const reference *b, int kind, int i, double *out)
{
    static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    int nw = b->system->n + b->system->multipliers;
    double x[2][REFERENCE_MAX], above[REFERENCE_MAX], below[REFERENCE_MAX], h = 0.005;
    memcpy(x[0], q0, sizeof q0);
    memcpy(x[1], v0, sizeof v0);
    for (int j = 0; j < nw; j++) out[j] = 0.0;
    for (int k = 0; k < 4; k++) {
        double centre = x[kind][i];
        x[kind][i] = centre + (k + 1) * h;
        reference_call(b, b->system->call.field, t0, x[0], x[1], above);
        x[kind][i] = centre - (k + 1) * h;
        reference_call(b, b->system->call.field, t0, x[0], x[1], below);
        x[kind][i] = centre;
        for (int j = 0; j < nw; j++) out[j] += weight[k] * (above[j] - below[j]) / h;
    }
}

static void expected_jacobian(const reference *b, double *out)
{
    int n = b->system->n, nw = n + b->system->multipliers;
    double F[REFERENCE_MAX];
    for (int i = 0; i < n; i++) {
        column(b, 0, i, F);
        for (int j = 0; j < nw; j++) out[j * n + i] = F[j];
    }
    for (int i = 0; i < nw; i++) {
        column(b, 1, i, F);
        for (int j = 0; j < nw; j++) out[nw * n + j * nw + i] = F[j];
    }
}

static void check_jacobian(const reference *b)
{
    int n = b->system->n, nw = n + b->system->multipliers, count = nw * (n + nw);
    double out[REFERENCE_OUT], expected[REFERENCE_OUT];
    expected_jacobian(b, expected);
    CU_ASSERT(reference_call(b, b->system->call.jacobian, t0, q0, v0, out) == DAL_STATUS_OK);
    CU_ASSERT(reference_distance(count, out, expected) < BY_DIFFERENCES);
}

/* F bit for bit, and the transposed products. */
static void check_adjoint(const reference *b)
{
    int n = b->system->n;
    double out[3 * REFERENCE_MAX], F[REFERENCE_MAX], J[REFERENCE_OUT],
        expected[2 * REFERENCE_MAX] = {0.0};
    const double pi[REFERENCE_MAX] = {0.7, -1.2, 0.4, 0.9, -0.3, 0.8, 1.1, -0.6};
    expected_jacobian(b, J);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            expected[i] += pi[j] * J[j * n + i];
            expected[n + i] += pi[j] * J[n * n + j * n + i];
        }
    CU_ASSERT(reference_pull(b, t0, q0, v0, pi, out) == DAL_STATUS_OK);
    CU_ASSERT(reference_call(b, b->system->call.field, t0, q0, v0, F) == DAL_STATUS_OK);
    CU_ASSERT(memcmp(out, F, (size_t)n * sizeof *F) == 0);
    CU_ASSERT(reference_distance(2 * n, out + n, expected) < BY_DIFFERENCES);
}

static void test_derivatives(void)
{
    for (int k = 0; k < SYSTEMS; k++) {
        reference b = reference_of_text(systems[k].text);
        check_jacobian(&b);
        check_adjoint(&b);
        reference_free(&b);
    }
}

static void test_tangent(void)
{
    reference b = reference_of_text(hard_text), d = reference_tangent(&b);
    double J[REFERENCE_OUT], F[2 * REFERENCE_MAX], expected[2 * REFERENCE_MAX];
    int n = b.system->n;
    expected_jacobian(&b, J);
    reference_call(&b, b.system->call.field, t0, q0, v0, expected);
    for (int i = 0; i < n; i++) {
        expected[n + i] = 0.0;
        for (int j = 0; j < n; j++)
            expected[n + i] += J[i * n + j] * q0[n + j] + J[n * n + i * n + j] * v0[n + j];
    }
    CU_ASSERT(d.system->n == 2 * n && d.system->m == 0);
    CU_ASSERT_STRING_EQUAL(d.system->coordinate[0], "a");
    CU_ASSERT_STRING_EQUAL(d.system->coordinate[n], "dq_a");
    CU_ASSERT(reference_call(&d, d.system->call.field, t0, q0, v0, F) == DAL_STATUS_OK);
    CU_ASSERT(memcmp(F, expected, (size_t)n * sizeof *F) == 0);
    CU_ASSERT(reference_distance(2 * n, F, expected) < BY_DIFFERENCES);
    check_jacobian(&d);
    check_adjoint(&d);
    reference_free(&d);
    reference_free(&b);
}

/* ---- vakonomic ---- */

/* With L' = L - g.D the Euler-Lagrange equations of q and g are W F - sum g D_vv F - A^T g' = b',
 * D_q v + D_t + A F = 0; here as residuals of the field. */
static double multiplier[2];

static double vakonomic_lagrangian(int i, const double *q, const double *v, double t)
{
    return hard_lagrangian(i, q, v, t) - multiplier[0] * hard_constraint(0, q, v, t) -
           multiplier[1] * hard_constraint(1, q, v, t);
}

static reference vakonomic_reference(void)
{
    char text[1024] = "mechanics: vakonomic\n";
    strcat(text, hard_text);
    return reference_of_text(text);
}

static void test_vakonomic(void)
{
    const reference_formulas f = {4, 2, vakonomic_lagrangian, hard_force, hard_constraint, NULL};
    reference b = vakonomic_reference();
    double out[6], residual[6] = {0.0}, zero[6] = {0.0};
    multiplier[0] = v0[4], multiplier[1] = v0[5];
    CU_ASSERT(b.system->multipliers == 2 && b.system->properties & DAL_VAKONOMIC);
    CU_ASSERT(b.system->call.adjoint == NULL);
    CU_ASSERT(reference_call(&b, b.system->call.field, t0, q0, v0, out) == DAL_STATUS_OK);
    for (int i = 0; i < 4; i++) {
        residual[i] = -reference_load(&f, i, q0, v0, t0);
        for (int j = 0; j < 4; j++) residual[i] += reference_mass(&f, i, j, q0, v0, t0) * out[j];
        for (int a = 0; a < 2; a++) {
            double A = reference_by_v(hard_constraint, a, i, q0, v0, t0);
            residual[i] -= A * out[4 + a];
            residual[4 + a] += A * out[i];
        }
    }
    for (int a = 0; a < 2; a++) residual[4 + a] += reference_drift(&f, a, q0, v0, t0);
    CU_ASSERT(reference_distance(6, residual, zero) < BY_DIFFERENCES);
    check_jacobian(&b);
    reference_free(&b);
}

/* What a text is with a mechanics that its file does not name. */
static dal_status choose(dal_model **model, const dal_system **system, const char *text,
                         dal_mechanics mechanics, dal_error *error)
{
    CU_ASSERT_EQUAL_FATAL(dal_model_read(model, "chosen", text, strlen(text), error),
                          DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_set_mechanics(*model, mechanics, error), DAL_STATUS_OK);
    return dal_model_system(*model, system, error);
}

#define WITH_ANGLE                                                                                 \
    "coordinates: [x, y, phi]\nlagrangian: (x'^2 + y'^2 + phi'^2)/2\n"                             \
    "constraints: [y'*cos(phi) - x'*sin(phi)]\n"

/* The sleigh from rest but x' = phi' = 1, g = g0 at phi = 0: (nh32), and (nh36) as corrected with
 * c = -g0, whose right side is -2 c = 2 g0 there. */
static void test_chosen_mechanics(void)
{
    static const char vakonomic[] =
        WITH_ANGLE "mechanics: vakonomic\nstart: {x': 1, phi': 1, g1: 0.4}\n";
    static const char lagrange[] =
        WITH_ANGLE "mechanics: lagrange-dalembert\nstart: {x': 1, phi': 1}\n"
                   "exact: {x: sin(t), y: 1 - cos(t), phi: t}\n";
    const double q[3] = {0.0}, v[4] = {1.0, 0.0, 1.0, 0.4};
    double F[4];
    for (int k = 0; k < 4; k++) {
        const char *text = k % 2 ? vakonomic : lagrange;
        const bool is_vakonomic = k >= 2;
        dal_error error = {0};
        dal_model *model;
        const dal_system *system;
        CU_ASSERT_EQUAL_FATAL(
            choose(&model, &system, text,
                   is_vakonomic ? DAL_MECHANICS_VAKONOMIC : DAL_MECHANICS_LAGRANGE_DALEMBERT,
                   &error),
            DAL_STATUS_OK);
        CU_ASSERT_EQUAL(system->multipliers, is_vakonomic);
        CU_ASSERT_EQUAL(system->exact != NULL, k == 0);
        dal_evaluator *evaluator;
        CU_ASSERT_EQUAL_FATAL(dal_evaluator_create(&evaluator, system, NULL, 0, &error),
                              DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.field, 0.0, q, v, NULL, F),
                        DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(F[1], 1.0, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(F[2], is_vakonomic ? 0.4 : 0.0, 1e-15);
        CU_ASSERT_EQUAL(dal_model_set_mechanics(model, DAL_MECHANICS_SYSTEM, &error),
                        DAL_STATUS_ARGUMENT);
        CU_ASSERT_STRING_EQUAL(error.message,
                               is_vakonomic
                                   ? "'chosen' already has its system: its mechanics is vakonomic"
                                   : "'chosen' already has its system: its mechanics is "
                                     "lagrange-dalembert");
        dal_evaluator_free(evaluator);
        dal_model_free(model);
    }
}

static void test_mechanics_refused(void)
{
    static const struct {
        const char *text, *fragment;
        dal_mechanics mechanics;
    } cases[] = {
        {"coordinates: [x]\naccelerations: {x: -x}\n", "needs a lagrangian",
         DAL_MECHANICS_VAKONOMIC},
        {WITH_ANGLE "reactions: [{x: 1}]\n", "has no reactions", DAL_MECHANICS_VAKONOMIC},
        {WITH_ANGLE "mechanics: vakonomic\ninvariants: {p: y' - g1*cos(phi)}\n",
         "unknown name 'g1'", DAL_MECHANICS_LAGRANGE_DALEMBERT},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        dal_error error = {0};
        dal_model *model;
        const dal_system *system;
        CU_ASSERT_NOT_EQUAL(choose(&model, &system, cases[k].text, cases[k].mechanics, &error),
                            DAL_STATUS_OK);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, cases[k].fragment));
        dal_model_free(model);
    }
}

/* ---- lanes ---- */

typedef struct lanes_case {
    const reference *b;
    dal_callback *single, *wide;
    int lanes, outputs;
} lanes_case;

static void check_lanes(const lanes_case *c)
{
    _Alignas(64) double q[REFERENCE_MAX * DAL__MAX_LANES], v[REFERENCE_MAX * DAL__MAX_LANES],
        pi[REFERENCE_MAX * DAL__MAX_LANES], out[REFERENCE_OUT * DAL__MAX_LANES];
    static double prepared[1 << 12];
    int workspace = (int)c->b->system->workspace;
    CU_ASSERT_FATAL(c->single && c->wide);
    memcpy(prepared, c->b->work, (size_t)workspace * sizeof *prepared);
    reference_scatter(c->lanes, REFERENCE_MAX, q0, q);
    reference_scatter(c->lanes, REFERENCE_MAX, v0, v);
    reference_scatter(c->lanes, REFERENCE_MAX, v0, pi);
    for (int i = 0; i < workspace; i++)
        for (int l = 0; l < c->lanes; l++) c->b->work[i * c->lanes + l] = prepared[i];
    dal_point at = {t0, q, v, pi, c->b->work, NULL};
    CU_ASSERT(c->wide(c->b->system, &at, out) == DAL_STATUS_OK);
    memcpy(c->b->work, prepared, (size_t)workspace * sizeof *prepared);
    for (int l = 0; l < c->lanes; l++) {
        double q1[REFERENCE_MAX], v1[REFERENCE_MAX], pi1[REFERENCE_MAX], one[REFERENCE_OUT],
            lane[REFERENCE_OUT];
        reference_gather(c->lanes, l, REFERENCE_MAX, q, q1);
        reference_gather(c->lanes, l, REFERENCE_MAX, v, v1);
        reference_gather(c->lanes, l, REFERENCE_MAX, pi, pi1);
        reference_gather(c->lanes, l, c->outputs, out, lane);
        dal_point point = {t0, q1, v1, pi1, c->b->work, NULL};
        CU_ASSERT(c->single(c->b->system, &point, one) == DAL_STATUS_OK);
        CU_ASSERT(memcmp(one, lane, (size_t)c->outputs * sizeof *one) == 0);
    }
}

static void check_variant(const reference *b, int width, const dal_callbacks *wide)
{
    const dal_callbacks *call = &b->system->call;
    check_lanes(&(lanes_case){b, call->field, wide->field, width, 4});
    check_lanes(&(lanes_case){b, call->adjoint, wide->adjoint, width, 12});
    check_lanes(&(lanes_case){b, call->jacobian, wide->jacobian, width, 32});
    check_lanes(&(lanes_case){b, call->constraint, wide->constraint, width, 18});
    check_lanes(&(lanes_case){b, call->guards, wide->guards, width, b->system->guards});
    CU_ASSERT(b->system->mass_guard == 1 && !call->gauge);
}

static void test_lanes(void)
{
    reference b = reference_of_text(hard_text);
    dal_callbacks wide;
#define X(name, variant, lanes, set)                                                               \
    if (dal__machine_has(DAL__##set)) {                                                            \
        name##_##variant(b.system->data, &wide);                                                   \
        check_variant(&b, lanes, &wide);                                                           \
    }
    DAL__VARIANT_LIST(X, dal__fill_callbacks)
#undef X
    reference_free(&b);
}

static void test_lanes_of_multipliers(void)
{
    reference b = vakonomic_reference();
    const dal_system *s = b.system;
    if (s->wide4) check_lanes(&(lanes_case){&b, s->call.field, s->wide4->field, 4, 6});
    if (s->wide4) check_lanes(&(lanes_case){&b, s->call.jacobian, s->wide4->jacobian, 4, 60});
    if (s->wide8) check_lanes(&(lanes_case){&b, s->call.jacobian, s->wide8->jacobian, 8, 60});
    reference_free(&b);
}

void suite_mechanics(void)
{
    CU_pSuite suite = CU_add_suite("mechanics", NULL, NULL);
    CU_add_test(suite, "field against differences", test_field);
    CU_add_test(suite, "given accelerations", test_accelerations);
    CU_add_test(suite, "given equations", test_equations);
    CU_add_test(suite, "D, A, W^-1 A^T", test_constraint);
    CU_add_test(suite, "energy", test_energy);
    CU_add_test(suite, "Jacobian and adjoint", test_derivatives);
    CU_add_test(suite, "tangent system", test_tangent);
    CU_add_test(suite, "vakonomic motion", test_vakonomic);
    CU_add_test(suite, "a mechanics that is chosen", test_chosen_mechanics);
    CU_add_test(suite, "a mechanics that cannot be", test_mechanics_refused);
    CU_add_test(suite, "lanes have the bits of one", test_lanes);
    CU_add_test(suite, "lanes of multipliers", test_lanes_of_multipliers);
}
