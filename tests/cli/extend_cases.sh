# Directories that are extended have the bytes of a run to the later end from the beginning.

# extends END ROWS RUN...: `resume --END` of a run extends it to ROWS rows after the first, like the run to there.
extends() {
    end=$1 rows=$2
    shift 2
    rm -rf short long
    try 0 run "$@" --output short
    case $end in --*) ;; *) end="--time $end" ;; esac
    try 0 resume short $end
    says "'short' resumes at t = "
    # What is given twice is the last of both for the longer run.
    set -- "$@" --samples "$rows"
    drop=
    for word; do
        shift
        case $word in --time | --steps) drop=yes && continue ;; esac
        [ -n "$drop" ] && drop= && continue
        set -- "$@" "$word"
    done
    try 0 run "$@" $end --output long
    for file in trajectory.npy summary.csv events.csv; do
        [ ! -e long/$file ] || expect "not the $file of the longer run" cmp short/$file long/$file
    done
    expect "not the input of the longer run" input_is_same
}
input_is_same() {
    for run in short long; do sed -n '/"input"/,/^  }/p' $run/manifest.json >$run.input; done
    cmp short.input long.input
}
sleigh="chaplygin-sleigh --step 0.03"

case_is "rows at the same distance, between steps and at steps"
extends 30 300 $sleigh --integrator rk4 --time 10
extends 7 700 $sleigh --integrator gauss4 --statistics 3 --time 1
extends 3.3 300 chaplygin-sleigh --integrator gauss8 --step 0.007 --time 1.1
extends 8.3 300 $sleigh --integrator rk4 --from 5 --time 6.1
extends -3.3 300 chaplygin-sleigh --integrator rk4 --step -0.03 --time -1.1
extends "--steps 900" 300 chaplygin-sleigh --integrator rk4 --step 0.1 --steps 300
extends 90 300 chaplygin-sleigh --integrator rk4 --step 0.1 --steps 300
extends "--steps 99" 300 chaplygin-sleigh --integrator rk4 --step 0.1 --time 3.3
extends 3.3 300 chaplygin-sleigh --integrator rk4 --sampling steps --time 1.1 --step 0.01
extends 20 200 pendulum-cvt --integrator gni --step 0.1 --time 10 --columns q,E --observe 'xi^2'

case_is "a tolerance, quad precision"
extends 3.9 300 chaplygin-sleigh --integrator dop853 --tolerance 1e-9 --step 0.3 --time 1.3
extends 3.9 300 chaplygin-sleigh --integrator taylor --tolerance 1e-9 --step 0.3 --time 1.3
extends 0.6 30 $sleigh --integrator gauss4 --precision quad --time 0.2 --samples 10
rm -rf short long
try 0 run chaplygin-sleigh --integrator dop853 --tolerance 1e-9 --time 3 --output short
try 0 resume short --time 9
try 0 run chaplygin-sleigh --integrator dop853 --tolerance 1e-9 --step 0.03 --time 9 --samples 300 --output long
expect "another step than the one that was chosen" cmp short/trajectory.npy long/trajectory.npy

case_is "compiled steps"
if needs 7 "no C compiler" there "${CC:-cc}"; then
    extends 30 300 $sleigh --integrator gauss4 --time 10 --native on
    counted
fi

case_is "events"
cat >ball.yaml <<'EOF'
coordinates: [y]
lagrangian: y'^2/2 - 9.81*y
start: {y: 1.1}
events: [{when: y, direction: down, restitution: 0.9}]
EOF
extends 6 60 ball.yaml --integrator gauss4 --step 0.01 --time 2 --samples 20
expect "the rows have no events" [ "$(wc -l <short/events.csv)" -gt 5 ]

case_is "times of a list"
try 0 run $sleigh --integrator rk4 --times 0.1,0.5,2 --output list
try 0 resume list --time 3
try 0 resume list --time 4
try 0 run $sleigh --integrator rk4 --times 0.1,0.5,2,3 --time 4 --output listed
expect "not the rows of the longer run" cmp list/trajectory.npy listed/trajectory.npy
expect "not its summary" cmp list/summary.csv listed/summary.csv

case_is "extended again and again, and written by version 0.4"
rm -rf short long
try 0 run $sleigh --integrator rk4 --time 1 --output short
for end in 2 3 5 10; do try 0 resume short --time $end; done
try 0 run $sleigh --integrator rk4 --time 10 --samples 1000 --output long
expect "not the rows of the longer run" cmp short/trajectory.npy long/trajectory.npy
expect "not its summary" cmp short/summary.csv long/summary.csv
try 0 resume short --time 10
says "'short' is finished: 1001 rows"
rm -rf taken
cp -r "$here/data/format-04" taken
try 0 resume taken --time 8000
says "taken/manifest.json: made by dalembert 0\.[0-9.]*; the bits may differ"
expect "not 200 rows more" has_rows taken/trajectory.npy 201

if needs 62 "no compiler for signals at given places" raises; then
    case_is "a run that is not finished"
    rm -rf cut
    cut_off 130 2 3 run $sleigh --integrator rk4 --step 1e-3 --time 5 --checkpoint 0 --output cut
    try 0 resume cut --time 10
    try 0 run $sleigh --integrator rk4 --step 1e-3 --time 10 --samples 200 --output whole
    expect "not the rows of the longer run" cmp cut/trajectory.npy whole/trajectory.npy
    expect "not its summary" cmp cut/summary.csv whole/summary.csv

    # At every rename: of the checkpoint before, of the new one, of the manifest; and extended twice.
    case_is "killed while it is extended"
    rm -rf cut begun
    try 0 run $sleigh --integrator rk4 --step 1e-3 --time 5 --output begun
    for call in 1 2 3 4 5 6 7; do
        rm -rf cut
        cp -r begun cut
        cut_off 137 9 $call resume cut --time 10 --checkpoint 0
        try 0 resume cut --time 10
        expect "call $call: not the rows of the longer run" cmp cut/trajectory.npy whole/trajectory.npy
        expect "call $call: not its summary" cmp cut/summary.csv whole/summary.csv
        rm -rf cut
        cp -r begun cut
        cut_off 137 9 1 resume cut --time 7.5 --checkpoint 0
        cut_off 137 9 $call resume cut --time 10 --checkpoint 0
        try 0 resume cut --time 10
        expect "twice, call $call: not the rows of the longer run" cmp cut/trajectory.npy whole/trajectory.npy
    done
    counted
fi

case_is "ends that a run does not have"
rm -rf short
try 0 run $sleigh --integrator rk4 --time 10 --output short
try 0 run $sleigh --integrator rk4 --time 10 --samples 100 --sampling log --output log
cp -r short kept
cp -r log many
sed 's/"samples": 100,/"samples": 100000001,/' log/manifest.json >many/manifest.json
table <<'END'
2 | resume short --time 10.05 | says ^dalembert: --time: the rows, 0\.1 apart, go on to t = 10 or t = 10\.1, not to t = 10\.05$
2 | resume short --time 5     | says ^dalembert: --time: 'short' goes to t = 10 already, and t = 5 is not later$
2 | resume short --time -20   | says ^dalembert: --time: 'short' goes to t = 10 already, and t = -20 is not later$
2 | resume short --steps 300  | says ^dalembert: --steps: 'short' goes to t = 10 already, and t = 9 is not later$
2 | resume short --steps 334  | says ^dalembert: --steps: the rows, 0\.1 apart, go on to t = 10 or t = 10\.1, not to t = 10\.02$
2 | resume short --time x     | says ^dalembert: --time: 'x' is not a number$
2 | resume short --time inf   | says ^dalembert: --time:
2 | resume short --steps 0    | says ^dalembert: --steps: 0 is not in 1\.\.
2 | resume short --time 20 --steps 700 | says ^dalembert: --steps excludes --time$
2 | resume log --time 20      | says ^dalembert: --time: the rows of --sampling log have no distance at which they could go on$
2 | resume short --time 12.0000000001 | says ^dalembert: --time: row 1 of a run to 12\.0000000001 is at t = 0\.1000000000008[0-9]*, and of this one at 0\.1[0-9]*: a multiple of the time 10 has the same rows$
2 | resume nothing --time 20  | says ^dalembert: there is no directory 'nothing'$
END
expect "it was changed" diff -r short kept
try 2 resume many --time 20
says '^dalembert: --samples: 100000001 are too many for --sampling log$'
expect "another message" [ "$(wc -l <err)" -eq 1 ]

case_is "runs that have no continuation"
sed 's/restitution: 0.9/stop: true/' ball.yaml >stop.yaml
try 0 run stop.yaml --integrator gauss4 --step 0.01 --time 3 --output stopped
printf "coordinates: [x]\nlagrangian: x'^2/2 + x^3/3\nstart: {x: 1}\n" >blow-up.yaml
try 3 run blow-up.yaml --integrator rk4 --step 0.1 --time 100 --output failed
cp -r failed failed.kept
table <<'END'
2 | resume stopped --time 6 | says ^dalembert: 'stopped' cannot be extended: an event stopped the run: event 1 \(y\) stopped the run at t = 0\.47
2 | resume failed --time 200 | says ^dalembert: 'failed' cannot be extended: the run failed: .* t = 
END
expect "it was changed" diff -r failed failed.kept
# Killed between the last checkpoint and the manifest.
sed -e 's/"status": "done"/"status": "running"/' -e '/"message"/d' stopped/manifest.json >manifest
sed 's/\("seconds": [^,]*\),$/\1/' manifest >stopped/manifest.json
try 2 resume stopped --time 6
says "^dalembert: 'stopped' cannot be extended: event 1 stopped the run at t = 0\.47"

# grows KEYS: a study whose file gets other integrators, steps, systems and a longer time is the study of that file.
grows() {
    rm -rf small grown
    printf "title: A\nintegrators: [rk4]\nstep: 0.05\ntime: 4\nsystems: [chaplygin-sleigh]\n$1" >small.yaml
    printf "title: A\nintegrators: [gauss4, rk4]\nstep: [0.025, 0.05]\ntime: $2\n\
systems: [pendulum-cvt, chaplygin-sleigh]\n$1" >grown.yaml
    try 0 study small.yaml --no-page --output small
    cp grown.yaml small/study.yaml
    try 0 resume small --no-page
    try 0 study grown.yaml --no-page --output grown
    for file in tables.txt quantities.csv; do
        expect "not the $file of the study" cmp small/$file grown/$file
    done
}

case_is "a study that grows"
grows '' 4
before=$(cat small/runs/chaplygin-sleigh_rk4_surface_0.05/manifest.json)
expect "other runs" [ "$(ls small/runs)" = "$(ls grown/runs)" ]
try 0 resume small --no-page
expect "a finished run was run again" \
    [ "$before" = "$(cat small/runs/chaplygin-sleigh_rk4_surface_0.05/manifest.json)" ]
case_is "a study that gets more time"
grows '' 6
for run in grown/runs/*; do
    expect "other rows" cmp "$run/trajectory.npy" "small/runs/${run##*/}/trajectory.npy"
done

# Cells without rows are run once: the record of one that was there before stays the first.
case_is "a study without rows that grows"
first_record() { head -c 160 small/results/all | od -An -tx1; }
grows 'rows: none\n' 4
begun=$(first_record)
size=$(wc -c <small/results/all)
try 0 resume small --no-page
expect "finished cells were run again" [ "$size" -eq "$(wc -c <small/results/all)" -a "$begun" = "$(first_record)" ]
grows 'rows: none\n' 6

# A shard of a study and of one that grew from it have the same cells to run only by name.
case_is "shards of a study that grow"
for keys in '' 'rows: none\n'; do
    rm -rf one two whole
    printf "title: A\nintegrators: [rk4]\nstep: 0.05\ntime: 4\nsystems: [chaplygin-sleigh]\n$keys" >small.yaml
    printf "title: A\nintegrators: [gauss4, rk4]\nstep: 0.05\ntime: 4\nsystems: [pendulum-cvt, chaplygin-sleigh]\n$keys" >grown.yaml
    for shard in one:1/2 two:2/2; do
        try 0 study small.yaml --no-page --output ${shard%:*} --shard ${shard#*:}
        cp grown.yaml ${shard%:*}/study.yaml
        try 0 resume ${shard%:*} --no-page
    done
    try 0 merge one two --output whole --no-page
    rm -rf grown
    try 0 study grown.yaml --no-page --output grown
    for file in tables.txt quantities.csv; do
        expect "'$keys': not the $file of the study" cmp whole/$file grown/$file
    done
done

case_is "what a study and an ensemble refuse"
rm -rf small
printf "title: A\nintegrators: [rk4]\nstep: 0.05\ntime: 6\nsystems: [chaplygin-sleigh]\n" >small.yaml
try 0 study small.yaml --no-page --output small
cp small/study.yaml long.yaml
sed 's/time: 6/time: 5/' long.yaml >small/study.yaml
try 2 resume small --no-page
says "holds another run: its input differs"
cp long.yaml small/study.yaml
try 0 ensemble chaplygin-sleigh --members 2 --seed 1 --vary 'm=uniform(0,0.1)' --integrator rk4 --step 0.1 --time 1 \
    --no-page --output members
table <<'END'
2 | resume small --time 9    | says ^dalembert: --time: 'small' holds a study: change 'small/study\.yaml' and resume it$
2 | resume members --steps 9 | says ^dalembert: --steps: 'members' goes to t = 1 already, and t = 0\.9 is not later$
2 | resume members --time 1.23 | says ^dalembert: --time: 1\.23 is not a whole number of steps of 0\.1 from t = 0$
2 | resume members --time 2 --steps 30 | says ^dalembert: --steps excludes --time$
2 | resume members --members 1 | says ^dalembert: --members: 'members' has 2 members already, and 1 are fewer$
2 | resume small --members 9 | says ^dalembert: --members: 'small' holds no ensemble$
2 | resume log --members 9   | says ^dalembert: --members: 'log' holds no ensemble$
END
