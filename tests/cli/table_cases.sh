# Tables: files of a system, where they are found, what of them is in the directory of a run.

mkdir -p tables/data
cat >tables/data/push.csv <<'END'
t, left, right
0, 0, 1
1, 2, 1
3, 2, -1
END
cat >tables/push.yaml <<'END'
coordinates: [x]
tables: {f: {file: data/push.csv, at: t, value: left}, g: {file: data/push.csv, at: t, value: right}}
accelerations: {x: 6*f(t) + 0*g(t)}
END

# x'' = 12 t up to 1, then 12: x = 2 t^3; 2 + 6 (t - 1) + 6 (t - 1)^2.
case_is "a table beside the system file"
try 0 run tables/push.yaml --integrator gauss4 --step 0.125 --time 3 --samples 3 --space physical
prints '^1,2,6$'
prints '^2,14,18$'
prints '^3,38,30$'
cp out rows

case_is "the same bits compiled"
if needs 2 "no compiler" there cc; then
    try 0 run tables/push.yaml --integrator gauss4 --step 0.125 --time 3 --samples 3 --space physical --native on
    expect "native differs" cmp rows out
    counted
fi

case_is "a run is resumed where its tables are not"
push="tables/push.yaml --integrator gauss4 --step 0.125 --time 3 --samples 24 --space physical"
try 0 run $push --output pushed
mv tables/data tables/hidden
try 2 run $push
says "^dalembert: tables/push\.yaml:2:20: cannot read 'tables/data/push\.csv': No such file or directory$"
try 0 run pushed/system.yaml --integrator gauss4 --step 0.125 --time 3 --samples 3 --space physical
expect "the copy is another system" cmp rows out
mv tables/hidden tables/data
if needs 4 "no compiler for signals at given places" raises; then
    cut_off 137 9 6 run $push --checkpoint 0 --output cut
    mkdir elsewhere
    mv cut elsewhere/moved
    mv tables/data tables/hidden
    try 0 resume elsewhere/moved
    says "'elsewhere/moved' resumes at t = "
    expect "not the rows of a run never interrupted" cmp elsewhere/moved/trajectory.npy pushed/trajectory.npy
    mv tables/hidden tables/data
    counted
fi

case_is "a study has its tables in its directory"
cat >push_study.yaml <<'END'
systems: [tables/push.yaml]
integrators: [gauss4]
step: 0.125
time: 3
END
try 0 study push_study.yaml --output push_study
expect "the points are not in the copy" grep -rq '0, 0, 1' push_study/systems

case_is "outside the points of a table"
try 3 run tables/push.yaml --integrator rk4 --step 0.125 --time 4
says '^dalembert: tables/push\.yaml: table f is read outside its points near t = 3\.[0-9]+$'
sed 's/left}/left, extend: constant}/; s/right}/right, extend: linear}/' tables/push.yaml >tables/extended.yaml
try 0 run tables/extended.yaml --integrator gauss4 --step 0.125 --time 4 --samples 1 --space physical
prints '^4,74,42$'

case_is "empty lines in the file of a table"
cp tables/data/push.csv plain.csv
printf ' t , left,"right"\r\n\n0, 0, 1\n \t \n\n1,2,1\r\n3, "2", -1\n\n \n  ' >tables/data/push.csv
try 0 run tables/push.yaml --integrator gauss4 --step 0.125 --time 3 --samples 3 --space physical
expect "other rows" cmp rows out
printf 't,left,right\n\n0,0,1\n \r\n\n1,2 3,1\n' >tables/data/push.csv
try 2 run tables/push.yaml --integrator rk4 --step 0.125 --time 3
says "^dalembert: tables/push\.yaml:2:[0-9]+: data/push\.csv:6:3: '2 3' is not a number$"
cp plain.csv tables/data/push.csv

case_is "a file of a table that is wrong"
printf 't,left,right\n0,0,1\n1,2 3,1\n' >tables/data/push.csv
try 2 run tables/push.yaml --integrator rk4 --step 0.125 --time 3
says "^dalembert: tables/push\.yaml:2:20: data/push\.csv:3:3: '2 3' is not a number$"
rm tables/data/push.csv
mkdir tables/data/push.csv
try 2 run tables/push.yaml --integrator rk4 --step 0.125 --time 3
says "^dalembert: tables/push\.yaml:2:20: cannot read 'tables/data/push\.csv': Is a directory$"
