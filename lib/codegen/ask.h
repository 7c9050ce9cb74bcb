/* ask.h - what an integrator asks, in a generated file: the answers of all groups of lanes that are
 * stepped as one system (kernel/step.h); travels as text like stepper.h. */

DAL_INLINE void dal__pick(const num *from, int group, int count, num *to)
{
    DAL_EACH(i, count) to[i] = from[i * DAL_JOINED + group];
}

DAL_INLINE void dal_eval_group(dal_step *s, int group, dal_callback_code code, double t,
                               const num *q, const num *v, num *out)
{
    num q_[DAL__N], v_[DAL__NW];
    dal__pick(q, group, DAL__N, q_);
    dal__pick(v, group, DAL__NW, v_);
    dal__eval_group(s->work + group, code, t, q_, v_, NULL, out);
}

DAL_INLINE void dal_eval(dal_step *s, dal_callback_code code, double t, const num *q, const num *v,
                         const num *pi, num *out)
{
    if (DAL_JOINED == 1) {
        dal__eval_group(s->work, code, t, q, v, pi, out);
        return;
    }
    DAL_EACH(j, DAL_JOINED) { /* what joined systems are asked for is the field */
        num answer[DAL__NW];
        dal_eval_group(s, j, code, t, q, v, answer);
        DAL_EACH(i, DAL__NW) out[i * DAL_JOINED + j] = answer[i];
    }
}
