# What the program states does not depend on the units of the user: built-in systems, each coordinate,
# the time, the Lagrangian, the constraints and the invariants multiplied by powers of two.
units=${program%/*}/tests/change_units

# The words: numbers are replaced.  Only a 0 is sometimes a rounding.
words() { sed -E 's/[-+]?[0-9]+(\.[0-9]+)?e[-+][0-9]+|[0-9]+\.[0-9]+/#/g; s/(ok|info) +0( |$)/\1 #/; s/(ok|info) +# */\1 # /' "$1"; }
# The size of each observable but the error, which is a length, and the trend of what is no rounding:
# simplification collects the factors of the units in other places, which rounds otherwise.
sizes() {
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) head[$i] = i; next }
        $1 != "error" { print $1, $head["size"], $head["size"] == "rounding" ? "" : $head["trend"] }' "$1"
}

case_is "units of built-in systems"
if [ -x "$units" ]; then
    "$program" list systems --markdown | sed -n 's/^| `\([a-z-]*\)` .*/\1/p' >systems
    changed=0
    while read -r system; do
        mkdir -p one other
        "$units" "$system" 0 >one/system.yaml 2>err
        [ $? -eq 3 ] && continue # it has events, reactions or functions of its own
        "$units" "$system" 1 >other/system.yaml 2>err || fail "$system: no other units"
        changed=$((changed + 1))
        for place in one other; do
            (cd $place && "$program" check system.yaml >check 2>err
                echo "exit $?" >>check
                words check >words
                "$program" run system.yaml --integrator rk4 --output run >out 2>>err
                echo "exit $?" >sizes
                sizes run/summary.csv >>sizes 2>&1)
        done
        holds "$system: check differs in other units: $(diff one/words other/words | head -4)" \
            cmp one/words other/words
        holds "$system: sizes differ in other units: $(diff one/sizes other/sizes | head -4)" \
            cmp one/sizes other/sizes
        holds "$system: no sizes" test "$(wc -l <one/sizes)" -ge 2
        rm -rf one other
    done <systems
    holds "only $changed systems" test $changed -ge 33
else
    echo "cli: units: skipped: no $units (make check builds it)"
fi

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

case_is "explain in other units"
if [ -x "$units" ] && needs 8 "no python3" there python3; then
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
        holds "$system: explain differs in other units: $(diff explain-0/shares explain-3/shares | head -4)" \
            cmp explain-0/shares explain-3/shares
        holds "$system: no shares" test "$(grep -c "'\|\[" explain-3/shares)" -ge 1
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
holds "E is rounding: $(grep '^E ' sizes)" grep -q '^E larger ' sizes
