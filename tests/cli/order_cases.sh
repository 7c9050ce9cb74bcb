# `dalembert order`: errors, orders and costs of many methods at once.

# The error of rk4 on v' = -v after N steps h, v(0) = 1, is |R(-h)^N - exp(-N h)|; x has the same.
case_is "errors in closed form"
try 0 order line.yaml --integrators rk4,gauss4 --steps 0.25,0.125,0.0625 --time 2 --output line.csv
silent
prints '^against the exact solution$'
prints '^rk4 +4 +4\.[01][0-9] '
prints '^gauss4 +4 +4\.0[0-9] .* [0-9.]+ +[0-9.]+$'
expect "other errors" awk -F, '
    $2 == "rk4" { h = $5; R = 1 - h + h^2/2 - h^3/6 + h^4/24; e = R^$6 - exp(-2)
        if ($6 != 2 / h || ($7 - e)^2 > (1e-9 * e)^2 || $9 != 4 * $6) exit 1
        if (before && ($8 - log(before / e) / log(2))^2 > 1e-12) exit 1
        if (!before && $8 != "") exit 1
        before = e; rows++ }
    END { exit rows != 3 }' line.csv
expect "other heads" test "$(head -1 line.csv)" = \
    "label,integrator,stated_order,observed_order,step,steps,error,slope,evaluations,seconds,state,message"

# A block that slides and turns round: sign(x') makes F jump; a square root of |x| makes its derivative.
case_is "what branches leave of the order"
printf "coordinates: [x]\nlagrangian: x'^2/2 - x^2/2\nforces: {x: -0.3*sign(x')}\nstart: {x: 1}\n" >slide.yaml
try 0 order slide.yaml --integrators rk4 --step 0.1 --levels 2 --time 2
prints '^branches, force on x: F jumps: order 1 across it$'
sed "s/sign(x')/sign(x)*sqrt(abs(x))/" slide.yaml >root.yaml
try 0 order root.yaml --integrators rk4 --step 0.1 --levels 2 --time 2
prints "^branches, force on x: F' jumps: order 2 across it$"
try 0 order line.yaml --integrators rk4 --step 0.25 --levels 2 --time 1
expect "branches of what has none" sh -c '! grep -q branches out'

case_is "a reference of its own where the exact solution begins elsewhere"
try 0 order line.yaml --integrators rk4 --start "x'=2" --step 0.25 --levels 3 --time 2
prints '^against gauss12 with h = 0\.03125, itself within [0-9]e-1[0-9]$'
prints '^rk4 +4 +4\.[01]'

# F is not finite within 0.03 of t = 0.25: no stage of gauss12 is there with h = 0.5, one of h = 0.25 at 0.2415.
case_is "a reference that fails"
printf '%s\n' 'coordinates: [x]' 'accelerations: {x: sqrt((t - 0.25)^2 - 0.0009)}' >window.yaml
try 3 order window.yaml --integrators gauss4 --steps 1,0.5 --time 1
alone '^dalembert: reference: a value is not finite in the step of 0\.25 from t = 0$'
# x' = -sqrt(-2 log(x)) reaches 0 at t = sqrt(pi/2) = 1.2533.
printf '%s\n' 'coordinates: [x]' 'accelerations: {x: -1/abs(x)}' 'start: {x: 1}' >fall.yaml
try 3 order fall.yaml --integrators dop853 --tolerances 1e-4,1e-6 --time 4
alone '^dalembert: reference: .* at t = 1\.2533'
printf '%s\n' 'coordinates: [x]' 'accelerations: {x: -abs(x)}' 'start: {x: 1}' >kink.yaml
try 0 order kink.yaml --integrators dop853 --tolerances 1e-4,1e-6 --time 1
prints '^against dop853 with tolerance = 1e-08, '

case_is "modifiers, refusals and failures"
try 0 order chaplygin-sleigh --integrators gauss4+project,isokinetic-splitting --time 1 --output few.csv
prints '^gauss4\+project +4 +[34]\.[09]'
prints '^isokinetic-splitting: refused: .* has no isokinetic constraint'
expect "no row of the refused" grep -Eq '^chaplygin-sleigh,isokinetic-splitting,2,,,,,,,,refused,' few.csv
try 3 order pursuit --integrators rk4 --steps 0.5,0.25 --time 100
try 2 order chaplygin-sleigh-vakonomic --integrators rk4 --time 1 --space lifted --start p_x=1
cat >stiff.yaml <<'END'
coordinates: [x]
accelerations: {x: 0.001*sqrt(4 - x'^2) - 10*x'}
start: {x': 1}
END
try 3 order stiff.yaml --integrators symplectic-euler-00,gauss4 --steps 1,0.05 --time 2
prints '^symplectic-euler-00 +1 +- +- [0-9]'
prints '^symplectic-euler-00: failed: '

case_is "all methods, any number of threads"
try 0 order chaplygin-sleigh --time 1 --threads 1 --output one.csv
expect "fewer than 25 methods" test "$(cut -d, -f2 one.csv | sort -u | wc -l)" -ge 26
try 0 order chaplygin-sleigh --time 1 --threads 2 --output two.csv
cut -d, -f1-9,11- one.csv >one.cut
cut -d, -f1-9,11- two.csv >two.cut
expect "the numbers depend on threads" cmp one.cut two.cut

# Where an order is found it is the stated one; symplectic-euler-00 and -01, whose slopes there are
# 0.4 to 2.1, have none, nor has what reaches rounding in two steps.
case_is "no order outside the asymptotic range"
for system in falling-disk isokinetic-cluster; do
    expected=0
    [ $system = falling-disk ] && expected=3
    try $expected order $system --step 0.1 --time 10 --output range.csv
    expect "$system: another order" awk -F, 'NR > 1 && $4 != "" { if (($4 - $3)^2 > 0.15^2) exit 1
        found[$2] } END { n = 0; for (m in found) n++; exit n < 15 }' range.csv
    expect "$system: an order of symplectic-euler" test -z "$(
        awk -F, '$2 ~ /^symplectic-euler-0/ { print $4 }' range.csv | tr -d '\n')"
    expect "$system: an order of rounding" grep -q "^$system,gauss12,12,,0.1" range.csv
done
prints '^symplectic-euler-01 +1 +coarse +[0-9]'
prints '^no order found, coarse: the last two slopes do not agree'
printf "coordinates: [x]\nlagrangian: x'^2/2 - x^2/2\nstart: {x': 1}\n" >swing.yaml
# gauss12 is at rounding with every one of these steps.
try 0 order swing.yaml --step 0.1 --time 10 --integrators gauss12,rk4
prints '^gauss12 +12 +rounding +[0-9]'
prints '^no order found, rounding: fewer than three errors lie above rounding '
expect "a reason of others" sh -c "! grep -q 'order found, coarse' out"
if needs 2 "no python3" there python3; then
    try 0 order swing.yaml --step 0.1 --time 10 --integrators gauss12,rk4 --json
    expect "other reasons in the JSON" json out "[m['no_order'] for m in d['methods']] == ['rounding', None]"
    counted
fi
try 0 order swing.yaml --step 0.1 --time 10 --levels 2 --integrators rk4
prints '^no order found, few: there are fewer than three steps'

# y begins at the value of its exact solution at t = 1, with the velocity that D has then.
case_is "orders from a later time, with velocities solved from D(q,v,t) = 0"
cat >driven.yaml <<'END'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2
constraints: ["y' - sin(t)"]
start: {x: 1, x': 1, y: 0.45969769413186023, solve: [y']}
exact: {x: t, y: 1 - cos(t)}
END
try 0 order driven.yaml --integrators rk4 --from 1 --time 3 --json
prints '"reference": \{"integrator": null'
prints '"observed_order": (4\.0|3\.9)'
try 0 order driven.yaml --integrators rk4 --time 3 --json
prints '"reference": \{"integrator": "gauss12"'
prints '"observed_order": (4\.0|3\.9)'

case_is "errors by tolerance"
try 0 order knife-edge --time 10 --tolerances 1e-4,1e-8 --output controlled.csv
prints '^against the exact solution$'
prints '^dop853 +8 +- '
expect "not the adaptive methods alone" test "$(column integrator controlled.csv | sort -u | tr '\n' ' ')" = \
    "dop853 taylor "
expect "not one step" test "$(column step controlled.csv | sort -u)" = 10
expect "errors far from the tolerance" awk -F, 'NR > 1 && !($8 > 1e-2*$6 && $8 < 1e2*$6) { exit 1 }' \
    controlled.csv
# The reference is another method, where there is no exact solution.
try 0 order falling-disk --integrators dop853,rk4 --time 10 --tolerances 1e-6,1e-9 --step 5 --json
prints '"reference": \{"integrator": "taylor", "step": 5, "tolerance": 1\.?0*1?e-11, "error": '
prints '"step": 5, "tolerance": 1e-09, "steps": 2, '
prints 'rk4 has no control of its step size'
# A table has no Taylor series.
printf '%s\n' t,f 0,0 1,2 >push.csv
printf '%s\n' 'coordinates: [x]' 'tables: {f: {file: push.csv, at: t, value: f}}' 'accelerations: {x: f(t)}' >push.yaml
try 0 order push.yaml --integrators dop853 --time 1 --tolerances 1e-4,1e-6 --json
prints '"reference": \{"integrator": "dop853", "step": 1, "tolerance": 1e-08, '
# An oscillator for 5,000 periods: more substeps than a step may have.
printf 'coordinates: [x]\nlagrangian: (x'"'"'^2 - x^2)/2\nstart: {x: 1}\nexact: {x: cos(t)}\n' >oscillator.yaml
try 0 order oscillator.yaml --integrators dop853 --time 31415 --tolerances 1e-8,1e-12 --output periods.csv
expect "a failure of what succeeded" test "$(column message periods.csv | tr -d '\n')" = ""
expect "T in parts" test "$(column steps periods.csv | sort -u)" = 1
expect "no error of T" awk -F, 'NR > 1 && !($8 < 31415*1e-8 && $10 > 1e5) { exit 1 }' periods.csv
table <<'END'
3 | order oscillator.yaml --integrators dop853 --time 31415 --tolerances 1e-8,1e-12 --step 31415 | prints ^dop853: failed: too many substeps
2 | order knife-edge --tolerances 1e-4 | says tolerances: a slope needs two tolerances
2 | order knife-edge --tolerances 1e-4,1e-3 | says tolerances: 1e-3 is not positive and below the one before
2 | order knife-edge --tolerances 1e-4,1e-6 --steps 0.1,0.05 | says tolerances excludes --steps and --tolerance
2 | order knife-edge --tolerances 10,1e-6 | says tolerances: 10 is larger than 1
2 | order line.yaml --tolerances 1e-1,1e-2,1e-3,1e-4,1e-5,1e-6,1e-7,1e-8,1e-9 --time 1 | says tolerances: more than 8
END

case_is "diagrams"
try 0 order line.yaml --integrators rk4,gauss4 --time 1 --output orders
for name in order work time; do
    expect "no $name.gp" grep -q '^plot' orders/report/$name.gp
    expect "rk4 is not in $name.gp" grep -q "title 'rk4'" orders/report/$name.gp
done
try 0 order knife-edge --time 10 --tolerances 1e-4,1e-8 --output by-tolerance
expect "no tolerance.gp" grep -q '^plot' by-tolerance/report/tolerance.gp
expect "an order without steps" test ! -e by-tolerance/report/order.gp
expect "no tolerances" grep -q '<th>h = 10, tolerance 1e-08</th>' by-tolerance/report/index.html
expect "diagrams that are drawn twice" test -z "$(find orders -maxdepth 1 -name '*.gp')"

case_is "orders: bad input"
table <<'END'
2 | order | says the SYSTEM is missing
2 | order line.yaml --integrators rk5 | says unknown integrator 'rk5'; did you mean 'rk4'
2 | order line.yaml --integrators rk4,,gauss4 | says is not a list between commas
2 | order line.yaml --steps 0.3,0.1 | says the time 10 is not a whole number of steps of 0.3
2 | order line.yaml --step 1e-300 --time 1 | says is not a whole number of steps of 1e-300
2 | order line.yaml --steps 0.1,0.2 | says steps: 0.2 is not positive and below the one before
2 | order line.yaml --steps 0.1 | says a slope needs two steps
2 | order line.yaml --levels 9 | says 9 is not in 2\.\.8
2 | order line.yaml --samples 3 | says unknown option
2 | order line.yaml plane.yaml | says only one SYSTEM
END

case_is "orders: files in the way"
mkdir -p files/order.json paged
touch file paged/report
small="order line.yaml --integrators rk4 --time 1 --force --output"
try 4 $small file/orders
says "^dalembert: cannot make the directory 'file/orders': Not a directory$"
expect "a second message" test "$(wc -l <err)" -eq 1
try 4 $small files
says "^dalembert: cannot write 'files/order.json': Is a directory$"
expect "a second message" test "$(wc -l <err)" -eq 1
try 4 $small paged
says "^dalembert: cannot make the directory 'paged/report': File exists$"
if needs 1 "no /dev/full" test -e /dev/full; then
    try 4 order line.yaml --integrators rk4 --time 1 --output /dev/full
    counted
fi
