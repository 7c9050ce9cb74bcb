# Equations as MathML: XML, with the structure of formulas that are known.

case_is "the equations of every system"
"$program" list systems --markdown | sed -n 's/^| `\([a-z-]*\)` .*/\1/p' >systems
mkdir systems.mathml
while read -r system; do
    try 0 check "$system" --mathml
    cp out "systems.mathml/$system"
done <systems

case_is "arguments"
table <<'END'
2 | check chaplygin-sleigh --mathml --json | says --mathml excludes --json and --details
2 | check chaplygin-sleigh --mathml --latex | says --latex excludes --mathml
2 | check skate --mathml | says skate
END

case_is "brackets that are nested too deeply"
awk 'BEGIN {
    printf "coordinates: [x]\naccelerations: {x: \""
    for (i = 0; i < 500; i++) printf "sin(x + "
    printf "1"
    for (i = 0; i < 500; i++) printf ")"
    print "\"}\nstart: {x: 0.1}" }' >deep.yaml
try 0 check deep.yaml --latex
try 2 check deep.yaml --mathml
says '^dalembert: deep.yaml: .*too large'

case_is "names are no markup"
for name in '<script>' 'a&b' 'x"y' '&lt;'; do
    printf 'coordinates: ["%s"]\nlagrangian: 1\n' "$name" | sed 's/x"y/x\\"y/' >hostile.yaml
    try 2 check hostile.yaml --mathml
    empty
done

# equation LINE: the equations that were read have this line, among others.
equation() { expect "no equation $1" grep -Fqx -- "$1" rows; }
# accelerated FORMULA ROW: x'' = FORMULA is typeset so.
accelerated() {
    printf 'coordinates: [x, y]\nparameters: {a: 2}\naccelerations:\n  x: "%s"\n  y: 0\nstart: {x: 0.4, y: 0.7}\n' \
        "$1" >formula.yaml
    try 0 check formula.yaml --mathml
    python3 "$here/read_mathml.py" out >rows
    equation "ddot(x)=F_x =$2"
}

if needs 35 "no python3" there python3; then
    case_is "every system is XML"
    expect "not well-formed" python3 "$here/read_mathml.py" systems.mathml/*

    case_is "equations that are known"
    cat >hand.yaml <<'END'
coordinates: [phi, x12]
parameters: {m_ball: 2, k_1: 3}
lagrangian: m_ball/2*(phi'^2 + x12'^2)
forces: {phi: -k_1*phi'}
constraints: [phi'*sin(x12)^2 - x12']
start: {x12: 1, solve: [x12']}
END
    try 0 check hand.yaml --mathml
    python3 "$here/read_mathml.py" out >rows
    equation 'L =frac(1; 2)*m_ball*(dot(φ)^2+dot(x)_12^2)'
    equation 'Q_φ =-k_1*dot(φ)'
    equation 'D_1 =dot(φ)*sin^2@(x_12)-dot(x)_12=0'
    expect "no H" grep -q '^H =frac({π_φ^2+π_x_12^2}; {2\*e})+π_φ\*F_φ+' rows

    # g is the parameter; C and h are the columns C1 and h1.  h = (2 g y - 2 (x'^2 + y'^2))/(4 l^2) on C = 0.
    case_is "a holonomic constraint and its multiplier"
    cat >swing.yaml <<'END'
coordinates: [x, y]
parameters: {l: 2, g: 9.81}
lagrangian: (x'^2 + y'^2)/2 - g*y
holonomic: [x^2 + y^2 - l^2]
start: {y: -2}
END
    try 0 check swing.yaml --mathml
    python3 "$here/read_mathml.py" out >rows
    equation 'C_1 =x^2+y^2-l^2=0'
    equation 'D_1=frac(d; {dt})*C_1 =2*(dot(x)*x+dot(y)*y)=0'
    expect "no multiplier" grep -q '^h_1 =frac(' rows

    case_is "formulas that are known"
    accelerated "x/(y + 1)" 'frac(x; {1+y})'
    accelerated "(x + y)^3" '{(x+y)}^3'
    accelerated "sqrt(1 + x)" 'sqrt(1+x)'
    accelerated "abs(x - y)" '|x-y|'
    accelerated "floor(x/y)" '⌊frac(x; y)⌋'
    accelerated "atan2(x, y)" 'atan2@(x,y)'
    accelerated "if(x < y, 1, a)" '{[1, if x<y | a, else]'
    accelerated "if(x <= y, 1, a)" '{[1, if x<=y | a, else]'
    accelerated "x + 6.25e-12" '6.25*10^{-12}+x'
    accelerated "x*pi/3" 'frac(π; 3)*x'
    accelerated "exp(x) - asinh(y)" 'exp@(x)-arsinh@(y)'

    case_is "tables and letters that the theory has, too"
    printf 't,f\n0,0\n1,1\n2,4\n' >f.csv
    cat >table.yaml <<'END'
coordinates: [x]
parameters: {L: 2, F_0: 1}
tables:
  f: {file: f.csv, at: t, value: f, extend: linear}
lagrangian: L*x'^2/2 - F_0*f(x)
start: {x: 1}
END
    try 0 check table.yaml --mathml
    python3 "$here/read_mathml.py" out >rows
    equation 'ℒ =frac(1; 2)*dot(x)^2*L-F_0*f@(x)'
    equation "ddot(x)=ℱ_x =-frac(1; L)*F_0*f^'@(x)"
    counted
fi
