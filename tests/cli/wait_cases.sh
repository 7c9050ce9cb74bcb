# One SIGTERM ends every wait: for a compiler, for gnuplot, for who reads a pipe, for a long
# computation; and nothing that was started goes on alone.

# started FILE: waits until a script of `fake` has written its number.
started() { appears "$1" && sleep 0.2; }
# ends WANTED SECONDS PID: a process that got SIGTERM ends by then with that status.
ends() {
    kill -TERM "$3"
    begun=$(date +%s)
    wait "$3"
    status=$?
    holds "exit $status, not $1" [ $status -eq "$1" ]
    took=$(($(date +%s) - begun))
    holds "$took seconds" [ $took -le "$2" ]
}
# gone FILE: the process whose number it holds ends within some seconds.
gone() {
    for i in 1 2 3 4 5 6 7 8 9 10; do
        kill -0 "$(cat "$1")" 2>/dev/null || break
        sleep 0.3
    done
    holds "what was started goes on" sh -c "! kill -0 $(cat "$1")"
}

mkdir -p wait/bin wait/home
printf '#!/bin/sh\necho $$ >"%s/wait/number.new"\nmv "%s/wait/number.new" "%s/wait/number"\nexec sleep 60\n' \
    "$work" "$work" "$work" >wait/bin/sleeper
chmod +x wait/bin/sleeper
cp wait/bin/sleeper wait/bin/cc
cp wait/bin/sleeper wait/bin/gnuplot
# alone ARGUMENT...: in the background, where compilers and gnuplot never end.
alone() {
    rm -f wait/number
    PATH="$work/wait/bin:$PATH" HOME=$work/wait/home XDG_CACHE_HOME=$work/wait/home \
        "$program" "$@" >out 2>err &
}
printf '%s\n' 'title: t' 'integrators: [rk4, gauss4]' 'step: 0.1' 'time: 1' \
    'systems: [chaplygin-sleigh]' >wait/study.yaml

case_is "SIGTERM while a compiler runs"
motion="chaplygin-sleigh --integrator rk4 --step 0.1 --time 1"
for command in "run $motion" "run $motion --output wait/run" "explain $motion" \
    "section $motion --time 1e5 --on phi=1" "study wait/study.yaml --output wait/study --threads 2"; do
    alone $command --native on
    holds "no compiler was started" started wait/number
    ends 130 5 $!
    gone wait/number
    holds "files are left" sh -c '! ls wait/home/dalembert/* >/dev/null 2>&1'
done

case_is "SIGTERM while gnuplot runs"
try 0 run $motion --output wait/drawn
alone report wait/drawn
holds "gnuplot was not started" started wait/number
ends 143 5 $!
if [ "$(uname)" = Linux ]; then gone wait/number; else kill "$(cat wait/number)"; fi

case_is "SIGTERM while nobody reads"
for command in "run" "run --progress json"; do
    rm -f wait/pipe
    mkfifo wait/pipe
    sleep 60 <wait/pipe &
    reader=$!
    "$program" $command chaplygin-sleigh --integrator rk4 --step 0.1 --time 1e5 --samples 100000 \
        >wait/pipe 2>err &
    sleep 0.7
    ends 130 8 $!
    says '^dalembert: interrupted; [0-9]+ rows are kept$'
    kill $reader
    wait $reader 2>wait/log
done

case_is "SIGTERM while something is computed"
for command in "run $motion" "lyapunov $motion" "volume $motion" "section $motion --on phi=1000" \
    "explain $motion" "order chaplygin-sleigh --integrators gauss12 --threads 2"; do
    "$program" $command --time 1e7 --step 1e-2 >out 2>err &
    sleep 0.7
    ends 130 5 $!
done
rm -rf wait
