/* error.c - statuses and their words, the caller's error record, the nearest name, and the
 * errors of arguments that are NULL or negative (see dalembert.h, conventions).
 *
 * The distance of two names is Damerau and Levenshtein's in its "optimal string alignment"
 * form: the smallest number of insertions, deletions, substitutions and swaps of neighbours.  It is
 * counted in quarters of an edit, so that a letter in the wrong case costs less than a wrong
 * letter. */
#include "core/error.h"
#include "core/words.h"
#include "dalembert_program.h"
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

const char *dal_status_name(dal_status status)
{
#define NAME(code, text) "DAL_" #code,
    DAL__RETURN_WORD(DAL_STATUS_LIST, NAME, status, "DAL_?");
}

const char *dal_status_text(dal_status status)
{
    DAL__RETURN_WORD(DAL_STATUS_LIST, DAL__SECOND, status, "unknown status");
}

dal_status dal__fail_at(dal_error *error, dal_status status, int line, int column,
                        const char *format, ...)
{
    if (!error) return status;
    va_list arguments;
    *error = (dal_error){.status = status, .line = line, .column = column};
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    /* Names come from the user's text: what would break the line or the terminal is masked. */
    for (char *c = error->message; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 127) *c = '?';
    return status;
}

dal_status dal__memory_error(dal_error *error)
{
    return dal__fail(error, DAL_STATUS_MEMORY, "out of memory");
}

enum { CASE = 1, EDIT = 4, MIN_LIMIT = 2 * EDIT };

static int min_of(int a, int b) { return a < b ? a : b; }

/* Quarter edits from a to b, neither longer than DAL__MAX_SHOWN.  row[k] holds the distances of the
 * first i - k letters of a to every beginning of b. */
static int distance(const char *a, const char *b)
{
    int row[3][DAL__MAX_SHOWN + 1] = {{0}}, la = (int)strlen(a), lb = (int)strlen(b);
    for (int j = 0; j <= lb; j++) row[0][j] = j * EDIT;
    for (int i = 1; i <= la; i++) {
        memcpy(row[2], row[1], sizeof row[1]);
        memcpy(row[1], row[0], sizeof row[0]);
        row[0][0] = i * EDIT;
        for (int j = 1; j <= lb; j++) {
            int d = min_of(row[1][j], row[0][j - 1]) + EDIT;
            const char x = a[i - 1], y = b[j - 1], low = (char)(x | 0x20);
            const bool same_letter = (x ^ y) == 0x20 && low >= 'a' && low <= 'z';
            d = min_of(d, row[1][j - 1] + (x == y ? 0 : same_letter ? CASE : EDIT));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d = min_of(d, row[2][j - 2] + EDIT);
            row[0][j] = d;
        }
    }
    return row[0][lb];
}

/* Other spellings of a velocity, other = "x'": vx, v_x, dx, xdot and x_dot. */
static bool spells_velocity(const char *name, const char *other)
{
    static const char *const before[] = {"v", "v_", "d", "", ""};
    static const char *const after[] = {"", "", "", "dot", "_dot"};
    const size_t length = strlen(other);
    if (length < 2 || other[length - 1] != '\'') return false;
    for (size_t k = 0; k < sizeof before / sizeof *before; k++) {
        const size_t n = strlen(before[k]);
        if (strncmp(name, before[k], n) == 0 && strncmp(name + n, other, length - 1) == 0 &&
            strcmp(name + n + length - 1, after[k]) == 0)
            return true;
    }
    return false;
}

const char *dal__nearest_name(const char *name, const char *const *names, int count)
{
    size_t length = name && names ? strlen(name) : DAL__MAX_SHOWN + 1;
    if (length > DAL__MAX_SHOWN) return NULL;
    int limit = (int)length * EDIT / 3, best = INT_MAX;
    if (limit < MIN_LIMIT) limit = MIN_LIMIT;
    const char *nearest = NULL;
    for (int i = 0; i < count; i++) {
        size_t other = names[i] ? strlen(names[i]) : DAL__MAX_SHOWN + 1;
        if (other > DAL__MAX_SHOWN) continue;
        if (spells_velocity(name, names[i])) return names[i];
        int d = distance(name, names[i]);
        int everything = EDIT * (int)(other > length ? other : length);
        if (d > limit || d >= everything || d >= best) continue;
        best = d, nearest = names[i];
    }
    return nearest;
}

dal_status dal__unknown_at(dal_error *error, int line, int column, const char *what,
                           const char *name, const char *const *names, int count)
{
    const char *nearest = dal__nearest_name(name, names, count);
    if (!nearest)
        return dal__fail_at(error, DAL_STATUS_NAME, line, column, "unknown %s '%.*s'", what,
                            DAL__MAX_SHOWN, name);
    return dal__fail_at(error, DAL_STATUS_NAME, line, column, "unknown %s '%s'; did you mean '%s'?",
                        what, name, nearest);
}

/* ---- arguments ---- */

dal_status dal__missing(dal_error *error, const char *function, const char *argument)
{
    return dal__fail(error, DAL_STATUS_ARGUMENT, "%s: %s is NULL", function, argument);
}

dal_status dal__negative(dal_error *error, const char *function, const char *argument,
                         long long value)
{
    return dal__fail(error, DAL_STATUS_ARGUMENT, "%s: %s is negative: %lld", function, argument,
                     value);
}
