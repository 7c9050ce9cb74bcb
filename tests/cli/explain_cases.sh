# explain: the error sources of a drift.

# is_narrow: 80 columns.
is_narrow() { awk 'length($0) > 80 { exit 1 }' out; }

case_is "explain: truncation of rk4 on the sleigh"
sleigh="chaplygin-sleigh --integrator rk4 --space physical --step 0.1 --time 30 --quad-steps 200"
try 0 explain $sleigh
silent
tr -s ' \n' ' ' <out >sentences
expect "a sentence first" grep -Eq '^D1 drifts by truncation \(100 %\): halve the step and it falls by 1[56]' sentences
expect "what E has from D" grep -Eq ' E drifts by truncation \(100 %\), because D does: halve the step' sentences
expect "what +project does" grep -Eq ' With \+project: D1 at rounding, E at [0-9.e-]+ of this, ' sentences
prints "^ +truncation +rounding +\+project$"
prints "^  D1 +100 % +< 0\.1 % +[0-9]e-[0-9]+$"
prints "^exact: spin$"
expect "what was run" grep -q \
    "chaplygin-sleigh, rk4, physical, h = 0.1: 300 steps, the first 200 in quad precision too; reference: dop853 to 1e-16. The runs compared: --details" sentences
expect "a line is wider than 80 columns" is_narrow
expect "more than 24 lines" test "$(wc -l <out)" -le 24

case_is "explain: +project improves a quantity after ones that it does not"
try 0 explain chaplygin-sleigh-offset --integrator rk4
prints '^With \+project: D1 at rounding, (.* of this, )?turn at [0-9.]+ of this\.$'

# t is a sum of steps of 1/8, which is exact: what +project leaves of no error is no number.
case_is "explain: a quantity that the motion alone changes"
cat >clock.yaml <<'END'
coordinates: [x, y, z]
lagrangian: (x'^2 + y'^2 + z'^2)/2 - y^2
constraints: [z' - y*x']
start: {x': 1, y: 1, z': 1}
invariants: {clock: t}
END
try 0 explain clock.yaml --integrator rk4 --step 0.125 --time 8
prints '^  clock +100 % +- +- +-$'
prints '^  D1 +- +100 % .* [0-9]e-[0-9]+$'

case_is "explain: --details"
try 0 explain $sleigh --details
silent
expect "the same sentences first" sh -c 'tr -s " \n" " " <out | grep -qF "$(sed "s/ *chaplygin-sleigh, .*//" sentences)"'
prints "^D1: size larger, trend "
prints "^  truncation    100 % .* in quad precision the .*$"
expect "the order of truncation" sh -c 'tr -s " \n" " " <out | grep -Eq "falls by 1[56][^ ]* = 2\^[34]\.[90][^ ]* when the step is halved"'
prints "^    half the step "
prints "^not run: equations solved less far: the method solves no equations$"
expect "a line is wider than 80 columns" is_narrow

# x'' = -x: rk4 multiplies E by 1 - h^6/72 + h^8/576 in each step, which is 2^5 per unit of time when
# h is halved, and friction takes exp(-c t) of it.
case_is "explain: an oscillator, with friction and without"
printf "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n" >spring.yaml
sed "s/^start/forces: {x: -0.1*x'}\nstart/" spring.yaml >friction.yaml
try 0 explain spring.yaml --integrator rk4 --step 0.1 --time 100
tr -s ' \n' ' ' <out >sentences
expect "truncation" grep -Eq '^E drifts by truncation \(100 %\): halve the step and it falls by 3[12]' sentences
try 0 explain friction.yaml --integrator rk4 --step 0.1 --time 40
tr -s ' \n' ' ' <out >sentences
expect "friction" grep -Eq '^E changes by the motion itself \(100 %\); truncation is [0-9.e-]+ %: halve the step and it falls by ' sentences
prints "^ +motion +truncation +rounding$"
try 0 explain friction.yaml --integrator rk4 --step 1.25 --time 40
tr -s ' \n' ' ' <out >sentences
expect "both" grep -Eq '^E changes by the motion itself \([0-9]+ %\) and truncation \([0-9.]+ %\): halve the step and truncation falls by ' sentences

case_is "explain: CSV"
try 0 explain chaplygin-sleigh --integrator gauss8 --space physical --step 0.1 --time 30 \
    --solver-tolerance 1e-8 --quad-steps 200 --output why.csv
silent
empty
expect "heads" grep -q '^observable,kind,name,steps,share,margin,rate,rate_low,rate_high,deviation,size,trend,confidence,words$' why.csv
sed 's/"[^"]*"/words/' why.csv >plain.csv
expect "columns" awk -F, 'NF != 14 { exit 1 }' plain.csv
expect "the solver's share" awk -F, '$1 == "D1" && $3 == "solver" && $5 > 0.99 { found = 1 } END { exit !found }' why.csv
expect "rows" awk -F, '$1 == "D1" { n[$2]++ } END { exit !(n["run"] == 10 && n["source"] == 7) }' why.csv
expect "shares between 0 and 1" awk -F, '$2 == "source" && $5 != "" && !($5 >= 0 && $5 <= 1) { exit 1 }' plain.csv
expect "shares that add up to 1" awk -F, '$2 == "source" && $3 != "projection" { sum[$1] += $5 }
    END { for (i in sum) { n++; if (sum[i] > 0 && (sum[i] < 1 - 1e-9 || sum[i] > 1 + 1e-9)) exit 1 } exit n < 4 }' plain.csv
try 0 explain chaplygin-sleigh --integrator gauss8 --space physical --step 0.1 --time 30 \
    --solver-tolerance 1e-8 --quad-steps 200 --output -
expect "other rows on standard output" cmp -s out why.csv

# What is no number has no error sources.
case_is "explain: not finite"
cat >nowhere.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2 - x^4
start: {x': 1}
invariants: {never: log(-1 - x^2), later: log(0.5 - x)}
END
try 0 explain nowhere.yaml --integrator rk4 --step 0.1 --time 10 --quad-steps 50 --output nowhere.csv
expect "shares" awk -F, '($1 == "never" || $1 == "later") && $2 == "source" {
    n++; if ($5 != "" || $NF != "it is not finite") exit 1 } END { exit n != 14 }' nowhere.csv
try 0 explain nowhere.yaml --integrator rk4 --step 0.1 --time 10 --quad-steps 50
expect "a ratio that is none" sh -c '! grep -q nan out'

case_is "explain: no quad precision"
try 0 explain line.yaml --integrator rk4 --step 0.1 --time 10 --quad-steps 0 --details
prints "no quad precision: not requested"

case_is "explain: a tolerance without a step"
try 0 explain chaplygin-sleigh --integrator dop853 --tolerance 1e-8 --space physical --time 30 --quad-steps 0 --details
tr -s ' \n' ' ' <out >sentences
expect "what was run" grep -q "chaplygin-sleigh, dop853, physical, h = 0.3, tolerance 1e-08: 100 steps; " sentences
prints "^    substeps half as long "

# E is conserved by an identity, and rk4 is of order 1 in steps across x = 0, where F jumps.
case_is "explain: a kink"
cat >kink.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2 - abs(x)
start: {x: 1}
invariants: {twice: x'^2 + 2*abs(x)}
END
try 0 check kink.yaml
prints '^  energy E +ok +conserved on every level of D$'
prints '^  invariant twice +ok '
for quad in 5000 0; do
    try 0 explain kink.yaml --integrator rk4 --step 0.01 --time 50 --quad-steps $quad
    tr -s ' \n' ' ' <out >sentences
    for name in E twice; do
        expect "$name by branches" grep -Eq "$name +(drifts|varies) by truncation at branches \(100 %\): halve the step and it falls by [12]" sentences
    done
    expect "the motion itself" sh -c '! grep -q motion sentences'
done

# Coulomb's friction: where it sticks, F jumps to and fro.
case_is "explain: no exact motion"
printf "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nforces: {x: -0.1*sign(x')}\nstart: {x: 1}\n" >sticks.yaml
try 0 explain sticks.yaml --integrator rk4 --step 0.01 --time 20 --quad-steps 50
tr -s ' \n' ' ' <out >sentences
expect "why there is none" grep -q ' no exact motion: too many substeps ' sentences
expect "a line is wider than 80 columns" is_narrow
try 0 explain sticks.yaml --integrator rk4 --step 0.01 --time 20 --quad-steps 50 --json
prints '"name": "exact-motion", "reason": '

case_is "explain: many observables"
{
    printf "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\ninvariants:\n"
    for k in 1 2 3 4 5 6 7 8 9 10; do echo "  a_name_as_long_as_this_$k: x + $k*x'"; done
} >many.yaml
try 0 explain many.yaml --integrator rk4 --step 0.1 --time 10 --quad-steps 0
expect "a line is wider than 80 columns" is_narrow
expect "more than 24 lines" test "$(wc -l <out)" -le 24
prints '^\.\.\. and 5 more: --details$'
try 0 explain many.yaml --integrator rk4 --step 0.1 --time 10 --quad-steps 0 --details
tr -s ' \n' ' ' <out >sentences
expect "the last one" grep -q 'a_name_as_long_as_this_10 changes by ' sentences
expect "a line is wider than 80 columns" is_narrow

case_is "explain: no step"
try 2 explain line.yaml --integrator rk4 --time 1
says "^dalembert: --step is missing"

case_is "explain: bad input"
table <<'END'
2 | explain line.yaml --integrator rk4 --step 0.1 | says --time is missing
2 | explain chaplygin-sleigh --integrator rk5 --step 0.1 --time 1 | says did you mean 'rk4'
2 | explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --samples 5 | says unknown option '--samples'
2 | explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --output why.txt | says does not end in .csv
2 | explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --quad-steps -1 | says not in 0
4 | explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --output /nowhere/why.csv | says cannot write
END

case_is "explain: a run that fails"
try 3 explain chaplygin-sleigh --integrator implicit-midpoint --step 0.1 --time 1 --iterations 1
says "did not converge"
empty

case_is "what single steps predict"
try 0 explain pendulum-cvt --integrator rk4 --step 0.05 --time 20 --quad-steps 0
prints '^Predicted by single steps: D1 .* \(run '
try 0 explain pendulum-cvt --integrator rk4 --step 0.05 --time 20 --quad-steps 0 --json
mv out explained
try 0 predict pendulum-cvt --integrator rk4 --step 0.05 --time 20 --json
expect "the changes of predict" json out "
    [o['change'] for o in d['predictions'][0]['observables']]
    == [o['predicted'] for o in __import__('json').load(open('explained'))['observables']
        if o['name'] in ('D1', 'E', 'Hf', 'driver', 'lnHf')]"
try 0 explain pendulum-cvt --integrator gni --step 0.05 --time 20 --quad-steps 0 --json --space physical
expect "null where nothing can be predicted" json out "{o['predicted'] for o in d['observables']} == {None}"
