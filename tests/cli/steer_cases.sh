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

case_is "several motions, the cheapest first"
try 0 steer sleigh.yaml --rest --effort constraint --integrator gauss4 --step 0.08 --time 2 --to x=0,y=1,phi=0 \
    --starts 6 --json
expect "an order of S" json out "
    len([m for m in d['motions'] if m['status'] == 'DAL_OK']) > 1
    and [m['S'] for m in d['motions'] if m['status'] == 'DAL_OK'] == sorted(
        m['S'] for m in d['motions'] if m['status'] == 'DAL_OK')
    and d['request']['starts'] == 6 and d['request']['seed'] == 1"

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

case_is "an interruption"
if needs 5 "no python3" there python3; then
    # Shorter steps than any machine takes in the time until the signal.
    "$program" steer $sleigh --to x=0,y=1,phi=0 --step 1e-6 --json >out 2>err &
    searching=$!
    expect "it does not catch signals" ready $searching
    ends_by INT 130 $searching
    says '^dalembert: interrupted; '
    expect "what there is" json out "d['state'] == 'interrupted' and d['request']['step'] == 1e-6"
    counted
fi

case_is "refused"
table <<'ROWS'
2 | steer $sleigh --to "x=1,y'=0.4" | says the target is off D = 0 by -0.4: every motion keeps constraint 1, so that it cannot
2 | steer $sleigh --to x=1,z=2 | says 'z' is no coordinate or velocity
2 | steer $sleigh --to x=1,x=2 | says --to: x is given twice
2 | steer $sleigh --to x | says --to: 'x' is not NAME=VALUE
2 | steer $sleigh --to x=pi/q | says x=pi/q: 'pi/q' is not a number
2 | steer $sleigh --to x=1 --free z | says 'z' is no coordinate or velocity
2 | steer sleigh.yaml --integrator gauss8 --step 0.02 --time 2 | says there is no target
2 | steer $sleigh --to x=1 --starts 0 | says --starts: 0 is not in 1..10000
2 | steer $sleigh --to x=1 --tolerance 1e-9 | says unknown option '--tolerance'
2 | steer $sleigh --to x=1 --json --format csv | says --format
2 | steer sleigh.yaml --to x=1 --integrator gauss8+project --step 0.02 --time 2 | says no steering by gauss8\+project
2 | steer sleigh.yaml --to x=1 --integrator gauss8 --step 0.03 --time 2 | says no whole number of steps
2 | steer sleigh.yaml --to x=1 --integrator gauss8 --step 0.02 --time 2 --effort controls | says the system has none
2 | steer chaplygin-sleigh-vakonomic --to y1=1 --rest --integrator gauss8 --step 0.02 --time 2 | says the ends of vakonomic motion are in q alone: there is no rest
2 | steer | says SYSTEM
ROWS
