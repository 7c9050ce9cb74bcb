# `predict: on` of a study: what single steps predict, beside what its runs measure.

cat >ahead.yaml <<'END2'
title: Said before the runs
integrators: [rk4, gauss4+project, implicit-midpoint, gni]
step: [0.1, 0.05]
time: 20
starts: physical
predict: on
systems:
  - pendulum-cvt
  - {system: contact-oscillator, rows: none}
  - {system: chaplygin-sleigh, label: started, integrators: rk4, step: 0.05, from: 1, set: {omega: 1.5}, start: {y1: 0.5}}
  - {system: knife-edge, predict: off, integrators: rk4}
  - {system: heisenberg, label: lifted, integrators: rk4, step: 0.05, starts: [surface, displaced], rows: none}
END2
# All columns but the seconds.
untimed() {
    sed ':a; s/\("[^",]*\),\([^"]*"\)/\1;\2/; ta' "$1/cells.csv" | awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "seconds") k = i }
        { $k = ""; print }'
}
# cells PYTHON: whether it holds of the rows of ahead/cells.csv.
cells() {
    python3 -c "
import csv, sys
rows = list(csv.DictReader(open('ahead/cells.csv')))
def of(label, integrator, step=0.05, start='physical'):
    return [r for r in rows if (r['label'], r['integrator'], float(r['step']), r['start']) == (label, integrator, step, start)][0]
def near(r, name, most=0.01):
    return abs(float(r['predicted_' + name]) / float(r[name]) - 1) < most
sys.exit(not ($1))"
}

case_is "predictions of a study"
try 0 study ahead.yaml --output ahead --threads 1 --no-page
silent
prints '^Predicted sizes of D, E and invariants: 2[0-9] of 26 within 1 % of the runs., 26$'
prints '^  within 10 %; runs predicted in part: 3, not at all: 4.$'
if needs 10 "no python3" there python3; then
    expect "sizes of runs that leave D = 0" cells "all(near(of(s, 'rk4'), name) for s in ('pendulum-cvt', 'contact-oscillator', 'started')
        for name in ('D_max', 'E_deviation', 'invariant_deviation'))"
    expect "sizes of runs that do not" cells "all(near(of('pendulum-cvt', 'gauss4+project', h), name)
        for h in (0.1, 0.05) for name in ('E_deviation', 'invariant_deviation'))"
    expect "another start, on p = pi = 0" cells "near(of('lifted', 'rk4', start='surface'), 'E_deviation')"
    expect "the end of the run" cells "float(of('started', 'rk4')['predicted_until']) == 20 and of('started', 'rk4')['predicted_message'] == ''"
    expect "an earlier end" cells "float(of('pendulum-cvt', 'implicit-midpoint', 0.1)['predicted_until']) < 20
        and of('pendulum-cvt', 'implicit-midpoint', 0.1)['predicted_message'].startswith('there D may have moved')"
    expect "a reason" cells "all(of(s, 'gni')['predicted_message'].startswith('no drift of gni can be predicted: its multipliers')
        and of(s, 'gni')['predicted_until'] == of(s, 'gni')['predicted_E_deviation'] == '' for s in ('pendulum-cvt', 'contact-oscillator'))"
    expect "displaced" cells "'p and pi are not 0' in of('lifted', 'rk4', start='displaced')['predicted_message']"
    expect "0 by reversibility" cells "all(float(of('contact-oscillator', 'implicit-midpoint')['predicted_E_rate' + end]) == 0
        for end in ('', '_low', '_high'))"
    expect "an interval" cells "all(float(r['predicted_E_rate_low']) < float(r['predicted_E_rate']) < float(r['predicted_E_rate_high'])
        for r in [of('pendulum-cvt', 'rk4')])"
    expect "where the key is off" cells "all(not v for k, v in of('knife-edge', 'rk4').items() if k.startswith('predicted'))"
    counted
fi

case_is "predictions of a study: the same as of predict"
try 0 predict contact-oscillator --integrator rk4 --step 0.05 --time 20 --json
python3 -c "
import csv, json
e = json.load(open('out'))['predictions'][0]['observables'][1]
r = [r for r in csv.DictReader(open('ahead/cells.csv')) if r['label'] == 'contact-oscillator' and r['integrator'] == 'rk4'][1]
print(e['name'] == 'E' and float(r['predicted_E_deviation']) == e['max_change'] and float(r['predicted_E_rate']) == e['rate'])" >same 2>&1
there python3 && expect "other numbers: $(cat same)" grep -q '^True$' same

case_is "predictions of a study: resumed, in shards, merged"
untimed ahead >one.cells
same_cells() {
    untimed "$1" >other.cells
    cmp one.cells other.cells
}
try 0 study ahead.yaml --output two --threads 2 --no-page
expect "threads change bytes" same_cells two
size=$(wc -c <ahead/predictions/all)
for length in 0 17 $((size / 2)) $((size - 1)); do
    cp -r ahead cut
    head -c "$length" ahead/predictions/all >cut/predictions/all
    rm cut/cells.csv
    try 0 resume cut
    expect "other bytes after $length" same_cells cut
    expect "$length: not all" test "$(wc -c <cut/predictions/all)" -eq "$size"
    rm -r cut
done
try 0 study ahead.yaml --shard 1/2 --output half --no-page
try 0 study ahead.yaml --shard 2/2 --output other-half --no-page
try 0 merge half other-half --output merged
expect "a merge changes bytes" same_cells merged
expect "a merge loses some" test "$(wc -c <merged/predictions/all)" -eq "$size"

case_is "predictions of a study: a figure that cannot be written"
cp -r ahead blocked
mkdir -p blocked/report/predicted.gp
try 4 report blocked
says "^dalembert: cannot write 'blocked/report/predicted.gp': Is a directory$"
empty

case_is "predictions of a study: interrupted"
if needs 6 "no compiler for signals at given places" raises; then
    sed 's/^\(integrators:\).*/\1 rk4/; s/^\(step:\).*/\1 0.05/; /^  - /{ /pendulum-cvt/!d }' ahead.yaml >single.yaml
    # The signal comes when the run is done: its prediction is the first to see it.
    cut_off 130 2 4 study single.yaml --output single --threads 1 --no-page --checkpoint 1e6
    expect "the run is not done" grep -q '"status": "done"' single/runs/pendulum-cvt_rk4_physical_0.05/manifest.json
    prints '^1 runs in .*: 1 not run\.$'
    expect "a cell without its prediction" test "$(wc -l <single/cells.csv)" -eq 1
    try 0 resume single
    expect "no prediction" test "$(column predicted_until single/cells.csv)" = 20
    counted
fi

case_is "predictions of a study: by MPI"
if needs 4 "no mpirun, or no dalembert-mpi (make mpi)" has_mpi; then
    by_mpi 0 -n 3 "$mpi_program" ahead.yaml --output by-mpi
    expect "processes change bytes" same_cells by-mpi
    rm by-mpi/cells.csv by-mpi/predictions/writer-1
    by_mpi 0 -n 2 "$mpi_program" --resume --output by-mpi
    expect "processes change bytes, resumed" same_cells by-mpi
    counted
fi

case_is "predictions of a study: the key"
sed 's/^predict: on/predict: yes/' ahead.yaml >bad.yaml
try 2 study bad.yaml --output bad
says "bad.yaml:6:10: unknown predict 'yes'"
sed '/^predict: on/d; s/, predict: off//' ahead.yaml >none.yaml
try 0 study none.yaml --output none --no-page
expect "columns without it" test "$(head -1 none/cells.csv | grep -c predicted)" -eq 0
expect "a directory without it" test ! -e none/predictions
refute "a sentence without it" grep -q '^Predicted sizes' out
