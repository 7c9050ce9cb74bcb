/* test_yaml.c - a system file that is wrong at one place: an anchor, a character that no text may
 * hold or a list for a name.  Every node of every form of section is once that place, and the error
 * names it. */
#include <CUnit/CUnit.h>
#include <dalembert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* % is before each name, $ before each other text, @ before each list and mapping. */
static const char file[] = "%title: $a title\n"
                           "%tags: @[$one, $two]\n"
                           "%coordinates: @[$x, $y]\n"
                           "%parameters: @{%m: $1, %k: $2}\n"
                           "%tables:\n  @{%f: @{%file: $none.csv, %at: $t, %value: $f}}\n"
                           "%let: @{%a: $m*x, %b: @{%for: $i = 1..2, %is: $k*i}}\n"
                           "%lagrangian: $(x'^2 + y'^2)/2\n"
                           "%constraints: @[$x' - y', @{%for: $i = 1..1, %is: $i*x'}]\n"
                           "%start: @{%x: $1, %solve: @[%y']}\n"
                           "%invariants: @{%c: $x'}\n"
                           "%events:\n  @[@{%when: $x - 5, %set: @{%x': $-x', %y': $-y'}}]\n"
                           "%reactions: @[@{%x: $1}, @{%y: $1}]\n";

static bool is_mark(char c) { return c == '%' || c == '$' || c == '@'; }

/* The file without marks; what is at mark number k, to its end, is `instead`, and where a text is
 * kept comes after it.  Returns the mark; 0: there is none. */
static char replace(int k, const char *instead, bool keeps, char *out, int *line, int *column)
{
    char mark = '\0', *to = out, *begin = out;
    *line = 1;
    for (const char *c = file; *c; c++) {
        if (!is_mark(*c)) {
            *to++ = *c;
            *line += *c == '\n' && !mark;
            if (*c == '\n' && !mark) begin = to;
        } else if (k-- == 0) {
            mark = *c;
            *column = (int)(to - begin) + 1;
            to += sprintf(to, "%s", instead);
            if (!keeps) c += strcspn(c, mark == '%' ? ":]" : ",]}\n") - 1;
        }
    }
    *to = '\0';
    return mark;
}

/* The file with a mistake at each mark of a kind is refused there. */
static void refuse_each(const char *marks, const char *instead, bool keeps, const char *message)
{
    char text[2 * sizeof file], mark;
    int line, column, tried = 0;
    for (int k = 0; (mark = replace(k, instead, keeps, text, &line, &column)) != '\0'; k++) {
        dal_model *model = NULL;
        dal_error error = {0};
        if (!strchr(marks, mark)) continue;
        const dal_status status = dal_model_read(&model, "test", text, strlen(text), &error);
        const bool is_right = status == DAL_STATUS_SYNTAX && strcmp(error.message, message) == 0 &&
                              error.line == line && error.column == column;
        CU_ASSERT(is_right);
        if (!is_right)
            printf("\n%d:%d: %s, at %d:%d in\n%s\n", error.line, error.column, error.message, line,
                   column, text);
        dal_model_free(model);
        tried++;
    }
    CU_ASSERT(tried > 20);
}

static void test_anchors(void)
{
    refuse_each("%$@", "&a ", true, "anchors and aliases are not supported");
    refuse_each("$", "*a", false, "anchors and aliases are not supported");
}

static void test_characters(void)
{
    refuse_each("%$", "\"a\\0b\"", false, "a text holds a NUL character");
    refuse_each("%$", "\"\\a\"", false, "a text holds the control character U+0007");
}

static void test_names(void) { refuse_each("%", "[x]", false, "a name is expected here"); }

void suite_yaml(void)
{
    CU_pSuite suite = CU_add_suite("one mistake in a system file", NULL, NULL);
    CU_add_test(suite, "anchors and aliases", test_anchors);
    CU_add_test(suite, "characters", test_characters);
    CU_add_test(suite, "names", test_names);
}
