/* constraint_rows.c - values of constraints at a point and their derivatives, a row for each.
 *
 * The callbacks store D[m], A[m*n] and W^-1 A^T [n*m]; the rows g_q of holonomic constraints are
 * the last of A. */
#include "core/constraint_rows.h"
#include <string.h>

dal_status dal__evaluate_rows(dal__constraint_rows *c, dal_callback *callback, const char *place,
                              dal_error *error)
{
    const dal_system *s = c->system;
    const int m = s->m, n = s->n;
    dal_status status = m > 0 ? callback(s, &c->at, c->out) : DAL_STATUS_OK;
    if (status != DAL_STATUS_OK)
        return dal__fail(error, status, "the constraints cannot be evaluated at %s", place);
    memcpy(c->D, c->out + c->first, (size_t)c->count * sizeof *c->D);
    memcpy(c->A, c->out + m + c->first * n, (size_t)(c->count * n) * sizeof *c->A);
    for (int i = 0; i < n; i++)
        for (int a = 0; a < c->count; a++)
            c->B[i * c->rows + a] = c->out[m + m * n + i * m + c->first + a];
    if (c->of_coordinates) status = s->call.holonomic(s, &c->at, c->D);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(error, status, "the holonomic constraints cannot be evaluated at %s", place);
}
