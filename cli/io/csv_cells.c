/* csv_cells.c - writes the numbers and texts of CSV files. */
#include "csv_cells.h"
#include "dalembert_program.h"
#include "text.h"

#include <math.h>
#include <string.h>

void csv_put(FILE *out, double x)
{
    /* Zero of either sign is common (p = pi = 0 on the surface) and quick to write. */
    if (x == 0.0) {
        fputc('0', out);
    } else if (isnan(x)) {
        fputs("nan", out);
    } else {
        char text[DAL__NUMBER_SIZE];
        fwrite(text, 1, (size_t)dal__format_number(text, x), out);
    }
}

void csv_put_known(FILE *out, double x)
{
    if (!isnan(x)) csv_put(out, x);
}

void csv_put_text(FILE *out, const char *text)
{
    if (strpbrk(text, ",\"") || text_find_control(text, "") >= 0)
        text_write_quoted(out, '"', text);
    else
        fputs(text, out);
}

void csv_put_cells(FILE *out, const double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        fputc(',', out);
        csv_put_known(out, numbers[i]);
    }
}
