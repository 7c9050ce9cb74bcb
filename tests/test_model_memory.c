/* test_model_memory.c - every allocation of what is made of a model fails: the status is
 * DAL_STATUS_MEMORY, with a message, and no block is left. */
#include "allocation.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Much of what a file can say. */
static const char rich[] =
    "title: much\nsizes: {N: 2}\ncoordinates: ['x[1..N]', y]\n"
    "parameters: {\"k[i]\": {for: i = 1..N, is: i/2}, c: 0.5}\n"
    "functions: {f(u): u^2 + abs(u)}\nlet: {\"d[i]\": {for: i = 1..N, is: \"k[i]*x[i]\"}}\n"
    "gauge: {mu_e: 0.1*cos(t)}\nlagrangian: sum(i, 1, N, x[i]'^2/2 - d[i]^2) + y'^2/2\n"
    "forces: {\"x[i]\": \"for i = 1..N: -c*x[i]'\", y: f(x1)}\nconstraints: [\"y' - x1*x2'\"]\n"
    "holonomic: [{for: i = 1..1, is: 'x[i] - y^2'}]\n"
    "start: {\"x[i]\": {for: i = 1..N, is: '1'}, y: 1, x2': 0.5, solve: [y', x1']}\n"
    "invariants: {g: x2'}\nevents:\n"
    "  - {for: i = 1..N, when: 'x[i] - 3', direction: up, set: {\"x[i]\": '-x[i]/i'}}\n"
    "  - {when: y - 2, set: {\"x[j]\": {for: j = 2..N, is: 10*j}, x1': 0}}\n"
    "  - {when: y + 3, stop: true}\n  - {when: y + 2, restitution: c}\n";
static const char sum[] =
    "sizes: {N: 3}\ncoordinates: [\"x[1..N]\"]\nlagrangian: \"sum(i, 1, N, x[i]'^2)\"\n";
/* Accelerations that are given implicitly. */
static const char implicit[] = "coordinates: [x, y]\nparameters: {k: 0.5}\n"
                               "equations: [\"2*x'' + k*y'' + x\", \"x'' - 3*y'' + y*x'\"]\n"
                               "start: {x: 1}\n";
/* The mass matrix is regular on the kernel of A alone. */
static const char wheel[] = "coordinates: [x, theta]\nparameters: {k: 1}\n"
                            "lagrangian: x'^2/2 - k*x^2/2\nconstraints: [x' - theta'/2]\n"
                            "start: {x: 1}\n";
static const char sleigh[] = "coordinates: [x, y, phi]\nparameters: {m: 2}\n"
                             "lagrangian: m/2*(x'^2 + y'^2) + phi'^2/2\n"
                             "constraints: [x'*sin(phi) - y'*cos(phi)]\n"
                             "controls: [{x: cos(phi), y: sin(phi)}, {phi: 1}]\n"
                             "start: {x': 0.5, phi': 0.3}\n";

typedef dal_status making(const char *text, dal_error *error);

/* Makes it with each allocation that fails: the error then has no place in the text. */
static void check(making *make, const char *text)
{
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal_error error = {.line = -1};
        allocation_start(&trial);
        if (allocation_end(&trial, make(text, &error)))
            CU_ASSERT(error.status == DAL_STATUS_MEMORY && error.line == 0);
    }
    CU_ASSERT(trial.failures > 0);
}

static dal_status read_model(dal_model **model, const char *text, dal_error *error)
{
    const bool is_file = strchr(text, '\n') != NULL;
    const dal_status status = is_file ? dal_model_read(model, "test", text, strlen(text), error)
                                      : dal_model_builtin(model, text, error);
    CU_ASSERT_EQUAL(status, allocation_failed() ? DAL_STATUS_MEMORY : DAL_STATUS_OK);
    return status;
}

static dal_status read_system(dal_model **model, const char *text, const dal_system **system,
                              dal_error *error)
{
    const dal_status status = read_model(model, text, error);
    return status == DAL_STATUS_OK ? dal_model_system(*model, system, error) : status;
}

static dal_status make_tangent(const char *text, dal_error *error)
{
    dal_model *model;
    const dal_system *system;
    dal_status status = read_system(&model, text, &system, error);
    if (status == DAL_STATUS_OK) status = dal_model_tangent(model, &system, error);
    dal_model_free(model);
    return status;
}

static dal_status make_tangent_by(const char *text, dal_error *error)
{
    dal_model *model;
    const dal_system *system;
    dal_status status = read_system(&model, text, &system, error);
    if (status == DAL_STATUS_OK)
        status = dal_model_tangent_by(model, system->parameter[0], &system, error);
    dal_model_free(model);
    return status;
}

/* With another K than the paper's. */
static dal_status make_lift(const char *text, dal_effort effort, dal_error *error)
{
    dal_model *model;
    const dal_system *system;
    dal_status status = read_model(&model, text, error);
    if (status == DAL_STATUS_OK) status = dal_model_set_effort(model, effort, error);
    if (status == DAL_STATUS_OK) status = dal_model_set_gauge(model, "e = 1, mu_e = 0.1*x", error);
    if (status == DAL_STATUS_OK) status = dal_model_system(model, &system, error);
    if (status == DAL_STATUS_OK) status = dal_model_tangent(model, &system, error);
    dal_model_free(model);
    return status;
}
static dal_status lift_by_mass(const char *text, dal_error *error)
{
    return make_lift(text, DAL_EFFORT_MASS, error);
}
static dal_status lift_by_constraint(const char *text, dal_error *error)
{
    return make_lift(text, DAL_EFFORT_CONSTRAINT, error);
}
static dal_status lift_by_controls(const char *text, dal_error *error)
{
    return make_lift(text, DAL_EFFORT_CONTROLS, error);
}

static dal_status examine_constraints(const char *text, dal_error *error)
{
    dal_model *model;
    const dal_system *system;
    const double q[] = {1.0, 0.2, 0.3}, v[] = {0.4, 0.8, 0.1};
    const dal_point at = {.q = q, .v = v};
    dal_growth growth;
    dal_ranks ranks;
    dal_status status = read_system(&model, text, &system, error);
    if (status == DAL_STATUS_OK) status = dal_model_growth(model, NULL, 0, NULL, &growth, error);
    if (status == DAL_STATUS_OK)
        status = dal_model_growth_of(model, 0, NULL, 0, NULL, &growth, error);
    if (status == DAL_STATUS_OK) status = dal_model_ranks(model, NULL, 0, &at, NULL, &ranks, error);
    dal_model_free(model);
    return status;
}

static dal_status read_file(const char *path, dal_error *error)
{
    dal_model *model;
    const dal_system *system;
    dal_status status = dal_model_read_file(&model, path, error);
    CU_ASSERT_EQUAL(status, allocation_failed() ? DAL_STATUS_MEMORY : DAL_STATUS_OK);
    if (status == DAL_STATUS_OK) status = dal_model_system(model, &system, error);
    dal_model_free(model);
    return status;
}

typedef struct made {
    making *make;
    const char *text;
} made;

static void check_each(const made *list, int count)
{
    for (int i = 0; i < count; i += case_stride(5)) check(list[i].make, list[i].text);
}

static void test_systems(void)
{
    static const made list[] = {{make_tangent, sum},
                                {make_tangent, "vertical-disk"},
                                {make_tangent, "chaplygin-sleigh-vakonomic"},
                                {make_tangent, "servo-pendulum"},
                                {make_tangent, rich},
                                {make_tangent, implicit},
                                {make_tangent_by, wheel},
                                {make_tangent, wheel},
                                {make_tangent_by, sleigh}};
    check_each(list, 9);
}

static void test_constraints(void)
{
    static const made list[] = {{lift_by_constraint, wheel},  {lift_by_mass, sleigh},
                                {lift_by_constraint, sleigh}, {examine_constraints, wheel},
                                {lift_by_controls, sleigh},   {examine_constraints, sleigh}};
    check_each(list, 6);
}

static dal_status add_table(const char *text, dal_error *error)
{
    const double at[] = {0.0, 1.0, 2.0}, value[] = {1.0, 2.0, 1.5};
    const dal_table table = {.at = at, .value = value, .points = 3};
    dal_model *model;
    dal_status status = read_model(&model, text, error);
    if (status == DAL_STATUS_OK) status = dal_model_add_table(model, "f", &table, 1, 1, error);
    dal_model_free(model);
    return status;
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    CU_ASSERT(fputs(text, file) >= 0 && fclose(file) == 0);
}

static void test_files(void)
{
    char folder[] = "/tmp/dal-memory-XXXXXX", system[64], table[64];
    CU_ASSERT_PTR_NOT_NULL_FATAL(mkdtemp(folder));
    snprintf(system, sizeof system, "%s/system.yaml", folder);
    snprintf(table, sizeof table, "%s/f.csv", folder);
    write_text(table, "r,f\n0,1\n1,2\n2,1.5\n3,0.5\n");
    write_text(
        system,
        "coordinates: [x]\nlagrangian: x'^2/2 - f(x)\ntables: {f: {file: f.csv, at: r, value: f}}\n"
        "start: {x: 1}\n");
    check(read_file, system);
    check(add_table, "coordinates: [x]\nlagrangian: x'^2/2\n");
    remove(system);
    remove(table);
    rmdir(folder);
}

void suite_model_memory(void)
{
    CU_pSuite suite = CU_add_suite("models without memory", NULL, NULL);
    CU_add_test(suite, "systems and tangents", test_systems);
    CU_add_test(suite, "lifts, ranks and brackets", test_constraints);
    CU_add_test(suite, "files and tables", test_files);
}
