# `dalembert report`: pages and figures.

case_is "a report of nothing"
try 2 report
says 'the DIR is missing'
mkdir -p hollow
try 2 report hollow
says "'hollow' holds neither a study \(cells.csv\) nor a run \(trajectory.npy\) nor an ensemble \(statistics.csv\) nor orders \(order.csv\) nor a section \(section.csv\) nor exponents \(lyapunov.csv\) nor a volume \(volume.csv\)"
try 2 report nowhere
says "^dalembert: there is no directory 'nowhere'$"
mkdir -p begun && touch begun/study.yaml
table <<'END'
2 | report begun | says 'begun' holds a study that is not finished: 'dalembert resume' continues it
2 | report hollow --format png | says unknown option '--format'
2 | report hollow --svg --pdf | says --svg and --pdf exclude each other
END

cat >drawn.yaml <<'END_OF_STUDY'
title: Three & more
integrators: [rk4, gauss4, gauss4+project]
step: [0.1, 0.05]
time: 2
systems:
  - {system: chaplygin-sleigh, label: "a <b> \"c\" 'd'"}
  - line.yaml
  - {system: chaplygin-sleigh-vakonomic, label: vakonomic}
  - {system: chaplygin-sleigh-vakonomic, label: refused, starts: surface}
expect:
  line.yaml: {rk4: {state: done, E: {at most: 1e-30}}, gauss4: {state: done}}
END_OF_STUDY
try 1 study drawn.yaml --output drawn
try 0 run chaplygin-sleigh --integrator gauss4 --step 0.1 --time 6.283185307179586 --samples 80 \
    --set v0=0.1 --output ran
page=drawn/report/index.html

case_is "the largest drift on the page of a run by --steps"
# |drift| <= |rate| (t - t0) with t = steps times step: the same as by --time.
for length in "--steps 4000" "--time 200"; do
    try 0 run knife-edge --integrator gauss4+project --step 0.05 $length --samples 100 --output of-length --force
    try 0 report of-length
    grep -o '|drift| ≤ [^<]*' of-length/report/index.html >"drift$length"
done
expect "no drift" test -s "drift--time 200"
expect "no drift of 0" sh -c "! grep '0\.0e+00' 'drift--steps 4000'"
expect "another drift" cmp "drift--steps 4000" "drift--time 200"

# The reduced disk has an invariant, and neither D nor E nor H before it.
case_is "figures of observables without D, E and H"
try 0 run falling-disk-reduced --space physical --integrator rk4 --step 0.1 --time 2 --output reduced
try 0 report reduced
expect "no figure of the invariant" grep -q '<strong>Invariants</strong>' reduced/report/index.html
# The space that the method chooses, and the one of the option.
for options in "--integrator gni" "--integrator gauss4 --space lifted" "--integrator gauss4 --space physical"; do
    try 0 run pendulum-cvt $options --step 0.1 --time 2 --output spaces --force
    try 0 report spaces
    expect "no figure of E: $options" grep -q '<strong>Energy</strong>' spaces/report/index.html
    refute "p is a quantity: $options" grep -q '"title": "p_x"' spaces/report/index.html
done

# Of 10000 steps of a harmonic motion x = cos t, 50 rows lie at random phases: the band of all steps has the
# amplitude all along, and the last 512 steps are there to the step, x at t = h k, with p at its place.
case_is "figures of all steps of a run with few rows"
printf 'coordinates: [x]\nlagrangian: x%s^2/2 - x^2/2\nstart: {x: 1}\n' "'" >harmonic.yaml
try 0 run harmonic.yaml --integrator gauss8 --step 0.125 --steps 10000 --samples 50 --output stepped
try 0 report stepped
if needs 2 "no python3" there python3; then
    python3 "$here/page_data.py" curves stepped/report/index.html coordinates >band
    expect "no band of width 2" awk -F'\t' '$2 == "x" { n++; wrong += $3 == "line" || $6 < 0.99 || $5 > -0.99 }
        END { exit n < 64 || wrong }' band
    python3 "$here/page_data.py" curves stepped/report/index.html coordinates-last >last
    expect "not the last steps" awk -F'\t' 'function off(x, y) { return (x > y ? x - y : y - x) > 1e-4 }
        { n++; wrong += off($4, 1250 - 0.125*(512 - n)) || off($5, cos($4)) } END { exit n != 512 || wrong }' last
    counted
fi
# A run that was interrupted keeps them: figures are as of the whole run.
try 0 run harmonic.yaml --integrator gauss8 --step 0.125 --steps 6000 --samples 30 --output parts
try 0 resume parts --steps 10000
try 0 report parts
expect "other figures than of the whole run" sh -c 'for d in stepped parts; do
    grep -o "class=.figure.>.*</script>" $d/report/index.html >$d.figures; done; cmp stepped.figures parts.figures'

if needs 45 "no python3" there python3; then
    case_is "the envelopes of a page are the maxima of series/"
    # Of three methods with two steps: D, E, I, H and the error of the sleigh, D, E and I of the
    # vakonomic one, all but D of the line.
    try 0 report drawn
    python3 "$here/page_data.py" envelopes $page drawn >compared 2>&1
    expect "$(cat compared)" test "$(cat compared)" = "72 envelopes"

    # x = 1 - t is exact in this method: 1/x is infinite at t = 1.
    case_is "the envelope of what becomes infinite"
    cat >pole.yaml <<'END2'
coordinates: [x]
lagrangian: x'^2/2
start: {x: 1, x': -1}
invariants: {c: 1/x}
END2
    printf 'integrators: symplectic-euler-00\nstep: 0.25\ntime: 2\nstarts: physical\nsystems: [pole.yaml]\n' >poles.yaml
    try 0 study poles.yaml --no-page --output poles
    try 0 report poles
    python3 "$here/page_data.py" envelopes poles/report/index.html poles >compared 2>&1
    expect "$(cat compared)" test "$(cat compared)" = "2 envelopes"

    # The sleigh goes round a circle of radius 0.1 about (0, 0.1) with angular velocity 1; between two
    # of 81 rows the cubic is off by (pi/40)^4/384 of the radius, and x, y are rounded to 1/65535 of
    # their ranges, 0.2.
    case_is "the motion on the page of a run"
    try 0 report ran
    python3 "$here/page_data.py" motions ran/report/index.html >motion
    expect "it is no motion round the circle" awk 'function off(x, y) { return (x > y ? x - y : y - x) > 2e-6 }
        { n[$1]++; wrong += off($3, 0.1*sin($2)) || off($4, 0.1 - 0.1*cos($2)) || ($5 - $2)^2 > 1e-8 || $6 != 0 }
        END { exit n["gauss4"] != 641 || n["exact"] != 641 || wrong }' motion

    # rk4 leaves the circle of radius 1 by as much as the error of its last row; the exact motion does not.
    case_is "the exact motion beside an inaccurate one"
    try 0 run chaplygin-sleigh --integrator rk4 --step 0.2 --time 60 --samples 300 --output parted
    try 0 report parted
    error=$("$program" run chaplygin-sleigh --integrator rk4 --step 0.2 --time 60 --samples 1 --columns error | sed -n '$s/.*,//p')
    python3 "$here/page_data.py" motions parted/report/index.html >motion
    expect "not both motions" awk -v e="$error" 'function far(x, y) { return x > y ? x - y : y - x }
        { d = far($3, sin($2)); s = far($4, 1 - cos($2)); if (s > d) d = s; n[$1]++; last[$1] = d
          if (d > most[$1]) most[$1] = d }
        END { exit n["rk4"] != 2401 || n["exact"] != 2401 || most["exact"] > 2e-5 || e < 0.01 || far(last["rk4"], e) > 4e-5 }' motion

    # An exact solution without a value from t = 0.95 to 1.5 is shown up to there, with eight frames a row.
    case_is "an exact motion ends where it is not known"
    cat >known.yaml <<'END2'
coordinates: [x]
lagrangian: x'^2/2
start: {x': 1}
exact: {x: "if((t - 0.95)*(t - 1.5) > 0, t, sqrt(0.9 - t))"}
END2
    try 0 run known.yaml --integrator gauss4 --step 0.1 --time 2.5 --samples 25 --output known
    try 0 report known
    python3 "$here/page_data.py" motions known/report/index.html >motion
    expect "another end" awk '{ end[$1] = $2; wrong += $1 == "exact" && ($4 - $2)^2 > 1e-8 }
        END { exit wrong || end["gauss4"] != 2.5 || !(end["exact"] > 0.93 && end["exact"] < 0.95) }' motion

    # 3000 steps and 51 rows, a turn apart: the last 512 steps, from t = 300 - 51.1 on, with cubics between them.
    case_is "of rows that are far apart the last steps are shown"
    try 0 run chaplygin-sleigh --integrator gauss8 --step 0.1 --time 300 --samples 50 --output far
    try 0 report far
    python3 "$here/page_data.py" motions far/report/index.html >motion
    expect "not the last steps" awk 'function off(x, y, e) { return (x > y ? x - y : y - x) > e }
        { n[$1]++; if (n[$1] == 1) first[$1] = $2; wrong += off($3, sin($2), 2e-5) || off($4, 1 - cos($2), 2e-5) || off($5, $2, 1e-3) }
        END { exit wrong || n["gauss8"] != 4089 || n["exact"] != 4089 || off(first["gauss8"], 248.9, 1e-9) || off($2, 300, 1e-9) }' motion
    expect "no word of it" grep -q '"step":0.1,"part":"the last 512 steps".*"smooth":true' far/report/index.html
    # A box that turns in its place, by 6 radians from row to row, has no path; it, too, is shown at its steps.
    printf "coordinates: [a]\nlagrangian: a'^2/2\nstart: {a': 1}\npicture: {x: 0, y: 0, wz: a', body: box}\n" >turns.yaml
    try 0 run turns.yaml --integrator gauss4 --step 0.1 --time 300 --samples 50 --output turns
    try 0 report turns
    expect "rows of a body that turns" grep -q '"step":0.1,"part":"the last 512 steps"' turns/report/index.html
    # Without a picture, and with columns that are no state, the state is in the steps.
    try 0 run chaplygin-sleigh --integrator gauss8 --step 0.1 --time 300 --samples 50 --columns E --output columns
    try 0 report columns
    python3 "$here/page_data.py" motions columns/report/index.html | grep gauss8 >shown
    grep gauss8 motion >wanted
    expect "another motion than with all columns" cmp wanted shown

    case_is "rows that are far apart are the frames where no steps are kept"
    try 0 run chaplygin-sleigh --integrator gauss4 --step 1.5 --time 300 --samples 50 --output kept
    try 0 report kept
    python3 "$here/page_data.py" motions kept/report/index.html >motion
    expect "$(wc -l <motion) frames" test "$(grep -c gauss4 motion)" -eq 51
    expect "exact frames at other times than the rows" awk '$1 == "exact" { n++; wrong += ($3 - sin($2))^2 > 1e-9 } END { exit wrong || n != 51 }' motion
    expect "no word of it" grep -q '"smooth":false' kept/report/index.html

    case_is "a system without a picture: its first pair of coordinates"
    printf 'coordinates: [x, x2, x1]\naccelerations: {x: 0, x2: 0, x1: 0}
start: {x2: 3, x1'"'"': 1}\n' >pair.yaml
    rm -rf pair
    try 0 run ./pair.yaml --integrator rk4 --step 0.1 --time 2 --output pair
    try 0 report pair
    python3 "$here/page_data.py" motions pair/report/index.html >motion
    expect "not x1 over x2" awk '($3 - $2)^2 > 1e-8 || $4 != 3 { wrong = 1 } END { exit wrong || NR < 20 }' motion
    expect "the axes have other names" grep -q '"axes":\["x1","x2"\],"body":"point"' pair/report/index.html
    sed -i 's/x2/z/g' pair.yaml
    rm -rf pair
    try 0 run ./pair.yaml --integrator rk4 --step 0.1 --time 2 --output pair
    try 0 report pair
    expect "not the first two coordinates" grep -q '"plane":false,"axes":\["x","z"\],"body":"point"' pair/report/index.html
    refute "their path is a figure" test -e pair/report/path.gp
    # x = t^2/2 - t
    printf "coordinates: [x]\naccelerations: {x: 1}\nstart: {x': -1}\n" >single.yaml
    try 0 run ./single.yaml --integrator gauss4 --step 0.1 --time 2 --output single
    try 0 report single
    python3 "$here/page_data.py" motions single/report/index.html >motion
    expect "not x over t" awk '($3 - $2)^2 > 1e-8 || ($4 - $2^2/2 + $2)^2 > 1e-6 { wrong = 1 } END { exit wrong || NR < 20 }' motion
    # max |E - E(0)| is 0 in one curve: the abscissas of a later one are still its own.
    printf '%s\n' 'coordinates: [x]' 'accelerations: {x: 1}' 'invariants: {a: 0*x, b: x, c: 2*x}' >shared.yaml
    try 0 run ./shared.yaml --integrator rk4 --step 0.1 --time 2 --output shared
    try 0 report shared
    expect "no abscissas of an earlier curve" grep -q '"name":"drift".*"title":"b",[^]]*"x":\[.*"title":"c",[^[]*"x":0,' shared/report/index.html

    # By their orders, 1, 4 and the tolerance, the motions that are farthest apart.
    case_is "the most and the least accurate motion of a study"
    printf '%s\n' 'integrators: [rk4, dop853, symplectic-euler-10]' 'step: 0.05' 'tolerance: [1e-6, 1e-8]' 'time: 6' \
        'starts: physical' 'systems: [chaplygin-sleigh]' >pair-of.yaml
    try 0 study pair-of.yaml --no-page --output pair-of
    try 0 report pair-of
    python3 "$here/page_data.py" motions pair-of/report/index.html | cut -d " " -f 1 | uniq >motion
    expect "$(cat motion)" test "$(tr '\n' ' ' <motion)" = "dop853 symplectic-euler-10 "
    counted
fi

case_is "the report of a study"
try 0 report drawn
silent
prints '^drawn/report/index.html$'
expect "no figure" grep -q '^plot' drawn/report/1-E.gp
expect "no script" grep -q '^plot' drawn/report/1-E.gp
expect "no figure of a study with refused cells" grep -q '^plot' drawn/report/2-D.gp
expect "no result" grep -q '<p class="lead"><b>1 of 3</b> methods keep D at rounding in every run; ' $page
expect "no methods to take" grep -q '<dt>Take for D</dt><dd>gauss4+project</dd>' $page
expect "a table is before the sentences" sh -c "sed '/class=.lead/q' $page | grep '<table' | wc -l | grep -qx 0"
expect "no worst of a family" grep -q '<th scope="row">projected <small>1</small></th><td class="kept" title="gauss4+project"><b>ok</b></td>' $page
expect "a system without a constraint comes early" test "$(grep -o '<a href="#s[0-9]" class="part">[^<]*' $page | sed 's/.*>//' | tail -1)" = line
expect "no word of a study of refused cells" grep -q 'No run has numbers' $page
expect "no figure of the line" grep -q '^plot' drawn/report/4-E.gp
expect "no order diagram" grep -q '^plot' drawn/report/4-order.gp
expect "no work-precision diagram" grep -q '^plot' drawn/report/4-work.gp
expect "the label is not text" grep -q "<small>a &lt;b&gt; &quot;c&quot; 'd'</small></h3>" $page
expect "no title of a built-in system" grep -q "<h3 id=\"s1\">Chaplygin's symmetric sleigh, linear constraint " $page
expect "no title of a system file" grep -q '<h3 id="s4">friction on a line <small>line.yaml</small></h3>' $page
expect "no sizes and trends in words and colour" grep -q '<td class="trend kept" data-size="rounding" data-trend="[a-z ]*" data-value="[^"]*"><b>[^<]*</b><small>rounding' $page
expect "no title" grep -q '<h1 id="top">Three &amp; more</h1>' $page
# With both steps, from three starts: both methods go to the end, E of rk4 is not that small.
expect "no count of expectations" grep -q '<p>12 of 18 are met.</p>' $page
expect "no failed expectation" grep -q '<td>E</td><td>.*1e-30</td><td>.*<td class="large">not met' $page
expect "no path of the best run" grep -q '^plot' drawn/report/1-path.gp
expect "no column for each step" grep -q '<th scope="col" data-label="line.yaml" data-step="0.05" title="line.yaml: friction on a line">line<br><small>h = 0.05' $page
expect "no study file" grep -q 'integrators: \[rk4, gauss4, gauss4+project\]' $page
expect "no tables" grep -q 'What this shows' $page

case_is "the page is one file"
expect "it refers to others" sh -c "! grep -Eo '(src|href)=[\"'\''][^\"'\'']{0,20}' $page | grep -v '\"#'"
# The data of each of three systems with numbers and of each chart, the library and the script of the page.
figures=$(grep -c '<figure>' $page)
expect "other scripts" test "$(grep -c '<script type="application/json" class="data"' $page)" -eq 3 -a \
    "$(grep -c '<script' $page)" -eq $((figures + 5)) -a \
    "$(ls drawn/report/*.gp | wc -l)" -eq "$figures"
expect "its script is another" sh -c "grep -qxF \"systems.forEach(addMotions);\" $page"
expect "its script refers to others" sh -c "! grep -E '(fetch|import|XMLHttpRequest|WebSocket|url)\(' $page"
expect "no title of a figure" grep -q '<figcaption><strong>Energy, h = 0.1</strong>' $page
expect "no library of charts with its licence" sh -c "tr -d '\n' <$page | grep -q '/\* uPlot [0-9.]*A licence\*/function uPlot() {}</script>' &&
    grep -q '^.uplot {}' $page"

case_is "the page of a study says what explains a drift"
printf '%s\n' 'integrators: [gauss4+project, rk4]' 'step: 0.05' 'time: 100' 'systems: [chaplygin-sleigh]' >drift.yaml
try 0 study drift.yaml --no-page --output drift
try 0 report drift
expect "no command" grep -q '<code>dalembert explain chaplygin-sleigh --integrator rk4 --step 0.05 --time 100</code>' \
    drift/report/index.html
expect "no growth of a family" grep -q '<th scope="row">Runge-Kutta <small>1</small></th><td class="medium" title="rk4"><b>[1-9]e-[0-9]/</b>' \
    drift/report/index.html

# An error c h^4 is on a line of slope 4.
case_is "the order diagram holds the errors of the cells"
expect "points" sh -c "grep -A2 'curve1 <<' drawn/report/4-order.gp | tail -2 |
    awk -F, '{ x[NR] = log(\$1); y[NR] = log(\$2) }
        END { s = (y[2] - y[1])/(x[2] - x[1]); exit !(s > 3.8 && s < 4.2) }'"

case_is "the report of a run"
try 0 report ran
silent
expect "no path" grep -q '^plot' ran/report/path.gp
expect "no drift" grep -q '^plot' ran/report/drift.gp
expect "no trends" grep -q '<th scope="row">D1</th><td class="trend ' ran/report/index.html
# phi = t.
expect "no result" sh -c "sed -n '/<p class=.lead/,/<dl/p' ran/report/index.html | tr -d '\n' | grep -q \
    'chaplygin-sleigh by gauss4, h = 0.1, t = 0 .. 6.2[0-9]*</p>.*phi = 6.283</span>.*<table class=.verdicts.*>exact<'"
expect "no command" grep -q 'dalembert run chaplygin-sleigh --integrator gauss4 .*--set v0=0.1' \
    ran/report/index.html
# The sleigh goes round a circle of radius v0/omega = 0.1 about (0, 0.1).
expect "the path is no circle" sh -c "sed -n '/curve1 <</,/^END/p' ran/report/path.gp |
    awk -F, 'NF == 2 { r = \$1^2 + (\$2 - 0.1)^2; n += (r > 0.0099999 && r < 0.0100001) }
        END { exit n != 81 }'"
# Of the nine bodies the third has turned by a quarter: its bow, the first point, points to +y.
expect "the body is not turned" sh -c "sed -n '/curve2 <</,/^END/p' ran/report/path.gp |
    awk -F, 'BEGIN { RS = \"\" } NR == 5 { split(\$0, line, \"\\n\"); split(line[1], bow, \",\")
        exit !(bow[1] > 0.0999 && bow[1] < 0.1001 && bow[2] > 0.105) }'"
case_is "the page of a run says what moves and how"
cat >pulled.yaml <<'END_OF_SYSTEM'
title: A <weight> on a spring & a turn
coordinates: [x, phi, s]
parameters: {k: 1, m: 2}
let: {pull: k*cos(phi)}
lagrangian: m/2*(x'^2 + s'^2) + phi'^2/2 - k*x^2/2
constraints: [s' - sin(phi)*x']
forces: {x: -pull*x'}
start: {x: k}
END_OF_SYSTEM
try 0 run pulled.yaml --integrator rk4+project --step 0.1 --time 2 --set k=0.5 --start "phi'=3" \
    --output pulled
try 0 report pulled
for fact in "<h1 id=\"top\">A &lt;weight&gt; on a spring &amp; a turn</h1>" \
    "<mi>L</mi></mtd><mtd[^>]*><mo>=</mo><mfrac" "<msub><mi>D</mi><mn>1</mn></msub></mtd>" \
    "<msub><mi>Q</mi><mi>x</mi></msub></mtd><mtd[^>]*><mo>=</mo><mo>&#x2212;</mo><mi>k</mi>" \
    "<code>pull = k\*cos(phi)</code>" "<code>k = 0.5</code> instead of <code>1</code>" \
    "<code>m = 2</code>" "<code>x = k</code>, <code>phi' = 3</code>" \
    "<dd>rk4+project, order 4: classical Runge-Kutta; after each step" "<dt>step h</dt><dd>0.1</dd>" \
    "<dt>time T</dt><dd>2</dd>"; do
    expect "it lacks $fact" grep -q "$fact" pulled/report/index.html
done

# x = cos t; nothing else of this system is observed.
case_is "observed formulas on the page of a run"
printf 'coordinates: [x]\naccelerations: {x: -x}\nstart: {x: 1}\n' >swing.yaml
try 0 run swing.yaml --integrator gauss8 --step 0.05 --time 3 --samples 30 --output swing \
    --observe "x^2 + 3; 2 - hypot(x, x')"
try 0 report swing
expect "no values" sh -c "sed -n '/curve1 <</,/^END/p' swing/report/observed.gp |
    awk -F, 'NF == 2 { n++; bad += (\$2 - 3 - cos(\$1)^2)^2 > 1e-14 } END { exit bad || n != 31 }'"
expect "no values" sh -c "sed -n '/curve2 <</,/^END/p' swing/report/observed.gp |
    awk -F, 'NF == 2 { n++; bad += (\$2 - 1)^2 > 1e-14 } END { exit bad || n != 31 }'"
expect "no figure" grep -q '"title":"Observed formulas","x":"t","y":"value"' swing/report/index.html
expect "formulas are conserved" [ ! -e swing/report/drift.gp -a ! -e swing/report/I.gp ]

# Bounces at t_1 (1 + 2 c (1 - c^k)/(1 - c)), t_1 = sqrt(2/g), of a ball that moves along x with u.
case_is "events on the page of a run"
ball bounces.yaml 'when: x - 1.25, stop: true' 'when: x - 9, direction: up, set: {x: 0}'
times='function bounce(k) { return sqrt(2/9.81)*(1 + 2*0.8*(1 - 0.8^k)/0.2) }'
for sign in "" -; do
    rm -rf bounces
    try 0 run bounces.yaml --integrator gauss4 --step ${sign}0.01 --time ${sign}3 --set u=${sign}0.5 --output bounces
    try 0 report bounces
    for figure in coordinates E drift; do
        expect "$figure: other lines${sign:+, backwards}" awk "$times"'
            /^set arrow/ { t = $5 + 0; d = $5 < 0 ? -t : t; end += (d - 2.5)^2 < 1e-14
                for (k = 0; k < 5; k++) met += (d - bounce(k))^2 < 1e-14; lines++ }
            END { exit lines != 5 || met != 4 || end != 1 }' bounces/report/$figure.gp
    done
    expect "other rings${sign:+, backwards}" sh -c "sed -n '/curve3 <</,/^END/p' bounces/report/path.gp | awk -F, '$times
        NF == 2 { if ((\$1 - 0.5*bounce(rings++))^2 < 1e-14 && \$2^2 < 1e-14) met++ } END { exit rings != 5 || met != 4 }'"
    expect "what events change is drift${sign:+, backwards}" sh -c "sed -n '/curve1 <</,/^END/p' bounces/report/drift.gp |
        awk -F, 'NF == 2 { n++; if (\$2 > 1e-11) bad++ } END { exit bad || n < 1 }'"
    expect "E does not jump${sign:+, backwards}" sh -c "sed -n '/curve1 <</,/^END/p' bounces/report/E.gp |
        awk -F, 'NF == 2 { E = \$2 } END { exit (E - 9.81*(0.8^8 - 1))^2 > 1e-16 }'"
done
# With events between all rows.  A step of rk4 multiplies E by 1 - h^6/72 + h^8/576 and an impact by 0.9^2, the first
# after a quarter of a period; the last steps before impacts are shorter.
cat >kicked.yaml <<'END'
coordinates: [x]
lagrangian: (x'^2 - x^2)/2
start: {x: 1}
events: [{when: x, restitution: 0.9}]
END
try 0 run kicked.yaml --integrator rk4 --step 0.1 --time 40 --samples 8 --output kicked
try 0 report kicked
expect "another drift between events" sh -c "sed -n '/curve1 <</,/^END/p' kicked/report/drift.gp |
    awk -F, '\$1 + 0 > 39.9 { drift = \$2 } END { pi = atan2(0, -1); sum = pi/2; E = 1
        for (k = 1; k <= 13; k++) { E *= 0.81; sum += E*(k < 13 ? pi : 40 - 12.5*pi) }
        expected = (0.1^5/72 - 0.1^7/576)*sum/2; exit !(drift > 0.96*expected && drift < expected) }'"
for fact in '<th scope="row">event 1 (y)</th><td>impact</td><td>4</td>' \
    '<th scope="row">event 2 (x - 1.25)</th><td>stops the run</td><td>1</td><td>-2.5</td><td>-2.5</td>' \
    '<th scope="row">event 3 (x - 9)</th><td>sets values</td><td>0</td><td>–</td><td>–</td>' \
    '<p>event 2 (x - 1.25) stopped the run at t = -2.5</p>' 'Vertical lines mark events\.'; do
    expect "it lacks $fact" grep -q "$fact" bounces/report/index.html
done
printf '2,1,0' >>bounces/events.csv
try 0 report bounces
expect "half a line is an event" grep -q '<td>impact</td><td>4</td>' bounces/report/index.html
try 0 run bounces.yaml --integrator gauss4 --step 0.01 --time 2 --columns x,E --output bounces --force
try 0 report bounces
expect "no events of a run with few columns" grep -q '<td>impact</td><td>3</td>' bounces/report/index.html
sed 's/restitution: c/restitution: 1/' bounces.yaml >endless.yaml
# 443 of them, 0.9 apart, in 250 places of 1.6.
try 0 run endless.yaml --integrator gauss4 --step 0.01 --time 400 --set u=0 --output many-bounces
try 0 report many-bounces
expect "long lines at many events" sh -c "! grep -q 'graph 0 to' many-bounces/report/E.gp"
lines=$(grep -c '^set arrow.*graph 0.95 to' many-bounces/report/E.gp)
expect "not a line in each place" test "$lines" -ge 249 -a "$lines" -le 251

case_is "the page of a run that failed"
try 3 run pursuit --integrator rk4 --step 0.01 --time 10 --output aborted
try 0 report aborted
expect "no reason" grep -q '<strong>The run failed: constraint [12] becomes singular between t = 3\.' \
    aborted/report/index.html
try 3 run pursuit --integrator rk4 --step 0.01 --time 1000 --output alone
try 0 report alone
expect "figures of one row" sh -c "grep -q 'has one row' alone/report/index.html &&
    ! grep -q '<figure' alone/report/index.html"

case_is "angles and positions have axes of their own"
expect "other curves among the angles" test "$(sed -n 's/.*title [^a-z]\([a-z]*\)[^a-z].*/\1/p' pulled/report/angles.gp)" = phi
expect "other curves among the positions" test \
    "$(sed -n 's/.*title [^a-z]\([a-z]*\)[^a-z].*/\1/p' pulled/report/coordinates.gp | tr '\n' ' ')" = "x s "

# x = cos t: 16,000 rows in 637 half periods; rows a period apart, where x is 1 and x' is 0 but
# y = sin t is not at rest, and nothing between them is observed; and 64 rows in a period.
case_is "bands, dots and lines"
cat >round.yaml <<'END_OF_SYSTEM'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2 - x^2 - y^2)/2
start: {x: 1, y': 1}
END_OF_SYSTEM
try 0 run round.yaml --integrator gauss8 --step 0.125 --time 2000 --samples 16000 --output many
try 0 run round.yaml --integrator gauss8 --step 0.19634954084936207 --time 125.66370614359172 \
    --samples 20 --statistics 32 --output few
try 0 run round.yaml --integrator gauss8 --step 0.19634954084936207 --time 6.283185307179586 \
    --samples 32 --output enough
for run in many few enough; do try 0 report $run; done
expect "no band" grep -q 'curve1 using 1:2:3 with filledcurves' many/report/coordinates.gp
expect "the band is not from -1 to 1" sh -c "sed -n '/curve1 <</,/^END/p' many/report/coordinates.gp |
    awk -F, 'NF == 3 { n++; if (\$2 > -0.99 || \$2 < -1.0001 || \$3 < 0.99 || \$3 > 1.0001) bad++
        if (n == 1 && \$1 != 0) bad++; last = \$1 } END { exit bad || n < 20 || last != 2000 }'"
expect "a line through rows far apart" grep -q 'curve2 using 1:2 with points' few/report/coordinates.gp
expect "no line through rows close together" grep -q 'curve2 using 1:2 with lines' \
    enough/report/coordinates.gp

expect "a path through rows far apart" grep -q 'curve1 using 1:2 with points' few/report/path.gp
expect "no path through rows close together" grep -q 'curve1 using 1:2 with lines' enough/report/path.gp

# x = cos t has the value 1 at the rows, a period apart, and goes from -1 to 1 between them.
case_is "all steps of a run with few rows"
printf '%s\n' 'coordinates: [x]' "lagrangian: x'^2/2 - x^2/2" 'start: {x: 1}' 'invariants: {c: x}' >aliased.yaml
try 0 run aliased.yaml --integrator gauss8 --step 0.019634954084936207 --time 628.3185307179587 --samples 10 \
    --space physical --output aliased
try 0 report aliased
expect "the band is not from -2 to 0" sh -c "sed -n '/curve1 <</,/^END/p' aliased/report/I.gp | awk -F, 'NF == 3 {
    n++; if (\$2 < -2.0001 || \$2 > -1.999 || \$3 < -0.001 || \$3 > 0.0001) bad++; if (n == 1 && \$1 != 0) bad++; last = \$1 }
    END { exit bad || n < 20 || last < 628 || last > 629 }'"
expect "no number of steps" grep -q "title 'c (3.2e+04 steps)'" aliased/report/I.gp
printf x >>aliased/checkpoint
try 0 report aliased
silent
refute "a band by a damaged checkpoint" grep -q filledcurves aliased/report/I.gp

case_is "of many methods one of each family"
cat >families.yaml <<'END_OF_STUDY'
integrators: [symplectic-euler-10, stormer-verlet, dop853, rk4, gauss6, gauss4, spark2, dla, gni,
              discrete-gradient, gauss4+project, gauss4+yoshida6]
representatives: [gni, symplectic-euler-10, gauss6]
step: 0.1
time: 2
starts: physical
systems: [nonholonomic-particle]
END_OF_STUDY
try 0 study families.yaml --no-page --output families
try 0 report families
expect "other curves" test "$(sed -n 's/^ .*title [^a-z]\([^(]*\) (.*/\1/p' \
    families/report/1-D.gp | tr '\n' ,)" = \
    "Runge-Kutta: rk4,Gauss: gauss6,symplectic: symplectic-euler-10,constraint form: gni,projected: gauss4+project,energy-preserving: discrete-gradient,"

expect "no name in twelve letters" grep -q '<th scope="col" title="nonholonomic-particle">nonholonomic<' \
    families/report/index.html
# A method of a later version is of no family that this one knows.
sed -i 's/gauss6/gauss66/' families/cells.csv families/series/*.csv
try 0 report families
expect "no curve of a method that is not known" grep -q 'title .other: gauss66' families/report/1-D.gp

case_is "the report of orders"
try 0 order line.yaml --integrators rk4,gauss4,isokinetic-splitting --levels 3 --time 1 \
    --output orders
try 0 report orders
silent
expect "no row of a method" sh -c "grep '<th scope=\"row\">rk4</th><td>4</td>' \
    orders/report/index.html | grep -Eq '<td>(3.9|4.0)[0-9]</td>(<td>[0-9.]+e-[0-9]+</td>){3}<td>4\.0</td><td>[0-9.]+</td></tr>'"
expect "no reason" grep -q '<li>isokinetic-splitting: ' orders/report/index.html
for figure in order work time; do
    expect "no figure $figure" grep -q '^plot' orders/report/$figure.gp
done

# The directory is enough, wherever the system file has gone.
case_is "what orders were found with"
cp line.yaml moved.yaml
try 0 order moved.yaml --integrators rk4,gauss4 --levels 3 --step 0.2 --time 2 --set k=0.5 \
    --start "x'=3" --space lifted --output found
prints '^against gauss12 with h = 0\.025, itself within'
mv moved.yaml moved-back.yaml
rm -rf found/report
cp -r found wrong
sed -i 's/"k": *0\.5/"k": "0.5?"/' wrong/order.json
try 2 report wrong
says "k: '0.5\?' is not a number$"
rm -rf found/report
try 0 report found
for fact in "<h1 id=\"top\">friction on a line: order, work and precision</h1>" "<msub><mi>Q</mi><mi>x</mi></msub></mtd>" \
    "<code>k = 0.5</code> instead of <code>1</code>" "<code>x' = 3</code> instead of" \
    "<dt>time T</dt><dd>2</dd>" "<dt>space</dt><dd>lifted</dd>" \
    "at t = 2 from gauss12 with h = 0.025, itself within [0-9]e-1[0-9]</dd>"; do
    expect "it lacks $fact" grep -q "$fact" found/report/index.html
done
expect "defaults of the solver" sh -c "! grep -q '<dt>solver' found/report/index.html"
try 0 order moved-back.yaml --integrators rk4 --levels 2 --time 2 --set k=1.0 --output same
expect "the value of the file is not that" grep -q '<code>k = 1</code>' same/report/index.html
rm found/order.json found/order.yaml
try 0 report found
expect "no T from the table" grep -q '<dt>time T</dt><dd>2</dd>' found/report/index.html

# x = cos t crosses 0 at t = pi/2 downwards, at 3 pi/2 upwards, with x' = -1 and 1.
case_is "the report of a section"
try 0 section round.yaml --on x --integrator gauss8 --step 0.1 --time 20 --transient 3 \
    --axes "y,x'" --output cut
expect "no page after the command" grep -q '<figure' cut/report/index.html
rm -r cut/report
try 0 report cut
silent
prints '^cut/report/index.html$'
for fact in '<dt>section</dt><dd>x</dd>' '<dd>gauss8, order 8' '<dt>step h</dt><dd>0.1</dd>' \
    '<p class="lead">5 crossings: 3 upwards, 2 downwards, from t = 4.71239 to t = 17.2788.</p>'; do
    expect "it lacks $fact" grep -q "$fact" cut/report/index.html
done
expect "other crossings" sh -c "sed -n '/curve1 <</,/^END/p' cut/report/section.gp |
    awk -F, 'NF == 2 { n++; if ((\$1 + 1)^2 + (\$2 - 1)^2 > 1e-12) bad++ } END { exit bad || n != 3 }'"
rm cut/section.json
mkdir cut/section.json
try 4 report cut
says "cannot read 'cut/section.json': Is a directory"
rmdir cut/section.json
echo '{"version": "0.5.0"}' >cut/section.json
try 2 report cut
says "^dalembert: cut/section.json:1:1: there is no request$"
rm cut/section.json
try 0 report cut
expect "no figure of a table alone" grep -q '<figure' cut/report/index.html

case_is "the runs of a study are gone"
rm -rf drawn/runs
try 0 report drawn
silent

case_is "a column that is not finite everywhere"
cat >burst.yaml <<'END_OF_SYSTEM'
coordinates: [x]
lagrangian: x'^2/2
start: {x': 1}
invariants: {never: log(-1 - x^2), later: log(0.5 - x)}
END_OF_SYSTEM
try 0 run burst.yaml --integrator rk4 --step 0.1 --time 1 --output burst
try 0 report burst
expect "no figure of the others" grep -q '^plot' burst/report/coordinates.gp
# In the key: never has no value, E and H are 0.
expect "a slope of what has no value" grep -q "title 'never (not finite)'" burst/report/drift.gp
expect "a slope of 0" grep -q "title 'E (0)'" burst/report/drift.gp

# outline DIR EXPECTED...: the page of a directory is HTML, every element closed and known; EXPECTED are
# pieces of the list of its headings, terms and heads of columns, in their order.
outline() {
    directory=$1
    shift
    try 0 report "$directory"
    python3 "$here/page_outline.py" "$directory/report/index.html" >outline 2>&1
    status=$?
    expect "$directory: $(tail -1 outline)" [ $status -eq 0 ]
    heads=$(tr '\n' '|' <outline)
    for piece; do
        case "|$heads" in *"|$piece|"*) pass ;; *) fail "$directory: no $piece in $heads" ;; esac
    done
}
if needs 37 "no python3" there python3; then
    case_is "pages are HTML with the headings of their kind"
    try 0 order line.yaml --integrators rk4,gauss4 --levels 2 --time 1 --output outline-orders
    try 0 section chaplygin-sleigh-full-turn --on phi=1 --integrator rk4 --step 0.05 --time 20 --output outline-section
    try 0 ensemble knife-edge --members 20 --seed 1 --vary "x'=normal(0,0.1)" --integrator rk4 --step 0.1 --time 2 \
        --output outline-ensemble
    printf '%s\n' 'title: t' 'integrators: [rk4, gauss4]' 'step: 0.1' 'time: 2' 'systems: [knife-edge]' \
        'expect: {knife-edge: {rk4: {state: done}}}' >outline.yaml
    try 0 study outline.yaml --output outline-study
    try 0 run chaplygin-sleigh --integrator gauss4 --step 0.1 --time 6 --samples 40 --output outline-run
    outline outline-run \
        'dt system|dt equations|dt parameters|dt start|dt source|dt method|dt step h|dt time T|dt samples' \
        'h2 Size and trend|th size, trend|th confidence|th first|th final|th max |x||th max |x − first|' \
        'th rate|th rate, from|th to (95 %)|th exponent|th D1|th E|th H' \
        'h2 Figures|h2 How to make it again|summary what it was made with: manifest.json'
    outline outline-orders 'h1 friction on a line: order, work and precision' 'dt space|dt error' \
        'th order, stated|th order, found' 'th evaluations of F a step|th µs a step|th rk4|th gauss4' \
        'h2 Figures|summary what it was made with: order.json'
    outline outline-section 'h2 Figure|dt system' 'dt section|summary what it was made with: section.json'
    outline outline-ensemble 'h1 Knife edge on an inclined plane|h2 Statistics at t = 2|th column|th count|th mean' \
        'dt members|dt seed|dt added to each' \
        'th deviation|th min|th q0.05|th q0.25|th q0.5|th q0.75|th q0.95|th max' 'h2 Clouds|h2 Histograms' \
        'summary members that failed: failures.csv|summary what it was made with: manifest.json'
    outline outline-study 'h3 Constraints: max |D|' 'h3 Energy: max |E − E(0)|' \
        'h3 Invariants of the systems: max |I − I(0)|, the largest of each' \
        'h3 Hamiltonian of the lift: max |H − H(0)|, started off p = π = 0' \
        'h2 Expectations|summary all of them|th system|th integrator|th start|th h|th quantity|th expected|th found' \
        'h2 How to make it again|summary study.yaml|summary what it was made with: manifest.json|summary the tables: tables.txt'
    counted
fi

case_is "no library of charts"
rm -rf ran/report
DALEMBERT_UPLOT=/nonexistent try 0 report ran
silent
expect "no tables" grep -q '<th scope="row">D1</th>' ran/report/index.html
expect "no word of it" test "$(grep -c 'This page has tables and no charts: uPlot 1.6.32, which draws them, was not found' ran/report/index.html)" -eq 1
refute "figures" grep -q '<figure' ran/report/index.html
expect "no scripts" test -s ran/report/path.gp -a -s ran/report/drift.gp
unset DALEMBERT_UPLOT
mkdir -p home/data/dalembert
XDG_DATA_HOME=$PWD/home/data HOME=$PWD/home try 0 report ran
cp -r "$top/charts" home/data/dalembert/uplot
XDG_DATA_HOME=$PWD/home/data try 0 report ran
expect "it is not found in XDG_DATA_HOME" grep -q '<figure' ran/report/index.html
mkdir -p home/.local/share
mv home/data/dalembert home/.local/share
XDG_DATA_HOME='' HOME=$PWD/home try 0 report ran
expect "it is not found in HOME" grep -q '<figure' ran/report/index.html
DALEMBERT_UPLOT=$top/charts
export DALEMBERT_UPLOT

case_is "figures for papers"
PATH=/nonexistent "$program" report ran --svg >out 2>err
status=$?
expect "exit $status, not 4" test $status -eq 4
says '^dalembert: gnuplot is not installed'
expect "it is said more than once" test "$(grep -c gnuplot err)" -eq 1
# A name with all that TeX does not set as itself; letters by name and with digits are symbols.
printf '%s\n' 'coordinates: [theta1, x_y]' "lagrangian: (theta1'^2 + x_y'^2)/2" "start: {theta1': 1}" \
    'invariants: {"a_b": x_y}' >symbols.yaml
try 0 run symbols.yaml --integrator rk4 --step 0.1 --time 1 --output symbols --observe 'theta1^2; x_y*2'
if needs 12 "no gnuplot" there gnuplot; then
    try 0 report symbols --svg
    silent
    expect "no picture of 3.4 inches" grep -q 'viewBox="0 0 326 ' symbols/report/angles.svg
    try 0 report symbols --pdf
    silent
    expect "no picture" sh -c "head -c 5 symbols/report/angles.pdf | grep -q %PDF- && test ! -e symbols/report/angles.svg"
    expect "no labels of TeX" grep -Fq '$\theta_{1}$' symbols/report/angles.tex
    expect "an index that is none" grep -Fq 'x\_y' symbols/report/coordinates.tex
    expect "a power without an escape" grep -Fq '$\theta_{1}$\textasciicircum{}2' symbols/report/observed.tex
    if needs 3 "no pdflatex" there pdflatex; then
        case_is "labels that TeX sets"
        # Of the study too, whose labels have quotes, < and >.
        try 0 report drawn --pdf
        { printf '%s\n' '\documentclass{article}' '\usepackage{graphicx,color}' '\begin{document}'
          printf '\\input{%s}\n' symbols/report/*.tex drawn/report/*.tex
          printf '%s\n' '\end{document}'; } >paper.tex
        expect "TeX fails" env TEXINPUTS=symbols/report:drawn/report: pdflatex -interaction=nonstopmode -halt-on-error paper.tex
        expect "no pages" sh -c "head -c 5 paper.pdf | grep -q %PDF-"
        counted
    fi
    counted
fi
