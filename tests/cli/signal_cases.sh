# Signals: the first ends a command where its work can be ended, the second ends the program.

# One step that takes long: dop853 divides it into 1e5 substeps, in quad precision.
cat >swing.yaml <<'END'
coordinates: [x]
lagrangian: (x'^2 - x^2)/2
start: {x: 1}
END
slow="./swing.yaml --integrator dop853 --tolerance 1e-28 --precision quad --step 1e5 --time 1e5"
# alive PID: it is neither gone nor a zombie.
alive() { kill -0 "$1" 2>/dev/null && ! grep -q '^State:.Z' "/proc/$1/status"; }
# ends PID: within three seconds.
ends() {
    for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
        alive "$1" || return 0
        sleep 0.2
    done
    return 1
}
# ends_by SIGNAL STATUS: the signal ends the process $pid, with that status.
ends_by() {
    kill -"$1" $pid
    holds "it goes on" ends $pid
    kill -9 $pid 2>/dev/null
    wait $pid
    status=$?
    holds "exit $status after SIG$1, not $2" test $status -eq "$2"
}
for signal in INT TERM; do
    [ $signal = INT ] && number=2 || number=15
    case_is "a second SIG$signal ends what the first did not"
    "$program" run $slow --output slow.csv 2>err &
    pid=$!
    sleep 0.5
    kill -$signal $pid
    sleep 0.1
    kill -$signal $pid # a launcher signals a program and then its group: that is one request
    sleep 0.7
    holds "ended by a request in the midst of a step" alive $pid
    ends_by $signal $((128 + number))
done

case_is "a section is interrupted: its rows are kept"
cut="section ./swing.yaml --on x --integrator rk4 --step 0.001 --native off"
try 0 $cut --time 300
mv out whole.csv
"$program" $cut --time 1e7 --output cut 2>err >counted &
pid=$!
appears cut/section.csv
sleep 1
ends_by INT 130
says '^dalembert: interrupted; [0-9]+ rows are kept$'
holds "whole lines" awk -F, 'NR == 1 { n = NF } NF != n { exit 1 }' cut/section.csv
rows=$(($(wc -l <cut/section.csv) - 1))
holds "$rows rows" test $rows -gt 2
holds "not as many as are counted" grep -q "; $rows rows\$" counted
# x = cos t crosses 0 at pi/2 + k pi; rk4 is late by h^4/120 of t
holds "other crossings" awk -F, 'NR > 1 { d = $2 - (NR - 1.5)*3.14159265358979
    if (d^2 > 1e-12*$2^2 || $3 != (NR % 2 ? 1 : -1)) exit 1 }' cut/section.csv
least=$((rows < 95 ? rows : 95))
head -n $((least + 1)) cut/section.csv >short.csv
head -n $((least + 1)) whole.csv >wanted.csv
holds "not the rows of a section never interrupted" cmp short.csv wanted.csv

case_is "order is interrupted"
"$program" order ./swing.yaml --integrators rk4 --time 1e7 --step 0.01 >out 2>err &
pid=$!
sleep 0.5
ends_by INT 130
says '^dalembert: interrupted$'
empty
