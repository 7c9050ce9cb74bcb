# headers.awk - whether each external function is declared in the header of its own file's name, or
# in a public one.  Reads what ctags prints (KIND FILE NAME: p of headers, f of sources), then the
# sources, of which it takes which functions are static.
FILENAME ~ /declared-where\.txt$/ {
    base = $2
    sub(/(_wide)?\.[ch]$/, "", base)
    if ($1 == "prototype") declared[$2 ~ /^include\// ? "public" : base, $3] = 1
    else { file[$3, $2] = base; line_of[$2, $4] = $3 }
    next
}
FNR == 1 { is_static = 0 }
/^static / { is_static = 1 }
((FILENAME, FNR) in line_of) && !is_static && line_of[FILENAME, FNR] != "main" {
    name = line_of[FILENAME, FNR]
    base = file[name, FILENAME]
    if (name ~ /^[A-Z_]+$/) next # a macro that makes functions
    if (!((base, name) in declared) && !(("public", name) in declared))
        print FILENAME ":" FNR ": " name " is not declared in " base ".h"
}
/[{;}]$/ { is_static = 0 }
