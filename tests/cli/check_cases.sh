# `dalembert check`: what it finds, and that it finds what is wrong.

case_is "every built-in system passes"
"$program" list systems --markdown | sed -n 's/^| `\([a-z-]*\)` .*/\1/p' >systems
expect "fewer than 11 systems" test "$(wc -l <systems)" -ge 11
mkdir checked
while read -r system; do
    try 0 check "$system"
    prints '^[0-9]+ items, 0 failed$'
    refute "$system: a FAIL" grep -q FAIL out
    expect "$system: a line of more than 80 columns" awk 'NR > 2 && length($0) > 80 { exit 1 }' out
    silent
    mv out "checked/$system"
done <systems

case_is "what is checked comes first"
cat >pair.yaml <<'END'
title: two of three
coordinates: [x, y, z]
lagrangian: (x'^2 + y'^2 + z'^2)/2
constraints: [x' - y', y' - 2*z']
mechanics: vakonomic
reference: nobody 1900
END
"$program" check pair.yaml >out 2>err
printf '%s\n' 'pair: two of three' '3 coordinates, 2 constraints, 2 multipliers (vakonomic); nobody 1900' '' start >head
expect "another head" sh -c 'head -n 4 out | cmp head'
try 0 check plane.yaml
printf '%s\n' plane '2 coordinates, 1 constraints' '' start >head
expect "another head without title and reference" sh -c 'head -n 4 out | cmp head'

case_is "the sleigh: n = 3, D trigonometric, E on D = 0 alone"
try 0 check chaplygin-sleigh
prints '^  rank of G at the start +ok +1 of 1'
prints '^  rank of A at the start +ok +1 of 1'
prints '^  rank of W on ker A +ok +2 of 2'
prints '^  D affine in v +ok +yes$'
prints '^  D bilinear in \(q,v\) +info +no$'
prints '^  D quadratic in \(q,v\) +info +no$'
prints '^  energy E +ok +conserved on D = 0 only'
prints '^  second-class constraints +ok +rank 6 of 13 x 13 brackets'
prints '^  first-class constraints +ok +7,'
prints '^  free multipliers +ok +1 '
prints '^  action int e/2 .* +ok '

case_is "kinds of D"
try 0 check contact-oscillator
prints '^  D bilinear in \(q,v\) +ok +yes$'
prints '^  D is preserved by .*symplectic-euler-10'
try 0 check appell-hamel
prints '^  homogeneity of D in v +info +D1 of degree 2$'
prints '^  D quadratic in \(q,v\) +ok +yes$'
prints '^  D is preserved by .*gauss4'
try 0 check vertical-disk
prints '^  rank of G at the start +ok +2 of 2'
prints '^  second-class constraints +ok +rank 8 of 17 x 17 brackets'
prints '^  growth vector of D = 0 +info +\(2, 3, 4\) on q: nonholonomic, every'
prints '^  refused +info +isokinetic-splitting: the system has'
prints '^  E is preserved by +info +.*discrete-gradient'
try 0 check appell-hamel
prints '^  growth vector of D = 0 +info +none: constraint 1 is not linear in'
try 0 check plane.yaml
prints '^  growth vector of D = 0 +info +\([0-9]\) on q: integrable, D is holonomic$'
prints '^  D is preserved by +info +every method that applies$'

case_is "integrable constraints: holonomic is proposed, with the integral where it is found"
rows_of() { # CONSTRAINTS VELOCITIES
    printf '%s\n' 'coordinates: [x, y, z]' "lagrangian: (x'^2 + y'^2 + z'^2)/2 - z" "constraints: $1" \
        "start: {x: 3, y: 4, z: -1${2:-}}" >rows.yaml
    try 0 check rows.yaml --json
}
proposal="in its place keeps this 0"
rows_of "[x*x' + y*y']"
prints "constraint 1.*integrable: 'holonomic: .x\^2 \+ y\^2 - 25.' $proposal"
rows_of "[z' - y*x', exp(y)*(z' + 2*y')]"
prints "constraint 2.*integrable: 'holonomic: .2\*y \+ z - 7.' $proposal"
refute "a contact form" grep -q '"constraint 1"' out
rows_of "[y' - t*x' - x]" ", y': 3"
prints "constraint 1.*integrable: 'holonomic: .y - x\*t - 4.' $proposal"
rows_of "[x*y' - y*x']"
prints "constraint 1.*integrable: 'holonomic: .x\*.1/y. - 0.75.' $proposal"
rows_of "[z' - exp(x)*x']"
prints "constraint 1.*integrable, the derivative of a g.q, t. up to a factor: 'holonomic: .g.' in its"
for row in "y' - t*x'" "z' - y*x'" "z' - y" "x*y' - y*x' + z'"; do
    rows_of "[$row]" ", z': $([ "$row" = "z' - y" ] && echo 4 || echo 0)"
    refute "$row" grep -q '"constraint 1"' out
done
sed -i "s/^constraints.*/constraints: [x*x' + y*y']/" rows.yaml
try 0 check rows.yaml
sed "s/^constraints.*/holonomic: [x^2 + y^2 - 25]/" rows.yaml >place.yaml
try 0 run place.yaml --integrator rk4 --step 0.1 --time 1 # it begins on g = 0
try 0 check place.yaml
refute "a row of holonomic" grep -q '^  constraint 1' out
try 0 check servo-pendulum # it pushes along other directions than holonomic does
refute "a servo constraint" grep -q '^  constraint 1' out

# preserving FILE: the names after "D is preserved by", a modifier around gauss4, symmetric and not of order 2.
preserving() {
    sed -n '/^  D is preserved by/,/^$/p' "$1" | sed 's/D is preserved by *info//' | tr -s ' ' '\n' |
        sed -n 's/^+/gauss4+/; /^[a-z0-9+-]*[a-z][a-z0-9+-]*$/p'
}
case_is "D is preserved by: run accepts each"
while read -r system; do
    grep -q 'preserved by .*every method' "checked/$system" && continue
    preserving "checked/$system" >methods
    grep -q '^  D is preserved by' "checked/$system" && expect "$system: no method" test -s methods
    while read -r method; do
        "$program" run "$system" --integrator "$method" --step 1e-3 --time 1e-3 >rows 2>refusal
        expect "$system, $method: $(cat refusal)" test $? -ne 2
    done <methods
done <systems
preserving checked/chaplygin-sleigh >methods
refute "a thermostat's method on a sleigh" grep -q isokinetic methods
expect "no spark4" grep -q '^spark4$' methods
try 2 run chaplygin-sleigh --integrator isokinetic-splitting --step 0.1 --time 1
preserving checked/isokinetic >methods
expect "not its method on the thermostat" grep -q isokinetic-splitting methods
preserving checked/chaplygin-sleigh-vakonomic >methods
refute "a method of reactions on vakonomic motion" grep -q spark methods
try 1 check chaplygin-sleigh --start "y2'=0.5"
prints '^  D is preserved by +info +no method: the start violates'

# D with constant coefficients is preserved by every method, a bilinear one by partitioned Euler, a quadratic one by
# Gauss, a trigonometric one by what enforces it (docs/theory.md); without a constraint there is none to preserve.
case_is "D is preserved by: each method in JSON"
preserves_D() { grep -q "\"integrator\": \"$1\", \"accepted\": true, .*\"preserves\": \[\"D\"" out; }
# D_of SYSTEM METHOD...: those alone of the methods named preserve D.
D_of() {
    system=$1
    shift
    try 0 check "$system" --json
    for method in rk4 gauss4 symplectic-euler-10 spark4 gni +project; do
        case " $* " in
        *" $method "*) expect "$system: $method does not preserve D" preserves_D "$method" ;;
        *) expect "$system: $method preserves D" eval '! preserves_D "$method"' ;;
        esac
    done
}
D_of ./plane.yaml rk4 gauss4 symplectic-euler-10 spark4 gni +project
D_of contact-oscillator gauss4 symplectic-euler-10 spark4 gni +project
D_of appell-hamel gauss4 spark4 gni +project
D_of chaplygin-sleigh spark4 gni +project
D_of damped-oscillator

# An empty line is before each section and before the sum, and nowhere else.
case_is "empty lines between sections"
try 0 check chaplygin-sleigh
expect "empty lines" awk 'NR < 3 { next }
    { begins = $0 ~ /^[^ ]/; if (begins != (empty && $0 != "") || (empty && $0 == "")) wrong = 1; empty = $0 == "" }
    begins { sections++ }
    END { exit wrong || empty || sections < 5 }' out

case_is "energy and reversal"
try 0 check unequal-springs
prints '^  branches, lagrangian +info +F.? jumps: order 2 across it$'
cat >wall.yaml <<'END'
coordinates: [x]
lagrangian: x'^2*(1 + (x > 0))/2
start: {x': 1}
END
try 0 check wall.yaml
prints '^  branches, lagrangian +info +L_v or D jumps: F lacks the impulse$'
for force in 'abs(x^2 + 1)|none changes near the start$' 'max(0, x - 3)^4|F and three derivatives are$'; do
    printf '%s\n' 'coordinates: [x]' "lagrangian: x'^2/2" "forces: {x: \"${force%|*}\"}" >smooth.yaml
    try 0 check smooth.yaml
    prints "^  branches, force on x +info +${force#*|}"
done
cat >hidden.yaml <<'END'
coordinates: [x, max]
lagrangian: (x'^2 + max'^2)/2 - max^2
forces: {x: -sign(x')*max}
END
try 0 check hidden.yaml
prints '^  branches, force on x +info +F jumps: order 1 across it$'
says "^dalembert: hidden.yaml:1:18: warning: coordinate 'max' hides the function of this name\$"
table <<'END'
0 | check isokinetic | prints ^  energy E +ok +not conserved
0 | check line.yaml | prints ^  F\(q,-v,-t\) = F\(q,v,t\) +info +no
0 | check contact-oscillator | prints ^  F\(q,-v,-t\) = F\(q,v,t\) +info +yes
END

case_is "a false invariant"
sed 's/c: .*/c: x}/' line.yaml >false.yaml
try 1 check false.yaml
prints '^  invariant c +FAIL'
prints ' 1 failed$'

case_is "a false exact solution"
sed 's/exact: .*/exact: {x: sin(t)}/' line.yaml >false.yaml
try 1 check false.yaml
prints '^  exact solution at t = 0 +ok'
prints '^  residual of .* FAIL'

case_is "a start off the constraint"
table <<'END'
1 | check chaplygin-sleigh --start "y2'=0.5" | prints ^  \|D\| at the start +FAIL +0\.5
case: no motion from rest
1 | check appell-hamel --start "x'=0" --start "y'=0" --start "z'=0" | prints ^  F at the start +FAIL
END

# D is NaN everywhere, and F is not.
case_is "not measured is not ok"
cat >unmeasured.yaml <<'END'
coordinates: [x, y]
parameters: {k: 1}
lagrangian: (x'^2 + y'^2)/2
constraints: ["x'*cos(y) - y'*sin(y) + log(-k)"]
END
try 1 check unmeasured.yaml
prints '^  F at the start +ok'
prints '^  \|D\| at the start +not measured'
prints '^  dD/dt along F, off D = 0 +not measured +at none of 8 points: '
prints '^  dD/dt along F, on D = 0 +not measured'
prints '^  class of D +not measured'
prints '^  energy E +not measured'
prints '^  derivatives +not measured'
prints '^  action int e/2 .* +not measured'
prints '^[0-9]+ items, 1 failed, 11 not measured$'
refute "a number below 0" grep -q -e "  -1 " out
sed "s/exact: .*/exact: {x: log(-1 - t)}/" line.yaml >false.yaml
try 1 check false.yaml
prints '^  exact solution at t = 0 +not measured'
prints '^  residual of .* not measured'
prints ' 0 failed, 2 not measured$'

case_is "no point on D = 0: nothing is said of it"
try 1 check chaplygin-sleigh --set m=0
prints '^  rank of G at the start +FAIL'
prints '^  dD/dt along F, on D = 0 +not measured'
prints '^  energy E +not measured'
prints '^  invariant speed +not measured'
expect 'a result without a point' [ "$(grep -c 'on D = 0 *ok' out)" = 0 ]

case_is "e = 0"
try 1 check chaplygin-sleigh --start e=0
prints '^  gauge variable e +FAIL'

# In metres times 1/$s.  The motion is right, so nothing may FAIL: a wheel on its circle, a pendulum on a cone,
# given accelerations, of which one is 0, and an orbit in a plane that no coordinate has.
case_is "a coordinate that does not move"
turn=$(awk 'BEGIN { place = 0.9; lean = 0.5; circle = 1.5*sin(place) - 0.4*cos(lean)
    printf "%.17g", sqrt(9.81*0.4^2*cos(lean)/sin(lean)/((0.4^2 + 0.08)*circle + 0.04*0.4*cos(lean))) }')
try 0 check wheel-in-sphere --set turn="$turn"
for s in 1e-9 1 1e9; do
    cat >cone.yaml <<END
coordinates: [x, y, z]
parameters: {s: $s, l: 1.3, h: 0.7, g: 9.81}
lagrangian: 0.3*s^2*(x'^2 + y'^2 + z'^2)/2 - 0.3*g*s*z
holonomic: [(s^2*(x^2 + y^2 + z^2) - l^2)/2]
start: {x: sqrt(l^2 - h^2)/s, z: -h/s, y': sqrt((l^2 - h^2)*g/h)/s}
END
    cat >balance.yaml <<END
coordinates: [x, z]
parameters: {s: $s, k: 21, g: 9.81}
accelerations: {x: -7*x*(1 + s*z), z: -g/s - k*z}
start: {x: 1/s, z: -g/k/s, x': 1/s}
END
    cat >orbit.yaml <<END
coordinates: [x, y, z]
parameters: {s: $s, c: cos(0.3), d: sin(0.3)}
let: {u: c*x - d*z, w: d*x + c*z, r: s*sqrt(u^2 + y^2 + w^2)}
lagrangian: s^2*(x'^2 + y'^2 + z'^2)/2 + 1/r
start: {x: 1/s, y': 1.1/s}
END
    for system in cone balance orbit; do try 0 check $system.yaml; done
done

case_is "energy and degrees of D"
# The mass shell is not homogeneous in v, so D = 0 at midpoints does work: E moves by O(h^2), every other step.
try 0 check relativistic-em
prints '^  E is preserved by +info +\+project-energy$'
moved() {
    "$program" run relativistic-em --integrator discrete-gradient --step $1 --time 0.5 --samples $2 --columns E \
        2>err | awk -F, 'NR == 2 { E = $2 } NR > 2 { d = ($2 - E)^2; if (d > max) max = d } END { print sqrt(max) }'
}
expect "E of relativistic-em" awk "BEGIN { r = $(moved 0.01 50)/$(moved 0.005 100); exit !(r > 3.5 && r < 4.5) }"
# D = y'/x' - tan phi does not change with the length of v.
try 0 check chaplygin-sleigh-nonlinear
prints '^  homogeneity of D in v +info +D1 of degree 0$'

case_is "parameters"
try 0 check chaplygin-sleigh --set omega=2 --set v0=3
try 2 check chaplygin-sleigh --set omga=2
says "unknown parameter 'omga'; did you mean 'omega'\?"
try 2 check chaplygin-sleigh --start "phy'=2"
says "unknown start value 'phy''; did you mean 'phi''\?"

case_is "bad arguments of check"
table <<'END'
2 | check | says the SYSTEM is missing
2 | check knife-edge vertical-disk | says only one SYSTEM, not also 'vertical-disk'
END
try 2 check knife-egde
says "did you mean 'knife-edge'\?"
empty

case_is "equations for a paper"
try 0 check damped-oscillator --latex
expect "no align*" test "$(sed -n '1p;$p' out | tr -d '\n')" = '\begin{align*}\end{align*}'
prints '  \\ddot\{x\} = F_\{x\} &= '
table <<'END'
2 | check skate --latex | says skate
2 | check chaplygin-sleigh --latex --json | says --latex excludes --json and --details
END

case_is "no constraint, no word of D = 0"
try 0 check damped-oscillator
prints '^  points about the start +ok +8$'
expect "D = 0" test "$(grep -c 'projected' out)" -eq 0
