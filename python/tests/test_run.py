"""Runs: closed forms, the rows of the program, failures, interruption."""
import gc
import io
import signal
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import dalembert

SLEIGH = 'chaplygin-sleigh'


def test_closed_form():
    """The sleigh moves in a circle, y1 = sin t, y2 = 1 - cos t, phi = t; gauss8 errs by 1e-17 h^8 t."""
    run = dalembert.Run(SLEIGH, 'gauss8', step=0.01)
    run.advance(1000)
    state = dict(zip(run.names, run.state))
    assert run.steps == 1000 and run.time == pytest.approx(10)
    assert state['y1'] == pytest.approx(np.sin(10), abs=1e-12)
    assert state['y2'] == pytest.approx(1 - np.cos(10), abs=1e-12)
    assert state['phi'] == pytest.approx(10)
    values = dict(zip(run.observable_names, run.observables))
    assert values['error'] < 1e-12 and abs(values['D1']) < 1e-13
    assert values['E'] == pytest.approx(1) and values['H'] == 0


def test_rows_of_the_program(program):
    """The bits are the same as from `dalembert run`, between steps, too."""
    text = program('run', SLEIGH, '--integrator', 'gauss4+project', '--step', '0.03', '--time', '3',
                   '--samples', '7')
    expected = np.genfromtxt(io.StringIO(text), delimiter=',', names=True, deletechars='', dtype=float)
    run = dalembert.Run(SLEIGH, 'gauss4+project', step=0.03)
    rows = run.trajectory(expected['t'])
    assert rows.dtype.names == tuple(text.split('\n')[0].split(','))
    for name, other in zip(rows.dtype.names, expected.dtype.names):
        assert np.array_equal(rows[name], expected[other]), name


def test_observed(program):
    """The lateral force on a sleigh that runs at v and turns at omega is m v omega."""
    parameters = {'m': 2, 'v0': 3, 'omega': 1}
    sleigh = dalembert.System.builtin(SLEIGH)
    seen = sleigh.observe('abs(h1) - 0.3*m').observe("y1'^2 + y2'^2")
    assert sleigh.observed == () and seen.invariants == sleigh.invariants
    assert seen.observed == ('abs(h1) - 0.3*m', "y1'^2 + y2'^2")
    rows = dalembert.Run(seen, 'gauss8', step=0.05, parameters=parameters).trajectory([0, 1.03, 2])
    assert np.allclose(rows[seen.observed[0]], 2 * 3 * 1 - 0.3 * 2, atol=1e-12, rtol=0)
    assert np.allclose(rows[seen.observed[1]], 3**2, atol=1e-12, rtol=0)
    bare = dalembert.Run(sleigh, 'gauss8', step=0.05, parameters=parameters).trajectory([0, 1.03, 2])
    for name in bare.dtype.names:
        assert np.array_equal(rows[name], bare[name]), name
    text = program('run', SLEIGH, '--integrator', 'gauss8', '--step', '0.05', '--times', '0,1.03,2',
                   '--set', 'm=2', '--set', 'v0=3', '--observe', '; '.join(seen.observed))
    assert tuple(text.split('\n')[0].split(',')) == rows.dtype.names
    assert np.array_equal(np.array(text.split('\n')[2].split(','), dtype=float), list(rows[1]))


def test_observed_elsewhere():
    """Batches and measurements take a system that observes."""
    seen = dalembert.System.builtin(SLEIGH).observe('h1 + m')
    batch = dalembert.Batch(seen, 'rk4', 3, step=0.1)
    batch.advance(10)
    run = dalembert.Run(SLEIGH, 'rk4', step=0.1)
    run.advance(10)
    assert np.array_equal(batch.state()[2], run.state)
    assert 'h1 + m' in dalembert.trend(seen, 'rk4', 10, step=0.1)
    assert dalembert.section(seen, 'y1 = 0', 'gauss8', 10, step=0.1).up == 1


def test_wrong_formula():
    for formulas, place in (('y1 + 1', 'h1 + kk'), (2, 6)), (("y1'",), (1, 1)), (('y1^2', 'y1^2'), (2, 1)):
        with pytest.raises(dalembert.InputError) as caught:
            dalembert.System.builtin(SLEIGH).observe(*formulas)
        assert (caught.value.line, caught.value.column) == place
    with pytest.raises(TypeError, match="not \\['y1 \\+ 1'\\]"):
        dalembert.System.builtin(SLEIGH).observe(['y1 + 1'])


@pytest.mark.parametrize('step', [0.05, -0.05])
def test_start_time(step):
    """x'' = cos t from any time, either way."""
    forced = dalembert.System("coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: cos(t)}\n"
                              "start: {x: 0.2, x': -0.3}\n")
    run = dalembert.Run(forced, 'gauss8', step=step, start_time=2.5)
    assert run.time == 2.5
    rows = run.trajectory(2.5 + step * np.array([0, 7.5, 20]))
    passed = rows['t'] - 2.5
    x = 0.2 - (0.3 + np.sin(2.5)) * passed + np.cos(2.5) - np.cos(rows['t'])
    assert np.abs(rows['x'] - x).max() < 1e-13
    with pytest.raises(dalembert.InputError, match='before the present'):
        run.trajectory([2.5])
    batch = dalembert.Batch(forced, 'gauss8', 3, step=step, start_time=2.5)
    batch.advance(20)
    assert np.array_equal(batch.time, [run.time] * 3)
    assert np.array_equal(batch.state()[1], run.state)


def test_trajectory_continues(oscillator):
    whole = dalembert.Run(oscillator, 'gauss4', step=0.1).trajectory(np.linspace(0, 10, 41))
    run = dalembert.Run(oscillator, 'gauss4', step=0.1)
    parts = [run.trajectory(np.linspace(0, 4, 17)), run.trajectory(np.linspace(4.25, 10, 24))]
    assert np.array_equal(whole, np.concatenate(parts))
    assert np.abs(whole['x'] - np.cos(whole['t'])).max() < 1e-5
    assert run.trajectory(10.05)['t'] == [10.05]


@pytest.mark.parametrize('times', [[], [1, 1], [2, 1], [0.5, float('nan')], [-1, 2], [float('nan')]])
def test_bad_times(oscillator, times):
    run = dalembert.Run(oscillator, 'rk4', step=0.1)
    with pytest.raises(dalembert.InputError):
        run.trajectory(times)
    run.advance(20)
    with pytest.raises(dalembert.InputError, match='before the present'):
        run.trajectory([1.95])  # less than a step before


def test_save_and_restore(oscillator):
    """gauss4 extrapolates its stages from the last step: the state alone would not do."""
    first, second = (dalembert.Run(oscillator, 'gauss4', step=0.1) for _ in range(2))
    first.advance(50)
    saved = first.save()
    first.advance(50)
    second.restore(saved)
    second.advance(50)
    assert np.array_equal(first.state, second.state) and first.time == second.time
    assert second.steps == 100 and second.evaluations == first.evaluations
    for bad in (saved[:-8], saved[:-1], b''):
        with pytest.raises(dalembert.InputError):
            second.restore(bad)


def test_impossible_checkpoints(oscillator):
    """A number that no run has is refused by name, and changes nothing."""
    run = dalembert.Run(oscillator, 'gauss4', step=0.1, space='physical')
    run.advance(50)
    saved = run.save()
    for place, value, name in ((6, 1.5, 'number of steps'), (7, -1.0, 'number of evaluations'),
                               (8, 2.0, 'uses_newton'), (0, np.nan, 'not finite')):
        bad = np.frombuffer(saved).copy()
        bad[place] = value
        with pytest.raises(dalembert.InputError, match=name):
            run.restore(bad.tobytes())
        assert run.save() == saved
    run.restore(saved)


@pytest.mark.parametrize('make', [
    lambda system: dalembert.Run(system, 'gauss4', step=0.1),
    lambda system: dalembert.Batch(system, 'gauss4', 3, step=0.1),
])
def test_attributes_are_read_only(make):
    """The model lives as long as what steps it, whatever becomes of attributes."""
    other = make('vertical-disk')
    stepped = make('chaplygin-sleigh')
    for name in ('system', 'dimension', 'names', 'integrator'):
        with pytest.raises(AttributeError, match='read-only'):
            setattr(stepped, name, getattr(other, name))
        with pytest.raises(AttributeError, match='read-only'):
            delattr(stepped, name)
    for name in ('_model', '_system', 'events', 'parameters'):
        with pytest.raises(AttributeError, match='read-only'):
            delattr(stepped.system, name)
    vars(stepped).pop('system')
    gc.collect()
    fill = [dalembert.System.builtin('vertical-disk') for _ in range(20)]
    stepped.advance(100)
    assert np.allclose(np.ravel(stepped.time), 10) and len(fill) == 20
    stepped.label = 'mine'
    stepped.label = 'yours'
    del stepped.label


@pytest.mark.parametrize('steps', [-1, float('nan'), float('inf'), 2.5, '3', None])
def test_bad_steps(oscillator, steps):
    for stepped in dalembert.Run(oscillator, 'rk4'), dalembert.Batch(oscillator, 'rk4', 2):
        with pytest.raises(dalembert.InputError, match='^steps: '):
            stepped.advance(steps)
        assert np.all(stepped.time == 0)


@pytest.mark.parametrize('call', [
    lambda run: run.index('x\0y'),
    lambda run: run.set_parameter('k\0', 1),
    lambda run: run.compile('cache\0'),
    lambda run: run.compile(compiler='cc\0'),
    lambda run: dalembert.Run(run.system, 'rk4\0'),
    lambda run: dalembert.Run(run.system, 'rk4', space='physical\0'),
    lambda run: dalembert.Run(run.system, 'rk4', start={'x\0': 1}),
    lambda run: dalembert.Run(run.system, 'rk4', parameters={'k\0': 1}),
    lambda run: dalembert.Batch(run.system, 'rk4', 2).set_parameter('k\0', 1),
    lambda run: dalembert.System.builtin('chaplygin-sleigh\0'),
    lambda run: dalembert.System(run.system.text, 'name\0'),
    lambda run: run.system.observe('x\0'),
    lambda run: dalembert.section(run.system, 'x\0', 'rk4', 1),
    lambda run: dalembert.order(run.system, 'rk4', 1, reference='gauss8\0'),
    lambda run: dalembert.generate(run.system, 'rk4', prefix='name\0'),
    lambda run: dalembert.ensemble(run.system, 'rk4', members=2, seed=1, times=1, vary={'x': 'uniform(0,1)\0'}),
])
def test_names_with_nul(oscillator, call):
    with pytest.raises(dalembert.InputError, match='has a NUL'):
        call(dalembert.Run(oscillator, 'rk4'))


def test_set_state(oscillator):
    run = dalembert.Run(oscillator, 'gauss8', step=0.1, space='physical')
    run.set_state([0, 1], time=0)
    run.advance(10)
    assert run.state == pytest.approx([np.sin(1), np.cos(1)], abs=1e-10)
    state = run.state
    state[0] = 7
    assert run.state[0] != 7
    with pytest.raises(dalembert.InputError, match='shape'):
        run.set_state([1, 2, 3])
    with pytest.raises(dalembert.InputError) as caught:
        run.set_state([np.nan, 1])
    assert caught.value.status == 'DAL_NOT_FINITE'


def test_settings(oscillator):
    run = dalembert.Run(oscillator, 'gauss8', step=0.1, parameters={'k': 4}, start={'x': 0, "x'": 2})
    assert run.parameters == {'k': 4.0} and run.dimension == 6
    run.advance(10)
    assert run.state[0] == pytest.approx(np.sin(2), abs=1e-10)
    quad = dalembert.Run(oscillator, 'gauss8', precision='quad', solver_tolerance=1e-20)
    quad.advance()
    assert quad.step == 0.01


def test_parameter_between_steps(oscillator):
    """x = cos t up to pi/2, where x = 0 and x' = -1, then -sin(2 s)/2."""
    run = dalembert.Run(oscillator, 'gauss8', step=np.pi / 20)
    run.advance(10)
    assert run.set_parameter('k', 4) and run.parameters == {'k': 4.0}
    other = dalembert.Run(oscillator, 'gauss8', step=np.pi / 20)
    other.restore(run.save())
    for each in run, other:
        each.advance(5)
        assert each.state[each.index('x')] == pytest.approx(-0.5, abs=1e-8)
        assert each.state[each.index("x'")] == pytest.approx(0, abs=1e-8)
    for name, value in (('l', 1), ('k', float('nan'))):
        with pytest.raises(dalembert.InputError):
            run.set_parameter(name, value)
    with pytest.raises(dalembert.InputError, match="'y'"):
        run.index('y')
    assert run.parameters == {'k': 4.0}


GUIDED = """
coordinates: [x, y]
parameters: {c: 1}
lagrangian: (x'^2 + y'^2)/2
constraints: [y' - c*x']
start: {x': 1, y': 1}
"""


def test_parameter_of_a_constraint():
    run = dalembert.Run(dalembert.System(GUIDED), 'rk4')
    assert run.set_parameter('c', 1) and not run.set_parameter('c', 2)
    assert run.observables[0] == -1 and run.parameters == {'c': 2.0}


@pytest.mark.parametrize('settings, status', [
    ({'integrator': 'rk5'}, 'DAL_NAME'),
    ({'integrator': 'rk4', 'parameters': {'l': 1}}, 'DAL_NAME'),
    ({'integrator': 'rk4', 'start': {'y': 1}}, 'DAL_NAME'),
    ({'integrator': 'rk4', 'spaces': 'physical'}, 'DAL_NAME'),
    ({'integrator': 'rk4', 'step': 0}, 'DAL_ARGUMENT'),
    ({'integrator': 'rk4', 'space': 'curved'}, 'DAL_ARGUMENT'),
    ({'integrator': 'rk4', 'start': {'x': float('nan')}}, 'DAL_ARGUMENT'),
    ({}, 'DAL_ARGUMENT'),
])
def test_bad_settings(oscillator, settings, status):
    with pytest.raises(dalembert.InputError) as caught:
        dalembert.Run(oscillator, **settings)
    assert caught.value.status == status


FALL = """
coordinates: [x]
accelerations: {x: -1/x^2}
start: {x: 1}
"""


def test_failure():
    """A free fall into the centre takes pi/sqrt(8) = 1.11."""
    run = dalembert.Run(dalembert.System(FALL), 'gauss4', step=0.01, space='physical')
    with pytest.raises(dalembert.StepError) as caught:
        run.trajectory(np.linspace(0, 2, 201))
    rows = caught.value.partial
    assert isinstance(caught.value, ArithmeticError)
    assert 100 < len(rows) < 120 and np.array_equal(rows['t'], np.linspace(0, 2, 201)[:len(rows)])
    before = run.state, run.time
    assert rows['t'][-1] == pytest.approx(run.time, abs=1e-12)
    with pytest.raises(dalembert.StepError):
        run.advance()
    assert np.array_equal(run.state, before[0]) and run.time == before[1]


def test_compiled_steps(oscillator, tmp_path):
    runs = [dalembert.Run(oscillator, 'gauss4', step=0.1) for _ in range(2)]
    runs[0].compile(tmp_path / 'cache')
    assert runs[0].is_compiled and not runs[1].is_compiled
    for run in runs:
        run.advance(100)
    assert np.array_equal(runs[0].state, runs[1].state)
    with pytest.raises(dalembert.InputError) as caught:
        runs[1].compile(tmp_path / 'cache', compiler=str(tmp_path / 'none'))
    assert caught.value.status == 'DAL_UNSUPPORTED'


class Alarm(Exception):
    pass


@pytest.mark.parametrize('endless', [
    lambda run: run.advance(2 ** 50),
    lambda run: run.trajectory([0, 1e12]),
    lambda run: run.events(1e12),
    lambda run: dalembert.trend(run.system, 'rk4', 1e12),
    lambda run: dalembert.section(run.system, 'x', 'rk4', 1e12),
    lambda run: dalembert.lyapunov(run.system, 'rk4', 1e12),
    lambda run: dalembert.order(run.system, 'rk4', 1e6, levels=2),
    lambda run: dalembert.Batch(run.system, 'rk4', 3).advance(2 ** 50),
])
def test_signals(oscillator, endless):
    """The handler of a signal is called, and its exception ends what would never end."""
    def handler(number, frame):
        raise Alarm
    run = dalembert.Run(oscillator, 'rk4')
    before = signal.signal(signal.SIGALRM, handler)
    try:
        with pytest.raises(Alarm):
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            endless(run)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_other_threads_run():
    """A call that never ends does not keep the others out, who would not interrupt it."""
    script = textwrap.dedent("""
        import os, sys, threading
        import dalembert
        from dalembert._library import ffi, lib
        run = dalembert.Run('chaplygin-sleigh', 'rk4')
        sys.setswitchinterval(1e6)
        begun = threading.Event()
        def endless():
            begun.set()
            lib.dal_run_advance(run._run, 2 ** 52, ffi.NULL)
        threading.Thread(target=endless, daemon=True).start()
        begun.wait()
        os._exit(0)
    """)
    assert subprocess.run([sys.executable, '-c', script], timeout=600).returncode == 0


def test_solved_start():
    """x' = 1 gives y' = tan a and a' = tan(f)/(l cos a); a first guess chooses the root of a circle."""
    car = dalembert.System("""
coordinates: [x, y, a]
parameters: {l: 1.2, f: 0.4}
lagrangian: (x'^2 + y'^2 + a'^2)/2
constraints: [x'*sin(a) - y'*cos(a), x'*cos(a) + y'*sin(a) - l*a'/tan(f)]
start: {a: 0.3, x': 1, solve: [y', a']}
""")
    state = dalembert.Run(car, 'rk4', step=0.1).state
    assert state[3:6] == pytest.approx([1, np.tan(0.3), np.tan(0.4) / 1.2 / np.cos(0.3)], abs=1e-14)
    circle = dalembert.System("""
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2
constraints: [x'^2 + y'^2 - 25]
start: {x': 3, solve: [y']}
""")
    assert dalembert.Run(circle, 'rk4', step=0.1, start={"y'": -1}).state[3] == pytest.approx(-4)
    with pytest.raises(dalembert.InputError, match='first guess 0; give another one') as failure:
        dalembert.Run(circle, 'rk4', step=0.1)
    assert (failure.value.line, failure.value.column) == (5, 24)
