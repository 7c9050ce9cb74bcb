# One SIGTERM ends every wait: for a compiler, for gnuplot, for who reads a pipe, for a long
# computation; and nothing that was started goes on alone.

# stopped FILE: the process whose number it holds ends.
stopped() { expect "what was started goes on" awaits gone "$(cat "$1")"; }

mkdir -p wait/bin wait/home
printf '#!/bin/sh\necho $$ >"%s/wait/number.new"\nmv "%s/wait/number.new" "%s/wait/number"\nexec sleep 36000\n' \
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
# Steps are compiled where a cell has half a million of them.
printf '%s\n' 'title: t' 'integrators: [rk4, gauss4]' 'step: 0.1' 'time: 1e5' \
    'systems: [chaplygin-sleigh]' >wait/study.yaml
sed 's/1e5/1/' wait/study.yaml >wait/short.yaml

case_is "SIGTERM while a compiler runs"
motion="chaplygin-sleigh --integrator rk4 --step 0.1 --time 1"
for command in "run $motion" "run $motion --output wait/run" "explain $motion" \
    "section $motion --time 1e5 --on phi=1" "study wait/study.yaml --output wait/study --threads 2"; do
    alone $command --native on
    expect "no compiler was started" reaches $! test -e wait/number
    ends_by TERM 130 $!
    stopped wait/number
    refute "files are left" sh -c 'ls wait/home/dalembert/*'
done

case_is "SIGTERM while gnuplot runs"
try 0 run $motion --output wait/drawn
alone report wait/drawn --svg
expect "gnuplot was not started" reaches $! test -e wait/number
ends_by TERM 143 $!
if [ "$(uname)" = Linux ]; then stopped wait/number; else kill "$(cat wait/number)"; fi

case_is "SIGTERM while nobody reads"
for command in "run" "run --progress json"; do
    rm -f wait/pipe
    mkfifo wait/pipe
    sleep 36000 <wait/pipe &
    reader=$!
    "$program" $command chaplygin-sleigh --integrator rk4 --step 0.1 --time 1e8 --samples 1e9 \
        >wait/pipe 2>err &
    expect "no handlers" ready $!
    sleep 0.5 # the pipe is full by then, on most machines
    ends_by TERM 130 $!
    says '^dalembert: interrupted; [0-9]+ rows are kept$'
    kill $reader
    wait $reader 2>wait/log
done

case_is "SIGTERM while something is computed"
endless="chaplygin-sleigh --integrator rk4 --step 1e-2 --time 1e12"
for command in "run $endless" "lyapunov $endless" "volume $endless" "section $endless --on phi=1000" \
    "explain $endless --time 1e7" \
    "order chaplygin-sleigh --integrators gauss12 --step 1e-2 --time 1e12 --threads 2"; do
    "$program" $command >out 2>err &
    expect "no handlers" ready $!
    sleep 0.5 # something is computed by then, on most machines
    ends_by TERM 130 $!
done
rm -rf wait
