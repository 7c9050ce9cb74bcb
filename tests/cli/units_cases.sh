# What the program states does not depend on the units of the user: built-in systems, each coordinate,
# the time, the Lagrangian, the constraints and the invariants multiplied by powers of two.  UNITS="1 2 3" compares
# all commands on all systems in these units, not some in one.
#
# Other than by the units may be: numbers at rounding, and trends of what is no more than rounding; |p| and |pi| off
# p = pi = 0, maxima over coordinates of different units, and then the motion, for H adds the pi_i^2; error, a length.
units=${program%/*}/tests/change_units

# The words: numbers are replaced.  Only a 0 is sometimes a rounding.
words() { sed -E 's/[-+]?[0-9]+(\.[0-9]+)?e[-+][0-9]+|[0-9]+\.[0-9]+/#/g; s/(ok|info) +0( |$)/\1 #/; s/(ok|info) +# */\1 # /' "$1"; }
# The size of each observable but the error, which is a length, and the trend of what is no rounding:
# simplification collects the factors of the units in other places, which rounds otherwise.
sizes() {
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) head[$i] = i; next }
        $1 != "error" { print $1, $head["size"], $head["size"] == "rounding" ? "" : $head["trend"] }' "$1"
}

# The units of a file of change_units: tau, c, d and the units of the coordinates.
unit() { awk -v i="$2" 'NR == 1 { print $(i + 1) }' "$1"; }
default_step() { sed -n 's/^defaults:.*"step": \([^,}]*\).*/\1/p' "$1"; }

# Shares in percent, rounded, with the sentence and what is conserved of each observable but the error;
# of what stays at rounding, that it does.
shares() {
    python3 - <<'END'
import json
for o in json.load(open('explained'))['observables']:
    if o['name'] == 'error':
        continue
    if o['sentence'] in ('stays at rounding', 'never changes'):
        print(o['name'], o['is_conserved'], 'stays')
        continue
    print(o['name'], o['is_conserved'], o['sentence'].split(' (')[0])
    print([None if s['share'] is None else round(100 * s['share'], 1) + 0.0 for s in o['sources']],
          None if o['order'] is None else round(o['order'], 2) + 0.0)
END
}

# states_of COMMAND: what it prints of system.yaml that has no unit, numbers in units of the time where it is one.
states_of() {
    tau=$(unit system.yaml 1)
    case $1 in
        check)
            "$program" check system.yaml >out 2>err
            echo "exit $?"
            # the coefficients of an invariant have units
            awk '/^  proposed invariant/ { print $1, $2, $3; skip = 1; next } !/^            / { skip = 0 } !skip' out >known
            words known ;;
        run)
            "$program" run system.yaml --integrator rk4 --output run >out 2>err
            echo "exit $?"
            sizes run/summary.csv ;;
        order)
            "$program" order system.yaml --integrators rk4,gauss4,gauss4+project --output order.csv >out 2>err
            echo "exit $?" # errors near rounding have other digits
            awk -F, 'NR > 1 { print $2, $3, sprintf("%.1f", $4), $7 > 1e-9 ? sprintf("%.1e", $7) : "", $11 }' order.csv ;;
        study)
            printf 'systems: [system.yaml]\nintegrators: [rk4, gauss4, dla, rk4+project]\n%s\nsamples: 40\n' \
                'starts: [physical, surface, displaced]' >study.yaml
            printf 'steps: 100\nstep: %s\n' "$(default_step system.yaml)" >>study.yaml
            "$program" study study.yaml --output study --no-page --tables >out 2>err
            echo "exit $?"
            # |p| and |pi| are maxima over coordinates: off 0 they have a unit only where all have the same
            awk -F, -v equal="$(awk 'NR == 1 { e = 1; for (i = 6; i <= NF; i++) e = e && $i == $5; print e }' system.yaml)" '
                NR == 1 { for (i = 1; i <= NF; i++) head[$i] = i; next }
                ($3 == "displaced" || $5 == "error") && !equal { next }
                { print $2, $3, $5, $head["size"], $head["size"] == "rounding" ? "" : $head["trend"] }' study/quantities.csv ;;
        section)
            first=$(sed -n 's/^coordinates: \["\([^"]*\)".*/\1/p' system.yaml)
            "$program" section system.yaml --on "$first'" --integrator rk4 --output section.csv >out 2>err
            echo "exit $?"
            awk -F, -v tau="$tau" 'NR > 1 { print $1, sprintf("%.6g", $2*tau), $3 }' section.csv
            sed 's/^t = [^:]*//' out ;;
        explain)
            "$program" explain system.yaml --integrator rk4 --json >explained 2>err
            echo "exit $?"
            [ ! -s explained ] || shares ;;
        *)
            "$program" "$1" system.yaml --integrator rk4 --json >out 2>err
            echo "exit $?"
            # mean, low, high over the unit of time; chance decides the digits of what is near 0
            grep '"mean"' out | tr -d '{}[],' | awk -v tau="$tau" '{
                for (i = 1; i <= NF; i++) if ($i ~ /^-?[0-9.]+(e[-+][0-9]+)?$/) {
                    x = $i/tau
                    $i = x < 1e-6 && x > -1e-6 ? 0 : sprintf("%.3g", x)
                }
                print
            }' ;;
    esac
}

# bits_of METHOD: the rows of 50 steps, in the units that all systems have.
bits_of() {
    "$program" run system.yaml --integrator "$1" --space physical --step "$(default_step system.yaml)" --steps 50 \
        --samples 50 --sampling steps --output rows.csv >out 2>err
    echo "exit $?"
    awk -F, 'NR == FNR { if (FNR == 1) { n = split($0, u, " ") - 4; tau = u[2] } ; next }
        FNR > 1 {
            row = sprintf("%.17g", $1*tau)
            for (i = 1; i <= n; i++) row = row sprintf(" %.17g %.17g", $(1 + i)*u[4 + i], $(1 + n + i)*u[4 + i]/tau)
            print row
        }' system.yaml rows.csv
}
# compare SYSTEM SEED COMMAND...
compare() {
    system=$1 seed=$2
    shift 2
    for command in "$@"; do
        [ -f "plain/$system/$command" ] || (mkdir -p "plain/$system" && cd "plain/$system" &&
            "$units" "$system" 0 >system.yaml && states_of "$command" >"$command" 2>&1)
        mkdir -p other
        (cd other && "$units" "$system" "$seed" >system.yaml && states_of "$command" >"$command" 2>&1)
        expect "$system: $command differs in units $seed: $(diff "plain/$system/$command" other/"$command" | head -4)" \
            cmp "plain/$system/$command" other/"$command"
        rm -rf other
    done
}

case_is "units of built-in systems"
if [ -x "$units" ]; then
    touch err
    "$program" list systems --markdown | sed -n 's/^| `\([a-z-]*\)` .*/\1/p' >systems
    changed=0
    while read -r system; do
        "$units" "$system" 0 >out 2>&1
        [ $? -eq 3 ] && continue # it has events, reactions or functions of its own
        changed=$((changed + 1))
        for seed in ${UNITS:-17}; do
            compare "$system" "$seed" check run
            [ -z "$UNITS" ] || compare "$system" "$seed" order study section lyapunov volume explain
            for method in rk4 gauss4; do
                mkdir -p one other
                (cd one && "$units" "$system" 0 parameters >system.yaml && bits_of $method >rows)
                (cd other && "$units" "$system" "$seed" parameters >system.yaml && bits_of $method >rows)
                expect "$system: other bits by $method in units $seed" cmp one/rows other/rows
                rm -rf one other
            done
        done
        expect "$system: no sizes" test "$(wc -l <"plain/$system/run")" -ge 2
    done <systems
    expect "only $changed systems" test $changed -ge 33
    for seed in 4 17; do
        for system in damped-oscillator isokinetic nonholonomic-particle; do
            compare $system $seed order study section lyapunov volume
        done
    done
    rm -rf plain
else
    skips 206 "no $units: make check builds it"
fi

case_is "explain in other units"
changes_and_reads() { [ -x "$units" ] && there python3; }
if needs 8 "no $units, or no python3" changes_and_reads; then
    for system in chaplygin-sleigh contact-oscillator damped-oscillator isokinetic; do
        for seed in 0 3; do
            mkdir -p explain-$seed
            "$units" $system $seed >explain-$seed/system.yaml 2>err
            tau=$(sed -n '1s/^# \([^ ]*\).*/\1/p' explain-$seed/system.yaml)
            (cd explain-$seed && "$program" explain system.yaml --integrator rk4 --json \
                --step "$(awk -v tau="$tau" 'BEGIN { printf "%.17g", 0.0625/tau }')" \
                --time "$(awk -v tau="$tau" 'BEGIN { printf "%.17g", 25/tau }')" >explained 2>>err
                echo "exit $?" >shares
                shares >>shares)
        done
        expect "$system: explain differs in other units: $(diff explain-0/shares explain-3/shares | head -4)" \
            cmp explain-0/shares explain-3/shares
        expect "$system: no shares" test "$(grep -c "'\|\[" explain-3/shares)" -ge 1
    done
    counted
fi

case_is "an oscillator at x = 1000, and its exact solution"
cat >far.yaml <<'END'
coordinates: [x]
lagrangian: (x'^2 - x^2)/2
start: {x: 1000}
exact: {x: 1000*cos(t)}
END
try 0 check far.yaml
prints '^  energy E +ok +conserved on every level of D'
prints "^  residual of q' = v, v' = F +ok "

case_is "a satellite in metres"
cat >satellite.yaml <<'END'
coordinates: [x, y]
parameters: {GM: 3.986e14}
lagrangian: (x'^2 + y'^2)/2 + GM/sqrt(x^2 + y^2)
start: {x: 7e6, y': 7546}
invariants: {moment: x*y' - y*x'}
END
try 0 check satellite.yaml
prints '^  energy E +ok +conserved on every level of D'
prints '^  invariant moment +ok '

case_is "a bead of 5e-16 kg with friction does not keep its energy"
cat >bead.yaml <<'END'
coordinates: [x]
parameters: {m: 5e-16, r: 1e-9}
lagrangian: m/2*x'^2
forces: {x: -r*x'}
start: {x': 1e-3}
invariants: {energy: m*x'^2}
END
try 1 check bead.yaml
prints '^  energy E +ok +not conserved'
prints '^  invariant energy +FAIL '

case_is "a small fault is one in all units"
for by in 1 1e-20 1e20; do
    cat >fault.yaml <<END
coordinates: [x]
lagrangian: $by*(x'^2 - x^2)/2
start: {x: 1}
invariants: {wrong: "$by*(x'^2 + 1.001*x^2)"}
exact: {x: cos(1.001*t)}
END
    try 1 check fault.yaml
    prints '^  invariant wrong +FAIL '
    prints "^  residual of q' = v, v' = F +FAIL "
done

case_is "an atom that loses 87 % of its energy"
cat >atom.yaml <<'END'
coordinates: [x]
parameters: {m: 1.67e-27, k: 500}
lagrangian: m/2*x'^2 - k/2*x^2
start: {x: 1e-11}
END
try 0 run atom.yaml --integrator rk4 --step 2e-15 --time 2e-13 --output atom
sizes atom/summary.csv >sizes
expect "E is rounding: $(grep '^E ' sizes)" grep -q '^E larger ' sizes

# x = 1e-11 cos(w t), w = sqrt(k/m): the powers of w in its coefficients are beyond the numbers.
case_is "the atom by Taylor series"
try 0 run atom.yaml --integrator taylor --tolerance 1e-14 --step 2e-15 --time 2e-13 --native off --output off.csv
expect "not the closed form: $(tail -n 1 off.csv)" awk -F, '
    function off(x, y, size) { return x < y - 1e-12*size || x > y + 1e-12*size }
    NR > 1 { w = sqrt(500/1.67e-27) }
    NR > 1 && (off($2, 1e-11*cos(w*$1), 1e-11) || off($3, -1e-11*w*sin(w*$1), 1e-11*w)) { bad = 1 }
    END { exit bad || NR < 100 }' off.csv
if needs 2 "no compiler" there cc; then
    try 0 run atom.yaml --integrator taylor --tolerance 1e-14 --step 2e-15 --time 2e-13 --native on --output on.csv
    expect "compiled steps have other bits" cmp off.csv on.csv
    counted
fi
