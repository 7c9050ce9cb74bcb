# yaml_blocks.awk - writes each fenced block of YAML of a document to the last file NAME.yaml that
# the text before it names in `code`; a further one for the same file is appended.
/^```yaml$/ { inside = 1; next }
/^```$/ { inside = 0; next }
inside { if (name != "") print >>name; next }
{
    while (match($0, /`[a-z]+\.yaml`/)) {
        name = substr($0, RSTART + 1, RLENGTH - 2)
        $0 = substr($0, RSTART + RLENGTH)
    }
}
