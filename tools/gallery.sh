#!/bin/sh
# gallery.sh PROGRAM DIR - the pictures that the README shows, as SVG in DIR: figures of the report
# of a study, bench/studies/gallery.yaml, and of two runs.  The same machine draws the same bytes.
set -e
case $1 in /*) program=$1 ;; *) program=$PWD/$1 ;; esac
command -v gnuplot >/dev/null 2>&1 || { echo "gallery: gnuplot is not installed"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$2"

"$program" study bench/studies/gallery.yaml --output "$work/study" >/dev/null
"$program" run falling-disk --integrator gauss8 --step 0.01 --time 20 --samples 400 --output "$work/disk"
"$program" run snakeboard --integrator gauss8 --step 0.01 --time 12 --samples 240 --output "$work/board"
for directory in study disk board; do
    "$program" report "$work/$directory" >/dev/null
done
cp "$work/study/report/transmission-E.svg" "$2/drift.svg"
cp "$work/study/report/sleigh-work.svg" "$2/work.svg"
cp "$work/disk/report/path.svg" "$2/disk.svg"
cp "$work/board/report/path.svg" "$2/board.svg"
ls -l "$2"/*.svg | awk '{ print "gallery: " $9 ", " $5 " bytes" }'
