/* looks.h - the observables of many states, at the end of a file for native mode; travels as text
 * like stepper.h.
 *
 * Number i of state k is states[i * stride + k], its time the number behind the last; observable i
 * of it goes to out[i * stride + k].  States are looked at by registers, so that up to a register's
 * lanes more are read and written than count says. */

void PREFIX_looks(const double *states, long long stride, long long count, const double *work,
                  double *DAL_RESTRICT out)
{
    const dal_stored *const w = (const dal_stored *)work;
    for (long long k = 0; k < count; k += DAL_LANES) {
        num y[DAL__DIM], value[DAL__OBSERVABLES + 1];
        DAL_EACH(i, DAL__DIM) y[i] = *(const dal_stored *)(states + i * stride + k);
        const num t = *(const dal_stored *)(states + DAL__DIM * stride + k);
        dal__observe(w, t, y, value);
        DAL_EACH(i, DAL__OBSERVABLES) *(dal_stored *)(out + i * stride + k) = value[i] + 0.0;
    }
}
