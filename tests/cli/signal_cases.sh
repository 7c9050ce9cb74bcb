# Signals: the first ends a command where its work can be ended, the second ends the program.

cat >swing.yaml <<'END'
coordinates: [x]
lagrangian: (x'^2 - x^2)/2
start: {x: 1}
END
# One step that takes hours: up to 1e5 substeps of dop853, in quad precision, with 5000 sines in the force.
awk 'BEGIN { print "coordinates: [x]\nstart: {x: 1}"; printf "accelerations: {x: -x + 1e-6*(0"
    for (i = 1; i <= 5000; i++) printf " + sin(x + %d)", i; print ")}" }' >sines.yaml
slow="./sines.yaml --integrator dop853 --tolerance 1e-28 --precision quad --step 1e5 --time 1e5"
# request_in_step: two signals at once in the midst of a step, which are one request: a launcher signals a
# program and then its group.  Where they came before the step, which ends the program, it begins again.
request_in_step() {
    for delay in 1 3 10 30 100; do
        "$program" run $slow --output slow.csv --force 2>err &
        pid=$!
        ready $pid && sleep $delay
        kill -STOP $pid
        kill -INT $pid
        kill -TERM $pid
        kill -CONT $pid
        sleep 1
        gone $pid 2>/dev/null || return 0
    done
    return 1
}
# ends_at_last SIGNAL: repeated, since a signal less than half a second after the first is the same request.
ends_at_last() {
    for i in $(seq $patience); do
        kill -"$1" $pid
        sleep 1
        gone $pid && return
    done
    return 1
}
for signal in INT TERM; do
    [ $signal = INT ] && number=2 || number=15
    case_is "a second SIG$signal ends what the first did not"
    if request_in_step; then pass; else fail "ended by a request in the midst of a step"; fi
    expect "it goes on" ends_at_last $signal
    kill -9 $pid 2>/dev/null
    wait $pid 2>/dev/null
    status=$?
    expect "exit $status after SIG$signal, not $((128 + number))" test $status -eq $((128 + number))
done

case_is "a section is interrupted: its rows are kept"
cut="section ./swing.yaml --on x --integrator rk4 --step 0.001 --native off"
try 0 $cut --time 300
mv out whole.csv
"$program" $cut --time 1e12 --output cut 2>err >counted &
pid=$!
expect "no rows" reaches $pid has_lines cut/section.csv 4
ends_by INT 130 $pid
says '^dalembert: interrupted; [0-9]+ rows are kept$'
expect "whole lines" awk -F, 'NR == 1 { n = NF } NF != n { exit 1 }' cut/section.csv
rows=$(($(wc -l <cut/section.csv) - 1))
expect "$rows rows" test $rows -gt 2
expect "not as many as are counted" grep -q "; $rows rows\$" counted
# x = cos t crosses 0 at pi/2 + k pi; rk4 is late by h^4/120 of t
expect "other crossings" awk -F, 'NR > 1 { d = $2 - (NR - 1.5)*3.14159265358979
    if (d^2 > 1e-12*$2^2 || $3 != (NR % 2 ? 1 : -1)) exit 1 }' cut/section.csv
least=$((rows < 95 ? rows : 95))
head -n $((least + 1)) cut/section.csv >short.csv
head -n $((least + 1)) whole.csv >wanted.csv
expect "not the rows of a section never interrupted" cmp short.csv wanted.csv

# interrupts COMMAND OPTION: on an endless motion, by rk4, which the option names.
interrupts() {
    "$program" "$1" ./swing.yaml "$2" rk4 --time 1e12 --step 0.01 >out 2>err &
    pid=$!
    expect "no handlers" ready $pid
    ends_by INT 130 $pid
}
case_is "order is interrupted"
interrupts order --integrators
alone '^dalembert: interrupted$'

case_is "predict is interrupted: its curves are printed"
interrupts predict --integrator
says '^dalembert: interrupted; the curves so far are kept$'
expect "a second message" test "$(wc -l <err)" -eq 1
prints '^\./swing\.yaml: changes predicted from t = 0 to '
