# What commands print: data/screens.txt is a list of commands, each after a dollar sign, with all that it prints to both
# outputs and its exit status where that is not 0.  Numbers are #, and blanks are single ones.  Where an output is
# changed on purpose that file changes with it: SCREENS=FILE writes it.  data/terminal.txt is the same for a terminal of
# 80 columns: TERMINAL=FILE.

study_of_states methods.yaml sleigh ', isokinetic-splitting'
printf '%s\n' 'integrators: [rk4, gauss4]' 'step: 0.1' 'time: 2' 'starts: physical' \
    'systems: [line.yaml, plane.yaml]' >small.yaml
ball falls.yaml "when: x - 0.3, set: {x': 2*u}" 'when: x - 1.25, stop: true'
printf '%s\n' 'coordinates: [x, y]' "lagrangian: (x'^2 + y'^2)/2" "constraints: [x' - y', 2*x' - 2*y']" >twice.yaml
printf '%s\n' 'coordinates: [x]' "lagrangian: (x'^2 - x^2)/2" 'start: {x: 1}' 'invariants: {wrong: x}' >wrong.yaml

awk 'BEGIN { print "t,x,y,x\047,y\047"
    for (t = 0; t <= 1; t += 0.125) print t "," 2*t "," 2*t ",2,2" }' >curve.csv
printf '%s\n' t,x,y 0,0,0 1,1,1 >short.csv

# Single blanks, # for a number that is no part of a name, and for units of measured times.
masked() {
    sed -E -e ':again' -e 's/(^|[^A-Za-z_0-9.#])[-+]?[0-9]+(\.[0-9]+)*(e[-+]?[0-9]+)?/\1#/; tagain' -e 's/  +/ /g; s/ $//' \
        -e 's/A step takes .*/A step takes/' -e 's/# ([num]|µ)?s( a step|:|,|$)/# s\2/'
}
# screen COMMAND: its block of the list.
screen() {
    echo "$ $1"
    eval "timeout --foreground $patience \"\$program\" $1" </dev/null >out 2>err
    status=$?
    masked <out | awk '!seen[$0]++'
    masked <err | awk '!seen[$0]++' | sed 's/^/2> /'
    [ $status -eq 0 ] || echo "exit $status"
}
escape=$(printf "\033\\[")
# on_terminal COMMAND: the same, both outputs as a terminal shows them, lines of progress left out.
on_terminal() {
    echo "$ $1"
    script -qec "stty cols 80 rows 50; TERM=xterm '$program' $1" /dev/null </dev/null >out
    status=$?
    sed "s/\r$//; s/.*\r//; s/${escape}[0-9;]*m//g" out | masked | awk '!seen[$0]++'
    [ $status -eq 0 ] || echo "exit $status"
}
# compare_screens FILE BLOCK: each command of the list with its lines as one line.
compare_screens() {
    awk 'NR > 1 && /^\$ / { print "" } { printf "%s\001", $0 }' "$here/data/$1" >wanted
    echo >>wanted
    : >found
    while IFS= read -r line; do
        printf '%s' "$line" | tr '\001' '\n' >wanted.block
        command=$(sed -n '1s/^\$ //p' wanted.block)
        $2 "$command" >found.block
        cat found.block >>found
        diff wanted.block found.block >differences
        expect "$command: $(head -4 differences)" test ! -s differences
    done <wanted
    expect "no commands" test "$(wc -l <wanted)" -gt 25
}
case_is "what commands print"
compare_screens screens.txt screen
[ -z "${SCREENS:-}" ] || cp found "$SCREENS"
case_is "what a terminal shows"
if needs 37 "no terminal (script, stty)" terminal; then
    compare_screens terminal.txt on_terminal
    [ -z "${TERMINAL:-}" ] || cp found "$TERMINAL"
    counted
fi
