/* test_picture.c - how systems say they are drawn. */
#include "dalembert_program.h"
#include "reference.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <string.h>

static const char drawn[] = "coordinates: [x, theta]\n"
                            "parameters: {l: 2}\n"
                            "let: {bob: l*sin(theta)}\n"
                            "lagrangian: (x'^2 + theta'^2)/2\n"
                            "constraints: [x' - theta']\n"
                            "picture: {width: theta'*t, x: x + bob, y: -l*cos(theta), body: disk,\n"
                            "          angle: theta/4, spin: 2*theta, wz: theta'}\n";

static void test_numbers(void)
{
    const double q[] = {0.5, 0.3}, v[] = {0.0, 0.7};
    double out[DAL_PICTURE_COUNT];
    reference b = reference_of_text(drawn);
    reference_set(&b, "l", 3.0);
    CU_ASSERT_FATAL(b.system->picture != NULL);
    CU_ASSERT(b.system->picture->body == DAL_BODY_DISK);
    CU_ASSERT(reference_call(&b, b.system->picture->evaluate, 2.0, q, v, out) == DAL_STATUS_OK);
    CU_ASSERT(fabs(out[DAL_PICTURE_X] - (0.5 + 3.0 * sin(0.3))) < 1e-15);
    CU_ASSERT(fabs(out[DAL_PICTURE_Y] + 3.0 * cos(0.3)) < 1e-15);
    CU_ASSERT(out[DAL_PICTURE_ANGLE] == 0.3 / 4);
    CU_ASSERT(out[DAL_PICTURE_STEER] == 0.0);
    CU_ASSERT(fabs(out[DAL_PICTURE_WIDTH] - 1.4) < 1e-15);
    CU_ASSERT(out[DAL_PICTURE_SPIN] == 0.6);
    CU_ASSERT(out[DAL_PICTURE_WX] == 0.0 && out[DAL_PICTURE_WZ] == 0.7);
    reference_free(&b);
}

static void test_absent(void)
{
    reference b = reference_of_text("coordinates: [x]\nlagrangian: x'^2\n");
    CU_ASSERT(b.system->picture == NULL);
    reference_free(&b);
}

/* A body in plain view is a point unless it says what it is. */
static void test_point(void)
{
    reference b =
        reference_of_text("coordinates: [x, y]\nlagrangian: x'^2 + y'^2\npicture: {x: x, y: y}\n");
    CU_ASSERT(b.system->picture != NULL && b.system->picture->body == DAL_BODY_POINT);
    reference_free(&b);
}

/* ---- what is drawn rolls or glides along its heading ---- */

static int rolls(const dal_system *s)
{
    return s->m > 0 && s->picture &&
           (s->picture->body == DAL_BODY_SLEIGH || s->picture->body == DAL_BODY_BLADE ||
            s->picture->body == DAL_BODY_RACER || s->picture->body == DAL_BODY_ROBOT);
}

/* The velocity of the place across the heading, by the central difference along q + s v. */
static double slip(const reference *b, const double *x)
{
    static const double s = 1e-5;
    double q[REFERENCE_MAX], out[3][DAL_PICTURE_COUNT];
    for (int k = -1; k <= 1; k++) {
        for (int i = 0; i < b->system->n; i++) q[i] = x[i] + k * s * x[b->system->n + i];
        CU_ASSERT(reference_call(b, b->system->picture->evaluate, 0.0, q, x + b->system->n,
                                 out[k + 1]) == DAL_STATUS_OK);
    }
    double dx = (out[2][DAL_PICTURE_X] - out[0][DAL_PICTURE_X]) / (2 * s);
    double dy = (out[2][DAL_PICTURE_Y] - out[0][DAL_PICTURE_Y]) / (2 * s);
    double angle = out[1][DAL_PICTURE_ANGLE];
    return dy * cos(angle) - dx * sin(angle);
}

/* At the start and, turned, at t = 0.6, where RK4 with h = 0.001 keeps D to 1e-10. */
static void check_rolling(const reference *b)
{
    dal_run *run;
    dal_run_spec spec = {.system = b->system, .options = dal_options_default()};
    spec.options.step = 0.001;
    spec.options.space = DAL_PHYSICAL;
    CU_ASSERT(dal_method_parse(&spec.method, "rk4", NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_run_create(&run, &spec, NULL) == DAL_STATUS_OK);
    CU_ASSERT(fabs(slip(b, dal_run_state(run))) < 1e-9);
    CU_ASSERT(dal_run_advance(run, 600, NULL) == DAL_STATUS_OK);
    CU_ASSERT(fabs(slip(b, dal_run_state(run))) < 1e-9);
    dal_run_free(run);
}

static void test_rolling(void)
{
    int found = 0;
    for (int i = 0; dal_builtin_name(i); i++) {
        reference b = reference_builtin(dal_builtin_name(i));
        if (rolls(b.system)) {
            check_rolling(&b);
            found++;
        }
        reference_free(&b);
    }
    CU_ASSERT(found >= 9);
}

/* The angular velocity in space of Suslov's body has the components R w, R = Rz(alpha) Rx(beta)
 * Rz(gamma), of the body's w. */
static void test_turning(void)
{
    const double alpha = 0.4, beta = 1.1, gamma = -0.7, q[] = {alpha, beta, gamma};
    const double v[] = {0.3, -0.5, 0.9};
    double w[] = {v[0] * sin(beta) * sin(gamma) + v[1] * cos(gamma),
                  v[0] * sin(beta) * cos(gamma) - v[1] * sin(gamma), v[0] * cos(beta) + v[2]};
    const struct {
        int first, second;
        double angle;
    } turns[] = {{0, 1, gamma}, {1, 2, beta}, {0, 1, alpha}};
    for (int k = 0; k < 3; k++) {
        double *a = &w[turns[k].first], *b = &w[turns[k].second];
        const double x = *a, y = *b, c = cos(turns[k].angle), s = sin(turns[k].angle);
        *a = c * x - s * y;
        *b = s * x + c * y;
    }
    double out[DAL_PICTURE_COUNT];
    reference b = reference_builtin("suslov");
    CU_ASSERT_FATAL(b.system->picture != NULL && b.system->picture->body == DAL_BODY_BOX);
    CU_ASSERT(reference_call(&b, b.system->picture->evaluate, 0.0, q, v, out) == DAL_STATUS_OK);
    for (int i = 0; i < 3; i++) CU_ASSERT(fabs(out[DAL_PICTURE_WX + i] - w[i]) < 1e-15);
    reference_free(&b);
}

void suite_picture(void)
{
    CU_pSuite suite = CU_add_suite("picture", NULL, NULL);
    CU_add_test(suite, "the numbers of a picture", test_numbers);
    CU_add_test(suite, "no picture", test_absent);
    CU_add_test(suite, "a point", test_point);
    CU_add_test(suite, "bodies move along their heading", test_rolling);
    CU_add_test(suite, "a body turns by its angular velocity", test_turning);
}
