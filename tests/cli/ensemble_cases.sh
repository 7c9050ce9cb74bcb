# Ensembles: the files of a directory against what is computed from the members, and the same bytes
# whatever the threads, shards and interruptions.

members=1000
begin="ensemble chaplygin-sleigh --space physical --integrator rk4 --step 0.01 --times 0.5,1,2 --members $members
    --seed 3 --vary y1'=normal(0,0.1) --vary m=uniform(0,1) --vary phi'=lognormal(0,0.2) --no-page"
# All files except what the interruption leaves.
same_ensemble() { ! diff -rq "$1" "$2" | grep -v ': chunks\|: lock\|: report\|: manifest'; }
# The members of a .npy file as texts, $2 numbers in a line, $3 lines at its end.
numbers_of() { tail -c $((8 * $2 * $3)) "$1" | od -An -v -tf8 -w$((8 * $2)); }

case_is "an ensemble"
try 0 $begin --output whole --threads 1
prints "^t = 2, $members members$"
silent
expect "final.npy" has_rows whole/final.npy $members
expect "members.npy" has_rows whole/members.npy $members
expect "members.npy has other columns" test "$(columns_of whole/members.npy)" -eq 5
expect "statistics of other times" test "$(column t whole/statistics.csv | sort -u | tr '\n' ' ')" = "0.5 1 2 "
expect "members failed" test "$(wc -l <whole/failures.csv)" -eq 1
expect "rows.npy does not end in final.npy" test "$(numbers_of whole/rows.npy 6 $members | cksum)" = \
    "$(numbers_of whole/final.npy 6 $members | cksum)"

# The table repeats the last time of statistics.csv with six digits, below heads and a rule as long as each column.
case_is "the table of an ensemble"
sed -n '2,$p' out >table.txt
awk -F, 'BEGIN { print "column mean deviation min max" }
    $1 == 2 { printf "%s %.6g %.6g %.6g %.6g\n", $2, $4, $5, $6, $NF }' whole/statistics.csv >expected.txt
sed 2d table.txt | tr -s ' ' | sed 's/ $//' >words.txt
expect "other heads or numbers" cmp -s expected.txt words.txt
awk '{ for (i = 1; i <= NF; i++) if (length($i) > width[i]) width[i] = length($i) }
    END { for (i = 1; i <= 5; i++) { while (width[i]-- > 0) printf "-"; printf "%s", i < 5 ? "  " : "\n" } }' \
    expected.txt >rule.txt
sed -n 2p table.txt >printed.txt
expect "another rule" cmp -s rule.txt printed.txt
expect "columns are not aligned" awk 'NR == FNR { rule = $0; next }
    { for (i = 2; i <= length(rule); i++)
          if (substr(rule, i - 1, 2) == " -" && substr($0, i - 1, 2) !~ /^ [^ ]$/) exit 1 }' rule.txt table.txt

case_is "heads of an ensemble's files"
while read -r file heads; do
    expect "other heads of $file" test "$(head -n 1 whole/$file)" = "$heads"
done <<'END'
statistics.csv t,column,count,mean,deviation,min,q0.05,q0.25,q0.5,q0.75,q0.95,max
covariance.csv t,column,y1,y2,phi,y1',y2',phi'
histograms.csv t,column,low,high,count
failures.csv member,t,reason,y1',m,phi',message
cloud.csv t,member,y1,y2
END

case_is "an ensemble under a tolerance, without a step"
controlled="ensemble knife-edge --integrator dop853 --tolerance 1e-9 --time 2 --members 300 --seed 3
    --vary x'=normal(0,0.1) --no-page"
try 0 $controlled --output chosen
try 0 $controlled --step 0.02 --output given
expect "other members" cmp -s chosen/final.npy given/final.npy
expect "not in the manifest" grep -q '"step": 0.02' chosen/manifest.json
try 0 resume chosen
printf 'coordinates: [x]\nlagrangian: x'"'"'^2/2\n' >free.yaml
try 0 ensemble ./free.yaml --integrator dop853 --tolerance 1e-9 --times 1,2 --members 9 --seed 3 \
    --vary "x'=normal(0,1)" --output listed --no-page
expect "not a hundredth" grep -q '"step": 0.02' listed/manifest.json
try 2 ensemble ./free.yaml --integrator dop853 --tolerance 1e-9 --times 0.3,1.7 --members 9 --seed 3 \
    --vary "x'=normal(0,1)" --output bad
says "^dalembert: --times: 0.3 is not a whole number of steps of 0.017 from t = 0"

# The definitions, on sorted numbers; type 7 of Hyndman and Fan.
case_is "statistics of an ensemble"
numbers_of whole/final.npy 6 $members >final.txt
k=0
for name in y1 y2 phi "y1'" "y2'" "phi'"; do
    k=$((k + 1))
    awk -v k=$k '{ print $k }' final.txt | sort -g | awk '
        { x[NR - 1] = $1; sum += $1 }
        function quantile(p,  at, low) {
            at = p * (NR - 1); low = int(at)
            return x[low] + (at - low) * (x[low + 1 < NR ? low + 1 : low] - x[low])
        }
        END {
            mean = sum / NR
            for (i = 0; i < NR; i++) squares += (x[i] - mean)^2
            printf "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", NR, mean,
                sqrt(squares / (NR - 1)), x[0], quantile(0.05), quantile(0.25), quantile(0.5),
                quantile(0.75), quantile(0.95), x[NR - 1]
        }' >expected.txt
    awk -F, -v name="$name" '$1 == 2 && $2 == name { for (i = 3; i <= NF; i++) printf "%s ", $i }' \
        whole/statistics.csv | cat - expected.txt | tr '\n' ' ' >both.txt
    expect "$name: other statistics" awk 'NF != 20 { exit 1 }
        { for (i = 1; i <= 10; i++) { d = $i - $(i + 10); if (d > 1e-12 || d < -1e-12) exit 1 } }' both.txt
done
awk '{ a += $1; b += $4; s += $1 * $4 } END { printf "%.17g", (s - a * b / NR) / (NR - 1) }' final.txt >expected.txt
awk -F, '$1 == 2 && $2 == "y1" { print $6 }' whole/covariance.csv | cat - expected.txt | tr '\n' ' ' >both.txt
expect "another covariance" awk '{ exit !(NF == 2 && ($1 - $2)^2 < 1e-20) }' both.txt
expect "histograms lack members" awk -F, -v n=$members 'NR > 1 { sum[$1 "," $2] += $5 }
    END { for (i in sum) { kinds++; if (sum[i] != n) exit 1 } exit kinds != 18 }' whole/histograms.csv

case_is "members are the same as single runs"
numbers_of whole/members.npy 5 $members | sed -n 700p >drawn.txt
read -r status t drawn_v drawn_m drawn_w <drawn.txt
try 0 show chaplygin-sleigh
m=$(awk -v x="$drawn_m" 'BEGIN { printf "%.17g", 1 + x }')
v=$(awk -v x="$drawn_v" 'BEGIN { printf "%.17g", 1 + x }')
w=$(awk -v x="$drawn_w" 'BEGIN { printf "%.17g", 1 + x }')
try 0 run chaplygin-sleigh --space physical --integrator rk4 --step 0.01 --time 2 --samples 1 --set "m=$m" \
    --start "y1'=$v" --start "phi'=$w" --consistent --columns "q,v" --output single.csv
tail -n 1 single.csv | cut -d, -f 2- | tr ',' ' ' >single.txt
sed -n 700p final.txt | cat - single.txt | tr '\n' ' ' >both.txt
expect "member 699 is another motion" awk '{ if (NF != 12) exit 1
    for (i = 1; i <= 6; i++) if (($i - $(i + 6))^2 > 1e-24) exit 1 }' both.txt

case_is "progress of an ensemble"
try 0 $begin --output shown --progress json
expect "no last line" grep -q "^{\"done\": $members, \"members\": $members, \"seconds\": [^ ]*, \"remaining\": 0}$" err
expect "other lines" test "$(grep -cv '^{"done": ' err)" -eq 0
expect "other bytes" same_ensemble whole shown
table <<'END'
0 | $begin --output shown --shard 2/2 --progress json --force | says ^\{"done": 488, "members": 488, 
0 | resume shown --progress json --no-page | says ^\{"done": 488, "members": 488, "seconds": [^ ]*, "remaining": 0\}$
END
try 0 $begin --output shown --progress off --force
silent

case_is "threads, native, checkpoints change no byte"
try 0 $begin --output other --threads 2 --native off --checkpoint 0
expect "other bytes" same_ensemble whole other
if needs 2 "no compiler" there cc; then
    try 0 $begin --output native --native on
    expect "other bytes by compiled steps" same_ensemble whole native
    counted
fi

case_is "shards of an ensemble"
try 0 $begin --output third-1 --shard 1/3
says "other shards are not done"
expect "statistics of a shard" test ! -e third-1/statistics.csv
try 2 merge third-1 --output merged
says "is done in none of the directories"
try 0 $begin --output third-2 --shard 2/3
try 0 $begin --output third-2 --shard 3/3
try 0 merge third-1 third-2 --output merged --force --no-page
expect "other bytes of shards" same_ensemble whole merged
try 0 $begin --output third-2 --shard 1/3
expect "other bytes of shards in one directory" same_ensemble whole third-2
try 0 $(echo "$begin" | sed 's/--seed 3/--seed 4/') --output seed-4 --shard 1/3
try 2 merge seed-4 third-2 --output merged --force
says "belongs to another ensemble"
try 2 $(echo "$begin" | sed 's/--seed 3/--seed 4/') --output third-1 --shard 2/3
says "belongs to another ensemble"

case_is "shards in one directory are resumed"
for k in 1 2; do try 0 $begin --output halves --shard $k/2 --threads 1; done
for k in 1 2; do : >halves/chunks-$k-of-2; done
rm halves/statistics.csv
printf '%8000s' '' | dd of=halves/final.npy bs=1 seek=300 conv=notrunc 2>/dev/null
try 0 resume halves --no-page
expect "other bytes" same_ensemble whole halves

case_is "an ensemble is merged into itself"
rm halves/statistics.csv
try 0 merge halves --output halves --no-page
expect "other bytes" same_ensemble whole halves

case_is "shards side by side in one directory"
pids=
for k in 1 2 3; do
    timeout --foreground $patience "$program" $begin --output beside --shard $k/3 --threads 1 >out.$k 2>err.$k &
    pids="$pids $!"
done
for pid in $pids; do
    ends=0
    wait "$pid" || ends=$?
    cat err.[123] >err
    expect "a shard failed" test $ends -eq 0
done
expect "other bytes of shards side by side" same_ensemble whole beside
expect "no shard has written the statistics" grep -q "^t = 2" out.1 out.2 out.3

case_is "an ensemble by MPI"
# mpi_ensemble STATUS RANKS "OPTION.." ARGUMENT...: mpirun's own options in one word.
mpi_ensemble() {
    status=$1 ranks=$2 options=$3
    shift 3
    by_mpi $status -n $ranks $options "$mpi_program" "$@"
}
if needs 33 "no mpirun, or no dalembert-mpi (make mpi)" eval 'has_mpi && raises'; then
    words=${begin%--no-page}
    mpi_ensemble 0 3 "" $words --output by-mpi
    prints "^t = 2, $members members$"
    silent
    expect "other bytes by MPI" same_ensemble whole by-mpi
    mpi_ensemble 2 2 "" $words --output by-mpi
    says "'by-mpi' holds an ensemble: 'dalembert resume by-mpi' continues it, --force overwrites it"
    mpi_ensemble 0 9 "" $words --output by-mpi --force
    expect "other bytes of more processes than chunks" same_ensemble whole by-mpi
    mpi_ensemble 2 2 "" $words
    says "^dalembert: --output is missing; usage: mpirun dalembert-mpi ensemble SYSTEM"
    mpi_ensemble 2 2 "" $words --output unmade --vary "k=normal(0,1)"
    says "^dalembert: --vary: unknown start value or parameter 'k'"
    mpi_ensemble 2 2 "" --resume --output unmade
    expect "something was made" test ! -e unmade
    mpi_ensemble 0 1 "" ensemble --help
    prints '^usage: mpirun dalembert-mpi ensemble SYSTEM'
    silent
    # A rank in its second chunk.
    for killed_by in 9:137 2:130; do
        rm -rf stopped
        mpi_ensemble ${killed_by#*:} 2 "-x LD_PRELOAD=$top/raise_signal.so -x RAISE=${killed_by%:*} -x RAISE_AT=12
            -x RAISE_WRITE=1" $words --output stopped --checkpoint 0
        expect "it is finished" test ! -e stopped/statistics.csv
        expect "no chunk is done" grep -qa "$(printf '\001')" stopped/chunks-1-of-2 stopped/chunks-2-of-2
        cp -r stopped stopped-too
        mpi_ensemble 0 3 "" --resume --output stopped
        expect "other bytes, resumed by MPI" same_ensemble whole stopped
        try 0 resume stopped-too --no-page
        expect "statistics more than once" test "$(grep -c '^t = 2' out)" -eq 1
        expect "other bytes, resumed" same_ensemble whole stopped-too
        rm -r stopped-too
    done
    counted
fi

case_is "two processes on one ensemble"
"$program" ensemble line.yaml --integrator rk4 --step 1e-6 --time 1e6 --native off --threads 1 --members 300 --seed 1 \
    --vary "k=normal(0,0.1)" --output busy >out 2>err &
other=$!
expect "no directory" reaches $other test -e busy/chunks
expect "no signals are caught" ready $other
try 2 resume busy
says "'busy/chunks': another process is writing to it"
ends_by INT 130 $other
says "^dalembert: interrupted; resume with: dalembert resume busy$"
expect "members are done that are not" test "$(tail -c 2 busy/chunks | od -An -tx1)" = " 00 00"

case_is "an ensemble is resumed"
try 2 $begin --output whole
says "dalembert: 'whole' holds an ensemble: 'dalembert resume whole' continues it, --force overwrites it"
try 0 resume whole
cp -r whole one-line
tr '\n' ' ' <whole/manifest.json >one-line/manifest.json # the same JSON in another layout
try 0 resume one-line --no-page
expect "other bytes after a second end" same_ensemble whole other
try 2 run line.yaml --integrator rk4 --step 0.1 --time 1 --output whole
if needs 32 "no compiler for signals at given places" raises; then
    RAISE_WRITE=1
    export RAISE_WRITE
    for call in 1 4 5 9 13 17 22; do
        rm -rf killed
        cut_off 137 9 $call $begin --output killed --threads 1 --checkpoint 0
        again=$begin
        [ -e killed/manifest.json ] && again="resume killed"
        cut_off 137 9 3 $again $([ "$again" = "$begin" ] && echo --output killed) --threads 2
        unset RAISE_WRITE
        [ -e killed/manifest.json ] && again="resume killed --no-page"
        try 0 $again $([ "$again" = "$begin" ] && echo --output killed)
        expect "killed at $call: other bytes" same_ensemble whole killed
        RAISE_WRITE=1
        export RAISE_WRITE
    done
    cut_off 130 2 7 $begin --output interrupted --checkpoint 0 --threads 1
    says "interrupted; resume with: dalembert resume interrupted"
    unset RAISE_WRITE
    try 0 resume interrupted --no-page
    expect "interrupted: other bytes" same_ensemble whole interrupted
    counted
fi
rm killed/final.npy
try 2 resume killed
says "'killed/final.npy' is missing: the ensemble cannot be continued"
printf x >killed/final.npy
try 2 resume killed
says "'killed/final.npy' is not the file that was begun"

case_is "an ensemble on a full disk"
expected=4
(ulimit -f 100 && exec timeout --foreground $patience "$program" $begin --output full) >out 2>err
ended $? ensemble
[ -s err ] && says "cannot write 'full/.*.npy': File too large"

case_is "members that fail"
cat >root.yaml <<'END'
coordinates: [x]
parameters: {s: 1}
lagrangian: x'^2/2
forces: {x: -s*sqrt(x)}
start: {x: 1}
END
try 0 ensemble root.yaml --integrator rk4 --step 0.01 --time 1 --space physical --members 300 --seed 1 \
    --vary "s=uniform(0,20)" --output failing --no-page
lost=$(($(wc -l <failing/failures.csv) - 1))
says "^dalembert: $lost of 300 members failed:$"
says "^dalembert: $lost: "
expect "$lost failed" test $lost -gt 100 -a $lost -lt 299
expect "failed members are counted" test "$(column count failing/statistics.csv | sort -u)" -eq $((300 - lost))
expect "failed members have states" test \
    "$(numbers_of failing/final.npy 2 300 | grep -c nan)" -eq $lost
# The message names this member and t: a = sqrt(x) is not defined in the step from there.
expect "failures without their messages" awk -F, '
    NR == 1 { if ($5 != "message") exit 1; next }
    { t = $NF; sub(/.* t = /, "", t); if ($NF !~ /^"?a value is not finite in the step of 0.01 from/ || t != $2) exit 1 }
    END { exit NR < 100 }' failing/failures.csv
for k in 1 2; do
    try 0 ensemble root.yaml --integrator rk4 --step 0.01 --time 1 --space physical --members 300 --seed 1 \
        --vary "s=uniform(0,20)" --output failing-$k --no-page --shard $k/2 --native off
done
try 0 merge failing-1 failing-2 --output failing-both --no-page
expect "other failures, merged" same_ensemble failing failing-both
try 0 ensemble root.yaml --integrator rk4 --step 0.01 --time 1 --space physical --members 9 --seed 1 \
    --vary "s=uniform(0,1)" --output failing-both --force --no-page
expect "messages of an ensemble before" test ! -e failing-both/messages
mkdir failing-1/messages/kept
printf x >failing-1/messages/kept/file
try 4 ensemble root.yaml --integrator rk4 --step 0.01 --time 1 --space physical --members 9 --seed 1 \
    --vary "s=uniform(0,1)" --output failing-1 --force --no-page
says "^dalembert: cannot remove 'failing-1/messages/kept': "
expect "failures without their draws" awk -F, 'NR > 1 && !($4 > 0 && $2 < 1) { exit 1 }' failing/failures.csv
try 3 ensemble root.yaml --integrator rk4 --step 0.01 --time 1 --members 9 --seed 1 --vary "s=uniform(50,60)" \
    --output lost --no-page
says "9 of 9 members failed"
try 3 ensemble chaplygin-sleigh --integrator rk4 --step 0.01 --time 1 --members 9 --seed 1 --consistent off \
    --vary "y2'=uniform(1,2)" --output off --no-page
says "9 of 9 members failed"

case_is "wrong ensembles"
wrong() {
    message=$1
    shift
    try 2 ensemble line.yaml --integrator rk4 --step 0.1 --time 1 --output wrong "$@"
    says "$message"
    empty
}
one="--members 10 --seed 1"
wrong "--vary: unknown start value or parameter 'k2'; did you mean 'k'\?" $one --vary "k2=normal(0,1)"
wrong "--vary: k: the standard deviation -1 is negative" $one --vary "k=normal(0,-1)"
wrong "--vary: k: uniform needs LOW < HIGH" $one --vary "k=uniform(1,0)"
wrong "--vary: unknown distribution 'gauss', not one of uniform normal lognormal" $one --vary "k=gauss(1,0)"
wrong "--vary: 'k' is not NAME=DISTRIBUTION" $one --vary k
wrong "--vary: k is varied twice" $one --vary "k=normal(0,1)" --vary "k=uniform(0,1)"
wrong "--members: 0 is not in 1..1000000000" --members 0 --seed 1 --vary "k=normal(0,1)"
wrong "--members: 1e12 is not in 1..1000000000" --members 1e12 --seed 1 --vary "k=normal(0,1)"
wrong "--seed: -1 is not in 0\.\." --members 10 --seed -1 --vary "k=normal(0,1)"
wrong "--seed is missing" --members 10 --vary "k=normal(0,1)"
wrong "--vary is missing" $one
wrong "--times: 0.25 is not a whole number of steps of 0.1" $one --vary "k=normal(0,1)" --times 0.25,1
wrong "--quantiles: 2 is not from 0 to 1" $one --vary "k=normal(0,1)" --quantiles 0.5,2
wrong "--quantiles: more than 16" $one --vary "k=normal(0,1)" --quantiles 0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1
wrong "--axes: 'x' is not two columns" $one --vary "k=normal(0,1)" --axes x
wrong "unknown column of --axes 'y'" $one --vary "k=normal(0,1)" --axes "x,y"
wrong "--shard: '3/2' is not K/N" $one --vary "k=normal(0,1)" --shard 3/2
for output in x.csv x.npy x.h5 -; do
    wrong "--output: '$output' is no directory" $one --vary "k=normal(0,1)" --output $output
    expect "$output was made" test ! -e ./$output
done
expect "a directory was made" test ! -e wrong
mkdir wrong
printf x >wrong/manifest.json
wrong "'wrong' is not empty and holds no results of dalembert" $one --vary "k=normal(0,1)"
printf '{\n  "dalembert": "0.5.0"\n}\n' >wrong/manifest.json
wrong "'wrong' holds something else" $one --vary "k=normal(0,1)"
rm wrong/manifest.json
mkdir wrong/manifest.json
wrong "^dalembert: 'wrong/manifest.json' is a directory$" $one --vary "k=normal(0,1)"

case_is "numbers of a manifest that no ensemble has"
for number in members:0 members:-1 members:1e99 seed:-3; do
    rm -rf changed && cp -r whole changed
    sed -i "s/\"${number%:*}\": [0-9]*/\"${number%:*}\": ${number#*:}/" changed/manifest.json
    try 2 resume changed
    says "^dalembert: changed/manifest.json:[0-9]+:[0-9]+: (${number%:*}: .* is out of range|0 members)$"
done

case_is "a manifest that no ensemble has"
while IFS='|' read -r change message; do
    rm -rf changed && cp -r whole changed
    sed -i "$change" changed/manifest.json
    try 2 resume changed --no-page
    says "^dalembert: $message$"
    expect "more messages" test "$(wc -l <err)" -eq 1
    empty
done <<'END'
s/"vary": .*/"vary": [],/|--vary is missing: nothing would vary
s/"vary": .*/"vary": [[1]],/|changed/manifest.json:[0-9]+:[0-9]+: vary: a single value is required
s/normal/gauss/|--vary: unknown distribution 'gauss', not one of uniform normal lognormal
s/"quantiles": .*/"quantiles": [0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1],/|changed/manifest.json:[0-9]+:[0-9]+: too many quantiles
s/"quantiles": .*/"quantiles": [0.5, "x"],/|changed/manifest.json:[0-9]+:[0-9]+: quantiles: 'x' is not a number
s/"quantiles": .*/"quantiles": [0.5, 2],/|changed/manifest.json:[0-9]+:[0-9]+: quantiles: 2 is not from 0 to 1
s/"members": .*/"members": "x",/|changed/manifest.json:[0-9]+:[0-9]+: members: 'x' is not a number
s/"axes": .*/"axes": []/|changed/manifest.json:[0-9]+:[0-9]+: axes: a single value is required
s/"dalembert": .*/"dalembert": "99.0.0",/|changed/manifest.json:[0-9]+:[0-9]+: made by dalembert 99.0.0; this is .*
END

case_is "the page of an ensemble"
try 0 report whole
for figure in cloud-1 cloud-3 histogram-1 histogram-6 band-2; do
    expect "no $figure" grep -q '^plot' whole/report/$figure.gp
done
expect "no table" grep -q 'Statistics at t = 2' whole/report/index.html
expect "a histogram does not begin at 0" grep -q '^set yrange \[0:\*\]$' whole/report/histogram-1.gp
expect "nothing about the system" grep -q "<h1 id=.top.>Chaplygin.*s symmetric sleigh, linear" whole/report/index.html
expect "nothing about what varies" grep -q '<dt>added to each</dt>' whole/report/index.html
# Moved along y1 the members have the same phi, which has no figure.
try 0 ensemble chaplygin-sleigh --members 20 --seed 3 --vary "y1=uniform(0,1)" --time 1 --space physical \
    --output shifted
expect "no figure of what varies" test -e shifted/report/histogram-1.gp
expect "a figure of what does not" test ! -e shifted/report/histogram-3.gp
case_is "the page of an ensemble: of many times the first, the last, and others between"
try 0 report whole
# titles: the times that the figures name, in their order.
titles() { sed -n "s/.*'t = \([0-9.]*\)'.*/\1/p" "$@" | tr '\n' ' '; }
expect "other clouds" test "$(titles whole/report/cloud-[123].gp)" = "0.5 1 2 "
expect "other histograms" test "$(titles whole/report/histogram-1.gp)" = "0.5 1 2 "
try 0 ensemble chaplygin-sleigh --members 20 --seed 3 --vary "y1=uniform(0,1)" --space physical --output many \
    --step 0.1 --time 1.4 --times 0,0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1,1.1,1.2,1.3,1.4
# Twelve of fifteen: floor(14 k/11); four: floor(14 k/3).
expect "other clouds of many" test "$(titles many/report/cloud-?.gp many/report/cloud-1?.gp)" = \
    "0 0.1 0.2 0.3 0.5 0.6 0.7 0.8 1 1.1 1.2 1.4 "
expect "other histograms of many" test "$(titles many/report/histogram-1.gp)" = "0 0.4 0.9 1.4 "
