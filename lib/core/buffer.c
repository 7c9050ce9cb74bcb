/* buffer.c - a string buffer. */
#include "core/buffer.h"
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void dal__buffer_free(dal__buffer *buffer)
{
    free(buffer->bytes);
    *buffer = (dal__buffer){0};
}

void dal__buffer_append_bytes(dal__buffer *buffer, const char *bytes, size_t length)
{
    if (buffer->out_of_memory) return;
    if (length >= buffer->capacity - buffer->length) {
        const size_t capacity = 2 * buffer->capacity + length + 256;
        char *grown = length < SIZE_MAX / 4 ? realloc(buffer->bytes, capacity) : NULL;
        buffer->out_of_memory = !grown;
        if (!grown) return;
        buffer->bytes = grown;
        buffer->capacity = capacity;
    }
    memcpy(buffer->bytes + buffer->length, bytes, length);
    buffer->length += length;
    buffer->bytes[buffer->length] = '\0';
}

void dal__buffer_append(dal__buffer *buffer, const char *string)
{
    dal__buffer_append_bytes(buffer, string, strlen(string));
}

void dal__buffer_print(dal__buffer *buffer, const char *format, ...)
{
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= sizeof line)
        buffer->out_of_memory = true; /* no caller prints more at once */
    else
        dal__buffer_append_bytes(buffer, line, (size_t)length);
}

void dal__buffer_number(dal__buffer *buffer, double x)
{
    const bool negative = signbit(x) && !isnan(x);
    const double size = fabs(x);
    int exponent;
    if (negative) dal__buffer_append(buffer, "(-");
    if (isnan(x))
        dal__buffer_append(buffer, "NAN");
    else if (isinf(x))
        dal__buffer_append(buffer, "INFINITY");
    else if (size < 1e15 && size == floor(size))
        dal__buffer_print(buffer, "%lld.0", (long long)size);
    else { /* an odd integer times a power of two */
        int64_t mantissa = (int64_t)ldexp(frexp(size, &exponent), 53);
        for (exponent -= 53; mantissa % 2 == 0; mantissa /= 2) exponent++;
        dal__buffer_print(buffer, "0x%llxp%d", (unsigned long long)mantissa, exponent);
    }
    if (negative) dal__buffer_append(buffer, ")");
}
