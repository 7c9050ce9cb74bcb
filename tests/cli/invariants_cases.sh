# `dalembert invariants`: what a motion conserves, from its formulas.

case_is "a block for a system file"
try 0 invariants nonholonomic-particle --measure
silent
prints "^# nonholonomic-particle: 2 invariants, 2 independent$"
prints "^# sums of 20 products of degree 1 to 2 of x, y, x', y', z'; 19 functions on D = 0$"
prints '^# singular values that count as 0: at most [0-9.]+e-[0-9]+; the others: at least 0\.0[0-9]+$'
prints "^  I1: kappa\*y\^2 \+ y'\^2  # known, exact, any parameters$"
prints "^# measure: rho\^\(2\) = 1 \+ y\^2, exact, any parameters$"
cat >pair.yaml <<'END_OF_PAIR'
coordinates: [x, y]
parameters: {k: 3, c: 3, I1: 2}
lagrangian: (x'^2 + y'^2)/2 - k/2*x^2 - c/2*y^2
start: {x: 1, y': 1}
END_OF_PAIR
try 0 invariants pair.yaml
prints "^  I2: "
refute "a name that is a parameter's" grep -q '^  I1: ' out
cat pair.yaml out >whole.yaml
try 0 check whole.yaml
try 0 run whole.yaml --integrator gauss4 --step 0.1 --time 5 --columns invariants
prints '^t,I2,I3'

case_is "none is found"
try 1 invariants suslov
silent
prints '^# suslov: 0 invariants, 0 independent$'
refute "a block" grep -q '^invariants' out
try 1 invariants suslov --degree 1 --measure --json
expect "members" json out "d['invariants'] == [] and d['independent'] == 0 and d['largest_zero'] is None"

case_is "parameters and further factors"
try 0 invariants pair.yaml --json
expect "four at equal frequencies" json out "d['schema'] == 'dalembert/invariants/1' and d['degree'] == 2
    and len(d['invariants']) == 4 and d['independent'] == 3 and d['measures'] is None
    and [i['any_parameters'] for i in d['invariants'] if i['formula'] == \"x*y' - y*x'\"] == [False]
    and d['largest_zero'] < 1e-12 < 1e-4 < d['least_change'] and d['atoms'] == ['x', 'y', \"x'\", \"y'\"]"
try 0 invariants pair.yaml --set c=3.5 --json
expect "two at others" json out "{i['formula'] for i in d['invariants']} == {\"k*x^2 + x'^2\", \"c*y^2 + y'^2\"}
    and all(i['exact'] and i['any_parameters'] for i in d['invariants'])
    and [i['new'] for i in d['invariants']] == [True, False] and d['request']['parameters']['c'] == 3.5"
try 0 invariants knife-edge --with "x, hypot(x, y)" --json
expect "factors" json out "'x' in d['atoms'] and 'hypot(x, y)' in d['atoms']"

case_is "what is refused"
table <<'END_OF_TABLE'
2 | invariants | says SYSTEM is missing
2 | invariants knife-edge --degree 0 | says --degree
2 | invariants knife-edge --degree 9 | says --degree
2 | invariants knife-edge --with x,nope | says --with, formula 2:1:1: unknown name 'nope'
2 | invariants knife-edge --with x, | says --with, formula 2
2 | invariants knife-edge --set nope=1 | says unknown parameter 'nope'
2 | invariants chaotic-oscillators --degree 5 | says 14 atoms have 11627 products
2 | invariants chaplygin-sleigh-vakonomic --measure | says no measure is sought
END_OF_TABLE

case_is "check proposes what the file does not have"
try 0 check pair.yaml
prints '^  further invariants +info +2 of degree 2; see'
prints "^  proposed invariant I2 +info +k\*x\^2 \+ x'\^2$"
prints "^  proposed invariant I3 +info +.*[xy].*[xy]"
try 0 check whole.yaml
prints '^  further invariants +info +none of degree 2$'
try 0 check chaotic-oscillators --json
expect "a proposal" json out "[i['text'] for i in d['items'] if i['item'] == 'further invariants'] == ['none of degree 2']
    and not [i for i in d['items'] if i['item'].startswith('proposed')]"

case_is "a run observes them"
motion="--integrator gauss4 --step 0.1 --time 2 --samples 2"
try 0 run pair.yaml $motion --invariants auto --observe "x + y" --columns observed -o -
says "^dalembert: pair.yaml conserves k\*x\^2 \+ x'\^2; "
prints "^t,x \+ y,k\*x\^2 \+ x'\^2,"
expect "they are not conserved" awk -F, 'NR == 2 { x = $3; y = $4 } NR > 2 && (($3 - x)^2 > 1e-24 || ($4 - y)^2 > 1e-24) { exit 1 }
    END { exit NR != 4 }' out
try 0 run knife-edge-reaction $motion --invariants auto --columns observed -o -
prints "^t,\(phi'\)$"
try 0 run pair.yaml $motion --invariants auto -o observed
expect "the formulas are not in the manifest" json observed/manifest.json \
    "d['input']['observe'].startswith(\"k*x^2 + x'^2; \")"
try 2 run pair.yaml $motion --invariants given --columns observed -o -
says "no column 'observed'"
try 0 run whole.yaml $motion --invariants auto -o -
says '^dalembert: whole.yaml has no further invariants of degree 2$'
try 2 run pair.yaml $motion --invariants all
try 2 run pair.yaml $motion --invariants auto --set nope=1
printf "coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: log(-1 - x^2)}\n" >nowhere.yaml
try 2 run nowhere.yaml $motion --invariants auto -o -
alone '^dalembert: nowhere.yaml: there are no points of D = 0 near the start with a finite F$'
