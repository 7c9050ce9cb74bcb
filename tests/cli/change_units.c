/* change_units.c - a built-in system in other units, as a system file:
 * change_units SYSTEM SEED [parameters]
 *
 *     q_i = s_i Q_i,   t = tau T,   L' = c L,   D'_a = d D_a,   invariants times g
 *
 * with powers of two between 2^-60 and 2^60, drawn by SEED; with 0 all are 1, with a multiple of
 * 4 the s_i are equal.  The texts of the formulas are changed, nothing else: each coordinate x
 * becomes (s*x), each x' (s/tau*x'), t (tau*t).  With the third argument the factors are
 * parameters, so that the formulas are the same for all seeds, and so is what simplification makes
 * of them.
 * The first line is a comment with tau, c, d and the s_i. */
#include <dalembert.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COORDINATES = 64, TEXT = 4096, MAX_EXPONENT = 60, EQUAL = 4 };

typedef struct units {
    int n;
    const char *name[MAX_COORDINATES];
    double s[MAX_COORDINATES], tau, c, d, g;
    bool as_parameters;
    int factors;
    double *factor; /* [factors] the parameters f1, f2, .. */
} units;

/* The text of a factor: a number, or one more parameter. */
static void print_factor(units *u, double k, char text[64])
{
    if (!u->as_parameters) {
        snprintf(text, 64, "%.17g", k);
        return;
    }
    u->factor = realloc(u->factor, ((size_t)u->factors + 1) * sizeof *u->factor);
    if (!u->factor) exit(2);
    u->factor[u->factors++] = k;
    snprintf(text, 64, "f_%d", u->factors);
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }
static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
static bool is_name(char c) { return is_letter(c) || is_digit(c); }

/* A power of two by a small generator, the same on every machine. */
static double draw(unsigned long long *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    const int exponent = (int)((*state >> 33) % (2 * MAX_EXPONENT + 1)) - MAX_EXPONENT;
    return ldexp(1.0, exponent);
}

static int find(const units *u, const char *name, size_t length)
{
    for (int i = 0; i < u->n; i++)
        if (strlen(u->name[i]) == length && strncmp(u->name[i], name, length) == 0) return i;
    return -1;
}

/* What an identifier of a formula is multiplied by; 1: it is no such. */
static double factor(const units *u, const char *name, size_t length, bool is_prime)
{
    const int i = find(u, name, length);
    const bool is_number = length > 1 && is_digit(name[1]) && name[1] != '0';
    if (i >= 0) return is_prime ? u->s[i] / u->tau : u->s[i];
    if (length == 1 && *name == 't') return u->tau;
    if (is_number && *name == 'h') return u->d / (u->c * u->tau);
    if (is_number && *name == 'g') return u->d / u->c;
    if (length > 2 && strncmp(name, "R_", 2) == 0 && find(u, name + 2, length - 2) >= 0)
        return 1.0 / (u->c * u->s[find(u, name + 2, length - 2)]);
    return 1.0;
}

static bool has_unit(const units *u, const char *name, size_t length)
{
    return find(u, name, length) >= 0 || (length == 1 && *name == 't');
}

static void append(char *out, const char *text, size_t length)
{
    const size_t used = strlen(out);
    if (used + length >= TEXT) exit(2);
    memcpy(out + used, text, length);
    out[used + length] = '\0';
}

/* by * (the formula in the new units) */
static void convert(units *u, double by, const char *text, char *out)
{
    char number[64];
    print_factor(u, by, number);
    snprintf(out, TEXT, "%s*(", number);
    while (*text) {
        size_t length = 1;
        if (is_letter(*text)) {
            while (is_name(text[length])) length++;
            const bool is_prime = text[length] == '\'';
            const double k = factor(u, text, length, is_prime);
            const bool is_factor = k != 1.0 || (u->as_parameters && has_unit(u, text, length));
            length += is_prime;
            if (is_factor) {
                print_factor(u, k, number);
                append(out, "(", 1);
                append(out, number, strlen(number));
                append(out, "*", 1);
            }
            append(out, text, length);
            append(out, ")", is_factor);
        } else {
            while (is_digit(*text) && (is_name(text[length]) || text[length] == '.')) length++;
            append(out, text, length);
        }
        text += length;
    }
    append(out, ")", 1);
}

/* What a formula of a section is multiplied by; NAN: its text is not a formula. */
static double formula_factor(const units *u, dal_section section, const char *name)
{
    const char *x = name ? name : "";
    const char *dot = strrchr(x, '.');
    if (section == DAL_SECTION_REACTIONS && dot) x = dot + 1;
    size_t length = strlen(x);
    const bool is_prime = length > 0 && x[length - 1] == '\'';
    const int i = find(u, x, length - is_prime);
    const double s = i >= 0 ? u->s[i] : 1.0;
    switch (section) {
    case DAL_SECTION_LAGRANGIAN:
        return u->c;
    case DAL_SECTION_CONSTRAINTS:
        return u->d;
    case DAL_SECTION_FORCES:
        return u->c * s;
    case DAL_SECTION_ACCELERATIONS:
        return u->tau * u->tau / s;
    case DAL_SECTION_REACTIONS:
        return u->d * s / u->tau;
    case DAL_SECTION_INVARIANTS:
        return u->g;
    case DAL_SECTION_GAUGE:
        return strcmp(x, "mu_e") == 0 ? u->tau : 1.0;
    case DAL_SECTION_START:
        if (strncmp(x, "solve", 5) == 0) return NAN;
        return i >= 0 ? (is_prime ? u->tau / s : 1.0 / s) : *x == 'g' ? u->c / u->d : 1.0;
    case DAL_SECTION_EXACT:
        return is_prime ? u->tau / s : 1.0 / s;
    case DAL_SECTION_DEFAULTS:
        return strcmp(x, "integrator") == 0 ? NAN : 1.0 / u->tau;
    case DAL_SECTION_LET:
        return 1.0;
    default:
        return NAN;
    }
}

static void print_entry(units *u, dal_section section, const char *name, const char *text,
                        const char *separator)
{
    char converted[TEXT] = "";
    const double by = formula_factor(u, section, name);
    if (section == DAL_SECTION_DEFAULTS && !isnan(by))
        snprintf(converted, sizeof converted, "%.17g", by * strtod(text, NULL));
    else if (isnan(by))
        snprintf(converted, sizeof converted, "%s", text);
    else
        convert(u, by, text, converted);
    printf("%s", separator);
    if (name) printf("\"%s\": ", name);
    printf(section == DAL_SECTION_DEFAULTS || section == DAL_SECTION_PARAMETERS ? "%s" : "\"%s\"",
           converted);
}

static void print_section(units *u, const dal_model *model, dal_section section, const char *key)
{
    const char *name = NULL, *text;
    int line, column, count = 0;
    bool is_mapping = false;
    for (; (text = dal_model_text(model, section, count, &name, &line, &column)); count++) {
        is_mapping = name != NULL;
        if (count == 0)
            printf("%s: %s", key, is_mapping ? "{" : section == DAL_SECTION_LAGRANGIAN ? "" : "[");
        if (strcmp(name ? name : "", "solve") == 0) continue;
        print_entry(u, section, name, text, count > 0 ? ", " : "");
    }
    for (int k = 0; section == DAL_SECTION_PARAMETERS && k < u->factors; k++) {
        printf("%s\"f_%d\": %.17g", count++ > 0 ? ", " : "parameters: {", k + 1, u->factor[k]);
        is_mapping = true;
    }
    if (count > 0) puts(is_mapping ? "}" : section == DAL_SECTION_LAGRANGIAN ? "" : "]");
}

int main(int argc, char **argv)
{
    static const struct {
        dal_section section;
        const char *key;
    } sections[] = {{DAL_SECTION_COORDINATES, "coordinates"},
                    {DAL_SECTION_LET, "let"},
                    {DAL_SECTION_LAGRANGIAN, "lagrangian"},
                    {DAL_SECTION_ACCELERATIONS, "accelerations"},
                    {DAL_SECTION_FORCES, "forces"},
                    {DAL_SECTION_CONSTRAINTS, "constraints"},
                    {DAL_SECTION_GAUGE, "gauge"},
                    {DAL_SECTION_START, "start"},
                    {DAL_SECTION_INVARIANTS, "invariants"},
                    {DAL_SECTION_EXACT, "exact"},
                    {DAL_SECTION_DEFAULTS, "defaults"},
                    {DAL_SECTION_PARAMETERS, "parameters"}}; /* after the factors are known */
    dal_model *model;
    if (argc < 3 || dal_model_builtin(&model, argv[1], NULL) != DAL_STATUS_OK) return 2;
    if (dal_model_text(model, DAL_SECTION_FUNCTIONS, 0, NULL, NULL, NULL) ||
        dal_model_text(model, DAL_SECTION_REACTIONS, 0, NULL, NULL, NULL) ||
        dal_model_text(model, DAL_SECTION_EVENTS, 0, NULL, NULL, NULL)) {
        dal_model_free(model);
        return 3;
    }
    unsigned long long state = strtoull(argv[2], NULL, 10);
    const bool is_plain = state == 0, is_equal = state % EQUAL == 0;
    units u = {.tau = 1.0, .c = 1.0, .d = 1.0, .g = 1.0, .as_parameters = argc > 3};
    for (const char *text;
         u.n < MAX_COORDINATES &&
         (text = dal_model_text(model, DAL_SECTION_COORDINATES, u.n, NULL, NULL, NULL));)
        u.name[u.n++] = text;
    for (int k = 0; k < 8; k++) draw(&state);
    if (!is_plain) u.tau = draw(&state), u.c = draw(&state), u.d = draw(&state), u.g = draw(&state);
    printf("# %.17g %.17g %.17g", u.tau, u.c, u.d);
    for (int i = 0; i < u.n; i++) {
        u.s[i] = is_plain ? 1.0 : is_equal && i > 0 ? u.s[0] : draw(&state);
        printf(" %.17g", u.s[i]);
    }
    puts("");
    const char *mechanics = dal_model_text(model, DAL_SECTION_MECHANICS, 0, NULL, NULL, NULL);
    if (mechanics) printf("mechanics: %s\n", mechanics);
    for (size_t k = 0; k < sizeof sections / sizeof *sections; k++)
        print_section(&u, model, sections[k].section, sections[k].key);
    free(u.factor);
    dal_model_free(model);
    return 0;
}
