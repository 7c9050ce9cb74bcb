# The JSON that the program writes, read by another parser, and that it reads: python3's, where there
# is one.  (The C suite json reads texts and numbers back everywhere.)

if needs 52 "no python3" there python3; then
    case_is "the manifest of a run"
    try 0 run ./line.yaml --integrator rk4 --step .1 --time 1e1 --sums plain --times 1,2.5,10 \
        --set k=0.5 --output described
    expect "the options are not what was given" json described/manifest.json \
        "d['input'] == {'system': 'system.yaml', 'integrator': 'rk4', 'step': 0.1, 'time': 10,
                        'times': '1,2.5,10', 'sums': 'plain', 'set': {'k': 0.5}, 'start': {}}"
    expect "no numbers" json described/manifest.json \
        "number(d['t']) and d['t'] == 10 and d['rows'] == 3 and d['steps'] == 100
         and number(d['seconds']) and d['evaluations'] == 400 and d['native'] is False"
    expect "no words" json described/manifest.json "d['status'] == 'done' and d['integrator'] == 'rk4'
         and d['machine']['compiler'] and d['machine']['libyaml']"
    try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --start e=inf --output infinite
    expect "e" json infinite/manifest.json "d['input']['start'] == {'e': 'inf'}"
    rm infinite/checkpoint
    try 0 resume infinite
    cat >ends.yaml <<'END'
coordinates: [x]
accelerations: {x: sqrt(0.5 - t)}
END
    try 3 run ./ends.yaml --integrator rk4 --step 0.1 --time 1 --output ends
    expect "no message" json ends/manifest.json "d['status'] == 'failed' and 't = ' in d['message']"

    case_is "the manifest of a study, with letters beyond ASCII"
    cat >letters.yaml <<'END'
title: "Gr\u00f6\u00dfe \u2013 \U0001D11E \"quoted\" back\\slash\ttab\u2028line"
integrators: [rk4]
step: 0.1
time: 1
systems:
  - {system: line.yaml, label: "\u03b8-l\u00ednea"}
END
    title="'Gr\u00f6\u00dfe \u2013 \U0001D11E \"quoted\" back\\\\slash\ttab\u2028line'"
    try 0 study letters.yaml --output letters
    expect "another title" json letters/manifest.json "d['study'] == $title"
    expect "no counts" json letters/manifest.json "d['status'] == 'done' and number(d['seconds'])
        and sum(d['cells'].values()) == d['cells']['done'] >= 1"
    for manifest in letters/runs/*/manifest.json; do
        expect "$manifest" json "$manifest" "d['status'] == 'done' and d['input']['step'] == 0.1"
    done
    try 0 study letters.yaml --output letters-1 --shard 1/1
    expect "of a shard" json letters-1/shard-1-of-1.json "d['study'] == $title"
    # The title is no obstacle to those who read the manifest.
    try 0 merge letters-1 --output letters-merged
    expect "merged" json letters-merged/manifest.json "d['study'] == $title and d['status'] == 'done'"
    printf 'title: "a status\\n  done"\nintegrators: [rk4]\nstep: 0.1\ntime: 1\nsystems: [line.yaml]\n' \
        >breaks.yaml
    try 0 study breaks.yaml --output breaks
    expect "line ends" json breaks/manifest.json "d['study'] == 'a status\n  done'"

    case_is "a cell makes the request that its options make"
    cat >cell.yaml <<'END'
integrators: [gauss4]
step: 0.3
time: 1.6
samples: 7
statistics: 2
starts: displaced
options: {solver-tolerance: 1e-11, solver: newton}
systems: [{system: line.yaml, label: cell, set: {k: 0.7}, start: {x: 0.1}, displace: {p_x: 3}}]
END
    try 0 study cell.yaml --output cell
    try 0 run ./line.yaml --integrator gauss4 --step 0.29999999999999999 --time 1.6 --samples 7 \
        --sampling steps --statistics 2 --space lifted --solver-tolerance 1e-11 --solver newton \
        --set k=0.7 --start x=0.1 --start p_x=3.0000000000000004e-8 --output one
    input() { python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["input"])' "$1"; }
    expect "$(input cell/runs/cell_*/manifest.json)" \
        [ "$(input cell/runs/cell_*/manifest.json)" = "$(input one/manifest.json)" ]
    expect "other rows" cmp cell/runs/cell_*/trajectory.npy one/trajectory.npy

    case_is "progress"
    try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 5 --progress json --output -
    cp err progress.lines
    expect "not JSON" json progress.lines "set(d) == {'t', 'time', 'steps', 'rows', 'seconds',
        'remaining', 'deviation'} and all(map(number, d['deviation'].values()))"
    cat >burst.yaml <<'END'
coordinates: [x]
lagrangian: x'^2/2
start: {x': 1}
invariants: {never: log(-1 - x^2)}
END
    try 0 run burst.yaml --integrator rk4 --step 0.1 --time 1 --progress json
    cp err burst.lines
    expect "what is not finite is not null" json burst.lines "d['deviation']['never'] is None
        and d['deviation']['E'] == 0"

    case_is "all manifests, in which no name comes twice"
    for manifest in $(find . -name '*.json'); do
        expect "$manifest" json "$manifest" "d['dalembert'] and d['machine'] and d['status']"
    done

    case_is "the readers of JSON, the program's and Python's"
    reader=${program%/*}/tests/read_json
    if needs 1 "no read_json (make build/tests/read_json)" test -x "$reader"; then
        python3 "$here/read_json.py" "$reader" >compared 2>&1
        status=$?
        expect "$(cat compared)" [ $status -eq 0 ]
        counted
    fi
    counted
fi

case_is "a manifest nested too deep is refused at once"
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --output deep
{ printf '{"dalembert": "0.2.0", "input": ' && head -c 100000 /dev/zero | tr '\0' '['; } >deep/manifest.json
try 2 resume deep
says 'deep/manifest.json'


# Whether a run or a study is over is read from its manifest, however that is laid out.
case_is "manifests laid out otherwise"
lay_out() { sed 's/^  "status": /"status"   :/' "$1" >laid.json && cp laid.json "$1"; }
printf 'title: laid out\nintegrators: [rk4]\nstep: 0.1\ntime: 1\nsystems: [line.yaml]\n' >laid.yaml
try 0 study laid.yaml --output laid-1 --shard 1/1
for manifest in laid-1/runs/*/manifest.json laid-1/*.json; do lay_out "$manifest"; done
try 0 merge laid-1 --output laid-whole
rm -rf dalembert-study
try 0 study laid.yaml
lay_out dalembert-study/manifest.json
try 0 study laid.yaml
rm -rf dalembert-study
