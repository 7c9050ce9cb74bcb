/* list.c - `dalembert list`: the built-in systems, integrators and modifiers. */
#include "dalembert.h"
#include "run/system.h"
#include "ui/commands.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/options.h"
#include "ui/wrap.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COLUMNS = 8, LEAST_TEXT = 40 /* columns */ };

typedef struct settings {
    const char *table, *tag;
    long long order;
    int preserves; /* a row of invariants; -1: any */
    bool markdown, is_long;
    int width; /* what the tables fit into; 0: they have what they have */
} settings;

/* A table of texts; the first row has the headings. */
typedef struct text_table {
    int text; /* the column of free text, which a short table wraps */
    int columns, cells, capacity;
    char **cell;
} text_table;

static void append_row(text_table *t, const char *format, ...) CLI_PRINTF(2, 3);

/* Of cells between tabs. */
static void append_row(text_table *t, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    char *row = cli_format_list(format, list), *cell = row;
    va_end(list);
    for (t->columns = 0; cell; t->columns++) {
        char *end = strchr(cell, '\t');
        if (end) *end++ = '\0';
        if (t->cells == t->capacity) {
            t->capacity = t->capacity ? 2 * t->capacity : 64;
            t->cell = cli_realloc(t->cell, (size_t)t->capacity * sizeof *t->cell);
        }
        t->cell[t->cells++] = cli_strdup(cell);
        cell = end;
    }
    free(row);
}

/* Characters, not bytes, of a UTF-8 text. */
static int count_characters(const char *text)
{
    int n = 0;
    for (; *text; text++) n += ((unsigned char)*text & 0xC0) != 0x80;
    return n;
}

static void print_rule(int length)
{
    while (length-- > 0) putchar('-');
}

static void print_markdown(const text_table *t, const int *widths)
{
    for (int k = 0; k < t->cells; k++) {
        const int i = k % t->columns;
        printf("| %s%*s %s", t->cell[k], widths[i] - count_characters(t->cell[k]), "",
               i == t->columns - 1 ? "|\n" : "");
        if (k != t->columns - 1) continue;
        for (int j = 0; j < t->columns; j++) {
            putchar('|');
            print_rule(widths[j] + 2);
        }
        puts("|");
    }
}

/* The first columns side by side; the others in lines of their own, below. */
static void print_row(const text_table *t, char **cell, const int *widths, int side_by_side)
{
    char rest[1024] = "";
    size_t n = 0;
    const int last = side_by_side - 1;
    for (int i = 0; i < last; i++)
        printf("%s%*s", cell[i], widths[i] - count_characters(cell[i]) + 2, "");
    puts(cell[last]);
    for (int i = last + 1; i < t->columns && n < sizeof rest; i++)
        n += (size_t)snprintf(rest + n, sizeof rest - n, "%s%s", n > 0 ? "; " : "    ", cell[i]);
    if (n > 0) cli_wrap(stdout, rest, 0, 4);
}

static void print_rules(const int *widths, int columns)
{
    for (int i = 0; i < columns; i++) {
        print_rule(widths[i]);
        fputs(i == columns - 1 ? "\n" : "  ", stdout);
    }
}

/* All columns, or side by side those that fit. */
static void print_long(const text_table *t, const int *widths, int width)
{
    int side_by_side = 1, used = widths[0] + 2;
    while (side_by_side < t->columns && (width == 0 || used + widths[side_by_side] <= width))
        used += widths[side_by_side++] + 2;
    print_row(t, t->cell, widths, side_by_side);
    print_rules(widths, side_by_side);
    for (int k = t->columns; k < t->cells; k += t->columns)
        print_row(t, t->cell + k, widths, side_by_side);
}

/* Of the columns before the text those that leave it room. */
static void print_short(const text_table *t, const int *widths, int width)
{
    int shown[MAX_COLUMNS], rules[MAX_COLUMNS], count = 0, used = 0;
    for (int i = 0; i < t->text; i++) {
        if (i > 0 && used + widths[i] + 2 + LEAST_TEXT > width) continue;
        used += widths[i] + 2;
        rules[count] = widths[i];
        shown[count++] = i;
    }
    const int room = width > used ? width - used : 1;
    rules[count] = room < widths[t->text] ? room : widths[t->text];
    for (int k = 0; k < t->cells; k += t->columns) {
        if (k == t->columns) print_rules(rules, count + 1);
        for (int i = 0; i < count; i++) {
            const char *cell = t->cell[k + shown[i]];
            printf("%s%*s", cell, rules[i] - count_characters(cell) + 2, "");
        }
        cli_wrap_to(stdout, t->cell[k + t->text], used, used, width);
    }
}

static int end_table(text_table *t, const settings *s)
{
    int widths[MAX_COLUMNS] = {0};
    for (int k = 0; k < t->cells; k++) {
        const int width = count_characters(t->cell[k]), i = k % t->columns;
        if (width > widths[i]) widths[i] = width;
    }
    const bool is_empty = t->cells == t->columns;
    if (!is_empty && s->markdown)
        print_markdown(t, widths);
    else if (!is_empty)
        (s->width > 0 && !s->is_long ? print_short : print_long)(t, widths, s->width);
    for (int k = 0; k < t->cells; k++) free(t->cell[k]);
    free(t->cell);
    if (!is_empty) return CLI_DONE;
    return cli_fail(CLI_USAGE, "list: nothing matches; 'dalembert list --long' shows orders, "
                               "what is preserved, and tags");
}

/* ---- systems ------------------------------------------------------------------------------- */

static const char *kind(const dal_system *system)
{
    static const struct {
        unsigned property;
        const char *text;
    } kinds[] = {{DAL_VAKONOMIC, "vakonomic"},
                 {DAL_D_CONSTANT, "linear, constant"},
                 {DAL_D_BILINEAR, "bilinear"},
                 {DAL_D_QUADRATIC, "quadratic"},
                 {DAL_D_LINEAR, "linear in v"}};
    if (system->m == 0) return "-";
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (system->properties & kinds[i].property) return kinds[i].text;
    return "nonlinear";
}

static const char *energy(const dal_system *system)
{
    if (!system->energy) return "-";
    if (system->properties & DAL_E_EXACT) return "conserved";
    return system->properties & DAL_E_ON_D ? "conserved on D = 0" : "not conserved";
}

static bool has_tag(const dal_system *system, const char *tag)
{
    for (int i = 0; i < system->tags; i++)
        if (strcmp(system->tag[i], tag) == 0) return true;
    return false;
}

static void add_system(text_table *t, const char *name, const dal_system *system, const settings *s)
{
    const char *tick = s->markdown ? "`" : "", *title = system->title ? system->title : "";
    char *tags = cli_strdup("");
    for (int i = 0; s->is_long && i < system->tags; i++) {
        char *longer = cli_format("%s%s%s", tags, i > 0 ? ", " : "\t", system->tag[i]);
        free(tags);
        tags = longer;
    }
    append_row(t, "%s%s%s\t%d\t%d\t%s\t%s\t%s\t%s%s", tick, name, tick, system->n, system->m,
               kind(system), energy(system), system->exact ? "yes" : "-", title,
               s->is_long && !*tags ? "\t-" : tags);
    free(tags);
}

static int list_systems(const settings *s)
{
    text_table table = {.text = 6};
    append_row(&table, "system\tn\tm\tD\tenergy\texact\ttitle%s", s->is_long ? "\ttags" : "");
    int status = CLI_DONE;
    for (int i = 0; status == CLI_DONE && dal_builtin_name(i); i++) {
        const char *name = dal_builtin_name(i);
        dal_model *model;
        const dal_system *system;
        status = cli_load(name, &model, &system);
        if (status != CLI_DONE) continue;
        if (!s->tag || has_tag(system, s->tag)) add_system(&table, name, system, s);
        dal_model_free(model);
    }
    const int ended = end_table(&table, s);
    return status == CLI_DONE ? ended : status;
}

/* ---- integrators --------------------------------------------------------------------------- */

typedef struct property {
    unsigned code;
    const char *text;
    unsigned implied_by;
} property;

static const property qualities[] = {{DAL_EXPLICIT, "explicit", 0},
                                     {DAL_SYMMETRIC, "symmetric", 0},
                                     {DAL_SYMPLECTIC, "symplectic lift", 0},
                                     {DAL_PERSISTENT_MULTIPLIER, "persistent multipliers", 0},
                                     {DAL_ADAPTIVE, "adaptive", 0},
                                     {0, NULL, 0}};
static const char PRESERVED[] =
    "bilinear|quadratic|every|midpoints|energy"; /* words for the rows */
static const property invariants[] = {
    {DAL_PRESERVES_BILINEAR, "bilinear D", DAL_PRESERVES_QUADRATIC | DAL_PRESERVES_D},
    {DAL_PRESERVES_QUADRATIC, "quadratic D", DAL_PRESERVES_D},
    {DAL_PRESERVES_D, "every D", 0},
    {DAL_PRESERVES_D_MIDPOINT, "D at midpoints", 0},
    {DAL_PRESERVES_ENERGY, "energy", 0},
    {0, NULL, 0}};

enum { LINE = 160 };

static const char *list_properties(char line[LINE], const dal_integrator *k, const property *p)
{
    size_t n = 0;
    bool inherits = false;
    for (; p->text; p++) {
        inherits |= (k->inherits & p->code) != 0;
        if (k->properties & p->code)
            n += (size_t)snprintf(line + n, LINE - n, "%s%s", n ? ", " : "", p->text);
    }
    return n > 0 ? line : inherits ? "as NAME" : "-";
}

static bool is_selected(const dal_integrator *k, const settings *s)
{
    if (s->order > 0 && k->order != s->order) return false;
    if (s->preserves < 0) return true;
    const property *p = &invariants[s->preserves];
    return (k->properties & (p->code | p->implied_by)) != 0;
}

static void add_integrator(text_table *t, const dal_integrator *k, const settings *s)
{
    const bool is_short = s->width > 0 && !s->is_long && !s->markdown;
    const char *tick = s->markdown ? "`" : "", *plus = k->properties & DAL_MODIFIER ? "+" : "";
    char alias[LINE] = "", order[16] = "-", is[LINE], preserves[LINE];
    if (k->alias && !is_short)
        snprintf(alias, sizeof alias, ", %s%s%s%s", tick, plus, k->alias, tick);
    if (k->order) snprintf(order, sizeof order, "%d", k->order);
    append_row(t, "%s%s%s%s%s\t%s\t%s\t%s\t%s\t%s", tick, plus, k->name, tick, alias, order,
               list_properties(is, k, qualities), list_properties(preserves, k, invariants),
               k->summary, k->reference);
}

static int list_integrators(const settings *s)
{
    const dal_integrator *integrator;
    text_table table = {.text = 4};
    append_row(&table, "integrator\torder\tproperties\tpreserves\twhat it is\treference");
    for (int modifiers = 0; modifiers < 2; modifiers++)
        for (int i = 0; (integrator = dal_integrator_at(i)); i++)
            if (!(integrator->properties & DAL_MODIFIER) == !modifiers &&
                is_selected(integrator, s))
                add_integrator(&table, integrator, s);
    return end_table(&table, s);
}

/* ---- the command --------------------------------------------------------------------------- */

static const struct {
    const char *name;
    int (*print)(const settings *s);
    const char *filters;
} tables[] = {{"systems", list_systems, "--tag selects"},
              {"integrators", list_integrators, "--order and --preserves select"}};

enum { TABLES = sizeof tables / sizeof *tables };

static const cli_option options[] = {
    {"long", NULL, NULL, "prints everything, on a terminal too; also tags of systems",
     CLI_FLAG(settings, is_long)},
    {"tag", "TAG", NULL, "lists the systems with this tag", CLI_TEXT(settings, tag)},
    {"order", "N", NULL, "lists the integrators of this order",
     CLI_INTEGER(settings, order, 1, 100)},
    {"preserves", PRESERVED, NULL, "lists the integrators that preserve this",
     CLI_WORD(settings, preserves)},
    {"markdown", NULL, NULL, "prints Markdown tables", CLI_FLAG(settings, markdown)},
    {NULL, "TABLE", NULL, "systems or integrators; both when it is not given",
     CLI_TEXT(settings, table)},
};

static int check_table(const char *table)
{
    const char *names[TABLES];
    for (int i = 0; i < TABLES; i++) {
        names[i] = tables[i].name;
        if (strcmp(names[i], table) == 0) return CLI_DONE;
    }
    return cli_unknown("table", table, names, TABLES);
}

/* Without a table's name those that are filtered, or both. */
static int print_tables(const settings *s)
{
    const bool filtered[TABLES] = {s->tag != NULL, s->order > 0 || s->preserves >= 0};
    int status = s->table ? check_table(s->table) : CLI_DONE, printed = 0;
    for (int i = 0; i < TABLES && status == CLI_DONE; i++) {
        const bool is_named = s->table && strcmp(s->table, tables[i].name) == 0;
        const bool is_wanted = filtered[i] || filtered[0] == filtered[1];
        if (s->table && !is_named && filtered[i])
            status =
                cli_fail(CLI_USAGE, "list %s: %s %s", s->table, tables[i].filters, tables[i].name);
        if (status != CLI_DONE || !(s->table ? is_named : is_wanted)) continue;
        if (printed++ > 0) putchar('\n');
        status = tables[i].print(s);
    }
    return status;
}

static int list(int argc, char **argv)
{
    settings s = {.preserves = -1, .width = cli_output_width()};
    const cli_group group = CLI_GROUP(options, &s);
    int status = cli_read_arguments(&command_list, argc, argv, &group, 1);
    if (status != CLI_GO_ON) return status;
    status = print_tables(&s);
    const int closed = cli_close(stdout, "standard output");
    return status == CLI_DONE ? closed : status;
}

const cli_command command_list = {
    .name = "list",
    .synopsis = "dalembert list [systems|integrators] [OPTION]...",
    .about = "lists the built-in systems, integrators and modifiers",
    .notes =
        "Systems: n coordinates, m constraints D; the class of D as a function of (q,v); whether "
        "the motion conserves the energy E = L_v.v - L; whether an exact solution is known.\n"
        "\n"
        "Integrators: 'symplectic lift' concerns the 4n+2 canonical variables only and implies "
        "nothing about D or the energy; '... D' names the constraints, 'energy' the energy, that "
        "are preserved to rounding on D = 0.  A modifier +WORD follows an integrator, NAME+WORD: "
        "rk4+project.  'as NAME' means the properties of NAME.  'adaptive' takes --tolerance.\n"
        "\n"
        "On a terminal, or where the environment has COLUMNS, tables have the columns that fit, "
        "and one name for each integrator.  Otherwise they are complete; --long adds the tags.  "
        "--preserves bilinear also lists what preserves quadratic D, and both list what preserves "
        "every D.\n",
    .run = list,
};
