/* test_branches.c - systems whose formulas have branches: what is known of them, where they lose
 * smoothness, and motions against closed forms. */
#include "allocation.h"
#include "fixtures.h"
#include "motion.h"
#include "reference.h"
#include <dalembert_analysis.h>

#include <CUnit/Basic.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define PI   3.14159265358979323846
#define FREE "coordinates: [x, y]\nstart: {x: 1, x': 1, y: 0.5, y': 0.25}\nparameters: {k: 2}\n"

/* ---- what jumps ---- */

/* A table f; its derivatives jump at the points, a natural spline's from the third on. */
#define TABLE(form)                                                                                \
    "files: {f.csv: \"u,f\\n-9,0\\n0.5,1\\n2,0\\n9,3\"}\n"                                         \
    "tables: {f: {file: f.csv, at: u, value: f, interpolation: " form "}}\n"

enum { NO_BRANCH = -99 };

/* From the definitions: a jump of f itself, a kink, max(0, s)^n with n - 1 continuous derivatives;
 * a jump of U, of L_v or of D is an impulse. */
static const struct {
    const char *formula, *text;
    int jump;
} jumps[] = {
    {"force on x", "forces: {x: -sign(x')}", 0},
    {"force on x", "forces: {x: \"if(x > 2, 1, 0)*y\"}", 0},
    {"force on y", "forces: {y: floor(x + y/2)}", 0},
    {"force on y", "forces: {y: abs(x)}", 1},
    {"force on y", "forces: {y: \"min(x, k*y)\"}", 1},
    {"force on y", "forces: {y: \"if(t < 1, t - 1, 0)\"}", 1},
    /* Without bound on one side of x = 2, where it passes the value on the other. */
    {"force on y", "forces: {y: \"if(x > 2, 22, -log(4 - x^2))\"}", 0},
    {"force on y", "forces: {y: \"if(x > 2, -log(x^2 - 4), 22)\"}", 0},
    {"force on y", "forces: {y: x'*abs(x')}", 2},
    {"force on y", "forces: {y: sign(x)*sqrt(abs(x))}", 1},
    {"force on y", "forces: {y: abs(x)^1.5}", 2},
    {"force on y", "forces: {y: abs(x' - x)^2.5}", 3},
    {"force on y", "forces: {y: sign(x)*abs(x)^3.5}", DAL_JUMP_NONE},
    {"force on y", "forces: {y: \"max(0, x - 3)^3\"}", 3},
    {"force on y", "forces: {y: \"max(0, x - 3)^4\"}", DAL_JUMP_NONE},
    {"force on y", "forces: {y: \"if(x < y, x - y, y - x)^2\"}", DAL_JUMP_NONE},
    {"", "forces: {y: x^2 + floor(x) - floor(x)}", NO_BRANCH},
    {"", "forces: {y: \"if(k > 1, x, y)\"}", NO_BRANCH},
    {"force on y", "forces: {y: abs(x^2 + 1)}", DAL_JUMP_UNKNOWN},
    /* Of several surfaces, whichever comes first, the one with the lowest. */
    {"force on y", "forces: {y: abs(x) + sign(y)}", 0},
    {"force on y", "forces: {y: sign(x) + abs(y)}", 0},
    {"force on y", "forces: {y: \"max(0, x)^3 + max(0, y)^2 + abs(x' - y)\"}", 1},
    {"force on y", "forces: {y: f(x)}\n" TABLE("linear"), 1},
    {"force on y", "forces: {y: x'*f(t)}\n" TABLE("linear"), 1},
    {"force on y", "forces: {y: f(x)}\n" TABLE("cubic"), 3},
    {"force on y", "forces: {y: f(abs(x))}\n" TABLE("cubic"), 1},
    {"lagrangian", "lagrangian: (x'^2 + y'^2)/2 - f(x)\n" TABLE("cubic"), 2},
    {"lagrangian", "lagrangian: (x'^2 + y'^2)/2 - k*abs(x)", 0},
    {"lagrangian", "lagrangian: (x'^2 + y'^2)/2 - k*max(x, 0)^2", 1},
    {"lagrangian", "lagrangian: (x'^2 + y'^2)/2 - if(x > 0, k, 0)", DAL_JUMP_IMPULSE},
    {"lagrangian", "lagrangian: if(x > 0, 1, 2)*x'^2 + y'^2/2", DAL_JUMP_IMPULSE},
    {"lagrangian", "lagrangian: (x'^2 + y'^2)/2 + k*abs(y')", DAL_JUMP_IMPULSE},
    {"constraint 1", "constraints: [\"y' - if(x > 0, x', 0)\"]", DAL_JUMP_IMPULSE},
    {"constraint 1", "constraints: [\"y' - max(x, 0)*x'\"]", 0},
    {"holonomic constraint 1", "holonomic: [\"y - x*abs(x)\"]", 0},
    {"holonomic constraint 1", "holonomic: [y - abs(x)]", DAL_JUMP_IMPULSE},
    {"equation 2", "equations: [\"x''\", \"y'' + abs(x)\"]", 1},
    {"equation 1", "equations: [\"x'' + sign(y)\", \"y''\"]", 0},
};

static void check_jump(const char *formula, const char *text, int jump)
{
    char yaml[512];
    dal_branch branch[2];
    int count = -1;
    const bool free = strncmp(text, "lagrangian", 10) != 0 && strncmp(text, "equations", 9) != 0;
    snprintf(yaml, sizeof yaml, FREE "%s%s\n", free ? "lagrangian: (x'^2 + y'^2)/2\n" : "", text);
    reference b = reference_of_text(yaml);
    CU_ASSERT_EQUAL(dal_model_branches(b.model, branch, 2, &count), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(count, jump == NO_BRANCH ? 0 : 1);
    if (count == 1) CU_ASSERT_STRING_EQUAL(branch[0].formula, formula);
    if (count == 1) CU_ASSERT_EQUAL(branch[0].jump, jump);
    if (count == 1 && branch[0].jump != jump) printf("\n  %s: %d", text, branch[0].jump);
    if (count == 1) CU_ASSERT(branch[0].line == (free ? 5 : 4) && branch[0].column > 1);
    CU_ASSERT_EQUAL(dal_model_branches(b.model, NULL, 0, &count), DAL_STATUS_OK);
    reference_free(&b);
}

static void test_jumps(void)
{
    for (size_t i = 0; i < sizeof jumps / sizeof jumps[0]; i++)
        check_jump(jumps[i].formula, jumps[i].text, jumps[i].jump);
}

/* ---- what a run passes ---- */

/* x = 1 + t, and with the force on x also x' = 1 + t; steps of 0.25, so that some states are on a
 * surface.  There a node has no branch: it is passed in the step after. */
enum { STEPS = 12 };
static const struct {
    const char *text;
    int count;           /* of nodes whose branches are watched */
    const char *formula; /* that is passed; NULL: none */
    const char *at;      /* for each step, whether it passes */
} passed[] = {
    {"forces: {y: sign(x - 3.1)}", 1, "force on y", "000000001000"},
    {"forces: {y: sign(3 - x)}", 1, "force on y", "000000001000"},
    {"forces: {y: sign(x - 1)}", 1, NULL, "000000000000"},
    {"forces: {y: \"if(x < 1.6 + t/5, 1, 0)\"}", 1, "force on y", "000100000000"},
    {"forces: {y: floor(x + 0.1)}", 1, "force on y", "000100010001"},
    {"forces: {y: abs(x - 2.1)}", 0, NULL, "000000000000"},
    {"forces: {y: \"min(x, 2.1)\"}", 0, NULL, "000000000000"},
    {"forces: {y: sign(x^2 + 1)}", 1, NULL, "000000000000"},
    {"forces: {y: abs(x^2 + 1)}", 0, NULL, "000000000000"},
    {"forces: {y: floor(x) - floor(x)}", 0, NULL, "000000000000"},
    {"forces: {x: 1, y: abs(x' - 2.1)}", 1, "force on y", "000010000000"},
    {"forces: {x: 1, y: \"max(x', 2.6)\"}", 1, "force on y", "000000100000"},
    {"forces: {x: 1, y: f(x')}\n" TABLE("linear"), 1, "force on y", "000010000000"},
    {"forces: {x: 1, y: f(x' - 2)}\n" TABLE("linear"), 1, "force on y", "000000100000"},
    {"forces: {x: f(x)}\n" TABLE("linear"), 0, NULL, "000000000000"},
    {"forces: {x: 1, y: sign(x' - 2.1) + sign(2.9 - x')}", 2, "force on y", "000010010000"},
    {"forces: {x: \"if(y > 99, 0, 1)\", y: sign(x' - 2.1)}", 2, "force on y", "000010000000"},
    {"constraints: [\"y' - if(x > 3.1, x', x'/4)\"]", 1, "constraint 1", "000000001000"},
};

static void check_passed(size_t i)
{
    char yaml[512], seen[STEPS + 1] = "";
    dal_jumps *watched = NULL;
    snprintf(yaml, sizeof yaml, FREE "lagrangian: (x'^2 + y'^2)/2\n%s\n", passed[i].text);
    reference b = reference_of_text(yaml);
    const dal_run_spec spec = fixture_spec(b.system, "symplectic-euler-00", DAL_PHYSICAL, 0.25);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL_FATAL(dal_jumps_create(&watched, b.model), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_jumps_count(watched), passed[i].count);
    CU_ASSERT_PTR_NULL(dal_jumps_passed(watched, run));
    for (int k = 0; k < STEPS; k++) {
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        const char *formula = dal_jumps_passed(watched, run);
        seen[k] = formula ? '1' : '0';
        if (formula) CU_ASSERT_STRING_EQUAL(formula, passed[i].formula);
    }
    CU_ASSERT_STRING_EQUAL(seen, passed[i].at);
    if (strcmp(seen, passed[i].at) != 0) printf("\n  %s: %s", passed[i].text, seen);
    dal_jumps_free(watched);
    dal_run_free(run);
    reference_free(&b);
}

static void test_passed(void)
{
    for (size_t i = 0; i < sizeof passed / sizeof passed[0]; i++) check_passed(i);
}

/* Each time of another model, which keeps what is made for it. */
static void test_jumps_memory(void)
{
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal_jumps *watched = NULL;
        reference b = reference_of_text(FREE "lagrangian: (x'^2 + y'^2)/2\n"
                                             "forces: {y: sign(x - 3) + floor(x')}\n");
        allocation_start(&trial);
        const dal_status status = dal_jumps_create(&watched, b.model);
        CU_ASSERT_EQUAL(watched == NULL, allocation_end(&trial, status));
        dal_jumps_free(watched);
        reference_free(&b);
    }
}

/* ---- what is known of a system ---- */

/* That a law holds in one branch alone is no property. */
static void test_properties(void)
{
    static const struct {
        const char *text;
        unsigned has, lacks;
    } cases[] = {
        {"forces: {x: \"if(x > 100, -x', 0)\"}\n", 0, DAL_E_EXACT | DAL_E_ON_D},
        {"constraints: [y' - k*x']\n", DAL_D_CONSTANT | DAL_D_LINEAR, 0},
        {"constraints: [\"y' - if(x > 9, 2, 1)*x'\"]\n", DAL_D_LINEAR,
         DAL_D_CONSTANT | DAL_D_BILINEAR | DAL_D_QUADRATIC},
        {"constraints: [\"y' - max(x', 2*x')\"]\n", 0, DAL_D_LINEAR | DAL_D_CONSTANT},
        {"constraints: [\"y' - abs(x')\"]\n", 0, DAL_D_LINEAR | DAL_D_BILINEAR},
        {"constraints: [\"y' - if(k > 1, 2, 1)*x'\"]\n", DAL_D_LINEAR | DAL_D_CONSTANT, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char yaml[512];
        snprintf(yaml, sizeof yaml, FREE "lagrangian: (x'^2 + y'^2)/2\n%s", cases[i].text);
        reference b = reference_of_text(yaml);
        CU_ASSERT_EQUAL(b.system->properties & cases[i].has, cases[i].has);
        CU_ASSERT_EQUAL(b.system->properties & cases[i].lacks, 0);
        reference_free(&b);
    }
}

/* A denominator of a branch that is not taken may pass through zero; one of a branch that is
 * always needed may not. */
static void test_guards(void)
{
    static const char yaml[] = FREE "lagrangian: (x'^2 + y'^2)/2\nconstraints: [\"%s\"]\n";
    static const struct {
        const char *D;
        int guards;
    } cases[] = {{"y' - x'/(x - 2)", 1},
                 {"y' - if(x > 5, x'/(x - 2), x')", 0},
                 {"y' - x'/(x - 2 + if(x > 1, 2, 0))", 0},
                 {"y' - max(x', x'/(x - 2))", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[512];
        snprintf(text, sizeof text, yaml, cases[i].D);
        reference b = reference_of_text(text);
        CU_ASSERT_EQUAL(b.system->guards, cases[i].guards);
        reference_free(&b);
    }
}

/* A kink is no part of a quadratic potential, whose gradient at the midpoint is a discrete one. */
static void test_potential(void)
{
    static const char *const kinked[] = {"abs(x)", "max(x, 0)", "if(x > 0, x, 2*x)"};
    const double q[] = {0.5, 0.25}, v[] = {1.0, 1.0};
    double out[6];
    for (int i = 0; i < 3; i++) {
        char text[256];
        snprintf(text, sizeof text, FREE "lagrangian: (x'^2 + y'^2)/2 - %s - y^2\n", kinked[i]);
        reference b = reference_of_text(text);
        CU_ASSERT_EQUAL(reference_call(&b, b.system->call.potential, 0.0, q, v, out),
                        DAL_STATUS_OK);
        CU_ASSERT(out[0] != 0.0 && out[1] == 0.0);
        reference_free(&b);
    }
}

/* ---- motions ---- */

/* y swings for a time of pi on the spring of stiffness 1, of pi/2 on the one of stiffness 4.  Steps
 * that end where the spring changes lose no order; steps across are of order 2. */
static void test_unequal_springs(void)
{
    static const double period = 1.5 * PI;
    const motion_settings none = {0},
                          start = {4, {{"y", 0.0}, {"y'", 1.0}, {"z'", 0.0}, {"x'", 1.0}}};
    motion z = motion_open("unequal-springs", DAL_PHYSICAL, period / 384, none, start);
    motion_advance(&z, period);
    CU_ASSERT_DOUBLE_EQUAL(z.x[1], 0.0, 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(z.x[4], 1.0, 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(motion_invariant(&z, 1), 1.0, 1e-13);
    motion_close(&z);
    double error[2];
    for (int k = 0; k < 2; k++) {
        const double step = period / (385 << k);
        z = motion_open("unequal-springs", DAL_PHYSICAL, step, none, start);
        motion_advance(&z, period);
        error[k] = hypot(z.x[1], z.x[4] - 1.0);
        CU_ASSERT_DOUBLE_EQUAL(motion_invariant(&z, 0), 0.5, step * step);
        motion_close(&z);
    }
    CU_ASSERT(error[0] > 1e-8 && error[0] < 1e-4 && error[1] < error[0]);
}

void suite_branches(void)
{
    CU_pSuite suite = CU_add_suite("branches", NULL, NULL);
    CU_add_test(suite, "what jumps", test_jumps);
    CU_add_test(suite, "what a run passes", test_passed);
    CU_add_test(suite, "jumps: out of memory", test_jumps_memory);
    CU_add_test(suite, "properties", test_properties);
    CU_add_test(suite, "guards", test_guards);
    CU_add_test(suite, "potentials with a kink", test_potential);
    CU_add_test(suite, "unequal springs", test_unequal_springs);
}
