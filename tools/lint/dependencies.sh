#!/bin/sh
# dependencies.sh - which directory includes headers of which other one, as a graph for Graphviz:
#
#     sh tools/lint/dependencies.sh | dot -Tsvg >dependencies.svg
#
# Fails where directories depend on each other in a circle, or files: NAME.c, NAME_wide.c, NAME.h and
# NAME.inc are one file.  tsort names the files of the circle.
cd "$(dirname "$0")/../.." || exit 2
sources() { find lib cli integrators -name '*.[ch]' -o -name '*.inc' | sort; }

sources | xargs awk '
    function file_of(path) {
        sub(/(_wide)?\.[a-z]+$/, "", path)
        return path
    }
    BEGIN { for (i = 1; i < ARGC; i++) is_source[ARGV[i]] }
    FNR == 1 {
        folder = tree = FILENAME
        sub(/[^\/]*$/, "", folder)
        sub(/\/.*/, "/", tree)
    }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        name = $0
        sub(/^[^"]*"/, "", name)
        sub(/".*/, "", name)
        path = (tree name) in is_source ? tree name : folder name
        if (path in is_source && file_of(path) != file_of(FILENAME)) print file_of(FILENAME), file_of(path)
    }' | sort -u | tsort >/dev/null || exit 1

edges=$(sources | xargs awk '
    FNR == 1 {
        from = FILENAME
        sub(/\/[^\/]*$/, "", from)
        tree = from
        sub(/\/.*/, "", tree)
    }
    /^[ \t]*#[ \t]*include[ \t]*["<]/ {
        name = $0
        sub(/^[^"<]*["<]/, "", name)
        sub(/[">].*/, "", name)
        if (name ~ /^dalembert/) to = tree == "cli" ? "include" : name ~ /kernel/ ? "lib/kernel" : ""
        else if (name ~ /^\.\.\/integrators\//) to = "integrators"
        else if (name !~ /^[a-z]+\//) next
        else { to = tree "/" name; sub(/\/[^\/]*$/, "", to); if (to == "lib/sys" || to == "cli/sys") next }
        if (to != "" && to != from) print from, to
    }' | sort -u)
echo "$edges" | tsort >/dev/null || exit 1
echo 'digraph dependencies {'
echo '    rankdir=BT; node [shape=box, fontname="sans-serif"];'
# An arrow that a path of others implies is left out.
echo "$edges" | awk '
    { edge[$1, $2] = reach[$1, $2] = 1; node[$1]; node[$2] }
    function leads(a, b, c) {
        if ((a, b) in edge) return 1
        for (c in node) if (((a, c) in edge) && leads(c, b)) return 1
        return 0
    }
    END {
        for (pair in edge) {
            split(pair, part, SUBSEP)
            implied = 0
            for (c in node)
                if (c != part[2] && ((part[1], c) in edge) && leads(c, part[2])) implied = 1
            if (!implied) printf "    \"%s\" -> \"%s\";\n", part[1], part[2]
        }
    }' | sort
echo '}'
