/* fuzz_formula.c - any bytes as a formula: parsed, differentiated, put on a tape, evaluated.
 *
 * A tape and dal__evaluate must agree in every bit, a fault must have its place and its words. */
#include "expr/derivative.h"
#include "expr/parser.h"
#include "expr/tape.h"
#include "expr/traversal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { PARAMETERS = 2, INPUTS = 4, SYMBOLS = PARAMETERS + INPUTS };
enum { MAX_BYTES = 2000 };

static const char letters[] = "abxy";

/* a and b are parameters, x, y, x' and y' inputs. */
static dal__node resolve(void *user, const char *name, size_t length, bool prime, dal_error *error)
{
    const char *found = length == 1 ? strchr(letters, name[0]) : NULL;
    int symbol = found ? (int)(found - letters) : -1;
    if (found && (!prime || symbol >= PARAMETERS)) return dal__symbol(user, symbol + 2 * prime);
    error->status = DAL_STATUS_NAME;
    strcpy(error->message, "unknown");
    return 0;
}

static void require(bool condition)
{
    if (!condition) abort();
}

static void check_tape(dal__graph *graph, const dal__node *nodes, int count)
{
    static const double values[SYMBOLS] = {1.3, -0.7, 0.3, 2.5, -1.25, 0.75};
    dal__tapes *tapes = dal__tapes_create(graph, PARAMETERS, INPUTS);
    require(dal__tapes_add(tapes, nodes, count) == 0);
    require(dal__tapes_finish(tapes) == DAL_STATUS_OK);
    double *work = malloc(tapes->workspace * sizeof *work), out[3];
    memcpy(work, values, PARAMETERS * sizeof *work);
    dal__tapes_prepare_x1(tapes, work);
    memcpy(work + tapes->first_input, values + PARAMETERS, INPUTS * sizeof *work);
    dal__tape_run_x1(tapes, 0, work, out);
    for (int i = 0; i < count; i++) {
        double expected = dal__evaluate(graph, nodes[i], values);
        require(memcmp(&out[i], &expected, sizeof expected) == 0 || isnan(expected));
        require(isnan(out[i]) == isnan(expected));
    }
    free(work);
    dal__tapes_free(tapes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const int symbol = PARAMETERS;
    dal__graph *graph = dal__graph_create(PARAMETERS);
    dal__node nodes[3] = {0};
    dal_error error = {.status = DAL_STATUS_OK};
    if (size > MAX_BYTES) size = MAX_BYTES;
    const char *text = (const char *)data;
    const dal__names names = {.resolve = resolve, .user = graph};
    dal_status status = dal__parse(graph, text, size, &names, &nodes[0], &error);
    if (status == DAL_STATUS_OK) {
        dal__gradient(graph, nodes[0], &symbol, 1, &nodes[1]);
        nodes[2] = dal__tangent(graph, nodes[1], &symbol, 1, &nodes[0]);
        require(graph->status == DAL_STATUS_OK);
        check_tape(graph, nodes, 3);
    } else {
        require(error.status == status && error.line > 0 && error.column > 0);
        require(error.message[0] != '\0' && !strchr(error.message, '\n') && nodes[0] == 0);
    }
    dal__graph_free(graph);
    return 0;
}
