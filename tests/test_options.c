/* test_options.c - methods and options from text. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <string.h>

static void test_methods(void)
{
    dal_method method;
    dal_error error;
    char name[64];
    CU_ASSERT_EQUAL(dal_method_parse(&method, "symplectic-euler+project", &error), DAL_STATUS_OK);
    CU_ASSERT_STRING_EQUAL(dal_method_name(&method, name, sizeof name),
                           "symplectic-euler-10+project");
    CU_ASSERT_EQUAL(dal_method_order(&method), 1);
    CU_ASSERT_EQUAL(dal_method_properties(&method) & (DAL_SYMPLECTIC | DAL_SYMMETRIC), 0);
    CU_ASSERT(dal_method_properties(&method) & DAL_PRESERVES_D);
    CU_ASSERT_EQUAL(dal_method_parse(&method, "gaus8", &error), DAL_STATUS_NAME);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "'gauss8'"));
    CU_ASSERT_EQUAL(dal_method_parse(&method, "gauss8+projct", &error), DAL_STATUS_NAME);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "'project'"));
    CU_ASSERT_EQUAL(dal_method_parse(&method, "project", &error), DAL_STATUS_NAME);
    CU_ASSERT_EQUAL(dal_method_parse(&method, "rk4+rk4", &error), DAL_STATUS_NAME);
    CU_ASSERT_EQUAL(dal_method_parse(&method, "", &error), DAL_STATUS_NAME);
    CU_ASSERT_EQUAL(dal_method_parse(&method, "rk4+", &error), DAL_STATUS_NAME);
}

static void test_options(void)
{
    dal_options options = dal_options_default();
    dal_error error;
    CU_ASSERT_EQUAL(dal_options_set(&options, "step", "2.5e-3", &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(options.step, 2.5e-3);
    CU_ASSERT_EQUAL(dal_options_set(&options, "space", "physical", &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(options.space, DAL_PHYSICAL);
    CU_ASSERT_EQUAL(dal_options_set(&options, "iterations", "1e3", &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(options.iterations, 1000);
    const dal_options before = options;
    CU_ASSERT_EQUAL(dal_options_set(&options, "space", "phys", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_options_set(&options, "iterations", "1.5", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_options_set(&options, "iterations", "0", &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_options_set(&options, "step", "0x1p-3", &error), DAL_STATUS_SYNTAX);
    CU_ASSERT_EQUAL(dal_options_set(&options, "step", "nan", &error), DAL_STATUS_SYNTAX);
    CU_ASSERT_EQUAL(dal_options_set(&options, "stepp", "1", &error), DAL_STATUS_NAME);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "'step'"));
#define X(type, name, ...) CU_ASSERT_EQUAL(options.name, before.name);
    DAL_OPTION_LIST(X)
#undef X
}

void suite_options(void)
{
    CU_pSuite suite = CU_add_suite("options", NULL, NULL);
    CU_add_test(suite, "methods by name", test_methods);
    CU_add_test(suite, "options by name", test_options);
}
