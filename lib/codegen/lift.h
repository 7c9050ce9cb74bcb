/* lift.h - what is observed of the canonical variables, in a generated file; travels as text like
 * stepper.h. */

/* H = pi.pi/(2e) + pi.F + p.v + mu_e pi_e */
DAL_INLINE num dal__hamiltonian(const num *y, const num *f, num mu)
{
    const int n = DAL__N, e = DAL__LIFTED ? 2 * n : 0;
    const num *v = y + n, *p = y + e + DAL__LIFTED, *pi = p + DAL__LIFTED * n;
    num sum = dal_num(0.0);
    DAL_EACH(i, n) sum += pi[i] * pi[i] * (0.5 / y[e]) + pi[i] * f[i] + p[i] * v[i];
    return sum + mu * y[DAL__DIM - 1];
}

/* H and the max norms of p, pi, pi_e. */
DAL_INLINE void dal__observe_lift(const dal_stored *work, dal_time t, const num *y, num *out)
{
    const int n = DAL__N, e = DAL__LIFTED ? 2 * n : 0;
    num f[DAL__NW], mu;
    dal__eval_group(work, DAL_EVAL_FIELD, t, y, y + n, NULL, f);
    dal__eval_group(work, DAL_EVAL_GAUGE, t, y, y + n, NULL, &mu);
    out[0] = dal__hamiltonian(y, f, mu);
    out[1] = out[2] = dal_num(0.0);
    DAL_EACH(i, n) {
        out[1] = dal_max(out[1], dal_abs(y[e + DAL__LIFTED + i]));
        out[2] = dal_max(out[2], dal_abs(y[e + DAL__LIFTED * (n + 1) + i]));
    }
    out[3] = dal_abs(y[DAL__DIM - 1]);
}
