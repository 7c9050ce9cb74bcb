#!/bin/sh
# tolerances.sh PROGRAMS [heyoka] - prints the case table of the time to an error, after it has made the
# references and found the tolerances; with heyoka measured here, too.
set -u
programs=$1 live=${2-}

# Times of heyoka 7 at its best flags to each error, in steps of the loop by hand; measured once, where such
# a step takes 44.4 ns.
measured_once() { # SYSTEM LANES
    case $1.$2 in
    A.1) echo 946 1374 1847 ;;
    A.8) echo 495 586 721 ;;
    chaotic-oscillators.1) echo 574 1802 2950 ;;
    chaotic-oscillators.8) echo 205 367 561 ;;
    falling-disk.1) echo 1126 2905 5495 ;;
    falling-disk.8) echo 563 653 1126 ;;
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

for system in A chaotic-oscillators falling-disk; do
    "$programs/tolerances" reference $system >"$programs/reference.$system" || exit 1
    case $system in
    A)
        cat <<'END_OF_TEXT'
## Time to an error: A, T = 100 | steps of RK4 by hand on A
# The time of a trajectory under error control, compiled, in steps of the loop by hand for RK4 on A, which is
# measured beside it. The error of (q, v) at T is relative, in the Euclidean norm, the largest of
# all lanes; the reference is taylor in quad precision, with which gauss12 in quad precision agrees. The tolerance,
# in brackets, is the largest that reaches the error. Eight lanes have starts of their own. The goals are the
# times of heyoka 7 at its best flags, measured once, on a machine where a step of the loop takes 44.4 ns.
END_OF_TEXT
        ;;
    *) printf '## Time to an error: %s, T = 20 | steps of RK4 by hand on A\n# The same for another system.\n' $system ;;
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
