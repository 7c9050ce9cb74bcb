/* project.c - the modifier NAME+project: back to D = 0 and p = pi = pi_e = 0 after every step.
 *
 *     (q1, u, t1) = step of NAME
 *     v1 = u - B c,   D(q1, v1, t1) = 0,   B = W^-1 A^T,   A and W at (q1, u, t1)
 *
 * the nearest v in the metric of the masses, by Newton's method with the frozen derivative
 * G = A B, to stagnation: c <- c + G^-1 D(q1, u - B c).  Hairer, Lubich, Wanner, Geometric
 * Numerical Integration (2006), IV.4.  Keeps the order on D = 0 and every D; loses symmetry, and
 * symplecticity on the lift, as a map onto D = 0 has a rank-deficient derivative. */
#include <dalembert_kernel.h>

typedef struct projection {
    num *u, *v;   /* [n] */
    num *out;     /* [m + m*n + n*m] D, A, B at (q1, v) */
    num *normals; /* [n*m] the frozen B */
    num *inverse; /* [m*m] G^-1 */
    num *shift;   /* [m] */
} projection;

static void ask(dal_step *s, projection *p)
{
    s->ask(s, DAL_ASK_CONSTRAINT, s->t, s->y, p->v, NULL, p->out);
}

/* The unknown is the change of v, whose scale is that of v. */
static void map(dal_step *s, dal_equation *eq)
{
    projection *p = eq->context;
    for (int i = 0; i < s->n; i++) p->v[i] = p->u[i] + eq->block[0].u[i];
    ask(s, p);
    dal_multiply(p->inverse, s->m, s->m, p->out, p->shift);
    dal_multiply(p->normals, s->n, s->m, p->shift, eq->block[0].image);
    for (int i = 0; i < s->n; i++)
        eq->block[0].image[i] = eq->block[0].u[i] - eq->block[0].image[i];
}

/* B and G^-1 at (q1, u). */
static dal_status freeze(dal_step *s, projection *p)
{
    const int n = s->n, m = s->m;
    DAL_VECTOR(s, g, m * m);
    ask(s, p);
    const num *a = p->out + m, *b = p->out + m + m * n;
    memcpy(p->normals, b, (size_t)(n * m) * sizeof *b);
    dal_gram(a, b, m, n, g);
    dal_invert(g, p->inverse, m);
    return DAL_OK;
}

static dal_status project_velocity(dal_step *s)
{
    const int n = s->n, m = s->m;
    DAL_VECTOR(s, v, n);
    DAL_VECTOR(s, out, m + 2 * m * n);
    DAL_VECTOR(s, normals, n * m);
    DAL_VECTOR(s, inverse, m * m);
    DAL_VECTOR(s, shift, m);
    projection p = {s->y + n, v, out, normals, inverse, shift};
    dal_equation eq = {.blocks = 1, .map = map, .context = &p};
    DAL_TRY(dal_block_init(s, &eq.block[0], n, 1.0, dal_max_norm(s->y + n, n)));
    for (int i = 0; i < n; i++) eq.block[0].u[i] = dal_num(0.0);
    memcpy(v, s->y + n, (size_t)n * sizeof *v);
    DAL_TRY(freeze(s, &p));
    DAL_TRY(dal_solve(s, &eq));
    dal_add(s, n, n, eq.block[0].u);
    return DAL_OK;
}

static void clear(dal_step *s, int first, int count)
{
    for (int i = first; i < first + count; i++) {
        s->y[i] = dal_select(s->alive, dal_num(0.0), s->y[i]);
        s->r[i] = dal_select(s->alive, dal_num(0.0), s->r[i]);
    }
}

static dal_status step(dal_step *s)
{
    DAL_TRY(dal_inner(s, s->h));
    if (s->m > 0) DAL_TRY(project_velocity(s));
    if (s->lifted) clear(s, dal_at_p(s), 2 * s->n + 1);
    return DAL_OK;
}

DAL_INTEGRATOR(project, .name = "project",
               .summary = "after each step back to D = 0, p = pi = pi_e = 0, in the mass metric",
               .reference = "Hairer, Lubich, Wanner 2006, IV.4", .stages = 1,
               .claims = DAL_MODIFIER | DAL_KEEPS_D, .needs = DAL_NEEDS_CONSTRAINT, .step = step);
