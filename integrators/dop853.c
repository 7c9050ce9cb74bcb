/* dop853.c - the method of order 8 of Dormand and Prince, DOP853.
 *
 *     k_i = f(t + c_i h, y + h sum_(j<i) a_ij k_j), i = 1..12       y1 = y + h sum_i b_i k_i
 *
 * Dormand, Prince; Hairer, Norsett, Wanner, Solving ODEs I (1993), II.5, II.10.  Digits as in
 * Hairer's dop853.f and Williams' dop853 (BSD).  Order 8, explicit, twelve evaluations; preserves D
 * with constant coefficients, no other.  With a tolerance the sizes of substeps follow the two
 * estimates of the error in dop853.f. */
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
/* Row i, below the diagonal, begins at i(i-1)/2, rows from 0. */
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
/* clang-format on */

enum { STAGES_853 = 12 };

/* out += sum_(j < count) weight_j k_j */
DAL_INLINE void add_derivatives(int dim, int count, const double *weight, const num *k,
                                num *DAL_RESTRICT out)
{
    DAL_EACH(j, count) {
        if (weight[j] == 0.0) continue;
        DAL_EACH(i, dim) out[i] = dal_fma(dal_num(weight[j]), k[j * dim + i], out[i]);
    }
}

/* k_i of a step of size h, from the first on that is not known yet, and the sum of b_i k_i. */
DAL_INLINE void derivatives(dal_step *s, double size, int first, num *k, num *sum)
{
    const int dim = DAL_DIM(s);
    const num h = dal_num(size);
    DAL_EACH(stage, STAGES_853) {
        if (stage < first) continue;
        DAL_EACH(i, dim) sum[i] = dal_num(0.0);
        add_derivatives(dim, stage, a853 + stage * (stage - 1) / 2, k, sum);
        DAL_EACH(i, dim) sum[i] = dal_fma(h, sum[i], s->y[i]);
        dal_field(s, s->t + c853[stage] * size, sum, k + stage * dim);
    }
    DAL_EACH(i, dim) sum[i] = dal_num(0.0);
    add_derivatives(dim, STAGES_853, b853, k, sum);
}

#ifdef DAL_CONTROLLED
/* clang-format off */
/* The weights of the method of order 3 inside, bhh; and those of order 8 less those of order 5, er:
 * what they sum to vanishes up to h^3, h^5. */
static const double third853[] = {0.244094488188976377952755905512, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.733846688281611857341361741547, 0.0, 0.0, 0.220588235294117647058823529412e-1};
static const double fifth853[] = {0.1312004499419488073250102996e-1, 0.0, 0.0, 0.0, 0.0,
    -1.225156446376204440720569753, -0.4957589496572501915214079952,
    1.664377182454986536961530415, -0.3503288487499736816886487290,
    0.3341791187130174790297318841, 0.8192320648511571246570742613e-1,
    -0.2235530786388629525884427845e-1};
/* clang-format on */

/* error / tolerance over count components from first on:
 *     |h| |e5|^2 / sqrt(count (|e5|^2 + |e3|^2/100)),   e_i in units of tolerance (1 + |y_i|) */
static double error853(const dal_step *s, const dal_trial *k, const num *e3, const num *e5,
                       int first, int count)
{
    double square3 = 0.0, square5 = 0.0;
    for (int i = first; i < first + count; i++) {
        const double size = dal_max(dal_abs(s->y[i]), dal_abs(s->y[i] + k->h * k->derivative[i]));
        const double unit = s->tolerance + s->tolerance * size;
        square3 += e3[i] / unit * (e3[i] / unit);
        square5 += e5[i] / unit * (e5[i] / unit);
    }
    const double both = square5 + 0.01 * square3;
    return both == 0.0 ? 0.0 : fabs(k->h) * square5 / sqrt(count * both);
}

/* The error of (q,v) and that of (p,pi) each by itself, and none of e and pi_e, so that the
 * substeps of (q,v) on the surface know neither the space nor the gauge. */
static void attempt853(dal_step *s, dal_trial *k)
{
    const int dim = DAL_DIM(s), n = DAL_N(s);
    DAL_VECTOR(s, e3, DAL_DIM(s));
    DAL_VECTOR(s, e5, DAL_DIM(s));
    derivatives(s, k->h, k->again ? 1 : 0, k->derivatives, k->derivative);
    DAL_EACH(i, dim) e3[i] = -k->derivative[i];
    DAL_EACH(i, dim) e5[i] = 0.0;
    add_derivatives(dim, STAGES_853, third853, k->derivatives, e3);
    add_derivatives(dim, STAGES_853, fifth853, k->derivatives, e5);
    double error = error853(s, k, e3, e5, 0, n + DAL_NW(s));
    if (DAL_LIFTED(s)) {
        const double momenta = error853(s, k, e3, e5, dal_at_p(s), 2 * n);
        if (momenta > error || isnan(momenta)) error = momenta;
    }
    k->ratio = sqrt(sqrt(sqrt(error)));
}
#endif

DAL_INLINE dal_status step(dal_step *s)
{
    DAL_VECTOR(s, k, STAGES_853 * DAL_DIM(s));
    DAL_VECTOR(s, sum, DAL_DIM(s));
#ifdef DAL_CONTROLLED
    if (DAL_CONTROLLED(s))
        return dal_control(s, attempt853, &(dal_trial){.derivatives = k, .derivative = sum});
#endif
    derivatives(s, s->h, 0, k, sum);
    return dal_update_multiple(s, s->h, s->h, sum);
}

DAL_INTEGRATOR(dop853, step, .name = "dop853", .summary = "Dormand-Prince, 12 stages",
               .reference = "Hairer, Norsett, Wanner 1993, II.5", .order = 8, .stages = 2,
               .properties = DAL_EXPLICIT | DAL_COMPONENTWISE | DAL_ADAPTIVE,
               .needs = DAL_NEEDS_FIELD);
