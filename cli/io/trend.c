/* trend.c - the columns of a trend, the same for runs and studies. */
#include "trend.h"

#include "csv_cells.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

const char cli_trend_heads[] = "amplitude,rate,rate_low,rate_high,exponent,size,trend,confidence";

/* What the motion need not conserve has neither size nor trend. */
static bool is_stated(const dal_trend *trend) { return trend->conservation == DAL_CONSERVED; }

void cli_put_values(FILE *out, const dal_trend *t)
{
    enum { ALWAYS = 4 };
    const double cells[] = {t->first,     t->last,      t->max_abs,
                            t->deviation, t->amplitude, t->rate,
                            t->rate_low,  t->rate_high, is_stated(t) ? t->exponent : NAN};
    for (int i = 0; i < (int)(sizeof cells / sizeof cells[0]); i++) {
        fputc(',', out);
        (i < ALWAYS ? csv_put : csv_put_known)(out, cells[i]);
    }
    fprintf(out, ",%s,%s,", cli_size_word(t), cli_trend_word(t));
    if (is_stated(t)) csv_put_known(out, t->confidence);
}

dal_trend cli_get_trend(const csv_table *t, int row)
{
    const char *size = csv_table_get(t, row, "size"), *trend = csv_table_get(t, row, "trend");
    int size_class = 0, trend_class = 0;
    while (size_class < DAL_SIZE_LARGER &&
           strcmp(dal_size_text((dal_size_class)size_class), size) != 0)
        size_class++;
    while (trend_class < DAL_TREND_COUNT - 1 &&
           strcmp(dal_trend_text((dal_trend_class)trend_class), trend) != 0)
        trend_class++;
    /* summary.csv names two of the columns in another way. */
    return (dal_trend){
        .count = 1,
        .first = csv_table_number(t, row, "first"),
        .last = fmax(csv_table_number(t, row, "last"), csv_table_number(t, row, "final")),
        .max_abs = fmax(csv_table_number(t, row, "max"), csv_table_number(t, row, "maximum")),
        .deviation = csv_table_number(t, row, "deviation"),
        .rate = csv_table_number(t, row, "rate"),
        .exponent = csv_table_number(t, row, "exponent"),
        .size = (dal_size_class)size_class,
        .trend = (dal_trend_class)trend_class,
        .conservation = trend[0] ? DAL_CONSERVED : DAL_NOT_CONSERVED,
    };
}

void cli_put_trend(json_writer *w, const dal_trend *t)
{
    const bool stated = is_stated(t);
    json_put_number(w, "amplitude", t->amplitude);
    json_put_number(w, "rate", t->rate);
    json_put_number(w, "rate_low", t->rate_low);
    json_put_number(w, "rate_high", t->rate_high);
    json_put_number(w, "exponent", stated ? t->exponent : NAN);
    json_put_text(w, "size", stated ? dal_size_text(t->size) : NULL);
    json_put_text(w, "trend", stated ? dal_trend_text(t->trend) : NULL);
    json_put_number(w, "confidence", stated ? t->confidence : NAN);
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
    char drift[64] = "", confidence[48] = "";
    if (!is_stated(trend)) {
        snprintf(buffer, size, "%s", dal_conservation_text(trend->conservation));
        return buffer;
    }
    if (trend->trend == DAL_TREND_NONE && trend->size != DAL_SIZE_EXACT)
        snprintf(drift, sizeof drift, ", |drift| <= %.1e", trend->max_drift);
    if (trend->confidence < 0.995)
        snprintf(confidence, sizeof confidence, ", confidence %.2f", trend->confidence);
    if (trend->trend == DAL_TREND_UNDECIDED && trend->likeliest != DAL_TREND_UNDECIDED)
        snprintf(confidence, sizeof confidence, ", likeliest %s", dal_trend_text(trend->likeliest));
    snprintf(buffer, size, "%s%s%s", dal_trend_text(trend->trend), drift, confidence);
    return buffer;
}
