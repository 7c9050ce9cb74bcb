# study_keys.awk - the keys of a study file as a Markdown table, from `dalembert help study --markdown`.
BEGIN { print "| key | of | value |\n|---|---|---|" }
match($0, /^- [a-z]+ \([a-z]+\): /) {
    split(substr($0, 3, RLENGTH - 5), part, " [(]")
    sub(/[)]$/, "", part[2])
    text = substr($0, RLENGTH + 1)
    gsub(/[|]/, "\\|", text)
    print "| `" part[1] "` | " part[2] " | " text " |"
}
