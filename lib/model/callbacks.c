/* callbacks.c - the callbacks of one lane only, and the diagnosis of singular matrices. */
#include "model/callbacks.h"
#include "core/error.h"
#include <math.h>

#define CALLBACK(code, name, reads)                                                                \
    static dal_status name(const dal_system *system, const dal_point *at, double *out)             \
    {                                                                                              \
        const dal__programs *p = system->data;                                                     \
        return p->run(system, at, out, DAL__PROGRAM_##code, reads);                                \
    }
DAL__SINGLE_LIST(CALLBACK)
CALLBACK(PICTURE, picture, DAL__T | DAL__QV)
#undef CALLBACK

static bool vanished(const double *pivot)
{
    return !(fabs(pivot[0]) > DAL__PIVOT_LEAST * pivot[1]) || !isfinite(pivot[0]);
}

/* The program's outputs are all pivots with their sizes, then one number for each constraint that
 * is finite if its derivatives are.  They are checked in the order in which they are computed:
 * mass, constraints, elimination of the constraints. */
static dal_status diagnose(const dal_system *system, const dal_point *at, double *out)
{
    const dal__programs *p = system->data;
    const dal__equations *e = p->equations;
    double *value = at->work + p->scratch;
    DAL_TRY(p->run(system, at, value, DAL__PROGRAM_DIAGNOSE, DAL__T | DAL__QV));
    out[0] = 0.0;
    for (int k = 0; k < e->pivots; k++)
        if (e->pivot[k].constraint == 0 && vanished(value + 2 * k)) return DAL_SINGULAR_MASS;
    for (int a = 0; a < e->m; a++) {
        out[0] = a + 1;
        if (!isfinite(value[2 * e->pivots + a])) return DAL_SINGULAR;
    }
    for (int k = 0; k < e->pivots; k++) {
        out[0] = e->pivot[k].constraint;
        if (e->pivot[k].constraint && vanished(value + 2 * k)) return DAL_SINGULAR;
    }
    out[0] = 0.0;
    return DAL_OK;
}

void dal__fill_single_callbacks(dal__programs *programs, dal_system *system)
{
#define SET(code, name, reads)                                                                     \
    system->name = programs->program[DAL__PROGRAM_##code].present ? name : NULL;
    DAL__SINGLE_LIST(SET)
#undef SET
    programs->picture = (dal_picture){picture, programs->equations->body};
    system->picture = programs->program[DAL__PROGRAM_PICTURE].present ? &programs->picture : NULL;
    system->diagnose = programs->program[DAL__PROGRAM_DIAGNOSE].present ? diagnose : NULL;
}
