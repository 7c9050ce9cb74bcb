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
prints '^  D is kept by +info +every method$'

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

case_is "no point on D = 0: nothing is said of it"
try 1 check chaplygin-sleigh --set m=0
prints '^  rank of G at the start +FAIL'
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
