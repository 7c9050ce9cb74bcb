# Starts whose velocities are moved to D = 0: --consistent.

# The masses are 2 and 1, so that v - v0 = -(1/2, 1) (x' + y' - 1)/(3/2).
cat >skew.yaml <<'END'
coordinates: [x, y]
lagrangian: x'^2 + y'^2/2
constraints: [x' + y' - 1]
start: {x: 5, x': 2, y': 0.5}
END
run="./skew.yaml --integrator rk4 --step 0.1 --time 1 --samples 1"

case_is "a start off D = 0"
table <<'END'
2 | run $run | says ^dalembert: ./skew.yaml: the start violates constraint 1: D1 = 1.5; the option consistent moves
1 | check ./skew.yaml | prints FAIL  0.6  .at most 1e-10.: --consistent
END
try 0 run $run --consistent --columns "x',y',D1"
expect "another start" [ "$(sed -n 2p out)" = "0,1.5,-0.5,0" ]
for way in "--consistent on" --consistent=on; do
    try 0 run $way $run --columns "x',y',D1"
    expect "another start" [ "$(sed -n 2p out)" = "0,1.5,-0.5,0" ]
done
table <<'END'
2 | run $run --consistent off | says the start violates constraint 1
2 | run $run --consistent maybe | says 'maybe'
END

case_is "a directory is resumed"
try 0 run $run --consistent --output there
expect "the manifest has the option" grep -q '"consistent": "on"' there/manifest.json
try 0 resume there
says 'is finished: 2 rows'

case_is "generated: the same bytes"
if needs 4 "no gcc" there gcc; then
    try 0 generate ./skew.yaml --integrator gauss4 --space physical --consistent --prefix g -o g.c
    cat >main.c <<'END'
#include "g.c"
#include <stdio.h>
int main(void)
{
    static g_state s;
    if (g_start(&s, 0) || g_advance(&s, 0.1, 10)) return 1;
    return printf("%.17g,%.17g,%.17g\n", g_time(&s, 0), s.y[0], s.y[1]) < 0;
}
END
    expect "it does not compile" gcc -std=c11 -O1 main.c -o main -lm
    ./main >generated.csv
    try 0 run ./skew.yaml --integrator gauss4 --step 0.1 --time 1 --samples 1 --space physical \
        --consistent --columns x,y
    sed -n 3p out >interpreted.csv
    expect "other digits" cmp -s generated.csv interpreted.csv
    counted
fi

case_is "other commands"
try 0 order ./skew.yaml --consistent --step 0.5 --time 2 --integrators rk4
try 2 order ./skew.yaml --step 0.5 --time 2 --integrators rk4
says 'the start violates constraint 1'

case_is "in a study"
cat >study.yaml <<'END'
integrators: [gauss4]
step: 0.1
time: 1
systems:
  - {system: ./skew.yaml, label: moved, options: {consistent: on}}
  - {system: ./skew.yaml, label: drawn, seeds: [1, 2], start: {"x'": {between: [0, 1]}}}
END
try 0 study study.yaml --output there --no-page --force
expect "a cell fails" [ "$(column state there/cells.csv | sort -u)" = done ]
expect "D moved" awk -F, '$3 != "displaced" && $5 == "D1" && ($8 > 1e-14 || $8 < -1e-14) { exit 1 }' there/quantities.csv

# ---- velocities that a start solves ----

cat >circle.yaml <<'EOF'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2
constraints: [(x'^2 + y'^2 - 25)/2]
start: {x': 3, y': 1, solve: [y']}
defaults: {integrator: gauss4, step: 0.1, time: 1}
EOF
cat >screw.yaml <<'EOF'
coordinates: [x, y, z]
lagrangian: (x'^2 + y'^2 + z'^2)/2 - z
constraints:
  - x' + 2*y' - z' - x
  - y' - z'*cos(x)
start:
  x: 1
  x': 0.3
  solve:
    - y'
    - z'
EOF
solved="./screw.yaml --integrator gauss4 --step 0.01 --time 1 --samples 101"

case_is "solve: a first guess chooses the root"
try 0 run ./circle.yaml --samples 1 --columns "x',y'"
expect "another root" [ "$(sed -n 2p out)" = "0,3,4" ]
try 0 run ./circle.yaml --samples 1 --columns "x',y'" --start "y'=-2" --start "x'=4"
expect "another root" [ "$(sed -n 2p out)" = "0,4,-3" ]

case_is "solve: no root, or no unique one"
try 2 run ./circle.yaml --start "x'=6"
says "^dalembert: ./circle.yaml:4:31: the start cannot be solved for y': no root of constraint 1 was found"
try 2 run ./circle.yaml --start "y'=0"
says "^dalembert: ./circle.yaml:4:31: .* no constraint restricts it at the first guess 0; give another one"
table <<'END'
2 | check ./circle.yaml --start "y'=0" | says ^dalembert: ./circle.yaml:4:31: the start cannot be solved for y'
case: solve: check begins with the velocities solved
0 | check ./screw.yaml | prints [|]D[|] at the start  *ok
END

case_is "solve: other commands"
try 0 order ./screw.yaml --step 0.05 --time 1 --integrators rk4
try 0 lyapunov ./circle.yaml --exponents 1

if needs 4 "no compiler for signals at given places" raises; then
    case_is "solve: killed and resumed"
    try 0 run $solved --output whole
    cut_off 137 9 6 run $solved --checkpoint 0 --output killed
    try 0 resume killed
    expect "not the rows of a run never interrupted" cmp killed/trajectory.npy whole/trajectory.npy
    counted
fi

if needs 7 "no gcc" there gcc; then
    case_is "solve: compiled and generated, the same bytes"
    try 0 run $solved --native off --output interpreted.csv
    try 0 run $solved --native on --output native.csv
    expect "other bytes" cmp -s native.csv interpreted.csv
    try 0 generate ./screw.yaml --integrator gauss4 --space physical --prefix g -o g.c
    expect "it does not compile" gcc -std=c11 -O1 main.c -o main -lm
    ./main >generated.csv
    try 0 run ./screw.yaml --integrator gauss4 --step 0.1 --time 1 --samples 1 --space physical \
        --columns x,y
    sed -n 3p out >interpreted.csv
    expect "other digits" cmp -s generated.csv interpreted.csv
    counted
fi

case_is "solve: random starts of studies"
cat >study.yaml <<'EOF'
integrators: [gauss4]
step: 0.1
time: 1
systems:
  - {system: ./screw.yaml, label: drawn, seeds: [1, 2], start: {"x'": {between: [0, 1]}}}
EOF
try 0 study study.yaml --output solved --no-page
expect "a cell fails" [ "$(column state solved/cells.csv | sort -u)" = done ]
