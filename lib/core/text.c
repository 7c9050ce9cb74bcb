/* text.c - a text that grows. */
#include "core/text.h"
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void dal__text_free(dal__text *text)
{
    free(text->bytes);
    *text = (dal__text){0};
}

static bool reserve(dal__text *text, size_t more)
{
    if (text->out_of_memory || more < text->capacity - text->length) return !text->out_of_memory;
    const size_t capacity = 2 * text->capacity + more + 256;
    char *bytes = more < SIZE_MAX / 4 ? realloc(text->bytes, capacity) : NULL;
    text->out_of_memory = !bytes;
    if (!bytes) return false;
    text->bytes = bytes;
    text->capacity = capacity;
    return true;
}

void dal__text_add(dal__text *text, const char *bytes, size_t length)
{
    if (!reserve(text, length + 1)) return;
    memcpy(text->bytes + text->length, bytes, length);
    text->length += length;
    text->bytes[text->length] = '\0';
}

void dal__text_put(dal__text *text, const char *string)
{
    dal__text_add(text, string, strlen(string));
}

void dal__text_print(dal__text *text, const char *format, ...)
{
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= sizeof line)
        text->out_of_memory = true; /* no caller writes so much at once */
    else
        dal__text_add(text, line, (size_t)length);
}

void dal__text_number(dal__text *text, double x)
{
    const bool negative = signbit(x) && !isnan(x);
    const double size = fabs(x);
    int exponent;
    if (negative) dal__text_put(text, "(-");
    if (isnan(x))
        dal__text_put(text, "NAN");
    else if (isinf(x))
        dal__text_put(text, "INFINITY");
    else if (size < 1e15 && size == floor(size))
        dal__text_print(text, "%lld.0", (long long)size);
    else { /* an odd integer times a power of two */
        int64_t mantissa = (int64_t)ldexp(frexp(size, &exponent), 53);
        for (exponent -= 53; mantissa % 2 == 0; mantissa /= 2) exponent++;
        dal__text_print(text, "0x%llxp%d", (unsigned long long)mantissa, exponent);
    }
    if (negative) dal__text_put(text, ")");
}
