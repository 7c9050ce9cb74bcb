# words.awk - reads words.txt, then texts, and names the lines that use one of its words.
FILENAME ~ /lint\/words\.txt$/ {
    if (/^#/ || NF == 0) next
    if (split($0, part, /  +/) != 2) { print FILENAME ":" FNR ": WORD, two blanks, the usual one"; next }
    count = split(part[1], word, "|")
    for (i = 1; i <= count; i++) {
        pattern = tolower(word[i])
        if (word[i] == toupper(word[i])) { capitals = capitals "|" word[i]; continue }
        gsub(/ /, "[ _]", pattern)
        all = all "|" pattern
    }
    next
}
FNR == 1 { pattern = "(^|[^a-z])(" substr(all, 2) ")([^a-z]|$)"; upper = "(^|[^A-Z])(" substr(capitals, 2) ")([^A-Z]|$)" }
FILENAME == "CHANGELOG.md" && /^ *\|/ { next } # old names, each beside its new one
{
    line = tolower($0)
    if (match(line, pattern) || match($0, upper)) {
        found = substr($0, RSTART, RLENGTH)
        gsub(/^[^A-Za-z]|[^A-Za-z]$/, "", found)
        print FILENAME ":" FNR ": " found
    }
}
