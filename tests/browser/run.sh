#!/bin/sh
# run.sh PROGRAM - the pages of `dalembert report` and of the bench in headless Chromium: in light
# and dark, 1280 and 400 pixels wide, nothing is cut off, covered or too faint; page.js examines each
# page from inside.
# script.py then uses them: keys, clicks and the pointer; versions.py uses the choice of versions of the site.
# A program that has sanitizers makes the same pages; cli/report_cases.sh makes some with it.
case $1 in /*) program=$1 ;; *) program=$PWD/$1 ;; esac
case $CFLAGS in *-fsanitize*) echo "browser: 32 pages and the script are skipped: their program has sanitizers" && exit ;; esac
here=$(cd "$(dirname "$0")" && pwd)
for browser in chromium chromium-browser google-chrome; do
    command -v $browser >/dev/null 2>&1 && break
    browser=
done
skip_without() {
    echo "browser: 32 pages and the script are skipped: no $1"
    [ "${CI:-}" != true ]
    exit
}
[ -n "$browser" ] || skip_without chromium
[ -s "${DALEMBERT_UPLOT:-/usr/local/share/dalembert/uplot}/uPlot.iife.min.js" ] ||
    skip_without 'uPlot (tools/prepare.sh)'
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

cat >page.yaml <<'END_OF_STUDY'
title: Appearance of a report
integrators: [all, rk4+project]
step: [0.1, 0.05]
time: 4
expect: {chaplygin-sleigh: {rk4: {D: rounding, state: done}}}
systems:
  - chaplygin-sleigh
  - {system: nonholonomic-particle, label: "a label <that> is \"rather\" long, and has words in it"}
  - {system: damped-oscillator, integrators: [rk4, symplectic-euler-11], step: 0.5, time: 40}
END_OF_STUDY
cat >box.yaml <<'END_OF_SYSTEM'
coordinates: [a]
lagrangian: a'^2/2
start: {a': 1}
picture: {x: 0, y: 0, wz: a', body: box}
END_OF_SYSTEM
{
    "$program" study page.yaml --output study || [ $? -eq 1 ]
    "$program" report study/runs/chaplygin-sleigh_rk4+project_physical_0.1
    "$program" report study
    "$program" run snakeboard --integrator gauss4 --step 0.05 --time 5 --output run
    "$program" report run
    "$program" order chaplygin-sleigh --levels 3 --time 2 --output orders
    "$program" section pendulum-cvt --on "sin(xi)" --integrator gni --step 0.1 --time 200 --output cut
    "$program" ensemble knife-edge --members 50 --seed 1 --vary "x'=normal(0,0.1)" --integrator rk4 --step 0.1 --times 1,2 \
        --output members
    "$program" run pursuit --integrator rk4 --step 0.01 --time 10 --output failed || [ $? -eq 3 ]
    "$program" report failed
    "$program" run pendulum-cvt --integrator gni --step 0.1 --time 2000 --samples 5000 --output bands
    "$program" report bands
    "$program" run falling-disk --integrator gauss8 --step 0.05 --time 5 --output disk
    "$program" report disk
    "$program" run damped-oscillator --integrator gauss4 --step 0.05 --time 5 --output single
    "$program" report single
    "$program" run box.yaml --integrator gauss4 --step 0.01 --time 1.5707963267948966 --output box
    "$program" report box
    "$program" run pendulum-cvt --integrator gni --step 0.1 --time 2000 --samples 50 --output few
    "$program" report few
    "$program" run chaplygin-sleigh --integrator rk4 --step 0.2 --time 5 --output sleigh
    "$program" report sleigh
    "$program" run "$here/../../examples/ball-on-incline.yaml" --output bounces
    "$program" report bounces
    "${program%/*}/bench/page" bench "$here/bench.jsonl"
} >log 2>&1 || { cat log; exit 1; }

pages='study run orders cut failed bands bounces bench'
# Each page with the script in it, in a frame of each width; the frames send home what they find.
for page in $pages; do
    { cat $page/report/index.html; echo '<script>'; cat "$here/page.js"; echo '</script>'; } >$page.html
done
cat >frames.html <<END_OF_PAGE
<body><pre id="found">found:
</pre><script>
addEventListener('message', e => found.textContent += e.data + '\n');
for (const page of '$pages'.split(' '))
    for (const width of [1280, 400]) {
        const frame = document.createElement('iframe');
        frame.src = page + '.html#' + page + ',' + width;
        frame.style = 'width: ' + width + 'px; height: 900px; border: 0';
        document.body.append(frame);
    }
</script></body>
END_OF_PAGE

failed=0
for scheme in light dark; do
    dark=$([ $scheme = dark ] && echo 0 || echo 1)
    timeout --foreground ${PATIENCE:-600} $browser --headless --no-sandbox --disable-gpu --disable-background-networking \
        --user-data-dir="$work/profile" --blink-settings=preferredColorScheme=$dark \
        --window-size=1400,1000 --virtual-time-budget=60000 --dump-dom "file://$work/frames.html" \
        >dom 2>messages
    examined=$(grep -c "^examined: $scheme," dom)
    faults=$(grep -c '^fault:' dom)
    grep '^fault:' dom | head -20
    [ "$examined" -eq 16 ] || { echo "browser: $examined of 16 pages were examined"; head -5 messages; }
    [ "$examined" -eq 16 ] && [ "$faults" -eq 0 ] || failed=1
    sed -n "s/^examined: /browser: /p" dom
done
if command -v python3 >/dev/null 2>&1; then
    timeout --foreground ${PATIENCE:-600} python3 "$here/script.py" $browser "$work" "$here/../../docs/gallery" || failed=1
    timeout --foreground ${PATIENCE:-600} python3 "$here/versions.py" $browser "$work/versions" || failed=1
else
    echo "browser: the script is skipped: no python3"
    [ "${CI:-}" != true ] || failed=1
fi
[ $failed -eq 0 ] && echo "browser: ok"
exit $failed
