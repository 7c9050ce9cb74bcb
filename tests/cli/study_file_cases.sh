# Study files: lists, ranges and draws, expectations, and the messages about bad ones.

labels() { column label there/cells.csv | uniq | tr '\n' ' '; }
common='integrators: rk4\nstep: 0.5\ntime: 1\nstarts: physical\n'

case_is "every combination of values"
printf "$common"'systems:
  - system: line.yaml
    label: line
    set: {k: {from: 1, to: 2, count: 3}}
    start: {x: [0, 3], "x'"'"'": 2}
' >values.yaml
try 0 study values.yaml --output there --force
silent
expect "labels: $(labels)" test "$(labels)" = \
    "line_k=1_x=0 line_k=1_x=3 line_k=1.5_x=0 line_k=1.5_x=3 line_k=2_x=0 line_k=2_x=3 "
# c = x' + k x at the start
first_c=$(awk -F, '$5 == "c" { printf "%s ", $6 }' there/quantities.csv)
expect "c: $first_c" test "$first_c" = "2 5 2 6.5 2 8 "

case_is "seeds, lists and methods that cannot be, whether they matter or not"
for seeds in hello '[]' '[[1]]' '[1, [2]]' '{between: [0, 1]}' '[-1]' 1.5; do
    bad "${common}seeds: $seeds\nsystems: [line.yaml]\n" '^dalembert: bad\.yaml:[0-9]+:[0-9]+: .*'
    bad "${common}systems: [{system: line.yaml, seeds: $seeds}]\n" '^dalembert: bad\.yaml:[0-9]+:[0-9]+: '
done
for line in 'integrators: []' 'integrators: [[rk4]]' 'step: [[0.1]]' 'step: []' 'starts: []' \
    'starts: [[physical]]' 'systems: []' 'systems: [[line.yaml]]' 'options: []' 'set: [1]' \
    'start: [1]' 'displace: [1]' 'samples: [1, 2]' 'time: [1]' 'title: [a]' 'expect: [1]' \
    'expect: {line.yaml: [1]}' 'expect: {line.yaml: {rk4: [1]}}' 'expect: {line.yaml: {rk4: {x*z: {final: exact}}}}'; do
    key=${line%%:*}
    printf "$common"'systems: [line.yaml]\n' | grep -v "^$key:" >bad.yaml
    echo "$line" >>bad.yaml
    try 2 study bad.yaml --output there --force
    says "^dalembert: bad\.yaml:[0-9]+:[0-9]+: "
    expect "more is printed than what is wrong first" test "$(wc -l <err)" -eq 1
done
for modifier in project project-energy symmetric-project; do
    try 2 run chaplygin-sleigh --integrator implicit-midpoint+$modifier+$modifier --step 0.1 --time 1
    says "\+$modifier comes twice"
done
bad 'integrators: rk4+project+project\nstep: 0.5\ntime: 1\nsystems: [line.yaml]\n' 'comes twice'

case_is "names that no directory can have"
long=$(awk 'BEGIN { for (i = 0; i < 5000; i++) printf "x" }')
rm -rf there
bad "${common}systems: [{system: line.yaml, label: $long}]\n" 'too long a name for a directory'
expect "a directory was made" [ ! -e there ]
middle=$(awk 'BEGIN { for (i = 0; i < 235; i++) printf "x" }')
bad "${common}systems: [{system: line.yaml, label: $middle, set: {k: [1, 2.5]}}]\n" \
    'too long a name for a directory'
try 2 run line.yaml --integrator rk4 --step 0.1 --time 1 --output "$long"
try 2 run line.yaml --integrator rk4 --step 0.1 --time 1 --output "$long.csv"
try 2 run "$long.yaml" --integrator rk4 --step 0.1 --time 1
try 2 study "$long.yaml"
try 2 study line.yaml --output "$long"
try 2 resume "$long"
try 2 report "$long"
try 2 generate line.yaml --integrator rk4 -o "$long.c"

case_is "ranges"
printf 'integrators: rk4\nstep: {from: 0.5, to: 0.1, by: -0.2}\ntime: 1\nstarts: physical\n'"
systems: [{system: line.yaml, set: {k: {from: 0, to: 0.3, by: 0.1}}}]\n" >ranges.yaml
try 0 study ranges.yaml --output there --force
steps=$(column step there/cells.csv | sort -u | awk '{ printf "%.3g ", $1 }')
expect "steps $steps" test "$steps" = "0.1 0.3 0.5 "
expect "labels $(labels)" test "$(labels)" = \
    "line.yaml_k=0 line.yaml_k=0.1 line.yaml_k=0.2 line.yaml_k=0.3 "

case_is "quantities are observed in every step, or every K-th"
cat >swing.yaml <<'END2'
coordinates: [x]
lagrangian: x'^2/2 - x^2/2
start: {x': 1}
invariants: {seen: x}
END2
# |x| = |sin t| is 1 within half a step of pi/2 and 0 at both rows; at steps 0, 314, 628 it is below
# 2e-3.  (x is no invariant: it is called one to be observed.)
printf 'integrators: gauss4\nstep: 0.01\ntime: 6.28\nsamples: 1\nstarts: physical
systems: [{system: swing.yaml, label: each}, {system: swing.yaml, label: few, statistics: 314}]
expect:
  each: {gauss4: {seen: {max: {at least: 0.99998, at most: 1}, final: {at most: 0}}}}
  few: {gauss4: {seen: {max: {at most: 4e-3}}}}\n' >observed.yaml
try 0 study observed.yaml --output there --force
expect "not 2 rows" test "$(od -An -c -N 512 there/runs/each_gauss4_physical_0.01/trajectory.npy |
    tr -d ' \n' | grep -c "(2,)")" -eq 1

case_is "draws"
# 1 + u with SplitMix64 as study_values.c has it, computed elsewhere: x' = 1.2850.. and 1.4568..
printf "${common}seeds: [1, 7]\nsystems: [{system: line.yaml, start: {x': {between: [1, 2]}}}]\n" \
    >draws.yaml
try 0 study draws.yaml --output there --force
expect "labels $(labels)" test "$(labels)" = "line.yaml_seed=1 line.yaml_seed=7 "
E_first=$(column E_first there/cells.csv | tr '\n' ' ')
expect "E(0) = $E_first" test "$E_first" = "0.82568526102259454 1.061239195889158 "
# Drawn off x' = y', brought back along the mass metric: both become the mean.
printf "${common}seeds: 7\nsystems: [{system: plane.yaml, start: {x': {between: [0, 1]}}}]\n" \
    >projected.yaml
try 0 study projected.yaml --output there --force
E_first=$(column E_first there/cells.csv)
expect "E(0) = $E_first" awk "BEGIN { exit !($E_first - 0.53061959794457902 < 4e-16 && 0.53061959794457902 - $E_first < 4e-16) }"

# x (x' - 1) restricts nothing at x = 0.
printf '%s\n' 'coordinates: [x, y]' "lagrangian: (x'^2 + y'^2)/2" "constraints: [x*(x' - 1)]" "start: {x': 1}" >loose.yaml
bad "${common}seeds: 7\nsystems: [{system: loose.yaml, start: {y: {between: [1, 2]}}}]\n" \
    '^dalembert: bad.yaml:6:[0-9]+: loose.yaml_seed=7: no start on D = 0 was found: constraint 1 restricts no velocity'

case_is "more rows than memory is taken for"
bad 'integrators: rk4\nstep: 0.5\ntime: 1e9\nsamples: 5e8\nstarts: physical\nsystems: [line.yaml]\n' \
    '^dalembert: --samples: 500000000 are too many for --sampling steps$'
expect "more messages" test "$(wc -l <err)" -eq 1

case_is "statements that hold, and that do not"
expecting() {
    printf 'integrators: [rk4, gauss4]\nstep: 0.01\ntime: 3\nstarts: physical\nsystems:
  - {system: appell-hamel, set: {w0: -1}}
  - {system: line.yaml, label: line, set: {k: [1, 2]}}
expect:\n'"$1" >expect.yaml
}
expecting '  line: {all: {c: {max: {at most: 2}, final: {at least: 0.9}}, E: {at least: 0.4}}}
  line_k=1: {rk4: {error: {at most: 1e-6}, c: [exact, rounding], state: done}}
  appell-hamel: {rk4: {state: failed, D: aborted}, gauss4: {D1: aborted}}\n'
try 0 study expect.yaml --output there --force
prints '^Expectations: 18 of 18 are met\.$'
expect "18 rows and a head" test "$(wc -l <there/expectations.csv)" -eq 19
expect "another head" test "$(head -1 there/expectations.csv)" = \
    label,integrator,start,step,quantity,expected,found,met
expect "all met" test "$(column met there/expectations.csv | sort -u)" = yes
# E of x' = exp(-t) falls from 1/2 to exp(-6)/2: by 0.49876
expecting '  line_k=1: {rk4: {E: {deviation: {at most: 0.4987}, final: {at least: 0.01}}, c: power law}}
  appell-hamel: {all: {state: [failed, refused]}}\n'
try 1 study expect.yaml --output there --force --tables
prints '^Expectations: 2 of 5 are met\.$'
prints '^  line_k=1 .* rk4 .* E: expected deviation <= 0\.4987, found 0\.499 \(line 9\)$'
prints '^  line_k=1 .* E: expected final >= 0\.01, found 0\.00124 \(line 9\)$'
prints '^  line_k=1 .* c: expected power law, found none \(line 9\)$'
expect "three not met" test "$(column met there/expectations.csv | grep -c no)" -eq 3
expect "the table is not kept" grep -q '^Expectations: 2 of 5' there/tables.txt
# A failure that nobody expected counts for more.
expecting '  line: {rk4: {c: exponential}}\n'
try 3 study expect.yaml --output there --force

case_is "what failed, was aborted or refused meets no size, trend or bound"
# The field x'' = x^3 is infinite in a finite time; sqrt(0.5 - x) is not a number once x > 1/2.
cat >burst.yaml <<'END2'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2 + x^4/4
constraints: [y']
start: {x: 1, x': 1}
invariants: {still: y}
END2
printf 'integrators: [rk4, gauss4, gni]\nstep: 0.5\ntime: 100\nstarts: physical\nsystems:
  - {system: burst.yaml, label: burst}
  - {system: line.yaml, label: line}
expect:
  burst: {rk4: {still: [exact, rounding, larger], D: {max: {at most: 1}}, E: rounding},
          gauss4: {still: [none, undecided], E: {deviation: {at least: 0}}}, gni: {state: failed, D: aborted}}
  line: {rk4: {"sqrt(0.5 - x)": {max: {at least: 0}}, c: [exact, rounding]},
         gauss4: {"sqrt(0.5 - x)": aborted, c: [exact, rounding]}, gni: {state: [done, refused]}}\n' >lost.yaml
try 3 study lost.yaml --output there --force --tables --no-page
prints '^Expectations: 6 of 12 are met; 5 failed, 1 aborted\.$'
prints '^  burst +rk4 .* still: expected exact or rounding or larger, found failed '
prints '^  burst +rk4 .* D: expected max <= 1, found failed '
prints '^  burst +gauss4 .* E: expected deviation >= 0, found failed '
prints '^  line +rk4 .* sqrt\(0\.5 - x\): expected max >= 0, found aborted '
try 3 study lost.yaml --output there --force --no-page
prints '^Expectations: 6 of 12 are met; 5 failed, 1 aborted\.$'
prints '^D in 3 runs: 3 failed\.$'
prints '^0 of 3 integrators keep D at rounding in every run, 3 failed\.$'
prints '^0 of [34] integrators keep E within 1 % on D = 0, 3 failed\.$'
expect "a failure is met" sh -c "! grep 'failed' there/expectations.csv | grep -v state | grep -q yes"
# A method that the system refuses is no run: it is counted, but not compared.
printf 'integrators: [gauss4, gni]\nstep: 0.1\ntime: 1\nstarts: physical
systems: [chaplygin-sleigh-vakonomic]\nexpect: {all: {all: {E: {at most: 1}}}}\n' >no.yaml
try 0 study no.yaml --output there --force --no-page
prints '^Expectations: 1 of 1 are met; 1 refused\.$'
printf 'integrators: [gauss4, gni]\nstep: 0.1\ntime: 1\nstarts: physical
systems: [chaplygin-sleigh-vakonomic]\nexpect: {all: {gni: {E: {at most: 1}}}}\n' >no.yaml
try 1 study no.yaml --output there --force --no-page
prints '^Expectations: 0 of 1 are met; 1 refused\.$'
# A run that cannot begin has no quantities, which do not meet anything either.
cat >cannot.yaml <<'END2'
coordinates: [x]
lagrangian: x'^2/2 - x
constraints: [x*(x' - 1)]
start: {x: 0}
invariants: {I: x}
END2
printf 'integrators: gauss4\nstep: 0.1\ntime: 1\nstarts: physical
systems: [cannot.yaml]\nexpect: {cannot.yaml: {all: {I: [exact, rounding], D: aborted}}}\n' >none.yaml
try 3 study none.yaml --output there --force --no-page
prints '^Expectations: 0 of 2 are met; 2 failed\.$'

case_is "E off D = 0 has a number without a trend"
# x'^2/2 + y'^2/2 + x^2/2 changes by h D per unit of time, which is 5e-12 of it at most.
cat >beside.yaml <<'END2'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2 - x^2/2
constraints: [y' - x*x']
start: {x: 1, x': 1, y': 1.000000000005}
END2
printf 'integrators: gauss4\nstep: 0.1\ntime: 50\nstarts: physical\nsystems: [beside.yaml]\n' >beside-study.yaml
try 0 study beside-study.yaml --output there --force --no-page
prints '^gauss4 +[a-z]-12$'
prints '^gauss4 +-0[4-8]$'
prints ' -08 off D = 0, - not stated$'
prints '^E in 1 runs: 1 off D = 0\.$'
prints '^0 of 1 integrators keep E within 1 % on D = 0, 1 off D = 0\.$'

case_is "bounds of every number of a trend"
# ramp = 2 t; wave = 2 t + 3 sin(10 t); half = t^1.5/4
cat >ramp.yaml <<'END'
coordinates: [x]
accelerations: {x: 0}
start: {x': 1}
invariants: {ramp: 2*x, slow: sin(0.015*x), wave: 2*x + 3*sin(10*x), half: 0.25*x^1.5}
END
bounds() { # EXPECTATION: of the motion of ramp.yaml
    printf 'integrators: rk4\nstep: 0.01\ntime: 200\nstarts: physical
systems: [{system: ramp.yaml, label: ramp}]\nexpect: {ramp: {rk4: {%s}}}\n' "$1" >bounds.yaml
}
bounds 'ramp: {rate: {at least: 1.99999, at most: 2.00001}, rate_low: {at most: 2.00001},
rate_high: {at least: 1.99999}, exponent: {at least: 0.95, at most: 1.05}, amplitude: {at most: 1e-9},
confidence: {at least: 0.9, at most: 1}}, wave: {amplitude: {at least: 2.9, at most: 3.1}},
half: {exponent: {at least: 1.4, at most: 1.6}}'
try 0 study bounds.yaml --output bounds --force
prints '^Expectations: 8 of 8 are met\.$'
# half is 707 at the end, ramp and wave 400.
expect "not the invariant that moves most" test "$(column invariant bounds/cells.csv)" = half
# Of each number of the wave: a bound that it keeps, one too low and one too high for it.
cell() { awk -F, -v name="$1" -v head="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == head) k = i }
    $5 == name { print $k }' bounds/quantities.csv; }
fields="amplitude rate rate_low rate_high exponent confidence"
wanted=$(for field in $fields; do
    cell half $field | awk -v field=$field '{ d = 1e-7*($1 < 0 ? -$1 : $1) + 1e-300
        printf "%s%s: {at least: %.17g, at most: %.17g}", n++ ? ", " : "", field, $1 - d, $1 + d }'
    echo ,
done)
bounds "half: {${wanted%,}}"
try 0 study bounds.yaml --output bounds --force
prints '^Expectations: 6 of 6 are met\.$'
for field in $fields; do
    x=$(cell half $field)
    low=$(awk "BEGIN { printf \"%.17g\", $x - 0.01 }")
    high=$(awk "BEGIN { printf \"%.17g\", $x + 0.01 }")
    bounds "half: {$field: {at most: $low}}"
    try 1 study bounds.yaml --output bounds --force --tables
    prints "half: expected $field <= .* \(line 6\)"
    bounds "half: {$field: {at least: $high}}"
    try 1 study bounds.yaml --output bounds --force --tables
    prints "half: expected $field >= .* \(line 6\)"
    bounds "half: {$field: {at least: $low, at most: $high}}"
    try 0 study bounds.yaml --output bounds --force
done
# Half a period may be anything: no confidence, and no bound of it is met.
for bound in 'at least: 0' 'at most: 1'; do
    bounds "slow: {trend: undecided, confidence: {$bound}}"
    try 1 study bounds.yaml --output bounds --force --tables
    prints '^Expectations: 1 of 2 are met'
    prints "slow: expected confidence .= .* \(line 6\)"
done
expect "no confidence" [ -z "$(cell slow confidence)" ]

case_is "statements about some cells"
printf 'integrators: rk4\nstep: [0.1, 0.2]\ntime: 1\nsystems: [plane.yaml]\nexpect:\n  plane.yaml:\n'"\
    rk4: {E: [{step: 0.1, at most: 1}, {start: surface, final: {at most: 0.5}}],
          state: done}\n" >some.yaml
try 1 study some.yaml --output there --force --tables
# E = 1 throughout: the first holds at 3 starts, the second at none of 2 steps; 6 states
prints '^Expectations: 9 of 11 are met\.$'
prints '^  plane.yaml +rk4 +surface +h = 0.2 +E: expected final <= 0.5, found 1 \(line 7\)$'

case_is "statements about what is not there"
unexpected() {
    expecting "$1"
    try 2 study expect.yaml --output there --force
    says "$2"
    empty
}
unexpected '  lines: {rk4: {c: exact}}\n' \
    "expect.yaml:9:3: unknown label of this study 'lines'"
unexpected '  line: {rk5: {c: exact}}\n' \
    "expect.yaml:9:10: expect: 'line' is not run with 'rk5' in this study"
unexpected '  line: {rk4: {D: exact}}\n' \
    "expect.yaml:9:16: expect: 'line' has no quantity 'D' in this study"
unexpected '  line: {rk4: {H: exact}}\n' "has no quantity 'H'"
unexpected '  appell-hamel: {rk4: {D2: exact}}\n' "has no quantity 'D2'"
unexpected '  line: {rk4: {c: [{step: 0.1, size: exact}]}}\n' \
    "expect.yaml:9:20: expect: the study has no such step and start"
unexpected '  line: {rk4: {c: {start: surface, size: exact}}}\n' 'no such step and start'
unexpected '  line: {rk4: {c: {start: surfac, size: exact}}}\n' \
    "expect.yaml:9:27: unknown start 'surfac'; did you mean 'surface'"
unexpected '  line: {rk4: {c: exat}}\n' \
    "expect.yaml:9:19: unknown size or trend 'exat'; did you mean 'exact'"
unexpected '  line: {rk4: {c: bounded}}\n' \
    "expect.yaml:9:19: expect: 'bounded' is now the trend 'none'"
unexpected '  line: {rk4: {c: [none, linear drift]}}\n' \
    "expect.yaml:9:26: expect: 'linear drift' is now the trend 'linear'"
unexpected '  line: {rk4: {c: {trend: not enough data}}}\n' \
    "expect.yaml:9:27: expect: 'not enough data' is now the trend 'undecided'"
unexpected '  line: {rk4: {c: {verdict: exact}}}\n' \
    "expect.yaml:9:29: expect: 'verdict' is now 'size' and 'trend'"
unexpected '  line: {rk4: {c: {size: linear}}}\n' "expect.yaml:9:26: unknown size 'linear'"
unexpected '  line: {rk4: {c: {trend: exact}}}\n' "expect.yaml:9:27: unknown trend 'exact'"
unexpected '  line: {rk4: {state: dne}}\n' "unknown state 'dne'; did you mean 'done'"
unexpected '  line: {rk4: {c: []}}\n' 'expect: the list is empty'
unexpected '  line: {rk4: {c: {rate: {}}}}\n' "'at most' or 'at least' is required"
unexpected '  line: {rk4: {c: {at most: few}}}\n' "expect.yaml:9:29: at most: 'few' is not a number"
unexpected '  line: {rk4: {c: {slope: {at most: 1}}}}\n' "expect.yaml:9:20: unknown key 'slope'"
unexpected '  line: {rk4: exact}\n' 'quantities are required'
unexpected '  line: rk4\n' 'integrators are required'
unexpected '  [line]\n' 'labels are required'

case_is "values that are none"
bad "${common}systems: [{system: line.yaml, set: {k: {from: 0, to: 1}}}]\n" \
    'bad.yaml:5:40: set: a range is '
bad "${common}systems: [{system: line.yaml, set: {k: {from: 0, to: 1, count: 3, by: 1}}}]\n" \
    'set: a range is '
bad "${common}systems: [{system: line.yaml, set: {k: {from: 0, to: 1, count: 1}}}]\n" \
    'set: this range does not have 1\.\.'
bad "${common}systems: [{system: line.yaml, set: {k: {from: 0, to: 1, by: -0.1}}}]\n" \
    'set: this range does not have 1\.\.'
bad "${common}systems: [{system: line.yaml, set: {k: {from: 0, to: 1, cont: 3}}}]\n" \
    "bad.yaml:5:57: unknown key 'cont'; did you mean 'count'"
bad "${common}systems: [{system: line.yaml, set: {k: []}}]\n" 'set: the list is empty'
bad "${common}systems: [{system: line.yaml, set: {k: [1, 1]}}]\n" "two systems called 'line.yaml_k=1'"
bad "${common}systems: [{system: line.yaml, set: {k: {between: [1, 2]}}}]\n" 'need seeds'
bad "${common}seeds: [0.5]\nsystems: [{system: line.yaml, set: {k: {between: [1, 2]}}}]\n" \
    'bad.yaml:5:8: seeds: 0.5 is not an integer'
bad "${common}seeds: 1\nsystems: [{system: line.yaml, set: {k: {between: [2, 1]}}}]\n" \
    'bad.yaml:6:50: between: 2 is not below 1'
bad "${common}seeds: 1\nsystems: [{system: line.yaml, set: {k: {between: [1]}}}]\n" 'two numbers'
bad "${common}seeds: 1\nsystems: [{system: line.yaml, set: {k: {between: [1, few]}}}]\n" "between: 'few' is not a number"
bad "${common}mechanics: [nonholonomc]\nsystems: [line.yaml]\n" "unknown mechanics 'nonholonomc'"
bad "${common}systems: [line.yaml]\nexpect: {line.yaml: {rk4: {E: {is: none, step: few}}}}\n" "step: 'few' is not a number"
bad "${common}systems: [{system: line.yaml, set: {k: {from: 0, to: 1, count: 20000}}}]\n" \
    'does not have 1\.\.10000 values'
bad "integrators: rk4\nstep: [0.1, 0.1]\ntime: 1\nsystems: [line.yaml]\n" \
    'bad.yaml:2:7: step: 0.1 comes twice'
bad "${common}systems: [knife-egde]\n" "bad.yaml:5:11: unknown system 'knife-egde'; did you mean 'knife-edge'"
bad "${common}samples: 0.5\nsystems: [line.yaml]\n" 'bad.yaml:5:10: samples: 0.5 is not an integer'
bad "${common}statistics: 0\nsystems: [line.yaml]\n" 'bad.yaml:5:13: statistics: 0 is not in 1'

case_is "a system that is missing, a range that is a draw, and too many values"
bad "${common}systems: [line.yaml]\nexpect: {line.yaml: {rk4: {state: {a: 1}}}}\n" ':35: state: words are required$'
bad "${common}systems: [{system: line.yaml, mechanics: []}]\n" ': mechanics: the list is empty$'
bad 'integrators: rk4\nstep: {between: [0.1, 0.2]}\nseeds: 1\ntime: 1\nsystems: [line.yaml]\n' \
    'bad.yaml:2:7: step: it must not be random$'
bad "\"a\\\\0b\": 1\n${common}systems: [line.yaml]\n" '^dalembert: bad\.yaml:1:1: a study: a NUL in the text$'
bad "${common}systems: [{system: line.yaml, set: {k: [$(seq -s, 10001)]}}]\n" 'set: 10001 values, not 1\.\.10000$'
bad "${common}displacement: few\nsystems: [line.yaml]\n" "displacement: 'few' is not a number$"
bad "${common}displacement: -1\nsystems: [line.yaml]\n" 'displacement: -1 is not positive$'
bad "${common}systems: [{label: a}]\n" '^dalembert: bad\.yaml:5:11: the system is missing$'
bad "${common}systems: [{system: line.yaml, start: {x: {between: [0, 1], from: 1}}}]\n" \
    ': start: between excludes all other keys$'
bad 'integrators: rk4\nstep: {from: 0.5, to: 0.1, count: 17}\ntime: 1\nsystems: [line.yaml]\n' \
    ':2:7: step: 17 values, not 1\.\.16$'

case_is "tolerances are an axis"
cat >tolerances.yaml <<'END'
integrators: [dop853, rk4]
step: [1, 0.5]
tolerance: [1e-6, 1e-10]
time: 10
starts: [physical, surface]
systems: [knife-edge]
expect:
  knife-edge:
    dop853:
      error: [{tolerance: 1e-6, at least: 1e-8}, {tolerance: 1e-10, step: 1, at most: 1e-8}]
END
try 0 study tolerances.yaml --output controlled --tables
silent
prints '^ lifted, on p = pi = 0, h = 0.5, T = 10$'
prints '^ lifted, on p = pi = 0, h = 0.5, tolerance 1e-10, T = 10$'
# 2 steps x 2 starts x (2 tolerances of dop853 + 1 of rk4, which takes none)
expect "not 12 cells" test "$(column state controlled/cells.csv | grep -c '^done$')" -eq 12
expect "tolerances of rk4" test "$(awk -F, '$3 == "rk4" { print $6 }' controlled/cells.csv | sort -u)" = 0
expect "(q,v) and the surface differ" test -z "$(column same_as_physical controlled/cells.csv | grep no)"
# 4 cells of dop853 of the one, 2 of the other
expect "other cells compared" test "$(column tolerance controlled/expectations.csv | sort -g | uniq -c |
    awk '{ print $1 }' | tr '\n' ' ')" = "2 4 "
for file in quantities.csv series/knife-edge.csv; do
    expect "$file: other cells" test "$(awk -F, 'NR > 1 { print $2, $3, $4, $5 }' controlled/$file |
        sort -u | wc -l)" -eq 12
done
try 0 run knife-edge --integrator dop853 --step 0.5 --tolerance 1e-10 --time 10 --samples 400 \
    --sampling steps --output alone.npy --space physical
expect "not the run of that tolerance" cmp -s alone.npy \
    controlled/runs/knife-edge_dop853_physical_0.5_tolerance=1e-10/trajectory.npy

case_is "tolerances without a step"
sed -e '1i integrators: dop853' -e '/^step\|rk4/d; /^expect/,$d' tolerances.yaml >chosen.yaml
echo 'samples: 16' >>chosen.yaml
try 0 study chosen.yaml --output chosen
expect "the step is not a hundredth of the time" test "$(column step chosen/cells.csv | sort -u)" = 0.10000000000000001
sed 's/integrators: .*/integrators: [dop853, rk4]/' chosen.yaml >fixed.yaml
try 2 study fixed.yaml --output bad
says "^dalembert: fixed.yaml:[0-9]+:[0-9]+: knife-edge: the step is missing, and rk4 takes no tolerance"

case_is "tolerances: bad ones"
for bad in '[1e-6, 0]:tolerance: 0 is not above 0 and at most 1' '2:tolerance: 2 is not above 0' \
    '[0.1, 0.1]:tolerance: 0.1 comes twice' '{between: [0.1, 1]}:tolerance: it must not be random'; do
    sed "s/^tolerance: .*/tolerance: ${bad%%:tolerance*}/" tolerances.yaml >bad.yaml
    try 2 study bad.yaml --output bad
    alone "^dalembert: bad.yaml:[0-9]+:[0-9]+: tolerance: ${bad##*:tolerance: }"
done
sed 's/^time/options: {tolerance: 1e-3}\n&/' tolerances.yaml >bad.yaml
try 2 study bad.yaml --output bad
says "knife-edge: the tolerance is given as a key and among the options"
sed 's/{tolerance: 1e-6,/{tolerance: 1e-7,/' tolerances.yaml >bad.yaml
try 2 study bad.yaml --output bad
says "expect: the study has no such step, tolerance and start"

case_is "paths of systems are relative to the study file"
mkdir -p far/deep away
cp swing.yaml far/near.yaml
cp swing.yaml far/deep/bare
printf 'integrators: rk4\nstep: 0.1\ntime: 1\nstarts: physical
systems: [near.yaml, ./deep/bare]\n' >far/study.yaml
try 0 study far/study.yaml --output far/there --no-page
expect "a path of its own" test "$(column system far/there/cells.csv | tr '\n' ' ')" = "near.yaml ./deep/bare "
(cd away && try 0 study ../far/study.yaml --output there --no-page && rm ../far/near.yaml && try 0 resume there)
expect "another result from elsewhere" sh -c "cut -d, -f1-34 far/there/cells.csv >a; cut -d, -f1-34 away/there/cells.csv |
    cmp -s - a"
# What was relative to the working directory is no longer found, and the message says why.
cp swing.yaml near.yaml
try 2 study far/study.yaml --output far/there --no-page --force
says "far/study\.yaml:5:[0-9]+: there is no 'far/near\.yaml': paths are relative to the study file"
rm near.yaml
try 2 study far/study.yaml --output far/there --no-page --force
says "far/near\.yaml"
