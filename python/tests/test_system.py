"""Systems, and the places of errors in their texts."""
import math
import pickle

import pytest

import dalembert
from conftest import OSCILLATOR


def test_members():
    skate = dalembert.System("""
title: A skate on a spring
coordinates: [x, y, phi]
parameters: {m: 2, k: 1}
lagrangian: m/2*(x'^2 + y'^2) + phi'^2/2 - k/2*(x^2 + y^2)
constraints: [x'*sin(phi) - y'*cos(phi)]
invariants: {spin: phi'}
tags: [spring]
defaults: {integrator: gauss4, step: 0.1, time: 5}
""")
    assert (skate.title, skate.n, skate.m) == ('A skate on a spring', 3, 1)
    assert skate.coordinates == ('x', 'y', 'phi')
    assert skate.parameters == {'m': 2.0, 'k': 1.0}
    assert skate.invariants == ('spin',) and skate.tags == ('spring',)
    assert skate.defaults == {'integrator': 'gauss4', 'step': '0.1', 'time': '5'}
    assert {'D_LINEAR', 'AUTONOMOUS', 'MASS_CONSTANT', 'E_ON_D'} <= skate.properties
    assert not {'D_CONSTANT', 'VAKONOMIC'} & skate.properties
    run = dalembert.Run(skate)
    assert (run.integrator, run.step) == ('gauss4', 0.1)


def test_builtin_and_file(tmp_path):
    names = dalembert.builtin_systems()
    assert 'chaplygin-sleigh' in names and len(names) == len(set(names)) >= 34
    sleigh = dalembert.System.builtin('chaplygin-sleigh')
    path = tmp_path / 'sleigh.yaml'
    path.write_text(sleigh.text)
    assert dalembert.System.from_file(path).coordinates == sleigh.coordinates == ('y1', 'y2', 'phi')
    with pytest.raises(FileNotFoundError):
        dalembert.System.from_file(tmp_path / 'none.yaml')


def test_unknown_builtin():
    with pytest.raises(dalembert.InputError, match="did you mean 'chaplygin-sleigh'") as caught:
        dalembert.System.builtin('chaplygin-slegh')
    assert caught.value.status == 'DAL_NAME' and caught.value.line is None


@pytest.mark.parametrize('text, status, line, column', [
    # the places of the characters that are wrong
    ('coordinates: [x]\nlagrangian: (x\'^2 - ^2)/2\n', 'DAL_SYNTAX', 2, 21),
    ('coordinates: [x]\nlagrangian: x\'^2/2 - length*x\n', 'DAL_NAME', 2, 22),
    ('coordinates: [x]\nsubject: x\n', 'DAL_NAME', 2, 1),
])
def test_place_of_an_error(text, status, line, column):
    with pytest.raises(dalembert.InputError) as caught:
        dalembert.System(text)
    error = caught.value
    assert (error.status, error.line, error.column) == (status, line, column)
    assert str(error) == f'line {line}, column {column}: {error.message}'
    assert isinstance(error, ValueError)
    copy = pickle.loads(pickle.dumps(error))
    assert (copy.status, copy.line, copy.message) == (error.status, error.line, error.message)


def test_lives_as_long_as_its_runs():
    run = dalembert.Run(dalembert.System(OSCILLATOR), 'rk4')
    run.advance(10)
    assert run.time == pytest.approx(0.1)


def test_formulas():
    oscillator = dalembert.System(OSCILLATOR)
    assert oscillator.lagrangian == "(x'^2 - k*x^2)/2"
    assert dalembert.System('coordinates: [x]\naccelerations: {x: -x}\n').lagrangian == ''
    latex = oscillator.latex()
    assert latex.startswith('\\begin{align*}') and latex.rstrip().endswith('\\end{align*}')
    assert '\\ddot{x}' in latex or '\\dot{x}^{2}' in latex


def test_mechanics():
    """The Lagrangian and the constraint of the sleigh make its vakonomic motion, too."""
    sleigh = dalembert.System.builtin('chaplygin-sleigh')
    other = sleigh.with_mechanics('vakonomic')
    assert (sleigh.mechanics, other.mechanics, other.observe('y1^2').mechanics) == ('system', 'vakonomic', 'vakonomic')
    assert 'VAKONOMIC' in other.properties and 'VAKONOMIC' not in sleigh.properties
    # The built-in vakonomic sleigh has -D, and so -g.
    ends = []
    for system, g1 in ((other, -0.3), (pickle.loads(pickle.dumps(other)), -0.3), ('chaplygin-sleigh-vakonomic', 0.3)):
        run = dalembert.Run(system, 'gauss8', step=0.05, space='physical',
                            start={"y1'": 0.1, "phi'": 1, 'g1': g1})
        run.advance(40)
        ends.append(run.state * ([1] * 6 + [math.copysign(1, g1)]))
    assert ends[0].tobytes() == ends[1].tobytes()
    assert ends[0] == pytest.approx(ends[2], abs=1e-12)
    with pytest.raises(ValueError, match="'newton' is not one of system, lagrange-dalembert"):
        sleigh.with_mechanics('newton')
    with pytest.raises(dalembert.InputError):
        dalembert.System('coordinates: [x]\naccelerations: {x: -x}\n').with_mechanics('vakonomic')


def test_effort():
    """K of the lift: D is an integral for all p and pi, and on p = pi = 0 no bit changes."""
    sleigh = dalembert.System.builtin('chaplygin-sleigh')
    pushed = sleigh.with_effort('constraint')
    assert (sleigh.effort, pushed.effort, pushed.observe('y1^2').effort) == ('identity', 'constraint', 'constraint')
    start = {'pi_y1': 0.4, 'p_phi': -0.2}
    drift = []
    for system in (sleigh, pushed):
        run = dalembert.Run(system, 'gauss12', step=0.05, start=start)
        run.advance(40)
        drift.append(abs(run.observables[0]))
    assert drift[0] > 1e-2 and drift[1] < 1e-12
    ends = []
    for system in (sleigh, pushed, sleigh.with_effort('mass')):
        run = dalembert.Run(system, 'gauss4', step=0.05)
        run.advance(40)
        ends.append(run.state.tobytes())
    assert len(set(ends)) == 1
    with pytest.raises(ValueError, match="'masses' is not one of identity, mass"):
        sleigh.with_effort('masses')
    with pytest.raises(dalembert.InputError, match='effort controls: the system has none'):
        sleigh.with_effort('controls')


def test_gauge():
    """On p = pi = 0 the gauge changes no bit of q and v; e follows it."""
    sleigh = dalembert.System.builtin('chaplygin-sleigh')
    other = sleigh.with_gauge('e = 2, mu_e = 0.25')
    states = []
    for system in (sleigh, other, pickle.loads(pickle.dumps(other)), other.with_gauge('mu_e = cos(t)')):
        run = dalembert.Run(system, 'gauss4', step=0.125)
        run.advance(8)
        states.append(run.state)
    assert len({state[:6].tobytes() for state in states}) == 1
    assert [state[6] for state in states[:3]] == [1, 2.25, 2.25] and other.gauge == 'e = 2, mu_e = 0.25'
    with pytest.raises(dalembert.InputError, match="'mu' is not e or mu_e") as caught:
        sleigh.with_gauge('e = 1, mu = 2')
    assert (caught.value.line, caught.value.column) == (1, 8)


def test_tables_of_a_file(tmp_path):
    """A file with a table in another file is read from anywhere, and the text is enough for a copy."""
    (tmp_path / 'force.csv').write_text('x,f\n0,1\n1,3\n2,5\n')
    (tmp_path / 'pushed.yaml').write_text('coordinates: [x]\nlagrangian: x\'^2/2\n'
                                          'tables: {f: {file: force.csv, at: x, value: f}}\nforces: {x: f(x)}\n')
    system = dalembert.System.from_file(tmp_path / 'pushed.yaml')
    for one in (system, pickle.loads(pickle.dumps(system)), dalembert.System(system.text)):
        assert one.field([0.5], [0.0]) == pytest.approx(2.0)
