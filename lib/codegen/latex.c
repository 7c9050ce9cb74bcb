/* latex.c - the equations of a model, typeset: L, Q, C, D, F, h of C, and H of the lift. */
#include "codegen/typeset.h"
#include "dalembert_codegen.h"
#include "expr/traversal.h"
#include "model/derive.h"
#include "model/model.h"
#include <stdlib.h>
#include <string.h>

/* ---- names --------------------------------------------------------------------------------- */

/* Whether a name of the model has these letters before its subscript. */
static bool is_taken(const dal__equations *e, const char *letter)
{
    const struct {
        const char *const *names;
        int count;
    } lists[] = {{e->parameter, e->parameters}, {e->coordinate, e->n}, {e->let_name, e->lets}};
    for (size_t k = 0; k < sizeof lists / sizeof *lists; k++)
        for (int i = 0; i < lists[k].count; i++) {
            const char *name = lists[k].names[i];
            const size_t length = strcspn(name, "_0123456789");
            if (length == strlen(letter) && memcmp(name, letter, length) == 0) return true;
        }
    return false;
}

/* A letter of the theory, in calligraphic type where the model has another meaning for it. */
static void put_letter(dal__buffer *text, const dal__equations *e, const char *letter)
{
    dal__buffer_print(text, is_taken(e, letter) ? "\\mathcal{%s}" : "%s", letter);
}

/* "prefix_{x}" of coordinate i. */
static void put_indexed(dal__buffer *text, const char *prefix, const dal__equations *e, int i)
{
    put_letter(text, e, prefix);
    dal__buffer_append(text, "_{");
    dal__typeset_name(e->coordinate[i], NULL, text);
    dal__buffer_append(text, "}");
}

static void put_velocity(dal__buffer *text, const dal__equations *e, int i)
{
    dal__typeset_name(e->coordinate[i], "\\dot", text);
}

static void put_symbol(const void *user, int symbol, dal__buffer *text)
{
    const dal__equations *e = user;
    if (symbol < e->parameters)
        dal__typeset_name(e->parameter[symbol], NULL, text);
    else if (symbol == e->t)
        dal__buffer_append(text, "t");
    else if (symbol >= e->q && symbol < e->q + e->n)
        dal__typeset_name(e->coordinate[symbol - e->q], NULL, text);
    else if (symbol >= e->v && symbol < e->v + e->n)
        put_velocity(text, e, symbol - e->v);
    else
        dal__buffer_print(text, "g_{%d}", symbol - e->g + 1);
}

static void put_table(const void *user, int table, dal__buffer *text)
{
    const dal__equations *e = user;
    dal__typeset_name(e->table_name[table], NULL, text);
}

/* ---- rows of an alignment ------------------------------------------------------------------ */

/* Appends a formula, with a new line of the alignment before some of its terms where it is long. */
static void put_lines(dal__buffer *text, const char *formula)
{
    enum { LINE = 160 };
    int depth = 0, length = 0;
    for (const char *c = formula; *c; c++, length++) {
        const bool opens =
            strchr("{(", *c) || strncmp(c, "\\left|", 6) == 0 || strncmp(c, "\\left\\l", 7) == 0;
        const bool closes =
            strchr("})", *c) || strncmp(c, "\\right|", 7) == 0 || strncmp(c, "\\right\\r", 8) == 0;
        depth += opens - closes;
        const bool is_term = strncmp(c, " + ", 3) == 0 || strncmp(c, " - ", 3) == 0;
        if (depth == 0 && is_term && length > LINE) {
            dal__buffer_append(text, " \\\\\n    &\\quad");
            length = 0;
        }
        dal__buffer_append_bytes(text, c, 1);
    }
}

/* Begins a row, and ends the one before it. */
static void begin_row(dal__buffer *text)
{
    const bool is_first = text->length > 0 && text->bytes[text->length - 1] == '}' &&
                          !memchr(text->bytes, '&', text->length);
    dal__buffer_append(text, is_first ? "\n  " : " \\\\\n  ");
}

static void put_row(dal__buffer *text, const dal__typesetter *t, dal__node node, const char *end)
{
    dal__buffer_append(text, " &= ");
    put_lines(text, dal__typeset(t, node));
    dal__buffer_append(text, end);
}

static void put_shared(dal__buffer *text, const dal__typesetter *t)
{
    const char *meaning, *name;
    for (int i = 0; (meaning = dal__typeset_shared(t, i, &name)); i++) {
        begin_row(text);
        dal__buffer_append(text, name);
        dal__buffer_append(text, " &= ");
        put_lines(text, meaning);
    }
}

/* "prefix_{a}" of constraint a, from 0. */
static void put_numbered(dal__buffer *text, const dal__equations *e, const char *prefix, int a)
{
    put_letter(text, e, prefix);
    dal__buffer_print(text, "_{%d}", a + 1);
}

/* L, Q, the holonomic constraints C = 0 and D = 0 as they are given, with what they name. */
static void put_given(dal__buffer *text, const dal__equations *e, const dal__typesetter *t)
{
    if (e->lagrangian && !(e->accelerations && dal__node_is_zero(e->graph, e->lagrangian))) {
        begin_row(text);
        put_letter(text, e, "L");
        put_row(text, t, e->lagrangian, "");
    }
    for (int i = 0; i < e->n && !e->accelerations; i++) {
        if (dal__node_is_zero(e->graph, e->force[i])) continue;
        begin_row(text);
        put_indexed(text, "Q", e, i);
        put_row(text, t, e->force[i], "");
    }
    for (int k = 0; k < e->holonomic; k++) {
        begin_row(text);
        put_numbered(text, e, "C", k);
        put_row(text, t, e->position[k], " = 0");
    }
    for (int a = 0; a < e->m; a++) {
        begin_row(text);
        put_numbered(text, e, "D", a);
        if (a >= e->m - e->holonomic) {
            dal__buffer_append(text, " = \\tfrac{d}{dt}\\,");
            put_numbered(text, e, "C", a - (e->m - e->holonomic));
        }
        put_row(text, t, e->constraint[a], " = 0");
    }
    put_shared(text, t);
}

/* F, the rates of vakonomic multipliers, and the multipliers of C, with what these share. */
static void put_motion(dal__buffer *text, const dal__equations *e, const dal__typesetter *t)
{
    for (int i = 0; i < e->n + e->multipliers; i++) {
        begin_row(text);
        if (i < e->n)
            dal__typeset_name(e->coordinate[i], "\\ddot", text);
        else
            dal__buffer_print(text, "\\dot{g}_{%d}", i - e->n + 1);
        if (i < e->n && !e->vakonomic) {
            dal__buffer_append(text, " = ");
            put_indexed(text, "F", e, i);
        }
        put_row(text, t, e->F[i], "");
    }
    for (int a = e->m - e->holonomic; a < e->m; a++) {
        begin_row(text);
        put_numbered(text, e, "h", a);
        put_row(text, t, e->h[a], "");
    }
    put_shared(text, t);
}

/* H = pi.K pi/(2e) + pi.F + p.v + mu_e pi_e (nh20), and K; vakonomic motion has no lift. */
static void put_hamiltonian(dal__buffer *text, const dal__equations *e, const dal__typesetter *t,
                            dal_effort effort)
{
    static const char *const K[DAL_EFFORT_COUNT] = {
        [DAL_EFFORT_MASS] = "K &= W^{-1}",
        [DAL_EFFORT_CONSTRAINT] = "K &= P\\,W^{-1} P^{\\mathsf{T}}",
        [DAL_EFFORT_CONTROLS] = "K &= P\\,W^{-1} C\\,C^{\\mathsf{T}} W^{-1} P^{\\mathsf{T}}"};
    dal__buffer sum = {0};
    if (e->vakonomic) return;
    dal__buffer_append(&sum, "\\frac{");
    if (effort != DAL_EFFORT_IDENTITY) dal__buffer_append(&sum, "\\pi^{\\mathsf{T}} K\\,\\pi");
    for (int i = 0; effort == DAL_EFFORT_IDENTITY && i < e->n; i++) {
        if (i > 0) dal__buffer_append(&sum, " + ");
        put_indexed(&sum, "\\pi", e, i);
        dal__buffer_append(&sum, "^{2}");
    }
    dal__buffer_append(&sum, "}{2\\,e}");
    for (int i = 0; i < e->n; i++) {
        dal__buffer_append(&sum, " + ");
        put_indexed(&sum, "\\pi", e, i);
        dal__buffer_append(&sum, "\\,");
        put_indexed(&sum, "F", e, i);
    }
    for (int i = 0; i < e->n; i++) {
        dal__buffer_append(&sum, " + ");
        put_indexed(&sum, "p", e, i);
        dal__buffer_append(&sum, "\\,");
        put_velocity(&sum, e, i);
    }
    dal__buffer_append(&sum, " + \\mu_{e}\\,\\pi_{e}");
    begin_row(text);
    put_letter(text, e, "H");
    dal__buffer_append(text, " &= ");
    if (sum.bytes) put_lines(text, sum.bytes);
    text->out_of_memory |= sum.out_of_memory;
    dal__buffer_free(&sum);
    if (K[effort]) {
        begin_row(text);
        dal__buffer_append(text, K[effort]);
    }
    if (!e->mu) return;
    begin_row(text);
    dal__buffer_append(text, "\\mu_{e}");
    put_row(text, t, e->mu, "");
}

/* ---- the equations ------------------------------------------------------------------------- */

/* Lets that are neither a number nor a symbol keep their names. */
static bool put_let(const void *user, dal__node node, dal__buffer *text)
{
    const dal__equations *e = user;
    int i = 0;
    while (i < e->lets && e->let[i] != node) i++;
    const int op = dal__inspect(e->graph, node).op;
    if (i == e->lets || op == DAL__NUMBER || op == DAL__SYMBOL) return false;
    dal__typeset_name(e->let_name[i], NULL, text);
    return true;
}

/* L, mu_e, Q, C and D; count receives how many they are. */
static dal__node *list_given(const dal__equations *e, int *count)
{
    dal__node *nodes = calloc((size_t)(2 + e->n + e->m + e->holonomic), sizeof *nodes);
    if (!nodes) return NULL;
    int k = 0;
    nodes[k++] = e->lagrangian;
    nodes[k++] = e->mu;
    for (int i = 0; i < e->n && !e->accelerations; i++) nodes[k++] = e->force[i];
    for (int a = 0; a < e->m; a++) nodes[k++] = e->constraint[a];
    for (int i = 0; i < e->holonomic; i++) nodes[k++] = e->position[i];
    *count = k;
    return nodes;
}

/* F, and the multipliers of C. */
static dal__node *list_motion(const dal__equations *e, int *count)
{
    const int rates = e->n + e->multipliers;
    dal__node *nodes = calloc((size_t)(rates + e->holonomic), sizeof *nodes);
    if (!nodes) return NULL;
    for (int i = 0; i < rates; i++) nodes[i] = e->F[i];
    for (int k = 0; k < e->holonomic; k++) nodes[rates + k] = e->h[e->m - e->holonomic + k];
    *count = rates + e->holonomic;
    return nodes;
}

/* Typesets nodes, which it frees; NULL: there was no memory for them. */
static dal_status typeset_list(dal__typesetter **typesetter, dal__graph *graph, dal__node *nodes,
                               int count, const dal__typeset_options *options)
{
    if (!nodes) return DAL_STATUS_MEMORY;
    const dal_status status = dal__typesetter_create(typesetter, graph, nodes, count, options);
    free(nodes);
    return status;
}

dal_status dal_model_latex(dal_model *model, char **text, dal_error *error)
{
    enum { GIVEN_LENGTH = 400, MOTION_LENGTH = 40 };
    DAL_REQUIRE(text, error);
    *text = NULL;
    const dal_system *system;
    DAL_TRY(dal_model_system(model, &system, error));
    const dal__equations *e = &model->equations;
    dal__typeset_options options = {.symbol = put_symbol,
                                    .table = put_table,
                                    .name = put_let,
                                    .user = e,
                                    .letter = is_taken(e, "s") ? "\\mathcal{S}" : "s",
                                    .shared_length = GIVEN_LENGTH};
    dal__typesetter *given = NULL, *motion = NULL;
    dal__buffer all = {0};
    int count = 0;
    dal__node *nodes = list_given(e, &count);
    dal_status status = typeset_list(&given, e->graph, nodes, count, &options);
    if (status == DAL_STATUS_OK) {
        options.shared_length = MOTION_LENGTH;
        options.before = given;
        nodes = list_motion(e, &count);
        status = typeset_list(&motion, e->graph, nodes, count, &options);
    }
    if (status == DAL_STATUS_OK) {
        dal__buffer_append(&all, "\\begin{align*}");
        put_given(&all, e, given);
        put_motion(&all, e, motion);
        put_hamiltonian(&all, e, given, model->effort);
        dal__buffer_append(&all, "\n\\end{align*}\n");
    }
    dal__typesetter_free(given);
    dal__typesetter_free(motion);
    if (status == DAL_STATUS_OK && all.out_of_memory) status = DAL_STATUS_MEMORY;
    if (status != DAL_STATUS_OK) {
        dal__buffer_free(&all);
        return dal__size_error(status, error);
    }
    *text = all.bytes;
    return DAL_STATUS_OK;
}
