/* elementary_wide.c - the elementary functions over arrays, compiled once for each width. */
#include "elementary.h"
#include "kernel/elementary.h"

static num apply_one(enum function f, num a, num b)
{
    num s, c;
    switch (f) {
#define X(name)                                                                                    \
    case F_##name:                                                                                 \
        return dal_##name(a);
        UNARY_LIST(X)
        X(sign)
#undef X
#define X(name)                                                                                    \
    case F_##name:                                                                                 \
        return dal_##name(a, b);
        BINARY_LIST(X)
#undef X
    case F_sin_of_sincos:
        return dal_sincos(a, &s, &c), s;
    case F_cos_of_sincos:
        return dal_sincos(a, &s, &c), c;
    default:
        return dal_num(NAN);
    }
}

void DAL_WIDE(apply)(enum function f, const double *a, const double *b, double *out, int count)
{
    for (int i = 0; i < count; i += DAL_LANES) {
        num x = dal_num(0.0), y = x;
        for (int lane = 0; lane < DAL_LANES; lane++) {
            x = dal_with_lane(x, lane, a[i + lane]);
            y = dal_with_lane(y, lane, b[i + lane]);
        }
        num r = apply_one(f, x, y);
        for (int lane = 0; lane < DAL_LANES; lane++) out[i + lane] = dal_lane(r, lane);
    }
}
