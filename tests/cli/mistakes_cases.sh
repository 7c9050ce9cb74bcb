# Mistakes that many users make: the message names what was meant.

cat >skate.yaml <<'END'
coordinates: [x, y, phi]
parameters: {m: 1, J: 1, k: 1}
lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 - k/2*(x^2 + y^2)
constraints:
  - x'*sin(phi) - y'*cos(phi)
start: {x: 1, x': 0.5, phi': 0.7}
END
sed "s/x'^2 + y/xdot^2 + y/" skate.yaml >dot.yaml
sed "s/x'^2 + y/v_x^2 + y/" skate.yaml >spelled.yaml
sed "s/x': 0.5/x': max(0.5, 0)/" skate.yaml >comma.yaml
sed 's/x^2/x**2/' skate.yaml >power.yaml
sed "s/  - x'.*/  - x^2 + y^2 - 1/" skate.yaml >holonomic.yaml
sed 's/phi\]/phi/' skate.yaml >bracket.yaml
cat >blow.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2 + x^4
start: {x: 1}
END
expected() { printf 'integrators: [rk4]\nstep: 0.1\ntime: 1\nsystems: [skate.yaml]\nexpect: {%s: {rk4: {D: exact}}}\n' "$1"; }
expected skate >nearly.yaml
expected knife >nowhere.yaml
mkdir -p folder/manifest.json more
printf '{} x' >more/manifest.json
mkdir colon comma name value letter code list
printf '{"\\q": 1}' >letter/manifest.json
printf '{"\\u12g4": 1}' >code/manifest.json
printf '[1]' >list/manifest.json
awk 'BEGIN { print "t,x,y,phi"; for (t = 0; t <= 1; t += 0.125) print t ",1,0,0" }' >curve.csv
printf '{"a" 1}' >colon/manifest.json
printf '{"a": 1 "b": 2}' >comma/manifest.json
printf '{"a": 1,}' >name/manifest.json
printf '{"a": nul}' >value/manifest.json
run="--integrator rk4 --step 0.1 --time 1"
table <<'END'
case: a file beside its name
2 | run skate $run | says ^dalembert: unknown system 'skate'; there is 'skate.yaml'$
2 | run nofile.txt $run | says ^dalembert: unknown system 'nofile.txt', and no such file; 'dalembert list systems'
case: options of other programs
2 | run skate.yaml --dt 1 | says unknown option '--dt'; did you mean '--step'\?$
2 | run skate.yaml --method rk4 | says unknown option '--method'; did you mean '--integrator'\?$
2 | run skate.yaml -i rk4 | says unknown option '-i'; did you mean '--integrator'\?$
2 | run skate.yaml --tmax 1 | says unknown option '--tmax'; did you mean '--time'\?$
2 | run skate.yaml --tol 1 | says unknown option '--tol'; did you mean '--tolerance'\?$
2 | run skate.yaml --seed 1 | says unknown option '--seed': it draws no random numbers, as 'ensemble' does$
2 | study --progress json | says ^dalembert: study: unknown option '--progress'$
2 | check skate.yaml --dt 1 | says unknown option '--dt'; did you mean '--set'
2 | simulate | says ^dalembert: unknown command 'simulate'; 'dalembert help' lists the commands$
case: values that no option has
2 | order skate.yaml --integrators rk4 --steps 0.1,x --time 1 | says ^dalembert: --steps: 'x' is not a number$
2 | order skate.yaml --integrators rk4 --step 0 --time 1 | says ^dalembert: --step: it must be positive$
2 | predict skate.yaml --integrator rk4 --step $(seq -s, 65) --time 1 | says ^dalembert: more than 64 methods and steps$
2 | explain skate.yaml --integrator rk4 --step 1e-10 --time 1 | says ^dalembert: 1e\+10 steps: explain takes at most 20+$
2 | list --json --markdown | says ^dalembert: list: --json excludes --markdown$
2 | study --shard 1 | says ^dalembert: --shard: '1' is not K/N$
2 | study --shard 1/2x | says ^dalembert: --shard: '1/2x' is not K/N$
2 | merge $(seq 1025) --output there | says ^dalembert: merge: more than 1024 directories$
2 | merge folder --output there | says ^dalembert: 'folder/manifest.json' is a directory$
2 | resume more | says ^dalembert: more/manifest.json:1:4: no JSON: there is more after it$
2 | resume colon | says ^dalembert: colon/manifest.json:1:6: no JSON: a colon is expected$
2 | resume comma | says ^dalembert: comma/manifest.json:1:9: no JSON: a comma or an end is expected$
2 | resume name | says ^dalembert: name/manifest.json:1:9: no JSON: a name in quotes is expected$
2 | resume value | says ^dalembert: value/manifest.json:1:7: no JSON: a value is expected$
2 | resume letter | says ^dalembert: letter/manifest.json:1:[23]: no JSON: the text does not go on so$
2 | resume code | says ^dalembert: code/manifest.json:1:[23]: no JSON: the text does not go on so$
2 | resume list | says ^dalembert: list/manifest.json:1:1: an object is required$
2 | run skate.yaml $run --samples 100000001 --sampling log | says ^dalembert: --samples: 100000001 are too many for
2 | run skate.yaml --integrator rk4 --step 1e-5 --time 5000 --samples 100000001 --sampling steps | says 1 are too many for
2 | ensemble skate.yaml $run --members 2 --seed 1 --vary 'x=normal(0,1)' --quantiles 0.1,few --output there | says ^dalembert: --quantiles: 'few' is not a number$
2 | run skate.yaml $run --sensitivities mass | says ^dalembert: --sensitivities: unknown parameter 'mass'
2 | predict skate.yaml --integrator rk4 --step 0.1,few --time 1 | says ^dalembert: --step: 'few' is not a number$
2 | help run check | alone ^dalembert: only one COMMAND, not also 'check'$
2 | predict skate.yaml --integrator rk5 --step 0.1 --time 1 | alone ^dalembert: unknown integrator 'rk5'; did you mean 'rk4'\?$
2 | predict skate.yaml --integrator rk4 --step few --time 1 | alone ^dalembert: --step: 'few' is not a number$
2 | predict skate.yaml $run --tolerance 1e-30 | alone ^dalembert: --tolerance: 1e-30 is below .*, the smallest in this precision$
2 | order skate.yaml --integrators rk4 --time 1 --tolerance 1e-30 | alone ^dalembert: --tolerance: 1e-30 is below
2 | generate skate.yaml --integrator rk4 --tolerance 1e-30 | alone ^dalembert: --tolerance: 1e-30 is below
case: names that the system lacks
2 | check skate.yaml --set mass=2 | says ^dalembert: unknown parameter 'mass'; there is m, J, k$
2 | action skate.yaml curve.csv --set mass=2 | says ^dalembert: unknown parameter 'mass'; there is m, J, k$
2 | generate skate.yaml --integrator rk4 --start zz=1 | says ^dalembert: skate.yaml: unknown start name 'zz'
2 | explain skate.yaml $run --start zz=1 | says ^dalembert: skate.yaml: unknown start name 'zz'
2 | predict skate.yaml $run --start zz=1 | says ^dalembert: skate.yaml: unknown start name 'zz'
2 | section skate.yaml --on x $run --start zz=1 | says ^dalembert: skate.yaml: unknown start name 'zz'
2 | lyapunov skate.yaml $run --start zz=1 | says ^dalembert: skate.yaml: unknown start name (\(q, v space\) )?'zz'
2 | order skate.yaml --integrators rk4 --time 1 --start zz=1 | says ^dalembert: reference: unknown start value 'zz'
2 | steer skate.yaml --to x=1 $run --start zz=1 | says ^dalembert: skate.yaml: unknown start name 'zz'
2 | ensemble skate.yaml $run --members 2 --seed 1 --vary 'x=normal(0,1)' --start zz=1 --output there | says unknown start name .*'zz'
case: velocities
2 | run skate.yaml $run --columns vy | says no column 'vy'; did you mean 'y''\?$
2 | run skate.yaml $run --start vx=2 | says unknown start name 'vx'; did you mean 'x''\?$
2 | run dot.yaml $run | says ^dalembert: dot.yaml:3:18: lagrangian: unknown name 'xdot'; did you mean 'x''\?$
2 | run spelled.yaml $run | says unknown name 'v_x'; did you mean 'x''\?$
case: files
2 | run comma.yaml $run | says is not a name: .*; a formula with commas within \{\} or \[\] needs quotes$
2 | run power.yaml $run | says ^dalembert: power.yaml:3:52: lagrangian: a power is written \^, not \*\*$
2 | run holonomic.yaml $run | says :5:5: constraint 1 does not depend on the velocities; f\(q\) = 0 belongs under holonomic
2 | run bracket.yaml $run | says is not a name: .*; is a bracket not closed\?$
2 | run skate.yaml $run --set mass=2 | says unknown parameter 'mass'; there is m, J, k$
2 | study skate.yaml | says ^dalembert: 'skate.yaml' is a system, not a study: 'dalembert run skate.yaml' runs it$
2 | study nearly.yaml --output there | says unknown label of this study 'skate'; did you mean 'skate.yaml'\?$
2 | study nowhere.yaml --output there | says unknown label of this study 'knife'; there is 'skate.yaml'$
2 | report nodir | says ^dalembert: there is no directory 'nodir'$
2 | resume nodir | says ^dalembert: there is no directory 'nodir'$
2 | resume skate.yaml | says ^dalembert: 'skate.yaml' is no directory$
3 | run blow.yaml --integrator rk4 --step 0.5 --time 10 | says ^dalembert: a smaller step may help: --step 0.05$
END

case_is "characters of a manifest, by their codes"
mkdir characters
for text in '\u0041\ud83d\ude00=A😀' '\u00e9\u20ac=é€' '\ud83dx=�x' '\ud83d\u0041=�A' '\ude00=�' '\ud83d\ud83d=��'; do
    printf '{"dalembert": "0.4.0", "input": {"system": "system.yaml", "%s": 1}}' "${text%=*}" >characters/manifest.json
    try 2 resume characters
    says "unknown option '${text#*=}' of a run\$"
done
printf '{"dalembert": "0.4.0", "input": {"system": "system.yaml", "step": [1]}}' >characters/manifest.json
try 2 resume characters
says '^dalembert: characters/manifest.json:1:67: step: a single value is required$'
