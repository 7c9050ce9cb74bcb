# Reactions: columns h1.., R_x.., lambda1.., the option, formulas with them.

header() { head -1 "$1"; }
motion="--integrator gauss8 --step 0.1 --time 2 --samples 10 --space physical"

case_is "reactions: columns on request alone"
try 0 run chaplygin-sleigh $motion
expect "header" [ "$(header out)" = "t,y1,y2,phi,y1',y2',phi',D1,E,speed,spin,error" ]
mv out plain
try 0 run chaplygin-sleigh $motion --reactions on --output all.csv
expect "header" \
    [ "$(header all.csv)" = "t,y1,y2,phi,y1',y2',phi',D1,E,speed,spin,h1,R_y1,R_y2,R_phi,error" ]
expect "the trajectory changes" \
    [ "$(cut -d, -f1-11 plain)" = "$(cut -d, -f1-11 all.csv)" ]
for list in h,R h1,R_y1,R_y2,R_phi 'h*,R_*'; do
    try 0 run chaplygin-sleigh $motion --columns "$list"
    expect "$list" [ "$(cat out)" = "$(cut -d, -f1,12-15 all.csv)" ]
done
try 0 run chaplygin-sleigh $motion --integrator gni --columns lambda
expect "header" [ "$(header out)" = "t,lambda1" ]
expect "lambda of the start is not h" [ "$(sed -n 2p out)" = "0,-1" ]

case_is "reactions: native, in quad precision, generated"
if needs 14 "no compiler" there cc; then
    for method in gauss8 gni; do
        for native in off on; do
            try 0 run knife-edge-reaction $motion --integrator $method --statistics 3 \
                --native $native --columns h,R --output "$method-$native"
        done
        for file in trajectory.npy summary.csv; do
            expect "$method: other $file" cmp -s "$method-off/$file" "$method-on/$file"
        done
    done
    says "observables are interpreted: the multipliers lambda1.. of gni are not observed"
    try 0 generate knife-edge-reaction --integrator gauss8 --space physical --reactions on \
        --prefix edge
    mv out edge.c
    expect "no observable h1" grep -q '"h1", "R_x", "R_y", "R_phi"' edge.c
    expect "no compilation" cc -Wall -Werror -c edge.c -o edge.o
    try 2 generate knife-edge-reaction --integrator gni --reactions on
    says "the multipliers lambda1.. of gni are not observed in generated code"
    counted
fi

case_is "reactions: refused with the reason"
table <<'END'
2 | run damped-oscillator --reactions on | says the reactions of damped-oscillator cannot be observed: the system has no constraints
2 | run damped-oscillator --columns h1 | says the run has no column 'h1'
2 | run chaplygin-sleigh --columns lambda1 | says gauss4.project has no multipliers of its own, which are lambda1..
2 | run contact-oscillator --extend-energy on --reactions on | says F continued off D = 0 is not made of them
END

case_is "reactions: in formulas"
cat >edge.yaml <<'END2'
coordinates: [x, y, phi]
lagrangian: (x'^2 + y'^2 + phi'^2)/2 + x/2
constraints: [x'*sin(phi) - y'*cos(phi)]
start: {x': 0.3, phi': 1}
invariants: {grip: h1, slack: sqrt(R_x^2 + R_y^2) - abs(h1)}
END2
try 0 run edge.yaml $motion --columns grip,h1,slack
expect "grip is h1" awk -F, 'NR > 1 && $2 != $4 { exit 1 }' out
try 0 section edge.yaml --integrator gauss8 --step 0.1 --time 20 --on 'h1 + 1/2'
sed 's/x\/2/x\/2 + h1/' edge.yaml >bad.yaml
try 2 run bad.yaml $motion
says "bad.yaml:2:46: lagrangian: the reaction .h1. may stand in invariants and events only"
sed 's/h1,/h2,/' edge.yaml >bad.yaml
try 2 run bad.yaml $motion
says "unknown name 'h2'"

case_is "reactions: in a study and its expectations"
cat >edges.yaml <<'END2'
integrators: [gauss8]
step: 0.1
time: 20
starts: physical
systems: [{system: chaplygin-sleigh, options: {reactions: on}}]
expect:
  chaplygin-sleigh:
    gauss8: {h1: {max: {at least: 0.999, at most: 1.001}}, D1: rounding}
END2
try 0 study edges.yaml --output edges
sed -i 's/at least: 0.999/at least: 1.0005/' edges.yaml
try 1 study edges.yaml --output unmet
sed -i 's/reactions: on/reactions: off/' edges.yaml
try 2 study edges.yaml --output none
says "has no quantity 'h1' in this study"

# The blade of edge.yaml turns with t, and so do its velocity and h: |R| = |h1| on any rows.
case_is "reactions: a formula of them in expectations"
cat >grips.yaml <<'END2'
integrators: [gauss8]
step: 0.1
time: 20
starts: physical
systems: [edge.yaml]
expect: {edge.yaml: {gauss8: {slack: {max: {at most: 1.0e-15}}, grip: {max: {at least: 0.3}}}}}
END2
try 0 study grips.yaml --no-page --output grips
sed -i 's/grip: {max: {at least: 0.3/grip: {max: {at most: 0.1/' grips.yaml
try 1 study grips.yaml --no-page --output slips
prints "grip: expected max <= 0.1, found"

# The lateral force on a sleigh that runs at v and turns at omega is m v omega.
case_is "reactions: observed formulas"
sleigh="--integrator rk4 --step 0.1 --time 20 --samples 40 --set m=2 --set v0=3"
try 0 run chaplygin-sleigh $sleigh --output plain.csv
try 0 run chaplygin-sleigh $sleigh --set omega=1 --output both.csv \
    --observe "abs(h1) - 0.3*m; max(h1, -m*v0*omega/2) + 0*y1'"
expect "names" grep -q '^t,y1.*,spin,abs(h1) - 0.3\*m,"max(h1, -m\*v0\*omega/2) + 0\*y1.",error$' both.csv
expect "the trajectory changes" [ "$(cut -d, -f1-20 plain.csv)" = "$(cut -d, -f1-20 both.csv)" ]
try 0 run chaplygin-sleigh $sleigh --integrator gauss8 --columns observed --names plain \
    --observe "abs(h1) - 0.3*m;h1+0*y1'"
expect "names" [ "$(header out)" = "t,abs(h1) - 0.3*m,h1+0*y1'" ]
expect "force" awk -F, 'NR > 1 && ($2 - 5.4)^2 + ($3 + 6)^2 > 1e-24 { exit 1 }' out
table <<'END'
2 | run chaplygin-sleigh --observe "abs(h1) - 0.3*k" | says --observe:1:15: unknown name 'k'
2 | run chaplygin-sleigh --observe "h1^2; y1'" | says --observe:1:7: .y1'. is a name; as a formula to observe it is written .y1'.
END
try 2 run chaplygin-sleigh --observe "h1^2; "
says "--observe:1:7: a formula to observe is missing$"
table <<'END'
2 | run chaplygin-sleigh --observe 'h1^2; "h1"' | says --observe:1:7: a formula to observe is one line, without quotes
2 | run chaplygin-sleigh --observe "h1^2; h1^2" | says --observe:1:7: duplicate 'h1.2'
2 | run chaplygin-sleigh-vakonomic --observe "h1^2" | says --observe:1:1: vakonomic motion has no reaction 'h1'
END
printf 'coordinates: [x]\nparameters: {min: 2}\nlagrangian: "x'"'"'^2/2 - min*x"\n' >warned.yaml
try 0 run warned.yaml --integrator rk4 --step 0.1 --time 1 --observe "min*x^2" --output warned.csv
expect "warnings" [ "$(grep -c 'warned.yaml:2:14: warning: .*min' err)" = 1 ]
sed 's/min\*x/min*y/' warned.yaml >wrong.yaml
try 2 run wrong.yaml --observe "x^2"
says "wrong.yaml:3:[0-9]*: .*'y'"

# A ball reaches the ground at t = sqrt(2) with the speed sqrt(2).  The step goes on from there, and the
# last whole one before t = 2 ends 1/2 later, where a conserved quantity would lack what the impact adds.
case_is "reactions: observed formulas with events"
cat >drop.yaml <<'END2'
coordinates: [y]
lagrangian: y'^2/2 - y
start: {y: 1}
invariants: {momentum: y'}
events: [{when: y, direction: down, restitution: 1}]
END2
try 0 run drop.yaml --integrator gauss4 --step 0.1 --time 2 --samples 4 --output drop \
    --observe "y'+0"
expect "the jump of a formula" awk -F, '$1 == "y'"'"'+0" && ($3 - sqrt(2) + 1/2)^2 < 1e-20 { f = 1 }
    END { exit !f }' drop/summary.csv

case_is "reactions: a formula under expect"
cat >force.yaml <<'END2'
integrators: [gauss8, rk4]
step: 0.1
time: 20
starts: physical
systems:
  - {system: chaplygin-sleigh, label: sleigh, set: {m: 2, v0: 3, omega: [0.05, 0.5]}}
  - knife-edge-reaction
expect:
  sleigh_omega=0.05: {all: {"abs(h1) - 0.3*m": {final: {at least: -0.30001, at most: 0}}}}
  sleigh_omega=0.5:
    gauss8:
      "abs(h1) - 0.3*m": {max: {at least: 2.399999, at most: 2.400001}, final: {at least: 0}}
      9*abs(h1): {max: {at least: 26.99, at most: 27.01}}
      speed: rounding
END2
try 0 study force.yaml --no-page --output force
prints "Expectations: 6 of 6 are met"
sed '/expect/,$d' force.yaml >bare.yaml
try 0 study bare.yaml --no-page --output bare
for study in bare force; do sed '/^Expect/d; /^$/d' $study/tables.txt >$study.txt; done
expect "other tables" cmp -s bare.txt force.txt
expect "another system observes it" [ -z "$(grep '^knife.*abs' force/quantities.csv)" ]
for file in force/runs/*; do
    expect "other bits: $file" [ "$(tail -c +1 "bare/runs/${file##*/}/summary.csv" | grep -v abs)" = \
        "$(grep -v abs "$file/summary.csv")" ]
done
for shard in 1 2; do try 0 study force.yaml --no-page --shard $shard/2 --output force-$shard; done
try 0 merge force-1 force-2 --no-page --output force-merged
expect "merged: other expectations" cmp -s force/expectations.csv force-merged/expectations.csv
sed 's/^step/rows: none\nstep/' force.yaml >short.yaml
try 0 study short.yaml --no-page --output short
expect "rows: none: other expectations" cmp -s force/expectations.csv short/expectations.csv
try 0 resume short --no-page
expect "resumed: other expectations" cmp -s force/expectations.csv short/expectations.csv
sed 's/at most: 0}/at most: -0.4}/' force.yaml >unmet.yaml
try 1 study unmet.yaml --no-page --output unmet-force
expect "met" grep -q "^sleigh_omega=0.05,rk4,.*<= -0.4.,.-0.3.,no$" unmet-force/expectations.csv
sed 's/abs(h1) - 0.3\*m": {final/abs(h2) - 0.3*m": {final/' force.yaml >bad.yaml
try 2 study bad.yaml
says "bad.yaml:9:34: unknown name 'h2'"
sed 's/chaplygin-sleigh,/chaplygin-sleigh-vakonomic,/; s/, omega: .*]}/}/; s/_omega=0.05//; /0.5:/,$d' \
    force.yaml >bad.yaml
try 2 study bad.yaml
says "bad.yaml:9:[0-9]*: vakonomic motion has no reaction 'h1'"

case_is "reactions: resumed"
needs 13 "no compiler for signals at given places" raises || return 0
long="knife-edge-reaction --integrator gni --step 0.001 --time 20 --samples 20011 --native off
      --columns x,h,R,lambda"
try 0 run $long --output whole.npy
cut_off 137 9 6 run $long --checkpoint 0 --output killed
try 0 resume killed
says "'killed' resumes at t = [0-9.]*[1-9][0-9.]* with row [1-9]"
expect "other bytes" cmp -s whole.npy killed/trajectory.npy
long="chaplygin-sleigh --integrator gni --step 0.001 --time 20 --samples 20011 --native off"
try 0 run $long --observe "abs(h1) - 0.3*m" --output observed
cut_off 137 9 6 run $long --observe "abs(h1) - 0.3*m" --checkpoint 0 --output cut
try 0 resume cut
for file in trajectory.npy summary.csv; do
    expect "observed, other $file" cmp -s observed/$file cut/$file
done
cut_off 137 9 4 study force.yaml --no-page --threads 1 --checkpoint 0 --output force-killed
try 0 resume force-killed --no-page
expect "killed: other expectations" cmp -s force/expectations.csv force-killed/expectations.csv
counted
