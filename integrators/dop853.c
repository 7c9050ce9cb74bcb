/* dop853.c - the method of order 8 of Dormand and Prince, DOP853.
 *
 *     k_i = f(t + c_i h, y + h sum_(j<i) a_ij k_j), i = 1..12       y1 = y + h sum_i b_i k_i
 *
 * Dormand, Prince; Hairer, Norsett, Wanner, Solving ODEs I (1993), II.5, II.10.  Digits as in
 * Hairer's dop853.f and Williams' dop853 (BSD).  Order 8, explicit, twelve evaluations; preserves D
 * with constant coefficients, no other.  With a tolerance the sizes of substeps follow the two
 * estimates of the error in dop853.f, and a comparison with the substep before; below LOW_BELOW_853
 * only the rounding of F remains. */
#include <dalembert_kernel.h>

/* clang-format off */
static const double c853[] = {0.0, 5.26001519587677318785587544488e-2,
    7.89002279381515978178381316732e-2, 0.118350341907227396726757197510,
    0.281649658092772603273242802490, 0.333333333333333333333333333333, 0.25,
    0.307692307692307692307692307692, 0.651282051282051282051282051282, 0.6,
    0.857142857142857142857142857142, 1.0};
static const double b853[] = {5.42937341165687622380535766363e-2, 0.0, 0.0, 0.0, 0.0,
    4.45031289275240888144113950566, 1.89151789931450038304281599044,
    -5.8012039600105847814672114227, 3.1116436695781989440891606237e-1,
    -1.52160949662516078556178806805e-1, 2.01365400804030348374776537501e-1,
    4.47106157277725905176885569043e-2};
/* a_i1, .., a_i(i-1) begin at number (i-1)(i-2)/2. */
static const double a853[] = {5.26001519587677318785587544488e-2,
    1.97250569845378994544595329183e-2, 5.91751709536136983633785987549e-2,
    2.95875854768068491816892993775e-2, 0.0, 8.87627564304205475450678981324e-2,
    2.41365134159266685502369798665e-1, 0.0, -8.84549479328286085344864962717e-1,
    9.24834003261792003115737966543e-1, 3.7037037037037037037037037037e-2, 0.0, 0.0,
    1.70828608729473871279604482173e-1, 1.25467687566822425016691814123e-1, 3.7109375e-2, 0.0,
    0.0, 1.70252211019544039314978060272e-1, 6.02165389804559606850219397283e-2, -1.7578125e-2,
    3.70920001185047927108779319836e-2, 0.0, 0.0, 1.70383925712239993810214054705e-1,
    1.07262030446373284651809199168e-1, -1.53194377486244017527936158236e-2,
    8.27378916381402288758473766002e-3, 6.24110958716075717114429577812e-1, 0.0, 0.0,
    -3.36089262944694129406857109825, -8.68219346841726006818189891453e-1,
    2.75920996994467083049415600797e+1, 2.01540675504778934086186788979e+1,
    -4.34898841810699588477366255144e+1, 4.77662536438264365890433908527e-1, 0.0, 0.0,
    -2.48811461997166764192642586468, -5.90290826836842996371446475743e-1,
    2.12300514481811942347288949897e+1, 1.52792336328824235832596922938e+1,
    -3.32882109689848629194453265587e+1, -2.03312017085086261358222928593e-2,
    -9.3714243008598732571704021658e-1, 0.0, 0.0, 5.18637242884406370830023853209,
    1.09143734899672957818500254654, -8.14978701074692612513997267357,
    -1.85200656599969598641566180701e+1, 2.27394870993505042818970056734e+1,
    2.49360555267965238987089396762, -3.0467644718982195003823669022,
    2.27331014751653820792359768449, 0.0, 0.0, -1.05344954667372501984066689879e+1,
    -2.00087205822486249909675718444, -1.79589318631187989172765950534e+1,
    2.79488845294199600508499808837e+1, -2.85899827713502369474065508674,
    -8.87285693353062954433549289258, 1.23605671757943030647266201528e+1,
    6.43392746015763530355970484046e-1};
/* The digits of a and b after the doubles above. */
static const double a853_low[] = {2.2355514829149388e-18, -8.9639166988370505e-19,
    -2.6891750096511152e-18, -1.3445875048255075e-18, 0.0, 2.9051313894306059e-18,
    -6.6241522039166237e-18, 0.0, 7.0162460965731243e-18, 1.0537371249772312e-17,
    2.0559685641206232e-18, 0.0, 0.0, 8.1758839498647832e-18, 8.2718645631002021e-18, 0.0, 0.0, 0.0,
    -8.1395100623673049e-18, 1.2006161584603762e-18, 0.0, 3.4253328451425882e-18, 0.0, 0.0,
    1.2967148331612122e-17, 4.7723852093991612e-18, 2.8475137341766893e-19, -3.6605551308348141e-19,
    2.4926899156305619e-17, 0.0, 0.0, 1.5456576283941173e-16, -3.7185825878657269e-17,
    -1.2881343059163701e-15, -4.8006427756016935e-16, 1.9413089553812176e-15,
    2.5724262912655348e-17, 0.0, 0.0, 7.6163776605513614e-17, -2.1870450269554425e-17,
    1.1824507909843185e-15, 1.6175344620758999e-16, 3.9439004961642045e-16, 7.6610554757644648e-19,
    -2.6601638178283549e-17, 0.0, 0.0, -8.9425755404092932e-17, 7.2072955853961408e-17,
    6.7126068494857363e-16, -7.7984639844695159e-16, -8.7961322180750331e-16,
    5.2481978128364214e-17, 1.3907396197551354e-16, 1.7007512072370059e-16, 0.0, 0.0,
    -7.4007338806086403e-16, -2.8231311099795352e-17, 3.8189608367611925e-16,
    1.1856623515433554e-16, -1.7007630722635992e-16, -2.2457366408213776e-16,
    -1.3158566470097505e-16, -4.2130919159141169e-17};
static const double b853_low[] = {-2.5645259176078281e-18, 0.0, 0.0, 0.0, 0.0,
    -2.7370927755819091e-16, 6.5811224992604841e-17, 1.3317442893008373e-16,
    -1.0104455449341739e-17, 8.7766964518480750e-18, 6.1225721600276097e-18,
    3.1043973515105385e-18};
/* clang-format on */

enum { STAGES_853 = 12 };

/* Stages are numbered as in the formula, from 1. */
#define ROW_853(i)       (((i)-1) * ((i)-2) / 2)
#define K_853(k, dim, i) ((k) + ((i)-1) * (dim))

/* Below this tolerance the rounding of coefficients and of y counts: stages begin from y + r, and
 * coefficients have the digits of two doubles.  What remains then is the rounding of F. */
#if DAL_WITH(CONTROL)
#define LOW_BELOW_853   1e-14
#define USES_LOW_853(s) (DAL_CONTROLLED(s) && DAL_TOLERANCE(s) < LOW_BELOW_853)
#else
#define USES_LOW_853(s) 0
#endif

/* out += weight_1 k_1 + .. + weight_count k_count */
DAL_INLINE void add_derivatives(int dim, int count, const double *weight, const num *k,
                                num *DAL_RESTRICT out)
{
    DAL_EACH(j, count) {
        if (weight[j] == 0.0) continue;
        DAL_EACH(l, dim) out[l] = dal_fma(dal_num(weight[j]), k[j * dim + l], out[l]);
    }
}

/* sum = weight_1 k_1 + .. + weight_count k_count, the digits after the doubles first (NULL: none).
 */
DAL_INLINE void combine(int dim, int count, const double *weight, const double *low, const num *k,
                        num *DAL_RESTRICT sum)
{
    DAL_EACH(l, dim) sum[l] = dal_num(0.0);
    if (low) add_derivatives(dim, count, low, k, sum);
    add_derivatives(dim, count, weight, k, sum);
}

/* All k_i of a step from t but the first ones that are `known`, and the sum of b_i k_i. */
DAL_INLINE void derivatives(dal_step *s, dal_times t, dal_times size, int known, num *k, num *sum)
{
    const int dim = DAL_DIM(s);
    const bool uses_low = USES_LOW_853(s);
    const num h = size;
    DAL_EACH(before, STAGES_853) {
        if (before < known) continue;
        const int i = before + 1;
        combine(dim, before, a853 + ROW_853(i), uses_low ? a853_low + ROW_853(i) : NULL, k, sum);
        if (uses_low)
            DAL_EACH(l, dim) sum[l] = s->y[l] + dal_fma(h, sum[l], s->r[l]);
        else
            DAL_EACH(l, dim) sum[l] = dal_fma(h, sum[l], s->y[l]);
        dal_field_at(s, t + c853[i - 1] * size, sum, K_853(k, dim, i));
    }
    combine(dim, STAGES_853, b853, uses_low ? b853_low : NULL, k, sum);
}

#if DAL_WITH(CONTROL)
/* clang-format off */
/* The weights of the embedded method of order 3 (bhh in dop853.f), and order 8 less order 5
 * (er); their differences from order 8 vanish up to h^3 and h^5. */
static const double third853[] = {0.244094488188976377952755905512, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.733846688281611857341361741547, 0.0, 0.0, 0.220588235294117647058823529412e-1};
static const double fifth853[] = {0.1312004499419488073250102996e-1, 0.0, 0.0, 0.0, 0.0,
    -1.225156446376204440720569753, -0.4957589496572501915214079952,
    1.664377182454986536961530415, -0.3503288487499736816886487290,
    0.3341791187130174790297318841, 0.8192320648511571246570742613e-1,
    -0.2235530786388629525884427845e-1};
/* clang-format on */

/* Estimates of a trial over count components from first on, whose units are tolerance
 * (unit_l + |y_l|):
 *
 *     error = |h| |e5|^2 / sqrt(count (|e5|^2 + |e3|^2/100)),     scale = |h e5|^(3/2)
 *
 * The error is h^9 times a derivative and e5 h^5 times one, so that error / scale changes slowly
 * where the series of the motion converge within h. */
typedef struct estimate853 {
    dal_times error, scale;
} estimate853;

DAL_INLINE estimate853 estimate_error(const dal_step *s, dal_times h, const num *derivative,
                                      const num *e3, const num *e5, int first, int count)
{
    const double tolerance = DAL_TOLERANCE(s);
    const double *units = first == 0 ? DAL_UNITS(s) : NULL; /* p and pi have none */
    dal_times square3 = h - h, square5 = h - h;
    DAL_EACH(place, count) {
        const int l = first + place;
        const num size = dal_max(dal_abs(s->y[l]), dal_abs(s->y[l] + h * derivative[l]));
        const double absolute = tolerance * (units ? units[place] : 1.0);
        const num unit = absolute + tolerance * size;
        square3 += e3[l] / unit * (e3[l] / unit);
        square5 += e5[l] / unit * (e5[l] / unit);
    }
    const num both = square5 + 0.01 * square3, zero = dal_num(0.0);
    const num error = dal_abs(h) * square5 / dal_sqrt(count * both);
    const num fifth = dal_abs(h) * dal_sqrt(square5);
    const estimate853 found = {(dal_times)dal_select(dal_equal(both, zero), zero, error),
                               (dal_times)(fifth * dal_sqrt(fifth))};
    return found;
}

/* The error of a trial: where a near singularity passes between two stages, e3 hides the rise of
 * e5, and the error is `last`, error / scale of the substep accepted last, times the scale. */
DAL_INLINE num guarded(const estimate853 *e, dal_times last)
{
    const num expected = last * e->scale, error = e->error;
    return dal_select(dal_less(error, expected), expected, error);
}

/* Below this error a substep says nothing about the next one: it may be of rounding, where the
 * substep is short. */
#define KEPT_853 1e-5

/* error / scale of accepted lanes; 0 expects nothing. */
DAL_INLINE void keep_estimate(const estimate853 *e, dal_mask accepted, dal_times *last)
{
    const dal_mask known = dal_less(dal_num(KEPT_853), e->error);
    const num kept = dal_select(known, e->error / e->scale, dal_num(0.0));
    *last = (dal_times)dal_select(accepted, kept, *last);
}

/* r of a trial: the errors of (q,v) and of (p,pi) each by itself, and none of e and pi_e, so that
 * the substeps of (q,v) on the surface know neither the space nor the gauge. */
DAL_INLINE dal_times ratio853(dal_step *s, dal_control *c, const num *k, const num *derivative)
{
    const int dim = DAL_DIM(s), n = DAL_N(s);
    DAL__MARK(s);
    DAL_VECTOR(s, e3, DAL_DIM(s));
    DAL_VECTOR(s, e5, DAL_DIM(s));
    DAL_EACH(l, dim) e3[l] = -derivative[l];
    DAL_EACH(l, dim) e5[l] = dal_num(0.0);
    add_derivatives(dim, STAGES_853, third853, k, e3);
    add_derivatives(dim, STAGES_853, fifth853, k, e5);
    const estimate853 motion = estimate_error(s, c->h, derivative, e3, e5, 0, n + DAL_NW(s));
    estimate853 momenta = motion;
    num error = guarded(&motion, c->last[0]);
    if (DAL_LIFTED(s)) {
        momenta = estimate_error(s, c->h, derivative, e3, e5, dal_at_p(s), 2 * n);
        const num other = guarded(&momenta, c->last[1]);
        const dal_mask larger = dal_less(error, other) | ~dal_equal(other, other);
        error = dal_select(larger, other, error);
    }
    const dal_mask accepted = c->active & dal_less_equal(error, dal_num(1.0));
    keep_estimate(&motion, accepted, &c->last[0]);
    if (DAL_LIFTED(s)) keep_estimate(&momenta, accepted, &c->last[1]);
    DAL__RELEASE(s);
    return (dal_times)dal_sqrt(dal_sqrt(dal_sqrt(error)));
}

/* ---- dense output: a substep between its ends ----
 *
 * With k_13 = f(t + h, y1) and three more stages, i = 14, 15, 16, at c_i = 0.1, 0.2, 7/9,
 *
 *     y(t + s h) = y0 + s (r2 + z (r3 + s (r4 + z (r5 + s (r6 + z (r7 + s r8)))))),   z = 1 - s
 *     r2 = y1 - y0,   r3 = h k_1 - r2,   r4 = r2 - h k_13 - r3,   r_(d+1) = h sum_j d_dj k_j
 *
 * of order 7 at each s, order 8 at s = 1, and once continuously differentiable from one substep to
 * the next.  Hairer, Norsett, Wanner, II.6; digits as in dop853.f. */
#ifndef DAL_SPECIALISED
enum {
    END_853 = 13,            /* the stage at t + h */
    EXTENSION_LAST_853 = 16, /* the last stage */
    EXTENSION_TERMS_853 = 7  /* r2..r8 */
};

/* clang-format off */
/* A(i, j, a_ij) of stages 14..16, D(d, j, d_dj) of r_(d+1); the others are 0. */
#define EXTENSION_STAGES_853(A) \
    A(14, 1, 5.61675022830479523392909219681e-2) A(14, 7, 2.53500210216624811088794765333e-1) \
    A(14, 8, -2.46239037470802489917441475441e-1) \
    A(14, 9, -1.24191423263816360469010140626e-1) \
    A(14, 10, 1.5329179827876569731206322685e-1) \
    A(14, 11, 8.20105229563468988491666602057e-3) \
    A(14, 12, 7.56789766054569976138603589584e-3) A(14, 13, -8.298e-3) \
    A(15, 1, 3.18346481635021405060768473261e-2) A(15, 6, 2.83009096723667755288322961402e-2) \
    A(15, 7, 5.35419883074385676223797384372e-2) \
    A(15, 8, -5.49237485713909884646569340306e-2) \
    A(15, 11, -1.08347328697249322858509316994e-4) \
    A(15, 12, 3.82571090835658412954920192323e-4) \
    A(15, 13, -3.40465008687404560802977114492e-4) \
    A(15, 14, 1.41312443674632500278074618366e-1) \
    A(16, 1, -4.28896301583791923408573538692e-1) A(16, 6, -4.69762141536116384314449447206) \
    A(16, 7, 7.68342119606259904184240953878) A(16, 8, 4.06898981839711007970213554331) \
    A(16, 9, 3.56727187455281109270669543021e-1) \
    A(16, 13, -1.39902416515901462129418009734e-3) A(16, 14, 2.9475147891527723389556272149) \
    A(16, 15, -9.15095847217987001081870187138)
#define EXTENSION_WEIGHTS_853(D) \
    D(4, 1, -0.84289382761090128651353491142e1) D(4, 6, 0.5667149535193777696253178359) \
    D(4, 7, -0.30689499459498916912797304727e1) D(4, 8, 0.2384667656512069828772814968e1) \
    D(4, 9, 0.21170345824450282767155149946e1) D(4, 10, -0.8713915837779729920678990749) \
    D(4, 11, 0.2240437430260788275854177165e1) D(4, 12, 0.6315787787694688181557024929) \
    D(4, 13, -0.889903364513333108206981174e-1) D(4, 14, 0.18148505520854727256656404962e2) \
    D(4, 15, -0.91946323924783554000451984436e1) D(4, 16, -0.44360363875948939664310572e1) \
    D(5, 1, 0.10427508642579134603413151009e2) D(5, 6, 0.24228349177525818288430175319e3) \
    D(5, 7, 0.16520045171727028198505394887e3) D(5, 8, -0.37454675472269020279518312152e3) \
    D(5, 9, -0.22113666853125306036270938578e2) D(5, 10, 0.77334326684722638389603898808e1) \
    D(5, 11, -0.30674084731089398182061213626e2) D(5, 12, -0.93321305264302278729567221706e1) \
    D(5, 13, 0.15697238121770843886131091075e2) D(5, 14, -0.31139403219565177677282850411e2) \
    D(5, 15, -0.93529243588444783865713862664e1) D(5, 16, 0.3581684148639408375246589854e2) \
    D(6, 1, 0.19985053242002433820987653617e2) D(6, 6, -0.38703730874935176555105901742e3) \
    D(6, 7, -0.18917813819516756882830838328e3) D(6, 8, 0.52780815920542364900561016686e3) \
    D(6, 9, -0.11573902539959630126141871134e2) D(6, 10, 0.68812326946963000169666922661e1) \
    D(6, 11, -0.1000605096691083840318386098e1) D(6, 12, 0.7777137798053443209286926574) \
    D(6, 13, -0.27782057523535084065932004339e1) D(6, 14, -0.60196695231264120758267380846e2) \
    D(6, 15, 0.84320405506677161018159903784e2) D(6, 16, 0.1199229113618278932803513003e2) \
    D(7, 1, -0.25693933462703749003312586129e2) D(7, 6, -0.15418974869023643374053993627e3) \
    D(7, 7, -0.23152937917604549567536039109e3) D(7, 8, 0.3576391179106141237828534991e3) \
    D(7, 9, 0.93405324183624310003907691704e2) D(7, 10, -0.37458323136451633156875139351e2) \
    D(7, 11, 0.10409964950896230045147246184e3) D(7, 12, 0.29840293426660503123344363579e2) \
    D(7, 13, -0.43533456590011143754432175058e2) D(7, 14, 0.963245539591882829483949506e2) \
    D(7, 15, -0.39177261675615439165231486172e2) D(7, 16, -0.14972683625798562581422125276e3)
/* clang-format on */

/* c_13, .., c_16 */
static const double c853_extension[] = {1.0, 0.1, 0.2, 0.777777777777777777777777777778};

/* a_ij of row i, i = 14..16, and d_dj of row d, d = 4..7. */
#define PLACE_853(first, row, j, weight)                                                           \
    [((row) - (first)) * EXTENSION_LAST_853 + (j)-1] = (weight),
#define STAGE_853(row, j, weight) PLACE_853(END_853 + 1, row, j, weight)
#define TERM_853(row, j, weight)  PLACE_853(4, row, j, weight)
static const double stages853[3 * EXTENSION_LAST_853] = {EXTENSION_STAGES_853(STAGE_853)};
static const double terms853[4 * EXTENSION_LAST_853] = {EXTENSION_WEIGHTS_853(TERM_853)};

/* out += the weights of a row times k_1, .., k_count */
DAL_NOINLINE void add_row(int dim, int count, const double *row, const num *k,
                          num *DAL_RESTRICT out)
{
    add_derivatives(dim, count, row, k, out);
}

/* sum[dim] = sum_(j<i) a_ij k_j, i = 14..16. */
DAL_INLINE void extension_stage(int dim, int i, const num *k, num *DAL_RESTRICT sum)
{
    DAL_EACH(l, dim) sum[l] = dal_num(0.0);
    add_row(dim, i - 1, stages853 + (i - END_853 - 1) * EXTENSION_LAST_853, k, sum);
}

/* r[7*dim] = r2/h, .., r8/h from the mean rate (y1 - y0)/h and k[16*dim]. */
DAL_INLINE void extension_terms(int dim, const num *mean, const num *k, num *DAL_RESTRICT r)
{
    DAL_EACH(l, dim) {
        r[l] = mean[l];
        r[dim + l] = K_853(k, dim, 1)[l] - mean[l];
        r[2 * dim + l] = mean[l] - K_853(k, dim, END_853)[l] - r[dim + l];
    }
    DAL_EACH(l, 4 * dim) r[3 * dim + l] = dal_num(0.0);
    DAL_EACH(d, 4)
        add_row(dim, EXTENSION_LAST_853, terms853 + d * EXTENSION_LAST_853, k, r + (3 + d) * dim);
}

/* Replaces r2, .., r8 by the coefficients of s^0, .., s^6 in r2 + z (r3 + s (r4 + z ..)), from the
 * innermost bracket outwards.  A pass makes r_d + z P = r_d + P - s P of r_d and the coefficients
 * of P = r_(d+1) + s (..), which already follow it. */
DAL_INLINE void expand_extension(int dim, num *r)
{
    const int last = (EXTENSION_TERMS_853 - 1) * dim;
    for (int i = last - 2 * dim; i >= 0; i -= 2 * dim) {
        DAL_EACH(l, dim) r[i + l] += r[i + dim + l];
        for (int j = i + dim; j < last; j++) r[j] = r[j + dim] - r[j];
        DAL_EACH(l, dim) r[last + l] = -r[last + l];
    }
}

/* Leaves the polynomial of a trial, of degree 7, from its stages, `known`, and its mean rate, in
 * four more evaluations. */
DAL_INLINE void extend(dal_step *s, const dal_control *c, const num *known, const num *mean)
{
    const int dim = DAL_DIM(s);
    DAL__MARK(s);
    DAL_VECTOR(s, k, EXTENSION_LAST_853 * DAL_DIM(s));
    DAL_VECTOR(s, y, DAL_DIM(s));
    DAL_EACH(l, STAGES_853 * dim) k[l] = known[l];
    DAL_EACH(l, dim) y[l] = mean[l];
    for (int i = END_853; i <= EXTENSION_LAST_853; i++) {
        if (i > END_853) extension_stage(dim, i, k, y);
        DAL_EACH(l, dim) y[l] = s->y[l] + dal_fma(c->h, y[l], s->r[l]);
        dal_field_at(s, c->t + c853_extension[i - END_853] * c->h, y, K_853(k, dim, i));
    }
    extension_terms(dim, mean, k, s->dense->rate);
    expand_extension(dim, s->dense->rate);
    s->dense->terms = EXTENSION_TERMS_853;
    DAL__RELEASE(s);
}
#endif

/* Steps by s->h in substeps. */
DAL_INLINE dal_status divided(dal_step *s, num *k, num *sum)
{
    dal_control c = dal_control_begin(s);
    while (dal_control_next(s, &c)) {
        /* A trial that is repeated begins with the same k_1. */
        const int known = dal_any(c.active & ~c.again) ? 0 : 1;
        derivatives(s, c.t, c.h, known, k, sum);
        const dal_times ratio = ratio853(s, &c, k, sum);
#ifndef DAL_SPECIALISED
        if (DAL_RARELY(s->dense != NULL)) extend(s, &c, k, sum);
#endif
        dal_control_end(s, &c, ratio, sum);
    }
    return dal_control_status(s, &c);
}
#endif

DAL_INLINE dal_status step(dal_step *s)
{
    DAL_VECTOR(s, k, STAGES_853 * DAL_DIM(s));
    DAL_VECTOR(s, sum, DAL_DIM(s));
#if DAL_WITH(CONTROL)
    if (DAL_CONTROLLED(s)) return divided(s, k, sum);
#endif
    const num t = dal_num(s->t), h = dal_num(s->h);
    derivatives(s, (dal_times)t, (dal_times)h, 0, k, sum);
    return dal_update_multiple(s, s->h, s->h, sum);
}

#define ABOUT_DOP853                                                                               \
    "The explicit Runge-Kutta method of Dormand and Prince of order 8 with twelve stages "         \
    "(Hairer, Norsett, Wanner 1993, II.5),\n"                                                      \
    "$$k_i = f\\left(t + c_i h,\\; y_0 + h \\sum_{j < i} a_{ij}\\,k_j\\right), \\qquad y_1 = "     \
    "y_0 + h \\sum_{i=1}^{12} b_i\\,k_i.$$\n"                                                      \
    "With `--tolerance` two embedded estimates of the error choose the sizes of substeps. It "     \
    "preserves only linear $D$ with constant coefficients; with a tolerance near rounding its "    \
    "drifts are as small as rounding permits."

DAL_INTEGRATOR(dop853, step, .name = "dop853", .summary = "Dormand-Prince, 12 stages",
               .reference = "Hairer, Norsett, Wanner 1993, II.5", .documentation = ABOUT_DOP853,
               .order = 8, .stages = 2,
               .properties = DAL_EXPLICIT | DAL_COMPONENTWISE | DAL_ADAPTIVE,
               .needs = DAL_NEEDS_FIELD, .kernel = DAL_KERNEL_CONTROL);
