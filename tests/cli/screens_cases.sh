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

# Of printed lines: single blanks, # for a number that is no part of a name, and for units of measured times.  Lines that
# begin with \x02 are no output, lines that begin with \x01 were printed to stderr.
masked() {
    sed -E -e '/^\x02/b' "$@" -e ':again' -e 's/(^|[^A-Za-z_0-9.#])[-+]?[0-9]+(\.[0-9]+)*(e[-+]?[0-9]+)?/\1#/; tagain' \
        -e 's/  +/ /g; s/ $//' -e 's/A step takes .*/A step takes/' -e 's/# ([num]|µ)?s( a step|:|,|$)/# s\2/'
}
escape=$(printf "\033\\[")
# screen COMMAND: to pipes; on_terminal COMMAND: both outputs as a terminal of 80 columns gets them.
screen() { eval "\"\$program\" $1"; }
on_terminal() { script -qec "stty cols 80 rows 50; TERM=xterm '$program' $1" /dev/null; }
# compare_screens FILE BY OPTION...: each command of the list by that function, with options of sed that come first.
# The commands are run one by one, then one pass over all that they print writes `found`, a list as FILE is one.
compare_screens() {
    wanted=$here/data/$1 by=$2
    shift 2
    rm -rf printed && mkdir printed
    count=0
    sed -n 's/^\$ //p' "$wanted" >commands
    while IFS= read -r command; do
        count=$((count + 1))
        $by "$command" </dev/null >printed/$count.out 2>printed/$count.err
        echo "$? $command"
    done <commands >ended
    awk 'function copy(file, begin) { while ((getline line <file) > 0) print begin line; close(file) }
        { status = $1; sub(/^[0-9]+ /, ""); print "\002$ " $0 }
        { copy("printed/" NR ".out", ""); copy("printed/" NR ".err", "\001") }
        status != 0 { print "\002exit " status }' ended |
        masked "$@" |
        awk '/^\002/ { split("", seen); print substr($0, 2); next } !seen[$0]++ { sub(/^\001/, "2> "); print }' >found
    awk 'FNR == 1 { list++ } /^\$ / { block[list]++; k = 0 }
        { lines[list, block[list], ++k] = $0; count[list, block[list]] = k }
        END { for (i = 1; i <= block[1]; i++) {
            difference = ""
            for (k = 1; difference == "" && (k <= count[1, i] || k <= count[2, i]); k++)
                if (lines[1, i, k] "" != lines[2, i, k] "")
                    difference = lines[1, i, 1] ": line " k ": \"" lines[2, i, k] "\", not \"" lines[1, i, k] "\""
            print difference } }' "$wanted" found >differences
    : >err
    while IFS= read -r difference; do
        expect "$difference" test -z "$difference"
    done <differences
    expect "no commands" test "$count" -gt 25
}
case_is "what commands print"
compare_screens screens.txt screen
[ -z "${SCREENS:-}" ] || cp found "$SCREENS"
case_is "what a terminal shows"
if needs 37 "no terminal (script, stty)" terminal; then
    # lines of progress are left out
    compare_screens terminal.txt on_terminal -e "s/\r$//; s/.*\r//; s/${escape}[0-9;]*m//g"
    [ -z "${TERMINAL:-}" ] || cp found "$TERMINAL"
    counted
fi
