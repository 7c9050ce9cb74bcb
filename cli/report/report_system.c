/* report_system.c - what moves, and how, as a list on a page, and the command for it. */
#include "report_system.h"
#include "dalembert_codegen.h"
#include "dalembert_program.h"
#include "run/request_command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the system ---------------------------------------------------------------------------- */

const char *report_model_title(const dal_model *model, const char *otherwise)
{
    const char *title =
        model ? dal_model_text(model, DAL_SECTION_TITLE, 0, NULL, NULL, NULL) : NULL;
    return title ? title : otherwise;
}

void report_fact(FILE *page, const char *name, const char *text)
{
    report_element(page, "dt", name);
    report_element(page, "dd", text);
    fputc('\n', page);
}

/* The equations of a model as MathML; false: they cannot be typeset, and nothing is written. */
static bool typeset_equations(FILE *page, dal_model *model)
{
    char *equations;
    const dal_status status = dal_model_mathml(model, &equations, NULL);
    if (status == DAL_STATUS_MEMORY) cli_out_of_memory();
    if (status != DAL_STATUS_OK) return false;
    fprintf(page, "<div class=\"equations\" tabindex=\"0\">%s</div>\n", equations);
    free(equations);
    return true;
}

void report_folded_equations(FILE *page, dal_model *model)
{
    fputs("<details><summary>Equations</summary>\n", page);
    if (!typeset_equations(page, model)) report_element(page, "p", "They cannot be typeset.");
    fputs("</details>\n", page);
}

/* The formulas of a section, each with what comes before its name and after its text. */
static void write_formulas(FILE *page, const dal_model *model, dal_section section,
                           const char *heading, const char *prefix, const char *suffix)
{
    const char *text, *name;
    for (int i = 0; (text = dal_model_text(model, section, i, &name, NULL, NULL)) != NULL; i++) {
        if (i == 0) report_element(page, "dt", heading);
        fprintf(page, "<dd><code>%s", prefix);
        if (name && name[0]) report_text(page, name);
        fputs((name && name[0]) || prefix[0] ? " = " : "", page);
        report_text(page, text);
        fprintf(page, "%s</code></dd>\n", suffix);
    }
}

static const dal_setting *find_setting(const request_settings *settings, const char *name)
{
    for (int i = 0; i < settings->count; i++)
        if (strcmp(settings->item[i].name, name) == 0) return &settings->item[i];
    return NULL;
}

static bool is_number(const char *text, double x)
{
    double value;
    return dal__parse_number(text, strlen(text), &value) == DAL_STATUS_OK && value == x;
}

/* "m = 1, v0 = 0.1 instead of 1", then what the request alone has. */
static void write_settings(FILE *page, const dal_model *model, dal_section section,
                           const char *heading, const request_settings *settings)
{
    static const char solve[] = "solve."; /* velocities that a start solves, without a text */
    const char *text, *name;
    int count = 0;
    for (int i = 0; (text = dal_model_text(model, section, i, &name, NULL, NULL)) != NULL; i++) {
        const dal_setting *given = find_setting(settings, name);
        if (given && is_number(text, given->value)) given = NULL;
        if (count++ == 0) report_element(page, "dt", heading);
        fputs(count > 1 ? ", <code>" : "<dd><code>", page);
        const bool is_solved =
            section == DAL_SECTION_START && strncmp(name, solve, sizeof solve - 1) == 0;
        report_text(page, is_solved ? name + sizeof solve - 1 : name);
        fputs(is_solved ? " from D = 0" : " = ", page);
        if (given) fprintf(page, "%.12g</code> instead of <code>", given->value);
        report_text(page, text);
        fputs("</code>", page);
    }
    for (int k = 0; k < settings->count; k++) {
        bool is_in_model = false;
        for (int i = 0; dal_model_text(model, section, i, &name, NULL, NULL); i++)
            is_in_model |= strcmp(name, settings->item[k].name) == 0;
        if (is_in_model) continue;
        if (count++ == 0) report_element(page, "dt", heading);
        fputs(count > 1 ? ", <code>" : "<dd><code>", page);
        report_text(page, settings->item[k].name);
        fprintf(page, " = %.12g</code>", settings->item[k].value);
    }
    if (count > 0) fputs("</dd>\n", page);
}

/* L, Q, D and F typeset, or as the file has them where that fails. */
static void write_equations(FILE *page, dal_model *model)
{
    report_element(page, "dt", "equations");
    fputs("<dd>", page);
    const bool are_typeset = typeset_equations(page, model);
    fputs("</dd>\n", page);
    if (are_typeset) return;
    write_formulas(page, model, DAL_SECTION_LAGRANGIAN, "Lagrangian", "L", "");
    write_formulas(page, model, DAL_SECTION_ACCELERATIONS, "accelerations", "", "");
    write_formulas(page, model, DAL_SECTION_CONSTRAINTS, "constraints", "", " = 0");
    write_formulas(page, model, DAL_SECTION_HOLONOMIC, "holonomic", "", " = 0");
    write_formulas(page, model, DAL_SECTION_FORCES, "forces", "Q_", "");
}

void report_system(FILE *page, dal_model *model, const run_request *request)
{
    const char *reference = dal_model_text(model, DAL_SECTION_REFERENCE, 0, NULL, NULL, NULL);
    write_equations(page, model);
    write_formulas(page, model, DAL_SECTION_REACTIONS, "reactions", "B", "");
    write_formulas(page, model, DAL_SECTION_CONTROLS, "controls", "C", "");
    write_formulas(page, model, DAL_SECTION_LET, "where", "", "");
    write_formulas(page, model, DAL_SECTION_FUNCTIONS, "functions", "", "");
    write_formulas(page, model, DAL_SECTION_MECHANICS, "mechanics", "", "");
    write_formulas(page, model, DAL_SECTION_GAUGE, "gauge", "", "");
    write_settings(page, model, DAL_SECTION_PARAMETERS, "parameters", &request->set);
    write_settings(page, model, DAL_SECTION_START, "start", &request->start);
    if (reference) report_fact(page, "source", reference);
}

/* ---- the method ---------------------------------------------------------------------------- */

/* "gauss4+project, of order 4: Gauss-Legendre, 2 stages; after each step back to D = 0" */
static void write_method(FILE *page, const char *name)
{
    dal_method method;
    if (dal_method_parse(&method, name, NULL) != DAL_STATUS_OK) {
        report_fact(page, "method", name);
        return;
    }
    report_element(page, "dt", "method");
    fputs("<dd>", page);
    report_text(page, name);
    fprintf(page, ", order %d", dal_method_order(&method));
    for (int i = 0; i < DAL_LAYERS && method.layer[i]; i++) {
        fputs(i ? "; " : ": ", page);
        report_text(page, method.layer[i]->summary);
    }
    fputs("</dd>\n", page);
}

void report_method(FILE *page, const run_request *request)
{
    const char *const *text = request->text;
    if (text[REQUEST_integrator]) write_method(page, text[REQUEST_integrator]);
    if (text[REQUEST_step]) report_fact(page, "step h", text[REQUEST_step]);
    if (text[REQUEST_time]) report_fact(page, "time T", text[REQUEST_time]);
    for (int i = 0; i < REQUEST_system; i++)
        if (text[i] && i != REQUEST_integrator && i != REQUEST_step && i != REQUEST_time &&
            i != REQUEST_set && i != REQUEST_start)
            report_fact(page, request_options[i].name, text[i]);
}

/* ---- angles -------------------------------------------------------------------------------- */

static bool continues_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* Where a name is in a text before its end, as a word of its own and not as a velocity. */
static const char *find_name(const char *text, const char *end, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = text; (at = strstr(at, name)) != NULL && at + length <= end; at++)
        if ((at == text || !continues_name(at[-1])) && !continues_name(at[length]) &&
            at[length] != '\'')
            return at;
    return NULL;
}

/* Whether a name is in the brackets of a function. */
static bool is_argument(const char *text, const char *function, const char *name)
{
    const char *open = text;
    while ((open = find_name(open, open + strlen(open), function)) != NULL) {
        open += strlen(function);
        if (*open != '(') continue;
        const char *close = open;
        for (int depth = 1; *++close && depth > 0;) depth += (*close == '(') - (*close == ')');
        if (find_name(open + 1, close, name)) return true;
    }
    return false;
}

static bool is_phase(const dal_model *model, dal_section section, const char *name)
{
    const char *text;
    for (int i = 0; (text = dal_model_text(model, section, i, NULL, NULL, NULL)) != NULL; i++)
        if (is_argument(text, "sin", name) || is_argument(text, "cos", name) ||
            is_argument(text, "tan", name))
            return true;
    return false;
}

bool report_is_angle(const dal_model *model, const char *coordinate)
{
    static const char *const letters[] = {"alpha", "beta", "gamma", "theta", "phi", "psi"};
    static const dal_section sections[] = {DAL_SECTION_LET,         DAL_SECTION_LAGRANGIAN,
                                           DAL_SECTION_CONSTRAINTS, DAL_SECTION_ACCELERATIONS,
                                           DAL_SECTION_FORCES,      DAL_SECTION_PICTURE};
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++) {
        const size_t length = strlen(letters[i]);
        if (strncmp(coordinate, letters[i], length) == 0 &&
            coordinate[length + strspn(coordinate + length, "_0123456789")] == '\0')
            return true;
    }
    for (size_t k = 0; k < sizeof sections / sizeof *sections; k++)
        if (is_phase(model, sections[k], coordinate)) return true;
    return false;
}

/* ---- the command --------------------------------------------------------------------------- */

void report_command(report *r, const run_request *request)
{
    FILE *page = r->page;
    report_heading(r, "again", "How to make it again");
    char *command = request_format_command(request, "run", request->system_name, 0);
    fputs("<pre tabindex=\"0\">", page);
    report_text(page, command);
    free(command);
    fputs(" --output DIR</pre>\n", page);
}
