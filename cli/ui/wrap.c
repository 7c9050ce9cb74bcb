/* wrap.c - fills lines with words. */
#include "wrap.h"

#include <string.h>

enum { LINE = 80, MAX_INDENT = 40 };

static bool begins_character(char byte) { return ((unsigned char)byte & 0xC0) != 0x80; }

int cli_columns(const char *text)
{
    int n = 0;
    for (; *text; text++) n += begins_character(*text);
    return n;
}

int cli_fit(const char *text, int columns)
{
    int length = 0;
    for (; text[length]; length++)
        if (begins_character(text[length]) && columns-- == 0) break;
    return length;
}

/* The place of the next word. */
typedef struct wrapper {
    FILE *out;
    int column, hanging, width;
} wrapper;

static void put_word(wrapper *w, const char *word, int length, int spaces)
{
    if (w->column > w->hanging && w->column + spaces + length > w->width) {
        fprintf(w->out, "\n%*s", w->hanging, "");
        w->column = w->hanging;
        spaces = 0;
    }
    fprintf(w->out, "%*s%.*s", spaces, "", length, word);
    w->column += spaces + length;
}

/* The end of a line is a space, two of them after a sentence. */
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

void cli_wrap_to(FILE *out, const char *text, int column, int hanging, int width)
{
    wrapper w = {out, column, hanging, width};
    put_words(&w, text, text + strlen(text));
    fputc('\n', out);
}

void cli_wrap(FILE *out, const char *text, int column, int hanging)
{
    cli_wrap_to(out, text, column, hanging, LINE);
}

static const char *end_of_line(const char *text) { return text + strcspn(text, "\n"); }

/* The second column of an item begins after the first gap of two spaces. */
static void divide_item(const char *line, int length, cli_paragraph *p)
{
    const int indent = (int)strspn(line, " ");
    p->text = p->name = line + indent;
    p->hanging = indent + 4;
    for (int i = indent; i + 2 < length && i < MAX_INDENT; i++) {
        if (line[i] != ' ' || line[i + 1] != ' ') continue;
        p->hanging = i + (int)strspn(line + i, " ");
        p->text = line + p->hanging;
        p->name_length = i - indent;
        return;
    }
}

const char *cli_next_paragraph(const char *notes, cli_paragraph *p)
{
    const char *end = end_of_line(notes);
    *p = (cli_paragraph){.begin = notes, .text = notes, .is_item = *notes == ' '};
    const bool is_empty = end == notes;
    if (p->is_item) divide_item(notes, (int)(end - notes), p);
    while (!p->is_item && !is_empty && *end && end[1] && end[1] != ' ' && end[1] != '\n')
        end = end_of_line(end + 1);
    while (p->is_item && *end && (int)strspn(end + 1, " ") >= p->hanging)
        end = end_of_line(end + 1);
    p->end = end;
    return *end ? end + 1 : end;
}

void cli_wrap_notes(FILE *out, const char *notes)
{
    while (*notes) {
        cli_paragraph p;
        notes = cli_next_paragraph(notes, &p);
        wrapper w = {out, 0, p.hanging, LINE};
        put_words(&w, p.begin, p.end);
        fputc('\n', out);
    }
}
