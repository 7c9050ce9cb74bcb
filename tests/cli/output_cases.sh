# Where rows go, which columns they have, and the line of progress.

circle="knife-edge --integrator gauss4 --step 0.1 --time 2 --samples 4"

case_is "an unknown ending is an error that lists the known ones"
for output in x.h5 x.txt ./there/x.CSV; do
    try 2 run $circle --output $output
    says "^dalembert: --output: '$output' does not end in \.csv or \.npy; a directory has no ending$"
    expect "$output was made" test ! -e $output
done
try 2 section $circle --on x --output x.dat
says "'x.dat' does not end in .csv or .npy; a directory"
try 2 lyapunov knife-edge --integrator gauss4 --step 0.1 --time 2 --output x.dat
says "'x.dat' does not end in .csv or .npy; a directory"
try 2 order knife-edge --integrators rk4 --output x.npy
says "'x.npy' does not end in .csv; a directory has no ending$"
try 0 run $circle --output /dev/null
silent
mkdir held.d
try 0 run $circle --output held.d
says "^dalembert: wrote the directory 'held.d'$"

case_is "numbers that are none"
printf '%s\n' 'coordinates: [x]' "lagrangian: x'^2/2" "start: {x: 1, x': -1}" 'exact: {x: "if(t < 1.25, 1 - t, log(-t))"}' >gone.yaml
try 0 run gone.yaml --integrator rk4 --step 0.5 --time 1.5 --samples 3 --columns error --output -
expect "$(tail -n 1 out)" test "$(tail -n 1 out)" = 1.5,nan

case_is "a directory is announced"
for output in h0.1 ./plain; do
    try 0 run $circle -o $output
    says "^dalembert: wrote the directory '$output'$"
    expect "no rows in $output" test -s $output/trajectory.npy
done
try 0 lyapunov knife-edge --integrator gauss4 --step 0.1 --time 2 --rows 4 --output means
says "^dalembert: wrote the directory 'means'$"
try 0 run $circle -o rows.csv
silent

# selects LIST NAMES [OPTION]...: the columns of a run of named.yaml are NAMES.
cat >named.yaml <<'END2'
coordinates: [q, phi, p_]
parameters: {k: 1}
lagrangian: (q'^2 + phi'^2 + p_'^2 - k*q^2)/2
constraints: [p_' - q*phi']
start: {q: 1, phi': 0.5, p_': 0.5}
invariants: {spin_1: phi'*sqrt(1 + q^2), speed: phi'^2 + p_'^2}
END2
selects() {
    list=$1 names=$2
    shift 2
    try 0 run named.yaml --integrator rk4 --step 0.1 --time 0.5 --samples 5 --columns "$list" "$@"
    expect "--columns $list: $(head -1 out)" test "$(head -1 out)" = "$names"
}
case_is "columns: names, groups and patterns, in the order of the row"
physical="--space physical"
selects phi t,phi
selects "E,q'" "t,q',E"
selects t t $physical
selects v "t,q',phi',p_'"
selects D,E,invariants t,D1,E,spin_1,speed $physical
selects 's*' t,spin_1,speed
selects "?hi,*'" "t,phi,q',phi',p_'"
selects lift t,e,p_q,p_phi,p_p_,pi_q,pi_phi,pi_p_,pi_e,H
selects 'pi_*,H' t,pi_q,pi_phi,pi_p_,pi_e,H
selects 'D1,D1,D' t,D1

case_is "columns: the name of a coordinate wins over a group"
selects q t,q
sed 's/\bq\b/x/g' named.yaml >x.yaml
try 0 run x.yaml --integrator rk4 --step 0.1 --time 0.5 --columns q
expect "$(head -1 out)" test "$(head -1 out)" = t,x,phi,p_

case_is "columns: the numbers are the same as in the whole row"
try 0 run named.yaml --integrator rk4 --step 0.1 --time 1 --output whole.csv
try 0 run named.yaml --integrator rk4 --step 0.1 --time 1 --columns phi,E --output part.csv
cut -d, -f1,3,"$(head -1 whole.csv | tr ',' '\n' | grep -nx E | cut -d: -f1)" whole.csv >expected.csv
expect "other numbers" cmp expected.csv part.csv

case_is "columns: what matches nothing is named, and no file is made"
try 2 run named.yaml --integrator rk4 --step 0.1 --time 1 --columns phy,E,sped --output none
says "^dalembert: --columns: the run has no column 'phy'; did you mean 'phi'\?$"
says "^dalembert: --columns: the run has no column 'sped'; did you mean 'speed'\?$"
expect "a directory was made" test ! -e none
try 2 run named.yaml --integrator rk4 --step 0.1 --time 1 --space physical --columns lift
says "no column 'lift'$"
table <<'END'
2 | run named.yaml --integrator rk4 --step 0.1 --time 1 --columns '' | says no column ''
2 | lyapunov named.yaml --integrator rk4 --step 0.1 --time 1 --columns q | says unknown option '--columns'
END

case_is "columns: resume keeps the list"
long="named.yaml --integrator rk4 --step 0.001 --time 2000 --samples 20000 --native off"
try 0 run $long --columns "phi,E" --output all.npy
if needs 2 "no compiler for signals at given places" raises; then
    cut_off 137 9 6 run $long --columns "phi,E" --output kept --checkpoint 0
    try 0 resume kept
    counted
else
    try 0 run $long --columns "phi,E" --output kept
fi
expect "not in the manifest" grep -q '^    "columns": "phi,E",$' kept/manifest.json
expect "another number of columns" test "$(columns_of kept/trajectory.npy)" -eq 3
expect "other bytes" cmp all.npy kept/trajectory.npy
expect "the summary lacks what is no column" grep -q '^speed,' kept/summary.csv
try 0 report kept
expect "the energy is no figure" test -s kept/report/E.gp
refute "a coordinate that is none" grep -q "'E'" kept/report/coordinates.gp
try 0 run $circle --columns 'phi,v,D,lift' --output pathless
try 0 report pathless
expect "a path without q" test ! -e pathless/report/path.gp
try 0 run $circle --columns 'q,v' --output path
try 0 report path
expect "no path with q and v" test -s path/report/path.gp

if needs 5 "no terminal (script, stty)" terminal; then
    case_is "progress on a terminal while rows go to standard output"
    slow="run named.yaml --integrator rk4 --step 0.001 --time 1000 --samples 4 --native off --space physical --columns phi"
    try 0 $slow
    mv out rows
    # The rows to a pipe, and both to one terminal.
    script -qec "'$program' $slow | cat >piped" shown </dev/null >/dev/null
    expect "other rows" cmp rows piped
    expect "no line of progress" grep -q 't = [0-9.]* ([0-9]* %), ' shown
    script -qec "stty cols 100; '$program' $slow --output -" both </dev/null >/dev/null
    expect "no line of progress beside rows" grep -q 't = [0-9.]* ([0-9]* %), ' both
    # What a terminal shows of it: each \r begins the line again.
    tr -d '\000' <both | sed 's/\r$//; s/.*\r//' | grep '^[0-9t.e+-]*,[a-z0-9.e+-]*$' >left
    expect "rows are not whole lines" cmp rows left
    counted
fi
