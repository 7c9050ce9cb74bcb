# The outlines of bodies in the picture of a path: each body at rest at (1, 2) under the angle 0.5,
# drawn at scale 1, turned back into its own frame, heading along x.

# lines FILE [CURVE]: the points of a curve of a gnuplot script, an empty line between polylines.
lines() { awk -v name="\$curve${2:-2}" '$1 == name && $2 == "<<" { on = 1; next } $1 == "END" { on = 0 } on' "$1"; }
# frame FILE: the first body, "x y" to three digits, one polyline a line.
frame() {
    lines "$1" | awk -F, 'BEGIN { c = cos(0.5); s = sin(0.5) }
        function digits(x) { x = sprintf("%.3f", x); return x == "-0.000" ? "0.000" : x }
        NF < 2 { if (line != "") print line; line = ""; next }
        { x = $1 - 1; y = $2 - 2
          line = line (line == "" ? "" : " ") digits(c*x + s*y) "," digits(c*y - s*x) }
        END { if (line != "") print line }' | awk '{ if (NR > 1 && $0 == first) exit
            if (NR == 1) first = $0; print }'
}
# draws BODY: makes its picture; the outline goes to "outline".
draws() {
    printf 'coordinates: [x, y]\naccelerations: {x: 0, y: 0}\nstart: {x: 1, y: 2}
picture: {x: x, y: y, angle: 0.5, steer: 0.3, width: 0.4, body: %s}\n' "$1" >body.yaml
    rm -rf still
    try 0 run ./body.yaml --integrator rk4 --step 0.1 --time 1 --output still
    try 0 report still
    frame still/report/path.gp >outline
    expect "no title" grep -q "'Path of the $1'" still/report/path.gp
}
# is_outline LINE...: the polylines of the body, no more and no less.
is_outline() {
    printf '%s\n' "$@" >wanted
    expect "another outline: $(tr '\n' ';' <outline)" cmp outline wanted
}
# is_ellipse A B: the first polyline is closed, of 33 points on (x/A)^2 + (y/B)^2 = 1, once round.
is_ellipse() {
    expect "no ellipse" awk -v a="$1" -v b="$2" 'NR == 1 {
        for (i = 1; i <= NF; i++) {
            split($i, p, ",")
            if ((p[1]/a)^2 + (p[2]/b)^2 > 1.02 || (p[1]/a)^2 + (p[2]/b)^2 < 0.98) exit 1
            if (p[1] > right) right = p[1]
            if (p[2] > top) top = p[2]
            if (p[1] < left) left = p[1]
            if (p[2] < bottom) bottom = p[2]
        }
        exit !(NF == 33 && $1 == $NF && right == a && left == -a && top == b && bottom == -b)
    }' outline
}

case_is "a blade: its edge and an arrow"
draws blade
is_outline '-1.000,0.000 1.000,0.000' '0.500,0.300 1.000,0.000 0.500,-0.300'

case_is "a sleigh: its hull and the blade in its middle"
draws sleigh
is_outline '1.200,0.000 0.400,0.550 -0.900,0.550 -0.900,-0.550 0.400,-0.550 1.200,0.000' \
    '-0.500,0.000 0.500,0.000'

case_is "a disk: as wide as width says, with its axle"
draws disk
is_ellipse 1 0.4
expect "no axle" test "$(tail -n +2 outline)" = '0.000,-0.350 0.000,0.350'

case_is "a ball: a circle"
draws ball
is_ellipse 0.7 0.7
expect "more than that" test "$(wc -l <outline)" -eq 1

case_is "a robot: a circle and its direction"
draws robot
is_ellipse 0.9 0.9
expect "no front" test "$(tail -n +2 outline)" = '0.000,0.000 0.900,0.000'

# Axles of half length 0.45, wheels of half length 0.3.  Turned by 0.3 about (1, 0), the axle
# ends at (1 -+ 0.45 sin 0.3, +-0.45 cos 0.3), a wheel reaches 0.3 (cos 0.3, sin 0.3) from there;
# about (-1, 0) the turn is -0.3.
case_is "a board: its axles turn against each other"
draws board
is_outline '-1.000,0.000 1.000,0.000' \
    '0.867,0.430 1.133,-0.430' '0.580,0.341 1.154,0.519' '0.846,-0.519 1.420,-0.341' \
    '-0.867,0.430 -1.133,-0.430' '-1.154,0.519 -0.580,0.341' '-1.420,-0.341 -0.846,-0.519'

# The arm, 0.7 long, turns by 0.3 about (1.2, 0) with the axle at its end.
case_is "a racer: its arm turns"
draws racer
is_outline '0.000,0.000 1.200,0.000' '1.200,0.000 1.869,0.207' \
    '0.000,0.450 0.000,-0.450' '-0.300,0.450 0.300,0.450' '-0.300,-0.450 0.300,-0.450' \
    '1.736,0.637 2.002,-0.223' '1.449,0.548 2.022,0.725' '1.715,-0.312 2.288,-0.134'

# From 0 to 10 along x, a body is 0.55 long on either side: circles of radius 0.385 at nine
# instants, 1.25 apart.
case_is "nine bodies along a path, as large as suits it"
printf 'coordinates: [x]\naccelerations: {x: 0}\nstart: {x'"'"': 1}
picture: {x: x, y: 3, body: ball}\n' >moving.yaml
rm -rf moving
try 0 run ./moving.yaml --integrator rk4 --step 0.1 --time 10 --samples 80 --output moving
try 0 report moving
lines moving/report/path.gp | awk -F, 'NF < 2 { next }
    { d = ($1 - 1.25*int(n / 33))^2 + ($2 - 3)^2; n++
      if (d > 0.1484 || d < 0.1481) { n = 0; exit } }
    END { exit n != 9*33 }'
expect "other circles" test $? -eq 0
lines moving/report/path.gp 1 >way
expect "not from (0, 3) to (10, 3)" test "$(sed -n '1p; $p' way | tr '\n' ' ')" = "0,3 10,3 "

# x = t passes 5 once and never reaches 50; curves are the path, the bodies and the rings.
case_is "rings where events happened, and no curve where none did"
for place in 5 50; do
    { cat moving.yaml && printf 'events: [{when: x - %s}]\n' $place; } >passing.yaml
    rm -rf passing
    try 0 run ./passing.yaml --integrator rk4 --step 0.1 --time 10 --samples 80 --output passing
    try 0 report passing
    curves=2
    [ $place -eq 50 ] || curves=3
    expect "curves with an event at $place" test "$(grep -c '^$curve[0-9]* <<' passing/report/path.gp)" -eq $curves
    [ $place -eq 50 ] || expect "other rings" test "$(lines passing/report/path.gp 3)" = 5,3
done
