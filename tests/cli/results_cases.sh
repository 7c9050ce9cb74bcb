# What the commands print with --json: the numbers come from closed forms, or from the CSV files
# that the same run of the command writes.

# results STATUS ARGUMENT...: the command prints one document of JSON and nothing else.
results() {
    wanted=$1
    shift
    try "$wanted" "$@" --json
    cat out >>all.lines
    expect "another schema" grep -q "^  \"schema\": \"dalembert/$1/1\",$" out
    reader=${program%/*}/tests/read_json
    needs 1 "no read_json (make build/tests/read_json)" test -x "$reader" || return 0
    { wc -c <out && cat out; } | "$reader" >read
    expect "no JSON" sh -c '[ "$(wc -l <read)" -eq 1 ] && ! grep -q "^refused" read'
    counted
}

# x'' = -k x' from x = 0, x' = 1.  A step of rk4 multiplies x' by R = R(-k h), and keeps x' + k x.
friction="./line.yaml --set k=0.5 --step 0.2"
R='(lambda z: 1 + z + z**2/2 + z**3/6 + z**4/24)'
cat >ends.yaml <<'END'
coordinates: [x]
accelerations: {x: sqrt(0.5 - t)}
END

case_is "a command line that is wrong prints no JSON"
while read -r arguments; do
    try 2 $arguments --json
    empty
    says '^dalembert: '
done <<END
check
check no-such-system
check ./line.yaml --set c=1
list sistems
list --tag no-such-tag
list --markdown
order $friction --integrators rk5
order $friction --time 1.23
order $friction --time 2 --output -
lyapunov $friction --integrator rk4 --time 1 --exponents 7
lyapunov $friction --integrator rk4 --time 1 --output -
volume $friction --integrator rk4 --time 0.1
explain $friction --integrator rk4 --time 1 --output -
section $friction --integrator rk4 --time 1 --on y
section $friction --integrator rk4 --time 1.1 --on x
END

case_is "JSON without another parser"
while read -r arguments; do
    results 0 $arguments
    silent
    expect "no version" grep -q '^  "dalembert": "[0-9.]*",$' out
done <<END
check ./plane.yaml
list systems
order $friction --time 1 --integrators rk4
lyapunov $friction --integrator rk4 --time 2
volume $friction --integrator rk4 --time 2
explain $friction --integrator rk4 --time 2
section $friction --integrator rk4 --time 2 --on x-0.5
END

if needs 2 "no /dev/full" test -c /dev/full; then
    case_is "JSON that cannot be written"
    "$program" check ./line.yaml --json 2>err >/dev/full
    status=$?
    expect "exit $status, not 4" test $status -eq 4
    says "cannot write 'standard output'"
    counted
fi

needs 94 "no python3" there python3 || return 0

case_is "list as JSON"
results 0 list
expect "no sleigh" json out "
    [(s['coordinates'], s['constraints'], s['parameters']) for s in d['systems']
     if s['system'] == 'chaplygin-sleigh']
        == [(['y1', 'y2', 'phi'], 1, {'m': 1, 'I': 1, 'v0': 1, 'omega': 1})]"
expect "methods" json out "
    [(i['order'], i['is_modifier'], i['properties'], i['preserves'])
     for i in d['integrators'] if i['integrator'] in ('gauss4', 'project')]
        == [(4, False, ['symmetric', 'symplectic lift'], ['quadratic']),
            (None, True, [], ['every', 'holonomic'])]"
mv out all.json
try 0 list --markdown
expect "other names than in the tables" json all.json "
    [line.split('\`')[1].lstrip('+') for line in open('out') if line.startswith('| \`')]
        == [s['system'] for s in d['systems']] + [i['integrator'] for i in d['integrators']]"
results 0 list --tag chaotic --preserves energy
expect "filters" json out "
    d['request'] == {'table': None, 'tag': 'chaotic', 'order': None, 'preserves': 'energy'}
    and d['systems'] and all('chaotic' in s['tags'] for s in d['systems'])
    and d['integrators'] and all('energy' in i['preserves'] for i in d['integrators'])"

case_is "check as JSON"
results 0 check ./plane.yaml
expect "no items" json out "
    [(i['result'], i['value'], i['at_least'], i['at_most']) for i in d['items']
     if i['item'] in ('|D| at the start', 'rank of G at the start', 'first-class constraints')]
        == [('ok', 0, None, 1e-10), ('ok', 1, 1, 1), ('ok', 5, 5, 5)]"
expect "counts" json out "d['failed'] == d['not_measured'] == 0
    and (d['coordinates'], d['constraints']) == (2, 1) and d['preserving'] is None
    and (d['growth'], d['growth_dimension']) == ([1], 2)"
mv out plane.json
try 0 check ./plane.yaml
expect "other items than in the text" json plane.json "
    [(i['item'], i['result']) for i in d['items']]
        == [(line[2:36].strip(), line[38:42].strip()) for line in open('out')
            if line[:2] == '  ' and line[2] not in ' -']"
# A solution that is twice as fast: |x'' + k x'| = 2 exp(-2t) against max(1, x'), x' = 2 exp(-2t).
sed 's/^exact:.*/exact: {x: (1 - exp(-2*k*t))\/k}/
     s/^title:.*/title: "\\u03b8 \\"twice\\"\\ta"/' line.yaml >twice.yaml
results 1 check twice.yaml
expect "the failure" json out "
    [(i['item'][:8], i['at_most']) for i in d['items'] if i['result'] == 'FAIL'] == [('residual', 1e-8)]
    and all(near(i['value'], 1) for i in d['items'] if i['result'] == 'FAIL')
    and d['failed'] == 1 and d['title'] == '\u03b8 \"twice\"\ta'"
results 0 check heisenberg
expect "integrators" json out "{'gauss4', '+project'} <= set(d['preserving'])
    and 'rk4' not in d['preserving'] and d['growth_complete']
    and {k['integrator'] for k in d['methods'] if 'D' in k['preserves']} == set(d['preserving'])
    and [k['preserves'] for k in d['methods'] if k['integrator'] == 'rk4'] == [[]]
    and [(k['accepted'], k['preserves']) for k in d['methods'] if k['integrator'] == 'isokinetic-splitting']
        == [(False, [])]"

case_is "order as JSON"
results 0 order $friction --time 2 --integrators rk4,isokinetic-splitting --output order.csv
expect "the request" json out "d['request']['parameters'] == {'k': 0.5}
    and d['request']['time'] == 2 and d['request']['space'] == 'lifted'
    and 'step' not in d['request'] and 'integrator' not in d['request']
    and d['reference'] == {'integrator': None, 'step': None, 'error': None}"
# x is 2 (1 - x') in both; the units are 2 of time, which is 1/k, 1 of x', as at the start, and so 2 of x.
expect "errors" json out "
    all(near(l['error'], abs($R(-0.5*l['step'])**l['steps'] - math.exp(-1)), 1e-4)
        and l['evaluations'] == 4 * l['steps'] and near(l['steps'], 2 / l['step'])
        and l['seconds'] > 0
        for l in d['methods'][0]['levels']) and len(d['methods'][0]['levels']) == 4"
expect "the order" json out "d['methods'][0]['stated_order'] == 4
    and abs(d['methods'][0]['observed_order'] - 4) < 0.1
    and d['methods'][0]['observed_order'] == d['methods'][0]['levels'][3]['slope']
    and d['methods'][0]['message'] is None and d['methods'][0]['levels'][0]['slope'] is None"
expect "what is refused" json out "[m['state'] for m in d['methods']] == ['done', 'refused']
    and 'isokinetic' in d['methods'][1]['message'] and d['methods'][1]['levels'] == []"
expect "other numbers than in CSV" json out "
    [[cell(r[k]) for k in ('step', 'steps', 'error', 'slope', 'evaluations', 'seconds')]
     for r in rows('order.csv') if r['integrator'] == 'rk4']
        == [[l[k] for k in ('step', 'steps', 'error', 'slope', 'evaluations', 'seconds')]
            for l in d['methods'][0]['levels']]"
results 0 order pendulum-cvt --integrators gni --step 0.1 --time 1
expect "the reference" json out "d['reference']['integrator'] == 'gauss12'
    and near(d['reference']['step'], 0.1 / 2**4) and 0 < d['reference']['error'] < 1e-12"
cat >stiff.yaml <<'END'
coordinates: [x]
accelerations: {x: 0.001*sqrt(4 - x'^2) - 10*x'}
start: {x': 1}
END
results 3 order stiff.yaml --integrators symplectic-euler-00 --steps 1,0.05 --time 2
expect "null where a run failed" json out "[(l['error'] is None, l['seconds'] is None,
    l['evaluations'] is None, l['message'] is None) for l in d['methods'][0]['levels']]
        == [(True,) * 3 + (False,), (False,) * 3 + (True,)]
    and (d['methods'][0]['state'], d['methods'][0]['observed_order']) == ('failed', None)"

case_is "lyapunov and volume as JSON"
# A step has the determinant R; the divergence of the motion is -k.
for command in lyapunov volume; do
    results 0 $command $friction --integrator rk4 --time 10 --transient 1 --output $command.csv
    expect "the means" json out "near(d['divergence']['mean'], -0.5, 1e-12)
        and near(d['sum' if '$command' == 'lyapunov' else 'step']['mean'],
                 math.log($R(-0.1)) / 0.2, 1e-12)
        and (d['state'], d['derivative']) == ('done', 'exact')
        and near(d['from'], 1) and near(d['to'], 11) and d['request']['transient'] == 1"
    expect "the balance" json out "
        near(d['balance']['difference'], math.log($R(-0.1)) / 0.2 + 0.5, 1e-4)
        and abs(d['balance']['difference']) < d['balance']['margin']
        and d['balance']['surface'] == 0 and d['balance']['reason'] is None"
    expect "other means than in CSV" json out "
        [e['mean'] for e in d.get('exponents', [])] + [d['divergence']['mean']]
            + ([d['step']['mean']] if '$command' == 'volume' else [])
        == [float(x) for x in list(rows('$command.csv')[-1].values())[1:]]"
    mv out $command.json
done
expect "exponents" json lyapunov.json "d['sum_is_of_all'] is True
    and all(e['low'] <= e['mean'] <= e['high'] for e in d['exponents'])
    and [e['result'] for e in d['exponents']] == ['may be 0', 'negative']"
expect "directions" json volume.json "d['directions'] == d['dimension'] == 2
    and d['divergence']['result'] == d['step']['result'] == 'shrinks'"
results 0 lyapunov $friction --integrator rk4 --time 2 --exponents 1
expect "without the sum of all" json out "len(d['exponents']) == 1 and d['sum_is_of_all'] is False
    and d['balance']['difference'] is None and '1 of 2' in d['balance']['reason']"
results 3 lyapunov ends.yaml --integrator rk4 --step 0.1 --time 1
expect "a run that fails" json out "d['state'] == 'failed' and 0 < d['to'] < 0.6"

case_is "explain as JSON"
results 0 explain $friction --integrator rk4 --time 10 --output explain.csv
expect "the request" json out "d['request']['space'] == 'lifted' and d['request']['step'] == 0.2
    and d['steps'] == d['quad_steps'] == 50 and 'precision' not in d['request']"
# E = x'^2/2 of the run, and of one with half the step.
expect "deviations" json out "
    [near(r['deviation'], (1 - $R(-0.5*h)**(20/h))/2, 1e-9)
     for o in d['observables'] if o['name'] == 'E' for r in o['runs']
     for name, h in (('all', 0.2), ('half-step', 0.1)) if r['name'] == name] == [True, True]"
expect "what is not conserved has no trend" json out "
    [(r['size'], r['trend'], r['exponent'], r['confidence']) for o in d['observables']
     for r in o['runs'] if (o['name'], r['name']) == ('E', 'all')] == [(None,) * 4]"
expect "other numbers than in CSV" json out "
    [[o['name'], kind, r['name']] + [r.get(k) for k in
        ('steps', 'share', 'margin', 'rate', 'rate_low', 'rate_high', 'deviation', 'size',
         'trend', 'confidence', 'words')]
     for o in d['observables'] for kind in ('run', 'source') for r in o[kind + 's']]
    == [[cell(x) for x in r.values()] for r in rows('explain.csv')]"
results 0 explain $friction --integrator rk4 --time 2 --quad-steps 0
expect "without quad precision" json out "d['quad_steps'] == 0
    and all('quad' not in r['name'] for o in d['observables'] for r in o['runs'])
    and {'name', 'reason'} == set(d['not_run'][0])"

case_is "section as JSON"
# x = (1 - exp(-k t))/k is 0.5 at t = -log(1 - k/2)/k.
results 0 section $friction --integrator rk4 --time 3 --on "x=0.5" --output section.csv
expect "the crossing" json out "d['up'] == 1 and d['down'] == d['touches'] == 0
    and near(d['rows'][0][1], -2*math.log(0.75), 1e-4) and near(d['rows'][0][3], 0.5)
    and d['request']['on'] == 'x=0.5' and d['request']['direction'] == 'both'"
expect "other rows than in CSV" json out "
    [dict(zip(d['columns'], row)) for row in d['rows']]
        == [{k: float(x) for k, x in r.items()} for r in rows('section.csv')]"
results 0 section pendulum-cvt --on "sin(xi)" --direction up --integrator gni --step 0.1 --time 50
expect "upwards" json out "len(d['rows']) == d['up'] > 10
    and all(abs(math.sin(r[3])) < 1e-12 and r[2] == 1 for r in d['rows'])
    and [r[0] for r in d['rows']] == list(range(1, d['up'] + 1))"
results 3 section ends.yaml --on t-0.3 --integrator rk4 --step 0.1 --time 1
expect "a run that fails" json out "d['state'] == 'failed' and d['up'] == 1"
"$program" section $friction --integrator rk4 --on "sin(t)" --time 1e12 --output cut --json 2>err >out &
pid=$!
expect "no rows" reaches $pid has_lines cut/section.csv 4
ends_by INT 130 $pid
says '^dalembert: interrupted; [0-9]+ rows are kept$'
expect "a run that is interrupted" json out "d['state'] == 'interrupted' and d['to'] < 1e12
    and [r[0] for r in d['rows']] == [float(r['crossing']) for r in rows('cut/section.csv')]
    and all(near(r[1], math.pi * r[0], 1e-9) for r in d['rows'])"

case_is "every name is described"
# Names of parameters and of options are the system's and the request's.
python3 - "$here/../../docs/formats.md" <<'END' >undescribed
import json, re, sys

decoder = json.JSONDecoder()
text = open('all.lines', encoding='utf-8').read().lstrip()
described = open(sys.argv[1], encoding='utf-8').read()
described = described[described.index('## Results as JSON'):described.index('## Progress')]


def names(value, inside=''):
    if isinstance(value, list):
        for item in value:
            yield from names(item)
    elif isinstance(value, dict) and inside not in ('parameters', 'request'):
        for name, member in value.items():
            yield name
            yield from names(member, name)


seen = set()
while text:
    value, end = decoder.raw_decode(text)
    seen.update(names(value))
    text = text[end:].lstrip()
trend = {'rate', 'rate_low', 'rate_high', 'exponent', 'size', 'trend'}  # amplitude to confidence
print(*sorted(n for n in seen - trend if f'`{n}`' not in described))
print(len(seen))
END
expect "$(cat undescribed)" sh -c '[ -z "$(head -1 undescribed)" ] && [ "$(tail -1 undescribed)" -gt 60 ]'
counted
