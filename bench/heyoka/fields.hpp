/* fields.hpp - the right-hand sides of the bench of time to an error, reduced by hand, over doubles
 * or expressions of heyoka; y = (q, v), parameters as in the files of the systems. */
#ifndef BENCH_HEYOKA_FIELDS_HPP
#define BENCH_HEYOKA_FIELDS_HPP

#include <cmath>

/* As sleigh_field of fields.inc. */
template <class Real> void sleigh(const Real *y, Real *dy)
{
    using std::cos, std::sin;
    const double G = 0.3, K = 0.7;
    const Real s = sin(y[2]), c = cos(y[2]), h = G * s - (y[3] * c + y[4] * s) * y[5];
    for (int i = 0; i < 3; i++) dy[i] = y[3 + i];
    dy[3] = h * s - G;
    dy[4] = -(h * c);
    dy[5] = -K * s;
}

/* q = (x, y1..y3, z1..z3), x' + y.z' = 0:
 *     x'' = lambda - U_x    y_i'' = -U_(y_i)    z_i'' = lambda y_i - U_(z_i)
 *     lambda = (U_x + y.U_z - y'.z')/(1 + y.y) */
template <class Real> void chaotic_oscillators(const Real *q, Real *dq)
{
    const Real *y = q + 1, *z = q + 4, *dy = q + 8, *dz = q + 11;
    Real yy[3], zz[3];
    for (int i = 0; i < 3; i++) yy[i] = y[i] * y[i];
    for (int i = 0; i < 3; i++) zz[i] = z[i] * z[i];
    const Real uz[3] = {z[0] * (1.0 + zz[1] + yy[0]), z[1] * (1.0 + zz[0] + yy[1]),
                        z[2] * (1.0 + yy[2])};
    const Real force = q[0] + y[0] * uz[0] + y[1] * uz[1] + y[2] * uz[2];
    const Real bent = dy[0] * dz[0] + dy[1] * dz[1] + dy[2] * dz[2];
    const Real lambda = (force - bent) / (1.0 + yy[0] + yy[1] + yy[2]);
    for (int i = 0; i < 7; i++) dq[i] = q[7 + i];
    dq[7] = lambda - q[0];
    for (int i = 0; i < 3; i++) dq[8 + i] = -(y[i] * (1.0 + zz[i]));
    for (int i = 0; i < 3; i++) dq[11 + i] = lambda * y[i] - uz[i];
}

/* As ../systems/disk_by_hand.yaml with m = g = r = 1, A = 1/4, C = 1/2; y = (X, Y, theta, phi, psi). */
template <class Real> void falling_disk(const Real *y, Real *dy)
{
    using std::cos, std::sin;
    const double A = 0.25, C = 0.5;
    const Real st = sin(y[2]), ct = cos(y[2]), sp = sin(y[3]), cp = cos(y[3]);
    const Real p = y[7], turn = y[8] * ct, q = y[8] * st, s = y[9] + turn;
    const Real dp = (q * (A * turn - (C + 1.0) * s) - ct) / (A + 1.0);
    const Real ddphi = p * (C / A * s - 2.0 * turn) / st;
    const Real slip = p * q, ds = 1.0 / (C + 1.0) * slip;
    const Real outward = dp * st + p * p * ct + s * y[8], along = slip - ds;
    for (int i = 0; i < 5; i++) dy[i] = y[5 + i];
    dy[5] = outward * sp + along * cp;
    dy[6] = along * sp - outward * cp;
    dy[7] = dp;
    dy[8] = ddphi;
    dy[9] = ds - ddphi * ct + slip;
}

#endif
