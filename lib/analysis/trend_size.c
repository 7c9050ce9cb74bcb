/* trend_size.c - whether a deviation is what roundings of so many steps make.
 *
 * R = max |x - first| / (eps scale), n steps.  One rounding has a deviation of 0.29 units in the
 * last place; ten to thirty of them in a step make 0.9 to 1.6 eps, and the maximum of their sum
 * passes 2.8 sqrt(n) once in a hundred: 4.5 sqrt(n).  16 sqrt(n) leaves a factor 3.5 for condition.
 * In celestial mechanics an optimal integrator follows sqrt(t), and a bias of a fraction of eps a
 * step shows as t (Brouwer 1937, DOI 10.1086/105423; Rein, Spiegel 2015, DOI
 * 10.1093/mnras/stu2164).  Hence a deviation is
 *
 *     rounding   R <= 64; or the steps are of a hundred eps at most, and the deviation about first,
 *                or about a line of at most one eps a step, is within 16 sqrt(n) and five times
 *                the roughness sqrt(sum of squared steps), which a sum of independent errors
 *                passes once in 10^6 and a smooth change at once.  Where the trend is linear, a
 *                bias, the roughness does not count: its steps are alike;
 *     larger     else. */
#include "analysis/trend.h"
#include <float.h>
#include <math.h>

static const double few_roundings = 64.0, per_root_step = 16.0, largest_step = 128.0;
static const double smoothness = 5.0; /* deviations in units of the roughness */

dal_size_class dal__trend_size(const dal_statistics *s, double scale, const dal_trend *trend)
{
    const double eps = DBL_EPSILON * scale, steps = (double)s->count - 1.0;
    if (!(trend->deviation > 0.0)) return DAL_SIZE_EXACT;
    if (trend->deviation <= few_roundings * eps) return DAL_SIZE_ROUNDING;
    const double roughness = dal__roughness(s) / s->factor;
    const double by_steps = per_root_step * eps * sqrt(steps);
    const double max = fmin(by_steps, smoothness * roughness);
    const double per_step = fabs(trend->rate) * (s->to - s->from) / steps;
    const double about_line = trend->trend == DAL_TREND_LINEAR ? by_steps : max;
    const bool is_near =
        trend->deviation <= max || (trend->amplitude <= about_line && per_step <= eps);
    const bool has_small_steps = roughness <= largest_step * eps * sqrt(steps);
    return is_near && has_small_steps ? DAL_SIZE_ROUNDING : DAL_SIZE_LARGER;
}

const char *dal_size_text(dal_size_class size)
{
    static const char *const text[] = {
#define SIZE_WORD(code, word) word,
        DAL_SIZE_LIST(SIZE_WORD)
#undef SIZE_WORD
    };
    return (unsigned)size < DAL_SIZE_COUNT ? text[size] : "?";
}
