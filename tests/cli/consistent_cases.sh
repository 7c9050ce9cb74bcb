# Starts whose velocities are moved to D = 0: --consistent.

# W = diag(2, 1), A = (1, 1): v - v0 = -(1/2, 1) (x' + y' - 1)/(3/2).
cat >skew.yaml <<'END'
coordinates: [x, y]
lagrangian: x'^2 + y'^2/2
constraints: [x' + y' - 1]
start: {x: 5, x': 2, y': 0.5}
END
run="./skew.yaml --integrator rk4 --step 0.1 --time 1 --samples 1"

case_is "a start off D = 0"
try 2 run $run
says "^dalembert: ./skew.yaml: the start violates constraint 1: D1 = 1.5; the option consistent moves"
try 0 run $run --consistent --columns "x',y',D1"
holds "another start" [ "$(sed -n 2p out)" = "0,1.5,-0.5,0" ]
for way in "--consistent on" --consistent=on; do
    try 0 run $way $run --columns "x',y',D1"
    holds "another start" [ "$(sed -n 2p out)" = "0,1.5,-0.5,0" ]
done
try 2 run $run --consistent off
says 'the start violates constraint 1'
try 2 run $run --consistent maybe
says "'maybe'"

case_is "a directory is resumed"
try 0 run $run --consistent --output there
holds "the manifest has the option" grep -q '"consistent": "on"' there/manifest.json
try 0 resume there
says 'is finished: 2 rows'

case_is "generated: the same bytes"
if there gcc; then
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
    holds "it does not compile" gcc -std=c11 -O1 main.c -o main -lm
    ./main >generated.csv
    try 0 run ./skew.yaml --integrator gauss4 --step 0.1 --time 1 --samples 1 --space physical \
        --consistent --columns x,y
    sed -n 3p out >interpreted.csv
    holds "other digits" cmp -s generated.csv interpreted.csv
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
holds "a cell fails" [ "$(column state there/cells.csv | sort -u)" = done ]
holds "D moved" awk -F, '$3 != "displaced" && $5 == "D1" && ($8 > 1e-14 || $8 < -1e-14) { exit 1 }' there/quantities.csv
