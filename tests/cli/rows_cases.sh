# What a run writes: columns, rows, digits.

# rows FILE CONDITION: it holds, as awk has it, in every row but the header.
rows() { awk -F, "NR > 1 && !($2) { bad = 1 } END { exit bad }" "$1"; }
count() { [ "$(wc -l <"$1")" -eq "$2" ]; }

case_is "columns on the lifted space"
try 0 run ./plane.yaml --integrator rk4 --step 0.1 --time 1
expect "header" [ "$(head -1 out)" = "t,x,y,x',y',e,p_x,p_y,pi_x,pi_y,pi_e,D1,E,H" ]
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1
expect "header" [ "$(head -1 out)" = "t,x,x',e,p_x,pi_x,pi_e,E,H,c,error" ]

case_is "columns on the physical space"
try 0 run ./plane.yaml --integrator rk4 --step 0.1 --time 1 --space physical
expect "header" [ "$(head -1 out)" = "t,x,y,x',y',D1,E" ]
table <<'END'
0 | run chaplygin-sleigh-vakonomic --integrator rk4 --step 0.1 --time 1 --space physical | prints ^t,y1,y2,phi,y1',y2',phi',g1,D1,E
case: a vakonomic system has the physical space alone
0 | run chaplygin-sleigh-vakonomic --integrator rk4 --step 0.1 --time 1 | prints ^t,y1,y2,phi,y1',y2',phi',g1,D1,E
END
try 2 run chaplygin-sleigh-vakonomic --integrator rk4 --step 0.1 --time 1 --space lifted

case_is "N is 100 when nothing is said"
try 0 run ./line.yaml --integrator rk4 --step 0.01 --time 1
expect "102 lines" count out 102
silent

case_is "rows where steps divide the distances, and where not"
for step in 0.1 0.05 0.03 0.7 1; do
    try 0 run ./line.yaml --integrator rk4 --step $step --time 1 --samples 10
    expect "12 lines, step $step" count out 12
    expect "first row at 0, step $step" [ "$(sed -n '2s/,.*//p' out)" = 0 ]
    expect "last row at 1, step $step" [ "$(sed -n '12s/,.*//p' out)" = 1 ]
    expect "times, step $step" rows out '$1 - (NR - 2)/10 < 1e-15 && (NR - 2)/10 - $1 < 1e-15'
done

case_is "the last row is exactly T"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 0.7 --samples 7
expect "last row" [ "$(tail -1 out | cut -d, -f1)" = 0.69999999999999996 ]

case_is "1e1 is an integer"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --samples 1e1
expect "12 lines" count out 12

case_is "the exact solution"
try 0 run ./line.yaml --integrator gauss8 --step 0.01 --time 1
expect "x = 1 - exp(-t)" rows out '($2 - 1 + exp(-$1))^2 < 1e-26 && $NF < 1e-13'
expect "the invariant is 1" rows out '($(NF - 1) - 1)^2 < 1e-26'
try 0 run chaplygin-sleigh --integrator gauss8 --step 0.01 --time 1
expect "circle (nh30)" rows out '($2 - sin($1))^2 < 1e-26 && ($3 - 1 + cos($1))^2 < 1e-26'

case_is "on the surface p, pi and H are 0, and 0 has no sign"
expect "zeros" rows out '$9 == "0" && $12 == "0" && $15 == "0"'
refute "no -0" grep -Eq "(^|,)-0(,|$)" out
cat >minus.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2
invariants: {minus: -x'}
END
try 0 run ./minus.yaml --integrator rk4 --step 0.1 --time 1 --start x=-0
refute "no -0" grep -Eq "(^|,)-0(,|$)" out

case_is "17 digits come back as they were"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --samples 1 --start x=0.1
expect "0.1" [ "$(sed -n 2p out | cut -d, -f2)" = 0.10000000000000001 ]

case_is "parameters and starts"
try 0 run ./line.yaml --integrator gauss8 --step 0.01 --time 1 --set k=2
expect "x = (1 - exp(-2t))/2" rows out '($2 - (1 - exp(-2*$1))/2)^2 < 1e-26'
try 0 run ./line.yaml --integrator gauss8 --step 0.01 --time 1 --set k=2 --start "x'=3" \
    --start pi_x=1e-8
expect "v = 3 exp(-2t)" rows out '($3 - 3*exp(-2*$1))^2 < 1e-14'
expect "the start" [ "$(sed -n 2p out | cut -d, -f6)" = 1e-08 ]
try 0 run ./line.yaml --integrator gauss8 --step 0.01 --time 1 --start e=inf --start pi_x=1
expect "1/e = 0: the motion is undisturbed" rows out '($2 - 1 + exp(-$1))^2 < 1e-26'

case_is "files"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1
mv out standard
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --output rows.csv
empty
expect "the same as on stdout" cmp rows.csv standard
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --output -
expect "the same as on stdout" cmp out standard

case_is ".npy"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --output rows.npy
# 10 bytes, 211 of names, filled up to 256, a line of 64; then 101 rows of 11 numbers
expect "size 320 + 101*11*8" [ "$(wc -c <rows.npy)" -eq 9208 ]
expect "magic" [ "$(head -c 10 rows.npy | od -A n -t x1 | tr -d ' \n')" = 934e554d505901003601 ]
names=$(head -1 standard | sed "s/[^,]*/('&', '<f8')/g; s/,(/, (/g; s/'x''/\"x'\"/")
expect "header" [ "$(head -c 320 rows.npy | tail -c +11 | tr -s ' ')" = \
    "{'descr': [$names], 'fortran_order': False, 'shape': (101,), } " ]
tail -c +321 rows.npy | od -A n -v -t f8 -w88 >numbers
tail -n +2 standard | tr , ' ' | paste -d ' ' numbers - >both
expect "numbers" awk '{ for (i = 1; i <= 11; i++) if ($i != $(i + 11)) exit 1 }' both
has_numpy() { /usr/bin/python3 -c "import numpy" 2>/dev/null; }
if needs 1 "no python3 with numpy" has_numpy; then
    expect "numpy has another mind" /usr/bin/python3 -c "
import numpy
npy = numpy.load('rows.npy')
csv = numpy.genfromtxt('standard', delimiter=',', names=True, deletechars='')
assert npy.dtype.names == csv.dtype.names and len(npy) == len(csv)
assert all((npy[name] == csv[name]).all() for name in npy.dtype.names)"
    counted
fi

case_is "summary"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --summary
says '^10 steps, [0-9]+ evaluations, [0-9.]+ ns per step$'
says '^E +0.067667[0-9]* +0\.5 '
says '^\|p\| +0 .* exact +none$'
says '^error '
expect "the rows are the same" cmp out standard

case_is "no locale matters"
for locale in de_DE.UTF-8 C.UTF-8; do
    LC_ALL=$locale "$program" run ./line.yaml --integrator rk4 --step 0.1 --time 1 >out 2>err
    expect "rows under $locale" cmp out standard
done

case_is "a message comes after the rows, also in one stream"
"$program" run chaplygin-sleigh-nonlinear --integrator rk4 --step 0.01 --time 2 >both 2>&1
expect "rows, then the message" awk '
    NR > 1 && !/^dalembert: / && !/^[0-9].*,[0-9]/ { bad = 1 }
    /^dalembert: / { at = NR }
    END { exit bad || at != NR || NR < 50 }' both

case_is "names that are words"
try 0 run ./plane.yaml --integrator rk4 --step 0.1 --time 1
mv out system
try 0 run ./plane.yaml --integrator rk4 --step 0.1 --time 1 --names system
expect "another header" cmp out system
try 0 run ./plane.yaml --integrator rk4 --step 0.1 --time 1 --names plain
expect "header" [ "$(head -1 out)" = "t,x,y,vx,vy,e,p_x,p_y,pi_x,pi_y,pi_e,D1,E,H" ]
sed 1d system >system.rows
sed 1d out | cmp - system.rows >compared
expect "other rows" test ! -s compared
try 0 section pendulum-cvt --on 'sin(xi)' --integrator gni --step 0.1 --time 20 --names plain \
    --axes "xi,xi'" --output section.csv
expect "header" [ "$(head -1 section.csv)" = "crossing,t,direction,xi,x,y,vxi,vx,vy" ]
try 2 run ./plane.yaml --integrator rk4 --step 0.1 --time 1 --names pandas
says "^dalembert: --names: 'pandas' is not one of system\|plain$"
try 2 order line.yaml --names plain
says "unknown option '--names'"

case_is "names that are words: resumed, and reported"
words="chaplygin-sleigh --integrator gauss8 --step 0.001 --time 200 --samples 20001"
try 0 run $words --names plain --output plain.npy
if needs 2 "no compiler for signals at given places" raises; then
    cut_off 137 9 6 run $words --names plain --output plain --checkpoint 0
    try 0 resume plain
    counted
else
    try 0 run $words --names plain --output plain
fi
expect "the names are not kept" cmp plain.npy plain/trajectory.npy
try 0 run $words --output primed
for directory in plain primed; do
    try 0 report $directory
    ls $directory/report >$directory.files
done
expect "other figures" cmp plain.files primed.files
for figure in coordinates D E drift; do
    expect "another figure of $figure" cmp plain/report/$figure.gp primed/report/$figure.gp
done

case_is "names that another column has"
cat >twice.yaml <<'END2'
coordinates: [x, vx]
lagrangian: (x'^2 + vx'^2)/2
start: {x': 1}
END2
cat >invariant.yaml <<'END2'
coordinates: [v, x]
lagrangian: (v'^2 + x'^2)/2
start: {x': 1}
invariants: {vx: x'}
END2
for system in twice invariant; do
    for output in - place place.npy; do
        try 2 run ./$system.yaml --integrator rk4 --step 0.1 --time 1 --names plain --output $output
        says "^dalembert: --names plain: x' would be 'vx', another column$"
        empty
        expect "$output was made" test ! -e $output
    done
    try 0 run ./$system.yaml --integrator rk4 --step 0.1 --time 1
done
sed -i '/^invariants/d' invariant.yaml
try 0 run ./invariant.yaml --integrator rk4 --step 0.1 --time 1 --names plain --space physical
expect "header" [ "$(head -1 out)" = "t,v,x,vv,vx,E" ]
cat >also.yaml <<'END2'
coordinates: [x]
lagrangian: x'^2/2
start: {x': 1}
invariants: {v: x'}
END2
try 0 run ./also.yaml --integrator rk4 --step 0.1 --time 1 --names plain --columns "x',v" --output some
expect "header" sh -c "head -c 8192 some/trajectory.npy | grep -aq \"[[(]'t', '<f8'), ('vx', '<f8'), ('v', '<f8')\""
try 0 report some
