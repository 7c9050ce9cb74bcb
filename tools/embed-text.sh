#!/bin/sh
# embed-text.sh NAME FILE... - writes texts, one after the other, as the C array NAME, byte by byte: the length of a string
# literal is limited.
set -e
printf 'extern const char %s[];\nconst char %s[] = {\n' "$1" "$1"
shift
cat "$@" | od -An -v -td1 | sed 's/ *\(-*[0-9][0-9]*\)/\1,/g'
echo '0};'
