# The option extend-energy in every command that steps.

case_is "extend-energy: E is kept where the plain motion loses it"
motion="contact-oscillator --integrator gauss8 --step 0.1 --time 20000 --samples 10 --space physical"
for way in off on; do
    try 0 run $motion --extend-energy $way --native off --output $way.csv
    silent
done
# Column 9 is E, which begins at 3/2: rounding in D has moved it by some 1e-11, or not at all.
strays() { awk -F, -v most="$2" 'NR > 1 { d = $9 - 1.5; if (d < 0) d = -d; if (d > m) m = d }
                                  END { exit !(m > most) }' "$1"; }
expect "the plain motion keeps E" strays off.csv 1e-12
expect "E is not kept" eval '! strays on.csv 2e-13'

case_is "extend-energy: native and generated, same bytes"
if needs 7 "no compiler" there cc; then
    try 0 run $motion --extend-energy on --native on --output native.csv
    silent
    expect "other bytes" cmp -s on.csv native.csv
    try 0 generate contact-oscillator --integrator gauss8 --extend-energy on --prefix on
    mv out on.c
    try 0 generate contact-oscillator --integrator gauss8 --prefix on
    expect "the option changes nothing" eval '! cmp -s out on.c'
    expect "no compilation" cc -c on.c -o on.o
    counted
fi

case_is "extend-energy: resumed"
try 0 run $motion --extend-energy on --native off --output on.npy
try 0 run $motion --extend-energy on --native off --output kept
try 0 resume kept
expect "not kept in the manifest" grep -q '^    "extend-energy": "on",$' kept/manifest.json
expect "other bytes" cmp -s on.npy kept/trajectory.npy

case_is "extend-energy: refused with the reason"
try 2 run isokinetic --integrator rk4 --step 0.1 --time 1 --extend-energy on
says "extend-energy cannot act on isokinetic: the motion does not conserve its energy"
try 2 run isokinetic --integrator rk4 --step 0.1 --time 1 --extend-energy yes
says "'yes' is not one of off.on"

case_is "extend-energy: in a study"
cat >extended.yaml <<'END2'
integrators: [gauss8]
step: 0.1
time: 2000
starts: physical
systems:
  - {system: contact-oscillator, label: off}
  - {system: contact-oscillator, label: on, options: {extend-energy: on}}
END2
try 0 study extended.yaml --output in-study
loss() { awk -F, -v label="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "E_deviation") k = i }
                                $1 == label { print $k }' in-study/cells.csv; }
expect "E_deviation: $(loss off), $(loss on)" \
    awk "BEGIN { exit !($(loss off) > 4e-13 && $(loss on) < 2e-13) }"
sed -i 's/extend-energy/extend-energie/' extended.yaml
try 2 study extended.yaml --output in-study
says "extended.yaml:7:55: unknown option 'extend-energie'; did you mean 'extend-energy'"
sed -i 's/extend-energie: on/step: 3/' extended.yaml
try 2 study extended.yaml --output in-study
says "options: step has a key of its own"
sed -i 's/step: 3/solve-to: 1e-9/' extended.yaml
try 2 study extended.yaml --output in-study
says "extended.yaml:7:55: options: solve-to is called solver-tolerance now"
sed -i 's/solve-to: 1e-9/precision: long/' extended.yaml
try 2 study extended.yaml --output in-study
says "extended.yaml:7:55: options: precision: long is called quad now"

case_is "effort: native and generated, same bytes; on p = pi = 0 as without"
pushed="chaplygin-sleigh --integrator gauss4 --step 0.05 --time 3 --samples 6 --start pi_y1=0.4 --start p_phi=0.1"
resting="chaplygin-sleigh --integrator gauss4 --step 0.05 --time 3 --samples 6"
try 0 run $pushed --effort constraint --native off --output pushed.csv
try 0 run $resting --native off --output resting.csv
for effort in identity mass constraint; do
    try 0 run $resting --effort $effort --native off --output other.csv
    expect "$effort: other bytes" cmp -s resting.csv other.csv
done
try 0 run $pushed --native off --output other.csv
expect "the effort changes nothing" eval '! cmp -s pushed.csv other.csv'
if needs 15 "no compiler" there cc; then
    for method in rk4 gauss4 stormer-verlet taylor rk4+lift; do
        set -- chaplygin-sleigh --integrator $method --step 0.05 --time 3 --samples 6 --start pi_y1=0.4 --effort constraint
        try 0 run "$@" --native off --output off.csv
        try 0 run "$@" --native on --output on.csv
        expect "$method: other bytes" cmp -s off.csv on.csv
    done
    counted
fi

case_is "effort: resumed, in a study, and refused"
try 0 run $pushed --effort constraint --native off --output pushed.npy
try 0 run $pushed --effort constraint --native off --output effort-kept
try 0 resume effort-kept
expect "not kept in the manifest" grep -q '"effort": "constraint"' effort-kept/manifest.json
expect "other bytes" cmp -s pushed.npy effort-kept/trajectory.npy
try 2 resume effort-kept --effort mass
cat >efforts.yaml <<'END2'
integrators: [gauss4]
step: 0.05
time: 2
starts: displaced
displacement: 0.1
systems:
  - {system: chaplygin-sleigh, label: identity}
  - {system: chaplygin-sleigh, label: constraint, options: {effort: constraint}}
END2
try 0 study efforts.yaml --output of-efforts
moved() { awk -F, -v label="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "D_max") k = i }
                                 $1 == label { print $k }' of-efforts/cells.csv; }
expect "D_max: $(moved identity), $(moved constraint)" \
    awk "BEGIN { exit !($(moved identity) > 1e-2 && $(moved constraint) < 1e-5) }"
sed -i 's/effort: constraint/effort: constrain/' efforts.yaml
try 2 study efforts.yaml --output of-efforts
says "efforts.yaml:8:69: unknown effort 'constrain'; did you mean 'constraint'"
table <<'END2'
2 | run chaplygin-sleigh --effort masses | says --effort: 'masses' is not one of identity.mass.constraint.controls
2 | run chaplygin-sleigh --effort controls | says effort controls: the system has none; they are columns of forces
2 | run chaplygin-sleigh-vakonomic --effort mass | says effort mass: vakonomic motion has no lift
END2

case_is "effort: check verifies K, Dirac's algebra and H"
for effort in mass constraint; do
    try 0 check chaplygin-sleigh --effort $effort --details
    prints "\(pi\.K pi\)_q, \(pi\.K pi\)_v *ok"
    prints "H on the surface *ok"
    prints "d int P\.X' - H, implicit-midpoint *ok"
done
prints "A K = 0 *ok"

case_is "gauge: of a run, a directory and a study; (q, v) has the same bytes"
moving="chaplygin-sleigh --integrator gauss4 --step 0.125 --time 1 --samples 4 --native off"
try 0 run $moving --columns "y1,y2,phi,y1',y2',phi'" --output plain.csv
try 0 run $moving --columns "y1,y2,phi,y1',y2',phi'" --gauge "e = 2, mu_e = 0.25*cos(t)" --output gauged.csv
expect "other bytes" cmp -s plain.csv gauged.csv
try 0 run $moving --columns e,pi_e --gauge "e=2,mu_e=0.25"
prints "^1,2\.25,0$"
try 0 run $moving --gauge "e = 2, mu_e = 0.25" --output gauge-kept
try 0 resume gauge-kept
try 2 resume gauge-kept --gauge "mu_e = 1"
expect "not kept in the manifest" grep -q '"gauge": "e = 2, mu_e = 0.25"' gauge-kept/manifest.json
try 0 check chaplygin-sleigh --gauge "e = 2, mu_e = cos(t)"
try 0 generate chaplygin-sleigh --integrator rk4 --gauge "mu_e = cos(t)" --prefix g
prints "DAL_EVAL_GAUGE"
cat >gauges.yaml <<'END2'
integrators: [gauss4]
step: 0.125
time: 1
starts: [physical, surface]
systems:
  - {system: chaplygin-sleigh, options: {gauge: "e = 2, mu_e = 0.25*cos(t)"}}
END2
try 0 study gauges.yaml --output of-gauges
expect "other bits than on (q, v)" eval 'grep -q "surface.*,yes," of-gauges/cells.csv'
sed -i 's/mu_e = 0.25/mu = 0.25/' gauges.yaml
try 2 study gauges.yaml --output of-gauges
says "'mu' is not e or mu_e, which a gauge gives"
table <<'END2'
2 | run chaplygin-sleigh --gauge "mu_e = 1, e = y1" | says --gauge:1:15: gauge e: coordinate 'y1' may not stand here
2 | run chaplygin-sleigh --gauge "e" --observe phi^2 | says ^dalembert: --gauge:1:1: a gauge is 'e = 1, mu_e = 0.1.cos.t.', of these two or one$
2 | run chaplygin-sleigh --set m=1e999 | says ^dalembert: m=1e999: '1e999' is too large$
2 | run chaplygin-sleigh --gauge "e" | says --gauge:1:1: a gauge is 'e = 1, mu_e = 0.1.cos.t.', of these two or one
END2

case_is "gauge of the state: the same bytes interpreted and native"
if needs 24 "no compiler" there cc; then
    for method in rk4 dop853 gauss4 lobatto6 stormer-verlet symplectic-euler-11 taylor rk4+lift; do
        set -- chaplygin-sleigh --integrator $method --step 0.05 --time 3 --samples 6 --start pi_y1=0.4 --start pi_e=0.3 \
            --effort constraint --gauge "mu_e = 0.3*sin(phi)*y1' - 0.2*e*phi'"
        try 0 run "$@" --native off --output off.csv
        try 0 run "$@" --native on --output on.csv
        expect "$method: other bytes" cmp -s off.csv on.csv
    done
    counted
fi

case_is "a method that cannot serve is refused with the reason"
refuses() { # REASON SYSTEM INTEGRATOR SPACE
    try 2 run $2 --integrator $3 --step 0.1 --time 1 --space $4
    says "$1"
    empty
}
refuses "rk4 is not symmetric" contact-oscillator rk4+symmetric-project physical
refuses "the motion does not conserve its energy" isokinetic rk4+project-energy physical
refuses "take the physical space" contact-oscillator gni lifted
refuses "needs a method of order 2: gauss4 is of order 4" contact-oscillator gauss4+yoshida4 lifted

case_is "tolerance: the error follows it, whatever the step"
error_at_end() { awk -F, 'END { print $NF }' "$1"; }
for tolerance in 1e-5 1e-10; do
    try 0 run knife-edge --integrator dop853 --step 5 --time 10 --samples 1 \
        --tolerance $tolerance --output $tolerance.csv
    silent
done
expect "errors $(error_at_end 1e-5.csv), $(error_at_end 1e-10.csv)" \
    awk "BEGIN { exit !($(error_at_end 1e-10.csv) < 1e-3 * $(error_at_end 1e-5.csv)) }"

case_is "tolerance: Taylor series"
for tolerance in 1e-5 1e-10 1e-18; do
    try 0 run knife-edge --integrator taylor --step 5 --time 10 --samples 1 \
        --tolerance $tolerance --output series.csv
    expect "error beyond ten times $tolerance" awk -F, -v max=$tolerance \
        'END { if (max < 1e-14) max = 1e-14; exit !($NF < 10*max) }' series.csv
done
printf '%s\n' 'coordinates: [x]' 'accelerations: {x: -abs(x)}' 'start: {x: 1}' >kinked.yaml
try 2 run kinked.yaml --integrator taylor --step 0.1 --time 1
says "the equations contain abs, which has no Taylor series at its jump or kink"
try 2 run knife-edge --integrator taylor+lift --step 0.1 --time 1
# F = 0 all along, but the second step begins where the mass matrix has a pivot of 1e-14.
printf '%s\n' 'coordinates: [x, y, z]' "lagrangian: (x'^2 + y'^2 + z'^2)/2 + cos(z)*x'*y'" \
    "start: {z: 2^(-23) - 0.5, z': 1}" >vanishing.yaml
for native in off on; do
    [ $native = off ] || needs 2 "no compiler" there cc || continue
    try 3 run vanishing.yaml --integrator taylor --step 0.5 --time 2 --native $native
    says "the mass matrix became singular near t = 0.5"
    [ $native = off ] || counted
done

case_is "tolerance: no smaller than what the precision can hold"
printf "coordinates: [x]\nparameters: {m: 1}\nlagrangian: m*x'^2/2\n" >heavy.yaml
for precision in double quad; do
    [ $precision = double ] && min=5.4e-20 || min=4.7e-38
    try 2 run ./heavy.yaml --integrator taylor --tolerance 1e-40 --precision $precision --step 1 --time 2
    says "^dalembert: --tolerance: 1e-40 is below $min, the smallest in this precision$"
    try 2 order ./heavy.yaml --tolerances 1e-5,1e-40 --precision $precision --time 2
    says "^dalembert: --tolerances: 1e-40 is below $min, the smallest in this precision$"
done
for key in 'tolerance: [1e-5, 1e-40]' 'options: {tolerance: 1e-40}'; do
    printf 'integrators: taylor\nstep: 1\ntime: 2\n%s\nsystems: [./heavy.yaml]\n' "$key" >tiny.yaml
    try 2 study tiny.yaml --output tiny
    says 'tiny.yaml:5:11: ./heavy.yaml: tolerance: 1e-40 is below 5.4e-20, the smallest in this precision$'
done

case_is "a setting is given once"
table <<'END'
2 | run heavy.yaml --integrator rk4 --step 0.1 --time 1 --set m=1 --set m=2 | says ^dalembert: --set: m is given twice$
2 | run heavy.yaml --integrator rk4 --step 0.1 --time 1 --set m=1,m=2 | says 1,m=2
END
try 2 run heavy.yaml --integrator rk4 --step 0.1 --time 1 --start x=1 --start "x'=2" --start x=1
says '^dalembert: --start: x is given twice$'
try 2 order heavy.yaml --start x=1 --start x=2
says '^dalembert: --start: x is given twice$'
for keys in 'set: {m: 1, m: 2}' 'start: {x: 1, x: 2}' 'displace: {p_x: 1, p_x: 2}' \
    'options: {solver: newton, solver: auto}'; do
    name=${keys#*{}
    printf 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [{system: heavy.yaml, %s}]\n' "$keys" >twice.yaml
    try 2 study twice.yaml --output twice
    says "twice.yaml:4:[0-9]*: the key '${name%%:*}' comes twice"
done

case_is "tolerance: compiled, the same bytes"
if needs 3 "no compiler" there cc; then
    try 0 run knife-edge --integrator dop853 --step 5 --time 10 --samples 1 \
        --tolerance 1e-10 --native on --output native.csv
    silent
    expect "other bytes" cmp -s 1e-10.csv native.csv
    counted
fi

case_is "tolerance: without a step, which is a hundredth of the time then"
motion="knife-edge --integrator dop853 --tolerance 1e-9 --from 10 --time 3 --samples 9"
try 0 run $motion --output chosen
try 0 run $motion --step -0.07 --output given.npy
expect "other bytes" cmp -s chosen/trajectory.npy given.npy
expect "not in the manifest" grep -Eq '^    "step": -0.070*[0-9]?,$' chosen/manifest.json
try 0 resume chosen
printf 'coordinates: [x]\nlagrangian: x'"'"'^2/2\n' >free.yaml
try 2 run ./free.yaml --integrator dop853 --time 3
says "^dalembert: --step is missing"
for end in '--time 3' '--times 3'; do
    try 2 run ./free.yaml --integrator dop853 --tolerance 1e-9 --from 3 $end
    says "^dalembert: ${end% 3}: the run ends where it begins, at t = 3$"
done
try 2 run ./free.yaml --integrator dop853 --tolerance 1e-9 --times 5,3
says "^dalembert: --times: from t = 0, 3 does not come after 5$"
try 2 run ./free.yaml --integrator dop853 --tolerance 1e-9 --steps 9
says "^dalembert: --step is missing"
try 0 run ./free.yaml --integrator dop853 --tolerance 1e-9 --times 1,1.7,2 --output listed
expect "not a hundredth" grep -q '^    "step": 0.02,$' listed/manifest.json

# phi = 0.2 + t passes through 2 pi, ...
case_is "tolerance: a section without a step"
try 0 section knife-edge --on "sin(phi)" --direction up --integrator taylor --tolerance 1e-12 --time 20
expect "other times" awk -F, 'NR > 1 && !(($2 + 0.2 - (NR - 1)*8*atan2(1, 1))^2 < 1e-26) { exit 1 }
    END { exit NR != 4 }' out

# The closed form of the knife edge is far from its rows by no more than the bound of the manual.
case_is "tolerance: rows within a step, which they do not change"
for integrator in dop853 taylor; do
    motion="knife-edge --integrator $integrator --tolerance 1e-9 --step 10 --time 20"
    try 0 run $motion --samples 200 --native off --output within-off.csv
    silent
    if needs 3 "no compiler" there cc; then
        try 0 run $motion --samples 200 --native on --output within-on.csv
        silent
        expect "other bytes compiled" cmp -s within-off.csv within-on.csv
        counted
    fi
    expect "rows beyond their bound" awk -F, 'NR > 1 && !($NF < 2e-8 * (1 + $1)) { exit 1 }' within-off.csv
    try 0 run $motion --samples 2 --output alone.csv
    sed -n '1p; 2p; 102p; 202p' within-off.csv >ends.csv
    expect "rows change the trajectory" cmp -s ends.csv alone.csv
done

case_is "tolerance: resumed"
motion="knife-edge --integrator dop853 --tolerance 1e-9 --step 0.7 --time 10 --samples 9"
try 0 run $motion --output whole.npy
try 0 run $motion --output divided
try 0 resume divided
expect "not kept in the manifest" grep -q '^    "tolerance": 1e-9,$' divided/manifest.json
expect "other bytes" cmp -s whole.npy divided/trajectory.npy

case_is "tolerance: refused with the reason"
table <<'END'
2 | run knife-edge --integrator rk4 --step 0.1 --time 1 --tolerance 1e-6 | says rk4 has no control of its step size
2 | run knife-edge --integrator dop853+lift --step 0.1 --time 1 --tolerance 1e-6 | says dop853.lift has no control of its step size
END
try 2 run knife-edge --integrator dop853 --step 0.1 --time 1 --tolerance -1
says "^dalembert: --tolerance: -1 is not a number from 0 to 1"

case_is "tolerance: listed and explained"
try 0 list integrators
expect "not listed" grep -q '^dop853 .*adaptive' out
