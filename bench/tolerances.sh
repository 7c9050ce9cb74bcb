#!/bin/sh
# tolerances.sh PROGRAMS [heyoka] - prints the case table of the time to an error, after it has made the
# references and found the tolerances; with heyoka measured here, too.
set -u
programs=$1 live=${2-}

# Times of heyoka 7 at its best flags to each error, in steps of the loop by hand; measured live, where such
# a step takes 42 ns, with SLEEF and AVX-512.
measured_once() { # SYSTEM LANES
    case $1.$2 in
    A.1) echo 848 1218 1718 ;;
    A.8) echo 213 270 355 ;;
    chaotic-oscillators.1) echo 500 1727 2536 ;;
    chaotic-oscillators.8) echo 156 344 400 ;;
    falling-disk.1) echo 675 1351 2299 ;;
    falling-disk.8) echo 137 206 384 ;;
    knife-edge-pendulum.1) echo 1327 3436 5095 ;;
    knife-edge-pendulum.8) echo 268 521 782 ;;
    turntable-ball.1) echo 52 43 38 ;;
    turntable-ball.8) echo 18 15 14 ;;
    four_bodies.1) echo 735 1635 2441 ;;
    four_bodies.8) echo 149 318 396 ;;
    esac
}

# A case: what the largest tolerance takes that reaches the error.
row() { # PROGRAM METHOD SYSTEM LANES ERROR GOAL
    found=$("$programs/$1" find "$2" "$3" "$4" "$5") || exit 1
    tolerance=${found% *} reached=${found#* }
    case $4 in
    1) what="$3, one lane, $5" ;;
    *) what="$3, $4 lanes, $5" ;;
    esac
    if [ "$tolerance" = - ]; then
        echo "$2-$4-$5 | $what: $reached at best | | | 1 | $6 | -"
    else
        echo "$2-$4-$5 | $what ($tolerance) | $1 time $2 $3 $4 $5 $tolerance | hand rk4 A | 1 | $6 | -"
    fi
}

systems="A chaotic-oscillators falling-disk knife-edge-pendulum turntable-ball four_bodies"
for system in $systems; do
    "$programs/tolerances" reference $system >"$programs/reference.$system" || exit 1
    [ $system != knife-edge-pendulum ] || live= # bench/heyoka has no field of this system and the next ones
    case $system in
    A)
        cat <<'END_OF_TEXT'
## Time to an error: A, T = 100 | steps of RK4 by hand on A
# The time of a trajectory under error control, compiled, in steps of the loop by hand for RK4 on A, which is
# measured beside it. The error of (q, v) at T is relative, in the Euclidean norm, the largest of
# all lanes; the reference is taylor in quad precision, with which gauss12 in quad precision agrees. The tolerance,
# in brackets, is the largest of 10^(-k/4) that reaches the error, as all smaller ones do. Eight lanes have starts
# of their own. The goals are the times of heyoka 7 at its best flags, measured once, on a machine where a step of
# the loop takes 42 ns.
END_OF_TEXT
        ;;
    *) printf '## Time to an error: %s | steps of RK4 by hand on A\n# The same for another system.\n' $system ;;
    esac
    for lanes in 1 8; do
        goals=$(measured_once $system $lanes)
        for error in 1e-6 1e-10 1e-13; do
            for method in dop853 taylor; do
                row tolerances $method $system $lanes $error "<= ${goals%% *}"
            done
            [ -z "$live" ] || row heyoka heyoka $system $lanes $error -
            goals=${goals#* }
        done
    done
done

cat <<'END_OF_TEXT'
## Errors of dop853 under a tolerance | error / tolerance
# The largest error at T of 123 tolerances, from 1e-3 to 1e-13 in quarters of a decade and 1e-6 of them below and above,
# in units of the tolerance.
END_OF_TEXT
for system in $systems; do
    echo "errors-$system | $system | tolerances errors dop853 $system 1 | | 1 | <= 20 | -"
done
