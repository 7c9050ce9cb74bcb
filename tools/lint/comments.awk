# comments.awk - names in comments that there are not: awk -f comments.awk FILES SOURCE...
# FILES lists the files of the repository; identifiers come from the code of all SOURCEs, and
# one that begins others (DAL_SOLVER_) means them all.  Words that are made elsewhere: see `made`.

BEGIN {
    n = split("sleigh.c variants.h dal_integrator_NAME dop853.f", made, " ")
    for (i = 1; i <= n; i++) known[made[i]] = 1
}

FILENAME == ARGV[1] {
    sub(/.*\//, "")
    known[$0] = 1
    next
}

FNR == 1 { inside = 0 }

{
    code = comment = ""
    rest = $0
    while (rest != "") {
        at = index(rest, inside ? "*/" : "/*")
        piece = at ? substr(rest, 1, at - 1) : rest
        if (inside) comment = comment " " piece; else code = code " " piece
        rest = at ? substr(rest, at + 2) : ""
        if (at) inside = !inside
    }
    while (match(code, /[A-Za-z_][A-Za-z0-9_]*/)) {
        known[substr(code, RSTART, RLENGTH)] = 1
        code = substr(code, RSTART + RLENGTH)
    }
    gsub(/<[a-z0-9_\/]*\.h>/, " ", comment)
    while (match(comment, /[A-Za-z0-9_.\/-]*[A-Za-z0-9_]/)) {
        word = substr(comment, RSTART, RLENGTH)
        comment = substr(comment, RSTART + RLENGTH)
        sub(/.*\//, "", word)
        if (word ~ /^(dal|DAL|cli|CLI)_[A-Za-z0-9_]+$/ || word ~ /^[a-z][A-Za-z0-9_-]+\.(c|h|f|md|tex|def|awk|map|inc)$/)
            where[word] = where[word] FILENAME ":" FNR ": there is no " word "\n"
    }
}

END {
    for (word in where) {
        found = word in known
        if (!found)
            for (name in known) if (index(name, word) == 1 && length(name) > length(word)) found = 1
        if (!found) printf "%s", where[word]
    }
}
