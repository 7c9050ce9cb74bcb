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

static void add_cell(text_table *t, const char *format, ...) CLI_PRINTF(2, 3);

static void add_cell(text_table *t, const char *format, ...)
{
    va_list list;
    if (t->cells == t->capacity) {
        t->capacity = t->capacity ? 2 * t->capacity : 64;
        t->cell = cli_realloc(t->cell, (size_t)t->capacity * sizeof *t->cell);
    }
    va_start(list, format);
    t->cell[t->cells++] = cli_format_list(format, list);
    va_end(list);
}

static text_table begin_table(int columns, const char *const *headings)
{
    text_table table = {.columns = columns};
    for (int i = 0; i < columns; i++) add_cell(&table, "%s", headings[i]);
    return table;
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
    add_cell(t, markdown ? "`%s`" : "%s", name);
    add_cell(t, "%d", system->n);
    add_cell(t, "%d", system->m);
    add_cell(t, "%s", kind(system));
    add_cell(t, "%s", energy(system));
    add_cell(t, "%s", system->exact ? "yes" : "-");
    add_cell(t, "%s", system->title ? system->title : "");
    dal_model_free(model);
    return CLI_DONE;
}

static int list_systems(bool markdown)
{
    static const char *const headings[] = {"system", "n", "m", "D", "energy", "exact", "title"};
    int status = CLI_DONE;
    text_table table = begin_table(sizeof headings / sizeof *headings, headings);
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

static void add_properties(text_table *t, const dal_integrator *integrator, const property *p)
{
    char line[160] = "";
    size_t n = 0;
    bool inherits = false;
    for (; p->text; p++) {
        inherits |= (integrator->inherits & p->code) != 0;
        if (integrator->properties & p->code)
            n += (size_t)snprintf(line + n, sizeof line - n, "%s%s", n ? ", " : "", p->text);
    }
    add_cell(t, "%s", n ? line : inherits ? "as NAME" : "-");
}

static void add_integrator(text_table *t, const dal_integrator *integrator, bool markdown)
{
    const char *tick = markdown ? "`" : "", *alias = integrator->alias;
    const char *plus = integrator->properties & DAL_MODIFIER ? "+" : "";
    if (alias)
        add_cell(t, "%s%s%s%s, %s%s%s%s", tick, plus, integrator->name, tick, tick, plus, alias,
                 tick);
    else
        add_cell(t, "%s%s%s%s", tick, plus, integrator->name, tick);
    if (integrator->order)
        add_cell(t, "%d", integrator->order);
    else
        add_cell(t, "-");
    add_properties(t, integrator, qualities);
    add_properties(t, integrator, invariants);
    add_cell(t, "%s", integrator->summary);
    add_cell(t, "%s", integrator->reference);
}

static int list_integrators(bool markdown)
{
    static const char *const headings[] = {"integrator", "order",      "properties",
                                           "preserves",  "what it is", "reference"};
    const dal_integrator *integrator;
    text_table table = begin_table(sizeof headings / sizeof *headings, headings);
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
