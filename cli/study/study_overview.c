/* study_overview.c - the results of a study on a terminal.
 *
 * A table of integrators and systems, D and E beside each other, and how many runs of each
 * integrator are at rounding where not all systems fit; then the integrators to take. */
#include "study_overview.h"

#include "study_matrix.h"
#include "study_predict.h"
#include "study_sentences.h"
#include "ui/memory.h"
#include "ui/screen.h"

#include <stdlib.h>
#include <string.h>

enum { LINES = SCREEN_LINES - 1, CELL = 8, COUNTS = 12, ROW_NAME = 20, LETTERS = 7 };

/* The systems of the table: short names, and which quantities they have. */
typedef struct overview {
    const study_plan *plan;
    study_matrix matrix;
    screen screen;
    char (*name)[STUDY_SHORT_NAME]; /* [columns of the matrix], as the next */
    bool (*has)[QUANTITIES];
    int columns; /* systems that fit; the others are in the counts */
} overview;

/* ---- the table ----------------------------------------------------------------------------- */

/* Which quantities the systems have, and how many of them fit beside the names and, where some are
 * left out, the counts. */
static void fit_systems(overview *o)
{
    const study_matrix *m = &o->matrix;
    int width = ROW_NAME;
    for (int i = 0; i < m->columns; i++) {
        bool *has = o->has[i];
        for (int k = 0; k < m->rows * QUANTITIES; k++) {
            const study_cell *c = study_matrix_cell(m, k / QUANTITIES, i);
            has[k % QUANTITIES] |= c && study_get_trend(c, k % QUANTITIES);
        }
        has[CONSTRAINT] |= m->column[i]->system->m > 0;
        /* The error is for what has nothing to conserve. */
        has[ERROR] = has[ERROR] && !has[CONSTRAINT] && !has[ENERGY];
        width += CELL * (has[CONSTRAINT] + has[ENERGY] + has[ERROR]);
        const bool is_last = i == o->plan->case_count - 1;
        if (o->columns == i && width + (is_last ? 0 : COUNTS) <= o->screen.width) o->columns++;
    }
}

/* The heads, in rows -2 and -1, and some of the rows. */
static void add_table(overview *o, int rows)
{
    static const char *const heads[QUANTITIES] = {"D", "E", "error"};
    const study_matrix *m = &o->matrix;
    const bool has_counts = o->columns < o->plan->case_count;
    screen_table t = {.gap = 1, .heads = 2};
    for (int k = 0; k < (rows + 2) * (o->columns + 1) * QUANTITIES; k++) {
        const int row = k / QUANTITIES / (o->columns + 1) - 2;
        const int i = k / QUANTITIES % (o->columns + 1), q = k % QUANTITIES;
        const bool is_count = i == o->columns;
        /* A document has whole labels, each beside its quantity. */
        const bool is_labelled = o->screen.format != SCREEN_TEXT;
        const bool is_first = !is_count && (q == CONSTRAINT || !o->has[i][CONSTRAINT]);
        if (i == 0 && q == 0)
            screen_add_cell(&t, SCREEN_PLAIN, "%s", row < 0 ? "" : m->row[row]->name);
        if (is_count ? !has_counts || q == ERROR : !o->has[i][q]) continue;
        if (row == -2)
            screen_add_cell(&t, SCREEN_PLAIN, "%s",
                            is_count      ? (q == CONSTRAINT ? "ok in" : "all")
                            : is_labelled ? m->column[i]->label
                            : is_first    ? o->name[i]
                                          : "");
        else if (row == -1)
            screen_add_cell(&t, SCREEN_PLAIN, "%s", heads[q]);
        else if (is_count)
            study_add_count(&t, m->row[row], q);
        else
            study_add_size(&t, study_matrix_cell(m, row, i), q);
        if (row == -2) t.columns = t.cells;
    }
    screen_add_table(&o->screen, &t, "l", 0);
    screen_free_table(&t);
}

/* ---- sentences ----------------------------------------------------------------------------- */

static void say_runs(overview *o)
{
    const study_plan *plan = o->plan;
    int count[STUDY_STATES];
    const study_cell *failed;
    char number[SCREEN_NUMBER], seconds[SCREEN_NUMBER], states[160] = "", name[STUDY_NAME];
    const int runs = study_count_states(plan, count, &failed);
    for (int i = 0; i < STUDY_STATES; i++)
        if (count[i] > 0 && count[i] < runs)
            snprintf(states + strlen(states), sizeof states - strlen(states), ", %d %s", count[i],
                     study_state_words[i]);
    screen_say(&o->screen, 2, "%s: %d methods x %d systems, %s runs in %s%s", plan->title,
               o->matrix.method_count, plan->case_count, screen_count(number, runs),
               screen_seconds(seconds, plan->seconds), states);
    if (failed)
        screen_say(&o->screen, 4, "  failed first: %s on %s: %s",
                   dal_method_name(failed->method, name, sizeof name), failed->of_case->label,
                   failed->error.message);
}

/* Which integrators keep D, E, and both in all of their runs. */
static void say_take(overview *o)
{
    static const char *const heads[STUDY_AIMS] = {
        "Take for D:   ", "  for E (1 %): ", "  for both:   "};
    for (int k = 0; k < STUDY_AIMS; k++) {
        const int hanging = (int)strlen(heads[k]);
        char *text =
            study_list_keepers(&o->matrix, (study_aim)k, o->screen.width - hanging, NULL, NULL);
        if (text) screen_say(&o->screen, hanging, "%s%s", heads[k], text);
        free(text);
    }
}

int study_print_overview(FILE *to, const study_plan *plan, const char *tables, screen_format format)
{
    /* Lines after the rows, and how many of them are the key's. */
    enum { BELOW = 10, BELOW_NARROW = 12, KEY_LINES = 8 };
    static const char *const key[] = {"ok: rounding",       "/ grows like t",
                                      "^ faster",           "~ slower",
                                      "? too short to say", "( ) not stated: D is not 0",
                                      "x failed",           "n/a refused"};
    overview o = {.plan = plan};
    study_matrix_make(&o.matrix, plan, format == SCREEN_TEXT ? STUDY_SOME : STUDY_ALL);
    o.name = cli_calloc((size_t)o.matrix.columns + 1, sizeof *o.name);
    o.has = cli_calloc((size_t)o.matrix.columns + 1, sizeof *o.has);
    screen_open(&o.screen, to, format);
    study_name_columns(&o.matrix, LETTERS, o.name);
    fit_systems(&o);
    char *range = study_describe_range(plan);
    screen_say(&o.screen, 2, "Largest |D| and |E - E0| %s", range);
    free(range);
    say_runs(&o);
    study_say_expectations(&o.screen, plan);
    char *predicted = study_describe_predictions(plan);
    if (predicted) screen_say(&o.screen, 2, "%s", predicted);
    free(predicted);
    const int room = LINES - screen_count_lines(&o.screen) -
                     (o.screen.width < SCREEN_COLUMNS ? BELOW_NARROW : BELOW);
    const int shown = o.matrix.rows <= room ? o.matrix.rows : room > 1 ? room - 1 : 1;
    const int rows = format == SCREEN_TEXT ? shown : o.matrix.rows;
    add_table(&o, rows);
    const int systems = plan->case_count - o.columns, methods = o.matrix.method_count - rows;
    if (systems > 0 && methods > 0)
        screen_say(&o.screen, 2, "... and %d more systems, %d more methods (--details)", systems,
                   methods);
    else if (systems + methods > 0)
        screen_say(&o.screen, 2, "... and %d more %s (--details)", systems + methods,
                   systems > 0 ? "systems" : "methods");
    screen_say_items(&o.screen, key, sizeof key / sizeof *key, KEY_LINES, "");
    say_take(&o);
    char *command = study_format_explain(&o.matrix, o.columns);
    if (command) screen_say_command(&o.screen, "Next:", command);
    free(command);
    screen_say(&o.screen, 2, "Tables: %s", tables ? tables : "'dalembert merge' makes them");
    free(o.name);
    free(o.has);
    study_matrix_free(&o.matrix);
    return screen_close(&o.screen, "--details");
}
