/* test_tables.c - functions given by points: values and derivatives, files, what is refused. */
#include "reference.h"
#include <dalembert.h>

#include <CUnit/Basic.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- values ---- */

/* x'' = f(t), y'' = f(y), with one table. */
static dal_model *model_of(const dal_table *table)
{
    dal_model *model = dal_model_create("table");
    static const char *const entries[][2] = {{"x", "f(t)"}, {"y", "f(y)"}};
    for (int i = 0; i < 2; i++)
        CU_ASSERT_EQUAL(
            dal_model_add(model, DAL_SECTION_COORDINATES, NULL, entries[i][0], 0, 0, NULL),
            DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_add_table(model, "f", table, 0, 0, NULL), DAL_STATUS_OK);
    for (int i = 0; i < 2; i++)
        CU_ASSERT_EQUAL(dal_model_add(model, DAL_SECTION_ACCELERATIONS, entries[i][0],
                                      entries[i][1], 0, 0, NULL),
                        DAL_STATUS_OK);
    return model;
}

/* The value at u, and where slope is not NULL the derivative, from the callbacks of the system. */
static double value_at(const dal_table *table, double u, double *slope)
{
    const dal_system *system = NULL;
    dal_model *model = model_of(table);
    dal_error error;
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, &error), DAL_STATUS_OK);
    double *work = calloc(system->workspace + 1, sizeof *work);
    double q[2] = {0.0, u}, v[2] = {0.0}, pi[2] = {0.0, 1.0}, F[2], adjoint[6];
    const dal_point at = {u, q, v, pi, work, NULL};
    CU_ASSERT_EQUAL(system->prepare(system, &at, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(system->call.field(system, &at, F), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(system->call.adjoint(system, &at, adjoint), DAL_STATUS_OK);
    if (slope) *slope = adjoint[3]; /* d(pi.F)/dy */
    CU_ASSERT((isnan(F[0]) && isnan(F[1])) || F[0] == F[1]);
    free(work);
    dal_model_free(model);
    return F[1];
}

/* Straight lines; at a point the slope is the slope on its right. */
static void test_linear(void)
{
    static const double at[] = {-1.0, 0.0, 2.0, 3.0}, value[] = {4.0, 1.0, 2.0, -6.0};
    static const struct {
        double u, value, slope;
    } expected[] = {{-1.0, 4.0, -3.0}, {-0.5, 2.5, -3.0}, {0.0, 1.0, 0.5},  {1.0, 1.5, 0.5},
                    {2.0, 2.0, -8.0},  {2.5, -2.0, -8.0}, {3.0, -6.0, -8.0}};
    const dal_table table = {at, value, 4, DAL_LINEAR, DAL_EXTEND_NONE};
    double slope;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        CU_ASSERT_DOUBLE_EQUAL(value_at(&table, expected[i].u, &slope), expected[i].value, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(slope, expected[i].slope, 1e-15);
    }
}

/* The natural spline through 0, 1, 0 at 0, 1, 2: M_1 = -3, f = x + (x - x^3)/2 on [0, 1], and the
 * mirror image after it. */
static void test_cubic(void)
{
    static const double at[] = {0.0, 1.0, 2.0}, value[] = {0.0, 1.0, 0.0};
    const dal_table table = {at, value, 3, DAL_CUBIC, DAL_EXTEND_NONE};
    for (int i = 0; i <= 20; i++) {
        const double u = 0.1 * i, s = u <= 1.0 ? u : 2.0 - u;
        double slope;
        CU_ASSERT_DOUBLE_EQUAL(value_at(&table, u, &slope), s + (s - s * s * s) / 2, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(slope, (u <= 1.0 ? 1 : -1) * (1.5 - 1.5 * s * s), 3e-15);
    }
}

/* Without knots beside the ends the spline through points of a cubic is the cubic; through three
 * points it is the parabola, through two the line. */
static void test_not_a_knot(void)
{
    static const double at[] = {-1.0, -0.7, 0.2, 0.5, 1.4, 2.0};
    double value[6];
    for (int points = 2; points <= 6; points++) {
        const double cubic = points > 3 ? 0.8 : 0.0, square = points > 2 ? -0.6 : 0.0;
        for (int i = 0; i < points; i++)
            value[i] = ((cubic * at[i] + square) * at[i] + 1.1) * at[i] - 0.3;
        const dal_table table = {at, value, points, DAL_NOT_A_KNOT, DAL_EXTEND_NONE};
        for (int i = 0; i <= 10; i++) {
            const double u = at[0] + 0.1 * i * (at[points - 1] - at[0]);
            double slope;
            CU_ASSERT_DOUBLE_EQUAL(value_at(&table, u, &slope),
                                   ((cubic * u + square) * u + 1.1) * u - 0.3, 2e-14);
            CU_ASSERT_DOUBLE_EQUAL(slope, (3.0 * cubic * u + 2.0 * square) * u + 1.1, 2e-13);
        }
    }
}

/* Away from the ends a spline through points of sin differs from it by 5/384 h^4 at most (Hall
 * 1968), and its slope by h^3/24. */
static void test_sine(void)
{
    enum { POINTS = 41 };
    double at[POINTS], value[POINTS];
    const double h = 0.25;
    for (int i = 0; i < POINTS; i++) {
        at[i] = h * (i - POINTS / 2);
        value[i] = sin(at[i]);
    }
    const dal_table table = {at, value, POINTS, DAL_CUBIC, DAL_EXTEND_NONE};
    double max = 0.0;
    for (int i = 0; i < 100; i++) {
        const double u = -0.8 + 0.0161 * i;
        double slope;
        max = fmax(max, fabs(value_at(&table, u, &slope) - sin(u)));
        CU_ASSERT_DOUBLE_EQUAL(slope, cos(u), h * h * h / 24);
    }
    CU_ASSERT(max < 5.0 / 384 * pow(h, 4) && max > 1e-3 * pow(h, 4));
}

static void test_extension(void)
{
    static const double at[] = {0.0, 1.0, 2.0}, value[] = {0.0, 1.0, 0.0};
    static const struct {
        dal_interpolation form;
        dal_extend extend;
        double u, value, slope;
    } expected[] = {{DAL_LINEAR, DAL_EXTEND_NONE, -0.1, NAN, NAN},
                    {DAL_CUBIC, DAL_EXTEND_NONE, 2.1, NAN, NAN},
                    {DAL_LINEAR, DAL_EXTEND_CONSTANT, -4.0, 0.0, 0.0},
                    {DAL_CUBIC, DAL_EXTEND_CONSTANT, 1e6, 0.0, 0.0},
                    {DAL_LINEAR, DAL_EXTEND_LINEAR, -4.0, -4.0, 1.0},
                    {DAL_LINEAR, DAL_EXTEND_LINEAR, 5.0, -3.0, -1.0},
                    {DAL_CUBIC, DAL_EXTEND_LINEAR, -4.0, -6.0, 1.5},
                    {DAL_CUBIC, DAL_EXTEND_LINEAR, 4.0, -3.0, -1.5}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const dal_table table = {at, value, 3, expected[i].form, expected[i].extend};
        double slope;
        const double found = value_at(&table, expected[i].u, &slope);
        if (isnan(expected[i].value)) {
            CU_ASSERT(isnan(found) && isnan(slope));
            continue;
        }
        CU_ASSERT_DOUBLE_EQUAL(found, expected[i].value, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(slope, expected[i].slope, 1e-14);
    }
    /* A clock may pass the end by its rounding. */
    const dal_table table = {at, value, 3, DAL_LINEAR, DAL_EXTEND_NONE};
    CU_ASSERT_DOUBLE_EQUAL(value_at(&table, nextafter(2.0, 3.0), NULL), 0.0, 1e-15);
}

/* ---- the robot ---- */

/* Speed and heading do not depend on the constraint: m v' = (l + r)/0.1, J phi'' = 2 (r - l) have
 * straight lines on the right, whose integrals are exact. */
static void test_robot(void)
{
    static const struct {
        double t, speed, phi, turn;
    } expected[] = {{1, 1.25, 0, 0},
                    {2, 1.25 + 2.625, 1.0 / 15, 0.2},
                    {4, 7.375, 37.0 / 15, 2.2},
                    {6, 7.625, 7.4, 2.6}};
    dal_model *model = NULL;
    const dal_system *system = NULL;
    dal_run *run = NULL;
    dal_run_spec spec = {.options = dal_options_default()};
    CU_ASSERT_EQUAL_FATAL(dal_model_read_file(&model, "examples/driven-robot.yaml", NULL),
                          DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    spec.system = system;
    spec.options.step = 0.01;
    spec.options.space = DAL_PHYSICAL;
    CU_ASSERT_EQUAL(dal_method_parse(&spec.method, "gauss6", NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_run_create(&run, &spec, NULL), DAL_STATUS_OK);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const double *y;
        while (dal_run_time(run) < expected[i].t - 0.005)
            CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        y = dal_run_state(run);
        CU_ASSERT_DOUBLE_EQUAL(y[3] * cos(y[2]) + y[4] * sin(y[2]), expected[i].speed, 1e-8);
        CU_ASSERT_DOUBLE_EQUAL(y[2], expected[i].phi, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(y[5], expected[i].turn, 1e-13);
    }
    dal_run_free(run);
    dal_model_free(model);
}

/* ---- files ---- */

#define SYSTEM "coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: f(t)}\n"
#define TABLE  "tables: {f: {file: f.csv, at: t, value: M}}\n"

static void test_errors(void)
{
    static const struct {
        const char *text, *message;
        int line, column;
    } cases[] = {
        {SYSTEM TABLE, "'f.csv' is not under files, and the text has no directory", 4, 20},
        {SYSTEM TABLE "files: {g.csv: \"t,M\"}\n", "'f.csv' is not under files", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"\"}\n", "f.csv:1:1: the file is empty", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"t,M\"}\n",
         "f.csv:1:1: a table needs two points or more, not 0", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"time,M\\n0,1\\n1,1\"}\n", "unknown column of 'f.csv' 't'",
         4, 31},
        {SYSTEM TABLE "files: {f.csv: \"t,M,M\\n0,1,2\\n1,1,2\"}\n",
         "f.csv:1:5: another column is called 'M', too", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"t,M, \\n0,1,2\\n1,1,2\"}\n",
         "f.csv:1:6: column 3 has no head", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \",t,M\\n0,0,1\\n1,1,2\"}\n",
         "f.csv:1:1: column 1 has no head", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"t,M\\n0,1\\n1,1,7\\n\"}\n",
         "f.csv:3:5: column 3 has no head", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"t,M\\n0,1,\\n1,1\\n\"}\n",
         "f.csv:2:5: column 3 has no head", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"t,M\\n0,1\\n1, 2x\\n\"}\n",
         "f.csv:3:4: '2x' is not a number", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"t,M\\n0,1\\n\\n1\\n\"}\n",
         "f.csv:4:2: the line has 1 column; column 2 is missing", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"t,M\\n0,1\\n2,1\\n2,3\"}\n",
         "f.csv:4:1: 2 does not ascend: 2 comes before it", 4, 20},
        {SYSTEM TABLE "files: {f.csv: \"t,M\\n0,1\\n1,\\xB5\"}\n",
         "f.csv:3:3: unexpected byte 0xc2; a table is plain ASCII", 4, 20},
        {SYSTEM "tables: {f: {file: f.csv, at: t, valu: M}}\n",
         "unknown key of a table 'valu'; did you mean 'value'?", 4, 34},
        {SYSTEM "tables: {f: {file: f.csv, at: t}}\n",
         "table f has no 'value'; it needs file, at and value", 4, 13},
        {SYSTEM "tables: {f: {file: f.csv, at: t, value: M, interpolation: cubi}}\n",
         "unknown interpolation 'cubi'; did you mean 'cubic'?", 4, 59},
        {SYSTEM "tables: {f: {file: f.csv, at: t, value: M, extend: linea}}\n",
         "unknown extension 'linea'; did you mean 'linear'?", 4, 52},
        {SYSTEM "tables: {f: {file: f.csv, at: t, value: M, interpolation: cubic}}\n"
                "files: {f.csv: \"t,M\\n0,1e308\\n1,-1e308\\n2,1e308\"}\n",
         "table f: its cubic spline overflows: points are too large, or too close", 4, 13},
        {SYSTEM TABLE "files: {f.csv: \"t,M\\n0,0\\n1e-300,1e10\"}\n",
         "table f: its slope overflows: points are too large, or too close", 4, 13},
        {SYSTEM "tables: {f: data.csv}\n", "a table is {file: data.csv, at: column, value: column}",
         4, 13},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dal_model *model = NULL;
        dal_error error = {0};
        CU_ASSERT(dal_model_read(&model, "f", cases[i].text, strlen(cases[i].text), &error));
        CU_ASSERT_PTR_NULL(model);
        if (strcmp(error.message, cases[i].message) || error.line != cases[i].line ||
            error.column != cases[i].column)
            printf("%d:%d: %s\n", error.line, error.column, error.message);
        CU_ASSERT_STRING_EQUAL(error.message, cases[i].message);
        CU_ASSERT(error.line == cases[i].line && error.column == cases[i].column);
    }
}

/* Of a head with more columns than a message compares, each can be chosen, and what is not there is
 * said. */
static void test_many_columns(void)
{
    enum { COLUMNS = 3000 };
    char *text = malloc(64 * COLUMNS), *end = text;
    CU_ASSERT_PTR_NOT_NULL_FATAL(text);
    for (int wanted = COLUMNS - 1; wanted <= COLUMNS; wanted++) {
        dal_model *model = NULL;
        dal_error error = {0};
        end =
            text + sprintf(text, SYSTEM "tables: {f: {file: f.csv, at: c0, value: c%d}}\n", wanted);
        end += sprintf(end, "files: {f.csv: \"c0");
        for (int i = 1; i < COLUMNS; i++) end += sprintf(end, ",c%d", i);
        for (int row = 0; row < 2; row++)
            for (int i = 0; i < COLUMNS; i++) end += sprintf(end, "%s%d", i ? "," : "\\n", row);
        sprintf(end, "\"}\n");
        const dal_status status = dal_model_read(&model, "f", text, strlen(text), &error);
        CU_ASSERT_EQUAL(status, wanted < COLUMNS ? DAL_STATUS_OK : DAL_STATUS_NAME);
        if (wanted == COLUMNS)
            CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "unknown column of 'f.csv' 'c3000'"));
        dal_model_free(model);
    }
    free(text);
}

/* One point more than the documented 100000. */
static void test_many_points(void)
{
    enum { MAX_POINTS = 100000 };
    char *text = malloc(16 * MAX_POINTS), *end = text;
    dal_model *model = NULL;
    dal_error error = {0};
    CU_ASSERT_PTR_NOT_NULL_FATAL(text);
    end += sprintf(end, SYSTEM TABLE "files: {f.csv: \"t,M");
    for (int i = 0; i <= MAX_POINTS; i++) end += sprintf(end, "\\n%d,0", i);
    sprintf(end, "\"}\n");
    CU_ASSERT_EQUAL(dal_model_read(&model, "f", text, strlen(text), &error), DAL_STATUS_SYNTAX);
    CU_ASSERT_STRING_EQUAL(error.message, "f.csv:100002:1: more than 100000 points");
    CU_ASSERT(error.line == 4 && error.column == 20);
    CU_ASSERT_PTR_NULL(model);
    free(text);
}

/* A text holds its files after it was read from a directory, in block, flow and indented form; what
 * it makes is the same. */
static void test_source(void)
{
    static const char *const texts[] = {
        "# a comment\ncoordinates: [x]\nlagrangian: x'^2/2\nforces: {x: f(t)}\n"
        "tables: {f: {file: ../examples/torque.csv, at: t, value: right}}\n",
        "{coordinates: [x], lagrangian: \"x'^2/2\", forces: {x: f(t)},\n"
        " tables: {f: {file: ../examples/torque.csv, at: t, value: right}}}\n",
        "  coordinates: [x]\n  lagrangian: x'^2/2\n  forces: {x: f(t)}\n"
        "  tables: {f: {file: ../examples/torque.csv, at: t, value: right}}\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        const char *path = "build/table-of-a-test.yaml";
        size_t length = 0;
        dal_model *model = NULL, *copy = NULL;
        const dal_system *system = NULL;
        FILE *file = fopen(path, "w");
        CU_ASSERT_PTR_NOT_NULL_FATAL(file);
        fputs(texts[i], file);
        fclose(file);
        CU_ASSERT_EQUAL(dal_model_read_file(&model, path, NULL), DAL_STATUS_OK);
        remove(path);
        const char *source = dal_model_source(model, &length);
        CU_ASSERT_PTR_NOT_NULL_FATAL(source);
        CU_ASSERT_EQUAL_FATAL(dal_model_read(&copy, "copy", source, length, NULL), DAL_STATUS_OK);
        CU_ASSERT_STRING_EQUAL(dal_model_source(copy, NULL), source);
        CU_ASSERT_EQUAL(dal_model_system(copy, &system, NULL), DAL_STATUS_OK);
        double F[1], q[1] = {0.0}, work[64] = {0.0};
        const dal_point at = {2.5, q, q, NULL, work, NULL};
        CU_ASSERT_FATAL(system->workspace <= 64);
        CU_ASSERT_EQUAL(system->prepare(system, &at, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(system->call.field(system, &at, F), DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(F[0], 0.6, 1e-15);
        dal_model_free(copy);
        dal_model_free(model);
    }
}

void suite_tables(void)
{
    CU_pSuite suite = CU_add_suite("tables", NULL, NULL);
    CU_add_test(suite, "straight lines", test_linear);
    CU_add_test(suite, "the natural spline", test_cubic);
    CU_add_test(suite, "splines without knots beside the ends", test_not_a_knot);
    CU_add_test(suite, "a spline near a sine", test_sine);
    CU_add_test(suite, "outside", test_extension);
    CU_add_test(suite, "a robot", test_robot);
    CU_add_test(suite, "errors", test_errors);
    CU_add_test(suite, "a head of many columns", test_many_columns);
    CU_add_test(suite, "too many points", test_many_points);
    CU_add_test(suite, "a text with its files", test_source);
}
