/* contact_chain.c - 101 coordinates and a nonholonomic constraint, as C callbacks; the system is in
 * contact_chain.h.
 *
 *     cc contact_chain.c $(pkg-config --cflags --libs dalembert) -lm -o contact_chain
 *
 * Prints how far D, the energy E and, on the canonical space with nonzero p and pi, H have drifted
 * at t = 10; fails if D is not at rounding level, or E and H exceed the order of the method. */
#include "contact_chain.h"
#include <stdio.h>

enum { STEPS = 1000 };

/* Observable number i before and after STEPS steps: the larger of |b - a|, and |a| where it should
 * be zero.  Negative: the run failed. */
static double drift(const dal_run_spec *spec, int observable)
{
    dal_run *run;
    dal_error error;
    double before[8], after[8]; /* D, E; lifted also H and three norms */
    if (dal_run_create(&run, spec, &error) || dal_run_observe(run, before) ||
        dal_run_advance(run, STEPS, &error) || dal_run_observe(run, after)) {
        fprintf(stderr, "contact_chain: %s\n", error.message);
        return -1.0;
    }
    dal_run_free(run);
    return fabs(after[observable] - before[observable]);
}

int main(void)
{
    static const dal_setting momenta[] = {{"p_q3", 1e-3}, {"pi_q7", -2e-3}, {"e", INFINITY}};
    dal_run_spec spec = {.system = &chain_system, .options = dal_options_default()};
    spec.options.step = 0.01;
    spec.options.space = DAL_PHYSICAL;
    if (dal_method_parse(&spec.method, "gauss4+project", NULL)) return 1;
    const double D = drift(&spec, 0), E = drift(&spec, 1);

    spec.options.space = DAL_LIFTED;
    spec.start = momenta;
    spec.start_count = 3;
    if (dal_method_parse(&spec.method, "gauss4", NULL)) return 1;
    const double H = drift(&spec, 2);

    printf("D %.1e  E %.1e  H %.1e\n", D, E, H);
    return !(D >= 0.0 && D < 1e-13 && E >= 0.0 && E < 1e-9 && H >= 0.0 && H < 1e-12);
}
