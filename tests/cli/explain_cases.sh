# explain: the error sources of a drift.

case_is "explain: truncation of rk4 on the sleigh"
try 0 explain chaplygin-sleigh --integrator rk4 --space physical --step 0.1 --time 30 --quad-steps 200
silent
prints "^chaplygin-sleigh, rk4, physical, h = 0.1: 300 steps, the first 200 in quad precision too$"
prints "^reference: the exact motion, by taylor with tolerance 1e-16$"
prints "^D1: "
prints "^  truncation    1 .* in quad precision the .*$"
holds "the order of truncation" sh -c 'tr -s " \n" " " <out | grep -Eq "falls by 1[56][^ ]* = 2\^[34]\.[90][^ ]* when the step is halved"'
holds "a line is wider than 80 columns" awk 'NR > 1 && length($0) > 80 { exit 1 }' out
prints "^exact: spin$"
prints "^not run: equations solved less far: the method solves no equations$"

case_is "explain: CSV"
try 0 explain chaplygin-sleigh --integrator gauss8 --space physical --step 0.1 --time 30 \
    --solver-tolerance 1e-8 --quad-steps 200 --output why.csv
silent
empty
holds "heads" grep -q '^observable,kind,name,steps,share,margin,rate,rate_low,rate_high,deviation,size,trend,confidence,words$' why.csv
sed 's/"[^"]*"/words/' why.csv >plain.csv
holds "columns" awk -F, 'NF != 14 { exit 1 }' plain.csv
holds "the solver's share" awk -F, '$1 == "D1" && $3 == "solver" && $5 > 0.99 { found = 1 } END { exit !found }' why.csv
holds "rows" awk -F, '$1 == "D1" { n[$2]++ } END { exit !(n["run"] == 10 && n["source"] == 5) }' why.csv
try 0 explain chaplygin-sleigh --integrator gauss8 --space physical --step 0.1 --time 30 \
    --solver-tolerance 1e-8 --quad-steps 200 --output -
holds "other rows on standard output" cmp -s out why.csv

# What is no number has no error sources.
case_is "explain: not finite"
cat >nowhere.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2 - x^4
start: {x': 1}
invariants: {never: log(-1 - x^2), later: log(0.5 - x)}
END
try 0 explain nowhere.yaml --integrator rk4 --step 0.1 --time 10 --quad-steps 50 --output nowhere.csv
holds "shares" awk -F, '($1 == "never" || $1 == "later") && $2 == "source" {
    n++; if ($5 != "" || $NF != "it is not finite") exit 1 } END { exit n != 10 }' nowhere.csv
try 0 explain nowhere.yaml --integrator rk4 --step 0.1 --time 10 --quad-steps 50
holds "a ratio that is none" sh -c '! grep -q nan out'

case_is "explain: no quad precision"
try 0 explain line.yaml --integrator rk4 --step 0.1 --time 10 --quad-steps 0
prints "no quad precision: not requested"

case_is "explain: a tolerance without a step, and no Taylor series"
try 0 explain chaplygin-sleigh --integrator dop853 --tolerance 1e-8 --space physical --time 30 --quad-steps 0
prints "^chaplygin-sleigh, dop853, physical, h = 0\.3, tolerance 1e-08: 100 steps$"
prints "^    substeps half as long "
cat >kink.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2 - abs(x)
start: {x: 1}
END
try 0 explain kink.yaml --integrator rk4 --step 0.01 --time 1 --quad-steps 50
tr -s ' \n' ' ' <out >words.txt
holds "another reference" grep -q 'reference: quad precision and half the step: .* has no Taylor series' words.txt
try 0 explain kink.yaml --integrator rk4 --step 0.01 --time 1 --quad-steps 50 --json
prints '"name": "exact-motion", "reason": '
try 2 explain line.yaml --integrator rk4 --time 1
says "^dalembert: --step is missing"

case_is "explain: bad input"
try 2 explain line.yaml --integrator rk4 --step 0.1
says "--time is missing"
try 2 explain chaplygin-sleigh --integrator rk5 --step 0.1 --time 1
says "did you mean 'rk4'"
try 2 explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --samples 5
says "unknown option '--samples'"
try 2 explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --output why.txt
says "does not end in .csv"
try 2 explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --quad-steps -1
says "not in 0"
try 4 explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --output /nowhere/why.csv
says "cannot write"

case_is "explain: a run that fails"
try 3 explain chaplygin-sleigh --integrator implicit-midpoint --step 0.1 --time 1 --iterations 1
says "did not converge"
empty
