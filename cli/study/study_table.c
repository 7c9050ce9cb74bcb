/* study_table.c - the tables of a study on stdout.
 *
 * Per system and step: the motion itself (D, E, invariants, error), whose numbers are those of
 * (q,v) alone; and, started off p = pi = 0, what only the lift can show (H, p, pi). */
#include "dalembert.h"
#include "study.h"
#include "ui/wrap.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { METHOD = 28, CELL = 32 };

typedef struct line {
    const study_plan *plan;
    const study_cell *cell;
    const dal_trend *D, *E, *H, *p, *pi, *invariant, *error;
    int only; /* there is no lifted form of the method */
} line;

/* ---- what stands in a column ---- */

/* 3.4e-16; 0 where a quantity is exactly so. */
static void say_size(char *text, const dal_trend *trend, double size)
{
    if (trend && trend->count > 0) snprintf(text, CELL, size == 0.0 ? "0" : "%.1e", size);
}

static void say_rate(char *text, const dal_trend *trend)
{
    if (trend && trend->count > 0)
        snprintf(text, CELL, trend->rate == 0.0 ? "0" : "%+.0e", trend->rate);
}

/* "rounding, linear"; "exact" says it all. */
static void say_trend(char *text, const dal_trend *trend)
{
    if (!trend || trend->conservation != DAL_CONSERVED) return;
    snprintf(text, CELL, "%s", dal_size_text(trend->size));
    if (trend->size == DAL_SIZE_EXACT) return;
    snprintf(text + strlen(text), CELL - strlen(text), ", %s", dal_trend_text(trend->trend));
}

static double max_abs(const dal_trend *trend) { return trend ? trend->max_abs : 0.0; }
static double deviation(const dal_trend *trend) { return trend ? trend->deviation : 0.0; }

static void put_physical(char *text, const line *l)
{
    if (l->only) snprintf(text, CELL, "only");
    const study_cell *physical = study_physical_cell(l->plan, l->cell);
    if (l->cell->start != STUDY_SURFACE || !physical || physical->state != STUDY_FINISHED) return;
    snprintf(text, CELL, "%s", physical->bits == l->cell->bits ? "same" : "DIFFERS");
}

static double per_step(const line *l, double x)
{
    return l->cell->steps > 0 ? x / (double)l->cell->steps : 0.0;
}

#define SPEED_LIST(X)                                                                              \
    X("steps", "", 8, snprintf(text, CELL, "%lld", l->cell->steps))                                \
    X("evals", "/step", 6,                                                                         \
      snprintf(text, CELL, "%.1f", per_step(l, (double)l->cell->evaluations)))                     \
    X("ns", "/step", 7, snprintf(text, CELL, "%.0f", per_step(l, 1e9 * l->cell->seconds)))

/* head, second line of the head, width, what is said */
#define MOTION_LIST(X)                                                                             \
    X("max", "|D|", 8, say_size(text, l->D, max_abs(l->D)))                                        \
    X("D rate", "per t", 7, say_rate(text, l->D))                                                  \
    X("D", "", 20, say_trend(text, l->D))                                                          \
    X("max", "|E-E0|", 8, say_size(text, l->E, deviation(l->E)))                                   \
    X("E rate", "per t", 7, say_rate(text, l->E))                                                  \
    X("E", "", 20, say_trend(text, l->E))                                                          \
    X("max", "|I-I0|", 8, say_size(text, l->invariant, deviation(l->invariant)))                   \
    X("max", "error", 8, say_size(text, l->error, max_abs(l->error)))                              \
    X("(q,v)", "alone", 8, put_physical(text, l))                                                  \
    SPEED_LIST(X)

#define LIFT_LIST(X)                                                                               \
    X("H0", "", 9, say_size(text, l->H, l->H ? l->H->first : 0.0))                                 \
    X("max", "|H-H0|", 8, say_size(text, l->H, deviation(l->H)))                                   \
    X("H rate", "per t", 7, say_rate(text, l->H))                                                  \
    X("H", "", 20, say_trend(text, l->H))                                                          \
    X("max", "|p|", 8, say_size(text, l->p, max_abs(l->p)))                                        \
    X("max", "|pi|", 8, say_size(text, l->pi, max_abs(l->pi)))                                     \
    X("|pi| rate", "per t", 10, say_rate(text, l->pi))                                             \
    X("max", "|D|", 8, say_size(text, l->D, max_abs(l->D)))                                        \
    SPEED_LIST(X)

/* ---- a row ---- */

static void put(FILE *out, int width, const char *text)
{
    fprintf(out, " %*s", width, text[0] ? text : "-");
}

#define PUT_COLUMN(head, second, width, what)                                                      \
    {                                                                                              \
        char text[CELL] = "";                                                                      \
        what;                                                                                      \
        put(out, width, text);                                                                     \
    }

static void put_motion(FILE *out, const line *l) { MOTION_LIST(PUT_COLUMN) }
static void put_lift(FILE *out, const line *l) { LIFT_LIST(PUT_COLUMN) }

#define PUT_HEAD(head, second, width, what)   fprintf(out, " %*s", width, head);
#define PUT_SECOND(head, second, width, what) fprintf(out, " %*s", width, second);

static void head_motion(FILE *out)
{
    fprintf(out, "  %-*s", METHOD, "integrator");
    MOTION_LIST(PUT_HEAD)
    fprintf(out, "\n  %-*s", METHOD, "");
    MOTION_LIST(PUT_SECOND)
    fputc('\n', out);
}

static void head_lift(FILE *out)
{
    fprintf(out, "  %-*s", METHOD, "integrator");
    LIFT_LIST(PUT_HEAD)
    fprintf(out, "\n  %-*s", METHOD, "");
    LIFT_LIST(PUT_SECOND)
    fputc('\n', out);
}

static line make_line(const study_plan *plan, const study_cell *c)
{
    return (line){.plan = plan,
                  .cell = c,
                  .D = study_worst_constraint(c),
                  .E = study_trend(c, "E"),
                  .H = study_trend(c, "H"),
                  .p = study_trend(c, "|p|"),
                  .pi = study_trend(c, "|pi|"),
                  .invariant = study_worst_invariant(c, NULL),
                  .error = study_trend(c, "error")};
}

/* A cell without numbers says why in their place. */
static void put_state(FILE *out, const study_cell *c)
{
    fprintf(out, " %s", study_state_word(c->state));
    if (c->state == STUDY_FAILED && c->steps > 0) fprintf(out, " after t = %.6g", c->time);
    if (c->error.message[0]) fprintf(out, ": %s", c->error.message);
}

/* ---- tables ---- */

typedef struct table {
    const char *title;
    void (*head)(FILE *out);
    void (*row)(FILE *out, const line *l);
} table;

static const table tables[STUDY_STARTS] = {
    [STUDY_PHYSICAL] = {"in (q,v) alone", head_motion, put_motion},
    [STUDY_SURFACE] = {"lifted, on p = pi = 0", head_motion, put_motion},
    [STUDY_DISPLACED] = {"lifted, p and pi displaced", head_lift, put_lift},
};

/* A method that has no lifted form has its numbers in (q,v) alone, where those on the surface would
 * be the same. */
static const study_cell *cell_shown(const study_plan *plan, const study_cell *c)
{
    const study_cell *physical = c->start == STUDY_SURFACE ? study_physical_cell(plan, c) : NULL;
    return c->state == STUDY_REFUSED && physical && physical->state == STUDY_FINISHED ? physical
                                                                                      : c;
}

static void print_table(FILE *out, const study_plan *plan, const study_case *e, double step,
                        int start)
{
    fprintf(out, "\n %s, h = %g, T = %g\n", tables[start].title, step, e->time);
    tables[start].head(out);
    for (int i = e->first_cell; i < e->first_cell + e->cells; i++) {
        const study_cell *c = &plan->cells[i];
        char name[STUDY_NAME];
        if (c->elsewhere || c->step != step || c->start != start) continue;
        fprintf(out, "  %-*s", METHOD, dal_method_name(c->method, name, sizeof name));
        c = cell_shown(plan, c);
        line l = make_line(plan, c);
        l.only = c->start != start;
        if (c->state == STUDY_FINISHED)
            tables[start].row(out, &l);
        else
            put_state(out, c);
        fputc('\n', out);
    }
}

void study_print_case(FILE *out, const study_plan *plan, const study_case *e)
{
    fprintf(out, "\n%s%s%s\n", e->label, e->system->title ? ": " : "",
            e->system->title ? e->system->title : "");
    for (int h = 0; h < e->steps; h++)
        for (int start = 0; start < STUDY_STARTS; start++) {
            /* The numbers on the surface are those of (q,v); the files hold both. */
            int repeats = start == STUDY_PHYSICAL && e->starts & 1 << STUDY_SURFACE;
            if (e->starts & 1 << start && !repeats) print_table(out, plan, e, e->step[h], start);
        }
}

static int is_lifted(const study_plan *plan)
{
    for (int i = 0; i < plan->case_count; i++)
        if (plan->cases[i].starts & ~(1 << STUDY_PHYSICAL)) return 1;
    return 0;
}

void study_print_note(FILE *out, const study_plan *plan)
{
    static const char lift[] =
        "\n"
        "What this shows.  On p = pi = 0 a lifted method is the same method on (q,v), bit for\n"
        "bit ('same'), p and pi stay zero and so does H; a method that has no lifted form is\n"
        "shown in (q,v) alone ('only').  That a method is symplectic on the lift says nothing\n"
        "there about D or the energy: every one-step method whose step is locally invertible,\n"
        "explicit Euler included, is the restriction of a symplectic one.  D and E are kept, or\n"
        "not, for other reasons: the form of D, whether D is imposed or projected on,\n"
        "reversibility.  What symplecticity does keep shows\n"
        "off p = pi = 0, in H.  There pi/e pushes v off D; p and pi grow where the motion\n"
        "contracts or a coordinate is cyclic, and the error of H, linear in them, grows with\n"
        "them: read it beside |p| and |pi|.  A step that lands in D = 0, by projection or\n"
        "by itself, has no lift of 4n+2 variables (restricted to D = 0 it lifts to T*{D = 0}, of\n"
        "dimension 2(2n - m)); a projection puts p = pi = 0, and H with them.\n";
    static const char words[] =
        "\n"
        "Sizes.  exact: never changed.  rounding: what roundings of so many steps make.  larger:\n"
        "larger than that.  Trends.  none: about one value.  settles: changes once.  random walk,\n"
        "linear, power law, exponential, growing oscillation: grows so.  undecided: too few\n"
        "samples, or too slow an oscillation, to decide.  aborted: not finite.  quantities.csv "
        "has\n"
        "the confidence of each.  -: there is no such quantity, or E where the motion need not\n"
        "conserve it: never, or off D = 0 where it does so on D = 0 only.  Rates are slopes of\n"
        "fitted lines.  All look at every step.  I are the invariants of the system, the worst\n"
        "of them; ns are of the clock, looking on included.\n";
    if (is_lifted(plan)) cli_wrap_notes(out, lift);
    cli_wrap_notes(out, words);
}
