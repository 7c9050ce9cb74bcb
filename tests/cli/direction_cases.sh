# Runs that begin at any time, go backwards, and end after a number of steps: --from, --step, --steps.

cat >forced.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2
forces: {x: cos(t)}
start: {x: 0.2, x': -0.3}
END
run="./forced.yaml --integrator gauss8"
rows_at() { cut -d, -f1 out | tr '\n' ' '; }
# x = 0.2 - (0.3 + sin T0) (t - T0) + cos T0 - cos t
exact() {
    awk -F, -v f="$1" 'NR > 1 && ($2 - 0.2 + (0.3 + sin(f)) * ($1 - f) - cos(f) + cos($1))^2 > 1e-22 {
        exit 1 }' out
}

case_is "a run that begins at T0, either way"
try 0 run $run --step 0.125 --from 2 --time 3 --samples 4
expect "rows from 2 to 3" [ "$(rows_at)" = "t 2 2.25 2.5 2.75 3 " ]
expect "another motion" exact 2
try 0 run $run --step -0.125 --from 2 --time 1 --samples 4
expect "rows from 2 to 1" [ "$(rows_at)" = "t 2 1.75 1.5 1.25 1 " ]
expect "another motion backwards" exact 2
try 0 run $run --step -0.125 --time -1 --samples 3
expect "another motion before 0" exact 0

case_is "a number of steps"
try 0 run $run --step -0.125 --from 2 --steps 8 --samples 2
expect "eight steps" [ "$(rows_at)" = "t 2 1.5 1 " ]
try 0 run $run --step 0.1 --from 4 --steps 1 --samples 1
expect "one step, though 4.1 - 4 < 0.1" [ "$(rows_at)" = "t 4 4.0999999999999996 " ]
expect "another motion" exact 4
table <<'END'
2 | run $run --step -0.125 --from 2 --steps 8 --time 1 | says --steps excludes --time
2 | run $run --step 0.125 --steps 0 | says --steps: 0 is not in 1\.\.
END
try 2 run $run --step 0.125 --from 1e17 --steps 2
says '^dalembert: --steps: 2 steps of 0.125 from t = 1e\+17 lead to no other finite time$'
try 2 run $run --step 1e300 --steps 1000000000
says '^dalembert: --steps: 1000000000 steps of 1e\+300 from t = 0 lead to no other finite time$'
printf '%s\n' "defaults: {integrator: gauss8, step: 0.125, time: 100}" >>forced.yaml
try 0 run ./forced.yaml --steps 2 --samples 1
expect "not the time of the file" [ "$(rows_at)" = "t 0 0.25 " ]

case_is "rows backwards at other times"
try 0 run $run --step -0.125 --from 2 --times 2,1.7,1.2 --time 1
expect "those times, and T" [ "$(cut -d, -f1 out | tr '\n' ' ')" = "t 2 1.7 1.2 1 " ]
expect "another motion" exact 2
try 0 run $run --step -0.125 --from 2 --time 0 --samples 3 --sampling log
expect "1, 4 and 16 steps" [ "$(rows_at)" = "t 2 1.875 1.5 0 " ]
try 0 run $run --step -0.125 --from 2 --time 0.9 --samples 3 --sampling steps
expect "whole steps" [ "$(rows_at)" = "t 2 1.625 1.25 0.875 " ]
table <<'END'
2 | run $run --step -0.125 --from 2 --times 1.5,1,1.2 | says --times: 1.2 does not come after the time before
2 | run $run --step -0.125 --from 2 --times 1,1.5 | says --times: a step of -0.125 does not lead from 1 to 1.5
2 | run $run --step -0.125 --from 2 --times 2.5,1.5 | says --times: 2.5 lies before the start at t = 2
2 | run $run --step -0.125 --from 2 --times 1.5,0.5 --time 1 | says --times: 0.5 is later than T = 1
END

case_is "a sign that does not lead there"
try 2 run $run --step 0.125 --from 1.0000000001 --time 1
says '^dalembert: --time: a step of 0.125 does not lead from t = 1.0000000001 to t = 1$'
table <<'END'
2 | run $run --step 0.125 --from 2 --time 1 | says --time: a step of 0.125 does not lead from t = 2 to t = 1
2 | run $run --step -0.125 --from 2 --time 3 | says --time: a step of -0.125 does not lead from t = 2 to t = 3
2 | run $run --step -3 --from 2 --time 1 | says --step: -3 is larger than the time -1
2 | lyapunov $run --step -0.125 --time 1 | says --step: -0.125 is not positive
2 | lyapunov $run --step 0.125 --time -1 | says --time: -1 is not positive
2 | explain chaplygin-sleigh --integrator dop853 --tolerance 1e-8 --time -1 | says --time: -1 is not positive
END

case_is "a directory of a run backwards is resumed"
long="chaplygin-sleigh --integrator gauss4 --step -0.01 --from 5 --steps 2000 --samples 40"
try 0 run $long --output whole
try 0 resume whole
says "is finished: 41 rows"
expect "the manifest has the options" grep -q '"from": 5,' whole/manifest.json
expect "and the number of steps" grep -q '"steps": 2000,' whole/manifest.json
expect "it ended there" grep -q '"t": -15,' whole/manifest.json

case_is "a generated file begins there, too"
if needs 7 "no gcc" there gcc; then
    try 0 generate ./forced.yaml --integrator gauss8 --space physical --from 2 --prefix g -o g.c
    cat >main.c <<'END'
#include "g.c"
#include <stdio.h>
int main(void)
{
    static g_state s;
    if (g_start(&s, 0) || g_advance(&s, -0.125, 8)) return 1;
    return printf("%.17g,%.17g,%.17g\n", g_time(&s, 0), s.y[0], s.y[1]) < 0;
}
END
    expect "it does not compile" gcc -std=c11 -O1 main.c -o main -lm
    ./main >generated.csv
    try 0 run $run --space physical --step -0.125 --from 2 --steps 8 --samples 1 --columns "x,x'"
    sed -n 3p out >interpreted.csv
    expect "other digits" cmp -s generated.csv interpreted.csv
    case_is "compiled steps go there, too"
    long="contact-oscillator --integrator gauss4 --step -0.05 --from 5 --steps 90 --samples 7"
    try 0 run $long --native off --output interpreted.csv
    try 0 run $long --native on --output native.csv
    expect "other bytes" cmp -s interpreted.csv native.csv
    counted
fi

case_is "orders and sections from T0"
try 0 order ./forced.yaml --from 2 --time 5 --step 0.5 --integrators rk4 --output order.csv
expect "another order" awk -F, 'NR == 2 && ($4 - 4)^2 > 0.01 { exit 1 }' order.csv
expect "other numbers of steps" [ "$(cut -d, -f6 order.csv | tr '\n' ' ')" = "steps 6 12 24 48 " ]
try 2 order ./forced.yaml --from 2 --time 1 --step 0.5 --integrators rk4
says 'the time 1 is not a whole number of steps'
# phi = t - 3
try 0 section chaplygin-sleigh --integrator gauss4 --step 0.1 --from 3 --time 20 --on "sin(phi)" --output -
expect "other times" awk -F, 'NR > 1 && ($2 - 3 - 3.14159265358979 * (NR - 1))^2 > 1e-20 { exit 1 }' out
expect "five crossings" [ "$(wc -l <out)" = 6 ]
try 2 section chaplygin-sleigh --integrator gauss4 --step -0.1 --time -3 --on phi
says 'a section needs a positive step'

case_is "studies from T0, backwards, in a number of steps"
cat >study.yaml <<'END'
integrators: [gauss8]
step: [-0.125, -0.25]
from: 2
steps: 8
starts: physical
systems:
  - {system: ./forced.yaml, label: steps}
  - {system: ./forced.yaml, label: time, time: 0}
  - {system: ./forced.yaml, label: forwards, from: -1.5, step: 0.125}
END
try 0 study study.yaml --output there --no-page
expect "other ends" [ "$(column time there/cells.csv | tr '\n' ' ')" = "1 0 0 0 -0.5 " ]
expect "not reached" [ "$(column reached there/cells.csv | tr '\n' ' ')" = "1 0 0 0 -0.5 " ]
expect "other numbers of steps" [ "$(column steps there/cells.csv | tr '\n' ' ')" = "8 8 16 8 8 " ]
# E = x'^2/2 at the end, x' = -0.3 + sin t - sin T0
ends() {
    awk -F, '$5 == "E" { T0 = $1 == "forwards" ? -1.5 : 2; v = -0.3 + sin(T[++n]) - sin(T0)
        if (($7 - v^2 / 2)^2 > 1e-24) exit 1 }
        BEGIN { split("1 0 0 0 -0.5", T, " ") }' there/quantities.csv
}
expect "another motion" ends
expect "until the end" awk -F, 'NR > 1 && $5 > 2.0001 { exit 1 }' there/series/time.csv
bad 'integrators: rk4\nstep: 1\nsteps: 3\ntime: 1\nsystems: [forced.yaml]\n' 'bad.yaml:1:1: steps exclude time'
bad 'integrators: rk4\nstep: 1\nsystems: [{system: forced.yaml, steps: 3, time: 1}]\n' 'bad.yaml:3:11: steps exclude time'
bad 'integrators: rk4\nstep: 1\nsteps: 0\nsystems: [forced.yaml]\n' 'bad.yaml:3:8: steps: 0 is not in 1'
bad 'integrators: rk4\nstep: 0\ntime: 1\nsystems: [forced.yaml]\n' 'bad.yaml:2:7: step: it must not be 0'
bad 'integrators: rk4\nstep: [0.5, -1]\nfrom: 3\ntime: 2\nsystems: [forced.yaml]\n' 'a step of 0.5 does not lead from t = 3 to t = 2'

case_is "check, explain, lyapunov and volume from a later time, t in start"
cat >moving.yaml <<'END2'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2
constraints: [y' - t*x']
start: {x: sin(t), x': 1, y': t}
END2
try 0 run moving.yaml --integrator rk4 --step 0.1 --from 2 --time 3 --samples 1 --columns "x,y',D1"
expect "the start" awk -F, 'NR == 2 { exit !(($2 - sin(2))^2 < 1e-30 && $3 == 2 && $4 == 0) }' out
try 0 check moving.yaml --from 2
# At t = 2 alone y' = 2 is on D = 0.
sed "s/y': t/y': 2/" moving.yaml >at2.yaml
try 0 check at2.yaml --from 2
prints '^  .D. at the start +ok +0 '
try 1 check at2.yaml
# x'' = -(1 + cos(t + s)/2) x - x'/10: what is found from t = 2 is what is found from t = 0 with s = 2.
cat >shifted.yaml <<'END2'
coordinates: [x]
parameters: {s: 0}
lagrangian: x'^2/2 - (1 + cos(t + s)/2)*x^2/2
forces: {x: -0.1*x'}
start: {x': 1}
invariants: {seen: x'^2 + x^2}
END2
for command in lyapunov volume; do
    try 0 $command shifted.yaml --integrator rk4 --step 0.1 --from 2 --time 12 --transient 3
    prints 'means over t = 5 \.\. 15$'
    sed 1d out >from
    try 0 $command shifted.yaml --integrator rk4 --step 0.1 --set s=2 --time 10 --transient 3
    sed 1d out | cmp -s - from && same=yes || same=$(diff out from)
    expect "$command: $same" test "$same" = yes
    try 0 $command shifted.yaml --integrator rk4 --step 0.1 --time 10 --transient 3
    sed 1d out | cmp -s - from && expect "$command does not see t" false
    try 2 $command shifted.yaml --integrator rk4 --step 0.1 --from 2 --time 1
    says -- '--time: 1 does not come after --from 2'
    try 2 $command shifted.yaml --integrator rk4 --step -0.1 --from 2 --time 1
    says 'is not positive'
done
try 0 explain shifted.yaml --integrator rk4 --step 0.1 --from 2 --time 22
sed 1d out >from
try 0 explain shifted.yaml --integrator rk4 --step 0.1 --set s=2 --time 20
first=$(grep seen out | head -1)
expect "explain: $first" grep -qF "$first" from
