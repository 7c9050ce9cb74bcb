/* every_method.c - each integrator of the library, alone and with +project, in both spaces.
 *
 * Prints name, status and exact state after some steps on a system of formulas; then the status of
 * a run in quad precision, and of a system with a holonomic constraint. */
#include <dalembert.h>
#include <stdio.h>

static const struct {
    dal_section section;
    const char *name, *text;
} entries[] = {
    {DAL_SECTION_COORDINATES, NULL, "x"},
    {DAL_SECTION_COORDINATES, NULL, "y"},
    {DAL_SECTION_COORDINATES, NULL, "phi"},
    {DAL_SECTION_LAGRANGIAN, NULL, "(x'^2 + y'^2)/2 + phi'^2/2 - x^2/3 - 1/(4 + y^2)"},
    {DAL_SECTION_CONSTRAINTS, NULL, "x'*sin(phi) - y'*cos(phi)"},
    {DAL_SECTION_START, "x'", "1"},
    {DAL_SECTION_START, "phi'", "0.7"},
};

static dal_status run_method(dal_run_spec *spec, const char *name)
{
    dal_run *run = NULL;
    dal_status status = dal_method_parse(&spec->method, name, NULL);
    if (status == DAL_STATUS_OK) status = dal_run_create(&run, spec, NULL);
    if (status == DAL_STATUS_OK) status = dal_run_advance(run, 20, NULL);
    printf("%s %s", name, dal_status_name(status));
    for (int i = 0; i < dal_run_dimension(run); i++) printf(" %a", dal_run_state(run)[i]);
    printf("\n");
    dal_run_free(run);
    return status;
}

int main(void)
{
    dal_run_spec spec = {.options = dal_options_default()};
    spec.options.step = 0.05;
    dal_model *model = dal_model_create("sleigh");
    for (size_t i = 0; i < sizeof entries / sizeof *entries; i++)
        if (dal_model_add(model, entries[i].section, entries[i].name, entries[i].text, 0, 0, NULL))
            return 1;
    if (dal_model_system(model, &spec.system, NULL)) return 1;
    for (int i = 0; dal_integrator_at(i); i++) {
        const dal_integrator *k = dal_integrator_at(i);
        char projected[80];
        if (k->properties & DAL_MODIFIER) continue;
        snprintf(projected, sizeof projected, "%s+project", k->name);
        for (int space = DAL_LIFTED; space <= DAL_PHYSICAL; space++) {
            spec.options.space = (dal_space)space;
            run_method(&spec, k->name);
            run_method(&spec, projected);
        }
    }
    spec.options.precision = DAL_QUAD;
    run_method(&spec, "rk4");
    dal_model_free(model);
    model = dal_model_create("pendulum");
    for (int i = 0; i < 2; i++)
        if (dal_model_add(model, DAL_SECTION_COORDINATES, NULL, i ? "y" : "x", 0, 0, NULL))
            return 1;
    if (dal_model_add(model, DAL_SECTION_LAGRANGIAN, NULL, "(x'^2 + y'^2)/2 - y", 0, 0, NULL) ||
        dal_model_add(model, DAL_SECTION_HOLONOMIC, NULL, "x^2 + y^2 - 1", 0, 0, NULL))
        return 1;
    printf("holonomic %s\n", dal_status_name(dal_model_system(model, &spec.system, NULL)));
    dal_model_free(model);
    return 0;
}
