#!/bin/sh
# readme.sh PROGRAM - the tables of README.md must be what the program prints.
for what in systems integrators; do
    awk -v begin="<!-- $what -->" -v end="<!-- end of $what -->" \
        '$0 == end { on = 0 } on && NF; $0 == begin { on = 1 }' README.md >"$1.$what.txt"
    "$1" list $what --markdown | awk NF | diff "$1.$what.txt" - >"$1.$what.diff" ||
        { echo "README.md: the table of $what is not what the program prints:"; cat "$1.$what.diff"; }
    rm -f "$1.$what.txt" "$1.$what.diff"
done
