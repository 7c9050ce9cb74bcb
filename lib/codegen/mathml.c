/* mathml.c - the equations of a model as MathML: latex.c typesets them, and the few forms of LaTeX
 * that typeset.c writes are read here.
 *
 * A row is a sequence of items, an item an atom with scripts.  Factors are separated by \, so that
 * brackets right after a name are the argument of a function. */
#include "codegen/typeset.h"
#include "core/error.h"
#include "dalembert_codegen.h"
#include "model/model.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 400 };

typedef struct reader {
    const char *at;
    int depth;
    bool is_too_deep;
    dal__buffer *out;
} reader;

static int read_row(reader *r);

static bool accept(reader *r, const char *word)
{
    if (strncmp(r->at, word, strlen(word)) != 0) return false;
    r->at += strlen(word);
    return true;
}

/* ---- elements ------------------------------------------------------------------------------ */

/* Inserts a tag before what was written from a place on. */
static void insert_tag(reader *r, size_t from, const char *tag)
{
    dal__buffer *out = r->out;
    const size_t rest = out->length - from, length = strlen(tag);
    dal__buffer_append(out, tag);
    if (out->out_of_memory) return;
    memmove(out->bytes + from + length, out->bytes + from, rest);
    memcpy(out->bytes + from, tag, length);
}

/* An element of a text, whose underscores LaTeX escapes. */
static void put_text(reader *r, const char *element, const char *text, size_t length)
{
    dal__buffer_print(r->out, "<%s>", element);
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '\\') continue;
        if (strchr("&<>", text[i]))
            dal__buffer_print(r->out, "&#%d;", text[i]);
        else
            dal__buffer_append_bytes(r->out, text + i, 1);
    }
    dal__buffer_print(r->out, "</%s>", element);
}

/* {...} as one element. */
static void read_group(reader *r)
{
    const size_t from = r->out->length;
    accept(r, "{");
    const int count = read_row(r);
    accept(r, "}");
    if (count == 1) return;
    insert_tag(r, from, "<mrow>");
    dal__buffer_append(r->out, "</mrow>");
}

/* ---- atoms --------------------------------------------------------------------------------- */

/* Signs, and the element of each. */
static bool read_sign(reader *r)
{
    static const struct {
        const char *latex, *element;
    } signs[] = {
        {"+", "<mo>+</mo>"},
        {"-", "<mo>&#x2212;</mo>"},
        {"=", "<mo>=</mo>"},
        {"<", "<mo>&lt;</mo>"},
        {",", "<mo>,</mo>"},
        {"\\le ", "<mo>&#x2264;</mo>"},
        {"\\cdot", "<mo>&#x22C5;</mo>"},
        {"\\,", "<mo lspace=\"0\" rspace=\"0.17em\">&#x2062;</mo>"}, /* invisible times */
        {"\\infty", "<mi>&#x221E;</mi>"},
        {"\\quad", "<mspace width=\"2em\"/>"},
    };
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (accept(r, signs[i].latex)) {
            dal__buffer_append(r->out, signs[i].element);
            return true;
        }
    return false;
}

/* Fractions, roots and accents: their operands, and what is after these. */
static bool read_construct(reader *r)
{
    static const struct {
        const char *latex, *begin, *end;
        int operands;
    } constructs[] = {
        {"\\frac", "<mfrac>", "</mfrac>", 2},
        {"\\tfrac", "<mfrac displaystyle=\"false\">", "</mfrac>", 2},
        {"\\sqrt", "<msqrt>", "</msqrt>", 1},
        {"\\dot", "<mover accent=\"true\">", "<mo>&#x2D9;</mo></mover>", 1},
        {"\\ddot", "<mover accent=\"true\">", "<mo>&#xA8;</mo></mover>", 1},
    };
    for (size_t i = 0; i < sizeof constructs / sizeof *constructs; i++) {
        if (!accept(r, constructs[i].latex)) continue;
        dal__buffer_append(r->out, constructs[i].begin);
        for (int k = 0; k < constructs[i].operands; k++) read_group(r);
        dal__buffer_append(r->out, constructs[i].end);
        return true;
    }
    return false;
}

/* Whether what was written from a place on is higher than a line. */
static bool is_high(const reader *r, size_t from)
{
    if (r->out->length == from || r->out->out_of_memory) return false;
    const char *text = r->out->bytes + from;
    return strstr(text, "<mfrac>") || strstr(text, "<mtable ");
}

/* Brackets, which grow with what they hold where that is high. */
static bool read_brackets(reader *r)
{
    static const struct {
        const char *open, *close, *left, *right;
    } brackets[] = {
        {"(", ")", "(</mo>", ")</mo></mrow>"},
        {"\\left(", "\\right)", "(</mo>", ")</mo></mrow>"},
        {"\\left|", "\\right|", "|</mo>", "|</mo></mrow>"},
        {"\\left\\lfloor", "\\right\\rfloor", "&#x230A;</mo>", "&#x230B;</mo></mrow>"},
    };
    for (size_t i = 0; i < sizeof brackets / sizeof *brackets; i++) {
        if (!accept(r, brackets[i].open)) continue;
        const size_t from = r->out->length;
        dal__buffer_append(r->out, brackets[i].left);
        read_row(r);
        accept(r, brackets[i].close);
        const char *stretchy = is_high(r, from) ? "true" : "false";
        char tag[64];
        snprintf(tag, sizeof tag, "<mrow><mo form=\"prefix\" stretchy=\"%s\">", stretchy);
        insert_tag(r, from, tag);
        dal__buffer_print(r->out, "<mo form=\"postfix\" stretchy=\"%s\">%s", stretchy,
                          brackets[i].right);
        return true;
    }
    return false;
}

static void read_cell(reader *r)
{
    dal__buffer_append(r->out, "<mtd style=\"text-align:-webkit-left\">");
    read_row(r);
    dal__buffer_append(r->out, "</mtd>");
}

/* The two lines of a cases environment. */
static bool read_cases(reader *r)
{
    if (!accept(r, "\\begin{cases}")) return false;
    dal__buffer_append(r->out,
                       "<mrow><mo form=\"prefix\">{</mo><mtable columnalign=\"left\"><mtr>");
    read_cell(r);
    for (;;) {
        if (accept(r, "\\\\"))
            dal__buffer_append(r->out, "</mtr><mtr>");
        else if (!accept(r, "&"))
            break;
        read_cell(r);
    }
    accept(r, "\\end{cases}");
    dal__buffer_append(r->out, "</mtr></mtable></mrow>");
    return true;
}

/* A calligraphic letter; those that Unicode had before the others are at other places. */
static void put_calligraphic(reader *r, char letter)
{
    static const struct {
        char letter;
        int code;
    } early[] = {{'B', 0x212C}, {'E', 0x2130}, {'F', 0x2131}, {'H', 0x210B},
                 {'I', 0x2110}, {'L', 0x2112}, {'M', 0x2133}, {'R', 0x211B},
                 {'e', 0x212F}, {'g', 0x210A}, {'o', 0x2134}};
    enum { SCRIPT_A = 0x1D49C, SCRIPT_SMALL_A = 0x1D4B6 };
    int code = letter >= 'a' ? SCRIPT_SMALL_A + letter - 'a' : SCRIPT_A + letter - 'A';
    for (size_t i = 0; i < sizeof early / sizeof *early; i++)
        if (early[i].letter == letter) code = early[i].code;
    dal__buffer_print(r->out, "<mi>&#x%X;</mi>", (unsigned)code);
}

/* \mathrm{..}, \operatorname{..} and \text{..} */
static bool read_word(reader *r)
{
    const bool is_text = accept(r, "\\text{");
    if (!is_text && !accept(r, "\\mathrm{") && !accept(r, "\\operatorname{")) return false;
    const size_t length = strcspn(r->at, "}");
    put_text(r, is_text ? "mtext" : "mi", r->at, length);
    r->at += length;
    accept(r, "}");
    return true;
}

/* A Greek letter, of which small ones are slanted, or a function. */
static void read_command(reader *r)
{
    accept(r, "\\");
    accept(r, "var");
    const size_t length =
        strspn(r->at, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789");
    const int code = dal__greek_letter(r->at, length);
    const bool is_capital = *r->at >= 'A' && *r->at <= 'Z';
    if (code)
        dal__buffer_print(r->out, "<mi%s>&#x%X;</mi>", is_capital ? " mathvariant=\"normal\"" : "",
                          (unsigned)code);
    else
        put_text(r, "mi", r->at, length);
    r->at += length;
}

/* A number, a letter or a command. */
static void read_name(reader *r)
{
    const size_t digits = strspn(r->at, "0123456789.");
    if (digits == 0 && *r->at == '\\') {
        read_command(r);
        return;
    }
    const size_t length = digits ? digits : 1;
    put_text(r, digits ? "mn" : "mi", r->at, length);
    r->at += length;
}

/* ---- items --------------------------------------------------------------------------------- */

/* Scripts of the atom that was written from a place on. */
static void read_scripts(reader *r, size_t from)
{
    const bool has_subscript = accept(r, "_");
    if (has_subscript) read_group(r);
    const bool has_power = accept(r, "^"), has_primes = !has_power && *r->at == '\'';
    if (has_power) {
        read_group(r);
    } else if (has_primes) {
        dal__buffer_append(r->out, "<mo>");
        while (accept(r, "'")) dal__buffer_append(r->out, "&#x2032;");
        dal__buffer_append(r->out, "</mo>");
    }
    if (!has_subscript && !has_power && !has_primes) return;
    const char *element = !has_subscript ? "msup" : has_power || has_primes ? "msubsup" : "msub";
    char tag[16];
    snprintf(tag, sizeof tag, "<%s>", element);
    insert_tag(r, from, tag);
    dal__buffer_print(r->out, "</%s>", element);
}

static void read_item(reader *r)
{
    const size_t from = r->out->length;
    if (read_sign(r)) return;
    const bool is_name = !read_construct(r) && !read_brackets(r) && !read_cases(r);
    if (is_name && accept(r, "\\mathcal{")) {
        put_calligraphic(r, *r->at++);
        accept(r, "}");
    } else if (is_name && accept(r, "\\mathsf{")) {
        enum { SANS_SERIF_A = 0x1D5A0 };
        dal__buffer_print(r->out, "<mi>&#x%X;</mi>", (unsigned)(SANS_SERIF_A + *r->at++ - 'A'));
        accept(r, "}");
    } else if (is_name && *r->at == '{') {
        read_group(r);
    } else if (is_name && !read_word(r)) {
        read_name(r);
    }
    read_scripts(r, from);
    const bool has_argument = *r->at == '(' || strncmp(r->at, "\\left(", 6) == 0;
    if (is_name && has_argument) dal__buffer_append(r->out, "<mo>&#x2061;</mo>"); /* applied to */
}

/* Whether a row ends here. */
static bool is_end(const char *at)
{
    return !*at || strchr("})&", *at) || strncmp(at, "\\\\", 2) == 0 ||
           strncmp(at, "\\right", 6) == 0 || strncmp(at, "\\end{", 5) == 0;
}

/* Items up to an end; returns how many they are. */
static int read_row(reader *r)
{
    int count = 0;
    r->is_too_deep |= ++r->depth > MAX_DEPTH;
    while (!r->is_too_deep) {
        r->at += strspn(r->at, " \n");
        if (is_end(r->at)) break;
        read_item(r);
        count++;
    }
    r->depth--;
    return count;
}

/* ---- the equations ------------------------------------------------------------------------- */

/* The rows of an align* as a table of left and right sides. */
static void read_alignment(reader *r)
{
    dal__buffer_append(r->out, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" "
                               "display=\"block\"><mtable columnalign=\"right left\" "
                               "displaystyle=\"true\">\n");
    do {
        dal__buffer_append(r->out, "<mtr><mtd style=\"text-align:-webkit-right\">");
        read_row(r);
        dal__buffer_append(r->out, "</mtd>");
        accept(r, "&");
        read_cell(r);
        dal__buffer_append(r->out, "</mtr>\n");
    } while (!r->is_too_deep && accept(r, "\\\\"));
    dal__buffer_append(r->out, "</mtable></math>\n");
}

dal_status dal_model_mathml(dal_model *model, char **text, dal_error *error)
{
    char *latex;
    dal__buffer all = {0};
    DAL_REQUIRE(text, error);
    *text = NULL;
    DAL_TRY(dal_model_latex(model, &latex, error));
    reader r = {.at = latex, .out = &all};
    accept(&r, "\\begin{align*}");
    read_alignment(&r);
    free(latex);
    if (!all.out_of_memory && !r.is_too_deep) {
        *text = all.bytes;
        return DAL_STATUS_OK;
    }
    dal__buffer_free(&all);
    return dal__size_error(r.is_too_deep ? DAL_STATUS_TOO_LARGE : DAL_STATUS_MEMORY, error);
}
