/* body.c - see body.h. */
#include "body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void stop(const char *what, const dal_error *error)
{
    fprintf(stderr, "%s:%d:%d: %s\n", what, error->line, error->column, error->message);
    exit(2);
}

static void prepare(const body *b)
{
    dal_at at = {.work = b->work};
    b->system->prepare(b->system, &at, NULL);
}

static void take_work(body *b)
{
    size_t bytes = 64 * b->system->workspace * sizeof(double) + 64;
    b->work = aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (!b->work) exit(2);
    memset(b->work, 0, bytes);
    for (int i = 0; i < b->system->parameters; i++) b->work[i] = b->system->value[i];
    prepare(b);
}

static body finish(body b, const char *what)
{
    dal_error error = {.line = 0};
    if (dal_model_system(b.model, &b.system, &error) != DAL_OK) stop(what, &error);
    take_work(&b);
    return b;
}

body body_of_text(const char *yaml)
{
    body b = {.model = NULL};
    dal_error error = {.line = 0};
    if (dal_model_read(&b.model, "text", yaml, strlen(yaml), &error) != DAL_OK) stop(yaml, &error);
    return finish(b, yaml);
}

body body_builtin(const char *name)
{
    body b = {.model = NULL};
    dal_error error = {.line = 0};
    if (dal_model_builtin(&b.model, name, &error) != DAL_OK) stop(name, &error);
    return finish(b, name);
}

body body_tangent(const body *of)
{
    body b = {.model = NULL};
    dal_error error = {.line = 0};
    if (dal_model_tangent(of->model, &b.system, &error) != DAL_OK) stop("tangent", &error);
    take_work(&b);
    return b;
}

void body_free(body *b)
{
    dal_model_free(b->model);
    free(b->work);
}

void body_set(body *b, const char *parameter, double value)
{
    for (int i = 0; i < b->system->parameters; i++)
        if (strcmp(b->system->parameter[i], parameter) == 0) b->work[i] = value;
    prepare(b);
}

dal_status body_call(const body *b, dal_callback *call, double t, const double *q, const double *v,
                     double *out)
{
    dal_at at = {.t = t, .q = q, .v = v, .work = b->work};
    return call(b->system, &at, out);
}

dal_status body_pull(const body *b, double t, const double *q, const double *v, const double *pi,
                     double *out)
{
    dal_at at = {.t = t, .q = q, .v = v, .pi = pi, .work = b->work};
    return b->system->call.adjoint(b->system, &at, out);
}

void body_spread(int lanes, int count, const double *x, double *wide)
{
    for (int i = 0; i < count; i++)
        for (int l = 0; l < lanes; l++) wide[i * lanes + l] = x[i] + l / 16.0;
}

void body_pick(int lanes, int lane, int count, const double *wide, double *x)
{
    for (int i = 0; i < count; i++) x[i] = wide[i * lanes + lane];
}

/* ---- differences ---- */

enum { Q, V, T };
static const double h = 0.02;

typedef struct place {
    double q[BODY_MOST], v[BODY_MOST], t;
} place;

static double *component(place *p, int kind, int i)
{
    return kind == Q ? &p->q[i] : kind == V ? &p->v[i] : &p->t;
}

static place here(const double *q, const double *v, double t)
{
    place p = {.t = t};
    memcpy(p.q, q, sizeof p.q);
    memcpy(p.v, v, sizeof p.v);
    return p;
}

static double first(body_function *f, int index, place p, int kind, int i)
{
    static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double *x = component(&p, kind, i), x0 = *x, sum = 0.0;
    for (int k = 0; k < 4; k++) {
        *x = x0 + (k + 1) * h;
        double above = f(index, p.q, p.v, p.t);
        *x = x0 - (k + 1) * h;
        sum += weight[k] * (above - f(index, p.q, p.v, p.t));
    }
    return sum / h;
}

static double second(body_function *f, place p, int i, int kind, int j)
{
    static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double *x = component(&p, kind, j), x0 = *x, sum = 0.0;
    for (int k = 0; k < 4; k++) {
        *x = x0 + (k + 1) * h;
        double above = first(f, 0, p, V, i);
        *x = x0 - (k + 1) * h;
        sum += weight[k] * (above - first(f, 0, p, V, i));
    }
    return sum / h;
}

double body_by_q(body_function *f, int index, int i, const double *q, const double *v, double t)
{
    return first(f, index, here(q, v, t), Q, i);
}

double body_by_v(body_function *f, int index, int i, const double *q, const double *v, double t)
{
    return first(f, index, here(q, v, t), V, i);
}

double body_by_t(body_function *f, int index, const double *q, const double *v, double t)
{
    return first(f, index, here(q, v, t), T, 0);
}

double body_mass(const body_formulas *f, int i, int j, const double *q, const double *v, double t)
{
    return second(f->lagrangian, here(q, v, t), i, V, j);
}

double body_load(const body_formulas *f, int i, const double *q, const double *v, double t)
{
    place p = here(q, v, t);
    double b = first(f->lagrangian, 0, p, Q, i) - second(f->lagrangian, p, i, T, 0);
    for (int j = 0; j < f->n; j++) b -= second(f->lagrangian, p, i, Q, j) * v[j];
    return f->force ? b + f->force(i, q, v, t) : b;
}

double body_drift(const body_formulas *f, int a, const double *q, const double *v, double t)
{
    double c = body_by_t(f->constraint, a, q, v, t);
    for (int j = 0; j < f->n; j++) c += body_by_q(f->constraint, a, j, q, v, t) * v[j];
    return c;
}

/* ---- the motion ---- */

static void swap_rows(int columns, double *a, double *b)
{
    for (int j = 0; j < columns; j++) {
        double x = a[j];
        a[j] = b[j];
        b[j] = x;
    }
}

void body_solve(int n, double *a)
{
    int columns = n + 1;
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k; i < n; i++)
            if (fabs(a[i * columns + k]) > fabs(a[best * columns + k])) best = i;
        swap_rows(columns, a + k * columns, a + best * columns);
        for (int i = 0; i < n; i++) {
            double factor = i == k ? 0.0 : a[i * columns + k] / a[k * columns + k];
            for (int j = k; j < columns; j++) a[i * columns + j] -= factor * a[k * columns + j];
        }
    }
    for (int k = 0; k < n; k++) a[k * columns + n] /= a[k * columns + k];
}

void body_motion(const body_formulas *f, const double *q, const double *v, double t, double *F)
{
    int n = f->n, size = f->n + f->m, columns = size + 1;
    double a[2 * BODY_MOST * (2 * BODY_MOST + 1)] = {0.0};
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) a[i * columns + j] = body_mass(f, i, j, q, v, t);
        a[i * columns + size] = body_load(f, i, q, v, t);
    }
    for (int k = 0; k < f->m; k++) {
        for (int j = 0; j < n; j++) {
            double A = body_by_v(f->constraint, k, j, q, v, t);
            a[(n + k) * columns + j] = A;
            a[j * columns + n + k] = f->reaction ? -f->reaction(k * n + j, q, v, t) : -A;
        }
        a[(n + k) * columns + size] = -body_drift(f, k, q, v, t);
    }
    body_solve(size, a);
    for (int i = 0; i < n; i++) F[i] = a[i * columns + size];
}

double body_distance(int count, const double *a, const double *b)
{
    double distance = 0.0, scale = 1.0;
    for (int i = 0; i < count; i++) {
        double d = fabs(a[i] - b[i]);
        if (!(d <= distance)) distance = d; /* also when it is NaN */
        scale = fmax(scale, fabs(b[i]));
    }
    return distance / scale;
}
