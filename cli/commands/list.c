/* list.c - `dalembert list`: the built-in systems, integrators and modifiers.
 *
 * What is listed is selected first, and then written as tables or as JSON. */
#include "dalembert_evaluator.h"
#include "dalembert_method.h"
#include "io/json.h"
#include "io/text.h"
#include "run/system.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"
#include "ui/table.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct settings {
    const char *table, *tag;
    long long order;
    int preserves; /* a row of invariants; -1: any */
    bool markdown, is_long, json;
    int width; /* what the tables fit into; 0: any */
} settings;

/* Without a word the first two are listed. */
enum { SYSTEMS, INTEGRATORS, LISTED, MODIFIERS = LISTED, UNITS, TABLES };

/* What is listed. */
typedef struct selection {
    bool has[TABLES];
    int systems, integrators;
    const char *name[CLI_MAX_BUILTINS]; /* [systems] */
    dal_model *model[CLI_MAX_BUILTINS];
    const dal_system *system[CLI_MAX_BUILTINS];
    const dal_integrator *integrator[CLI_MAX_BUILTINS]; /* [integrators] */
} selection;

/* ---- systems ------------------------------------------------------------------------------- */

/* The class of D; NULL without constraints. */
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
    if (system->m == 0) return NULL;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (system->properties & kinds[i].property) return kinds[i].text;
    return "nonlinear";
}

/* NULL where none is known. */
static const char *energy(const dal_system *system)
{
    if (!system->energy) return NULL;
    if (system->properties & DAL_E_EXACT) return "conserved";
    return system->properties & DAL_E_ON_D ? "conserved on D = 0" : "not conserved";
}

static bool has_tag(const dal_system *system, const char *tag)
{
    for (int i = 0; i < system->tags; i++)
        if (strcmp(system->tag[i], tag) == 0) return true;
    return false;
}

static int select_systems(selection *list, const settings *s)
{
    const char *name;
    for (int i = 0; list->systems < CLI_MAX_BUILTINS && (name = dal_builtin_name(i)); i++) {
        const int k = list->systems;
        const int status = cli_load(name, &(cli_choices){0}, &list->model[k], &list->system[k]);
        if (status != CLI_DONE) return status;
        list->name[k] = name;
        if (!s->tag || has_tag(list->system[k], s->tag))
            list->systems++;
        else
            dal_model_free(list->model[k]);
    }
    return CLI_DONE;
}

static void end_table(cli_table *table, const settings *s)
{
    if (s->markdown)
        cli_table_print_markdown(table);
    else if (s->width > 0 && !s->is_long)
        cli_table_print_short(table, s->width);
    else
        cli_table_print_long(table, s->width);
    cli_table_free(table);
}

static const char *or_none(const char *text) { return text ? text : "-"; }

static void add_system(cli_table *t, const char *name, const dal_system *system, const settings *s)
{
    const char *tick = s->markdown ? "`" : "", *title = system->title ? system->title : "";
    char *tags = NULL;
    for (int i = 0; s->is_long && i < system->tags; i++)
        tags = text_append_item(tags, ", ", system->tag[i]);
    cli_table_append(t, "%s%s%s\t%d\t%d\t%s\t%s\t%s\t%s%s%s", tick, name, tick, system->n,
                     system->m, or_none(kind(system)), or_none(energy(system)),
                     system->exact ? "yes" : "-", title, s->is_long ? "\t" : "",
                     s->is_long ? or_none(tags) : "");
    free(tags);
}

static void print_systems(const selection *list, const settings *s)
{
    cli_table table = {.text = 6};
    cli_table_append(&table, "system\tn\tm\tD\tenergy\texact\ttitle%s", s->is_long ? "\ttags" : "");
    for (int i = 0; i < list->systems; i++) add_system(&table, list->name[i], list->system[i], s);
    end_table(&table, s);
}

static void put_words(json_writer *w, const char *name, const char *const *words, int count)
{
    json_open_list(w, name, JSON_ON_ONE_LINE);
    for (int i = 0; i < count; i++) json_put_text(w, NULL, words[i]);
    json_close(w);
}

static void put_system(json_writer *w, const char *name, const dal_system *system)
{
    json_open(w, NULL, JSON_LINES);
    json_put_text(w, "system", name);
    json_put_text(w, "title", system->title);
    json_put_text(w, "reference", system->reference);
    put_words(w, "coordinates", system->coordinate, system->n);
    json_put_integer(w, "constraints", system->m);
    json_put_text(w, "constraint_class", kind(system));
    json_put_text(w, "energy", energy(system));
    json_put_bool(w, "exact", system->exact != NULL);
    json_open(w, "parameters", JSON_ON_ONE_LINE);
    for (int i = 0; i < system->parameters; i++)
        json_put_number(w, system->parameter[i], system->value[i]);
    json_close(w);
    put_words(w, "invariants", system->invariant, system->invariants);
    put_words(w, "tags", system->tag, system->tags);
    json_close(w);
}

static void put_systems(json_writer *w, const selection *list)
{
    for (int i = 0; i < list->systems; i++) put_system(w, list->name[i], list->system[i]);
}

/* ---- integrators --------------------------------------------------------------------------- */

typedef struct property {
    unsigned code;
    const char *text;
    unsigned implied_by;
    const char *word; /* of --preserves; NULL: the text */
} property;

static const property qualities[] = {{DAL_EXPLICIT, "explicit", 0, NULL},
                                     {DAL_SYMMETRIC, "symmetric", 0, NULL},
                                     {DAL_SYMPLECTIC, "symplectic lift", 0, NULL},
                                     {DAL_PERSISTENT_MULTIPLIER, "persistent multipliers", 0, NULL},
                                     {DAL_ADAPTIVE, "adaptive", 0, NULL},
                                     {0, NULL, 0, NULL}};
static const char PRESERVED[] =
    "bilinear|quadratic|every|midpoints|energy|holonomic"; /* words for the rows */
static const property invariants[] = {
    {DAL_PRESERVES_BILINEAR, "bilinear D", DAL_PRESERVES_QUADRATIC | DAL_PRESERVES_D, "bilinear"},
    {DAL_PRESERVES_QUADRATIC, "quadratic D", DAL_PRESERVES_D, "quadratic"},
    {DAL_PRESERVES_D, "every D", 0, "every"},
    {DAL_PRESERVES_D_MIDPOINT, "D at midpoints", 0, "midpoints"},
    {DAL_PRESERVES_ENERGY, "energy", 0, "energy"},
    {DAL_PRESERVES_HOLONOMIC, "g", 0, "holonomic"},
    {0, NULL, 0, NULL}};

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
    const bool has_modifiers_alone = s->table && strcmp(s->table, "modifiers") == 0;
    if (has_modifiers_alone && !(k->properties & DAL_MODIFIER)) return false;
    if (s->order > 0 && k->order != s->order) return false;
    if (s->preserves < 0) return true;
    const property *p = &invariants[s->preserves];
    return (k->properties & (p->code | p->implied_by)) != 0;
}

static void add_integrator(cli_table *t, const dal_integrator *k, const settings *s)
{
    const bool is_short = s->width > 0 && !s->is_long && !s->markdown;
    const char *tick = s->markdown ? "`" : "", *plus = k->properties & DAL_MODIFIER ? "+" : "";
    char alias[LINE] = "", order[16] = "-", is[LINE], preserves[LINE];
    if (k->alias && !is_short)
        snprintf(alias, sizeof alias, ", %s%s%s%s", tick, plus, k->alias, tick);
    if (k->order) snprintf(order, sizeof order, "%d", k->order);
    cli_table_append(t, "%s%s%s%s%s\t%s\t%s\t%s\t%s\t%s", tick, plus, k->name, tick, alias, order,
                     list_properties(is, k, qualities), list_properties(preserves, k, invariants),
                     k->summary, k->reference);
}

static int select_integrators(selection *list, const settings *s)
{
    const dal_integrator *k;
    for (int modifiers = 0; modifiers < 2; modifiers++)
        for (int i = 0; list->integrators < CLI_MAX_BUILTINS && (k = dal_integrator_at(i)); i++)
            if (!(k->properties & DAL_MODIFIER) == !modifiers && is_selected(k, s))
                list->integrator[list->integrators++] = k;
    return CLI_DONE;
}

static void print_integrators(const selection *list, const settings *s)
{
    cli_table table = {.text = 4};
    cli_table_append(&table, "integrator\torder\tproperties\tpreserves\twhat it is\treference");
    for (int i = 0; i < list->integrators; i++) add_integrator(&table, list->integrator[i], s);
    end_table(&table, s);
}

static void put_properties(json_writer *w, unsigned codes, const property *p)
{
    for (; p->text; p++)
        if (codes & p->code) json_put_text(w, NULL, p->word ? p->word : p->text);
}

static void put_integrators(json_writer *w, const selection *list)
{
    for (int i = 0; i < list->integrators; i++) {
        const dal_integrator *k = list->integrator[i];
        json_open(w, NULL, JSON_LINES);
        json_put_text(w, "integrator", k->name);
        json_put_text(w, "alias", k->alias);
        json_put_bool(w, "is_modifier", (k->properties & DAL_MODIFIER) != 0);
        json_put_number(w, "order", k->order ? k->order : NAN);
        json_open_list(w, "properties", JSON_ON_ONE_LINE);
        put_properties(w, k->properties, qualities);
        json_close(w);
        json_open_list(w, "preserves", JSON_ON_ONE_LINE);
        put_properties(w, k->properties, invariants);
        json_close(w);
        json_open_list(w, "inherits", JSON_ON_ONE_LINE);
        put_properties(w, k->inherits, qualities);
        put_properties(w, k->inherits, invariants);
        json_close(w);
        json_put_text(w, "summary", k->summary);
        json_put_text(w, "reference", k->reference);
        json_put_text(w, "documentation", k->documentation);
        json_close(w);
    }
}

/* ---- units --------------------------------------------------------------------------------- */

/* The units of a system at its start: of time, then of each coordinate. */
static double *find_units(const dal_system *system)
{
    dal_scaled *scaled = NULL;
    const dal_run_spec spec = {.system = system, .options = dal_options_default()};
    const size_t bytes = (1 + (size_t)system->n) * sizeof(double);
    double *units = cli_calloc(1, bytes);
    for (int i = 0; i <= system->n; i++) units[i] = NAN;
    if (cli_is_ok(dal_scaled_create(&scaled, &spec, NULL)))
        memcpy(units, dal_scaled_units(scaled), bytes);
    dal_scaled_free(scaled);
    return units;
}

static void print_units(const selection *list, const settings *s)
{
    cli_table table = {.text = 2};
    cli_table_append(&table, "system\ttime\tcoordinates");
    for (int i = 0; i < list->systems; i++) {
        const dal_system *system = list->system[i];
        const char *tick = s->markdown ? "`" : "";
        double *units = find_units(system);
        char *lengths = NULL;
        for (int k = 0; k < system->n; k++) {
            char *length = cli_format("%s %.10g", system->coordinate[k], units[1 + k]);
            lengths = text_append_item(lengths, ", ", length);
            free(length);
        }
        cli_table_append(&table, "%s%s%s\t%.10g\t%s", tick, list->name[i], tick, units[0], lengths);
        free(lengths);
        free(units);
    }
    end_table(&table, s);
}

static void put_units(json_writer *w, const selection *list)
{
    for (int i = 0; i < list->systems; i++) {
        const dal_system *system = list->system[i];
        double *units = find_units(system);
        json_open(w, NULL, JSON_LINES);
        json_put_text(w, "system", list->name[i]);
        json_put_number(w, "time", units[0]);
        json_open(w, "coordinates", JSON_ON_ONE_LINE);
        for (int k = 0; k < system->n; k++) json_put_number(w, system->coordinate[k], units[1 + k]);
        json_close(w);
        json_close(w);
        free(units);
    }
}

/* ---- the command --------------------------------------------------------------------------- */

static const struct {
    const char *name, *filters;
    int (*select)(selection *list, const settings *s);
    void (*print)(const selection *list, const settings *s);
    void (*put)(json_writer *w, const selection *list);
} tables[TABLES] = {{"systems", "--tag selects", select_systems, print_systems, put_systems},
                    {"integrators", "--order and --preserves select", select_integrators,
                     print_integrators, put_integrators},
                    {"modifiers", "--order and --preserves select", select_integrators,
                     print_integrators, put_integrators},
                    {"units", "--tag selects", select_systems, print_units, put_units}};

static const cli_option options[] = {
    {"long", NULL, NULL, "prints everything, on a terminal too; also tags of systems",
     CLI_FLAG(settings, is_long)},
    {"tag", "TAG", NULL, "lists the systems with this tag", CLI_TEXT(settings, tag)},
    {"order", "N", NULL, "lists the integrators of this order",
     CLI_INTEGER(settings, order, 1, 100)},
    {"preserves", PRESERVED, NULL, "lists the integrators that preserve this",
     CLI_WORD(settings, preserves)},
    {"markdown", NULL, NULL, "prints Markdown tables", CLI_FLAG(settings, markdown)},
    JSON_OPTION(settings),
    {NULL, "TABLE", NULL,
     "systems, integrators, modifiers or units; the first two when it is not given",
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
static int select_tables(selection *list, const settings *s)
{
    const bool has_tag = s->tag != NULL, has_kind = s->order > 0 || s->preserves >= 0;
    const bool is_of_systems[TABLES] = {[SYSTEMS] = true, [UNITS] = true};
    int status = s->table ? check_table(s->table) : CLI_DONE;
    for (int i = 0; i < TABLES && status == CLI_DONE; i++) {
        const bool is_named = s->table && strcmp(s->table, tables[i].name) == 0;
        const bool is_filtered = is_of_systems[i] ? has_tag : has_kind;
        const bool is_wanted = i < LISTED && (is_filtered || has_tag == has_kind);
        const int other = is_of_systems[i] ? INTEGRATORS : SYSTEMS;
        if (is_named && (is_of_systems[i] ? has_kind : has_tag))
            return cli_fail(CLI_USAGE, "list %s: %s %s", s->table, tables[other].filters,
                            tables[other].name);
        list->has[i] = s->table ? is_named : is_wanted;
        if (list->has[i]) status = tables[i].select(list, s);
    }
    bool is_empty = false;
    for (int i = 0; i < TABLES; i++)
        is_empty |= list->has[i] && (is_of_systems[i] ? list->systems : list->integrators) == 0;
    if (status != CLI_DONE || !is_empty) return status;
    return cli_fail(CLI_USAGE, "list: nothing matches; 'dalembert list --long' shows orders, "
                               "what is preserved, and tags");
}

static void print_tables(const selection *list, const settings *s)
{
    const char *separator = "";
    for (int i = 0; i < TABLES; i++) {
        if (!list->has[i]) continue;
        fputs(separator, stdout);
        tables[i].print(list, s);
        separator = "\n";
    }
}

static void put_tables(const selection *list, const settings *s)
{
    json_writer w = json_begin_results("list");
    json_open(&w, "request", JSON_ON_ONE_LINE);
    json_put_text(&w, "table", s->table);
    json_put_text(&w, "tag", s->tag);
    json_put_number(&w, "order", s->order > 0 ? (double)s->order : NAN);
    json_put_text(&w, "preserves", s->preserves < 0 ? NULL : invariants[s->preserves].word);
    json_close(&w);
    for (int i = 0; i < TABLES; i++) {
        if (i >= LISTED && !list->has[i]) continue;
        json_open_list(&w, tables[i].name, JSON_LINES);
        if (list->has[i]) tables[i].put(&w, list);
        json_close(&w);
    }
    json_end_results(&w);
}

enum { MAX_NAMES = 100 };

/* The names alone, on a terminal. */
static int print_names(const selection *list)
{
    const char *integrator[2][MAX_NAMES];
    int count[2] = {0};
    for (int i = 0; i < list->integrators; i++) {
        const dal_integrator *k = list->integrator[i];
        const int kind = (k->properties & DAL_MODIFIER) != 0;
        if (count[kind] < MAX_NAMES) integrator[kind][count[kind]++] = k->name;
    }
    const struct {
        const char *head, *more;
        const char *const *names;
        int count;
    } lists[] = {{"Systems", "list systems", list->name, list->systems},
                 {"Integrators", "list integrators", integrator[0], count[0]},
                 {"Modifiers, as in rk4+project", "list modifiers", integrator[1], count[1]}};
    screen s;
    screen_open(&s, stdout, SCREEN_TEXT);
    for (int i = 0; i < 3; i++) {
        char *names = screen_list_names(lists[i].names, lists[i].count, MAX_NAMES * MAX_NAMES);
        screen_say(&s, 2, "%s (dalembert %s):", lists[i].head, lists[i].more);
        screen_say(&s, 2, "  %s", names);
        free(names);
    }
    return screen_close(&s, "list systems, list integrators");
}

static int list(int argc, char **argv)
{
    settings s = {.preserves = -1, .width = cli_output_width()};
    selection selected = {.systems = 0};
    const cli_option_set set = CLI_OPTION_SET(options, &s);
    int status = cli_read_arguments(&command_list, argc, argv, &set, 1);
    if (status != CLI_GO_ON) return status;
    if (s.json && s.markdown) return cli_fail(CLI_USAGE, "list: --json excludes --markdown");
    status = select_tables(&selected, &s);
    const bool is_plain = !s.table && !s.tag && !s.order && s.preserves < 0 && !s.is_long &&
                          !s.json && !s.markdown && !getenv("COLUMNS");
    if (status == CLI_DONE && is_plain && screen_has_reader()) {
        status = print_names(&selected);
    } else if (status == CLI_DONE) {
        (s.json ? put_tables : print_tables)(&selected, &s);
        status = cli_close(stdout, "standard output");
    }
    for (int i = 0; i < selected.systems; i++) dal_model_free(selected.model[i]);
    return status;
}

const cli_command command_list = {
    .name = "list",
    .synopsis = "dalembert list [systems|integrators|modifiers|units] [OPTION]...",
    .about = "lists the built-in systems and their units, integrators and modifiers",
    .notes =
        "Systems: n coordinates, m constraints D; the class of D as a function of (q,v); whether "
        "the motion conserves the energy E = L_v.v - L; whether an exact solution is known.\n"
        "\n"
        "Integrators: 'symplectic lift' concerns the 4n+2 canonical variables only and implies "
        "nothing about D or the energy; '... D' names the constraints, 'energy' the energy, that "
        "are preserved to rounding on D = 0.  A modifier +WORD follows an integrator, NAME+WORD: "
        "rk4+project.  'as NAME' means the properties of NAME.  'adaptive' takes --tolerance.\n"
        "\n"
        "Units: the time and the lengths by which the program compares numbers of a system, powers "
        "of "
        "two that follow from its motion near the start.\n"
        "\n"
        "A terminal gets the names alone where no TABLE is given.  On a terminal, or where the "
        "environment has COLUMNS, tables have the columns that fit, "
        "and one name for each integrator.  Otherwise they are complete; --long adds the tags.  "
        "--preserves bilinear also lists what preserves quadratic D, and both list what preserves "
        "every D.\n",
    .run = list,
};
