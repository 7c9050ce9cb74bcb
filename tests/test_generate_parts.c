/* test_generate_parts.c - the parts of the kernel that descriptors declare.  Each integrator
 * compiles with these alone, so none is missing, and without one of them it does not, so none is
 * superfluous.  And the conditions that their sources have. */
#include "codegen/generate.h"
#include "codegen/parts.h"
#include "codegen/preprocessor.h"
#include "compiler.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool compiles;

static int set_up(void)
{
    compiles = compiler_there();
    return 0;
}

/* Whether a compiler accepts the steps. */
static bool accepts(const char *text)
{
    FILE *compiler = popen("cc -std=gnu11 -Werror=implicit-function-declaration -fsyntax-only "
                           "-x c - 2>/dev/null",
                           "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(compiler);
    fputs("#include <math.h>\n#include <stdbool.h>\n#include <stddef.h>\n#include <stdint.h>\n"
          "#include <string.h>\n",
          compiler);
    fputs(text, compiler);
    return pclose(compiler) == 0;
}

/* A system on which the integrator, or the modifier, can act. */
static const char *system_for(const dal_integrator *integrator)
{
    return integrator->needs & DAL_NEEDS_ISOKINETIC ? "isokinetic-cluster" : "chaplygin-sleigh";
}

/* Writes the steps with these parts and those that they use.  A modifier is around rk4, which
 * uses none, whether it suits it or not. */
static bool accepts_with(int number, unsigned parts, int lanes, dal_space space)
{
    const dal_integrator *integrator = dal_integrator_at(number);
    char name[64], *text = NULL;
    const dal_system *system = fixture_system(system_for(integrator));
    if (integrator->needs & (DAL_NEEDS_BLOCKS | DAL_NEEDS_ISOKINETIC)) space = DAL_PHYSICAL;
    dal_run_spec spec =
        fixture_spec(system, fixture_method(number, name, sizeof name), space, 0.01);
    if (integrator->properties & DAL_ADAPTIVE && !(integrator->properties & DAL_MODIFIER))
        spec.options.tolerance = 1e-9;
    dal__generation g = {.spec = &spec, .lanes = lanes, .product = DAL__PRODUCT_LANES};
    CU_ASSERT_EQUAL_FATAL(dal__generation_check(&g, "steps", NULL), DAL_STATUS_OK);
    if (integrator->properties & DAL_MODIFIER) {
        dal_method rk4;
        CU_ASSERT_EQUAL_FATAL(dal_method_parse(&rk4, "rk4", NULL), DAL_STATUS_OK);
        g.layout.method.layer[0] = rk4.layer[0];
        dal__find_source(rk4.layer[0], &g.identifier[0], &g.source[0]);
    }
    g.kernel = dal__kernel_closure(parts);
    dal__write_steps(&g);
    CU_ASSERT_EQUAL_FATAL(dal__generation_finish(&g, &text, NULL), DAL_STATUS_OK);
    const bool accepted = accepts(text);
    free(text);
    return accepted;
}

/* The compiler reads the same files under valgrind and the sanitizers: a quick run has some. */
static void test_parts(void)
{
    for (int i = 0; compiles && dal_integrator_at(i); i += case_stride(8)) {
        const dal_integrator *integrator = dal_integrator_at(i);
        const unsigned parts = integrator->kernel;
        for (int way = 0; way < 4; way++) {
            const int lanes = way & 1 ? 8 : 1;
            if (accepts_with(i, parts, lanes, way & 2 ? DAL_PHYSICAL : DAL_LIFTED)) continue;
            printf("\n  %s, %d lanes: lacks a part\n", integrator->name, lanes);
            CU_FAIL("a part of the kernel is missing");
        }
        for (unsigned part = 1; part <= parts; part <<= 1)
            if (parts & part && accepts_with(i, parts & ~part, 1, DAL_LIFTED)) {
                printf("\n  %s: part %#x is superfluous\n", integrator->name, part);
                CU_FAIL("a part of the kernel is superfluous");
            }
    }
}

/* A directive with DAL_WITH that the preprocessor leaves to the compiler, be it that no condition
 * has the name or that the test has another form, would be 1 in the library, and an error in
 * generated files alone. */
static void check_directive(dal__generation *g, const char *file, const char *line)
{
    const int length = (int)strcspn(line, "\n");
    char chain[256];
    const bool follows = strncmp(line, "#elif", 5) == 0;
    snprintf(chain, sizeof chain, "%s%.*s\n#endif\n", follows ? "#ifdef DAL_NUM_QUAD\n" : "",
             length, line);
    g->text.length = 0;
    dal__preprocess(g, chain);
    if (g->text.length == 0) return;
    printf("\n  %s: %.*s is not decided\n", file, length, line);
    CU_FAIL("a condition that the preprocessor does not decide");
}

/* Notes which conditions a source has. */
static void check_source(dal__generation *g, const dal__source *source, bool *used)
{
    for (const char *line = source->text, *end; *line; line = end + (*end == '\n')) {
        char directive[128];
        end = line + strcspn(line, "\n");
        if (strncmp(line, "#if", 3) != 0 && strncmp(line, "#elif", 5) != 0) continue;
        snprintf(directive, sizeof directive, "%.*s", (int)(end - line), line);
        for (int i = 0; i < g->conditions; i++)
            used[i] |= strstr(directive, g->condition[i].name) != NULL;
        if (strstr(directive, "DAL_WITH(")) check_directive(g, source->name, line);
    }
}

/* A generation whose conditions are decided. */
static dal__generation decided(const dal_run_spec *spec)
{
    dal__generation g = {.spec = spec, .lanes = 1, .product = DAL__PRODUCT_LANES};
    CU_ASSERT_EQUAL_FATAL(dal__generation_check(&g, "steps", NULL), DAL_STATUS_OK);
    dal__decide_conditions(&g);
    return g;
}

/* What the grammar of conditions knows is decided, and all else is left to the compiler. */
static void test_chains(void)
{
    static const struct {
        const char *text, *left; /* NULL: the same */
    } cases[] = {
        {"#if DAL_NUM_QUAD\na\n#else\nb\n#endif\n", "b\n"},
        {"#ifdef DAL_SPECIALISED\na\n#else\nb\n#endif\n", "a\n"},
        {"#ifndef DAL_NUM_QUAD\na\n#endif\n", "a\n"},
        {"#if DAL_SPECIALISED && !DAL_NUM_QUAD\na\n#endif\n", "a\n"},
        {"#if DAL_SPECIALISED && DAL_NUM_QUAD\na\n#endif\nb\n", "b\n"},
        {"#if DAL_NUM_QUAD\na\n#elif OTHER\nb\n#endif\n", "#if OTHER\nb\n#endif\n"},
        {"#ifdef OTHER\na\n#endif\n", NULL},
        {"#if OTHER\na\n#else\nb\n#endif\n", NULL},
        {"#if DAL_NUM_QUAD && OTHER\na\n#endif\n", NULL},
        {"#if OTHER && DAL_NUM_QUAD\na\n#endif\n", NULL},
        {"#if DAL_NUM_QUAD || OTHER\na\n#endif\n", NULL},
        {"#if DAL_NUM_QUAD > 0\na\n#endif\n", NULL},
        {"#define PREFIX_N 1\n", "#define steps_N 1\n"},
    };
    char name[64];
    const dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh"),
                                           fixture_method(0, name, sizeof name), DAL_LIFTED, 0.01);
    dal__generation g = decided(&spec);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dal__buffer_free(&g.text);
        g.text = (dal__buffer){0};
        dal__preprocess(&g, cases[i].text);
        const char *const left = cases[i].left ? cases[i].left : cases[i].text;
        CU_ASSERT_FATAL(g.text.length == strlen(left));
        CU_ASSERT(memcmp(g.text.bytes, left, g.text.length) == 0);
    }
    dal__buffer_free(&g.text);
}

static void test_conditions(void)
{
    char name[64];
    dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh"),
                                     fixture_method(0, name, sizeof name), DAL_LIFTED, 0.01);
    dal__generation g = decided(&spec);
    bool used[DAL__MAX_CONDITIONS] = {false};
    for (const dal__source *source = dal__sources; source->name; source++)
        check_source(&g, source, used);
    for (int i = 0; i < g.conditions; i++) {
        if (used[i]) continue;
        printf("\n  no source has %s\n", g.condition[i].name);
        CU_FAIL("a condition that no source has");
    }
    dal__buffer_free(&g.text);
}

void suite_generate_parts(void);
void suite_generate_parts(void)
{
    CU_pSuite suite = CU_add_suite("generate parts", set_up, NULL);
    CU_add_test(suite, "integrators compile with what they declare", test_parts);
    CU_add_test(suite, "conditions that are decided, and others", test_chains);
    CU_add_test(suite, "conditions in sources are decided, and no others", test_conditions);
}
