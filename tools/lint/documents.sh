#!/bin/sh
# documents.sh PROGRAM - the tables of docs/ must be what the program prints, and what a link of a
# document names must be there.
for what in systems integrators; do
    awk -v begin="<!-- $what -->" -v end="<!-- end of $what -->" \
        '$0 == end { on = 0 } on && NF; $0 == begin { on = 1 }' docs/$what.md >"$1.$what.txt"
    "$1" list $what --markdown | awk NF | diff "$1.$what.txt" - >"$1.$what.diff" ||
        { echo "docs/$what.md: the table is not what the program prints:"; cat "$1.$what.diff"; }
    rm -f "$1.$what.txt" "$1.$what.diff"
done
for document in README.md CONTRIBUTING.md docs/*.md; do
    grep -o '](\([^)]*\))' "$document" | sed 's/^](//; s/[)#].*//' | while read -r link; do
        case $link in '' | http*) continue ;; esac
        [ -e "$(dirname "$document")/$link" ] || echo "$document: there is no $link"
    done
done
[ "$(wc -m <README.md)" -le 8000 ] || echo "README.md: longer than 8000 characters"
