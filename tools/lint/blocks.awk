# blocks.awk - comments of BLOCK characters and more that two files have word for word.
function words(text) {
    gsub(/^[ \t]*(\/\*+|\*\/|\*|#+)?[ \t]*/, "", text)
    gsub(/[ \t]*\*\/.*$/, "", text)
    gsub(/-----*/, "", text) # rules across the page
    gsub(/[ \t]+/, " ", text)
    return text
}
function finish() {
    if (length(block) >= BLOCK) {
        if (block in file && file[block] != FILENAME && !(block SUBSEP FILENAME in said)) {
            print FILENAME ":" line ": the comment is in " file[block] ":" at[block] " too"
            said[block, FILENAME] = 1
        } else if (!(block in file)) {
            file[block] = FILENAME
            at[block] = line
        }
    }
    block = ""
    inside = 0
}
FNR == 1 { block = ""; inside = 0 }
!inside && /^[ \t]*\/\*/ || FILENAME ~ /\.(sh|py|awk|mk)$|Makefile$|run$/ && /^[ \t]*# / {
    if (!inside) line = FNR
    hash = /^[ \t]*# /
    inside = 1
}
inside {
    if (hash && !/^[ \t]*#/) { finish(); next }
    block = block (block == "" ? "" : " ") words($0)
    if (!hash && /\*\//) finish()
}
