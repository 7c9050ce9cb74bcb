"""Studies, checks, and directories of the program."""
import json

import numpy as np
import pytest

import dalembert
from test_analysis import SKATE

SLEIGH = 'chaplygin-sleigh'


def test_load_run(program, tmp_path):
    (tmp_path / 'skate.yaml').write_text(SKATE)
    program('run', str(tmp_path / 'skate.yaml'), '--integrator', 'rk4', '--step', '0.05', '--time', '20', '--set',
            'k=2', '--output', str(tmp_path / 'run'))
    loaded = dalembert.load(tmp_path / 'run')
    made = dalembert.simulate(dalembert.System(SKATE), 'rk4', 20, step=0.05, parameters={'k': 2}, samples=100)
    assert np.array_equal(loaded.rows, made.rows)
    assert (loaded.integrator, loaded.step, loaded.parameters) == ('rk4', 0.05, {'m': 1, 'J': 1, 'k': 2})
    assert loaded.system.text == SKATE and set(loaded.trends) == set(made.trends)
    for name in ('first', 'last', 'deviation', 'size', 'trend'):
        assert getattr(loaded.trends['D1'], name) == getattr(made.trends['D1'], name)
    assert 'svg' in loaded._repr_html_()
    manifest = tmp_path / 'run' / 'manifest.json'
    given = json.loads(manifest.read_text())
    given['method'] = given.pop('integrator')
    manifest.write_text(json.dumps(given))
    assert dalembert.load(tmp_path / 'run').integrator == 'rk4'


def test_load_ensemble(program, tmp_path):
    program('ensemble', SLEIGH, '--members', '40', '--seed', '3', '--vary', "phi'=normal(0,0.1)", '--integrator',
            'rk4', '--step', '0.05', '--times', '1,2', '--no-page', '--output', str(tmp_path / 'cloud'))
    loaded = dalembert.load(tmp_path / 'cloud')
    made = dalembert.ensemble(SLEIGH, 'rk4', step=0.05, members=40, seed=3, vary={"phi'": 'normal(0,0.1)'},
                              times=[1, 2])
    assert loaded.names == made.names and np.array_equal(loaded.times, [1, 2])
    assert np.array_equal(loaded.states, made.states) and loaded.failures == {}
    assert np.array_equal(loaded.draws["phi'"], made.draws["phi'"])


def test_load_nothing(tmp_path):
    with pytest.raises(dalembert.InputError, match='^directory: '):
        dalembert.load(tmp_path)


def test_study(program, tmp_path):
    skate = dalembert.System(SKATE, 'skate.yaml')
    given = {'integrators': ['rk4', 'gauss4+project'], 'step': np.float64(0.05), 'time': 20, 'starts': 'physical',
             'systems': [skate, {'system': SLEIGH, 'label': 'sleigh', 'set': {'omega': [1, 2]}}],
             'expect': {'skate': {'gauss4+project': {'D': 'rounding'}}}}
    found = dalembert.study(given, tmp_path / 'study')
    assert (found.status, found.met, len(found.cells)) == ('done', True, 6)
    cells = {(cell['label'], cell['integrator']): cell for cell in found.cells}
    drift = dalembert.trend(skate, 'rk4', 20, step=0.05, space='physical')['D1']
    cell = cells['skate', 'rk4']
    assert cell['D_max'] == drift.max_abs and (cell['D_size'], cell['D_trend']) == (drift.size, drift.trend)
    assert cell['message'] is None and isinstance(cell['bits'], str)
    run = found.trajectory(cell)
    assert abs(run['D1']).max() <= drift.max_abs and len(run) == 401
    assert dalembert.load(tmp_path / 'study') == found
    unmet = dalembert.study({**given, 'expect': {'skate': {'rk4': {'D': 'rounding'}}}})
    assert (unmet.status, unmet.met, unmet.directory) == ('unmet', False, None)
    with pytest.raises(dalembert.InputError, match='^cell: '):
        unmet.trajectory(unmet.cells[0])


def test_bad_study(program, tmp_path):
    with pytest.raises(dalembert.InputError, match='integrator'):
        dalembert.study({'integrators': ['rk5'], 'step': 0.1, 'time': 1, 'systems': [SLEIGH]})
    with pytest.raises(dalembert.InputError, match='^study: '):
        dalembert.study({'integrators': ['rk4'], 'step': 0.1, 'time': object(), 'systems': [SLEIGH]})
    with pytest.raises(dalembert.InputError, match='^study: .* observes'):
        dalembert.study({'systems': [dalembert.System(SKATE).observe('x + 1')]})


def test_check(program):
    """A start with y2' = 1, across the blade at phi = 0, violates D = 0."""
    found = dalembert.check(SLEIGH)
    assert found.ok and {'start', 'constraints'} <= {item['section'] for item in found.items}
    assert any(method['integrator'] == 'rk4' and method['accepted'] for method in found.methods)
    wrong = dalembert.check(dalembert.System.builtin(SLEIGH), start={"y2'": 1}, parameters={'m': 2})
    assert not wrong.ok and '|D| at the start' in repr(wrong)
    item = next(item for item in wrong.items if item['item'] == '|D| at the start')
    assert item['value'] == 1 and item['result'] == 'FAIL'


def test_no_program(monkeypatch):
    monkeypatch.delenv('DALEMBERT_PROGRAM', raising=False)
    monkeypatch.setenv('PATH', '')
    with pytest.raises(FileNotFoundError, match='DALEMBERT_PROGRAM'):
        dalembert.check(SLEIGH)
