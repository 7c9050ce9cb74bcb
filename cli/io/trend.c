/* trend.c - the columns of a trend, the same for runs and studies. */
#include "trend.h"

#include "output.h"

#include <math.h>
#include <stdbool.h>

const char cli_trend_heads[] = "amplitude,rate,rate_low,rate_high,exponent,size,trend,confidence";

/* What the motion need not conserve has neither size nor trend. */
static bool is_stated(const dal_trend *trend) { return trend->conservation == DAL_CONSERVED; }

void cli_put_trend(FILE *out, const dal_trend *trend)
{
    const double cells[] = {trend->amplitude, trend->rate, trend->rate_low, trend->rate_high,
                            is_stated(trend) ? trend->exponent : NAN};
    for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++) {
        fputc(',', out);
        if (!isnan(cells[i])) cli_put(out, cells[i]);
    }
    fprintf(out, ",%s,%s,", cli_size_word(trend), cli_trend_word(trend));
    if (is_stated(trend)) cli_put(out, trend->confidence);
}

void cli_put_values(FILE *out, const dal_trend *trend)
{
    const double values[] = {trend->first, trend->last, trend->max_abs, trend->deviation};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        fputc(',', out);
        cli_put(out, values[i]);
    }
    cli_put_trend(out, trend);
}

const char *cli_size_word(const dal_trend *trend)
{
    return is_stated(trend) ? dal_size_text(trend->size) : "";
}

const char *cli_trend_word(const dal_trend *trend)
{
    return is_stated(trend) ? dal_trend_text(trend->trend) : "";
}

char *cli_trend_text(const dal_trend *trend, char *buffer, size_t size)
{
    char drift[64] = "", confidence[32] = "";
    if (!is_stated(trend)) {
        snprintf(buffer, size, "%s", dal_conservation_text(trend->conservation));
        return buffer;
    }
    if (trend->trend == DAL_TREND_NONE && trend->size != DAL_SIZE_EXACT)
        snprintf(drift, sizeof drift, ", |drift| <= %.1e", trend->max_drift);
    if (trend->confidence < 0.995)
        snprintf(confidence, sizeof confidence, ", confidence %.2f", trend->confidence);
    snprintf(buffer, size, "%s%s%s", dal_trend_text(trend->trend), drift, confidence);
    return buffer;
}
