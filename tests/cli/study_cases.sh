# `dalembert study`: cells, tables, files, and what becomes of bad ones.

cat >small.yaml <<'END'
title: a small study
integrators: [rk4, gauss4+project]
step: [0.1, 0.05]
time: 2
systems:
  - chaplygin-sleigh
  - {system: plane.yaml, label: plane, starts: [surface, physical]}
END
case_is "cells, tables and files"
try 0 study small.yaml --output there --force --tables
silent
prints '^a small study$'
prints '^chaplygin-sleigh: '
prints '^ lifted, p and pi displaced, h = 0.05, T = 2$'
prints '^What this shows'
for file in study.yaml tables.txt cells.csv quantities.csv series/chaplygin-sleigh.csv \
    series/plane.csv; do
    expect "$file is missing" test -s "there/$file"
done
expect "the study is not kept" cmp -s small.yaml there/study.yaml
expect "the tables are not kept" cmp -s out there/tables.txt
# 2 methods x 2 steps x (3 + 2) starts
expect "not 20 cells" test "$(column state there/cells.csv | grep -c '^done$')" -eq 20
expect "steps are not T/h" test "$(column steps there/cells.csv | sort -n | uniq | tr '\n' ' ')" = "20 40 "
expect "lifted and (q,v) differ" test "$(column same_as_physical there/cells.csv | sort | uniq -c |
    tr -d ' \n')" = "128yes"
expect "D of the plane strays" test "$(grep '^plane' there/cells.csv |
    awk -F, '$12 > 1e-14' | wc -l)" -eq 0

case_is "the same on any number of threads"
try 0 study small.yaml --output one --threads 1
try 0 study small.yaml --output four --threads 4
for file in tables.txt quantities.csv series/plane.csv series/chaplygin-sleigh.csv; do
    expect "$file differs" cmp -s "one/$file" "four/$file"
done
sed 's/,[^,]*$//' one/cells.csv >one.cells
sed 's/,[^,]*$//' four/cells.csv >four.cells
expect "cells.csv differs" cmp -s one.cells four.cells

case_is "tables hold no times"
if needs 5 "no compiler for a fast clock" shared_object fast_clock; then
    expect "exit $?" env ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0" \
        LD_PRELOAD="$top/fast_clock.so" "$program" study small.yaml --output fast --no-page
    expect "no fast clock" awk -F, 'NR > 1 && $NF <= 1 { slow = 1 } END { exit slow || NR < 2 }' fast/cells.csv
    for file in tables.txt quantities.csv series/plane.csv; do
        expect "$file differs" cmp -s "one/$file" "fast/$file"
    done
    counted
fi

case_is "numbers with closed forms"
cat >closed.yaml <<'END'
integrators: [symplectic-euler-00]
step: 0.5
time: 1
starts: physical
systems: [line.yaml]
END
# explicit Euler on v' = -v, x' = v from (0, 1): v = 1/2, 1/4; x = 1/2, 3/4
try 0 study closed.yaml --output there --force
E_first=$(column E_first there/cells.csv)
E_deviation=$(column E_deviation there/cells.csv)
expect "E(0) = $E_first" test "$E_first" = 0.5
expect "E(1) - E(0) = $E_deviation" test "$E_deviation" = 0.46875
expect "x + x' moved" test "$(column invariant_size there/cells.csv)" = exact
# E = 1/2, 1/8, 1/32 at 0, 1/2, 1: slope (1/32 - 1/2) / 1
expect "the rate of E" test "$(column E_rate there/cells.csv)" = -0.46875

case_is "a cell that fails is named, and the study continues"
cat >failing.yaml <<'END'
integrators: [rk4, gauss4]
step: 0.01
time: 3
starts: physical
systems:
  - {system: appell-hamel, set: {w0: -1}}
  - line.yaml
END
try 3 study failing.yaml --output there --force --tables
# z' = 1 comes to rest at t = z' (1 + nu^2)/g = 2
prints '^  rk4 +failed after t = 2: constraint 1 '
expect "no failed cells" test "$(column state there/cells.csv | sort | uniq -c | tr -d ' \n')" = 2done2failed
expect "no status" grep -q DAL_SINGULAR there/cells.csv

case_is "a cell that is refused is no failure"
cat >refused.yaml <<'END'
integrators: rk4
step: 0.1
time: 1
systems: chaplygin-sleigh-vakonomic
END
try 0 study refused.yaml --output there --force --tables
prints '^  rk4 +refused: '
# Vakonomic motion is in (q,v) alone, where its ten steps are shown: they take four evaluations each.
prints '^  rk4 .* only +10 +4\.0$'
expect "not 2 refused" test "$(column state there/cells.csv | grep -c refused)" -eq 2

case_is "a manifest that is a directory"
mkdir -p odd/manifest.json
for arguments in "--output odd" "--output odd --force"; do
    try 2 study refused.yaml --no-page $arguments
    says "^dalembert: 'odd/manifest.json' is a directory$"
    expect "more messages: $arguments" test "$(wc -l <err)" -eq 1
    empty
done

case_is "an interrupted study keeps what is finished"
cat >endless.yaml <<'END'
integrators: [rk4]
step: 0.1
starts: physical
systems:
  - {system: line.yaml, label: short, time: 1}
  - {system: line.yaml, label: endless, time: 1e12}
END
"$program" study endless.yaml --output there --force --threads 2 --checkpoint 0 --tables >out 2>err &
pid=$!
both_begun() { grep -q '"done"' there/runs/short_*/manifest.json && cat there/runs/endless_*/checkpoint | grep -q .; }
expect "nothing begun" reaches $pid both_begun
ends_by INT 130 $pid
says 'interrupted'
expect "the finished cell is lost" grep -q '^short,.*,done,' there/cells.csv
prints 'endless'
prints '^  rk4 +not run'
expect "the unfinished run has no checkpoint" test -s there/runs/endless_rk4_physical_0.1/checkpoint
expect "the manifest" grep -q '"cells": {"not run": 1, "done": 1, "failed": 0' there/manifest.json

case_is "study files that are none"
bad 'systems: [line.yaml\n' 'bad.yaml:'
bad '' 'bad.yaml: it is empty'
bad 'title: x\n---\ntitle: y\n' 'a second document'
bad 'titel: x\n' "bad.yaml:1:1: unknown key 'titel'; did you mean 'title'"
bad 'title: x\ntitle: y\n' "bad.yaml:2:1: the key 'title' comes twice"
bad 'title: x\n' 'the systems are missing'
bad 'systems: [line.yaml]\n' 'the integrators are missing'
bad 'integrators: rk4\nsystems: [line.yaml]\n' 'the step is missing'
bad 'integrators: rk4\nstep: 1\nsystems: [line.yaml]\n' 'the time is missing'
bad 'integrators: rk4\nstep: 2\ntime: 1\nsystems: [line.yaml]\n' 'step 2 is larger than the time 1'
bad 'integrators: rk4\nstep: 1e-300\ntime: 1\nsystems: [line.yaml]\n' 'steps of 1e-300 are more than can be counted'
bad 'integrators: rk4\nstep: -1\ntime: 1\nsystems: [line.yaml]\n' 'line.yaml: a step of -1 does not lead from t = 0 to t = 1'
bad 'integrators: rk4\nstep: nan\ntime: 1\nsystems: [line.yaml]\n' "'nan' is not a number"
bad 'integrators: all+zz\nstep: 0.1\ntime: 1\nsystems: [line.yaml]\n' "bad.yaml:1:14: unknown modifier 'zz'"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [{system: line.yaml, displace: {pi_x: few}}]\n' \
    "bad.yaml:4:48: displace: 'few' is not a number"
bad 'integrators: rk4\nstep: 0.1\ntime: few\nsystems: [line.yaml]\n' "bad.yaml:3:7: time: 'few' is not a number"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nfrom: few\nsystems: [line.yaml]\n' "bad.yaml:4:7: from: 'few' is not a number"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\noptions: {solver: [newton]}\nsystems: [line.yaml]\n' \
    'bad.yaml:4:19: solver: a single value is required'
bad 'integrators: rk5\nstep: 0.1\ntime: 1\nsystems: [line.yaml]\n' "bad.yaml:1:14: .*did you mean 'rk4'"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nstarts: [surfaces]\nsystems: [line.yaml]\n' "unknown start 'surfaces'; did you mean 'surface'"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [knife-egde]\n' "did you mean 'knife-edge'"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [knife-edge, knife-edge]\n' "two systems called 'knife-edge'"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [{system: knife-edge, tme: 1}]\n' "unknown key 'tme'; did you mean 'time'"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [{system: knife-edge, label: a/b}]\n' 'cannot name a file'
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [{system: knife-edge, set: [m]}]\n' 'names and values are required'
bad 'integrators: {rk4: 1}\nstep: 0.1\ntime: 1\nsystems: [knife-edge]\n' 'a single value is required'
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsamples: 0\nsystems: [knife-edge]\n' 'not in 1\.\.'
table <<'END'
2 | study nowhere.yaml --output there --force | says nowhere.yaml
2 | study small.yaml failing.yaml | says only one STUDY.yaml
2 | study small.yaml --threads 0 --output there --force | says 0 is not in
END

bad 'integrators: []\nstep: 0.1\ntime: 1\nsystems: [knife-edge]\n' 'bad.yaml:1:14: integrators: the list is empty'
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nstarts: []\nsystems: [knife-edge]\n' 'starts: the list is empty'

case_is "names that a system does not know"
common='integrators: rk4\nstep: 0.1\ntime: 1\n'
bad "${common}systems: [{system: knife-edge, set: {omga: 1}}]\n" \
    "bad.yaml:4:37: set: unknown parameter 'omga'; did you mean 'omega'"
bad "${common}systems: [{system: knife-edge, start: {ph: 1}}]\n" \
    "start: unknown start name 'ph'; did you mean 'phi'"
bad "${common}systems: [{system: knife-edge, displace: {pi_ph: 1}}]\n" \
    "displace: unknown start name 'pi_ph'; did you mean 'pi_phi'"

case_is "a study is not written over"
cp small.yaml other.yaml
echo '# other' >>other.yaml
try 0 study small.yaml --output held
try 2 study other.yaml --output held
says "'held/study.yaml' exists already: 'dalembert resume held' resumes it, --force writes"
try 2 study small.yaml --output held
try 2 study small.yaml --output held --shard 1/2
try 0 study closed.yaml --output held --force
expect "runs of the old study" test "$(ls held/runs | tr '\n' ' ')" = "line.yaml_symplectic-euler-00_physical_0.5 "
expect "series of the old study" test "$(ls held/series | tr '\n' ' ')" = "line.yaml.csv "
try 0 run line.yaml --integrator rk4 --step 0.1 --time 1 --output of-a-run
try 2 study small.yaml --output of-a-run
says "'of-a-run/manifest.json' exists already"
# By default each is written over the one before, when that is over.
try 0 study small.yaml
try 0 study closed.yaml
expect "not the last one" cmp -s closed.yaml dalembert-study/study.yaml
sed -i 's/"status": "done"/"status": "running"/' dalembert-study/manifest.json
table <<'END'
2 | study small.yaml | says 'dalembert-study/study.yaml' exists already
END
rm dalembert-study/manifest.json
mkdir dalembert-study/manifest.json
table <<'END'
2 | study small.yaml | alone ^dalembert: 'dalembert-study/manifest.json' is a directory$
END
rmdir dalembert-study/manifest.json
echo '{' >dalembert-study/manifest.json
table <<'END'
2 | study small.yaml | alone ^dalembert: 'dalembert-study/study.yaml' exists already
case: output that cannot be written
4 | study small.yaml --output line.yaml | says line.yaml
END
try 4 study small.yaml --output /proc/nowhere
says '/proc/nowhere'
if needs 2 "no /dev/full" test -w /dev/full; then
    "$program" study small.yaml --output there --force >/dev/full 2>err
    status=$?
    expect "exit $status, not 4, on a full disk" test $status -eq 4
    says 'standard output'
    counted
fi

# A screen has at most 40 lines of 80 columns.
is_screen() {
    expect "more than a screen" awk 'length($0) > 80 || NR > 40 { wide = 1 } END { exit wide || !NR }' out
}

case_is "the first screen"
try 0 study small.yaml --output there --force
silent
is_screen
prints '^a small study$'
prints '^ 1 chaplygin-sleigh +2 plane$'
# D of the plane is constant and linear: every method keeps it.
prints '^rk4 +[a-z]-[01][0-9] +(0|[nru]-1[5-9])$'
prints '^D in 8 runs: '
prints '^From p = pi = 0 the lift has the bits of \(q,v\) in 8 of 8 runs\.$'
prints '^20 runs in [0-9.]+ s: 20 done\.$'
prints '^Tables: there/tables\.txt$'
expect "it is coloured" sh -c "! grep -q '\[3' out"
try 0 study small.yaml --output there --force --no-page
expect "there is a page" test ! -e there/report
refute "a page is named" grep -q ^Page out

case_is "the first screen: rows"
cat >rows.yaml <<'END'
integrators: [gauss8, all, all+project]
representatives: [gauss4+project, rk4]
step: 0.1
time: 1
starts: physical
systems: [line.yaml, plane.yaml]
END
# The first column of the matrix of D.
rows() { awk '/^$|^l-08/ { on = 0 } on { printf "%s ", $1 } /^max .D/ { on = 1 }' out; }
try 0 study rows.yaml --output there --force --no-page
is_screen
prints '^ 1 plane\.yaml +2 line\.yaml$'
expect "other rows: $(rows)" test "$(rows)" = "gauss4+project rk4 "
# A holonomic constraint adds +project, which the list need not name.
printf '%s\n' 'integrators: [rk4, gauss4]' 'representatives: gauss4' 'step: 0.1' 'time: 1' 'starts: physical' \
    'systems: [spherical-pendulum]' >completed.yaml
try 0 study completed.yaml --output there --force --no-page
expect "other rows: $(rows)" test "$(rows)" = "gauss4+project "
sed -i /representatives/d rows.yaml
try 0 study rows.yaml --output there --force --no-page
is_screen
prints '^gauss8 '
prints '^rk4 '
expect "two of a family" sh -c "! grep -q '^gauss1\?[0246] ' out"
expect "not 16 rows" test "$(rows | wc -w)" -eq 16
for wrong in 'gauss4, rk5' 'gauss4+project-energy' 'rk4, [rk4]'; do
    printf 'integrators: all\nrepresentatives: [%s]\nstep: 1\ntime: 1\nsystems: [line.yaml]\n' "$wrong" >bad.yaml
    try 2 study bad.yaml --output there --force
    says '^dalembert: bad\.yaml:2:[0-9]+: '
done
seventeen=$(seq -s, 17 | sed 's/[0-9][0-9]*/rk4/g')
bad "integrators: all\nrepresentatives: [$seventeen]\nstep: 1\ntime: 1\nsystems: [line.yaml]\n" \
    '17 are more than 16'

case_is "the first screen: many systems, failures, unmet expectations"
cat >many.yaml <<'END'
title: many
integrators: [rk4, gauss4]
step: [0.1, 0.05]
time: 3
starts: physical
systems:
  - {system: line.yaml, label: line, set: {k: {from: 0.1, to: 2, count: 20}}}
  - {system: appell-hamel, label: falls, set: {w0: -1}}
  - {system: chaplygin-sleigh-vakonomic, label: no, starts: surface}
expect:
  line: {all: {E: {deviation: {at most: 1e-30}}}}
END
try 3 study many.yaml --output there --force
is_screen
prints '^ 1 falls +2 no$'
prints '^   and 10 more, which the tables show$'
prints '^rk4 +fail ref\.$'
prints '^Expectations: 0 of 80 are met\.$'
prints '^  line_k=0\.1 rk4 physical h = 0\.1 E: expected deviation <= 1e-30, found '
prints '^88 runs in .*: 80 done, 4 failed, 4 refused\.$'
prints '^  failed first: rk4 on falls: constraint 1 '
# At rest at t = z' (1 + nu^2)/g = 2: the time is in the message, which is not cut.
expect "no time of the failure" grep -A2 'failed first' out
expect "no time of the failure" sh -c "grep -A1 'failed first' out | tr -d '\n' | grep -Eq 't (=|~) *2|and +2'"

case_is "the first screen: one system without constraint"
try 0 study closed.yaml --output there --force
is_screen
prints '^No finished run on p = pi = 0 has a constraint to keep\.$'
prints '^max error +1$'
prints '^A step takes '
case_is "the page of a study"
mkdir broken
for part in uPlot.iife.min.js uPlot.min.css LICENSE; do echo '*/ </script>' >broken/$part; done
DALEMBERT_UPLOT=$PWD/broken try 2 study closed.yaml --output there --force
says "^dalembert: '.*broken/uPlot.iife.min.js' is not a part of uPlot "
prints '^Tables: there/tables\.txt$'
refute "a page is named" grep -q ^Page out
DALEMBERT_UPLOT=/nonexistent try 0 study closed.yaml --output there --force
silent
prints '^Page: there/report/index\.html$'
expect "no word of charts" test "$(grep -c 'tables and no charts' there/report/index.html)" -eq 1
refute "a figure" grep -q '<figure' there/report/index.html
try 0 study closed.yaml --output there --force --tables
expect "a page is named" cmp out there/tables.txt
expect "no page" grep -q '^plot' there/report/1-E.gp
rm -r there/report
try 0 resume there
prints '^Page: there/report/index\.html$'
try 0 study closed.yaml --output halved --force --shard 1/1
prints "^Tables: 'dalembert merge' makes them$"
refute "a shard names a page" grep -q ^Page out
try 0 merge halved --output merged
prints '^Page: merged/report/index\.html$'
if needs 2 "no terminal (script, stty)" terminal; then
    case_is "the first screen: colours"
    colours() { script -qec "$1 '$program' study small.yaml --output there --force" /dev/null </dev/null; }
    colours "env -u NO_COLOR TERM=xterm" >out
    expect "none" grep -q "$(printf '\033')\[3[0-9]m" out
    colours "env NO_COLOR=1 TERM=xterm" >out
    expect "NO_COLOR is not respected" sh -c "! grep -q '$(printf '\033')\[' out"
    counted
fi

case_is "the built-in study"
try 0 study --show
expect "--show is not the file" cmp -s out "$here/../../bench/studies/canonical-drift.yaml"
# The studies before have all of its code.
if sanitized; then
    cannot 35 "with sanitizers the built-in study takes minutes" && return 0
fi
timeout --foreground $patience "$program" study --output builtin >out 2>err
status=$?
expect "exit $status" test $status -eq 0
silent
for system in damped-oscillator chaplygin-sleigh-friction chaplygin-sleigh \
    chaplygin-sleigh-nonlinear chaplygin-sleigh-vakonomic contact-oscillator \
    nonholonomic-particle knife-edge vertical-disk appell-hamel isokinetic; do
    expect "no table of $system" grep -q "^$system: " builtin/tables.txt
done
expect "its page has more than 3 MB" test "$(wc -c <builtin/report/index.html)" -le 3000000
is_screen
prints '^ 1 chaplygin-sleigh '
prints '^max \|D\| +1 +2 '
prints '^max \|E-E0\| '
prints '^D in [0-9]+ runs: [0-9]+ at rounding, .*, [0-9]+ refused\.$'
prints '^E in [0-9]+ runs: [0-9]+ at rounding, '
# rk4 leaves D = 0 and is stated to keep E nowhere; taylor stays there and keeps it.
prints '^[0-9]+ of [0-9]+ integrators keep E within 1 % on D = 0, '
prints ': taylor,'
prints '^From p = pi = 0 the lift has the bits of \(q,v\) in ([0-9]+) of \1 runs, [0-9]+ refused\.$'
prints '^Expectations: ([0-9]+) of \1 are met; [0-9]+ refused\.$'
# A sleigh drifts under rk4, and does not where D is enforced.
prints '^rk4 +l-0[0-9] '
prints '^gni +n-1[5-9] '
prints '^Tables: builtin/tables\.txt$'
prints '^Page: builtin/report/index\.html$'
expect "no page" grep -q '</html>' builtin/report/index.html
expect "lifted and (q,v) differ somewhere" sh -c '! cut -d, -f35 builtin/cells.csv | grep -q no'
long=$(grep '^nonholonomic-particle-long,' builtin/cells.csv)
expect "not 1e5 steps" test "$(echo "$long" | cut -d, -f10 | sort -u)" = 100000
expect "H of rk4 does not drift" test "$(echo "$long" | grep ',rk4,' | cut -d, -f25)" = linear
expect "H of a symplectic method drifts" test "$(echo "$long" | grep -v ',rk4,' | cut -d, -f24,25 |
    grep -cv ',none$\|^rounding,')" -eq 0
expect "D bilinear is not kept" test "$(grep -E '^(contact|nonholonomic-part)' builtin/cells.csv |
    grep -E ',(symplectic-euler-(10|01)|stormer-verlet),surface,' | cut -d, -f14 | sort -u)" = rounding
expect "D is not kept by +project" test "$(grep -E ',surface,' builtin/cells.csv |
    grep '+project' | cut -d, -f14 | sort -u | tr '\n' ' ')" = " rounding "
