#!/bin/sh
# sizes.sh - prints the case table of what a step takes by the size of a system.
cat <<'END_OF_HEAD'
## The size of a system | microseconds a step | sizes
# The time of a step on a chain of n coordinates with n/4 constraints whose Jacobian varies. Of each class of
# methods there is one: explicit Runge-Kutta (rk4), the symplectic Euler family (stormer-verlet), Gauss (gauss4,
# by fixed-point iteration) and RATTLE, which keeps every constraint on the velocities (gni).
# Compiled steps end where the compiler takes more than half a minute.
END_OF_HEAD
for method in rk4 stormer-verlet gauss4 gni; do
    for n in 4 8 16 32 64 128 256; do
        echo "$method-tape-$n | interpreted | dal tape $method physical R$n | | 1e-3 | - | -"
        [ $n -le 32 ] || continue
        echo "$method-native-$n | compiled | dal native $method physical R$n | | 1e-3 | - | -"
    done
done
