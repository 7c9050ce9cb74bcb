# `rows: none` of a study: many short runs, whose results are in one file.

cat >short.yaml <<'END2'
title: many short runs
integrators: [rk4, gauss4+project]
step: [0.1, 0.05]
time: 2
systems:
  - system: chaplygin-sleigh
    start: {phi': {from: 0.5, to: 1.5, count: 4}}
  - {system: plane.yaml, label: plane, starts: [surface, physical]}
  - {system: plane.yaml, label: later, starts: physical, from: 0.5}
  - {system: chaplygin-sleigh-vakonomic, integrators: rk4}
  - {system: appell-hamel, starts: physical, time: 30, set: {w0: -1}, integrators: gauss4}
expect:
  appell-hamel: {all: {state: failed}}
END2
sed 's/^time/rows: none\ntime/' short.yaml >bare.yaml

# All columns of cells.csv that do not speak of rows, directories and times.
results() {
    sed ':a; s/\("[^",]*\),\([^"]*"\)/\1;\2/; ta' "$1/cells.csv" | awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) drop[i] = $i ~ /^(bits|run|seconds)$/ }
        { line = ""; for (i = 1; i <= NF; i++) if (!drop[i]) line = line "," $i; print line }'
    cat "$1/quantities.csv"
}
same_results() {
    results "$1" >one.results
    results "$2" >other.results
    cmp one.results other.results
}
untimed_cells() { sed 's/,[^,]*$//' "$1/cells.csv"; }

case_is "short runs: the results are the same as of runs with rows"
try 0 study short.yaml --output kept --threads 1
try 0 study bare.yaml --output bare --threads 1
silent
expect "other results" same_results kept bare
expect "not all kinds of cells" test "$(column state bare/cells.csv | sort | uniq -c |
    tr -d ' \n')" = "$(column state kept/cells.csv | sort | uniq -c | tr -d ' \n')"
expect "a failure is missing" grep -q ',failed,' bare/cells.csv
expect "a refusal is missing" grep -q ',refused,' bare/cells.csv
expect "runs have directories" test "$(find bare/runs bare/series -mindepth 1 -maxdepth 1 -name '*_*' | wc -l)" -eq 0
expect "cells name them" test -z "$(column run bare/cells.csv | tr -d '\n')"
expect "the lift differs" test "$(column same_as_physical bare/cells.csv | grep -c no)" -eq 0
expect "nothing is compared" test "$(column same_as_physical bare/cells.csv | grep -c yes)" -gt 10
try 0 study bare.yaml --output bare-two --threads 2
untimed_cells bare >one.cells
untimed_cells bare-two >two.cells
expect "threads change bytes" cmp one.cells two.cells

case_is "short runs: cut off at any byte"
size=$(wc -c <bare/results/all)
for length in 0 5 8 16 17 100 $((size / 3)) $((size / 2)) $((size - 1)); do
    rm -rf cut
    cp -r bare cut
    head -c "$length" bare/results/all >cut/results/all
    rm cut/cells.csv cut/quantities.csv
    try 0 resume cut
    untimed_cells cut >two.cells
    expect "other bytes after $length" cmp one.cells two.cells
    expect "$length: not all results" test "$(wc -c <cut/results/all)" -eq "$size"
done
before=$(ls -l --time-style=full-iso cut/results/all)
try 0 resume cut
expect "finished cells are run again" test "$(ls -l --time-style=full-iso cut/results/all)" = "$before"
# A byte that changed, of the time that the first run reached, ends what is believed.
printf 'x' | dd of=cut/results/all bs=1 seek=54 conv=notrunc 2>/dev/null
try 0 resume cut
untimed_cells cut >two.cells
expect "other bytes after a changed one" cmp one.cells two.cells

case_is "short runs: the results of something else"
cp -r bare other
records=$(wc -c <other/results/all)
sed 's/many/some/' bare/study.yaml >other/study.yaml
try 0 resume other
expect "another title: cells were run again" [ "$records" -eq "$(wc -c <other/results/all)" ]
cp bare/study.yaml other/study.yaml
echo '# changed' >>other/systems/plane.yaml
try 0 resume other
expect "another system: its cells were not run again" [ "$(wc -c <other/results/all)" -gt "$records" ]
cp bare/systems/plane.yaml other/systems/plane.yaml
printf 'DALRES01 and so on' >other/results/all
try 2 resume other
says "other/results/all: results of an earlier version; begin the study again with --force"
printf 'no such file of results' >other/results/all
try 2 resume other
says "other/results/all: it does not begin as a file of results"
cp bare/results/all other/results/all
printf 'no such file of results' >other/results/1-of-2
try 2 resume other
says "^dalembert: other/results/1-of-2: it does not begin as a file of results$"
empty
rm other/results/all
mkdir other/results/all
try 4 resume other
says "cannot read 'other/results/all'"

case_is "short runs: shards"
try 0 study bare.yaml --output third-1 --shard 1/3
try 0 study bare.yaml --output third-2 --shard 2/3
try 2 merge third-1 third-2 --output thirds
says 'is in none of the directories: a shard is missing'
try 0 study bare.yaml --output third-3 --shard 3/3
try 0 merge third-3 third-1 third-2 --output thirds
untimed_cells thirds >two.cells
expect "other bytes, merged" cmp one.cells two.cells
cp -r third-3 damaged
printf 'no such file of results' >damaged/results/3-of-3
try 2 merge third-1 third-2 damaged --output no-thirds
says "^dalembert: damaged/results/3-of-3: it does not begin as a file of results$"
expect "more messages" test "$(wc -l <err)" -eq 1
expect "something was made" test ! -e no-thirds
cp -r third-1 first-of-all
find third-2 third-3 -type f -exec cksum {} + >one.files
try 0 merge third-2 first-of-all third-3 --output first-of-all
find third-2 third-3 -type f -exec cksum {} + >two.files
expect "a source was changed" cmp one.files two.files
untimed_cells first-of-all >two.cells
expect "other bytes, merged into one of them" cmp one.cells two.cells
try 2 merge third-1 third-2 third-3 bare --output twice
says "' is in 'third-.' and in 'bare'"
for k in 1 2; do "$program" study bare.yaml --output half --shard $k/2 >out.$k 2>err.$k & done
wait
try 0 merge half --output half
untimed_cells half >two.cells
expect "other bytes, merged in place" cmp one.cells two.cells

case_is "short runs: interrupted beside a long one"
cat >long.yaml <<'END2'
integrators: [rk4]
step: 0.01
rows: none
systems:
  - {system: plane.yaml, label: plane, starts: physical, time: 1e12}
  - {system: chaplygin-sleigh, starts: physical, time: 1, start: {phi': {from: 1, to: 2, count: 5}}}
END2
"$program" study long.yaml --output long --threads 2 --checkpoint 0 >out 2>err &
expect "no results" reaches $! has_bytes long/results/all $((5 * 800))
# Another process has results, too, which it cannot add.
cksum <long/results/all >before
cp long/study.yaml kept.yaml
sed '/1e12/d; s/time: 1,/time: 2,/' long.yaml >long/study.yaml
try 2 resume long
says "^dalembert: 'long/results/all': another process is writing to it$"
cp kept.yaml long/study.yaml
cksum <long/results/all >after
expect "it has written" cmp before after
ends_by INT 130 $!
says 'interrupted; resume with: dalembert resume long'
expect "results are lost" test "$(grep -c ',done,' long/cells.csv)" -eq 5
if needs 1 "no python3" there python3; then
    expect "the manifest" json long/manifest.json 'd["status"] == "interrupted" and d["cells"]["done"] == 5'
    counted
fi

case_is "short runs: bad values"
bad 'integrators: [rk4]\nstep: 1\ntime: 1\nrows: some\nsystems: [plane.yaml]\n' \
    "bad.yaml:4:7: unknown rows 'some'; did you mean 'none'"

case_is "short runs by MPI"
if needs 2 "no mpirun, or no dalembert-mpi (make mpi)" has_mpi; then
    by_mpi 0 -n 3 "$mpi_program" bare.yaml --output bare-mpi
    untimed_cells bare-mpi >two.cells
    expect "other bytes" cmp one.cells two.cells
    counted
fi

# 80 bytes are as wide as a line may be; a letter of two is not cut in its middle.
case_is "a title that is too long"
for first in '' x; do
    # 80 columns of letters of two bytes.
    title=$first$(awk 'BEGIN { while (i++ < 90) printf "\303\251" }')
    short=$first$(awk -v first="$first" 'BEGIN { while (i++ < 79 - length(first)) printf "\303\251" }')
    printf '%s\n' "title: $title" 'integrators: rk4' 'step: 0.5' 'time: 1' 'starts: physical' \
        'systems: [line.yaml]' >wide.yaml
    rm -rf wide
    try 0 study wide.yaml --output wide --no-page
    expect "another title after '$first'" test "$(head -n 1 out)" = "$short~"
done

case_is "what becomes of the energy of an oscillator"
# Gauss methods keep E, which is quadratic; stormer-verlet keeps another one near it; rk4 loses the share h^6/72 of it at
# each step.
printf "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n" >oscillator.yaml
printf 'integrators: [gauss4, stormer-verlet, rk4]\nstep: 0.1\ntime: 1000\nstarts: physical\nsystems: [oscillator.yaml]\n' \
    >fates.yaml
try 0 study fates.yaml --output fates --no-page
prints '^E in 3 runs: 1 at rounding, 1 bounded, 1 drift\.$'
prints '^2 of 3 integrators keep E within 1 % on D = 0: '
