# The command lines of README.md and docs/ do what they say: those that begin with build/dalembert,
# in their order, in a directory of each document that holds the files it shows, and examples/.  A description
# follows two blanks.  Without what follows it, `study` runs the built-in study, which takes
# too long here.  Each indented line between the marks of `printed` is a line that they print.

for document in "$here/../../README.md" "$here"/../../docs/*.md; do
    case_is "the commands of $(basename "$document")"
    case $document in */choosing.md)
        if sanitized; then
            cannot 4 "with sanitizers its study takes minutes" && continue
        fi
        ;;
    esac
    directory=$(basename "$document" .md)
    mkdir "$directory" && cd "$directory" || exit 1
    awk -f "$here/../../tools/yaml_blocks.awk" "$document"
    sed -n 's/^    build\/dalembert \(.*\)/\1/p' "$document" | sed 's/   *.*//; s/ >.*//' |
        grep -v '^study$' >commands
    ! grep -q ' examples/' commands || ln -s "$(cd "$here/../.." && pwd)/examples" examples
    case $document in
    */README.md | */tutorial.md | */program.md)
        expect "there are commands" test "$(wc -l <commands)" -ge 2 ;;
    esac
    : >printed
    while read -r command <&3; do
        eval "try 0 $command"
        cat out err >>printed
    done 3<commands
    sed -n '/^<!-- printed -->$/,/^<!-- end of printed -->$/s/^    //p' "$document" | grep -Fvx -f printed >missing
    expect "a command prints: $(head -1 missing)" test ! -s missing
    cd .. || exit 1
done

# The page of formats names every column of the tables that its commands wrote.
case_is "the columns of formats.md"
for table in formats/*.csv formats/*/*.csv formats/*/series/*.csv; do
    awk 'NR == FNR { text = text $0 "\n"; next }
        FNR == 1 { for (n = split($0, head, ","); n > 0; n--) if (!index(text, "`" head[n] "`")) print head[n] }' \
        "$here/../../docs/formats.md" "$table" >columns
    case $table in # the coordinates of the systems
    *rows.csv) sed -i "/y[12]\|phi\|speed\|spin/d" columns ;;
    *section.csv) sed -i "/^[xy]'*$\|xi/d" columns ;;
    *lyapunov.csv) sed -i "/^lambda[2-9]$/d" columns ;;
    esac
    expect "$table: $(tr '\n' ' ' <columns)" test ! -s columns
done
expect "there are tables" test -s formats/study/cells.csv

# The tables of choosing.md are the results of its study.
case_is "the tables of choosing.md"
sed -n '/^<!-- choosing -->$/,/^<!-- end of choosing -->$/{/^<!--/d;p;}' \
    "$here/../../docs/choosing.md" | sed '1d;$d' >stated
sanitized || awk -f "$here/../../tools/choosing.awk" choosing/choice/cells.csv >measured
sanitized || expect "make references CHOOSING=1 writes other tables: $(diff stated measured | head -3)" cmp stated measured

# "Hairer, Lubich, Wanner 2006, II.1" is the row of "Hairer, Lubich, Wanner 2006"; ';' separates two works.
case_is "each work that a method cites is in references.md"
try 0 list integrators --json
grep -o '"reference": "[^"]*"' out | sed 's/"reference": "//; s/"$//; s/; /\n/g' |
    sed 's/\([12][0-9][0-9][0-9]\).*/\1/' | sort -u >works
expect "there are works" test "$(wc -l <works)" -ge 20
while read -r work; do
    expect "$work" grep -qF "| $work |" "$here/../../docs/references.md"
done <works

case_is "the version that headers and documents name"
version=$("$program" --version | sed 's/dalembert //')
names_version() { # FILE PATTERN VERSION: \1 of the pattern is VERSION wherever FILE has the pattern
    sed -n "s/$2.*/\1/p" "$here/../../$1" | sort -u >named
    expect "$1: version $(cat named), not $3" test "$(cat named)" = "$3"
}
names_version include/dalembert.h '.*version as a text, "\(.*\)"' "$version"
names_version CITATION.cff '^version: \(.*\)' "$version"
names_version docs/installation.md '.*dalembert-\([0-9.]*\)\.tar\.gz' "$version"
names_version docs/installation.md '.*dalembert \([0-9]*\.[0-9]*\) REQUIRED' "${version%.*}"
names_version docs/embedding.md '.*find_package(dalembert \([0-9.]*\))' "${version%.*}"
