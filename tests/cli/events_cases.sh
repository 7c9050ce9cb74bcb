# Events: impacts, stops, logs, and runs with them that are interrupted.

needs 411 "no compiler for signals at given places" raises || return 0
examples=$here/../../examples
# A ball above a floor; the times of its bounces are t1 (1 + 2 c (1 - c^k)/(1 - c)), t1 = sqrt(2/g).
cat >ball.yaml <<'END'
coordinates: [y]
parameters: {g: 9.81, c: 0.8, r: 0.1}
lagrangian: y'^2/2 - g*y
start: {y: 1.1}
events:
  - {when: y - r, direction: down, restitution: c}
END
ball="ball.yaml --integrator gauss4 --step 0.01"
# bounces FILE COUNT: the times and the states of a log agree with the closed form.
bounces() {
    awk -F, -v bounces="$2" 'NR == 1 { next }
        { g = 9.81; c = 0.8; k = NR - 2; t = sqrt(2/g)*(1 + 2*c*(1 - c^k)/(1 - c))
          if (($1 - t)^2 > 1e-24 || $2 != 1 || ($3 - 0.1)^2 > 1e-28) exit 1
          if (($4 - c^(k + 1)*sqrt(2*g))^2 > 1e-24) exit 1 }
        END { exit NR != bounces + 1 }' "$1"
}

case_is "a log of events"
try 0 run $ball --time 3 --events log.csv
silent
expect "its head" grep -qx "t,event,y,y',e,p_y,pi_y,pi_e" log.csv
expect "not the closed form" bounces log.csv 6
try 0 run $ball --time 3 --space physical --events log.csv --names plain
expect "its head" grep -qx "t,event,y,vy" log.csv
expect "not the closed form" bounces log.csv 6
try 2 run line.yaml --integrator rk4 --step 0.1 --time 1 --events none.csv
says '^dalembert: --events: line.yaml has no events$'
for file in - both.csv; do
    try 2 run $ball --time 3 --output both.csv --events $file
    says "dalembert: --events $file: .*the rows"
done
try 4 run $ball --time 3 --events none/log.csv
says 'none/log.csv'

case_is "a log that is full"
if needs 4 "no /dev/full" test -c /dev/full; then
    try 4 run $ball --set c=1 --time 1000 --samples 1000 --output rows.csv --events /dev/full
    says "^dalembert: cannot write '/dev/full': "
    expect "another message" [ "$(wc -l <err)" -eq 1 ]
    expect "the run goes on" [ "$(wc -l <rows.csv)" -lt 1000 ]
    counted
fi

case_is "events that a step may hide"
printf "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\nevents: [{when: cos(1e6*x), direction: up}]\n" >fast.yaml
try 0 run fast.yaml --integrator rk4 --step 0.01 --time 0.01
says '^dalembert: [0-9]* steps may hide events, the first from t = 0: '
sed 's/1e6/7/' fast.yaml >slow.yaml
try 0 run slow.yaml --integrator rk4 --step 0.7 --time 6.3 --events slow.csv
silent
expect "not all 7" awk -F, 'NR > 1 { t = (2*NR - 2.5)*3.14159265358979324/7; if (($1 - t)^2 > 1e-26) exit 1 }
    END { exit NR != 8 }' slow.csv

case_is "E without its jumps"
try 0 run $ball --time 3 --summary
expect "E is not kept to rounding" grep -Eq '^E .* rounding ' err

case_is "an event stops a run"
sed 's/restitution: c/stop: true/' ball.yaml >stop.yaml
try 0 run stop.yaml --integrator gauss4 --step 0.01 --time 3 --samples 30 --output stopped
says '^dalembert: stop.yaml: event 1 \(y - r\) stopped the run at t = 0.45152'
expect "not 6 rows" has_rows stopped/trajectory.npy 6
expect "no reason in the manifest" grep -q '"message": "event 1 (y - r) stopped the run' stopped/manifest.json
expect "not done" grep -q '"status": "done"' stopped/manifest.json
try 0 resume stopped
says "'stopped' is finished: 6 rows"

# Every number of the state, with the right sum: none crashes, and what no run has is named.
if needs 281 "no python3" there python3; then
    case_is "a checkpoint whose numbers were changed"
    try 0 run $ball --time 1 --samples 10 --space physical --output ended
    mkdir checkpoints
    python3 "$here/change_checkpoint.py" ended/checkpoint all checkpoints nan 0.5 -3 1e18
    numbers=$(find checkpoints -name '*_nan' | grep -c .)
    expect "fewer numbers than a state has" [ "$numbers" -gt 20 ]
    : >messages
    for value in nan 0.5 -3 1e18; do
        number=0
        while [ $number -lt "$numbers" ]; do
            rm -rf changed
            cp -r ended changed
            rm -f changed/checkpoint.before
            mv checkpoints/${number}_$value changed/checkpoint
            "$program" resume changed >out 2>err
            status=$?
            expect "number $number is $value: exit $status" [ $status -le 3 ]
            [ $status -ne 2 ] || expect "number $number is $value: no reason" grep -q "^dalembert: changed/checkpoint: \
the checkpoint is damaged: persistent number" err
            cat err >>messages
            number=$((number + 1))
        done
    done
    for name in "the time" "the number of steps" "the number of evaluations" "uses_newton" "the size of a substep" \
        "the side of an event" "times that an event happened" "the event that stopped the run" \
        "the number of events at one time" "the jump of an observable"; do
        expect "no word of $name" grep -Eq "persistent number [0-9]+(, .*$name, is | is not finite)" messages
    done
    rm -rf changed checkpoints
    counted
fi

case_is "infinitely many events"
try 3 run $ball --set c=0.5 --time 3 --samples 3 --output endless
says 'event 1 \(y - r\) happens infinitely often: number [0-9]* is at t = 1.35457'
expect "the rows are not kept, or not the last one" has_rows endless/trajectory.npy 3
expect "not failed" grep -q '"status": "failed"' endless/manifest.json
try 3 resume endless
says 'happens infinitely often'
expect "another row of the same state" has_rows endless/trajectory.npy 3
try 3 run $ball --set c=0.5 --time 3 --samples 3
expect "the last row is not at the end: $(tail -1 out)" grep -q '^1\.35457' out

case_is "velocities that lead out"
sed "s|restitution: c|set: {y': y'/2}|" ball.yaml >out.yaml
try 3 run out.yaml --integrator gauss4 --step 0.01 --time 3
says 'event 1 \(y - r\) at t = 0.45152.*still lead out'
printf "coordinates: [x]\nlagrangian: x'^2/2\nconstraints: [x' - 1]\nstart: {x': 1}
events: [{when: x - 0.5, restitution: 1}]\n" >held.yaml
try 3 run held.yaml --integrator rk4 --step 0.1 --time 1
says 'event 1 \(x - 0.5\) at t = 0.5 changes no velocity that the constraints leave free'

case_is "killed between events"
long="ball.yaml --integrator gauss8 --step 0.001 --time 4 --samples 4001 --set c=0.9"
try 0 run $long --output whole --events whole.csv
expect "not its own log" cmp whole.csv whole/events.csv
cut_off 137 9 6 run $long --checkpoint 0 --output killed
for call in 3 8 15; do cut_off 137 9 $call resume killed --checkpoint 0; done
printf '3.5,1,0' >>killed/events.csv
try 0 resume killed --events killed.csv
expect "not the rows of a run never interrupted" cmp killed/trajectory.npy whole/trajectory.npy
expect "not the summary of a run never interrupted" cmp killed/summary.csv whole/summary.csv
expect "not the events of a run never interrupted" cmp killed/events.csv whole/events.csv
expect "not a copy" cmp killed.csv whole/events.csv
cp -r endless lost
head -1 endless/events.csv >lost/events.csv
try 2 resume lost
says "'lost/events.csv' has fewer than the [0-9]* events of the run"
rm lost/events.csv
try 4 resume lost
says "^dalembert: cannot read 'lost/events.csv': No such file or directory$"
expect "another message" [ "$(wc -l <err)" -eq 1 ]

case_is "compiled steps have the same bits"
try 0 run $ball --time 3 --samples 7 --native off --output interpreted.csv
if needs 2 "no compiler" there cc; then
    try 0 run $ball --time 3 --samples 7 --native on --output compiled.csv
    expect "other bits" cmp compiled.csv interpreted.csv
    counted
fi

# It stops at t = 2.2/(mu g) = 2.2/2.943; the steps about the stop are interpreted.
case_is "a block that dry friction stops"
cat >block.yaml <<'END'
coordinates: [x]
parameters: {m: 1.5, mu: 0.3, g: 9.81}
lagrangian: m/2*x'^2
forces: {x: -mu*m*g*sign(x')}
start: {x': 2.2}
events: [{when: x', direction: down, stop: true}]
END
for method in rk4 gauss8 stormer-verlet gni; do
    block="block.yaml --integrator $method --step 0.007 --time 2 --samples 50"
    try 0 run $block --native off --output interpreted.csv
    expect "$method: another time" awk -F, '{ t = $1 } END { exit (t - 2.2/2.943)^2 > 1e-24 }' interpreted.csv
    if needs 2 "no compiler" there cc; then
        try 0 run $block --native on --output compiled.csv
        expect "$method: other bits" cmp compiled.csv interpreted.csv
        counted
    fi
done

case_is "commands that would pass over events"
for command in "lyapunov $ball --time 1" "section $ball --time 1 --on y" "explain $ball --time 1" \
    "generate ball.yaml --integrator gauss4" "volume $ball --time 1"; do
    try 2 $command
    says 'ball has events: .* would pass over them'
    empty
done
try 2 order ball.yaml --integrators gauss4 --step 0.1 --time 1
says 'ball.yaml has events'
try 0 check ball.yaml
prints ' 0 failed'

case_is "studies with events"
cat >study.yaml <<'END'
integrators: [rk4, gauss4]
step: 0.01
time: 2
systems:
  - ball.yaml
  - {system: stop.yaml, label: stopped}
expect:
  all: {gauss4: {E: rounding}}
  stopped: {all: {state: [done, refused]}}
END
try 0 study study.yaml --output rows
expect "not its own events" bounces rows/runs/ball.yaml_gauss4_surface_0.01/events.csv 3
# A displaced lift has no events: it is refused, and nothing fails.
expect "not refused" test "$(column state rows/cells.csv | sort | uniq -c | tr -s ' \n' ' ')" = " 8 done 4 refused "
expect "no reason" grep -q 'events act on p = pi = 0 only' rows/cells.csv
sed 's/^time: 2/&\nrows: none/' study.yaml >none.yaml
try 0 study none.yaml --output none
for column in state status message reached steps E_deviation E_size; do
    expect "rows: none: other $column" [ "$(column $column none/cells.csv)" = "$(column $column rows/cells.csv)" ]
done

# E falls by m ((c v)^2 - v^2)/2 with the velocity v across the slope; the part along it is untouched.
case_is "a ball on a slope"
try 0 run "$examples/ball-on-incline.yaml" --samples 20 --columns q,v,E,along --output slope.csv --events slope-events.csv
expect "not the closed form" awk -F, 'NR == 1 { next }
    { a = 0.3; g = 9.81*cos(a); c = 0.8; k = NR - 2; t = sqrt(1/g)*(1 + 2*c*(1 - c^k)/(1 - c))
      v = $5*sin(a) + $6*cos(a)
      if (($1 - t)^2 > 1e-24 || (v - c^(k + 1)*sqrt(g))^2 > 1e-24) exit 1 }
    END { exit NR < 5 }' slope-events.csv
expect "the motion along the slope changed" awk -F, 'NR > 1 && $7^2 > 1e-24 { exit 1 }' slope.csv

case_is "a pendulum with a stop"
try 0 run "$examples/pendulum-with-stop.yaml" --samples 20 --columns E --output stop.csv --events stop-events.csv
expect "E is not conserved" awk -F, 'NR > 1 && ($2 + 0.36235775447667357)^2 > 1e-24 { exit 1 }' stop.csv
# theta'^2/2 = cos 0.5 - cos 1.2, at times (2k + 1) t_1
expect "other impacts" awk -F, 'NR == 1 { next } NR == 2 { first = $1 }
    { v = -sqrt(2*(cos(0.5) - cos(1.2)))
      if (($4 - v)^2 > 1e-24 || ($1 - (2*NR - 3)*first)^2 > 1e-22) exit 1 } END { exit NR < 5 }' stop-events.csv

case_is "a robot at a wall"
for method in gauss8+project rk4 dop853 gni dla lobatto-nonholonomic4; do
    try 0 run "$examples/robot-at-wall.yaml" --integrator $method --step 0.01 --space physical --events robot.csv
    expect "$method: D after an impact" awk -F, 'NR > 1 && ($6*sin($5) - $7*cos($5))^2 > 1e-30 { exit 1 }
        END { exit NR != 3 }' robot.csv
done
counted
