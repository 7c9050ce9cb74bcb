"""Holonomic constraints: a bead on a circle against its angle, columns, `bare`, starts, errors."""
import io

import numpy as np
import pytest

import dalembert

CIRCLE = """
coordinates: [x, y]
parameters: {l: 2}
lagrangian: (x'^2 + y'^2)/2
holonomic: [x^2 + y^2 - l^2]
start: {x: l, y': 3}
"""


def test_circle():
    """A free bead turns by v/l in the unit of time; its reaction is the centripetal force."""
    run = dalembert.Run(dalembert.System(CIRCLE), 'rattle', space='physical', step=0.01, reactions=True)
    assert 'C1' in run.observable_names and 'D1' in run.observable_names
    run.advance(200)
    values = dict(zip(run.names, run.state)) | dict(zip(run.observable_names, run.observables))
    assert abs(values['C1']) < 1e-14 and abs(values['D1']) < 1e-14
    assert np.hypot(values['R_x'], values['R_y']) == pytest.approx(3**2/2, rel=1e-12)
    angle = np.arctan2(values['y'], values['x'])
    assert angle == pytest.approx(1.5*2, abs=1e-3)  # rattle has order 2
    run = dalembert.Run(dalembert.System(CIRCLE), 'gauss-spark6', space='physical', step=0.01)
    run.advance(200)
    assert run.state[:2] == pytest.approx([2*np.cos(3), 2*np.sin(3)], abs=1e-11)


def test_bare():
    """A method of F is projected unless `bare`; without it g drifts."""
    system = dalembert.System(CIRCLE)
    projected = dalembert.simulate(system, 'rk4', 20, step=0.1)
    bare = dalembert.simulate(system, 'rk4', 20, step=0.1, bare=True)
    assert np.max(np.abs(projected['C1'])) < 1e-14 and np.max(np.abs(bare['C1'])) > 1e-5
    named = dalembert.simulate(system, 'rk4+project', 20, step=0.1)
    assert np.array_equal(projected['x'], named['x'])


def test_rows_of_the_program(program):
    options = ('--integrator', 'gauss4', '--step', '0.02', '--time', '3', '--samples', '6')
    text = program('run', 'skate-on-sphere', *options)
    expected = np.genfromtxt(io.StringIO(text), delimiter=',', names=True, deletechars='', dtype=float)
    run = dalembert.simulate('skate-on-sphere', 'gauss4', 3, step=0.02, samples=6)
    for name, other in zip(run.names, expected.dtype.names):
        assert np.array_equal(run[name], expected[other]), name


def test_starts_and_errors():
    system = dalembert.System(CIRCLE)
    with pytest.raises(dalembert.Error, match='holonomic constraint 1'):
        dalembert.Run(system, 'rattle', space='physical', step=0.1, start={'x': 1})
    run = dalembert.Run(system, 'rattle', space='physical', step=0.1, start={'x': 1}, consistent=True)
    assert run.state[:2] == pytest.approx([2, 0])
    with pytest.raises(dalembert.Error, match='enforces D alone'):
        dalembert.Run(system, 'gni', space='physical', step=0.1)
