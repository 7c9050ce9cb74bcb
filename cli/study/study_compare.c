/* study_compare.c - what a study stated beforehand against what was found. */
#include "dalembert.h"
#include "io/file.h"
#include "io/output.h"
#include "study_expect.h"
#include "ui/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- what is meant ---- */

int study_case_matches(const study_case *e, const char *label)
{
    return strcmp(label, e->label) == 0 || strcmp(label, e->group) == 0 ||
           strcmp(label, e->name) == 0 || strcmp(label, "all") == 0;
}

int study_method_matches(const dal_method *method, const char *name)
{
    char own[STUDY_NAME];
    dal_method_name(method, own, sizeof own);
    if (strncmp(name, "all+", 4) == 0) return strcmp(own + strcspn(own, "+"), name + 3) == 0;
    return strcmp(name, "all") == 0 || strcmp(name, own) == 0;
}

int study_is_constraint(const char *quantity)
{
    return quantity[0] == 'D' && strspn(quantity + 1, "0123456789") == strlen(quantity + 1);
}

static int is_state(const study_expectation *x) { return strcmp(x->quantity, "state") == 0; }

int study_expectation_covers(const study_expectation *x, const study_cell *c)
{
    if (x->step > 0.0 && x->step != c->step) return 0;
    if (x->start >= 0 && x->start != c->start) return 0;
    return study_case_matches(c->of_case, x->label) && study_method_matches(c->method, x->method);
}

static const dal_trend *find(const study_expectation *x, const study_cell *c)
{
    if (strcmp(x->quantity, "D") == 0) return study_worst_constraint(c);
    return study_trend(c, x->quantity);
}

/* Of what the motion need not conserve there are numbers, but neither size nor trend. */
static int is_stated(const study_expectation *x, const dal_trend *trend)
{
    const int is_number =
        x->field >= 0 && x->field != STUDY_FIELD_exponent && x->field != STUDY_FIELD_confidence;
    return is_number || trend->conservation == DAL_CONSERVED;
}

/* Whether a cell has what is asked for.  A label may mean several systems; E that one of them never
 * conserves is nothing to speak of. */
static int is_judged(const study_expectation *x, const study_cell *c)
{
    if (!study_expectation_covers(x, c) || c->elsewhere || c->state == STUDY_WAITING) return 0;
    if (is_state(x)) return 1;
    const dal_trend *trend = c->state == STUDY_REFUSED ? NULL : find(x, c);
    return trend && (is_stated(x, trend) || trend->conservation != DAL_NOT_CONSERVED);
}

/* ---- one comparison ---- */

static double field_of(const dal_trend *trend, int field)
{
    const double value[] = {
#define X(name, member) trend->member,
        STUDY_FIELD_LIST(X)
#undef X
    };
    return value[field];
}

static const char *field_name(int field)
{
    static const char *const name[] = {
#define X(name, member) #name,
        STUDY_FIELD_LIST(X)
#undef X
    };
    return name[field];
}

static int is_met(const study_expectation *x, const study_cell *c)
{
    if (is_state(x)) return x->words >> c->state & 1;
    const dal_trend *trend = find(x, c);
    if (!is_stated(x, trend)) return 0;
    if (x->field < 0)
        return (x->words >> trend->size | x->words >> (DAL_SIZE_COUNT + trend->trend)) & 1;
    const double value = field_of(trend, x->field);
    return value >= x->least && value <= x->most;
}

static const char *word_of(const study_expectation *x, unsigned bit)
{
    if (is_state(x)) return study_state_word((study_state)bit);
    if (bit < DAL_SIZE_COUNT) return dal_size_text((dal_size_class)bit);
    return dal_trend_text((dal_trend_class)(bit - DAL_SIZE_COUNT));
}

static void put_expected(FILE *out, const study_expectation *x)
{
    const char *separator = "";
    for (unsigned k = 0; x->words >> k; k++) {
        if (!(x->words >> k & 1)) continue;
        fprintf(out, "%s%s", separator, word_of(x, k));
        separator = " or ";
    }
    if (x->field < 0) return;
    fputs(field_name(x->field), out);
    if (x->least > -INFINITY) fprintf(out, " >= %g", x->least);
    if (x->most < INFINITY) fprintf(out, "%s <= %g", x->least > -INFINITY ? "," : "", x->most);
}

static const char found_nothing[] = "no run that has it";

/* The size where a size is expected, the trend where a trend is. */
static void put_words(FILE *out, const study_expectation *x, const dal_trend *trend)
{
    const unsigned sizes = (1u << DAL_SIZE_COUNT) - 1u;
    const int has_size = (x->words & sizes) != 0, has_trend = (x->words & ~sizes) != 0;
    fprintf(out, "%s%s%s", has_size ? dal_size_text(trend->size) : "",
            has_size && has_trend ? " and " : "", has_trend ? dal_trend_text(trend->trend) : "");
}

static void put_found(FILE *out, const study_expectation *x, const study_cell *c)
{
    const dal_trend *trend = is_state(x) ? NULL : find(x, c);
    if (!trend)
        fputs(study_state_word(c->state), out);
    else if (!is_stated(x, trend))
        fputs(dal_conservation_text(trend->conservation), out);
    else if (x->field >= 0)
        fprintf(out, "%.3g", field_of(trend, x->field));
    else
        put_words(out, x, trend);
}

/* ---- all of them ---- */

typedef void teller(FILE *out, const study_expectation *x, const study_cell *cell, int met);

/* Tells of each comparison; cell is NULL for what no run had.  Returns how many were not met, and
 * in *count how many there were. */
static int judge_all(FILE *out, const study_plan *plan, teller *tell, int *count)
{
    int missed = 0;
    *count = 0;
    for (int i = 0; i < plan->expectation_count; i++) {
        const study_expectation *x = &plan->expectations[i];
        int judged = 0, waiting = 0;
        for (int k = 0; k < plan->cell_count; k++) {
            const study_cell *c = &plan->cells[k];
            waiting |= study_expectation_covers(x, c) && c->state == STUDY_WAITING;
            if (!is_judged(x, c)) continue;
            const int met = is_met(x, c);
            judged++;
            missed += !met;
            tell(out, x, c, met);
        }
        if (judged == 0 && !waiting) {
            tell(out, x, NULL, 0);
            missed += ++judged;
        }
        *count += judged;
    }
    return missed;
}

static void tell_nothing(FILE *out, const study_expectation *x, const study_cell *c, int met)
{
    (void)out, (void)x, (void)c, (void)met;
}

int study_count_unmet(const study_plan *plan)
{
    int count;
    return judge_all(NULL, plan, tell_nothing, &count);
}

int study_failure_is_expected(const study_plan *plan, const study_cell *cell)
{
    for (int i = 0; i < plan->expectation_count; i++) {
        const study_expectation *x = &plan->expectations[i];
        const unsigned word =
            is_state(x) ? STUDY_FAILED : (unsigned)DAL_SIZE_COUNT + DAL_TREND_ABORTED;
        if (is_judged(x, cell) && x->field < 0 && x->words >> word & 1) return 1;
    }
    return 0;
}

/* ---- the table ---- */

static void tell_missed(FILE *out, const study_expectation *x, const study_cell *c, int met)
{
    char name[STUDY_NAME];
    if (met) return;
    fprintf(out, "  %-24s %-24s ", c ? c->of_case->label : x->label,
            c ? dal_method_name(c->method, name, sizeof name) : x->method);
    if (c) fprintf(out, "%-9s h = %-8g ", study_start_word(c->start), c->step);
    fprintf(out, "%s: expected ", x->quantity);
    put_expected(out, x);
    fputs(", found ", out);
    if (c)
        put_found(out, x, c);
    else
        fputs(found_nothing, out);
    fprintf(out, " (line %zu)\n", x->line);
}

void study_print_expectations(FILE *out, const study_plan *plan)
{
    int count;
    if (plan->expectation_count == 0) return;
    const int missed = judge_all(NULL, plan, tell_nothing, &count);
    fprintf(out, "\nExpectations: %d of %d are met.\n", count - missed, count);
    judge_all(out, plan, tell_missed, &count);
}

/* ---- the file ---- */

static void put_row(FILE *out, const study_expectation *x, const study_cell *c, int met)
{
    char name[STUDY_NAME];
    cli_put_text(out, c ? c->of_case->label : x->label);
    fputc(',', out);
    cli_put_text(out, c ? dal_method_name(c->method, name, sizeof name) : x->method);
    fprintf(out, ",%s,", c ? study_start_word(c->start) : "");
    if (c) cli_put(out, c->step);
    fputc(',', out);
    cli_put_text(out, x->quantity);
    fputs(",\"", out);
    put_expected(out, x);
    fputs("\",\"", out);
    if (c)
        put_found(out, x, c);
    else
        fputs(found_nothing, out);
    fprintf(out, "\",%s\n", met ? "yes" : "no");
}

int study_write_expectations(const study_plan *plan, const char *path)
{
    int count;
    size_t length;
    char *text;
    if (plan->expectation_count == 0) return file_remove(path);
    FILE *out = cli_memstream_open(&text, &length);
    fputs("label,integrator,start,step,quantity,expected,found,met\n", out);
    judge_all(out, plan, put_row, &count);
    cli_memstream_close(out);
    const int status = file_replace(path, text, length, 1);
    free(text);
    return status;
}
