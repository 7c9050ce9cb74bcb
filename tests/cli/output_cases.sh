# Where rows go, which columns they have, and the line of progress.

circle="knife-edge --integrator gauss4 --step 0.1 --time 2 --samples 4"

case_is "an unknown ending is an error that lists the known ones"
for output in x.h5 x.txt ./there/x.CSV; do
    try 2 run $circle --output $output
    says "^dalembert: --output: '$output' does not end in \.csv or \.npy; a directory has no ending$"
    holds "$output was made" test ! -e $output
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
says "^dalembert: 'held.d' is a directory$"

case_is "a directory is announced"
for output in h0.1 ./plain; do
    try 0 run $circle -o $output
    says "^dalembert: '$output' is a directory$"
    holds "no rows in $output" test -s $output/trajectory.npy
done
try 0 lyapunov knife-edge --integrator gauss4 --step 0.1 --time 2 --rows 4 --output means
says "^dalembert: 'means' is a directory$"
try 0 run $circle -o rows.csv
silent
