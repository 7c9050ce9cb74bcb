# Files of others: whatever their texts are, no command runs, no page has markup of theirs, and C compiles;
# and a damaged directory is an error, not a crash.

case_is "a label cannot name a file"
for label in 'a\\nb' 'a\\tb' '\\x7f' '\\x9b31m' ' \\0' ''; do
    bad "integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [{system: line.yaml, label: \"$label\"}]\n" \
        "^dalembert: bad.yaml:4:38: label: ('.*' cannot name a file|.*the control character U\+00..|a NUL in the text)"
done
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: ["line\\n.yaml"]\n' "^dalembert: bad.yaml:4:11: system: '.*' has control characters$"
cp line.yaml .line.yaml
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [./.line.yaml]\n' "'./.line.yaml' cannot name a file: give it a label$"
bad 'title: "\\e[31m"\nintegrators: rk4\nstep: 0.1\ntime: 1\nsystems: [line.yaml]\n' \
    '^dalembert: bad.yaml:1:8: title: the control character U\+001B in the text$'

case_is "a page of cells whose texts name other files"
printf 'integrators: rk4\nstep: 0.5\ntime: 2\nstarts: physical\nsystems: [line.yaml]\n' >one.yaml
try 0 study one.yaml --no-page --output one
for change in 's#^line.yaml,#../../secret,#' 's#^line.yaml,#.secret,#' 's#^line.yaml,#,#'; do
    rm -rf other && cp -r one other
    sed -i "2$change" other/cells.csv
    try 2 report other
    says "^dalembert: other/cells.csv:2: the label '.*' cannot name a file$"
done
for run in ../secret runs/../../secret runs/.secret /secret secret; do
    rm -rf other && cp -r one other
    sed -i "2s#,runs/[^,]*#,$run#" other/cells.csv
    try 2 report other
    says "^dalembert: other/cells.csv:2: the run '$run' is no directory of the study$"
done

case_is "orders where every method is refused"
try 0 order line.yaml --integrators rk4 --levels 2 --time 1 --output refused
sed -i '2,$s/^\([^,]*,[^,]*\),.*/\1,,,,,,,,,refused,it is refused/' refused/order.csv
try 0 report refused
silent
expect "no words" grep -q '<p>No method has errors to show.</p>' refused/report/index.html
expect "no reason" grep -q '<li>rk4: it is refused</li>' refused/report/index.html
try 0 order chaplygin-sleigh --integrators isokinetic-splitting --step 0.1 --time 1 --output none
expect "no page" grep -q '<p>No method has errors to show.</p>' none/report/index.html

case_is "a table that is not whole"
# damaged FILE MESSAGE: the page of the copy of the study, where FILE has replaced its cells, is refused.
damaged() {
    cp "$1" other/cells.csv
    try 2 report other
    says "^dalembert: (other/cells.csv|'other/cells.csv')$2"
}
head -c 300 one/cells.csv >cut && damaged cut ' has no rows$'
size=$(wc -c <one/cells.csv)
head -c $((size - 1)) one/cells.csv >cut && damaged cut ':2: the file ends within a row$'
sed '2s/[^,]*,//' one/cells.csv >cut && damaged cut ':2: [0-9]+ columns, but the file has [0-9]+ heads$'
sed '2s/$/,/' one/cells.csv >cut && damaged cut ':2: [0-9]+ columns, but the file has [0-9]+ heads$'
sed '1s/,system,/,,/' one/cells.csv >cut && damaged cut ':1: column 2 has no head$'
sed '1s/system/"sys\x1btem"/' one/cells.csv >cut && damaged cut ":1: column 2 \('sys.tem'\) has the control character U\+001B$"
sed '2s/rk4/rk4\r/' one/cells.csv >cut && damaged cut ":2: column 3 \('integrator'\) has the control character U\+000D$"
tr '4' '\0' <one/cells.csv >cut && damaged cut ': byte [0-9]+ is a NUL$'
: >cut && damaged cut ' has no rows$'

case_is "a study of two documents"
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [line.yaml]\n---\ntime: 2\n' '^dalembert: bad.yaml:6:1: a second document$'
bad 'integrators: rk4\nstep: 0.1\ntime: 1\nsystems: [line.yaml]\n---\ntime: *b\n' '^dalembert: bad.yaml:6:7: found undefined alias$'

case_is "a library of charts that would end its element"
try 0 run line.yaml --integrator rk4 --step 0.1 --time 1 --samples 3 --output charted
for file in uPlot.iife.min.js uPlot.min.css LICENSE; do
    rm -rf library && cp -r "$DALEMBERT_UPLOT" library
    echo '</script>' >>library/$file
    DALEMBERT_UPLOT=$PWD/library try 2 report charted
    says "^dalembert: '$PWD/library/$file' is not a part of uPlot"
done

case_is "a run without rows"
sed -i "s/'shape': ([0-9],)/'shape': (0,)/" charted/trajectory.npy
try 2 report charted
says "^dalembert: 'charted/trajectory.npy' has no rows$"

# Whatever file of a directory is empty, has only its first line or is a directory, the page says so.
case_is "files that are not whole"
try 0 run line.yaml --integrator rk4 --step 0.5 --time 2 --output of-run
try 0 order line.yaml --integrators rk4 --levels 2 --time 1 --output of-order
try 0 section plane.yaml --on y=1 --integrator rk4 --step 0.1 --time 7 --output of-section
try 0 ensemble line.yaml --members 4 --seed 1 --vary 'x=normal(1,0.1)' --integrator rk4 --step 0.5 --time 2 --output of-ensemble
sed '/starts/d; s/line/plane/' one.yaml >all.yaml
try 0 study all.yaml --no-page --output of-study
# not_whole STATUS DIR/FILE MESSAGE: after "empty", "heads" or "folder" in $change.
not_whole() {
    rm -rf other && cp -r "${2%%/*}" other
    damaged=other/${2#*/}
    case $change in
    empty) : >"$damaged" ;;
    heads) sed -n 1p "$2" >"$damaged" ;;
    folder) rm "$damaged" && mkdir "$damaged" ;;
    esac
    try $1 report other
    says "^dalembert: $3$"
}
tables="of-run/summary.csv of-order/order.csv of-section/section.csv of-ensemble/statistics.csv of-ensemble/histograms.csv
    of-ensemble/cloud.csv of-study/cells.csv of-study/quantities.csv of-study/series/plane.yaml.csv"
for file in $tables; do
    change=empty && not_whole 2 $file "'other/${file#*/}' has no rows"
    change=folder && not_whole 4 $file "cannot read 'other/${file#*/}': Is a directory"
done
for file in of-order/order.csv of-study/cells.csv; do
    change=heads && not_whole 2 $file "'other/${file#*/}' has no rows"
done
change=heads && not_whole 2 of-ensemble/statistics.csv "'other' has no statistics of an ensemble"
for file in of-run/manifest.json of-order/order.json of-section/section.json of-ensemble/manifest.json; do
    change=empty && not_whole 2 $file "other/${file#*/}:1:1: no JSON: a value is expected"
    change=heads && not_whole 2 $file "other/${file#*/}:2:1: no JSON: a name in quotes is expected"
done
change=empty && not_whole 2 of-run/trajectory.npy "'other/trajectory.npy' is no .npy file of named doubles"
change=heads && not_whole 4 of-run/trajectory.npy "'other/trajectory.npy' has fewer rows than its header states"
change=folder && not_whole 4 of-run/trajectory.npy "cannot read 'other/trajectory.npy': Is a directory"
change=empty && not_whole 2 of-study/study.yaml "other/study.yaml: it is empty"
change=folder && not_whole 4 of-study/study.yaml "cannot read 'other/study.yaml': Is a directory"
sed 's/"start": {[^}]*}/"start": [1]/' of-section/section.json >listed
rm -rf other && cp -r of-section other && mv listed other/section.json
try 2 report other
says '^dalembert: other/section.json:[0-9]+:[0-9]+: settings: names and values are required$'

case_is "a label that is not of the study"
rm -rf other && cp -r one other
sed -i '2,$s/^line.yaml,/renamed,/' other/cells.csv
try 0 report other
expect "no label" grep -q '>renamed<' other/report/index.html
echo 'coordinates: [' >other/systems/renamed.yaml
try 2 report other
says '^dalembert: other/systems/renamed.yaml:2:1: '
expect "it goes on" test "$(wc -l <err)" -eq 1
empty

# Both runs have a motion on the page, and too few rows for it: their last steps have more.
case_is "runs of a study that are not whole"
printf "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\nexact: {x: cos(t)}\n" >swing.yaml
printf '%s\n' 'integrators: [rk4, gauss4]' 'step: 0.1' 'time: 20' 'samples: 2' 'starts: physical' \
    'systems: [swing.yaml]' >pair.yaml
try 0 study pair.yaml --no-page --output of-pair
for run in swing.yaml_rk4_physical_0.1 swing.yaml_gauss4_physical_0.1; do
    change=folder && not_whole 4 of-pair/runs/$run/checkpoint "cannot read 'other/runs/$run/checkpoint': Is a directory"
    rm -r "$damaged" "other/runs/$run/trajectory.npy" && cp of-pair/runs/$run/checkpoint "$damaged"
    try 2 report other
    says "^dalembert: 'other/runs/$run' holds no run: there is no trajectory.npy$"
    empty
done

# A fault of a picture is a fault of the command.
case_is "a picture that fails"
mkdir -p fails draws stops dies
printf '#!/bin/sh\nexit 1\n' >fails/gnuplot
printf '#!/bin/sh\nexit 0\n' >draws/gnuplot
# These leave a picture, which need not be whole.
printf '#!/bin/sh\necho "<svg></svg>" >"${1%%.gp}.svg"\nexit 3\n' >stops/gnuplot
printf '#!/bin/sh\necho "<svg></svg>" >"${1%%.gp}.svg"\nkill -9 $$\n' >dies/gnuplot
chmod +x fails/gnuplot draws/gnuplot stops/gnuplot dies/gnuplot
motion="line.yaml --integrator rk4 --step 0.1 --time 2"
for way in fails draws stops dies; do
    failure="failed on"
    [ $way = draws ] && failure="drew nothing from"
    rm -rf run-$way
    try 0 run $motion --output run-$way
    for command in "report run-$way" "report one"; do
        for charts in "$DALEMBERT_UPLOT" /nonexistent; do
            DALEMBERT_UPLOT=$charts PATH=$PWD/$way:$PATH try 4 $command --svg
            says "^dalembert: gnuplot $failure '.*\.gp'$"
        done
    done
done

# Each figure of each kind of page, alone.
mkdir -p chosen
cat >chosen/gnuplot <<'END'
#!/bin/sh
echo "$1" >>"$DRAWN"
[ "$1" = "$FAILS" ] && exit 1
echo "<svg></svg>" >"${1%.gp}.svg"
END
chmod +x chosen/gnuplot
export DRAWN=$PWD/drawn
try 0 order line.yaml --levels 2 --time 1 --output families
try 0 lyapunov chaplygin-sleigh --integrator rk4 --step 0.1 --time 5 --output of-lyapunov
try 0 volume chaplygin-sleigh --integrator rk4 --step 0.1 --time 5 --output of-volume
for made in of-run of-order families of-section of-ensemble of-study of-lyapunov of-volume; do
    : >drawn
    PATH=$PWD/chosen:$PATH FAILS= try 0 report $made --svg
    expect "$made has figures" test -s drawn
    for figure in $(cat drawn); do
        PATH=$PWD/chosen:$PATH FAILS=$figure try 4 report $made --svg
        says "^dalembert: gnuplot failed on '(.*/)?${figure#./}'$"
        expect "the next ones are drawn" test "$(grep -c 'gnuplot failed' err)" -eq 1
    done
done

# hostile PART...: a part of hostile.py, in a directory of its own.
hostile() {
    rm -rf hostile && mkdir hostile
    (cd hostile && CC=${CC:-cc} timeout --foreground $patience python3 "$here/hostile.py" "$program" "$@") >err 2>&1
    expect "$1" test $? -eq 0
}
case_is "hostile texts"
# Without these hostile.py leaves some of its work out.
there "${CC:-cc}" || skips 1 "C: no compiler"
there gnuplot || skips 1 "pictures: no gnuplot"
if needs 4 "no python3" there python3; then
    case_is "hostile texts in a system"
    hostile systems
    case_is "hostile texts in a study"
    hostile studies
    case_is "hostile texts in what pages are made of"
    hostile directories
    case_is "damaged directories"
    hostile damage 1 12
    counted
fi
