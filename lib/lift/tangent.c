/* tangent.c - the tangent systems of a model.
 *
 *     q'' = F(q, v, t, k)      dq'' = dF = F_q dq + F_v dv + F_k      (F_k: by one parameter, or 0)
 *
 * as one system of the coordinates Q = (q, dq); of vakonomic motion also g' = G, dg' = dG with the
 * derivatives F_g dg of both, and no lift.  Its canonical lift, with the momenta named
 * P = (dp, p), Pi = (dpi, pi) and the effort Pi.K~ Pi = 2 dpi.K pi + pi.dK pi, has
 *
 *     H~ = P.V + Pi.(F, dF) + Pi.K~ Pi/(2e) = dH,    H = p.v + pi.F + pi.K pi/(2e)
 *
 * so that its equations are the equations of (q, v, p, pi) and their derivatives along
 * (dq, dv, dp, dpi) and by k: T(T*M) = T*(TM) (Tulczyjew 1976).  What a method does to the lifted
 * space of this system is therefore the tangent map of what it does to the lifted space of the
 * other: second derivatives of F and derivatives of K come from the gradients of Pi.(F, dF) and of
 * Pi.K~ Pi, which every system has. */
#include "core/settings.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/motion.h"
#include "model/programs.h"
#include <stdlib.h>

/* The direction of the derivative. */
typedef struct direction {
    dal__equations *e;
    int count;        /* of these */
    int *symbol;      /* q, v, g, and the parameter where there is one */
    dal__node *along; /* dq, dv, dg, 1 */
} direction;

static dal__node differentiate(const direction *d, dal__node f)
{
    return dal__tangent(d->e->graph, f, d->symbol, d->count, d->along);
}

/* K~ Pi = (K pi, K dpi + dK pi), and the derivatives of Pi.K~ Pi/2 by Q and V. */
static void add_effort(dal_model *model, const direction *d, dal__tangent_system *t)
{
    dal__equations *e = d->e;
    dal__graph *graph = e->graph;
    const int n = e->n;
    dal__node *out = dal__model_nodes(model, 6 * n, 0), *push = dal__model_nodes(model, 3 * n, 0);
    dal__node *pi = dal__model_nodes(model, n, 0);
    if (model->out_of_memory) return;
    for (int i = 0; i < n; i++) {
        push[i] = dal__symbol(graph, e->pi + i);
        pi[i] = dal__symbol(graph, e->pi + n + i);
    }
    if (model->effort != DAL_EFFORT_IDENTITY) dal__motion_effort(model, model->effort, push);
    dal__node sum = dal__number(graph, 0.0);
    const dal__node half = dal__number(graph, 0.5);
    for (int i = 0; i < n; i++) {
        /* K dpi is linear in the symbols of dpi: its derivative along pi is K pi. */
        const dal__node K_pi = dal__tangent(graph, push[i], e->symbol + e->pi, n, pi);
        const dal__node dK_pi = differentiate(d, K_pi);
        const dal__node product = dal__node_mul(graph, dal__symbol(graph, e->pi + i), K_pi);
        sum = dal__node_add(graph, sum, product);
        sum = dal__node_add(graph, sum,
                            dal__node_mul(graph, half, dal__node_mul(graph, pi[i], dK_pi)));
        out[i] = K_pi;
        out[n + i] = dal__node_add(graph, push[i], dK_pi);
    }
    dal__gradient(graph, sum, e->symbol + e->q, 2 * n, out + 2 * n);
    dal__gradient(graph, sum, e->symbol + e->v, 2 * n, out + 4 * n);
    for (int i = 0; i < 2 * n; i++)
        if (dal__depends(graph, out[i], e->v, e->v + 2 * n))
            t->system.properties |= DAL_EFFORT_OF_V;
    if (t->system.properties & DAL_EFFORT_OF_V) t->system.properties &= ~(unsigned)DAL_F_POSITIONAL;
    dal__programs_add(model, &t->programs, DAL__PROGRAM_EFFORT, out, 6 * n);
}

static void add_programs(dal_model *model, int parameter, dal__tangent_system *t)
{
    dal__equations *e = &model->equations;
    const int n = e->n, m = e->multipliers, count = 2 * n + m;
    const struct {
        int symbol, count;
    } kinds[] = {{e->q, n}, {e->v, n}, {e->g, m}};
    dal__node *F = dal__model_nodes(model, 2 * (n + m), 0),
              *start = dal__model_nodes(model, 2 * count + 1, 0);
    direction d = {.e = e, .count = count + (parameter >= 0)};
    d.symbol = dal__model_allocate(model, (size_t)count + 1, sizeof *d.symbol);
    d.along = dal__model_nodes(model, count + 1, dal__number(e->graph, 1.0));
    if (model->out_of_memory) return;
    d.symbol[count] = parameter; /* the symbols of parameters are the first */
    for (int k = 0, at = 0; k < 3; k++)
        for (int i = 0; i < kinds[k].count; i++, at++) {
            d.symbol[at] = kinds[k].symbol + i;
            d.along[at] = dal__symbol(e->graph, kinds[k].symbol + kinds[k].count + i);
        }
    start[2 * count] = e->start[count];
    for (int k = 0, at = 0; k < 3; at += kinds[k++].count)
        for (int i = 0; i < kinds[k].count; i++) {
            const int place = 2 * at + i;
            start[place] = e->start[at + i];
            start[place + kinds[k].count] = differentiate(&d, e->start[at + i]);
            if (k == 0) continue;
            F[place - 2 * n] = e->F[at - n + i];
            F[place - 2 * n + kinds[k].count] = differentiate(&d, e->F[at - n + i]);
        }
    dal__programs_begin(model, &t->programs, 2 * n, 2 * m);
    dal__programs_add_motion(model, &t->programs, F);
    dal__programs_add_diagnosis(model, &t->programs);
    dal__programs_add(model, &t->programs, DAL__PROGRAM_START, start, 2 * count + 1);
    if (m > 0) return;
    if (e->mu && !e->mu_gradient)
        dal__programs_add(model, &t->programs, DAL__PROGRAM_GAUGE, &e->mu, 1);
    add_effort(model, &d, t);
}

static dal_status make_tangent(dal_model *model, int parameter, dal__tangent_system *t)
{
    const dal__equations *e = &model->equations;
    const char **names = dal__model_allocate(model, 2 * (size_t)e->n, sizeof *names);
    char *name = parameter < 0 ? dal__model_print(model, "%s, tangent", model->name)
                               : dal__model_print(model, "%s, tangent by %s", model->name,
                                                  e->parameter[parameter]);
    for (int i = 0; names && i < e->n; i++) {
        names[i] = e->coordinate[i];
        names[e->n + i] = dal__model_print(model, "dq_%s", e->coordinate[i]);
    }
    t->system = (dal_system){.name = name,
                             .title = model->system.title,
                             .reference = model->system.reference,
                             .n = 2 * e->n,
                             .multipliers = 2 * e->multipliers,
                             .parameters = e->parameters,
                             .properties = e->properties & (DAL_AUTONOMOUS | DAL_F_POSITIONAL),
                             .coordinate = names,
                             .parameter = e->parameter,
                             .value = e->value,
                             .effort = model->effort,
                             .gauge = e->mu_gradient ? NULL : e->gauge};
    add_programs(model, parameter, t);
    return dal__programs_finish(model, &t->programs, &t->system);
}

/* The start has a formula, and e does not depend on the parameter; -1: there is none. */
static dal_status check_parameter(dal_model *model, int parameter, dal_error *error)
{
    const dal__equations *e = &model->equations;
    const dal__node fixed[] = {e->mu, e->start[2 * e->n + e->multipliers]};
    bool depends = false;
    if (parameter < 0) return DAL_STATUS_OK;
    for (int i = 0; i < 2; i++)
        depends =
            depends || (fixed[i] && dal__depends(e->graph, fixed[i], parameter, parameter + 1));
    if (depends)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the gauge depends on parameter %.80s, and derivatives by it are at "
                         "constant e",
                         e->parameter[parameter]);
    if (e->solved_coordinates + e->solved_velocities == 0) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                     "the start is solved from its constraints: its derivative by parameter %.80s "
                     "has no formula",
                     e->parameter[parameter]);
}

/* The system by a parameter, -1: by none. */
static dal_status find_tangent(dal_model *model, int parameter, const dal_system **system,
                               dal_error *error)
{
    const size_t count = 1 + (size_t)model->equations.parameters;
    dal__tangent_system ***list = &model->tangent;
    model->out_of_memory = false;
    if (!*list) *list = dal__model_allocate(model, count, sizeof **list);
    dal__tangent_system **made = *list ? *list + 1 + parameter : NULL;
    if (made && !*made) *made = dal__model_allocate(model, 1, sizeof **made);
    if (model->out_of_memory) return dal__memory_error(error);
    if (!(*made)->made) {
        dal_status status = check_parameter(model, parameter, error);
        if (status == DAL_STATUS_OK)
            status = dal__check_size(make_tangent(model, parameter, *made), error);
        DAL_TRY(dal__model_conclude(model, status, error));
    }
    (*made)->made = true;
    *system = &(*made)->system;
    return DAL_STATUS_OK;
}

dal_status dal_model_tangent(dal_model *model, const dal_system **system, dal_error *error)
{
    const dal_system *plain;
    DAL_REQUIRE(system, error);
    *system = NULL;
    DAL_REQUIRE(model, error);
    DAL_TRY(dal_model_system(model, &plain, error));
    return find_tangent(model, -1, system, error);
}

dal_status dal_model_tangent_by(dal_model *model, const char *parameter, const dal_system **system,
                                dal_error *error)
{
    DAL_REQUIRE(system, error);
    *system = NULL;
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(parameter, error);
    const dal_system *plain;
    int k;
    DAL_TRY(dal_model_system(model, &plain, error));
    DAL_TRY(dal__find_parameter(plain, parameter, &k, error));
    return find_tangent(model, k, system, error);
}
