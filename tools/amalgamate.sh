#!/bin/sh
# amalgamate.sh FILE.h - writes FILE.h with every #include "..." replaced by that file, once each;
# names are searched beside the file that includes them.
exec awk '
function inline(path, folder, line, name) {
    folder = path
    if (!sub(/[^\/]*$/, "", folder)) folder = ""
    seen[path] = 1
    while ((status = getline line < path) > 0) {
        if (line !~ /^[ \t]*#[ \t]*include[ \t]*"/) { print line; continue }
        split(line, part, "\"")
        name = normal(folder part[2])
        if (!(name in seen)) inline(name)
    }
    if (status < 0) { print "amalgamate: cannot read " path >"/dev/stderr"; exit 1 }
    close(path)
}
function normal(path) {
    while (sub(/[^\/.][^\/]*\/\.\.\//, "", path)) ;
    return path
}
BEGIN { inline(ARGV[1]) }' "$1"
