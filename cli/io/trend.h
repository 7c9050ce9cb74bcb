/* trend.h - size and trend of a quantity, as CSV and as words. */
#ifndef DAL_CLI_TREND_H
#define DAL_CLI_TREND_H

#include "csv_table.h"
#include "dalembert_statistics.h"
#include "json.h"

#include <stdio.h>

/* The columns amplitude, rate, rate_low, rate_high, exponent, size, trend, confidence of a CSV
 * file; and the cells first, last, max |x|, max |x - first| and those, with a comma before each:
 * what cannot be stated is empty. */
extern const char cli_trend_heads[];
void cli_put_values(FILE *out, const dal_trend *trend);
/* The trend in a row of a table with such columns; not conserved where none is stated. */
dal_trend cli_get_trend(const csv_table *table, int row);
/* The same as members of an object: amplitude to confidence; what cannot be stated is null. */
void cli_put_trend(json_writer *writer, const dal_trend *trend);
/* Size and trend as words; "" where the motion need not conserve the quantity. */
const char *cli_size_word(const dal_trend *trend);
const char *cli_trend_word(const dal_trend *trend);
/* The trend for a reader: "linear", "linear, confidence 0.87" (where it is no certainty),
 * "undecided, likeliest linear",
 * "none, |drift| <= 1.2e-15" (the largest drift that the interval of the rate admits over the run),
 * or that the motion does not conserve the quantity.  Returns buffer. */
char *cli_trend_text(const dal_trend *trend, char *buffer, size_t size);

#endif
