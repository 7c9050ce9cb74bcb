# Studies in pieces: interrupted and killed anywhere, in shards and merged, by several processes.

needs 151 "no compiler for signals at given places" raises || return 0
cp plane.yaml plane
cat >pieces.yaml <<'END2'
title: many short runs and a long one
integrators: [gauss4+project, rk4]
step: [0.02, 0.01]
time: 40
samples: 50
systems:
  - contact-oscillator
  - {system: plane, label: plane, starts: physical, time: 4000, step: 0.01}
  - {system: chaplygin-sleigh-vakonomic, integrators: rk4}
  - {system: appell-hamel, starts: physical, set: {w0: -1}}
expect:
  plane: {all: {D: [exact, rounding]}}
  appell-hamel: {all: {state: failed}}
END2
# All bytes except times: the last column of cells.csv.
untimed() { sed 's/,[^,]*$//' "$1/cells.csv"; }
same_study() {
    untimed "$1" >one.untimed
    untimed "$2" >other.untimed
    cmp one.untimed other.untimed && ! diff -rq "$1" "$2" 2>&1 |
        grep -v '/checkpoint\|: checkpoint\|/manifest.json\|cells.csv\|: shard-\|: lock\|: report\|/report'
}

case_is "a study in pieces: the whole"
try 0 study pieces.yaml --output whole-study --threads 1
silent
expect "not 3 kinds of cells" test "$(column state whole-study/cells.csv | sort | uniq -c |
    tr -d ' \n')" = 16done4failed4refused
runs=$(ls whole-study/runs | wc -l)
expect "$runs runs, not 20" test "$runs" -eq 20
for name in $(column run whole-study/cells.csv | grep .); do
    expect "$name" test -s "whole-study/$name/trajectory.npy" -a -s "whole-study/$name/summary.csv"
done
try 0 study pieces.yaml --output two-threads --threads 2
expect "two threads make other bytes" same_study whole-study two-threads
OMP_NUM_THREADS=2
export OMP_NUM_THREADS
try 0 study pieces.yaml --output two-threads --force
unset OMP_NUM_THREADS
expect "OMP_NUM_THREADS makes other bytes" same_study whole-study two-threads
try 0 resume whole-study
prints '^many short runs and a long one$'
expect "a finished study changes" same_study whole-study two-threads

# kill_study SEED THREADS: kill -9 at random calls, twelve times.
kill_study() {
    rm -rf killed-study
    begin="study pieces.yaml --output killed-study"
    for call in $(awk -v seed="$1" 'BEGIN { srand(seed); for (i = 0; i < 12; i++) print 1 + int(30 * rand()) }'); do
        [ -e killed-study/study.yaml ] && begin="resume killed-study"
        cut_off 137 9 "$call" $begin --threads "$2" --checkpoint 0
    done
    [ -e killed-study/study.yaml ] && begin="resume killed-study"
    try 0 $begin --threads "$2"
    expect "killed with seed $1, $2 threads: other bytes" \
        same_study whole-study killed-study
}
case_is "a study in pieces: killed at any moment"
seed=$(date +%s)
echo "cli: a study is killed with seeds $seed and $((seed + 1))"
kill_study "$seed" 1
kill_study $((seed + 1)) 2

case_is "a study in pieces: killed before it was described"
mkdir begun-study
cp -r whole-study/runs whole-study/systems whole-study/manifest.json begun-study
sed 's/short/other/; s/time: 40$/time: 20/' pieces.yaml >another.yaml
try 0 study another.yaml --output begun-study
expect "not begun again" grep -q '^contact-oscillator,.*,20,done' begun-study/cells.csv

case_is "a study in pieces: interrupted"
cut_off 130 2 20 study pieces.yaml --output stopped-study --threads 1 --checkpoint 0
says 'interrupted; resume with: dalembert resume stopped-study'
expect "interrupted" grep -q '"status": "interrupted"' stopped-study/manifest.json
mkdir elsewhere && cd elsewhere || exit 1
try 0 resume ../stopped-study
cd "$work" || exit 1
expect "other bytes" same_study whole-study stopped-study

case_is "a study in pieces: a damaged run"
cp -r whole-study damaged-study
run=damaged-study/runs/plane_rk4_physical_0.01
rm -f $run/checkpoint.before
printf 'x' | dd of=$run/checkpoint bs=1 seek=100 conv=notrunc 2>/dev/null
try 2 resume damaged-study
says 'plane_rk4_physical_0.01/checkpoint: the checkpoint is damaged'
rm -r $run
try 0 resume damaged-study
expect "other bytes" same_study whole-study damaged-study

case_is "shards in directories of their own"
for k in 1 2 3; do
    try 0 study pieces.yaml --output shard-$k --shard $k/3 --tables
    expect "a shard leaves tables" test ! -e shard-$k/tables.txt -a ! -e shard-$k/cells.csv
    expect "its manifest" grep -q '"status": "done"' shard-$k/shard-$k-of-3.json
done
prints '^contact-oscillator: '
count=$(find shard-[123]/runs -mindepth 1 -maxdepth 1 -name '*_*' | wc -l)
expect "$count runs, not 20" test "$count" -eq 20
try 0 merge shard-1 shard-2 shard-3 --output merged
prints '^Expectations: 6 of 6 are met\.$'
expect "other bytes" same_study whole-study merged
try 2 merge shard-1 shard-2 shard-3 --output merged
says "'merged/study.yaml' exists already"
try 0 merge shard-3 shard-1 shard-2 --output merged --force
expect "other bytes in another order" same_study whole-study merged

case_is "shards in one directory"
for k in 1 2; do "$program" study pieces.yaml --output shared --shard $k/2 >out.$k 2>err.$k & done
wait
cat err.1 err.2 >err
silent
table <<'END'
2 | study pieces.yaml --output shared | says 'shared/study.yaml' exists already
2 | study another.yaml --output shared --shard 1/2 | says 'shared/study.yaml' is another study
END
try 0 merge shared --output shared
expect "other bytes" same_study whole-study shared

case_is "a shard that was interrupted"
cut_off 130 2 20 study pieces.yaml --output shard-b --shard 2/2 --threads 1 --checkpoint 0
try 0 study pieces.yaml --output shard-a --shard 1/2
try 2 merge shard-a shard-b --output halves
expect "no message" grep -Eq "in none of the directories|is not finished: dalembert resume" err
try 0 resume shard-b
try 0 merge shard-a shard-b --output halves
expect "other bytes" same_study whole-study halves

case_is "a shard of a study whose system has changed"
cp line.yaml changed.yaml
printf 'integrators: rk4\nstep: 0.5\ntime: 1\nsystems: [changed.yaml]\n' >changed-study.yaml
try 0 study changed-study.yaml --output changed --shard 1/2
echo '# and more' >>changed.yaml
try 2 study changed-study.yaml --output changed --shard 2/2
says "^dalembert: 'changed' is of another study: 'changed/systems/.*' differs\$"

case_is "what cannot be merged"
table <<'END'
2 | merge shard-1 shard-3 --output incomplete | says _.*' is in none of the directories: a shard is missing
2 | merge shard-1 shard-2 shard-3 shard-a --output incomplete | says ' is in 'shard-.' and in 'shard-a'
END
try 2 merge shard-1 shard-1 --output incomplete
says "'shard-1' is given twice"
sed 's/short/shorter/' shard-2/study.yaml >retitled
mv retitled shard-2/study.yaml
try 2 merge shard-1 shard-2 shard-3 --output incomplete
says "'shard-2' and 'shard-1' are of two studies: 'shard-2/study.yaml' and"
cp shard-1/study.yaml shard-2/study.yaml
echo '# changed' >>shard-2/systems/plane.yaml
table <<'END'
2 | merge shard-1 shard-2 shard-3 --output incomplete | says 'shard-2/systems/plane.yaml' and 'shard-1/systems/plane.yaml' differ
2 | merge shard-1 nowhere --output incomplete | says 'nowhere' holds no study
2 | merge nowhere shard-1 --output incomplete | says ^dalembert: 'nowhere' holds no study: there is no nowhere/study.yaml$
2 | merge --output incomplete | says the DIR... is missing
2 | merge shard-1 | says --output is missing
END
cp shard-1/systems/plane.yaml shard-2/systems/plane.yaml
manifest=$(grep -l '"status": "done"' shard-2/runs/*/manifest.json | head -n 1)
sed 's/"status": "done"/"status": "running"/' "$manifest" >begun.json
mv begun.json "$manifest"
try 2 merge shard-1 shard-2 shard-3 --output incomplete
says "^dalembert: 'shard-2/runs/.*' is not finished: dalembert resume shard-2\$"
for shard in 0/2 3/2 2 1/x x/2 1/; do
    try 2 study pieces.yaml --output incomplete --shard $shard
    says '--shard: '
done
expect "something was made" test ! -e incomplete

case_is "a study by MPI"
if needs 13 "no mpirun, or no dalembert-mpi (make mpi)" has_mpi; then
    by_mpi 0 -n 2 "$mpi_program" pieces.yaml --output by-mpi
    prints '^Expectations: 6 of 6 are met\.$'
    expect "other bytes" same_study whole-study by-mpi
    by_mpi 2 -n 2 "$mpi_program" pieces.yaml --output by-mpi
    says "'by-mpi/study.yaml' exists already"
    rm -r by-mpi/runs/plane* by-mpi/cells.csv
    by_mpi 0 -n 3 "$mpi_program" --resume --output by-mpi
    expect "other bytes, resumed" same_study whole-study by-mpi
    by_mpi 2 -n 2 "$mpi_program" nowhere.yaml --output by-mpi
    says "cannot read 'nowhere.yaml'"
    by_mpi 2 -n 2 "$mpi_program" pieces.yaml
    says '--output is missing'
    by_mpi 0 -n 2 "$mpi_program" --help
    prints '^usage: mpirun dalembert-mpi'
    counted
fi
counted
