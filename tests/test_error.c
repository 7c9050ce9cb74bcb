/* test_error.c - statuses, error records, the nearest name. */
#include "core/error.h"
#include "dalembert.h"
#include "dalembert_program.h"

#include <CUnit/Basic.h>
#include <stdio.h>
#include <string.h>

static void test_every_status_has_its_words(void)
{
    CU_ASSERT_STRING_EQUAL(dal_status_name(DAL_STATUS_SINGULAR), "DAL_SINGULAR");
    CU_ASSERT_STRING_EQUAL(dal_status_text(DAL_STATUS_SINGULAR), "a constraint became singular");
    for (int i = 0; i < DAL_STATUS_COUNT; i++)
        for (int j = 0; j < i; j++) {
            dal_status a = (dal_status)i, b = (dal_status)j;
            CU_ASSERT(strcmp(dal_status_name(a), dal_status_name(b)) != 0);
            CU_ASSERT(strcmp(dal_status_text(a), dal_status_text(b)) != 0);
        }
    CU_ASSERT_STRING_EQUAL(dal_status_name(DAL_STATUS_COUNT), "DAL_?");
    CU_ASSERT_STRING_EQUAL(dal_status_text((dal_status)-1), "unknown status");
}

static void test_version_text_has_the_numbers(void)
{
    char text[32];
    snprintf(text, sizeof text, "%d.%d.%d", DAL_VERSION_MAJOR, DAL_VERSION_MINOR,
             DAL_VERSION_PATCH);
    CU_ASSERT_STRING_EQUAL(DAL_VERSION, text);
}

static void test_record(void)
{
    dal_error error;
    CU_ASSERT(dal__fail_at(&error, DAL_STATUS_RANK, 3, 7, "a%s%d", "\nb\x7f", 5) ==
              DAL_STATUS_RANK);
    CU_ASSERT(error.status == DAL_STATUS_RANK && error.line == 3 && error.column == 7);
    CU_ASSERT_STRING_EQUAL(error.message, "a?b?5");
    CU_ASSERT(dal__fail_at(NULL, DAL_STATUS_IO, 3, 7, "unheard") == DAL_STATUS_IO);
}

static void test_record_without_a_place(void)
{
    dal_error error = {.line = 3, .column = 7};
    CU_ASSERT(dal__fail(&error, DAL_STATUS_MEMORY, "a%s%d", "\nb\x7f", 5) == DAL_STATUS_MEMORY);
    CU_ASSERT(error.status == DAL_STATUS_MEMORY && error.line == 0 && error.column == 0);
    CU_ASSERT_STRING_EQUAL(error.message, "a?b?5");
    CU_ASSERT(dal__fail(NULL, DAL_STATUS_IO, "unheard") == DAL_STATUS_IO);
    const char *const names[] = {"omega"};
    error.line = error.column = 7;
    CU_ASSERT(dal__unknown(&error, "parameter", "omga", names, 1) == DAL_STATUS_NAME);
    CU_ASSERT(error.line == 0 && error.column == 0);
    CU_ASSERT_STRING_EQUAL(error.message, "unknown parameter 'omga'; did you mean 'omega'?");
}

static void test_record_is_cut_not_overrun(void)
{
    dal_error error;
    char text[2 * DAL_MESSAGE_SIZE];
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = 0;
    dal__fail_at(&error, DAL_STATUS_SYNTAX, 1, 1, "%s", text);
    CU_ASSERT(strlen(error.message) == DAL_MESSAGE_SIZE - 1);
}

static const char *nearest(const char *name)
{
    static const char *const names[] = {"rk4",  "gauss4", NULL,     "stormer-verlet",
                                        "m",    "y1'",    "gauss8", "implicit-midpoint",
                                        "omega"};
    const char *found = dal__nearest_name(name, names, sizeof names / sizeof names[0]);
    return found ? found : "none";
}

static void test_nearest(void)
{
    CU_ASSERT_STRING_EQUAL(nearest("rk5"), "rk4");        /* substitution */
    CU_ASSERT_STRING_EQUAL(nearest("gauss"), "gauss4");   /* insertion; the first */
    CU_ASSERT_STRING_EQUAL(nearest("gausss8"), "gauss8"); /* deletion */
    CU_ASSERT_STRING_EQUAL(nearest("omgea"), "omega");    /* swap */
    CU_ASSERT_STRING_EQUAL(nearest("moeag"), "omega");    /* two swaps */
    CU_ASSERT_STRING_EQUAL(nearest("M"), "m");            /* case */
    CU_ASSERT_STRING_EQUAL(nearest("OMEGA"), "omega");    /* case */
    CU_ASSERT_STRING_EQUAL(nearest("stoermer-verlet"), "stormer-verlet");
    CU_ASSERT_STRING_EQUAL(nearest("strmer-vrlt"), "stormer-verlet"); /* a third of 11 */
    CU_ASSERT_STRING_EQUAL(nearest("implicit-middle"), "implicit-midpoint");
    CU_ASSERT_STRING_EQUAL(nearest("strmr-vrlt"), "none"); /* four edits of 10 */
    CU_ASSERT_STRING_EQUAL(nearest("z"), "none");
    CU_ASSERT_STRING_EQUAL(nearest(""), "none");
    CU_ASSERT_STRING_EQUAL(nearest("chaplygin-sleigh"), "none");
}

/* The spellings of a velocity, which are more than a third of the name away. */
static void test_velocities(void)
{
    static const char *const others[] = {"vy1", "v_y1", "dy1", "y1dot", "y1_dot"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        CU_ASSERT_STRING_EQUAL(nearest(others[i]), "y1'");
    CU_ASSERT_STRING_EQUAL(nearest("y1_dots"), "none");
}

static void test_nearest_of_long_names(void)
{
    char text[4096];
    memset(text, 'g', sizeof text);
    text[sizeof text - 1] = 0;
    const char *const names[] = {text, "g"};
    CU_ASSERT(dal__nearest_name(text, names, 2) == NULL);
    CU_ASSERT_STRING_EQUAL(dal__nearest_name("gg", names, 2), "g");
}

static void test_unknown(void)
{
    const char *const names[] = {"omega", "v0"};
    dal_error error;
    CU_ASSERT(dal__unknown_at(&error, 2, 5, "parameter", "omga", names, 2) == DAL_STATUS_NAME);
    CU_ASSERT_STRING_EQUAL(error.message, "unknown parameter 'omga'; did you mean 'omega'?");
    CU_ASSERT(dal__unknown_at(&error, 2, 5, "parameter", "mass", names, 2) == DAL_STATUS_NAME);
    CU_ASSERT_STRING_EQUAL(error.message, "unknown parameter 'mass'");
}

void suite_error(void)
{
    CU_pSuite suite = CU_add_suite("errors", NULL, NULL);
    CU_add_test(suite, "every status has its own words", test_every_status_has_its_words);
    CU_add_test(suite, "the version", test_version_text_has_the_numbers);
    CU_add_test(suite, "an error record", test_record);
    CU_add_test(suite, "an error that is about no text", test_record_without_a_place);
    CU_add_test(suite, "a long message is cut", test_record_is_cut_not_overrun);
    CU_add_test(suite, "the nearest name", test_nearest);
    CU_add_test(suite, "other spellings of velocities", test_velocities);
    CU_add_test(suite, "the nearest of long names", test_nearest_of_long_names);
    CU_add_test(suite, "an unknown name", test_unknown);
}
