"""Batches: each lane has the bits of a single run."""
import numpy as np
import pytest

import dalembert
from test_run import FALL, GUIDED


def test_lanes_are_runs(oscillator):
    k, x = np.linspace(1, 4, 11), np.linspace(-1, 1, 11)
    batch = dalembert.Batch(oscillator, 'gauss4', step=0.05, parameters={'k': k}, start={'x': x, "x'": 0.5})
    batch.advance(100)
    states = batch.state()
    assert states.shape == (11, 6) == (len(batch), len(batch.names)) and batch.errors == [None] * 11
    for i in range(11):
        run = dalembert.Run(oscillator, 'gauss4', step=0.05, parameters={'k': k[i]},
                            start={'x': x[i], "x'": 0.5})
        run.advance(100)
        assert np.array_equal(run.state, states[i])
        assert batch.time[i] == run.time


def test_compiled_batch(oscillator, tmp_path):
    batches = [dalembert.Batch(oscillator, 'rk4', start={'x': [1, 2, 3]}) for _ in range(2)]
    batches[0].compile(tmp_path / 'cache')
    assert batches[0].is_compiled and not batches[1].is_compiled
    for batch in batches:
        batch.advance(100)
    assert np.array_equal(batches[0].state(), batches[1].state())


def test_parameter_between_steps(oscillator):
    k = np.array([1, 2, 3])
    batch = dalembert.Batch(oscillator, 'gauss4', 3)
    runs = [dalembert.Run(oscillator, 'gauss4') for _ in k]
    for values in (k, np.full(3, 5.0)):
        assert list(batch.set_parameter('k', values if values is k else 5)) == [True] * 3
        batch.advance(10)
        for run, value in zip(runs, values):
            run.set_parameter('k', value)
            run.advance(10)
        assert np.array_equal(batch.state(), [run.state for run in runs])
    guided = dalembert.Batch(dalembert.System(GUIDED), 'rk4', 2)
    assert list(guided.set_parameter('c', [1, 2])) == [True, False]
    for bad in (np.nan, [1, 2, 3, 4]):
        with pytest.raises(ValueError):
            batch.set_parameter('k', bad)


def test_failing_lanes():
    """A fall from x takes pi sqrt(x^3/8): 1.11 from 1, 8.89 from 4."""
    batch = dalembert.Batch(dalembert.System(FALL), 'gauss4', step=0.01, start={'x': [1, 4]},
                            space='physical')
    batch.advance(200)
    first, second = batch.errors
    assert isinstance(first, dalembert.StepError) and second is None
    assert batch.time[0] < 1.2 and batch.time[1] == pytest.approx(2)
    with pytest.raises(dalembert.StepError):
        batch.advance(1000)


def test_bad_lanes(oscillator):
    for arguments in ({'start': {'x': [1, 2]}, 'parameters': {'k': [1, 2, 3]}},
                      {'start': {'x': [1, 2]}, 'count': 3},
                      {'count': 0}, {'start': {'x': []}}, {'start': {'x': [1, np.nan]}}, {'width': 3}):
        with pytest.raises(dalembert.InputError):
            dalembert.Batch(oscillator, 'rk4', **arguments)
    with pytest.raises(dalembert.InputError):
        dalembert.Batch(oscillator, 'rk4', 2).advance(-1)
