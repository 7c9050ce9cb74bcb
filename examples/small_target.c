/* small_target.c - a stepper on a small target: formulas without YAML, a run in memory of its own.
 *
 *     make MINIMAL=1
 *     cc -Iinclude small_target.c build/minimal/libdalembert.a -lm -Wl,--gc-sections
 *
 * Chaplygin's sleigh by gauss4 with projection; prints t, q, v and the constraint D ten times on
 * the way to t = 10.  Its model is made once from formulas, which allocates; steps do not. */
#include <dalembert.h>
#include <stdio.h>

static int fail(const dal_error *error)
{
    fprintf(stderr, "small_target: %s: %s\n", dal_status_text(error->status), error->message);
    return 1;
}

static const struct {
    dal_section section;
    const char *name, *text;
} entries[] = {
    {DAL_SECTION_COORDINATES, NULL, "y1"},
    {DAL_SECTION_COORDINATES, NULL, "y2"},
    {DAL_SECTION_COORDINATES, NULL, "phi"},
    {DAL_SECTION_LAGRANGIAN, NULL, "(y1'^2 + y2'^2)/2 + phi'^2/2"},
    {DAL_SECTION_CONSTRAINTS, NULL, "y1'*sin(phi) - y2'*cos(phi)"},
    {DAL_SECTION_START, "y1'", "1"},
    {DAL_SECTION_START, "phi'", "1"},
};

int main(void)
{
    static double memory[4096]; /* dal_run_size says how many bytes a run needs */
    double seen[16];            /* the sleigh has fewer observables; D is the first */
    dal_run *run;
    dal_error error;
    dal_run_spec spec = {.options = dal_options_default()};
    spec.options.step = 0.01;
    spec.options.space = DAL_PHYSICAL;

    dal_model *model = dal_model_create("sleigh");
    for (size_t i = 0; i < sizeof entries / sizeof *entries; i++)
        if (dal_model_add(model, entries[i].section, entries[i].name, entries[i].text, 0, 0,
                          &error))
            return fail(&error);
    if (dal_model_system(model, &spec.system, &error)) return fail(&error);
    if (dal_method_parse(&spec.method, "gauss4+project", &error)) return fail(&error);
    if (dal_run_init(&run, memory, sizeof memory, &spec, &error)) return fail(&error);

    for (int row = 0; row < 10; row++) {
        if (dal_run_advance(run, 100, &error)) return fail(&error);
        if (dal_run_observe(run, seen)) return 1;
        printf("%.17g", dal_run_time(run));
        for (int i = 0; i < 2 * spec.system->n; i++) printf(" %.17g", dal_run_state(run)[i]);
        printf(" %.3g\n", seen[0]);
    }
    dal_model_free(model);
    return 0;
}
