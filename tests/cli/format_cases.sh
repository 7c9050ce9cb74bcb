# Tables for a document: --format latex, markdown and csv.

# latex_is_whole: what `out` has is comments and one tabular whose rows have as many cells as it has columns.
latex_is_whole() {
    expect "no whole tabular" awk '
        /^%/ { next }
        /^\\begin\{tabular\}/ { columns = length($0) - length("\\begin{tabular}{}"); begun++; next }
        /^\\end\{tabular\}$/ { ended++; next }
        /^  \\hline$/ { rules++; next }
        { rows++; if (gsub(/ & /, "") != columns - 1 || !/ \\\\$/) bad++ }
        END { exit !(begun == 1 && ended == 1 && rules == 3 && rows > 1 && !bad) }' out
}
# markdown_is_whole: every line of the table has as many bars as the first one.
markdown_is_whole() {
    expect "no whole table" awk '/^\|/ { gsub(/\\\|/, ""); n = gsub(/\|/, ""); rows++
            if (!bars) bars = n
            if (n != bars) bad++ }
        END { exit !(rows > 2 && !bad) }' out
}

case_is "format: a run"
run="run chaplygin-sleigh --integrator rk4 --step 0.05 --time 1000"
try 0 $run --format latex
latex_is_whole
# The exponent of a number in words stays; the exponent of a cell is a power of 10.
prints '^  D1 & linear & grows like t: 5\.2e-8 per unit of time, 5\.2e-5 so far'
prints 'grows like t\\textasciicircum\{\}2'
prints '\$\|\$p\$\|\$'
expect "rows" test "$(grep -c '^t,' out)" -eq 0
try 0 $run --format markdown
markdown_is_whole
try 0 $run --format csv
prints '^"quantity","trend",""$'
prints '^"D1","linear","grows like t: 5\.2e-8 '
try 0 $run --format csv -o rows.csv
prints '^"D1","linear",'
expect "no rows" has_lines rows.csv 102

case_is "format: orders"
order="order damped-oscillator --integrators rk4,gauss4,gauss6 --levels 3 --threads 1"
try 0 $order --format latex
latex_is_whole
prints '^  integrator & order & order found & error at h = 0\.05 '
prints '^  gauss6 & \$6\$ & '
expect "no power of 10" grep -Eq '\$[0-9.]+ \\cdot 10\^\{-[0-9]+\}\$' out
try 0 $order --format markdown
markdown_is_whole
prints '^\| integrator \| order \| order found \| error at h = 0\.05 \|'
try 0 $order --format csv
expect "columns" test "$(awk -F, '{ print NF }' out | sort -u)" = 8
expect "numbers in quotes" awk -F, 'NR > 1 { for (i = 2; i <= NF; i++) if ($i ~ /"[0-9]/) exit 1 }' out

case_is "format: exponents, volume, error sources"
for command in "lyapunov damped-oscillator --time 5" "volume damped-oscillator --time 5" \
    "explain chaplygin-sleigh --integrator rk4 --step 0.1 --time 2"; do
    try 0 $command --format latex
    latex_is_whole
    try 0 $command --format markdown
    markdown_is_whole
    try 0 $command --format csv
    expect "no table of $command" awk -F'","|",|,"' 'NR == 1 { n = NF } NF < 2 { exit 1 } END { exit n < 2 || NR < 2 }' out
done

case_is "format: a study, with all of its methods and systems"
cat >many.yaml <<'END'
title: "50 % of a_b & c^d {e} ~f \\g #h $i <j> |k|"
systems:
  - {system: chaplygin-sleigh, label: "a_b & c"}
  - {system: knife-edge, label: "50 % |k| `x`"}
  - chaplygin-sleigh-nonlinear
  - contact-oscillator
  - nonholonomic-particle
  - vertical-disk
integrators: [rk4, gauss4, gauss6, gauss8, lobatto4, spark2, spark4, gni, implicit-midpoint, bm4, mclachlan4,
  rk4+project, gauss4+project, gauss6+project, gauss8+project, lobatto4+project, stormer-verlet]
step: 0.1
time: 1
END
try 0 study many.yaml -o many --no-page --format latex
latex_is_whole
for method in rk4 spark2 stormer-verlet "lobatto4+project"; do
    expect "no row of $method" grep -q "^  $method & " out
done
prints '& a\\_b \\& c & a\\_b \\& c &'
prints '& \$50\$ \\% \$\|\$k\$\|\$ `x` &'
prints '^% 50 % of a_b & c\^d'
prints '^% ok: rounding, / grows like t'
expect "D and E of six systems" test "$(sed -n 's/.*begin{tabular}{\(.*\)}/\1/p' out)" = lllllllllllll
try 0 resume many --no-page --format markdown
markdown_is_whole
prints '50 % \\\|k\\\| \\`x\\` D'
try 0 resume many --no-page --format csv
expect "17 methods" has_lines out 18

case_is "format: what it excludes"
table <<'END'
2 | order damped-oscillator --format latex --json | says --format excludes --json
2 | order damped-oscillator --format latex --details | says --format excludes --details
2 | lyapunov damped-oscillator --format csv --json | says --format excludes --json
2 | explain damped-oscillator --format csv --details | says --format excludes --details
2 | run damped-oscillator --format csv --details | says --format excludes --details
2 | lyapunov damped-oscillator --format csv --details | says --format excludes --details
2 | explain damped-oscillator --format csv --json | says --format excludes --json
2 | predict damped-oscillator --format csv --json | says --format excludes --json
2 | predict damped-oscillator --format csv --details | says --format excludes --details
2 | run damped-oscillator --format csv -o - | says --format: standard output has the rows
2 | run damped-oscillator --format tex | says --format: 'tex' is not one of text.latex.markdown.csv
END
