/* reference.c - see reference.h. */
#include "reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void stop(const char *what, const dal_error *error)
{
    fprintf(stderr, "%s:%d:%d: %s\n", what, error->line, error->column, error->message);
    exit(2);
}

static void prepare(const reference *b)
{
    dal_point at = {.work = b->work};
    b->system->prepare(b->system, &at, NULL);
}

static void take_work(reference *b)
{
    size_t bytes = 64 * b->system->workspace * sizeof(double) + 64;
    b->work = aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (!b->work) exit(2);
    memset(b->work, 0, bytes);
    for (int i = 0; i < b->system->parameters; i++) b->work[i] = b->system->value[i];
    prepare(b);
}

static reference finish(reference b, const char *what)
{
    dal_error error = {.line = 0};
    if (dal_model_system(b.model, &b.system, &error) != DAL_STATUS_OK) stop(what, &error);
    take_work(&b);
    return b;
}

reference reference_of_text(const char *yaml)
{
    reference b = {.model = NULL};
    dal_error error = {.line = 0};
    if (dal_model_read(&b.model, "text", yaml, strlen(yaml), &error) != DAL_STATUS_OK)
        stop(yaml, &error);
    return finish(b, yaml);
}

reference reference_builtin(const char *name)
{
    reference b = {.model = NULL};
    dal_error error = {.line = 0};
    if (dal_model_builtin(&b.model, name, &error) != DAL_STATUS_OK) stop(name, &error);
    return finish(b, name);
}

reference reference_tangent(const reference *of)
{
    reference b = {.model = NULL};
    dal_error error = {.line = 0};
    if (dal_model_tangent(of->model, &b.system, &error) != DAL_STATUS_OK) stop("tangent", &error);
    take_work(&b);
    return b;
}

void reference_free(reference *b)
{
    dal_model_free(b->model);
    free(b->work);
}

void reference_set(reference *b, const char *parameter, double value)
{
    for (int i = 0; i < b->system->parameters; i++)
        if (strcmp(b->system->parameter[i], parameter) == 0) b->work[i] = value;
    prepare(b);
}

dal_status reference_call(const reference *b, dal_callback *call, double t, const double *q,
                          const double *v, double *out)
{
    dal_point at = {.t = t, .q = q, .v = v, .work = b->work};
    return call(b->system, &at, out);
}

dal_status reference_pull(const reference *b, double t, const double *q, const double *v,
                          const double *pi, double *out)
{
    dal_point at = {.t = t, .q = q, .v = v, .pi = pi, .work = b->work};
    return b->system->call.adjoint(b->system, &at, out);
}

void reference_scatter(int lanes, int count, const double *x, double *wide)
{
    for (int i = 0; i < count; i++)
        for (int l = 0; l < lanes; l++) wide[i * lanes + l] = x[i] + l / 16.0;
}

void reference_gather(int lanes, int lane, int count, const double *wide, double *x)
{
    for (int i = 0; i < count; i++) x[i] = wide[i * lanes + lane];
}

/* ---- differences ---- */

enum { Q, V, T };
static const double h = 0.02;

typedef struct place {
    double q[REFERENCE_MAX], v[REFERENCE_MAX], t;
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

static double first(reference_function *f, int index, place p, int kind, int i)
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

static double second(reference_function *f, place p, int i, int kind, int j)
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

double reference_by_q(reference_function *f, int index, int i, const double *q, const double *v,
                      double t)
{
    return first(f, index, here(q, v, t), Q, i);
}

double reference_by_v(reference_function *f, int index, int i, const double *q, const double *v,
                      double t)
{
    return first(f, index, here(q, v, t), V, i);
}

double reference_by_t(reference_function *f, int index, const double *q, const double *v, double t)
{
    return first(f, index, here(q, v, t), T, 0);
}

double reference_mass(const reference_formulas *f, int i, int j, const double *q, const double *v,
                      double t)
{
    return second(f->lagrangian, here(q, v, t), i, V, j);
}

double reference_load(const reference_formulas *f, int i, const double *q, const double *v,
                      double t)
{
    place p = here(q, v, t);
    double b = first(f->lagrangian, 0, p, Q, i) - second(f->lagrangian, p, i, T, 0);
    for (int j = 0; j < f->n; j++) b -= second(f->lagrangian, p, i, Q, j) * v[j];
    return f->force ? b + f->force(i, q, v, t) : b;
}

double reference_drift(const reference_formulas *f, int a, const double *q, const double *v,
                       double t)
{
    double c = reference_by_t(f->constraint, a, q, v, t);
    for (int j = 0; j < f->n; j++) c += reference_by_q(f->constraint, a, j, q, v, t) * v[j];
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

void reference_solve(int n, double *a)
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

void reference_motion(const reference_formulas *f, const double *q, const double *v, double t,
                      double *F)
{
    int n = f->n, size = f->n + f->m, columns = size + 1;
    double a[2 * REFERENCE_MAX * (2 * REFERENCE_MAX + 1)] = {0.0};
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) a[i * columns + j] = reference_mass(f, i, j, q, v, t);
        a[i * columns + size] = reference_load(f, i, q, v, t);
    }
    for (int k = 0; k < f->m; k++) {
        for (int j = 0; j < n; j++) {
            double A = reference_by_v(f->constraint, k, j, q, v, t);
            a[(n + k) * columns + j] = A;
            a[j * columns + n + k] = f->reaction ? -f->reaction(k * n + j, q, v, t) : -A;
        }
        a[(n + k) * columns + size] = -reference_drift(f, k, q, v, t);
    }
    reference_solve(size, a);
    for (int i = 0; i < n; i++) F[i] = a[i * columns + size];
}

double reference_distance(int count, const double *a, const double *b)
{
    double distance = 0.0, scale = 1.0;
    for (int i = 0; i < count; i++) {
        double d = fabs(a[i] - b[i]);
        if (!(d <= distance)) distance = d; /* also when it is NaN */
        scale = fmax(scale, fabs(b[i]));
    }
    return distance / scale;
}

/* ---- a system ---- */

double reference_full_lagrangian(int i, const double *q, const double *v, double t)
{
    (void)i;
    return (1 + q[0] * q[0]) * v[0] * v[0] / 2 + v[0] * v[1] * cos(q[2]) / 3 + v[1] * v[1] +
           v[2] * v[2] / 2 + q[0] * v[2] * t - q[0] * q[1] * q[2];
}

double reference_full_force(int i, const double *q, const double *v, double t)
{
    (void)q;
    return i == 1 ? -v[0] / 4 : i == 2 ? sin(t) : 0.0;
}
