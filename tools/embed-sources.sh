#!/bin/sh
# embed-sources.sh FILE... - writes the C table of the sources that are embedded in the library for
# generated files, without their #include lines: a generated file holds them all.
set -e
echo '#include "codegen/generate.h"'
number=0
for file in "$@"; do
    printf 'static const char text%d[] = {\n' $number
    grep -v '^#include' "$file" | od -An -v -tx1 | sed 's/ \(..\)/0x\1,/g'
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
