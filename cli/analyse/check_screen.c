/* check_screen.c - the report of `check` on a terminal. */
#include "check_screen.h"
#include "check_invariants.h"
#include "ui/memory.h"
#include "ui/name_patterns.h"
#include "ui/screen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FAILED = 4, MAX_REASONS = 2, MAX_PROPOSED = 3, HEAD = 22 };

/* Where in the file the cause of a failure is likely to be: by what an item begins with. */
static const struct {
    const char *what, *cause;
} causes[] = {
    {"|D| at the start",
     "start: its velocities do not satisfy constraints:; --consistent moves them"},
    {"rank of A", "constraints: some of them depend on each other at the start"},
    {"rank of G", "constraints: some of them depend on each other at the start"},
    {"rank of W", "lagrangian: it lacks the kinetic energy of a velocity"},
    {"F at the start", "start: a formula has no value there, as 1/0 or sqrt(-1)"},
    {"invariant", "invariants: this formula changes along the motion"},
    {"energy", "lagrangian: or forces: the energy is not what the system states"},
    {"exact", "exact: it does not begin at the start"},
    {"residual", "exact: it does not solve the equations of motion"},
    {"", "a formula with a kink, a table, or very large values near the start"},
};

static const check_entry *find_entry(const check *c, const char *what)
{
    for (int i = 0; i < c->items; i++)
        if (c->entry[i].what && strcmp(c->entry[i].what, what) == 0) return &c->entry[i];
    return NULL;
}

static bool is_bad(const check_entry *e)
{
    return e->result == CHECK_FAIL || e->result == CHECK_UNMEASURED;
}

static void say_result(screen *s, const check *c)
{
    int checks = 0, bad = 0;
    for (int i = 0; i < c->items; i++) {
        const check_entry *e = &c->entry[i];
        checks += e->what && e->result != CHECK_INFO;
        if (!is_bad(e) || bad++ >= MAX_FAILED) continue;
        size_t k = 0;
        while (strncmp(e->what, causes[k].what, strlen(causes[k].what)) != 0) k++;
        screen_say(s, 4, "%s: %s: %s", e->result == CHECK_FAIL ? "FAIL" : "not measured", e->what,
                   e->text);
        screen_say(s, 6, "    see %s", causes[k].cause);
    }
    if (bad > MAX_FAILED) screen_say(s, 2, "... and %d more (--details)", bad - MAX_FAILED);
    if (bad > 0)
        screen_say(s, 2, "%d of %d checks failed.", bad, checks);
    else
        screen_say(s, 2, "ok: %d checks of derivatives, constraints, Dirac's procedure and actions",
                   checks);
}

/* The methods that are accepted and preserve all of this, by patterns, with their number. */
static void add_methods(screen_table *t, const screen *s, const check *c, const char *head,
                        unsigned preserved)
{
    const char **names = cli_calloc((size_t)c->methods + 1, sizeof *names);
    bool *is_in = cli_calloc((size_t)c->methods + 1, sizeof *is_in);
    int count = 0;
    for (int i = 0; i < c->methods; i++) {
        names[i] = c->method[i].name;
        is_in[i] = !c->method[i].reason && (c->method[i].preserved & preserved) == preserved;
        count += is_in[i];
    }
    char *text = name_patterns(names, is_in, c->methods, 2 * (s->width - HEAD - 2) - 6);
    screen_add_cell(t, SCREEN_PLAIN, "%s", head);
    screen_add_cell(t, SCREEN_PLAIN, count > 0 ? "%s  (%d)" : "%s", text, count);
    free(text);
    free(names);
    free(is_in);
}

/* Names with the same reason together. */
static void add_refusals(screen_table *t, const check *c)
{
    int reasons = 0;
    for (int i = 0; i < c->methods; i++) {
        const char *reason = c->method[i].reason;
        int k = 0, others = 0;
        if (!reason) continue;
        while (!c->method[k].reason || strcmp(c->method[k].reason, reason) != 0) k++;
        if (k < i) continue;
        for (k = i + 1; k < c->methods; k++)
            others += c->method[k].reason && strcmp(c->method[k].reason, reason) == 0;
        if (reasons++ >= MAX_REASONS) continue;
        char *more = others > 0 ? cli_format(" and %d more", others) : cli_strdup("");
        screen_add_cell(t, SCREEN_PLAIN, reasons == 1 ? "Refused" : "");
        screen_add_cell(t, SCREEN_PLAIN, "%s%s: %s", c->method[i].name, more, reason);
        free(more);
    }
    if (reasons <= MAX_REASONS) return;
    screen_add_cell(t, SCREEN_PLAIN, "%s", "");
    screen_add_cell(t, SCREEN_PLAIN, "... and %d more reasons (--details)", reasons - MAX_REASONS);
}

/* What the items say of E, the invariants, reversal and D. */
static void add_properties(screen_table *t, const check *c)
{
    static const char invariant[] = "invariant ";
    static const char *const classes[] = {"D linear, constant coefficients", "D affine in v",
                                          "D bilinear in (q,v)", "D quadratic in (q,v)"};
    const check_entry *energy = find_entry(c, "energy E");
    const check_entry *reversal = find_entry(c, "F(q,-v,-t) = F(q,v,t)");
    char text[512] = "";
    size_t n = 0;
    if (energy) n = (size_t)snprintf(text, sizeof text, "E: %s", energy->text);
    for (int i = 0; i < c->items && n < sizeof text; i++) {
        const check_entry *e = &c->entry[i];
        if (e->what && strncmp(e->what, invariant, sizeof invariant - 1) == 0 && !is_bad(e))
            n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", n > 0 ? "; " : "",
                                  e->what + sizeof invariant - 1);
    }
    screen_add_cell(t, SCREEN_PLAIN, "Conserved");
    screen_add_cell(t, SCREEN_PLAIN, "%s", text[0] ? text : "nothing that is known");
    for (int i = 0, rows = 0; i < c->items; i++) {
        const check_entry *e = &c->entry[i];
        const size_t length = sizeof CHECK_PROPOSED_INVARIANT - 1;
        if (!e->what || strncmp(e->what, CHECK_PROPOSED_INVARIANT, length) != 0 ||
            rows++ >= MAX_PROPOSED)
            continue;
        screen_add_cell(t, SCREEN_PLAIN, rows == 1 ? "Conserved, too" : "");
        screen_add_cell(t, SCREEN_PLAIN, "%s: %s", e->what + length, e->text);
    }
    n = 0;
    text[0] = '\0';
    if (reversal)
        n = (size_t)snprintf(text, sizeof text, "%s",
                             strncmp(reversal->text, "yes", 3) == 0 ? "reversible"
                                                                    : "not reversible");
    for (size_t k = 0; k < sizeof classes / sizeof *classes && n < sizeof text; k++) {
        const check_entry *e = find_entry(c, classes[k]);
        if (e && strncmp(e->text, "yes", 3) == 0)
            n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", n > 0 ? "; " : "", classes[k]);
    }
    if (!text[0]) return;
    screen_add_cell(t, SCREEN_PLAIN, "It is");
    screen_add_cell(t, SCREEN_PLAIN, "%s", text);
}

int check_print_screen(const check *c)
{
    /* The first of these that is accepted and keeps D, where there is one. */
    static const char *const first_choices[] = {"gauss-spark4", "spark4", "+project", "gauss4"};
    const dal_system *system = c->system;
    const unsigned D = c->m > 0 ? 1u << CHECK_PRESERVES_D : 0, E = 1u << CHECK_PRESERVES_E;
    const check_entry *growth = find_entry(c, "growth vector of D = 0");
    const char *choice = NULL;
    screen s;
    screen_open(&s, stdout, SCREEN_TEXT);
    screen_say(&s, 2, "%s%s%s", system->name, system->title ? ": " : "",
               system->title ? system->title : "");
    screen_say(&s, 2, "%d coordinate%s, %d constraint%s%s%s", c->n, c->n == 1 ? "" : "s", c->m,
               c->m == 1 ? "" : "s", growth ? ", growth " : "", growth ? growth->text : "");
    say_result(&s, c);
    screen_skip(&s);
    screen_table t = {.columns = 2};
    add_properties(&t, c);
    if (c->m > 0) add_methods(&t, &s, c, "D is kept by", D);
    if (system->properties & (DAL_E_EXACT | DAL_E_ON_D))
        add_methods(&t, &s, c, c->m > 0 ? "D and E are kept by" : "E is kept by", D | E);
    add_refusals(&t, c);
    screen_add_table(&s, &t, "lw", 2);
    screen_free_table(&t);
    screen_skip(&s);
    for (size_t k = 0; k < sizeof first_choices / sizeof *first_choices && !choice; k++)
        for (int i = 0; i < c->methods; i++)
            if (strcmp(c->method[i].name, first_choices[k]) == 0 && !c->method[i].reason &&
                (c->method[i].preserved & D) == D)
                choice = first_choices[k];
    if (choice)
        screen_say(&s, 2, "Take %s%s to begin with.", choice[0] == '+' ? "gauss4" : "", choice);
    screen_say(&s, 2, "All %d items: --details", c->items);
    return screen_close(&s, "--details");
}
