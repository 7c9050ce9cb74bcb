/* angles.c - sines and cosines of sums.
 *
 *     sin(x +- y) = sin x cos y +- cos x sin y,   cos(x +- y) = cos x cos y -+ sin x sin y
 *
 * A sine with its cosine takes as long as some twenty products.  A chain of n links has n (n - 1)/2
 * differences of angles, but n angles. */
#include "expr/angles.h"
#include "expr/collect.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include <stdlib.h>

/* Sine and cosine of node x, whose terms have their images; depth limits the recursion. */
static void expand(dal__graph *graph, dal__node x, const dal__node *image, int depth,
                   dal__node out[2])
{
    const dal__record r = graph->node[x];
    const bool add = r.op == DAL__ADD;
    if ((!add && r.op != DAL__SUB) || r.fixed || depth == 0) {
        out[0] = dal__apply(graph, DAL__SIN, image[x], 0);
        out[1] = dal__apply(graph, DAL__COS, image[x], 0);
        return;
    }
    dal__node a[2], b[2];
    expand(graph, r.a, image, depth - 1, a);
    expand(graph, r.b, image, depth - 1, b);
    const dal__node sc = dal__node_mul(graph, a[0], b[1]), cs = dal__node_mul(graph, a[1], b[0]);
    const dal__node cc = dal__node_mul(graph, a[1], b[1]), ss = dal__node_mul(graph, a[0], b[0]);
    out[0] = add ? dal__node_add(graph, sc, cs) : dal__node_sub(graph, sc, cs);
    out[1] = add ? dal__node_sub(graph, cc, ss) : dal__node_add(graph, cc, ss);
}

void dal__expand_angles(dal__graph *graph, dal__node *nodes, int count)
{
    enum { MAX_DEPTH = 8 };
    const dal__node last = dal__last_of(nodes, count);
    uint8_t *mark = dal__reach_all(graph, nodes, count);
    dal__node *image = dal__per_node(graph, last, sizeof *image);
    dal__node *out = malloc(((size_t)count + 1) * sizeof *out);
    if (mark && image && out) {
        for (dal__node i = 1; i <= last; i++) {
            const dal__record r = graph->node[i];
            dal__node both[2] = {0, 0};
            if (!mark[i]) continue;
            const bool angular = (r.op == DAL__SIN || r.op == DAL__COS) && !r.fixed;
            if (angular) expand(graph, r.a, image, MAX_DEPTH, both);
            image[i] = angular ? both[r.op == DAL__COS] : dal__rebuild(graph, i, image);
        }
        for (int k = 0; k < count; k++) out[k] = image[nodes[k]];
        if (dal__cost(graph, out, count) < dal__cost(graph, nodes, count))
            for (int k = 0; k < count; k++) nodes[k] = out[k];
    } else if (graph->status == DAL_STATUS_OK) {
        graph->status = DAL_STATUS_MEMORY;
    }
    free(mark);
    free(image);
    free(out);
}
