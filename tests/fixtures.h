/* fixtures.h - systems and runs the suites share. */
#ifndef FIXTURES_H
#define FIXTURES_H

#include <dalembert.h>
#include <dalembert_analysis.h>
#include <stdbool.h>

/* Time-dependent and velocity-dependent forces, a full mass matrix that depends on q, m = 2 with
 * one constraint nonlinear in v: what a method claims must hold here. */
extern const char fixture_full[];
/* The same features, but weak: methods of high order reach their asymptotic range before rounding.
 */
extern const char fixture_gentle[];
/* D with constant coefficients; D bilinear in (q,v); D quadratic in v; all conservative. */
extern const char fixture_constant[], fixture_bilinear[], fixture_quadratic[];

/* A model from YAML text or (no newline in it) a built-in name, which the caller frees; fails the
 * test when there is none. */
dal_model *fixture_model(const char *text);
/* The system of a model from YAML text or (no newline in it) a built-in name, and the system of its
 * tangent map; fails the test when there is none.  Equal texts have the same. */
const dal_system *fixture_system(const char *text);
const dal_system *fixture_tangent(const char *text);
void fixture_free(void); /* all of them, at the end */

/* A spec with default options; method by name. */
dal_run_spec fixture_spec(const dal_system *system, const char *method, dal_space space,
                          double step);
/* Whether a method declares that it can act on a system in a space. */
bool fixture_accepts(const dal_method *method, const dal_system *system, dal_space space);
/* A run of it; NULL and a failed test when it cannot be made. */
dal_run *fixture_run(const dal_run_spec *spec);

/* Advances a run to time T and calls happened, or nothing, after each event. */
dal_status fixture_events(dal_run *run, double T,
                          dal_status (*happened)(void *user, dal_run *run,
                                                 const dal_occurrence *event),
                          void *user, dal_error *error);
/* A run of it after some steps. */
dal_run *fixture_stepped(const dal_run_spec *spec, long long steps);
/* Each lane of a batch has after some steps the bits of a run by itself; lane i starts at
 * name = from + i*by. */
void fixture_lanes(dal_run_spec spec, int lanes, long long steps, const char *name, double from,
                   double by);
/* The status of the first step of a run, which fails and leaves everything as it was. */
dal_status fixture_failed_step(const dal_run_spec *spec, dal_error *error);
/* How far a step from a perturbed lifted state is from symplectic. */
double fixture_symplectic_defect(const dal_run_spec *spec);
/* H of the sleigh's lift is an integral of a run, and not 0: it stays over these steps, up to
 * rounding. */
void fixture_keeps_H(dal_run *run, long long steps);
/* An evaluator with the system's own parameters. */
dal_evaluator *fixture_evaluator(const dal_system *system);
/* The field of x'' = -x, for systems made by hand. */
dal_status fixture_oscillate(const dal_system *system, const dal_point *at, double *out);

/* A run of it is refused with this status and a message that has this fragment. */
void fixture_refused(const dal_run_spec *spec, dal_status status, const char *fragment);

/* Sets p_i and pi_i of a lifted run to a fixed pattern of the given size, at t = 0. */
void fixture_perturb(dal_run *run, double size);

/* The name of a method with integrator number i on its outside: itself, or a modifier around one it
 * can act on. */
const char *fixture_method(int i, char *name, size_t size);

/* Slope of the error in (q,v) at T, against gauss10 with 1500 steps, between two step counts; a
 * lifted run is displaced first. */
double fixture_order(dal_run_spec spec, double T, int coarse, int fine, double displacement);

/* Means of a spectrum; an exponent's lies in its interval. */
double fixture_exponent(const dal_lyapunov *s, int i);
double fixture_sum(const dal_lyapunov *s);
double fixture_divergence(const dal_lyapunov *s);

#endif
