/* test_model_hand.c - models made entry by entry, and what is refused of them. */
#include "fixtures.h"
#include <CUnit/Basic.h>
#include <dalembert.h>
#include <stdio.h>
#include <string.h>

static void test_add(void)
{
    dal_model *model = dal_model_create("hand");
    const dal_system *system;
    dal_error error;
    CU_ASSERT(dal_model_add(model, DAL_SECTION_FORCES, NULL, "1", 3, 4, &error) ==
              DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message, "an entry of forces has a name and a text");
    CU_ASSERT(dal_model_add(model, DAL_SECTION_TAGS, "a", "b", 3, 4, &error) ==
              DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message, "an entry of tags has a text and no name");
    CU_ASSERT(dal_model_add(model, DAL_SECTION_LAGRANGIAN, NULL, "x'^2/", 0, 0, NULL) ==
              DAL_STATUS_OK);
    CU_ASSERT(dal_model_add(model, DAL_SECTION_LAGRANGIAN, NULL, "1", 0, 0, &error) ==
              DAL_STATUS_MODEL);
    CU_ASSERT_STRING_EQUAL(error.message, "duplicate lagrangian");
    CU_ASSERT(dal_model_add(model, DAL_SECTION_COORDINATES, NULL, "x", 0, 0, NULL) ==
              DAL_STATUS_OK);
    CU_ASSERT(dal_model_system(model, &system, &error) == DAL_STATUS_SYNTAX);
    CU_ASSERT(error.line == 1 && error.column > 1); /* within the text itself */
    dal_model_free(model);
    dal_model_free(NULL);
}

static void test_add_after(void)
{
    dal_model *model;
    const dal_system *system;
    dal_error error;
    CU_ASSERT_FATAL(dal_model_builtin(&model, "damped-oscillator", &error) == DAL_STATUS_OK);
    CU_ASSERT(dal_model_system(model, &system, &error) == DAL_STATUS_OK);
    CU_ASSERT(dal_model_add(model, DAL_SECTION_TAGS, NULL, "b", 0, 0, &error) ==
              DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message,
                           "'damped-oscillator' already has its system: nothing can be added");
    dal_model_free(model);
}

static void test_vakonomic_tangent(void)
{
    dal_model *model;
    const dal_system *system;
    dal_error error;
    CU_ASSERT_FATAL(dal_model_builtin(&model, "chaplygin-sleigh-vakonomic", &error) ==
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_tangent(model, &system, &error), DAL_STATUS_OK);
    CU_ASSERT(system->n == 6 && system->m == 0 && system->multipliers == 2);
    dal_model_free(model);
}

static void test_add_reactions(void)
{
    dal_model *model = dal_model_create("hand");
    const char *const bad[] = {"x", "0.x", ".x", "1x", "999999999999.x"};
    const dal_system *system;
    dal_error error;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        char message[128];
        snprintf(message, sizeof message,
                 "'%s' in reactions is not a constraint and a coordinate, as 1.x", bad[k]);
        CU_ASSERT(dal_model_add(model, DAL_SECTION_REACTIONS, bad[k], "1", 3, 4, &error) ==
                  DAL_STATUS_NAME);
        CU_ASSERT_STRING_EQUAL(error.message, message);
    }
    dal_model_add(model, DAL_SECTION_COORDINATES, NULL, "x", 0, 0, NULL);
    dal_model_add(model, DAL_SECTION_COORDINATES, NULL, "y", 0, 0, NULL);
    dal_model_add(model, DAL_SECTION_LAGRANGIAN, NULL, "(x'^2 + y'^2)/2 - x", 0, 0, NULL);
    dal_model_add(model, DAL_SECTION_CONSTRAINTS, NULL, "x' - y", 0, 0, NULL);
    dal_model_add(model, DAL_SECTION_CONSTRAINTS, NULL, "y' - x", 0, 0, NULL);
    CU_ASSERT(dal_model_add(model, DAL_SECTION_REACTIONS, "2.x", "1", 0, 0, NULL) == DAL_STATUS_OK);
    CU_ASSERT(dal_model_system(model, &system, &error) == DAL_STATUS_MODEL);
    CU_ASSERT_STRING_EQUAL(error.message,
                           "constraint 1 has no reaction: the list needs one for each");
    CU_ASSERT(dal_model_add(model, DAL_SECTION_REACTIONS, "1.y", "1", 0, 0, NULL) == DAL_STATUS_OK);
    CU_ASSERT(dal_model_system(model, &system, &error) == DAL_STATUS_OK);
    CU_ASSERT(system->properties & DAL_SERVO);
    dal_model_free(model);
}

/* What is observed is a formula, whose brackets are no range. */
static void test_observed(void)
{
    static const char text[] = "coordinates: ['x[1..2]']\nlagrangian: (x1'^2 + x2'^2)/2\n";
    const char *name = text;
    int line = 0, column = 0;
    dal_error error = {0};
    const dal_system *system;
    dal_model *model = fixture_model(text);
    CU_ASSERT_STRING_EQUAL(dal_model_text(model, DAL_SECTION_COORDINATES, 0, &name, &line, &column),
                           "x[1..2]");
    CU_ASSERT(name == NULL && line == 1 && column == 16);
    CU_ASSERT_PTR_NULL(dal_model_text(model, DAL_SECTION_COORDINATES, 1, NULL, NULL, NULL));
    CU_ASSERT_EQUAL(dal_model_observe(model, "x[2]^2", 0, 0, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(system->observed, 1);
    CU_ASSERT_STRING_EQUAL(system->invariant[0], "x[2]^2");
    dal_model_free(model);
    model = fixture_model(text);
    CU_ASSERT_EQUAL(dal_model_observe(model, "x1 + u", 0, 0, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_system(model, &system, &error), DAL_STATUS_NAME);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "unknown name 'u'"));
    dal_model_free(model);
}

void suite_model_hand(void)
{
    CU_pSuite suite = CU_add_suite("models by hand", NULL, NULL);
    CU_add_test(suite, "entries", test_add);
    CU_add_test(suite, "no entries after the system", test_add_after);
    CU_add_test(suite, "no tangent of vakonomic motion", test_vakonomic_tangent);
    CU_add_test(suite, "reactions", test_add_reactions);
    CU_add_test(suite, "observed formulas", test_observed);
}
