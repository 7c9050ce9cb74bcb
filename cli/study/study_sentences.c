/* study_sentences.c - cells and sentences of the screen of a study on a terminal. */
#include "study_sentences.h"

#include "study_compare.h"
#include "ui/memory.h"
#include "ui/name_patterns.h"
#include "ui/wrap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Expectations that are not met and are shown. */
enum { MAX_UNMET = 2 };

/* Whether a piece of the label of a column between hyphens and underscores, of the longest length
 * at most, is in no other label; the first such piece, cut, or else the last is the name. */
static bool find_name(const study_matrix *m, int column, int letters, size_t longest,
                      char name[STUDY_SHORT_NAME])
{
    bool found = false;
    const char *piece = m->column[column]->label;
    for (size_t length; !found && *piece; piece += length + (piece[length] != '\0')) {
        length = strcspn(piece, "-_");
        if (strcmp(piece + strcspn(piece, "."), ".yaml") == 0) length = strcspn(piece, ".");
        if (length > longest) continue;
        const int fits = cli_fit(piece, letters);
        snprintf(name, STUDY_SHORT_NAME, "%.*s", length < (size_t)fits ? (int)length : fits, piece);
        int k = 0;
        while (k < m->columns && (k == column || !strstr(m->column[k]->label, name))) k++;
        found = k == m->columns;
    }
    return found;
}

void study_name_columns(const study_matrix *m, int letters, char (*name)[STUDY_SHORT_NAME])
{
    for (int i = 0; i < m->columns; i++) {
        const bool found = find_name(m, i, letters, (size_t)letters, name[i]) ||
                           find_name(m, i, letters, SIZE_MAX, name[i]);
        for (int k = 0; !found && k < i; k++)
            if (strcmp(name[i], name[k]) == 0)
                snprintf(name[i], STUDY_SHORT_NAME, "%.*s%d", cli_fit(name[k], letters - 3),
                         name[k], (i + 1) % 100);
    }
}

static const char *mark_of_growth(const dal_trend *trend)
{
    static const char *const marks[DAL_TREND_COUNT] = {
        [DAL_TREND_NONE] = "",     [DAL_TREND_SETTLES] = "",    [DAL_TREND_RANDOM_WALK] = "~",
        [DAL_TREND_LINEAR] = "/",  [DAL_TREND_POWER] = "^",     [DAL_TREND_EXPONENTIAL] = "^",
        [DAL_TREND_GROWING] = "^", [DAL_TREND_UNDECIDED] = "?", [DAL_TREND_ABORTED] = "x"};
    const bool is_slow = trend->trend == DAL_TREND_POWER && trend->exponent < 1.0;
    return is_slow ? "~" : marks[trend->trend];
}

screen_colour study_describe_size(const study_cell *c, study_quantity quantity,
                                  char text[STUDY_SIZE_TEXT])
{
    static const char *const states[STUDY_STATES] = {
        [STUDY_WAITING] = "...", [STUDY_FAILED] = "x", [STUDY_REFUSED] = "n/a"};
    const char *state = c ? states[c->state] : "-";
    const dal_trend *trend = c && !state ? study_get_trend(c, quantity) : NULL;
    char size[SCREEN_NUMBER];
    if (!trend) {
        snprintf(text, STUDY_SIZE_TEXT, "%s", state ? state : "-");
        return c && c->state == STUDY_FAILED ? SCREEN_LARGE : SCREEN_FAINT;
    }
    const double x = quantity == ENERGY ? trend->deviation : trend->max_abs;
    screen_number(size, x, 1);
    if (!study_is_stated(trend)) {
        snprintf(text, STUDY_SIZE_TEXT, "(%s)", size);
        return SCREEN_FAINT;
    }
    if (study_is_at_rounding(trend)) {
        snprintf(text, STUDY_SIZE_TEXT, "ok");
        return SCREEN_ROUNDING;
    }
    snprintf(text, STUDY_SIZE_TEXT, "%s%s", size, mark_of_growth(trend));
    return screen_colour_of(x);
}

void study_add_size(screen_table *t, const study_cell *c, study_quantity quantity)
{
    char text[STUDY_SIZE_TEXT];
    const screen_colour colour = study_describe_size(c, quantity, text);
    screen_add_cell(t, colour, "%s", text);
}

void study_add_count(screen_table *t, const study_method *m, study_quantity quantity)
{
    int runs = 0;
    for (int k = 0; k < REFUSED; k++) runs += m->count[quantity][k];
    const int ok = m->count[quantity][AT_ROUNDING];
    if (runs == 0)
        screen_add_cell(t, SCREEN_FAINT, "-");
    else
        screen_add_cell(t, ok == runs ? SCREEN_ROUNDING : SCREEN_PLAIN, "%d/%d", ok, runs);
}

char *study_list_keepers(const study_matrix *m, study_aim aim, int columns, int *kept, int *all)
{
    const char **names = cli_calloc((size_t)m->method_count + 1, sizeof *names);
    bool *is_in = cli_calloc((size_t)m->method_count + 1, sizeof *is_in), applies = false;
    int count = 0, keepers = 0;
    for (int i = 0; i < m->method_count; i++) {
        const fate D = study_method_fate(&m->methods[i], CONSTRAINT),
                   E = study_method_fate(&m->methods[i], ENERGY);
        const bool keeps_D = D == AT_ROUNDING, keeps_E = E == AT_ROUNDING;
        if (D == REFUSED || (aim != STUDY_AIM_E && D == FATES) ||
            (aim != STUDY_AIM_D && E == FATES))
            continue;
        names[count] = m->methods[i].name;
        is_in[count] = aim == STUDY_AIM_D   ? keeps_D
                       : aim == STUDY_AIM_E ? keeps_E
                                            : keeps_D && keeps_E;
        keepers += is_in[count++];
        applies = true;
    }
    char *text = applies ? name_patterns(names, is_in, count, columns) : NULL;
    if (kept) *kept = keepers;
    if (all) *all = count;
    free(names);
    free(is_in);
    return text;
}

char *study_format_explain(const study_matrix *m, int columns)
{
    char method[STUDY_NAME];
    for (int k = 0; k < m->rows * columns; k++) {
        const study_cell *c = study_matrix_cell(m, k / columns, k % columns);
        const dal_trend *trend = c ? study_get_trend(c, CONSTRAINT) : NULL;
        if (trend && !study_is_at_rounding(trend) && study_is_drifting(trend))
            return cli_format("dalembert explain %s --integrator %s --step %g --time %g",
                              study_case_system(c->of_case),
                              dal_method_name(c->method, method, sizeof method), c->step,
                              study_case_end(c->of_case, c->step));
    }
    return NULL;
}

char *study_describe_range(const study_plan *plan)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {0.0, 0.0};
    char text[2][2][SCREEN_NUMBER];
    for (int i = 0; i < plan->case_count; i++) {
        const study_case *e = &plan->cases[i];
        const double x[] = {study_case_end(e, e->step[0]), fabs(e->step[0])};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], x[k]);
            high[k] = fmax(high[k], x[k]);
        }
    }
    for (int k = 0; k < 2; k++) {
        screen_number(text[k][0], low[k], 3);
        screen_number(text[k][1], high[k], 3);
    }
    return cli_format("until t = %s%s%s, h = %s%s%s", text[0][0], low[0] < high[0] ? " .. " : "",
                      low[0] < high[0] ? text[0][1] : "", text[1][0],
                      low[1] < high[1] ? " .. " : "", low[1] < high[1] ? text[1][1] : "");
}

void study_say_expectations(screen *s, const study_plan *plan)
{
    const study_comparisons all = study_compare(plan);
    for (int i = 0, shown = 0; i < all.count && shown < MAX_UNMET; i++) {
        if (all.item[i].is_met) continue;
        char *line = study_comparison_text(&all.item[i]);
        screen_say(s, 4, "  %s", line);
        free(line);
        shown++;
    }
    if (plan->expectation_count > 0) {
        const int compared = all.count, met = all.count - all.unmet;
        char numbers[2][SCREEN_NUMBER];
        screen_say(s, 2, "Expectations: %s of %s are met", screen_count(numbers[0], met),
                   screen_count(numbers[1], compared));
    }
    free(all.item);
}
