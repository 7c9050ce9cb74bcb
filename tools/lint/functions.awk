# functions.awk - how often the static functions of a source are called.  Reads the list of functions
# that ctags makes (FILE LINE END NAME), then the sources; report=once prints the shares of those
# called once, report=names the names that occur in more than three files.
#
# A function that is also used as a pointer, in a table or as an argument, is not counted.
BEGIN { identifier = "[A-Za-z_][A-Za-z_0-9]*" }
FNR == 1 { file = FILENAME; comment = 0; sources += FILENAME !~ /ctags\.txt$/ }
sources == 0 { first[$1, $4] = $2; length_of[$1, $4] = $3 - $2 + 1; next }
{
    line = $0
    gsub(/\\./, "", line)
    gsub(/"[^"]*"/, "", line)
    gsub(/\/\*([^*]|\*[^\/])*\*\//, "", line)
    if (comment) { if (!sub(/^.*\*\//, "", line)) next; comment = 0 }
    if (sub(/\/\*.*$/, "", line)) comment = 1
    sub(/\/\/.*$/, "", line)
    if (line ~ /^static /) is_static = 1
    while (match(line, identifier)) {
        name = substr(line, RSTART, RLENGTH)
        line = substr(line, RSTART + RLENGTH)
        if (!((file, name) in first)) continue
        if (first[file, name] == FNR) { if (is_static) static[file, name] = 1; continue }
        if (line ~ /^\(/) calls[file, name]++
        else pointers[file, name]++
    }
    if (/[{};]$/) is_static = 0
}
END {
    for (key in static) {
        split(key, part, SUBSEP)
        if (report == "names") { files[part[2]]++; where[part[2]] = where[part[2]] " " part[1]; continue }
        tree = part[1]
        sub(/\/.*/, "", tree)
        if (by == "directory") { tree = part[1]; sub(/\/[^\/]*$/, "", tree) }
        all[tree]++
        if (key in pointers || calls[key] != 1) continue
        once[tree]++
        if (length_of[key] > 8) continue
        short[tree]++
        if (list != "" && index(part[1], list) == 1) print part[1] ": " part[2]
    }
    for (name in files)
        if (files[name] > 3) print name ": a static function in" where[name]
    for (tree in all) {
        printf by == "directory" || report == "table" ? "%s: %d static functions, %.0f %% called once, %.0f %% once and at most 8 lines long\n" : "", tree, all[tree], 100 * once[tree] / all[tree], 100 * short[tree] / all[tree]
        if (report == "once" && once[tree] > 0.50 * all[tree])
            printf "%s: %d of %d static functions are called once (50 %% at most)\n", tree, once[tree], all[tree]
        if (report == "once" && short[tree] > 0.10 * all[tree])
            printf "%s: %d of %d static functions are called once and have at most 8 lines (10 %% at most)\n", tree, short[tree], all[tree]
    }
}
