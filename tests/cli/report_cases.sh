# `dalembert report`: pages and figures.

case_is "a report of nothing"
try 2 report
says 'the DIR is missing'
mkdir -p hollow
try 2 report hollow
says "'hollow' holds neither a study \(cells.csv\) nor a run \(trajectory.npy\)"
try 2 report nowhere
says "'nowhere' holds neither"
try 2 report hollow --format gif
says "'gif' is neither svg nor png"

cat >drawn.yaml <<'END'
integrators: [rk4, gauss4, gauss4+project]
step: 0.1
time: 2
systems:
  - {system: chaplygin-sleigh, label: "a <b> \"c\" 'd'"}
  - line.yaml
  - {system: chaplygin-sleigh-vakonomic, label: vakonomic}
  - {system: chaplygin-sleigh-vakonomic, label: refused, starts: surface}
END
try 0 study drawn.yaml --output drawn
try 0 run chaplygin-sleigh --integrator gauss4 --step 0.1 --time 1 --output ran

if command -v gnuplot >/dev/null 2>&1; then
    case_is "the report of a study"
    try 0 report drawn
    silent
    prints '^drawn/report/index.html$'
    holds "no figure" grep -q '<svg' "drawn/report/a <b> \"c\" 'd'.svg"
    holds "no figure of a study with refused cells" grep -q '<svg' drawn/report/vakonomic.svg
    holds "no word of a study of refused cells" grep -q 'No run has numbers' drawn/report/index.html
    holds "no figure of the line" grep -q '<svg' drawn/report/line.yaml.svg
    holds "the label is not text" grep -q '<h2>a &lt;b&gt;' drawn/report/index.html
    holds "no verdicts" grep -q '<td class="not enough data">' drawn/report/index.html
    holds "no tables" grep -q 'What this shows' drawn/report/index.html

    case_is "the report of a run"
    try 0 report ran --format png
    holds "no figure" test -s ran/report/run.png
    holds "no summary" grep -q 'Summary' ran/report/index.html
fi

case_is "no gnuplot"
PATH=/nonexistent "$program" report ran >out 2>err
status=$?
holds "exit $status, not 4" test $status -eq 4
says 'gnuplot is not installed'
