/* wrap.c - fills lines of at most 80 columns with words. */
#include "wrap.h"

#include <string.h>

enum { LINE = 80, MAX_INDENT = 40 };

/* The place of the next word. */
typedef struct wrapper {
    FILE *out;
    int column, hanging;
} wrapper;

static void put_word(wrapper *w, const char *word, int length, int spaces)
{
    if (w->column > w->hanging && w->column + spaces + length > LINE) {
        fprintf(w->out, "\n%*s", w->hanging, "");
        w->column = w->hanging;
        spaces = 0;
    }
    fprintf(w->out, "%*s%.*s", spaces, "", length, word);
    w->column += spaces + length;
}

/* The end of a line is a space, two of them behind a sentence. */
static void put_words(wrapper *w, const char *text, const char *end)
{
    while (text < end) {
        int spaces = 0, length = 0;
        for (; text < end && *text == ' '; text++) spaces++;
        if (text < end && *text == '\n') {
            spaces = text[-1] == '.' ? 2 : 1;
            text += 1 + strspn(text + 1, " ");
        }
        while (text + length < end && text[length] != ' ' && text[length] != '\n') length++;
        if (length > 0) put_word(w, text, length, spaces);
        text += length;
    }
}

void cli_wrap(FILE *out, const char *text, int column, int hanging)
{
    wrapper w = {out, column, hanging};
    put_words(&w, text, text + strlen(text));
    fputc('\n', out);
}

/* Where the second column of an item begins: behind the first gap of two spaces. */
static int second_column(const char *line, int length)
{
    const int indent = (int)strspn(line, " ");
    for (int i = indent; i + 2 < length && i < MAX_INDENT; i++)
        if (line[i] == ' ' && line[i + 1] == ' ') return i + (int)strspn(line + i, " ");
    return indent + 4;
}

static const char *end_of_line(const char *text) { return text + strcspn(text, "\n"); }

void cli_wrap_notes(FILE *out, const char *notes)
{
    while (*notes) {
        const char *end = end_of_line(notes);
        const int item = *notes == ' ', empty = end == notes;
        while (!item && !empty && *end && end[1] && end[1] != ' ' && end[1] != '\n')
            end = end_of_line(end + 1);
        const int hanging = item ? second_column(notes, (int)(end - notes)) : 0;
        while (item && *end && (int)strspn(end + 1, " ") >= hanging) end = end_of_line(end + 1);
        wrapper w = {out, 0, hanging};
        put_words(&w, notes, end);
        fputc('\n', out);
        notes = *end ? end + 1 : end;
    }
}
