"""Ensembles: the members of the command line, closed forms, failures and errors."""
import os
import subprocess

import numpy as np
import pytest

import dalembert

OSCILLATOR = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n"
ROOT = "coordinates: [x]\nparameters: {s: 1}\nlagrangian: x'^2/2\nforces: {x: -s*sqrt(x)}\nstart: {x: 1}\n"


def test_members_of_the_program(tmp_path):
    program = os.environ.get('DALEMBERT_PROGRAM')
    if not program:
        pytest.skip('no program')
    vary = {"y1'": 'normal(0,0.1)', 'm': 'uniform(0,1)'}
    options = [f'--vary={name}={text}' for name, text in vary.items()]
    subprocess.run([program, 'ensemble', 'chaplygin-sleigh', '--members', '300', '--seed', '3', *options,
                    '--integrator', 'rk4', '--step', '0.01', '--times', '0.5,1', '--output', tmp_path / 'made',
                    '--no-page'], check=True, stdout=subprocess.DEVNULL)
    made = dalembert.ensemble('chaplygin-sleigh', 'rk4', members=300, seed=3, step=0.01, times=[0.5, 1], vary=vary)
    rows = np.load(tmp_path / 'made' / 'rows.npy')
    drawn = np.load(tmp_path / 'made' / 'members.npy')
    assert made.names == rows.dtype.names
    for i, name in enumerate(made.names):
        assert np.array_equal(made.states[:, :, i], rows[name])
    for name in vary:
        assert np.array_equal(made.draws[name], drawn[name])


def test_an_oscillator_turns_its_covariance():
    made = dalembert.ensemble(dalembert.System(OSCILLATOR), 'gauss8', members=400, seed=1, step=0.05,
                              times=[0.0, 2.3], space='physical', vary=['x=normal(0,0.3)', "x'=uniform(-1,1)"])
    turn = np.array([[np.cos(2.3), np.sin(2.3)], [-np.sin(2.3), np.cos(2.3)]])
    before, after = made.covariance()
    assert np.allclose(before, np.cov(np.array([made.draws['x'], made.draws["x'"]])), atol=1e-12)
    assert np.allclose(after, turn @ before @ turn.T, atol=1e-9)
    assert np.allclose(made.mean()[1], turn @ made.mean()[0], atol=1e-9)
    assert made.quantiles(0.5).shape == (2, 2)


def test_failures_are_named():
    made = dalembert.ensemble(dalembert.System(ROOT), 'rk4', members=50, seed=1, step=0.01, times=1,
                              vary={'s': 'uniform(0,20)'})
    lost = np.isnan(made.states[0, :, 0])
    assert 0 < lost.sum() < 50
    assert sorted(made.failures) == list(np.flatnonzero(lost))
    assert all(isinstance(error, dalembert.StepError) for error in made.failures.values())


@pytest.mark.parametrize('changes', [{'vary': {'q': 'normal(0,1)'}}, {'vary': {'x': 'normal(0,-1)'}},
                                     {'vary': ['x']}, {'members': 0}, {'seed': -1}, {'times': 0.51},
                                     {'times': [1, 0.5]}, {'times': []}])
def test_errors(changes):
    given = {'members': 3, 'seed': 1, 'step': 0.05, 'times': 1, 'vary': {'x': 'normal(0,1)'}, **changes}
    with pytest.raises(dalembert.InputError):
        dalembert.ensemble(dalembert.System(OSCILLATOR), 'rk4', **given)
