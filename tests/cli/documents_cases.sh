# The command lines of README.md and docs/ do what they say: those that begin with build/dalembert,
# in their order, in a directory of each document that holds the files it shows.  A description
# stands behind two blanks.  Without what follows it, `study` runs the built-in study, which takes
# too long here.

# yaml_blocks DOCUMENT: writes each fenced block of YAML to the last file NAME.yaml that the text
# before it names in `code`; a further one for the same file is appended.
yaml_blocks() {
    awk '/^```yaml$/ { inside = 1; next }
        /^```$/ { inside = 0; next }
        inside { if (name != "") print >>name; next }
        { while (match($0, /`[a-z]+\.yaml`/)) {
            name = substr($0, RSTART + 1, RLENGTH - 2)
            $0 = substr($0, RSTART + RLENGTH) } }' "$1"
}
for document in "$here/../../README.md" "$here"/../../docs/*.md; do
    case_is "the commands of $(basename "$document")"
    directory=$(basename "$document" .md)
    mkdir "$directory" && cd "$directory" || exit 1
    yaml_blocks "$document"
    sed -n 's/^    build\/dalembert \(.*\)/\1/p' "$document" | sed 's/   *.*//; s/ >.*//' |
        grep -v '^study$' >commands
    case $document in
    */README.md | */tutorial.md | */program.md)
        holds "there are commands" test "$(wc -l <commands)" -ge 2 ;;
    esac
    while read -r command <&3; do
        case $command in
        report*) there gnuplot || continue ;;
        esac
        eval "try 0 $command"
    done 3<commands
    cd .. || exit 1
done
