# `dalembert predict`: the drift of D, E and invariants before a run.

case_is "a curve, against a run"
try 0 predict pendulum-cvt --integrator rk4 --step 0.05 --time 200
prints '^rk4, h = 0.05: leaves D = 0$'
prints '^  E  *-1.37e-5 '
prints '^  driver '
try 0 predict pendulum-cvt --integrator rk4 --step 0.05 --time 200 --samples 4 --json
expect "E at the end, by an independent program" json out "
    d['schema'] == 'dalembert/predict/1' and len(d['predictions']) == 1
    and [o['name'] for o in d['predictions'][0]['observables']][:2] == ['D1', 'E']
    and abs(d['predictions'][0]['observables'][1]['change'] + 1.36639e-5) < 1e-10
    and d['predictions'][0]['t'] == [0, 50, 100, 150, 200]
    and d['predictions'][0]['observables'][1]['curve'][-1] == d['predictions'][0]['observables'][1]['change']
    and d['predictions'][0]['end_reason'] == 'time' and d['predictions'][0]['leaves_D']"

case_is "methods and steps"
try 0 predict heisenberg --integrator rk4,gni,implicit-midpoint --step 0.1,0.05 --time 10 --output curves.csv
prints '^rk4, h = 0.1: leaves D = 0$'
prints '^gni, h = 0.05: no drift of gni can be predicted: its multipliers pass from step'
expect "a column for each quantity" grep -q '^integrator,step,t,predicted_D1,predicted_E$' curves.csv
expect "the rows of each" test "$(grep -c '^implicit-midpoint,0.05,' curves.csv)" = 201
try 0 predict heisenberg --integrator rk4 --step 0.05 --time 1 --samples 2 --output -
prints '^rk4,0.05,0,0,0$'
expect "nothing else" test "$(wc -l <out)" = 4

case_is "zero by reversibility"
try 0 predict nonholonomic-particle --integrator implicit-midpoint --step 0.05 --time 20
prints '^  E .* 0 by reversibility$'

case_is "in phase"
try 0 predict pendulum-cvt --integrator mclachlan-perlmutter,gauss4+project --step 0.05 --time 40
prints '^What oscillates is in phase with the run, within 1 %, to t = '
try 0 predict pendulum-cvt --integrator mclachlan-perlmutter,gauss4+project --step 0.05 --time 40 --json
expect "a time, and none" json out "
    1 < d['predictions'][0]['in_phase'] < 40 and d['predictions'][1]['in_phase'] is None"

case_is "pieces"
try 0 predict chaotic-oscillators --integrator mclachlan-perlmutter --step 0.1 --time 2 --pieces 8 --json
expect "a walk" json out "
    d['predictions'][0]['pieces'] == 8 and d['request']['pieces'] == 8"
mv out pieces.json
try 0 predict chaotic-oscillators --integrator mclachlan-perlmutter --step 0.1 --time 16 --samples 16 --json
if needs 1 "no python3" there python3; then
    python3 -c "
import json, statistics
one, all = [json.load(open(f))['predictions'][0]['observables'][1] for f in ('pieces.json', 'out')]
c = all['curve']
S = [c[i + 2] - c[i] for i in range(0, 16, 2)]
halves = [c[i + 1] - c[i] for i in range(16)]
V, W = statistics.variance(S), statistics.variance(halves)
walk, margin = V - W, ((V * V + W * W + (V / 2 - W) ** 2) / 8) ** .5
print(abs(one['walk'] / walk - 1) < 1e-6 and abs(one['walk_margin'] / margin - 1) < 1e-6
      and abs(one['rate'] / (sum(S) / 16) - 1) < 1e-6)" >same 2>&1
    expect "s^2 of one long curve: $(cat same)" grep -q '^True$' same
    counted
fi

case_is "other starts and parameters"
try 0 predict heisenberg --integrator rk4 --step 0.05 --set ky=3 --start z=0.1 --from 1 --time 2 --json
expect "the times" json out "d['from'] == 1 and d['predictions'][0]['t'][0] == 1 and d['predictions'][0]['end'] == 2"
try 0 predict heisenberg --integrator rk4 --step 0.05 --time 1 --observe "x*y"
prints '^  x\*y .* the motion changes it$'

case_is "refused"
table <<'END'
2 | predict heisenberg --integrator gni --step 0.05 --time 1 | says no drift of gni can be predicted: its multipliers
2 | predict heisenberg --integrator rk4 --step 0.05 --time 1 --start p_x=1 | says p and pi are not 0
2 | predict spherical-pendulum --integrator gauss4 --step 0.05 --time 1 | says the system has holonomic constraints
2 | predict chaplygin-sleigh-vakonomic --integrator gauss4 --step 0.05 --time 1 | says the motion is vakonomic
2 | predict heisenberg --integrator rk4 --step 0.05 --time 0.97 | says no whole number of steps
2 | predict heisenberg --integrator dop853 --step 0.05 --time 1 --tolerance 1e-9 | says a tolerance
2 | predict heisenberg --integrator rk4,rk5 --step 0.05 --time 1 | says rk5
2 | predict heisenberg --integrator rk4 --step 0.05,x --time 1 | says --step
2 | predict heisenberg --integrator rk4 --step 0.05 --time 1 --json --output - | says both write to standard output
2 | predict chaplygin-sleigh-friction --integrator rk4 --step 0.02 --time 20 | says attractor
2 | predict | says SYSTEM
END
