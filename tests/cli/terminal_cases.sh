# What a person sees: screens of at most 24 lines that fit a terminal of 80 or 60 columns.  A terminal is a
# pseudo-terminal of `script` (util-linux; Debian's bsdutils), its width set by `stty` (coreutils).

# shown COLUMNS ARGUMENT...: what a terminal of that width shows of the program, colours included, in `out`.  Each
# \r begins the line again, as after a line of progress.
shown() {
    shown_columns=$1
    shift
    script -qec "stty cols $shown_columns rows 50; TERM=xterm '$program' $*" /dev/null </dev/null |
        sed 's/\r$//; s/.*\r//' >out
    : >err
}
escape=$(printf "\\033\\\\[")
# fits COLUMNS [LINES]: no line of `out` is longer, nor are there more.
fits() {
    sed "s/${escape}[0-9;]*m//g" out >plain
    expect "longer than $1: $(awk -v n="$1" 'length($0) > n' plain | head -1)" awk "length(\$0) > $1 { exit 1 }" plain
    expect "$(wc -l <plain) lines" test "$(wc -l <plain)" -le "${2:-24}"
}

sleigh="run chaplygin-sleigh --integrator rk4 --step 0.05 --time 1000"
if needs 26 "no terminal (script, stty)" terminal; then
    case_is "run: a screen instead of rows"
    shown 80 $sleigh
    fits 80
    prints '^chaplygin-sleigh by rk4 on the lift \(14 variables\), h = 0\.05, t = 0 \.\. 1000$'
    prints '^20,000 steps in [0-9.e-]* s$'
    # The exact motion turns at phi' = 1.
    prints "phi' = 1$"
    prints '^  D1  .*linear.*  grows like t: 5\.2e-8 per unit of time,$'
    prints '^  E  .*not stated.*conserved on D = 0 only, and D is not 0;$'
    prints '^ +moved by [0-9][-0-9.e]*$'
    prints '^  H, .*exact'
    prints '^Rows:  -o FILE\.csv, or a pipe$'
    prints '^  dalembert explain chaplygin-sleigh --integrator rk4 '
    expect "no colour" grep -q "$escape" out
    shown 60 $sleigh
    fits 60
    case_is "run: no colours with NO_COLOR"
    script -qec "stty cols 80; NO_COLOR=1 TERM=xterm '$program' $sleigh" /dev/null </dev/null >out
    refute "colours" grep -q "$escape" out
    case_is "run: rows on a terminal on request alone; --summary changes nothing, --details the table"
    shown 80 $sleigh --output -
    prints '^t,y1,y2,phi,'
    shown 80 $sleigh --summary
    fits 80
    prints '^  D1  .*linear'
    shown 130 $sleigh --details
    prints ' exponent +size +trend$'
    case_is "run: a file and a directory are named"
    shown 80 $sleigh -o rows.csv
    prints '^Rows:  101 in rows\.csv$'
    expect "no rows" has_lines rows.csv 102
    shown 80 run chaplygin-sleigh -o sleigh
    fits 80
    prints '^Rows:  101 in sleigh/trajectory\.npy$'
    prints "^dalembert: wrote the directory 'sleigh'$"
    counted
fi

# D of the plane is constant and linear: every method keeps it; rk4 does not keep the sleigh's.
cat >small.yaml <<'END'
title: a small study
integrators: [rk4, gauss4+project]
step: 0.1
time: 20
starts: physical
systems: [chaplygin-sleigh, plane.yaml]
END
{ echo "integrators: [rk4, gauss4, gauss6, spark2, spark4]"; echo "step: 0.1"; echo "time: 1"; echo "starts: physical"
    echo "systems:"
    for system in chaplygin-sleigh chaplygin-sleigh-nonlinear knife-edge plane.yaml vertical-disk contact-oscillator; do
        echo "  - $system"
    done
} >wide.yaml
if needs 37 "no terminal (script, stty)" terminal; then
    case_is "study: names, ok or a size, and what to take"
    shown 80 study small.yaml --output there --force --no-page
    fits 80 23
    prints '^Largest \|D\| and \|E - E0\| until t = 20, h = 0\.1$'
    prints '^a small study: 2 methods x 2 systems, 4 runs in '
    expect "other heads" grep -q '^ *sleigh  *plane$' plain
    expect "other columns" grep -q '^ *D  *E  *D  *E$' plain
    expect "rk4 keeps D" grep -Eq '^rk4 +[1-9]e-[0-9][/?^]? +\([1-9]e-[0-9]\) +ok +' plain
    expect "gauss4+project does not keep D" grep -Eq '^gauss4\+project +ok .* ok +' plain
    expect "others are to be taken" grep -q '^Take for D: *gauss4+project$' plain
    expect "nothing to try next" grep -q 'dalembert explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 20$' plain
    expect "no tables" grep -q '^Tables: there/tables.txt$' plain
    expect "no green for rounding" grep -q "${escape}32mok" out
    case_is "study: what a pipe gets comes with --details, the tables with --tables"
    try 0 study small.yaml --output there --force --no-page
    sed 's/ in [0-9.]* s:/ in S:/; /^A step takes /d' out >piped
    shown 80 study small.yaml --output there --force --no-page --details
    sed "s/${escape}[0-9;]*m//g; s/ in [0-9.]* s:/ in S:/; /^A step takes /d" out >plain
    expect "another screen" cmp piped plain
    shown 80 study small.yaml --output there --force --no-page --tables
    prints '^chaplygin-sleigh: '
    # Names have seven letters at most; one of two bytes takes one column.
    case_is "study: names in UTF-8"
    for label in abcdefghij äöüßäöüßäö; do
        sed "s/^systems: .*/systems: [{system: chaplygin-sleigh, label: $label}, knife-edge]/" small.yaml >letters.yaml
        shown 80 study letters.yaml --output there --force --no-page
        fits 80 23
        sed -n '3s/äöüßäöü/abcdefg/; 3p' plain >"$label"
        expect "$(cat "$label")" grep -Eqx ' +abcdefg +knife' "$label"
    done
    expect "$(cat abcdefghij äöüßäöüßäö)" cmp abcdefghij äöüßäöüßäö
    case_is "study: a short piece of a label is its name before a cut one"
    sed "s/^systems: .*/systems: [{system: chaplygin-sleigh, label: accelerated-sleigh}, {system: plane.yaml, label: horizontal-plane}]/" \
        small.yaml >pieces.yaml
    shown 80 study pieces.yaml --output there --force --no-page
    fits 80 23
    expect "other heads: $(sed -n 3p plain)" grep -Eqx ' +sleigh +plane' plain
    case_is "study: systems that do not fit are counted"
    shown 80 study wide.yaml --output there --force --no-page
    fits 80 23
    expect "other names" grep -q '^ *sleigh  *nonline  *knife  *ok in all$' plain
    prints '^\.\.\. and 3 more systems \(--details\)$'
    # Stiff accuracy enforces D: spark2, spark4.  The six systems have a constraint each.
    expect "other groups" grep -Eq '^Take for D: +spark\*' plain
    expect "spark2 does not keep all" grep -Eq '^spark2 .* 6/6 ' plain
    for columns in 60 40; do
        shown $columns study wide.yaml --output there --force --no-page
        fits $columns 23
        prints '^\.\.\. and [0-9] more systems'
    done
    counted
fi

# y' = 2 y is not what `exact` and the invariant say.
cat >wrong.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2 - x^2/2
start: {x: 1}
invariants: {pace: x'}
exact: {x: cos(2*t)}
END
if needs 34 "no terminal (script, stty)" terminal; then
    case_is "check: the result, what is conserved, which methods keep it"
    shown 80 check chaplygin-sleigh
    fits 80
    prints '^3 coordinates, 1 constraint, growth \(2, 3\) on q: nonholonomic'
    prints '^ok: [0-9]+ checks of '
    prints '^  Conserved +E: conserved on D = 0 only; speed; spin$'
    prints '^  D is kept by +spark\*, gauss-spark\*, '
    prints '^  Refused +isokinetic-splitting: '
    prints '^Take gauss-spark4 to begin with\.$'
    for columns in 60 45; do
        shown $columns check chaotic-oscillators
        fits $columns
    done
    case_is "check: what failed comes first, with its likely cause"
    script -qec "stty cols 80; '$program' check wrong.yaml; echo status \$?" /dev/null </dev/null | sed 's/\r$//' >out
    fits 80 25
    prints '^FAIL: invariant pace: '
    prints '^FAIL: residual of q. = v, v. = F: '
    prints '^    see exact: it does not solve the equations of motion$'
    prints '^2 of [0-9]+ checks failed\.$'
    prints '^status 1$'
    case_is "check: what a pipe gets comes with --details"
    try 0 check chaplygin-sleigh
    mv out piped
    shown 80 check chaplygin-sleigh --details
    expect "other bytes" cmp piped out
    case_is "section: the first crossings, as many columns as fit"
    # The oscillator x = cos t crosses x = 0 at t = pi/2 + k pi, 32 times until t = 100: downwards first.
    sed -i '/exact\|invariants/d' wrong.yaml
    crossings="section wrong.yaml --on x --integrator gauss8 --step 0.1 --time 100"
    for columns in 80 40; do
        shown $columns $crossings
        fits $columns
        prints '^16 upwards, 16 downwards, 0 touches$'
        prints '^ 1 +1\.5708  down '
        prints '^\.\.\. and 20 more \(--details\)$'
    done
    prints '^[0-9]+ more columns: --details'
    try 0 $crossings
    mv out piped
    shown 80 "$crossings --details 2>/dev/null"
    expect "other rows" cmp piped out
    counted
fi

if needs 15 "no terminal (script, stty)" terminal; then
    case_is "order: errors on the lift, as many columns as fit"
    # The exact solution has x' = 1: rk4 has order 4, gni, which has no lift, order 2.
    shown 80 order chaplygin-sleigh --integrators rk4,gauss4,gni
    fits 80
    prints 'at t = 20 on the lift, in \(q, v\) where a'
    prints '^Below an error of 1e-6 first: '
    expect "another order of rk4" grep -Eq '^rk4 +4 +4\.00 +1\.6e-4 +1\.0e-5 ' plain
    expect "another order of gni" grep -Eq '^gni +2 +2\.00 ' plain
    shown 60 order chaplygin-sleigh --integrators rk4,gauss4,gni
    fits 60
    shown 40 order chaplygin-sleigh --integrators rk4,gauss4,gni
    fits 40
    prints '^\.\.\. and [0-9] more columns \(--details\)$'
    shown 80 order chaplygin-sleigh
    fits 80
    prints '^\.\.\. and 23 more methods \(--details\)$'
    shown 80 order chaplygin-sleigh --integrators rk4 --details
    prints '^integrator +stated  found '
    counted
fi
# x'' = x has the exponents 1 and -1, x'' = -x - x'/5 twice -1/10; div F is 0 and -1/5.
printf '%s\n' "coordinates: [x]" "lagrangian: x'^2/2 + x^2/2" "start: {x: 1}" >unstable.yaml
printf '%s\n' "coordinates: [x]" "lagrangian: x'^2/2 - x^2/2" "forces: {x: -x'/5}" "start: {x: 1}" >damped.yaml
spectrum="--integrator gauss8 --step 0.1 --time 100"
if needs 23 "no terminal (script, stty)" terminal; then
    case_is "lyapunov: the largest exponent and its sign, and how many others have it"
    shown 80 lyapunov unstable.yaml $spectrum
    fits 80
    prints '^The largest exponent is 1 per unit of t \('
    prints '^It is positive: the motion is chaotic if it is bounded$'
    prints '^2 exponents: 1 positive, 0 may be 0, 1 negative$'
    prints '^exponent 2  +-1 '
    prints '^The sum agrees with the divergence: '
    shown 60 lyapunov damped.yaml $spectrum
    fits 60
    prints '^The largest exponent is -0\.1 per unit of t \('
    prints '^It is not found positive: in this time '
    prints '^2 exponents: 0 positive, 0 may be 0, 2 negative$'
    case_is "lyapunov: a pipe and --details have all of them"
    shown 80 lyapunov chaotic-oscillators --integrator rk4 --step 0.1 --time 10
    fits 80
    prints '^\.\.\. and 2 more \(--details\)$'
    try 0 lyapunov damped.yaml $spectrum
    mv out piped
    shown 80 lyapunov damped.yaml $spectrum --details
    expect "other bytes" cmp piped out
    case_is "volume: what becomes of it in the motion and in the steps"
    for columns in 60 80; do
        shown $columns volume damped.yaml $spectrum
        fits $columns
    done
    prints "^The volume of .* in the motion: shrinks; in the method's steps: shrinks$"
    prints '^divergence of F +-0\.2 .*shrinks$'
    counted
fi
if needs 9 "no terminal (script, stty)" terminal; then
    case_is "invariants: a table"
    for columns in 80 60; do
        shown $columns invariants snakeboard
        fits $columns
    done
    prints '^snakeboard: 6 invariants, 3 independent, of degree 2 in'
    prints '^known +exact +any parameters +phi.$'
    prints '^A block for the system file: --details, or a pipe$'
    shown 80 invariants suslov --degree 1
    fits 80
    counted
fi
if needs 7 "no terminal (script, stty)" terminal; then
    case_is "list: the names alone"
    for columns in 80 60; do
        shown $columns list
        fits $columns
    done
    shown 80 list
    fits 80
    prints '^  appell-hamel, '
    counted
fi
if needs 15 "no terminal (script, stty)" terminal; then
    case_is "ensemble: what differs between members, and where their states are"
    # Uniform circular motion: phi = phi' t, so that deviations at t = 2 have the ratio 2; phi' is conserved.
    ensemble="ensemble chaplygin-sleigh --members 100 --seed 3 --vary \"phi'=uniform(1,2)\" --time 2 --step 0.05"
    shown 80 "$ensemble" -o members
    fits 80
    prints '^chaplygin-sleigh by gauss4\+project, h = 0\.05: 100 members until t = 2$'
    prints '^All of them reached the end$'
    prints '^  +mean +deviation +from +to$'
    expect "deviations of phi and phi'" awk '
        $1 == "phi" { angle = $3 } $1 == "phi\047" { speed = $3 }
        END { exit !(speed > 0.2 && speed < 0.4 && angle > 1.9 * speed && angle < 2.1 * speed) }' plain
    prints '^In all members:$'
    prints ' e = 1 '
    prints '^States: final\.npy in members$'
    prints '^Page:   dalembert report members$'
    shown 60 "$ensemble" -o members60
    fits 60
    shown 80 "ensemble nonholonomic-particle --integrator rk4 --members 8 --seed 1 --vary \"x'=uniform(1,2)\" --step 1e200 --time 1e201" -o failing
    refute "all reached the end" grep -q "All of them" out

    case_is "list: modifiers, and units as powers of two"
    shown 80 list modifiers
    prints '^\+suzuki4 '
    refute "an integrator" grep -q '^gauss4 ' out
    counted
fi
case_is "list: units are powers of two"
try 0 list units
expect "no system" has_lines out "$(($("$program" list systems | wc -l)))"
expect "no powers of two" awk 'NR > 2 { for (i = 2; i <= NF; i++) { x = $i + 0
        if ($i !~ /^[0-9.e+-]+,?$/) continue
        power = log(x) / log(2)
        if (power - sprintf("%.0f", power) > 1e-6 || power - sprintf("%.0f", power) < -1e-6) exit 1 } }' out
table <<'END'
2 | list units --order 4 | says list units: --order and --preserves select integrators
2 | list modifiers --tag integrable | says list modifiers: --tag selects systems
END

case_is "order: the space is the default of run"
try 0 order chaplygin-sleigh --integrators rk4,gni --json
expect "another space" grep -q '^    "space": "lifted",$' out
try 0 order chaplygin-sleigh --integrators rk4,gni
prints ', lifted, physical where a method has no lift$'
try 0 order chaplygin-sleigh-vakonomic --integrators rk4 --time 1
prints ', physical$'

case_is "a pipe has the rows, and a table of the summary on request"
try 0 $sleigh --summary
prints '^t,y1,y2,phi,'
expect "not 102 lines" test "$(wc -l <out)" -eq 102
says ' exponent +size +trend$'

if needs 14 "no terminal (script, stty)" terminal; then
    case_is "action: whether the curve is a motion, and both tables, in 24 lines"
    try 0 run chaplygin-sleigh --integrator gauss8 --step 0.05 --time 5 --output motion.csv
    shown 80 action chaplygin-sleigh motion.csv --perturb 0.01
    fits 80
    prints '^chaplygin-sleigh on motion\.csv: 101 rows, t = 0 to 5, h = 0\.05$'
    prints '^A motion of the system, as far as these rows show: the action \(nh10\) is '
    prints '^nh10 .* perturbed|^nh10 +int e/2'
    prints '^gauss4 .*not stationary'
    shown 60 action chaplygin-sleigh motion.csv --methods gauss8
    fits 60
    prints '^gauss8 .* stationary'
    shown 80 action chaplygin-sleigh motion.csv --set m=2 --details
    prints '^\(nh10\) '
    # y1 is pushed off the motion in one row.
    awk -F, -v OFS=, 'NR == 50 { $2 += 0.1 } { print }' motion.csv >bent.csv
    shown 80 action chaplygin-sleigh bent.csv
    prints '^Not a motion of the system: the action \(nh10\) is '
    fits 80
    counted
fi
