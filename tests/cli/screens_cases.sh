# What commands print: data/screens.txt is a list of commands, each after a dollar sign, with all that it prints to both
# outputs and its exit status where that is not 0.  Numbers are #, and blanks are single ones.  Where an output is
# changed on purpose that file changes with it: SCREENS=FILE writes it.

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
case_is "what commands print"
# Each command with its lines as one line.
awk 'NR > 1 && /^\$ / { print "" } { printf "%s\001", $0 }' "$here/data/screens.txt" >wanted
echo >>wanted
while IFS= read -r line; do
    printf '%s' "$line" | tr '\001' '\n' >wanted.block
    command=$(sed -n '1s/^\$ //p' wanted.block)
    screen "$command" >found.block
    cat found.block >>found
    diff wanted.block found.block >differences
    expect "$command: $(head -4 differences)" test ! -s differences
done <wanted
[ -z "${SCREENS:-}" ] || cp found "$SCREENS"
expect "no commands" test "$(wc -l <wanted)" -gt 40
