#!/bin/sh
# valgrind.sh COMMAND... - runs it under valgrind, for the memory alone, and what crashes: valgrind's long
# double has 64 bits, its fused multiply-add loses the sign of a zero, so that asserts on bits, exit status 1,
# count in the other runs.
valgrind -q --error-exitcode=99 --leak-check=full "$@"
status=$?
[ $status -eq 1 ] || exit $status
