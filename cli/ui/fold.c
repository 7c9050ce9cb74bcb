/* fold.c - texts as lines of at most 80 columns.
 *
 * Prose is filled anew.  A line that begins with spaces is an item, "  NAME   what it is"; it goes
 * on below what it is, as do the lines that already stand there. */
#include "cli.h"

#include <string.h>

enum { LINE = 80, DEEPEST = 40 };

/* Where the words of a text stand. */
typedef struct fold {
    FILE *out;
    int column, hanging;
} fold;

static void put_word(fold *f, const char *word, int length, int spaces)
{
    if (f->column > f->hanging && f->column + spaces + length > LINE) {
        fprintf(f->out, "\n%*s", f->hanging, "");
        f->column = f->hanging;
        spaces = 0;
    }
    fprintf(f->out, "%*s%.*s", spaces, "", length, word);
    f->column += spaces + length;
}

/* The end of a line is a space, two of them behind a sentence. */
static void put_words(fold *f, const char *text, const char *end)
{
    while (text < end) {
        int spaces = 0, length = 0;
        for (; text < end && *text == ' '; text++) spaces++;
        if (text < end && *text == '\n') {
            spaces = text[-1] == '.' ? 2 : 1;
            text += 1 + strspn(text + 1, " ");
        }
        while (text + length < end && text[length] != ' ' && text[length] != '\n') length++;
        if (length > 0) put_word(f, text, length, spaces);
        text += length;
    }
}

void cli_fold(FILE *out, const char *text, int column, int hanging)
{
    fold f = {out, column, hanging};
    put_words(&f, text, text + strlen(text));
    fputc('\n', out);
}

/* Where the second column of an item begins: behind the first gap of two spaces. */
static int second_column(const char *line, int length)
{
    const int indent = (int)strspn(line, " ");
    for (int i = indent; i + 2 < length && i < DEEPEST; i++)
        if (line[i] == ' ' && line[i + 1] == ' ') return i + (int)strspn(line + i, " ");
    return indent + 4;
}

static const char *end_of_line(const char *text) { return text + strcspn(text, "\n"); }

void cli_fold_notes(FILE *out, const char *notes)
{
    while (*notes) {
        const char *end = end_of_line(notes);
        const int item = *notes == ' ', empty = end == notes;
        while (!item && !empty && *end && end[1] && end[1] != ' ' && end[1] != '\n')
            end = end_of_line(end + 1);
        const int hanging = item ? second_column(notes, (int)(end - notes)) : 0;
        while (item && *end && (int)strspn(end + 1, " ") >= hanging) end = end_of_line(end + 1);
        fold f = {out, 0, hanging};
        put_words(&f, notes, end);
        fputc('\n', out);
        notes = *end ? end + 1 : end;
    }
}
