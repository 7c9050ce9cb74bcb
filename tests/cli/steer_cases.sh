# `dalembert steer`: the cheapest motion between two states, against closed forms.

cat >unstable.yaml <<'YAML'
coordinates: [x]
parameters: {w: 1, k: 1}
accelerations: {x: w^2*x - k^2*x'}
start: {x: 1}
YAML
cat >sleigh.yaml <<'YAML'
coordinates: [x, y, phi]
parameters: {m: 1.3, I: 0.7}
lagrangian: m/2*(x'^2 + y'^2) + I/2*phi'^2
constraints: [x'*sin(phi) - y'*cos(phi)]
YAML
sleigh="sleigh.yaml --rest --effort constraint --integrator gauss8 --step 0.02 --time 2"

case_is "an unstable oscillator, by its Gramian"
try 0 steer unstable.yaml --to x=0 --rest --time 1.5 --integrator gauss8 --step 0.015 --json
says '^dalembert: 2 of the 2 numbers of an end can be reached$'
expect "the cost, the end and the request" json out "
    d['schema'] == 'dalembert/steer/1' and d['state'] == 'done' and d['allowed_rank'] == 2 and d['growth'] == []
    and len(d['motions']) == 1 and abs(d['motions'][0]['S'] - 3.744703461964342) < 1e-12
    and d['motions'][0]['start'][:2] == [1, 0] and max(map(abs, d['motions'][0]['end'][:2])) < 1e-14
    and d['names'] == ['x', \"x'\", 'e', 'p_x', 'pi_x', 'pi_e']
    and abs(d['motions'][0]['end'][5] - d['motions'][0]['S']) < 1e-14
    and d['request']['target'] == {'x': 0} and d['request']['rest'] and d['from'] == 0 and d['to'] == 1.5"
try 0 steer unstable.yaml --to x=0 --rest --time 1.5 --integrator gauss8 --step 0.015
prints '^unstable.yaml reaches the target at t = 1.5 for S = 3.7447$'
prints '^Momenta change 2 of the 2 numbers of the end$'
prints '^No conjugate time: '
prints "^  x' +0 +[^ ]+ +0$"

case_is "a sleigh straight and turned"
try 0 steer $sleigh --to x=0.5,y=0,phi=0 --json
expect "6 m d^2/T^3" json out "abs(d['motions'][0]['S'] - 6*1.3*0.5**2/8) < 1e-12"
try 0 steer $sleigh --to "x=0,y=0,phi=atan2(1,0)" --json
says '^dalembert: D has the growth vector \(2, 3\): 5 of the 6 numbers of an end can be reached, all that D = 0 leaves$'
expect "6 I theta^2/T^3" json out "
    abs(d['motions'][0]['S'] - 6*0.7*(3.141592653589793/2)**2/8) < 1e-12
    and d['growth'] == [2, 3] and d['allowed_rank'] == 5
    and d['request']['target']['phi'] == 1.5707963267948966"

case_is "other ends"
try 0 steer unstable.yaml --to x=0 --time 1.5 --free "x'" --integrator gauss4 --step 0.05 --json
expect "nothing to be paid: free velocities at both ends" json out "
    abs(d['motions'][0]['S']) < 1e-20 and d['request']['free'] == \"x'\"
    and d['motions'][0]['conjugate_times'] is None"
try 0 steer sleigh.yaml --to "x=cos(pi/6),y=sin(pi/6)" --aim --time 2 --integrator gauss8 --step 0.02 --json
expect "a circle whose tangent is along x: twice the angle of the chord" json out "
    abs(d['motions'][0]['end'][2] - 3.141592653589793/3) < 1e-10 and d['motions'][0]['S'] == 0
    and d['allowed_rank'] is None and d['motions'][0]['rank'] is None and len(d['names']) == 6"
refute "a note on momenta" grep -q 'can be reached' err

case_is "vakonomic motion"
cat >dido.yaml <<'YAML'
coordinates: [x, y, z]
lagrangian: (x'^2 + y'^2)/2
constraints: [z' - (x*y' - y*x')/2]
mechanics: vakonomic
YAML
try 0 steer dido.yaml --to x=0,y=0,z=1 --integrator gauss8 --step 0.02 --time 2 --starts 4 --output dido
prints '^dido.yaml reaches the target at t = 2 for S = 3.14159$'
refute "a note on momenta" grep -q 'can be reached' err
expect "a circle around the area 1: 2 pi/T" json dido/steer.json "
    abs(d['motions'][0]['S'] - 3.141592653589793) < 1e-10 and len(d['names']) == 7"

case_is "several motions, the cheapest first"
try 0 steer sleigh.yaml --rest --effort constraint --integrator gauss4 --step 0.08 --time 2 --to x=0,y=1,phi=0 \
    --starts 6 --json
expect "an order of S" json out "
    len([m for m in d['motions'] if m['status'] == 'DAL_OK']) > 1
    and [m['S'] for m in d['motions'] if m['status'] == 'DAL_OK'] == sorted(
        m['S'] for m in d['motions'] if m['status'] == 'DAL_OK')
    and d['request']['starts'] == 6 and d['request']['seed'] == 1"

case_is "a directory"
cat >cart.yaml <<'YAML'
coordinates: [x]
parameters: {m: 2}
lagrangian: m/2*x'^2
controls: [{x: 1}]
YAML
# x'' = u/m from 0 to 1 at rest in T = 1: u = 6 m (1 - 2 t), S = 6 m^2
cart="cart.yaml --to x=1 --rest --effort controls --integrator gauss4 --step 0.125 --time 1"
try 0 steer $cart --samples 8 --output cart --json
says "^dalembert: wrote the directory 'cart'$"
expect "steer.json is what is printed" cmp out cart/steer.json
expect "the cost of forces" json out "abs(d['motions'][0]['S'] - 24) < 1e-11"
expect "a run of 9 rows" has_rows cart/trajectory.npy 9
expect "the momenta at its start" json cart/manifest.json "
    abs(d['input']['start']['pi_x'] - 24) < 1e-10 and d['input']['start']['x'] == 0
    and d['input']['effort'] == 'controls' and d['status'] == 'done'"
expect "u = 12 - 24 t at each step" awk -F, 'NR == 1 { if ($0 != "t,u1") exit 1; next }
    { d = $2 - 12 + 24*$1; if (d*d > 1e-20) exit 1 } END { if (NR != 10) exit 1 }' cart/inputs.csv
try 0 resume cart
says "^dalembert: 'cart' is finished: 9 rows$"
try 2 steer $cart --output cart
says "^dalembert: 'cart/manifest.json' exists already: "
try 0 steer $cart --output cart --force
prints '^Page: +dalembert report cart$'
eval "try 0 $(sed '1,/^Again:/d; s/^ *dalembert//' out | tr -d '\\\\\n') --output again.csv --columns q,v"
expect "the controlled system ends at the target" awk -F, 'END { exit !(($2 - 1)^2 + $3^2 < 1e-24) }' again.csv

case_is "a page"
try 0 report cart
prints '^cart/report/index.html$'
page=cart/report/index.html
expect "it begins with what was found" awk '/<h1/ { seen = 1; next } seen && /<p>/ { print; exit }' $page
expect "S, the target and how far" grep -Eq \
    '<p><strong>Reaches the target at t = 1 for S = (24|23.999999[0-9]*|24.0000000), within [0-9.e-]+\.</strong>' $page
expect "a row of the motion" grep -q '<td>motion</td><th>S</th><th>distance</th>' $page
expect "the curve of u in its figure" awk -F, '$1 == 0.25 && ($2 - 6)^2 < 1e-12 { found = 1 }
    END { exit !found }' cart/report/inputs.gp
expect "the state of the run" grep -q 'cart.yaml by gauss4\|system.yaml by gauss4' $page
mkdir torn
echo '{"schema": "dalembert/steer/1", "request": {}}' >torn/steer.json
try 0 report torn
expect "no motion" grep -q '<strong>Is not led to the target' torn/report/index.html
printf '{' >torn/steer.json
try 2 report torn
says 'torn/steer.json'
cp -R cart nameless
sed '1s/^t,/u,/' cart/inputs.csv >nameless/inputs.csv
try 2 report nameless
says "^dalembert: nameless/inputs.csv: there is no column 't'"

case_is "a controlled system that turns"
cat >robot.yaml <<'YAML'
coordinates: [x, y, theta, psi]
lagrangian: (x'^2 + y'^2 + theta'^2 + 3*psi'^2)/2 - 10*sin(psi)
constraints: [x' - cos(theta)*psi', y' - sin(theta)*psi']
controls: [{theta: 1}, {psi: 1}]
YAML
try 3 steer "$(cd "$here/../.." && pwd)/examples/actuated-snakeboard.yaml" --to x=2 --rest --effort controls --max-iterations 1
says '^dalembert: D has the growth vector \(3, 4, 5\): controls change 8 of the 10 numbers of an end, about generic motions, all that D = 0 leaves$'
sed 's/theta: 1}, {//' robot.yaml >straight.yaml
try 3 steer straight.yaml --to x=1,y=1,theta=1 --rest --effort controls --integrator gauss4 --step 0.1 --time 2 --max-iterations 2
says ': controls change 4 of the 8 numbers of an end, about generic motions, on one leaf alone$'
says ': only 4 of 8 numbers of the end can be reached; '
for step in 0.1 0.05; do
    try 0 steer robot.yaml --to x=1,y=0.5,theta=0.5 --rest --effort controls --integrator gauss8 --step $step --time 2 \
        --output robot --force
    eval "try 0 run robot/controlled.yaml --integrator gauss8 --step $step --time 2 --columns q,v --output again.csv"
    awk -F, 'END { printf "%.17g %.17g\n", $2 - 1, $3 - 0.5 }' again.csv >>ends
done
expect "the error of the splines of u falls like h^4: $(tr '\n' ' ' <ends)" awk '
    { d[NR] = sqrt($1^2 + $2^2) } END { exit !(d[1] < 1e-4 && d[2] < d[1]/12) }' ends
cat >>robot.yaml <<'YAML'
forces: {psi: 0.1}
YAML
try 0 steer robot.yaml --to x=1,theta=0 --rest --effort controls --integrator gauss8 --step 0.1 --time 2 --output robot --force
says "^dalembert: no controlled.yaml: .*'forces'"
refute "a file of the last search" test -e robot/controlled.yaml

case_is "accelerations, and several motions"
try 0 steer $sleigh --to x=0.5,y=0,phi=0 --step 0.1 --output straight --samples 20
expect "Kpi/e along x, 6 d/T^2 (1 - 2 t/T)" awk -F, 'NR == 1 { if ($0 != "t,a_x,a_y,a_phi") exit 1; next }
    { d = $2 - 0.75*(1 - $1); if (d*d + $3*$3 + $4*$4 > 1e-20) exit 1 }' straight/inputs.csv
refute "a controlled system without controls" test -e straight/controlled.yaml
try 0 steer sleigh.yaml --rest --effort constraint --integrator gauss4 --step 0.08 --time 2 --to x=0,y=1,phi=0 \
    --starts 6 --output many
expect "a run of the second motion" has_rows many/motion-2/trajectory.npy 101
try 0 steer sleigh.yaml --to "x=cos(pi/6),y=sin(pi/6)" --aim --time 2 --integrator gauss8 --step 0.02 --output aimed
expect "a run on (q, v)" json aimed/manifest.json "d['input']['space'] == 'physical' and len(d['input']['start']) == 6"
refute "inputs of a natural motion" test -e aimed/inputs.csv

# x'' = 4x^3 is infinite before t = 1 of whatever is at rest at x = 1.
case_is "a motion that no step follows to the end"
printf "coordinates: [x]\nlagrangian: x'^2/2 + x^4\nstart: {x: 1}\n" >falls.yaml
falls="steer falls.yaml --to x=2 --rest --time 30 --step 0.1 --integrator gauss8"
try 3 $falls --output nowhere
says 'falls.yaml: no motion was found in [0-9]+ iterations: along the nearest a step fails; a shorter time, '
prints '^falls.yaml is not led to t = 30: along the nearest motion a step fails$'
prints "^  x' +0 +- +0\$"
expect "numbers after the failure" awk -F, 'NR == 2 && $2 != 1 { exit 1 } END { exit !($2 == "nan" && NR == 302) }' nowhere/best.csv
try 0 report nowhere
expect "no distance on its page" grep -q '<strong>Is not led to the target\.</strong> no motion was found in ' \
    nowhere/report/index.html
try 3 $falls --json
expect "nor in JSON" json out "[d['motions'][0][x] for x in ('S', 'distance', 'residual', 'max_D')] == [None]*4"

case_is "what is not reached"
try 3 steer $sleigh --to x=0,y=1,phi=0 --max-iterations 3
says '^dalembert: sleigh.yaml: no motion was found in 3 iterations: jumps of '
prints '^sleigh.yaml is [^ ]+ from the target at t = 2; jumps of '
prints '^  not reached '
try 3 steer $sleigh --to x=0,y=1,phi=0 --max-iterations 3 --json
expect "how far it is" json out "
    d['state'] == 'failed' and d['motions'][0]['status'] == 'DAL_NOT_CONVERGED' and d['motions'][0]['iterations'] == 3
    and 1e-6 < d['motions'][0]['distance'] <= 1 and d['motions'][0]['residual'] < 10
    and d['motions'][0]['message'].startswith('no motion')"

try 3 steer $sleigh --to x=0,y=1,phi=0 --max-iterations 3 --output straight --force
expect "the nearest motion" test "$(wc -l <straight/best.csv)" = 102
refute "the run before" test -e straight/trajectory.npy
expect "how far it is" json straight/steer.json "d['state'] == 'failed'"
try 0 report straight
expect "the same on a page" grep -q '<strong>Ends [0-9.e-]* from the target\.</strong> no motion was found in 3 iter' \
    straight/report/index.html
try 0 steer $sleigh --to x=0.5,y=0,phi=0 --output straight
refute "the failure before" test -e straight/best.csv

case_is "an interruption"
if needs 5 "no python3" there python3; then
    # More first guesses than any machine tries in the time until the signal.
    "$program" steer $sleigh --to x=0,y=1,phi=0 --starts 10000 --json >out 2>err &
    searching=$!
    expect "it does not catch signals" ready $searching
    ends_by INT 130 $searching
    says '^dalembert: interrupted; '
    expect "what there is" json out "d['state'] == 'interrupted' and d['request']['starts'] == 10000"
    counted
fi

case_is "refused"
cat >circle.yaml <<'YAML'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2
holonomic: [x^2 + y^2 - 1]
start: {y: 1}
YAML
cat >leaves.yaml <<'YAML'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2
constraints: [x' - y']
YAML
table <<'ROWS'
2 | steer $sleigh --to "x=1,y'=0.4" | says the target is off D = 0 by -0.4: every motion keeps constraint 1, so that it cannot
2 | steer leaves.yaml --to x=1,y=2 --rest --effort constraint --integrator gauss4 --step 0.1 --time 1 | says leaves.yaml: the target is on another leaf of D = 0: every motion keeps x - y, which is 0 at the start and -1 at the target
2 | steer $sleigh --to x=1,z=2 | says 'z' is no coordinate or velocity
2 | steer $sleigh --to x=1,x=2 | says --to: x is given twice
2 | steer $sleigh --to x | says --to: 'x' is not NAME=VALUE
2 | steer $sleigh --to x=pi/q | says x=pi/q: 'pi/q' is not a number
2 | steer $sleigh --to x=1 --free z | says 'z' is no coordinate or velocity
2 | steer sleigh.yaml --integrator gauss8 --step 0.02 --time 2 | says there is no target
2 | steer $sleigh --to x=1 --starts 0 | says --starts: 0 is not in 1..10000
2 | steer $sleigh --to x=1 --tolerance 1e-9 | says unknown option '--tolerance'
2 | steer $sleigh --to x=1 --json --format csv | says --format
2 | steer sleigh.yaml --to x=1 --integrator gauss8+project --step 0.02 --time 2 | says no steering by gauss8\+project: .*; take gauss8$
2 | steer circle.yaml --to x=0 --rest --integrator gauss4 --step 0.1 --time 1 | says no steering by gauss4\+project: .*; take gauss4 with the option bare$
2 | steer sleigh.yaml --to x=1 --integrator dla --step 0.02 --time 2 | says no steering by dla: .*; take gauss8$
2 | steer sleigh.yaml --to x=1 --integrator gauss8 --step 0.03 --time 2 | says no whole number of steps
2 | steer sleigh.yaml --to x=1 --integrator gauss8 --step 0.02 --time 2 --effort controls | says the system has none
2 | steer dido.yaml --to x=1,z=0 --rest --integrator gauss8 --step 0.02 --time 2 | says there is no rest
2 | steer | says SYSTEM
ROWS
