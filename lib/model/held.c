/* held.c - the branches of F, which a step of a run with events may hold.
 *
 * A branch is an argument s and the values at which the nodes that it decides switch: 0, the whole
 * numbers for floor(s), the points of a table.  Nodes of -s belong to the branch of s.
 *
 * Of each branch there are programs for s, for sqrt(sum (ds/dx x)^2) over x = t, q, v, of which the
 * rounding of s is a multiple of eps, and for ds/dt along the motion. */
#include "model/held.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include <math.h>
#include <stdlib.h>

dal__node dal__switch_argument(dal__graph *graph, dal__node node)
{
    const dal__record r = dal__inspect(graph, node);
    if (r.fixed) return 0;
    switch ((dal__op)r.op) {
    case DAL__ABS:
    case DAL__SIGN:
    case DAL__FLOOR:
    case DAL__TABLE:
        return r.a;
    case DAL__LESS:
    case DAL__LESS_EQUAL:
    case DAL__MIN:
    case DAL__MAX:
        return dal__node_sub(graph, r.a, r.b);
    default:
        return 0;
    }
}

/* The branch of a node; sign: 1 where both have one argument, -1 opposite ones; false: none. */
static bool find_branch(dal__graph *graph, dal__node node, dal__switch_point *branch, int *sign)
{
    const dal__record r = dal__inspect(graph, node);
    const dal__node s = dal__switch_argument(graph, node);
    *branch = (dal__switch_point){s, DAL__BRANCH_AT_ZERO};
    *sign = 1;
    if (s == 0) return false;
    if (r.op == DAL__FLOOR) branch->table = DAL__BRANCH_AT_INTEGERS;
    if (r.op == DAL__TABLE) branch->table = r.symbol / DAL__TABLE_ORDERS;
    if (branch->table != DAL__BRANCH_AT_ZERO) return true;
    const dal__node opposite = dal__node_neg(graph, s);
    if (opposite < s) branch->argument = opposite, *sign = -1;
    return true;
}

/* ---- programs ---- */

/* Lets the programs of a step, and of the rates of events, hold their nodes. */
static void let_hold(dal__programs *p)
{
#define CODE(code, ...) DAL__PROGRAM_##code,
    static const dal__program_code codes[] = {DAL_CALLBACK_LIST(CODE) DAL__PROGRAM_PROJECTION,
                                              DAL__PROGRAM_EVENT_RATES, DAL__PROGRAM_BRANCH_VALUES,
                                              DAL__PROGRAM_BRANCH_RATES};
#undef CODE
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++)
        if (p->program[codes[i]].present) dal__tapes_let_hold(p->tapes, p->program[codes[i]].tape);
}

/* Marks all nodes of the programs that hold. [alloc] */
static uint8_t *mark_nodes(dal_model *model, const dal__programs *p, dal__node *last)
{
    int count = 0;
    for (int i = 0; i < p->tapes->count; i++)
        count += p->tapes->tape[i].may_hold ? p->tapes->tape[i].outputs : 0;
    dal__node *outputs = dal__model_nodes(model, count + 1, 0);
    if (!outputs) return NULL;
    count = 0;
    for (int i = 0; i < p->tapes->count; i++) {
        const dal__tape *tape = &p->tapes->tape[i];
        for (int k = 0; tape->may_hold && k < tape->outputs; k++)
            outputs[count++] = tape->output[k];
    }
    *last = dal__last_of(outputs, count);
    return dal__reach_all(model->equations.graph, outputs, count);
}

/* The number of a branch among those found, from 0; how many these are: it is a new one. */
static int branch_number(const dal__programs *p, const dal__switch_point *branch)
{
    int k = 0;
    while (k < p->branches.count &&
           (p->branch[k].argument != branch->argument || p->branch[k].table != branch->table))
        k++;
    return k;
}

/* Finds the branches of the programs that hold. */
static void find_branches(dal_model *model, dal__programs *p)
{
    dal__graph *graph = model->equations.graph;
    dal__node last;
    dal__switch_point branch;
    int nodes = 0, sign;
    uint8_t *mark = mark_nodes(model, p, &last);
    for (dal__node i = 1; mark && i <= last; i++)
        nodes += mark[i] && find_branch(graph, i, &branch, &sign);
    p->branch = dal__model_allocate(model, (size_t)nodes + 1, sizeof *p->branch);
    for (dal__node i = 1; mark && p->branch && i <= last; i++) {
        if (!mark[i] || !find_branch(graph, i, &branch, &sign)) continue;
        const int k = branch_number(p, &branch);
        p->branch[k] = branch;
        if (k == p->branches.count) p->branches.count++;
    }
    free(mark);
}

/* sqrt(sum (ds/dx x)^2). */
static dal__node argument_size(const dal__equations *e, dal__node s, dal__node *slope)
{
    const int count = e->pi - e->t;
    dal__node sum = dal__number(e->graph, 0.0);
    dal__gradient(e->graph, s, e->symbol + e->t, count, slope);
    for (int i = 0; i < count; i++) {
        const dal__node x = dal__symbol(e->graph, e->t + i);
        const dal__node term = dal__node_mul(e->graph, slope[i], x);
        sum = dal__node_add(e->graph, sum, dal__node_mul(e->graph, term, term));
    }
    return dal__apply(e->graph, DAL__SQRT, sum, 0);
}

static void add_programs(dal_model *model, dal__programs *p)
{
    const dal__equations *e = &model->equations;
    const int count = p->branches.count;
    dal__node *values = dal__model_nodes(model, 2 * count, 0);
    dal__node *rates = dal__model_nodes(model, count, 0);
    dal__node *slope = dal__model_nodes(model, e->pi - e->t, 0);
    const dal__node *F = p->tapes->tape[p->program[DAL__PROGRAM_FIELD].tape].output;
    if (model->out_of_memory) return;
    for (int k = 0; k < count; k++) {
        const dal__node s = p->branch[k].argument;
        const dal__node by_v = dal__tangent(e->graph, s, e->symbol + e->v, e->n, F);
        const dal__node by_g =
            dal__tangent(e->graph, s, e->symbol + e->g, e->multipliers, F + e->n);
        values[k] = s;
        values[count + k] = argument_size(e, s, slope);
        rates[k] = dal__node_add(e->graph, dal__time_derivative(e, s),
                                 dal__node_add(e->graph, by_v, by_g));
    }
    dal__programs_add(model, p, DAL__PROGRAM_BRANCH_VALUES, values, 2 * count);
    dal__programs_add(model, p, DAL__PROGRAM_BRANCH_RATES, rates, count);
}

/* Gives the tapes the point of each node. */
static void place_points(dal_model *model, dal__programs *p)
{
    dal__graph *graph = model->equations.graph;
    dal__node last;
    dal__switch_point branch;
    int sign;
    uint8_t *mark = mark_nodes(model, p, &last);
    for (dal__node i = 1; mark && i <= last; i++)
        if (mark[i]) find_branch(graph, i, &branch, &sign); /* makes all nodes that it needs */
    dal__held_point *point = dal__model_allocate(model, (size_t)graph->count + 1, sizeof *point);
    for (dal__node i = 1; mark && point && i <= last; i++) {
        if (!mark[i] || !find_branch(graph, i, &branch, &sign)) continue;
        const int k = branch_number(p, &branch);
        point[i] = k < p->branches.count ? sign * (k + 1) : 0;
    }
    p->tapes->points = p->branches.count;
    p->tapes->point = point;
    free(mark);
}

void dal__programs_add_branches(dal_model *model, dal__programs *programs)
{
    if (model->out_of_memory) return; /* there may be no tapes */
    let_hold(programs);
    find_branches(model, programs);
    if (programs->branches.count == 0) return;
    add_programs(model, programs);
    let_hold(programs);
    place_points(model, programs);
}
