#!/bin/sh
# documents.sh PROGRAM - the tables of docs/ must be what the program prints, or name what the lists
# of the sources name, in their order; and what a link of a document names must be there.

# same WHAT DOCUMENT: standard input is the part of docs/DOCUMENT.md between the marks of WHAT.
same() {
    awk NF >"$program.printed"
    sed -n "/^<!-- $1 -->$/,/^<!-- end of $1 -->$/{/^<!-- /d;p;}" "docs/$2.md" | awk NF |
        diff - "$program.printed" >"$program.diff" ||
        { echo "docs/$2.md: run make references:"; head -20 "$program.diff"; }
    rm -f "$program.printed" "$program.diff"
}
program=$1
"$program" list systems --markdown | same systems systems
"$program" list integrators --markdown | same integrators integrators
"$program" help --markdown | same commands commands
"$program" help study --markdown | awk -f tools/study_keys.awk | same 'study keys' formats
{ echo '```c'; cat examples/heun.c; echo '```'; } | same heun design

# listed WHAT DOCUMENT PATTERN SOURCE: the first names of the table WHAT of a document are what the
# pattern finds in the source, \1 of it.
listed() {
    sed -n "s/^.*$3.*$/\1/p" "$4" >"$names.source"
    sed -n "/^<!-- $1 -->$/,/^<!-- end of $1 -->$/s/^| \`\([a-z0-9_]*\).*/\1/p" "docs/$2.md" |
        diff "$names.source" - >"$names.diff" ||
        { echo "docs/$2.md: the table of $1 is not the list of $4:"; cat "$names.diff"; }
    rm -f "$names.source" "$names.diff"
}
names=$program.names
listed functions formulas 'OP([A-Z0-9]*, [123], "\([a-z0-9]*\)")' lib/expr/graph.h
listed 'system keys' formats ' SECTION([A-Z]*, "\([a-z]*\)")' include/dalembert_model.h

# The names of the headings of a document, as links have them.
headings() {
    sed -n 's/^##* //p' "$1" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-'
}
for document in README.md CONTRIBUTING.md docs/*.md; do
    grep -o '](\([^)]*\))' "$document" | sed 's/^](//; s/)$//' | while read -r link; do
        case $link in http*) continue ;; esac
        file=${link%%#*}
        [ -z "$file" ] || file=$(dirname "$document")/$file
        [ -e "${file:-$document}" ] || { echo "$document: there is no $link"; continue; }
        case $link in
        *'#'*) headings "${file:-$document}" | grep -qx "${link#*#}" ||
            echo "$document: there is no heading for $link" ;;
        esac
    done
done
count=$("$program" list integrators --markdown | grep -c '^| `[a-z]')
grep -q "one of $count integrators" README.md || echo "README.md: there are $count integrators"
[ "$(wc -m <README.md)" -le 8000 ] || echo "README.md: longer than 8000 characters"
version=$("$program" --version | sed 's/.* //')
grep -qx "version: $version" CITATION.cff || echo "CITATION.cff: the version is not $version"
[ "$(sed -n '1s/^dalembert (\(.*\)) .*/\1/p' debian/changelog)" = "$version" ] || echo "debian/changelog: the version is not $version"
grep -qx "Package: libdalembert${version%.*}" debian/control || echo "debian/control: no libdalembert${version%.*}"
