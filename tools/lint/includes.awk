# includes.awk - reads includes.txt, then sources, and names every include that is not allowed.
BEGIN {
    libc = "<(errno|float|inttypes|limits|math|stdarg|stdbool|stddef|stdint|stdio|stdlib|string)\\.h>"
    public = "\"dalembert(_(status|system|model|method|run|batch|statistics|evaluator|order|budget|dynamics|invariants|predict|sensitivity|steer|action|dirac|codegen|program))?\\.h\""
    posix = "<(fcntl|fnmatch|pthread|signal|stdatomic|strings|termios|time|unistd|sys/[a-z]+)\\.h>"
}
FILENAME ~ /includes\.txt$/ {
    if (/^#/ || NF == 0) next
    rule = ""
    for (i = 2; i <= NF; i++) {
        pattern = $i == "LIBC" ? libc : $i == "POSIX" ? posix : $i == "PUBLIC" ? public : $i
        rule = rule (i > 2 ? "|" : "") "(" pattern ")"
    }
    allowed[$1] = "^(" rule ")$"
    next
}
FNR == 1 { place = place_of(FILENAME) }
/^[ \t]*#[ \t]*include/ {
    name = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", name)
    sub(/[ \t]*(\/\*.*)?$/, "", name)
    if (place == "") print FILENAME ": lies in no place of includes.txt"
    else if (!fits(name)) print FILENAME ":" FNR ": " place " may not include " name
}
function place_of(file) {
    do if (file in allowed) return file
    while (sub(/\/[^\/]*$/, "", file))
    return ""
}
function own(name, path, line, found) {
    path = FILENAME
    gsub(/"/, "", name)
    sub(/[^\/]*$/, name, path)
    found = (getline line < path) >= 0
    close(path)
    return found && name !~ /\//
}
# The project's own headers may be in <> as well; a header in quotes is never the system's.
function fits(name) {
    if (name ~ allowed[place] || ("OWN" ~ allowed[place] && own(name))) return 1
    if (name !~ /^<dalembert/) return 0
    gsub(/[<>]/, "\"", name)
    return name ~ allowed[place]
}
