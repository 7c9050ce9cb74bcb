# `dalembert dirac`: Dirac's procedure for the action of a system.

case_is "the sleigh, as (nh13) to (nh22) say"
try 0 dirac chaplygin-sleigh
prints '^chaplygin-sleigh: Dirac.s procedure in 20 dimensions, 3 stages, 13 constraints$'
prints '^  pi_e = 0: requires .*, irregular; replaced by pi_y1, pi_y2, pi_phi = 0$'
prints "^  pi_lambda_y1 = 0: fixes mu_y1 = y1'$"
prints '^  pi_phi = 0: requires lambda_phi = 0$'
prints '^First class, 7: pi_e, p_y1, p_y2, p_phi, pi_y1, pi_y2, pi_phi$'
prints '^Second class, 6: pi_lambda_y1, pi_lambda_y2, pi_lambda_phi, lambda_y1, lambda_y2, lambda_phi$'
prints "^Gauge generator G = pi_e\*alpha: delta mu_e = alpha'$"
prints '^  delta e = alpha$'
prints '^Motion: 6 dimensions, 20 of phase space less 13 constraints and 1 of gauge$'
prints '^  \{y1, p_y1\} = 1$'
refute "a bracket that is 0" grep -q '{y1, y2}' out
mv out text
try 0 dirac chaplygin-sleigh --details
expect "the same with --details" cmp text out

case_is "as JSON"
try 0 dirac chaplygin-sleigh --effort constraint --json
expect "six of first class: D remains" json out "
    d['schema'] == 'dalembert/dirac/1' and d['effort'] == 'constraint' and d['complete']
    and (d['first_class'], d['second_class'], d['free_multipliers'], d['dimension']) == (6, 6, 1, 7)
    and len(d['constraints']) == 12 and d['on_surface'] == '0'"
try 0 dirac chaplygin-sleigh-vakonomic --set m=2 --json
expect "all of second class" json out "
    (d['first_class'], d['second_class'], d['generators'], d['phase_space']) == (0, 14, [], 20)
    and all(c['class'] == 'second' for c in d['constraints'])
    and [\"phi\", \"phi'\", '1/I'] in d['brackets'] and d['request']['parameters']['m'] == 2"
expect "where each constraint comes from" json out "
    [c['from'] for c in d['constraints'] if c['stage'] == 1] == ['pi_y1', 'pi_y2', 'pi_phi', 'pi_g1']
    and {s['outcome'] for s in d['steps']} == {'fixes', 'adds'}"

case_is "as LaTeX"
try 0 dirac damped-oscillator --latex
prints '^\\begin\{align\*\}$'
prints '\\phi_\{1\} &= \\pi_\{e\}'
prints '\\delta \\mu_\{e\} &= \\dot\{\\alpha\}'
prints '^\\end\{align\*\}$'

case_is "an indefinite mass matrix: pi.K pi = 0 is no sum of squares"
try 1 dirac relativistic-scalar --effort mass
prints '^The procedure stops here.$'
refute "classes" grep -q 'class' out
try 1 dirac relativistic-scalar --effort mass --json
expect "no classes" json out "not d['complete'] and d['steps'][-1]['outcome'] == 'stops'
    and d['constraints'][0]['class'] is None and d['on_surface'] is None"

case_is "refused"
cat >forced.yaml <<'END'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2
forces: {x: -x'}
constraints: [y' - x*x']
mechanics: vakonomic
END
try 2 dirac forced.yaml
says 'vakonomic motion with forces has no action'
try 2 dirac chaplygin-sleigh --latex --json
says 'dirac: --latex excludes --json and --details'
try 2 dirac chaplygin-sleigh-vakonomic --effort mass
try 2 dirac
