/* study_screen.c - the results of a study on one screen.
 *
 * A matrix of integrators and systems for the constraints and, where the lines allow, for the
 * energy and the error; then sentences that count over all integrators.  A system is represented by
 * its first start and its first step. */
#include "study_screen.h"

#include "study_compare.h"
#include "study_fate.h"
#include "study_matrix.h"
#include "study_predict.h"
#include "ui/memory.h"
#include "ui/wrap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LINES = 39, /* one more is for the place of the page */
    WIDTH = 80,
    CELL = 5,  /* " l-08" */
    ITEM = 40, /* of the legend, two on a line */
    UNMET = 3  /* expectations that are named */
};

/* What is shown of a run: the heading, the name in sentences, and what is measured. */
static const struct {
    const char *heading, *name;
    bool is_displacement;
} quantities[QUANTITIES] = {
    {"max |D|", "D", false}, {"max |E-E0|", "E", true}, {"max error", "error", false}};

/* ---- the matrix ---------------------------------------------------------------------------- */

/* The text as far as it fits, with a ~ where it ends early; returns what remains of the width. */
static int put_cut(FILE *out, const char *text, int width)
{
    const int spaces = width - cli_columns(text);
    fprintf(out, "%.*s%s", cli_fit(text, spaces < 0 ? width - 1 : width), text,
            spaces < 0 ? "~" : "");
    return spaces;
}

static void put_filled(FILE *out, const char *text, int width)
{
    const int spaces = put_cut(out, text, width);
    if (spaces > 0) fprintf(out, "%*s", spaces, "");
}

/* The colours of the page: kept, bounded, small, drifting; the rest is faint. */
enum { FAINT = 2, RED = 31, GREEN, YELLOW, CYAN = 36 };
static int get_colour(const dal_trend *trend)
{
    if (study_is_bounded(trend)) return study_is_at_rounding(trend) ? GREEN : YELLOW;
    if (!study_is_drifting(trend)) return FAINT;
    return study_is_at_rounding(trend) ? CYAN : RED;
}

static void put_cell(FILE *out, bool in_colour, const study_cell *c, study_quantity quantity)
{
    static const char *const states[STUDY_STATES] = {
        [STUDY_WAITING] = "..", [STUDY_FAILED] = "fail", [STUDY_REFUSED] = "ref."};
    const char *state = c ? states[c->state] : NULL;
    const dal_trend *trend = c && !state ? study_get_trend(c, quantity) : NULL;
    char text[16];
    snprintf(text, sizeof text, "%s", state ? state : "-");
    if (trend && trend->size == DAL_SIZE_EXACT) {
        snprintf(text, sizeof text, "0");
    } else if (trend) {
        const char letter[2] = {study_is_stated(trend) ? dal_trend_text(trend->trend)[0] : '\0'};
        const double x = quantities[quantity].is_displacement ? trend->deviation : trend->max_abs;
        const double decade = fmax(-99.0, fmin(99.0, floor(log10(x))));
        snprintf(text, sizeof text, isinf(x) ? "inf" : "%s%+03.0f", letter, decade);
    }
    if (in_colour)
        fprintf(out, " \033[%dm%*s\033[0m",
                trend && study_is_stated(trend) ? get_colour(trend) : FAINT, CELL - 1, text);
    else
        fprintf(out, " %*s", CELL - 1, text);
}

/* A system has a column where something can be stated of it. */
static bool has_column(const study_matrix *s, int column, study_quantity quantity)
{
    bool has = quantity == CONSTRAINT && s->column[column]->system->m > 0;
    for (int i = 0; i < s->rows && !has; i++) {
        const study_cell *c = study_matrix_cell(s, i, column);
        has = c && study_get_trend(c, quantity);
    }
    return has;
}

static void print_matrix(FILE *out, const study_matrix *s, study_quantity quantity, bool in_colour)
{
    bool is_shown[STUDY_COLUMNS];
    int shown = 0, width = (int)strlen(quantities[quantity].heading);
    for (int k = 0; k < s->columns; k++) shown += is_shown[k] = has_column(s, k, quantity);
    if (shown == 0) return;
    for (int i = 0; i < s->rows; i++) {
        const int length = (int)strlen(s->row[i]->name);
        if (length > width) width = length;
    }
    if (width > WIDTH - CELL * shown) width = WIDTH - CELL * shown;
    for (int i = -1; i < s->rows; i++) {
        put_filled(out, i < 0 ? quantities[quantity].heading : s->row[i]->name, width);
        for (int k = 0; k < s->columns; k++) {
            if (!is_shown[k]) continue;
            if (i < 0)
                fprintf(out, " %*d", CELL - 1, k + 1);
            else
                put_cell(out, in_colour, study_matrix_cell(s, i, k), quantity);
        }
        fputc('\n', out);
    }
}

/* ---- legends ------------------------------------------------------------------------------- */

static void print_systems(FILE *out, const study_matrix *s)
{
    put_cut(out, s->plan->title, WIDTH);
    for (int k = 0; k < s->columns; k++) {
        const study_case *e = s->column[k];
        char *text = cli_format("%2d %s%s", k + 1, e->label,
                                study_first_start(e) == STUDY_DISPLACED ? " displaced" : "");
        const bool ends = k % 2 == 1 || k == s->columns - 1;
        if (k % 2 == 0) fputc('\n', out);
        if (ends)
            put_cut(out, text, ITEM - 1);
        else
            put_filled(out, text, ITEM);
        free(text);
    }
    fputc('\n', out);
    const int rest = s->plan->case_count - s->columns;
    if (rest > 0) fprintf(out, "   and %d more, which the tables show\n", rest);
}

/* Whether a matrix has a number of E without a trend. */
static bool has_energy_alone(const study_matrix *s)
{
    for (int i = 0; i < s->rows; i++)
        for (int k = 0; k < s->columns; k++) {
            const study_cell *c = study_matrix_cell(s, i, k);
            if (c && study_find_fate(c, ENERGY) == OFF_SURFACE) return true;
        }
    return false;
}

static void print_key(FILE *out, const study_matrix *s)
{
    int column = fprintf(out, "l-08: trend, decade.");
    for (int i = 0; i < DAL_TREND_ABORTED; i++) {
        const char *word = dal_trend_text((dal_trend_class)i);
        if (column + 4 + (int)strlen(word) > WIDTH) column = fprintf(out, "\n ") - 1;
        column += fprintf(out, " %c %s,", word[0], word);
    }
    fprintf(out, " %s, - not stated\n", has_energy_alone(s) ? "-08 off D = 0" : "0 constant");
}

/* ---- sentences ----------------------------------------------------------------------------- */

/* Prints "COUNT WORD" for the fates from one on that occur, with commas between them. */
static void put_fates(FILE *out, const char *separator, const int count[FATES], fate first)
{
#define FATE_TEXT(code, text) text,
    static const char *const texts[] = {FATE_LIST(FATE_TEXT)};
#undef FATE_TEXT
    for (int k = (int)first; k < FATES; k++) {
        if (count[k] == 0) continue;
        fprintf(out, "%s%d %s", separator, count[k], texts[k]);
        separator = ", ";
    }
}

/* Prints a sentence, which may take several lines; returns the column at its end. */
static int put_wrapped(FILE *out, const char *text)
{
    char *lines;
    size_t length;
    FILE *wrapped = cli_memstream_open(&lines, &length);
    cli_wrap(wrapped, text, 0, 2);
    cli_memstream_close(wrapped);
    lines[length - 1] = '\0'; /* the end of its last line */
    fputs(lines, out);
    const char *last = strrchr(lines, '\n');
    const int column = (int)strlen(last ? last + 1 : lines);
    free(lines);
    return column;
}

static void say_fates(FILE *out, const study_matrix *s, study_quantity quantity)
{
    int sum[FATES] = {0}, runs = 0;
    char *text;
    size_t length;
    for (int i = 0; i < s->method_count; i++)
        for (int k = 0; k < FATES; k++) {
            sum[k] += s->methods[i].count[quantity][k];
            runs += s->methods[i].count[quantity][k];
        }
    FILE *line = cli_memstream_open(&text, &length);
    if (runs == 0)
        fprintf(line, "No finished run on p = pi = 0 has %s to keep",
                quantity == CONSTRAINT ? "a constraint" : "an energy");
    else
        fprintf(line, "%s in %d runs", quantities[quantity].name, runs);
    put_fates(line, ": ", sum, AT_ROUNDING);
    fputs(".", line);
    cli_memstream_close(line);
    put_wrapped(out, text);
    fputc('\n', out);
    free(text);
}

/* The integrators that keep a quantity in all of their runs, as many as fit a line. */
static void say_methods(FILE *out, const study_matrix *s, study_quantity quantity, const char *what)
{
    static const char more[] = ", ...";
    int count[FATES] = {0}, all = 0, listed = 0;
    char *text;
    size_t length;
    for (int i = 0; i < s->method_count; i++) {
        const fate of_method = study_method_fate(&s->methods[i], quantity);
        if (of_method == FATES) continue;
        count[of_method]++;
        all++;
    }
    if (all == 0) return;
    FILE *line = cli_memstream_open(&text, &length);
    fprintf(line, "%d of %d integrators %s", count[AT_ROUNDING], all, what);
    put_fates(line, ", ", count, UNDECIDED);
    cli_memstream_close(line);
    int column = put_wrapped(out, text);
    for (int i = 0; i < s->method_count; i++) {
        const study_method *m = &s->methods[i];
        if (study_method_fate(m, quantity) != AT_ROUNDING) continue;
        if (column + 2 + strlen(m->name) > WIDTH - (sizeof more - 1)) break;
        column += fprintf(out, "%s%s", listed++ ? ", " : ": ", m->name);
    }
    fprintf(out, "%s\n", listed == count[AT_ROUNDING] ? "." : more);
    free(text);
}

/* What the lift adds on p = pi = 0; returns whether the study has such runs. */
static bool say_lift(FILE *out, const study_matrix *s)
{
    int pairs = 0, same = 0, others[FATES] = {0};
    char *text;
    size_t length;
    for (int i = 0; i < s->plan->cell_count; i++) {
        const study_cell *c = &s->plan->cells[i];
        const study_cell *physical =
            c->state == STUDY_FINISHED ? study_cell_physical(s->plan, c) : NULL;
        pairs += physical != NULL;
        same += physical && physical->bits == c->bits;
        if (c->start != STUDY_SURFACE || c->other_shard) continue;
        others[FAILED] += c->state == STUDY_FAILED;
        others[REFUSED] += c->state == STUDY_REFUSED;
    }
    if (pairs == 0) return false;
    FILE *line = cli_memstream_open(&text, &length);
    fprintf(line, "From p = pi = 0 the lift has the bits of (q,v) in %d of %d runs", same, pairs);
    put_fates(line, ", ", others, FAILED);
    fputs(".", line);
    cli_memstream_close(line);
    put_wrapped(out, text);
    fputc('\n', out);
    free(text);
    return true;
}

static double seconds_per_step(const study_cell *c)
{
    return c->state == STUDY_FINISHED && c->steps > 0 ? c->seconds / (double)c->steps : NAN;
}

static void say_speed(FILE *out, const study_matrix *s)
{
    const study_cell *fastest = NULL, *slowest = NULL;
    char fast[STUDY_NAME], slow[STUDY_NAME];
    for (int i = 0; i < s->plan->cell_count; i++) {
        const study_cell *c = &s->plan->cells[i];
        const double seconds = seconds_per_step(c);
        if (isnan(seconds)) continue;
        if (!fastest || seconds < seconds_per_step(fastest)) fastest = c;
        if (!slowest || seconds > seconds_per_step(slowest)) slowest = c;
    }
    if (!fastest) return;
    char *line = cli_format(
        "A step takes %.2g us (%s) to %.2g us (%s).", 1e6 * seconds_per_step(fastest),
        dal_method_name(fastest->method, fast, sizeof fast), 1e6 * seconds_per_step(slowest),
        dal_method_name(slowest->method, slow, sizeof slow));
    put_cut(out, line, WIDTH);
    fputc('\n', out);
    free(line);
}

static void say_predictions(FILE *out, const study_matrix *s)
{
    char *text = study_describe_predictions(s->plan);
    if (text) {
        put_wrapped(out, text);
        fputc('\n', out);
    }
    free(text);
}

static void print_sentences(FILE *out, const study_matrix *s)
{
    say_fates(out, s, CONSTRAINT);
    say_methods(out, s, CONSTRAINT, "keep D at rounding in every run");
    say_fates(out, s, ENERGY);
    say_methods(out, s, ENERGY, "keep E within 1 % on D = 0");
    say_predictions(out, s);
    if (!say_lift(out, s)) say_speed(out, s);
}

/* ---- the end ------------------------------------------------------------------------------- */

/* The number of expectations that are met, and the first that are not. */
static void print_expectations(FILE *out, const study_plan *plan)
{
    const study_comparisons all = study_compare(plan);
    if (plan->expectation_count > 0) study_print_met(out, &all);
    for (int i = 0, shown = 0; i < all.count && shown < UNMET; i++) {
        if (all.item[i].is_met) continue;
        char *line = study_comparison_text(&all.item[i]);
        put_cut(out, line, WIDTH);
        fputc('\n', out);
        free(line);
        shown++;
    }
    free(all.item);
}

static void print_runs(FILE *out, const study_plan *plan)
{
    int count[STUDY_STATES];
    const study_cell *failed;
    const int runs = study_count_states(plan, count, &failed);
    fprintf(out, "%d runs in %.*f s", runs, plan->seconds < 10.0 ? 2 : 0, plan->seconds);
    const char *separator = ": ";
    for (int i = 0; i < STUDY_STATES; i++) {
        if (count[i] == 0) continue;
        fprintf(out, "%s%d %s", separator, count[i], study_state_words[i]);
        separator = ", ";
    }
    fputs(".\n", out);
    if (!failed) return;
    char name[STUDY_NAME];
    char *text = cli_format("  failed first: %s on %s: %s",
                            dal_method_name(failed->method, name, sizeof name),
                            failed->of_case->label, failed->error.message);
    put_wrapped(out, text);
    fputc('\n', out);
    free(text);
}

/* ---- the screen ---------------------------------------------------------------------------- */

/* The pieces from top to bottom: a matrix for each quantity is between the legend and the key. */
enum { LEGEND, MATRIX, KEY = MATRIX + QUANTITIES, SENTENCES, END, PIECES };

static void print_piece(FILE *out, const study_matrix *s, int piece, const char *tables,
                        bool in_colour)
{
    if (piece == LEGEND) {
        print_systems(out, s);
    } else if (piece == KEY) {
        print_key(out, s);
    } else if (piece == SENTENCES) {
        print_sentences(out, s);
    } else if (piece == END) {
        print_expectations(out, s->plan);
        print_runs(out, s->plan);
        fprintf(out, "Tables: %s\n", tables ? tables : "'dalembert merge' makes them");
    } else {
        print_matrix(out, s, piece - MATRIX, in_colour);
    }
}

static int count_lines(const char *text)
{
    int lines = 0;
    while ((text = strchr(text, '\n'))) {
        text++;
        lines++;
    }
    return lines;
}

/* The last matrices are left out where they do not fit; blank lines fill what is left. */
void study_print_screen(FILE *out, const study_plan *plan, const char *tables, bool in_colour)
{
    study_matrix s;
    study_matrix_make(&s, plan, STUDY_SOME);
    char *text[PIECES];
    size_t length;
    int lines = 0;
    for (int i = 0; i < PIECES; i++) {
        FILE *piece = cli_memstream_open(&text[i], &length);
        print_piece(piece, &s, i, tables, in_colour);
        cli_memstream_close(piece);
        lines += count_lines(text[i]);
    }
    for (int i = KEY - 1; i > MATRIX && lines > LINES; i--) {
        lines -= count_lines(text[i]);
        text[i][0] = '\0';
    }
    for (int i = 0; i < PIECES; i++) {
        if (i > 0 && i != KEY && text[i][0] && lines < LINES) {
            fputc('\n', out);
            lines++;
        }
        fputs(text[i], out);
        free(text[i]);
    }
    study_matrix_free(&s);
}
