#!/bin/sh
# gallery.sh PROGRAM DIR - the pictures of the README and of docs/, as SVG in DIR: figures of the
# reports of a study, bench/studies/gallery.yaml, of three runs, a section, and of the study and the run of the
# tutorial, the action, predictions, and the chain of Dirac's procedure (dot).  NAME_motion.svg moves (python3).
# The same machine draws the same bytes.
set -e
case $1 in /*) program=$1 ;; *) program=$PWD/$1 ;; esac
command -v gnuplot >/dev/null 2>&1 || { echo "gallery: gnuplot is not installed"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
gallery=$2
mkdir -p "$gallery"

"$program" study bench/studies/gallery.yaml --no-page --output "$work/study" >/dev/null
"$program" run falling-disk --integrator gauss8 --step 0.01 --time 20 --samples 400 --output "$work/disk"
"$program" run snakeboard --integrator gauss8 --step 0.01 --time 12 --samples 240 --output "$work/board"
"$program" run chaplygin-sleigh-incline --integrator gauss8 --step 0.01 --time 13 --samples 400 \
    --output "$work/sleigh"
"$program" steer chaplygin-sleigh --to y1=0,y2=1,phi=0 --rest --time 2 --integrator gauss8 --step 0.02 \
    --effort constraint --output "$work/parking" >/dev/null
"$program" steer examples/actuated-snakeboard.yaml --to x=2,y=0.5,theta=0,phi=0.6 --rest --effort controls \
    --output "$work/steered" >/dev/null
"$program" steer examples/elastica.yaml --to x=0.5,y=0,theta=0 --starts 6 --output "$work/rod" >/dev/null
"$program" section pendulum-cvt --on "sin(xi)" --direction up --integrator gni --step 0.1 \
    --time 1000 --axes "x,x'" --output "$work/section" 2>/dev/null
top=$PWD
cd "$work"
awk -f "$top/tools/yaml_blocks.awk" "$top/docs/tutorial.md"
"$program" study mine.yaml --no-page --output skate-study >/dev/null
"$program" run skate.yaml --integrator spark4 --step 0.05 --time 60 --samples 1200 --output skate
cd "$top"
for directory in study disk board sleigh parking steered rod section skate skate-study; do
    "$program" report "$work/$directory" --svg >/dev/null
done
# picture DIRECTORY FIGURE NAME
picture() { awk -f tools/dark_svg.awk "$work/$1/report/$2.svg" >"$gallery/$3.svg"; }
picture study 1-E drift
picture study 2-work work
picture disk path disk
picture board path board
picture section section section
picture skate path skate_path
picture skate-study 1-D skate_constraint
picture skate-study 1-E skate_energy
moves() { python3 tools/motion-svg.py "$work/$1/report/index.html" "$2" >"$3"; }
moves disk "A disk rolls along a ring and leans to and fro" "$2/disk_motion.svg"
moves board "A snakeboard glides and turns its axles" "$2/board_motion.svg"
moves sleigh "A sleigh slides down a slope, turns in a cusp and goes on" "$2/sleigh_motion.svg"
moves parking "A sleigh parks a length beside where it stood, with two cusps" "$2/parking_motion.svg"
moves steered "A snakeboard turns its rotor and its axles, and so moves from rest to rest" "$2/steered_board_motion.svg"
moves rod "A point runs along a bent rod, whose ends point in one direction" "$2/elastica_motion.svg"
# The action of the sleigh's motion against a perturbation.
for h in 0.1 0.05 0.025; do
    "$program" run chaplygin-sleigh --integrator gauss8 --step $h --time 5 --samples "$(awk "BEGIN { print 5 / $h }")" \
        --output "$work/curve.csv"
    for A in 1e-5 3e-5 1e-4 3e-4 1e-3 3e-3 1e-2 3e-2 1e-1; do
        "$program" action chaplygin-sleigh "$work/curve.csv" --perturb $A --json |
            awk -v A=$A -F'[:,}]' '/"nh10"/ { print A, $8 }'
    done >"$work/action-$h"
done
gnuplot <<END
set terminal svg size 420,280 dynamic font 'sans,12'
set output '$work/action.svg'
set logscale
set format '10^{%T}'
set key left top
set xlabel 'size A of the perturbation'
set ylabel 'action (nh10)'
plot for [h in '0.1 0.05 0.025'] '$work/action-'.h using 1:2 with linespoints title 'h = '.h
END
# The energy of the driven transmission, predicted and measured.
for h in 0.1 0.05; do
    "$program" predict pendulum-cvt --integrator rk4 --step $h --time 200 --samples 400 --output - |
        awk -F, 'NR > 1 { print $3, $5 }' >"$work/predicted-$h"
    "$program" run pendulum-cvt --integrator rk4 --step $h --time 200 --samples 40 --columns E --output - |
        awk -F, 'NR == 2 { first = $2 } NR > 1 { print $1, $2 - first }' >"$work/run-$h"
done
gnuplot <<END
set terminal svg size 420,280 dynamic font 'sans,12'
set output '$work/predict.svg'
set format y '%.0e'
set key left bottom
set xlabel 't'
set ylabel 'E(t) - E(0)'
plot for [h in '0.1 0.05'] '$work/predicted-'.h using 1:2 with lines title 'h = '.h.', predicted', \
     for [h in '0.1 0.05'] '$work/run-'.h using 1:2 with points pt 6 ps 0.5 title 'run'
END
for name in action predict; do
    awk -f tools/dark_svg.awk "$work/$name.svg" >"$2/$name.svg"
done
"$program" dirac chaplygin-sleigh --json >"$work/dirac.json"
python3 tools/dirac-svg.py "$work/dirac.json" | awk -f tools/dark_svg.awk >"$2/dirac.svg"
ls -l "$2"/*.svg | awk '{ print "gallery: " $9 ", " $5 " bytes" }'
