# header-functions.awk - lists the functions that each public header declares: FUNCTIONS_HEADER(X).
FNR == 1 {
    name = FILENAME
    gsub("^.*/|[.]h$", "", name)
    printf "%s#define FUNCTIONS_%s(X)", (NR > 1 ? "\n" : ""), name
}
/^[a-z]/ && !/^(typedef|static|extern)/ && match($0, "[ *]dal_[a-z0-9][a-z0-9_]*[(]") {
    printf " X(%s)", substr($0, RSTART + 1, RLENGTH - 2)
}
END { print "" }
