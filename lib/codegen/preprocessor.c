/* preprocessor.c - sources of the library as text in a generated file.
 *
 * A preprocessor in part: conditions with known names are decided, so that what is not needed does
 * not reach the file.  Lines of
 *
 *     text      = { line | chain }
 *     chain     = ( "#if" test | "#ifdef" name | "#ifndef" name ) text
 *                 { "#elif" test text } [ "#else" text ] "#endif"
 *     test      = factor { "&&" factor }
 *     factor    = [ "!" ] name
 *     name      = word | "DAL_WITH(" word ")"
 *     word      = a capital letter or "_", and more of them
 *
 * A "#" of a chain begins its line, and chains are at most 15 deep.  A test is known where each of
 * its names is one of the conditions of the generation.  Of a known chain neither the directives
 * are written nor what they leave out; where branches before an "#elif" are left out, the chain
 * begins with that, as "#if".  Tests of any other form, and all other directives, are left to the
 * compiler as they are.  The word PREFIX becomes the prefix of the file. */
#include "codegen/preprocessor.h"
#include <string.h>

/* ---- conditions ---- */

enum { UNKNOWN = -1 };

/* The value of a name, 0 or 1, of the length given. */
static int value_of(const dal__generation *g, const char *name, size_t length)
{
    for (int i = 0; i < g->conditions; i++)
        if (strlen(g->condition[i].name) == length &&
            strncmp(g->condition[i].name, name, length) == 0)
            return g->condition[i].value != 0;
    return UNKNOWN;
}

static size_t name_length(const char *name)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    const size_t word = strspn(name, letters);
    if (name[word] != '(') return word;
    const size_t end = word + 1 + strspn(name + word + 1, letters);
    return name[end] == ')' ? end + 1 : word;
}

/* NAME, !NAME, and several of these with && between: UNKNOWN where it is anything else. */
static int evaluate(const dal__generation *g, const char *at)
{
    int all = 1;
    for (;;) {
        while (*at == ' ') at++;
        const bool negated = *at == '!';
        at += negated;
        const size_t length = name_length(at);
        const int value = value_of(g, at, length);
        if (value == UNKNOWN) return UNKNOWN;
        all &= value ^ negated;
        at += length;
        while (*at == ' ') at++;
        if (*at == '\n') return all;
        if (strncmp(at, "&&", 2) != 0) return UNKNOWN;
        at += 2;
    }
}

static bool begins(const char *line, const char *word)
{
    return strncmp(line, word, strlen(word)) == 0;
}

/* The value of a line #if, #ifdef, #ifndef or #elif. */
static int decide(const dal__generation *g, const char *line)
{
    const bool negated = begins(line, "#ifndef");
    const int value = evaluate(g, line + strcspn(line, " "));
    return negated && value != UNKNOWN ? !value : value;
}

/* An open #if: its value, whether the lines around it and in its present branch are written. */
typedef struct branch {
    int value;
    bool around, on;
} branch;

/* An #if or #elif of a chain of which no branch is taken yet. */
static void decide_branch(const dal__generation *g, const char *line, branch *b)
{
    b->value = decide(g, line);
    b->on = b->around && b->value != 0;
}

/* Whether a directive is left to the compiler; keeps the open branches. */
static bool passes(const dal__generation *g, const char *line, branch *open, int *depth)
{
    branch *b = &open[*depth];
    if (begins(line, "#if")) {
        open[++*depth].around = b->on;
        decide_branch(g, line, ++b);
    } else if (begins(line, "#endif")) {
        --*depth;
    } else if (b->value == 1) {
        b->on = false;
    } else if (b->value == 0 && begins(line, "#elif")) {
        decide_branch(g, line, b);
    } else if (b->value == 0) {
        b->on = b->around;
    }
    return b->around && b->value == UNKNOWN;
}

/* ---- text ---- */

/* Writes text up to end, with the prefix for the word PREFIX. */
static void write_piece(dal__generation *g, const char *text, const char *end)
{
    static const char word[] = "PREFIX";
    for (const char *next; (next = strstr(text, word)) && next < end; text = next + strlen(word)) {
        dal__buffer_append_bytes(&g->text, text, (size_t)(next - text));
        dal__buffer_append(&g->text, g->prefix);
    }
    dal__buffer_append_bytes(&g->text, text, (size_t)(end - text));
}

void dal__write_template(dal__generation *g, const char *text)
{
    write_piece(g, text, text + strlen(text));
}

void dal__preprocess(dal__generation *g, const char *text)
{
    enum { MAX_DEPTH = 16 };
    branch open[MAX_DEPTH] = {{UNKNOWN, true, true}};
    int depth = 0;
    for (size_t length; *text; text += length) {
        length = strcspn(text, "\n");
        length += text[length] == '\n';
        /* What follows branches that are left out begins the chain. */
        const bool begins_chain = begins(text, "#elif") && open[depth].value == 0;
        const bool conditional =
            begins(text, "#if") || begins(text, "#el") || begins(text, "#endif");
        if (!(conditional ? passes(g, text, open, &depth) : open[depth].on)) continue;
        if (begins_chain) dal__buffer_append(&g->text, "#");
        write_piece(g, begins_chain ? text + strlen("#el") : text, text + length);
    }
}

void dal__write_item(dal__generation *g, const char *item)
{
    enum { WIDTH = 100 };
    size_t column = strlen(item) + 1;
    for (size_t i = g->text.length; i > 0 && g->text.bytes[i - 1] != '\n'; i--) column++;
    dal__buffer_append(&g->text, column > WIDTH ? "\n    " : " ");
    dal__buffer_append(&g->text, item);
}
