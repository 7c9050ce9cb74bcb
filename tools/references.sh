#!/bin/sh
# references.sh PROGRAM [choosing] - writes the parts of docs/ that are made: systems, integrators,
# modifiers, commands and keys of studies as the program prints them, the example of an
# integrator, and how directories depend on each other; with a second argument also the results of the
# study of choosing.md, which takes half a minute.
program=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
cd "$(dirname "$0")/.." || exit 2
made=$(mktemp -d) || exit 2
trap 'rm -rf "$made"' EXIT
LC_ALL=C
export LC_ALL

# replace WHAT DOCUMENT: what is between the marks of WHAT becomes standard input.
replace() {
    cat >"$made/table"
    awk -v what="$1" -v table="$made/table" '
        $0 == "<!-- end of " what " -->" { inside = 0 }
        !inside
        $0 == "<!-- " what " -->" {
            inside = 1
            print ""
            while ((getline line <table) > 0) print line
            print ""
        }' "docs/$2" >"$made/document" && cat "$made/document" >"docs/$2"
}
"$program" list systems --markdown | replace systems systems.md
"$program" list integrators --markdown | replace integrators integrators.md
"$program" help --markdown | replace commands commands.md
"$program" help study --markdown | awk -f tools/study_keys.awk | replace 'study keys' formats.md
{ echo '```c'; cat examples/heun.c; echo '```'; } | replace heun design.md
sh tools/lint/dependencies.sh >docs/dependencies.dot
if command -v dot >/dev/null; then
    dot -Tsvg -Gbgcolor=transparent docs/dependencies.dot | awk -f tools/dark_svg.awk >docs/gallery/dependencies.svg
fi
[ "$2" ] || exit 0
top=$PWD
cd "$made" || exit 2
awk -f "$top/tools/yaml_blocks.awk" "$top/docs/choosing.md"
"$program" study choice.yaml --output choice --no-page >out || cat out
cd "$top" || exit 2
awk -f tools/choosing.awk "$made/choice/cells.csv" | replace choosing choosing.md
