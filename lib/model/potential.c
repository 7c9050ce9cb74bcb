/* potential.c - the terms of a discrete gradient of the potential, block by block.
 *
 *     L = v.Wv/2 + g(q).v - U(q),   W constant
 *
 * Coordinates that U_qq or W couple form a block; U is the sum of functions U_B of one block each.
 * The outputs of a coordinate are those of its block: U_B up to a constant, U_B,q.v and v.W_B v.
 * So each block preserves what it would preserve alone.  Where U_B is quadratic its gradient at the
 * midpoint is a discrete gradient already: such a block has U_B = 0 here. */
#include "model/potential.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/model.h"

typedef struct blocks {
    dal_model *model;
    int *block;        /* [n] the block of a coordinate: its first member */
    dal__node U, *U_q; /* [n] */
    dal__node *row;    /* [n] scratch */
    dal__node *other;  /* [n] by what q is replaced */
} blocks;

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

static void fill_block(const blocks *b, int block, dal__node *out)
{
    const dal__equations *e = &b->model->equations;
    const int n = e->n;
    const bool quadratic = is_quadratic(b, block);
    dal__node zero = dal__number(e->graph, 0.0), power = zero;
    for (int i = 0; i < n && !quadratic; i++)
        if (b->block[i] == block)
            power =
                dal__node_add(e->graph, power, dal__node_mul(e->graph, b->U_q[i], e->flow[1 + i]));
    dal__node U = zero;
    for (int i = 0; i < n && !quadratic;
         i++) /* the coordinates of all other blocks at their start */
        b->other[i] = b->block[i] == block ? dal__symbol(e->graph, e->q + i) : e->start[i];
    if (!quadratic) U = dal__substitute(e->graph, b->U, e->symbol + e->q, n, b->other);
    dal__node size = dal__number(e->graph, 0.0); /* v.W_B v */
    for (int i = 0; i < n; i++) {
        if (b->block[i] != block) continue;
        dal__node momentum = dal__dot(e->graph, n, e->W + i * n, e->flow + 1);
        size = dal__node_add(e->graph, size, dal__node_mul(e->graph, e->flow[1 + i], momentum));
    }
    for (int i = 0; i < n; i++) {
        if (b->block[i] != block) continue;
        out[i] = U;
        out[n + i] = power;
        out[2 * n + i] = size;
    }
}

dal_status dal__potential(dal_model *model)
{
    dal__equations *e = &model->equations;
    e->potential = NULL;
    if (e->vakonomic || !e->energy || !(e->properties & DAL_MASS_CONSTANT)) return DAL_OK;
    blocks b = {.model = model};
    dal__node *out = dal__model_nodes(model, 3 * e->n, 0);
    b.block = dal__model_allocate(model, (size_t)e->n, sizeof *b.block);
    b.U_q = dal__model_nodes(model, e->n, 0);
    b.row = dal__model_nodes(model, e->n, dal__number(e->graph, 0.0));
    b.other = dal__model_nodes(model, e->n, 0);
    if (model->out_of_memory) return DAL_MEMORY;
    /* L is a polynomial of degree 2 in v: U is what remains of -L without v. */
    b.U = dal__node_neg(e->graph,
                        dal__substitute(e->graph, e->lagrangian, e->symbol + e->v, e->n, b.row));
    dal__gradient(e->graph, b.U, e->symbol + e->q, e->n, b.U_q);
    for (int i = 0; i < e->n; i++) b.block[i] = i;
    for (int i = 0; i < e->n * e->n; i++) {
        const int q = e->q + i % e->n;
        const bool couples = dal__depends(e->graph, b.U_q[i / e->n], q, q + 1) ||
                             !dal__is_number(e->graph, e->W[i], 0.0);
        const int from = b.block[i % e->n], to = couples ? b.block[i / e->n] : from;
        for (int k = 0; k < e->n; k++) b.block[k] = b.block[k] == from ? to : b.block[k];
    }
    for (int i = 0; i < e->n; i++)
        if (b.block[i] == i) fill_block(&b, i, out);
    e->potential = out;
    return e->graph->status;
}
