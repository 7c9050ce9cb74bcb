# `dalembert check`: what it finds, and that it finds what is wrong.

case_is "every built-in system passes"
"$program" list systems --markdown | sed -n 's/^| `\([a-z-]*\)` .*/\1/p' >systems
holds "fewer than 11 systems" test "$(wc -l <systems)" -ge 11
while read -r system; do
    try 0 check "$system"
    prints '^[0-9]+ items, 0 failed$'
    holds "$system: a FAIL" sh -c '! grep -q FAIL out'
    silent
done <systems

case_is "the sleigh: n = 3, D trigonometric, E on D = 0 alone"
try 0 check chaplygin-sleigh
prints '^  rank of G at the start +ok +1 of 1'
prints '^  D affine in v +ok +yes$'
prints '^  D bilinear in \(q,v\) +info +no$'
prints '^  D quadratic in \(q,v\) +info +no$'
prints '^  energy E +ok +conserved on D = 0 alone'
prints '^  second-class constraints +ok +rank 6 of 13'
prints '^  first-class constraints +ok +7,'
prints '^  multipliers left free +ok +1 '
prints '^  action \(nh10\) +ok '

case_is "kinds of D"
try 0 check contact-oscillator
prints '^  D bilinear in \(q,v\) +ok +yes$'
prints '^  D is kept by .*symplectic-euler-10'
try 0 check appell-hamel
prints '^  degree of D in v +info +homogeneous of degree D1: 2$'
prints '^  D quadratic in \(q,v\) +ok +yes$'
prints '^  D is kept by .*gauss4'
try 0 check vertical-disk
prints '^  rank of G at the start +ok +2 of 2'
prints '^  second-class constraints +ok +rank 8 of 17'
try 0 check plane.yaml
prints '^  D is kept by +info +every method that acts on the system$'

# Names behind "D is kept by", a modifier around gauss4, symmetric and not of order 2.
keepers() {
    sed -n '/^  D is kept by/,/^$/p' out | sed 's/D is kept by *info//' | tr -s ' ' '\n' |
        sed -n 's/^+/gauss4+/; /^[a-z0-9+-]*[a-z][a-z0-9+-]*$/p'
}
case_is "D is kept by: run accepts each"
while read -r system; do
    try 0 check "$system"
    grep -q 'kept by .*every method' out && continue
    keepers >keepers
    grep -q '^  D is kept by' out && holds "$system: no method" test -s keepers
    while read -r method; do
        "$program" run "$system" --integrator "$method" --step 1e-3 --time 1e-3 >rows 2>refusal
        holds "$system, $method: $(cat refusal)" test $? -ne 2
    done <keepers
done <systems
try 0 check chaplygin-sleigh
keepers >keepers
holds "a thermostat's method on a sleigh" sh -c '! grep -q isokinetic keepers'
holds "no spark4" grep -q '^spark4$' keepers
try 2 run chaplygin-sleigh --integrator isokinetic-splitting --step 0.1 --time 1
try 0 check isokinetic
keepers >keepers
holds "not its method on the thermostat" grep -q isokinetic-splitting keepers
try 0 check chaplygin-sleigh-vakonomic
keepers >keepers
holds "a method of reactions on vakonomic motion" sh -c '! grep -q spark keepers'
try 1 check chaplygin-sleigh --start "y2'=0.5"
prints '^  D is kept by +info +no method: the start violates constraint 1'

case_is "energy and reversal"
try 0 check isokinetic
prints '^  energy E +ok +not conserved'
try 0 check line.yaml
prints '^  F\(q,-v,-t\) = F\(q,v,t\) +info +no'
try 0 check contact-oscillator
prints '^  F\(q,-v,-t\) = F\(q,v,t\) +info +yes'

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
try 1 check chaplygin-sleigh --start "y2'=0.5"
prints '^  \|D\| at the start +FAIL +0\.5'

case_is "no motion from rest"
try 1 check appell-hamel --start "x'=0" --start "y'=0" --start "z'=0"
prints '^  F at the start +FAIL'

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
prints '^  what D is +not measured'
prints '^  energy E +not measured'
prints '^  derivatives +not measured'
prints '^  action \(nh10\) +not measured'
prints '^[0-9]+ items, 1 failed, 11 not measured$'
holds "a number below 0" sh -c '! grep -q -e "  -1 " out'
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
holds 'a verdict without a point' [ "$(grep -c 'on D = 0 *ok' out)" = 0 ]

case_is "e = 0"
try 1 check chaplygin-sleigh --start e=0
prints '^  gauge variable e +FAIL'

case_is "parameters"
try 0 check chaplygin-sleigh --set omega=2 --set v0=3
try 2 check chaplygin-sleigh --set omga=2
says "unknown parameter 'omga'; did you mean 'omega'\?"
try 2 check chaplygin-sleigh --start "phy'=2"
says "unknown start value 'phy''; did you mean 'phi''\?"

case_is "bad arguments of check"
try 2 check
says 'the SYSTEM is missing'
try 2 check knife-edge vertical-disk
says "more than one SYSTEM: 'vertical-disk'"
try 2 check knife-egde
says "did you mean 'knife-edge'\?"
empty

case_is "no constraint, no word of D = 0"
try 0 check damped-oscillator
prints '^  points about the start +ok +8$'
holds "D = 0" test "$(grep -c 'moved onto' out)" -eq 0
