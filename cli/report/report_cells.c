/* report_cells.c - the cells of a study, and the quantities that its tables and figures show. */
#include "report_cells.h"
#include "io/file.h"
#include "io/text.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int read_steps(csv_table *csv, const char *path)
{
    const int status = csv_table_read(csv, path);
    if (status == CLI_DONE) csv_table_append(csv, "step", "tolerance");
    return status;
}

double step_tolerance(const char *step)
{
    char *end;
    strtod(step, &end);
    return strtod(end, NULL);
}

const char *step_title(char title[STUDY_DIVISION], const char *step)
{
    return study_division(title, strtod(step, NULL), step_tolerance(step));
}

const char *get_cell(const study_page *s, int row, const char *head)
{
    return csv_table_get(&s->cells, row, head);
}

bool is_cell(const study_page *s, int row, const char *head, const char *text)
{
    return csv_table_is(&s->cells, row, head, text);
}

const quantity quantities[REPORT_QUANTITIES] = {
    {"D", "D_max", "D_size", "D_trend", "D", "Constraints", "max |D|", "Constraints: max |D|",
     ON_SURFACE},
    {"E", "E_deviation", "E_size", "E_trend", "E", "Energy", "max |E - E(0)|",
     "Energy: max |E − E(0)|", ON_SURFACE},
    {"invariants", "invariant_deviation", "invariant_size", "invariant_trend", "I", "Invariants",
     "max |I - I(0)| / max(1, |I(0)|)",
     "Invariants of the systems: max |I − I(0)|, the largest of each", ON_SURFACE},
    {"H", "H_deviation", "H_size", "H_trend", "H", "H, started off p = pi = 0", "max |H - H(0)|",
     "Hamiltonian of the lift: max |H − H(0)|, started off p = π = 0", DISPLACED},
    {"error", "error_max", NULL, NULL, "error", "Error", "max |q - exact|", NULL, ON_SURFACE},
};

/* On p = pi = 0 the lifted run has the bits of the physical one: where there is no physical run,
 * either will do. */
static const char *const starts[][2] = {{"physical", "surface"}, {"displaced", "displaced"}};

bool is_shown(const study_page *s, int row, const quantity *t)
{
    const char *const *start = starts[t->start];
    return is_cell(s, row, "start", start[0]) || is_cell(s, row, "start", start[1]);
}

int find_cell(const study_page *s, const char *label, const char *method, const char *step,
              cell_start start)
{
    int found = 0;
    for (int row = 1; row < s->cells.rows; row++) {
        if (!is_cell(s, row, "label", label) || !is_cell(s, row, "step", step) ||
            !is_cell(s, row, "integrator", method) || is_cell(s, row, "state", "refused"))
            continue;
        if (is_cell(s, row, "start", starts[start][0])) return row;
        if (is_cell(s, row, "start", starts[start][1])) found = row;
    }
    return found;
}

int check_cell_names(const study_page *s, const char *path, int row)
{
    static const char runs[] = "runs/";
    const char *label = get_cell(s, row, "label"), *run = get_cell(s, row, "run");
    const bool is_run = strncmp(run, runs, sizeof runs - 1) == 0;
    if (!text_is_file_name(label))
        return cli_fail(CLI_USAGE, "%s:%d: the label '%s' cannot name a file", path, row + 1,
                        label);
    if (!run[0] || (is_run && text_is_file_name(run + sizeof runs - 1))) return CLI_DONE;
    return cli_fail(CLI_USAGE, "%s:%d: the run '%s' is no directory of the study", path, row + 1,
                    run);
}

int read_label_model(const study_page *s, const char *label, dal_model **model)
{
    int row = 1;
    *model = NULL;
    while (!is_cell(s, row, "label", label)) row++;
    const char *system = get_cell(s, row, "system");
    for (int i = 1; i < s->cells.rows; i++) {
        if (!is_cell(s, i, "system", system)) continue;
        char *copy = cli_format("%s/systems/%s.yaml", s->r->directory, get_cell(s, i, "label"));
        const bool is_found = file_exists(copy);
        const int status = is_found ? cli_read(copy, model) : CLI_DONE;
        free(copy);
        if (is_found) return status;
    }
    return dal_builtin_text(system) ? cli_read(system, model) : CLI_DONE;
}
