# What a system file gives for a run: its key `defaults`.

case_is "every built-in system runs as it is"
"$program" list systems | awk 'NR > 1 && /^[a-z]/ { print $1 }' >systems
expect "there are systems" test "$(wc -l <systems)" -ge 30
while read -r system <&3; do
    try 0 run "$system"
    says "^dalembert: $system gives --integrator [a-z0-9+-]+ --step [0-9.]+ --time [0-9.]+$"
    expect "$system: other rows" test "$(wc -l <out)" -eq 102
done 3<systems

case_is "they fill only what is absent"
cat >spring.yaml <<'END2'
coordinates: [x]
lagrangian: (x'^2 - x^2)/2
start: {x: 1}
defaults: {time: 3, integrator: gauss4, step: 0.25}
END2
try 0 run spring.yaml --samples 4
says '^dalembert: spring.yaml gives --integrator gauss4 --step 0.25 --time 3$'
mv out taken
try 0 run spring.yaml --samples 4 --integrator gauss4 --step 0.25 --time 3
silent
expect "other rows" cmp taken out
try 0 run spring.yaml --samples 4 --step 0.5 --integrator rk4
says '^dalembert: spring.yaml gives --time 3$'
try 0 run spring.yaml --times 1,2
says '^dalembert: spring.yaml gives --integrator gauss4 --step 0.25$'
expect "not until the last of the times" grep -q '^2,' out
try 0 explain spring.yaml --quad-steps 0
says 'gives --integrator gauss4 --step 0.25 --time 3$'
prints 'gauss4, lifted, h = 0.25: 12 steps'
try 0 section spring.yaml --on x
says 'gives --integrator gauss4 --step 0.25 --time 3$'
expect "another number of crossings" test "$(wc -l <out)" -eq 2
for command in lyapunov volume; do
    try 0 $command spring.yaml
    says 'gives --integrator gauss4 --step 0.25 --time 3$'
    prints 'gauss4, h = 0.25: means over t = 0 .. 3$'
done
try 0 order spring.yaml --integrators rk4
says 'gives --step 0.25 --time 3$'
prints 'at t = 3, lifted'
try 0 order spring.yaml --integrators rk4 --steps 0.5,0.25,0.125 --time 2
silent
try 0 generate spring.yaml
says 'gives --integrator gauss4$'
prints 'spring_gauss4'
try 0 check spring.yaml
silent

case_is "a directory has what was taken"
try 0 run spring.yaml --output held
expect "not in the manifest" grep -q '^    "step": 0.25,$' held/manifest.json
sed -i '/^defaults/d' held/system.yaml
try 2 resume held
try 0 run spring.yaml --output gone --force
sed -i '/"step"/d' gone/manifest.json
try 2 resume gone
says 'step is missing'

case_is "a study does not take them"
printf 'integrators: gauss4\ntime: 3\nsystems: [spring.yaml]\n' >without.yaml
try 2 study without.yaml --output without
says 'the step is missing'

case_is "errors of defaults"
wrong() { # DEFAULTS MESSAGE
    printf "coordinates: [x]\nlagrangian: x'^2/2\ndefaults: {%s}\n" "$1" >wrong.yaml
    try 2 run wrong.yaml --integrator rk4 --step 0.1 --time 1
    says "^dalembert: wrong.yaml:3:$2"
}
wrong 'integrator: rk5' "24: unknown integrator 'rk5'; did you mean 'rk4'"
wrong 'stp: 1' "12: unknown entry of defaults 'stp'; did you mean 'step'"
wrong 'step: -1' "18: step in defaults: '-1' is not a positive number"
wrong 'step: 1, time: inf' "27: time in defaults: 'inf' is not a positive number"
