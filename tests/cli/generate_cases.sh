# `dalembert generate`: files that compile without a warning wherever there is a compiler, and whose
# programs end in the very digits of `dalembert run`.

cat >drive.c <<'END'
#include "g.c"
#include <stdio.h>
int main(void)
{
    static g_state s;
    if (g_start(&s, 0) || g_advance(&s, 0.0625, 30) || g_advance(&s, 0.0625, 70)) return 1;
    printf("%.17g", g_time(&s, 0));
    for (int i = 0; i < g_DIMENSION; i++) {
        for (int lane = 1; lane < g_LANES; lane++)
            if (s.y[i * g_LANES + lane] != s.y[i * g_LANES]) return 2;
        printf(",%.17g", s.y[i * g_LANES]);
    }
    double out[g_OBSERVABLES * g_LANES + 1];
    g_observe(&s, out);
    for (int i = 0; i < g_OBSERVABLES; i++)
        if (g_observable[i][0] != '|') printf(",%.17g", out[i * g_LANES]);
    return printf("\n") < 0;
}
END
case_is "each option of a run that a file can have"
for option in "--from 1" "--set k=2" "--start x=1" "--space lifted" "--solver newton" "--iterations 9" \
    "--extend-energy off" "--reactions off" "--consistent on" "--lanes 2" "--prefix h"; do
    try 0 generate line.yaml --integrator gauss4 $option
done
try 0 generate line.yaml --integrator dop853 --tolerance 1e-9
try 0 generate plane.yaml --integrator gauss4 --reactions on

strict="-Wall -Wextra -Wpedantic -Werror -Wno-psabi"
# Compilers read the same file whether or not the program that wrote it has sanitizers.
if sanitized; then compiles=false; else compiles=true; fi
# same SYSTEM INTEGRATOR SPACE LANES COMPILER FLAGS...
same() {
    system=$1 method=$2 space=$3 lanes=$4 compiler=$5
    shift 5
    case_is "$system $method $space, $lanes lanes, $compiler $*"
    try 0 generate "$system" --integrator "$method" --space "$space" --lanes "$lanes" $control \
        --prefix g -o g.c
    silent
    empty
    try 0 run "$system" --integrator "$method" --space "$space" --step 0.0625 --time 6.25 --samples 1 \
        $control
    sed -n '3p' out >interpreted.csv
    $compiles || return 0
    needs 2 "no $compiler" there "$compiler" || return 0
    expect "it does not compile: $(cat cc.log)" sh -c \
        "$compiler $* $strict drive.c -o driven -lm >cc.log 2>&1"
    ./driven >generated.csv
    expect "other digits: $(cat generated.csv) not $(cat interpreted.csv)" \
        cmp -s generated.csv interpreted.csv
    counted
}
: >cc.log
control=
same chaplygin-sleigh rk4 physical 1 gcc -std=c11 -O3 -march=native
same chaplygin-sleigh symplectic-euler-00 lifted 4 clang -std=c11 -O1 -march=native
same contact-oscillator rk4 lifted 8 g++ -x c++ -std=c++17 -O2
same contact-oscillator implicit-midpoint+project physical 1 clang++ -x c++ -std=c++17 -O2
same nonholonomic-particle stormer-verlet+project lifted 1 gcc -std=c11 -O1
same isokinetic gauss4 lifted 1 clang -std=c11 -O1 -march=native
control="--effort constraint --start pi_y1=0.4"
same chaplygin-sleigh gauss4 lifted 1 gcc -std=c11 -O2 -march=native
same chaplygin-sleigh stormer-verlet lifted 4 clang -std=c11 -O1 -march=native
same chaplygin-sleigh taylor lifted 1 g++ -x c++ -std=c++17 -O1
control=
same chaplygin-sleigh-vakonomic gauss6 physical 2 gcc -std=c11 -O1
same appell-hamel symplectic-euler-11 physical 16 gcc -std=c11 -O1 -march=native
same vertical-disk rk4+project physical 1 gcc -std=c11 -Os -ffreestanding
same chaplygin-sleigh-friction symplectic-euler-01 lifted 1 gcc -std=c11 -O0
same contact-oscillator stormer-verlet+yoshida4+project lifted 4 gcc -std=c11 -O1
same nonholonomic-particle implicit-midpoint+sofroniou10 lifted 1 gcc -std=c11 -O2
same knife-edge bm6 lifted 2 gcc -std=c11 -O1
same isokinetic lobatto6 lifted 2 gcc -std=c11 -O1
same contact-oscillator rk4+lift lifted 2 gcc -std=c11 -O1
same knife-edge dop853 lifted 1 clang -std=c11 -O1
control="--tolerance 1e-17"
same knife-edge dop853 lifted 1 gcc -std=c11 -O2
same knife-edge dop853 physical 8 g++ -x c++ -std=c++17 -O1 -march=native
control=
same appell-hamel gni physical 4 gcc -std=c11 -O2
same vertical-disk mclachlan-perlmutter physical 1 clang -std=c11 -O1
same isokinetic isokinetic-splitting physical 4 gcc -std=c11 -O1
same contact-oscillator discrete-gradient+project physical 1 gcc -std=c11 -O2 -march=native
same appell-hamel dla physical 8 gcc -std=c11 -O1
same vertical-disk spark4 physical 1 gcc -std=c11 -O1
same chaplygin-sleigh lobatto-nonholonomic6 physical 2 clang -std=c11 -O1
same contact-oscillator gauss-spark4 physical 1 g++ -x c++ -std=c++17 -O1
same damped-oscillator spark2 physical 1 gcc -std=c11 -O1

cat >bead.yaml <<'END'
coordinates: [x, y, z, u]
parameters: {w: 1.5}
lagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2 - z
constraints: [u' - 0.5*x' - 0.1*y'^2]
holonomic: [x^2 + y^2 + z^2 - 1, y*cos(w*t) - x*sin(w*t)]
start: {x: 0.6, z: -0.8, x': 0.4, y': 0.9, solve: [z', u']}
END
same bead.yaml rattle+suzuki4 physical 4 gcc -std=c11 -O1 -march=native
same bead.yaml gauss-spark2 physical 1 g++ -x c++ -std=c++17 -O2
same bead.yaml gauss-spark6 physical 2 clang -std=c11 -O1
same bead.yaml gauss4+symmetric-project physical 1 gcc -std=c11 -O1

# Every function with branches, and a start where each takes both of its branches along the motion.
cat >branches.yaml <<'END'
coordinates: [x, y]
parameters: {k: 3}
lagrangian: (x'^2 + y'^2)/2 - k/2*max(x, 0)^2 - min(x, 0)^2 - y^2
forces:
  x: "-sign(x')*0.1 + floor(2*y)/8 + if(y > 0, sqrt(y), -1)*x'"
  y: hypot(x, y)/4 - 0.1*(x <= y) + (x == y) - 0.05*abs(y')
start: {x: 1, y': 1}
END
same branches.yaml rk4 physical 1 gcc -std=c11 -O2 -march=native
same branches.yaml gauss4 lifted 8 gcc -std=c11 -O2
same branches.yaml stormer-verlet lifted 4 clang -std=c11 -O1 -march=native

# Tables of the time and of the state, with their derivatives, over many of their pieces.
cat >tables.yaml <<'END'
coordinates: [x, y]
files: {"f.csv": "u,f,g\n-4,1,0\n-1,0.5,1\n-0.25,0,2\n0.5,0.25,1\n1.5,1,0\n4,2,3\n7,1,1\n"}
tables:
  f: {file: f.csv, at: u, value: f, interpolation: cubic, extend: linear}
  g: {file: f.csv, at: u, value: g, extend: constant}
lagrangian: (x'^2 + y'^2)/2 - f(x)*(1 + y^2) - y^2
forces: {x: g(t)/4 - 0.1*x', y: -g(y)*y'/8}
start: {x: 1, y': 1}
END
same tables.yaml rk4 physical 1 gcc -std=c11 -O2 -march=native
same tables.yaml gauss4 lifted 4 gcc -std=c11 -O1 -march=native
same tables.yaml rk4 physical 8 clang -std=c11 -O1


# What a microcontroller must supply.
if needs 4 "no gcc" there gcc; then
    case_is "only libm and memcpy, memset are needed"
    try 0 generate isokinetic --integrator gauss4+project --prefix g -o g.c
    expect "it does not compile" gcc -std=c11 -Os -ffreestanding $strict -c g.c -o g.o
    expect "it needs $(nm -u g.o | tr -d '\n')" test -z "$(nm -u g.o | awk '{ print $2 }' |
        grep -Evx 'memcpy|memset|sin|cos|tan|exp|log|pow|a?sinh?|a?cosh?|a?tanh?|atan2|sqrt|fabs|fma')"
    case_is "declarations alone"
    printf '#define g_HEADER\n#include "g.c"\nint main(void) { return g_LANES - 1; }\n' >head.c
    expect "it is more than declarations" sh -c "gcc -std=c11 $strict head.c -o head && ./head"
    counted
fi

# Names and texts that are C to C.
cat >hostile.yaml <<'END'
title: "evil */ int x; /* \\ ??/ #error"
coordinates: [num, out]
parameters: {int: 1, INFINITY: 2, M_PI: 3, step: 1}
lagrangian: int*(num'^2 + out'^2)/2 - INFINITY*num^2/2 - M_PI*out^2/2
constraints: [num' - step*out']
start: {num: 1, out: 1}
END
same hostile.yaml rk4 physical 1 gcc -std=c11 -O1
same hostile.yaml rk4 physical 1 g++ -x c++ -std=c++17 -O1
case_is "defaults from the command line"
try 0 generate line.yaml --integrator rk4 --set k=0.5 --start "x'=3" --prefix g -o -
prints '^    p.k = 0x1p-1;$'
prints '^    y\[1\] = dal_num\(3.0\);$'

case_is "errors of generate"
table <<'END'
2 | generate | says the SYSTEM is missing
2 | generate line.yaml | says --integrator is missing
2 | generate line.yaml --integrator rk4 --lanes 3 | says 3 lanes
END
try 2 generate line.yaml --integrator rk4 --lanes 99
table <<'END'
2 | generate line.yaml --integrator rk4 --prefix '9x' | says does not begin with a letter
2 | generate line.yaml --integrator rk4 --prefix 'a;b' | says not a C name
2 | generate line.yaml --integrator rk5 | says did you mean 'rk4'
END
try 2 generate line.yaml --integrator rk4 --set K=1
try 2 generate chaplygin-sleigh-vakonomic --integrator rk4 --space lifted
try 4 generate line.yaml --integrator rk4 -o nowhere/at/all.c
says 'nowhere/at/all.c'
empty

case_is "no room for a file"
(
    ulimit -f 4
    exec "$program" generate knife-edge --integrator rk4 -o large.c 2>err
)
expect "exit 4" [ $? -eq 4 ]
says "cannot write 'large.c': File too large"

# Functions of a point, against the formulas by hand: F = a + R l, a = (0, -1, 0), R = W^-1 A^T, A F + dA/dt v = 0.
cat >blade.yaml <<'END'
coordinates: [x, y, phi]
parameters: {m: 2, J: 5, a: 0.5}
lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 - m*y
constraints: [x'*sin(phi) - y'*cos(phi) + a*phi']
END
cat >points.c <<'END'
#include "g.c"
#include <stdio.h>
enum { L = g_LANES };
static int wrong;
static void near(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance)) wrong = printf("%.17g, not %.17g\n", found, expected);
}
static void field(const double *q, const double *v, double m, double *F)
{
    const double A[3] = {sin(q[2]), -cos(q[2]), 0.5}, w[3] = {m, m, 5};
    const double c = (v[0] * cos(q[2]) + v[1] * sin(q[2])) * v[2];
    double G = 0;
    for (int i = 0; i < 3; i++) G += A[i] * A[i] / w[i];
    for (int i = 0; i < 3; i++) F[i] = (i == 1 ? -1 : 0) - A[i] / w[i] * (c - A[1]) / G;
}
int main(void)
{
    static g_state s;
    g_parameters p = g_defaults();
    double q[3 * L], v[3 * L], F[3 * L], J[18 * L], C[7 * L], E[10 * L];
    if (g_start(&s, &p)) return 2;
    p.m = 3;
    g_set(&s, L - 1, &p);
    for (int i = 0; i < 3 * L; i++) q[i] = sin(1 + i), v[i] = cos(2 + i);
    if (g_field(&s, 0, q, v, F) || g_jacobian(&s, 0, q, v, J) || g_constraint(&s, 0, q, v, C) || g_energy(&s, 0, q, v, E))
        return 3;
    for (int l = 0; l < L; l++) {
        const double m = l == L - 1 ? 3 : 2, h = 1e-4, w[3] = {m, m, 5};
        double z[6], expected[3], above[3], below[3];
        for (int i = 0; i < 3; i++) z[i] = q[i * L + l], z[3 + i] = v[i * L + l];
        const double A[3] = {sin(z[2]), -cos(z[2]), 0.5};
        field(z, z + 3, m, expected);
        near(C[l], A[0] * z[3] + A[1] * z[4] + A[2] * z[5], 1e-14);
        near(E[l], m * (z[3] * z[3] + z[4] * z[4]) / 2 + 2.5 * z[5] * z[5] + m * z[1], 1e-13);
        for (int i = 0; i < 3; i++) {
            near(F[i * L + l], expected[i], 1e-13);
            near(C[(1 + i) * L + l], A[i], 1e-15);
            near(C[(4 + i) * L + l], A[i] / w[i], 1e-15);
            near(E[(1 + i) * L + l], i == 1 ? m : 0, 1e-15);
            near(E[(4 + i) * L + l], w[i] * z[3 + i], 1e-14);
            near(E[(7 + i) * L + l], i == 1 ? 1 : 0, 1e-15);
        }
        for (int k = 0; k < 6; k++) {
            const double x = z[k];
            z[k] = x + h, field(z, z + 3, m, above);
            z[k] = x - h, field(z, z + 3, m, below);
            z[k] = x;
            for (int i = 0; i < 3; i++)
                near(J[(k < 3 ? 3 * i + k : 9 + 3 * i + k - 3) * L + l], (above[i] - below[i]) / (2 * h), 1e-6);
        }
    }
    q[0] = NAN;
    for (int i = 0; i < 3; i++) v[i * L] = NAN;
    if (g_field(&s, 0, q, v, F) != DAL_STATUS_NOT_FINITE) wrong = 1;
    return wrong != 0;
}
END
for way in "rk4 physical 1" "gauss4+project lifted 1" "gauss4 physical 4" "rk4 lifted 8"; do
    case_is "functions of a point: $way lanes"
    needs 5 "no gcc" there gcc || continue
    set -- $way
    try 0 generate blade.yaml --integrator "$1" --space "$2" --lanes "$3" --prefix g --with field -o g.c
    silent
    empty
    expect "it does not compile: $(cat cc.log)" sh -c "gcc -std=c11 -O1 $strict points.c -o points -lm >cc.log 2>&1"
    expect "other numbers" ./points
    counted
done
# W U = A^T for the columns U that a file finds by solutions, where U has far more numbers than A
cat >mesh.yaml <<'END'
sizes: {N: 36}
coordinates: ["x[1..N]"]
lagrangian: sum(i, 1, N, x[i]'^2)/2 + sum(i, 1, N-1, cos(x[i])*x[i]'*x[i+1]')/4
constraints: [{for: i = 1..N-2, is: "x[i+1]' - sin(x[i])*x[i+2]'/2"}]
END
cat >columns.c <<'END'
#include "g.c"
enum { L = g_LANES, N = 36, M = N - 2 };
int main(void)
{
    static g_state s;
    static double q[N * L], v[N * L], C[(M + 2 * M * N) * L];
    g_parameters p = g_defaults();
    double worst = 0;
    for (int i = 0; i < N * L; i++) q[i] = sin(1 + i), v[i] = cos(2 + i);
    if (g_start(&s, &p) || g_constraint(&s, 0, q, v, C)) return 2;
    for (int l = 0; l < L; l++)
        for (int a = 0; a < M; a++)
            for (int i = 0; i < N; i++) {
                const double *U = C + (M + M * N + a) * L + l, *A = C + (M + a * N) * L + l;
                const double left = i > 0 ? cos(q[(i - 1) * L + l]) / 4 * U[(i - 1) * M * L] : 0;
                const double right = i + 1 < N ? cos(q[i * L + l]) / 4 * U[(i + 1) * M * L] : 0;
                const double expected = i == a + 1 ? 1 : i == a + 2 ? -sin(q[a * L + l]) / 2 : 0;
                worst = fmax(worst, fabs(left + U[i * M * L] + right - expected));
                worst = fmax(worst, fabs(A[i * L] - expected));
            }
    return !(worst < 1e-14);
}
END
case_is "directions by columns"
if needs 3 "no gcc" there gcc; then
    try 0 generate mesh.yaml --integrator rk4+project --space physical --lanes 2 --prefix g --with field -o g.c
    expect "it does not compile: $(cat cc.log)" sh -c "gcc -std=c11 -O0 $strict columns.c -o columns -lm >cc.log 2>&1"
    expect "other numbers" ./columns
    counted
fi
case_is "functions of a point in C++, and where the system has no constraints and no energy"
if needs 6 "no g++" there g++; then
    try 0 generate blade.yaml --integrator dop853 --tolerance 1e-9 --space physical --lanes 2 --prefix g --with field -o g.c
    expect "it does not compile" g++ -x c++ -std=c++17 -O1 $strict points.c -o points -lm
    expect "other numbers" ./points
    printf 'coordinates: [x]\naccelerations: {x: -x}\n' >bare.yaml
    try 0 generate bare.yaml --integrator rk4 --prefix g --with field -o g.c
    expect "it has a constraint" sh -c "! grep -q g_constraint g.c && ! grep -q g_energy g.c && grep -q g_jacobian g.c"
    expect "it does not compile" g++ -x c++ -std=c++17 -O1 $strict drive.c -o drive -lm
    counted
fi
case_is "without --with field they are not there"
try 0 generate blade.yaml --integrator rk4 --prefix g -o -
expect "it has them" sh -c '! grep -q g_jacobian out'
try 2 generate blade.yaml --integrator rk4 --with jacobian
says "--with"
