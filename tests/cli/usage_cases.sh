# Help, version, lists, and arguments that are no arguments.

case_is "help"
try 0 --help
prints '^usage: dalembert COMMAND'
prints '^  130 +interrupted$'
silent
try 0
prints '^usage: dalembert COMMAND'

case_is "version"
try 0 --version
prints '^dalembert [0-9]+\.[0-9]+\.[0-9]+$'

case_is "help of every command"
"$program" --help | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' >commands
for command in list show new check run resume study report; do
    expect "--help does not list $command" grep -qx $command commands
done
mkdir help
while read -r command; do
    try 0 "$command" --help
    prints "^usage: dalembert $command"
    silent
    mv out "help/$command"
    expect "$command: wider than 80 columns" awk 'length($0) > 80 { exit 1 }' "help/$command"
    # Other numbers than steps have names of their own.
    expect "$command: another value is called H" \
        awk '/^  --[a-z-]+ H( |$)/ && !/^  --step H/ { exit 1 }' "help/$command"
done <commands

case_is "the command help"
try 0 --help
mv out usage
try 0 help
expect "it does not list the commands" cmp usage out
while read -r command; do
    try 0 help "$command"
    expect "$command: help and --help differ" cmp "help/$command" out
done <commands
try 2 help rnu
says "^dalembert: unknown command 'rnu'; did you mean 'run'\?$"

case_is "help lists options below headings"
try 0 help run
for heading in arguments 'method and time' 'rows and observables' 'parameters and start' \
    'steps and implicit equations' output; do
    prints "^$heading:$"
done
expect "--set is below its heading" sh -c "grep -A1 '^parameters and start:' out | grep -q -- '--set'"
expect "an option is listed twice" test -z "$(grep -o '^  --[a-z-]*' out | sort | uniq -d)"
try 0 help list
prints '^options:$'

case_is "the reference has every option of every command"
try 0 help --markdown
silent
mv out reference
while read -r command; do
    awk -v command="$command" 'FILENAME == "reference" && /^## / { on = $0 == "## " command }
        FILENAME == "reference" { if (on) line[++n] = $0; next }
        match($0, /^  --[a-z-]+/) && (name = substr($0, 3, RLENGTH - 2)) != "--help" {
            for (k = n; k > 0 && line[k] !~ "^(- .|As for .*)" name "[^a-z-]"; k--) ;
            print (k > 0 ? "" : command " lacks " name) }' reference "help/$command" >lacking
    while IFS= read -r lack; do
        expect "$lack" test -z "$lack"
    done <lacking
done <commands
try 0 help run --markdown
prints '^- `--sampling linear\|log\|steps`: rows at equal distances in t, in log t, .* \(linear\)$'
prints 'p\\_\\\*, pi\\_\\\*'
prints '^- `trajectory.npy`: the rows'
expect "other commands" test "$(grep -c '^## ' out)" -eq 1
if needs 4 "no groff" there groff; then
    # The page that is made of it, without what is around the commands.
    { echo '.TH D 1'; echo '@COMMANDS@'; } |
        awk -v version=0 -v commands=reference -f "$here/../../tools/manual.awk" >page.1
    groff -ww -man -Tascii page.1 2>err | sed 's/.\x08//g' >page
    silent
    expect "no option of run" grep -q '^ *--sampling linear|log|steps$' page
    expect "no note of run" grep -q '^ *trajectory.npy$' page
    refute "escapes are left" grep -q "\\\\" page
    counted
fi

# completes WORDS...: what bash offers for the last one.
completes() {
    bash -c '. ./completion; COMP_WORDS=(dalembert "$@"); COMP_CWORD=$#; _dalembert "$0"
             echo "${COMPREPLY[*]}"' "$program" "$@"
}
if needs 21 "no bash" there bash; then
    case_is "completion by bash"
    awk -f "$here/../../tools/completion.awk" reference >completion
    expect "commands" test "$(completes re)" = "resume report"
    expect "options" test "$(completes run --sam)" = "--samples --sampling"
    expect "options of run in section" test "$(completes section --sp)" = "--space"
    expect "an option that it does not take" test -z "$(completes lyapunov --stat)"
    expect "words" test "$(completes run --sampling l)" = "linear log"
    expect "systems" test "$(completes check snake)" = "snakeboard"
    expect "systems to show" test "$(completes show snake)" = "snakeboard"
    expect "new" test "$(completes new --)" = "--help"
    expect "what is preserved" test "$(completes list --preserves e)" = "every energy"
    expect "integrators" test "$(completes run knife-edge --integrator gauss1)" = "gauss10 gauss12"
    expect "a list of them" test "$(completes order knife-edge --integrators rk4,gauss1)" = \
        "rk4,gauss10 rk4,gauss12"
    expect "tags" test "$(completes list --tag ch)" = "chaotic"
    expect "tables" test "$(completes list s)" = "systems"
    expect "commands to describe" test "$(completes help re)" = "resume report"
    expect "a value after =" test "$(completes run --native = o)" = "on off"
    expect "all values after =" test "$(completes run --native =)" = "auto on off"
    # Where nothing is offered bash completes names of files.
    for option in -o --output --step --on; do
        expect "a system after $option" test -z "$(completes section knife-edge $option kn)"
    done
    expect "-o" sh -c 'for c in run order volume; do grep -q "^        $c) .* --output -o " completion || exit 1; done'
    counted
fi

case_is "the files of a study"
try 0 study --help
prints '^  runs/NAME/        a directory per cell \(system, integrator, start, step\), as$'
prints "^                    'run' makes it, with rows after whole numbers of steps$"

if needs 5 "no terminal (script, stty)" terminal; then
    case_is "tables on a terminal of 80 columns"
    script -qec "stty cols 80; '$program' list systems" /dev/null </dev/null | tr -d '\r' >narrow
    expect "a line is wider" awk 'length($0) > 80 { exit 1 }' narrow
    expect "the text does not go on below itself" grep -q "^                                  constraint$" narrow
    COLUMNS=80 "$program" list systems >out
    expect "COLUMNS gives another table" cmp narrow out
    script -qec "stty cols 80; '$program' list --long" /dev/null </dev/null | tr -d '\r' >narrow
    expect "a line is wider" awk 'length($0) > 80 { exit 1 }' narrow
    expect "a title is lost" grep -q "^    Chaplygin's symmetric sleigh, linear constraint; paper, rev" narrow
    counted
fi

case_is "tables that fit"
for columns in 60 80 100 130 200; do
    COLUMNS=$columns "$program" list >out
    expect "a line of $columns is wider" awk -v most=$columns 'length($0) > most { exit 1 }' out
    expect "lines of $columns lack something" sh -c 'grep -q "^vertical-disk " out && grep -q "^+lift " out'
done
prints '^chaplygin-sleigh  .*linear in v .*conserved on D = 0  yes .* sleigh, linear constraint$'
COLUMNS=80 "$program" list >out
prints '^chaplygin-sleigh +3  1  Chaplygin.s symmetric sleigh, linear$'
prints '^rk4 +4 +classical Runge-Kutta$'
COLUMNS=100 "$program" list >out
prints '^dla +2 +every D, D at midpoints +discrete'
try 0 list
mv out complete
for columns in 0 -1 wide; do
    COLUMNS=$columns "$program" list >out
    expect "COLUMNS=$columns gives another table" cmp complete out
done
COLUMNS=80 "$program" list --markdown >out
prints '^\| `chaplygin-sleigh` .*\| conserved on D = 0 \|'
try 0 list --long
prints '^chaplygin-sleigh .*linear constraint +paper, reversible, integrable'
prints '^gni, nonholonomic-rattle .*Ferraro'

# first: the first words of the rows on standard output.
first() { sed '1,2d; s/[ ,].*//' out | tr '\n' ' '; }
case_is "lists that are filtered"
try 0 list --order 8
expect "order 8" test "$(first)" = "dop853 gauss8 lobatto8 +suzuki8 +kahan-li8 "
try 0 list --preserves energy
expect "energy" test "$(first)" = "discrete-gradient +project-energy "
try 0 list --preserves midpoints
expect "D at midpoints" test "$(first)" = "dla discrete-gradient "
for word in bilinear quadratic every; do
    try 0 list --preserves $word --order 4
    first >$word
done
expect "bilinear D" test "$(cat bilinear)" = \
    "mclachlan4 bm4 gauss4 lobatto4 spark4 gauss-spark4 lobatto-nonholonomic4 "
expect "quadratic D" test "$(cat quadratic)" = "gauss4 spark4 gauss-spark4 lobatto-nonholonomic4 "
expect "every D" test "$(cat every)" = "spark4 gauss-spark4 lobatto-nonholonomic4 "
try 0 list --tag chaotic
expect "a tag" test "$(first)" = "chaotic-oscillators "
try 0 list --tag chaotic --order 12
prints '^chaotic-oscillators '
prints '^gauss12 '
expect "more is listed" test "$(wc -l <out)" -eq 7
for filter in '--order 7' '--tag chaos' '--preserves energy --order 12'; do
    try 2 list $filter
    says "^dalembert: list: nothing matches; "
    empty
done
table <<'END'
2 | list systems --order 4 | says ^dalembert: list systems: --order and --preserves select integrators$
2 | list integrators --tag chaotic | says ^dalembert: list integrators: --tag selects systems$
END
try 2 list --preserves D
says "^dalembert: --preserves: 'D' is not one of bilinear\|quadratic\|every\|midpoints\|energy\|holonomic$"
empty

case_is "every option of a run is listed"
try 0 run --help
for option in integrator step time samples space set start solver iterations extend-energy tolerance solver-tolerance extra-iterations sums precision output; do
    prints "^  --$option "
done

case_is "values of options"
try 0 run --help
prints '^  --step H '
prints '^  --tolerance TOLERANCE( |$)'
prints '^  --solver-tolerance CHANGE( |$)'
try 0 order --help
expect "order: other defaults" sh -c 'tr -s " \n" " " <out | grep -q -- \
    "--time T integrates from t = T0 to t = T (10) .* (lifted) --solver"'

case_is "unknown command"
try 2 rnu
says "^dalembert: unknown command 'rnu'; did you mean 'run'\?$"
empty

case_is "unknown option"
try 2 --versoin
says "unknown option '--versoin'; did you mean '--version'\?"
try 2 run chaplygin-sleigh --integrater rk4
says "unknown option '--integrater'; did you mean '--integrator'\?"
try 2 resume --checkpont 1 there
says "unknown option '--checkpont'; did you mean '--checkpoint'\?"

case_is "renamed options name their new names"
table <<'END'
2 | run chaplygin-sleigh --integrator gauss8 --step 0.1 --time 1 --solve-to 1e-9 | says run: the option '--solve-to' is called '--solver-tolerance' now
2 | run chaplygin-sleigh --integrator gauss8 --step 0.1 --time 1 --extra-sweeps=1 | says run: the option '--extra-sweeps' is called '--extra-iterations' now
2 | explain chaplygin-sleigh --integrator gauss8 --step 0.1 --time 1 --long-steps 1 | says explain: the option '--long-steps' is called '--quad-steps' now
END
try 2 run chaplygin-sleigh --integrator gauss8 --step 0.1 --time 1 --precision long
says "^dalembert: --precision: 'long' is called 'quad' now$"
empty

case_is "options are never abbreviated"
try 2 run chaplygin-sleigh --integ rk4 --step 0.1 --time 1
says "unknown option '--integ'"
try 2 run chaplygin-sleigh --integrator rk4 --step 0.1 --time 1 --sample 3
says "unknown option '--sample'; did you mean '--samples'\?"

case_is "missing options are named"
printf 'coordinates: [x]\nlagrangian: (x'"'^2 - x^2)/2\nstart: {x: 1}\n" >plain.yaml
try 2 run plain.yaml --step 0.1 --time 1
says "^dalembert: --integrator is missing, and plain.yaml has no default for it$"
try 2 run plain.yaml --integrator rk4 --time 1
says "^dalembert: --step is missing, and plain.yaml has no default for it$"
try 2 run plain.yaml --integrator rk4 --step 0.1
says "^dalembert: --time is missing, and plain.yaml has no default for it$"
try 0 run plain.yaml --integrator rk4 --step 0.1 --times 0,1
silent
try 2 run --integrator rk4 --step 0.1 --time 1
says '^dalembert: the SYSTEM is missing; usage: dalembert run SYSTEM '
try 2 resume
says 'DIR is missing'

# errors N: the number of messages.
errors() { expect "$(wc -l <err) messages" test "$(wc -l <err)" -eq "$1"; }
case_is "all that is wrong is named at once"
try 2 run chaplygin-sleig --integrater rk4 --step x --tim 3 --precision dubble --solver newtn
says "unknown option '--integrater'; did you mean '--integrator'\?"
says "^dalembert: --step: 'x' is not a number"
says "unknown option '--tim'; did you mean '--time'\?"
says "^dalembert: --precision: 'dubble'"
says "^dalembert: --solver: 'newtn'"
says "unknown system 'chaplygin-sleig'; did you mean 'chaplygin-sleigh'\?"
errors 6
try 2 run line.yaml --integrator rk4 --step 0.1 --time 1 --samples=0
says '^dalembert: --samples: 0 is not in 1\.\.'
errors 1
try 2 run plain.yaml --integrator rk5 --sampling cubic
says "did you mean 'rk4'"
says "^dalembert: --sampling: 'cubic'"
says '^dalembert: --step is missing'
says '^dalembert: --time is missing'
errors 4
try 2 merge --froce
says "did you mean '--force'"
says 'the DIR... is missing; usage:'
says '^dalembert: --output is missing$'
errors 3
try 2 section plain.yaml knife-edge
says 'only one SYSTEM'
says '^dalembert: --on is missing; usage:'
errors 5
try 2 run plain.yaml --colour red --integrator rk4 --step 0.1 --time 1
says "unknown option '--colour'"
errors 1

case_is "missing and superfluous values"
table <<'END'
2 | run chaplygin-sleigh --step | says ^dalembert: --step needs a value
2 | run chaplygin-sleigh --step --time 1 | says ^dalembert: --step needs a value
2 | run chaplygin-sleigh --summary=yes | says ^dalembert: --summary takes no value$
2 | run chaplygin-sleigh knife-edge | says only one SYSTEM, not also 'knife-edge'
END

case_is "--opt=value is --opt value"
try 0 run chaplygin-sleigh --integrator rk4 --step 0.1 --time 1
mv out apart
try 0 run --integrator=rk4 --step=0.1 --time=1 -- chaplygin-sleigh
expect "the rows differ" cmp apart out

case_is "-o is --output in every command that has it"
while read -r command; do
    grep -q '^  --output ' "help/$command" || continue
    try 2 "$command" -o
    says '^dalembert: --output needs a value: --output '
    echo "$command"
done <commands >with_output
expect "$(tr '\n' ' ' <with_output)" test "$(wc -l <with_output)" -ge 9
try 0 run plain.yaml --integrator rk4 --step 0.1 --time 1 -o short.csv
try 0 run plain.yaml --integrator rk4 --step 0.1 --time 1 --output long.csv
expect "the rows differ" cmp short.csv long.csv
try 2 check plain.yaml -o x.csv
says "unknown option '-o'"

case_is "lists"
try 0 list
prints '^system '
prints '^integrator '
silent
try 0 list systems
for system in chaplygin-sleigh chaplygin-sleigh-nonlinear chaplygin-sleigh-friction \
    chaplygin-sleigh-vakonomic damped-oscillator nonholonomic-particle contact-oscillator \
    knife-edge vertical-disk appell-hamel isokinetic; do
    prints "^$system +[0-9]+ +[0-9]+ "
done
prints '^vertical-disk +4 +2 '
try 0 list integrators
for integrator in symplectic-euler-00 symplectic-euler-10 symplectic-euler-01 \
    symplectic-euler-11 stormer-verlet rk4 implicit-midpoint gauss4 gauss6 gauss8 gauss10 \
    gauss12 '\+project'; do
    prints "^${integrator}[ ,]"
done
prints '^rk4 +4 +explicit +- '
prints '^gauss12 +12 '
prints '^\+yoshida4 +4 +as NAME +as NAME '
try 0 list --markdown
prints '^\| `chaplygin-sleigh` +\|'
prints '^\|-+\|'
try 2 list sistems
says "unknown table 'sistems'; did you mean 'systems'\?"
