/* potential.c - what a discrete gradient of the potential is made of, block by block.
 *
 *     L = v.Wv/2 + g(q).v - U(q),   W constant
 *
 * Coordinates that U_qq or W couple form a block; U is the sum of functions U_B of one block each.
 * Every coordinate gets those of its block: U_B up to a constant, U_B,q.v and v.W_B v.  Blocks
 * apart keep what they have apart.  Where U_B is quadratic its gradient at the midpoint is a
 * discrete gradient already: such a block has U_B = 0 here. */
#include "model/mechanics.h"

typedef struct blocks {
    dal_model *model;
    int *block;        /* [n] the block of a coordinate: its first member */
    dal__node U, *U_q; /* [n] */
    dal__node *row;    /* [n] scratch */
    dal__node *other;  /* [n] by what q is replaced */
} blocks;

static void join(const blocks *b, int i, int j)
{
    const int n = b->model->equations.n, from = b->block[j], to = b->block[i];
    for (int k = 0; k < n; k++)
        if (b->block[k] == from) b->block[k] = to;
}

static void find_blocks(const blocks *b)
{
    const dal__equations *e = &b->model->equations;
    for (int i = 0; i < e->n; i++) b->block[i] = i;
    for (int i = 0; i < e->n; i++)
        for (int j = 0; j < e->n; j++) {
            const int q = e->q + j;
            const bool couples = dal__depends(e->graph, b->U_q[i], q, q + 1);
            if (couples || !dal__is_number(e->graph, e->W[i * e->n + j], 0.0)) join(b, i, j);
        }
}

static bool is_quadratic(const blocks *b, int block)
{
    const dal__equations *e = &b->model->equations;
    for (int i = 0; i < e->n; i++) {
        if (b->block[i] != block) continue;
        dal__gradient(e->graph, b->U_q[i], e->symbol + e->q, e->n, b->row);
        for (int j = 0; j < e->n; j++)
            if (dal__depends(e->graph, b->row[j], e->q, e->q + e->n)) return false;
    }
    return true;
}

/* U with the coordinates of all other blocks at their start. */
static dal__node restrict_to(const blocks *b, int block)
{
    const dal__equations *e = &b->model->equations;
    for (int i = 0; i < e->n; i++)
        b->other[i] = b->block[i] == block ? dal__symbol(e->graph, e->q + i) : e->start[i];
    return dal__substitute(e->graph, b->U, e->symbol + e->q, e->n, b->other);
}

/* v.W_B v */
static dal__node square(const blocks *b, int block)
{
    const dal__equations *e = &b->model->equations;
    dal__node sum = dal__number(e->graph, 0.0);
    for (int i = 0; i < e->n; i++) {
        if (b->block[i] != block) continue;
        dal__node momentum = dal__dot(e->graph, e->n, e->W + i * e->n, e->flow + 1);
        sum = dal__add(e->graph, sum, dal__mul(e->graph, e->flow[1 + i], momentum));
    }
    return sum;
}

static void fill_block(const blocks *b, int block, dal__node *out)
{
    const dal__equations *e = &b->model->equations;
    const int n = e->n;
    const bool quadratic = is_quadratic(b, block);
    dal__node zero = dal__number(e->graph, 0.0), power = zero;
    for (int i = 0; i < n && !quadratic; i++)
        if (b->block[i] == block)
            power = dal__add(e->graph, power, dal__mul(e->graph, b->U_q[i], e->flow[1 + i]));
    dal__node U = quadratic ? zero : restrict_to(b, block), size = square(b, block);
    for (int i = 0; i < n; i++) {
        if (b->block[i] != block) continue;
        out[i] = U;
        out[n + i] = power;
        out[2 * n + i] = size;
    }
}

/* L is a polynomial of degree 2 in v: U is what remains of -L without v. */
static dal__node potential_of(const blocks *b)
{
    const dal__equations *e = &b->model->equations;
    for (int i = 0; i < e->n; i++) b->row[i] = dal__number(e->graph, 0.0);
    return dal__neg(e->graph,
                    dal__substitute(e->graph, e->lagrangian, e->symbol + e->v, e->n, b->row));
}

static dal__node *take(dal_model *model, int count)
{
    return dal__model_take(model, (size_t)count, sizeof(dal__node));
}

dal_status dal__potential(dal_model *model)
{
    dal__equations *e = &model->equations;
    e->potential = NULL;
    if (e->vakonomic || !e->energy || !(e->properties & DAL_MASS_CONSTANT)) return DAL_OK;
    blocks b = {.model = model};
    dal__node *out = take(model, 3 * e->n);
    b.block = dal__model_take(model, (size_t)e->n, sizeof *b.block);
    b.U_q = take(model, e->n);
    b.row = take(model, e->n);
    b.other = take(model, e->n);
    if (model->starved) return DAL_MEMORY;
    b.U = potential_of(&b);
    dal__gradient(e->graph, b.U, e->symbol + e->q, e->n, b.U_q);
    find_blocks(&b);
    for (int i = 0; i < e->n; i++)
        if (b.block[i] == i) fill_block(&b, i, out);
    e->potential = out;
    return e->graph->status;
}
