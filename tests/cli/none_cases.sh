# Cells without a value are empty, in every CSV file.

# cell FILE HEAD TEXT...: the cells of a column in the rows that have all TEXTs.
cell() {
    head -1 "$1" >chosen
    table=$1 head=$2
    shift 2
    sed 1d "$table" >>chosen
    for text; do awk -v text="$text" 'NR == 1 || index($0, text)' chosen >fewer && mv fewer chosen; done
    column "$head" chosen
}
# are_all PATTERN FILE HEADS TEXT...: all cells of these columns in those rows, of which there are
# some, match the pattern.
are_all() {
    pattern=$1 table=$2 heads=$3
    shift 3
    for name in $heads; do
        cell $table $name "$@" >cells
        expect "$table: $name: $*" test -s cells -a "$(grep -cvE "$pattern" cells)" -eq 0
    done
}
is_empty() { are_all '^$' "$@"; }
has_values() { are_all '^-?[0-9.e+-]+$|^[0-9a-f]{16}$' "$@"; }

case_is "no value: cells of a study"
cat >some.yaml <<'END2'
integrators: [rk4, gni]
step: [0.1, 0.5]
time: 2
starts: [physical, surface]
systems: [{system: plane.yaml, label: plane}, {system: line.yaml, label: line}]
END2
try 0 study some.yaml --output some
reached="reached steps evaluations bits"
is_empty some/cells.csv "$reached D_max E_first run" gni,surface refused
has_values some/cells.csv "$reached E_first seconds" rk4
expect "seconds of no run" sh -c '! grep refused some/cells.csv | grep -qv "physical space\",$"'
is_empty some/cells.csv "D_max D_rate" line rk4
has_values some/cells.csv "D_max D_rate" plane rk4
is_empty some/cells.csv "H_first p_max" rk4,physical
has_values some/cells.csv "H_first p_max" rk4,surface

case_is "no value: parts of the time"
is_empty some/series/line.csv D rk4
is_empty some/series/plane.csv "invariants error" rk4
is_empty some/series/plane.csv "H p pi" rk4,physical
# Five rows within a hundred parts
for quantity in D E H pi; do
    cell some/series/plane.csv $quantity rk4,surface,0.5 >cells
    expect "$quantity: parts without rows" test "$(grep -c . cells)" -eq 5 -a "$(wc -l <cells)" -gt 80
done
refute "nan" grep -r --include=*.csv nan some
case_is "no value: an envelope over parts without rows"
printf '%s\n' 'integrators: implicit-midpoint' 'step: 0.5' 'time: 20' 'starts: physical' \
    'systems: {system: pendulum-cvt, label: cvt}' >swings.yaml
try 0 study swings.yaml --output swings
try 0 report swings
sed -n '/^\$curve1/,/^END/p' swings/report/1-E.gp | grep , >envelope
expect "it is no maximum" awk -F, '$2 < max { bad = 1 } { max = $2 } END { exit bad || NR < 4 }' envelope
