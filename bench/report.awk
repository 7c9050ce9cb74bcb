# report.awk - the log of run.sh (of=log), then the case table; see there.  Appends to output.

function trim(s) { gsub(/^ +| +$/, "", s); return s }
function abs(x) { return x < 0 ? -x : x }

# Sorts x[1..n] and returns its median.
function median(x, n,   i, j, t) {
    for (i = 2; i <= n; i++)
        for (j = i; j > 1 && x[j] < x[j - 1]; j--) { t = x[j]; x[j] = x[j - 1]; x[j - 1] = t }
    return n % 2 ? x[(n + 1) / 2] : (x[n / 2] + x[n / 2 + 1]) / 2
}

# The largest difference of two end states, relative to max(1, |b|); -1: not of one size.
function distance(a, b,   n, i, x, y, d, most) {
    n = split(a, x, " ")
    if (n != split(b, y, " ")) return -1
    for (i = 1; i <= n; i++) {
        if (x[i] == y[i]) continue
        d = abs(x[i] - y[i]) / (abs(y[i]) > 1 ? abs(y[i]) : 1)
        if (!(d <= most)) most = d
    }
    return most + 0
}

function met(goal, value,   g) {
    split(goal, g, " ")
    if (goal == "-") return "null"
    return (g[1] == "<=" ? value <= g[2] + 0 : value >= g[2] + 0) ? "true" : "false"
}

# One line of the table and one of JSON; note takes the place of the numbers if there are none.
function show(m, lo, hi, note,   ok, number) {
    ok = note == "" ? met(goal, m) : "null"
    number = "null,\"min\":null,\"max\":null"
    if (note == "") number = sprintf("%.4g,\"min\":%.4g,\"max\":%.4g", m, lo, hi)
    printf "{\"case\":\"%s\",\"what\":\"%s\",\"a\":\"%s\",\"b\":\"%s\",\"median\":%s,\"goal\":%s,\"met\":%s}\n",
        name, what, A, B, number, goal == "-" ? "null" : "\"" goal "\"", ok >>output
    if (note != "") printf "%-16s %-52s %s\n", name, what, note
    else printf "%-16s %-52s %8.4g  (%.4g to %.4g)  %-9s %-4s %s\n", name, what, m, lo, hi,
        goal, ok == "null" ? "" : ok == "true" ? "met" : "MISS", same
}

of == "log" {
    if ($2 == "skip") { missing[$1] = 1; next }
    if ($2 == "fail") { failed[$1] = 1; next }
    k = ++count[$1]
    at = index($2, " ")
    time[$1, k] = at ? substr($2, 1, at - 1) : $2
    if (k == 1) state[$1] = at ? substr($2, at + 1) : ""
    next
}
/^## / {
    heading = substr($0, 4)
    unit = NF > 1 ? trim($2) : "time of one side / time of the other"
    figure = NF > 2 ? trim($3) : "ratios"
    sub(/ *\|.*/, "", heading)
    text = ""
    next
}
heading != "" && /^# / { text = text (text == "" ? "" : " ") substr($0, 3); next }
heading != "" {
    printf "{\"section\":\"%s\",\"unit\":\"%s\",\"figure\":\"%s\",\"text\":\"%s\"}\n", heading,
        unit, figure, text >>output
    heading = ""
}
/^ *(#|$)/ { next }
!headed++ {
    printf "%-16s %-52s %8s  %s\n", "case", "what", "median", "(spread)  goal, end states"
}
{
    name = trim($1); what = trim($2); A = trim($3); B = trim($4)
    factor = $5 + 0; goal = trim($6); tolerance = trim($7); same = ""
    if (A == "") { show(0, 0, 0, "not reached"); next }
    if (A in missing) { show(0, 0, 0, "skipped: no program for " A); next }
    if (B in missing) { show(0, 0, 0, "skipped: no program for " B); next }
    if (A in failed || B in failed) {
        show(0, 0, 0, "FAILED: " (A in failed ? A : B))
        bad = 1
        next
    }
    if (tolerance != "-" && B != "") {
        d = distance(state[A], state[B])
        same = sprintf("%.0e", d)
        if (d < 0 || d > tolerance + 0) { same = "END STATES DIFFER by " d; bad = 1 }
    }
    n = count[A]
    for (i = 1; i <= n; i++) ratio[i] = factor * time[A, i] / (B == "" ? 1 : time[B, i])
    m = median(ratio, n)
    show(m, ratio[1], ratio[n], "")
}
END { exit bad }
