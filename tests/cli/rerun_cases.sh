# Commands that take their request from the directory of a run give what they give with the same options.

sleigh="chaplygin-sleigh --step 0.05 --integrator gauss4"
budget="--quad-steps 40 --details"

# same COMMAND: `try 0 COMMAND` prints what the last `try 0` printed.
same() {
    mv out given
    try 0 "$@"
    expect "$*: other output" cmp -s given out
}

case_is "explain and section of a run"
try 0 run $sleigh --time 4 --from 1 --set m=2 --start "y1'=2" --start e=inf --samples 7 --sampling log \
    --columns q,t --statistics 3 --observe "y1^2" --solver newton --output skate
options="--time 4 --from 1 --set m=2 --start y1'=2 --start e=inf --solver newton"
try 0 explain $sleigh $options $budget
silent
same explain skate $budget
says "^dalembert: skate gives chaplygin-sleigh --integrator gauss4 --from 1 --step 0.05 --solver newton --set m=2 "
says " --start y1'=2 --start e=inf --time 4$"
try 0 section $sleigh $options --on "y2 - 0.3*y1"
expect "no crossings" test "$(wc -l <out)" -gt 1
same section skate --on "y2 - 0.3*y1"
same section skate/ --on "y2 - 0.3*y1"
same section --on "y2 - 0.3*y1" --time 4 -- ./skate

case_is "options replace what a run has"
try 0 section $sleigh --time 5 --from 0.5 --set m=3 --set I=2 --start "y1'=2" --start e=inf --start "phi'=2" --solver newton \
    --on "y2 - 0.3*y1"
same section skate --on "y2 - 0.3*y1" --time 5 --from 0.5 --set m=3 --set I=2 --start "phi'=2"
says "^dalembert: skate gives chaplygin-sleigh --integrator gauss4 --step 0.05 --solver newton --start y1'=2 --start e=inf$"
try 0 explain chaplygin-sleigh $options --integrator rk4 --step 0.1 $budget
same explain skate $budget --integrator rk4 --step 0.1

case_is "a run that counts steps, a list of times, a step that was chosen"
try 0 run $sleigh --steps 63 --from 0.1 --output counted
try 0 explain $sleigh --from 0.1 --time 3.25 $budget
same explain counted $budget
says " --time 3.25$"
try 0 section $sleigh --from 0.1 --steps 63 --on "y1 - 0.5"
same section counted --on "y1 - 0.5"
says " --steps 63$"
try 0 section $sleigh --from 0.1 --time 3.25 --step 0.025 --on "y1 - 0.5"
same section counted --on "y1 - 0.5" --step 0.025
try 0 section $sleigh --from 0.2 --time 3.25 --on "y1 - 0.5"
same section counted --on "y1 - 0.5" --from 0.2
try 0 run $sleigh --times 0,1.5,2.1 --output listed
try 0 section $sleigh --time 2.1 --on "y1 - 0.5"
same section listed --on "y1 - 0.5"
says " --time 2.1$"
try 0 run knife-edge --integrator dop853 --tolerance 1e-9 --time 2 --output chosen
try 0 section knife-edge --integrator dop853 --tolerance 1e-9 --time 2 --on "sin(3*t)"
same section chosen --on "sin(3*t)"
try 0 resume skate --time 4

case_is "the file of a run may change"
cat >spring.yaml <<'END2'
coordinates: [x]
parameters: {k: 1}
lagrangian: (x'^2 - k*x^2)/2
start: {x: 1}
defaults: {time: 3, integrator: gauss4, step: 0.25}
END2
mkdir spring
try 0 run spring.yaml --set k=2 --time 9 --output spring/run
try 0 section spring.yaml --set k=2 --time 9 --on x
expect "no crossings" test "$(wc -l <out)" -eq 5
rm spring.yaml
same section spring/run --on x
says "^dalembert: spring/run gives spring/run/system.yaml --integrator gauss4 --step 0.25 --set k=2 --time 9$"
try 0 section spring/run --on x --output section --json
expect "another request" grep -q '"system": "spring/run/system.yaml"' out
rm spring/run/system.yaml
try 2 section spring/run --on x
says "cannot read 'spring/run/system.yaml': No such file"

case_is "the run of a study"
printf "title: A\nintegrators: [rk4]\nstep: 0.05\ntime: 4\nsystems: [chaplygin-sleigh]\n" >small.yaml
try 0 study small.yaml --no-page --output small
try 0 explain chaplygin-sleigh --integrator rk4 --step 0.05 --time 4 $budget
same explain small/runs/chaplygin-sleigh_rk4_surface_0.05 $budget

case_is "a system and a directory of one name"
try 0 run knife-edge --integrator rk4 --step 0.1 --time 1 --output chaplygin-sleigh
try 0 section ./chaplygin-sleigh --on "x - 0.5"
says "^dalembert: ./chaplygin-sleigh gives knife-edge "
try 0 section chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --on "y1 - 0.5"
silent

case_is "directories that hold no run"
try 0 ensemble chaplygin-sleigh --members 2 --seed 1 --vary 'm=uniform(0,0.1)' --integrator rk4 --step 0.1 --time 1 \
    --no-page --output members
mkdir empty damaged other quad
printf '{"dalembert": ' >damaged/manifest.json
printf '{"dalembert": "0.5.0"}\n' >other/manifest.json
sed 's/"set"/"precision": "quad",\n    "set"/' listed/manifest.json >quad/manifest.json
table <<'END2'
2 | explain empty   | says ^dalembert: 'empty' holds no run: there is no 'empty/manifest.json'$
2 | section empty --on x | says ^dalembert: 'empty' holds no run
2 | explain small   | says ^dalembert: 'small' holds a study: name one of its runs, 'small/runs/\.\.\.'$
2 | explain members | says ^dalembert: 'members' holds an ensemble, not a run$
2 | explain section | says ^dalembert: 'section' holds no run
2 | explain damaged | says ^dalembert: damaged/manifest.json:1:
2 | explain other   | says ^dalembert: other/manifest.json:1:1: there is no input of a run$
2 | explain quad    | says ^dalembert: 'quad' holds a run with --precision quad, which is no option here$
2 | explain skate --integrator rk5 | says unknown
2 | section skate --on nothing     | says nothing
2 | section skate | says ^dalembert: --on is missing; usage: dalembert section SYSTEM\|DIR --on FORMULA
2 | order skate   | says ^dalembert: cannot read 'skate': it is a directory$
END2
