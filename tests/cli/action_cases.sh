# `dalembert action`: the actions of curves, and what is wrong with a file.

value() { awk -v label="($1)" -v field="${2:-3}" '$1 == label { print $(NF - field + 1) }' out; }
below() { awk -v x="$1" -v max="$2" 'BEGIN { exit !(x != "" && x < max) }'; }

case_is "a motion, and a perturbed one"
try 0 run chaplygin-sleigh --integrator gauss8 --step 0.05 --time 5 --output run.csv
try 0 action chaplygin-sleigh run.csv --perturb 0.01
silent
prints '^chaplygin-sleigh on run\.csv: 101 rows, t = 0 to 5, h = 0\.05$'
prints '^gauss4 .* not stationary$'
expect "the action of a motion" below "$(value nh10)" 1e-6
expect "the action of a perturbed curve" below 1e-4 "$(value nh10 1)"
try 0 action chaplygin-sleigh run.csv --methods gauss8
prints '^gauss8 .* stationary$'
refute "gauss8 is not stationary at its own steps" grep -q 'not stationary' out

case_is "off the surface: the cost of the steering"
try 0 run chaplygin-sleigh --start pi_y1=0.1 --integrator gauss8 --step 0.1 --time 2 --samples 20 --output lifted.csv
cost=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "pi_e") k = i } END { print $k }' lifted.csv)
try 0 action chaplygin-sleigh lifted.csv
for form in nh11 nh23; do
    expect "$form: $(value $form 2), not $cost" awk -v x="$(value $form 2)" -v y="$cost" \
        'BEGIN { d = x / y - 1; exit !(d * d < 1e-4) }'
done

case_is "x' and vx, blanks, different distances"
try 0 run chaplygin-sleigh --integrator gauss8 --step 0.05 --time 5 --names plain --output plain.csv
try 0 action chaplygin-sleigh run.csv
cp out expected
try 0 action chaplygin-sleigh plain.csv
sed 's/plain\.csv/run.csv/' out >got
expect "other results" cmp -s expected got
printf 't,x\n' >bent.csv
awk 'BEGIN { for (k = 0; k < 9; k++) printf "%g , %g\n", k + k * k / 10, 3 }' >>bent.csv
printf 'coordinates: [x]\naccelerations: {x: a}\nparameters: {a: 0.5}\n' >pushed.yaml
# x at rest where x'' = a: a^2/2 T, T = 14.4
try 0 action pushed.yaml bent.csv
expect "$(value nh10 2)" [ "$(value nh10 2)" = 1.8 ]
prints '^No discrete actions: the file has no velocities\.$'
try 0 action pushed.yaml bent.csv --set a=0
expect "$(value nh10 2)" [ "$(value nh10 2)" = 0 ]

case_is "equations of one's own"
cat >drag.yaml <<'END'
coordinates: [x]
parameters: {m: 2, c: 1}
lagrangian: m*x'^2/2
forces: {x: -c*x'}
equations: [m*x'' + c*x']
END
try 0 run drag.yaml --start "x'=1" --integrator gauss8 --step 0.1 --time 4 --samples 40 --output drag.csv
try 0 action drag.yaml drag.csv
# S = m (x'' - F): m^2 = 4 times the action of x'' - F
expect "not 4 times the action of x'' - F" awk '/^\(nh8\)/ { a = $(NF - 1) } /^\(nh10\)/ { b = $(NF - 1) }
     END { exit !(b > 0 && a / b > 3.9 && a / b < 4.1) }' out
for name in z m; do
    sed "s/^equations: .*/equations: [$name'']/" drag.yaml >bad.yaml
    try 2 action bad.yaml drag.csv
    says '^dalembert: bad\.yaml:5:[0-9]+: '
done
sed "s/^forces: .*/forces: {x: -c*x''}/" drag.yaml >bad.yaml
try 2 action bad.yaml drag.csv
says "x'' is a second derivative; a formula knows only x and x'"

case_is "JSON"
if needs 2 "no python3" there python3; then
    try 0 action chaplygin-sleigh lifted.csv --json --perturb 0.1
    expect "the schema" json out "d['schema'] == 'dalembert/action/1' and d['request']['curve'] == 'lifted.csv'
        and d['step'] == 0.1 and d['rows'] == 21 and len(d['actions']) == 3
        and all(a['perturbed'] is not None for a in d['actions'])
        and [m['stationary'] for m in d['discrete_actions']] == [False] * 4"
    counted
fi

case_is "no column e"
try 0 action chaplygin-sleigh lifted.csv
refute "a note on e, which is there" grep -q "column e" err
sed "1s/,e,/,mass,/" lifted.csv >bad.csv
try 0 action chaplygin-sleigh bad.csv
says "^dalembert: bad\.csv: there is no column e: e = 1$"
try 0 action chaplygin-sleigh run.csv
refute "a note on e of a curve on p = pi = 0" grep -q "column e" err

case_is "files that are no curve"
edit() { sed "$1" run.csv >bad.csv; }
edit 's/^t,/u,/'
try 2 action chaplygin-sleigh bad.csv
says '^dalembert: bad\.csv: the column t is missing$'
edit 's/,phi,/,psi,/'
try 2 action chaplygin-sleigh bad.csv
says '^dalembert: bad\.csv: of the columns x there is none of the coordinate phi$'
edit "s/,y1',/,u1,/"
try 2 action chaplygin-sleigh bad.csv
says "^dalembert: bad\.csv: of the columns x' there is none of the coordinate y1$"
edit '5s/^[^,]*/0.1/'
try 2 action chaplygin-sleigh bad.csv
says '^dalembert: bad\.csv:5: t = 0\.1 does not come after 0\.1$'
edit '7s/,[^,]*/,abc/'
try 2 action chaplygin-sleigh bad.csv
says "^dalembert: bad\.csv:7: column y1: 'abc' is not a finite number$"
edit '7s/,[^,]*/,/'
try 2 action chaplygin-sleigh bad.csv
says "^dalembert: bad\.csv:7: column y1: '' is not a finite number$"
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "e") k = i } NR == 7 { $k = "abc" } 1' OFS=, lifted.csv >bad.csv
try 2 action chaplygin-sleigh bad.csv
alone "^dalembert: bad\.csv:7: column e: 'abc' is not a finite number$"
head -6 run.csv >bad.csv
try 2 action chaplygin-sleigh bad.csv
says '^dalembert: bad\.csv: a curve has 7 rows or more, not 5$'
: >bad.csv
try 2 action chaplygin-sleigh bad.csv
try 4 action chaplygin-sleigh nowhere.csv
printf 'coordinates: [x]\naccelerations: {x: log(x)}\n' >log.yaml
printf 't,x\n' >bad.csv
awk 'BEGIN { for (k = 0; k < 9; k++) print k "," 4.5 - k }' >>bad.csv
try 2 action log.yaml bad.csv
says '^dalembert: bad\.csv: the action is not determined at t = 4\.[0-9]*: '
# At rest where x'' = log(1); 1 - 2 sin^4(pi s) is below 0 about the middle.
awk 'BEGIN { print "t,x"; for (k = 0; k < 9; k++) print k ",1" }' >rest.csv
try 0 action log.yaml rest.csv --perturb 1
try 2 action log.yaml rest.csv --perturb -2
alone '^dalembert: rest\.csv: the action is not determined at t = [2-5]\.[0-9]*: '

case_is "what has no action"
table <<'END'
2 | action chaplygin-sleigh run.csv --mechanics vakonomic | says vakonomic motion has no F
2 | action chaplygin-sleigh run.csv --methods rk4 | says rk4 has no discrete action: it is not symplectic
2 | action chaplygin-sleigh run.csv --methods gauss5 | says gauss5
2 | action chaplygin-sleigh run.csv --perturb many | says --perturb
2 | action chaplygin-sleigh | says the CURVE.csv is missing; usage: dalembert action SYSTEM CURVE.csv
2 | action | says the SYSTEM is missing
2 | action chaplygin-sleigh run.csv more.csv | says only one CURVE.csv, not also
2 | action falling-disk run.csv | says of the columns x there is none
END
