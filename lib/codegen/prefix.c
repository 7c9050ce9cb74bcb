/* prefix.c - what the public names of a generated file begin with. */
#include "codegen/generate.h"
#include <stdio.h>
#include <string.h>

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* Names that begin so could be the kernel's own. */
static bool is_kernels(const char *prefix)
{
    static const char *const names[] = {"dal", "DAL"};
    for (int i = 0; i < 2; i++)
        if (strncmp(prefix, names[i], 3) == 0 && (prefix[3] == '_' || !prefix[3])) return true;
    return false;
}

static bool is_letter(char c) { return is_word(c) && c != '_' && !(c >= '0' && c <= '9'); }

/* SYSTEM_METHOD, whatever the system is called. */
static void default_prefix(dal__generation *g)
{
    char method[DAL__PREFIX_SIZE];
    const char *name = g->layout.system->name ? g->layout.system->name : "system";
    const bool odd = !is_letter(name[0]) || is_kernels(name);
    snprintf(g->prefix, sizeof g->prefix, "%s%.25s_%.30s", odd ? "of_" : "", name,
             dal_method_name(&g->spec->method, method, sizeof method));
    for (char *c = g->prefix; *c; c++)
        if (!is_word(*c)) *c = '_';
}

dal_status dal__choose_prefix(dal__generation *g, const char *prefix, dal_error *error)
{
    const char *fault = NULL;
    if (!prefix) {
        default_prefix(g);
        return DAL_OK;
    }
    if (strlen(prefix) >= sizeof g->prefix)
        return dal__fail(error, DAL_ARGUMENT, "prefix '%.60s...' is too long", prefix);
    for (const char *c = prefix; *c; c++)
        if (!is_word(*c)) fault = "is not a C name";
    if (!fault && !is_letter(prefix[0])) fault = "does not begin with a letter";
    if (is_kernels(prefix) && g->product == DAL__FILE) fault = "is the kernel's own";
    if (fault) return dal__fail(error, DAL_ARGUMENT, "prefix '%s' %s", prefix, fault);
    snprintf(g->prefix, sizeof g->prefix, "%s", prefix);
    return DAL_OK;
}
