/* study_compare.c - the expectations of a study compared with its results. */
#include "study_compare.h"

#include "io/csv_cells.h"
#include "io/file.h"
#include "io/file_output.h"
#include "study_expect.h"
#include "ui/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const dal_trend *find_trend(const study_expectation *x, const study_cell *c)
{
    if (study_expects_state(x)) return NULL;
    return strcmp(x->quantity, "D") == 0 ? study_cell_constraint(c)
                                         : study_cell_trend(c, x->quantity);
}

/* A quantity that the motion need not conserve has numbers, but neither size nor trend. */
static bool is_stated(const study_expectation *x, const dal_trend *trend)
{
    const bool is_number =
        x->field >= 0 && x->field != STUDY_FIELD_exponent && x->field != STUDY_FIELD_confidence;
    return is_number || trend->conservation == DAL_CONSERVED;
}

/* Whether the run of a cell could not begin, and would have had the quantity. */
static bool has_no_run(const study_expectation *x, const study_cell *c)
{
    const study_case *e = c->of_case;
    if (c->state != STUDY_FAILED || c->observables > 0) return false;
    if (!study_has_quantity(e, x->quantity)) return false;
    if (c->start == STUDY_PHYSICAL && study_is_of_lift(x->quantity)) return false;
    const bool is_conserved = e->system->properties & (DAL_E_EXACT | DAL_E_ON_D);
    return x->field >= 0 || is_conserved || strcmp(x->quantity, "E") != 0;
}

/* Whether a cell is compared.  A label may mean several systems; those that never conserve E are
 * passed over, and so are those that refuse the method. */
static bool is_compared(const study_expectation *x, const study_cell *c)
{
    if (!study_expectation_covers(x, c) || c->other_shard || c->state == STUDY_WAITING)
        return false;
    if (study_expects_state(x)) return true;
    if (c->state == STUDY_REFUSED) return false;
    const dal_trend *trend = find_trend(x, c);
    if (!trend) return has_no_run(x, c);
    return is_stated(x, trend) || trend->conservation != DAL_NOT_CONSERVED;
}

static double field_value(const dal_trend *trend, int field)
{
#define FIELD_VALUE(name, member) trend->member,
    const double value[] = {STUDY_FIELD_LIST(FIELD_VALUE)};
#undef FIELD_VALUE
    return value[field];
}

static bool expects_aborted(const study_expectation *x)
{
    return x->field < 0 && x->words >> (DAL_SIZE_COUNT + DAL_TREND_ABORTED) & 1;
}

/* Whether the quantity is known to the end of a run.  Where it is not, size, trend and numbers
 * cover the part before. */
static bool is_complete(const study_expectation *x, const study_cell *c)
{
    const dal_trend *trend = find_trend(x, c);
    return c->state == STUDY_FINISHED && trend && trend->trend != DAL_TREND_ABORTED;
}

static bool is_met(const study_expectation *x, const study_cell *c)
{
    if (study_expects_state(x)) return x->words >> c->state & 1;
    const dal_trend *trend = find_trend(x, c);
    if (!trend || !is_stated(x, trend)) return false;
    if (!is_complete(x, c)) return expects_aborted(x);
    if (x->field < 0)
        return (x->words >> trend->size | x->words >> (DAL_SIZE_COUNT + trend->trend)) & 1;
    const double value = field_value(trend, x->field);
    return value >= x->min && value <= x->max;
}

/* ---- as text ---- */

static void put_expected(FILE *out, const study_expectation *x)
{
#define FIELD_NAME(name, member) #name,
    static const char *const field_names[] = {STUDY_FIELD_LIST(FIELD_NAME)};
#undef FIELD_NAME
    const char *separator = "";
    for (unsigned k = 0; x->words >> k; k++) {
        if (!(x->words >> k & 1)) continue;
        const char *word = study_expects_state(x) ? study_state_words[k]
                           : k < DAL_SIZE_COUNT
                               ? dal_size_text((dal_size_class)k)
                               : dal_trend_text((dal_trend_class)(k - DAL_SIZE_COUNT));
        fprintf(out, "%s%s", separator, word);
        separator = " or ";
    }
    if (x->field < 0) return;
    fputs(field_names[x->field], out);
    if (x->min > -INFINITY) fprintf(out, " >= %g", x->min);
    if (x->max < INFINITY) fprintf(out, "%s <= %g", x->min > -INFINITY ? "," : "", x->max);
}

/* The size where a size is expected, the trend where a trend is.  c is NULL where no run has it. */
static void put_found(FILE *out, const study_expectation *x, const study_cell *c)
{
    const unsigned sizes = (1u << DAL_SIZE_COUNT) - 1u;
    const bool has_size = (x->words & sizes) != 0, has_trend = (x->words & ~sizes) != 0;
    const dal_trend *trend = c ? find_trend(x, c) : NULL;
    if (!trend)
        fputs(c ? study_state_words[c->state] : "no run that has it", out);
    else if (!is_complete(x, c))
        fputs(c->state == STUDY_FAILED && !expects_aborted(x) ? study_state_words[STUDY_FAILED]
                                                              : dal_trend_text(DAL_TREND_ABORTED),
              out);
    else if (!is_stated(x, trend))
        fputs(dal_conservation_text(trend->conservation), out);
    else if (x->field >= 0)
        fprintf(out, "%.3g", field_value(trend, x->field));
    else
        fprintf(out, "%s%s%s", has_size ? dal_size_text(trend->size) : "",
                has_size && has_trend ? " and " : "",
                has_trend ? dal_trend_text(trend->trend) : "");
}

/* Least widths of the label, the integrator, the start and the step. */
typedef struct widths {
    int label, integrator, start, step;
} widths;

static void print_comparison(FILE *out, const study_comparison *comparison, widths least)
{
    char name[STUDY_NAME], division[STUDY_DIVISION];
    const study_expectation *x = comparison->expectation;
    const study_cell *c = comparison->cell;
    fprintf(out, "  %-*s %-*s ", least.label, c ? c->of_case->label : x->label, least.integrator,
            c ? dal_method_name(c->method, name, sizeof name) : x->method);
    if (c)
        fprintf(out, "%-*s %-*s ", least.start, study_start_words[c->start], least.step,
                study_division(division, c->step, c->tolerance));
    fprintf(out, "%s: expected ", x->quantity);
    put_expected(out, x);
    fputs(", found ", out);
    put_found(out, x, c);
    fprintf(out, " (line %zu)\n", x->line);
}

char *study_comparison_text(const study_comparison *comparison)
{
    char *line;
    size_t length;
    FILE *text = cli_memstream_open(&line, &length);
    print_comparison(text, comparison, (widths){0});
    cli_memstream_close(text);
    line[strcspn(line, "\n")] = '\0';
    return line;
}

static void write_row(FILE *out, const study_plan *plan, const study_comparison *comparison)
{
    char name[STUDY_NAME];
    const study_expectation *x = comparison->expectation;
    const study_cell *c = comparison->cell;
    csv_put_text(out, c ? c->of_case->label : x->label);
    fputc(',', out);
    csv_put_text(out, c ? dal_method_name(c->method, name, sizeof name) : x->method);
    fprintf(out, ",%s,", c ? study_start_words[c->start] : "");
    if (c) csv_put(out, c->step);
    if (plan->has_tolerances) fputc(',', out);
    if (plan->has_tolerances && c) csv_put(out, c->tolerance);
    fputc(',', out);
    csv_put_text(out, x->quantity);
    fputs(",\"", out);
    put_expected(out, x);
    fputs("\",\"", out);
    put_found(out, x, c);
    fprintf(out, "\",%s\n", comparison->is_met ? "yes" : "no");
}

/* ---- all of them ---- */

static void add_comparison(study_comparisons *all, const study_expectation *x, const study_cell *c)
{
    const bool met = c && is_met(x, c);
    all->item = cli_realloc(all->item, ((size_t)all->count + 1) * sizeof *all->item);
    all->item[all->count++] = (study_comparison){x, c, met};
    all->unmet += !met;
    if (met || !c || study_expects_state(x) || is_complete(x, c)) return;
    all->failed += c->state == STUDY_FAILED;
    all->aborted += c->state == STUDY_FINISHED;
}

study_comparisons study_compare(const study_plan *plan)
{
    study_comparisons all = {.count = 0};
    for (int i = 0; i < plan->expectation_count; i++) {
        const study_expectation *x = &plan->expectations[i];
        const int before = all.count;
        bool is_waiting = false;
        for (int k = 0; k < plan->cell_count; k++) {
            const study_cell *c = &plan->cells[k];
            is_waiting |= study_expectation_covers(x, c) && c->state == STUDY_WAITING;
            all.refused += study_expectation_covers(x, c) && !study_expects_state(x) &&
                           !c->other_shard && c->state == STUDY_REFUSED;
            if (is_compared(x, c)) add_comparison(&all, x, c);
        }
        if (all.count == before && !is_waiting) add_comparison(&all, x, NULL);
    }
    return all;
}

int study_count_unmet(const study_plan *plan)
{
    const study_comparisons all = study_compare(plan);
    free(all.item);
    return all.unmet;
}

bool study_failure_is_expected(const study_plan *plan, const study_cell *cell)
{
    for (int i = 0; i < plan->expectation_count; i++) {
        const study_expectation *x = &plan->expectations[i];
        if (!is_compared(x, cell)) continue;
        if (study_expects_state(x) ? is_met(x, cell) : expects_aborted(x) && find_trend(x, cell))
            return true;
    }
    return false;
}

void study_print_met(FILE *out, const study_comparisons *all)
{
    const struct {
        int count;
        const char *word;
    } others[] = {{all->failed, study_state_words[STUDY_FAILED]},
                  {all->aborted, dal_trend_text(DAL_TREND_ABORTED)},
                  {all->refused, study_state_words[STUDY_REFUSED]}};
    const char *separator = "; ";
    fprintf(out, "Expectations: %d of %d are met", all->count - all->unmet, all->count);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        if (others[i].count == 0) continue;
        fprintf(out, "%s%d %s", separator, others[i].count, others[i].word);
        separator = ", ";
    }
    fputs(".\n", out);
}

void study_print_expectations(FILE *out, const study_plan *plan)
{
    const study_comparisons all = study_compare(plan);
    if (plan->expectation_count > 0) {
        fputc('\n', out);
        study_print_met(out, &all);
    }
    for (int i = 0; i < all.count; i++)
        if (!all.item[i].is_met) print_comparison(out, &all.item[i], (widths){24, 24, 9, 12});
    free(all.item);
}

int study_write_expectations(const study_plan *plan, const char *path)
{
    size_t length;
    char *text;
    if (plan->expectation_count == 0) return file_remove(path);
    const study_comparisons all = study_compare(plan);
    FILE *out = cli_memstream_open(&text, &length);
    fprintf(out, "label,integrator,start,step%s,quantity,expected,found,met\n",
            plan->has_tolerances ? ",tolerance" : "");
    for (int i = 0; i < all.count; i++) write_row(out, plan, &all.item[i]);
    cli_memstream_close(out);
    const int status = file_replace(path, text, length, FILE_SYNCED);
    free(text);
    free(all.item);
    return status;
}
