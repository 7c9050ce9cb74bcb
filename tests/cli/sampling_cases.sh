# When rows are taken, how progress is shown, what the manifest says.

case_is "logarithmic rows"
try 0 run ./line.yaml --integrator rk4 --step 0.01 --time 1000 --samples 6 --sampling log
# 0, then h (T/h)^(k/5): 1, 10, ..., 1e5 steps
expect "not at powers of ten" test "$(cut -d, -f1 out | tr '\n' ' ')" = \
    "t 0 0.01 0.10000000000000001 1 10 100 1000 "
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --samples 50 --sampling log
expect "rows that fall together" test "$(cut -d, -f1 out | sort -u | wc -l)" -eq "$(wc -l <out)"
expect "not the 10 steps and 0" test "$(wc -l <out)" -eq 12
# 10 steps (T/h = 10.3) in 4 parts: after 2.5, 5, 7.5 and 10 steps, halves away from zero
try 0 run ./line.yaml --integrator rk4 --step 0.125 --time 1.29 --samples 4 --sampling steps
expect "rows after 0, 3, 5, 8 and 10 steps" [ "$(cut -d, -f1 out | tr '\n' ' ')" = \
    "t 0 0.375 0.625 1 1.25 " ]
try 0 run ./line.yaml --integrator rk4 --step 0.125 --time 0.25 --sampling steps
expect "no more rows than steps" [ "$(cut -d, -f1 out | tr '\n' ' ')" = "t 0 0.125 0.25 " ]
table <<'END'
2 | run ./line.yaml --integrator rk4 --step 0.1 --time 0.06 --sampling steps | says 0.1 is larger than the time 0.06
2 | run ./line.yaml --integrator rk4 --step 0.1 --time 1 --sampling cubic | says 'cubic' is not one of linear.log.steps
END

case_is "rows at given times"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --times 0.5,0.75,2
expect "other times" test "$(cut -d, -f1 out | tr '\n' ' ')" = "t 0.5 0.75 2 "
# x = 1 - exp(-t): error of rk4 below h^4/120 = 8e-7
expect "another motion" awk -F, 'NR > 1 && ($2 - 1 + exp(-$1)) ^ 2 > 1e-12 { exit 1 }' out
printf '0.5 # half\n0.75\n\n2\n' >times.txt
mv out listed
try 0 run ./line.yaml --integrator rk4 --step 0.1 --times times.txt --output listed.npy
try 0 run ./line.yaml --integrator rk4 --step 0.1 --times times.txt
expect "a file is not its list" cmp -s out listed
try 0 run ./line.yaml --integrator rk4 --step 0.1 --times 0.5 --time 3
expect "T is no row" test "$(cut -d, -f1 out | tr '\n' ' ')" = "t 0.5 3 "
table <<'END'
2 | run ./line.yaml --integrator rk4 --step 0.1 --times 0.5,0.5 | says --times: 0.5 does not come after the time before
2 | run ./line.yaml --integrator rk4 --step 0.1 --times 0.5,4 --time 3 | says --times: 4 is later than T = 3
2 | run ./line.yaml --integrator rk4 --step 0.1 --times 1,x | says 'x' is not a number
2 | run ./line.yaml --integrator rk4 --step 0.1 --times , | says --times: the list is empty
2 | run ./line.yaml --integrator rk4 --step 0.1 --times 1 --samples 3 | says --times excludes --samples and --sampling
END

case_is "a directory with rows at given times goes on"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --times times.txt --output timed
rm timed/checkpoint
rm -f timed/checkpoint.before times.txt
try 0 resume timed
expect "other rows" cmp -s timed/trajectory.npy listed.npy

case_is "progress for scripts"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 5 --progress json
says '^\{"t": 5, "time": 5, "steps": 50, "rows": 101, .*"remaining": 0, "deviation": \{"E": '
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 5 --progress off
silent
try 2 run ./line.yaml --integrator rk4 --step 0.1 --time 5 --progress loud
says "'loud' is not one of auto.json.off"

case_is "the manifest"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 5 --set k=2 --output counted
expect "not done" grep -qx '  "status": "done",' counted/manifest.json
expect "not 50 steps" grep -qx '  "steps": 50,' counted/manifest.json
expect "no parameter" grep -qx '    "set": {"k": 2},' counted/manifest.json

case_is "statistics at every K-th step"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 5 --statistics 50 --output seldom
# E = exp(-2 t)/2 at t = 0 and 5 alone: (exp(-10) - 1)/2 / 5
expect "another rate" awk -F, '$1 == "E" && ($7 + 0.09999546) ^ 2 < 1e-12 { found = 1 }
    END { exit !found }' seldom/summary.csv

if needs 10 "no terminal (script, stty)" terminal; then
    case_is "progress on a terminal fits its width"
    for width in 70 40 20; do
        script -qec "stty cols $width; '$program' run ./line.yaml --integrator gauss4 --step 0.01 \
            --time 3000 --native off --output typed --force" /dev/null >typed.txt </dev/null
        tr '\r' '\n' <typed.txt | grep '^t = ' >lines.txt
        expect "no lines, $width" test "$(wc -l <lines.txt)" -ge 2
        expect "longer than $width" awk "length(\$0) >= $width { exit 1 }" lines.txt
        [ $width -gt 20 ] && expect "no time to go, $width" grep -q ' %), [0-9]* s to go' lines.txt
        [ $width -gt 40 ] && expect "no drift" grep -q ', moved: E 0\.[0-9]*' lines.txt
    done
    # H comes before |p| and |pi| and the invariants after them.
    script -qec "stty cols 150; '$program' run chaplygin-sleigh --integrator gauss4 --step 0.01 \
        --time 3000 --native off --output typed --force" /dev/null >typed.txt </dev/null
    expect "norms in the line, or no invariants" grep -qE \
        ', moved: D1 [-0-9.e+]*, E [-0-9.e+]*, H [-0-9.e+]*, speed [-0-9.e+]*, spin ' typed.txt
    counted
fi

# The steps left, (T - t)/h, are the rate times the time to go, which is rounded to its unit.  A terminal shows of
# the text what each \r writes over the line: nothing is left of a line before, nor of the last at the end.
if needs 4 "no terminal (script, stty)" terminal; then
    case_is "progress on a terminal: its numbers, and what is seen of it"
    script -qefc "stty cols 100; echo \$\$ >pid; exec '$program' run ./line.yaml --integrator gauss4 --step 0.01 \
        --time 1e9 --native off --samples 10 --output long --force" long.txt >script.log 2>&1 </dev/null &
    running=$!
    has_progress() { test "$(tr '\r' '\n' <long.txt | grep -c ' to go, .*moved: ')" -ge 5; }
    expect "no progress" reaches $running has_progress
    kill -INT "$(cat pid)"
    wait $running
    expect "another status" test $? -eq 130
    tr '\r' '\n' <long.txt | grep ' to go, .* steps/s' >lines.txt
    expect "other numbers" awk '{ sub(/[(]/, "") } {
            seconds["s"] = 1; seconds["min"] = 60; seconds["h"] = 3600; seconds["days"] = 86400
            t = $3; left = $6; unit = seconds[$7]; rate = $10; steps = (1e9 - t) / 0.01
            wrong = steps / rate - left * unit
            if (wrong < 0) wrong = -wrong
            if (wrong > 0.5001 * unit + 0.006 * left * unit) exit 1
        }' lines.txt
    expect "something is left of a line" awk 'BEGIN { RS = "\r" }
        { if (sub(/.*\n/, "")) seen = ""
          seen = $0 substr(seen, length($0) + 1); now = seen; sub(/ +$/, "", now); sub(/ +$/, "")
          if (now != $0) exit 1 }' long.txt
    counted
fi
