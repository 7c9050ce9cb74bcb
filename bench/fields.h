/* fields.h - the small systems of the bench, their fields derived and written by hand.
 *
 * A   Chaplygin's sleigh, U = G y1 + K (1 - cos(phi)):     y = (y1, y2, phi, y1', y2', phi')
 *         u = y1' cos(phi) + y2' sin(phi)      h = G sin(phi) - u phi'
 *         y1'' = -G + h sin(phi)     y2'' = -h cos(phi)     phi'' = -K sin(phi)
 *
 * B3  contact chain of one link (../examples/contact_chain.h):   y = (z0, z1, y1, z0', z1', y1')
 *         b0 = -z0 (1 + eps z1^2)    b1 = -z1 (1 + eps z0^2)
 *         h = -(y1' z1' + b0 + y1 b1)/(1 + y1^2)
 *         z0'' = b0 + h              z1'' = b1 + y1 h       y1'' = -y1
 *
 * Over `real`, which the includer defines, with real_sincos(x, &s, &c): a double, or lanes. */
enum { SMALL_DIM = 6 };

#define SLEIGH_G  0.3
#define SLEIGH_K  0.7
#define CHAIN_EPS 0.3

static const double sleigh_y[SMALL_DIM] = {0, 0, 0, 1, 0, 1};
static const double chain3_y[SMALL_DIM] = {0.8, -0.5, 0.6, -0.24, 0.4, 0.7};

static inline void sleigh_field(const real *y, real *dy)
{
    real s, c;
    real_sincos(y[2], &s, &c);
    const real h = SLEIGH_G * s - (y[3] * c + y[4] * s) * y[5];
    dy[0] = y[3];
    dy[1] = y[4];
    dy[2] = y[5];
    dy[3] = h * s - SLEIGH_G;
    dy[4] = -(h * c);
    dy[5] = -SLEIGH_K * s;
}

static inline void chain3_field(const real *y, real *dy)
{
    const real b0 = -y[0] * (1.0 + CHAIN_EPS * (y[1] * y[1]));
    const real b1 = -y[1] * (1.0 + CHAIN_EPS * (y[0] * y[0]));
    const real h = -(y[5] * y[4] + b0 + y[2] * b1) / (1.0 + y[2] * y[2]);
    dy[0] = y[3];
    dy[1] = y[4];
    dy[2] = y[5];
    dy[3] = b0 + h;
    dy[4] = b1 + y[2] * h;
    dy[5] = -y[2];
}
