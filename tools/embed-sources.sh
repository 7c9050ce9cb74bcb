#!/bin/sh
# embed-sources.sh FILE... - writes the C table of the sources that are embedded in the library for
# generated files.  They lack their #include lines, since a generated file holds them all; files of
# the kernel and the templates also lack include guards, comments that begin a line, and empty
# lines: they are explained where they are, and a generated file has its own comment.
set -e
plain() { # FILE
    case $1 in
    *.c) awk '
        /^#include/ { next }
        /^#define ABOUT_/ { about = 1 } # the documentation of a descriptor
        about { about = /\\$/; next }
        { print }' "$1" ;;
    *) awk '
        /^#include/ || /^$/ || /^#ifndef DAL_KERNEL_[A-Z_]*_H$/ { next }
        /^#define DAL_KERNEL_[A-Z_]*_H$/ { guarded = 1; next }
        /^\/\*/ { comment = 1 }
        comment { if (/\*\/$/) comment = 0; next }
        { if (held) print line; line = $0; held = 1 }
        END { if (!guarded) print line }' "$1" ;; # the last #endif is the guard's
    esac
}
echo '#include "codegen/generation.h"'
number=0
for file in "$@"; do
    printf 'static const char text%d[] = {\n' $number
    plain "$file" | od -An -v -tx1 | sed 's/ \(..\)/0x\1,/g'
    echo '0};'
    number=$((number + 1))
done
echo 'const dal__source dal__sources[] = {'
number=0
for file in "$@"; do
    printf '{"%s", text%d},\n' "$(basename "$file")" $number
    number=$((number + 1))
done
echo '{0, 0}};'
