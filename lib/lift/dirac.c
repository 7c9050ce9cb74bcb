/* dirac.c - Dirac's procedure: its results, with formulas as texts. */
#include "lift/dirac.h"
#include "codegen/typeset.h"
#include "core/error.h"
#include "core/words.h"
#include "lift/gauge.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *dal_dirac_outcome_name(dal_dirac_outcome outcome)
{
    DAL__RETURN_WORD(DAL_DIRAC_OUTCOME_LIST, DAL__SECOND, outcome, "?");
}

/* The results and their memory. */
typedef struct results {
    dal_dirac dirac; /* first: its address is the address of all */
    dal__pool pool;
} results;

/* A formula that is to be written; of two for the same place the later one. */
typedef struct slot {
    dal_formula *to;
    dal__node node;
    struct slot *next;
} slot;

typedef enum text_form { PLAIN, LATEX } text_form;

typedef struct writer {
    const dal__theory *theory;
    dal__pool *pool;
    slot *slots;
    int count;
    text_form form;
} writer;

static void write_later(writer *w, dal_formula *to, dal__node node)
{
    slot *s = dal__pool_allocate(w->pool, 1, sizeof *s);
    if (!s) return;
    *s = (slot){to, node, w->slots};
    w->slots = s;
    w->count++;
}

static void put_symbol(const void *user, int symbol, dal__buffer *text)
{
    const writer *w = user;
    const char *name = (w->form == PLAIN ? w->theory->text : w->theory->latex)[symbol];
    dal__buffer_append(text, name ? name : "?");
}

static void put_table(const void *user, int table, dal__buffer *text)
{
    const writer *w = user;
    if (w->form == PLAIN)
        dal__buffer_append(text, w->theory->table[table]);
    else
        dal__typeset_name(w->theory->table[table], NULL, text);
}

/* Writes the formulas of slots up to the end, in one of the two languages; "..." where a single one
 * is longer than a megabyte.  False where one of several is. */
static bool write_slots(const writer *w, slot *first, const slot *end, dal__node *nodes)
{
    const dal__typeset_options options = {.symbol = put_symbol,
                                          .table = put_table,
                                          .user = w,
                                          .letter = "s",
                                          .shared_length = SIZE_MAX,
                                          .is_plain = w->form == PLAIN};
    dal__typesetter *typesetter = NULL;
    int count = 0;
    for (const slot *s = first; s != end; s = s->next) nodes[count++] = s->node;
    const dal_status status =
        dal__typesetter_create(&typesetter, w->theory->graph, nodes, count, &options);
    w->pool->out_of_memory |= status == DAL_STATUS_MEMORY;
    if (status == DAL_STATUS_TOO_LARGE && count > 1) return false;
    if (w->pool->out_of_memory) return true;
    for (slot *s = first; s != end; s = s->next) {
        const char **to = w->form == PLAIN ? &s->to->text : &s->to->latex;
        const char *text = typesetter ? dal__typeset(typesetter, s->node) : "...";
        if (!*to) *to = dal__pool_text(w->pool, text, strlen(text));
    }
    dal__typesetter_free(typesetter);
    return true;
}

/* Writes all formulas together, or one by one where one of them is too long. */
static void write_all(writer *w, text_form form)
{
    dal__node *nodes = dal__pool_nodes(w->pool, w->theory->graph, (size_t)w->count);
    w->form = form;
    if (dal__theory_is_lost(w->theory, w->pool) || write_slots(w, w->slots, NULL, nodes)) return;
    for (slot *s = w->slots; s; s = s->next) write_slots(w, s, s->next, nodes);
}

/* ---- the results --------------------------------------------------------------------------- */

static void put_chain(dal_dirac *out, writer *w, const dal__chain *c)
{
    out->pairs = c->theory->pairs;
    out->primaries = c->theory->primaries;
    out->stages = c->stage;
    out->constraints = c->count;
    out->is_complete = c->is_complete;
    out->steps = c->steps;
    out->step = c->step;
    out->constraint = dal__pool_allocate(w->pool, (size_t)c->count + 1, sizeof *out->constraint);
    out->multiplier =
        dal__pool_allocate(w->pool, (size_t)out->primaries + 1, sizeof *out->multiplier);
    if (w->pool->out_of_memory) return;
    for (int a = 0; a < c->count; a++) {
        dal_dirac_constraint *to = &out->constraint[a];
        to->stage = c->constraint[a].stage;
        to->source = c->constraint[a].source;
        write_later(w, &to->phi, c->constraint[a].phi);
        write_later(w, &to->form, c->constraint[a].phi);
    }
    for (int i = 0; i < c->steps; i++) write_later(w, &out->step[i].condition, c->condition[i]);
    for (int b = 0; b < out->primaries; b++) {
        const dal__node mu = dal__symbol(c->theory->graph, c->theory->mu + b);
        write_later(w, &out->multiplier[b].name, mu);
        write_later(w, &out->multiplier[b].value, mu);
    }
    write_later(w, &out->hamiltonian, c->theory->shown);
    write_later(w, &out->on_surface, c->theory->shown);
}

static void put_generator(dal_dirac_generator *to, writer *w, const dal__generator *from)
{
    const dal__theory *theory = w->theory;
    const size_t size = 2 * (size_t)theory->pairs + 1;
    to->multiplier = from->multiplier;
    to->derivatives = from->derivatives;
    to->changed = dal__pool_allocate(w->pool, size, sizeof *to->changed);
    to->change = dal__pool_allocate(w->pool, size, sizeof *to->change);
    if (w->pool->out_of_memory) return;
    for (int i = 0; i < 2 * theory->pairs; i++) {
        if (dal__node_is_zero(theory->graph, from->change[i])) continue;
        write_later(w, &to->changed[to->changes], dal__symbol(theory->graph, theory->variable[i]));
        write_later(w, &to->change[to->changes++], from->change[i]);
    }
    write_later(w, &to->generator, from->G);
    write_later(w, &to->of_multiplier,
                dal__symbol(theory->graph, theory->alpha + from->derivatives + 1));
}

static void put_classes(dal_dirac *out, writer *w, const dal__chain *c, const dal__classes *k)
{
    out->second_class = k->second;
    out->first_class = c->count - k->second;
    out->free_multipliers = k->free_multipliers;
    out->generators = k->generators;
    out->dimension = k->generators < k->free_multipliers
                         ? -1
                         : 2 * out->pairs - out->constraints - k->directions;
    for (int a = 0; a < c->count; a++) {
        out->constraint[a].first_class = k->is_first[a];
        write_later(w, &out->constraint[a].form, k->form[a]);
    }
    for (int b = 0; b < out->primaries; b++) {
        out->multiplier[b].is_free = c->conservation.row[b] < 0;
        write_later(w, &out->multiplier[b].value, k->value[b]);
    }
    write_later(w, &out->on_surface, k->on_surface);
    out->generator = dal__pool_allocate(w->pool, (size_t)k->generators + 1, sizeof *out->generator);
    for (int i = 0; out->generator && i < k->generators; i++)
        put_generator(&out->generator[i], w, &k->generator[i]);
    const dal__theory *theory = w->theory;
    const int columns = 2 * k->observables, size = k->observables * columns;
    out->bracket = dal__pool_allocate(w->pool, (size_t)size + 1, sizeof *out->bracket);
    for (int ij = 0; out->bracket && ij < size; ij++) {
        const int i = ij / columns, j = ij % columns;
        const int other = j < k->observables ? j : theory->pairs + j - k->observables;
        if (j <= i || dal__node_is_zero(theory->graph, k->bracket[ij])) continue;
        dal_dirac_bracket *to = &out->bracket[out->brackets++];
        write_later(w, &to->left, dal__symbol(theory->graph, theory->variable[i]));
        write_later(w, &to->right, dal__symbol(theory->graph, theory->variable[other]));
        write_later(w, &to->value, k->bracket[ij]);
    }
}

/* The results of a theory; where memory runs out, or the graph is full, no status says so. */
static dal_status make_results(dal_dirac *out, const dal__theory *theory, dal__pool *pool)
{
    dal__chain chain = {.is_complete = false};
    dal__classes classes;
    writer w = {.theory = theory, .pool = pool};
    if (pool->out_of_memory) return DAL_STATUS_OK;
    DAL_TRY(dal__chain_run(&chain, theory, pool));
    put_chain(out, &w, &chain);
    if (chain.is_complete) {
        DAL_TRY(dal__classes_find(&classes, &chain));
        DAL_TRY(dal__gauge_find(&classes, &chain));
        if (dal__theory_is_lost(theory, pool)) return DAL_STATUS_OK;
        put_classes(out, &w, &chain, &classes);
    }
    write_all(&w, PLAIN);
    write_all(&w, LATEX);
    return DAL_STATUS_OK;
}

dal_status dal__dirac_run(dal_dirac **dirac, const dal__theory *theory, dal__pool *pool)
{
    results *made = calloc(1, sizeof *made);
    pool->out_of_memory |= !made;
    dal_status status = made ? make_results(&made->dirac, theory, pool) : DAL_STATUS_MEMORY;
    if (theory->graph->status != DAL_STATUS_OK) status = theory->graph->status;
    if (pool->out_of_memory) status = DAL_STATUS_MEMORY;
    if (status != DAL_STATUS_OK) {
        free(made);
        return status;
    }
    made->pool = *pool;
    *pool = (dal__pool){.blocks = NULL};
    *dirac = &made->dirac;
    return DAL_STATUS_OK;
}

void dal_dirac_free(dal_dirac *dirac)
{
    results *made = (results *)dirac;
    if (!made) return;
    dal__pool_free(&made->pool);
    free(made);
}

dal_status dal_dirac_create(dal_dirac **dirac, dal_model *model, const dal_run_spec *spec,
                            dal_error *error)
{
    DAL_REQUIRE(dirac, error);
    *dirac = NULL;
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(spec, error);
    DAL_REQUIRE(spec->system, error);
    if (!model->made || spec->system != &model->system)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the system is not the model's");
    dal__pool pool = {.blocks = NULL};
    dal__theory theory;
    model->out_of_memory = false;
    dal_status status = dal__theory_create(&theory, model, spec, &pool, error);
    if (status == DAL_STATUS_OK && !model->out_of_memory) {
        status = dal__dirac_run(dirac, &theory, &pool);
        if (status == DAL_STATUS_NOT_FINITE)
            dal__fail(error, status, "a bracket has no value near the start");
        else
            dal__check_size(status, error);
    }
    dal__pool_free(&pool);
    return dal__model_conclude(model, status, error);
}
