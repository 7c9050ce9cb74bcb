# words.awk - reads words.txt, then texts, and names the lines that use one of its words.
FILENAME ~ /lint\/words\.txt$/ {
    if (/^#/ || NF == 0) next
    columns = split($0, part, /  +/)
    if (columns < 2 || columns > 3) { print FILENAME ":" FNR ": WORD, two blanks, the usual one"; next }
    count = split(part[1], word, "|")
    if (columns == 3) places[++rows] = part[3]
    for (i = 1; i <= count; i++) {
        pattern = tolower(word[i])
        if (word[i] == toupper(word[i])) { capitals = capitals "|" word[i]; continue }
        gsub(/ /, "[ _]", pattern)
        if (columns == 3) some[rows] = some[rows] "|" pattern
        else all = all "|" pattern
    }
    next
}
# The words of this file: a row with a third column does not hold where that begins the file's name.
FNR == 1 {
    words = all
    for (k = 1; k <= rows; k++) if (FILENAME !~ "^(" places[k] ")") words = words some[k]
    pattern = "(^|[^a-z])(" substr(words, 2) ")([^a-z]|$)"
    upper = "(^|[^A-Z])(" substr(capitals, 2) ")([^A-Z]|$)"
    last = ""
}
FILENAME == "CHANGELOG.md" && /^ *\|/ { next } # old names, each beside its new one
{
    line = tolower($0)
    if (match(line, pattern) || match($0, upper)) {
        found = substr($0, RSTART, RLENGTH)
        gsub(/^[^A-Za-z]|[^A-Za-z]$/, "", found)
        print FILENAME ":" FNR ": " found
    }
    # Two words at a line's end and the next one's beginning, after the mark of a comment.
    gsub(/[^a-z.,;:]/, " ", line)
    count = split(line, word, " ")
    if (last != "" && (last " " word[1]) ~ "^(" substr(words, 2) ")$") print FILENAME ":" FNR ": " last " " word[1]
    last = word[count]
}
