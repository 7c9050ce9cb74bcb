# Holonomic constraints: columns, the projection that is added, starts, both spaces, native code.

cat >pendulum.yaml <<'END'
coordinates: [x, y, z]
parameters: {l: 1.25, g: 2}
lagrangian: (x'^2 + y'^2 + z'^2)/2 - g*z
holonomic: [x^2 + y^2 + z^2 - l^2]
start: {x: 0.75, z: -1, y': 1.5}
END
motion="--integrator gauss4 --step 0.05 --time 2 --samples 4"
added="holonomic constraints drift with this method: .project is added; --bare on leaves it out"

case_is "holonomic: columns"
try 0 run pendulum.yaml $motion --space physical
says "$added"
expect "header" [ "$(head -1 out)" = "t,x,y,z,x',y',z',D1,E,C1" ]
try 0 run pendulum.yaml $motion --columns C,D
expect "group" [ "$(head -1 out)" = "t,D1,C1" ]
try 0 run pendulum.yaml $motion --reactions on --columns h,C1
expect "reactions" [ "$(head -1 out)" = "t,h1,C1" ]

case_is "holonomic: +project is added, once and by name"
try 0 run pendulum.yaml $motion --output own
expect "said more than once" [ "$(grep -c 'is added' err)" = 1 ]
expect "the method is not named" grep -q '"gauss4+project"' own/manifest.json
try 0 run pendulum.yaml $motion --integrator gauss4+project --output named
expect "said without need" [ "$(grep -c 'is added' err)" = 0 ]
expect "other rows" cmp -s own/trajectory.npy named/trajectory.npy
try 0 run pendulum.yaml $motion --bare on --columns C --output bare.csv
expect "said of a bare method" [ "$(grep -c 'is added' err)" = 0 ]
expect "no drift" [ "$(tail -1 bare.csv | awk -F, '{ print ($2 * $2 > 1e-20) }')" = 1 ]

case_is "holonomic: what becomes of g"
try 0 run pendulum.yaml $motion --time 100 --output kept
expect "g is not at rounding" grep -q '^C1,.*,rounding,' kept/summary.csv
try 0 run pendulum.yaml $motion --time 100 --integrator rk4 --bare on --output lost
expect "g' = D grows like t, and g not like t^2" awk -F, '
    $1 == "C1" && $10 > 1.9 && $10 < 2.1 { good = 1 } END { exit !good }' lost/summary.csv

case_is "holonomic: studies say that +project is added"
printf '%s\n' 'integrators: [rk4, gauss4]' 'step: 0.1' 'time: 2' 'starts: physical' 'systems: [pendulum.yaml]' >grid.yaml
try 0 study grid.yaml --output grid
says "^dalembert: pendulum.yaml: holonomic constraints drift with methods of F: .project is added to them"
expect "said more than once" [ "$(grep -c 'is added' err)" = 1 ]
echo 'options: {bare: on}' >>grid.yaml
try 0 study grid.yaml --output bare-grid
refute "said of bare methods" grep -q 'is added' err

case_is "holonomic: studies name methods as they run"
cat >named.yaml <<'END'
integrators: [rk4, gauss4, gauss4+project, rattle]
representatives: [gauss4, rattle]
step: 0.1
time: 2
starts: physical
systems: [pendulum.yaml, {system: chaplygin-sleigh, integrators: [gauss4]}]
expect:
  pendulum.yaml:
    gauss4: {D: rounding}
    rk4+project: {D: rounding}
    all+project: {D: rounding}
END
try 0 study named.yaml --output by-name
says "^dalembert: pendulum.yaml: holonomic constraints drift with methods of F: .project is added to them"
cut -d, -f1,3 by-name/cells.csv | sort >out
expect "$(cat out)" [ "$(grep -c pendulum out)" = 3 ]
prints "^pendulum.yaml,gauss4\+project$"
prints "^pendulum.yaml,rattle$"
prints "^pendulum.yaml,rk4\+project$"
prints "^chaplygin-sleigh,gauss4$"
sed "s#^step#options: {bare: on}\nstep#; /^expect/,\$d" named.yaml >unnamed.yaml
try 0 study unnamed.yaml --output by-bare-name
cut -d, -f1,3 by-bare-name/cells.csv | sort >out
expect "$(cat out)" [ "$(grep -c pendulum out)" = 4 ]
prints "^pendulum.yaml,rk4$"
sed 's/representatives: .*/representatives: [gauss6]/' named.yaml >other.yaml
try 2 study other.yaml --output other-name
says "'gauss6' is not run in this study"

case_is "holonomic: resumed and extended"
try 0 run pendulum.yaml $motion --output short
try 0 resume short --time 4
try 0 run pendulum.yaml $motion --time 4 --samples 8 --output long
expect "other rows" cmp -s short/trajectory.npy long/trajectory.npy

case_is "holonomic: methods that enforce g by themselves"
for method in rattle gauss-spark4; do
    try 0 run pendulum.yaml $motion --integrator $method --time 2 --output $method
    expect "$method: is projected" [ "$(grep -c 'is added' err)" = 0 ]
    try 0 resume $method --time 4
    try 0 run pendulum.yaml $motion --integrator $method --time 4 --samples 8 --output $method-long
    expect "$method: other rows" cmp -s $method/trajectory.npy $method-long/trajectory.npy
    try 0 run pendulum.yaml $motion --integrator $method --precision quad --columns C,D --output quad.csv
    expect "$method: g in quad precision" [ "$(awk -F, 'NR > 1 && ($2 * $2 > 1e-60 || $3 * $3 > 1e-60)' quad.csv | wc -l)" = 0 ]
done

case_is "holonomic: native and generated, same bits"
if needs 18 "no compiler" there cc; then
    for method in gauss4 gauss4+symmetric-project rattle gauss-spark6; do
        for native in off on; do
            try 0 run pendulum.yaml $motion --integrator $method --native $native --space physical \
                --statistics 3 --output "$method-$native"
        done
        for file in trajectory.npy summary.csv; do
            expect "$method: other $file" cmp -s "$method-off/$file" "$method-on/$file"
        done
    done
    try 0 generate pendulum.yaml --integrator gauss4 --prefix pendulum
    mv out pendulum.c
    expect "no observable C1" grep -q '"C1"' pendulum.c
    counted
fi

case_is "holonomic: refused with the reason"
table <<'END'
2 | run pendulum.yaml --integrator gni --step 0.1 --time 1 | says gni cannot act on pendulum: the method enforces D alone
2 | run pendulum.yaml --integrator rk4+project-energy --step 0.1 --time 1 | says .project-energy moves q without regard to its holonomic constraints
2 | run pendulum.yaml --integrator rk4 --step 0.1 --time 1 --start z=-1.1 | says the start violates holonomic constraint 1: C1 = 0.21; the option consistent moves its coordinates to g = 0, and 'solve: .z.'
2 | run pendulum.yaml --integrator rk4 --step 0.1 --time 1 --start pi_x=1 | says take the option bare, with effort constraint
2 | run pendulum.yaml --integrator rk4 --step 0.1 --time 1 --mechanics vakonomic | says vakonomic mechanics takes no holonomic constraints
2 | predict pendulum.yaml --integrator rk4 --step 0.1 --time 1 | says no drift of rk4.* can be predicted: the system has holonomic constraints
2 | lyapunov pendulum.yaml --integrator rk4 --step 0.1 --time 1 --space lifted | says no exponents of the lift by rk4.project
0 | lyapunov pendulum.yaml --integrator rk4 --step 0.1 --time 1 | prints ^exponent 4 
0 | run pendulum.yaml --integrator rk4 --step 0.1 --time 1 --start z=-1.1 --consistent on | says is added
END

case_is "holonomic: check, with Dirac's algebra"
try 0 check pendulum.yaml
prints "rank 6 of 13 x 13 brackets, 2n = 6"
prints "7, 2n.1 = 7"
