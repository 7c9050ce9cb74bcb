# candidates.awk - every mutation of a C source that mutants.sh knows, one a line:
#
#     FILE  LINE  OPERATOR  MUTATED LINE          (separated by tabs)
#
# Sources are formatted by clang-format: binary operators are between spaces, one statement a line.
# Comments, preprocessor lines and declarations are left alone.
#
# -v operators=first: comparisons, logic, arithmetic, constants, negated conditions, deleted
# statements; new: bits, ++ and --, jumps, exchanged arguments, dropped statuses, returned values,
# printed texts and their empty lines; all: both.  bounds: one turn too many of a loop, one place
# too few of an allocation.

function emit(operator, text) {
    if (text != $0) printf "%s\t%d\t%s\t%s\n", FILENAME, FNR, operator, text
}
# The line with count characters from place on replaced.
function replaced(place, count, by) { return substr($0, 1, place - 1) by substr($0, place + count) }

# Every occurrence of an operator between spaces.
function swap(operator, name, by,    from, at, text) {
    text = " " operator " "
    for (from = 1; (at = index(substr(code, from), text)) > 0; from += at) {
        at += from - 1
        emit(name, replaced(at, length(text), " " by " "))
        at -= from - 1
    }
}

# code is the line with comments and texts blanked, so that places in both agree.
function blank(    i, c, out, quote) {
    out = ""
    quote = ""
    for (i = 1; i <= length($0); i++) {
        c = substr($0, i, 1)
        if (comment) {
            if (substr($0, i, 2) == "*/") { comment = 0; out = out "  "; i++ } else out = out " "
        } else if (quote != "") {
            if (c == "\\") { out = out "@@"; i++; continue }
            if (c == quote) quote = ""
            out = out "@"
        } else if (substr($0, i, 2) == "/*") { comment = 1; out = out "  "; i++ }
        else if (c == "\"" || c == "'") { quote = c; out = out "@" }
        else out = out c
    }
    return out
}

# The place of the parenthesis that closes the one at from; 0: not on this line.
function closing(from,    i, depth, c) {
    for (i = from; i <= length(code); i++) {
        c = substr(code, i, 1)
        if (c == "(") depth++
        if (c == ")" && --depth == 0) return i
    }
    return 0
}

function negate(word,    at, open, end) {
    at = match(code, "(^|[ }])" word " [(]")
    if (!at) return
    open = at + RLENGTH - 1
    end = closing(open)
    if (end) emit("negated", replaced(open, end - open + 1, "(!" substr($0, open, end - open + 1) ")"))
}

function constants(    from, rest, at, text, before, whole) {
    for (from = 1; match(rest = substr(code, from), /[0-9][0-9a-fA-FxX.]*([eEp][-+]?[0-9]+)?[uUlLfF]*/); from = at + length(text)) {
        at = from + RSTART - 1
        text = substr(rest, RSTART, RLENGTH)
        before = at > 1 ? substr(code, at - 1, 1) : ""
        if (before ~ /[A-Za-z0-9_.]/) continue
        if (text ~ /^[0-9]+$/) {
            emit("constant", replaced(at, length(text), text + 1))
            if (text > 1) emit("constant", replaced(at, length(text), text - 1))
        } else if (text ~ /^[0-9.]+e-[0-9]+$/) {
            emit("constant", replaced(at, length(text), "1e7 * " text))
            emit("constant", replaced(at, length(text), "1e-7 * " text))
        } else if (text ~ /^[0-9]+[.][0-9]*$/) {
            emit("constant", replaced(at, length(text), text + 1 ".0"))
        }
    }
}

function is_statement(text) {
    if (text !~ /;$/ || text ~ /[{}]/ || text !~ /^[A-Za-z_(*]/) return 0
    if (text ~ /^(return|break|continue|goto|typedef|static|extern|const|enum|else|for|do|case|default)/) return 0
    if (text ~ /^(unsigned|struct|long|signed) /) return 0
    if (text ~ /^[A-Za-z_][A-Za-z_0-9]*( const)? [*]*[A-Za-z_][A-Za-z_0-9]*( =|;|\[|,)/) return 0
    return text !~ /^[A-Za-z_0-9]+ [(][*]/
}

function deleted(    text, copy, opened, closed) {
    text = code
    sub(/^ +/, "", text)
    sub(/ +$/, "", text)
    copy = text
    opened = gsub(/[(]/, "", copy)
    closed = gsub(/[)]/, "", copy)
    if (code !~ /^    / || opened != closed || !whole_before || !is_statement(text)) return
    emit("deleted", substr(code, 1, match(code, /[^ ]/) - 1) ";")
}

# ---- new ----

# Every occurrence of one text replaced by another.
function exchange(text, name, by,    from, at) {
    for (from = 1; (at = index(substr(code, from), text)) > 0; from = at + length(text)) {
        at += from - 1
        emit(name, replaced(at, length(text), by))
    }
}

# Whether f(b, a) is f(a, b): of a function that begins at a place, with what follows it.
function is_symmetric(at, after,    name) {
    name = substr(code, at)
    sub(/[(].*/, "", name)
    if (name == "strcmp") return after ~ /^ [!=]= 0/ || substr(code, at - 1, 1) == "!"
    return name ~ /^(cli_)?calloc$|^f(min|max)$|^hypot$|^file_is_same$|^dal__numbers$/
}

# f(a, b): f(b, a), where neither has parentheses.
function arguments(    from, at, count, open, comma, first, second) {
    for (from = 1; match(substr(code, from), /[a-z_0-9]+[(][^(),@]+, [^(),@]+[)]/); from = at + count) {
        at = from + RSTART - 1
        count = RLENGTH
        if (is_symmetric(at, substr(code, at + count))) continue
        open = index(substr(code, at), "(")
        comma = index(substr(code, at), ", ")
        first = substr($0, at + open, comma - open - 1)
        second = substr($0, at + comma + 1, count - comma - 2)
        emit("arguments", replaced(at + open, count - open - 1, second ", " first))
    }
}

# A status that is dropped, after DAL_TRY or instead of being assigned.
function dropped(    at, end) {
    at = index(code, "DAL_TRY(")
    end = at ? closing(at + 7) : 0
    if (end) emit("status", replaced(at, end - at + 1, "(void)(" substr($0, at + 8, end - at - 8) ")"))
    if (match(code, /(^ +|[)] )status = [a-z_0-9]+[(]/) && code ~ /;$/) {
        at = index(code, "status = ")
        emit("status", replaced(at, 9, "(void)"))
    }
}

function returned(    at, end) {
    if (!match(code, /return [^;]+;/)) return
    if (substr(code, RSTART, RLENGTH) !~ /^return (0|NULL|false|DAL_STATUS_OK|CLI_DONE);$/)
        emit("return", replaced(RSTART, RLENGTH, "return 0;"))
}

# Another first word, or no empty line, in a text that is printed.
function texts(    from, at, count, word) {
    if (code !~ /printf[(]|puts[(]|cli_table_append[(]/) return
    for (from = 1; match(substr(code, from), /@@+/); from = at + count) {
        at = from + RSTART - 1
        count = RLENGTH
        word = substr($0, at, count)
        if (word ~ /^"\\n./ && word !~ /^"\\n"/) emit("empty line", replaced(at, 3, "\""))
        if (match(word, /[^a-z%\\][a-z][a-z][a-z]+/))
            emit("text", replaced(at + RSTART, RLENGTH - 1, "other"))
    }
}

function new_operators() {
    swap("&", "bits", "|")
    swap("|", "bits", "&")
    if (code !~ /^ *for /) {
        exchange("++", "increment", "--")
        exchange("--", "increment", "++")
    }
    exchange("break;", "jump", "continue;")
    exchange("continue;", "jump", "break;")
    arguments()
    dropped()
    returned()
    texts()
}

# ---- bounds ----

function bounds(    from, at) {
    if (code ~ /(^| |})(for|while) [(]/) swap("<", "bound", "<=")
    if (code !~ /alloc(ate)?[(]|dal__numbers[(]|dal__model_nodes[(]/) return
    for (from = 1; (at = index(substr(code, from), " + 1")) > 0; from = at + 4) {
        at += from - 1
        if (substr(code, at + 4, 1) !~ /[0-9.]/) emit("place", replaced(at, 4, ""))
    }
}

FNR == 1 { comment = 0; directive = 0; whole_before = 1 }
{
    code = blank()
    skip = directive || code ~ /^[ \t]*#/
    directive = skip && code ~ /\\$/
    if (skip && operators ~ /^(first|all)$/ && code ~ /^#define [A-Z_0-9]+ +[-0-9.ex+]+ *$/) constants()
    if (skip || code ~ /^[ \t]*$/) next
    if (operators ~ /^(new|all)$/ && code ~ /^ /) new_operators()
    if (operators == "bounds" && code ~ /^ /) bounds()
    if (operators ~ /^(first|all)$/ && code !~ /^[a-z].*[)]$|^[a-z][^=]*,$/) {
        swap("<", "comparison", "<=")
        swap("<", "comparison", ">=")
        swap("<=", "comparison", "<")
        swap("<=", "comparison", ">")
        swap(">", "comparison", ">=")
        swap(">", "comparison", "<=")
        swap(">=", "comparison", ">")
        swap(">=", "comparison", "<")
        swap("==", "comparison", "!=")
        swap("!=", "comparison", "==")
        swap("&&", "logic", "||")
        swap("||", "logic", "&&")
        swap("+", "arithmetic", "-")
        swap("-", "arithmetic", "+")
        swap("*", "arithmetic", "/")
        swap("/", "arithmetic", "*")
        swap("+=", "arithmetic", "-=")
        swap("-=", "arithmetic", "+=")
        if (code !~ /^ *((static|const|unsigned) )*[a-z_0-9]+ [*]*[a-z_A-Z0-9]+\[/) constants()
        negate("if")
        negate("while")
        deleted()
    }
    text = code
    sub(/ +$/, "", text)
    whole_before = text ~ /[;{}:)]$/ || text == ""
}
