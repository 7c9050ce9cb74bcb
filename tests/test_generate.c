/* test_generate.c - generated C files: what is refused, and that memory may run out anywhere.
 * That they compile and give the bits of a run is tested in tests/cli/generate_cases.sh. */
#include "allocation.h"
#include "core/buffer.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static dal_model *model;
static dal_run_spec spec;

static int set_up(void)
{
    dal_error error;
    spec = (dal_run_spec){.options = dal_options_default()};
    if (dal_model_builtin(&model, "chaplygin-sleigh", &error) != DAL_STATUS_OK) return 1;
    if (dal_model_system(model, &spec.system, &error) != DAL_STATUS_OK) return 1;
    return dal_method_parse(&spec.method, "gauss4+project", &error) != DAL_STATUS_OK;
}

static int tear_down(void)
{
    dal_model_free(model);
    return 0;
}

static dal_status generate(const dal_run_spec *of, int lanes, const char *prefix, dal_error *error)
{
    char *text;
    const dal_generate_options options = {.lanes = lanes, .prefix = prefix};
    dal_status status = dal_generate(of, &options, &text, error);
    CU_ASSERT_EQUAL(text == NULL, status != DAL_STATUS_OK);
    free(text);
    return status;
}

static void test_refusals(void)
{
    dal_error error;
    dal_system by_hand = *spec.system;
    by_hand.prepare = NULL;
    dal_integrator own = *spec.method.layer[0];
    dal_run_spec other = spec;
    CU_ASSERT_EQUAL(generate(&spec, 3, NULL, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 32, NULL, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 1, "", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 1, "a b", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 1, "_a", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 1, "9a", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 1, "a;b", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 1, "dal", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 1, "DAL_", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(generate(&spec, 1, "dalton", &error), DAL_STATUS_OK);
    other.system = &by_hand;
    CU_ASSERT_EQUAL(generate(&other, 1, NULL, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "chaplygin-sleigh"));
    CU_ASSERT(error.line == 0 && error.column == 0);
    other = spec;
    other.method.layer[0] = &own;
    CU_ASSERT_EQUAL(generate(&other, 1, NULL, &error), DAL_STATUS_UNSUPPORTED);
    other = spec;
    other.method.layer[2] = other.method.layer[1];
    CU_ASSERT_EQUAL(generate(&other, 1, NULL, &error), DAL_STATUS_UNSUPPORTED);
    other = spec;
    CU_ASSERT_EQUAL(dal_method_parse(&other.method, "gni", NULL), DAL_STATUS_OK);
    other.options.space = DAL_PHYSICAL;
    other.options.reactions = true;
    CU_ASSERT_EQUAL(generate(&other, 1, NULL, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_STRING_EQUAL(error.message,
                           "the multipliers lambda1.. of gni are not observed in generated code");
    other = spec;
    other.parameters = &(dal_setting){"nothing", 1.0};
    other.parameter_count = 1;
    CU_ASSERT_EQUAL(generate(&other, 1, NULL, &error), DAL_STATUS_NAME);
    other = spec;
    other.start_time = NAN;
    CU_ASSERT_EQUAL(generate(&other, 1, NULL, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message, "the time of the start must be finite; it is nan");
}

/* Every integrator of the library must be found again in the texts it carries. */
static void test_every_method(void)
{
    dal_error error;
    for (int i = 0; dal_integrator_at(i); i++) {
        char name[64];
        dal_run_spec other = spec;
        fixture_method(i, name, sizeof name);
        CU_ASSERT_EQUAL(dal_method_parse(&other.method, name, NULL), DAL_STATUS_OK);
        if (dal_method_needs(&other.method) & DAL_NEEDS_BLOCKS) other.options.space = DAL_PHYSICAL;
        const bool serves = fixture_accepts(&other.method, spec.system, other.options.space);
        CU_ASSERT_EQUAL(generate(&other, 8, NULL, &error),
                        serves ? DAL_STATUS_OK : DAL_STATUS_UNSUPPORTED);
    }
}

/* What rk4 does not use of the kernel is not in its file. */
static void test_length(void)
{
    enum { MAX_LINES = 950 };
    dal_run_spec rk4 = spec;
    char *text = NULL;
    int lines = 0;
    CU_ASSERT_EQUAL(dal_method_parse(&rk4.method, "rk4", NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_generate(&rk4, NULL, &text, NULL), DAL_STATUS_OK);
    for (const char *c = text; *c; c++) lines += *c == '\n';
    CU_ASSERT(lines <= MAX_LINES);
    CU_ASSERT_PTR_NULL(strstr(text, "dal_solve"));
    CU_ASSERT_PTR_NULL(strstr(text, "dal_invert"));
    free(text);
}

/* Single lanes take norms of many stages and components in packs, of few in loops. */
static void test_packs(void)
{
    static const struct {
        const char *system, *method;
        int lanes;
        bool packs;
    } cases[] = {{"chaplygin-sleigh", "gauss4", 1, false},
                 {"chaplygin-sleigh", "gauss12", 1, true},
                 {"chaplygin-sleigh", "gauss12", 8, false},
                 {"chaplygin-sleigh", "rk4", 1, false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const dal_run_spec other =
            fixture_spec(fixture_system(cases[k].system), cases[k].method, DAL_PHYSICAL, 0.01);
        const dal_generate_options options = {.lanes = cases[k].lanes};
        char *text = NULL;
        CU_ASSERT_EQUAL_FATAL(dal_generate(&other, &options, &text, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(strstr(text, "dal__pack_max(dal__pack") != NULL, cases[k].packs);
        free(text);
    }
}

/* A Jacobian of 700 coordinates does not fit on the stack; without functions of a point the file is
 * made. */
static void test_large_jacobian(void)
{
    const dal_generate_options with = {.with_field = true};
    dal_model *large = dal_model_create("large");
    dal_run_spec other = spec;
    dal_error error;
    char *text = NULL;
    CU_ASSERT_EQUAL(dal_model_add(large, DAL_SECTION_SIZES, "N", "700", 1, 1, &error), 0);
    CU_ASSERT_EQUAL(dal_model_add(large, DAL_SECTION_COORDINATES, NULL, "x[1..N]", 1, 1, &error),
                    0);
    CU_ASSERT_EQUAL(dal_model_add(large, DAL_SECTION_LAGRANGIAN, NULL,
                                  "sum(i, 1, N, x[i]'^2 - x[i]^2)/2", 1, 1, &error),
                    0);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(large, &other.system, &error), DAL_STATUS_OK);
    other.options.space = DAL_PHYSICAL;
    CU_ASSERT_EQUAL(dal_method_parse(&other.method, "rk4", NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_generate(&other, &with, &text, &error), DAL_STATUS_TOO_LARGE);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "Jacobian"));
    CU_ASSERT_PTR_NULL(text);
    CU_ASSERT_EQUAL(dal_generate(&other, NULL, &text, &error), DAL_STATUS_OK);
    free(text);
    dal_model_free(large);
}

/* Whatever a file, and so a system, is called: the names in the text are C. */
static void test_unusual_names(void)
{
    static const char *const unusual[] = {"3body",    "dal", "DAL_", "_x", "a b;system(\"x\")",
                                          "*/ int x;"};
    dal_error error;
    for (size_t i = 0; i < sizeof unusual / sizeof *unusual; i++) {
        dal_system other = *spec.system;
        dal_run_spec with = spec;
        char *text = NULL;
        other.name = unusual[i];
        other.title = NULL;
        with.system = &other;
        CU_ASSERT_EQUAL(dal_generate(&with, NULL, &text, &error), DAL_STATUS_OK);
        if (!text) continue;
        const char *name = strstr(text, "typedef struct ") + strlen("typedef struct ");
        const size_t length = strspn(name, "abcdefghijklmnopqrstuvwxyzADL0123456789_");
        CU_ASSERT(name[0] >= 'a' && name[0] <= 'z' && strncmp(name, "dal_", 4) != 0);
        CU_ASSERT_EQUAL(strncmp(name + length, " {", 2), 0);
        free(text);
    }
}

/* Each function of a point has its callback: among the codes, and where these are evaluated. */
static void test_points(void)
{
    static const char *const codes[] = {"FIELD", "JACOBIAN", "CONSTRAINT", "ENERGY_NORMAL"};
    const dal_run_spec rk4 =
        fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_PHYSICAL, 0.1);
    const dal_generate_options with = {.with_field = true};
    char *text = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_generate(&rk4, &with, &text, NULL), DAL_STATUS_OK);
    for (int i = 0; i < 4; i++) {
        static const char *const forms[] = {" DAL_EVAL_%s,", "case DAL_EVAL_%s: ", ", %s, "};
        for (int k = 0; k < 3; k++) {
            char wanted[64];
            snprintf(wanted, sizeof wanted, forms[k], codes[i]);
            CU_ASSERT_PTR_NOT_NULL(strstr(text, wanted));
        }
    }
    free(text);
}

/* Keywords of C and C++, and names that its headers may define, are no members. */
static void test_reserved_members(void)
{
    static const char *const reserved[] = {"double", "template", "wchar_t", "INT_x", "M_PI"};
    static const char *const usual[] = {"m", "M", "dal_x", "INDEX", "double_2"};
    for (int i = 0; i < 5; i++) {
        char yaml[256], member[64], *text = NULL;
        snprintf(yaml, sizeof yaml,
                 "coordinates: [x]\nparameters: {%s: 2, %s: 3}\n"
                 "lagrangian: x'^2/2 - %s*x^2 - %s*x\n",
                 reserved[i], usual[i], reserved[i], usual[i]);
        const dal_run_spec named = fixture_spec(fixture_system(yaml), "rk4", DAL_PHYSICAL, 0.1);
        CU_ASSERT_EQUAL_FATAL(dal_generate(&named, NULL, &text, NULL), DAL_STATUS_OK);
        snprintf(member, sizeof member, "    double %s;\n", reserved[i]);
        CU_ASSERT_PTR_NULL(strstr(text, member));
        snprintf(member, sizeof member, "    double %s_parameter_1;\n", reserved[i]);
        CU_ASSERT_PTR_NOT_NULL(strstr(text, member));
        snprintf(member, sizeof member, "    double %s;\n", usual[i]);
        CU_ASSERT_PTR_NOT_NULL(strstr(text, member));
        free(text);
    }
}

static void test_memory(void)
{
    dal_error error;
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        allocation_start(&trial);
        allocation_end(&trial, generate(&spec, 1, NULL, &error));
    }
}

/* A number must come back with its bits from what strtod, or a C compiler, makes of its text. */
static void test_numbers(void)
{
    const double number[] = {0.0, 1.0, 0.1, 1e-13, 4e15, 1e300, 0x1p-1074, 0x1.fffffffffffffp1023};
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
        dal__buffer text = {0};
        dal__buffer_number(&text, number[i]);
        CU_ASSERT_EQUAL(strtod(text.bytes, NULL), number[i]);
        dal__buffer_free(&text);
        dal__buffer_number(&text, -number[i] - 1.0);
        CU_ASSERT_EQUAL(text.bytes[0], '(');
        CU_ASSERT_EQUAL(strtod(text.bytes + 1, NULL), -number[i] - 1.0);
        dal__buffer_free(&text);
    }
}

void suite_generate(void);
void suite_generate(void)
{
    CU_pSuite suite = CU_add_suite("generate", set_up, tear_down);
    CU_add_test(suite, "what cannot be generated is refused", test_refusals);
    CU_add_test(suite, "every integrator", test_every_method);
    CU_add_test(suite, "a file has what it needs", test_length);
    CU_add_test(suite, "norms in packs", test_packs);
    CU_add_test(suite, "a Jacobian that is too large", test_large_jacobian);
    CU_add_test(suite, "systems with unusual names", test_unusual_names);
    CU_add_test(suite, "functions of a point", test_points);
    CU_add_test(suite, "parameters with names of C", test_reserved_members);
    CU_add_test(suite, "memory runs out", test_memory);
    CU_add_test(suite, "numbers keep their bits", test_numbers);
}
