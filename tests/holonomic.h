/* holonomic.h - systems with holonomic constraints for several suites. */
#ifndef TESTS_HOLONOMIC_H
#define TESTS_HOLONOMIC_H

#include "dalembert.h"
#include <CUnit/CUnit.h>
#include <math.h>

static const char pendulum[] = "coordinates: [x, y, z]\n"
                               "parameters: {l: 1.25, g: 2}\n"
                               "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g*z\n"
                               "holonomic: [x^2 + y^2 + z^2 - l^2]\n"
                               "start: {x: 0.75, z: -1, y': 1.5}\n";
/* The same in angles: x = l sin(a) cos(b), z = -l cos(a). */
#define PENDULUM_IN_ANGLES(g, a)                                                                   \
    "coordinates: [a, b]\nparameters: {l: 1.25, " g "}\n"                                          \
    "lagrangian: l^2/2*(a'^2 + sin(a)^2*b'^2) + g*l*cos(a)\nstart: {" a ", b': 2}\n"

/* Two runs at the same time, which it frees. */
static inline void compare_pendulums(dal_run *run, dal_run *angles)
{
    const double *q = dal_run_state(run), *a = dal_run_state(angles), l = 1.25;
    CU_ASSERT_DOUBLE_EQUAL(q[0], l * sin(a[0]) * cos(a[1]), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(q[1], l * sin(a[0]) * sin(a[1]), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(q[2], -l * cos(a[0]), 1e-12);
    dal_run_free(run);
    dal_run_free(angles);
}

/* A skate at r on a unit sphere, its blade along the unit tangent u: no velocity along r x u. */
static const char skate[] =
    "coordinates: [x, y, z, a, b, c]\n"
    "parameters: {J: 0.4, g: 0.7}\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 + J/2*(a'^2 + b'^2 + c'^2) - g*z\n"
    "constraints: [x'*(y*c - z*b) + y'*(z*a - x*c) + z'*(x*b - y*a)]\n"
    "holonomic: [x^2 + y^2 + z^2 - 1, a^2 + b^2 + c^2 - 1, x*a + y*b + z*c]\n"
    "start: {x: 1, b: 1, y': 0.8, a': -0.8, c': 0.9}\n";
/* Gyroscopic and velocity-dependent forces, a mass matrix of q, D nonlinear in v, g of t. */
static const char general[] =
    "coordinates: [x, y, z, u]\n"
    "lagrangian: (1 + x^2/4)/2*x'^2 + y'^2/2 + z'^2/2 + u'^2/2 + 0.3*(x*y' - y*x') - z - u^2/2\n"
    "forces: {u: -0.1*u' + 0.2*cos(t)}\n"
    "constraints: [u' - 0.5*x' - 0.1*y'^2]\n"
    "holonomic: [x^2 + y^2 + z^2 - (1 + 0.1*sin(t))^2]\n"
    "start: {x: 0.6, z: -0.8, x': 0.5, y': 0.4, z': 0.1, solve: [z', u']}\n";

/* The same with a constant W, and two D. */
static const char steady[] =
    "coordinates: [x, y, z, u, w]\n"
    "lagrangian: 0.65*x'^2 + (y'^2 + z'^2 + u'^2 + w'^2)/2 + 0.3*(x*y' - y*x') - z - u^2/2\n"
    "forces: {u: -0.1*u' + 0.2*cos(t)}\n"
    "constraints: [u' - 0.5*x' - 0.1*y'^2, w' - z*x' - 0.3*u']\n"
    "holonomic: [x^2 + y^2 + z^2 - (1 + 0.1*sin(t))^2]\n"
    "start: {x: 0.6, z: -0.8, x': 0.5, y': 0.4, z': 0.1, solve: [z', u', w']}\n";

#endif
