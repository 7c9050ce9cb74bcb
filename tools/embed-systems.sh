#!/bin/sh
# embed-systems.sh FILE.yaml... - writes the C table of the systems that are embedded in the library.
set -e
echo '#include "load/builtin.h"'
echo 'const dal__builtin dal__builtins[] = {'
for file in "$@"; do
    printf '{"%s",\n' "$(basename "$file" .yaml)"
    sed 's/[\\"]/\\&/g; s/\t/\\t/g; s/^/"/; s/$/\\n"/' "$file"
    echo '},'
done
echo '{0, 0}};'
