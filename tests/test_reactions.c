/* test_reactions.c - reactions along directions B of their own: W F = b + B^T h, A F = -c. */
#include "reference.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <string.h>

#define BY_DIFFERENCES 1e-10

static const double q0[REFERENCE_MAX] = {0.3, -0.4, 0.7}, v0[REFERENCE_MAX] = {0.5, 0.9, -0.3};
static const double t0 = 0.35;

/* ---- two reactions, a full mass matrix, forces and time ---- */

static const char *const full_text =
    REFERENCE_FULL "constraints: [x' + y*z' - t, x'*y' + z'^2/2 - x]\n"
                   "reactions: [{x: 1 + z^2, y: x'}, {y: cos(t), z: 1 + x*y, x: 1/5}]\n";

static double full_constraint(int a, const double *q, const double *v, double t)
{
    return a ? v[0] * v[1] + v[2] * v[2] / 2 - q[0] : v[0] + q[1] * v[2] - t;
}

static double full_reaction(int i, const double *q, const double *v, double t)
{
    const double B[] = {1 + q[2] * q[2], v[0], 0.0, 0.2, cos(t), 1 + q[0] * q[1]};
    return B[i];
}

static const reference_formulas full = {
    3, 2, reference_full_lagrangian, reference_full_force, full_constraint, full_reaction};

static void test_field(void)
{
    reference b = reference_of_text(full_text);
    double F[REFERENCE_MAX], expected[REFERENCE_MAX];
    CU_ASSERT(reference_call(&b, b.system->call.field, t0, q0, v0, F) == DAL_STATUS_OK);
    reference_motion(&full, q0, v0, t0, expected);
    CU_ASSERT(reference_distance(3, F, expected) < BY_DIFFERENCES);
    CU_ASSERT(b.system->properties & DAL_SERVO);
    reference_free(&b);
}

/* The lift and the metric of projections: F_q^T pi, F_v^T pi by differences of pi.F; and
 * W^-1 A^T, not W^-1 B^T, beside D and A. */
static double pull(const reference *b, const double *pi, const double *q, const double *v)
{
    double F[REFERENCE_MAX], sum = 0.0;
    reference_call(b, b->system->call.field, t0, q, v, F);
    for (int i = 0; i < 3; i++) sum += pi[i] * F[i];
    return sum;
}

static double slope(const reference *b, const double *pi, int i)
{
    static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280}, h = 0.004;
    double sum = 0.0, x[6];
    memcpy(x, q0, 3 * sizeof *x);
    memcpy(x + 3, v0, 3 * sizeof *x);
    double held = x[i];
    for (int k = 0; k < 4; k++) {
        x[i] = held + (k + 1) * h;
        sum += weight[k] / h * pull(b, pi, x, x + 3);
        x[i] = held - (k + 1) * h;
        sum -= weight[k] / h * pull(b, pi, x, x + 3);
    }
    return sum;
}

static void test_adjoint(void)
{
    reference b = reference_of_text(full_text);
    double out[9], expected[6], pi[] = {0.4, -0.8, 0.6};
    CU_ASSERT(reference_pull(&b, t0, q0, v0, pi, out) == DAL_STATUS_OK);
    for (int i = 0; i < 6; i++) expected[i] = slope(&b, pi, i);
    CU_ASSERT(reference_distance(6, out + 3, expected) < BY_DIFFERENCES);
    reference_free(&b);
}

static void test_metric(void)
{
    reference b = reference_of_text(full_text);
    double out[2 + 6 + 6], product, A;
    CU_ASSERT(reference_call(&b, b.system->call.constraint, t0, q0, v0, out) == DAL_STATUS_OK);
    for (int a = 0; a < 2; a++)
        for (int i = 0; i < 3; i++) {
            product = 0.0;
            for (int j = 0; j < 3; j++)
                product += reference_mass(&full, i, j, q0, v0, t0) * out[8 + j * 2 + a];
            A = reference_by_v(full_constraint, a, i, q0, v0, t0);
            CU_ASSERT(fabs(product - A) < BY_DIFFERENCES);
        }
    reference_free(&b);
}

/* ---- Chetaev's rule as a special case ---- */

/* B parallel to D_v, by any factors, or of the same span, is Chetaev's motion. */
static void check_same(const char *rest, const char *reactions)
{
    char text[512];
    double F[2][REFERENCE_MAX];
    for (int k = 0; k < 2; k++) {
        strcpy(text, "coordinates: [x, y, z]\nlagrangian: x'^2/2 + y'^2 + z'^2/2 - x*y - z\n");
        strcat(text, rest);
        if (k) strcat(text, reactions);
        reference b = reference_of_text(text);
        CU_ASSERT(reference_call(&b, b.system->call.field, t0, q0, v0, F[k]) == DAL_STATUS_OK);
        CU_ASSERT(!(b.system->properties & DAL_SERVO) == !k);
        reference_free(&b);
    }
    CU_ASSERT(reference_distance(3, F[1], F[0]) < 1e-14);
}

static void test_parallel(void)
{
    check_same("constraints: [x' + y*z']\n", "reactions: [{x: 1, z: y}]\n");
    check_same("constraints: [x' + y*z']\n", "reactions: [{x: 1 + z'^2, z: y*(1 + z'^2)}]\n");
    check_same("constraints: [x'^2 - z'^2]\n", "reactions: [{x: x', z: -z'}]\n");
    check_same("constraints: [x' + y*z', y' - x]\n",
               "reactions: [{x: 1, z: y, y: 3}, {y: 2, x: 1, z: y}]\n"); /* the same span */
}

/* ---- energy ---- */

static const struct {
    const char *text;
    unsigned energy;
} fates[] = {
    /* The power of the reaction is h v.B. */
    {"constraints: [x' - y*z']\nreactions: [{x: 1, z: -y}]\n", DAL_E_ON_D},
    {"constraints: [x' - y*z']\nreactions: [{x: z', z: -y*z'}]\n", DAL_E_ON_D},
    {"constraints: [x' - y*z']\nreactions: [{x: 1}]\n", 0},
    {"constraints: [x' - y*z']\nreactions: [{x: z', z: -x'}]\n", DAL_E_EXACT},
    {"constraints: [x' - y]\nreactions: [{x: y', y: -x'}]\n", DAL_E_EXACT},
    /* Pushing across all that both constraints allow. */
    {"constraints: [x' - y*z', y' - z'*x]\nreactions: [{x: 1, z: -y}, {x: x, y: 1, z: -x - x*y}]\n",
     DAL_E_ON_D},
    {"constraints: [x' - y*z', y' - z'*x]\nreactions: [{x: 1, z: -y}, {y: 1}]\n", 0},
};

static void test_energy(void)
{
    for (size_t k = 0; k < sizeof fates / sizeof *fates; k++) {
        char text[512] = "coordinates: [x, y, z]\n"
                         "lagrangian: x'^2/2 + y'^2 + (1 + x^2)*z'^2/2 - x*y - z\n"
                         "start: {x: 0.2, y: 0.5, x': 0.3, y': 0.4, z': 0.7}\n";
        strcat(text, fates[k].text);
        reference b = reference_of_text(text);
        CU_ASSERT((b.system->properties & (DAL_E_EXACT | DAL_E_ON_D)) == fates[k].energy);
        reference_free(&b);
    }
}

/* ---- the pendulum on its cart ---- */

typedef struct pendulum {
    double l, g, k;
} pendulum;

/* (l + k cos(theta)) theta'' = -g sin(theta), by RK4. */
static void swing(const pendulum *p, double h, double *x)
{
    double k[4][2], y[2] = {x[0], x[1]};
    static const double node[] = {0.5, 0.5, 1.0, 0.0};
    for (int s = 0; s < 4; s++) {
        k[s][0] = y[1];
        k[s][1] = -p->g * sin(y[0]) / (p->l + p->k * cos(y[0]));
        for (int i = 0; i < 2; i++) y[i] = x[i] + h * node[s] * k[s][i];
    }
    for (int i = 0; i < 2; i++) x[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

static void test_pendulum(void)
{
    const pendulum p = {1.3, 0.9, 0.5};
    const dal_setting set[] = {{"l", p.l}, {"g", p.g}, {"k", p.k}};
    reference b = reference_builtin("servo-pendulum");
    dal_run *run;
    dal_run_spec spec = {.system = b.system,
                         .options = dal_options_default(),
                         .parameters = set,
                         .parameter_count = 3};
    double x[2] = {1.2, 0.3};
    spec.options.step = 0.02;
    CU_ASSERT_FATAL(dal_method_parse(&spec.method, "gauss8", NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_run_create(&run, &spec, NULL) == DAL_STATUS_OK);
    CU_ASSERT(dal_run_advance(run, 500, NULL) == DAL_STATUS_OK);
    for (int k = 0; k < 10000; k++) swing(&p, 0.001, x);
    const double *state = dal_run_state(run);
    CU_ASSERT(fabs(state[1] - x[0]) < 1e-12 && fabs(state[3] - x[1]) < 1e-12);
    CU_ASSERT(fabs(state[0] - p.k * (x[0] - 1.2)) < 1e-12);
    dal_run_free(run);
    reference_free(&b);
}

/* Where l + k cos(theta) = 0 the motor has no hold on its speed. */
static void test_loss(void)
{
    const dal_setting set[] = {{"k", 2.0}, {"theta0", 1.9}, {"omega0", 6.0}};
    reference b = reference_builtin("servo-pendulum");
    dal_run *run;
    dal_error error;
    dal_run_spec spec = {.system = b.system,
                         .options = dal_options_default(),
                         .parameters = set,
                         .parameter_count = 3};
    spec.options.step = 0.05;
    CU_ASSERT_FATAL(dal_method_parse(&spec.method, "rk4", NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_run_create(&run, &spec, NULL) == DAL_STATUS_OK);
    CU_ASSERT(dal_run_advance(run, 100, &error) == DAL_STATUS_SINGULAR);
    CU_ASSERT(strstr(error.message, "the reactions: det A W^-1 B^T") != NULL);
    dal_run_free(run);
    reference_free(&b);
}

void suite_reactions(void)
{
    CU_pSuite suite = CU_add_suite("reactions along directions of their own", NULL, NULL);
    CU_add_test(suite, "field", test_field);
    CU_add_test(suite, "adjoint", test_adjoint);
    CU_add_test(suite, "metric of projections", test_metric);
    CU_add_test(suite, "Chetaev's rule as a special case", test_parallel);
    CU_add_test(suite, "fate of E", test_energy);
    CU_add_test(suite, "pendulum on a cart: reduced equation", test_pendulum);
    CU_add_test(suite, "pendulum on a cart: loss of the constraint", test_loss);
}
