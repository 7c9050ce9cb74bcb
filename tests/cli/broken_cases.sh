# Directories of runs that are read while nothing can be written, and rows that are cut short.

# limited BLOCKS STATUS ARGUMENT...: no file may grow beyond BLOCKS blocks of 512 bytes, as on a full
# disk.
limited() {
    blocks=$1 expected=$2
    shift 2
    (trap '' XFSZ; ulimit -f "$blocks"; exec timeout --foreground $patience "$program" "$@") >out 2>err
    ended $? "$@"
}
try 0 run ./line.yaml --integrator rk4 --step 0.001 --time 100 --samples 20000 --output whole
size=$(wc -c <whole/trajectory.npy)
columns=$(columns_of whole/trajectory.npy)

case_is "report while the disk is full"
for blocks in 1 8 64; do
    rm -rf full
    cp -r whole full
    limited $blocks 4 report full
    says "^dalembert: cannot write 'full/report/[a-zA-Z.]*': File too large"
    empty
    expect "the rows changed" cmp full/trajectory.npy whole/trajectory.npy
done
try 0 report full
expect "no page" grep -q '</html>' full/report/index.html

case_is "resume while the disk is full"
rm -rf full
# room for some thousand rows, with checkpoints among them
limited 1024 4 run ./line.yaml --integrator rk4 --step 0.001 --time 100 --samples 20000 --checkpoint 0 \
    --native off --output full
expect "no checkpoint" test -s full/checkpoint
limited 16 4 resume full
says "^dalembert: cannot (write|resize) 'full/[a-z.]*': File too large"
limited 16 4 resume full
try 0 resume full
expect "not the rows of a run never interrupted" cmp full/trajectory.npy whole/trajectory.npy
expect "not the summary of a run never interrupted" cmp full/summary.csv whole/summary.csv

case_is "rows that are cut short"
# in a row, before the first one, in the header, and nothing left
for length in $((size - 1)) $((size - 20000 * columns * 8)) 100 0; do
    rm -rf short
    cp -r whole short
    truncate -s $length short/trajectory.npy
    "$program" report short >out 2>err
    status=$?
    expect "exit $status, neither 4 nor 2: $length bytes" test $status -eq 4 -o $status -eq 2
    says "^dalembert: '?short/trajectory.npy'?"
    empty
    cp short/trajectory.npy before.npy
    "$program" resume short >out 2>err
    status=$?
    expect "exit $status, not 2: $length bytes" test $status -eq 2
    says "^dalembert: '?short/trajectory.npy'?"
    expect "resume changed it" cmp short/trajectory.npy before.npy
done

case_is "a study on a full disk"
printf 'integrators: rk4\nstep: 0.001\ntime: 100\nsamples: 20000\nstarts: physical
systems: [line.yaml]\n' >cut.yaml
rm -rf cut plain
try 0 study cut.yaml --output plain
limited 64 4 study cut.yaml --output cut
says "^dalembert: cannot write 'cut/runs/[^']*trajectory.npy': File too large"
limited 64 4 resume cut
try 0 resume cut
for file in cells.csv quantities.csv; do
    # all but what is of the clock
    for each in plain cut; do cut -d, -f1-8 $each/$file >$each.csv; done
    expect "another $file" cmp cut.csv plain.csv
done

case_is "an ensemble that is resumed or merged on a full disk"
many="ensemble line.yaml --integrator rk4 --step 0.5 --time 1 --members 1000 --seed 1 --threads 1 --no-page
    --vary k=uniform(1,2) --native off"
# 48 bytes a member in final.npy, or 16 where there is no lift, 24 in members.npy.
try 0 $many --space physical --output members
rm -rf some && cp -r members some && rm some/chunks some/*.csv
limited 40 4 resume some --threads 1 --no-page
alone "^dalembert: cannot write 'some/members.npy': File too large$"
try 0 resume some --no-page
for file in members.npy final.npy statistics.csv; do expect "another $file" cmp members/$file some/$file; done
for k in 1 2; do try 0 $many --shard $k/2 --output part-$k; done
limited 60 4 merge part-1 part-2 --output part-2 --threads 1 --no-page
alone "^dalembert: cannot write 'part-2/final.npy': File too large$"

case_is "a first line that is longer than what is written at once"
awk 'BEGIN { for (i = 1; i <= 50; i++) { names = names ", a_long_name_of_a_coordinate_" i }
    print "coordinates: [" substr(names, 3) "]"; print "lagrangian: a_long_name_of_a_coordinate_1\047^2/2 + 0"
    for (i = 2; i <= 50; i++) print "    + a_long_name_of_a_coordinate_" i "\047^2/2" }' >many.yaml
limited 4 4 run many.yaml --integrator rk4 --step 0.5 --time 1 --output many.csv
says "^dalembert: cannot write 'many.csv': File too large$"
expect "it goes on" test "$(wc -l <err)" -eq 1

case_is "a search on a full disk"
printf "coordinates: [x]\nlagrangian: x'^2/2\ncontrols: [{x: 1}]\n" >cart.yaml
# A checkpoint has some 50 kB, the inputs of 4000 steps more than 100.
limited 160 4 steer cart.yaml --to x=1 --rest --effort controls --integrator gauss4 --step 0.00025 --time 1 \
    --samples 1 --output cart
says "^dalembert: cannot write 'cart/inputs.csv': File too large$"
expect "it goes on" test "$(grep -c 'cannot write' err)" -eq 1
# x'' = 4x^3 is infinite before t = 1.
printf "coordinates: [x]\nlagrangian: x'^2/2 + x^4\nstart: {x: 1}\n" >falls.yaml
limited 8 4 steer falls.yaml --to x=2 --rest --time 30 --step 0.1 --integrator gauss8 --output nowhere
says "^dalembert: cannot write 'nowhere/best.csv': File too large$"
expect "it goes on" test "$(grep -c 'cannot write' err)" -eq 1
refute "results of a search that is not whole" test -e nowhere/steer.json

# Each column that a page needs of a table.
case_is "tables of an older version"
printf 'coordinates: [x]\nlagrangian: (x'"'"'^2 - x^2)/2\nstart: {x'"'"': 1}\n' >swing.yaml
printf '%s\n' 'integrators: rk4' 'step: 0.1' 'time: 1' 'starts: physical' 'systems: [line.yaml]' >few.yaml
try 0 run line.yaml --integrator rk4 --step 0.1 --time 1 --output a-run
try 0 section swing.yaml --on x --integrator rk4 --step 0.1 --time 10 --output a-section
try 0 study few.yaml --output a-study --no-page
try 0 ensemble line.yaml --integrator rk4 --step 0.5 --times 1 --members 20 --seed 1 --vary "k=uniform(1,2)" \
    --output an-ensemble --no-page
while read -r from table heads; do
    for head in $heads; do
        rm -rf older
        cp -r "$from" older
        awk -F, -v OFS=, -v head="$head" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == head) $i = "old" } 1' \
            "$from/$table" >"older/$table"
        try 2 report older
        says "^dalembert: older/$table: there is no column '$head': another version of dalembert wrote it$"
    done
done <<'EOF'
a-run summary.csv trend
a-section section.csv t direction
a-study cells.csv E_trend D_trend
an-ensemble statistics.csv t deviation
an-ensemble histograms.csv t count
an-ensemble cloud.csv t member
EOF

case_is "expectations that are no table"
cp -r a-study no-table
printf 'label,met\nline\n' >no-table/expectations.csv
try 2 report no-table
says '^dalembert: no-table/expectations.csv:2: 1 columns, but the file has 2 heads$'

if needs 34 "no python3" there python3; then
    case_is "checkpoints that no run has written, with their check sums"
    try 0 run line.yaml --integrator rk4 --step 0.001 --time 1 --samples 10 --output ten
    while read -r part word value reason; do
        rm -rf changed
        cp -r ten changed
        python3 "$here/change_checkpoint.py" changed/checkpoint $part $word $value
        label="the $part, word $word: $value"
        try 2 resume changed
        says "^dalembert: changed/checkpoint: the checkpoint is damaged: $reason$"
        expect "another message" [ "$(wc -l <err)" -eq 1 ]
    done <<'EOF'
header 7 -1.0 its time is wrong
header 2 -1 its size is wrong
header 8 1000000000 its size is wrong
header 9 2 its size is wrong
statistics 0 -1 its statistics cannot be
statistics 1 3 its statistics cannot be
statistics 3 1 its statistics cannot be
statistics 4 2 its statistics cannot be
record 0 -1.0 the record of its steps cannot be
record 0 1.5 the record of its steps cannot be
record 1 0.5 the record of its steps cannot be
EOF
    counted
fi
