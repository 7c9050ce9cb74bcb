# `dalembert section`, `lyapunov`, `volume`: closed forms through the command line.

cat >osc.yaml <<'END'
coordinates: [x]
parameters: {level: 0.999}
lagrangian: (x'^2 - x^2)/2
start: {x: 1}
END
cat >saddle.yaml <<'END'
coordinates: [x]
accelerations: {x: x}
END
fine="--integrator gauss12 --step 0.1 --time 20"

# cos t = 0 at pi/2 + k pi, downwards first.
case_is "crossings in closed form"
try 0 section osc.yaml --on x $fine
silent
prints "^crossing,t,direction,x,x'"
expect "other crossings" awk -F, 'NR > 1 { k = NR - 2; t = (k + 0.5) * 3.14159265358979324
    if ($1 != NR - 1 || ($2 - t)^2 > 1e-24 || $3 != (k % 2 ? 1 : -1) || $4^2 > 1e-28) exit 1 }
    END { exit NR != 7 }' out
cp out both.csv
try 0 section osc.yaml --on x $fine --direction up
expect "not 3 upwards" awk -F, 'NR > 1 && $3 != 1 { exit 1 } END { exit NR != 4 }' out
try 0 section osc.yaml --on x $fine --transient 10
expect "not 3 after t = 10" awk -F, 'NR > 1 && $2 < 10 { exit 1 } END { exit NR != 4 }' out
try 0 section osc.yaml --on "x = level" $fine
expect "not 7 at the level" test "$(wc -l <out)" -eq 8
try 0 section osc.yaml --on "x = 1" $fine --output touch.csv
prints '^t = 20: 0 upwards, 0 downwards, 3 touches; 0 rows$'

# x = t: cos 7t = 0 at (k + 1/2) pi/7, two of them in most steps; cos 1e5 t = 0 too often to be found.
case_is "several crossings in a step"
printf "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n" >even.yaml
coarse="--integrator rk4 --step 0.7 --time 6.3"
try 0 section even.yaml --on "cos(7*x)" $coarse
silent
expect "not all 14" awk -F, 'NR > 1 { t = (NR - 1.5)*3.14159265358979324/7; if (($2 - t)^2 > 1e-26) exit 1 }
    END { exit NR != 15 }' out
try 0 section even.yaml --on "cos(1e5*x)" $coarse
says '^dalembert: 9 steps may hide crossings, the first from t = 0: '
if needs 4 "no python3" there python3; then
    try 0 section even.yaml --on "cos(1e5*x)" $coarse --output fast.csv --json
    expect "not in the JSON" json out "d['unresolved'] == 9 and d['first_unresolved'] == 0"
    try 0 section even.yaml --on "cos(7*x)" $coarse --output slow.csv --json
    expect "not in the JSON" json out "d['unresolved'] == 0 and d['first_unresolved'] is None"
    counted
fi
for transient in 6.3 7; do
    try 2 section even.yaml --on x-1 $coarse --transient $transient
    says "^dalembert: --transient $transient: no crossing remains, the run ends at t = 6.3$"
done
try 0 section even.yaml --on x-6 $coarse --transient 5.9
expect "not the crossing after the transient" test "$(wc -l <out)" -eq 2

case_is "a directory of crossings"
try 0 section osc.yaml --on x $fine --output crossed --axes "t,x'"
prints '^t = 20: 3 upwards, 3 downwards, 0 touches; 6 rows$'
expect "other rows" cmp both.csv crossed/section.csv
expect "no picture" grep -q '^plot' crossed/report/section.gp

# The columns of the picture vary on the section, and not by rounding.
varied() { # DIR
    sed -n 's/.*"axes": \["\(.*\)", "\(.*\)"\].*/\1,\2/p' "$1/section.json" >axes
    awk -F, '
        NR == FNR { name[1] = $1; name[2] = $2; next }
        FNR == 1 { for (i = 1; i <= NF; i++) { if ($i == name[1]) x = i; if ($i == name[2]) y = i }; next }
        { for (i = 1; i <= NF; i++) {
            if (FNR == 2 || $i < low[i]) low[i] = $i
            if (FNR == 2 || $i > high[i]) high[i] = $i } }
        END { exit !(FNR > 3 && x && y && x != y && high[x] - low[x] > 1e-3 && high[y] - low[y] > 1e-3) }' \
        axes "$1/section.csv"
}
case_is "the picture of a section"
# The section of docs/program.md; on it D makes y' = 0.
readme=$(sed -n 's/^    build\/dalembert section //p' "$here/../../docs/program.md")
eval "try 0 section $readme --output of-readme"
expect "axes that do not vary" varied of-readme
try 0 section contact-oscillator --on y --integrator gauss4 --step 0.1 --time 300 --output on-y
expect "axes that do not vary, y = 0" varied on-y
try 0 section osc.yaml --on "x - 0.5*cos(0.3*t)" $fine --output modulated
expect "axes that do not vary, x = cos(0.3 t)/2" varied modulated
# The sleigh goes round its circle: there phi and y2' vary, not phi', y2.
try 0 section chaplygin-sleigh --on "cos(phi) = 0.5" --integrator gauss4 --step 0.1 --time 100 \
    --output on-phi
expect "axes that do not vary, cos(phi) = 1/2" varied on-phi

# A = B is wrong where A or B is, in the columns of --on, and the program's own names stay its own.
case_is "what is wrong with a section"
wrong() { # FORMULA PATTERN
    try 2 section osc.yaml --on "$1" $fine
    says "^dalembert: --on:$2$"
    refute "it names an invariant" grep -q "invariant" err
}
wrong "" '1:1: the formula is empty'
wrong "x =" '1:4: the formula is empty'
wrong "= x" '1:1: the formula is empty'
wrong "x = 1 2" '1:7: an operator is missing before .2.'
wrong "x = y" "1:5: unknown name 'y'.*"
wrong "x = 1) + (2" "1:6: '\)' closes no '\('"
wrong "x = 1 = 2" '1:7: .*'
wrong "section_1" "1:1: unknown name 'section_1'.*"
cat >named.yaml <<'END'
coordinates: [x]
lagrangian: (x'^2 - x^2)/2
start: {x: 1}
invariants: {section_1: x^2 + x'^2, the_section: x'^2 + x^2}
END
try 0 section named.yaml --on x $fine
expect "other crossings" cmp out both.csv

case_is "crossings: bad input"
table <<'END'
2 | section osc.yaml $fine | says --on is missing
2 | section osc.yaml --on "x +" $fine | says --on:1:4: .*a value is missing
2 | section osc.yaml --on levl $fine | says --on:1:1: .*'levl'.*did you mean 'level'
2 | section osc.yaml --on x $fine --direction sideways | says 'sideways' is not one of down.both.up
2 | section osc.yaml --on x $fine --axes "x,y" | says unknown column of --axes 'y'
2 | section osc.yaml --on x $fine --axes x | says 'x' is not two columns
2 | section osc.yaml --on x --integrator rk4 --step 0.3 --time 20 | says is not a whole number of steps of 0.3
3 | section osc.yaml --on "log(5 - t)" --integrator rk4 --step 0.1 --time 20 | says the section has no value at t = 5
END
try 4 section osc.yaml --on x $fine --output osc.yaml/rows
alone "^dalembert: cannot make the directory 'osc.yaml/rows': Not a directory$"
if needs 6 "no /dev/full" test -e /dev/full; then
    try 4 section osc.yaml --on x $fine --output /dev/full
    # It ends with the first row that cannot be written.
    try 4 section osc.yaml --on x --integrator rk4 --step 0.1 --time 1e5 --output /dev/full
    says "^dalembert: cannot write '/dev/full': No space left on device$"
    expect "not one message" test "$(grep -c "^dalembert: " err)" -eq 1
    try 4 lyapunov osc.yaml --integrator rk4 --step 0.1 --time 1e4 --rows 100000 --output /dev/full
    expect "not one message" test "$(grep -c '^dalembert: ' err)" -eq 1
    counted
fi

# Tangent vectors do not pass a jump of F or of F_v; x = 1 + cos(w t) exp(-0.05 t)/2 meets none.
case_is "exponents where F jumps"
jumps() { # NAME ACCELERATION
    printf "coordinates: [x]\naccelerations: {x: \"$2\"}\nstart: {x: 1.5, x': 0.3}\n" >$1.yaml
}
jumps driven "-x + sign(x) - 0.1*x' + 0.9*cos(t)"
jumps rubbed "-x - 0.2*abs(x')"
jumps floored "-x - floor(x)"
jumps switched "if(t < 1.05, -x, -2*x)"
for command in lyapunov volume; do
    for system in driven rubbed floored switched; do
        try 2 $command $system.yaml --integrator rk4 --step 0.1 --time 200
        says "^dalembert: $system.yaml: a branch of the acceleration of x changes between t = [0-9.]* and [0-9.]*, where F"
    done
    says 'between t = 1 and 1\.1, '
    try 2 $command driven.yaml --integrator rk4 --step 0.1 --time 1 --transient 200
    says 'a branch of the acceleration of x changes'
done
jumps beside "-x + sign(x) - 0.1*x'"
sed -i "s/x': 0.3/x': 0/" beside.yaml
try 0 lyapunov beside.yaml --integrator rk4 --step 0.1 --time 20
prints '^divergence of F +-0\.1 '
jumps kinked "-abs(x) - 0.1*x' - 0.2*x'*abs(x')"
try 0 volume kinked.yaml --integrator rk4 --step 0.1 --time 2

# x'' = x by rk4: R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 at z = h and -h.
case_is "exponents in closed form"
try 0 lyapunov saddle.yaml --integrator rk4 --step 0.1 --time 20 --transient 30 --output saddle.csv
silent
prints '^the derivative of the step exact'
prints '^exponent 1 +0\.999999 .* positive$'
prints '^exponent 2 +-0\.999999 .* negative$'
prints '^their sum .* all$'
prints '^divergence of F +0 '
expect "other exponents" awk -F, '
    NR == 1 && $0 != "t,lambda1,lambda2,divergence" { exit 1 }
    NR > 1 { for (s = 1; s > -2; s -= 2) { h = s * 0.1
            l = log(1 + h * (1 + h/2 * (1 + h/3 * (1 + h/4)))) / 0.1
            if (($(s > 0 ? 2 : 3) - l)^2 > 1e-24) exit 1 }
        if ($4 != 0) exit 1 }
    END { exit NR != 101 || ($1 - 50)^2 > 1e-20 }' saddle.csv
try 0 lyapunov chaplygin-sleigh --integrator gauss4+project --step 0.1 --time 5 --exponents 2
prints 'by differences of order 8$'
prints '^their sum .* not all$'

# x'' = 2 x - x' has 1 and -2, on p = pi = 0 the lift their negatives, too; gauss4 keeps its volume.
case_is "exponents of the lift"
printf '%s\n' 'coordinates: [x]' "accelerations: {x: 2*x - x'}" >two.yaml
try 0 lyapunov two.yaml --integrator gauss4 --step 0.1 --time 20 --transient 60 --space lifted --effort identity
prints '^two.yaml, gauss4, lifted, h = 0.1: means over'
prints '^exponent 1 +2 .* positive$'
prints '^exponent 2 +1 .* positive$'
prints '^exponent 3 +-1 .* negative$'
prints '^exponent 4 +-2 .* negative$'
prints '^divergence +0 '
try 0 lyapunov saddle.yaml --integrator gauss4 --step 0.1 --time 2 --space lifted --start pi_x=0.1 --json
expect "the request" json out "d['request']['space'] == 'lifted' and d['request']['start'] == {'pi_x': 0.1}
    and len(d['exponents']) == 4 and abs(d['sum']['mean']) < 1e-12 and d['balance']['margin'] < 1e-10"
try 0 volume saddle.yaml --integrator gauss4 --step 0.1 --time 2 --space lifted
prints '^4 of 4 directions'
prints '^log.det J./h .* preserved at every step$'

case_is "a motion that ends early keeps its means"
cat >ending.yaml <<'END'
coordinates: [x]
accelerations: {x: sqrt(2.5 - t)*0.1 - x}
start: {x: 1}
END
try 3 lyapunov ending.yaml --integrator rk4 --step 0.1 --time 5 --output ending.csv
says 'not finite'
prints 'means over t = 0 \.\. 2\.4$'
prints '^exponent 2 '
expect "rows after the end" awk -F, 'NR > 1 && $1 > 2.6 { exit 1 } END { exit NR < 20 }' ending.csv

case_is "a page that cannot be made"
mkdir paged
touch paged/report
try 4 lyapunov saddle.yaml --integrator rk4 --step 0.1 --time 5 --force --output paged
says "^dalembert: cannot make the directory 'paged/report': File exists$"

case_is "exponents: bad input"
table <<'END'
2 | lyapunov saddle.yaml --integrator rk4 --step 0.1 --time 5 --exponents 3 | says 3 exponents are requested; the step map has 2
2 | lyapunov chaplygin-sleigh --integrator gni --step 0.1 --time 5 | says gni has a multiplier
2 | lyapunov chaplygin-sleigh --integrator dla --step 0.1 --time 5 --space lifted | says has no lifted form
2 | lyapunov saddle.yaml --integrator rk4 --step 0.1 --time 5 --space lifted --gauge "e = 1, mu_e = x" | says mu_e of the gauge is not of t alone
2 | lyapunov saddle.yaml --integrator rk4 --step 0.1 --time 5 --transient -1 | says transient: -1 is not from 0 to inf
2 | lyapunov saddle.yaml --integrator rk4 --step 0.1 --time 5 --transient 1e30 | says more than can be counted
2 | lyapunov saddle.yaml --integrator rk4 --step 0.1 | says time is missing
END

# x'' = -x' by rk4: J = ((1, *), (0, R(-h))).
case_is "volumes in closed form"
try 0 volume line.yaml --integrator rk4 --step 0.1 --time 10 --output shrinks.csv
prints '^divergence of F +-1 .* shrinks$'
prints '^2 of 2 directions'
expect "another rate" awk -F, '
    NR == 1 && $0 != "t,divergence,step" { exit 1 }
    NR > 1 { h = -0.1; l = log(1 + h * (1 + h/2 * (1 + h/3 * (1 + h/4)))) / 0.1
        if (($2 + 1)^2 > 1e-26 || ($3 - l)^2 > 1e-24) exit 1 }
    END { exit NR != 101 }' shrinks.csv
# A divergence of -0.02 at every step is known, however short the run and the unit of time.
sed 's/k: 1/k: 0.02/' line.yaml >slow.yaml
table <<'END'
0 | volume slow.yaml --integrator rk4 --step 0.1 --time 10 | prints ^divergence of F +-0\.02 .* shrinks$
0 | volume slow.yaml --integrator rk4 --step 1e-6 --time 1e-4 | prints ^divergence of F +-0\.02 .* shrinks$
END
try 0 volume osc.yaml --integrator stormer-verlet --step 0.1 --time 10
prints '^divergence of F +0 .* preserved at every step$'
prints '^log.det J./h .* preserved at every step$'
try 0 volume chaplygin-sleigh-offset --integrator gauss4+project --step 0.1 --time 50
prints '^log.det J./h .* shrinks$'
prints '^5 of 6 directions'

# Teeth of 1e-12: the field's own derivative is that within a tooth, -0.1, a difference sees -0.3.
case_is "a derivative that the motion does not have"
cat >teeth.yaml <<'END'
coordinates: [x]
accelerations: {x: -0.3*x' + 0.2*atan(tan(1e12*x'))/1e12}
start: {x': 1}
END
for look in lyapunov volume; do
    try 3 $look teeth.yaml --integrator rk4+project --step 0.1 --time 10 --output teeth.csv
    says 'differs from the mean divergence by -0\.2, '
    prints '^divergence of F +-0\.1 '
    expect "no rows" test "$(wc -l <teeth.csv)" -eq 101
    try 0 $look teeth.yaml --integrator rk4 --step 0.1 --time 10
done

# The integral of the divergence, V = sqrt(2.11), tau = V t/2 + atanh(0.7/V), is -log(cosh(tau)/
# cosh(tau0)).  To it |grad D| in the units of the system adds a number/T, where the sleigh has turned by pi k.
case_is "a sleigh that travels far, in closed form"
try 0 lyapunov chaplygin-sleigh-offset --integrator rk4+project --step 0.05 --time 300 \
    --start x=1e6 --output far.csv
expect "another sum" awk -F, 'NR > 1 { T = $1; V = sqrt(2.11); x = 0.7/V
    tau0 = log((1 + x)/(1 - x))/2; tau = tau0 + V*T/2
    mean = -(tau - log(exp(tau0) + exp(-tau0)) + log(1 + exp(-2*tau)))/T
    added = T*($2 + $3 + $4 + $5 + $6 - mean)
    if (T == 30) first = added
    if (T > 30 && (added - first)^2 > 1e-8) exit 1 }
    END { exit NR != 101 || first == 0 || first^2 > 1 }' far.csv

case_is "an interrupted lyapunov keeps its means"
"$program" lyapunov osc.yaml --integrator rk4 --step 0.01 --time 1e9 --rows 1e8 --output early.csv \
    >out 2>err &
expect "no rows" reaches $! has_lines early.csv 3
ends_by INT 130 $!
says '^dalembert: interrupted; the means so far are kept$'
prints '^exponent 2 '
try 0 volume line.yaml --integrator rk4 --step 0.1 --time 10 --output volumes
expect "no picture" grep -q '^plot' volumes/report/volume.gp
