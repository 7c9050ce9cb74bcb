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

enum { COLUMNS_MOST = 8 };

/* A table of texts; the first row holds the headings. */
typedef struct sheet {
    int columns, cells, room;
    char **cell;
} sheet;

static void put(sheet *s, const char *format, ...) CLI_PRINTF(2, 3);

static void grow(sheet *s)
{
    if (s->cells < s->room) return;
    s->room = s->room ? 2 * s->room : 64;
    s->cell = cli_realloc(s->cell, (size_t)s->room * sizeof *s->cell);
}

static void put(sheet *s, const char *format, ...)
{
    va_list list;
    grow(s);
    va_start(list, format);
    s->cell[s->cells++] = cli_format_list(format, list);
    va_end(list);
}

static void begin(sheet *s, int columns, const char *const *headings)
{
    *s = (sheet){.columns = columns};
    for (int i = 0; i < columns; i++) put(s, "%s", headings[i]);
}

/* Characters, not bytes, of a UTF-8 text. */
static int width(const char *text)
{
    int n = 0;
    for (; *text; text++) n += ((unsigned char)*text & 0xC0) != 0x80;
    return n;
}

static void put_markdown(const sheet *s, int first, const int *widths)
{
    for (int i = 0; i < s->columns; i++) {
        const char *text = s->cell[first + i];
        printf("| %s%*s ", text, widths[i] - width(text), "");
    }
    puts("|");
}

/* The columns from number fits on go to lines of their own, below. */
static void put_row(const sheet *s, int first, const int *widths, int fits)
{
    char rest[1024] = "";
    size_t n = 0;
    for (int i = 0; i < fits; i++) {
        const char *text = s->cell[first + i];
        printf("%s%*s", text, i == fits - 1 ? 0 : widths[i] - width(text) + 2, "");
    }
    putchar('\n');
    for (int i = fits; i < s->columns && n < sizeof rest; i++)
        n += (size_t)snprintf(rest + n, sizeof rest - n, "%s%s", i > fits ? "; " : "    ",
                              s->cell[first + i]);
    if (n) cli_wrap(stdout, rest, 0, 4);
}

static void put_rule(const int *widths, int fits, bool markdown)
{
    for (int i = 0; i < fits; i++) {
        int dashes = widths[i] + (markdown ? 2 : 0);
        if (markdown) putchar('|');
        while (dashes-- > 0) putchar('-');
        if (!markdown && i < fits - 1) fputs("  ", stdout);
    }
    puts(markdown ? "|" : "");
}

/* How many columns stand side by side: all, unless a terminal is too narrow for that. */
static int count_fits(const sheet *s, const int *widths)
{
    const int most = isatty(STDOUT_FILENO) ? cli_width() : 0;
    int fits = 0, used = 0;
    if (most == 0) return s->columns;
    while (fits < s->columns && used + widths[fits] <= most) used += widths[fits++] + 2;
    return fits > 0 ? fits : 1;
}

static void put_table(const sheet *s, const int *widths, bool markdown)
{
    const int fits = markdown ? s->columns : count_fits(s, widths);
    for (int k = 0; k < s->cells; k += s->columns) {
        if (markdown)
            put_markdown(s, k, widths);
        else
            put_row(s, k, widths, fits);
        if (k == 0) put_rule(widths, fits, markdown);
    }
}

static int end(sheet *s, bool markdown)
{
    int widths[COLUMNS_MOST] = {0};
    for (int k = 0; k < s->cells; k++) {
        int w = width(s->cell[k]), i = k % s->columns;
        if (w > widths[i]) widths[i] = w;
    }
    put_table(s, widths, markdown);
    for (int k = 0; k < s->cells; k++) free(s->cell[k]);
    free(s->cell);
    return CLI_DONE;
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
    if (system->properties & DAL_E_EXACT) return "kept";
    return system->properties & DAL_E_ON_D ? "kept on D = 0" : "not kept";
}

static int put_system(sheet *s, const char *name, bool markdown)
{
    dal_model *model;
    const dal_system *system;
    int status = cli_load(name, &model, &system);
    if (status != CLI_DONE) return status;
    put(s, markdown ? "`%s`" : "%s", name);
    put(s, "%d", system->n);
    put(s, "%d", system->m);
    put(s, "%s", kind(system));
    put(s, "%s", energy(system));
    put(s, "%s", system->exact ? "yes" : "-");
    put(s, "%s", system->title ? system->title : "");
    dal_model_free(model);
    return CLI_DONE;
}

static int list_systems(bool markdown)
{
    static const char *const headings[] = {"system", "n", "m", "D", "energy", "exact", "title"};
    sheet s;
    int status = CLI_DONE;
    begin(&s, sizeof headings / sizeof headings[0], headings);
    for (int i = 0; status == CLI_DONE && dal_builtin_name(i); i++)
        status = put_system(&s, dal_builtin_name(i), markdown);
    int printed = end(&s, markdown);
    return status == CLI_DONE ? printed : status;
}

/* ---- integrators --------------------------------------------------------------------------- */

static void put_claims(sheet *s, unsigned properties, unsigned inherits)
{
    static const struct {
        unsigned claim;
        const char *text;
    } texts[] = {{DAL_EXPLICIT, "explicit"},
                 {DAL_SYMMETRIC, "symmetric"},
                 {DAL_SYMPLECTIC, "symplectic lift"},
                 {DAL_PRESERVES_BILINEAR, "bilinear D"},
                 {DAL_PRESERVES_QUADRATIC, "quadratic D"},
                 {DAL_PRESERVES_D, "every D"},
                 {DAL_PRESERVES_D_MIDPOINT, "D at midpoints"},
                 {DAL_PRESERVES_ENERGY, "energy"},
                 {DAL_PERSISTENT_MULTIPLIER, "carries multipliers"},
                 {DAL_ADAPTIVE, "adaptive"}};
    char line[160] = "";
    size_t n = 0;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        if (properties & texts[i].claim)
            n += (size_t)snprintf(line + n, sizeof line - n, "%s%s", n ? ", " : "", texts[i].text);
    put(s, "%s", n ? line : inherits & DAL_SYMMETRIC ? "as NAME" : "-");
}

static void put_integrator(sheet *s, const dal_integrator *integrator, bool markdown)
{
    const char *tick = markdown ? "`" : "";
    const char *plus = integrator->properties & DAL_MODIFIER ? "+" : "";
    if (integrator->alias)
        put(s, "%s%s%s%s, %s%s%s%s", tick, plus, integrator->name, tick, tick, plus,
            integrator->alias, tick);
    else
        put(s, "%s%s%s%s", tick, plus, integrator->name, tick);
    if (integrator->order)
        put(s, "%d", integrator->order);
    else
        put(s, "-");
    put_claims(s, integrator->properties, integrator->inherits);
    put(s, "%s", integrator->summary);
    put(s, "%s", integrator->reference);
}

static int list_integrators(bool markdown)
{
    static const char *const headings[] = {"integrator", "order", "keeps or is", "what it is",
                                           "reference"};
    const dal_integrator *integrator;
    sheet s;
    begin(&s, sizeof headings / sizeof headings[0], headings);
    for (int modifiers = 0; modifiers < 2; modifiers++)
        for (int i = 0; (integrator = dal_integrator_at(i)); i++)
            if (!(integrator->properties & DAL_MODIFIER) == !modifiers)
                put_integrator(&s, integrator, markdown);
    return end(&s, markdown);
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
    {"markdown", NULL, NULL, "prints Markdown tables", .parse = cli_parse_flag,
     .offset = offsetof(settings, markdown)},
    {NULL, "TABLE", NULL, "systems or integrators; both when it is not given",
     .parse = cli_parse_text, .offset = offsetof(settings, table)},
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
    enum { OPTIONS = sizeof options / sizeof *options };
    settings s = {0};
    const cli_group group = {options, OPTIONS, .settings = &s};
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
        "nothing about D or the energy; '... D' names the constraints that are preserved to "
        "rounding on D = 0.  A modifier +WORD follows an integrator, NAME+WORD: rk4+project.  "
        "'as NAME' means the properties of NAME.  'adaptive' takes --tolerance.\n",
    .run = list,
};
