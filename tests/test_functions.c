/* test_functions.c - what a system file defines for its own formulas: functions. */
#include "reference.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define XY "coordinates: [x, y]\nparameters: {a: 0.7, b: 2}\n"

/* F at a point of two systems. */
static double field_difference(const char *one, const char *other)
{
    const double q[] = {0.3, -0.8}, v[] = {1.1, 0.4};
    double F[2][2];
    const char *const texts[] = {one, other};
    for (int k = 0; k < 2; k++) {
        reference b = reference_of_text(texts[k]);
        CU_ASSERT_EQUAL(reference_call(&b, b.system->call.field, 0.6, q, v, F[k]), DAL_OK);
        reference_free(&b);
    }
    return fmax(fabs(F[0][0] - F[1][0]), fabs(F[0][1] - F[1][1]));
}

/* Every call stands for its formula: with numbers, parameters and functions as arguments, and with
 * arguments that have the names of parameters, of t or of coordinates. */
static void test_calls(void)
{
    static const char *const cases[][2] = {
        {"functions: {V(r): a*r^2}\nforces: {x: V(x) + V(2*y')*V(3)}",
         "forces: {x: a*x^2 + 4*a*y'^2*9*a}"},
        {"functions: {\"f(r, n)\": r^n/a}\nforces: {x: \"f(y, 3) + f(b, x)\"}",
         "forces: {x: y^3/a + b^x/a}"},
        {"functions: {\"f(a, t)\": a/t}\nforces: {x: \"f(x, y)*a + t\"}", "forces: {x: x/y*a + t}"},
        {"functions: {\"f(x, y)\": x - 2*y}\nforces: {x: \"f(y, x)\"}", "forces: {x: y - 2*x}"},
        {"functions: {f(r): sin(r), g(r): f(r)^2 + f(2*r)}\nlet: {c: g(x)}\nforces: {x: c*g(g(y))}",
         "let: {c: sin(x)^2 + sin(2*x), d: sin(y)^2 + sin(2*y)}\n"
         "forces: {x: c*(sin(d)^2 + sin(2*d))}"},
        {"functions: {max(r): r + 1}\nforces: {x: max(x)}", "forces: {x: x + 1}"},
        {"functions: {V(r): \"if(r > 0, sqrt(r), -r)\"}\nforces: {x: V(x) + V(y)}",
         "forces: {x: sqrt(x) - y}"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[2][512];
        for (int k = 0; k < 2; k++) {
            strcpy(text[k], XY "lagrangian: (x'^2 + y'^2)/2\n");
            strcat(strcat(text[k], cases[i][k]), "\n");
        }
        CU_ASSERT(field_difference(text[0], text[1]) < 4e-15);
    }
    CU_ASSERT(field_difference(XY "functions: {V(r): r^4 + a*r}\n"
                                  "lagrangian: (x'^2 + y'^2)/2 - V(x - y)\n",
                               XY "lagrangian: (x'^2 + y'^2)/2 - (x - y)^4 - a*(x - y)\n") < 4e-15);
    CU_ASSERT(field_difference(XY "functions: {V(r): r}\nlagrangian: (x'^2 + y'^2)/2 - V(x)\n",
                               XY "lagrangian: (x'^2 + y'^2)/2 - y\n") > 0.1);
}

/* A function that calls the one before it twice, many times over, stays small. */
static void test_nesting(void)
{
    char text[4096] = "coordinates: [x]\nlagrangian: x'^2/2\nfunctions:\n  f0(r): r/2\n", line[64];
    for (int i = 1; i < 60; i++) {
        snprintf(line, sizeof line, "  f%d(r): f%d(r)/2 + f%d(r)/2\n", i, i - 1, i - 1);
        strcat(text, line);
    }
    reference b = reference_of_text(strcat(text, "forces: {x: f59(x)}\n"));
    const double q = 3.0, v = 0.0;
    double F = 0.0;
    CU_ASSERT_EQUAL(reference_call(&b, b.system->call.field, 0.0, &q, &v, &F), DAL_OK);
    CU_ASSERT_DOUBLE_EQUAL(F, 1.5, 1e-15);
    reference_free(&b);
}

void suite_functions(void)
{
    CU_pSuite suite = CU_add_suite("functions", NULL, NULL);
    CU_add_test(suite, "calls", test_calls);
    CU_add_test(suite, "calls of calls", test_nesting);
}
