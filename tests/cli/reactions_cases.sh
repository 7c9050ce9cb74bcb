# Reactions: columns h1.., R_x.., lambda1.., the option, formulas with them.

header() { head -1 "$1"; }
motion="--integrator gauss8 --step 0.1 --time 2 --samples 10 --space physical"

case_is "reactions: columns on request alone"
try 0 run chaplygin-sleigh $motion
holds "header" [ "$(header out)" = "t,y1,y2,phi,y1',y2',phi',D1,E,speed,spin,error" ]
mv out plain
try 0 run chaplygin-sleigh $motion --reactions on --output all.csv
holds "header" \
    [ "$(header all.csv)" = "t,y1,y2,phi,y1',y2',phi',D1,E,speed,spin,h1,R_y1,R_y2,R_phi,error" ]
holds "the trajectory changes" \
    [ "$(cut -d, -f1-11 plain)" = "$(cut -d, -f1-11 all.csv)" ]
for list in h,R h1,R_y1,R_y2,R_phi 'h*,R_*'; do
    try 0 run chaplygin-sleigh $motion --columns "$list"
    holds "$list" [ "$(cat out)" = "$(cut -d, -f1,12-15 all.csv)" ]
done
try 0 run chaplygin-sleigh $motion --integrator gni --columns lambda
holds "header" [ "$(header out)" = "t,lambda1" ]
holds "lambda of the start is not h" [ "$(sed -n 2p out)" = "0,-1" ]

case_is "reactions: native, in quad precision, generated"
if there cc; then
    for method in gauss8 gni; do
        for native in off on; do
            try 0 run knife-edge-reaction $motion --integrator $method --statistics 3 \
                --native $native --columns h,R --output "$method-$native"
        done
        for file in trajectory.npy summary.csv; do
            holds "$method: other $file" cmp -s "$method-off/$file" "$method-on/$file"
        done
    done
    says "observables are interpreted: the multipliers lambda1.. of gni are not observed"
    try 0 generate knife-edge-reaction --integrator gauss8 --space physical --reactions on \
        --prefix edge
    mv out edge.c
    holds "no observable h1" grep -q '"h1", "R_x", "R_y", "R_phi"' edge.c
    holds "no compilation" cc -Wall -Werror -c edge.c -o edge.o
    try 2 generate knife-edge-reaction --integrator gni --reactions on
    says "the multipliers lambda1.. of gni are not observed in generated code"
fi

case_is "reactions: refused with the reason"
try 2 run damped-oscillator --reactions on
says "the reactions of damped-oscillator cannot be observed: the system has no constraints"
try 2 run damped-oscillator --columns h1
says "the run has no column 'h1'"
try 2 run chaplygin-sleigh --columns lambda1
says "gauss4.project has no multipliers of its own, which are lambda1.."
try 2 run contact-oscillator --extend-energy on --reactions on
says "F continued off D = 0 is not made of them"

case_is "reactions: in formulas"
cat >edge.yaml <<'END2'
coordinates: [x, y, phi]
lagrangian: (x'^2 + y'^2 + phi'^2)/2 + x/2
constraints: [x'*sin(phi) - y'*cos(phi)]
start: {x': 0.3, phi': 1}
invariants: {grip: h1, slack: sqrt(R_x^2 + R_y^2) - abs(h1)}
END2
try 0 run edge.yaml $motion --columns grip,h1,slack
holds "grip is h1" awk -F, 'NR > 1 && $2 != $4 { exit 1 }' out
try 0 section edge.yaml --integrator gauss8 --step 0.1 --time 20 --on 'h1 + 1/2'
sed 's/x\/2/x\/2 + h1/' edge.yaml >bad.yaml
try 2 run bad.yaml $motion
says "bad.yaml:2:46: lagrangian: the reaction .h1. may stand in invariants only"
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

case_is "reactions: resumed"
raises || return 0
long="knife-edge-reaction --integrator gni --step 0.001 --time 20 --samples 20011 --native off
      --columns x,h,R,lambda"
try 0 run $long --output whole.npy
cut_off 137 9 6 run $long --checkpoint 0 --output killed
try 0 resume killed
says "'killed' resumes at t = [0-9.]*[1-9][0-9.]* with row [1-9]"
holds "other bytes" cmp -s whole.npy killed/trajectory.npy
