# Runs that end before their time: the rows so far are kept, the message names cause and time.

# breaks MESSAGE LEAST MOST ARGUMENT...: exit 3, LEAST..MOST lines of rows.
breaks() {
    message=$1 least=$2 most=$3
    shift 3
    try 3 run "$@"
    says "^dalembert: .*$message"
    lines=$(wc -l <out)
    expect "$lines lines, not $least..$most" [ "$lines" -ge "$least" -a "$lines" -le "$most" ]
}

case_is "G singular: phi = pi/2 in (nh33)"
# phi = t: of the rows at 0, 0.1, ... those up to 1.5 are before the singularity at pi/2.
breaks 't = 1\.5[67]' 17 17 chaplygin-sleigh-nonlinear --integrator gauss8 --step 0.01 --time 3 \
    --samples 30

case_is "G singular: appell-hamel comes to rest"
# Rising with 1, it loses g/(1 + nu^2) = 1/2 per unit of time: at rest at t = 2.
breaks 'constraint 1 .* t = (2|1\.99)' 21 22 appell-hamel --integrator rk4 --step 0.01 --time 10 \
    --set w0=-1

case_is "appell-hamel started at rest"
try 2 run appell-hamel --integrator rk4 --step 0.01 --time 1 --set w0=0
says '^dalembert: appell-hamel: constraint 1 '
empty

case_is "constraints on a body without mass"
try 2 run chaplygin-sleigh --integrator rk4 --step 0.01 --time 1 --set m=0
says '^dalembert: chaplygin-sleigh: the mass matrix is singular at the start$'
empty

case_is "W is singular, the motion is determined"
# x = cos t; theta has no inertia.
cat >wheel.yaml <<'END'
coordinates: [x, theta]
lagrangian: x'^2/2 - x^2/2
constraints: [x' - theta'/2]
start: {x: 1}
exact: {x: cos(t), theta: 2*cos(t) - 2}
END
try 0 check wheel.yaml
prints '^  rank of A at the start +ok +1 of 1'
prints '^  rank of W on ker A +ok +1 of 1'
prints '^[0-9]+ items, 0 failed$'
try 0 run wheel.yaml --integrator gauss8+project --step 0.1 --time 5 --samples 5 --native off
mv out interpreted
expect "not cos t" awk -F, 'NR > 1 && !($NF < 1e-12) {exit 1}' interpreted
try 0 run wheel.yaml --integrator gauss8+project --step 0.1 --time 5 --samples 5 --native auto
expect "other bits" cmp out interpreted
try 2 run wheel.yaml --integrator gni --space physical --step 0.1 --time 5 --columns x,h1,lambda1
says "--columns: no column 'lambda1': where W is used on ker A alone, methods carry no multipliers"
empty

case_is "W becomes singular on ker A"
# There it is 2 - t, times a number.
cat >ending.yaml <<'END'
coordinates: [x, y]
lagrangian: x'^2/2 + 100*(1 - t)*y'^2/2
constraints: [y' - x'/10]
start: {x': 1, y': 0.1}
END
breaks 'mass matrix, on the velocities that the constraints allow, .* near t = (2|1\.99)' 21 22 \
    ./ending.yaml --integrator rk4 --step 0.07 --time 4 --samples 40
try 1 check ending.yaml --from 2
prints '^  rank of W on ker A +FAIL +0 of 1'

case_is "a constraint turns by more than a right angle, G = 1"
try 3 run isokinetic --integrator taylor --tolerance 1e-9 --step 5 --time 10 --samples 2
says 'the gradient of constraint 1 by the velocities turns by more than a right angle in the step'
try 0 order isokinetic --tolerances 1e-4,1e-6,1e-8 --time 10
expect "no errors" [ "$(grep -c '^[dt].* [0-9.]*e-[0-9]* .*e-[0-9]* .*e-0[89] ' out)" = 2 ]

case_is "e reaches 0"
cat >gauge.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2
gauge: {mu_e: -1}
END
# e = 1 - t: rows at 0, 0.1, ..., 0.9 at least.
breaks 'e reached zero' 11 12 ./gauge.yaml --integrator rk4 --step 0.01 --time 2 --samples 20 \
    --start pi_x=1e-3

case_is "no convergence at a huge step"
breaks 'did not converge' 2 11 contact-oscillator --integrator gauss8 --step 100 --time 1000 \
    --samples 10 --solver fixed-point

case_is "a failing run keeps the rows of a file"
try 3 run chaplygin-sleigh-nonlinear --integrator gauss8 --step 0.01 --time 3 --samples 30 \
    --output rows.csv
expect "17 lines" [ "$(wc -l <rows.csv)" -eq 17 ]
expect "whole lines" awk -F, 'NR == 1 { n = NF } NF != n { exit 1 }' rows.csv
try 3 run chaplygin-sleigh-nonlinear --integrator gauss8 --step 0.01 --time 3 --samples 30 \
    --output rows.npy
expect "16 rows" has_rows rows.npy 16
try 3 run chaplygin-sleigh-nonlinear --integrator gauss8 --step 0.01 --time 3 --samples 30 \
    --output broken
expect "other rows" cmp rows.npy broken/trajectory.npy
expect "a summary" grep -q '^D1,.*,aborted,$' broken/summary.csv

case_is "messages never go where the rows go"
# With standard error closed, the file of rows must not become it.
"$program" run chaplygin-sleigh-nonlinear --integrator gauss8 --step 0.01 --time 3 --samples 30 \
    --output mute.csv 2>&-
expect "rows and nothing else" cmp mute.csv rows.csv
"$program" list >&- 2>err
expect "a closed standard output is a failing write" [ $? -eq 4 ]

case_is "output that cannot be written"
sleigh="chaplygin-sleigh --integrator rk4 --step 0.001 --time 10 --samples 10000"
try 4 run $sleigh --output missing/rows.csv
says "^dalembert: cannot write 'missing/rows.csv': No such file or directory$"
try 4 run $sleigh --output line.yaml/rows.npy
says "cannot write 'line.yaml/rows.npy': Not a directory"
try 4 run $sleigh --output missing/folder
says "cannot make the directory 'missing/folder': No such file or directory"
cp line.yaml line
try 4 run $sleigh --output line
says "cannot make the directory 'line': File exists"

case_is "a full disk"
try 4 run $sleigh --output /dev/full
says "cannot write '/dev/full': No space left on device"
for arguments in "run $sleigh" "run $sleigh --samples 1" list --help --version "run --help"; do
    "$program" $arguments >/dev/full 2>err
    status=$?
    expect "exit $status, not 4: $arguments" [ $status -eq 4 ]
    says "cannot write 'standard output': No space left on device"
done
# Years of steps are not taken when the first rows are lost.
timeout $patience "$program" run $sleigh --time 1e9 --samples 1000000 >/dev/full 2>err
status=$?
expect "exit $status, not 4: a long run" [ $status -eq 4 ]
# A stream that is full before its end no longer knows why.
motion="--integrator rk4 --step 0.1 --time 1"
awk 'BEGIN { print "t,x"; for (t = 0; t <= 1; t += 0.125) print t "," t * t }' >curve.csv
for arguments in "check line.yaml" "show benenti" "generate line.yaml --integrator rk4" "explain line.yaml $motion" \
    "order line.yaml --integrators rk4 --time 1" "lyapunov line.yaml $motion" "section line.yaml --on x-0.1 $motion" \
    "explain line.yaml $motion --json" "order line.yaml --integrators rk4 --time 1 --output -" "list --json" \
    "help --markdown" "run line.yaml $motion --format markdown" "explain line.yaml $motion --format csv" \
    "order line.yaml --integrators rk4 --time 1 --json" "predict line.yaml $motion" "predict line.yaml $motion --json" \
    "predict line.yaml $motion --output -" "predict line.yaml $motion --format latex" "lyapunov line.yaml $motion --json" \
    "lyapunov line.yaml $motion --format csv" "steer line.yaml --to x=1 $motion" \
    "steer line.yaml --to x=1 $motion --json" "steer line.yaml --to x=1 $motion --format csv" "check line.yaml --json" \
    "check line.yaml --latex" "check line.yaml --mathml" "dirac line.yaml" "dirac line.yaml --latex" \
    "dirac line.yaml --json" "invariants line.yaml" "invariants line.yaml --json" "volume line.yaml $motion" \
    "action line.yaml curve.csv" "action line.yaml curve.csv --json" "section line.yaml --on x-0.1 $motion --json" \
    "list systems --json" "list integrators --markdown" "help run" \
    "ensemble line.yaml $motion --members 4 --seed 1 --vary x=uniform(1,2) --output full-ensemble --no-page"; do
    "$program" $arguments >/dev/full 2>err
    status=$?
    expect "exit $status, not 4: $arguments" [ $status -eq 4 ]
    says "^dalembert: cannot write 'standard output': "
    expect "more than one reason: $arguments" test "$(grep -c 'cannot write' err)" -eq 1
done
