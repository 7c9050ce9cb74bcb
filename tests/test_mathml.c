/* test_mathml.c - formulas as MathML, with the elements that its standard has for them: operands of
 * fractions, roots, scripts and accents are one element each, brackets are fenced rows that grow
 * with a fraction, and cases are a table. */
#include "dalembert_codegen.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define I(letter)                "<mi>" letter "</mi>"
#define N(number)                "<mn>" number "</mn>"
#define O(sign)                  "<mo>" sign "</mo>"
#define ROW                      "<mrow>"
#define END                      "</mrow>"
#define SUP(a, b)                "<msup>" a b "</msup>"
#define SUB(a, b)                "<msub>" a b "</msub>"
#define SUBSUP(a, b, c)          "<msubsup>" a b c "</msubsup>"
#define FRAC(a, b)               "<mfrac>" a b "</mfrac>"
#define SMALL(a, b)              "<mfrac displaystyle=\"false\">" a b "</mfrac>"
#define ROOT(a)                  "<msqrt>" a "</msqrt>"
#define DOT(a)                   "<mover accent=\"true\">" a "<mo>&#x2D9;</mo></mover>"
#define FENCE(form, grows, sign) "<mo form=\"" form "\" stretchy=\"" grows "\">" sign "</mo>"
#define FENCED(grows, a, left, right)                                                              \
    ROW FENCE("prefix", grows, left)                                                               \
    a FENCE("postfix", grows, right) END
#define IN_BRACKETS(a) FENCED("false", a, "(", ")")
#define IN_HIGH(a)     FENCED("true", a, "(", ")")
#define CELL(a)        "<mtd style=\"text-align:-webkit-left\">" a "</mtd>"
#define MINUS          O("&#x2212;")
#define TIMES          "<mo lspace=\"0\" rspace=\"0.17em\">&#x2062;</mo>"
#define OF             O("&#x2061;")
#define X              I("x")
#define Y              I("y")

static const struct {
    const char *formula, *elements;
} rows[] = {
    {"x + y", X O("+") Y},
    {"x^2 + y^2", SUP(X, N("2")) O("+") SUP(Y, N("2"))},
    {"x^(1 + y)", SUP(X, ROW N("1") O("+") Y END)},
    {"x1^2", SUBSUP(X, N("1"), N("2"))},
    {"x1'", SUB(DOT(X), N("1"))},
    {"x/y", FRAC(X, Y)},
    {"x/(x + y)", FRAC(X, ROW X O("+") Y END)},
    {"x/2", SMALL(N("1"), N("2")) TIMES X},
    {"sqrt(x + y)", ROOT(ROW X O("+") Y END)},
    {"x*(x - y)", X TIMES IN_BRACKETS(X MINUS Y)},
    {"(x - y)*(x + x1)", IN_BRACKETS(X MINUS Y) TIMES IN_BRACKETS(X O("+") SUB(X, N("1")))},
    {"(x - y)^2", SUP(IN_BRACKETS(X MINUS Y), N("2"))},
    {"x*(y + 1/x)", X TIMES IN_HIGH(Y O("+") FRAC(N("1"), X))},
    {"abs(x)*y", FENCED("false", X, "|", "|") TIMES Y},
    {"floor(x/y)", FENCED("true", FRAC(X, Y), "&#x230A;", "&#x230B;")},
    {"sin(x)*y", I("sin") OF IN_BRACKETS(X) TIMES Y},
    {"sign(x)*m_ball", I("sign") OF IN_BRACKETS(X) TIMES SUB(I("m"), I("ball"))},
    {"if(x < y, x, 2)", ROW "<mo form=\"prefix\">{</mo><mtable columnalign=\"left\"><mtr>" CELL(X)
                            CELL("<mtext>if </mtext>" X O("&lt;") Y) "</mtr><mtr>" CELL(N("2"))
                                CELL("<mtext>else</mtext>") "</mtr></mtable>" END},
};

/* Each is the right side of its row. */
static void test_rows(void)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char yaml[512], expected[1024], *text = NULL;
        snprintf(yaml, sizeof yaml,
                 "coordinates: [x, y, x1]\nparameters: {m_ball: 2}\n"
                 "accelerations: {x: \"%s\", y: 0, x1: 0}\nstart: {x: 1}\n",
                 rows[i].formula);
        snprintf(expected, sizeof expected,
                 "<mtd style=\"text-align:-webkit-left\"><mo>=</mo>%s</mtd></mtr>",
                 rows[i].elements);
        dal_model *model = fixture_model(yaml);
        CU_ASSERT_EQUAL_FATAL(dal_model_mathml(model, &text, NULL), DAL_STATUS_OK);
        CU_ASSERT_PTR_NOT_NULL(strstr(text, expected));
        if (!strstr(text, expected))
            printf("\n  %s: no %s in\n%s", rows[i].formula, expected, text);
        free(text);
        dal_model_free(model);
    }
}

void suite_mathml(void)
{
    CU_pSuite suite = CU_add_suite("mathml", NULL, NULL);
    CU_add_test(suite, "the elements of formulas", test_rows);
}
