# manual.awk -v version=V -v commands=FILE - a frame of a manual page, its @VERSION@ filled in and its
# @COMMANDS@ made of the reference that `dalembert help --markdown` prints.
function roff(text) { # without the marks of Markdown
    gsub(/\]\([^)]*\)/, "", text)
    gsub(/As for \[/, "As for ", text)
    text = unescaped(text)
    gsub(/`/, "", text)
    gsub(/-/, "\\-", text)
    gsub(/'/, "\\(aq", text)
    return text ~ /^\./ ? "\\\\&" text : text
}
function unescaped(text,    out, i) { # a backslash that escapes is none of roff
    while ((i = index(text, "\\")) > 0) {
        out = out substr(text, 1, i - 1) substr(text, i + 1, 1)
        text = substr(text, i + 2)
    }
    return out text
}
function item(line,    end) {
    if (line !~ /^- `/) return ".IP \\(bu 2\n" roff(substr(line, 3))
    line = substr(line, 4)
    end = index(line, "`: ")
    return ".TP\n.B \"" roff(substr(line, 1, end - 1)) "\"\n" roff(substr(line, end + 3))
}
function made(line) {
    if (line == "## Exit status") return ".SH EXIT STATUS"
    if (line ~ /^## /) return ".SS " substr(line, 4)
    if (line ~ /^- /) return item(line)
    return ".PP\n" roff(line)
}
/^@COMMANDS@$/ {
    print ".SH COMMANDS"
    while ((getline line <commands) > 0) {
        sub(/^ +/, "", line)
        if (line != "") print made(line)
    }
    next
}
{ sub(/@VERSION@/, version); print }
