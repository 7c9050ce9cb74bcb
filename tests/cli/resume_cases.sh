# A run in a directory: described, interrupted, killed, resumed.

needs 220 "no compiler for signals at given places" raises || return 0
# more rows than steps: each checkpoint has rows that the one before it lacks
long="chaplygin-sleigh --integrator gauss8+project --step 0.001 --time 20 --samples 20011
      --set omega=1.5 --start pi_phi=1e-8"

case_is "a directory"
try 0 run $long --output whole
empty
expect "rows" has_rows whole/trajectory.npy 20012
expect "it names the system" grep -qx '    "system": "chaplygin-sleigh",' whole/manifest.json
expect "it has the settings" grep -qx '    "set": {"omega": 1.5},' whole/manifest.json
expect "the heads of the summary" grep -qx "observable,first,final,maximum,deviation,amplitude,rate,\
rate_low,rate_high,exponent,size,trend,confidence" whole/summary.csv
expect "D1 is not kept to rounding" grep -q '^D1,.*,rounding,[a-z ]*,[0-9.e-]*$' whole/summary.csv
try 0 run $long --output whole.npy
expect "the rows are the same as in a file" cmp whole.npy whole/trajectory.npy

case_is "a directory is not written over"
try 2 run $long --output whole
says "'whole/manifest.json' exists already"
mkdir -p mine
echo 'not a copy' >mine/system.yaml
try 2 run $long --output mine
says "'mine/system.yaml' exists already"
expect "the file was touched" grep -qx 'not a copy' mine/system.yaml
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --output other
try 0 run ./line.yaml --integrator rk4 --step 0.1 --time 1 --samples 5 --output other --force
expect "6 rows" has_rows other/trajectory.npy 6
expect "the system file was copied" cmp line.yaml other/system.yaml

case_is "a finished run"
try 0 resume whole
says "'whole' is finished: 20012 rows"
empty

case_is "killed at any moment"
cut_off 137 9 6 run $long --checkpoint 0 --output killed
for call in 3 8 15; do cut_off 137 9 $call resume killed --checkpoint 0; done
# A row half written when the power went is cut off.
printf '1.5,0.9' >>killed/trajectory.npy
try 0 resume killed
says "'killed' resumes at t = [0-9.]*[1-9][0-9.]* with row [1-9]"
expect "not the rows of a run never interrupted" cmp killed/trajectory.npy whole/trajectory.npy
expect "not the summary of a run never interrupted" cmp killed/summary.csv whole/summary.csv

case_is "killed between renaming the old checkpoint and the new one"
cp -r killed between
rm between/checkpoint.before between/summary.csv
mv between/checkpoint between/checkpoint.before
try 0 resume between
says "'between' is finished"
rm between/checkpoint.before
try 0 resume between
expect "not the rows of a run never interrupted" cmp between/trajectory.npy whole/trajectory.npy
expect "not the summary of a run never interrupted" cmp between/summary.csv whole/summary.csv

case_is "killed before the first checkpoint"
cp -r whole early
rm -f early/checkpoint early/checkpoint.before early/summary.csv
head -c 100 whole/trajectory.npy >early/trajectory.npy
try 0 resume early
expect "not the rows of a run never interrupted" cmp early/trajectory.npy whole/trajectory.npy

case_is "interrupted"
for signal in 15 2; do
    rm -rf stopped
    cut_off 130 $signal 20 run $long --checkpoint 0 --output stopped
    says 'interrupted; resume with: dalembert resume stopped'
done
"$program" run $long --time 1e9 --samples 1e9 --checkpoint 1e6 --output undue 2>err &
expect "no rows" reaches $! has_bytes undue/trajectory.npy 100000
ends_by INT 130 $!
expect "no checkpoint, though none was due" test -s undue/checkpoint
cp -r stopped cut
cp -r stopped flipped
cp -r stopped early_flip
try 0 resume stopped
expect "not the rows of a run never interrupted" cmp stopped/trajectory.npy whole/trajectory.npy
"$program" run $long --time 1e9 --samples 1e9 >out 2>err &
expect "no rows" reaches $! has_lines out 2
ends_by INT 130 $!
says 'interrupted; [0-9]+ rows are kept'
expect "whole lines" awk -F, 'NR == 1 { n = NF } NF != n { exit 1 }' out

# word FILE K: number k of its words of 64 bits, from 0.  flip FILE BYTE: changes one byte of it.
word() { od -A n -t d8 -j $((8 * $2)) -N 8 "$1" | tr -d ' '; }
flip() {
    old=$(od -A n -t u1 -j "$2" -N 1 "$1" | tr -d ' ')
    printf "\\$(printf %o $(((old + 1) % 256)))" | dd of="$1" bs=1 seek="$2" conv=notrunc 2>/dev/null
}

case_is "rows that are not the checkpoint's"
columns=$(columns_of whole.npy)
header=$(($(wc -c <whole.npy) - 20012 * columns * 8))
last=$((header + $(word cut/checkpoint 2) * columns * 8 - 8))
expect "checkpoints of one row" test "$(word cut/checkpoint 2)" -gt "$(word cut/checkpoint.before 2)"
truncate -s $last cut/trajectory.npy
flip flipped/trajectory.npy $last
for folder in cut flipped; do
    try 0 resume $folder
    says "$folder/checkpoint.before is read instead"
    expect "not the rows of a run never interrupted" cmp $folder/trajectory.npy whole/trajectory.npy
    expect "not the summary of a run never interrupted" cmp $folder/summary.csv whole/summary.csv
done
flip early_flip/trajectory.npy $((header + 100))
cp early_flip/trajectory.npy kept.npy
try 2 resume early_flip
says "early_flip/trajectory.npy': its first [0-9]+ rows were changed since the checkpoint"
expect "it was written to" cmp kept.npy early_flip/trajectory.npy

case_is "bytes of a checkpoint that are changed or missing"
size=$(wc -c <flipped/checkpoint)
rm flipped/checkpoint.before
cp flipped/checkpoint good
for place in 0 6 8 20 60 100 1000 $((size - 8)) $((size - 1)); do
    cp good flipped/checkpoint
    flip flipped/checkpoint $place
    try 2 resume flipped
    head -c $place good >flipped/checkpoint
    try 2 resume flipped
done

case_is "no room for more rows"
(
    ulimit -f 1000
    exec "$program" run $long --checkpoint 0 --output full 2>err
)
status=$?
expect "exit $status, not 4" [ $status -eq 4 ]
says "cannot write 'full/(trajectory.npy|checkpoint.new)': File too large"
try 0 resume full
expect "not the rows of a run never interrupted" cmp full/trajectory.npy whole/trajectory.npy

case_is "interrupted while the disk is full"
cut_off 130 15 9 run line.yaml --integrator rk4 --step 0.01 --time 100 --samples 10 --checkpoint 0 --output halted
expected=4
(trap '' XFSZ; ulimit -f 8; signalled 15 1 resume halted --checkpoint 1e6)
ended $? resume halted
says "^dalembert: cannot write 'halted/checkpoint\.new': File too large$"
refute "it is called interrupted" grep -q interrupted err

case_is "two processes on one directory"
"$program" run $long --time 1e9 --samples 1e9 --checkpoint 0 --output busy 2>err &
other=$!
expect "no checkpoint" reaches $other test -e busy/checkpoint
try 2 resume busy
says "busy/trajectory.npy': another process is writing to it"
ends_by KILL 137 $other

case_is "what cannot be resumed"
try 2 resume missing
says "there is no directory 'missing'"
cp -r whole damaged
printf 'x' | dd of=damaged/checkpoint bs=1 seek=100 conv=notrunc 2>/dev/null
cp -r killed older
printf x | dd of=older/checkpoint bs=1 seek=100 conv=notrunc 2>/dev/null
try 0 resume older
says 'older/checkpoint: the checkpoint is damaged: its check sum is wrong'
says 'older/checkpoint.before is read instead'
expect "not the rows of a run never interrupted" cmp older/trajectory.npy whole/trajectory.npy
expect "not the summary of a run never interrupted" cmp older/summary.csv whole/summary.csv
rm -f damaged/checkpoint.before
try 2 resume damaged
says 'damaged/checkpoint: the checkpoint is damaged: its check sum is wrong'
head -c 50 whole/checkpoint >damaged/checkpoint
try 2 resume damaged
says 'the checkpoint is damaged'
echo no >damaged/checkpoint
try 2 resume damaged
says 'the checkpoint is damaged: it is too short'
cp whole/checkpoint damaged/checkpoint
sed 's/^  "dalembert": .*/  "dalembert": "9.8.7",/' whole/manifest.json >damaged/manifest.json
try 2 resume damaged
says 'damaged/manifest.json:2:16: made by dalembert 9\.8\.7; this is [0-9.]+$'
sed 's/^  "dalembert": .*/  "dalembert": "0.0.1",/' whole/manifest.json >damaged/manifest.json
cp -r whole aged && cp damaged/manifest.json aged
try 2 resume aged
says 'aged/manifest.json:2:16: written by dalembert 0\.0\.1, which can resume it'
sed 's/"step": [0-9.]*/"step": 0.002/' whole/manifest.json >damaged/manifest.json
try 2 resume damaged
says 'damaged/checkpoint: belongs to another run'
sed 's/"step"/"stepp"/' whole/manifest.json >damaged/manifest.json
try 2 resume damaged
says "damaged/manifest.json:[0-9]+:[0-9]+: unknown option 'stepp' of a run"
sed '/"system": "chaplygin-sleigh"/d' whole/manifest.json >damaged/manifest.json
try 2 resume damaged
says '^dalembert: damaged/manifest.json:3:12: the system is missing$'
present=$("$program" --version | sed 's/.* //')
for text in '' '{' '[1]' '{"input": 1}' '{"dalembert": [1], "input": {}}' '{"input": {}}' \
    '{"input": {"system": ["x"]}}' '{"input": {"set": "x"}}' '{"input": {"set": {"x": []}}}'; do
    echo "$text" >damaged/manifest.json
    try 2 resume damaged
done
while read -r input reason; do
    echo '{"dalembert": "'"$present"'", "input": {"system": "line.yaml", '"$input"'}}' >damaged/manifest.json
    try 2 resume damaged
    says "^dalembert: (damaged/manifest.json:1:[0-9]+: )?$reason$"
    expect "another message" [ "$(wc -l <err)" -eq 1 ]
done <<'EOF'
"set":"x" set: names and values are required
"set":{"k":[]} k: a single value is required
"set":{"k":"z"} k: 'z' is not a number
"start":1 start: names and values are required
"start":{"x":[]} x: a single value is required
"start":{"x":"z"} x: 'z' is not a number
EOF
rm damaged/manifest.json
try 2 resume damaged
says "'damaged' holds no run: there is no damaged/manifest.json"
cp -r busy shorter
: >shorter/trajectory.npy
try 2 resume shorter
says "shorter/trajectory.npy': its columns are not the run's"

case_is "rows that are none"
for bytes in 0 9 50 200; do
    cp -r other ragged
    head -c $bytes other/trajectory.npy >ragged/trajectory.npy
    try 2 report ragged
    says "'ragged/trajectory.npy' is no .npy file of named doubles"
    rm -r ragged
done
cp -r other ragged
sed 's/(6,)/(7,)/' other/trajectory.npy >ragged/trajectory.npy
try 4 report ragged
says "'ragged/trajectory.npy' has fewer rows than its header states"
case_is "a header that states more bytes than there are"
# A machine that counts 4 GB as used before they are written has no memory for them.
if (ulimit -v 2000000 && "$program" --version) >out 2>err; then
    printf '\223NUMPY\2\0\377\377\377\377' >ragged/trajectory.npy
    (ulimit -v 2000000 && exec "$program" report ragged) >out 2>err
    status=$?
    expect "exit $status, not 2" [ $status -eq 2 ]
    says "'ragged/trajectory.npy' is no .npy file of named doubles"
else
    cannot 2 "this program does not begin within 2 GB, as under a sanitizer"
fi

# A directory of each earlier version is refused and left as it is, and so are statistics of a layout
# that this version does not read.
for kept in "$here"/data/run-*; do
    case_is "a directory of an earlier version, $(basename "$kept")"
    version=$(sed -n 's/^  "dalembert": "\(.*\)",$/\1/p' "$kept/manifest.json")
    layout=$(od -A n -t u8 -j 88 -N 8 "$kept/checkpoint" | tr -d ' ')
    rm -rf taken
    cp -r "$kept" taken
    try 2 resume taken
    says "^dalembert: taken/manifest.json:2:16: written by dalembert $version, which can resume it; \
dalembert $present resumes what 0\.3 or later wrote$"
    expect "it was changed" diff -r "$kept" taken
    sed "s/^  \"dalembert\": .*/  \"dalembert\": \"$present\",/" "$kept/manifest.json" >taken/manifest.json
    try 2 resume taken
    says "taken/checkpoint: its statistics have layout $layout; dalembert $present reads layout"
done

# same_but_digits_of_t ONE TWO: the rows have the same bytes except the last digit of t, which earlier versions
# rounded twice; a row is as long as from one t to the next.
same_but_digits_of_t() {
    bytes=$(($(od -A n -t u2 -j 8 -N 2 "$1") + 10))
    [ "$(wc -c <"$1")" = "$(wc -c <"$2")" ] && cmp -l "$1" "$2" |
        awk -v head=$bytes -v row="$3" '(($1 - 1 - head) % row) > 1 { bad = 1 } END { exit bad }'
}

# continues_format NUMBER TIME ROW END ROWS: a directory of an earlier format goes on, to the same bytes.
continues_format() {
    rm -rf taken never
    cp -r "$here/data/format-$1" taken
    expect "its format" [ "$(head -c 8 taken/checkpoint)" = DALCHK$1 ]
    try 0 resume taken
    says "'taken' resumes at t = $2 with row $3"
    expect "the format of now" [ "$(head -c 8 taken/checkpoint)" = DALCHK05 ]
    try 0 run taken/system.yaml --integrator gauss4 --step 0.01 --time $4 --samples $5 --space physical \
        --set k=9 --output never
    expect "not the rows of a run never interrupted" \
        same_but_digits_of_t taken/trajectory.npy never/trajectory.npy 32
    expect "not the summary of a run never interrupted" cmp taken/summary.csv never/summary.csv
}

case_is "a checkpoint of format 03, without parameters"
continues_format 03 '29\.75' 149 40 200

case_is "a checkpoint of format 04, without the choice of a solver"
continues_format 04 '2579\.19' 65 4000 100

# An earlier format has no room for what these need, or holds it at another place.
for needs in events pivots; do
    case_is "a checkpoint of format 04 of a system with $needs"
    rm -rf taken
    cp -r "$here/data/format-04-$needs" taken
    try 2 resume taken
    says "taken/checkpoint: has an earlier format, which lacks numbers that this system needs now; resume with the"
    expect "it was changed" diff -r "$here/data/format-04-$needs" taken
done

case_is "files of a run that are lost or damaged"
rm -rf lost
try 0 run line.yaml --integrator rk4 --step 0.1 --time 1 --output lost
# without WHAT: of a copy.
without() {
    rm -rf less
    cp -R lost less
    rm -rf "less/$1"
}
without trajectory.npy
try 2 resume less
says "^dalembert: 'less/trajectory\.npy' is missing: the run cannot be continued$"
expect "it was made" [ ! -e less/trajectory.npy ]
without manifest.json
try 2 resume less
says 'there is no less/manifest\.json$'
mkdir less/manifest.json
try 2 resume less
says "^dalembert: 'less/manifest\.json' is a directory$"
without system.yaml
try 2 resume less
says "^dalembert: 'less/system\.yaml' is missing: the run cannot be continued$"
for text in '' '{' '[]' '{"input": 1}' '{"dalembert": "0.2.0", "study": "x"}' 'hello'; do
    printf '%s' "$text" >less/manifest.json
    try 2 resume less
    says '^dalembert: less/manifest\.json:'
    refute "a run is called a study" grep -q "the study" err
done
try 0 run line.yaml --integrator rk4 --step 0.1 --time 1 --output less --force
expect "other rows" cmp lost/trajectory.npy less/trajectory.npy
rm -rf less lost
counted
