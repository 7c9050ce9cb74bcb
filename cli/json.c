/* json.c - pieces of JSON, all of them ASCII. */
#include "json.h"

#include <math.h>

void json_text(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c < ' ' || c > '~')
            fprintf(out, "\\u%04x", c);
        else if (c == '"' || c == '\\')
            fprintf(out, "\\%c", c);
        else
            fputc(c, out);
    }
    fputc('"', out);
}

void json_number(FILE *out, double x)
{
    if (isfinite(x))
        cli_put(out, x);
    else
        fputs("null", out);
}

static void put_name(FILE *out, const char *before, const char *name)
{
    fputs(before, out);
    json_text(out, name);
    fputs(": ", out);
}

void json_text_member(FILE *out, const char *before, const char *name, const char *text)
{
    put_name(out, before, name);
    json_text(out, text);
}

void json_number_member(FILE *out, const char *before, const char *name, double x)
{
    put_name(out, before, name);
    json_number(out, x);
}
