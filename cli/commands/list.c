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
#include <unistd.h>

enum { MAX_COLUMNS = 8 };

/* A table of texts; the first row has the headings. */
typedef struct text_table {
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

static void print_plain(const text_table *t, const int *widths)
{
    /* All columns, but on a terminal those that fit. */
    int side_by_side = t->columns;
    if (isatty(STDOUT_FILENO)) {
        int used = widths[0] + 2;
        side_by_side = 1;
        while (side_by_side < t->columns && used + widths[side_by_side] <= cli_width())
            used += widths[side_by_side++] + 2;
    }
    print_row(t, t->cell, widths, side_by_side);
    for (int i = 0; i < side_by_side; i++) {
        print_rule(widths[i]);
        fputs(i == side_by_side - 1 ? "\n" : "  ", stdout);
    }
    for (int k = t->columns; k < t->cells; k += t->columns)
        print_row(t, t->cell + k, widths, side_by_side);
}

static void end_table(text_table *t, bool markdown)
{
    int widths[MAX_COLUMNS] = {0};
    for (int k = 0; k < t->cells; k++) {
        const int width = count_characters(t->cell[k]), i = k % t->columns;
        if (width > widths[i]) widths[i] = width;
    }
    (markdown ? print_markdown : print_plain)(t, widths);
    for (int k = 0; k < t->cells; k++) free(t->cell[k]);
    free(t->cell);
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

static int add_system(text_table *t, const char *name, bool markdown)
{
    dal_model *model;
    const dal_system *system;
    int status = cli_load(name, &model, &system);
    if (status != CLI_DONE) return status;
    const char *tick = markdown ? "`" : "", *title = system->title ? system->title : "";
    append_row(t, "%s%s%s\t%d\t%d\t%s\t%s\t%s\t%s", tick, name, tick, system->n, system->m,
               kind(system), energy(system), system->exact ? "yes" : "-", title);
    dal_model_free(model);
    return CLI_DONE;
}

static int list_systems(bool markdown)
{
    int status = CLI_DONE;
    text_table table = {.cells = 0};
    append_row(&table, "system\tn\tm\tD\tenergy\texact\ttitle");
    for (int i = 0; status == CLI_DONE && dal_builtin_name(i); i++)
        status = add_system(&table, dal_builtin_name(i), markdown);
    end_table(&table, markdown);
    return status;
}

/* ---- integrators --------------------------------------------------------------------------- */

typedef struct property {
    unsigned code;
    const char *text;
} property;

static const property qualities[] = {
    {DAL_EXPLICIT, "explicit"},          {DAL_SYMMETRIC, "symmetric"},
    {DAL_SYMPLECTIC, "symplectic lift"}, {DAL_PERSISTENT_MULTIPLIER, "persistent multipliers"},
    {DAL_ADAPTIVE, "adaptive"},          {0, NULL}};
static const property invariants[] = {
    {DAL_PRESERVES_BILINEAR, "bilinear D"}, {DAL_PRESERVES_QUADRATIC, "quadratic D"},
    {DAL_PRESERVES_D, "every D"},           {DAL_PRESERVES_D_MIDPOINT, "D at midpoints"},
    {DAL_PRESERVES_ENERGY, "energy"},       {0, NULL}};

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

static void add_integrator(text_table *t, const dal_integrator *k, bool markdown)
{
    const char *tick = markdown ? "`" : "", *plus = k->properties & DAL_MODIFIER ? "+" : "";
    char alias[LINE] = "", order[16] = "-", is[LINE], preserves[LINE];
    if (k->alias) snprintf(alias, sizeof alias, ", %s%s%s%s", tick, plus, k->alias, tick);
    if (k->order) snprintf(order, sizeof order, "%d", k->order);
    append_row(t, "%s%s%s%s%s\t%s\t%s\t%s\t%s\t%s", tick, plus, k->name, tick, alias, order,
               list_properties(is, k, qualities), list_properties(preserves, k, invariants),
               k->summary, k->reference);
}

static int list_integrators(bool markdown)
{
    const dal_integrator *integrator;
    text_table table = {.cells = 0};
    append_row(&table, "integrator\torder\tproperties\tpreserves\twhat it is\treference");
    for (int modifiers = 0; modifiers < 2; modifiers++)
        for (int i = 0; (integrator = dal_integrator_at(i)); i++)
            if (!(integrator->properties & DAL_MODIFIER) == !modifiers)
                add_integrator(&table, integrator, markdown);
    end_table(&table, markdown);
    return CLI_DONE;
}

/* ---- the command --------------------------------------------------------------------------- */

typedef struct settings {
    const char *table;
    bool markdown;
} settings;

static const struct {
    const char *name;
    int (*print)(bool markdown);
} tables[] = {{"systems", list_systems}, {"integrators", list_integrators}};

enum { TABLES = sizeof tables / sizeof *tables };

static const cli_option options[] = {
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

static int list(int argc, char **argv)
{
    settings s = {0};
    const cli_group group = CLI_GROUP(options, &s);
    int status = cli_read_arguments(&command_list, argc, argv, &group, 1);
    if (status != CLI_GO_ON) return status;
    status = s.table ? check_table(s.table) : CLI_DONE;
    for (int i = 0; i < TABLES && status == CLI_DONE; i++) {
        if (s.table && strcmp(s.table, tables[i].name) != 0) continue;
        if (!s.table && i > 0) putchar('\n');
        status = tables[i].print(s.markdown);
    }
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
        "rk4+project.  'as NAME' means the properties of NAME.  'adaptive' takes --tolerance.\n",
    .run = list,
};
