/* potential.c - the terms of a discrete gradient of the potential, block by block.
 *
 *     L = v.Wv/2 + g(q).v - U(q),   W constant
 *
 * Coordinates that U_qq or W couple form a block; U is the sum of functions U_B of one block each.
 * A coordinate has the outputs of its block: U_B up to a constant, U_B,q.v and v.W_B v.
 * So each block preserves what it would preserve alone.  Where U_B is quadratic its gradient at the
 * midpoint is a discrete gradient already: such a block has U_B = 0 here. */
#include "model/potential.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/model.h"
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

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
        if (dal__reaches(e->graph, b->U_q[i], DAL__ROUGH)) return false;
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
    const dal__node zero = dal__number(e->graph, 0.0);
    dal__node U = zero, power = zero, size = zero; /* size: v.W_B v */
    if (!is_quadratic(b, block)) {
        for (int i = 0; i < n; i++) { /* the coordinates of all other blocks at their start */
            const bool inside = b->block[i] == block;
            b->other[i] = inside ? dal__symbol(e->graph, e->q + i) : e->start[i];
            if (!inside) continue;
            dal__node term = dal__node_mul(e->graph, b->U_q[i], e->flow[1 + i]);
            power = dal__node_add(e->graph, power, term);
        }
        U = dal__substitute(e->graph, b->U, e->symbol + e->q, n, b->other);
    }
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

/* Joins the blocks of all coordinates that U_q of coordinate i or its row of W contains; where W is
 * restricted, those that a constraint couples, too: one alone may have no kinetic energy. */
static void couple(const blocks *b, int i)
{
    const dal__equations *e = &b->model->equations;
    uint8_t *mark = dal__reach(e->graph, b->U_q[i]);
    for (int j = 0; j < e->n; j++) {
        const dal__node q = dal__find_symbol(e->graph, e->q + j);
        bool contains = !mark || (q && q <= b->U_q[i] && mark[q]);
        for (int a = 0; a < e->m && e->restricted; a++)
            contains |= !dal__node_is_zero(e->graph, e->A[a * e->n + i]) &&
                        !dal__node_is_zero(e->graph, e->A[a * e->n + j]);
        const int from = b->block[j], to = b->block[i];
        if (from == to || (!contains && dal__node_is_zero(e->graph, e->W[i * e->n + j]))) continue;
        for (int k = 0; k < e->n; k++) b->block[k] = b->block[k] == from ? to : b->block[k];
    }
    free(mark);
}

void dal__potential(dal_model *model)
{
    dal__equations *e = &model->equations;
    e->potential = NULL;
    if (e->vakonomic || !e->energy || !(e->properties & DAL_MASS_CONSTANT)) return;
    blocks b = {.model = model};
    dal__node *out = dal__model_nodes(model, 3 * e->n, 0);
    b.block = dal__model_allocate(model, (size_t)e->n, sizeof *b.block);
    b.U_q = dal__model_nodes(model, e->n, 0);
    b.row = dal__model_nodes(model, e->n, dal__number(e->graph, 0.0));
    b.other = dal__model_nodes(model, e->n, 0);
    if (model->out_of_memory) return;
    /* L is a polynomial of degree 2 in v: U is what remains of -L without v. */
    b.U = dal__node_neg(e->graph,
                        dal__substitute(e->graph, e->lagrangian, e->symbol + e->v, e->n, b.row));
    dal__gradient(e->graph, b.U, e->symbol + e->q, e->n, b.U_q);
    for (int i = 0; i < e->n; i++) b.block[i] = i;
    for (int i = 0; i < e->n; i++) couple(&b, i);
    for (int i = 0; i < e->n; i++)
        if (b.block[i] == i) fill_block(&b, i, out);
    e->potential = out;
}
