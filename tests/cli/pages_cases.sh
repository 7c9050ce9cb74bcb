# `dalembert report`: whole pages of each kind.  Every table and every curve has the values of the files that it is
# made from (page_values.py), the command on a page of a run makes the same run again, and elements, texts and gnuplot
# scripts are as in data/pages/NAME.txt, where each number is #.  Where a page is changed on purpose that file changes
# with it: page_outline.py PAGE skeleton >tests/cli/data/pages/NAME.txt.

# page NAME [scripts]: the directory NAME and its page, of which `scripts` compares the scripts alone.
page() {
    try 0 report "$1"
    silent
    python3 "$here/page_values.py" "$@" >compared 2>&1
    expect "$1: $(head -3 compared)" sh -c "grep -Eq '^[1-9][0-9]+ values$' compared && test \$(wc -l <compared) -eq 1"
    python3 "$here/page_outline.py" "$1/report/index.html" >/dev/null 2>outline
    status=$?
    expect "$1: $(cat outline)" test $status -eq 0
    python3 "$here/page_outline.py" "$1/report/index.html" skeleton >skeleton
    diff "$here/data/pages/$1.txt" skeleton >differences 2>&1
    expect "$1: $(head -4 differences)" test ! -s differences
}
# again NAME: what the page of a run says makes it again does so.
again() {
    sed -n 's/^<pre tabindex="0">dalembert \(run .*\) --output DIR<\/pre>$/\1/p' "$1/report/index.html" |
        sed "s/&lt;/</g; s/&gt;/>/g; s/&quot;/\"/g; s/&amp;/\&/g" >command
    eval "try 0 $(cat command) --output again --force"
    expect "$1: another run by $(cat command)" cmp "$1/trajectory.npy" again/trajectory.npy
}
# full NAME: where a file of the page cannot be written since the device is full, the command fails and says which.
# Every fourth file is tried.
full() {
    fault=
    for file in $(ls -d "$1"/report/* | awk 'NR % 4 == 1 || /html/'); do
        mv "$file" file && ln -s /dev/full "$file"
        timeout --foreground $patience "$program" report "$1" >out 2>err
        status=$?
        [ $status -eq 4 ] && grep -q '^dalembert: cannot write .*No space left' err || fault="$fault $file:$status"
        rm "$file" && mv file "$file"
    done
    expect "$1: no failure at$fault" test -z "$fault"
}
# unreadable NAME: wherever a file that the page is made from cannot be read, the command fails and says so; what it
# does not read changes no byte of the page.  Of the files of a study's runs every thirtieth is tried.
unreadable() {
    fault=
    cp "$1/report/index.html" page
    find "$1" -path "$1/report" -prune -o -type f -print | sort |
        awk '!/[/]runs[/]/ || ++runs % 30 == 1' >files
    while read -r file; do
        mv "$file" file && mkdir "$file"
        timeout --foreground $patience "$program" report "$1" >out 2>err
        status=$?
        rmdir "$file" && mv file "$file"
        if [ $status -eq 0 ]; then
            cmp -s page "$1/report/index.html" && [ ! -s err ] && continue
        else
            { [ $status -eq 2 ] || [ $status -eq 4 ]; } && grep -q '^dalembert: ' err && continue
        fi
        fault="$fault $file:$status"
    done <files
    expect "$1: no failure at$fault" test -z "$fault"
}
# renamed FILE: with another name for any member of a JSON file the command fails with a message, or is silent.
renamed() {
    fault=
    cp "$1" file
    for k in $(awk '/^ *"[a-z_]*":/ { print NR }' file); do
        sed "$k"'s/"\([a-z_]*\)":/"other-\1":/' file >"$1"
        timeout --foreground $patience "$program" report "${1%/*}" >out 2>err
        case $? in
        0) [ ! -s err ] ;;
        2 | 4) grep -q '^dalembert: ' err ;;
        *) false ;;
        esac || fault="$fault $k:$(head -1 err)"
    done
    cp file "$1"
    expect "$1: lines$fault" test -z "$fault"
}

cat >many.yaml <<'END_OF_SYSTEM'
title: A <weight> on a spring & a turn
reference: a book
coordinates: [x, phi, s]
parameters: {k: 1, m: 2}
functions: {square(u): u^2}
let: {pull: k*cos(phi)}
lagrangian: m/2*(x'^2 + s'^2) + phi'^2/2 - k*square(x)/2
constraints: [s' - sin(phi)*x']
reactions:
  - {s: 1}
controls:
  - {x: 1}
gauge: {e: 2}
forces: {x: -pull*x'}
invariants: {c: phi'}
start: {x: k, x': 1, phi: 0.5, solve: [s']}
END_OF_SYSTEM
ball falls.yaml "when: x - 0.3, set: {x': 2*u}" 'when: x - 0.7' 'when: x - 1.25, stop: true'
study_of_states methods.yaml "\"a <b> \\\"c\\\" 'd'\"" ''
cat >sleigh.yaml <<'END_OF_SYSTEM'
coordinates: [x, y, phi]
lagrangian: (x'^2 + y'^2 + phi'^2)/2
constraints: [x'*sin(phi) - y'*cos(phi)]
END_OF_SYSTEM
cat >families.yaml <<'END_OF_STUDY'
integrators: [symplectic-euler-10, stormer-verlet, dop853, rk4, gauss6, gauss4, spark2, dla, gni,
              discrete-gradient, gauss4+project, gauss4+yoshida6]
step: 0.1
time: 2
starts: physical
systems: [nonholonomic-particle]
END_OF_STUDY

if needs 132 "no python3" there python3; then
    case_is "pages of runs"
    try 0 run chaplygin-sleigh --integrator gauss4 --step 0.1 --time 6 --samples 40 --output sleigh
    page sleigh
    again sleigh
    try 0 run many.yaml --integrator rk4+project --step 0.1 --time 2 --set k=0.5 --start "phi'=3" --start x=0.1234567890123 \
        --observe "x^2 + 3; 2 - hypot(x, x')" --solver-tolerance 1e-9 --columns x,phi,s,R_s,D1,E,c --output many
    page many
    again many
    try 0 run falls.yaml --integrator gauss4 --step 0.01 --time 3 --samples 60 --output falls
    page falls
    try 0 run damped-oscillator --integrator gauss4 --step -0.1 --time -4 --from 2 --samples 30 --output backwards
    page backwards
    again backwards
    try 3 run pursuit --integrator rk4 --step 0.01 --time 10 --samples 40 --output failed
    page failed
    try 3 run pursuit --integrator rk4 --step 0.01 --time 1000 --output alone
    page alone

    case_is "pages of studies"
    "$program" study methods.yaml --no-page --output methods >out 2>err
    page methods
    try 0 study families.yaml --no-page --output families
    page families scripts
    sed 's/^time: 2/time: 2\nrows: none\npredict: on/; s/^step: .*/step: [0.5, 0.25]/; s/^tolerance.*//; /expect/,$d' methods.yaml >predicted.yaml
    "$program" study predicted.yaml --no-page --output predicted >out 2>err
    page predicted

    case_is "pages of other commands"
    try 0 order line.yaml --integrators rk4,gauss4,isokinetic-splitting --levels 3 --time 1 --output orders
    page orders
    try 0 order line.yaml --integrators rk4,mclachlan4,bm4,stormer-verlet,symplectic-euler-10,gauss4,gauss6,implicit-midpoint,lobatto4,dla \
        --levels 2 --time 1 --output many-orders
    page many-orders
    try 0 section chaplygin-sleigh-full-turn --on phi=1 --integrator rk4 --step 0.05 --time 20 --output section
    page section
    try 0 lyapunov isokinetic --integrator rk4 --step 0.1 --time 4 --output exponents
    page exponents
    try 0 volume isokinetic --integrator rk4 --step 0.1 --time 4 --output volume
    page volume
    try 0 ensemble knife-edge --members 20 --seed 1 --vary "x'=normal(0,0.1)" --vary "phi=uniform(0,1)" --integrator rk4 \
        --step 0.1 --times 0.5,1,2 --output ensemble
    page ensemble

    { cat sleigh.yaml && echo "invariants: {spin: phi'}"; } >spins.yaml
    try 0 steer spins.yaml --to x=0.5,y=0.2,phi=0.3 --rest --effort constraint --integrator gauss8 --step 0.1 --time 2 \
        --output steered --json
    page steered
    # Inputs along the constraint move E and p, and neither D nor H.
    titles() { grep -o "title '[A-Za-z0-9]* " steered/report/drift.gp | tr -d '\n'; }
    expect "drifts: $(titles)" test "$(titles)" = "title 'D1 title 'H "

    case_is "pages without what they are made from, and on a full device"
    for name in sleigh falls failed methods predicted families orders section exponents volume ensemble steered; do
        unreadable $name
        full $name
    done
    for file in many/manifest.json falls/manifest.json ensemble/manifest.json orders/order.json section/section.json \
        exponents/lyapunov.json steered/steer.json; do
        renamed $file
    done
    counted
fi
