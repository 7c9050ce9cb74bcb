# check, study and report as commands: statuses, files, messages.

case_is "check of every built-in system"
for system in $("$program" list systems | awk 'NR > 2 { print $1 }'); do
    try 0 check $system
    prints '^[0-9]+ items, 0 failed$'
    silent
done

case_is "a check that fails"
# The exact solution of x'' = -x' is not t.
sed 's/^exact:.*/exact: {x: t}/' line.yaml >wrong.yaml
try 1 check ./wrong.yaml
prints 'FAIL'

case_is "check of what cannot be checked"
try 2 check
says 'SYSTEM is missing'
try 2 check knife-egde
says "unknown system 'knife-egde'; did you mean 'knife-edge'\?"
try 2 check chaplygin-sleigh --set omege=1
says "'omege'; did you mean 'omega'\?"

cat >study.yaml <<'END'
title: two of them
systems: [chaplygin-sleigh, contact-oscillator]
integrators: [rk4, symplectic-euler+project]
step: [0.1, 0.05]
time: 5
END

case_is "study"
try 0 study study.yaml --output one --threads 1
prints '^two of them$'
prints '^chaplygin-sleigh: '
prints '^  rk4 '
silent
holds "tables.txt" cmp out one/tables.txt
# 2 systems x 2 integrators x 2 steps x 3 starts, and a line of names.
holds "25 lines of cells" [ "$(wc -l <one/cells.csv)" -eq 25 ]
try 0 study study.yaml --output two --threads 2
for directory in one two; do sed 's/,[^,]*$//' $directory/cells.csv >$directory.cells; done
holds "the number of threads matters" cmp one.cells two.cells
holds "the number of threads matters" cmp one/quantities.csv two/quantities.csv

case_is "study files with faults"
try 2 study missing.yaml
says "cannot read 'missing.yaml': No such file"
sed 's/^integrators/integraters/' study.yaml >fault.yaml
try 2 study fault.yaml
says "^dalembert: fault\.yaml:3:1: .*'integraters'.*'integrators'"
sed 's/rk4/rk5/' study.yaml >fault.yaml
try 2 study fault.yaml
says "^dalembert: fault\.yaml:3:15: .*'rk5'.*'rk4'"
sed 's/contact-oscillator/contact-oscilator/' study.yaml >fault.yaml
try 2 study fault.yaml
says "^dalembert: .*'contact-oscilator'.*'contact-oscillator'"
sed 's/0\.05/-0.05/' study.yaml >fault.yaml
try 2 study fault.yaml
says '^dalembert: fault\.yaml:4:1[3-4]: '

case_is "a cell that fails does not end the study"
cat >singular.yaml <<'END'
systems: [chaplygin-sleigh-nonlinear, chaplygin-sleigh]
integrators: [rk4]
step: 0.1
time: 5
starts: [physical]
END
try 3 study singular.yaml --output singular
holds "it is told of" grep -q 'DAL_SINGULAR' singular/cells.csv
holds "the other is done" grep -q 'DAL_OK' singular/cells.csv

case_is "study without room"
"$program" study study.yaml --output three >/dev/full 2>err
status=$?
holds "exit $status, not 4" [ $status -eq 4 ]
try 4 study study.yaml --output missing/folder
says "missing/folder"

case_is "study interrupted"
sed 's/^time:.*/time: 1e6/' study.yaml >long.yaml
"$program" study long.yaml --output long >out 2>err &
sleep 0.5
kill -INT $!
wait $!
status=$?
holds "exit $status, not 130" [ $status -eq 130 ]

case_is "report"
try 2 report
says 'DIR is missing'
try 2 report missing
says "'missing' holds neither a study"
if command -v gnuplot >/dev/null; then
    try 0 report one
    holds "a page" [ -s one/report/index.html ]
    try 0 report other
    holds "a page" [ -s other/report/index.html ]
fi
