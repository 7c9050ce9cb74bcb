/* request_json.c - a request, and values of it, as JSON. */
#include "request_json.h"

#include <math.h>
#include <string.h>

/* A choice is the number of a word of the option. */
static void put_choice(json_writer *w, int option, int choice)
{
    char word[32];
    const char *words = request_options[option].value;
    for (; choice > 0; choice--) words = strchr(words, '|') + 1;
    snprintf(word, sizeof word, "%.*s", (int)strcspn(words, "|"), words);
    json_put_text(w, request_options[option].name, word);
}

#define PUT_double(w, option, x) json_put_number(w, request_options[option].name, x)
#define PUT_int(w, option, x)    json_put_integer(w, request_options[option].name, x)
#define PUT_bool                 put_choice
#define PUT_dal_space            put_choice
#define PUT_dal_solver           put_choice
#define PUT_dal_sums             put_choice
#define PUT_dal_precision        put_choice

static void put_value(json_writer *w, const run_request *request, int option)
{
    char method[256];
    const char *name = request_options[option].name;
    switch (option) {
    case REQUEST_integrator:
        json_put_text(w, name, dal_method_name(&request->method, method, sizeof method));
        break;
#define PUT(type, member, ...)                                                                     \
    case REQUEST_##member:                                                                         \
        PUT_##type(w, option, request->options.member);                                            \
        break;
        DAL_OPTION_LIST(PUT)
#undef PUT
    }
}

static void put_setting(json_writer *w, const dal_setting *s)
{
    if (isfinite(s->value))
        json_put_number(w, s->name, s->value);
    else
        json_put_text(w, s->name, "inf");
}

void request_put_settings(json_writer *w, const char *name, const request_settings *settings)
{
    json_open(w, name, JSON_ON_ONE_LINE);
    for (int i = 0; i < settings->count; i++) put_setting(w, &settings->item[i]);
    json_close(w);
}

static void put_parameters(json_writer *w, const run_simulation *s)
{
    const dal_system *system = s->system;
    const request_settings *set = &s->request.set;
    json_open(w, "parameters", JSON_ON_ONE_LINE);
    for (int i = 0; i < system->parameters; i++) {
        dal_setting value = {system->parameter[i], system->value[i]};
        for (int k = 0; k < set->count; k++)
            if (strcmp(set->item[k].name, value.name) == 0) value = set->item[k];
        put_setting(w, &value);
    }
    json_close(w);
}

void request_open_json(json_writer *w, const run_simulation *s, uint64_t without)
{
    const run_request *request = &s->request;
    const double end = s->run ? s->end : request->time;
    json_open(w, "request", JSON_LINES);
    json_put_text(w, "system", request->system_name);
    put_parameters(w, s);
    request_put_settings(w, "start", &request->start);
    if (!(without & REQUEST_OPTION(mechanics)))
        json_put_text(w, "mechanics",
                      s->system->properties & DAL_VAKONOMIC ? "vakonomic" : "lagrange-dalembert");
    if (!(without & REQUEST_OPTION(effort)))
        json_put_text(w, "effort", dal_effort_name(s->system->effort));
    if (request->choices.gauge) json_put_text(w, "gauge", request->choices.gauge);
    if (!(without & REQUEST_OPTION(integrator))) put_value(w, request, REQUEST_integrator);
    if (!(without & REQUEST_OPTION(time))) json_put_number(w, "time", end);
    for (int option = REQUEST_step; option < REQUEST_system; option++)
        if (!(without >> option & 1)) put_value(w, request, option);
}
