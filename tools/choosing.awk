# choosing.awk - Markdown tables of a study: D and E of each integrator on each system, from cells.csv.
# D: its size, or max |D| and its trend; E: max |E - E0| and its trend, which is empty where a method
# leaves the D = 0 on which alone the motion conserves E.  A system that need not conserve E has no
# column there.
BEGIN { FS = "," }
NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
function field(name) { return $column[name] }
function add(list, item) { return index("," list, "," item ",") ? list : list item "," }
{
    labels = add(labels, field("label"))
    methods = add(methods, field("integrator"))
    key = field("integrator") SUBSEP field("label")
    state[key] = field("state")
    D_max[key] = field("D_max"); D_size[key] = field("D_size"); D_trend[key] = field("D_trend")
    E_max[key] = field("E_deviation"); E_trend[key] = field("E_trend")
}
function cell(quantity, key) {
    if (state[key] != "done") return state[key]
    if (quantity == "D" && D_size[key] != "larger") return D_size[key]
    if (quantity == "D") return sprintf("%.0e, %s", D_max[key], D_trend[key])
    return sprintf("%.0e", E_max[key]) (E_trend[key] == "" ? "" : ", " E_trend[key])
}
function conserves(label,   i, n, method) {
    n = split(methods, method, ",") - 1
    for (i = 1; i <= n; i++)
        if (E_trend[method[i], label] != "") return 1
    return 0
}
function table(quantity, title,   i, k, n, m, all, method, label, listed) {
    n = split(methods, method, ",") - 1
    all = split(labels, listed, ",") - 1
    for (k = 1; k <= all; k++)
        if (quantity == "D" || conserves(listed[k])) label[++m] = listed[k]
    printf "| %s", title
    for (k = 1; k <= m; k++) printf " | %s", label[k]
    printf " |\n|---"
    for (k = 1; k <= m; k++) printf "|---"
    print "|"
    for (i = 1; i <= n; i++) {
        printf "| `%s`", method[i]
        for (k = 1; k <= m; k++) printf " | %s", cell(quantity, method[i] SUBSEP label[k])
        print " |"
    }
}
END { table("D", "D"); print ""; table("E", "E") }
